"""The axes of a machine's joints from its bodies alone: pins or not, bores or not, whole shells or open ones."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import networkx
import numpy as np
from numpy.typing import NDArray

from yellowiron.alignment.assignment.directions import sections_of
from yellowiron.alignment.axes.bodies import Body, bodies_of
from yellowiron.alignment.axes.cylinder_lines import BY_LENGTH, cylinder_line, trunnion_of
from yellowiron.alignment.axes.directions import (
    Direction,
    as_found,
    completed,
    direction_of,
    is_upright,
    linkages_of,
    wheels_beside,
)
from yellowiron.alignment.axes.hinges import AT_PIVOT, Clues, bars_between, eye_of, hinge_candidates
from yellowiron.alignment.axes.levers import with_levers
from yellowiron.alignment.axes.pivots import trust_in_pivots
from yellowiron.alignment.axes.turning import slewing_candidate, wheel_candidate
from yellowiron.alignment.axes.values import AxisEstimate, Candidate, Frame, Line
from yellowiron.alignment.features.solids import Solid, size_of
from yellowiron.model.geometry import Floats
from yellowiron.model.template import JointTemplate, Template
from yellowiron.support.vectors import angle_between_lines, distance_from_line, unit

WHEELS = ("wheel", "sprocket", "idler", "roller", "carrier")
"""Kinds of roles that turn about their own axis of symmetry."""
TWIN_BETTER = 3.0
"""So many times as well known, a cylinder's line is its twin's too."""
_UNSEEN, _LEANS = 0.5, math.radians(5.0)
"""How far a slideway that is not drawn may be beside the middle of what slides on it, in widths of that, and how far it
may lean: masts tilt by 5° to 12°, and are drawn upright as a rule."""
_FAR, _FAR_BY_LENGTH = math.cos(math.radians(45.0)), math.cos(math.radians(15.0))
"""A slide that is this far from what the template says slides along that all the same; masts lean by less."""
_TOLD = "the type's own direction"
_NARROW = 4.0
"""What is so many times longer than wide slides along its length."""
_NEARLY, _LEANING = 0.7, 3.0
"""A ball's pin lies across its cylinder, to this cosine; to so many degrees, one of the machine's directions."""
RING_QUALITY, _RING_OFF = 0.6, 0.3
"""How much a ring about a barrel, between its ends, speaks for its trunnion; its axis is off the ring's middle by this
share of half its length."""
PIVOT_TAKEN = 0.4
"""Quality from which a hinge that is drawn at a pivot of the scene's tree has it to itself."""


