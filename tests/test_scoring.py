"""The rules by which `benchmarks/bench_strangers.py` calls a part, a role and a joint right."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

import strangers_models
from kit.machines.damages import EXTRA, base, damaged
from kit.machines.mixed import one_mesh
from kit.machines.synthetic import Machine
from kit.scene import Surface, TrueJoint, occurrences, true_alignment, true_joints
from kit.scoring import Score, _between_twins, score
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh, Shape
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specifications

LOADER = load_template("wheel_loader")


@dataclass(frozen=True, eq=False)
class Known:
    """A loader and everything that is true of it."""

    machine: Machine
    truth: Surface
    alignment: Alignment
    mechanism: Mechanism
    joints: tuple[TrueJoint, ...]
    height: float

    def score(
        self, alignment: Alignment | None = None, *, assembly: Assembly | None = None, joints: object = None
    ) -> Score:
        chosen = self.joints if joints is None else joints
        return score(
            assembly or self.machine.assembly(), alignment or self.alignment, self.mechanism, self.truth,
            chosen, self.height, LOADER,  # type: ignore[arg-type]
        )  # fmt: skip

    def area(self, body: str) -> float:
        """Of the parts of a body that are no pins."""
        mine = [k for k, (role, b) in enumerate(self.truth.labels) if b == body and not role.endswith("_pin")]
        return float(self.truth.areas[np.isin(self.truth.label, mine)].sum())


@pytest.fixture(scope="module")
def known() -> Known:
    machine = base("loader", 4, "sound")
    template, alignment = true_alignment(machine, "loader", 4)
    mechanism = build_mechanism(machine.assembly(), template, alignment, Specifications(), name="known")
    truth = occurrences(machine, 4, np.eye(4), None)[1]
    joints = tuple(true_joints(machine, "loader", 4, np.eye(4)))
    return Known(machine, truth, alignment, mechanism, joints, float(np.ptp(truth.points[:, 2])))


def changed(alignment: Alignment, body: str, to: str | None, *, told: bool = False) -> Alignment:
    """The alignment with all of a body given to another."""
    parts = [replace(p, role=to, body=to) if p.body == body else p for p in alignment.parts]
    review = tuple(p.part for p in alignment.parts if p.body == body) if told else ()
    return replace(alignment, parts=tuple(parts), to_review=review)


def test_the_truth_is_right(known: Known) -> None:
    found = known.score()
    assert found.right == pytest.approx(found.area, rel=1e-9)
    assert (found.silent, found.flagged, found.roles_silent) == (0.0, 0.0, 0)
    assert found.parts_right == found.parts > 100
    assert found.roles_right == found.roles > 25
    assert found.joints_right == found.joints == len(known.joints)


def test_a_wrong_body_is_its_area_wrong_and_silent_unless_it_is_told(known: Known) -> None:
    silent = known.score(changed(known.alignment, "bucket", "boom"))
    # The pin of link and bucket went with the bucket and is of neither boom nor its neighbours.
    assert silent.area - silent.right == pytest.approx(known.area("bucket"), rel=0.02)
    assert silent.area - silent.right >= known.area("bucket")
    assert silent.silent == pytest.approx(silent.area - silent.right)
    assert silent.roles_silent >= 1
    told = known.score(changed(known.alignment, "bucket", "boom", told=True))
    assert (told.silent, told.roles_silent) == (0.0, 0)
    assert told.flagged > 0.99 * known.area("bucket")
    assert told.right == pytest.approx(silent.right)


def test_a_pin_may_go_with_either_of_its_bodies_but_plays_its_role(known: Known) -> None:
    parts = [replace(p, body="boom", role="boom") if p.role == "boom_pin" else p for p in known.alignment.parts]
    found = known.score(replace(known.alignment, parts=tuple(parts)))
    assert found.right == pytest.approx(found.area, rel=1e-9)
    assert found.roles_right == found.roles - 1
    parts = [replace(p, body="bucket", role="bucket") if p.role == "boom_pin" else p for p in known.alignment.parts]
    assert known.score(replace(known.alignment, parts=tuple(parts))).right < found.area


def test_one_mesh_is_right_as_far_as_it_is_of_its_body(known: Known) -> None:
    whole = one_mesh(known.machine, np.random.default_rng(1))
    part = whole.parts[0].id
    alignment = replace(known.alignment, parts=(PartAssignment(part, "boom", "boom", 0.9, ""),))
    truth = occurrences(whole, 4, np.eye(4), None)[1]
    found = score(whole.assembly(), alignment, None, truth, (), known.height, LOADER)
    assert found.area == pytest.approx(float(truth.areas.sum()), rel=1e-6)
    assert known.area("boom") <= found.right < known.area("boom") + 0.02 * found.area
    assert (found.parts, found.parts_right, found.joints) == (1, 0, 0)


@pytest.mark.parametrize("factor", [1e-3, 0.0254, 1000.0])
def test_another_unit_is_no_fault(known: Known, factor: float) -> None:
    assembly = known.machine.assembly()
    scale = np.diag([factor, factor, factor, 1.0])
    scaled = replace(assembly, parts=tuple(replace(p, transform=scale @ p.transform) for p in assembly.parts))
    joints = [
        replace(j, anchor=tuple(factor * np.array(j.anchor))) for j in known.mechanism.joints
    ]  # fmt: skip
    found = replace(known, mechanism=replace(known.mechanism, joints=tuple(joints))).score(assembly=scaled)
    assert found.right == pytest.approx(found.area, rel=1e-6)
    assert found.joints_right == found.joints


def test_what_was_not_read_is_wrong_and_told(known: Known) -> None:
    gone = {p.part for p in known.alignment.parts if p.body == "bucket"}
    assembly = known.machine.assembly()
    less = replace(assembly, parts=tuple(p for p in assembly.parts if p.id not in gone))
    found = known.score(assembly=less)
    assert found.area - found.right >= known.area("bucket") * (1 - 1e-6)
    assert found.silent == 0.0


@pytest.mark.parametrize(("share", "degrees", "right"), [(0.009, 0, 1), (0.011, 0, 0), (0, 1.9, 1), (0, 2.1, 0)])
def test_an_axis_has_one_per_cent_of_the_height_and_two_degrees(
    known: Known, share: float, degrees: float, right: int
) -> None:
    joint = next(j for j in known.joints if set(j.bodies) == {"boom", "bucket"})
    axis = np.array(joint.axis)
    across = np.cross(axis, (0.0, 0.0, 1.0))
    turn = np.radians(degrees)
    point = np.array(joint.point) + share * known.height * across + 3.0 * axis * (degrees == 0)
    turned = np.cos(turn) * axis + np.sin(turn) * across
    asked = replace(joint, point=tuple(point.tolist()), axis=tuple((-turned).tolist()))
    assert known.score(joints=[asked]).joints_right == right
    assert known.score(joints=[replace(asked, tolerance=0.02 * known.height, degrees=3.0)]).joints_right == 1


def test_a_joint_over_a_third_body_on_its_axis_counts_and_another_pair_does_not(known: Known) -> None:
    hinge = next(j for j in known.mechanism.joints if {j.body0, j.body1} == {"boom", "bucket"})
    third = [replace(hinge, name="a", body0="boom", body1="x"), replace(hinge, name="b", body0="x", body1="bucket")]
    joint = next(j for j in known.joints if set(j.bodies) == {"boom", "bucket"})
    over = replace(known, mechanism=replace(known.mechanism, joints=tuple(third)))
    assert over.score(joints=[joint]).joints_right == 1
    half = replace(known, mechanism=replace(known.mechanism, joints=(third[0],)))
    assert half.score(joints=[joint]).joints_right == 0


def test_a_wheel_may_be_steered_and_roll_over_a_body_that_is_not_drawn(known: Known) -> None:
    hinge = next(j for j in known.mechanism.joints if {j.body0, j.body1} == {"boom", "bucket"})
    rolls = next(j for j in known.joints if set(j.bodies) == {"boom", "bucket"})
    steered = replace(rolls, name="steered", axis=(0.0, 0.0, 1.0))
    over = {"not drawn": 2, "front_frame": 0}
    for between, right in over.items():
        chain = (
            replace(hinge, name="a", body0="boom", body1=between, axis=(0.0, 0.0, 1.0)),
            replace(hinge, name="b", body0=between, body1="bucket"),
        )
        found = replace(known, mechanism=replace(known.mechanism, joints=chain))
        assert found.score(joints=[rolls, steered]).joints_right == right
        # Of a truth without the other joint it has one too many.
        assert found.score(joints=[rolls]).joints_right == 0


def test_a_slide_has_a_place_only_where_it_is_a_hydraulic_cylinders(known: Known) -> None:
    hinge = next(j for j in known.mechanism.joints if {j.body0, j.body1} == {"boom", "bucket"})
    away = tuple((np.array(hinge.anchor) + known.height).tolist())
    for bodies, right in ((("front_frame", "boom"), 1), (("boom_cylinder_barrel_l", "boom_piston_rod_l"), 0)):
        slide = replace(hinge, name="a", type="prismatic", body0=bodies[0], body1=bodies[1], anchor=away)
        found = replace(known, mechanism=replace(known.mechanism, joints=(slide,)))
        asked = TrueJoint("a", "prismatic", bodies, hinge.anchor, hinge.axis)
        assert found.score(joints=[asked]).joints_right == right


def test_twins_are_one_where_they_were_found_as_one_and_not_where_their_feet_may_be_of_the_frame() -> None:
    left, right = (
        TrueJoint(f"foot_{s}", "revolute", ("main_frame", f"barrel_{s}"), (0.0, y, 0.0), (0.0, 1.0, 0.0))
        for s, y in (("l", 1.0), ("r", -1.0))
    )
    apart = {"barrel_l": {"barrel_l", "main_frame"}, "barrel_r": {"barrel_r", "main_frame"}}
    as_one = {"barrel_l": {"barrel"}, "barrel_r": {"barrel"}}
    assert _between_twins(left, [left, right], apart).point == (0.0, 1.0, 0.0)
    assert _between_twins(left, [left, right], as_one).point == (0.0, 0.0, 0.0)


def test_what_is_no_part_of_the_machine_is_right_outside_it() -> None:
    machine = damaged("loader", 4, "ground")
    truth = occurrences(machine, 4, np.eye(4), None)[1]
    known = [PartAssignment(i, r, None if b == EXTRA else b, 1.0, "") for i, (r, b) in machine.truth.items()]
    found = score(
        machine.assembly(), Alignment("wheel_loader", np.eye(4), tuple(known)), None, truth, (), 1.0, LOADER
    )  # fmt: skip
    assert found.right == pytest.approx(found.area, rel=1e-9)
    known = [PartAssignment(i, r, "rear_frame" if b == EXTRA else b, 1.0, "") for i, (r, b) in machine.truth.items()]
    found = score(
        machine.assembly(), Alignment("wheel_loader", np.eye(4), tuple(known)), None, truth, (), 1.0, LOADER
    )  # fmt: skip
    assert found.silent == pytest.approx(found.area, rel=1e-9)
    assert found.right == pytest.approx(found.area, rel=1e-9)
    assert found.parts_right == found.parts - 1


# ---- labels ----


def two_blocks(name: str, x: float) -> tuple[Part, Shape]:
    """A part of two unit cubes, one at `x`, one at `x` + 3."""
    import trimesh

    solid = trimesh.util.concatenate([trimesh.creation.box(transform=np.array(
        [[1, 0, 0, x + d], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])) for d in (0, 3)])  # fmt: skip
    mesh = Mesh(np.asarray(solid.vertices), np.asarray(solid.faces, dtype=np.int32))
    shape = Shape(name, name, mesh, 2.0, 12.0, np.zeros(3), np.eye(3))
    return Part(f"world/{name}", name, ("world",), name, np.eye(4)), shape


def labelled() -> tuple[Assembly, Surface]:
    rows = [two_blocks("a", 0.0), two_blocks("b", 10.0), two_blocks("c", 20.0)]
    assembly = Assembly("m", "glb", 1.0, tuple(p for p, _ in rows), {p.shape: s for p, s in rows})
    cube = {"centre": [3, 0, 0], "extent": [1, 1, 1], "body": "boom_piston_rod", "alternatives": ["arm[2]"]}
    labels = {
        "parts": {
            "world/a": {"role": "barrel", "body": "boom_cylinder_barrel", "fused": [cube]},
            "world/b": {"role": "link", "body": "tipping_link_l", "alternatives": ["bucket_link"]},
            "world/c": {"role": "pin", "body": "bucket_link", "alternatives": ["tipping_link"], "with": "world/b"},
        },
        "joints": {},
    }
    model = strangers_models.Model("m", labels, None)
    entries = list(strangers_models._entries(model, assembly, load_template("excavator")))
    return assembly, strangers_models._surface(assembly, entries)


def test_what_is_no_part_of_the_machine_may_have_alternatives() -> None:
    """A collider's box is right left out, or with the body that it is the collider of, and wrong elsewhere."""
    rows = [two_blocks("a", 0.0), two_blocks("b", 10.0)]
    assembly = Assembly("m", "glb", 1.0, tuple(p for p, _ in rows), {p.shape: s for p, s in rows})
    parts = {"world/a": {"body": "boom"}, "world/b": {"body": None, "alternatives": ["arm"]}}
    template = load_template("excavator")
    model = strangers_models.Model("m", {"parts": parts, "joints": {}}, None)
    truth = strangers_models._surface(assembly, list(strangers_models._entries(model, assembly, template)))
    for body, silent in ((None, 0.0), ("arm", 0.0), ("boom", 12.0)):
        alignment = Alignment("excavator", np.eye(4), (
            PartAssignment("world/a", "boom", "boom", 1.0, ""), PartAssignment("world/b", body, body, 1.0, ""),
        ))  # fmt: skip
        found = score(assembly, alignment, None, truth, (), 1.0, template)
        assert (found.right, found.silent) == (pytest.approx(12.0), pytest.approx(silent))


