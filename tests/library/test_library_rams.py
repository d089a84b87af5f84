"""Cylinders without pins, in templates: what they say, and what the lint says of them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from kit.machines import rams
from yellowiron import library
from yellowiron.model.finding import Finding
from yellowiron.model.template import CylinderTemplate, Template


@pytest.fixture
def template(tmp_path: Path) -> Template:
    return library.load_template(rams.write(tmp_path)[0])


def with_lift(template: Template, **changes: Any) -> Template:
    """The template with its lift's cylinder changed."""
    lift, *others = template.actuators
    return replace(template, actuators=(replace(lift, cylinders=(replace(lift.cylinders[0], **changes),)), *others))


def found(template: Template) -> list[Finding]:
    return [f for f in library.lint(template).findings if f.severity != "info"]


def test_rams_are_found_in_any_spelling(tmp_path: Path) -> None:
    folder = rams.write(tmp_path)[0]
    document = json.loads((folder / "actuators.json").read_text())
    document["lift"]["cylinders"][0]["rams"] = [["Lift Cylinder Barrel L", "LIFT-PISTON-ROD-L"]]
    (folder / "actuators.json").write_text(json.dumps(document))
    lift, shift, _ = library.load_template(folder).actuators
    assert lift.cylinders == (CylinderTemplate("lift_joint", rams=(("lift_cylinder_barrel_l", "lift_piston_rod_l"),)),)
    assert (lift.cylinders[0].pins, lift.cylinders[0].joints) == ((), ("lift_joint",))
    assert shift.cylinders[0].rod_through and not lift.cylinders[0].rod_through


def test_a_machine_of_rams_is_sound(template: Template) -> None:
    report = library.lint(template)
    (mobility,) = report.mobility
    assert (mobility.computed, mobility.expected) == (3, 3)
    # No sheet is asked for the lift's stroke, and the two other slides end where their pistons do.
    assert {(f.code, f.severity) for f in report.findings} <= {("TPL004", "info"), ("TPL010", "warning")}


def test_a_ram_is_between_the_slide_s_bodies(template: Template) -> None:
    (finding,) = (f for f in found(with_lift(template, rams=(("lift_cylinder_barrel_l", "jack_piston_rod"),)))
                  if f.code == "TPL006")  # fmt: skip
    assert (finding.severity, finding.where) == ("error", "lift")
    assert "not between 'cart' and 'table'" in finding.message


def test_nothing_else_moves_a_passive_ram(template: Template) -> None:
    codes = {(f.code, f.where) for f in found(with_lift(template, passive=True))}
    assert ("TPL006", "lift") in codes


def test_one_slide_is_one_cylinder_s(template: Template) -> None:
    lift, *others = template.actuators
    (one,) = lift.cylinders
    halves = (replace(one, rams=one.rams[:1]), replace(one, rams=one.rams[1:]))
    doubled = replace(template, actuators=(replace(lift, cylinders=halves), *others))
    messages = {f.message for f in found(doubled) if f.code == "TPL006"}
    assert messages == {"Two cylinders have the slide 'lift_joint'."}


def test_a_ram_that_a_choice_leaves_out_is_told(tmp_path: Path) -> None:
    folder = rams.write(tmp_path)[0]
    hierarchy = (folder / "hierarchy.json").read_text()
    half = '"lift_cylinder_barrel_r": {'
    assert half in hierarchy
    (folder / "hierarchy.json").write_text(hierarchy.replace(half, half + '"when": {"rams": "twin"}, '))
    variants = {"rams": {"choices": ["twin", "single"], "default": "twin"}}
    (folder / "variants.json").write_text(json.dumps(variants))
    told = [f for f in library.lint(library.load_template(folder)).findings if f.code == "TPL008"]
    assert [(f.where, "'lift_cylinder_barrel_r'" in f.message) for f in told] == [("lift", True)]
