"""`actuators.json`: what one lever commands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from yellowiron.library.notation.quantities import quantity, yes
from yellowiron.library.notation.validated_json import Document, near
from yellowiron.library.parsing.variants import choices_of
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import ActuatorTemplate, CylinderTemplate, JointTemplate, Role
from yellowiron.support.text import with_article

_QUANTITY_DIMENSION: Mapping[str, str] = {
    "bore": "length",
    "rod_diameter": "length",
    "stroke": "length",
    "closed_length": "length",
    "pressure": "pressure",
    "flow": "flow",
    "extend_time": "time",
    "retract_time": "time",
    "speed": "speed",
    "torque": "torque",
    "line_pull": "force",
    "line_speed": "speed",
    "falls": "count",
    "low_angle": "angle",
    "high_angle": "angle",
}
"""What an actuator can need → its dimension. A motor's speed is the tyre's or track's at the ground, or its own: then
it is of dimension angular_speed."""

_PINS = ("barrel_joint", "rod_joint")


def read_actuators(
    document: Document, joints: tuple[JointTemplate, ...], roles: tuple[Role, ...]
) -> tuple[ActuatorTemplate, ...]:
    """The actuators of an `actuators.json`; defaults in SI. `TemplateError` for a joint or a part that is not there."""
    names = {fold(j.name): j for j in joints}
    parts = {fold(r.name): r.name for r in roles}

    def joint(name: str, *keys: object) -> JointTemplate:
        if fold(name) not in names:
            raise TemplateError(
                f"There is no joint '{name}'",
                where=document.at(*keys),
                hint=near(name, (j.name for j in joints)) or "Add it to joints.json.",
            )
        return names[fold(name)]

    def part(name: str, *keys: object) -> str:
        if fold(name) not in parts:
            raise TemplateError(
                f"There is no part '{name}'",
                where=document.at(*keys),
                hint=near(name, parts.values()) or "Add it to the hierarchy.",
            )
        return parts[fold(name)]

    def cylinder_of(entry: Mapping[str, Any], *keys: object) -> CylinderTemplate:
        slide = joint(entry["slide"], *keys, "slide")
        if slide.type != "prismatic":
            raise TemplateError(
                f"The slide '{slide.name}' of actuator '{keys[0]}' is not prismatic",
                where=document.at(*keys, "slide"),
                hint="Name the joint between its barrel and its rod.",
            )
        pins = [joint(entry[key], *keys, key).name for key in _PINS if key in entry]
        if len(pins) == 1:
            raise TemplateError(
                f"The cylinder '{slide.name}' of actuator '{keys[0]}' has a pin at one end only",
                where=document.at(*keys, next(key for key in _PINS if key in entry)),
                hint="Name barrel_joint and rod_joint, or neither where both its halves are fixed.",
            )
        if pins and "rams" in entry:
            raise TemplateError(
                f"The cylinder '{slide.name}' of actuator '{keys[0]}' has pins and rams",
                where=document.at(*keys, "rams"),
                hint="What hangs on pins is one cylinder of its own: 'rams' are for those that are fixed.",
            )
        hung, held = pins or (None, None)
        rams = [[part(half, *keys, "rams", k) for half in pair] for k, pair in enumerate(entry.get("rams", ()))]
        return CylinderTemplate(
            slide.name,
            hung,
            held,
            sign=entry.get("sign", 1),
            passive=yes(entry.get("passive")),
            when=choices_of(entry, "when"),
            rams=tuple((barrel, rod) for barrel, rod in rams),
            rod_through=yes(entry.get("rod_through")),
            specifications=dict(entry.get("specifications", {})),
        )

    actuators = []
    for name, entry in document.data.items():
        cylinders = [cylinder_of(c, name, "cylinders", i) for i, c in enumerate(entry.get("cylinders", ()))]
        motors = tuple(joint(j, name, "joints", i).name for i, j in enumerate(entry.get("joints", ())))
        needed, other = ("joints", cylinders) if entry["kind"] == "motor" else ("cylinders", motors)
        if other or not (cylinders or motors):
            raise TemplateError(
                f"Actuator '{name}' is {with_article(entry['kind'])} and needs '{needed}', and nothing else that moves",
                where=document.at(name),
                hint="docs/template-format.md has an example of each kind.",
            )
        actuators.append(
            ActuatorTemplate(
                name=name,
                kind=entry["kind"],
                cylinders=tuple(cylinders),
                joints=motors,
                specifications=dict(entry.get("specifications", {})),
                defaults={
                    key: _default(key, value, document.at(name, "defaults", key))
                    for key, value in entry.get("defaults", {}).items()
                },
                source=entry.get("source", ""),
                raises=tuple(joint(j, name, "raises", i).name for i, j in enumerate(entry.get("raises", ()))),
            )
        )
    return tuple(actuators)


def _default(key: str, value: float | str, where: str) -> float:
    """An actuator's default in SI; a speed may be a turning one ("11 rpm")."""
    dimension = _QUANTITY_DIMENSION[key]
    if dimension == "speed" and isinstance(value, str) and value.strip().endswith(("rpm", "rad/s", "deg/s")):
        dimension = "angular_speed"
    return quantity(value, dimension, where=where)
