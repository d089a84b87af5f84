"""The example excavator's sheet: a matrix of booms and arms, letters that mean two things, rows that are
configurations; every value is read back, and what the sheet does not print is missing."""

from __future__ import annotations

import importlib
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest

from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.specs import extract
from yellowiron.specs.extraction import from_sheets, read

NAMES = {
    "Boom Cylinder Stroke": "BOOM_STROKE",
    "Boom Cylinder Bore": "BOOM_BORE",
    "Boom Cylinder Rod Diameter": "BOOM_ROD",
    "Arm Cylinder Stroke": "ARM_STROKE",
    "Arm Cylinder Bore": "ARM_BORE",
    "Arm Cylinder Rod Diameter": "ARM_ROD",
    "Bucket Cylinder Stroke": "BUCKET_STROKE",
    "Bucket Cylinder Bore": "BUCKET_BORE",
    "Bucket Cylinder Rod Diameter": "BUCKET_ROD",
    "Main Relief Pressure": "MAIN_PRESSURE",
    "Main Pump Flow": "PUMP_FLOW",
    "Swing Speed": "SWING_SPEED",
    "Swing Torque": "SWING_TORQUE",
    "Maximum Travel Speed": "TRAVEL_SPEED_HIGH",
    "Travel Speed Low": "TRAVEL_SPEED_LOW",
    "Drawbar Pull": "DRAWBAR_PULL",
    "Operating Weight": "OPERATING_WEIGHT",
    "Counterweight": "COUNTERWEIGHT",
    "Bucket Weight": "BUCKET_WEIGHT",
    "Bucket Capacity": "BUCKET_CAPACITY",
    "Bucket Width": "BUCKET_WIDTH",
    "Boom Length": "BOOM_LENGTH",
    "Arm Length": "ARM_LENGTH",
    "Maximum Digging Depth": "DIGGING_DEPTH",
    "Maximum Digging Depth 2.44 m Level Bottom": "LEVEL_DEPTH",
    "Maximum Vertical Wall Digging Depth": "WALL_DEPTH",
    "Maximum Digging Height": "DIGGING_HEIGHT",
    "Maximum Dumping Height": "DUMPING_HEIGHT",
    "Minimum Dumping Height": "DUMPING_HEIGHT_MIN",
    "Maximum Reach": "MAX_REACH",
    "Maximum Reach at Ground Line": "GROUND_REACH",
    "Minimum Swing Radius": "SWING_RADIUS_MIN",
    "Tail Swing Radius": "TAIL_RADIUS",
    "Overall Length": "OVERALL_LENGTH",
    "Overall Width": "OVERALL_WIDTH",
    "Overall Height": "BOOM_HEIGHT",
    "Cab Height": "CAB_HEIGHT",
    "Height to Handrail": "HANDRAIL_HEIGHT",
    "Upperstructure Width": "UPPER_WIDTH",
    "Track Length": "TRACK_LENGTH",
    "Track Length on Ground": "TRACK_ON_GROUND",
    "Track Gauge": "TRACK_GAUGE",
    "Shoe Width": "SHOE_WIDTH",
    "Track Height": "TRACK_HEIGHT",
    "Ground Clearance": "GROUND_CLEARANCE",
    "Counterweight Clearance": "COUNTERWEIGHT_CLEARANCE",
    "Bucket Digging Force": "BUCKET_FORCE",
    "Arm Digging Force": "ARM_FORCE",
    "Track Shoes Each Side": "SHOES",
    "Track Rollers Each Side": "TRACK_ROLLERS",
    "Carrier Rollers Each Side": "CARRIER_ROLLERS",
    "Net Power": "NET_POWER",
    "Swing Relief Pressure": "SWING_PRESSURE",
    "Travel Relief Pressure": "TRAVEL_PRESSURE",
}
"""What the template asks for → the example's value."""
SI = {
    "mm": 1e-3,
    "kg": 1.0,
    "m3": 1.0,
    "MPa": 1e6,
    "L/min": 1e-3 / 60.0,
    "rpm": 0.10471975511965977,
    "kNm": 1e3,
    "km/h": 1.0 / 3.6,
    "kN": 1e3,
    "kW": 1e3,
    "count": 1.0,
}


