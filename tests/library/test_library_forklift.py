"""The forklift's template: mobility and names under every kind of mast."""

from __future__ import annotations

import pytest

from yellowiron import library
from yellowiron.model.template import Template, choose


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template("forklift")


def test_it_moves_as_it_should_with_every_mast(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    computed = {(m.choices["mast"], m.choices["wheel_drive"]): m.computed for m in report.mobility}
    # Lift, tilt, steering, two driven and two trailing wheels, the axle; and the free lift.
    for mast, expected in {"single": 8, "simplex": 8, "duplex": 9, "triplex": 9}.items():
        assert computed[mast, "front"] == computed[mast, "none"] == expected


def test_chains_lift_by_their_masts(template: Template) -> None:
    follows = {
        mast: {
            j.name: (j.follows.joint, j.follows.ratio)
            for j in choose(template, {"mast": mast}).joints
            if j.follows is not None
        }
        for mast in ("single", "simplex", "duplex", "triplex")
    }
    free = {"inner_mast2carriage_free_joint": ("inner_mast2free_lift_crosshead_joint", 2.0)}
    assert follows["single"] == {}
    assert follows["simplex"] == {"inner_mast2carriage_joint": ("outer_mast2inner_mast_joint", 1.0)}
    assert follows["duplex"] == free
    assert follows["triplex"] == free | {"middle_mast2inner_mast_joint": ("outer_mast2middle_mast_joint", 1.0)}


def test_a_mast_s_cylinders_are_asked_for_by_its_own_names(template: Template) -> None:
    def stroke(mast: str) -> str:
        lift = next(a for a in choose(template, {"mast": mast}).actuators if a.name == "lift")
        return lift.specifications["stroke"]

    assert stroke("simplex") == stroke("duplex") == "Lift Cylinder Stroke"
    assert stroke("triplex") == "Second Lift Cylinder Stroke"


def test_every_mast_has_one_measurement_of_a_name(template: Template) -> None:
    for mast in ("single", "simplex", "duplex", "triplex"):
        names = [m.name for m in choose(template, {"mast": mast}).measurements]
        assert len(names) == len(set(names))
        assert "Lift Height" in names and ("Free Lift Height" in names) == (mast in ("duplex", "triplex"))
