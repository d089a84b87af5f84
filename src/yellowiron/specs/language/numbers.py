"""Numbers with units, as sheets print them.

A *quantity* is one number with its unit; a *reading* is what a cell says at one place: a quantity, a product of several
("95 x 441 mm", "2 - 150 x 764 mm") or a range, with the same thing in the other system of measurement where the sheet
prints it, and the words that qualify it ("35° each direction (40° to the end stop)" is two readings).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal

from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.quantities import Quantity, quantities_in, same
from yellowiron.support.units import parse_quantity

_TIMES = re.compile(r"\s*[x×✕*]\s*[Øø⌀]?\s*", re.IGNORECASE)
_DASH = re.compile(r"(?:\s*(?:[-–—~～〜∼]|\.\.\.|…)|\s*(?:to|bis)\b\s*\+?|\s+(?:à|a))\s*[Øø⌀]?\s*")
_CONDITION = re.compile(r"(?:\bat|@|\bbei|\bà|\bfor|\bfür|\bpour|\bwith|\bper)\s*$", re.IGNORECASE)
_AT_RADIUS = re.compile(r"(?:^|\s)(?:at|@|bei|auf|à|a|em)\s*$", re.IGNORECASE)
"""What stands between a load and the radius at which it is lifted, also where it means "to" between other numbers."""
_OF_NEXT = re.compile(
    r"(?:(?:^|[\s,;/|~–-])(?:to|bis|à|a)\s+|[\s,;/|~–-]*)((?:\b(?:min|max|mid|low|high)\w*\.?|[^\W\d][^\d,;:()|/]*[:：]|[^\W\d]\w*[:：])\s*)$",
    re.IGNORECASE,
)
"""What stands before a number and says which it is, though no separator parts it from the number before: "Min. 3 m to
Max. 7 m", "Retracted: 2 m Extended: 5 m", "JS145W: 12.6 rpm JS160W: 8.9 rpm"."""
_NAMED = re.compile(r"[:：]\s*$")
_JUNK = re.compile(r"[\s:=~≈<>≤≥Øø⌀•●.·]+")


@dataclass(frozen=True)
class Reading:
    """What a cell says at one place. `numbers`: one, the factors of a product, or the ends of a range; `count` stands
    before a product ("2 - 150 x 764 mm"). `partner`: the same in the other system. `condition`: a circumstance ("at
    2000 rpm"), no value."""

    numbers: tuple[Quantity, ...]
    kind: Literal["single", "product", "range"] = "single"
    count: int | None = None
    partner: tuple[Quantity, ...] = ()
    qualifier: str = ""
    condition: bool = False

    @property
    def agrees(self) -> bool | None:
        """Whether both systems of measurement say the same within their printed digits; None without a partner."""
        if not self.partner:
            return None
        return len(self.partner) == len(self.numbers) and all(
            same(a, b) for a, b in zip(self.numbers, self.partner, strict=True)
        )


def parse_one(text: str, *, where: str = "") -> Quantity:
    """The single quantity that a text is, in any printed spelling; `YellowironError` if it is not one."""
    readings = read(text, style="point")
    if len(readings) == 1 and len(readings[0].numbers) == 1:
        quantity = readings[0].numbers[0]
        rest = (text[: quantity.start] + text[quantity.end :]).strip()
        if not rest and quantity.sign != "±":
            return quantity
    value, unit = parse_quantity(text, where=where)
    return Quantity(value, unit, 0.0, text)


def read(text: str, *, unit: str = "", style: DecimalStyle = "unknown") -> tuple[Reading, ...]:
    """The readings of a cell's text. `unit` is that of its column or label, for numbers printed without one."""
    quantities = _with_following_unit(text, quantities_in(text, unit, style))
    readings: list[tuple[Reading, int, int]] = []
    index = 0
    while index < len(quantities):
        reading, used = _reading(text, quantities, index)
        last = quantities[index + used - 1]
        readings.append((reading, quantities[index].start, last.end))
        index += used
    return _qualified(text, _paired(text, readings))


