"""The engine's own settings, and the table of rates."""

from __future__ import annotations

from pathlib import Path

import pytest
from in_engines import EVERY, need
from typer.testing import CliRunner

import yellowiron
from yellowiron.cli import app
from yellowiron.model.errors import YellowironError
from yellowiron.simulation import at_rates, simulate
from yellowiron.simulation.registry import find_engine, usual_timestep

LOOSE = 1e-3
"""Metres: what pins may be apart by an engine's own settings, at steps that are short enough."""


def test_engines_have_steps_of_their_own() -> None:
    assert usual_timestep(find_engine("physx"), "file") == pytest.approx(1.0 / 120.0)
    assert usual_timestep(find_engine("physx"), "engine") == pytest.approx(1.0 / 60.0)
    assert usual_timestep(find_engine("mujoco"), "engine") == usual_timestep(find_engine("mujoco"), "file")


@pytest.mark.parametrize("engine", EVERY)
def test_a_machine_holds_by_the_engine_s_own_settings(engine: str, usd_file: Path) -> None:
    need(engine)
    result = simulate(usd_file, engine=engine, dt=1.0 / 240.0, settings="engine", actuators=["boom"])
    assert result.completed and result.branches_kept
    assert result.gap < LOOSE


@pytest.mark.slow
def test_a_table_has_a_row_for_each_rate_and_setting(usd_file: Path) -> None:
    document = at_rates(usd_file, engine="mujoco", rates=(240.0, 1000.0))
    rows = document["rates"]
    assert [(row["settings"], row["hz"]) for row in rows] == [
        ("file", 240.0), ("file", 1000.0), ("engine", 240.0), ("engine", 1000.0),
    ]  # fmt: skip
    assert all(row["completed"] and row["reason"] == "" and row["loop_gap_mm"] < 1.0 for row in rows)
    assert rows[0]["loop_gap_mm"] > rows[1]["loop_gap_mm"]
    assert document["findings"] == []


def test_a_run_that_breaks_down_is_a_row(usd_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from yellowiron.simulation import suite

    def broken(*_: object, **__: object) -> None:
        raise YellowironError("The engine 'mujoco' crashed (SIGSEGV)", where="", hint="")

    monkeypatch.setattr(suite, "examine", broken)
    row = at_rates(usd_file, engine="mujoco", rates=(60.0,), settings=("engine",))["rates"][0]
    assert not row["completed"] and "crashed" in row["reason"] and row["loop_gap_mm"] is None


def test_the_command_prints_the_table(usd_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from yellowiron.simulation import suite

    told = {"completed": True, "pin_error_mm": 0.7, "pin_error_at": "pin, boom, 1 s", "loop_gap_mm": 0.25}
    found = {**told, "branches_kept": True, "steps_per_second": 9000}
    monkeypatch.setattr(suite, "examine", lambda *_, **__: (found, ()))
    ran = CliRunner().invoke(
        app, ["simulate", str(usd_file), "--engine", "mujoco", "--hz", "240", "--settings", "engine"]
    )
    assert ran.exit_code == 0, ran.output
    assert all(word in ran.output for word in ("the engine's own", "240", "0.25", "0.7", "9000"))


def test_what_does_not_go_together_is_told(usd_file: Path) -> None:
    with pytest.raises(YellowironError, match="for the strokes alone"):
        yellowiron.simulate(usd_file, test="drive", settings="engine")
    with pytest.raises(YellowironError, match="steps of their own"):
        yellowiron.simulate(usd_file, dt=0.001, rates=(60.0,))
    ran = CliRunner().invoke(app, ["simulate", str(usd_file), "--engine", "mujoco", "--hz", "60,fast"])
    assert ran.exit_code != 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "case", "bar"),
    [
        ("physx", "60 Hz", 1.0),
        ("physx", "120 Hz", 0.25),
        ("physx", "60 Hz, 4 iterations", 100.0),
        ("newton", "60 Hz x 4", 1.0),
        ("mujoco", "240 Hz", 1.0),
    ],
)
def test_the_example_holds_where_only_the_machine_is_referenced(
    engine: str, case: str, bar: float, wheel_loader: Path
) -> None:
    """By an independent loader, in a scene that says gravity and nothing else: mm."""
    import bench_defaults

    need(engine)
    cells = bench_defaults.apart(engine, case, wheel_loader)
    assert float(cells.split()[0]) < bar, cells
