"""Machines with one defect each, without names, turned, shuffled and in a unit of their own: what is found, and that
what is wrong was flagged. `benchmarks/bench_recognition.py` measures the same on many more."""

from __future__ import annotations

import pytest

from kit.machines.defects import spoiled
from kit.machines.synthetic import disguise
from yellowiron.alignment import align
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose

TYPES = {"loader": "wheel_loader", "excavator": "excavator"}


def aligned(
    kind: str, seed: int, defect: str, *, triangles: bool = False
) -> tuple[Alignment, list[str], list[str], int]:
    """The alignment, the wrong parts, the silent ones among them, and how many there are."""
    template = load_template(TYPES[kind])
    assembly, truth, _ = disguise(spoiled(kind, seed, defect, triangles=triangles), seed, scale=True)
    found = align(assembly, template, Specifications())
    pins = {r.name for r in choose(template, found.choices).roles if r.kind == "pin"}
    wrong = []
    for p in found.parts:
        role, body = truth[p.part]
        through = "rod_l_pin" in role and (p.role or "").replace("_r_pin", "_l_pin") == role
        if body and (p.body != body or ((p.role in pins or role in pins) and p.role != role and not through)):
            wrong.append(f"{p.part}: {p.role}/{p.body}, not {role}/{body}: {p.reason}")
    silent = [w for w in wrong if w.partition(":")[0] not in found.to_review]
    return found, wrong, silent, len(found.parts)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
def test_shrunk(kind: str) -> None:
    found, wrong, _, count = aligned(kind, 1, "0.3 % shrink")
    assert wrong == []
    assert len(found.to_review) <= 0.02 * count  # hoses that are torn between two bodies


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "seed", "defect", "triangles"),
    [("loader", 0, "1 mm jitter", True), ("excavator", 1, "half the pins", False), ("loader", 1, "8 segments", True)],
)
def test_moved_and_poor(kind: str, seed: int, defect: str, triangles: bool) -> None:
    found, wrong, _, count = aligned(kind, seed, defect, triangles=triangles)
    assert wrong == []
    assert len(set(found.to_review) - set(found.missing)) <= 0.02 * count  # hoses that are torn between two bodies


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
def test_a_missing_cylinder_is_named_and_its_pins_flagged(kind: str) -> None:
    found, wrong, silent, count = aligned(kind, 1, "missing cylinder")
    assert silent == []
    assert 0 < len(wrong) <= 0.03 * count  # the pins that nothing hangs on any more
    assert any("cylinder_barrel" in role for role in found.missing)


@pytest.mark.slow
@pytest.mark.parametrize("defect", ["sound", "no pins", "0.3 % shrink", "missing cylinder"])
@pytest.mark.parametrize("kind", ["loader", "excavator"])
def test_unseen(kind: str, defect: str) -> None:
    _, wrong, silent, count = aligned(kind, 1500, defect)
    assert len(wrong) <= 0.05 * count
    assert len(silent) <= 0.01 * count
