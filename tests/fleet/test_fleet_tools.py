"""Another machine's tool in a variant: its shape, mass and sites, where the drawn one is, in every engine's file."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kit.machines import small_machine
from yellowiron.checks import check
from yellowiron.exporters import export, read_geometry
from yellowiron.exporters.geometry import BodyGeometry, Collider
from yellowiron.fleet import vary
from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.variants import spec_of
from yellowiron.kinematics import complete
from yellowiron.usd import read_mechanism, write_machine

AWAY = np.array([0.25, 0.0, 0.1])
"""Where the other machine stands in its file."""
OFF = np.array([0.0, 0.03, 0.0])
"""How far its boom's frame is from where the drawn boom's is, seen from the pins."""
WIDE = 1.6


def write_other(folder: Path, *, off: np.ndarray = OFF) -> Path:
    """The small loader elsewhere, under another name, with a wider shell and a heavier boom in a frame of its own."""
    made, assembly = small_machine.make()
    wide = small_machine.shape("WIDE SHELL", small_machine.open_box(1.0, WIDE, 0.5, 0.02))
    parts = []
    for part in assembly.parts:
        matrix = part.transform.copy()
        matrix[:3, 3] += AWAY
        shape = wide.key if part.name == "SHELL" else part.shape
        parts.append(replace(part, transform=matrix, shape=shape))

    def moved(point: Any) -> Any:
        return tuple((np.asarray(point) + AWAY).tolist())

    bodies = []
    for body in made.bodies:
        boom = body.name == "boom"
        bodies.append(replace(
            body, origin=moved(body.origin + off if boom else body.origin), center_of_mass=moved(body.center_of_mass),
            hull=body.hull + AWAY, mass=950.0 if boom else body.mass,
        ))  # fmt: skip
    sites = [replace(s, position=moved(np.add(s.position, (0.1, 0.0, 0.0)))) for s in made.sites]
    joints = [replace(joint, anchor=moved(joint.anchor)) for joint in made.joints]
    machine = replace(made, name="digger", bodies=tuple(bodies), joints=tuple(joints), sites=tuple(sites))
    whole = replace(assembly, parts=tuple(parts), shapes={**assembly.shapes, wide.key: wide})
    return write_machine(complete(machine), whole, folder, name="digger")[0]


@pytest.fixture(scope="module")
def machines(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The small loader, and one with another tool."""
    folder = tmp_path_factory.mktemp("machines")
    return small_machine.write(folder / "loader"), write_other(folder / "other")


def parameters(folder: Path, other: Path, **more: Any) -> Path:
    path = folder / "variants.json"
    tool = {"vary": "tool", "of": "boom", "value": {"choice": ["wide"]}, "tools": {"wide": {"machine": str(other)}}}
    path.write_text(json.dumps({"parameters": {**more, "tool": tool}}))
    return path


def extents(colliders: tuple[Collider, ...]) -> np.ndarray:
    """The box (2, 3) of the meshes among colliders, in their body."""
    points = [
        each.mesh.points @ each.matrix[:3, :3].T + each.matrix[:3, 3] for each in colliders if each.mesh is not None
    ]
    return np.array([np.concatenate(points).min(axis=0), np.concatenate(points).max(axis=0)])


def boom_of(file: Path, detail: str = "full") -> BodyGeometry:
    return read_geometry(file, detail=detail).bodies["boom"]


@pytest.mark.parametrize("detail", ["full", "light"])
def test_a_tool_looks_and_collides_as_its_machine_s(machines: tuple[Path, Path], tmp_path: Path, detail: str) -> None:
    base, other = machines
    made = vary(base, parameters(tmp_path, other), tmp_path / "out", count=1, jobs=1)
    file = tmp_path / "out" / made.files[0]
    wanted, found, drawn = (boom_of(each, detail) for each in (other, file, tmp_path / "out/base" / base.name))
    assert len(found.visuals) == len(wanted.visuals)
    assert len(found.colliders) == len(wanted.colliders)
    assert extents(found.colliders) == pytest.approx(extents(wanted.colliders) + OFF, abs=1e-6)
    assert np.ptp(extents(found.colliders), axis=0)[1] == pytest.approx(WIDE, abs=0.02)
    assert np.ptp(extents(drawn.colliders), axis=0)[1] == pytest.approx(1.2, abs=0.02)
    seen = [np.ptp(visual.mesh.points, axis=0)[1] for visual in found.visuals]
    assert max(seen) == pytest.approx(WIDE, abs=1e-6)
    assert {each.friction for each in found.colliders} == {0.5}
    # Of what is not the tool, nothing has changed.
    rest = read_geometry(file, detail=detail).bodies
    before = read_geometry(base, detail=detail).bodies
    assert {n: len(b.colliders) for n, b in rest.items() if n != "boom"} == {
        n: len(b.colliders) for n, b in before.items() if n != "boom"
    }


