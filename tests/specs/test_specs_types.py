"""Every type whose machines have published figures: a plain sheet of each, read by the type's own words.

The sheets are typeset from the fact files beside the checkout; without them these tests skip."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path

import pytest
from specs_layouts import canvas, put

from yellowiron.library import load_template
from yellowiron.model.specification import Specification
from yellowiron.specs import extract

FACTS = Path(__file__).parents[3] / "shared" / "data" / "facts"
TYPE = {
    "articulated truck": "articulated_dump_truck", "backhoe loader": "backhoe_loader", "dozer": "dozer",
    "excavator": "excavator", "forklift": "forklift", "motor grader": "grader",
    "off-highway truck": "rigid_dump_truck",
    "skid steer": "skid_steer", "track-type tractor": "dozer", "wheel loader": "wheel_loader",
}  # fmt: skip
SI = {
    "mm": 1e-3, "m": 1.0, "in": 0.0254, "ft": 0.3048, "kg": 1.0, "t": 1000.0, "lb": 0.45359237, "ton": 907.18474,
    "deg": 0.017453292519943295, "kW": 1e3, "hp": 745.6998715822702, "MPa": 1e6, "kPa": 1e3, "bar": 1e5,
    "psi": 6894.757293168361, "L/min": 1e-3 / 60, "gal/min": 6.30901964e-5, "km/h": 1 / 3.6, "mph": 0.44704, "kN": 1e3,
    "kgf": 9.80665, "m3": 1.0, "yd3": 0.764554857984, "s": 1.0, "count": 1.0,
}  # fmt: skip
PRINTED = {"m3": "m³", "yd3": "yd³", "deg": "°", "count": ""}
MACHINES: Mapping[str, Mapping[str, str]] = {
    "cat-773f": {
        "Overall body length (dual)": "Body Length Overall", "Inside body length (dual)": "Body Length Inside",
        "Overall length (dual)": "Overall Length", "Wheelbase": "Wheelbase", "Rear axle to tail": "Rear Overhang",
        "Ground clearance": "Ground Clearance", "Dump clearance": "Dump Clearance",
        "Loading height empty": "Loading Height", "Inside body depth max": "Body Depth Inside",
        "Overall height body raised": "Body Raised Height", "Operating width": "Operating Width",
        "Engine guard clearance": "Engine Guard Clearance", "Overall canopy width": "Canopy Width",
        "Outside body width": "Body Width Outside", "Inside body width": "Body Width Inside",
        "Front canopy height": "Front Canopy Height", "Rear axle clearance": "Rear Axle Clearance",
        "Centerline front tire width": "Front Tread", "Centerline rear dual tire width": "Rear Tread",
        "Overall tire width": "Overall Width", "Height to Top of ROPS (dual slope)": "Overall Height",
    },
    "cat-740gc": {
        "Gross power SAE J1995": "Gross Power", "Net power SAE J1349": "Net Power", "Rated payload": "Rated Payload",
        "Heaped SAE 2:1": "Body Capacity Heaped", "Struck": "Body Capacity Struck",
        "Tailgate heaped": "Body Capacity Heaped with Tailgate",
        "Tailgate struck": "Body Capacity Struck with Tailgate",
    },
    "cat-d6": {
        "Net power ISO 9249/SAE J1349": "Net Power", "Operating weight": "Operating Weight",
        "Shipping weight": "Shipping Weight", "Ground pressure": "Ground Pressure",
        "Sections per side": "Track Shoes Each Side", "Bottom rollers per side": "Track Rollers Each Side",
        "Track gauge": "Track Gauge", "Max shoe width": "Shoe Width", "Width over tracks": "Width over Tracks",
        "Width over trunnions": "Width over Trunnions", "Track on ground length": "Track Length on Ground",
        "Track pitch": "Track Pitch", "Grouser height": "Grouser Height", "Ground clearance": "Ground Clearance",
        "Machine height": "Overall Height", "Length without blade": "Length Without Blade",
        "Blade width over end bits": "Blade Width", "Blade height": "Blade Height", "Dig depth": "Blade Digging Depth",
        "Blade lift height": "Blade Lift Height", "Max tilt at blade corner": "Maximum Blade Tilt",
        "Max tilt angle": "Blade Tilt Angle", "Length with blade straight": "Length with Blade",
        "Blade weight": "Blade Weight", "Blade capacity 6SU": "Blade Capacity",
        "Pitch adjustment +/-": "Blade Pitch Adjustment",
        "Oscillation at front idler": "Oscillation at Front Idler",
    },
    "cat-140": {
        "Moldboard width": "Moldboard Length", "Moldboard height": "Moldboard Height",
        "Moldboard thickness": "Moldboard Thickness", "Moldboard arc radius": "Moldboard Arc Radius",
        "Throat clearance": "Throat Clearance", "Circle rotation": "Circle Rotation",
        "Steering range L/R": "Steering Angle", "Articulation L/R": "Articulation Angle",
        "Wheel lean L/R": "Wheel Lean Angle", "Front axle total oscillation": "Front Axle Oscillation",
        "Height to top of cab": "Overall Height", "Front axle center height": "Front Axle Height",
        "Height to top of cylinders": "Height to Top of Cylinders", "Tandem axle spacing": "Tandem Axle Spacing",
        "Front axle to articulation hitch": "Front Axle to Articulation", "Front axle to rear axle": "Wheelbase",
        "Rear axle to articulation hitch": "Rear Axle to Articulation",
        "Rear tire centerline width": "Tire Centerline Width", "Outside rear tires width": "Overall Width",
        "Overall length push plate to ripper": "Overall Length", "Ground clearance at rear axle": "Ground Clearance",
        "Operating weight typically equipped": "Operating Weight", "Ripping depth": "Ripper Penetration",
    },
    "jcb-3cx": {
        "Cab roof height": "Cab Height", "Stabiliser feet clearance": "Stabilizer Feet Clearance",
        "Rear frame width": "Rear Frame Width",
        "Total travel length": "Overall Length", "Axle centreline distance": "Wheelbase",
        "Slew centre to rear axle centre": "Swing Pivot to Rear Axle", "Kingpost clearance": "Kingpost Clearance",
        "Travel height": "Overall Height", "Shovel width": "Loader Bucket Width",
        "SAE dig depth": "Maximum Digging Depth", "Reach @ ground level": "Maximum Reach at Ground Line",
        "Loading height": "Backhoe Loading Height", "Bucket breakout": "Bucket Digging Force",
        "Dipper breakout": "Dipper Digging Force", "Loader dump height": "Loader Dump Height",
        "Loader breakout": "Loader Breakout Force", "Engine power": "Engine Power", "Pump flow": "Main Pump Flow",
        "Relief pressure": "Main Relief Pressure", "Max speed": "Maximum Travel Speed", "Width": "Overall Width",
        "Operating weight": "Operating Weight",
    },
    "bobcat-s76-2": {
        "Length with standard bucket": "Length with Bucket", "Length without attachment": "Length Without Attachment",
        "Width": "Overall Width", "Bucket width": "Bucket Width", "Height": "Overall Height",
        "Height to bucket hinge pin": "Hinge Pin Height at Maximum Lift", "Reach at maximum height": "Dumping Reach",
        "Turning radius": "Turning Radius with Bucket", "Wheelbase": "Wheelbase",
        "Operating weight": "Operating Weight",
    },
    "mitsubishi-fd70n": {
        "Main relief pressure": "Main Relief Pressure", "Control flow rate": "Main Pump Flow",
        "Simplex mast lift cylinder inner diameter": "Lift Cylinder Bore",
        "Triplex first lift cylinder inner diameter": "Free Lift Cylinder Bore",
        "Triplex second lift cylinder inner diameter": "Second Lift Cylinder Bore",
        "Tilt cylinder inner diameter": "Tilt Cylinder Bore", "Tilt cylinder stroke": "Tilt Cylinder Stroke",
    },
}  # fmt: skip
"""Machine → label of its fact file → wanted name. What a fact file prints beside these is asked for by nobody."""
OPEN = {
    # Labels that say of which body they speak ("(dual)") are to be looked at.
    "cat-773f": {"Overall Length", "Overall Height", "Body Length Inside", "Body Length Overall"},
    # Two standards' gross power, both printed.
    "cat-740gc": {"Gross Power"},
}
"""Values on the sheet that come back as anything but `ok`, by machine. First reading: 106 of 113 `ok`, none wrong."""

pytestmark = [
    pytest.mark.usefixtures("read_here"),
    pytest.mark.skipif(not FACTS.is_dir(), reason="no fact files beside the checkout"),
]


@pytest.mark.parametrize("machine", MACHINES)
def test_a_plain_sheet(machine: str, tmp_path: Path) -> None:
    document = json.loads((FACTS / f"{machine}.json").read_text(encoding="utf-8"))
    facts = {f["name"]: f for f in document["facts"] if isinstance(f["value"], (int, float)) and f["unit"] in SI}
    sheet = tmp_path / f"{machine}.pdf"
    c = canvas(sheet)
    put(c, 36, 806, "Specifications", size=12, bold=True)
    for index, (label, fact) in enumerate(facts.items()):
        x, y = 36 + 270 * (index // 52), 786 - 14 * (index % 52)
        put(c, x, y, label)
        value = f"{fact['value']} {PRINTED.get(fact['unit'], fact['unit'])}".strip()
        put(c, x + 175, y, value)
    c.save()
    found = extract(load_template(TYPE[document["type"]], sheet_only=True), [sheet])
    expected = {wanted: facts[label] for label, wanted in MACHINES[machine].items()}
    wrong, other, invented = [], [], []
    for one in found:
        if one.name in expected:
            fact = expected[one.name]
            if one.status != "ok":
                other.append((one.name, one.status, one.reason))
            elif one.value != pytest.approx(fact["value"] * SI[fact["unit"]], rel=1e-6):
                wrong.append((one.name, one.value, fact))
            else:
                assert_stands_there(one)
        elif one.status == "ok":
            invented.append((one.name, one.text, one.evidence.quote if one.evidence else ""))
    assert not wrong and not invented, (wrong, invented)
    assert {name for name, _, _ in other} == OPEN.get(machine, set()), other


def assert_stands_there(one: Specification) -> None:
    assert one.evidence is not None and one.evidence.page == 1 and one.evidence.box is not None
    assert re.search(r"\d", one.evidence.quote)
