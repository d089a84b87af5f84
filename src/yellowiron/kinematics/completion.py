"""What follows from the loops: mobility, limits, branch signs and drive gains."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

from yellowiron.kinematics.brakes import set_brakes
from yellowiron.kinematics.gains import set_gains
from yellowiron.kinematics.solver.branches import branch_pivots, branch_sines
from yellowiron.kinematics.solver.chain import ClosedChain, Component
from yellowiron.kinematics.solver.independence import suspects
from yellowiron.kinematics.solver.pose_grid import PoseGrid, explore, joint_values
from yellowiron.kinematics.spatial_hints import locked_hint
from yellowiron.kinematics.springs import set_rests
from yellowiron.kinematics.steadying import steady
from yellowiron.kinematics.strength import strong_enough
from yellowiron.kinematics.tolerances import PINS_APART
from yellowiron.kinematics.twins import end_with_twins, twins_out_of_stroke
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint, Mechanism, Mobility, independent_joints

ANGLE_MARGIN = math.radians(0.5)
"""Radians added to a pivot's range from the loop, so that its limit never carries load."""
SLIDE_MARGIN = 2e-3
"""Metres added to a passive slide's range from the loop."""
STRAIGHT = 0.05
"""|sine| at a triangle of pivots below which a loop is too near its dead point to have a branch."""
_BACK = 2e-3
"""Metres or radians by which a limit that was drawn in stands back from the dead point."""
_FLAT = 1e-6
"""|sine| of a drawn triangle of pivots that is none: its loop has no branch."""
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
    - Gains of drives that have none, or only provisional ones (`gains.set_gains`); the parking brakes of motors.
    - Where springs rest that hold the machine as drawn (`springs.set_rests`).

    Findings: KIN001 stroke past a dead point, KIN002 unreachable combination of strokes, KIN003 branch, KIN004 passive
    twin out of stroke, KIN005 mobility, KIN006 stated limit against the loop's, KIN007 drive without force or speed,
    KIN008 pins out of parallel, KIN009 no ends of stroke, KIN015 too weak for its own weight, KIN016 stroke that
    ends with its twin's, KIN017 drives that do not determine a linkage in space, KIN019 springs on a machine that does
    not stand as drawn.
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
    work.findings += set_gains(chain, grids, work.joints, ringed=bool(whole.floating))
    set_brakes(chain, grids, work.joints)
    steady(chain, grids, work.joints)
    work.findings += set_rests(chain, work.joints)
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
    kept = sum(freedom[work.joints[name].type] for name in held)
    mobility = Mobility(work.chain.degrees_of_freedom - kept, expected, grubler)
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
        f"the linkage locks {_way(joint, stop)} from the drawn pose, before the stroke's end at {_way(joint, limit)}",
        "Check the stroke, the closed length and the pins of this cylinder's loop.",
    )
    source = {**work.joints[joint.name].source, f"{end}_reason": "from the loop: dead point"}
    changed: dict[str, Any] = {end: stop, "source": source}
    work.joints[joint.name] = replace(work.joints[joint.name], **changed)
    return stop


def _way(joint: Joint, value: float, *, digits: int = 1) -> str:
    """A coordinate in words: of a pivot in degrees, of a slide in millimetres."""
    if joint.type == "revolute":
        return f"{math.degrees(value):.{digits}f}°"
    return f"{1e3 * value:.{digits}f} mm"


def _report_unreachable(grid: PoseGrid, work: _Work) -> None:
    if not grid.unreachable:
        return
    share = 100.0 * len(grid.unreachable) / (len(grid.unreachable) + len(grid.states))
    at = ", ".join(
        f"{n} {_way(work.joints[n], v, digits=0)}" for n, v in zip(grid.drivers, grid.unreachable[0], strict=True)
    )
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
