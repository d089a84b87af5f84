"""PhysX on our USD, against the bars; skipped where ovphysx is not installed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from yellowiron.model.mechanism import Mechanism
from yellowiron.simulate import rated_payload, simulate
from yellowiron.simulate.engine import ENGINES, Base, Setup
from yellowiron.usd import read_machine

pytest.importorskip("ovphysx", reason="needs pip install 'yellowiron[physx]'")
pytestmark = pytest.mark.slow

START_UP = 0.1
"""m/s or rad/s: what a joint may do in the first step. An explosion is hundreds."""


def _setup(usd_file: Path, mechanism: Mechanism, base: Base) -> Setup:
    return Setup(usd_file, mechanism, base, ENGINES["physx"].timestep, tuple(j.name for j in mechanism.joints[:1]))


def test_start_up_is_at_rest_and_twice_the_same(wheel_loader: Path) -> None:
    from yellowiron.simulate.physx import load

    setup = _setup(wheel_loader, read_machine(wheel_loader), "fixed")
    ends = []
    for _ in range(2):
        engine = load(setup)
        try:
            drawn = [body.origin for body in setup.mechanism.bodies]
            assert np.abs(engine.poses()[1] - drawn).max() < 1e-5
            engine.step()
            assert max(map(abs, engine.velocities().values())) < START_UP
            engine.step()
            ends.append(engine.poses()[1])
        finally:
            engine.close()
    assert np.array_equal(*ends)


@pytest.mark.parametrize(
    ("base", "actuators"), [("fixed", ["boom"]), ("floating", ["bucket"]), ("floating", ["steering"])]
)
def test_full_strokes_with_the_rated_payload(wheel_loader: Path, base: Base, actuators: list[str]) -> None:
    payload = rated_payload(read_machine(wheel_loader))
    result = simulate(wheel_loader, engine="physx", base=base, payload_kg=payload.mass, actuators=actuators)
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings


def test_targets_reach_every_drive(wheel_loader: Path) -> None:
    """Wheels turn and cylinders move as they are told, in SI and in the joints' own sense."""
    from yellowiron.simulate.physx import load

    mechanism = read_machine(wheel_loader)
    driven = [j for j in mechanism.joints if j.drive is not None and not j.cut]
    setup = replace(_setup(wheel_loader, mechanism, "fixed"), measured=tuple(j.name for j in driven))
    engine = load(setup)
    told = {j.name: 0.01 if j.drive is not None and j.drive.kind == "position" else 1.0 for j in driven}
    try:
        for share in np.linspace(0.0, 1.0, 120):
            engine.set_targets({name: float(share) * value for name, value in told.items()})
            engine.step()
        for _ in range(120):
            engine.step()
        before = engine.coordinates()
        engine.step()
        reached = engine.coordinates()
    finally:
        engine.close()
    for joint, place, speed in zip(driven, reached, (reached - before) / setup.timestep, strict=True):
        assert joint.drive is not None
        if joint.drive.kind == "position":
            assert place == pytest.approx(0.01, abs=0.02), joint.name  # on its spring, with the weight on it
        else:
            assert speed == pytest.approx(1.0, rel=0.01), joint.name


def test_the_small_loader(usd_file: Path) -> None:
    result = simulate(usd_file, engine="physx", base="floating", actuators=["boom"])
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
