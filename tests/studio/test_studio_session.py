"""Decisions and what they come to: undone, redone, found again, and built as the command line builds them."""

from __future__ import annotations

import json
import os
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kit.builds import without_usd
from yellowiron.model.errors import YellowironError
from yellowiron.opinion.doubts import boxes_of
from yellowiron.pipeline import build
from yellowiron.solved import Solved
from yellowiron.studio import Session, Setup, read_setup
from yellowiron.studio import session as studio_session
from yellowiron.studio.joints import MOST_ROUNDS, joints_of, rounds_of
from yellowiron.studio.operations import words
from yellowiron.studio.questions import in_words, questions
from yellowiron.studio.scene import Scene
from yellowiron.studio.session import State
from yellowiron.studio.twins import twins_of

pytestmark = pytest.mark.usefixtures("no_pages")
CAB = "WHEEL LOADER GA/REAR MACHINE/CAB ASSY ROPS"


def roles(session: Session) -> dict[str, str | None]:
    return {p.part: p.role for p in session.settled(60.0).aligned.parts}


def kept(session: Session) -> dict[str, dict[str, object]]:
    document = json.loads((session.setup.out / "alignment.json").read_text(encoding="utf-8"))
    return {e["part"]: e for e in document["parts"] if e["source"] in ("edited", "confirmed")}


@pytest.mark.slow
def test_decided_undone_redone_and_found_again(open_studio: Callable[[], Session]) -> None:
    session = open_studio()
    before = roles(session)
    part = next(p for p, role in before.items() if role == "boom")
    other = next(p for p, role in before.items() if role == "rear_frame")
    session.do(session.read({"kind": "role", "parts": {part: "front_frame"}, "why": "it is bolted there"}))
    session.do(session.read({"kind": "confirm", "parts": {other: "rear_frame"}}))
    assert roles(session)[part] == "front_frame"
    session.keep()
    assert kept(session)[part]["role"] == "front_frame"
    assert (kept(session)[part]["by"], kept(session)[part]["why"]) == ("Ann", "it is bolted there")
    assert kept(session)[other]["source"] == "confirmed"

    # The program is killed: nothing is closed. Another goes on where it was.
    again = open_studio()
    operations, cursor = again.history()
    assert (len(operations), cursor) == (2, 2)
    again.undo()
    again.undo()
    assert roles(again) == before
    again.keep()
    assert kept(again) == {}
    again.redo()
    assert roles(again)[part] == "front_frame"
    again.do(again.read({"kind": "forget", "parts": {part: None}}))
    assert roles(again) == before

    # A person edits the file by hand: the history was of other decisions, and begins anew from that.
    file = again.setup.out / "alignment.json"
    again.keep()
    document = json.loads(file.read_text(encoding="utf-8"))
    next(e for e in document["parts"] if e["part"] == other)["role"] = None
    file.write_text(json.dumps(document), encoding="utf-8")
    third = open_studio()
    assert third.history() == ([], 0)
    assert roles(third)[other] is None


@pytest.mark.slow
def test_killed_between_the_journal_and_the_file(open_studio: Callable[[], Session]) -> None:
    """Three decisions were answered, and the program was killed before it had solved them: none is lost. But a file
    that a person puts back by hand goes before the history."""
    session = open_studio()
    file = session.setup.out / "alignment.json"
    parts = [p for p, role in roles(session).items() if role == "rear_frame"][:4]
    session.do(session.read({"kind": "role", "parts": {parts[0]: "front_frame"}}))
    session.settled(60.0)
    session.keep()
    early = file.read_bytes()
    for part in parts[1:]:
        session.do(session.read({"kind": "role", "parts": {part: "front_frame"}}))
    session.undo()
    session.settled(60.0)
    session.keep()
    session.close()
    file.write_bytes(early)
    os.utime(file, ns=(0, 0))
    again = open_studio()
    assert [len(again.history()[0]), again.history()[1]] == [4, 3]
    assert [roles(again)[p] for p in parts] == ["front_frame"] * 3 + ["rear_frame"]
    again.keep()
    again.close()
    file.write_bytes(early)
    third = open_studio()
    assert third.history() == ([], 0)
    assert [roles(third)[p] for p in parts] == ["front_frame"] + ["rear_frame"] * 3


