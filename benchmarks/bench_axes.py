"""How right the estimated axes of joints are, and their uncertainties, where the bodies are known: what recognition
loses is left out.

    python benchmarks/bench_axes.py --real [--models DIR] [--only NAME,…] [--held-back] [--words]
    python benchmarks/bench_axes.py [--first SEED] [--count N] [--kinds loader,excavator] [--damages half,opened] …

Scenes and rules as of `bench_strangers.py`: every part, and every shell that is labelled apart, is given its true body,
and each joint that is drawn is looked for among the estimates of the joints between its bodies. Right is within 1 % of
the machine's height across the axis and 2°. `1 s`, `2 s`: shares of joints within one and two of their own sigmas
across (about two thirds and 95 % if these are honest; what a label says of its own tolerance is added); seconds are CPU
time of the estimates alone.
"""

from __future__ import annotations

import argparse
import math
import os
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from bench_strangers import FOLDERS  # noqa: E402
from kit.machines.damages import DAMAGES, EXTRA, KINDS  # noqa: E402
from kit.scene import Scene, TrueJoint, scene  # noqa: E402
from kit.scoring import ACROSS, DEGREES, triangles_of  # noqa: E402
from strangers_models import LABELS, models, scene_of  # noqa: E402
from yellowiron.alignment.assignment.search import variants_of  # noqa: E402
from yellowiron.alignment.axes import AxisEstimate, Frame, estimate_axes  # noqa: E402
from yellowiron.alignment.axes.pivots import pivots_of  # noqa: E402
from yellowiron.alignment.features.solids import solids_of  # noqa: E402
from yellowiron.cad.mesh.assembly import shape_of  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.assembly import Assembly, Part  # noqa: E402
from yellowiron.model.geometry import Mesh  # noqa: E402
from yellowiron.model.template import Template, choose  # noqa: E402


@dataclass(frozen=True)
class Error:
    """How far the estimate of a joint is off: metres across (of the machine's height), degrees, own sigmas."""

    joint: str
    across: float
    degrees: float
    sigmas: float
    right: bool
    words: str


def by_body(given: Scene) -> tuple[Assembly, dict[str, str]]:
    """The scene's model with every mesh of several bodies cut in them, and part → body."""
    assembly, truth = given.assembly, given.truth
    parts: list[Part] = []
    shapes = dict(assembly.shapes)
    bodies: dict[str, str] = {}
    tree = cKDTree(truth.points)
    for part in assembly.parts:
        mesh = assembly.shape_of(part).mesh
        if part.id in truth.whole and len(truth.whole[part.id]) == 1:
            numbers = np.full(len(mesh.triangles), truth.whole[part.id][0])
        else:
            numbers = truth.label[tree.query(triangles_of(assembly, part)[0])[1]]
        of = np.array([truth.labels[n][1].split("|")[0] for n in numbers])
        found = sorted(set(of.tolist()))
        if len(found) == 1:
            parts.append(part)
            bodies[part.id] = found[0]
            continue
        for body in found:
            key = f"{part.id} of {body}"
            used, triangles = np.unique(mesh.triangles[of == body], return_inverse=True)
            own = Mesh(mesh.points[used], triangles.reshape(-1, 3).astype(np.int32))
            shapes[key] = shape_of(own, key)
            parts.append(replace(part, id=key, shape=key))
            bodies[key] = body
    return replace(assembly, parts=tuple(parts), shapes=shapes), bodies


def concrete(template: Template, bodies: set[str]) -> Template:
    """The template with the variants that have most joints between bodies that are there."""
    chosen = [choose(template, choices) for choices in variants_of(template, {})]

    def held(one: Template) -> int:
        return sum({str(b) for b in one.bodies_of(j)} <= bodies for j in one.joints)

    return max(chosen, key=held)


