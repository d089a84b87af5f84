"""Tracks as they come: shoes in rings that float, hidden wheels that carry, and an undercarriage that stands."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from kit.machines.crawler import PITCH_RADIUS, Crawler, crawler, merged
from kit.machines.tracked_template import write_tracked_template
from yellowiron import kinematics
from yellowiron.cad.mesh.assembly import shape_of
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.geometry import Mesh
from yellowiron.model.mechanism import Mechanism, chained
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template, choose

SHEET = {"Drawbar Pull": (203e3, "N"), "Maximum Travel Speed": (1.5, "m/s")}


@pytest.fixture(scope="module")
def drawn() -> Crawler:
    return crawler(36)


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Template:
    return load_template(write_tracked_template(tmp_path_factory.mktemp("crawler")))


def build(drawn: Crawler, template: Template, tracks: str) -> Mechanism:
    aligned = drawn.aligned(shoes=tracks == "shoes")
    chosen = expand(choose(template, {"tracks": tracks}), aligned.counts)
    sheet = Specifications({k: Specification(k, v, u, "ok", "sheet") for k, (v, u) in SHEET.items()})
    return kinematics.complete(build_mechanism(drawn.assembly(), chosen, aligned, sheet, name="crawler"))


@pytest.fixture(scope="module")
def shoes(drawn: Crawler, template: Template) -> Mechanism:
    return build(drawn, template, "shoes")


@pytest.fixture(scope="module")
def belt(drawn: Crawler, template: Template) -> Mechanism:
    return build(drawn, template, "belt")


def test_shoes_turn_about_their_pins(shoes: Mechanism, drawn: Crawler) -> None:
    for side in "lr":
        for k in range(drawn.shoes):
            joint = shoes.joint(f"track_shoe_{side}2track_shoe_{side}_joint_{k + 1}")
            pin = drawn.pins[side][(k + 1) % drawn.shoes]
            assert {joint.body0, joint.body1} == {f"track_shoe_{side}_{i}" for i in (k + 1, (k + 1) % drawn.shoes + 1)}
            assert np.abs(np.array(joint.axis) - (0, 1, 0)).max() < 1e-9
            assert math.dist((joint.anchor[0], joint.anchor[2]), (pin[0], pin[2])) < 1e-9


def test_each_ring_floats_with_one_cut(shoes: Mechanism, drawn: Crawler) -> None:
    assert shoes.floating == ("track_shoe_l_1", "track_shoe_r_1")
    assert len(chained(shoes)) == 2 * drawn.shoes
    rings = [loop for loop in shoes.loops if "shoe" in loop.cut]
    assert [len(loop.joints) for loop in rings] == [drawn.shoes, drawn.shoes]
    assert {j.name for j in shoes.joints if j.cut} == {loop.cut for loop in rings}
    leading = [j.body1 for j in shoes.joints if not j.cut]
    assert len(leading) == len(set(leading)) == len(shoes.bodies) - 3


def test_rings_do_not_count_as_freedom(shoes: Mechanism) -> None:
    assert shoes.mobility is not None
    assert shoes.mobility.computed == shoes.mobility.expected == 1 + 2 * (1 + 1 + 5 + 2)
    assert not [f for f in shoes.findings if f.severity == "error"]


def test_the_sprocket_drives_at_the_pitch_circle(shoes: Mechanism) -> None:
    drive = shoes.joint("undercarriage2sprocket_l_joint").drive
    assert drive is not None
    assert drive.max_velocity == pytest.approx(1.5 / PITCH_RADIUS, rel=1e-6)
    # Two tracks share the pull.
    assert drive.max_force == pytest.approx(203e3 / 2 * PITCH_RADIUS, rel=1e-6)


def test_wheels_turn_about_their_axles(shoes: Mechanism, drawn: Crawler) -> None:
    for role, at in drawn.axles.items():
        joint = next(j for j in shoes.joints if j.body1 == role)
        assert joint.body0 == "undercarriage"
        assert math.dist((joint.anchor[0], joint.anchor[2]), (at[0], at[2])) < 1e-9, role


def test_hidden_wheels_stand_on_the_ground(belt: Mechanism, drawn: Crawler) -> None:
    length = drawn.pins["l"][:, 0].max() - drawn.pins["l"][:, 0].min() - 2 * PITCH_RADIUS
    for side, y in (("l", 1.2), ("r", -1.2)):
        wheels = [belt.body(f"track_wheel_{side}_{k}") for k in (1, 2, 3)]
        for wheel, at in zip(wheels, (0.3, 0.0, -0.3), strict=True):
            (ball,) = wheel.shapes
            assert ball.center[1] == pytest.approx(y, abs=1e-9)
            assert ball.center[2] == pytest.approx(ball.radius, abs=1e-9)
            assert ball.center[0] == pytest.approx(at * length, abs=1e-3)
            joint = next(j for j in belt.joints if j.body1 == wheel.name)
            assert joint.axis == (0.0, 1.0, 0.0)
            assert joint.drive is not None
            assert joint.drive.max_velocity == pytest.approx(1.5 / ball.radius)
            assert joint.drive.max_force == pytest.approx(203e3 / 6 * ball.radius)
            assert joint.drive.kind == "velocity"
    assert not {p.collision for b in belt.bodies for p in b.parts if (p.role or "").startswith("track_shoe")} - {"none"}


def whole(mechanism: Mechanism) -> tuple[float, np.ndarray, np.ndarray]:
    mass = sum(b.mass for b in mechanism.bodies)
    center = sum(b.mass * np.array(b.center_of_mass) for b in mechanism.bodies) / mass
    inertia = np.zeros((3, 3))
    for b in mechanism.bodies:
        arm = np.array(b.center_of_mass) - center
        inertia += b.inertia + b.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    return mass, center, inertia


def test_the_machine_weighs_the_same(drawn: Crawler, template: Template, belt: Mechanism, shoes: Mechanism) -> None:
    fixed = whole(build(drawn, template, "fixed"))
    for other in (belt, shoes):
        mass, center, inertia = whole(other)
        assert mass == pytest.approx(fixed[0], rel=1e-12)
        assert np.abs(center - fixed[1]).max() < 1e-9
        assert np.abs(inertia - fixed[2]).max() < 1e-6 * np.abs(fixed[2]).max()
    tracks = sum(b.mass for b in shoes.bodies if "shoe" in b.name)
    wheels = [b for b in belt.bodies if "track_wheel" in b.name]
    assert sum(b.mass for b in wheels) == pytest.approx(tracks)
    # Rolling at v they turn with the energy of a chain that runs around with v.
    turning = sum(b.inertia[1, 1] / b.shapes[0].radius ** 2 for b in wheels)
    assert turning == pytest.approx(tracks)


def test_a_track_that_is_not_there(drawn: Crawler, template: Template) -> None:
    aligned = drawn.aligned(shoes=False)
    kept = [p for p in aligned.parts if "shoe_l" not in (p.role or "")]
    aligned = type(aligned)(**{**vars(aligned), "parts": tuple(kept)})
    chosen = expand(choose(template, {}), aligned.counts)
    found = build_mechanism(drawn.assembly(), chosen, aligned, Specifications(), name="crawler")
    assert "MEC070" in {f.code for f in found.findings}
    assert sum("track_wheel" in b.name for b in found.bodies) == 3


def _sided(template: Template) -> Template:
    return replace(template, roles=tuple(replace(r, side=r.name[-1]) if r.hidden else r for r in template.roles))


def _with_undercarriage(drawn: Crawler, corners: np.ndarray) -> Crawler:
    """The machine on quadrilaterals (n × 4, 3) instead of its undercarriage and tracks."""
    moved = {p.part: p.body for p in drawn.aligned(shoes=False).parts}
    assembly = drawn.assembly()
    kept = [p for p in assembly.parts if moved[p.id] != "undercarriage"]
    one = Crawler(drawn.shoes, kept, {**assembly.shapes})
    one.truth = {p.id: drawn.truth[p.id] for p in one.parts}
    first = np.arange(0, len(corners), 4)[:, None, None]
    faces = (first + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3).astype(np.int32)
    one.add("sheet", "undercarriage", shape_of(Mesh(corners, faces), "sheet"), np.eye(4))
    return one


def test_a_track_drawn_as_a_line_has_a_pad_of_a_width(drawn: Crawler, template: Template) -> None:
    """A box without one is none: MuJoCo refused the whole machine."""
    ends = np.array([[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 0.8], [-2.0, 0.0, 0.8]])
    corners = np.concatenate([ends + np.array([0.0, y, 0.0]) for y in (1.2, -1.2)])
    found = build(_with_undercarriage(drawn, corners), _sided(template), "belt")
    pads = [pad for body in found.bodies for pad in body.pads]
    assert [pad.name for pad in pads] == ["undercarriage_pad_l", "undercarriage_pad_r"]
    assert all(size > 0.1 for pad in pads for size in pad.size or ())


def test_a_flat_thing_is_no_track(drawn: Crawler, template: Template) -> None:
    """What was found to be the undercarriage may be a disc, or a face of something else."""
    corners = np.array([[-2.0, -1.5, 0.0], [2.0, -1.5, 0.0], [2.0, 1.5, 0.0], [-2.0, 1.5, 0.0]])
    found = build(_with_undercarriage(drawn, corners), _sided(template), "belt")
    assert {f.where for f in found.findings if f.code == "MEC070"} == {"track_wheel_l", "track_wheel_r"}
    assert not [b.name for b in found.bodies if "track_wheel" in b.name]


def test_a_crumb_on_the_ground_is_no_track(drawn: Crawler, template: Template) -> None:
    """Wheels of no mass stood for it, and MuJoCo refused the whole machine."""
    face = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]])
    crumb = 0.02 * face + np.array([0.0, 1.2, 0.0])
    found = build(
        _with_undercarriage(drawn, np.concatenate([crumb, 2.0 * face + [0.0, -1.2, 0.5]])), _sided(template), "belt"
    )
    assert {f.where for f in found.findings if f.code == "MEC070"} == {"track_wheel_l", "track_wheel_r"}
    assert all(body.mass > 0.0 for body in found.bodies)


def test_a_frame_drawn_in_one_with_its_tracks(drawn: Crawler, template: Template) -> None:
    """It collides between the tracks, and what is measured there is the frame's: no corner of the whole's hull is."""
    moved = {p.part: p.body for p in drawn.aligned(shoes=False).parts}
    assembly = drawn.assembly()
    below = [p for p in assembly.parts if moved[p.id] == "undercarriage" and drawn.truth[p.id] != "swing_bearing"]
    shape = merged("crawler", *((assembly.shape_of(p), p.transform) for p in below))
    one = Crawler(drawn.shoes, [p for p in assembly.parts if p not in below], {**assembly.shapes})
    one.truth = {p.id: drawn.truth[p.id] for p in one.parts}
    one.add("crawler", "undercarriage", shape, np.eye(4))
    found = build(one, _sided(template), "belt")
    assert {f.where for f in found.findings if f.code == "MEC072"} == {"track_wheel_l", "track_wheel_r"}
    frame = found.body("undercarriage")
    (box,) = frame.shapes
    deck = next(assembly.points_of(p) for p in assembly.parts if p.name == "deck")
    assert box.size is not None
    assert box.center[2] - 0.5 * box.size[2] == pytest.approx(deck[:, 2].min(), abs=1e-6)
    assert box.size[0] == pytest.approx(np.ptp(deck[:, 0]), rel=1e-6) and box.center[1] == pytest.approx(0.0, abs=1e-6)
    assert 0.5 * np.ptp(deck[:, 1]) < box.size[1] < np.ptp(deck[:, 1])
    middle = frame.hull[np.abs(frame.hull[:, 1]) <= 0.5 * box.size[1] + 1e-9]
    assert middle[:, 2].min() == pytest.approx(deck[:, 2].min(), abs=1e-6)
    assert {p.collision for p in frame.parts if p.role == "undercarriage"} == {"none"}
    assert whole(found)[0] > 0.0
