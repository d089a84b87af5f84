"""Words of a label that a value's own words do not explain: which of them matter."""

from __future__ import annotations

import pytest

from kit.templates import template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.reader import Sheet
from yellowiron.specs.values.requested import spelled_out

BOX = (10.0, 10.0, 90.0, 20.0)


def found(equipment_type: str, label: str, value: str) -> dict[str, str]:
    """Name → status of what one row gives."""
    sheet = Sheet("a.pdf", 1, (Statement(1, 0, label, value, BOX, label),), (), "point")
    values = from_sheets(template(equipment_type), [sheet])
    return {s.name: s.status for s in values if s.status != "missing"}


@pytest.mark.parametrize(
    ("label", "value", "name"),
    [
        ("Breakout force at bucket lip", "253 kN", "Breakout Force"),
        ("Overall length, bucket flat on ground", "9,820 mm", "Overall Length"),
        ("Implement pump flow at rated rpm", "366 L/min", "Main Pump Flow"),
        ("Wheelbase, axle to axle", "3,875 mm", "Wheelbase"),
        ("Loader arm cylinder piston diameter", "150 mm", "Lift Cylinder Bore"),
        ("Kippzylinder, Stange", "90 mm", "Tilt Cylinder Rod Diameter"),
        ("Altura hasta el techo de la cabina", "3.4 m", "Overall Height"),
        ("卸载高度（最大提升，45°卸料）", "3100 mm", "Dumping Clearance"),
    ],
)
def test_a_remark_is_no_doubt(label: str, value: str, name: str) -> None:
    assert found("wheel_loader", label, value) == {name: "ok"}


@pytest.mark.parametrize(
    ("label", "value"),
    [
        ("Overall height, stowed", "3.4 m"), ("Operating weight, fork arrangement", "20,000 kg"),
        ("Breakout force, quorbel", "253 kN"), ("Track on ground", "2,964 mm"), ("Length, bare machine", "6.5 m"),
        ("Pilot pump flow", "34 L/min"),
    ],
)  # fmt: skip
def test_another_body_a_condition_or_an_unknown_word_is(label: str, value: str) -> None:
    assert "ok" not in found("wheel_loader", label, value).values()


def test_a_value_that_cannot_be_speaks_of_another() -> None:
    assert found("excavator", "Width over crawlers", "3,475 mm") == {"Overall Width": "ok"}


def test_a_sub_heading_of_another_part_is_no_help() -> None:
    """The arm that a loader lifts by is no dipper, which is called an arm as well."""
    row = Statement(
        1, 0, "Stangendurchmesser", "45 mm", BOX, "", context=("Ladearm-Hubzylinder",), section="Hydraulikzylinder"
    )
    sheet = Sheet("a.pdf", 1, (row,), (), "point")
    values = from_sheets(template("backhoe_loader"), [sheet])
    assert [s.name for s in values if s.status == "ok"] == ["Loader Lift Cylinder Rod Diameter"]


def test_a_concept_is_spelled_out() -> None:
    assert spelled_out("lift_arm/boom cylinder bore") == ["lift arm cylinder bore", "boom cylinder bore"]
