"""The whole machine on the page: its front, its variant, what is not drawn; asked where that is in doubt, and kept."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from yellowiron.alignment import named_direction
from yellowiron.library import load_template
from yellowiron.model.errors import YellowironError
from yellowiron.model.template import choose
from yellowiron.opinion.doubts import boxes_of
from yellowiron.studio import Session
from yellowiron.studio.machine import all_of, together, ways_of
from yellowiron.studio.operations import words
from yellowiron.studio.questions import questions


@pytest.mark.slow
def test_the_whole_machine_is_said_and_taken_back(open_studio: Callable[..., Session]) -> None:
    studio = open_studio()
    before = np.asarray(studio.settled(120).aligned.frame)[0, :3]
    parts = {p.part: p.body for p in studio.state.aligned.parts}
    front = named_direction(-before)
    studio.do(studio.read({"kind": "machine", "name": "forward", "text": front}))
    turned = studio.settled(120)
    assert np.allclose(np.asarray(turned.aligned.frame)[0, :3], -before, atol=1e-6)
    assert any("forward" in remark.lower() for remark in turned.remarks)  # the arms speak against it
    studio.keep()
    kept = json.loads((studio.setup.out / "alignment.json").read_text(encoding="utf-8"))
    assert kept["machine"] == {"forward": {"value": front, "by": "Ann"}}

    # It holds for the next one who opens the folder, and is undone there.
    again = open_studio()
    assert np.allclose(np.asarray(again.settled(120).aligned.frame)[0, :3], -before, atol=1e-6)
    assert [words(o) for o in again.history()[0]] == [f"Forward is {front} of the CAD file"]
    again.undo()
    assert np.allclose(np.asarray(again.settled(120).aligned.frame)[0, :3], before, atol=1e-6)
    assert {p.part: p.body for p in again.state.aligned.parts} == parts
    assert again.state.aligned.machine == {}


@pytest.mark.slow
def test_a_variant_and_what_is_not_drawn(open_studio: Callable[..., Session]) -> None:
    studio = open_studio()
    studio.do(studio.read({"kind": "machine", "name": "lift_cylinders", "text": "single"}))
    assert studio.settled(120).aligned.choices["lift_cylinders"] == "single"
    studio.do(studio.read({"kind": "machine", "name": "lift_cylinders", "text": ""}))
    assert studio.settled(120).aligned.choices["lift_cylinders"] == "twin"
    studio.do(studio.read({"kind": "machine", "name": "*_pin", "text": "absent"}))
    state = studio.settled(120)
    assert not [r for r in state.template.roles if r.kind == "pin"]
    answers = {one.answer for one in all_of(state, studio.template)}
    assert {"*_pin=", "lift_cylinders=single", "bucket=absent"} <= answers


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "text"), [("", "x"), ("forward", "ahead"), ("wing", "absent"), ("bucket", "gone"), ("forward", "x" * 300)]
)
def test_what_means_nothing_of_a_machine_is_refused(untouched: Session, name: str, text: str) -> None:
    with pytest.raises(YellowironError):
        untouched.do(untouched.read({"kind": "machine", "name": name, "text": text}))
    assert untouched.history() == ([], 0)


def test_it_is_asked_before_any_part(untouched: Session) -> None:
    state, boxes = untouched.settled(120), boxes_of(untouched.assembly)
    assert not [q for q in questions(state, boxes) if q.kind == "machine"]  # of a machine that was found, nothing
    doubted = replace(
        state.aligned, facing_doubt="forward is guessed", open_choices={"lift_cylinders": ("single",)},
        missing=("bucket", "boom_cylinder_barrel_l", "boom_piston_rod_l"),
    )  # fmt: skip
    asked = questions(replace(state, aligned=doubted, alignment=doubted), boxes)
    front, variant, *others = asked
    assert (front.key, front.reason) == ("machine:forward", "Forward is guessed")
    ahead = np.asarray(state.aligned.frame)[0, :3]
    assert front.yes == f"forward={named_direction(ahead)}"
    assert front.candidates[0].answer == f"forward={named_direction(-ahead)}"
    assert len({front.yes, *(one.answer for one in ways_of(state))}) == 7
    assert (variant.title, variant.yes) == ("Lift cylinders: twin?", "lift_cylinders=twin")
    assert [one.answer for one in variant.candidates] == ["lift_cylinders=single"]
    # A cylinder is one question; that it is not drawn one answer.
    absent = {q.absent for q in others if q.kind == "role"}
    assert absent == {"bucket", "boom_cylinder_barrel_l,boom_piston_rod_l"}


def test_little_doubts_of_a_body_and_its_twin_are_one_question(untouched: Session) -> None:
    state, boxes = untouched.settled(120), boxes_of(untouched.assembly)
    rods = [p for p in state.alignment.parts if p.body in ("boom_piston_rod_l", "boom_piston_rod_r")]
    sure = {p.part: replace(p, confidence=0.99) for p in rods}
    doubted = replace(
        state.alignment, parts=tuple(sure.get(p.part, p) for p in state.alignment.parts), to_review=tuple(sure)
    )
    (asked,) = (q for q in questions(replace(state, alignment=doubted), boxes) if q.kind == "parts")
    assert asked.title == f"Boom piston rod, left and right, {len(rods)} parts?"
    assert set(asked.parts) == set(sure)
    assert not [c for c in asked.candidates if c.answer.endswith(("_l", "_r"))]


def test_missing_roles_that_go_together() -> None:
    excavator = choose(load_template("excavator"), {})
    pins = [r.name for r in excavator.roles if r.kind == "pin"]
    assert together(pins, excavator) == [pins]
    assert together(pins[:2], excavator) == [[pins[0]], [pins[1]]]
    wheels = ["front_wheel_l", "rear_wheel_r", "front_wheel_r", "boom"]
    loader = choose(load_template("wheel_loader"), {})
    assert together(wheels, loader) == [["front_wheel_l", "front_wheel_r"], ["rear_wheel_r"], ["boom"]]
