"""Drive gains from the coupled dynamics: stable at the engines' step in every pose, the other drives acting too. SI.

A drive's damping d is explicit in MuJoCo: with the mass matrix M of the linkage in its drives' coordinates, a step of h
seconds swings to and fro from h·λ(D·M⁻¹) = 2 on. The row sums of D·M⁻¹, scaled by the roots of its diagonal, bound
every λ (Gershgorin's discs), so each drive can be given its share alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.kinematics.solver.pose_grid import PoseGrid
from yellowiron.kinematics.strength import carried, rated_load, weight
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import COMPUTED, PROVISIONAL, STATED, Drive, Joint

STEP = 1e-3
"""Seconds that the engines step, and the exported MJCF says."""
SHARE = 0.6
"""Of what a step bears: h·d is so many times the least mass. With the stiffness below, steps 3.05 times as long are
still stable."""
RATE = 55.0
"""Stiffness over damping, 1/s: a target that moves is followed 1/55 s behind."""
RATIO = 0.2
"""The least damping ratio with the mass that the drive moves in half of its poses, the rated load included: that of
real cylinders is 0.1 to 0.3."""
OUTRUN = 0.035
"""The machine's own weight makes a drive no faster than rated by more than this share, …"""
_SLIP = 0.12
"""… and its full force slows it by no more than this, so that a rated load is raised in about the time the flow takes
(loader, articulated dump truck: 8 % longer; with 0.5 by 20 and 23 %) …"""
_SPIN = 0.05
"""… for which it gets an inertia of its own, at most one that its force brings to its speed in so many seconds: nothing
beside what it moves, which takes a second."""
_SAGS = 0.02
"""A drive gives way to the weight on it by no more than this share of its travel: short strokes need more stiffness."""
_STIFFEST = 200.0
"""… but never more than so many times its damping, 1/s: a fifth of what the step bears."""
_OWN, _OTHERS, _LOOSE = 13, 25, 27
"""Poses sampled: of a drive's own component, of each other one, and of drives outside of all loops."""
_TOGETHER = 256
"""Poses whose mass matrices are inverted together."""
_MOUNTED = 0.01
"""A root with less of the machine's mass than this is something that it is mounted on, and held."""
USUAL = 0.95
"""A weight is that not passed in this share of the poses: near a dead point a short lever makes it ten times that."""


@dataclass(frozen=True, eq=False)
class Felt:
    """What drives feel over the poses. `free` (poses, n, n): mass matrices in the drives' coordinates, the root free;
    `moved` (n,): the mass each moves in half of them, root and others held, with the rated load; `force` (n, 2): the
    weight, N or N·m, that makes it go in its negative and its positive direction."""

    names: tuple[str, ...]
    free: Floats
    moved: Floats
    force: Floats


@dataclass(frozen=True, eq=False)
class Look:
    """What is felt in one pose, as in `Felt`: of the drives `own` the mass moved and the weight, N or N·m, signed."""

    pose: State
    free: Floats
    own: tuple[str, ...]
    moved: tuple[float, ...]
    weights: tuple[float, ...]


def set_gains(
    chain: ClosedChain, grids: Sequence[PoseGrid], joints: dict[str, Joint], *, ringed: bool = False
) -> tuple[Finding, ...]:
    """Gives the drives in `joints` their gains, over the poses of `grids`; what a template or a file states stays.

    - Damping d = 0.6 of what a step of 1 ms bears in any pose, the root and the other drives free to give way.
    - Stiffness k = 55 d, less where that would leave a damping ratio under 0.2 with the mass that it moves, more where
      the weight on it in the drawn pose would move it by 2 % of its travel.
    - Where a weight would drive it 3.5 % faster than rated, or its full force would slow it by more than an eighth, an
      armature makes room for more damping.
    - A velocity drive keeps the damping that its slip asks for, up to what the step bears with such an armature.
      `ringed`: the machine lies in rings of shoes, whose weight its sprockets turn besides: theirs stays.

    A finding KIN007 for a drive without force or speed, which gets no damping.
    """
    driven = driven_by(chain, joints)
    if not driven:
        return ()
    felt = felt_in(driven, looks(chain, poses_of(chain, grids, driven), driven))
    return give_gains(chain, felt, joints, ringed=ringed)


def driven_by(chain: ClosedChain, joints: Mapping[str, Joint]) -> tuple[str, ...]:
    """The independent joints that have a drive."""
    return tuple(name for name in chain.independent if joints[name].drive is not None)


