"""What each kind of evidence counts where contacts find no machine: `alignment/data/fusion.json`, fitted to machines
whose truth is known.

    python benchmarks/fit_fusion.py collect FOLDER [--first SEED] [--count N] [--damages …]
    python benchmarks/fit_fusion.py collect FOLDER --real [--models DIR] [--shake S,…]
    python benchmarks/fit_fusion.py fit FOLDER [--rounds N] [--loyal L] [--jobs N]
    python benchmarks/fit_fusion.py cross FOLDER [--rounds N] [--loyal L,…] [--folds K] [--jobs N]
    python benchmarks/fit_fusion.py show FOLDER [--jobs N]

From the repository's root. `collect` aligns damaged machines of ours, with and without names, and the real models with
labels that are not held back, and keeps what the judge was given wherever it was asked. The score is linear in its
weights, so they are learned by a structural support vector machine (Tsochantaridis 2005) whose right labelling is the
best of all that are right (Yu & Joachims 2009): in every round a labelling is looked for that is the most wrong for
what it scores, under any variant and however the machine may stand; the weights are those that keep all of them behind
the right ones, and near the weights in use (`loyal`). `show` prints the share of the surface labelled right, as the
leading pieces have it; `cross` that of machines that the weights were not learned of.
"""

from __future__ import annotations

import argparse
import json
import os
import pickle
import sys
import zlib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.spatial import cKDTree

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from bench_strangers import FOLDERS, LABELS  # noqa: E402
from kit.machines.damages import DAMAGES, KINDS  # noqa: E402
from kit.scene import Scene, scene  # noqa: E402
from strangers_models import Model, models, scene_of, upright_of  # noqa: E402
from strangers_shaken import shaken  # noqa: E402
from yellowiron.alignment import pipeline  # noqa: E402
from yellowiron.alignment.fusion import reading  # noqa: E402
from yellowiron.alignment.fusion.annealing import labelled  # noqa: E402
from yellowiron.alignment.fusion.bonds import out_of_line  # noqa: E402
from yellowiron.alignment.fusion.evidence import Evidence, evidence_of, ways_of  # noqa: E402
from yellowiron.alignment.fusion.judge import (  # noqa: E402
    Field,
    field_of,
    score_of,
    weighed,
    weights,
)
from yellowiron.alignment.fusion.pieces import largeness  # noqa: E402
from yellowiron.alignment.fusion.played import drawn_bodies, lacks  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.errors import YellowironError  # noqa: E402
from yellowiron.model.rows import as_drawn  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402
from yellowiron.model.template import Template, choose  # noqa: E402
from yellowiron.stages import find_roles  # noqa: E402

DATA = ROOT / "src/yellowiron/alignment/data/fusion.json"
MARGIN = 15.0
"""A right labelling should score this much more for every piece that a wrong one has wrong."""
SOFT = 3.0
"""The greatest of several slacks is taken softly, over so many points."""
SCALE = "name"
"""What this counts stays as it is: what a lead is worth is measured by it (`reading`)."""
FIXED = ("said",)
POSITIVE = ("name", "contacts", "said", "seen", "beside", "joined", "near", "exact")
MOSTLY = 0.7
"""A piece is of a body if so much of its surface is nearest to that body's: where it touches another, both are near."""
OWN = 2.0
"""A right labelling gives a piece its body, unless none is better by so many margins: small things go by contact."""
RIVALS = 3
"""So many variants are kept beside the right one, those that a glance likes best."""
Weights = dict[str, float]


@dataclass(frozen=True, eq=False)
class Way:
    """A machine as it may stand, under a variant with what is drawn of it; `right`: as it does stand, and is."""

    evidence: Evidence
    template: Template
    right: bool


@dataclass(frozen=True, eq=False)
class Problem:
    """What the judge was given once: `ways` to read a machine, areas of the leading pieces, and for each of them the
    bodies that are right (empty: nobody knows)."""

    name: str
    ways: list[Way]
    areas: list[float]
    right: list[frozenset[str]]


