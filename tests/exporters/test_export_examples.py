"""Whole examples, exported: over their full strokes every body and every cut pin within a micrometre."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import yellowiron
from kit.builds import MadeOnce
from kit.export_poses import BAR, worst_of_strokes
from kit.machines.drawn_examples import build_example, built_example, drawn_example
from yellowiron.exporters import Geometry, unsaid
from yellowiron.exporters.ros.urdf import export_urdf
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.slow


def held(usd: Path, folder: Path) -> None:
    mechanism = read_mechanism(usd)
    worst, gap, count = worst_of_strokes(export_urdf(mechanism, Geometry(), folder), mechanism)
    assert count >= 20 and worst < BAR and gap < BAR
    for to in ("urdf", "sdf", "drake"):
        assert any("loop" in words or "constraint" in words for words in unsaid(mechanism, to=to))


def agrees(usd: Path, folder: Path) -> None:
    """Every format's file, as `check` reads it, against the machine."""
    for to in ("mjcf", "mjcf-tendons", "urdf", "sdf", "drake"):
        file = yellowiron.export(usd, to=to, out=folder / to)
        (found,) = [f for f in yellowiron.check(file, machine=usd) if f.code.startswith("EXP")]
        assert found.code == "EXP006", (to, found)


def test_a_wheel_loader(built_loader: Any, tmp_path: Path) -> None:
    held(built_loader.folder / "wheel_loader.usda", tmp_path / "urdf alone")
    agrees(built_loader.folder / "wheel_loader.usda", tmp_path)


@pytest.mark.parametrize("example", ["dozer"])
def test_a_drawn_example(example: str, made_once: MadeOnce, tmp_path: Path) -> None:
    held(built_example(example, made_once), tmp_path / "urdf alone")
    agrees(built_example(example, made_once), tmp_path)


def test_a_forklift(root: Path, made_once: MadeOnce, tmp_path: Path) -> None:
    sheet = root / "examples" / "forklift" / "specifications.pdf"
    built = build_example("forklift", drawn_example("forklift", made_once), made_once, named=True, sheet=sheet)
    held(built.machine.usd, tmp_path)
