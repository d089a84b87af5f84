"""The wheel loader example: linkage, file and truth agree, and it is drawn the same again."""

from __future__ import annotations

import collections
import json
import math
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from example_drawn import differences
from example_file import EXAMPLES, Bore, Leaf, bores_of, gaps, module, planes_along, read_step, solids_of
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps

TYPE = "wheel_loader"
FOLDER = EXAMPLES / "wheel_loader"
PERCENT = 0.02


@pytest.fixture(scope="module")
def linkage() -> ModuleType:
    return module("wheel_loader", "linkage")


@pytest.fixture(scope="module")
def truth() -> dict[str, Any]:
    document: dict[str, Any] = json.loads((FOLDER / "truth.json").read_text(encoding="utf-8"))
    return document


@pytest.fixture(scope="module")
def leaves() -> list[Leaf]:
    """Every part of the committed file in tree order."""
    return read_step(FOLDER / "wheel_loader.step")


@pytest.fixture(scope="module")
def bores(leaves: list[Leaf]) -> dict[str, list[Bore]]:
    """Cylindrical faces by part, metres, CAD frame."""
    return bores_of(leaves)


def _coaxial(bore: Bore, joint: dict[str, Any]) -> bool:
    axis, offset = np.array(joint["axis"]), bore.point - np.array(joint["anchor"])
    return bool(np.linalg.norm(np.cross(bore.axis, axis)) < 1e-7 and np.linalg.norm(np.cross(offset, axis)) < 1e-7)


# ---- the linkage --------
def test_example_values_are_what_the_drawing_gives(values: ModuleType, linkage: ModuleType) -> None:
    assert linkage.solve().breakout() == pytest.approx(values.BREAKOUT_FORCE.value, abs=0.5)  # as printed, whole kN
    half = math.radians(values.STEER_ANGLE.value) / 2
    radius = values.WHEELBASE.value / 2 / math.tan(half) + values.TREAD.value / 2
    assert radius == pytest.approx(values.TURNING_RADIUS.value, abs=5.0)  # as printed, centimetres


def test_published_values_are_the_makers(values: ModuleType, shared_data: Path) -> None:
    facts = json.loads((shared_data / "facts" / "komatsu-wa475-10.json").read_text(encoding="utf-8"))["facts"]
    makers = {fact["name"]: (fact["value"], fact["unit"], fact["location"]) for fact in facts}
    assert len(values.PUBLISHED) >= 30
    for value in values.PUBLISHED:
        number, unit, location = makers[value.source]
        assert (value.value, value.unit) == (number, unit)
        assert location.startswith(value.location)


def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    names = [value.name for value in (*values.PUBLISHED, *values.EXAMPLE, *values.DRAWN_ONLY)]
    assert len(names) == len(set(names))
    assert not {v.name for v in values.PUBLISHED} & {v.name for v in values.EXAMPLE}


def test_every_value_is_met(truth: dict[str, Any], values: ModuleType) -> None:
    assert len(truth["values"]) >= 17
    for name, row in truth["values"].items():
        for how in ("linkage", "drawn"):
            if how in row:
                assert abs(row[how] / row["target"] - 1) * 100 < PERCENT, (name, how)
                if row["unit"] == "deg":
                    assert abs(row[how] - row["target"]) < 0.01


def test_dump_and_lift_by_the_pins(linkage: ModuleType, values: ModuleType) -> None:
    k = linkage.solve()
    lift, tilt = linkage.LIFT_MAX, k.tilt_for(linkage.LIFT_MAX, math.radians(-45.0))
    assert linkage.TILT_MIN + 10 < tilt < linkage.TILT_MAX
    pose = k.pose(lift, tilt)
    assert pose.B[1] == pytest.approx(values.HINGE_HEIGHT_MAX.value, rel=PERCENT / 100)
    assert pose.T[1] == pytest.approx(values.DUMP_CLEARANCE.value, rel=PERCENT / 100)
    reach = pose.T[0] - values.WHEELBASE.value / 2 - values.TYRE_DIAMETER.value / 2
    assert reach == pytest.approx(values.DUMP_REACH.value, rel=PERCENT / 100)
    # the pins keep their distances
    for p in (pose, k.pose(linkage.LIFT_MIN, linkage.TILT_MAX)):
        assert np.hypot(*(p.F - k.E)) == pytest.approx(p.tilt)
        assert np.hypot(*(p.D - k.C)) == pytest.approx(p.lift)
        assert np.hypot(*(p.H - p.J)) == pytest.approx(k.link)
        assert np.hypot(*(p.F - p.G)) == pytest.approx(k.rocker)


