"""The user's own documents: the conference paper's four, naming CAD parts or roles, and the filled joint template."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron import library
from yellowiron.library.notation.validated_json import Document
from yellowiron.library.parsing.axes import read_axis
from yellowiron.model.alignment import Alignment, PartAssignment, Vector
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import TemplateError
from yellowiron.model.finding import Finding
from yellowiron.model.specification import Evidence, Specification, Specifications
from yellowiron.model.template import Template, choose

DATA = Path(__file__).resolve().parent.parent / "data" / "templates" / "documents"
FOUR = [DATA / f"json{n}.json" for n in ("1_materials", "2_collision", "3_relations", "4_joints")]


@pytest.fixture(scope="module")
def loader() -> Template:
    return library.load_template("wheel_loader")


@pytest.fixture(scope="module")
def assembly() -> Assembly:
    """The conference paper's bucket: a body and six bolts, one of them there twice, and a part that nothing names."""
    names = ["Bucket Body", *(f"bucket bolt{i}" for i in range(1, 7)), "bucket bolt6", "Solid17"]
    parts = tuple(Part(f"M/{name}#{i}", name, ("M",), "s", np.eye(4)) for i, name in enumerate(names))
    return Assembly("M", "step", 0.001, parts, {})


def test_the_papers_four_documents_name_parts_and_roles(loader: Template, assembly: Assembly) -> None:
    found = library.load_documents(FOUR, loader, assembly)
    assert found.findings == ()
    bolts = tuple(f"bucket bolt{i}" for i in range(1, 7))
    assert found.relations == {"bucket": ("Bucket Body", *bolts)}
    assert found.materials["Bucket Body"].density == 7850.0
    assert {found.materials[b].name for b in bolts} == {"bolt steel"}
    assert found.collision == {"Bucket Body": "convexDecomposition", "bucket bolt1": "none", "boom_pin": "analytic"}
    assert found.folders == (str(DATA),)


def test_joints_of_a_document_are_merged_or_added(loader: Template, assembly: Assembly) -> None:
    found = library.load_documents(FOUR, loader, assembly)
    template = library.apply_joints(loader, found)
    before, after = loader.joint("boom2bucket_joint"), template.joint("boom2bucket_joint")
    assert (after.parts, after.type, after.lower) == (before.parts, before.type, before.lower)
    assert (after.stiffness, after.damping, after.max_force, after.max_velocity) == (1000.0, 200.0, 5e4, 1.5)
    added = template.joint("bucket_tip_joint")
    assert (added.type, added.parts) == ("fixed", ("bucket", "rocker"))
    assert [j.name for j in template.joints][:-1] == [j.name for j in loader.joints]


def test_a_joint_says_which_document_stated_it(loader: Template, assembly: Assembly, tmp_path: Path) -> None:
    slide = "bucket_piston_rod2bucket_cylinder_barrel_joint"
    (tmp_path / "mine.json").write_text(json.dumps({slide: {"Limit": [0, 0.5]}, "boom2bucket_joint": {"damping": 5}}))
    template = library.apply_joints(loader, library.load_documents([*FOUR, tmp_path / "mine.json"], loader, assembly))
    assert template.joint(slide).documents == {"limit": "mine.json"}
    assert template.joint("bucket_tip_joint").documents == {"joint": "json4_joints.json"}
    assert template.joint("boom2bucket_joint").documents == {}
    for lower, upper in ((0, 0), (0.5, 0), ("0 m", "-764 mm"), ("0 m", "1e999 m")):
        (tmp_path / "mine.json").write_text(json.dumps({slide: {"Limit": [lower, upper]}}))
        with pytest.raises(TemplateError):
            library.load_documents([tmp_path / "mine.json"], loader)


def test_order_of_documents_does_not_matter_across_kinds(loader: Template, assembly: Assembly) -> None:
    forwards, backwards = (library.load_documents(o, loader, assembly) for o in (FOUR, FOUR[::-1]))
    assert (forwards.joints, forwards.relations, forwards.collision) == (
        backwards.joints, backwards.relations, backwards.collision,
    )  # fmt: skip


def test_later_documents_win(loader: Template, assembly: Assembly, tmp_path: Path) -> None:
    (tmp_path / "mine.json").write_text('{"boom_pin": "none"}')
    found = library.load_documents([DATA / "json2_collision.json", tmp_path / "mine.json"], loader, assembly)
    assert found.collision["boom_pin"] == "none"


def test_names_that_match_nothing_are_findings(loader: Template) -> None:
    found = library.load_documents(FOUR, loader, None)
    assert {f.code for f in found.findings} == {"DOC001", "DOC002"}
    assert "bucket_tip_joint" not in found.joints
    assert found.collision == {"boom_pin": "analytic"}
    assert all(f.where for f in found.findings)
    near = next(f for f in found.findings if "'bucket body'" in f.message)
    assert near.severity == "warning"


