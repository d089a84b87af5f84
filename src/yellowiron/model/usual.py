"""Where the bodies of a type usually are, and how large they are."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class AlongLimb:
    """Where a body of a linkage usually is on the `limb` that it hangs on: the box of its surface (`low`, `high`: along
    the limb from its middle to the end that carries `toward`, left, and across both), in lengths of the limb."""

    limb: str
    toward: str
    low: tuple[float, float, float]
    high: tuple[float, float, float]


@dataclass(frozen=True)
class Usual:
    """Where a body usually is, and how large: the box of its surface (`low`, `high`: forward, left, up of the middle of
    what the machine stands on), its `length`, both in machine sizes; `area`: its share of the machine's surface;
    `along`: where it is on its limb, however that is turned."""

    low: tuple[float, float, float]
    high: tuple[float, float, float]
    length: float
    area: float
    along: AlongLimb | None = None
