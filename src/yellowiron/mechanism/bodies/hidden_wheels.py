"""Hidden wheels: bodies that no CAD part plays, which carry and drive a machine whose track shoes are no bodies.

A row's rule (docs: template format) says where they stand along the stretch of the track that lies on the ground: that
between the axles of its front and its rear tumbler (an idler, a sprocket), where these are drawn low enough to end it,
else that of the points which are on the ground. Makers publish the former as the track's length on the ground, and a
machine on soft ground tips over it. Each is a ball, which touches the ground in one point: a machine on broad wheels
hardly turns on the spot, since their two ends hold against each other. Together they weigh what the track weighs, as
hoops: a hoop of mass m that rolls with speed v turns with the energy m v²/2, and so does a chain of that mass that
runs around with v. The body that the track moves with loses their mass and moments, so that the machine's mass, centre
and inertia in the drawn pose stay what they are.

A track whose brake is set does not roll: it lies on the ground as a pad, as long and as wide as it is there. Balls will
not do: those at the ends hardly hold, and a machine on a slope stands on them; and where a ball touches in one point,
PhysX lets it creep by a millimetre or two a second.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.mechanism.bodies.body import hull_corners
from yellowiron.mechanism.bodies.mass import Masses, Moments, combine
from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Ints, Mesh
from yellowiron.model.mechanism import Body, BodyShape
from yellowiron.model.template import Role, Template
from yellowiron.support.vectors import clean_triple

MIDDLE = 2.0 / 3.0
"""Share of the room between two tracks, drawn in one with their frame, that is surely the frame's."""
ON_GROUND = 0.03
"""What is this near to the lowest point, as a share of the track's height, lies on the ground."""
TUMBLERS = ("idler", "sprocket")
"""Kinds of the roles around which a track turns up from the ground …"""
LOW = 0.35
"""… if they reach as low as this share of the track's height: a high drive's sprocket does not."""
FLAT = 1e-6
"""Metres: what is no higher is no track."""
LEAST_TRACK = 0.01
"""A smaller share of the surface of what the machine stands on is no track: wheels without mass stop an engine."""
LEFT_OVER = 0.02
"""The least share of its mass that the body a track moves with keeps."""
_NARROWEST = 0.5
"""A pad is no narrower than this share of its wheels' radius; tracks are one to two of them wide."""


@dataclass(frozen=True, eq=False)
class HiddenWheel:
    """One of them: `center` (3,) and `radius`, machine frame, the `width` of the track, metres; `rows` of the parts it
    stands for and its `share` of their mass; `carrier`, the body that these move with. `inner`: y of the track's inner
    edge, where these parts are its frame too."""

    role: str
    center: Floats
    radius: float
    width: float
    rows: tuple[int, ...]
    share: float
    carrier: str
    inner: float | None = None

    @property
    def axis(self) -> Floats:
        """The axle: across the machine."""
        return np.array([0.0, 1.0, 0.0])


