"""Links and cylinders by where they are on the limb that they hang on; estimated hinges as the linkage's found ones."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from yellowiron.alignment.axes.directions import Direction, as_found
from yellowiron.alignment.fusion.best import Best
from yellowiron.alignment.fusion.bonds import _paired
from yellowiron.alignment.fusion.evidence import Evidence
from yellowiron.alignment.fusion.judge import field_of, weights
from yellowiron.alignment.fusion.limbs import along_limbs, limb_of, limbs_in, on_limbs
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.library import load_template
from yellowiron.library.notation.validated_json import Document
from yellowiron.library.parsing.usual import read_usual
from yellowiron.model.errors import TemplateError
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template, choose

STANCE = Stance(np.eye(3), np.zeros(3), 10.0, 1.0)
ARM, BUCKET = (0, 1)


@pytest.fixture(scope="module")
def excavator() -> Template:
    return choose(load_template("excavator"), {"boom_cylinders": "single"})


def bar(start: tuple[float, float], end: tuple[float, float], width: float, number: int, degrees: float) -> Piece:
    """A square bar from one (along, across) to another, metres, turned about the left by so much: an arm 3 m long has
    its middle in 0, its tip ahead."""
    a, b = np.array([start[0], 0.0, start[1]]), np.array([end[0], 0.0, end[1]])
    t, side = (
        np.linspace(0.0, 1.0, 10)[:, None, None],
        0.5 * width * np.array([[0, 1, 1], [0, 1, -1], [0, -1, 1], [0, -1, -1]]),
    )
    points = (a + t * (b - a) + side).reshape(-1, 3)
    angle = math.radians(degrees)
    turn = np.array([[math.cos(angle), 0, math.sin(angle)], [0, 1, 0], [-math.sin(angle), 0, math.cos(angle)]])
    points = points @ turn.T + np.array([5.0, 0.0, 3.0])
    length = float(np.linalg.norm(b - a))
    spread = np.array([length, width, width])
    low, high = points.min(axis=0), points.max(axis=0)
    return Piece(frozenset({number}), "", -1, 4 * length * width, low, high, 0.5 * (low + high), spread, turn.T, points)


def machine(degrees: float) -> list[Piece]:
    """An arm, its bucket, a link at its tip and one that looks the same at its other end."""
    return [
        bar((-1.5, 0.0), (1.5, 0.0), 0.5, ARM, degrees),
        bar((1.5, -0.4), (2.5, -0.4), 0.9, BUCKET, degrees),
        bar((1.2, 0.1), (1.45, 0.45), 0.1, 2, degrees),
        bar((-1.2, 0.1), (-1.45, 0.45), 0.1, 3, degrees),
    ]


@pytest.mark.parametrize("degrees", [-20.0, 45.0, 100.0, 170.0])
def test_a_place_on_a_limb_is_the_same_however_it_is_turned(degrees: float) -> None:
    def on_the_arm(pieces: list[Piece]) -> Floats:
        limb = limb_of(STANCE.place(pieces[ARM].samples), STANCE.place(pieces[BUCKET].samples))
        return limb.place(STANCE.place(pieces[2].samples))

    turned = on_the_arm(machine(degrees))
    assert np.allclose(turned, on_the_arm(machine(0.0)), atol=1e-9)
    assert turned[:, 0].max() == pytest.approx(1.45 / 3.0, abs=0.01)
    assert turned[:, 2].max() > 0.1


def test_the_end_of_a_limb_tells_a_link_and_the_machine_s_frame_does_not(excavator: Template) -> None:
    pieces = machine(60.0)
    limbs = limbs_in(pieces, {ARM: "arm", BUCKET: "bucket"}, excavator, STANCE)
    assert {"tipping_link", "bucket_link", "bucket_piston_rod", "bucket_cylinder_barrel"} <= limbs.keys()
    assert not limbs_in(pieces, {ARM: "arm"}, excavator, STANCE), "which end carries the bucket is not known"
    votes = along_limbs([{"tipping_link": {"place": 0.0}, "arm": {}}] * 4, pieces, limbs, excavator, STANCE)
    tip, root = (votes[k]["tipping_link"]["place"] for k in (2, 3))
    assert tip < 0.0 < root
    assert votes[2]["arm"] == {}


@pytest.mark.parametrize("degrees", [20.0, 120.0])
def test_small_pieces_are_links_at_the_tip_of_an_arm_and_not_elsewhere(excavator: Template, degrees: float) -> None:
    """The arm had both: neither is large enough to lead, and in the machine's frame each could be the link."""
    rod = bar((0.1, 0.4), (1.2, 0.4), 0.1, 4, degrees)
    pieces = [*machine(degrees), rod]
    names = ("arm", "bucket", "bucket_piston_rod")
    votes = [{b: {"place": -1.0} for b in (*names, "tipping_link")} for _ in pieces]
    leading = (ARM, BUCKET, 4)
    field = field_of([votes[k] for k in leading], [], excavator, weights())
    labels = np.array([field.bodies.index(name) for name in names])
    best = Best(1.0, {}, excavator, field, labels, votes, leading)
    evidence = Evidence(
        tuple(pieces), leading, (), 0.0, frozenset(), STANCE, (), None, {}, frozenset(), 10.0  # type: ignore[arg-type]
    )  # fmt: skip
    found, wider = on_limbs(best, evidence)
    bodies = dict(zip(wider.leading, (found.field.bodies[n] for n in found.labels), strict=True))
    assert [bodies[k] for k in leading] == [*names]
    assert bodies.get(2) == "tipping_link"
    assert bodies.get(3) != "tipping_link"
    assert found.score == best.score


