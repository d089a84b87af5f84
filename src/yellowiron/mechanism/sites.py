"""Sites: named frames on bodies, from the template's rules. Machine frame, metres."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from yellowiron.mechanism.joints.axes import Axis
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.placement import Placement, ancestors
from yellowiron.mechanism.tolerances import PARALLEL
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Site
from yellowiron.model.rows import member
from yellowiron.model.template import SiteTemplate, Template
from yellowiron.support.vectors import clean_triple

_END = 0.02
"""Share of a body's width that is its left or right end."""
_EDGE = 5e-4
"""Points this near to the farthest one belong to the edge, metres."""
_ALIKE = 1e-3
"""Relative difference of the lengths by which parts are compared up to which they are congruent."""
_LENGTHS = 5
"""Lengths by which parts are compared: of volume, area and the three principal moments."""
_ON_PLANE = 1e-3
"""A plane this near to the edge contains it, metres."""
_FACING = math.cos(math.radians(50.0))
"""Cosine up to which a plane faces a way: forks are drawn tilted by less than 40°."""
_SAME = 1e-6
"""Cosine's lack up to which two planes face the same way (0.08°)."""
_ACROSS = math.sin(PARALLEL)
"""Sine of the angle up to which a plane is parallel to the joint's axis."""


def sites(
    template: Template, frames: Mapping[str, JointFrame], placement: Placement, findings: list[Finding]
) -> tuple[Site, ...]:
    """The template's sites whose place was found."""
    result = []
    for entry in template.sites:
        site = _site(entry, frames, template, placement, findings) if placement.has_body(entry.body) else None
        if site is None:
            words = f"The site's place on '{entry.body}' was not found: what is measured there is missing."
            hint = "Check the parts of that body in the alignment."
            findings.append(Finding("MEC040", "warning", entry.name, words, hint))
        else:
            result.append(site)
    return tuple(result)


def _site(
    entry: SiteTemplate,
    frames: Mapping[str, JointFrame],
    template: Template,
    placement: Placement,
    findings: list[Finding],
) -> Site | None:
    rule = entry.rule
    if "point" in rule:
        return Site(
            entry.name,
            entry.body,
            clean_triple(np.array(rule["point"], dtype=np.float64)),
            source="template: point",
        )
    if "middle_of" in rule:
        return _middle_site(entry, placement)
    if "floor_of" in rule:
        return _floor_site(entry, placement)
    if "foremost" in rule:
        return _foremost_site(entry, placement)
    if "heel" in rule:
        return _heel_site(entry, placement)
    if "corner" in rule:
        return _corner_site(entry, placement)
    name = next((rule[key] for key in ("joint", "along", "pointing", "edge_from", "inside_from") if key in rule), "")
    if isinstance(name, tuple):
        name = next((each for each in name if each in frames), name[0])
    frame = frames.get(name)
    if frame is None:
        return None
    if "joint" in rule:
        return Site(entry.name, entry.body, clean_triple(frame.anchor), source=f"anchor of {name}")
    if "along" in rule:
        return _upright_site(entry, frame)
    if "pointing" in rule:
        x_axis = frame.axis if frame.axis[0] >= 0.0 else -frame.axis
        z_axis = np.cross(x_axis, (0.0, 1.0, 0.0))
        source = f"pointing along {name}"
        return Site(
            entry.name, entry.body, clean_triple(frame.anchor), clean_triple(x_axis), clean_triple(z_axis), source
        )
    spanning = float(rule.get("spanning", 0.8))
    if "inside_from" in rule:
        return _inside_site(entry, frame, spanning, placement)
    edge = _edge_site(entry, frame, spanning, template, placement, findings)
    return _at_tip(edge, frame, placement, low=rule["tip"] == "low") if edge and rule.get("tip") else edge


