"""Machines with two steered axles, built with every steering mode: which way their wheels turn in MuJoCo."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from in_engines import load

from kit.builds import MadeOnce
from kit.machines.backhoes import backhoe
from kit.machines.drawn_examples import drawn_example, steered_example
from kit.machines.synthetic import disguise
from kit.machines.yoke_rollers import yoke_roller
from yellowiron import usd
from yellowiron.alignment import align
from yellowiron.kinematics import measure
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.mechanism import Actuator, Mechanism
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import choose
from yellowiron.pipeline import Machine
from yellowiron.simulation import drive
from yellowiron.simulation.engine import Setup, poses
from yellowiron.simulation.registry import ENGINES
from yellowiron.stages import complete_mechanism

pytestmark = pytest.mark.slow

EXAMPLES = {"telehandler": "two", "mobile_crane": "working"}
BUILT = [("telehandler", "front"), ("telehandler", "all"), ("telehandler", "crab"), ("mobile_crane", "front"),
         ("mobile_crane", "all")]  # fmt: skip
"""The modes are one module's: on a carrier that is both axles' body one of them tells."""
PUSHED = 0.03
"""Metres that a lever draws the rod: ten degrees and more at these knuckles."""


@pytest.fixture(scope="module", params=BUILT, ids="_".join)
def steered(request: pytest.FixtureRequest, made_once: MadeOnce) -> tuple[str, Machine]:
    """A steering mode, and an example built with it."""
    name, mode = request.param
    return mode, steered_example(name, drawn_example(name, made_once, EXAMPLES[name]), made_once, mode)


def test_wheels_turn_the_way_the_mode_says(steered: tuple[str, Machine]) -> None:
    mode, machine = steered
    assert [f for f in machine.mechanism.findings if f.severity != "info"] == []
    rear = next(c for c in machine.mechanism.cylinders if c.name == "rear_steering_cylinder")
    assert rear.passive is (mode != "front") and rear.rod_diameter is not None
    _assert_turned(mode, machine.mechanism, machine.usd)


@pytest.fixture(scope="module")
def backhoe_loader() -> tuple[Assembly, Alignment]:
    """One with a steered rear axle, drawn by the generator of unseen ones, without names; the example's is fast."""
    assembly, truth, _ = disguise(backhoe(501, all_steer=True), 501)
    found = align(assembly, load_template("backhoe_loader"), Specifications())
    assert found.choices["rear_axle"] == "steered" and not found.missing
    assert [p.part for p in found.parts if p.body != truth[p.part][1]] == []
    return assembly, found


@pytest.mark.parametrize("mode", ["front", "all"])
def test_a_backhoe_loader_with_a_steered_rear_axle(
    mode: str, backhoe_loader: tuple[Assembly, Alignment], tmp_path: Path
) -> None:
    assembly, found = backhoe_loader
    chosen = choose(load_template("backhoe_loader"), {**found.choices, "steering_mode": mode})
    mechanism = complete_mechanism(assembly, chosen, found, Specifications())
    usd.write_machine(mechanism, assembly, tmp_path, name="machine", frame=found.frame)
    _assert_turned(mode, mechanism, tmp_path / "machine.usda")


@pytest.fixture(scope="module")
def yokes() -> tuple[Assembly, Alignment]:
    """A tandem roller whose drums steer in yokes, drawn straight by the generator of unseen ones, without names."""
    assembly, truth, back = disguise(yoke_roller(601, straight=True), 601)
    found = align(assembly, load_template("roller"), Specifications())
    assert found.choices["steered_by"] == "yokes" and not found.missing
    assert [p.part for p in found.parts if p.body != truth[p.part][1]] == []
    assert (found.frame[:3, :3] @ back[:3, :3].T)[0, 0] > 0.999
    return assembly, found


TURNS = {"front": (1, 0), "all": (1, -1), "crab": (1, 1)}
"""Mode → which way the front and the rear drum turn as the steering moves to the left."""


