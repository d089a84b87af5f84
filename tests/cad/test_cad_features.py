"""Cylinders, planes and mass properties of bodies, against what they were drawn to."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from kit.cadfiles.step import (
    box,
    compound,
    cut,
    cylinder,
    faces_of,
    moved,
    pin_bracket,
    rotation,
    to_nurbs,
    translation,
)
from yellowiron.cad.brep import tessellate, to_shape
from yellowiron.model.geometry import CylinderFeature, Shape

pytestmark = pytest.mark.usefixtures("read_here")

TURN = 2 * math.pi
AXES = st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda axis: float(np.linalg.norm(axis)) > 0.1)
POINTS = st.tuples(*[st.floats(-3000, 3000)] * 3)


def shape_of(body: Any) -> Shape:
    """The finished shape of a B-rep drawn in mm."""
    measured = to_shape.measure("x", body)
    tessellate.mesh_shapes([(measured.shape, measured.diagonal)])
    shape, missing = to_shape.finish(measured)
    assert missing == 0
    return shape


def check_axis(feature: CylinderFeature, origin: Any, direction: Any, tolerance: float = 1e-9) -> None:
    """The feature's axis is the line through `origin` (m) along `direction`."""
    unit = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    assert np.linalg.norm(np.cross(feature.direction, unit)) < tolerance
    offset = np.array(feature.point) - origin
    assert np.linalg.norm(offset - unit * (offset @ unit)) < tolerance
    assert np.linalg.norm(feature.direction) == pytest.approx(1.0, abs=1e-12)


@settings(max_examples=25, deadline=None)
@given(at=POINTS, axis=AXES, radius=st.floats(1, 400), length=st.floats(1, 2000), freeform=st.booleans())
def test_cylinder_in_any_pose(at: Any, axis: Any, radius: float, length: float, freeform: bool) -> None:
    body = cylinder(radius, length, at, axis)
    measured = to_shape.measure("pin", to_nurbs(body) if freeform else body)
    from yellowiron.cad.brep import features

    (feature,) = features.cylinders(measured.survey)
    tolerance = 1e-7 if freeform else 1e-9
    check_axis(feature, np.array(at) / 1e3, axis, tolerance)
    assert feature.radius == pytest.approx(radius / 1e3, abs=tolerance)
    assert feature.length == pytest.approx(length / 1e3, abs=tolerance)
    assert feature.arc == pytest.approx(TURN)
    assert not feature.inner
    assert feature.exact
    middle = (np.array(at) + 0.5 * length * np.array(axis) / np.linalg.norm(axis)) / 1e3
    assert np.allclose(feature.center, middle, atol=1e-6)
    assert measured.volume == pytest.approx(math.pi * radius**2 * length, rel=1e-6)
    assert feature.area == pytest.approx(TURN * radius * length / 1e6, rel=1e-6)


@settings(max_examples=15, deadline=None)
@given(angle=st.floats(0.2, 6.0), start=st.floats(0, TURN), freeform=st.booleans())
def test_arc(angle: float, start: float, freeform: bool) -> None:
    body = moved(cylinder(50, 100, turn=angle), rotation((0, 0, 1), start))
    (feature,) = [f for f in shape_of(to_nurbs(body) if freeform else body).cylinders if not f.inner]
    assert feature.arc == pytest.approx(angle, abs=1e-5)


def test_direction_does_not_depend_on_how_it_was_drawn() -> None:
    up, down = shape_of(cylinder(10, 50)), shape_of(cylinder(10, 50, (0, 0, 50), (0, 0, -1)))
    assert up.cylinders[0].direction == down.cylinders[0].direction == (0, 0, 1)
    assert up.cylinders[0].center == pytest.approx(down.cylinders[0].center)
    assert up.key == down.key


