"""A machine in an engine as a test wants it: posed, its other cylinders locked, pushed and watched. SI."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from yellowiron.kinematics import ClosedChain, State, weight
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Drive, Joint, Mechanism, Site
from yellowiron.simulation.commands import Motion, motions, travel
from yellowiron.simulation.engine import Base, Setup, coordinates, poses, tell
from yellowiron.simulation.ground import standing_bodies
from yellowiron.simulation.loads import carried, paces
from yellowiron.simulation.machine_tests.statics import motion
from yellowiron.simulation.registry import load_engine

SETTLE = 1.0
"""Seconds of rest before the machine is posed, and after."""
_LOCKED = 4.0
"""Stiffness of a locked cylinder by its drive's. Its damping stays: times the step it must not come near the mass that
the cylinder moves, and an empty bucket is a tenth of what the drive was sized for."""
_TURNED = math.radians(0.1)
"""How near a slewing body is brought to where it should be."""
_HELD = 1e9
"""N or N·m: what a locked cylinder bears. Oil shut in by its valves is not let out at the pump's relief pressure."""


def locked(drive: Drive) -> Drive:
    """A position drive as a cylinder whose valves are shut."""
    return replace(
        drive,
        stiffness=_LOCKED * drive.stiffness,
        max_force=_HELD,
        reverse_force=None,
        max_velocity=math.inf,
        reverse_velocity=None,
    )


