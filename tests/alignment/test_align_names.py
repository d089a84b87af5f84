"""What names say: six languages, typos, abbreviations, truncation, wrong codes; and what they do not."""

from __future__ import annotations

import numpy as np
import pytest

from yellowiron.alignment.assignment.collision import collision_parts
from yellowiron.alignment.assignment.names import (
    borne_by_others,
    concepts,
    described,
    exact_role,
    exact_roles,
    likeness,
    name_scores,
    role_concepts,
    spoken,
    tokens,
    unnamed,
    vocabulary,
)
from yellowiron.library import load_template
from yellowiron.model.assembly import Part
from yellowiron.model.template import Template


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


@pytest.fixture(scope="module")
def digger() -> Template:
    return load_template("excavator")


def part(name: str, *above: str) -> Part:
    return Part(name, name, ("TOP", *above), "", np.eye(4))


def test_tokens() -> None:
    assert tokens("BUCKET_LinkPin-04 Ø90 gr\u00fcn de la") == ["bucket", "link", "pin", "grun"]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("BUKCET_LINK", {"bucket", "link"}),
        ("HYDRUALIC_CYL", {"cylinder"}),
        ("LIFT CYL ROD EYE", {"boom", "cylinder", "rod"}),
        ("liftCylinderTube2", {"boom", "cylinder", "barrel"}),
        ("FRT FRAME LH", {"front", "frame", "left"}),
        ("Wheel_FL", {"front", "left", "wheel"}),
        ("Wheel.RR", {"rear", "right", "wheel"}),
        ("LiftRam_L", {"boom", "cylinder", "left"}),
        ("axe de l'essieu", {"pin", "axle"}),
        ("WHEELS", {"wheel"}),
        ("Hubzylinder Kolbenstange li", {"boom", "cylinder", "rod", "left"}),
        ("Hubzylinderkolbenstange", {"boom", "cylinder", "rod"}),
        ("Hubgeruest", {"boom"}),
        ("v\u00e9rin de levage", {"boom", "cylinder"}),
        ("cuchar\u00f3n", {"bucket"}),
        ("cilindro de direcci\u00f3n izq.", {"cylinder", "steering", "left"}),
        ("左动臂油缸活塞杆", {"left", "boom", "cylinder", "rod"}),
        ("バケットシリンダロッド", {"bucket", "cylinder", "rod"}),
        ("ﾊﾞｹｯﾄ", {"bucket"}),
        ("¶¯±Û", {"boom"}),  # 动臂 in GBK, read as Latin-1
        ("cuchar\u00c3\u00b3n", {"bucket"}),  # UTF-8, read as Latin-1
        ("cab", {"rear", "frame"}),
        ("blade", {"cutting", "edge"}),
        ("Solid17", set()),
        ("Part_003", set()),
        ("Boss-Extrude2", set()),
        ("light", {"rear", "frame"}),
        ("cover plate", set()),
        ("Lager", set()),
        ("\u00c5\u00c4", set()),
        ("", set()),
    ],
)
def test_concepts(template: Template, name: str, said: set[str]) -> None:
    assert concepts(name, vocabulary(template)) == said


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("CAB", {"upperstructure"}),
        ("Gegengewicht", {"upperstructure"}),
        ("发动机", {"upperstructure"}),
        ("blade", {"blade"}),
        ("Bulldozer.001", {"blade"}),
        ("sprocet", {"sprocket"}),
        ("L\u00f6ffelstiel", {"arm"}),
        ("Stielzylinder", {"arm", "cylinder"}),
        ("balancier", {"arm"}),
        ("斗杆油缸缸筒", {"arm", "cylinder", "barrel"}),
        ("アームシリンダ", {"arm", "cylinder"}),
    ],
)
def test_a_template_says_what_its_bodies_are_called(digger: Template, name: str, said: set[str]) -> None:
    assert concepts(name, vocabulary(digger)) == said


@pytest.mark.parametrize(
    ("kind", "name", "said"),
    [
        ("forklift", "forklift truck.007", set()),
        ("forklift", "Forklift", set()),
        ("forklift", "Gabelstapler", set()),
        ("forklift", "Forklift_Fork", {"carriage"}),
        ("telehandler", "Forklift", {"carriage", "lift"}),
        ("excavator", "挖掘机动臂", {"boom"}),
        ("excavator", "Excavator_Arm", {"arm"}),
        ("excavator", "Baggerstiel", {"arm"}),
        ("wheel_loader", "wheelLoader", set()),
        ("wheel_loader", "loader arm", {"boom"}),
    ],
)
def test_what_the_machine_is_called_tells_no_part(kind: str, name: str, said: set[str]) -> None:
    assert concepts(name, vocabulary(load_template(kind))) == said


