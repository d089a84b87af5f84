"""What a person is told of the reading itself: pages without text, configurations that choose nothing, the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from yellowiron.endpoint import Endpoint, EndpointError
from yellowiron.model.finding import Finding
from yellowiron.specs import ocr
from yellowiron.specs.reader import Sheet
from yellowiron.specs.values.claims import Claim
from yellowiron.specs.values.decision import Sheets, unmatched

_INSTALL = 'Install "yellowiron[ocr]" or the program tesseract (tesseract-ocr) to have it read'
_MOST_COLUMNS = 20
"""Columns that a hint names."""


def ignored_phrases(config: str, claims: Sequence[Claim], known: Sheets, sheets: Sequence[Sheet]) -> list[Finding]:
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


def model_cost(endpoint: Endpoint, refused: Mapping[str, int] | None = None) -> Finding:
    """What asking the language model took, and what it pointed to in vain (`refused`: how often, by why)."""
    options = endpoint.options
    turned = "; ".join(f"{why}: {count}" for why, count in sorted((refused or {}).items()))
    return Finding(
        code="SPC004",
        severity="info",
        where=options.url or str(options.replay),
        message=f"The language model {options.model} was asked: {endpoint.usage}"
        + (f"; places turned away: {turned}" if turned else ""),
    )


def unusable_answers(endpoint: Endpoint, count: int) -> list[Finding]:
    """A finding if a language model gave no answer of the shape that it was asked for to `count` questions."""
    if not count:
        return []
    options = endpoint.options
    return [
        Finding(
            code="SPC006",
            severity="warning",
            where=options.url or str(options.replay),
            message=f"The language model {options.model} gave no usable answer to {count} of "
            f"{endpoint.usage.questions} questions: what these pages say is what the rules read there",
            hint="Try a larger model, or one whose server knows JSON schemas.",
        )
    ]


def model_failure(error: EndpointError) -> Finding:
    """An endpoint that failed beside the rules."""
    return Finding(
        code="SPC003",
        severity="warning",
        where=error.where,
        message=f"{error.message}: the rules alone read the sheets",
        hint=error.hint,
    )


def unread_pages(sheets: Sequence[Sheet]) -> list[Finding]:
    """Findings of pages without a text layer, or with part of their text in it: read through text recognition, or
    not at all."""
    findings = []
    for sheet in sheets:
        if sheet.recognised:
            pages = _pages(sheet.recognised)
            findings.append(
                Finding(
                    code="SPC005",
                    severity="info",
                    where=f"{sheet.file}, {pages}",
                    message=f"{sheet.file} has pictures or outlines as text on {pages}, read by {sheet.recogniser}"
                    + (f", then {sheet.again.recogniser}" if sheet.again else ""),
                    hint="Compare the values to review with the pages.",
                )
            )
        if not sheet.silent:
            continue
        pages = _pages(sheet.silent)
        whole = all(one.guessed for one in sheet.statements)
        message = f"{sheet.file} has pictures or outlines as text on {pages}: they could not be read"
        message += f"; {sheet.unrecognised}" if sheet.unrecognised else ""
        installed = "Run it through text recognition (OCR) first" if ocr.programs() else _INSTALL
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
