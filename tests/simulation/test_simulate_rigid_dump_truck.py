"""The rigid dump truck example in engines: strokes, the body tipped with the rated load, driving and steering."""

from __future__ import annotations

import math
from pathlib import Path

import in_engines
import pytest

from kit.builds import MadeOnce
from kit.machines.drawn_examples import built_example
from yellowiron.simulation import drive, rated_payload, run_tests, simulate
from yellowiron.simulation.driving.result import driving_findings
from yellowiron.simulation.registry import import_engine
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow
PAYLOAD = 54_000.0


@pytest.fixture(scope="module")
def file(made_once: MadeOnce) -> Path:
    return built_example("rigid_dump_truck", made_once)


# Its steering in PhysX: the wheeled excavator's, of the same kind; its hoist in Newton: the articulated one's.
@pytest.mark.parametrize(
    ("engine", "payload", "actuators"),
    [("mujoco", PAYLOAD, None), ("physx", 0.0, ["hoist"])],
)
def test_full_strokes(file: Path, engine: str, payload: float, actuators: list[str] | None) -> None:
    in_engines.need(engine)
    import_engine(engine)  # before a stage opens: its schemas
    assert rated_payload(read_mechanism(file)).mass == pytest.approx(PAYLOAD)
    result = simulate(file, engine=engine, payload_kg=payload, actuators=actuators)
    assert result.base == "fixed" and result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < {"mujoco": 5e-5, "newton": 5e-5, "physx": 2.5e-4}[engine]
    assert all(a.final_error_percent < 1.0 for a in result.actuators)


@pytest.mark.parametrize("payload", [0.0, PAYLOAD])
def test_it_drives_on_its_rear_wheels_and_steers_with_the_front_ones(file: Path, payload: float) -> None:
    result = drive(file, engine="mujoco", payload_kg=payload)
    in_engines.assert_straight(result)
    # Tyres that scrub press the knuckles back by some of their 39°.
    assert result.lock is not None and math.radians(35.0) < result.lock < math.radians(39.0)
    assert result.turning_radius == pytest.approx(result.geometry_radius, rel=0.05)
    assert list(driving_findings(result)) == []


def test_it_tips_what_it_is_rated_for(file: Path) -> None:
    figures = {f.test.name: f for f in run_tests(file, engine="mujoco")}
    for name, printed in (("Body Raise Time", 10.1), ("Body Lower Time", 7.3)):
        assert figures[name].engine_value == pytest.approx(printed, rel=0.03), name
        assert figures[name].statics_value == pytest.approx(printed, rel=0.01), name
    assert figures["Rated Payload"].arrived and not figures["Twice the Rated Payload"].arrived
