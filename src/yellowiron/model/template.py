"""Templates: what is known of an equipment type before any CAD is seen. Plain data; the loader is in `library`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from yellowiron.model.geometry import Color
from yellowiron.model.machine_tests import SPARSE, MachineTest, PayloadTemplate
from yellowiron.model.sensor import SensorTemplate
from yellowiron.model.usual import Usual

JointType = Literal["fixed", "distance", "spherical", "revolute", "prismatic"]
DriveType = Literal["linear", "angular"]
Coupling = Literal["chain", "gear", "rope", "oil", "rod"]
Direction = Literal["lengthwise", "lateral", "vertical"]
Choices = Mapping[str, tuple[str, ...]]
"""Variant name → the choices under which an entry exists; empty: always."""
UNDECIDED = "undecided"
"""Marks fields that say something only until a template's variants are decided."""

VAGUE = "?"
"""What those of a template's words begin with that speak only where nothing else in a name does."""
ITSELF = "!"
"""Under which a template's words have what machines of the type are called, which tells no part of one."""


@dataclass(frozen=True)
class Role:
    """A part name of the hierarchy.

    `rigid` roles are bodies; others move with their nearest rigid ancestor or only group. `kind` tells the aligner
    what geometry to expect: `frame`, `pin`, `barrel`, `rod`, `wheel`, `tyre`, `arm`, `edge`, `group`, of tracks
    `shoe`, `sprocket`, `idler`, `roller`, `carrier`, or "" (anything). `drum`: a wheel that is a steel drum.
    `many`: the role is written `name[*]` and stands for a counted row of parts. `side`: `l`, `r` or "".
    `rigid_when`: the choices under which a rigid role is a body; under others it moves with its nearest rigid
    ancestor. `row`: the row that a concrete part belongs to ("" for parts of no row; see `rows.expand`). `hidden`:
    how a body that no CAD part plays is made from a row's parts (docs: template format, hidden wheels).
    """

    name: str
    parent: str | None
    rigid: bool
    kind: str = ""
    drum: bool = False
    side: str = ""
    optional: bool = False
    many: bool = False
    when: Choices = field(default_factory=dict)
    rigid_when: Choices = field(default_factory=dict)
    row: str = ""
    hidden: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Follows:
    """What a joint's coordinate follows: that of `joint`, of the same type, times `ratio`, plus `offset` (metres or
    radians: where it is while the leader is as drawn). `kind` says what couples them."""

    joint: str
    ratio: float = 1.0
    offset: float = 0.0
    kind: Coupling = "chain"

    @property
    def words(self) -> str:
        """It as people read it: "follows lift by chain, ratio 1"."""
        return f"follows {self.joint} by {self.kind}, ratio {self.ratio:g}"


def by_first_leader(joint: str, every: Mapping[str, Follows]) -> Follows:
    """What a joint follows, told by the first leader of the chain, which follows nothing. `every`: joint → what it
    follows."""
    told = every[joint]
    for _ in every:
        if told.joint not in every:
            break
        above = every[told.joint]
        told = Follows(above.joint, told.ratio * above.ratio, told.offset + told.ratio * above.offset, told.kind)
    return told


@dataclass(frozen=True)
class JointTemplate:
    """A joint entry. `parts` are role names as written in `Body`; limits are numbers (metres, radians), texts naming a
    specification (with an optional leading minus), or None (free). Gains in SI (N/m, N·m/rad …) or None: computed.
    `ring`: of a joint along a row (`shoe[i]`, `shoe[i+1]`), the last part is joined to the first; such a ring is joined
    to nothing else and touches the machine only. `follows`: another joint leads it, and nothing drives it. `direction`:
    its axis as drawn. `positions`: name → where else than as drawn it may be held, metres or radians from there (a pin
    in another hole), or `share_of` a specification; `at`: which is chosen, nothing moves on it then. `rest`: nothing
    drives it and a spring with its stiffness, and a damper, are on it, which push nothing there (m or rad from the
    drawn pose; `AS_DRAWN`: they are stretched so that the machine stands as drawn), under the choices of `rest_when`.
    `documents`: the file name of the user's document that says what it joins (`joint`) or its limits (`limit`).
    """

    name: str
    type: JointType
    parts: tuple[str, str]
    lower: float | str | None = None
    upper: float | str | None = None
    drive: DriveType | None = None
    free: bool = False
    stiffness: float | None = None
    damping: float | None = None
    max_force: float | None = None
    max_velocity: float | None = None
    when: Choices = field(default_factory=dict)
    drive_when: Choices = field(default_factory=dict)
    documents: Mapping[str, str] = field(default_factory=dict)
    ring: bool = False
    follows: Follows | None = None
    direction: Direction | None = None
    positions: Mapping[str, float | str] = field(default_factory=dict, hash=False)
    position_variant: str = ""
    at: float | str | None = None
    rest: float | str | None = None
    rest_when: Choices = field(default_factory=dict)

    @property
    def chosen_by(self) -> str:
        """The variant that says in which of its positions it is held: that of its name, if it states no other."""
        return self.position_variant or self.name.removesuffix("_joint")


