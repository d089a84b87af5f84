"""The example's sheet: every value it prints, read back; the distractors never win; every quote stands on its page."""

from __future__ import annotations

import importlib
import math
import re
import statistics
import time
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import pytest

from yellowiron.library import load_template
from yellowiron.model.specification import Specifications, fold
from yellowiron.model.template import Template
from yellowiron.specs import draw_evidence, extract
from yellowiron.specs.extraction import from_sheets, read
from yellowiron.specs.reader import Sheet

CONFIG = "standard boom, stock-pile bucket with bolt-on edge"
NAMES = {
    "Lift Cylinder Bore": "LIFT_BORE",
    "Lift Cylinder Stroke": "LIFT_STROKE",
    "Lift Cylinder Rod Diameter": "LIFT_ROD",
    "Tilt Cylinder Bore": "TILT_BORE",
    "Tilt Cylinder Stroke": "TILT_STROKE",
    "Tilt Cylinder Rod Diameter": "TILT_ROD",
    "Steering Cylinder Bore": "STEER_BORE",
    "Steering Cylinder Stroke": "STEER_STROKE",
    "Steering Cylinder Rod Diameter": "STEER_ROD",
    "Steering Angle": "STEER_ANGLE_NOMINAL",
    "Maximum Steering Angle": "STEER_ANGLE",
    "Rear Axle Oscillation": "OSCILLATION_TOTAL",
    "Wheelbase": "WHEELBASE",
    "Tread": "TREAD",
    "Hinge Pin Height at Maximum Lift": "HINGE_HEIGHT_MAX",
    "Hinge Pin Height at Carry": "HINGE_HEIGHT_CARRY",
    "Ground Clearance": "GROUND_CLEARANCE",
    "Hitch Height": "HITCH_HEIGHT",
    "Height to Top of Stack": "STACK_HEIGHT",
    "Overall Height": "CAB_HEIGHT",
    "Dumping Clearance": "DUMP_CLEARANCE",
    "Dumping Reach": "DUMP_REACH",
    "Digging Depth": "DIG_DEPTH",
    "Overall Operating Height": "OPERATING_HEIGHT",
    "Overall Length": "OVERALL_LENGTH",
    "Overall Width": "WIDTH_OVER_TYRES",
    "Bucket Width": "BUCKET_WIDTH",
    "Bucket Weight": "BUCKET_WEIGHT",
    "Bucket Capacity Heaped": "BUCKET_CAPACITY_HEAPED",
    "Bucket Capacity Struck": "BUCKET_CAPACITY_STRUCK",
    "Operating Weight": "OPERATING_WEIGHT",
    "Static Tipping Load Straight": "TIPPING_LOAD_STRAIGHT",
    "Static Tipping Load Full Turn": "TIPPING_LOAD_FULL_TURN",
    "Rack Back at Ground": "RACK_BACK_GROUND",
    "Rack Back at Maximum Lift": "RACK_BACK_MAX",
    "Dump Angle at Maximum Lift": "DUMP_ANGLE_MAX",
    "Main Relief Pressure": "WORK_PRESSURE",
    "Steering Relief Pressure": "STEER_PRESSURE",
    "Main Pump Flow": "WORK_PUMP_FLOW",
    "Steering Pump Flow": "STEER_PUMP_FLOW",
    "Raise Time": "TIME_RAISE",
    "Dump Time": "TIME_DUMP",
    "Lower Time": "TIME_LOWER",
    "Maximum Travel Speed": "TRAVEL_SPEED_MAX",
    "Rear Overhang": "REAR_OVERHANG",
    "Tyre Diameter": "TYRE_DIAMETER",
    "Tyre Width": "TYRE_WIDTH",
}
"""What the template asks for → the example's value. `FREE`: asked for too, and printed by the sheet alone."""
FREE = {"Total Cycle Time", "Breakout Force", "Turning Radius", "Net Power", "Gross Power"}
SI = {
    "mm": 1e-3,
    "deg": math.pi / 180,
    "kg": 1.0,
    "MPa": 1e6,
    "L/min": 1e-3 / 60,
    "s": 1.0,
    "m3": 1.0,
    "km/h": 1 / 3.6,
}


@pytest.fixture(scope="module")
def wheel_loader() -> Template:
    return load_template("wheel_loader")


@pytest.fixture(scope="module")
def sheet(request: pytest.FixtureRequest) -> Path:
    return request.config.rootpath / "examples" / "wheel_loader" / "specifications.pdf"


@pytest.fixture(scope="module")
def printed() -> ModuleType:
    """The example's values.py."""
    return importlib.import_module("wheel_loader.values")


@pytest.fixture(scope="module")
def once(sheet: Path) -> Sheet:
    """The sheet, read once."""
    return read(sheet)


@pytest.fixture(scope="module")
def found(wheel_loader: Template, sheet: Path) -> Specifications:
    return extract(wheel_loader, [sheet], config=CONFIG)


def test_every_value_is_right(found: Specifications, printed: ModuleType) -> None:
    for name, constant in NAMES.items():
        value = getattr(printed, constant)
        specification = found.get(name)
        assert specification is not None and specification.status == "ok", name
        assert specification.value == pytest.approx(value.value * SI[value.unit], rel=1e-12), name
        assert specification.example is not value.published, name


def test_nothing_else_is_ok(found: Specifications) -> None:
    known = {fold(n) for n in (*NAMES, *FREE)}
    assert {s.name for s in found if s.status == "ok" and fold(s.name) not in known} == set()
    assert {s.status for s in found if fold(s.name) not in known} == {"missing"}
    for specification in found:
        if specification.status == "missing":
            assert specification.value is None and f'--set "{specification.name}=' in specification.hint