@dataclass(eq=False)
class Posed:
    """A problem with its votes, and what its right and its wrong labellings have of each kind of evidence."""

    problem: Problem
    votes: list[list[dict[str, Any]]]
    good: np.ndarray = field(default_factory=lambda: np.zeros(0))
    wrong: list[tuple[np.ndarray, float]] = field(default_factory=list)


def problems_of(name: str, given: Scene) -> list[Problem]:
    """The problems that aligning a scene poses: none where the contacts find the machine, one otherwise."""
    seen: list[Any] = []
    usual = pipeline.fused

    def caught(observation: Any, template: Template, variants: Any, scores: Any, answer: Any, *more: Any) -> Any:
        seen.append((observation, template, variants, scores, answer))
        return usual(observation, template, variants, scores, answer, *more)

    pipeline.fused = caught
    try:
        found, _ = find_roles(given.assembly, load_template(given.type), Specifications())
    finally:
        pipeline.fused = usual
    parts = {part.id for part in found.parts}  # as they are, or taken apart
    seen = [one for one in seen if all(solid.part.id in parts for solid in one[0].solids)]
    if not seen:
        return []
    observation, template, variants, scores, answer = seen[-1]
    evidence = evidence_of(observation, scores, answer, {}, template)
    right = _right_of(evidence, given, template)
    there = {b for _, body in given.truth.labels for b in body.split("|")}
    ways = ways_of(evidence, template, bool(observation.rows))
    resolved = [choose(template, c) for c in variants]
    best = max(resolved, key=lambda t: _fitting(t, there))
    areas = [evidence.pieces[k].area for k in evidence.leading]
    drawn = as_drawn(best, there)
    problem = Problem(name, [Way(e, drawn, False) for e in ways], areas, right)
    # Which end is the front is the judge's guess; what it is to learn from is the right one.
    scored = [_best_of(way, _votes(way), problem, dict(weights()), right=True)[1] for way in problem.ways]
    true = replace(problem.ways[int(np.argmax(scored))], right=True)
    others = [replace(true, template=t, right=False) for t in resolved if t is not best]
    liked = sorted(others, key=lambda w: -_best_of(w, _votes(w), problem, dict(weights()), fast=True)[1])
    wrong = [way for k, way in enumerate(problem.ways) if k != int(np.argmax(scored))]
    return [replace(problem, ways=[true, *wrong, *liked[:RIVALS]])]


def _right_of(evidence: Evidence, given: Scene, template: Template) -> list[frozenset[str]]:
    """The bodies that are right of each leading piece; none where nobody knows, or the type lacks it."""
    truth = given.truth
    tree, known = cKDTree(truth.points), {r.name for r in template.roles if r.rigid}
    right = []
    for k in evidence.leading:
        near = truth.label[tree.query(evidence.pieces[k].samples)[1]]
        bodies, count = Counter(truth.labels[n][1] for n in near.tolist()).most_common(1)[0]
        told = count > MOSTLY * len(near) and set(bodies.split("|")) <= known  # what the type lacks may be anywhere
        right.append(frozenset(bodies.split("|")) if told else frozenset())
    return right


def _fitting(template: Template, there: set[str]) -> int:
    return sum(1 if r.name in there else -1 for r in template.roles if r.rigid and not r.optional)


def _votes(way: Way) -> list[dict[str, Any]]:
    votes = way.evidence.votes(way.template)
    return [dict(votes[k]) for k in way.evidence.leading]


def _field(way: Way, votes: Sequence[Mapping[str, Any]], known: Mapping[str, float]) -> Field:
    pieces = [way.evidence.pieces[k] for k in way.evidence.leading]
    return field_of(votes, way.evidence.between, way.template, known, out_of_line(pieces), largeness(pieces))


def _lacks(way: Way, labels: np.ndarray, bodies: tuple[str, ...]) -> Mapping[str, float]:
    leading = [way.evidence.pieces[k] for k in way.evidence.leading]
    played = drawn_bodies(leading, labels, bodies, way.template, way.evidence.surface)
    return lacks(way.template, played, way.evidence.stance.absent, len(leading))


