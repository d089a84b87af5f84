"""The example machine, as drawn and as a stranger sends it: all bodies, all pins, the frame, nothing to review."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from yellowiron.alignment import align
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.specification import Specifications

Truth = dict[str, Any]


@pytest.fixture(scope="module")
def truth(example: Path) -> Truth:
    path = example / "truth.json"
    if not path.is_file():
        pytest.skip("the example is not drawn yet")
    return dict(json.loads(path.read_text(encoding="utf-8")))


@pytest.fixture(scope="module")
def assembly(truth: Truth, loader_assembly: Assembly) -> Assembly:
    return loader_assembly


def solved_right(found: Alignment, truth: Truth, ids: dict[str, str], moved: np.ndarray) -> None:
    pins = {r.name for r in load_template("wheel_loader").roles if r.kind == "pin"}
    wrong = []
    for p in found.parts:
        true = truth["parts"][ids[p.part]]
        pin = p.role in pins or true["role"] in pins
        if p.body != true["body"] or (pin and p.role != true["role"]):
            wrong.append((ids[p.part], p.role, p.body, true, p.reason))
    assert wrong == []
    assert found.missing == ()
    assert found.to_review == ()
    assert not [f for f in found.findings if f.severity != "info"]
    assert found.frame == pytest.approx(np.array(truth["frame"]) @ np.linalg.inv(moved), abs=1e-7)


@pytest.mark.slow
def test_as_drawn(assembly: Assembly, truth: Truth) -> None:
    found = align(assembly, load_template("wheel_loader"), Specifications())
    solved_right(found, truth, {p.id: p.id for p in assembly.parts}, np.eye(4))
    assert np.isin(found.frame[:3, :3], (-1.0, 0.0, 1.0)).all()


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_nameless_turned_and_shuffled(assembly: Assembly, truth: Truth, seed: int) -> None:
    rng = np.random.default_rng(seed)
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    if np.linalg.det(q) < 0:
        q[:, 0] = -q[:, 0]
    moved = np.eye(4)
    moved[:3, :3], moved[:3, 3] = q, rng.normal(size=3)
    parts, ids = [], {}
    for number, k in enumerate(rng.permutation(len(assembly.parts)), 1):
        part = assembly.parts[int(k)]
        name = f"Part_{number:03d}"
        ids[name] = part.id
        parts.append(replace(part, id=name, name=name, path=(), transform=moved @ part.transform))
    found = align(replace(assembly, parts=tuple(parts)), load_template("wheel_loader"), Specifications())
    solved_right(found, truth, ids, moved)
