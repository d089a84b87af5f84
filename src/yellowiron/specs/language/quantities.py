"""Single numbers with units, in every spelling that sheets have: grouped digits, fractions, feet and inches, signs."""

from __future__ import annotations

import functools
import re
from dataclasses import dataclass, replace

from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.units import PrintedUnit, printed_unit, unit_pattern

FEET_INCHES = "ft-in"
"""Unit of a column that prints "18-5" or "18'5\\"" for feet and inches."""

_VULGAR = {"½": (1, 2), "¼": (1, 4), "¾": (3, 4), "⅛": (1, 8), "⅜": (3, 8), "⅝": (5, 8), "⅞": (7, 8)}
_FRACTION = r"(?:(?P<{0}n>\d{{1,2}})/(?P<{0}d>\d{{1,2}})(?![\d/])|(?P<{0}v>[½¼¾⅛⅜⅝⅞]))"
_NUMBER = (
    r"(?:\d{1,3}(?:,\d{3})+(?:\.\d+)?"
    r"|\d{1,3}(?:\.\d{3}){2,}(?:,\d+)?|\d{1,3}\.\d{3},\d+"
    r"|\d{1,3}(?:[\u00a0\u202f\u2009 ’]\d{3})+(?:[.,]\d+)?(?![\d.,]*\d)"
    r"|\d+[.,]\d+|\d+|[.,]\d+)"
)
_FEET = re.compile(
    r"(?P<feet>\d+)\s*(?:'|′|’|ft\.?|feet)\s*-?\s*(?:(?P<inches>\d+(?:\.\d+)?)(?![\d/]))?\s*"
    + _FRACTION.format("i")
    + r"?\s*(?:\"|″|”|''|′′|in\.?(?![a-z])|inch(?:es)?)",
)
FEET_DASH = re.compile(
    r"(?P<feet>\d+)\s*[-–]\s*(?P<inches>\d+(?:\.\d+)?)(?:\s+" + _FRACTION.format("i") + r")?(?![\d-])"
)
"""Feet and inches with a dash between them, as a column headed by both prints them."""
_FEET_POINT = re.compile(r"(?P<feet>\d+)\.(?P<inches>[01]?\d)\s*(?:ft\.?\s*[-/&]?\s*in\b\.?|feet\s*/\s*inch(?:es)?)")
"""Feet and inches with a point between them under both units, as data bases of machines print them: "31.3 ft in"."""
_MIXED = re.compile(r"(?P<whole>\d+)?\s*[- ]?\s*" + _FRACTION.format("i"))
_PLUS_MINUS = re.compile(r"(?:±|\+\s?/\s?[-–−]|\+-)\s*$")
_MINUS = re.compile(r"(?:^|[\s(])[-−–]$")


@dataclass(frozen=True)
class Quantity:
    """One printed number with its unit. `value` as printed, `half` half a unit of its last printed digit (same unit).

    `other` is the second reading of an ambiguous separator ("86.275 kg": 86275). `sign`: "±", "-" or "".
    `start`, `end`: where in the text it stands.
    """

    value: float
    unit: str
    half: float
    text: str
    start: int = 0
    end: int = 0
    sign: str = ""
    other: float | None = None

    @property
    def unit_printed(self) -> bool:
        """Whether the unit stands beside the number, not over its column."""
        return bool(self.unit) and self.text.endswith(self.unit)

    @property
    def printed(self) -> PrintedUnit | None:
        """The unit's entry; None for a bare number."""
        return printed_unit(self.unit) if self.unit else None

    @property
    def dimension(self) -> str:
        """Dimension of the unit; `count` for a bare number."""
        unit = self.printed
        return unit.dimension if unit else "count"

    @property
    def si_value(self) -> float:
        """The value in the SI unit of its dimension."""
        unit = self.printed
        return float(f"{self.value * unit.scale:.15g}") if unit else self.value

    @property
    def si_half(self) -> float:
        """Half a unit of the last printed digit, in SI."""
        unit = self.printed
        return self.half * unit.scale if unit else self.half

    @property
    def si_digit(self) -> float:
        """Half a unit of the last printed digit in SI, trailing zeros counted as digits."""
        return self.si_half if self.value % 1 else self.si_half * min(1.0, 0.5 / self.half if self.half else 1.0)

    @property
    def si_unit(self) -> str:
        """The SI unit of its dimension; "1" for a bare number."""
        unit = self.printed
        return unit.si if unit else "1"


def same(a: Quantity, b: Quantity) -> bool:
    """Whether two quantities are one value as far as their printed digits tell: within half a unit of the last digit
    of each, or one of them cut off instead of rounded."""
    if a.dimension != b.dimension:
        return False
    difference = a.si_value - b.si_value
    slack = 1e-9 * abs(a.si_value)
    rounded = abs(difference) <= 1.05 * (a.si_half + b.si_half) + slack
    cut = -slack <= difference < 2 * b.si_half + slack or -slack <= -difference < 2 * a.si_half + slack
    return rounded or cut