_NAMED_NEXT = re.compile(r"\s*(?:[-–—~～/|,]|to|bis|à|a)\s*(?:min|max|low|high)\w*\.?\s*:?\s*", re.IGNORECASE)


_LISTED, _AXLES = 5.0, 15.0
"""How many times one number of a list may be another, and the first of two masses the second ("6000/700 kg" on a laden
truck's axles); a power and its speed, "120/2000 rpm", are farther apart."""


def _with_following_unit(text: str, quantities: list[Quantity]) -> list[Quantity]:
    """ "Low 2.5 - High 5.0 km/h", "4.5/2.9 km/h": a number without a unit has that of the next, which a word or a slash
    tells from it."""
    found = list(quantities)
    for index in range(len(found) - 2, -1, -1):
        one, following = found[index], found[index + 1]
        if one.unit or not following.unit:
            continue
        between = text[one.end : following.start]
        alike = max(one.value, following.value) <= _LISTED * min(one.value, following.value)
        axles = following.dimension == "mass" and following.value < one.value <= _AXLES * following.value
        if _NAMED_NEXT.fullmatch(between) or ((alike or axles) and between.strip() == "/"):
            found[index] = replace(one, unit=following.unit)
    return found


def _reading(text: str, quantities: list[Quantity], index: int) -> tuple[Reading, int]:
    """The product, range or single number that starts at `index`, and how many quantities it uses."""
    run = [quantities[index]]
    for following in quantities[index + 1 :]:
        if not _TIMES.fullmatch(text[run[-1].end : following.start]):
            break
        run.append(following)
    used = len(run)
    if used > 1:
        count = None
        if _is_count(run[0]) and (used > 2 or run[1].value >= 20 * run[0].value):
            count, run = int(run[0].value), run[1:]
        return Reading(_shared_unit(run), "product" if len(run) > 1 else "single", count), used
    first = run[0]
    second = quantities[index + 1] if index + 1 < len(quantities) else None
    if second is None or not _DASH.fullmatch(text[first.end : second.start]):
        return Reading((first,)), 1
    rest, used = _reading(text, quantities, index + 1)
    if rest.kind == "product" and rest.count is None and _is_count(first):
        return replace(rest, count=int(first.value)), used + 1
    if rest.kind == "single" and rest.count is None:
        low, high = _shared_unit([first, *rest.numbers])
        if low.dimension == high.dimension and low.value < high.value:
            return Reading((low, high), "range"), used + 1
    return Reading((first,)), 1


def _is_count(quantity: Quantity) -> bool:
    """Whether a number may be how many there are of something: whole, small, without a unit."""
    return not quantity.unit_printed and quantity.value in range(1, 13) and quantity.half == 0.5


def _shared_unit(run: list[Quantity]) -> tuple[Quantity, ...]:
    """ "95 x 441 mm": a factor without a unit has the next one's."""
    shared: list[Quantity] = []
    for quantity in reversed(run):
        if not quantity.unit and shared:
            quantity = replace(quantity, unit=shared[0].unit)
        shared.insert(0, quantity)
    return tuple(shared)


def _paired(text: str, readings: list[tuple[Reading, int, int]]) -> list[tuple[Reading, int, int]]:
    """Neighbours that are one value in two systems of measurement become one reading with its partner."""
    paired: list[tuple[Reading, int, int]] = []
    for reading, start, end in _listed_twice(text, readings):
        if paired:
            before, first, last = paired[-1]
            if not before.partner and _is_other_system(before, reading) and _only_brackets(text[last:start]):
                paired[-1] = (replace(before, partner=reading.numbers), first, end)
                continue
        paired.append((reading, start, end))
    return _product_of_pairs(text, paired)


