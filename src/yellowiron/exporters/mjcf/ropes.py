"""Ropes in MJCF: a block that is free but for the rope that carries it, and the winch that lets this out.

A spatial tendon between the boom's head and the block, back and forth as often as the rope has falls, is as long as the
rope there. It pushes and pulls nothing. What holds the block is a second one, which is not seen: from the block over
the head to the winch, a light body on a slide by the head that comes nearer as it lets out, no longer than it is drawn.
That is a limit, so that the rope goes slack where the block is lifted. The winch's coordinate, force and control are
those of the slide that it stands for: metres and newtons of the hook.
"""

from __future__ import annotations

from collections.abc import Iterable
from xml.etree import ElementTree as ET

import numpy as np

from yellowiron.exporters.mjcf import actuators
from yellowiron.exporters.mjcf.hardness import SOLIMP, SOLREF
from yellowiron.exporters.ropes import Rope
from yellowiron.exporters.values import minus, row, text
from yellowiron.model.mechanism import Body
from yellowiron.support.vectors import triple

_WIDTH = 0.02
"""Metres: how thick a rope is shown."""
_THIN = 1e-2
"""Square metres: of a winch's body, its moments of inertia over its mass."""
_STEEL = "0.3 0.3 0.32 1"
_UNSEEN = "0 0 0 0"


def winch_of(rope: Rope) -> str:
    """The name of its winch's body."""
    return f"{rope.name}.winch"


def put(element: ET.Element, body: Body, hung: Iterable[Rope]) -> None:
    """On a body's element: the ends of the ropes on it, and the winch of a rope that hangs on it."""
    for rope in hung:
        for number, (held, point) in enumerate(rope.ends):
            if held == body.name:
                name, place = f"{rope.slide.name}.{number}", row(minus(point, body.origin))
                ET.SubElement(element, "site", name=name, pos=place, group="4")
        if rope.ends[0][0] == body.name:
            _winch(element, body, rope)


def _winch(element: ET.Element, body: Body, rope: Rope) -> None:
    place = triple(np.subtract(rope.ends[0][1], np.multiply(rope.lead, rope.axis)))
    made = ET.SubElement(element, "body", name=winch_of(rope), pos=row(minus(place, body.origin)), gravcomp="1")
    slide = {"name": rope.slide.name, "type": "slide", "axis": row(rope.axis)}
    if rope.slide.lower is not None and rope.slide.upper is not None:
        slide["range"] = row((rope.slide.lower, rope.slide.upper))
    drive = rope.slide.drive
    ET.SubElement(made, "joint", {**slide, **(actuators.limits(drive) if drive is not None else {})})
    inertia = row((_THIN * rope.winch,) * 3)
    ET.SubElement(made, "inertial", pos="0 0 0", mass=text(rope.winch), diaginertia=inertia)
    ET.SubElement(made, "site", name=winch_of(rope), group="4")


def tendons(section: ET.Element, hung: Iterable[Rope]) -> None:
    """The rope between head and block, by the name of its body, and what the winch holds, `NAME.line`."""
    for rope in hung:
        head, block = (f"{rope.slide.name}.{number}" for number in (0, 1))
        seen = ET.SubElement(section, "spatial", name=rope.name, width=text(0.5 * _WIDTH), rgba=_STEEL)
        for number in range(rope.falls + 1):
            ET.SubElement(seen, "site", site=(head, block)[number % 2])
        most = row((0.0, rope.length + rope.lead))
        hard = {"solreflimit": row(SOLREF), "solimplimit": row(SOLIMP)}
        line = ET.SubElement(section, "spatial", {"name": f"{rope.name}.line", "range": most, "rgba": _UNSEEN, **hard})
        for site in (block, head, winch_of(rope)):
            ET.SubElement(line, "site", site=site)
