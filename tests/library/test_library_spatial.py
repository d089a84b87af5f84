"""The lint of linkages in space: mobility by the six-dimensional rank, idle spins, what holds too much."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from yellowiron import library
from yellowiron.library.linting.lint import LintReport

Joints = dict[str, dict[str, Any]]


def linted(folder: Path, root: str, bodies: list[str], joints: Joints) -> LintReport:
    """A template of these bodies and joints, each driven joint an actuator of its own."""
    entries = {b: {"rigid body": "Y", **({"side": b[-1]} if b[-2:] in ("_l", "_r") else {})} for b in bodies}
    folder = folder / "machine"
    folder.mkdir()
    (folder / "hierarchy.json").write_text(json.dumps({root: {"rigid body": "Y", "child": entries}}), encoding="utf-8")
    (folder / "joints.json").write_text(json.dumps(joints), encoding="utf-8")
    actuators = {
        n: {"kind": "cylinder", "cylinders": [{"slide": n, "barrel_joint": f"{n}_foot", "rod_joint": f"{n}_eye"}]}
        for n, entry in joints.items()
        if "Linear Drive" in entry.get("Drive", ())
    }
    if actuators:
        (folder / "actuators.json").write_text(json.dumps(actuators), encoding="utf-8")
    return library.lint(library.load_template(folder))


def joint(kind: str, one: str, other: str, **more: Any) -> dict[str, Any]:
    return {"joint_type": kind, "Body": [one, other], **more}


def ram(name: str, one: str, other: str, *, driven: bool = True) -> Joints:
    """A cylinder between balls."""
    drive = {"Drive": ["Linear Drive"]} if driven else {}
    return {
        f"{name}_foot": joint("Spherical", one, f"{name}_barrel"),
        name: joint("Prismatic", f"{name}_barrel", f"{name}_rod", Limit=[0, 1], **drive),
        f"{name}_eye": joint("Spherical", f"{name}_rod", other),
    }


def halves(*rams: str) -> list[str]:
    return [f"{name}_{half}" for name in rams for half in ("barrel", "rod")]


def six_way() -> tuple[list[str], Joints]:
    """A PAT dozer's blade (TYPES: three freedoms beside the idle spins)."""
    joints = {
        "pivot": joint("Revolute", "main", "c_frame", direction="Lateral"),
        "ball": joint("Spherical", "c_frame", "blade"),
        "link_foot": joint("Spherical", "c_frame", "link"),
        "link_eye": joint("Spherical", "link", "blade"),
        **ram("lift_l", "main", "c_frame"),
        **ram("lift_r", "main", "c_frame", driven=False),
        **ram("tilt", "c_frame", "blade"),
        **ram("angle_l", "c_frame", "blade"),
        **ram("angle_r", "c_frame", "blade", driven=False),
    }
    return ["c_frame", "blade", "link", *halves("lift_l", "lift_r", "tilt", "angle_l", "angle_r")], joints


def test_a_six_way_blade_lifts_tilts_and_angles(tmp_path: Path) -> None:
    report = linted(tmp_path, "main", *six_way())
    (mobility,) = report.mobility
    assert (mobility.computed, mobility.expected, mobility.spatial) == (3, 3, 9)
    lift, blade = mobility.groups
    assert (lift.computed, lift.expected, lift.undetermined, lift.grubler, len(lift.idle)) == (1, 1, 0, 1, 2)
    assert (blade.computed, blade.expected, blade.undetermined, blade.grubler, len(blade.idle)) == (2, 2, 0, 2, 4)
    said = [f.message for f in report.findings if f.code == "TPL022"]
    assert len(said) == 2
    assert "link, tilt_barrel with tilt_rod, angle_l_barrel with angle_l_rod" in said[1]
    assert report.sound


