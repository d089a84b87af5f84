"""Which share of a machine's weight each body usually has: what geometry is held to where it cannot say.

A machine from a game or a converter has a drum that is drawn solid beside a frame that is one sheet: by volume and
density the drum is the machine. Where the whole weighs far from what it should, no body is lighter than half of its
type's usual share, and none heavier than twice of it; between these geometry decides.
"""

from __future__ import annotations

from collections.abc import Mapping

from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.template import Template, without_side
from yellowiron.support.text import display

WITHIN = 2.0
"""A body has its usual share of the weight to this factor: real machines of a type differ so (two excavators' buckets
have 2.9 and 4.3 %, their arms 4.0 and 3.1)."""
_TOLD = 1.1
"""A mass that is changed by more than this factor is told."""
_HALVINGS = 200


def shares_of(template: Template, placement: Placement) -> dict[str, float]:
    """Body → its usual share of the machine's weight (0 to 1), of the bodies that are placed and known: both sides of
    one share what the type says of them, and what is not drawn is of the body that it goes with."""
    bodies: dict[str, list[str]] = {}
    for role in template.roles:
        body = template.body_of(role.name)
        if role.rigid and not role.many and body is not None:
            bodies.setdefault(without_side(role.name), []).append(body)
    for role in template.roles:
        # Merged into another: a link that is not drawn.
        body = template.body_of(role.name)
        if not role.rigid and body is not None and without_side(role.name) in template.shares:
            bodies.setdefault(without_side(role.name), [body])
    found: dict[str, float] = {}
    for name, share in template.shares.items():
        placed = [body for body in bodies.get(name, ()) if placement.has_body(body)]
        for body in placed:
            found[body] = found.get(body, 0.0) + share / len(placed)
    # A cylinder that the type's machines have not all of them weighs as its others do.
    halves = {role.name: role.kind for role in template.roles if role.rigid and role.kind in ("barrel", "rod")}
    for kind in ("barrel", "rod"):
        own = [share for body, share in found.items() if halves.get(body) == kind]
        others = [b for b, k in halves.items() if k == kind and b not in found and placement.has_body(b)]
        found |= dict.fromkeys(others if own else [], sum(own) / max(1, len(own)))
    return found


def within_usual(
    masses: Mapping[str, float], usual: Mapping[str, float], kept: Mapping[str, float]
) -> dict[str, float]:
    """Masses (kg) of the same sum, in their proportions where that leaves a body within `WITHIN` of its `usual` share
    of the sum; bodies of `kept` weigh that."""
    total = sum(masses.values())
    free = [body for body in masses if body not in kept]
    left = total - sum(kept.values())
    if left <= 0.0 or not any(body in usual for body in free):
        return dict(masses)

    def at(scale: float) -> dict[str, float]:
        held = {}
        for body in free:
            mass = scale * masses[body]
            if body in usual:
                mass = min(max(mass, usual[body] * total / WITHIN), usual[body] * total * WITHIN)
            held[body] = mass
        return held

    low, high = 0.0, 1.0
    while sum(at(high).values()) < left and high < 1e12:
        high *= 2.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if sum(at(middle).values()) < left else (low, middle)
    held = at(high)
    # Where bounds leave no such sum, all bend alike.
    scale = left / sum(held.values())
    return {**{body: scale * mass for body, mass in held.items()}, **kept}


def shares_finding(before: Mapping[str, float], after: Mapping[str, float], kind: str) -> Finding | None:
    """MEC039: which masses were changed, those changed most first; None where none was by much."""
    ratios = {b: max(after[b], 1e-9) / max(before[b], 1e-9) for b in before}
    changed = sorted(
        (b for b in ratios if not 1.0 / _TOLD < ratios[b] < _TOLD), key=lambda b: -abs(after[b] - before[b])
    )
    if not changed:
        return None
    said = [f"{body} {display(before[body], 'kg')} → {display(after[body], 'kg')}" for body in changed[:3]]
    more = f" and {len(changed) - 3} more" if len(changed) > 3 else ""
    words = f"Volume and density cannot say what its bodies weigh: they were held to the usual shares of {kind}, "
    return Finding("MEC039", "warning", "mass", f"{words}{', '.join(said)}{more}.", "Give weights, or solids in CAD.")
