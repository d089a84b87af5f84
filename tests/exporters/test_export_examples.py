"""Whole examples as URDF: over their full strokes every body and every cut pin within a micrometre."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

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


def test_a_wheel_loader(built_loader: Any, tmp_path: Path) -> None:
    held(built_loader.folder / "wheel_loader.usda", tmp_path)


@pytest.mark.parametrize("example", ["dozer"])
def test_a_drawn_example(example: str, made_once: MadeOnce, tmp_path: Path) -> None:
    held(built_example(example, made_once), tmp_path)


def test_a_forklift(root: Path, made_once: MadeOnce, tmp_path: Path) -> None:
    sheet = root / "examples" / "forklift" / "specifications.pdf"
    built = build_example("forklift", drawn_example("forklift", made_once), made_once, named=True, sheet=sheet)
    held(built.machine.usd, tmp_path)
