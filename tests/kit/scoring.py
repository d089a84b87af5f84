"""How right an alignment is, by area: every triangle of what was found is looked up where the truth has it.

So it does not matter whether a mesh was taken apart, joined, named, or brought to another scale on the way.

A triangle is right if its part moves with the body that it is labelled with, or with another that the label allows: a
pin may go with either body that it joins, what a track is made of with its undercarriage. It is silent if it is wrong
and its part is not listed for review. What was left out when the file was read is wrong and not silent: that is said.
What is no part of the machine has no share in its area, which a floor would outweigh, but is silent where it is taken
for a part of it and not listed, up to the machine's own area.

A role (a body, a pin) is right if most of its area is; a pin must play its own role for that. A joint of the truth is
right if one is found between its bodies, or two over a third body, on its axis: within 1 % of the machine's height
across the axis and 2°, or what its label allows; where along the axis does not matter. So are slides that are hydraulic
cylinders'; another slide is the same wherever it is, and only has a direction. What the truth has as two joints between
two bodies (a wheel that is steered and rolls) may be two over a body of which nothing is drawn.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import asdict, dataclass, replace

import numpy as np
from scipy.spatial import cKDTree

from kit.machines.damages import EXTRA
from kit.machines.solids import Array
from kit.scene import ROWS, Surface, TrueJoint, centres_of
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.template import Template

ACROSS, DEGREES = 0.01, 2.0
"""How far an axis may be off: of the machine's height, and in degrees."""
FACTORS = (1.0, 1e-3, 1e-2, 0.0254, 1e3, 1e2, 1 / 0.0254, 10.0, 0.1)
"""What a reader may have made of the file's unit."""


@dataclass(frozen=True)
class Score:
    """Areas in the truth's unit squared; `words` says what is wrong, `lost` which joints are."""

    area: float
    right: float
    silent: float
    flagged: float
    parts: int
    parts_right: int
    parts_silent: int
    roles: int
    roles_right: int
    roles_silent: int
    joints: int
    joints_right: int
    words: tuple[str, ...] = ()
    silent_words: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()

    def document(self) -> dict[str, object]:
        """For JSON."""
        return asdict(self)


def allowed(role: str, body: str, template: Template) -> frozenset[str]:
    """The bodies that a label allows."""
    bodies = set(body.split("|"))
    if any(b.startswith((*ROWS, "track_")) for b in bodies):
        bodies.add("undercarriage")
    for joint in template.joints:
        if role in joint.parts:
            bodies |= {part for part in joint.parts if part != role}
    return frozenset(bodies)


def same_role(found: str | None, true: str) -> bool:
    """A pin through the rods of both twins plays either role."""
    return found == true or (bool(found) and "_r_pin" in true + str(found) and (
        str(found).replace("_r_pin", "_l_pin") == true.replace("_r_pin", "_l_pin") and "rod" in true
    ))  # fmt: skip


