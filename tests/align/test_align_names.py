"""What names say: languages, typos, abbreviations, truncation; and what they do not."""

from __future__ import annotations

import numpy as np
import pytest

from yellowiron.align.names import concepts, exact_role, exact_roles, likeness, name_scores, role_concepts, tokens
from yellowiron.library import load_template
from yellowiron.model.assembly import Part
from yellowiron.model.template import Template


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


def part(name: str, *above: str) -> Part:
    return Part(name, name, ("TOP", *above), "", np.eye(4))


def test_tokens() -> None:
    assert tokens("BUCKET_LinkPin-04 Ø90 gr\u00fcn") == ["bucket", "link", "pin", "gr\u00fcn".replace("\u00fc", "u")]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("BUKCET_LINK", {"bucket", "link"}),
        ("HYDRUALIC_CYL", {"cylinder"}),
        ("sprocet", {"sprocket"}),
        ("LIFT CYL ROD EYE", {"boom", "cylinder", "rod"}),
        ("FRT FRAME LH", {"front", "frame", "left"}),
        ("Hubzylinder Kolbenstange li", {"boom", "cylinder", "piston", "rod", "left"}),
        ("v\u00e9rin de levage", {"boom", "cylinder"}),
        ("cuchar\u00f3n", {"bucket"}),
        ("左动臂油缸活塞杆", {"left", "boom", "cylinder", "piston", "rod"}),
        ("バケットシリンダロッド", {"bucket", "cylinder", "rod"}),
        ("Solid17", set()),
        ("Part_003", set()),
        ("", set()),
    ],
)
def test_concepts(name: str, said: set[str]) -> None:
    assert concepts(name) == said


def test_sides_and_ends_exclude_each_other() -> None:
    left = role_concepts("boom_piston_rod_l")
    assert likeness(part("boom piston rod left"), left) > 0.9
    assert likeness(part("boom piston rod right"), left) == 0.0
    assert likeness(part("rear wheel"), role_concepts("front_wheel_l")) == 0.0


def test_the_assembly_above_counts_less() -> None:
    boom = role_concepts("boom")
    assert likeness(part("boom"), boom) > likeness(part("cover boom plate hub"), boom) > 0
    assert 0 < likeness(part("Solid3", "BOOM ASSY"), boom) <= likeness(part("boom"), boom)


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