def test_an_empty_document_is_a_finding(loader: Template) -> None:
    assert [f.code for f in library.load_documents([DATA / "nothing.json"], loader).findings] == ["DOC003"]


def test_a_leader_that_is_no_body_is_a_finding(loader: Template, assembly: Assembly, tmp_path: Path) -> None:
    (tmp_path / "r.json").write_text('{"Solid17": ["bucket bolt1"]}')
    found = library.load_documents([tmp_path / "r.json"], loader, assembly)
    assert [f.code for f in found.findings] == ["DOC004"]
    (tmp_path / "r.json").write_text('{"Solid17": ["bucket bolt1"], "boom": ["Solid17"]}')
    found = library.load_documents([tmp_path / "r.json"], loader, assembly)
    assert found.relations == {"boom": ("Solid17", "bucket bolt1")}


def test_a_document_adds_no_body_and_says_where_one_is_added(
    loader: Template, assembly: Assembly, tmp_path: Path
) -> None:
    (tmp_path / "j.json").write_text('{"door_joint": {"joint_type": "Revolute", "Body": ["rear_frame", "Solid17"]}}')
    (tmp_path / "r.json").write_text('{"Solid17": ["Solid17"]}')
    found = library.load_documents([tmp_path / "r.json", tmp_path / "j.json"], loader, assembly)
    assert [f.code for f in found.findings] == ["DOC004", "DOC002"] and found.joints == {}
    for finding in found.findings:
        assert "templates copy" in finding.hint and "mean Solid17" not in finding.hint
    (tmp_path / "r.json").write_text('{"bukket": ["Solid17"]}')
    (typo,) = library.load_documents([tmp_path / "r.json"], loader, assembly).findings
    assert "mean bucket" in typo.hint


def test_relations_take_patterns_and_ids(loader: Template, assembly: Assembly, tmp_path: Path) -> None:
    (tmp_path / "r.json").write_text('{"bucket": ["bucket bolt*"], "boom": ["M/Solid17#8"]}')
    found = library.load_documents([tmp_path / "r.json"], loader, assembly)
    assert found.findings == ()
    assert found.relations == {"bucket": tuple(f"bucket bolt{i}" for i in range(1, 7)), "boom": ("Solid17",)}
    assert [f.body for f in found.followers] == ["bucket"] * 7 + ["boom"]


@pytest.mark.parametrize("name", ["none_of_the_four", "mixed"])
def test_other_documents_are_refused(name: str, loader: Template) -> None:
    with pytest.raises(TemplateError, match="none that --data knows") as caught:
        library.load_documents([DATA / f"{name}.json"], loader)
    assert caught.value.where.endswith(f"{name}.json")
    assert "materials" in caught.value.hint


def test_a_list_is_no_document(loader: Template, tmp_path: Path) -> None:
    (tmp_path / "list.json").write_text("[1, 2]")
    with pytest.raises(TemplateError):
        library.load_documents([tmp_path / "list.json"], loader)


def test_a_new_joint_needs_type_and_bodies(loader: Template, tmp_path: Path) -> None:
    (tmp_path / "j.json").write_text('{"new_joint": {"stiffness": 1.0}}')
    with pytest.raises(TemplateError, match="'joint_type' is missing"):
        library.load_documents([tmp_path / "j.json"], loader)
    (tmp_path / "j.json").write_text(
        '{"new_joint": {"joint_type": "Fixed", "Body": ["boom", "rocker"], "Drive": "linear"}}'
    )
    with pytest.raises(TemplateError, match="cannot have a drive"):
        library.load_documents([tmp_path / "j.json"], loader)


@pytest.mark.parametrize(
    ("entry", "density", "elasticity"),
    [
        ({"density": "1200 kg/m3", "elasticity": "210 GPa"}, 1200.0, 2.1e11),
        ({"density": "7.85 g/cm^3", "elasticity": "2e5 N/mm²"}, 7850.0, 2e11),
        ({"density": "0.0785e5", "elasticity": 1e6}, 7850.0, 1e6),
        ({"density": "1.2 t/m³"}, 1200.0, None),
    ],
)
def test_density_and_elasticity_may_carry_a_unit(
    entry: dict[str, object], density: float, elasticity: float | None, loader: Template, tmp_path: Path
) -> None:
    (tmp_path / "m.json").write_text(json.dumps({"boom": entry}))
    material = library.load_documents([tmp_path / "m.json"], loader).materials["boom"]
    assert material.density == pytest.approx(density, rel=1e-12)
    assert material.elasticity == (None if elasticity is None else pytest.approx(elasticity, rel=1e-12))


