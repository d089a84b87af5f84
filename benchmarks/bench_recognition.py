"""How right alignment is on machines nobody tuned for: synthetic loaders and excavators without names, turned, scaled
and shuffled, sound and with one defect at a time, from B-rep and from triangles.

    python benchmarks/bench_recognition.py [--first SEED] [--count N] [--kinds loader,excavator,mini,roller,telehandler]
        [--defects …] [--inputs brep,triangles] [--out FILE.json] [--parts 1000,5000]

From the repository's root. Seeds below 1000 were looked at while the aligner was written, those from 1000 on are held
back.

A part is wrong if its body is, or the role where it is a pin or of a track's row. A role (body or pin) is right if most
of its parts have it. Silent: wrong, and neither the part nor the role is listed for review. Hoses between any two
bodies have no truth and are not counted. Seconds are CPU time of `align` alone, one thread. With `--parts`, sound
machines are filled up with bolts to as many parts; from triangles each bolt is a shape of its own, and the seconds are
told apart that finding cylinders and planes on them takes.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests")]

from kit.machines.defects import DEFECTS, crowded, spoiled  # noqa: E402
from kit.machines.synthetic import Machine, disguise  # noqa: E402
from yellowiron.alignment import align  # noqa: E402
from yellowiron.cad.mesh.assembly import shape_of  # noqa: E402
from yellowiron.cad.mesh.measures import compacted  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.alignment import Alignment  # noqa: E402
from yellowiron.model.geometry import Mesh  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402
from yellowiron.model.template import Template, choose  # noqa: E402

TEMPLATES = {"loader": "wheel_loader", "excavator": "excavator", "mini": "excavator", "roller": "roller",
             "telehandler": "telehandler", "wheeled_excavator": "wheeled_excavator"}  # fmt: skip
ROWS = ("track_shoe", "track_roller", "carrier_roller", "sprocket", "idler")


def same_role(found: str, true: str) -> bool:
    """A shoe's number only says where its row begins; a pin through the rods of both twins plays either role."""
    if true.startswith("track_shoe"):
        return found.startswith(true.rpartition("_")[0])
    return found == true or ("rod_l_pin" in true and found.replace("_r_pin", "_l_pin") == true)


def judged(found: Alignment, truth: dict[str, tuple[str, str]], template: Template) -> dict[str, Any]:
    """Counts, and what is wrong in words."""
    pins = {r.name for r in template.roles if r.kind == "pin"}
    review = set(found.to_review)
    known = [p for p in found.parts if truth[p.part][1]]
    wrong, silent = [], []
    votes: dict[str, Counter[bool]] = {}
    flagged: set[str] = set()
    for p in known:
        role, body = truth[p.part]
        exact = p.role in pins or role in pins or role.startswith(ROWS)
        same = same_role(p.role or "", role)
        good = p.body == body and (same or not exact)
        counted = role if exact else body
        votes.setdefault(counted, Counter())[good] += 1
        if p.part in review:
            flagged.add(counted)
        if not good:
            words = f"{p.part}: {p.role}/{p.body}, not {role}/{body} ({p.confidence}: {p.reason})"
            wrong.append(words)
            if p.part not in review:
                silent.append(words)
    bad = sorted(r for r, v in votes.items() if v[True] <= v[False])
    return {
        "parts": len(known), "wrong": len(wrong), "silent": len(silent),
        "flagged": sum(1 for p in known if p.part in review),
        "roles": len(votes), "roles_wrong": len(bad),
        "roles_silent": sum(1 for r in bad if r not in review and r not in flagged),
        "missing": len(found.missing), "words": wrong, "silent_words": silent, "choices": found.choices,
    }  # fmt: skip


def one(kind: str, seed: int, defect: str, *, triangles: bool) -> dict[str, Any]:
    """One machine, one defect."""
    return solved(kind, seed, spoiled(kind, seed, defect, triangles=triangles))


