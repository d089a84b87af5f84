"""Merged meshes taken apart: solids that touch, and a barrel with its rod in one solid."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from kit.machines.solids import box, lathe, place, tube
from yellowiron.cad import rams_apart, taken_apart, twins_apart, wheels_apart
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.model.assembly import Assembly, DeclaredJoint, Part
from yellowiron.model.geometry import Mesh


def assembly_of(*meshes: Mesh) -> Assembly:
    found = [Occurrence(f"m{k}", (), mesh, np.eye(4)) for k, mesh in enumerate(meshes)]
    return assemble(found, name="x", format="GLB", unit=1.0, path="x.glb")


def merged(*meshes: Mesh) -> Mesh:
    counts = np.cumsum([0, *(len(m.points) for m in meshes)])
    triangles = np.concatenate([m.triangles + c for m, c in zip(meshes, counts[:-1], strict=True)])
    return Mesh(np.concatenate([m.points for m in meshes]), triangles.astype(np.int32))


def moved(mesh: Mesh, *offset: float) -> Mesh:
    return Mesh(mesh.points + np.array(offset), mesh.triangles)


def test_one_mesh_of_many_parts() -> None:
    """Parts that touch come apart; four equal ones are one shape."""
    bolt, block = tube("bolt", 0.01, 0.0, 0.05).mesh, box("block", 0.4, 0.4, 0.1).mesh
    bolts = [moved(bolt, x, y, 0.05) for x in (-0.1, 0.1) for y in (-0.1, 0.1)]
    whole = assembly_of(merged(block, *bolts), moved(block, 0.0, 0.0, 3.0))
    found = taken_apart(whole)
    assert [p.id for p in found.parts] == ["m0/1", "m0/2", "m0/3", "m0/4", "m0/5", "m1"]
    assert len(found.shapes) == 3
    assert [f.code for f in found.findings if f.code == "CAD013"] == ["CAD013"]
    for part, mesh in zip(found.parts[1:5], bolts, strict=True):
        points = found.points_of(part)
        assert np.abs(points.min(axis=0) - mesh.points.min(axis=0)).max() < 1e-6
    assert len(found.shape_of(found.parts[1]).cylinders) == 1


def test_parts_of_one_solid_stay() -> None:
    whole = assembly_of(box("block", 0.4, 0.4, 0.1).mesh)
    assert taken_apart(whole) is whole


def turned(profile: list[tuple[float, float]], count: int) -> trimesh.Trimesh:
    return trimesh.creation.revolve(np.array(profile), sections=count)


def ram(count: int) -> Mesh:
    """A barrel and its rod along z as one solid, an eye across each end: barrel to z = 0.6, rod to 1.1."""
    bar = turned([(0, 0), (0.06, 0), (0.06, 0.6), (0.03, 0.6), (0.03, 1.1), (0, 1.1)], count)
    eyes = [trimesh.creation.annulus(0.03, 0.07, 0.08, sections=count) for _ in range(2)]
    for eye, z in zip(eyes, (-0.04, 1.14), strict=True):
        eye.apply_transform(place((0.0, 0.0, z), (0.0, 1.0, 0.0)))
    joined = trimesh.util.concatenate([bar, *eyes])
    joined.merge_vertices()
    return Mesh(np.asarray(joined.vertices, dtype=np.float64), np.asarray(joined.faces, dtype=np.int32))


@pytest.mark.parametrize("count", [12, 32])
def test_barrel_and_rod_in_one_solid_are_cut_where_the_rod_comes_out(count: int) -> None:
    found = taken_apart(assembly_of(ram(count)))
    bars = [(found.shape_of(p), found.points_of(p)) for p in found.parts]
    spans = sorted((float(q[:, 2].min()), float(q[:, 2].max())) for s, q in bars if s.cylinders[0].length > 0.2)
    assert spans == [pytest.approx((0.0, 0.6), abs=1e-6), pytest.approx((0.6, 1.1), abs=1e-6)]
    assert all(shape.closed for shape, _ in bars)
    area = count / 2 * math.sin(2 * math.pi / count)
    volumes = sorted(s.volume for s, _ in bars if s.cylinders[0].length > 0.2)
    assert volumes == pytest.approx([area * 0.03**2 * 0.5, area * 0.06**2 * 0.6], rel=1e-6)


@pytest.mark.parametrize("out", [0.05, 0.5, 0.9])
def test_one_exact_solid_is_cut_at_any_stroke_if_other_parts_are_its_eyes(out: float) -> None:
    """Barrel to z = 0.6 with a collar, the rod `out` of it."""
    end = 0.62 + out
    profile = [(0, 0), (0.06, 0), (0.06, 0.6), (0.07, 0.6), (0.07, 0.62), (0.03, 0.62), (0.03, end), (0, end)]
    shapes = {"fused": replace(lathe("fused", profile), exact=True), "eye": tube("eye", 0.07, 0.03, 0.08)}
    parts = [Part("ram", "ram", (), "fused", np.eye(4))]
    parts += [Part(f"eye{z:g}", "eye", (), "eye", place((0.0, -0.04, z), (0.0, 1.0, 0.0))) for z in (-0.05, end + 0.05)]
    whole = Assembly("ram", "STEP", 1.0, tuple(parts), shapes)
    found = taken_apart(whole)
    assert [p.id for p in found.parts] == ["ram/1", "ram/2", *(p.id for p in parts[1:])]
    spans = [(float(z.min()), float(z.max())) for p in found.parts[:2] for z in [found.points_of(p)[:, 2]]]
    assert spans == [pytest.approx((0.0, 0.62), abs=1e-5), pytest.approx((0.62, end), abs=1e-5)]
    alone = replace(whole, parts=tuple(parts[:2]))
    assert taken_apart(alone) is alone


@pytest.mark.parametrize(("factor", "left"), [(1.0, 3), (1000.0, 4)])
def test_one_part_that_is_far_away_is_damaged_and_all_that_are_have_another_unit(factor: float, left: int) -> None:
    """Four cubes of 2 m, in metres and in millimetres without a unit; one of them is 5 km away."""
    cube = box("cube", *(2.0 * factor,) * 3).mesh
    placed = []
    for number, x in enumerate((0.0, 3.0, 6.0, 5000.0 if factor == 1.0 else 9.0)):
        place = np.eye(4)
        place[0, 3] = x * factor
        placed.append(Occurrence(f"cube {number}", (), cube, place))
    found = assemble(placed, name="x", format="STL", unit=1.0, path="x.stl")
    assert len(found.parts) == left
    assert [f.code for f in found.findings if f.code in ("CAD003", "CAD004")] == (
        ["CAD003"] if left == 3 else ["CAD004"]
    )


def test_a_small_machine_in_millimetres_keeps_what_is_far_from_its_middle() -> None:
    """Of five cubes in a row three reach less than a kilometre, and are no more the machine than the others."""
    cube = box("cube", 200.0, 200.0, 200.0).mesh
    placed = []
    for number, x in enumerate((0.0, 300.0, 600.0, 1200.0, 2400.0)):
        place = np.eye(4)
        place[0, 3] = x
        placed.append(Occurrence(f"cube {number}", (), cube, place))
    found = assemble(placed, name="x", format="STL", unit=1.0, path="x.stl")
    assert len(found.parts) == 5
    assert [f.code for f in found.findings if f.code.startswith("CAD00")] == ["CAD004"]


def halves(mesh: Mesh) -> Mesh:
    """A mesh and its mirror image, 1 m to the other side of x = 0."""
    points = mesh.points * np.array([-1.0, 1.0, 1.0])
    return merged(moved(mesh, 0.5, 0.0, 0.0), moved(Mesh(points, mesh.triangles[:, ::-1]), -0.5, 0.0, 0.0))


def barrel_and_rod() -> tuple[Mesh, Mesh]:
    """A barrel along z with its eye to one side, and the rod that comes out of it."""
    barrel = merged(tube("barrel", 0.06, 0.0, 0.6).mesh, moved(box("eye", 0.1, 0.1, 0.1).mesh, 0.02, 0.0, -0.06))
    return barrel, moved(tube("rod", 0.03, 0.0, 0.5).mesh, 0.0, 0.0, 0.45)


def test_cylinders_to_the_left_and_to_the_right_come_apart() -> None:
    """Mirrored in the modelling tool: both barrels are one mesh, both rods another one."""
    barrel, rod = barrel_and_rod()
    block = box("block", 0.4, 0.4, 0.1).mesh
    found = twins_apart(assembly_of(block, halves(barrel), halves(rod), merged(block, moved(block, 1.0, 0.0, 0.0))))
    assert [p.id for p in found.parts] == ["m0", "m1/1", "m1/2", "m2/1", "m2/2", "m3"]
    sides = {p.id: float(found.points_of(p)[:, 0].mean()) for p in found.parts if "/" in p.id}
    assert sorted(np.sign(x) for x in sides.values()) == [-1.0, -1.0, 1.0, 1.0]
    assert all(abs(abs(x) - 0.5) < 0.05 for x in sides.values())
    (said,) = (f.message for f in found.findings if f.code == "CAD013")
    assert "left and the right" in said


def test_bars_that_are_no_cylinders_stay_together() -> None:
    """Two rails have no rods in line with them; plates have no bars; what the file itself moves is one body."""
    barrel, rod = barrel_and_rod()
    rails = assembly_of(halves(barrel), box("block", 0.4, 0.4, 0.1).mesh)
    assert twins_apart(rails) is rails
    aside = assembly_of(halves(barrel), moved(halves(rod), 0.0, 0.3, 0.0))
    assert twins_apart(aside) is aside
    both = assembly_of(halves(barrel), halves(rod))
    slide = DeclaredJoint("slide", "prismatic", ("m0", "m1"), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    driven = replace(both, joints=(slide,))
    assert twins_apart(driven) is driven


@pytest.mark.slow
@given(
    radius=st.floats(0.2, 2.0), width=st.floats(0.1, 0.7), track=st.floats(1.4, 4.0), count=st.integers(8, 40),
    axis=st.integers(0, 2),
)  # fmt: skip
def test_wheels_to_the_left_and_to_the_right_come_apart(
    radius: float, width: float, track: float, count: int, axis: int
) -> None:
    """Tyre and rim of two wheels of any proportions that are one mesh, however its axes lie."""
    tyre, rim = (trimesh.creation.cylinder(k * radius, k * width * radius, sections=2 * count) for k in (1.0, 0.6))
    wheel = merged(*(Mesh(np.asarray(m.vertices), np.asarray(m.faces, dtype=np.int32)) for m in (tyre, rim)))
    mirrored = Mesh(wheel.points * [1.0, 1.0, -1.0], wheel.triangles[:, ::-1])
    axle = merged(*(moved(m, 3.0, 1.0, k * 0.5 * track * radius) for m, k in ((wheel, 1), (mirrored, -1))))
    axle = Mesh(np.roll(axle.points, axis + 1, axis=1), axle.triangles)
    found = wheels_apart(assembly_of(axle, box("chassis", 4.0, 1.0, 1.0).mesh))
    assert [p.id for p in found.parts] == ["m0/1", "m0/2", "m1"]
    apart = np.subtract(*(found.points_of(p)[:, axis].mean() for p in found.parts[:2]))
    assert abs(abs(apart) - track * radius) < 1e-3 * radius


def test_what_is_no_pair_of_wheels_stays_together() -> None:
    """Posts are square; a shaft joins both wheels of an axle; unequal wheels are of two axles."""

    def wheel(radius: float) -> Mesh:
        found = trimesh.creation.cylinder(radius, 0.3)
        return Mesh(np.asarray(found.vertices), np.asarray(found.faces, dtype=np.int32))

    def pair(one: Mesh, other: Mesh) -> Mesh:
        return merged(moved(one, 0.0, 0.0, 0.8), moved(other, 0.0, 0.0, -0.8))

    post, shaft = box("post", 0.3, 0.3, 0.6).mesh, trimesh.creation.cylinder(0.05, 1.6)
    joined = merged(pair(wheel(0.5), wheel(0.5)), Mesh(np.asarray(shaft.vertices), np.asarray(shaft.faces, np.int32)))
    for whole in (pair(post, post), joined, pair(wheel(0.5), wheel(0.4)), wheel(0.5)):
        assembly = assembly_of(whole)
        assert wheels_apart(assembly) is assembly


def rest_and_rams(*meshes: Mesh) -> list[tuple[float, float]]:
    """(low, high) along z of the parts of one mesh once its hydraulic cylinders are taken out."""
    found = rams_apart(assembly_of(merged(*meshes)))
    boxes = [(found.points_of(p)[:, 2].min(), found.points_of(p)[:, 2].max()) for p in found.parts]
    return [(round(float(low), 3), round(float(high), 3)) for low, high in boxes]


def plain(count: int = 16) -> Mesh:
    """A barrel with a collar, and its rod, along z as one solid without eyes: the rod comes out at z = 0.7."""
    profile = [(0, 0), (0.06, 0), (0.06, 0.6), (0.07, 0.6), (0.07, 0.7), (0.03, 0.7), (0.03, 1.2), (0, 1.2)]
    bar = turned(profile, count)
    return Mesh(np.asarray(bar.vertices, dtype=np.float64), np.asarray(bar.faces, dtype=np.int32))


def test_hydraulic_cylinders_are_taken_out_of_the_mesh_that_they_are_drawn_into() -> None:
    """In one solid or in two; what is left stays one part, whose bars are no cylinders."""
    boom = merged(box("boom", 0.5, 4.0, 0.5).mesh, moved(tube("pin", 0.05, 0.0, 0.9).mesh, 0.0, 1.5, -0.2))
    whole = rest_and_rams(boom)
    assert len(whole) == 1
    one = rest_and_rams(boom, moved(plain(), 1.0, 0.0, 0.0), moved(plain(), -1.0, 0.0, 0.0))
    assert one == [*whole, (0.0, 0.7), (0.7, 1.2), (0.0, 0.7), (0.7, 1.2)]
    barrel, rod = barrel_and_rod()
    two = rest_and_rams(boom, moved(barrel, 1.0, 0.0, 0.0), moved(rod, 1.0, 0.0, 0.0))
    assert len(two) == 3 and set(two[1:]) == {(0.0, 0.6), (0.45, 0.95)}


def test_a_solid_is_measured_once_however_its_mesh_comes_apart() -> None:
    boom = box("boom", 0.5, 4.0, 0.5).mesh
    barrel, rod = barrel_and_rod()
    whole = assembly_of(merged(boom, moved(barrel, 1.0, 0.0, 0.0), moved(rod, 1.0, 0.0, 0.0)))
    one, other = rams_apart(whole), taken_apart(whole)
    rams = [one.shape_of(part) for part in one.parts[1:]]
    assert len(rams) == 2
    assert all(any(shape is other.shape_of(part) for part in other.parts) for shape in rams)


def test_a_mesh_that_is_a_cylinder_comes_apart() -> None:
    assert rest_and_rams(plain()) == [(0.0, 0.7), (0.7, 1.2)]
    assert [p.id for p in rams_apart(assembly_of(plain())).parts] == ["m0/1", "m0/2"]


@pytest.mark.parametrize(
    "profile",
    [
        # A pin with a step, and an axle that is thin at both ends.
        [(0, 0), (0.06, 0), (0.06, 0.2), (0.03, 0.2), (0.03, 0.3), (0, 0.3)],
        [(0, -0.6), (0.03, -0.6), (0.03, 0), (0.06, 0), (0.06, 0.6), (0.03, 0.6), (0.03, 1.2), (0, 1.2)],
    ],
)
def test_pins_and_axles_are_no_cylinders(profile: list[tuple[float, float]]) -> None:
    bar = turned(profile, 16)
    mesh = Mesh(np.asarray(bar.vertices, dtype=np.float64), np.asarray(bar.faces, dtype=np.int32))
    for whole in (assembly_of(mesh), assembly_of(box("block", 0.4, 0.4, 0.1).mesh, mesh)):
        assert rams_apart(whole) is whole
        assert taken_apart(whole) is whole
