"""Whether confidence means something: of the parts said to be 90 % sure, are 90 % right? Synthetic machines, sound and
with one defect or two, without names, with right and with wrong ones.

    python benchmarks/bench_confidence.py collect FILE.jsonl [--first SEED] [--count N] [--triangles SHARE]
    python benchmarks/bench_confidence.py fit FILE.jsonl        writes src/yellowiron/alignment/data/confidence.json
    python benchmarks/bench_confidence.py show FILE.jsonl       prints the table, draws docs/confidence.svg

from the repository's root. Fit and show on seeds of their own: those from 1000 on are held back from everything else,
1810 to 1899 for this figure alone. A part is right as in `bench_recognition.py`.
"""

from __future__ import annotations

import argparse
import itertools
import json
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from scipy.optimize import minimize  # noqa: E402

from bench_names import called  # noqa: E402
from bench_recognition import ROWS, TEMPLATES, same_role  # noqa: E402
from kit.machines.defects import DEFECTS, spoiled  # noqa: E402
from kit.machines.synthetic import disguise  # noqa: E402
from yellowiron.alignment import align  # noqa: E402
from yellowiron.alignment.labelling.confidence import probability  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402

DATA = ROOT / "src" / "yellowiron" / "alignment" / "data" / "confidence.json"
PICTURE = ROOT / "docs" / "confidence.svg"
WAYS = {"none": 0.5, "en": 0.1, "de": 0.1, "zh": 0.1, "cut": 0.05, "half wrong": 0.1, "all shuffled": 0.05}
"""How the parts of a machine are called, and how often."""
PAIRS = (
    ("no pins", "1 mm jitter"), ("half the pins", "0.3 % shrink"), ("merged", "half the pins"),
    ("missing cylinder", "1 mm jitter"), ("missing cylinder", "no pins"), ("merged", "missing cylinder"),
    ("1 mm jitter", "0.3 % shrink"), ("merged", "0.3 % shrink"),
)  # fmt: skip
"""Two defects at once, so that there is something to be wrong about."""
CASES = 4
"""Machines of a seed and kind: each second one with two defects."""
EDGES = (0.0, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 1.0)
SIGNS = {
    **dict.fromkeys(("strength", "whole", "names for", "lead"), (0.0, None)),
    **dict.fromkeys(("rung", "names against", "doubted"), (None, 0.0)),
}
"""What can only speak for a place, or only against it: few are wrong, and chance must not turn that round."""
RIDGE = 1.0
"""Strength of the pull of every weight towards none, in parts."""
Floats = NDArray[np.float64]


def collect(path: Path, first: int, count: int, triangles: float) -> None:
    """One line a machine, appended: what was asked, and of every part its grounds, whether right, whether listed."""
    templates = {kind: load_template(name) for kind, name in TEMPLATES.items()}
    for seed in range(first, first + count):
        for kind, template in templates.items():
            for case in range(CASES):
                rng = np.random.default_rng([seed, len(kind), case, 47])
                way = str(rng.choice(list(WAYS), p=list(WAYS.values())))
                both = PAIRS[int(rng.integers(len(PAIRS)))] if case % 2 else (str(rng.choice(list(DEFECTS))), "sound")
                defect = " and ".join(d for d in both if d != "sound") or "sound"
                machine = spoiled(kind, seed, both[0], triangles=bool(rng.random() < triangles))
                machine = DEFECTS[both[1]](machine, rng)
                assembly, truth, _ = disguise(machine, seed)
                found = align(called(assembly, truth, way, seed, kind), template, Specifications())
                pins = {r.name for r in template.roles if r.kind == "pin"}
                rows = []
                for p in found.parts:
                    role, body = truth[p.part]
                    if not body or not p.evidence:
                        continue
                    exact = p.role in pins or role in pins or role.startswith(ROWS)
                    right = p.body == body and (not exact or same_role(p.role or "", role))
                    rows.append([dict(p.evidence), right, p.part in found.to_review, p.role])
                line = {"kind": kind, "seed": seed, "defect": defect, "way": way, "parts": rows}
                with path.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(line) + "\n")


