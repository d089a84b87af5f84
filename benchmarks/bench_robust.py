"""What a few missed features cost: the drawn examples with cylinders, pins, a wheel or a body that are not told.

    python benchmarks/bench_robust.py --drawn DIR [--kinds mobile_crane,…] [--faults rams1,…] [--seeds 0,1]
        [--names with,without] [--limit S] [--words] [--out FILE.json]

DIR has a folder for every example, as its `draw.py` leaves it (`EXAMPLE.step`, `truth.json`). Each is spoiled and
solved as `yellowiron align` does, without a sheet, one after the other, names as they are drawn and without any. Seeds
from 100 on are held back. What is right, silent and a joint, is as in `tests/kit/scoring.py`; `own` is the share of the
surface that the fault itself touched: what is lost beyond it is what the rest of the machine lost. The summary gives
the mean and the worst by fault.

`rams1`, 2, 4: so many hydraulic cylinders whose rods are not told (their round faces are missing), or that are drawn
as boxes, or as one shell; `pins1`, 2, 4: so many pins not drawn; `wheel`: one wheel drawn as boxes; `body`: one body
not drawn; `moved`: the pins of one joint 20 mm off.
"""

from __future__ import annotations

import argparse
import json
import pickle
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from bench_strangers import solved  # noqa: E402
from kit.scene import Scene, Surface, TrueJoint, centres_of  # noqa: E402
from yellowiron.cad.mesh.assembly import shape_of  # noqa: E402
from yellowiron.cad.read import read_cad  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.assembly import Assembly, Part  # noqa: E402
from yellowiron.model.geometry import Mesh, Shape  # noqa: E402

KINDS = (
    "articulated_dump_truck", "backhoe_loader", "crawler_crane", "dozer", "excavator", "forklift", "grader",
    "mini_excavator", "mobile_crane", "rigid_dump_truck", "roller", "skid_steer", "telehandler", "wheel_loader",
    "wheeled_excavator",
)  # fmt: skip
TYPES = {"mini_excavator": "excavator"}
OFF = 0.02
"""Metres by which pins are moved."""


@dataclass(frozen=True, eq=False)
class Drawn:
    """An example: its model, the body and role of each part (by id), the joints of its truth, the
    halves of each hydraulic cylinder, its height in metres, and the slides of which only the direction is told."""

    kind: str
    assembly: Assembly
    truth: dict[str, tuple[str, str]]
    joints: dict[str, dict[str, Any]]
    rams: tuple[tuple[str, ...], ...]
    height: float
    nests: frozenset[str]

    @property
    def type(self) -> str:
        """The equipment type."""
        return TYPES.get(self.kind, self.kind)

    def of(self, bodies: tuple[str, ...]) -> list[Part]:
        """The parts that are the bodies themselves, without pins."""
        return [p for p in self.assembly.parts if self.truth[p.id][1] in bodies and not self.pin(p)]

    def pin(self, part: Part) -> bool:
        """Whether a part is a pin."""
        return self.truth[part.id][0].endswith("_pin")

    def changed(self, parts: dict[str, tuple[Part, Shape]]) -> Drawn:
        """With other shapes for some parts."""
        shapes = {**self.assembly.shapes, **{shape.key: shape for _, shape in parts.values()}}
        drawn = tuple(parts[p.id][0] if p.id in parts else p for p in self.assembly.parts)
        return replace(self, assembly=replace(self.assembly, parts=drawn, shapes=shapes))

    def without(self, parts: set[str]) -> Drawn:
        """Without some parts."""
        left = tuple(p for p in self.assembly.parts if p.id not in parts)
        return replace(self, assembly=replace(self.assembly, parts=left))


