"""From clusters and hinges to a machine that can be described: its root, its tree, what each body is and why."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from yellowiron.alignment.features.tracks import Track
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.alignment.structure.loops import Edge, bridges, components
from yellowiron.alignment.structure.observation import Observation
from yellowiron.alignment.tolerances import SAME_DIRECTION, UPRIGHT
from yellowiron.model.finding import Finding
from yellowiron.model.found import FoundBody, FoundJoint, FoundMachine
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import triple

STANDS = 0.05
"""What reaches down to this share of the machine's height stands on the ground."""
LEVER = 0.01
"""A piece of less than this share of the machine's surface is a latch or lever of it."""
KIN = 0.6
"""A body bears the name of an assembly that this share of its surface is in."""
SOME = 3


def describe(
    name: str, observation: Observation, structure: Structure, edges: Sequence[Edge], tracks: Sequence[Track],
    apart: int,
) -> FoundMachine:  # fmt: skip
    """The machine with its root first and its bodies from there outward; pieces that no joint ties together are welded,
    with a finding. `apart`: how many parts were left out."""
    pieces = _pieces(observation, structure, edges)
    bodies = sorted(c for p in pieces for c in p)
    edges = [e for e in edges if e.a in bodies]
    up = _up(observation, structure, edges, tracks)
    root = _root(observation, structure, edges, bodies, up, tracks)
    welds = _welds(observation, structure, pieces, root)
    order = _outward(root, [*((e.a, e.b) for e in edges), *welds])
    number = {c: k for k, c in enumerate(order)}
    single = bridges(edges)
    upright = {e for e in edges if not e.slide and abs(float(structure.axes[e.axis].direction @ up)) > UPRIGHT}
    kinds = _kinds(structure, edges, root, upright)
    found = [_body(observation, structure, c, kinds.get(c, ""), c == root, bool(tracks)) for c in order]

    def rank(e: Edge) -> tuple[int, int, bool]:
        return max(number[e.a], number[e.b]), min(number[e.a], number[e.b]), e.slide

    joints = [
        _joint(observation, structure, e, number, e not in single, e in upright) for e in sorted(edges, key=rank)
    ]  # fmt: skip
    findings = _remarks(observation, structure, found, number, edges, tracks, apart)
    for a, b in sorted(tuple(sorted((number[a], number[b]))) for a, b in welds):
        nowhere = (0.0, 0.0, 0.0)
        reason = "no pin, bore or rod was found that joins them"
        joints.append(FoundJoint("fixed", a, b, nowhere, (1.0, 0.0, 0.0), 0.0, (), reason))
        words = f"No joint ties it to {some(found[a].parts)}: it is welded there."
        hint = "If it turns or slides, change the joint's type in joints.json."
        findings.append(Finding("ALN020", "warning", some(found[b].parts), words, hint))
    return FoundMachine(name, tuple(found), 0, tuple(joints), len(tracks), tuple(findings))


def _pieces(observation: Observation, structure: Structure, edges: Sequence[Edge]) -> list[set[int]]:
    """The pieces of the machine that joints tie together, without its latches and levers, unless it has only these."""
    total = sum(surface(observation, structure, c) for c in range(len(structure.clusters)))
    pieces = components(edges)
    large = [p for p in pieces if sum(surface(observation, structure, c) for c in p) > LEVER * total]
    return large or pieces


def _kinds(structure: Structure, edges: Sequence[Edge], root: int, upright: set[Edge]) -> dict[int, str]:
    """Cluster → what body it is, for those that are told by their shape or joints: a frame is the root, or turns
    upright on it; an arm swings."""
    frames = {root} | {c for e in upright if root in (e.a, e.b) for c in (e.a, e.b)}
    rolling = {
        c for e in edges if "wheel" in (structure.clusters[e.a].kind, structure.clusters[e.b].kind) for c in (e.a, e.b)
    }
    swinging = {c for e in edges if not e.slide and e not in upright for c in (e.a, e.b)} - rolling
    kinds = dict.fromkeys(swinging, "arm") | dict.fromkeys(frames, "frame")
    return kinds | {c: cluster.kind for c, cluster in enumerate(structure.clusters) if cluster.kind}


def surface(observation: Observation, structure: Structure, c: int) -> float:
    """The surface of a cluster, m²."""
    return sum(observation.solids[i].surface for i in sorted(structure.clusters[c].members))


def across(axis: Floats) -> Floats:
    """The direction across an axis that is nearest to the CAD file's z; to y where the axis is along z."""
    axis = axis / np.linalg.norm(axis)
    up = np.eye(3)[2 if abs(float(axis[2])) < 0.7 else 1]
    up = up - (up @ axis) * axis
    return np.asarray(up / np.linalg.norm(up), dtype=np.float64)


def some(names: Sequence[str]) -> str:
    """A few names."""
    return ", ".join(names[:SOME]) + (", …" if len(names) > SOME else "")


