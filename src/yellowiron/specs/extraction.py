"""The values a template asks for, out of specification sheets, by rules and without any network."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from yellowiron.endpoint import Endpoint, EndpointError, ModelOptions
from yellowiron.model.errors import SheetError
from yellowiron.model.finding import Finding
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template, Wanted
from yellowiron.specs import ocr
from yellowiron.specs.columns import configured, of_configuration
from yellowiron.specs.findings import ignored_phrases, model_cost, model_failure, unread_pages, unusable_answers
from yellowiron.specs.language.decimal_style import DecimalStyle, decimal_style
from yellowiron.specs.layout.nearest import Near
from yellowiron.specs.llm.agreement import Asked, agreed
from yellowiron.specs.llm.page_reader import Reading, pages_of, read_pages
from yellowiron.specs.llm.pointing import PageText
from yellowiron.specs.machines import of_others, of_sisters, several, with_machines
from yellowiron.specs.reader import TIMEOUT_S, PageRead, Sheet, check_file, in_child
from yellowiron.specs.values.claims import Claim, claims_of, in_only_unit
from yellowiron.specs.values.contention import Match
from yellowiron.specs.values.cross_check import Nearby, second_reading, stands_in
from yellowiron.specs.values.decision import Column, Sheets, decide, missing, placed, quantity_words
from yellowiron.specs.values.matching import match
from yellowiron.specs.values.requested import asked
from yellowiron.specs.values.tolerances import PICTURED
from yellowiron.specs.values.values_in_labels import in_label
from yellowiron.support.guard import Wording

Extractor = Literal["rules", "llm", "both"]


def extract(
    template: Template,
    sheets: Sequence[Path],
    *,
    config: str = "",
    extractor: Extractor = "rules",
    model: ModelOptions | None = None,
    progress: Callable[[str], None] = lambda words: None,
) -> Specifications:
    """What the sheets say of every value the template asks for, in SI, each with its evidence and status.

    `config` names the machine's configuration where a sheet has columns ("standard boom, stock-pile bucket").
    Where a sheet says itself which configuration its figures are for, that settles what `config` leaves open; values
    that still differ between columns or pages are a `conflict`. `extractor`: rules, the language `model` ("llm"), or
    both: then the model is asked for what the rules leave open, and an endpoint that fails is a finding.
    Each PDF is read in a guarded child process; pages without a text layer are read through the programs of `ocr`
    that are installed, and their values are `review` at most. `SheetError` for a file that is missing, empty, no
    PDF, truncated, damaged or encrypted; `EndpointError` for a model that is not configured or, where nothing else
    reads, fails.
    """
    return from_sheets(
        template,
        [read(path, progress=progress) for path in sheets],
        config=config,
        extractor=extractor,
        model=model,
        progress=progress,
    )


def read(path: Path, *, progress: Callable[[str], None] = lambda words: None) -> Sheet:
    """A PDF's statements, read in guarded child processes; `progress` is told each page."""
    path = Path(path)
    check_file(path)
    sheet: Sheet = in_child("reader:read_sheet", path, progress=progress)
    readings = [_recognised(sheet, path, program, progress) for program in (ocr.programs() if sheet.silent else ())]
    first, *others = [one for one in readings if one.recognised] or readings[-1:] or [sheet]
    return replace(first, again=others[0] if others else None)