@pytest.mark.parametrize("mode", TURNS)
def test_a_tandem_roller_with_drums_in_yokes(mode: str, yokes: tuple[Assembly, Alignment], tmp_path: Path) -> None:
    """Which way each drum turns; that the machine goes where the mode says, by the drive of MuJoCo; the crab's offset
    by where the drums then stand."""
    assembly, found = yokes
    weight = Specifications({"operating weight": Specification("Operating Weight", 12_000.0, "kg", "ok")})
    chosen = choose(load_template("roller"), {**found.choices, "steering_mode": mode})
    mechanism = complete_mechanism(assembly, chosen, found, weight)
    assert [f.code for f in mechanism.findings if f.severity != "info" and f.code not in ("MEC023", "MEC032")] == []
    usd.write_machine(mechanism, assembly, tmp_path, name="machine", frame=found.frame)
    file = tmp_path / "machine.usda"
    levers = {a.name: a for a in mechanism.actuators if "steering" in a.name}
    assert set(levers) == ({"steering", "rear_steering"} if mode == "front" else {"steering"})
    turned = _turned(mechanism, file, levers["steering"], PUSHED, of="yoke")
    for end, way in zip(("front_yoke", "rear_yoke"), TURNS[mode], strict=True):
        assert way * turned[end] > 2.5 if way else abs(turned[end]) < 0.05, turned
    if mode == "front":
        own = _turned(mechanism, file, levers["rear_steering"], PUSHED, of="yoke")
        assert own["rear_yoke"] < -2.5 and abs(own["front_yoke"]) < 0.05, own
    trip = drive(file, engine="mujoco")
    measured = {m.name: m for m in measure(mechanism)}
    if mode == "crab":
        assert trip.crab == pytest.approx(trip.crab_geometry, abs=np.radians(2.0)) and trip.crab > 0.4
        # Neither drum's heading is the other's: the cylinders are single, one comes out as the other goes in.
        base, offset = measured["Wheelbase"].model, measured["Crab Offset"].model
        assert base is not None and offset is not None
        assert np.arcsin(offset / base) == pytest.approx(trip.crab_geometry, abs=np.radians(6.0))
        assert "Turning Radius" not in measured
    else:
        assert trip.turning_radius == pytest.approx(trip.geometry_radius, rel=0.055)
        assert "Crab Offset" not in measured


def _assert_turned(mode: str, mechanism: Mechanism, file: Path) -> None:
    """Every wheel turns the way that the mode says, and holds where it should."""
    levers = {a.name: a for a in mechanism.actuators if "steering" in a.name}
    assert set(levers) == ({"steering", "rear_steering"} if mode == "front" else {"steering"})
    left = _turned(mechanism, file, levers["steering"], PUSHED)
    assert all(angle > 5.0 for end, angle in left.items() if end.startswith("front")), left
    rear = [angle for end, angle in left.items() if end.startswith("rear")]
    if mode == "front":
        assert np.abs(rear).max() < 0.05
        own = _turned(mechanism, file, levers["rear_steering"], PUSHED)
        assert all((angle < -5.0) if end.startswith("rear") else abs(angle) < 0.05 for end, angle in own.items()), own
    else:
        way = -1.0 if mode == "all" else 1.0
        assert all(way * angle > 5.0 for angle in rear), left
        # Both axles have one linkage. Crabbing, the wheels of a side stay parallel; where all steer, the rear rod goes
        # the other way, and so the one on the left does what the one on the right does in front.
        for side, other in ("lr", "rl"):
            ahead = left[f"front_knuckle_{side}"] if mode == "crab" else -left[f"front_knuckle_{other}"]
            assert left[f"rear_knuckle_{side}"] == pytest.approx(ahead, abs=0.2), left


def _turned(mechanism: Mechanism, file: Path, lever: Actuator, by: float, *, of: str = "knuckle") -> dict[str, float]:
    """Degrees to the left by which each knuckle, `front_knuckle_l` and so on, or what else is called so, has turned
    after its lever, in metres of the rod, came to rest."""
    (joint,) = lever.joints
    step = ENGINES["mujoco"].timestep
    loaded = load("mujoco", Setup(file, mechanism, "fixed", step, (joint.joint,)))
    try:
        ramp = joint.sign * by * np.clip(np.arange(1, round(4.0 / step)) * step / 2.0, 0.0, 1.0)
        for _ in loaded.targets((joint.joint,), ramp[:, None]):
            loaded.step()
        rotations, _ = poses(loaded)
    finally:
        loaded.close()
    names = [body.name for body in mechanism.bodies]
    return {
        name if name[0] in "fr" else f"front_{name}": float(np.degrees(np.arctan2(*rotations[k, (1, 0), 0])))
        for k, name in enumerate(names)
        if of in name
    }