def test_without_a_limb_nothing_changes(excavator: Template) -> None:
    pieces = machine(20.0)
    field = field_of([{"boom": {}}], [], excavator, weights())
    best = Best(1.0, {}, excavator, field, np.array([field.bodies.index("boom")]), [{"boom": {}}] * 4, (ARM,))
    evidence = Evidence(
        tuple(pieces), (ARM,), (), 0.0, frozenset(), STANCE, (), None, {}, frozenset(), 10.0  # type: ignore[arg-type]
    )  # fmt: skip
    assert on_limbs(best, evidence) == (best, evidence)


def test_a_limb_that_is_no_body_is_told(excavator: Template) -> None:
    row = {"low": [0, 0, 0], "high": [1, 1, 1], "length": 1.0, "area": 0.1}
    along = {"limb": "arms", "toward": "bucket", "low": [0, 0, 0], "high": [1, 1, 1]}
    with pytest.raises(TemplateError, match="'arms' is no body"):
        read_usual(Document(Path("usual.json"), {"tipping_link": {**row, "along": along}}), excavator.roles)


def test_estimated_hinges_are_parallel_to_those_that_were_found() -> None:
    """A steering's pins were drawn, its articulation was not: it leaned by 1.6° and nothing moved."""
    lean = math.radians(1.6)
    way = Direction(np.array([math.sin(lean), 0.0, math.cos(lean)]), 0.01, "what is round in its bodies")
    up = np.array([0.0, 0.0, 1.0])
    assert np.allclose(as_found(way, [-up, up]).vector, up)
    assert as_found(way, [-up, up]).angle < way.angle
    assert as_found(way, []) is way
    assert as_found(way, [up]) is way, "one alone may lean itself"
    apart = np.array([0.0, math.sin(lean), math.cos(lean)])
    assert as_found(way, [up, apart]) is way, "they do not agree"
    assert as_found(way, [np.array([0.0, 1.0, 0.0])]) is way, "a hinge of another plane says nothing of this one"


@pytest.mark.parametrize(("ahead", "told"), [(True, {(1, 2)}), (False, set[tuple[int, int]]())])
def test_cylinders_of_a_boom_beside_the_cab_are_twins(ahead: bool, told: set[tuple[int, int]]) -> None:
    """Pairs are left and right of the middle of what works in front, too: 2 % of a machine's size to one side of its
    own, two of a boom's cylinders were the boom's and the arm's."""
    aside = np.array([0.0, 0.3, 0.0])

    def moved(piece: Piece, offset: Floats) -> Piece:
        ends = {"low": piece.low + offset, "high": piece.high + offset, "center": piece.center + offset}
        return replace(piece, samples=piece.samples + offset, **ends)

    boom, cylinder = (bar((-1.5, 0.0), (1.5, 0.0), width, n, 30.0) for n, width in ((0, 0.5), (1, 0.1)))
    pieces = [moved(boom, aside), *(moved(cylinder, aside + np.array([0.0, side, 0.0])) for side in (0.3, -0.3))]
    stance = replace(STANCE, origin=np.array([0.0 if ahead else 5.0, 0.0, 0.0]))
    assert _paired(pieces, stance) == told
