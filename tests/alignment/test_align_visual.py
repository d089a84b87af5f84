"""Models drawn to be looked at: pins through solid plates, barrels without a bore, turntables without a bearing, bosses
rounded by eye."""

from __future__ import annotations

import math

import numpy as np
import trimesh

from yellowiron.alignment.features.contacts import Fit, fits_of
from yellowiron.alignment.features.cylinders import DrawnCylinder
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Solid, solids_of
from yellowiron.alignment.features.undrilled import pierced_fits_of
from yellowiron.alignment.features.undrilled_cylinders import solid_cylinders_of
from yellowiron.cad.mesh.assembly import shape_of
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats, Mesh

TOLERANCE, SIZE = 2e-4, 5.0
SIDE = np.array([0.0, 0.5, 0.0])


def box(size: tuple[float, float, float], at: tuple[float, float, float]) -> trimesh.Trimesh:
    return trimesh.creation.box(size, trimesh.transformations.translation_matrix(at))


def bar(
    radius: float, start: Floats | tuple[float, ...], end: Floats | tuple[float, ...], count: int = 16
) -> trimesh.Trimesh:
    return trimesh.creation.cylinder(radius, segment=[start, end], sections=count)


def pipe(outer: float, inner: float, start: tuple[float, ...], end: tuple[float, ...]) -> trimesh.Trimesh:
    a, b = np.array(start), np.array(end)
    length = float(np.linalg.norm(b - a))
    mesh = trimesh.creation.annulus(inner, outer, length, sections=24)
    mesh.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], b - a))
    mesh.apply_translation(0.5 * (a + b))
    return mesh


def seen(**meshes: trimesh.Trimesh | list[trimesh.Trimesh]) -> tuple[tuple[Solid, ...], dict[str, int]]:
    """The solids, and name → index; several meshes of one name are one part."""
    parts, shapes = [], {}
    for name, found in meshes.items():
        whole = trimesh.util.concatenate(found) if isinstance(found, list) else found
        mesh = Mesh(np.array(whole.vertices, dtype=np.float64), np.array(whole.faces, dtype=np.int32))
        shapes[name] = shape_of(mesh, name)
        parts.append(Part(name, name, (), name, np.eye(4)))
    solids = solids_of(Assembly("m", "glTF", 1.0, tuple(parts), shapes))
    return solids, {s.part.id: s.index for s in solids}


def pierced(solids: tuple[Solid, ...], cylinders: list[DrawnCylinder]) -> set[tuple[str, str]]:
    fits: list[Fit] = fits_of(solids, TOLERANCE)
    found = pierced_fits_of(solids, fits, cylinders, Touch(solids, TOLERANCE), SIZE)
    return {(solids[f.inner].part.id, solids[f.outer].part.id) for f in found}


def test_a_pin_through_solid_plates_holds_them() -> None:
    solids, _ = seen(
        frame=[box((1, 0.02, 0.5), (0, 0.1, 0)), box((1, 0.02, 0.5), (0, -0.1, 0))],
        arm=box((1.5, 0.16, 0.2), (0.9, 0, 0)),
        pin=bar(0.04, (0.3, -0.13, 0), (0.3, 0.13, 0)),
        beside=box((0.2, 0.2, 0.2), (0.3, 0, 0.5)),
    )
    assert pierced(solids, []) == {("pin", "frame"), ("pin", "arm")}


def test_a_left_and_a_right_pin_may_be_one_part() -> None:
    pins = [bar(0.04, (0.3, 0.3, 0), (0.3, 0.45, 0)), bar(0.04, (0.3, -0.45, 0), (0.3, -0.3, 0))]
    fork = [box((1, 0.03, 0.5), (0, y, 0)) for y in (0.32, -0.32)]
    solids, index = seen(fork=fork, arms=[box((1, 0.03, 0.2), (0.5, y, 0)) for y in (0.42, -0.42)], pins=pins)
    assert solids[index["pins"]].shaft is not None
    assert pierced(solids, []) == {("pins", "fork"), ("pins", "arms")}


