"""Modules: mechanisms that stand once, what uses of them come to; the types told by them are what they were."""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from yellowiron import library
from yellowiron.library.composing.documents import files_behind, template_documents, uses_of
from yellowiron.library.composing.layers import in_order, less, nested, on_top
from yellowiron.library.composing.modules import modules
from yellowiron.library.notation.validated_json import read_json
from yellowiron.library.type_folders import library_folder, module_files
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import choose

DATA = Path(__file__).resolve().parent.parent / "data" / "templates"
KEPT = json.loads((DATA / "types_as_they_were.json").read_text(encoding="utf-8"))


def content(value: Any) -> Any:
    """A template's value as JSON, less what says nothing, mappings in no order."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        fields = ((f.name, getattr(value, f.name)) for f in dataclasses.fields(value))
        return {name: content(each) for name, each in sorted(fields) if each or (each == 0.0 and each is not False)}
    if isinstance(value, Mapping):
        return {str(name): content(value[name]) for name in sorted(value, key=str)}
    return [content(each) for each in value] if isinstance(value, list | tuple) else value


def digest(equipment_type: str) -> str:
    """Of all that a template says, but where it lies and in which order its part names stand."""
    template = library.load_template(equipment_type, sheet_only=True)
    roles = tuple(sorted(template.roles, key=lambda role: role.name))
    text = json.dumps(content(dataclasses.replace(template, folder="", roles=roles)), ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@pytest.mark.slow
@pytest.mark.parametrize("equipment_type", KEPT)
def test_a_type_is_what_it_was(equipment_type: str) -> None:
    """As written out in full, before modules. Whoever changes a type on purpose exchanges its digest, having looked at
    `templates copy` before and after."""
    assert digest(equipment_type) == KEPT[equipment_type]


@pytest.mark.slow
def test_the_types_are_mostly_lists_of_modules() -> None:
    """Of their bodies and pins seven in ten, and of their joints eight in ten, stand in no document of theirs."""
    own = {"hierarchy": 0, "joints": 0}
    whole = dict(own)
    for name in KEPT:
        folder = library_folder() / name
        if not uses_of(folder):
            continue
        for kind, document in template_documents(folder).items():
            if kind in own:
                whole[kind] += str(document.data).count("'rigid body'" if kind == "hierarchy" else "'joint_type'")
                path = folder / f"{kind}.json"
                text = path.read_text(encoding="utf-8") if path.is_file() else ""
                own[kind] += text.count('"rigid body"' if kind == "hierarchy" else '"joint_type"')
    assert own["hierarchy"] < 0.3 * whole["hierarchy"]
    assert own["joints"] < 0.2 * whole["joints"]


@pytest.mark.slow
@pytest.mark.parametrize("name", module_files())
def test_every_module_is_valid_and_says_what_it_is(name: str) -> None:
    written = read_json(module_files()[name])
    jsonschema.validate(written, library.template_schema("module"))
    module = modules()[name]
    text = json.dumps({"documents": dict(module.documents), "modules": dict(module.uses)})
    defaults = json.dumps([p.get("default") for p in module.parameters.values()])
    assert module.about.endswith(".")
    assert all(f"{{{parameter}}}" in text + defaults for parameter in module.parameters)


def test_every_module_is_used_by_a_type_or_a_module() -> None:
    used = {use["module"] for name in KEPT for use in uses_of(library_folder() / name).values()}
    used |= {use["module"] for module in modules().values() for use in module.uses.values()}
    assert used == set(modules())


def write(folder: Path, **documents: Any) -> Path:
    folder.mkdir(exist_ok=True)
    for kind, document in documents.items():
        (folder / f"{kind}.json").write_text(json.dumps(document), encoding="utf-8")
    return folder


LIFTER = {
    "hierarchy": {"base": {"rigid body": "Y", "child": {"arm": {"rigid body": "Y"}}}},
    "modules": {
        "arm": {"module": "hinge", "on": "base", "body": "arm"},
        "lift": {"module": "cylinder", "name": "lift", "from": "base", "to": "arm", "stroke": "Lift Stroke",
                 "actuator": "lift"},
    },
}  # fmt: skip


def test_a_template_of_two_bodies_and_two_modules(tmp_path: Path) -> None:
    """No joints.json at all; sound, with one freedom, and the same when written out."""
    template = library.load_template(write(tmp_path / "t", **LIFTER))
    assert [(j.name, j.type) for j in template.joints] == [
        ("base2arm_joint", "revolute"), ("base2lift_cylinder_barrel_joint", "revolute"),
        ("arm2lift_piston_rod_joint", "revolute"), ("lift_cylinder_barrel2lift_piston_rod_joint", "prismatic"),
    ]  # fmt: skip
    assert template.joints[3].upper == "Lift Stroke" and template.joints[3].stiffness is None
    assert {r.name: r.parent for r in template.roles if r.kind == "pin"} == {
        "arm_pin": "base", "lift_cylinder_barrel_pin": "base", "lift_piston_rod_pin": "arm",
    }  # fmt: skip
    report = library.lint(template)
    assert report.sound and [(m.computed, m.expected) for m in report.mobility] == [(1, 1)]
    copied = library.load_template(library.copy_template(tmp_path / "t", tmp_path / "t2"))
    assert (copied.joints, copied.actuators, copied.roles) == (template.joints, template.actuators, template.roles)
    assert not (tmp_path / "t2" / "modules.json").exists()


def test_a_use_under_some_choices(tmp_path: Path) -> None:
    """`when` reaches parts, joints and cylinders, together with what these say themselves."""
    uses = {**LIFTER["modules"], "blade": {"module": "blade", "on": "base", "when": {"front": "blade"}}}
    variants = {"front": {"choices": ["blade", "none"], "default": "none"}}
    template = library.load_template(
        write(tmp_path / "t", hierarchy=LIFTER["hierarchy"], modules=uses, variants=variants)
    )
    blades = [r for r in template.roles if r.name.startswith("blade")]
    assert len(blades) == 14 and all(r.when["front"] == ("blade",) for r in blades)
    assert template.role("blade_cylinder_barrel_l").when == {"front": ("blade",), "blade": ("twin",)}
    lever = next(a for a in template.actuators if a.name == "blade")
    assert all(c.when["front"] == ("blade",) for c in lever.cylinders)


@pytest.mark.parametrize(
    ("use", "words", "hint"),
    [
        ({"module": "cylindr"}, "no module 'cylindr'", "cylinder"),
        ({"module": "hinge", "on": "base"}, "is not told 'body'", "turns on it"),
        ({"module": "hinge", "on": "base", "body": "arm", "pinn": "x"}, "no parameter 'pinn'", "pin"),
    ],
)
def test_what_is_wrong_with_a_use_is_said(tmp_path: Path, use: dict[str, str], words: str, hint: str) -> None:
    write(tmp_path, hierarchy=LIFTER["hierarchy"], modules={"mine": use})
    with pytest.raises(TemplateError, match=words) as found:
        library.load_template(tmp_path)
    assert "modules.json: mine" in str(found.value.where) and hint in str(found.value.hint)


def test_a_module_does_not_use_itself(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(
        tmp_path,
        round={"about": "Round.", "modules": {"again": {"module": "round"}}},
        modules={"a": {"module": "round"}},
    )
    monkeypatch.setattr("yellowiron.library.composing.modules.module_files", lambda: {"round": tmp_path / "round.json"})
    with pytest.raises(TemplateError, match="uses itself"):
        template_documents(write(tmp_path / "t", modules={"a": {"module": "round"}}))


def test_a_template_follows_what_it_is_like(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The other type's document, or a module, changes: a template that was loaded before is loaded anew."""
    other = write(tmp_path / "other", **LIFTER)
    types = {"other": other}
    monkeypatch.setattr("yellowiron.library.composing.documents.type_folders", lambda: types)
    mine = write(tmp_path / "mine", hierarchy={"like": "other"}, joints={"like": "other"})
    assert library.load_template(mine).joints[3].upper == "Lift Stroke"
    assert {other / "modules.json", other / "hierarchy.json", module_files()["cylinder"]} <= set(files_behind(mine))
    uses = {**LIFTER["modules"], "lift": {**LIFTER["modules"]["lift"], "stroke": "Another Stroke"}}
    write(other, modules=uses)
    os.utime(other / "modules.json", ns=(1, 1))  # whatever the clock's grain
    assert library.load_template(mine).joints[3].upper == "Another Stroke"


