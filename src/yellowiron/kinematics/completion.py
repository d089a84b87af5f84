"""What follows from the loops: mobility, limits, branch signs and drive gains."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from yellowiron.kinematics.solver.branches import branch_pivots, branch_sines
from yellowiron.kinematics.solver.chain import ClosedChain, Component, State
from yellowiron.kinematics.solver.independence import suspects
from yellowiron.kinematics.solver.pose_grid import PoseGrid, explore, joint_values
from yellowiron.kinematics.spatial_hints import locked_hint
from yellowiron.kinematics.strength import carried, rated_load, strong_enough, weight
from yellowiron.kinematics.tolerances import PINS_APART
from yellowiron.kinematics.twins import end_with_twins, twins_out_of_stroke
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import PROVISIONAL, STATED, Drive, Joint, Mechanism, Mobility, Site, independent_joints

ANGLE_MARGIN = math.radians(0.5)
"""Radians added to a pivot's range from the loop, so that its limit never carries load."""
SLIDE_MARGIN = 2e-3
"""Metres added to a passive slide's range from the loop."""
FREQUENCY = 3.0
"""Hertz of a position drive on the empty machine: with its payload about 2, which every engine holds."""
STRAIGHT = 0.05
"""|sine| at a triangle of pivots below which a loop is too near its dead point to have a branch."""
_BACK = 2e-3
"""Metres or radians by which a limit that was drawn in stands back from the dead point."""
_FLAT = 1e-6
"""|sine| of a drawn triangle of pivots that is none: its loop has no branch."""
_OWN, _OTHERS = 13, 25
"""Poses sampled for the mass a drive sees: of its own component, and of each other one."""
_USUAL = 0.95
"""The share of those poses whose masses the gains are for."""
MOSTLY_LOAD = 10.0
"""A drive that sees so many times its mass with the rated load gets its gains for that: a truck's or a crane's load is
most of what it lifts (13 to 17 times), a loader's weighs a few of its bucket."""
_SATURATED = 0.005
"""A drive has its full force at no less than this share of its travel: stiffer, it would only saturate."""
_SAGS = 0.02
"""… and gives way to the weight on it by no more than this share, in the drawn pose: short strokes need more."""
_STEP, _STABLE = 1e-3, 1.7
"""Engines step that many seconds. A velocity drive's damping over one is no more than so many times the inertia that it
turns: from 2 on, explicit steps swing to and fro. Sprockets turn rings besides, where these are bodies of their own."""
_PER_FREEDOM = {"fixed": 6, "revolute": 5, "prismatic": 5, "spherical": 3, "distance": 0}


@dataclass
class _Work:
    """What the steps below hand on: joints as they change, findings as they come."""

    chain: ClosedChain
    joints: dict[str, Joint]
    findings: list[Finding] = field(default_factory=list)

    def find(self, code: str, severity: str, where: str, message: str, hint: str = "") -> None:
        self.findings.append(Finding(code, severity, where, message, hint))  # type: ignore[arg-type]


