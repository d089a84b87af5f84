"""What each kind of evidence counts where contacts find no machine: `alignment/data/fusion.json`, fitted to machines
whose truth is known.

    python benchmarks/fit_fusion.py collect FOLDER [--first SEED] [--count N] [--damages …] [--real] [--models DIR]
    python benchmarks/fit_fusion.py fit FOLDER [--rounds N]
    python benchmarks/fit_fusion.py cross FOLDER [--rounds N] [--folds K]
    python benchmarks/fit_fusion.py show FOLDER

From the repository's root. `collect` aligns damaged machines of ours, with and without names, and the real models with
labels that are not held back, and keeps what the judge was given wherever it was asked. The score is linear in its
weights, so they are learned by a structured perceptron with a margin (Collins 2002; Taskar 2003): where the best
labelling is not the best right one, weights move from what speaks for the one to what speaks for the other. `show`
prints the share of surface labelled right, as the leading pieces have it; `cross` that of machines that the weights
were not learned of.
"""

from __future__ import annotations

import argparse
import json
import pickle
import sys
import zlib
from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from bench_strangers import FOLDERS, LABELS, models, scene_of  # noqa: E402
from kit.machines.damages import DAMAGES  # noqa: E402
from kit.scene import Scene, scene  # noqa: E402
from yellowiron.alignment import pipeline  # noqa: E402
from yellowiron.alignment.fusion import reading  # noqa: E402
from yellowiron.alignment.fusion.annealing import labelled  # noqa: E402
from yellowiron.alignment.fusion.judge import field_of, score_of  # noqa: E402
from yellowiron.alignment.fusion.weights import weights  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.errors import YellowironError  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402
from yellowiron.model.template import Template, as_drawn, choose  # noqa: E402
from yellowiron.stages import find_roles  # noqa: E402

DATA = ROOT / "src/yellowiron/alignment/data/fusion.json"
MARGIN = 15.0
"""A right labelling should score this much more for every piece that a wrong one has wrong."""
RATE = 0.15
FIXED = ("said",)
POSITIVE = ("name", "contacts", "said", "seen", "beside", "joined", "near", "exact")


@dataclass(frozen=True, eq=False)
class Problem:
    """What the judge was given once, under the true variant: votes and bonds of the leading pieces, areas, and for each
    piece the bodies that are right (empty: nobody knows)."""

    name: str
    template: Template
    votes: list[dict[str, Any]]
    bonds: list[Any]
    areas: list[float]
    right: list[frozenset[str]]


def problems_of(name: str, given: Scene) -> list[Problem]:
    """The problems that aligning a scene poses: none where the contacts find the machine, one otherwise."""
    seen: list[Any] = []
    usual = pipeline.fused

    def caught(observation: Any, template: Template, variants: Any, scores: Any, answer: Any, edited: Any) -> Any:
        seen.append((observation, template, variants, scores, answer))
        return usual(observation, template, variants, scores, answer, edited)

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
    tree, truth = cKDTree(given.truth.points), given.truth
    evidence = reading.evidence_of(observation, scores, answer, {}, template)
    there = {b for _, body in truth.labels for b in body.split("|")}
    known = {r.name for r in template.roles if r.rigid}
    bodies = [tuple(body.split("|")) for _, body in truth.labels]
    right = []
    for k in evidence.leading:
        centres = np.concatenate([
            observation.solids[i].points[observation.solids[i].shape.mesh.triangles].mean(axis=1)
            for i in sorted(evidence.pieces[k].members)
        ])  # fmt: skip
        near = truth.label[tree.query(centres)[1]]
        label, count = Counter(near.tolist()).most_common(1)[0]
        told = count > 0.9 * len(near) and set(bodies[label]) <= known  # what the type lacks may be anywhere
        right.append(frozenset(bodies[label]) if told else frozenset())
    best = max(variants, key=lambda c: _fitting(choose(template, c), there))
    resolved = as_drawn(choose(template, best), there)
    posed = []
    # Which end is the front is the judge's guess; what it is to learn from is the right one.
    for one in (evidence, replace(evidence, stance=evidence.stance.turned())):
        votes = one.votes(resolved)
        posed.append(
            Problem(
                name, resolved, [dict(votes[k]) for k in one.leading], list(one.between),
                [one.pieces[k].area for k in one.leading], right,
            )
        )  # fmt: skip
    return [max(posed, key=_best_right)]


def _best_right(problem: Problem) -> float:
    labels, field = solved(problem, dict(weights()), right=True, margin=0.0)
    return score_of(field, labels)


def _fitting(template: Template, there: set[str]) -> int:
    return sum(1 if r.name in there else -1 for r in template.roles if r.rigid and not r.optional)


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


def _scenes(given: argparse.Namespace) -> Any:
    if given.real:
        for model in models([Path(f) for f in given.models.split(":") if f], LABELS):
            if not model.held_back and model.cad is not None:
                for names in ("with", "without"):
                    yield f"{model.name}-{names}", lambda m=model, n=names: scene_of(m, names=n)
        return
    for damage in given.damages.split(","):
        for kind in DAMAGES[damage].kinds:
            for seed in range(given.first, given.first + given.count):
                names = ("with", "without")[zlib.crc32(f"{damage}{kind}{seed}".encode()) % 2]
                yield (
                    f"{kind}-{seed}-{damage}-{names}",
                    lambda k=kind, s=seed, d=damage, n=names: scene(k, s, d, names=n),
                )


def problems_in(folder: Path) -> list[Problem]:
    return [p for file in sorted(folder.glob("*.pickle")) for p in pickle.loads(file.read_bytes())]


