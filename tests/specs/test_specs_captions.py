"""What makers' and dealers' PDFs print in ways of their own: captions in several languages over their values, a chart
of loads in a sentence, sizes in one product, a word that holds for all models. Drawn in each test."""

from __future__ import annotations

from pathlib import Path

import pypdfium2
import pytest
from specs_layouts import canvas, lattice, put, template, wanted

from yellowiron.library import load_template
from yellowiron.specs import extract
from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.captions import captioned
from yellowiron.specs.layout.statement import unit_in_label
from yellowiron.specs.pages.words import Page, read_page
from yellowiron.specs.values.enumerations import enumerated

pytestmark = pytest.mark.usefixtures("read_here")

_TOP = 780.0
_PRESSURE = ("Pressione di esercizio", "Working pressure", "Pression de travail", "Betriebsdruck", "Presión de trabajo")
_REACH = ("Sbraccio verticale", "Maximum vertical reach", "Portée verticale maximale", "Alcance máximo vertical")
_FLOW = ("Portata olio", "Oil flow", "Débit d'huile", "Ölmenge", "Caudal de aceite")


def _stack(path: Path, captions: list[tuple[tuple[str, ...], str, list[list[str]]]], heads: list[str]) -> Path:
    """Columns of captions; under each a filled bar with heads, if there are any, and rows of values."""
    c = canvas(path)
    put(c, 40, _TOP, "Loader crane", size=14, bold=True)
    for k, (lines, unit, rows) in enumerate(captions):
        x, y = 40 + 170 * k, _TOP - 40
        for line in (*lines, unit):
            put(c, x, y, line, size=6)
            y -= 7
        if heads:
            c.setFillGray(0.75)
            c.rect(x - 2, y - 4, 140, 9, stroke=0, fill=1)
            for i, head in enumerate(heads):
                put(c, x + 35 * i, y - 2, head, size=7, bold=True)
            y -= 14
        for row in rows:
            for i, cell in enumerate(row):
                put(c, x + 35 * i, y, cell, size=7)
            y -= 10
    c.save()
    return path


def _page(path: Path) -> Page:
    return read_page(pypdfium2.PdfDocument(path)[0], 1)


def test_captions_in_several_languages_name_the_rows_under_them(tmp_path: Path) -> None:
    path = _stack(
        tmp_path / "a.pdf",
        [(_REACH, "(m)", [["9,2", "12,1", "15,6"]]), (_PRESSURE, "(bar)", [["265"]]), (_FLOW, "(l/min)", [["45"]])],
        ["1S", "2S", "3S"],
    )
    found, taken = captioned(_page(path), 0)
    told = [(s.label.split()[-1], s.text, s.unit, s.column) for s in found]
    assert told[:3] == [
        ("vertical", t, "m", (h,)) for t, h in zip(("9,2", "12,1", "15,6"), ("1S", "2S", "3S"), strict=True)
    ]
    assert told[3:] == [("trabajo", "265", "bar", ()), ("aceite", "45", "l/min", ())]  # one alone holds for all
    assert {w.text for w in taken} >= {"265", "(bar)", "Betriebsdruck", "3S"} and "crane" not in {w.text for w in taken}


@pytest.mark.parametrize(("config", "tip"), [("1S", 9.2), ("3S", 15.6)])
def test_the_heads_in_the_bar_are_configurations(config: str, tip: float, tmp_path: Path) -> None:
    path = _stack(
        tmp_path / "a.pdf",
        [(_REACH, "(m)", [["9,2", "12,1", "15,6"]]), (_PRESSURE, "(bar)", [["265"]]), (_FLOW, "(l/min)", [["45"]])],
        ["1S", "2S", "3S"],
    )
    values = {s.name: s for s in extract(load_template("mobile_crane", sheet_only=True), [path], config=config)}
    assert (values["Maximum Tip Height"].status, values["Maximum Tip Height"].value) == ("ok", tip)
    assert (values["Main Relief Pressure"].status, values["Main Relief Pressure"].value) == ("ok", 265e5)
    evidence = values["Main Relief Pressure"].evidence
    assert evidence is not None and (evidence.page, "Working pressure" in evidence.quote) == (1, True)


