"""Fusion: names, shapes, places and contacts judged together where contacts alone find no machine."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from kit.machines.defects import drawn
from kit.machines.synthetic import disguise
from kit.scene import scene
from yellowiron.alignment import align
from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.assignment.search import Search
from yellowiron.alignment.features.solids import size_of, solids_of
from yellowiron.alignment.fusion import judge, reading
from yellowiron.alignment.fusion.annealing import Annealing, against, labelled, leads
from yellowiron.alignment.fusion.best import Best
from yellowiron.alignment.fusion.bonds import ENOUGH, Bond, _kin, _together, _welded, out_of_line
from yellowiron.alignment.fusion.judge import Field, field_of, score_of, weights
from yellowiron.alignment.fusion.pieces import Piece, largeness, leading
from yellowiron.alignment.fusion.played import beside_lost_arms
from yellowiron.alignment.fusion.reading import CONTRARY, _by_any_labels, _one_name
from yellowiron.alignment.fusion.stance import Stance, stance_of
from yellowiron.alignment.fusion.votes import LENT, borrowed
from yellowiron.alignment.pipeline import _Judged
from yellowiron.alignment.structure.observation import observe
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def excavator() -> Template:
    return choose(load_template("excavator"), {"boom_cylinders": "single"})


def _bond(a: int, b: int, **more: bool) -> Bond:
    given = {"hinge": False, "slide": False, "alike": False, "paired": False, **more}
    told = {kind: given[kind] for kind in ("alike", "paired")}
    return Bond(a, b, {"beside": 1.0}, True, given["hinge"], given["slide"], **told)


def test_the_names_decide_where_nothing_else_speaks(excavator: Template) -> None:
    votes = [{"boom": {"name": 1.0}, "arm": {}}, {"arm": {"name": 1.0}, "boom": {}}]
    field = field_of(votes, [_bond(0, 1)], excavator, weights())
    labels, _ = labelled(field)
    assert [field.bodies[n] for n in labels] == ["boom", "arm"]
    lead, second = leads(field, labels)
    assert (lead > 0).all()
    assert field.bodies[second[0]] == "arm"


def test_neighbours_tell_what_names_leave_open(excavator: Template) -> None:
    """Two nameless pieces between the boom and the bucket: one is the arm, what it carries at its end goes with it."""
    open_ = {"boom": {}, "arm": {}, "bucket": {}}
    votes = [{"boom": {"name": 1.0}}, open_, {"bucket": {"name": 1.0}}]
    field = field_of(votes, [_bond(0, 1, hinge=True), _bond(1, 2, hinge=True)], excavator, weights())
    labels, _ = labelled(field)
    assert field.bodies[labels[1]] == "arm"


def test_what_is_large_is_not_left_out_lightly(excavator: Template) -> None:
    """A boom that only its place speaks against, a little, is the boom if it is large, and nothing if it is small."""
    votes: list[dict[str, dict[str, float]]] = [{"upperstructure": {"said": 1.0}}, {"boom": {"place": 2.0}}]
    for large, body in ((1.0, "boom"), (0.2, None)):
        field = field_of(votes, [], excavator, weights(), large=np.array([1.0, large]))
        labels, _ = labelled(field)
        assert (*field.bodies, None)[labels[1]] == body
    areas = [SimpleNamespace(area=a) for a in (4.0, 1.0)]
    assert largeness(cast("list[Piece]", areas)).tolist() == [1.0, 0.5]


def test_a_variant_takes_over_anothers_labels_where_it_is_better_by_them(
    excavator: Template, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Annealing does not know what a variant loses by a body that nothing plays: a fork carriage was left to the
    chassis, and the mast that lifts it on another section, of which nothing is drawn, won by it."""
    votes = [{"boom": {"name": 1.0}}, {"boom": {"name": 0.1}, "arm": {}}]
    field = field_of(votes, [], excavator, weights())
    boom, arm = (field.bodies.index(b) for b in ("boom", "arm"))
    lost = {(boom, boom): -30.0, (boom, arm): 0.0}
    monkeypatch.setattr(reading, "lacking", lambda _, __, labels, ___: lost[tuple(labels.tolist())])

    def judged(*labels: int) -> Best:
        score = score_of(field, np.array(labels)) + lost[labels]
        return Best(score, {}, excavator, field, np.array(labels), [], (0, 1))

    evidence = cast("Any", SimpleNamespace(leading=(0, 1)))
    own, other = judged(boom, boom), judged(boom, arm)
    assert score_of(field, own.labels) > score_of(field, other.labels)
    assert _by_any_labels(own, [own, other], evidence).labels.tolist() == [boom, arm]
    assert _by_any_labels(own, [own, other], evidence).score == other.score
    assert _by_any_labels(other, [own, other], evidence) is other


