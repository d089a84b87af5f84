"""What an engine must do, and which engines there are."""

from __future__ import annotations

import importlib
import importlib.util
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any, Literal, NamedTuple, Protocol, cast

import numpy as np

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Joint, Mechanism, chained, rolling

TOUCHING = 0.02
"""Metres: a body that comes this near to the ground as drawn stands on it."""
UPRIGHT = 0.9
"""Least vertical part of a unit axis about which a body slews."""

GROUND_FRICTION = 0.7
"""Of ground and blocks."""

Base = Literal["fixed", "floating"]


@dataclass(frozen=True, eq=False)
class Block:
    """A block on the ground, fixed to the world, with a ramp at both ends in x: its `middle` on the ground (x, y), the
    `length` of its top, its `width`, `height` and the length `run` of each ramp, metres. Engines differ in what a wheel
    does at a sharp edge, and agree on a ramp."""

    middle: tuple[float, float]
    length: float
    width: float
    height: float
    run: float

    @property
    def corners(self) -> Floats:
        """(8, 3), world frame: the convex hull is the block."""
        x, y = self.middle
        low, high = 0.5 * self.length + self.run, 0.5 * self.length
        rows = [
            (x + sx * half, y + sy * 0.5 * self.width, z)
            for half, z in ((low, 0.0), (high, self.height))
            for sx in (-1.0, 1.0)
            for sy in (-1.0, 1.0)
        ]
        return np.array(rows, dtype=np.float64)

    def surface(self, x: Floats, y: Floats) -> Floats:
        """Height of ground and block at points."""
        ramp = (0.5 * self.length + self.run - np.abs(x - self.middle[0])) / self.run
        inside = np.abs(y - self.middle[1]) <= 0.5 * self.width
        return np.asarray(np.where(inside, self.height * np.clip(ramp, 0.0, 1.0), 0.0), dtype=np.float64)


@dataclass(frozen=True, eq=False)
class Setup:
    """What an engine loads. The machine file has the geometry; `mechanism` is what it says, with the payload in the
    masses of `heavier`, the bodies that differ from the file, and the drives of `driven`, the joints that do. A fixed
    base stands in the air (no ground); a floating one stands on a ground plane at z = 0, with `blocks` on it. Ground
    and blocks touch the bodies `standing` on them and no others: a bucket passes through, so that strokes stay whole.
    `timestep` in seconds; `measured` are the joints whose coordinates are read.
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


def standing_bodies(mechanism: Mechanism) -> tuple[str, ...]:
    """The bodies whose lowest point is on the ground (z = 0) in the drawn pose: wheels, tracks, feet. Of a machine that
    lies in rings of track shoes every shoe, and the wheels that they run on."""
    down = {b.name for b in mechanism.bodies if len(b.hull) and float(np.asarray(b.hull)[:, 2].min()) < TOUCHING}
    if mechanism.floating:
        slewing = {j.body1 for j in mechanism.joints if abs(j.axis[2]) > UPRIGHT}
        down |= chained(mechanism) | (rolling(mechanism) - slewing)
    return tuple(b.name for b in mechanism.bodies if b.name in down)


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


@dataclass(frozen=True)
class EngineEntry:
    """An engine there is: its `module` has `load(setup) -> Engine`. `timestep` is the default, seconds; bars are metres
    (fixed and floating base) and radians; `install` says what to install where the module's imports fail; `needs` are
    the modules of other projects that it imports."""

    module: str
    timestep: float
    pin_bars: Mapping[Base, float] = field(default_factory=dict)
    angle_bar: float = 1.7453292519943296e-4
    install: str = ""
    needs: tuple[str, ...] = ()


ENGINES: Mapping[str, EngineEntry] = MappingProxyType(
    {
        "mujoco": EngineEntry(
            "yellowiron.simulation.engines.mujoco",
            0.001,
            {"fixed": 5e-5, "floating": 1e-4},
            install="pip install mujoco",
            needs=("mujoco",),
        ),
        "newton": EngineEntry(
            "yellowiron.simulation.engines.newton",
            0.001,
            {"fixed": 5e-5, "floating": 1e-4},
            install="pip install 'yellowiron[newton]'",
            needs=("newton", "newton_usd_schemas", "physx_usd_schemas", "warp"),
        ),
        "physx": EngineEntry(
            "yellowiron.simulation.engines.physx",
            1.0 / 120.0,
            {"fixed": 2.5e-4, "floating": 2.5e-4},
            angle_bar=math.radians(0.06),
            install="pip install 'yellowiron[physx]'",
            needs=("ovphysx", "ovstage", "newton_usd_schemas", "physx_usd_schemas", "warp"),
        ),
    }
)


def find_engine(name: str) -> EngineEntry:
    """The engine of that name; `YellowironError` where there is none."""
    if name not in ENGINES:
        raise YellowironError(f"There is no engine '{name}'", hint=f"Known: {', '.join(ENGINES)}.")
    return ENGINES[name]


def import_engine(name: str) -> ModuleType:
    """The engine's module; `YellowironError` that says what to install where it is not there.

    Called before the first stage is opened: some engines bring USD schemas, which USD looks up only once.
    """
    entry = find_engine(name)
    try:
        return importlib.import_module(entry.module)
    except ModuleNotFoundError as error:
        raise YellowironError(
            f"The engine '{name}' needs the module '{error.name}', which is not installed", hint=f"{entry.install}"
        ) from error


def installed_engines() -> tuple[str, ...]:
    """The engines that are there, in the order of `ENGINES`. Nothing of them is imported."""
    return tuple(name for name, entry in ENGINES.items() if all(map(importlib.util.find_spec, entry.needs)))


def load_engine(name: str, setup: Setup) -> Engine:
    """The engine with the machine loaded; errors as in `import_engine`."""
    return cast(Engine, import_engine(name).load(setup))
