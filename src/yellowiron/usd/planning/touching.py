"""What a body touches the world with: few convex solids that stand for its parts together.

The template's approximation of a part (`collision`) says how that part would collide alone. Most of what is drawn
touches nothing: bushes in their bosses, bolts, what stands under a hood. So the parts' solids are taken together, body
by body. One that the others cover is left out, and two whose hull is hardly more than they are become that hull; then
a body's colliders are as near to its parts' as `FINE` of its size. A part whose approximation a user's own document
names is no member of this, nor is what runs in rings of track shoes: these collide as told.

A solid is covered where no point of its surface stands out of the others of its body, and of those of the bodies that
it is jointed to, in every one of several poses of these joints: a pin in its neighbour's boss, a piston in its barrel.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial.transform import Rotation

from yellowiron.model.geometry import Floats, Mesh, Shape
from yellowiron.model.mechanism import Joint, Mechanism, chained, rolling
from yellowiron.model.template import Material
from yellowiron.support.caching.disk import kept
from yellowiron.support.convex.pieces import convex_pieces
from yellowiron.support.convex.solids import (
    Boxes,
    Convex,
    Unions,
    convex,
    merged,
    outermost,
    spacing_of,
    uncovered,
    with_few_corners,
)
from yellowiron.usd.authoring.merge_points import weld
from yellowiron.usd.planning.lathe_colliders import turned_pieces
from yellowiron.usd.planning.primitives import Primitive, enclosing, fit_primitive

POOLED = ("analytic", "convexDecomposition", "convexHull", "turned")
"""The approximations whose solids are taken together."""
FINE = 0.015
"""Of a body's size (its box's diagonal): how far its colliders may be from its parts' …"""
COARSE = (0.05, 0.08, 0.12, 0.16, 0.2)
"""… and in the light variant: the first of these with which the machine has at most …"""
MOST = 60
"""… so many colliders, or the last."""
EDGE = 5e-3
"""Metres that leaving out a solid may take from its body's outline, unless it is a small one …"""
SMALL = 0.05
"""… as bolts are: of the body's size."""
ALIKE = 0.4
"""Dynamic friction in steps of this rubs alike: what steels are said to have is one, rubber and chrome are not."""
AROUND = 8
"""Poses of a joint that turns without end."""
FROM_END_TO_END = 5
"""Poses of one with limits."""


@dataclass(frozen=True, eq=False)
class Touching:
    """A collider, metres: a `primitive` or a `solid`, which is its likeness. `parts` are the ids of the CAD parts that
    it stands for, `label` the name of the largest. Only what `rubs` alike is taken together."""

    label: str
    material: str
    parts: tuple[str, ...]
    solid: Convex
    primitive: Primitive | None = None
    rubs: tuple[int, str] = (0, "")

    def shifted(self, by: Floats) -> Touching:
        """The collider moved by (3,) metres."""
        primitive = self.primitive
        if primitive is not None:
            primitive = replace(primitive, center=primitive.center + by)
        return replace(self, solid=self.solid.shifted(by), primitive=primitive)


Pool = dict[str, list[Touching]]
"""The colliders of bodies by name, machine frame."""


def told_alone(mechanism: Mechanism) -> frozenset[str]:
    """The bodies whose parts collide as told: track shoes, and what they run on."""
    return chained(mechanism) | (rolling(mechanism) if mechanism.floating else frozenset())


def solids_of(shape: Shape, token: str) -> tuple[Mesh | Primitive, ...]:
    """The solids of a shape by its approximation, in its own frame."""
    if token == "analytic" and (primitive := fit_primitive(shape)) is not None:
        return (primitive,)
    if token == "turned" and (pieces := turned_pieces(shape)):
        return pieces
    points, triangles, _ = weld(shape.mesh)
    mesh = Mesh(points.astype(np.float64), triangles)
    return convex_pieces(mesh) if token == "convexDecomposition" and len(triangles) else (mesh,)


def as_drawn(
    solids: Iterable[Mesh | Primitive], matrix: Floats, *, label: str, material: Material | None, key: str, part: str
) -> Iterable[Touching]:
    """The colliders of one part, whose solids are placed by `matrix` (4, 4); `key`: the material's name there."""
    rubs = 0, ""
    if material is not None:
        rubs = round((material.dynamic_friction or 0.0) / ALIKE), material.friction_combine or ""
    for solid in solids:
        primitive = solid.placed(matrix) if isinstance(solid, Primitive) else None
        if primitive is not None:
            yield Touching(label, key, (part,), convex(primitive.surface()), primitive, rubs)
        else:
            points = solid.surface() if isinstance(solid, Primitive) else solid.points
            made = with_few_corners(convex(points @ matrix[:3, :3].T + matrix[:3, 3]))
            yield Touching(label, key, (part,), made, None, rubs)