def read(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def fit(path: Path) -> None:
    """Logistic regression with a ridge and `SIGNS`."""
    machines = read(path)
    names = sorted({name for m in machines for grounds, *_ in m["parts"] for name in grounds})
    x = np.array([[1.0, *(g.get(n, 0.0) for n in names)] for m in machines for g, *_ in m["parts"]])
    y = np.array([right for m in machines for _, right, *_ in m["parts"]], dtype=np.float64)

    def loss(w: Floats) -> tuple[float, Floats]:
        odds = x @ w
        ridge = np.concatenate([[0.0], w[1:]])
        value = float(np.sum(np.logaddexp(0.0, odds) - y * odds) + 0.5 * RIDGE * ridge @ ridge)
        return value, np.asarray(x.T @ (1 / (1 + np.exp(-odds)) - y) + RIDGE * ridge)

    bounds = [SIGNS.get(name, (None, None)) for name in ["always", *names]]
    best = minimize(loss, np.zeros(x.shape[1]), jac=True, method="L-BFGS-B", bounds=bounds).x
    source = (
        f"Logistic regression on {len(y)} parts, {int((1 - y).sum())} of them wrong, of {len(machines)} synthetic "
        f"loaders and excavators, seeds {spans(m['seed'] for m in machines)}, sound and with one defect or two, with "
        "and without names: benchmarks/bench_confidence.py."
    )
    weights = {name: round(float(w), 3) + 0.0 for name, w in zip(["always", *names], best, strict=True)}
    DATA.write_text(json.dumps({"source": source, "weights": weights}, indent=1) + "\n", encoding="utf-8")
    print(source, json.dumps(weights, indent=1), sep="\n")


def spans(seeds: Iterable[int]) -> str:
    """Numbers in words, those in a row as a span."""
    runs: list[list[int]] = []
    for seed in sorted(set(seeds)):
        if runs and seed == runs[-1][1] + 1:
            runs[-1][1] = seed
        else:
            runs.append([seed, seed])
    return ", ".join(f"{a} to {b}" if b > a else str(a) for a, b in runs)


def show(path: Path) -> None:
    """The reliability table and its picture; the expected calibration error (the bins' mean gap, by parts)."""
    machines = read(path)
    parts = [(probability(g), right, listed) for m in machines for g, right, listed, _ in m["parts"]]
    sure = np.array([p for p, *_ in parts])
    right = np.array([r for _, r, _ in parts], dtype=np.float64)
    listed = np.array([one for *_, one in parts], dtype=bool)
    bins = []
    print(f"{'said':>13s} {'parts':>6s} {'mean said':>9s} {'right':>7s}")
    for low, high in itertools.pairwise(EDGES):
        of = (sure >= low) & ((sure < high) | (high == 1.0))
        if of.any():
            bins.append((int(of.sum()), float(sure[of].mean()), float(right[of].mean())))
            print(f"{low:6.2f}-{high:6.2f} {bins[-1][0]:6d} {bins[-1][1]:9.3f} {bins[-1][2]:7.3f}")
    total = len(parts)
    error = sum(n * abs(p - r) for n, p, r in bins) / total
    brier = float(np.mean((sure - right) ** 2))
    base = float(right.mean() * (1 - right.mean()))
    silent = int(((right == 0) & ~listed).sum())
    print(f"{len(machines)} machines, {total} parts, {int((1 - right).sum())} wrong, {silent} of them not listed, "
          f"{int(listed.sum())} listed; ECE {error:.4f}, Brier {brier:.4f} (always the mean: {base:.4f})")  # fmt: skip
    order = np.argsort(sure, kind="stable")
    print(f"AUC {_auc(right[order]):.3f}; of the least sure 1, 2, 5 %: right "
          + ", ".join(f"{right[order[: max(1, total * k // 100)]].mean():.2f}" for k in (1, 2, 5)))  # fmt: skip
    PICTURE.write_text(picture(bins, error, len(machines), total), encoding="utf-8")


def _auc(right: Floats) -> float:
    """How often a right part is surer than a wrong one; `right` in order of confidence."""
    wrong_before = np.cumsum(1 - right)
    pairs = float(right.sum() * (1 - right).sum())
    return float((wrong_before * right).sum()) / pairs if pairs else 1.0


def picture(bins: list[tuple[int, float, float]], error: float, machines: int, total: int) -> str:
    """A reliability diagram: confidence said against share right, with 95 % intervals (Wilson 1927)."""
    left, top, side = 60, 30, 320

    def at(p: float, r: float) -> tuple[float, float]:
        return left + side * p, top + side * (1 - r)

    lines = [f'<rect x="{left}" y="{top}" width="{side}" height="{side}" fill="#fff" stroke="#888"/>']
    for k in range(0, 11, 2):
        x, y = at(k / 10, k / 10)
        lines += [f'<line x1="{left}" y1="{y:.1f}" x2="{left + side}" y2="{y:.1f}" stroke="#eee"/>',
                  f'<text x="{left - 8}" y="{y + 4:.1f}" text-anchor="end">{10 * k} %</text>',
                  f'<text x="{x:.1f}" y="{top + side + 18}" text-anchor="middle">{10 * k} %</text>']  # fmt: skip
    lines.append(f'<line x1="{left}" y1="{top + side}" x2="{left + side}" y2="{top}" stroke="#999" '
                 'stroke-dasharray="4 4"/>')  # fmt: skip
    for n, p, r in bins:
        z = 1.96
        middle = (r + z * z / (2 * n)) / (1 + z * z / n)
        half = z / (1 + z * z / n) * float(np.sqrt(r * (1 - r) / n + z * z / (4 * n * n)))
        x, y = at(p, r)
        low, high = at(p, max(0.0, middle - half))[1], at(p, min(1.0, middle + half))[1]
        size = 2.0 + 8.0 * float(np.sqrt(n / total))
        lines += [f'<line x1="{x:.1f}" y1="{low:.1f}" x2="{x:.1f}" y2="{high:.1f}" stroke="#c60" stroke-width="2"/>',
                  f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{size:.1f}" fill="#fa0" stroke="#c60"/>']  # fmt: skip
    lines += [f'<text x="{left + side / 2}" y="{top + side + 38}" text-anchor="middle">confidence said</text>',
              f'<text transform="translate(14 {top + side / 2}) rotate(-90)" text-anchor="middle">share right</text>',
              f'<text x="{left}" y="18">{machines} unseen machines, {total} parts: '
              f"calibration error {100 * error:.2f} %</text>"]  # fmt: skip
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {left + side + 20} {top + side + 50}" '
    return head + 'font-family="sans-serif" font-size="12" fill="#333">\n' + "\n".join(lines) + "\n</svg>\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=["collect", "fit", "show"])
    parser.add_argument("file", type=Path)
    parser.add_argument("--first", type=int, default=400)
    parser.add_argument("--count", type=int, default=10)
    parser.add_argument("--triangles", type=float, default=0.0)
    arguments = parser.parse_args()
    if arguments.what == "collect":
        collect(arguments.file, arguments.first, arguments.count, arguments.triangles)
    else:
        {"fit": fit, "show": show}[arguments.what](arguments.file)


if __name__ == "__main__":
    main()
