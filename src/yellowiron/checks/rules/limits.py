"""Limits: in order, in the right unit, and within what the machine can do."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from yellowiron.checks.islands import Island, cylinders
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.tolerances import DEPENDENT
from yellowiron.checks.values import WORLD, StageJoint
from yellowiron.checks.view import View
from yellowiron.model.geometry import Floats

_ROUND = 0.02
"""Degrees within which a limit is a whole number of degrees."""
_SHARE = 0.1
"""A hinge whose limits give it less than this share of what its loop asks has its limits in radians (1/57)."""
_SLACK = {"revolute": math.radians(0.1), "prismatic": 1e-3}
_STAGES = 5.0
"""A cylinder's stroke, in its closed lengths: a telescopic one has five stages at most, and each is shorter."""
_PLAY = 0.05
"""Of a stroke: so much a cylinder's halves as they are drawn may fall short."""
_OTHERWISE = 0.1
"""Of its range: a slide's ends, where they are those it was made for, bring a hinge of its loop this near to its
limits."""
_RADIANS = 2.0 * math.pi


def _limited(view: View) -> Iterator[tuple[StageJoint, float, float]]:
    """Hinges and slides with both limits, in order."""
    for joint in view.joints:
        if joint.lower is not None and joint.upper is not None and joint.lower <= joint.upper:
            yield joint, joint.lower, joint.upper


def _say(joint: StageJoint, value: float) -> str:
    return f"{1e3 * value:.5g} mm" if joint.type == "prismatic" else f"{math.degrees(value):.5g}°"


@rule(
    "CHK060",
    "error",
    "Write the lower one as physics:lowerLimit.",
)
def swapped(view: View) -> Remarks:
    """A joint's limits are swapped."""
    for joint in view.joints:
        if joint.lower is not None and joint.upper is not None and joint.lower > joint.upper:
            yield (
                joint.path,
                f"Its lower limit {_say(joint, joint.lower)} is above its upper {_say(joint, joint.upper)}.",
            )


@rule(
    "CHK061",
    "warning",
    "Give it a range, or make it a fixed joint.",
)
def no_range(view: View) -> Remarks:
    """A joint's limits leave it no way to move."""
    for joint, lower, upper in _limited(view):
        if lower == upper:
            yield joint.path, f"Both its limits are {_say(joint, lower)}."


@rule(
    "CHK062",
    "warning",
    "UsdPhysics limits are in degrees: multiply by 57.2958.",
)
def radians(view: View) -> Remarks:
    """A hinge's limits look like radians."""
    for joint, lower, upper in _limited(view):
        if joint.type != "revolute" or lower == upper:
            continue
        written = (math.degrees(lower), math.degrees(upper))
        if max(abs(v) for v in written) > _RADIANS + 1e-6:
            continue
        needed = _needed(view, joint)
        if needed is not None and upper - lower < _SHARE * needed:
            yield (
                joint.path,
                f"They give it {written[1] - written[0]:.3g}°, and its loop needs about {math.degrees(needed):.3g}°.",
            )
        elif _all_round(written):
            pair = " and ".join(f"{math.degrees(v):.4g}°" for v in written)
            yield joint.path, f"{written[0]:.5g} and {written[1]:.5g} are radians for {pair}."


def _all_round(written: tuple[float, float]) -> bool:
    """Whether limits are whole degrees once they are taken for radians, and none as they are."""
    values = [v for v in written if v != 0.0]
    turned = all(abs(d - round(d)) < _ROUND and round(d) != 0 for d in map(math.degrees, values))
    plain = any(abs(10.0 * v - round(10.0 * v)) < 1e-3 for v in values)
    return turned and not plain


def _needed(view: View, joint: StageJoint) -> float | None:
    """Roughly the range (rad) that a hinge of a loop needs for the full strokes of the driven slides: the rates of the
    drawn pose, each slide alone. None where the loop has no such drives."""
    for island in view.islands:
        motion = island.motion
        if joint.path not in island.in_loops or motion is None:
            continue
        driven = [j for j in island.joints if j.path in island.in_loops and j.driven and len(j.freedoms) == 1]
        strokes = [
            (j.upper - j.lower) / motion.size
            if j.type == "prismatic" and j.lower is not None and j.upper is not None and j.upper > j.lower
            else 0.0
            for j in driven
        ]
        rates = motion.part(driven)
        if not any(strokes) or np.linalg.matrix_rank(rates, tol=DEPENDENT) < len(driven):
            return None
        share = motion.part([joint]) @ np.linalg.pinv(rates)
        return float(np.abs(share[0] * np.array(strokes)).max())
    return None