def _best_of(
    way: Way,
    votes: list[dict[str, Any]],
    problem: Problem,
    known: Weights,
    *,
    right: bool = False,
    margin: float = 0.0,
    fast: bool = False,
) -> tuple[np.ndarray, float, Field]:
    """The best labelling and its score; with `right`, the best right one; with a `margin`, where wrong ones are paid
    so much; `fast`: as well as a glance tells."""
    posed = []
    for mine, true in zip(votes, problem.right, strict=True):
        if right and true:
            posed.append({b: {**f, "said": 1.0} for b, f in mine.items() if b in true})  # or of none
        elif margin and true:
            posed.append({b: f if b in true else {**f, "margin": 1.0} for b, f in mine.items()})
        else:
            posed.append(mine)
    given = _field(way, posed, {**known, "margin": margin, "said": OWN * MARGIN})
    few: dict[str, int] = {"sweeps": reading.GLANCE, "chains": reading.FEW} if fast else {}
    labels, score = labelled(given, **few)
    return labels, score + weighed(_lacks(way, labels, given.bodies), known), given


def features_of(way: Way, votes: list[dict[str, Any]], labels: np.ndarray, names: Sequence[str]) -> np.ndarray:
    """How much of each kind of evidence a labelling has: the score is linear in the weights."""
    bodies = tuple(r.name for r in way.template.roles if r.rigid)
    also = _lacks(way, labels, bodies)
    nothing = dict.fromkeys(names, 0.0)
    return np.array([score_of(_field(way, votes, {**nothing, n: 1.0}), labels) + also.get(n, 0.0) for n in names])


def faults(problem: Problem, labels: np.ndarray, bodies: tuple[str, ...]) -> tuple[int, float]:
    """How many leading pieces are labelled wrongly, and the share of the surface that is labelled rightly."""
    wrong, good, total = 0, 0.0, 0.0
    for label, true, area in zip(labels, problem.right, problem.areas, strict=True):
        if true:
            right = label < len(bodies) and bodies[label] in true
            wrong, good, total = wrong + (not right), good + area * right, total + area
    return wrong, good / total if total else 1.0


def read(posed: Posed, known: Weights) -> tuple[float, float]:
    """The share of the surface labelled right under the weights, as the judge would choose among the ways; and by how
    much what it chooses is ahead of the best right one (negative: the search missed it)."""
    found = [_best_of(w, v, posed.problem, known) for w, v in zip(posed.problem.ways, posed.votes, strict=True)]
    labels, score, given = max(found, key=lambda f: f[1])
    best = max(_right_scores(posed, known))
    return faults(posed.problem, labels, given.bodies)[1], score - best


def _right_scores(posed: Posed, known: Weights) -> list[float]:
    said = {**known, "said": 0.0}
    found = []
    for way, votes in zip(posed.problem.ways, posed.votes, strict=True):
        if way.right:
            labels, _, given = _best_of(way, votes, posed.problem, known, right=True)
            found.append(score_of(_field(way, votes, said), labels) + weighed(_lacks(way, labels, given.bodies), known))
    return found


def challenged(posed: Posed, known: Weights, names: Sequence[str]) -> tuple[np.ndarray, list[tuple[np.ndarray, float]]]:
    """What the best right labelling has of each kind of evidence; and of the two that are most wrong for what they
    score, with the points that they should be behind."""
    good, rivals = np.zeros(len(names)), []
    for way, votes in zip(posed.problem.ways, posed.votes, strict=True):
        if way.right:
            good = features_of(way, votes, _best_of(way, votes, posed.problem, known, right=True)[0], names)
        labels, score, given = _best_of(way, votes, posed.problem, known, margin=MARGIN, fast=not way.right)
        rivals.append((score, way, votes, labels, MARGIN * faults(posed.problem, labels, given.bodies)[0]))
    worst = sorted(rivals, key=lambda r: -r[0])[:2]
    return good, [(features_of(way, votes, labels, names), loss) for _, way, votes, labels, loss in worst if loss > 0]


