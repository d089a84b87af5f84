"""Machines of which one half is drawn: where they are cut, and what their mirror image makes of them."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from kit.machines.damages import damaged
from kit.scene import placed, read
from yellowiron.cad import completed, half_of, mirrored
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.cad.mesh.features import facets
from yellowiron.cad.mesh.measures import is_closed
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Mesh

BOXES = ((4.0, 1.2, 0.6), (2.0, 1.0, 1.5), (3.0, 0.4, 0.5), (1.0, 1.6, 0.8), (1.5, 0.7, 0.3))
"""Extents of what stands across the middle plane."""


def model(meshes: list[trimesh.Trimesh], place: np.ndarray) -> Assembly:
    placed = [
        Occurrence(f"part {k}", (), Mesh(np.asarray(m.vertices), np.asarray(m.faces, dtype=np.int32)), place)
        for k, m in enumerate(meshes)
    ]
    return assemble(placed, name="model", format="test", unit=1.0, path="model")


def boxes(*, cut: bool, capped: bool = False) -> list[trimesh.Trimesh]:
    """Five boxes across the plane y = 0, or what is left (y > 0) of them, and a wheel beside them."""
    meshes = []
    for k, extents in enumerate(BOXES):
        middle = np.array((0.7 * k, 0.0, 0.9 * k))
        if cut and capped:
            low, high = middle - 0.5 * np.array(extents) * (1, 0, 1), middle + 0.5 * np.array(extents)
            box = trimesh.creation.box(bounds=(low, high)).subdivide()
        else:
            box = trimesh.creation.box(extents).apply_translation(middle).subdivide()
        if cut and not capped:
            box = trimesh.intersections.slice_mesh_plane(box, (0, 1, 0), (0, 0, 0))
        meshes.append(box)
    wheel = trimesh.creation.cylinder(0.4, 0.3, sections=24).apply_transform(
        trimesh.transformations.rotation_matrix(np.pi / 2, (1, 0, 0))
    )
    return [*meshes, wheel.apply_translation((0.0, 1.1, 0.0))]


def turned(axis: int, sign: int, shift: float) -> np.ndarray:
    """A frame in which the boxes' y is an axis of the file, either way."""
    place = np.zeros((4, 4))
    place[axis, 1] = sign
    place[(axis + 1) % 3, 2] = 1.0
    place[(axis + 2) % 3, 0] = sign
    place[3, 3] = 1.0
    place[:3, 3] = shift
    return place


@given(st.integers(0, 2), st.sampled_from((1, -1)), st.floats(-5.0, 5.0), st.booleans())
@settings(max_examples=25, deadline=None)
def test_a_half_is_found_whichever_way_it_stands(axis: int, sign: int, shift: float, capped: bool) -> None:
    place = turned(axis, sign, shift)
    half = half_of(model(boxes(cut=True, capped=capped), place))
    assert half is not None
    assert (half.axis, half.side) == (axis, sign)
    assert half.at == pytest.approx(shift, abs=1e-6)
    assert len(half.cut) == len(BOXES)


@given(st.floats(-5.0, 5.0), st.booleans())
@settings(max_examples=10, deadline=None)
def test_a_completed_half_is_the_whole(shift: float, capped: bool) -> None:
    place = turned(1, 1, shift)
    drawn = model(boxes(cut=True, capped=capped), place)
    half = half_of(drawn)
    assert half is not None
    whole, true = completed(drawn, half), model(boxes(cut=False), place)
    assert len(whole.parts) == len(true.parts) + 1  # the wheel's image
    for part, other in zip(whole.parts, true.parts, strict=False):
        mesh = whole.shape_of(part).mesh
        assert is_closed(mesh)
        assert whole.shape_of(part).volume == pytest.approx(true.shape_of(other).volume, rel=1e-6)
        for end in (np.min, np.max):
            assert end(whole.points_of(part), axis=0) == pytest.approx(end(true.points_of(other), axis=0), abs=1e-6)
    image = whole.parts[-1]
    wheel = next(p for p in whole.parts if p.id + " (mirror image)" == image.id)
    flipped = whole.points_of(wheel) * (1, -1, 1) + (0, 2.0 * half.at, 0)
    assert whole.points_of(image) == pytest.approx(flipped, abs=1e-9)


def test_whole_machines_are_not_halves() -> None:
    assert half_of(model(boxes(cut=False), np.eye(4))) is None
    with pytest.raises(CadError, match="No half of a machine is drawn"):
        mirrored(model(boxes(cut=False), np.eye(4)))


HEIGHTS = (0.5, 1.0, 2.0, 1.2, 0.7, 1.6)


def test_what_stands_on_the_ground_is_no_half() -> None:
    """Boxes end in one plane with their flat faces, as halves do; but these are alike to the left and the right."""
    left = [
        trimesh.creation.box((1.0, 0.8, h)).apply_translation((1.5 * k, 0.9, 0.5 * h)) for k, h in enumerate(HEIGHTS)
    ]
    right = [m.copy().apply_translation((0.0, -1.8, 0.0)) for m in left]
    assert half_of(model([*left, *right], np.eye(4))) is None
    # Of what is lopsided too nothing tells: being alike is what decided.
    askew = [m.copy().apply_translation((0.0, 0.3 * k, 0.0)) for k, m in enumerate(left)]
    assert half_of(model(askew, np.eye(4))) is not None


def test_where_parts_end_from_both_sides_there_is_no_half() -> None:
    beyond = [
        trimesh.creation.box((1.0, 0.5, h)).apply_translation((1.5 * k, -0.25, 0.5 * h))
        for k, h in enumerate(HEIGHTS[:3])
    ]
    assert half_of(model(boxes(cut=True), np.eye(4))) is not None
    assert half_of(model([*boxes(cut=True), *beyond], np.eye(4))) is None


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
@pytest.mark.parametrize("damage", ["sound", "opened", "no undercarriage", "extras", "ground"])
def test_drawn_machines_are_no_halves(kind: str, damage: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # Whether it is a half its triangles alone tell: what cylinders there are is not looked up.
    monkeypatch.setattr("yellowiron.cad.mesh.features.facets.find", lambda *_: facets.MeshFeatures((), ()))
    assembly, _ = read(damaged(kind, 7, damage), 7, placed(7, "upright"), None)
    assert half_of(assembly) is None
