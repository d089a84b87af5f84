"""Poses of a machine: those that an engine's run went through, with errors and positions over time; and solved joint
coordinates over the strokes, by which a page moves a machine without a solver."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from yellowiron.model.geometry import Floats


@dataclass(frozen=True, eq=False)
class Snapshot:
    """The machine at one step: `time` in seconds from the sweep's start; `share` (0 … 1) of the way of what moves, None
    for motors; `poses`: body → (4, 4) displacement from the drawn pose, machine frame, the root's own included."""

    time: float
    share: float | None
    poses: Mapping[str, Floats]


@dataclass(frozen=True, eq=False)
class Trace:
    """A driven joint over the sweep's times: `wanted` and `measured` (n,), shares of the stroke (0: fully in) where
    `kind` is position, rad/s or m/s where it is velocity."""

    joint: str
    kind: Literal["position", "velocity"]
    wanted: Floats
    measured: Floats


@dataclass(frozen=True, eq=False)
class Sweep:
    """One phase of a run: an actuator alone, or all `together`. `times` (n,) in seconds from its start; `pin_error`
    (n,) metres and `angle_error` (n,) radians are each the worst since the time before; `snapshots` go from low to
    high."""

    name: str
    times: Floats
    pin_error: Floats
    angle_error: Floats
    traces: tuple[Trace, ...]
    snapshots: tuple[Snapshot, ...]


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
