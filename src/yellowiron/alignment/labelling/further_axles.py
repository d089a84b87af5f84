"""Wheels of axles that a type does not have: on the rows of further wheels that it may have, or standing still."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Solid, size_of, solids_of
from yellowiron.alignment.features.wheels import spare_wheels
from yellowiron.alignment.labelling.confidence import REVIEW
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.alignment.tolerances import CONTACT
from yellowiron.model.alignment import Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.rows import expand, member
from yellowiron.model.template import Role, Template
from yellowiron.support.vectors import triple

SURE = 0.9
"""Confidence of a wheel that is as large as those that the type has, and stands in line with them."""


@dataclass(frozen=True, eq=False)
class FurtherWheel:
    """A wheel of an axle that the type does not have: ids of its parts and of its tyres among them, its middle (metres,
    CAD frame) on its unit axis `direction`, and the tyre (id) of the wheel `beside` it that the type has."""

    parts: frozenset[str]
    tyres: frozenset[str]
    center: Floats
    direction: Floats
    beside: str


@dataclass(frozen=True, eq=False)
class FurtherAxles:
    """Part's id → place of all their parts, and joint → point and unit axis (metres, CAD frame) that a wheel turns
    about."""

    places: Mapping[str, Place]
    axes: Mapping[str, tuple[Vector, Vector]]


def further_wheels(
    wheels: Sequence[FurtherWheel],
    found: Mapping[str, Place],
    template: Template,
    drawn: Collection[str],
    frame: Floats | None,
) -> FurtherAxles:
    """Where they are. `template` has its variants decided, its rows not counted; `drawn`: the bodies that are there;
    `frame` (4, 4): CAD → machine.

    They turn on the frame that the wheel beside them turns on, as the type's row of wheels there says, counted from the
    front. Where it has none, or nothing tells left from right, they stand still on that frame, for review: on the body
    of that wheel they would turn about its axle.
    """
    places: dict[str, Place] = {}
    numbers: dict[str, int] = {}
    turning: dict[str, FurtherWheel] = {}
    at = {w: frame[:3, :3] @ w.center + frame[:3, 3] for w in wheels} if frame is not None else {}
    for wheel in sorted(wheels, key=lambda w: (-round(float(at[w][0]), 4) if w in at else 0.0, min(w.parts))):
        carrier = _frame_beside(wheel, found, template, drawn)
        row = _row(template, carrier, "l" if at[wheel][1] > 0.0 else "r") if wheel in at else None
        if row is None:
            words = f"a wheel of an axle that the type does not have: it stands still on {carrier}"
            places |= {part: Place(carrier, carrier, DOUBTFUL, words, how="near") for part in wheel.parts}
            continue
        number = numbers[row.name] = numbers.get(row.name, 0) + 1
        body = member(row.name, number)
        turning[body] = wheel
        tyre = next((r for r in template.roles if r.many and r.parent == row.name), None)
        words = f"a wheel as large as the others, of a further axle on {carrier}"
        # Which side it is on, and of what, follows from the wheel beside it.
        sure = min(SURE, found[wheel.beside].confidence) if wheel.beside in found else SURE
        words = words if sure >= REVIEW else f"{words}; but the wheel beside it is in doubt itself"
        for part in wheel.parts:
            role = member(tyre.name, number) if tyre is not None and part in wheel.tyres else body
            places[part] = Place(role, body, sure, words, how="ring")
    hinges = {b: j.name for j in expand(template, numbers).joints for b in j.parts if b in turning}
    return FurtherAxles(
        places, {joint: (triple(turning[b].center), triple(turning[b].direction)) for b, joint in hinges.items()}
    )


def axle_tubes(
    wheels: Sequence[FurtherWheel],
    further: FurtherAxles,
    found: Mapping[str, Place],
    solids: Sequence[Solid],
    touch: Touch,
    template: Template,
) -> dict[str, Place]:
    """Part's id → place, of what touches parts of further wheels and nothing else, and what nothing better than
    touching or nearness placed: their axle, of the frame that they turn on. `found`: the other parts' places."""
    where = {s.part.id: s.index for s in solids}
    own = {where[part]: further.places[part] for w in wheels for part in w.parts}
    tubes: dict[str, Place] = {}
    for wheel in own:
        for i in touch.near(wheel):
            part = solids[i].part.id
            loose = part not in found or found[part].how in ("touch", "near")
            if i in own or part in tubes or not loose or not touch.touching(i, wheel):
                continue
            if any(j != i and j not in own and touch.touching(i, j) for j in touch.near(i)):
                continue
            body = own[wheel].body
            carrier = template.body_of(str(template.role(body).parent)) if template.knows(body) else body
            frame = carrier if carrier is not None else template.root
            words = "it touches a further wheel, and nothing else: its axle"
            tubes[part] = Place(frame, frame, own[wheel].confidence, words, how="touch")
    return tubes


def _frame_beside(wheel: FurtherWheel, found: Mapping[str, Place], template: Template, drawn: Collection[str]) -> str:
    """The frame that is drawn and that the wheel beside it turns on, itself or by what it is steered with."""
    body: str | None = found[wheel.beside].body if wheel.beside in found else None
    for _ in template.roles:
        joined = [b for j in template.joints if body in (ends := template.bodies_of(j)) for b in ends if b != body]
        frames = [b for b in joined if b is not None and template.role(b).kind == "frame" and b in drawn]
        if frames:
            return frames[0]
        parent = template.role(body).parent if body is not None and template.knows(body) else None
        body = template.body_of(parent) if parent is not None else None
        if body is None:
            break
    return template.root


def _row(template: Template, carrier: str, side: str) -> Role | None:
    """The type's row of wheels on a body on one side."""
    rows = (r for r in template.roles if r.many and r.rigid and r.kind == "wheel" and r.side == side)
    return next((r for r in rows if r.parent is not None and template.body_of(r.parent) == carrier), None)


def spare_of(assembly: Assembly, template: Template) -> tuple[FurtherWheel, ...]:
    """The wheels of axles that the type does not have."""
    solids = solids_of(assembly)
    found = spare_wheels(solids, template, CONTACT[-1] * size_of(solids)) if solids else []

    def ids(members: Collection[int]) -> frozenset[str]:
        return frozenset(solids[i].part.id for i in members)

    return tuple(
        FurtherWheel(ids(w.members), ids(w.tyres), w.center, w.direction, solids[w.beside].part.id) for w in found
    )
