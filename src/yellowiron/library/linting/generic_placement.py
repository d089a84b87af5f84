"""Places for the joints of a linkage in space, before any geometry is known: at random, save what the template says.

A pivot that states its direction has it; what is on the left has a mirror image on the right; a slide runs from the pin
of the one body to the pin of the other, square to those that are pivots. Any such set is a closed pose of links of some
shape, and has the generic mobility with probability 1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.model.geometry import DIRECTIONS, Floats
from yellowiron.model.rows import split_index
from yellowiron.model.template import JointTemplate, Template
from yellowiron.support.spatial import SpatialJoint

_MIRROR = np.array([1.0, -1.0, 1.0])


def placed(
    template: Template,
    joints: Sequence[JointTemplate],
    ends: Mapping[str, tuple[str, str]],
    random: np.random.Generator,
) -> list[SpatialJoint]:
    """The joints (`ends`: their bodies, welded ones being one) at random places."""
    at: dict[str, tuple[Floats, Floats]] = {}
    images = {_mirrored(template, joint): joint.name for joint in joints}
    for joint in joints:
        image = images.get(tuple(sorted(joint.parts)))
        anchor, axis = at.get(image or "", (None, None)) if image != joint.name else (None, None)
        if anchor is None or axis is None:
            anchor, axis = random.uniform(-1.0, 1.0, 3), _unit(random.normal(size=3))
        else:
            anchor, axis = anchor * _MIRROR, axis * _MIRROR
        at[joint.name] = (anchor, DIRECTIONS.get(joint.direction or "", axis))
    for joint in joints:
        if joint.type == "prismatic" and joint.direction is None:
            at[joint.name] = (at[joint.name][0], _between_pins(joint, joints, ends, at))
    return [
        SpatialJoint(
            joint.name,
            joint.type,
            ends[joint.name],
            *at[joint.name],
            (joint.follows.joint, joint.follows.ratio) if joint.follows is not None else None,
        )
        for joint in joints
    ]


def _between_pins(
    slide: JointTemplate,
    joints: Sequence[JointTemplate],
    ends: Mapping[str, tuple[str, str]],
    at: Mapping[str, tuple[Floats, Floats]],
) -> Floats:
    """A slide's direction: along the line between the only other joints of its two bodies, square to those of them that
    are pivots; at random where there is no such line."""
    pins = []
    for body in ends[slide.name]:
        others = [j for j in joints if body in ends[j.name] and j is not slide]
        if len(others) != 1 or others[0].type not in ("revolute", "spherical"):
            return at[slide.name][1]
        pins.append(others[0])
    line = at[pins[1].name][0] - at[pins[0].name][0]
    for pin in pins:
        if pin.type == "revolute":
            line = line - (line @ at[pin.name][1]) * at[pin.name][1]
    return _unit(line)


def _mirrored(template: Template, joint: JointTemplate) -> tuple[str, ...]:
    """The parts of a joint's mirror image, sorted; its own where none of them is on a side."""
    return tuple(sorted(_other_side(template, part) for part in joint.parts))


def _other_side(template: Template, part: str) -> str:
    name, _ = split_index(part)
    side = template.role(name).side
    if not side or not name.endswith(f"_{side}"):
        return part
    return name[: -len(side)] + ("r" if side == "l" else "l")


def _unit(vector: Floats) -> Floats:
    return np.asarray(vector / np.linalg.norm(vector))