def test_no_dead_point_and_no_flip(linkage: ModuleType) -> None:
    k = linkage.solve()
    signs = (1, -1, 1, 1)
    for lift in np.linspace(linkage.LIFT_MIN, linkage.LIFT_MAX, 21):
        angles = []
        for tilt in np.linspace(linkage.TILT_MIN, linkage.TILT_MAX, 21):
            pose = k.pose(float(lift), float(tilt))
            angles.append(pose.bucket_angle)
            assert all(m * s > 0.2 for m, s in zip(k.margins(pose), signs, strict=True))
        assert (np.diff(angles) > 0).all()


def test_steering_reaches_both_locks(linkage: ModuleType, values: ModuleType) -> None:
    s = linkage.solve_steering()
    lock = math.radians(values.STEER_ANGLE.value)
    closed = values.STEER_CLOSED.value
    assert s.length(lock) == pytest.approx(closed, abs=1e-6)
    assert s.length(-lock) == pytest.approx(closed + values.STEER_STROKE.value, abs=1e-6)
    lengths = [s.length(float(a)) for a in np.linspace(-lock, lock, 41)]
    assert (np.diff(lengths) < 0).all()


def test_no_cylinder_is_drawn_at_an_end(truth: dict[str, Any]) -> None:
    assert len(truth["cylinders"]) == 5
    for name, row in truth["cylinders"].items():
        used = (row["drawn_length"] - row["closed_length"]) / row["stroke"]
        assert 0.2 < used < 0.8, name
        assert row["rod_diameter"] < row["bore"]


# ---- the file and the truth --------
def test_tree_is_what_the_truth_lists(leaves: list[Leaf], truth: dict[str, Any]) -> None:
    assert len(leaves) >= 180
    assert [leaf.path for leaf in leaves] == list(truth["parts"])
    assert len({leaf.product for leaf in leaves}) < 0.75 * len(leaves), "shapes are shared by instances"
    assert max(leaf.path.count("/") for leaf in leaves) >= 3
    assert (FOLDER / "wheel_loader.step").stat().st_size < 4e6


def test_the_tree_is_not_the_bodies(truth: dict[str, Any]) -> None:
    groups = collections.defaultdict(set)
    for path, row in truth["parts"].items():
        groups[path.split("/")[1]].add(row["body"])
    assert len(groups["HARDWARE"]) > 6
    assert len(groups["HYDRAULICS"]) == 10


def test_bodies_and_joints_name_each_other(truth: dict[str, Any]) -> None:
    bodies = {row["body"] for row in truth["parts"].values()}
    assert len(bodies) == 21
    jointed = {body for joint in truth["joints"].values() for body in (joint["body0"], joint["body1"])}
    assert bodies == jointed
    assert len(truth["joints"]) == 26
    loops = len(truth["joints"]) - (len(bodies) - 1)
    assert loops == 6  # two steering, two lift, the tilt cylinder's and the bucket's


def test_frame_is_a_turn_and_wheels_stand_on_the_ground(leaves: list[Leaf], truth: dict[str, Any]) -> None:
    m = np.array(truth["frame"])
    assert np.allclose(m[:3, :3] @ m[:3, :3].T, np.eye(3)) and np.linalg.det(m) == pytest.approx(1.0)
    assert not np.allclose(m, np.eye(4))
    wheel = next(j for n, j in truth["joints"].items() if n == "front_wheel_l_joint")
    centre = m[:3, :3] @ wheel["anchor"] + m[:3, 3]
    assert np.allclose(centre, [1.725, 1.1925, 0.875])


def test_axes_are_those_of_bores_in_both_bodies(truth: dict[str, Any], bores: dict[str, list[Bore]]) -> None:
    by_body: dict[str, list[tuple[str, Bore]]] = collections.defaultdict(list)
    for path, row in truth["parts"].items():
        by_body[row["body"]] += [(path, bore) for bore in bores.get(path, [])]
    for name, joint in truth["joints"].items():
        for body in (joint["body0"], joint["body1"]):
            assert any(_coaxial(bore, joint) for _, bore in by_body[body]), (name, body)