def score(
    assembly: Assembly,
    alignment: Alignment,
    mechanism: Mechanism | None,
    truth: Surface,
    joints: Iterable[TrueJoint],
    height: float,
    template: Template,
) -> Score:
    """What an alignment of `assembly` is worth. `height` is the machine's in the truth's unit; `template` has its
    variants still; without a `mechanism` no joint is found."""
    factor, tree = _factor(assembly, truth), cKDTree(truth.points)
    review = set(alignment.to_review)
    pins = {r.name for r in template.roles if r.kind == "pin"}
    by_part = {p.part: p for p in alignment.parts}
    areas, labels = _looked_up(assembly, truth, tree, factor)
    good_bodies = _allowed_bodies(truth, template, areas, labels, by_part)
    total = right = silent = flagged = 0.0
    counted = parts_right = parts_silent = 0
    taken_in = 0.0
    votes: dict[str, list[float]] = {}
    told: set[str] = set()
    words, silent_words = [], []
    played: dict[str, set[str]] = {}
    for part in assembly.parts:
        found = by_part.get(part.id)
        body, role = (found.body, found.role) if found is not None else (None, None)
        listed = part.id in review
        mine, wrong = 0.0, dict[str, float]()
        for number in np.unique(labels[part.id]).tolist():
            true_role, true_body = truth.labels[number]
            if not true_body:
                continue
            area = float(areas[part.id][labels[part.id] == number].sum())
            good = (EXTRA if body is None else body) in good_bodies[number]
            mine += area
            group = true_role if true_role in pins else true_body.split("|")[0]
            exact = good and (true_role not in pins or same_role(role, true_role) or true_role == "swing_bearing")
            vote = votes.setdefault(group, [0.0, 0.0])
            vote[int(exact)] += area
            if good:
                for other in truth.whole.get(part.id, (number,)):
                    played.setdefault(truth.labels[other][1].split("|")[0], set()).add(body or EXTRA)
            else:
                wrong[true_body] = wrong.get(true_body, 0.0) + area
            if listed:
                told.add(group)
        if not mine:
            continue
        bad = sum(wrong.values())
        if all(truth.labels[n][1].startswith(EXTRA) for n in np.unique(labels[part.id])):
            taken_in += 0.0 if listed else bad
        else:
            total, right = total + mine, right + mine - bad
            flagged += mine if listed else 0.0
            silent += 0.0 if listed else bad
        counted += 1
        parts_right += bad <= 0.5 * mine
        parts_silent += bad > 0.5 * mine and not listed
        if bad > 1e-9 * mine:
            reason = f"{found.confidence:.2f}: {found.reason}" if found is not None else "not listed"
            text = f"{part.id} ({part.name}): {role}/{body}, {bad / mine:.0%} of it {'+'.join(wrong)} ({reason})"
            (words if listed else silent_words).append(text)
    known = np.array([bool(body) and not body.startswith(EXTRA) for _, body in truth.labels])[truth.label]
    dropped = max(0.0, float(truth.areas[known].sum()) - total)
    if dropped > 1e-3 * total:
        total += dropped
        flagged += dropped
    silent += min(taken_in, total)
    bars = {r.name for r in template.roles if r.kind in ("barrel", "rod")}
    lost, count = _lost(joints, mechanism, alignment, factor, height, played, bars)
    bad_roles = [g for g, (no, yes) in votes.items() if yes <= no]
    return Score(
        total, right, silent, flagged, counted, parts_right, parts_silent,
        len(votes), len(votes) - len(bad_roles), sum(g not in told and g not in review for g in bad_roles),
        count, count - len(lost), tuple(words), tuple(silent_words), tuple(lost),
    )  # fmt: skip


def true_bodies(
    assembly: Assembly, alignment: Alignment, truth: Surface, template: Template
) -> dict[str, tuple[str, ...]]:
    """Part → the bodies that most of its surface may be of, the label's own first ('-': of none); of a part of which
    nobody knows, nothing."""
    areas, labels = _looked_up(assembly, truth, cKDTree(truth.points), _factor(assembly, truth))
    good = _allowed_bodies(truth, template, areas, labels, {p.part: p for p in alignment.parts})
    bodies = {r.name for r in template.roles if r.rigid}
    found = {}
    for part in assembly.parts:
        numbers = np.unique(labels[part.id]).tolist()
        share = {n: float(areas[part.id][labels[part.id] == n].sum()) for n in numbers}
        most = max(numbers, key=lambda n: (share[n], -n), default=None)
        if most is None or not truth.labels[most][1]:
            continue
        own = [b for b in truth.labels[most][1].split("|") if b in good[most]]
        listed = [*own, *sorted(good[most] - set(own))]
        extra = [b for b in listed if b.startswith(EXTRA)]
        found[part.id] = ("-",) if extra else tuple(b for b in listed if b in bodies)
    return {part: known for part, known in found.items() if known}


