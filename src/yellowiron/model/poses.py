"""Solved joint coordinates over the strokes: what a page needs to move a machine without a solver."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from yellowiron.model.geometry import Floats


@dataclass(frozen=True, eq=False)
class PoseTable:
    """One group of coordinates that loops couple, on a regular grid over its drivers' limits.

    `axes`: each driver's coordinates, ascending and evenly spaced; `values` (*len of each axis, columns): the
    coordinates of the `dependent` tree joints there, metres or radians from the drawn pose; one column a joint, four
    (a unit quaternion w, x, y, z of the child against its parent, machine axes in the drawn pose) where it is
    spherical. `clamped` grid points cannot be reached and repeat the nearest that can.
    """

    drivers: tuple[str, ...]
    axes: tuple[Floats, ...]
    dependent: tuple[str, ...]
    values: Floats
    clamped: int = 0


@dataclass(frozen=True, eq=False)
class PoseTables:
    """How a mechanism moves.

    A tree joint's coordinate is its own where it is `independent`, a table's where it is dependent, else 0. A body's
    displacement is its parent's, then the screw of its tree joint about the drawn axis: so the groups combine by
    themselves. `straight`: a pivot's coordinate in the straight machine, where the drawn one is steered.
    """

    independent: tuple[str, ...]
    tables: tuple[PoseTable, ...]
    straight: Mapping[str, float] = field(default_factory=dict)