@pytest.mark.parametrize(
    "density", ["heavy", "1200 kg", "1200 bananas", "-5 kg/m3", "0 kg/m3", "1e999 kg/m3", -7900, True, "7 kg/m3 m3("]
)
def test_a_density_that_is_none_is_refused(density: object, loader: Template, tmp_path: Path) -> None:
    (tmp_path / "m.json").write_text(json.dumps({"boom": {"density": density}}))
    with pytest.raises(TemplateError) as caught:
        library.load_documents([tmp_path / "m.json"], loader)
    assert "density" in caught.value.where


def test_a_texture_must_be_there(loader: Template, tmp_path: Path) -> None:
    (tmp_path / "m.json").write_text('{"boom": {"texture": "paint.png"}}')
    with pytest.raises(TemplateError, match=r"paint\.png"):
        library.load_documents([tmp_path / "m.json"], loader)
    (tmp_path / "paint.png").write_bytes(b"\x89PNG")
    assert library.load_documents([tmp_path / "m.json"], loader).materials["boom"].texture == "paint.png"


# ---- alignment -------------------------------------------------------------------------------------------------------
def test_relations_place_parts_and_a_persons_edits_win(loader: Template, assembly: Assembly) -> None:
    found = library.load_documents(FOUR, loader, assembly)
    placed = library.with_relations(None, found)
    assert placed is not None
    assert [p.part for p in placed.parts] == [p.id for p in assembly.parts[:-1]]
    assert {(p.role, p.body, p.source) for p in placed.parts} == {("bucket", "bucket", "data")}

    edit = PartAssignment(assembly.parts[1].id, "boom", "boom", 1.0, "set by a person", "edited")
    both = library.with_relations(Alignment("wheel_loader", np.eye(4), (edit,)), found)
    assert both is not None
    assert {p.part: p.role for p in both.parts}[edit.part] == "boom"
    assert len(both.parts) == len(assembly.parts) - 1


def test_without_relations_edits_stay_as_they_are(loader: Template) -> None:
    nothing = library.load_documents([], loader)
    assert library.with_relations(None, nothing) is None


def test_a_follower_with_a_pins_name_keeps_the_pins_role(loader: Template, tmp_path: Path) -> None:
    (tmp_path / "r.json").write_text('{"bucket": ["bucket_pin", "shell"]}')
    parts = tuple(Part(name, name, (), "s", np.eye(4)) for name in ("bucket_pin", "shell"))
    found = library.load_documents([tmp_path / "r.json"], loader, Assembly("M", "step", 1.0, parts, {}))
    assert [(f.part, f.role, f.body) for f in found.followers] == [
        ("bucket_pin", "bucket_pin", "bucket"), ("shell", "bucket", "bucket"),
    ]  # fmt: skip


# ---- the filled joint template --------------------------------------------------------------------------------
def _specifications(**values: float) -> Specifications:
    evidence = Evidence("sheet.pdf", 2, "Stroke 764 mm")
    return Specifications(
        {
            n.replace("_", " "): Specification(n.replace("_", " "), v, "m", "ok", evidence=evidence)
            for n, v in values.items()
        }
    )


def test_filled_joints_have_numbers_for_names_and_say_where_from(loader: Template) -> None:
    template = choose(loader, {})
    filled = library.filled_joints(template, None, _specifications(Lift_Cylinder_Stroke=0.764))
    lift = filled["boom_cylinder_barrel_l2boom_piston_rod_l_joint"]
    assert lift["Limit"] == ["0 m", "0.764 m"]
    assert lift["source"] == {"Lift Cylinder Stroke": 'sheet.pdf, page 2: "Stroke 764 mm"'}
    assert filled["bucket_piston_rod2bucket_cylinder_barrel_joint"]["Limit"] == ["0 m", "Tilt Cylinder Stroke"]
    assert filled["rear_frame2rear_axle_joint"]["Limit"] == ["-13 deg", "13 deg"]
    assert list(filled) == [j.name for j in template.joints]


def test_filled_joints_are_taken_back(loader: Template, tmp_path: Path) -> None:
    for choices in ({}, {"lift_cylinders": "single", "wheel_drive": "rear"}):
        template = choose(loader, choices)
        specifications = _specifications(
            Lift_Cylinder_Stroke=0.764, Tilt_Cylinder_Stroke=0.54, Steering_Cylinder_Stroke=0.441
        )
        path = tmp_path / "joints.filled.json"
        path.write_text(json.dumps(library.filled_joints(template, None, specifications)))
        found = library.load_documents([path], loader)
        assert found.findings == ()
        back = choose(library.apply_joints(loader, found), choices)
        assert [j.name for j in back.joints] == [j.name for j in template.joints]
        assert [(j.parts, j.drive, j.free) for j in back.joints] == [
            (j.parts, j.drive, j.free) for j in template.joints
        ]
        assert back.joint("bucket_piston_rod2bucket_cylinder_barrel_joint").upper == 0.54
        again = library.filled_joints(back, None, specifications)
        plain = library.filled_joints(template, None, specifications)
        assert {n: {k: v for k, v in e.items() if k != "source"} for n, e in plain.items()} == again


