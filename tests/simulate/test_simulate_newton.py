"""Newton on our USD, against the bars; skipped where newton is not installed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from yellowiron.model.mechanism import Mechanism
from yellowiron.simulate import rated_payload, simulate
from yellowiron.simulate.engine import ENGINES, Base, Setup
from yellowiron.usd import read_machine

pytest.importorskip("newton", reason="needs pip install 'yellowiron[newton]'")
pytestmark = pytest.mark.slow

START_UP = 0.1
"""m/s or rad/s: what a joint may do in the first step. An explosion is hundreds."""


def _setup(usd_file: Path, mechanism: Mechanism, base: Base) -> Setup:
    return Setup(usd_file, mechanism, base, ENGINES["newton"].timestep, tuple(j.name for j in mechanism.joints[:1]))


def test_start_up_is_at_rest_and_twice_the_same(wheel_loader: Path) -> None:
    from yellowiron.simulate.newton import load

    setup = _setup(wheel_loader, read_machine(wheel_loader), "fixed")
    ends = []
    for _ in range(2):
        engine = load(setup)
        try:
            drawn = [body.origin for body in setup.mechanism.bodies]
            assert np.abs(engine.poses()[1] - drawn).max() < 1e-5
            engine.step()
            assert np.abs(engine.velocities()).max() < START_UP
            engine.step()
            ends.append(engine.poses()[1])
        finally:
            engine.close()
    assert np.array_equal(*ends)


@pytest.mark.parametrize("base", ["fixed", "floating"])
def test_full_strokes_with_the_rated_payload(wheel_loader: Path, base: Base) -> None:
    payload = rated_payload(read_machine(wheel_loader))
    result = simulate(wheel_loader, engine="newton", base=base, payload_kg=payload.mass, actuators=["bucket"])
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings


def test_the_small_loader(usd_file: Path) -> None:
    result = simulate(usd_file, engine="newton", base="floating", actuators=["boom"])
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
