"""alignment.json: written, read, edited; edits win and survive; bad files end in one sentence."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kit.machines.synthetic import loader
from yellowiron.alignment import align, explain, read_alignment, write_alignment
from yellowiron.alignment.labelling.place import Place
from yellowiron.alignment.labelling.propagation import Propagation
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError, OutputError
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template

NOTHING = Specifications()


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


@pytest.fixture(scope="module")
def assembly() -> Assembly:
    return loader(1).assembly()


@pytest.fixture(scope="module")
def solved(assembly: Assembly, template: Template) -> Alignment:
    return align(assembly, template, NOTHING)


@pytest.fixture
def file(tmp_path: Path, solved: Alignment, assembly: Assembly) -> Path:
    path = tmp_path / "alignment.json"
    write_alignment(solved, assembly, path)
    return path


def change(path: Path, which: str, /, **values: Any) -> None:
    document = json.loads(path.read_text(encoding="utf-8"))
    for entry in document["parts"]:
        if entry["part"] == which:
            entry.update(values)
    path.write_text(json.dumps(document), encoding="utf-8")


def part_named(assembly: Assembly, name: str) -> str:
    return next(p.id for p in assembly.parts if p.name == name)


def test_the_file_is_stable_and_readable(file: Path, solved: Alignment, assembly: Assembly, tmp_path: Path) -> None:
    document = json.loads(file.read_text(encoding="utf-8"))
    assert list(document) == ["format", "equipment_type", "frame", "choices", "to_review", "missing", "parts"]
    order = [(e["body"], e["role"], e["part"]) for e in document["parts"]]
    assert order == sorted(order)
    assert {e["part"] for e in document["parts"]} == {p.id for p in assembly.parts}
    assert set(document["parts"][0]) == {
        "part",
        "role",
        "solved",
        "body",
        "confidence",
        "reason",
        "runner_up",
        "source",
        "shape",
        "place",
    }
    assert max(len(line) for line in file.read_text(encoding="utf-8").splitlines()) < 400
    again = tmp_path / "again.json"
    write_alignment(solved, assembly, again)
    assert again.read_bytes() == file.read_bytes()


def test_unedited_is_no_edit(file: Path, assembly: Assembly, template: Template, solved: Alignment) -> None:
    read = read_alignment(file, assembly, template)
    assert all(p.source != "edited" for p in read.parts)
    assert [(p.part, p.role, p.body) for p in read.parts] == [(p.part, p.role, p.body) for p in solved.parts]
    assert (read.frame == solved.frame).all()


def test_an_edit_wins_and_survives(file: Path, assembly: Assembly, template: Template) -> None:
    step = part_named(assembly, "step")
    change(file, step, role="front_frame")
    for _ in range(2):
        edits = read_alignment(file, assembly, template)
        found = align(assembly, template, NOTHING, edits=edits)
        mine = next(p for p in found.parts if p.part == step)
        assert (mine.role, mine.body, mine.source, mine.confidence) == ("front_frame", "front_frame", "edited", 1.0)
        assert mine.runner_up == "rear_frame"
        others = [p for p in found.parts if p.part != step]
        assert all(p.source == "solved" for p in others)
        write_alignment(found, assembly, file)
    entry = next(e for e in json.loads(file.read_text(encoding="utf-8"))["parts"] if e["part"] == step)
    assert (entry["role"], entry["solved"], entry["source"]) == ("front_frame", "rear_frame", "edited")


def test_a_part_can_be_left_out(file: Path, assembly: Assembly, template: Template) -> None:
    step = part_named(assembly, "step")
    change(file, step, role=None)
    found = align(assembly, template, NOTHING, edits=read_alignment(file, assembly, template))
    mine = next(p for p in found.parts if p.part == step)
    assert (mine.role, mine.body, mine.source) == (None, None, "edited")
    assert step not in found.to_review


def test_a_part_that_is_gone(file: Path, assembly: Assembly, template: Template) -> None:
    """Without shape and place (an entry written by hand), one that a person set is missed; one that was only found is
    not: the CAD model was revised."""
    step = part_named(assembly, "step")
    change(file, step, part="LOADER/rear_frame/stepp#9", shape=None, place=None)
    read = read_alignment(file, assembly, template)
    assert len(read.parts) == len(assembly.parts) - 1
    assert not [p for p in read.parts if p.source == "edited"]
    change(file, "LOADER/rear_frame/stepp#9", role="front_frame")
    with pytest.raises(AlignmentError, match="not in the CAD model") as caught:
        read_alignment(file, assembly, template)
    assert str(file) in caught.value.where
    assert "Did you mean" in caught.value.hint
    assert "Delete that entry" in caught.value.hint


@pytest.mark.parametrize(
    ("entry", "edited"),
    [
        ({"role": "boom"}, True),
        ({"role": None}, True),
        ({"role": "boom", "source": "edited"}, True),
        ({"role": "boom", "solved": "boom", "source": "edited"}, True),
        ({"role": "boom", "solved": "bucket", "source": "solved"}, True),
        ({"role": "boom", "solved": "boom"}, False),
        ({"role": "boom", "source": "solved"}, False),
        ({"role": "no longer a role", "solved": "no longer a role", "source": "solved"}, False),
        ({}, False),
    ],
)
def test_what_counts_as_an_edit(
    tmp_path: Path, assembly: Assembly, template: Template, entry: dict[str, Any], edited: bool
) -> None:
    path = tmp_path / "alignment.json"
    path.write_text(json.dumps({"parts": [{"part": assembly.parts[0].id, **entry}]}), encoding="utf-8")
    assert any(p.source == "edited" for p in read_alignment(path, assembly, template).parts) is edited
    path.write_text(json.dumps({"parts": [{"part": "gone", **entry}]}), encoding="utf-8")
    if edited:
        with pytest.raises(AlignmentError, match="not in the CAD model"):
            read_alignment(path, assembly, template)
    else:
        assert read_alignment(path, assembly, template).parts == ()


def test_another_equipment_type(file: Path, assembly: Assembly, template: Template) -> None:
    document = json.loads(file.read_text(encoding="utf-8"))
    file.write_text(json.dumps({**document, "equipment_type": "tower_crane"}), encoding="utf-8")
    with pytest.raises(AlignmentError, match="tower_crane"):
        read_alignment(file, assembly, template)


def test_an_unknown_role(file: Path, assembly: Assembly, template: Template) -> None:
    change(file, part_named(assembly, "step"), role="rear_fame")
    with pytest.raises(AlignmentError, match="no role") as caught:
        read_alignment(file, assembly, template)
    assert "rear_frame" in caught.value.hint


@pytest.mark.parametrize(
    "text",
    [
        "",
        "{",
        "[]",
        '{"parts": 3}',
        '{"format": 99, "parts": []}',
        '{"parts": [{"role": "boom"}]}',
        '{"parts": [], "frame": [1]}',
    ],
)
def test_no_alignment(tmp_path: Path, assembly: Assembly, template: Template, text: str) -> None:
    path = tmp_path / "bad.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(AlignmentError) as caught:
        read_alignment(path, assembly, template)
    assert caught.value.where.startswith(str(path))
    assert caught.value.hint


def test_no_file(tmp_path: Path, assembly: Assembly, template: Template) -> None:
    with pytest.raises(AlignmentError, match="cannot be read"):
        read_alignment(tmp_path / "none.json", assembly, template)


def test_no_folder(tmp_path: Path, solved: Alignment, assembly: Assembly) -> None:
    with pytest.raises(OutputError):
        write_alignment(solved, assembly, tmp_path / "none" / "alignment.json")


def test_explain(solved: Alignment) -> None:
    text = explain(solved, "boom_pin")
    first, *sentences = text.splitlines()
    assert first.startswith("boom_pin: 2 parts, ")
    assert len(sentences) == 2
    assert "through bores of" in text
    assert "on both sides, coaxial within" in text
    pin = next(p.part for p in solved.parts if p.role == "rocker_pin")
    assert "Moves with rocker" in explain(solved, pin)
    rod = next(p.part for p in solved.parts if p.role == "bucket_piston_rod")
    assert "Otherwise: " in explain(solved, "rocker")
    assert "  found by: joints\n" in explain(solved, rod)
    assert "the whole machine was found: 1" in explain(solved, rod)
    with pytest.raises(AlignmentError, match="neither a role nor a part") as caught:
        explain(solved, "bom_pin")
    assert "boom_pin" in caught.value.hint


def test_explain_by_the_end_of_a_path(solved: Alignment, assembly: Assembly) -> None:
    part = part_named(assembly, "step")
    name = part.rpartition("/")[2]
    assert explain(solved, name) == explain(solved, part) == explain(solved, f"REAR_FRAME/{name.upper()}")
    twice = Alignment("t", solved.frame, tuple(replace(solved.parts[0], part=f"A/{k}/PLATE") for k in "xy"))
    assert explain(twice, "y/PLATE").startswith("A/y/PLATE: ")
    with pytest.raises(AlignmentError, match="2 parts") as caught:
        explain(twice, "plate")
    assert "'A/x/PLATE', 'A/y/PLATE'" in caught.value.hint


def test_doubtful_parts_come_first(tmp_path: Path, solved: Alignment, assembly: Assembly) -> None:
    low = [replace(p, confidence=0.1 * k) for k, p in enumerate(solved.parts[-3:], 1)]
    doubtful = replace(solved, parts=(*solved.parts[:-3], *reversed(low)), to_review=tuple(p.part for p in low))
    write_alignment(doubtful, assembly, tmp_path / "a.json")
    document = json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))
    assert [e["part"] for e in document["parts"][:3]] == [p.part for p in low] == document["to_review"]


@pytest.mark.parametrize(
    ("bodies", "all_doubted"), [(("rear_frame", "front_frame", "boom", "bucket"), True), (("bucket",), False)]
)
def test_what_hangs_on_doubtful_bodies_is_doubtful(
    assembly: Assembly, template: Template, bodies: tuple[str, ...], all_doubted: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where the contacts leave most of a machine in doubt, all of it is listed for review."""
    usual = Propagation.run

    def unsure(self: Propagation) -> dict[int, Place]:
        return {i: replace(p, confidence=0.1) if p.body in bodies else p for i, p in usual(self).items()}

    monkeypatch.setattr(Propagation, "run", unsure)
    found = align(assembly, template, NOTHING)
    assert set(found.to_review) >= {p.part for p in found.parts if p.body in bodies}
    assert ({p.part for p in found.parts} <= set(found.to_review)) is all_doubted
