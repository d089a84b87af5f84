"""Extremes over several actuators against a planar arm's answers in closed form."""

from __future__ import annotations

import itertools
import math
import time
from dataclasses import replace

import numpy as np
import pytest
from planar_arm import Arm, arm_mechanism
from scipy.optimize import brentq

from yellowiron.kinematics import measure
from yellowiron.kinematics.measuring import extremes
from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.extremes import Strokes
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.model.template import MeasurementTemplate

EQUIPMENT = ["boom", "arm", "bucket"]
HEIGHT = {"kind": "height", "site": "tip"}
REACH = {"kind": "reach", "site": "tip", "from": "swing"}
PITCH = {"kind": "angle", "site": "tip"}


def extreme(quantity, of, *subject, actuators=EQUIPMENT):
    conditions = [{"quantity": q, "value": v} for q, v in subject]
    return {"extreme": {"actuators": list(actuators), "quantity": quantity, "of": of, "subject": conditions}}


def level(length: float, specification: str = ""):
    entry = {"specification": specification, "value": length}
    return {"level_cut": {"actuators": EQUIPMENT, "height": HEIGHT, "reach": REACH, "length": entry}}


def value(arm: Arm, quantity, *steps) -> float:
    bench = Bench(arm_mechanism(arm))
    return bench.value(quantity, bench.pose(steps))


@pytest.fixture(scope="module")
def arm() -> Arm:
    return Arm()


def test_deepest_point_hangs_from_the_lowered_boom(arm: Arm) -> None:
    """Arm and bucket can both hang straight down below the boom's end."""
    depth = arm.z + arm.boom * math.sin(arm.booms[0]) - arm.arm - arm.bucket
    assert value(arm, HEIGHT, extreme(HEIGHT, "min")) == pytest.approx(depth, abs=1e-6)


def test_farthest_point_has_the_bucket_in_line_with_foot_and_pin(arm: Arm) -> None:
    """The arm opens to 32 degrees against the boom, and the bucket can bend back by more than it takes."""
    pin = math.sqrt(arm.boom**2 + arm.arm**2 + 2.0 * arm.boom * arm.arm * math.cos(arm.arms[1]))
    far = pin + arm.bucket
    assert value(arm, REACH, extreme(REACH, "max")) == pytest.approx(arm.x + far, abs=1e-6)
    on_ground = arm.x + math.sqrt(far**2 - arm.z**2)
    assert value(arm, REACH, extreme(REACH, "max", (HEIGHT, 0.0))) == pytest.approx(on_ground, abs=1e-6)


def test_highest_point_is_at_the_ends_of_the_strokes(arm: Arm) -> None:
    """With the boom up at 60 degrees, the arm opened and the bucket turned out beyond it, nothing stands upright: each
    is at its end but the bucket, which is where the pitch is 68 degrees at most."""
    pitch = arm.booms[1] + arm.arms[1]
    last = min(pitch + arm.buckets[1], math.pi / 2.0)
    top = arm.z + arm.boom * math.sin(arm.booms[1]) + arm.arm * math.sin(pitch) + arm.bucket * math.sin(last)
    assert value(arm, HEIGHT, extreme(HEIGHT, "max")) == pytest.approx(top, abs=1e-6)


def test_lowest_point_while_the_bucket_is_upright(arm: Arm) -> None:
    """A boom that cannot be lowered far, and an arm that cannot hang: the bucket, upright below it, can."""
    stiff = replace(arm, booms=(0.0, 1.0), arms=(-1.0, -0.3), buckets=(-2.0, 0.2))
    depth = arm.z + arm.arm * math.sin(-1.0) - arm.bucket
    steps = extreme(HEIGHT, "min", (PITCH, -math.pi / 2.0))
    assert value(stiff, HEIGHT, steps) == pytest.approx(depth, abs=1e-6)
    with pytest.raises(Unmeasurable, match="no pose within the strokes"):
        value(replace(stiff, buckets=(-0.2, 0.2)), HEIGHT, steps)


