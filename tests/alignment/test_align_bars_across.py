"""Bars that lie across the machine are hardly halves of cylinders that cannot lie so."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.fusion import votes as votes_module
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.alignment.fusion.votes import votes_of
from yellowiron.library import load_template
from yellowiron.model.template import Template, choose

STANCE = Stance(np.eye(3), np.zeros(3), 10.0, 1.0)


@pytest.fixture(scope="module")
def excavator() -> Template:
    return choose(load_template("excavator"), {"boom_cylinders": "single"})


def piece(number: int, area: float, axis: tuple[float, float, float] = (1.0, 0.0, 0.0), thick: float = 0.5) -> Piece:
    axes = np.linalg.svd(np.array([axis]))[2]
    samples = np.outer(np.linspace(-0.5, 0.5, 20), axis) + np.array([1.0, 0.0, 2.0])
    low, high = samples.min(axis=0), samples.max(axis=0)
    spread = np.array([1.0, thick, thick])
    return Piece(frozenset({number}), "", -1, area, low, high, 0.5 * (low + high), spread, axes, samples, 1.0)


@pytest.mark.parametrize(("axis", "across"), [((1.0, 0.0, 0.0), False), ((0.0, 1.0, 0.0), True)])
def test_a_bar_across_the_machine_is_hardly_half_of_a_cylinder_without_room(
    excavator: Template, monkeypatch: pytest.MonkeyPatch, axis: tuple[float, float, float], across: bool
) -> None:
    monkeypatch.setattr(votes_module, "_solved", lambda answer: {})
    bar = piece(0, 0.01, axis, thick=0.05)

    def told(template: Template, name: dict[str, float]) -> dict[str, Any]:
        answer = cast(Answer, SimpleNamespace())
        (mine,) = votes_of([bar], template, [name], [1.0], answer, STANCE, {}, 1.0)
        return dict(mine)

    assert told(excavator, {})["boom_cylinder_barrel"].get("crosswise", 0.0) == float(across)
    called = told(excavator, {"boom_cylinder_barrel": 1.0})["boom_cylinder_barrel"]
    assert called.get("no bar", 0.0) == float(across)
    assert "crosswise" not in called, "unless it is called so"
    truck = choose(load_template("rigid_dump_truck"), {})
    steering = told(truck, {})["steering_cylinder_barrel_l"]
    assert steering.get("no bar", 0.0) == float(across)
    assert "crosswise" not in steering, "a steering cylinder lies across"