def _up(observation: Observation, structure: Structure, edges: Sequence[Edge], tracks: Sequence[Track]) -> Floats:
    """The upright: across the tracks, or the wheels' plane; else the axis of the widest hinge in no chain that lies
    across the others; else what `across` says."""
    axes = [structure.axes[e.axis] for e in edges if not e.slide]
    pitch = np.eye(3)[1]
    if axes:
        directions = np.array([ln.direction for ln in axes])
        pitch = directions[int(np.argmax((np.abs(directions @ directions.T) > SAME_DIRECTION).sum(axis=1)))]
    if tracks:
        up = np.cross(tracks[0].axis, tracks[0].along)
    elif len(observation.wheels) > 2:
        centers = np.array([w.center for w in observation.wheels])
        up = np.linalg.svd(centers - centers.mean(axis=0))[2][2]
    else:
        alone = [structure.axes[e.axis] for e in sorted(bridges(edges), key=lambda e: e.number) if not e.slide]
        tall = [ln for ln in alone if abs(float(ln.direction @ pitch)) < 0.1]
        up = max(tall, key=lambda ln: round(ln.radius, 9)).direction if tall else across(pitch)
    sense = up[int(np.argmax(np.abs(up)))]
    return np.asarray(up if sense > 0 else -up, dtype=np.float64)


def _root(
    observation: Observation, structure: Structure, edges: Sequence[Edge], bodies: list[int], up: Floats,
    tracks: Sequence[Track],
) -> int:  # fmt: skip
    """The body that carries the machine: the one nearest to the tracks' middle; the largest of those on wheels, or on
    what is on wheels; else the largest of those that reach down to the ground."""
    plain = [c for c in bodies if not structure.clusters[c].kind] or bodies
    if tracks:
        middle = np.mean([t.center for t in tracks], axis=0)
        gap = {c: float(np.linalg.norm(np.mean(_box(observation, structure, c), axis=0) - middle)) for c in plain}
        return min(plain, key=lambda c: (round(gap[c], 6), c))
    standing = _on_wheels(structure, edges, bodies) or _on_ground(observation, structure, plain, up)
    return max((c for c in plain if c in standing), key=lambda c: (round(surface(observation, structure, c), 9), -c))


def _on_wheels(structure: Structure, edges: Sequence[Edge], bodies: list[int]) -> set[int]:
    """The wheels, what hinges on them, and what hinges on that."""
    near = {c for c in bodies if structure.clusters[c].kind == "wheel"}
    for _ in range(2):
        near |= {c for e in edges if not e.slide and {e.a, e.b} & near for c in (e.a, e.b)}
    return near


def _on_ground(observation: Observation, structure: Structure, bodies: list[int], up: Floats) -> set[int]:
    """Those of the bodies that reach down to the lowest one's bottom."""
    low = {
        c: min(float((observation.solids[i].points @ up).min()) for i in structure.clusters[c].members) for c in bodies
    }
    ground = min(low.values())
    height = max(float((s.points @ up).max()) for s in observation.solids) - ground
    return {c for c in bodies if low[c] < ground + STANDS * height}


def _box(observation: Observation, structure: Structure, c: int) -> Floats:
    """(2, 3) corners of a cluster's box."""
    members = [observation.solids[i] for i in structure.clusters[c].members]
    return np.array([np.min([s.low for s in members], axis=0), np.max([s.high for s in members], axis=0)])


def _welds(
    observation: Observation, structure: Structure, pieces: Sequence[set[int]], root: int
) -> list[tuple[int, int]]:
    """A weld for every piece that the root is not in, to the nearest body of those that are tied to it already."""
    boxes = {c: _box(observation, structure, c) for p in pieces for c in p}
    joined = set().union(*(p for p in pieces if root in p))
    left = [p for p in pieces if root not in p]
    welds = []
    while left:
        options = []
        for p in left:
            for a in sorted(joined):
                for b in sorted(p):
                    gap = np.maximum(0.0, np.maximum(boxes[a][0] - boxes[b][1], boxes[b][0] - boxes[a][1]))
                    options.append((round(float(np.linalg.norm(gap)), 6), bool(structure.clusters[b].kind), a, b))
        _, _, a, b = min(options)
        welds.append((a, b))
        piece = next(p for p in left if b in p)
        joined |= piece
        left.remove(piece)
    return welds


def _outward(root: int, pairs: Sequence[tuple[int, int]]) -> list[int]:
    """The bodies from the root outward."""
    order, queue = [root], deque([root])
    while queue:
        here = queue.popleft()
        for other in sorted({b if a == here else a for a, b in pairs if here in (a, b)} - set(order)):
            order.append(other)
            queue.append(other)
    return order


