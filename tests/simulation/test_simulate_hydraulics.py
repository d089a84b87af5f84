"""The template's tests in MuJoCo, against statics."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from yellowiron.model.errors import YellowironError
from yellowiron.model.machine_tests import MachineTest
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation import examine, figures_document, run_tests
from yellowiron.simulation.machine_tests.figures import Figure, beside_sheet, figure_findings
from yellowiron.usd import read_mechanism


def test_the_file_alone_carries_the_tests(mechanism: Mechanism) -> None:
    assert [test.kind for test in mechanism.tests] == ["tipping", "force", "time", "force", "lift"]
    assert mechanism.payload is not None and mechanism.payload.site == "load"
    assert mechanism.tests[2].steps == ({"set": {"boom": "min"}},)


@pytest.mark.slow
def test_the_small_machine_is_put_to_its_tests(usd_file: Path) -> None:
    tipping, force, time, best, lift = run_tests(usd_file, engine="mujoco")
    for figure in (tipping, force, best):
        assert figure.statics_difference_percent == pytest.approx(0.0, abs=2.0)
        assert figure.spec is None and figure.passed is None
    assert tipping.engine_value is not None and "rear_wheel_l" in tipping.reason
    assert "relief" in force.reason
    assert best.statics_value is not None and force.statics_value is not None
    assert best.statics_value > 1.001 * force.statics_value  # the drawn pose is not the boom's strongest
    assert time.engine_value == pytest.approx(time.statics_value, rel=0.15)
    assert lift.arrived and lift.passed and lift.engine_value == 1.0


def test_a_test_that_is_not_there_is_said(usd_file: Path) -> None:
    with pytest.raises(YellowironError, match="no test"):
        run_tests(usd_file, engine="mujoco", names=["Flight"])


@pytest.mark.slow
def test_the_document_has_what_ran_and_nothing_else(usd_file: Path) -> None:
    document, sweeps = examine(usd_file, engine="mujoco", test="drive")
    assert document["driving"]["forward_m"] == pytest.approx(5.0, rel=0.03)
    assert "tests" not in document and "actuators" not in document and not sweeps
    assert document["findings"] == []


def figure(mechanism: Mechanism, value: float, *, example: bool = False, calibrated: bool = False) -> Figure:
    specifications = {
        "Tipping Load": {"value": 1000.0, "unit": "kg", "status": "ok", "example": example},
        "Pressure": {"value": 2e7, "unit": "Pa", "status": "ok", "example": True, "page": 3},
    }
    test = MachineTest("Tipping", "tipping", specification="Tipping Load", inputs=("Pressure", "Weight"))
    mechanism = dataclasses.replace(mechanism, specifications=specifications)
    return beside_sheet(Figure(test, value, value), mechanism, calibrated=calibrated)


def test_a_figure_off_the_sheet_is_a_finding(mechanism: Mechanism) -> None:
    held, off = figure(mechanism, 1090.0), figure(mechanism, 1110.0)
    assert held.passed is True and off.passed is False
    (finding,) = figure_findings((held, off))
    assert finding.code == "SIM006" and "Pressure, Weight" in finding.hint
    (entry,) = figures_document((off,))
    assert entry["error_percent"] == pytest.approx(11.0)
    assert [i["published"] for i in entry["inputs"]] == [False, False]


def test_what_weights_add_is_not_held_against_a_sheet_that_leaves_them_out(mechanism: Mechanism) -> None:
    """A digging force of 81 kN of which the arm's own weight gives 7, beside 73 kN calculated without it."""
    heavy = dataclasses.replace(figure(mechanism, 1130.0), weights=100.0)
    assert heavy.error_percent == pytest.approx(3.0) and heavy.passed is True
    assert heavy.statics_difference_percent == pytest.approx(0.0)
    assert figures_document((heavy,))[0]["weights"] == 100.0
    assert "weights" not in figures_document((figure(mechanism, 1130.0),))[0]
    off = dataclasses.replace(heavy, engine_value=1230.0, statics_value=1230.0)
    (finding,) = figure_findings((off,))
    assert finding.code == "SIM006" and "+13.0 %" in finding.message


@pytest.mark.slow
def test_a_forces_weights_are_told_where_the_sheet_leaves_them_out(mechanism: Mechanism, usd_file: Path) -> None:
    with_them = mechanism.tests[3]
    plain = run_tests(usd_file, engine="mujoco", tests=(with_them,))[0]
    less = run_tests(usd_file, engine="mujoco", tests=(dataclasses.replace(with_them, unweighted=True),))[0]
    assert plain.weights == 0.0 and less.weights != 0.0
    assert less.engine_value == pytest.approx(plain.engine_value)
    assert f"{less.weights / 1e3:.1f} kN" in less.reason


def test_examples_and_what_made_the_model_prove_nothing(mechanism: Mechanism) -> None:
    example, made = figure(mechanism, 2000.0, example=True), figure(mechanism, 2000.0, calibrated=True)
    assert (example.role, made.role) == ("example", "calibrated")
    assert not list(figure_findings((example, made)))


def test_a_lift_that_ends_otherwise_is_a_finding() -> None:
    must = Figure(MachineTest("Rated", "lift"), 0.5, 1.0, arrived=False, reason="stalled")
    must_not = Figure(MachineTest("Twice", "lift", expected=False), 1.0, 1.0, arrived=True)
    assert [f.code for f in figure_findings((must, must_not))] == ["SIM007", "SIM007"]


def test_engine_and_statics_apart_is_a_finding() -> None:
    (finding,) = figure_findings((Figure(MachineTest("Load", "tipping"), 1100.0, 1000.0),))
    assert finding.code == "SIM008"


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "newton", "physx"])
def test_the_wheel_loader_against_its_sheet(wheel_loader: Path, engine: str) -> None:
    """Published: tipping loads. The rest of the sheet's values are its publisher's examples."""
    if engine != "mujoco":
        pytest.importorskip({"newton": "newton", "physx": "ovphysx"}[engine])
    names = (
        None if engine == "mujoco" else ["Static Tipping Load Full Turn", "Breakout Force", "Twice the Rated Payload"]
    )
    figures = {f.test.name: f for f in run_tests(wheel_loader, engine=engine, names=names)}
    for name, figure in figures.items():
        if figure.test.kind in ("tipping", "force"):
            assert figure.statics_difference_percent == pytest.approx(0.0, abs=3.0), name
        if figure.test.kind == "tipping":
            assert figure.role == "checked" and figure.passed, name
            assert "rear_wheel_l, rear_wheel_r" in figure.reason
        if figure.test.kind == "time":
            assert figure.role == "example" and figure.passed, name
        if figure.test.kind == "lift":
            assert figure.passed, name
    breakout = figures["Breakout Force"]
    assert breakout.role == "example"
    assert [i.name for i in breakout.inputs if not i.published] == ["Main Relief Pressure"]
    assert not list(figure_findings(tuple(figures.values())))


@pytest.mark.slow
def test_a_load_lies_where_the_bucket_holds_it(wheel_loader: Path) -> None:
    site = next(s for s in read_mechanism(wheel_loader).sites if s.name == "load")
    assert site.body == "bucket" and "4.30 m³" in site.source
