"""An engine as another package brings it: no physics, the closed-chain kinematics goes exactly where it is told."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from yellowiron.kinematics import ClosedChain, State
from yellowiron.model.geometry import Floats
from yellowiron.simulation.engine import Readings, Setup
from yellowiron.simulation.registry import EngineEntry

ENTRY = EngineEntry("kinematic_engine", 0.02, {"fixed": 5e-5, "floating": 1e-4})


class KinematicEngine:
    """An `Engine`: slides jump to their targets, motors turn by their speed."""

    version = "1.0"

    def __init__(self, setup: Setup) -> None:
        self._setup, self._chain = setup, ClosedChain(setup.mechanism)
        self._now = self._chain.drawn
        self._told = dict.fromkeys(setup.measured, 0.0)
        self._speeds: dict[str, float] = {}
        self._bodies = [self._chain.body_index(body.name) for body in setup.mechanism.bodies]

    def targets(self, joints: Sequence[str], rows: Floats) -> Iterator[None]:
        kinds = {j.name: j.drive.kind for j in self._setup.mechanism.joints if j.drive is not None}
        for row in rows:
            for joint, value in zip(joints, row.tolist(), strict=True):
                (self._told if kinds[joint] == "position" else self._speeds)[joint] = value
            yield

    def push(self, body: str, force: Floats, point: Floats) -> None:
        pass

    def step(self) -> None:
        for joint, speed in self._speeds.items():
            self._told[joint] += speed * self._setup.timestep
        self._now = self._chain.solve(self._told, start=self._now)

    def state(self) -> State:
        return self._now

    def read(self, states: Sequence[State]) -> Readings:
        rotations, origins = self._chain.placements(states)
        measured = [[self._chain.coordinate(state, joint) for joint in self._setup.measured] for state in states]
        return Readings(np.array(measured), rotations[:, self._bodies], origins[:, self._bodies])

    def close(self) -> None:
        pass


load = KinematicEngine
