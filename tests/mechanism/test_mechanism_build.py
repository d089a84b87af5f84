"""The whole mechanism of the hand-made crane: joints on their pins, in any CAD frame, and what happens where parts are
missing."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanism_machine import A, C, D, box, feature, machine, specifications, template

from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats, Mesh
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.template import JointTemplate, SiteTemplate, Template

angle = st.floats(-math.pi, math.pi)


def rotation(a: float, b: float, c: float) -> Floats:
    matrix = np.eye(4)
    for axis, turn in enumerate((a, b, c)):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        step = np.eye(4)
        step[[i, i, j, j], [i, j, i, j]] = (math.cos(turn), -math.sin(turn), math.sin(turn), math.cos(turn))
        matrix = matrix @ step
    return matrix


def build(made: tuple[Assembly, Alignment] | None = None, plan: Template | None = None, **values: float) -> Mechanism:
    assembly, alignment = made or machine()
    return build_mechanism(assembly, plan or template(), alignment, specifications(**values), name="crane")


def without(alignment: Alignment, *names: str) -> Alignment:
    """The alignment with parts of those names left out of the machine."""
    parts = tuple(replace(a, role=None, body=None) if a.part.split("/")[-1] in names else a for a in alignment.parts)
    return replace(alignment, parts=parts)


def codes(built: Mechanism) -> set[str]:
    return {f.code for f in built.findings}


@settings(max_examples=20, deadline=None)
@given(a=angle, b=angle, c=angle, at=st.tuples(*[st.floats(-20, 20)] * 3))
def test_joints_are_on_their_pins_in_any_cad_frame(
    a: float, b: float, c: float, at: tuple[float, float, float]
) -> None:
    frame = rotation(a, b, c)
    frame[:3, 3] = at
    built = build(machine(frame=frame))
    for name, anchor in (("base2arm", A), ("base2barrel", C), ("arm2rod", D)):
        joint = built.joint(name)
        assert joint.axis == pytest.approx((0.0, 1.0, 0.0), abs=1e-9)
        assert joint.anchor == pytest.approx(anchor, abs=1e-9)
    slide = built.joint("slide")
    assert slide.axis == pytest.approx((D - C) / np.linalg.norm(D - C), abs=1e-9)
    assert slide.anchor == pytest.approx(D, abs=1e-9)
    assert (slide.body0, slide.body1) == ("cylinder_barrel", "cylinder_rod")


def test_the_tree_is_rooted_and_bodies_start_at_their_joints() -> None:
    built = build()
    assert [b.name for b in built.bodies] == ["base", "cylinder_barrel", "cylinder_rod", "arm"]
    assert built.joint("base2arm").cut
    assert built.loops[0].cut == "base2arm"
    origins = {b.name: b.origin for b in built.bodies}
    assert origins["base"] == (0.0, 0.0, 0.0)
    assert origins["cylinder_barrel"] == built.joint("base2barrel").anchor
    assert origins["arm"] == built.joint("arm2rod").anchor


def test_an_inverted_cylinder_extends_from_parent_to_child() -> None:
    """Seen from the arm the tree enters by the rod, and a positive coordinate still makes the cylinder longer."""
    built = build(plan=replace(template(), root="arm"))
    slide = built.joint("slide")
    assert (slide.body0, slide.body1) == ("cylinder_rod", "cylinder_barrel")
    assert slide.axis == pytest.approx((C - D) / np.linalg.norm(C - D), abs=1e-9)
    assert slide.lower == pytest.approx(-built.cylinders[0].extension)


def test_a_pin_that_leans_a_little_is_made_parallel_and_reported() -> None:
    silent, told = build(machine(twist=math.radians(0.005))), build(machine(twist=math.radians(0.1)))
    for built in (silent, told):
        axes = [built.joint(n).axis for n in ("base2arm", "base2barrel", "arm2rod")]
        assert axes[0] == pytest.approx(axes[1], abs=1e-15)
        assert axes[0] == pytest.approx(axes[2], abs=1e-15)
        assert abs(np.dot(axes[0], built.joint("slide").axis)) < 1e-15
    assert "MEC010" not in codes(silent)
    assert 0.0 < silent.joint("arm2rod").source["planarity_deg"] < 0.01
    assert "MEC010" in codes(told)


def test_a_pin_of_facets_may_lean_more() -> None:
    """A loop with a pin that is 0.6° askew jams in every engine, and facets show axes no better."""
    assembly, alignment = machine(twist=math.radians(0.8))
    assert "MEC010" not in codes(build((assembly, alignment)))
    shapes = {
        key: replace(s, cylinders=tuple(replace(c, exact=False) for c in s.cylinders))
        for key, s in assembly.shapes.items()
    }
    told = build((replace(assembly, shapes=shapes), alignment))
    assert "MEC010" in codes(told)
    assert told.joint("arm2rod").axis == pytest.approx(told.joint("base2arm").axis, abs=1e-15)


def test_a_pin_that_leans_much_is_left_alone() -> None:
    built = build(machine(twist=math.radians(5.0)))
    assert "MEC010" not in codes(built)
    assert abs(built.joint("arm2rod").axis[1]) == pytest.approx(math.cos(math.radians(5.0)))


def test_without_a_pin_the_bores_of_both_bodies_say_where() -> None:
    assembly, alignment = machine()
    bore = {
        "arm": feature((0, -0.25, 1.0), (0, 1, 0), 0.04, 0.0, 0.5, inner=True),
        "base": feature((0, 0.26, 1.0), (0, 1, 0), 0.04, 0.0, 0.1, inner=True),
    }
    shapes = {k: replace(s, cylinders=(bore[k],)) if k in bore else s for k, s in assembly.shapes.items()}
    built = build((replace(assembly, shapes=shapes), without(alignment, "PIN L", "PIN R")))
    joint = built.joint("base2arm")
    assert joint.axis == pytest.approx((0.0, 1.0, 0.0))
    assert np.hypot(joint.anchor[0], joint.anchor[2] - 1.0) < 1e-12
    assert "both bodies" in joint.source["method"]


def test_a_joint_that_nothing_shows_is_left_out_with_an_error() -> None:
    assembly, alignment = machine()
    built = build((assembly, without(alignment, "PIN L", "PIN R")))
    assert "base2arm" not in {j.name for j in built.joints}
    assert "MEC005" in codes(built)
    assert not built.loops


def test_a_pin_without_cylinders_is_a_guess_with_a_warning() -> None:
    assembly, alignment = machine()
    shapes = {k: replace(s, cylinders=()) if k == "short" else s for k, s in assembly.shapes.items()}
    built = build((replace(assembly, shapes=shapes), alignment))
    assert built.joint("base2arm").axis == pytest.approx((0.0, 1.0, 0.0), abs=1e-6)
    assert "MEC003" in codes(built)


def test_a_missing_body_takes_its_joints_along_and_the_hinge_is_driven_directly() -> None:
    assembly, alignment = machine()
    built = build((assembly, without(alignment, "ROD")))
    assert {j.name for j in built.joints} == {"base2arm", "base2barrel"}
    assert {"MEC002", "MEC013"} <= codes(built)
    # What is not drawn is said once: by what moves in its place.
    assert {f.severity for f in built.findings if f.code == "MEC002"} == {"info"}
    (actuator,) = built.actuators
    assert (actuator.kind, [j.joint for j in actuator.joints]) == ("motor", ["base2arm"])
    drive = built.joint("base2arm").drive
    assert drive is not None
    assert drive.kind == "position"


def test_an_actuator_without_cylinder_and_hinge_is_left_out() -> None:
    assembly, alignment = machine()
    built = build((assembly, without(alignment, "ROD", "PIN L", "PIN R")))
    assert "MEC026" in codes(built)
    assert not built.actuators


def test_a_body_that_nothing_holds_is_welded() -> None:
    assembly, alignment = machine()
    built = build((assembly, without(alignment, "PIN L", "PIN R", "PIN D", "ROD")))
    weld = next(j for j in built.joints if j.name.endswith("_weld_joint"))
    assert (weld.type, weld.body0, weld.body1) == ("fixed", "base", "arm")
    assert "MEC011" in codes(built)


def test_a_joint_to_nowhere_is_a_finding() -> None:
    plan = template()
    odd = (JointTemplate("odd", "revolute", ("arm", "moon")), JointTemplate("self", "revolute", ("arm", "rod_pin")))
    built = build(plan=replace(plan, joints=plan.joints + odd))
    assert [f.where for f in built.findings if f.code == "MEC001"] == ["odd", "self"]


def test_limits_are_read_with_their_sign_and_evidence_or_missed_aloud() -> None:
    plan = template()
    base = replace(plan.joints[0], lower="-Swing Angle", upper="Swing Angle")
    known = build(plan=replace(plan, joints=(base, *plan.joints[1:])), Swing_Angle=0.5).joint("base2arm")
    assert (known.lower, known.upper) == (-0.5, 0.5)
    assert known.source["upper_page"] == 2
    missed = build(plan=replace(plan, joints=(base, *plan.joints[1:])))
    assert (missed.joint("base2arm").lower, missed.joint("base2arm").upper) == (None, None)
    assert sum(f.code == "MEC050" for f in missed.findings) == 2


@pytest.mark.parametrize("pinned", [True, False])
def test_an_estimated_axis_stands_in_for_a_pin_that_shows_none(pinned: bool) -> None:
    assembly, alignment = machine()
    if pinned:
        shapes = {k: replace(s, cylinders=()) if k == "short" else s for k, s in assembly.shapes.items()}
        assembly = replace(assembly, shapes=shapes)
    else:
        alignment = without(alignment, "PIN L", "PIN R")
    estimate = ((0.02, 0.5, 1.01), (0.0, 1.0, 0.0))
    built = build((assembly, replace(alignment, axes={"base2arm": estimate})))
    joint = built.joint("base2arm")
    assert (joint.anchor[0], joint.anchor[2]) == pytest.approx((0.02, 1.01), abs=0.02)
    assert joint.axis == pytest.approx((0.0, 1.0, 0.0), abs=1e-6)
    assert "MEC005" not in codes(built)
    assert not pinned or "MEC009" in codes(built)


def test_a_part_of_an_unknown_body_is_left_out_with_an_error() -> None:
    assembly, alignment = machine()
    parts = tuple(replace(a, body="moon") if a.part.endswith("ROD") else a for a in alignment.parts)
    assert "MEC007" in codes(build((assembly, replace(alignment, parts=parts))))


def test_a_part_without_a_surface_is_left_out() -> None:
    assembly, alignment = machine()
    empty = Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32))
    shapes = {k: replace(s, mesh=empty) if k == "short" else s for k, s in assembly.shapes.items()}
    built = build((replace(assembly, shapes=shapes), alignment))
    assert sum(f.code == "MEC008" for f in built.findings) == 2
    assert "MEC005" in codes(built)


def test_a_body_without_mass_gets_some() -> None:
    assembly, alignment = machine()
    bare = replace(assembly.shapes["rod"], closed=False)
    bare = replace(bare, mesh=replace(bare.mesh, triangles=np.zeros((0, 3), dtype=np.int32)))
    built = build((replace(assembly, shapes={**assembly.shapes, "rod": bare}), alignment))
    assert built.body("cylinder_rod").mass == 1.0
    assert {"MEC031", "MEC034"} <= codes(built)


def test_without_the_root_the_nearest_body_stands_in() -> None:
    assembly, alignment = machine()
    built = build((assembly, without(alignment, "BASE", "PIN L", "PIN R", "PIN C")))
    assert built.root != "base"
    assert built.root in {b.name for b in built.bodies}
    (said,) = [f for f in built.findings if f.code == "MEC015"]
    assert (said.where, said.severity) == ("base", "error")


def test_no_body_at_all_is_an_error() -> None:
    assembly, alignment = machine()
    with pytest.raises(MechanismError, match="root body 'base'"):
        build((assembly, without(alignment, *(p.name for p in assembly.parts))))


def test_sites_at_joints_points_and_edges() -> None:
    plan = template()
    rules = (
        SiteTemplate("hinge", "arm", {"joint": "arm2rod"}),
        SiteTemplate("eye", "base", {"point": [1, 2, 3]}),
        SiteTemplate("lost", "arm", {"joint": "moon"}),
        *plan.sites,
    )
    built = build(plan=replace(plan, sites=rules))
    found = {s.name: s for s in built.sites}
    assert found["hinge"].position == built.joint("arm2rod").anchor
    assert found["eye"].position == (1.0, 2.0, 3.0)
    assert "lost" not in found and "MEC040" in codes(built)
    # The arm's box ends 2 m from its pin in two edges: the lower one counts, and its widest plane is the underside.
    assert found["tip"].position == pytest.approx((2.0, 0.0, 0.95))
    assert found["tip"].x_axis == pytest.approx((1.0, 0.0, 0.0))
    assert found["tip"].z_axis == pytest.approx((0.0, 0.0, 1.0))


def test_sites_at_the_first_joint_there_in_a_roles_middle_and_at_a_tip() -> None:
    plan = template()
    rules = (
        SiteTemplate("hinge", "arm", {"joint": ("moon", "arm2rod")}),
        SiteTemplate("lost", "arm", {"joint": ("moon", "sun")}),
        SiteTemplate("middle", "base", {"middle_of": "arm_pin"}),
        SiteTemplate("nowhere", "base", {"middle_of": "crane"}),
        SiteTemplate("tooth", "arm", {"edge_from": "base2arm", "spanning": 0.8, "tip": True}),
        *plan.sites,
    )
    assembly, alignment = machine()
    # One narrow tooth before the arm's edge: the edge stays the wide one, the tip is the tooth's.
    at = np.eye(4)
    at[:3, 3] = (2.1, 0.1, 0.96)
    assembly = replace(
        assembly,
        shapes={**assembly.shapes, "tooth": box("tooth", (0.3, 0.06, 0.02))},
        parts=(*assembly.parts, Part("CRANE/TOOTH", "TOOTH", ("CRANE",), "tooth", at)),
    )
    alignment = replace(alignment, parts=(*alignment.parts, PartAssignment("CRANE/TOOTH", None, "arm", 1.0, "test")))
    built = build((assembly, alignment), plan=replace(plan, sites=rules))
    found = {s.name: s for s in built.sites}
    assert found["hinge"].position == built.joint("arm2rod").anchor
    assert found["middle"].position == pytest.approx(built.joint("base2arm").anchor, abs=1e-9)
    assert not {"lost", "nowhere"} & set(found)
    assert found["tip"].position == pytest.approx((2.0, 0.0, 0.95))
    assert found["tooth"].position == pytest.approx((2.25, 0.1, 0.95))
    assert found["tooth"].x_axis == found["tip"].x_axis


@pytest.mark.parametrize("tilted", [0.0, 0.2])
def test_a_floor_is_the_widest_plane_below_that_faces_up(tilted: float) -> None:
    """A sheet on the arm, below its box: its top is the floor, not the arm's, which is as wide and above it."""
    plan = template()
    rules = (SiteTemplate("floor", "arm", {"floor_of": "arm"}), SiteTemplate("none", "base", {"floor_of": "crane"}))
    assembly, alignment = machine()
    turn = rotation(0.0, tilted, 0.0)
    turn[:3, 3] = (1.0, 0.0, 0.3)
    assembly = replace(
        assembly,
        shapes={**assembly.shapes, "sheet": box("sheet", (3.0, 2.0, 0.02))},
        parts=(*assembly.parts, Part("CRANE/SHEET", "SHEET", ("CRANE",), "sheet", turn)),
    )
    alignment = replace(alignment, parts=(*alignment.parts, PartAssignment("CRANE/SHEET", None, "arm", 1.0, "test")))
    found = {s.name: s for s in build((assembly, alignment), plan=replace(plan, sites=rules)).sites}
    floor, up = found["floor"], turn[:3, 2]
    assert "none" not in found
    assert floor.z_axis == pytest.approx(tuple(up), abs=1e-9)
    assert floor.x_axis == pytest.approx((up[2], 0.0, -up[0]), abs=1e-9)
    assert (np.array(floor.position) - (1.0, 0.0, 0.3)) @ up == pytest.approx(0.01, abs=1e-9)


