"""Values from specifications, with the evidence that travels with them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from yellowiron.model.errors import MechanismError
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import DEFAULT
from yellowiron.model.specification import Specification, Specifications, share_of
from yellowiron.model.template import ActuatorTemplate, JointTemplate, Template
from yellowiron.support.text import display

_JOINT_KEYS: Mapping[str, str] = {
    "torque": "max_force",
    "pressure": "max_force",
    "bore": "max_force",
    "rod_diameter": "max_force",
    "speed": "max_velocity",
    "flow": "max_velocity",
    "extend_time": "max_velocity",
    "retract_time": "max_velocity",
    "stroke": "Limit",
}
"""Quantity of an actuator → the key of a joints document that states what it decides."""


@dataclass(frozen=True)
class Known:
    """A value in SI and where it came from, in words."""

    value: float
    source: str


def words(specification: Specification) -> str:
    """A specification's provenance: 'sheet: Lift Cylinder Stroke 764 mm, page 2 "Stroke 764 mm"'."""
    text = f"{specification.source}: {specification.name} {display(specification.value, specification.unit)}"
    if specification.evidence is not None:
        text += f", page {specification.evidence.page} “{specification.evidence.quote}”"
    return text + (" (example value)" if specification.example else "")


def known(specifications: Specifications, name: str | None) -> Known | None:
    """The value of a specification if its status is `ok`."""
    found = specifications.get(name) if name else None
    if found is None or found.status != "ok" or found.value is None:
        return None
    return Known(found.value, words(found))


def default(actuator: ActuatorTemplate, quantity: str, findings: list[Finding]) -> Known | None:
    """The template's own value of an actuator's quantity, with a finding that says it stands in for the sheet's."""
    value = actuator.defaults.get(quantity)
    if value is None:
        return None
    name = actuator.specifications.get(quantity)
    said, hint = (f"No sheet gives '{name}'", f'--set "{name}=…"') if name else _elsewhere(actuator, quantity)
    words = f"{said}: the template's {quantity.replace('_', ' ')} of {value:g} (SI) is used."
    findings.append(Finding("MEC025", "info", actuator.name, words, hint))
    return Known(value, DEFAULT)


def _elsewhere(actuator: ActuatorTemplate, quantity: str) -> tuple[str, str]:
    """What to say of a quantity for which the template names no specification: that, and where to state it."""
    joints = [c.slide for c in actuator.cylinders if not c.passive] or list(actuator.joints)
    key = _JOINT_KEYS.get(quantity)
    if key and joints:
        hint = f'State "{key}" of {", ".join(joints)} in a joints document (--data).'
    else:
        hint = "State it in the actuator's defaults, in a template of your own."
    return f"No specification gives its {quantity.replace('_', ' ')}", hint


def limit(entry: float | str | None, specifications: Specifications) -> tuple[float | None, dict[str, Any]]:
    """A template limit in SI: a number, or a specification's name with an optional minus. (None, evidence) for a name
    that is not known, with its name under `missing`."""
    if entry is None or not isinstance(entry, str):
        return entry, {}
    text = entry.strip()
    sign, name = (-1.0, text[1:].strip()) if text.startswith(("-", "−")) else (1.0, text)
    if (number := _number(name)) is not None:
        return sign * number, {}
    found = specifications.get(name)
    if found is None or found.status != "ok" or found.value is None:
        return None, {"missing": name}
    evidence: dict[str, Any] = {"specification": found.name, "source": found.source}
    if found.evidence is not None:
        evidence |= {"page": found.evidence.page, "quote": found.evidence.quote}
    return sign * found.value, evidence


def at_known_places(template: Template, specifications: Specifications) -> Template:
    """The template with joints that are held at a share of a specification held there, in SI. `MechanismError` for a
    specification that nothing gives."""

    def placed(joint: JointTemplate) -> JointTemplate:
        share = share_of(joint.at)
        if share is None:
            return joint
        value = known(specifications, share[1])
        if value is None:
            words = f"It is to be held at {joint.at}, and nothing says that"
            raise MechanismError(
                words, where=joint.name, hint=f'Give --set "{share[1]}=…", or --set {joint.chosen_by}=drawn.'
            )
        return replace(joint, at=share[0] * value.value)

    return replace(template, joints=tuple(map(placed, template.joints)))


def carried(specifications: Specifications) -> dict[str, Mapping[str, Any]]:
    """Every specification as the mechanism carries it: value, unit, status, example, page, quote, source."""
    return {
        s.name: {
            "value": s.value,
            "unit": s.unit,
            "status": s.status,
            "example": s.example,
            "page": s.evidence.page if s.evidence else None,
            "quote": s.evidence.quote if s.evidence else None,
            "source": s.source,
        }
        for s in specifications
    }


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
