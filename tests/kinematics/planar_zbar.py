"""An independent Z-bar loader: closed-form planar kinematics (circles only, numpy, no solver) and a `Mechanism` made
from the same pins. x forward, z up; planar angles counter-clockwise (raising), so the machine's +Y coordinates
are their negatives."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Cylinder, Drive, Joint, Loop, Mechanism, Site
from yellowiron.model.template import MeasurementTemplate

Point = NDArray[np.float64]


def point(x: float, z: float) -> Point:
    return np.array([x, z], dtype=np.float64)


def turned(p: Point, angle: float) -> Point:
    c, s = math.cos(angle), math.sin(angle)
    return point(c * p[0] - s * p[1], s * p[0] + c * p[1])


def direction(p: Point) -> float:
    return math.atan2(p[1], p[0])


def length(p: Point, q: Point) -> float:
    return math.hypot(q[0] - p[0], q[1] - p[1])


def side(p: Point, q: Point, r: Point) -> float:
    """+1 where r is left of p → q, else −1."""
    return math.copysign(1.0, (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]))


def meet(p: Point, rp: float, q: Point, rq: float, where: float) -> Point:
    """The point at rp from p and rq from q, left (+1) or right (−1) of p → q; ValueError where the circles miss."""
    d = length(p, q)
    along = (d * d + rp * rp - rq * rq) / (2.0 * d)
    across = math.sqrt(rp * rp - along * along)
    u = (q - p) / d
    return p + along * u + where * across * point(-u[1], u[0])


def wrapped(angle: float) -> float:
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


@dataclass(frozen=True)
class ZBar:
    """Pins in the drawn pose. A boom, C lift barrel and E tilt barrel on the frame; D lift rod, G rocker, B bucket on
    the boom; F tilt rod and H link on the rocker; J link and T edge on the bucket. P, Q: left steering cylinder seen
    from above (rear, front), articulation at the origin, right one mirrored."""

    A: Point
    B: Point
    C: Point
    D: Point
    E: Point
    F: Point
    G: Point
    H: Point
    J: Point
    T: Point
    P: Point
    Q: Point

    @property
    def lift(self) -> float:
        return length(self.C, self.D)

    @property
    def tilt(self) -> float:
        return length(self.E, self.F)

    @property
    def steer(self) -> float:
        return length(self.P, self.Q)

    def pose(self, lift: float, tilt: float) -> dict[str, Any]:
        """Pins and the turns of boom, rocker, link and bucket from the drawn pose, at two cylinder lengths."""
        d = meet(self.C, lift, self.A, length(self.A, self.D), side(self.C, self.A, self.D))
        boom = wrapped(direction(d - self.A) - direction(self.D - self.A))
        b, g = (self.A + turned(p - self.A, boom) for p in (self.B, self.G))
        f = meet(self.E, tilt, g, length(self.G, self.F), side(self.E, self.G, self.F))
        rocker = wrapped(direction(f - g) - direction(self.F - self.G))
        h = g + turned(self.H - self.G, rocker)
        j = meet(h, length(self.H, self.J), b, length(self.B, self.J), side(self.H, self.B, self.J))
        link = wrapped(direction(j - h) - direction(self.J - self.H))
        bucket = wrapped(direction(j - b) - direction(self.J - self.B))
        pins = {"B": b, "D": d, "F": f, "G": g, "H": h, "J": j, "T": b + turned(self.T - self.B, bucket)}
        lifts, tilts = (
            wrapped(direction(d - self.C) - direction(self.D - self.C)),
            wrapped(direction(f - self.E) - direction(self.F - self.E)),
        )
        return {"boom": boom, "rocker": rocker, "link": link, "bucket": bucket, "lift": lifts, "tilt": tilts, **pins}

    def steering(self, left: float) -> tuple[float, float]:
        """Steering angle (left positive) and right cylinder length at a left cylinder length."""
        o = point(0.0, 0.0)
        q = meet(self.P, left, o, length(o, self.Q), side(self.P, o, self.Q))
        angle = wrapped(direction(q) - direction(self.Q))
        mirror = np.array([1.0, -1.0])
        return angle, length(self.P * mirror, turned(self.Q * mirror, angle))

    def margin(self, lift: float, tilt: float) -> float:
        """Smallest |sine| of the three dyads: 0 at a dead point."""
        p = self.pose(lift, tilt)
        corners = [
            (self.C, p["D"], self.A),
            (self.E, p["F"], p["G"]),
            (p["H"], p["J"], p["B"]),
            (p["G"], p["H"], p["J"]),
        ]
        sines = []
        for a, corner, b in corners[:3]:
            u, v = a - corner, b - corner
            sines.append(abs(u[0] * v[1] - u[1] * v[0]) / (math.hypot(*u) * math.hypot(*v)))
        return min(sines)


def sketch(scale: float = 1.0, wobble: Point | None = None, boom: float = -0.3, tilt: float = 1.35) -> ZBar:
    """A loader in the usual proportions; `wobble` (14,) moves its pins by that many tenths of a metre."""
    w = 0.1 * (np.zeros(14) if wobble is None else wobble)
    a, c, e = point(0.8 + w[0], 2.1 + w[1]), point(0.67 + w[2], 1.38 + w[3]), point(1.06 + w[4], 1.83 + w[5])
    b = a + turned(point(2.9 + w[6], 0.0), boom)
    d = a + turned(point(1.3 + w[7], -0.14), boom)
    g = a + turned(point(1.96 + w[8], 0.33 + w[9]), boom)
    f = meet(e, tilt, g, 0.72 + w[10], 1.0)
    h = g + turned(point(0.64 + w[11], 0.0), direction(f - g) + math.radians(172.0))
    j = meet(h, 0.5, b, 0.43, 1.0)
    bucket = direction(j - b) - math.radians(96.0)
    t = b + turned(point(1.5 + w[12], -0.29), bucket + 0.1 * w[13])
    plan = (point(-0.48, 0.33), point(0.45, 0.405))
    return ZBar(*(scale * p for p in (a, b, c, d, e, f, g, h, j, t, *plan)))


def strokes(z: ZBar, margin: float = 0.25, steps: int = 9) -> tuple[tuple[float, float], tuple[float, float]]:
    """Travel (lower, upper) of lift and tilt from the drawn pose: the widest tried, all dyads off their dead points."""
    best: tuple[float, tuple[tuple[float, float], tuple[float, float]]] | None = None
    for share in np.linspace(1.0, 0.2, 17):
        lift, tilt = 0.42 * share * z.lift, 0.26 * share * z.tilt
        travel = ((-0.35 * lift, 0.65 * lift), (-0.55 * tilt, 0.45 * tilt))
        try:
            worst = min(
                z.margin(z.lift + a, z.tilt + b)
                for a in np.linspace(*travel[0], steps)
                for b in np.linspace(*travel[1], steps)
            )
        except ValueError:
            continue
        if worst > margin:
            best = (worst, travel)
            break
    if best is None:
        raise ValueError("no travel without a dead point")
    return best[1]


def _body(name: str, origin: Point, mass: float, centre: Point, hull: Point) -> Body:
    size = 0.2 + 0.1 * mass ** (1.0 / 3.0)
    inertia = mass * size * size * np.diag([0.4, 0.5, 0.6])
    return Body(name, tuple(origin), mass, tuple(centre), inertia, (), hull)


def zbar_mechanism(
    z: ZBar, travel: tuple[tuple[float, float], tuple[float, float]], *, lock: float = 0.6, size: float = 1.0
) -> Mechanism:
    """The loader as a `Mechanism`, cut by the rules: driven cylinders in the tree, structural pins and the passive
    twins' rod pins cut. `travel` as from `strokes`, `lock` the steering angle at full stroke."""
    full = tuple(length(z.P, turned(z.Q, angle)) - z.steer for angle in (lock, -lock))
    radius, axle = 0.8 * size, 1.7 * size
    pitch, yaw = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)

    def at(p: Point, y: float = 0.0) -> Point:
        return np.array([p[0], y * size, p[1]])

    def plan(p: Point, left: float) -> Point:
        return np.array([p[0], left * p[1], 0.9 * size])

    bodies: list[Body] = []
    joints: list[Joint] = []

    def body(name: str, origin: Point, mass: float, *points: Point) -> None:
        hull = np.array([origin, *points])
        bodies.append(_body(name, origin, mass, hull.mean(axis=0), hull))

    def pivot(name: str, b0: str, b1: str, anchor: Point, axis: Any = pitch, **more: Any) -> None:
        joints.append(Joint(name, "revolute", b0, b1, tuple(anchor), axis, **more))

    def slide(name: str, b0: str, b1: str, p: Point, q: Point, low: float, up: float, driven: bool) -> None:
        u = (q - p) / np.linalg.norm(q - p)
        drive = Drive("position", 0.0, 0.0, 4e5, 0.2, "computed") if driven else None
        joints.append(Joint(name, "prismatic", b0, b1, tuple(p), tuple(u), low, up, drive=drive))

    body("rear_frame", np.zeros(3), 9000.0, at(point(-4.0 * size, 3.0 * size), 1.2))
    body("rear_axle", at(point(-axle, radius)), 1500.0)
    pivot(
        "axle_joint",
        "rear_frame",
        "rear_axle",
        at(point(-axle, radius)),
        (1.0, 0.0, 0.0),
        free=True,
        lower=-0.2,
        upper=0.2,
    )
    rim = np.linspace(0.0, 2.0 * math.pi, 48, endpoint=False) + 0.03
    for end, x in (("front", axle), ("rear", -axle)):
        for s, left in (("l", 1.0), ("r", -1.0)):
            centre = np.array([x, left * size, radius])
            ring = [centre + radius * np.array([math.cos(a), y, math.sin(a)]) for a in rim for y in (-0.3, 0.3)]
            body(f"{end}_wheel_{s}", centre, 700.0, *ring)
    body("front_frame", np.array([0.45 * size, 0.0, 0.9 * size]), 3000.0)
    for s, left in (("l", 1.0), ("r", -1.0)):
        p, q = plan(z.P, left), plan(z.Q, left)
        body(f"steering_barrel_{s}", p, 40.0)
        body(f"steering_rod_{s}", p, 30.0, q)
        pivot(f"steering_barrel_{s}_joint", "rear_frame", f"steering_barrel_{s}", p, yaw)
        slide(f"steering_{s}", f"steering_barrel_{s}", f"steering_rod_{s}", p, q, *full, s == "l")
        if s == "l":
            pivot("steering_rod_l_joint", "steering_rod_l", "front_frame", q, yaw)
        else:
            pivot("steering_rod_r_joint", "front_frame", "steering_rod_r", q, yaw, cut=True)
        body(f"lift_barrel_{s}", at(z.C, left * 0.5), 120.0)
        body(f"lift_rod_{s}", at(z.C, left * 0.5), 90.0, at(z.D, left * 0.5))
        pivot(f"lift_barrel_{s}_joint", "front_frame", f"lift_barrel_{s}", at(z.C, left * 0.5))
        slide(
            f"lift_{s}",
            f"lift_barrel_{s}",
            f"lift_rod_{s}",
            at(z.C, left * 0.5),
            at(z.D, left * 0.5),
            *travel[0],
            s == "l",
        )
        if s == "l":
            pivot("lift_rod_l_joint", "lift_rod_l", "boom", at(z.D, 0.5))
        else:
            pivot("lift_rod_r_joint", "boom", "lift_rod_r", at(z.D, -0.5), cut=True)
    pivot("articulation", "rear_frame", "front_frame", np.array([0.0, 0.0, 0.9 * size]), yaw, cut=True)
    for end, x, carrier in (("front", axle, "front_frame"), ("rear", -axle, "rear_axle")):
        for s, left in (("l", 1.0), ("r", -1.0)):
            drive = Drive("velocity", 0.0, 0.0, 2e4, 12.0, "template")
            pivot(
                f"{end}_wheel_{s}_joint", carrier, f"{end}_wheel_{s}", np.array([x, left * size, radius]), drive=drive
            )
    body("boom", at(z.D, 0.5), 1800.0, at(z.A), at(z.B), at(z.G))
    pivot("boom_pin", "front_frame", "boom", at(z.A), cut=True)
    body("tilt_barrel", at(z.E), 150.0)
    body("tilt_rod", at(z.E), 110.0, at(z.F))
    pivot("tilt_barrel_joint", "front_frame", "tilt_barrel", at(z.E))
    slide("tilt", "tilt_barrel", "tilt_rod", at(z.E), at(z.F), *travel[1], True)
    body("rocker", at(z.F), 300.0, at(z.G), at(z.H))
    pivot("tilt_rod_joint", "tilt_rod", "rocker", at(z.F))
    pivot("rocker_pin", "boom", "rocker", at(z.G), cut=True)
    body("link", at(z.H), 80.0, at(z.J))
    pivot("rocker_link_pin", "rocker", "link", at(z.H))
    body("bucket", at(z.J), 2200.0, at(z.B), *(at(z.T, y) for y in (-1.5, 1.5)))
    pivot("link_bucket_pin", "link", "bucket", at(z.J))
    pivot("bucket_pin", "boom", "bucket", at(z.B), cut=True)

    def cylinder(
        name: str, barrel: str, rod: str, end: str, drawn: float, low: float, up: float, passive: bool
    ) -> Cylinder:
        return Cylinder(
            name,
            barrel,
            rod,
            name,
            f"{barrel}_joint",
            end,
            0.15,
            0.09,
            up - low,
            drawn + low,
            drawn,
            3e7,
            5e5,
            3.5e5,
            0.2,
            passive=passive,
            sources={"closed_length": "sheet"},
        )

    cylinders = [
        cylinder(
            f"steering_{s}",
            f"steering_barrel_{s}",
            f"steering_rod_{s}",
            f"steering_rod_{s}_joint",
            z.steer,
            *full,
            s == "r",
        )
        for s in "lr"
    ]
    cylinders += [
        cylinder(f"lift_{s}", f"lift_barrel_{s}", f"lift_rod_{s}", f"lift_rod_{s}_joint", z.lift, *travel[0], s == "r")
        for s in "lr"
    ]
    cylinders.append(cylinder("tilt", "tilt_barrel", "tilt_rod", "tilt_rod_joint", z.tilt, *travel[1], False))
    wheels = [j.name for j in joints if "wheel" in j.name]
    x = (z.T - z.B) / length(z.T, z.B)
    return Mechanism(
        name="planar",
        equipment_type="wheel_loader",
        root="rear_frame",
        bodies=tuple(bodies),
        joints=tuple(joints),
        cylinders=tuple(cylinders),
        actuators=(
            Actuator(
                "steering",
                "cylinder",
                (ActuatorJoint("steering_l", -1), ActuatorJoint("steering_r", 1)),
                ("steering_l", "steering_r"),
            ),
            Actuator("boom", "cylinder", (ActuatorJoint("lift_l"), ActuatorJoint("lift_r")), ("lift_l", "lift_r")),
            Actuator("bucket", "cylinder", (ActuatorJoint("tilt"),), ("tilt",)),
            Actuator("drive", "motor", tuple(ActuatorJoint(w) for w in wheels)),
        ),
        loops=(
            Loop(("steering_barrel_l_joint", "steering_l", "steering_rod_l_joint", "articulation"), "articulation"),
            Loop(
                (
                    "steering_barrel_l_joint",
                    "steering_l",
                    "steering_rod_l_joint",
                    "steering_rod_r_joint",
                    "steering_r",
                    "steering_barrel_r_joint",
                ),
                "steering_rod_r_joint",
            ),
            Loop(("lift_barrel_l_joint", "lift_l", "lift_rod_l_joint", "boom_pin"), "boom_pin"),
            Loop(
                (
                    "lift_barrel_l_joint",
                    "lift_l",
                    "lift_rod_l_joint",
                    "lift_rod_r_joint",
                    "lift_r",
                    "lift_barrel_r_joint",
                ),
                "lift_rod_r_joint",
            ),
            Loop(
                (
                    "lift_barrel_l_joint",
                    "lift_l",
                    "lift_rod_l_joint",
                    "rocker_pin",
                    "tilt_rod_joint",
                    "tilt",
                    "tilt_barrel_joint",
                ),
                "rocker_pin",
            ),
            Loop(
                (
                    "lift_barrel_l_joint",
                    "lift_l",
                    "lift_rod_l_joint",
                    "bucket_pin",
                    "link_bucket_pin",
                    "rocker_link_pin",
                    "tilt_rod_joint",
                    "tilt",
                    "tilt_barrel_joint",
                ),
                "bucket_pin",
            ),
        ),
        sites=(
            Site("hinge", "bucket", tuple(at(z.B)), (x[0], 0.0, x[1])),
            Site("edge", "bucket", tuple(at(z.T)), (x[0], 0.0, x[1])),
        ),
    )


def with_measurements(m: Mechanism, templates: list[MeasurementTemplate], values: dict[str, float]) -> Mechanism:
    """The mechanism carrying measurements and the specification values they are compared with."""
    known = {k: {"value": v, "unit": "m", "status": "ok"} for k, v in values.items()}
    return replace(m, measurements=tuple(templates), specifications=known)