@functools.cache
def _number_with_unit() -> re.Pattern[str]:
    return re.compile(rf"(?P<number>{_NUMBER})(?P<gap>[\s\u00a0]?-?[\s\u00a0]?)(?P<unit>{unit_pattern()})?")


_BEGINS = re.compile(r"[\d½¼¾⅛⅜⅝⅞]|[.,](?=\d)")


def quantities_in(text: str, unit: str, style: DecimalStyle) -> list[Quantity]:
    """The numbers of a text in order; `unit` is that of numbers printed without one."""
    found: list[Quantity] = []
    position = 0
    while position < len(text):
        start = _BEGINS.search(text, position)
        if start is None:
            break
        at = start.start()
        if text[at] in ".," and at > 0 and text[at - 1].isalnum():
            position = at + 1  # "3.3m,4.3m"
            continue
        if at > 0 and _inside_a_word(text, at):
            position = _end_of_word(text, at)
            continue
        if standard := _of_a_standard(text, at):
            position = standard
            continue
        quantity = _feet(text, at, unit) or _fraction(text, at, unit) or _plain(text, at, unit, style)
        if quantity is None:
            position = _end_of_word(text, at)
            continue
        quantity = _signed(text, quantity, found)
        position = quantity.end
        if quantity.sign == "±" and found and _is_tolerance(text, found[-1], quantity):
            first = found[-1]
            whole = text[first.start : quantity.end]
            found[-1] = replace(first, unit=first.unit or quantity.unit, text=whole, end=quantity.end)
        else:
            found.append(quantity)
    return found


def _is_tolerance(text: str, before: Quantity, quantity: Quantity) -> bool:
    """Whether a number with ± right behind another is how far that one may be off: "2,820 ± 50 mm"."""
    return not text[before.end : quantity.start].strip("( ") and quantity.value < before.value


_LONGEST_WORD = 30
_CROSSES = re.compile(r"(?:[xX][\d.,]+)*[xX]")
"""What stands before a factor that is glued to those before it: "2505x1200x2250"."""


@functools.cache
def _ends_in_unit() -> re.Pattern[str]:
    return re.compile(rf"\d\s?{unit_pattern()}$")


def _inside_a_word(text: str, at: int) -> bool:
    """A digit glued to letters before it is part of a name ("L5", "ISO14396"), unless those are a unit ("km/h4.0") or
    a cross ("x441")."""
    number = _number_with_unit().match(text, at)
    measured = number is not None and bool(number["unit"])
    text = text[max(0, at - _LONGEST_WORD) : at]
    before = re.search(r"[A-Za-z][A-Za-z0-9./-]*$", text)
    if before is None:
        return False
    word = before.group(0)
    if (
        _CROSSES.fullmatch(word)
        or _ends_in_unit().search(text)
        or (measured and _ends_in_unit().search(text.rstrip("/")))
    ):
        return False  # "950kg/1110kg"
    if measured and re.search(r"[A-Za-z]{4,}/$", word):
        return False  # "continuous/1.5 rpm"
    return word[-1].isalnum() or word[-1] in "-/"


_STANDARD = re.compile(
    r"(?:\b(?:ISO|DIN|EN|JIS|CECE|UNE|NF|BS|GB(?:/T)?|EU|ECE|IEC)\b[\s/-]*)+(?:[A-Z]\s?)?$", re.IGNORECASE
)
_STANDARD_NUMBER = re.compile(r"\d{3,5}(?:-\d{1,2})?(?::(?:19|20)\d\d)?(?![\d.,])")


def _of_a_standard(text: str, at: int) -> int:
    """Where a standard's number that begins at `at` ends ("ISO 14397-1"); 0 if it is none, or has a unit."""
    number = _STANDARD_NUMBER.match(text, at)
    if number is None or not _STANDARD.search(text[max(0, at - _LONGEST_WORD) : at]):
        return 0
    measured = _number_with_unit().match(text, at)
    return 0 if measured is not None and measured["unit"] else number.end()


def _end_of_word(text: str, at: int) -> int:
    match = re.compile(r"[A-Za-z0-9.,]+[A-Za-z0-9-]*").match(text, at)
    return max(match.end() if match else at + 1, at + 1)