def _recognised(sheet: Sheet, path: Path, program: str, progress: Callable[[str], None]) -> Sheet:
    """The sheet with what a recognition program makes of its silent pages, in a child of its own: a picture that breaks
    it costs no page that has text."""
    try:
        bounds = {"timeout_s": 2.0 * TIMEOUT_S, "resident_mb": ocr.RESIDENT_MB, "wording": Wording("Text recognition")}
        pages: list[PageRead] = in_child("ocr:recognise", path, sheet.silent, program, progress=progress, **bounds)
    except SheetError as error:
        return replace(sheet, unrecognised=f"{error.message} ({error.hint})")
    known = {page.number: page.titles for page in pages}
    return replace(
        sheet,
        titles=tuple(own | known.get(n, frozenset()) for n, own in enumerate(sheet.titles, start=1)),
        statements=(*sheet.statements, *(replace(s, guessed=True) for page in pages for s in page.statements)),
        silent=tuple(n for n in sheet.silent if n not in known),
        style=sheet.style if sheet.statements else decimal_style([page.text for page in pages]),
        stated=(*sheet.stated, *(one for page in pages for one in page.stated)),
        recognised=tuple(sorted(known)),
        recogniser=program,
        near=(*sheet.near, *(replace(n, statement=replace(n.statement, guessed=True)) for p in pages for n in p.near)),
    )


def from_sheets(
    template: Template,
    sheets: Sequence[Sheet],
    *,
    config: str = "",
    extractor: Extractor = "rules",
    model: ModelOptions | None = None,
    progress: Callable[[str], None] = lambda words: None,
) -> Specifications:
    """`extract` on sheets that are already read."""
    ruled = by_rules(template, sheets, config=config)
    return ruled.specifications() if extractor == "rules" else with_model(ruled, extractor, model, progress=progress)


@dataclass(frozen=True)
class Ruled:
    """What the rules make of `wanted` values on sheets, by name in `values`; `nearby`: what their second reading
    brought; their `claims`, what is `known` of the sheets, `findings`. A model's word comes after it, whatever model
    that is."""

    sheets: Sequence[Sheet]
    config: str
    wanted: Sequence[Wanted]
    values: Mapping[str, Specification]
    nearby: Mapping[str, Nearby]
    claims: Sequence[Claim]
    known: Sheets
    findings: Sequence[Finding]

    @functools.cached_property
    def pages(self) -> list[tuple[PageText, DecimalStyle]]:
        """The pages that a model is shown, each with how its sheet writes decimals."""
        return [(text, self.sheets[text.sheet].style) for text in pages_of([s.cells for s in self.sheets])]

    @functools.cached_property
    def matches(self) -> Mapping[str, Sequence[Match]]:
        """How the claims speak of the values that are not read in another one's label."""
        return match(self.claims, [w for w in self.wanted if w.in_label_of is None])

    def specifications(self) -> Specifications:
        """The rules' word alone."""
        values = self.values if self.config else _of_several(self.values, self.sheets)
        return Specifications(values, tuple(self.findings))


def by_rules(template: Template, sheets: Sequence[Sheet], *, config: str = "") -> Ruled:
    """What the rules make of the values that a template asks for."""
    wanted = asked(template)
    sheets = [_numbered(sheet, number) for number, sheet in enumerate(sheets)]
    (printed, recognised), known = _claimed(sheets, config), _known(sheets)
    values, nearby = _decided(wanted, printed, known, config, sheets)
    # Words read from a picture have a say only where no text has, another program's only where those have none.
    values = _with_recognised(wanted, values, recognised, known, config, sheets)
    if any(sheet.again for sheet in sheets):
        again = [sheet.again or sheet for sheet in sheets]
        values = _with_recognised(wanted, values, _claimed(again, config)[1], _known(again), config, again)
    claims = [*printed.claims, *recognised.claims]
    findings = [*unread_pages(sheets), *ignored_phrases(config, claims, known, sheets)]
    return Ruled(sheets, config, wanted, _of_pictures(wanted, values, sheets), nearby, claims, known, findings)