def test_without_a_configuration_what_differs_is_a_conflict(
    wheel_loader: Template, once: Sheet, printed: ModuleType
) -> None:
    # without the sentence in which the sheet itself says what its figures are for
    undecided = from_sheets(wheel_loader, [replace(once, stated=())])
    conflicts = {s.name for s in undecided if s.status == "conflict"}
    assert {"Hinge Pin Height at Maximum Lift", "Hinge Pin Height at Carry", "Operating Weight"} <= conflicts
    assert {"Dumping Clearance", "Dumping Reach", "Bucket Weight", "Overall Length"} <= conflicts
    for specification in undecided:
        if specification.status == "conflict":
            assert specification.value is None
            assert len({c.value for c in specification.candidates}) == len(specification.candidates) >= 2
            assert "--config" in specification.hint
        elif specification.status == "ok" and specification.name in NAMES:
            value = getattr(printed, NAMES[specification.name])
            assert specification.value == pytest.approx(value.value * SI[value.unit], rel=1e-12)


def test_the_sheets_own_word_chooses_like_a_person(wheel_loader: Template, once: Sheet, found: Specifications) -> None:
    alone = from_sheets(wheel_loader, [once])
    assert {s.name: (s.status, s.value) for s in alone} == {s.name: (s.status, s.value) for s in found}


@pytest.mark.parametrize(
    "config", ["standard boom; 4.2 m3", "Standard Boom, Stock pile Bolt-on edge", "4.2 m³ bucket, standard boom"]
)
def test_a_configuration_can_be_said_in_several_ways(wheel_loader: Template, once: Sheet, config: str) -> None:
    chosen = from_sheets(wheel_loader, [once], config=config)
    assert chosen.number("Operating Weight") == 25510.0
    assert chosen.number("Hinge Pin Height at Maximum Lift") == 4.37


def test_another_configuration_gives_its_own_values(wheel_loader: Template, once: Sheet) -> None:
    chosen = from_sheets(wheel_loader, [once], config="high-lift boom, light material")
    assert chosen.number("Hinge Pin Height at Maximum Lift") == 4.87
    assert chosen.number("Operating Weight") == 25860.0
    weight = chosen.get("Operating Weight")
    assert weight is not None and weight.example


@pytest.mark.parametrize("config", ["High-lift boom; Teeth", "high lift; teeth"])
def test_a_head_that_says_the_phrase_and_no_more_is_meant(wheel_loader: Template, once: Sheet, config: str) -> None:
    chosen = from_sheets(wheel_loader, [once], config=config)
    assert [s.name for s in chosen if s.status == "conflict"] == [] and chosen.findings == ()
    assert (chosen.number("Hinge Pin Height at Maximum Lift"), chosen.number("Operating Weight")) == (4.87, 25450.0)
    more = from_sheets(wheel_loader, [once], config="high lift; teeth and segments")
    assert more.number("Operating Weight") == 25585.0


def test_a_phrase_that_no_sheet_says_is_told(wheel_loader: Template, once: Sheet, found: Specifications) -> None:
    chosen = from_sheets(wheel_loader, [once], config="nonsense column; standard boom, 4.2 m3")
    assert chosen.values == found.values
    (finding,) = chosen.findings
    assert (finding.code, finding.severity) == ("SPC002", "warning")
    assert "'nonsense column'" in finding.message and "High-lift boom" in finding.hint


def test_quotes_stand_on_their_pages(found: Specifications, sheet: Path) -> None:
    import pdfplumber  # an independent reader

    with pdfplumber.open(sheet) as pdf:
        pages = [re.sub(r"[\s.]+", "", page.extract_text()) for page in pdf.pages]
    for specification in found:
        if specification.status != "ok":
            continue
        evidence = specification.evidence
        assert evidence is not None and evidence.file == sheet.name and evidence.box is not None
        for piece in evidence.quote.split(" … "):
            assert re.sub(r"[\s.]+", "", piece) in pages[evidence.page - 1], (specification.name, piece)
        digits = re.search(r"[\d,.]*\d", specification.text)
        assert digits is not None and digits.group(0) in evidence.quote


def test_twice_the_same(found: Specifications, wheel_loader: Template, sheet: Path) -> None:
    assert extract(wheel_loader, [sheet], config=CONFIG) == found


def test_the_sheet_is_what_its_script_writes(sheet: Path, tmp_path: Path) -> None:
    script = importlib.import_module("wheel_loader.sheet")
    script.write(tmp_path / "specifications.pdf")
    assert (tmp_path / "specifications.pdf").read_bytes() == sheet.read_bytes()


def test_evidence_can_be_seen(found: Specifications, sheet: Path, tmp_path: Path) -> None:
    from PIL import Image

    written = draw_evidence([sheet], found, tmp_path / "seen")
    assert [p.name for p in written] == [f"specifications-page-{n}.png" for n in (2, 3, 4)]
    for path in written:
        with Image.open(path) as picture:
            assert picture.width > 900 and len(picture.getcolors(maxcolors=1 << 20) or ()) > 50


def test_a_page_takes_little_time(sheet: Path) -> None:
    import pypdfium2

    from yellowiron.specs.layout.router import statements_of
    from yellowiron.specs.pages.words import read_page

    document = pypdfium2.PdfDocument(sheet)
    times = []
    for number in [1, *range(1, len(document) + 1)]:  # the first only warms up
        start = time.process_time()
        statements_of(read_page(document[number - 1], number))
        times.append(time.process_time() - start)
    document.close()
    assert statistics.median(times[1:]) < 0.3  # 0.1 s on a quiet core
