"""Which engines there are: ours, and those that other installed packages bring.

Another package names an `EngineEntry` of its own in its `pyproject.toml`:

    [project.entry-points."yellowiron.engines"]
    still = "its_package:ENTRY"
"""

from __future__ import annotations

import importlib
import importlib.util
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType, ModuleType
from typing import cast

from yellowiron.model.errors import YellowironError
from yellowiron.simulation.engine import Base, Engine, Settings, Setup
from yellowiron.support.plugins import find_plugins

GROUP = "yellowiron.engines"
"""Entry points of this group are `EngineEntry`s of other packages."""


@dataclass(frozen=True)
class EngineEntry:
    """An engine there is: its `module` has `load(setup) -> Engine`. `timestep` is the default, seconds; bars are metres
    (fixed and floating base) and radians; `install` says what to install where the module's imports fail; `needs` are
    the top-level modules of other projects that it imports; `own_timestep` the step that the engine takes where nobody
    says one (None: `timestep`)."""

    module: str
    timestep: float
    pin_bars: Mapping[Base, float] = field(default_factory=dict)
    angle_bar: float = 1.7453292519943296e-4
    install: str = ""
    needs: tuple[str, ...] = ()
    own_timestep: float | None = None


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
            own_timestep=1.0 / 60.0,
        ),
    }
)


def engine_names() -> tuple[str, ...]:
    """The engines there are, installed or not: those of `ENGINES`, then other packages', by name. None is imported."""
    return (*ENGINES, *find_plugins(GROUP, builtin=ENGINES))


def find_engine(name: str) -> EngineEntry:
    """The engine of that name; `YellowironError` where there is none, or where it is another package's and its entry
    cannot be loaded."""
    plugins = find_plugins(GROUP, builtin=ENGINES)
    if name in plugins:
        return plugins[name].load(EngineEntry)
    if name not in ENGINES:
        raise YellowironError(
            f"There is no engine '{name}'", where="--engine", hint=f"Known: {', '.join(engine_names())}."
        )
    return ENGINES[name]


def usual_timestep(entry: EngineEntry, settings: Settings) -> float:
    """Seconds that an engine steps where nobody says otherwise, by ours or its own settings."""
    return entry.timestep if settings == "file" or entry.own_timestep is None else entry.own_timestep


def import_engine(name: str) -> ModuleType:
    """The engine's module; `YellowironError` that says what to install where it is not there.

    Called before the first stage is opened: some engines bring USD schemas, which USD looks up only once.
    """
    entry = find_engine(name)
    try:
        return importlib.import_module(entry.module)
    except ModuleNotFoundError as error:
        raise YellowironError(
            f"The engine '{name}' needs the module '{error.name}', which is not installed",
            where="--engine",
            hint=entry.install,
        ) from error


def installed_engines() -> tuple[str, ...]:
    """The engines that are there, in the order of `engine_names`. Nothing of ours is imported."""
    return tuple(n for n in engine_names() if all(map(importlib.util.find_spec, find_engine(n).needs)))


def load_engine(name: str, setup: Setup) -> Engine:
    """The engine with the machine loaded; errors as in `import_engine`."""
    return cast(Engine, import_engine(name).load(setup))