AS_DRAWN = "drawn"
"""The choice of a joint's position in which nothing is moved; the rest of a spring that holds the machine as drawn."""


@dataclass(frozen=True)
class Material:
    """Physical and visual properties (the conference paper's JSON-1). Density kg/m³, elasticity (Young) Pa; colour
    linear RGB; texture a path relative to its document. None: not stated. With `repaint` (a user's own document) colour
    and texture replace what the CAD file shows; without it they stand in where the CAD file has no colour.
    `friction_combine`: how its friction meets another's (PhysX' words `average`, `min`, `multiply`, `max`); in MuJoCo
    and Newton a `min` or `multiply` material's own friction rules."""

    name: str
    density: float | None = None
    elasticity: float | None = None
    static_friction: float | None = None
    dynamic_friction: float | None = None
    restitution: float | None = None
    color: Color | None = None
    texture: str | None = None
    roughness: float | None = None
    metalness: float | None = None
    repaint: bool = False
    friction_combine: str | None = None


@dataclass(frozen=True)
class Wanted:
    """A value the template can ask a sheet for. `dimension` is one of: length, angle, mass, pressure, flow, volume,
    force, torque, power, speed, angular_speed, time, count. `synonyms` by language code (`en`, `de`, …); `forbidden`
    words rule a statement out; `concepts` are sets of English words that say it in any language; `sections` support it;
    `mass_of` names the body (or `*`, the whole machine) whose mass it is; `length_of` is `*` for the whole machine's
    length; `in_label_of` another wanted value in whose label it is printed; `low_end_of` one whose ranges it is the
    lower end of. `when`: choices under which it is missed. `usual_weight`: kg for each cubic metre of the cube of the
    length of tracks, or of wheels from front to rear. `usual_length`: of most machines, farthest points, metres."""

    name: str
    dimension: str
    synonyms: Mapping[str, tuple[str, ...]] = field(default_factory=dict, hash=False)
    concepts: tuple[str, ...] = ()
    forbidden: tuple[str, ...] = ()
    sections: tuple[str, ...] = ()
    use: str = ""
    where: str = ""
    mass_of: str | None = None
    length_of: str | None = None
    in_label_of: str | None = None
    low_end_of: str | None = None
    minimum: float | None = None
    maximum: float | None = None
    when: Choices = field(default_factory=dict, hash=False)
    usual_weight: float | None = None
    usual_length: tuple[float, float] | None = None


@dataclass(frozen=True)
class CylinderTemplate:
    """One cylinder of an actuator: its slide joint; `sign` −1 where it retracts when the actuator moves positive;
    `passive` twins follow the driven one (their rod pin is cut).

    One without pins (a mast's ram, a jack) has both its halves fixed to the bodies of its slide: `rams` are the parts
    of each that moves it, (barrel, rod). `rod_through`: the rod comes out at both ends, both areas are the same.
    `specifications`: the wanted names that are others than the actuator's.
    """

    slide: str
    barrel_joint: str | None = None
    rod_joint: str | None = None
    sign: int = 1
    passive: bool = False
    when: Choices = field(default_factory=dict)
    rams: tuple[tuple[str, str], ...] = ()
    rod_through: bool = False
    specifications: Mapping[str, str] = field(default_factory=dict, hash=False)

    @property
    def pins(self) -> tuple[str, ...]:
        """The joints at its barrel's and its rod's ends; none of one that is fixed at both."""
        return tuple(name for name in (self.barrel_joint, self.rod_joint) if name is not None)

    @property
    def joints(self) -> tuple[str, ...]:
        """Its slide, and its pins."""
        return (self.slide, *self.pins)


