"""The values a template asks for, as a language model finds them on the pages: a second reader beside the rules.

The model sees each page as it lies there and points: at a value's cell, its label, its column. What it says of the
number, of the property and of the column is checked (`pointing`); the words of the label are judged as the rules judge
them (`matching`). What agrees with the rules is settled by `agreement`.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from yellowiron.endpoint import Endpoint
from yellowiron.model.specification import fold
from yellowiron.model.template import Wanted
from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.quantities import same
from yellowiron.specs.language.vocabulary import KNOWN, tokens
from yellowiron.specs.layout.page_cells import Cell
from yellowiron.specs.llm.doubts import says_in_full
from yellowiron.specs.llm.pointing import PageText, Place, RefusedError, Spot, place_of, spot_of
from yellowiron.specs.llm.prompts import PLACES, places_on
from yellowiron.specs.values.claims import Claim, claims_of, phrases_in, without_case
from yellowiron.specs.values.contention import Match
from yellowiron.specs.values.decision import is_broken_off, settled
from yellowiron.specs.values.matching import match, match_one, weakly
from yellowiron.specs.values.requested import usual
from yellowiron.specs.values.tolerances import LEAST

_MOST_CELLS = 500
"""Cells that one question shows; a longer page is asked in parts."""
_LEAST_NUMBERS = 2
"""A page with fewer values states no specifications."""
_SPOKEN = {
    "angle": "angle", "mass": "weight", "speed": "speed", "pressure": "pressure", "flow": "flow", "power": "power",
    "torque": "torque", "time": "time", "force": "force",
}  # fmt: skip
"""The word that a unit says by itself: what is printed in degrees is an angle."""
_RANGE = re.compile(r"\s*(?:[-–—~～…]|to|bis|à|a|至)\s*", re.IGNORECASE)
_TO = re.compile(r"\s(?:to|bis|à|a)$")
_GOES_ON = re.compile(
    r"\b(?:at|of|with|without|for|from|to|over|under|and|or|bei|mit|ohne|von|bis|und|oder|avec|sans|pour|de|du|et|ou|"
    r"con|sin|para|del|y|o)$",
    re.IGNORECASE,
)
"""How a label ends that goes on elsewhere: "Maximum reach at", and below it "ground level"."""
_EMPTY = re.compile(r"^\s*[-–—]+\s*/|/\s*[-–—]+\s*$")
"""One of two values that is not given: "- / 25" of "laden/unladen"."""
_ANYTHINGS = frozenset({"height", "length", "width", "depth", "diameter", "weight", "speed", "capacity"})
"""What anything has, a blade as a machine: such a label alone says in full of what it is only to the rules."""
_LOW, _HIGH = frozenset({"minimum", "retracted", "low"}), frozenset({"maximum", "extended", "high"})


@dataclass(frozen=True)
class Pointed:
    """A place that passed the gates: how its words speak of the wanted value, and whether they do so in full
    (`sure`), so that nothing but a person's look was missing."""

    match: Match
    place: Place
    sure: bool


@dataclass
class Reading:
    """What a model found, by wanted name; `seen`: where the numbers stand that it points to, also those whose label was
    turned away; `refused`: how often and why it was turned away; `unusable`: questions to which it gave no answer of
    the shape that was asked for."""

    found: dict[str, list[Pointed]] = field(default_factory=dict)
    seen: dict[str, list[Spot]] = field(default_factory=dict)
    refused: Counter[str] = field(default_factory=Counter)
    unusable: int = 0


def read_pages(
    wanted: Sequence[Wanted],
    every: Sequence[Wanted],
    pages: Sequence[tuple[PageText, DecimalStyle]],
    claims: Sequence[Claim],
    endpoint: Endpoint,
    *,
    config: str = "",
    progress: Callable[[str], None] = lambda words: None,
) -> Reading:
    """Where the model finds wanted values on the pages, among `every` value that the template asks for. `claims`: what
    the rules read there; where they read the same number with other words, it is theirs that count.

    `EndpointError` where the endpoint cannot be used.
    """
    reading = Reading()
    if not wanted:
        return reading
    names = {fold(w.name): w for w in wanted}
    row = 0
    for number, (text, style) in enumerate(pages, 1):
        progress(f"Asking the language model ({number} of {len(pages)} pages)")
        answer = endpoint.ask(places_on(text, wanted, config), PLACES)
        if answer is None:
            reading.unusable += 1
            continue
        for said in answer["values"]:
            row -= 1
            one = names.get(fold(said["name"]))
            if one is not None and (spot := spot_of(said, text)) is not None:
                reading.seen.setdefault(one.name, []).append(spot)
            try:
                pointed = checked(one, said, text, row, style, every, claims, config)
            except RefusedError as why:
                reading.refused[str(why)] += 1
                continue
            reading.found.setdefault(pointed.match.wanted.name, []).append(pointed)
    return reading


