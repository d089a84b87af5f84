"""Couplings that are not drawn, with their two crossed pins, where a plain hinge in their stead would bind.

What several arms carry (a dozer's blade on its push arms) tilts only if it may turn on each of them both ways. Turned
on one of them one way only, it does not sway, which its tag link would see to. So a hinge stands in for the coupling
of the first arm, and a body that no part plays for each further one: for all of them if a strut that keeps it from
swaying is drawn.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.mechanism.bodies.hidden_knuckles import HiddenKnuckle
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.placement import Placement
from yellowiron.model.geometry import DIRECTIONS
from yellowiron.model.rows import names_known
from yellowiron.model.template import JointTemplate, Template
from yellowiron.support.vectors import unit

_CROSSED = 0.5
"""Pins cross if the one is across the other by this share of its length."""


def with_hidden_couplings(
    whole: Template, drawn: Template, frames: Mapping[str, JointFrame], placement: Placement
) -> tuple[Template, dict[str, JointFrame], dict[str, HiddenKnuckle]]:
    """The template `drawn` (the `whole` one without what is not drawn) and its frames with hidden couplings in the
    place of the hinges that stand in for them (`model.rows.without_absent_couplings`), and those by name."""
    known = [j for j in whole.joints if names_known(j, whole)]
    names = {j.name for j in known}
    stands: dict[str, tuple[str, JointTemplate, JointTemplate]] = {}
    for name, frame in frames.items():
        own = next((j for j in known if name not in names and frame.joint.parts[1] in j.parts), None)
        coupling = next((str(b) for b in whole.bodies_of(own) if b not in frame.bodies), None) if own else None
        if own is None or coupling is None or placement.has_body(coupling):
            continue
        others = [j for j in known if j is not own and coupling in whole.bodies_of(j) and j.type == "revolute"]
        if len(others) == 1 and {*whole.bodies_of(others[0])} & {*frame.bodies}:
            stands[name] = (coupling, own, others[0])
    bearers = {b for name in stands for b in frames[name].bodies}
    roles, joints, found = list(drawn.roles), list(drawn.joints), dict(frames)
    hidden: dict[str, HiddenKnuckle] = {}
    seen: set[str] = set()
    for name, (coupling, own, second) in stands.items():
        frame = frames[name]
        carried = next(str(b) for b in whole.bodies_of(second) if b != coupling)
        if carried not in seen and not _held_sideways(carried, bearers, known, whole, placement):
            seen.add(carried)
            continue
        bearer = next(b for b in frame.bodies if b != carried)
        way = DIRECTIONS[second.direction or "vertical"]
        across = way - float(way @ frame.axis) * frame.axis
        if np.linalg.norm(across) < _CROSSED:
            continue
        source = {**frame.source, "coupling": f"'{coupling}' is not drawn: its two pins cross where this was found"}
        roles = [replace(r, rigid=True, optional=False) if r.name == coupling else r for r in roles]
        first = replace(own, parts=(bearer, coupling))
        other = replace(second, parts=(coupling, carried))
        joints = [k for j in joints for k in ((first, other) if j.name == name else (j,))]
        del found[name]
        found[first.name] = replace(frame, joint=first, bodies=(bearer, coupling), source=source)
        found[other.name] = replace(
            frame, joint=other, bodies=(coupling, carried), axis=unit(across), weight=0.0, source=source
        )
        hidden[coupling] = HiddenKnuckle(coupling, bearer, frame.anchor)
    made = replace(drawn, roles=tuple(roles), joints=tuple(joints))
    return made, {j.name: found[j.name] for j in made.joints if j.name in found}, hidden


def _held_sideways(
    carried: str, bearers: Collection[str], known: Sequence[JointTemplate], whole: Template, placement: Placement
) -> bool:
    """Whether a strut is drawn, a body on two balls, from what is carried to something else than what bears it."""
    ends = [(j.type, {str(b) for b in whole.bodies_of(j)}) for j in known]
    for body in {b for _, pair in ends if carried in pair for b in pair} - {carried, *bearers}:
        own = [(kind, pair - {body}) for kind, pair in ends if body in pair]
        if placement.has_body(body) and len(own) == 2 and all(kind == "spherical" for kind, _ in own):
            return not any(pair & {*bearers} - {carried} for _, pair in own)
    return False
