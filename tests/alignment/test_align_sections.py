"""Sections of a boom or a mast: a name tells which of several a thing is only beside the others."""

from __future__ import annotations

import pytest

from yellowiron.alignment.fusion.evidence import _NUMBERED
from yellowiron.alignment.fusion.reading import _sections
from yellowiron.library import load_template
from yellowiron.model.template import choose


@pytest.mark.parametrize("name", ["BoomSection4", "boom_2", "Mast 03", "boom.5"])
def test_what_is_numbered_is_one_of_several(name: str) -> None:
    """"BoomSection4", the only one left of four, was the boom without a word: 4.6 % of a crane."""
    assert _NUMBERED.search(name)


@pytest.mark.parametrize("name", ["Boom", "boom_1", "Boom.004", "Object_571", "boom2_left", "cat 320"])
def test_what_a_tool_numbers_is_not(name: str) -> None:
    assert not _NUMBERED.search(name)


def test_sections_slide_on_each_other() -> None:
    crane = choose(load_template("mobile_crane"), {"sections": "three"})
    assert {"boom", "middle_boom", "inner_boom"} <= _sections(crane)
    assert not _sections(choose(load_template("excavator"), {}))