def test_level_cut_is_as_deep_as_its_length_allows(arm: Arm) -> None:
    """The bucket does not bend back, so it stays in line with the arm. Near end: the circle about the lowered boom's
    end. Far end: that circle until the arm is open, then the boom rises: a circle about the foot."""
    arm = replace(arm, buckets=(arm.buckets[0], 0.0))
    elbow = np.array([arm.x + arm.boom * math.cos(arm.booms[0]), arm.z + arm.boom * math.sin(arm.booms[0])])
    second = arm.arm + arm.bucket

    def length(depth: float) -> float:
        aside = math.sqrt(second**2 - (elbow[1] + depth) ** 2)
        near = elbow[0] - aside
        open_pitch = arm.booms[0] + arm.arms[1]
        if math.atan2(-(elbow[1] + depth), aside) <= open_pitch:
            return elbow[0] + aside - near
        far = arm.boom**2 + second**2 + 2.0 * arm.boom * second * math.cos(arm.arms[1])
        return arm.x + math.sqrt(far - (arm.z + depth) ** 2) - near

    deepest = -(elbow[1] - second)
    depth = brentq(lambda d: length(d) - 2.44, deepest - 1.0, deepest - 1e-6)
    assert value(arm, HEIGHT, level(2.44)) == pytest.approx(-depth, abs=1e-5)


@pytest.mark.slow
def test_level_cut_takes_the_length_that_the_sheet_prints(arm: Arm) -> None:
    sheet = {"Level Bottom Length": {"value": 2.0, "status": "ok"}}
    mechanism = replace(arm_mechanism(arm), specifications=sheet)
    bench = Bench(mechanism)
    printed = bench.value(HEIGHT, bench.pose([level(2.44, "Level Bottom Length")]))
    assert printed == pytest.approx(value(arm, HEIGHT, level(2.0)), abs=1e-7)
    assert printed < value(arm, HEIGHT, level(2.44))


def test_a_cut_longer_than_the_reach_is_told(arm: Arm) -> None:
    with pytest.raises(Unmeasurable, match="no level cut of 15 m"):
        value(arm, HEIGHT, level(15.0))


