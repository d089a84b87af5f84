"""Statements → claims: one property, one quantity. Products are taken apart, both systems of measurement compared."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.numbers import Reading, read
from yellowiron.specs.language.quantities import FEET_DASH, FEET_INCHES, Quantity, same
from yellowiron.specs.language.units import printed_unit
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import COUNTED, GRAVITATIONAL, Statement, without_value_of_label
from yellowiron.specs.values.enumerations import COUNTED_PARTS, alternatives, enumerated, opposed, standard_of_two

_TIMES = re.compile(r"(?<![\d.,])([2-9])\s*[x×](?![\w])|[x×]\s*([2-9])(?![\d.,])", re.IGNORECASE)

COUNTED_TOGETHER = "this is what they give together"
"""How the doubt ends about a flow that is printed for one of several pumps."""
PRINTED_FOR_A_FORCE = "for a force"
"""How the doubt ends about a force whose unit is a torque's."""


@dataclass(frozen=True)
class Claim:
    """What a sheet says of one property. `words` name it (label and qualifier), `head` are its column's words.

    `partner`: the same value in the other system; `ranged`: it is the `low` or the other end of a range; `doubt` says
    why a person should look.
    """

    statement: Statement
    words: str
    head: str
    quantity: Quantity
    partner: Quantity | None = None
    ranged: bool = False
    low: bool = False
    doubt: str = ""


def claims_of(statements: Sequence[Statement], style: DecimalStyle) -> list[Claim]:
    """The claims of all statements, in order; cells of one row and column in two systems become one claim."""
    claims: list[Claim] = []
    for statement in statements:
        claims.extend(_expand(statement, style))
    joined = _joined_systems(_with_units(_in_one_unit(claims)))
    return [*joined, *(force for claim in joined if (force := _as_force(claim)))]


_FORCES = {"kilogram": "kgf", "pound": "lbf", "kilonewton*meter": "kN"}
"""Units that sheets print for a force, and the force that is meant."""
_PULLS = {"force", "pull"}


def _as_force(claim: Claim) -> Claim | None:
    """A mass that a label calls a force or a pull, as the force that its weight is ("Line pull: 5,860 kg"); a torque,
    as the force whose unit is meant ("Breakout force: 247 kNm"), for a person to look at."""
    words = {t for text in (claim.words, claim.head, *claim.statement.context[-1:]) for t in tokens(text)}
    own = _force(claim.quantity)
    if own is None or not _PULLS & words:
        return None
    slip = claim.quantity.dimension == "torque"
    doubt = f"the sheet prints '{claim.quantity.unit}' {PRINTED_FOR_A_FORCE}" if slip else claim.doubt
    return replace(claim, quantity=own, partner=claim.partner and _force(claim.partner), doubt=doubt)


def _force(quantity: Quantity) -> Quantity | None:
    unit = _FORCES.get(quantity.printed.name) if quantity.printed else None
    return replace(quantity, unit=unit) if unit else None


BARE_UNITS = {
    "length": ("mm", "cm", "m"),
    "mass": ("kg", "t"),
    "volume": ("L", "m³"),
    "force": ("kN",),
    "pressure": ("kPa", "bar", "MPa"),
    "speed": ("km/h",),
    "flow": ("L/min",),
    "power": ("kW",),
    "torque": ("N·m",),
}
"""Metric units that a column of numbers may leave unsaid, by dimension."""


def _in_one_unit(claims: Sequence[Claim]) -> list[Claim]:
    """Two numbers of one cell under an imperial unit ("858 33.8" under "in"), or the second with one in brackets
    ("3,275 (10'9\")"): the first is metric, in the unit in which the two agree; where they agree in none, both are in
    doubt."""
    found: list[Claim | None] = list(claims)
    for index, (first, second) in enumerate(pairwise(claims)):
        printed = second.quantity.printed
        if first.statement is not second.statement or first.words != second.words:
            continue
        alone = sum(c.statement is first.statement for c in claims[max(0, index - 2) : index + 4]) == 2
        if not alone or printed is None or printed.system != "imperial" or first.partner or second.partner:
            continue
        text = spelled_out(first.statement.text, first.statement.unit)[0]
        between = text[first.quantity.end : second.quantity.start].strip()
        if between not in ("", "(") or not (first.statement.unit or between):
            continue
        own = first.quantity.printed
        metric = _metric_readings(first.quantity, second.quantity)
        if own is not None and own.system == "metric":
            metric = [first.quantity] if same(first.quantity, second.quantity) else []
        if len(metric) == 1:
            found[index : index + 2] = (replace(first, quantity=metric[0], partner=second.quantity), None)
        else:
            why = f"the sheet prints '{first.quantity.text}' beside '{second.quantity.text}', and one unit for both"
            found[index : index + 2] = (replace(first, doubt=why), replace(second, doubt=why))
    return [claim for claim in found if claim is not None]


