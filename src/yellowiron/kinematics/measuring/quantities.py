"""What can be measured on a posed machine: one function a kind (`docs/measurements.md`)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from typing import Any

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain, KinematicsError, State
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Joint, Mechanism, Site
from yellowiron.support.vectors import triple

_AXES = {"x": 0, "y": 1, "z": 2}
_ON_EDGE = 1e-9
"""Metres: a zone's edge is in it, however its place is rounded."""
_PARALLEL = 1e-4
"""Axles whose cosine is this near to 1 (0.8°) are parallel."""
_UPRIGHT = 1e-6
"""A direction whose level share is less than this has no side."""
_TYRE = 0.7
"""What is farther out than this share of a wheel's radius is its tyre: a hub may stand out beside it."""


class Unmeasurable(Exception):  # noqa: N818 - it ends one measurement with a reason, it is no error of the program
    """Why one measurement has no value, as one sentence."""


class Hulls:
    """Corners of bodies' hulls in poses. Most bodies stand still while one actuator moves, so each body's last is
    kept."""

    def __init__(self, chain: ClosedChain) -> None:
        self._chain = chain
        self._corners: dict[str, tuple[bytes, Floats]] = {}
        self._boxes: dict[str, tuple[bytes, Floats]] = {}

    def corners(self, state: State, body: Body) -> Floats:
        """Corners (n, 3), machine frame; not to be written to."""
        pose = self._chain.displacement(state, body.name)
        key = pose.tobytes()
        known = self._corners.get(body.name)
        if known is None or known[0] != key:
            corners = np.asarray(body.hull @ pose[:3, :3].T + pose[:3, 3], dtype=np.float64)
            known = self._corners[body.name] = (key, corners)
        return known[1]

    def box(self, state: State, body: Body) -> Floats:
        """Least and greatest coordinates (2, 3) of the corners."""
        corners = self.corners(state, body)
        key = self._corners[body.name][0]
        known = self._boxes.get(body.name)
        if known is None or known[0] != key:
            # By columns: over rows of three numpy takes five times as long.
            columns = np.ascontiguousarray(corners.T)
            known = self._boxes[body.name] = (key, np.array([columns.min(axis=1), columns.max(axis=1)]))
        return known[1]


@dataclass(frozen=True, eq=False)
class Posed:
    """A machine in a pose. `straight` gives a joint's coordinate in the straight machine; `rolling`: its wheels;
    `after`: the state that steps lead to from here."""

    chain: ClosedChain
    mechanism: Mechanism
    state: State
    straight: Callable[[str], float]
    rolling: Sequence[tuple[Joint, float]]
    hulls: Hulls
    after: Callable[[Sequence[Mapping[str, Any]]], State]

    def point(self, body: str, position: Sequence[float]) -> Floats:
        """A point of a body, given in the drawn pose, where it is now: machine frame (3,)."""
        moved = self.chain.displacement(self.state, body) @ np.array([*position, 1.0])
        return np.asarray(moved[:3], dtype=np.float64)

    def direction(self, body: str, vector: Sequence[float]) -> Floats:
        """A direction of a body, given in the drawn pose, as it points now (3,)."""
        turned = self.chain.displacement(self.state, body)[:3, :3] @ np.array(vector)
        return np.asarray(turned, dtype=np.float64)

    def hull(self, body: Body) -> Floats:
        """Corners (n, 3) of a body's hulls where they are now; not to be written to."""
        return self.hulls.corners(self.state, body)


def evaluate(quantity: Mapping[str, Any], posed: Posed) -> float:
    """A quantity's value in SI in a posed machine; `Unmeasurable` where the machine lacks what it names."""
    kind = str(quantity.get("kind", ""))
    if kind not in _KINDS:
        raise Unmeasurable(f"there is no quantity of kind '{kind}'")
    return float(quantity.get("factor", 1)) * _KINDS[kind](quantity, posed)


