"""The example wheel loader, read from its STEP file, against the planar linkage that it was drawn from."""

from __future__ import annotations

import importlib
import json
import math

import numpy as np
import pytest

from yellowiron import library
from yellowiron.kinematics import ClosedChain, complete, measure
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import choose

pytestmark = pytest.mark.slow

LIFT = "boom_cylinder_barrel_l2boom_piston_rod_l_joint"
TILT = "bucket_piston_rod2bucket_cylinder_barrel_joint"
RIGHT = "steering_cylinder_barrel_r2steering_piston_rod_r_joint"
LEFT = "steering_cylinder_barrel_l2steering_piston_rod_l_joint"


@pytest.fixture(scope="module")
def mechanism(example, loader_assembly):
    """The mechanism of the example's STEP file, every part aligned as `truth.json` says."""
    truth = json.loads((example / "truth.json").read_text(encoding="utf-8"))
    parts = tuple(PartAssignment(p, a["role"], a["body"], 1.0, "truth") for p, a in truth["parts"].items())
    sizes = {}
    for slide, words in ((LIFT, "Lift"), (TILT, "Tilt"), (LEFT, "Steering")):
        for quantity, name in (("stroke", "Stroke"), ("bore", "Bore"), ("rod_diameter", "Rod Diameter")):
            wanted = f"{words} Cylinder {name}"
            sizes[wanted] = Specification(wanted, truth["cylinders"][slide][quantity], "m", "ok")
    alignment = Alignment("wheel_loader", np.array(truth["frame"]), parts)
    template = choose(library.load_template("wheel_loader"), {})
    return complete(build_mechanism(loader_assembly, template, alignment, Specifications(sizes), name="wheel_loader"))


