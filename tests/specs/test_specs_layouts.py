"""Extraction from the layouts that makers use, with the numbers of other machines."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from specs_layouts import (
    bar,
    borderless,
    canvas,
    lattice,
    leaders,
    put,
    ruled,
    template,
    wanted,
)

from yellowiron.model.specification import Specifications
from yellowiron.specs import extract

pytestmark = pytest.mark.usefixtures("read_here")

EXCAVATOR = template(
    wanted("Boom Cylinder Bore", "length"),
    wanted("Boom Cylinder Stroke", "length"),
    wanted("Boom Cylinder Rod Diameter", "length", "boom cylinder rod"),
    wanted("Arm Cylinder Bore", "length", "stick cylinder bore"),
    wanted("Arm Cylinder Stroke", "length", "stick cylinder stroke"),
    wanted("Arm Cylinder Rod Diameter", "length", "arm cylinder rod"),
    wanted("Bucket Cylinder Bore", "length"),
    wanted("Bucket Cylinder Stroke", "length"),
    wanted("Bucket Cylinder Rod Diameter", "length", "bucket cylinder rod"),
    wanted("Main Relief Pressure", "pressure", "maximum pressure equipment", forbidden=("travel", "swing", "pilot")),
    wanted("Main Pump Flow", "flow", "main implement system maximum flow", forbidden=("pilot",)),
    wanted("Operating Weight", "mass", minimum=1000.0, maximum=1e6),
    wanted("Boom Length", "length", minimum=1.0, maximum=20.0),
    wanted("Arm Length", "length", "stick length", minimum=0.5, maximum=15.0),
    wanted("Overall Length", "length"),
    wanted("Maximum Digging Height", "length", "maximum cutting height", "max digging height"),
    wanted("Maximum Digging Depth", "length", "max digging depth"),
    wanted("Maximum Reach at Ground Level", "length", "max reach at ground", "maximum reach at ground line"),
    wanted("Maximum Reach", "length"),
    wanted("Maximum Travel Speed", "speed"),
    wanted("Ground Clearance", "length"),
)


def values(specifications: Specifications) -> dict[str, float]:
    """Name → value of what is ok, rounded to nine digits."""
    return {s.name: round(s.value, 9) for s in specifications if s.status == "ok" and s.value is not None}


def statuses(specifications: Specifications, *names: str) -> list[str]:
    found = []
    for name in names:
        specification = specifications.get(name)
        assert specification is not None
        found.append(specification.status)
    return found


# Caterpillar 328D LCR, brochure page 14 (auto.manualsonline.com/manuals/mfg/cat/328d_lcr.html?p=14)
def cat_328d(path: Path) -> None:
    c = canvas(path)
    put(c, 36, 800, "Hydraulic Excavator Specifications", size=14, bold=True)
    bar(c, 36, 770, "Engine", 250)
    y = borderless(
        c,
        36,
        752,
        (180, 240),
        [
            ("Net Flywheel Power", "152 kW", "204 hp"),
            ("Bore", "110 mm", "4.3 in"),
            ("Stroke", "127 mm", "5 in"),
            ("Displacement", "7.2 L", "440 in³"),
        ],
    )
    bar(c, 36, y - 10, "Drive", 250)
    borderless(
        c,
        36,
        y - 28,
        (180, 240),
        [("Maximum Drawbar Pull", "300 kN", "67,443 lbf"), ("Maximum Travel Speed", "4.2 km/h", "2.6 mph")],
    )
    bar(c, 306, 770, "Hydraulic System", 250)
    borderless(
        c,
        306,
        752,
        (450, 510),
        [
            ("Main Implement System –\nMaximum Flow (2x)", "235 L/min", "62 gal/min"),
            ("Max. pressure – Equipment", "35 000 kPa", "5,076 psi"),
            ("Max. pressure – Travel", "35 000 kPa", "5,076 psi"),
            ("Max. pressure – Swing", "27 500 kPa", "3,989 psi"),
            ("Pilot System – Maximum flow", "32.4 L/min", "8.6 gal/min"),
            ("Pilot System – Maximum\npressure", "3900 kPa", "566 psi"),
            ("Boom Cylinder – Bore", "140 mm", "5.5 in"),
            ("Boom Cylinder – Stroke", "1407 mm", "55.4 in"),
            ("Stick Cylinder – Bore", "150 mm", "5.9 in"),
            ("Stick Cylinder – Stroke", "1646 mm", "64.8 in"),
            ("CB2 Family Bucket Cylinder –\nBore", "135 mm", "5.3 in"),
            ("CB2 Family Bucket Cylinder –\nStroke", "1156 mm", "46 in"),
            ("DB Family Bucket Cylinder –\nBore", "150 mm", "5.9 in"),
            ("DB Family Bucket Cylinder –\nStroke", "1156 mm", "46 in"),
        ],
    )
    c.save()


def test_borderless_columns_with_wrapped_labels(tmp_path: Path) -> None:
    cat_328d(tmp_path / "sheet.pdf")
    found = extract(EXCAVATOR, [tmp_path / "sheet.pdf"])
    assert values(found) == {
        "Boom Cylinder Bore": 0.14,
        "Boom Cylinder Stroke": 1.407,
        "Arm Cylinder Bore": 0.15,
        "Arm Cylinder Stroke": 1.646,
        "Bucket Cylinder Stroke": 1.156,
        "Main Relief Pressure": 35e6,
        "Maximum Travel Speed": round(4.2 / 3.6, 9),
    }
    flow = found.get("Main Pump Flow")  # "(2x)": both pumps together give twice as much
    assert flow is not None and (flow.status, flow.value) == ("review", pytest.approx(470e-3 / 60))
    assert "counts 2 of them" in flow.reason
    bore = found.get("Bucket Cylinder Bore")
    assert bore is not None and bore.status == "conflict" and bore.value is None
    assert sorted(c.value for c in bore.candidates) == [0.135, 0.15]
    assert values(extract(EXCAVATOR, [tmp_path / "sheet.pdf"], config="DB family"))["Bucket Cylinder Bore"] == 0.15


# John Deere 470 P-Tier, ME470PAU (EXO-Robotics/exo-equipment-atlas, john-deere-470-p-tier)
def deere_470(path: Path) -> None:
    c = canvas(path)
    put(c, 36, 800, "470 class excavator", size=14, bold=True)
    put(c, 36, 775, "Cylinders", size=10, bold=True)
    ruled(
        c,
        36,
        758,
        (250, 330, 410),
        [
            ("", "Bore", "Rod Diameter", "Stroke"),
            ("Boom (2)", "170 mm (6.7 in)", "115 mm (4.5 in)", "1590 mm (62.6 in)"),
            ("Arm (1)", "190 mm (7.5 in)", "130 mm (5.1 in)", "1940 mm (76.4 in)"),
            ("Bucket (1)", "170 mm (6.7 in)", "120 mm (4.7 in)", "1325 mm (52.2 in)"),
        ],
        heads=1,
    )
    put(c, 36, 680, "Dimensions", size=10, bold=True)
    ruled(
        c,
        36,
        662,
        (330, 450),
        [
            ("", "3.4-m arm", "3.9-m arm"),
            ("A Overall Length", "12.00 m (39 ft. 4 in.)", "12.01 m (39 ft. 5 in.)"),
            ("D Idler-to-Sprocket Centers", "4.47 m (14 ft. 8 in.)", "4.47 m (14 ft. 8 in.)"),
            ("H Cab Height", "3.33 m (10 ft. 11 in.)", "3.33 m (10 ft. 11 in.)"),
            ("K Ground Clearance", "0.74 m (29 in.)", "0.74 m (29 in.)"),
        ],
        heads=1,
    )
    put(c, 36, 570, "Operating Ranges", size=10, bold=True)
    ruled(
        c,
        36,
        552,
        (330, 450),
        [
            ("", "3.4-m arm", "3.9-m arm"),
            ("A Maximum Reach", "12.02 m (39 ft. 5 in.)", "12.49 m (41 ft. 0 in.)"),
            ("A' Maximum Reach at Ground Level", "11.79 m (38 ft. 8 in.)", "12.28 m (40 ft. 3 in.)"),
            ("B Maximum Digging Depth", "7.77 m (25 ft. 6 in.)", "8.27 m (27 ft. 2 in.)"),
            ("C Maximum Cutting Height", "10.97 m (36 ft. 0 in.)", "11.16 m (36 ft. 7 in.)"),
        ],
        heads=1,
    )
    c.save()


def test_heads_that_name_properties_and_columns_that_name_configurations(tmp_path: Path) -> None:
    deere_470(tmp_path / "sheet.pdf")
    found = extract(EXCAVATOR, [tmp_path / "sheet.pdf"], config="3.9 m arm")
    assert values(found) == {
        "Boom Cylinder Bore": 0.17,
        "Boom Cylinder Rod Diameter": 0.115,
        "Boom Cylinder Stroke": 1.59,
        "Arm Cylinder Bore": 0.19,
        "Arm Cylinder Rod Diameter": 0.13,
        "Arm Cylinder Stroke": 1.94,
        "Bucket Cylinder Bore": 0.17,
        "Bucket Cylinder Rod Diameter": 0.12,
        "Bucket Cylinder Stroke": 1.325,
        "Overall Length": 12.01,
        "Ground Clearance": 0.74,
        "Maximum Reach": 12.49,
        "Maximum Reach at Ground Level": 12.28,
        "Maximum Digging Depth": 8.27,
        "Maximum Digging Height": 11.16,
    }
    undecided = extract(EXCAVATOR, [tmp_path / "sheet.pdf"])
    assert statuses(undecided, "Maximum Reach", "Maximum Digging Depth", "Ground Clearance") == ["conflict"] * 2 + [
        "ok"
    ]


# Komatsu PC210LC-11, KOMATSU-PC210LC11-BR02-0225-V2 (EXO-Robotics/exo-equipment-atlas, komatsu-pc210lc-11)
def komatsu_pc210(path: Path) -> None:
    c = canvas(path)
    bar(c, 36, 800, "DIMENSIONS", 250)
    leaders(
        c,
        36,
        782,
        250,
        [("A Overall length", "9705 mm"), ("D Overall width", "3080 mm"), ("L Track length", "4450 mm")],
    )
    bar(c, 306, 800, "WORKING RANGE", 250)
    leaders(
        c,
        306,
        782,
        250,
        [
            ("A Max. digging height", "9970 mm"),
            ("B Max. dumping height", "7110 mm"),
            ("C Max. digging depth", "6620 mm"),
            ("G Max. reach at ground", "9700 mm"),
        ],
    )
    bar(c, 36, 700, "HYDRAULICS", 520)
    leaders(
        c,
        36,
        682,
        520,
        [
            ("Boom cylinders - number of cylinders - bore x stroke", "2 - 120 x 1334 mm"),
            ("Arm cylinder - number of cylinders - bore x stroke", "1 - 135 x 1490 mm"),
            ("Bucket cylinder", "1 x 1105 mm stroke"),
            ("Boom length", "5.700 mm"),
            ("Operating weight", "23.313 - 24.440 kg"),
        ],
    )
    c.save()


def test_letter_keys_mean_something_else_in_each_table(tmp_path: Path) -> None:
    komatsu_pc210(tmp_path / "sheet.pdf")
    found = extract(EXCAVATOR, [tmp_path / "sheet.pdf"])
    assert values(found) == {
        "Overall Length": 9.705,
        "Maximum Digging Height": 9.97,
        "Maximum Digging Depth": 6.62,
        "Maximum Reach at Ground Level": 9.7,
        "Boom Cylinder Bore": 0.12,
        "Boom Cylinder Stroke": 1.334,
        "Arm Cylinder Bore": 0.135,
        "Arm Cylinder Stroke": 1.49,
        "Bucket Cylinder Stroke": 1.105,
        "Boom Length": 5.7,  # "5.700 mm" is 5700 mm: 5.7 mm is no boom
    }
    assert statuses(found, "Operating Weight") == ["conflict"]  # a range is not a value


# JCB 3CX (synergyrentals.ae/compressor-solutions/jcb-procontrol)
def jcb_3cx(path: Path) -> None:
    c = canvas(path)
    bar(c, 36, 800, "STATIC DIMENSIONS", 520)
    ruled(
        c,
        36,
        782,
        (400,),
        [
            ("Dimension", "m (ft-in)"),
            ("Total travel length", "5.62 (18-5)"),
            ("Axle centreline distance", "2.17 (7-1)"),
            ("Kingpost clearance", "0.52 (1-8)"),
            ("Cab roof height", "3.03 (9-9)"),
            ("Rear frame width", "2.35 (7-8) / 2.24 (7-4)*"),
            ("Total travel clearance", "3.61 (11-10)"),
        ],
        heads=1,
    )
    c.save()


def test_metres_with_feet_and_inches_by_the_head(tmp_path: Path) -> None:
    jcb_3cx(tmp_path / "sheet.pdf")
    asked = template(
        wanted("Overall Length", "length", "total travel length"),
        wanted("Wheelbase", "length", "axle centreline distance"),
        wanted("Kingpost Clearance", "length"),
        wanted("Overall Height", "length", "cab roof height"),
        wanted("Rear Frame Width", "length"),
    )
    found = extract(asked, [tmp_path / "sheet.pdf"])
    assert values(found) == {"Overall Length": 5.62, "Wheelbase": 2.17, "Kingpost Clearance": 0.52}
    # 3.03 m is 9 ft 11 in, and two values for one width are no value
    assert statuses(found, "Overall Height", "Rear Frame Width") == ["review", "conflict"]


# Mitsubishi FD70N, part 3 section 11-1 (scribd.com/document/723649080)
def mitsubishi_fd70n(path: Path) -> None:
    c = canvas(path)
    put(c, 36, 800, "Hydraulic system", size=12, bold=True)
    lattice(
        c,
        36,
        780,
        (120, 110, 90, 90, 90),
        [
            ("Item", "<", "<", "mm", "in"),
            ("Lift cylinder", "Simplex mast", "Inner diameter", "80", "3.15"),
            (None, None, "Stroke", "1500 to 3000", "59.06 to 118.11"),
            (None, "Triplex mast", "Inner diameter", "140", "5.51"),
            (None, None, "Stroke", "730 to 1090", "28.74 to 42.91"),
            ("Tilt cylinder", "<", "Inner diameter", "90", "3.54"),
            (None, None, "Stroke", "229", "9.02"),
        ],
    )
    lattice(
        c,
        36,
        620,
        (230, 90, 90),
        [
            ("Item", "MPa", "psi"),
            ("Main relief valve pressure", "19.1", "2770.23"),
            ("Priority relief valve pressure", "12.3", "1783.97"),
        ],
    )
    c.save()


def test_spanned_cells_fill_their_rows(tmp_path: Path) -> None:
    mitsubishi_fd70n(tmp_path / "sheet.pdf")
    asked = template(
        wanted("Lift Cylinder Bore", "length", "lift cylinder inner diameter"),
        wanted("Lift Cylinder Stroke", "length"),
        wanted("Tilt Cylinder Bore", "length", "tilt cylinder inner diameter"),
        wanted("Tilt Cylinder Stroke", "length"),
        wanted("Main Relief Pressure", "pressure", "main relief valve pressure"),
    )
    found = extract(asked, [tmp_path / "sheet.pdf"], config="simplex mast")
    assert values(found) == {
        "Lift Cylinder Bore": 0.08,
        "Tilt Cylinder Bore": 0.09,
        "Tilt Cylinder Stroke": 0.229,
        "Main Relief Pressure": 19.1e6,
    }
    assert statuses(found, "Lift Cylinder Stroke") == ["conflict"]
    assert statuses(extract(asked, [tmp_path / "sheet.pdf"]), "Lift Cylinder Bore") == ["conflict"]


def test_german_numbers_and_words(tmp_path: Path) -> None:
    c = canvas(tmp_path / "blatt.pdf")
    bar(c, 36, 800, "ABMESSUNGEN UND GEWICHTE", 300)
    leaders(
        c,
        36,
        782,
        300,
        [
            ("Radstand", "3.450 mm"),
            ("Einsatzgewicht", "25.510 kg"),
            ("Schaufelinhalt gehäuft", "4,2 m³"),
            ("Hubzylinder – Bohrung x Hub", "150 x 764 mm"),
            ("Betriebsdruck", "31,4 MPa"),
        ],
    )
    c.save()
    asked = template(
        wanted("Wheelbase", "length", "Radstand"),
        wanted("Operating Weight", "mass", "Einsatzgewicht"),
        wanted("Bucket Capacity", "volume", "Schaufelinhalt gehäuft"),
        wanted("Lift Cylinder Bore", "length", "Hubzylinder Bohrung"),
        wanted("Lift Cylinder Stroke", "length", "Hubzylinder Hub"),
        wanted("Main Relief Pressure", "pressure", "Betriebsdruck"),
    )
    assert values(extract(asked, [tmp_path / "blatt.pdf"])) == {
        "Wheelbase": 3.45,
        "Operating Weight": 25510.0,
        "Bucket Capacity": 4.2,
        "Lift Cylinder Bore": 0.15,
        "Lift Cylinder Stroke": 0.764,
        "Main Relief Pressure": 31.4e6,
    }


def test_a_separator_in_doubt_is_reviewed(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    leaders(c, 36, 782, 300, [("Operating weight", "86.275 kg"), ("Counterweight", "4.2 t (10,400 lb)")])
    c.save()
    asked = template(wanted("Operating Weight", "mass"), wanted("Counterweight", "mass"))
    found = extract(asked, [tmp_path / "sheet.pdf"])
    assert statuses(found, "Operating Weight", "Counterweight") == ["review", "review"]
    bounded = template(wanted("Operating Weight", "mass", minimum=1000.0, maximum=1e6))
    assert values(extract(bounded, [tmp_path / "sheet.pdf"])) == {"Operating Weight": 86275.0}


# Caterpillar 740 GC (manualmachine.com/cat/740gc/17904591-specifications)
def test_a_label_digit_glued_to_its_value_is_for_review(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    bar(c, 36, 800, "Transmission", 300)
    for i, line in enumerate(("Forward 16.4 km/h4.0 mph", "Forward 957.5 km/h35.7 mph", "Reverse 16.8 km/h4.2 mph")):
        put(c, 36, 780 - 12 * i, line)
    c.save()
    found = extract(template(wanted("Reverse Speed", "speed", "reverse")), [tmp_path / "sheet.pdf"])
    speed = found.get("Reverse Speed")
    assert speed is not None and speed.status == "review" and "which differ" in speed.reason


def test_steering_angles_are_told_apart(tmp_path: Path) -> None:
    c = canvas(tmp_path / "sheet.pdf")
    put(c, 36, 780, "Steering angle")
    put(c, 200, 780, "35° each direction (40° to max. end stop)")
    c.save()
    asked = template(
        wanted("Maximum Steering Angle", "angle", "steering angle end stop"),
        wanted("Steering Angle", "angle", "steering angle each direction", forbidden=("max", "end stop")),
    )
    found = values(extract(asked, [tmp_path / "sheet.pdf"]))
    assert found == {
        "Maximum Steering Angle": round(math.radians(40), 9),
        "Steering Angle": round(math.radians(35), 9),
    }
