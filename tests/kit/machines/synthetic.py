"""Parametric wheel loaders straight as `Assembly` objects, with the truth: simplified, honest in what aligning needs.

Every dimension is drawn from a seed. Pins sit in bores, plates touch along their welds, cylinders are barrel, cap,
gland, piston, rod and eyes, the steering stands at an angle, the rear axle may be rolled, some things float (glass).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from kit.machines.solids import Array, around, bolt, box, lathe, place, plate, tube
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Shape

X, Y, Z = np.eye(3)
XZ = (0.0, -1.0, 0.0)
"""Normal of a plate whose local x, y are machine X, Z."""


@dataclass
class Machine:
    """Parts as they are drawn, and what they are: id → (role, body)."""

    twin: bool
    title: str = "LOADER"
    parts: list[Part] = field(default_factory=list)
    shapes: dict[str, Shape] = field(default_factory=dict)
    truth: dict[str, tuple[str, str]] = field(default_factory=dict)
    pose: Array = field(default_factory=lambda: np.eye(4))
    frame: Array = field(default_factory=lambda: np.eye(4))
    """CAD → machine, as it should come out."""
    mixed: dict[str, tuple[tuple[str, str, int], ...]] = field(default_factory=dict)
    """Of a part that joins several bodies: (role, body, how many triangles), in the order of its triangles."""

    def add(self, name: str, role: str, body: str, shape: Shape, transform: Array) -> None:
        key = shape.key
        if key in self.shapes and self.shapes[key] is not shape:
            key = f"{key}~{len(self.shapes)}"
        self.shapes[key] = shape
        part_id = f"{self.title}/{body}/{name}#{len(self.parts)}"
        self.parts.append(Part(part_id, name, (self.title, body), key, self.pose @ transform))
        self.truth[part_id] = (role, body)

    def assembly(self) -> Assembly:
        return Assembly(self.title.lower(), "synthetic", 0.001, tuple(self.parts), dict(self.shapes))


def turn_z(angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    matrix = np.eye(4)
    matrix[:2, :2] = [[c, -s], [s, c]]
    return matrix


def turn_about_x(point: Array, angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    matrix = np.eye(4)
    matrix[1:3, 1:3] = [[c, -s], [s, c]]
    matrix[:3, 3] = point - matrix[:3, :3] @ point
    return matrix


def polar(r: float, angle: float) -> Array:
    return np.array([r * math.cos(angle), r * math.sin(angle)])


def meet(p: Array, rp: float, q: Array, rq: float, side: float) -> Array:
    d = float(np.hypot(*(q - p)))
    along = (d * d + rp * rp - rq * rq) / (2 * d)
    square = rp * rp - along * along
    if square < 0.02 * rp * rp:
        raise ValueError("the bucket link does not reach")
    u = (q - p) / d
    return np.asarray(p + along * u + side * math.sqrt(square) * np.array([-u[1], u[0]]))


def away(q: Array, a: Array, b: Array) -> float:
    """Distance of a point from a segment."""
    along = np.clip((q - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
    return float(np.linalg.norm(q - a - along * (b - a)))


class Drawer:
    """One machine from one generator of random numbers."""

    def __init__(
        self, seed: int, *, twin: bool | None, steered: bool, embedded: bool, stop: bool, hoses: int, links: int = 1
    ) -> None:
        self.rng = np.random.default_rng(seed)
        self.m = Machine(bool(self.rng.random() < 0.7) if twin is None else twin)
        u = self.rng.uniform
        self.s = s = float(u(0.7, 1.25))
        self.t = 0.04 * s
        self.pin_r = 0.045 * s * u(0.85, 1.2)
        self.wheelbase = 3.45 * s * u(0.92, 1.1)
        self.tyre_r = 0.875 * s * u(0.9, 1.1)
        self.tyre_w = 0.62 * s * u(0.85, 1.1)
        self.tread = 2.35 * s * u(0.93, 1.08)
        self.steer = float(u(-0.5, 0.5)) if steered else 0.0
        self.roll = float(u(-0.12, 0.12)) if self.rng.random() < 0.4 else 0.0
        self.clearance = float(self.rng.choice([0.0, 0.0002, 0.0008])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.004])) * s
        self.bushes = bool(self.rng.random() < 0.6)
        self.e = 0.004 * s if embedded else 0.0
        self.stop, self.hoses, self.links = stop, hoses, links
        self.link_pins()

    # ---- planar linkage ----
    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        for _ in range(2000):
            k = lambda v: v * s * u(0.94, 1.06)  # noqa: E731
            beta = float(u(-0.5, 0.35))
            rocker = float(u(1.1, 1.9))
            A = np.array([k(0.80), k(2.118)])
            C = np.array([k(0.665), k(1.35)])
            E = np.array([k(1.0), A[1] - k(0.30)])
            self.M = A + polar(k(1.75), beta)
            B = A + polar(k(2.65), beta)
            D = A + polar(k(1.25), beta - 0.12 * u(0.8, 1.3))
            G = A + polar(k(1.96), beta + 0.17 * u(0.9, 1.2))
            F = G + polar(k(0.72), rocker)
            H = G + polar(k(0.64), rocker + 3.0)
            try:
                J = meet(H, k(0.55), B, k(0.43), 1.0)
            except ValueError:
                continue
            if (
                np.hypot(*(F - E)) < 1.2 * s
                or np.hypot(*(F - E)) > 2.2 * s
                or abs(np.linalg.det([F - E, G - F])) < 0.2 * s * s
            ):
                continue
            if np.hypot(*(J - G)) < 0.2 * s or J[1] < B[1] - 0.3 * s:
                continue
            self.P = dict(zip("ABCDEFGHJ", (A, B, C, D, E, F, G, H, J), strict=True))
            local = math.atan2(*(J - B)[::-1]) - math.atan2(0.43, -0.045)
            self.bucket_angle = (local + math.pi) % (2 * math.pi) - math.pi
            if self.clashes():
                continue
            return
        raise RuntimeError("no linkage for this seed")

    def clashes(self) -> bool:
        """Whether the rocker or the link runs into the boom's cross tube or the bucket's back."""
        F, G, H, J, B = (self.P[k] for k in "FGHJB")
        room = 0.11 * self.s + 2.2 * self.pin_r
        near_tube = min(away(self.M, G, H), away(self.M, H, J), away(self.M, F, G)) < room
        c, n = math.cos(self.bucket_angle), math.sin(self.bucket_angle)
        ahead = [c * (q - B)[0] + n * (q - B)[1] for q in (F, G, H, self.M)]
        return near_tube or max(ahead) > 0.28 * self.s - room

    # ---- pieces ----
    def at(self, pin: str, y: float) -> Array:
        return np.array([self.P[pin][0], y, self.P[pin][1]])

    def side_plate(
        self,
        name: str,
        body: str,
        y: float,
        outline: Array,
        pins: str,
        holes: list[tuple[float, float, float]] | None = None,
        thickness: float | None = None,
    ) -> None:
        bores = [(*map(float, self.P[p]), self.bore_r) for p in pins] + (holes or [])
        self.m.add(
            name, body, body, plate(f"{name}_{y:.3f}", outline, thickness or self.t, bores), place((0, y, 0), XZ, X)
        )

    @property
    def bore_r(self) -> float:
        return self.pin_r + self.clearance

    def pin(
        self, role: str, body: str, start: Array, end: Array, *, kept_by: float = 0.0, radius: float | None = None
    ) -> None:
        r = radius or self.pin_r
        axis = end - start
        length = float(np.linalg.norm(axis))
        head = self.rng.random() < 0.3
        profile = [(0.0, 0.0), (r, 0.0), (r, length), (0.0, length)]
        if head:
            profile = [
                (0.0, 0.0),
                (r, 0.0),
                (r, length),
                (1.5 * r, length),
                (1.5 * r, length + 0.3 * r),
                (0.0, length + 0.3 * r),
            ]
        self.m.add(role, role, body, lathe(f"{role}_{length:.4f}_{head}_{r:.4f}", profile), place(start, axis))
        if kept_by:
            keeper = plate(
                f"keeper_{role}", around((0, 0, 0.9 * r), (2.2 * r, 0, 0.9 * r)), 0.25 * r, [(2.2 * r, 0, 0.25 * r)]
            )
            direction = -axis / length
            self.m.add("keeper", body, body, keeper, place(start + direction * 0.125 * r, direction))

    def bush(self, body: str, centre: Array, axis: Array, length: float) -> float:
        """A bush in a bore; its outer radius."""
        r = self.bore_r
        self.m.add(
            "bush",
            body,
            body,
            tube(f"bush_{length:.4f}_{r:.5f}", 1.2 * r, r, length),
            place(centre - axis * length / 2, axis),
        )
        return 1.2 * r

    def cylinder(
        self,
        name: str,
        barrel: str,
        rod: str,
        P: Array,
        Q: Array,
        across: Array,
        bore: float,
        *,
        roles: bool = True,
        longest: float | None = None,
        ways: tuple[float, float] | None = None,
    ) -> None:
        """Barrel with its eye at P, rod with its eye at Q, pins along `across`. The piston stands so near to the mouth
        that it reaches little further than the `longest` length; or the barrel is so long that it goes about so far in
        and out (`ways`)."""
        self.m.pose, kept = np.eye(4), self.m.pose
        length = float(np.linalg.norm(Q - P))
        d = (Q - P) / length
        rod_r, wall, eye = 0.55 * bore, 0.2 * bore, 1.8 * self.pin_r
        width = self.eye_w
        out = float(self.rng.uniform(0.2, 0.45)) * length
        tube_start, tube_end = eye, length - out - eye
        if ways is not None:
            tube_end = tube_start + 3.0 * bore + sum(ways)
        mouth = tube_end
        hole = self.bore_r
        outer = bore + wall
        eye_plate = plate(f"{name}_eye", around((0, 0, eye), (eye, eye, 0), (eye, -eye, 0)), width, [(0, 0, hole)])
        cap = 0.3 * bore
        if self.rng.random() < 0.5:
            self.m.add(
                f"{name} barrel",
                barrel,
                barrel,
                tube(f"{name}_tube", outer, bore, tube_end - tube_start - cap),
                place(P + d * (tube_start + cap), d),
            )
            self.m.add(
                f"{name} cap", barrel, barrel, tube(f"{name}_cap", outer, 0.0, cap), place(P + d * tube_start, d)
            )
        else:
            n = tube_end - tube_start
            shape = lathe(f"{name}_can", [(0, 0), (outer, 0), (outer, n), (bore, n), (bore, cap), (0, cap)])
            self.m.add(f"{name} barrel", barrel, barrel, shape, place(P + d * tube_start, d))
        self.m.add(f"{name} rear eye", barrel, barrel, eye_plate, place(P, across, d))
        gland = lathe(
            f"{name}_gland",
            [(rod_r, -bore), (bore, -bore), (bore, 0), (outer, 0), (outer, 0.3 * bore), (rod_r, 0.3 * bore)],
        )
        self.m.add(f"{name} gland", barrel, barrel, gland, place(P + d * mouth, d))
        inside = tube_start + cap + (tube_end - tube_start - cap) * float(self.rng.uniform(0.3, 0.7))
        if longest is not None:
            inside = max(inside, mouth - 1.8 * bore - max(0.0, longest - length))
        if ways is not None:
            inside = tube_start + cap + 0.45 * bore + ways[0]
        end = length - eye
        self.m.add(f"{name} rod", rod, rod, tube(f"{name}_rod", rod_r, 0.0, end - inside), place(P + d * inside, d))
        if self.rng.random() < 0.5:
            piston = tube(f"{name}_piston", bore, rod_r, 0.8 * bore)
            self.m.add(f"{name} piston", rod, rod, piston, place(P + d * inside, d))
        else:
            thick, behind = (0.6, 0.6) if ways is None else (0.8, 0.0)
            piston = tube(f"{name}_piston", bore, 0.0, thick * bore)
            self.m.add(f"{name} piston", rod, rod, piston, place(P + d * (inside - behind * bore), d))
        self.m.add(f"{name} rod eye", rod, rod, eye_plate, place(Q, across, -d))
        if self.rng.random() < 0.3:
            port = tube(f"{name}_port", 0.2 * bore, 0.1 * bore, 0.2 * bore)
            self.m.add(
                "port", barrel, barrel, port, place(P + d * (tube_start + 2 * cap) + across * (outer - 0.001), across)
            )
        self.m.pose = kept

    def block(self, name: str, body: str, low: tuple[float, float, float], high: tuple[float, float, float]) -> None:
        """An axis-parallel block between two corners, in machine sizes."""
        a, b = self.s * np.array(low), self.s * np.array(high)
        x, y, z = b - a
        self.m.add(name, body, body, box(f"{name}_{x:.4f}_{y:.4f}_{z:.4f}", x, y, z), place(0.5 * (a + b), Z, X))

    def across(self, role: str, body: str, at: Array, side: int, start: float, end: float) -> None:
        """A pin along y on one side."""
        low, high = sorted((side * start, side * end))
        self.pin(role, body, np.array([at[0], low, at[1]]), np.array([at[0], high, at[1]]))

    def stub(self, wheel: str, body: str, side: int, x: float, face: float, scale: float = 1.0) -> None:
        """An axle's half on a face: a square flange, a tube, and the wheel that turns on its end."""
        s, m, out = scale * self.s, self.m, side * Y
        reach, thick = self.tread / 2 - 0.22 * s, 0.03 * s
        centre = np.array([x, 0.0, self.tyre_r])
        flange = box("flange", 0.22 * s, 0.22 * s, thick)
        m.add("axle flange", body, body, flange, place(centre + (face + thick / 2) * out, out, X))
        start = face + thick - self.e
        housing = tube("axle_tube", 0.08 * s, 0.03 * s, reach - start)
        m.add("axle tube", body, body, housing, place(centre + start * out, out))
        self.wheel(wheel, body, side, centre + self.tread / 2 * out, reach)

    # ---- groups ----
    def draw(self) -> Machine:
        self.eye_w = 0.22 * self.s
        self.yb = 0.55 * self.s
        self.front = turn_z(self.steer)
        self.m.pose = np.eye(4)
        self.rear_frame()
        self.rear_axle()
        self.m.pose = self.front
        self.front_frame()
        self.boom()
        self.rocker_and_link()
        self.bucket()
        self.lift()
        self.articulation()
        self.steering()
        self.lay_hoses()
        return self.m

    def lay_hoses(self) -> None:
        """Straight hoses from anywhere on one body to anywhere on another, a bit into both; they belong to neither."""
        assembly = self.m.assembly()
        points = {p.id: assembly.points_of(p) for p in self.m.parts}
        bodies = sorted({body for _, body in self.m.truth.values() if "wheel" not in body})
        self.m.pose = np.eye(4)
        for k in range(self.hoses):
            ends = []
            for body in self.rng.choice(bodies, size=2, replace=False):
                own = [i for i, (_, b) in self.m.truth.items() if b == body]
                cloud = points[own[int(self.rng.integers(len(own)))]]
                ends.append(cloud[int(self.rng.integers(len(cloud)))])
            d = ends[1] - ends[0]
            length = float(np.linalg.norm(d))
            shape = tube(f"hose{k}", 0.012 * self.s, 0.008 * self.s, length + 0.04 * self.s)
            self.m.add("hose", "", "", shape, place(ends[0] - 0.02 * self.s * d / length, d))

    def rear_frame(self) -> None:
        e = self.e
        m, s, t, L, body = self.m, self.s, self.t, self.wheelbase / 2, "rear_frame"
        self.x_rear, self.x_front = -0.32 * s, 0.34 * s
        self.z_mid = self.tyre_r + 0.5 * s
        low, high = self.z_mid - 0.25 * s, self.z_mid + 0.25 * s
        back = -L - 1.3 * s
        for side in (1, -1):
            outline = np.array([[back, low], [self.x_rear - t, low], [self.x_rear - t, high], [back, high]])
            self.side_plate("rail", body, side * 0.4 * s, outline, "")
        m.add(
            "cross plate",
            body,
            body,
            box("cross", t, 0.84 * s, 0.75 * s),
            place((self.x_rear - t / 2, 0, self.z_mid), Z, X),
        )
        m.add(
            "deck",
            body,
            body,
            box("deck", 1.2 * s, 0.84 * s, t, [(-0.5 * s, 0.3 * s, 0.01 * s), (-0.5 * s, -0.3 * s, 0.01 * s)]),
            place((self.x_rear - t - 0.6 * s, 0, high + t / 2), Z, X),
        )
        m.add(
            "counterweight",
            body,
            body,
            box("weight", 0.5 * s, 1.8 * s, 0.9 * s),
            place((back - 0.25 * s, 0, self.z_mid), Z, X),
        )
        m.add(
            "engine",
            body,
            body,
            box("engine", 1.0 * s, 0.5 * s, 0.6 * s),
            place((back + 0.7 * s, 0, self.z_mid + 0.1 * s), Z, X),
        )
        m.add(
            "mount",
            body,
            body,
            box("mount", 0.3 * s, 0.8 * s - t, t),
            place((back + 0.7 * s, 0, self.z_mid - 0.2 * s - t / 2), Z, X),
        )
        m.add(
            "hood",
            body,
            body,
            box("hood", 1.4 * s, 1.2 * s, 0.4 * s),
            place((back + 0.75 * s, 0, high + 0.2 * s), Z, X),
        )
        m.add(
            "cab",
            body,
            body,
            box("cab", 0.9 * s, 0.9 * s, 1.3 * s),
            place((self.x_rear - t - 0.5 * s, 0, high + t + 0.65 * s), Z, X),
        )
        for side in (1, -1):
            m.add(
                "glass",
                body,
                body,
                box("glass", 0.7 * s, 0.8 * s, 0.006 * s),
                place((self.x_rear - t - 0.5 * s, side * 0.456 * s, high + t + 0.7 * s), Y, X),
            )
            m.add(
                "step",
                body,
                body,
                box("step", 0.4 * s, 0.2 * s, 0.02 * s),
                place((self.x_rear - 0.6 * s, side * 0.55 * s, low), Z, X),
            )
            for k in range(4):
                m.add(
                    "M24x80",
                    body,
                    body,
                    bolt("weight_bolt", 0.012 * s, 0.06 * s),
                    place((back - 0.5 * s, side * 0.3 * s, self.z_mid + (k - 1.5) * 0.2 * s), -X),
                )
        for side in (0.3, -0.3):
            m.add(
                "M20",
                body,
                body,
                bolt("deck_bolt", 0.01 * s, 0.05 * s),
                place((self.x_rear - t - 1.1 * s, side * s, high + t), Z),
            )
        # articulation lugs
        self.z_up, self.z_low = self.z_mid + 0.2 * s, self.z_mid - 0.2 * s
        self.art_r = 1.3 * self.pin_r
        hole = self.art_r * (1.2 if self.bushes else 1.0)
        outline = around((0, 0, 2 * self.art_r), (self.x_rear - e, 0.25 * s, 0), (self.x_rear - e, -0.25 * s, 0))
        for z in (self.z_up, self.z_low):
            m.add("hitch plate", body, body, plate("hitch", outline, t, [(0, 0, hole)]), place((0, 0, z), Z, X))
            if self.bushes:
                m.add("bush", body, body, tube("art_bush", hole, self.art_r, t), place((0, 0, z - t / 2), Z))
        if self.stop:
            gap = self.x_front - self.x_rear
            m.add(
                "stop",
                body,
                body,
                box("stop", gap, 0.06 * s, 0.08 * s),
                place((self.x_rear + gap / 2, 0.3 * s, self.z_mid + 0.3 * s), Z, X),
            )
        # steering brackets
        self.SP = {side: np.array([self.x_rear - 0.5 * s, side * 0.62 * s, self.z_mid]) for side in (1, -1)}
        for side in (1, -1):
            p = self.SP[side]
            rail = side * (0.4 * s + t / 2 - e)
            outline = around((p[0], p[1], 1.8 * self.pin_r), (p[0] - 0.15 * s, rail, 0), (p[0] + 0.15 * s, rail, 0))
            for dz in (1, -1):
                z = self.z_mid + dz * (self.eye_w / 2 + self.gap + t / 4)
                m.add(
                    "steering lug",
                    body,
                    body,
                    plate(f"slug{side}", outline, t / 2, [(p[0], p[1], self.bore_r)]),
                    place((0, 0, z), Z, X),
                )

    def wheel(self, body: str, axle: str, side: int, centre: Array, tube_end: float) -> None:
        m, s, r, w = self.m, self.s, self.tyre_r, self.tyre_w
        out = side * Y
        rim_r, hub_r = 0.5 * r, 0.25 * r
        tyre = lathe("tyre", [(rim_r, -w / 2), (r, -w / 2), (r, w / 2), (rim_r, w / 2)])
        m.add("tyre", body.replace("wheel", "tyre"), body, tyre, place(centre, out))
        rim = lathe(
            "rim",
            [
                (hub_r, -0.05 * s),
                (0.9 * rim_r, -0.05 * s),
                (0.9 * rim_r, -w / 2),
                (rim_r, -w / 2),
                (rim_r, w / 2),
                (0.9 * rim_r, w / 2),
                (0.9 * rim_r, 0.0),
                (hub_r, 0.0),
            ],
        )
        m.add("rim", body, body, rim, place(centre, out))
        start = tube_end - self.tread / 2
        hub = lathe(
            "hub",
            [
                (0, start),
                (0.8 * hub_r, start),
                (hub_r * 0.8, -0.1 * s),
                (1.5 * hub_r, -0.1 * s),
                (1.5 * hub_r, -0.05 * s),
                (hub_r, -0.05 * s),
                (hub_r, 0.02 * s),
                (0, 0.02 * s),
            ],
        )
        m.add("hub", body, body, hub, place(centre, out))
        for k in range(6):
            a = 2 * math.pi * k / 6
            offset = 1.25 * hub_r * np.array([math.cos(a), 0, math.sin(a)])
            m.add(
                "wheel bolt",
                body,
                body,
                bolt("wheel_bolt", 0.012 * s, 0.05 * s + 0.05 * s),
                place(centre + offset, out),
            )

    def axle(self, body: str, centre: Array, wheel: str) -> None:
        m, s = self.m, self.s
        reach = self.tread / 2 - 0.22 * s
        for side, letter in ((1, "l"), (-1, "r")):
            m.add(
                "axle tube",
                body,
                body,
                tube("axle_tube", 0.14 * s, 0.06 * s, reach - 0.25 * s),
                place(centre + side * 0.25 * s * Y, side * Y),
            )
            if self.shafts:
                m.add(
                    "half shaft",
                    body,
                    body,
                    tube("half_shaft", 0.035 * s, 0, reach - 0.3 * s),
                    place(centre + side * 0.27 * s * Y, side * Y),
                )
            self.wheel(f"{wheel}_{letter}", body, side, centre + side * self.tread / 2 * Y, reach)

    def rear_axle(self) -> None:
        m, s, t, e = self.m, self.s, self.t, self.e
        self.shafts = bool(self.rng.random() < 0.4)
        centre = np.array([-self.wheelbase / 2, 0, self.tyre_r])
        r = 1.2 * self.pin_r
        pivot = centre + 0.0 * Z
        # hanger plates under the rails' cross members
        low = self.z_mid - 0.25 * s
        across = box("hanger_beam", 0.12 * s, 0.8 * s - t, t)
        for sx in (1, -1):
            x = centre[0] + sx * 0.26 * s
            m.add("beam", "rear_frame", "rear_frame", across, place((x, 0, low + t / 2), Z, X))
            outline = around((0, pivot[2], 2 * r), (0.2 * s, low + e, 0), (-0.2 * s, low + e, 0))
            m.add(
                "hanger",
                "rear_frame",
                "rear_frame",
                plate("hanger", outline, t, [(0, pivot[2], r)]),
                place((x, 0, 0), X, Y),
            )
        m.pose = turn_about_x(pivot, self.roll)
        m.add(
            "axle box",
            "rear_axle",
            "rear_axle",
            box("axle_box", 0.46 * s - 2 * t, 0.5 * s, 0.4 * s),
            place(centre, Z, X),
        )
        for sx in (1, -1):
            x0 = centre[0] + sx * (0.23 * s - t)
            trunnion = plate(
                "trunnion",
                around(
                    (0, 0, 2 * r),
                    (0.15 * s, 0.15 * s, 0),
                    (-0.15 * s, 0.15 * s, 0),
                    (-0.15 * s, -0.15 * s, 0),
                    (0.15 * s, -0.15 * s, 0),
                ),
                t,
                [(0, 0, r)],
            )
            m.add("trunnion", "rear_axle", "rear_axle", trunnion, place((x0 + sx * 0.5 * t, 0, pivot[2]), X, Y))
        self.axle("rear_axle", centre, "rear_wheel")
        m.pose = np.eye(4)
        for sx in (1, -1):
            end = centre[0] + sx * (0.26 * s + t)
            start = centre[0] + sx * (0.23 * s - t)
            self.pin(
                "rear_axle_pin", "rear_frame", np.array([start, 0, pivot[2]]), np.array([end, 0, pivot[2]]), radius=r
            )

    def front_frame(self) -> None:
        e = self.e
        m, s, t, body = self.m, self.s, self.t, "front_frame"
        A, C, E = self.P["A"], self.P["C"], self.P["E"]
        low = self.tyre_r + 0.02 * s
        m.add(
            "back plate",
            body,
            body,
            box("back", t, 1.4 * s, self.z_mid + 0.45 * s - low),
            place((self.x_front + t / 2, 0, (self.z_mid + 0.45 * s + low) / 2), Z, X),
        )
        x0, x1 = self.x_front + t, 1.45 * s
        m.add(
            "floor",
            body,
            body,
            box(
                "floor", x1 - x0, 1.3 * s, t, [(dx * s, dy * s, 0.012 * s) for dx in (0.15, 0.35) for dy in (0.2, -0.2)]
            ),
            place(((x0 + x1) / 2, 0, low + t / 2), Z, X),
        )
        self.y_out, self.y_in = self.yb + t / 2 + self.gap + t / 2, self.yb - t / 2 - self.gap - t / 2
        corner = [(x0 - e, low + t - e, 0.0), (x1 - 0.3 * s, low + t - e, 0.0), (x0 - e, self.z_mid + 0.4 * s, 0.0)]
        self.y_lift = self.y_in - t / 2 - self.gap - self.eye_w / 2 if self.m.twin else 0.0
        for side in (1, -1):
            self.side_plate("tower out", body, side * self.y_out, around((*A, 2 * self.pin_r), *corner), "A")
            pins = "AC" if self.m.twin else "A"
            circles = [(*A, 2 * self.pin_r)] + ([(*C, 2 * self.pin_r)] if self.m.twin else [])
            self.side_plate("tower in", body, side * self.y_in, around(*circles, *corner), pins)
            self.pin(
                "boom_pin",
                body,
                self.at("A", side * (self.y_out + t)),
                self.at("A", side * (self.y_in - t / 2)),
                kept_by=0.0,
            )
            if self.m.twin:
                y = side * (self.y_lift - self.eye_w / 2 - self.gap - t / 2)
                self.side_plate(
                    "lift lug",
                    body,
                    y,
                    around(
                        (*C, 2 * self.pin_r),
                        (x0 - e, C[1] - 0.2 * s, 0),
                        (x0 + 0.3 * s, low + t - e, 0),
                        (x0 - e, low + t - e, 0),
                    ),
                    "C",
                )
        # centre plates of the tilt cylinder (and of a single lift cylinder)
        for y, thickness in self.tilt_forks:
            circles = [(*E, 2 * self.pin_r)] + ([] if self.m.twin else [(*C, 2 * self.pin_r)])
            self.side_plate(
                "tilt lug",
                body,
                y,
                around(*circles, (x0 - e, low + t - e, 0), (x0 + 0.4 * s, low + t - e, 0)),
                "E" if self.m.twin else "EC",
                thickness=thickness,
            )
        # a fender that floats, a bracket that touches
        for side in (1, -1):
            m.add(
                "fender",
                body,
                body,
                box("fender", 0.6 * s, 0.1 * s, 0.02 * s),
                place((0.75 * s, side * (0.7 * s + 0.003 * s), low + 0.5 * t), Z, X),
            )
        # axle bolted from below
        centre = np.array([self.wheelbase / 2, 0, self.tyre_r])
        h = low - self.tyre_r + 0.2 * s
        cx = (x0 + x1) / 2 + 0.25 * s - centre[0]
        holes = [(cx + dx * s, dy * s, 0.012 * s) for dx in (-0.1, 0.1) for dy in (0.2, -0.2)]
        m.add(
            "axle housing",
            body,
            body,
            box("front_axle", 0.5 * s, 0.5 * s, h, holes),
            place((centre[0], 0, low - h / 2), Z, X),
        )
        for dx, dy, _ in holes:
            m.add("M24", body, body, bolt("axle_bolt", 0.012 * s, t + 0.1 * s), place((centre[0] + dx, dy, low + t), Z))
        self.axle("front_axle_dummy", centre, "front_wheel")
        for part_id, (_role, owner) in list(m.truth.items()):
            if owner == "front_axle_dummy":
                m.truth[part_id] = (body, body)

    def articulation(self) -> None:
        e = self.e
        m, s, t, body = self.m, self.s, self.t, "front_frame"
        outline = around((0, 0, 2 * self.art_r), (self.x_front + e, 0.25 * s, 0), (self.x_front + e, -0.25 * s, 0))
        for z in (self.z_up, self.z_low):
            for dz in (1, -1):
                m.add(
                    "hinge plate",
                    body,
                    body,
                    plate("hinge", outline, t, [(0, 0, self.art_r)]),
                    place((0, 0, z + dz * (t + self.gap)), Z, X),
                )
            h = 1.5 * t + self.gap
            self.pin(
                "rear_front_pin",
                "rear_frame",
                np.array([0, 0, z - h]),
                np.array([0, 0, z + h + 0.1 * t]),
                radius=self.art_r,
            )

    def steering(self) -> None:
        m, s, t, e = self.m, self.s, self.t, self.e
        for side, letter in ((1, "l"), (-1, "r")):
            q = np.array([self.x_front - 0.16 * s, side * 0.62 * s, self.z_mid])
            outline = around(
                (q[0], q[1], 1.8 * self.pin_r),
                (self.x_front + e, q[1] + 0.08 * s, 0),
                (self.x_front + e, q[1] - 0.1 * s, 0),
            )
            m.pose = self.front
            for dz in (1, -1):
                z = self.z_mid + dz * (self.eye_w / 2 + self.gap + t / 4)
                m.add(
                    "steering lug",
                    "front_frame",
                    "front_frame",
                    plate(f"flug{side}", outline, t / 2, [(q[0], q[1], self.bore_r)]),
                    place((0, 0, z), Z, X),
                )
            half = self.eye_w / 2 + self.gap + 0.6 * t
            rod, barrel = f"steering_piston_rod_{letter}", f"steering_cylinder_barrel_{letter}"
            self.pin(f"{rod}_pin", "front_frame", q - half * Z, q + half * Z)
            Q = (self.front @ np.array([*q, 1]))[:3]
            m.pose = np.eye(4)
            P = self.SP[side]
            self.pin(f"{barrel}_pin", "rear_frame", P - half * Z, P + half * Z)
            self.cylinder(f"steer {letter}", barrel, rod, P, Q, Z, 0.028 * s)

    def boom(self) -> None:
        e = self.e
        m, s, t, body = self.m, self.s, self.t, "boom"
        A, B, D, G, M = (*(self.P[k] for k in "ABDG"), self.M)
        r = 0.11 * s
        wide = 2.4 * self.pin_r
        for side in (1, -1):
            outline = around((*A, wide), (*B, wide), (*M, 1.6 * r), (*D, wide))
            self.side_plate("arm plate", body, side * self.yb, outline, "ABD" if self.m.twin else "AB", thickness=t)
        half = self.yb - t / 2 + e
        m.add("cross tube", body, body, tube("cross_tube", r, 0.8 * r, 2 * half), place((M[0], -half, M[1]), Y))
        for side in (1, -1):
            y = side * (self.y_rocker + t + self.gap)
            outline = (
                around((*M, 1.3 * r), (*G, 2 * self.pin_r))
                if self.m.twin
                else around((*M, 1.3 * r), (*G, 2 * self.pin_r), (*D, 2 * self.pin_r))
            )
            self.side_plate("rocker lug", body, y, outline, "G" if self.m.twin else "GD", [(*map(float, M), r)])

    @property
    def y_rocker(self) -> float:
        return self.eye_w / 2 + self.gap + self.t / 2

    @property
    def tilt_forks(self) -> list[tuple[float, float]]:
        """Where across the machine the plates of the tilt linkage stand that hold an eye between them; their
        thickness."""
        return [(side * self.y_rocker, self.t) for side in (1, -1)]

    @property
    def y_link_ear(self) -> float:
        """Where the bucket's ears of its link stand."""
        return self.eye_w / 2 + self.gap + self.t / 2 + (self.links - 1) * (self.t + self.gap)

    def rocker_and_link(self) -> None:
        m, t, w = self.m, self.t, self.eye_w
        F, G, H, J = (self.P[k] for k in "FGHJ")
        y, r = self.y_rocker, 2 * self.pin_r
        for side in (1, -1):
            self.side_plate("lever", "rocker", side * y, around((*F, r), (*G, 1.3 * r), (*H, r)), "FGH")
        inner = y - t / 2
        m.add(
            "hub",
            "rocker",
            "rocker",
            tube("rocker_hub", 1.5 * self.bore_r, self.bore_r, 2 * inner),
            place(self.at("G", -inner), Y),
        )
        out = y + t / 2
        self.pin("bucket_piston_rod_pin", "bucket_piston_rod", self.at("F", -out), self.at("F", out))
        wide = out + t + self.gap
        self.pin("rocker_pin", "rocker", self.at("G", -wide), self.at("G", wide))
        if self.links == 2:
            # Outside the rocker and the boom's lugs.
            y_link = y + 2 * (t + self.gap)
            out = y_link + t / 2
            for side in (1, -1):
                outline = around((*H, 1.7 * self.pin_r), (*J, 1.7 * self.pin_r))
                self.side_plate("link", "bucket_link", side * y_link, outline, "HJ")
        else:
            outline = around((*H, 1.7 * self.pin_r), (*J, 1.7 * self.pin_r))
            self.side_plate("link", "bucket_link", 0.0, outline, "HJ", thickness=w)
        self.pin("bucket_link_pin", "bucket_link", self.at("H", -out), self.at("H", out))

    def bucket(self) -> None:
        e = self.e
        m, s, t, body = self.m, self.s, self.t, "bucket"
        B, J = self.P["B"], self.P["J"]
        c, n = math.cos(self.bucket_angle), math.sin(self.bucket_angle)
        local = np.eye(4)
        local[[0, 0, 2, 2], [0, 2, 0, 2]] = [c, -n, n, c]
        local[0, 3], local[2, 3] = B
        back, width = 0.28 * s, 2.9 * s

        def put(name: str, shape: Shape, matrix: Array, role: str = body) -> None:
            m.add(name, role, body, shape, local @ matrix)

        put("back", box("bucket_back", t, width, 1.1 * s), place((back + t / 2, 0, 0.25 * s), Z, X))
        put("bottom", box("bucket_floor", 1.0 * s, width, t), place((back + t + 0.5 * s, 0, -0.3 * s + t / 2), Z, X))
        for side in (1, -1):
            outline = np.array(
                [[back + t - e, -0.3 * s + t - e], [back + t + 0.95 * s, -0.3 * s + t - e], [back + t - e, 0.8 * s]]
            )
            put("side", plate("bucket_side", outline, t), place((0, side * (width / 2 - t / 2), 0), XZ, X))
        put(
            "edge",
            box("edge", 0.2 * s, width, 0.8 * t),
            place((back + t + 1.1 * s, 0, -0.3 * s + t / 2), Z, X),
            "cutting_edge",
        )
        for k in range(6):
            put(
                "tooth",
                box("tooth", 0.15 * s, 0.06 * s, 0.05 * s),
                place((back + t + 1.2 * s + 0.075 * s, (k - 2.5) * 0.45 * s, -0.3 * s + t / 2), Z, X),
            )
        for side in (1, -1):
            for d in (1, -1):
                y = side * self.yb + d * (t + self.gap)
                outline = around((0, 0, 2 * self.pin_r), (back + e, -0.2 * s, 0), (back + e, 0.25 * s, 0))
                put("ear", plate("ear", outline, t, [(0, 0, self.bore_r)]), place((0, y, 0), XZ, X))
            wide = 1.5 * t + self.gap
            self.pin("bucket_pin", body, self.at("B", side * (self.yb + wide)), self.at("B", side * (self.yb - wide)))
        jl = np.linalg.inv(local) @ np.array([J[0], 0, J[1], 1])
        beside = self.y_link_ear
        for d in (1, -1):
            outline = around((jl[0], jl[2], 2 * self.pin_r), (back + e, 0.2 * s, 0), (back + e, 0.6 * s, 0))
            put(
                "link ear",
                plate("link_ear", outline, t, [(jl[0], jl[2], self.bore_r)]),
                place((0, d * beside, 0), XZ, X),
            )
        half = beside + t / 2 + (self.links - 1) * (t + self.gap)
        self.pin("bucket_link_bucket_pin", body, self.at("J", -half), self.at("J", half))

    def as_steered(self, p: Array) -> Array:
        """A point of the front half where the steering has turned it."""
        return np.asarray((self.front @ np.array([*p, 1]))[:3])

    def tilt(self) -> None:
        E, F = self.as_steered(self.at("E", 0)), self.as_steered(self.at("F", 0))
        across, out = self.front[:3, 1], self.eye_w / 2 + self.gap + self.t
        self.cylinder("tilt", "bucket_cylinder_barrel", "bucket_piston_rod", E, F, across, 0.085 * self.s)
        self.pin("bucket_cylinder_barrel_pin", "front_frame", self.at("E", -out), self.at("E", out))

    def lift(self) -> None:
        s, t, world = self.s, self.t, self.as_steered
        across = self.front[:3, 1]
        self.tilt()
        out = self.eye_w / 2 + self.gap + t
        for side, tail in ((1, "_l"), (-1, "_r")) if self.m.twin else ((1, ""),):
            y = side * self.y_lift
            barrel, rod = f"boom_cylinder_barrel{tail}", f"boom_piston_rod{tail}"
            self.cylinder(f"lift{tail}", barrel, rod, world(self.at("C", y)), world(self.at("D", y)), across, 0.07 * s)
            if self.m.twin:
                self.pin(
                    f"{barrel}_pin",
                    "front_frame",
                    self.at("C", side * (self.y_in + t / 2)),
                    self.at("C", y - side * out),
                )
                self.pin(
                    f"{rod}_pin",
                    "boom",
                    self.at("D", side * (self.yb + t / 2)),
                    self.at("D", y - side * self.eye_w / 2),
                )
            else:
                wide = self.y_rocker + 1.5 * t + self.gap
                self.pin(f"{barrel}_pin", "front_frame", self.at("C", -out), self.at("C", out))
                self.pin(f"{rod}_pin", "boom", self.at("D", -wide), self.at("D", wide))


