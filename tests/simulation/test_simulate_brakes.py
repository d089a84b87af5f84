"""Parking brakes: what is slewed on a slope creeps with its brake released, and stays with it set, in every engine."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from in_engines import need
from plain_engines import play, world_with
from pxr import Usd, UsdGeom, UsdPhysics

from kit.machines import small_machine
from kit.machines.crawler import crawler
from kit.machines.simple_machines import write
from kit.machines.tracked_template import write_tracked_template
from yellowiron import usd
from yellowiron.exporters import Geometry, export_mjcf
from yellowiron.kinematics import complete
from yellowiron.kinematics.brakes import SLOPE
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Drive, Joint, Mechanism
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose
from yellowiron.simulation import rated_payload
from yellowiron.usd import read_mechanism

ARM, MASS = 2.0, 1000.0
ACROSS = np.array([0.0, math.sin(SLOPE), -math.cos(SLOPE)])
"""Which way things fall where the machine stands across the slope."""


def slewing() -> Mechanism:
    """An arm on a motor of vertical axis, soft enough to creep, and a weight at its end."""

    def body(name: str, mass: float, x: float) -> Body:
        return Body(name, (x, 0.0, 1.0), mass, (x, 0.0, 1.0), 0.1 * mass * np.eye(3), (), np.zeros((0, 3)))

    motor = Drive("velocity", 0.0, 2e4, 1e6, 1.0, "stated; template states damping")
    return Mechanism(
        name="slewing",
        equipment_type="test",
        root="stand",
        bodies=(body("stand", 3000.0, 0.0), body("arm", 10.0, 0.0), body("weight", MASS, ARM)),
        joints=(  # what hangs on the arm first: joints stand in no order
            Joint("held", "fixed", "arm", "weight", (ARM, 0.0, 1.0), (0.0, 0.0, 1.0)),
            Joint("swing", "revolute", "stand", "arm", (0.0, 0.0, 1.0), (0.0, 0.0, 1.0), drive=motor),
        ),
        actuators=(Actuator("swing", "motor", (ActuatorJoint("swing"),)),),
    )


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[Mechanism, Path]:
    mechanism = complete(slewing())
    return mechanism, write(tmp_path_factory.mktemp("slewing"), mechanism)


def test_the_brake_holds_what_is_slewed_on_the_slope_and_a_quarter_more(written: tuple[Mechanism, Path]) -> None:
    mechanism, file = written
    for each in (mechanism, read_mechanism(file)):
        drive = each.joint("swing").drive
        assert drive is not None
        assert drive.brake == pytest.approx(1.25 * 9.80665 * MASS * ARM * math.sin(SLOPE), rel=1e-3)


def test_wheels_share_what_holds_the_machine_on_the_slope(mechanism: Mechanism) -> None:
    """The weight and the rated load along the slope, at the wheels' rims, and a quarter more."""
    drives = [j.drive for j in mechanism.joints if j.drive is not None and j.drive.kind == "velocity"]
    load = rated_payload(mechanism).mass
    pull = 9.80665 * (sum(b.mass for b in mechanism.bodies) + load) * math.sin(SLOPE)
    assert len(drives) == len(small_machine.WHEELS)
    assert sum(d.brake for d in drives) / small_machine.RADIUS == pytest.approx(1.25 * pull, rel=0.01)


def test_mjcf_has_the_brakes_for_whoever_sets_them(written: tuple[Mechanism, Path], tmp_path: Path) -> None:
    mechanism, _ = written
    turned = {}
    for brakes in (False, True):
        model = mujoco.MjModel.from_xml_path(str(export_mjcf(mechanism, Geometry(), tmp_path, base="fixed")))
        model.opt.gravity[:] = 9.81 * ACROSS
        if brakes:
            model.dof_frictionloss[model.joint("swing").dofadr[0]] = model.numeric("swing.brake").data[0]
        data = mujoco.MjData(model)
        mujoco.mj_step(model, data, 2000)
        turned[brakes] = abs(float(data.qpos[0]))
    assert turned[False] > 0.3 and turned[True] < 1e-3


def test_a_set_brake_is_a_stiff_spring_as_strong_as_it_where_friction_alone_creeps(
    written: tuple[Mechanism, Path],
) -> None:
    brake = read_mechanism(written[1]).joint("swing").drive
    assert brake is not None
    stage = Usd.Stage.Open(str(written[1]))
    machine = stage.GetDefaultPrim()
    held = {}
    for brakes in ("released", "set"):
        machine.GetVariantSet("Brakes").SetVariantSelection(brakes)
        drive = next(UsdPhysics.DriveAPI(p, "angular") for p in stage.Traverse() if p.GetName() == "swing")
        held[brakes] = drive.GetStiffnessAttr().Get(), drive.GetMaxForceAttr().Get()
    assert held["released"] == pytest.approx((0.0, 1e6))
    assert held["set"] == pytest.approx((math.radians(brake.brake / 0.002), brake.brake), rel=1e-5)


