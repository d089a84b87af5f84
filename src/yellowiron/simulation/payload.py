"""The payload: how much a machine is rated for, and a mechanism with it in its tool."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Body, Mechanism, Site
from yellowiron.support.units import parse_quantity

MATERIAL_DENSITY = 1800.0
"""kg/m³ of loose earth and gravel: how large a ball a payload is."""


@dataclass(frozen=True)
class RatedPayload:
    """Kilograms, where that comes from, and at which specification's place alone, "" for anywhere."""

    mass: float
    source: str
    at: str = ""


def rated_payload(mechanism: Mechanism) -> RatedPayload:
    """By the first of the template's rules (`tests.json`, payload) whose specification is known; 0 where none is."""
    rules = mechanism.payload.rated if mechanism.payload is not None else ()
    for rule in rules:
        value, _, _ = specified(mechanism, rule.specification)
        if value is not None:
            words = f"{rule.specification}, {value:g}, × {rule.factor:g}"
            return RatedPayload(rule.factor * value, f"{words}: {rule.source}" if rule.source else words, rule.at)
    names = " or ".join(rule.specification for rule in rules)
    return RatedPayload(0.0, f"no sheet gives {names}" if names else "the template says no rated payload")


def payload_over_strokes(mechanism: Mechanism) -> RatedPayload:
    """What full strokes are driven with: the rated payload, but nothing where that is rated at one place alone (a
    crane's radius), since no drive has to hold it elsewhere."""
    rated = rated_payload(mechanism)
    if not rated.at:
        return rated
    return RatedPayload(0.0, f"{rated.mass:g} kg are rated at {rated.at} alone: strokes are driven empty")


def parse_payload(text: str, usd_path: str | Path) -> RatedPayload:
    """A payload as a person gives it: kilograms, or `rated` for the machine file's own (`payload_over_strokes`)."""
    if text.strip().casefold() == "rated":
        from yellowiron.usd import read_mechanism

        return payload_over_strokes(read_mechanism(usd_path))
    try:
        value, unit = parse_quantity(text, where="--payload")
    except YellowironError:
        value, unit = -1.0, ""
    if unit not in ("", "kg") or not 0.0 <= value < float("inf"):
        raise YellowironError(
            "A payload is a mass of 0 kg or more", where=f"--payload {text}", hint="Write 5000, 5.5 t, or rated."
        )
    return RatedPayload(value, "given")


def load_site(mechanism: Mechanism) -> Site | None:
    """Where the template says that the load's middle is; None where it does not, or the place was not found."""
    wanted = mechanism.payload.site if mechanism.payload is not None else ""
    return next((site for site in mechanism.sites if site.name == wanted), None)


def tool(mechanism: Mechanism) -> Body:
    """The body that carries the load: that of the load's site, else the one with most of the machine's sites.

    `YellowironError` where there is no site.
    """
    if not mechanism.sites:
        raise YellowironError(
            "It is not known which body carries the payload",
            where=mechanism.name,
            hint="Give the tool a site in the template, or leave the payload out.",
        )
    site = load_site(mechanism)
    if site is not None:
        return mechanism.body(site.body)
    carrying = [site.body for site in mechanism.sites]
    return mechanism.body(max(dict.fromkeys(carrying), key=carrying.count))


def with_payload(mechanism: Mechanism, mass: float) -> Mechanism:
    """The mechanism with a payload (kg) in its tool, as a ball of loose earth that moves with it.

    Its middle is the load's site, else the middle of the tool's extents.
    """
    if mass == 0.0:
        return mechanism
    body = tool(mechanism)
    points = np.asarray(body.hull) if len(body.hull) else np.asarray(body.center_of_mass)[None]
    site = load_site(mechanism)
    middle = np.asarray(site.position) if site is not None else 0.5 * (points.min(axis=0) + points.max(axis=0))
    radius = (mass / MATERIAL_DENSITY * 0.75 / np.pi) ** (1.0 / 3.0)
    own = np.asarray(body.center_of_mass)
    center = (body.mass * own + mass * middle) / (body.mass + mass)
    inertia = np.asarray(body.inertia) + 0.4 * mass * radius**2 * np.eye(3)
    for kilograms, point in ((body.mass, own), (mass, middle)):
        arm = point - center
        inertia = inertia + kilograms * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    x, y, z = (float(v) for v in center)
    heavy = replace(body, mass=body.mass + mass, center_of_mass=(x, y, z), inertia=inertia)
    return replace(mechanism, bodies=tuple(heavy if b.name == body.name else b for b in mechanism.bodies))
