"""A small machine made by hand: a base, an arm on a pin, and a cylinder between them, with exact features.

The arm turns about y at A = (0, 0, 1); the cylinder runs from C = (0.3, 0, 0.4) on the base to D = (1, 0, 1) on the
arm.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import CylinderFeature, Floats, Mesh, PlaneFeature, Shape
from yellowiron.model.specification import Evidence, Specification, Specifications
from yellowiron.model.template import (
    ActuatorTemplate,
    CylinderTemplate,
    JointTemplate,
    Material,
    Role,
    SiteTemplate,
    Template,
    Wanted,
)

A, C, D = np.array([0.0, 0.0, 1.0]), np.array([0.3, 0.0, 0.4]), np.array([1.0, 0.0, 1.0])
BORE, ROD, STROKE, EXTENSION, PRESSURE = 0.1, 0.06, 0.4, 0.15, 25e6
SIDE = np.array([0.0, 0.3, 0.0])
LENGTH = float(np.linalg.norm(D - C))
BOX = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                [0, 6, 4], [1, 5, 7], [1, 7, 3]], dtype=np.int32)  # fmt: skip
SEGMENTS = 24


def frame_along(axis: Sequence[float] | Floats, origin: Sequence[float] | Floats) -> Floats:
    """(4, 4) that takes z to a direction and 0 to a point."""
    z = np.asarray(axis, dtype=np.float64) / np.linalg.norm(axis)
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(z)))], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    matrix[:3, 3] = origin
    return matrix


def box(key: str, size: Sequence[float], *, at: Sequence[float] = (0.0, 0.0, 0.0)) -> Shape:
    """A box about a point, with its six planes."""
    a, b, c = size
    corners = np.array([[x, y, z] for x in (-a / 2, a / 2) for y in (-b / 2, b / 2) for z in (-c / 2, c / 2)])
    volume = a * b * c
    planes = tuple(
        PlaneFeature(
            tuple(np.asarray(at) + sign * 0.5 * size[i] * np.eye(3)[i]), tuple(sign * np.eye(3)[i]), volume / size[i]
        )
        for i in range(3)
        for sign in (-1.0, 1.0)
    )
    inertia = volume / 12.0 * np.diag([b * b + c * c, a * a + c * c, a * a + b * b])
    mesh = Mesh(corners + np.asarray(at), BOX)
    return Shape(key, key, mesh, volume, 2 * (a * b + b * c + a * c), np.asarray(at, float), inertia, planes=planes)


def turned(key: str, profile: Sequence[tuple[float, float]], *, bores: Iterable[tuple[float, float, float]] = (),
           shafts: Iterable[tuple[float, float, float]] = ()) -> Shape:  # fmt: skip
    """A solid of revolution about z from a closed (radius, z) profile, anticlockwise in the (r, z) half-plane
    (outside to the right of travel upwards). `bores` and `shafts` are (radius, z0, z1) features."""
    angles = np.arange(SEGMENTS) * 2 * math.pi / SEGMENTS
    rings = np.array([[[r * math.cos(t), r * math.sin(t), z] for t in angles] for r, z in profile])
    n = len(profile)
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        for k in range(SEGMENTS):
            m = (k + 1) % SEGMENTS
            triangles += [(i * SEGMENTS + k, i * SEGMENTS + m, j * SEGMENTS + m),
                          (i * SEGMENTS + k, j * SEGMENTS + m, j * SEGMENTS + k)]  # fmt: skip
    points = rings.reshape(-1, 3)
    corners = points[np.array(triangles)]
    volume = float(np.einsum("mi,mi->m", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6.0)
    extent = points.max(axis=0) - points.min(axis=0)
    inertia = volume / 12.0 * np.diag([extent[1] ** 2 + extent[2] ** 2, extent[0] ** 2 + extent[2] ** 2,
                                       extent[0] ** 2 + extent[1] ** 2])  # fmt: skip
    features = tuple(
        feature((0, 0, 0), (0, 0, 1), radius, low, high, inner=inner)
        for rows, inner in ((bores, True), (shafts, False))
        for radius, low, high in rows
    )
    mesh = Mesh(points, np.array(triangles, dtype=np.int32))
    return Shape(key, key, mesh, volume, 1.0, 0.5 * (points.max(axis=0) + points.min(axis=0)), inertia,
                 cylinders=features)  # fmt: skip


def feature(
    point: Sequence[float], direction: Sequence[float], radius: float, lower: float, upper: float, *, inner: bool
) -> CylinderFeature:
    """A full exact cylinder."""
    area = 2 * math.pi * radius * (upper - lower)
    x, y, z = (float(v) for v in point)
    u, v, w = (float(c) for c in direction)
    return CylinderFeature((x, y, z), (u, v, w), radius, lower, upper, 2 * math.pi, inner, True, area)


def pin(key: str, radius: float, length: float) -> Shape:
    """A pin along z about the origin."""
    h = length / 2
    return turned(key, [(0.0, -h), (radius, -h), (radius, h), (0.0, h)], shafts=[(radius, -h, h)])


def barrel(extension: float = EXTENSION) -> Shape:
    """A barrel along z from its pivot at 0: bottom at 0.1, gland face at 0.1 + piston + stroke."""
    top = 0.1 + 0.05 + STROKE
    wall, r, rod = BORE / 2 + 0.01, BORE / 2, ROD / 2
    profile = [
        (0.0, 0.0),
        (wall, 0.0),
        (wall, top + 0.05),
        (rod, top + 0.05),
        (rod, top),
        (r, top),
        (r, 0.1),
        (0.0, 0.1),
    ]
    return turned("barrel", profile, bores=[(r, 0.1, top), (rod, top, top + 0.05)], shafts=[(wall, 0.0, top + 0.05)])


def rod(extension: float = EXTENSION, length: float = LENGTH) -> Shape:
    """A piston rod along z in the barrel's frame: piston (0.05) from 0.1 + extension, rod up to the eye at `length`."""
    low = 0.1 + extension
    r, shaft, eye = BORE / 2, ROD / 2, 0.07
    profile = [(0.0, low), (r, low), (r, low + 0.05), (shaft, low + 0.05), (shaft, length - 0.08), (eye, length - 0.08),
               (eye, length + 0.05), (0.0, length + 0.05)]  # fmt: skip
    return turned("rod", profile, shafts=[(r, low, low + 0.05), (shaft, low + 0.05, length - 0.08)])