def estimate_axes(
    solids: Sequence[Solid],
    labels: Mapping[str, Sequence[int]],
    template: Template,
    *,
    frame: Frame | None = None,
    size: float | None = None,
    pivots: Mapping[str, Floats] | None = None,
    ways: Mapping[str, Floats] | None = None,
) -> dict[str, AxisEstimate]:
    """Joint → its axis, for every hinge and slide of a template (with its variants decided) between two bodies that
    have solids.

    `labels`: body → indices of its solids. `frame`: the machine's directions as far as they are known. `size`: the
    machine's, metres (its solids' if None). `pivots`: joint → (n, 3) places of the scene's tree that it
    may turn about (`pivots_of`), CAD frame; `ways`: hinge → its direction, of those that pins or bores showed. Nothing
    raises for want of evidence: an axis that nothing shows is a guess, with an uncertainty that says so.
    """
    if not solids:
        return {}
    size = size if size is not None else size_of(solids)
    bodies = bodies_of(solids, sorted(labels.items()), size)
    taken = {i for rows in labels.values() for i in rows}
    loose = [Body(f"solid {s.index}", (s,), size) for s in solids if s.shaft is not None and s.index not in taken]
    groups = linkages_of(template, bodies)
    linkages = [joints for joints, _ in groups]
    lines = _lines(template, bodies, linkages)
    frame = completed(frame or Frame(), linkages, template, bodies, lines)
    lines |= _lines_up(template, bodies, frame)
    lines = _parallel_sections(_lines_told(lines, template, bodies, frame), template)
    found: dict[str, AxisEstimate] = {}
    planar: list[tuple[tuple[JointTemplate, ...], Direction, dict[str, list[Candidate]]]] = []
    for linkage in (joints for joints, flat in groups if flat):
        way = direction_of(linkage, template, bodies, lines, frame)
        way = as_found(way, [ways[j.name] for j in linkage if ways is not None and j.name in ways])
        lines |= _lines_with_twins({j.name: lines[j.name] for j in linkage if j.name in lines}, way.vector)
        turning = [j for j in linkage if j.type == "revolute"]
        drawn = {j.name: _hinge(j, template, bodies, way, linkage, lines, Clues(), loose) for j in turning}
        planar.append((linkage, way, drawn))
    pivots = pivots or {}
    trust = trust_in_pivots({n: c for _, _, drawn in planar for n, c in drawn.items()}, pivots, size)
    alone = [joint for (joint,) in (joints for joints, flat in groups if not flat) if joint.type == "revolute"]
    slewing = _slewing_pivots(alone, template, bodies, frame, pivots, size)
    for joint in alone:
        found[joint.name] = _single(joint, template, bodies, frame, slewing, trust, loose)
    for linkage, way, hinges in planar:
        turning = [j for j in linkage if j.type == "revolute"]
        left = _left_pivots(turning, hinges, pivots, template, size)
        told = {n: Clues(pivots=points, trust=trust) for n, points in left.items()}
        hinges = {
            j.name: _hinge(j, template, bodies, way, linkage, lines, told[j.name], loose)
            if j.name in told
            else hinges[j.name]
            for j in turning
        }
        if not is_upright(linkage, template):
            hinges = _with_twins(hinges)
        hinges = with_levers(hinges, template, linkage, size)
        found |= {name: _estimate(name, candidates) for name, candidates in hinges.items()}
    for name, line in lines.items():
        found[name] = _slide(name, line, template, found)
    for joint in template.joints:
        pair = template.bodies_of(joint)
        if joint.type == "spherical" and None not in pair and len(set(pair)) == 2 and set(pair) <= bodies.keys():
            clues = Clues(pivots=pivots.get(joint.name), trust=trust)
            found[joint.name] = _ball(joint, template, bodies, frame, lines, clues, loose)
    return {j.name: found[j.name] for j in template.joints if j.name in found}


def _lines(
    template: Template, bodies: Mapping[str, Body], linkages: Sequence[Sequence[JointTemplate]]
) -> dict[str, Line]:
    """Slide → the line of its cylinder, or of what slides in each other."""
    kinds = {r.name: r.kind for r in template.roles}
    found = {}
    for joint in (j for linkage in linkages for j in linkage if j.type == "prismatic" and not _is_bare(j, template)):
        a, b = (str(name) for name in template.bodies_of(joint))
        barrel, rod = (b, a) if kinds[a] == "rod" or kinds[b] == "barrel" else (a, b)
        line = cylinder_line(bodies.get(barrel), bodies.get(rod))
        if line is not None:
            found[joint.name] = line
    return found


def _is_bare(slide: JointTemplate, template: Template) -> bool:
    """Whether a slideway is not drawn: another body stands in for it (`as_drawn`)."""
    way = template.role(slide.parts[0].partition("[")[0])
    return way.kind == "arm" and not way.rigid


