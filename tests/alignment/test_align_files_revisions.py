"""Edits survive a new revision of the CAD model: parts are known by shape and place, not by name or number."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kit.machines.excavators import excavator
from kit.machines.solids import box, place
from kit.machines.synthetic import loader
from yellowiron.alignment import align, read_alignment, write_alignment
from yellowiron.alignment.files.revisions import match_parts, prints_of
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.specification import Specifications

Revision = Callable[[Assembly, np.random.Generator], tuple[Assembly, dict[str, str]]]
"""A later assembly, and earlier id → later id for the parts that are still there."""


def _with(assembly: Assembly, parts: list[tuple[str, Part]]) -> tuple[Assembly, dict[str, str]]:
    return replace(assembly, parts=tuple(p for _, p in parts)), {old: p.id for old, p in parts if old}


def unchanged(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    return _with(assembly, [(p.id, p) for p in assembly.parts])


def reordered(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    """Parts numbered anew in another order: every id is now another part's."""
    order = rng.permutation(len(assembly.parts))
    names = [p.id for p in assembly.parts]
    return _with(
        assembly, [(assembly.parts[k].id, replace(assembly.parts[k], id=n)) for k, n in zip(order, names, strict=True)]
    )


def renamed(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    return _with(assembly, [(p.id, replace(p, id=f"NEW/{k}", name=f"{k}")) for k, p in enumerate(assembly.parts)])


def added(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    """A tenth more parts, half of them copies of others, in between."""
    parts = [(p.id, p) for p in assembly.parts]
    crate = box("crate", 0.3, 0.2, 0.1)
    for k in range(len(parts) // 10):
        at = place(rng.normal(size=3), rng.normal(size=3))
        twin = parts[int(rng.integers(len(parts)))][1]
        parts.insert(
            int(rng.integers(len(parts))), ("", Part(f"ADDED/{k}", "x", (), crate.key if k % 2 else twin.shape, at))
        )
    later, ids = _with(assembly, parts)
    return replace(later, shapes={**assembly.shapes, crate.key: crate}), ids


def removed(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    return _with(assembly, [(p.id, p) for p in assembly.parts if rng.random() > 0.15])


def moved(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    matrix = place(rng.normal(size=3) * 4, rng.normal(size=3), rng.normal(size=3))
    return _with(assembly, [(p.id, replace(p, transform=matrix @ p.transform)) for p in assembly.parts])


def changed(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    """A fifth of the shapes 4 % longer along one axis, about their middle."""
    shapes = dict(assembly.shapes)
    for key in sorted(k for k in {p.shape for p in assembly.parts} if rng.random() < 0.2):
        shape = shapes[key]
        along = np.ones(3)
        along[int(rng.integers(3))] = 1.04
        middle = shape.mesh.points.mean(axis=0)
        points = middle + (shape.mesh.points - middle) * along
        mesh = replace(shape.mesh, points=points)
        shapes[key] = replace(shape, mesh=mesh, volume=shape.volume * 1.04, area=shape.area * 1.03)
    later, ids = _with(assembly, [(p.id, p) for p in assembly.parts])
    return replace(later, shapes=shapes), ids


def all_of_it(assembly: Assembly, rng: np.random.Generator) -> tuple[Assembly, dict[str, str]]:
    ids = {p.id: p.id for p in assembly.parts}
    for step in (changed, added, removed, moved, renamed, reordered):
        assembly, then = step(assembly, rng)
        ids = {old: then[new] for old, new in ids.items() if new in then}
    return assembly, ids


REVISIONS = (unchanged, reordered, renamed, added, removed, moved, changed, all_of_it)


@pytest.fixture(scope="module")
def machines() -> dict[str, Assembly]:
    return {"loader": loader(1).assembly(), "excavator": excavator(1).assembly()}


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
@pytest.mark.parametrize("revision", REVISIONS)
def test_parts_are_found_again(machines: dict[str, Assembly], kind: str, revision: Revision) -> None:
    """Every part, save that equal parts in one place are one as good as the other, and nothing is taken for a part that
    is gone unless it is its like."""
    assembly = machines[kind]
    later, ids = revision(assembly, np.random.default_rng(4))
    found = match_parts(prints_of(assembly), prints_of(later))
    after = prints_of(later)
    lost = [i for i in ids if i not in found]
    wrong = [i for i in ids if i in found and after[found[i]] != after[ids[i]]]
    limit = 0.01 if revision is all_of_it else 0.0
    assert len(lost) + len(wrong) <= limit * len(ids), (lost[:5], wrong[:5])
    assert len(set(found.values())) == len(found)


@pytest.mark.parametrize("revision", REVISIONS)
def test_edits_survive(machines: dict[str, Assembly], tmp_path: Path, revision: Revision) -> None:
    template, assembly = load_template("wheel_loader"), machines["loader"]
    step = next(p.id for p in assembly.parts if p.name == "step")
    parts = tuple(
        PartAssignment(p.id, "boom", "boom", 1.0, "", "edited", "rear_frame")
        if p.id == step
        else PartAssignment(p.id, "bucket", "bucket", 0.9, "")
        for p in assembly.parts
    )
    path = tmp_path / "alignment.json"
    write_alignment(Alignment("wheel_loader", np.eye(4), parts), assembly, path)
    later, ids = revision(assembly, np.random.default_rng(6))
    read = read_alignment(path, later, template)
    set_by_hand = [p.part for p in read.parts if p.source == "edited"]
    assert set_by_hand == ([ids[step]] if step in ids else [])
    expected = "ALN012" if step not in ids else "ALN013" if ids[step] != step else ""
    assert [f.code for f in read.findings] == ([expected] if expected else [])
    assert [p.part for p in read.parts] == sorted((p.part for p in read.parts), key=[p.id for p in later.parts].index)


def test_a_part_that_is_gone_is_told(machines: dict[str, Assembly], tmp_path: Path) -> None:
    template, assembly = load_template("wheel_loader"), machines["loader"]
    path = tmp_path / "alignment.json"
    found = align(assembly, template, Specifications())
    write_alignment(found, assembly, path)
    step = next(p.id for p in assembly.parts if p.name == "step")
    document = json.loads(path.read_text(encoding="utf-8"))
    next(e for e in document["parts"] if e["part"] == step)["role"] = "front_frame"
    path.write_text(json.dumps(document), encoding="utf-8")
    later = replace(assembly, parts=tuple(p for p in assembly.parts if p.id != step))
    again = align(later, template, Specifications(), edits=read_alignment(path, later, template))
    assert [f.where for f in again.findings if f.code == "ALN012"] == [step]
    write_alignment(again, later, path)
    assert read_alignment(path, later, template).findings == ()