@pytest.fixture(scope="module")
def drawing(example):
    """The example's own planar solution (millimetres); it shares no code with the package."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(example.parent))
        linkage, draw, values = (
            importlib.import_module(f"wheel_loader.{name}") for name in ("linkage", "draw", "values")
        )
        yield linkage, draw, values


def wrapped(angle: float) -> float:
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def test_the_example_has_no_loose_end(mechanism):
    assert mechanism.mobility.computed == mechanism.mobility.expected == 8
    assert [f for f in mechanism.findings if f.code.startswith("KIN")] == []
    assert all(loop.branch in (-1, 1) for loop in mechanism.loops)


def planar(mechanism, linkage):
    """The example's planar linkage with the pins where the mechanism has them (its own solver may end a nanometre off
    on another computer, and the drawing is from this one)."""

    def pin(joint):
        anchor = mechanism.joint(joint).anchor
        return np.array([anchor[0], anchor[2]]) * 1e3

    edge = next(s for s in mechanism.sites if s.name == "bucket_edge")
    a, b, g = pin("front_frame2boom_joint"), pin("boom2bucket_joint"), pin("boom2rocker_joint")
    d, f, h = (
        pin("boom2boom_piston_rod_l_joint"),
        pin("bucket_piston_rod2rocker_joint"),
        pin("rocker2bucket_link_joint"),
    )
    j, t = pin("bucket_link2bucket_joint"), np.array([edge.position[0], edge.position[2]]) * 1e3
    boom, rocker = linkage.direction(b - a), linkage.direction(f - g)
    pitch = math.atan2(edge.x_axis[2], edge.x_axis[0])
    return linkage.Linkage(
        A=a,
        C=pin("front_frame2boom_cylinder_barrel_l_joint"),
        E=pin("front_frame2bucket_cylinder_barrel_joint"),
        boom=float(np.hypot(*(b - a))),
        D=linkage.rot(-boom, d - a),
        G=linkage.rot(-boom, g - a),
        rocker=float(np.hypot(*(f - g))),
        H=linkage.rot(-rocker, h - g),
        link=float(np.hypot(*(j - h))),
        J=linkage.rot(-pitch, j - b),
        T=linkage.rot(-pitch, t - b),
    )


def test_pins_are_where_the_linkage_has_them(mechanism, drawing):
    linkage, _, _ = drawing
    found, drawn = planar(mechanism, linkage), linkage.solve()
    for name in ("A", "C", "E", "boom", "D", "G", "rocker", "H", "link", "J", "T"):
        assert np.max(np.abs(getattr(found, name) - getattr(drawn, name))) <= 0.01, name  # millimetres


def test_front_end_over_the_full_strokes(mechanism, drawing):
    linkage, draw, values = drawing
    k = planar(mechanism, linkage)
    drawn = k.pose(draw.LIFT_DRAWN, draw.TILT_DRAWN)
    chain = ClosedChain(mechanism)
    lift = np.linspace(values.LIFT_CLOSED.value, values.LIFT_CLOSED.value + values.LIFT_STROKE.value, 200)
    wave = 0.5 - 0.5 * np.cos(np.linspace(0.0, 9.0 * np.pi, 200))
    tilt = values.TILT_CLOSED.value + values.TILT_STROKE.value * wave
    states = chain.sweep({LIFT: (lift - draw.LIFT_DRAWN) / 1e3, TILT: (tilt - draw.TILT_DRAWN) / 1e3})
    assert len(states) == 200
    metres = radians = 0.0
    for state, a, b in zip(states, lift, tilt, strict=True):
        p = k.pose(float(a), float(b))
        boom, rocker, bucket = (
            getattr(p, f"{name}_angle") - getattr(drawn, f"{name}_angle") for name in ("boom", "rocker", "bucket")
        )
        for joint, angle in {
            "front_frame2boom_joint": -boom,
            "boom2rocker_joint": boom - rocker,
            "boom2bucket_joint": boom - bucket,
        }.items():
            radians = max(radians, abs(wrapped(chain.coordinate(state, joint) - angle)))
        for body, before, now in (("bucket", drawn.T, p.T), ("boom", drawn.B, p.B), ("rocker", drawn.H, p.H)):
            moved = chain.displacement(state, body) @ [before[0] / 1e3, 0.0, before[1] / 1e3, 1.0]
            metres = max(metres, abs(moved[0] - now[0] / 1e3), abs(moved[2] - now[1] / 1e3), abs(moved[1]))
    assert metres <= 1e-9 and radians <= 1e-9


def test_steering_over_the_full_stroke(mechanism, drawing):
    linkage, _, _ = drawing
    s = linkage.solve_steering()
    chain = ClosedChain(mechanism)
    straight = s.length(0.0)
    angles = np.radians(np.linspace(-40.0, 40.0, 81))
    strokes = np.array([s.length(-angle) - straight for angle in angles]) / 1e3  # the right one mirrors the left
    states = chain.sweep({RIGHT: strokes})
    assert len(states) == 81
    a = max(
        abs(chain.coordinate(state, "rear2front_joint") - angle) for state, angle in zip(states, angles, strict=True)
    )
    b = max(
        abs(chain.coordinate(state, LEFT) - (s.length(angle) - straight) / 1e3)
        for state, angle in zip(states, angles, strict=True)
    )
    assert a <= 1e-9 and b <= 1e-9


def test_measurements_meet_the_values_it_was_drawn_to(mechanism, drawing):
    _, _, values = drawing
    found = {m.name: m.model for m in measure(mechanism)}
    lengths = {
        "Hinge Pin Height at Maximum Lift": values.HINGE_HEIGHT_MAX,
        "Hinge Pin Height at Carry": values.HINGE_HEIGHT_CARRY,
        "Dumping Clearance": values.DUMP_CLEARANCE,
        "Dumping Reach": values.DUMP_REACH,
        "Digging Depth": values.DIG_DEPTH,
        "Overall Length": values.OVERALL_LENGTH,
        "Overall Height": values.CAB_HEIGHT,
        "Overall Operating Height": values.OPERATING_HEIGHT,
        "Overall Width": values.WIDTH_OVER_TYRES,
        "Bucket Width": values.BUCKET_WIDTH,
        "Wheelbase": values.WHEELBASE,
        "Ground Clearance": values.GROUND_CLEARANCE,
        "Tread": values.TREAD,
        "Rear Overhang": values.REAR_OVERHANG,
        "Tyre Diameter": values.TYRE_DIAMETER,
    }
    angles = {
        "Maximum Steering Angle": values.STEER_ANGLE,
        "Rack Back at Ground": values.RACK_BACK_GROUND,
        "Rack Back at Maximum Lift": values.RACK_BACK_MAX,
        "Dump Angle at Maximum Lift": values.DUMP_ANGLE_MAX,
        "Rear Axle Oscillation": values.OSCILLATION_TOTAL,
    }
    assert set(found) == {*lengths, *angles}
    for name, want in lengths.items():
        assert found[name] == pytest.approx(want.value / 1e3, rel=2e-4), name
    for name, want in angles.items():
        assert math.degrees(found[name]) == pytest.approx(want.value, abs=0.01), name
