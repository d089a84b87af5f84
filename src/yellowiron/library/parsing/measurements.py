"""`measurements.json`: the sites of a machine, and what is measured between them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from yellowiron.library.notation.quantities import quantity
from yellowiron.library.notation.validated_json import Document, near
from yellowiron.library.parsing.variants import choices_of
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import JointTemplate, MeasurementTemplate, Role, SiteTemplate


def read_measurements(
    document: Document, roles: tuple[Role, ...], joints: tuple[JointTemplate, ...]
) -> tuple[tuple[SiteTemplate, ...], tuple[MeasurementTemplate, ...]]:
    """The sites and measurements of a `measurements.json`; texts with a unit become SI numbers."""
    bodies = {fold(r.name): r.name for r in roles if r.rigid}
    parts = {fold(r.name): r.name for r in roles}
    names = {fold(j.name): j.name for j in joints}

    def known(name: str, where: str, kinds: Mapping[str, str], word: str) -> str:
        if fold(name) not in kinds:
            raise TemplateError(f"There is no {word} '{name}'", where=where, hint=near(name, kinds.values()))
        return kinds[fold(name)]

    sites = []
    for name, entry in document.data.get("sites", {}).items():
        rule = {k: v for k, v in entry.items() if k not in ("body", "when")}
        for key in ("joint", "edge_from", "inside_from", "along", "pointing"):
            if key in rule:
                place, given = document.at("sites", name, key), rule[key]
                several = isinstance(given, list)
                found = tuple(known(joint, place, names, "joint") for joint in (given if several else [given]))
                rule[key] = found if several else found[0]
        for key in ("middle_of", "floor_of", "if_high"):
            if key in rule:
                rule[key] = known(rule[key], document.at("sites", name, key), parts, "role")
        body = known(entry["body"], document.at("sites", name, "body"), bodies, "body")
        sites.append(SiteTemplate(name, body, rule, choices_of(entry, "when")))
    measurements = []
    for i, entry in enumerate(document.data.get("measurements", ())):
        place = document.at("measurements", i)
        measurements.append(
            MeasurementTemplate(
                name=entry["name"],
                specification=entry.get("specification", entry["name"]),
                quantity=in_si(entry["quantity"], place),
                steps=tuple(in_si(step, place) for step in entry.get("steps", ())),
                unit=entry.get("unit", "m"),
                definition=entry.get("definition", ""),
                when=choices_of(entry, "when"),
                unpublished=entry.get("unpublished", ""),
            )
        )
    return tuple(sites), tuple(measurements)


def in_si(value: Any, where: str) -> Any:
    """A measurement's quantity or step with every `value` that is a text with a unit as a number in SI."""
    if isinstance(value, Mapping):
        return {
            k: _measure(v, where) if k == "value" and isinstance(v, str) else in_si(v, where) for k, v in value.items()
        }
    if isinstance(value, list):
        return tuple(in_si(v, where) for v in value)
    return value


def _measure(text: str, where: str) -> float:
    dimension = "angle" if text.strip().endswith(("deg", "°", "rad")) else "length"
    return quantity(text, dimension, where=where)
