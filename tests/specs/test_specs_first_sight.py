"""What came `ok` and was wrong when makers' brochures that nobody had opened were read for the first time."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from specs_layouts import canvas, put, template, wanted

from yellowiron.model.template import Wanted
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.layout.rows.lines import lines_of
from yellowiron.specs.layout.rows.prose import read_paragraph
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.pages.words import Word
from yellowiron.specs.reader import Sheet, read_sheet


def row(number: int, label: str, text: str, **more: object) -> Statement:
    top = 20.0 * number
    return Statement(1, number, label, text, (200.0, top, 260.0, top + 9.0), f"{label} {text}", **more)  # type: ignore[arg-type]


def found(asked: Sequence[Wanted], *rows: Statement, config: str = "") -> dict[str, tuple[str, float | None]]:
    sheet = Sheet("a.pdf", 1, rows, (), "point")
    return {s.name: (s.status, s.value) for s in from_sheets(template(*asked), [sheet], config=config)}


def test_a_value_that_a_narrow_gap_left_at_its_label_is_said_again_in_inches() -> None:
    asked = [wanted("Bucket Cylinder Stroke", "length")]
    values = found(asked, row(1, "Family Bucket Cylinder – Stroke 1156 mm", "46 in"))
    assert values["Bucket Cylinder Stroke"][1] == pytest.approx(1.156)
    # What a label's number holds for is none of its values.
    assert found(asked, row(1, "Bucket Cylinder Stroke at 1156 mm", "46 in"))["Bucket Cylinder Stroke"][1] != 1.156


def test_a_row_under_what_adds_to_a_length_is_no_height() -> None:
    asked = [wanted("Ripper Lift Height", "length", "ripper raised")]
    for above, status in (("add to basic tractor length:", "missing"), ("Ripper", "ok")):
        values = found(asked, row(1, "Ripper (raised)", "992 mm", context=(above,)))
        assert values["Ripper Lift Height"][0] == status


def test_a_maker_s_bulldozer_is_a_blade_with_what_moves_it() -> None:
    asked = [wanted("Overall Height", "length", "height", forbidden=("blade",)), wanted("Blade Height", "length")]
    values = found(asked, row(1, "Height", "1343 mm", section="Bulldozer Specifications"))
    assert (values["Overall Height"][0], values["Blade Height"]) == ("missing", ("ok", pytest.approx(1.343)))


def test_columns_are_named_by_bold_names_over_their_sizes(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [
        ("Stick Options", "R3.2", "R2.9"),
        ("", "(10'6\")", "(9'6\")"),
        ("Digging depth", "7170 mm", "6970 mm"),
        ("Reach", "10 600 mm", "10 410 mm"),
    ]
    for number, cells in enumerate(rows):
        y = 700 - 12 * number - 3 * (number > 1)
        if number in (0, 2, 3):
            c.line(60, y + 9, 420, y + 9)
        for x, cell in zip((60, 240, 340), cells, strict=True):
            put(c, x, y, cell, bold=number < 2)
    c.line(60, 660, 420, 660)
    c.save()
    asked = template(wanted("Maximum Digging Depth", "length", "digging depth"))
    for config, depth in (("R3.2", 7.17), ("R2.9", 6.97)):
        one = from_sheets(asked, [read_sheet(tmp_path / "a.pdf")], config=config).values["Maximum Digging Depth"]
        assert (one.status, one.value) == ("ok", pytest.approx(depth))


@pytest.mark.parametrize(("config", "width", "power"), [("STD", 0.56, 131e3), ("LGP", 0.915, 145e3)])
def test_labels_and_headings_name_configurations_at_their_ends(config: str, width: float, power: float) -> None:
    asked = [wanted("Track Gauge", "length"), wanted("Shoe Width", "length"), wanted("Net Power", "power")]
    rows = [
        *(row(1, "Track gauge", text, column=(head,)) for head, text in
          (("STD", "1880 mm"), ("XL", "1880 mm"), ("LGP", "2286 mm"))),
        row(2, "Shoe width – STD/XL", "560 mm"), row(3, "Shoe width – LGP", "915 mm"),
        row(4, "Net power", "131 kW", section="Engine – STD"),
        row(5, "Net power", "145 kW", section="Engine – XL/LGP"),
    ]  # fmt: skip
    values = found(asked, *rows, config=config)
    assert values["Shoe Width"] == ("ok", pytest.approx(width))
    assert values["Net Power"] == ("ok", pytest.approx(power))


def test_what_a_chart_of_loads_holds_for_is_for_review() -> None:
    asked = [wanted("Arm Length", "length", "stick"), wanted("Lift Capacity", "mass")]
    for section, status in (("Mass Boom Lift Capacities", "review"), ("Sticks", "ok")):
        assert found(asked, row(1, "Stick", "2.4 m", section=section))["Arm Length"][0] == status


def test_what_a_sentence_over_it_praises_is_for_review() -> None:
    asked = [wanted("Lift Speed", "speed")]
    praised = "With its lift speed the largest of our trucks saves time at every ramp"
    for section, status in ((praised, "review"), ("A truck of the new series with all its data here", "ok")):
        assert found(asked, row(1, "Lift speed", "470 mm/s", section=section))["Lift Speed"][0] == status


def test_a_label_that_begins_with_its_number_is_no_value_of_a_name_that_has_one() -> None:
    asked = [wanted("Digging Depth 2.44 m Level Bottom", "length", "level bottom")]
    assert found(asked, row(1, "", "2240 mm Level Bottom"))["Digging Depth 2.44 m Level Bottom"][0] == "missing"


def test_of_names_what_a_quantity_in_a_sentence_is() -> None:
    words, x = [], 10.0
    for text in ["With", "its", "long", "stick", "it", "reaches", "8.9", "m", "of", "dig", "depth."]:
        words.append(Word(text, x, x + 4.0 * len(text), 100.0, 8.0))
        x += 4.0 * len(text) + 3.0
    (one,) = read_paragraph(1, lines_of(words), 0, "")
    assert one.text == "8.9 m" and one.label.endswith("dig depth")
    values = found(
        [wanted("Arm Length", "length", "stick"), wanted("Maximum Digging Depth", "length", "dig depth")], one
    )
    assert values["Arm Length"][0] != "ok"


def test_what_a_heading_lacks_its_rows_do_not() -> None:
    asked = [wanted("Counterweight", "mass")]
    values = found(asked, row(1, "Counterweight", "4400 kg", context=("Base machine (without front linkage)",)))
    assert values["Counterweight"] == ("ok", pytest.approx(4400.0))