def triangles_of(assembly: Assembly, part: Part) -> tuple[Array, Array]:
    """(m, 3) centres and (m,) areas of a part's triangles in the CAD frame."""
    return centres_of(Mesh(assembly.points_of(part), assembly.shape_of(part).mesh.triangles))


def _looked_up(
    assembly: Assembly, truth: Surface, tree: cKDTree, factor: float
) -> tuple[dict[str, Array], dict[str, np.ndarray]]:
    """Part → the areas of its triangles in the truth's unit, and the numbers of their labels."""
    areas, labels = {}, {}
    for part in assembly.parts:
        centres, sizes = triangles_of(assembly, part)
        areas[part.id] = sizes / factor**2
        if part.id in truth.whole:
            labels[part.id] = np.full(len(sizes), truth.whole[part.id][0])
        else:
            labels[part.id] = truth.label[tree.query(centres / factor)[1]]
    return areas, labels


def _factor(assembly: Assembly, truth: Surface) -> float:
    """How many times as large as the truth an assembly is."""
    rng = np.random.default_rng(5)
    points = np.concatenate([triangles_of(assembly, p)[0] for p in assembly.parts])
    sample = points[rng.choice(len(points), size=min(400, len(points)), replace=False)]
    tree = cKDTree(truth.points)
    whole = float(np.ptp(points, axis=0).max() / np.ptp(truth.points, axis=0).max())
    if abs(whole - 1.0) < 1e-6:
        return 1.0
    return min((*FACTORS, whole), key=lambda f: float(np.median(tree.query(sample / f)[0])))


def _allowed_bodies(
    truth: Surface,
    template: Template,
    areas: Mapping[str, Array],
    labels: Mapping[str, np.ndarray],
    by_part: Mapping[str, object],
) -> list[frozenset[str]]:
    """Label → the bodies that are right, where another label's choice binds it, that one."""
    found = [allowed(role, body, template) for role, body in truth.labels]
    if not truth.ties:
        return found
    most: dict[int, dict[str, float]] = {}
    for part, numbers in labels.items():
        body = getattr(by_part.get(part), "body", None)
        for number in np.unique(numbers).tolist():
            share = most.setdefault(number, {})
            share[str(body)] = share.get(str(body), 0.0) + float(areas[part][numbers == number].sum())
    bound = list(found)
    for number, other in truth.ties.items():
        chosen = max(most.get(other, {"None": 1.0}).items(), key=lambda item: (item[1], item[0]))[0]
        if chosen in found[other] and chosen in found[number]:
            bound[number] = frozenset({chosen})
    return bound


@dataclass(frozen=True)
class _Line:
    type: str
    bodies: frozenset[str]
    point: Array
    axis: Array


def _lost(
    joints: Iterable[TrueJoint],
    mechanism: Mechanism | None,
    alignment: Alignment,
    factor: float,
    height: float,
    played: Mapping[str, set[str]],
    bars: Collection[str] = (),
) -> tuple[list[str], int]:
    """The joints of the truth that were not found, with why; and how many there are. `bars`: the bodies that are halves
    of hydraulic cylinders."""
    found = [] if mechanism is None else _lines(mechanism, alignment.frame, factor)
    drawn = {p.body for p in alignment.parts}
    lost, count = [], 0
    joints = list(joints)

    def is_on(joint: TrueJoint, line: _Line) -> bool:
        degrees, across = _apart(joint, line)
        placed = line.type != "prismatic" or any(b in bars for b in joint.bodies)
        near = across <= max(ACROSS * height, joint.tolerance or 0.0)
        return degrees <= max(DEGREES, joint.degrees) and (near or not placed)

    for joint in (_between_twins(j, joints, played) for j in joints):
        count += 1
        ends = [
            frozenset({b, *more, *played.get(b, set())}) for b, more in zip(joint.bodies, joint.others, strict=True)
        ]
        slide = joint.type == "prismatic"
        on_axis, best = [], (math.inf, math.inf)
        between = [f for f in found if _joins(f, ends) and (f.type == "prismatic") == slide]
        for line in found:
            if (line.type == "prismatic") != slide:
                continue
            degrees, across = _apart(joint, line)
            if any(line is f for f in between):
                best = min(best, (across, degrees))
            if is_on(joint, line):
                on_axis.append(line)
        if any(_joins(f, ends) for f in on_axis) or (not slide and _over_third(on_axis, ends)):
            continue
        # The other joints of the truth between the same bodies.
        beside = [j for j in joints if {*j.bodies} == {*joint.bodies} and j.name != joint.name]
        others = [f for f in found if any(is_on(j, f) for j in beside) and f.type != "prismatic"]
        if not slide and _over_undrawn(on_axis, others, ends, drawn):
            continue
        where = f"{best[0] / height:.1%} of the height and {best[1]:.1f} deg off" if between else "no such joint"
        lost.append(f"{joint.name}: {where}")
    return lost, count


