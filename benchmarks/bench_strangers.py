"""How right alignment is on strangers' machines: ours damaged as converters and artists do, and real ones with labels.

    python benchmarks/bench_strangers.py [--first SEED] [--count N] [--kinds loader,excavator] [--damages half,opened]
        [--names with,without] [--turn upright|any] [--jobs N] [--limit S] [--out FILE.json] [--words]
    python benchmarks/bench_strangers.py --real [--models DIR] [--labels DIR] [--only NAME,…] [--held-back]
        [--shake turned,loose,…] …
    python benchmarks/bench_strangers.py --sizes

From the repository's root. `tests/kit/machines/damages.py` has the damages, `tests/kit/scoring.py` the rules by which a
part, a role and a joint are right; areas are in per cent. Every machine is read from triangles in single precision and
solved as `yellowiron align` does, without a sheet; seconds are CPU time of that, reading not counted. After `--limit`
of these seconds a machine is given up, which counts as all wrong and flagged. Seeds from 1000 on are held back.

Real models are those of `benchmarks/strangers/*.json` and of `../shared/data`; their CAD is looked for in `--models`
(default: the environment's YELLOWIRON_STRANGERS; several folders with ':' between them). What is not there is said. Of
models labelled `held_back` nothing is done unless `--held-back` is given. `--shake`: each as it is not, but the same
machine in another file (`strangers_shaken.py`); what moves is not looked at then. `--sizes`: what large models take:
5000 parts, 470 000 triangles in 85 parts, 267 parts with hoses.

The last column of real models says which actuators move in MuJoCo, each alone over a quarter of its stroke, the base
fixed, and whether the loops hold (`strangers_driven.py`).
"""

from __future__ import annotations

import argparse
import itertools
import json
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from kit.machines.damages import ALL, DAMAGES, EXTRA, KINDS  # noqa: E402
from kit.machines.defects import crowded, drawn  # noqa: E402
from kit.machines.excavators import excavator  # noqa: E402
from kit.machines.synthetic import Machine  # noqa: E402
from kit.scene import Scene, read, scene, true_joints  # noqa: E402
from kit.scoring import Score, score  # noqa: E402
from strangers_driven import Driven, driven  # noqa: E402
from strangers_models import LABELS, models, scene_of, upright_of  # noqa: E402
from strangers_shaken import SHAKES, shaken  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.mechanism import build_mechanism  # noqa: E402
from yellowiron.model.errors import YellowironError  # noqa: E402
from yellowiron.model.geometry import Mesh  # noqa: E402
from yellowiron.model.mechanism import Mechanism  # noqa: E402
from yellowiron.model.rows import expand  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402
from yellowiron.model.template import choose  # noqa: E402
from yellowiron.stages import find_roles  # noqa: E402

Case = tuple[str, ...]
Result = dict[str, Any]
FOLDERS = "YELLOWIRON_STRANGERS"


class GivenUpError(Exception):
    """A machine took longer than it may."""


def _give_up(*_: object) -> None:
    raise GivenUpError


def solved(given: Scene, limit: int, *, drive: bool = False) -> Result:
    """What alignment makes of a scene within so many seconds of CPU time; with `drive` also how it moves in MuJoCo."""
    template = load_template(given.type)
    signal.signal(signal.SIGPROF, _give_up)
    signal.setitimer(signal.ITIMER_PROF, limit)
    start = time.process_time()
    try:
        assembly, found = find_roles(given.assembly, template, Specifications())
        seconds = time.process_time() - start
        mechanism: Mechanism | None = None
        chosen = expand(choose(template, found.choices), found.counts)
        try:
            mechanism = build_mechanism(assembly, chosen, found, Specifications(), name="found")
        except YellowironError as error:
            failed = str(error)
        else:
            failed = ""
    except (YellowironError, GivenUpError) as error:
        known = np.array([b[:1] not in ("", EXTRA) for _, b in given.truth.labels])[given.truth.label]
        area = float(given.truth.areas[known].sum())
        n, joints = len(given.assembly.parts), len(given.joints)
        lost = Score(area, 0.0, 0.0, area, n, 0, 0, 1, 0, 0, joints, 0).document()
        failed = str(error) or f"given up after {limit} s"
        moves = {"driven": Driven(failed=failed).words} if drive else {}
        return {"seconds": time.process_time() - start, "failed": failed, **moves, **lost}
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    result = score(assembly, found, mechanism, given.truth, given.joints, given.height, template)
    return {
        "seconds": seconds, "failed": failed, "choices": dict(found.choices), "missing": list(found.missing),
        "moves": sorted({a.name for a in mechanism.actuators}) if mechanism is not None else [],
        **({"driven": driven(assembly, chosen, found).words} if drive else {}),
        **result.document(),
    }  # fmt: skip


