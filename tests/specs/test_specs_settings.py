"""Values given by a person, and who wins."""

from __future__ import annotations

import math

import pytest
from specs_layouts import template, wanted

from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import JointTemplate, Variant
from yellowiron.specs import merge, parse_settings, split_settings
from yellowiron.specs.values.requested import asked

SLIDE = JointTemplate("slide", "prismatic", ("barrel", "rod"), 0.0, "Lift Cylinder Stroke")
HINGE = JointTemplate("hinge", "revolute", ("front", "pin"), "-Maximum Steering Angle", "Maximum Steering Angle")
TEMPLATE = template(
    wanted("Main Relief Pressure", "pressure"), wanted("Lift Cylinders", "count"), joints=(SLIDE, HINGE)
)


def test_limits_without_an_entry_are_asked_for_by_their_words() -> None:
    assert [(w.name, w.dimension) for w in asked(TEMPLATE)] == [
        ("Main Relief Pressure", "pressure"),
        ("Lift Cylinders", "count"),
        ("Lift Cylinder Stroke", "length"),
        ("Maximum Steering Angle", "angle"),
    ]


@pytest.mark.parametrize(
    ("text", "name", "value", "unit"),
    [
        ("Lift Cylinder Stroke=764 mm", "Lift Cylinder Stroke", 0.764, "m"),
        ("lift_cylinder_stroke = 30.1 in", "Lift Cylinder Stroke", 0.76454, "m"),
        ("Lift-Cylinder Stroke=2'6\"", "Lift Cylinder Stroke", 0.762, "m"),
        ("Maximum Steering Angle=40°", "Maximum Steering Angle", math.radians(40), "rad"),
        ("Maximum Steering Angle=40 deg", "Maximum Steering Angle", math.radians(40), "rad"),
        ("main relief pressure=31.4 MPa", "Main Relief Pressure", 31.4e6, "Pa"),
        ("Main Relief Pressure=314 bar", "Main Relief Pressure", 31.4e6, "Pa"),
        ("Lift Cylinders=2", "Lift Cylinders", 2.0, "1"),
    ],
)
def test_settings(text: str, name: str, value: float, unit: str) -> None:
    found = parse_settings([text], TEMPLATE).get(name)
    assert found is not None and (found.status, found.source, found.unit) == ("ok", "set", unit)
    assert found.value == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("texts", "sentence", "hint"),
    [
        (
            ["Lift Cylindr Stroke=764 mm"],
            "No specification or variant is called 'Lift Cylindr Stroke'",
            "'Lift Cylinder Stroke'",
        ),
        (["xyzzy=3 mm"], "No specification or variant is called 'xyzzy'", "Known names: Main Relief Pressure"),
        (["Lift Cylinder Stroke"], "'Lift Cylinder Stroke' is not NAME=VALUE", "--set"),
        (["Lift Cylinder Stroke="], "is not NAME=VALUE", "--set"),
        (["Lift Cylinder Stroke=long"], "'long' is not a number with a unit", "764 mm"),
        (["Lift Cylinder Stroke=764"], "'764' has no unit", "VALUE mm"),
        (["Lift Cylinder Stroke=764 kg"], "'764 kg' is not a length", "VALUE mm"),
        (["Lift Cylinder Stroke=7 furlongs per"], "is not", ""),
        (["Lift Cylinder Stroke=7 mm", "lift cylinder stroke=8 mm"], "given twice: 7 mm and 8 mm", "Keep one"),
    ],
)
def test_bad_settings(texts: list[str], sentence: str, hint: str) -> None:
    with pytest.raises(YellowironError) as caught:
        parse_settings(texts, TEMPLATE)
    assert sentence in caught.value.message and hint in caught.value.hint
    assert caught.value.where.startswith("--set")


RANGED = template(
    wanted("Lift Cylinder Stroke", "length", minimum=0.1, maximum=2.5),
    wanted("Digging Depth", "length", minimum=0.0, maximum=0.8),
    wanted("Bore", "length"),
    wanted("Rack Back", "angle"),
)


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("Lift Cylinder Stroke=0 mm", "from 100 mm to 2500 mm"),
        ("Lift Cylinder Stroke=-764 mm", "from 100 mm to 2500 mm"),
        ("Lift Cylinder Stroke=1e99 mm", "from 100 mm to 2500 mm"),
        ("Digging Depth=-1 mm", "from 0 mm to 800 mm"),
        ("Bore=0 mm", "more than 0"),
        ("Bore=-5 mm", "more than 0"),
        ("Bore=1e999 mm", "more than 0"),
        ("Rack Back=1e999 rad", "from -360 ° to 360 °"),
        ("Rack Back=-400 deg", "from -360 ° to 360 °"),
        ("Bore=1e60 mm", "more than 0 and at most"),
    ],
)
def test_values_that_cannot_be_are_refused(text: str, hint: str) -> None:
    with pytest.raises(YellowironError, match="outside what") as caught:
        parse_settings([text], RANGED)
    assert text in caught.value.where and hint in caught.value.hint


@pytest.mark.parametrize("text", ["Lift Cylinder Stroke=100 mm", "Lift Cylinder Stroke=2500 mm", "Digging Depth=0 mm",
                                  "Rack Back=-10 deg", "Rack Back=0 deg"])  # fmt: skip
def test_the_ends_of_a_range_are_inside_it(text: str) -> None:
    assert len(parse_settings([text], RANGED)) == 1


def test_choices_are_split_from_values() -> None:
    machine = template(wanted("Wheelbase", "length"))
    machine = type(machine)(**{**machine.__dict__, "variants": (Variant("wheel_drive", ("all", "rear"), "all"),)})
    assert split_settings(["Wheel Drive=REAR", "Wheelbase=3 m"], machine) == (
        ("Wheelbase=3 m",),
        {"wheel_drive": "rear"},
    )
    with pytest.raises(YellowironError, match="'four' is no choice of wheel_drive"):
        split_settings(["wheel_drive=four"], machine)
    assert split_settings(["--wheel-drive=rear"], machine) == ((), {"wheel_drive": "rear"})
    with pytest.raises(YellowironError, match="have no tracks to choose") as caught:
        split_settings(["--tracks=belt"], machine)
    assert caught.value.where == "--tracks" and "--set" not in str(caught.value.hint)


def spec(name: str, status: str, value: float | None = None, source: str = "sheet") -> Specification:
    return Specification(name, value, "m", status, source)  # type: ignore[arg-type]


def test_merge_takes_the_strongest_that_knows() -> None:
    note = Finding("SPC001", "warning", "a.pdf", "no text")
    sheet = Specifications({"A": spec("A", "ok", 1.0), "B": spec("B", "conflict"), "C": spec("C", "missing")}, (note,))
    data = Specifications({"a": spec("A", "missing", None, "data"), "C": spec("C", "ok", 3.0, "data")}, (note,))
    given = Specifications({"b": spec("B", "ok", 2.0, "set")})
    merged = merge(sheet, data, given)
    assert [(n, s.value, s.source) for n, s in merged.values.items()] == [
        ("A", 1.0, "sheet"),
        ("B", 2.0, "set"),
        ("C", 3.0, "data"),
    ]
    assert merged.findings == (note,)
    # a doubt in a stronger source is not settled by a weaker one
    assert merge(given, sheet).get("B") == spec("B", "conflict")
    assert len(merge()) == 0