def pages_of(cells: Sequence[Sequence[Cell]]) -> list[PageText]:
    """The pages that hold values, sheet by sheet, long ones in parts."""
    found = []
    for sheet, own in enumerate(cells):
        by_page: dict[int, list[Cell]] = {}
        for cell in own:
            by_page.setdefault(cell.page, []).append(cell)
        for page, members in by_page.items():
            parts = [members[i : i + _MOST_CELLS] for i in range(0, len(members), _MOST_CELLS)]
            found += [
                PageText(sheet, page, tuple(part))
                for part in parts
                if sum(any(c.isdigit() for c in cell.text) for cell in part) >= _LEAST_NUMBERS
            ]
    return found


def checked(
    one: Wanted | None,
    said: Mapping[str, object],
    text: PageText,
    row: int,
    style: DecimalStyle,
    every: Sequence[Wanted],
    claims: Sequence[Claim],
    config: str,
) -> Pointed:
    """An entry of an answer that passes the gates; it is sure where the rules' own words for the number, too, say the
    value. `RefusedError` where it does not pass."""
    pointed = _checked(one, said, text, row, style, every, config)
    read_so = [c for c in claims if _is_there(c, pointed)]
    sure = pointed.sure and all(_is_sure(c, claims, pointed, every, config) for c in read_so)
    return replace(pointed, sure=sure)


def _checked(
    one: Wanted | None,
    said: Mapping[str, object],
    text: PageText,
    row: int,
    style: DecimalStyle,
    every: Sequence[Wanted],
    config: str,
) -> Pointed:
    if one is None:
        raise RefusedError("nobody asked for that")
    place = place_of(said, text, row)
    claims = claims_of([place.statement], style)
    digits = str(said["value"]).strip()
    own = [c for c in claims if c.quantity.dimension == one.dimension and _prints(c, digits)]
    judged = [p for c in own if (p := _judged(one, c, claims, place, every, config)) is not None]
    if not own:
        raise RefusedError("the number has another dimension, or no unit")
    if not judged:
        raise RefusedError("the label speaks of something else")
    return max(judged, key=lambda p: (p.sure, p.match.score))


def _is_there(claim: Claim, pointed: Pointed) -> bool:
    """Whether the rules read a number at the place that is pointed to."""
    cell, own = claim.statement, pointed.match.claim
    if (cell.sheet, cell.page) != (own.statement.sheet, own.statement.page):
        return False
    a, b = cell.box, own.statement.box
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3] and same(claim.quantity, own.quantity)


def _is_sure(claim: Claim, claims: Sequence[Claim], pointed: Pointed, every: Sequence[Wanted], config: str) -> bool:
    """Whether the rules' own words for a number say it, too: those of its row, if they read less of it, under its heads
    but the ones that name the configuration, and what stands over these."""
    statement, place = claim.statement, pointed.place
    named = [n for n, head in enumerate(statement.column, 1) if without_case(head) in phrases_in(config)]
    read, row = set(tokens(statement.label)), set(tokens(place.statement.label))
    words = place.statement.label if read < row else claim.words
    own = replace(statement, column=statement.column[named[-1] :] if named else statement.column)
    beside = {id(c): replace(c, statement=own) for c in claims if c.statement is statement}
    beside[id(claim)] = worded = replace(claim, words=words, statement=own)
    judged = _judged(pointed.match.wanted, worded, list(beside.values()), place, every, config)
    return judged is not None and judged.sure


