"""Where a joint's axis may be: what a person's clicks on the machine mean, and the round things near a joint."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import CylinderFeature, Floats, Shape
from yellowiron.support.vectors import line_through, triple

_OFF = 0.12
"""Of a round thing's radius: so far from its surface a click still means it, and no less than `_LEAST`."""
_LEAST = 2e-3
_PARALLEL = 0.9998
_ONE_LINE = 3e-3
"""Cosine and metres within which two axes are one line."""
_FARTHEST = 1e6
"""Metres from a part's origin."""
_ROUND = 1.0
"""Radians: less of an arc shows no axis to offer."""
_SHARP = 0.9
"""Cosine of the angle between two triangles from which they meet in an edge."""


@dataclass(frozen=True, eq=False)
class Pick:
    """A place that was clicked: a part, a point (3,) of its surface in its own frame, metres; whether the edge near it
    is meant."""

    part: str
    point: Floats
    edge: bool = False


@dataclass(frozen=True)
class FoundAxis:
    """An axis: `entry`, as a document of joints says it; `words` for a person; and, to draw it, a point and a unit
    direction in the frame of the part that it was found on."""

    entry: Mapping[str, Any]
    words: str
    part: str
    point: tuple[float, float, float]
    direction: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class RoundLine:
    """Round things of some parts about one line, CAD file's frame: a point (3,), a unit direction (3,), the radii by
    part."""

    point: Floats
    direction: Floats
    radii: Mapping[str, float]


def read_picks(entry: object, assembly: Assembly) -> list[Pick]:
    """Clicks as the page sends them. `YellowironError` for what is none."""
    parts = {part.id for part in assembly.parts}
    said = entry.get("picks") if isinstance(entry, Mapping) else None
    if not isinstance(said, list) or not 1 <= len(said) <= 3:
        raise _unclear("Click a bore, two round things or points of the axis, or three points of a circle")
    picks = []
    for one in said:
        point = one.get("point") if isinstance(one, Mapping) else None
        if not isinstance(point, list) or len(point) != 3 or not all(map(_is_place, point)):
            raise _unclear("A click has no place")
        place = np.array(point, dtype=np.float64)
        if str(one.get("part")) not in parts:
            raise _unclear("A click met no part of the CAD model")
        picks.append(Pick(str(one["part"]), place, bool(one.get("edge"))))
    return picks


def axis_of(picks: Sequence[Pick], assembly: Assembly) -> FoundAxis:
    """The axis that clicks mean: of a round thing; along an edge; through the middles of two round things; through two
    points; of a circle through three. `YellowironError` where they mean none."""
    first = picks[0]
    part = assembly.part(first.part)
    if len(picks) == 1:
        return _edge(first, part, assembly) if first.edge else _round(first, part, assembly)
    rounds = [_round_at(pick, assembly.shape_of(assembly.part(pick.part))) for pick in picks]
    points = [_world(assembly.part(pick.part), pick.point) for pick in picks]
    if len(picks) == 2 and all(one is not None for one in rounds):
        points = [
            _world(assembly.part(pick.part), np.array(one.center))
            for pick, one in zip(picks, rounds, strict=True) if one is not None
        ]  # fmt: skip
        words = "Through the middles of two round things"
    else:
        words = "Through two points" if len(picks) == 2 else "Of the circle through three points"
    line = line_through(np.array(points))
    if line is None:
        raise _unclear("The points are one, or on one line")
    return _found({"through": [plain(point) for point in points]}, words, part, *line)


def plain(vector: Iterable[float]) -> list[float]:
    """Numbers as files have them: metres to a nanometre at a metre."""
    return [float(f"{v:.9g}") for v in vector]


def lines_near(
    parts: Iterable[Part], assembly: Assembly, *, direction: Floats | None = None, within: float = 0.985
) -> list[RoundLine]:
    """The lines about which something of some parts is round, things about one line together; only those along a
    direction (3,), if there is one, to a cosine."""
    lines: list[tuple[Floats, Floats, dict[str, float]]] = []
    for part in parts:
        turn = part.transform[:3, :3]
        scale = float(np.cbrt(abs(np.linalg.det(turn))))
        for feature in assembly.shape_of(part).cylinders:
            if feature.arc < _ROUND:
                continue
            along = turn @ np.array(feature.direction)
            along = along / (np.linalg.norm(along) or 1.0)
            if direction is not None and abs(float(along @ direction)) < within:
                continue
            at, radius = _world(part, np.array(feature.center)), scale * feature.radius
            for point, other, radii in lines:
                offset = at - point
                apart = float(np.linalg.norm(offset - (offset @ other) * other))
                if abs(float(along @ other)) > _PARALLEL and apart < max(_ONE_LINE, 0.05 * radius):
                    radii[part.id] = min(radius, radii.get(part.id, np.inf))
                    break
            else:
                lines.append((at, along, {part.id: radius}))
    return [RoundLine(*line) for line in lines]