@pytest.mark.parametrize("shared", [True, False])
def test_a_row_of_teeth_is_one_edge_however_the_cad_model_shares_their_shape(shared: bool) -> None:
    """Four teeth before the arm's edge: occurrences of one shape, or each drawn on its own, in place and mirrored."""
    assembly, alignment = machine()
    shapes, parts, roles = dict(assembly.shapes), list(assembly.parts), list(alignment.parts)
    for i, y in enumerate((-0.21, -0.07, 0.07, 0.21)):
        turn = rotation(0.0, 0.0, 0.3 * i)
        turn[1] *= -1.0 if i % 2 else 1.0
        at = np.eye(4)
        at[:3, 3] = (2.05, y, 0.96)
        tooth = box("tooth", (0.2, 0.06, 0.02))
        if not shared:
            # the same box in a frame of its own, a hair off as a translator leaves it
            points = np.linalg.inv(turn)[:3, :3] @ (tooth.mesh.points * (1 + 1e-6 * i)).T
            tooth = replace(
                tooth, key=f"tooth{i}", planes=(), mesh=replace(tooth.mesh, points=points.T),
                inertia=turn[:3, :3].T @ tooth.inertia @ turn[:3, :3],
            )  # fmt: skip
            at = at @ turn
        shapes[tooth.key] = tooth
        parts.append(Part(f"CRANE/TOOTH#{i}", f"TOOTH {i}", ("CRANE",), tooth.key, at))
        roles.append(PartAssignment(parts[-1].id, "arm", "arm", 1.0, "made so"))
    made = (replace(assembly, parts=tuple(parts), shapes=shapes), replace(alignment, parts=tuple(roles)))
    (tip,) = (s for s in build(made).sites if s.name == "tip")
    assert tip.position == pytest.approx((2.15, 0.0, 0.95), abs=1e-5)
    assert "TOOTH#0 and 3 like it" in tip.source


def test_twice_the_same_inputs_give_the_same_mechanism() -> None:
    def flat(built: Mechanism) -> str:
        return repr(
            (built.joints, built.cylinders, built.sites, built.findings, [b.inertia.tobytes() for b in built.bodies])
        )

    assert flat(build()) == flat(build())


def test_a_joint_is_where_a_person_says_whatever_is_drawn() -> None:
    """A hinge's given axis goes before its drawn pin, and needs none."""
    assembly, alignment = machine()
    by_hand = replace(
        alignment, axes={"base2arm": ((0.02, 0.0, 1.01), (0.0, -1.0, 0.0))}, by_hand=frozenset({"base2arm"})
    )
    for given_ in (by_hand, without(by_hand, "pin A")):
        joint = build((assembly, given_)).joint("base2arm")
        assert np.allclose(joint.anchor, (0.02, 0.0, 1.01), atol=1e-12)
        assert np.allclose(joint.axis, (0.0, 1.0, 0.0), atol=1e-12)
        assert "set by a person" in str(joint.source["method"])
