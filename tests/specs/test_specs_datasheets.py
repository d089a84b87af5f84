"""What makers' data sheets of one page do: outlines that count their rows, names said once, pairs in both systems."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import pytest
from specs_layouts import canvas, lattice, put

from yellowiron.library import load_template
from yellowiron.model.specification import Specification
from yellowiron.specs import extract
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import Statement, counting, is_unit, looks_like_value
from yellowiron.specs.values.claims import claims_of, spelled_out
from yellowiron.specs.values.enumerations import alternatives, enumerated, opposed
from yellowiron.specs.values.matching import match_one

WIDTHS = (90, 24, 120, 40, 80, 80)


def said(path: Path, type_name: str = "forklift", config: str = "") -> dict[str, Specification]:
    return {s.name: s for s in extract(load_template(type_name, sheet_only=True), [path], config=config)}


def table(path: Path, rows: Sequence[tuple[str, ...]], widths: tuple[int, ...] = WIDTHS) -> Path:
    c = canvas(path)
    lattice(c, 40, 780, widths, rows, heads=0)
    c.save()
    return path


def settled(found: dict[str, Specification], *names: str) -> dict[str, tuple[str, float | None]]:
    return {name: (found[name].status, found[name].value) for name in names}


ROWS = (
    ("Model", "1", "", "", "QF 30", "QF 35"),
    ("Power Type", "2", "", "", "Electric", "Electric"),
    ("Load Center", "3", "", "mm", "500", "600"),
    ("Max. Fork Height", "4", "with std 2-stage mast", "mm", "3,000", "3,000"),
    ("Freelift", "5", "with std 2-stage mast", "mm", "80", "90"),
    ("Travel Speed", "6", "loaded / unloaded", "kph", "15 / 15.5", "16 / 16.5"),
    ("Fork Dimensions", "7", "T x W x L", "mm", "45 x 122 x 1,070", "50 x 125 x 1,170"),
)


def test_numbers_that_count_the_rows_are_no_values_wherever_they_stand(tmp_path: Path) -> None:
    found = said(table(tmp_path / "a.pdf", ROWS), config="QF 35")
    names = ("Load Center", "Lift Height", "Free Lift Height", "Travel Speed Laden", "Travel Speed Unladen")
    assert settled(found, *names) == {
        "Load Center": ("ok", 0.6),
        "Lift Height": ("ok", 3.0),
        "Free Lift Height": ("ok", 0.09),
        "Travel Speed Laden": ("ok", pytest.approx(16 / 3.6)),
        "Travel Speed Unladen": ("ok", pytest.approx(16.5 / 3.6)),
    }
    assert found["Lift Height"].candidates[0].configuration == "QF 35"  # "Electric", in both, heads neither


def test_a_product_goes_by_the_letters_of_its_label(tmp_path: Path) -> None:
    found = said(table(tmp_path / "a.pdf", ROWS), config="QF 30")
    assert settled(found, "Fork Thickness", "Fork Width", "Fork Length") == {
        "Fork Thickness": ("ok", 0.045), "Fork Width": ("ok", 0.122), "Fork Length": ("ok", 1.07),
    }  # fmt: skip
    assert found["Overall Length"].status == "missing"
    assert enumerated("Forks L x T x W", 3) == ["Forks length", "Forks thickness", "Forks width"]
    assert enumerated("Thickness & width", 2) == ["Thickness", "width"]


def test_outlines_count_one_by_one() -> None:
    assert counting(["7", "8", "9"])
    assert not counting(["7", "9", "10"])
    assert not counting(["1.1", "1.2"])


def test_a_name_holds_for_the_rows_under_it_that_leave_it_out(tmp_path: Path) -> None:
    rows = (
        ("Forks", "Thickness & width", "in (mm)", "1.6 x 4 (40x100)"),
        ("", "Length", "in (mm)", "42 (1070)"),
        ("Overall Dimensions", "Length (to face of forks)", "in (mm)", "102.8 (2610)"),
        ("", "Width - standard carriage", "in (mm)", "42.3 (1075)"),
        ("Drawbar Pull Max", "Full load", "lb (kg)", "5845 (2651)"),
        ("", "Empty", "lb (kg)", "2220 (1006)"),
        ("Wheelbase", "", "in (mm)", "65 (1650)"),
        ("Rated Output", "SAE gross", "hp (kW) @ rpm", "63 (47) @ 2400"),
    )
    found = said(table(tmp_path / "a.pdf", rows, (120, 150, 80, 90)))
    names = ("Fork Length", "Length to Fork Face", "Fork Carriage Width", "Drawbar Pull", "Wheelbase")
    assert settled(found, *names) == {
        "Fork Length": ("ok", 1.07),
        "Length to Fork Face": ("ok", 2.61),
        "Fork Carriage Width": ("ok", 1.075),
        "Drawbar Pull": ("ok", pytest.approx(2651 * 9.80665)),
        "Wheelbase": ("ok", 1.65),
    }
    assert found["Rated Capacity"].status == "missing"  # what is pulled is no load


def test_where_groups_are_drawn_over_their_rows_a_row_without_one_has_none(tmp_path: Path) -> None:
    rows: tuple[tuple[str | None, ...], ...] = (
        ("Swing system", "Swing speed", "<", "rpm", "11.5"),
        ("", "Travel speed", "High", "km/h", "5.1"),
        (None, None, "Low", "km/h", "2.8"),
        (None, "Maximum drawbar pull", "<", "kN", "267"),
    )
    c = canvas(tmp_path / "a.pdf")
    lattice(c, 40, 780, (60, 100, 60, 60, 80), rows, heads=0)
    c.save()
    found = said(tmp_path / "a.pdf", "excavator")
    assert settled(found, "Swing Speed", "Maximum Travel Speed", "Travel Speed Low", "Drawbar Pull") == {
        "Swing Speed": ("ok", pytest.approx(11.5 * math.pi / 30)),
        "Maximum Travel Speed": ("ok", pytest.approx(5.1 / 3.6)),
        "Travel Speed Low": ("ok", pytest.approx(2.8 / 3.6)),
        "Drawbar Pull": ("ok", pytest.approx(267e3)),
    }  # the group over the last three rows has no words that can be read


def test_pairs_in_both_systems() -> None:
    assert spelled_out("37.8/38.4 (960/975)", "in|mm") == ("37.8 (960 mm) / 38.4 (975 mm)", "in")
    assert spelled_out("1.5 x 4 (40x100)", "in|mm") == ("1.5 (40 mm) x 4 (100 mm)", "in")
    assert is_unit("hp (kW) @ rpm") == "hp|kW"
    one = Statement(1, 1, "Tread front/rear", "37.8/38.4 (960/975)", (0, 0, 1, 1), "", unit="in|mm")
    claims = claims_of([one], "point")
    assert [(c.words, c.quantity.value, c.partner and c.partner.value) for c in claims] == [
        ("Tread front", 37.8, 960.0), ("Tread rear", 38.4, 975.0),
    ]  # fmt: skip


def test_one_number_may_be_two_opposites(tmp_path: Path) -> None:
    assert opposed("Lowering - full/empty") == ["Lowering - loaded", "Lowering - empty"]
    assert opposed("Make/type") == []
    assert alternatives("Lift - full/empty", 2) == ["Lift - loaded", "Lift - empty"]
    c = canvas(tmp_path / "a.pdf")
    put(c, 60, 700, "Lowering speed, full/empty")
    put(c, 260, 700, "500 mm/s")
    c.save()
    found = said(tmp_path / "a.pdf")
    assert settled(found, "Lowering Speed Laden", "Lowering Speed Unladen") == {
        "Lowering Speed Laden": ("ok", 0.5), "Lowering Speed Unladen": ("ok", 0.5),
    }  # fmt: skip


def test_a_chart_does_not_dispute_the_row_whose_value_it_has(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    below = lattice(c, 40, 780, (150, 100), [("Rated load capacity", "1,800 kg"), ("Wheelbase", "1,650 mm")], heads=0)
    loads = ("1,800", "1,750", "1,650", "1,300", "900")
    chart = [(f"VM{300 + 50 * i}", f"{load} kg") for i, load in enumerate(loads)]
    lattice(c, 40, below - 40, (150, 100), [("Mast", "Rated capacity"), *chart])
    c.save()
    assert settled(said(tmp_path / "a.pdf"), "Rated Capacity") == {"Rated Capacity": ("ok", 1800.0)}


def test_words_of_further_languages_are_not_left_over(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 700, "Maximum boom length Max. Auslegerlänge Lunghezza massima braccio")
    put(c, 480, 700, "38.3 m")
    c.save()
    found = said(tmp_path / "a.pdf", "mobile_crane")
    assert settled(found, "Boom Length Extended") == {"Boom Length Extended": ("ok", 38.3)}


def test_a_plus_is_no_word_between_two_values(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 700, "Boom luffing angle range (min. / max.)")
    put(c, 300, 700, "-4° / +78°")
    c.save()
    found = said(tmp_path / "a.pdf", "mobile_crane")
    assert settled(found, "Boom Angle Minimum", "Boom Angle Maximum") == {
        "Boom Angle Minimum": ("ok", pytest.approx(math.radians(-4))),
        "Boom Angle Maximum": ("ok", pytest.approx(math.radians(78))),
    }


def test_signs_of_both_ways_begin_a_value_and_degrees_are_words_in_capitals() -> None:
    assert looks_like_value("+/- 10.5 Grados")
    assert [(q.unit, q.sign) for r in read("+/- 10.5 Grados") for q in r.numbers] == [("Grados", "±")]


@pytest.mark.parametrize(("words", "settled_so"), [("of the hydraulic cylinder,", True), ("of the jib,", False)])
def test_what_opens_a_sentence_tells_only_of_what_has_such_a_value(words: str, settled_so: bool) -> None:
    crane = {w.name: w for w in load_template("mobile_crane", sheet_only=True).wanted}
    label = f"By means {words} provides boom elevation from"
    one = Statement(1, 1, label, "-3° to 80°", (0, 0, 1, 1), "", section="Boom", running=True)
    matches = [match_one(crane["Boom Angle Maximum"], c, list(crane.values())) for c in claims_of([one], "point")]
    assert any(m is not None and not m.rest for m in matches) == settled_so


def test_an_expression_that_opens_with_an_abbreviation_needs_it() -> None:
    assert "auxiliary" in tokens("Aux. double acting flow")
    assert "auxiliary" not in tokens("One double acting cylinder")