def template(**changes: object) -> Template:
    """Base, arm, barrel and rod; one loop."""
    plain = Template(
        equipment_type="crane",
        folder="",
        root="base",
        roles=(
            Role("crane", None, False, "group"),
            Role("base", "crane", True, "frame"),
            Role("arm_pin", "base", False, "pin"),
            Role("barrel_pin", "base", False, "pin"),
            Role("arm", "base", True, "arm"),
            Role("rod_pin", "arm", False, "pin"),
            Role("cylinder_barrel", "base", True, "barrel"),
            Role("cylinder_rod", "arm", True, "rod"),
        ),
        joints=(
            JointTemplate("base2arm", "revolute", ("arm", "arm_pin")),
            JointTemplate("base2barrel", "revolute", ("cylinder_barrel", "barrel_pin")),
            JointTemplate("arm2rod", "revolute", ("cylinder_rod", "rod_pin")),
            JointTemplate("slide", "prismatic", ("cylinder_rod", "cylinder_barrel"), "0", "Stroke", "linear"),
        ),
        materials={"*": Material("steel", density=7850.0), "arm": Material("alloy", density=2700.0)},
        collision={"arm": "convexDecomposition"},
        wanted=(
            Wanted("Stroke", "length"),
            Wanted("Arm Weight", "mass", mass_of="arm"),
            Wanted("Operating Weight", "mass", mass_of="*"),
        ),
        actuators=(
            ActuatorTemplate(
                "lift",
                "cylinder",
                (CylinderTemplate("slide", "base2barrel", "arm2rod"),),
                specifications={"stroke": "Stroke", "bore": "Bore", "pressure": "Pressure", "flow": "Flow"},
                defaults={"pressure": PRESSURE},
            ),
        ),
        sites=(SiteTemplate("tip", "arm", {"edge_from": "base2arm", "spanning": 0.8}),),
    )
    return replace(plain, **changes)  # type: ignore[arg-type]


def specification(name: str, value: float, unit: str = "m") -> Specification:
    """A value read from a sheet."""
    return Specification(name, value, unit, "ok", evidence=Evidence("sheet.pdf", 2, f"{name} {value}"))


def specifications(**values: float) -> Specifications:
    """Values by name with `_` for space; the stroke unless it is given."""
    units = {"Pressure": "Pa", "Flow": "m^3/s", "Operating Weight": "kg", "Arm Weight": "kg"}
    named = {k.replace("_", " "): v for k, v in {"Stroke": STROKE, **values}.items()}
    return Specifications({k: specification(k, v, units.get(k, "m")) for k, v in named.items()})


def machine(
    *, extension: float = EXTENSION, frame: Floats | None = None, twist: float = 0.0
) -> tuple[Assembly, Alignment]:
    """The crane as CAD (in a frame of its own: the inverse of `frame`) and its true alignment. `twist` turns the
    rod's pin by radians about the cylinder, so that it is not parallel to the others."""
    frame = np.eye(4) if frame is None else frame
    along = frame_along(D - C, C)
    twisted = np.array([math.sin(twist) * 0.6, math.cos(twist), math.sin(twist) * 0.8])
    placed: list[tuple[str, str, str, Shape, Floats]] = [
        ("BASE", "base", "base", box("base", (1.0, 0.8, 0.2)), np.eye(4)),
        ("PIN L", "arm_pin", "base", pin("short", 0.04, 0.1), frame_along([0, 1, 0], A + SIDE)),
        ("PIN R", "arm_pin", "base", pin("short", 0.04, 0.1), frame_along([0, -1, 0], A - SIDE)),
        ("PIN C", "barrel_pin", "base", pin("long", 0.03, 0.2), frame_along([0, 1, 0], C)),
        ("PIN D", "rod_pin", "arm", pin("long", 0.03, 0.2), frame_along(twisted, D)),
        ("ARM", "arm", "arm", box("arm", (2.0, 0.5, 0.1), at=(1.0, 0.0, 1.0)), np.eye(4)),
        ("BARREL", "cylinder_barrel", "cylinder_barrel", barrel(), along),
        ("ROD", "cylinder_rod", "cylinder_rod", rod(extension), along),
    ]
    inverse = np.linalg.inv(frame)
    parts = tuple(Part(f"CRANE/{name}", name, ("CRANE",), shape.key, inverse @ m) for name, _, _, shape, m in placed)
    assembly = Assembly("crane", "step", 0.001, parts, {s.key: s for *_, s, _ in placed})
    assigned = tuple(
        PartAssignment(p.id, role, body, 1.0, "made so") for p, (_, role, body, *_) in zip(parts, placed, strict=True)
    )
    return assembly, Alignment("crane", frame, assigned)