def _lines_up(template: Template, bodies: Mapping[str, Body], frame: Frame) -> dict[str, Line]:
    """Slide → upright through what slides, where no slideway is drawn: masts are what is drawn into chassis. What is
    long and narrow slides along its length: a boom's section."""
    found: dict[str, Line] = {}
    for joint in template.joints:
        body = bodies.get(str(template.bodies_of(joint)[1]))
        if joint.type != "prismatic" or not _is_bare(joint, template) or body is None or frame.up is None:
            continue
        middle = np.median(body.samples, axis=0)
        off = body.samples - middle
        spread = np.ptp(off @ np.linalg.svd(off, full_matrices=False)[2].T, axis=0)
        if spread[0] > _NARROW * spread[1]:
            line = cylinder_line(None, body)
            found |= {joint.name: line} if line is not None else {}
            continue
        width = float(np.percentile(np.linalg.norm(off - np.outer(off @ frame.up, frame.up), axis=1), 60))
        found[joint.name] = Line(middle, frame.up, _UNSEEN * width, _LEANS, width, "how its machine stands")
    return found


def _lines_told(
    lines: Mapping[str, Line], template: Template, bodies: Mapping[str, Body], frame: Frame
) -> dict[str, Line]:
    """The lines, those along what the template says that are far from what is drawn: a beam is wider than it is long,
    and a carriage than it is high. What turns on the machine (a grader's blade on its circle) has its own direction."""
    found = dict(lines)
    for name, line in lines.items():
        joint = template.joint(name)
        told = frame.along(joint.direction)
        limit = _FAR_BY_LENGTH if line.how == BY_LENGTH else _FAR
        if told is None or abs(float(line.direction @ told)) > limit or _is_turned(joint, template):
            continue
        moved = bodies.get(str(template.bodies_of(joint)[1]))
        origin = np.median(moved.samples, axis=0) if moved is not None else line.origin
        found[name] = Line(origin, told, max(line.across, _UNSEEN * line.width), _LEANS, line.width, _TOLD)
    return found


def _is_turned(joint: JointTemplate, template: Template) -> bool:
    """Whether what carries a joint turns about an upright, so that the machine's left and front are not its own."""
    upright = {j.name for j in template.joints if j.type == "revolute" and j.direction == "vertical"}
    rest = networkx.Graph(template.bodies_of(j) for j in template.joints if j.name not in upright | {joint.name})
    rest.add_nodes_from((template.root, template.bodies_of(joint)[0]))
    return joint.direction != "vertical" and not networkx.has_path(rest, template.root, template.bodies_of(joint)[0])


def _parallel_sections(lines: Mapping[str, Line], template: Template) -> dict[str, Line]:
    """The lines, those of sections that slide in each other, a mast's or a boom's, as the best known of them points."""
    pairs = {n: {str(b) for b in template.bodies_of(template.joint(n))} for n in lines}
    found = dict(lines)
    for group in sections_of(template):
        slides = sorted(n for n, pair in pairs.items() if pair <= group)
        if not slides:
            continue
        best = min((lines[n] for n in slides), key=lambda line: round(line.angle, 9))
        for name in slides:
            own = lines[name]
            if own.angle > best.angle:
                way = best.direction if float(best.direction @ own.direction) >= 0.0 else -best.direction
                found[name] = replace(own, direction=way, angle=best.angle, how=f"another section's: {best.how}")
    return found


