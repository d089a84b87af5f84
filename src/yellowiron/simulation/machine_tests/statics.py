"""What a posed machine bears, by statics on the closed-chain kinematics: exact and cheap, the check beside an engine's
figure. SI; the ground is z = 0 of the machine frame."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy.optimize import linprog

from yellowiron.kinematics import ClosedChain, State, beside
from yellowiron.kinematics.measuring.quantities import Unmeasurable, wheels
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import GRAVITY, Mechanism, Site
from yellowiron.simulation.ground import TOUCHING, standing_bodies

_RIM = 0.98
"""Of a wheel's radius: what is as far out is on its rim, of a ball in a band of two fifths of its width."""


def place(chain: ClosedChain, state: State, site: Site, offset: float = 0.0) -> Floats:
    """Where a site is (3,), moved along its x axis by `offset` metres."""
    point = np.asarray(site.position) + offset * np.asarray(site.x_axis)
    moved = chain.displacement(state, site.body) @ np.append(point, 1.0)
    return np.asarray(moved[:3], dtype=np.float64)


def motion(chain: ClosedChain, state: State, joint: str, site: Site, offset: float = 0.0) -> Floats:
    """Velocity (3,) of a site per unit velocity of an independent coordinate, the others held."""
    ends, way = beside(chain, state, joint)
    if way <= 0.0:
        raise Unmeasurable(f"the linkage locks at '{joint}'")
    return (place(chain, ends[1], site, offset) - place(chain, ends[0], site, offset)) / way


def actuator_force(mechanism: Mechanism, name: str, *, positive: bool) -> float:
    """Force (N) of all cylinders of an actuator at their pressure, in its positive or negative sense, by whether each
    then pushes or pulls; its drive's where it has no cylinders."""
    actuator = next(a for a in mechanism.actuators if a.name == name)
    slides = {c.slide: c for c in mechanism.cylinders}
    forces = [
        slides[e.joint].push_force if (e.sign > 0) == positive else slides[e.joint].pull_force
        for e in actuator.joints
        if e.joint in slides
    ]
    drive = mechanism.joint(actuator.joints[0].joint).drive
    return sum(forces) if forces else (drive.max_force if drive is not None else math.inf)


def actuator_area(mechanism: Mechanism, name: str, *, positive: bool) -> float:
    """Area (m²) that the flow to an actuator fills in that sense: of all its cylinders."""
    actuator = next(a for a in mechanism.actuators if a.name == name)
    slides = {c.slide: c for c in mechanism.cylinders}
    total = 0.0
    for entry in actuator.joints:
        if entry.joint in slides:
            one = slides[entry.joint]
            rod = 0.0 if (entry.sign > 0) == positive else one.rod_diameter
            total += 0.25 * math.pi * (one.bore**2 - rod**2)
    return total


def supports(mechanism: Mechanism, chain: ClosedChain, state: State) -> tuple[tuple[str, Floats], ...]:
    """(body, point (3,)) wherever the machine stands: under both edges of every wheel on the ground, and the lowest
    corners of whatever else stands there. A body with hidden wheels under its tracks (which its `pads` tell) stands on
    them, as it does in an engine: their shoes touch nothing there."""
    rolling = {joint.body1: (joint, radius) for joint, radius in wheels(mechanism)}
    found: list[tuple[str, Floats]] = []
    for name in standing_bodies(mechanism):
        if mechanism.body(name).pads:
            continue
        hull = np.asarray(mechanism.body(name).hull)
        if name not in rolling:
            pose = chain.displacement(state, name)
            points = hull @ pose[:3, :3].T + pose[:3, 3]
            found += [(name, p) for p in points[points[:, 2] < points[:, 2].min() + TOUCHING]]
            continue
        joint, radius = rolling[name]
        pose = chain.displacement(state, joint.body0)
        axis, anchor = pose[:3, :3] @ np.asarray(joint.axis), np.append(joint.anchor, 1.0)
        along = (hull - np.asarray(joint.anchor)) @ np.asarray(joint.axis)
        down = np.array([0.0, 0.0, -1.0]) + axis[2] * axis
        lowest = (pose @ anchor)[:3] + radius * down / np.linalg.norm(down)
        found += [
            (name, lowest + share * axis)
            for share in _edges(hull - np.asarray(joint.anchor), along, joint.axis, radius)
        ]
    return tuple(found)