def complete(mechanism: Mechanism) -> Mechanism:
    """The mechanism with everything that follows from its loops.

    - `mobility`, from the rank of the constraint Jacobian.
    - Limits of passive pivots and slides, tree and cut, over the full strokes of all actuators that move them, with a
      small margin; limits that are already there stay.
    - The stroke of a driven slide ends where the linkage locks.
    - `Loop.branch`: the sign of each loop's triangle of pivots (`branches.branch_pivots`).
    - Gains of position drives that have none, or only provisional ones (`position_gains`): k = m(2πf)², d = 2k/(2πf),
      m the mass the drive sees through the linkage, f = 3 Hz. A velocity drive without damping gets the one
      that gives full force at standstill and none at full speed.

    Findings: KIN001 stroke past a dead point, KIN002 unreachable combination of strokes, KIN003 branch, KIN004 passive
    twin out of stroke, KIN005 mobility, KIN006 stated limit against the loop's, KIN007 drive without force or speed,
    KIN008 pins out of parallel, KIN009 no ends of stroke, KIN015 too weak for its own weight, KIN016 stroke that
    ends with its twin's, KIN017 drives that do not determine a linkage in space.
    Raises `MechanismError` where the joints are no tree with cuts.
    """
    chain = ClosedChain(mechanism)
    work = _Work(chain, {joint.name: joint for joint in mechanism.joints})
    whole, mechanism = mechanism, chain.mechanism
    mobility = _mobility(mechanism, work)
    ranges = _ranges(work)
    for component, own in zip(chain.components(), ranges, strict=True):
        work.findings += end_with_twins(chain, component, own, work.joints)
    grids = [explore(chain, own) for own in ranges]
    placed = [chain.placements(grid.states) for grid in grids]
    for component, grid in zip(chain.components(), grids, strict=True):
        _report_unreachable(grid, work)
        _report_gap(component, grid, work)
    for component, grid, (rotations, _) in zip(chain.components(), grids, placed, strict=True):
        _limit(component, grid, rotations, work)
    work.findings += twins_out_of_stroke(mechanism, work.joints, SLIDE_MARGIN)
    loops = _branches(mechanism, grids, placed, work)
    work.findings += strong_enough(chain, grids, work.joints)
    _gains(mechanism, grids, work, ringed=bool(whole.floating))
    return replace(
        whole,
        joints=tuple(work.joints[joint.name] for joint in whole.joints),
        loops=(*loops, *(loop for loop in whole.loops if loop not in mechanism.loops)),
        mobility=mobility,
        findings=(*whole.findings, *work.findings),
    )


def _mobility(mechanism: Mechanism, work: _Work) -> Mobility:
    freedom = {"fixed": 0, "revolute": 1, "prismatic": 1, "spherical": 3, "distance": 0}
    tree = sum(freedom[joint.type] for joint in mechanism.joints if not joint.cut)
    grubler = tree - sum(_PER_FREEDOM[joint.type] for joint in mechanism.joints if joint.cut)
    grubler -= sum(joint.follows is not None for joint in mechanism.joints) + len(work.chain.spins)
    held = [name for name in work.chain.idle if work.joints[name].held]
    expected = sum(freedom[work.joints[name].type] for name in independent_joints(mechanism))
    mobility = Mobility(work.chain.degrees_of_freedom - len(held), expected, grubler)
    if mobility.computed != mobility.expected:
        more = mobility.computed > mobility.expected
        work.find(
            "KIN005",
            "error",
            mechanism.name,
            f"the machine has {mobility.computed} degrees of freedom where its drives and free joints make "
            f"{mobility.expected}",
            f"Nothing holds: {', '.join(n for n in work.chain.idle if n not in held) or 'a body'}."
            if more
            else suspects(mechanism) or locked_hint(mechanism),
        )
    elif not work.chain.plain and work.chain.undetermined:
        work.find(
            "KIN017",
            "error",
            mechanism.name,
            f"as drawn its drives do not determine it: {work.chain.undetermined} of its {mobility.computed} degrees of "
            "freedom is left with all of them held",
            "A cylinder, brace or link acts through an axis that it should turn about: check their places.",
        )
    return mobility


def _ranges(work: _Work) -> list[dict[str, tuple[float, float]]]:
    """The drivers of each component with their ranges, cut short where the linkage locks on the way there."""
    ranges: list[dict[str, tuple[float, float]]] = []
    for component in work.chain.components():
        found: dict[str, tuple[float, float]] = {}
        for name in component.drivers:
            joint = work.joints[name]
            if joint.lower is None or joint.upper is None:
                continue
            ends = [_reachable(work, joint, end, float(getattr(joint, end))) for end in ("lower", "upper")]
            found[name] = (min(ends), max(ends))
            if ends[0] == ends[1]:
                words = "its two ends of stroke are the same: it cannot move"
                work.find("KIN009", "warning", name, words, "Check the stroke and the limits of this joint.")
        ranges.append(found)
    return ranges