def drawn_case(kind: str, seed: str, damage: str, names: str, turn: str, limit: str) -> Result:
    """One machine with one damage."""
    given = scene(kind, int(seed), damage, names=names, turn=turn)
    return {"kind": kind, "seed": int(seed), "damage": damage, "names": names, **solved(given, int(limit))}


def real_case(name: str, folders: str, labels: str, names: str, limit: str, shake: str = "") -> Result:
    """One real model, as it is or shaken."""
    (model,) = (m for m in models([Path(f) for f in folders.split(":") if f], Path(labels)) if m.name == name)
    try:
        given = scene_of(model, names=names)
    except YellowironError as error:
        return {"damage": name, "names": names, "unread": str(error)}
    given = shaken(given, shake, upright_of(model, given.joints)) if shake else given
    return {"kind": given.type, "damage": name, "names": names, **solved(given, int(limit), drive=not shake)}


def size_case(name: str, limit: str) -> Result:
    """One large model: drawn and read, its triangles counted, and solved."""
    given = SIZES[name]()
    triangles = sum(len(given.assembly.shape_of(p).mesh.triangles) for p in given.assembly.parts)
    words = f"{len(given.assembly.parts)} parts, {triangles} triangles"
    return {"damage": name, "names": "without", "size": words, **solved(given, int(limit))}


def _large(seed: int, change: Callable[[Machine], Machine]) -> Scene:
    """An excavator made large, with the joints of what is left of it."""
    sound = drawn("excavator", seed)
    assembly, truth = read(change(sound), seed, np.eye(4), None)
    there = {body for role, body in truth.labels if not role.endswith("_pin")}
    joints = tuple(j for j in true_joints(sound, "excavator", seed, np.eye(4)) if set(j.bodies) <= there)
    return Scene(assembly, truth, joints, float(np.ptp(truth.points[:, 2])), "excavator")


def _fine(machine: Machine, parts: int, triangles: int) -> Machine:
    """The machine's cylinders and largest parts, their triangles divided until there are as many."""
    size = {p.id: float(np.prod(np.ptp(machine.shapes[p.shape].mesh.points, axis=0) + 1e-3)) for p in machine.parts}
    rams = {p.id for p in machine.parts if "piston_rod" in machine.truth[p.id][1] or "barrel" in machine.truth[p.id][1]}
    order = sorted(machine.parts, key=lambda p: (p.id not in rams, -size[p.id]))
    chosen = order[:parts]
    shapes = {p.shape: machine.shapes[p.shape] for p in chosen}

    def count() -> int:
        return sum(len(shapes[p.shape].mesh.triangles) for p in chosen)

    while count() < triangles:
        key = min(shapes, key=lambda k: (len(shapes[k].mesh.triangles), k))
        shapes[key] = replace(shapes[key], mesh=_divided(shapes[key].mesh))
    ids = {p.id for p in chosen}
    return replace(machine, parts=chosen, shapes=shapes, truth={i: t for i, t in machine.truth.items() if i in ids})


def _divided(mesh: Mesh) -> Mesh:
    """Every triangle in four."""
    import trimesh

    points, triangles = trimesh.remesh.subdivide(mesh.points, mesh.triangles)
    return Mesh(np.asarray(points), np.asarray(triangles, dtype=np.int32))


SIZES: dict[str, Callable[[], Scene]] = {
    "85 parts, 470k triangles": lambda: _large(4, lambda machine: _fine(machine, 85, 470_000)),
    "267 parts with hoses": lambda: _large(3, lambda _: crowded(excavator(3, hoses=24), 267)),
    "5000 parts": lambda: _large(3, lambda machine: crowded(machine, 5000)),
}


COLUMNS = f"{'':34s}  n  parts  right%  area%  silent  flagd  roles   joints     mean    max s  moves in MuJoCo"


