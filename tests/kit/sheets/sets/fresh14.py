"""The sets "fresh14" to "fresh16": the four types that the sets before do not have, in the layouts of "fresh13" and in
words of their own. "fresh14" was read first; "fresh15" has other machines in other wordings and languages, written with
it and read once the words that "fresh14" showed to be lacking were there; "fresh16" has a third machine each, other
layouts and what is left of the languages, in wordings of both, and was read once at the end."""

from __future__ import annotations

from dataclasses import replace

from kit.sheets.sets.fresh13 import STYLES, dealer, leaders, lettered, range_card, sidebar, systems
from kit.sheets.worded import Worded

_STYLES = {**STYLES, "de_m": replace(STYLES["de"], metres=True), "fr_m": replace(STYLES["fr"], metres=True)}
_LAYOUTS = {f.__name__: f for f in (dealer, leaders, lettered, range_card, systems, sidebar)}
FRESH14 = Worded(
    "fresh14",
    "TN",
    _LAYOUTS,
    _STYLES,
    {
        "telehandler": "dealer:en_us leaders:de sidebar:fr",
        "roller": "systems:en_us2 lettered:de dealer:zh",
        "wheeled_excavator": "leaders:en_us range_card:ja lettered:es",
        "mini_excavator": "sidebar:en_us dealer:ja systems:en_us2",
    },
)
FRESH15 = Worded(
    "fresh14",
    "VR",
    _LAYOUTS,
    _STYLES,
    {
        "telehandler": "systems:en_ap lettered:es range_card:en_eu",
        "roller": "leaders:en_eu sidebar:fr range_card:en_ap",
        "wheeled_excavator": "dealer:en_eu lettered:de_m sidebar:en_ap",
        "mini_excavator": "leaders:en_eu range_card:zh lettered:de",
    },
)
FRESH16 = Worded(
    "fresh14",
    "XB",
    _LAYOUTS,
    _STYLES,
    {
        "telehandler": "sidebar:en_us2 dealer:fr_m lettered:en_eu",
        "roller": "dealer:de leaders:fr sidebar:zh",
        "wheeled_excavator": "systems:en_us2 dealer:ja leaders:es",
        "mini_excavator": "lettered:en_ap leaders:ja dealer:zh",
    },
)
