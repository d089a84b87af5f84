"""Where a joint is: its axis and anchor, from its pin, else from the bores its two bodies share (DESIGN, "Where a
joint is").

Pivots first, then slides, which run from one pivot of their cylinder to the other. Machine frame, metres.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from yellowiron.mechanism.axes import (
    SAME_ANGLE,
    SAME_OFFSET,
    Line,
    axis_of,
    coaxial_groups,
    machine_sense,
    on_line,
    residuals,
    span,
    symmetry_axis,
)
from yellowiron.mechanism.placement import Features, Placement, join
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.template import JointTemplate, Template

_OUT_OF_LINE = {True: (math.radians(0.05), 1e-4), False: (math.radians(0.2), 3e-4)}
"""Angle (rad) and offset (m) from which features are out of line; exact ones, and fitted ones."""
_GAP = 0.02
"""Bores of two bodies belong to one pin only if no more than this is between them along the axis, metres."""
_RIVAL = 0.5
"""A second axis whose shared area is more than this share of the best one's makes the choice doubtful."""


@dataclass(frozen=True, eq=False)
class JointFrame:
    """A joint with its place: `bodies` in the template's order, `anchor` a point on the unit vector `axis`, `source`
    the evidence. `weight` says how well the direction is known: the square of the length (m²) that its cylinders
    span; `exact` whether any of them is one of the file's own, not one fitted to facets."""

    joint: JointTemplate
    bodies: tuple[str, str]
    anchor: Floats
    axis: Floats
    weight: float
    source: Mapping[str, Any]
    exact: bool = True


@dataclass(frozen=True, eq=False)
class _Axis:
    """An axis with its features and how it was found; `doubt` is a finding's (code, words) or None."""

    line: Line
    features: Features
    method: str
    doubt: tuple[str, str] | None = None


def joint_frames(placement: Placement, template: Template) -> tuple[dict[str, JointFrame], list[Finding]]:
    """The frame of every joint that has one, by name in template order, and what is wrong with the others."""
    findings: list[Finding] = []
    pivots: dict[str, JointFrame] = {}
    slides: list[tuple[JointTemplate, tuple[str, str]]] = []
    for joint in template.joints:
        bodies = _bodies(joint, placement, template, findings)
        if bodies is None:
            continue
        if joint.type == "prismatic":
            slides.append((joint, bodies))
        elif (frame := _pivot(joint, bodies, placement, template, findings)) is not None:
            pivots[joint.name] = frame
    found = dict(pivots)
    for joint, bodies in slides:
        rod = next((b for b in bodies if template.role(b).kind == "rod"), bodies[1])
        if (frame := _slide(joint, bodies, rod, placement, pivots, findings)) is not None:
            found[joint.name] = frame
    return {j.name: found[j.name] for j in template.joints if j.name in found}, findings


def _bodies(
    joint: JointTemplate, placement: Placement, template: Template, findings: list[Finding]
) -> tuple[str, str] | None:
    """The two bodies a joint joins, or None with a finding. An optional body that is not there takes its joints
    along."""
    roles = {r.name: r for r in template.roles}
    unknown = [part for part in joint.parts if part not in roles]
    if unknown:
        findings.append(
            Finding(
                "MEC001",
                "error",
                joint.name,
                f"The joint names '{unknown[0]}', which is no part of the template.",
                "Correct its Body.",
            )
        )
        return None
    a, b = template.bodies_of(joint)
    if a is None or b is None or a == b:
        findings.append(
            Finding(
                "MEC001",
                "error",
                joint.name,
                f"The joint does not join two bodies: '{joint.parts[0]}' and '{joint.parts[1]}' move with {a} and {b}.",
                "Name two parts of different rigid bodies.",
            )
        )
        return None
    absent = [body for body in (a, b) if not placement.has_body(body)]
    if any(not roles[body].optional for body in absent):
        findings.append(
            Finding(
                "MEC002",
                "error",
                joint.name,
                f"No part of the CAD model is '{absent[0]}': the joint is left out.",
                "Give its parts that role in the alignment.",
            )
        )
    return None if absent else (a, b)


def _pivot(
    joint: JointTemplate,
    bodies: tuple[str, str],
    placement: Placement,
    template: Template,
    findings: list[Finding],
) -> JointFrame | None:
    pins = [part for part in joint.parts if not template.role(part).rigid]
    wheel = next((part for part in joint.parts if template.role(part).kind == "wheel"), None)
    axis = _from_pin(joint, pins, bodies, placement) or _from_shared(bodies, placement)
    if axis is None and wheel is not None:
        axis = _guess(placement, placement.rows_of_body(wheel), f"symmetry axis of {wheel}")
    if axis is None:
        if joint.type == "fixed":
            return _weld(joint, bodies, placement)
        findings.append(
            Finding(
                "MEC005",
                "error",
                joint.name,
                f"No pin and no common bore of '{bodies[0]}' and '{bodies[1]}' says where the joint is: "
                "it is left out.",
                "Give its pin that role in the alignment.",
            )
        )
        return None
    _judge(joint, axis, findings)
    line = Line(axis.line.point, machine_sense(axis.line.direction))
    middle = _wheel_plane(placement, wheel, line) if wheel is not None else _middle(axis.features, line)
    return _frame(joint, bodies, placement, axis, line, middle)