def found_axis(entry: Mapping[str, Any], words: str, part: Part, line: RoundLine) -> FoundAxis:
    """A line as the axis that a click would have found on one of its parts."""
    return _found(entry, words, part, line.point, line.direction)


def _round(pick: Pick, part: Part, assembly: Assembly) -> FoundAxis:
    feature = _round_at(pick, assembly.shape_of(part))
    if feature is None:
        raise _unclear("Nothing is round there: click a second point of the axis, or three of a circle")
    center, direction = _world(part, np.array(feature.center)), part.transform[:3, :3] @ np.array(feature.direction)
    direction = direction / np.linalg.norm(direction)
    scale = float(np.cbrt(abs(np.linalg.det(part.transform[:3, :3]))))
    kind = "Bore" if feature.inner else "Round"
    words = f"{kind} of {2e3 * scale * feature.radius:.4g} mm in {part.name}"
    return _found({"anchor": plain(center), "axis": plain(direction)}, words, part, center, direction)


def _round_at(pick: Pick, shape: Shape) -> CylinderFeature | None:
    """The round thing of a shape that a point of its surface lies on, or on whose rim it lies."""
    best, least = None, np.inf
    for feature in (*shape.cylinders, *shape.knuckles):
        along, offset = np.array(feature.direction), pick.point - np.array(feature.point)
        height = float(offset @ along)
        reach = max(_OFF * feature.radius, _LEAST)
        beyond = max(feature.lower - height, height - feature.upper, 0.0)
        off = abs(float(np.linalg.norm(offset - height * along)) - feature.radius)
        if off <= reach and beyond <= reach and off + beyond < least:
            best, least = feature, off + beyond
    return best


def _edge(pick: Pick, part: Part, assembly: Assembly) -> FoundAxis:
    """Along the sharp edge of a mesh that is nearest to a point."""
    mesh = assembly.shape_of(part).mesh
    corners = mesh.points[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-30)[:, None]
    _, same = np.unique(np.round(mesh.points / 1e-6).astype(np.int64), axis=0, return_inverse=True)
    sides = np.sort(same.reshape(-1)[mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)], axis=1)
    ends = mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    _, number, count = np.unique(sides, axis=0, return_inverse=True, return_counts=True)
    total = np.zeros((len(count), 3))
    np.add.at(total, number.reshape(-1), np.repeat(normals, 3, axis=0))
    # Two triangles that are in one plane add up to twice a unit vector.
    sharp = (count != 2) | (np.linalg.norm(total, axis=1) < 2.0 * np.sqrt(0.5 * (1.0 + _SHARP)))
    a, b = (mesh.points[ends[sharp[number.reshape(-1)], k]] for k in (0, 1))
    if not len(a):
        raise _unclear("This part has no edge")
    along = b - a
    squared = np.maximum(np.einsum("ij,ij->i", along, along), 1e-30)
    share = np.clip(np.einsum("ij,ij->i", pick.point - a, along) / squared, 0.0, 1.0)
    nearest = int(np.argmin(np.linalg.norm(a + share[:, None] * along - pick.point, axis=1)))
    edge = [_world(part, end[nearest]) for end in (a, b)]
    line = line_through(np.array(edge))
    if line is None:
        raise _unclear("The edge there is too short")
    return _found({"through": [plain(end) for end in edge]}, f"Along an edge of {part.name}", part, *line)


def _found(entry: Mapping[str, Any], words: str, part: Part, point: Floats, direction: Floats) -> FoundAxis:
    back = np.linalg.inv(part.transform)
    local = back[:3, :3] @ direction
    return FoundAxis(
        entry, words, part.id, triple(back[:3, :3] @ point + back[:3, 3]), triple(local / np.linalg.norm(local))
    )


def _world(part: Part, point: Floats) -> Floats:
    return np.asarray(part.transform[:3, :3] @ point + part.transform[:3, 3])


def _is_place(value: object) -> bool:
    return isinstance(value, int | float) and abs(value) < _FARTHEST


def _unclear(words: str) -> YellowironError:
    return YellowironError(f"{words}.", where="studio", hint="Click again, or type the axis.")
