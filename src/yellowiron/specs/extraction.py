"""The values a template asks for, out of specification sheets, by rules and without any network."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from pathlib import Path
from typing import Literal

from yellowiron.model.errors import SheetError
from yellowiron.model.finding import Finding
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template, Wanted
from yellowiron.specs import ocr
from yellowiron.specs.language.numbers import DecimalStyle, decimal_style
from yellowiron.specs.layout.nearest import Near
from yellowiron.specs.llm.agreement import agreed
from yellowiron.specs.llm.endpoint import Endpoint, EndpointError, ModelOptions
from yellowiron.specs.llm.extractor import find
from yellowiron.specs.reader import MEMORY_MB, TIMEOUT_S, Sheet, check_file
from yellowiron.specs.values.claims import Claim, claims_of, configured
from yellowiron.specs.values.cross_check import second_reading, stands_in
from yellowiron.specs.values.decision import Sheets, decide, quantity_words, unmatched, unreadable
from yellowiron.specs.values.matching import match
from yellowiron.specs.values.requested import asked
from yellowiron.specs.values.values_in_labels import in_label
from yellowiron.support.guard import run_guarded

Extractor = Literal["rules", "llm", "both"]
_INSTALL = "Install the program tesseract (tesseract-ocr) to have it read"
_MOST_COLUMNS = 20
"""Columns that a hint names."""


def extract(
    template: Template,
    pdfs: Sequence[Path],
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
    both, where agreement raises confidence and disagreement is a `conflict`; then an endpoint that fails is a finding.
    Each PDF is read in a guarded child process; pages without a text layer are read through the program tesseract
    where it is installed, and their values are `review` at most. `SheetError` for a file that is missing, empty, no
    PDF, truncated, damaged or encrypted; `EndpointError` for a model that is not configured or, where nothing else
    reads, fails.
    """
    return from_sheets(
        template,
        [read(path, progress=progress) for path in pdfs],
        config=config,
        extractor=extractor,
        model=model,
        progress=progress,
    )


def read(path: Path, *, progress: Callable[[str], None] = lambda words: None) -> Sheet:
    """A PDF's statements, read in guarded child processes; `progress` is told each page."""
    path = Path(path)
    check_file(path)
    sheet = run_guarded(
        "yellowiron.specs.reader:read_sheet",
        path.resolve(),
        where=str(path),
        error=SheetError,
        timeout_s=TIMEOUT_S,
        memory_mb=MEMORY_MB,
        progress=progress,
    )
    assert isinstance(sheet, Sheet)
    return _recognised(sheet, path, progress) if sheet.silent and ocr.program() else sheet


