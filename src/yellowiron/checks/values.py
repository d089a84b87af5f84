"""A stage's bodies, joints, colliders and materials as values. World frame, drawn pose, metres, kilograms, radians.

`None` is "not authored" or "unlimited"; a path is a prim path, "" the world.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import angle_between

WORLD = ""
LINEAR = ("transX", "transY", "transZ")
ANGULAR = ("rotX", "rotY", "rotZ")


@dataclass(frozen=True)
class Units:
    """A stage's units as authored (None: not authored) and as they apply."""

    meters: float | None
    kilograms: float | None
    up_axis: str | None
    meters_per_unit: float
    kilograms_per_unit: float


@dataclass(frozen=True, eq=False)
class StageCollider:
    """A collider: its body, its prim's type, and its box (2, 3) in the world. `axis` (unit), `radius` and `height` are
    those of a cylinder, capsule, cone or sphere. `approximation` is None where no `PhysicsMeshCollisionAPI` is
    applied; `empty` means it has no volume."""

    path: str
    body: str
    shape: str
    approximation: str | None
    bounds: Floats | None
    axis: Floats | None = None
    radius: float = 0.0
    height: float = 0.0
    empty: bool = False
    density: float | None = None
    material: str = ""
    material_missing: bool = False


@dataclass(frozen=True, eq=False)
class StageBody:
    """A rigid body: `pose` (4, 4) without scale, the `scale` along its axes, `shear` and whether it is `mirrored`.
    `mass` and `density` as authored; `center_of_mass` in the world; `inertia` the principal moments. `bounds` (2, 3)
    is the box of all its geometry, `solid` that of its colliders, `drawn` that of what collides with nothing;
    `weightless`: gravity is off on it; `disc_axis` the unit vector about which its inertia is that of a disc, or None.
    """

    path: str
    parent_body: str
    pose: Floats
    scale: Floats
    sheared: bool
    mirrored: bool
    enabled: bool
    kinematic: bool
    mass: float | None
    density: float | None
    center_of_mass: Floats | None
    inertia: Floats | None
    bounds: Floats | None
    solid: Floats | None
    has_collider: bool
    disc_axis: Floats | None = None
    drawn: Floats | None = None
    weightless: bool = False
    filtered: tuple[str, ...] = ()
    record: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class StageDrive:
    """A `PhysicsDriveAPI` instance: N/m and N·s/m, or N·m/rad and N·m·s/rad; forces N or N·m; targets m or rad, m/s or
    rad/s. One of `acceleration` is told for a mass of 1: its gains are 1/s² and 1/s."""

    instance: str
    stiffness: float
    damping: float
    max_force: float
    target_position: float
    target_velocity: float = 0.0
    acceleration: bool = False

    @property
    def acts(self) -> bool:
        """Whether it has a gain: without one it holds nothing."""
        return self.stiffness != 0.0 or self.damping != 0.0


@dataclass(frozen=True, eq=False)
class Side:
    """One end of a joint: what its relationship names and the joint's frame there, in the world. `rotation` (3, 3);
    `norm` is the length of the quaternion it was written as."""

    targets: tuple[str, ...]
    missing: tuple[str, ...]
    body: str
    position: Floats
    rotation: Floats
    norm: float


@dataclass(frozen=True, eq=False)
class StageJoint:
    """A joint. `freedoms` are the directions it leaves free in its own frame, axis first (a hinge: `rotX` for token X);
    `lower` and `upper` are of a hinge's or slide's coordinate; `coordinate` is where it is drawn. `held` means that
    something other than its own drive holds it (friction, a spring, a mimic, a driven distance), `damped` that
    something slows it. `leader` is the joint that it follows: "" where its mimic names none, None where it has no
    mimic; `ratio` and `offset` (m or rad) are the mimic's. `spans`: how far the geometry of a slide's two bodies
    reaches along its axis, metres from the world's origin."""

    path: str
    type: str
    sides: tuple[Side, Side]
    enabled: bool
    cut: bool
    freedoms: tuple[str, ...]
    lower: float | None = None
    upper: float | None = None
    drives: tuple[StageDrive, ...] = ()
    velocity_limits: Mapping[str, float] = field(default_factory=dict)
    held: bool = False
    damped: bool = False
    actuated: bool = False
    leader: str | None = None
    ratio: float = 1.0
    offset: float = 0.0
    spans: tuple[tuple[float, float] | None, tuple[float, float] | None] = (None, None)
    record: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """The last part of its path."""
        return leaf(self.path)

    @property
    def bodies(self) -> tuple[str, str]:
        """The bodies of both sides; "" is the world."""
        return self.sides[0].body, self.sides[1].body

    @property
    def driven(self) -> bool:
        """Whether a drive or an engine's actuator is meant to move it, whatever its gains."""
        return self.actuated or bool(self.drives)

    @functools.cached_property
    def axis(self) -> Floats:
        """The unit vector (3,) of a hinge or slide in the world, by its first frame."""
        return direction(self.sides[0].rotation, self.freedoms[0])

    @functools.cached_property
    def tilt(self) -> float:
        """Angle (rad) between the axis as its two frames carry it."""
        other = direction(self.sides[1].rotation, self.freedoms[0])
        return angle_between(self.axis, other)

    @functools.cached_property
    def coordinate(self) -> float:
        """Where a hinge (rad) or slide (m) is drawn: the second frame's place along or about the first's axis."""
        if self.type == "prismatic":
            return float((self.sides[1].position - self.sides[0].position) @ self.axis)
        turn = self.sides[0].rotation.T @ self.sides[1].rotation
        i = ANGULAR.index(self.freedoms[0])
        j, k = (i + 1) % 3, (i + 2) % 3
        return math.atan2(float(turn[k, j] - turn[j, k]), float(turn[j, j] + turn[k, k]))


@dataclass(frozen=True)
class StageMaterial:
    """A physics material as authored."""

    path: str
    static_friction: float | None
    dynamic_friction: float | None
    restitution: float | None
    density: float | None


def leaf(path: str) -> str:
    """The last part of a path."""
    return path.rsplit("/", 1)[-1]


def direction(rotation: Floats, freedom: str) -> Floats:
    """The axis (3,) of a freedom such as `rotX` or `transZ` under a rotation (3, 3)."""
    return rotation[:, "XYZ".index(freedom[-1])]


def extent(bounds: Floats | None) -> float:
    """The diagonal of a box (2, 3), metres; 0 without one."""
    return 0.0 if bounds is None else float(np.linalg.norm(bounds[1] - bounds[0]))


def union(boxes: list[Floats]) -> Floats | None:
    """The box (2, 3) around boxes, or None without any."""
    if not boxes:
        return None
    stacked = np.stack(boxes)
    return np.stack([stacked[:, 0].min(axis=0), stacked[:, 1].max(axis=0)])