def _single(
    joint: JointTemplate, template: Template, bodies: Mapping[str, Body], frame: Frame, pivots: Mapping[str, Floats],
    trust: float, loose: Sequence[Body],
) -> AxisEstimate:  # fmt: skip
    """The axis of a hinge in no loop: a wheel's, a slewing bearing's, or any other."""
    kinds = {r.name: r.kind for r in template.roles}
    a, b = (str(name) for name in template.bodies_of(joint))
    wheel = next((name for name in (a, b) if kinds[name] in WHEELS), None)
    if wheel is not None:
        return _estimate(joint.name, [wheel_candidate(bodies[wheel], frame)])
    if is_upright([joint], template):
        slewing = pivots.get(joint.name) if trust > 0.5 else None
        return _estimate(joint.name, [slewing_candidate(bodies[a], bodies[b], frame, slewing)])
    ways = [w for w in (frame.left, frame.forward, frame.up) if w is not None]
    if joint.free and frame.up is not None:
        # What swings freely in no loop is an axle: it rolls, along the machine, across its wheels.
        left = wheels_beside((a, b), template, bodies, frame)
        left = frame.left if left is None else left
        ways = [unit(np.cross(left, frame.up))] if left is not None else ways
    told = frame.along(joint.direction)
    ways = [told] if told is not None else ways
    if not ways:
        ways = [direction_of([joint], template, bodies, {}, frame).vector]
    tried: list[Candidate] = []
    for way in ways:
        exact = direction_of([joint], template, bodies, {}, Frame(left=way, up=way))
        bars = bars_between(bodies[a], bodies[b], _others(bodies, (a, b), loose), exact.vector)
        clues = Clues(pivots=pivots.get(joint.name), trust=trust, bars=bars)
        tried += hinge_candidates(bodies[a], bodies[b], exact.vector, clues, lean=exact.angle)
    tried.sort(key=lambda c: -round(c.quality, 9))
    return _estimate(joint.name, tried)


def _ball(
    joint: JointTemplate, template: Template, bodies: Mapping[str, Body], frame: Frame, lines: Mapping[str, Line],
    clues: Clues, loose: Sequence[Body],
) -> AxisEstimate:  # fmt: skip
    """The middle of a ball, and the pin that may be drawn in its stead: of a cylinder's end on the cylinder's line."""
    pair = set(template.bodies_of(joint))
    slides = [j for j in template.joints if j.name in lines and len(pair & set(template.bodies_of(j))) == 1]
    line = lines[slides[0].name] if slides else None
    if line is not None and len(halves := [b for b in template.bodies_of(slides[0]) if b in bodies]) == 1:
        # Of a half alone nothing else says which end is which.
        half, (other,) = str(halves[0]), pair - set(halves)
        ahead = np.median(bodies[str(other)].samples, axis=0) - np.median(bodies[half].samples, axis=0)
        rod = template.role(half).kind == "rod"
        line = line if (float(ahead @ line.direction) > 0.0) == rod else replace(line, direction=-line.direction)
        lines = {**lines, slides[0].name: line}
    given = [w for w in (frame.left, frame.up, frame.forward) if w is not None] or list(np.eye(3))
    if line is not None:
        along = line.direction
        given = [unit(w - (w @ along) * along) for w in given if abs(float(w @ along)) < _NEARLY]
    tried: list[Candidate] = []
    for way in given:
        exact = Direction(way, math.radians(_LEANING), "the machine's frame")
        tried += _hinge(joint, template, bodies, exact, (*slides[:1], joint), lines, clues, loose)
    tried.sort(key=lambda c: -round(c.quality, 9))
    if line is not None:
        tried = [replace(c, origin=_nearest(line, c)) for c in tried]
    return _estimate(joint.name, tried)


def _nearest(line: Line, candidate: Candidate) -> Floats:
    """The point of a line that is nearest to a hinge's axis."""
    off, across = candidate.origin - line.origin, candidate.direction
    square = line.direction - (line.direction @ across) * across
    return line.origin + float(off @ square) / float(square @ square) * line.direction


def _others(bodies: Mapping[str, Body], pair: tuple[str, str], loose: Sequence[Body]) -> list[Body]:
    return [*(body for name, body in bodies.items() if name not in pair), *loose]


