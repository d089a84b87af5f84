"""The library's excavator: sound in every set of choices, the papers' counts, names that say what they join."""

from __future__ import annotations

import itertools
import json
import math

import pytest

from yellowiron import library
from yellowiron.alignment.assignment.search import variants_of
from yellowiron.library.type_folders import library_folder
from yellowiron.model.errors import AlignmentError
from yellowiron.model.rows import expand, split_index
from yellowiron.model.specification import fold
from yellowiron.model.template import Template, choose

SHOES, ROLLERS, CARRIERS = 49, 9, 2
"""A side of a 20 t machine: what the papers' excavator of 142 joints has."""
COUNTS = {
    f"{row}_{side}": count
    for row, count in (("track_shoe", SHOES), ("track_roller", ROLLERS), ("carrier_roller", CARRIERS))
    for side in ("l", "r")
}


@pytest.fixture(scope="module")
def excavator() -> Template:
    return library.load_template("excavator")


def test_moves_as_expected_in_every_set_of_choices(excavator: Template) -> None:
    report = library.lint(excavator)
    assert [f.code for f in report.findings] == ["TPL014"]
    assert len(report.mobility) == 45
    for mobility in report.mobility:
        assert mobility.computed == mobility.expected, mobility.choices
        arms = 2 + (mobility.choices["boom_type"] != "mono") + (mobility.choices["blade"] != "none")
        loops = [g for g in mobility.groups if g.expected]
        assert len(loops) == arms + 1
        assert all((g.grubler, g.computed, g.undetermined) == (1, 1, 0) for g in loops), mobility.choices


def test_shoes_as_bodies_have_the_papers_counts(excavator: Template) -> None:
    """Journal paper: 138 revolute and 4 prismatic joints, 3 angular and 4 linear drives."""
    counts = library.lint(expand(choose(excavator, {"tracks": "shoes"}), COUNTS)).counts
    assert counts["revolute"] == 15 + 2 * (2 + ROLLERS + CARRIERS + SHOES) >= 138
    assert (counts["prismatic"], counts["linear_drives"], counts["angular_drives"]) == (4, 4, 3)


def test_a_belt_has_hidden_wheels_and_a_fixed_undercarriage_nothing_that_turns(excavator: Template) -> None:
    belt = expand(choose(excavator, {}), COUNTS)
    assert {a.name for a in belt.actuators} == {"swing", "boom", "arm", "bucket", "travel_left", "travel_right"}
    assert belt.body_of("track_shoe_l_7") == belt.body_of("sprocket_l") == belt.body_of("idler_r") == "undercarriage"
    left = next(a for a in belt.actuators if a.name == "travel_left")
    assert left.joints and all("track_wheel_l" in j for j in left.joints)
    fixed = expand(choose(excavator, {"tracks": "fixed"}), COUNTS)
    assert {a.name for a in fixed.actuators} == {"swing", "boom", "arm", "bucket"}
    assert not any("track" in j.name or "sprocket" in j.name for j in fixed.joints)


def test_pins_move_with_the_body_that_the_joint_name_says(excavator: Template) -> None:
    for joint in excavator.joints:
        first, _, second = split_index(joint.name)[0].removesuffix("_joint").partition("2")
        assert {split_index(b or "")[0] for b in excavator.bodies_of(joint)} == {first, second}, joint.name


def test_one_mesh_for_both_boom_cylinders_a_two_piece_boom_and_a_blade(excavator: Template) -> None:
    single = choose(excavator, {"boom_cylinders": "single"})
    boom = next(a for a in single.actuators if a.name == "boom")
    assert [c.slide for c in boom.cylinders] == ["boom_cylinder_barrel2boom_piston_rod_joint"]
    two = choose(excavator, {"boom_type": "two_piece"})
    arm = next(a for a in two.actuators if a.name == "arm")
    assert [c.barrel_joint for c in arm.cylinders] == ["adjust_boom2arm_cylinder_barrel_joint"]
    assert {a.name for a in two.actuators} >= {"adjust_boom"}
    with_blade = choose(excavator, {"blade": "fitted"})
    assert with_blade.body_of("blade_pin") == "undercarriage"
    assert {a.name for a in with_blade.actuators} - {a.name for a in choose(excavator, {}).actuators} == {"blade"}
    assert choose(excavator, {"blade": "twin"}).body_of("blade_piston_rod_r_pin") == "blade"


def test_a_swing_boom_hangs_on_a_bracket_that_its_cylinder_swings(excavator: Template) -> None:
    chosen = choose(excavator, {"boom_type": "swing", "boom_cylinders": "single", "blade": "fitted"})
    for pin in ("boom", "boom_cylinder_barrel"):
        assert chosen.body_of(f"swing_bracket_{pin}_pin") == "swing_bracket"
        assert not chosen.knows(f"{pin}_pin")
    assert chosen.body_of("swing_bracket_pin") == chosen.body_of("swing_cylinder_barrel_pin") == "upperstructure"
    levers = {a.name: a for a in chosen.actuators}
    assert levers.keys() == {"swing", "boom", "arm", "bucket", "boom_swing", "blade", "travel_left", "travel_right"}
    (cylinder,) = levers["boom"].cylinders
    assert cylinder.barrel_joint == "swing_bracket2boom_cylinder_barrel_joint"
    (fixed,) = (m for m in library.lint(excavator).mobility if m.choices == {
        "boom_type": "swing", "boom_cylinders": "single", "blade": "fitted", "tracks": "fixed"
    })  # fmt: skip
    assert fixed.computed == fixed.expected == 6


