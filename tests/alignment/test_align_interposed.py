"""Bodies between two others: a mini excavator's swing bracket that names, or whole meshes, do not show."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from yellowiron.alignment import between_apart, between_found
from yellowiron.alignment.axes import estimate
from yellowiron.alignment.axes.values import Candidate
from yellowiron.alignment.fusion.best import Best, field_of_leading, whole_score
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.evidence import _namesakes
from yellowiron.alignment.fusion.interposed import interposed
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.finding import Finding
from yellowiron.model.template import Template, choose

CHAIN = ("undercarriage", "upperstructure", "boom", "arm", "bucket")
BRACKET = len(CHAIN)
"""The number of the piece between upperstructure and boom."""


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("excavator")


def _beside(a: int, b: int, *, turned: bool = False, level: bool = False) -> Bond:
    return Bond(a, b, {"beside": 1.0}, True, turned or level, False, turned=turned, level=level)


def _machine(*, pinned: bool, own: bool, name: float = 1.0, place: float = -1.0) -> Any:
    """Five bodies in a row that a person named, and a small piece between the second and the third, called as the
    second is (`own`: by a name that no other piece bears), with an upright pin to it or not;
    `place`: what speaks against its being a bracket there."""
    sure: list[dict[str, dict[str, float]]] = [{body: {"said": 1.0}} for body in CHAIN]
    bracket = {"upperstructure": {"name": name, "place": 1.0}, "swing_bracket": {"place": place}}
    pieces = [
        SimpleNamespace(kind="", area=area, slender=False, center=np.zeros(3), spread=np.ones(3))
        for area in (4.0, 3.0, 1.0, 1.0, 1.0, 0.2)
    ]
    bonds = [
        _beside(0, 1, turned=True), _beside(1, BRACKET, turned=pinned), _beside(2, BRACKET, level=True),
        _beside(2, 3, level=True), _beside(3, 4, level=True),
    ]  # fmt: skip

    def votes(resolved: Template) -> list[dict[str, dict[str, float]]]:
        return [{body: what for body, what in mine.items() if resolved.knows(body)} for mine in (*sure, bracket)]

    return SimpleNamespace(
        pieces=pieces, leading=tuple(range(len(pieces))), between=bonds, votes=votes, surface=10.2,
        shared=frozenset(), borne=frozenset(), namesakes=frozenset() if own else frozenset({1, BRACKET}),
        stance=SimpleNamespace(absent=frozenset()), crowding=0.0,
    )  # fmt: skip


def _read(evidence: Any, template: Template) -> tuple[Best, frozenset[int]]:
    """The machine read without a bracket, and what is made of that."""
    plain, swing = ({"boom_cylinders": "single", "boom_type": kind, "blade": "none"} for kind in ("mono", "swing"))
    machines = [(chosen, choose(template, chosen)) for chosen in (plain, swing)]
    resolved = machines[0][1]
    votes = evidence.votes(resolved)
    field = field_of_leading(evidence, votes, resolved)
    labels = np.array([field.bodies.index(b) for b in (*CHAIN, "upperstructure")])
    score = whole_score(evidence, field, labels, resolved)
    return interposed(Best(score, plain, resolved, field, labels, votes, evidence.leading), machines, evidence)


def test_a_bracket_that_is_called_after_its_file_is_found(template: Template) -> None:
    """Of a file called after the upperstructure one mesh turns on the others about an upright pin, and the boom on it:
    it was the upperstructure by that name, without a word."""
    found, doubtful = _read(_machine(pinned=True, own=False), template)
    assert found.choices["boom_type"] == "swing"
    assert found.field.bodies[found.labels[BRACKET]] == "swing_bracket"
    assert set(found.between) == {BRACKET}
    assert not doubtful


@pytest.mark.parametrize(("pinned", "own"), [(True, True), (False, False)])
def test_its_own_name_and_the_want_of_a_pin_keep_it(template: Template, pinned: bool, own: bool) -> None:
    """What bears a name of its own is what that says; and what nothing turns is no bracket."""
    found, doubtful = _read(_machine(pinned=pinned, own=own), template)
    assert found.choices["boom_type"] == "mono"
    assert not found.between
    assert not doubtful


def test_a_bracket_is_where_brackets_usually_are(template: Template) -> None:
    """A drum that an artist sank into the house under the boom, too high and too far behind for a bracket, is none."""
    found, doubtful = _read(_machine(pinned=True, own=False, place=1.5), template)
    assert found.choices["boom_type"] == "mono"
    assert not doubtful


def test_what_could_as_well_be_a_bracket_is_doubtful(template: Template) -> None:
    leads = [_read(_machine(pinned=True, own=True, name=share), template) for share in np.linspace(0.0, 1.0, 21)]
    kinds = [found.choices["boom_type"] if not doubtful else "doubtful" for found, doubtful in leads]
    assert kinds == sorted(kinds, key=["swing", "doubtful", "mono"].index)
    assert set(kinds) == {"swing", "doubtful", "mono"}
    assert all(doubtful == {BRACKET} for _, doubtful in leads if doubtful)


@pytest.mark.parametrize("near", ["upperstructure", "arm"])
def test_what_is_beside_neither_of_the_two_is_no_bracket(template: Template, near: str) -> None:
    """The bracket of a camera under an arm is called a bracket, and was a swing bracket for that, without a word."""
    plain, swing = ({"boom_cylinders": "single", "boom_type": kind, "blade": "none"} for kind in ("mono", "swing"))
    machines = [(chosen, choose(template, chosen)) for chosen in (plain, swing)]
    evidence = _machine(pinned=False, own=True)
    evidence.between[1:3] = [_beside(CHAIN.index(near), BRACKET), _beside(1, 2, level=True)]
    votes = evidence.votes(machines[1][1])
    field = field_of_leading(evidence, votes, machines[1][1])
    labels = np.array([field.bodies.index(b) for b in (*CHAIN, "swing_bracket")])
    best = Best(1e3, swing, machines[1][1], field, labels, votes, evidence.leading)
    found, doubtful = interposed(best, machines, evidence)
    stray = near == "arm"
    assert found.choices["boom_type"] == ("mono" if stray else "swing")
    assert doubtful == ({BRACKET} if stray else frozenset())
    if stray:
        assert [found.field.bodies[n] for n in found.labels[:BRACKET]] == list(CHAIN)


def test_what_several_pieces_are_called_but_for_their_number_is_no_name_of_their_own() -> None:
    names = ["upper_1", "upper_2", "upper-3", "link_1", "link_2", "boom"]
    parts = cast("Any", [[SimpleNamespace(name=name)] for name in names])
    assert _namesakes(parts) == {0, 1, 2}


def _alignment(template: Template, boom: str, bodies: tuple[str, ...], guessed: tuple[str, ...] = ()) -> Alignment:
    parts = tuple(PartAssignment(f"part {n}", b, b, 0.9, "") for n, b in enumerate(bodies))
    findings = tuple(Finding("ALN016", "info", joint, "estimated", "") for joint in guessed)
    choices = {"boom_cylinders": "single", "boom_type": boom, "blade": "none"}
    return Alignment(template.equipment_type, np.eye(4), parts, choices, (), (), findings, {}, {})


def test_taking_apart_finds_a_bracket_that_pins_show(template: Template) -> None:
    whole = _alignment(template, "mono", CHAIN)
    apart = _alignment(template, "swing", (*CHAIN, "swing_bracket"))
    assert between_found(whole, apart, template) == {"swing_bracket"}
    assert not between_found(apart, whole, template)
    assert not between_found(apart, apart, template)
    assert between_apart(whole, apart, template) == {"swing_bracket"}
    mesh = replace(whole, parts=(*whole.parts, replace(apart.parts[-1], role="boom", body="boom")))
    assert between_found(mesh, apart, template)
    assert not between_apart(mesh, apart, template), "what is a mesh of its own is what it was found to be"
    fewer = replace(apart, parts=tuple(p for p in apart.parts if p.body != "bucket"))
    assert not between_apart(whole, fewer, template)
    guess = _alignment(template, "swing", (*CHAIN, "swing_bracket"), ("upperstructure2swing_bracket_joint",))
    assert not between_found(whole, guess, template)


def test_a_pivot_on_the_slewing_axis_is_not_the_brackets(template: Template, monkeypatch: pytest.MonkeyPatch) -> None:
    """All that is of one file has its origin, on the slewing axis: the bracket does not turn about that."""
    swing = choose(template, {"boom_cylinders": "single", "boom_type": "swing", "blade": "none"})
    slewing, bracket = "undercarriage2upperstructure_joint", "upperstructure2swing_bracket_joint"
    up = np.array([0.0, 0.0, 1.0])

    def shown(a: str, b: str, _: Any) -> Candidate:
        at, quality = (0.0, 1.0) if "undercarriage" in (a, b) else (0.9, 0.1)
        return Candidate(np.array([at, 0.0, 0.5]), up, 1e-3, 1e-3, quality, "")

    monkeypatch.setattr(estimate, "slewing_candidate", shown)
    bodies = cast("Any", {body: body for body in CHAIN} | {"swing_bracket": "swing_bracket"})
    pivots = {bracket: np.array([[0.0, 0.0, 0.6], [0.8, 0.0, 0.6]])}
    alone = [swing.joint(slewing), swing.joint(bracket)]
    left = estimate._slewing_pivots(alone, swing, bodies, cast("Any", None), pivots, 5.0)
    assert left[bracket].tolist() == [[0.8, 0.0, 0.6]]
    assert estimate._slewing_pivots(alone[:1], swing, bodies, cast("Any", None), pivots, 5.0) is pivots
