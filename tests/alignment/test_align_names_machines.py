"""Names on whole machines: right ones, in any language and however spelled, make no result worse; wrong ones are found
out by the joints. `benchmarks/bench_names.py` measures the same on many more."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.defects import spoiled
from kit.machines.spoken_names import LANGUAGES, in_assemblies, misleading, mistyped, named, shuffled, spoken, truncated
from kit.machines.synthetic import disguise
from yellowiron.alignment import align
from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.assignment.names import concepts, name_scores, vocabulary
from yellowiron.alignment.assignment.weights import name_agreement
from yellowiron.alignment.structure.clusters import Cluster, Structure
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Part
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose

TYPES = {"loader": "wheel_loader", "excavator": "excavator"}
RIGHT = {"typos": mistyped, "cut": truncated, "assemblies": in_assemblies}
WRONG = {"shuffled": shuffled, "opposite": misleading}
SLOW = pytest.mark.slow


def aligned(kind: str, defect: str, way: str, seed: int = 4) -> tuple[Alignment, int, int]:
    """The alignment, how many parts are wrong, and how many of these are not listed for review."""
    template = load_template(TYPES[kind])
    assembly, truth, _ = disguise(spoiled(kind, seed, defect), seed)
    if way:
        assembly = named(assembly, truth, way if way in LANGUAGES else "en", seed, kind=kind)
        change = {**RIGHT, **WRONG}.get(way)
        assembly = change(assembly, np.random.default_rng(seed)) if change is not None else assembly
    found = align(assembly, template, Specifications())
    wrong = [p.part for p in found.parts if truth[p.part][1] and p.body != truth[p.part][1]]
    return found, len(wrong), len(set(wrong) - set(found.to_review))


@pytest.mark.parametrize("way", ["zh", *(pytest.param(w, marks=SLOW) for w in ("de", "typos", "cut", "assemblies"))])
def test_right_names_make_nothing_worse(way: str) -> None:
    found, wrong, silent = aligned("loader", "merged", way)
    bare, bare_wrong, bare_silent = aligned("loader", "merged", "")
    assert (wrong, silent) <= (bare_wrong, bare_silent)
    assert len(found.to_review) <= len(bare.to_review)
    assert "ALN015" not in {f.code for f in found.findings}


@pytest.mark.slow
@pytest.mark.parametrize("way", ["shuffled", pytest.param("opposite", marks=SLOW)])
def test_wrong_names_are_found_out(way: str) -> None:
    found, wrong, silent = aligned("loader", "sound", way)
    _, bare_wrong, bare_silent = aligned("loader", "sound", "")
    assert (wrong, silent) <= (bare_wrong, bare_silent)
    assert "ALN015" in {f.code for f in found.findings}


@pytest.mark.parametrize("kind", TYPES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_every_body_is_known_by_what_it_is_called(kind: str, language: str) -> None:
    """In every language each body's name speaks of that body more than of any other."""
    template = load_template(TYPES[kind])
    bodies = [r.name for r in choose(template, {"boom_type": "two_piece", "blade": "fitted"}).roles if r.rigid]
    names = {b: word for b in bodies if (word := spoken(b, language, kind=kind))}
    parts = tuple(Part(b, f"{word} 03", ("X",), "", np.eye(4)) for b, word in names.items())
    scores = name_scores(parts, template)
    wrong = []
    for part, score in zip(parts, scores, strict=True):
        best = max(score.values(), default=0.0)
        if score.get(part.id, 0.0) < best or not best:
            wrong.append((part.id, part.name, sorted(concepts(part.name, vocabulary(template))), score))
    assert wrong == []


def test_name_agreement_is_beyond_chance() -> None:
    """Ten parts of each of two bodies: all agree, half agree (as by chance), none agrees; few names prove little."""
    clusters = (Cluster(frozenset(range(10))), Cluster(frozenset(range(10, 20))))
    structure, solution = Structure(clusters), Solution({0: "boom", 1: "bucket"}, {}, {}, 0, 0, True)

    def scores(right: int) -> list[dict[str, float]]:
        own = ["boom"] * 10 + ["bucket"] * 10
        other = own[::-1]
        return [{(own if k % 10 < right else other)[k]: 1.0} for k in range(20)]

    assert name_agreement(structure, solution, scores(10)) == pytest.approx(1.0)
    assert name_agreement(structure, solution, scores(5)) == pytest.approx(6 / 26)
    assert name_agreement(structure, solution, scores(0)) == 0.0
    assert name_agreement(structure, solution, [{}] * 20) == 1.0
    assert name_agreement(structure, solution, [{"bucket": 1.0}, *[{}] * 19]) > 0.6