def test_mirror_images_are_one_body_or_twins() -> None:
    """Two bars that mirror each other are the barrels of two hydraulic cylinders, not barrel and rod of one."""
    twin = choose(load_template("excavator"), {"boom_cylinders": "twin"})
    names = ["boom_cylinder_barrel_l", "boom_cylinder_barrel_r", "boom_piston_rod_l"]
    field = field_of([{name: {} for name in names}] * 2, [_bond(0, 1, alike=True)], twin, weights())
    left, right, rod = (field.bodies.index(name) for name in names)
    alone = field_of([{name: {} for name in names}] * 2, [_bond(0, 1)], twin, weights())

    def gain(*labels: int) -> float:
        return score_of(field, np.array(labels)) - score_of(alone, np.array(labels))

    assert gain(left, left) == gain(left, right) == gain(right, left) == pytest.approx(weights()["alike"])
    assert gain(left, rod) == gain(len(field.bodies), len(field.bodies)) == 0.0


def test_a_cylinders_mirror_image_is_its_twin() -> None:
    """Two bars side by side were the barrels of the boom's cylinder and of the arm's."""
    twin = choose(load_template("excavator"), {"boom_cylinders": "twin"})
    names = ["boom_cylinder_barrel_l", "boom_cylinder_barrel_r", "boom_piston_rod_l", "arm_cylinder_barrel", "boom"]
    told, untold = (
        field_of([{name: {} for name in names}] * 2, [_bond(0, 1, paired=paired)], twin, weights())
        for paired in (True, False)
    )
    left, right, rod, other, boom = (told.bodies.index(name) for name in names)
    none = len(told.bodies)
    for pair, lost in {
        (left, right): 0.0, (left, left): 0.0, (boom, boom): 0.0, (boom, none): 0.0, (none, none): 0.0,
        (left, boom): 0.0, (none, left): 0.0, (rod, right): 0.0, (left, other): 1.0, (other, rod): 1.0,
    }.items():  # fmt: skip
        labels = np.array(pair)
        assert score_of(told, labels) - score_of(untold, labels) == pytest.approx(lost * weights()["unpaired"])


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000))
def test_conditionals_are_differences_of_the_score(excavator: Template, seed: int) -> None:
    template = choose(excavator, {})
    rng = np.random.default_rng(seed)
    bodies = [r.name for r in template.roles if r.rigid][:12]
    votes = [{b: {"name": float(rng.random())} for b in bodies} for _ in range(6)]
    pairs = [(a, b) for a in range(6) for b in range(a + 1, 6) if rng.random() < 0.6]
    kinds = {"hinge": 0.5, "slide": 0.3, "alike": 0.4, "paired": 0.4}
    bonds = [
        replace(
            _bond(a, b, **{kind: bool(rng.random() < share) for kind, share in kinds.items()}),
            branch=int(rng.integers(-1, 2)),
        )
        for a, b in pairs
    ]
    lined = np.triu(rng.random((6, 6)) < 0.3, 1)
    field = field_of(votes, bonds, template, weights(), lined | lined.T)
    labels = rng.choice(len(field.bodies), size=6)
    labels = np.array([n if field.bodies[n] in bodies else len(field.bodies) for n in labels], dtype=np.int64)
    others = rng.permuted(labels)
    state = Annealing(field, np.array([others, labels]))
    piece = int(rng.integers(6))
    for p in rng.permutation(6).tolist():  # what comes and goes is counted right
        state.conditional(p)
        state.put(p, state.labels[:, p])
    found = state.conditional(piece)[1]
    state.put(piece, state.labels[:, piece])
    for one in range(len(field.bodies) + 1):
        if field.unary[piece, one] < -1e5:
            continue
        other = labels.copy()
        other[piece] = one
        gain = score_of(field, other) - score_of(field, labels)
        assert found[one] - found[labels[piece]] == pytest.approx(gain, abs=1e-6)


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_labellings_score_together_what_they_score_alone(excavator: Template, seed: int) -> None:
    rng = np.random.default_rng(seed)
    template = choose(excavator, {})
    bodies = [r.name for r in template.roles if r.rigid]
    votes = [{b: {"name": float(rng.random())} for b in bodies} for _ in range(40)]
    bonds = [_bond(a, b, alike=bool(rng.random() < 0.2)) for a in range(40) for b in range(a) if rng.random() < 0.4]
    lined = np.triu(rng.random((40, 40)) < 0.5, 1)
    field = field_of(votes, bonds, template, weights(), lined | lined.T)
    labels = rng.integers(len(bodies) + 1, size=(300, 40))
    assert len(labels) * len(bonds) > judge.AT_ONCE
    alone = [score_of(field, one) for one in labels]
    assert judge.scores_of(field, labels) == pytest.approx(alone)
    # What is off the line of the others of its half of a cylinder.
    straight = replace(field, astray=np.zeros_like(field.astray), off=field.off[:0])
    halves = field.halves[labels]
    alike = (labels[:, :, None] == labels[:, None]) & halves[:, :, None] & halves[:, None]
    lost = (alike * np.triu(field.astray, 1)).sum(axis=(1, 2))
    assert np.array(alone) - judge.scores_of(straight, labels) == pytest.approx(lost)


