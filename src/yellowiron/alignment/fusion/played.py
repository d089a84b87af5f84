"""Which bodies of a variant a labelling plays, and what the variant loses by the others."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from yellowiron.alignment.fusion.pieces import LARGE, Piece
from yellowiron.alignment.fusion.votes import BARS, Features
from yellowiron.model.template import Template

SLIGHT = 0.03
"""Of a body's usual share of the surface: with less it is not drawn, and what was taken for it is a pin or a lug."""

ENOUGH = 7
"""So many leading pieces say of a machine's being drawn in part as much as more of them."""


def drawn_bodies(
    pieces: Sequence[Piece], labels: np.ndarray, bodies: Sequence[str], template: Template, surface: float
) -> set[str]:
    """The bodies that pieces are of (`labels`: (pieces,) numbers of `bodies`, or one more for none), those left out
    whose pieces are pins and lugs beside what the body usually is. `surface`: the machine's, m²."""
    share = dict.fromkeys(bodies, 0.0)
    for piece, n in zip(pieces, labels.tolist(), strict=True):
        if n < len(bodies):
            share[bodies[n]] += piece.area / surface
    usual = template.usual
    return {b for b, s in share.items() if s > 0.0 and (b not in usual or s >= SLIGHT * usual[b].area)}


def missing_bodies(template: Template, played: Collection[str]) -> list[str]:
    """The bodies that nothing plays and that tell against a variant: where no hydraulic cylinder is drawn at all, none
    of theirs do."""
    drawn = any(template.role(b).kind in BARS for b in played)
    wanted = [r for r in template.roles if r.rigid and not r.optional and r.name not in played]
    return [r.name for r in wanted if drawn or r.kind not in BARS]


def lacks(template: Template, played: Collection[str], absent: Collection[str] = (), pieces: int = 1) -> Features:
    """What speaks against a variant: every body that it has (`more`: what a simpler machine explains as well is the
    simpler one), and every one of them that is not `played` (`missing`). Links may be too small for a leading piece:
    they are not missed; nor are the `absent` bodies, which a part of a machine lacks. What speaks against its being a
    part (`part`) is as many times as it has leading `pieces`, for and against which each speaks, but not more than
    `ENOUGH`: the places of many err together."""
    bodies = {r.name for r in template.roles if r.rigid and not r.optional} - set(absent)
    missed = [b for b in missing_bodies(template, played) if b in bodies and not _slight(b, template)]
    return {"missing": len(missed), "more": len(bodies), "part": float(min(pieces, ENOUGH) if absent else 0)}


def _slight(body: str, template: Template) -> bool:
    """Whether a body is usually so small that no leading piece may be of it."""
    small = body in template.usual and template.usual[body].area < 2.0 * LARGE
    return small and template.role(body).kind not in BARS


def beside_lost_arms(template: Template, played: Collection[str]) -> set[str]:
    """The bodies beside an arm that nothing plays though what it joins is there, a frame as part of the next: its parts
    are among theirs. No cylinder need be drawn, but a bucket hangs on something."""
    beside: dict[str, set[str]] = {}
    for own, other in (pair for a, b in map(template.bodies_of, template.joints) for pair in ((a, b), (b, a))):
        if own and other and not {template.role(own).kind, template.role(other).kind} & {*BARS, "wheel"}:
            beside.setdefault(own, set()).add(other)
    frames = {b for b, others in beside.items() if template.role(b).kind == "frame" and others & {*played}}
    there = frames.union(played)
    lost = [
        b for b, others in beside.items()
        if b not in played and template.role(b).kind == "arm" and not template.role(b).optional
        and not _slight(b, template) and len(others & there) > 1
    ]  # fmt: skip
    return set().union(*(beside[b] for b in lost))
