"""What follows from a changed machine's loops: whether they close over the strokes, limits of what they move, gains.

The base machine is looked at once, over all poses that a build looks at. Of those, the ones that decide remain: where
a joint is at an end of its range, a drive's step bears least, a weight or a mass is the usual one. A variant is solved
in these alone, from the base's solution. Where nothing is changed, the base's own numbers come out.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.fleet.variants.changes import Changed
from yellowiron.kinematics.completion import ANGLE_MARGIN, SLIDE_MARGIN
from yellowiron.kinematics.gains import (
    USUAL,
    Felt,
    Look,
    driven_by,
    felt_in,
    give_gains,
    loads_of,
    looks,
    poses_of,
)
from yellowiron.kinematics.solver.chain import ClosedChain, State
from yellowiron.kinematics.solver.pose_grid import PoseGrid, explore, joint_values
from yellowiron.kinematics.tolerances import PINS_APART
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import COMPUTED, PROVISIONAL, STATED, Drive, Joint, Mechanism

_FOLLOWS = 1e-6
"""Metres or radians within which a limit of the base is that of its loops."""
_LIGHT = 1.0
"""N or N·m below which a weight is none, so that a variant's is no multiple of it."""


class RefusedError(Exception):
    """A sample that makes no machine; its text says why, the same for all of the kind."""


@dataclass(frozen=True, eq=False)
class _Pose:
    """A pose of the base: its solution, and where its drivers are between the ends of their strokes, 0 to 1. The drives
    `own` are felt there; `joints` have an end of their range there."""

    state: State
    shares: dict[str, float]
    own: tuple[str, ...] = ()