def test_a_carrier_is_no_carrier_roller() -> None:
    """What runs along tracks is not scored; what slews on a crane's carrier is."""
    line = {"type": "revolute", "anchor": [0, 0, 0], "axis": [0, 0, 1]}
    pairs = {"slew": ("carrier", "superstructure"), "rolls": ("undercarriage", "carrier_roller_l[0]")}
    joints = {name: {**line, "parent": a, "child": b} for name, (a, b) in pairs.items()}
    model = strangers_models.Model("m", {"parts": {}, "joints": joints}, None)
    assert [j.name for j in strangers_models._joints(model, load_template("mobile_crane"))] == ["slew"]


def aligned(**bodies: str) -> Alignment:
    parts = [PartAssignment(f"world/{n.replace('_', '/')}", b, b, 1.0, "") for n, b in bodies.items()]
    return Alignment("excavator", np.eye(4), tuple(parts))


@pytest.mark.parametrize(
    ("bodies", "right"),
    [
        ({"a": "boom_cylinder_barrel", "b": "tipping_link", "c": "tipping_link"}, 36.0),
        ({"a": "boom_cylinder_barrel", "b": "bucket_link", "c": "bucket_link"}, 36.0),
        ({"a": "boom_cylinder_barrel", "b": "tipping_link", "c": "bucket_link"}, 24.0),
        ({"a": "boom_piston_rod", "b": "arm", "c": "bucket_link"}, 12.0),
    ],
)
def test_labels_allow_alternatives_and_bind_parts_to_each_other(bodies: dict[str, str], right: float) -> None:
    assembly, truth = labelled()
    found = score(assembly, aligned(**bodies), None, truth, (), 1.0, load_template("excavator"))
    assert (found.area, found.right) == (pytest.approx(36.0), pytest.approx(right))


