"""Rams whose halves are fixed to what they move: built, written, checked, and driven in every engine."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import trimesh
from in_engines import EVERY, load

import yellowiron
from kit.builds import without_pages
from kit.machines import rams
from yellowiron.checks import check
from yellowiron.kinematics import ClosedChain, lever_table
from yellowiron.model.mechanism import Cylinder, Mechanism
from yellowiron.simulation.engine import Setup, coordinates
from yellowiron.simulation.registry import ENGINES
from yellowiron.usd import read_mechanism

PRESSURE, FLOW = 10e6, 30e-3 / 60
SLIDES = ("lift_joint", "shift_joint", "jack_joint")


@dataclass(frozen=True)
class Built:
    mechanism: Mechanism
    file: Path

    def cylinder(self, slide: str) -> Cylinder:
        return next(c for c in self.mechanism.cylinders if c.slide == slide)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    folder = tmp_path_factory.mktemp("rams")
    template, cad = rams.write(folder / "in")
    with without_pages():
        machine = yellowiron.build(template, cad, folder / "out")
    return Built(machine.mechanism, folder / "out" / "lift_table.usda")


def area(bore: float, rod: float = 0.0) -> float:
    return math.pi / 4 * (bore**2 - rod**2)


@pytest.mark.slow
def test_each_ram_pushes_the_way_its_rod_comes_out(built: Built) -> None:
    assert {j.name: j.type for j in built.mechanism.joints} == dict.fromkeys(SLIDES, "prismatic")
    for slide, way in zip(SLIDES, (rams.UP, rams.LEFT, rams.DOWN), strict=True):
        assert built.mechanism.joint(slide).axis == pytest.approx(way, abs=1e-6)
    jack = built.mechanism.joint("jack_joint")
    # Its entry names the foot first; the tree's parent is the cart, and it is the foot that goes down.
    assert (jack.body0, jack.body1) == ("cart", "foot")
    mobility = built.mechanism.mobility
    assert mobility is not None and (mobility.computed, mobility.expected) == (3, 3)


def test_strokes_and_limits_are_the_pistons_travel(built: Built) -> None:
    for slide, stroke, out in zip(
        SLIDES, (rams.STROKE, rams.SHIFT_STROKE, rams.JACK_STROKE), (rams.OUT, 0.15, 0.0), strict=True
    ):
        cylinder, joint = built.cylinder(slide), built.mechanism.joint(slide)
        assert cylinder.stroke == pytest.approx(stroke, abs=1e-6)
        assert cylinder.extension == pytest.approx(out, abs=1e-6)
        assert (joint.lower, joint.upper) == pytest.approx((-out, stroke - out), abs=1e-6)


def test_rams_of_one_slide_push_together_and_share_the_flow(built: Built) -> None:
    lift = built.cylinder("lift_joint")
    assert lift.name == "lift_cylinder" and lift.pins == ()
    assert lift.push_force == pytest.approx(2 * PRESSURE * area(rams.BORE), rel=1e-4)
    assert lift.pull_force == pytest.approx(2 * PRESSURE * area(rams.BORE, rams.ROD), rel=1e-4)
    assert lift.speed == pytest.approx(FLOW / (2 * area(rams.BORE)), rel=1e-4)
    assert (lift.barrel, lift.rod) == ("cart", "table")


def test_a_rod_through_both_ends_pushes_and_pulls_alike(built: Built) -> None:
    shift = built.cylinder("shift_joint")
    assert shift.push_force == shift.pull_force == pytest.approx(PRESSURE * area(0.06, 0.03), rel=1e-4)
    assert shift.name == "shift_cylinder"


def test_the_file_gives_it_back_and_has_nothing_wrong(built: Built) -> None:
    again = read_mechanism(built.file)
    assert again.cylinders == built.mechanism.cylinders
    assert {f.code for f in check(built.file)} == {"CHK006"}


def test_strokes_are_told_without_pivots(built: Built) -> None:
    table = lever_table(built.mechanism, "lift", n=3)
    assert table["extension"] == pytest.approx([0.0, rams.STROKE / 2, rams.STROKE], abs=1e-6)
    assert table["pivots"] == {}
    state = ClosedChain(built.mechanism).solve({"jack_joint": 0.3})
    assert ClosedChain(built.mechanism).displacement(state, "foot")[2, 3] == pytest.approx(-0.3, abs=1e-6)


@pytest.mark.slow
def test_rams_that_are_not_drawn_stand_closed(tmp_path: Path) -> None:
    """The rams of the lift are left out of the CAD model: the slide goes up from where it stands, by the stroke that is
    set; both rams count."""
    template, cad = rams.write(tmp_path / "in")
    scene = trimesh.load_scene(cad)
    scene.delete_geometry([name for name in scene.geometry if name.startswith("LIFT")])
    scene.export(tmp_path / "bare.glb")
    document = json.loads((template / "actuators.json").read_text())
    document["lift"]["defaults"]["bore"] = "80 mm"
    (template / "actuators.json").write_text(json.dumps(document))
    # A vertical in GLB's frame.
    axes = {"lift_joint": {"anchor": [0.0, 1.0, 0.0], "axis": [0.0, 1.0, 0.0]}}
    (tmp_path / "axes.json").write_text(json.dumps(axes))
    with without_pages():
        machine = yellowiron.build(
            template,
            tmp_path / "bare.glb",
            tmp_path / "out",
            documents=[tmp_path / "axes.json"],
            settings=["Lift Cylinder Stroke=600 mm"],
        )
    joint = machine.mechanism.joint("lift_joint")
    assert joint.axis == pytest.approx((0, 0, 1))
    assert (joint.lower, joint.upper) == pytest.approx((0.0, 0.6))
    lift = next(c for c in machine.mechanism.cylinders if c.slide == "lift_joint")
    assert lift.push_force == pytest.approx(2 * PRESSURE * area(0.08))
    assert {f.code for f in machine.mechanism.findings if f.where == "lift_joint"} >= {"MEC022"}


@pytest.mark.parametrize("engine", EVERY)
def test_rams_take_their_slides_to_their_targets(engine: str, built: Built) -> None:
    """All three at once, over most of their strokes and held: no more off than the drives' springs give under the
    weight."""
    step = ENGINES[engine].timestep
    loaded = load(engine, Setup(built.file, built.mechanism, "fixed", step, SLIDES))
    ends = np.array([0.45, -0.12, 0.35])
    rated = [drive.slowest for s in SLIDES if (drive := built.mechanism.joint(s).drive) is not None]
    needed = 1.1 * float((np.abs(ends) / rated).max())
    seconds = step * np.arange(1, round((needed + 2.0) / step) + 1)
    targets = np.clip(seconds / needed, 0.0, 1.0)[:, None] * ends
    try:
        for _ in loaded.targets(SLIDES, targets):
            loaded.step()
        last = coordinates(loaded)
    finally:
        loaded.close()
    mass = {b.name: b.mass for b in built.mechanism.bodies}
    weights = 9.81 * np.array([-(mass["table"] + mass["top"]), 0.0, mass["foot"]])
    sag = []
    for slide, weight in zip(SLIDES, weights, strict=True):
        drive = built.mechanism.joint(slide).drive
        assert drive is not None
        sag.append(weight / drive.stiffness)
    assert last == pytest.approx(ends + np.array(sag), abs=1e-3)
