"""Loading: the library's wheel loader, Fig. A1 as printed, spellings, variants, and copies."""

from __future__ import annotations

import io
import json
import math
import shutil
from pathlib import Path

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from yellowiron import library
from yellowiron.library.composing.documents import template_documents
from yellowiron.library.notation.quantities import limit, number_text, quantity
from yellowiron.library.notation.validated_json import read_json
from yellowiron.library.type_folders import DOCUMENTS, library_folder
from yellowiron.model.errors import OutputError
from yellowiron.model.rows import as_drawn, without_absent_axles
from yellowiron.model.template import Template, choose
from yellowiron.support.units import SI_UNIT

DATA = Path(__file__).resolve().parent.parent / "data" / "templates"
FIG_A1 = DATA / "fig_a1_joints_template_cat982m.json"


@pytest.fixture(scope="module")
def loader() -> Template:
    return library.load_template("wheel_loader")


# ---- the library -----------------------------------------------------------------------------------------------------
def test_library_has_the_wheel_loader() -> None:
    assert "wheel_loader" in library.list_templates()


@pytest.mark.parametrize("name", ["Wheel Loader", "wheel-loader", "WHEEL_LOADER"])
def test_type_in_any_spelling(name: str, loader: Template) -> None:
    assert library.load_template(name) == loader


@pytest.mark.slow
@pytest.mark.parametrize("equipment_type", library.list_templates())
def test_library_documents_are_valid_as_they_are_written(equipment_type: str) -> None:
    """Our own files need no folding: an editor with the published schema accepts them, those that are like another
    type's too, and what they come to."""
    folder = library_folder() / equipment_type
    for path in sorted(folder.glob("*.json")):
        assert path.stem in DOCUMENTS
        if not (folder / "modules.json").is_file() or path.stem == "modules":
            jsonschema.validate(read_json(path), library.template_schema(path.stem))
    for kind, document in template_documents(folder).items():
        jsonschema.validate(document.data, library.template_schema(kind))


def test_schemas_are_schemas() -> None:
    for kind in (*DOCUMENTS, "joint_overrides", "common", "module"):
        jsonschema.Draft202012Validator.check_schema(library.template_schema(kind))


def test_root_and_parents_first(loader: Template) -> None:
    assert loader.root == "rear_frame"
    seen: set[str] = set()
    for role in loader.roles:
        assert role.parent is None or role.parent in seen
        seen.add(role.name)


def test_pins_move_with_the_body_that_the_joint_name_says(loader: Template) -> None:
    for joint in loader.joints:
        if "2" in joint.name:
            first, _, second = joint.name.removesuffix("_joint").partition("2")
            bodies = loader.bodies_of(joint)
            assert {b for b in bodies if b} == {
                {"rear": "rear_frame", "front": "front_frame"}.get(first, first),
                {"front": "front_frame"}.get(second, second),
            }


def test_variants_are_complete(loader: Template) -> None:
    twin = choose(loader, {"lift_cylinders": "twin", "wheel_drive": "rear"})
    single = choose(loader, {"lift_cylinders": "single", "wheel_drive": "none"})
    assert {r.name for r in twin.roles} ^ {r.name for r in single.roles} == {
        f"boom_{part}{side}{pin}"
        for part in ("cylinder_barrel", "piston_rod") for side in ("", "_l", "_r") for pin in ("", "_pin")
    }  # fmt: skip
    assert [a.name for a in twin.actuators] == ["steering", "boom", "bucket", "drive"]
    assert [a.joints for a in twin.actuators][-1] == ("rear_wheel_l_joint", "rear_wheel_r_joint")
    assert [a.name for a in single.actuators] == ["steering", "boom", "bucket"]
    assert [len(a.cylinders) for a in single.actuators] == [2, 1, 1]