def test_what_most_assemblies_are_called_tells_none_of_them(digger: Template) -> None:
    """Assemblies of a `digger` that is all of the machine; of a digger beside a boom and an arm it is the bucket."""
    groups = ("digger_inside", "digger_outside", "digger_shell", "digger_rest", "digger_boom")
    scores = name_scores(tuple(part("Cube", group) for group in groups), digger)
    assert scores[:4] == [{}] * 4
    assert max(scores[4], key=lambda b: scores[4][b]) == "boom"
    tracks = ("Bottom", "Belt", "BeltLayer1", "BeltLayer004", "Roller")
    assert all("undercarriage" in of for of in name_scores(tuple(part("Cube", group) for group in tracks[:4]), digger))
    told = name_scores(tuple(part("Cube", group) for group in ("digger", "boom", "stick", "chassis", "cab")), digger)
    assert max(told[0], key=lambda b: told[0][b]) == "bucket"


def test_role_names_are_words(template: Template) -> None:
    """A template without words.json: its own role names, and the words of any machine."""
    bare = vocabulary(template.__class__("crane", "", "mast", template.roles[1:3], ()))
    assert concepts("REAR FRAME", bare) == {"rear", "frame"}
    assert concepts("Zylinder", bare) == {"cylinder"}


def test_sides_and_ends_exclude_each_other(template: Template) -> None:
    words = vocabulary(template)

    def score(name: str, role: str) -> float:
        return likeness(spoken([name], words), role_concepts(template.role(role)))

    assert score("boom piston rod left", "boom_piston_rod_l") > 0.9
    assert score("boom piston rod right", "boom_piston_rod_l") == 0.0
    assert score("boom cylinder rod", "boom_cylinder_barrel_l") == 0.0
    assert score("rear wheel", "front_wheel_l") == 0.0
    assert score("rear left", "rear_wheel_l") == 0.0  # a place is no name
    assert score("rear", "rear_wheel_l") == score("front", "rear_frame") == 0.0
    assert score("Front", "front_frame") > 0.6


def test_the_assembly_above_counts_less(template: Template) -> None:
    scores = name_scores((part("boom"), part("cover", "boom"), part("bucket", "boom"), part("x")), template)
    assert scores[0]["boom"] == 1.5
    assert 0.5 < scores[1]["boom"] < 1.0
    assert scores[2]["bucket"] == 1.5
    assert 0.3 < scores[2]["boom"] < 0.8
    assert scores[3] == {}


def test_robot_descriptions_call_every_body_a_link(digger: Template) -> None:
    """`bucket_link` of a robot description is its bucket, `link4` has no name; elsewhere a link is one."""
    robot = tuple(part(name) for name in ("base_link", "boomLink", "ARM_LINK", "bucket_link", "link4", "blink"))
    assert [p.name for p in described(robot)] == ["base", "boom", "ARM", "bucket", "", "blink"]
    scores = name_scores(robot, digger)
    assert max(scores[3], key=lambda b: scores[3][b]) == "bucket"
    assert scores[4] == {}
    meshes = [(f"{name}_mesh", name) for name in ("base", "boom", "arm", "bucket")]
    plain = name_scores(tuple(part(mesh, link) for mesh, link in meshes), digger)
    assert name_scores(tuple(part(mesh, f"{link}_link") for mesh, link in meshes), digger) == plain
    drawn = tuple(part(name) for name in ("bucket link", "tipping link", "boom", "arm", "bucket", "cab"))
    assert described(drawn) == drawn
    assert max(found := name_scores(drawn, digger)[0], key=lambda b: found[b]) == "bucket_link"


def test_what_hangs_on_a_part_bears_its_name_only_in_part(template: Template) -> None:
    """An animated model's cylinder hangs on the boom that carries it; a cover lies in the boom's assembly."""
    parts = (
        part("boom", "machine"), part("Mesh012", "machine", "boom"), part("bucket", "machine", "boom"),
        part("Mesh013", "machine", "boom", "Mesh012"), part("Mesh014", "machine", "arm assy"),
    )  # fmt: skip
    assert borne_by_others(parts, template) == {1, 3}


def test_what_holds_everything_says_nothing(template: Template) -> None:
    parts = (part("x1", "BUCKET TRUCK"), part("x2", "BUCKET TRUCK"))
    assert name_scores(parts, template) == [{}, {}]


