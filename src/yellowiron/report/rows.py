"""Counted rows (`track_shoe_l_1`, `track_shoe_l_2`, …) read as one thing: nobody reads forty-nine equal lines."""

from __future__ import annotations

import re
from collections.abc import Sequence

LEAST = 4
"""Members of which a row is one thing."""
_NUMBER = re.compile(r"_\d+$")


def row_of(name: str) -> str:
    """The name without the number that counts it."""
    return _NUMBER.sub("", name)


def in_rows(names: Sequence[str]) -> dict[str, list[int]]:
    """Name → places of what it stands for, in the order of first places: rows of at least `LEAST` members under the
    row's name, all else under its own."""
    rows: dict[str, list[int]] = {}
    for place, name in enumerate(names):
        rows.setdefault(row_of(name) if name != row_of(name) else name, []).append(place)
    found: dict[str, list[int]] = {}
    for row, places in rows.items():
        counted = len(places) >= LEAST and all(names[place] != row for place in places)
        if counted:
            found[row] = places
        else:
            found.update({names[place]: [place] for place in places})
    return dict(sorted(found.items(), key=lambda entry: entry[1][0]))
