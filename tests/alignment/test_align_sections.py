"""Sections of a boom or a mast: a name tells which of several a thing is only beside the others."""

from __future__ import annotations

import numpy as np
import pytest

from yellowiron.alignment.assignment.names import name_scores, sections_of
from yellowiron.alignment.fusion.evidence import _NUMBERED
from yellowiron.library import load_template
from yellowiron.model.assembly import Part
from yellowiron.model.template import choose


@pytest.mark.parametrize("name", ["BoomSection4", "boom_2", "Mast 03", "boom.5"])
def test_what_is_numbered_is_one_of_several(name: str) -> None:
    """ "BoomSection4", the only one left of four, was the boom without a word: 4.6 % of a crane."""
    assert _NUMBERED.search(name)


@pytest.mark.parametrize("name", ["Boom", "boom_1", "Boom.004", "Object_571", "boom2_left", "cat 320"])
def test_what_a_tool_numbers_is_not(name: str) -> None:
    assert not _NUMBERED.search(name)


def test_sections_slide_on_each_other() -> None:
    crane = choose(load_template("mobile_crane"), {"sections": "three"})
    assert sections_of(crane) == (frozenset({"boom", "middle_boom", "inner_boom"}),)
    assert not sections_of(choose(load_template("excavator"), {}))


def test_numbered_sections_may_each_be_any() -> None:
    """A crane's `BoomSection2` to `BoomSection4` were the boom: 82 → 99 % of the surface, 2 → 5 of 5 joints."""
    crane = load_template("mobile_crane")
    names = ("BoomSection1", "BoomSection2", "BoomSection3", "CraneCab")
    said = name_scores(tuple(Part(n, n, (), "", np.eye(4)) for n in names), crane)
    assert all(len({s[b] for b in ("boom", "middle_boom", "inner_boom")}) == 1 for s in said[:3])
    assert "boom" not in said[3]
    (alone,) = name_scores((Part("b", "BoomSection1", (), "", np.eye(4)),), crane)
    assert alone["boom"] > alone["inner_boom"]