@rule(
    "CHK063",
    "warning",
    "Articulation hinges turn within ±360°: correct the limits, or leave them out. Degrees converted twice look "
    "like this.",
)
def beyond_a_turn(view: View) -> Remarks:
    """A hinge's limits lie beyond a full turn."""
    for joint, lower, upper in _limited(view):
        if joint.type == "revolute" and max(abs(lower), abs(upper)) > 2.0 * math.pi * (1.0 + 1e-6):
            yield joint.path, f"They are {_say(joint, lower)} and {_say(joint, upper)}."


@rule(
    "CHK064",
    "warning",
    "Give it the cylinder's stroke: nothing else stops it.",
)
def unlimited_slide(view: View) -> Remarks:
    """A slide has no limits."""
    # What a driven distance between its bodies reins in has its limits.
    reined = {frozenset(j.bodies) for j in view.joints if j.type == "distance" and j.upper is not None}
    for joint in view.joints:
        if frozenset(joint.bodies) in reined:
            continue
        if joint.type == "prismatic" and joint.enabled and (joint.lower is None or joint.upper is None):
            ends = [n for n, v in (("lower", joint.lower), ("upper", joint.upper)) if v is None]
            yield joint.path, f"It has no {' and no '.join(ends)} limit."


@rule(
    "CHK065",
    "warning",
    "Give it the cylinder's stroke, in the stage's unit.",
)
def long_stroke(view: View) -> Remarks:
    """A slide's stroke is longer than the machine."""
    for island in view.islands:
        for joint in island.joints:
            if joint.type != "prismatic" or joint.path in island.in_loops or WORLD in joint.bodies:
                continue
            stroke = 0.0 if joint.lower is None or joint.upper is None else joint.upper - joint.lower
            if stroke > island.size > 0.0:
                yield joint.path, f"It may travel {stroke:.4g} m, and the machine is {island.size:.4g} m across."


@rule(
    "CHK066",
    "error",
    "Give it the cylinder's stroke, in the stage's unit.",
)
def beyond_reach(view: View) -> Remarks:
    """A slide's stroke is longer than its cylinder can hold."""
    for island in view.islands:
        for slide, before, after in cylinders(island):
            if slide.lower is None or slide.upper is None or slide.lower >= slide.upper:
                continue
            drawn = float(np.linalg.norm(after.sides[0].position - before.sides[0].position))
            closed, stroke = drawn + slide.lower - slide.coordinate, slide.upper - slide.lower
            if stroke > _STAGES * closed:
                yield slide.path, f"Its stroke is {stroke:.4g} m, and its pins are {drawn:.4g} m apart as drawn."


@rule(
    "CHK067",
    "warning",
    "Widen the limits or draw it within them: an engine throws it back at the first step.",
)
def outside(view: View) -> Remarks:
    """A joint is drawn outside its limits."""
    for joint, lower, upper in _limited(view):
        if any(s.missing for s in joint.sides) or not np.isfinite(joint.coordinate):
            continue
        value = joint.coordinate
        if joint.type == "revolute":
            middle = 0.5 * (lower + upper)
            value = middle + math.remainder(value - middle, 2.0 * math.pi)
        if not lower - _SLACK[joint.type] <= value <= upper + _SLACK[joint.type]:
            yield (
                joint.path,
                f"It is drawn at {_say(joint, value)}, its limits are {_say(joint, lower)} and {_say(joint, upper)}.",
            )


@rule(
    "CHK068",
    "warning",
    "Negate and exchange them: the stroke is on the other side of the drawn pose, or the slide's axis points the other "
    "way.",
)
def mirrored(view: View) -> Remarks:
    """A slide's limits are mirrored about the drawn pose."""
    for island in view.islands:
        for cylinder in cylinders(island):
            slide, before, after = cylinder
            if slide.lower is None or slide.upper is None or slide.lower >= slide.upper:
                continue
            ends = (slide.lower - slide.coordinate, slide.upper - slide.coordinate)
            other = (-ends[1], -ends[0])
            told = [_say(slide, slide.coordinate + end) for end in (*ends, *other)]
            if not _holds_together(slide, before, after, ends) and _holds_together(slide, before, after, other):
                yield (
                    slide.path,
                    f"From {told[0]} to {told[1]} its rod leaves the barrel or goes through its end; from {told[2]} to "
                    f"{told[3]} it would not.",
                )
            elif (
                _off(island, (slide, before, after), ends)
                > _OTHERWISE
                > 4.0 * _off(island, (slide, before, after), other)
            ):
                yield (
                    slide.path,
                    f"From {told[0]} to {told[1]} the pivots of its loop would pass their own limits; those are right "
                    f"for {told[2]} to {told[3]}.",
                )


