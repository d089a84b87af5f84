"""Tracks found by shape alone: shoes in order, wheels by what they are; and the example excavator."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kit.builds import MadeOnce, read_once
from kit.machines.crawler import Crawler, crawler
from kit.machines.tracked_template import write_tracked_template
from yellowiron.alignment import align, read_alignment, write_alignment
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.features.tracks import tracks_of
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template

Truth = dict[str, Any]
NOTHING = Specifications()


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Template:
    return load_template(write_tracked_template(tmp_path_factory.mktemp("crawler")))


def disguised(assembly: Assembly, seed: int) -> tuple[Assembly, dict[str, str], np.ndarray]:
    """Turned, shuffled and without names; new id → old id; the motion."""
    rng = np.random.default_rng(seed)
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    if np.linalg.det(q) < 0:
        q[:, 0] = -q[:, 0]
    moved = np.eye(4)
    moved[:3, :3], moved[:3, 3] = q, rng.normal(size=3) * 3
    parts, ids = [], {}
    for k, index in enumerate(rng.permutation(len(assembly.parts))):
        part = assembly.parts[index]
        name = f"Part_{k:04d}"
        ids[f"Assembly/{name}"] = part.id
        parts.append(Part(f"Assembly/{name}", name, ("Assembly",), part.shape, moved @ part.transform))
    return replace(assembly, parts=tuple(parts)), ids, moved


@pytest.mark.parametrize("bolts", [0, 4])
def test_every_part_of_a_track(bolts: int) -> None:
    drawn = crawler(36, bolts=bolts)
    assembly, ids, _ = disguised(drawn.assembly(), 5)
    solids = solids_of(assembly)
    tracks = tracks_of(solids)
    assert [len(t.shoes) for t in tracks] == [36, 36]
    for track in tracks:
        for group in (*track.shoes, *(w.members for w in track.wheels)):
            roles = {drawn.truth[ids[solids[i].part.id]] for i in group}
            assert len(roles) == 1
        assert all(len(shoe) == 2 + bolts for shoe in track.shoes)
        assert len(track.wheels) == 2 + 5 + 2


def order(drawn: Crawler, found: dict[str, str], side: str) -> list[int]:
    """The drawn numbers of the shoes, in the order found."""
    shoes = {role: found[part] for part, role in drawn.truth.items() if role.startswith(f"track_shoe_{side}")}
    drawn_of = {name: int(role.rpartition("_")[2]) for role, name in shoes.items()}
    return [drawn_of[f"track_shoe_{side}_{k}"] for k in range(1, drawn.shoes + 1)]


def test_roles(template: Template) -> None:
    """The swing tells up, the bodies' names nothing: what is left of the machine is left and right of its middle."""
    drawn = crawler(36)
    found = align(drawn.assembly(), template, NOTHING, choices={"tracks": "shoes"})
    roles = {p.part: p.role or "" for p in found.parts}
    forward = found.frame[0, 0] > 0
    for part, true in drawn.truth.items():
        kind = true.rstrip("0123456789_").rpartition("_")[0]
        if kind in ("sprocket", "idler", "track_roller", "carrier_roller", "track_shoe"):
            assert roles[part].startswith(kind), (part, true, roles[part])
            if forward and kind != "track_shoe":
                assert roles[part] == true
    assert found.counts == drawn.counts()
    numbers = order(drawn, roles, "l") if forward else []
    if numbers:
        start = numbers.index(1)
        assert [*numbers[start:], *numbers[:start]] == list(range(1, 37))
    bodies = {p.part: p.body for p in found.parts}
    assert all(bodies[part] == roles[part] for part, true in drawn.truth.items() if "shoe" in true)


def test_under_other_choices_they_move_with_the_undercarriage(template: Template) -> None:
    drawn = crawler(24, 3, 1)
    found = align(drawn.assembly(), template, NOTHING)
    bodies = {p.body for p in found.parts if "shoe" in drawn.truth[p.part]}
    assert bodies == {"undercarriage"}
    assert found.counts["track_shoe_l"] == 24


def test_the_file_keeps_them(template: Template, tmp_path: Path) -> None:
    drawn = crawler(24, 3, 1)
    assembly = drawn.assembly()
    found = align(assembly, template, NOTHING)
    write_alignment(found, assembly, tmp_path / "alignment.json")
    document = json.loads((tmp_path / "alignment.json").read_text(encoding="utf-8"))
    assert document["counts"]["track_roller_l"] == 3
    entry = next(e for e in document["parts"] if e["role"] == "track_shoe_l_3")
    entry["role"] = "track_shoe_r_3"
    (tmp_path / "alignment.json").write_text(json.dumps(document), encoding="utf-8")
    read = read_alignment(tmp_path / "alignment.json", assembly, template)
    assert read.counts == found.counts
    again = align(assembly, template, NOTHING, edits=read)
    changed = next(p for p in again.parts if p.part == entry["part"])
    assert (changed.role, changed.body, changed.source) == ("track_shoe_r_3", "undercarriage", "edited")


def test_a_few_shoes_are_no_track() -> None:
    drawn = crawler(24, 3, 1)
    few = [p for p in drawn.parts if "shoe" not in drawn.truth[p.id] or drawn.truth[p.id].endswith(("_1", "_2"))]
    assert tracks_of(solids_of(replace(drawn.assembly(), parts=tuple(few)))) == []


@pytest.fixture(scope="module")
def excavator(root: Path, made_once: MadeOnce) -> tuple[Assembly, Truth]:
    folder = root / "examples" / "excavator"
    if not (folder / "truth.json").is_file():
        pytest.skip("the example is not drawn yet")
    truth = json.loads((folder / "truth.json").read_text(encoding="utf-8"))
    return read_once(folder / "excavator.step", made_once), dict(truth)


def right(assembly: Assembly, truth: Truth, ids: dict[str, str], moved: np.ndarray, tracks: str) -> None:
    """Every part in its true body and, where pins and tracks are concerned, in its true role."""
    template = load_template("excavator")
    found = align(assembly, template, NOTHING, choices={"tracks": tracks})
    pins = {r.name for r in template.roles if r.kind == "pin"}
    carried = set(truth["undercarriage_with"]) if tracks != "shoes" else set()
    wrong = []
    for p in found.parts:
        true = truth["parts"][ids[p.part]]
        body = "undercarriage" if true["body"] in carried else true["body"]
        exact = p.role in pins or true["role"] in {*pins, *truth["undercarriage_with"]}
        if p.body != body or (exact and p.role != true["role"]):
            wrong.append((ids[p.part], p.role, p.body, true, p.reason))
    assert wrong == []
    assert found.missing == ()
    assert found.to_review == ()
    assert not [f for f in found.findings if f.severity != "info"]
    assert found.frame == pytest.approx(np.array(truth["frame"]) @ np.linalg.inv(moved), abs=1e-7)
    assert found.counts["track_shoe_l"] == found.counts["track_shoe_r"] == 49


@pytest.mark.slow
def test_the_excavator_as_drawn(excavator: tuple[Assembly, Truth]) -> None:
    assembly, truth = excavator
    right(assembly, truth, {p.id: p.id for p in assembly.parts}, np.eye(4), "belt")


@pytest.mark.slow
def test_the_excavator_nameless_turned_and_shuffled(excavator: tuple[Assembly, Truth]) -> None:
    assembly, truth = excavator
    hidden, ids, moved = disguised(assembly, 1)
    right(hidden, truth, ids, moved, "shoes")
