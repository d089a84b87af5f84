"""Bodies that go through each other over the strokes: found by what is drawn, told with the pose and the stroke."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh

from kit.machines import small_machine
from yellowiron.kinematics import Meeting, Outline, clearance_findings, complete, meetings
from yellowiron.kinematics.clearance import DEEP
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Drive, Joint, Mechanism
from yellowiron.support.convex.solids import convex
from yellowiron.support.vectors import winding

Y = (0.0, 1.0, 0.0)
AT = (0.0, 0.0, 0.0)


def box(low: tuple[float, float, float], high: tuple[float, float, float]) -> trimesh.Trimesh:
    return trimesh.creation.box(bounds=np.array([low, high]))


def outline(*meshes: trimesh.Trimesh, filled: bool = False) -> Outline:
    """Of boxes; `filled`: their colliders are one hull."""
    corners = [np.asarray(mesh.vertices) for mesh in meshes]
    solids = [convex(np.concatenate(corners))] if filled else [convex(each) for each in corners]
    return Outline(solids, np.concatenate([mesh.triangles for mesh in meshes]))


def machine(*, lower: float, upper: float) -> Mechanism:
    """A beam that turns about the y axis of a base; 0 is along x, and it goes down as the angle grows."""
    bodies = tuple(Body(name, AT, 10.0, AT, np.eye(3), (), np.zeros((0, 3))) for name in ("base", "beam", "tip"))
    drive = Drive("position", 1e4, 1e3, 1e4, 1.0)
    joints = (
        Joint("hinge", "revolute", "base", "beam", AT, Y, lower, upper, drive=drive),
        Joint("end", "revolute", "beam", "tip", (1.0, 0.0, 0.0), Y, -0.1, 0.1, drive=drive),
    )
    return Mechanism("x", "x", "base", bodies, joints)


BEAM = outline(box((0.3, -0.05, -0.05), (1.0, 0.05, 0.05)))
BLOCK = box((0.5, -0.2, -1.0), (0.7, 0.2, -0.5))
"""Below the beam: its top is reached where the beam has turned down by half its way."""


def depth_of(angle: float) -> float:
    """How deep the beam's deepest point is in the block, or the block's in the beam, at an angle: by many points."""
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    x, z = np.meshgrid(np.linspace(0.3, 1.0, 300), np.linspace(-0.05, 0.05, 60))
    beam = np.column_stack([x.ravel(), z.ravel()]) @ turn.T
    x, z = np.meshgrid(np.linspace(0.5, 0.7, 100), np.linspace(-1.0, -0.5, 250))
    block = np.column_stack([x.ravel(), z.ravel()]) @ turn
    in_block = np.min([beam[:, 0] - 0.5, 0.7 - beam[:, 0], -0.5 - beam[:, 1], beam[:, 1] + 1.0], axis=0)
    in_beam = np.min([block[:, 0] - 0.3, 1.0 - block[:, 0], 0.05 - np.abs(block[:, 1])], axis=0)
    # A point across is at most the beam's half breadth deep in the block, and the same in the beam.
    return float(np.clip([in_block.max(), min(in_beam.max(), 0.05)], 0.0, None).max())


def test_a_beam_meets_the_block_below_it_where_it_is_turned_down() -> None:
    upper = math.radians(60.0)
    found = meetings(machine(lower=-0.5, upper=upper), {"base": outline(BLOCK), "beam": BEAM})
    assert [(each.one, each.other) for each in found] == [("base", "beam")]
    assert list(found[0].at) == ["hinge"]
    assert math.radians(30.0) < found[0].at["hinge"] <= upper + 1e-9
    assert found[0].depth == pytest.approx(max(depth_of(a) for a in np.linspace(-0.5, upper, 200)), abs=0.012)


def test_what_stops_short_of_it_does_not() -> None:
    assert meetings(machine(lower=-0.5, upper=math.radians(20.0)), {"base": outline(BLOCK), "beam": BEAM}) == ()


def test_a_hollow_that_only_the_collider_fills_is_no_meeting() -> None:
    """The beam goes down between two walls that one hull stands for."""
    walls = [box((0.0, y, -1.0), (1.2, y + 0.02, -0.1)) for y in (-0.3, 0.28)]
    turned = machine(lower=-0.5, upper=math.radians(45.0))
    assert meetings(turned, {"base": outline(*walls, filled=True), "beam": BEAM}) == ()
    floor = box((0.0, -0.3, -1.0), (1.2, 0.3, -0.4))
    found = meetings(turned, {"base": outline(*walls, floor, filled=True), "beam": BEAM})
    assert found and found[0].depth > DEEP


def test_what_is_as_deep_as_drawn_does_not_count() -> None:
    lug = box((0.2, -0.05, -0.05), (0.4, 0.05, 0.05))
    assert meetings(machine(lower=-0.02, upper=0.02), {"base": outline(lug), "beam": BEAM}) == ()


def test_bodies_without_colliders_meet_nothing() -> None:
    empty = Outline((), np.zeros((0, 3, 3)))
    assert meetings(machine(lower=-0.5, upper=1.0), {"base": outline(BLOCK), "beam": empty, "tip": empty}) == ()


def triangles(mesh: trimesh.Trimesh) -> Floats:
    return np.asarray(mesh.triangles)


def test_a_closed_surface_is_wound_once_around_what_is_inside() -> None:
    ball = triangles(trimesh.creation.icosphere(subdivisions=2, radius=1.0))
    points = np.array([(0.0, 0.0, 0.0), (0.5, 0.3, -0.2), (0.0, 0.0, 1.5), (3.0, 0.0, 0.0)])
    assert winding(points, ball) == pytest.approx([1.0, 1.0, 0.0, 0.0], abs=1e-9)
    assert winding(points, ball[:, ::-1]) == pytest.approx([-1.0, -1.0, 0.0, 0.0], abs=1e-9)


def test_a_meeting_is_told_once_for_its_drivers_and_warned_of_where_a_stroke_is_no_sheet_s() -> None:
    made, _ = small_machine.make()
    mechanism = complete(made)
    slide = mechanism.joint("slide")
    assert slide.upper is not None
    at = {"slide": slide.upper}
    found = [Meeting("boom", "frame", 0.31, at), *(Meeting("boom", f"wheel_{n}", 0.1, at) for n in range(4))]
    (told,) = clearance_findings(mechanism, found)
    assert (told.code, told.severity, told.where) == ("KIN018", "info", "boom")
    assert told.message == (
        "Over the strokes 'boom' goes 310 mm into 'frame' (lift at 100 %); so do 'boom' and 'wheel_0', "
        "'boom' and 'wheel_1' and 2 more"
    )
    cylinder = replace(
        mechanism.cylinders[0], sources={"stroke": "estimate: usual of cylinders of this length, 400 mm"}
    )
    (warned,) = clearance_findings(replace(mechanism, cylinders=(cylinder,)), found[:1])
    assert warned.severity == "warning"
    assert "No sheet gives the stroke of lift" in warned.hint
