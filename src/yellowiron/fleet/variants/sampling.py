"""Draws: a table of numbers by seed, sample and parameter, that no other parameter and no larger count changes."""

from __future__ import annotations

import math
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from typing import Any

import numpy as np
from scipy.special import ndtr, ndtri

from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.variants.parameters import DIRECTION, Parameter, Spread, Target
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism


@dataclass(frozen=True)
class Draw:
    """One column of the table: a parameter, the names of what it changes in a machine, and the column's name."""

    parameter: Parameter
    names: tuple[str, ...]
    column: str


def draws_of(parameters: Sequence[Parameter], mechanism: Mechanism) -> tuple[Draw, ...]:
    """The columns that parameters make of a machine. `UnusableError` where one fits nothing of it."""
    found = []
    for parameter in parameters:
        known = names_of(parameter.quantity.target, mechanism)
        names = tuple(name for name in known if any(fnmatchcase(name, pattern) for pattern in parameter.of))
        if not names:
            raise UnusableError(
                f"No name of the machine's {parameter.quantity.target} fits", where=f"{parameter.where}.of",
                hint=f"There are: {', '.join(known) or 'none'}.",
            )  # fmt: skip
        if parameter.each:
            found += [Draw(parameter, (name,), f"{parameter.name}.{name}") for name in names]
        else:
            found.append(Draw(parameter, names, parameter.name))
        if parameter.vary == "pin_play":
            way = replace(parameter, vary=DIRECTION, spread=Spread("uniform", (0.0, 2.0 * math.pi)))
            found += [Draw(way, (name,), f"{parameter.name}.{name}.direction") for name in names]
    return tuple(found)


def names_of(target: Target, mechanism: Mechanism) -> tuple[str, ...]:
    """The names of what there is of a kind in a machine."""
    if target == "machine":
        return (mechanism.name,)
    if target == "materials":
        return tuple(mechanism.materials)
    if target == "wheels":
        driven = {j.body1 for j in mechanism.joints if not j.cut and j.type == "revolute" and j.lower is None}
        looped = {name for loop in mechanism.loops for name in loop.joints}
        slewing = {j.body0 for j in mechanism.joints if not j.cut}
        free = {j.body1 for j in mechanism.joints if j.name not in looped}
        return tuple(body.name for body in mechanism.bodies if body.name in (driven & free) - slewing)
    if target == "pins":
        looped = {name for loop in mechanism.loops for name in loop.joints}
        return tuple(j.name for j in mechanism.joints if j.type == "revolute" and j.name in looped)
    if target == "sensors":
        return tuple(sensor.name for sensor in mechanism.sensors)
    values: Mapping[str, Sequence[Any]] = {
        "bodies": mechanism.bodies,
        "actuators": mechanism.actuators,
        "cylinders": mechanism.cylinders,
        "joints": mechanism.joints,
    }
    return tuple(value.name for value in values[target])


def drawn(draws: Sequence[Draw], *, seed: int, count: int) -> list[Floats]:
    """The values (count,) of each column, in SI; of a choice of words their numbers. A column depends on the seed and
    its own name alone, a sample's value not on how many there are."""
    return [_spread(draw.parameter.spread, _uniform(draw.column, seed, count)) for draw in draws]


def _uniform(column: str, seed: int, count: int) -> Floats:
    """Numbers (count,) between 0 and 1, neither of them reached."""
    sequence = np.random.SeedSequence(seed, spawn_key=(zlib.crc32(column.encode()),))
    bits = np.random.Generator(np.random.PCG64(sequence)).integers(0, 2**52, size=count, dtype=np.uint64)
    return np.asarray((bits.astype(np.float64) + 0.5) * 2.0**-52)


def _spread(spread: Spread, uniform: Floats) -> Floats:
    if spread.kind == "choice":
        number = len(spread.words) or len(spread.numbers)
        chosen = np.minimum((uniform * number).astype(np.int64), number - 1)
        return np.asarray(chosen, dtype=np.float64) if spread.words else np.asarray(spread.numbers)[chosen]
    first, second = spread.numbers
    if spread.kind == "uniform":
        return np.asarray(first + (second - first) * uniform)
    if spread.kind == "loguniform":
        return np.asarray(first * (second / first) ** uniform)
    low, high = (float(ndtr((bound - first) / second)) for bound in (spread.low, spread.high))
    return np.asarray(first + second * ndtri(low + (high - low) * uniform), dtype=np.float64)
