"""Poor CAD the whole way through `build`: a machine comes out, what is missing is named, what is certain is kept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kit.machines.crawler import merged
from kit.machines.excavators import excavator
from kit.machines.synthetic import Machine, disguise, loader
from yellowiron import cad, pipeline
from yellowiron.library import load_template
from yellowiron.model.assembly import Part
from yellowiron.report import fell_short

pytestmark = pytest.mark.slow
Spoil = Callable[[Machine], None]
HALVES = ("cylinder_barrel", "piston_rod")


def without(*gone: str) -> Spoil:
    """Parts whose role or body begins so are not there."""

    def spoil(machine: Machine) -> None:
        machine.parts[:] = [p for p in machine.parts if not any(t.startswith(gone) for t in machine.truth[p.id])]

    return spoil


def no_pins(machine: Machine) -> None:
    pins = {r.name for t in ("wheel_loader", "excavator") for r in load_template(t).roles if r.kind == "pin"}
    machine.parts[:] = [p for p in machine.parts if machine.truth[p.id][0] not in pins - {"swing_bearing"}]


def no_bores(machine: Machine) -> None:
    """Holes are in the meshes, but were not recognised."""
    machine.shapes = {
        k: replace(s, cylinders=tuple(c for c in s.cylinders if not c.inner)) for k, s in machine.shapes.items()
    }


def one_part(*bodies: str) -> Spoil:
    """All parts of some bodies are one."""

    def spoil(machine: Machine) -> None:
        inside = [p for p in machine.parts if machine.truth[p.id][1] in bodies]
        shape = merged("merged", *((machine.shapes[p.shape], p.transform) for p in inside))
        machine.shapes["merged"] = shape
        first = inside[0]
        whole = Part(first.id, first.name, first.path, "merged", np.eye(4))
        machine.parts[:] = [p for p in machine.parts if p not in inside] + [whole]

    return spoil


def fork(machine: Machine) -> None:
    """Of the bucket only what has bores is there: the shell is gone."""
    bored = {k for k, s in machine.shapes.items() if any(c.inner for c in s.cylinders)}
    machine.parts[:] = [p for p in machine.parts if machine.truth[p.id][1] != "bucket" or p.shape in bored]


def everything(machine: Machine) -> None:
    one_part(*{body for _, body in machine.truth.values()})(machine)


def built(
    kind: str, spoil: Spoil, monkeypatch: pytest.MonkeyPatch, out: Path, *, hoses: int = 0
) -> tuple[Any, set[str]]:
    """The machine of a build, nameless and turned, and the ids of parts that are wrong and not to be looked at."""
    machine = loader(1, hoses=hoses) if kind == "wheel_loader" else excavator(1)
    spoil(machine)
    assembly, truth, _ = disguise(machine, 1)
    monkeypatch.setattr(cad, "check_file", lambda file: None)
    monkeypatch.setattr(cad, "read_cad", lambda file: assembly)
    monkeypatch.setattr(pipeline.report, "page", lambda *a, **more: "")
    result = pipeline.build(kind, Path("machine.step"), out)
    assert (out / "scene.usda").exists()
    found = {p.part: p.body for p in result.alignment.parts}
    wrong = {part for part, (_, body) in truth.items() if body and found[part] != body}
    return result, wrong - set(result.alignment.to_review)


def named(result: Any) -> set[str]:
    """All that the findings and the list of missing roles speak of."""
    return {*result.alignment.missing, *(f["where"] for f in result.document["findings"])}


LOADER: dict[str, tuple[Spoil, set[str], set[str]]] = {
    # what is spoiled, the names that must be said, the actuators that are left
    "no bores": (no_bores, set(), {"steering", "boom", "bucket", "drive"}),
    "no lift cylinders": (
        without(*(f"boom_{h}" for h in HALVES)), {"boom_cylinder_barrel", "boom"}, {"boom", "bucket"},
    ),
    "a fork": (fork, set(), {"boom", "bucket"}),
    "no articulation": (one_part("front_frame", "rear_frame"), {"steering"}, {"boom", "bucket"}),
    "a cylinder in one part": (
        one_part("bucket_cylinder_barrel", "bucket_piston_rod"), {"bucket_cylinder_barrel"}, {"boom"},
    ),
    "everything in one part": (everything, {"boom", "bucket"}, set()),
}  # fmt: skip
EXCAVATOR: dict[str, tuple[Spoil, set[str], set[str]]] = {
    "no pins": (no_pins, {"boom_pin", "arm_pin"}, {"boom", "arm", "bucket"}),
    "no cylinders": (
        without(*(f"{c}_{h}" for c in ("boom", "arm", "bucket") for h in HALVES)), {"boom", "arm", "bucket"},
        {"swing", "boom", "arm", "bucket"},
    ),
    "no links": (without("tipping_link", "bucket_link"), {"tipping_link", "bucket_link"}, {"swing", "boom", "arm"}),
}  # fmt: skip


@pytest.mark.parametrize("case", LOADER)
def test_a_poor_loader(case: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    check("wheel_loader", *LOADER[case], monkeypatch, tmp_path)


@pytest.mark.parametrize("case", EXCAVATOR)
def test_a_poor_excavator(case: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    check("excavator", *EXCAVATOR[case], monkeypatch, tmp_path)


def test_hoses_everywhere(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    result, silent = built("wheel_loader", lambda machine: None, monkeypatch, tmp_path / "out", hoses=20)
    assert silent == set()
    assert result.alignment.missing == ()
    assert len(result.document["joints"]) == 26


def check(
    kind: str, spoil: Spoil, said: set[str], left: set[str], monkeypatch: pytest.MonkeyPatch, folder: Path
) -> None:
    result, silent = built(kind, spoil, monkeypatch, folder / "out")
    assert said <= named(result)
    assert left <= {a.name for a in result.mechanism.actuators}
    assert len(silent) <= 0.05 * len(result.alignment.parts)
    assert fell_short(result.document)
