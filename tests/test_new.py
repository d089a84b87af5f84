"""`templates new`: from a CAD model to a template that loads, passes the lint and builds."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

import yellowiron
from kit.machines.synthetic import disguise, loader
from kit.machines.telescope import crane
from yellowiron import cad, library, new_template
from yellowiron.cli import app
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError, OutputError

pytestmark = pytest.mark.usefixtures("no_pages", "cad_read_once")

Drawn = Callable[[Assembly], None]


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> Drawn:
    """Stands in for the CAD file."""
    monkeypatch.setattr(cad, "check_file", lambda file: None)
    return lambda assembly: monkeypatch.setattr(cad, "read_cad", lambda file: assembly)


def telescope() -> Assembly:
    return crane()[0]


def build(folder: Path, file: Path, out: Path, *, settings: Sequence[str] = ()) -> Any:
    return yellowiron.build(folder, file, out, settings=settings)


def physics(machine: Any) -> str:
    return str((machine.folder / "payloads" / "physics.usda").read_text(encoding="utf-8"))


def test_a_template_is_written_and_sound(drawn: Drawn, tmp_path: Path) -> None:
    drawn(telescope())
    document = new_template("my crane.step", tmp_path / "new")
    assert document["equipment_type"] == "my_crane"
    assert {f["severity"] for f in document["findings"]} <= {"warning", "info"}
    template = library.load_template(tmp_path / "new")
    assert library.lint(template).sound
    assert sum(j.type == "prismatic" for j in template.joints) == 3
    assert sum(j.type == "revolute" for j in template.joints) == 4
    roles = {b["role"] for b in document["bodies"]}
    assert roles == {r.name for r in template.roles if r.rigid}
    words = (tmp_path / "new" / "proposal.md").read_text(encoding="utf-8")
    assert all(f"`{role}`" in words for role in roles)


def test_the_proposal_names_every_part(drawn: Drawn, tmp_path: Path) -> None:
    """Of a body of many parts the table shows a few, and a list below it all."""
    assembly = telescope()
    chassis = next(p for p in assembly.parts if p.name == "CHASSIS")
    place = np.eye(4)
    place[2, 3] = 1e-4  # plates that lie on it, nearly
    plates = tuple(
        replace(chassis, id=f"{chassis.id} PLATE {k}", name=f"CHASSIS PLATE {k}", transform=place @ chassis.transform)
        for k in range(8)
    )
    drawn(replace(assembly, parts=(*assembly.parts, *plates)))
    new_template("crane.step", tmp_path / "new")
    words = (tmp_path / "new" / "proposal.md").read_text(encoding="utf-8")
    assert "more, listed under [Parts](#parts)" in words
    listed = words.partition("## Parts")[2]
    assert all(f"- {plate.id}" in listed for plate in plates)


def test_the_same_twice(drawn: Drawn, tmp_path: Path) -> None:
    drawn(telescope())
    for name in ("a", "b"):
        new_template("crane.step", tmp_path / name)
    files = sorted(p.name for p in (tmp_path / "a").iterdir())
    assert "actuators.json" in files
    assert all((tmp_path / "a" / f).read_bytes() == (tmp_path / "b" / f).read_bytes() for f in files)


def test_nothing_is_overwritten(drawn: Drawn, tmp_path: Path) -> None:
    drawn(telescope())
    (tmp_path / "mine.txt").write_text("keep", encoding="utf-8")
    with pytest.raises(OutputError, match="nothing is overwritten"):
        new_template("crane.step", tmp_path)


def test_nothing_is_written_where_nothing_turns(drawn: Drawn, tmp_path: Path) -> None:
    assembly = telescope()
    drawn(Assembly("block", "synthetic", 1.0, tuple(p for p in assembly.parts if p.name == "CHASSIS"), assembly.shapes))
    with pytest.raises(AlignmentError, match="turns or slides"):
        new_template("block.step", tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_the_command(drawn: Drawn, tmp_path: Path) -> None:
    drawn(telescope())
    command = ["templates", "new", "--from", "crane.step", "--out", str(tmp_path / "new")]
    shown = CliRunner().invoke(app, [*command, "--json"])
    assert shown.exit_code == 0
    assert len(json.loads(shown.stdout)["joints"]) == 7
    again = CliRunner().invoke(app, command)
    assert isinstance(again.exception, OutputError)


@pytest.mark.slow
def test_a_telescopic_crane_builds(drawn: Drawn, tmp_path: Path) -> None:
    """Slides of sections are slides of the machine; with its values given, no joint is left unlimited."""
    drawn(telescope())
    document = new_template("crane.step", tmp_path / "new")
    wanted = json.loads((tmp_path / "new" / "wanted.json").read_text(encoding="utf-8"))
    given = [f"{name}=0.5 m" for name in wanted if "Travel" in name or "Stroke" in name]
    machine = build(tmp_path / "new", Path("crane.step"), tmp_path / "out", settings=given)
    roles = {part: b["role"] for b in document["bodies"] for part in b["parts"]}
    moved = {p.part: p.body for p in machine.alignment.parts}
    assert all(moved[part] == role for part, role in roles.items())
    assert machine.document["mobility"]["computed"] == machine.document["mobility"]["expected"] == 4
    assert [f for f in machine.document["findings"] if f["severity"] == "error"] == []
    slides = [j for j in machine.document["joints"] if j["type"] == "prismatic"]
    assert len(slides) == 3
    assert all(
        j["upper"] - j["lower"] == pytest.approx(1.0 if "piston" not in j["name"] and "rod" not in j["name"] else 0.5)
        for j in slides
    )


@pytest.mark.slow
def test_a_section_that_is_pinned_in_another_hole(drawn: Drawn, tmp_path: Path) -> None:
    """`positions`: nothing moves on the joint, in the template, the machine, USD and MJCF; `--set` draws what stands on
    it out, along the slide, and the rest as it was."""
    drawn(telescope())
    new_template("crane.step", tmp_path / "new")
    joints = json.loads((tmp_path / "new" / "joints.json").read_text(encoding="utf-8"))
    levers = json.loads((tmp_path / "new" / "actuators.json").read_text(encoding="utf-8"))
    cylinders = {c["slide"] for lever in levers.values() for c in lever.get("cylinders", ())}
    slides = [n for n, j in joints.items() if j["joint_type"].lower() == "prismatic" and n not in cylinders]
    pinned = slides[-1]
    joints[pinned].pop("Drive")
    joints[pinned].pop("Limit")
    joints[pinned]["positions"] = {"out": "400 mm", "far": 0.9}
    levers = {n: lever for n, lever in levers.items() if pinned not in lever.get("joints", ())}
    for name, document in (("joints", joints), ("actuators", levers)):
        (tmp_path / "new" / f"{name}.json").write_text(json.dumps(document), encoding="utf-8")
    template = library.load_template(tmp_path / "new")
    variant = pinned.removesuffix("_joint")
    assert [(v.name, v.choices, v.default) for v in template.variants] == [(variant, ("drawn", "out", "far"), "drawn")]
    report = library.lint(template)
    assert report.sound and {(m.computed, m.expected) for m in report.mobility} == {(3, 3)}
    wanted = json.loads((tmp_path / "new" / "wanted.json").read_text(encoding="utf-8"))
    given = [f"{name}=0.5 m" for name in wanted if "Travel" in name or "Stroke" in name]
    machines = {
        place: build(tmp_path / "new", Path("crane.step"), tmp_path / place, settings=[*given, f"{variant}={place}"])
        for place in ("drawn", "out")
    }
    centres = []
    for place, machine in machines.items():
        assert machine.document["mobility"] == {**machine.document["mobility"], "computed": 3, "expected": 3}
        assert machine.document["counts"]["fixed"] == 1 and machine.document["counts"]["prismatic"] == 2
        centres.append({b.name: np.array(b.center_of_mass) for b in machine.mechanism.bodies})
        sections = yellowiron.export(machine, tmp_path / f"{place}_mjcf").read_text(encoding="utf-8")
        assert pinned not in re.findall(r'<joint name="([^"]+)"', sections) and len(slides) == 2
        assert pinned in re.findall(r'def PhysicsFixedJoint "([^"]+)"', physics(machine))
    moved = {name: float(np.linalg.norm(centres[1][name] - centres[0][name])) for name in centres[0]}
    assert sorted(by for by in moved.values() if by > 1e-9) == pytest.approx([0.4])
    codes = {f["code"] for f in machines["out"].document["findings"] if f["where"] == pinned}
    assert "KIN012" in codes and "KIN012" not in {f["code"] for f in machines["drawn"].document["findings"]}


@pytest.mark.slow
def test_like_another_type(drawn: Drawn, tmp_path: Path) -> None:
    """Bodies, joints, pins and actuators have the library's names where they match."""
    assembly, truth, _ = disguise(loader(2), 2)
    drawn(assembly)
    document = new_template("machine.step", tmp_path / "new", like="wheel_loader")
    template = library.load_template(tmp_path / "new")
    right = {truth[p][1] == b["role"] for b in document["bodies"] for p in b["parts"] if truth[p][1]}
    assert right == {True}
    assert {"boom", "bucket", "steering", "drive"} <= {a.name for a in template.actuators}
    assert library.lint(template).sound
    assert {w.name for w in template.wanted} >= {"Lift Cylinder Stroke", "Steering Cylinder Stroke"}