def settled(posed: Sequence[Posed], start: Weights, names: Sequence[str], loyal: float) -> Weights:
    """The weights nearest to `start` that leave the least slack: for every problem, by how much its worst wrong
    labelling is too near to the right one, for each of its pieces."""
    first = np.array([start[n] for n in names])
    scale = np.maximum(5.0, np.abs(first))
    gaps = [np.array([w - p.good for w, _ in p.wrong]) for p in posed if p.wrong]
    losses = [np.array([loss for _, loss in p.wrong]) for p in posed if p.wrong]
    pieces = [max(1, sum(map(bool, p.problem.right))) for p in posed if p.wrong]

    def cost(x: np.ndarray) -> tuple[float, np.ndarray]:
        total, slope = 0.5 * loyal * float(x @ x), loyal * x
        for gap, loss, count in zip(gaps, losses, pieces, strict=True):
            slack = np.append(loss + gap @ (first + scale * x), 0.0) / SOFT
            top = float(slack.max())
            share = np.exp(slack - top)
            total += SOFT * (top + float(np.log(share.sum()))) / (MARGIN * count * len(gaps))
            share /= share.sum()
            slope = slope + scale * (share[:-1] @ gap) / (MARGIN * count * len(gaps))
        return total, slope

    bounds = [
        (0.0, 0.0) if n == SCALE else ((1.0 - f) / s if n in POSITIVE else None, None)
        for n, f, s in zip(names, first, scale, strict=True)
    ]
    found = minimize(cost, np.zeros(len(names)), jac=True, method="L-BFGS-B", bounds=bounds)
    return start | {n: round(float(v), 2) for n, v in zip(names, first + scale * found.x, strict=True)}


def learned(posed: Sequence[Posed], rounds: int, loyal: float, jobs: int) -> Weights:
    """The weights that some problems teach. What was found wrong in any round is kept with the problems."""
    start = dict(weights())
    names = [n for n in start if n not in FIXED]
    now = dict(start)
    for number in range(rounds):
        told = _each(partial(challenged, known=now, names=names), posed, jobs)
        for one, (good, wrong) in zip(posed, told, strict=True):
            one.good = good
            one.wrong.extend(wrong)
        now = settled(posed, start, names, loyal)
        sys.stdout.write(f"{number}: {sum(len(p.wrong) for p in posed)} rivals; {now}\n")
        sys.stdout.flush()
    return now


def _each(call: Callable[[Posed], Any], posed: Sequence[Posed], jobs: int) -> list[Any]:
    if jobs < 2:
        return [call(one) for one in posed]
    with ProcessPoolExecutor(jobs) as pool:
        return list(pool.map(call, posed))


def collect(folder: Path, given: argparse.Namespace) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in _scenes(given):
        file = folder / f"{name.replace(' ', '_')}.pickle"
        if file.is_file():
            continue
        try:
            found = problems_of(name, make())
        except (YellowironError, ValueError) as error:
            sys.stdout.write(f"{name}: {error}\n")
            continue
        file.write_bytes(pickle.dumps(found))
        sys.stdout.write(f"{name}: {len(found)}\n")
        sys.stdout.flush()


def _scenes(given: argparse.Namespace) -> Iterator[tuple[str, Callable[[], Scene]]]:
    if given.real:
        for model in models([Path(f) for f in given.models.split(":") if f], LABELS):
            if not model.held_back and model.cad is not None:
                for names in ("with", "without"):
                    for shake in given.shake.split(","):
                        told = f"{model.name}-{names}-{shake}".rstrip("-")
                        yield told, partial(_real, model, names, shake)
        return
    for damage in given.damages.split(","):
        for kind in (k for k in DAMAGES[damage].kinds if k in KINDS):
            for seed in range(given.first, given.first + given.count):
                names = ("with", "without")[zlib.crc32(f"{damage}{kind}{seed}".encode()) % 2]
                yield f"{kind}-{seed}-{damage}-{names}", partial(scene, kind, seed, damage, names=names)