@dataclass(frozen=True)
class ActuatorTemplate:
    """What one lever commands. `specifications` maps a quantity (bore, rod_diameter, stroke, closed_length, pressure,
    flow, extend_time, retract_time, speed, torque, line_pull, line_speed, falls, low_angle, high_angle) to the wanted
    name that gives it; `defaults` (SI) where no sheet does. `joints` are a `motor`'s. A `winch` moves slides by rope,
    one that `raises` a boom (its hinge, then joints: the first ends the line whose angle is printed) to its angles."""

    name: str
    kind: Literal["cylinder", "motor", "winch"]
    cylinders: tuple[CylinderTemplate, ...] = ()
    joints: tuple[str, ...] = ()
    specifications: Mapping[str, str] = field(default_factory=dict)
    defaults: Mapping[str, float] = field(default_factory=dict)
    source: str = ""
    raises: tuple[str, ...] = ()

    @property
    def slave(self) -> bool:
        """Whether no lever moves it: its cylinders follow what others move, such as one whose oil levels a fork."""
        return bool(self.cylinders) and all(c.passive for c in self.cylinders)


@dataclass(frozen=True)
class SiteTemplate:
    """A named frame on a body. `rule` says where: {"joint": J} (its anchor), {"along": J} (there, upright along that
    slide), {"pointing": J} (there, x along it), {"heel": 0.02} (of the foremost parts), {"floor_of": R} (of its parts),
    {"edge_from": J, "spanning": 0.8} (the point of the body farthest from that joint's axis among parts spanning that
    share of the body's width along the axis), {"point": [x, y, z]} (machine frame)."""

    name: str
    body: str
    rule: Mapping[str, Any]
    when: Choices = field(default_factory=dict, metadata={UNDECIDED: True})


@dataclass(frozen=True)
class MeasurementTemplate:
    """A specification that can be measured on the mechanism, as data: which quantity, after which steps (docs:
    template format). `specification` is the wanted name it is compared with; `definition` the words (and the standard)
    behind it; `unpublished` why the sheet's value is another one's (another steering mode's), so that it is not."""

    name: str
    specification: str
    quantity: Mapping[str, Any]
    steps: tuple[Mapping[str, Any], ...] = ()
    unit: str = "m"
    definition: str = ""
    when: Choices = field(default_factory=dict, metadata={UNDECIDED: True})
    unpublished: str = field(default="", metadata={SPARSE: True})


@dataclass(frozen=True)
class Variant:
    """A declared choice of the template. `decided_by`: `geometry` (the aligner finds it) or `user` (`--set
    NAME=CHOICE`). `needs`: choice → the choices of other variants that it goes with only."""

    name: str
    choices: tuple[str, ...]
    default: str
    decided_by: Literal["geometry", "user"] = "user"
    needs: Mapping[str, Choices] = field(default_factory=dict)


@dataclass(frozen=True)
class UsualHinge:
    """How the hinge that an actuator's cylinders turn usually moves: from the angle `low` to `high` (rad, from the line
    of what it is on to that of what it turns), at a `speed` (rad/s), with a `torque` of so many times the machine's
    weight times the diagonal of its box. `from_drawn`: the angles are counted from the drawn pose instead, in which
    wheels point straight ahead. `sense`: 1 where it turns to larger angles as its actuator moves positive, else −1.
    `common`: only the sense is the type's own."""

    low: float
    high: float
    speed: float
    torque: float
    from_drawn: bool = False
    sense: int = 1
    common: bool = False


COMMON_HINGE = UsualHinge(math.radians(-45.0), math.radians(45.0), math.radians(40.0), 0.1, True, common=True)
"""How a hinge moves of which its type says nothing: over the library's median turn and at its median speed, with its
median torque and half as much again."""