def _upright_site(entry: SiteTemplate, frame: JointFrame) -> Site | None:
    """At a slide's anchor: z along the slide, upwards, x square to it in the machine's long plane, forwards."""
    up = frame.axis if frame.axis[2] >= 0.0 else -frame.axis
    ahead = np.cross((0.0, 1.0, 0.0), up)
    if not np.linalg.norm(ahead) > 0.0:
        return None
    ahead /= np.linalg.norm(ahead)
    source = f"upright along {frame.joint.name}"
    return Site(entry.name, entry.body, clean_triple(frame.anchor), clean_triple(ahead), clean_triple(up), source)


def _middle_site(entry: SiteTemplate, placement: Placement) -> Site | None:
    """The middle of the box around a role's parts, or around the last part of the row `if_high` where they stand higher
    above the ground than half their height: a track with its sprocket on top ends at the last wheel on the ground."""
    name = str(entry.rule["middle_of"])
    points = placement.points_of(placement.rows_of_role(name))
    row = str(entry.rule.get("if_high", ""))
    if row and len(points) and float(points[:, 2].min()) > 0.5 * float(np.ptp(points[:, 2])):
        number = 1
        while placement.rows_of_role(member(row, number + 1)):
            number += 1
        last = placement.points_of(placement.rows_of_role(member(row, number)))
        name, points = (member(row, number), last) if len(last) else (name, points)
    if not len(points):
        return None
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    return Site(entry.name, entry.body, clean_triple(middle), source=f"middle of {name}")


def _floor_site(entry: SiteTemplate, placement: Placement) -> Site | None:
    """On the widest plane that faces up of those in the lower half of a role's parts, of a body's where the role is
    one: under or over the middle of these parts, x along the plane, forwards."""
    role = str(entry.rule["floor_of"])
    rows = placement.rows_of_body(role) if role == entry.body else placement.rows_of_role(role)
    if not len(rows):
        return None
    corners = placement.points_of(tuple(rows))
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    points, normals, areas = (np.concatenate(each) for each in zip(*map(placement.planes, rows), strict=True))
    widest = _widest(points, normals, areas, (normals[:, 2] > _FACING) & (points[:, 2] < middle[2]))
    if widest is None:
        return None
    up, height = widest
    middle[2] = (height - up[:2] @ middle[:2]) / up[2]
    x_axis = np.cross((0.0, 1.0, 0.0), up)
    x_axis /= np.linalg.norm(x_axis)
    source = f"floor of '{role}'"
    return Site(entry.name, entry.body, clean_triple(middle), clean_triple(x_axis), clean_triple(up), source)


def _foremost_site(entry: SiteTemplate, placement: Placement) -> Site:
    """The middle of the box around those of a body's parts that reach as far ahead as it does, within a share of its
    length: a truck's forks."""
    low, high = placement.boxes
    ahead = _foremost(entry.body, float(entry.rule["foremost"]), placement)
    middle = 0.5 * (low[ahead].min(axis=0) + high[ahead].max(axis=0))
    source = f"middle of {_named(ahead, placement)}, the foremost"
    return Site(entry.name, entry.body, clean_triple(middle), source=source)


def _corner_site(entry: SiteTemplate, placement: Placement) -> Site:
    """Of a body's points near its left or right end the one farthest down and ahead, whichever way it is pitched: a
    blade's corner; or midway between both."""
    points = placement.points_of(placement.rows_of_body(entry.body))
    across = points[:, 1]
    near = _END * float(across.max() - across.min())
    ends = {"l": points[across >= across.max() - near], "r": points[across <= across.min() + near]}
    corners = {}
    for side, end in ends.items():
        ahead = end[:, 0] - end[:, 2]
        tip = end[ahead >= ahead.max() - _EDGE]
        corners[side] = tip[np.argmax(tip[:, 1] if side == "l" else -tip[:, 1])]
    which = str(entry.rule["corner"])
    position = corners[which] if which in corners else 0.5 * (corners["l"] + corners["r"])
    return Site(entry.name, entry.body, clean_triple(position), source=f"corner of '{entry.body}': {which}")


def _foremost(body: str, share: float, placement: Placement) -> list[int]:
    low, high = placement.boxes
    rows = [row for row in placement.rows_of_body(body) if np.isfinite(low[row]).all()]
    front = high[rows, 0].max() - share * (high[rows, 0].max() - low[rows, 0].min())
    return [row for row in rows if high[row, 0] >= front]


