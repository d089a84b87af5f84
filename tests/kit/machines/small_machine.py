"""A small loader for engines: four driven wheels (the rear ones on an oscillating axle), a boom that one cylinder
lifts, and an open box for a bucket. Its boom pin is the cut, as in the machines that `build` makes."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
import trimesh

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import CylinderFeature, Mesh, Shape
from yellowiron.model.machine_tests import MachineTest, PayloadTemplate, RatedLoad
from yellowiron.model.mechanism import (
    Actuator,
    ActuatorJoint,
    Body,
    BodyPart,
    Cylinder,
    Drive,
    Joint,
    Loop,
    Mechanism,
    Site,
)
from yellowiron.model.template import Material

RADIUS, WIDTH = 0.5, 0.3
WHEELS = {
    "front_wheel_l": (1.0, 0.7, RADIUS),
    "front_wheel_r": (1.0, -0.7, RADIUS),
    "rear_wheel_l": (-1.0, 0.7, RADIUS),
    "rear_wheel_r": (-1.0, -0.7, RADIUS),
}
BOOM_PIN, BARREL_PIN, ROD_PIN = (0.4, 0.0, 1.6), (0.9, 0.0, 0.9), (1.9, 0.0, 1.3)
STROKE = 0.4


def shape(name: str, mesh: trimesh.Trimesh, **features: object) -> Shape:
    key = hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes()).hexdigest()
    return Shape(
        key=key,
        name=name,
        mesh=Mesh(np.array(mesh.vertices, dtype=np.float64), np.array(mesh.faces, dtype=np.int32)),
        volume=float(mesh.volume),
        area=float(mesh.area),
        centroid=np.array(mesh.center_mass),
        inertia=np.array(mesh.moment_inertia),
        bounds=np.array(mesh.bounds),
        **features,  # type: ignore[arg-type]
    )


def open_box(length: float, width: float, height: float, wall: float) -> trimesh.Trimesh:
    """A box without a lid, one closed solid: a channel's profile and two ends."""
    half, inner = np.array([length, width, height]) / 2, np.array([length, width, height]) / 2 - wall
    outline = [
        (-half[0], -half[2]), (half[0], -half[2]), (half[0], half[2]), (inner[0], half[2]),
        (inner[0], -inner[2]), (-inner[0], -inner[2]), (-inner[0], half[2]), (-half[0], half[2]),
    ]  # fmt: skip
    profile = np.array(outline)
    faces = [(0, 1, 4), (0, 4, 5), (1, 2, 3), (1, 3, 4), (0, 5, 6), (0, 6, 7)]
    count = len(profile)
    front = np.column_stack([profile[:, 0], np.full(count, half[1]), profile[:, 1]])
    back = front * (1.0, -1.0, 1.0)
    sides = [
        triangle
        for i in range(count)
        for j in [(i + 1) % count]
        for triangle in ((i, i + count, j), (j, i + count, j + count))
    ]
    channel = trimesh.Trimesh(
        np.concatenate([front, back]),
        [*((a, c, b) for a, b, c in faces), *((a + count, b + count, c + count) for a, b, c in faces), *sides],
        process=False,
    )
    channel.fix_normals()
    return channel


def _body(
    name: str, origin: tuple[float, float, float], mass: float, center: tuple[float, float, float], **more: object
) -> Body:
    inertia = np.diag([0.1, 0.12, 0.09]) * mass
    return Body(name, origin, mass, center, inertia, more["parts"], np.asarray(more["hull"]))  # type: ignore[arg-type]


