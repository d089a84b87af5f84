"""The excavator example: linkage, track, file and truth agree, and it is drawn the same again."""

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
from example_file import EXAMPLES, Bore, Leaf, bores_of, gaps, mesh_of, module, planes_along, read_step, solids_of
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps

TYPE = "excavator"
FOLDER = EXAMPLES / "excavator"
PERCENT = 0.02


@pytest.fixture(scope="module")
def linkage() -> ModuleType:
    return module("excavator", "linkage")


@pytest.fixture(scope="module")
def digger() -> ModuleType:
    return module("drawing", "digger")


@pytest.fixture(scope="module")
def track() -> ModuleType:
    return module("excavator", "track")


@pytest.fixture(scope="module")
def truth() -> dict[str, Any]:
    document: dict[str, Any] = json.loads((FOLDER / "truth.json").read_text(encoding="utf-8"))
    return document


@pytest.fixture(scope="module")
def leaves() -> list[Leaf]:
    """Every part of the committed file in tree order."""
    return read_step(FOLDER / "excavator.step")


@pytest.fixture(scope="module")
def bores(leaves: list[Leaf]) -> dict[str, list[Bore]]:
    """Cylindrical faces by part, metres, CAD frame."""
    return bores_of(leaves)


# ---- values --------
def test_published_values_are_the_makers(values: ModuleType, shared_data: Path) -> None:
    facts = json.loads((shared_data / "facts" / "komatsu-pc210lc-11.json").read_text(encoding="utf-8"))["facts"]
    makers = {fact["name"]: (fact["value"], fact["unit"], fact["location"]) for fact in facts}
    assert {value.source for value in values.PUBLISHED} == set(makers), "every fact of the maker's is used"
    for value in values.PUBLISHED:
        number, unit, location = makers[value.source]
        assert (number, unit) == (value.value if value.high is None else [value.value, value.high], value.unit)
        assert location.startswith(value.location)


def test_values_are_either_published_or_ours(values: ModuleType) -> None:
    names = [value.name for value in (*values.PUBLISHED, *values.EXAMPLE, *values.DRAWN_ONLY)]
    assert len(names) == len(set(names))
    weights = values.OPERATING_WEIGHT_RANGE
    assert weights.value <= values.OPERATING_WEIGHT.value <= weights.high


def test_every_value_is_met(truth: dict[str, Any]) -> None:
    assert len(truth["values"]) >= 24
    assert sum("linkage" in row for row in truth["values"].values()) >= 10
    for name, row in truth["values"].items():
        for how in ("linkage", "drawn"):
            if how in row and row["unit"] == "kN":  # printed to a tenth
                assert row[how] == pytest.approx(row["target"], abs=0.05)
            elif how in row:
                assert abs(row[how] / row["target"] - 1) * 100 < PERCENT, (name, how, row)


# ---- the linkage, measured by brute force --------
@pytest.fixture(scope="module")
def strokes(linkage: ModuleType) -> list[tuple[float, float, float]]:
    """Of boom, arm and bucket: every corner of the work space and what lies between."""
    booms = np.linspace(linkage.BOOM_MIN, linkage.BOOM_MAX, 61)
    arms = np.linspace(linkage.ARM_MIN, linkage.ARM_MAX, 41)
    buckets = np.linspace(linkage.BUCKET_MIN, linkage.BUCKET_MAX, 41)
    return [(float(b), float(a), float(c)) for b in booms for a in arms for c in buckets]


@pytest.mark.slow
def test_ranges_are_the_work_spaces(
    strokes: list[tuple[float, float, float]], values: ModuleType, linkage: ModuleType
) -> None:
    """No pose on the grid goes beyond a range, and the nearest comes close to it."""
    k = linkage.solve()
    poses = [k.pose(*each) for each in strokes]
    tips = np.array([p.T for p in poses])
    pins = np.array([p.K for p in poses])
    assert tips[:, 1].max() == pytest.approx(values.DIGGING_HEIGHT.value, abs=1e-6)
    assert values.DIGGING_DEPTH.value - 40 < -tips[:, 1].min() < values.DIGGING_DEPTH.value + 1e-6
    assert values.MAX_REACH.value - 40 < tips[:, 0].max() < values.MAX_REACH.value + 1e-6
    level = np.abs(tips[:, 1]) < 60
    assert values.GROUND_REACH.value - 60 < tips[level, 0].max() < values.GROUND_REACH.value + 20
    tip = linkage.solve().tip
    assert pins[:, 1].max() - tip == pytest.approx(values.DUMPING_HEIGHT.value, abs=1e-6)
    deep = tips[np.abs(tips[:, 1] + values.LEVEL_DEPTH.value) < 25, 0]
    assert np.ptp(deep) == pytest.approx(values.LEVEL_LENGTH, abs=250)


