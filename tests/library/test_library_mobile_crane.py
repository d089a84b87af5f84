"""The mobile crane's template: mobility in every variant, sections that follow by rope, the hook, the winch."""

from __future__ import annotations

import math

import pytest

from yellowiron import library
from yellowiron.alignment.assignment.weights import interchangeable
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("mobile_crane")


@pytest.mark.slow
def test_it_moves_as_it_should(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    for found in report.mobility:
        # Slewing, luffing, telescoping, steering, four wheels, eight of the outriggers; the rear wheels' steering
        # unless it follows; the hook's three ways to swing and its rope. The lint takes two further axles. Sections
        # that are pinned do not move, nor does a jib.
        expected = 20 + (found.choices["steering_mode"] == "front") + 4 * (found.choices["hoist"] == "hook")
        expected += 4 * (found.choices["jib_hook"] == "hook")
        expected -= found.choices["telescoping"] == "pinned"
        assert (found.computed, found.expected) == (expected, expected), found.choices
    # 108 without positions, three times as many with a jib's; 108 with pinned sections, as drawn and in three
    # positions. Those with a jib have a hook on it, or none.
    assert len(report.mobility) == 4 * 108 + 8 * 108 + 3 * 108 + 4 * 108


def test_pinned_sections_are_held_at_shares_of_a_stroke(template: Template) -> None:
    variants = {v.name: v for v in template.variants}
    assert variants["telescoping"].decided_by == variants["jib"].decided_by == "user"
    for name in ("second_section", "third_section", "fourth_section"):
        assert variants[name].choices == ("drawn", "46", "92", "100")
        chosen = choose(template, {"telescoping": "pinned", "sections": "four", name: "92"})
        assert chosen.joint(f"{name}_joint").at == "92 % of Telescoping Cylinder Stroke"
    assert not template.go_together({"telescoping": "pinned", "sections": "three"})
    held = choose(template, {"jib": "pinned", "jib_offset": "40"}).joint("jib_offset_joint")
    assert held.at == pytest.approx(math.radians(40.0)) and "jib" not in {r.name for r in choose(template, {}).roles}


@pytest.mark.parametrize(("sections", "count"), [("five", 5), ("six", 6)])
def test_a_boom_of_more_sections_is_pinned_by_the_same_words(template: Template, sections: str, count: int) -> None:
    assert not template.go_together({"telescoping": "rope", "pinned_sections": sections})
    names = [f"{each}_section" for each in ("second", "third", "fourth", "fifth", "sixth")[: count - 1]]
    chosen = choose(template, {"telescoping": "pinned", "pinned_sections": sections, **dict.fromkeys(names, "46")})
    held = [j for j in chosen.joints if j.at == "46 % of Telescoping Cylinder Stroke"]
    assert len(held) == count - 1
    # One after the other, from the outermost section to the one with the head.
    assert [a for _, a in (j.parts for j in held[:-1])] == [b for b, _ in (j.parts for j in held[1:])]
    assert (held[0].parts[0], held[-1].parts[1]) == ("boom", "inner_boom")


@pytest.mark.parametrize(("sections", "followers"), [("two", 0), ("three", 1), ("four", 2)])
def test_inner_sections_follow_by_rope(template: Template, sections: str, followers: int) -> None:
    chosen = choose(template, {"sections": sections})
    follows = [j.follows for j in chosen.joints if j.follows is not None and j.follows.kind == "rope"]
    assert len(follows) == followers and all(f.ratio == 1.0 for f in follows)


def test_a_winch_moves_the_hook_and_is_no_cylinder(template: Template) -> None:
    winch = next(a for a in template.actuators if a.name == "hoist")
    assert winch.kind == "winch" and [c.sign for c in winch.cylinders] == [-1]
    assert set(winch.specifications) == {"line_pull", "line_speed", "falls"} == set(winch.defaults)
    hung = template.joint("inner_boom2hoist_rope_joint")
    assert hung.type == "spherical" and hung.free and hung.drive is None
    assert "hoist" not in {a.name for a in choose(template, {"hoist": "none"}).actuators}


def test_only_places_tell_its_axles_and_outriggers_apart(template: Template) -> None:
    """Both axles steer alike, and all four outriggers are alike: the joints do not say which is in front."""
    groups = interchangeable(choose(template, {}))
    assert {frozenset({f"front_{n}_{s}", f"rear_{n}_{s}"}) for n in ("knuckle", "wheel", "tie_rod") for s in "lr"} <= {
        *groups
    }
    assert frozenset({"front_outrigger_beam_l", "rear_outrigger_beam_l"}) in groups
    # A telehandler's axles are not alike: one oscillates.
    telehandler = choose(library.load_template("telehandler"), {})
    assert not any("front_knuckle_l" in group for group in interchangeable(telehandler))


def test_what_was_not_found_tells_no_axles_apart() -> None:
    """A telehandler's front axle is levelled by a cylinder: without that, both oscillate and steer alike."""
    levelled = choose(library.load_template("telehandler"), {"frame_levelling": "cylinder"})
    joints = {j.name for j in levelled.joints}
    found = {name for name in joints if "levelling" not in name}
    pair = frozenset({"front_axle", "rear_axle"})
    assert pair not in interchangeable(levelled, found=joints)
    assert pair in interchangeable(levelled, found=found)
