"""The journal paper's updated joint template: limit names replaced by the numbers that a machine was built with."""

from __future__ import annotations

from typing import Any

from yellowiron.library.notation.quantities import number_text
from yellowiron.library.parsing.joints import DIMENSION, stated_gains
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Follows, JointTemplate, Template
from yellowiron.support.units import SI_UNIT


def filled_joints(
    template: Template, mechanism: Mechanism | None, specifications: Specifications
) -> dict[str, dict[str, Any]]:
    """The template's joints in the form of `joints.json`, each `Limit` name replaced by number and unit ("0.764 m").

    A name without a value of status `ok` takes the stroke that the mechanism's cylinder was built with, if there is
    one; else the name stays, and is asked for again. `source` says where a number came from. `load_documents` takes it
    back.
    """
    strokes = {c.slide: c for c in mechanism.cylinders} if mechanism is not None else {}
    result: dict[str, dict[str, Any]] = {}
    for joint in template.joints:
        entry: dict[str, Any] = {"joint_type": joint.type.capitalize(), "Body": list(joint.parts)}
        sources: dict[str, str] = {}
        if joint.lower is not None or joint.upper is not None:
            unit = SI_UNIT[DIMENSION[joint.type]]
            cylinder = strokes.get(joint.name)
            built = (cylinder.stroke, cylinder.sources.get("stroke", "")) if cylinder and cylinder.stroke > 0 else None
            entry["Limit"] = [
                _end(value, unit, specifications, built if end == "upper" else None, sources)
                for end, value in (("lower", joint.lower), ("upper", joint.upper))
            ]
        if joint.drive is not None:
            entry["Drive"] = [f"{joint.drive.capitalize()} Drive"]
        entry.update(_further(joint))
        if sources:
            entry["source"] = sources
        result[joint.name] = entry
    return result


def _end(
    value: float | str | None,
    unit: str,
    specifications: Specifications,
    built: tuple[float, str] | None,
    sources: dict[str, str],
) -> str | None:
    """One end of a limit as text; notes in `sources` where a name's number came from."""
    if value is None:
        return None
    if not isinstance(value, str):
        return number_text(value, unit)
    name = value.removeprefix("-").strip()
    sign = -1.0 if value.startswith("-") else 1.0
    found = specifications.get(name)
    if found is not None and found.status == "ok" and found.value is not None:
        sources[name] = _source(found)
        return number_text(sign * found.value, unit)
    if built is not None and sign > 0.0:
        sources[name] = built[1]
        return number_text(built[0], unit)
    return value


def _source(found: Specification) -> str:
    if found.evidence is None:
        return found.reason or found.source
    return f'{found.evidence.file}, page {found.evidence.page}: "{found.evidence.quote}"'


def _further(joint: JointTemplate) -> dict[str, Any]:
    entry: dict[str, Any] = dict(stated_gains(joint))
    if joint.free:
        entry["free"] = "Y"
    if joint.ring:
        entry["ring"] = "Y"
    if joint.rest is not None:
        entry["rest"] = (
            joint.rest if isinstance(joint.rest, str) else number_text(joint.rest, SI_UNIT[DIMENSION[joint.type]])
        )
    if joint.direction is not None:
        entry["direction"] = joint.direction.capitalize()
    if joint.follows is not None:
        entry["follows"] = _coupled(joint.follows, SI_UNIT[DIMENSION[joint.type]])
    for key, when in (("when", joint.when), ("drive_when", joint.drive_when), ("rest_when", joint.rest_when)):
        if when:
            entry[key] = {name: list(choices) for name, choices in when.items()}
    return entry


def _coupled(follows: Follows, unit: str) -> dict[str, Any]:
    offset = {"offset": number_text(follows.offset, unit)} if follows.offset else {}
    return {"joint": follows.joint, "ratio": follows.ratio, **offset, "kind": follows.kind}