def example(folder: Path, kind: str) -> Drawn:
    """An example that is drawn in a folder; its model is read once."""
    kept = folder / kind / "read.pickle"
    if not kept.is_file():
        kept.write_bytes(pickle.dumps(read_cad(folder / kind / f"{kind}.step")))
    assembly = pickle.loads(kept.read_bytes())
    document = json.loads((folder / kind / "truth.json").read_text(encoding="utf-8"))
    carriers = {body: key.removesuffix("_with") for key in document if key.endswith("_with") for body in document[key]}
    rows = zip(assembly.parts, document["parts"].values(), strict=True)
    truth = {part.id: (row["role"] or "", carriers.get(row["body"], row["body"])) for part, row in rows}
    joints = {n: j for n, j in document["joints"].items() if not {j["body0"], j["body1"]} & carriers.keys()}
    kinds = {r.name: r.kind for r in load_template(TYPES.get(kind, kind)).roles}
    ends = [(joints[s]["body0"], joints[s]["body1"]) for s in document["cylinders"] if s in joints]
    halves = [tuple(b for b in pair if kinds.get(b) in ("barrel", "rod")) for pair in ends]
    up = np.array(document["frame"])[2]
    heights = np.concatenate([assembly.points_of(p) @ up[:3] for p in assembly.parts])
    slides = {n: j for n, j in joints.items() if j["type"] == "prismatic"}
    # Some truths have the anchors of twins in the middle of the machine.
    nests = frozenset(
        n for n, j in slides.items() if n not in document["cylinders"] or j["body1"].endswith(("_l", "_r"))
    )
    return Drawn(kind, assembly, truth, joints, tuple(h for h in halves if h), float(np.ptp(heights)), nests)


def boxed(drawn: Drawn, parts: list[Part]) -> Drawn:
    """With boxes instead of some parts."""
    return drawn.changed({p.id: _boxed(drawn.assembly.shape_of(p), p) for p in parts})


def _boxed(shape: Shape, part: Part) -> tuple[Part, Shape]:
    low, high = shape.mesh.points.min(axis=0), shape.mesh.points.max(axis=0)
    box = trimesh.creation.box(bounds=np.array([low, high]))
    made = shape_of(Mesh(np.asarray(box.vertices, dtype=np.float64), np.asarray(box.faces, dtype=np.int32)), shape.name)
    return replace(part, shape=made.key), made


def untold(drawn: Drawn, parts: list[Part]) -> Drawn:
    """With some parts whose shafts are not told to be round."""
    made = {}
    for part in parts:
        shape = drawn.assembly.shape_of(part)
        kept = tuple(c for c in shape.cylinders if c.inner)
        shape = replace(shape, key=f"{shape.key}-untold", cylinders=kept, knuckles=())
        made[part.id] = (replace(part, shape=shape.key), shape)
    return drawn.changed(made)


