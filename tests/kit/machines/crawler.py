"""A small crawler as an `Assembly`, with the truth: two tracks of shoes, rollers, idlers and sprockets, a frame, and a
body that swings on it. It fits `tracked_template`.

Machine frame, metres. A chain of `shoes` links of one pitch runs around two wheels of `TEETH` teeth: half of them at
each end, the rest straight, so that every link has its exact pitch.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
import trimesh

from kit.machines.solids import Array, around, bolt, box, lathe, place, plate, tube
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh, PlaneFeature, Shape
from yellowiron.model.mechanism import Joint, Mechanism

TEETH = 12
PITCH = 0.19
PITCH_RADIUS = PITCH / (2 * math.sin(math.pi / TEETH))
GAUGE = 2.4
SHOE = (0.175, 0.6, 0.03)
"""A shoe's plate: along the chain, across, thick."""
LUG = 0.045
"""Radius of the eyes of a link; the wheels run on them."""
PLATE_OUT = 0.06
"""From the pins' line to the plate's middle, outwards."""
X, Y, Z = np.eye(3)
ROWS = ("track_shoe", "track_roller", "carrier_roller")


@dataclass
class Crawler:
    """Parts as drawn; `truth`: id → role; `pins`: side → (n, 3) points of the chain's pins, pin k behind shoe k."""

    shoes: int
    parts: list[Part] = field(default_factory=list)
    shapes: dict[str, Shape] = field(default_factory=dict)
    truth: dict[str, str] = field(default_factory=dict)
    pins: dict[str, Array] = field(default_factory=dict)
    axles: dict[str, Array] = field(default_factory=dict)

    def add(self, name: str, role: str, shape: Shape, transform: Array) -> None:
        self.shapes[shape.key] = shape
        part_id = f"CRAWLER/{role}/{name}#{len(self.parts)}"
        self.parts.append(Part(part_id, name, ("CRAWLER", role), shape.key, transform))
        self.truth[part_id] = role

    def assembly(self) -> Assembly:
        return Assembly("crawler", "synthetic", 0.001, tuple(self.parts), dict(self.shapes))

    def counts(self) -> dict[str, int]:
        found: dict[str, int] = {}
        for role in self.truth.values():
            row, _, number = role.rpartition("_")
            if number.isdigit():
                found[row] = max(found.get(row, 0), int(number))
        return found

    def aligned(self, *, shoes: bool) -> Alignment:
        """The true alignment, with `shoes` as bodies or moving with the undercarriage."""

        def body(role: str) -> str:
            if role in ("upper", "boom"):
                return role
            return role if shoes and role not in ("undercarriage", "swing_bearing") else "undercarriage"

        parts = tuple(
            PartAssignment(p.id, self.truth[p.id], body(self.truth[p.id]), 1.0, "drawn so") for p in self.parts
        )
        return Alignment("crawler", np.eye(4), parts, counts=self.counts())


def triple(v: Array) -> tuple[float, float, float]:
    return (float(v[0]), float(v[1]), float(v[2]))


def merged(name: str, *placed: tuple[Shape, Array]) -> Shape:
    """Several shapes as one solid: their meshes side by side, their features together."""
    meshes, cylinders, planes = [], [], []
    for shape, matrix in placed:
        meshes.append(trimesh.Trimesh(shape.mesh.points, shape.mesh.triangles, process=False).apply_transform(matrix))
        for c in shape.cylinders:
            point = matrix[:3, :3] @ np.array(c.point) + matrix[:3, 3]
            axis = matrix[:3, :3] @ np.array(c.direction)
            cylinders.append(replace(c, point=triple(point), direction=triple(axis)))
        for p in shape.planes:
            point = matrix[:3, :3] @ np.array(p.point) + matrix[:3, 3]
            normal = matrix[:3, :3] @ np.array(p.normal)
            planes.append(PlaneFeature(triple(point), triple(normal), p.area))
    whole = trimesh.util.concatenate(meshes)
    points = np.asarray(whole.vertices, dtype=np.float64)
    properties = whole.mass_properties
    return Shape(
        key=name, name=name, mesh=Mesh(points, np.asarray(whole.faces, dtype=np.int32)),
        volume=float(properties.volume), area=float(whole.area),
        centroid=np.asarray(properties.center_mass, dtype=np.float64),
        inertia=np.asarray(properties.inertia, dtype=np.float64),
        cylinders=tuple(cylinders), planes=tuple(planes), bounds=np.array([points.min(axis=0), points.max(axis=0)]),
    )  # fmt: skip


