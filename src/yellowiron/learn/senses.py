"""A machine's sensors as numbers of about one: what the exported MJCF's sensors read, scaled by what they can."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import GRAVITY, Mechanism

_FAR = 10.0
"""Metres and m/s that count as one, of a satellite receiver's position and velocity."""


class Senses:
    """All sensors of a model, one after the other in its order; `places` says where whose are."""

    def __init__(self, mechanism: Mechanism, model: Any) -> None:
        self._middle = np.zeros(model.nsensordata)
        self._scale = np.ones(model.nsensordata)
        weight = GRAVITY * sum(body.mass for body in mechanism.bodies)
        self.places: Mapping[str, slice] = {}
        """Sensor → where its values are in an observation."""
        places = {}
        for number in range(model.nsensor):
            start = int(model.sensor_adr[number])
            own = slice(start, start + int(model.sensor_dim[number]))
            places[str(model.sensor(number).name)] = own
            self._middle[own], self._scale[own] = _range(model, number, weight)
        self.places = places
        self.size = int(model.nsensordata)

    def read(self, data: Any) -> Floats:
        """The readings (size,) now: strokes −1 … 1 from end to end, pivots in half turns, forces by the drive's largest
        one, what touches by the machine's weight, accelerations by the Earth's, positions by ten metres."""
        return np.asarray((data.sensordata - self._middle) / self._scale, dtype=np.float64)


def _range(model: Any, number: int, weight: float) -> tuple[float, float]:
    """Of a sensor the reading that is 0, and what is one more than it."""
    kind, thing = mujoco.mjtSensor(int(model.sensor_type[number])), int(model.sensor_objid[number])
    types = mujoco.mjtSensor
    if kind == types.mjSENS_JOINTPOS:
        if not model.jnt_limited[thing]:
            return 0.0, float(np.pi)
        low, high = map(float, model.jnt_range[thing])
        return 0.5 * (low + high), max(0.5 * (high - low), 1e-6)
    if kind == types.mjSENS_JOINTACTFRC:
        most = float(np.abs(model.jnt_actfrcrange[thing]).max())
        return 0.0, most if most > 0.0 else weight
    scales = {
        types.mjSENS_ACCELEROMETER: GRAVITY,
        types.mjSENS_TOUCH: weight,
        types.mjSENS_FRAMEPOS: _FAR,
        types.mjSENS_FRAMELINVEL: _FAR,
    }
    return 0.0, scales.get(kind, 1.0)
