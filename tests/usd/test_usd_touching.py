"""Few colliders a body: what is left out, what is merged, what a user told, and the details of it in the file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from pxr import Usd, UsdGeom, UsdPhysics
from usd_shapes import at, make_shape, open_box

from yellowiron.exporters import export_mjcf, read_geometry
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Shape
from yellowiron.model.mechanism import Body, BodyPart, Joint, Mechanism
from yellowiron.model.template import Material
from yellowiron.support.convex.solids import CORNERS, uncovered
from yellowiron.usd import count_colliders, read_mechanism, write_machine
from yellowiron.usd.planning.plan import make_plan
from yellowiron.usd.planning.touching import EDGE, FINE, size_of

BODIES = {
    "frame": [
        ("plate", "box", at(0.0, 0.0, 0.0) @ np.diag([3.0, 1.0, 0.1, 1.0])),
        ("plate", "box", at(0.0, 0.0, 0.1) @ np.diag([3.0, 1.0, 0.1, 1.0])),
        ("engine", "box", at(-0.8, 0.0, 0.5) @ np.diag([0.6, 0.6, 0.5, 1.0])),
        ("hood", "box", at(-0.8, 0.0, 0.6) @ np.diag([1.0, 0.9, 0.9, 1.0])),
        ("bolt", "ball", at(0.5, 0.3, 0.16) @ np.diag([0.03, 0.03, 0.03, 1.0])),
        ("bolt", "ball", at(0.5, -0.3, 0.16) @ np.diag([0.03, 0.03, 0.03, 1.0])),
        ("boss", "box", at(1.4, 0.0, 0.4) @ np.diag([0.3, 0.6, 0.6, 1.0])),
        ("bin", "bin", at(0.4, 0.0, 0.6)),
        ("tooth", "box", at(1.53, 0.0, 0.1) @ np.diag([0.05, 0.3, 0.08, 1.0])),
    ],
    "barrel": [("tube", "box", at(2.6, 0.0, 0.4) @ np.diag([1.6, 0.3, 0.3, 1.0]))],
    "rod": [
        ("piston", "box", at(2.0, 0.0, 0.4) @ np.diag([0.2, 0.2, 0.2, 1.0])),
        ("rod", "box", at(3.1, 0.0, 0.4) @ np.diag([2.0, 0.1, 0.1, 1.0])),
        ("eye", "box", at(4.2, 0.0, 0.4) @ np.diag([0.3, 0.2, 0.3, 1.0])),
    ],
    "arm": [
        ("beam", "box", at(4.2, 0.0, 0.9) @ np.diag([0.1, 0.8, 1.4, 1.0])),
        ("pin", "box", at(4.2, 0.0, 0.4) @ np.diag([0.08, 0.18, 0.08, 1.0])),
    ],
}
JOINTS = (
    Joint("mount", "fixed", "frame", "barrel", (1.6, 0.0, 0.4), (0.0, 1.0, 0.0)),
    Joint("slide", "prismatic", "barrel", "rod", (2.0, 0.0, 0.4), (1.0, 0.0, 0.0), -0.05, 1.2),
    Joint("pin", "revolute", "rod", "arm", (4.2, 0.0, 0.4), (0.0, 1.0, 0.0), -0.5, 0.5),
)


def machine(*, pooled: bool = True, alone: tuple[str, ...] = ()) -> tuple[Mechanism, Assembly]:
    shapes: dict[str, Shape] = {
        "box": make_shape("box", trimesh.creation.box((1.0, 1.0, 1.0))),
        "ball": make_shape("ball", trimesh.creation.icosphere(subdivisions=4, radius=1.0)),
        "bin": open_box("bin"),
    }
    parts, bodies = [], []
    for body, drawn in BODIES.items():
        own = []
        for number, (name, shape, place) in enumerate(drawn):
            parts.append(Part(f"{body}/{name}{number}", name, (body,), shapes[shape].key, place))
            token = "convexDecomposition" if shape == "bin" else "convexHull"
            own.append(BodyPart(parts[-1].id, body, "", token, 1.0, pooled=pooled and name not in alone))
        bodies.append(Body(body, (1.0, 0.0, 0.0), 10.0, (1.0, 0.0, 0.0), np.eye(3), tuple(own), np.zeros((0, 3))))
    made = {s.key: s for s in shapes.values()}
    return Mechanism("m", "m", "frame", tuple(bodies), JOINTS), Assembly("M", "step", 1.0, tuple(parts), made)


@pytest.fixture(scope="module")
def full() -> dict[str, list]:
    mechanism, assembly = machine()
    plan = make_plan(mechanism, assembly, np.eye(4), "m")
    return {body: [one.data for one in solids] for body, solids in plan.solids["full"].items()}


def test_what_is_covered_is_left_out(full: dict[str, list]) -> None:
    stood_for = {part.split("/")[1][:-1] for solids in full.values() for one in solids for part in one.parts}
    assert stood_for == {"plate", "hood", "boss", "bin", "tooth", "tube", "rod", "eye", "beam"}


def test_a_body_that_its_neighbours_cover_keeps_its_largest() -> None:
    mechanism, assembly = machine()
    inside = [part for part in assembly.parts if part.name == "piston"]
    rod = next(body for body in mechanism.bodies if body.name == "rod")
    alone = replace(rod, parts=tuple(p for p in rod.parts if p.part == inside[0].id))
    bodies = tuple(alone if body is rod else body for body in mechanism.bodies)
    plan = make_plan(replace(mechanism, bodies=bodies), assembly, np.eye(4), "m")
    assert [one.label for one in (s.data for s in plan.solids["full"]["rod"])] == ["piston"]


def test_what_is_nearly_one_is_merged(full: dict[str, list]) -> None:
    (plates,) = [one for one in full["frame"] if one.label == "plate"]
    assert len(plates.parts) == 2
    assert np.allclose(np.ptp(plates.solid.corners, axis=0), (3.0, 1.0, 0.2))


def test_colliders_are_near_what_is_drawn_and_the_outline_is_kept(full: dict[str, list]) -> None:
    mechanism, assembly = machine(pooled=False)
    plan = make_plan(mechanism, assembly, np.eye(4), "m")
    for body, placed in plan.parts.items():
        solids = [one.solid for one in full[body]]
        for part in placed:
            if part.part.name in ("piston", "pin"):
                continue  # in its neighbour
            points = part.prototype.shape.mesh.points @ part.matrix[:3, :3].T + part.matrix[:3, 3]
            assert not uncovered(points, solids, FINE * size_of(full[body]) + 1e-9).any()
        if body == "frame":
            tip = np.concatenate([solid.corners for solid in solids])[:, 0].max()
            assert tip == pytest.approx(1.555 - 1.0, abs=EDGE)
        assert all(len(solid.corners) <= CORNERS for solid in solids)


def test_the_bin_stays_hollow_in_every_detail() -> None:
    mechanism, assembly = machine()
    plan = make_plan(mechanism, assembly, np.eye(4), "m")
    inside = np.array([(0.4 + x - 1.0, y, 0.75) for x in (-0.2, 0.0, 0.2) for y in (-0.5, 0.0, 0.5)])
    for detail in ("full", "light"):
        assert uncovered(inside, [one.data.solid for one in plan.solids[detail]["frame"]], 0.0).all()


def test_light_is_fewer_and_simple(tmp_path: Path) -> None:
    mechanism, assembly = machine()
    file = write_machine(mechanism, assembly, tmp_path, name="m")[0]
    counts = count_colliders(file)
    assert set(counts) == set(BODIES)
    assert all(0 < each["light"] <= each["full"] for each in counts.values())
    assert sum(each["light"] for each in counts.values()) < sum(each["full"] for each in counts.values())
    light = read_geometry(file, detail="light")
    assert {c.kind for c in light.bodies["rod"].colliders} == {"box"}
    assert not any(body.colliders for body in read_geometry(file, detail="visual").bodies.values())
    assert sum(len(b.colliders) for b in read_geometry(file).bodies.values()) == sum(c["full"] for c in counts.values())


def test_simple_shapes_reach_no_farther_down() -> None:
    mechanism, assembly = machine()
    plan = make_plan(mechanism, assembly, np.eye(4), "m")
    simple = 0
    for solids in plan.solids["light"].values():
        for one in solids:
            if one.data.primitive is not None:
                assert one.data.primitive.surface()[:, 2].min() >= one.data.solid.low[2] - EDGE - 1e-9
                simple += 1
    assert simple


def test_only_what_rubs_alike_is_merged() -> None:
    mechanism, assembly = machine()
    frame = mechanism.bodies[0]
    materials = {name: Material(name, 7850.0, dynamic_friction=rub) for name, rub in (("steel", 0.5), ("rubber", 0.9))}
    parts = tuple(replace(p, material="rubber" if n == 0 else "steel") for n, p in enumerate(frame.parts))
    told = replace(mechanism, bodies=(replace(frame, parts=parts), *mechanism.bodies[1:]), materials=materials)
    plan = make_plan(told, assembly, np.eye(4), "m")
    plates = [one.data for one in plan.solids["full"]["frame"] if one.data.label.startswith("plate")]
    assert sorted(one.material for one in plates) == ["rubber", "steel"]
    same = replace(told, materials=dict.fromkeys(materials, materials["steel"]))
    plan = make_plan(same, assembly, np.eye(4), "m")
    assert len([one for one in plan.solids["full"]["frame"] if one.data.label.startswith("plate")]) == 1


def test_the_file_says_which_parts_a_collider_stands_for(tmp_path: Path) -> None:
    mechanism, assembly = machine()
    stage = Usd.Stage.Open(str(write_machine(mechanism, assembly, tmp_path, name="m")[0]))
    for prim in stage.Traverse():
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            said = prim.GetCustomDataByKey("yellowiron")
            assert said["kind"] == "collider"
            assert set(said["parts"]) <= {part.id for part in assembly.parts}
            assert UsdGeom.Imageable(prim).ComputePurpose() == "guide"


def test_what_a_user_told_collides_as_told(tmp_path: Path) -> None:
    mechanism, assembly = machine(alone=("bolt",))
    file = write_machine(mechanism, assembly, tmp_path, name="m")[0]
    stage = Usd.Stage.Open(str(file))
    bolts = [p for p in stage.Traverse() if p.GetName().startswith("bolt") and p.HasAPI(UsdPhysics.CollisionAPI)]
    assert len(bolts) == 2
    assert read_mechanism(file).bodies[0].parts == mechanism.bodies[0].parts


def test_mjcf_in_light_detail_has_nothing_else_to_see(tmp_path: Path) -> None:
    import mujoco

    mechanism, assembly = machine()
    file = write_machine(mechanism, assembly, tmp_path / "usd", name="m")[0]
    models = {
        detail: mujoco.MjModel.from_xml_path(
            str(export_mjcf(mechanism, read_geometry(file, detail=detail), tmp_path / detail))
        )
        for detail in ("full", "light")
    }
    seen = {detail: int(np.sum(model.geom_contype == 0)) for detail, model in models.items()}
    assert seen["full"] == sum(map(len, BODIES.values())) and seen["light"] == 0
    assert set(models["light"].geom_group.tolist()) == {2}


def test_shoes_and_what_they_run_on_collide_as_told() -> None:
    mechanism, assembly = machine()
    ring = replace(mechanism, floating=("rod",))
    plan = make_plan(ring, assembly, np.eye(4), "m")
    assert all(part.collides for part in plan.parts["rod"])
    assert not plan.solids["full"]["rod"] and plan.solids["full"]["frame"]