def test_a_fused_mesh_that_was_taken_apart_is_judged_by_its_shells() -> None:
    assembly, truth = labelled()
    mesh = assembly.shapes["a"].mesh
    rows = [mesh.triangles[mesh.points[mesh.triangles][:, :, 0].mean(axis=1) < 2.0],
            mesh.triangles[mesh.points[mesh.triangles][:, :, 0].mean(axis=1) > 2.0]]  # fmt: skip
    shapes = {
        f"a{k}": replace(assembly.shapes["a"], key=f"a{k}", mesh=Mesh(mesh.points, r)) for k, r in enumerate(rows)
    }
    halves = [replace(assembly.parts[0], id=f"world/a/{k + 1}", shape=f"a{k}") for k in range(2)]
    apart = replace(assembly, parts=(*halves, *assembly.parts[1:]), shapes={**assembly.shapes, **shapes})
    for body, right in (("boom_piston_rod", 36.0), ("arm", 36.0), ("boom_cylinder_barrel", 30.0)):
        alignment = aligned(a_1="boom_cylinder_barrel", a_2=body, b="tipping_link", c="tipping_link")
        found = score(apart, alignment, None, truth, (), 1.0, load_template("excavator"))
        assert (found.area, found.right) == (pytest.approx(36.0), pytest.approx(right))


def test_nameless_models_keep_the_shape_of_their_tree() -> None:
    assembly = labelled()[0]
    bare = strangers_models.nameless(assembly)
    assert [p.name for p in bare.parts] == ["Object_000", "Object_001", "Object_002"]
    assert {p.path for p in bare.parts} == {("Node_001",)}
    assert len({p.id for p in bare.parts}) == 3
