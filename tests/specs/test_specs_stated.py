"""A sheet that says which configuration its figures are for settles its own columns; one that does not, does not."""

from __future__ import annotations

from pathlib import Path

import pytest
from reportlab.lib.pagesizes import A4
from reportlab.pdfgen import canvas

from yellowiron.model.template import Template, Wanted
from yellowiron.specs import extract
from yellowiron.specs.values.stated_configuration import stated_in

pytestmark = pytest.mark.usefixtures("read_here")

TEMPLATE = Template(
    "loader", "", "", (), (),
    wanted=(Wanted("Hinge Pin Height", "length", synonyms={"en": ("hinge pin height",)}),),
)  # fmt: skip


def sheet(path: Path, sentence: str) -> Path:
    page = canvas.Canvas(str(path), pagesize=A4, invariant=1)
    page.setFont("Helvetica", 10)
    page.drawString(60, 780, sentence)
    page.line(60, 745, 520, 745)
    for x, text in ((60, "Dimensions"), (300, "Standard boom"), (430, "High-lift boom")):
        page.drawString(x, 730, text)
    page.line(60, 722, 520, 722)
    for x, text in ((60, "Hinge pin height"), (300, "4,370 mm"), (430, "4,870 mm")):
        page.drawString(x, 708, text)
    page.line(60, 700, 520, 700)
    for x, text in ((60, "Wheelbase"), (300, "3,450 mm"), (430, "3,450 mm")):
        page.drawString(x, 688, text)
    page.line(60, 680, 520, 680)
    page.save()
    return path


@pytest.mark.parametrize(
    ("sentence", "config", "status", "value"),
    [
        ("All dimensions are for a machine with standard boom and 26.5R25 tyres.", "", "ok", 4.370),
        ("Values given are with the high-lift boom unless noted.", "", "ok", 4.870),
        ("All dimensions are for a machine with standard boom.", "high-lift boom", "ok", 4.870),
        ("Specifications are subject to change without notice.", "", "conflict", None),
        ("The standard boom suits most buckets.", "", "conflict", None),
        ("", "", "conflict", None),
    ],
)
def test_the_sheet_s_own_word_decides(
    sentence: str, config: str, status: str, value: float | None, tmp_path: Path
) -> None:
    found = extract(TEMPLATE, [sheet(tmp_path / "sheet.pdf", sentence)], config=config).values["Hinge Pin Height"]
    assert found.status == status
    assert found.value == (pytest.approx(value) if value else None)
    if status == "ok" and not config:
        assert f"page 1 says: “{sentence.removeprefix('All ')}”" in found.reason


@pytest.mark.parametrize(
    "sentence",
    [
        "Die Angaben gelten für den Standardausleger mit Schaufel 4,2 m³.",
        "Les valeurs correspondent au bras standard.",
        "Los valores corresponden al brazo estándar.",
        "Figures are for the 4.2 m³ bucket.",
    ],
)
def test_such_sentences_are_known_in_several_languages(sentence: str) -> None:
    (found,) = stated_in(f"WHEEL LOADER 25,510 kg {sentence} Printed here.", 3)
    assert sentence.rstrip(".").endswith(found.sentence.rstrip("."))
    assert found.page == 3