def _metric_readings(bare: Quantity, imperial: Quantity) -> list[Quantity]:
    """A number in the metric units in which it is what an imperial quantity says."""
    return [
        read_as
        for unit in BARE_UNITS.get(imperial.dimension, ())
        for value in (bare.value, bare.other)
        if value is not None and same(read_as := replace(bare, value=value, unit=unit, other=None), imperial)
    ]


def _with_units(claims: Sequence[Claim]) -> list[Claim]:
    """A number without a unit beside its imperial counterpart ("3,595 | 11'10\"") has the metric unit in which the two
    agree; where they agree in none, the imperial one is in doubt."""
    found = list(claims)
    for index, claim in enumerate(claims):
        if claim.quantity.printed is None or claim.quantity.printed.system != "imperial" or claim.partner is not None:
            continue
        row = [
            i
            for i in range(max(0, index - 4), min(len(claims), index + 5))
            if claims[i].statement.row == claim.statement.row and claims[i].words == claim.words
        ]
        others = [i for i in row if i != index]
        bare = [i for i in others if not claims[i].quantity.unit and claims[i].statement is not claim.statement]
        if len(bare) != 1 or len(others) != 1:
            continue
        quantity = claims[bare[0]].quantity
        fitting = _metric_readings(quantity, claim.quantity)
        if len(fitting) == 1:
            found[bare[0]] = replace(claims[bare[0]], quantity=fitting[0])
        else:
            why = f"the sheet prints '{quantity.text}' beside '{claim.quantity.text}', and not in which unit"
            found[index] = replace(claim, doubt=claim.doubt or why)
    return found


def sisters_in(head: str) -> set[str]:
    """The models of a head that names several, side by side: "CBD20-AC2 CBD20-AZ3"; without case."""
    words = head.split()
    return set(map(without_case, words)) if len(words) > 1 and all(map(names_model, words)) else set()


def phrases_in(text: str) -> set[str]:
    """The phrases of a configuration or a head, without case and spaces."""
    return {without_case(phrase) for phrase in split_phrases(text) if phrase.strip()}


def split_phrases(text: str) -> list[str]:
    """A configuration or a head, cut at semicolons and commas; one between digits is a decimal comma: "Stiel 5,5 m"."""
    return re.split(r";|,(?!\d)|(?<!\d),", text)


def without_case(text: str) -> str:
    """A text without case and spaces."""
    return "".join(text.casefold().split())


def _expand(statement: Statement, style: DecimalStyle) -> Iterator[Claim]:
    whole, text = without_value_of_label(statement)
    text, unit = spelled_out(GRAVITATIONAL.sub("", text), statement.unit)
    label = _without_conditions(whole)
    if opposed(label):
        text = re.sub(r"(?<=\d)\s?[-–]\s?(?=\d+\b)", "/", text)  # "6-11" of "Tilt, forward/backward" is no range
    every = _without_chart(read(text, unit=unit, style=style))
    readings = [r for r in every if not r.condition]
    yield from _at_radius(statement, label, every)
    kept: list[Reading] = []
    for reading in readings:
        if any(_restates(earlier, reading) for earlier in kept):
            continue
        kept.append(reading)
    labels = _labels_of_each(text, label, readings, kept)
    ends = _ends(text, kept) if len(readings) == len(kept) == 2 and labels == [[label]] * 2 else ()
    for index, (reading, own) in enumerate(zip(kept, labels, strict=True)):
        for one in own:
            for claim in _claims_of_reading(statement, one, reading):
                yield replace(claim, ranged=True, low=ends[index]) if ends else claim


def _without_chart(readings: Sequence[Reading]) -> Sequence[Reading]:
    """The readings without all but the first of loads that become less where they are lifted farther out: "5.100 kg a
    2,50 m y 1.180 kg a 10,16 m"."""
    pairs = list(zip(readings[::2], readings[1::2], strict=False))
    if len(readings) < 4 or len(readings) % 2 or any(a.condition or not b.condition for a, b in pairs):
        return readings
    loads, radii = ([r.numbers[0] for r in own] for own in (readings[::2], readings[1::2]))
    if {q.dimension for q in loads} != {"mass"} or {q.dimension for q in radii} != {"length"}:
        return readings
    falls = all(a.si_value > b.si_value for a, b in pairwise(loads))
    return readings[:2] if falls and all(a.si_value < b.si_value for a, b in pairwise(radii)) else readings