def test_rows_under_a_caption_may_be_models(tmp_path: Path) -> None:
    path = _stack(tmp_path / "a.pdf", [(_PRESSURE, "(bar)", [["804 T", "265"], ["806 T", "290"]])], [])
    found, _ = captioned(_page(path), 0)
    assert [(s.text, s.context or s.variant) for s in found] == [("265", ("804 T",)), ("290", ("806 T",))]


def test_a_short_label_over_its_unit_is_no_caption(tmp_path: Path) -> None:
    path = _stack(tmp_path / "a.pdf", [(_PRESSURE[:2], "(bar)", [["265"]])], [])
    assert captioned(_page(path), 0) == ([], frozenset())


def test_labels_with_their_values_beside_them_are_no_caption(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = (("Front axle oscillation", "17"), ("Steering angle", "52"), ("Turning radius between kerbs", "4,165"))
    for i, (label, value) in enumerate(rows):
        put(c, 40, _TOP - 8 * i, label, size=7)
        put(c, 260, _TOP - 8 * i, value, size=7)
    put(c, 40, _TOP - 24, "(mm)", size=7)
    put(c, 40, _TOP - 40, "2,265", size=7)
    c.save()
    assert captioned(_page(tmp_path / "a.pdf"), 0) == ([], frozenset())


def test_a_load_at_a_radius_in_a_sentence(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, _TOP, "Grúa articulada", size=14, bold=True)
    put(c, 40, _TOP - 30, "• Capacidad de carga: 5.100 kg a 2,50 m y 1.180 kg a 10,16 m")
    put(c, 40, _TOP - 44, "• Presión de trabajo: 265 bar")
    c.save()
    values = {s.name: s for s in extract(load_template("mobile_crane", sheet_only=True), [tmp_path / "a.pdf"])}
    found = {n: (values[n].status, values[n].value) for n in ("Maximum Lifting Capacity", "Main Relief Pressure")}
    assert found == {"Maximum Lifting Capacity": ("ok", 5100.0), "Main Relief Pressure": ("ok", 265e5)}
    rated = {s.value for s in values.values() if s.status != "missing"}
    assert 10.16 not in rated and 1180.0 not in rated


def test_a_range_of_lengths_is_no_load_at_a_radius() -> None:
    load = read("5.100 kg a 2,50 m", style="comma")
    assert [(r.numbers[0].si_value, r.condition) for r in load] == [(5100.0, False), (2.5, True)]
    assert not any(r.condition for r in read("2,50 m a 10,16 m", style="comma"))


def test_sizes_in_one_product(tmp_path: Path) -> None:
    assert unit_in_label("Overall dimensions (LxWxH(mm))")[1] == "mm"
    assert enumerated("Overall size (without fork) LxWxH", 3) == [
        "Overall size (without fork) length", "Overall size width", "Overall size height",
    ]  # fmt: skip
    c = canvas(tmp_path / "a.pdf")
    lattice(c, 40, _TOP, (200, 150), [["Item", "Value"], ["Overall size LxWxH(mm)", "2505x1200x2250"]])
    c.save()
    asked = template(
        wanted("Overall Width", "length", "overall width"), wanted("Overall Height", "length", "overall height")
    )
    found = {s.name: (s.status, s.value) for s in extract(asked, [tmp_path / "a.pdf"])}
    assert found == {"Overall Width": ("ok", 1.2), "Overall Height": ("ok", 2.25)}


def test_a_word_that_spans_all_models_heads_none_of_them(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    rows = [
        ["Model", "TR14", "TR16", "TR20"],
        ["Power type", "Battery", "<", "<"],
        ["Rated capacity (kg)", "1400", "1600", "2000"],
        ["Overall width (mm)", "1270", "1280", "1290"],
    ]
    lattice(c, 40, _TOP, (160, 80, 80, 80), rows)
    c.save()
    asked = template(
        wanted("Load Capacity", "mass", "rated capacity", forbidden=("battery",)),
        wanted("Overall Width", "length", "overall width"),
    )
    found = {s.name: (s.status, s.value) for s in extract(asked, [tmp_path / "a.pdf"], config="TR16")}
    assert found == {"Load Capacity": ("ok", 1600.0), "Overall Width": ("ok", 1.28)}
