"""Joints that follow others, in templates: what they say, how they are counted, what the lint says."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kit.machines import mast
from yellowiron import library
from yellowiron.library.show import tree
from yellowiron.mechanism import at_known_places
from yellowiron.model.errors import MechanismError, TemplateError
from yellowiron.model.specification import Specification, Specifications, share_of
from yellowiron.model.template import (
    ActuatorTemplate,
    Follows,
    JointTemplate,
    Role,
    Template,
    by_first_leader,
    choose,
    in_position,
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return mast.write(tmp_path)[0]


def changed(folder: Path, name: str, **follows: Any) -> Template:
    document = json.loads((folder / "joints.json").read_text())
    document[name]["follows"].update(follows)
    (folder / "joints.json").write_text(json.dumps(document))
    return library.load_template(folder)


def test_leaders_are_found_in_any_spelling(folder: Path) -> None:
    template = changed(folder, "inner_joint", joint="Middle Joint", ratio=-2, offset="5 mm", kind="rope")
    assert template.joint("inner_joint").follows == Follows("middle_joint", -2.0, 0.005, "rope")
    assert template.joint("carriage_joint").follows == Follows("inner_joint")
    assert template.joint("middle_joint").follows is None


def test_a_pivot_s_offset_is_in_degrees(tmp_path: Path) -> None:
    joints = {
        "a2b_joint": {"joint_type": "Revolute", "Body": ["a", "b"], "Drive": ["Angular Drive"]},
        "a2c_joint": {
            "joint_type": "Revolute",
            "Body": ["a", "c"],
            "follows": {"joint": "a2b_joint", "offset": 90, "kind": "gear"},
        },
    }
    bodies = {name: {"rigid body": "Y", "child": {}} for name in "abc"}
    (tmp_path / "hierarchy.json").write_text(json.dumps({"pair": {"rigid body": "N", "child": bodies}}))
    (tmp_path / "joints.json").write_text(json.dumps(joints))
    follows = library.load_template(tmp_path).joint("a2c_joint").follows
    assert follows is not None and follows.offset == pytest.approx(math.pi / 2)


def test_followers_are_no_freedom_of_their_own(folder: Path) -> None:
    report = library.lint(library.load_template(folder))
    (mobility,) = report.mobility
    assert (mobility.computed, mobility.expected, mobility.planar, mobility.spatial) == (1, 1, 1, 1)
    # The lift's slide turns at neither end: it is no cylinder's, and driven for itself.
    assert [(f.code, f.severity, f.where) for f in report.findings] == [("TPL007", "warning", "middle_joint")]


def test_a_section_that_tilts_is_no_barrel(folder: Path) -> None:
    """The outer section turns on a truck: the lift's slide is still driven for itself, and not as half a cylinder."""
    hierarchy = json.loads((folder / "hierarchy.json").read_text())
    hierarchy["mast"]["child"] = {"truck": {"rigid body": "Y", "child": {}}, **hierarchy["mast"]["child"]}
    (folder / "hierarchy.json").write_text(json.dumps(hierarchy))
    document = json.loads((folder / "joints.json").read_text())
    document["tilt_joint"] = {"joint_type": "Revolute", "Body": ["truck", "outer"], "Drive": ["Angular Drive"]}
    (folder / "joints.json").write_text(json.dumps(document))
    template = library.load_template(folder)
    assert [(a.name, a.kind, a.joints) for a in template.actuators] == [("tilt", "motor", ("tilt_joint",))]
    (mobility,) = library.lint(template).mobility
    assert (mobility.computed, mobility.expected) == (2, 2)


def test_without_what_they_follow_they_are_loose(folder: Path) -> None:
    template = library.load_template(folder)
    loose = replace(template, joints=tuple(replace(j, follows=None) for j in template.joints))
    found = [f for f in library.lint(loose).findings if f.severity == "error"]
    assert [f.code for f in found] == ["TPL003"]
    assert "inner_joint, carriage_joint" in found[0].message


