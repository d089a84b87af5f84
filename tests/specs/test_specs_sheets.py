"""Generated sheets whose every value is known: nothing wrong, what is printed found, what is not printed missing.

Counts of first readings are in docs/extraction.md; these tests keep what was reached after mending.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest

from kit.sheets import FURTHER, HELD_BACK, PLAIN, WORDED, Case, Score, cases, make, one_a_layout, page_texts, score
from kit.templates import template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.reader import read_sheet


def read(own: Iterable[Case], folder: Path) -> Score:
    """What became of the values of some sheets."""
    total = Score()
    for case in own:
        sheet = make(case, folder)
        found = from_sheets(template(case.equipment_type), [read_sheet(sheet.path)], config=sheet.config)
        total += score(sheet, found, page_texts(sheet.path))
    return total


def test_the_sets_share_neither_machine_nor_layout() -> None:
    sets = [cases(split) for split in PLAIN]
    for i, one in enumerate(sets):
        for other in sets[i + 1 :]:
            assert not {(c.kind, c.machine.name) for c in one} & {(c.kind, c.machine.name) for c in other}
            assert not {c.layout for c in one} & {c.layout for c in other}
    assert len({c.style[:2] for c in sets[0]}) == 6
    assert sum(len(own) for own in sets) > 200


@pytest.mark.slow
def test_one_sheet_of_every_layout_of_the_plain_sets(tmp_path: Path) -> None:
    total = read((case for split in PLAIN for case in one_a_layout(split)), tmp_path)
    assert total.wrong == 0 and total.unproven == 0, total.faults
    assert total.on > 600
    assert total.ok >= 0.94 * total.on and total.first >= 0.96 * total.on, total.faults
    assert total.missing >= 0.998 * total.off, total.faults


REACHED = {
    "fresh": (0.97, 0.98), "fresh2": (0.98, 0.99), "fresh3": (0.97, 0.98), "fresh4": (0.955, 0.98),
    "fresh5": (0.94, 0.98), "fresh6": (0.96, 0.98), "fresh7": (0.88, 0.93), "fresh8": (0.95, 0.96),
    "fresh9": (0.95, 0.96),
    "fresh10": (0.95, 0.95), "fresh11": (0.97, 0.98), "fresh12": (0.98, 0.98), "fresh13": (0.94, 0.98),
    "fresh14": (0.98, 0.99), "fresh15": (0.95, 0.98), "fresh16": (0.975, 0.99),
}  # fmt: skip
"""Of what is printed, the share that comes back `ok`, and `ok` or first to review: a little under what was reached."""


@pytest.mark.slow
@pytest.mark.parametrize("split", WORDED)
def test_the_held_back_sets_whole_and_one_sheet_of_every_layout_of_the_others(split: str, tmp_path: Path) -> None:
    total = read(cases(split) if split in (*HELD_BACK, *FURTHER) else one_a_layout(split), tmp_path)
    ok, first = REACHED[split]
    assert total.wrong == 0 and total.unproven == 0, total.faults
    assert total.ok >= ok * total.on and total.first >= first * total.on, total.faults
    assert total.off - total.missing <= 1, total.faults