def test_a_swing_boom_has_one_boom_cylinder(excavator: Template) -> None:
    tried = variants_of(excavator, {})
    assert len(tried) == 15
    assert {c["boom_cylinders"] for c in tried if c["boom_type"] == "swing"} == {"single"}
    with pytest.raises(AlignmentError, match="boom_cylinders=twin, boom_type=swing") as caught:
        variants_of(excavator, {"boom_cylinders": "twin", "boom_type": "swing"})
    assert "needs" in caught.value.hint


def test_only_machines_with_a_swing_boom_or_blade_are_measured_and_asked_for_it(excavator: Template) -> None:
    plain = choose(excavator, {})
    swing = choose(excavator, {"boom_type": "swing", "boom_cylinders": "single", "blade": "twin"})
    more = {m.name for m in swing.measurements} - {m.name for m in plain.measurements}
    assert more == {
        "Boom Swing Angle Left", "Boom Swing Angle Right", "Blade Lift Height", "Blade Digging Depth", "Blade Width"
    }  # fmt: skip
    asked = {w.name for w in swing.wanted} - {w.name for w in plain.wanted}
    assert asked == {f"Boom Swing Cylinder {what}" for what in ("Stroke", "Bore", "Rod Diameter", "Closed Length")}


def test_everything_measured_and_driven_is_asked_for(excavator: Template) -> None:
    asked = {fold(w.name) for w in excavator.wanted}
    assert {fold(m.specification) for m in excavator.measurements} <= asked
    named = {fold(n) for a in excavator.actuators for n in a.specifications.values()}
    assert named <= asked
    for name in (
        "Maximum Digging Depth", "Maximum Reach at Ground Line", "Maximum Reach", "Maximum Digging Height",
        "Maximum Dumping Height", "Minimum Dumping Height", "Maximum Vertical Wall Digging Depth",
        "Maximum Digging Depth 2.44 m Level Bottom", "Tail Swing Radius", "Minimum Swing Radius", "Overall Length",
        "Overall Width", "Overall Height", "Track Gauge", "Track Length", "Ground Clearance", "Counterweight Clearance",
    ):  # fmt: skip
        assert any(m.name == name for m in excavator.measurements), name


def test_wanted_values_say_where_and_in_six_languages(excavator: Template) -> None:
    for wanted in excavator.wanted:
        assert wanted.use and wanted.where, wanted.name
        assert wanted.minimum is not None and wanted.maximum is not None and wanted.minimum < wanted.maximum
        if wanted.in_label_of is None:
            assert set(wanted.synonyms) == {"en", "de", "fr", "es", "zh", "ja"}, wanted.name
    makers = {w.name: w.synonyms["en"] for w in excavator.wanted if w.synonyms}
    assert {"stick cylinder stroke", "dipper cylinder stroke", "crowd cylinder stroke"} <= set(
        makers["Arm Cylinder Stroke"]
    )


def test_defaults_are_si_and_say_whose_they_are(excavator: Template) -> None:
    swing = next(a for a in excavator.actuators if a.name == "swing")
    assert swing.defaults["speed"] == pytest.approx(11.0 * 2.0 * math.pi / 60.0)
    assert all(a.source for a in excavator.actuators)


def test_every_role_has_a_material_and_a_collider_with_sources(excavator: Template) -> None:
    assert {r.name for r in excavator.roles} <= set(excavator.materials) & set(excavator.collision)
    document = json.loads((library_folder() / "excavator" / "materials.json").read_text(encoding="utf-8"))
    for key, entry in document.items():
        said = " ".join(entry["source"])
        numbers = ("density", "elasticity", "friction", "restitution")
        assert "all" in said or all(n in said for n in numbers), key


@pytest.mark.parametrize("name", ["boom_pin", "arm_pin", "bucket_pin", "bucket_tip"])
def test_sites_are_there_in_every_set_of_choices(excavator: Template, name: str) -> None:
    (site,) = (s for s in excavator.sites if s.name == name)
    variants = {v.name: v.choices for v in excavator.variants}
    for values in itertools.product(*variants.values()):
        choices = dict(zip(variants, values, strict=True))
        if not excavator.go_together(choices):
            continue
        chosen = choose(excavator, choices)
        rule = site.rule.get("joint", site.rule.get("edge_from"))
        joints = (rule,) if isinstance(rule, str) else rule
        assert {j.name for j in chosen.joints} & set(joints)
