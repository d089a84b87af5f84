"""Unseen graders without names: every part in its body, the frame straight though wheels lean and are steered; the cab
before and behind the articulation, cylinders in gimbals and on studs, with a ripper and without."""

from __future__ import annotations

import pytest

from kit.machines.graders import grader
from kit.machines.unseen import found_whole


@pytest.mark.parametrize(
    ("seed", "behind", "gimbals", "ripper"),
    [
        (501, False, True, True),
        pytest.param(502, True, False, False, marks=pytest.mark.slow),
        pytest.param(503, True, True, True, marks=pytest.mark.slow),
    ],
)
def test_every_part_is_in_its_body(seed: int, behind: bool, gimbals: bool, ripper: bool) -> None:
    machine = grader(seed, cab_behind=behind, gimbals=gimbals, ripper=ripper)
    found = found_whole(machine, "grader", seed, triangles=False)
    assert found.choices == {"ripper": "fitted" if ripper else "none"}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [501, 502])
def test_so_it_is_from_triangles(seed: int) -> None:
    found_whole(grader(seed), "grader", seed, triangles=True)


def test_wheels_that_are_drawn_steered_do_not_turn_the_frame() -> None:
    """All wheels before the articulation are steered: left is from one kingpin to the other, though they lean."""
    machine = grader(4)
    turned = {p.id: p.transform[:3, 2] for p in machine.parts if machine.truth[p.id][0] == "front_tyre_l"}
    assert all(abs(way[0]) > 0.25 for way in turned.values())
    found_whole(machine, "grader", 4, triangles=False)
