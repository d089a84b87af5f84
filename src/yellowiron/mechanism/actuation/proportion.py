"""What the template's defaults may ask of a machine that is far smaller or larger than those they were taken from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from yellowiron.mechanism.bodies.mass import Masses
from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.values import Known
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import DEFAULT, GRAVITY
from yellowiron.support.text import display

TORQUE = 0.05
"""A motor's default torque is at most this share of the machine's weight times the diagonal of its box. Swing motors
have 0.03 of it (21 t, 70 kN·m) to 0.05 (2 t, 4 kN·m), travel and wheel motors half of that."""
WEAKEST = 0.005
"""… and at least this one: of drawn machines of 1 to 90 t all but the two heaviest loaders have more by default."""
FORCE = 20.0
"""Cylinders of one actuator under default pressure push with at most so many times the machine's weight: those of
excavators and loaders of 1 to 20 t with 2 to 11."""
FASTEST = 1.0
"""Under default flow a stroke takes no fewer seconds: those of excavators and loaders take 1.5 to 6."""


@dataclass(frozen=True)
class Proportion:
    """A machine's `weight` (N) and the `length` (m) of its box's diagonal."""

    weight: float
    length: float

    def torque(self, default: Known, where: str, findings: list[Finding]) -> Known:
        """A default torque (N·m), no more and no less than suits the machine; MEC036 where that is another."""
        least, most = (share * self.weight * self.length for share in (WEAKEST, TORQUE))
        fit = min(max(default.value, least), most) if most > 0.0 else default.value
        if fit == default.value or default.value <= 0.0:
            return default
        return Known(fit, self._told(where, default.value, fit, "N·m", findings))

    def force(self, default: float, where: str, findings: list[Finding]) -> tuple[float, str]:
        """(N, source): a force of default pressure, no more than suits the machine; MEC036 where that is less."""
        most = FORCE * self.weight
        if not 0.0 < most < default:
            return default, ""
        return most, "; " + self._told(where, default, most, "N", findings)

    def _told(self, where: str, default: float, fit: float, unit: str, findings: list[Finding]) -> str:
        mass = display(self.weight / GRAVITY, "kg")
        how, done = ("more", "limited") if fit < default else ("less", "raised")
        words = (
            f"The template's default would drive it with {display(default, unit)}, far {how} than suits a machine of "
            f"{mass}: it is given {display(fit, unit)}."
        )
        findings.append(Finding("MEC036", "warning", where, words, "Give its weight and its drives, or a sheet."))
        return f"{DEFAULT}, {done} to what suits a machine of {mass}"


def proportion_of(placement: Placement, masses: Masses, bodies: Sequence[str]) -> Proportion:
    """Weight and size of a machine of those bodies."""
    rows = {body: placement.rows_of_body(body) for body in bodies}
    kg = sum(masses.factors[body].value * masses.moments[row].mass for body, own in rows.items() for row in own)
    return Proportion(GRAVITY * kg, placement.diagonal(row for own in rows.values() for row in own))