def test_labels_that_have_settled_are_mended_again_once_they_are_others(excavator: Template) -> None:
    field = field_of([{"boom": {"name": 1.0}, "arm": {"name": 0.5}}] * 3, [_bond(0, 1)], excavator, weights())
    nothing = np.full((2, 3), len(field.bodies), dtype=np.int64)
    state, rng = Annealing(field, nothing), np.random.default_rng(0)
    for _ in range(4):
        state.sweep(0.0, rng)
    settled = state.labels.copy()
    assert (settled == field.bodies.index("boom")).all()
    state.take(nothing)
    state.sweep(0.0, rng)
    assert (state.labels == settled).all()


def test_a_body_nothing_names_borrows_its_neighbours_name(excavator: Template) -> None:
    said = borrowed([{"arm": 1.0}, {"bucket": 1.0}], excavator)
    assert said[0]["boom"] == pytest.approx(LENT)
    assert "boom" not in borrowed([{"arm": 1.0}, {"boom": 1.0}], excavator)[0]


def test_an_arm_borrows_from_the_nearest_that_is_named(excavator: Template) -> None:
    """`lever1`, `lever2`, where levers are links: one may be the arm, and another the boom behind it."""
    said = borrowed([{"tipping_link": 1.0}, {"tipping_link": 1.0}], excavator)
    assert said[0]["arm"] == pytest.approx(LENT)
    assert said[0]["boom"] == pytest.approx(LENT**2)


