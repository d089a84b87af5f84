"""Generated specification sheets whose every value is known, and how a reading of them is scored.

A *set* is machines, layouts, ways of writing and words that no other set has. Each was written before the extractor was
read with it (*held back*), read once (the counts of first readings are in docs/extraction.md) and then mended for, so
that it is a test like any other from then on. `tuned` is what the first rules were made on; `held`, `final` and `last`
share its word list (`words/words.txt`, each with other wordings of it) and are about wheel loaders and excavators;
`fresh` to `fresh13` have all ten types, each in words of its own (`words/<set>.txt`); `FURTHER` have the four others.
The tests read the newest sets, `HELD_BACK`, and `FURTHER`, whole, and of every other one sheet a layout
(`one_a_layout`); `benchmarks/bench_extract.py` reads all.

A new set: a module in `sets` with its layouts (functions that draw a `Wording`), `STYLES` and a `Worded`; a file of its
words (the heads of the last ones say how it is written); an entry in `sets/__init__.py`; then `HELD_BACK` moves on. It
is written without a look at the rules or the templates, and its first reading goes into docs/extraction.md unmended.
Start from `sets/rows.py`, which has what the newest sets draw their rows with.

In order: `machines` (values) → `typeset` (a page) → `worded` (a set in its own words) → `sets` → `cases` → `scoring`.
"""

from kit.sheets.cases import FURTHER, HELD_BACK, SETS, Case, cases, make, one_a_layout
from kit.sheets.scoring import Score, page_texts, score
from kit.sheets.sets import PLAIN, WORDED

__all__ = [
    "FURTHER", "HELD_BACK", "PLAIN", "SETS", "WORDED", "Case", "Score", "cases", "make", "one_a_layout", "page_texts",
    "score",
]  # fmt: skip
