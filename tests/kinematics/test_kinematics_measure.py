"""Measurements against the planar solution, calibration, lever tables."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from planar_zbar import direction, sketch, strokes, with_measurements, zbar_mechanism
from scipy.optimize import brentq

from yellowiron.kinematics import ClosedChain, calibrate, complete, key_poses, lever_table, measure
from yellowiron.kinematics.measuring.quantities import KINDS, Hulls, Posed, evaluate, wheels
from yellowiron.model.mechanism import Site
from yellowiron.model.template import MeasurementTemplate
from yellowiron.support.text import plain

DOWN = -math.radians(30.0)
EDGE = {"kind": "height", "site": "edge"}
PITCH = {"kind": "angle", "site": "edge"}


def template(name: str, quantity, *steps) -> MeasurementTemplate:
    return MeasurementTemplate(name, name, quantity, tuple(steps))


def solve(*conditions):
    return {"solve": [{"actuator": a, "quantity": q, "value": v} for a, q, v in conditions]}


TEMPLATES = [
    template("hinge at top", {"kind": "height", "joint": "bucket_pin"}, {"set": {"boom": "max"}}),
    template("rack back at top", PITCH, {"set": {"boom": "max", "bucket": "max"}}),
    template("clearance", EDGE, {"set": {"boom": "max"}}, solve(("bucket", PITCH, DOWN))),
    template("reach", {"kind": "reach", "site": "edge"}, {"set": {"boom": "max"}}, solve(("bucket", PITCH, DOWN))),
    template(
        "rack back low",
        PITCH,
        solve(("boom", EDGE, 0.8), ("bucket", PITCH, math.radians(5.0))),
        {"set": {"bucket": "max"}},
    ),
    template("steering", {"kind": "joint_angle", "joint": "articulation"}, {"set": {"steering": "max"}}),
    template("right", {"kind": "joint_angle", "joint": "articulation", "factor": -1}, {"set": {"steering": "min"}}),
    template(
        "lock to lock",
        {"kind": "joint_angle", "joint": "articulation", "above": [{"set": {"steering": "min"}}]},
        {"set": {"steering": "max"}},
    ),
    template("turn", {"kind": "turning_radius"}, {"set": {"steering": "max"}}),
    template("yaw", {"kind": "yaw", "joint": "boom_pin"}, {"set": {"steering": "max"}}),
    template("front", {"kind": "extent", "axis": "x", "of": "max", "bodies": ["bucket"], "zone": {"x": [0.9, 1]}}),
    template("wheelbase", {"kind": "distance", "joints": ["front_wheel_l_joint", "rear_wheel_l_joint"], "axis": "x"}),
    template("tread", {"kind": "distance", "joints": ["front_wheel_l_joint", "front_wheel_r_joint"]}),
    template("oscillation", {"kind": "joint_range", "joint": "axle_joint"}),
    template("width", {"kind": "extent", "axis": "y", "of": "length", "bodies": ["bucket"]}),
    template("height", {"kind": "extent", "axis": "z", "of": "max", "bodies": ["*"]}, {"set": {"boom": 0.5}}),
    template("overhang", {"kind": "overhang", "joint": "rear_wheel_l_joint", "of": "min", "bodies": ["rear_frame"]}),
    template("tyres", {"kind": "tyre_diameter"}),
    template("approach", {"kind": "approach_angle", "bodies": ["bucket"]}, {"set": {"boom": "max", "bucket": "max"}}),
    template(
        "edge below hinge",
        {"kind": "difference", "quantities": [{"kind": "height", "joint": "bucket_pin"}, EDGE]},
        {"set": {"boom": "max"}},
        solve(("bucket", PITCH, DOWN)),
    ),
    template(
        "hinge over edge, solved",
        PITCH,
        {"set": {"boom": "max"}},
        solve(("bucket", {"kind": "difference", "quantities": [{"kind": "height", "joint": "bucket_pin"}, EDGE]}, 0.5)),
    ),
]


@pytest.fixture(scope="module")
def planar():
    z = sketch()
    return z, strokes(z)


@pytest.fixture(scope="module")
def mechanism(planar):
    return with_measurements(zbar_mechanism(*planar), TEMPLATES, {"hinge at top": 3.0})


def expected(z, travel) -> dict[str, float]:
    (l0, l1), (t0, t1) = travel
    low, high = z.lift + l0, z.lift + l1

    def pitch(p):
        return direction(p["T"] - p["B"])

    top = z.pose(high, z.tilt + t1)
    dumped = z.pose(high, brentq(lambda t: pitch(z.pose(high, t)) - DOWN, z.tilt + t0, z.tilt + t1, xtol=1e-14))

    def levelled(lift):
        return brentq(lambda t: pitch(z.pose(lift, t)) - math.radians(5.0), z.tilt + t0, z.tilt + t1, xtol=1e-14)

    ground = brentq(lambda lift: z.pose(lift, levelled(lift))["T"][1] - 0.8, low, high, xtol=1e-14)
    # The tangent from the edge below the tyre: the angle between the line and the line to the wheel's centre.
    centre = np.array([1.7, 0.8])
    corners = [p - centre for p in (top["T"], top["B"], top["J"])]
    approach = min(direction(c) + math.asin(0.8 / np.hypot(*c)) for c in corners)
    half = z.pose(z.lift + 0.5 * (l0 + l1), z.tilt)
    return {
        "hinge at top": top["B"][1],
        "rack back at top": pitch(top),
        "clearance": dumped["T"][1],
        "reach": dumped["T"][0] - 2.5,
        "rack back low": pitch(z.pose(ground, z.tilt + t1)),
        "steering": 0.6,
        "right": 0.6,
        "lock to lock": 1.2,
        "turn": 1.7 * (math.cos(0.6) + 1.0) / math.sin(0.6) + 1.0 + 0.24,  # the tyres are 480 mm wide
        "yaw": 0.6,
        "front": max(z.pose(z.lift, z.tilt)[pin][0] for pin in "TBJ"),
        "wheelbase": 3.4,
        "tread": 2.0,
        "oscillation": 0.4,
        "width": 3.0,
        "height": max(3.0, *(half[pin][1] for pin in "BDGFHJT"), z.A[1]),
        "overhang": 2.3,
        "tyres": 1.6,
        "approach": approach,
        "edge below hinge": dumped["B"][1] - dumped["T"][1],
        "hinge over edge, solved": -math.asin(0.5 / np.hypot(*(top["T"] - top["B"]))),
    }


def test_measurements_agree_with_the_planar_solution(planar, mechanism):
    want = expected(*planar)
    found = {m.name: m for m in measure(mechanism)}
    assert list(found) == [t.name for t in TEMPLATES]
    for name, value in want.items():
        assert found[name].model == pytest.approx(value, abs=1e-9), (name, found[name].reason)
    top = found["hinge at top"]
    assert top.spec == 3.0 and top.role == "checked"
    assert top.error_percent == pytest.approx(100.0 * (want["hinge at top"] - 3.0) / 3.0)
    assert found["steering"].spec is None and found["steering"].error_percent is None


def test_completing_does_not_change_what_is_measured(mechanism):
    before, after = measure(mechanism), measure(complete(mechanism))
    assert [m.model for m in before] == pytest.approx([m.model for m in after], abs=1e-12)


def test_a_drawing_may_show_the_machine_steered(planar, mechanism):
    """The straight machine is where both steering cylinders are equally long, whatever the drawing shows."""
    chain = ClosedChain(mechanism)
    bent = chain.solve({"steering_l": 0.1})
    moved = chain.pose(bent)
    joints = []
    for j in mechanism.joints:
        pose = moved[j.body0]
        anchor = tuple(float(v) for v in (pose @ [*j.anchor, 1.0])[:3])
        axis = tuple(float(v) for v in pose[:3, :3] @ j.axis)
        shift = chain.coordinate(bent, j.name) if j.type == "prismatic" else 0.0
        limits = {} if j.lower is None or j.upper is None else {"lower": j.lower - shift, "upper": j.upper - shift}
        joints.append(replace(j, anchor=anchor, axis=axis, **limits))
    bodies = [
        replace(b, origin=tuple(float(v) for v in (moved[b.name] @ [*b.origin, 1.0])[:3])) for b in mechanism.bodies
    ]
    shifts = {c.name: chain.coordinate(bent, c.slide) for c in mechanism.cylinders}
    cylinders = [replace(c, drawn_length=c.drawn_length + shifts[c.name]) for c in mechanism.cylinders]
    steered = replace(mechanism, joints=tuple(joints), bodies=tuple(bodies), cylinders=tuple(cylinders))
    found = {m.name: m.model for m in measure(steered)}
    assert found["steering"] == pytest.approx(0.6, abs=1e-9)
    assert found["right"] == pytest.approx(0.6, abs=1e-9)
    assert found["yaw"] == pytest.approx(0.6, abs=1e-9)


def test_what_cannot_be_measured_says_why(mechanism):
    high = template("too high", EDGE, solve(("boom", EDGE, 9.0)))
    both = template("both too high", EDGE, solve(("boom", EDGE, 9.0), ("bucket", PITCH, 0.0)))
    no_site = template("no site", {"kind": "height", "site": "moon"})
    no_lever = template("no lever", EDGE, {"set": {"jib": "max"}})
    no_kind = template("no kind", {"kind": "weight"})
    motor = template("motor", EDGE, {"set": {"drive": "max"}})
    odd = replace(mechanism, measurements=(high, both, no_site, no_lever, no_kind, motor))
    found = measure(odd)
    assert all(m.model is None and m.error_percent is None for m in found)
    for m, words in zip(
        found,
        ("within the strokes it goes from", "cannot be reached together", "no site 'moon'", "no actuator 'jib'",
         "no quantity of kind 'weight'", "no end of stroke"),
        strict=True,
    ):  # fmt: skip
        assert words in m.reason, m.reason


@pytest.mark.parametrize("at", [0.0, 0.02])
def test_a_stroke_without_length_is_told_and_does_not_crash(mechanism, at):
    both = template("low", EDGE, solve(("boom", EDGE, 0.8), ("bucket", PITCH, 0.0)))
    stuck = [replace(j, lower=at, upper=at) if j.name == "lift_l" else j for j in mechanism.joints]
    found = complete(replace(mechanism, joints=tuple(stuck), measurements=(both, *TEMPLATES)))
    assert [f.where for f in found.findings if f.code == "KIN009"] == ["lift_l"]
    values = {m.name: m for m in measure(found)}
    assert values["low"].model is None and "no stroke between its ends" in values["low"].reason
    assert values["wheelbase"].model == pytest.approx(3.4)


def test_a_machine_that_goes_straight_has_no_turning_radius(mechanism):
    straight = with_measurements(
        mechanism, [template("turn", {"kind": "turning_radius"}, {"set": {"steering": "straight"}})], {}
    )
    found = measure(straight)[0]
    assert found.model is None and found.reason == "the machine's wheels are not steered"


def test_roles_and_status(mechanism):
    known = {
        "Hinge at Top": {"value": 3.0, "unit": "m", "status": "ok", "example": True},
        "clearance": {"value": 2.0, "unit": "m", "status": "conflict"},
    }
    found = {m.name: m for m in measure(replace(mechanism, specifications=known))}
    assert found["hinge at top"].role == "example" and found["hinge at top"].spec == 3.0
    assert found["clearance"].spec is None and "conflict" in found["clearance"].reason


def shifted(mechanism, amounts):
    """The machine with the closed lengths of some cylinders forgotten: limits off by `amounts`, source unknown."""
    cylinders, limits = [], {}
    for c in mechanism.cylinders:
        actuator = next(a for a in mechanism.actuators if c.name in a.cylinders)
        if actuator.name in amounts:
            by = amounts[actuator.name]
            limits[c.slide] = by
            c = replace(c, closed_length=c.closed_length + by, sources={"closed_length": "unknown: half the stroke"})
        cylinders.append(c)
    joints = [
        replace(j, lower=j.lower + limits[j.name], upper=j.upper + limits[j.name]) if j.name in limits else j
        for j in mechanism.joints
    ]
    return replace(mechanism, cylinders=tuple(cylinders), joints=tuple(joints))


def test_calibration_finds_the_closed_lengths(planar, mechanism):
    values = {
        k: v for k, v in expected(*planar).items() if k in ("hinge at top", "rack back at top", "clearance", "steering")
    }
    known = with_measurements(mechanism, TEMPLATES, values)
    lost = shifted(known, {"boom": 0.06, "bucket": -0.04})
    found = calibrate(lost)
    for c, want in zip(found.cylinders, known.cylinders, strict=True):
        assert c.closed_length == pytest.approx(want.closed_length, abs=1e-6)
    for j, want in zip(found.joints, known.joints, strict=True):
        assert j.lower == (want.lower if want.lower is None else pytest.approx(want.lower, abs=1e-6))
    roles = {m.specification: m.role for m in measure(found) if m.spec is not None}
    assert roles["hinge at top"] == "calibrated" and roles["rack back at top"] == "calibrated"
    assert roles["steering"] == "checked"
    assert [f.code for f in found.findings] == ["KIN010", "KIN010"]


def test_calibration_without_anything_to_go_by(mechanism):
    lost = shifted(replace(mechanism, specifications={}), {"boom": 0.06})
    found = calibrate(lost)
    assert [f.code for f in found.findings] == ["KIN011"]
    assert found.joints == lost.joints


def test_known_closed_lengths_are_left_alone(mechanism):
    assert calibrate(mechanism) is mechanism


def test_lever_tables_are_what_the_planar_solution_says(planar, mechanism):
    z, travel = planar
    table = lever_table(mechanism, "boom", n=5)
    assert table["joint"] == "lift_l"
    assert table["stroke"] == pytest.approx(np.linspace(*travel[0], 5).tolist())
    assert table["extension"][0] == pytest.approx(0.0, abs=1e-12)
    for stroke, angle, lever in zip(table["stroke"], *table["pivots"]["boom_pin"].values(), strict=True):
        p = z.pose(z.lift + stroke, z.tilt)
        assert angle == pytest.approx(-p["boom"], abs=1e-9)
        u = (p["D"] - z.C) / np.hypot(*(p["D"] - z.C))
        arm = p["D"] - z.A
        assert abs(lever) == pytest.approx(abs(arm[0] * u[1] - arm[1] * u[0]), abs=1e-9)
    assert lever_table(mechanism, "drive") == {} and lever_table(mechanism, "moon") == {}
    assert json.loads(json.dumps(plain(lever_table(mechanism, "bucket"))))["pivots"]["bucket_pin"]["lever"]
    positive = lever_table(mechanism, "steering", n=3)["pivots"]["articulation"]["angle"]
    assert positive == pytest.approx(sorted(positive)) and positive[-1] == pytest.approx(0.6, abs=1e-9)


def test_key_poses_differ(mechanism):
    poses = key_poses(mechanism)
    assert 2 <= len(poses) <= 4
    assert all(set(pose) == {b.name for b in mechanism.bodies} for pose in poses.values())


def test_wheels_are_found_by_what_they_are(mechanism):
    found = wheels(mechanism)
    assert [joint.body1 for joint, _ in found] == ["front_wheel_l", "front_wheel_r", "rear_wheel_l", "rear_wheel_r"]
    assert all(radius == pytest.approx(0.8, abs=1e-12) for _, radius in found)


def test_every_quantity_is_documented(root):
    text = (root / "docs" / "measurements.md").read_text(encoding="utf-8")
    assert all(f"`{kind}`" in text for kind in KINDS)


def test_the_library_measures_only_what_exists(root):
    for path in sorted((root / "src" / "yellowiron" / "library" / "data").glob("*/measurements.json")):
        for entry in json.loads(path.read_text(encoding="utf-8"))["measurements"]:
            assert entry["quantity"]["kind"] in KINDS


def test_hulls_are_where_their_bodies_stand(mechanism):
    """In any order of poses, whatever was kept of the one before."""
    chain = ClosedChain(mechanism)
    hulls = Hulls(chain)
    boom = next(c.slide for c in mechanism.cylinders)
    moved = chain.solve({boom: 0.1})
    for state in (chain.drawn, moved, chain.drawn, moved, moved):
        for body in (b for b in mechanism.bodies if len(b.hull)):
            pose = chain.displacement(state, body.name)
            corners = body.hull @ pose[:3, :3].T + pose[:3, 3]
            np.testing.assert_array_equal(hulls.corners(state, body), corners)
            np.testing.assert_array_equal(hulls.box(state, body), [corners.min(axis=0), corners.max(axis=0)])
    apart = [np.abs(hulls.corners(chain.drawn, b) - b.hull).max() for b in mechanism.bodies if len(b.hull)]
    assert max(apart) < 1e-9


def test_roll_and_the_angle_between_two_sites(mechanism):
    """Of a loader on a steered hinge: nothing rolls, and frames that are bent by 0.6 rad look 0.6 rad apart. A body
    drawn on a lengthwise pivot rolls as far as that turns, its left side down."""
    sites = (Site("front", "front_frame", (0.0, 0.0, 1.0)), Site("rear", "rear_frame", (0.0, 0.0, 1.0)))
    sites += (Site("axle", "axle", (-1.7, 0.0, 0.8)), Site("up", "axle", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    axle = mechanism.joint("axle_joint")
    sites = tuple(replace(site, body=axle.body1) if site.body == "axle" else site for site in sites)
    asked = [
        template("bend", {"kind": "between", "sites": ["front", "rear"]}, {"set": {"steering": "min"}}),
        template("level", {"kind": "roll", "site": "front"}, {"set": {"steering": "max"}}),
        template("none", {"kind": "roll", "site": "up"}),
        template("one", {"kind": "between", "sites": ["front"]}),
    ]
    machine = with_measurements(replace(mechanism, sites=(*mechanism.sites, *sites)), asked, {})
    found = {m.name: m for m in measure(machine)}
    assert found["bend"].model == pytest.approx(0.6, abs=1e-9)
    assert found["level"].model == pytest.approx(0.0, abs=1e-9)
    assert "straight up or down" in found["none"].reason and "needs two sites" in found["one"].reason
    chain = ClosedChain(machine)
    sense = 1.0 if axle.axis[0] > 0.0 else -1.0
    rolled = [bench_value(chain, machine, {"kind": "roll", "site": "axle"}, {"axle_joint": q}) for q in (0.1, -0.05)]
    assert rolled == pytest.approx([-0.1 * sense, 0.05 * sense], abs=1e-9)


def bench_value(chain, machine, quantity, coordinates):
    state = chain.solve(coordinates)
    posed = Posed(chain, machine, state, lambda name: 0.0, wheels(machine), Hulls(chain), lambda steps: state)
    return evaluate(quantity, posed)