def test_a_type_like_another_takes_its_modules_less_some(tmp_path: Path) -> None:
    documents = {"modules": {"like": "excavator", "without": ["blade"], "bucket": {"stiffness": 1e7}}}
    for kind in ("hierarchy", "joints", "variants", "actuators"):
        documents[kind] = {"like": "excavator", "without": ["blade"]}
    template = library.load_template(write(tmp_path / "digger", **documents))
    excavator = library.load_template("excavator")
    gone = {j.name for j in excavator.joints} - {j.name for j in template.joints}
    assert len(gone) == 10 and all("blade" in name for name in gone)
    assert template.joint("bucket_cylinder_barrel2bucket_piston_rod_joint").stiffness == 1e7


def test_an_order_is_said_by_patterns() -> None:
    names = dict.fromkeys(("b1", "c", "a", "b2", "d"))
    assert list(in_order(names, ["a", "b?"])) == ["a", "b1", "b2", "c", "d"]
    assert list(in_order(names, ["c", "*", "b*"])) == ["c", "a", "d", "b1", "b2"]


def test_layers() -> None:
    assert less({"a": {"b_l": 1, "c": 2}, "b_r": 3}, ["b_*"]) == {"a": {"c": 2}}
    assert on_top({"a": [{"name": "x"}], "b": [1]}, {"a": [{"name": "y"}], "b": [2]}) == {
        "a": [{"name": "x"}, {"name": "y"}], "b": [2],
    }  # fmt: skip
    tree = nested(
        {"base": {"child": {"row[*]": {}}}, "x": {"parent": "row"}, "y": {"parent": "x"}, "z": {"parent": "?"}}
    )
    assert tree == {"base": {"child": {"row[*]": {"child": {"x": {"child": {"y": {}}}}}}}, "z": {"parent": "?"}}


