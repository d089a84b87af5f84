"""Sites: named frames on bodies, from the template's rules. Machine frame, metres."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.mechanism.axes import Line
from yellowiron.mechanism.body import vector
from yellowiron.mechanism.frames import JointFrame
from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Site
from yellowiron.model.template import SiteTemplate, Template

_EDGE = 1e-4
"""Points this near to the farthest one belong to the edge, metres."""
_ON_PLANE = 1e-3
"""A plane this near to the edge contains it, metres."""
_ACROSS = math.sin(math.radians(0.5))
"""Sine of the angle up to which a plane is parallel to the joint's axis."""


def sites(
    template: Template, frames: Mapping[str, JointFrame], placement: Placement, findings: list[Finding]
) -> tuple[Site, ...]:
    """The template's sites whose place was found."""
    result = []
    for entry in template.sites:
        site = _site(entry, frames, placement, findings) if placement.has_body(entry.body) else None
        if site is None:
            findings.append(
                Finding(
                    "MEC040",
                    "warning",
                    entry.name,
                    f"The site's place on '{entry.body}' was not found: what is measured there is missing.",
                    "Check the parts of that body in the alignment.",
                )
            )
        else:
            result.append(site)
    return tuple(result)


def _site(
    entry: SiteTemplate, frames: Mapping[str, JointFrame], placement: Placement, findings: list[Finding]
) -> Site | None:
    rule = entry.rule
    if "point" in rule:
        return Site(entry.name, entry.body, vector(np.array(rule["point"], dtype=np.float64)), source="template: point")
    name = rule.get("joint", rule.get("edge_from"))
    frame = frames.get(name)
    if frame is None:
        return None
    if "joint" in rule:
        return Site(entry.name, entry.body, vector(frame.anchor), source=f"anchor of {name}")
    return _edge_site(entry, frame, float(rule.get("spanning", 0.8)), placement, findings)


def _edge_site(
    entry: SiteTemplate, frame: JointFrame, spanning: float, placement: Placement, findings: list[Finding]
) -> Site | None:
    """The body's edge farthest from a joint's axis: at its middle, x along the plane that ends in it, away from the
    axis."""
    line = Line(frame.anchor, frame.axis)
    rows = placement.rows_of_body(entry.body)
    wide = _wide_rows(rows, line, spanning, placement)
    points = placement.points_of(wide)
    if len(points) == 0:
        return None
    distance = line.distance(points)
    tip = _one_edge(points[distance > distance.max() - _EDGE], line)
    along = line.along(tip)
    middle = 0.5 * (along.min() + along.max())
    position = tip.mean(axis=0) + (middle - along.mean()) * line.direction
    outwards = position - line.at(float(middle))
    normal = _plane_at(position, line, rows, placement)
    if normal is None:
        findings.append(
            Finding(
                "MEC041",
                "warning",
                entry.name,
                "No plane of the body ends in its edge: angles are taken from the line between hinge and edge.",
            )
        )
        x_axis = outwards
    else:
        x_axis = np.cross(line.direction, normal)
        x_axis = x_axis if x_axis @ outwards > 0.0 else -x_axis
    x_axis = x_axis - (x_axis @ line.direction) * line.direction
    x_axis /= np.linalg.norm(x_axis)
    parts = ", ".join(placement.ids(row for row in wide if _reaches(placement.points(row), line, distance.max())))
    return Site(
        name=entry.name,
        body=entry.body,
        position=vector(position),
        x_axis=vector(x_axis),
        z_axis=vector(np.cross(x_axis, line.direction)),
        source=f"edge of {parts}, farthest from {frame.joint.name}",
    )


def _one_edge(tip: Floats, line: Line) -> Floats:
    """Of points equally far from a line those on one parallel to it: of several edges the foremost, then the lowest."""
    across = tip - np.outer(line.along(tip), line.direction)
    order = np.lexsort((across[:, 2], np.round(-across[:, 0] / _EDGE)))
    return np.asarray(tip[np.linalg.norm(across - across[order[0]], axis=1) < 10.0 * _EDGE], dtype=np.float64)


def _reaches(points: Floats, line: Line, distance: float) -> bool:
    return bool(line.distance(points).max() > distance - _EDGE)


def _wide_rows(rows: Sequence[int], line: Line, spanning: float, placement: Placement) -> list[int]:
    """Parts that span a share of the body's width along the axis, alone or as a row of equal parts (teeth)."""
    reach = {row: (line.along(p := placement.points(row)).min(), line.along(p).max()) for row in rows}
    width = max(high for _, high in reach.values()) - min(low for low, _ in reach.values())
    alike: dict[str, list[int]] = {}
    for row in rows:
        alike.setdefault(placement.shapes[row].key, []).append(row)
    wide = []
    for equal in alike.values():
        covered = max(reach[r][1] for r in equal) - min(reach[r][0] for r in equal)
        if covered >= spanning * width:
            wide += equal
    return sorted(wide)


def _plane_at(position: Floats, line: Line, rows: Sequence[int], placement: Placement) -> Floats | None:
    """Normal of the plane through the edge, parallel to the axis, on which the body has most area; None without any."""
    found: list[tuple[Floats, float]] = []
    for row in rows:
        for normal, area in _planes_through(position, line, row, placement):
            for i, (other, total) in enumerate(found):
                if np.linalg.norm(np.cross(normal, other)) < _ACROSS:
                    found[i] = (other, total + area)
                    break
            else:
                found.append((normal, area))
    return max(found, key=lambda pair: pair[1])[0] if found else None


def _planes_through(position: Floats, line: Line, row: int, placement: Placement) -> list[tuple[Floats, float]]:
    """(normal, area) of one part's planes through the edge: its planar faces, else its facets."""
    shape, matrix = placement.shapes[row], placement.transforms[row]
    if shape.planes:
        linear = matrix[:3, :3]
        inverse = np.linalg.inv(linear)
        point = np.array([p.point for p in shape.planes]) @ linear.T + matrix[:3, 3]
        normal = np.array([p.normal for p in shape.planes]) @ inverse
        stretch = np.linalg.norm(normal, axis=1)
        area = np.array([p.area for p in shape.planes]) * stretch * abs(np.linalg.det(linear))
        normal = normal / stretch[:, None]
    else:
        point, normal, area = placement.facets(row)
    through = (np.abs(normal @ line.direction) < _ACROSS) & (
        np.abs(np.sum((position - point) * normal, axis=1)) < _ON_PLANE
    )
    return [(normal[i], float(area[i])) for i in np.nonzero(through)[0]]