def _body(observation: Observation, structure: Structure, c: int, kind: str, root: bool, tracked: bool) -> FoundBody:
    cluster = structure.clusters[c]
    members = sorted(cluster.members, key=lambda i: (-round(float(observation.solids[i].shape.area), 9), i))
    on = sorted({h.axis for h in structure.hinges if c in (h.a, h.b)})
    reasons = {
        "barrel": "a long bore with a rod in it, and an eye across",
        "rod": "a bar in line with a barrel's bore, with an eye across",
        "wheel": "one of the largest equal round things, which all stand on one plane",
    }
    reason = reasons.get(cluster.kind, f"turns on {len(on)} pivot(s)")
    if root:
        reason = (
            f"the body that stands on the ground or its {'tracks' if tracked else 'wheels'}, and the largest; {reason}"
        )
    return FoundBody(tuple(observation.solids[i].part.id for i in members), kind, _labels(observation, members), reason)


def _labels(observation: Observation, members: list[int]) -> tuple[str, ...]:
    """Assemblies that most of a body is in, innermost first, then the names of its parts, largest first."""
    area = {i: float(observation.solids[i].shape.area) for i in members}
    share: dict[tuple[int, str], float] = {}
    for i in members:
        for depth, above in enumerate(observation.solids[i].part.path[1:]):
            share[depth, above] = share.get((depth, above), 0.0) + area[i] / sum(area.values())
    inside = [text for (_, text), part in sorted(share.items(), key=lambda x: -x[0][0]) if part > KIN]
    names = [observation.solids[i].part.name for i in members[:SOME]]
    return tuple(dict.fromkeys([*inside, *names] if len(members) > 1 else names))


def _joint(
    observation: Observation, structure: Structure, e: Edge, number: dict[int, int], loop: bool, upright: bool
) -> FoundJoint:
    a, b = sorted((e.a, e.b), key=lambda c: number[c])
    if e.slide and not e.driven:
        nest = observation.nests[e.number - len(observation.cylinders)]
        reason = "a long box close inside the walls of another"
        point, direction = triple(nest.origin), triple(nest.direction)
        return FoundJoint("prismatic", number[a], number[b], point, direction, 0.0, (), reason, loop=loop)
    if e.slide:
        cylinder = observation.cylinders[e.number]
        place = (
            "drawn beside its bore"
            if cylinder.apart
            else "in its bore"
            if cylinder.hollow
            else "out of its barrel's end"
        )
        reason = f"rod Ø{2e3 * cylinder.rod_radius:.4g} mm in line with a barrel, {place}"
        return FoundJoint(
            "prismatic",
            number[a],
            number[b],
            triple(cylinder.origin),
            triple(cylinder.direction),
            cylinder.rod_radius,
            (),
            reason,
            loop=loop,
        )
    hinge, axis = structure.hinges[e.number], structure.axes[e.axis]
    pins = tuple(observation.solids[i].part.id for i in hinge.pins)
    if "wheel" in (structure.clusters[a].kind, structure.clusters[b].kind):
        reason = "a wheel on its axle"
    elif pins:
        reason = f"pin Ø{2e3 * axis.radius:.4g} mm through both"
    elif e.axis in structure.races:
        reason = f"rings of a slewing bearing, Ø{2e3 * axis.radius:.4g} mm"
    else:
        reason = f"coaxial round faces of both, Ø{2e3 * axis.radius:.4g} mm; no pin of its own"
    return FoundJoint(
        "revolute",
        number[a],
        number[b],
        triple(axis.origin),
        triple(axis.direction),
        axis.radius,
        pins,
        reason,
        loop,
        upright,
    )


def _remarks(
    observation: Observation,
    structure: Structure,
    found: Sequence[FoundBody],
    number: dict[int, int],
    edges: Sequence[Edge],
    tracks: Sequence[Track],
    apart: int,
) -> list[Finding]:
    """What remains open: rods on nothing, tracks, parts that stand apart."""
    findings = []
    hinged = {c for e in edges if not e.slide for c in (e.a, e.b)}
    for e in edges:
        if not e.driven:
            continue
        for c in (e.a, e.b):
            if c not in hinged:
                astray = (
                    "it is drawn out of its barrel's place"
                    if observation.cylinders[e.number].apart
                    else "no eye meets another"
                )
                words = f"The {structure.clusters[c].kind} hangs on nothing: {astray}, so its chain is open."
                hint = (
                    "Draw the cylinder in place, or add its pin's joint to joints.json; the hinge is driven directly."
                )
                findings.append(Finding("ALN021", "warning", some(found[number[c]].parts), words, hint))
    if tracks:
        words = f"{len(tracks)} track(s) of {len(tracks[0].shoes)} shoes are drawn: they move with the root."
        hint = "docs/tracks.md says how a template drives them; --like a type with tracks takes its rows."
        findings.append(Finding("ALN022", "info", some(found[0].parts), words, hint))
    if apart:
        words = f"{apart} parts stand apart from the machine and are left out."
        findings.append(Finding("ALN023", "info", some(found[0].parts), words, "Hand in one machine a file."))
    return findings
