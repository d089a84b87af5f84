"""The machine frame from solved roles: +X forward, +Y left, +Z up, z = 0 under the wheels (docs/architecture.md)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.facing import UNTOLD, Facing
from yellowiron.alignment.features.contacts import SharedAxis
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.features.tracks import Track
from yellowiron.alignment.features.wheels import Wheel
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.alignment.structure.observation import slewing_joints
from yellowiron.alignment.tolerances import SAME_DIRECTION
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.vectors import unit

RUN = 0.05
"""Shoes this near to the lowest, as a share of the track's height, are on the ground."""
_EVEN_RUN = 0.005
"""Shoes this near to the middle of those, as a share of the same, lie flat: those next to the wheels already rise."""
LYING = 0.01
"""Axles within this sine lie in a plane, and wheels within this share of their radius stand on one."""
_ALIKE_WHEELS, _LEVELLED = 0.02, 4
"""Radii that differ by less are one size; where they differ, so many times the ground is laid under the wheels anew."""
LEANING = 0.2
"""Least level part of the unit way from a boom's section to the one in it that tells which way the boom points."""
SNAP = 1e-6
"""A rotation this near to a signed permutation of the axes is that permutation."""

_GROUND = "no wheels were found, so the ground is taken under the lowest part"


@dataclass(frozen=True, eq=False)
class MachineFrame:
    """`matrix` (4, 4) takes CAD metres to the machine frame; `doubts` says what had to be guessed, `against` what was
    found and a person said otherwise; `told`: a person said what is ahead."""

    matrix: Floats
    doubts: tuple[str, ...] = ()
    against: tuple[str, ...] = ()
    told: bool = False

    @property
    def facing_doubt(self) -> str:
        """Why the machine may face otherwise; empty where that is sure."""
        return next((words for words in self.doubts if words != _GROUND), "")


@dataclass(frozen=True, eq=False)
class _Scene:
    """What a frame is read from: joint → its axis, body → its cluster, role → its kind, the wheels that are bodies
    (`rolling`) among all `wheels`."""

    solids: tuple[Solid, ...]
    structure: Structure
    template: Template
    wheels: list[Wheel]
    tracks: Sequence[Track]
    axes: dict[str, SharedAxis]
    cluster_of: dict[str, int]
    kinds: dict[str, str]
    rolling: list[Wheel]

    def members(self, body: str) -> frozenset[int]:
        """The solids of a body's cluster."""
        return self.structure.clusters[self.cluster_of[body]].members


def machine_frame(
    solids: tuple[Solid, ...], structure: Structure, solution: Solution, wheels: list[Wheel], template: Template,
    tracks: Sequence[Track] = (), facing: Facing = UNTOLD,
) -> MachineFrame:  # fmt: skip
    """The frame: up along the axis about which the machine turns or bends, left along the root's wheels or across its
    tracks, forward towards the working arms; and as a person said that it faces (`facing`). What is not there is
    guessed, and said so."""
    # A ball's pin points anywhere.
    turned_about = {j: h for j, h in solution.hinge_of.items() if template.joint(j).type != "spherical"}
    axes = {j: structure.axes[structure.hinges[h].axis] for j, h in turned_about.items()}
    cluster_of = {b: c for c, b in solution.body_of.items()}
    turning = [structure.clusters[c] for _, c in sorted(cluster_of.items())]
    rolling = [wheels[cluster.number] for cluster in turning if cluster.kind == "wheel"]
    kinds = {r.name: r.kind for r in template.roles}
    scene = _Scene(solids, structure, template, wheels, tracks, axes, cluster_of, kinds, rolling)
    doubts: list[str] = []
    flat = _ground_normal(scene) if not tracks else _track_normal(scene, tracks[0])
    swing = _swing(scene, flat)
    up = _up(scene, swing, flat, doubts)
    left = tracks[0].axis if tracks else _across_yokes(scene, swing)
    left = _left(scene, swing, up) if left is None else left
    if left is None:
        if not axes and not rolling:
            turned = np.eye(4)
            turned[:3, :3] = facing.obeyed(np.eye(3))
            words = "no joints and no wheels were found: the CAD file's own axes are taken"
            return MachineFrame(turned, () if facing.forward is not None else (words,))
        left = np.eye(3)[int(np.argmin(np.abs(up)))]
        doubts.append("left is guessed: no wheel or pitch axis was found")
    left = unit(left - (left @ up) * up)
    forward = np.cross(left, up)
    sense = _forward_sense(scene, forward)
    if sense == 0:
        doubts.append("forward is guessed: no arm and no other body tells it")
    elif sense < 0:
        forward, left = -forward, -left
    read = np.array([forward, left, up])
    rotation = _snapped(facing.obeyed(read))
    against = facing.against(read) if not doubts else ()
    if facing.forward is not None:
        doubts.clear()
    up = rotation[2]
    origin = _origin(scene, axes[swing] if swing else None, up)
    matrix = np.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = np.round(-rotation @ origin, 12) + 0.0
    return MachineFrame(matrix, tuple(doubts), against, facing.forward is not None)


