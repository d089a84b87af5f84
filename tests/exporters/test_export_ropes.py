"""Hooks on ropes that pull and do not push: as long as the reeving says, slack where the hook is lifted, no stronger
than the winch's line."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

import yellowiron
from kit.machines.cranes import crane
from kit.machines.crawler_cranes import crawler_crane
from kit.machines.partly_drawn import without
from yellowiron.exporters import export_mjcf, unsaid, with_ropes
from yellowiron.exporters.geometry import Geometry
from yellowiron.model.mechanism import GRAVITY, Mechanism
from yellowiron.model.specification import Specification, Specifications

SLIDE, ROPE = "hoist_rope2hook_block_joint", "hoist_rope"
PULL = 35_000.0
"""N of a line, the type's own."""


def _crane(falls: int) -> Mechanism:
    lines = Specification("Number of Part Lines", float(falls), "1", "ok", "user")
    sheet = Specifications({lines.name: lines})
    machine = crane(5, sections=3, twin=False, hook=True)
    return without(machine, "mobile_crane", (), sheet=sheet, choices={"sections": "three"})


class Hung:
    """A crane in MuJoCo, its root held."""

    def __init__(self, mechanism: Mechanism, folder: Path, cylinders: str = "tendons") -> None:
        path = export_mjcf(mechanism, Geometry(), folder, base="fixed", cylinders=cylinders)  # type: ignore[arg-type]
        self.file, self.model = path, mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.block, self.lever = self.model.body("hook_block").id, self.model.actuator("hoist").id
        self.weight = GRAVITY * float(self.model.body_mass[self.block])

    def run(self, seconds: float, lift: float = 0.0, up: float = 0.0) -> None:
        """So long, with a force on the hook (N, upwards), the lever told a place (m, up) on a ramp."""
        start, steps = float(self.data.ctrl[self.lever]), round(seconds / self.model.opt.timestep)
        self.data.xfrc_applied[self.block, 2] = lift
        for step in range(steps):
            self.data.ctrl[self.lever] = start + (up - start) * min(1.0, 2.0 * step / steps)
            mujoco.mj_step(self.model, self.data)

    @property
    def apart(self) -> float:
        """From the boom's head to the block."""
        head, block = (self.data.site(f"{SLIDE}.{k}").xpos for k in (0, 1))
        return float(np.linalg.norm(head - block))

    @property
    def height(self) -> float:
        return float(self.data.xipos[self.block, 2])

    @property
    def rope(self) -> float:
        return float(self.data.ten_length[self.model.tendon(ROPE).id])

    @property
    def paid_out(self) -> float:
        return float(self.data.joint(SLIDE).qpos[0])


@pytest.mark.slow
@pytest.mark.parametrize("falls", [1, 4, 7])
def test_a_rope_is_as_long_as_its_falls(falls: int, tmp_path: Path) -> None:
    mechanism = _crane(falls)
    (rope,) = with_ropes(mechanism)[1]
    assert rope.falls == falls and rope.ends[0][0] == "inner_boom" and rope.ends[1][0] == "hook_block"
    hung = Hung(mechanism, tmp_path)
    assert hung.rope == pytest.approx(falls * rope.length, abs=1e-9)
    for place in (0.0, 0.5, -2.0):
        hung.run(14.0, up=place)
        assert hung.paid_out == pytest.approx(-place, abs=1e-3)
        assert hung.rope == pytest.approx(falls * hung.apart, abs=1e-6)
        # What the winch let out of each line is what hangs: it hangs, and it is taut.
        assert hung.rope == pytest.approx(falls * (rope.length + hung.paid_out), abs=1e-6)


@pytest.mark.slow
def test_a_rope_goes_slack_where_the_hook_is_lifted(tmp_path: Path) -> None:
    """As a body on a slide it holds a hook down that is pushed up; as a rope it does not."""
    mechanism = _crane(4)
    hung, bound = Hung(mechanism, tmp_path / "rope"), Hung(mechanism, tmp_path / "slide", "bodies")
    for each in (hung, bound):
        each.run(2.0)
    places = hung.height, bound.height
    hung.run(0.5, lift=1.5 * hung.weight)
    bound.run(0.5, lift=1.5 * bound.weight)
    assert hung.height - places[0] == pytest.approx(0.5 * 0.5 * GRAVITY * 0.5**2, rel=0.01)
    assert hung.paid_out == pytest.approx(0.0, abs=1e-4)  # the winch stands
    assert abs(bound.height - places[1]) < 1e-3
    hung.run(6.0)
    assert hung.height == pytest.approx(places[0], abs=2e-3)


@pytest.mark.slow
def test_a_rope_bears_its_line_s_pull_by_its_falls(tmp_path: Path) -> None:
    """By how far the block hangs below the head: this crane's boom goes down under such a load."""
    hung = Hung(_crane(4), tmp_path)
    hung.run(2.0)
    before = hung.apart
    hung.run(3.0, lift=hung.weight - 0.9 * 4 * PULL)
    assert hung.apart == pytest.approx(before, abs=5e-3)
    hung.run(3.0, lift=hung.weight - 1.1 * 4 * PULL)
    assert hung.apart > before + 0.1


@pytest.mark.slow
def test_it_weighs_what_it_did_and_is_held_against_its_machine(tmp_path: Path) -> None:
    mechanism = _crane(4)
    roped, (rope,) = with_ropes(mechanism)
    assert {b.name for b in roped.bodies} == {b.name for b in mechanism.bodies} - {ROPE}
    moments = [
        sum(np.append(b.mass * np.asarray(b.center_of_mass), b.mass) for b in one.bodies) for one in (mechanism, roped)
    ]
    # The rope's own centre is a little off the line of its ends.
    assert moments[0] == pytest.approx(moments[1], rel=1e-4, abs=0.1)
    file = Hung(mechanism, tmp_path).file
    found = yellowiron.check(file, machine=mechanism)
    assert [f.code for f in found if f.severity != "info"] == []
    assert "EXP006" in {f.code for f in found}
    assert any(f"{rope.falls} falls" in words for words in unsaid(mechanism, to="mjcf-tendons"))
    model = mujoco.MjModel.from_xml_path(str(file))
    assert float(model.body_mass.sum()) == pytest.approx(moments[0][3], rel=2e-5)


def test_a_rope_that_holds_a_boom_stays() -> None:
    """Between two pins, and kept taut by the boom's weight: only the hook's is replaced."""
    mechanism = without(crawler_crane(3, hook=True), "crawler_crane", ())
    assert {a.name: a.falls > 0 for a in mechanism.actuators if a.falls} == {"luffing": True, "hoist": True}
    assert [rope.name for rope in with_ropes(mechanism)[1]] == [ROPE]


def test_a_machine_without_ropes_is_as_it_was(mechanism: Mechanism) -> None:
    assert with_ropes(mechanism) == (mechanism, ())