def _from_pin(joint: JointTemplate, pins: list[str], bodies: tuple[str, str], placement: Placement) -> _Axis | None:
    """The axis of a joint's pin parts: of their coaxial groups the one that most parts and both bodies' bores share."""
    rows = [row for pin in pins for row in placement.rows_of_role(pin)]
    if not rows:
        return None
    features = placement.features(rows)
    around = placement.features(r for b in bodies for r in placement.rows_of_body(b) if r not in rows)
    best: tuple[tuple[int, int, float], Features] | None = None
    for group in coaxial_groups(features):
        chosen = features.take(group)
        line = axis_of(chosen)
        holders = around.take(on_line(around, line))
        held = {placement.bodies[int(r)] for r in holders.part}
        rank = (len(held), len(set(chosen.part.tolist())), float(chosen.area.sum()))
        if best is None or rank > best[0]:
            best = (rank, chosen)
    if best is None:
        shared = _from_shared(bodies, placement, near=placement.points_of(rows).mean(axis=0))
        return shared or _guess(placement, rows, f"symmetry axis of {joint.parts[1]}")
    # The pin's own cylinders fix the axis; shafts before bores, which may be a bush's or a grease hole.
    shafts = best[1].take(~best[1].inner)
    kept = shafts if len(shafts) else best[1]
    lone = set(rows) - {int(r) for r in kept.part}
    doubt = (
        ("MEC004", "Some of its pin parts are not on the common axis.") if _off_axis(placement, lone, kept) else None
    )
    return _Axis(axis_of(kept), kept, f"least squares over {len(kept)} cylinder(s) of the pin", doubt)


def _off_axis(placement: Placement, rows: set[int], kept: Features) -> bool:
    """Whether a part without a cylinder on the axis is a large one, so that it was meant to be on it."""
    return any(placement.features([row]).area.sum() > 0.5 * kept.area.sum() for row in sorted(rows))


def _from_shared(bodies: tuple[str, str], placement: Placement, *, near: Floats | None = None) -> _Axis | None:
    """The axis on which both bodies have cylinders, side by side or within each other: the one they share most area
    on, or the one nearest to a point."""
    tables = sorted((placement.features(placement.rows_of_body(b)) for b in bodies), key=len)
    ranked: list[tuple[float, Features]] = []
    for group in coaxial_groups(tables[0]):
        mine = tables[0].take(group)
        line = axis_of(mine)
        theirs = tables[1].take(on_line(tables[1], line))
        if len(theirs) == 0:
            continue
        one, other = span(mine, line), span(theirs, line)
        if max(one[0], other[0]) - min(one[1], other[1]) > _GAP:
            continue
        shared = min(float(mine.area.sum()), float(theirs.area.sum()))
        score = shared if near is None else -float(line.distance(near[None])[0])
        ranked.append((score, join((mine, theirs))))
    if not ranked:
        return None
    ranked.sort(key=lambda pair: -pair[0])
    features = ranked[0][1]
    line = axis_of(features)
    rivals = [f for score, f in ranked[1:] if near is None and score > _RIVAL * ranked[0][0]]
    doubt = ("MEC006", f"{len(rivals) + 1} axes fit it about as well; the largest was taken.") if rivals else None
    return _Axis(line, features, f"least squares over {len(features)} coaxial cylinder(s) of both bodies", doubt)


def _guess(placement: Placement, rows: tuple[int, ...] | list[int], method: str) -> _Axis | None:
    points = placement.points_of(rows)
    if len(points) < 4:
        return None
    return _Axis(
        symmetry_axis(points),
        placement.features(()),
        method,
        ("MEC003", "Its parts have no cylinder that fits: the axis is guessed from their outline."),
    )