def test_a_template_begun_with_modules_is_sound(tmp_path: Path) -> None:
    """Its bodies are written where no module brings them; values that are numbers stay so."""
    hoist = "cylinder:name=hoist,from=base,to=arm,stroke=Hoist Stroke,actuator=hoist,stiffness=1e7"
    folder = library.compose_template(tmp_path / "hoist", modules=["hinge:on=base,body=arm", hoist])
    template = library.load_template(folder)
    assert (template.equipment_type, template.root, library.lint(template).sound) == ("hoist", "base", True)
    assert template.joints[-1].stiffness == 1e7
    assert set(uses_of(folder)) == {"hinge", "cylinder"}


def test_a_type_like_another_with_a_blade(tmp_path: Path) -> None:
    """A few lines: everything of the wheel loader, and a lever more where the blade is fitted."""
    folder = library.compose_template(tmp_path / "dozing", like="wheel_loader", modules=["blade:on=front_frame"])
    assert sum(len(file.read_text(encoding="utf-8")) for file in folder.iterdir()) < 600
    template, loader = library.load_template(folder), library.load_template("wheel_loader")
    assert {j.name for j in loader.joints} < {j.name for j in template.joints}
    assert template.wanted == loader.wanted and template.measurements == loader.measurements
    report = library.lint(choose(template, {"blade": "fitted"}))
    assert report.sound and {(m.computed, m.expected) for m in report.mobility} == {(9, 9)}


@pytest.mark.parametrize(
    ("like", "with_", "words"),
    [
        ("wheel_loade", [], "no equipment type"),
        (None, [], "nothing to write"),
        (None, ["hinge:on"], "no parameter and value"),
        (None, ["hing:on=a"], "no module 'hing'"),
    ],
)
def test_what_no_template_comes_of_is_said(tmp_path: Path, like: str | None, with_: list[str], words: str) -> None:
    with pytest.raises(TemplateError, match=words):
        library.compose_template(tmp_path / "new", like=like, modules=with_)
    assert not (tmp_path / "new").exists()


