"""A person's decisions: patterns over the CAD tree, a yes that never flips, who, when and why; clashes are told."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kit.machines.synthetic import loader
from yellowiron.alignment import align, decide, parse_rules, read_alignment, write_alignment
from yellowiron.alignment.files.decisions import Decision, doubts, fits
from yellowiron.library import load_template
from yellowiron.model.alignment import UNDECIDED, Alignment, Decisions, PartAssignment, Signature
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import AlignmentError
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template

NOTHING = Specifications()
ANN = Signature("Ann", "2026-11-23", "it is bolted there")


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


@pytest.fixture(scope="module")
def assembly() -> Assembly:
    """A loader whose cab and step are in an assembly of their own."""
    drawn = loader(1).assembly()
    parts = tuple(replace(p, path=(*p.path, "CAB ASSY")) if p.name in ("cab", "step") else p for p in drawn.parts)
    return replace(drawn, parts=parts)


def solved(
    assembly: Assembly, template: Template, decisions: Decisions = UNDECIDED, earlier: Alignment | None = None
) -> Alignment:
    return align(assembly, template, NOTHING, edits=decide(earlier, decisions, assembly, template))


def the(found: Alignment, assembly: Assembly, name: str) -> PartAssignment:
    part = next(p.id for p in assembly.parts if p.name == name)
    return next(p for p in found.parts if p.part == part)


def part(*names: str, number: str = "") -> Part:
    return Part("/".join(names) + number, names[-1], names[:-1], "s", np.eye(4))


@pytest.mark.parametrize("pattern", [
    "ADT30/HITCH/*", "adt30/hitch", "HITCH", "HITCH/Pin M24", "pin_m24", "*M24*", "ADT30/HITCH/PIN M24#2",
    "HITCH/pin-m24#2",
])  # fmt: skip
def test_a_pattern_names_parts_and_assemblies_by_as_much_of_the_path_as_it_gives(pattern: str) -> None:
    assert fits(pattern)(part("ADT30", "HITCH", "PIN M24", number="#2"))


@pytest.mark.parametrize("pattern", ["ADT30/HITCH/*", "HITCH", "*M24", "IT/CAB", "CAB/*", "C[AB]B"])
def test_a_pattern_names_nothing_else(pattern: str) -> None:
    assert not fits(pattern)(part("ADT30", "TRACTOR", "CAB"))


def test_brackets_are_letters_of_names() -> None:
    assert fits("shoe[*]")(part("TRACK", "shoe[3]"))


@pytest.mark.slow
def test_an_assembly_takes_the_role_that_a_person_gives_it(
    assembly: Assembly, template: Template, tmp_path: Path
) -> None:
    decisions = Decisions(parse_rules(["CAB ASSY/*=front_frame"], ANN), signature=ANN)
    found, file = solved(assembly, template, decisions), tmp_path / "alignment.json"
    for _ in range(2):  # the rule stays, and the file with it
        for name in ("cab", "step"):
            mine = the(found, assembly, name)
            assert (mine.role, mine.source, mine.confidence) == ("front_frame", "rule", 1.0)
            assert "'CAB ASSY/*' (Ann, 2026-11-23): it is bolted there" in mine.reason
        write_alignment(found, assembly, file)
        before = file.read_bytes()
        found = solved(assembly, template, earlier=read_alignment(file, assembly, template))
        write_alignment(found, assembly, file)
        assert file.read_bytes() == before
    assert json.loads(before)["rules"] == [
        {"pattern": "CAB ASSY/*", "role": "front_frame", "by": "Ann", "date": "2026-11-23", "why": "it is bolted there"}
    ]
    again = solved(assembly, template, Decisions(forgotten=("CAB ASSY/*",)), read_alignment(file, assembly, template))
    assert the(again, assembly, "cab").role == "rear_frame"
    assert again.rules == ()


def test_what_was_said_once_keeps_its_date(assembly: Assembly, template: Template) -> None:
    first = decide(None, Decisions(parse_rules(["step=none"], Signature("Ann", "2026-01-01"))), assembly, template)
    later = Decisions(parse_rules(["step=none"], Signature("Ann", "2026-02-02")))
    again = decide(first, later, assembly, template)
    assert again is not None
    assert [r.signature.date for r in again.rules] == ["2026-01-01"]


def test_a_part_left_out_by_a_pattern(assembly: Assembly, template: Template) -> None:
    found = solved(assembly, template, Decisions(parse_rules(["step=none"])))
    assert (the(found, assembly, "step").role, the(found, assembly, "step").body) == (None, None)


@pytest.mark.slow
def test_a_yes_holds_whatever_else_changes(assembly: Assembly, template: Template, tmp_path: Path) -> None:
    file = tmp_path / "alignment.json"
    found = solved(assembly, template)
    write_alignment(found, assembly, file)
    cab = the(found, assembly, "cab")
    earlier = read_alignment(file, assembly, template)
    yes = solved(assembly, template, Decisions(confirmed=("cab",), signature=ANN), earlier)
    assert the(yes, assembly, "cab").source == "confirmed"
    write_alignment(yes, assembly, file)
    # All that its body is made of otherwise is told to be another one.
    others = Decisions(parse_rules(["*=front_frame"]))
    held = read_alignment(file, assembly, template)
    everything = replace(held, rules=others.rules)
    after = the(align(assembly, template, NOTHING, edits=everything), assembly, "cab")
    assert (after.role, after.body, after.source) == (cab.role, cab.body, "confirmed")
    assert after.reason == "found, and confirmed by a person (Ann, 2026-11-23): it is bolted there"


def test_a_yes_that_is_changed_is_an_edit(assembly: Assembly, template: Template, tmp_path: Path) -> None:
    file = tmp_path / "alignment.json"
    found = solved(assembly, template)
    write_alignment(found, assembly, file)
    yes = solved(assembly, template, Decisions(confirmed=("cab",)), read_alignment(file, assembly, template))
    write_alignment(yes, assembly, file)
    document = json.loads(file.read_text())
    entry = next(e for e in document["parts"] if e["source"] == "confirmed")
    entry["role"] = "front_frame"
    file.write_text(json.dumps(document))
    read = the(read_alignment(file, assembly, template), assembly, "cab")
    assert (read.role, read.source) == ("front_frame", "edited")


def test_nothing_is_confirmed_that_was_not_found(assembly: Assembly, template: Template) -> None:
    with pytest.raises(AlignmentError, match="no earlier alignment") as caught:
        decide(None, Decisions(confirmed=("cab",)), assembly, template)
    assert "--out" in (caught.value.hint or "")


def test_contradictions_are_told_and_obeyed(assembly: Assembly, template: Template) -> None:
    rules = parse_rules(["CAB ASSY=front_frame", "step=none", "hopper=bucket"])
    found = solved(assembly, template, Decisions(rules))
    told = {f.code: f for f in found.findings if f.code in ("ALN026", "ALN027", "ALN028")}
    assert set(told) == {"ALN026", "ALN027", "ALN028"}
    assert told["ALN026"].where == "hopper"
    assert "'step' goes before an earlier pattern" in told["ALN027"].message
    assert "front_frame" in told["ALN027"].message
    assert "speak clearly for rear_frame" in told["ALN028"].message
    assert the(found, assembly, "cab").role == "front_frame"
    assert the(found, assembly, "step").role is None


@pytest.mark.parametrize("text", ["cab", "=rear_frame", "cab="])
def test_half_a_rule_is_refused(text: str) -> None:
    with pytest.raises(AlignmentError, match="no pattern with a role"):
        parse_rules([text])


def test_a_role_that_is_none_is_refused(assembly: Assembly, template: Template) -> None:
    with pytest.raises(AlignmentError, match="no role of the template"):
        decide(None, Decisions(parse_rules(["cab=kitchen"])), assembly, template)


@pytest.mark.slow
def test_a_few_parts_do_not_take_their_body_along(assembly: Assembly, template: Template) -> None:
    """All the small parts of the rear frame that are told to be of the front one are; nothing else changes."""
    before = solved(assembly, template)
    areas = {p.id: assembly.shape_of(p).area for p in assembly.parts}
    rear = sorted((p for p in before.parts if p.role == "rear_frame"), key=lambda p: areas[p.part])
    some = {p.part for p in rear[: len(rear) // 2]}
    assert len(some) >= 3
    after = solved(assembly, template, Decisions(parse_rules([f"{part}=front_frame" for part in sorted(some)])))
    for old, new in zip(before.parts, after.parts, strict=True):
        assert new.role == ("front_frame" if new.part in some else old.role), new.part


@pytest.mark.parametrize("what", ["confirmed", "forgotten"])
def test_a_pattern_that_fits_nothing_is_refused(what: str, assembly: Assembly, template: Template) -> None:
    earlier = Alignment("wheel_loader", np.eye(4), ())
    with pytest.raises(AlignmentError, match="'CABIN' fits no part"):
        decide(earlier, Decisions(**{what: ("CABIN",)}), assembly, template)


def test_doubts_of_different_roles_are_told_apart() -> None:
    """Two parts edited by hand, for the same reason but to other roles, are two remarks."""
    decisions = {p: Decision(role, "edited", "set by a person") for p, role in (("a", "boom"), ("b", None))}
    found = [PartAssignment(p, "bucket", "bucket", 0.99, "") for p in decisions]
    assert [f.message.split(", role ")[1].split(";")[0] for f in doubts(decisions, found)] == ["boom", "none"]