def hidden_wheels(placement: Placement, template: Template, findings: list[Finding]) -> dict[str, HiddenWheel]:
    """The hidden wheels by body name, of a template whose rows are expanded. A row that is not there has none, with a
    finding."""
    found: dict[str, HiddenWheel] = {}
    rows: dict[str, list[Role]] = {}
    for role in template.roles:
        if role.hidden:
            rows.setdefault(role.row, []).append(role)
    for row, roles in rows.items():
        rule = roles[0].hidden
        parts = parts_of_row(placement, template, rule["row"])
        points, part_of, inner = placement.points_of(parts), 1.0, None
        if not parts:
            parts, points, part_of, inner = _side(placement, template, roles[0])
            if not parts:
                words = f"No part of the CAD model is '{rule['row']}': there is nothing that '{row}' could stand for."
                findings.append(Finding("MEC070", "error", row, words, "Give its parts that role in the alignment."))
                continue
            words = f"No part is '{rule['row']}': the track is taken to be what stands on the ground on that side."
            findings.append(Finding("MEC072", "warning", row, words, "Check the undercarriage's parts."))
        if float(np.ptp(points[:, 2])) < FLAT:
            words = f"What stands for '{rule['row']}' is flat: there is nothing that '{row}' could stand for."
            findings.append(Finding("MEC070", "error", row, words, "Check the undercarriage's parts."))
            continue
        low, high, ground = _stretch(points)
        ground = _between_tumblers(placement, template, roles[0].side, low, high) or ground
        radius = 0.5 * rule["radius"] * float(high[2] - low[2])
        middle, length = 0.5 * (ground[0] + ground[1]), ground[1] - ground[0]
        for role, at in zip(roles, rule["at"], strict=True):
            center = np.array([middle + at * length, 0.5 * (low[1] + high[1]), low[2] + radius + rule["above"]])
            share = part_of * rule["mass"] / len(roles)
            carrier, width = placement.bodies[parts[0]], float(high[1] - low[1])
            found[role.name] = HiddenWheel(role.name, center, radius, width, parts, share, carrier, inner)
    return found


def parts_of_row(placement: Placement, template: Template, row: str) -> tuple[int, ...]:
    """Rows of the parts that play a member of a row (or move with one, as pins and bolts do)."""
    members = {r.name for r in template.roles if r.row == row}
    return tuple(i for i, name in enumerate(placement.roles) if name in members or name == row)


def _side(placement: Placement, template: Template, wheel: Role) -> tuple[tuple[int, ...], Floats, float, float]:
    """Where tracks and frame are drawn in one: the parts of the body that a hidden wheel hangs on, their points on the
    track of its side, which share of those parts' surface it is, and y of its inner edge. The track is as wide as what
    touches the ground."""
    carrier = template.body_of(wheel.parent) if wheel.parent is not None else None
    rows = placement.rows_of_body(carrier) if carrier is not None and wheel.side else ()
    points = placement.points_of(rows)
    if not len(points):
        return (), points, 0.0, 0.0
    sign = 1.0 if wheel.side == "l" else -1.0
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    ground = points[(points[:, 2] < low + ON_GROUND * (high - low)) & (sign * points[:, 1] > 0.0)]
    if not len(ground):
        return (), points, 0.0, 0.0
    inner, outer = ground[:, 1].min(), ground[:, 1].max()
    kept = points[(points[:, 1] >= inner) & (points[:, 1] <= outer)]
    facets = [placement.facets(row) for row in rows]
    middle = np.concatenate([center[:, 1] for center, _, _ in facets])
    area = np.concatenate([size for _, _, size in facets])
    on = (middle >= inner) & (middle <= outer)
    share = float(area[on].sum() / area.sum())
    if share < LEAST_TRACK:
        return (), points, 0.0, 0.0
    return rows, kept, share, float(sign * np.abs([inner, outer]).min())


def _stretch(points: Floats) -> tuple[Floats, Floats, tuple[float, float]]:
    """Corners of the box around a track's points, and from where to where along x it lies on the ground, which is z = 0
    unless it is nowhere near: at the ends of its run a shoe may dip deeper than those that it lies on."""
    low, high = points.min(axis=0), points.max(axis=0)
    near = ON_GROUND * float(high[2] - low[2])
    down = points[points[:, 2] < low[2] + near]
    low[2] = 0.0 if abs(low[2]) < near else low[2]
    return low, high, (float(down[:, 0].min()), float(down[:, 0].max()))


