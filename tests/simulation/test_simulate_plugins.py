"""Engines that other packages bring: found by their entry point, run as ours are, never in place of ours."""

from __future__ import annotations

from pathlib import Path

import pytest

from kit.packages import install_package
from yellowiron.model.errors import YellowironError
from yellowiron.simulation import examine, installed_engines
from yellowiron.simulation.registry import ENGINES, GROUP, engine_names, find_engine

SOURCE = Path(__file__).parents[1] / "data" / "plugins" / "kinematic_engine.py"


@pytest.fixture
def kinematic(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A package with an engine, in this process and in those that it starts."""
    install_package(
        tmp_path / "site", monkeypatch, name="kinematic-engine", group=GROUP,
        entries={"kinematic": "kinematic_engine:ENTRY"}, modules={"kinematic_engine": SOURCE.read_text()},
    )  # fmt: skip


@pytest.mark.slow
def test_another_packages_engine_drives_the_machine(kinematic: None, usd_file: Path) -> None:
    document, _ = examine(usd_file, engine="kinematic", test="strokes")
    assert document["version"] == "1.0" and document["completed"] and document["branches_kept"]
    assert document["pin_error_mm"] < 1e-6 and document["dt_s"] == 0.02
    assert not [f for f in document["findings"] if f["code"] != "SIM005"]


def test_it_is_known_after_ours(kinematic: None) -> None:
    assert engine_names() == (*ENGINES, "kinematic")
    assert installed_engines()[-1] == "kinematic"
    with pytest.raises(YellowironError, match=r"no engine 'bullet'.*mujoco, newton, physx, kinematic\."):
        find_engine("bullet")


def test_a_broken_one_is_one_sentence_and_hides_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install_package(
        tmp_path, monkeypatch, name="broken", group=GROUP, entries={"broken": "broken_engine:ENTRY"},
        modules={"broken_engine": "ENTRY = 'not an entry'"},
    )  # fmt: skip
    assert find_engine("mujoco") is ENGINES["mujoco"]
    with pytest.raises(YellowironError, match="The plugin 'broken' is no EngineEntry but a str"):
        find_engine("broken")


def test_none_takes_the_place_of_ours(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install_package(tmp_path, monkeypatch, name="thief", group=GROUP, entries={"mujoco": "thief:ENTRY"})
    with pytest.raises(YellowironError, match="brings 'mujoco', a name that yellowiron has itself"):
        find_engine("mujoco")
