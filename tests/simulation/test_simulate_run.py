"""The run, in MuJoCo on a small machine, and with engines that are right or wrong on purpose."""

from __future__ import annotations

import math
import sys
import types
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import numpy as np
import pytest

from yellowiron.kinematics import ClosedChain, State
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation import rated_payload, simulate, simulation_document, watch
from yellowiron.simulation import registry as engines
from yellowiron.simulation.engine import Base, Readings, Setup
from yellowiron.simulation.registry import EngineEntry
from yellowiron.simulation.strokes.watched import watched


class Puppet:
    """An engine that goes exactly where it is told, and then lies about it."""

    version = "0"

    def __init__(self, setup: Setup, lie: Callable[[int, Floats, Floats, Floats], None]) -> None:
        self.setup, self.lie, self.count = setup, lie, 0
        self.chain = ClosedChain(setup.mechanism)
        self.now = self.chain.drawn
        self.told = dict.fromkeys(setup.measured, 0.0)

    def targets(self, joints: Sequence[str], rows: Floats) -> Iterator[None]:
        for row in rows:
            self.told.update({k: float(v) for k, v in zip(joints, row, strict=True) if k == "slide"})
            yield

    def step(self) -> None:
        self.count += 1
        self.now = self.chain.solve(self.told, start=self.now)

    def state(self) -> tuple[int, State]:
        return self.count, self.now

    def read(self, states: Sequence[tuple[int, State]]) -> Readings:
        rotations, origins = self.chain.placements([state for _, state in states])
        index = [self.chain.body_index(body.name) for body in self.setup.mechanism.bodies]
        coordinates = np.array([[self.chain.coordinate(s, name) for name in self.setup.measured] for _, s in states])
        made = Readings(coordinates, rotations[:, index], origins[:, index])
        for (count, _), *rows in zip(states, *made, strict=True):
            self.lie(count, *rows)
        return made

    def close(self) -> None:
        pass