def shoe_shape() -> Shape:
    """A link: local x from its rear pin to its front pin (both at z = 0), y along the pins, z outwards. The front eyes
    stand between the rear eyes of the next link."""
    half = PITCH / 2
    eye = around((0.0, 0.0, LUG), (0.0, PLATE_OUT - SHOE[2] / 2, 0.0), (half, PLATE_OUT - SHOE[2] / 2, 0.0))
    # The pin is fast in the rear eyes, and turns in the front ones.
    rear, front = (plate("eye", eye, 0.03, [(0.0, 0.0, radius)]) for radius in (0.02, 0.0204))
    eyes = []
    for shape, y, x, sense in ((front, 0.075, half, -1), (rear, 0.107, -half, 1)):
        for side in (y, -y):
            eyes.append((shape, place((x, side, 0.0), (0.0, -sense, 0.0), (sense, 0.0, 0.0))))
    return merged("shoe", (box("plate", *SHOE), place((0, 0, PLATE_OUT), Z, X)), *eyes)


def sprocket_shape(outer: float) -> Shape:
    """A disc with a hub and teeth, turned about z."""
    disc = lathe("disc", [(0.06, -0.05), (outer - 0.03, -0.05), (outer - 0.03, 0.05), (0.06, 0.05)])
    teeth = []
    for k in range(TEETH):
        turn = 2 * math.pi * (k + 0.5) / TEETH
        out = np.array([math.cos(turn), math.sin(turn), 0.0])
        teeth.append((box("tooth", 0.05, 0.04, 0.09), place((outer - 0.025) * out, Z, out)))
    return merged("sprocket", (disc, np.eye(4)), *teeth)