def give_gains(
    chain: ClosedChain, felt: Felt, joints: dict[str, Joint], *, ringed: bool = False
) -> tuple[Finding, ...]:
    """`set_gains`, by what was felt already."""
    findings = []
    driven = felt.names
    armatures = _armatures(felt, joints, ringed=ringed)
    dampings = dampings_of(felt.free + np.diag(armatures))
    for number, name in enumerate(driven):
        joint, drive = joints[name], joints[name].drive
        assert drive is not None
        if drive.kind == "velocity":
            if drive.damping <= 0.0 and not (drive.max_force > 0.0 and drive.max_velocity > 0.0):
                words = "the drive has no force or no speed, so it gets no damping"
                findings.append(Finding("KIN007", "warning", name, words, ""))
                continue
            made = velocity_gains(drive, float(dampings[number]), keep=ringed, armature=float(armatures[number]))
        else:
            travel = joint.upper - joint.lower if joint.upper is not None and joint.lower is not None else None
            held = abs(weight(chain, chain.drawn, name)) if travel else 0.0
            made = position_gains(
                drive,
                float(dampings[number]),
                float(felt.moved[number]),
                unit="kg" if joint.type == "prismatic" else "kg·m²",
                softest=held / (_SAGS * travel) if travel else 0.0,
                armature=float(armatures[number]),
            )
        joints[name] = replace(joint, drive=made)
    return tuple(findings)


def position_gains(
    drive: Drive, damping: float, mass: float, *, unit: str = "kg", softest: float = 0.0, armature: float = 0.0
) -> Drive:
    """A position drive with the `damping` that the step bears (N·s/m, N·m·s/rad) and the stiffness that suits it and
    the `mass` it usually moves (kg, kg·m²), no less than `softest` (N/m, N·m/rad).

    Gains that the drive has stay, unless its source calls them provisional; those that "template states" names after
    that stay too. A stiffness that stays gets critical damping, d = 2√(km), where it has none.
    """
    provisional = PROVISIONAL in drive.source
    stated = drive.source.partition(STATED)[2]
    keep_stiffness = drive.stiffness > 0.0 and (not provisional or "stiffness" in stated)
    keep_damping = drive.damping > 0.0 and (not provisional or "damping" in stated)
    if keep_stiffness and keep_damping:
        return drive
    if keep_damping:
        damping, armature = drive.damping, 0.0
    elif keep_stiffness:
        damping, armature = 2.0 * math.sqrt(drive.stiffness * mass), 0.0
    whole = mass + armature
    rate = min(RATE, damping / (4.0 * RATIO**2 * whole)) if whole > 0.0 else RATE
    stiffness = min(max(rate * damping, softest), _STIFFEST * damping)
    if keep_stiffness:
        stiffness = drive.stiffness
        gains = "gains: damped critically for"
    elif keep_damping:
        gains = f"gains: stiffness {stiffness / damping:.3g} times a second its damping, for"
    else:
        gains = f"{COMPUTED} of {1e3 * STEP:g} ms bears in any pose; "
        gains += f"stiffness {stiffness / damping:.3g} times a second its damping, for"
    gains += f" the {_shown(mass, unit)} it moves"
    if armature > 0.0:
        gains += f", with {_shown(armature, unit)} of its own that no load changes its speed"
    source = drive.source.replace(PROVISIONAL, gains) if provisional else "; ".join(filter(None, (drive.source, gains)))
    return replace(drive, stiffness=stiffness, damping=damping, armature=armature, source=source)


def velocity_gains(drive: Drive, most: float, *, keep: bool = False, armature: float = 0.0) -> Drive:
    """A velocity drive with a damping of `most` at most (N·s/m, N·m·s/rad); one without gets the damping that gives
    full force at standstill and none at full speed. `keep`: what it has stays."""
    if drive.damping <= 0.0:
        source = "damping: full force at standstill, none at full speed"
        drive = replace(drive, damping=drive.max_force / drive.max_velocity, source=_joined(drive.source, source))
    elif keep or "damping" in drive.source.partition(STATED)[2]:
        return drive
    if armature > 0.0:
        drive = replace(drive, armature=armature)
    if drive.damping <= most:
        return drive
    return replace(drive, damping=most, source=_joined(drive.source, "damping: as much as the inertia it turns takes"))


def _joined(*texts: str) -> str:
    return "; ".join(filter(None, texts))


def _shown(mass: float, unit: str) -> str:
    return f"{1e-3 * mass:.4g} t" if unit == "kg" else f"{mass:.4g} {unit}"


def poses_of(
    chain: ClosedChain, grids: Sequence[PoseGrid], driven: tuple[str, ...]
) -> Iterator[tuple[State, Sequence[str]]]:
    """The poses that gains are found over, each with the drives whose masses and weights are looked at there."""
    yield chain.drawn, driven
    for component, grid in zip(chain.components(), grids, strict=True):
        own = [name for name in grid.drivers if name in driven]
        others = [pose for other in grids if other is not grid for pose in _spread(other.states, _OTHERS)]
        for state in _spread(grid.states, _OWN) if others else grid.states:
            for pose in [chain.combined(state, component, other) for other in others] or [state]:
                yield pose, own
    outside = [name for name in driven if all(name not in grid.drivers for grid in grids)]
    for pose in _outside(chain, outside):
        yield pose, outside