def with_model(
    ruled: Ruled,
    extractor: Extractor,
    model: ModelOptions | None,
    *,
    progress: Callable[[str], None] = lambda words: None,
) -> Specifications:
    """The rules' word with that of a language model on what they leave open ("both"), or the model's alone ("llm")."""
    values, sheets, config = dict(ruled.values), ruled.sheets, ruled.config
    direct = [w for w in ruled.wanted if w.in_label_of is None]
    if extractor == "llm":
        values |= {w.name: missing(w) for w in direct}
    open_ = [w for w in direct if values[w.name].status != "ok"]
    ask = functools.partial(read_pages, open_, direct, ruled.pages, ruled.claims, config=config, progress=progress)
    reading, more = _by_model(ask, model, alone=extractor == "llm")
    for one in open_:
        own = ruled.matches.get(one.name, []) if reading.seen else []
        nearby, name = ruled.nearby.get(one.name), model.model if model else ""
        heard = Asked(one, direct, own, nearby, ruled.known, config, name, ruled.values[one.name])
        seen = reading.seen.get(one.name, [])
        values[one.name] = agreed(heard, values[one.name], reading.found.get(one.name, []), seen)
    values = _of_pictures(ruled.wanted, values, sheets)
    heard_values = values if config else _of_several(values, sheets)
    return Specifications(heard_values, (*ruled.findings, *more))


def _with_recognised(
    wanted: Sequence[Wanted],
    values: Mapping[str, Specification],
    said: _Claimed,
    known: Sheets,
    config: str,
    sheets: Sequence[Sheet],
) -> dict[str, Specification]:
    """The values, those that are missing as pictures of pages say; what these say of the others is theirs."""
    found = dict(values)
    if said.claims or any(near for near, _ in said.near):
        seen, _ = _decided(wanted, said, known, config, sheets)
        found |= {name: one for name, one in seen.items() if values[name].status in ("missing", "unreadable")}
    return _of_pictures(wanted, found, sheets)


def _numbered(sheet: Sheet, number: int) -> Sheet:
    """The sheet with its number among those read together in its statements."""
    return replace(
        sheet,
        statements=with_machines([replace(s, sheet=number) for s in sheet.statements], sheet.titles),
        near=tuple(replace(n, statement=replace(n.statement, sheet=number)) for n in sheet.near),
        again=_numbered(sheet.again, number) if sheet.again else None,
    )


@dataclass(frozen=True)
class _Claimed:
    """What sheets claim of the configuration that is meant; `near`: of each sheet the second reading's values that
    stand in no cell of another configuration, with how it writes decimals."""

    claims: list[Claim] = field(default_factory=list)
    near: list[tuple[Sequence[Near], DecimalStyle]] = field(default_factory=list)


def _claimed(sheets: Sequence[Sheet], config: str) -> tuple[_Claimed, _Claimed]:
    """What the sheets claim in their text, and on pictures of pages."""
    both = _Claimed(), _Claimed()
    for sheet in sheets:
        other = of_others(sheet.titles, config)
        sisters = of_sisters(sheet.titles, config)
        read = [s for s in sheet.statements if s.page not in other and (s.column or s.page not in sisters)]
        every = claims_of(read, sheet.style)
        meant = configured(of_configuration([*every, *in_only_unit(every)], config), config)
        kept = {claim.statement for claim in meant}
        others = [claim.statement for claim in every if claim.statement not in kept]
        other |= sisters
        own = [
            n
            for n in sheet.near
            if n.statement.page not in other and not any(stands_in(n.statement, s) for s in others)
        ]
        own += [Near("cell", statement) for statement in dict.fromkeys(c.statement for c in meant)]
        for is_guess, part in enumerate(both):
            part.claims.extend(c for c in meant if c.statement.guessed == is_guess)
            part.near.append(([n for n in own if n.statement.guessed == is_guess], sheet.style))
    return both


def _known(sheets: Sequence[Sheet]) -> Sheets:
    """The sheets' files, the quantities of each column's cells, the sentences that state a configuration."""
    columns: dict[Column, frozenset[str]] = {}
    for sheet in sheets:
        for one in sheet.statements:
            if one.column:
                place = (one.sheet, one.page, one.column)
                columns[place] = columns.get(place, frozenset()) | quantity_words(one.text, one.unit, sheet.style)
    return Sheets(tuple(s.file for s in sheets), columns, tuple(one for sheet in sheets for one in sheet.stated))


