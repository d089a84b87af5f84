"""Symmetry, fits, flat contact, welds and cuts on small solids with known answers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from kit.machines.solids import bolt, box, lathe, place, plate, tube
from yellowiron.alignment.features.contacts import covered, fits_of, flats_of, inside, neighbours, shared_axes_of
from yellowiron.alignment.features.solids import Solid, flat_faces, solids_of
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Shape

SMALL = settings(max_examples=25, deadline=None)


def scene(*items: tuple[str, Shape, np.ndarray]) -> dict[str, Solid]:
    parts = tuple(Part(name, name, ("A",), f"{name}", matrix) for name, _, matrix in items)
    assembly = Assembly("a", "synthetic", 1.0, parts, {name: shape for name, shape, _ in items})
    return {s.part.id: s for s in solids_of(assembly)}


def turned(seed: int) -> np.ndarray:
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    if np.linalg.det(q) < 0:
        q[:, 0] = -q[:, 0]
    matrix = np.eye(4)
    matrix[:3, :3] = q
    return matrix


def test_what_is_round_and_what_is_a_bar() -> None:
    square = plate("square", np.array([[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]), 0.02, [(0, 0, 0.03)])
    found = scene(
        ("pin", tube("pin", 0.05, 0.0, 0.3), np.eye(4)),
        ("bolt", bolt("bolt", 0.01, 0.08), np.eye(4)),
        ("ring", tube("ring", 0.06, 0.05, 0.08), np.eye(4)),
        ("disc", lathe("disc", [(0, 0), (0.3, 0), (0.3, 0.05), (0, 0.05)]), np.eye(4)),
        ("square", square, np.eye(4)),
        ("block", box("block", 0.2, 0.1, 0.1), np.eye(4)),
    )
    assert {n for n, s in found.items() if s.shaft is not None} == {"pin", "bolt"}
    assert {n for n, s in found.items() if s.axis is not None} == {"pin", "bolt", "ring", "disc"}
    assert found["ring"].hole == pytest.approx(0.05)


@SMALL
@given(st.floats(0.02, 0.1), st.floats(0.0, 0.012), st.integers(0, 99))
def test_a_pin_in_two_lugs(radius: float, play: float, seed: int) -> None:
    """Found with any clearance up to 1.2 % of a radius and in any direction; not when it stands beside the bore."""
    hole = radius * (1 + play)
    lug = plate("lug", 3 * radius * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1.0]]), radius, [(0, 0, hole)])
    world = turned(seed)
    up = world @ place((0, 0, 2 * radius), (0, 0, 1))
    pin = world @ place((0, 0, -radius), (0, 0, 1))
    beside = world @ place((2.5 * radius, 0, -radius), (0, 0, 1))
    solids = scene(
        ("one", lug, world), ("two", lug, up), ("pin", tube("pin", radius, 0, 4 * radius), pin),
        ("off", tube("off", radius, 0, 4 * radius), beside),
    )  # fmt: skip
    fits = fits_of(tuple(sorted(solids.values(), key=lambda s: s.index)), 1e-4 * radius)
    names = {s.index: n for n, s in solids.items()}
    assert {(names[f.inner], names[f.outer]) for f in fits} == {("pin", "one"), ("pin", "two")}
    assert len(shared_axes_of(fits, 1e-4 * radius)) == 1
    assert all(f.overlap == pytest.approx(radius, rel=1e-6) for f in fits)


@SMALL
@given(st.floats(-0.9, 0.9), st.floats(-0.9, 0.9), st.integers(0, 99))
@example(0.0, 0.9, 11)
def test_flat_contact_has_the_overlap_as_its_area(dx: float, dy: float, seed: int) -> None:
    world = turned(seed)
    top = world @ place((dx, dy, 0.2), (0, 0, 1), (1, 0, 0))
    found = scene(("a", box("a", 1.0, 1.0, 0.2), world), ("b", box("b", 1.0, 1.0, 0.2), top))
    solids = tuple(sorted(found.values(), key=lambda s: s.index))
    flats = flats_of(solids, neighbours(solids, 1e-4), 1e-4)
    assert len(flats) == 1
    # Counted on a grid of 24 × 24 cells, or finer: a strip of three cells is known to a tenth.
    assert flats[0].area == pytest.approx((1 - abs(dx)) * (1 - abs(dy)), rel=0.12)


def test_a_gap_is_no_contact() -> None:
    found = scene(("a", box("a", 1, 1, 0.2), np.eye(4)), ("b", box("b", 1, 1, 0.2), place((0, 0, 0.201), (0, 0, 1))))
    solids = tuple(sorted(found.values(), key=lambda s: s.index))
    assert flats_of(solids, neighbours(solids, 0.01), 1e-4) == []


def test_a_bore_is_no_weld() -> None:
    """A pin's facets lie on the bore's; no plane does."""
    lug = plate("lug", np.array([[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]]), 0.1, [(0, 0, 0.05)])
    found = scene(("lug", lug, np.eye(4)), ("pin", tube("pin", 0.05, 0, 0.3), place((0, 0, -0.15), (0, 0, 1))))
    solids = tuple(sorted(found.values(), key=lambda s: s.index))
    assert flats_of(solids, neighbours(solids, 1e-4), 1e-4) == []


def test_planes_from_triangles() -> None:
    planes = flat_faces(box("box", 1.0, 2.0, 3.0))
    assert sorted(round(p.area, 6) for p in planes) == [2.0, 2.0, 3.0, 3.0, 6.0, 6.0]


def test_covered_area() -> None:
    one = np.array([[[0, 0], [1, 0], [0, 1.0]]])
    other = np.array([[[1, 1], [0, 1], [1, 0.0]], [[0, 0], [1, 0], [0, 1.0]]])
    area, centre, _ = covered(one, other, np.zeros(2), np.ones(2), count=200)
    assert area == pytest.approx(0.5, rel=0.02)
    assert centre == pytest.approx([1 / 3, 1 / 3], abs=0.01)
    assert math.isclose(covered(one, other[:1], np.zeros(2), np.ones(2))[0], 0.0, abs_tol=0.06)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10_000), st.integers(0, 400), st.sampled_from([0.03, 0.3, 2.0]))
def test_samples_in_triangles_are_those_of_the_formula(seed: int, count: int, size: float) -> None:
    """Against the side of every edge of every triangle; on a grid with holes, and where nothing is a grid."""
    rng = np.random.default_rng(seed)
    triangles = rng.random((count, 1, 2)) + size * (rng.random((count, 3, 2)) - 0.5)
    steps = (np.arange(12) + 0.5) / 12
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    for samples in (grid[rng.random(len(grid)) < 0.6], rng.random((9, 2))):
        true = np.zeros(len(samples), dtype=bool)
        for a, b, c in triangles:
            edges = [(q - p, samples - p) for p, q in ((a, b), (b, c), (c, a))]
            sides = [e[0] * d[:, 1] - e[1] * d[:, 0] for e, d in edges]
            true |= (np.array(sides) >= 0).all(axis=0) | (np.array(sides) <= 0).all(axis=0)
        assert (inside(samples, triangles) == true).all()
