"""Every joint type moves as it does by hand, and every collision token comes to rest where it says, in every engine."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from in_engines import EVERY, load, need

from kit.machines import simple_machines as simple
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.engine import Base, Setup, poses
from yellowiron.simulation.ground import Block
from yellowiron.simulation.registry import ENGINES
from yellowiron.usd.planning.collision import APPROXIMATIONS

BLOCK = Block((0.0, 0.0), length=0.3, width=1.0, height=0.2, run=0.05)
"""Under the arch: one with an opening stands astride of it, one that is filled stands on it."""

HOLLOW = {
    "mujoco": {"convexDecomposition", "triangleMesh", "meshSimplification", "sdf", "sphereFill"},
    "newton": {"convexDecomposition"},
    "physx": {"convexDecomposition", "sdf", "sphereFill"},
}
"""Tokens whose openings stay open; on moving bodies the others are their hull there (docs/concept-mapping.md)."""


def play(engine: str, mechanism: Mechanism, file: Path, base: Base, seconds: float, body: str) -> np.ndarray:
    """A body's places (steps + 1, 3)."""
    step = ENGINES[engine].timestep
    blocks = (BLOCK,) if base == "floating" else ()
    loaded = load(engine, Setup(file, mechanism, base, step, (), standing=(body,), blocks=blocks))
    number = [b.name for b in mechanism.bodies].index(body)
    try:
        places = [poses(loaded)[1][number]]
        for _ in range(round(seconds / step)):
            loaded.step()
            places.append(poses(loaded)[1][number])
    finally:
        loaded.close()
    return np.array(places)


@pytest.mark.parametrize("engine", EVERY)
@pytest.mark.parametrize("kind", ["revolute", "spherical", "fixed"])
def test_pendulums_swing_in_their_period(kind: str, engine: str, tmp_path: Path) -> None:
    mechanism = simple.with_joint(kind)
    bob = play(engine, mechanism, simple.write(tmp_path, mechanism), "fixed", simple.PERIOD, "bob")
    start, half, end = (bob[n] - np.array(simple.PIN) for n in (0, len(bob) // 2, -1))
    swing = simple.LENGTH * math.sin(simple.SWING)
    assert half[:2] == pytest.approx(-start[:2], abs=0.05 * swing)
    assert end[:2] == pytest.approx(start[:2], abs=0.05 * swing)
    assert np.linalg.norm(bob - simple.PIN, axis=1) == pytest.approx(simple.LENGTH, abs=1e-4)


@pytest.mark.parametrize("engine", EVERY)
def test_a_sprung_slide_sags_by_weight_over_stiffness(engine: str, tmp_path: Path) -> None:
    mechanism = simple.with_joint("prismatic")
    weight = play(engine, mechanism, simple.write(tmp_path, mechanism), "fixed", 2.0, "bob")
    assert weight[-1] - weight[0] == pytest.approx((0.0, 0.0, -simple.MASS * simple.G / simple.STIFFNESS), abs=1e-4)


@pytest.mark.parametrize("engine", EVERY)
def test_a_tethered_weight_falls_until_its_tether_is_taut(engine: str, tmp_path: Path) -> None:
    """PhysX's tether gives by 25 mm, its own tolerance; Newton has none, which is said."""
    need(engine)
    mechanism = simple.with_joint("distance")
    file = simple.write(tmp_path, mechanism)
    if engine == "newton":
        with pytest.raises(YellowironError, match="no distance joints"):
            play(engine, mechanism, file, "fixed", 0.1, "bob")
        return
    weight = play(engine, mechanism, file, "fixed", 2.0, "bob")
    assert weight[-1] - weight[0] == pytest.approx((0.0, 0.0, -simple.REACH), abs=0.026)
    assert weight[round(0.2 / ENGINES[engine].timestep)][2] - weight[0][2] == pytest.approx(-0.196, abs=0.01)  # g·t²/2


@pytest.mark.parametrize("engine", EVERY)
@pytest.mark.parametrize("token", list(APPROXIMATIONS))
def test_an_arch_rests_at_the_height_its_token_says(token: str, engine: str, tmp_path: Path) -> None:
    mechanism, assembly = simple.arch(token)
    height = play(engine, mechanism, simple.write(tmp_path, mechanism, assembly), "floating", 1.5, "arch")[-1][2]
    if token == "none":
        assert height < -1.0
    elif token == "boundingSphere":
        radius = 0.5 * float(np.linalg.norm(simple.SIZE))
        assert height == pytest.approx(BLOCK.height + radius - 0.5 * simple.SIZE[2], abs=0.08)  # Newton's is larger
    else:
        assert height == pytest.approx(0.0 if token in HOLLOW[engine] else BLOCK.height, abs=0.025)