def wheels(mechanism: Mechanism) -> tuple[tuple[Joint, float], ...]:
    """Wheel joints with their tyres' radius (metres): tree pivots outside all loops that turn without limit about a
    level crosswise axis. The radius is that of the hull's farthest corner, which lies on the tread; its front-most
    corner need not."""
    looped = {name for loop in mechanism.loops for name in loop.joints}
    found = []
    for joint in mechanism.joints:
        unlimited = joint.lower is None and joint.upper is None and joint.name not in looped
        if joint.type != "revolute" or joint.cut or not unlimited or abs(joint.axis[1]) < 0.9:
            continue
        hull = np.asarray(mechanism.body(joint.body1).hull, dtype=np.float64).reshape(-1, 3)
        if len(hull):
            away = hull - np.array(joint.anchor)
            axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
            away -= np.outer(away @ axis, axis)
            found.append((joint, float(np.linalg.norm(away, axis=1).max())))
    return tuple(found)


def _site(quantity: Mapping[str, Any], posed: Posed) -> Site:
    for site in posed.mechanism.sites:
        if site.name == quantity.get("site"):
            return site
    raise Unmeasurable(f"the machine has no site '{quantity.get('site', '')}'")


def _joint(name: object, posed: Posed) -> Joint:
    for joint in posed.mechanism.joints:
        if joint.name == name:
            return joint
    raise Unmeasurable(f"the machine has no joint '{name}'")


def _place(quantity: Mapping[str, Any], posed: Posed) -> Floats:
    if "site" in quantity:
        site = _site(quantity, posed)
        return posed.point(site.body, site.position)
    joint = _joint(quantity.get("joint"), posed)
    return posed.point(joint.body0, joint.anchor)


def _height(quantity: Mapping[str, Any], posed: Posed) -> float:
    """z of a site or of a joint's anchor above the ground, which is z = 0 of the machine frame."""
    return float(_place(quantity, posed)[2])


def _rise(quantity: Mapping[str, Any], posed: Posed) -> float:
    """How much higher a site or a joint's anchor is than after the steps `above`, made from here: a mast's lift."""
    below = replace(posed, state=posed.after(quantity.get("above", ())))
    return _height(quantity, posed) - _height(quantity, below)