def _hinge(
    joint: JointTemplate, template: Template, bodies: Mapping[str, Body], way: Direction,
    linkage: Sequence[JointTemplate], lines: Mapping[str, Line], clues: Clues, loose: Sequence[Body],
) -> list[Candidate]:  # fmt: skip
    """Where a hinge of a linkage may be; `clues`: what is known of it besides what is drawn."""
    kinds = {r.name: r.kind for r in template.roles}
    a, b = (str(name) for name in template.bodies_of(joint))
    for name, other in ((a, b), (b, a)):
        if kinds[name] not in ("barrel", "rod"):
            continue
        slide = next((j for j in linkage if j.name in lines and name in template.bodies_of(j)), None)
        if slide is None or other in template.bodies_of(slide):
            continue
        line = lines[slide.name]
        # With the rest of the cylinder: an eye may be drawn in one mesh with the other half.
        halves = [bodies[str(n)] for n in template.bodies_of(slide)]
        ahead = 1.0 if kinds[name] == "rod" else -1.0
        eye, room = eye_of(line, bodies[name], halves, bodies[other], way.vector, ahead)
        clues = replace(clues, line=line, eye=eye, room=room)
        break
    bars = bars_between(bodies[a], bodies[b], _others(bodies, (a, b), loose), way.vector)
    clues = replace(clues, bars=bars)
    found = hinge_candidates(bodies[a], bodies[b], way.vector, clues, lean=way.angle)
    barrel = next((name for name in (a, b) if kinds[name] == "barrel"), None)
    if barrel is None or clues.line is None:
        return found
    ring = trunnion_of(clues.line, bodies[barrel], bodies[b if barrel == a else a])
    if ring is None or found[0].quality >= RING_QUALITY:
        return found
    place, half = ring
    origin = clues.line.origin + place * clues.line.direction
    across = max(_RING_OFF * half, clues.line.across)
    return [Candidate(origin, way.vector, across, way.angle, RING_QUALITY, "the ring about the barrel"), *found]


def _slewing_pivots(
    alone: Sequence[JointTemplate], template: Template, bodies: Mapping[str, Body], frame: Frame,
    pivots: Mapping[str, Floats], size: float,
) -> Mapping[str, Floats]:  # fmt: skip
    """The pivots, where frames turn on each other about several upright axes, as a swing bracket on what slews: those
    left out that are drawn to be another one's. All that is of one file may have its origin."""
    upright = [j for j in alone if is_upright([j], template)]
    if len(upright) < 2 or not any(j.name in pivots for j in upright):
        return pivots
    pairs = {j.name: [str(name) for name in template.bodies_of(j)] for j in upright}
    shown = {name: [slewing_candidate(bodies[a], bodies[b], frame)] for name, (a, b) in pairs.items()}
    left = _left_pivots(upright, shown, pivots, template, size)
    return {name: points for name, points in pivots.items() if name not in pairs} | left


def _left_pivots(
    turning: Sequence[JointTemplate], hinges: Mapping[str, Sequence[Candidate]], pivots: Mapping[str, Floats],
    template: Template, size: float,
) -> dict[str, Floats]:  # fmt: skip
    """Hinge → its pivots of the scene's tree, those left out that what is drawn shows to be of another hinge of one of
    its bodies."""

    def at(name: str, points: Floats) -> NDArray[np.bool_]:
        best = hinges[name][0]
        off = [distance_from_line(p, best.origin, best.direction) for p in points]
        return np.asarray((np.array(off) < AT_PIVOT * size) & (best.quality > PIVOT_TAKEN))

    found = {}
    for joint in turning:
        points = pivots.get(joint.name)
        if points is None:
            continue
        pair = set(template.bodies_of(joint))
        rivals = [j.name for j in turning if j is not joint and pair & set(template.bodies_of(j))]
        taken = np.any([at(name, points) for name in rivals], axis=0) if rivals else np.zeros(len(points), dtype=bool)
        kept = points[~taken | at(joint.name, points)]
        if len(kept):
            found[joint.name] = kept
    return found


