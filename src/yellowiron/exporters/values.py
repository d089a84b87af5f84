"""Numbers, frames and colours as the documents write them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Site
from yellowiron.model.sensor import Sensor


def axes_of(frame: Site | Sensor) -> Floats:
    """The axes (3, 3; columns) of a site or sensor in the machine frame."""
    x, z = np.asarray(frame.x_axis), np.asarray(frame.z_axis)
    return np.column_stack([x, np.cross(z, x), z])


def quaternion(rotation: Floats) -> Floats:
    """(w, x, y, z) with w >= 0 of a rotation matrix (3, 3)."""
    from scipy.spatial.transform import Rotation

    x, y, z, w = Rotation.from_matrix(rotation).as_quat(canonical=True)
    return np.array([w, x, y, z])


def minus(point: Iterable[float], origin: Iterable[float]) -> Floats:
    """The difference of two points."""
    return np.asarray(tuple(point), dtype=np.float64) - np.asarray(tuple(origin), dtype=np.float64)


def text(value: float) -> str:
    """Twelve digits: a micrometre in a thousand kilometres."""
    return f"{float(value) + 0.0:.12g}"


def srgb(value: float) -> float:
    """IEC 61966-2-1: the display value of a linear one."""
    value = min(1.0, max(0.0, value))
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1.0 / 2.4) - 0.055


def row(values: Iterable[float]) -> str:
    """Numbers with spaces between; rounding errors of zero are zero."""
    return " ".join("0" if abs(v) < 1e-15 else text(v) for v in values)


def roll_pitch_yaw(rotation: Floats) -> Floats:
    """The angles (3,), radians, about fixed x, y, z in this order that make a rotation matrix (3, 3)."""
    pitch = np.arctan2(-rotation[2, 0], np.hypot(rotation[0, 0], rotation[1, 0]))
    if abs(rotation[2, 0]) < 1.0 - 1e-12:
        roll, yaw = np.arctan2(rotation[2, 1], rotation[2, 2]), np.arctan2(rotation[1, 0], rotation[0, 0])
    else:  # Roll and yaw turn about one line: all of it is yaw.
        roll, yaw = 0.0, np.arctan2(-rotation[0, 1], rotation[1, 1])
    return np.array([roll, pitch, yaw])