def fine_and_light(mechanism: Mechanism, drawn: Pool) -> tuple[Pool, Pool]:
    """The colliders that stand for those that are drawn, and still fewer, simple ones where these will do. They are
    kept between runs."""
    joints = [(j.type, j.body0, j.body1, j.anchor, j.axis, j.lower, j.upper, j.cut) for j in mechanism.joints]
    own = sum(len(body.shapes) for body in mechanism.bodies)
    rounds = sorted(rolling(mechanism))

    def make() -> tuple[Pool, Pool]:
        unions: Unions = {}
        full = _fine(mechanism, drawn, unions)
        return full, _light(full, own, frozenset(rounds), unions)

    return kept("colliders", make, joints, own, rounds, drawn)


def _fine(mechanism: Mechanism, drawn: Pool, unions: Unions) -> Pool:
    left = _without_covered(mechanism, drawn)
    return {
        name: _together(left[name], FINE * size_of(solids), unions, round_too=False) for name, solids in drawn.items()
    }


def _light(made: Pool, own: int, rounds: frozenset[str], unions: Unions) -> Pool:
    """`own` colliders are there besides; what rolls (`rounds`) stays round."""
    fewer = made
    for share in COARSE:
        fewer = {
            name: _simple(solids, share * size_of(solids), unions, round_too=name not in rounds)
            for name, solids in made.items()
        }
        if own + sum(map(len, fewer.values())) <= MOST:
            break
    return fewer


def size_of(solids: Iterable[Touching]) -> float:
    """The diagonal of the box around solids, metres."""
    corners = [one.solid.corners for one in solids]
    return float(np.linalg.norm(np.ptp(np.concatenate(corners), axis=0))) if corners else 0.0


# ---- what others cover ----------------------------------------------------------------------------------------------
def _without_covered(mechanism: Mechanism, drawn: Pool) -> Pool:
    """Those that stand out, the smallest tried first."""
    left = {name: dict(enumerate(solids)) for name, solids in drawn.items()}
    boxes = {name: Boxes((one.solid for one in solids), most=len(solids)) for name, solids in drawn.items()}
    within = {name: FINE * size_of(solids) for name, solids in drawn.items()}
    poses = {name: _neighbours(mechanism, name) for name in drawn}
    outlines = {name: _outline(left[name]) for name in drawn}
    order = [(one.solid.volume, name, number) for name, them in drawn.items() for number, one in enumerate(them)]
    for _, name, number in sorted(order):
        if len(left[name]) == 1:
            continue  # a body that is all inside its neighbours keeps its largest
        one = left[name].pop(number)
        edge = number in outlines[name] and _is_edge(one, left[name].values(), within[name])
        near = EDGE if edge else within[name]
        beside = [left[name][other] for other in boxes[name].near(one.solid, near) if other != number]
        if _is_covered(one, beside, poses[name], left, near):
            boxes[name].drop(number)
            if number in outlines[name]:
                outlines[name] = _outline(left[name])
        else:
            left[name][number] = one
    return {name: [solids[number] for number in sorted(solids)] for name, solids in left.items()}


def _outline(solids: Mapping[int, Touching]) -> frozenset[int]:
    """The numbers of those that the hull of all of them has corners of."""
    if not solids:
        return frozenset()
    corners = np.concatenate([one.solid.corners for one in solids.values()])
    owner = np.repeat(list(solids), [len(one.solid.corners) for one in solids.values()])
    return frozenset(np.unique(owner[outermost(corners)]).tolist())


def _neighbours(mechanism: Mechanism, body: str) -> list[list[tuple[str, Floats]]]:
    """The bodies jointed to one, each with the motion (4, 4) that takes a point of the one to where it is among the
    other's drawn solids; pose by pose of the joints."""
    joints = [joint for joint in mechanism.joints if body in (joint.body0, joint.body1)]
    turning = [joint for joint in joints if _has_no_ends(joint)]
    shares = np.linspace(0.0, 1.0, AROUND + 1 if turning else FROM_END_TO_END)
    found: list[list[tuple[str, Floats]]] = []
    for share in (None, *shares.tolist()):
        pose: list[tuple[str, Floats]] = []
        for joint in joints:
            motion = _motion(joint, 0.0 if share is None else _coordinate(joint, share))
            if body == joint.body0:
                pose.append((joint.body1, np.asarray(np.linalg.inv(motion), dtype=np.float64)))
            else:
                pose.append((joint.body0, motion))
        found.append(pose)
    return found