def _edges(points: Floats, along: Floats, axis: Sequence[float], radius: float) -> tuple[float, ...]:
    """Where along its axis a wheel of those points (n, 3), from its middle, bears: at both edges, or, of a ball (a
    track's hidden wheel), under its middle."""
    out = np.linalg.norm(points - along[:, None] * np.asarray(axis), axis=1)
    round_ = along[out >= _RIM * radius]
    if len(round_) and np.ptp(round_) < 0.5 * np.ptp(along):
        return (float(0.5 * (round_.min() + round_.max())),)
    return float(along.min()), float(along.max())


def tipping_force(mechanism: Mechanism, chain: ClosedChain, state: State, point: Floats, direction: Floats) -> float:
    """The largest force (N) at a point (3,), along a unit direction (3,), under which the machine still stands: for
    which forces under its wheels balance everything and none of them pulls. Axles that swing freely within limits bear
    no moment about their pivots. `Unmeasurable` where it does not stand at all, or no force tips it.

    A linear programme: forces under the wheels and the load, the latter largest. Forces along the ground turn nothing
    that it looks at.
    """
    rows, sums = _balance(mechanism, chain, state)
    load = np.concatenate([[direction[2]], np.cross(point, direction)[:2], np.zeros(len(rows) - 3)])
    solved = _solve(np.column_stack([rows, load]), sums, largest=True)
    if solved is None:
        raise Unmeasurable("the machine does not stand in this pose")
    if math.isinf(solved):
        raise Unmeasurable("no load tips the machine in this pose")
    return solved


def stands(mechanism: Mechanism, chain: ClosedChain, state: State) -> bool:
    """Whether the machine stands in a pose, on the same terms."""
    return _solve(*_balance(mechanism, chain, state), largest=False) is not None


def _balance(mechanism: Mechanism, chain: ClosedChain, state: State) -> tuple[Floats, Floats]:
    """Rows (equations, supports) and sums (equations,) that forces under the supports meet: upward, the moments about
    x and y, and those about the pivots of free axles."""
    under = supports(mechanism, chain, state)
    placed = {b.name: chain.displacement(state, b.name) for b in mechanism.bodies}
    centers = {b.name: (placed[b.name] @ np.append(b.center_of_mass, 1.0))[:3] for b in mechanism.bodies}
    up = np.array([0.0, 0.0, 1.0])
    weights = [GRAVITY * b.mass * np.concatenate([[1.0], np.cross(centers[b.name], up)[:2]]) for b in mechanism.bodies]
    rows = list(np.array([np.concatenate([[1.0], np.cross(p, up)[:2]]) for _, p in under]).reshape(-1, 3).T)
    sums = list(np.sum(weights, axis=0))
    children: dict[str, list[str]] = {}
    for joint in mechanism.joints:
        if not joint.cut:
            children.setdefault(joint.body0, []).append(joint.body1)
    for joint in mechanism.joints:
        if not joint.swings or joint.lower is None:
            continue
        swinging = _below(joint.body1, children)
        pose = placed[joint.body0]
        axis, anchor = pose[:3, :3] @ np.asarray(joint.axis), (pose @ np.append(joint.anchor, 1.0))[:3]
        rows.append(np.array([axis @ np.cross(p - anchor, up) if n in swinging else 0.0 for n, p in under]))
        own = (b for b in mechanism.bodies if b.name in swinging)
        sums.append(sum(GRAVITY * b.mass * float(axis @ np.cross(centers[b.name] - anchor, up)) for b in own))
    return np.array(rows), np.array(sums)


def _solve(rows: Floats, sums: Floats, *, largest: bool) -> float | None:
    """The last column's force where it is largest (infinite: without bound; 0 where it is not asked for); None where
    no forces of 0 or more meet the rows."""
    goal = np.zeros(rows.shape[1])
    goal[-1] = -1.0 if largest else 0.0
    # Scaled by the machine's weight: the solver's tolerances are absolute.
    scale = float(sums[0])
    solved = linprog(goal, A_eq=rows, b_eq=sums / scale, bounds=(0.0, None), method="highs")
    if solved.status == 3:
        return math.inf
    if solved.status != 0 or solved.x is None:
        return None
    return float(solved.x[-1]) * scale if largest else 0.0


def _below(body: str, children: dict[str, list[str]]) -> set[str]:
    found = {body}
    for child in children.get(body, ()):
        found |= _below(child, children)
    return found
