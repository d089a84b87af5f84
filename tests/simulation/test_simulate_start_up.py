"""Engines start at rest, in the drawn pose, and two starts are alike."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from in_engines import load

from yellowiron.simulation.engine import Setup, poses
from yellowiron.simulation.registry import ENGINES
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow

START_UP = 0.1
"""m/s or rad/s: what a joint may do in the first step. An explosion is hundreds."""


@pytest.mark.parametrize("name", ["newton", "physx"])
def test_start_up_is_at_rest_and_twice_the_same(name: str, wheel_loader: Path) -> None:
    mechanism = read_mechanism(wheel_loader)
    setup = Setup(wheel_loader, mechanism, "fixed", ENGINES[name].timestep, (mechanism.joints[0].name,))
    ends = []
    for _ in range(2):
        engine = load(name, setup)
        try:
            assert np.abs(poses(engine)[1] - [body.origin for body in mechanism.bodies]).max() < 1e-5
            engine.step()
            speeds = engine.velocities()  # type: ignore[attr-defined]  # by joint in PhysX
            assert max(map(abs, speeds.values() if isinstance(speeds, dict) else speeds)) < START_UP
            engine.step()
            ends.append(poses(engine)[1])
        finally:
            engine.close()
    assert np.array_equal(*ends)
