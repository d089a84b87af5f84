"""Where a machine stands: on its wheels, or on what is farthest out; and which solids are a wheel's."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import trimesh

from yellowiron.alignment.features.solids import Solid, size_of, solids_of
from yellowiron.alignment.features.wheels import Wheel, wheels_of
from yellowiron.alignment.fusion.annealing import labelled
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.evidence import Evidence, ways_of
from yellowiron.alignment.fusion.judge import field_of, score_of, weights
from yellowiron.alignment.fusion.stance import Stance, on_wheels, stance_of
from yellowiron.alignment.fusion.votes import odd_wheels
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


def test_a_machine_on_three_wheels_stands_on_the_one_in_its_middle_too() -> None:
    """A forklift was looked for a wheelbase farther ahead, about its front axle."""
    quarter = trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0])
    tyre = trimesh.creation.cylinder(0.3, 0.25, sections=48, transform=quarter)
    machine = solids(
        (box(2.4, 1.2, 1.0), (0.0, 0.0, 0.9)), (box(0.2, 1.0, 2.0), (1.3, 0.0, 1.2)),
        *((tyre, at) for at in ((1.0, 0.55, 0.3), (1.0, -0.55, 0.3), (-0.9, 0.0, 0.3))),
    )  # fmt: skip
    stance = stance_of(machine, size_of(machine))
    assert abs(stance.rotation[0] @ [1.0, 0.0, 0.0]) == pytest.approx(1.0)
    assert stance.origin[0] == pytest.approx(0.05, abs=0.1)


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


def test_lugs_that_are_parts_by_themselves_are_of_the_wheel_that_they_go_around() -> None:
    """Wheels of a bogie, whose lugs almost touch: each has its own. Nuts about a hub are not a tread's."""
    quarter = trimesh.transformations.rotation_matrix(np.pi / 2, [1, 0, 0])
    tyre = trimesh.creation.annulus(0.3, 0.6, 0.5, sections=48, transform=quarter)
    places = [(x, y, 0.7) for x in (-2.0, -0.6, 2.0) for y in (-1.0, 1.0)]
    turns = [trimesh.transformations.rotation_matrix((k + 0.5) * np.pi / 8, [0, 1, 0]) for k in range(16)]

    def around(reach: float, mesh: trimesh.Trimesh) -> list[trimesh.Trimesh]:
        return [mesh.copy().apply_translation((reach, 0.0, 0.0)).apply_transform(turn) for turn in turns]

    rows = [[tyre, *around(0.62, box(0.08, 0.4, 0.07)), *around(0.2, box(0.05, 0.5, 0.03))] for _ in places]
    every = solids(*((mesh, at) for row, at in zip(rows, places, strict=True) for mesh in row))
    found = wheels_of(every, 6, set(), 1e-3)
    numbers = [sorted(int(every[i].part.name.split()[1]) for i in w.members) for w in found]
    assert sorted(numbers) == [[33 * k + n for n in range(17)] for k in range(6)]
    assert all(w.radius == pytest.approx(0.66, abs=0.01) for w in found)


def lugged(radius: float, width: float, lugs: int = 20) -> trimesh.Trimesh:
    """A tyre whose tread is lugs alone, about Y: no face of it is round."""
    count = 2 * lugs
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    reach = radius * np.where(np.arange(count) % 2, 0.85, 1.0)
    rings = [np.stack([reach * np.cos(turn), np.full(count, y), reach * np.sin(turn)], axis=1) for y in (-0.5, 0.5)]
    points = np.concatenate([*rings, np.zeros((2, 3))]) * [1.0, width, 1.0]
    points[-2:, 1] = (-0.5 * width, 0.5 * width)
    faces = []
    for k in range(count):
        n = (k + 1) % count
        faces += [
            [k, k + count, n],
            [n, k + count, n + count],
            [k, n, 2 * count],
            [n + count, k + count, 2 * count + 1],
        ]
    return trimesh.Trimesh(points, faces, process=False)