@pytest.mark.parametrize("convert", [lambda shape: shape, to_nurbs], ids=["analytic", "freeform"])
def test_clevis_has_two_bores(convert: Any) -> None:
    bores = shape_of(convert(pin_bracket())).cylinders
    assert len(bores) == 2
    for bore, y in zip(bores, (-0.04, 0.04), strict=True):
        check_axis(bore, (0, 0, 0.1), (0, 1, 0), 1e-7)
        assert bore.center == pytest.approx((0, y, 0.1), abs=1e-7)
        assert bore.length == pytest.approx(0.04, abs=1e-7)
        assert (bore.inner, bore.arc) == (True, TURN)
        assert bore.radius == pytest.approx(0.025, abs=1e-8)


def test_split_bore_is_one_feature() -> None:
    # Two half shells of one bore, as sewn or exported with a seam on each side, and a step along the axis.
    half = cut(box(100, 100, 60, (-50, -50, 0)), cylinder(20, 60))
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse

    knife = box(200, 0.001, 200, (-100, 0, -50))
    parts = BRepAlgoAPI_Cut(half, knife).Shape()
    feature = [f for f in shape_of(parts).cylinders if f.inner]
    assert len(feature) == 1
    assert feature[0].arc == pytest.approx(TURN, abs=1e-3)
    stacked = BRepAlgoAPI_Fuse(
        cut(box(100, 100, 60, (-50, -50, 0)), cylinder(20, 60)),
        cut(box(80, 80, 40, (-40, -40, 60)), cylinder(20, 40, (0, 0, 60))),
    ).Shape()
    (bore,) = shape_of(stacked).cylinders
    assert bore.length == pytest.approx(0.1)


def test_stepped_bore_and_pin_stay_apart() -> None:
    body = cut(box(100, 100, 60, (-50, -50, 0)), cylinder(20, 60), cylinder(30, 20))
    radii = sorted((round(f.radius, 9), round(f.length, 9)) for f in shape_of(body).cylinders)
    assert radii == [(0.02, 0.04), (0.03, 0.02)]
    ring = cut(cylinder(60, 80), cylinder(55, 80))
    assert sorted((round(f.radius, 9), f.inner) for f in shape_of(ring).cylinders) == [(0.055, True), (0.06, False)]


@pytest.mark.parametrize("mirror", [(-1, 1, 1), (1, -1, 1), (1, 1, -1)])
def test_mirrored_geometry_keeps_inside_and_outside(mirror: tuple[int, int, int]) -> None:
    body = moved(cut(cylinder(60, 80, turn=2.0), cylinder(40, 80)), np.diag([*mirror, 1.0]))
    shape = shape_of(body)
    assert sorted((round(f.radius, 9), f.inner, round(f.arc, 6)) for f in shape.cylinders) == [
        (0.04, True, 2.0),
        (0.06, False, 2.0),
    ]
    assert shape.volume == pytest.approx((60**2 - 40**2) * 80 * 1e-9)


@settings(max_examples=15, deadline=None)
@given(size=st.tuples(*[st.floats(1, 3000)] * 3), at=POINTS, axis=AXES, angle=st.floats(0, TURN))
def test_block_in_any_pose(size: Any, at: Any, axis: Any, angle: float) -> None:
    pose = translation(*at) @ rotation(axis, angle)
    shape = shape_of(moved(box(*size), pose))
    a, b, c = (length / 1e3 for length in size)
    mass = a * b * c
    turn = pose[:3, :3]
    assert shape.volume == pytest.approx(mass, rel=1e-9)
    assert shape.area == pytest.approx(2 * (a * b + b * c + c * a), rel=1e-9)
    assert np.allclose(shape.centroid, (pose @ [*(np.array(size) / 2), 1])[:3] / 1e3, atol=1e-9)
    inertia = turn @ np.diag([b * b + c * c, a * a + c * c, a * a + b * b]) @ turn.T * mass / 12
    assert np.allclose(shape.inertia, inertia, rtol=1e-7, atol=1e-7 * np.abs(inertia).max())
    assert len(shape.planes) == 6
    for plane in shape.planes:
        outward = np.array(plane.point) - shape.centroid
        assert np.linalg.norm(np.cross(plane.normal, outward / np.linalg.norm(outward))) < 1e-6
        assert np.dot(plane.normal, outward) > 0


