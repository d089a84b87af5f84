"""The axis on which two bodies turn or slide: from a pin, from the bores both have, or guessed from an outline."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from yellowiron.mechanism.joints.axes import (
    Axis,
    axis_of,
    coaxial_groups,
    on_axis,
    residuals,
    span,
    symmetry_axis,
)
from yellowiron.mechanism.placement import Features, Placement, join
from yellowiron.mechanism.tolerances import SAME_ANGLE, SAME_OFFSET
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.template import JointTemplate

Rows = tuple[Sequence[int], Sequence[int]]
"""Rows of a placement: parts of the one body, parts of the other."""

_OUT_OF_LINE = {True: (math.radians(0.05), 1e-4), False: (math.radians(0.2), 3e-4)}
"""Angle (rad) and offset (m) from which features are out of line; exact ones, and fitted ones."""
_GAP = 0.02
"""Bores of two bodies belong to one pin only if no more than this is between them along the axis, metres."""
_SAME_JOINT = (math.sin(math.radians(1.0)), 0.02)
"""Sine and metres up to which two lines may be one joint's axis."""
_RIVAL = 0.5
"""A second axis whose shared area is more than this share of the best one's makes the choice doubtful."""
_SHAFT = 0.5
"""What has less than this share of the area of a pin's largest shaft are the bolts and holes of its flange."""
_PLAY = 0.07
"""Share of a ball's radius by which its socket may be larger, or off its middle."""
_MAIN = 0.5
"""A pin part with this share of the pin's cylinder area is no bolt or plate: it should be on the axis."""


@dataclass(frozen=True, eq=False)
class Bearing:
    """An axis with the features it was fitted to and how it was found. `doubt` is a finding's (code, words), or
    None."""

    line: Axis
    features: Features
    method: str
    doubt: tuple[str, str] | None = None

    @property
    def exact(self) -> bool:
        """Whether any feature is one of the CAD file's own, not one fitted to facets."""
        return bool(self.features.exact.any())

    @property
    def reach(self) -> tuple[float, float]:
        """From where to where the features reach, coordinates along the line; (0, 0) without features."""
        return span(self.features, self.line) if len(self.features) else (0.0, 0.0)

    def evidence(self, placement: Placement) -> dict[str, Any]:
        """How it was found, from which parts, and how far these are out of line."""
        if len(self.features) == 0:
            return {"method": self.method}
        angle, offset = residuals(self.features, self.line)
        return {
            "method": self.method,
            "parts": placement.ids(self.features.part),
            "residual_deg": round(math.degrees(angle), 9),
            "residual_mm": round(offset * 1e3, 9),
        }

    def findings(self, where: str) -> list[Finding]:
        """What is doubtful about it."""
        found = [Finding(self.doubt[0], "warning", where, self.doubt[1], _HINT)] if self.doubt else []
        if len(self.features):
            angle, offset = residuals(self.features, self.line)
            most_angle, most_offset = _OUT_OF_LINE[self.exact]
            if angle > most_angle or offset > most_offset:
                words = f"Its cylinders are out of line by up to {math.degrees(angle):.3f}° and {offset * 1e3:.3f} mm."
                found.append(Finding("MEC004", "warning", where, words, _HINT))
        return found


_HINT = "Check its parts in the alignment, and in the CAD model."


def pin_bearing(placement: Placement, pins: Sequence[int], bodies: tuple[str, str]) -> Bearing | None:
    """The axis of a joint's pin parts: of their coaxial groups the one that most bodies have bores on, and most parts.

    A left and a right pin, or an upper and a lower, give one least-squares axis. Pins without cylinders lend their
    place: the bores of both bodies nearest to them, else the outline. None without pins.
    """
    if not pins:
        return None
    features = placement.features(pins)
    around = placement.features(row for b in bodies for row in placement.rows_of_body(b) if row not in pins)

    def rank(group: Features) -> tuple[int, int, float]:
        holders = around.take(on_axis(around, axis_of(group)))
        held = {placement.bodies[int(row)] for row in holders.part}
        return len(held), len(set(group.part.tolist())), float(group.area.sum())

    groups = [features.take(rows) for rows in coaxial_groups(features)]
    if not groups:
        near = placement.points_of(pins).mean(axis=0)
        rows = (placement.rows_of_body(bodies[0]), placement.rows_of_body(bodies[1]))
        return shared_bearing(placement, rows, near=near) or outline_bearing(placement, pins)
    least = _SHAFT * max(float(g.area.sum()) for g in groups)
    best = max((g for g in groups if g.area.sum() >= least), key=rank)
    # The pin's own cylinders fix the axis; shafts before bores, which may be a bush's or a grease hole.
    shafts = best.take(~best.inner)
    best = shafts if len(shafts) else best
    lone = sorted(set(pins) - {int(row) for row in best.part})
    stray = any(placement.features([row]).area.sum() > _MAIN * best.area.sum() for row in lone)
    doubt = ("MEC004", "Some of its pin parts are not on the common axis.") if stray else None
    return Bearing(axis_of(best), best, f"least squares over {len(best)} cylinder(s) of the pin", doubt)


