"""`actuators.json`: what one lever commands."""

from __future__ import annotations

from collections.abc import Mapping

from yellowiron.library.notation.quantities import quantity, yes
from yellowiron.library.notation.validated_json import Document, near
from yellowiron.library.parsing.variants import choices_of
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import ActuatorTemplate, CylinderTemplate, JointTemplate

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
}
"""What an actuator can need → its dimension. A motor's speed is the tyre's or track's at the ground, or its own: then
it is of dimension angular_speed."""


def read_actuators(document: Document, joints: tuple[JointTemplate, ...]) -> tuple[ActuatorTemplate, ...]:
    """The actuators of an `actuators.json`; defaults in SI. `TemplateError` for a joint that is not there."""
    names = {fold(j.name): j for j in joints}

    def joint(name: str, *keys: object) -> JointTemplate:
        if fold(name) not in names:
            raise TemplateError(
                f"There is no joint '{name}'",
                where=document.at(*keys),
                hint=near(name, (j.name for j in joints)) or "Add it to joints.json.",
            )
        return names[fold(name)]

    actuators = []
    for name, entry in document.data.items():
        cylinders = []
        for i, cylinder in enumerate(entry.get("cylinders", ())):
            keys = (name, "cylinders", i)
            slide = joint(cylinder["slide"], *keys, "slide")
            if slide.type != "prismatic":
                raise TemplateError(
                    f"The slide '{slide.name}' of actuator '{name}' is not prismatic",
                    where=document.at(*keys, "slide"),
                    hint="Name the joint between its barrel and its rod.",
                )
            cylinders.append(
                CylinderTemplate(
                    slide.name,
                    joint(cylinder["barrel_joint"], *keys, "barrel_joint").name,
                    joint(cylinder["rod_joint"], *keys, "rod_joint").name,
                    sign=cylinder.get("sign", 1),
                    passive=yes(cylinder.get("passive")),
                    when=choices_of(cylinder, "when"),
                )
            )
        motors = tuple(joint(j, name, "joints", i).name for i, j in enumerate(entry.get("joints", ())))
        needed, other = ("cylinders", motors) if entry["kind"] == "cylinder" else ("joints", cylinders)
        if other or not (cylinders or motors):
            raise TemplateError(
                f"Actuator '{name}' is a {entry['kind']} and needs '{needed}', and nothing else that moves",
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
            )
        )
    return tuple(actuators)


def _default(key: str, value: float | str, where: str) -> float:
    """An actuator's default in SI; a speed may be a turning one ("11 rpm")."""
    dimension = _QUANTITY_DIMENSION[key]
    if dimension == "speed" and isinstance(value, str) and value.strip().endswith(("rpm", "rad/s", "deg/s")):
        dimension = "angular_speed"
    return quantity(value, dimension, where=where)
