"""Quaternions of frames, with one sign and one choice where the problem leaves several."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike
from pxr import Gf

from yellowiron.model.geometry import Floats

Quaternion = tuple[float, float, float, float]
"""(w, x, y, z), unit, w ≥ 0."""

_TURNS: dict[tuple[int, float], Quaternion] = {
    (0, 1.0): (1.0, 0.0, 0.0, 0.0),
    (0, -1.0): (0.0, 0.0, 0.0, 1.0),
    (1, 1.0): (0.5, 0.5, 0.5, 0.5),
    (1, -1.0): (0.5, 0.5, -0.5, -0.5),
    (2, 1.0): (0.5, -0.5, -0.5, -0.5),
    (2, -1.0): (0.5, 0.5, 0.5, -0.5),
}
"""What takes +X to an axis of the frame, by its number and sign."""


def quaternion_of(rotation: Floats) -> Quaternion:
    """The quaternion of a rotation matrix (3, 3)."""
    matrix = Gf.Matrix4d(1.0).SetRotateOnly(Gf.Matrix3d(np.asarray(rotation).T.tolist()))
    found = matrix.ExtractRotationQuat()
    return _canonical([found.GetReal(), *found.GetImaginary()])


def quaternion_to(axis: ArrayLike) -> Quaternion:
    """A rotation that takes +X to the unit vector `axis`: the one in `_TURNS` to the nearest of the six directions of
    the frame's axes, then the shortest one from there.

    Those six are exact in single precision. A quarter turn's 0.7071 is not: engines that multiply frames in single
    precision would stretch a chain of ten pins by micrometres, and its loops would not close.
    """
    wanted = np.asarray(axis, dtype=np.float64)
    nearest = int(np.argmax(np.abs(wanted)))
    sign = 1.0 if wanted[nearest] >= 0.0 else -1.0
    start = np.zeros(3)
    start[nearest] = sign
    across = np.cross(start, wanted)
    rest = Gf.Quatd(1.0 + float(start @ wanted), Gf.Vec3d(*across.tolist())).GetNormalized()
    found = rest * Gf.Quatd(*_TURNS[nearest, sign])
    return _canonical([found.GetReal(), *found.GetImaginary()])


def axis_of(quaternion: Quaternion) -> tuple[float, float, float]:
    """Where a rotation takes +X."""
    x, y, z = Gf.Quatd(*quaternion).Transform(Gf.Vec3d.XAxis())
    return (x, y, z)


def principal_axes(inertia: Floats) -> tuple[tuple[float, float, float], Quaternion]:
    """The principal moments of a symmetric inertia (3, 3) and the rotation from its principal axes to its frame.

    Moments keep the order of the frame's axes as far as it makes sense, so a diagonal inertia gives no rotation.
    """
    symmetric = 0.5 * (inertia + inertia.T)
    if np.allclose(symmetric, np.diag(np.diag(symmetric)), rtol=0.0, atol=1e-12 * float(np.abs(symmetric).max() or 1)):
        first, second, third = (float(v) for v in np.diag(symmetric))
        return (first, second, third), (1.0, 0.0, 0.0, 0.0)
    moments, axes = np.linalg.eigh(symmetric)
    order = _nearest_order(np.abs(axes))
    moments, axes = moments[order], axes[:, order]
    axes = axes * np.where(np.diag(axes) < 0.0, -1.0, 1.0)
    if np.linalg.det(axes) < 0.0:
        axes[:, 2] = -axes[:, 2]
    first, second, third = (float(v) for v in moments)
    return (first, second, third), quaternion_of(axes)


def _nearest_order(weights: Floats) -> list[int]:
    """For each frame axis, the column that lies nearest to it, none twice."""
    order: list[int] = []
    for row in weights:
        free = [c for c in range(3) if c not in order]
        order.append(max(free, key=lambda c: row[c]))
    return order


def _canonical(quaternion: Sequence[float]) -> Quaternion:
    """Unit length, first nonzero component positive, no negative zeros."""
    length = math.hypot(*quaternion)
    leading = next((v for v in quaternion if abs(v) > 1e-15 * length), 1.0)
    w, x, y, z = (v / math.copysign(length, leading) + 0.0 for v in quaternion)
    return (w, x, y, z)
