"""Matches → one specification with a status. A wrong number is worse than none: whatever is in doubt says so."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from yellowiron.model.specification import Candidate, Evidence, Specification, Status
from yellowiron.model.template import Wanted
from yellowiron.specs.language.decimal_style import DecimalStyle
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.quantities import Quantity, same
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import Statement, words_beside_numbers
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.values.claims import Claim, configured_by, names_model, sisters_in, split_phrases, without_case
from yellowiron.specs.values.contention import (
    Match,
    are_all_gears,
    called,
    explained,
    extremes,
    first_of_two,
    of_another_place,
)
from yellowiron.specs.values.requested import check_hint, hint_for, usual
from yellowiron.specs.values.stated_configuration import Stated
from yellowiron.specs.values.tolerances import DOUBTFUL, SURE
from yellowiron.support.units import SI_UNIT

_NEAR = 0.15
"""Claims this much weaker than the best still have a say."""
WOULD_BE_USUAL = "it would be usual"
"""How the doubt ends about a value that can be so much only in a unit that makers print for another by mistake."""
OF_OTHERS = "has a column of its own"
"""How the doubt ends about a value that stands in columns of other models alone."""
_SAID = 0.5
"""A column says a phrase of the configuration if it says this share of its words."""


Column = tuple[int, int, tuple[str, ...]]
"""A column of a table: sheet, page, the heads over it."""


@dataclass(frozen=True)
class Sheets:
    """What `decide` must know of the sheets: their `files`, in the order that `Statement.sheet` counts; by sheet, page
    and heads the quantities of a `column`; sentences that may say which configuration is meant (`stated`)."""

    files: Sequence[str]
    columns: Mapping[Column, frozenset[str]]
    stated: tuple[Stated, ...] = ()


def decide(wanted: Wanted, matches: Sequence[Match], sheets: Sheets, config: str = "") -> Specification:
    """The specification of a wanted value; `config` names the configuration that is meant ("standard boom, stock-pile
    bucket"; a value of the column will do: "4.2 m3")."""
    if not matches:
        return missing(wanted)
    whole = [m for m in matches if not is_broken_off(m.claim.statement.label)]
    chosen = _without_charts(_configured(whole or matches, sheets, config))
    groups = _groups(wanted, chosen)
    counted, also, beside = "", "", list[Match]()
    if len(groups) > 1:
        said, chosen = _as_stated(wanted, chosen, sheets)
        groups, also = _groups(wanted, chosen), f"; page {said.page} says: “{said.sentence}”" if said else ""
    if len(groups) > 1:
        every = [m for group in groups for m in group]
        greatest = extremes(every, lambda m: settled(wanted, m.claim)[0].si_value)
        counted = f"the rows count {len(groups)} values up or down, of which this is the last"
        if not greatest:
            greatest, counted = called(every), f"of {len(groups)} values, this is what the sheet calls so"
        if not greatest and len(own := first_of_two(every)) == 1:
            greatest, counted = own, f"the sheet prints '{own[0].claim.statement.text}', of which this is the first"
        if not greatest or not all(same(greatest[0].claim.quantity, m.claim.quantity) for m in greatest):
            return _conflict(wanted, groups, sheets, config)
        if not counted.startswith("the rows count"):  # what another reader reads the same is not settled by that
            beside = [max(g, key=_preference) for g in groups if not any(m is one for m in g for one in greatest)]
        elif are_all_gears(chosen):
            also, counted = f"{also}; {counted}", ""
        groups = [greatest]
    group = groups[0]
    top = max(group, key=_preference)
    quantity, doubt = settled(wanted, top.claim)
    if top.rest:
        doubt = doubt or f"the label also says {', '.join(map(repr, words_left_over(top)))}"
    elif top.score < SURE:
        doubt = doubt or f"only part of the label says {wanted.name}"
    if not top.claim.statement.proven:
        doubt = doubt or "its words do not stand together in the page's text"
    if top.claim.statement.slipped and not quantity.unit_printed:
        doubt = doubt or f"its table prints the units a row too high or too low; '{quantity.unit}' fits the label"
    if is_broken_off(top.claim.statement.label):
        doubt = doubt or "its label goes on elsewhere"
    if any(map(is_measures, top.claim.statement.column)):
        doubt = doubt or "measures of a drawing stand over it"
    doubt = doubt or counted or _of_others(group, sheets, config) or of_another_place(top)
    if top.claim.ranged:
        doubt = doubt or "the sheet prints a range"
    value = quantity.si_value
    return specified(
        wanted,
        value,
        "review" if doubt else "ok",
        evidence=evidence_of(top, sheets),
        text=printed(quantity),
        example=all(m.claim.statement.example for m in group),
        confidence=round(min(top.score, DOUBTFUL if doubt else 1.0), 3),
        reason=doubt or _reason(top, group) + also,
        hint=check_hint(wanted.name) if doubt else "",
        candidates=(
            candidate(top, sheets, value),
            *(candidate(m, sheets, m.claim.quantity.si_value) for m in beside),
        ),
    )


def is_broken_off(label: str) -> bool:
    """Whether a label ends in the middle: behind a comma or a plus, or in brackets that are not closed."""
    return re.search(r"[,，、+]$|\w[-/]$", label.rstrip()) is not None or label.count("(") > label.count(")")


def is_measures(head: str) -> bool:
    """Whether a head is several quantities and no words, which name no column."""
    readings = read(head)
    return len(readings) > 1 and not words_beside_numbers(head, readings)


def name_printed(found: Match) -> str:
    """The sheet's own words for a value: its label, or the heads or headings that stand for one."""
    statement = found.claim.statement
    heads = statement.column if found.by_head or not statement.label else ()
    above = () if found.by_label or found.by_head else (*statement.context, statement.section)
    return " / ".join(dict.fromkeys(text for text in (statement.label, *heads, *above) if text))


def words_left_over(found: Match) -> list[str]:
    """The words of a label that a value's phrases do not explain, as the sheet prints them."""
    statement = found.claim.statement
    places = (found.claim.words, *statement.column, *statement.context, statement.section)
    printed_words = [word.strip(".,;:()") for place in places for word in place.split()]
    said = [word for word in printed_words if set(tokens(word)) & set(found.rest)]
    return list(dict.fromkeys(said)) or list(found.rest)


def specified(wanted: Wanted, value: float | None, status: Status, **said: Any) -> Specification:
    """The specification of a wanted value, in SI; `said`: its other fields."""
    return Specification(wanted.name, value, SI_UNIT[wanted.dimension], status, **said)


def missing(wanted: Wanted, status: Status = "missing", reason: str = "no sheet says it") -> Specification:
    """The specification of a value that no sheet gives, or that may stand where none has text (`unreadable`)."""
    return specified(wanted, None, status, reason=reason, hint=hint_for(wanted))


def evidence_of(found: Match, sheets: Sheets) -> Evidence:
    """Where a match stands."""
    statement = found.claim.statement
    heads = statement.heads if found.by_head else ()
    quote = " … ".join(dict.fromkeys([*heads, statement.quote]))
    return Evidence(sheets.files[statement.sheet], statement.page, quote, placed(statement))


def placed(statement: Statement) -> Box:
    """A statement's box as its evidence has it."""
    x0, top, x1, bottom = (round(v, 2) for v in statement.box)
    return (x0, top, x1, bottom)


def _preference(found: Match) -> tuple[float, bool, bool, bool, bool, float]:
    claim, imperial = found.claim, _is_imperial(found.claim.quantity) and found.claim.partner is None
    statement = claim.statement
    return (
        found.score,
        statement.proven,
        not statement.example,
        claim.partner is not None,
        not imperial,
        -statement.page,
    )


# ---- configurations ------------------------------------------------------------------------------------------------


def configuration(found: Match) -> str:
    """The column or variant that a match holds for, as the sheet words it."""
    return ", ".join([*configured_by(found.claim), *words_left_over(found)])


def _configured(matches: Sequence[Match], sheets: Sheets, config: str) -> list[Match]:
    """The matches that fit the configuration asked for: each of its phrases keeps those whose column says it best. A
    head that says the phrase and no more ("Teeth") beats one that says more ("Teeth and segments")."""
    said = set(tokens(config))
    kept = [explained(m, said) for m in matches]
    for phrase, words in phrases_of(config).items():
        one = without_case(phrase)
        named = [m for m in kept if any(one in {without_case(h), *sisters_in(h)} for h in configured_by(m.claim))]
        if named:  # a head that is the phrase, to the letter: "M12-L" is not "M12"
            kept = named
            continue
        kept = _near_best(kept)  # a heading may say the phrase over what is named worse
        shares = [_share(words, m.claim, sheets) for m in kept]
        if max(shares) >= _SAID and max(shares) > min(shares):
            kept = [m for m, share in zip(kept, shares, strict=True) if share == max(shares)]
        heads = [[_words_of(head) for head in m.claim.statement.column] for m in kept]
        parts = [any(head and head <= words for head in own) for own in heads]
        if any(parts):  # the head "436" is a part of "436 ZX", "426" is not
            kept, heads = (
                [m for m, is_one in zip(kept, parts, strict=True) if is_one],
                [h for h, p in zip(heads, parts, strict=True) if p],
            )
        # "8 SU" says all that "8 SU LGP" says but one word: the latter is another one's.
        saying = [{frozenset(head) for head in own if words <= head} for own in heads]
        every = {head for own in saying for head in own}
        kept = [
            m
            for m, own in zip(kept, saying, strict=True)
            if not own or any(not any(other < head for other in every) for head in own)
        ]
    return kept


_CHARTED = 4
"""So many values under one head, or under heads on a page, are a chart: one load for each radius."""


def _of_others(group: Sequence[Match], sheets: Sheets, config: str) -> str:
    """Why a value that stands in columns of other models alone is in doubt: the model that is meant has a column of its
    own elsewhere, of which nothing was read for it (its labels may be on another page)."""
    heads = {without_case(head) for _, _, column in sheets.columns for head in column}
    models = [[head for head in configured_by(m.claim) if names_model(head)] for m in group]
    if not all(models):
        return ""
    for phrase in filter(names_model, phrases_of(config)):
        words = phrase.casefold().split()
        # The "JS370 LC" is a JS370.
        own = any(head.casefold().split()[: len(words)] == words for column in models for head in column)
        if without_case(phrase) in heads and not own:
            return f"it stands under {models[0][0]}, and {phrase} {OF_OTHERS}"
    return ""


def _without_charts(matches: Sequence[Match]) -> list[Match]:
    """The matches without those of charts in which one stands that a row of its own gives: a chart goes through the
    conditions, the row says what the machine is called by."""
    headed = [m for m in matches if m.by_head]
    charts: dict[object, list[Match]] = {}
    for one in headed:
        for place in (one.claim.statement.page, one.claim.statement.column):
            charts.setdefault(place, []).append(one)
    charted = [m for own in charts.values() if len({m.claim.quantity.si_value for m in own}) >= _CHARTED for m in own]
    plain = [m for m in matches if not m.by_head]
    if len({m.claim.quantity.si_value for m in plain}) != 1:
        return list(matches)
    called = plain[0].claim.quantity
    beyond = plain[0].by_label and all(m.claim.quantity.si_value < called.si_value for m in charted)
    greatest = beyond and "maximum" in tokens(plain[0].claim.words)  # the chart ends before it
    among = greatest or any(same(called, m.claim.quantity) for m in charted)
    return [m for m in matches if not among or not any(m is one for one in charted)]


def _near_best(matches: Sequence[Match]) -> list[Match]:
    """The matches that have a say: those nearly as good as the best."""
    best = max(m.score for m in matches)
    return [m for m in matches if m.score >= best - _NEAR]


def phrases_of(config: str) -> dict[str, set[str]]:
    """The phrases of a configuration that say anything, with their words."""
    phrases = {phrase.strip(): _words_of(phrase) for phrase in split_phrases(config)}
    return {phrase: words for phrase, words in phrases.items() if words}


def unmatched(config: str, claims: Sequence[Claim], sheets: Sheets) -> list[str]:
    """The phrases of a configuration that no column, heading or label says."""
    return [
        phrase
        for phrase, words in phrases_of(config).items()
        if not any(_share(words, claim, sheets) >= _SAID for claim in claims)
    ]


def _share(words: set[str], claim: Claim, sheets: Sheets) -> float:
    """The share of a phrase's words that a claim's column, headings or label say."""
    return len(words & _config_words(claim, sheets)) / len(words)


def _words_of(phrase: str) -> set[str]:
    """A phrase's words, its quantities as words that can be compared."""
    return set(tokens(_without_quantities(phrase))) | quantity_words(phrase)


def _as_stated(wanted: Wanted, matches: Sequence[Match], sheets: Sheets) -> tuple[Stated | None, list[Match]]:
    """The matches whose column (or row, where rows are the configurations) a sentence about the sheet's figures names
    in full, those of no configuration that say the same, and that sentence."""
    plain = [m for m in matches if not configured_by(m.claim)]
    plainly = _by_value(wanted, plain)

    def names(found: Match, words: set[str]) -> Sequence[str]:
        """What names a match's configuration; its own value does only if the sheet says it plainly, too, and the
        sentence speaks of no other such value: "a 23.45 m or a 30.5 m boom" is no machine's."""
        heads = configured_by(found.claim)
        if found.claim.statement.text not in heads:
            return heads
        said = [group[0] for group in plainly if any(_says(words, m.claim.statement.text) for m in group)]
        return heads if len(said) == 1 and len(_by_value(wanted, [found, *said])) == 1 else ()

    for stated in sheets.stated:
        words = set(tokens(stated.sentence)) | quantity_words(stated.sentence)
        kept = [m for m in matches if (heads := names(m, words)) and all(_says(words, head) for head in heads)]
        if kept:
            first = _by_value(wanted, kept)[0][0]
            return stated, [*kept, *(m for m in plain if len(_by_value(wanted, [first, m])) == 1)]
    return None, list(matches)


def _says(words: set[str], name: str) -> bool:
    """Whether these words say a name: its words, and of each quantity one of the two systems."""
    readings = [r for r in read(name, style="point") if all(q.printed for q in r.numbers)]
    said = [{f"{q.value:g} {q.printed.name}" for q in (*r.numbers, *r.partner) if q.printed} & words for r in readings]
    rest = set(tokens(_without_quantities(name)))
    return bool(readings or rest) and all(said) and rest <= words


def quantity_words(text: str, unit: str = "", style: DecimalStyle = "point") -> set[str]:
    """The quantities of a text as words that can be compared: "4.2 m3" → {"4.2 meter**3"}."""
    found = set()
    for reading in read(text, unit=unit, style=style):
        for quantity in (*reading.numbers, *reading.partner):
            if quantity.printed is not None:
                found.add(f"{quantity.value:g} {quantity.printed.name}")
    return found


def _without_quantities(text: str) -> str:
    for reading in reversed(read(text, style="point")):
        for quantity in reversed((*reading.numbers, *reading.partner)):
            if quantity.printed is not None:
                text = f"{text[: quantity.start]} {text[quantity.end :]}"
    return text


def _config_words(claim: Claim, sheets: Sheets) -> set[str]:
    statement = claim.statement
    texts = [*statement.column, *statement.variant, *statement.context, statement.section, claim.words, statement.label]
    words = {t for text in texts for t in tokens(text)}
    for text in (*statement.column, *statement.variant):
        words |= quantity_words(text)
    return words | sheets.columns.get((statement.sheet, statement.page, statement.column), frozenset())


# ---- values --------------------------------------------------------------------------------------------------------


def _groups(wanted: Wanted, matches: Sequence[Match]) -> list[list[Match]]:
    """By value; those outside what is usual have no say where others are inside."""
    inside = [m for m in matches if usual(wanted, settled(wanted, m.claim)[0].si_value)] or list(matches)
    kept = _near_best(inside)
    if all(m.claim.statement.running for m in kept):  # no sentence outdoes what a table says, too
        kept += [m for m in inside if not m.claim.statement.running]
    return _by_value(wanted, kept)


def _by_value(wanted: Wanted, matches: Sequence[Match]) -> list[list[Match]]:
    """Matches grouped by value, the best-scored group first; equal within their printed digits."""
    groups: list[list[Match]] = []
    for one in sorted(matches, key=_preference, reverse=True):
        quantity, _ = settled(wanted, one.claim)
        for group in groups:
            first, _ = settled(wanted, group[0].claim)
            slack = 1e-9 * abs(first.si_value)
            if quantity.unit != first.unit:
                slack += max(quantity.si_digit, first.si_digit)
            if abs(quantity.si_value - first.si_value) <= slack:
                group.append(one)
                break
        else:
            groups.append([one])
    return groups


def settled(wanted: Wanted, claim: Claim) -> tuple[Quantity, str]:
    """The claim's quantity, metric where both are printed, and what is doubtful about it."""
    quantity, doubt = claim.quantity, claim.doubt
    may_be_negative = wanted.dimension == "angle" and (wanted.minimum is None or wanted.minimum < 0)
    if quantity.sign == "-" and not may_be_negative:
        doubt = doubt or f"'{quantity.text}' is negative"
    if quantity.other is not None:
        readings = [quantity.value, quantity.other]
        scale = quantity.printed.scale if quantity.printed else 1.0
        inside = [r for r in readings if usual(wanted, r * scale)]
        if len(inside) == 1 and (wanted.minimum is not None or wanted.maximum is not None):
            half = quantity.half if inside[0] == quantity.value else 0.5
            return Quantity(inside[0], quantity.unit, half, quantity.text, quantity.start, quantity.end), doubt
        doubt = doubt or f"'{quantity.text}' may be {quantity.value:g} or {quantity.other:g}"
    elif claim.partner is not None and not doubt and _is_imperial(quantity):
        quantity = claim.partner
    if not usual(wanted, quantity.si_value):
        told = f"'{printed(quantity)}' is outside what is usual for {wanted.name}"
        slipped = _as_slip(wanted, quantity)
        if slipped is not None:
            quantity, told = slipped, f"{told}; in {slipped.unit} {WOULD_BE_USUAL}"
        doubt = doubt or told
    return quantity, doubt


_SLIPS = {"m": "mm", "mm": "m", "t": "kg", "kg": "t", "m/s": "mm/s", "N": "kN"}
"""Units that makers print for each other by mistake."""


def _as_slip(wanted: Wanted, quantity: Quantity) -> Quantity | None:
    """The quantity in the unit that its own was printed for by mistake ("2950" under "m"), where so much is usual: for
    a person to look at, never more."""
    unit = _SLIPS.get(quantity.unit)
    if unit is None or wanted.minimum is None or wanted.maximum is None:
        return None
    slipped = replace(quantity, unit=unit)
    return slipped if usual(wanted, slipped.si_value) else None


def printed(quantity: Quantity) -> str:
    """A quantity as printed, with the unit that its column or product gives it."""
    bare = quantity.text.lstrip("±+-−–/ ").replace(",", "").replace(".", "").replace(" ", "").isdigit()
    return f"{quantity.text} {quantity.unit}".strip() if bare else quantity.text


def _is_imperial(quantity: Quantity) -> bool:
    return quantity.printed is not None and quantity.printed.system == "imperial"


def candidate(found: Match, sheets: Sheets, value: float) -> Candidate:
    """A match as one that a person may choose; `value` in SI."""
    return Candidate(
        value=value,
        unit=SI_UNIT[found.wanted.dimension],
        evidence=evidence_of(found, sheets),
        configuration=configuration(found),
        confidence=round(found.score, 3),
        reason=found.claim.doubt or f"named by '{name_printed(found)}'",
    )


def _conflict(wanted: Wanted, groups: Sequence[Sequence[Match]], sheets: Sheets, config: str) -> Specification:
    candidates = tuple(
        candidate(one, sheets, settled(wanted, one.claim)[0].si_value)
        for one in (max(group, key=_preference) for group in groups)
    )
    names = [c.configuration for c in candidates if c.configuration]
    texts = [printed(settled(wanted, max(group, key=_preference).claim)[0]) for group in groups]
    hint = f'Give the value with --set "{wanted.name}=VALUE UNIT"'
    if len(set(names)) > 1:
        hint = (
            f'Choose a configuration with --config "{names[0]}" (or {" | ".join(names[1:4])}); or give the value with '
        )
        hint += f'--set "{wanted.name}=VALUE UNIT"'
    return specified(
        wanted,
        None,
        "conflict",
        evidence=candidates[0].evidence,
        text=" | ".join(texts),
        reason=f"the sheet gives {len(groups)} values" + (f", and '{config}' does not choose" if config else ""),
        hint=hint + ".",
        candidates=candidates,
    )


def _reason(top: Match, group: Sequence[Match]) -> str:
    parts = [f"named by '{name_printed(top)}'"]
    if top.claim.partner is not None:
        parts.append(f"'{top.claim.partner.text}' agrees")
    if len(group) > 1:
        parts.append(f"said {len(group)} times")
    if configuration(top):
        parts.append(f"column '{configuration(top)}'" if top.claim.statement.column else "")
    return "; ".join(p for p in parts if p)