def test_of_links_named_alike_one_may_be_the_other(excavator: Template) -> None:
    """`bucket_link_1`, `bucket_link_2`, on one rod."""
    arms = [{"boom": 1.0}, {"arm": 1.0}]
    links = borrowed([*arms, {"bucket_link": 1.0}, {"bucket_link": 1.0}], excavator)[2:]
    assert [said["tipping_link"] for said in links] == pytest.approx([LENT, LENT])
    both = borrowed([*arms, {"bucket_link": 1.0}, {"tipping_link": 1.0}], excavator)[2:]
    assert both == [{"bucket_link": 1.0}, {"tipping_link": 1.0}]


def test_where_no_barrel_is_named_a_piston_may_be_all_of_a_cylinder(excavator: Template) -> None:
    piston = {"boom_piston_rod": 0.5, "arm_piston_rod": 0.5}
    assert borrowed([piston], excavator)[0]["boom_cylinder_barrel"] == pytest.approx(0.5 * LENT)
    assert borrowed([piston, {"arm_cylinder_barrel": 0.8}], excavator)[0].get("boom_cylinder_barrel", 0.0) == 0.0


def test_the_scenes_tree_tells_what_carries_what(excavator: Template) -> None:
    """Of two pieces that could be either, the child is the one farther from the root."""
    either = [{"boom": {}, "arm": {}}, {"boom": {}, "arm": {}}]
    for branch, bodies in ((1, ["boom", "arm"]), (-1, ["arm", "boom"])):
        bond = replace(_bond(0, 1), same={}, branch=branch)
        field = field_of(either, [bond], excavator, weights())
        labels, _ = labelled(field)
        assert [field.bodies[n] for n in labels] == bodies


def test_a_large_assembly_binds_no_more_than_a_small_one() -> None:
    few, many = (_together([set(range(n))], 99.0) for n in (3, 31))
    assert set(few.values()) == {1.0}
    of_one = sum(share for pair, share in many.items() if 0 in pair)
    assert of_one == pytest.approx(ENOUGH)
    assert _together([set(range(31))], 30.0) == {}


