"""Quantities with units: text to SI and back. pint does the arithmetic."""

from __future__ import annotations

import functools
import re
from typing import TYPE_CHECKING, Any

from yellowiron.model.errors import YellowironError

if TYPE_CHECKING:
    import pint

SI_UNIT = {
    "length": "m",
    "angle": "rad",
    "mass": "kg",
    "pressure": "Pa",
    "flow": "m^3/s",
    "volume": "m^3",
    "force": "N",
    "torque": "N*m",
    "power": "W",
    "speed": "m/s",
    "angular_speed": "rad/s",
    "time": "s",
    "count": "1",
}
"""Dimension (the word a template uses) → the SI unit its values are kept in."""

LARGEST = {
    "length": 1e4,
    "angle": 1e4,
    "mass": 1e8,
    "pressure": 1e10,
    "flow": 1e3,
    "volume": 1e6,
    "force": 1e10,
    "torque": 1e11,
    "power": 1e10,
    "speed": 1e4,
    "angular_speed": 1e5,
    "time": 1e7,
    "count": 1e6,
}
"""Dimension → the size, in SI, beyond which no value of a machine is: far beyond the largest ever built."""

_NUMBER = re.compile(r"^\s*([-+−]?[0-9]+(?:\.[0-9]*)?(?:[eE][-+]?[0-9]+)?|[-+−]?\.[0-9]+)\s*(.*?)\s*$")
_SPELLING = {
    "°": "degree",
    "deg": "degree",
    "l/min": "liter/minute",
    "L/min": "liter/minute",
    "rpm": "revolution/minute",
}


@functools.cache
def registry() -> pint.UnitRegistry[Any]:
    """The process's pint registry (imported on first use: it takes a third of a second)."""
    import pint

    return pint.UnitRegistry()


@functools.lru_cache(maxsize=1024)
def _dimension(spelled: str) -> str | None:
    """The SI unit of a unit's dimension, if it is one of a specification: asked of pint once a spelling."""
    quantity = registry().Quantity(1.0, spelled)
    angular = spelled in ("degree", "radian", "rad")
    for si in SI_UNIT.values():
        target = registry().Unit(si) if si != "1" else registry().dimensionless
        if quantity.is_compatible_with(target) and ((si == "rad") == angular or si not in ("rad", "1")):
            return si
    return None


def to_si(value: float, unit: str, *, where: str = "") -> tuple[float, str]:
    """A number with a unit in SI: (value, SI unit of its dimension). `YellowironError` for an unknown unit."""
    spelled = _SPELLING.get(unit, unit)
    try:
        si = _dimension(spelled)
        if si is not None:
            target = registry().Unit(si) if si != "1" else registry().dimensionless
            return float(registry().Quantity(value, spelled).to(target).magnitude), si
    except Exception as error:  # pint raises half a dozen unrelated classes for bad text
        raise YellowironError(
            f"'{unit}' is not a unit", where=where, hint="Write e.g. 764 mm, 31.5 MPa, 40 deg."
        ) from error
    raise YellowironError(
        f"'{unit}' is no unit of a specification", where=where, hint=f"Known: {', '.join(SI_UNIT.values())}."
    )


def parse_quantity(text: str, *, where: str = "") -> tuple[float, str]:
    """'764 mm' → (0.764, 'm'); a bare number has unit ''. `YellowironError` if there is no number."""
    match = _NUMBER.match(text)
    if match is None:
        raise YellowironError(f"'{text}' is not a number with a unit", where=where, hint="Write e.g. 764 mm.")
    value = float(match.group(1).replace("−", "-"))
    unit = match.group(2)
    return to_si(value, unit, where=where) if unit else (value, "")
