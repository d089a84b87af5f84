"""The excavator's planar linkage: solved so that the machine meets its published values, and measured again.

Frame: the machine's, in millimetres and in the plane y = 0: x forward from the swing axis, z up from the ground.
Angles are radians, counter-clockwise seen from the machine's right side turned so that x points right and z up (a
raised boom is positive; crowding the arm and curling the bucket turn them negative).

Pins: A boom on the upper structure, B arm on the boom, K bucket on the arm; C and D boom cylinder (frame, boom); M and
P arm cylinder (boom, arm); E bucket cylinder on the arm, H its rod on the tipping link, G tipping link on the arm,
J bucket link on the bucket. T is the line of the tooth points.

Method. The maker prints lengths, strokes and ranges, not pins. The pins are the unknowns of a least-squares problem
that starts from a sketch of the class: first everything at once, softly pulled towards the sketch and away from dead
points, then the published values alone, from there, to the last digit (the problem has more unknowns than
equations, so the second solution stays beside the first).
"""

from __future__ import annotations

import functools
import math

import numpy as np
from scipy.optimize import least_squares

from drawing.digger import Ends, Linkage, Strokes, wrapped
from drawing.planar import Point, direction, rot, sine, vec

from . import values as v

BOOM, ARM = v.BOOM_LENGTH.value, v.ARM_LENGTH.value
BOOM_MIN, BOOM_MAX = v.BOOM_CLOSED.value, v.BOOM_CLOSED.value + v.BOOM_STROKE.value
ARM_MIN, ARM_MAX = v.ARM_CLOSED.value, v.ARM_CLOSED.value + v.ARM_STROKE.value
BUCKET_MIN, BUCKET_MAX = v.BUCKET_CLOSED.value, v.BUCKET_CLOSED.value + v.BUCKET_STROKE.value
DOWN = -math.pi / 2
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


# Where the search starts and what it stays near, and how near: proportions of the class.
_SKETCH: dict[str, tuple[float, float]] = {
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
}
_LEAST_SINE = 0.35
"""How far every lever of the bucket's linkage stays from its dead point, as a sine."""
_NAMES = tuple(_SKETCH)
_START = np.array([at for at, _ in _SKETCH.values()])
_LOOSE = np.array([loose for _, loose in _SKETCH.values()])


def _linkage(x: Point) -> tuple[Linkage, Ends]:
    p = dict(zip(_NAMES, map(float, x), strict=True))
    pins = {n: vec(p[f"{n}.x"], p[f"{n}.z"]) for n in "ACDMPEG"}
    j = rot(p["J.a"], vec(p["J.r"], 0.0))
    ends = Ends(**{n: p[n] for n in ("low", "high", "out", "crowd", "open", "curl")})
    links = {"tipping": p["tipping"], "link": p["link"], "tip": p["tip"]}
    return Linkage(**pins, **links, J=j, boom=BOOM, arm=ARM, strokes=STROKES), ends


_TARGETS = {
    **{
        value.name: value.value
        for value in (
            v.DIGGING_DEPTH,
            v.GROUND_REACH,
            v.MAX_REACH,
            v.DIGGING_HEIGHT,
            v.DUMPING_HEIGHT,
            v.DUMPING_HEIGHT_MIN,
        )
    },
}


def _required(x: Point) -> Point:
    """What must be zero, millimetres; angles as radians times 1000."""
    k, e = _linkage(x)
    got = ranges(k.A, k.tip, e)
    return np.array(
        [
            *(got[name] - wanted for name, wanted in _TARGETS.items()),
            k.boom_at(e.low) - BOOM_MIN,
            k.boom_at(e.high) - BOOM_MAX,
            k.arm_at(e.out) - ARM_MIN,
            k.arm_at(e.crowd) - ARM_MAX,
            1000.0 * wrapped(k.four_bar(BUCKET_MIN)[0] - e.open),
            1000.0 * wrapped(k.four_bar(BUCKET_MAX)[0] - e.curl),
        ]
    )


def _wished(x: Point) -> Point:
    """The required residuals, and softly: near the sketch, and the bucket's levers far from their dead points."""
    k, _ = _linkage(x)
    short: list[float] = []
    for length in np.linspace(BUCKET_MIN, BUCKET_MAX, 9):
        _, h, j = k.four_bar(float(length))
        pin, hub = vec(ARM, 0.0), float(np.hypot(*k.J))
        sines = (sine(k.E, h, k.G), sine(k.G, h, j), sine(h, j, pin))
        short += [60.0 * min(0.0, s - _LEAST_SINE) for s in sines]
        for p, rp, q, rq in ((k.E, float(length), k.G, k.tipping), (h, k.link, pin, hub)):
            d = float(np.hypot(*(q - p)))
            short.append(max(0.0, d - rp - rq) + max(0.0, abs(rp - rq) - d))
    return np.concatenate([_required(x), 0.1 * (x - _START) / _LOOSE, np.array(short)])


@functools.cache
def solve() -> Linkage:
    """The linkage that meets every published value, and the example values above, exactly; the same on every call."""
    close = {"xtol": 1e-12, "ftol": 1e-12, "gtol": 1e-12}
    near = least_squares(_wished, _START, x_scale=_LOOSE, method="trf", max_nfev=400, **close).x
    exact = least_squares(_required, near, x_scale=_LOOSE, method="trf", xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return _linkage(np.round(exact, 9))[0]