def _off(island: Island, cylinder: tuple[StageJoint, StageJoint, StageJoint], ends: tuple[float, float]) -> float:
    """How far the ends of a cylinder's slide (m from the drawn pose) are from bringing the hinges of its triangle of
    pivots to their limits, in shares of those limits' ranges: the nearest counts. 0 where there is no such hinge."""
    slide, before, after = cylinder
    known = {before.path, slide.path, after.path}
    loops = [{j.path: j for j in loop.joints if j.type != "fixed"} for loop in island.loops]
    third = [
        j for loop in loops if len(loop) == 4 and known <= loop.keys() for j in loop.values() if j.path not in known
    ]
    if len(third) != 1 or before.type != "revolute" or third[0].type not in ("revolute", "spherical"):
        return 0.0
    pivot, normal = third[0], before.axis
    corners = [j.sides[0].position - (j.sides[0].position @ normal) * normal for j in (pivot, before, after)]
    frame, lever = (next((b for b in j.bodies if b not in slide.bodies), WORLD) for j in (before, after))
    out = float(np.sign((corners[2] - corners[1]) @ slide.axis)) * (1.0 if slide.bodies[0] in before.bodies else -1.0)
    found = []
    for index, (joint, fixed) in enumerate(((pivot, frame), (before, frame), (after, lever))):
        if joint.type != "revolute" or joint.lower is None or joint.upper is None or joint.upper <= joint.lower:
            continue
        one, other = ((1, 2), (0, 2), (0, 1))[index]
        turn = np.cross(corners[one] - corners[index], corners[other] - corners[index]) @ joint.axis
        sense = np.sign(turn) * (1.0 if joint.bodies[0] == fixed else -1.0)
        angles = [_interior(corners, index, out * end) for end in (0.0, *ends)]
        if np.isfinite(angles).all():
            reached = sorted(joint.coordinate + float(sense * (angle - angles[0])) for angle in angles[1:])
            apart = abs(reached[0] - joint.lower) + abs(reached[1] - joint.upper)
            found.append(apart / (joint.upper - joint.lower))
        else:
            found.append(math.inf)
    return min(found, default=0.0)


def _interior(corners: list[Floats], index: int, longer: float) -> float:
    """The angle at a corner of the triangle (pivot, cylinder's two pins) with the cylinder so much longer; NaN past a
    dead point."""
    sides = [float(np.linalg.norm(corners[(k + 1) % 3] - corners[(k + 2) % 3])) for k in range(3)]
    sides[0] += longer
    a, b, c = sides[index], sides[(index + 1) % 3], sides[(index + 2) % 3]
    cosine = (b * b + c * c - a * a) / (2.0 * b * c) if b * c > 0.0 else math.nan
    return math.acos(cosine) if abs(cosine) <= 1.0 else math.nan


def _holds_together(slide: StageJoint, before: StageJoint, after: StageJoint, ends: tuple[float, float]) -> bool:
    """Whether a cylinder's halves stay in each other between `ends` (m from the drawn pose), and neither passes the
    other's eye; true where a half has no geometry."""
    one, other = slide.spans
    if one is None or other is None:
        return True
    # Along the line from the first half's pin to the second's, which the second half goes to extend it.
    near, far = (before, after) if slide.bodies[0] in before.bodies else (after, before)
    if (far.sides[0].position - near.sides[0].position) @ slide.axis < 0.0:
        one, other, ends = (-one[1], -one[0]), (-other[1], -other[0]), (-ends[1], -ends[0])
    slack = _PLAY * (ends[1] - ends[0])
    inside = one[1] - (other[0] + ends[1]) >= -slack
    return inside and other[0] + ends[0] >= one[0] - slack and other[1] + ends[0] >= one[1] - slack