def _feet(text: str, at: int, unit: str) -> Quantity | None:
    pointed = _FEET_POINT.match(text, at)
    if pointed and int(pointed["inches"]) < 12:
        value = 12.0 * int(pointed["feet"]) + int(pointed["inches"])
        return Quantity(value, "in", 0.5, pointed.group(0), at, pointed.end())
    match = _FEET.match(text, at)
    if match is None and unit == FEET_INCHES:
        match = FEET_DASH.match(text, at)
    if match is None or (match["inches"] is None and _ratio(match) is None):
        return None
    inches = float(match["inches"] or 0)
    ratio = _ratio(match)
    half = 0.5 / ratio[1] if ratio else 0.5 * 10.0 ** -_decimals(match["inches"])
    inches += ratio[0] / ratio[1] if ratio else 0.0
    value = int(match["feet"]) * 12 + inches
    return Quantity(value, "in", half, match.group(0).strip(), at, match.end())


def _fraction(text: str, at: int, unit: str) -> Quantity | None:
    match = _MIXED.match(text, at)
    if match is None:
        return None
    ratio = _ratio(match)
    tail = re.compile(rf"\s?({unit_pattern()})").match(text, match.end())
    spelled = tail.group(1) if tail else unit
    printed = printed_unit(spelled) if spelled else None
    if ratio is None or ratio[1] == 0 or printed is None or printed.system != "imperial":
        return None
    value = float(match["whole"] or 0) + ratio[0] / ratio[1]
    end = tail.end() if tail else match.end()
    return Quantity(value, spelled, 0.5 / ratio[1], text[at:end].strip(), at, end)


def _ratio(match: re.Match[str]) -> tuple[int, int] | None:
    if match["iv"]:
        return _VULGAR[match["iv"]]
    return (int(match["in"]), int(match["id"])) if match["in"] else None


def _plain(text: str, at: int, unit: str, style: DecimalStyle) -> Quantity | None:
    match = _number_with_unit().match(text, at)
    if match is None:
        return None
    end = match.end() if match["unit"] else match.end("number")
    if not match["unit"] and re.match(r"[A-Za-z]", text[end : end + 1]) and not re.match(r"(?i)x\s?\d", text[end:]):
        return None  # "1st", "26.5R25", "4WD"
    spelled = match["unit"] or ("" if unit == FEET_INCHES else unit)
    digits = match["number"]
    value, decimals, other = _value(digits, spelled, style)
    quantity = Quantity(value, spelled, _half(digits, value, decimals), text[at:end].strip(), at, end, other=other)
    if quantity.unit and quantity.printed is None:
        return replace(quantity, unit="")
    return quantity


def _value(digits: str, unit: str, style: DecimalStyle) -> tuple[float, int, float | None]:
    """The number, its printed decimals, and its other reading where the separator leaves a doubt."""
    digits = re.sub(r"[\u00a0\u202f\u2009 ’]", "", digits)
    if "," in digits and "." in digits:
        decimal = max(digits.rfind(","), digits.rfind("."))
        whole, part = re.sub("[.,]", "", digits[:decimal]), digits[decimal + 1 :]
        return float(f"{whole}.{part}"), len(part), None
    mark = "," if "," in digits else "." if "." in digits else ""
    if not mark:
        return float(digits), 0, None
    whole, _, part = digits.partition(mark)
    grouped = float(digits.replace(mark, ""))
    if mark in part:
        return grouped, 0, None
    as_decimal = float(f"{whole or 0}.{part}")
    if len(part) != 3 or whole in ("", "0") or len(whole) > 3:
        return as_decimal, len(part), None
    printed = printed_unit(unit) if unit else None
    fine = printed is not None and printed.fine
    if mark == "," and style != "comma":
        return grouped, 0, as_decimal if fine and style == "unknown" else None
    if mark == ",":
        return (as_decimal, 3, None) if fine else (as_decimal, 3, grouped)
    if style == "comma":
        return grouped, 0, None
    return (as_decimal, 3, None) if fine else (as_decimal, 3, grouped)


def _half(digits: str, value: float, decimals: int) -> float:
    """Half a unit of the last printed digit; trailing zeros of a large whole number may be rounding."""
    if decimals or value < 1000 or not float(value).is_integer():
        return 0.5 * 10.0**-decimals
    bare = str(int(value))
    zeros = len(bare) - len(bare.rstrip("0"))
    return max(0.5, min(0.5 * 10.0 ** min(zeros, 2), 0.005 * value))


def _decimals(text: str | None) -> int:
    return len(text.partition(".")[2]) if text else 0


def _signed(text: str, quantity: Quantity, earlier: list[Quantity]) -> Quantity:
    """The quantity with the sign before it; a dash between two numbers is none."""
    floor = earlier[-1].end if earlier else 0
    before = text[floor : quantity.start]
    both = _PLUS_MINUS.search(before)
    if both:
        start = floor + both.start()
        return replace(quantity, sign="±", start=start, text=text[start : quantity.end].strip())
    if _MINUS.search(before) and (not earlier or before.strip(" -−–")):
        value, start = -quantity.value, quantity.start - 1
        return replace(quantity, sign="-", value=value, start=start, text=f"-{quantity.text}", other=None)
    return quantity