def _slide(
    joint: JointTemplate,
    bodies: tuple[str, str],
    rod: str,
    placement: Placement,
    pivots: Mapping[str, JointFrame],
    findings: list[Finding],
) -> JointFrame | None:
    """A slide: the bore and rod they share, through which both end pivots' coordinates are read; the sense is from the
    first body's pivot to the second's."""
    ends = [_end_pivot(body, bodies, pivots) for body in bodies]
    axis = _from_shared(bodies, placement)
    if axis is not None:
        axis = _steadied(replace(axis, doubt=None), ends)
    if axis is None and ends[0] is not None and ends[1] is not None:
        between = ends[1].anchor - ends[0].anchor
        length = float(np.linalg.norm(between))
        if length > 0.0:
            axis = _Axis(
                Line(ends[0].anchor, between / length),
                placement.features(()),
                "line between its pivots",
                ("MEC003", "Its barrel and rod share no bore: the axis is the line between their pivots."),
            )
    if axis is None:
        findings.append(
            Finding(
                "MEC005",
                "error",
                joint.name,
                f"'{bodies[0]}' and '{bodies[1]}' share no bore: the slide is left out.",
                "Check which parts are barrel and rod in the alignment.",
            )
        )
        return None
    _judge(joint, axis, findings)
    tips = [
        end.anchor if end is not None else placement.points_of(placement.rows_of_body(body)).mean(axis=0)
        for end, body in zip(ends, bodies, strict=True)
    ]
    line = axis.line if (tips[1] - tips[0]) @ axis.line.direction >= 0.0 else axis.line.flipped()
    return _frame(joint, bodies, placement, axis, line, float(line.along(tips[bodies.index(rod)][None])[0]))


def _steadied(axis: _Axis, ends: list[JointFrame | None]) -> _Axis:
    """A slide's axis fitted to facets, made better by its pivots where they agree with it: they are farther apart
    than any facet is long. Exact axes stay."""
    barrel, rod = ends
    if axis.features.exact.any() or barrel is None or rod is None:
        return axis
    normal = barrel.axis
    across = rod.anchor - barrel.anchor
    across = across - (across @ normal) * normal
    length = float(np.linalg.norm(across))
    if length == 0.0:
        return axis
    through = Line(barrel.anchor + ((axis.line.point - barrel.anchor) @ normal) * normal, across / length)
    lean = float(np.linalg.norm(np.cross(through.direction, axis.line.direction)))
    apart = float(through.distance(axis.line.point[None])[0])
    if lean > math.sin(SAME_ANGLE) or apart > 2.0 * SAME_OFFSET:
        return axis
    return replace(axis, line=through, method=f"{axis.method}, steadied by its pivots")


def _end_pivot(body: str, slide: tuple[str, str], pivots: Mapping[str, JointFrame]) -> JointFrame | None:
    """The pivot by which a barrel or rod hangs on the rest of the machine."""
    other = slide[1] if body == slide[0] else slide[0]
    return next((p for p in pivots.values() if body in p.bodies and other not in p.bodies), None)


def _weld(joint: JointTemplate, bodies: tuple[str, str], placement: Placement) -> JointFrame:
    points = placement.points_of(placement.rows_of_body(bodies[1]))
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    return JointFrame(
        joint,
        bodies,
        middle,
        np.array([1.0, 0.0, 0.0]),
        0.0,
        {"template": joint.name, "method": "middle of the second body"},
    )


def _middle(features: Features, line: Line) -> float:
    return 0.5 * sum(span(features, line)) if len(features) else 0.0


def _wheel_plane(placement: Placement, wheel: str, line: Line) -> float:
    """Coordinate along a wheel's axis of its mid-plane: the middle of the part that reaches farthest from the axis."""
    rows = placement.rows_of_body(wheel)
    largest = max(rows, key=lambda row: float(line.distance(placement.points(row)).max()))
    along = line.along(placement.points(largest))
    return float(0.5 * (along.min() + along.max()))


def _judge(joint: JointTemplate, axis: _Axis, findings: list[Finding]) -> None:
    """Findings on an axis: what was doubtful about finding it, and features out of line."""
    if axis.doubt is not None:
        code, words = axis.doubt
        findings.append(Finding(code, "warning", joint.name, words, "Check its parts in the alignment."))
    if len(axis.features) == 0:
        return
    angle, offset = residuals(axis.features, axis.line)
    most = _OUT_OF_LINE[bool(axis.features.exact.any())]
    if angle > most[0] or offset > most[1]:
        findings.append(
            Finding(
                "MEC004",
                "warning",
                joint.name,
                f"Its cylinders are out of line by up to {math.degrees(angle):.3f}° and {offset * 1e3:.3f} mm.",
                "Check its parts in the alignment, and the CAD model.",
            )
        )


def _frame(
    joint: JointTemplate, bodies: tuple[str, str], placement: Placement, axis: _Axis, line: Line, coordinate: float
) -> JointFrame:
    source: dict[str, Any] = {"template": joint.name, "method": axis.method}
    weight = 0.0
    if len(axis.features):
        angle, offset = residuals(axis.features, axis.line)
        source["parts"] = placement.ids(axis.features.part)
        source["residual_deg"] = round(math.degrees(angle), 9)
        source["residual_mm"] = round(offset * 1e3, 9)
        low, high = span(axis.features, axis.line)
        weight = (high - low) ** 2
    exact = bool(axis.features.exact.any())
    return JointFrame(joint, bodies, line.at(coordinate), line.direction, weight, source, exact)
