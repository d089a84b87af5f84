"""The payload: how much a machine is rated for, and a mechanism with it in its tool."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Body, Mechanism
from yellowiron.model.units import parse_quantity

MATERIAL_DENSITY = 1800.0
"""kg/m³ of loose earth and gravel, for machines whose tipping load is not known."""


@dataclass(frozen=True)
class RatedPayload:
    """Kilograms, and where that comes from."""

    mass: float
    source: str


def rated_payload(mechanism: Mechanism) -> RatedPayload:
    """Half the static tipping load at full turn (ISO 14397-1, wheeled machines) where the sheet has it, else the heaped
    (else struck) capacity filled with loose earth; 0 where neither is known."""
    tipping = _value(mechanism, "Static Tipping Load Full Turn")
    if tipping is not None:
        return RatedPayload(0.5 * tipping, f"half the static tipping load at full turn, {tipping:g} kg (ISO 14397-1)")
    for name in ("Bucket Capacity Heaped", "Bucket Capacity Struck"):
        volume = _value(mechanism, name)
        if volume is not None:
            return RatedPayload(MATERIAL_DENSITY * volume, f"{name}, {volume:g} m³, at {MATERIAL_DENSITY:g} kg/m³")
    return RatedPayload(0.0, "neither a tipping load nor a capacity is known")


def parse_payload(text: str, usd_path: str | Path) -> RatedPayload:
    """A payload as a person gives it: kilograms, or `rated` for the machine file's own (`rated_payload`)."""
    if text.strip().casefold() == "rated":
        from yellowiron.usd import read_machine

        return rated_payload(read_machine(usd_path))
    value, unit = parse_quantity(text, where="--payload")
    if unit not in ("", "kg") or not value >= 0.0:
        raise YellowironError(
            "A payload is a mass of 0 kg or more", where=f"--payload {text}", hint="Write 5000, or rated."
        )
    return RatedPayload(value, "given")


def _value(mechanism: Mechanism, name: str) -> float | None:
    value = mechanism.specifications.get(name, {}).get("value")
    return float(value) if isinstance(value, int | float) else None


def tool(mechanism: Mechanism) -> Body:
    """The body that carries the load: the one with most of the machine's sites.

    `YellowironError` where there is no site.
    """
    if not mechanism.sites:
        raise YellowironError(
            "It is not known which body carries the payload",
            where=mechanism.name,
            hint="Give the tool a site in the template, or leave the payload out.",
        )
    carrying = [site.body for site in mechanism.sites]
    return mechanism.body(max(dict.fromkeys(carrying), key=carrying.count))


def with_payload(mechanism: Mechanism, mass: float) -> Mechanism:
    """The mechanism with a payload (kg) in its tool, as a ball of loose earth that moves with it.

    Its middle is the middle of the tool's extents: inside a bucket.
    """
    if mass == 0.0:
        return mechanism
    body = tool(mechanism)
    points = np.asarray(body.hull) if len(body.hull) else np.asarray(body.center_of_mass)[None]
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
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
