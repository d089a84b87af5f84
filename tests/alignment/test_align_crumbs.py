"""Machines in crumbs: what each body has of the surface, what the place of a crumb counts, bars across the machine."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.fusion import votes as votes_module
from yellowiron.alignment.fusion.best import Best, Surfaces, by_surface
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.evidence import Evidence
from yellowiron.alignment.fusion.judge import field_of, weights
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.alignment.fusion.votes import ACROSS, votes_of
from yellowiron.library import load_template
from yellowiron.model.template import Template, choose

STANCE = Stance(np.eye(3), np.zeros(3), 10.0, 1.0)


@pytest.fixture(scope="module")
def excavator() -> Template:
    return choose(load_template("excavator"), {"boom_cylinders": "single"})


def piece(number: int, area: float, axis: tuple[float, float, float] = (1.0, 0.0, 0.0), thick: float = 0.5) -> Piece:
    axes = np.linalg.svd(np.array([axis]))[2]
    samples = np.outer(np.linspace(-0.5, 0.5, 20), axis) + np.array([1.0, 0.0, 2.0])
    low, high = samples.min(axis=0), samples.max(axis=0)
    spread = np.array([1.0, thick, thick])
    return Piece(frozenset({number}), "", -1, area, low, high, 0.5 * (low + high), spread, axes, samples, 1.0)


def evidence(pieces: list[Piece], leading: tuple[int, ...]) -> Evidence:
    surface = sum(p.area for p in pieces)
    return Evidence(
        tuple(pieces), leading, (), 0.0, frozenset(), STANCE, (), cast(Any, None), {}, frozenset(), surface
    )  # fmt: skip


def in_crumbs(template: Template, *, bucket: int) -> tuple[Best, Evidence]:
    """A machine of 40 shells as it was read: all of its bucket but a `bucket`'s number of shells is the arm's."""
    bodies = ("undercarriage", "upperstructure", "boom", "arm", "bucket")
    names = [body for body in bodies for _ in range(8)]
    pieces = [piece(k, template.usual[body].area / 8) for k, body in enumerate(names)]
    beside = [Bond(k, k + 1, {"beside": 1.0}, True, False, False) for k in range(39)]
    told: list[dict[str, dict[str, float]]] = [
        {b: {"place": 0.0} for b in (("arm", "bucket") if body == "bucket" else (body,))} for body in names
    ]
    known = evidence(pieces, tuple(range(40)))
    field = field_of(told, beside, template, weights())
    labels = np.array([field.bodies.index(b if b != "bucket" or k >= 40 - bucket else "arm")
                       for k, b in enumerate(names)])  # fmt: skip
    return Best(1.0, {}, template, field, labels, told, known.leading), known


def test_a_body_of_a_tenth_of_its_surface_is_given_what_it_lacks(excavator: Template) -> None:
    best, known = in_crumbs(excavator, bucket=1)
    found = by_surface(best, known)
    assert sum(found.field.bodies[n] == "bucket" for n in best.labels) == 1
    assert sum(found.field.bodies[n] == "bucket" for n in found.labels) >= 4
    assert (found.labels[:32] == best.labels[:32]).all()
    assert found.score == best.score, "variants compare by the score as it was"


def test_what_has_its_surface_stays_as_it_is(excavator: Template) -> None:
    best, known = in_crumbs(excavator, bucket=8)
    assert by_surface(best, known) is best


def test_no_body_is_lost_to_its_surface_nor_one_that_was_put_between_two(excavator: Template) -> None:
    best, known = in_crumbs(excavator, bucket=1)
    between = replace(best, between=dict.fromkeys(range(32, 40), "is between"))
    found = by_surface(between, known)
    assert (found.labels[32:] == best.labels[32:]).all()
    assert set(best.labels.tolist()) <= set(found.labels.tolist())


def test_surfaces_speak_of_no_halves_of_cylinders_and_not_against_tracks_apart(excavator: Template) -> None:
    best, known = in_crumbs(excavator, bucket=8)
    bodies = best.field.bodies
    surfaces = Surfaces(best.field, excavator, known, known.leading)
    assert not any(surfaces.known[k] for k, b in enumerate(bodies) if "barrel" in b or "rod" in b)
    few = np.where(np.arange(40) < 7, len(bodies), best.labels)[None]
    cost = surfaces.cost(few)[0]
    # The same where most of the machine's surface is tracks, which are no pieces.
    tracked = Surfaces(best.field, excavator, replace(known, surface=2.0 * known.surface), known.leading)
    root = bodies.index("undercarriage")
    alone = few.copy()
    alone[alone != root] = len(bodies)
    assert cost < surfaces.cost(best.labels[None])[0]
    assert tracked.cost(alone)[0] == 0.0 > surfaces.cost(alone)[0]


def test_the_place_of_a_crumb_counts_less(excavator: Template) -> None:
    usual = excavator.usual["tipping_link"].area
    pieces = [piece(0, 1.0 - 1.1 * usual), piece(1, usual), piece(2, 0.1 * usual)]
    known = evidence(pieces, (0,))
    told = {"place": -3.0, "bar": 1.0}
    whole, crumb = (known.as_crumb(k, "tipping_link", told, excavator) for k in (1, 2))
    assert whole == told
    assert crumb == {"place": pytest.approx(-0.9, rel=0.2), "bar": 1.0}
    assert known.as_crumb(2, "no such body", told, excavator) == told


@pytest.mark.parametrize(("axis", "across"), [((1.0, 0.0, 0.0), False), ((0.0, 1.0, 0.0), True)])
def test_a_bar_across_the_machine_is_hardly_half_of_a_cylinder_without_room(
    excavator: Template, monkeypatch: pytest.MonkeyPatch, axis: tuple[float, float, float], across: bool
) -> None:
    monkeypatch.setattr(votes_module, "_solved", lambda answer: {})
    bar = piece(0, 0.01, axis, thick=0.05)

    def told(template: Template, name: dict[str, float]) -> dict[str, Any]:
        answer = cast(Answer, SimpleNamespace())
        (mine,) = votes_of([bar], template, [name], [1.0], answer, STANCE, {}, 1.0)
        return dict(mine)

    assert told(excavator, {})["boom_cylinder_barrel"].get("no bar", 0.0) == (ACROSS if across else 0.0)
    called = told(excavator, {"boom_cylinder_barrel": 1.0})["boom_cylinder_barrel"]
    assert called.get("no bar", 0.0) == (1.0 if across else 0.0), "unless it is called so"
    truck = choose(load_template("rigid_dump_truck"), {})
    steering = told(truck, {})["steering_cylinder_barrel_l"]
    assert steering.get("no bar", 0.0) == (1.0 if across else 0.0), "a steering cylinder lies across"