def _ends(text: str, pair: Sequence[Reading]) -> tuple[bool, ...]:
    """Which of two numbers with a slash between them is the lower end of a range, the other being the upper: "256/147
    kN" of one force."""
    first, second = (reading.numbers[0] for reading in pair)
    end = max(q.end for q in (*pair[0].numbers, *pair[0].partner))
    alone = all(len(r.numbers) == 1 and not r.qualifier for r in pair) and first.dimension == second.dimension
    if not alone or first.si_value == second.si_value or text[end : second.start].strip() not in ("/", "／"):
        return ()
    return first.si_value < second.si_value, second.si_value < first.si_value


def _at_radius(statement: Statement, label: str, readings: Sequence[Reading]) -> Iterator[Claim]:
    """The length at which a load is lifted, said behind it: "Maximum lifting capacity: 3,030 kg at 2.7 m"."""
    for load, where in pairwise(readings):
        quantity = where.numbers[0]
        if not where.condition or load.condition or len(where.numbers) != 1:
            continue
        if (load.numbers[0].dimension, quantity.dimension) == ("mass", "length"):
            partner = where.partner[0] if where.partner else None
            yield _checked(Claim(statement, f"{label} radius", " ".join(statement.column), quantity, partner))


def _labels_of_each(text: str, label: str, readings: Sequence[Reading], kept: Sequence[Reading]) -> list[list[str]]:
    """The labels of each reading: one part of a label that names alternatives for each of numbers with slashes between
    them, all parts and the whole for a number that is the only one."""
    whole = [[label]] * len(kept)
    if not kept or any(len(r.numbers) != 1 or len(r.partner) > 1 for r in kept):
        return whole
    if len(kept) == 1:
        return [[label, *(opposed(label) or standard_of_two(label))]]
    starts = [r.numbers[0].start for r in kept[1:]]
    both = zip(kept, starts, strict=False)  # "23 km/h / 25 km/h (14.3 mph / 15.5 mph)": what agrees may stand behind
    ends = [max(q.end for q in (*r.numbers, *r.partner) if q.end <= start) for r, start in both]
    between = [text[end:start] for end, start in zip(ends, starts, strict=True)]
    if not all(re.fullmatch(r"[^\W\d()]*\)?\s*[/／]\s*[+]?", part.strip()) for part in between):
        return whole
    return [[own] for own in alternatives(label, len(kept)) or enumerated(label, len(kept))] or whole


def spelled_out(text: str, unit: str) -> tuple[str, str]:
    """A cell under a head of two units with both written out, and the first unit: ("5.62 (18-5)", "m|ft-in") →
    ("5.62 (18'5\")", "m")."""
    first, bar, second = unit.partition("|")
    if not bar:
        return text, unit

    def inside(match: re.Match[str]) -> str:
        words = match.group(1)
        if second == FEET_INCHES:
            return f"({re.sub(FEET_DASH, _feet_and_inches, words)})"
        return f"({words} {second})" if read(words) else match.group(0)

    listed = re.fullmatch(r"([\d.,]+)\s?([/x×])\s?([\d.,]+)\s?\(([\d.,]+)\s?\2\s?([\d.,]+)\)", text)
    if listed and second != FEET_INCHES:  # "37.8/38.4 (960/975)"
        a, sign, b, c, d = listed.groups()
        return f"{a} ({c} {second}) {sign} {b} ({d} {second})", first
    apart = re.fullmatch(r"(.*\d\S*)\s*(?:[/|]|\[)\s*([^\[\]/|()]*\d[^\[\]/|()]*)\]?", text)
    if apart and "(" not in text and len(read(apart.group(1))) == len(read(apart.group(2))) == 1:
        text = f"{apart.group(1)} ({apart.group(2)})"
    return re.sub(r"\(([^()]*)\)", inside, text), first


def _feet_and_inches(match: re.Match[str]) -> str:
    return f"{match['feet']}'{match['inches']}\""


def _restates(a: Reading, b: Reading) -> bool:
    """Whether a reading gives an earlier one again in a third unit: "31.4 MPa (320 kgf/cm2; 4,554 psi)"."""
    return (
        not b.qualifier
        and len(a.numbers) == len(b.numbers)
        and all(x.unit != y.unit and same(x, y) for x, y in zip(a.numbers, b.numbers, strict=True))
    )


