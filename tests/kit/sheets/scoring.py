"""What became of the values that a generated sheet's template asks for."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from kit.sheets.typeset import Sheet, Truth
from yellowiron.model.specification import Specification, Specifications


@dataclass
class Score:
    """What became of the asked values. `faults` say each one that is not as it should be."""

    on: int = 0
    ok: int = 0
    first: int = 0
    wrong: int = 0
    off: int = 0
    missing: int = 0
    unproven: int = 0
    statuses: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)

    def __add__(self, other: Score) -> Score:
        return Score(*(getattr(self, n) + getattr(other, n) for n in _COUNTS), self.statuses + other.statuses,
                     self.faults + other.faults)  # fmt: skip


_COUNTS = ("on", "ok", "first", "wrong", "off", "missing", "unproven")


def is_right(truth: Truth, value: float | None) -> bool:
    """Whether a value is the printed one."""
    return value is not None and abs(value - truth.value) <= truth.slack + 1e-12


def score(sheet: Sheet, found: Specifications, pages: dict[int, str]) -> Score:
    """Counts what was found; `pages` are the texts of the sheet's pages by number, without spaces."""
    result = Score()
    where = sheet.path.stem
    for name, value in found.values.items():
        truth = sheet.truth.get(name)
        if value.status == "ok" and not proven(value, pages):
            result.unproven += 1
            result.faults.append(f"UNPROVEN {where} {name}: {value.evidence}")
        if name in sheet.unsettled:
            if value.status == "ok":
                result.wrong += 1
                result.faults.append(f"WRONG (picked) {where} {name}: {value.value} {value.reason}")
            continue
        if name in sheet.allowed:
            right = is_right(sheet.allowed[name], value.value)
            result.wrong += value.status == "ok" and not right
            if value.status == "ok" and not right:
                result.faults.append(f"WRONG {where} {name}: {value.value} {value.reason} {_quote(value)}")
            continue
        if truth is None:
            result.off += 1
            result.missing += value.status == "missing"
            result.wrong += value.status == "ok"
            if value.status != "missing":
                mark = "WRONG (absent)" if value.status == "ok" else "SEEN"
                result.faults.append(
                    f"{mark} {where} {name}: {value.status} {value.value} {value.reason} {_quote(value)}"
                )
            continue
        result.on += 1
        result.statuses[value.status] += 1
        right = is_right(truth, value.value)
        if value.status == "ok":
            result.ok += right
            result.wrong += not right
        candidate = value.value if value.value is not None or not value.candidates else value.candidates[0].value
        result.first += value.status in ("ok", "review") and is_right(truth, candidate)
        if value.status != "ok" or not right:
            mark = "WRONG" if value.status == "ok" else value.status.upper()
            result.faults.append(
                f"{mark} {where} {name}: {value.value} not {truth.value:g}; {value.reason} {_quote(value)}"
                + ("; ".join(f" [{c.value} {c.configuration} {c.reason}]" for c in value.candidates[:3]))
            )
    return result


def _quote(value: Specification) -> str:
    return f"“{value.evidence.quote}”" if value.evidence else ""


def proven(value: Specification, pages: dict[int, str]) -> bool:
    """Whether a value has page, box and a quote each piece of which stands on that page."""
    evidence = value.evidence
    if evidence is None or evidence.box is None or evidence.page not in pages or not evidence.quote:
        return False
    text = pages[evidence.page]
    return all(_bare(part) in text for part in evidence.quote.split(" … "))


def _bare(text: str) -> str:
    return re.sub(r"\.(?!\d)|(?<!\d)\.|_", "", "".join(text.split()))


def page_texts(path: Path) -> dict[int, str]:
    """The text of each page (1 = first), without spaces and leaders: as PDFium gives it in the file's order, then line
    by line as pdfplumber finds it on the page."""
    import pdfplumber
    import pypdfium2

    document = pypdfium2.PdfDocument(path)
    try:
        texts = [document[index].get_textpage().get_text_range() for index in range(len(document))]
    finally:
        document.close()
    with pdfplumber.open(path) as plumbed:
        lines = [page.extract_text() for page in plumbed.pages]
    return {
        number: "\n".join([_bare(text), *map(_bare, lined.splitlines())])
        for number, (text, lined) in enumerate(zip(texts, lines, strict=True), start=1)
    }
