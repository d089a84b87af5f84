"""A machine whose hook hangs on rope alone: it swings, turns and can be lifted, and a rope pulls and never pushes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from yellowiron.exporters.tendons import ASIDE, Ends, heavier
from yellowiron.model.mechanism import Joint, Mechanism, Vector

SPARE = 1.0
"""Metres of line that are left at the winch with the hook let down as far as it goes."""
FAR = 1e3
"""Metres that a hook goes down whose slide has no limit."""
_LIGHT = 1e-5
"""Of the machine's mass: a winch's body, which moves no mass worth telling."""


@dataclass(frozen=True)
class Rope:
    """A rope that carries a block by `falls` lines: its `name`, the `slide` that the block moved along, which is the
    winch's now, and the bodies that it runs between with the points there (machine frame, drawn pose): the head's and
    the block's. `length` is their distance as drawn, metres, along the slide's `axis` (unit vector, down); the winch's
    body weighs `winch` kilograms."""

    name: str
    slide: Joint
    falls: int
    ends: Ends
    length: float
    winch: float

    @property
    def axis(self) -> Vector:
        """From the head to the block."""
        (_, head), (_, block) = self.ends
        x, y, z = (float(v) / self.length for v in np.subtract(block, head))
        return x, y, z

    @property
    def lead(self) -> float:
        """Metres from the head to the winch as drawn: what can be paid out, and some to spare."""
        return (self.slide.upper if self.slide.upper is not None else FAR) + SPARE


def with_ropes(mechanism: Mechanism) -> tuple[Mechanism, tuple[Rope, ...]]:
    """The machine without the bodies that stand for ropes on which blocks hang, and what they are.

    Such a rope hangs on a ball that is free and does nothing but carry the block that a winch moves along it. The block
    is the first body of a chain of its own, among `floating`; the rope's mass is at its two ends as a lever's would be.
    Ropes that hold a boom between two pins stay: its weight keeps them taut.
    """
    ropes = []
    for actuator in mechanism.actuators:
        for entry in actuator.joints if actuator.falls else ():
            rope = _rope(mechanism, mechanism.joint(entry.joint), entry.sign, actuator.falls)
            ropes += [rope] if rope is not None else []
    if not ropes:
        return mechanism, ()
    gone = {rope.name: rope.ends for rope in ropes}
    bodies = tuple(heavier(body, mechanism, gone) for body in mechanism.bodies if body.name not in gone)
    joints = tuple(j for j in mechanism.joints if not {j.body0, j.body1} & gone.keys())
    blocks = tuple(rope.ends[1][0] for rope in ropes)
    sites = tuple(site for site in mechanism.sites if site.body not in gone)
    sensors = tuple(s for s in mechanism.sensors if s.body not in gone)
    floating = (*mechanism.floating, *blocks)
    return replace(mechanism, bodies=bodies, joints=joints, sites=sites, sensors=sensors, floating=floating), (*ropes,)


def _rope(mechanism: Mechanism, slide: Joint, sign: int, falls: int) -> Rope | None:
    """What a winch's slide is in, where its first body is a rope that hangs and its second hangs on that alone."""
    beside = [j for j in mechanism.joints if slide.body0 in (j.body0, j.body1) and j.name != slide.name]
    below = [j for j in mechanism.joints if j.body1 == slide.body1 and j.name != slide.name]
    if len(beside) != 1 or below or sign > 0 or slide.cut or slide.drive is None:
        return None
    ball = beside[0]
    if ball.type != "spherical" or not ball.free or ball.cut or ball.body1 != slide.body0:
        return None
    way = np.subtract(slide.anchor, ball.anchor)
    length = float(np.linalg.norm(way))
    aside = float(np.linalg.norm(way - (way @ np.asarray(slide.axis)) * np.asarray(slide.axis)))
    if length == 0.0 or aside > ASIDE * length or float(way @ np.asarray(slide.axis)) < 0.0:
        return None
    ends = (ball.body0, ball.anchor), (slide.body1, slide.anchor)
    return Rope(slide.body0, slide, falls, ends, length, _LIGHT * sum(body.mass for body in mechanism.bodies))
