"""Left and right, front and rear in the names of roles."""

from __future__ import annotations

import re

SIDE = re.compile(r"(?<=_)([lr])(?=_|$)")
"""What says the side in a role's name."""


END = re.compile(r"(?:^|(?<=_))(front|middle|rear)(?=_|$)")
"""What says the end."""


def twin_role(name: str) -> str | None:
    """The mirrored name: `boom_piston_rod_l_pin` → `boom_piston_rod_r_pin`; None without a side."""
    swapped = SIDE.sub(lambda m: "r" if m.group(1) == "l" else "l", name)
    return swapped if swapped != name else None