def test_dumping_heights_are_within_the_bucket_stroke(
    linkage: ModuleType, digger: ModuleType, values: ModuleType
) -> None:
    k = linkage.solve()
    for arm, wanted in ((linkage.ARM_MIN, values.DUMPING_HEIGHT), (linkage.ARM_MAX, values.DUMPING_HEIGHT_MIN)):
        at = k.pose(linkage.BOOM_MAX, arm, linkage.BUCKET_MIN)
        down = k.bucket_for(digger.wrapped(-math.pi / 2 - at.arm_angle))
        assert linkage.BUCKET_MIN + 10 < down < linkage.BUCKET_MAX - 10
        assert k.pose(linkage.BOOM_MAX, arm, down).T[1] == pytest.approx(wanted.value, rel=PERCENT / 100)


def test_wall_depth_is_the_lowest_upright_floor(linkage: ModuleType, digger: ModuleType, values: ModuleType) -> None:
    k = linkage.solve()
    upright = -math.pi / 2 + module("excavator", "bucket").floor_angle(k)
    found = []
    for arm in np.linspace(linkage.ARM_MIN, linkage.ARM_MAX, 400):
        at = k.pose(linkage.BOOM_MIN, float(arm), linkage.BUCKET_MIN)
        gamma = digger.wrapped(upright - at.arm_angle)
        if k.four_bar(linkage.BUCKET_MAX)[0] < gamma < k.four_bar(linkage.BUCKET_MIN)[0]:
            found.append(k.pose(linkage.BOOM_MIN, float(arm), k.bucket_for(gamma)).T[1])
    assert -min(found) == pytest.approx(values.WALL_DEPTH.value, rel=PERCENT / 100)


def test_pins_keep_their_distances(
    strokes: list[tuple[float, float, float]], linkage: ModuleType, values: ModuleType
) -> None:
    k = linkage.solve()
    for p in (k.pose(*each) for each in strokes[::997]):
        assert np.hypot(*(p.B - k.A)) == pytest.approx(values.BOOM_LENGTH.value)
        assert np.hypot(*(p.K - p.B)) == pytest.approx(values.ARM_LENGTH.value)
        assert np.hypot(*(p.D - k.C)) == pytest.approx(p.boom)
        assert np.hypot(*(p.P - p.M)) == pytest.approx(p.arm)
        assert np.hypot(*(p.H - p.E)) == pytest.approx(p.bucket)
        assert np.hypot(*(p.H - p.G)) == pytest.approx(k.tipping)
        assert np.hypot(*(p.H - p.J)) == pytest.approx(k.link)
        assert np.hypot(*(p.J - p.K)) == pytest.approx(np.hypot(*k.J))


def test_no_dead_point_and_no_flip(strokes: list[tuple[float, float, float]], linkage: ModuleType) -> None:
    k = linkage.solve()
    assert min(min(k.margins(k.pose(*each))) for each in strokes[::7]) > 0.25
    lengths = np.linspace(linkage.BUCKET_MIN, linkage.BUCKET_MAX, 101)
    assert (np.diff([k.four_bar(float(c))[0] for c in lengths]) < 0).all()
    assert (np.diff([k.arm_angle(float(c)) for c in np.linspace(linkage.ARM_MIN, linkage.ARM_MAX, 101)]) < 0).all()
    assert (np.diff([k.boom_angle(float(c)) for c in np.linspace(linkage.BOOM_MIN, linkage.BOOM_MAX, 101)]) > 0).all()


def test_no_cylinder_is_drawn_at_an_end(truth: dict[str, Any]) -> None:
    assert len(truth["cylinders"]) == 4
    for name, row in truth["cylinders"].items():
        used = (row["drawn_length"] - row["closed_length"]) / row["stroke"]
        assert 0.2 < used < 0.8, name
        assert row["rod_diameter"] < row["bore"]
        assert row["closed_length"] > row["stroke"] + 0.5, "room for eyes, piston and gland"