def with_wheels(
    bodies: Sequence[Body],
    order: Sequence[str],
    wheels: Mapping[str, HiddenWheel],
    placement: Placement,
    weighed: Masses,
    findings: list[Finding],
) -> tuple[Body, ...]:
    """The bodies in their `order`, hidden wheels among them; those that carry the tracks are lighter by them, and the
    tracks' parts have no colliders. The wheels' materials come into those that `weighed` has in use."""
    by_name = {b.name: b for b in bodies}
    masses = {p.part: p.mass for b in bodies for p in b.parts}
    for name, wheel in wheels.items():
        mass = wheel.share * sum(masses[placement.parts[row].id] for row in wheel.rows)
        by_name[name] = _wheel(wheel, mass, weighed.key_of_role(name))
    for carrier in dict.fromkeys(w.carrier for w in wheels.values()):
        own = [w for w in wheels.values() if w.carrier == carrier]
        stood_for = frozenset(placement.ids(row for w in own for row in w.rows))
        body = lighter(_bare(by_name[carrier], stood_for), [by_name[w.role] for w in own], findings)
        pads = tuple(_pad(carrier, side, by_name) for side in _sides(own))
        by_name[carrier] = replace(_between(body, own, placement), pads=pads)
    return tuple(by_name[name] for name in order)


def _between_tumblers(
    placement: Placement, template: Template, side: str, low: Floats, high: Floats
) -> tuple[float, float] | None:
    """From where to where along x the track of a side is tangent to the ground: below the axles of its first and last
    low tumbler, or of the last roller where the sprocket is a high one. None where it has no two."""
    names = {r.name for r in template.roles if r.kind in TUMBLERS and r.side == side}
    there = {name: points for name in sorted(names) if len(points := placement.points_of(placement.rows_of_role(name)))}
    axles, raised = [], False
    for points in there.values():
        if float(points[:, 2].min()) < low[2] + LOW * (high[2] - low[2]):
            axles.append(round(0.5 * float(points[:, 0].min() + points[:, 0].max()), 9))
        else:
            raised = True
    if raised:
        rollers = [r.name for r in template.roles if r.kind == "roller" and r.side == side]
        for points in (placement.points_of(placement.rows_of_role(name)) for name in rollers):
            if len(points):
                axles.append(round(0.5 * float(points[:, 0].min() + points[:, 0].max()), 9))
    if len(axles) < 2 or max(axles) - min(axles) < 0.5 * float(high[0] - low[0]):
        return None
    return min(axles), max(axles)


def _between(body: Body, wheels: Sequence[HiddenWheel], placement: Placement) -> Body:
    """A frame drawn in one with its tracks: what is between them is in no corner of the whole's hull, and its parts
    have no colliders. It gets the corners of that middle, and a box around it to collide with."""
    inner = [w.inner for w in wheels if w.inner is not None]
    right, left = max((y for y in inner if y < 0.0), default=0.0), min((y for y in inner if y > 0.0), default=0.0)
    rows = sorted({row for w in wheels if w.inner is not None for row in w.rows})
    margin = 0.5 * (1.0 - MIDDLE) * (left - right)
    corners = [
        _slab(placement.points(row), placement.shapes[row].mesh.triangles, right + margin, left - margin)
        for row in rows
    ]
    points = np.concatenate([np.zeros((0, 3)), *corners])
    if left <= right or not len(points):
        return body
    first, last = points.min(axis=0), points.max(axis=0)
    material = next(p.material for p in body.parts if p.part in placement.ids(rows))
    size, center = clean_triple(np.maximum(last - first, 1e-3)), clean_triple(0.5 * (first + last))
    box = BodyShape(f"{body.name}_between_tracks", center, 0.5 * max(size), material, size)
    return replace(body, hull=np.concatenate([body.hull, points]), shapes=(*body.shapes, box))


def _slab(points: Floats, triangles: Ints, low: float, high: float) -> Floats:
    """Corners (n, 3) of the convex hull of what a mesh has between two planes across y."""
    edges = points[np.asarray(triangles)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)]
    found = [points[(points[:, 1] >= low) & (points[:, 1] <= high)]]
    for plane in (low, high):
        before, after = edges[:, 0, 1] - plane, edges[:, 1, 1] - plane
        crossing = before * after < 0.0
        share = (before[crossing] / (before - after)[crossing])[:, None]
        found.append(edges[crossing, 0] + share * (edges[crossing, 1] - edges[crossing, 0]))
    inside = np.concatenate(found)
    return hull_corners(Mesh(inside, np.zeros((0, 3), dtype=np.int64))) if len(inside) else inside


