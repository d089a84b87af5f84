"""Unseen rollers without names: every part in its body, on one drum and on two; what a drum is."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.defects import spoiled
from kit.machines.rollers import roller
from kit.machines.synthetic import disguise
from kit.machines.unseen import found_whole
from kit.machines.yoke_rollers import yoke_roller
from yellowiron import library
from yellowiron.alignment.features.solids import size_of, solids_of
from yellowiron.alignment.features.wheels import rolling_of
from yellowiron.alignment.readings import align
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(
    ("seed", "tandem", "twin"),
    [(601, True, True), (602, False, True), (603, True, False), (604, False, True), (605, False, False)],
)
def test_every_part_is_in_its_body(seed: int, tandem: bool, twin: bool, triangles: bool) -> None:
    machine = roller(seed, tandem=tandem, twin=twin)
    found = found_whole(machine, "roller", seed, triangles=triangles)
    assert found.choices == {
        "drums": "tandem" if tandem else "single", "steering_cylinders": "twin" if twin else "single",
        "steered_by": "articulation",
    }  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "triangles"), [(611, False), (612, False), (613, True)])
def test_drums_that_steer_in_yokes(seed: int, triangles: bool) -> None:
    """Both ends are built alike, and the drums stand at angles of their own: without names the machine is asked which
    end is its front, and stands straight all the same."""
    found = found_whole(yoke_roller(seed), "roller", seed, triangles=triangles)
    assert found.choices == {"drums": "tandem", "steered_by": "yokes", "steering_cylinders": "single"}
    assert "built alike" in found.facing_doubt and "ALN003" in {f.code for f in found.findings}
    named = align(yoke_roller(seed).assembly(), library.load_template("roller"), Specifications())
    assert named.facing_doubt == ""


@pytest.mark.parametrize("seed", [1100, 1103])
def test_a_drum_that_ends_in_plates_without_bores_turns_in_what_it_touches(seed: int) -> None:
    assembly, truth, _ = disguise(spoiled("roller", seed, "visual"), seed)
    found = align(assembly, library.load_template("roller"), Specifications())
    assert [(truth[p.part], p.body) for p in found.parts if p.body != truth[p.part][1]] == []


@pytest.mark.slow
def test_a_drum_plays_no_wheel_and_a_wheel_no_drum() -> None:
    """Of a machine that lacks a steering cylinder hardly a joint is found, and still not two drums."""
    assembly, truth, _ = disguise(spoiled("roller", 1100, "missing cylinder"), 1100)
    found = align(assembly, library.load_template("roller"), Specifications())
    assert found.choices["drums"] == "single"
    assert {p.body for p in found.parts if truth[p.part][1] == "front_drum"} == {"front_drum"}


@pytest.mark.parametrize(("tandem", "bodies"), [(True, ["drum", "drum"]), (False, ["drum", "wheel", "wheel"])])
def test_a_drum_is_wide_and_all_that_is_in_it_is_of_it(tandem: bool, bodies: list[str]) -> None:
    assembly, truth, _ = disguise(roller(601, tandem=tandem), 601)
    solids = solids_of(assembly)
    found = rolling_of(solids, library.load_template("roller"), set(), 4e-5 * size_of(solids))
    names = [{truth[solids[i].part.id][1] for i in wheel.members} for wheel in found]
    assert all(len(name) == 1 for name in names)
    assert sorted(min(name).split("_")[1] for name in names) == bodies
    widths = [w.width / w.radius for w, name in zip(found, names, strict=True) if "drum" in min(name)]
    assert np.min(widths) > 1.5


@pytest.mark.slow
def test_other_types_know_no_drums() -> None:
    for name in library.list_templates():
        if name != "roller" and not library.is_sheet_only(name):
            assert not any(r.drum for r in library.load_template(name).roles), name