def test_a_tyre_of_lugs_alone_is_a_wheel_and_a_box_is_none() -> None:
    places = [(x, y, 0.5) for x in (-1.5, 1.5) for y in (-1.0, 1.0)]
    tyre, cube = lugged(0.5, 0.4), trimesh.creation.box((1.0, 0.4, 1.0)).subdivide().subdivide()
    machine = solids((box(4.0, 1.0, 0.8), (0.0, 0.0, 1.2)), *((tyre, at) for at in places))
    assert not any(s.axis is not None for s in machine)
    found = wheels_of(machine, 4, set(), 1e-3)
    assert sorted(tuple(np.round(w.center, 3)) for w in found) == sorted(places)
    assert all(abs(w.direction[1]) > 0.9999 and w.radius == pytest.approx(0.5, rel=0.01) for w in found)
    blocks = solids((box(4.0, 1.0, 0.8), (0.0, 0.0, 1.2)), *((cube, at) for at in places))
    assert not wheels_of(blocks, 4, set(), 1e-3)


def test_twin_tyres_are_at_the_rear_of_a_dump_truck() -> None:
    """A truck was read back to front, twin tyres before, where that left less undrawn."""
    front, rear = 40.0, 81.0
    odd = odd_wheels([front, front, rear, rear], load_template("rigid_dump_truck"))
    assert odd["front_wheel_l"](front) < 0.1 and odd["rear_wheel_r"](rear) < 0.1
    assert odd["front_wheel_l"](rear) > 2.0 and odd["rear_wheel_r"](front) > 2.0
    alike = odd_wheels([front] * 4, load_template("rigid_dump_truck"))
    assert alike["front_wheel_l"](front) == pytest.approx(alike["rear_wheel_l"](front))


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


def test_a_stand_may_be_wider_than_it_is_long() -> None:
    """An excavator on a short frame with wide wheels, its arm as low, was looked for in the middle between frame and
    bucket: the frame's own middle is another way to stand."""
    machine = solids(
        *((box(0.4, 0.2, 0.4), (x, y, 0.2)) for x in (-0.1, 0.1) for y in (-0.6, 0.6)),
        (box(0.6, 0.4, 0.6), (0.0, 0.0, 0.5)), (box(2.0, 0.3, 0.3), (1.2, 0.0, 0.16)),
    )  # fmt: skip
    stance = stance_of(machine, size_of(machine))
    (other,) = stance.elsewhere()
    assert stance.origin[0] > 0.5
    assert other.origin[0] == pytest.approx(0.0, abs=0.05)
    assert not other.elsewhere()
    resolved = load_template("excavator")
    nothing: Any = ()
    evidence = Evidence((), (), (), nothing, nothing, stance, (), nothing, {}, frozenset(), 1.0)
    ways = [way.stance.place(np.zeros(3))[0] for way in ways_of(evidence, resolved, tracked=True)]
    assert len(ways) == 4 and min(np.abs(ways)) == pytest.approx(0.0, abs=0.02)


def test_what_is_taken_for_a_part_of_a_larger_machine_pays_for_its_size_piece_by_piece() -> None:
    """A dozer was read as the frame of a blade: of a machine half as large again all places are nearer together."""
    machine = solids(*((box(1.0, 1.0, 1.0), (x, y, 0.5)) for x in (0.0, 2.0, 4.0) for y in (-1.0, 1.0)))
    stance = stance_of(machine, size_of(machine))
    corners = np.array([(x, y, z) for x in (-0.5, 4.5) for y in (-1.5, 1.5) for z in (0.0, 1.0)])
    part = stance.as_part(corners, np.zeros(3), np.full(3, 0.3), 0.3, ())
    times = part.size / stance.size
    assert times > 1.2 and part.larger == pytest.approx(times) and part.turned().larger == part.larger

    def evidence(stands: Stance) -> Evidence:
        nothing: Any = ()
        return Evidence((), (0, 1, 2, 3), (), nothing, nothing, stands, (), nothing, {}, frozenset(), 1.0)

    assert evidence(stance).crowding == 0.0
    assert evidence(part).crowding == pytest.approx(4 * 3.0 * np.log(times))


def test_what_has_no_width_stands_somewhere() -> None:
    """A sheet in the plane of its own symmetry: nothing of it is to either side."""
    sheet = box(2.0, 0.0, 1.0)
    stance = stance_of(solids((sheet, (0.0, 0.0, 0.5))), 2.2)
    assert np.isfinite(stance.origin).all() and np.isfinite(stance.rotation).all()