def _bare(body: Body, parts: frozenset[str]) -> Body:
    """The body, its parts of those ids without colliders."""
    words = "none: hidden wheels touch the ground in its place"
    changed = [
        replace(p, collision="none", source=f"{p.source}; {words}") if p.part in parts else p for p in body.parts
    ]
    return replace(body, parts=tuple(changed))


def _wheel(wheel: HiddenWheel, mass: float, material: str) -> Body:
    center, r = clean_triple(wheel.center), wheel.radius
    # A hoop as wide as its radius: m r² about its axle, m r²/2 + m r²/12 across it.
    across = 7.0 / 12.0
    inertia = mass * r * r * np.diag([across, 1.0, across])
    corners = wheel.center + r * np.concatenate([np.eye(3), -np.eye(3)])
    shape = BodyShape(wheel.role, center, r, material)
    source = f"hidden wheel: {wheel.share:.3g} of the track's mass, as a hoop"
    return Body(wheel.role, center, mass, center, inertia, (), corners, source, (shape,))


def _sides(wheels: Sequence[HiddenWheel]) -> Iterator[list[HiddenWheel]]:
    """Those on the left, and those on the right, where there are any."""
    for left in (True, False):
        if side := [wheel for wheel in wheels if (wheel.center[1] > 0.0) == left]:
            yield side


def _pad(carrier: str, side: Sequence[HiddenWheel], bodies: Mapping[str, Body]) -> BodyShape:
    """One track, braked: a box from its first to its last wheel, as high as their axles. It grips as that wheel does
    which reaches farthest down."""
    centers = np.array([wheel.center for wheel in side])
    lowest = min(side, key=lambda wheel: float(wheel.center[2]) - wheel.radius)
    bottom, top = float(lowest.center[2]) - lowest.radius, float(lowest.center[2])
    first, last = float(centers[:, 0].min()), float(centers[:, 0].max())
    center = clean_triple([0.5 * (first + last), float(centers[:, 1].mean()), 0.5 * (bottom + top)])
    # Of a belt that is drawn as a line of corners, nothing says how wide it is.
    width = max(lowest.width, _NARROWEST * lowest.radius)
    size = clean_triple([max(last - first, lowest.radius), width, top - bottom])
    name = f"{carrier}_pad_{'l' if center[1] > 0.0 else 'r'}"
    return BodyShape(name, center, 0.5 * max(size), bodies[lowest.role].shapes[0].material, size)


def _moments(body: Body) -> Moments:
    inertia = np.asarray(body.inertia, dtype=np.float64)
    return Moments(body.mass, np.array(body.center_of_mass), 0.5 * np.trace(inertia) * np.eye(3) - inertia)


def lighter(body: Body, hidden: Sequence[Body], findings: list[Finding], *, what: str = "hidden wheels") -> Body:
    """A body without the mass and the moments of the hidden ones that stand for parts of it; MEC071 where it has not
    so much."""
    mine, theirs = _moments(body), combine(_moments(one) for one in hidden)
    mass = mine.mass - theirs.mass
    if mass < LEFT_OVER * mine.mass:
        words = f"Its {what} weigh {theirs.mass:.0f} kg of its {mine.mass:.0f} kg: it keeps its own mass besides."
        findings.append(Finding("MEC071", "warning", body.name, words, "Lower the mass in the hidden rule."))
        return body
    center = (mine.mass * mine.center - theirs.mass * theirs.center) / mass
    second = mine.second + mine.mass * np.outer(mine.center, mine.center)
    second -= theirs.second + theirs.mass * np.outer(theirs.center, theirs.center)
    second -= mass * np.outer(center, center)
    left = Moments(mass, center, second)
    return replace(
        body,
        mass=mass,
        center_of_mass=clean_triple(center),
        inertia=left.inertia,
        source=f"{body.source}; less {theirs.mass:.5g} kg of {what}",
    )