@pytest.mark.slow
def test_decisions_that_come_while_others_are_solved(open_studio: Callable[[], Session]) -> None:
    session = open_studio()
    parts = [p for p, role in roles(session).items() if role == "rear_frame"][:12]
    for part in parts:
        session.do(session.read({"kind": "role", "parts": {part: "front_frame"}}))
        time.sleep(0.17)
    state = session.settled(60.0)
    assert state.said == session.said == 12
    assert {p.part for p in state.aligned.parts if p.source == "edited"} == set(parts)


@pytest.mark.slow
def test_values_are_asked_given_and_kept(open_studio: Callable[[], Session]) -> None:
    session = open_studio()
    asked = {q.key: q for q in questions(session.state, boxes_of(session.assembly))}
    assert {"value:Lift Cylinder Stroke", "value:Tilt Cylinder Stroke"} <= asked.keys()
    lift = asked["value:Lift Cylinder Stroke"]
    assert [c.answer for c in lift.candidates] == ["764 mm"]
    assert "piston travel" in lift.candidates[0].words
    assert any("pins 1469 mm apart" in known for known in lift.known)
    session.do(session.read({"kind": "value", "name": "Lift Cylinder Stroke", "text": "764 mm"}))
    state = session.settled(60.0)
    assert state.specifications.number("Lift Cylinder Stroke") == pytest.approx(0.764)
    left = {q.key for q in questions(state, boxes_of(session.assembly))}
    assert "value:Lift Cylinder Stroke" not in left and "value:Tilt Cylinder Stroke" in left
    assert state.solved is not None
    boom = next(c for c in state.solved.mechanism.cylinders if c.name == "boom_cylinder_l")
    assert boom.stroke == pytest.approx(0.764)
    assert "set" in boom.sources["stroke"] or "Lift Cylinder Stroke" in boom.sources["stroke"]
    for text in ("764 bananas", "many", "-3 m"):
        with pytest.raises(YellowironError):
            session.do(session.read({"kind": "value", "name": "Lift Cylinder Stroke", "text": text}))
    with pytest.raises(YellowironError):
        session.do(session.read({"kind": "value", "name": "Wing Span", "text": "3 m"}))
    assert len(session.history()[0]) == 1
    again = open_studio()
    assert again.state.specifications.number("Lift Cylinder Stroke") == pytest.approx(0.764)


