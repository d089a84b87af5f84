"""What geometry alone finds in a CAD model: bodies, and the joints between them, before any template is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from yellowiron.model.finding import Finding

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class FoundBody:
    """Parts that move as one. `kind`: `frame`, `arm`, `barrel`, `rod`, `wheel` or ""; `labels` are names that its parts
    and their assemblies have, most telling first; `reason` says why it is a body; `name` is what the file itself calls
    it, where it is a robot description."""

    parts: tuple[str, ...]
    kind: str
    labels: tuple[str, ...]
    reason: str
    name: str = ""


@dataclass(frozen=True)
class FoundJoint:
    """A joint of the bodies `a`, the one nearer to the root, and `b` (indices): about or along the line through `point`
    (metres) in the unit `direction` (of a slide: towards the rod's end), both in the CAD file's frame. `type`:
    `revolute`, `prismatic` or `fixed`. `pins` are ids of the parts that are its pin. `loop`: it is one of a closed
    chain; `upright`: its axis is the machine's upright. `radius` (metres) of its pin or rod. `name` as of a body."""

    type: Literal["revolute", "prismatic", "fixed"]
    a: int
    b: int
    point: Vector
    direction: Vector
    radius: float
    pins: tuple[str, ...]
    reason: str
    loop: bool = False
    upright: bool = False
    name: str = ""


@dataclass(frozen=True)
class FoundMachine:
    """Bodies, the `root` among them (index), joints, how many `tracks` it runs on, and `findings` on what could not be
    told."""

    name: str
    bodies: tuple[FoundBody, ...]
    root: int
    joints: tuple[FoundJoint, ...]
    tracks: int = 0
    findings: tuple[Finding, ...] = ()
