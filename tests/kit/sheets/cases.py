"""The sheets of each set: which machine, layout and way of writing, and the making of one."""

from __future__ import annotations

import random
from dataclasses import dataclass
from pathlib import Path

from kit.sheets.machines import Machine, machines
from kit.sheets.sets import PLAIN, WORDED
from kit.sheets.typeset import Sheet, styles
from kit.sheets.worded import Wording

KINDS = ("wheel_loader", "excavator")
SETS = (*PLAIN, *WORDED)
HELD_BACK = ("fresh12", "fresh13")
"""The sets that were written last, and for which the least has been mended."""
FURTHER = ("fresh14", "fresh15", "fresh16")
"""The sets of the four types that those before do not have: telehandlers, rollers, wheeled and mini excavators."""
_WORDING = {"tuned": 0, "held": 1, "final": 2, "last": 3}
_SIXTH = {"tuned": (0, 1, 2), "held": (4,), "final": (5,), "last": (3,)}
"""Of every six machines of a type, in the order of `machines`, those of a split."""


@dataclass(frozen=True)
class Case:
    """A sheet to make: `style` is a key of `styles`; `configured`: whether the configuration is given."""

    split: str
    kind: str
    layout: str
    style: str
    machine: Machine
    configured: bool = True
    seed: int = 0

    @property
    def equipment_type(self) -> str:
        """The type it is read as: a mini excavator is an excavator."""
        return {"mini_excavator": "excavator"}.get(self.kind, self.kind)

    @property
    def name(self) -> str:
        """What tells it from the others."""
        return f"{self.kind}-{self.layout}-{self.style}-{self.machine.name}{'' if self.configured else '-any'}"


def cases(split: str, *, styles_a_layout: int = 5) -> list[Case]:
    """The sheets of a split: every layout of it, for both types, in several styles; machines in turn."""
    if split in WORDED:
        return [Case(split, *drawn) for drawn in WORDED[split].cases()]
    found: list[Case] = []
    names = list(styles(0))
    for kind in KINDS:
        own = [m for i, m in enumerate(machines(kind, 30)) if i % 6 in _SIXTH[split]]
        for number, layout in enumerate(PLAIN[split]):
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


def one_a_layout(split: str) -> list[Case]:
    """One sheet of every layout of a set, its types and many of its ways of writing among them."""
    found = []
    layouts = list(WORDED[split].layouts if split in WORDED else PLAIN[split])
    for number, layout in enumerate(layouts):
        own = [case for case in cases(split) if case.layout == layout]
        found.append(own[(5 * number) % len(own)])
    return found


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
    PLAIN[case.split][case.layout](sheet)
    sheet.finish()
    return sheet