@pytest.mark.slow
def test_a_pattern_is_one_decision_that_is_kept_told_and_taken_back(open_studio: Callable[[], Session]) -> None:
    session = open_studio()
    before = roles(session)
    inside = [part for part in before if part.startswith(f"{CAB}/")]
    one, other = inside[0], inside[1]
    assert len(inside) > 5
    session.do(session.read({"kind": "role", "parts": {one: "boom"}}))
    session.do(session.read({"kind": "rule", "name": "CAB ASSY ROPS/*", "text": "front_frame"}))
    state = session.settled(60.0)
    # What was said last holds, for all that is named so, and what it goes before is told.
    assert {roles(session)[part] for part in inside} == {"front_frame"}
    assert {p.source for p in state.aligned.parts if p.part in inside} == {"rule"}
    name = one.rsplit("/", 1)[-1]
    assert f"'CAB ASSY ROPS/*' goes before what was said of single parts earlier: {name} (boom)" in state.remarks
    assert words(session.history()[0][-1]) == "All that is named CAB ASSY ROPS/* → front frame"
    # A part's own decision goes before the pattern, and that is told too.
    session.do(session.read({"kind": "role", "parts": {other: None}}))
    state = session.settled(60.0)
    assert roles(session)[other] is None and roles(session)[one] == "front_frame"
    assert any(
        "own decision goes before 'CAB ASSY ROPS/*'" in remark and f"'{other.rsplit('/', 1)[-1]}'" in remark
        for remark in state.remarks
    )
    session.keep()
    written = json.loads((session.setup.out / "alignment.json").read_text(encoding="utf-8"))
    assert [(r["pattern"], r["role"], r["by"]) for r in written["rules"]] == [("CAB ASSY ROPS/*", "front_frame", "Ann")]
    assert kept(session).keys() == {other}

    # Another goes on where it was, and takes all of it back.
    again = open_studio()
    assert again.history()[1] == 3
    again.undo()
    again.undo()
    state = again.settled(60.0)
    assert not any("'CAB ASSY ROPS/*'" in remark for remark in state.remarks)
    assert roles(again) == {**before, **{p: r for p, r in roles(again).items() if p not in inside}, one: "boom"}
    again.redo()
    assert roles(again)[one] == "front_frame"
    again.do(again.read({"kind": "rule", "name": "CAB ASSY ROPS/*", "text": ""}))
    assert again.settled(60.0).aligned.rules == () and roles(again)[other] == before[other]
    again.do(again.read({"kind": "rule", "name": "CAB ASSY ROPS", "text": "none"}))
    assert {roles(again)[part] for part in inside} == {None}
    again.do(again.read({"kind": "rule", "name": "NOT THERE/*", "text": "boom"}))
    assert any("'NOT THERE/*'" in remark and "fits no part" in remark for remark in again.settled(60.0).remarks)
    for broken in ({"name": "", "text": "boom"}, {"name": "CAB ASSY ROPS/*", "text": "bridge"}, {"name": 3}):
        with pytest.raises(YellowironError):
            again.read({"kind": "rule", **broken})

    # The command line's pattern in the same file is one more of them.
    again.keep()
    again.close()
    file = again.setup.out / "alignment.json"
    document = json.loads(file.read_text(encoding="utf-8"))
    document["rules"].append({"pattern": "*BOLT*", "role": "rear_frame"})
    file.write_text(json.dumps(document), encoding="utf-8")
    third = open_studio()
    assert [rule.pattern for rule in third.settled(60.0).aligned.rules] == ["CAB ASSY ROPS", "NOT THERE/*", "*BOLT*"]
    third.do(third.read({"kind": "rule", "name": "*BOLT*", "text": ""}))
    assert [rule.pattern for rule in third.settled(60.0).aligned.rules] == ["CAB ASSY ROPS", "NOT THERE/*"]


@pytest.mark.slow
def test_the_round_things_of_a_joint(open_studio: Callable[[], Session]) -> None:
    """What both bodies have comes first, and the joint's own axis is the first of all."""
    session = open_studio()
    state = session.settled(60.0)
    for name in ("front_frame2boom_joint", "rear_frame2front_frame_joint"):
        if name not in {joint.name for joint in state.template.joints}:
            continue
        joint = state.solved.mechanism.joint(name)  # type: ignore[union-attr]
        rounds = rounds_of(state, name)
        assert 1 < len(rounds) <= MOST_ROUNDS
        point = state.aligned.frame @ (*rounds[0].entry["anchor"], 1.0)
        away = point[:3] - joint.anchor
        assert np.linalg.norm(away - (away @ joint.axis) * np.array(joint.axis)) < 2e-3
        assert len({json.dumps(one.entry) for one in rounds}) == len(rounds)
    # Of a joint whose axis nobody knows, those near the place where its bodies meet.
    lost = replace(state, aligned=replace(state.aligned, axes={}))
    assert rounds_of(lost, "front_frame2boom_joint")
    nothing = replace(state, aligned=replace(state.aligned, parts=()))
    assert rounds_of(nothing, "front_frame2boom_joint") == rounds_of(state, "no such joint") == []