class Basis:
    """A base machine, looked at once."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.chain = chain = ClosedChain(mechanism)
        self._joints = {joint.name: joint for joint in mechanism.joints}
        grids = [explore(chain, self._ranges(component.drivers)) for component in chain.components()]
        self._drivers = tuple(name for grid in grids for name in grid.drivers)
        self._poses: list[_Pose] = []
        self._known: dict[bytes, int] = {}
        self._corners = [self._add(grid.states[c]) for grid in grids for c in grid.corners]
        self._limited: dict[str, tuple[list[tuple[int, float]], float]] = {}
        for component, grid in zip(chain.components(), grids, strict=True):
            self._look_at_limits(component.dependent + component.cuts, grid)
        self.driven = driven_by(chain, self._joints)
        self._look_at_drives(list(looks(chain, poses_of(chain, grids, self.driven), self.driven)))

    def _ranges(self, drivers: Iterable[str]) -> dict[str, tuple[float, float]]:
        found = {}
        for name in drivers:
            joint = self._joints[name]
            if joint.lower is not None and joint.upper is not None:
                found[name] = (joint.lower, joint.upper)
        return found

    def _add(self, state: State) -> int:
        """The number of a pose, which is kept once."""
        key = state.position.tobytes()
        if key not in self._known:
            shares = {}
            for name, (low, high) in self._ranges(self._drivers).items():
                shares[name] = (self.chain.coordinate(state, name) - low) / (high - low) if high > low else 0.0
            self._known[key] = len(self._poses)
            self._poses.append(_Pose(state, shares))
        return self._known[key]

    def _look_at_limits(self, names: Sequence[str], grid: PoseGrid) -> None:
        """Poses in which a joint that follows is at an end of its range, where that range is its loop's."""
        if not grid.states:
            return
        rotations, _ = self.chain.placements(grid.states)
        for name in names:
            joint = self._joints[name]
            if joint.lower is None or joint.upper is None or joint.type not in ("revolute", "prismatic"):
                continue
            values = joint_values(self.chain, grid, joint, rotations)
            margin = SLIDE_MARGIN if joint.type == "prismatic" else ANGLE_MARGIN
            least, most = int(values.argmin()), int(values.argmax())
            if abs(values[least] - margin - joint.lower) + abs(values[most] + margin - joint.upper) < _FOLLOWS:
                ends = [(self._add(grid.states[at]), float(values[at])) for at in (least, most)]
                self._limited[name] = (ends, margin)

    def _look_at_drives(self, seen: list[Look]) -> None:
        """Poses that decide on the gains."""
        if not self.driven:
            return
        self._felt = felt_in(self.driven, seen)
        armatures = np.diag([self._drive(name).armature for name in self.driven])
        free = np.array([look.free for look in seen])
        bearing = {int(n) for stack in (free, free + armatures) for n in loads_of(stack).argmax(axis=0)}
        self._bearing = [(self._add(seen[n].pose), seen[n].free) for n in sorted(bearing)]
        self._usual: dict[str, list[tuple[int, float]]] = {}
        for name in self.driven:
            own = [(look, look.own.index(name)) for look in seen if name in look.own]
            moved = np.array([look.moved[at] for look, at in own])
            weights = np.array([look.weights[at] for look, at in own])
            nearest = [int(np.abs(moved - np.median(moved)).argmin())]
            for way in (1, -1):
                held = np.maximum(way * weights, 0.0)
                nearest.append(int(np.abs(held - np.quantile(held, USUAL)).argmin()))
            values = [float(moved[nearest[0]]), float(weights[nearest[1]]), float(weights[nearest[2]])]
            self._usual[name] = [(self._add(own[at][0].pose), v) for at, v in zip(nearest, values, strict=True)]

    def _drive(self, name: str) -> Drive:
        drive = self._joints[name].drive
        assert drive is not None
        return drive

    # ---- a variant ---------------------------------------------------------------------------------------------------
    def solved(self, changed: Changed) -> Mechanism:
        """The changed machine with limits and gains of its own. `RefusedError` where its loops do not close over its
        strokes, it is drawn beyond them, or a cylinder cannot be."""
        self._check(changed)
        mechanism = changed.made()
        try:
            chain = ClosedChain(mechanism)
        except MechanismError as error:
            raise RefusedError(f"its loops do not close as drawn: {error.message}") from error
        joints = dict(changed.joints)
        states = self._states(chain, joints) if self._moved(changed) else [pose.state for pose in self._poses]
        if self._moved(changed):
            self._limit(chain, states, joints)
        self._gain(chain, states, joints, changed)
        return replace(mechanism, joints=tuple(joints[joint.name] for joint in mechanism.joints))

    def _check(self, changed: Changed) -> None:
        for cylinder in changed.cylinders.values():
            if cylinder.rod_diameter >= cylinder.bore > 0.0 < cylinder.rod_diameter:
                raise RefusedError(f"the rod of {cylinder.name} is no thinner than its bore")
        for name in self._drivers:
            joint = changed.joints[name]
            if joint.lower is not None and joint.upper is not None and not joint.lower <= 0.0 <= joint.upper:
                raise RefusedError(f"it is drawn beyond the stroke of {name}")

    def _moved(self, changed: Changed) -> bool:
        """Whether anything is elsewhere, or goes as far as elsewhere."""
        return any(
            (after.anchor, after.lower, after.upper) != (before.anchor, before.lower, before.upper)
            for before, after in ((self._joints[name], joint) for name, joint in changed.joints.items())
        )

    def _states(self, chain: ClosedChain, joints: dict[str, Joint]) -> list[State]:
        """The variant's solution of each pose."""
        found = []
        if chain.drawn.closure > PINS_APART:
            raise RefusedError("its loops do not close as drawn")
        for pose in self._poses:
            targets = {}
            for name, share in pose.shares.items():
                low, high = joints[name].lower, joints[name].upper
                assert low is not None and high is not None
                targets[name] = low + share * (high - low)
            state, fraction = chain.reach(targets, start=pose.state)
            if fraction < 1.0:
                state, fraction = chain.reach(targets)
            if fraction < 1.0:
                raise RefusedError("a loop does not close over the strokes")
            if state.closure > max(PINS_APART, 2.0 * pose.state.closure):
                raise RefusedError("a loop's pins come apart over the strokes")
            found.append(state)
        return found

    def _limit(self, chain: ClosedChain, states: Sequence[State], joints: dict[str, Joint]) -> None:
        for name, (ends, margin) in self._limited.items():
            values = []
            for number, before in ends:
                value = chain.coordinate(states[number], name)
                turns = round((before - value) / (2.0 * math.pi)) if joints[name].type == "revolute" else 0
                values.append(value + 2.0 * math.pi * turns)
            low, high = min(values) - margin, max(values) + margin
            joints[name] = replace(joints[name], lower=low, upper=high)

    def _gain(self, chain: ClosedChain, states: Sequence[State], joints: dict[str, Joint], changed: Changed) -> None:
        if not self.driven:
            return
        wanted: dict[int, list[str]] = {number: [] for number, _ in self._bearing}
        for name, places in self._usual.items():
            for number, _ in places:
                wanted.setdefault(number, [])
                if name not in wanted[number]:
                    wanted[number].append(name)
        seen = {}
        for number, own in wanted.items():
            for look in looks(chain, [(states[number], own)], self.driven):
                seen[number] = look
        felt = self._felt_by(seen)
        for name in self.driven:
            joints[name] = replace(joints[name], drive=provisional(self._drive(name), joints[name].drive))
        give_gains(chain, felt, joints, ringed=bool(self.mechanism.floating))
        for name in self.driven:
            drive = joints[name].drive
            assert drive is not None
            stiff, damped = changed.gains.get(name, (1.0, 1.0))
            source = self._drive(name).source
            joints[name] = replace(joints[name], drive=replace(
                drive, stiffness=drive.stiffness * stiff, damping=drive.damping * damped, source=source
            ))  # fmt: skip

    def _felt_by(self, seen: dict[int, Look]) -> Felt:
        moved, force = self._felt.moved.copy(), self._felt.force.copy()
        for row, name in enumerate(self.driven):
            (at, before), *ways = self._usual[name]
            if at in seen and before > 0.0:
                look = seen[at]
                moved[row] *= look.moved[look.own.index(name)] / before
            for column, (number, weight) in enumerate(ways):
                if number in seen and abs(weight) > _LIGHT:
                    look = seen[number]
                    force[row, column] *= max(0.0, look.weights[look.own.index(name)] / weight)
        free: list[Floats] = [seen[number].free for number, _ in self._bearing if number in seen]
        return Felt(self.driven, np.array(free) if free else self._felt.free, moved, force)


def provisional(base: Drive, drive: Drive | None) -> Drive:
    """A variant's drive before its gains are worked out: without those that the base's were worked out to be."""
    assert drive is not None
    if drive.kind == "velocity":
        if drive.damping <= 0.0 or STATED in base.source:
            return drive
        ratio = drive.max_force / base.max_force / (drive.max_velocity / base.max_velocity)
        ratio = ratio if math.isfinite(ratio) else 1.0
        return replace(drive, damping=base.damping * ratio, armature=0.0)
    if COMPUTED not in base.source:
        return drive
    return replace(drive, stiffness=0.0, damping=0.0, armature=0.0, source=PROVISIONAL)