@pytest.fixture(scope="module")
def crawling(tmp_path_factory: pytest.TempPathFactory) -> tuple[Mechanism, Path]:
    """A machine on tracks, as heavy in front as one that reaches out: it stands on the ends of its tracks."""
    folder = tmp_path_factory.mktemp("crawling")
    template = load_template(write_tracked_template(folder / "template"))
    drawn = crawler(24, 3, 1)
    aligned = drawn.aligned(shoes=False)
    chosen = expand(choose(template, {"tracks": "belt"}), aligned.counts)
    built = build_mechanism(drawn.assembly(), chosen, aligned, Specifications(), name="crawler")
    out = [
        replace(b, center_of_mass=(1.5, 0.0, 1.5), mass=2.0 * b.mass) if b.name == "upperstructure" else b
        for b in built.bodies
    ]
    built = complete(replace(built, bodies=tuple(out)))
    usd.write_machine(built, drawn.assembly(), folder / "made", name="crawler")
    return built, folder / "made" / "crawler.usda"


@pytest.mark.slow
@pytest.mark.parametrize("engine", [pytest.param("newton", marks=pytest.mark.slow), "physx"])
def test_tracks_with_brakes_set_stay_on_the_slope(crawling: tuple[Mechanism, Path], engine: str) -> None:
    need(engine)
    moved = {}
    for brakes in ("released", "set"):
        stage = world_with(crawling[1], np.array([math.sin(SLOPE), 0.0, -math.cos(SLOPE)]))
        machine = stage.GetPrimAtPath("/World/machine")
        machine.GetVariantSet("Base").SetVariantSelection("floating")
        machine.GetVariantSet("Brakes").SetVariantSelection(brakes)
        ground = UsdGeom.Plane.Define(stage, "/World/ground")
        ground.CreateAxisAttr("Z")
        UsdPhysics.CollisionAPI.Apply(ground.GetPrim())
        body = "/World/machine/undercarriage"
        poses = [play(engine, stage, [body], seconds)[body] for seconds in (1.0, 2.0)]
        moved[brakes] = float(np.linalg.norm(poses[1] - poses[0]))
    # m in a second; Newton's own friction cone lets everything creep by a millimetre or two.
    assert moved["released"] > 4e-3
    assert moved["set"] < (2e-3 if engine == "newton" else 2e-5)


def test_mjcf_has_pads_that_touch_once_they_are_told_to(crawling: tuple[Mechanism, Path], tmp_path: Path) -> None:
    moved = {}
    for brakes in (False, True):
        export_mjcf(crawling[0], crawling[1], tmp_path)
        model = mujoco.MjModel.from_xml_path(str(tmp_path / "scene.xml"))
        model.opt.gravity[:] = 9.81 * np.array([math.sin(SLOPE), 0.0, -math.cos(SLOPE)])
        pads = [i for i in range(model.ngeom) if model.geom(i).name.endswith(".pad")]
        assert len(pads) == 2
        for i in range(model.nnumeric) if brakes else ():
            joint = model.joint(model.numeric(i).name.removesuffix(".brake"))
            model.dof_frictionloss[joint.dofadr[0]] = model.numeric(i).data[0]
        model.geom_contype[pads] = int(brakes)
        data = mujoco.MjData(model)
        mujoco.mj_step(model, data, 1000)
        before = data.qpos[:3].copy()
        mujoco.mj_step(model, data, 1000)
        moved[brakes] = float(np.linalg.norm(data.qpos[:3] - before))
    assert moved[False] > 4e-3 and moved[True] < 1e-5


@pytest.mark.parametrize("engine", [pytest.param("newton", marks=pytest.mark.slow), "physx"])
def test_the_variant_sets_the_brakes(written: tuple[Mechanism, Path], engine: str) -> None:
    need(engine)
    moved = {}
    for brakes in ("released", "set"):
        stage = world_with(written[1], ACROSS)
        machine = stage.GetPrimAtPath("/World/machine")
        assert machine.GetVariantSet("Brakes").GetVariantNames() == ["released", "set"]
        machine.GetVariantSet("Brakes").SetVariantSelection(brakes)
        weight = next(str(p.GetPath()) for p in stage.Traverse() if p.GetName() == "weight")
        poses = [play(engine, stage, [weight], seconds)[weight] for seconds in (0.01, 2.0)]
        moved[brakes] = float(np.linalg.norm(poses[1] - poses[0]))
    assert moved["released"] > 0.3 and moved["set"] < 1e-3