@pytest.fixture
def puppet(monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    def _install(lie: Callable[[int, Floats, Floats, Floats], None] = lambda *_: None) -> None:
        module = types.ModuleType("puppet_engine")
        module.load = lambda setup: Puppet(setup, lie)  # type: ignore[attr-defined]
        monkeypatch.setitem(sys.modules, "puppet_engine", module)
        entry = EngineEntry("puppet_engine", 0.02, {"fixed": 5e-5, "floating": 1e-4})
        monkeypatch.setattr(engines, "ENGINES", {**engines.ENGINES, "puppet": entry})

    return _install


def test_an_exact_engine_has_no_error(usd_file: Path, puppet: Callable[..., None]) -> None:
    puppet()
    result = simulate(usd_file, engine="puppet", actuators=["boom"])
    assert result.completed and result.branches_kept
    assert result.pin_error < 1e-9 and result.angle_error < 1e-9
    assert not [f for f in result.findings if f.code != "SIM005"]


def test_the_machines_own_motion_is_no_error(usd_file: Path, puppet: Callable[..., None]) -> None:
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])

    def drive_away(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        rotations[:] = turn @ rotations
        origins[:] = origins @ turn.T + (0.1 * count, 2.0, 0.3)

    puppet(drive_away)
    assert simulate(usd_file, engine="puppet", base="floating", actuators=["boom"]).pin_error < 1e-9


def test_a_pin_that_moved_is_found(usd_file: Path, mechanism: Mechanism, puppet: Callable[..., None]) -> None:
    boom = [body.name for body in mechanism.bodies].index("boom")

    def slip(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        if count == 100:
            origins[boom] += (0.0, 0.001, 0.0)

    puppet(slip)
    result = simulate(usd_file, engine="puppet", actuators=["boom"])
    assert result.pin_error == pytest.approx(0.001)
    assert result.gap == pytest.approx(0.001)
    assert [f.code for f in result.findings if f.severity == "warning"] == ["SIM002"]


def test_a_body_that_turned_is_found(usd_file: Path, mechanism: Mechanism, puppet: Callable[..., None]) -> None:
    wheel = [body.name for body in mechanism.bodies].index("front_wheel_l")
    lean = np.array([[1.0, 0.0, 0.0], [0.0, np.cos(0.01), -np.sin(0.01)], [0.0, np.sin(0.01), np.cos(0.01)]])

    def tilt(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        rotations[wheel] = lean @ rotations[wheel]

    puppet(tilt)
    result = simulate(usd_file, engine="puppet", actuators=["boom"])
    assert result.angle_error == pytest.approx(0.01)
    assert result.angle_error_at.startswith("front_wheel_l")
    assert "SIM003" in [f.code for f in result.findings]


def test_a_flip_is_found_though_every_pin_is_closed(
    usd_file: Path, mechanism: Mechanism, puppet: Callable[..., None]
) -> None:
    """The rod's pin mirrored at the line through the triangle's other pins: the other branch of the same strokes."""
    names = [body.name for body in mechanism.bodies]
    boom_pin, barrel_pin = (np.asarray(mechanism.joint(name).anchor) for name in ("boom_joint", "barrel_joint"))
    line = math.atan2(*(barrel_pin - boom_pin)[[0, 2]])

    def flip(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        boom = names.index("boom")
        rod = origins[names.index("rod")]
        for index, pin in ((boom, boom_pin), (names.index("barrel"), barrel_pin), (names.index("rod"), barrel_pin)):
            angle = 2.0 * (line - math.atan2(*(rod - pin)[[0, 2]]))
            turn = np.array([[math.cos(angle), 0, math.sin(angle)], [0, 1, 0], [-math.sin(angle), 0, math.cos(angle)]])
            origins[index] = pin + turn @ (origins[index] - pin)
            rotations[index] = turn @ rotations[index]

    puppet(flip)
    result = simulate(usd_file, engine="puppet", actuators=["boom"])
    assert not result.branches_kept
    assert result.gap < 1e-9
    assert "SIM004" in [f.code for f in result.findings]


def test_an_explosion_is_found(usd_file: Path, puppet: Callable[..., None]) -> None:
    def explode(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        if count > 120:
            origins[:] = np.nan

    puppet(explode)
    result = simulate(usd_file, engine="puppet", actuators=["boom"])
    assert not result.completed
    assert result.findings[0].code == "SIM001" and result.findings[0].severity == "error"


def test_a_stroke_no_linkage_allows_is_found(usd_file: Path, puppet: Callable[..., None]) -> None:
    def stretch(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        if count > 100:
            coordinates[-1] += 5.0

    puppet(stretch)
    assert not simulate(usd_file, engine="puppet", actuators=["boom"]).completed


def test_an_engine_that_is_not_installed_is_said(usd_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    entry = EngineEntry("no_such_engine_module", 0.01, install="pip install yellowiron[absent]")
    monkeypatch.setattr(engines, "ENGINES", {"absent": entry})
    with pytest.raises(YellowironError, match=r"no_such_engine_module.*pip install yellowiron\[absent\]"):
        simulate(usd_file, engine="absent")


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"engine": "bullet"}, "no engine 'bullet'"),
        ({"engine": "mujoco", "base": "hanging"}, "no base 'hanging'"),
        ({"engine": "mujoco", "dt": 0.0}, "time step"),
        ({"engine": "mujoco", "dt": float("nan")}, "time step"),
        ({"engine": "mujoco", "payload_kg": -1.0}, "payload"),
        ({"engine": "mujoco", "actuators": ["arm"]}, "no actuator 'arm'"),
        ({"engine": "mujoco", "actuators": []}, "nothing to drive"),
    ],
)
def test_bad_orders_are_refused(usd_file: Path, more: dict[str, object], words: str) -> None:
    with pytest.raises(YellowironError, match=words):
        simulate(usd_file, **more)  # type: ignore[arg-type]


@pytest.mark.parametrize("base", ["fixed", "floating"])
@pytest.mark.slow
def test_mujoco_keeps_the_small_machine_together(usd_file: Path, mechanism: Mechanism, base: Base) -> None:
    payload = rated_payload(mechanism)
    assert payload.mass == pytest.approx(90.0)
    result = simulate(usd_file, engine="mujoco", base=base, payload_kg=payload.mass, payload_source=payload.source)
    assert result.completed and result.branches_kept
    assert not result.findings, result.findings
    assert result.pin_error < engines.ENGINES["mujoco"].pin_bars[base]
    boom = result.actuators[0]
    assert boom.reached_high == pytest.approx(boom.high, abs=0.01 * boom.stroke)
    assert boom.sag > 0.001


def test_two_runs_say_the_same(usd_file: Path) -> None:
    documents = []
    for _ in range(2):
        document = simulation_document(simulate(usd_file, engine="mujoco", actuators=["boom"]))
        document.pop("steps_per_second")
        documents.append(document)
    assert documents[0] == documents[1]
    assert {"engine", "dt_s", "base", "pin_error_mm", "angle_error_deg", "branches_kept", "actuators"} <= set(
        documents[0]
    )


def test_a_step_that_is_too_long_breaks_down_and_says_so(
    usd_file: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """MuJoCo would start again from the drawn pose, and leave a log in the working folder."""
    monkeypatch.chdir(tmp_path)
    result = simulate(usd_file, engine="mujoco", dt=0.1)
    assert not result.completed
    assert result.findings[0].code == "SIM001"
    assert not list(tmp_path.iterdir())
    assert capfd.readouterr() == ("", "")


def test_a_sweep_is_kept_to_be_looked_at(usd_file: Path, mechanism: Mechanism, puppet: Callable[..., None]) -> None:
    """Frames from low to high, at the engine's own poses; no worst error gets lost in thinning."""
    boom = [body.name for body in mechanism.bodies].index("boom")

    def slip(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        if count == 301:
            origins[boom] += (0.0, 0.002, 0.0)

    puppet(slip)
    result = simulate(usd_file, engine="puppet", actuators=["boom"])
    (sweep,) = result.sweeps
    assert sweep.name == "boom"
    assert sweep.pin_error.max() == pytest.approx(0.002)
    assert len(sweep.times) == len(sweep.pin_error) == len(sweep.angle_error) <= 240
    assert sweep.times[-1] == pytest.approx(0.02 * result.phases[-1].steps)
    assert [snapshot.share for snapshot in sweep.snapshots] == pytest.approx([0.02, 0.26, 0.5, 0.74, 0.98], abs=0.03)
    (trace,) = sweep.traces
    assert trace.kind == "position" and np.abs(trace.wanted - trace.measured).max() < 0.05
    chain = ClosedChain(mechanism)
    joint = mechanism.joint(trace.joint)
    for snapshot in sweep.snapshots:
        relative = np.linalg.inv(snapshot.poses[joint.body0]) @ snapshot.poses[joint.body1]
        stroke = float(relative[:3, 3] @ np.asarray(joint.axis))
        solved = chain.pose(chain.solve({joint.name: stroke}))
        assert np.abs(snapshot.poses["boom"] - solved["boom"]).max() < 1e-6


def test_work_to_be_looked_at_is_the_engines(usd_file: Path, mechanism: Mechanism) -> None:
    """Moments of each way, down, up and back, where the kinematics has them at MuJoCo's strokes."""
    shares = (0.25, 0.5, 1.0)
    (name,) = (a.name for a in mechanism.actuators if a.kind == "cylinder")
    seen = watch(usd_file, engine="mujoco", actuators=[name], shares=shares)[name]
    assert len(seen) == 9 and [s.time for s in seen] == sorted({s.time for s in seen})
    slide = mechanism.joint(mechanism.actuators[[a.name for a in mechanism.actuators].index(name)].joints[0].joint)
    assert slide.lower is not None and slide.upper is not None
    drawn = -slide.lower / (slide.upper - slide.lower)
    down, up, back = ([s.share for s in seen[k : k + 3]] for k in (0, 3, 6))
    # Of the way, less what the machine lags behind its targets.
    assert down == pytest.approx([drawn + (0.02 - drawn) * s for s in shares], abs=0.03)
    assert up == pytest.approx([0.02 + 0.96 * s for s in shares], abs=0.03)
    assert back == pytest.approx([0.98 + (drawn - 0.98) * s for s in shares], abs=0.03)
    chain = ClosedChain(mechanism)
    for snapshot in seen:
        assert snapshot.share is not None
        at = slide.lower + snapshot.share * (slide.upper - slide.lower)
        poses = chain.pose(chain.solve({slide.name: at}))
        for body, pose in snapshot.poses.items():
            assert np.abs(pose - poses[body]).max() < 1e-4, body


def test_work_that_breaks_down_is_an_error(usd_file: Path, puppet: Callable[..., None]) -> None:
    def burst(count: int, coordinates: Floats, rotations: Floats, origins: Floats) -> None:
        if count > 150:
            origins[:] = np.nan

    puppet(burst)
    with pytest.raises(YellowironError, match="breaks down in motion"):
        watched(usd_file, "puppet", ["boom"], (0.5, 1.0))
    puppet()
    assert len(watched(usd_file, "puppet", ["boom"], (0.5, 1.0))["boom"]) == 6
