"""Specification sheets: PDF → layout statements → the values a template asks for, each with its evidence.

`extract` reads sheets by rules, without any network, or with a language model that the user names; `parse_settings`
takes values a person gives, `accept` their word for values to review; `merge` decides between sources; `columns_of`
names the columns that a configuration may choose among; `draw_evidence` shows on pictures of the pages where each value
stands; `missing_values` says what a person can still give.

In: paths of PDFs and a `Template`; out: `Specifications`. `pages` (what is drawn) and `language` (what words and
numbers mean) ← `layout` (statements) ← `values` (claims, matches, decisions) ← `llm`; `reader` and `ocr` read a PDF's
pages in a guarded child process, `extraction` goes the whole way and `findings` tells of it, `evidence_images` draws.
"""

from __future__ import annotations

# Imported on first use: a reader's child process needs neither numpy nor what decides.
from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.specs.columns import columns_of
    from yellowiron.specs.evidence_images import PICTURE_MARGIN, PICTURE_SCALE, draw_evidence, page_pictures
    from yellowiron.specs.extraction import Extractor, extract, from_sheets, read
    from yellowiron.specs.ocr import picture_programs
    from yellowiron.specs.reader import Sheet, check_file
    from yellowiron.specs.values.overrides import accept, merge, parse_settings, split_settings
    from yellowiron.specs.values.requested import missing_values

__all__ = [
    "PICTURE_MARGIN",
    "PICTURE_SCALE",
    "Extractor",
    "Sheet",
    "accept",
    "check_file",
    "columns_of",
    "draw_evidence",
    "extract",
    "from_sheets",
    "merge",
    "missing_values",
    "page_pictures",
    "parse_settings",
    "picture_programs",
    "read",
    "split_settings",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Extractor": "extraction",
        "PICTURE_MARGIN": "evidence_images",
        "PICTURE_SCALE": "evidence_images",
        "Sheet": "reader",
        "accept": "values.overrides",
        "check_file": "reader",
        "columns_of": "columns",
        "draw_evidence": "evidence_images",
        "extract": "extraction",
        "from_sheets": "extraction",
        "merge": "values.overrides",
        "missing_values": "values.requested",
        "page_pictures": "evidence_images",
        "parse_settings": "values.overrides",
        "picture_programs": "ocr",
        "read": "extraction",
        "split_settings": "values.overrides",
    },
)
