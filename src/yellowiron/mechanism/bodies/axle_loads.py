"""Where a machine's centre of mass is, by what its front axle carries.

Of a frame only what is outside is drawn: engine, fluids and ballast are not, and by volume and density its middle is
where its plates are. What the axles carry is published, or at least within what trucks of the type have, which do not
tip over; so the centre of mass of that body goes forward or back until the front axle carries it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.values import Known, known
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Balance, Template, without_side
from yellowiron.support.text import display

_WITHIN = 0.1
"""Of a body's length: so far from its ends its centre of mass stays."""
_FAR = 0.1
"""A share that is so much beyond the usual ones says that bodies' masses are not what they should be."""
_TOLD = 0.005
"""Of the weight: a share that is off by less is left as it is."""


@dataclass(frozen=True)
class AxleLoads:
    """How far forward (m) a machine's front and rear stand on the ground, what is known of the share of the weight that
    its front carries, and the body whose centre of mass is placed by it, between which places (m, forward)."""

    front: float
    rear: float
    published: Known | None
    balance: Balance
    reach: tuple[float, float]

    def share(self, masses: Mapping[str, float], centers: Mapping[str, Floats]) -> float:
        """Of the weight, what the front carries; `masses` (kg) and `centers` (3,) of bodies, machine frame."""
        middle = sum(mass * float(centers[body][0]) for body, mass in masses.items()) / sum(masses.values())
        return (middle - self.rear) / (self.front - self.rear)

    def far(self, masses: Mapping[str, float], centers: Mapping[str, Floats]) -> bool:
        """Whether volume and density say what no machine of the type has."""
        if self.balance.usual is None or sum(masses.values()) <= 0.0:
            return False
        least, most = self.balance.usual
        return not least - _FAR <= self.share(masses, centers) <= most + _FAR

    def forward_by(
        self, masses: Mapping[str, float], centers: Mapping[str, Floats], findings: list[Finding]
    ) -> tuple[str, float]:
        """The body whose centre of mass is placed, and by how much forward (m). MEC042 says what was done, and MEC043
        that a load cannot be met within the body."""
        body, total = self.balance.body, sum(masses.values())
        if masses.get(body, 0.0) <= 0.0:
            return body, 0.0
        share = self.share(masses, centers)
        wanted, source = share, ""
        if self.published is not None:
            wanted, source = self.published.value / total, self.published.source
        elif self.balance.usual is not None:
            wanted, source = float(np.clip(share, *self.balance.usual)), f"usual: {self.balance.source}"
        if not 0.0 < wanted < 1.0 or abs(wanted - share) < _TOLD:
            return body, 0.0
        per = masses[body] / total / (self.front - self.rear)
        place = float(centers[body][0])
        by = float(np.clip(place + (wanted - share) / per, *self.reach)) - place
        words = (
            f"By volume and density the front axle would carry {100.0 * share:.0f} % of {display(total, 'kg')}. The "
            f"centre of mass of '{body}' was placed {display(abs(by), 'm')} {'forward' if by > 0 else 'back'}, and it "
            f"carries {100.0 * (share + per * by):.0f} % ({source})."
        )
        hint = f'Give --set "{self.balance.specification}=… kg", or a sheet.'
        findings.append(Finding("MEC042", "warning" if self.published is None else "info", "mass", words, hint))
        if abs(share + per * by - wanted) > _TOLD:
            words = f"The front axle would carry {100.0 * wanted:.0f} % only with a centre of mass outside of '{body}'."
            findings.append(
                Finding("MEC043", "warning", "mass", words, "Check the weights, and that the CAD is whole.")
            )
        return body, by


def balance_of(template: Template, placement: Placement, specifications: Specifications) -> AxleLoads | None:
    """What is known of a machine's axle loads; None of a type that says nothing of them, or where an axle or the body
    that is placed is not there."""
    balance = template.balance
    if balance is None:
        return None
    front, rear = (_standing(names, placement) for names in (balance.front, balance.rear))
    points = placement.points_of(placement.rows_of_body(balance.body))
    if front is None or rear is None or front <= rear or not len(points):
        return None
    low, high = float(points[:, 0].min()), float(points[:, 0].max())
    inside = _WITHIN * (high - low)
    return AxleLoads(front, rear, known(specifications, balance.specification), balance, (low + inside, high - inside))


def _standing(names: tuple[str, ...], placement: Placement) -> float | None:
    """How far forward (m) bodies stand on the ground, the mean of them: the middle of each one's box."""
    own = [body for body in placement.bodies if without_side(body) in names]
    places = []
    for body in own:
        points = placement.points_of(placement.rows_of_body(body))
        if len(points):
            places.append(0.5 * float(points[:, 0].min() + points[:, 0].max()))
    return float(np.mean(places)) if places else None
