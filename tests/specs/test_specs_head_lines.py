"""Heads of columns in several bold lines, labels that go on behind a drawing's key, and numbers of a drawing that are
no counts, as a maker's excavator and dozer brochures print them; the numbers are our own."""

from __future__ import annotations

from pathlib import Path

import pytest
from reportlab.pdfgen.canvas import Canvas
from specs_layouts import canvas, put, template, wanted

from yellowiron.model.specification import Specifications
from yellowiron.specs import extract

pytestmark = pytest.mark.usefixtures("read_here")

STOPS = (220.0, 290.0, 360.0, 430.0)
ASKED = template(
    wanted("Maximum Digging Depth", "length", "maximum digging depth"),
    wanted("Maximum Reach", "length", "maximum reach at ground level"),
    wanted("Level Bottom Depth", "length", "maximum depth cut for level bottom"),
    wanted("Arm Digging Force", "force", "stick digging force", forbidden=("bucket",)),
)


def row(c: Canvas, y: float, label: str, cells: tuple[str, ...], *, bold: bool = False, x: float = 40) -> None:
    put(c, x, y, label, bold=bold)
    for stop, cell in zip(STOPS, cells, strict=True):
        put(c, stop, y, cell, bold=bold)


def line(c: Canvas, y: float) -> None:
    c.setLineWidth(0.4)
    c.line(36, y, 500, y)


def said(found: Specifications) -> dict[str, tuple[str, float | None]]:
    return {
        name: (one.status, None if one.value is None else round(one.value, 3))
        for name, one in found.values.items()
        if one.status != "missing"
    }


def test_heads_in_several_bold_lines_between_two_rules(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    line(c, 720)
    row(c, 708, "Stick options", ("R3.9", "R3.2", "R3.9", "M2.5"), bold=True)
    row(c, 698, "", ("(12'10\")", "(10'6\")", "(12'10\")", "(8'2\")"), bold=True)
    line(c, 692)
    row(c, 682, "Bucket options", ("GP 1.2 m3",) * 4, bold=True)
    row(c, 672, "", ("(1.6 yd3)",) * 4, bold=True)
    for n, words in enumerate(("with pin", "grabber", "coupler")):
        row(c, 662 - 10 * n, "", ("", "", words, words), bold=True)
    line(c, 637)
    for n, (label, cells) in enumerate((
        ("Maximum digging depth", ("8185 mm", "7485 mm", "8461 mm", "6633 mm")),
        ("Maximum reach at ground level", ("11 714 mm", "11 007 mm", "12 005 mm", "10 242 mm")),
    )):  # fmt: skip
        row(c, 627 - 14 * n, label, cells)
        line(c, 623 - 14 * n)
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="M2.5")) == {
        "Maximum Digging Depth": ("ok", 6.633), "Maximum Reach": ("ok", 10.242)
    }  # fmt: skip
    both = extract(ASKED, [tmp_path / "a.pdf"], config="R3.9")
    assert said(both)["Maximum Digging Depth"][0] == "conflict", "one with the coupler, one without"


def test_a_label_goes_on_behind_the_key_of_its_drawing(tmp_path: Path) -> None:
    """Rows under a head each for sticks and buckets: the second names no part that its rows are of."""
    c = canvas(tmp_path / "a.pdf")
    row(c, 708, "Stick", ("R4.6 m", "R4.1 m", "R3.6 m", "M3.0 m"), bold=True)
    row(c, 696, "Bucket", ("GD", "GD", "GD", "SD"), bold=True)
    row(c, 682, "1 Maximum digging depth", ("9660 mm", "9140 mm", "8590 mm", "7650 mm"))
    row(c, 668, "5 Maximum depth cut for", ("9550 mm", "9020 mm", "8460 mm", "7510 mm"))
    put(c, 40 + c.stringWidth("5 ", "Helvetica", 8), 658, "2240 mm level bottom")
    row(c, 644, "6 Maximum reach at ground level", ("14 230 mm", "13 690 mm", "13 170 mm", "11 850 mm"))
    row(c, 630, "Stick digging force", ("234 kN", "254 kN", "279 kN", "305 kN"))
    c.save()
    assert said(extract(ASKED, [tmp_path / "a.pdf"], config="M3.0 m")) == {
        "Maximum Digging Depth": ("ok", 7.65), "Maximum Reach": ("ok", 11.85),
        "Level Bottom Depth": ("ok", 7.51), "Arm Digging Force": ("ok", 305000.0),
    }  # fmt: skip


def test_a_label_broken_in_two_has_its_values_in_both_systems(tmp_path: Path) -> None:
    """The last row of a ruled table has no rule under it: its second line was a row called "digging depth"."""
    c = canvas(tmp_path / "a.pdf")
    row(c, 708, "Stick", ("R3.9DB", "R3.2DB", "R2.9DB", "M2.5DB"), bold=True)
    line(c, 704)
    row(c, 694, "Maximum digging depth", ("8185 mm", "7485 mm", "7200 mm", "6633 mm"))
    line(c, 690)
    row(c, 680, "Maximum vertical wall", ("7152 mm", "6131 mm", "5747 mm", "4421 mm"))
    row(c, 668, "digging depth", ("(23'6\")", "(20'1\")", "(18'10\")", "(14'6\")"))
    c.save()
    asked = template(
        wanted("Maximum Digging Depth", "length", "maximum digging depth", "digging depth"),
        wanted("Vertical Wall Depth", "length", "maximum vertical wall digging depth"),
    )
    assert said(extract(asked, [tmp_path / "a.pdf"], config="M2.5DB")) == {
        "Maximum Digging Depth": ("ok", 6.633), "Vertical Wall Depth": ("ok", 4.421)
    }  # fmt: skip


def test_the_number_of_a_drawing_before_a_name_is_no_measure_of_it(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 40, 708, "Dimensions", size=11, bold=True)
    put(c, 40, 690, "2 Width of tractor")
    c.save()
    asked = template(wanted("Width over Tracks", "length", "width of tractor", minimum=1.0, maximum=6.0))
    assert said(extract(asked, [tmp_path / "a.pdf"])) == {}