@dataclass(frozen=True)
class Balance:
    """What the `front` of the unladen machine carries (`front`, `rear`: bodies on the ground, without their side): the
    `specification` that gives it, the least and greatest `usual` share (0 to 1) with their `source`, and the `body`
    whose centre of mass is placed by it."""

    body: str
    front: tuple[str, ...]
    rear: tuple[str, ...]
    specification: str
    usual: tuple[float, float] | None = None
    source: str = ""


@dataclass(frozen=True)
class Template:
    """A template with all its documents. `root` is the body that stands for the machine's base; `words`: words of role
    names (`rear frame`) → language → what parts of it are called; `usual`: body → where it usually is; `hinges`:
    actuator → how its hinge usually moves; `shares`: body, without its side → its usual share of the weight, 0 to 1."""

    equipment_type: str
    folder: str
    root: str
    roles: tuple[Role, ...]
    joints: tuple[JointTemplate, ...]
    materials: Mapping[str, Material] = field(default_factory=dict)
    collision: Mapping[str, str] = field(default_factory=dict)
    wanted: tuple[Wanted, ...] = ()
    actuators: tuple[ActuatorTemplate, ...] = ()
    sites: tuple[SiteTemplate, ...] = ()
    measurements: tuple[MeasurementTemplate, ...] = ()
    variants: tuple[Variant, ...] = ()
    sensors: tuple[SensorTemplate, ...] = ()
    payload: PayloadTemplate | None = None
    tests: tuple[MachineTest, ...] = ()
    words: Mapping[str, Mapping[str, tuple[str, ...]]] = field(default_factory=dict)
    usual: Mapping[str, Usual] = field(default_factory=dict)
    hinges: Mapping[str, UsualHinge] = field(default_factory=dict)
    shares: Mapping[str, float] = field(default_factory=dict)
    balance: Balance | None = None

    @property
    def sheet_only(self) -> bool:
        """Whether it says what to ask a sheet for and nothing else: no machine can be built with it."""
        return not self.joints

    def role(self, name: str) -> Role:
        """The role of that name; of a row's member (`shoe_7` of `shoe[*]`) the row's, under the member's name.
        `KeyError` if there is none."""
        for role in self.roles:
            if role.name == name:
                return role
        row = self.row_of(name)
        if row is None:
            raise KeyError(name)
        return replace(self.role(row), name=name, many=False, row=row)

    def depth(self, name: str) -> int:
        """How many roles are above that of a name."""
        depth, above = 0, self.role(name).parent
        while above is not None:
            depth, above = depth + 1, self.role(above).parent
        return depth

    def row_of(self, name: str) -> str | None:
        """The row that a name is a member of (`shoe_7`: `shoe`), also once it is expanded; None for any other name."""
        row, _, number = name.rpartition("_")
        if not number.isdigit():
            return None
        for role in self.roles:
            if (role.many and role.name == row) or (role.row == row and role.name == name):
                return row
        return None

    def knows(self, name: str) -> bool:
        """Whether a name is a role or a member of a row."""
        return any(role.name == name for role in self.roles) or self.row_of(name) is not None

    def joint(self, name: str) -> JointTemplate:
        """The joint of that name; `KeyError` if there is none."""
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise KeyError(name)

    def body_of(self, role_name: str) -> str | None:
        """The rigid role that a role (or a part of a row, `shoe[i]`) is or moves with; None for a group above all
        bodies."""
        role: Role | None = self.role(role_name.partition("[")[0])
        while role is not None and not role.rigid:
            role = self.role(role.parent) if role.parent is not None else None
        return role.name if role is not None else None

    def bodies_of(self, joint: JointTemplate) -> tuple[str | None, str | None]:
        """The two bodies a joint joins, in the order of its `Body` entry."""
        return (self.body_of(joint.parts[0]), self.body_of(joint.parts[1]))

    def default_choices(self) -> dict[str, str]:
        """Every variant's default."""
        return {v.name: v.default for v in self.variants}

    def special(self) -> frozenset[tuple[str, str]]:
        """(variant, choice) of what only goes with some choices of other variants (`Variant.needs`): special machines,
        which are looked for where no common one fits and do not raise what common ones must show."""
        return frozenset((v.name, choice) for v in self.variants for choice in v.needs)

    def go_together(self, choices: Mapping[str, str]) -> bool:
        """Whether none of the choices needs another variant's choice than is among them (`Variant.needs`)."""
        return all(
            holds(v.needs.get(choices.get(v.name, v.default), {}), {**self.default_choices(), **choices})
            for v in self.variants
        )