def merged(drawn: Drawn, parts: list[Part]) -> Drawn:
    """With some parts drawn as one shell, which is open at its end."""
    first, *others = parts
    into = np.linalg.inv(first.transform)
    points, triangles, start = [], [], 0
    for part in parts:
        mesh = drawn.assembly.shape_of(part).mesh
        points.append(drawn.assembly.points_of(part) @ into[:3, :3].T + into[:3, 3])
        triangles.append(mesh.triangles + start)
        start += len(mesh.points)
    every = np.concatenate(triangles).astype(np.int32)
    made = replace(
        shape_of(Mesh(np.concatenate(points), every[: -len(every) // 20]), first.name), cylinders=(), knuckles=()
    )
    made = replace(made, key=f"{made.key}-merged")
    bodies = "|".join(dict.fromkeys(drawn.truth[p.id][1] for p in parts))  # one shell is one of them
    drawn = replace(drawn, truth={**drawn.truth, first.id: ("", bodies)})
    return drawn.changed({first.id: (replace(first, shape=made.key), made)}).without({p.id for p in others})


def rams(drawn: Drawn, rng: np.random.Generator, count: int) -> tuple[Drawn, set[str]]:
    """So many hydraulic cylinders are not told."""
    touched: set[str] = set()
    chosen = rng.permutation(len(drawn.rams))[:count]
    for number in chosen.tolist():
        form = int(rng.integers(3))
        halves = drawn.rams[number]
        parts = drawn.of(halves)
        touched |= {p.id for p in parts}
        if form == 0:
            drawn = untold(drawn, parts)
        elif form == 1 or len(parts) < 2:
            drawn = boxed(drawn, parts)
        else:
            drawn = merged(drawn, parts)
    return drawn, touched


def pins(drawn: Drawn, rng: np.random.Generator, count: int) -> tuple[Drawn, set[str]]:
    """So many pins are not drawn."""
    every = [p.id for p in drawn.assembly.parts if drawn.pin(p)]
    chosen = {every[n] for n in rng.permutation(len(every))[:count].tolist()}
    return drawn.without(chosen), chosen


def wheel(drawn: Drawn, rng: np.random.Generator) -> tuple[Drawn, set[str]]:
    """One wheel is drawn as boxes."""
    kinds = {r.name: r.kind for r in load_template(drawn.type).roles}
    bodies = sorted({b for _, b in drawn.truth.values() if kinds.get(b) == "wheel"})
    if not bodies:
        return drawn, set()
    parts = drawn.of((bodies[int(rng.integers(len(bodies)))],))
    return boxed(drawn, parts), {p.id for p in parts}


def body(drawn: Drawn, rng: np.random.Generator) -> tuple[Drawn, set[str]]:
    """One body is not drawn."""
    root = load_template(drawn.type).root
    bodies = sorted({b for _, b in drawn.truth.values() if b and b != root})
    gone = bodies[int(rng.integers(len(bodies)))]
    parts = {p.id for p in drawn.assembly.parts if drawn.truth[p.id][1] == gone}
    return drawn.without(parts), parts


def moved(drawn: Drawn, rng: np.random.Generator) -> tuple[Drawn, set[str]]:
    """The pins of one joint are off."""
    every = sorted({drawn.truth[p.id][0] for p in drawn.assembly.parts if drawn.pin(p)})
    if not every:
        return drawn, set()
    role = every[int(rng.integers(len(every)))]
    way = rng.normal(size=3)
    shift = np.eye(4)
    shift[:3, 3] = OFF * way / np.linalg.norm(way)
    parts = [p for p in drawn.assembly.parts if drawn.truth[p.id][0] == role]
    made = {p.id: (replace(p, transform=shift @ p.transform), drawn.assembly.shape_of(p)) for p in parts}
    return drawn.changed(made), set(made)


FAULTS: dict[str, Callable[[Drawn, np.random.Generator], tuple[Drawn, set[str]]]] = {
    "sound": lambda drawn, _: (drawn, set()),
    **{f"rams{k}": lambda drawn, rng, k=k: rams(drawn, rng, k) for k in (1, 2, 4)},
    **{f"pins{k}": lambda drawn, rng, k=k: pins(drawn, rng, k) for k in (1, 2, 4)},
    "wheel": wheel,
    "body": body,
    "moved": moved,
}


def nameless(assembly: Assembly, seed: int) -> tuple[Assembly, dict[str, str]]:
    """The model without names, shuffled; and its ids → those before."""
    order = np.random.default_rng([seed, 11]).permutation(len(assembly.parts)).tolist()
    parts, ids = [], {}
    for number, k in enumerate(order):
        name = f"Part_{number:04d}"
        ids[name] = assembly.parts[k].id
        parts.append(replace(assembly.parts[k], id=name, name=name, path=(), node=None))
    return replace(assembly, parts=tuple(parts), nodes=()), ids


def scene(drawn: Drawn, seed: int, *, names: str) -> Scene:
    """What is solved, and what is true of it."""
    assembly = drawn.assembly
    labels: dict[tuple[str, str], int] = {}
    points, areas, label = [], [], []
    for part in assembly.parts:
        mesh = assembly.shape_of(part).mesh
        centres, sizes = centres_of(Mesh(assembly.points_of(part), mesh.triangles))
        points.append(centres)
        areas.append(sizes)
        label.append(np.full(len(sizes), labels.setdefault(drawn.truth[part.id], len(labels))))
    truth = Surface(np.concatenate(points), np.concatenate(areas), np.concatenate(label), tuple(labels))
    there = {b for _, b in labels}
    joints = tuple(
        TrueJoint(
            n,
            j["type"],
            (j["body0"], j["body1"]),
            tuple(j["anchor"]),
            tuple(j["axis"]),
            tolerance=drawn.height if n in drawn.nests else None,
        )
        for n, j in sorted(drawn.joints.items())
        if {j["body0"], j["body1"]} <= there and j["type"] != "spherical"
    )
    model = assembly if names == "with" else nameless(assembly, seed)[0]
    return Scene(model, truth, joints, drawn.height, drawn.type)


def case(sound: Drawn, fault: str, seed: int, names: str, limit: int) -> dict[str, Any]:
    """One example with one fault."""
    rng = np.random.default_rng([seed, *fault.encode(), *sound.kind.encode()])
    drawn, touched = FAULTS[fault](sound, rng)
    given = scene(drawn, seed, names=names)
    start = time.process_time()
    result = solved(given, limit)
    surface = {p.id: sound.assembly.shape_of(p).area for p in sound.assembly.parts}
    own = sum(surface[i] for i in touched) / sum(surface.values())
    keep = {k: result[k] for k in ("area", "right", "silent", "flagged", "joints", "joints_right", "failed", "choices")}
    words = {k: result.get(k, ()) for k in ("words", "silent_words", "lost", "missing")}
    spent = time.process_time() - start
    return {"kind": sound.kind, "fault": fault, "seed": seed, "names": names, "own": own, "seconds": spent,
            "touched": sorted(touched), **keep, **words}  # fmt: skip


def line(rows: list[dict[str, Any]], title: str) -> str:
    """Mean and worst of several cases."""
    right = [100 * r["right"] / r["area"] for r in rows]
    silent = [100 * r["silent"] / r["area"] for r in rows]
    listed = [100 * r["flagged"] / r["area"] for r in rows]
    joints = [100 * r["joints_right"] / max(r["joints"], 1) for r in rows]
    seconds = [r["seconds"] for r in rows]
    return (
        f"{title:42s} {len(rows):3d} {np.mean(right):6.1f} {min(right):6.1f} {np.mean(silent):6.2f} {max(silent):6.2f} "
        f"{np.mean(joints):6.1f} {min(joints):6.1f} {np.mean(listed):6.1f} {max(listed):6.1f} "
        f"{np.mean(seconds):6.1f} {max(seconds):6.1f} {100 * np.mean([r['own'] for r in rows]):5.1f}"
    )


HEAD = (
    f"{'per cent of the surface, of the joints':42s}   n  right  worst silent  worst joints  worst listed  worst "
    "CPU s    max   own"
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--drawn", type=Path, required=True)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--faults", default=",".join(FAULTS))
    parser.add_argument("--seeds", default="0")
    parser.add_argument("--names", default="with")
    parser.add_argument("--limit", type=int, default=120)
    parser.add_argument("--words", action="store_true")
    parser.add_argument("--out", type=Path)
    chosen = parser.parse_args()
    print(HEAD)
    rows: list[dict[str, Any]] = []
    for kind in chosen.kinds.split(","):
        sound = example(chosen.drawn, kind)
        for fault in chosen.faults.split(","):
            for seed in map(int, chosen.seeds.split(",")):
                for names in chosen.names.split(","):
                    rows.append(case(sound, fault, seed, names, chosen.limit))
                    print(line(rows[-1:], f"{kind}, {fault}, {seed}, {names}"), flush=True)
                    for title in ("silent_words", "words", "lost", "missing") if chosen.words else ():
                        for text in rows[-1][title]:
                            print(f"    {title}: {text}")
        if chosen.out is not None:
            chosen.out.write_text(json.dumps(rows, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    for names in chosen.names.split(","):
        for fault in (*chosen.faults.split(","), ""):
            print(line([r for r in rows if r["names"] == names and fault in ("", r["fault"])],
                       f"{fault or 'all'}, names {names}"))  # fmt: skip


if __name__ == "__main__":
    main()
