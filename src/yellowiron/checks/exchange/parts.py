"""Links and joints of a file as the rules' values. Metres, kilograms, radians, all joints at their zero."""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.checks.islands import build_islands
from yellowiron.checks.values import ANGULAR, LINEAR, Side, StageBody, StageJoint, Units
from yellowiron.checks.view import View
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import unit

_FREEDOMS: Mapping[str, tuple[str, ...]] = {
    "fixed": (),
    "revolute": ("rotX",),
    "prismatic": ("transX",),
    "spherical": ANGULAR,
    "planar": ("transY", "transZ", "rotX"),
    "free": (*LINEAR, *ANGULAR),
    "distance": (*LINEAR, *ANGULAR),
}
_NOTHING = 0.01
"""kg: what stands between the pivots of a ball weighs less."""
_ONE_POINT = 1e-6
"""Metres."""


@dataclass(frozen=True, eq=False)
class LinkRead:
    """A link: `pose` (4, 4) of its frame in the model; `mass`, `center` (3,) and `inertia` (3, 3; about the centre) in
    the model's axes, None where the file gives no mass: then it is a frame, or stands still."""

    name: str
    pose: Floats
    mass: float | None = None
    center: Floats | None = None
    inertia: Floats | None = None


@dataclass(frozen=True, eq=False)
class JointRead:
    """A joint between two links ("" the world): `kind` one of fixed, revolute, prismatic, spherical, planar, free,
    distance (limits from the drawn one); `anchors` (3,) at either side and `axis` (3,) in the model. `moved`: whether
    something drives or holds it; `pulled`: whether a driven distance spans it."""

    name: str
    kind: str
    parent: str
    child: str
    anchors: tuple[Floats, Floats]
    axis: Floats
    lower: float | None = None
    upper: float | None = None
    cut: bool = False
    moved: bool = False
    pulled: bool = False
    leader: str | None = None
    ratio: float = 1.0
    offset: float = 0.0


def view_of(name: str, links: Iterable[LinkRead], joints: Sequence[JointRead]) -> View:
    """A file's links and joints as a stage's: frames without mass are one with what they are fixed to, and hinges in a
    row through one point, with nothing of weight between, are the ball that they stand for."""
    by_name = {link.name: link for link in links}
    own, kept = _without_frames(by_name, list(joints))
    bodies = {name: _body(by_name[name]) for name in by_name if own[name] == name and _is_body(by_name[name], kept)}
    merged = _with_balls(bodies, kept)
    stage = tuple(_joint(j) for j in merged if j.parent in bodies or j.child in bodies)
    used = {path for joint in stage for path in joint.bodies}
    standing = {n: b for n, b in bodies.items() if n in used or (b.mass or 0.0) > _NOTHING}
    return View(
        name=name, units=Units(1.0, 1.0, "Z", 1.0, 1.0), layer_units=(), bodies=standing, joints=stage, colliders=(),
        materials=(), roots=(), self_collision={}, scenes=(), solver=(), lost_filters=(), groundless=(),
        not_numbers=(), broken=(), missing_assets=(), absolute_paths=(), stray_physics=(),
        islands=build_islands(standing, stage, ()),
    )  # fmt: skip


def with_loose(view: View, names: Collection[str]) -> View:
    """The same, with joints that are meant to move freely said to be."""
    joints = tuple(replace(j, record={"free": True}) if j.name in names else j for j in view.joints)
    return replace(view, joints=joints, islands=build_islands(view.bodies, joints, ()))


def _is_body(link: LinkRead, joints: Sequence[JointRead]) -> bool:
    return link.mass is not None or any(link.name == j.child and j.kind != "fixed" for j in joints)


def _without_frames(links: Mapping[str, LinkRead], joints: list[JointRead]) -> tuple[dict[str, str], list[JointRead]]:
    """Which link each is one with, and the joints that are left: a link without mass is fixed to another as a frame on
    it (a sensor's; the root that ROS wants without mass)."""
    own = {name: name for name in links}

    def of(name: str) -> str:
        while own.get(name, name) != name:
            name = own[name]
        return name

    left = []
    for joint in joints:
        ends = of(joint.parent), of(joint.child)
        bare = [end for end in ends if end in links and links[end].mass is None]
        if joint.kind == "fixed" and bare and not joint.cut and all(end in links for end in ends):
            frame = ends[1] if ends[1] in bare else ends[0]
            own[frame] = ends[0] if frame == ends[1] else ends[1]
            continue
        left.append(joint)
    return {name: of(name) for name in links}, [_between(j, of(j.parent), of(j.child)) for j in left]