def filled(kind: str, seed: int, parts: int, *, triangles: bool) -> tuple[dict[str, Any], float]:
    """One sound machine with as many parts; and the CPU seconds that the features of its triangles took."""
    machine = crowded(spoiled(kind, seed, "sound"), parts)
    seconds = 0.0
    if triangles:
        meshes = own_meshes(machine)
        start = time.process_time()
        shapes = {key: replace(shape_of(mesh, key), key=key) for key, mesh in meshes.items()}
        seconds = time.process_time() - start
        own = [replace(p, shape=p.id) if p.id in shapes else p for p in machine.parts]
        machine = replace(machine, shapes=shapes, parts=own)
    return solved(kind, seed, machine), seconds


def own_meshes(machine: Machine) -> dict[str, Mesh]:
    """The meshes by shape, in single precision; a bolt has one of its own, by its part's id, a little longer or
    shorter than the others."""
    rng = np.random.default_rng([len(machine.parts), 53])
    meshes = {}
    for part in machine.parts:
        mesh, bolted = machine.shapes[part.shape].mesh, part.name == "bolt"
        points = mesh.points * (rng.uniform(0.9, 1.1) if bolted else 1.0)
        meshes[part.id if bolted else part.shape] = Mesh(points.astype(np.float32).astype(np.float64), mesh.triangles)
    return {key: compacted(mesh) for key, mesh in meshes.items()}


def solved(kind: str, seed: int, machine: Machine) -> dict[str, Any]:
    """What alignment makes of a machine."""
    template = load_template(TEMPLATES[kind])
    assembly, truth, _ = disguise(machine, seed, scale=True)
    start = time.process_time()
    found = align(assembly, template, Specifications())
    seconds = time.process_time() - start
    known = choose(template, found.choices)
    return {"seed": seed, "seconds": seconds, **judged(found, truth, known)}


def row(label: str, results: list[dict[str, Any]]) -> str:
    """One line of the table, shares of parts and of roles in per cent."""
    total = {k: sum(r[k] for r in results) for k in ("parts", "wrong", "silent", "flagged", "roles", "roles_wrong",
                                                     "roles_silent")}  # fmt: skip
    n, m = max(1, total["parts"]), max(1, total["roles"])
    right, roles = 100 * (1 - total["wrong"] / n), 100 * (1 - total["roles_wrong"] / m)
    return (
        f"{label:38s} {len(results):3d} {total['parts']:6d}  {right:6.2f} "
        f"{100 * total['silent'] / n:6.2f} {100 * total['flagged'] / n:6.2f}   {roles:6.2f} "
        f"{total['roles_silent']:4d}   {np.mean([r['seconds'] for r in results]):6.2f} "
        f"{max(r['seconds'] for r in results):6.2f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=5)
    parser.add_argument("--kinds", default="loader,excavator")
    parser.add_argument("--inputs", default="brep,triangles")
    parser.add_argument("--defects", default=",".join(DEFECTS))
    parser.add_argument("--parts", default="")
    parser.add_argument("--out", type=Path)
    chosen = parser.parse_args()
    everything: dict[str, list[dict[str, Any]]] = {}
    print(f"{'':38s}   n  parts   right silent  flagd    roles  sil.     mean    max s")
    if chosen.parts:
        for kind in chosen.kinds.split(","):
            for source in chosen.inputs.split(","):
                for count in (int(c) for c in chosen.parts.split(",")):
                    result, seconds = filled(kind, chosen.first, count, triangles=source == "triangles")
                    line = row(f"{kind}, {source}, {count} parts", [result])
                    print(line, f" features {seconds:.1f} s", flush=True)
        return
    for kind in chosen.kinds.split(","):
        for source in chosen.inputs.split(","):
            for defect in chosen.defects.split(","):
                label = f"{kind}, {source}, {defect}"
                seeds = range(chosen.first, chosen.first + chosen.count)
                results = [one(kind, seed, defect, triangles=source == "triangles") for seed in seeds]
                everything[label] = results
                print(row(label, results), flush=True)
                if chosen.out is not None:
                    chosen.out.write_text(json.dumps(everything, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
