"""Sheets of telehandlers and rollers in makers' words: rows of a table, each settled as what it says."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from specs_layouts import canvas, lattice

from yellowiron.library import load_template
from yellowiron.specs import extract

DEG = math.pi / 180.0
TELEHANDLER = {
    "en": [
        ("Maximum lift capacity", "4,000 kg", "Maximum Lift Capacity", 4000.0),
        ("Maximum lift height", "17.0 m", "Maximum Lift Height", 17.0),
        ("Maximum forward reach", "12.8 m", "Maximum Forward Reach", 12.8),
        ("Capacity at maximum height", "3,000 kg", "Capacity at Maximum Height", 3000.0),
        ("Capacity at maximum reach", "600 kg", "Capacity at Maximum Reach", 600.0),
        ("Frame leveling", "10°", "Frame Levelling Angle", 10 * DEG),
        ("Carriage rotation", "132°", "Carriage Rotation", 132 * DEG),
        ("Boom extend time", "15.5 s", "Boom Extend Time", 15.5),
        ("Boom lower time", "9.2 s", "Boom Lower Time", 9.2),
        ("Wheelbase", "3,070 mm", "Wheelbase", 3.07),
        ("Overall width", "2,440 mm", "Overall Width", 2.44),
    ],
    "de": [
        ("Hubhöhe max.", "7,0 m", "Maximum Lift Height", 7.0),
        ("Reichweite", "3,7 m", "Maximum Forward Reach", 3.7),
        ("Tragfähigkeit bei maximaler Hubhöhe", "2500 kg", "Capacity at Maximum Height", 2500.0),
        ("Radstand", "2870 mm", "Wheelbase", 2.87),
    ],
    "fr": [
        ("Hauteur de levage maximale", "9,0 m", "Maximum Lift Height", 9.0),
        ("Correcteur de dévers", "8°", "Frame Levelling Angle", 8 * DEG),
        ("Portée maximale", "6,1 m", "Maximum Forward Reach", 6.1),
    ],
}
ROLLER = {
    "en": [
        ("Drum width", "2,134 mm", "Drum Width", 2.134),
        ("Drum diameter", "1,534 mm", "Drum Diameter", 1.534),
        ("Drum shell thickness", "30 mm", "Drum Shell Thickness", 0.03),
        ("Inside turning radius", "3.68 m", "Inner Turning Radius", 3.68),
        ("Outside turning radius", "5.81 m", "Turning Radius", 5.81),
        ("Curb clearance", "543 mm", "Curb Clearance", 0.543),
        ("Articulation angle", "34°", "Articulation Angle", 34 * DEG),
        ("Oscillation angle", "15°", "Oscillation Angle", 15 * DEG),
        ("Centrifugal force maximum", "282 kN", "Centrifugal Force High", 282e3),
        ("High amplitude", "1.8 mm", "Nominal Amplitude High", 0.0018),
        ("Weight at drum", "6,700 kg", "Weight at Drum", 6700.0),
    ],
    "de": [
        ("Bandagenbreite", "1680 mm", "Drum Width", 1.68),
        ("Bandagendurchmesser", "1200 mm", "Drum Diameter", 1.2),
        ("Wenderadius innen", "4520 mm", "Inner Turning Radius", 4.52),
        ("Pendelwinkel +/-", "8°", "Oscillation Angle", 8 * DEG),
        ("Bordsteinfreiheit", "700 mm", "Curb Clearance", 0.7),
    ],
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "language"), [("telehandler", k) for k in TELEHANDLER] + [("roller", k) for k in ROLLER]
)
def test_every_row_is_settled_as_what_it_says(name: str, language: str, tmp_path: Path) -> None:
    rows = (TELEHANDLER if name == "telehandler" else ROLLER)[language]
    c = canvas(tmp_path / "a.pdf")
    lattice(c, 40, 780, (280, 160), [(label, value) for label, value, _, _ in rows], heads=0)
    c.save()
    found = {s.name: s for s in extract(load_template(name, sheet_only=True), [tmp_path / "a.pdf"])}
    got = {wanted: (found[wanted].status, found[wanted].value) for *_, wanted, _ in rows}
    assert got == {wanted: ("ok", pytest.approx(value)) for *_, wanted, value in rows}
    assert {s.name for s in found.values() if s.status != "missing"} == {wanted for *_, wanted, _ in rows}