def errors(given: Scene) -> tuple[list[Error], float]:
    """Of every joint that is drawn between bodies that the template joins; CPU seconds."""
    assembly, of = by_body(given)
    template = concrete(load_template(given.type), set(of.values()))
    known = {r.name for r in template.roles if r.rigid}
    solids = solids_of(assembly)
    labels: dict[str, list[int]] = {}
    for solid in solids:
        if (body := of[solid.part.id]) in known and not body.startswith(EXTRA):
            labels.setdefault(body, []).append(solid.index)
    start = time.process_time()
    pivots = pivots_of(assembly, {i: b for i, b in of.items() if b in known}, template)
    found = estimate_axes(solids, labels, template, pivots=pivots, frame=Frame())
    seconds = time.process_time() - start
    return [e for joint in given.joints for e in _error(joint, found, template, given.height)], seconds


def _error(joint: TrueJoint, found: dict[str, AxisEstimate], template: Template, height: float) -> Iterator[Error]:
    ends = [{b, *more} for b, more in zip(joint.bodies, joint.others, strict=True)]
    best: Error | None = None
    for own in template.joints:
        a, b = (str(body) for body in template.bodies_of(own))
        between = (a in ends[0] and b in ends[1]) or (a in ends[1] and b in ends[0])
        if not between or own.name not in found or (own.type == "prismatic") != (joint.type == "prismatic"):
            continue
        e = found[own.name]
        away = np.array(joint.point) - e.origin
        across = float(np.linalg.norm(away - (away @ e.direction) * e.direction))
        degrees = math.degrees(math.acos(min(1.0, abs(float(e.direction @ np.array(joint.axis))))))
        label = joint.tolerance or 0.0
        right = degrees <= max(DEGREES, joint.degrees) and across <= max(ACROSS * height, label)
        words = f"sigma {e.across / height:.2%}, {math.degrees(e.angle):.1f} deg: {e.how}"
        error = Error(own.name, across / height, degrees, across / math.hypot(e.across, 0.5 * label), right, words)
        if best is None or (not best.right and error.right) or (best.right == error.right and across < best.across):
            best = error
    if best is not None:
        yield best


def row(label: str, found: Sequence[Error], seconds: float) -> str:
    """One line of the table."""
    right = sum(e.right for e in found)
    sigmas = np.array([e.sigmas for e in found if math.isfinite(e.sigmas)])
    one, two = (100 * float((sigmas < s).mean()) if len(sigmas) else 0.0 for s in (1.0, 2.0))
    return f"{label:40s} {right:5d} /{len(found):5d} {one:6.1f} {two:6.1f} {seconds:7.2f}"


def scenes(chosen: argparse.Namespace) -> Iterator[tuple[str, Scene]]:
    """What is to be measured, one after the other."""
    if chosen.real:
        for model in models([Path(f) for f in chosen.models.split(":") if f], chosen.labels):
            wanted = not chosen.only or model.name in chosen.only.split(",")
            if wanted and model.cad is not None and (chosen.held_back or not model.held_back):
                yield model.name, scene_of(model, names="without")
        return
    for damage in chosen.damages.split(","):
        for kind in (k for k in chosen.kinds.split(",") if k in DAMAGES[damage].kinds):
            for seed in range(chosen.first, chosen.first + chosen.count):
                yield f"{damage}, {kind} {seed}", scene(kind, seed, damage, turn="any")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=2)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--damages", default=",".join(DAMAGES))
    parser.add_argument("--real", action="store_true")
    parser.add_argument("--models", default=os.environ.get(FOLDERS, ""))
    parser.add_argument("--labels", type=Path, default=LABELS)
    parser.add_argument("--only", default="")
    parser.add_argument("--held-back", action="store_true")
    parser.add_argument("--words", action="store_true", help="every joint, not only those that are wrong")
    chosen = parser.parse_args()
    print(f"{'':40s} right / joints    1 s    2 s       s")
    everything: list[Error] = []
    total = 0.0
    for label, given in scenes(chosen):
        found, seconds = errors(given)
        everything += found
        total += seconds
        print(row(label, found, seconds), flush=True)
        for e in found:
            if chosen.words or not e.right:
                mark = " " if e.right else "*"
                print(f"  {mark} {e.joint:38s} {e.across:7.2%} {e.degrees:5.1f} deg {e.sigmas:5.1f} s  {e.words}")
    print(row("all", everything, total))


if __name__ == "__main__":
    main()
