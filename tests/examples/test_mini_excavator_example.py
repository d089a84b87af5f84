"""The mini excavator example: its linkages meet what its sheet publishes, it is free to move, and it builds."""

from __future__ import annotations

import itertools
import json
import math
from contextlib import nullcontext
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from example_file import module
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps

from kit.builds import MadeOnce, console, read_once, reading_once, without_usd
from kit.machines.drawn_examples import assert_sourced
from kit.machines.nameless import write_nameless
from yellowiron.simulation import simulate

TYPE = "mini_excavator"
PERCENT, DEGREES = 0.3, 0.2
"""Bars of what is published."""
LEVERS = {"swing", "boom", "arm", "bucket", "boom_swing", "blade", "travel_left", "travel_right"}


@pytest.fixture(scope="module")
def linkage() -> ModuleType:
    return module("mini_excavator", "linkage")


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the drawn machine, its sheet and its truth."""
    folder = tmp_path_factory.mktemp("mini_excavator")
    module("mini_excavator", "draw").main(folder)
    return folder


# ---- the linkages --------
def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    assert_sourced(values, 32)


@pytest.mark.slow
def test_linkages_meet_what_is_published(linkage: ModuleType, values: ModuleType) -> None:
    got = module("mini_excavator", "truth").measured(linkage.solve())
    for value in (*values.PUBLISHED, *values.EXAMPLE):
        if value.name in got:
            assert got[value.name] == pytest.approx(value.value, abs=1e-5), value.name
    assert {values.SWING_LEFT.name, values.BLADE_LIFT.name, values.WALL_DEPTH.name} <= set(got)


def test_the_vertical_wall_depth_is_the_lowest_upright_floor(linkage: ModuleType, values: ModuleType) -> None:
    """By brute force over boom and arm, the bucket as the upright floor needs it."""
    equipment = module("mini_excavator", "equipment")
    k = linkage.solve()
    e, upright = k.ends(), equipment.floor_angle(k) - math.pi / 2
    lowest = 0.0
    for boom, arm in itertools.product(np.linspace(e.low, e.high, 401), np.linspace(e.crowd, e.out, 401)):
        if e.curl <= upright - boom - arm <= e.open:
            tip = k.A[1] + k.boom * math.sin(boom) + k.arm * math.sin(boom + arm) + k.tip * math.sin(upright)
            lowest = min(lowest, tip)
    assert values.WALL_DEPTH.value - 12 < -lowest < values.WALL_DEPTH.value + 1e-3


def test_the_swing_cylinder_keeps_off_its_dead_points(linkage: ModuleType, values: ModuleType) -> None:
    swing = linkage.solve_swing()
    for left in np.radians(np.linspace(-values.SWING_RIGHT.value, values.SWING_LEFT.value, 15)):
        lever = abs(float(np.cross(swing.barrel - linkage.PIVOT, swing.rod(left) - linkage.PIVOT))) / swing.length(left)
        assert lever > 40.0  # clear of the bracket's pin


# ---- the drawing --------
@pytest.mark.slow
def test_bodies_do_not_meet_wherever_the_boom_swings(drawn: Path) -> None:
    from drawing.product import Occurrence, occurrences
    from drawing.solids import Z, moved, turn

    leaves = occurrences(module("mini_excavator", "draw").draw_machine())
    pivot = (*module("mini_excavator", "linkage").PIVOT, 0.0)

    def meeting(a: Occurrence, b: Occurrence, left: float) -> float:
        """Common volume, mm³, with the first part swung to the left by so many degrees."""
        one = moved(moved(a.part.shape, a.place), turn(Z, left, pivot))
        common = BRepAlgoAPI_Common(one, moved(b.part.shape, b.place)).Shape()
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(common, properties)
        return float(properties.Mass())

    bracket = [leaf for leaf in leaves if leaf.body == "swing_bracket"]
    fixed = [leaf for leaf in leaves if leaf.body in ("upperstructure", "blade", "undercarriage")]
    for left in (-70.0, 0.0, 70.0):
        for a, b in itertools.product(bracket, fixed):
            assert meeting(a, b, left) < 1.0, (left, a.path, b.path)


@pytest.fixture(scope="module", params=["named", "nameless"])
def built(
    request: pytest.FixtureRequest, drawn: Path, made_once: MadeOnce, tmp_path_factory: pytest.TempPathFactory
) -> tuple[Path, dict[str, Any], Path]:
    """A build's folder, its report, and the CAD file."""
    cad, folder = drawn / "mini_excavator.step", tmp_path_factory.mktemp(request.param)
    if request.param == "nameless":
        cad = write_nameless(cad, folder / "part.step")
    sheet = drawn / "specifications.pdf"
    with reading_once(made_once, cad.parent), nullcontext() if request.param == "named" else without_usd():
        outcome = console("build", "excavator", "--cad", cad, "--specs", sheet, "--out", folder / "out", cwd=folder)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    return folder / "out", json.loads((folder / "out" / "report.json").read_text(encoding="utf-8")), cad