def loader(
    seed: int,
    *,
    twin: bool | None = None,
    steered: bool = True,
    embedded: bool = False,
    stop: bool = False,
    hoses: int = 0,
    links: int = 1,
) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names. `embedded`: plates are drawn into each
    other along their welds; `stop`: a steering stop lies flat against both frames; `hoses` run between any two bodies
    (their truth is empty); `links`: one bucket link in the middle, or one on each side of the rocker."""
    steered = steered and not stop
    return Drawer(seed, twin=twin, steered=steered, embedded=embedded, stop=stop, hoses=hoses, links=links).draw()


def disguise(
    machine: Machine,
    seed: int,
    *,
    names: bool = False,
    rotate: bool = True,
    shuffle: bool = True,
    scale: bool = False,
) -> tuple[Assembly, dict[str, tuple[str, str]], Array]:
    """The machine as a stranger sends it, Part_001…, turned and shuffled, in a unit of its own (`scale`): (assembly,
    truth by id, CAD → machine)."""
    rng = np.random.default_rng([seed, 7])
    world = np.eye(4)
    if rotate:
        q, r = np.linalg.qr(rng.normal(size=(3, 3)))
        q = q * np.sign(np.diag(r))
        if np.linalg.det(q) < 0:
            q[:, 0] = -q[:, 0]
        world[:3, :3], world[:3, 3] = q, rng.normal(size=3) * 5
    order = rng.permutation(len(machine.parts)) if shuffle else np.arange(len(machine.parts))
    if scale:
        world[:3] *= 10 ** rng.uniform(-1.5, 1.5)
    parts, truth = [], {}
    for position, index in enumerate(order):
        part = machine.parts[index]
        name = part.name if names else f"Part_{position:03d}"
        path = part.path if names else ("Assembly",)
        part_id = part.id if names else f"Assembly/{name}"
        parts.append(Part(part_id, name, path, part.shape, world @ part.transform))
        truth[part_id] = machine.truth[part.id]
    assembly = Assembly("machine", "synthetic", 0.001, tuple(parts), dict(machine.shapes))
    return assembly, truth, np.linalg.inv(world)