def shared_bearing(placement: Placement, rows: Rows, *, near: Floats | None = None) -> Bearing | None:
    """The axis on which the parts of two bodies have cylinders, side by side or one in the other: the one on which they
    share most area, or the one nearest to a point. None if there is no such axis."""
    few, many = sorted((placement.features(own) for own in rows), key=len)
    ranked: list[tuple[float, Features]] = []
    for group in coaxial_groups(few):
        mine = few.take(group)
        line = axis_of(mine)
        theirs = many.take(on_axis(many, line))
        if len(theirs) == 0 or _gap(span(mine, line), span(theirs, line)) > _GAP:
            continue
        shared = min(float(mine.area.sum()), float(theirs.area.sum()))
        ranked.append((shared if near is None else -float(line.distance(near[None])[0]), join((mine, theirs))))
    if not ranked:
        return None
    ranked.sort(key=lambda pair: -pair[0])
    features = ranked[0][1]
    rivals = [f for score, f in ranked[1:] if near is None and score > _RIVAL * ranked[0][0]]
    doubt = ("MEC006", f"{len(rivals) + 1} axes fit it about as well; the largest was taken.") if rivals else None
    method = f"least squares over {len(features)} coaxial cylinder(s) of both bodies"
    return Bearing(axis_of(features), features, method, doubt)


def ball_bearing(placement: Placement, rows: Rows) -> Bearing | None:
    """The middle of a ball of the one body in a socket of the other, with an upright line through it; None without.
    Of several the largest."""
    balls = [[(row, *sphere) for row in own for sphere in placement.spheres(row)] for own in rows]
    found = [
        (min(radius, wide), row, other, center)
        for row, center, radius, inner in balls[0]
        for other, place, wide, inside in balls[1]
        if inner != inside
        and abs(radius - wide) < _PLAY * radius
        and float(np.linalg.norm(center - place)) < max(_PLAY * radius, SAME_OFFSET)
    ]
    if not found:
        return None
    radius, row, other, center = max(found, key=lambda each: each[0])
    parts = " and ".join(placement.ids([row, other]))
    method = f"middle of the ball of {2e3 * radius:.4g} mm in its socket, {parts}"
    return Bearing(Axis(center, np.array([0.0, 0.0, 1.0])), placement.features(()), method)


def eye_middle(placement: Placement, bearing: Bearing, bodies: tuple[str, str], pins: Sequence[int]) -> Floats | None:
    """The middle of the shorter of the two bodies' bores on a pin's axis, which has the spherical bearing in it; the
    longer is the clevis. None where a body has no bore there."""
    spans = []
    for body in bodies:
        own = placement.features(row for row in placement.rows_of_body(body) if row not in pins)
        own = own.take(on_axis(own, bearing.line))
        if not len(own):
            return None
        spans.append(span(own, bearing.line))
    low, high = min(spans, key=lambda ends: ends[1] - ends[0])
    return bearing.line.at(0.5 * (low + high))


def lone_bearing(placement: Placement, bodies: tuple[str, str], line: Axis) -> Bearing:
    """The axis that the alignment found for two bodies of which only one has a round face there (or none that fits):
    through the cylinders of either on that line, else the line itself."""
    rows = [row for body in bodies for row in placement.rows_of_body(body)]
    features = placement.features(rows)
    features = features.take(on_axis(features, line))
    doubt = ("MEC009", "No pin and no common bore is drawn: one body is taken to turn on what is round of the other.")
    if len(features) == 0:
        return Bearing(line, features, "alignment: where one body ends at the other", doubt)
    method = f"least squares over {len(features)} cylinder(s) of one body that the other ends at or is run through by"
    return Bearing(axis_of(features), features, method, doubt)


def lone_slide(placement: Placement, bodies: tuple[str, str], line: Axis) -> Bearing:
    """The axis that the alignment found for a slide of which no bore and rod show it: through the cylinders of both on
    that line, else the line itself."""
    features = placement.features(row for body in bodies for row in placement.rows_of_body(body))
    features = features.take(on_axis(features, line))
    doubt = ("MEC014", "No rod in its bore shows the axis: the slide is along the line that both its bodies are on.")
    if len(features) == 0:
        return Bearing(line, features, "alignment: the line that both bodies are along", doubt)
    return Bearing(axis_of(features), features, f"least squares over {len(features)} cylinder(s) in line", doubt)


def declared_bearing(placement: Placement, bodies: tuple[str, str], kind: str) -> Bearing | None:
    """The axis of two bodies' joint of that type as the CAD file declares it, where nothing drawn shows it."""
    found = next((d for d in placement.declared if d.type == kind and d.bodies == set(bodies)), None)
    if found is None:
        return None
    words = "Nothing that is drawn shows its axis: it is where the CAD file declares it."
    method = f"declared by the CAD file: joint '{found.name}'"
    return Bearing(Axis(found.point, found.axis), placement.features(()), method, ("MEC016", words))


