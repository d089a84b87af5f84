"""Every name of every type, asked for in every language: its first label with a value, one row each."""

from __future__ import annotations

import re

import pytest

from kit.templates import template as library_template
from yellowiron.library import list_templates
from yellowiron.model.template import Wanted
from yellowiron.specs import missing_values
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.reader import Sheet

UNIT = {
    "length": ("mm", 1e-3), "angle": ("°", 0.017453292519943295), "mass": ("kg", 1.0), "pressure": ("kPa", 1e3),
    "flow": ("L/min", 1e-3 / 60.0), "volume": ("m³", 1.0), "force": ("kN", 1e3), "torque": ("kNm", 1e3),
    "power": ("kW", 1e3), "speed": ("km/h", 1.0 / 3.6),
    "angular_speed": ("rpm", 0.10471975511965977), "time": ("s", 1.0),
    "count": ("", 1.0),
}  # fmt: skip
LANGUAGES = ("en", "de", "fr", "es", "zh", "ja")


def printed(wanted: Wanted, index: int) -> tuple[str, float]:
    """A value within the range, different for every name, as text and in SI."""
    unit, factor = UNIT[wanted.dimension]
    low, high = (wanted.minimum or 0.0) / factor, (wanted.maximum or 1.0) / factor
    number = low + (high - low) * (0.2 + 0.6 * ((index * 37) % 101) / 101)
    digits = 0 if wanted.dimension in ("count", "length", "mass", "pressure") else 1
    text = f"{number:.{digits}f}"
    return f"{text} {unit}".strip(), float(text) * factor


def statements(wanted: tuple[Wanted, ...], language: str, label: int) -> list[Statement]:
    return [
        Statement(1, n, w.synonyms[language][min(label, len(w.synonyms[language]) - 1)], printed(w, n)[0],
                  (10.0, 12.0 * n, 90.0, 12.0 * n + 9.0), f"row {n}")
        for n, w in enumerate(wanted)
    ]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("equipment_type", list_templates())
def test_first_labels(equipment_type: str, language: str) -> None:
    template = library_template(equipment_type)
    asked = tuple(w for w in template.wanted if w.in_label_of is None)
    sheet = Sheet("a.pdf", 1, tuple(statements(asked, language, 0)), (), "point")
    found = from_sheets(template, [sheet])
    truth = {w.name: printed(w, n)[1] for n, w in enumerate(asked)}
    right = 0
    for one in found:
        if one.status == "ok":
            assert one.value == pytest.approx(truth[one.name], rel=1e-6), (one.name, one.evidence)
            right += 1
    assert right >= 0.9 * len(asked), [(s.name, s.status, s.reason) for s in found if s.status != "ok"]


@pytest.mark.parametrize(
    ("label", "words"),
    [
        ("Gesamtlänge", "overall length"), ("Länge gesamt", "length overall"), ("Länge über alles", "length overall"),
        ("Laenge gesamt", "length overall"), ("Longueur hors-tout", "length overall"),
        ("Largo total", "length overall"),
        ("Hubdauer", "raise time"), ("Temps de levée", "raise time"), ("Tiempo de elevación", "raise time"),
        ("Hubzylinderhub", "lift cylinder stroke"), ("Löffelstielzylinderhub", "stick cylinder stroke"),
        ("Kipplast, voll eingelenkt", "tipping load maximum turn"), ("倾翻载荷-满转向", "tipping load maximum turn"),
        ("Charge maximale de basculement", "tipping load maximum"), ("Width over tires", "width overtire"),
        ("Breite über Reifen", "width overtire"), ("Tire width", "tire width"), ("Bodenplattenbreite", "shoe width"),
        ("Kabinenhöhe", "cab height"), ("Achslastverteilung", "achslastverteilung"),
    ],
)  # fmt: skip
def test_labels_become_the_same_english_words(label: str, words: str) -> None:
    assert " ".join(tokens(label)) == words


