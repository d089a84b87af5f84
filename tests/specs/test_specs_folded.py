"""Rows folded in two, cells with rows of their own, legends, headings with units, heads over several sections."""

from __future__ import annotations

from pathlib import Path

from specs_layouts import canvas, lattice, put

from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.reader import read_sheet
from yellowiron.specs.values.enumerations import enumerated


def said(path: Path) -> list[Statement]:
    return list(read_sheet(path).statements)


def facts(path: Path) -> set[tuple[str, str, str]]:
    return {(s.section, s.label, s.text) for s in said(path)}


def test_a_value_under_its_label_is_read_in_its_own_column(tmp_path: Path) -> None:
    columns = {
        "MASSES": [("Operating mass", "17,860 kg"), ("Weight of bucket", "1,550 kg"), ("Ballast", "1,260 kg")],
        "SIZES": [("Machine width", "2,720 mm"), ("Height of cab", "3,430 mm"), ("Reach at 45°", "1,235 mm")],
        "TIMES": [("Raise", "5.8 s"), ("Dump", "1.7 s"), ("Lower", "3.0 s")],
    }
    c = canvas(tmp_path / "sheet.pdf")
    for i, (heading, rows) in enumerate(columns.items()):
        put(c, 36 + 180 * i, 780, heading, size=9, bold=True)
        for j, (label, value) in enumerate([*rows, ("Fill", "29 L")]):
            put(c, 36 + 180 * i, 762 - 20 * j - i, label)
            put(c, 200 + 180 * i, 753 - 20 * j - i, value, right=True)
    c.save()
    expected = {(h, label, value) for h, rows in columns.items() for label, value in [*rows, ("Fill", "29 L")]}
    assert facts(tmp_path / "sheet.pdf") == expected


def test_cells_with_rows_of_their_own_are_read_under_the_words_beside_them(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    cylinders = "Hoist, bore x stroke:\n2 - 130 x 705 mm\nHoist, rod: 80 mm"
    cells = [["Engine", "Bore: 108 mm\nStroke: 130 mm\nTorque at 1,400 rpm: 1,080 N·m"], ["Cylinders", cylinders]]
    lattice(c, 36, 780, [90, 300], cells, heads=0)
    put(c, 340, 768, "Displacement: 7.1 L", size=7)
    c.save()
    assert facts(tmp_path / "sheet.pdf") == {
        ("Engine", "Bore", "108 mm"),
        ("Engine", "Stroke", "130 mm"),
        ("Engine", "Torque at 1,400 rpm", "1,080 N·m"),
        ("Engine", "Displacement", "7.1 L"),
        ("Cylinders", "Hoist, bore x stroke", "2 - 130 x 705 mm"),
        ("Cylinders", "Hoist, rod", "80 mm"),
    }


def test_letters_over_values_stand_for_the_words_of_the_legend_above(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    tables = {
        "Range": ["Reach", "Deepest dig", "Highest cut", "Lowest load"],
        "Sizes": ["Width", "Length", "Height", "Track"],
    }
    expected = set()
    for i, (heading, names) in enumerate(tables.items()):
        y = 780 - 200 * i
        put(c, 36, y, heading, size=12, bold=True)
        for j, (key, name) in enumerate(zip("ABCL", names, strict=True)):
            put(c, 60, y - 20 - 12 * j, key, bold=True)
            put(c, 80, y - 20 - 12 * j, name)
        values = [f"{1000 * i + 100 * j + 2005} mm" for j in range(4)]
        lattice(c, 36, y - 80, [80] * 4, [list("ABCL"), values])
        expected.update(zip(names, values, strict=True))
    c.save()
    assert {(s.label, s.text) for s in said(tmp_path / "sheet.pdf")} == expected


def test_a_unit_at_the_end_of_a_headings_line_holds_for_its_bare_numbers(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    for i, (heading, unit, rows) in enumerate(
        [
            ("Cylinders", "mm (in)", [("Hoist, bore", "125 (4.9)"), ("Hoist, stroke", "636 (25.0)")]),
            ("Times", "s", [("Raise", "5.8"), ("Noise", "73 dB")]),
        ]
    ):
        y = 780 - 100 * i
        put(c, 36, y, heading, size=9, bold=True)
        put(c, 250, y, unit, right=True)
        for j, (label, value) in enumerate(rows):
            put(c, 36, y - 18 - 12 * j, label)
            put(c, 250, y - 18 - 12 * j, value, right=True)
    c.save()
    found = {(s.section, s.label, s.text, s.unit) for s in said(tmp_path / "sheet.pdf")}
    assert ("Cylinders", "Hoist, bore", "125 (4.9)", "mm|in") in found
    assert ("Cylinders", "Hoist, stroke", "636 (25.0)", "mm|in") in found
    assert ("Times", "Raise", "5.8", "s") in found


def test_heads_above_the_first_section_hold_for_the_next_ones(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    put(c, 230, 780, "X 225", bold=True)
    put(c, 330, 780, "X 240", bold=True)
    for i, (heading, label) in enumerate([("Engine", "Bore"), ("Sizes", "Overall width")]):
        put(c, 36, 755 - 60 * i, heading, size=10, bold=True)
        for j in range(2):
            put(c, 36, 738 - 60 * i - 13 * j, f"{label} {'ab'[j]}")
            put(c, 230, 738 - 60 * i - 13 * j, f"{1080 + i} mm")
            put(c, 330, 738 - 60 * i - 13 * j, f"{1380 + i} mm")
    c.save()
    found = said(tmp_path / "sheet.pdf")
    assert len(found) == 8
    assert all(s.column == (("X 225",) if s.text.startswith("10") else ("X 240",)) for s in found)
    assert {s.section for s in found} == {"Engine", "Sizes"}


def test_a_factor_of_a_product_may_be_called_length_of_stroke() -> None:
    assert enumerated("Dump cylinder, dia. x length of stroke", 2) == [
        "Dump cylinder bore",
        "Dump cylinder length of stroke",
    ]
    assert enumerated("Vérin de bras, diamètre de piston x longueur de course", 2) == [
        "Vérin de bras diamètre de piston",
        "Vérin de bras longueur de course",
    ]
    assert enumerated("Bore x stroke of lift cylinder", 2) == ["Bore of lift cylinder", "stroke of lift cylinder"]


def test_a_line_that_ends_between_a_number_and_its_unit_is_read_on(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    long = "Gross weight: 41,300 kg / 91,050 lb Payload: 24 metric tons / 26 short tons Engine Power: 331"
    width = put(c, 60, 780, long)
    put(c, 60 + width / 2 - 21, 766, "kW / 444 hp")
    c.save()
    assert facts(tmp_path / "sheet.pdf") == {
        ("", "Gross weight", "41,300 kg / 91,050 lb"),
        ("", "Payload", "24 metric tons / 26 short tons"),
        ("", "Engine Power", "331 kW / 444 hp"),
    }
