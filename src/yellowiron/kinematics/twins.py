"""Passive twins: cylinders that follow a driven one must stay within their own strokes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, MutableMapping
from dataclasses import replace
from typing import Any

from yellowiron.kinematics.solver.chain import ClosedChain, Component
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Cylinder, Joint, Mechanism

EVEN = 1e-3
"""Metres by which a passive twin may go past its own stroke."""
_SHORTER = 0.1
"""A stroke that would end earlier than by this share for its twin's sake is one of wrong data, and stays."""
_FINE = 1e-7
"""Of the stroke: how exactly its new end is found."""
_MOST = 3
"""Other drivers whose ends are tried together."""


def twins_out_of_stroke(mechanism: Mechanism, joints: Mapping[str, Joint], margin: float) -> Iterator[Finding]:
    """KIN004: a passive twin leaves its own stroke while the driven one uses all of its own. `joints` have their limits
    from the loops, with a `margin` (metres) to spare."""
    for cylinder in mechanism.cylinders:
        slide = joints.get(cylinder.slide)
        if not cylinder.passive or slide is None or slide.lower is None or slide.upper is None:
            continue
        past = max(-cylinder.extension - (slide.lower + margin), slide.upper - margin - _longest(cylinder))
        if past > EVEN:
            yield Finding(
                "KIN004",
                "warning",
                cylinder.slide,
                f"the twin cylinder would have to go {1e3 * past:.1f} mm past its own stroke",
                "Check stroke, closed length and the pins of both cylinders.",
            )


def end_with_twins(
    chain: ClosedChain,
    component: Component,
    ranges: dict[str, tuple[float, float]],
    joints: MutableMapping[str, Joint],
) -> Iterator[Finding]:
    """Draws in the `ranges` of driven slides whose antagonistic twin comes to the end of its own stroke first, wherever
    the other drivers are, and the limits of their `joints`; KIN016 says so. Two cylinders that turn one thing from both
    sides, such as a blade, go equally far only about the middle."""
    for driven, twin in _antagonists(chain.mechanism):
        if driven not in ranges or twin.slide not in component.dependent:
            continue
        low, high = ranges[driven]
        others = [name for name in ranges if name != driven][:_MOST]
        corners = [dict(zip(others, ends, strict=True)) for ends in itertools.product(*(ranges[n] for n in others))]
        for end, name in ((low, "lower"), (high, "upper")):
            stop = _inside(chain, driven, twin, end, corners)
            early = abs(end - stop)
            if early == 0.0 or early > _SHORTER * (high - low):
                continue
            ranges[driven] = (stop, high) if name == "lower" else (low, stop)
            low, high = ranges[driven]
            source = {**joints[driven].source, f"{name}_reason": f"where {twin.slide} is at the end of its own stroke"}
            changed: dict[str, Any] = {name: stop, "source": source}
            joints[driven] = replace(joints[driven], **changed)
            words = (
                f"its stroke ends {1e3 * early:.1f} mm early, where the cylinder on the other side is at its own end"
            )
            yield Finding("KIN016", "info", driven, words)


def _antagonists(mechanism: Mechanism) -> Iterator[tuple[str, Cylinder]]:
    """Driven slides, each with a passive cylinder of its actuator that goes the other way."""
    by_slide = {c.slide: c for c in mechanism.cylinders}
    for actuator in mechanism.actuators:
        if actuator.kind != "cylinder":
            continue
        first, *rest = actuator.joints
        for entry in rest:
            twin = by_slide.get(entry.joint)
            if twin is not None and twin.passive and entry.sign != first.sign:
                yield first.joint, twin


def _inside(chain: ClosedChain, driven: str, twin: Cylinder, end: float, corners: list[dict[str, float]]) -> float:
    """The farthest on the way to the `end` of a driven slide at which its twin is within its own stroke, wherever the
    others are; the end itself where it is there, or where the linkage does not get there."""

    def past(value: float) -> float:
        worst = -math.inf
        for corner in corners:
            state, fraction = chain.reach(corner)
            state, share = chain.reach({driven: value}, start=state)
            if min(fraction, share) < 1.0:
                return -math.inf
            at = chain.coordinate(state, twin.slide)
            worst = max(worst, -twin.extension - at, at - _longest(twin))
        return worst

    if past(end) <= EVEN or past(0.0) > 0.0:
        return end
    inside, outside = 0.0, end
    while abs(outside - inside) > _FINE * abs(end):
        middle = 0.5 * (inside + outside)
        inside, outside = (middle, outside) if past(middle) <= 0.0 else (inside, middle)
    return inside


def _longest(cylinder: Cylinder) -> float:
    """A slide's coordinate with the cylinder fully out."""
    return cylinder.stroke - cylinder.extension
