"""Which way joints point: the hinges of a planar linkage all one way, across its hydraulic cylinders."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.assignment.directions import steering_joints
from yellowiron.alignment.axes.bodies import PIVOT, Body
from yellowiron.alignment.axes.values import Frame, Line
from yellowiron.alignment.fusion.stance import stance_of
from yellowiron.model.geometry import Floats
from yellowiron.model.template import JointTemplate, Template
from yellowiron.support import graphs
from yellowiron.support.vectors import unit

TOGETHER = math.cos(math.radians(4.0))
"""Cosine up to which round faces point the same way."""
UPRIGHT = 0.97
"""Cosine up to which the hinges of a steering are upright (14°)."""
BENT = math.cos(math.radians(50.0))
"""Cosine up to which those of an arm are across the machine, which may be drawn as it steers, …"""
LEVEL = 0.25
"""… and they lie level, up to this cosine with the upright."""
LEAST_WHEEL = 0.004
"""The least radius of what is round in a wheel, in machine sizes."""
NEAR_LEFT = math.cos(math.radians(5.0))
"""Cosine up to which pivots tell the machine's left better than its symmetry does."""
_PARALLEL = math.cos(math.radians(0.3))
"""Cosine up to which two hinges and more that pins or bores show are parallel."""
_EXACT = math.radians(0.1)
"""How far a hinge that pins or bores show is off the others of its linkage."""
ACROSS = 0.2
"""Cosine up to which a hinge is across a cylinder of its linkage (78°)."""


@dataclass(frozen=True, eq=False)
class Direction:
    """A unit direction with its one-sigma uncertainty (radians)."""

    vector: Floats
    angle: float
    how: str


def linkages_of(template: Template, bodies: Mapping[str, Body]) -> list[tuple[tuple[JointTemplate, ...], bool]]:
    """The template's joints between bodies that are there, in groups that closed chains hold together where all bodies
    are there, and whether a group is planar: a hinge that no chain closes is a group by itself and is not, nor is one
    of which the rest is not there and that is upright, or whose direction the template says."""
    edges: dict[str, tuple[str, str]] = {}
    for joint in template.joints:
        a, b = template.bodies_of(joint)
        if joint.type in ("revolute", "prismatic") and not joint.ring and a is not None and b is not None and a != b:
            edges[joint.name] = (a, b)
    found = []
    for block in graphs.blocks(edges):
        there = tuple(template.joint(name) for name in block if set(edges[name]) <= bodies.keys())
        if there:
            alone = len(there) == 1 and (there[0].direction is not None or is_upright(there, template))
            planar = len(block) > 1 and not alone
            found.append((there, planar))
    return found


def is_upright(linkage: Sequence[JointTemplate], template: Template) -> bool:
    """Whether a linkage steers or slews: one of its hinges joins two frames, or it moves wheels, or the template says
    that one of several hinges is upright."""
    if steering_joints(template) & {j.name for j in linkage} or (len(linkage) > 1 and _told(linkage) == "vertical"):
        return True
    frames = {r.name for r in template.roles if r.kind == "frame" and r.rigid}
    return any(j.type == "revolute" and set(template.bodies_of(j)) <= frames for j in linkage)


def _told(linkage: Sequence[JointTemplate]) -> str | None:
    """The machine's direction that the template gives the hinges of a linkage, by one of them."""
    told = {j.direction for j in linkage if j.type == "revolute" and j.direction is not None}
    return told.pop() if len(told) == 1 else None


def direction_of(
    linkage: Sequence[JointTemplate], template: Template, bodies: Mapping[str, Body], lines: Mapping[str, Line],
    frame: Frame,
) -> Direction:  # fmt: skip
    """The direction of a linkage's hinges."""
    steering = is_upright(linkage, template)
    lengthwise = frame.forward if _told(linkage) == "lengthwise" else None
    expected = frame.up if steering else frame.left if lengthwise is None else lengthwise
    slides = [lines[j.name] for j in linkage if j.name in lines]
    names = sorted({str(b) for j in linkage for b in template.bodies_of(j)})
    ways, weights = _votes([bodies[n] for n in names if n in bodies], slides)
    if len(ways) and expected is not None:
        kept = np.abs(ways @ expected) > (UPRIGHT if steering else BENT)
        if not steering and frame.up is not None:
            kept &= np.abs(ways @ frame.up) < LEVEL
        # As the machine's own direction where there is a choice.
        weights = weights * np.where(np.abs(ways @ expected) > UPRIGHT, 2.0, 1.0)
        ways, weights = ways[kept], weights[kept]
    if len(ways):
        alike = np.abs(ways @ ways.T) > TOGETHER
        best = int(np.argmax(np.round(alike @ weights, 9)))
        kept = alike[best]
        if weights[kept].sum() > 0.3 * weights.sum():
            return _mean(ways[kept], weights[kept], ways[best], expected)
    near = None if steering else wheels_beside(names, template, bodies, frame)
    return _without_faces([bodies[n] for n in names if n in bodies], slides, expected if near is None else near)