def _up(scene: _Scene, swing: str | None, flat: Floats | None, doubts: list[str]) -> Floats:
    """The swing axis, else the normal of the ground (`flat`), else a guess; away from the wheels or tracks. What had to
    be guessed goes to `doubts`."""
    if swing is not None:
        up = scene.axes[swing].direction
    elif flat is not None:
        # Wheels that are steered turn on upright pins.
        upright = [a.direction for a in scene.axes.values() if abs(float(a.direction @ flat)) > SAME_DIRECTION]
        up = upright[0] if upright else flat
        if not upright and len(scene.tracks) < 2 and not _stand_alike(scene.rolling, flat):
            doubts.append("up is the normal of the wheels' plane")
    else:
        up = _up_guess(_common_direction(list(scene.axes.values())))
        if scene.axes:
            doubts.append("up is guessed: no wheels and no swing axis were found")
    pointed = next((t.above for t in scene.tracks if t.above is not None), None)
    if pointed is not None:
        up = up if float(up @ pointed) > 0.0 else -up
    elif scene.rolling or scene.tracks:
        below = np.mean([*(w.center for w in scene.rolling), *(t.center for t in scene.tracks)], axis=0)
        if float((_above(scene) - below) @ up) < 0:
            up = -up
    elif scene.axes and "wheel" in scene.kinds.values():
        doubts.append(_GROUND)
    return up


def _middle(solids: list[Solid]) -> Floats:
    if not solids:
        return np.zeros(3)
    weights = np.array([max(s.volume, 1e-12) for s in solids])
    return np.asarray(weights @ np.array([s.center for s in solids]) / weights.sum(), dtype=np.float64)


def _ground_normal(scene: _Scene) -> Floats | None:
    """The normal of the plane that the wheels stand on, whatever their sizes; either way up."""
    wheels = scene.rolling
    if len(wheels) < 3:
        return None
    centres, radii = np.array([w.center for w in wheels]), np.array([w.radius for w in wheels])
    _, spread, axes = np.linalg.svd(centres - centres.mean(axis=0))
    if not spread[1] > 0.2 * spread[0]:
        return None
    normal = np.asarray(axes[2], dtype=np.float64)
    if np.ptp(radii) < _ALIKE_WHEELS * radii.min():
        return normal
    if float((_above(scene) - centres.mean(axis=0)) @ normal) < 0.0:
        normal = -normal
    for _ in range(_LEVELLED):
        feet = centres - np.outer(radii, normal)
        other = np.linalg.svd(feet - feet.mean(axis=0))[2][2]
        normal = np.asarray(other if float(other @ normal) > 0.0 else -other, dtype=np.float64)
    return normal


def _track_normal(scene: _Scene, track: Track) -> Floats:
    """The normal of the run on the ground: the shoes' middles that are farthest from the rest of the machine. The whole
    loop need not be even about its length."""
    if track.above is not None:
        return _square_run(track, track.above)
    normal = np.cross(track.axis, track.along)
    away = track.center - _middle([s for s in scene.solids if all(s.index not in shoe for shoe in track.shoes)])
    return _square_run(track, normal if float(away @ normal) < 0.0 else -normal)


