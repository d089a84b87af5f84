"""The engines to test in: MuJoCo always, the others where they are installed."""

from __future__ import annotations

from importlib.util import find_spec

import pytest

from yellowiron.simulation.driving.result import DrivingResult
from yellowiron.simulation.engine import Engine, Setup
from yellowiron.simulation.registry import ENGINES, load_engine

MODULES = {"mujoco": "mujoco", "newton": "newton", "physx": "ovphysx"}
EVERY = [pytest.param(name, marks=() if name == "mujoco" else pytest.mark.slow) for name in ENGINES]


def installed(engine: str) -> pytest.MarkDecorator:
    """The mark that skips tests where the engine is not installed, asked without importing it, which takes seconds."""
    return pytest.mark.skipif(find_spec(MODULES[engine]) is None, reason=f"needs {ENGINES[engine].install}")


def need(engine: str) -> None:
    """Skips the test where the engine is not installed."""
    pytest.importorskip(MODULES[engine], reason=f"needs {ENGINES[engine].install}")


def load(engine: str, setup: Setup) -> Engine:
    """The engine with a setup loaded, or a skipped test."""
    need(engine)
    return load_engine(engine, setup)


def assert_straight(result: DrivingResult) -> None:
    """A machine that stands still first drives its 5 m there and back, and neither sinks nor drifts aside."""
    assert result.creep < 1e-3 and abs(result.sunk) < 0.005
    assert result.distance == 5.0
    assert result.forward == pytest.approx(5.0, rel=0.005)
    assert result.backward == pytest.approx(5.0, rel=0.005)
    assert result.sideways < 0.02