def _reachable(work: _Work, joint: Joint, end: str, limit: float) -> float:
    state, fraction = work.chain.reach({joint.name: limit})
    if fraction == 1.0:
        return limit
    stop = work.chain.coordinate(state, joint.name)
    stop -= math.copysign(min(_BACK, abs(stop)), stop)
    work.find(
        "KIN001",
        "warning",
        joint.name,
        f"the linkage locks {1e3 * stop:.1f} mm from the drawn pose, before the stroke's end at {1e3 * limit:.1f} mm",
        "Check the stroke, the closed length and the pins of this cylinder's loop.",
    )
    source = {**work.joints[joint.name].source, f"{end}_reason": "from the loop: dead point"}
    changed: dict[str, Any] = {end: stop, "source": source}
    work.joints[joint.name] = replace(work.joints[joint.name], **changed)
    return stop


def _report_unreachable(grid: PoseGrid, work: _Work) -> None:
    if not grid.unreachable:
        return
    share = 100.0 * len(grid.unreachable) / (len(grid.unreachable) + len(grid.states))
    at = ", ".join(f"{n} {1e3 * v:.0f} mm" for n, v in zip(grid.drivers, grid.unreachable[0], strict=True))
    work.find(
        "KIN002",
        "warning",
        ", ".join(grid.drivers),
        f"{share:.0f} % of the combinations of these strokes lie past a dead point, for one {at}",
        "Limits are taken from the others.",
    )


def _report_gap(component: Component, grid: PoseGrid, work: _Work) -> None:
    gap = max((state.closure for state in grid.states), default=0.0)
    if gap > PINS_APART:
        work.find(
            "KIN008",
            "warning",
            ", ".join(component.cuts),
            f"over the strokes these loops' pins come {1e3 * gap:.2g} mm apart: they are not parallel",
            "Check the axes of these joints; the linkage is solved as far as it closes.",
        )


def _limit(component: Component, grid: PoseGrid, rotations: Floats, work: _Work) -> None:
    """Limits of everything that moves with a component's drivers, once all of them have ends of stroke."""
    endless = [name for name in component.drivers if name not in grid.drivers]
    if endless and component.cuts:  # a wheel geared to another needs none
        work.find(
            "KIN009",
            "warning",
            ", ".join(endless),
            "it has no ends of stroke, so the pivots that follow from it get no limits either",
            "Give the stroke; without limits a loop can flip to its other branch.",
        )
    if not grid.states or endless:
        return
    drivers = " and ".join(grid.drivers) or "the drawn pose alone"
    for name, joint in work.joints.items():
        if joint.type not in ("revolute", "prismatic") or name not in (*component.dependent, *component.cuts):
            continue
        values = joint_values(work.chain, grid, joint, rotations)
        low, high = float(values.min()), float(values.max())
        margin = SLIDE_MARGIN if joint.type == "prismatic" else ANGLE_MARGIN
        passive = any(cylinder.slide == name and cylinder.passive for cylinder in work.chain.mechanism.cylinders)
        if passive or joint.lower is None or joint.upper is None:
            text = f"from the loop over the strokes of {drivers}, with {_text(margin, joint)} to spare"
            source = {**joint.source, "limits": text}
            work.joints[name] = replace(joint, lower=low - margin, upper=high + margin, source=source)
        elif low < joint.lower - margin or high > joint.upper + margin:
            work.find(
                "KIN006",
                "warning",
                name,
                f"the strokes take it from {_text(low, joint)} to {_text(high, joint)}, its stated limits are "
                f"{_text(joint.lower, joint)} and {_text(joint.upper, joint)}",
                "The stated limits stay; check them against the strokes.",
            )


