"""What an engine is given, and what it must do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NamedTuple, Protocol

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Joint, Mechanism
from yellowiron.simulation.ground import Block

Base = Literal["fixed", "floating"]
Settings = Literal["file", "engine"]
"""Whose word on step, integrator, cone and scene counts: what a build writes, or each engine's own defaults."""


@dataclass(frozen=True, eq=False)
class Setup:
    """What an engine loads. The machine file has the geometry; `mechanism` is what it says, with the payload in the
    masses of `heavier`, the bodies that differ from the file, and the drives of `driven`, the joints that do. A fixed
    base stands in the air (no ground); a floating one stands on a ground plane at z = 0, with `blocks` on it. Ground
    and blocks touch the bodies `standing` on them and no others: a bucket passes through, so that strokes stay whole.
    `timestep` in seconds; `measured` are the joints whose coordinates are read. With `settings` of the `engine` the
    machine's own file is all that is ours: the scene around it says gravity and ground, and no engine is told more.
    """

    usd_path: Path
    mechanism: Mechanism
    base: Base
    timestep: float
    measured: tuple[str, ...]
    heavier: tuple[Body, ...] = ()
    driven: tuple[Joint, ...] = ()
    standing: tuple[str, ...] = ()
    blocks: tuple[Block, ...] = ()
    settings: Settings = "file"


class Readings(NamedTuple):
    """Machines at n instants: coordinates (n, measured) of the setup's `measured` joints, metres, or radians without a
    jump at a full turn; rotations (n, bodies, 3, 3) and origins (n, bodies, 3) of the mechanism's bodies in their
    order, world frame (the machine's in the drawn pose)."""

    coordinates: Floats
    rotations: Floats
    origins: Floats


class Engine(Protocol):
    """One machine in one engine. After loading it is in its drawn pose at rest, all targets 0, no time gone by.

    What is done at every step is done in the engine's own terms, and quick: a step of MuJoCo's takes 10 µs.
    """

    @property
    def version(self) -> str:
        """The engine's version."""

    def targets(self, joints: Sequence[str], rows: Floats) -> Iterator[None]:
        """Each `next` sets the targets of driven joints to the next of rows (n, joints): metres or radians from the
        drawn pose for position drives, rad/s or m/s for velocity drives. Others keep theirs."""

    def push(self, body: str, force: Floats, point: Floats) -> None:
        """A force (3,), N, on a body at a point (3,), both world frame, during the next step. One a body and step."""

    def step(self) -> None:
        """One step of the setup's length. Calls `guard.beat`, which tells a step that takes long from a hang."""

    def state(self) -> Any:
        """The machine now, in the engine's own terms; it stays as it is."""

    def read(self, states: Sequence[Any]) -> Readings:
        """What states are, read in the order in which they came: between two of them, and between two calls, a joint
        must turn by less than half a turn."""

    def close(self) -> None:
        """Frees what the engine holds."""


def tell(engine: Engine, targets: Mapping[str, float]) -> None:
    """New targets by joint, once."""
    next(engine.targets(tuple(targets), np.array([list(targets.values())], dtype=np.float64)))


def poses(engine: Engine) -> tuple[Floats, Floats]:
    """Rotations (bodies, 3, 3) and origins (bodies, 3) now."""
    now = engine.read([engine.state()])
    return now.rotations[0], now.origins[0]


def coordinates(engine: Engine) -> Floats:
    """Coordinates (measured,) now."""
    return engine.read([engine.state()]).coordinates[0]
