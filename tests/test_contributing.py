"""The recipes of CONTRIBUTING.md, followed to the letter: each addition is there and works."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

import yellowiron as yi
from kit.machines import small_machine
from kit.packages import install_package
from yellowiron import checks, library
from yellowiron.checks.rules import RULES, rules_of
from yellowiron.simulation.registry import ENGINES, find_engine

BOX = "OFF\n4 4 6\n0 0 0\n3 0 0\n0 2 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"
"""A corner of a box: 3 · 2 · 1 / 6."""


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "CONTRIBUTING.md").read_text(encoding="utf-8")


def block(page: str, name: str) -> str:
    """The code of the file that a block names in its first line."""
    (found,) = re.findall(rf"^```\w+\n(?:#|//) {re.escape(name)}\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    return str(found)


def entries(page: str, group: str) -> dict[str, str]:
    """The entry points of a group, as the page's TOML has them."""
    for text in re.findall(r"^```toml\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
        points = tomllib.loads(text)["project"]["entry-points"]
        if group in points:
            return dict(points[group])
    raise AssertionError(group)


def test_a_cad_format(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    group = "yellowiron.cad_formats"
    modules = {"off_format": block(page, "off_format.py")}
    file = tmp_path / "corner.off"
    file.write_text(BOX)
    with pytest.raises(yi.YellowironError):
        yi.read_cad(file)
    install_package(
        tmp_path / "site", monkeypatch, name="off-format", group=group, entries=entries(page, group), modules=modules
    )
    assembly = yi.read_cad(file)
    (part,) = assembly.parts
    assert (part.name, assembly.format) == ("corner", "OFF")
    assert assembly.shapes[part.shape].volume == pytest.approx(1.0 * assembly.unit**3, rel=1e-9)


def test_an_exporter(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    group = "yellowiron.exporters"
    modules = {"joint_list": block(page, "joint_list.py")}
    install_package(
        tmp_path / "site", monkeypatch, name="joint-list", group=group, entries=entries(page, group), modules=modules
    )
    mechanism, assembly = small_machine.make()
    (tmp_path / "usd").mkdir()
    file = yi.write_machine(mechanism, assembly, tmp_path / "usd", name="small", frame=np.eye(4))[0]
    written = yi.export(file, tmp_path / "out", to="joints")
    assert written == tmp_path / "out" / f"{mechanism.name}.json"
    assert all(f'"{joint.name}"' in written.read_text(encoding="utf-8") for joint in mechanism.joints)


def test_an_engine(page: str, root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The engine that the page names (what it answers is held by the tests of `simulation`)."""
    group = "yellowiron.engines"
    source = (root / "tests" / "data" / "plugins" / "kinematic_engine.py").read_text(encoding="utf-8")
    assert block(page, "registry entry, or the object that the entry point names").strip() in source
    install_package(
        tmp_path, monkeypatch, name="kinematic", group=group, entries=entries(page, group),
        modules={"kinematic_engine": source},
    )  # fmt: skip
    assert "kinematic" not in ENGINES
    assert find_engine("kinematic").timestep == 0.02


def test_an_equipment_type(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    group = "yellowiron.templates"
    (value,) = entries(page, group).values()
    folder = tmp_path.joinpath("site", *value.split("."))
    (folder / "barrier").mkdir(parents=True)
    for package in (folder, folder.parent):
        (package / "__init__.py").touch()
    (folder / "barrier" / "joints.json").write_text(block(page, "barrier/joints.json"), encoding="utf-8")
    install_package(tmp_path / "site", monkeypatch, name="gates", group=group, entries=entries(page, group))
    assert "barrier" in yi.list_templates()
    lint = yi.lint(yi.load_template("barrier"))
    assert lint.sound and not lint.findings
    assert [m.computed for m in lint.mobility] == [1]
    assert library.lint(library.load_template(folder / "barrier")).sound


def test_a_check_rule(page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install_package(
        tmp_path, monkeypatch, name="a-rule", group="none", entries={}, modules={"a_rule": block(page, "a_rule.py")}
    )
    topic = __import__("a_rule")
    monkeypatch.setattr(checks.rules, "RULES", (*RULES, *rules_of([topic])))
    sound = Path(__file__).parent / "data" / "check" / "sound.usda"
    text = sound.read_text(encoding="utf-8")
    name = re.search(r'def PhysicsRevoluteJoint "(\w+)"', text)
    assert name is not None
    named = tmp_path / "named.usda"
    named.write_text(text.replace(f'"{name[1]}"', '"x"').replace(f"/{name[1]}>", "/x>"), encoding="utf-8")
    assert {f.where.rsplit("/", 1)[-1] for f in yi.check(named) if f.code == "CHK998"} >= {"x"}
