"""Analytic solids for the synthetic machines: convex plates with holes, lathed shapes, with exact features."""

from __future__ import annotations

import functools
import math

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, Delaunay

from yellowiron.model.geometry import CylinderFeature, Mesh, PlaneFeature, Shape

Array = NDArray[np.float64]
SEGMENTS = 32
HOLLOW = True
"""False: nothing has a hole, and the round ends of plates are features, as in models that are drawn to be looked at."""
CORNERS = 24
"""Corners of a circle in an outline."""
RINGS = ("tyre", "rim")
"""These stay hollow in any model."""


def _shape(name: str, mesh: trimesh.Trimesh, cylinders: list[CylinderFeature], planes: list[PlaneFeature]) -> Shape:
    points = np.asarray(mesh.vertices, dtype=np.float64)
    properties = mesh.mass_properties
    return Shape(
        key=name,
        name=name,
        mesh=Mesh(points, np.asarray(mesh.faces, dtype=np.int32)),
        volume=float(properties.volume),
        area=float(mesh.area),
        centroid=np.asarray(properties.center_mass, dtype=np.float64),
        inertia=np.asarray(properties.inertia, dtype=np.float64),
        cylinders=tuple(cylinders),
        planes=tuple(planes),
        bounds=np.array([points.min(axis=0), points.max(axis=0)]),
    )


def plate(name: str, outline: Array, thickness: float, holes: list[tuple[float, float, float]] | None = None) -> Shape:
    """A convex `outline` (n, 2) in x, y, extruded from z = −t/2 to t/2, with round through holes (x, y, radius)."""
    return _plate(name, tuple(map(tuple, outline.tolist())), thickness, tuple(holes or ()), HOLLOW)


@functools.cache
def _plate(
    name: str, corners: tuple[tuple[float, ...], ...], thickness: float, holes: tuple[tuple[float, float, float], ...],
    hollow: bool,
) -> Shape:  # fmt: skip
    outline = np.array(corners)
    if not hollow and holes:
        outline = np.concatenate([outline, around(*holes)])  # a hole may be beside the outline, and widens it
    holes = holes if hollow else ()
    hull = outline[ConvexHull(outline).vertices]
    turn = np.linspace(0.0, 2 * math.pi, SEGMENTS, endpoint=False)
    rim = []
    longest = max(np.ptp(hull[:, 0]), np.ptp(hull[:, 1])) / 8
    for a, b in zip(hull, np.roll(hull, -1, axis=0), strict=True):
        pieces = max(1, math.ceil(float(np.hypot(*(b - a))) / longest))
        rim += [a + (b - a) * k / pieces for k in range(pieces)]
    circles = [np.array([x, y]) + r * np.stack([np.cos(turn), np.sin(turn)], axis=1) for x, y, r in holes]
    flat = np.concatenate([np.array(rim), *circles])
    triangles = Delaunay(flat).simplices
    # What has all its corners on one circle fills its hole.
    circle = np.concatenate([np.full(len(rim), -1), np.repeat(np.arange(len(holes)), SEGMENTS)])[triangles]
    keep = (circle[:, 0] < 0) | (circle != circle[:, :1]).any(axis=1)
    corners = flat[triangles]
    cross = (corners[:, 1, 0] - corners[:, 0, 0]) * (corners[:, 2, 1] - corners[:, 0, 1]) - (
        corners[:, 1, 1] - corners[:, 0, 1]
    ) * (corners[:, 2, 0] - corners[:, 0, 0])
    keep &= np.abs(cross) > 1e-12
    triangles = np.where((cross < 0)[:, None], triangles[:, ::-1], triangles)[keep]
    n = len(flat)
    half = thickness / 2
    points = np.concatenate([np.c_[flat, np.full(n, half)], np.c_[flat, np.full(n, -half)]])
    faces = [triangles, triangles[:, ::-1] + n]
    loops = [(np.arange(len(rim)), 1)]
    start = len(rim)
    for _ in circles:
        loops.append((np.arange(start, start + SEGMENTS), -1))
        start += SEGMENTS
    for loop, sign in loops:
        following = np.roll(loop, -1)
        quad = np.concatenate([np.c_[loop + n, following + n, following], np.c_[loop + n, following, loop]])
        faces.append(quad if sign > 0 else quad[:, ::-1])
    mesh = trimesh.Trimesh(points, np.concatenate(faces), process=False)
    area = float(ConvexHull(hull).volume) - sum(math.pi * r * r for *_, r in holes)
    centre = hull.mean(axis=0)
    planes = [
        PlaneFeature((*map(float, centre), half), (0.0, 0.0, 1.0), area),
        PlaneFeature((*map(float, centre), -half), (0.0, 0.0, -1.0), area),
    ]
    for a, b in zip(hull, np.roll(hull, -1, axis=0), strict=True):
        length = float(np.hypot(*(b - a)))
        if length > 0.35 * thickness or length > 0.02:
            m, d = (a + b) / 2, (b - a) / length
            planes.append(
                PlaneFeature((float(m[0]), float(m[1]), 0.0), (float(d[1]), float(-d[0]), 0.0), length * thickness)
            )
    cylinders = [
        CylinderFeature(
            (x, y, 0.0), (0.0, 0.0, 1.0), r, -half, half, 2 * math.pi, True, True, 2 * math.pi * r * thickness
        )
        for x, y, r in holes
    ]
    if not hollow:
        cylinders += [
            CylinderFeature((x, y, 0.0), (0.0, 0.0, 1.0), r, -half, half, arc, False, True, arc * r * thickness)
            for x, y, r, arc in _ends(hull)
        ]
    return _shape(name, mesh, cylinders, planes)