def _between(joint: JointRead, parent: str, child: str) -> JointRead:
    return replace(joint, parent=parent, child=child)


def _with_balls(bodies: dict[str, StageBody], joints: Sequence[JointRead]) -> list[JointRead]:
    """Three hinges through one point, with next to nothing between them, as one ball; those links leave `bodies`."""
    after = {j.parent: j for j in joints if j.kind == "revolute" and j.lower is None}
    gone: set[str] = set()
    made = []
    for joint in joints:
        row = [joint]
        while len(row) < 3 and (following := _next(row[-1], after, bodies, joints)) is not None:
            row.append(following)
        through = all(np.linalg.norm(j.anchors[0] - joint.anchors[0]) < _ONE_POINT for j in row)
        hinges = joint.kind == "revolute" and joint.lower is None and joint.name not in gone
        if len(row) == 3 and through and hinges and abs(np.linalg.det([j.axis for j in row])) > 0.1:
            gone.update(j.name for j in row)
            for between in row[:2]:
                bodies.pop(between.child)
            name = _common([j.name for j in row])
            made.append(JointRead(name, "spherical", joint.parent, row[-1].child, joint.anchors, joint.axis))
        elif joint.name not in gone:
            made.append(joint)
    return made


def _next(
    joint: JointRead, after: Mapping[str, JointRead], bodies: Mapping[str, StageBody], joints: Sequence[JointRead]
) -> JointRead | None:
    body = bodies.get(joint.child)
    alone = sum(joint.child in (j.parent, j.child) for j in joints) == 2
    return after.get(joint.child) if body is not None and alone and (body.mass or 0.0) < _NOTHING else None


def _common(names: Sequence[str]) -> str:
    """What names begin with alike, without the last separator."""
    alike = itertools.takewhile(lambda letters: len(set(letters)) == 1, zip(*names, strict=False))
    return "".join(letters[0] for letters in alike).rstrip("_-. ") or names[0]


def _body(link: LinkRead) -> StageBody:
    given = link.inertia
    moments = None if given is None else np.array(np.linalg.eigvalsh(0.5 * (given + given.T)), dtype=np.float64)
    return StageBody(
        path=link.name, parent_body="", pose=link.pose, scale=np.ones(3), sheared=False, mirrored=False, enabled=True,
        kinematic=False, mass=link.mass, density=None, center_of_mass=link.center, inertia=moments, bounds=None,
        solid=None, has_collider=bool(link.mass),  # its shapes are not read: without a mass it has none
    )  # fmt: skip


def _joint(joint: JointRead) -> StageJoint:
    turn = axes_about(joint.axis)
    ends = zip((joint.parent, joint.child), joint.anchors, strict=True)
    first, second = (Side((end,) if end else (), (), end, at, turn, 1.0) for end, at in ends)
    return StageJoint(
        path=joint.name, type="generic" if joint.kind in ("planar", "free") else joint.kind, sides=(first, second),
        enabled=True, cut=joint.cut, freedoms=_FREEDOMS[joint.kind], lower=joint.lower, upper=joint.upper,
        actuated=joint.moved, held=joint.leader is not None or joint.pulled, leader=joint.leader, ratio=joint.ratio,
        offset=joint.offset,
    )  # fmt: skip


def axes_about(axis: Floats) -> Floats:
    """A right-handed frame (3, 3; columns) whose first axis is a vector (3,)."""
    first = unit(axis)
    second = unit(np.cross(first, np.eye(3)[int(np.argmin(np.abs(first)))]))
    return np.column_stack([first, second, np.cross(first, second)])


def numbers(text: str | None, count: int, *, where: str, default: Sequence[float] = ()) -> Floats:
    """So many numbers of an attribute or element, its default where it is not written; `YellowironError` where these
    are none."""
    if text is None or not text.strip():
        return np.array(default or [0.0] * count, dtype=np.float64)
    try:
        found = np.array([float(word) for word in text.split()], dtype=np.float64)
    except ValueError:
        found = np.zeros(0)
    if found.shape != (count,):
        raise YellowironError(
            f"'{text.strip()[:60]}' is not {count} number{'s' if count > 1 else ''}",
            where=where,
            hint="Correct the file, or write it again.",
        )
    return found


def inertia_of(entries: Mapping[str, str], *, where: str) -> Floats:
    """An inertia (3, 3) of `ixx` … `izz`."""
    at = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    made = np.zeros((3, 3))
    for name, (i, j) in at.items():
        made[i, j] = made[j, i] = numbers(entries.get(name), 1, where=where)[0]
    return made