def test_a_filled_template_is_a_template_of_its_own(loader: Template, tmp_path: Path) -> None:
    folder = library.copy_template("wheel_loader", tmp_path / "mine")
    for path in folder.glob("*.json"):
        path.unlink()
    filled = library.filled_joints(choose(loader, {}), None, Specifications())
    (folder / "joints.json").write_text(json.dumps(filled))
    alone = library.load_template(folder)
    assert library.lint(alone).counts["revolute"] == 21
    assert alone.root == "rear_frame"
    pins = [r.name for r in alone.roles if r.kind == "pin"]
    assert {p: alone.body_of(p) for p in pins} == {p: loader.body_of(p) for p in pins}
    assert library.lint(alone).sound


# ---- where a joint is -----------------------------------------------------------------------------------------
def _axes(entry: dict[str, object], loader: Template, folder: Path) -> tuple[np.ndarray, np.ndarray]:
    (folder / "j.json").write_text(json.dumps({"boom2bucket_joint": entry}))
    found = library.load_documents([folder / "j.json"], loader)
    point, direction = found.axes["boom2bucket_joint"]
    return np.array(point), np.array(direction)


def test_a_joint_is_where_a_document_says(loader: Template, tmp_path: Path) -> None:
    point, direction = _axes({"anchor": [1, 2, 3], "axis": [0, 5, 0]}, loader, tmp_path)
    assert point.tolist() == [1, 2, 3] and direction.tolist() == [0, 1, 0]
    point, direction = _axes({"through": [[0, 0, 1], [0, 2, 1]]}, loader, tmp_path)
    assert point.tolist() == [0, 1, 1] and direction.tolist() == [0, 1, 0]


@settings(max_examples=50, deadline=None)
@given(
    middle=st.tuples(*[st.floats(-20, 20)] * 3),
    radius=st.floats(0.01, 2.0),
    turns=st.tuples(st.floats(0.0, 0.5), st.floats(1.0, 2.5), st.floats(3.0, 5.5)),
    lean=st.floats(0.0, 3.1),
)
def test_three_points_of_a_circle_give_its_axis(
    middle: tuple[float, float, float], radius: float, turns: tuple[float, float, float], lean: float
) -> None:
    u, v = np.array([np.cos(lean), 0.0, np.sin(lean)]), np.array([0.0, 1.0, 0.0])
    points = [(np.array(middle) + radius * (np.cos(t) * u + np.sin(t) * v)).tolist() for t in turns]
    document = Document(Path("j.json"), {})
    found = read_axis(document, "a_joint", {"through": points}, "revolute")
    assert found is not None
    assert np.linalg.norm(np.array(found[0]) - middle) < 1e-7 * (1 + radius)
    assert abs(np.array(found[1]) @ np.cross(u, v)) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize(("entry", "words"), [
    ({"anchor": [0, 0, 0]}, "an anchor and no axis"),
    ({"axis": [0, 1, 0]}, "an axis and no anchor"),
    ({"anchor": [0, 0, 0], "axis": [0, 0, 0]}, "no length"),
    ({"through": [[0, 0, 0], [0, 1, 0], [0, 2, 0]]}, "one line"),
    ({"through": [[0, 0, 0], [0, 0, 0]]}, "no length"),
    ({"through": [[0, 0, 0], [0, 1, 0]], "axis": [0, 1, 0]}, "beside through"),
])  # fmt: skip
def test_half_an_axis_is_refused(entry: dict[str, object], words: str, loader: Template, tmp_path: Path) -> None:
    with pytest.raises(TemplateError, match=words):
        _axes(entry, loader, tmp_path)


def test_a_given_axis_is_no_estimate(loader: Template) -> None:
    joint, other = "boom2bucket_joint", loader.joints[0].name
    guessed: dict[str, tuple[Vector, Vector]] = dict.fromkeys((joint, other), ((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    found = Alignment(
        "wheel_loader", np.eye(4), (), axes=guessed, across={joint: 0.01, other: 0.02},
        findings=tuple(Finding("ALN016", "warning", j, "estimated", "") for j in (joint, other)),
    )  # fmt: skip
    given_ = library.Documents(axes={joint: ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))})
    after = library.with_axes(found, given_)
    assert after.axes == {**guessed, **given_.axes}
    assert after.across == {other: 0.02}
    assert [f.where for f in after.findings] == [other]
    assert after.by_hand == {joint}
