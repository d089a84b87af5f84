"""Unseen graders without names: every part in its body; the cab before and behind the articulation, cylinders in
gimbals or on studs, with a ripper or none."""

from __future__ import annotations

import pytest

from kit.machines.graders import grader
from kit.machines.unseen import found_whole


@pytest.mark.slow
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