class Rig:
    """One machine in one engine. `drives` by joint replace the file's; the payload is in `mechanism` already."""

    def __init__(
        self,
        engine: str,
        usd_path: Path,
        mechanism: Mechanism,
        *,
        heavier: Sequence[Body],
        drives: Mapping[str, Drive],
        base: Base,
        timestep: float,
    ) -> None:
        changed = tuple(replace(j, drive=drives[j.name]) for j in mechanism.joints if j.name in drives)
        new: dict[str, Joint] = {joint.name: joint for joint in changed}
        self.mechanism = replace(mechanism, joints=tuple(new.get(j.name, j) for j in mechanism.joints))
        self.chain = ClosedChain(self.mechanism)
        every = motions(self.mechanism)
        self.moves: tuple[Motion, ...] = tuple(m for m in every if m.position)
        self._turns = tuple(m for m in every if not (m.position or m.drives))
        self.timestep = timestep
        self.engine = load_engine(
            engine,
            Setup(
                usd_path=usd_path,
                mechanism=self.mechanism,
                base=base,
                timestep=timestep,
                measured=self.chain.independent,
                heavier=tuple(heavier),
                driven=changed,
                standing=standing_bodies(self.mechanism),
            ),
        )
        self._standing = standing_bodies(self.mechanism)
        self._bodies = {body.name: index for index, body in enumerate(self.mechanism.bodies)}

    def close(self) -> None:
        """Frees the engine."""
        self.engine.close()

    def steps(self, seconds: float) -> int:
        """How many steps that is."""
        return max(1, math.ceil(seconds / self.timestep))

    # ---- moving -----------------------------------------------------------------------------------------------------
    def pose(self, state: State) -> None:
        """Rests, brings every cylinder to where it is in a state, at its own pace, then what motors turn and the
        machine does not drive on (a slewing body), and rests again."""
        ends = {m.joint: self.chain.coordinate(state, m.joint) for m in self.moves}
        pace = paces(self.chain, self.moves)
        rest = np.zeros(self.steps(SETTLE))
        rows = {m.joint: travel(0.0, ends[m.joint], m.speed, self.timestep, pace.get(m.joint)) for m in self.moves}
        longest = max((len(row) for row in rows.values()), default=0) + len(rest)
        targets = {
            joint: np.concatenate([rest, row, np.full(longest - len(row), row[-1])]) for joint, row in rows.items()
        }
        told = carried(self.chain, self.moves, targets, self.timestep)
        for number in range(len(rest) + longest):
            self.step({joint: float(values[number]) for joint, values in told.items()})
        held = {joint: float(values[-1]) for joint, values in told.items()}
        for turn in self._turns:
            if abs(self.chain.coordinate(state, turn.joint)) > _TURNED:
                self._turn(turn, state, held)

    def _turn(self, turn: Motion, state: State, held: Mapping[str, float]) -> None:
        """A motor runs until its joint is where it is in a state, no faster than half of its torque can stop it."""
        end, drive = self.chain.coordinate(state, turn.joint), self.mechanism.joint(turn.joint).drive
        torque = drive.max_force if drive is not None else math.inf
        limit = min(turn.speed / SETTLE, 0.5 * torque / self.chain.effective_mass(state, turn.joint))
        way, speed = end - self.coordinate(turn.joint), 0.0
        patience = self.steps(4.0 * (abs(way) / turn.speed + turn.speed / limit) + SETTLE)
        while abs(way) > _TURNED and patience > 0:
            most = min(turn.speed, abs(speed) + limit * self.timestep, math.sqrt(limit * abs(way)), abs(way) / SETTLE)
            speed = math.copysign(most, way)
            self.step({**held, turn.joint: speed})
            way, patience = end - self.coordinate(turn.joint), patience - 1
        for _ in range(self.steps(SETTLE) if speed else 0):
            self.step({**held, turn.joint: 0.0})

    def step(self, targets: Mapping[str, float]) -> None:
        """New targets, within their joints' limits, and one step."""
        tell(self.engine, targets)
        self.engine.step()

    def bearing(self, state: State, site: Site, offset: float, direction: Floats) -> tuple[dict[str, float], Floats]:
        """What a state's weights and a unit force at a site ask of every cylinder beyond its place: metres of target,
        by joint, for the weights; and metres for each newton, in the order of `moves`."""
        own, more = {}, []
        for m in self.moves:
            drive = self.chain.mechanism.joint(m.joint).drive
            stiffness = drive.stiffness if drive is not None else math.inf
            own[m.joint] = self.chain.coordinate(state, m.joint) + weight(self.chain, state, m.joint) / stiffness
            more.append(-float(motion(self.chain, state, m.joint, site, offset) @ direction) / stiffness)
        return own, np.array(more)

    def pressed(self, own: Mapping[str, float], more: Floats, force: float) -> dict[str, float]:
        """Targets that hold weights and a force, from `bearing`, within the limits."""
        told = {}
        for m, each in zip(self.moves, more.tolist(), strict=True):
            joint = self.mechanism.joint(m.joint)
            target = own[m.joint] + each * force
            low = -math.inf if joint.lower is None else joint.lower
            high = math.inf if joint.upper is None else joint.upper
            told[m.joint] = min(max(target, low), high)
        return told

    # ---- watching ---------------------------------------------------------------------------------------------------
    def coordinate(self, joint: str) -> float:
        """A cylinder's coordinate as the engine has it."""
        return float(coordinates(self.engine)[self.chain.independent.index(joint)])

    def place(self, site: Site, offset: float = 0.0) -> Floats:
        """Where a site is now (3,), world frame, moved along its x axis."""
        rotations, origins = poses(self.engine)
        number = self._bodies[site.body]
        point = np.asarray(site.position) + offset * np.asarray(site.x_axis)
        arm = point - np.asarray(self.mechanism.body(site.body).origin)
        return np.asarray(rotations[number] @ arm + origins[number], dtype=np.float64)

    def upright(self) -> Floats:
        """The root's up (3,) in the world."""
        return np.array(poses(self.engine)[0][self._bodies[self.mechanism.root]][:, 2])

    def heights(self) -> dict[str, float]:
        """How high each body that stands on the ground is, by its frame's origin."""
        origins = poses(self.engine)[1]
        return {name: float(origins[self._bodies[name]][2]) for name in self._standing}