def make() -> tuple[Mechanism, Assembly]:
    """The mechanism, not yet completed by the kinematics, and the assembly it stands for."""
    across = trimesh.transformations.rotation_matrix(np.pi / 2, (1.0, 0.0, 0.0))
    feature = CylinderFeature((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), RADIUS, -WIDTH / 2, WIDTH / 2, 2 * np.pi, False)
    side = trimesh.creation.box((0.9, 0.02, 0.4))
    shapes = {
        "WHEEL": shape("WHEEL", trimesh.creation.cylinder(RADIUS, WIDTH, sections=48), cylinders=(feature,)),
        "BLOCK": shape("BLOCK", trimesh.creation.box((1.6, 0.8, 0.4))),
        "AXLE": shape("AXLE", trimesh.creation.box((0.2, 1.0, 0.2))),
        "BEAM": shape("BEAM", trimesh.creation.box((2.0, 0.2, 0.15))),
        "TUBE": shape("TUBE", trimesh.creation.box((0.5, 0.1, 0.1))),
        "SHELL": shape("SHELL", open_box(0.9, 1.2, 0.4, 0.02)),
        "SIDE": shape("SIDE", side),
    }
    parts: list[Part] = []
    rows: dict[str, list[BodyPart]] = {}
    hulls: dict[str, list[np.ndarray]] = {}

    def add(
        body: str, name: str, place: tuple[float, float, float], collision: str, turn: np.ndarray | None = None
    ) -> None:
        matrix = np.eye(4) if turn is None else turn.copy()
        matrix[:3, 3] = place
        identity = f"LOADER/{body}/{name}#{len(parts)}"
        parts.append(Part(identity, name, ("LOADER", body), shapes[name].key, matrix))
        rows.setdefault(body, []).append(
            BodyPart(identity, body, "rubber" if name == "WHEEL" else "steel", collision, 10.0)
        )
        points = shapes[name].mesh.points @ matrix[:3, :3].T + matrix[:3, 3]
        hulls.setdefault(body, []).append(points)

    add("frame", "BLOCK", (0.0, 0.0, 1.1), "convexHull")
    add("rear_axle", "AXLE", (-1.0, 0.0, RADIUS), "convexHull")
    for wheel, place in WHEELS.items():
        add(wheel, "WHEEL", place, "analytic", across)
    add("boom", "BEAM", (1.4, 0.0, 1.5), "convexHull")
    add("boom", "SHELL", (2.9, 0.0, 1.5), "convexDecomposition")
    add("boom", "SIDE", (2.9, 0.59, 1.5), "convexHull")
    add("boom", "SIDE", (2.9, -0.59, 1.5), "convexHull")
    add("barrel", "TUBE", (1.15, 0.0, 1.0), "none")
    add("rod", "TUBE", (1.65, 0.0, 1.2), "none")

    along = np.subtract(ROD_PIN, BARREL_PIN)
    drawn = float(np.linalg.norm(along))
    masses = {"frame": (2500.0, (-0.3, 0.0, 0.9)), "boom": (800.0, (1.8, 0.0, 1.5))}
    masses |= {
        "rear_axle": (200.0, (-1.0, 0.0, RADIUS)),
        "barrel": (30.0, (1.15, 0.0, 1.0)),
        "rod": (20.0, (1.65, 0.0, 1.2)),
    }
    masses |= {name: (120.0, place) for name, place in WHEELS.items()}
    origins = {"frame": (0.0, 0.0, 0.0), "rear_axle": (-1.0, 0.0, RADIUS), "boom": ROD_PIN, "barrel": BARREL_PIN}
    origins |= {"rod": ROD_PIN, **WHEELS}
    bodies = tuple(
        _body(name, origins[name], *masses[name], parts=tuple(rows[name]), hull=np.concatenate(hulls[name]))
        for name in ("frame", "rear_axle", *WHEELS, "barrel", "rod", "boom")
    )
    motor = Drive("velocity", 0.0, 4000.0, 4000.0, 6.0)
    axis = tuple((along / drawn).tolist())
    y = (0.0, 1.0, 0.0)
    joints = (
        Joint("axle_joint", "revolute", "frame", "rear_axle", (-1.0, 0.0, RADIUS), (1, 0, 0), -0.25, 0.25, free=True),
        *(
            Joint(f"{n}_joint", "revolute", "frame" if "front" in n else "rear_axle", n, p, y, free=True, drive=motor)
            for n, p in WHEELS.items()
        ),
        Joint("barrel_joint", "revolute", "frame", "barrel", BARREL_PIN, y),
        Joint("slide", "prismatic", "barrel", "rod", BARREL_PIN, axis, -0.1, STROKE - 0.1,
              drive=Drive("position", 5e6, 0.0, 2e5, 0.25)),
        Joint("rod_joint", "revolute", "rod", "boom", ROD_PIN, y),
        Joint("boom_joint", "revolute", "frame", "boom", BOOM_PIN, y, cut=True),
    )  # fmt: skip
    cylinder = Cylinder(
        "lift", "barrel", "rod", "slide", "barrel_joint", "rod_joint",
        0.1, 0.06, STROKE, drawn - 0.1, drawn, 2.5e7, 2e5, 1.3e5, 0.2,
    )  # fmt: skip
    mechanism = Mechanism(
        name="small loader",
        equipment_type="small_loader",
        root="frame",
        bodies=bodies,
        joints=joints,
        cylinders=(cylinder,),
        actuators=(
            Actuator("boom", "cylinder", (ActuatorJoint("slide"),), ("lift",)),
            Actuator("drive", "motor", tuple(ActuatorJoint(f"{name}_joint") for name in WHEELS)),
        ),
        loops=(Loop(("barrel_joint", "slide", "rod_joint", "boom_joint"), "boom_joint"),),
        sites=(Site("bucket_edge", "boom", (3.35, 0.0, 1.3)), Site("load", "boom", (2.9, 0.0, 1.5))),
        materials={
            "steel": Material("steel", 7850.0, dynamic_friction=0.5),
            "rubber": Material("rubber", 1100.0, dynamic_friction=0.8),
        },
        specifications={"Bucket Capacity Heaped": {"value": 0.05, "unit": "m³"}},
        payload=PayloadTemplate("load", (RatedLoad("Tipping Load", 0.5), RatedLoad("Bucket Capacity Heaped", 1800.0))),
        tests=(
            MachineTest("Tipping Load", "tipping", site="load"),
            MachineTest("Breakout Force", "force", site="bucket_edge", actuator="boom", base="fixed"),
            MachineTest(
                "Raise Time",
                "time",
                specification="Raise Time",
                steps=({"set": {"boom": "min"}},),
                actuator="boom",
                payload=1.0,
                base="fixed",
            ),
            MachineTest(
                "Digging Force",
                "force",
                site="bucket_edge",
                actuator="boom",
                best=("boom",),
                direction="path",
                base="fixed",
            ),
            MachineTest("Rated Payload", "lift", steps=({"set": {"boom": "min"}},), actuator="boom", payload=1.0),
        ),
    )
    return mechanism, Assembly("LOADER", "step", 1.0, tuple(parts), {s.key: s for s in shapes.values()})


def write(folder: Path) -> Path:
    """The completed machine as USD in a folder; its machine file."""
    from yellowiron.kinematics import complete
    from yellowiron.usd import write_machine

    mechanism, assembly = make()
    return write_machine(complete(mechanism), assembly, folder, name="small_loader")[0]