def test_one_cylinder_of_each_actuator_is_driven(loader: Template) -> None:
    for lift in ("twin", "single"):
        for actuator in choose(loader, {"lift_cylinders": lift}).actuators:
            if actuator.kind == "cylinder":
                assert [c.passive for c in actuator.cylinders] == [False] + [True] * (len(actuator.cylinders) - 1)
    steering = {c.slide: c.sign for a in loader.actuators if a.name == "steering" for c in a.cylinders}
    assert steering == {
        f"steering_cylinder_barrel_{s}2steering_piston_rod_{s}_joint": n for s, n in (("r", 1), ("l", -1))
    }


def test_limits_are_si_or_names(loader: Template) -> None:
    axle = loader.joint("rear_frame2rear_axle_joint")
    assert (axle.lower, axle.upper) == (pytest.approx(-math.radians(13)), pytest.approx(math.radians(13)))
    lift = loader.joint("boom_cylinder_barrel_l2boom_piston_rod_l_joint")
    assert (lift.lower, lift.upper) == (0.0, "Lift Cylinder Stroke")


def test_wanted_values(loader: Template) -> None:
    assert len(loader.wanted) >= 35
    for wanted in loader.wanted:
        assert wanted.dimension in SI_UNIT
        assert set(wanted.synonyms) == {"en", "de", "fr", "es", "zh", "ja"}, wanted.name
        assert wanted.minimum is not None and wanted.maximum is not None and wanted.minimum < wanted.maximum
        assert wanted.use and wanted.where
    angles = {w.name: w for w in loader.wanted}
    assert angles["Maximum Steering Angle"].maximum == pytest.approx(math.radians(60))
    assert [(w.name, w.mass_of) for w in loader.wanted if w.mass_of] == [
        ("Operating Weight", "*"),
        ("Bucket Weight", "bucket"),
    ]


def test_materials_and_collision_reach_every_role(loader: Template) -> None:
    for role in loader.roles:
        assert loader.materials[role.name].density
        assert loader.collision[role.name]
    assert loader.materials["boom_pin"].name == "hardened steel"
    assert loader.materials["boom_piston_rod_l_pin"].name == "hardened steel"
    assert loader.materials["boom_piston_rod_l"].name == "hard chrome on steel"
    assert loader.materials["front_tyre_l"].name == "tyre rubber"
    assert loader.collision["bucket"] == "convexDecomposition"
    assert loader.collision["rear_wheel_r"] == "analytic"


def test_every_number_of_a_material_has_a_source() -> None:
    for name, entry in template_documents(library_folder() / "wheel_loader")["materials"].data.items():
        remarks = " ".join(entry["source"])
        for key in entry.keys() - {"name", "source"}:
            assert key.split()[-1] in remarks, (name, key)


def test_colours_are_linear(loader: Template) -> None:
    """sRGB 0xF2 is 0.8879 in linear light (IEC 61966-2-1)."""
    assert loader.materials["boom"].color is not None
    assert loader.materials["boom"].color[0] == pytest.approx(0.8879, abs=1e-4)


def test_the_papers_four_measurements_are_there(loader: Template) -> None:
    names = {m.specification for m in loader.measurements}
    assert {
        "Maximum Steering Angle", "Rack Back at Maximum Lift", "Rack Back at Ground",
        "Hinge Pin Height at Maximum Lift",
    } <= names  # fmt: skip
    clearance = next(m for m in loader.measurements if m.name == "Dumping Clearance")
    assert clearance.steps[1]["solve"][0]["value"] == pytest.approx(-math.pi / 4)


# ---- Fig. A1 ---------------------------------------------------------------------------------------------------------
def test_fig_a1_loads_as_a_file_and_as_a_folder(tmp_path: Path) -> None:
    shutil.copyfile(FIG_A1, tmp_path / FIG_A1.name)
    alone, folder = library.load_template(FIG_A1), library.load_template(tmp_path)
    assert alone.joints == folder.joints
    assert alone.roles == folder.roles


