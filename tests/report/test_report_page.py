"""What the page says: rows, sensors, figures against their bars, sweeps, and the same bytes every time."""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.report.html.joints import joint_marks, joint_rows
from yellowiron.report.html.marks import spread
from yellowiron.report.html.plots import Chart, Curve, plot
from yellowiron.report.html.sensors import field_of_view, sensor_marks, sensor_rows, views
from yellowiron.report.html.simulation import in_a_sentence, simulation_tables
from yellowiron.report.rows import in_rows
from yellowiron.report.words import breakable, counted, sentence, shown, signed, titled


def joint(name: str, **other: Any) -> dict[str, Any]:
    return {
        "name": name, "type": "revolute", "body0": "frame", "body1": name.removesuffix("_joint"), "anchor": (0, 0, 0),
        "axis": (0, 1, 0), "lower": None, "upper": None, "cut": False, "free": False, "drive": None, "source": {},
        **other,
    }  # fmt: skip


def test_counted_rows_are_one() -> None:
    names = ["frame", "shoe_l_1", "shoe_l_2", "arm", "shoe_l_3", "shoe_l_4", "wheel_1", "wheel_2"]
    assert in_rows(names) == {"frame": [0], "shoe_l": [1, 2, 4, 5], "arm": [3], "wheel_1": [6], "wheel_2": [7]}


@pytest.mark.slow
@settings(deadline=None)
@given(st.lists(st.from_regex(r"[a-c](_[0-9]{1,2})?", fullmatch=True), unique=True))
def test_every_name_is_in_one_row(names: list[str]) -> None:
    places = sorted(place for places in in_rows(names).values() for place in places)
    assert places == list(range(len(names)))


def test_a_cylinder_pushes_and_pulls_with_forces_of_its_own() -> None:
    drive = {"kind": "position", "max_force": 1109770.0, "reverse_force": 710251.0}
    both = {"kind": "velocity", "max_force": 35000.0, "reverse_force": None}
    joints = [joint("slide_joint", type="prismatic", drive=drive), joint("wheel_joint", drive=both)]
    said = [row["drive"] for row in joint_rows({"joints": joints, "actuators": []})]
    assert said == ["position, 1110 kN out, 710.3 kN in", "velocity, 35000 N⋅m"]


def test_a_row_of_joints_is_one_entry_and_one_label() -> None:
    joints = [joint("boom_joint", cut=True, lower=-0.5, upper=1.0)]
    joints += [joint(f"shoe_joint_{n}", anchor=(n, 0, 0)) for n in range(1, 50)]
    rows = joint_rows({"joints": joints, "actuators": []})
    assert [row["name"] for row in rows] == ["boom_joint", "shoe_joint_1 … _49"]
    assert rows[0]["range"] == "−28.648° … 57.296°" and rows[1]["range"] == "unlimited"
    assert "49 joints" in rows[1]["between"]
    first, second = joint_marks(rows)
    assert first.kind == "hollow" and second.kind == ""
    assert second.points.shape == (49, 3)


def test_words() -> None:
    assert shown(-0.5, "rad") == "−28.648°"
    assert shown(4.2, "m^3") == "4.2 m³"
    assert signed(-0.0001, 3, " %") == "0.000 %"
    assert signed(-1.25, 1, " %") == "−1.2 %"
    assert (counted(1, "part"), counted(2, "part"), counted(2, "body", "bodies")) == ("1 part", "2 parts", "2 bodies")
    assert counted(2, "mass") == "2 masses"
    assert sentence("rear_frame") == "Rear frame"
    assert titled("steer_cyl_tube_2") == "Steer cyl tube 2"
    assert titled("rear_frame2boom_joint") == "Rear frame to boom"
    assert titled("link_1_2_arm_joint") == "Link 1 to arm"