def _angle(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Pitch of a site's x axis: 0 level, positive where it points up; ±π where it points back."""
    site = _site(quantity, posed)
    x = posed.direction(site.body, site.x_axis)
    return math.atan2(float(x[2]), math.copysign(math.hypot(x[0], x[1]), x[0]))


def _yaw(quantity: Mapping[str, Any], posed: Posed) -> float:
    """How far what carries a level joint is turned to the left of straight ahead: its axis against the machine's y; or
    the line from one of two sites to the other, both on what turns."""
    if "sites" in quantity:
        line = _line(quantity, posed)
        line = line if line[1] >= 0.0 else -line
        return math.atan2(-float(line[0]), float(line[1]))
    joint = _joint(quantity.get("joint"), posed)
    axis = posed.direction(joint.body0, joint.axis)
    axis = axis if axis[1] >= 0.0 else -axis
    return math.atan2(-float(axis[0]), float(axis[1]))


def _slope(quantity: Mapping[str, Any], posed: Posed) -> float:
    """How steeply the line from one site to another rises."""
    line = _line(quantity, posed)
    return math.atan2(float(line[2]), math.hypot(line[0], line[1]))


def _line(quantity: Mapping[str, Any], posed: Posed) -> Floats:
    """From the first of two sites to the second (3,)."""
    ends = [_place({"site": name}, posed) for name in quantity["sites"]]
    if len(ends) != 2:
        raise Unmeasurable("a line needs two sites")
    return np.asarray(ends[1] - ends[0])


def _roll(quantity: Mapping[str, Any], posed: Posed) -> float:
    """How far a site's body is rolled about its own lengthwise direction, less as drawn: positive where its left side
    goes down and its right side up."""
    site = _site(quantity, posed)
    left = np.cross((0.0, 0.0, 1.0), site.x_axis)
    size = float(np.linalg.norm(left))
    if size < _UPRIGHT:
        raise Unmeasurable(f"the site '{site.name}' looks straight up or down")
    side = posed.direction(site.body, triple(left / size))
    return math.atan2(-float(side[2]), math.hypot(side[0], side[1]))


def _between(quantity: Mapping[str, Any], posed: Posed) -> float:
    """The angle between the x axes of two sites, 0 to π."""
    first, second = (_site({"site": name}, posed) for name in _two(quantity, "sites"))
    one, other = (posed.direction(site.body, site.x_axis) for site in (first, second))
    return math.atan2(float(np.linalg.norm(np.cross(one, other))), float(one @ other))


def _difference(quantity: Mapping[str, Any], posed: Posed) -> float:
    """The first of two quantities less the second, both of this pose."""
    first, second = _two(quantity, "quantities")
    return evaluate(first, posed) - evaluate(second, posed)


def _two(quantity: Mapping[str, Any], key: str) -> Sequence[Any]:
    named: Sequence[Any] = quantity.get(key, ())
    if len(named) != 2:
        raise Unmeasurable(f"a '{quantity.get('kind')}' needs two {key}")
    return named


def _reach(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Level distance along x to a site or joint, positive ahead, from the anchor of the joint `from` (a swing axis),
    else from the front of the front-most tyres (of `bodies`, where named)."""
    if "from" in quantity:
        return float(_place(quantity, posed)[0] - _place({"joint": quantity["from"]}, posed)[0])
    rolling = [each for each in posed.rolling if each[0].body1 in quantity.get("bodies", each[0].body1)]
    if not rolling:
        raise Unmeasurable("the machine has no wheels to measure the reach from")
    front = max(float(posed.point(j.body0, j.anchor)[0]) + radius for j, radius in rolling)
    return float(_place(quantity, posed)[0]) - front


def _joint_angle(quantity: Mapping[str, Any], posed: Posed) -> float:
    """A joint's coordinate from the straight machine, cut joints included, or from that after the steps `above`."""
    joint = _joint(quantity.get("joint"), posed)
    if "above" in quantity:
        below = posed.after(quantity["above"])
        return posed.chain.coordinate(posed.state, joint.name) - posed.chain.coordinate(below, joint.name)
    return posed.chain.coordinate(posed.state, joint.name) - posed.straight(joint.name)


def _joint_range(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Upper less lower limit of a joint."""
    joint = _joint(quantity.get("joint"), posed)
    if joint.lower is None or joint.upper is None:
        raise Unmeasurable(f"the joint '{joint.name}' has no limits")
    return joint.upper - joint.lower


def _travel(quantity: Mapping[str, Any], posed: Posed) -> float:
    """How far up or down a site goes as a free joint turns from one limit to the other; what is on loops with it
    follows."""
    joint = _joint(quantity.get("joint"), posed)
    if joint.lower is None or joint.upper is None or joint.name not in posed.chain.independent:
        raise Unmeasurable(f"the joint '{joint.name}' does not go from one limit to another by itself")
    heights = []
    for end in (joint.lower, joint.upper):
        try:
            state = posed.chain.solve({joint.name: end}, start=posed.state)
        except KinematicsError as error:
            raise Unmeasurable(f"the linkage locks on the way to a limit of '{joint.name}'") from error
        heights.append(_height({"site": quantity.get("site")}, replace(posed, state=state)))
    return abs(heights[1] - heights[0])


def _bodies(quantity: Mapping[str, Any], posed: Posed) -> list[Body]:
    wanted = quantity.get("bodies", "*")
    names = [wanted] if isinstance(wanted, str) else list(wanted)
    found = [b for b in posed.mechanism.bodies if len(b.hull) and any(fnmatchcase(b.name, name) for name in names)]
    if not found:
        raise Unmeasurable(f"none of these bodies has a shape: {', '.join(map(str, names))}")
    return found


def _extent(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Length, largest or smallest coordinate along an axis of the machine frame, over bodies' hulls, or over what of
    them is in a `zone`."""
    axis = _AXES[str(quantity.get("axis", "x"))]
    bodies = _bodies(quantity, posed)
    if quantity.get("zone"):
        values = _zone(quantity, np.concatenate([posed.hull(body) for body in bodies]))[:, axis]
    else:
        values = np.array([posed.hulls.box(posed.state, body)[:, axis] for body in bodies])
    low, high = float(values.min()), float(values.max())
    return {"length": high - low, "max": high, "min": low}[str(quantity.get("of", "length"))]


def _zone(quantity: Mapping[str, Any], corners: Floats) -> Floats:
    """The corners within a zone: axis → shares, 0 to 1, of their own extent along it."""
    inside = np.ones(len(corners), dtype=bool)
    for name, shares in quantity.get("zone", {}).items():
        along = corners[:, _AXES[str(name)]]
        low, high = along.min() + (along.max() - along.min()) * np.array(shares, dtype=np.float64)
        inside &= (along >= low - _ON_EDGE) & (along <= high + _ON_EDGE)
    if not inside.any():
        raise Unmeasurable("nothing of these bodies is in that zone")
    return np.asarray(corners[inside], dtype=np.float64)


def _radius(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Largest distance of bodies' corners, or of a site, from a joint's axis, or from the upright line midway between
    two `joints`; of `front` or `rear` only those ahead of it or behind."""
    if "joints" in quantity:
        start = np.mean([_place({"joint": name}, posed) for name in quantity["joints"]], axis=0)
        axis = np.array([0.0, 0.0, 1.0])
    else:
        joint = _joint(quantity.get("joint"), posed)
        start, axis = posed.point(joint.body0, joint.anchor), posed.direction(joint.body0, joint.axis)
    if "site" in quantity:
        corners = _place({"site": quantity["site"]}, posed)[None]
    else:
        corners = np.concatenate([posed.hull(body) for body in _bodies(quantity, posed)])
    away = corners - start
    side = {"front": 1.0, "rear": -1.0}.get(str(quantity.get("of", "")), 0.0)
    away = away[side * away[:, 0] >= 0.0]
    if not len(away):
        raise Unmeasurable("nothing of these bodies is on that side of the axis")
    away = away - np.outer(away @ axis, axis) / (axis @ axis)
    return float(np.linalg.norm(away, axis=1).max())


def _distance(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Distance of two joints' anchors or two sites, along an axis where one is named, or `along` that of a joint as it
    stands."""
    ends = [{"joint": n} for n in quantity.get("joints", ())] + [{"site": n} for n in quantity.get("sites", ())]
    if len(ends) != 2:
        raise Unmeasurable("a distance needs two joints or sites")
    one, two = (_place(end, posed) for end in ends)
    if "axis" in quantity:
        return float(abs(two - one)[_AXES[str(quantity["axis"])]])
    if "along" in quantity:
        joint = _joint(quantity["along"], posed)
        return float(abs((two - one) @ posed.direction(joint.body0, joint.axis)))
    return float(np.linalg.norm(two - one))


def _approach_angle(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Steepest ramp (from level) that touches the front-most tyres and that no corner of the bodies ahead of them
    reaches into: the least angle between the ground and the tangent from a corner to the tyres. Wheels do not count
    among the bodies."""
    if not posed.rolling:
        raise Unmeasurable("the machine has no wheels to approach a ramp with")
    centre, radius = max(
        ((posed.point(j.body0, j.anchor), r) for j, r in posed.rolling), key=lambda each: float(each[0][0])
    )
    turning = {joint.body1 for joint, _ in posed.rolling}
    hulls = [posed.hull(body) for body in _bodies(quantity, posed) if body.name not in turning]
    corners = np.concatenate([np.zeros((0, 3)), *hulls])[:, [0, 2]] - centre[[0, 2]]
    far = np.hypot(corners[:, 0], corners[:, 1])
    ahead = (corners[:, 0] > 0.0) & (far > radius)
    if not ahead.any():
        raise Unmeasurable("nothing of these bodies is ahead of the tyres")
    # The line from the corner that passes below the wheel's centre at the distance of the tread.
    angles = np.arctan2(corners[ahead, 1], corners[ahead, 0]) + np.arcsin(radius / far[ahead])
    return float(angles.min())


def _overhang(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Along an axis from a joint's anchor to the farthest corner of bodies: `of` `max` in its sense, `min` against
    it."""
    axis, of = _AXES[str(quantity.get("axis", "x"))], str(quantity.get("of", "max"))
    start = float(_place({"joint": quantity.get("joint")}, posed)[axis])
    end = _extent({**quantity, "of": of}, posed)
    return end - start if of == "max" else start - end


def _tyre_diameter(quantity: Mapping[str, Any], posed: Posed) -> float:
    """Twice the radius of the largest wheel (of `bodies`, where named)."""
    radii = [radius for joint, radius in posed.rolling if joint.body1 in quantity.get("bodies", joint.body1)]
    if not radii:
        raise Unmeasurable("the machine has no such wheels")
    return 2.0 * max(radii)


def _turning_radius(quantity: Mapping[str, Any], posed: Posed) -> float:
    """From the middle of the turn to the outer side of the outermost tyre, seen from above; `of` `min`: to the inner
    side of the innermost. The middle is where the axes of the wheels (of `bodies`, where named: a further axle would be
    steered as well) come nearest to each other (least squares): of two parallel axles of a bogie counts the line
    midway."""
    places, axes, halves = [], [], []
    for joint, radius in ((j, r) for j, r in posed.rolling if j.body1 in quantity.get("bodies", j.body1)):
        axis = posed.direction(joint.body0, joint.axis)[:2]
        hull = np.asarray(posed.mechanism.body(joint.body1).hull, dtype=np.float64) - np.array(joint.anchor)
        along = hull @ np.array(joint.axis)
        tyre = np.linalg.norm(hull, axis=1) ** 2 - along**2 > (_TYRE * radius) ** 2
        places.append(posed.point(joint.body0, joint.anchor)[:2])
        axes.append(axis / np.linalg.norm(axis))
        halves.append(float(np.abs(along[tyre]).max()))
    if not axes or min(abs(float(a @ axes[0])) for a in axes) > 1.0 - _PARALLEL:
        raise Unmeasurable("the machine's wheels are not steered")
    normals = np.column_stack([-np.array(axes)[:, 1], np.array(axes)[:, 0]])
    centre = np.linalg.lstsq(normals, np.sum(normals * np.array(places), axis=1), rcond=None)[0]
    sides = [p + sign * h * a for p, a, h in zip(places, axes, halves, strict=True) for sign in (1.0, -1.0)]
    far = np.linalg.norm(np.array(sides) - centre, axis=1)
    return float(far.min() if quantity.get("of") == "min" else far.max())


_KINDS: Mapping[str, Callable[[Mapping[str, Any], Posed], float]] = {
    "height": _height,
    "rise": _rise,
    "angle": _angle,
    "yaw": _yaw,
    "slope": _slope,
    "roll": _roll,
    "between": _between,
    "difference": _difference,
    "reach": _reach,
    "joint_angle": _joint_angle,
    "joint_range": _joint_range,
    "travel": _travel,
    "extent": _extent,
    "distance": _distance,
    "radius": _radius,
    "approach_angle": _approach_angle,
    "overhang": _overhang,
    "tyre_diameter": _tyre_diameter,
    "turning_radius": _turning_radius,
}
KINDS = tuple(_KINDS)
