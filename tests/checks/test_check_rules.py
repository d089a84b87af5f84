"""A rule is added by writing it: one function in a topic's module."""

from __future__ import annotations

import types
from pathlib import Path

import pytest

from yellowiron import checks
from yellowiron.checks import check
from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.rules import RULES, rules_of
from yellowiron.checks.view import View

SOUND = Path(__file__).parents[1] / "data" / "check" / "sound.usda"


@rule("CHK999", "info", "Name it after a letter of the alphabet.")
def hinge_names(view: View) -> Remarks:
    """A hinge's name has no letter."""
    for joint in view.joints:
        if joint.type == "revolute":
            yield joint.path, f"It is called '{joint.name}'."


def test_a_function_under_the_decorator_is_a_rule(monkeypatch: pytest.MonkeyPatch) -> None:
    topic = types.ModuleType("topic")
    vars(topic).update(helper=len, hinge_names=hinge_names)
    monkeypatch.setattr(checks.rules, "RULES", (*RULES, *rules_of([topic])))
    found = [f for f in check(SOUND) if f.code == "CHK999"]
    assert found and {f.hint for f in found} == {"Name it after a letter of the alphabet."}
    assert hinge_names.meaning == "A hinge's name has no letter."


def test_no_two_rules_share_a_code_and_topics_come_in_order() -> None:
    codes = [r.code for r in RULES]
    assert len(codes) == len(set(codes))
    assert codes == sorted(codes)