def _named(rows: Sequence[int], placement: Placement) -> str:
    return placement.parts[rows[0]].id + (f" and {len(rows) - 1} more" if len(rows) > 1 else "")


def _heel_site(entry: SiteTemplate, placement: Placement) -> Site | None:
    """Of the foremost parts, a truck's forks: where the widest plane that faces up meets the widest of their rear half
    that faces ahead, or where they end at the rear; in their middle across; x along the first plane, forwards."""
    ahead = _foremost(entry.body, float(entry.rule["heel"]), placement)
    low, high = (corner[ahead] for corner in placement.boxes)
    found = zip(*(placement.planes(row) for row in ahead), strict=True)
    points, normals, areas = (np.concatenate(each) for each in found)
    square = np.abs(normals[:, 1]) < _ACROSS
    top = _widest(points, normals, areas, square & (normals[:, 2] > _FACING))
    if top is None:
        return None
    up, height = top
    behind = points[:, 0] < 0.5 * (low[:, 0].min() + high[:, 0].max())
    face = _widest(points, normals, areas, square & (normals[:, 0] > _FACING) & behind)
    level = np.array([0.0, 1.0, 0.0])
    x_axis = np.cross(level, up)
    normal, reach = face or (x_axis, float((placement.points_of(tuple(ahead)) @ x_axis).min()))
    across = 0.5 * (low[:, 1].min() + high[:, 1].max())
    place = np.linalg.solve([up, normal, level], [height, reach, across])
    source = f"heel of {_named(ahead, placement)}, the foremost"
    return Site(entry.name, entry.body, clean_triple(place), clean_triple(x_axis), clean_triple(up), source)


def _widest(points: Floats, normals: Floats, areas: Floats, chosen: NDArray[np.bool_]) -> tuple[Floats, float] | None:
    """Of the chosen faces the plane with most area: its normal and its place along it. Facets of one plane count
    together."""
    if not chosen.any():
        return None
    own, offsets = normals[chosen], np.sum(points[chosen] * normals[chosen], axis=1)
    alike = (own @ own.T > 1.0 - _SAME) & (np.abs(offsets[:, None] - offsets[None, :]) < _ON_PLANE)
    widest = int(np.argmax(alike @ areas[chosen]))
    return own[widest], float(offsets[widest])


def _at_tip(edge: Site, frame: JointFrame, placement: Placement, *, low: bool) -> Site:
    """The edge's site moved to the body's points farthest from the joint's axis (the teeth, whatever part they are
    of), in their middle along it; `low`: of those below it as drawn, where there are any (a ripper's shanks, whose
    carrier may reach farther up)."""
    line = Axis(frame.anchor, frame.axis)
    points = placement.points_of(placement.rows_of_body(edge.body))
    below = points[:, 2] < frame.anchor[2]
    points = points[below] if low and below.any() else points
    distance = line.distance(points)
    tip = _one_edge(points[distance > distance.max() - _EDGE], line)
    along = line.along(tip)
    position = tip.mean(axis=0) + (0.5 * (along.min() + along.max()) - along.mean()) * line.direction
    return replace(edge, position=clean_triple(position), source=f"{edge.source}; at the body's farthest point")


