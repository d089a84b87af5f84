"""Hinges that are driven directly: what is usual of a type, found again on a machine that is drawn in another pose."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanism_machine import machine, specifications, template

from yellowiron.library import load_template
from yellowiron.library.parsing.usual import read_hinges
from yellowiron.mechanism import build_mechanism
from yellowiron.mechanism.actuation.proportion import Proportion
from yellowiron.mechanism.actuation.usual_hinges import CARRIES, Turned, angle_of, carried_moment, sense, with_usual
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import GRAVITY, Body, Drive, Joint
from yellowiron.model.template import UsualHinge

Y = np.array([0.0, 1.0, 0.0])
USUAL = UsualHinge(math.radians(-70.0), math.radians(40.0), 0.7, 0.25)
MACHINE = Proportion(2e5, 10.0)


def beam(start: Floats, angle: float, length: float) -> Floats:
    """Corners of a beam from a point, turned down from forward by an angle about y."""
    box = trimesh.creation.box((length, 0.3, 0.4))
    points = np.add(box.vertices, (0.5 * length, 0.0, 0.0))
    turn = trimesh.transformations.rotation_matrix(angle, Y)[:3, :3]
    return start + points @ turn.T


def drawn(boom: float, arm: float, *, axis: Floats) -> tuple[dict[str, Turned], dict[str, Floats]]:
    """A boom on a base at an angle to forward, and an arm at an angle to the boom."""
    foot = np.array([0.5, 0.0, 1.5])
    tip = foot + 5.0 * np.array([math.cos(boom), 0.0, -math.sin(boom)])
    points = {"base": np.array([(-1.0, -1.0, 0.0), (1.0, 1.0, 2.0)]), "boom": beam(foot, boom, 5.0)}
    points["arm"] = beam(tip, boom + arm, 3.0)
    return {"foot": Turned(foot, axis, "base", "boom"), "elbow": Turned(tip, axis, "boom", "arm")}, points


@settings(max_examples=25, deadline=None)
@given(st.floats(-1.2, 1.2), st.floats(-2.5, 2.5), st.sampled_from([1.0, -1.0]))
def test_an_angle_is_the_same_however_the_machine_is_drawn(boom: float, arm: float, way: float) -> None:
    hinges, points = drawn(boom, arm, axis=way * Y)
    assert angle_of("foot", hinges, points.__getitem__) == pytest.approx(boom, abs=1e-9)
    assert angle_of("elbow", hinges, points.__getitem__) == pytest.approx(arm, abs=1e-9)


def test_what_lies_about_its_own_hinge_has_no_angle() -> None:
    hinges, points = drawn(0.0, 0.0, axis=Y)
    points["boom"] = points["boom"] - points["boom"].mean(axis=0) + hinges["foot"].anchor
    assert angle_of("foot", hinges, points.__getitem__) is None
    assert angle_of("elbow", hinges, {**points, "arm": np.zeros((0, 3))}.__getitem__) is None


def driven(axis: Floats = Y, **more: float) -> Joint:
    drive = Drive("position", 0.0, 0.0, math.inf, math.inf, "driven directly")
    return Joint("foot", "revolute", "base", "boom", (0.0, 0.0, 0.0), tuple(axis.tolist()), drive=drive, **more)  # type: ignore[arg-type]


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_limits_count_from_the_pose_in_the_file_whichever_way_the_axis_points(way: float) -> None:
    joint = with_usual(driven(way * Y), USUAL, math.radians(-20.0), MACHINE, "excavators")
    assert joint.lower is not None and joint.upper is not None
    ends = sorted(math.degrees(way * end) for end in (joint.lower, joint.upper))
    assert ends == pytest.approx([-50.0, 60.0])
    assert "usual of excavators, drawn at -20° of -70 to 40°" in joint.source["limits"]
    assert joint.drive is not None
    assert (joint.drive.max_force, joint.drive.max_velocity) == (0.25 * 2e6, 0.7)


@pytest.mark.parametrize(
    ("at", "ends"),
    [
        (50.0, (-120.0, 0.0)),  # it may go there
        (-100.0, (0.0, 140.0)),
        (160.0, (-110.0, 0.0)),  # misread: an end
        (None, (-55.0, 55.0)),
        (320.0, (-30.0, 80.0)),  # the same as -40
    ],
)
def test_what_is_drawn_beyond_the_range(at: float | None, ends: tuple[float, float]) -> None:
    joint = with_usual(driven(), USUAL, None if at is None else math.radians(at), MACHINE, "excavators")
    assert joint.lower is not None and joint.upper is not None
    assert (math.degrees(joint.lower), math.degrees(joint.upper)) == pytest.approx(ends)


def test_what_is_stated_stays() -> None:
    joint = with_usual(driven(lower=-0.1, upper=0.2), USUAL, 0.0, MACHINE, "excavators")
    assert (joint.lower, joint.upper) == (-0.1, 0.2)
    drive = replace(joint.drive, max_force=5.0, max_velocity=0.1)  # type: ignore[type-var]
    kept = with_usual(replace(joint, drive=drive), USUAL, 0.0, MACHINE, "excavators").drive
    assert kept == drive


def body(name: str, mass: float, at: tuple[float, float, float]) -> Body:
    return Body(name, at, mass, at, np.eye(3), (), np.zeros((0, 3)))


def test_a_hinge_carries_what_hangs_on_it_stretched_out() -> None:
    """Booms without cylinders sank to their stops: what is usual of a type suits no machine whose arm is heavier."""
    foot = driven()
    elbow = replace(foot, name="elbow", body0="boom", body1="arm", anchor=(3.0, 0.0, 4.0))
    other = replace(foot, name="other", body0="base", body1="bonnet")
    loop = replace(elbow, name="loop", body0="arm", body1="boom", cut=True)
    bodies = [body("boom", 100.0, (1.5, 0.2, 2.0)), body("arm", 10.0, (3.0, 0.0, 2.0)), body("bonnet", 1e3, (0, 0, 9))]
    joints, named = (foot, elbow, other, loop), {b.name: b for b in bodies}
    carried = carried_moment(foot, joints, named)
    assert carried == pytest.approx(GRAVITY * (100.0 * 2.5 + 10.0 * (5.0 + 2.0)))
    assert carried_moment(elbow, joints, named) == pytest.approx(GRAVITY * 10.0 * 2.0)
    assert carried_moment(replace(foot, axis=(0.0, 0.0, 1.0)), joints, named) == pytest.approx(0.0)

    small = Proportion(100.0, 1.0)
    drive = with_usual(foot, USUAL, 0.0, small, "excavators", carried=carried).drive
    assert drive is not None and drive.max_force == pytest.approx(CARRIES * carried)
    assert "what hangs on it" in drive.source and "speed: estimate, usual of excavators" in drive.source
    enough = with_usual(foot, USUAL, 0.0, MACHINE, "excavators", carried=carried).drive
    assert enough is not None and enough.max_force == 0.25 * 2e6


def test_axes_count_forward_left_and_up() -> None:
    assert sense(np.array([0.1, -0.9, 0.3])) == -1.0
    assert sense(np.array([0.1, 0.1, 0.98])) == 1.0


@pytest.mark.parametrize("kind", ["excavator", "wheeled_excavator", "wheel_loader", "backhoe_loader", "telehandler"])
def test_the_library_s_ranges_are_a_machine_s(kind: str) -> None:
    hinges = {name: usual for name, usual in load_template(kind).hinges.items() if not usual.common}
    assert hinges
    for name, usual in hinges.items():
        assert 0.1 < usual.high - usual.low < 3.5, name
        assert 0.05 < usual.speed < 3.0, name
        # Knuckles bear the weight and do not lift it.
        assert (0.005 if usual.from_drawn else 0.01) < usual.torque < 1.0, name
        assert usual.from_drawn == (name in ("steering", "rear_steering") and kind != "wheel_loader"), name
    if "boom" in hinges and "arm" in hinges:
        # A boom goes from steeply down to steeply up; an arm hangs from it, and comes in beyond the square.
        assert math.degrees(hinges["boom"].low) < -50.0 and math.degrees(hinges["boom"].high) > 30.0
        assert 15.0 < math.degrees(hinges["arm"].low) < 45.0 and math.degrees(hinges["arm"].high) > 120.0


def test_names_and_ranges_that_cannot_be_are_told(tmp_path) -> None:  # type: ignore[no-untyped-def]
    from yellowiron.library.notation.validated_json import read_document
    from yellowiron.model.errors import TemplateError

    actuators = load_template("excavator").actuators
    path = tmp_path / "hinges.json"
    for text, words in (
        ('{"boon": {"low": -1, "high": 1, "speed": 1, "torque": 1}}', "no actuator with cylinders"),
        ('{"boom": {"low": 1, "high": 1, "speed": 1, "torque": 1}}', "range is empty"),
    ):
        path.write_text(text)
        with pytest.raises(TemplateError, match=words):
            read_hinges(read_document(path, "hinges"), actuators)


def test_a_hinge_of_which_its_type_says_nothing_is_limited_all_the_same() -> None:
    """An adjustable boom without its cylinder had an unlimited torque and speed."""
    assembly, alignment = machine()
    parts = tuple(p for p in alignment.parts if not p.part.endswith("ROD"))
    built = build_mechanism(assembly, template(), replace(alignment, parts=parts), specifications(), name="crane")
    joint = built.joint("base2arm")
    assert joint.drive is not None and math.isfinite(joint.drive.max_force) and math.isfinite(joint.drive.max_velocity)
    assert np.degrees([joint.lower, joint.upper]) == pytest.approx([-45.0, 45.0])  # type: ignore[list-item]
    assert "usual of machines" in joint.source["limits"]