def _by_model(
    ask: Callable[[Endpoint], Reading], model: ModelOptions | None, *, alone: bool
) -> tuple[Reading, list[Finding]]:
    """What the language model points to, and findings of what it cost; `alone`: an endpoint that fails is an error."""
    with Endpoint(model or ModelOptions("")) as endpoint:
        try:
            reading = ask(endpoint)
        except EndpointError as error:
            if alone:
                raise
            return Reading(), [model_failure(error), model_cost(endpoint)]
        return reading, [model_cost(endpoint, reading.refused), *unusable_answers(endpoint, reading.unusable)]


def _of_pictures(
    wanted: Sequence[Wanted], values: Mapping[str, Specification], sheets: Sequence[Sheet]
) -> dict[str, Specification]:
    """The values with those from pictures of pages to review at most, and those that may stand on pages without text
    `unreadable`."""
    pictures: dict[_Seen, str] = {}
    for sheet in sheets:
        read = [*sheet.statements, *(n.statement for n in sheet.near)]
        typed = {(sheet.file, one.page, placed(one)) for one in read if not one.guessed}
        places = ((sheet.file, one.page, placed(one)) for one in read if one.guessed)
        pictures |= {place: sheet.recogniser for place in places if place not in typed}
    silent = [s.file for s in sheets if s.silent and all(one.guessed for one in s.statements)]
    found = dict(values)
    for one in wanted:
        found[one.name] = _at_most_review(found[one.name], pictures)
        if silent and found[one.name].status == "missing":
            found[one.name] = missing(one, "unreadable", f"{', '.join(silent)} has no text that can be read")
    return found


def _decided(
    wanted: Sequence[Wanted], said: _Claimed, known: Sheets, config: str, sheets: Sequence[Sheet]
) -> tuple[dict[str, Specification], dict[str, Nearby]]:
    """Every wanted value by its words, with what the second reading says of it, and what that brought."""
    style: DecimalStyle = sheets[0].style if sheets else "point"
    matches = match(said.claims, [w for w in wanted if w.in_label_of is None])
    values = {
        one.name: decide(one, matches.get(one.name, []), known, config)
        if one.in_label_of is None
        else in_label(one, matches.get(one.in_label_of, []), known, style)
        for one in wanted
    }
    return second_reading(wanted, values, said.near, known, config)


def _of_several(values: Mapping[str, Specification], sheets: Sequence[Sheet]) -> dict[str, Specification]:
    """The values with those of one of several machines, whose sheets are bound in one file, to review."""
    machines = {(sheet.file, page): name for sheet in sheets for page, name in several(sheet.titles).items()}
    found = dict(values)
    for name, value in values.items():
        seen = value.evidence
        machine = machines.get((seen.file, seen.page)) if seen else None
        if value.status == "ok" and machine:
            reason = f"the file is of several machines, and this is of {machine}; {value.reason}"
            hint = f'Name the machine with --config "{machine}".'
            found[name] = replace(value, status="review", reason=reason, hint=hint)
    return found


_Seen = tuple[str, int, tuple[float, ...]]
"""A file, a page of it and a box on the page."""


def _at_most_review(value: Specification, pictures: Mapping[_Seen, str]) -> Specification:
    """A value that was read from one of the pictures is to be looked at."""
    seen = value.evidence
    program = pictures.get((seen.file, seen.page, seen.box or ())) if seen else None
    if value.status != "ok" or seen is None or program is None:
        return value
    return replace(
        value,
        status="review",
        confidence=min(value.confidence, PICTURED),
        reason=f"page {seen.page} is a picture: its text is what {program} makes of it; {value.reason}",
        hint=f'Compare it with the page; settle it with --set "{value.name}=VALUE UNIT".',
    )
