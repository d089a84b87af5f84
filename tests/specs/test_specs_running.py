"""Values in running text; tables that touch, name their models again, or whose rows are parted by fills."""

from __future__ import annotations

from pathlib import Path

import pytest
from reportlab.lib.colors import HexColor
from specs_layouts import canvas, lattice, put

from yellowiron.library import load_template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.language.numbers import read
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.reader import Sheet, read_sheet
from yellowiron.specs.values.claims import claims_of

CRANE = load_template("mobile_crane", sheet_only=True)
LOADER = load_template("wheel_loader")
_LEFT = (
    ("Boom", "10.9 m - 33.5 m four section full power\nboom. Greasing lines are fitted for the pads\nof all "
             "sections and are part of each crane."),
    ("Boom Elevation", "One double acting lift device with holding\nvalves serves it, by hand or by pedal. The boom\n"
                       "elevation is –3° to +78°."),
    ("Rated Loads", "For loads below 20 tons the crane may stand\non wheels. For boom lengths between 38.1 m and\n"
                    "fully extended use the radii of the chart."),
)  # fmt: skip
_RIGHT = (
    ("Swing", "Planetary swing with a foot applied disc brake,\nand a lock operated from the cab that holds\nthe "
              "house. Maximum speed: 2.0 r.p.m."),
    ("Hoist", "Planetary reduction with automatic brake and\ngrooved drum. Maximum line pull: 5860 kg. The\nmaximum "
              "line speed is 154 m/min."),
    ("Engine", "Diesel, turbo-charged and after cooled, of 10.8\nlitres, 298 kW (gross). It is equipped with an\n"
               "engine brake and a distress system."),
)  # fmt: skip


def _columns(path: Path, *, more: str = "") -> None:
    """Two columns of running text under headings; `more` goes on in the last paragraph."""
    c = canvas(path)
    put(c, 40, 800, "Specifications", size=16, bold=True)
    for x, parts in ((40, _LEFT), (250, _RIGHT)):
        y = 770.0
        for heading, text in parts:
            put(c, x, y, heading, size=11, bold=True)
            for line in text.split("\n") + (more.split("\n") if more and heading == "Engine" else []):
                y -= 10
                put(c, x, y, line)
            y -= 26
    c.save()


def _read(path: Path) -> dict[str, tuple[str, float | None]]:
    return {s.name: (s.status, s.value) for s in from_sheets(CRANE, [read_sheet(path)]) if s.status != "missing"}


def test_columns_of_running_text(tmp_path: Path) -> None:
    _columns(tmp_path / "sheet.pdf")
    found = _read(tmp_path / "sheet.pdf")
    assert {n for n, (status, _) in found.items() if status == "ok"} >= {
        "Boom Length Extended", "Boom Length Retracted", "Slewing Speed",
        "Main Winch Line Speed", "Main Winch Line Pull",
    }  # fmt: skip
    values = {name: value for name, (_, value) in found.items()}
    assert values["Boom Length Retracted"] == pytest.approx(10.9) and values["Boom Length Extended"] == pytest.approx(
        33.5
    )
    assert values["Slewing Speed"] == pytest.approx(2.0 * 2 * 3.14159265 / 60)
    assert values["Main Winch Line Pull"] == pytest.approx(5860 * 9.80665)  # a pull in kg is the weight of that mass
    assert values["Boom Angle Maximum"] == pytest.approx(1.361, abs=1e-3)
    assert values["Boom Angle Minimum"] == pytest.approx(-0.05236, abs=1e-4)
    assert "Maximum Lifting Capacity" not in found  # "below 20 tons" is a circumstance


def test_a_sentence_outdoes_no_table(tmp_path: Path) -> None:
    _columns(
        tmp_path / "sheet.pdf", more="Its top speed of 104 km/h, or maximum travel\nspeed 104 km/h, holds for the road."
    )
    row = Statement(
        1, 1, "Maximum speed with trailer", "85 km/h", (10.0, 0.0, 90.0, 9.0), "Maximum speed with trailer 85 km/h"
    )
    one = read_sheet(tmp_path / "sheet.pdf")
    alone = from_sheets(CRANE, [one]).values["Maximum Travel Speed"]
    both = from_sheets(CRANE, [one, Sheet("b.pdf", 1, (row,), (), "point")]).values["Maximum Travel Speed"]
    assert (alone.status, alone.value) == ("ok", pytest.approx(104 / 3.6))
    assert both.status == "conflict" and len(both.candidates) == 2