def looks(chain: ClosedChain, poses: Iterable[tuple[State, Sequence[str]]], driven: tuple[str, ...]) -> Iterator[Look]:
    """What is felt in poses; nothing in one that is a dead point."""
    columns = [chain.independent.index(name) for name in driven]
    load = rated_load(chain.mechanism)
    whole = sum(body.mass for body in chain.mechanism.bodies)
    mounted = chain.mechanism.body(chain.mechanism.root).mass < _MOUNTED * whole
    seen: list[tuple[State, Floats, Sequence[str], list[float], list[float]]] = []

    def looked() -> Iterator[Look]:
        # What nothing drives gives way as it likes.
        masses = np.linalg.inv(np.array([whole for _, whole, *_ in seen]))
        free = np.linalg.inv(masses[:, columns][:, :, columns])
        for (pose, _, own, moved, weights), one in zip(seen, free, strict=True):
            yield Look(pose, one, tuple(own), tuple(moved), tuple(weights))
        seen.clear()

    for pose, own in poses:
        try:
            fixed, loose = chain.masses(pose)
        except np.linalg.LinAlgError:  # a dead point
            continue
        moved, weights = [], []
        for name in own:
            column = columns[driven.index(name)]
            more = carried(chain, pose, name, *load) if load is not None else 0.0
            moved.append(float(fixed[column, column]) + more)
            weights.append(weight(chain, pose, name))
        seen.append((pose, fixed if mounted else loose, own, moved, weights))
        if len(seen) == _TOGETHER:
            yield from looked()
    if seen:
        yield from looked()


def felt_in(driven: tuple[str, ...], seen: Iterable[Look]) -> Felt:
    """What drives feel over poses."""
    free: list[Floats] = []
    moved: dict[str, list[float]] = {name: [] for name in driven}
    weights: dict[str, list[float]] = {name: [] for name in driven}
    for look in seen:
        free.append(look.free)
        for name, mass, force in zip(look.own, look.moved, look.weights, strict=True):
            moved[name].append(mass)
            weights[name].append(force)
    # What a push holds goes in the negative direction.
    ways = [[np.quantile(np.maximum(way * np.array(weights[name]), 0.0), USUAL) for way in (1, -1)] for name in driven]
    masses = [np.median(moved[name]) for name in driven]
    return Felt(driven, np.array(free), np.array(masses), np.array(ways))


def _outside(chain: ClosedChain, names: Sequence[str]) -> Iterator[State]:
    """Poses over the ranges of drives outside of all loops, the others as drawn."""
    limits = {name: (chain.mechanism.joint(name).lower, chain.mechanism.joint(name).upper) for name in names}
    ranges = {n: (low, high) for n, (low, high) in limits.items() if low is not None and high is not None}
    for place in np.random.default_rng(0).uniform(size=(_LOOSE if ranges else 0, len(ranges))):
        targets = {n: low + float(u) * (high - low) for (n, (low, high)), u in zip(ranges.items(), place, strict=True)}
        yield chain.reach(targets)[0]


def dampings_of(free: Floats) -> Floats:
    """The damping of each drive (n,) by the mass matrices of all poses (poses, n, n), root free."""
    return np.asarray(SHARE / STEP / loads_of(free).max(axis=0))


def loads_of(free: Floats) -> Floats:
    """How much of what a step bears a unit of each drive's damping takes in each pose (poses, n), 1/kg or 1/(kg·m²):
    the largest of a drive bounds its damping."""
    inverse = np.linalg.inv(free)
    own = np.sqrt(np.einsum("pii->pi", inverse))
    coupled = np.abs(inverse) / own[:, :, None] / own[:, None, :]
    return np.asarray(own**2 * coupled.sum(axis=2))


def _armatures(seen: Felt, joints: dict[str, Joint], *, ringed: bool) -> Floats:
    """The inertia (n,) that drives need of their own: position drives for a damping by which no weight outruns them,
    velocity drives for the damping that they ask for."""
    dampings = dampings_of(seen.free)
    made = np.zeros(len(seen.names))
    for number, name in enumerate(seen.names):
        drive = joints[name].drive
        if drive is None or (drive.kind == "velocity" and ringed):
            continue
        for force, other, most, speed in zip(
            seen.force[number], reversed(drive.forces), drive.forces, drive.speeds, strict=True
        ):
            if not (0.0 < speed < math.inf and 0.0 < most < math.inf):
                continue
            damping = max(min(force, other) / OUTRUN, most / _SLIP) / speed
            damping = drive.damping if drive.kind == "velocity" else damping
            needed = (damping - dampings[number]) * STEP / SHARE
            made[number] = max(made[number], min(needed, _SPIN * most / speed))
    return made


def _spread(states: Sequence[State], most: int) -> Sequence[State]:
    """At most about `most` of the states, evenly spread over them."""
    return states[:: max(1, len(states) // most)]
