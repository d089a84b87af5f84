"""A machine that lies in rings of track shoes, in every engine: the rings stay closed and it goes where they roll."""

from __future__ import annotations

from pathlib import Path

import in_engines
import numpy as np
import pytest

from kit.machines.crawler import crawler, of_steel
from kit.machines.tracked_template import write_tracked_template
from yellowiron.kinematics import complete
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.mechanism import chained
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose
from yellowiron.simulation import simulate
from yellowiron.simulation.driving.wheel import pitch_radius
from yellowiron.simulation.engine import Setup, poses, tell
from yellowiron.simulation.ground import standing_bodies
from yellowiron.simulation.registry import import_engine, load_engine
from yellowiron.simulation.strokes.held import held_machine
from yellowiron.usd import read_mechanism, write_machine

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("rings")
    drawn = crawler(24, 3, 1)
    template = load_template(write_tracked_template(folder / "template"))
    aligned = drawn.aligned(shoes=True)
    chosen = expand(choose(template, {"tracks": "shoes"}), aligned.counts)
    mechanism = of_steel(build_mechanism(drawn.assembly(), chosen, aligned, Specifications(), name="crawler"))
    return Path(write_machine(complete(mechanism), drawn.assembly(), folder / "out", name="crawler")[0])


@pytest.mark.parametrize(("engine", "dt"), [("mujoco", 1e-3), ("physx", 1.0 / 120.0), ("newton", 1e-3)])
def test_rings_hold_and_roll(file: Path, engine: str, dt: float) -> None:
    in_engines.need(engine)
    import_engine(engine)
    mechanism = read_mechanism(file)
    shoes = chained(mechanism)
    standing = standing_bodies(mechanism)
    assert shoes < set(standing) and {"sprocket_l", "idler_r"} < set(standing) and mechanism.root not in standing
    sprockets = [j for j in mechanism.joints if j.body1.startswith("sprocket")]
    radius = pitch_radius(mechanism, sprockets[0])
    assert radius is not None
    loaded = load_engine(engine, Setup(file, mechanism, "floating", dt, (), standing=standing))
    number = {b.name: k for k, b in enumerate(mechanism.bodies)}
    try:
        drawn = np.array([b.origin for b in mechanism.bodies])
        assert np.abs(poses(loaded)[1] - drawn).max() < 1e-4
        for _ in range(round(0.2 / dt)):
            tell(loaded, {j.name: 1.0 for j in sprockets})
            loaded.step()
        rotations, origins = poses(loaded)
    finally:
        loaded.close()
    went = origins - drawn
    # This sprocket's hull has no gaps for the pins: they are pressed into it, and PhysX pushes them out at once.
    if engine != "physx":
        assert went[number[mechanism.root]] == pytest.approx([0.2 * radius, 0.0, 0.0], abs=0.1 * radius)
    for joint in mechanism.joints:
        if joint.body0 in shoes:
            ends = [
                origins[n] + rotations[n] @ (np.asarray(joint.anchor) - drawn[n])
                for n in (number[joint.body0], number[joint.body1])
            ]
            assert np.linalg.norm(ends[0] - ends[1]) < 0.02, joint.name


def test_a_sprocket_without_its_ring_keeps_its_speed(file: Path) -> None:
    """On a fixed base the rings are left out; the sprockets turn as heavily as with them."""
    result = simulate(file, engine="mujoco", actuators=["travel_left"])
    assert not result.findings
    held, changed = held_machine(file, "fixed")
    mechanism = read_mechanism(file)
    assert [b.name for b in changed] == ["sprocket_l", "sprocket_r"] and not held.floating
    shoes = sum(b.mass for b in mechanism.bodies if b.name in chained(mechanism)) / 2.0
    radius = pitch_radius(mechanism, mechanism.joint("undercarriage2sprocket_l_joint"))
    assert radius is not None
    more = changed[0].inertia - mechanism.body("sprocket_l").inertia
    assert np.diag(more) == pytest.approx(shoes * radius**2 * np.array([0.5, 1.0, 0.5]))