def test_tools_that_are_variants_have_their_own_sites_and_payloads(tmp_path: Path) -> None:
    """A site, and the place of the load, of the tool that is fitted; a site on a body that is not there is found."""
    tools = {"tool": {"choices": ["bucket", "forks"], "default": "bucket"}}
    arm = {
        "bucket": {"rigid body": "Y", "when": {"tool": "bucket"}},
        "forks": {"rigid body": "Y", "when": {"tool": "forks"}},
    }
    sites = {f"{tool}_load": {"body": tool, "point": [0, 0, 1], "when": {"tool": tool}} for tool in arm}
    joints = {
        f"base2{tool}_joint": {"joint_type": "Revolute", "Body": [tool, "base"], "free": "Y", "when": {"tool": tool}}
        for tool in arm
    }
    documents = {
        "hierarchy": {"base": {"rigid body": "Y", "child": arm}}, "joints": joints, "variants": tools,
        "measurements": {"sites": sites}, "tests": {"payload": {"site": list(sites)}},
    }  # fmt: skip
    template = library.load_template(write(tmp_path, **documents))
    assert library.lint(template).sound
    for tool in arm:
        chosen = choose(template, {"tool": tool})
        assert [site.name for site in chosen.sites] == [f"{tool}_load"]
        assert chosen.payload is not None and chosen.payload.site == f"{tool}_load"
    sites["forks_load"].pop("when")
    report = library.lint(library.load_template(write(tmp_path / "t", **documents)))
    assert [(f.code, f.where) for f in report.findings if f.severity == "error"] == [("TPL008", "forks_load")]


@pytest.mark.parametrize(
    "documents",
    [
        {"modules": []},
        {"modules": {"like": ["excavator"]}},
        {"modules": {"a": {"module": ["hinge"]}}},
        {"modules": {"a": {"module": "hinge", "on": ["base"], "body": {"x": 1}}}},
        {"modules": {"a": {"module": "hinge", "on": "base", "body": "arm", "pin": ["x"]}}},
        {"modules": {"a": "hinge"}},
        {"modules": LIFTER["modules"], "hierarchy": {"base": "Y"}},
        {"modules": LIFTER["modules"], "hierarchy": {"order": [1], "base": {"rigid body": "Y"}}},
        {"modules": LIFTER["modules"], "hierarchy": {"order": ["*"], "base": {"child": {"arm": 3}}}},
        {"modules": LIFTER["modules"], "hierarchy": ["base"]},
        {"modules": LIFTER["modules"], "joints": {"like": "excavator", "without": [[]]}},
    ],
)
def test_unusable_documents_end_in_a_message(tmp_path: Path, documents: dict[str, Any]) -> None:
    with pytest.raises(TemplateError):
        library.load_template(write(tmp_path, **documents))


def test_a_module_says_what_it_asks_of_a_sheet(tmp_path: Path) -> None:
    """Words of every language come with it; what the folder asks for itself stands first, with its own bounds."""
    uses = {"machine": {"module": "machine"}, "body": {"module": "tilt_body", "on": "chassis"}}
    bodies = {"tipper": {"rigid body": "N", "child": {"chassis": {"rigid body": "Y"}}}}
    own = {"Load": {"dimension": "mass"}, "Body Dump Angle": {"common": "Body Dump Angle", "maximum": "60 deg"}}
    for name, content in (("modules", uses), ("hierarchy", bodies), ("wanted", own)):
        (tmp_path / f"{name}.json").write_text(json.dumps(content))
    wanted = {w.name: w for w in library.load_template(tmp_path).wanted}
    assert list(wanted)[:2] == ["Load", "Body Dump Angle"]
    assert wanted["Body Dump Angle"].maximum == pytest.approx(1.0471975512)
    known = {w.name: w for w in library.load_template("rigid_dump_truck").wanted}
    for name in ("Hoist Cylinder Stroke", "Body Raise Time", "Loading Height", "Body Capacity Heaped"):
        assert wanted[name].dimension == known[name].dimension and wanted[name].synonyms["en"]
