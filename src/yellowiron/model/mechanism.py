"""The mechanism: the machine in SI units and no engine's terms. Machine frame, drawn pose, metres, radians,
kilograms."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.machine_tests import SPARSE, MachineTest, PayloadTemplate
from yellowiron.model.sensor import Sensor
from yellowiron.model.template import Follows, JointType, Material, MeasurementTemplate

Vector = tuple[float, float, float]

DRAWN_OUTSIDE = 1e-6
"""Metres or radians by which a joint may be drawn outside its limits: a micrometre is no more than round-off."""

HELD = 1e-3
"""Metres or radians to either side in which a joint is kept that nothing moves or holds; engines get a weld."""
GRAVITY = 9.81
"""m/s²."""
DEFAULT = "template's default"
"""How an entry of `Cylinder.sources` begins that no sheet gives."""
ESTIMATE = "estimate"
"""How one begins that is what is usual."""
UNKNOWN = "unknown"
"""How an entry of `Cylinder.sources` begins where nothing says the quantity; a closed length is then calibrated."""
PROVISIONAL = "gains provisional"
"""In `Drive.source`: its gains wait for the mass that only the kinematics knows."""
COMPUTED = "gains: a third of what a step"
"""How a drive's source says that its gains were worked out."""
STATED = "template states "
"""In `Drive.source`: before the names of the gains that stay all the same."""


@dataclass(frozen=True)
class BodyPart:
    """A CAD part as it moves with a body: its material (a key of `Mechanism.materials`), its collision approximation
    and where these came from. A `pooled` one need not collide by itself: its body's colliders stand for it."""

    part: str
    role: str | None
    material: str
    collision: str
    mass: float
    source: str = ""
    pooled: bool = False


@dataclass(frozen=True)
class BodyShape:
    """A collider that no CAD part has: a ball of `radius` metres about `center` (machine frame, drawn pose), or with a
    `size` a box of those lengths along the machine's axes, of a material among `Mechanism.materials`."""

    name: str
    center: Vector
    radius: float
    material: str = ""
    size: Vector | None = None


@dataclass(frozen=True, eq=False)
class Body:
    """A rigid body. `origin` is its frame's origin (axes parallel to the machine's in the drawn pose);
    `center_of_mass` and `inertia` (3, 3, kg·m² about the centre of mass) are in the machine frame. `hull` (n, 3):
    corners of the convex hulls of its parts in the machine frame, for extents and ground contact. `shapes` are
    colliders of its own: a hidden wheel has no parts, and a frame drawn in one with its tracks collides as a box.
    `pads` are those with which it stands on the ground while the parking brakes are set, in place of hidden wheels."""

    name: str
    origin: Vector
    mass: float
    center_of_mass: Vector
    inertia: Floats
    parts: tuple[BodyPart, ...]
    hull: Floats
    source: str = ""
    shapes: tuple[BodyShape, ...] = ()
    pads: tuple[BodyShape, ...] = ()


SLOWED = 0.75
"""Of its rated speed: what its whole force may slow a drive by whose speed is limited. Gains that are computed keep to
half to two thirds; stated ones may be too soft, and have no limit then."""


@dataclass(frozen=True)
class Drive:
    """A joint drive. `position` drives hold a target with stiffness and damping, `velocity` drives have damping only.
    N/m and N·s/m (slides) or N·m/rad and N·m·s/rad (pivots); `max_force` in N or N·m; `max_velocity` m/s or rad/s.

    Both are those of the joint's positive direction (a cylinder that extends); `reverse_force` and `reverse_velocity`
    are those of the other (one that retracts), None where they are the same. `armature` is an inertia of the drive's
    own along its coordinate, kg or kg·m²; `brake` what its parking brake holds, N·m."""

    kind: Literal["position", "velocity"]
    stiffness: float
    damping: float
    max_force: float
    max_velocity: float
    source: str = ""
    reverse_force: float | None = None
    reverse_velocity: float | None = None
    armature: float = 0.0
    brake: float = 0.0

    @property
    def forces(self) -> tuple[float, float]:
        """The largest force (N, N·m) in the negative direction and in the positive one, both positive."""
        return self.max_force if self.reverse_force is None else self.reverse_force, self.max_force

    @property
    def speeds(self) -> tuple[float, float]:
        """The rated speed (m/s, rad/s) in the negative direction and in the positive one, both positive."""
        return self.max_velocity if self.reverse_velocity is None else self.reverse_velocity, self.max_velocity

    @property
    def rated(self) -> bool:
        """Whether its speed can be limited by a servo and a damper (MJCF; Newton): it holds a position, has a rated
        speed both ways, and so much damping that its whole force does not slow it by more than `SLOWED`.

        Its force is then clamp(clamp(k·(target − q), −d·v₋, d·v₊) − d·q̇, −F₋, F₊): however far the target, no faster
        than v₋ and v₊, and no stronger than F₋ and F₊. The inner clamp is the servo's.
        """
        both = zip(self.forces, self.speeds, strict=True)
        return self.kind == "position" and all(0.0 < v < math.inf and f <= SLOWED * self.damping * v for f, v in both)

    @property
    def strongest(self) -> float:
        """The larger of its forces: for engines that know one limit."""
        return max(self.forces)

    @property
    def slowest(self) -> float:
        """The smaller of its speeds, 0 where it has none: for engines that know one limit."""
        return min(self.speeds)