@pytest.mark.slow
@pytest.mark.usefixtures("no_pages")
def test_it_is_ready_and_moves_as_published(built: tuple[Path, dict[str, Any], Path], drawn: Path) -> None:
    _, report, _ = built
    assert report["alignment"]["choices"] == {"boom_cylinders": "single", "boom_type": "swing", "blade": "fitted"}
    assert report["alignment"]["assigned"] == report["alignment"]["parts"] == 217
    assert report["mobility"]["computed"] == report["mobility"]["expected"] == 12  # six of them hidden wheels'
    assert {a["name"] for a in report["actuators"]} == LEVERS
    truth = json.loads((drawn / "truth.json").read_text(encoding="utf-8"))
    frame = np.array(report["frame"])
    joints = {j["name"]: j for j in report["joints"]}
    for name, true in truth["joints"].items():
        if "when" in true:
            continue
        axis = frame[:3, :3] @ np.array(true["axis"])
        gap = np.array(joints[name]["anchor"]) - frame[:3, :3] @ np.array(true["anchor"]) - frame[:3, 3]
        assert np.linalg.norm(np.cross(axis, joints[name]["axis"])) < 2e-4, name
        assert np.linalg.norm(gap - (gap @ axis) * axis) < 1e-5, name
    compared = [m for m in report["measurements"] if m["spec"] is not None]
    assert len(compared) >= 20
    for m in compared:
        off = math.degrees(m["model"] - m["spec"]) if m["unit"] == "rad" else m["error_percent"]
        assert abs(off) < (DEGREES if m["unit"] == "rad" else PERCENT), m
    assert {"Boom Swing Angle Left", "Boom Swing Angle Right", "Blade Lift Height"} <= {m["name"] for m in compared}


@pytest.mark.slow
@pytest.mark.usefixtures("no_pages")
def test_every_part_is_in_its_body(built: tuple[Path, dict[str, Any], Path], drawn: Path, made_once: MadeOnce) -> None:
    folder, _, cad = built
    truth = json.loads((drawn / "truth.json").read_text(encoding="utf-8"))
    found = json.loads((folder / "alignment.json").read_text(encoding="utf-8"))["parts"]
    body_of = {part["part"]: part["body"] for part in found}
    for part, (path, true) in zip(read_once(cad, made_once).parts, truth["parts"].items(), strict=True):
        body = "undercarriage" if true["body"] in truth["undercarriage_with"] else true["body"]
        assert body_of[part.id] == body, path


@pytest.mark.slow
@pytest.mark.usefixtures("no_pages")
def test_pins_hold_over_all_strokes(built: tuple[Path, dict[str, Any], Path]) -> None:
    """Its swinging boom in Newton: the backhoe's."""
    folder, _, cad = built
    if "part" in cad.name:
        pytest.skip("the same machine as the named one")
    result = simulate(folder / "excavator.usda", engine="mujoco")
    assert result.completed and not result.findings
    assert result.pin_error < 5e-5
    assert all(each.final_error_percent < 1.0 for each in result.actuators)
