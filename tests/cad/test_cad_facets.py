"""Cylinders fitted to triangles: any size, place, tessellation and arc, noise of single precision, slivers, and things
that are not round."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.cad.mesh.features import facets
from yellowiron.cad.mesh.measures import compacted
from yellowiron.model.geometry import CylinderFeature, Floats, Mesh


def turned(axis: Floats) -> Floats:
    """(3, 3) rotation that takes +Z to a unit vector."""
    u = np.linalg.svd(axis[None, :])[2][1:]
    frame = np.stack([u[0], np.cross(axis, u[0]), axis], axis=1)
    return np.asarray(frame)


def wall(radius: float, length: float, count: int, arc: float, rows: int = 1, shift: float = 0.0) -> Mesh:
    """The mantle of a cylinder about +Z, outward; `shift` turns the upper end by that many strips (slivers)."""
    steps = count if arc >= 2 * math.pi - 1e-9 else count + 1
    angles = np.arange(steps) * arc / count
    points, triangles = [], []
    for row in range(rows + 1):
        a = angles + shift * arc / count * row / rows
        points.append(
            np.stack([radius * np.cos(a), radius * np.sin(a), np.full(steps, length * (row / rows - 0.5))], 1)
        )
    for row in range(rows):
        for k in range(count):
            i, j = row * steps + k, row * steps + (k + 1) % steps
            triangles += [(i, j, j + steps), (i, j + steps, i + steps)]
    return Mesh(np.concatenate(points), np.array(triangles, dtype=np.int32))


def capped(mesh: Mesh, radius: float, length: float, count: int) -> Mesh:
    """A full mantle with two flat ends."""
    start = len(mesh.points)
    ends = np.array([[0.0, 0.0, -length / 2], [0.0, 0.0, length / 2]])
    top = start - count
    extra = [(start, (k + 1) % count, k) for k in range(count)]
    extra += [(start + 1, top + k, top + (k + 1) % count) for k in range(count)]
    return Mesh(np.concatenate([mesh.points, ends]), np.concatenate([mesh.triangles, np.array(extra, dtype=np.int32)]))


def placed(mesh: Mesh, axis: Floats, center: Floats, *, single: bool = True, flip: bool = False) -> Mesh:
    points = mesh.points @ turned(axis).T + center
    points = points.astype(np.float32).astype(np.float64) if single else points
    return Mesh(points, mesh.triangles[:, ::-1] if flip else mesh.triangles)


def only(mesh: Mesh) -> CylinderFeature:
    (found,) = facets.find(compacted(mesh)).cylinders
    return found


def check(found: CylinderFeature, axis: Floats, center: Floats, radius: float, length: float) -> None:
    angle = math.degrees(math.acos(min(1.0, abs(float(np.dot(found.direction, axis))))))
    delta = np.asarray(found.center) - center
    off = float(np.linalg.norm(delta - (delta @ axis) * axis))
    assert angle < 0.03 + math.degrees(4e-6 * (1 + float(np.linalg.norm(center))) / min(length, radius))
    assert off < max(6e-6, 2e-3 * radius) * (1 + float(np.linalg.norm(center)))
    assert found.radius == pytest.approx(radius, rel=5e-3)
    assert found.length == pytest.approx(length, rel=5e-3)
    assert not found.exact


unit = st.tuples(*[st.floats(-1, 1)] * 3).map(np.array).filter(lambda v: bool(np.linalg.norm(v) > 0.1))
axes = unit.map(lambda v: v / np.linalg.norm(v))
places = st.tuples(*[st.floats(-5, 5)] * 3).map(np.array)
radii = st.floats(0.008, 0.6)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(radii, st.floats(0.3, 30.0), st.integers(8, 64), axes, places, st.integers(1, 4), st.booleans())
def test_whole_cylinders(
    radius: float, slender: float, count: int, axis: Floats, center: Floats, rows: int, bore: bool
) -> None:
    length = radius * slender
    found = only(placed(wall(radius, length, count, 2 * math.pi, rows), axis, center, flip=bore))
    check(found, axis, center, radius, length)
    assert found.arc == pytest.approx(2 * math.pi)
    assert found.inner is bore


@settings(max_examples=40, deadline=None, derandomize=True)
@given(radii, st.floats(0.5, 10.0), st.floats(1.45, 6.0), axes, places, st.booleans())
def test_parts_of_cylinders(
    radius: float, slender: float, arc: float, axis: Floats, center: Floats, bore: bool
) -> None:
    count = max(5, math.ceil(arc / 0.3))
    length = radius * slender
    found = only(placed(wall(radius, length, count, arc), axis, center, flip=bore))
    check(found, axis, center, radius, length)
    assert found.arc == pytest.approx(arc, rel=2e-3)
    assert found.inner is bore


@settings(max_examples=40, deadline=None, derandomize=True)
@given(st.floats(0.015, 0.3), st.floats(2.0, 30.0), st.integers(16, 64), axes, places, st.floats(0.1, 0.9))
def test_slivers(radius: float, slender: float, count: int, axis: Floats, center: Floats, shift: float) -> None:
    """The two ends do not match: no fold runs along the axis."""
    length = radius * slender
    mesh = placed(wall(radius, length, count, 2 * math.pi, 1, shift), axis, center, single=False)
    check(only(mesh), axis, center, radius, length)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.floats(0.03, 0.3), st.floats(1.0, 20.0), st.integers(8, 40), axes, places, st.integers(0, 2**32 - 1))
def test_noise(radius: float, slender: float, count: int, axis: Floats, center: Floats, seed: int) -> None:
    """0.01 mm on every corner: found, within what the noise allows."""
    length = radius * slender
    mesh = placed(wall(radius, length, count, 2 * math.pi), axis, center, single=False)
    points = mesh.points + np.random.default_rng(seed).normal(scale=1e-5, size=mesh.points.shape)
    found = only(Mesh(points, mesh.triangles))
    angle = math.degrees(math.acos(min(1.0, abs(float(np.dot(found.direction, axis))))))
    assert angle < math.degrees(6e-5 / length) + 0.01
    assert found.radius == pytest.approx(radius, abs=4e-5)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.floats(0.02, 0.6), st.floats(0.5, 5.0), st.integers(14, 48), axes, places, st.floats(0.6, 0.985))
def test_ovals(radius: float, slender: float, count: int, axis: Floats, center: Floats, ratio: float) -> None:
    """Cylinders that a scale has squeezed: their axis, and the mean of the two radii."""
    length = radius * slender
    mesh = wall(radius, length, count, 2 * math.pi)
    squeezed = Mesh(mesh.points * np.array([1.0, ratio, 1.0]), mesh.triangles)
    found = only(placed(squeezed, axis, center, single=False))
    assert abs(float(np.dot(found.direction, axis))) > math.cos(math.radians(0.01))
    delta = np.asarray(found.center) - center
    assert np.linalg.norm(delta - (delta @ axis) * axis) < 1e-5 + 1e-3 * radius
    assert found.radius == pytest.approx(radius * math.sqrt(ratio), rel=5e-3)
    assert found.arc == pytest.approx(2 * math.pi)


@pytest.mark.parametrize("scale", [0.02, 1.0, 39.37, 1e3])
def test_any_unit(scale: float) -> None:
    """A pin, and a bent pipe that is none, in a model of a model and in one whose millimetres were taken for metres."""
    pin = placed(wall(0.04 * scale, 0.3 * scale, 16, 2 * math.pi), np.array([0.6, 0.0, 0.8]), np.zeros(3))
    assert only(pin).radius == pytest.approx(0.04 * scale)
    pipe = pipe_bend(0.02, 0.1, math.radians(15), 16)
    assert facets.find(Mesh(pipe.points * scale, pipe.triangles)).cylinders == ()


def test_sheets_drawn_from_both_sides_count_once() -> None:
    mesh = wall(0.1, 0.5, 16, 2 * math.pi)
    twice = Mesh(mesh.points, np.concatenate([mesh.triangles, mesh.triangles[:, ::-1]]))
    assert only(twice).radius == pytest.approx(0.1)


def test_pin_has_ends() -> None:
    mesh = capped(wall(0.04, 0.3, 24, 2 * math.pi), 0.04, 0.3, 24)
    found = facets.find(mesh)
    assert len(found.cylinders) == 1
    assert sorted(p.normal for p in found.planes) == [(0.0, 0.0, -1.0), (0.0, 0.0, 1.0)]
    assert found.planes[0].area == pytest.approx(24 / 2 * 0.04**2 * math.sin(math.pi / 12))


def test_two_bores_on_one_axis_are_two() -> None:
    one, other = wall(0.04, 0.02, 24, 2 * math.pi), wall(0.04, 0.02, 24, 2 * math.pi)
    points = np.concatenate([one.points, other.points + np.array([0.0, 0.0, 0.2])])
    mesh = Mesh(points, np.concatenate([one.triangles, other.triangles + len(one.points)])[:, ::-1])
    found = facets.find(mesh).cylinders
    assert [c.inner for c in found] == [True, True]
    assert sorted(c.center[2] for c in found) == pytest.approx([0.0, 0.2], abs=1e-9)


def ball(rows: int, count: int) -> Mesh:
    theta, phi = np.linspace(0.05, math.pi - 0.05, rows), np.arange(count) * 2 * math.pi / count
    t, p = np.meshgrid(theta, phi, indexing="ij")
    points = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1).reshape(-1, 3)
    triangles = []
    for row in range(rows - 1):
        for k in range(count):
            i, j = row * count + k, row * count + (k + 1) % count
            triangles += [(i, i + count, j), (j, i + count, j + count)]
    return Mesh(points, np.array(triangles, dtype=np.int32))


def pipe_bend(radius: float, bend: float, step: float, count: int) -> Mesh:
    rings = np.arange(0.0, math.pi / 2 + 1e-9, step)
    around = np.arange(count) * 2 * math.pi / count
    points = []
    for a in rings:
        out = bend + radius * np.cos(around)
        points.append(np.stack([out * math.cos(a), out * math.sin(a), radius * np.sin(around)], axis=1))
    triangles = []
    for row in range(len(rings) - 1):
        for k in range(count):
            i, j = row * count + k, row * count + (k + 1) % count
            triangles += [(i, i + count, j), (j, i + count, j + count)]
    return Mesh(np.concatenate(points), np.array(triangles, dtype=np.int32))


def cone(count: int) -> Mesh:
    mesh = wall(1.0, 1.0, count, 2 * math.pi)
    points = mesh.points.copy()
    points[:count, :2] *= 0.7
    return Mesh(points, mesh.triangles)


@pytest.mark.parametrize(
    "mesh",
    [ball(9, 12), ball(17, 24), ball(18, 24), cone(12), cone(40), pipe_bend(0.02, 0.1, math.radians(15), 16),
     wall(0.1, 0.5, 6, 2 * math.pi), wall(0.1, 0.5, 3, 1.0), wall(0.1, 0.5, 4, 0.9)],
)  # fmt: skip
def test_what_is_not_round(mesh: Mesh) -> None:
    """Balls, cones, bent pipes, hexagons and bent plates."""
    assert facets.find(mesh).cylinders == ()


def test_same_mesh_same_answer() -> None:
    mesh = placed(wall(0.1, 0.5, 17, 2 * math.pi, 3), np.array([0.6, 0.0, 0.8]), np.array([1.0, 2.0, 3.0]))
    assert facets.find(mesh) == facets.find(mesh)


def test_nothing_to_find() -> None:
    assert facets.find(Mesh(np.eye(3), np.array([[0, 1, 2]], dtype=np.int32))) == facets.MeshFeatures((), ())
