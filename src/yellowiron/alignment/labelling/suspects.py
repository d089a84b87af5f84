"""Whom to mistrust in an answer that is not whole: a body that was not found has left its parts to others, a joint that
was not found may be a false weld, and what nothing found joins to the root may be another part of the machine."""

from __future__ import annotations

from collections.abc import Mapping

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.model.template import Template

AROUND = 2
"""Parts of a body that was not found may be taken for bodies that are this many joints away."""
PUNY = 0.02
"""A frame of less than this share of the largest body's surface is none, and its parts are elsewhere."""
_TYPED = ("barrel", "rod", "wheel")


def shaken(solution: Solution, template: Template, surface: Mapping[str, float] | None = None) -> dict[str, str]:
    """Body → why it is doubtful. Barrels, rods and wheels are told by their shape: one that is missing casts no doubt
    on others. `surface`: body → m², for those that were found."""
    found = {*solution.hinge_of, *solution.slide_of}
    kinds = {r.name: r.kind for r in template.roles if r.rigid}
    optional = {r.name for r in template.roles if r.optional}
    jointed: set[str] = set()
    beside: dict[str, set[str]] = {b: set() for b in kinds}
    linked: dict[str, set[str]] = {b: set() for b in kinds}
    apart: list[tuple[str, str, str]] = []
    for joint in template.joints:
        bodies = [b for b in template.bodies_of(joint) if b is not None]
        if len(bodies) != 2 or not set(bodies) <= set(kinds):
            continue
        plain = not any(kinds[b] in _TYPED or b in optional for b in bodies)
        for own, other in (bodies, bodies[::-1]):
            if plain:
                beside[own].add(other)
            if joint.name in found:
                linked[own].add(other)
                jointed.add(own)
            elif plain and joint.type == "revolute":
                apart.append((own, other, joint.name))
    reached, front = {template.root}, [template.root]
    while front:
        front = [b for own in front for b in sorted(linked[own]) if b not in reached]
        reached.update(front)
    words = {b: "nothing that was found joins it to the rest of the machine" for b in kinds if b not in reached}
    surface = surface or {}
    least = PUNY * max(surface.values(), default=0.0)
    puny = {b for b, kind in kinds.items() if kind == "frame" and surface.get(b, least) < least}
    words |= dict.fromkeys(sorted(puny), "it is too small for a frame")
    jointed -= puny
    undrawn = _undrawn(template, set(kinds) - jointed - puny, kinds)
    for own, other, joint_name in apart:
        if not {own, other} & undrawn:
            words[own] = f"{joint_name} is not found: parts of {other} may be among its parts"
    for body, kind in kinds.items():
        if kind in _TYPED or body in optional or body in jointed or body in undrawn:
            continue
        ring, front = {body}, [body]
        for _ in range(AROUND):
            front = [b for own in front for b in sorted(beside[own]) if b not in ring]
            ring.update(front)
        words |= dict.fromkeys(sorted(ring - {body}), f"{body} is not found: its parts may be among these")
    return words


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