def test_fig_a1_pins_and_bodies() -> None:
    template = library.load_template(FIG_A1)
    assert template.root == "rear_frame"
    carriers = {r.name: r.parent for r in template.roles if r.kind == "pin"}
    assert carriers == {
        "rear_front_pin": "rear_frame", "steering_piston_rod_l_pin": "front_frame",
        "steering_piston_rod_r_pin": "front_frame", "boom_pin": "front_frame",
        "boom_cylinder_barrel_pin": "front_frame", "bucket_cylinder_barrel_pin": "front_frame",
        "bucket_piston_rod_pin": "bucket_piston_rod", "rocker_pin": "rocker", "bucket_link_pin": "bucket_link",
        "bucket_pin": "bucket",
    }  # fmt: skip
    welded = {r.name: r.parent for r in template.roles if r.kind == "barrel" and not r.rigid}
    assert welded == {f"steering_cylinder_barrel_{side}": "rear_frame" for side in "lr"}
    assert [j.name for j in template.joints if j.free] == ["front_wheel_joint"]


def test_fig_a1_actuators_follow_from_its_drives() -> None:
    actuators = library.load_template(FIG_A1).actuators
    assert [(a.kind, len(a.cylinders) or len(a.joints)) for a in actuators] == [
        ("cylinder", 2), ("cylinder", 1), ("cylinder", 1), ("motor", 1),
    ]  # fmt: skip
    assert actuators[0].specifications == {"stroke": "Steering Cylinder Stroke"}
    assert [c.passive for c in actuators[0].cylinders] == [False, True]


# ---- spellings -------------------------------------------------------------------------------------------------------
def test_keys_values_and_names_in_any_spelling(tmp_path: Path) -> None:
    shutil.copytree(DATA / "sound", tmp_path / "t")
    (tmp_path / "t" / "joints.json").write_text(
        json.dumps(
            {
                "base2boom_joint": {"Joint Type": "REVOLUTE", "BODY": ["Boom", "boom pin"], "drive": [""]},
                "base2barrel_joint": {"jointtype": "revolute", "body": ["barrel", "BARREL_PIN"], "Drive": []},
                "boom2rod_joint": {"joint-type": "Revolute", "body": ["rod", "rod_pin"], "limit": [-30, "40 deg"]},
                "barrel2rod_joint": {
                    "joint_type": "prismatic",
                    "body": ["barrel", "rod"],
                    "LIMIT": [None, 0.8],
                    "drive": "linear drive",
                    "Max Force": 1000,
                    "stiffness": 2e6,
                },
            }
        )
    )
    template = library.load_template(tmp_path / "t")
    assert template.joint("base2boom_joint").parts == ("boom", "boom_pin")
    assert template.joint("base2boom_joint").drive is None
    swing, slide = template.joint("boom2rod_joint"), template.joint("barrel2rod_joint")
    assert (swing.lower, swing.upper) == (pytest.approx(-math.radians(30)), pytest.approx(math.radians(40)))
    assert (slide.lower, slide.upper, slide.drive) == (None, 0.8, "linear")
    assert (slide.max_force, slide.stiffness, slide.damping) == (1000.0, 2e6, None)


def test_relations_are_another_spelling_of_the_hierarchy(tmp_path: Path) -> None:
    nested = library.load_template(DATA / "sound")
    shutil.copyfile(DATA / "sound" / "joints.json", tmp_path / "joints.json")
    (tmp_path / "relations.json").write_text(
        '{"lifter": ["base", "boom", "barrel", "rod"], "base": ["boom_pin", "barrel_pin"], "boom": ["rod_pin"]}'
    )
    related = library.load_template(tmp_path)
    assert {r.name: r.rigid for r in related.roles} == {r.name: r.rigid for r in nested.roles}
    assert [related.bodies_of(j) for j in related.joints] == [nested.bodies_of(j) for j in nested.joints]
    assert (related.root, related.equipment_type) == (nested.root, nested.equipment_type)