def given_bearing(placement: Placement, joint: JointTemplate) -> Bearing:
    """The axis that a person gave a joint, in the alignment or in a document of theirs."""
    line = Axis(*placement.axes[joint.name])
    return Bearing(line, placement.features(()), f"set by a person: {joint.documents.get('axis', 'alignment.json')}")


def agree(one: Axis, other: Axis) -> bool:
    """Whether two lines may be one joint's axis: within a degree and two centimetres."""
    lean = float(np.linalg.norm(np.cross(one.direction, other.direction)))
    return lean < _SAME_JOINT[0] and float(one.distance(other.point[None])[0]) < _SAME_JOINT[1]


def outline_bearing(placement: Placement, rows: Sequence[int]) -> Bearing | None:
    """A guess: the symmetry axis of round parts without features."""
    points = placement.points_of(rows)
    if len(points) < 4:
        return None
    words = "Its parts have no cylinder that fits: the axis is guessed from their outline."
    return Bearing(symmetry_axis(points), placement.features(()), "symmetry axis of its parts", ("MEC003", words))


def slide_bearing(
    placement: Placement, rows: Rows, ends: tuple[Floats | None, Floats | None], hinge: Floats | None
) -> Bearing | None:
    """The axis of a slide: its barrel's bore and its rod, among the parts of both its bodies. `ends` are points on the
    pivots of both bodies and `hinge` the direction of the pivots, where known: they stand in for a bore that is not
    there, and steady one fitted to facets."""
    bore = shared_bearing(placement, rows)
    if bore is not None:
        bore = _between_twins(placement, rows, bore)
    if ends[0] is None or ends[1] is None:
        return replace(bore, doubt=None) if bore is not None else None
    if bore is not None:
        return _steadied(replace(bore, doubt=None), ends[0], ends[1], hinge)
    start, between = ends[0], ends[1] - ends[0]
    drawn = np.concatenate([placement.points_of(own) for own in rows])
    if hinge is not None and len(drawn):
        # A pivot's point is anywhere on its pin, which may reach from one of twins to the other.
        across = drawn @ hinge
        start = start + (0.5 * (across.min() + across.max()) - start @ hinge) * hinge
        between = between - (between @ hinge) * hinge
    length = float(np.linalg.norm(between))
    if length == 0.0:
        return None
    words = "Its barrel and rod share no bore: the axis is the line between their pivots."
    return Bearing(Axis(start, between / length), placement.features(()), "line between its pivots", ("MEC003", words))


def _between_twins(placement: Placement, rows: Rows, bore: Bearing) -> Bearing:
    """A slide's axis where both bodies have equal pairs of coaxial cylinders side by side (twins drawn as one): midway
    between them."""
    one, other = (placement.features(own) for own in rows)
    largest = [_largest(features.take(on_axis(features, bore.line))) for features in (one, other)]
    feet = [bore.line.point]
    for group in coaxial_groups(one):
        mine = one.take(group)
        line = axis_of(mine)
        lean = float(np.linalg.norm(np.cross(line.direction, bore.line.direction)))
        if lean > _SAME_JOINT[0] or not _equal(_largest(mine), largest[0]):
            continue
        if not _equal(_largest(other.take(on_axis(other, line))), largest[1]):
            continue
        foot = line.foot(bore.line.point)
        if min(float(np.linalg.norm(foot - f)) for f in feet) > largest[0][0]:
            feet.append(foot)
    if len(feet) == 1:
        return bore
    line = Axis(np.mean(feet, axis=0), bore.line.direction)
    method = f"midway between {len(feet)} equal cylinders: {bore.method}"
    return Bearing(line, placement.features(()), method)


def _largest(features: Features) -> tuple[float, float]:
    """(radius, length) of the largest of some features; zeros without any."""
    if len(features) == 0:
        return 0.0, 0.0
    row = int(np.argmax(features.area))
    return float(features.radius[row]), float(features.length[row])


def _equal(one: tuple[float, float], other: tuple[float, float]) -> bool:
    return all(abs(a - b) <= 0.02 * max(a, b) for a, b in zip(one, other, strict=True)) and one[0] > 0.0


def _steadied(bore: Bearing, start: Floats, end: Floats, hinge: Floats | None) -> Bearing:
    """A bore fitted to facets, turned into the line between its pivots where the two agree: the pivots are farther
    apart than any facet is long. Exact bores stay."""
    if bore.exact or hinge is None:
        return bore
    across = end - start
    across = across - (across @ hinge) * hinge
    length = float(np.linalg.norm(across))
    if length == 0.0:
        return bore
    line = Axis(start + ((bore.line.point - start) @ hinge) * hinge, across / length)
    lean = float(np.linalg.norm(np.cross(line.direction, bore.line.direction)))
    apart = float(line.distance(bore.line.point[None])[0])
    if lean > math.sin(SAME_ANGLE) or apart > 2.0 * SAME_OFFSET:
        return bore
    return replace(bore, line=line, method=f"{bore.method}, steadied by its pivots")


def _gap(one: tuple[float, float], other: tuple[float, float]) -> float:
    """Distance between two stretches of a line; negative where they overlap."""
    return max(one[0], other[0]) - min(one[1], other[1])