@settings(deadline=None)
@given(st.integers(2, 40))
def test_labels_keep_apart(count: int) -> None:
    spots = spread(np.zeros((count, 2)))
    apart = np.linalg.norm(spots[:, None] - spots[None, :], axis=2) + 99 * np.eye(count)
    assert apart.min() > 20.0


CAMERA = {
    "name": "cab_camera", "type": "camera", "body": "cab", "position": (1.0, 2.0, 3.0),
    "x_axis": (math.cos(0.5), 0.0, -math.sin(0.5)), "z_axis": (math.sin(0.5), 0.0, math.cos(0.5)),
    "joint": "", "cylinder": "", "source": "on the roof",
    "parameters": {"width": 200.0, "height": 100.0, "horizontal_fov": math.pi / 2, "rate": 30.0},
}  # fmt: skip
LIDAR = {**CAMERA, "name": "lidar", "type": "lidar", "parameters": {"lowest": -0.5, "highest": 0.25, "rate": 10.0},
         "x_axis": (0.0, -1.0, 0.0), "z_axis": (0.0, 0.0, 1.0)}  # fmt: skip
ENCODER = {**CAMERA, "name": "encoder", "type": "joint_encoder", "body": "", "joint": "pin", "parameters": {}}


def test_a_camera_sees_what_its_angles_say() -> None:
    assert field_of_view(CAMERA) == pytest.approx((math.pi / 4, math.atan(0.5)))
    *_, (kind, frame) = views([CAMERA], 10.0)
    assert kind == "frame"
    away = frame - np.array(CAMERA["position"])
    x, z = np.array(CAMERA["x_axis"]), np.array(CAMERA["z_axis"])
    ahead = away @ x
    assert np.allclose(ahead, ahead[0])
    assert np.allclose(np.abs(away @ np.cross(z, x)) / ahead, 1.0)
    assert np.allclose(np.abs(away @ z) / ahead, 0.5)


def test_a_lidars_rings_are_its_beams() -> None:
    rings = [points for kind, points in views([LIDAR], 10.0) if kind == "ring"]
    for ring, up in zip(rings, (-0.5, 0.25), strict=True):
        away = ring - np.array(LIDAR["position"])
        assert np.allclose(away[:, 2] / np.linalg.norm(away, axis=1), math.sin(up))
    assert views([ENCODER], 10.0) == []


@pytest.mark.parametrize(
    ("axis", "words"),
    [
        ((1, 0, 0), "forward"),
        ((-1, 0, 0), "backward"),
        ((0, 1, 0), "left"),
        ((math.cos(-0.3), math.sin(-0.3), 0), "forward, 17° to the right"),
        ((math.sin(-0.3), math.cos(-0.3), 0), "left, 17° to the rear"),
        ((math.cos(0.5), 0, -math.sin(0.5)), "forward, 29° down"),
        ((0, 0, 1), "up"),
    ],
)
def test_directions_in_words(axis: tuple[float, float, float], words: str) -> None:
    (row,) = sensor_rows({"sensors": [{**CAMERA, "x_axis": axis}]})
    assert row["looks"] == words


def test_sensors_are_marked_where_they_sit() -> None:
    document = {"sensors": [CAMERA, LIDAR, ENCODER], "joints": [joint("pin", anchor=(7.0, 0.0, 1.0))]}
    marks = sensor_marks(document)
    assert [mark.kind for mark in marks] == ["looks", "looks", "hollow"]
    assert np.allclose(marks[0].points, [(1, 2, 3)]) and np.allclose(marks[2].points, [(7, 0, 1)])
    rows = sensor_rows(document)
    assert rows[0]["parameters"] == "200 × 100 px, 90° × 53°, 30 Hz"
    assert rows[2]["mount"] == "pin" and rows[2]["place"] == ""


def run(engine: str, pin: float, bar: float, **other: Any) -> dict[str, Any]:
    return {
        "engine": engine, "version": "1.0", "dt_s": 0.001, "base": "fixed", "payload_kg": 100.0, "steps": 1000,
        "completed": True, "pin_error_mm": pin, "pin_bar_mm": bar, "angle_error_deg": 0.001, "angle_bar_deg": 0.01,
        "branches": [{"cut": "pin", "kept": True}], "findings": [],
        "actuators": [{"kind": "position", "final_error_percent": 0.4}], **other,
    }  # fmt: skip


