"""Counted rows: read, linted, made concrete, shown."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from kit.machines.tracked_template import tracked_documents, write_tracked_template
from yellowiron.library import filled_joints, lint, load_template, tree
from yellowiron.model.errors import TemplateError
from yellowiron.model.rows import count_members, expand, rings
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose

ROWS = {"track_shoe": 49, "track_roller": 9, "carrier_roller": 2}
COUNTS = {f"{row}_{side}": n for row, n in ROWS.items() for side in "lr"}
UNDER: dict[str, Any] = {"undercarriage": {"child": {"track_shoe_l[*]": {"child": {"grouser": {}}}}}}


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Template:
    return load_template(write_tracked_template(tmp_path_factory.mktemp("crawler")))


def test_sound_under_every_choice(template: Template) -> None:
    report = lint(template)
    assert report.sound, report.findings
    assert [(m.choices["tracks"], m.computed, m.expected) for m in report.mobility] == [
        ("belt", 7, 7),  # the swing and three wheels a side
        ("shoes", 13, 13),  # the swing, sprockets, idlers and two parts of each row of rollers
        ("fixed", 1, 1),
    ]
    assert "TPL014" in {f.code for f in report.findings}


def test_shoes(template: Template) -> None:
    shoes = expand(choose(template, {"tracks": "shoes"}), COUNTS)
    joints = [j for j in shoes.joints if j.ring]
    assert len(joints) == 98
    assert joints[0].name == "track_shoe_l2track_shoe_l_joint_1"
    assert joints[0].parts == ("track_shoe_l_1", "track_shoe_l_2")
    assert joints[48].parts == ("track_shoe_l_49", "track_shoe_l_1")
    assert sum(j.type == "revolute" for j in shoes.joints) == 1 + 4 + 2 * (49 + 9 + 2)
    assert shoes.role("track_roller_r_9").row == "track_roller_r"
    assert shoes.body_of("track_roller_r_9") == "track_roller_r_9"
    assert not any(r.many for r in shoes.roles)
    travel = {a.name: a.joints for a in shoes.actuators}
    assert travel["travel_left"] == ("undercarriage2sprocket_l_joint",)


def test_belt(template: Template) -> None:
    chosen = choose(template, {})
    assert rings(chosen) == ()
    belt = expand(chosen, COUNTS)
    assert belt.body_of("track_shoe_l_7") == "undercarriage"
    assert {a.name: len(a.joints) for a in belt.actuators} == {"swing": 1, "travel_left": 3, "travel_right": 3}
    assert [r.name for r in belt.roles if r.rigid][:3] == ["undercarriage", "track_wheel_l_1", "track_wheel_l_2"]


def test_fixed_has_no_travel(template: Template) -> None:
    fixed = expand(choose(template, {"tracks": "fixed"}), COUNTS)
    assert [r.name for r in fixed.roles if r.rigid] == ["undercarriage", "upper"]
    assert [a.name for a in fixed.actuators] == ["swing"]


def test_a_row_without_parts_goes_with_its_joints(template: Template) -> None:
    none = expand(choose(template, {"tracks": "shoes"}), {})
    assert [j.name for j in none.joints if "roller" in j.name or "shoe" in j.name] == []


def test_a_row_on_the_parts_of_a_row_has_them_though_nothing_else_of_them_is_drawn() -> None:
    # A public dump truck of three axles: the tyres of the third are drawn, and of its wheels nothing else.
    truck = expand(choose(load_template("rigid_dump_truck"), {}), {"further_tyre_l": 2})
    assert [truck.body_of(f"further_tyre_l_{n}") for n in (1, 2)] == ["further_wheel_l_1", "further_wheel_l_2"]


def test_open_rows_have_one_joint_less(tmp_path: Path) -> None:
    (tmp_path / "hierarchy.json").write_text(
        json.dumps({"base": {"rigid body": "Y"}, "link[*]": {"rigid body": "Y"}}), encoding="utf-8"
    )
    along = {"joint_type": "Revolute", "Body": ["link[i]", "link[i+1]"], "free": "Y"}
    first = {"joint_type": "Fixed", "Body": ["base", "link[i]"]}
    (tmp_path / "joints.json").write_text(json.dumps({"chain": along, "first[i]": first}), encoding="utf-8")
    chain = expand(load_template(tmp_path), {"link": 4})
    assert [j.name for j in chain.joints] == ["chain_1", "chain_2", "chain_3", *(f"first_{i}" for i in range(1, 5))]
    assert [j.parts for j in chain.joints[:3]] == [(f"link_{i}", f"link_{i + 1}") for i in range(1, 4)]


def test_members_are_known_before_they_are_counted(template: Template) -> None:
    assert template.row_of("track_shoe_l_12") == "track_shoe_l"
    assert template.row_of("sprocket_l") is None
    assert template.knows("track_roller_r_3")
    assert not template.knows("track_roller_x_3")
    assert template.body_of("track_shoe_l_12") == "track_shoe_l_12"
    assert count_members(["track_shoe_l_2", "track_shoe_l_11", "upper", None], template) == {"track_shoe_l": 11}


def test_filled_joints_keep_the_rows(template: Template) -> None:
    filled = filled_joints(choose(template, {"tracks": "shoes"}), None, Specifications())
    assert filled["track_shoe_l2track_shoe_l_joint[i]"]["ring"] == "Y"


def test_shown(template: Template) -> None:
    console = Console(file=io.StringIO(), width=200)
    console.print(tree(template))
    text = console.file.getvalue()  # type: ignore[attr-defined]
    assert "track_shoe_l[*]" in text
    assert "closed to a ring" in text
    assert "hidden, for track_shoe_l" in text


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"hierarchy": {"crawler": {"child": UNDER}}}, "is no row"),
        ({"joints": {"undercarriage2sprocket_l_joint": {"ring": "Y"}}}, "closes a ring"),
        ({"hierarchy": {"crawler": {"child": {"upper": {"hidden": {"row": "upper", "at": [0]}}}}}}, "hidden rule"),
    ],
)  # fmt: skip
def test_what_does_not_fit(tmp_path: Path, change: dict[str, object], words: str) -> None:
    documents = tracked_documents()

    def merge(into: dict[str, object], what: dict[str, object]) -> None:
        for key, value in what.items():
            inner = into.get(key)
            if isinstance(inner, dict) and isinstance(value, dict):
                merge(inner, value)
            else:
                into[key] = value

    merge(documents, change)
    for name, document in documents.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(TemplateError, match=words):
        load_template(tmp_path)