@pytest.fixture(scope="module")
def excavator() -> Template:
    return load_template("excavator")


@pytest.fixture(scope="module")
def sheet(root: Path) -> Path:
    return root / "examples" / "excavator" / "specifications.pdf"


@pytest.fixture(scope="module")
def printed() -> ModuleType:
    """The example's values.py."""
    return importlib.import_module("excavator.values")


@pytest.fixture(scope="module")
def found(excavator: Template, sheet: Path) -> Specifications:
    return extract(excavator, [sheet])


def test_every_value_is_right_and_says_whose_it_is(found: Specifications, printed: ModuleType) -> None:
    for name, constant in NAMES.items():
        value, specification = getattr(printed, constant), found.get(name)
        assert specification is not None and specification.status == "ok", name
        assert specification.value == pytest.approx(value.value * SI[value.unit], rel=1e-12), name
        assert specification.example is not value.published, name


def test_what_the_sheet_does_not_print_is_missing(found: Specifications) -> None:
    others = {s.name: s.status for s in found if s.name not in (*NAMES, "Level Bottom Length", "Ground Pressure")}
    assert set(others.values()) == {"missing"}
    assert "Boom Cylinder Closed Length" in others


def test_the_length_of_the_level_cut_is_read_from_its_label(found: Specifications, printed: ModuleType) -> None:
    length = found.get("Level Bottom Length")
    assert length is not None and length.value == pytest.approx(printed.LEVEL_LENGTH * 1e-3)
    assert "2440 mm" in length.evidence.quote


def test_without_the_sheets_own_word_what_differs_is_a_conflict(excavator: Template, sheet: Path) -> None:
    undecided = from_sheets(excavator, [replace(read(sheet), stated=())])
    conflicts = {s.name for s in undecided if s.status == "conflict"}
    assert {"Maximum Digging Depth", "Overall Length", "Operating Weight", "Bucket Width"} <= conflicts
    assert not {"Overall Width", "Boom Cylinder Stroke", "Drawbar Pull"} & conflicts


def test_another_boom_arm_bucket_and_shoe_can_be_chosen(excavator: Template, sheet: Path) -> None:
    chosen = extract(excavator, [sheet], config="5850 mm two-piece, 2410 mm arm, 1.02 m3, 600 mm shoes")
    got = {
        name: chosen.number(name)
        for name in ("Maximum Digging Depth", "Overall Length", "Bucket Width", "Operating Weight", "Track Gauge")
    }
    assert got == pytest.approx(
        {
            "Maximum Digging Depth": 5.98,
            "Overall Length": 9.75,
            "Bucket Width": 1.067,
            "Operating Weight": 23313.0,
            "Track Gauge": 2.38,
        }
    )
    assert chosen.findings == ()


def test_quotes_stand_on_their_pages(found: Specifications, sheet: Path) -> None:
    pages = {}
    for specification in found:
        evidence = specification.evidence
        if evidence is None or specification.status != "ok":
            continue
        text = pages.setdefault(evidence.page, _page_text(sheet, evidence.page))
        for part in evidence.quote.split(" … "):
            assert "".join(part.split()) in text, specification.name


def _page_text(sheet: Path, number: int) -> str:
    import pypdfium2

    page = pypdfium2.PdfDocument(str(sheet))[number - 1]
    return "".join(page.get_textpage().get_text_bounded().split())


def test_the_sheet_is_drawn_the_same_again(sheet: Path, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "excavator.sheet_excavator", str(tmp_path)]
    subprocess.run(command, cwd=sheet.parent.parent, check=True)
    assert (tmp_path / "specifications.pdf").read_bytes() == sheet.read_bytes()