@pytest.mark.slow
@pytest.mark.parametrize("convert", [lambda shape: shape, to_nurbs], ids=["analytic", "freeform"])
@pytest.mark.parametrize("far", [0.0, 5000.0])
def test_faces_have_open_cascades_area_and_centre(convert: Any, far: float) -> None:
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    # Planes and cylinders around and beside the widest bore, a plane through the middle, a cone's worth of a turn.
    body = cut(
        box(200, 100, 60),
        cylinder(30, 60, (50, 50, 0)),
        cylinder(8, 100, (50, 0, 30), (0, 1, 0)),
        cylinder(10, 60, (150, 50, 0), turn=2.0),
        box(60, 50, 40, (140, 50, 30)),
    )
    measured = to_shape.measure("x", moved(convert(body), translation(far, -far, far) @ rotation((1, 2, 3), 0.7)))
    assert len(measured.survey) == len(measured.faces)
    freeform = convert is to_nurbs
    for face, found in zip(measured.faces, measured.survey, strict=True):
        properties = GProp_GProps()
        if freeform:
            BRepGProp.SurfaceProperties_s(face, properties, 1e-10, False)
        else:
            BRepGProp.SurfaceProperties_s(face, properties)
        assert found.area == pytest.approx(properties.Mass(), rel=1e-6 if freeform else 1e-10)
        assert np.allclose(found.center, properties.CentreOfMass().Coord(), atol=1e-4 if freeform else 1e-8)


@pytest.mark.parametrize("convert", [lambda shape: shape, to_nurbs], ids=["analytic", "freeform"])
def test_crossed_bores_to_the_formula(convert: Any) -> None:
    # Two equal bores that cross remove 2πr²L − 16/3 r³ (the Steinmetz solid is counted twice).
    body = cut(box(100, 100, 100), cylinder(10, 100, (50, 50, 0)), cylinder(10, 100, (0, 50, 50), (1, 0, 0)))
    shape = shape_of(convert(body))
    assert shape.volume == pytest.approx(1e-3 - (2 * math.pi * 1e-5 - 16 / 3 * 1e-6), rel=1e-7)
    assert shape.exact


def test_a_face_that_cannot_be_recognised_has_no_feature(monkeypatch: pytest.MonkeyPatch) -> None:
    """OCCT cannot load the surfaces of some sound faces into its recognition of planes and cylinders."""
    from OCP.Standard import Standard_NullObject

    from yellowiron.cad.brep import features

    class Refusing:
        def __init__(self, face: Any) -> None: ...

        def IsPlane(self, tolerance: float, plane: Any) -> bool:
            raise Standard_NullObject("GeomAdaptor_Surface::Load")

    monkeypatch.setattr(features, "ShapeAnalysis_CanonicalRecognition", Refusing)
    shape = shape_of(to_nurbs(box(100, 200, 300)))
    assert (shape.planes, shape.cylinders) == ((), ())
    assert shape.closed
    assert shape.volume == pytest.approx(0.1 * 0.2 * 0.3)


def test_several_lumps_of_sheet() -> None:
    faces = faces_of(box(100, 200, 300))
    shape = shape_of(compound(faces[0], faces[2]))
    assert (shape.closed, shape.volume) == (False, 0.0)
    assert shape.area == pytest.approx(0.2 * 0.3 + 0.1 * 0.3)
    assert not shape.inertia.any()


def test_bounds_are_exact_though_the_mesh_is_inside() -> None:
    shape = shape_of(moved(cylinder(900, 600, axis=(0, 1, 0)), rotation((0, 1, 0), 0.1)))
    assert np.allclose(shape.bounds, [[-0.9, 0, -0.9], [0.9, 0.6, 0.9]], atol=1e-7)
    assert np.abs(shape.mesh.points).max() <= 0.9 + 1e-9


def test_what_cannot_be_a_part() -> None:
    with pytest.raises(ValueError, match="m large"):
        to_shape.measure("x", box(1e8, 1, 1))