def _inside_site(entry: SiteTemplate, frame: JointFrame, spanning: float, placement: Placement) -> Site | None:
    """The middle of what a body's wide parts enclose (a bucket's floor, back and edge; of rows such as teeth no part is
    wide): of their common hull without their own solids. All parts where none is wide."""
    rows = placement.rows_of_body(entry.body)
    line = Axis(frame.anchor, frame.axis)
    wide = [g[0] for g in _wide_groups(rows, line, spanning, placement) if len(g) == 1] or list(rows)
    points = placement.points_of(tuple(wide))
    try:
        hull = ConvexHull(points)
    except QhullError:
        return None
    middle = points[hull.vertices].mean(axis=0)
    corners = points[hull.simplices] - middle
    volumes = np.abs(np.linalg.det(corners)) / 6.0
    first = volumes @ (corners.sum(axis=1) / 4.0 + middle)
    volume = float(volumes.sum())
    for row in wide:
        shape, matrix = placement.shapes[row], placement.transforms[row]
        solid = abs(float(np.linalg.det(matrix[:3, :3]))) * shape.volume if shape.closed else 0.0
        if solid < 0.5 * volume:
            volume -= solid
            first = first - solid * (matrix[:3, :3] @ shape.centroid + matrix[:3, 3])
    also = f" and {len(wide) - 1} more" if len(wide) > 1 else ""
    source = f"middle of the {volume:.2f} m³ that {placement.parts[wide[0]].id}{also} enclose"
    return Site(entry.name, entry.body, clean_triple(first / volume), source=source)


@dataclass(frozen=True, eq=False)
class _Edge:
    """A far edge of a wide part: its middle, and the plane that ends in it (its normal and its area on the whole
    body)."""

    rows: tuple[int, ...]
    position: Floats
    distance: float
    normal: Floats | None
    area: float


@dataclass(frozen=True, eq=False)
class _Planes:
    """Planes: a point (n, 3) and the unit normal (n, 3) of each, and the area (n,) that lies in it."""

    points: Floats
    normals: Floats
    areas: Floats


def _edge_site(
    entry: SiteTemplate,
    frame: JointFrame,
    spanning: float,
    template: Template,
    placement: Placement,
    findings: list[Finding],
) -> Site | None:
    """A body's cutting edge, at its middle: x along the plane that ends in it, away from the joint's axis.

    Every wide part (or row of equal parts, such as teeth) has an edge farthest from the axis. The cutting edge is where
    the widest plane ends, a bucket's floor; of the edges in that plane the farthest. Parts of an `edge` role, where the
    alignment knows any, rule other planes out.
    """
    line = Axis(frame.anchor, frame.axis)
    rows = placement.rows_of_body(entry.body)
    groups = _wide_groups(rows, line, spanning, placement)
    if not groups:
        return None
    planes = _planes_along(rows, line, placement)
    edges = [_far_edge(group, planes, line, placement) for group in groups]
    blades = [row for row in rows if (chain := ancestors(template, placement.roles[row])) and chain[0].kind == "edge"]
    blade = _planes_along(blades, line, placement)
    cutting = [e for e in edges if len(_through(e.position, blade))] or edges
    widest = max(cutting, key=lambda e: (e.area, e.distance))
    if widest.normal is None:
        widest = max(cutting, key=lambda e: e.distance)
        words = "No plane of the body ends in its edge: angles are taken from the line between hinge and edge."
        findings.append(Finding("MEC041", "warning", entry.name, words))
        edge, x_axis = widest, widest.position - line.foot(widest.position)
    else:
        normal = widest.normal
        level = [e for e in cutting if abs((e.position - widest.position) @ normal) < _ON_PLANE]
        edge = max(level, key=lambda e: e.distance)
        x_axis = np.cross(line.direction, normal)
        x_axis = x_axis if x_axis @ (edge.position - line.foot(edge.position)) > 0.0 else -x_axis
    x_axis = x_axis - (x_axis @ line.direction) * line.direction
    x_axis /= np.linalg.norm(x_axis)
    also = f" and {len(edge.rows) - 1} like it" if len(edge.rows) > 1 else ""
    return Site(
        name=entry.name,
        body=entry.body,
        position=clean_triple(edge.position),
        x_axis=clean_triple(x_axis),
        z_axis=clean_triple(np.cross(x_axis, line.direction)),
        source=f"edge of {placement.parts[edge.rows[0]].id}{also}, far from {frame.joint.name}",
    )


def _far_edge(group: tuple[int, ...], planes: _Planes, line: Axis, placement: Placement) -> _Edge:
    """The edge of a wide part, or row of equal parts, that is farthest from a line."""
    points = placement.points_of(group)
    distance = line.distance(points)
    tip = _one_edge(points[distance > distance.max() - _EDGE], line)
    along = line.along(tip)
    middle = 0.5 * (along.min() + along.max())
    position = tip.mean(axis=0) + (middle - along.mean()) * line.direction
    normal, area = _plane_at(position, planes)
    return _Edge(group, position, float(distance.max()), normal, area)


