"""Lever tables: what a learner reads is what the linkage does."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yellowiron.levers import LeverTable
from yellowiron.model.errors import YellowironError

ARM, BASE, START = 1.2, 0.7, 1.1
"""A crank of length ARM, turned by a cylinder whose other pin is BASE away; the angle between them as drawn."""
DRAWN = math.sqrt(ARM**2 + BASE**2 - 2 * ARM * BASE * math.cos(START))
STROKES = np.linspace(-0.2, 0.4, 21)


def true_angle(stroke: Any) -> Any:
    length = DRAWN + np.asarray(stroke)
    return np.arccos((ARM**2 + BASE**2 - length**2) / (2 * ARM * BASE)) - START


def true_lever(stroke: Any) -> Any:
    return ARM * BASE * np.sin(true_angle(stroke) + START) / (DRAWN + np.asarray(stroke))


def table() -> dict[str, Any]:
    pivot = {"angle": true_angle(STROKES).tolist(), "lever": true_lever(STROKES).tolist()}
    still = {"angle": [0.0] * 20 + [0.1], "lever": [None] * 20 + [5.0]}
    back = {"angle": (STROKES**2).tolist(), "lever": [0.5 / s if abs(s) > 1e-9 else None for s in STROKES]}
    pivots = {"crank": pivot, "late": still, "turning back": back}
    return {"joint": "slide", "stroke": STROKES.tolist(), "extension": [], "pivots": pivots}


@pytest.fixture
def report(tmp_path: Path) -> Path:
    path = tmp_path / "report.json"
    alone = {**table(), "pivots": {"crank": table()["pivots"]["crank"]}}
    path.write_text(json.dumps({"levers": {"boom": table(), "steering": alone, "drive": {}}}), encoding="utf-8")
    return path


@given(st.floats(-0.2, 0.4))
def test_between_the_strokes(stroke: float) -> None:
    crank = LeverTable.from_table(table(), "boom", pivot="crank")
    assert crank.angle(stroke) == pytest.approx(true_angle(stroke), abs=1e-6)
    assert crank.lever(stroke) == pytest.approx(true_lever(stroke), rel=1e-3)
    assert crank.stroke(crank.angle(stroke)) == pytest.approx(stroke, abs=1e-9)


def test_arrays_and_ends(report: Path) -> None:
    crank = LeverTable.from_report(report, "boom", pivot="crank")
    strokes = np.array([[-1.0, 0.0], [0.1, 9.0]])
    assert crank.angle(strokes).shape == crank.lever(strokes).shape == crank.stroke(strokes).shape == (2, 2)
    assert crank.angle(-1.0) == pytest.approx(true_angle(-0.2))
    assert crank.stroke(100.0) == pytest.approx(0.4)
    assert crank.angle(0.0) == pytest.approx(0.0, abs=1e-6)


def test_a_falling_angle_is_inverted(report: Path) -> None:
    data = table()
    for key in ("angle", "lever"):
        data["pivots"]["crank"][key] = [-v for v in data["pivots"]["crank"][key]]
    crank = LeverTable.from_table(data, "boom", pivot="crank")
    assert crank.stroke(-true_angle(0.3)) == pytest.approx(0.3, abs=1e-6)


def test_the_only_pivot_needs_no_name(report: Path) -> None:
    assert LeverTable.from_report(report, "steering").pivot == "crank"


def test_a_pivot_that_stands_still_has_no_lever(report: Path) -> None:
    late = LeverTable.from_report(report, "boom", pivot="late")
    assert np.isinf(late.lever(-0.1))


@pytest.mark.parametrize(
    ("actuator", "pivot", "message"),
    [
        ("drive", "", "no lever table for 'drive'"),
        ("lift", "", "no lever table for 'lift'"),
        ("boom", "", "turns 3 pivots"),
        ("boom", "hook", "turns no pivot 'hook'"),
    ],
)
def test_what_is_not_there(report: Path, actuator: str, pivot: str, message: str) -> None:
    with pytest.raises(YellowironError, match=message) as caught:
        LeverTable.from_report(report, actuator, pivot=pivot)
    assert "crank" in caught.value.hint or "boom" in caught.value.hint


def test_two_strokes_of_one_angle(report: Path) -> None:
    with pytest.raises(YellowironError, match="not unique"):
        LeverTable.from_report(report, "boom", pivot="turning back").stroke(0.01)


@pytest.mark.parametrize("text", ["", "[]", "{}", None])
def test_no_report(tmp_path: Path, text: str | None) -> None:
    path = tmp_path / "report.json"
    if text is not None:
        path.write_text(text, encoding="utf-8")
    with pytest.raises(YellowironError, match="report"):
        LeverTable.from_report(path, "boom")