def test_a_sub_heading_and_a_label_may_be_one_expression() -> None:
    """A long label wrapped over two lines: its second half is the label, its first the sub-heading."""
    box = (10.0, 10.0, 90.0, 20.0)
    sheet = Sheet("a.pdf", 1, (
        Statement(1, 0, "bore", "115 mm", box, "q", context=("Steering cylinder –",)),
        Statement(1, 1, "reach at ground level", "8,835 mm", box, "q", context=("Max. digging",)),
    ), (), "point")  # fmt: skip
    bore = from_sheets(library_template("wheel_loader"), [sheet]).values["Steering Cylinder Bore"]
    reach = from_sheets(library_template("excavator"), [sheet]).values["Maximum Reach at Ground Line"]
    assert bore.value == pytest.approx(0.115) and reach.value == pytest.approx(8.835)


@pytest.mark.parametrize(
    ("equipment_type", "section", "label", "name"),
    [
        ("articulated_dump_truck", "Dump body and hoist", "Body raise, loaded", "Body Raise Time"),
        ("articulated_dump_truck", "Dump body and hoist", "Tip time (down)", "Body Lower Time"),
        ("articulated_dump_truck", "Weights", "Total machine weight, loaded", "Gross Weight"),
        ("rigid_dump_truck", "外形尺寸参数", "货厢内深", "Body Depth Inside"),
        ("rigid_dump_truck", "寸法", "エンジンガードクリアランス", "Engine Guard Clearance"),
        ("rigid_dump_truck", "Gewichte", "Gesamtgewicht", "Gross Weight"),
        ("dozer", "Track system", "Width, standard shoes, less blade", "Width over Tracks"),
        ("dozer", "行走机构", "接地比压", "Ground Pressure"),
        ("grader", "Schar", "Scharverschiebung links", "Blade Side Shift Left"),
        ("grader", "Dimensions", "Clearance at rear axle", "Ground Clearance"),
        ("backhoe_loader", "Backhoe", "Dipper tearout", "Dipper Digging Force"),
        ("skid_steer", "Dimensions", "Width over tires, less bucket", "Overall Width"),
        ("forklift", "Forks and carriage", "Fork arm thickness", "Fork Thickness"),
        ("forklift", "質量", "前軸重（無負荷時）", "Axle Load Front Unladen"),
        ("forklift", "Abmessungen", "Länge über alles", "Overall Length"),
        ("mobile_crane", "Winde", "Seilzug Hubwerk", "Main Winch Line Pull"),
        ("mobile_crane", "卷扬", "主卷扬单绳拉力", "Main Winch Line Pull"),
        ("mobile_crane", "Stabilisateurs", "Écartement transversal des stabilisateurs", "Outrigger Spread Lateral"),
    ],
)  # fmt: skip
def test_what_makers_print(equipment_type: str, section: str, label: str, name: str) -> None:
    """One row of a maker's sheet is that value, and no other one."""
    wanted = {w.name: w for w in library_template(equipment_type).wanted}
    text, value = printed(wanted[name], 1)
    sheet = Sheet(
        "a.pdf", 1, (Statement(1, 0, label, text, (10.0, 10.0, 90.0, 20.0), "q", section=section),), (), "point"
    )
    found = from_sheets(library_template(equipment_type), [sheet])
    assert {s.name: s.value for s in found if s.status == "ok"} == {name: pytest.approx(value, rel=1e-6)}


@pytest.mark.parametrize(
    ("equipment_type", "section", "label", "text"),
    [
        ("dozer", "Engine", "Bore", "132 mm"), ("grader", "发动机", "行程", "165 mm"),
        ("forklift", "Hydraulik", "Arbeitsdruck für Anbaugeräte", "170 bar"),
        ("backhoe_loader", "Dimensions", "Fuel filler height", "1350 mm"),
        ("mobile_crane", "Dimensions", "Jib stowed width", "900 mm"),
        ("rigid_dump_truck", "Weights", "Front axle, empty", "22400 kg"),
    ],
)  # fmt: skip
def test_what_is_nobodys_value(equipment_type: str, section: str, label: str, text: str) -> None:
    sheet = Sheet(
        "a.pdf", 1, (Statement(1, 0, label, text, (10.0, 10.0, 90.0, 20.0), "q", section=section),), (), "point"
    )
    found = from_sheets(library_template(equipment_type), [sheet])
    assert not [s.name for s in found if s.status == "ok"]