@given(st.integers(0, 1000))
@settings(max_examples=20, deadline=None)
def test_a_part_of_a_machine_stands_where_that_part_usually_is(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1.0, 1.0, (50, 3)) * rng.uniform(0.1, 30.0) + rng.uniform(-9.0, 9.0, 3)
    low = rng.uniform(-0.3, 0.2, 3)
    high = low + rng.uniform(0.05, 0.5, 3)
    rotation = Rotation.random(rng=seed).as_matrix()
    part = Stance(rotation, np.zeros(3), 7.0, 1.0).as_part(points, low, high, 0.25, {"arm"})
    places = part.place(points)
    assert (part.drawn, part.absent) == (0.25, {"arm"})
    assert 0.5 * (places.min(axis=0) + places.max(axis=0)) == pytest.approx(0.5 * (low + high), abs=1e-9)
    assert np.linalg.norm(np.ptp(places, axis=0)) == pytest.approx(np.linalg.norm(high - low), rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
@pytest.mark.parametrize("seed", [2, 4])
def test_the_stance_is_read_off_the_surface(kind: str, seed: int) -> None:
    """Turned anyhow: up within 15 degrees (a loader's wheels on a rolled axle), forward the right way round."""
    machine = drawn(kind, seed)
    assembly, _, back = disguise(machine, seed)
    solids = solids_of(assembly)
    stance = stance_of(solids, size_of(solids))
    cosines = np.einsum("ij,ij->i", stance.rotation, np.asarray(back)[:3, :3])
    assert cosines[2] > np.cos(np.radians(15))
    assert cosines[0] > np.cos(np.radians(25))  # it may be drawn while steering
    turned = stance.turned()
    assert np.allclose(turned.rotation[2], stance.rotation[2])
    assert np.linalg.det(turned.rotation) == pytest.approx(1.0)


@pytest.mark.slow
def test_names_lead_where_the_geometry_is_not_whole() -> None:
    """Half of the triangles gone, no pins and no holes told apart: the names still say what is what, and whatever is
    wrong is listed."""
    given_scene = scene("excavator", 3, "decimated 30", names="with")
    parts = tuple(
        replace(p, transform=p.transform) for p in given_scene.assembly.parts if "pin" not in p.name.casefold()
    )
    found = align(
        replace(given_scene.assembly, parts=parts), load_template("excavator"), Specifications()
    )  # fmt: skip
    bodies = {p.body for p in found.parts}
    assert {"undercarriage", "upperstructure", "boom", "arm", "bucket"} <= bodies


def test_a_cylinder_may_be_called_after_the_arm_it_stands_on(excavator: Template) -> None:
    """`Stick_Ram` alone is the arm's; where the bucket's is named nowhere, it may be the bucket's, and the boom's the
    arm's."""
    said = [{"boom_cylinder_barrel": 0.8}, {"boom_cylinder_barrel": 0.8}, {"arm_cylinder_barrel": 0.8}]
    lent = borrowed(said, excavator)
    assert 0.6 < lent[2]["bucket_cylinder_barrel"] < lent[2]["arm_cylinder_barrel"]
    assert 0.6 < lent[1]["arm_cylinder_barrel"] < lent[1]["boom_cylinder_barrel"]
    named = [*said, {"bucket_cylinder_barrel": 0.8}]
    assert borrowed(named, excavator) == named
    loader = choose(load_template("wheel_loader"), {})
    (steering,) = borrowed([{"steering_cylinder_barrel_l": 0.9}], loader)
    assert steering.keys() == {"steering_cylinder_barrel_l", "steering_cylinder_barrel_r"}


def test_what_is_called_the_left_one_may_be_the_right_one() -> None:
    """A loader whose four wheels had their sides exchanged was read with its front behind: 17 % of its surface."""
    loader = choose(load_template("wheel_loader"), {})
    said = [{"front_wheel_l": 1.0}, {"front_wheel_r": 1.0}, {"bucket": 0.8}]
    left, right, bucket = borrowed(said, loader)
    assert left == {"front_wheel_l": 1.0, "front_wheel_r": LENT}
    assert right == {"front_wheel_r": 1.0, "front_wheel_l": LENT}
    assert bucket == said[2]


def _in_assemblies(*rows: tuple[str, float, float]) -> tuple[Any, list[Any]]:
    """Cubes of 1 m in assemblies, from `low` on along x: an observation and its pieces."""
    parts = [SimpleNamespace(part=SimpleNamespace(path=("all", name))) for name, _, _ in rows]
    pieces = [
        SimpleNamespace(
            members=frozenset({k}), low=np.array([low, 0.0, 0.0]), high=np.array([high, 1.0, 1.0]), area=1.0
        )
        for k, (_, low, high) in enumerate(rows)
    ]
    return SimpleNamespace(solids=parts), pieces


@pytest.mark.parametrize(("end", "bound"), [(5.0, True), (12.0, False)])
def test_an_assembly_that_reaches_all_over_the_machine_binds_nothing(end: float, bound: bool) -> None:
    """Its outside is no body, though few pieces are in it; an arm's assembly is."""
    rest = [(f"rest {k}", float(k), k + 1.0) for k in range(1, 12)]
    observation, pieces = _in_assemblies(("group", 0.0, 1.0), ("group", end - 1.0, end), *rest)
    assert ((0, 1) in _kin(observation, pieces)) == bound


@pytest.mark.parametrize(
    ("names", "alone"), [(("bucket", "bucket", ""), True), (("bucket", "boom", ""), False), (("bucket", "", ""), False)]
)
def test_one_name_for_most_of_a_machine_grounds_nothing(names: tuple[str, ...], alone: bool) -> None:
    pieces = [SimpleNamespace(members=frozenset({k}), area=1.0) for k in range(len(names))]
    scores = [{name: 1.0} if name else {} for name in names]
    assert _one_name(cast(Any, SimpleNamespace(pieces=pieces, scores=scores, surface=3.0))) == alone


@pytest.mark.parametrize(("surfaces", "told"), [((5.0, 1.0, 4.0), True), ((5.0, 4.0, 1.0), False)])
def test_contacts_that_make_one_body_of_most_of_a_machine_say_nothing(surfaces: tuple[float, ...], told: bool) -> None:
    """A carriage that slides on its mast, and this on the chassis without pins, was one body with them."""
    observation: Any = SimpleNamespace(solids=[SimpleNamespace(surface=area) for area in surfaces])
    structure: Any = SimpleNamespace(clusters=[SimpleNamespace(members={0, 1}), SimpleNamespace(members={2})])
    assert _welded(observation, structure) == ({0: 0, 1: 0, 2: 1} if told else {2: 1})


def test_what_stands_beside_an_arm_that_is_lost_is_doubted() -> None:
    """A boom that was called `Front_Forks` was the bucket, without a word, on a loader without cylinders; a rocker or a
    link that is not drawn casts no doubt."""
    loader = choose(load_template("wheel_loader"), {"lift_cylinders": "twin"})
    for frames in (("rear_frame",), ("rear_frame", "front_frame")):
        assert {"front_frame", "bucket"} <= beside_lost_arms(loader, {*frames, "bucket"})
        assert not beside_lost_arms(loader, {*frames, "boom", "bucket"})
    assert not beside_lost_arms(loader, {"rear_frame", "front_frame"})  # nothing hangs on it


def test_small_pieces_play_what_nothing_large_is_named_for() -> None:
    """A cut of a hydraulic cylinder into many small meshes that all bear its name."""
    piece = Piece(
        frozenset({0}), "", -1, 1.0, np.zeros(3), np.ones(3), np.zeros(3), np.ones(3), np.eye(3), np.zeros((1, 3))
    )
    large, small = replace(piece, area=10.0), replace(piece, members=frozenset({1}), area=0.001)
    assert leading((large, small), 1.0, {}) == [0]
    assert leading((large, small), 1.0, {0: "boom", 1: "boom"}) == [0]
    assert leading((large, small), 1.0, {0: "boom", 1: "arm_cylinder_barrel"}) == [0, 1]


def test_what_is_off_the_line_of_a_bar_is_not_of_its_half_of_a_cylinder(excavator: Template) -> None:
    bar = {"boom_piston_rod": {"bar": 1.0}, "boom": {}}
    lined = np.array([[False, True], [True, False]])
    together = field_of([bar, bar], [], excavator, weights())
    apart = field_of([bar, bar], [], excavator, weights(), lined)
    rods = np.full(2, together.bodies.index("boom_piston_rod"))
    assert score_of(apart, rods) == pytest.approx(score_of(together, rods) + weights()["astray"])
    labels, score = labelled(apart)
    assert score == pytest.approx(score_of(apart, labels))
    assert len(set(labels.tolist())) == 2


def test_a_pipe_along_a_bar_is_in_line_and_a_pedal_beside_it_is_not() -> None:
    def piece(center: tuple[float, float, float], spread: tuple[float, float, float]) -> Piece:
        middle, half = np.array(center), 0.5 * np.array(spread)
        return Piece(
            frozenset({0}), "", -1, 1.0, middle - half, middle + half, middle, np.array(spread), np.eye(3),
            middle[None],
        )  # fmt: skip

    bar = piece((0, 0, 0), (1.5, 0.1, 0.1))
    pipe, pedal = piece((0.2, 0.12, 0), (1.0, 0.02, 0.02)), piece((0.2, 0.5, 0), (0.2, 0.06, 0.06))
    assert out_of_line([bar, pipe, pedal]).tolist() == [[False, False, True], [False, False, True], [True, True, False]]


def test_names_against_everything_else_are_doubted(excavator: Template) -> None:
    """Three pieces in a row, of which the outer ones are boom and bucket: what is called a boom between them is told
    apart from what is called an arm there."""
    for name, doubted in (("arm", False), ("boom", True)):
        votes: list[dict[str, dict[str, float]]] = [
            {"boom": {"said": 1.0}}, {"arm": {}, "boom": {}}, {"bucket": {"said": 1.0}}
        ]  # fmt: skip
        votes[1][name] = {"name": 1.0}
        field = field_of(votes, [_bond(0, 1, hinge=True), _bond(1, 2, hinge=True)], excavator, weights())
        labels, _ = labelled(field)
        assert field.bodies[labels[1]] == name
        told = np.array([[weights()["name"] * v.get(b, {}).get("name", 0.0) for b in field.bodies] for v in votes])
        assert bool(against(field, labels, told)[1] > CONTRARY) is doubted


@pytest.mark.slow
def test_names_of_tools_are_as_good_as_none() -> None:
    """No cylinders: contacts alone do not find the machine, so that names would lead."""
    given = scene("loader", 4, "no cylinders", names="without")
    template = load_template(given.type)
    found = []
    for names in (["part"], ["Cube", "Cylinder", "Plane", "Circle"]):
        parts = tuple(
            replace(p, name=f"{names[k % len(names)]}.{k:03d}", path=()) for k, p in enumerate(given.assembly.parts)
        )
        alignment = align(replace(given.assembly, parts=parts), template, Specifications())
        found.append([(p.role, p.body) for p in alignment.parts])
    assert found[0] == found[1]


@pytest.mark.parametrize(
    ("contacts", "named", "held", "more", "before"),
    [(960.0, True, False, 0, False), (840.0, True, False, 0, True), (840.0, False, False, 0, False),
     (840.0, False, False, -1, False), (840.0, False, False, 1, True), (960.0, False, False, 1, False),
     (290.0, False, False, 0, True), (-50.0, False, False, 0, True), (-50.0, True, True, 1, False)],
)  # fmt: skip
def test_contacts_that_explain_a_part_of_a_machine_give_way(
    contacts: float, named: bool, held: bool, more: int, before: bool
) -> None:
    """To names where the judge finds them better, without names only where it finds another reading better by far, or
    one with more of the joints that contacts show: a public excavator whose parts had been moved by a thousandth of its
    height was read by 13 joints, an arm's cylinder its undercarriage, where the judge had 17."""
    template = choose(load_template("wheel_loader"), {"lift_cylinders": "twin"})
    hinges = [j.name for j in template.joints if j.type == "revolute"]

    def found(count: int) -> Answer:
        solution = SimpleNamespace(hinge_of=dict.fromkeys(hinges[:count], 0), slide_of={})
        return cast("Answer", SimpleNamespace(template=template, solution=solution))

    judged = _Judged(found(5 + more), None, 0.5, 1000.0, contacts)
    assert judged.goes_before(found(5), held=held, named=named) is before


@pytest.mark.slow
def test_the_judge_begins_from_what_the_contacts_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where annealing comes by nothing at all, the judge has what the contacts found: it takes no reading that it
    judges less well."""
    template = load_template("wheel_loader")
    assembly = drawn("loader", 3).assembly()
    search = Search(lambda contact: observe(assembly, template, contact), template, Specifications(), {}, {})
    answer, observation, _ = search.run()
    anneal = reading.labelled

    def lost(field: Field, start: Any = None, **how: Any) -> Any:
        labels = np.full(len(field.unary), len(field.bodies))
        return anneal(field, start, sweeps=0, chains=1) if start is not None and start.any() else (labels, 0.0)

    monkeypatch.setattr(reading, "labelled", lost)
    nothing = [dict[str, float]() for _ in observation.solids]
    found = reading.fused(observation, template, [dict(answer.choices)], nothing, answer, {})
    assert found.score >= found.contacts > 0.0
    played = set(found.answer.solution.body_of.values())
    assert {"rear_frame", "front_frame", "boom", "bucket"} <= played