def test_both_angle_cylinders_driven_hold_each_other(tmp_path: Path) -> None:
    bodies, joints = six_way()
    joints["angle_r"]["Drive"] = ["Linear Drive"]
    (error,) = (f for f in linted(tmp_path, "main", bodies, joints).findings if f.severity == "error")
    assert error.code == "TPL002"
    assert "spatial mobility 2, 3 expected" in error.message


def test_a_drawbar_has_three_cylinders(tmp_path: Path) -> None:
    joints = {
        "nose": joint("Spherical", "main", "drawbar"),
        **ram("lift_l", "main", "drawbar"),
        **ram("lift_r", "main", "drawbar"),
        **ram("shift", "main", "drawbar"),
    }
    report = linted(tmp_path, "main", ["drawbar", *halves("lift_l", "lift_r", "shift")], joints)
    (group,) = report.mobility[0].groups
    assert (group.computed, group.expected, group.undetermined, len(group.idle)) == (3, 3, 0, 3)


@pytest.mark.parametrize(("end", "computed"), [("Spherical", 0), ("Distance", 1)])
def test_what_an_equaliser_bar_locks_is_named(tmp_path: Path, end: str, computed: int) -> None:
    joints = {
        "frame_l2main": joint("Revolute", "main", "frame_l", direction="Lateral", free="Y"),
        "frame_r2main": joint("Revolute", "main", "frame_r", direction="Lateral"),
        "bar2main": joint("Revolute", "main", "bar", direction="Lengthwise"),
        "bar2frame_l": joint(end, "bar", "frame_l"),
        "bar2frame_r": joint(end, "bar", "frame_r"),
    }
    report = linted(tmp_path, "main", ["frame_l", "frame_r", "bar"], joints)
    assert report.mobility[0].computed == computed
    errors = [f for f in report.findings if f.severity == "error"]
    if end == "Distance":
        assert errors == []
    else:
        assert [f.code for f in errors] == ["TPL002"]
        assert "bar2frame_l Distance and bar2frame_r Distance" in errors[0].hint


def test_of_two_pivots_in_line_one_would_do(tmp_path: Path) -> None:
    """An arm on two pins, left and right, pushed by a cylinder between balls."""
    bodies = {"arm": {"rigid body": "Y", "child": {f"pin_{s}": {"kind": "pin", "side": s} for s in "lr"}}}
    bodies |= {half: {"rigid body": "Y"} for half in halves("lift")}
    folder = tmp_path / "machine"
    folder.mkdir()
    tree = {"main": {"rigid body": "Y", "child": bodies}}
    (folder / "hierarchy.json").write_text(json.dumps(tree), encoding="utf-8")
    pins = {f"arm_{s}": joint("Revolute", "main", f"pin_{s}", direction="Lateral") for s in "lr"}
    (folder / "joints.json").write_text(json.dumps({**pins, **ram("lift", "main", "arm")}), encoding="utf-8")
    report = library.lint(library.load_template(folder))
    (group,) = report.mobility[0].groups
    assert (group.computed, group.expected, group.grubler) == (1, 1, -4)
    (finding,) = (f for f in report.findings if f.code == "TPL023")
    assert "held 5 times more than it needs" in finding.message
    assert finding.hint == "One of these may be freer: arm_l (none would do); arm_r (none would do)."


def test_a_hook_on_a_free_ball_counts_as_it_is(tmp_path: Path) -> None:
    joints = {
        "boom2main": joint("Revolute", "main", "boom", Drive=["Angular Drive"]),
        "hook2boom": joint("Spherical", "boom", "hook", free="Y"),
    }
    report = linted(tmp_path, "main", ["boom", "hook"], joints)
    assert (report.mobility[0].computed, report.mobility[0].expected) == (4, 4)
    assert report.sound


def test_a_direction_is_read_and_written(tmp_path: Path) -> None:
    linted(tmp_path, "main", *six_way())
    template = library.load_template(tmp_path / "machine")
    assert template.joint("pivot").direction == "lateral"
    assert template.joint("ball").direction is None