def four_bar(follows: str) -> Template:
    """A driven four-bar linkage, and a wheel on its frame that follows one of its pivots; or one of its own pivots
    follows another."""
    pairs = {"ab": ("a", "b"), "bc": ("b", "c"), "cd": ("c", "d"), "da": ("d", "a"), "aw": ("a", "w")}
    led = {"aw": Follows(follows, 2.0, kind="gear")} if follows != "self" else {"bc": Follows("da", 0.5, kind="gear")}
    joints = [JointTemplate(n, "revolute", p, follows=led.get(n)) for n, p in pairs.items()]
    joints = [replace(j, drive="angular") if j.name == "ab" else j for j in joints]
    if follows == "self":
        joints = [replace(j, free=True) if j.name == "aw" else j for j in joints]
    actuators = (ActuatorTemplate("turn", "motor", joints=("ab",)),)
    roles = tuple(Role(name, None if name == "a" else "a", True) for name in "abcdw")
    return Template("pair", "", "a", roles, tuple(joints), actuators=actuators)


def test_a_joint_may_follow_one_of_a_loop() -> None:
    (mobility,) = library.lint(four_bar("cd")).mobility
    assert (mobility.computed, mobility.expected, mobility.loose) == (1, 1, ())


def test_a_joint_of_a_loop_that_follows_another_locks_it() -> None:
    report = library.lint(four_bar("self"))
    (group,) = report.mobility[0].groups
    assert (group.grubler, group.computed, group.expected) == (0, 0, 1)
    assert "TPL002" in {f.code for f in report.findings}


def test_an_actuator_on_a_follower_is_an_error(folder: Path) -> None:
    template = library.load_template(folder)
    both = replace(template, actuators=(ActuatorTemplate("lift", "motor", joints=("middle_joint", "inner_joint")),))
    assert ("TPL021", "inner_joint") in {(f.code, f.where) for f in library.lint(both).findings}


def test_a_leader_that_a_choice_takes_away_is_an_error(folder: Path) -> None:
    document = json.loads((folder / "joints.json").read_text())
    document["middle_joint"]["when"] = {"stages": ["three"]}
    (folder / "joints.json").write_text(json.dumps(document))
    variants = {"stages": {"choices": ["two", "three"], "default": "three", "decided_by": "user"}}
    (folder / "variants.json").write_text(json.dumps(variants))
    found = [f for f in library.lint(library.load_template(folder)).findings if f.code == "TPL008"]
    assert [(f.where, "'middle_joint' that it follows" in f.message) for f in found] == [("inner_joint", True)]


def test_a_row_leads_nothing(tmp_path: Path) -> None:
    bodies = {"a": {"rigid body": "Y", "child": {}}, "w[*]": {"rigid body": "Y", "child": {}},
              "b": {"rigid body": "Y", "child": {}}}  # fmt: skip
    joints = {
        "w_joint[i]": {"joint_type": "Revolute", "Body": ["a", "w[i]"], "Drive": ["Angular Drive"]},
        "b_joint": {"joint_type": "Revolute", "Body": ["a", "b"], "follows": {"joint": "w_joint[i]"}},
    }
    (tmp_path / "hierarchy.json").write_text(json.dumps({"pair": {"rigid body": "N", "child": bodies}}))
    (tmp_path / "joints.json").write_text(json.dumps(joints))
    with pytest.raises(TemplateError, match="is a row of joints"):
        library.load_template(tmp_path)


def test_a_user_s_document_may_say_what_follows(folder: Path, tmp_path: Path) -> None:
    template = library.load_template(folder)
    file = tmp_path / "mine.json"
    file.write_text(json.dumps({"carriage_joint": {"follows": {"joint": "middle joint", "ratio": 2}}}))
    said = library.apply_joints(template, library.load_documents([file], template))
    assert said.joint("carriage_joint").follows == Follows("middle_joint", 2.0)
    file.write_text(json.dumps({"carriage_joint": {"follows": {"joint": "midle_joint"}}}))
    with pytest.raises(TemplateError, match="'midle_joint' that is not there") as caught:
        library.load_documents([file], template)
    assert caught.value.where.endswith("mine.json: carriage_joint.follows.joint")
    assert "middle_joint" in caught.value.hint