# ---- the track --------
def test_track_is_a_ring_of_equal_links(track: ModuleType, values: ModuleType) -> None:
    pins = np.array([p[:2] for p in track.solve_track().pins])
    assert len(pins) == values.SHOES.value
    links = np.roll(pins, -1, axis=0) - pins
    assert np.allclose(np.hypot(*links.T), values.LINK_PITCH.value, atol=1e-9)
    heading = np.arctan2(links[:, 1], links[:, 0])
    turns = (np.diff(heading, append=heading[0]) + math.pi) % (2 * math.pi) - math.pi
    assert turns.sum() == pytest.approx(2 * math.pi), "once around"
    assert turns.min() > -1e-9, "never bent backwards"
    assert heading[0] == pytest.approx(0.0, abs=1e-9), "the first is on the ground and goes forward"


def test_pins_lie_in_the_sprockets_gaps(track: ModuleType) -> None:
    loop = track.solve_track()
    pins = np.array([p[:2] for p in loop.pins]) - (-track.HALF, loop.axle)
    on = pins[np.abs(np.hypot(*pins.T) - track.SPROCKET_R) < 1e-6]
    assert len(on) >= 5
    steps = np.diff(np.unwrap(np.arctan2(on[:, 1], on[:, 0])))
    assert np.allclose(steps, 2 * math.pi / (track.TEETH / 2), atol=1e-9), "two teeth a link"


# ---- the file and the truth --------
def test_tree_is_what_the_truth_lists(leaves: list[Leaf], truth: dict[str, Any]) -> None:
    assert 600 <= len(leaves) <= 1150
    assert [leaf.path for leaf in leaves] == list(truth["parts"])
    assert len({leaf.product for leaf in leaves}) < 0.25 * len(leaves), "shapes are shared by instances"
    assert max(leaf.path.count("/") for leaf in leaves) >= 4
    assert (FOLDER / "excavator.step").stat().st_size < 6e6


def test_the_tree_is_not_the_bodies(truth: dict[str, Any]) -> None:
    groups = collections.defaultdict(set)
    for path, row in truth["parts"].items():
        groups[path.split("/")[1]].add(row["body"])
    assert len(groups["PINS AND BOLTS"]) >= 6
    assert len(groups["HYDRAULIC CYLINDERS"]) == 8


def test_counts_are_the_papers(truth: dict[str, Any]) -> None:
    kinds = collections.Counter(joint["type"] for joint in truth["joints"].values())
    assert kinds["revolute"] >= 138 and kinds["prismatic"] == 4
    bodies = {row["body"] for row in truth["parts"].values()}
    jointed = {body for joint in truth["joints"].values() for body in (joint["body0"], joint["body1"])}
    # the chains lie on rollers and sprockets, no joint holds them to the rest
    assert bodies == jointed
    assert set(truth["undercarriage_with"]) < bodies
    for letter in "lr":
        for row, count in (("track_shoe", 49), ("track_roller", 9), ("carrier_roller", 2)):
            names = {f"{row}_{letter}_{i + 1}" for i in range(count)}
            assert names <= bodies and f"{row}_{letter}_{count + 1}" not in bodies


def test_without_shoes_the_loops_are_those_of_the_cylinders(truth: dict[str, Any]) -> None:
    joints = [j for j in truth["joints"].values() if "when" not in j]
    bodies = {row["body"] for row in truth["parts"].values()} - set(truth["undercarriage_with"])
    assert len(bodies) == 15
    assert len(joints) - (len(bodies) - 1) == 5  # two boom cylinders, arm, bucket, and the bucket's four-bar