def features_of(problem: Problem, labels: np.ndarray, names: list[str]) -> np.ndarray:
    """How much of each kind of evidence a labelling has: the score is linear in the weights."""
    found = []
    for name in names:
        alone = {n: float(n == name) for n in names}
        found.append(score_of(field_of(problem.votes, problem.bonds, problem.template, alone), labels))
    return np.array(found)


def solved(problem: Problem, known: dict[str, float], *, right: bool, margin: float) -> tuple[np.ndarray, Any]:
    """The best labelling; with `right`, the best right one; with a `margin`, the best where wrong ones are paid."""
    votes = []
    for mine, true in zip(problem.votes, problem.right, strict=True):
        if right and true:
            kept = {b: f for b, f in mine.items() if b in true}
            votes.append({b: {**f, "said": 1.0} for b, f in kept.items()})
        elif margin and true:
            votes.append({b: f if b in true else {**f, "margin": 1.0} for b, f in mine.items()})
        else:
            votes.append(mine)
    field = field_of(votes, problem.bonds, problem.template, {**known, "margin": margin})
    labels, _ = labelled(field)
    return labels, field


def share_right(problem: Problem, labels: np.ndarray, bodies: tuple[str, ...]) -> float:
    good = total = 0.0
    for label, true, area in zip(labels, problem.right, problem.areas, strict=True):
        if true:
            total += area
            good += area * (label < len(bodies) and bodies[label] in true)
    return good / total if total else 1.0


def learned(problems: list[Problem], rounds: int, *, fixed: tuple[str, ...] = FIXED) -> dict[str, float]:
    """The weights that a structured perceptron learns of some problems, from those in use; the mean over all steps."""
    start = dict(weights())
    names = [n for n in start if n not in fixed]
    scale = np.array([max(5.0, abs(start[n])) for n in names])
    now, mean, seen = dict(start), np.zeros(len(names)), np.zeros(len(names))
    rng = np.random.default_rng(0)
    steps = 0
    for number in range(rounds):
        shares = []
        for k in rng.permutation(len(problems)).tolist():
            problem = problems[k]
            wrong, field = solved(problem, now, right=False, margin=MARGIN)
            best, _ = solved(problem, now, right=True, margin=0.0)
            plain, _ = solved(problem, now, right=False, margin=0.0)
            shares.append(share_right(problem, plain, field.bodies))
            gap = features_of(problem, best, names) - features_of(problem, wrong, names)
            gap = np.clip(gap, -1e3, 1e3)
            seen += (gap * scale) ** 2
            move = RATE * scale * (gap * scale) / np.sqrt(1.0 + seen)
            for name, step in zip(names, move, strict=True):
                now[name] += float(step)
                if name in POSITIVE:
                    now[name] = max(now[name], 1.0)
            mean += np.array([now[n] for n in names])
            steps += 1
        sys.stdout.write(f"{number}: {100 * np.mean(shares):.2f} %  { ({n: round(now[n], 1) for n in names}) }\n")
        sys.stdout.flush()
    averaged = {n: round(float(v), 2) for n, v in zip(names, mean / steps, strict=True)}
    return {n: averaged.get(n, start[n]) for n in start}


def fit(folder: Path, rounds: int) -> None:
    problems = problems_in(folder)
    known = learned(problems, rounds)
    source = (
        f"Structured perceptron on {len(problems)} machines that contacts alone do not tell, of them "
        f"{sum(_machine(p) not in DRAWN for p in problems)} of strangers: "
        "benchmarks/fit_fusion.py."
    )
    DATA.write_text(json.dumps({"source": source, "weights": known}, indent=1) + "\n", encoding="utf-8")


def crossed(folder: Path, rounds: int, folds: int) -> None:
    """What weights make of machines that they were not learned of: all problems of a machine are in one fold."""
    problems = problems_in(folder)
    machines = sorted({_machine(p) for p in problems})
    fold_of = {name: k % folds for k, name in enumerate(machines)}
    for fold in range(folds):
        known = learned([p for p in problems if fold_of[_machine(p)] != fold], rounds)
        for problem in (p for p in problems if fold_of[_machine(p)] == fold):
            shares = []
            for used in (dict(weights()), known):
                labels, field = solved(problem, used, right=False, margin=0.0)
                shares.append(100 * share_right(problem, labels, field.bodies))
            sys.stdout.write(f"CROSS {problem.name:50s} now {shares[0]:6.1f} %, learned of others {shares[1]:6.1f} %\n")


DRAWN = ("loader", "excavator", "drawn")


def _machine(problem: Problem) -> str:
    return problem.name.split("-")[0]


def show(folder: Path) -> None:
    known = dict(weights())
    for problem in problems_in(folder):
        labels, field = solved(problem, known, right=False, margin=0.0)
        best, _ = solved(problem, known, right=True, margin=0.0)
        ahead = score_of(field, labels) - score_of(field, best)
        sys.stdout.write(
            f"{problem.name:50s} {100 * share_right(problem, labels, field.bodies):6.1f} % "
            f"of {len(labels)} pieces; {ahead:+.0f} against the best right one\n"
        )


def main() -> None:
    import os

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("collect", "fit", "cross", "show"))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=1)
    parser.add_argument("--damages", default=",".join(d for d in DAMAGES if d not in ("sound", "one mesh")))
    parser.add_argument("--real", action="store_true")
    parser.add_argument("--models", default=os.environ.get(FOLDERS, ""))
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--folds", type=int, default=4)
    given = parser.parse_args()
    if given.what == "collect":
        collect(given.folder, given)
    elif given.what == "fit":
        fit(given.folder, given.rounds)
    elif given.what == "cross":
        crossed(given.folder, given.rounds, given.folds)
    else:
        show(given.folder)


if __name__ == "__main__":
    main()