def test_every_type_takes_values_by_hand() -> None:
    for equipment_type in ("dozer", "wheel_loader"):
        template = library_template(equipment_type)
        told = missing_values(template, from_sheets(template, [Sheet("a.pdf", 1, (), (), "point")]))
        assert told and all(one["set"] for one in told)


@pytest.mark.parametrize(
    ("equipment_type", "label", "value", "name"),
    [
        ("wheel_loader", "操作用ポンプ流量", "27 L/min", None),  # the pilot circuit's pump
        ("wheel_loader", "后轴到中心销", "2010 mm", "Rear Axle to Hitch"),
        ("wheel_loader", "Machine width at tyres", "2670 mm", "Overall Width"),
        ("wheel_loader", "Tipping load, straight (no tire squash)", "13650 kg", "Static Tipping Load Straight"),
        ("wheel_loader", "Perno del cucharón, levantado", "3900 mm", "Hinge Pin Height at Maximum Lift"),
        ("excavator", "Reach at grade, max.", "10690 mm", "Maximum Reach at Ground Line"),
        ("excavator", "Deepest dig", "6700 mm", "Maximum Digging Depth"),
        ("excavator", "Hinterer Drehradius", "2900 mm", "Tail Swing Radius"),
        ("rigid_dump_truck", "Length over all", "9600 mm", "Overall Length"),
        ("mobile_crane", "Boom extending ram, dia.", "120 mm", "Telescoping Cylinder Bore"),
    ],
)
def test_other_wordings(equipment_type: str, label: str, value: str, name: str | None) -> None:
    """Labels in words that no template lists as they stand: by concepts and the lexicon."""
    template = library_template(equipment_type)
    statement = Statement(1, 0, label, value, (10.0, 0.0, 90.0, 9.0), f"{label} {value}")
    found = from_sheets(template, [Sheet("a.pdf", 1, (statement,), (), "point")])
    assert [s.name for s in found if s.status == "ok"] == ([name] if name else [])
    if not name:
        assert all(s.status == "missing" for s in found)


@pytest.mark.parametrize(
    ("rows", "foreign"),
    [
        ([("Einsatzgewicht", "20.500 kg"), ("Schaufelbreite, wahlweise", "2.750 mm")], "optional"),
        ([("Poids en ordre de marche", "20 500 kg"), ("Largeur du godet, en option", "2 750 mm")], "optional"),
        ([("Operating weight", "20,500 kg"), ("Bucket width, optional", "2,750 mm")], "Einsatzgewicht"),
        ([("工作重量", "20500 kg"), ("铲斗宽度", "2750 mm")], "weight"),
    ],
)
def test_a_reason_quotes_the_sheets_own_words(rows: list[tuple[str, str]], foreign: str) -> None:
    """Not a synonym in whatever language it was found by, nor the English word that one was brought to."""
    printed_rows = [
        Statement(1, n, label, text, (10.0, 12.0 * n, 90.0, 12.0 * n + 9.0), f"{label} {text}")
        for n, (label, text) in enumerate(rows)
    ]
    found = from_sheets(library_template("wheel_loader"), [Sheet("a.pdf", 1, tuple(printed_rows), (), "unknown")])
    reasons = [s.reason for s in found if s.status in ("ok", "review")]
    reasons += [c.reason for s in found for c in s.candidates]
    assert reasons
    page = " ".join(f"{label} {text}" for label, text in rows)
    for reason in reasons:
        assert all(words in page for words in re.findall(r"'([^']+)'", reason)), reason
        assert foreign not in reason, reason
