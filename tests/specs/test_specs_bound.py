"""What makers of dozers, rollers and cranes print: parts in a table's corner, rows of models, bound sheets."""

from __future__ import annotations

from pathlib import Path

from specs_layouts import canvas, put, template, wanted

from yellowiron.model.specification import Specifications
from yellowiron.specs import extract
from yellowiron.specs.machines import of_others, several

A, B = frozenset({"GR-250N"}), frozenset({"GR-300EX"})
ASKED = template(
    wanted("Overall Height", "length", "height"),
    wanted("Blade Height", "length", "blade height"),
    wanted("Shipping Weight", "mass", "shipping weight"),
    wanted("Centrifugal Force High", "force", "centrifugal force"),
    wanted("Centrifugal Force Low", "force", "centrifugal force low", low_end_of="Centrifugal Force High"),
    wanted("Drum Shell Thickness", "length", "drum thickness"),
    wanted("Maximum Reverse Speed", "speed", "reverse"),
    wanted("Slewing Speed", "angular_speed", "swing speed"),
)


def said(found: Specifications) -> dict[str, tuple[str, float | None]]:
    return {s.name: (s.status, None if s.value is None else round(s.value, 4)) for s in found if s.status != "missing"}


def table(path: Path, rows: list[tuple[str, ...]], *, bold: int = 1, raised: str = "") -> Path:
    c = canvas(path)
    for index, row in enumerate(rows):
        for column, text in enumerate(row):
            x, y = 60 + 120 * column, 700 - 16 * index
            width = put(c, x, y, text, bold=index < bold)
            if raised and index == bold and column:
                put(c, x + width + 0.3, y + 3, raised, size=5)
    c.save()
    return path


def test_a_tables_corner_names_the_part_and_raised_notes_end_no_heads(tmp_path: Path) -> None:
    rows = [("Blade", "6S", "6S LGP", "6SU"), ("Height", "1257 mm", "1101 mm", "1412 mm")]
    found = extract(ASKED, [table(tmp_path / "a.pdf", rows, raised="(4)(5)")], config="6S LGP")
    assert said(found) == {"Blade Height": ("ok", 1.101)}


def test_a_row_for_each_model_under_its_property(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Shipping weight")
    for index, (model, mass) in enumerate((("D6R2", "16 209 kg"), ("D6R2 XL", "16 820 kg"), ("D6R2 LGP", "18 720 kg"))):
        put(c, 72, 686 - 14 * index, model)
        put(c, 260, 686 - 14 * index, mass)
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="XL")) == {"Shipping Weight": ("ok", 16820.0)}
    assert said(extract(ASKED, [tmp_path / "a.pdf"])) == {"Shipping Weight": ("conflict", None)}


def test_two_numbers_under_one_label_are_its_ends_and_a_sum_is_doubtful(tmp_path: Path) -> None:
    rows = [("Centrifugal force", "256/147 kN"), ("Drum thickness", "28 + 10 mm")]
    found = said(extract(ASKED, [table(tmp_path / "a.pdf", rows, bold=0)]))
    assert found["Centrifugal Force High"] == ("ok", 256000.0)
    assert found["Centrifugal Force Low"] == ("ok", 147000.0)
    assert found["Drum Shell Thickness"][0] != "ok"


def test_speeds_of_gears_under_one_name(tmp_path: Path) -> None:
    gears = (("1.0 Reverse", "4.8 km/h"), ("2.0 Reverse", "8.4 km/h"), ("2.5 Reverse", "8.4 km/h"))
    found = extract(ASKED, [table(tmp_path / "a.pdf", [*gears, ("3.0 Reverse", "14.5 km/h")], bold=0)])
    assert said(found) == {"Maximum Reverse Speed": ("ok", 4.0278)}
    found = extract(ASKED, [table(tmp_path / "b.pdf", [*gears[:1], *gears[2:], ("4.0 Reverse", "14.5 km/h")], bold=0)])
    assert said(found) == {"Maximum Reverse Speed": ("review", 4.0278)}, "the third one is not there"


def test_a_raised_exponent_makes_minutes_turns(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Swing speed")
    width = put(c, 200, 700, "2.6 min")
    put(c, 200 + width, 703, "-1", size=5)
    put(c, 200 + width + 8, 700, "(rpm)")
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"])) == {"Slewing Speed": ("ok", 0.2723)}


def test_pages_of_another_machine_bound_in_the_same_file() -> None:
    titles = [A, A, frozenset(), A, B, frozenset(), B | {"GR-300E"}, frozenset()]
    assert of_others(titles, "GR-250N") == {5, 6, 7}
    assert of_others(titles, "GR 300EX") == {1, 2, 3, 4}
    assert of_others(titles, "long boom") == frozenset()
    assert of_others([A, A | B, B, B], "GR-250N") == frozenset()  # one brochure of both
    assert several(titles)[5] == "GR-300EX"
    assert several([A, A | B, B, B]) == {}


def test_a_value_of_one_of_several_machines_is_to_be_reviewed(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    for model, speed in (("GR-250N", "2.6 rpm"), ("GR-250N", ""), ("GR-300EX", "2.9 rpm"), ("GR-300EX", "")):
        put(c, 60, 800, model, size=20, bold=True)
        put(c, 60, 700, "Swing speed")
        put(c, 200, 700, speed or "see above")
        c.showPage()
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="GR-300EX")) == {"Slewing Speed": ("ok", 0.3037)}
    assert said(extract(ASKED, [tmp_path / "a.pdf"]))["Slewing Speed"][0] != "ok"
