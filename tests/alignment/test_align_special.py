"""Special variants, which go with some choices of others only: they neither come first nor raise the bar for others."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import pytest

from yellowiron.alignment.assignment.search import _by_cylinders, variants_of
from yellowiron.alignment.features.pinless_pivots import has_drilled_pivots
from yellowiron.alignment.features.solids import Solid
from yellowiron.library import load_template
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("excavator")


def test_a_swing_boom_is_special(template: Template) -> None:
    assert template.special() == {("boom_type", "swing")}
    assert load_template("skid_steer").special() == frozenset()


def _drilled(template: Template, holes: int) -> bool:
    hole = SimpleNamespace(inner=True, full=True, radius=0.005, half=0.01)
    return has_drilled_pivots((cast("Solid", SimpleNamespace(cylinders=[hole] * holes)),), template, 1.0)


def test_special_hinges_do_not_raise_what_a_common_machine_must_show(template: Template) -> None:
    common = [j for j in template.joints if "swing" not in j.when.get("boom_type", ()) or "mono" in j.when["boom_type"]]
    common = [j for j in common if j.type == "revolute"]
    assert sum(j.type == "revolute" for j in template.joints) > len(common)
    assert not _drilled(template, len(common) - 1)
    assert _drilled(template, len(common))


def test_common_machines_are_tried_before_special_ones(template: Template) -> None:
    def swings(chosen: dict[str, Any]) -> bool:
        return bool(chosen["boom_type"] == "swing")

    variants = variants_of(template, {})
    groups = _by_cylinders(variants, template, 4)
    assert [len({swings(c) for c in group}) for group in groups] == [1] * len(groups)
    assert not any(map(swings, groups[0])) and all(map(swings, groups[1]))
    assert {sum(r.kind == "barrel" for r in choose(template, c).roles) for c in (*groups[0], *groups[1])} == {4}
    assert sorted(map(str, variants)) == sorted(str(c) for group in groups for c in group)
    plain = replace(template, variants=tuple(replace(v, needs={}) for v in template.variants))
    assert any(map(swings, _by_cylinders(variants, plain, 4)[0]))
