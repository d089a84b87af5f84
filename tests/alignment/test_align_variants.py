"""What decides between the variants of a type, and how far names are believed, where contacts find no machine."""

from __future__ import annotations

import itertools
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from yellowiron.alignment.fusion import evidence as known
from yellowiron.alignment.fusion import trust
from yellowiron.alignment.fusion.best import standing_for
from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.judge import weights
from yellowiron.alignment.fusion.played import lacks
from yellowiron.alignment.fusion.reading import _solution
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.alignment.fusion.trust import trust_in_names
from yellowiron.alignment.structure.clusters import Cluster, Hinge, Structure
from yellowiron.library import load_template
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def open_template() -> Template:
    return load_template("excavator")


def test_of_two_variants_that_explain_as_much_the_simpler_one_is_taken(open_template: Template) -> None:
    mono = choose(open_template, {"boom_cylinders": "twin", "boom_type": "mono"})
    two = choose(open_template, {"boom_cylinders": "twin", "boom_type": "two_piece"})
    bodies = {r.name for r in mono.roles if r.rigid}
    more = {r.name for r in two.roles if r.rigid and not r.optional} - bodies
    assert len(more) == 3
    assert lacks(two, bodies | more)["more"] - lacks(mono, bodies)["more"] == len(more)
    assert lacks(two, bodies | more)["missing"] == lacks(mono, bodies)["missing"] == 0
    assert lacks(two, bodies)["missing"] == len(more)
    assert weights()["more"] < 0 and weights()["missing"] < 0


def test_links_are_not_missed(open_template: Template) -> None:
    """They may be too small for a leading piece."""
    twin = choose(open_template, {"boom_cylinders": "twin", "boom_type": "mono"})
    bodies = {r.name for r in twin.roles if r.rigid}
    assert lacks(twin, bodies - {"tipping_link", "bucket_link"}) == lacks(twin, bodies)
    assert lacks(twin, bodies - {"bucket", "arm"})["missing"] == 2


def test_a_part_of_a_machine_misses_nothing_that_is_not_of_it(open_template: Template) -> None:
    twin = choose(open_template, {"boom_cylinders": "twin", "boom_type": "mono"})
    bodies = {r.name for r in twin.roles if r.rigid}
    carrier = {"undercarriage", "upperstructure"}
    whole, part = lacks(twin, bodies - carrier), lacks(twin, bodies - carrier, carrier)
    assert (whole["missing"], part["missing"]) == (2, 0)
    assert whole["more"] - part["more"] == 2
    assert (whole["part"], part["part"]) == (0, 1)


def test_few_pieces_need_less_to_be_a_part_of_a_machine(open_template: Template) -> None:
    """Four links of an excavator without its undercarriage were read as the undercarriage and what is on it: what each
    piece said for the part was less than what spoke against any part at all."""
    carrier = {"undercarriage"}
    few, several, many = (lacks(open_template, set(), carrier, n)["part"] for n in (4, 7, 40))
    assert (few, several, many) == (4, 7, 7)
    assert lacks(open_template, set(), (), 40)["part"] == 0


def test_names_of_bodies_that_only_some_machines_have_are_believed(open_template: Template) -> None:
    """A wheeled excavator's `SECOND_BOOM`, `BLADE` and their cylinders; its names were not believed at all."""
    chain = ["blade", "undercarriage", "upperstructure", "boom", "adjust_boom", "arm", "bucket"]
    pieces: Any = [SimpleNamespace(members=frozenset({k})) for k in range(len(chain))]
    bonds = [Bond(k, k + 1, {"beside": 1.0}, True, False, False) for k in range(len(chain) - 1)]
    called = [frozenset({((), name)}) for name in chain]
    assert trust_in_names(pieces, bonds, [{name: 1.0} for name in chain], open_template, called) == 1.0
    mixed = ["bucket", "upperstructure", "blade", "arm", "undercarriage", "boom", "adjust_boom"]
    assert trust_in_names(pieces, bonds, [{name: 1.0} for name in mixed], open_template, called) < 0.5


