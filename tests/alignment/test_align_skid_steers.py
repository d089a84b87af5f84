"""Unseen skid steers without names: every part in its body, whichever way they lift."""

from __future__ import annotations

import pytest

from kit.machines.skid_steers import skid_steer
from kit.machines.unseen import found_whole


@pytest.mark.slow
@pytest.mark.parametrize("triangles", [False, True])
@pytest.mark.parametrize(
    ("seed", "path", "single"),
    [(201, "vertical", False), (202, "radial", False), (203, "vertical", True), (204, "radial", True)],
)
def test_every_part_is_in_its_body(seed: int, path: str, single: bool, triangles: bool) -> None:
    machine = skid_steer(seed, path, single_tilt=single)
    found = found_whole(machine, "skid_steer", seed, triangles=triangles)
    assert found.choices == {"lift_path": path, "tilt_cylinders": "single" if single else "twin"}