def without_side(name: str) -> str:
    """A body's name without its side: `front_wheel` for `front_wheel_l`."""
    return name.removesuffix("_l").removesuffix("_r")


def holds(when: Choices, chosen: Mapping[str, str]) -> bool:
    """Whether the choices made are among those that a `when` names."""
    return all(chosen.get(name) in allowed for name, allowed in when.items())


def _chosen(role: Role, chosen: Mapping[str, str]) -> Role:
    """A role under the choices. One that is no body under them, and of which no geometry is expected, may be absent: a
    frame is then a piece of the one that it moves with."""
    welded = role.rigid and not holds(role.rigid_when, chosen)
    absent = welded and role.kind in ("", "frame") and not role.many
    rigid, optional = role.rigid and not welded, role.optional or absent
    return replace(role, when={}, rigid_when={}, rigid=rigid, optional=optional)


def choose(template: Template, choices: Mapping[str, str]) -> Template:
    """The template with its variants decided: only the entries that exist under `choices` (defaults elsewhere)
    remain."""
    chosen = {**template.default_choices(), **choices}

    roles = tuple(_chosen(r, chosen) for r in template.roles if holds(r.when, chosen))
    there = [j for j in template.joints if holds(j.when, chosen)]
    drives = [j.drive if holds(j.drive_when, chosen) else None for j in there]
    joints = tuple(
        replace(_unsprung(_held(j, chosen), chosen), when={}, drive_when={}, drive=drive)
        for j, drive in zip(there, drives, strict=True)
    )
    kept, present = {j.name for j in joints}, {r.name for r in roles}
    actuators = []
    for actuator in template.actuators:
        cylinders = tuple(
            replace(c, when={}, rams=tuple(pair for pair in c.rams if present.issuperset(pair)))
            for c in actuator.cylinders
            if holds(c.when, chosen) and c.slide in kept
        )
        motors = tuple(
            j
            for j in actuator.joints
            if j in kept and template.joint(j).drive and holds(template.joint(j).drive_when, chosen)
        )
        if cylinders or motors:
            own = {k: name for c in cylinders for k, name in c.specifications.items()}
            specifications = {**actuator.specifications, **own}
            actuators.append(replace(actuator, cylinders=cylinders, joints=motors, specifications=specifications))
    sites = tuple(replace(s, when={}) for s in template.sites if holds(s.when, chosen))
    return replace(
        template,
        roles=roles,
        joints=joints,
        sites=sites,
        payload=template.payload.among({s.name for s in sites}) if template.payload is not None else None,
        actuators=tuple(actuators),
        variants=(),
        sensors=tuple(replace(s, when={}) for s in template.sensors if holds(s.when, chosen)),
        measurements=tuple(replace(m, when={}) for m in template.measurements if holds(m.when, chosen)),
        tests=tuple(replace(t, when={}) for t in template.tests if holds(t.when, chosen)),
        wanted=tuple(replace(w, when={}) for w in template.wanted if holds(w.when, chosen)),
    )


def _held(joint: JointTemplate, chosen: Mapping[str, str]) -> JointTemplate:
    """A joint of several positions in the one that is chosen; any other as it is."""
    at = joint.positions.get(chosen.get(joint.chosen_by, AS_DRAWN), 0.0)
    return replace(joint, at=at, positions={}) if joint.positions else joint


def _unsprung(joint: JointTemplate, chosen: Mapping[str, str]) -> JointTemplate:
    """A joint without its spring where that is not chosen; any other as it is."""
    if joint.rest is None or holds(joint.rest_when, chosen):
        return replace(joint, rest_when={})
    return replace(joint, rest=None, rest_when={}, stiffness=None, damping=None)


def in_position(template: Template) -> Template:
    """The template with joints that are held as drawn welded, and free those that are first moved to their place."""

    def placed(joint: JointTemplate) -> JointTemplate:
        if joint.at is None:
            return joint
        return (
            replace(joint, free=True) if joint.at else replace(joint, type="fixed", free=False, lower=None, upper=None)
        )

    return replace(template, joints=tuple(map(placed, template.joints)))
