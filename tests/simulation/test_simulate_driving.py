"""Driving, in MuJoCo."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from kit.machines.crawler import crawler, of_steel
from kit.machines.tracked_template import write_tracked_template
from yellowiron.kinematics import ClosedChain, complete
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose
from yellowiron.simulation.driving.raised import CLEAR, raised
from yellowiron.simulation.driving.result import driving_document, driving_findings
from yellowiron.simulation.driving.tracked import course
from yellowiron.simulation.driving.wheel import driven_wheels
from yellowiron.simulation.driving.wheeled import circle_radius, drive
from yellowiron.simulation.ground import Block
from yellowiron.usd import write_machine


def test_a_circle_through_an_arc() -> None:
    angle = np.linspace(0.0, 1.5, 50)
    points = np.column_stack([3.0 + 6.2 * np.cos(angle), -1.0 + 6.2 * np.sin(angle)])
    assert circle_radius(points) == pytest.approx(6.2)


def test_a_bucket_on_the_ground_is_raised_by_the_boom(mechanism: Mechanism) -> None:
    """By as much as clears the ground, and nothing where only wheels stand there."""
    chain, wheels = ClosedChain(mechanism), driven_wheels(mechanism)
    assert not raised(mechanism, chain, wheels)
    boom = mechanism.body("boom")
    hull = np.asarray(boom.hull) - [0.0, 0.0, float(np.asarray(boom.hull)[:, 2].min())]
    low = dataclasses.replace(
        mechanism, bodies=tuple(dataclasses.replace(b, hull=hull) if b.name == "boom" else b for b in mechanism.bodies)
    )
    ((motion, target),) = raised(low, chain, wheels).items()
    assert motion.joint == "slide" and motion.low <= target <= motion.high
    pose = chain.displacement(chain.reach({"slide": target})[0], "boom")
    rise = float((hull @ pose[2, :3] + pose[2, 3]).min())
    assert CLEAR <= rise < 3.0 * CLEAR


def test_wheels_are_found_with_their_size(mechanism: Mechanism) -> None:
    found = driven_wheels(mechanism)
    assert len(found) == 4
    assert all(w.radius == pytest.approx(0.5, rel=0.01) and w.half_width == pytest.approx(0.15) for w in found)


def test_what_has_no_wheels_is_said(mechanism: Mechanism) -> None:
    with pytest.raises(YellowironError, match="no driven wheels"):
        driven_wheels(dataclasses.replace(mechanism, actuators=()))


def test_a_blocks_surface_has_a_ramp_at_both_ends() -> None:
    block = Block((1.0, 0.0), length=0.5, width=1.0, height=0.15, run=0.3)
    heights = block.surface(np.array([1.0, 1.4, 0.6, 2.0, 1.0]), np.array([0.0, 0.0, 0.0, 0.0, 0.6]))
    assert heights == pytest.approx([0.15, 0.075, 0.075, 0.0, 0.0])
    assert block.corners.shape == (8, 3)


def test_the_small_machine_drives_and_climbs(usd_file: Path) -> None:
    result = drive(usd_file, engine="mujoco")
    assert result.creep < 1e-3 and result.sunk < 0.01
    assert result.forward == pytest.approx(5.0, rel=0.03)
    assert result.backward == pytest.approx(5.0, rel=0.03)
    assert result.turning_radius is None
    assert result.axle_angle == pytest.approx(math.asin(0.15 / 1.4), rel=0.05)
    assert result.highest_wheel is not None and result.highest_wheel < 0.02
    assert driving_document(result)["forward_error_percent"] == pytest.approx(0.0, abs=3.0)
    assert not list(driving_findings(result))
    slow = dataclasses.replace(result, forward=4.8, turning_radius=6.4, geometry_radius=6.0, highest_wheel=0.05)
    assert [(f.code, f.where) for f in driving_findings(slow)] == [
        ("SIM009", "forward"),
        ("SIM009", "turning radius"),
        ("SIM009", "block"),
    ]


@pytest.mark.slow
def test_a_crawler_drives_and_turns_on_the_spot(tmp_path: Path) -> None:
    """Its hidden wheels drive it as any wheels do; nothing steers, so its sides turn against each other."""
    drawn = crawler(24, 3, 1)
    template = load_template(write_tracked_template(tmp_path / "template"))
    aligned = drawn.aligned(shoes=False)
    chosen = expand(choose(template, {"tracks": "belt"}), aligned.counts)
    mechanism = of_steel(build_mechanism(drawn.assembly(), chosen, aligned, Specifications(), name="crawler"))
    file, *_ = write_machine(complete(mechanism), drawn.assembly(), tmp_path / "out", name="crawler")
    result = drive(file, engine="mujoco")
    assert result.distance == 2.0
    assert result.forward == pytest.approx(2.0, rel=0.05)
    assert result.backward == pytest.approx(2.0, rel=0.05)
    assert result.turning_radius is None and result.axle_angle is None
    assert result.spin == pytest.approx(math.radians(45.0), rel=0.1)
    # Nothing limits this machine's swing motor: it turns its undercarriage on the ground as well.
    assert result.swing == pytest.approx(math.radians(90.0), rel=0.1)
    assert not list(driving_findings(dataclasses.replace(result, swing=math.radians(90.5))))
    crooked = dataclasses.replace(result, spin=math.radians(30.0), swing=math.radians(92.0))
    assert [f.where for f in driving_findings(crooked)] == ["turn on the spot", "swing"]


def test_a_course_goes_all_the_way_and_never_too_fast() -> None:
    for amount, speed, limit in ((2.0, 1.5, 9.0), (0.8, 1.2, 0.5), (1e-3, 1.0, 0.1)):
        speeds = course(amount, speed, limit, 0.001)
        assert speeds.sum() * 0.001 == pytest.approx(amount)
        assert speeds.max() < 1.01 * speed and abs(np.diff(speeds)).max() < 1.02 * min(limit, speed) * 0.001
