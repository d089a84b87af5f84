"""The packing of the 3D view: what the page decodes is what was modelled, and the same machine gives the same bytes."""

from __future__ import annotations

import base64
import gzip
import json
import re
import struct
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh, Shape
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, BodyPart, Cylinder, Joint, Loop, Mechanism
from yellowiron.model.poses import PoseTable, PoseTables
from yellowiron.report.html import packing
from yellowiron.report.html import viewer as module
from yellowiron.report.html.viewer import viewer

PLACE = np.array([[0, -1, 0, 1.0], [1, 0, 0, 2.0], [0, 0, 1, 0.5], [0, 0, 0, 1]])


def shape(key: str, mesh: trimesh.Trimesh, *, smooth: bool) -> Shape:
    normals = mesh.vertex_normals if smooth else None
    data = Mesh(np.array(mesh.vertices), np.array(mesh.faces, dtype=np.int32), normals)
    return Shape(key, key, data, 1.0, 1.0, np.zeros(3), np.eye(3))


def body(name: str, *parts: str) -> Body:
    return Body(name, (0, 0, 0), 1.0, (0, 0, 0), np.eye(3),
                tuple(BodyPart(p, None, "steel", "none", 1.0) for p in parts), np.zeros((0, 3)))  # fmt: skip


@pytest.fixture
def press() -> tuple[Mechanism, Assembly, Alignment, PoseTables]:
    """A frame and a ram on a slide that turns a lever; the lever's coordinate follows the slide's."""
    shapes = {
        "ball": shape("ball", trimesh.creation.icosphere(subdivisions=2, radius=0.3), smooth=True),
        "box": shape("box", trimesh.creation.box((1, 2, 3)), smooth=False),
    }
    parts = (
        Part("M/A", "A", ("M",), "box", np.eye(4)),
        Part("M/B", "B", ("M",), "ball", PLACE, (1.0, 0.0, 0.0)),
        Part("M/B#2", "B", ("M",), "ball", np.eye(4)),
    )
    mechanism = Mechanism(
        "press", "press", "frame", (body("frame", "M/A"), body("ram", "M/B", "M/B#2"), body("lever")),
        (
            Joint("slide", "prismatic", "frame", "ram", (0, 0, 0), (1, 0, 0), -0.2, 0.3),
            Joint("pin", "revolute", "ram", "lever", (0, 0, 0), (0, 1, 0)),
        ),
        (Cylinder("c", "frame", "ram", "slide", "x", "y", 0.1, 0.05, 0.5, 1.0, 1.2, 1e7, 1e5, 8e4, 0.1),),
        (Actuator("squeeze", "cylinder", (ActuatorJoint("slide", -1),), ("c",)),),
    )  # fmt: skip
    alignment = Alignment("press", np.eye(4), (PartAssignment("M/B", "ram", "ram", 0.9, "seen"),), to_review=("M/B",))
    axis = np.linspace(-0.2, 0.3, 5)
    tables = PoseTables(("slide",), (PoseTable(("slide",), (axis,), ("pin",), 2.0 * axis[:, None]),), {"pin": 0.1})
    return mechanism, Assembly("M", "STEP", 1.0, parts, shapes), alignment, tables


def unpacked(data: str) -> tuple[dict[str, Any], Any]:
    raw = gzip.decompress(base64.b64decode(data))
    (length,) = struct.unpack("<I", raw[:4])
    assert (4 + length) % 8 == 0

    def array(entry: list[Any]) -> np.ndarray:
        kind, offset, count = entry
        assert offset % 8 == 0
        name = {"f32": "<f4", "u16": "<u2", "i32": "<i4", "i8": "i1"}[kind]
        return np.frombuffer(raw, name, count, 4 + length + offset)

    return json.loads(raw[4 : 4 + length]), array


