"""The damages of `kit.machines.damages` do what they say, and no truth is lost on the way through a file."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.damages import DAMAGES, EXTRA, KINDS, base, damaged
from kit.machines.synthetic import Machine
from kit.scene import occurrences, scene, true_joints
from yellowiron.cad.mesh.measures import is_closed

CASES = [(kind, name) for name, damage in DAMAGES.items() for kind in damage.kinds]
SAME = ("sound", "duplicate faces", "double-sided", "mirrored", "node scale", "by material", "one mesh", "inverted")


def triangles(machine: Machine) -> int:
    return sum(len(machine.shapes[p.shape].mesh.triangles) for p in machine.parts)


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "name"), CASES)
def test_every_triangle_has_its_truth(kind: str, name: str) -> None:
    if name.startswith("decimated"):
        pytest.importorskip("fast_simplification")
    machine = damaged(kind, 4, name)
    assert set(machine.truth) == {p.id for p in machine.parts}
    _, truth = occurrences(machine, 4, np.eye(4), None)
    assert len(truth.points) == len(truth.areas) == len(truth.label) == triangles(machine)
    assert {body for _, body in truth.labels} <= {"", EXTRA} | {
        b for _, b in base(kind, 4, name).truth.values()
    } | {f"{EXTRA}|upperstructure", f"{EXTRA}|rear_frame"}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", SAME)
def test_what_is_only_written_otherwise_stays_where_it_is(name: str) -> None:
    whole = occurrences(base("loader", 4, name), 4, np.eye(4), None)[1]
    _, found = occurrences(damaged("loader", 4, name), 4, np.eye(4), None)
    for body in {b for _, b in whole.labels}:
        mine, other = (
            s.areas[np.isin(s.label, [k for k, (_, b) in enumerate(s.labels) if b == body])].sum()
            for s in (whole, found)
        )
        factor = 2.0 if name == "double-sided" else 1.0
        more = 0.5 * mine if name == "duplicate faces" else 0.0
        assert other == pytest.approx(factor * mine + more, rel=1e-5, abs=0.5 * more + 1e-9), body


@pytest.mark.slow
def test_decimation_leaves_its_share_of_the_triangles() -> None:
    pytest.importorskip("fast_simplification")
    whole = triangles(base("loader", 4, "sound"))
    assert triangles(damaged("loader", 4, "decimated 70")) == pytest.approx(0.7 * whole, rel=0.1)
    assert triangles(damaged("loader", 4, "decimated 30")) < 0.5 * whole


def test_opened_shells_are_open() -> None:
    machine = damaged("loader", 4, "opened")
    assert not any(is_closed(shape.mesh) for shape in machine.shapes.values())


def test_half_a_machine_is_left_of_its_middle() -> None:
    machine = damaged("excavator", 4, "half")
    assembly = machine.assembly()
    assert min(assembly.points_of(p)[:, 1].min() for p in machine.parts) > -1e-6
    assert 0.4 < triangles(machine) / triangles(base("excavator", 4, "half")) < 0.6


def test_mirrored_instances_have_a_negative_determinant() -> None:
    signs = [np.sign(np.linalg.det(p.transform[:3, :3])) for p in damaged("loader", 4, "mirrored").parts]
    assert 0.3 < np.mean(np.array(signs) < 0) < 0.7


@pytest.mark.parametrize("kind", KINDS)
def test_true_joints_are_on_the_drawn_pins(kind: str) -> None:
    machine = base(kind, 4, "sound")
    joints = true_joints(machine, kind, 4, np.eye(4))
    assert len(joints) > 20
    pins = {
        machine.truth[p.id][0]: (p.transform[:3, 3], p.transform[:3, 2])
        for p in machine.parts
        if p.name == machine.truth[p.id][0] and p.name.endswith("_pin")
    }
    by_bodies = {frozenset(j.bodies): j for j in joints if j.type == "revolute"}
    root = "front_frame" if kind == "loader" else "upperstructure"
    for pin, bodies in (("boom_pin", (root, "boom")), ("bucket_cylinder_barrel_pin", None)):
        chosen = [by_bodies[frozenset(bodies)]] if bodies else [
            j for b, j in by_bodies.items() if "bucket_cylinder_barrel" in b
        ]  # fmt: skip
        point, axis = pins[pin]
        for joint in chosen:
            away = np.array(joint.point) - point
            assert abs(float(np.dot(axis, joint.axis))) == pytest.approx(1.0, abs=1e-9)
            assert np.linalg.norm(away - (away @ axis) * axis) < 1e-6


@pytest.mark.slow
def test_a_scene_is_the_same_each_time_and_counts_what_is_drawn() -> None:
    first, second = (scene("loader", 4, "no cylinders", names="with") for _ in range(2))
    assert [p.name for p in first.assembly.parts] == [p.name for p in second.assembly.parts]
    assert np.array_equal(first.truth.points, second.truth.points)
    assert not any("piston_rod" in "".join(j.bodies) for j in first.joints)
    assert {("front_frame", "boom"), ("boom", "bucket")} <= {j.bodies for j in first.joints}


@pytest.mark.slow
def test_a_scene_in_millimetres_is_a_thousand_times_as_large() -> None:
    # Its parts may be refused; its truth is there.
    large, plain = scene("excavator", 4, "millimetres"), scene("excavator", 4, "sound")
    assert large.height == pytest.approx(1000 * plain.height, rel=1e-6)
    assert large.truth.areas.sum() == pytest.approx(1e6 * plain.truth.areas.sum(), rel=1e-5)
    one, other = large.joints[0], plain.joints[0]
    assert np.allclose(one.point, 1000 * np.array(other.point), rtol=1e-5)
    assert one.axis == pytest.approx(other.axis)
