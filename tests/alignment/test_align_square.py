"""A machine that stands askew in its file is the machine that it is."""

from __future__ import annotations

import functools
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from kit.scene import scene
from yellowiron.alignment.facing import Facing, quarters
from yellowiron.alignment.square import square_to, squared, turned, turned_back
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly, DeclaredJoint, Node
from yellowiron.model.errors import AlignmentError
from yellowiron.model.geometry import Floats, Mesh
from yellowiron.model.specification import Specifications
from yellowiron.stages import roles_of


def about(axis: tuple[float, float, float], degrees: float) -> Floats:
    """A rotation (3, 3)."""
    return np.asarray(trimesh.transformations.rotation_matrix(np.radians(degrees), axis)[:3, :3])


def off(one: Floats, other: Floats) -> float:
    """By how many degrees a rotation takes axes beside those of another, whichever is which."""
    traces = [float(np.trace(q @ one @ other.T)) for q in quarters()]
    return float(np.degrees(np.arccos(np.clip((max(traces) - 1.0) / 2.0, -1.0, 1.0))))


@functools.cache
def machine(*, lean: float = 35.0) -> Assembly:
    """A house on two tracks with a boom of two plates that leans, a round bucket and a bent bracket; Z up."""
    placed = [
        (trimesh.creation.box((3.0, 0.5, 0.8)), (0.0, 1.2, 0.4), 0.0),
        (trimesh.creation.box((3.0, 0.5, 0.8)), (0.0, -1.2, 0.4), 0.0),
        (trimesh.creation.box((2.5, 2.4, 1.2)), (-0.2, 0.0, 1.5), 0.0),
        (trimesh.creation.box((4.0, 0.1, 0.4)), (2.0, 0.2, 2.6), lean),
        (trimesh.creation.box((4.0, 0.1, 0.4)), (2.0, -0.2, 2.6), lean),
        (trimesh.creation.icosphere(subdivisions=3, radius=0.5), (4.0, 0.0, 1.0), 0.0),
        (trimesh.creation.box((0.5, 0.3, 0.2)), (-0.9, 0.6, 2.2), 3.0),
    ]
    found = []
    for k, (mesh, at, degrees) in enumerate(placed):
        whole = np.eye(4)
        whole[:3, :3], whole[:3, 3] = about((0.0, 1.0, 0.0), -degrees), at
        own = Mesh(np.asarray(mesh.vertices), np.asarray(mesh.faces, dtype=np.int32))
        found.append(Occurrence(f"part {k}", (), own, whole))
    return assemble(found, name="machine", format="test", unit=1.0, path="")


def test_a_machine_that_stands_square_is_left_as_it_is() -> None:
    for quarter in quarters()[::5]:
        assert squared(turned(machine(), quarter)) is None


@settings(max_examples=15)
@given(st.floats(10.0, 80.0), st.integers(0, 23))
def test_a_machine_askew_is_turned_to_stand_square(yaw: float, quarter: int) -> None:
    """About its own upright by any angle, whichever axis of the file that is."""
    rotation = quarters()[quarter] @ about((0.0, 0.0, 1.0), yaw)
    found = square_to(turned(machine(), rotation))
    assert found is not None and off(found @ rotation, np.eye(3)) < 0.05
    assert np.allclose(found @ found.T, np.eye(3), atol=1e-12) and np.linalg.det(found) > 0.0


@pytest.mark.parametrize(("lean", "near"), [(1.0, 1.1), (3.0, 3.1), (25.0, 0.1), (50.0, 0.1)])
def test_a_machine_that_leans_is_turned_all_the_same(lean: float, near: float) -> None:
    """On a slope, or lying anyhow; what leans by less than its faces are told apart by may go on leaning."""
    rotation = about((1.0, 2.0, 0.0), lean) @ about((0.0, 0.0, 1.0), 37.0)
    found = square_to(turned(machine(), rotation))
    assert found is not None and off(found @ rotation, np.eye(3)) < near


def test_a_model_without_parts_or_surface_is_left_to_those_who_say_so() -> None:
    assert squared(replace(machine(), parts=())) is None
    with pytest.raises(AlignmentError, match="no parts"):
        roles_of(replace(machine(), parts=()), load_template("excavator"), Specifications())


def test_raised_arms_do_not_turn_the_machine() -> None:
    """Plates that lean about what lies across the machine are an arm's: no turn about that makes it stand."""
    whole = machine(lean=30.0)
    arms = replace(whole, parts=tuple(p for p in whole.parts if p.name in ("part 3", "part 4", "part 5")))
    assert squared(arms) is None


def test_what_a_file_declares_is_turned_with_it_and_what_is_found_turned_back() -> None:
    rotation = about((0.2, -0.4, 1.0), 33.0)
    joint = DeclaredJoint("hinge", "revolute", ("a", "b"), (1.0, 2.0, 3.0), (0.0, 1.0, 0.0))
    drawn = replace(machine(), joints=(joint,), nodes=(Node("root", None, np.eye(4)),))
    there = turned(drawn, rotation)
    for before, after in zip(drawn.parts, there.parts, strict=True):
        assert there.points_of(after) == pytest.approx(drawn.points_of(before) @ rotation.T, abs=1e-12)
    assert np.array(there.joints[0].anchor) == pytest.approx(rotation @ [1.0, 2.0, 3.0])
    assert np.array(there.joints[0].axis) == pytest.approx(rotation @ [0.0, 1.0, 0.0])
    assert there.nodes[0].transform[:3, :3] == pytest.approx(rotation)
    frame = np.eye(4)
    frame[:3, 3] = (0.0, 0.0, -1.0)
    found = Alignment("loader", frame, (), axes={"hinge": (there.joints[0].anchor, there.joints[0].axis)})
    back = turned_back(found, rotation)
    assert np.array(back.axes["hinge"]) == pytest.approx(np.array([joint.anchor, joint.axis]), abs=1e-12)
    point = np.array([0.3, -2.0, 1.0, 1.0])
    assert back.frame @ point == pytest.approx(frame @ np.append(rotation @ point[:3], 1.0))


def test_a_person_is_answered_in_the_files_directions() -> None:
    rotation = about((0.0, 0.0, 1.0), 30.0)
    said = Facing(forward=(0.0, 1.0, 0.0)).turned(rotation)
    assert said.against(np.eye(3)) == ("forward is y as a person says; what was found speaks for 0.866 -0.5 0",)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
def test_bodies_do_not_depend_on_how_the_file_has_the_machine(kind: str) -> None:
    """Without pins, where places tell: public machines read so at 37° lost up to all of their joints."""
    given = scene(kind, 5, "no cylinders")
    template, rotation = load_template(given.type), about((0.1, 0.2, 1.0), 37.0)
    straight = roles_of(given.assembly, template, Specifications())
    askew = roles_of(turned(given.assembly, rotation), template, Specifications())
    assert [p.body for p in askew.parts] == [p.body for p in straight.parts]
    assert len({p.body for p in straight.parts}) > 4
    assert askew.frame[:3, :3] @ rotation == pytest.approx(straight.frame[:3, :3], abs=2e-3)
