"""A digger's planar linkage: boom, arm and bucket, each moved by a cylinder, the bucket through two links.

In millimetres and in the plane y = 0: x forward, z up. Angles are radians, counter-clockwise seen from the machine's
right side turned so that x points right and z up (a raised boom is positive; crowding the arm and curling the bucket
turn them negative).

Pins: A boom on what carries it, B arm on the boom, K bucket on the arm; C and D boom cylinder (carrier, boom); M and P
arm cylinder (boom, arm); E bucket cylinder on the arm, H its rod on the tipping link, G tipping link on the arm, J
bucket link on the bucket. T is the line of the tooth points.

Method of `fitted`. Makers print lengths, strokes and ranges, not pins. The pins are the unknowns of a least-squares
problem that starts from a sketch of the class: first everything at once, softly pulled towards the sketch and away from
dead points, then the published values alone, from there, to the last digit (the problem has more unknowns than
equations, so the second solution stays beside the first).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, least_squares

from .planar import Point, direction, meet, rot, sine, vec


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


@dataclass(frozen=True, slots=True)
class Strokes:
    """The cylinders' lengths between their pins, closed and open, millimetres."""

    boom: tuple[float, float]
    arm: tuple[float, float]
    bucket: tuple[float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Linkage:
    """Pin positions. A and C are world; D and M are in the boom's frame (origin A, x towards B); P, E and G in the
    arm's (origin B, x towards K); J in the bucket's (origin K, x towards T); `tip` is K-T, `tipping` G-H, `link` H-J,
    `boom` A-B, `arm` B-K; `strokes`: the cylinders' lengths.
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
    boom: float
    arm: float
    strokes: Strokes

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
        return float(np.hypot(*(vec(self.boom, 0.0) + rot(angle, self.P) - self.M)))

    def arm_angle(self, length: float) -> float:
        """Angle between A -> B and B -> K at an arm cylinder length."""
        m = self.M - vec(self.boom, 0.0)
        p, q = float(np.hypot(*m)), float(np.hypot(*self.P))
        opening = math.acos((p * p + q * q - length * length) / (2 * p * q))
        return direction(m) - opening - direction(self.P)

    def four_bar(self, length: float) -> tuple[float, Point, Point]:
        """Angle between B -> K and K -> T at a bucket cylinder length, and H and J in the arm's frame."""
        k = vec(self.arm, 0.0)
        h = meet(self.E, length, self.G, self.tipping, 1.0)
        j = meet(h, self.link, k, float(np.hypot(*self.J)), 1.0)
        return wrapped(direction(j - k) - direction(self.J)), h, j

    def bucket_for(self, angle: float) -> float:
        """Bucket cylinder length at an angle between B -> K and K -> T."""
        return float(brentq(lambda c: self.four_bar(c)[0] - angle, *self.strokes.bucket, xtol=1e-10))

    def pose(self, boom: float, arm: float, bucket: float) -> Pose:
        """All pins at one length of each cylinder."""
        beta = self.boom_angle(boom)
        alpha = beta + self.arm_angle(arm)
        gamma, h, j = self.four_bar(bucket)
        b = self.A + rot(beta, vec(self.boom, 0.0))
        k = b + rot(alpha, vec(self.arm, 0.0))
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
        return self.A + rot(self.boom_angle(self.strokes.boom[0]), vec(self.boom, 0.0))

    def wall_depth(self, floor: float) -> float:
        """Greatest depth of the tooth points, the floor upright, for an angle between K -> T reversed and the floor's
        underside (radians): arm and bucket as far out as that takes, and the boom raised where the arm's stroke ends.
        """
        e, down = self.ends(), -math.pi / 2
        arm = max(down, down + floor - e.open)
        boom = max(e.low, arm - e.out)
        pin = float(self.A[1]) + self.boom * math.sin(boom) + self.arm * math.sin(arm)
        return -pin - self.tip * math.sin(down + floor)

    def floor_angle(self, depth: float) -> float:
        """Angle between K -> T reversed and the floor's underside, radians: what a vertical wall depth takes."""
        return float(brentq(lambda floor: self.wall_depth(floor) - depth, 0.2, 1.2, xtol=1e-14))

    def ends(self) -> Ends:
        """Angles at the ends of the strokes."""
        return Ends(
            low=self.boom_angle(self.strokes.boom[0]),
            high=self.boom_angle(self.strokes.boom[1]),
            out=self.arm_angle(self.strokes.arm[0]),
            crowd=self.arm_angle(self.strokes.arm[1]),
            open=self.four_bar(self.strokes.bucket[0])[0],
            curl=self.four_bar(self.strokes.bucket[1])[0],
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


def wrapped(angle: float) -> float:
    """The angle within half a turn."""
    return (angle + math.pi) % (2 * math.pi) - math.pi


@dataclass(frozen=True, slots=True)
class Sketch:
    """A linkage to be fitted. `places`: where the search starts and what it stays near, and how near: pins `A.x` to
    `G.z`, lengths `tipping`, `link` and `tip`, the pin J as `J.r` and `J.a` (millimetres, radians), the angles of
    `Ends`. Boom and arm lengths and strokes as in `Linkage`. The sines of the bucket's levers stay above `least_sine`,
    so much the more with `pull`."""

    places: Mapping[str, tuple[float, float]]
    boom: float
    arm: float
    strokes: Strokes
    least_sine: float
    pull: float

    def linkage(self, x: Point) -> tuple[Linkage, Ends]:
        """The linkage whose places are `x` (n,), in their order."""
        p = dict(zip(self.places, map(float, x), strict=True))
        pins = {n: vec(p[f"{n}.x"], p[f"{n}.z"]) for n in "ACDMPEG"}
        j = rot(p["J.a"], vec(p["J.r"], 0.0))
        ends = Ends(**{n: p[n] for n in ("low", "high", "out", "crowd", "open", "curl")})
        links = {"tipping": p["tipping"], "link": p["link"], "tip": p["tip"]}
        return Linkage(**pins, **links, J=j, boom=self.boom, arm=self.arm, strokes=self.strokes), ends


def fitted(sketch: Sketch, published: Callable[[Linkage, Ends], list[float]]) -> Linkage:
    """The linkage near a sketch of which all that is `published` is met: residuals in millimetres. The same on every
    call."""
    start = np.array([at for at, _ in sketch.places.values()])
    loose = np.array([far for _, far in sketch.places.values()])
    strokes = sketch.strokes

    def required(x: Point) -> Point:
        """What must be zero, millimetres; angles as radians times 1000."""
        k, e = sketch.linkage(x)
        return np.array(
            [
                *published(k, e),
                k.boom_at(e.low) - strokes.boom[0],
                k.boom_at(e.high) - strokes.boom[1],
                k.arm_at(e.out) - strokes.arm[0],
                k.arm_at(e.crowd) - strokes.arm[1],
                1000.0 * wrapped(k.four_bar(strokes.bucket[0])[0] - e.open),
                1000.0 * wrapped(k.four_bar(strokes.bucket[1])[0] - e.curl),
            ]
        )

    def wished(x: Point) -> Point:
        """The required residuals, and softly: near the sketch, and the bucket's levers far from their dead points."""
        k, _ = sketch.linkage(x)
        short: list[float] = []
        for length in np.linspace(*strokes.bucket, 9):
            _, h, j = k.four_bar(float(length))
            pin, hub = vec(sketch.arm, 0.0), float(np.hypot(*k.J))
            sines = (sine(k.E, h, k.G), sine(k.G, h, j), sine(h, j, pin))
            short += [sketch.pull * min(0.0, s - sketch.least_sine) for s in sines]
            for p, rp, q, rq in ((k.E, float(length), k.G, k.tipping), (h, k.link, pin, hub)):
                d = float(np.hypot(*(q - p)))
                short.append(max(0.0, d - rp - rq) + max(0.0, abs(rp - rq) - d))
        return np.concatenate([required(x), 0.1 * (x - start) / loose, np.array(short)])

    close = {"xtol": 1e-12, "ftol": 1e-12, "gtol": 1e-12}
    near = least_squares(wished, start, x_scale=loose, method="trf", max_nfev=400, **close).x
    exact = least_squares(required, near, x_scale=loose, method="trf", xtol=1e-15, ftol=1e-15, gtol=1e-15).x
    return sketch.linkage(np.round(exact, 9))[0]