def test_relations_as_the_conference_paper_prints_them(tmp_path: Path) -> None:
    (tmp_path / "relations.json").write_text('{"bucket": ["bucket body", "bucket bolt1", "bucket bolt2"]}')
    (tmp_path / "joints.json").write_text('{"arm2bucket_joint": {"joint_type": "Revolute", "Body": ["arm", "bucket"]}}')
    template = library.load_template(tmp_path)
    assert {r.name: (r.rigid, r.parent) for r in template.roles} == {
        "bucket": (True, None), "bucket body": (False, "bucket"), "bucket bolt1": (False, "bucket"),
        "bucket bolt2": (False, "bucket"), "arm": (True, None),
    }  # fmt: skip


def test_flat_hierarchy_with_lists_and_parents(tmp_path: Path) -> None:
    shutil.copyfile(DATA / "sound" / "joints.json", tmp_path / "joints.json")
    (tmp_path / "hierarchy.json").write_text(
        json.dumps(
            {
                "lifter": {"rigid body": "N", "child": ["base"]},
                "base": {"rigid body": "Y", "child": ["boom_pin", "barrel_pin", "barrel", "boom"]},
                "barrel": {"rigid body": "Y"},
                "boom": {"rigid body": "Y"},
                "rod": {"rigid body": "Y", "parent": "boom"},
                "rod_pin": {"rigid body": "N", "parent": "boom"},
            }
        )
    )
    nested = library.load_template(DATA / "sound")
    flat = library.load_template(tmp_path)
    assert {(r.name, r.parent, r.rigid) for r in flat.roles} == {(r.name, r.parent, r.rigid) for r in nested.roles}


def test_a_role_that_is_a_body_under_some_choices_only(tmp_path: Path) -> None:
    """Under the others it moves with its nearest rigid ancestor."""
    documents = {
        "hierarchy": {"car": {"rigid body": "Y", "child": {
            "idler": {"rigid body": "Y", "rigid_when": {"tracks": "shoes"}}}}},
        "joints": {"car2idler_joint": {"joint_type": "Revolute", "Body": ["idler", "car"], "free": "Y",
                                       "when": {"tracks": "shoes"}}},
        "variants": {"tracks": {"choices": ["belt", "shoes"], "default": "belt"}},
    }  # fmt: skip
    for name, content in documents.items():
        (tmp_path / f"{name}.json").write_text(json.dumps(content))
    template = library.load_template(tmp_path)
    assert choose(template, {"tracks": "shoes"}).body_of("idler") == "idler"
    belt = choose(template, {})
    assert belt.body_of("idler") == "car"
    assert not belt.joints


def test_a_row_of_parts(tmp_path: Path) -> None:
    (tmp_path / "hierarchy.json").write_text('{"base": {"rigid body": "Y", "child": {"shoe[*]": {"rigid body": "Y"}}}}')
    (tmp_path / "joints.json").write_text(
        '{"shoe_joint": {"joint_type": "Revolute", "Body": ["shoe[i]", "Shoe[i + 1]"]}}'
    )
    template = library.load_template(tmp_path)
    assert template.role("shoe").many
    assert template.joints[0].parts == ("shoe[i]", "shoe[i+1]")


@given(st.floats(-5e3, 5e3), st.sampled_from(["m", "rad"]))
def test_numbers_survive_a_file(value: float, unit: str) -> None:
    dimension = "length" if unit == "m" else "angle"
    back = quantity(number_text(value, unit), dimension, where="")
    assert back == pytest.approx(value, rel=1e-11, abs=1e-300)


@given(
    st.sampled_from(["", "-", "- ", "−"]),
    st.text("abcdefgh XYZ()", min_size=1).filter(lambda t: t.strip()[:1].isalpha()),
)
def test_limit_names_keep_their_minus(sign: str, name: str) -> None:
    found = limit(sign + name, "length", where="")
    assert found == ("-" if sign else "") + " ".join(name.split())


# ---- what is shown and copied --------------------------------------------------------------------------------
def shown(template: Template) -> str:
    console = Console(width=250, file=io.StringIO(), record=True)
    console.print(library.tree(template))
    return console.export_text()


