"""A dozer's oscillating track frames: one freedom more, their poses against a solution by the bar's circle, what a
front idler travels, every part found without names."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from kit.machines.partly_drawn import without
from kit.machines.rocking_dozers import rocking_dozer
from kit.machines.unseen import found_whole
from yellowiron.alignment.readings import align
from yellowiron.kinematics import ClosedChain, measure
from yellowiron.library import Documents, load_template
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specifications
from yellowiron.stages import solve

BAR = "main_frame2equalizer_bar_joint"
CHOICES = {"blade": "pat", "tilt": "single", "ripper": "none", "track_frames": "oscillating"}
SIDES = {"l": 1.0, "r": -1.0}


@pytest.fixture(scope="module")
def built() -> Mechanism:
    return without(rocking_dozer(731, "pat", ripper=""), "dozer", (), choices=CHOICES)


def _frame(mechanism: Mechanism, side: str, bar: float) -> float:
    """How far a track's frame is turned, nose down: its shackle's upper ball, on a circle about the pivot shaft, is as
    far as ever from the lower one, on the bar's circle."""
    pivot, hub, low, high = (
        np.array(mechanism.joint(name).anchor)
        for name in (
            f"main_frame2roller_frame_{side}_joint", BAR, f"equalizer_bar2equalizer_link_{side}_joint",
            f"roller_frame_{side}2equalizer_link_{side}_joint",
        )
    )  # fmt: skip
    y, z = _turned(low[1] - hub[1], low[2] - hub[2], bar)
    swung = np.array([low[0], hub[1] + y, hub[2] + z])

    def longer(turn: float) -> float:
        x, z = _turned(high[0] - pivot[0], high[2] - pivot[2], -turn)
        return math.dist((pivot[0] + x, high[1], pivot[2] + z), swung) - math.dist(high, low)

    return float(brentq(longer, -0.2, 0.2, xtol=1e-15, rtol=1e-14))


def _turned(along: float, up: float, turn: float) -> tuple[float, float]:
    c, s = math.cos(turn), math.sin(turn)
    return along * c - up * s, along * s + up * c


@pytest.mark.slow
def test_it_rocks_and_nothing_drives_it(built: Mechanism) -> None:
    fast = without(rocking_dozer(731, "pat", ripper=""), "dozer", ("roller_frame", "equalizer"),
                   choices={**CHOICES, "track_frames": "fixed"})  # fmt: skip
    assert built.mobility is not None and fast.mobility is not None
    assert built.mobility.computed == built.mobility.expected == fast.mobility.computed + 1
    assert BAR in ClosedChain(built).independent and built.joint(BAR).drive is None
    assert not any(BAR in (j.joint for j in a.joints) for a in built.actuators)
    assert not [f for f in built.findings if f.severity == "error"]


def test_its_frames_are_where_the_bars_circle_has_them(built: Mechanism) -> None:
    chain, bar = ClosedChain(built), built.joint(BAR)
    assert bar.lower is not None and bar.upper is not None
    worst = 0.0
    for turn in np.linspace(bar.lower, bar.upper, 21):
        state = chain.solve({BAR: float(turn)})
        for side in SIDES:
            found = chain.coordinate(state, f"main_frame2roller_frame_{side}_joint")
            # Two metres from the pivot shaft.
            worst = max(worst, 2.0 * abs(found - _frame(built, side, float(turn))))
    assert worst <= 1e-9


def test_one_goes_up_as_the_other_goes_down(built: Mechanism) -> None:
    """To first order by as much: what is left shrinks with the square of the turn."""
    chain = ClosedChain(built)
    left = []
    for turn in (0.02, 0.01):
        state = chain.solve({BAR: turn})
        ways = [chain.coordinate(state, f"main_frame2roller_frame_{side}_joint") for side in SIDES]
        assert ways[0] * ways[1] < 0.0 and abs(ways[0]) > 0.2 * turn
        left.append(abs(sum(ways)))
    assert left[0] < 1e-3 * 0.02 or left[0] / left[1] == pytest.approx(4.0, rel=0.1)


def test_a_front_idlers_travel_is_measured(built: Mechanism) -> None:
    found = {m.name: m.model for m in measure(built)}["Oscillation at Front Idler"]
    site = next(s for s in built.sites if s.name == "rocking_idler")
    pivot, bar = built.joint("main_frame2roller_frame_l_joint").anchor, built.joint(BAR)
    assert bar.lower is not None and bar.upper is not None
    heights = [
        _turned(site.position[0] - pivot[0], site.position[2] - pivot[2], -_frame(built, "l", end))[1]
        for end in (bar.lower, bar.upper)
    ]
    assert found == pytest.approx(abs(heights[1] - heights[0]), abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "blade", "high", "triangles"),
    [
        (732, "pat", False, False),
        (733, "push_arms", False, True),
        (734, "pat", True, False),
        pytest.param(735, "push_arms", True, True, marks=pytest.mark.slow),
    ],
)
def test_nameless_every_part_is_in_its_body(seed: int, blade: str, high: bool, triangles: bool) -> None:
    """The sprocket on top of a track is the main frame's, the idlers below are the track frame's."""
    found = found_whole(rocking_dozer(seed, blade, high=high), "dozer", seed, triangles=triangles)
    assert found.choices["track_frames"] == "oscillating" and found.choices["blade"] == blade


@pytest.mark.slow
def test_a_pivot_that_does_not_reach_its_limit_is_told_in_degrees() -> None:
    """A bar's 4° were 70 mm."""
    machine = rocking_dozer(733, "push_arms", high=False, ripper="")
    choices = {**CHOICES, "blade": "push_arms", "tilt": "dual"}
    words = next(f.message for f in without(machine, "dozer", (), choices=choices).findings if f.code == "KIN002")
    assert f"{BAR} -4°" in words


@pytest.mark.slow
def test_a_high_sprocket_drives_its_shoes_and_the_rear_idler_rolls_on_the_track_frame() -> None:
    """The rear idler had the sprocket's role: it hung on the main frame, and drove."""
    machine = rocking_dozer(734, "pat", high=True, ripper="")
    template, assembly, choices = load_template("dozer"), machine.assembly(), {"tracks": "shoes"}
    found = align(assembly, template, Specifications(), choices=choices)
    assert not found.missing
    built = solve(template, assembly, found, Specifications(), Documents(), choices).mechanism
    assert built.mobility is not None and built.mobility.computed == built.mobility.expected
    for side, way in (("l", "left"), ("r", "right")):
        sprocket, idler = (
            built.joint(f"{on}_{side}_joint") for on in ("main_frame2sprocket", f"roller_frame_{side}2idler")
        )
        rollers = [j for j in built.joints if j.name.startswith(f"roller_frame_{side}2track_roller_{side}_joint_")]
        rear = min(rollers, key=lambda joint: joint.anchor[0])
        assert sprocket.drive is not None and sprocket.anchor[2] > 2.0 * idler.anchor[2]
        assert rear.anchor[2] == pytest.approx(idler.anchor[2], abs=1e-6) and rear.drive is None and rear.free
        assert next(a for a in built.actuators if a.name == f"travel_{way}").joints[0].joint == sprocket.name
        if side == "l":
            length = {m.name: m.model for m in measure(built)}["Track Length on Ground"]
            assert length == pytest.approx(idler.anchor[0] - rear.anchor[0], abs=1e-6)