def _text(value: float, joint: Joint) -> str:
    return f"{1e3 * value:.1f} mm" if joint.type == "prismatic" else f"{math.degrees(value):.2f}°"


def _branches(mechanism: Mechanism, grids: list[PoseGrid], placed: list[tuple[Floats, Floats]], work: _Work) -> Any:
    """The loops with their branch signs; a sign that changes over the strokes is a finding."""
    pivots = branch_pivots(mechanism)
    at = {cut: number for number, component in enumerate(work.chain.components()) for cut in component.cuts}
    drawn = work.chain.placements((work.chain.drawn,))
    loops = []
    for loop in mechanism.loops:
        branch = 0
        if loop.cut in pivots:
            sine = float(branch_sines(work.chain, pivots[loop.cut], *drawn)[0])
            branch = int(math.copysign(1.0, sine)) if abs(sine) > _FLAT else 0
            sines = branch_sines(work.chain, pivots[loop.cut], *placed[at[loop.cut]]) * branch
            least = float(sines.min(initial=abs(sine)))
            if branch and least < STRAIGHT:
                branch = 0 if least < 0.0 else branch
                near = math.degrees(math.asin(max(0.0, least)))
                work.find(
                    "KIN003",
                    "warning",
                    loop.cut,
                    f"over the strokes its loop comes within {near:.1f}° of a dead point"
                    if least >= 0.0
                    else "its loop changes branch within the strokes",
                    f"Pivots {', '.join(pivots[loop.cut])} must not come into line; check strokes and pins.",
                )
        loops.append(replace(loop, branch=branch))
    return tuple(loops)


def _gains(mechanism: Mechanism, grids: list[PoseGrid], work: _Work, *, ringed: bool) -> None:
    masses, loaded = _seen_masses(work.chain, grids, rated_load(mechanism))
    laden = {name: mass for name, mass in loaded.items() if mass > MOSTLY_LOAD * masses[name]}
    for joint in mechanism.joints:
        drive = work.joints[joint.name].drive
        if drive is None or joint.name not in work.chain.independent:
            continue
        if drive.kind == "velocity":
            work.joints[joint.name] = replace(work.joints[joint.name], drive=_velocity_gain(drive, joint, work, ringed))
            continue
        if joint.name not in masses:
            masses[joint.name] = work.chain.effective_mass(work.chain.drawn, joint.name)
        travel = joint.upper - joint.lower if joint.upper is not None and joint.lower is not None else None
        unit = "kg" if joint.type == "prismatic" else "kg·m²"
        held = abs(weight(work.chain, work.chain.drawn, joint.name)) if travel else 0.0
        gained = position_gains(drive, masses[joint.name], unit, travel=travel, held=held, laden=laden.get(joint.name))
        work.joints[joint.name] = replace(work.joints[joint.name], drive=gained)


