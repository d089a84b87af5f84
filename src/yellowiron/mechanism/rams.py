"""What the CAD shows of a hydraulic cylinder: bore, rod, and how far it is out.

Coordinates run along the slide's axis, from the barrel's pivot towards the rod's, metres.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from yellowiron.mechanism.axes import Line, on_line
from yellowiron.mechanism.placement import Placement
from yellowiron.model.geometry import Floats

_TOUCH = 1e-4
"""Faces nearer than this touch, metres."""
_FACING = 0.9999
"""Cosine from which a facet faces along the axis (0.8°)."""
_OVER_ROD = 1.02
"""What is this much thicker than the rod is piston or eye, not rod."""
_FIT = 1.001
"""A piston may be this much larger than its bore (facets, tolerances)."""


@dataclass(frozen=True)
class Ram:
    """What the CAD shows; None where it does not. Diameters, and distances along the axis, metres.

    `to_base`: piston to the barrel's bottom, so how far the cylinder is out if it closes on the piston; `to_gland`:
    piston to the gland; `to_eye`: gland to the rod's eye, so how far it is out at most.
    """

    bore: float | None = None
    rod_diameter: float | None = None
    to_base: float | None = None
    to_gland: float | None = None
    to_eye: float | None = None

    @property
    def travel(self) -> float | None:
        """The piston's whole travel in the barrel."""
        if self.to_base is None or self.to_gland is None:
            return None
        return self.to_base + self.to_gland


def measure_ram(placement: Placement, barrel: str, rod: str, line: Line) -> Ram:
    """The cylinder of the bodies `barrel` and `rod` about a line that points from barrel pivot to rod pivot."""
    barrel_rows, rod_rows = placement.rows_of_body(barrel), placement.rows_of_body(rod)
    inside, outside = placement.features(barrel_rows), placement.features(rod_rows)
    bores = inside.take(on_line(inside, line) & inside.inner)
    shafts = outside.take(on_line(outside, line) & ~outside.inner)
    if len(bores) == 0 or len(shafts) == 0:
        return Ram()
    main = int(np.argmax(bores.area))
    bore = float(bores.radius[main])
    middle = float(line.along(bores.center[main][None])[0])
    start, end = middle - bores.length[main] / 2, middle + bores.length[main] / 2
    thinner = shafts.take(shafts.radius < bore * _FIT)
    if len(thinner) == 0:
        return Ram(bore=2.0 * bore)
    shaft = float(thinner.radius[int(np.argmax(thinner.length))])

    points = placement.points_of(rod_rows)
    along, radial = line.along(points), line.distance(points)
    piston = along[
        (radial > shaft * _OVER_ROD) & (radial < bore * _FIT) & (along > start - _TOUCH) & (along < end + _TOUCH)
    ]
    in_bore = along[(radial < bore * _FIT) & (along > start - _TOUCH)]
    beyond = along[(radial > shaft * _OVER_ROD) & (along > end + _TOUCH)]

    to_base = to_gland = to_eye = None
    if len(piston):
        bottom = _face(placement, barrel_rows, line, bore, sense=1.0, before=float(in_bore.min()) + _TOUCH)
        if bottom is not None:
            to_base = max(0.0, float(in_bore.min()) - bottom)
        gland = _face(placement, barrel_rows, line, bore, sense=-1.0, before=-float(piston.max()) + _TOUCH)
        if gland is not None:
            to_gland = max(0.0, -gland - float(piston.max()))
    if len(beyond):
        shell = placement.points_of(barrel_rows)
        head = line.along(shell[line.distance(shell) < 1.5 * bore]).max()
        to_eye = max(0.0, float(beyond.min() - head))
    return Ram(2.0 * bore, 2.0 * shaft, to_base, to_gland, to_eye)


def _face(
    placement: Placement, rows: tuple[int, ...], line: Line, radius: float, *, sense: float, before: float
) -> float | None:
    """The last face within a radius of the line that faces along `sense`, in coordinates that run along `sense`, not
    beyond `before`; None if there is none. (With sense −1 coordinates are the negatives of the line's.)"""
    coordinates: list[Floats] = []
    for row in rows:
        center, normal, _ = placement.facets(row)
        along = sense * line.along(center)
        facing = sense * (normal @ line.direction) > _FACING
        near = facing & (along < before)
        coordinates.append(along[near & (line.distance(center) < radius)])
    found = np.concatenate(coordinates) if coordinates else np.zeros(0)
    return float(found.max()) if len(found) else None