def as_found(way: Direction, found: Sequence[Floats]) -> Direction:
    """The direction of a linkage's hinges as those of them have it that pins and bores showed (`found`, unit vectors):
    what is round in its bodies only says about where it is, and a linkage whose hinges are not parallel is locked.
    Two of them at least, which agree."""
    near = [v if float(v @ way.vector) > 0.0 else -v for v in found if abs(float(v @ way.vector)) > TOGETHER]
    if len(near) < 2:
        return way
    mean = unit(np.sum(near, axis=0))
    # Pins that lean by themselves tell nothing of the others.
    if min(float(v @ mean) for v in near) < _PARALLEL:
        return way
    return Direction(mean, min(way.angle, _EXACT), "the linkage's hinges that were found")


def wheels_beside(names: Sequence[str], template: Template, bodies: Mapping[str, Body], frame: Frame) -> Floats | None:
    """The axis of the wheels that hang on bodies of a linkage: it is the linkage's own direction where a machine is
    drawn as it steers."""
    wheels = {r.name for r in template.roles if r.kind == "wheel" and r.name in bodies}
    for joint in template.joints:
        pair = {str(b) for b in template.bodies_of(joint)}
        beside = sorted(pair & wheels)
        if len(beside) == 1 and pair & set(names):
            return wheel_direction(bodies[beside[0]], frame.left).vector
    return None


def completed(
    frame: Frame, linkages: Sequence[Sequence[JointTemplate]], template: Template, bodies: Mapping[str, Body],
    lines: Mapping[str, Line],
) -> Frame:  # fmt: skip
    """The machine's directions, those that are not known as its bodies tell them: left is what most pivots are along
    that are near to where its left is like its right; up what a large bearing or the steering's cylinders say, else how
    it stands. Their senses are not told."""
    left, up, forward = frame.left, frame.up, frame.forward
    if left is None and up is not None and forward is not None:
        left = np.cross(up, forward)
    if up is None and forward is not None and left is not None:
        up = np.cross(forward, left)
    upright = [linkage for linkage in linkages if is_upright(linkage, template)]
    if left is None or up is None:
        pitching = [j for linkage in linkages if linkage not in upright for j in linkage]
        names = sorted({str(b) for j in pitching for b in template.bodies_of(j)})
        slides = [lines[j.name] for j in pitching if j.name in lines]
        ways, weights = _votes([bodies[n] for n in names], slides)
        solids = [s for name in sorted(bodies) for s in bodies[name].solids]
        stance = stance_of(solids, bodies[min(bodies)].size, [] if left is not None else list(ways))
        if left is None:
            near = np.abs(ways @ stance.left) > NEAR_LEFT if len(ways) else np.zeros(0, dtype=bool)
            left = stance.left
            if near.any():
                ways, weights = ways[near], weights[near]
                alike = np.abs(ways @ ways.T) > TOGETHER
                best = int(np.argmax(np.round(alike @ weights, 9)))
                left = _mean(ways[alike[best]], weights[alike[best]], ways[best], None).vector
        if up is None:
            up = _upright_way(left, upright, template, bodies, lines)
        if up is None:
            stands = stance.rotation[2] - float(stance.rotation[2] @ left) * left
            up = unit(stands if float(np.linalg.norm(stands)) > 0.5 else np.cross(stance.rotation[0], left))
    return Frame(forward if forward is not None else np.cross(left, up), left, up)


def _upright_way(
    left: Floats, upright: Sequence[Sequence[JointTemplate]], template: Template, bodies: Mapping[str, Body],
    lines: Mapping[str, Line],
) -> Floats | None:  # fmt: skip
    """What is across left and the cylinders of a steering, or what a large bearing is along that both bodies on it
    have; None where neither says so."""
    for linkage in upright:
        for joint in linkage:
            if joint.name in lines and abs(float(lines[joint.name].direction @ left)) < 0.7:
                return unit(np.cross(left, lines[joint.name].direction))
    rings = [
        (c.radius**2 * c.arc, name, c.direction)
        for name in sorted({str(b) for linkage in upright for j in linkage for b in template.bodies_of(j)})
        for s in bodies[name].solids
        for c in s.cylinders
        if c.arc > 3.0 and 0.012 < c.radius / bodies[name].size < 0.25 and abs(float(c.direction @ left)) < ACROSS
    ]
    if not rings:
        return None
    ways, weights = np.array([d for *_, d in rings]), np.array([w for w, *_ in rings])
    alike = np.abs(ways @ ways.T) > TOGETHER
    best = int(np.argmax(np.round(alike @ weights, 9)))
    if len({name for (_, name, _), same in zip(rings, alike[best], strict=True) if same}) < 2:
        return None
    way = ways[best]
    return unit(way - (way @ left) * left)