def position_gains(
    drive: Drive,
    mass: float,
    unit: str = "kg",
    *,
    travel: float | None = None,
    held: float = 0.0,
    laden: float | None = None,
    frequency: float = FREQUENCY,
) -> Drive:
    """A position drive with gains for a mass (kg, or kg·m² for a pivot): k = m(2πf)², d = 2k/(2πf), critically damped.

    No softer than the weight that it has `held` (N, N·m) over two percent of its `travel` (metres, radians), and no
    stiffer than its force over half a percent of that. Gains that the drive has
    stay, unless its source calls them provisional; those that "template states" names after that stay too. A stiffness
    that stays gets the damping d = 2√(km) where it has none. `laden`: the mass with a load that is most of it, which
    the stiffness is for then; the damping is critical for the geometric mean of both, so that it neither creeps
    without the load nor rings with it.
    """
    provisional = PROVISIONAL in drive.source
    stated = drive.source.partition(STATED)[2]
    keep_stiffness = drive.stiffness > 0.0 and (not provisional or "stiffness" in stated)
    keep_damping = drive.damping > 0.0 and (not provisional or "damping" in stated)
    if keep_stiffness and keep_damping:
        return drive
    omega = 2.0 * math.pi * frequency
    empty, mass = mass, laden if laden is not None else mass
    capped = ""
    if not keep_stiffness and travel and held > mass * omega * omega * _SAGS * travel:
        mass = held / (_SAGS * travel * omega * omega)
        capped = f", no softer than the weight on it over {_SAGS:.0%} of its travel: as for"
    if not keep_stiffness and travel and mass * omega * omega * _SATURATED * travel > drive.max_force:
        mass = drive.max_force / (_SATURATED * travel * omega * omega)
        capped = f", no stiffer than its force over {_SATURATED:.1%} of its travel: as for"
    stiffness = drive.stiffness if keep_stiffness else mass * omega * omega
    least = mass if laden is None else min(empty, mass)
    damping = drive.damping if keep_damping else 2.0 * math.sqrt(stiffness * math.sqrt(least * mass))
    shown = f"{1e-3 * mass:.4g} t" if unit == "kg" else f"{mass:.4g} {unit}"
    at = "" if keep_stiffness else f"{frequency:g} Hz, "
    on = capped + f" {shown}" if capped else f" on the {shown} it sees through the linkage"
    how = "critically damped" if laden is None else "damped for it with and without the rated load,"
    gains = f"gains: {at}{how}{on}"
    source = (
        drive.source.replace(PROVISIONAL, gains) if provisional else "; ".join(t for t in (drive.source, gains) if t)
    )
    return replace(drive, stiffness=stiffness, damping=damping, source=source)


def _velocity_gain(drive: Drive, joint: Joint, work: _Work, ringed: bool) -> Drive:
    if drive.damping > 0.0:
        if ringed:
            return drive
        most = _STABLE * work.chain.effective_mass(work.chain.drawn, joint.name) / _STEP
        if drive.damping <= most or "damping" in drive.source.partition(STATED)[2]:
            return drive
        return replace(drive, damping=most, source=f"{drive.source}; damping: as much as the inertia it turns takes")
    if not (drive.max_force > 0.0 and drive.max_velocity > 0.0):
        work.find("KIN007", "warning", joint.name, "the drive has no force or no speed, so it gets no damping")
        return drive
    source = "damping: full force at standstill, none at full speed"
    return replace(
        drive,
        damping=drive.max_force / drive.max_velocity,
        source="; ".join(text for text in (drive.source, source) if text),
    )


def _seen_masses(
    chain: ClosedChain, grids: list[PoseGrid], load: tuple[Site, float] | None
) -> tuple[dict[str, float], dict[str, float]]:
    """Driver → the mass it sees in all but the rarest poses of its own component and of the others (a steering cylinder
    turns a raised or outstretched boom too). The rarest are left out: at full lock a short lever makes it ten times the
    usual mass, and gains for that saturate and buzz everywhere else. Then the same with a `load`, a mass (kg) at a
    site; nothing without one."""
    seen: dict[str, list[float]] = {}
    laden: dict[str, list[float]] = {}
    for component, grid in zip(chain.components(), grids, strict=True):
        others = [pose for other in grids if other is not grid for pose in _spread(other.states, _OTHERS)]
        for state in _spread(grid.states, _OWN) if others else grid.states:
            for pose in [chain.combined(state, component, other) for other in others] or [state]:
                for name in grid.drivers:
                    mass = chain.effective_mass(pose, name)
                    seen.setdefault(name, []).append(mass)
                    if load is not None:
                        laden.setdefault(name, []).append(mass + carried(chain, pose, name, *load))
    empty, full = (
        {name: float(np.quantile(masses, _USUAL)) for name, masses in each.items()} for each in (seen, laden)
    )
    return empty, full


def _spread(states: Sequence[State], most: int) -> Sequence[State]:
    """At most about `most` of the states, evenly spread over them."""
    return states[:: max(1, len(states) // most)]
