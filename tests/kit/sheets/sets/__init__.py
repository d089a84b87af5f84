"""The sets by name, oldest first. `PLAIN`: layouts over the shared word list; `WORDED`: sets in words of their own."""

from __future__ import annotations

from kit.sheets.sets.fresh import FRESH
from kit.sheets.sets.fresh2 import FRESH2
from kit.sheets.sets.fresh3 import FRESH3
from kit.sheets.sets.fresh4 import FRESH4
from kit.sheets.sets.fresh5 import FRESH5
from kit.sheets.sets.fresh6 import FRESH6
from kit.sheets.sets.fresh7 import FRESH7
from kit.sheets.sets.fresh8 import FRESH8
from kit.sheets.sets.fresh9 import FRESH9
from kit.sheets.sets.fresh10 import FRESH10
from kit.sheets.sets.fresh11 import FRESH11
from kit.sheets.sets.fresh12 import FRESH12
from kit.sheets.sets.fresh13 import FRESH13
from kit.sheets.sets.fresh14 import FRESH14, FRESH15, FRESH16
from kit.sheets.sets.held import FINAL, HELD
from kit.sheets.sets.last import LAST
from kit.sheets.sets.tuned import TUNED
from kit.sheets.worded import Worded

PLAIN = {"tuned": TUNED, "held": HELD, "final": FINAL, "last": LAST}
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
    "fresh14": FRESH14,
    "fresh15": FRESH15,
    "fresh16": FRESH16,
}
