"""Every way a template can be wrong is one sentence that names file and key: one defect a file."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from yellowiron import library
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import Template

DATA = Path(__file__).resolve().parent.parent / "data" / "templates"

# defect file → (in the message, at the end of `where`, in the hint)
DEFECTS = {
    "joints.not_json": ("not JSON", "line 1, column 47", "commas"),
    "joints.not_utf8": ("UTF-8", "joints.json", "UTF-8"),
    "joints.key_twice": ("'Joint Type' is there twice", "joints.json", "one of the two"),
    "joints.not_a_number": ("NaN", "joints.json", ""),
    "joints.empty": ("nothing in it", "joints.json", ""),
    "joints.a_list": ("object", "joints.json", ""),
    "joints.unknown_key": ("'Limits'", "barrel2rod_joint", "mean Limit?"),
    "joints.no_body": ("'Body' is missing", "barrel2rod_joint", ""),
    "joints.one_body": ("1 items, not 2", "barrel2rod_joint.Body", ""),
    "joints.unknown_type": ("'Prismatik'", "barrel2rod_joint.joint_type", "Prismatic"),
    "joints.unknown_drive": ("'Linear Engine'", "barrel2rod_joint.Drive[0]", "Linear Drive"),
    "joints.wrong_drive": ("cannot have a drive that is angular", "barrel2rod_joint.Drive", "Revolute"),
    "joints.limit_of_one": ("1 items", "barrel2rod_joint.Limit", "Lower and upper"),
    "joints.limit_in_degrees": ("'30 deg'", "barrel2rod_joint.Limit", "0.8 m"),
    "joints.limit_unknown_unit": ("'cubits'", "barrel2rod_joint.Limit", "mm"),
    "joints.limit_no_name": ("'?'", "barrel2rod_joint.Limit", "Lift Cylinder Stroke"),
    "joints.limits_swapped": ("not below its upper limit", "barrel2rod_joint.Limit", "[lower, upper]"),
    "joints.fixed_with_limits": ("has limits", "barrel2rod_joint.Limit", "Remove"),
    "joints.negative_stiffness": ("at least 0", "barrel2rod_joint.stiffness", "N/m"),
    "joints.zero_force": ("more than 0", "barrel2rod_joint.max_force", "N or N*m"),
    "joints.to_nowhere": ("'hook_pin'", "boom2rod_joint.Body", "rod_pin"),
    "joints.to_itself": ("joins 'boom' with itself", "boom2rod_joint.Body", "other body"),
    "joints.to_a_group": ("moves with no body", "boom2rod_joint.Body", '"rigid body": "Y"'),
    "joints.index_on_one_part": ("has an index", "boom2rod_joint.Body", "name[*]"),
    "joints.leader_unknown": (
        "'base2bom_joint' that is not there",
        "base2barrel_joint.follows.joint",
        "base2boom_joint",
    ),
    "joints.leader_of_other_type": ("which is prismatic", "base2barrel_joint.follows.joint", "one type"),
    "joints.leaders_in_a_circle": ("follows itself, by way of", "base2boom_joint.follows.joint", "leads"),
    "joints.own_leader": ("'base2barrel_joint' follows itself", "base2barrel_joint.follows.joint", "leads"),
    "joints.driven_follower": ("a drive of its own", "barrel2rod_joint.follows", "Drive the leader"),
    "joints.follows_at_nothing": ("ratio of 0", "base2barrel_joint.follows.ratio", "Fixed"),
    "joints.fixed_follower": ("is fixed and cannot follow", "base2barrel_joint.follows", "one coordinate"),
    "joints.unknown_coupling": ("'belt'", "base2barrel_joint.follows.kind", "chain, gear, rope"),
    "joints.no_leader": ("'joint' is missing", "base2barrel_joint.follows", ""),
    "joints.unknown_variant": ("no variant 'booms'", "base2boom_joint.when", "variants.json"),
    "alone.pin_of_nobody": ("carries 'strange_pin'", "a2b_joint.Body", "hierarchy.json"),
    "hierarchy.circle_nested": ("circle", "base.child.boom.child.base", "ancestor"),
    "hierarchy.circle_flat": ("circle", "rod.child.boom", "ancestor"),
    "hierarchy.circle_by_parent": ("circle", "boom.parent", "ancestor"),
    "hierarchy.own_parent": ("'base' moves with itself", "base.parent", "ancestor"),
    "hierarchy.two_parents": ("two parents", "boom.child.pin", "one parent"),
    "hierarchy.there_twice": ("'PIN' is there twice", "PIN", "base.child.pin"),
    "hierarchy.unknown_parent": ("'bse'", "boom", "base"),
    "hierarchy.no_body": ("no body", "hierarchy.json", '"Y"'),
    "hierarchy.unknown_kind": ("'frme'", "base.kind", "frame"),
    "hierarchy.maybe_rigid": ("'maybe'", "base.rigid body", "Y, N"),
    "relations.circle": ("circle", "rod[0]", "ancestor"),
    "relations.two_leaders": ("two parents", "boom[0]", "one parent"),
    "variants.default_no_choice": ("'three'", "booms.default", "one, two"),
    "variants.needs_no_variant": ("no variant 'axles'", "booms.needs", "variants.json"),
    "variants.needs_of_no_choice": ("'three' is no choice", "booms.needs", "one, two"),
    "measurements.unknown_variant": ("no variant 'booms'", "measurements[0].when", "variants.json"),
    "wanted.unknown_variant": ("no variant 'booms'", "Height.when", "variants.json"),
    "variants.one_choice": ("1 items", "booms.choices", ""),
    "materials.unknown_role": ("'bom'", "bom", "boom"),
    "materials.zero_density": ("more than 0", "boom.density", "kg/m^3"),
    "materials.unknown_property": ("'densty'", "boom", "density"),
    "materials.friction_order": ("above its static", "boom.dynamic friction", ""),
    "materials.bad_color": ("'yellow'", "boom.color", "#RRGGBB"),
    "collision.unknown_token": ("'convexHul'", "boom", "convexHull"),
    "collision.unknown_role": ("'jib'", "jib", "roles"),
    "wanted.no_dimension": ("'dimension' is missing", "Lift Cylinder Stroke", ""),
    "wanted.unknown_dimension": ("'lenght'", "Lift Cylinder Stroke.dimension", "length"),
    "wanted.bounds": ("not below", "Lift Cylinder Stroke.minimum", ""),
    "wanted.bound_of_other_dimension": ("'2 kg'", "Lift Cylinder Stroke.minimum", "0.8 m"),
    "wanted.mass_of_nothing": ("'bom'", "Boom Weight.mass_of", "boom"),
    "wanted.unknown_common": ("no common 'Operating Wieght'", "Operating Weight.common", "Operating Weight"),
    "wanted.unknown_list": ("no common 'hydraulic'", "Lift Cylinder Stroke.sections", "hydraulics"),
    "actuators.unknown_joint": ("'barel2rod_joint'", "lift.cylinders[0].slide", "barrel2rod_joint"),
    "actuators.slide_turns": ("not prismatic", "lift.cylinders[0].slide", ""),
    "actuators.one_pin": ("a pin at one end only", "lift.cylinders[0].barrel_joint", "or neither"),
    "actuators.pins_and_rams": ("has pins and rams", "lift.cylinders[0].rams", "fixed"),
    "actuators.unknown_ram": ("no part 'rood'", "lift.cylinders[0].rams[0]", "rod"),
    "actuators.half_a_ram": ("1 items", "lift.cylinders[0].rams[0]", ""),
    "actuators.sign": ("'2'", "lift.cylinders[0].sign", "1, -1"),
    "actuators.nothing_moves": ("needs 'cylinders'", "lift", ""),
    "actuators.motor_with_cylinders": ("needs 'joints'", "lift", ""),
    "actuators.default_of_other_dimension": ("'25 mm'", "lift.defaults.pressure", "25 MPa"),
    "actuators.unknown_variant": ("no variant 'booms'", "lift.cylinders.when", "variants.json"),
    "measurements.unknown_body": ("no body 'hook'", "sites.hook.body", ""),
    "measurements.unknown_joint": ("no joint 'base2bom_joint'", "sites.hook.joint", "base2boom_joint"),
    "measurements.unknown_kind": ("'hight'", "measurements[0].quantity.kind", "height"),
    "measurements.bad_value": ("'high'", "measurements[0]", "764 mm"),
    "tests.bad_offset": ("'100 kg'", "tests[0]", "0.8 m"),
    "tests.no_site": ("needs 'site'", "tests[0]", "docs/template-format.md"),
    "tests.twice": ("two tests 'raise'", "tests[1]", "another name"),
    "tests.unknown_step": ("'half'", "tests[0].steps[0].set.lift", ""),
    "words.unknown_role": ("'bom' is in no role's name", "bom cylinder", "boom"),
    "words.unknown_language": ("'dutch'", "boom", ""),
}


def sound(folder: Path) -> Path:
    """A sound little template: a boom on a base, lifted by a cylinder."""
    return Path(shutil.copytree(DATA / "sound", folder / "lifter"))


def load_defect(file: Path, folder: Path) -> Template:
    """The sound template with one of its documents replaced by a defect file."""
    document = file.name.split(".")[-3]
    if document == "alone":
        return library.load_template(file)
    target = sound(folder)
    if document == "relations":
        (target / "hierarchy.json").unlink()
    shutil.copyfile(file, target / f"{document}.json")
    return library.load_template(target)


def test_the_sound_template_is_sound(tmp_path: Path) -> None:
    report = library.lint(library.load_template(sound(tmp_path)))
    assert report.sound
    assert [f.code for f in report.findings] == ["TPL004"]


def test_every_defect_file_is_expected() -> None:
    assert {p.stem for p in (DATA / "defects").iterdir()} == set(DEFECTS)


@pytest.mark.parametrize("name", sorted(DEFECTS))
def test_defect(name: str, tmp_path: Path) -> None:
    message, place, hint = DEFECTS[name]
    with pytest.raises(TemplateError) as caught:
        load_defect(DATA / "defects" / f"{name}.json", tmp_path)
    error = caught.value
    assert message in error.message
    assert error.where.endswith(place)
    assert ".json" in error.where
    assert hint in error.hint
    assert "\n" not in error.message


def test_unknown_type_suggests_near_ones() -> None:
    with pytest.raises(TemplateError, match="no equipment type") as caught:
        library.load_template("wheel_loadr")
    assert "Did you mean wheel_loader or backhoe_loader?" in caught.value.hint


def test_missing_file_and_folder_without_joints(tmp_path: Path) -> None:
    with pytest.raises(TemplateError, match="no equipment type"):
        library.load_template(tmp_path / "nowhere")
    with pytest.raises(TemplateError, match=r"no joints\.json") as caught:
        library.load_template(tmp_path)
    assert "templates copy" in caught.value.hint
    (tmp_path / "machine.step").write_text("ISO-10303-21;")
    with pytest.raises(TemplateError, match="no template"):
        library.load_template(tmp_path / "machine.step")


def test_a_misspelled_document_is_not_passed_over(tmp_path: Path) -> None:
    target = sound(tmp_path)
    (target / "notes.json").write_text("{}")
    library.load_template(target)
    (target / "material.json").write_text("{}")
    with pytest.raises(TemplateError, match=r"'material\.json' is no document") as caught:
        library.load_template(target)
    assert caught.value.hint == "Did you mean materials?"


def test_deep_nesting_is_an_error_and_no_crash(tmp_path: Path) -> None:
    target = sound(tmp_path)
    (target / "hierarchy.json").write_text('{"a":' * 20000 + "1" + "}" * 20000)
    with pytest.raises(TemplateError):
        library.load_template(target)


def test_joints_json_that_is_a_folder(tmp_path: Path) -> None:
    target = sound(tmp_path)
    (target / "joints.json").unlink()
    (target / "joints.json").mkdir()
    with pytest.raises(TemplateError, match=r"no joints\.json"):
        library.load_template(target)


_words = st.sampled_from(
    [
        "base",
        "boom",
        "rod",
        "rigid body",
        "child",
        "parent",
        "joint_type",
        "Body",
        "Limit",
        "Drive",
        "Revolute",
        "Y",
        "*",
    ]
)
_json = st.recursive(
    st.none() | st.booleans() | st.integers(-5, 5) | st.floats(allow_nan=False) | _words | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(_words | st.text(max_size=3), inner, max_size=4),
    max_leaves=12,
)


@pytest.mark.slow
@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    content=_json,
    document=st.sampled_from(["hierarchy", "joints", "variants", "materials", "actuators", "measurements"]),
)
def test_any_json_loads_or_is_refused(content: object, document: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    target = sound(tmp_path_factory.mktemp("fuzz"))
    (target / f"{document}.json").write_text(json.dumps(content))
    try:
        library.lint(library.load_template(target))
    except TemplateError as error:
        assert error.message and error.where