def _with_twins(hinges: Mapping[str, list[Candidate]]) -> dict[str, list[Candidate]]:
    """The candidates of hinges; left and right twins turn about one line, so each of them has the other's best too, and
    where both have the same, what both know."""
    found = dict(hinges)
    for name, own in hinges.items():
        twin = hinges.get(_other_side(name) or "")
        if not twin:
            continue
        best, other = own[0], twin[0]
        moved = replace(other, origin=_beside(other, best.origin))
        if _apart(best, other) < 2.0 * math.hypot(best.across, other.across):
            share = other.across**2 / (best.across**2 + other.across**2)
            origin = share * best.origin + (1 - share) * moved.origin
            across = math.hypot(share * best.across, (1 - share) * other.across)
            across = max(across, 0.7 * min(best.across, other.across), 0.5 * _apart(best, other))
            found[name] = [replace(best, origin=origin, across=across), *own[1:]]
        elif other.quality > 1.5 * best.quality:
            quality, how = 0.8 * other.quality, f"its twin's: {other.how}"
            twins = replace(moved, across=1.5 * other.across, quality=quality, how=how)
            found[name] = [twins, *own]
    return found


def _lines_with_twins(lines: Mapping[str, Line], way: Floats) -> dict[str, Line]:
    """The lines of a linkage's cylinders; of left and right twins, which move side by side, that of which little is
    drawn along it is parallel to the other's, and beside it along `way`."""
    found = dict(lines)
    for name, own in lines.items():
        twin = lines.get(_other_side(name) or "")
        if twin is None or own.angle < TWIN_BETTER * twin.angle:
            continue
        origin = twin.origin + float((own.origin - twin.origin) @ way) * way
        ahead = twin.direction if float(twin.direction @ own.direction) > 0.0 else -twin.direction
        across = math.hypot(own.across, twin.across)
        found[name] = replace(
            own, origin=origin, direction=ahead, across=across, angle=1.5 * twin.angle, how=f"its twin's: {twin.how}"
        )
    return found


def _beside(candidate: Candidate, point: Floats) -> Floats:
    """A candidate's point beside another."""
    return candidate.origin + float((point - candidate.origin) @ candidate.direction) * candidate.direction


def _other_side(name: str) -> str | None:
    """The name with left and right exchanged, None where it has no side."""
    if "_l_" in name or "_l2" in name:
        return name.replace("_l_", "_r_").replace("_l2", "_r2")
    if "_r_" in name or "_r2" in name:
        return name.replace("_r_", "_l_").replace("_r2", "_l2")
    return None


def _apart(one: Candidate, other: Candidate) -> float:
    delta = one.origin - other.origin
    return float(np.linalg.norm(delta - (delta @ other.direction) * other.direction))


def _estimate(name: str, candidates: Sequence[Candidate]) -> AxisEstimate:
    best, *others = candidates
    return AxisEstimate(
        name, best.origin, best.direction, best.across, best.angle, best.how, tuple(others), best.quality
    )  # fmt: skip


def _slide(name: str, line: Line, template: Template, found: Mapping[str, AxisEstimate]) -> AxisEstimate:
    """The axis of a slide: its line; where only its length tells that, the line from pivot to pivot."""
    ends = []
    pair = {str(b) for b in template.bodies_of(template.joint(name))}
    for joint in template.joints:
        bodies = {str(b) for b in template.bodies_of(joint)}
        if joint.type == "revolute" and joint.name in found and len(bodies & pair) == 1:
            ends.append((next(iter(bodies & pair)), found[joint.name]))
    by_body = dict(reversed(ends))
    if len(by_body) == 2 and line.angle > math.radians(0.6):
        one, other = (by_body[b] for b in sorted(by_body))
        flat = one.direction
        start, end = (e.origin - float((e.origin - line.origin) @ flat) * flat for e in (one, other))
        way = end - start
        length = float(np.linalg.norm(way))
        across = max(one.across, other.across)
        bent = angle_between_lines(way / length, line.direction) > 3.0 * line.angle if length > 0 else True
        if not bent and across / length < line.angle:
            way = way / length if float(way @ line.direction) > 0 else -way / length
            return AxisEstimate(name, start, way, across, across / length, "the line from pivot to pivot")
    return AxisEstimate(name, line.origin, line.direction, line.across, line.angle, line.how)
