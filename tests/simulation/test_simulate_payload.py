"""The payload: where it comes from, and what it does to a body's mass properties."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.payload import parse_payload, payload_over_strokes, rated_payload, tool, with_payload


def test_the_templates_first_rule_comes_first(mechanism: Mechanism) -> None:
    values = {**mechanism.specifications, "Tipping Load": {"value": 1000.0}}
    rated = rated_payload(dataclasses.replace(mechanism, specifications=values))
    assert rated.mass == 500.0
    assert "Tipping Load" in rated.source


def test_else_the_next_that_is_known(mechanism: Mechanism) -> None:
    assert rated_payload(mechanism).mass == pytest.approx(0.05 * 1800.0)


def test_what_is_rated_at_one_place_is_not_driven_over_full_strokes(mechanism: Mechanism) -> None:
    """A crane's: its luffing cylinder was said to be too weak for a load that its chart has at three metres alone."""
    assert payload_over_strokes(mechanism) == rated_payload(mechanism)
    assert mechanism.payload is not None
    rules = tuple(dataclasses.replace(rule, at="Radius at Maximum Capacity") for rule in mechanism.payload.rated)
    crane = dataclasses.replace(mechanism, payload=dataclasses.replace(mechanism.payload, rated=rules))
    driven = payload_over_strokes(crane)
    assert rated_payload(crane).mass > 0.0 and driven.mass == 0.0
    assert "90 kg are rated at Radius at Maximum Capacity alone" in driven.source


def test_a_template_without_a_rule_rates_nothing(mechanism: Mechanism) -> None:
    rated = rated_payload(dataclasses.replace(mechanism, payload=None))
    assert rated.mass == 0.0 and "template" in rated.source


def test_else_nothing_and_why(mechanism: Mechanism) -> None:
    rated = rated_payload(dataclasses.replace(mechanism, specifications={"Bucket Capacity Heaped": {"value": None}}))
    assert rated.mass == 0.0 and rated.source


def test_mass_and_moments_add_up(mechanism: Mechanism) -> None:
    before, after = tool(mechanism), tool(with_payload(mechanism, 500.0))
    assert after.mass == before.mass + 500.0
    (middle,) = (site.position for site in mechanism.sites if site.name == "load")
    weighted = before.mass * np.asarray(before.center_of_mass) + 500.0 * np.asarray(middle)
    assert np.asarray(after.center_of_mass) * after.mass == pytest.approx(weighted)
    moments = np.linalg.eigvalsh(after.inertia)
    assert moments[0] > 0.0 and moments[0] + moments[1] >= moments[2]


def test_without_a_site_it_is_in_the_middle_of_the_tool(mechanism: Mechanism) -> None:
    bare = dataclasses.replace(mechanism, payload=None)
    before, after = tool(bare), tool(with_payload(bare, 500.0))
    middle = 0.5 * (np.asarray(before.hull).min(axis=0) + np.asarray(before.hull).max(axis=0))
    weighted = before.mass * np.asarray(before.center_of_mass) + 500.0 * middle
    assert np.asarray(after.center_of_mass) * after.mass == pytest.approx(weighted)


def test_no_payload_changes_nothing(mechanism: Mechanism) -> None:
    assert with_payload(mechanism, 0.0) is mechanism


def test_a_machine_without_a_tool_is_said(mechanism: Mechanism) -> None:
    with pytest.raises(YellowironError, match="which body carries"):
        with_payload(dataclasses.replace(mechanism, sites=()), 1.0)


@pytest.mark.parametrize(("text", "mass"), [("5000", 5000.0), ("5.5 t", 5500.0), ("0", 0.0), ("2000 lb", 907.18474)])
def test_a_mass_as_a_person_gives_it(text: str, mass: float) -> None:
    assert parse_payload(text, "no.usda").mass == pytest.approx(mass)


@pytest.mark.parametrize("text", ["lots", "-5", "nan", "inf", "1e999", "5 m", "5 things", ""])
def test_what_is_no_mass_is_told_how_to_write_one(text: str) -> None:
    with pytest.raises(YellowironError, match="mass of 0 kg or more") as caught:
        parse_payload(text, "no.usda")
    assert "rated" in caught.value.hint