def test_tree_shows_every_role_joint_and_drive(loader: Template) -> None:
    text = shown(loader)
    for name in (
        *(r.name for r in loader.roles),
        *(j.name for j in loader.joints),
        *(a.name for a in loader.actuators),
    ):
        assert name in text
    assert "0 m to Lift Cylinder Stroke, linear drive" in text
    assert "-13 deg to 13 deg, free" in text


def test_tree_of_fig_a1_has_every_joint() -> None:
    template = library.load_template(FIG_A1)
    text = shown(template)
    assert all(j.name in text for j in template.joints)


def test_copy_and_load_again(tmp_path: Path, loader: Template) -> None:
    folder = library.copy_template("wheel_loader", tmp_path / "mine")
    copied = library.load_template(folder)
    assert copied.equipment_type == loader.equipment_type
    assert (copied.roles, copied.joints, copied.wanted) == (loader.roles, loader.joints, loader.wanted)


def test_copy_takes_textures_along_and_nothing_else(tmp_path: Path) -> None:
    source = Path(shutil.copytree(DATA / "sound", tmp_path / "source"))
    (tmp_path / "outside.png").write_bytes(b"png")
    (source / "materials.json").write_text('{"*": {"texture": "../outside.png"}}')
    with pytest.raises(OutputError, match="outside the template"):
        library.copy_template(source, tmp_path / "copy")
    (source / "textures").mkdir()
    (source / "textures" / "paint.png").write_bytes(b"png")
    (source / "machine.step").write_text("ISO-10303-21;")
    (source / "materials.json").write_text('{"*": {"texture": "textures/paint.png"}}')
    copy = library.copy_template(source, tmp_path / "copy")
    assert sorted(str(p.relative_to(copy)) for p in copy.rglob("*.*")) == [
        "hierarchy.json", "joints.json", "materials.json", "textures/paint.png",
    ]  # fmt: skip


def test_copy_never_overwrites(tmp_path: Path) -> None:
    (tmp_path / "joints.json").write_text("{}")
    with pytest.raises(OutputError, match="nothing is overwritten"):
        library.copy_template("wheel_loader", tmp_path)
    assert [p.name for p in tmp_path.iterdir()] == ["joints.json"]
    with pytest.raises(OutputError):
        library.copy_template("wheel_loader", tmp_path / "joints.json")
    with pytest.raises(OutputError, match="in the way"):
        library.copy_template("wheel_loader", tmp_path / "joints.json" / "below")


def test_wheels_of_an_axle_that_is_not_drawn_turn_on_what_carries_it() -> None:
    loader = choose(library.load_template("wheel_loader"), {})
    bodies = {r.name for r in loader.roles if r.rigid}
    assert without_absent_axles(loader, bodies) is loader
    bare = without_absent_axles(loader, bodies - {"rear_axle", "rocker"})
    assert not bare.role("rear_axle").rigid
    assert bare.role("rocker").rigid
    assert bare.bodies_of(bare.joint("rear_wheel_l_joint")) == ("rear_frame", "rear_wheel_l")
    assert "rear_frame2rear_axle_joint" not in {j.name for j in bare.joints}


def test_what_slides_on_a_mast_that_is_not_drawn_slides_on_what_carries_it() -> None:
    forklift = choose(library.load_template("forklift"), {"mast": "single"})
    bodies = {r.name for r in forklift.roles if r.rigid}
    assert as_drawn(forklift, bodies) is forklift
    bare = as_drawn(forklift, {"chassis", "carriage"})
    assert not bare.role("outer_mast").rigid
    assert bare.bodies_of(bare.joint("outer_mast2carriage_joint")) == ("chassis", "carriage")
    assert "chassis2outer_mast_joint" not in {j.name for j in bare.joints}
    # Where nothing slides, nothing stands in.
    assert as_drawn(forklift, {"chassis"}).role("outer_mast").rigid