def _has_no_ends(joint: Joint) -> bool:
    return joint.type != "fixed" and (joint.lower is None or joint.upper is None)


def _coordinate(joint: Joint, share: float) -> float:
    if joint.lower is not None and joint.upper is not None:
        return joint.lower + share * (joint.upper - joint.lower)
    return 2.0 * np.pi * share if joint.type in ("revolute", "spherical") else 0.0


def _motion(joint: Joint, value: float) -> Floats:
    """The rigid motion (4, 4) of `body1` in `body0` from the drawn pose to that coordinate."""
    axis, anchor = np.asarray(joint.axis), np.asarray(joint.anchor)
    made = np.eye(4)
    if joint.type == "prismatic":
        made[:3, 3] = value * axis
    elif joint.type in ("revolute", "spherical"):
        made[:3, :3] = Rotation.from_rotvec(value * axis).as_matrix()
        made[:3, 3] = anchor - made[:3, :3] @ anchor
    return made


def _is_covered(
    one: Touching,
    beside: Sequence[Touching],
    poses: Sequence[Sequence[tuple[str, Floats]]],
    left: Mapping[str, Mapping[int, Touching]],
    within: float,
) -> bool:
    """Whether no point of its surface stands out of those `beside` it in its body and, in every pose, of what is `left`
    of the bodies that this one is jointed to."""
    points = one.solid.surface(spacing_of(within))
    largest_first = sorted((other.solid for other in beside), key=lambda solid: -solid.volume)
    points = points[uncovered(points, largest_first, within)]
    for pose in poses if len(points) else ():
        open_ = points
        for name, motion in pose:
            moved = open_ @ motion[:3, :3].T + motion[:3, 3]
            open_ = open_[uncovered(moved, (o.solid for o in left.get(name, {}).values()), within)]
            if not len(open_):
                break
        if len(open_):
            return False
    return True


def _is_edge(one: Touching, others: Collection[Touching], within: float) -> bool:
    """Whether the body's outline would be missing it: a cutting edge that hardly stands out of what it is on."""
    size = float(np.linalg.norm(np.ptp(one.solid.corners, axis=0)))
    if not others or size <= SMALL / FINE * within:
        return False
    rest = convex(np.concatenate([other.solid.corners for other in others]))
    return bool(rest.beyond(one.solid.corners).max() > EDGE)


# ---- fewer ----------------------------------------------------------------------------------------------------------
def _together(solids: Sequence[Touching], within: float, unions: Unions, *, round_too: bool) -> list[Touching]:
    """As few as stand for them within a tolerance, of what rubs alike. Round and square ones stay what they are, unless
    `round_too`."""
    made = [] if round_too else [one for one in solids if one.primitive is not None]
    rest = [one for one in solids if round_too or one.primitive is None]
    for rubs in dict.fromkeys(one.rubs for one in rest):
        made += _merged([one for one in rest if one.rubs == rubs], within, unions)
    return made


def _merged(rest: Sequence[Touching], within: float, unions: Unions) -> list[Touching]:
    made = []
    for solid, members in merged([one.solid for one in rest], within, unions):
        stood_for = sorted((rest[number] for number in members), key=lambda one: -one.solid.volume)
        first = stood_for[0]
        parts = tuple(dict.fromkeys(part for one in stood_for for part in one.parts))
        primitive = first.primitive if len(stood_for) == 1 else None
        made.append(Touching(first.label, first.material, parts, with_few_corners(solid), primitive, first.rubs))
    return made


def _simple(solids: Sequence[Touching], within: float, unions: Unions, *, round_too: bool) -> list[Touching]:
    """A shape in place of a hull reaches down no farther than it but by `EDGE`: else it would lift a machine off the
    ground."""
    made = []
    for one in _together(solids, within, unions, round_too=round_too):
        primitive = one.primitive or enclosing(one.solid, within)
        if primitive is None or primitive.surface()[:, 2].min() < one.solid.low[2] - EDGE:
            made.append(one)
        else:
            made.append(replace(one, primitive=primitive))
    return made
