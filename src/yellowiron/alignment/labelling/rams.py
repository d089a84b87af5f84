"""The halves of cylinders without pins, told by shape: they move with what carries them, and are roles of their own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.assignment.machine_frame import MachineFrame
from yellowiron.alignment.features.cylinders import DrawnCylinder
from yellowiron.alignment.labelling.place import Place
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.template import CylinderTemplate

_REASON = "half of a cylinder without pins, which moves the slide {}"


def with_rams(
    places: Mapping[int, Place], observation: Observation, answer: Answer, frame: MachineFrame | None
) -> dict[int, Place]:
    """The places of all parts, the halves of fixed rams with their roles. Of several rams of one slide left and right
    are told by the machine's frame."""
    found = dict(places)
    template = answer.template
    slides = {j.name: template.bodies_of(j) for j in template.joints if j.type == "prismatic"}
    for cylinder in (c for a in template.actuators for c in a.cylinders if c.rams and c.slide in slides):
        drawn = list(_between(cylinder, observation, found, answer))
        if len(drawn) != len(cylinder.rams):
            continue
        if len(drawn) > 1:
            if frame is None:
                continue
            left = frame.matrix[1]
            drawn.sort(key=lambda one: -float(left[:3] @ one.origin + left[3]))
        # Left before right before those of no side.
        order = {"l": 0, "r": 2}
        pairs = sorted(cylinder.rams, key=lambda pair: order.get(template.role(pair[0]).side or "", 1))
        for one, (barrel, rod) in zip(drawn, pairs, strict=True):
            for half, members in ((barrel, one.barrel), (rod, one.rod)):
                body = template.body_of(half)
                for i in sorted(members):
                    place = found.get(i)
                    if place is not None and place.body == body and place.role == body != half:
                        reason = f"{place.reason}; {_REASON.format(cylinder.slide)}"
                        found[i] = replace(place, role=half, reason=reason)
    return found


def _between(
    cylinder: CylinderTemplate, observation: Observation, places: Mapping[int, Place], answer: Answer
) -> Iterator[DrawnCylinder]:
    """The cylinders that are drawn between the two bodies of a slide, barrel and rod on the right ones."""
    barrel, rod = (answer.template.body_of(half) for half in cylinder.rams[0])

    def on(members: frozenset[int], body: str | None) -> bool:
        return sum(i in places and places[i].body == body for i in members) > 0.5 * len(members)

    for one in observation.cylinders:
        if on(one.barrel, barrel) and on(one.rod, rod):
            yield one