def _ends(hull: Array) -> list[tuple[float, float, float, float]]:
    """The arcs of a convex outline (n, 2) whose corners `around` has drawn: x, y, radius, radians."""
    edges = np.roll(hull, -1, axis=0) - hull
    length = np.hypot(*edges.T)
    ahead = np.roll(edges, -1, axis=0)
    turn = np.arctan2(edges[:, 0] * ahead[:, 1] - edges[:, 1] * ahead[:, 0], (edges * ahead).sum(axis=1))
    step = 2 * math.pi / CORNERS
    # Edge k and the one after it are of one circle.
    same = (np.abs(turn - step) < 1e-6) & (np.abs(np.roll(length, -1) / length - 1) < 1e-6)
    found = []
    for k in np.flatnonzero(same & ~np.roll(same, 1)).tolist():
        count = 1
        while same[(k + count) % len(hull)] and count < len(hull):
            count += 1
        radius = float(length[k] / (2 * math.sin(step / 2)))
        inward = np.array([-edges[k, 1], edges[k, 0]]) / length[k]
        centre = hull[k] + edges[k] / 2 + inward * radius * math.cos(step / 2)
        found.append((float(centre[0]), float(centre[1]), radius, (count + 1) * step))
    return found


def lathe(name: str, profile: list[tuple[float, float]]) -> Shape:
    """A closed `profile` of (radius, z), counter-clockwise with r to the right and z up, turned about z."""
    return _lathe(name, tuple(profile if HOLLOW or name in RINGS else _filled(profile)))


@functools.cache
def _lathe(name: str, profile: tuple[tuple[float, float], ...]) -> Shape:
    rows = [np.array(p, dtype=np.float64) for p in profile]
    turn = np.linspace(0.0, 2 * math.pi, SEGMENTS, endpoint=False)
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    points = np.concatenate([np.c_[r * ring, np.full(SEGMENTS, z)] for r, z in rows])
    faces = []
    k = np.arange(SEGMENTS)
    j = (k + 1) % SEGMENTS
    cylinders, planes = [], []
    for i in range(len(rows)):
        o = (i + 1) % len(rows)
        (r0, z0), (r1, z1) = rows[i], rows[o]
        a, b = i * SEGMENTS, o * SEGMENTS
        if r0 > 0 or r1 > 0:
            faces.append(np.concatenate([np.c_[a + k, a + j, b + j], np.c_[a + k, b + j, b + k]]))
        if r0 == r1 > 0 and z0 != z1:
            lower, upper = min(z0, z1), max(z0, z1)
            cylinders.append(
                CylinderFeature(
                    (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), float(r0), float(lower), float(upper), 2 * math.pi, bool(z1 < z0),
                    True, float(2 * math.pi * r0 * (upper - lower)),
                )
            )  # fmt: skip
        if z0 == z1 and r0 != r1:
            planes.append(
                PlaneFeature((0.0, 0.0, float(z0)), (0.0, 0.0, 1.0 if r1 < r0 else -1.0), math.pi * abs(r1**2 - r0**2))
            )
    mesh = trimesh.Trimesh(points, np.concatenate(faces), process=True)
    mesh.update_faces(mesh.nondegenerate_faces())
    return _shape(name, mesh, cylinders, planes)


def _filled(profile: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The profile without its inner side: its surfaces that face outward, and what closes them on the axis."""
    pairs = zip(profile, [*profile[1:], profile[0]], strict=True)
    outer = [p for a, b in pairs if b[1] > a[1] for p in (a, b) if max(a[0], b[0]) > 0.0]
    outer = [p for k, p in enumerate(outer) if k == 0 or p != outer[k - 1]]
    return [(0.0, outer[0][1]), *outer, (0.0, outer[-1][1])]


def tube(name: str, outer: float, inner: float, length: float) -> Shape:
    """A tube (or with inner 0 a bar) along z from 0 to `length`."""
    return lathe(name, [(inner, 0.0), (outer, 0.0), (outer, length), (inner, length)])


def bolt(name: str, radius: float, length: float) -> Shape:
    """A shank along −z from 0, with a head above."""
    head = 1.6 * radius
    return lathe(
        name, [(0.0, -length), (radius, -length), (radius, 0.0), (head, 0.0), (head, 1.3 * radius), (0.0, 1.3 * radius)]
    )


def box(name: str, x: float, y: float, z: float, holes: list[tuple[float, float, float]] | None = None) -> Shape:
    """A block centred on the origin, with holes along z."""
    return plate(name, np.array([[-x / 2, -y / 2], [x / 2, -y / 2], [x / 2, y / 2], [-x / 2, y / 2]]), z, holes)


def around(*circles: tuple[float, float, float]) -> Array:
    """The outline around circles (x, y, radius): points to take the convex hull of; radius 0: a corner."""
    turn = np.linspace(0.0, 2 * math.pi, CORNERS, endpoint=False)
    return np.concatenate(
        [
            np.array([[x, y]]) if r == 0 else np.array([x, y]) + r * np.stack([np.cos(turn), np.sin(turn)], axis=1)
            for x, y, r in circles
        ]
    )


def place(
    origin: Array | tuple[float, float, float], z: Array | tuple[float, ...], x: Array | tuple[float, ...] | None = None
) -> Array:
    """(4, 4) taking local z to `z`, local x near `x` (any, if None), origin to `origin`."""
    w = np.asarray(z, dtype=np.float64) / np.linalg.norm(z)
    u = np.asarray(x, dtype=np.float64) if x is not None else np.eye(3)[int(np.argmin(np.abs(w)))]
    u = u - w * (u @ w)
    u /= np.linalg.norm(u)
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = u, np.cross(w, u), w, origin
    return matrix
