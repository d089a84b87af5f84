"""A machine on springs in every engine: it stands as drawn, and gives way to a load by its weight over the springs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from in_engines import EVERY, load

from kit.machines import sprung
from yellowiron.model.geometry import Floats
from yellowiron.simulation.engine import Setup
from yellowiron.simulation.ground import standing_bodies
from yellowiron.usd import read_mechanism

STEP = {"mujoco": 0.001, "newton": 0.001, "physx": 1.0 / 120.0}
AS_DRAWN = {"mujoco": 1e-5, "newton": 1e-5, "physx": 3e-4}
"""Metres: at rest, PhysX's contacts give way by a few tenths of a millimetre."""
LOAD, AHEAD = 500.0 * 9.81, 1.0
"""Newtons on the frame above the front wheels."""


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return sprung.write(tmp_path_factory.mktemp("sprung"))


def run(file: Path, engine: str, base: str, force: float = 0.0) -> Floats:
    """Coordinates of the springs' joints over two seconds."""
    mechanism = read_mechanism(file)
    standing = standing_bodies(mechanism)
    setup = Setup(file, mechanism, base, STEP[engine], sprung.SPRINGS, standing=standing)  # type: ignore[arg-type]
    loaded = load(engine, setup)
    states = []
    for _ in range(round(2.0 / STEP[engine])):
        if force:
            loaded.push("frame", np.array([0.0, 0.0, -force]), np.array([AHEAD, 0.0, 1.0]))
        loaded.step()
        states.append(loaded.state())
    coordinates = loaded.read(states).coordinates
    loaded.close()
    return coordinates


@pytest.mark.parametrize("engine", EVERY)
@pytest.mark.parametrize("base", ["floating", "fixed"])
def test_it_stays_as_drawn(file: Path, engine: str, base: str) -> None:
    coordinates = run(file, engine, base)
    assert np.abs(coordinates).max() < 1e-3
    assert np.abs(coordinates[-1]).max() < AS_DRAWN[engine]


@pytest.mark.parametrize("engine", EVERY)
def test_it_gives_way_by_the_load_over_the_springs(file: Path, engine: str) -> None:
    sunk = 0.5 * LOAD / sprung.STIFFNESS
    assert run(file, engine, "floating", LOAD)[-1] == pytest.approx([sunk, sunk], rel=0.01, abs=AS_DRAWN[engine])
