"""The rigid dump truck's template: mobility, and which of its twins follow."""

from __future__ import annotations

import pytest

from yellowiron import library
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("rigid_dump_truck")


def test_it_moves_as_it_should(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    # Steering by one tie rod, body, four wheels, and those of the two further axles that the lint takes.
    assert [(m.computed, m.expected) for m in report.mobility] == [(10, 10)] * 2


def test_one_cylinder_pushes_as_the_other_pulls_to_steer(template: Template) -> None:
    cylinders = {a.name: [(c.sign, c.passive) for c in a.cylinders] for a in template.actuators}
    assert cylinders["steering"] == [(1, False), (-1, True)]
    assert cylinders["hoist"] == [(1, False), (1, True)]


@pytest.mark.parametrize(("drive", "driven"), [("rear", True), ("none", False)])
def test_only_the_rear_wheels_are_driven(template: Template, drive: str, driven: bool) -> None:
    chosen = choose(template, {"wheel_drive": drive})
    for side in "lr":
        assert (chosen.joint(f"rear_wheel_{side}_joint").drive is not None) is driven
        assert chosen.joint(f"front_wheel_{side}_joint").drive is None