def _claims_of_reading(statement: Statement, label: str, reading: Reading) -> Iterator[Claim]:
    again = re.fullmatch(r"[({](.*)[)}]", reading.qualifier.strip())  # "2.6 min-1 (rpm)"
    words = label if again and printed_unit(again.group(1)) else f"{label} {reading.qualifier}".strip()
    if reading.numbers[0].sign == "±" and "each" not in tokens(words):
        words = f"{words} ±"
    head = " ".join(statement.column)
    if reading.kind == "product":
        yield from _factors(statement, label, reading)
        return
    words = COUNTED_PARTS.sub(" ", words) if reading.count is not None else words
    several = _several(label, reading)
    partner = reading.partner[0] if reading.partner else None
    ranged = reading.kind == "range"
    for index, quantity in enumerate(reading.numbers):
        if ranged and index == 0 and quantity.value == 0:
            ranged = False  # "0 - 5 km/h" says how much it is at most
            continue
        other = reading.partner[index] if index < len(reading.partner) else partner
        named = several > 1 and reading.count != several  # "2 x 123 l/min" says it with the number
        doubt = f"the sheet counts {several} of them: {COUNTED_TOGETHER}" if named else ""
        if several > 1:
            quantity, other = _times(quantity, several), other and _times(other, several)
        doubt = doubt or _sum(statement.text, quantity)
        low = ranged and index == 0
        yield _checked(Claim(statement, words, head, quantity, other, ranged=ranged, low=low, doubt=doubt))


def _sum(text: str, quantity: Quantity) -> str:
    """A doubt about a number that another one is added to: "28 + 10 mm"."""
    at = text.find(quantity.text.lstrip("+ "))
    parts = at >= 0 and (
        re.search(r"\d\s*\+\s*$", text[:at]) or re.match(r"\S*\s*\+\s*\d", text[at + len(quantity.text.lstrip("+ ")) :])
    )
    return f"the sheet prints a sum, '{text}'" if parts else ""


def _times(quantity: Quantity, count: int) -> Quantity:
    return replace(
        quantity, value=count * quantity.value, half=count * quantity.half, text=f"{count} x {quantity.text}"
    )


def _several(label: str, reading: Reading) -> int:
    """How many pumps a flow is that of one of: "Maximum flow (2x)", "2 x 235 L/min"; 1 if that is not said."""
    if reading.numbers[0].dimension != "flow":
        return 1
    counted = _TIMES.search(label)
    return int(counted.group(1) or counted.group(2)) if counted else reading.count or 1


def _factors(statement: Statement, label: str, reading: Reading) -> Iterator[Claim]:
    """A product's factors go to the properties that the label, a head or a sub-heading lists in the same order."""
    places = [(label, "label"), *((h, "head") for h in reversed(statement.column))]
    places += [(c, "context") for c in reversed(statement.context)]
    for text, place in places:
        names = enumerated(text, len(reading.numbers)) or enumerated(text.partition(")")[0], len(reading.numbers))
        if not names:
            continue
        for index, (name, quantity) in enumerate(zip(names, reading.numbers, strict=True)):
            partner = reading.partner[index] if len(reading.partner) == len(reading.numbers) else None
            others = [label] if place != "label" else []
            head = " ".join(h for h in statement.column if h != text)
            yield _checked(Claim(statement, " ".join([*others, name]), head, quantity, partner))
        return
    first, partner = reading.numbers[0], reading.partner[0] if reading.partner else None
    counts = COUNTED.search(label) and reading.numbers[-1].value == 2 and not first.unit
    if (counts and len(reading.numbers) == 2) or all(same(first, other) for other in reading.numbers[1:]):
        yield _checked(Claim(statement, label, " ".join(statement.column), first, partner))
    elif len(reading.numbers) == 2 and re.search(r"[Øø⌀φΦ]\s*$", statement.text.partition(first.text)[0]):
        yield _checked(Claim(statement, f"{label} diameter", " ".join(statement.column), first, partner))


def configured_by(claim: Claim) -> tuple[str, ...]:
    """What names the configuration that a claim holds for."""
    label = claim.statement.label
    return claim.statement.variant or claim.statement.column or ((label,) if names_model(label) else ())


_MODEL = re.compile(r"(?=\S*\d\S*\d)[A-Z]{1,4}[-–]?[A-Z]{0,3}\d[\dA-Z/-]*(?:\s(?:\([A-Z\d/-]{1,5}\)|[A-Z\d/-]{1,5}))*")


def names_model(label: str) -> bool:
    """Whether a label is a model's designation, and no more: "D6R2 XL (SU)"."""
    return _MODEL.fullmatch(label.strip()) is not None and not any(q.printed for r in read(label) for q in r.numbers)


_SEE = re.compile(r"\((?:see|siehe|voir|véase|ver)\b[^()]*\)", re.IGNORECASE)