def test_exact_names(template: Template) -> None:
    roles = exact_roles(template)
    assert exact_role(part("Boom Pin"), roles) == "boom_pin"
    assert exact_role(part("boom_pin_2"), roles) == "boom_pin"
    assert exact_role(part("boom_pinion"), roles) is None


def test_scores_name_the_body(template: Template) -> None:
    scores = name_scores((part("boom_pin"), part("BUCKET SIDE PLATE"), part("Solid1")), template)
    assert max(scores[0], key=lambda b: scores[0][b]) == template.body_of("boom_pin")
    assert max(scores[1], key=lambda b: scores[1][b]) == "bucket"
    assert scores[2] == {}


def test_a_word_that_many_names_have_says_less(digger: Template) -> None:
    """Exporters put assemblies before parts' names: they say where a part is, not what."""
    stem = "upperstructure"
    names = [f"{stem} {rest}" for rest in ("boom", "arm", "bucket", "hood")] + ["boom", "arm", "track shoe", "idler"]
    scores = dict(zip(names, name_scores(tuple(part(n) for n in names), digger), strict=True))
    assert max(scores[f"{stem} boom"], key=lambda b: scores[f"{stem} boom"][b]) == "boom"
    assert scores[f"{stem} boom"]["boom"] > 2 * scores[f"{stem} boom"].get("upperstructure", 0.0)


def test_collision_meshes() -> None:
    names = [
        "Boom",
        "UCX_Boom_01",
        "Bucket",
        "Col_Bucket_Floor_mesh",
        "Column",
        "Cab-convcolonly",
        "Collar",
        "Vol_Cavity",
        "VolvoCab",
    ]
    found = collision_parts([part(n) for n in names])
    assert found == {"UCX_Boom_01", "Col_Bucket_Floor_mesh", "Cab-convcolonly", "Vol_Cavity"}
    assert collision_parts([part("Boom", "Colliders"), part("Arm")]) == {"Boom"}
    assert not collision_parts([part(f"Col_{k}") for k in range(9)])


def test_features_that_a_cad_program_names_solids_after_say_nothing() -> None:
    """A body that was moved is no chassis, a mirrored one no mirror."""
    features = ["BODY-MOVECOPY43", "SCALE24", "MIRROR144", "Boss-Extrude81", "SPLIT141", "Move_Face6", "Cut-Extrude2"]
    assert unnamed([*features, "Boom", "Rear mirror", "Bucket_Base", "track pad"]) == set(features)
    assert unnamed(["Mirror", "Shell", "Body"]) == set()


def test_names_of_modelling_tools_say_nothing(digger: Template) -> None:
    """A cylinder beside cubes and planes is a primitive, a cylinder beside booms is a hydraulic one."""
    tools = ["Cube.002", "Cylinder.003", "pCylinder12", "polySurface7", "Mesh_0_lambert1", "Box (3)"]
    assert unnamed([*tools, "Boom", "hydraulic cylinder", "Cylinder boom"]) == set(tools)
    assert unnamed(["Cylinder 1", "Boom", "Body2"]) == set()
    assert name_scores((part("Cube.001"), part("Cylinder.004")), digger) == [{}, {}]
    assert "boom_cylinder_barrel" in name_scores((part("Boom"), part("Cylinder.004")), digger)[1]


@pytest.mark.parametrize(("name", "bodies"), [
    ("BottomPart", {"undercarriage"}),
    ("Base1", {"undercarriage", "upperstructure"}),
    ("Boom cylinder bottom", {"boom_cylinder_barrel", "boom_piston_rod"}),
    ("Track base left", {"track_shoe_l"}),
])  # fmt: skip
def test_vague_words_speak_where_nothing_else_does(digger: Template, name: str, bodies: set[str]) -> None:
    said = name_scores((part(name), part("x")), digger)[0]
    assert {b for b, score in said.items() if score == max(said.values())} == bodies


@pytest.mark.parametrize(("name", "body"), [
    ("Стрела экскаватора", "boom"), ("рукоять", "arm"), ("КОВШ", "bucket"),
    ("гидроцилиндр стрелы", "boom_cylinder_barrel"),
    ("버킷", "bucket"), ("붐_실린더", "boom_cylinder_barrel"),
    ("benna", "bucket"), ("cacamba", "bucket"), ("Kepçe", "bucket"),
    ("łyżka", "bucket"),
])  # fmt: skip
def test_names_in_further_languages(digger: Template, name: str, body: str) -> None:
    (found,) = name_scores((part(name),), digger, digger)
    assert found
    assert found[body] == max(found.values())


