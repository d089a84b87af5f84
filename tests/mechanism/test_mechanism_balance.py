"""Where the centre of mass is, by what the front axle carries."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mechanism_machine import specification

from kit.machines.lift_trucks import lift_truck
from kit.machines.partly_drawn import without
from yellowiron.library import load_template
from yellowiron.library.notation.validated_json import read_document
from yellowiron.library.parsing.usual import read_balance
from yellowiron.model.errors import TemplateError
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specifications


def weights(whole: float, front: float) -> Specifications:
    """A sheet with the operating weight and what the front axle carries of it, kg."""
    named = {"Operating Weight": whole, "Axle Load Front Unladen": front}
    return Specifications({name: specification(name, value, "kg") for name, value in named.items()})


def front_share(mechanism: Mechanism) -> float:
    """Of the weight, what the front wheels carry by statics."""
    masses = np.array([body.mass for body in mechanism.bodies])
    middle = float(masses @ np.array([body.center_of_mass[0] for body in mechanism.bodies]) / masses.sum())
    front, rear = (
        np.mean([0.5 * (b.hull[:, 0].min() + b.hull[:, 0].max()) for b in mechanism.bodies if b.name.startswith(end)])
        for end in ("front_wheel", "rear_wheel")
    )
    return float((middle - rear) / (front - rear))


def test_a_published_axle_load_places_the_centre_of_mass() -> None:
    machine = lift_truck(3, "simplex")
    for share in (0.38, 0.46):
        mechanism = without(machine, "forklift", (), sheet=weights(5000.0, 5000.0 * share))
        assert sum(b.mass for b in mechanism.bodies) == pytest.approx(5000.0)
        assert front_share(mechanism) == pytest.approx(share, abs=0.006)


def test_without_one_a_truck_is_held_to_what_makers_trucks_have() -> None:
    machine = lift_truck(3, "simplex")
    chassis = {p.shape for p in machine.parts if machine.truth[p.id][1] == "chassis"}
    machine.shapes.update({
        key: replace(shape, centroid=shape.centroid + np.array([0.4, 0.0, 0.0]))
        for key, shape in machine.shapes.items() if key in chassis
    })  # fmt: skip
    balance = load_template("forklift").balance
    assert balance is not None and balance.usual is not None
    mechanism = without(machine, "forklift", ())
    assert front_share(mechanism) == pytest.approx(balance.usual[1], abs=0.006)
    (told,) = [f for f in mechanism.findings if f.code == "MEC042"]
    assert told.severity == "warning" and "back" in told.message and "Axle Load Front Unladen" in told.hint


def test_a_load_that_cannot_be_met_inside_the_body_is_told() -> None:
    codes = [f.code for f in without(lift_truck(3, "simplex"), "forklift", (), sheet=weights(5000.0, 4900.0)).findings]
    assert "MEC042" in codes and "MEC043" in codes


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('"body": "mast"', "no body"),
        ('"front": ["wheel"]', "no body"),
        ('"specification": "Axle Load"', "no wanted value"),
        ('"usual": {"least": 50, "most": 40, "source": "x"}', "least share"),
    ],
)
def test_what_a_document_cannot_say_is_told(text: str, words: str, tmp_path: Path) -> None:
    whole = {
        "body": '"body": "chassis"', "front": '"front": ["front_wheel"]', "rear": '"rear": ["rear_wheel"]',
        "specification": '"specification": "Axle Load Front Unladen"',
    }  # fmt: skip
    whole[text.split('"')[1]] = text
    path = tmp_path / "balance.json"
    path.write_text("{" + ", ".join(whole.values()) + "}", encoding="utf-8")
    template = load_template("forklift")
    with pytest.raises(TemplateError, match=words):
        read_balance(read_document(path, "balance"), template.roles, template.wanted)
