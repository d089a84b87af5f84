"""The lint: one defect a file, and mobility on machines whose freedom is known."""

from __future__ import annotations

import importlib
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from yellowiron import library
from yellowiron.model.template import Template, choose

DATA = Path(__file__).resolve().parent.parent / "data" / "templates"
FIG_A1 = DATA / "fig_a1_joints_template_cat982m.json"
DEFECTS = sorted(p for p in (DATA / "lint").iterdir() if p.name.startswith("TPL"))


@pytest.fixture(scope="module")
def loader() -> Template:
    return library.load_template("wheel_loader")


def test_wheel_loader_moves_as_expected_in_every_variant(loader: Template) -> None:
    report = library.lint(loader)
    assert report.findings == ()
    assert [tuple(m.choices.values()) for m in report.mobility] == [
        (lift, *tilt, wheels)
        for lift in ("twin", "single")
        for tilt in (("z_bar", "single"), ("direct", "single"), ("parallel", "single"), ("parallel", "twin"))
        for wheels in ("all", "rear", "none")
        if lift == "twin" or tilt[0] != "parallel"
    ]
    for mobility in report.mobility:
        assert mobility.computed == mobility.expected == mobility.planar == 8
        # A linkage from the frame moves with the arms; a cylinder between arms and bucket makes a loop of its own.
        groups = [(1, 1, 1)] * 3 if mobility.choices["tilt_linkage"] == "direct" else [(1, 1, 1), (2, 2, 2)]
        assert [(g.grubler, g.computed, g.expected) for g in mobility.groups] == groups
        assert not any(g.undetermined for g in mobility.groups)
    assert report.mobility[0].spatial == 8 - 3 * report.counts["loops"]


def test_counts_of_the_wheel_loader(loader: Template) -> None:
    assert library.lint(loader).counts == {
        "bodies": 21, "revolute": 21, "prismatic": 5, "fixed": 0, "spherical": 0, "distance": 0,
        "linear_drives": 5, "angular_drives": 4, "loops": 6,
    }  # fmt: skip
    single = library.lint(choose(loader, {"lift_cylinders": "single", "wheel_drive": "none"})).counts
    assert (single["bodies"], single["prismatic"], single["angular_drives"], single["loops"]) == (19, 4, 0, 5)


def test_fig_a1_counts() -> None:
    counts = library.lint(library.load_template(FIG_A1)).counts
    assert (counts["revolute"], counts["prismatic"]) == (14, 4)
    assert (counts["angular_drives"], counts["linear_drives"]) == (1, 4)


def test_fig_a1_steering_is_locked_and_the_pivots_named() -> None:
    report = library.lint(library.load_template(FIG_A1))
    (mobility,) = report.mobility
    steering, working = mobility.groups
    assert (steering.grubler, steering.computed, steering.expected) == (-1, 0, 1)
    assert (working.grubler, working.computed, working.expected) == (2, 2, 2)
    (error,) = (f for f in report.findings if f.severity == "error")
    assert error.code == "TPL002"
    assert "steering is locked (planar mobility -1" in error.message
    for side in "lr":
        assert f"from 'rear_frame' to 'steering_cylinder_barrel_{side}'" in error.message
        assert f"rear_frame2steering_cylinder_barrel_{side}_joint" in error.hint


@pytest.mark.parametrize("file", DEFECTS, ids=lambda p: p.stem)
def test_lint_defect(file: Path, tmp_path: Path) -> None:
    code, document = file.name.split(".")[:2]
    folder = tmp_path / "lifter"
    shutil.copytree(DATA / "sound", folder)
    shutil.copyfile(file, folder / f"{document}.json")
    if code == "TPL008":
        shutil.copyfile(DATA / "lint" / "variants.json", folder / "variants.json")
    found = {f.code: f for f in library.lint(library.load_template(folder)).findings}
    assert code in found, found
    assert found[code].message.endswith(".")
    assert found[code].where


