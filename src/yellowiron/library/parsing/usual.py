"""Where the bodies of a type usually are, and how large they are: `usual.json`; how its hinges usually move where their
cylinders are not drawn: `hinges.json`; what share of the weight each body has: `shares.json`; what the front axle
carries of it: `balance.json`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from yellowiron.library.notation.validated_json import Document, near
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import (
    COMMON_HINGE,
    ActuatorTemplate,
    Balance,
    Role,
    UsualHinge,
    Wanted,
    without_side,
)
from yellowiron.model.usual import AlongLimb, Usual

_ROUNDED = 0.01
"""The shares of a whole machine are rounded one by one."""


def read_usual(document: Document, roles: tuple[Role, ...]) -> Mapping[str, Usual]:
    """Body → where it usually is. `TemplateError` for a name that is no body's."""
    known = {role.name for role in roles if role.rigid}
    found = {}
    for name, entry in document.data.items():
        if name not in known:
            raise TemplateError(
                f"'{name}' is no body of the template",
                where=document.at(name),
                hint=near(name, known) or "Write the names of bodies, as in hierarchy.json.",
            )
        along = _along(entry["along"], name, document, known) if "along" in entry else None
        found[name] = Usual(tuple(entry["low"]), tuple(entry["high"]), entry["length"], entry["area"], along)
    return found


def _along(entry: Mapping[str, Any], name: str, document: Document, known: set[str]) -> AlongLimb:
    """Where a body is on its limb. `TemplateError` for a limb, or what it carries, that is no body."""
    for key in ("limb", "toward"):
        if entry[key] not in known:
            raise TemplateError(
                f"'{entry[key]}' is no body of the template",
                where=document.at(name, "along", key),
                hint=near(entry[key], known) or "Write the names of bodies, as in hierarchy.json.",
            )
    return AlongLimb(entry["limb"], entry["toward"], tuple(entry["low"]), tuple(entry["high"]))


def read_hinges(document: Document, actuators: tuple[ActuatorTemplate, ...]) -> Mapping[str, UsualHinge]:
    """Actuator → how its hinge usually moves. `TemplateError` for a name that is no actuator's with cylinders, or a
    range without extent."""
    known = {actuator.name for actuator in actuators if actuator.cylinders}
    found = {}
    for name, entry in document.data.items():
        if name not in known:
            raise TemplateError(
                f"'{name}' is no actuator with cylinders",
                where=document.at(name),
                hint=near(name, known) or "Write the names of actuators, as in actuators.json.",
            )
        sense = entry.get("sense", 1)
        if "low" not in entry:
            found[name] = replace(COMMON_HINGE, sense=sense)
            continue
        low, high = (math.radians(entry[end]) for end in ("low", "high"))
        if low >= high:
            raise TemplateError("The range is empty", where=document.at(name), hint="low is less than high, degrees.")
        drawn = entry.get("from", "") == "drawn"
        found[name] = UsualHinge(low, high, math.radians(entry["speed"]), entry["torque"], drawn, sense)
    return found


def read_shares(document: Document, roles: tuple[Role, ...]) -> Mapping[str, float]:
    """Body → its usual share of the machine's weight, 0 to 1. `TemplateError` for a name that is no body's, of either
    side, or shares of more than the whole."""
    known = {name for role in roles for name in (role.name, without_side(role.name))}
    for name in document.data:
        if name not in known:
            raise TemplateError(
                f"'{name}' is no body of the template",
                where=document.at(name),
                hint=near(name, known) or "Write the names of bodies, without their side.",
            )
    shares = {name: percent / 100.0 for name, percent in document.data.items()}
    if sum(shares.values()) > 1.0 + _ROUNDED:
        raise TemplateError("The shares are more than 100 %", where=str(document.path), hint="They are percents of it.")
    return shares


def read_balance(document: Document, roles: tuple[Role, ...], wanted: tuple[Wanted, ...]) -> Balance:
    """What the front axle carries. `TemplateError` for a name that is no body's, or no wanted value's."""
    data, names = document.data, {name for role in roles for name in (role.name, without_side(role.name))}
    asked = {w.name for w in wanted}
    for key, given, known in (
        ("body", [data["body"]], names),
        ("front", data["front"], names),
        ("rear", data["rear"], names),
        ("specification", [data["specification"]], asked),
    ):
        for name in given:
            if name not in known:
                what = "wanted value" if known is asked else "body"
                raise TemplateError(
                    f"'{name}' is no {what} of the template",
                    where=document.at(key),
                    hint=near(name, known) or "See its documents.",
                )
    usual = data.get("usual")
    if usual is not None and usual["least"] >= usual["most"]:
        raise TemplateError("The least share is not less than the most", where=document.at("usual"), hint="Percent.")
    share = None if usual is None else (usual["least"] / 100.0, usual["most"] / 100.0)
    source = "" if usual is None else usual["source"]
    return Balance(data["body"], tuple(data["front"]), tuple(data["rear"]), data["specification"], share, source)
