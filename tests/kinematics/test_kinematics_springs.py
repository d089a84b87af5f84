"""Where springs rest that hold a machine as drawn, against its statics by hand; what is written of them."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from pxr import Usd

from kit.machines import sprung
from yellowiron.checks import check
from yellowiron.exporters import Geometry, export_mjcf
from yellowiron.exporters.link_table import links_of
from yellowiron.exporters.ros.urdf import urdf_unsaid
from yellowiron.exporters.sdf.model import add_joint
from yellowiron.kinematics import complete
from yellowiron.model.mechanism import GRAVITY, Spring
from yellowiron.report.document import _joint_entry as joint_entry
from yellowiron.report.html.joints import joint_rows
from yellowiron.usd import read_mechanism

HELD = 1e-3
"""Newtons."""


def axle_load() -> float:
    """What the front wheels carry, by the moments about the rear ones."""
    mechanism, _ = sprung.make()
    middle = sum(b.mass * (b.center_of_mass[0] + 1.0) for b in mechanism.bodies)
    return float(GRAVITY * middle / 2.0)


def test_they_carry_what_stands_on_them() -> None:
    mechanism, _ = sprung.make()
    assert not [f for f in mechanism.findings if f.code == "KIN019"]
    assert mechanism.mobility is not None and mechanism.mobility.computed == mechanism.mobility.expected == 8
    unsprung = GRAVITY * (sprung.HUB + 120.0)
    for name in sprung.SPRINGS:
        spring = mechanism.joint(name).spring
        assert spring is not None
        # Positive is up: the spring pushes its hub down on the ground, and holds it up in the air.
        assert spring.rest * sprung.STIFFNESS == pytest.approx(unsprung - 0.5 * axle_load(), abs=HELD)
        assert spring.hanging * sprung.STIFFNESS == pytest.approx(unsprung, abs=HELD)


def test_a_rest_that_is_stated_stays() -> None:
    mechanism, _ = sprung.make(Spring(sprung.STIFFNESS, sprung.DAMPING, 0.01, 0.01))
    spring = mechanism.joint(sprung.SPRINGS[0]).spring
    assert spring == Spring(sprung.STIFFNESS, sprung.DAMPING, 0.01, 0.01)


def test_a_machine_in_the_air_is_told() -> None:
    mechanism, _ = sprung.make()
    up = np.array([0.0, 0.0, 1.0])
    raised = [replace(b, hull=np.asarray(b.hull) + up if len(b.hull) else b.hull) for b in mechanism.bodies]
    found = complete(replace(mechanism, bodies=tuple(raised), findings=()))
    assert [f.code for f in found.findings] == ["KIN019"] * 2
    spring = found.joint(sprung.SPRINGS[0]).spring
    assert spring is not None and spring.rest == spring.hanging


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sprung.write(tmp_path_factory.mktemp("sprung"))


def test_usd_has_a_rest_for_either_base(file: Path) -> None:
    mechanism, _ = sprung.make()
    again = read_mechanism(file)
    assert [j.spring for j in again.joints] == [j.spring for j in mechanism.joints]
    stage = Usd.Stage.Open(str(file))
    root = stage.GetDefaultPrim()
    prim = next(p for p in stage.Traverse() if p.GetName() == sprung.SPRINGS[0])
    spring = mechanism.joint(sprung.SPRINGS[0]).spring
    assert spring is not None
    for base, rest in (("floating", spring.rest), ("fixed", spring.hanging)):
        root.GetVariantSets().SetSelection("Base", base)
        assert prim.GetAttribute("drive:linear:physics:targetPosition").Get() == pytest.approx(rest, rel=1e-6)
        assert prim.GetAttribute("drive:linear:physics:stiffness").Get() == pytest.approx(sprung.STIFFNESS)
        assert prim.GetAttribute("drive:linear:physics:damping").Get() == pytest.approx(sprung.DAMPING)


def test_what_was_edited_is_read_and_told(file: Path, tmp_path: Path) -> None:
    edited = sprung.write(tmp_path)
    stage = Usd.Stage.Open(str(edited))
    prim = next(p for p in stage.Traverse() if p.GetName() == sprung.SPRINGS[0])
    prim.GetAttribute("drive:linear:physics:stiffness").Set(1e5)
    stage.Save()
    spring = read_mechanism(edited).joint(sprung.SPRINGS[0]).spring
    assert spring is not None and spring.stiffness == pytest.approx(1e5)
    codes = {name: [f.code for f in check(each)] for name, each in (("as built", file), ("edited", edited))}
    assert "CHK124" in codes["edited"] and "CHK124" not in codes["as built"]


@pytest.mark.parametrize("base", ["floating", "fixed"])
def test_mjcf_has_springs_on_its_joints(base: str, tmp_path: Path) -> None:
    mechanism, _ = sprung.make()
    spring = mechanism.joint(sprung.SPRINGS[0]).spring
    assert spring is not None
    top = ET.parse(export_mjcf(mechanism, Geometry(), tmp_path, base=base)).getroot()  # type: ignore[arg-type]
    made = next(j for j in top.iter("joint") if j.get("name") == sprung.SPRINGS[0])
    values = [float(made.get(key, "nan")) for key in ("stiffness", "damping", "springref")]
    assert values == pytest.approx([sprung.STIFFNESS, sprung.DAMPING, spring.rest_of(base)], rel=1e-9)
    assert not any(a.get("joint") == sprung.SPRINGS[0] for a in top.find("actuator") or ())


def test_sdf_has_them_and_urdf_says_that_it_has_not() -> None:
    mechanism, _ = sprung.make()
    table = links_of(mechanism)
    edge = next(e for e in table.tree if e.name == sprung.SPRINGS[0])
    axis = add_joint(ET.Element("model"), edge, table).find("axis")
    assert axis is not None and edge.spring is not None
    assert float(axis.findtext("dynamics/spring_stiffness", "nan")) == sprung.STIFFNESS
    assert math.isclose(float(axis.findtext("dynamics/spring_reference", "nan")), edge.spring.rest, rel_tol=1e-9)
    assert axis.findtext("limit/effort") is None
    assert any("no springs" in words and sprung.SPRINGS[0] in words for words in urdf_unsaid(mechanism))


def test_the_report_says_what_springs_are_there() -> None:
    mechanism, _ = sprung.make()
    entries = [joint_entry(joint) for joint in mechanism.joints]
    assert [entry["name"] for entry in entries if "spring" in entry] == list(sprung.SPRINGS)
    rows = joint_rows({"joints": entries, "actuators": []})
    said = {row["name"]: row["drive"] for row in rows}
    assert said["hub_l_joint"] == "spring, 500 kN/m, as drawn" and said["axle_joint"] == ""