def test_every_engine_is_held_against_its_own_bar() -> None:
    simulation = {"mujoco": run("mujoco", 0.06, 0.05), "physx": run("physx", 0.06, 0.25)}
    tables = simulation_tables(simulation)
    assert [engine["name"] for engine in tables["engines"]] == ["MuJoCo", "PhysX"]
    pins = tables["strokes"][1]["cells"]
    assert [(cell["text"], cell["note"], cell["mark"]) for cell in pins] == [
        ("0.060 mm", "at most 0.05 mm", "error"),
        ("0.060 mm", "at most 0.25 mm", "ok"),
    ]
    assert tables["driving"] == [] and tables["tests"] == []
    assert in_a_sentence(simulation).startswith("Driven in MuJoCo 1.0 and PhysX 1.0: worst pin 0.060 mm")
    assert in_a_sentence({}) == ""


def test_driving_and_tests_are_shown_where_they_ran() -> None:
    driving = {"distance_m": 5.0, "forward_m": 4.8, "forward_error_percent": -4.0, "backward_m": None,
               "turning_radius_m": 6.15, "geometry_radius_m": 6.0, "radius_error_percent": 2.5, "lock_deg": 39.6,
               "axle_angle_deg": None}  # fmt: skip
    test = {"name": "Breakout", "kind": "force", "unit": "N", "engine_value": 181e3, "statics_value": 180e3,
            "spec": 174e3, "error_percent": 4.02, "bar_percent": 10.0, "passed": True, "role": "checked",
            "definition": "ISO", "reason": "",
            "inputs": [{"name": "Mass", "value": 1850.0, "unit": "kg", "source": "", "published": False}]}  # fmt: skip
    lift = {**test, "name": "Twice", "kind": "lift", "unit": "1", "engine_value": 0.04, "statics_value": 0.0,
            "spec": None, "error_percent": None, "bar_percent": None, "expected": False}  # fmt: skip
    tables = simulation_tables({
        "mujoco": run("mujoco", 0.01, 0.05, driving=driving, tests=[test, lift]),
        "physx": run("physx", 0.01, 0.25, driving=None, driving_reason="no wheels"),
    })  # fmt: skip
    forward, radius = tables["driving"]
    assert forward["cells"][0]["mark"] == "error" and radius["cells"][0]["mark"] == "ok"
    assert forward["cells"][1]["text"] == "–"
    assert tables["driving_reason"] == "no wheels"
    breakout, twice = tables["tests"]
    assert breakout["cells"][0] == {"text": "181 kN", "note": "+4.0 %", "mark": "ok"}
    assert (breakout["sheet"], breakout["bar"]) == ("174 kN", "within 10 %")
    assert twice["sheet"] == "must not arrive" and twice["cells"][0]["text"] == "4 % of the way"
    assert [entry["text"] for entry in tables["inputs"]] == ["1850 kg"]


def test_a_plot_stays_in_its_frame() -> None:
    times = np.linspace(0.1, 10.0, 50)
    svg = plot([Curve(times, 3.0 * np.sin(times))], Chart("Speed", "", -2.0, 2.0, bar=1.0))
    points = re.search(r'points="([^"]*)"', svg)
    assert points
    y = [float(pair.split(",")[1]) for pair in points.group(1).split()]
    assert min(y) >= 0.0 and max(y) <= 190.0
    assert "nan" not in svg


def test_names_go_on_in_a_new_line_only_after_a_word() -> None:
    assert breakable("rear_frame2boom_joint") == "rear_<wbr>frame<wbr>2boom_<wbr>joint"
    assert breakable("a<b_1") == "a&lt;b_<wbr>1"
