"""Units as sheets print them: each spelling's unit, dimension and system of measurement."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from typing import Literal

from yellowiron.support.units import SI_UNIT, to_si

System = Literal["metric", "imperial", "both"]


@dataclass(frozen=True)
class PrintedUnit:
    """A unit of a sheet. `name` is what pint understands; `scale` is the SI value of one such unit.

    `fine` units are so big that sheets print thousandths of them ("3.658 m"), so that "3.658" is no doubt a decimal;
    of the others ("86.275 kg") it may be a thousands separator.
    """

    name: str
    dimension: str
    system: System
    scale: float
    fine: bool = False

    @property
    def si(self) -> str:
        """The SI unit of the dimension."""
        return SI_UNIT[self.dimension]


# name understood by pint | dimension | system | spellings (regular expressions, longest match wins)
_TABLE = """
millimeter          | length        | metric   | mm|MM|millimet(?:er|re)s?
centimeter          | length        | metric   | cm
meter               | length        | metric   | m|met(?:er|re)s?|metros?|mtr
inch                | length        | imperial | in\\.?|inch(?:es)?|"|″|”|''|′′
foot                | length        | imperial | ft\\.?|feet|foot|'|′|’
kilogram            | mass          | metric   | kgs?|Kgs?|KG|kilograms?
metric_ton          | mass          | metric   | t|tonnes?|mt|metric tons?
short_ton           | mass          | imperial | short tons?
pound               | mass          | imperial | lbs?\\.?|pounds?
megapascal          | pressure      | metric   | MPa
kilopascal          | pressure      | metric   | kPa
bar                 | pressure      | metric   | bars?
kgf/centimeter**2   | pressure      | metric   | [kK]gf? ?/ ?cm(?:2|²)
psi                 | pressure      | imperial | psi|lbf?/in(?:2|²)
liter/minute        | flow          | metric   | (?:l|L|ltr\\.?|lit(?:er|re)s?)/min\\.?|lpm|LPM|(?:l|L) ?min-1
gallon/minute       | flow          | imperial | (?:US |U\\.S\\. )?gal(?:lons?)?\\.?/min\\.?|gpm|GPM|USgpm
meter**3            | volume        | metric   | m(?:3|³)|cu\\.? ?m
liter               | volume        | metric   | l|L|ltr|lit(?:er|re)s?|litros?
centimeter**3       | volume        | metric   | cm(?:3|³)|cc|ccm
yard**3             | volume        | imperial | yd(?:s)?(?:3|³)|cu\\.? ?yds?\\.?|yds?\\.? ?cu
foot**3             | volume        | imperial | ft(?:3|³)|cu\\.? ?ft\\.?
inch**3             | volume        | imperial | in(?:3|³)|cu\\.? ?in\\.?|cubic inch(?:es)?
gallon              | volume        | imperial | (?:US |U\\.S\\. )?gal(?:lons?)?\\.?
kilonewton          | force         | metric   | kN|KN|Kn
newton              | force         | metric   | N
kilogram_force      | force         | metric   | kgf
force_pound         | force         | imperial | lbf
newton*meter        | torque        | metric   | N ?[·.•*-]? ?m
kilonewton*meter    | torque        | metric   | kN ?[·.•*-]? ?m
foot*force_pound    | torque        | imperial | (?:lbf?|ft)[·.•*-](?:ft|lbf?)|lbf? ft|ft lbf?
kilowatt            | power         | metric   | kW
watt                | power         | metric   | W
horsepower          | power         | imperial | hp|HP|bhp
metric_horsepower   | power         | metric   | PS|CV|ch
kilometer/hour      | speed         | metric   | km/h|kph|km/hr|kmh|kmph
meter/second        | speed         | metric   | m/s(?:ec)?\\.?
meter/minute        | speed         | metric   | m/min\\.?|mpm
centimeter/second   | speed         | metric   | cm/s(?:ec)?\\.?
millimeter/second   | speed         | metric   | mm/s(?:ec)?\\.?
foot/minute         | speed         | imperial | ft/min\\.?|fpm|ft\\./min\\.?
foot/second         | speed         | imperial | ft/s(?:ec)?\\.?|fps
mile/hour           | speed         | imperial | mph|MPH|mi/h
revolution/minute   | angular_speed | both     | rpm|RPM|r/min|rev/min|min-1|min⁻¹|1/min|U/min|tr/min
second              | time          | both     | s|secs?\\.?|seconds?|segundos?|secondes?|Sekunden?
minute              | time          | both     | mins?\\.?|minutes?|minutos?|Minuten?
degree              | angle         | both     | °|º|˚|deg\\.?|degrees?|grados?|degrés?|Grad
radian              | angle         | both     | rad
"""
_FINE = {"meter", "metric_ton", "foot", "inch", "meter**3", "yard**3", "second", "megapascal", "kilonewton", "radian"}


@functools.cache
def _units() -> tuple[tuple[PrintedUnit, str], ...]:
    """Every unit with the pattern of its spellings."""
    found = []
    for line in _TABLE.strip().splitlines():
        name, dimension, system, spellings = (part.strip() for part in line.split("|", 3))
        scale = to_si(1.0, name)[0]
        unit = PrintedUnit(name, dimension, system, scale, name in _FINE)  # type: ignore[arg-type]
        found.append((unit, spellings))
    return tuple(found)


@functools.cache
def unit_pattern() -> str:
    """A regular expression for any unit's spelling, not followed by a letter. A digit may be glued to it; then it is no
    exponent: "1.007 m39.6 in" is metres and inches."""
    spellings = [s for _, pattern in _units() for s in _alternatives(pattern)]
    spellings = [re.sub(r"\(\?:([23])\|", r"(?:\1(?![.,]?\\d)|", s) for s in spellings]
    return (
        "(?:"
        + "|".join(sorted(spellings, key=len, reverse=True))
        + r")(?:(?<![A-Za-z])|(?![A-Za-zµÀ-ÖØ-öø-ɏ]))(?! ?[CF]\b)"
    )


def _alternatives(pattern: str) -> list[str]:
    """The pattern's top-level alternatives."""
    parts, depth = [""], 0
    for character in pattern:
        depth += {"(": 1, ")": -1}.get(character, 0)
        if character == "|" and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    return parts


@functools.lru_cache(maxsize=512)
def printed_unit(text: str) -> PrintedUnit | None:
    """The unit of a spelling, or None. Case counts only where it must (`m`, `MPa`; but `KG`, `Mm` are accepted)."""
    text = text.strip()
    for flags in (0, re.IGNORECASE):
        for unit, pattern in _units():
            if re.fullmatch(pattern, text, flags):
                return unit
    return None
