"""The excavator's planar linkage: solved so that the machine meets its published values, and measured again.

Frame: the machine's, x from the swing axis, z from the ground; pins, angles and method are those of `drawing.digger`.
"""

from __future__ import annotations

import functools
import math

import numpy as np

from drawing.digger import Ends, Linkage, Sketch, Strokes, fitted
from drawing.planar import Point, direction, rot, vec

from . import values as v

BOOM, ARM = v.BOOM_LENGTH.value, v.ARM_LENGTH.value
BOOM_MIN, BOOM_MAX = v.BOOM_CLOSED.value, v.BOOM_CLOSED.value + v.BOOM_STROKE.value
ARM_MIN, ARM_MAX = v.ARM_CLOSED.value, v.ARM_CLOSED.value + v.ARM_STROKE.value
BUCKET_MIN, BUCKET_MAX = v.BUCKET_CLOSED.value, v.BUCKET_CLOSED.value + v.BUCKET_STROKE.value
STROKES = Strokes((BOOM_MIN, BOOM_MAX), (ARM_MIN, ARM_MAX), (BUCKET_MIN, BUCKET_MAX))


def ranges(a: Point, tip: float, e: Ends, depth: float = v.LEVEL_DEPTH.value) -> dict[str, float]:
    """The working ranges by the values' names, millimetres, from the boom pin, the distance K - T and the end angles;
    `depth`: where the length of level bottom is measured.

    The lowest point: boom down, arm and bucket in one line straight down. The farthest: arm out, K and T in line with
    A. The highest: boom up, arm out, bucket open. The dumping heights: the tooth points straight below K.
    """
    boom, arm, reach = vec(BOOM, 0.0), vec(ARM, 0.0), ARM + tip
    low = a + rot(e.low, boom)
    far = float(np.hypot(*(boom + rot(e.out, arm)))) + tip
    out = a + rot(e.high, boom + rot(e.out, arm))
    crowd = a + rot(e.high, boom + rot(e.crowd, arm))
    ahead, half = _ahead(a, tip, e, depth)
    return {
        v.DIGGING_DEPTH.name: reach - float(low[1]),
        v.GROUND_REACH.name: float(a[0]) + math.sqrt(max(0.0, far**2 - float(a[1]) ** 2)),
        v.MAX_REACH.name: float(a[0]) + far,
        v.DIGGING_HEIGHT.name: float((out + rot(e.high + e.out + e.open, vec(tip, 0.0)))[1]),
        v.DUMPING_HEIGHT.name: float(out[1]) - tip,
        v.DUMPING_HEIGHT_MIN.name: float(crowd[1]) - tip,
        LEVEL: ahead - (float(low[0]) - half),
    }


def _ahead(a: Point, tip: float, e: Ends, depth: float) -> tuple[float, float]:
    """x of the farthest tooth point at a depth below the ground, and half the chord of the lowered boom's circle there.

    The edge of the work space is made of three arcs: with the boom down, first arm and bucket in one line about B,
    then, the arm out, the bucket about K until it is in line with A; from there all about A as the boom rises.
    """
    low = a + rot(e.low, vec(BOOM, 0.0))
    pin = low + rot(e.low + e.out, vec(ARM, 0.0))

    def right(centre: Point, radius: float) -> tuple[float, float]:
        """Half chord of a circle at the depth, and the direction of its right end."""
        down = float(centre[1]) + depth
        half = math.sqrt(max(0.0, radius**2 - down**2))
        return half, math.atan2(-down, half)

    half, angle = right(low, ARM + tip)
    if angle <= e.low + e.out:
        return float(low[0]) + half, half
    chord, angle = right(pin, tip)
    if angle <= direction(pin - a):
        return float(pin[0]) + chord, half
    return float(a[0]) + right(a, float(np.hypot(*(pin - a))) + tip)[0], half


LEVEL = "length of level bottom"


SKETCH = Sketch(
    {
        "A.x": (80, 8),
        "A.z": (1890, 40),
        "C.x": (620, 80),
        "C.z": (1235, 60),
        "D.x": (2500, 120),
        "D.z": (620, 20),
        "M.x": (2850, 100),
        "M.z": (900, 15),
        "P.x": (-760, 40),
        "P.z": (420, 40),
        "E.x": (330, 60),
        "E.z": (590, 25),
        "G.x": (2490, 30),
        "G.z": (45, 20),
        "tipping": (610, 40),
        "link": (570, 40),
        "J.r": (440, 25),
        "J.a": (math.radians(95), 0.12),
        "tip": (1495, 4),
        "low": (math.radians(-45.5), 0.1),
        "high": (math.radians(66), 0.03),
        "out": (math.radians(-33), 0.03),
        "crowd": (math.radians(-148), 0.03),
        "open": (math.radians(33), 0.04),
        "curl": (math.radians(-140), 0.06),
    },
    boom=BOOM, arm=ARM, strokes=STROKES, least_sine=0.35, pull=60.0,
)  # fmt: skip
"""Proportions of the class."""
_TARGETS = (
    v.DIGGING_DEPTH, v.GROUND_REACH, v.MAX_REACH, v.DIGGING_HEIGHT, v.DUMPING_HEIGHT, v.DUMPING_HEIGHT_MIN,
)  # fmt: skip


def _published(k: Linkage, e: Ends) -> list[float]:
    got = ranges(k.A, k.tip, e)
    return [got[value.name] - value.value for value in _TARGETS]


@functools.cache
def solve() -> Linkage:
    """The linkage that meets every published value, and the example values above, exactly; the same on every call."""
    return fitted(SKETCH, _published)