def test_a_cut_that_jumps_between_poses_is_told(arm: Arm, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a linkage that was put together wrongly the cut at one height is another the next time it is asked for."""

    def moved(*given: object, **named: object) -> float:
        raise ValueError("f(a) and f(b) must have different signs")

    monkeypatch.setattr(extremes, "brentq", moved)
    with pytest.raises(Unmeasurable, match="jumps"):
        value(arm, HEIGHT, level(2.44))


def test_one_actuator_after_another(arm: Arm) -> None:
    """Maximum dumping height: the pin as high as it comes, the bucket hanging."""
    pin = {"kind": "height", "joint": "bucket_joint"}
    steps = [
        extreme(pin, "max", actuators=["boom", "arm"]),
        {"extreme": {"actuator": "bucket", "quantity": HEIGHT, "of": "min"}},
    ]
    pitch = arm.booms[1] + arm.arms[1]
    hangs = max(pitch + arm.buckets[0], -math.pi / 2.0)
    height = arm.z + arm.boom * math.sin(arm.booms[1]) + arm.arm * math.sin(pitch) + arm.bucket * math.sin(hangs)
    assert value(arm, HEIGHT, *steps) == pytest.approx(height, abs=1e-6)


def test_an_extent_has_kinks_and_its_extreme_is_found(arm: Arm) -> None:
    """Least height of the highest point of arm and bucket: corners take turns in being the highest."""
    top = {"kind": "extent", "axis": "z", "of": "max", "bodies": ["arm", "bucket"]}
    found = value(arm, top, {"set": {"boom": "max"}}, extreme(top, "min", actuators=["arm", "bucket"]))
    ends = [np.linspace(*each, 241) for each in (arm.arms, arm.buckets)]
    best = math.inf
    for fold, curl in itertools.product(*ends):
        elbow = arm.z + arm.boom * math.sin(arm.booms[1])
        pin = elbow + arm.arm * math.sin(arm.booms[1] + fold)
        best = min(best, max(elbow, pin, pin + arm.bucket * math.sin(arm.booms[1] + fold + curl)))
    assert found == pytest.approx(best, abs=2e-3)
    assert found <= best + 1e-9


@pytest.mark.slow
def test_no_valley_is_missed_and_the_same_comes_out_again(arm: Arm) -> None:
    """Against every pose of a fine grid, for arms of several proportions."""
    for k in range(3):
        other = replace(arm, boom=5.0 + k, arm=2.0 + 0.7 * k, bucket=1.9 - 0.4 * k, booms=(-0.9 + 0.2 * k, 0.9))
        tips = [
            other.tip(*angles)
            for angles in itertools.product(*(np.linspace(*e, 25) for e in (other.booms, other.arms, other.buckets)))
        ]
        low, high = np.min(tips, axis=0), np.max(tips, axis=0)
        assert value(other, HEIGHT, extreme(HEIGHT, "min")) <= low[1] + 1e-9
        assert value(other, HEIGHT, extreme(HEIGHT, "max")) >= high[1] - 1e-9
        assert value(other, REACH, extreme(REACH, "max")) >= high[0] - 1e-9
        assert value(other, REACH, extreme(REACH, "min")) <= low[0] + 1e-9
        first, again = (value(other, REACH, extreme(REACH, "max", (HEIGHT, -1.0))) for _ in range(2))
        assert first == again


def test_strokes_that_lock_or_are_not_there_are_told(arm: Arm) -> None:
    bench = Bench(arm_mechanism(arm))
    with pytest.raises(Unmeasurable, match="has no end of stroke"):
        Strokes(bench, ["swing"], bench.chain.drawn)
    with pytest.raises(Unmeasurable, match="no actuator 'lift'"):
        Strokes(bench, ["lift"], bench.chain.drawn)
    stuck = Bench(arm_mechanism(replace(arm, booms=(0.1, 0.1))))
    with pytest.raises(Unmeasurable, match="no stroke between its ends"):
        Strokes(stuck, EQUIPMENT, stuck.chain.drawn)


def test_radius_zone_and_patterns(arm: Arm) -> None:
    tail = {"kind": "radius", "joint": "swing", "bodies": ["upper"], "of": "rear"}
    assert value(arm, tail) == pytest.approx(math.hypot(2.4, 1.2))
    assert value(arm, {**tail, "of": "front"}) == pytest.approx(math.hypot(1.2, 1.4))
    assert value(arm, {"kind": "radius", "joint": "bucket_joint", "site": "tip"}) == pytest.approx(arm.bucket)
    lowest = {"kind": "extent", "axis": "z", "of": "min", "bodies": ["upp*"]}
    assert value(arm, lowest) == pytest.approx(0.9)
    assert value(arm, {**lowest, "zone": {"x": [0, 0.25]}}) == pytest.approx(1.1)
    with pytest.raises(Unmeasurable, match="none of these bodies"):
        value(arm, {**lowest, "bodies": ["track_*"]})


def test_all_working_ranges_take_a_second_or_two(arm: Arm) -> None:
    """Bound generous: the machines that run this are not alone."""
    ranges = [
        MeasurementTemplate(f"range {k}", f"range {k}", HEIGHT, (step,))
        for k, step in enumerate(
            (
                extreme(HEIGHT, "min"), extreme(HEIGHT, "max"), extreme(REACH, "max"),
                extreme(REACH, "max", (HEIGHT, 0.0)), extreme(HEIGHT, "min", (PITCH, -math.pi / 2.0)), level(2.44),
            )
        )
    ]  # fmt: skip
    mechanism = replace(arm_mechanism(arm), measurements=tuple(ranges))
    started = time.process_time()
    assert all(m.model is not None for m in measure(mechanism))
    assert time.process_time() - started < 6.0