@pytest.mark.parametrize("name", ["машина", "Скорость", "программа"])
def test_words_of_spaced_scripts_are_no_part_of_others(digger: Template, name: str) -> None:
    """A machine (машина) is no tyre (шина), a speed no pin (ось), a program no frame (рама)."""
    assert name_scores((part(name),), digger, digger) == [{}]


def test_upper_and_lower_arms_are_boom_and_arm_whichever(digger: Template) -> None:
    upper, lower = name_scores((part("UpperArm"), part("bn_LowerArm")), digger, digger)
    for found in (upper, lower):
        assert found["boom"] == found["arm"] == max(found.values())
        assert not found.keys() & {"upperstructure", "undercarriage"}


def test_what_carries_a_part_does_not_name_it(digger: Template) -> None:
    """Bones in bones: an arm is below the boom in the tree, and no part of an assembly called boom."""
    bones = (part("Boom", "b_Boom"), part("Holder", "b_Boom", "b_Arm"), part("Arm", "b_Boom", "b_Arm"))
    _, holder, arm = name_scores(bones, digger, digger)
    assert "boom" not in arm
    assert "boom" not in holder
    assert holder["arm"] > 0.3
    chinese = (part("Plate 7", "动臂总成", "板"), part("挖斗"))
    assert name_scores(chinese, digger, digger)[0]["boom"] > 0.25  # 板 says nothing, and is nobody's own
    assembly = (part("Plate 7", "BOOM_ASM"), part("Rod", "BOOM_ASM", "CYLINDER"), part("Bucket"))
    plate, rod, _ = name_scores(assembly, digger, digger)
    assert plate["boom"] > 0.3
    assert rod["boom_piston_rod"] == max(rod.values())


def test_body_may_be_a_trucks_chassis_or_what_it_dumps() -> None:
    """Artists call the largest mesh so; it was the dump body, with a container beside it."""
    words = vocabulary(load_template("rigid_dump_truck"))
    assert concepts("Body.002", words) == {"chassis", "dump", "body"}
    assert concepts("Dumping_Container", words) == concepts("DUMP BODY", words) == {"dump", "body"}


def test_what_stands_before_every_name_is_the_machines() -> None:
    """`DumperTruck_Body` was the dump body, and the truck back to front: 79 % of the surface, no joint; now 100 %."""
    template = load_template("rigid_dump_truck")
    truck = [part(f"DumpTruckX_{name}") for name in ("Body", "Cargo", "Wheel1", "Wheel2")]
    plain = [part(name) for name in ("Body", "Cargo", "Wheel1", "Wheel2")]
    assert name_scores(tuple(truck), template) == name_scores(tuple(plain), template)
    two = tuple(part(f"DumpTruckX_{name}") for name in ("Body", "Wheel"))
    assert name_scores(two, template) != name_scores(tuple(part(name) for name in ("Body", "Wheel")), template)


def test_names_of_any_letters_lose_their_first_words_or_keep_them(digger: Template) -> None:
    """A name with line breaks before its words had no end."""
    odd = ("Machine\n\nBoom", "\n\nMachine Arm", "Machine größe 1", "Machine_\u52a8\u81c2 bucket")
    assert len(name_scores(tuple(part(name) for name in odd), digger)) == len(odd)


def test_a_side_before_every_name_is_a_side(digger: Template) -> None:
    named = tuple(part(f"left {name}") for name in ("track frame", "boom cylinder", "sprocket"))
    assert max(name_scores(named, digger)[1], key=name_scores(named, digger)[1].__getitem__).endswith("_l")


def test_the_name_of_a_mesh_that_is_the_machine_tells_none_of_its_solids() -> None:
    """All solids of a mesh `Cylinder.009` were half a mast's cylinder: 74 % of a forklift's surface, 93 % nameless."""
    template = load_template("forklift")
    solids = tuple(Part(f"{k}", "Cylinder.009", ("TOP",), "", np.eye(4)) for k in range(30))
    assert not any(name_scores(solids, template))
    assert all(name_scores((*solids, part("chassis")), template))


def test_a_lever_may_be_in_the_cab(digger: Template) -> None:
    (said,) = name_scores((part("Lever_01"),), digger)
    assert set(said) == {"tipping_link", "bucket_link", "upperstructure"}
    assert said["tipping_link"] > said["upperstructure"]
