"""What the CAD shows of a hydraulic cylinder: bore, rod, and how far it is out.

Coordinates run along the slide's axis, from the barrel's pivot towards the rod's, metres.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.mechanism.joints.axes import Axis, on_axis
from yellowiron.mechanism.placement import Features, Placement
from yellowiron.model.geometry import Floats

_TOUCH = 1e-4
"""Faces nearer than this touch, metres."""
_FACING = 0.9999
"""Cosine from which a facet faces along the axis (0.8°)."""
_OVER_ROD = 1.02
"""What is this much thicker than the rod is piston or eye, not rod."""
_FIT = 1.001
"""A piston may be this much larger than its bore (facets, tolerances)."""
_PISTON = 0.85
"""What is this much of the bore's radius is a piston, where the rod is not known."""
_LEAN = 0.02
"""Sine of the angle up to which a barrel's faces are along a line."""
_CLOSE = 0.2
"""Faces fitted to facets are about a line if their axes are within this share of their radius from it."""
_OVER_SOLID = 1.15
"""As `_OVER_ROD`, where rod and barrel need not be in line."""
_CORNERS = 6
"""A prism has so many corners at least."""
_SLENDER = 0.4
"""No barrel is thicker than this share of its length."""
_TWIN = 0.02
"""Relative difference up to which two barrels are twins."""
_HEAD = 1.5
"""The barrel's head is what is within this much of the bore's radius; ports and pipes are farther out."""


@dataclass(frozen=True)
class CylinderGeometry:
    """What the CAD shows; None where it does not. Diameters, and distances along the axis, metres.

    `to_base`: piston to the barrel's bottom, so how far the cylinder is out if it closes on the piston; `to_gland`:
    piston to the gland; `to_eye`: gland to the rod's eye, so how far it is out at most. `outer`: the diameter of a
    barrel that is drawn without a bore. `count`: how many equal ones side by side are drawn as one.
    """

    bore: float | None = None
    rod_diameter: float | None = None
    to_base: float | None = None
    to_gland: float | None = None
    to_eye: float | None = None
    outer: float | None = None
    count: int = 1

    @property
    def travel(self) -> float | None:
        """The piston's whole travel in the barrel."""
        if self.to_base is None or self.to_gland is None:
            return None
        return self.to_base + self.to_gland


def measure_cylinder(
    placement: Placement, barrel_rows: Sequence[int], rod_rows: Sequence[int], line: Axis, *, through: bool = False
) -> CylinderGeometry:
    """The cylinder that those parts make about a line that points from barrel to rod; `through` one whose rod comes out
    at both ends."""
    inside, outside = placement.features(barrel_rows), placement.features(rod_rows)
    line, count = _own_axis(inside, line)
    bores = inside.take(on_axis(inside, line) & inside.inner)
    shafts = outside.take(on_axis(outside, line) & ~outside.inner)
    shell = placement.points_of(barrel_rows)
    if len(bores) == 0 and len(shell):
        tubes = inside.take(on_axis(inside, line) & ~inside.inner)
        if len(tubes):
            return _solid(tubes, shafts, shell, placement.points_of(rod_rows), line, count)
    if len(bores) == 0 or len(shell) == 0:
        return CylinderGeometry(outer=_thickness(shell, line), count=count)
    start, head = _extent(shell, line, _HEAD * float(bores.radius.max()))
    bore = _bore(bores, shafts, line, start, head)
    if bore is None:
        return CylinderGeometry(outer=_thickness(shell, line), count=count)

    # The rod is what comes out of the barrel: the longest shaft that reaches beyond its head.
    thin = shafts.take(shafts.radius < bore / _FIT)
    out = thin.take(line.along(thin.center) + thin.length / 2 > head + _TOUCH)
    shaft = float(out.radius[int(np.argmax(out.length))]) if len(out) else _gland(bores, bore)
    thick = shaft * _OVER_ROD if shaft is not None else _PISTON * bore

    points = placement.points_of(rod_rows)
    along, radial = line.along(points), line.distance(points)
    in_bore = (radial < bore * _FIT) & (along > start - _TOUCH) & (along < head)
    piston = along[in_bore & (radial > thick)]
    eye = along[(radial > thick) & (along >= head)]

    to_base = to_gland = to_eye = None
    if len(piston):
        low, high = float((piston if through else along[in_bore]).min()), float(piston.max())
        bottom = _face(placement, barrel_rows, line, bore, sense=1.0, before=low + _TOUCH)
        to_base = max(0.0, low - bottom) if bottom is not None else None
        gland = _face(placement, barrel_rows, line, bore, sense=-1.0, before=-high + _TOUCH)
        to_gland = max(0.0, -gland - high) if gland is not None else None
    if len(eye):
        to_eye = max(0.0, float(eye.min() - head))
    rod_diameter = 2.0 * shaft if shaft is not None else None
    return CylinderGeometry(2.0 * bore, rod_diameter, to_base, to_gland, to_eye, count=count)