def chain(shoes: int) -> Array:
    """(n, 2) pins in x, z around the loop, forward on the ground, from the rear end of the straight there."""
    straight = (shoes - TEETH) // 2
    assert 2 * straight + TEETH == shoes
    half = 0.5 * straight * PITCH
    height = PITCH_RADIUS + PLATE_OUT + SHOE[2] / 2
    points = [(-half + k * PITCH, -PITCH_RADIUS) for k in range(straight)]
    turn = [-math.pi / 2 + k * 2 * math.pi / TEETH for k in range(TEETH // 2)]
    points += [(half + PITCH_RADIUS * math.cos(a), PITCH_RADIUS * math.sin(a)) for a in turn]
    points += [(half - k * PITCH, PITCH_RADIUS) for k in range(straight)]
    points += [(-half - PITCH_RADIUS * math.cos(a), -PITCH_RADIUS * math.sin(a)) for a in turn]
    return np.array(points) + np.array([0.0, height])


def crawler(shoes: int = 36, rollers: int = 5, carriers: int = 2, *, bolts: int = 0) -> Crawler:
    """The machine. `bolts` a shoe hold its plate; pins are parts of their own, of the shoe in front of them."""
    made = Crawler(shoes)
    shoe = shoe_shape()
    outer = PITCH_RADIUS - LUG
    sprocket = sprocket_shape(outer + 0.03)
    idler = lathe("idler", [(0.05, -0.05), (outer, -0.05), (outer, 0.05), (0.05, 0.05)])
    roller = lathe("roller", [(0.03, -0.12), (0.08, -0.12), (0.08, 0.12), (0.03, 0.12)])
    carrier = lathe("carrier", [(0.025, -0.1), (0.06, -0.1), (0.06, 0.1), (0.025, 0.1)])
    pin = tube("track_pin", 0.02, 0.0, 0.25)
    screw = bolt("shoe_bolt", 0.01, 0.05)
    points = chain(shoes)
    half = 0.5 * (shoes - TEETH) / 2 * PITCH
    middle = PITCH_RADIUS + PLATE_OUT + SHOE[2] / 2
    for side, y in (("l", GAUGE / 2), ("r", -GAUGE / 2)):
        made.pins[side] = np.c_[points[:, 0], np.full(shoes, y), points[:, 1]]
        for k in range(shoes):
            rear, front = made.pins[side][k], made.pins[side][(k + 1) % shoes]
            along = (front - rear) / PITCH
            outwards = np.cross(Y, along)
            frame = place(0.5 * (rear + front), outwards, along)
            role = f"track_shoe_{side}_{k + 1}"
            made.add("shoe", role, shoe, frame)
            made.add("track_pin", role, pin, place(rear - 0.125 * Y, Y))
            for b in range(bolts):
                at = [0.04 * (1 - 2 * (b % 2)), 0.2 * (1 - 2 * (b // 2)), PLATE_OUT + SHOE[2] / 2]
                made.add("shoe_bolt", role, screw, frame @ place(np.array(at), Z))
        wheels = [
            (f"sprocket_{side}", sprocket, -half, middle, 0.06), (f"idler_{side}", idler, half, middle, 0.05),
            *((f"track_roller_{side}_{k + 1}", roller, x, middle - PITCH_RADIUS + LUG + 0.08, 0.03)
              for k, x in enumerate(np.linspace(half - 0.3, -half + 0.3, rollers))),
            *((f"carrier_roller_{side}_{k + 1}", carrier, x, middle + PITCH_RADIUS - LUG - 0.06, 0.025)
              for k, x in enumerate(np.linspace(0.3 * half, -0.3 * half, carriers))),
        ]  # fmt: skip
        for role, shape, x, z, bore in wheels:
            made.axles[role] = np.array([x, y, z])
            made.add(role.rsplit("_", 1)[0], role, shape, place((x, y, z), Y, X))
            # Axles run from inside the frame's plate through the wheel.
            made.add("axle", "undercarriage", tube(f"axle_{bore}", 0.999 * bore, 0.0, 0.42), place((x, y - 0.21, z), Y))
        made.add(
            "track_frame", "undercarriage", box("track_frame", 2 * half, 0.05, 0.3), place((0, y * 0.86, middle), Z, X)
        )
    deck = box("deck", 1.2, 2 * 0.86 * GAUGE / 2 - 0.05, 0.25)
    made.add("deck", "undercarriage", deck, place((0, 0, middle + 0.05), Z, X))
    top = middle + 0.175
    made.add("swing_ring", "swing_bearing", tube("swing_ring", 0.5, 0.42, 0.1), place((0, 0, top), Z, X))
    turntable = lathe("turntable", [(0.0, 0.02), (0.4195, 0.02), (0.4195, 0.1), (0.9, 0.1), (0.9, 0.14), (0.0, 0.14)])
    made.add("turntable", "upper", turntable, place((0, 0, top), Z, X))
    made.add("house", "upper", box("house", 2.2, 2.4, 0.25), place((-0.3, 0, top + 0.265), Z, X))
    return made


def of_steel(mechanism: Mechanism) -> Mechanism:
    """A crawler as heavy as its steel, about: without a published weight it was built with a usual one of its size, a
    tenth of what its solid blocks weigh. Drives that were limited for that are as much stronger."""
    bodies = tuple(replace(b, mass=10.0 * b.mass, inertia=10.0 * b.inertia) for b in mechanism.bodies)
    return replace(mechanism, bodies=bodies, joints=tuple(_stronger(j) for j in mechanism.joints))


def _stronger(joint: Joint) -> Joint:
    drive = joint.drive
    if drive is None or "limited to what suits" not in drive.source:
        return joint
    return replace(joint, drive=replace(drive, max_force=10.0 * drive.max_force, damping=10.0 * drive.damping))