def _between_twins(joint: TrueJoint, joints: list[TrueJoint], played: Mapping[str, set[str]]) -> TrueJoint:
    """A joint of a cylinder that was found as one with its twin, in whose mesh it is drawn: halfway to the twin's. A
    body that both hang on, and that a label allows their feet to be of, does not make them one."""
    shared = {b for j in joints for b in j.bodies if not b.endswith(("_l", "_r"))}
    for twin in joints:
        mirrored = [tuple(sorted(re.sub("_[lr]$", "", b) for b in j.bodies)) for j in (joint, twin)]
        if twin is joint or twin.type != joint.type or mirrored[0] != mirrored[1]:
            continue
        mine, others = (
            {b for end in j.bodies if end.endswith(("_l", "_r")) for b in played.get(end, set())} for j in (joint, twin)
        )
        if (mine & others) - shared:
            return replace(joint, point=tuple((0.5 * (np.array(joint.point) + np.array(twin.point))).tolist()))
    return joint


def _joins(line: _Line, ends: list[frozenset[str]]) -> bool:
    if len(line.bodies) != 2:
        return False
    a, b = sorted(line.bodies)
    return (a in ends[0] and b in ends[1]) or (a in ends[1] and b in ends[0])


def _over_third(lines: list[_Line], ends: list[frozenset[str]]) -> bool:
    """Whether two joints on one axis join the bodies over a third."""
    beyond = [{b for line in lines if line.bodies & end for b in line.bodies - end} for end in ends]
    return bool((beyond[0] & beyond[1]) - ends[0] - ends[1])


def _over_undrawn(
    lines: list[_Line], others: list[_Line], ends: list[frozenset[str]], drawn: Collection[str | None]
) -> bool:
    """Whether a joint on the one axis and one on another join the bodies over one of which nothing is drawn."""
    pairs = ((one, two, one.bodies & two.bodies) for one in lines for two in others)
    return any(
        len(middle) == 1
        and not middle & {*drawn}
        and _joins(_Line("", one.bodies ^ two.bodies, one.point, one.axis), ends)
        for one, two, middle in pairs
    )


def _lines(mechanism: Mechanism, frame: Array, factor: float) -> list[_Line]:
    """The joints of a mechanism in the truth's frame and unit."""
    back = np.linalg.inv(frame)
    lines = []
    for joint in mechanism.joints:
        point = (back[:3, :3] @ np.array(joint.anchor) + back[:3, 3]) / factor
        axis = back[:3, :3] @ np.array(joint.axis)
        if joint.type != "fixed":
            bodies = frozenset({joint.body0, joint.body1})
            lines.append(_Line(joint.type, bodies, point, axis / np.linalg.norm(axis)))
    return lines


def _apart(joint: TrueJoint, line: _Line) -> tuple[float, float]:
    """Degrees between two axes, and how far the found one passes the true joint's point."""
    cosine = min(1.0, abs(float(np.dot(joint.axis, line.axis))))
    away = np.array(joint.point) - line.point
    return math.degrees(math.acos(cosine)), float(np.linalg.norm(away - (away @ line.axis) * line.axis))