def _square_run(track: Track, normal: Floats) -> Floats:
    """A normal, square to what lies on the ground."""
    heights = track.centers @ normal
    high = float(np.ptp(heights))
    level = float(np.median(heights[heights < heights.min() + RUN * high]))
    run = track.centers[np.abs(heights - level) < _EVEN_RUN * high]
    if len(run) > 2:
        along = np.linalg.svd(run - run.mean(axis=0))[2][0]
        square = np.cross(track.axis, along)
        normal = square if float(square @ normal) > 0.0 else -square
    return np.asarray(normal, dtype=np.float64)


def _above(scene: _Scene) -> Floats:
    """The middle of what is no wheel."""
    return _middle([s for s in scene.solids if all(s.index not in w.members for w in scene.wheels)])


def _stand_alike(wheels: list[Wheel], normal: Floats) -> bool:
    """Whether four wheels or more stand on one plane with this normal, on axles that lie along it: it is the ground."""
    if len(wheels) < 4 or any(abs(float(w.direction @ normal)) > LYING for w in wheels):
        return False
    heights = np.array([w.center @ normal - w.radius for w in wheels])
    return float(np.ptp(heights)) < LYING * min(w.radius for w in wheels)


def _swing(scene: _Scene, flat: Floats | None) -> str | None:
    """The root's joint about the vertical: the one along the wheels' plane's normal, else the one to another frame. No
    knuckle's, of which there is one on either side."""
    best: tuple[float, str] | None = None
    for name, other in _on_root(scene):
        upright = abs(float(scene.axes[name].direction @ flat)) if flat is not None else 0.0
        score = upright if flat is not None else float(scene.kinds[other] == "frame")
        if score > 0.8 and (best is None or score > best[0]):
            best = (score, name)
    return best[1] if best is not None else None


def _on_root(scene: _Scene) -> list[tuple[str, str]]:
    """The root's joints to what is no cylinder and no wheel, and has no side; with that body."""
    template, found = scene.template, []
    for name in sorted(scene.axes):
        bodies = template.bodies_of(template.joint(name))
        if template.root not in bodies:
            continue
        other = bodies[1] if bodies[0] == template.root else bodies[0]
        if other is not None and scene.kinds[other] not in ("barrel", "rod", "wheel") and not template.role(other).side:
            found.append((name, other))
    return found


def _across_yokes(scene: _Scene, swing: str | None) -> Floats | None:
    """Across the line from one yoke's pin to the other's, where two frames turn about the upright on the root: what
    rolls in them is steered, and tells nothing. None where they are not two, or on one line."""
    if swing is None:
        return None
    along = scene.axes[swing].direction
    pins = [
        scene.axes[name].origin
        for name, other in _on_root(scene)
        if scene.kinds[other] == "frame" and abs(float(scene.axes[name].direction @ along)) > SAME_DIRECTION
    ]
    if len(pins) != 2:
        return None
    across = np.asarray(np.cross(along, pins[1] - pins[0]), dtype=np.float64)
    return across if np.linalg.norm(across) > 1e-6 else None


def _common_direction(axes: list[SharedAxis]) -> Floats | None:
    if not axes:
        return None
    directions = np.array([ln.direction for ln in axes])
    alike = (np.abs(directions @ directions.T) > SAME_DIRECTION).sum(axis=1)
    return np.asarray(directions[int(np.argmax(alike))], dtype=np.float64)


def _up_guess(pitch: Floats | None) -> Floats:
    """CAD's z, unless the joints turn about it; then y."""
    z = np.array([0.0, 0.0, 1.0])
    if pitch is None or abs(float(pitch @ z)) < 0.7:
        return z if pitch is None else unit(z - (z @ pitch) * pitch)
    y = np.array([0.0, 1.0, 0.0])
    return unit(y - (y @ pitch) * pitch)


def _left(scene: _Scene, swing: str | None, up: Floats) -> Floats | None:
    """The axis of the wheels on the root's side of the swing, else the commonest joint axis across `up`."""
    found = [
        scene.wheels[scene.structure.clusters[scene.cluster_of[b]].number]
        for b in sorted(_joined_to_root(scene.template, swing))
        if b in scene.cluster_of and scene.structure.clusters[scene.cluster_of[b]].kind == "wheel"
    ]
    if found:
        first = found[0].direction
        total = np.sum([w.direction if w.direction @ first > 0 else -w.direction for w in found], axis=0)
        return np.asarray(total, dtype=np.float64)
    across = [ln for ln in scene.axes.values() if abs(float(ln.direction @ up)) < 0.3]
    return _common_direction(across)