def test_pins_lie_on_their_joints(truth: dict[str, Any], bores: dict[str, list[Bore]]) -> None:
    pins = collections.Counter(row["role"] for row in truth["parts"].values() if row["role"].endswith("_pin"))
    assert pins["rear_front_pin"] == pins["boom_pin"] == pins["bucket_pin"] == pins["rear_axle_pin"] == 2
    assert len(pins) == 17
    for path, row in truth["parts"].items():
        if row["role"].endswith("_pin"):
            near = [n for n, j in truth["joints"].items() if all(_coaxial(bore, j) for bore in bores[path])]
            assert near, path
            assert any(row["body"] in (truth["joints"][n]["body0"], truth["joints"][n]["body1"]) for n in near), path


def test_piston_travel_is_the_stroke(leaves: list[Leaf], truth: dict[str, Any]) -> None:
    """Shapes: cap to gland less the piston is the stroke, the piston's gap to the cap the extension."""
    for joint_name, row in truth["cylinders"].items():
        joint = truth["joints"][joint_name]
        axis, anchor = np.array(joint["axis"]), np.array(joint["anchor"])
        barrel, piston_rod = joint["body0"], joint["body1"]

        def part(body: str, word: str) -> Leaf:
            return next(x for x in leaves if word in x.path and truth["parts"][x.path]["body"] == body)

        cap = planes_along(part(barrel, " TUBE"), axis, anchor)[1]
        gland = planes_along(part(barrel, " GLAND"), axis, anchor)
        piston = planes_along(part(piston_rod, " PISTON"), axis, anchor)
        assert gland[0] - cap - (piston[-1] - piston[0]) == pytest.approx(row["stroke"], abs=1e-7)
        assert piston[0] - cap == pytest.approx(row["drawn_length"] - row["closed_length"], abs=1e-7)
        assert row["closed_length"] - gland[-1] > 0.075, "the rod eye stays clear of the gland"


def test_masses_are_plausible(leaves: list[Leaf], truth: dict[str, Any], values: ModuleType) -> None:
    total: collections.Counter[str] = collections.Counter()
    for leaf in leaves:
        props = GProp_GProps()
        BRepGProp.VolumeProperties_s(leaf.shape, props)
        assert props.Mass() > 0, leaf.path
        density = 1100.0 if "TYRE" in leaf.path else 7850.0
        total[truth["parts"][leaf.path]["body"]] += props.Mass() * 1e-9 * density
    assert total["bucket"] == pytest.approx(values.BUCKET_WEIGHT.value, rel=0.1)
    assert sum(total.values()) == pytest.approx(values.OPERATING_WEIGHT.value, rel=0.1)


# ---- slow --------
@pytest.fixture(scope="module")
def moves_of(linkage: ModuleType) -> Callable[..., dict[str, np.ndarray]]:
    """Where each body goes, machine frame in millimetres, from the drawn pose to another."""
    k, start, steering = module("wheel_loader", "draw").drawn_pose()
    direction = linkage.direction

    def frame(origin: np.ndarray, angle: float, plane: tuple[int, int]) -> np.ndarray:
        m, c, s = np.eye(4), math.cos(angle), math.sin(angle)
        u, w = plane
        m[u, u], m[u, w], m[w, u], m[w, w] = c, -s, s, c
        m[u, 3], m[w, 3] = origin
        return m

    def frames(pose: Any) -> dict[str, np.ndarray]:
        side, lift, tilt = (0, 2), direction(pose.D - k.C), direction(pose.F - k.E)
        out = {
            "boom": frame(k.A, pose.boom_angle, side),
            "rocker": frame(pose.G, pose.rocker_angle, side),
            "bucket_link": frame(pose.H, direction(pose.J - pose.H), side),
            "bucket": frame(pose.B, pose.bucket_angle, side),
            "bucket_cylinder_barrel": frame(k.E, tilt, side),
            "bucket_piston_rod": frame(pose.F, tilt, side),
        }
        for letter in "lr":
            out[f"boom_cylinder_barrel_{letter}"] = frame(k.C, lift, side)
            out[f"boom_piston_rod_{letter}"] = frame(pose.D, lift, side)
        return out

    def moves(lift: float, tilt: float, steer: float = 0.0, swing: float = 0.0) -> dict[str, np.ndarray]:
        before, after = frames(start), frames(k.pose(lift, tilt))
        turn = frame(np.zeros(2), steer, (0, 1))
        out = {body: turn @ after[body] @ np.linalg.inv(before[body]) for body in before}
        for body in ("front_frame", "front_wheel_l", "front_wheel_r"):
            out[body] = turn
        for letter, sign in (("l", 1.0), ("r", -1.0)):
            p, q = steering.P * (1.0, sign), steering.Q * (1.0, sign)
            there = linkage.rot(steer, q)
            for body, a, b in (("barrel", p, p), ("rod", q, there)):
                name = f"steering_{'cylinder_barrel' if body == 'barrel' else 'piston_rod'}_{letter}"
                old, new = frame(a, direction(q - p), (0, 1)), frame(b, direction(there - p), (0, 1))
                out[name] = new @ np.linalg.inv(old)
        centre = np.array([0.0, linkage.TYRE_RADIUS])
        axle = frame(centre, swing, (1, 2)) @ np.linalg.inv(frame(centre, 0.0, (1, 2)))
        out |= dict.fromkeys(("rear_axle", "rear_wheel_l", "rear_wheel_r"), axle)
        return out | {"rear_frame": np.eye(4)}

    return moves