def decoded(entry: dict[str, Any], array: Any) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles as `meshes.ts` decodes them."""
    planes = np.cumsum(array(entry["points"]).reshape(3, -1).astype(np.int64), axis=1) % 65536
    points = np.array(entry["low"]) + planes.T / 65535.0 * np.array(entry["size"])
    indices = np.cumsum(array(entry["indices"]).astype(np.int64))
    return points, (indices % 65536 if entry["indices"][0] == "u16" else indices).reshape(-1, 3)


def test_meshes_joints_and_tables_survive(press: Any) -> None:
    mechanism, assembly, alignment, tables = press
    header, array = unpacked(viewer(mechanism, assembly, alignment, tables).data)
    assert [part["path"] for part in header["parts"]] == ["M/A", "M/B", "M/B#2"]
    assert [part["body"] for part in header["parts"]] == [0, 1, 1]
    assert len(header["shapes"]) == 2
    for part, original in zip(header["parts"], assembly.parts, strict=True):
        points, triangles = decoded(header["shapes"][part["shape"]], array)
        mesh = assembly.shape_of(original).mesh
        assert np.abs(points - mesh.points).max() <= np.ptp(mesh.points, axis=0).max() / 65535.0
        assert np.array_equal(triangles, mesh.triangles)
        assert np.allclose(np.array(part["place"]).reshape(4, 3).T, original.transform[:3], atol=1e-6)
    assert header["parts"][1]["color"] == [255, 0, 0]
    assert header["parts"][1]["review"] and header["parts"][1]["confidence"] == 0.9
    assert np.allclose(array(header["tables"][0]["values"]), tables.tables[0].values[:, 0])
    assert header["joints"][1]["straight"] == 0.1
    (slider,) = header["sliders"]
    assert slider["sign"] == -1 and slider["range"] == [-0.2, 0.3]
    assert slider["extension"] == pytest.approx(0.2) and slider["stroke"] == 0.5


def test_a_machine_without_shapes_has_no_view(press: Any) -> None:
    mechanism, *rest = press
    assert viewer(replace(mechanism, bodies=(body("frame"), body("ram"), body("lever"))), *rest) is None


def test_the_same_machine_gives_the_same_bytes(press: Any) -> None:
    assert viewer(*press).data == viewer(*press).data


def test_a_pose_is_read_back_as_strokes(press: Any) -> None:
    mechanism, *rest = press
    moved = np.eye(4)
    moved[0, 3] = 0.15
    pose = {"frame": np.eye(4), "ram": moved, "lever": moved}
    header, _ = unpacked(viewer(mechanism, *rest, poses={"Down": pose}).data)
    assert header["poses"] == [{"name": "Down", "at": [["slide", pytest.approx(0.15)]]}]


def test_a_cylinder_on_a_loop_without_a_table_has_no_slider(press: Any) -> None:
    """A mast's carriage, which is on no loop, had none either: it could not be lifted by hand."""
    mechanism, assembly, alignment, _ = press
    tables = PoseTables(("slide",), ())
    looped = replace(mechanism, loops=(Loop(("slide", mechanism.joints[-1].name), mechanism.joints[-1].name),))
    header, _ = unpacked(viewer(looped, assembly, alignment, tables).data)
    assert header["sliders"] == []
    header, _ = unpacked(viewer(mechanism, assembly, alignment, tables).data)
    assert [slider["joints"] for slider in header["sliders"]] == [[["slide", 1]]]


def test_the_smallest_parts_are_left_out_of_too_large_a_machine(press: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    mechanism, assembly, alignment, tables = press
    monkeypatch.setattr(module, "MOST_TRIANGLES", 20)
    header, _ = unpacked(viewer(mechanism, assembly, alignment, tables).data)
    assert [part["path"] for part in header["parts"]] == ["M/A"]
    assert header["leftOut"] == 2


def test_a_page_stays_small(press: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    mechanism, assembly, alignment, tables = press
    whole = viewer(mechanism, assembly, alignment, tables).data
    monkeypatch.setattr(module, "MOST_BYTES", len(whole) - 40)
    less = viewer(mechanism, assembly, alignment, tables).data
    header, _ = unpacked(less)
    assert len(less) < len(whole) and 0 < header["leftOut"] < 3
    # One shape is always seen.
    monkeypatch.setattr(module, "MOST_BYTES", 1)
    header, _ = unpacked(viewer(mechanism, assembly, alignment, tables).data)
    assert len(header["parts"]) == 1


def test_the_script_closes_no_tag_and_asks_for_nothing(press: Any, bundled: None) -> None:
    made = viewer(*press)
    for text in (made.script, made.style):
        assert "</" not in text and "<!--" not in text and "<script" not in text
    addresses = set(re.findall(r"https?://[^\"'`\s)]+", made.script))
    assert addresses <= {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xhtml"}
    # What it is made of, and under which terms that may be given on.
    assert "Copyright © 2010-2026 three.js authors" in made.script and "The MIT License" in made.script


@settings(deadline=None)
@given(st.lists(st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 1e-3), min_size=1, max_size=20))
def test_normals_keep_their_direction(vectors: list[tuple[float, float, float]]) -> None:
    normals = np.array(vectors) / np.linalg.norm(vectors, axis=1, keepdims=True)
    e = packing._octahedral(normals) / 127.0
    z = 1.0 - np.abs(e).sum(axis=1)
    sign = np.where(e >= 0, 1.0, -1.0)
    xy = np.where(z[:, None] < 0, (1.0 - np.abs(e[:, [1, 0]])) * sign, e)
    back = np.column_stack([xy, z])
    back /= np.linalg.norm(back, axis=1, keepdims=True)
    assert np.degrees(np.arccos(np.clip((back * normals).sum(axis=1), -1, 1))).max() < 1.3