def _joined_to_root(template: Template, swing: str | None) -> set[str]:
    """The bodies that joints other than the swing and those of rods join to the root."""
    joints = [j for j in template.joints if j.type != "prismatic" and j.name != swing]
    kinds = {r.name: r.kind for r in template.roles}
    reached = {template.root}
    grown = True
    while grown:
        grown = False
        for joint in joints:
            a, b = template.bodies_of(joint)
            if a is None or b is None or (a in reached) == (b in reached) or kinds[a] == "rod" or kinds[b] == "rod":
                continue
            reached |= {a, b}
            grown = True
    return reached


def _forward_sense(scene: _Scene, forward: Floats) -> int:
    """Whether the arms lie ahead of the root (+1) or behind it (−1); without the one or the other, the names `front`
    and `rear`, or the last arms ahead of the first. Of a machine that slews the sections of its boom come out ahead,
    wherever that is pinned: a crane's raised boom may stand behind the middle of what carries it."""
    kinds, template = scene.kinds, scene.template

    def centre(bodies: list[str]) -> Floats | None:
        members = [i for b in bodies if b in scene.cluster_of for i in scene.members(b)]
        return _middle([scene.solids[i] for i in sorted(members)]) if members else None

    root = centre([template.root])
    arms = centre([b for b in kinds if kinds[b] == "arm" and template.role(b).rigid])
    front = centre([b for b in kinds if "front" in b.split("_")])
    rear = centre([b for b in kinds if "rear" in b.split("_")])
    depths = {b: template.depth(b) for b in scene.cluster_of if kinds[b] == "arm"}
    last, first = (
        centre([b for b in depths if depths[b] == end(depths.values())]) if depths else None for end in (max, min)
    )
    for joint in template.joints if slewing_joints(template) else ():
        ends = template.bodies_of(joint)
        if joint.type == "prismatic" and all(b is not None and kinds[b] == "arm" for b in ends):
            one, other = (centre([str(b)]) for b in ends)
            out = None if one is None or other is None else other - one
            if out is not None and abs(float(out @ forward)) > LEANING * float(np.linalg.norm(out)):
                return 1 if float(out @ forward) > 0 else -1
    for ahead, behind in ((arms, root), (front, rear), (last, first)):
        if ahead is not None and behind is not None and abs(float((ahead - behind) @ forward)) > 1e-6:
            return 1 if float((ahead - behind) @ forward) > 0 else -1
    return 0


def _snapped(rotation: Floats) -> Floats:
    nearest = np.round(rotation)
    if np.abs(rotation - nearest).max() < SNAP and np.allclose(nearest @ nearest.T, np.eye(3)):
        return np.asarray(nearest + 0.0, dtype=np.float64)
    return rotation


def _origin(scene: _Scene, swing: SharedAxis | None, up: Floats) -> Floats:
    """The ground under the swing axis, else under the root's centre."""
    solids, root = scene.solids, scene.template.root
    if swing is not None:
        point = swing.origin
    else:
        members = scene.members(root) if root in scene.cluster_of else range(len(solids))
        low = np.min([solids[i].low for i in members], axis=0)
        high = np.max([solids[i].high for i in members], axis=0)
        point = 0.5 * (low + high)
    heights = [_lowest(w, up) for w in scene.rolling] + [_level(t, up) for t in scene.tracks] or [
        float((s.points @ up).min()) for s in solids
    ]
    ground = min(heights)
    return np.asarray(point + (ground - float(point @ up)) * up, dtype=np.float64)


def _lowest(wheel: Wheel, up: Floats) -> float:
    tilt = abs(float(wheel.direction @ up))
    return (
        float(wheel.center @ up) - wheel.radius * float(np.sqrt(max(0.0, 1 - tilt * tilt))) - 0.5 * wheel.width * tilt
    )


def _level(track: Track, up: Floats) -> float:
    """Where a track lies on the ground: the height of its lower run's shoes, of which one at an end may dip deeper."""
    lowest = np.array([float((points @ up).min()) for points in track.points])
    height = float(lowest.max() - lowest.min())
    return float(np.median(lowest[lowest < lowest.min() + RUN * height]))
