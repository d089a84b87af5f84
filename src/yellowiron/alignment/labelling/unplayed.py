"""What may be a body that was not found though it was given to another: by its name, or as wheels look."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.alignment.assignment.weights import AS_GOOD
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.features.wheels import FLAT, TREAD, Wheel
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.model.template import Template

SPEAKS = 0.4
"""Names that speak this well of missing bodies, and less of the part's own, leave it in doubt."""
SQUARE = 0.1
"""What is as high as it is long, to this share, may be a wheel that is not drawn round, …"""
LEAST = 0.75
"""… if it is at least so many times as large as another one, …"""
THIN = 0.3
"""… unless it is of less than this share of another's width."""
MARGIN = 0.05
"""What reaches out of an outline by no more than this share of its size is within it."""
TURNS = 12
"""In so many directions an outline is looked at."""


def maybe_unplayed(
    places: Mapping[int, Place],
    solids: Sequence[Solid],
    scores: Sequence[Mapping[str, float]],
    wheels: Sequence[Wheel],
    template: Template,
    played: Collection[str],
) -> dict[int, Place]:
    """The places, solid → place, those doubtful of what may be a body of which nothing is `played`. `scores`: by solid,
    what its names say, as far as they are to be believed; `wheels`: those that were found."""
    missing = {r.name for r in template.roles if r.rigid and not r.many} - set(played)
    rolling = {r.name for r in template.roles if r.kind == "wheel" and not r.drum}
    found = dict(places)
    outlines = [
        solids[i]
        for i, place in places.items()
        if missing & rolling and place.body not in rolling and any(_like(solids[i], wheel) for wheel in wheels)
    ]
    for i, place in places.items() if missing else ():
        said = scores[i]
        best = max(said.values(), default=0.0)
        meant = {b for b, score in said.items() if score > best - AS_GOOD}
        if best >= SPEAKS and place.body in meant:
            continue
        if best >= SPEAKS and meant & missing:
            words = f"by its name it may be {min(meant & missing)}, which is not found"
        elif place.body not in rolling and any(_inside(solids[i], outline) for outline in outlines):
            words = f"it may be {min(missing & rolling)}, which is not found"
        else:
            continue
        sure = min(place.confidence, DOUBTFUL)
        found[i] = replace(place, confidence=sure, reason=f"{place.reason}; but {words}")
    return found


def otherwise(places: Mapping[int, Place], solids: Sequence[Solid], told: Mapping[str, str]) -> dict[int, Place]:
    """The places, solid → place, those doubtful of which another reading says another body; `told`: part id → that."""
    found = dict(places)
    for i, place in places.items():
        other = told.get(solids[i].part.id, place.body)
        if other != place.body:
            words = f"{place.reason}; but names, place and shape together say {other}"
            found[i] = replace(place, confidence=min(place.confidence, DOUBTFUL), reason=words, runner_up=other)
    return found


def _inside(solid: Solid, outline: Solid) -> bool:
    """Whether a solid is the outline of a wheel, or wholly within it: rims, hubs, bolts."""
    margin = MARGIN * (outline.high - outline.low)
    return bool((solid.low >= outline.low - margin).all() and (solid.high <= outline.high + margin).all())


def _like(solid: Solid, wheel: Wheel) -> bool:
    """Whether a solid has about the outline of a wheel that has its axis along that one's."""
    across = np.linalg.svd(wheel.direction[None, :])[2][1:]
    turns = np.linspace(0.0, 0.5 * np.pi, TURNS, endpoint=False)
    ways = np.array([[[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]] for t in turns]) @ across
    flat = solid.points @ ways.reshape(-1, 3).T
    sides = np.ptp(flat, axis=0).reshape(-1, 2)
    # As it lies: the outline is the least there.
    high, long = sides[int(np.argmin(np.round(sides.max(axis=1), 9)))]
    radius, width = 0.5 * float(max(high, long)), float(np.ptp(solid.points @ wheel.direction))
    square = abs(high - long) <= SQUARE * max(high, long)
    as_large = LEAST * wheel.radius < radius < TREAD * wheel.radius
    return bool(square and as_large and THIN * wheel.width < width < FLAT * radius)