def _votes(bodies: Sequence[Body], slides: Sequence[Line]) -> tuple[Floats, Floats]:
    """Directions (n, 3) of what may be a pivot's pin, bore or end, and their weights (n,)."""
    ways, weights = [], []
    for body in bodies:
        least, most = PIVOT[0] * body.size, PIVOT[1] * body.size
        for solid in body.solids:
            for face in solid.cylinders:
                if not least < face.radius < most or face.arc < 1.5:
                    continue
                if any(abs(float(face.direction @ line.direction)) > ACROSS for line in slides):
                    continue
                weight = min(face.arc, 2 * math.pi) * math.sqrt(face.radius * min(face.half, 4 * face.radius))
                ways.append(face.direction)
                weights.append(weight)
    return np.array(ways).reshape(-1, 3), np.array(weights)


def _mean(ways: Floats, weights: Floats, sense: Floats, expected: Floats | None) -> Direction:
    second = (ways * weights[:, None]).T @ ways / weights.sum()
    values, vectors = np.linalg.eigh(second)
    way = vectors[:, -1] if float(vectors[:, -1] @ sense) > 0 else -vectors[:, -1]
    scatter = math.sqrt(max(0.0, 1.0 - float(values[-1]) / float(values.sum())))
    angle = max(math.radians(0.1), scatter / math.sqrt(max(1.0, len(ways) / 4)))
    if expected is not None and abs(float(way @ expected)) > math.cos(math.radians(1.5)):
        # The machine's own axis was found from more than this linkage.
        toward = expected if float(expected @ way) > 0 else -expected
        share = angle**2 / (angle**2 + math.radians(0.3) ** 2)
        way = unit((1 - share) * way + share * toward)
    return Direction(way, angle, "what is round in its bodies")


def _without_faces(bodies: Sequence[Body], slides: Sequence[Line], expected: Floats | None) -> Direction:
    if expected is not None:
        return Direction(expected, math.radians(1.0), "the machine's own direction")
    best = (0.0, np.zeros(3))
    for i, one in enumerate(slides):
        for other in slides[i + 1 :]:
            normal = np.cross(one.direction, other.direction)
            if np.linalg.norm(normal) > best[0] + 1e-9:
                best = (float(np.linalg.norm(normal)), normal)
    if best[0] > 0.15:
        lean = math.hypot(*(line.angle for line in slides[:2])) / best[0]
        return Direction(unit(best[1]), max(math.radians(0.5), lean), "across its cylinders")
    points = np.concatenate([b.samples for b in bodies])
    way = np.linalg.eigh(np.cov((points - points.mean(axis=0)).T))[1][:, 0]
    return Direction(np.asarray(way, dtype=np.float64), math.radians(5.0), "the least extent of its bodies")


def wheel_direction(wheel: Body, left: Floats | None) -> Direction:
    """The direction of a wheel's axis; `left` is the machine's, if it is known."""
    faces = [c for s in wheel.solids for c in s.cylinders if c.arc > 3.0 and LEAST_WHEEL * wheel.size < c.radius]
    if left is not None:
        faces = [c for c in faces if abs(float(c.direction @ left)) > 0.8]
    if faces:
        weight = np.array([c.radius**2 * c.arc for c in faces])
        ways = np.array([c.direction for c in faces])
        alike = np.abs(ways @ ways.T) > math.cos(math.radians(3.0))
        best = int(np.argmax(np.round(alike @ weight, 12)))
        kept = ways[alike[best]] * np.sign(ways[alike[best]] @ ways[best])[:, None]
        mean = weight[alike[best]] @ kept
        return Direction(mean / np.linalg.norm(mean), math.radians(0.2), "what is round in it")
    points = wheel.samples
    values, vectors = np.linalg.eigh(np.cov((points - points.mean(axis=0)).T))
    odd = 0 if values[1] - values[0] > values[2] - values[1] else 2
    own = np.asarray(vectors[:, odd], dtype=np.float64)
    if left is not None and abs(float(own @ left)) < math.cos(math.radians(25.0)):
        return Direction(left, math.radians(3.0), "the machine's own direction")
    return Direction(own, math.radians(1.0), "its shape")
