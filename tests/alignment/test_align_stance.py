"""Where a machine stands: on its wheels, or on what is farthest out; and which solids are a wheel's."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from yellowiron.alignment.features.solids import Solid, size_of, solids_of
from yellowiron.alignment.features.wheels import Wheel, wheels_of
from yellowiron.alignment.fusion.annealing import labelled
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.judge import field_of, score_of
from yellowiron.alignment.fusion.stance import Stance, on_wheels, stance_of
from yellowiron.alignment.fusion.weights import weights
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.library import load_template
from yellowiron.model.geometry import Mesh
from yellowiron.model.template import choose

TRACK, BUCKET = (3.0, 0.5, 0.8), (1.2, 1.2, 1.0)


def solids(*placed: tuple[trimesh.Trimesh, tuple[float, float, float]]) -> tuple[Solid, ...]:
    """Meshes, each moved to a place, metres."""
    found = []
    for k, (mesh, place) in enumerate(placed):
        at = np.eye(4)
        at[:3, 3] = place
        own = Mesh(np.asarray(mesh.vertices), np.asarray(mesh.faces, dtype=np.int32))
        found.append(Occurrence(f"part {k}", (), own, at))
    return solids_of(assemble(found, name="machine", format="test", unit=1.0, path=""))


def box(*size: float) -> trimesh.Trimesh:
    return trimesh.creation.box(size)


def wheel(at: tuple[float, float, float], radius: float = 0.5) -> Wheel:
    return Wheel(frozenset({0}), 0, np.array(at), np.array([0.0, 1.0, 0.0]), radius, 0.4)


@pytest.mark.parametrize("ahead", [2.4, 3.2])
def test_a_bucket_on_the_ground_does_not_move_the_middle_of_the_stand(ahead: float) -> None:
    """It did by half of its reach: every body was then looked for too far behind."""
    machine = solids(
        (box(*TRACK), (0.0, 1.2, 0.4)), (box(*TRACK), (0.0, -1.2, 0.4)),
        (box(2.5, 2.4, 1.2), (-0.2, 0.0, 1.5)), (box(3.0, 0.4, 0.4), (1.5, 0.0, 2.4)),
        (box(*BUCKET), (ahead, 0.0, 0.5)),
    )  # fmt: skip
    stance = stance_of(machine, size_of(machine))
    assert stance.origin @ stance.rotation[0] == pytest.approx(0.0, abs=0.06)
    assert stance.origin[2] == pytest.approx(0.0, abs=0.06)


def test_it_stands_in_the_middle_of_its_wheels() -> None:
    rotation = np.eye(3)
    stance = Stance(rotation, np.array([1.0, 0.2, -0.3]), 8.0, 0.9)
    four = [wheel((x, y, 0.5)) for x in (-1.5, 1.5) for y in (-1.0, 1.0)]
    found = on_wheels(stance, four)
    assert found.wheeled
    assert found.origin == pytest.approx(np.zeros(3), abs=1e-12)
    assert on_wheels(stance, four[:3]) is stance
    raised = [*four[:3], wheel((1.5, 1.0, 1.4))]
    assert on_wheels(stance, raised) is stance
    # Equal rings on one line are pins.
    assert on_wheels(stance, [wheel((0.01 * k, 0.3 * k, 0.5)) for k in range(4)]) is stance


def test_rims_of_spokes_and_tyres_with_treads_are_of_their_wheel() -> None:
    """A mesh that was taken apart: the round thing is the rim's barrel; the tyre about it has lugs, the rim spokes; a
    mudguard is beside them, and an axle reaches out."""
    quarter = trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0])
    ring = trimesh.creation.annulus(0.3, 0.37, 0.5, sections=48, transform=quarter)
    lugs = trimesh.util.concatenate(
        [trimesh.creation.annulus(0.4, 0.62, 0.5, sections=40, transform=quarter)]
        + [
            box(0.14, 0.4, 0.1)
            .apply_translation((0.66, 0, 0))
            .apply_transform(trimesh.transformations.rotation_matrix(k * np.pi / 8, [0, 1, 0]))
            for k in range(16)
        ]
    )
    spokes = trimesh.util.concatenate(
        [
            box(0.56, 0.08, 0.07).apply_transform(trimesh.transformations.rotation_matrix(k * np.pi / 4, [0, 1, 0]))
            for k in range(4)
        ]
    )
    guard, axle = box(1.3, 0.5, 0.05), box(0.2, 2.6, 0.2)
    places = [(x, y, 0.7) for x in (-1.3, 1.3) for y in (-1.0, 1.0)]
    placed = [(mesh, at) for at in places for mesh in (ring, lugs, spokes)]
    rest = [(guard, (x, y, z + 0.85)) for x, y, z in places] + [(axle, (x, 0.0, 0.7)) for x in (-1.3, 1.3)]
    every = solids(*placed, *rest)
    found = wheels_of(every, 4, set(), 1e-3)
    numbers = [sorted(int(every[i].part.name.split()[1]) for i in w.members) for w in found]
    assert sorted(numbers) == [[3 * k, 3 * k + 1, 3 * k + 2] for k in range(4)]
    assert all(w.radius == pytest.approx(0.73, abs=0.02) for w in found)


def test_a_cylinder_and_its_twin_change_sides_together() -> None:
    """Barrel, rod and their mirror images that were begun on the wrong side: no single one can cross over."""
    template = choose(load_template("excavator"), {"boom_cylinders": "twin"})
    names = [f"boom_{half}_{side}" for side in "lr" for half in ("cylinder_barrel", "piston_rod")]
    votes = [
        {name: {"place": 0.0 if name.endswith(side) else 1.0} for name in names if half in name}
        for side in "lr"
        for half in ("barrel", "rod")
    ]
    bonds = [
        Bond(a, b, {}, a // 2 == b // 2, False, a // 2 == b // 2, alike=b == a + 2)
        for a, b in [(0, 1), (2, 3), (0, 2), (1, 3)]
    ]
    field = field_of(votes, bonds, template, weights())
    right = np.array([field.bodies.index(n) for n in names])
    (sides,) = [order for order in field.sides if order[right[0]] != right[0]]
    wrong = sides[right]
    assert [field.bodies[n] for n in wrong] == [n[:-1] + ("r" if n[-1] == "l" else "l") for n in names]
    assert score_of(field, right) > score_of(field, wrong)
    found, score = labelled(field, wrong, sweeps=0, chains=1)
    assert found.tolist() == right.tolist()
    assert score == pytest.approx(score_of(field, right))


def test_what_has_no_width_stands_somewhere() -> None:
    """A sheet in the plane of its own symmetry: nothing of it is to either side."""
    sheet = box(2.0, 0.0, 1.0)
    stance = stance_of(solids((sheet, (0.0, 0.0, 0.5))), 2.2)
    assert np.isfinite(stance.origin).all() and np.isfinite(stance.rotation).all()
