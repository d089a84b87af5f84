"""`sensors.json`: which sensors a machine has, of a template or of `--data`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from yellowiron.library.notation.quantities import quantity
from yellowiron.library.notation.validated_json import Document, near
from yellowiron.library.parsing.variants import choices_of
from yellowiron.model.errors import TemplateError
from yellowiron.model.sensor import FRAME_TYPES, PARAMETERS, SensorTemplate
from yellowiron.model.specification import fold
from yellowiron.model.template import Template
from yellowiron.support.text import with_article

_PLACES = ("site", "role", "joint", "cylinder", "actuator")
"""The keys of a mount, of which it has one."""
_POSE = {"site": ("offset", "orientation"), "role": ("position", "at", "on", "offset", "orientation")}


def read_sensors(document: Document, template: Template) -> tuple[SensorTemplate, ...]:
    """The sensors of a `sensors.json`, in its order. `template` has all but its sensors; `TemplateError` for a mount
    that it does not have and for a parameter out of range."""
    return tuple(read_sensor(document, name, entry, template, None) for name, entry in document.data.items())


def read_sensor(
    document: Document, name: str, entry: Mapping[str, Any], template: Template, base: SensorTemplate | None
) -> SensorTemplate:
    """One entry; where `base` is given, it changes that sensor."""
    sensor_type = entry.get("type", base.type if base else None)
    for key, given in (("type", sensor_type), ("mount", entry.get("mount", base.mount if base else None))):
        if not given:
            raise TemplateError(
                f"'{key}' is missing", where=document.at(name), hint=f"Sensor types: {', '.join(PARAMETERS)}."
            )
    stated = {} if base is None or base.type != sensor_type else dict(base.parameters)
    stated |= _parameters(document, name, sensor_type, entry.get("parameters", {}))
    everything = {key: p.default for key, p in PARAMETERS[sensor_type].items()} | stated
    for low, high in (("near", "far"), ("lowest", "highest"), ("minimum", "maximum")):
        if low in everything and high in everything and everything[low] >= everything[high]:
            raise TemplateError(
                f"'{low}' of sensor '{name}' is not below its '{high}'",
                where=document.at(name, "parameters"),
                hint="Exchange the two.",
            )
    mount = base.mount if base is not None else {}
    if "mount" in entry:
        mount = _mount(document, name, entry["mount"], template)
    _check_place(document, name, sensor_type, mount)
    return SensorTemplate(
        name=base.name if base else name,
        type=sensor_type,
        mount=mount,
        parameters=stated,
        when=choices_of(entry, "when") if "when" in entry or base is None else base.when,
        source=entry.get("source", base.source if base else ""),
    )


def _parameters(document: Document, name: str, sensor_type: str, entry: Mapping[str, Any]) -> dict[str, float]:
    known = {fold(key): key for key in PARAMETERS[sensor_type]}
    result: dict[str, float] = {}
    for key, value in entry.items():
        place = document.at(name, "parameters", key)
        if fold(key) not in known:
            hint = near(key, known.values()) or f"It has: {', '.join(known.values())}."
            raise TemplateError(
                f"{with_article(sensor_type).capitalize()} has no parameter '{key}'", where=place, hint=hint
            )
        parameter = PARAMETERS[sensor_type][known[fold(key)]]
        number = quantity(value, "count" if parameter.dimension == "number" else parameter.dimension, where=place)
        if not parameter.minimum <= number <= parameter.maximum:
            degrees = parameter.dimension == "angle"
            ends = [math.degrees(v) if degrees else v for v in (parameter.minimum, parameter.maximum)]
            raise TemplateError(
                f"'{key}' is {value}, and should be from {ends[0]:.4g} to {ends[1]:.4g}{' degrees' if degrees else ''}",
                where=place,
                hint=f"It is: {parameter.meaning}.",
            )
        result[known[fold(key)]] = number
    return result


def _mount(document: Document, name: str, entry: Mapping[str, Any], template: Template) -> dict[str, Any]:
    """A mount with its names as the template spells them and its numbers in SI."""
    where = document.at(name, "mount")
    places = [key for key in _PLACES if key in entry]
    if len(places) != 1:
        raise TemplateError(
            f"The mount of sensor '{name}' needs one place, and names {len(places)}",
            where=where,
            hint=f"One of: {', '.join(_PLACES)}.",
        )
    place = places[0]
    for key in entry:
        if key != place and key not in _POSE.get(place, ()):
            raise TemplateError(
                f"A mount on {with_article(place)} has no '{key}'",
                where=where,
                hint="docs/sensors.md has every key of a mount.",
            )
    if "position" in entry and ("at" in entry or "on" in entry):
        raise TemplateError(
            "A mount has either a 'position' or an 'at' with 'on'", where=where, hint="Keep one of the two."
        )
    mount: dict[str, Any] = {place: _spelled(entry[place], place, template, document.at(name, "mount", place))}
    for key, dimension in (("position", "length"), ("offset", "length"), ("orientation", "angle")):
        if key in entry:
            mount[key] = tuple(quantity(v, dimension, where=document.at(name, "mount", key)) for v in entry[key])
    if "at" in entry:
        mount["at"] = tuple(float(v) for v in entry["at"])
    if "on" in entry:
        mount["on"] = entry["on"]
    return mount


def _spelled(name: str, place: str, template: Template, where: str) -> str:
    slides = [j.name for j in template.joints if j.type == "prismatic"]
    known: Iterable[str] = {
        "site": [s.name for s in template.sites],
        "role": [r.name for r in template.roles if template.body_of(r.name) is not None],
        "joint": [j.name for j in template.joints],
        "cylinder": slides,
        "actuator": [a.name for a in template.actuators if a.cylinders],
    }[place]
    names = {fold(n): n for n in known}
    if fold(name) not in names:
        kind = (
            "cylinder's slide" if place == "cylinder" else "actuator with cylinders" if place == "actuator" else place
        )
        raise TemplateError(
            f"There is no {kind} '{name}' to mount a sensor on",
            where=where,
            hint=near(name, names.values()) or f"The template has: {', '.join(list(names.values())[:12])}.",
        )
    return names[fold(name)]


def _check_place(document: Document, name: str, sensor_type: str, mount: Mapping[str, Any]) -> None:
    """A sensor with a pose sits on a site or role, an encoder on a joint, a cylinder's sensor on a cylinder."""
    if sensor_type in FRAME_TYPES:
        allowed: tuple[str, ...] = ("site", "role")
    else:
        allowed = ("joint",) if sensor_type == "joint_encoder" else ("cylinder", "actuator")
    if not any(key in mount for key in allowed):
        place = next(key for key in _PLACES if key in mount)
        kind, wanted = with_article(sensor_type).capitalize(), with_article(" or ".join(allowed))
        raise TemplateError(
            f"{kind} is mounted on {wanted}, not on {with_article(place)}",
            where=document.at(name, "mount"),
            hint="docs/sensors.md says what each is mounted on.",
        )