@pytest.mark.slow
def test_a_joint_by_hand_is_kept_taken_back_and_built(open_studio: Callable[[], Session]) -> None:
    session = open_studio()
    name = "front_frame2boom_joint"
    before = session.state.solved.mechanism.joint(name)  # type: ignore[union-attr]
    assert next(j for j in joints_of(session.state, 8.0) if j.name == name).known == "found"
    there = np.linalg.inv(session.state.aligned.frame) @ (*before.anchor[:2], before.anchor[2] + 0.1, 1.0)
    axis = np.linalg.inv(session.state.aligned.frame)[:3, :3] @ before.axis
    said = {"anchor": there[:3].tolist(), "axis": axis.tolist(), "Limit": [-40, 40]}
    session.do(session.read({"kind": "joint", "name": name, "entry": said, "date": "2026-11-23"}))
    state = session.settled(60.0)
    moved = state.solved.mechanism.joint(name)  # type: ignore[union-attr]
    assert moved.anchor[2] == pytest.approx(before.anchor[2] + 0.1, abs=1e-6)
    told = next(j for j in joints_of(state, 8.0) if j.name == name)
    assert (told.known, told.entry["Limit"]) == ("given", [-40, 40])
    session.keep()
    written = json.loads((session.setup.out / "alignment.json").read_text(encoding="utf-8"))["joints"][name]
    assert (written["by"], written["date"], written["Limit"]) == ("Ann", "2026-11-23", [-40, 40])

    # Another goes on where it was; the command line builds what is on the screen.
    again = open_studio()
    assert again.state.solved.mechanism.joint(name).anchor == moved.anchor  # type: ignore[union-attr]
    with without_usd():
        machine = build("wheel_loader", again.setup.cad, again.setup.out)
    assert machine.mechanism.joint(name).anchor == moved.anchor
    assert any(entry.startswith("front frame2boom joint: its axis") for entry in map(words, again.history()[0]))
    again.do(again.read({"kind": "joint", "name": name, "entry": {}}))
    assert again.settled(60.0).solved.mechanism.joint(name).anchor == before.anchor  # type: ignore[union-attr]
    again.keep()
    assert "joints" not in json.loads((again.setup.out / "alignment.json").read_text(encoding="utf-8"))
    for broken in ({"anchor": [0, 0, 1]}, {"colour": 1}, {"axis": "up"}, {"through": [[0, 0, 0]] * 2}):
        with pytest.raises(YellowironError):
            again.do(again.read({"kind": "joint", "name": name, "entry": broken}))


@pytest.mark.slow
def test_the_machine_is_there_before_it_is_measured(
    open_studio: Callable[[], Session], monkeypatch: pytest.MonkeyPatch
) -> None:
    session = open_studio()
    first = session.measured(60.0)
    assert first.document["measurements"] and first.poses
    part = next(p.part for p in first.aligned.parts if p.role == "boom")
    may, measure = threading.Event(), studio_session.measured_of
    monkeypatch.setattr(studio_session, "measured_of", lambda mechanism: (may.wait(60.0), measure(mechanism))[1])
    # What says that something is right leaves the machine as it was measured.
    session.do(session.read({"kind": "confirm", "parts": {part: "boom"}}))
    same = session.settled(60.0)
    assert same.measured and same.document["measurements"] == first.document["measurements"]
    session.do(session.read({"kind": "value", "name": "Lift Cylinder Stroke", "text": "700 mm"}))
    shown = session.settled(60.0)
    assert shown.solved is not None and not shown.measured and shown.document["measurements"] == []
    may.set()
    known = session.measured(60.0)
    assert known.version > shown.version and known.solved is shown.solved
    assert known.document["measurements"] and known.poses