def test_frame_is_a_turn_and_the_grousers_stand_on_the_ground(leaves: list[Leaf], truth: dict[str, Any]) -> None:
    m = np.array(truth["frame"])
    assert np.allclose(m[:3, :3] @ m[:3, :3].T, np.eye(3)) and np.linalg.det(m) == pytest.approx(1.0)
    assert not np.allclose(m, np.eye(4))
    swing = truth["joints"]["undercarriage2upperstructure_joint"]
    assert np.allclose(m[:3, :3] @ swing["axis"], [0, 0, 1])
    assert np.allclose((m[:3, :3] @ swing["anchor"] + m[:3, 3])[:2], 0.0)
    shoes = [leaf for leaf in leaves if "TRIPLE GROUSER" in leaf.path]
    points, _ = mesh_of(shoes[0].shape)
    lowest = []
    for leaf in shoes:
        place = np.array([[leaf.place.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
        at = (points @ place[:, :3].T + place[:, 3]) / 1e3
        lowest.append((at @ m[:3, :3].T + m[:3, 3])[:, 2].min())
    assert len(shoes) == 98 and min(lowest) == pytest.approx(0.0, abs=1e-9), "none digs in where the chain bends"
    assert sum(z < 1e-6 for z in lowest) >= 2 * 15, "those on the ground"


def _coaxial(bore: Bore, joint: dict[str, Any]) -> bool:
    axis, offset = np.array(joint["axis"]), bore.point - np.array(joint["anchor"])
    return bool(np.linalg.norm(np.cross(bore.axis, axis)) < 1e-7 and np.linalg.norm(np.cross(offset, axis)) < 1e-7)


def test_axes_are_those_of_bores_in_both_bodies(truth: dict[str, Any], bores: dict[str, list[Bore]]) -> None:
    by_body: dict[str, list[Bore]] = collections.defaultdict(list)
    for path, row in truth["parts"].items():
        by_body[row["body"]] += bores.get(path, [])
    for name, joint in truth["joints"].items():
        for body in (joint["body0"], joint["body1"]):
            assert any(_coaxial(bore, joint) for bore in by_body[body]), (name, body)


def test_pins_lie_on_their_joints(truth: dict[str, Any], bores: dict[str, list[Bore]]) -> None:
    pins = collections.Counter(row["role"] for row in truth["parts"].values() if row["role"].endswith("_pin"))
    assert set(pins.values()) == {1} and len(pins) == 13
    for path, row in truth["parts"].items():
        if row["role"].endswith("_pin"):
            near = [n for n, j in truth["joints"].items() if all(_coaxial(bore, j) for bore in bores[path])]
            assert near, path
            assert any(row["body"] in (truth["joints"][n]["body0"], truth["joints"][n]["body1"]) for n in near), path


def test_piston_travel_is_the_stroke(leaves: list[Leaf], truth: dict[str, Any]) -> None:
    """Shapes: cap to gland less the piston is the stroke, the piston's gap to the cap the extension."""
    for joint_name, row in truth["cylinders"].items():
        joint = truth["joints"][joint_name]

        def part(body: str, word: str, joint: dict[str, Any] = joint) -> list[float]:
            leaf = next(x for x in leaves if x.path.endswith(word) and truth["parts"][x.path]["body"] == body)
            return planes_along(leaf, np.array(joint["axis"]), np.array(joint["anchor"]))

        cap = part(joint["body0"], " TUBE")[1]
        gland = part(joint["body0"], " GLAND")
        piston = part(joint["body1"], " PISTON")
        assert gland[0] - cap - (piston[-1] - piston[0]) == pytest.approx(row["stroke"], abs=1e-7)
        assert piston[0] - cap == pytest.approx(row["drawn_length"] - row["closed_length"], abs=1e-7)
        assert row["closed_length"] - gland[-1] > 0.075, "the rod eye stays clear of the gland"


def test_masses_are_plausible(leaves: list[Leaf], truth: dict[str, Any], values: ModuleType) -> None:
    total: collections.Counter[str] = collections.Counter()
    known: dict[int, float] = {}
    for leaf in leaves:
        if leaf.product not in known:
            props = GProp_GProps()
            BRepGProp.VolumeProperties_s(leaf.shape, props)
            known[leaf.product] = props.Mass() * 1e-9 * 7850.0
        assert known[leaf.product] > 0, leaf.path
        body = truth["parts"][leaf.path]["body"]
        total["undercarriage" if body in truth["undercarriage_with"] else body] += known[leaf.product]
        if leaf.path.endswith("/COUNTERWEIGHT"):
            assert known[leaf.product] == pytest.approx(values.COUNTERWEIGHT.value, rel=1e-4)
    assert total["bucket"] == pytest.approx(values.BUCKET_WEIGHT.value, rel=0.05)
    assert 0.3 < total["undercarriage"] / sum(total.values()) < 0.42
    assert sum(total.values()) == pytest.approx(values.OPERATING_WEIGHT.value, rel=0.03)


# ---- slow --------
@pytest.fixture(scope="module")
def moves_of(linkage: ModuleType) -> Callable[..., dict[str, np.ndarray]]:
    """Where each body goes, machine frame in millimetres, from the drawn pose to another."""
    k, start = module("excavator", "draw").drawn_pose()
    direction = linkage.direction

    def frame(origin: np.ndarray, angle: float) -> np.ndarray:
        m, c, s = np.eye(4), math.cos(angle), math.sin(angle)
        m[0, 0], m[0, 2], m[2, 0], m[2, 2] = c, -s, s, c
        m[0, 3], m[2, 3] = origin
        return m

    def frames(p: Any) -> dict[str, np.ndarray]:
        lift, crowd, curl = direction(p.D - k.C), direction(p.P - p.M), direction(p.H - p.E)
        out = {
            "boom": frame(k.A, p.boom_angle),
            "arm": frame(p.B, p.arm_angle),
            "bucket": frame(p.K, p.bucket_angle),
            "tipping_link": frame(p.G, direction(p.H - p.G)),
            "bucket_link": frame(p.H, direction(p.J - p.H)),
            "arm_cylinder_barrel": frame(p.M, crowd),
            "arm_piston_rod": frame(p.P, crowd),
            "bucket_cylinder_barrel": frame(p.E, curl),
            "bucket_piston_rod": frame(p.H, curl),
        }
        for letter in "lr":
            out[f"boom_cylinder_barrel_{letter}"] = frame(k.C, lift)
            out[f"boom_piston_rod_{letter}"] = frame(p.D, lift)
        return out

    def moves(boom: float, arm: float, bucket: float) -> dict[str, np.ndarray]:
        before, after = frames(start), frames(k.pose(boom, arm, bucket))
        return {body: after[body] @ np.linalg.inv(before[body]) for body in before}

    return moves


def _rolling(a: str, b: str) -> bool:
    """Two bodies that touch as a track does: shoes on rollers, idler and sprocket."""
    return ("shoe" in a) != ("shoe" in b) and any(w in a + b for w in ("roller", "idler", "sprocket"))


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
            known = frozenset((body[i], body[j])) in jointed or _rolling(body[i], body[j])
            assert known, (leaves[i].path, leaves[j].path)
    for name in set(body):
        members = {i for i, b in enumerate(body) if b == name}
        reached: set[int] = set()
        front = [min(members)]
        while front:
            here = front.pop()
            if here not in reached:
                reached.add(here)
                front += touching[here]
        # the two tipping links are one body, each on its side of the arm
        assert reached == members or name == "tipping_link", [leaves[i].path for i in members - reached]


@pytest.mark.slow
def test_nothing_meets_over_the_strokes(
    leaves: list[Leaf],
    truth: dict[str, Any],
    linkage: ModuleType,
    moves_of: Callable[..., dict[str, np.ndarray]],
) -> None:
    near_track = ("TRACK CHAIN", "TRACK GROUP")
    leaves = [leaf for leaf in leaves if not any(word in leaf.path for word in near_track)]
    solids = solids_of(leaves)
    body = [truth["parts"][leaf.path]["body"] for leaf in leaves]
    to_machine = np.array(truth["frame"])
    to_machine[:3, 3] *= 1000.0
    back = np.linalg.inv(to_machine)

    def near(within: float, boom: float, arm: float, bucket: float) -> set[tuple[int, int]]:
        moves = moves_of(boom, arm, bucket)
        matrices = [back @ moves.get(b, np.eye(4)) @ to_machine for b in body]
        return {pair for pair in gaps(solids, matrices, within) if body[pair[0]] != body[pair[1]]}

    _, start = module("excavator", "draw").drawn_pose()
    hinges = near(3.0, start.boom, start.arm, start.bucket)
    ends = ("PISTON", "GLAND", "TUBE", " ROD")

    def thirds(low: float, high: float) -> list[float]:
        return [low, 0.5 * (low + high), high]

    for boom in thirds(linkage.BOOM_MIN, linkage.BOOM_MAX):
        for arm in thirds(linkage.ARM_MIN, linkage.ARM_MAX):
            for bucket in thirds(linkage.BUCKET_MIN, linkage.BUCKET_MAX):
                for i, j in near(2.0, boom, arm, bucket) - hinges:
                    # a piston at its cap or gland is the end of the stroke
                    assert all(any(word in leaves[n].path for word in ends) for n in (i, j)), (
                        (boom, arm, bucket),
                        leaves[i].path,
                        leaves[j].path,
                    )


@pytest.mark.slow
def test_drawing_again_gives_the_same_machine(tmp_path: Path) -> None:
    command = [sys.executable, "-m", f"{FOLDER.name}.draw", str(tmp_path)]
    subprocess.run(command, check=True, capture_output=True, timeout=300, cwd=FOLDER.parent)
    for name in ("excavator.step", "truth.json"):
        assert differences(tmp_path / name, FOLDER / name) == []