def _listed_twice(text: str, readings: list[tuple[Reading, int, int]]) -> list[tuple[Reading, int, int]]:
    """ "23 km/h / 25 km/h (14.3 mph / 15.5 mph)": a list in one system, and the same again in the other one."""
    half = len(readings) // 2
    if half < 2 or len(readings) % 2:
        return readings
    pairs = list(zip(readings[:half], readings[half:], strict=True))
    alike = all(_is_other_system(a, b) and all(map(same, a.numbers, b.numbers)) for (a, _, _), (b, _, _) in pairs)
    if not alike or not all(_only_brackets(text[a[2] : b[1]]) for a, b in pairwise(readings)):
        return readings
    return [
        (replace(a, partner=b.numbers), start, end if index < half - 1 else last)
        for index, ((a, start, end), (b, _, last)) in enumerate(pairs)
    ]


def _product_of_pairs(text: str, readings: list[tuple[Reading, int, int]]) -> list[tuple[Reading, int, int]]:
    """ "150 mm (5.9 in) x 764 mm (30.1 in)" is one product in two systems."""
    joined: list[tuple[Reading, int, int]] = []
    for reading, start, end in readings:
        if joined:
            before, first, last = joined[-1]
            between = text[last:start]
            if before.partner and reading.partner and re.fullmatch(r"[\s)\]]*[x×✕*]\s*", between, re.IGNORECASE):
                merged = Reading(
                    before.numbers + reading.numbers, "product", before.count, before.partner + reading.partner
                )
                joined[-1] = (merged, first, end)
                continue
        joined.append((reading, start, end))
    return joined


def _is_other_system(a: Reading, b: Reading) -> bool:
    if a.kind != b.kind or len(a.numbers) != len(b.numbers):
        return False
    for x, y in zip(a.numbers, b.numbers, strict=True):
        ux, uy = x.printed, y.printed
        if ux is None or uy is None or ux.dimension != uy.dimension or ux.system == uy.system:
            return False
    return True


def _only_brackets(text: str) -> bool:
    return re.fullmatch(r"[\s()\[\]【】〔〕（）/|,;–-]*", text) is not None


def _qualified(text: str, readings: list[tuple[Reading, int, int]]) -> tuple[Reading, ...]:
    """Each reading with the words around it: those after it up to a separator, those before it from one."""
    result: list[Reading] = []
    edges = [0, *(end for _, _, end in readings)]
    for index, (reading, start, end) in enumerate(readings):
        before = text[edges[index] : start]
        own = _OF_NEXT.search(before) if index else None
        following = readings[index + 1][1] if index + 1 < len(readings) else len(text)
        after = text[end:following]
        head = re.split(r"[,;()\[\]【】〔〕/|]", before)[-1] if index else before
        if own is not None:
            head = own.group(1)
        elif index and not re.search(r"[,;()\[\]【】〔〕/|]", before):
            head = ""
        last = following == len(text)
        tail = after if last else re.split(r"[,;()\[\]【】〔〕/|]", _OF_NEXT.sub("", after))[0]
        condition = _CONDITION.search(head if index == 0 or head else before) is not None
        if index and _is_load_at(readings[index - 1][0], before, reading):
            head, condition = "", True
        if not last and _is_load_at(reading, after, readings[index + 1][0]):
            tail = _AT_RADIUS.sub("", tail)
        elif _CONDITION.search(tail):
            tail = _CONDITION.sub("", tail)
        words = " ".join(_JUNK.sub(" ", part).strip() for part in (_CONDITION.sub("", head), tail)).strip(
            "()[]【】〔〕,;/| -–~～"
        )
        if index and before.strip() == "," and not words and _NAMED.search(text[: readings[index - 1][1]]):
            words = result[-1].qualifier  # "Retracted: 2.3 m, Extended: 3.3 m, 4.3 m"
        result.append(replace(reading, qualifier=" ".join(words.split()), condition=condition))
    return tuple(result)


def _is_load_at(load: Reading, between: str, radius: Reading) -> bool:
    """Whether a length tells where the load before it is lifted: "5.100 kg a 2,50 m"."""
    told = (load.numbers[0].dimension, radius.numbers[0].dimension) == ("mass", "length")
    return told and _AT_RADIUS.search(between) is not None