@pytest.mark.slow
def test_a_crane_that_nobody_here_drew(drawn: Drawn, shared_data: Path, tmp_path: Path) -> None:
    """Its rods are drawn at the wrong end of their barrels, its pins are merged into its parts."""
    file = shared_data / "crane" / "crane.glb"
    drawn(cad.read_cad(file))  # once for both
    document = new_template(file, tmp_path / "new")
    parts = {b["role"]: b["parts"][0] for b in document["bodies"]}
    truth = json.loads((shared_data / "crane" / "crane.truth.json").read_text(encoding="utf-8"))
    node = {p["link"]: p["node"] for p in truth["parts"]}
    wanted = {
        frozenset((node[j["parent"]], node[j["child"]])): j
        for j in truth["joints"]
        if j["parent"] in node and j["child"] in node
    }
    machine = build(tmp_path / "new", file, tmp_path / "out")
    frame = np.array(machine.document["frame"])
    found = [(j["bodies"], j["type"], j["point"], j["axis"]) for j in document["joints"]]
    back = np.linalg.inv(frame)
    for j in machine.document["joints"]:
        point = back[:3, :3] @ np.array(j["anchor"]) + back[:3, 3]
        found.append(((j["body0"], j["body1"]), j["type"], point, back[:3, :3] @ np.array(j["axis"])))
    assert len(found) == 2 * len(wanted) == 14
    for ends, kind, point, axis in found:
        joint = wanted[frozenset(parts[e] for e in ends)]
        assert kind == joint["type"]
        true = np.array(joint["axis"])
        away = np.array(point) - np.array(joint["xyz"])
        away -= (away @ true) * true
        assert math.degrees(math.acos(min(1.0, abs(float(np.dot(axis, true)))))) <= 0.5
        assert 1e3 * float(np.linalg.norm(away)) <= 5.0
