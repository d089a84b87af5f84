"""Suspect bodies: whom to mistrust in an answer that is not whole. A body that was not found has left its parts to
others, a joint that was not found may be a false weld, and what nothing found joins to the root may be another part of
the machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from yellowiron.alignment.assignment.cp_sat import TYPED, Solution
from yellowiron.model.template import Template

AROUND = 2
"""Parts of a body that was not found may be taken for bodies that are this many joints away."""
PUNY = 0.02
"""A frame of less than this share of the largest body's surface is none, and its parts are elsewhere."""


@dataclass(frozen=True)
class _Joints:
    """The template's joints between bodies as they were found or not. `beside`: body → those it has a joint with, where
    both are plain (neither optional nor told by shape); `linked`: by a joint that was found; `apart`: (body, other,
    joint) of hinges of plain bodies that were not found, both ways round."""

    beside: Mapping[str, set[str]]
    linked: Mapping[str, set[str]]
    apart: Sequence[tuple[str, str, str]]


def suspect_bodies(
    solution: Solution, template: Template, surface: Mapping[str, float] | None = None
) -> dict[str, str]:
    """Body → why it is doubtful. Barrels, rods and wheels are told by their shape: one that is missing casts no doubt
    on others. `surface`: body → m², for those that were found."""
    kinds = {r.name: r.kind for r in template.roles if r.rigid}
    special = {r.name for r in template.roles if r.optional} | {b for b, kind in kinds.items() if kind in TYPED}
    joints = _joints(solution, template, kinds, special)
    reached = _within(template.root, joints.linked)
    words = {b: "nothing that was found joins it to the rest of the machine" for b in kinds if b not in reached}
    puny = _puny_frames(kinds, surface or {})
    words |= dict.fromkeys(sorted(puny), "it is too small for a frame")
    jointed = {b for b, others in joints.linked.items() if others} - puny
    undrawn = _undrawn(template, set(kinds) - jointed - puny, kinds)
    for own, other, joint in joints.apart:
        if not {own, other} & undrawn:
            words[own] = f"{joint} is not found: parts of {other} may be among its parts"
    elsewhere = special | jointed | undrawn
    for body in kinds:
        if body not in elsewhere:
            around = _within(body, joints.beside, steps=AROUND) - {body}
            words |= dict.fromkeys(sorted(around), f"{body} is not found: its parts may be among these")
    return words


def _joints(solution: Solution, template: Template, kinds: Mapping[str, str], special: set[str]) -> _Joints:
    found = {*solution.hinge_of, *solution.slide_of}
    apart: list[tuple[str, str, str]] = []
    joints = _Joints({b: set() for b in kinds}, {b: set() for b in kinds}, apart)
    for joint in template.joints:
        bodies = [b for b in template.bodies_of(joint) if b is not None]
        if len(bodies) != 2 or not set(bodies) <= set(kinds):
            continue
        plain = not special & set(bodies)
        for own, other in (bodies, bodies[::-1]):
            if plain:
                joints.beside[own].add(other)
            if joint.name in found:
                joints.linked[own].add(other)
            elif plain and joint.type == "revolute":
                apart.append((own, other, joint.name))
    return joints


def _within(start: str, joints: Mapping[str, set[str]], *, steps: int | None = None) -> set[str]:
    """The bodies that so many joints lead to from a body; without `steps`, however many."""
    reached, front = {start}, [start]
    while front and steps != 0:
        front = [b for own in front for b in sorted(joints[own]) if b not in reached]
        reached.update(front)
        steps = None if steps is None else steps - 1
    return reached


def _puny_frames(kinds: Mapping[str, str], surface: Mapping[str, float]) -> set[str]:
    """Frames whose surface is next to nothing beside the largest body's."""
    least = PUNY * max(surface.values(), default=0.0)
    return {b for b, kind in kinds.items() if kind == "frame" and surface.get(b, least) < least}


def _undrawn(template: Template, absent: set[str], kinds: dict[str, str]) -> set[str]:
    """Those of the absent bodies that hang together with an absent hydraulic cylinder: a whole chain that is not drawn,
    whose parts are nowhere, and not one body that was welded to another."""
    pairs = [bodies for j in template.joints if set(bodies := template.bodies_of(j)) <= absent]
    undrawn = {b for b in absent if kinds[b] in ("barrel", "rod")}
    grown = True
    while grown:
        more = {b for pair in pairs for b in pair if b is not None and undrawn & set(pair)}
        grown = not more <= undrawn
        undrawn |= more
    return undrawn