def test_solids_of_one_mesh_do_not_make_its_name_true(open_template: Template) -> None:
    """A mesh called arm that holds the boom and the upperstructure, taken apart: its solids touch, and agree."""
    pieces: Any = [SimpleNamespace(members=frozenset({k})) for k in range(10)]
    scores = [{"arm": 1.0}] * 5 + [{"undercarriage": 1.0}] * 5
    within = [(a, b) for a, b in itertools.combinations(range(10), 2) if (a < 5) == (b < 5)]
    beside = [*within, *((k, 5 + (k + more) % 5) for k in range(5) for more in (0, 1))]
    bonds = [Bond(a, b, {"beside": 1.0}, True, False, False) for a, b in beside]
    template = choose(open_template, {})
    apart = [frozenset({((), str(k))}) for k in range(10)]
    meshes = [frozenset({((), "arm" if k < 5 else "base")}) for k in range(10)]
    assert trust_in_names(pieces, bonds, scores, template, apart) > 0.0
    assert trust_in_names(pieces, bonds, scores, template, meshes) == 0.0


@pytest.mark.parametrize(("direction", "found"), [((0.0, 0.0, 1.0), True), ((0.0, 0.0, -1.0), True),
                                                  ((0.7, 0.0, 0.7), False), ((0.0, 1.0, 0.0), False)])  # fmt: skip
def test_what_slews_turns_about_the_upright(
    open_template: Template, direction: tuple[float, float, float], found: bool
) -> None:
    """A tilted pin of the blade had been taken for the slewing bearing."""
    template = choose(open_template, {})
    clusters = (Cluster(frozenset({0})), Cluster(frozenset({1})))
    axis: Any = SimpleNamespace(direction=np.array(direction) / np.linalg.norm(direction))
    structure = Structure(clusters, (Hinge(0, 1, 0, (2,)),), axes=(axis,))
    best: Any = SimpleNamespace(template=template, score=0.0)
    stance = Stance(np.eye(3), np.zeros(3), 1.0, 1.0)
    solution = _solution(structure, {0: "undercarriage", 1: "upperstructure"}, best, stance)
    assert ("undercarriage2upperstructure_joint" in solution.hinge_of) == found


def test_the_name_of_a_mesh_counts_less_for_its_solids_and_least_for_its_bars(
    open_template: Template, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A cylinder that is drawn into the boom's mesh is called boom."""
    heard: list[float] = []

    def told(pieces: Any, template: Any, scores: Any, worth: list[float], *_: Any) -> list[dict[str, Any]]:
        heard.extend(worth)
        return [{"boom": {}, "undercarriage": {}} for _ in pieces]

    monkeypatch.setattr(known, "votes_of", told)
    pieces: Any = [SimpleNamespace(slender=slender) for slender in (False, False, True, True, False)]
    rest: Any = dict.fromkeys(("scores", "answer", "surface"))
    part = Stance(np.eye(3), np.zeros(3), 1.0, 1.0, absent=frozenset({"undercarriage"}))
    evidence = known.Evidence(
        pieces=pieces, leading=(), bonds=(), trust=0.8, shared=frozenset({1, 3}), pins=frozenset(),
        stance=part, edited={}, borne=frozenset({4}), **rest,
    )  # fmt: skip
    votes = evidence.votes(choose(open_template, {}))
    assert votes == [{"boom": {}}] * 5  # what is not drawn is nothing's
    assert heard == pytest.approx([0.8, 0.8 * trust.OF_SOLID, 0.8, 0.8 * trust.OF_BAR, 0.8 * trust.OF_CARRIER])
    assert trust.OF_BAR < trust.OF_SOLID < 1.0


def test_a_single_cylinder_stands_for_twins_and_the_left_one_for_it(open_template: Template) -> None:
    """Labels of the one variant were none of the other's, and whichever was annealed the better was the machine."""
    chosen = {"boom_type": "two_piece", "blade": "none"}
    twin, single = (choose(open_template, {**chosen, "boom_cylinders": kind}) for kind in ("twin", "single"))
    assert standing_for(twin, single) == {
        f"boom_{half}_{side}": f"boom_{half}" for half in ("cylinder_barrel", "piston_rod") for side in "lr"
    }
    assert standing_for(single, twin) == {
        "boom_cylinder_barrel": "boom_cylinder_barrel_l", "boom_piston_rod": "boom_piston_rod_l",
    }  # fmt: skip
    mono = choose(open_template, {**chosen, "boom_type": "mono", "boom_cylinders": "twin"})
    assert standing_for(mono, twin) == standing_for(twin, mono) == {}