def test_every_code_is_documented_and_tested(root: Path) -> None:
    source = "".join(p.read_text(encoding="utf-8") for p in (root / "src/yellowiron/library").rglob("*.py"))
    documented = (root / "docs/template-format.md").read_text(encoding="utf-8")
    codes = {f"{family}{number:03d}" for family in ("TPL", "DOC") for number in range(1, 40)}
    used = {code for code in codes if f'"{code}"' in source}
    assert used == {code for code in codes if f"`{code}`" in documented}
    assert {c for c in used if c.startswith("TPL")} == {p.name.split(".")[0] for p in DEFECTS} | {
        "TPL015",
        "TPL016",
        "TPL018",
        "TPL021",
        "TPL022",
        "TPL023",
    }


def test_too_many_choices_are_said_to_be_unchecked(loader: Template, monkeypatch: pytest.MonkeyPatch) -> None:
    # The package's `lint` is the function; its module is found by name.
    monkeypatch.setattr(importlib.import_module("yellowiron.library.linting.lint"), "MOST_COMBINATIONS", 4)
    report = library.lint(loader)
    assert len(report.mobility) == 4
    assert [f.code for f in report.findings] == ["TPL015"]


def test_a_driven_joint_without_actuator_is_found(loader: Template) -> None:
    without = replace(
        loader,
        actuators=tuple(a for a in loader.actuators if a.name != "bucket"),
        measurements=(),
        sensors=(),
        tests=(),
    )
    found = [f for f in library.lint(without).findings if f.code == "TPL007"]
    assert [f.where for f in found] == [
        f"bucket_piston_rod{side}2bucket_cylinder_barrel{side}_joint" for side in ("", "_l", "_r")
    ]


def test_exchanged_pivots_of_a_cylinder_are_found(loader: Template) -> None:
    crossed = tuple(
        replace(a, cylinders=tuple(replace(c, barrel_joint=c.rod_joint, rod_joint=c.barrel_joint) for c in a.cylinders))
        if a.name == "bucket"
        else a
        for a in loader.actuators
    )
    found = library.lint(replace(loader, actuators=crossed)).findings
    assert {(f.code, f.severity, f.where) for f in found} == {("TPL006", "error", "bucket")}
    assert "Exchange barrel_joint and rod_joint." in {f.hint for f in found}


def test_drives_that_hold_each_other_are_found(loader: Template) -> None:
    """Both lift cylinders driven and the tilt cylinder not: the count is right, and the bucket hangs loose."""
    template = choose(loader, {"lift_cylinders": "twin"})
    both = tuple(
        replace(a, cylinders=tuple(replace(c, passive=False) for c in a.cylinders)) if a.name == "boom" else a
        for a in template.actuators
        if a.name != "bucket"
    )
    idle = tuple(
        replace(j, drive=None) if j.name == "bucket_piston_rod2bucket_cylinder_barrel_joint" else j
        for j in template.joints
    )
    report = library.lint(replace(template, actuators=both, joints=idle, measurements=(), sensors=(), tests=()))
    (working,) = report.mobility[0].groups[1:]
    assert (working.computed, working.expected, working.undetermined) == (2, 2, 1)
    assert [f.code for f in report.findings] == ["TPL016"]


def test_removing_any_pivot_of_a_loop_is_found(loader: Template) -> None:
    """The count changes whichever joint is gone, and the lint says so."""
    resolved = choose(loader, {})
    loops = {name for group in library.lint(resolved).mobility[0].groups for name in group.joints}
    for name in sorted(loops):
        without = replace(
            resolved,
            joints=tuple(j for j in resolved.joints if j.name != name),
            actuators=tuple(
                replace(a, cylinders=tuple(c for c in a.cylinders if name not in vars(c).values()))
                for a in resolved.actuators
            ),
        )
        assert not library.lint(without).sound, name
