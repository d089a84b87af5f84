"""Springs in templates: what a joint with a rest says, how it is counted, what the lint says."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from yellowiron import library
from yellowiron.library.show import tree
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import Template, choose

SPRING = {"stiffness": 2e5, "damping": 1e4, "rest": "drawn"}


def written(folder: Path, joint: dict[str, Any], **documents: Any) -> Template:
    bodies = {"frame": {"rigid body": "Y", "child": {"hub": {"rigid body": "Y"}}}}
    slide = {"joint_type": "Prismatic", "Body": ["frame", "hub"], "Limit": [-0.1, 0.1]}
    everything = {
        "hierarchy": {"cart": {"rigid body": "N", "child": bodies}},
        "joints": {"frame2hub_joint": {**slide, **joint}},
        **documents,
    }
    for name, content in everything.items():
        (folder / f"{name}.json").write_text(json.dumps(content))
    return library.load_template(folder)


def test_a_spring_moves_on_its_own(tmp_path: Path) -> None:
    template = written(tmp_path, SPRING)
    joint = template.joint("frame2hub_joint")
    assert (joint.free, joint.rest, joint.stiffness, joint.damping) == (True, "drawn", 2e5, 1e4)
    report = library.lint(template)
    assert (report.mobility[0].computed, report.mobility[0].expected) == (1, 1)
    assert "TPL017" not in {f.code for f in report.findings}
    shown = "\n".join(str(each.label) for each in tree(template).children[0].children)
    assert "spring of 200000 N/m and 10000 N*s/m, its rest drawn" in shown and "free" not in shown


@pytest.mark.parametrize(("rest", "expected"), [("Drawn", "drawn"), (-0.02, -0.02), ("20 mm", 0.02)])
def test_rests_are_said_in_any_unit(tmp_path: Path, rest: Any, expected: Any) -> None:
    assert written(tmp_path, {**SPRING, "rest": rest}).joint("frame2hub_joint").rest == expected


def test_a_pivot_s_rest_is_in_degrees(tmp_path: Path) -> None:
    turned = {"joint_type": "Revolute", "Limit": [-10, 10], **SPRING, "rest": 5}
    assert written(tmp_path, turned).joint("frame2hub_joint").rest == pytest.approx(math.radians(5.0))


@pytest.mark.parametrize(
    ("joint", "words"),
    [
        ({"rest": "drawn"}, "neither stiffness nor damping"),
        ({**SPRING, "Drive": ["Linear Drive"]}, "has a spring and Drive"),
        ({**SPRING, "joint_type": "Spherical", "Limit": [None, None]}, "has no spring"),
        ({**SPRING, "rest": "5 deg"}, "not a quantity of dimension length"),
        ({**SPRING, "rest_when": {"pads": "rubber"}}, "pads"),
    ],
)
def test_what_does_not_go_together_is_one_sentence(tmp_path: Path, joint: dict[str, Any], words: str) -> None:
    with pytest.raises(TemplateError, match=words) as raised:
        written(tmp_path, joint)
    assert "joints.json" in (raised.value.where or "") and raised.value.hint


def test_gains_without_drive_or_rest_are_told(tmp_path: Path) -> None:
    template = written(tmp_path, {"stiffness": 2e5, "free": "Y"})
    (finding,) = [f for f in library.lint(template).findings if f.code == "TPL017"]
    assert "rest" in finding.hint


def test_a_choice_has_the_spring_or_not(tmp_path: Path) -> None:
    pads = {"pads": {"choices": ["none", "rubber"], "default": "none", "decided_by": "user"}}
    template = written(tmp_path, {**SPRING, "rest_when": {"pads": "rubber"}}, variants=pads)
    without, sprung = (choose(template, {"pads": each}).joint("frame2hub_joint") for each in ("none", "rubber"))
    assert (without.rest, without.stiffness, without.damping, without.free) == (None, None, None, True)
    assert (sprung.rest, sprung.stiffness, sprung.damping, sprung.free) == ("drawn", 2e5, 1e4, True)


def test_the_filled_document_says_it_again(tmp_path: Path) -> None:
    from yellowiron.library.filled import _further

    joint = written(tmp_path, {**SPRING, "rest": 0.02}).joint("frame2hub_joint")
    assert _further(joint) == {"stiffness": 2e5, "damping": 1e4, "free": "Y", "rest": "0.02 m"}


def test_beams_of_a_bogie_have_pads_where_a_user_says_so() -> None:
    template = library.load_template("articulated_dump_truck")
    for pads, rest in (("free", None), ("rubber", "drawn")):
        beams = [choose(template, {"bogie_pads": pads}).joint(f"rear_frame2bogie_beam_{s}_joint") for s in "lr"]
        assert [(beam.free, beam.rest) for beam in beams] == [(True, rest)] * 2