def _prints(claim: Claim, number: str) -> bool:
    """Whether a claim's quantity is the number that is pointed to, in one of its systems or within a product."""
    shown = [q.text for q in (claim.quantity, claim.partner) if q is not None]
    return any(number in text or text in number for text in shown)


def _judged(
    one: Wanted, claim: Claim, claims: Sequence[Claim], place: Place, every: Sequence[Wanted], config: str
) -> Pointed | None:
    """How a place's words speak of a wanted value; None where they do not, or say another one better."""
    spoken = _spoken(one, claim, claims)
    best: Match | None = None
    for words in dict.fromkeys((claim.words, _without_other_dimensions(_TO.sub("", claim.words), one) + spoken)):
        worded = replace(claim, words=words)
        own = match_one(one, worded, every)
        if own is not None and (best is None or own.score > best.score):
            best = own
    if best is None:
        weak = weakly(one, claim)
        unknown = not any(t in KNOWN for t in tokens(claim.words))
        if weak is None and unknown and usual(one, settled(one, claim)[0].si_value):
            weak = Match(one, claim, 0.0, "", (), 1.0)  # words that the rules do not know
        return None if weak is None else Pointed(weak, place, False)
    ends = _ends(claim, claims)
    other_end = frozenset() if ends is None else _HIGH if claim is ends[0] else _LOW
    rivals = [w for w in every if w.name != one.name and not other_end & set(tokens(w.name))]
    others = [m.score for w in rivals if (m := match_one(w, claim)) is not None]
    rival = max(others, default=0.0)
    if rival >= LEAST and rival > best.score:
        return None
    quantity, doubt = settled(one, claim)
    chosen = not place.in_columns or _named(place, config)
    ranged = claim.ranged and not _end_is_named(one, claim, claims)
    # Of two values that one label may mean ("angle", "greatest angle") only the page can say which it is.
    told = match([best.claim], [one, *rivals])  # by its own name, too: "engine power" is no net power then
    shared = [m for w in rivals for m in told[w.name] if m.score > best.score - 1e-9]
    label = place.statement.label.rstrip()
    whole = not (is_broken_off(label) or _GOES_ON.search(label) or _EMPTY.search(place.statement.text))
    whole = whole and not set(tokens(label)) <= _ANYTHINGS
    sure = not (doubt or ranged or shared) and whole and chosen and usual(one, quantity.si_value) and says_in_full(best)
    return Pointed(replace(best, claim=replace(best.claim, ranged=ranged)), place, sure)


def _spoken(one: Wanted, claim: Claim, claims: Sequence[Claim]) -> str:
    """What a number says without words: the dimension of its unit, and which end of a range it is."""
    said = f" {_SPOKEN[one.dimension]}" if one.dimension in _SPOKEN else ""
    ends = _ends(claim, claims)
    return said + ("" if ends is None else " minimum" if claim is ends[0] else " maximum")


def _ends(claim: Claim, claims: Sequence[Claim]) -> tuple[Claim, Claim] | None:
    """The two claims of the range that a claim is an end of: "18 m - 140 m", "1° to 80°"."""
    pair = [c for c in claims if c.statement is claim.statement and c.quantity.dimension == claim.quantity.dimension]
    if len(pair) != 2 or claim not in pair:
        return None
    low, high = pair[0].quantity, pair[1].quantity
    between = claim.statement.text[low.end : high.start]
    return (pair[0], pair[1]) if _RANGE.fullmatch(between) and low.si_value < high.si_value else None


def _end_is_named(one: Wanted, claim: Claim, claims: Sequence[Claim]) -> bool:
    """Whether the wanted value's name says which end of a range it is, and the claim is that end."""
    ends = _ends(claim, claims)
    name = set(tokens(one.name))
    return ends is not None and bool((name & _LOW and claim is ends[0]) or (name & _HIGH and claim is ends[1]))


def _without_other_dimensions(words: str, one: Wanted) -> str:
    """A label without words that name another dimension than the number's: an angle is no speed."""
    others = {word for dimension, word in _SPOKEN.items() if dimension != one.dimension}
    return " ".join(word for word in words.split() if not (set(tokens(word)) & others))


def _named(place: Place, config: str) -> bool:
    """Whether the configuration names the column in which a value stands."""
    meant = phrases_in(config)
    return any(own and own <= meant for own in map(phrases_in, place.over))