def posed_in(folder: Path) -> list[Posed]:
    """The problems of a folder; votes are counted anew: places and shapes may be told otherwise since."""
    problems = [p for file in sorted(folder.glob("*.pickle")) for p in pickle.loads(file.read_bytes())]
    return [Posed(p, [_votes(way) for way in p.ways]) for p in problems]


def fit(folder: Path, given: argparse.Namespace) -> None:
    posed = posed_in(folder)
    known = learned(posed, given.rounds, float(given.loyal), given.jobs)
    source = (
        f"Structural support vector machine on {len(posed)} readings that contacts alone do not tell, of them "
        f"{sum(_machine(p.problem) not in DRAWN for p in posed)} of strangers' machines: benchmarks/fit_fusion.py."
    )
    DATA.write_text(json.dumps({"source": source, "weights": known}, indent=1) + "\n", encoding="utf-8")


def crossed(folder: Path, given: argparse.Namespace) -> None:
    """What weights make of machines that they were not learned of: all problems of a machine are in one fold."""
    posed = posed_in(folder)
    learned(posed, given.rounds, float(given.loyal.split(",")[0]), given.jobs)  # finds rivals, for every fold
    start = dict(weights())
    names = [n for n in start if n not in FIXED]
    machines = sorted({_machine(p.problem) for p in posed})
    fold_of = {name: k % given.folds for k, name in enumerate(machines)}
    tables = {"now": [start] * given.folds}
    for loyal in given.loyal.split(","):
        tables[loyal] = [
            settled([p for p in posed if fold_of[_machine(p.problem)] != k], start, names, float(loyal))
            for k in range(given.folds)
        ]
    shares: dict[str, list[float]] = {}
    for table in tables.values():
        for fold, known in enumerate(table):
            own = [p for p in posed if fold_of[_machine(p.problem)] == fold]
            for one, (share, _) in zip(own, _each(partial(read, known=known), own, given.jobs), strict=True):
                shares.setdefault(one.problem.name, []).append(100 * share)
    for name, row in sorted(shares.items()):
        sys.stdout.write(f"CROSS {name:40s}" + " ".join(f"{v:6.1f}" for v in row) + "\n")
    means = np.mean(list(shares.values()), axis=0)
    sys.stdout.write(f"CROSS {' / '.join(tables)}: " + " ".join(f"{v:6.2f}" for v in means) + "\n")


def _real(model: Model, names: str, shake: str) -> Scene:
    made = scene_of(model, names=names)
    return shaken(made, shake, upright_of(model, made.joints)) if shake else made


DRAWN = ("loader", "excavator", "drawn")


def _machine(problem: Problem) -> str:
    return problem.name.split("-")[0]


def show(folder: Path, given: argparse.Namespace) -> None:
    posed = posed_in(folder)
    told = _each(partial(read, known=dict(weights())), posed, given.jobs)
    for one, (share, ahead) in zip(posed, told, strict=True):
        sys.stdout.write(
            f"{one.problem.name:50s} {100 * share:6.1f} % of {len(one.problem.areas)} pieces; "
            f"{ahead:+.0f} against the best right one\n"
        )
    sys.stdout.write(f"mean {100 * np.mean([share for share, _ in told]):.2f} %\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("collect", "fit", "cross", "show"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=1)
    parser.add_argument("--damages", default=",".join(d for d in DAMAGES if d not in ("sound", "one mesh")))
    parser.add_argument("--real", action="store_true")
    parser.add_argument("--shake", default="", help="several: with commas; an empty one is the model as drawn")
    parser.add_argument("--models", default=os.environ.get(FOLDERS, ""))
    parser.add_argument("--rounds", type=int, default=4)
    parser.add_argument("--loyal", default="0.1")
    parser.add_argument("--folds", type=int, default=4)
    parser.add_argument("--jobs", type=int, default=1)
    given = parser.parse_args()
    {"collect": collect, "fit": fit, "cross": crossed, "show": show}[given.what](given.folder, given)


if __name__ == "__main__":
    main()