def test_a_tool_is_read_back_with_its_mass_parts_hull_and_sites(machines: tuple[Path, Path], tmp_path: Path) -> None:
    base, other = machines
    load = {"vary": "payload", "value": "100 kg"}
    made = vary(base, parameters(tmp_path, other, load=load), tmp_path / "out", count=1, jobs=1)
    drawn, tool, found = (read_mechanism(each) for each in (base, other, tmp_path / "out" / made.files[0]))
    body = found.body("boom")
    # The payload is in the tool that is there, though it is said first.
    assert body.mass == pytest.approx(1050.0)
    own, at = np.asarray(tool.body("boom").center_of_mass) - AWAY, np.array([3.0, 0.0, 1.5])
    assert body.center_of_mass == pytest.approx(tuple((950.0 * own + 100.0 * at) / 1050.0), abs=1e-6)
    assert [part.part for part in body.parts] == [part.part for part in tool.body("boom").parts]
    assert np.ptp(body.hull, axis=0) == pytest.approx(np.ptp(tool.body("boom").hull, axis=0), abs=1e-6)
    assert {s.name: s.position for s in found.sites}["load"] == pytest.approx(tuple(at), abs=1e-9)
    assert [b.name for b in found.bodies] == [b.name for b in drawn.bodies]
    assert [j.name for j in found.joints] == [j.name for j in drawn.joints]
    assert [s.name for s in found.sites] == [s.name for s in drawn.sites]
    told = {(finding.code, finding.severity) for finding in check(base)}
    assert {(finding.code, finding.severity) for finding in check(tmp_path / "out" / made.files[0])} <= told
    assert (tmp_path / "out" / made.files[0]).stat().st_size < 20_000


def test_without_physics_a_tool_is_only_seen(machines: tuple[Path, Path], tmp_path: Path) -> None:
    from pxr import Usd, UsdPhysics

    base, other = machines
    made = vary(base, parameters(tmp_path, other), tmp_path / "out", count=1, jobs=1)
    stage = Usd.Stage.Open(str(tmp_path / "out" / made.files[0]))
    root = stage.GetDefaultPrim()
    assert any(prim.HasAPI(UsdPhysics.CollisionAPI) for prim in Usd.PrimRange(root.GetChild("boom")))
    root.GetVariantSet("Physics").SetVariantSelection("off")
    assert not any(prim.HasAPI(UsdPhysics.CollisionAPI) for prim in Usd.PrimRange(root.GetChild("boom")))


def test_mjcf_has_the_tool_that_the_layer_has(machines: tuple[Path, Path], tmp_path: Path) -> None:
    import mujoco

    base, other = machines
    grip = {"vary": "friction", "of": "steel", "value": 0.3}
    said = parameters(tmp_path, other, load={"vary": "payload", "value": "100 kg"}, grip=grip)
    layer = tmp_path / "usd" / vary(base, said, tmp_path / "usd", count=1, jobs=1).files[0]
    delta = tmp_path / "mjcf" / vary(base, said, tmp_path / "mjcf", count=1, to="mjcf", jobs=1).files[0]
    path = export(read_mechanism(layer), layer, tmp_path / "full", to="mjcf")
    wanted, made = mujoco.MjModel.from_xml_path(str(path)), spec_of(delta).compile()
    for name in ("body_mass", "body_ipos", "site_pos", "nbody", "njnt", "nu", "neq"):
        assert np.allclose(getattr(made, name), getattr(wanted, name), rtol=1e-5, atol=1e-6), name
    boxes = []
    for model in (wanted, made):
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        boom = model.body("boom").id
        touching = [g for g in range(model.ngeom) if model.geom_bodyid[g] == boom and model.geom_contype[g]]
        assert np.allclose(model.geom_friction[touching, 0], 0.3)
        centres = data.geom_xpos[touching]
        boxes.append((len(touching), sorted(centres.round(6).tolist()), model.geom_rbound[touching].max().round(6)))
    assert boxes[0] == boxes[1]
    assert delta.stat().st_size < 20_000


def test_a_tool_of_another_linkage_is_refused(machines: tuple[Path, Path], tmp_path: Path) -> None:
    base, _ = machines
    made, assembly = small_machine.make()
    joints = tuple(
        replace(joint, anchor=(joint.anchor[0], 0.0, joint.anchor[2] + 0.05)) if joint.name == "boom_joint" else joint
        for joint in made.joints
    )
    other = write_machine(complete(replace(made, joints=joints)), assembly, tmp_path / "far", name="far")[0]
    with pytest.raises(UnusableError, match=r"pins are elsewhere, by 2\d mm"):
        vary(base, parameters(tmp_path, other), tmp_path / "out", count=1, jobs=1)
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "newton", "physx"])
def test_an_engine_drives_a_machine_with_the_tool(machines: tuple[Path, Path], tmp_path: Path, engine: str) -> None:
    import yellowiron
    from yellowiron.simulation import installed_engines

    if engine not in installed_engines():
        pytest.skip(f"{engine} is not installed")
    base, other = machines
    made = vary(base, parameters(tmp_path, other), tmp_path / "out", count=1, jobs=1)
    document = yellowiron.simulate(tmp_path / "out" / made.files[0], engine=engine)
    before = {finding["code"] for finding in yellowiron.simulate(base, engine=engine)["findings"]}
    assert {finding["code"] for finding in document["findings"]} <= before
    assert document["branches_kept"]
