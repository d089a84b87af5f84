"""Generated sheets with their truths, in sets that share neither machine nor layout, and how they are scored.

`tuned`: what the rules were made on. `held`: read when that was done, then mended for; `final` after it the same way.
`last`: read once, when all that was done. Labels differ too: the tuned sheets print each name's first wording, `held`
and `final` the second and (in English) the third, `last` others again. `fresh` to `fresh13`: all ten types,
each in words of its own.
"""

from __future__ import annotations

import random
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from sheets_fresh import FRESH
from sheets_fresh2 import FRESH2
from sheets_fresh3 import FRESH3
from sheets_fresh4 import FRESH4
from sheets_fresh5 import FRESH5
from sheets_fresh6 import FRESH6
from sheets_fresh7 import FRESH7
from sheets_fresh8 import FRESH8
from sheets_fresh9 import FRESH9
from sheets_fresh10 import FRESH10
from sheets_fresh11 import FRESH11
from sheets_fresh12 import FRESH12
from sheets_fresh13 import FRESH13
from sheets_held import FINAL, HELD
from sheets_last import LAST
from sheets_machines import Machine, machines
from sheets_make import Sheet, Truth, styles
from sheets_tuned import TUNED
from sheets_worded import Worded, Wording

from yellowiron.model.specification import Specification, Specifications

Split = Literal[
    "tuned",
    "held",
    "final",
    "last",
    "fresh",
    "fresh2",
    "fresh3",
    "fresh4",
    "fresh5",
    "fresh6",
    "fresh7",
    "fresh8",
    "fresh9",
    "fresh10",
    "fresh11",
    "fresh12",
    "fresh13",
]
KINDS = ("wheel_loader", "excavator")
LAYOUTS = {"tuned": TUNED, "held": HELD, "final": FINAL, "last": LAST}
WORDED: dict[str, Worded] = {
    "fresh": FRESH,
    "fresh2": FRESH2,
    "fresh3": FRESH3,
    "fresh4": FRESH4,
    "fresh5": FRESH5,
    "fresh6": FRESH6,
    "fresh7": FRESH7,
    "fresh8": FRESH8,
    "fresh9": FRESH9,
    "fresh10": FRESH10,
    "fresh11": FRESH11,
    "fresh12": FRESH12,
    "fresh13": FRESH13,
}
_WORDING = {"tuned": 0, "held": 1, "final": 2, "last": 3}
_SIXTH = {"tuned": (0, 1, 2), "held": (4,), "final": (5,), "last": (3,)}
"""Of every six machines of a type, in the order of `machines`, those of a split."""


@dataclass(frozen=True)
class Case:
    """A sheet to make: `style` is a key of `styles`; `configured`: whether the configuration is given."""

    split: Split
    kind: str
    layout: str
    style: str
    machine: Machine
    configured: bool = True
    seed: int = 0

    @property
    def name(self) -> str:
        """What tells it from the others."""
        return f"{self.kind}-{self.layout}-{self.style}-{self.machine.name}{'' if self.configured else '-any'}"


def cases(split: Split, *, styles_a_layout: int = 5) -> list[Case]:
    """The sheets of a split: every layout of it, for both types, in several styles; machines in turn."""
    if split in WORDED:
        return [Case(split, *drawn) for drawn in WORDED[split].cases()]
    found: list[Case] = []
    names = list(styles(0))
    for kind in KINDS:
        own = [m for i, m in enumerate(machines(kind, 30)) if i % 6 in _SIXTH[split]]
        for number, layout in enumerate(LAYOUTS[split]):
            dice = random.Random(f"{split} {kind} {layout}")
            latin = dice.sample(names[:8], styles_a_layout - 1)
            chosen = [*latin, names[8 + (number + KINDS.index(kind)) % 2]]
            if layout in _ENGLISH:
                chosen = [*dice.sample(names[:2], 2), *(n for n in chosen if n not in names[:2])]
            for index, style in enumerate(chosen):
                machine = own[(number + index) % len(own)]
                found.append(Case(split, kind, layout, style, machine, True, index))
                if layout in _CONFIGURED and index == 0:
                    found.append(Case(split, kind, layout, style, machine, False, index))
    return found


_CONFIGURED = {"matrix", "choices", "models"}
_ENGLISH = {"imperial_first", "stacked", "wrapped", "cards"}
"""Layouts that show most where both systems are printed."""


def make(case: Case, folder: Path) -> Sheet:
    """Typesets a case into `folder`; the drawn sheet has its file and its truth."""
    path = folder / f"{case.split}-{case.name}.pdf"
    if case.split in WORDED:
        own = WORDED[case.split]
        worded = Wording(path, case.machine, own.styles[case.style], case.seed, file=own.file)
        own.layouts[case.layout](worded)
        worded.finish()
        return worded
    style = styles(_WORDING[case.split])[case.style]
    config = ""
    if case.configured and case.layout in _CONFIGURED:
        dice = random.Random(case.name)
        if case.layout == "models":
            config = case.machine.name.upper() + dice.choice(("", "-L", "-XL"))
        else:
            config = dice.choice(case.machine.variants).heads[style.language]
    sheet = Sheet(path, case.machine, style, case.seed, config)
    LAYOUTS[case.split][case.layout](sheet)
    sheet.finish()
    return sheet


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
    """The text of each page (1 = first) as PDFium gives it, without spaces and leaders."""
    import pypdfium2

    document = pypdfium2.PdfDocument(path)
    try:
        return {
            number: _bare(document[number - 1].get_textpage().get_text_range())
            for number in range(1, len(document) + 1)
        }
    finally:
        document.close()


def sheets(split: Split, folder: Path, *, styles_a_layout: int = 5) -> Iterator[tuple[Case, Sheet]]:
    """Makes every sheet of a split."""
    for case in cases(split, styles_a_layout=styles_a_layout):
        yield case, make(case, folder)
