"""Quantities: text to SI, and values as people read them."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yellowiron.model.errors import YellowironError
from yellowiron.support.text import display, to_json
from yellowiron.support.units import parse_quantity


@pytest.mark.parametrize(
    ("text", "value", "unit"),
    [
        ("764 mm", 0.764, "m"),
        ("-13 deg", -math.radians(13), "rad"),
        ("40°", math.radians(40), "rad"),
        ("31.5 MPa", 31.5e6, "Pa"),
        ("350 L/min", 350e-3 / 60, "m^3/s"),
        ("12 kN*m", 12e3, "N*m"),
        ("2100 rpm", 2100 * math.tau / 60, "rad/s"),
        ("36 km/h", 10.0, "m/s"),
        ("0.8", 0.8, ""),
        ("−5 mm", -0.005, "m"),
        ("25510 kg", 25510.0, "kg"),
    ],
)
def test_quantities_are_read(text: str, value: float, unit: str) -> None:
    assert parse_quantity(text) == (pytest.approx(value), unit)


@pytest.mark.parametrize("text", ["", "wide", "3 bananas", "5 mm^7", "mm 5"])
def test_nonsense_is_refused(text: str) -> None:
    with pytest.raises(YellowironError):
        parse_quantity(text)


@given(st.floats(-1e6, 1e6), st.sampled_from([("mm", 1e-3), ("m", 1.0), ("inch", 0.0254), ("ft", 0.3048)]))
def test_lengths_scale_by_their_unit(value: float, unit: tuple[str, float]) -> None:
    parsed, si = parse_quantity(f"{value!r} {unit[0]}")
    assert si == "m"
    assert parsed == pytest.approx(value * unit[1], rel=1e-12, abs=1e-15)


def test_values_read_well() -> None:
    assert display(0.764, "m") == "764 mm"
    assert display(math.radians(40), "rad") == "40 °"
    assert display(25510.0, "kg") == "25510 kg"
    assert display(None, "m") == "–"


def test_json_is_the_same_for_the_same_values() -> None:
    document = {"a": np.array([[1.0, -0.0]]), "b": (0.1 + 0.2, float("nan")), "ä": np.int64(3)}
    assert json.loads(to_json(document)) == {"a": [[1.0, 0.0]], "b": [0.3, None], "ä": 3}
    assert "ä" in to_json(document)
