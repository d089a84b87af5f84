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
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares

from drawing.planar import Point, direction, meet, rot, sine, vec

from . import values as v

BOOM, ARM = v.BOOM_LENGTH.value, v.ARM_LENGTH.value
BOOM_MIN, BOOM_MAX = v.BOOM_CLOSED.value, v.BOOM_CLOSED.value + v.BOOM_STROKE.value
ARM_MIN, ARM_MAX = v.ARM_CLOSED.value, v.ARM_CLOSED.value + v.ARM_STROKE.value
BUCKET_MIN, BUCKET_MAX = v.BUCKET_CLOSED.value, v.BUCKET_CLOSED.value + v.BUCKET_STROKE.value
DOWN = -math.pi / 2


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the pins are at one length of each cylinder; world points, millimetres, radians. Boom, arm and bucket
    angles are those of A -> B, B -> K and K -> T from the level."""

    boom: float
    arm: float
    bucket: float
    boom_angle: float
    arm_angle: float
    bucket_angle: float
    B: Point
    K: Point
    T: Point
    D: Point
    M: Point
    P: Point
    E: Point
    G: Point
    H: Point
    J: Point


@dataclass(frozen=True, slots=True, eq=False)
class Linkage:
    """Pin positions. A and C are world; D and M are in the boom's frame (origin A, x towards B); P, E and G in the
    arm's (origin B, x towards K); J in the bucket's (origin K, x towards T); `tip` is K-T, `tipping` G-H, `link` H-J.
    """

    A: Point
    C: Point
    D: Point
    M: Point
    P: Point
    E: Point
    G: Point
    tipping: float
    link: float
    J: Point
    tip: float

    # ---- cylinder lengths and angles --------
    def boom_at(self, angle: float) -> float:
        """Boom cylinder length at an angle of A -> B."""
        return float(np.hypot(*(self.A + rot(angle, self.D) - self.C)))

    def boom_angle(self, length: float) -> float:
        """Angle of A -> B at a boom cylinder length."""
        p, q = float(np.hypot(*(self.C - self.A))), float(np.hypot(*self.D))
        opening = math.acos((p * p + q * q - length * length) / (2 * p * q))
        return direction(self.C - self.A) + opening - direction(self.D)

    def arm_at(self, angle: float) -> float:
        """Arm cylinder length at an angle between A -> B and B -> K (negative: crowded)."""
        return float(np.hypot(*(vec(BOOM, 0.0) + rot(angle, self.P) - self.M)))

    def arm_angle(self, length: float) -> float:
        """Angle between A -> B and B -> K at an arm cylinder length."""
        m = self.M - vec(BOOM, 0.0)
        p, q = float(np.hypot(*m)), float(np.hypot(*self.P))
        opening = math.acos((p * p + q * q - length * length) / (2 * p * q))
        return direction(m) - opening - direction(self.P)

    def four_bar(self, length: float) -> tuple[float, Point, Point]:
        """Angle between B -> K and K -> T at a bucket cylinder length, and H and J in the arm's frame."""
        k = vec(ARM, 0.0)
        h = meet(self.E, length, self.G, self.tipping, 1.0)
        j = meet(h, self.link, k, float(np.hypot(*self.J)), 1.0)
        return wrapped(direction(j - k) - direction(self.J)), h, j

    def bucket_for(self, angle: float) -> float:
        """Bucket cylinder length at an angle between B -> K and K -> T."""
        return float(brentq(lambda c: self.four_bar(c)[0] - angle, BUCKET_MIN, BUCKET_MAX, xtol=1e-10))

    def pose(self, boom: float, arm: float, bucket: float) -> Pose:
        """All pins at one length of each cylinder."""
        beta = self.boom_angle(boom)
        alpha = beta + self.arm_angle(arm)
        gamma, h, j = self.four_bar(bucket)
        b = self.A + rot(beta, vec(BOOM, 0.0))
        k = b + rot(alpha, vec(ARM, 0.0))
        theta = alpha + gamma
        return Pose(
            boom,
            arm,
            bucket,
            beta,
            alpha,
            theta,
            B=b,
            K=k,
            T=k + rot(theta, vec(self.tip, 0.0)),
            D=self.A + rot(beta, self.D),
            M=self.A + rot(beta, self.M),
            P=b + rot(alpha, self.P),
            E=b + rot(alpha, self.E),
            G=b + rot(alpha, self.G),
            H=b + rot(alpha, h),
            J=b + rot(alpha, j),
        )

    def margins(self, pose: Pose) -> tuple[float, float, float, float, float]:
        """Sines at C, P, H (rod on tipping link), H (tipping link on bucket link) and J: none may come near 0."""
        return (
            sine(self.A, self.C, pose.D) * -1.0,
            sine(pose.M, pose.P, pose.B),
            sine(pose.E, pose.H, pose.G),
            sine(pose.G, pose.H, pose.J),
            sine(pose.H, pose.J, pose.K),
        )

    def lowest_arm_pin(self) -> Point:
        """B with the boom cylinders closed."""
        return self.A + rot(self.boom_angle(BOOM_MIN), vec(BOOM, 0.0))

    def ends(self) -> Ends:
        """Angles at the ends of the strokes."""
        return Ends(
            low=self.boom_angle(BOOM_MIN),
            high=self.boom_angle(BOOM_MAX),
            out=self.arm_angle(ARM_MIN),
            crowd=self.arm_angle(ARM_MAX),
            open=self.four_bar(BUCKET_MIN)[0],
            curl=self.four_bar(BUCKET_MAX)[0],
        )


@dataclass(frozen=True, slots=True)
class Ends:
    """Angles at the ends of the strokes, radians: boom from the level, arm from A -> B, bucket from B -> K."""

    low: float
    high: float
    out: float
    crowd: float
    open: float
    curl: float


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


def wrapped(angle: float) -> float:
    """The angle within half a turn."""
    return (angle + math.pi) % (2 * math.pi) - math.pi


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
    return Linkage(**pins, tipping=p["tipping"], link=p["link"], J=j, tip=p["tip"]), ends


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
