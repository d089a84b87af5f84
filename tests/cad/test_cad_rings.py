"""Cylinders on triangles that converters have spoiled: few, uneven and twisted facets, and noise."""

from __future__ import annotations

import math

import numpy as np
import pytest

from kit.machines.solids import Array, box, plate
from yellowiron.cad.mesh.features import facets, rings
from yellowiron.cad.mesh.measures import compacted
from yellowiron.model.geometry import Mesh


def _prism(lower: Array, upper: Array, length: float) -> Mesh:
    """A bar between two polygons about z, each (n,) angles with (n,) radii as complex numbers, closed at both ends."""
    ends = [np.c_[p.real, p.imag, np.full(len(p), z)] for p, z in ((lower, 0.0), (upper, length))]
    n, m = len(lower), len(upper)
    triangles = [[n + m, (k + 1) % n, k] for k in range(n)] + [[n + m + 1, n + k, n + (k + 1) % m] for k in range(m)]
    turns = [np.angle(p * np.exp(-1j * np.angle(lower[0]))) % math.tau for p in (lower, upper)]
    i = j = 0
    while i < n or j < m:
        ahead = [turns[0][i + 1] if i + 1 < n else math.tau, turns[1][j + 1] if j + 1 < m else math.tau + 1e-3]
        if j >= m or (i < n and ahead[0] <= ahead[1]):
            triangles.append([i % n, (i + 1) % n, n + j % m])
            i += 1
        else:
            triangles.append([i % n, n + (j + 1) % m, n + j % m])
            j += 1
    points = np.concatenate([*ends, [[0.0, 0.0, 0.0], [0.0, 0.0, length]]])
    return compacted(Mesh(points, np.array(triangles, dtype=np.int32)))


def _thinned(count: int, radius: float, rng: np.random.Generator, *, outward: float = 0.0) -> Array:
    """The corners that decimation leaves of a circle of 32, those it moved further out by up to a share of the
    radius."""
    kept = np.sort(rng.choice(32, count, replace=False))
    while np.diff(np.append(kept, kept[0] + 32)).max() > 5:
        kept = np.sort(rng.choice(32, count, replace=False))
    moved = 1.0 + outward * rng.random(count)
    return np.asarray(radius * moved * np.exp(1j * kept * math.tau / 32))


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("outward", [0.0, 0.04])
def test_a_decimated_bar_is_a_shaft(seed: int, outward: float) -> None:
    rng = np.random.default_rng(seed)
    mesh = _prism(_thinned(10, 0.05, rng, outward=outward), _thinned(11, 0.05, rng, outward=outward), 0.2)
    found = facets.find(mesh).cylinders
    assert len(found) == 1
    shaft = found[0]
    assert not shaft.inner
    assert shaft.arc == pytest.approx(math.tau)
    assert shaft.length == pytest.approx(0.2, abs=1e-9)
    assert abs(shaft.direction[2]) == pytest.approx(1.0, abs=1e-5)
    assert abs(shaft.radius - 0.05) <= shaft.error
    assert math.hypot(*shaft.center[:2]) <= shaft.error
    assert shaft.error < 0.1 * shaft.radius


def test_a_sound_cylinder_has_no_error() -> None:
    circle = 0.05 * np.exp(1j * np.arange(32) * math.tau / 32)
    found = facets.find(_prism(circle, circle, 0.2)).cylinders
    assert [c.radius for c in found] == [pytest.approx(0.05, rel=1e-9)]
    assert found[0].error == 0.0


def test_what_eight_segments_do_not_tell_is_its_error() -> None:
    circle = 0.05 * np.exp(1j * np.arange(8) * math.tau / 8)
    found = facets.find(_prism(circle, circle, 0.2)).cylinders
    assert len(found) == 1
    assert 0.02 * 0.05 < found[0].error < 0.05 * 0.05


@pytest.mark.parametrize("sides", [3, 4, 5, 6])
def test_angular_bars_are_no_shafts(sides: int) -> None:
    corners = 0.05 * np.exp(1j * np.arange(sides) * math.tau / sides)
    assert facets.find(_prism(corners, corners, 0.2)).cylinders == ()


def test_a_box_with_chamfered_edges_is_no_shaft() -> None:
    corners = np.array([math.tau * k / 4 + s * 0.12 for k in range(4) for s in (-1, 1)])
    ring = 0.05 * np.exp(1j * np.sort(corners % math.tau))
    assert facets.find(_prism(ring, ring, 0.2)).cylinders == ()


def test_a_bore_whose_corners_were_moved_is_a_bore() -> None:
    """A plate's round hole, all of its corners off by up to 2 % of the radius; the outline of the plate stays."""
    sound = compacted(
        plate("plate", np.array([[0, 0], [0.4, 0], [0.4, 0.3], [0, 0.3]]), 0.03, [(0.2, 0.15, 0.05)]).mesh
    )
    rng = np.random.default_rng(4)
    points = sound.points.copy()
    around = np.abs(np.hypot(points[:, 0] - 0.2, points[:, 1] - 0.15) - 0.05) < 1e-6
    points[around, :2] += 2e-4 * rng.uniform(-1.0, 1.0, (int(around.sum()), 2))
    found = facets.find(Mesh(points, sound.triangles)).cylinders
    assert [c.inner for c in found] == [True]
    assert found[0].radius == pytest.approx(0.05, rel=5e-3)
    assert found[0].center[:2] == pytest.approx((0.2, 0.15), abs=3e-4)


def test_a_block_is_not_round() -> None:
    assert facets.find(compacted(box("block", 0.3, 0.2, 0.1).mesh)).cylinders == ()


def _oval(count: int, ratio: float, rng: np.random.Generator, noise: float) -> Array:
    """Corners of an oval of two radii, each off by up to a share of them."""
    turns = np.sort(rng.random(count) + np.arange(count)) * math.tau / count
    return np.asarray((np.cos(turns) + 1j * ratio * np.sin(turns)) * (1.0 + noise * (rng.random(count) - 0.5)))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(8))
def test_what_is_not_fitted_would_be_no_wall(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(seed)
    shapes = [(7 + 2 * (k % 9), 1.0 - 0.1 * (k % 5), 0.03 * (k % 4)) for k in range(20)]
    meshes = [_prism(*(0.1 * _oval(count, ratio, rng, noise) for _ in "ab"), 0.3) for count, ratio, noise in shapes]
    refused: list[bool] = []

    def refusing(*given: Array) -> Array:
        found: Array = known(*given)
        refused.extend(found.tolist())
        return found

    known = rings._are_no_walls
    monkeypatch.setattr(rings, "_are_no_walls", refusing)
    found = [facets.find(mesh).cylinders for mesh in meshes]
    monkeypatch.setattr(rings, "_are_no_walls", lambda corners, starts: np.zeros(len(starts), dtype=bool))
    assert found == [facets.find(mesh).cylinders for mesh in meshes]
    assert any(refused) and not all(refused)
