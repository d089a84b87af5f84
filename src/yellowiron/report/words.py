"""Values and names as the page words them."""

from __future__ import annotations

import re
from typing import Any

from yellowiron.support.text import display

MINUS = "\N{MINUS SIGN}"
_BETWEEN = re.compile(r"(?<=[a-z])2(?=[a-z])|(?<=\d)_2_(?=[a-z])")
"""What stands between the names of a joint's two bodies."""
_SET = {"-": MINUS, " °": "°", "*": "\N{DOT OPERATOR}", "^2": "²", "^3": "³"}


def shown(value: float | None, unit: str, *, digits: int = 5) -> str:
    """`display`, set as a page sets it: −40.5°, 35000 N⋅m, 4.2 m³."""
    text = display(value, unit, digits=digits)
    for plain, fine in _SET.items():
        text = text.replace(plain, fine)
    return text


def signed(value: float, digits: int, unit: str) -> str:
    """A difference with its sign; none where it rounds to nothing."""
    text = f"{value:+.{digits}f}"
    if float(text) == 0.0:
        text = text[1:]
    return f"{text.replace('-', MINUS)}{unit}"


def spoken(name: str) -> str:
    """`rear_frame` → `rear frame`."""
    return name.replace("_", " ")


def sentence(name: str) -> str:
    """`rear_frame` → `Rear frame`."""
    words = spoken(name)
    return words[:1].upper() + words[1:]


def titled(name: str) -> str:
    """What a joint or actuator is called: `steer_cyl_tube_2` → `Steer cyl tube 2`, and of a joint between two bodies
    `rear_frame2boom_joint` → `Rear frame to boom`, `link_1_2_arm_joint` → `Link 1 to arm`."""
    return sentence(_BETWEEN.sub(" to ", name.removesuffix("_joint")))


def breakable(name: str) -> Any:
    """`rear_frame2front_frame_joint` as HTML that may go on in a new line after each of its words, and nowhere else."""
    from markupsafe import Markup, escape

    return Markup(re.sub(r"(_|(?<=[a-z])(?=2[a-z]))", r"\1<wbr>", str(escape(name))))


def counted(number: int, thing: str, things: str = "") -> str:
    """`1 part`, `2 parts`, `2 masses`."""
    return f"{number} {thing if number == 1 else things or thing + ('es' if thing.endswith('s') else 's')}"
