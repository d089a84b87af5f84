"""A small machine that has one of everything: all five joint types, both drives, every collision approximation, a
mirrored and a scaled instance, names of several scripts, a texture, and a closed loop with its cut."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import trimesh
from usd_shapes import ACROSS, MIRROR_Y, Machine, at, make_shape, open_box, round_shape

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, PlaneFeature, Shape
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
    Mobility,
    Site,
)
from yellowiron.model.sensor import PARAMETERS, Sensor
from yellowiron.model.template import Material, MeasurementTemplate

Place = np.ndarray


@pytest.fixture(scope="session")
def shapes() -> dict[str, Shape]:
    bracket = trimesh.util.concatenate(
        [
            trimesh.creation.box((0.4, 0.1, 0.1)),
            trimesh.creation.box((0.1, 0.3, 0.1), trimesh.transformations.translation_matrix((0.15, 0.2, 0.0))),
        ]
    )
    box = make_shape(
        "BEAM",
        trimesh.creation.box((2.0, 0.4, 0.3)),
        planes=(PlaneFeature((0, 0, 0.15), (0.0, 0.0, 1.0), 0.8), PlaneFeature((0, 0.2, 0), (0.0, 1.0, 0.0), 0.6)),
    )
    return {
        s.name: s
        for s in (
            box,
            round_shape("PIN 50x300", 0.05, 0.3),
            round_shape("WHEEL", 0.5, 0.4),
            make_shape("Kapsel", trimesh.creation.capsule(0.4, 0.1)),
            make_shape("Kugel-Größe 3", trimesh.creation.icosphere(subdivisions=3, radius=0.2), normals=True),
            make_shape("bracket", bracket),
            open_box("铲斗"),
        )
    }


@pytest.fixture(scope="session")
def machine(shapes: dict[str, Shape], tmp_path_factory: pytest.TempPathFactory) -> Machine:
    folder = tmp_path_factory.mktemp("materials")
    _write_picture(folder / "rust.png")
    parts: list[Part] = []
    bodies: dict[str, list[BodyPart]] = {}

    def add(
        body: str,
        shape: str,
        transform: Place,
        collision: str,
        *,
        material: str = "steel",
        name: str = "",
        color: Color | None = None,
    ) -> None:
        base = f"MACHINE/{body.upper()}/{name or shape}"
        same = sum(p.id == base or p.id.startswith(base + "#") for p in parts)
        part_id = base if not same else f"{base}#{same + 1}"
        parts.append(Part(part_id, name or shape, ("MACHINE", body.upper()), shapes[shape].key, transform, color))
        bodies.setdefault(body, []).append(BodyPart(part_id, body, material, collision, 10.0, "drawn"))

    add("frame", "BEAM", at(0, 0, 1.0), "analytic", color=(0.9, 0.6, 0.05))
    add("frame", "bracket", at(0.5, 0.4, 1.2), "convexDecomposition")
    add("frame", "bracket", MIRROR_Y @ at(0.5, 0.4, 1.2), "convexDecomposition")
    add("frame", "bracket", at(-0.6, 0.0, 1.3) @ np.diag([2.0, 2.0, 2.0, 1.0]), "convexHull")
    add("frame", "bracket", at(-0.9, 0.0, 1.3) @ np.diag([1.0, 2.0, 3.0, 1.0]), "meshSimplification")
    add("wheel_l", "WHEEL", at(-0.5, 0.6, 0.5, turn=ACROSS), "analytic", material="rubber")
    add("wheel_r", "WHEEL", MIRROR_Y @ at(-0.5, 0.6, 0.5, turn=ACROSS), "analytic", material="rubber")
    add("arm", "BEAM", at(2.0, 0, 1.3), "boundingCube", material="paint")
    add("arm", "PIN 50x300", at(1.0, 0, 1.3, turn=ACROSS), "none", name='bolt 1/2"')
    add("arm", "PIN 50x300", at(3.0, 0, 1.3, turn=ACROSS), "none", name='bolt 1/2"')
    add("barrel", "PIN 50x300", at(1.2, 0, 0.8, turn=(np.pi / 2, (0, 1, 0))), "analytic")
    add("rod", "PIN 50x300", at(1.6, 0, 0.8, turn=(np.pi / 2, (0, 1, 0))), "analytic")
    add("铲斗", "铲斗", at(3.5, 0, 1.0), "sdf")
    add("铲斗", "bracket", at(3.2, 0, 1.5), "triangleMesh", name="Zahn ä")
    add("hanger", "Kugel-Größe 3", at(3.0, 1.5, 1.0), "boundingSphere")
    add("hanger", "Kugel-Größe 3", at(3.0, 1.9, 1.0), "analytic")
    add("chain", "Kapsel", at(3.0, 1.5, 0.4), "analytic")
    add("cab", "bracket", at(-0.3, 0.0, 1.42), "sphereFill", material="")

    materials = {
        "steel": Material("steel", 7850.0, 2.1e11, 0.6, 0.5, 0.1, None, None, 0.4, 0.9),
        "rubber": Material("rubber", 1100.0, 5e7, 1.0, 0.9, 0.4, (0.02, 0.02, 0.02), None, 0.9, 0.0),
        "paint": Material("paint", 7850.0, None, 0.6, 0.5, None, None, "rust.png"),
    }
    origins = {
        "frame": (0.0, 0.0, 0.0),
        "wheel_l": (-0.5, 0.6, 0.5),
        "wheel_r": (-0.5, -0.6, 0.5),
        "arm": (1.0, 0.0, 1.3),
        "barrel": (1.05, 0.0, 0.8),
        "rod": (1.2, 0.0, 0.8),
        "铲斗": (3.0, 0.0, 1.3),
        "hanger": (3.0, 1.5, 1.3),
        "chain": (3.0, 1.5, 0.7),
        "cab": (-0.2, 0.0, 1.5),
    }
    generator = np.random.default_rng(7)
    made = []
    for body, body_parts in bodies.items():
        spread = generator.normal(size=(6, 3))
        made.append(
            Body(
                body,
                origins[body],
                float(100.0 + 10.0 * len(made)) / 3.0,
                tuple(np.asarray(origins[body]) + 0.1 * generator.normal(size=3)),
                10.0 * (np.trace(spread.T @ spread) * np.eye(3) - spread.T @ spread),
                tuple(body_parts),
                np.asarray(origins[body]) + generator.normal(size=(5, 3)),
                "rigid: Y",
            )
        )
    evidence = {
        "template": "arm_joint",
        "parts": ["MACHINE/ARM/bolt"],
        "method": "pin",
        "residual": 1e-7,
        "upper": {"name": "Stroke", "page": 3, "quote": 'Kolbenhub "1/3" m'},
    }
    position = Drive("position", 1e6 / 3, 1e4 / 7, 2.5e5, 0.31, "pressure × area")
    velocity = Drive("velocity", 0.0, 500.0 / 3, 9e3, 4.0 / 3, "motor")
    tilted = np.array([1.0, 2.0, 2.0]) / 3.0
    joints = (
        Joint("wheel_l_joint", "revolute", "frame", "wheel_l", (-0.5, 0.6, 0.5), (0, 1, 0), drive=velocity),
        Joint("wheel_r_joint", "revolute", "frame", "wheel_r", (-0.5, -0.6, 0.5), (0, 1, 0), free=True),
        Joint("arm_joint", "revolute", "frame", "arm", (1.0, 0.0, 1.3), (0, 1, 0), -1 / 3, 2 / 3, source=evidence),
        Joint("barrel_joint", "revolute", "frame", "barrel", (1.05, 0.0, 0.8), (0, 1, 0)),
        Joint("slide", "prismatic", "barrel", "rod", (1.2, 0.0, 0.8), (1, 0, 0), -1 / 7, 1 / 3, drive=position),
        Joint("rod_joint", "revolute", "arm", "rod", (1.75, 0.0, 0.8), (0, 1, 0), -0.5, 0.5, cut=True),
        Joint("铲斗 joint", "spherical", "arm", "铲斗", (3.0, 0.0, 1.3), tuple(tilted), upper=0.5),
        Joint("rope", "distance", "铲斗", "hanger", (3.0, 1.5, 1.3), (0, 0, -1), 0.0, 0.25),
        Joint("chain_joint", "revolute", "hanger", "chain", (3.0, 1.5, 0.7), (-1, 0, 0), upper=0.1),
        Joint("cab_joint", "fixed", "frame", "cab", (-0.2, 0.0, 1.5), (1, 0, 0)),
    )
    mechanism = Mechanism(
        name="Prüfmaschine 1",
        equipment_type="test_machine",
        root="frame",
        bodies=tuple(made),
        joints=joints,
        cylinders=(
            Cylinder(
                "lift",
                "barrel",
                "rod",
                "slide",
                "barrel_joint",
                "rod_joint",
                0.1,
                0.06,
                1 / 3 + 1 / 7,
                0.7 - 1 / 7,
                0.7,
                31.5e6,
                2.5e5,
                1.6e5,
                0.31,
                sources={"stroke": "page 3"},
            ),
        ),
        actuators=(Actuator("lift", "cylinder", (ActuatorJoint("slide", 1),), ("lift",)),),
        loops=(Loop(("arm_joint", "barrel_joint", "slide", "rod_joint"), "rod_joint", -1),),
        sites=(
            Site("tip", "铲斗", (4.0, 0.0, 0.6), source="edge"),
            Site("斗 tooth", "铲斗", (4.0, 0.5, 0.6), (0.0, 1.0, 0.0), (0.6, 0.0, 0.8)),
        ),
        materials=materials,
        measurements=(
            MeasurementTemplate("reach", "Reach", {"point": "tip", "axis": [1, 0, 0]}, ({"drive": "lift", "to": 1.0},)),
        ),
        specifications={"Stroke": {"value": 1 / 3 + 1 / 7, "unit": "m", "page": 3}},
        mobility=Mobility(7, 7, 6),
        findings=(Finding("MEC001", "info", "cab", "welded"),),
        sensors=sensors(),
    )
    assembly = Assembly("MACHINE", "step", 0.001, tuple(parts), {s.key: s for s in shapes.values()})
    return Machine(mechanism, assembly, folder)


def sensors() -> tuple[Sensor, ...]:
    """One of every type, those on bodies tilted, beside a site of the same name."""
    axes = {"x_axis": (0.6, 0.0, -0.8), "z_axis": (0.8, 0.0, 0.6)}

    def sensor(name: str, kind: str, **more: object) -> Sensor:
        parameters = {key: p.default for key, p in PARAMETERS[kind].items()}
        return Sensor(name, kind, parameters=parameters, **more)  # type: ignore[arg-type]

    return (
        sensor("tip", "camera", body="铲斗", position=(3.7, 0.1, 1 / 3), **axes),
        sensor("roof lidar", "lidar", body="cab", position=(-0.2, 0.0, 2.0), source="ours"),
        sensor("imu", "imu", body="frame", position=(0.1, 0.2, 1 / 7), **axes),
        sensor("gnss", "gnss", body="cab", position=(-0.2, 0.3, 2.0)),
        sensor("斗 contact", "contact", body="铲斗", position=(3.5, 0.0, 1.0)),
        sensor("arm angle", "joint_encoder", joint="arm_joint"),
        sensor("stroke", "cylinder_encoder", joint="slide", cylinder="lift"),
        sensor("pressure", "cylinder_pressure", joint="slide", cylinder="lift"),
    )


def _write_picture(path: Path) -> None:
    from PIL import Image

    Image.new("RGB", (4, 4), (120, 60, 30)).save(path)


@pytest.fixture(scope="session")
def write(machine: Machine) -> Callable[..., tuple[Path, ...]]:
    """Writes the test machine into a folder."""
    from yellowiron.usd.write import write_machine

    def _write(folder: Path, name: str = "test_machine") -> tuple[Path, ...]:
        return write_machine(
            machine.mechanism, machine.assembly, folder, name=name, texture_folders=[machine.texture_folder]
        )

    return _write


@pytest.fixture(scope="session")
def written(write: Callable[..., tuple[Path, ...]], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the test machine."""
    folder = tmp_path_factory.mktemp("machine") / "out"
    write(folder)
    return folder