@pytest.mark.slow
def test_parts_touch_within_bodies_and_only_at_hinges_between_them(leaves: list[Leaf], truth: dict[str, Any]) -> None:
    body = [truth["parts"][leaf.path]["body"] for leaf in leaves]
    jointed = {frozenset((j["body0"], j["body1"])) for j in truth["joints"].values()}
    touching: dict[int, list[int]] = collections.defaultdict(list)
    for (i, j), gap in gaps(solids_of(leaves), [np.eye(4)] * len(leaves), 3.0).items():
        if body[i] == body[j]:
            if gap < 0.5:
                touching[i].append(j)
                touching[j].append(i)
        else:
            assert gap > 0, (leaves[i].path, leaves[j].path)
            assert frozenset((body[i], body[j])) in jointed, (leaves[i].path, leaves[j].path)
    for name in set(body):
        members = {i for i, b in enumerate(body) if b == name}
        reached: set[int] = set()
        front = [min(members)]
        while front:
            here = front.pop()
            if here not in reached:
                reached.add(here)
                front += touching[here]
        assert reached == members, [leaves[i].path for i in members - reached]


@pytest.mark.slow
def test_nothing_meets_over_the_strokes(
    leaves: list[Leaf],
    truth: dict[str, Any],
    linkage: ModuleType,
    moves_of: Callable[..., dict[str, np.ndarray]],
) -> None:
    solids = solids_of(leaves)
    body = [truth["parts"][leaf.path]["body"] for leaf in leaves]
    to_machine = np.array(truth["frame"])
    to_machine[:3, 3] *= 1000.0
    back = np.linalg.inv(to_machine)

    def near(within: float, **pose: float) -> set[tuple[int, int]]:
        moves = moves_of(**pose)
        matrices = [back @ moves[b] @ to_machine for b in body]
        return {pair for pair in gaps(solids, matrices, within) if body[pair[0]] != body[pair[1]]}

    _, start, _ = module("wheel_loader", "draw").drawn_pose()
    drawn = {"lift": start.lift, "tilt": start.tilt}
    hinges = near(3.0, **drawn)
    ends = ("PISTON", "GLAND", "TUBE", " ROD")
    lifts = (linkage.LIFT_MIN, 0.5 * (linkage.LIFT_MIN + linkage.LIFT_MAX), linkage.LIFT_MAX)
    tilts = (linkage.TILT_MIN, 0.5 * (linkage.TILT_MIN + linkage.TILT_MAX), linkage.TILT_MAX)
    poses = [{"lift": lift, "tilt": tilt} for lift in lifts for tilt in tilts]
    poses += [{**drawn, "steer": math.radians(a)} for a in (-40.0, -20.0, 20.0, 40.0)]
    poses += [{**drawn, "swing": math.radians(a)} for a in (-13.0, 13.0)]
    for pose in poses:
        for i, j in near(2.5, **pose) - hinges:
            # a piston at its cap or gland is the end of the stroke
            assert all(any(word in leaves[n].path for word in ends) for n in (i, j)), (
                pose,
                leaves[i].path,
                leaves[j].path,
            )


@pytest.mark.slow
def test_drawing_again_gives_the_same_machine(tmp_path: Path) -> None:
    command = [sys.executable, "-m", f"{FOLDER.name}.draw", str(tmp_path)]
    subprocess.run(command, check=True, capture_output=True, timeout=300, cwd=FOLDER.parent)
    for name in ("wheel_loader.step", "truth.json"):
        assert differences(tmp_path / name, FOLDER / name) == []
