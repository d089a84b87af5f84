"""Shapes and places to build small USD machines from."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh

from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import CylinderFeature, Mesh, Shape
from yellowiron.model.mechanism import Mechanism

Place = np.ndarray


@dataclass(frozen=True)
class Machine:
    """A mechanism with the assembly it was built from."""

    mechanism: Mechanism
    assembly: Assembly
    texture_folder: Path


def make_shape(name: str, mesh: trimesh.Trimesh, *, normals: bool = False, **features: object) -> Shape:
    key = hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes()).hexdigest()
    return Shape(
        key=key,
        name=name,
        mesh=Mesh(
            np.array(mesh.vertices, dtype=np.float64),
            np.array(mesh.faces, dtype=np.int32),
            np.array(mesh.vertex_normals) if normals else None,
        ),
        volume=float(mesh.volume),
        area=float(mesh.area),
        centroid=np.array(mesh.center_mass),
        inertia=np.array(mesh.moment_inertia),
        bounds=np.array(mesh.bounds),
        **features,  # type: ignore[arg-type]
    )


def round_shape(name: str, radius: float, height: float) -> Shape:
    feature = CylinderFeature((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), radius, -height / 2, height / 2, 2 * np.pi, False)
    return make_shape(name, trimesh.creation.cylinder(radius, height, sections=24), cylinders=(feature,))


def open_box(name: str) -> Shape:
    """A bucket: five plates, hollow, as one closed solid."""
    outer = trimesh.creation.box((1.0, 2.0, 0.8))
    plates = [(0, -0.48), (1, -0.98), (1, 0.98), (2, -0.38), (2, 0.38)]
    parts = []
    for axis, place in plates:
        size = np.array(outer.extents)
        size[axis] = 0.04
        offset = np.zeros(3)
        offset[axis] = place
        parts.append(trimesh.creation.box(size, trimesh.transformations.translation_matrix(offset)))
    return make_shape(name, trimesh.util.concatenate(parts))


def at(x: float, y: float, z: float, *, turn: tuple[float, tuple[float, float, float]] | None = None) -> Place:
    matrix = trimesh.transformations.rotation_matrix(*turn) if turn else np.eye(4)
    matrix[:3, 3] = (x, y, z)
    return matrix


MIRROR_Y = np.diag([1.0, -1.0, 1.0, 1.0])
ACROSS = (np.pi / 2, (1.0, 0.0, 0.0))