@dataclass(frozen=True)
class Spring:
    """A spring and a damper on a joint that nothing drives: its force along the coordinate q is `stiffness`·(rest − q)
    − `damping`·q̇. N/m and N·s/m (slides) or N·m/rad and N·m·s/rad (pivots); `rest` and `hanging` in metres or radians
    from the drawn pose. `rest` counts for a machine on its ground, `hanging` for one whose root is fixed: of one that
    is `as_drawn` they are such that it stays as drawn, either way."""

    stiffness: float
    damping: float
    rest: float = 0.0
    hanging: float = 0.0
    as_drawn: bool = False
    source: str = ""

    def rest_of(self, base: str) -> float:
        """Where it pushes nothing, for a machine whose base is `floating` or `fixed`."""
        return self.hanging if base == "fixed" else self.rest


@dataclass(frozen=True)
class Joint:
    """A joint in the drawn pose, where its coordinate is 0. `body0` is the parent in the tree (for a cut joint: the
    body nearer the root); `axis` is a unit vector, `anchor` a point on it, both in the machine frame. Limits are in
    metres or radians from the drawn pose, None: unlimited. `free` coordinates move without a drive (an oscillating
    axle), where they have one against a `spring`; that of one that `follows` is its leader's times a ratio. `source`
    holds the evidence: template entry, CAD parts, residuals, page and quote of a limit. `armature`, kg·m², is an
    inertia of its own of a hinge that nothing drives, by which engines that iterate hold its loop
    (`kinematics.steadying`)."""

    name: str
    type: JointType
    body0: str
    body1: str
    anchor: Vector
    axis: Vector
    lower: float | None = None
    upper: float | None = None
    cut: bool = False
    free: bool = False
    drive: Drive | None = None
    source: Mapping[str, Any] = field(default_factory=dict)
    follows: Follows | None = None
    spring: Spring | None = None
    armature: float = 0.0

    @property
    def held(self) -> bool:
        """Whether it is kept as drawn, for want of anything that moves or holds it."""
        return (self.lower, self.upper) == (-HELD, HELD) and self.drive is None

    @property
    def swings(self) -> bool:
        """Whether it is a pivot that moves freely: neither a drive nor a spring is on it (an oscillating axle's)."""
        return self.free and self.type == "revolute" and self.drive is None and self.spring is None


@dataclass(frozen=True)
class Cylinder:
    """A hydraulic cylinder. Lengths are between the barrel's and the rod's pivots, metres; of one without pins (its
    halves fixed to the two bodies `barrel` and `rod`) from the foot of its barrel to the end of its rod. `extension` is
    the drawn one (drawn length − closed length); forces in N, `speed` in m/s (extending). `passive` twins follow the
    driven one. `sources` says for every quantity where it came from."""

    name: str
    barrel: str
    rod: str
    slide: str
    barrel_joint: str | None
    rod_joint: str | None
    bore: float
    rod_diameter: float
    stroke: float
    closed_length: float
    drawn_length: float
    pressure: float
    push_force: float
    pull_force: float
    speed: float
    passive: bool = False
    sources: Mapping[str, str] = field(default_factory=dict)

    @property
    def pins(self) -> tuple[str, ...]:
        """The joints at its two ends; none of one that is fixed at both."""
        return tuple(name for name in (self.barrel_joint, self.rod_joint) if name is not None)

    @property
    def extension(self) -> float:
        """How far the cylinder is out in the drawn pose, metres."""
        return self.drawn_length - self.closed_length


@dataclass(frozen=True)
class ActuatorJoint:
    """One joint that an actuator moves, with its sign."""

    joint: str
    sign: int = 1


@dataclass(frozen=True)
class Actuator:
    """What one lever commands. For cylinders the first joint is the driven slide and the others follow through the
    loops; the actuator's coordinate is that slide's, metres from the drawn pose, positive as the actuator's positive
    sense. `falls`: of a winch, how many lines of its rope carry what it moves; 0 of anything else."""

    name: str
    kind: Literal["cylinder", "motor"]
    joints: tuple[ActuatorJoint, ...]
    cylinders: tuple[str, ...] = ()
    falls: int = field(default=0, metadata={SPARSE: True})


@dataclass(frozen=True)
class Loop:
    """A closed loop: the joints around it and the one that is cut. `branch` is the sign of its triangle of pivots (+1,
    −1, or 0 where it has none), by which a flip to the other assembly branch is known."""

    joints: tuple[str, ...]
    cut: str
    branch: int = 0


@dataclass(frozen=True)
class Site:
    """A named frame on a body: `position` and unit `x_axis`, `z_axis` in the machine frame, drawn pose."""

    name: str
    body: str
    position: Vector
    x_axis: Vector = (1.0, 0.0, 0.0)
    z_axis: Vector = (0.0, 0.0, 1.0)
    source: str = ""


