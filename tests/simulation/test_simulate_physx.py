"""PhysX on our USD, against the bars; skipped where ovphysx is not installed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from in_engines import installed

from yellowiron.simulation import rated_payload, simulate
from yellowiron.simulation.engine import Base, Setup, coordinates, tell
from yellowiron.simulation.registry import ENGINES
from yellowiron.usd import read_mechanism

pytestmark = [pytest.mark.slow, installed("physx")]


@pytest.mark.parametrize(("base", "actuators"), [("fixed", None), ("floating", ["bucket"]), ("floating", ["steering"])])
def test_full_strokes_with_the_rated_payload(wheel_loader: Path, base: Base, actuators: list[str] | None) -> None:
    """In the air with all levers, as a build drives it: steering is weak for a loaded front, and swung out of place."""
    payload = rated_payload(read_mechanism(wheel_loader))
    result = simulate(wheel_loader, engine="physx", base=base, payload_kg=payload.mass, actuators=actuators)
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings


def test_targets_reach_every_drive(wheel_loader: Path) -> None:
    """Wheels turn and cylinders move as they are told, in SI and in the joints' own sense."""
    from yellowiron.simulation.engines.physx import load

    mechanism = read_mechanism(wheel_loader)
    driven = [j for j in mechanism.joints if j.drive is not None and not j.cut]
    step = ENGINES["physx"].timestep
    setup = Setup(wheel_loader, mechanism, "fixed", step, tuple(j.name for j in driven))
    engine = load(setup)
    told = {j.name: 0.01 if j.drive is not None and j.drive.kind == "position" else 1.0 for j in driven}
    try:
        for share in np.linspace(0.0, 1.0, 120):
            tell(engine, {name: float(share) * value for name, value in told.items()})
            engine.step()
        for _ in range(120):
            engine.step()
        before = coordinates(engine)
        engine.step()
        reached = coordinates(engine)
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