def test_models_with_holes_are_read_by_them() -> None:
    """A bar that cuts a plate is nothing where pins have holes."""
    holes = {f"ring{k}": pipe(0.1, 0.04, (k, y, 0), (k, y + 0.03, 0)) for k in range(3) for y in (0.0,)}
    others = {f"link{k}": pipe(0.1, 0.04, (k, 0.05, 0), (k, 0.08, 0)) for k in range(3)}
    pins = {f"pin{k}": bar(0.04, (k, -0.02, 0), (k, 0.1, 0), 24) for k in range(3)}
    loose = {"a": box((0.3, 0.02, 0.3), (0.5, 0, 1)), "b": box((0.3, 0.02, 0.3), (0.5, 0.05, 1)),
             "rail": bar(0.04, (0.5, -0.1, 1), (0.5, 0.2, 1))}  # fmt: skip
    solids, _ = seen(**holes, **others, **pins, **loose)
    assert pierced(solids, []) == set()


def cylinder(y: float) -> tuple[trimesh.Trimesh, trimesh.Trimesh]:
    along = np.array([math.cos(0.7), 0.0, math.sin(0.7)])
    at = np.array([0.0, y, 0.0])
    return bar(0.07, at + 0.1 * along, at + 1.1 * along, 12), bar(0.03, at + 0.8 * along, at + 2.0 * along, 12)


def eyes() -> dict[str, trimesh.Trimesh]:
    far = 2.0 * np.array([math.cos(0.7), 0.0, math.sin(0.7)])
    return {
        "foot": bar(0.05, (0.0, -0.5, 0.0), (0.0, 0.5, 0.0)),
        "eye": bar(0.05, far - SIDE, far + SIDE),
    }


def test_a_cylinder_without_a_bore() -> None:
    barrel, rod = cylinder(0.0)
    solids, index = seen(barrel=barrel, rod=rod, **eyes())
    (found,) = solid_cylinders_of(solids, [], TOLERANCE)
    assert (found.barrel, found.rod) == ({index["barrel"]}, {index["rod"]})
    assert not found.hollow
    assert found.count == 1
    assert np.allclose(found.direction, (math.cos(0.7), 0.0, math.sin(0.7)), atol=1e-6)


def test_twins_in_two_parts_are_one_in_the_middle() -> None:
    left, right = cylinder(0.3), cylinder(-0.3)
    solids, _ = seen(barrels=[left[0], right[0]], rods=[left[1], right[1]], **eyes())
    (found,) = solid_cylinders_of(solids, [], TOLERANCE)
    assert found.count == 2
    assert abs(found.origin[1]) < 1e-6


def test_two_bars_in_line_without_eyes_are_no_cylinder() -> None:
    barrel, rod = cylinder(0.0)
    solids, _ = seen(barrel=barrel, rod=rod)
    assert solid_cylinders_of(solids, [], TOLERANCE) == []


def test_a_turntable() -> None:
    solids, _ = seen(
        below=[box((3, 2, 0.4), (0, 0, 0)), bar(0.5, (0, 0, 0.2), (0, 0, 0.4), 24)],
        above=[box((2, 2, 1), (0, 0, 0.91)), box((0.3, 0.3, 0.3), (1, 1, 1.5))],
        lamp=bar(0.05, (0.5, 0.5, 1.41), (0.5, 0.5, 1.5)),
    )
    assert pierced(solids, []) == {("below", "above")}


def boss(y: float) -> trimesh.Trimesh:
    """A drop: round by eye, with a tail."""
    angles = np.linspace(-1.9, 1.9, 19)
    outline = [(0.07 * math.cos(a), (0.06 + 0.004 * math.sin(3 * a)) * math.sin(a)) for a in angles]
    outline += [(-0.12, 0.04), (-0.12, -0.04)]
    # A prism of the outline, its ends as fans.
    count = len(outline)
    points = [(x, level, z) for level in (y - 0.05, y + 0.05) for x, z in outline]
    faces = [(i, (i + 1) % count, i + count) for i in range(count)]
    faces += [((i + 1) % count, (i + 1) % count + count, i + count) for i in range(count)]
    faces += [(0, i + 1, i) for i in range(1, count - 1)]
    faces += [(count, count + i, count + i + 1) for i in range(1, count - 1)]
    return trimesh.Trimesh(points, faces, process=False)


def test_a_fork_with_bosses_rounded_by_eye() -> None:
    solids, index = seen(
        boom=[box((2, 0.02, 0.3), (-0.9, 0.2, 0)), box((2, 0.02, 0.3), (-0.9, -0.2, 0)), boss(0.3), boss(-0.3)],
        arm=box((0.4, 0.3, 2), (0, 0, -0.6)),
    )
    knuckles = solids[index["boom"]].knuckles
    assert len(knuckles) == 2
    assert all(abs(k.center[0]) < 0.01 and abs(k.center[2]) < 0.01 for k in knuckles)
    assert pierced(solids, []) == {("boom", "arm")}