def test_numbers_of_running_text() -> None:
    assert [(r.kind, [q.value for q in r.numbers]) for r in read("–3° to +78°")] == [("range", [-3.0, 78.0])]
    assert [r.numbers[0].dimension for r in read("513 f.p.m. at 1.7 r.p.m. and 100 p.s.i.")] == [
        "speed", "angular_speed", "pressure",
    ]  # fmt: skip


def test_a_pull_in_kilograms_is_a_force_and_still_a_mass() -> None:
    row = Statement(1, 1, "Maximum line pull", "12,920 lb. (5860 kg)", (0.0, 0.0, 9.0, 9.0), "")
    assert sorted(c.quantity.dimension for c in claims_of([row], "point")) == ["force", "mass"]
    plain = Statement(1, 1, "Operating weight", "5860 kg", (0.0, 0.0, 9.0, 9.0), "")
    assert [c.quantity.dimension for c in claims_of([plain], "point")] == ["mass"]


_TIMES = (("Raise time", "s", "4.4", "5.9"), ("Lower time", "s", "2.7", "3.4"))


def _status(path: Path, config: str) -> dict[str, tuple[str, float | None]]:
    found = from_sheets(LOADER, [read_sheet(path)], config=config)
    return {s.name: (s.status, s.value) for s in found if s.status != "missing"}


def test_models_again_inside_a_table_and_a_table_at_its_corner(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    rows = [("Hydraulics", "<", "<", "<"), ("", "", "426", "436"), ("Pump type", "", "Twin piston pumps", "<"),
            ("Cycle times at full revs", "", "Seconds", "<"), ("", "", "426", "436"), *_TIMES]  # fmt: skip
    end = lattice(c, 300, 780, (110, 20, 50, 50), rows, heads=0)
    lattice(c, 70, end + 16, (110, 20, 50, 50), [("Speeds", "<", "<", "<"), ("", "", "426", "436"),
            ("Maximum speed", "km/h", "37.9", "38.4"), ("Reverse", "km/h", "20.1", "21.2")], heads=0)  # fmt: skip
    c.save()
    found = _status(tmp_path / "sheet.pdf", "436 ZX")  # the head "436" is a part of it, "426" is not
    assert found["Raise Time"] == ("ok", pytest.approx(5.9)) and found["Lower Time"] == ("ok", pytest.approx(3.4))
    assert found["Maximum Travel Speed"] == ("ok", pytest.approx(38.4 / 3.6))


def test_fills_part_rows_and_rules_columns(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    rows = [("", "", "427ZX", "437ZX"), ("Overall length", "mm", "7010", "7306"),
            ("Overall width", "mm", "2490", "2490"), ("Wheelbase", "mm", "3000", "3200"),
            ("Ground clearance", "mm", "430", "450"), *_TIMES]  # fmt: skip
    xs, y = (60.0, 200.0, 240.0, 310.0, 380.0), 760.0
    for index, row in enumerate(rows):
        if index % 2 == 0:
            c.setFillColor(HexColor("#d8d8d8"))
            c.rect(xs[0], y - 4, xs[-1] - xs[0], 14, stroke=0, fill=1)
        for x, right, text in zip(xs, xs[1:], row, strict=False):
            put(c, x + 3 if x == xs[0] else (x + right) / 2 - 8, y, text)
        y -= 14
    c.setStrokeColor(HexColor("#ffffff"))
    for x in xs:
        c.line(x, 774, x, y + 10)
    c.save()
    found = _status(tmp_path / "sheet.pdf", "437ZX")
    assert found["Overall Length"] == ("ok", pytest.approx(7.306)) and found["Wheelbase"] == ("ok", pytest.approx(3.2))
    assert found["Raise Time"] == ("ok", pytest.approx(5.9))