@pytest.mark.slow
def test_what_is_seen_later_has_the_higher_number(
    open_studio: Callable[[], Session], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A machine is measured while the next one is solved: a page, which takes only what is newer than what it has, must
    see the second."""
    session = open_studio()
    session.measured(60.0)
    may, measure, solve = threading.Event(), studio_session.measured_of, studio_session.solve
    monkeypatch.setattr(studio_session, "measured_of", lambda mechanism: (may.wait(60.0), measure(mechanism))[1])
    session.do(session.read({"kind": "value", "name": "Lift Cylinder Stroke", "text": "700 mm"}))
    session.settled(60.0)
    between: list[State] = []

    def solved_late(*args: object) -> Solved:
        may.set()
        end = time.monotonic() + 60.0
        while not session.state.measured and time.monotonic() < end:
            time.sleep(0.01)
        between.append(session.state)
        return solve(*args)

    monkeypatch.setattr(studio_session, "solve", solved_late)
    session.do(session.read({"kind": "value", "name": "Lift Cylinder Stroke", "text": "710 mm"}))
    last = session.settled(60.0)
    assert between[0].measured and between[0].said < last.said
    assert between[0].version < last.version


@pytest.mark.slow
def test_a_state_that_cannot_be_made_ends_nothing(
    open_studio: Callable[[], Session], monkeypatch: pytest.MonkeyPatch
) -> None:
    session = open_studio()
    part = next(p.part for p in session.state.aligned.parts if p.role == "boom")

    def broken(*_: object) -> None:
        raise ZeroDivisionError("nobody foresaw this")

    for place in ("yellowiron.studio.session.solve", "yellowiron.studio.session.measured_of"):
        with monkeypatch.context() as patched:
            patched.setattr(place, broken)
            session.do(session.read({"kind": "role", "parts": {part: "front_frame"}}))
            assert "nobody foresaw this" in session.measured(60.0).failed
        session.undo()
        assert session.measured(60.0).failed == ""
    session.do(session.read({"kind": "confirm", "parts": {part: "boom"}}))
    assert session.settled(60.0).failed == ""
    assert {p.part: p.source for p in session.state.aligned.parts}[part] == "confirmed"


@pytest.mark.slow
def test_the_other_side_too(open_studio: Callable[[], Session]) -> None:
    session = open_studio()
    twins = twins_of(session.assembly, session.state.aligned.frame)
    found = roles(session)
    left = next(p for p, role in found.items() if role == "front_wheel_l" and p in twins)
    assert twins[twins[left]] == left
    said = session.mirrored({"kind": "role", "parts": {left: "rear_wheel_l"}, "mirror": True})
    assert said["parts"] == {left: "rear_wheel_l", twins[left]: "rear_wheel_r"}
    assert session.mirrored({"kind": "role", "parts": {left: None}})["parts"] == {left: None}


@pytest.mark.slow
def test_parts_keep_their_numbers_on_the_screen(open_studio: Callable[[], Session]) -> None:
    session = open_studio()
    scene = Scene(session.assembly)
    state = session.state  # what is worked out beside the page makes another one
    first = scene.machine(state)
    assert scene.machine(state) == first
    assert len(scene.shapes) > len(first)


def test_a_folder_without_a_machine(tmp_path: Path) -> None:
    for folder, says in ((tmp_path / "none", "no such folder"), (tmp_path, "No machine was built")):
        with pytest.raises(YellowironError) as caught:
            read_setup(folder)
        assert says in caught.value.message
    record = {"equipment_type": "excavator", "cad": str(tmp_path / "gone.step"), "specs": [], "data": [], "set": []}
    (tmp_path / "inputs.json").write_text(json.dumps(record))
    with pytest.raises(YellowironError, match="broken"):
        read_setup(tmp_path)
    (tmp_path / "inputs.json").write_text(json.dumps({**record, "config": ""}))
    with pytest.raises(YellowironError, match=r"gone\.step"):
        read_setup(tmp_path)
    (tmp_path / "gone.step").touch()
    assert read_setup(tmp_path) == Setup("excavator", tmp_path / "gone.step", tmp_path)


def test_values_as_a_person_writes_them() -> None:
    assert in_words(1.4, "m") == "1400 mm"
    assert in_words(0.7853981633974483, "rad") == "45 deg"
    assert in_words(3.5e7, "Pa") == "35 MPa"
    assert in_words(0.5, "1") == "0.5"


@pytest.mark.slow
def test_a_folder_that_has_a_types_name_is_not_taken_for_a_template(
    cad_read_once: None,
    kept_stages: None,
    no_pages: None,
    example: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Machines are often built into a folder of their type's name."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wheel_loader").mkdir()
    with without_usd():
        build("wheel_loader", example / "wheel_loader.step", "out")
    assert read_setup(Path("out")).equipment_type == "wheel_loader"