def test_the_filled_joints_load_as_they_were(folder: Path) -> None:
    template = changed(folder, "carriage_joint", ratio=0.5, offset=0.25)
    filled = library.filled_joints(template, None, Specifications())
    (folder / "joints.json").write_text(json.dumps(filled))
    again = library.load_template(folder)
    assert [j.follows for j in again.joints] == [j.follows for j in template.joints]


def test_show_says_what_follows(folder: Path) -> None:
    from rich.console import Console

    console = Console(width=200)
    with console.capture() as shown:
        console.print(tree(library.load_template(folder)))
    assert "follows middle_joint by chain, ratio 1" in shown.get()


def test_a_chain_of_leaders_as_one() -> None:
    every = {"b": Follows("a", 2.0, 1.0), "c": Follows("b", 3.0, 0.5, "rope")}
    assert by_first_leader("c", every) == Follows("a", 6.0, 3.5, "rope")
    assert by_first_leader("b", every) == every["b"]


@pytest.mark.parametrize(
    ("entry", "words"),
    [
        ({"joint_type": "Prismatic", "Drive": ["Linear Drive"]}, "held in positions, and moves"),
        ({"joint_type": "Spherical"}, "is spherical and has positions"),
        ({"joint_type": "Prismatic", "positions": {"drawn": 0}}, "the position that the CAD model shows"),
        ({"joint_type": "Prismatic", "positions": {"out": "3 deg"}}, "not a quantity of dimension length"),
    ],
)
def test_positions_that_cannot_be_are_said(tmp_path: Path, entry: dict[str, object], words: str) -> None:
    joint = {"positions": {"out": "1 m"}, **entry, "Body": ["base", "section"]}
    (tmp_path / "joints.json").write_text(json.dumps({"base2section_joint": joint}), encoding="utf-8")
    with pytest.raises(TemplateError, match=words) as found:
        library.load_template(tmp_path)
    assert "base2section_joint.positions" in str(found.value.where)


def test_a_position_may_be_a_share_of_a_sheet_s_value(tmp_path: Path) -> None:
    places = {"46": "46 % of Section Stroke", "out": "2 m"}
    joint = {"joint_type": "Prismatic", "Body": ["base", "section"], "positions": places}
    (tmp_path / "joints.json").write_text(json.dumps({"section_joint": joint}), encoding="utf-8")
    template = library.load_template(tmp_path)
    half = choose(template, {"section": "46"})
    assert half.joints[0].at == "46 % of Section Stroke" and share_of(half.joints[0].at) == (0.46, "Section Stroke")
    stroke = Specification("Section Stroke", 5.0, "m", "ok", "user")
    assert at_known_places(half, Specifications({stroke.name: stroke})).joints[0].at == pytest.approx(2.3)
    with pytest.raises(MechanismError, match="nothing says that"):
        at_known_places(half, Specifications())
    found = library.lint(template).findings
    assert ("TPL004", "section_joint") in {(f.code, f.where) for f in found} and "TPL010" not in {f.code for f in found}


def test_a_joint_in_positions_is_a_variant_of_its_name(tmp_path: Path) -> None:
    joint = {"joint_type": "Revolute", "Body": ["base", "jib"], "positions": {"raised": 20, "high": "40 deg"}}
    (tmp_path / "joints.json").write_text(json.dumps({"base2jib_joint": joint}), encoding="utf-8")
    template = library.load_template(tmp_path)
    places = {c: choose(template, {"base2jib": c}).joints[0].at for c in template.variants[0].choices}
    assert places == pytest.approx({"drawn": 0.0, "raised": math.radians(20.0), "high": math.radians(40.0)})
    welded = in_position(choose(template, {})).joints[0]
    assert (welded.type, welded.free) == ("fixed", False)
    (tmp_path / "variants.json").write_text('{"base2jib": {"choices": ["a", "b"], "default": "a"}}', encoding="utf-8")
    with pytest.raises(TemplateError, match="both called 'base2jib'"):
        library.load_template(tmp_path)
