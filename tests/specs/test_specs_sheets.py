"""Generated sheets whose every value is known: nothing wrong, what is printed found, what is not printed missing.

Counts of first readings are in docs/extraction.md; these tests keep what was reached after mending.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from sheets import LAYOUTS, Case, Score, Split, cases, make, page_texts, score

from yellowiron.library import load_template
from yellowiron.model.template import Template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.reader import read_sheet


@cache
def template(kind: str) -> Template:
    return load_template(kind)


def read(case: Case, folder: Path) -> Score:
    sheet = make(case, folder)
    found = from_sheets(template(case.kind), [read_sheet(sheet.path)], config=sheet.config)
    return score(sheet, found, page_texts(sheet.path))


def some() -> list[Case]:
    """One sheet of every layout, both types and many styles among them."""
    found = []
    for split in LAYOUTS:
        for number, layout in enumerate(LAYOUTS[split]):
            own = [c for c in cases(split) if c.layout == layout]  # type: ignore[arg-type]
            found.append(own[(5 * number) % len(own)])
    return found


def test_the_sets_share_neither_machine_nor_layout() -> None:
    sets = [cases(split) for split in LAYOUTS]  # type: ignore[arg-type]
    for i, one in enumerate(sets):
        for other in sets[i + 1 :]:
            assert not {(c.kind, c.machine.name) for c in one} & {(c.kind, c.machine.name) for c in other}
            assert not {c.layout for c in one} & {c.layout for c in other}
    assert len({c.style[:2] for c in sets[0]}) == 6
    assert sum(len(own) for own in sets) > 200


def test_one_sheet_of_every_layout(tmp_path: Path) -> None:
    total = Score()
    for case in some():
        total += read(case, tmp_path)
    assert total.wrong == 0 and total.unproven == 0, total.faults
    assert total.on > 600
    assert total.ok >= 0.94 * total.on and total.first >= 0.96 * total.on, total.faults
    assert total.missing >= 0.998 * total.off, total.faults


@pytest.mark.slow
@pytest.mark.parametrize(
    ("split", "ok", "first"), [("tuned", 0.99, 0.99), ("held", 0.99, 0.99), ("final", 0.98, 0.98), ("last", 0.85, 0.89)]
)
def test_every_sheet(split: Split, ok: float, first: float, tmp_path: Path) -> None:
    total = Score()
    for case in cases(split):
        total += read(case, tmp_path)
    assert total.wrong == 0 and total.unproven == 0, total.faults
    assert total.ok >= ok * total.on and total.first >= first * total.on, total.faults
    assert total.missing >= 0.999 * total.off, total.faults