def _recognised(sheet: Sheet, path: Path, progress: Callable[[str], None]) -> Sheet:
    """The sheet with what text recognition makes of its silent pages, in a child of its own: a picture that breaks it
    costs no page that has text."""
    try:
        pages: list[ocr.Recognised] = run_guarded(
            "yellowiron.specs.ocr:recognise",
            path.resolve(),
            sheet.silent,
            where=str(path),
            error=SheetError,
            timeout_s=2.0 * ocr.PAGE_TIMEOUT_S,
            memory_mb=MEMORY_MB,
            who="Text recognition",
            progress=progress,
        )
    except SheetError as error:
        return replace(sheet, unrecognised=f"{error.message} ({error.hint})")
    known = {page.number for page in pages}
    return replace(
        sheet,
        statements=(*sheet.statements, *(s for page in pages for s in page.statements)),
        silent=tuple(n for n in sheet.silent if n not in known),
        style=sheet.style if sheet.statements else decimal_style([page.text for page in pages]),
        stated=(*sheet.stated, *(one for page in pages for one in page.stated)),
        recognised=tuple(sorted(known)),
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
    wanted = asked(template)
    claims: list[Claim] = []
    guessed: list[Claim] = []
    files: dict[int, str] = {}
    columns: dict[int, frozenset[str]] = {}
    near: list[tuple[list[Near], DecimalStyle]] = []
    for sheet in sheets:
        every = claims_of(sheet.statements, sheet.style)
        meant = configured(every, config)
        for claim in meant:
            (guessed if claim.statement.page in sheet.recognised else claims).append(claim)
        kept = {id(claim.statement) for claim in meant}
        others = [claim.statement for claim in every if id(claim.statement) not in kept]
        near.append(([n for n in sheet.near if not any(stands_in(n.statement, s) for s in others)], sheet.style))
        files.update((id(s), sheet.file) for s in (*sheet.statements, *(n.statement for n in sheet.near)))
        columns.update(_columns(sheet))
    stated = tuple(one for sheet in sheets for one in sheet.stated)
    known = Sheets(files, columns, stated)
    style = sheets[0].style if sheets else "point"
    values = _by_rules(wanted, claims, known, config, style)
    values = second_reading(wanted, values, near, known, config)
    if guessed:
        # Words read from a picture have a say only where no text has.
        open_ = [w for w in wanted if values[w.name].status == "missing"]
        values |= _by_rules(open_, guessed, known, config, style)
        claims += guessed
    findings = [*_findings(sheets), *_ignored(config, claims, known, sheets)]
    if extractor != "rules":
        with Endpoint(model or ModelOptions("")) as endpoint:
            try:
                pointed = find(wanted, claims, known, endpoint, config=config, style=style, progress=progress)
            except EndpointError as error:
                if extractor == "llm":
                    raise
                findings.append(_unanswered(error))
                pointed = {}
            findings.append(_cost(endpoint))
        both = {w.name: agreed(w, values[w.name], pointed[w.name]) for w in wanted if w.name in pointed}
        values |= pointed if extractor == "llm" else both
    pictures = {(s.file, number) for s in sheets for number in s.recognised}
    silent = [s.file for s in sheets if s.silent and all(one.page in s.recognised for one in s.statements)]
    for one in wanted:
        values[one.name] = _at_most_review(values[one.name], pictures)
        if silent and values[one.name].status == "missing":
            values[one.name] = unreadable(one, silent)
    return Specifications(values, tuple(findings))


def _by_rules(
    wanted: Sequence[Wanted], claims: Sequence[Claim], known: Sheets, config: str, style: DecimalStyle
) -> dict[str, Specification]:
    """Every wanted value by its words."""
    matches = match(claims, [w for w in wanted if w.in_label_of is None])
    values: dict[str, Specification] = {}
    for one in wanted:
        if one.in_label_of is not None:
            values[one.name] = in_label(one, matches.get(one.in_label_of, []), known, style)
        else:
            values[one.name] = decide(one, matches.get(one.name, []), known, config)
    return values


def _at_most_review(value: Specification, pictures: AbstractSet[tuple[str, int]]) -> Specification:
    """A value that was read from one of the pictures (file, page) is to be looked at."""
    seen = value.evidence
    if value.status != "ok" or seen is None or (seen.file, seen.page) not in pictures:
        return value
    return replace(
        value,
        status="review",
        confidence=min(value.confidence, 0.5),
        reason=f"page {seen.page} is a picture: its text is what tesseract makes of it; {value.reason}",
        hint=f'Compare it with the page; settle it with --set "{value.name}=VALUE UNIT".',
    )


def _ignored(config: str, claims: Sequence[Claim], known: Sheets, sheets: Sequence[Sheet]) -> list[Finding]:
    """A finding for every phrase of the configuration that no sheet says, with the columns there are."""
    if not claims:
        return []
    heads = [", ".join(s.column) for sheet in sheets for s in sheet.statements if s.column]
    columns = list(dict.fromkeys(heads))
    named = " | ".join(columns[:_MOST_COLUMNS]) + (" | …" if len(columns) > _MOST_COLUMNS else "")
    return [
        Finding(
            code="SPC002",
            severity="warning",
            where=f"--config {phrase}",
            message=f"No column, heading or label of the sheets says '{phrase}': it chooses nothing",
            hint=f"The columns there are: {named}." if columns else "The sheets have no columns to choose from.",
        )
        for phrase in unmatched(config, claims, known)
    ]


def _cost(endpoint: Endpoint) -> Finding:
    options = endpoint.options
    return Finding(
        code="SPC004",
        severity="info",
        where=options.url or str(options.replay),
        message=f"The language model {options.model} was asked: {endpoint.usage}",
    )


def _unanswered(error: EndpointError) -> Finding:
    return Finding(
        code="SPC003",
        severity="warning",
        where=error.where,
        message=f"{error.message}: the rules alone read the sheets",
        hint=error.hint,
    )


def _columns(sheet: Sheet) -> dict[int, frozenset[str]]:
    """For each statement in a column of a table, by identity: the quantities of that column's cells."""
    words: dict[tuple[int, tuple[str, ...]], set[str]] = {}
    for statement in sheet.statements:
        if statement.column:
            found = words.setdefault((statement.page, statement.column), set())
            found.update(quantity_words(statement.text, statement.unit, sheet.style))
    return {id(s): frozenset(words[s.page, s.column]) for s in sheet.statements if s.column}


def _findings(sheets: Sequence[Sheet]) -> list[Finding]:
    findings = []
    for sheet in sheets:
        if sheet.recognised:
            pages = _pages(sheet.recognised)
            findings.append(
                Finding(
                    code="SPC005",
                    severity="info",
                    where=f"{sheet.file}, {pages}",
                    message=f"{sheet.file} has no text layer on {pages}: read there through tesseract",
                    hint="Compare the values to review with the pages.",
                )
            )
        if not sheet.silent:
            continue
        pages = _pages(sheet.silent)
        whole = all(one.page in sheet.recognised for one in sheet.statements)
        message = f"{sheet.file} has no text layer on {pages}: nothing could be read there"
        message += f"; {sheet.unrecognised}" if sheet.unrecognised else ""
        installed = "Run it through text recognition (OCR) first" if ocr.program() else _INSTALL
        findings.append(
            Finding(
                code="SPC001",
                severity="warning" if whole else "info",
                where=f"{sheet.file}, {pages}",
                message=message,
                hint=f"{installed}, or give the values with --set."
                if whole
                else f"Only if these pages hold specifications: {installed[0].lower()}{installed[1:]}.",
            )
        )
    return findings


def _pages(numbers: Sequence[int]) -> str:
    parts: list[str] = []
    start = previous = numbers[0]
    for number in [*numbers[1:], None]:
        if number is not None and number == previous + 1:
            previous = number
            continue
        parts.append(f"{start}" if start == previous else f"{start}–{previous}")
        if number is not None:
            start = previous = number
    return f"page{'s' if len(numbers) > 1 else ''} {', '.join(parts)}"