def _one_edge(tip: Floats, line: Axis) -> Floats:
    """Of points equally far from a line those on one parallel to it: of several edges the foremost, then the lowest."""
    across = tip - np.outer(line.along(tip), line.direction)
    order = np.lexsort((across[:, 2], np.round(-across[:, 0] / _EDGE)))
    return np.asarray(tip[np.linalg.norm(across - across[order[0]], axis=1) < 4.0 * _EDGE], dtype=np.float64)


def _wide_groups(rows: Sequence[int], line: Axis, spanning: float, placement: Placement) -> list[tuple[int, ...]]:
    """Parts that span a share of the body's width along the axis, alone or as a row of congruent parts (a CAD model may
    draw every tooth as a part of its own, turned or mirrored)."""
    reach = {row: (line.along(p := placement.points(row)).min(), line.along(p).max()) for row in rows}
    width = max(high for _, high in reach.values()) - min(low for low, _ in reach.values())
    alike: list[list[int]] = []
    first = np.empty((len(rows), _LENGTHS))
    of_shape: dict[str, int] = {}
    for row in rows:
        key, size = placement.shapes[row].key, _invariants(row, placement)
        firsts = first[: len(alike)]
        equal = np.all(np.abs(firsts - size) <= _ALIKE * np.maximum(firsts, size), axis=1)
        number = min(of_shape.get(key, len(alike)), int(np.argmax(equal)) if equal.any() else len(alike))
        if number == len(alike):
            first[number] = size
            of_shape[key] = number
            alike.append([])
        alike[number].append(row)
    wide = []
    for equal in alike:
        covered = max(reach[r][1] for r in equal) - min(reach[r][0] for r in equal)
        if covered >= spanning * width:
            wide.append(tuple(equal))
    return wide


def _invariants(row: int, placement: Placement) -> Floats:
    """What turning and mirroring leave of a placed part: the lengths (m) that its volume, its area and its principal
    moments of inertia make, the latter in order."""
    shape = placement.shapes[row]
    scale = abs(np.linalg.det(placement.transforms[row][:3, :3])) ** (1.0 / 3.0)
    moments = np.sort(np.abs(np.linalg.eigvalsh(0.5 * (shape.inertia + shape.inertia.T))))
    lengths = [abs(shape.volume) ** (1.0 / 3.0), math.sqrt(abs(shape.area)), *moments**0.2]
    return scale * np.array(lengths, dtype=np.float64)


def _plane_at(position: Floats, planes: _Planes) -> tuple[Floats | None, float]:
    """The plane through an edge on which most area of some planes is: (normal, area), or (None, 0)."""
    found: list[tuple[Floats, float]] = []
    for index in _through(position, planes).tolist():
        normal, area = planes.normals[index], float(planes.areas[index])
        for i, (other, total) in enumerate(found):
            if np.linalg.norm(np.cross(normal, other)) < _ACROSS:
                found[i] = (other, total + area)
                break
        else:
            found.append((normal, area))
    return max(found, key=lambda pair: pair[1]) if found else (None, 0.0)


def _planes_along(rows: Sequence[int], line: Axis, placement: Placement) -> _Planes:
    """Parts' planes that are parallel to a line, part by part: planar faces, else facets."""
    none = (np.zeros((0, 3)), np.zeros((0, 3)), np.zeros(0))
    points, normals, areas = (np.concatenate(c) for c in zip(none, *map(placement.planes, rows), strict=True))
    along = np.abs(normals @ line.direction) < _ACROSS
    return _Planes(points[along], normals[along], areas[along])


def _through(position: Floats, planes: _Planes) -> NDArray[np.intp]:
    """Which of some planes go through an edge."""
    return np.flatnonzero(np.abs(np.sum((position - planes.points) * planes.normals, axis=1)) < _ON_PLANE)