@dataclass(frozen=True)
class Mobility:
    """Degrees of freedom relative to the root: `computed` is the rank of the constraint Jacobian taken from the joint
    coordinates, less those that are held as drawn; `grubler` the spatial count (overconstrained loops make it lower),
    `expected` the actuated coordinates plus the joints declared free."""

    computed: int
    expected: int
    grubler: int


@dataclass(frozen=True, eq=False)
class Mechanism:
    """The whole machine. `root` is the articulation's root body; `measurements`, `payload` and `tests` are the
    template's, carried along so that the USD file can be measured and tested alone; `specifications` maps wanted names
    to SI values for the same reason.

    `floating` are the first bodies of chains that no joint ties to the root (rings of track shoes): with what hangs on
    them they lie on the machine, touch it and are no part of its articulation."""

    name: str
    equipment_type: str
    root: str
    bodies: tuple[Body, ...]
    joints: tuple[Joint, ...]
    cylinders: tuple[Cylinder, ...] = ()
    actuators: tuple[Actuator, ...] = ()
    loops: tuple[Loop, ...] = ()
    sites: tuple[Site, ...] = ()
    materials: Mapping[str, Material] = field(default_factory=dict)
    measurements: tuple[MeasurementTemplate, ...] = ()
    specifications: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    mobility: Mobility | None = None
    findings: tuple[Finding, ...] = ()
    sensors: tuple[Sensor, ...] = ()
    floating: tuple[str, ...] = ()
    payload: PayloadTemplate | None = None
    tests: tuple[MachineTest, ...] = ()

    def body(self, name: str) -> Body:
        """The body of that name; `KeyError` if there is none."""
        for body in self.bodies:
            if body.name == name:
                return body
        raise KeyError(name)

    def joint(self, name: str) -> Joint:
        """The joint of that name; `KeyError` if there is none."""
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise KeyError(name)


def chained(mechanism: Mechanism) -> frozenset[str]:
    """The bodies of the floating chains, over their joints that are not cut."""
    found = set(mechanism.floating)
    grown = bool(found)
    while grown:
        more = {j.body1 for j in mechanism.joints if not j.cut and j.body0 in found} - found
        found |= more
        grown = bool(more)
    return frozenset(found)


def hanging(mechanism: Mechanism, bodies: Iterable[str]) -> frozenset[str]:
    """Those bodies and all that hang on them in the tree, in whatever order its joints stand."""
    found = set(bodies)
    tree = [joint for joint in mechanism.joints if not joint.cut]
    while more := {joint.body1 for joint in tree if joint.body0 in found} - found:
        found |= more
    return frozenset(found)


def rolling(mechanism: Mechanism) -> frozenset[str]:
    """The bodies that a pivot of the tree lets turn without limit: wheels, and a slewing body."""
    loose = chained(mechanism)
    pivots = [j for j in mechanism.joints if j.type == "revolute" and not j.cut and j.lower is None and j.upper is None]
    looped = {name for loop in mechanism.loops for name in loop.joints}
    return frozenset(j.body1 for j in pivots if j.name not in looped) - loose


def scrubbing(mechanism: Mechanism) -> frozenset[str]:
    """The wheels of a machine that steers by the speeds of its two sides, on two wheels each: they stand behind each
    other and cannot all roll, so that they slide across in every turn. None of any other machine."""
    ahead = {j.name: j for j in mechanism.joints if abs(j.axis[1]) > max(abs(j.axis[0]), abs(j.axis[2]))}
    motors = [[ahead.get(entry.joint) for entry in a.joints] for a in mechanism.actuators if a.kind == "motor"]
    sides = [[joint for joint in motor if joint is not None] for motor in motors]
    sides = [side for side in sides if side]
    if [len(side) for side in sides] != [2, 2]:
        return frozenset()
    one, other = (side[0].anchor[1] + side[1].anchor[1] for side in sides)
    return frozenset(joint.body1 for side in sides for joint in side) if one * other < 0.0 else frozenset()


def independent_joints(mechanism: Mechanism) -> tuple[str, ...]:
    """Tree joints with a coordinate of their own: the driven slide of each cylinder actuator, every motor joint, every
    driven joint besides, and the joints declared free; none that follows another. In the mechanism's order."""
    passive = {cylinder.slide for cylinder in mechanism.cylinders if cylinder.passive}
    actuated = {
        entry.joint
        for actuator in mechanism.actuators
        for entry in (actuator.joints[:1] if actuator.kind == "cylinder" else actuator.joints)
    }
    return tuple(
        joint.name
        for joint in mechanism.joints
        if not joint.cut
        and joint.follows is None
        and joint.name not in passive
        and (joint.name in actuated or joint.free or joint.drive is not None)
    )


@dataclass(frozen=True)
class Measurement:
    """A specification measured on the mechanism, SI. `role`: `checked` (published), `calibrated` (used to place a
    cylinder, so no proof), `example` (the publisher's example value). `reason` says why `model` is None."""

    name: str
    specification: str
    spec: float | None
    model: float | None
    unit: str
    error_percent: float | None
    role: Literal["checked", "calibrated", "example"]
    definition: str = ""
    reason: str = ""
