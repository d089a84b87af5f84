"""Unseen backhoe loaders without names: every part in its body, whichever linkage tilts the loader's bucket and whether
the dipper extends."""

from __future__ import annotations

import pytest

from kit.machines.backhoes import backhoe
from kit.machines.unseen import found_whole
from yellowiron import library
from yellowiron.alignment.assignment.search import EACH, EFFORT, Search
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(("seed", "parallel", "extending"), [(610, True, True), (611, True, False), (612, False, True)])
def test_every_part_is_in_its_body(seed: int, parallel: bool, extending: bool, triangles: bool) -> None:
    machine = backhoe(seed, parallel=parallel, extending=extending)
    found = found_whole(machine, "backhoe_loader", seed, triangles=triangles)
    assert found.choices["rear_axle"] == "fixed"


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "triangles"), [(613, False), (614, True), (615, False)])
def test_a_steered_rear_axle_is_told_from_a_fast_one(seed: int, triangles: bool) -> None:
    found = found_whole(backhoe(seed, all_steer=True), "backhoe_loader", seed, triangles=triangles)
    assert found.choices["rear_axle"] == "steered"


def test_a_type_of_many_joints_may_take_more_of_the_solver_s_time() -> None:
    def allowed(name: str) -> tuple[float, float]:
        search = Search(
            lambda _: pytest.fail("nothing is looked at"), library.load_template(name), Specifications(), {}, {}
        )
        return search._effort.left, search._effort.each

    assert allowed("skid_steer") == allowed("wheel_loader") == (EFFORT, EACH)
    assert allowed("backhoe_loader")[1] > 3.0 * EACH
