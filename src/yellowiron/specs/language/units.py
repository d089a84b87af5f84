"""Units as sheets print them: each spelling's unit, dimension and system of measurement."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass
from typing import Literal

from yellowiron.support.units import SI_UNIT

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


# name understood by pint | what one is in SI | dimension | system | spellings (regular expressions, the longest wins)
# The scales are pint's own (a test compares them): loading it takes a reader's child longer than a page.
_TABLE = """
millimeter        |0.001                |length       |metric  |mm|MM|millimet(?:er|re)s?
centimeter        |0.01                 |length       |metric  |cm
meter             |1.0                  |length       |metric  |m|met(?:er|re)s?|metros?|mtr
inch|0.0254|length|imperial|in\\.?|IN\\.|inch(?:es)?|INCH(?:ES)?|pulg\\.?|pulgadas?|pouces?|Zoll|"|″|”|''|′′
foot              |0.30479999999999996  |length       |imperial|ft\\.?|FT\\.?|feet|FEET|foot|pies?|pieds?|'|′|’
kilogram          |1.0                  |mass         |metric  |kgs?|Kgs?|KG|kilograms?
metric_ton        |1000.0               |mass         |metric  |t|tonnes?|mt|metric tons?
short_ton         |907.1847400000001    |mass         |imperial|short tons?
pound             |0.4535923700000001   |mass         |imperial|lbs?\\.?|LBS?\\.?|pounds?|POUNDS?|libras?
megapascal        |1000000.0            |pressure     |metric  |M[pP]a
kilopascal        |1000.0               |pressure     |metric  |[kK][pP]a
bar               |100000.0             |pressure     |metric  |bars?
kgf/centimeter**2 |98066.5              |pressure     |metric  |[kK]gf? ?/ ?cm(?:2|²)
psi               |6894.7572931683635   |pressure     |imperial|psi|PSI|p\\.s\\.i\\.?|lbf?/in(?:2|²)
liter/minute|1.666666666666667e-5|flow|metric|(?:[lL]|ltr\\.?|lit[er]{2}s?)/m(?:in\\.?)?|l\\.?p\\.?m\\.?|LPM|[lL] ?min-1
gallon/minute|6.309019639999999e-05|flow|imperial|(?:US |U\\.S\\. )?gal(?:lons?)?\\.?/min\\.?|g\\.?p\\.?m\\.?|GPM|USgpm
meter**3          |1.0                  |volume       |metric  |m(?:3|³)|cu\\.? ?m
liter             |0.0010000000000000002|volume       |metric  |l|L|ltr|lit(?:er|re)s?|litros?
centimeter**3     |1.0000000000000002e-06|volume       |metric  |cm(?:3|³)|cc|ccm
yard**3           |0.764554857984       |volume       |imperial|yd(?:s)?(?:3|³)|cu\\.? ?yds?\\.?|yds?\\.? ?cu
foot**3           |0.028316846591999994 |volume       |imperial|ft(?:3|³)|cu\\.? ?ft\\.?
inch**3           |1.6387063999999996e-05|volume       |imperial|in(?:3|³)|cu\\.? ?in\\.?|cubic inch(?:es)?
gallon            |0.0037854117839999993|volume       |imperial|(?:US |U\\.S\\. )?gal(?:lons?)?\\.?
kilonewton        |1000.0               |force        |metric  |kN|KN|Kn
newton            |1.0                  |force        |metric  |N
kilogram_force    |9.80665              |force        |metric  |kgf
force_pound       |4.4482216152605005   |force        |imperial|lbf
newton*meter      |1.0                  |torque       |metric  |N ?[·.•*-]? ?m
kilonewton*meter  |1000.0               |torque       |metric  |kN ?[·.•*-]? ?m
foot*force_pound  |1.3558179483314001   |torque       |imperial|(?:lbf?|ft)[·.•*-](?:ft|lbf?)|lbf? ft|ft lbf?|lbf?-pies?
kilowatt          |1000.0               |power        |metric  |[kK][wW]
watt              |1.0                  |power        |metric  |W
horsepower        |745.6998715822701    |power        |imperial|hp|HP|bhp|h\\.p\\.?
metric_horsepower |735.49875            |power        |metric  |PS|CV|ch
kilometer/hour    |0.2777777777777778   |speed        |metric  |[kK][mM]/[hH]r?|kph|kmh|kmph
meter/second      |1.0                  |speed        |metric  |m/s(?:ec)?\\.?
meter/minute      |0.016666666666666666 |speed        |metric  |m/min\\.?|mpm
centimeter/second |0.01                 |speed        |metric  |cm/s(?:ec)?\\.?
millimeter/second |0.001                |speed        |metric  |mm/s(?:ec)?\\.?
foot/minute       |0.0050799999999999994|speed        |imperial|ft/min\\.?|fpm|f\\.p\\.m\\.?|ft\\./min\\.?
foot/second       |0.30479999999999996  |speed        |imperial|ft/s(?:ec)?\\.?|fps
mile/hour         |0.44704              |speed        |imperial|mph|MPH|mi/h|m\\.p\\.h\\.?
revolution/minute|0.10471975511965977|angular_speed|both|r\\.?p\\.?m\\.?|RPM|r/min|rev/min|min-1|min⁻¹|1/min|U/min|tr/min
second            |1.0                  |time         |both    |s|secs?\\.?|seconds?|segundos?|secondes?|Sekunden?
minute            |60.0                 |time         |both    |mins?\\.?(?![-⁻][1¹])|minutes?|minutos?|Minuten?
degree            |0.017453292519943295 |angle        |both    |°|º|˚|[Dd]eg\\.?|[Dd]egrees?|[Gg]rados?|[Dd]egrés?|Grad
radian            |1.0                  |angle        |both    |rad
"""
_FINE = {"meter", "metric_ton", "foot", "inch", "meter**3", "yard**3", "second", "megapascal", "kilonewton", "radian"}


@functools.cache
def printed_units() -> tuple[tuple[PrintedUnit, str], ...]:
    """Every unit with the pattern of its spellings."""
    found = []
    for line in _TABLE.strip().splitlines():
        name, scale, dimension, system, spellings = (part.strip() for part in line.split("|", 4))
        unit = PrintedUnit(name, dimension, system, float(scale), name in _FINE)  # type: ignore[arg-type]
        found.append((unit, spellings))
    return tuple(found)


@functools.cache
def unit_pattern() -> str:
    """A regular expression for any unit's spelling, not followed by a letter. A digit may be glued to it; then it is no
    exponent: "1.007 m39.6 in" is metres and inches."""
    spellings = [_any_case(s) for _, pattern in printed_units() for s in _alternatives(pattern)]
    spellings = [re.sub(r"\(\?:([23])\|", r"(?:\1(?![.,]?\\d)|", s) for s in spellings]
    return (
        "(?:"
        + "|".join(sorted(spellings, key=len, reverse=True))
        + r")(?:(?<![A-Za-z])|(?![A-Za-zµÀ-ÖØ-öø-ɏ]))(?! ?[CF]\b)"
    )


def _any_case(spelling: str) -> str:
    """A unit that is written out, in any case ("Seconds", "BAR"); of a sign the case tells which it is."""
    return f"(?i:{spelling})" if re.fullmatch(r"[a-z]{4}[a-z?]*", spelling) else spelling


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
        for unit, pattern in printed_units():
            if re.fullmatch(pattern, text, flags):
                return unit
    return None