def _own_axis(inside: Features, line: Axis) -> tuple[Axis, int]:
    """The line of a cylinder in the barrel, and how many equal ones there are: the line given, or, where that is midway
    between twins, one of theirs."""
    parallel = inside.take(np.linalg.norm(np.cross(inside.direction, line.direction), axis=1) < _LEAN)
    if len(parallel) == 0 or bool(parallel.exact.any() and on_axis(parallel, line).any()):
        return line, 1
    close = parallel.take(line.distance(parallel.center) < _CLOSE * parallel.radius)
    if len(close):
        own = close.center[int(np.argmax(close.area))]
        return Axis(own + float((line.point - own) @ line.direction) * line.direction, line.direction), 1
    main = int(np.argmax(parallel.area))
    alike = np.abs(parallel.radius - parallel.radius[main]) < _TWIN * parallel.radius[main]
    alike &= np.abs(parallel.length - parallel.length[main]) < _TWIN * parallel.length[main]
    lines: list[Axis] = []
    for row in np.flatnonzero(alike):
        if all(one.distance(parallel.center[row][None])[0] > parallel.radius[row] for one in lines):
            lines.append(Axis(parallel.center[row], line.direction))
    own = Axis(parallel.center[main], line.direction)
    return Axis(own.foot(line.point), own.direction), len(lines)


def _solid(tubes: Features, shafts: Features, shell: Floats, rod: Floats, line: Axis, count: int) -> CylinderGeometry:
    """What a cylinder shows whose barrel is drawn without a bore."""
    outer = float(tubes.radius[int(np.argmax(tubes.area))])
    head = _extent(shell, line, _FIT * outer)[1]
    thin = shafts.take(shafts.radius < outer / _FIT)
    out = thin.take(line.along(thin.center) + thin.length / 2 > head + _TOUCH)
    shaft = float(out.radius[int(np.argmax(out.length))]) if len(out) else None
    to_eye = None
    if shaft is not None:
        along, radial = line.along(rod), line.distance(rod)
        # A rod part may hold its twin, too: that is no eye.
        eye = (
            along[(radial > shaft * _OVER_SOLID) & (radial < 3.0 * outer) & (along >= head)]
            if count == 1
            else along[:0]
        )
        to_eye = max(0.0, float(eye.min() - head)) if len(eye) else None
    rod_diameter = 2.0 * shaft if shaft is not None else None
    return CylinderGeometry(None, rod_diameter, to_eye=to_eye, outer=2.0 * outer, count=count)


def _thickness(shell: Floats, line: Axis) -> float | None:
    """How thick a barrel (n, 3) is across its line that shows nothing round: the smaller of its two widths, halfway
    along where there are points. None for what is no barrel by its shape."""
    if len(shell) < _CORNERS:
        return None
    along = line.along(shell)
    low, high = float(along.min()), float(along.max())
    inner = np.abs(along - 0.5 * (low + high)) < 0.25 * (high - low)
    points = shell[inner] if inner.sum() >= _CORNERS else shell
    across = points - np.outer(points @ line.direction, line.direction)
    _, _, ways = np.linalg.svd(across - across.mean(axis=0), full_matrices=False)
    width = float(np.ptp(across @ ways[:2].T, axis=0).min())
    return width if 0.0 < width < _SLENDER * (high - low) else None


def _bore(bores: Features, shafts: Features, line: Axis, start: float, head: float) -> float | None:
    """Radius of the cylinder's bore: that of the barrel's longest hole, or of a piston inside that is larger. A hole
    that runs through less than a third of the barrel is a gland or a cap."""
    within = np.abs(line.along(shafts.center) - 0.5 * (start + head)) + shafts.length / 2 < 0.5 * (head - start)
    long = bores.radius[bores.length > (head - start) / 3.0]
    piston = float(shafts.radius[within].max()) if within.any() else 0.0
    if len(long) == 0:
        return piston if piston > bores.radius.min() * _OVER_ROD else None
    largest = float(long.max())
    return piston if piston > largest * _FIT else largest


def _extent(shell: Floats, line: Axis, radius: float) -> tuple[float, float]:
    """From where to where a barrel reaches along its line; ports and pipes farther out than a radius left out."""
    along = line.along(shell)[line.distance(shell) < radius]
    return (float(along.min()), float(along.max())) if len(along) else (0.0, 0.0)


def _gland(bores: Features, bore: float) -> float | None:
    """Radius of the smallest hole that is coaxial with a bore, where the rod runs; None if there is none."""
    smaller = bores.radius[bores.radius < bore / _FIT]
    return float(smaller.min()) if len(smaller) else None


def _face(
    placement: Placement, rows: Sequence[int], line: Axis, radius: float, *, sense: float, before: float
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