def row(label: str, results: Sequence[Result]) -> str:
    """One line of the table."""
    read_ones = [r for r in results if "area" in r]
    if not read_ones:
        return f"{label:34s} {'; '.join(r.get('unread', '') for r in results)}"

    def mean(top: str, below: str) -> float:
        return 100 * float(np.mean([r[top] / max(r[below], 1e-12) for r in read_ones]))

    joints = f"{sum(r['joints_right'] for r in read_ones)}/{sum(r['joints'] for r in read_ones)}"
    times = [r["seconds"] for r in read_ones]
    failed = sum(bool(r["failed"]) for r in read_ones)
    return (
        f"{label:34s} {len(read_ones):2d} {sum(r['parts'] for r in read_ones):6d} {mean('parts_right', 'parts'):7.2f} "
        f"{mean('right', 'area'):6.2f} {mean('silent', 'area'):7.2f} {mean('flagged', 'area'):6.2f} "
        f"{mean('roles_right', 'roles'):6.2f} {joints:>8s} {np.mean(times):8.2f} {max(times):8.2f}"
        + "".join(f"  {r['unread']}" for r in results if "unread" in r)
        + "".join(f"  {r['size']}: {r['seconds']:.1f} CPU s" for r in results if "size" in r)
        + "".join(f"  {r['driven']}" for r in results if "driven" in r)
        + (f"  {failed}: {next(r['failed'] for r in read_ones if r['failed'])[:60]}" if failed else "")
    )


def run(work: Sequence[tuple[Callable[..., Result], Case]], jobs: int) -> Iterator[Result]:
    """The results of cases, in their order."""
    with ThreadPoolExecutor(jobs) as threads:
        yield from threads.map(lambda item: _alone(*item), work)


def _alone(function: Callable[..., Result], case: Case) -> Result:
    """A case in a process of its own: what crashes there is a line of the table."""
    with ProcessPoolExecutor(1) as pool:
        try:
            return pool.submit(function, *case).result()
        except BrokenProcessPool:
            return {"case": case, "unread": f"crashed: {', '.join(case)}"}


def cases(chosen: argparse.Namespace) -> dict[str, list[tuple[Callable[..., Result], Case]]]:
    """Line of the table → what to run for it."""
    names, limit = chosen.names.split(","), str(chosen.limit)
    if chosen.sizes:
        return {name: [(size_case, (name, limit))] for name in SIZES}
    table: dict[str, list[tuple[Callable[..., Result], Case]]] = {}
    if chosen.real:
        folders = [Path(f) for f in chosen.models.split(":") if f]
        for model in models(folders, chosen.labels):
            if chosen.only and model.name not in chosen.only.split(","):
                continue
            if model.held_back and not chosen.held_back:
                print(f"{model.name:34s} held back")
            elif model.cad is None:
                print(f"{model.name:34s} skipped: not in {chosen.models or f'--models or ${FOLDERS}'}")
            else:
                for naming, shake in itertools.product(names, chosen.shake.split(",")):
                    line = f"{model.name}, {naming}" + (f", {shake}" if shake else "")
                    table[line] = [(real_case, (model.name, chosen.models, str(chosen.labels), naming, limit, shake))]
        return table
    for damage in chosen.damages.split(","):
        for naming in names:
            for kind in (k for k in chosen.kinds.split(",") if k in DAMAGES[damage].kinds):
                seeds = [str(s) for s in range(chosen.first, chosen.first + chosen.count)]
                line = f"{damage}, {kind}, {naming}"
                table[line] = [(drawn_case, (kind, s, damage, naming, chosen.turn, limit)) for s in seeds]
    return table


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=2)
    parser.add_argument("--kinds", default=",".join(KINDS), help=f"some of {', '.join(ALL)}")
    parser.add_argument("--damages", default=",".join(DAMAGES))
    parser.add_argument("--names", default="without")
    parser.add_argument("--turn", default="upright", choices=("upright", "any"))
    parser.add_argument("--real", action="store_true")
    parser.add_argument("--models", default=os.environ.get(FOLDERS, ""))
    parser.add_argument("--labels", type=Path, default=LABELS)
    parser.add_argument("--only", default="")
    parser.add_argument("--held-back", action="store_true")
    parser.add_argument("--shake", default="", help=f"some of {', '.join(SHAKES)}")
    parser.add_argument("--sizes", action="store_true")
    parser.add_argument("--limit", type=int, default=300)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--words", action="store_true", help="what is wrong, silent and lost, in words")
    parser.add_argument("--out", type=Path)
    chosen = parser.parse_args()
    print(COLUMNS)
    table = cases(chosen)
    results = run([work for line in table.values() for work in line], chosen.jobs)
    everything: dict[str, list[Result]] = {}
    for line, work in table.items():
        everything[line] = [next(results) for _ in work]
        print(row(line, everything[line]), flush=True)
        for result in everything[line] if chosen.words else ():
            for title in ("silent_words", "words", "lost"):
                for text in result.get(title, ()):
                    print(f"    {title.removesuffix('_words')}: {text}")
        if chosen.out is not None:
            chosen.out.write_text(json.dumps(everything, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
