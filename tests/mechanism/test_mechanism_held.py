"""Crane booms whose sections are pinned at lengths by one cylinder, and jibs pinned at offsets: what is chosen is where
the machine stands, welded, in MuJoCo too."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
import pytest

from kit.machines.cranes import crane
from kit.machines.synthetic import Machine
from kit.machines.unseen import found_whole
from yellowiron import kinematics, library
from yellowiron.alignment.readings import align
from yellowiron.exporters import export_mjcf
from yellowiron.exporters.geometry import Geometry
from yellowiron.model.alignment import Alignment
from yellowiron.model.errors import MechanismError
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specification, Specifications
from yellowiron.stages import solve

STROKE = 2.0
SECTIONS = ("second_section", "third_section", "fourth_section")
BODIES = ("boom", "middle_boom", "second_middle_boom", "inner_boom")


def _sheet() -> Specifications:
    stroke = Specification("Telescoping Cylinder Stroke", STROKE, "m", "ok", "user")
    return Specifications({stroke.name: stroke})


@dataclass(frozen=True)
class Aligned:
    """A drawn crane, in its own frame, and what is found of it."""

    machine: Machine
    found: Alignment
    choices: dict[str, str]


def _aligned(machine: Machine, choices: dict[str, str]) -> Aligned:
    template = library.load_template("mobile_crane")
    found = align(machine.assembly(), template, Specifications(), choices=choices)
    assert [p.part for p in found.parts if p.body != machine.truth[p.part][1]] == [] and not found.missing
    return Aligned(machine, found, choices)


def _held(aligned: Aligned, places: dict[str, str] | None = None, sheet: Specifications | None = None) -> Mechanism:
    """The machine, its joints where they are chosen to be held."""
    template, known = library.load_template("mobile_crane"), Specifications() if sheet is None else sheet
    chosen = {**aligned.choices, **(places or {})}
    return solve(template, aligned.machine.assembly(), aligned.found, known, library.Documents(), chosen).mechanism


def _place(mechanism: Mechanism, name: str) -> np.ndarray:
    return np.asarray(next(s for s in mechanism.sites if s.name == name).position)


@pytest.fixture(scope="module")
def pinned() -> Aligned:
    return _aligned(crane(11, sections=4, twin=False, hook=True, pinned=True), {"telescoping": "pinned"})


@pytest.fixture(scope="module")
def drawn(pinned: Aligned) -> Mechanism:
    return _held(pinned, None, _sheet())


@pytest.fixture(scope="module")
def jib() -> Aligned:
    return _aligned(crane(22, sections=3, twin=False, hook=True, jib=True), {"jib": "pinned"})


@pytest.mark.slow
@pytest.mark.parametrize(
    "places", [("46", "drawn", "drawn"), ("92", "46", "46"), ("100", "100", "92"), ("100", "100", "100")]
)
def test_sections_are_pinned_at_lengths(pinned: Aligned, drawn: Mechanism, places: tuple[str, ...]) -> None:
    built = _held(pinned, dict(zip(SECTIONS, places, strict=True)), _sheet())
    out = [0.0 if place == "drawn" else 0.01 * float(place) * STROKE for place in places]
    lengths = [float(np.linalg.norm(_place(m, "boom_head") - _place(m, "boom_foot"))) for m in (drawn, built)]
    # Foot and head are a little off the sections' line.
    along = _place(drawn, "boom_head") - _place(drawn, "boom_foot")
    way = np.asarray(built.joint("second_section_joint").axis)
    assert lengths[1] == pytest.approx(float(np.linalg.norm(along + sum(out) * way)), abs=1e-9)
    for body, moved in zip(BODIES, np.cumsum([0.0, *out]), strict=True):
        apart = np.subtract(built.body(body).center_of_mass, drawn.body(body).center_of_mass)
        assert apart == pytest.approx(moved * way, abs=1e-9)
    assert [built.joint(f"{name}_joint").type for name in SECTIONS] == ["fixed"] * 3
    assert built.mobility == drawn.mobility
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected == 20
    assert {f.where for f in built.findings if f.code == "KIN012"} == {
        f"{n}_joint" for n, place in zip(SECTIONS, places, strict=True) if place != "drawn"
    }
    assert "telescope" not in {a.name for a in built.actuators}


def test_boom_lengths_and_angles_are_measured_as_it_is_pinned(pinned: Aligned, drawn: Mechanism) -> None:
    built = _held(pinned, dict.fromkeys(SECTIONS, "100"), _sheet())
    short, long = ({m.name: m.model for m in kinematics.measure(each)} for each in (drawn, built))
    assert "Boom Length Extended" not in short and "Boom Length Retracted" not in long
    assert short["Boom Length Retracted"] is not None and long["Boom Length Extended"] is not None
    assert long["Boom Length Extended"] - short["Boom Length Retracted"] == pytest.approx(3 * STROKE, rel=0.01)
    assert {"Maximum Working Radius", "Maximum Tip Height"} <= long.keys() - short.keys()
    # A joint that is held says which way its bodies point: it was taken to lie along the machine.
    line = np.asarray(drawn.joint("second_section_joint").axis)
    assert next(s for s in drawn.sites if s.name == "boom").x_axis == pytest.approx(tuple(line), abs=1e-9)
    assert short["Boom Angle Maximum"] == pytest.approx(long["Boom Angle Maximum"], abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("count", [5, 6])
def test_booms_of_five_and_six_sections_are_pinned(count: int) -> None:
    choices = {"telescoping": "pinned", "pinned_sections": {5: "five", 6: "six"}[count]}
    aligned = _aligned(crane(30 + count, sections=count, twin=False, hook=True, pinned=True), choices)
    names = ("second_section", "third_section", "fourth_section", "fifth_section", "sixth_section")[: count - 1]
    built = {place: _held(aligned, dict.fromkeys(names, place), _sheet()) for place in ("drawn", "46", "100")}
    for mechanism in built.values():
        assert mechanism.mobility is not None and mechanism.mobility.computed == mechanism.mobility.expected == 20
    apart = {p: _place(m, "boom_head") - _place(m, "boom_foot") for p, m in built.items()}
    way = np.asarray(built["100"].joint("second_section_joint").axis)
    assert apart["100"] - apart["drawn"] == pytest.approx((count - 1) * STROKE * way, abs=1e-9)
    assert apart["46"] - apart["drawn"] == pytest.approx(0.46 * (count - 1) * STROKE * way, abs=1e-9)
    measured = {p: {m.name: m.model for m in kinematics.measure(mechanism)} for p, mechanism in built.items()}
    assert "Boom Length Retracted" in measured["drawn"] and "Boom Length Extended" in measured["100"]
    assert not {"Boom Length Retracted", "Boom Length Extended"} & measured["46"].keys()
    assert measured["100"]["Boom Length Extended"] == pytest.approx(float(np.linalg.norm(apart["100"])), abs=1e-9)


def test_what_nothing_says_is_asked_for(pinned: Aligned) -> None:
    with pytest.raises(MechanismError, match="46 % of Telescoping Cylinder Stroke") as found:
        _held(pinned, {"second_section": "46"})
    assert found.value.where == "second_section_joint" and "--set" in str(found.value.hint)


@pytest.mark.slow
def test_in_mujoco_a_pinned_boom_is_one(pinned: Aligned, tmp_path: Path) -> None:
    built = _held(pinned, dict.fromkeys(SECTIONS, "92"), _sheet())
    path = export_mjcf(built, Geometry(), tmp_path, base="fixed")
    model = mujoco.MjModel.from_xml_path(str(path))
    assert not {model.joint(k).name for k in range(model.njnt)} & {f"{n}_joint" for n in SECTIONS}
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    foot, head = (np.asarray(built.body(b).origin) for b in ("boom", "inner_boom"))
    drawn_apart = float(np.linalg.norm(head - foot))
    for _ in range(500):
        mujoco.mj_step(model, data)
    apart = np.linalg.norm(data.body("inner_boom").xpos - data.body("boom").xpos)
    assert apart == pytest.approx(drawn_apart, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("offset", [0, 20, 40])
def test_a_jib_is_pinned_at_an_offset(jib: Aligned, offset: int) -> None:
    straight = _held(jib)
    built = _held(jib, {"jib_offset": str(offset)} if offset else None)
    assert built.joint("jib_offset_joint").type == "fixed"
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected
    foot, head = (_place(straight, name) for name in ("jib_foot", "jib_head"))
    assert _place(built, "jib_foot") == pytest.approx(foot, abs=1e-9)
    turn = math.radians(offset)
    arm = head - foot
    turned = np.array([[math.cos(turn), 0.0, math.sin(turn)], [0.0, 1.0, 0.0], [-math.sin(turn), 0.0, math.cos(turn)]])
    middle = foot + turned @ (np.asarray(straight.body("jib").center_of_mass) - foot)
    assert built.body("jib").center_of_mass == pytest.approx(tuple(middle), abs=1e-9)
    assert _place(built, "jib_head") == pytest.approx(foot + turned @ arm, abs=0.01)  # another corner is its farthest
    found = {m.name: m.model for m in kinematics.measure(built)}
    assert found["Jib Length"] == pytest.approx(float(np.linalg.norm(arm)), abs=0.01)
    # Raised about the boom's foot, all sections out.
    chain = kinematics.ClosedChain(built)
    joints = {a.name: built.joint(a.joints[0].joint) for a in built.actuators if a.name in ("telescope", "luffing")}
    state, share = chain.reach({j.name: float(j.upper or 0.0) for j in joints.values()})
    assert share == 1.0
    tip = chain.displacement(state, "jib") @ [*_place(built, "jib_head"), 1.0]
    assert found["Jib Tip Height"] == pytest.approx(float(tip[2]), abs=1e-9)
    boom = chain.displacement(state, "inner_boom") @ [*_place(built, "jib_foot"), 1.0]
    assert np.linalg.norm((tip - boom)[:3]) == pytest.approx(float(np.linalg.norm(arm)), abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "choices"),
    [(12, {"telescoping": "pinned"}), pytest.param(24, {"jib": "pinned"}, marks=pytest.mark.slow)],
)
def test_nameless_every_part_is_in_its_body(seed: int, choices: dict[str, str]) -> None:
    machine = crane(seed, sections=4, hook=True, pinned="jib" not in choices, jib="jib" in choices)
    assert found_whole(machine, "mobile_crane", seed, triangles=False, choices=choices).choices["sections"] == "four"


@pytest.fixture(scope="module")
def hooked() -> Aligned:
    machine = crane(26, sections=3, twin=False, hook=True, jib="hook")
    return _aligned(machine, {"jib": "pinned", "jib_hook": "hook"})


@pytest.mark.slow
@pytest.mark.parametrize("offset", ["drawn", "20", "40"])
def test_a_jib_has_a_hook_of_its_own_that_hangs_straight_down(hooked: Aligned, offset: str) -> None:
    drawn, built = _held(hooked), _held(hooked, {"jib_offset": offset})
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected
    winches = {a.name: a for a in built.actuators if a.falls}
    assert {name: a.falls for name, a in winches.items()} == {"hoist": 4, "jib_hoist": 1}
    ball, slide = built.joint("jib2jib_hoist_rope_joint"), built.joint("jib_hoist_rope2jib_hook_block_joint")
    assert ball.free and np.asarray(slide.axis) == pytest.approx([0.0, 0.0, -1.0], abs=1e-9)
    # As long as it was drawn, and below the jib's new end.
    lengths = [
        np.subtract(m.body("jib_hook_block").center_of_mass, m.joint("jib2jib_hoist_rope_joint").anchor)
        for m in (drawn, built)
    ]
    assert lengths[1] == pytest.approx(lengths[0], abs=1e-9)
    if offset != "drawn":
        assert ball.anchor[2] < drawn.joint("jib2jib_hoist_rope_joint").anchor[2] - 0.1


@pytest.mark.slow
def test_nameless_a_jib_s_hook_is_not_the_boom_s() -> None:
    machine = crane(27, sections=4, hook=True, jib="hook")
    found_whole(machine, "mobile_crane", 27, triangles=False, choices={"jib": "pinned", "jib_hook": "hook"})