def _without_conditions(label: str) -> str:
    """A label without its circumstances in numbers with units: "Pump flow at 2,000 rpm" → "Pump flow"; and without what
    it sends the reader to: "(see tire chart)"."""
    label = _SEE.sub(" ", label)
    for reading in reversed(read(label)):
        first, last = reading.numbers[0], reading.numbers[-1]
        if reading.condition and first.printed is not None and first.dimension != "angle":
            head = re.sub(r"(?:\bat|@|\bbei|\bà)\s*$", "", label[: first.start], flags=re.IGNORECASE)
            label = f"{head.rstrip(' (')} {label[last.end :].lstrip(' )')}"
    return " ".join(label.split())


def _checked(claim: Claim) -> Claim:
    """The claim with its separator's doubt settled by its partner, and a doubt where the two disagree."""
    quantity, partner = claim.quantity, claim.partner
    if partner is None:
        return claim
    if same(quantity, partner) or _rounded_for_each(quantity, partner):
        return replace(claim, quantity=replace(quantity, other=None))
    if quantity.other is not None:
        swapped = replace(quantity, value=quantity.other, half=0.5, other=None)
        if same(swapped, partner):
            return replace(claim, quantity=swapped)
    return replace(claim, doubt=f"the sheet prints '{quantity.text}' beside '{partner.text}', which differ")


def _joined_systems(claims: Sequence[Claim]) -> list[Claim]:
    """Neighbouring cells of one row under the same heads, metric and imperial, become one claim."""
    joined: list[Claim] = []
    for claim in claims:
        for index in range(len(joined) - 1, max(-1, len(joined) - 7), -1):
            before = joined[index]
            if before.partner is None and claim.partner is None and _are_twins(before, claim):
                joined[index] = _checked(_metric_first(before, claim))
                break
        else:
            joined.append(claim)
    return joined


def _are_twins(a: Claim, b: Claim) -> bool:
    if a.statement.row != b.statement.row or a.statement is b.statement or a.ranged or b.ranged:
        return False
    ua, ub = a.quantity.printed, b.quantity.printed
    return (
        a.words == b.words
        and _without_system(a.statement.column) == _without_system(b.statement.column)
        and ua is not None
        and ub is not None
        and ua.dimension == ub.dimension
        and {ua.system, ub.system} == {"metric", "imperial"}
    )


_SYSTEM = re.compile(
    r"(?:metric|si|imperial|english|us|u\.s\.|us customary|metrisch|métrique|métrico|公制|英制|メートル法)"
    r"(?: (?:units?|system|measure))?",
    re.IGNORECASE,
)


def is_system(head: str) -> bool:
    """Whether a head names a system of measurement: "Metric"."""
    return _SYSTEM.fullmatch(head.strip(" ()")) is not None


def _without_system(column: Sequence[str]) -> list[str]:
    return [head for head in column if not is_system(head)]


def _metric_first(a: Claim, b: Claim) -> Claim:
    unit = a.quantity.printed
    if unit is not None and unit.system == "metric":
        return replace(a, partner=b.quantity)
    return replace(b, partner=a.quantity)


_ROUNDED = 1.5e-3
"""Makers round to 5 kg here and to 5 lb there: what differs by less is the same."""


def _rounded_for_each(a: Quantity, b: Quantity) -> bool:
    """Whether two quantities are the same, rounded in each system, or one is in metric horsepower that are called
    "hp"."""
    metric = (replace(q, unit="PS") if q.printed and q.printed.name == "horsepower" else q for q in (a, b))
    close = a.dimension == b.dimension and abs(a.si_value - b.si_value) <= _ROUNDED * abs(a.si_value)
    return close or same(*metric)


_FEWEST = 8
"""Lengths that must be printed in it."""
_LEAST = 100.0
"""What is less may count something."""


def in_only_unit(claims: Sequence[Claim]) -> list[Claim]:
    """The bare numbers of a sheet in mm, where all its lengths of such a size are in mm and none is in inches or feet:
    "Tread width 1,474" among them is no 1,474 of anything else."""
    lengths = [q for c in claims for q in (c.quantity, c.partner) if q is not None and q.dimension == "length"]
    large = [q for q in lengths if q.value >= _LEAST]
    if len(large) < _FEWEST or any(q.printed and q.printed.system == "imperial" for q in lengths):
        return []
    if {q.unit for q in large} != {"mm"}:
        return []
    table = [c for c in claims if not c.statement.running]  # in a sentence it may be a model
    bare = [c for c in table if not c.quantity.unit and not c.quantity.sign and c.quantity.value >= _LEAST]
    return [replace(claim, quantity=replace(claim.quantity, unit="mm")) for claim in bare]
