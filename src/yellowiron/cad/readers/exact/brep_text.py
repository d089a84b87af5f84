"""What is wrong with the text of a BREP file: on most damage Open CASCADE reads on for ever."""

from __future__ import annotations

import re

_SECTIONS = (
    b"Locations", b"Curve2ds", b"Curves", b"Polygon3D", b"PolygonOnTriangulations", b"Surfaces", b"Triangulations",
    b"TShapes",
)  # fmt: skip
"""Each begins with its name and how many entries it has, of a line or more each."""
_SECTION = re.compile(rb"^(?:%s)[ \t]+(\d+)[ \t]*\r?$" % b"|".join(_SECTIONS), re.MULTILINE)
_KINDS = rb"Ve|Ed|Wi|Fa|Sh|So|CS|Co"
_SHAPE = re.compile(rb"^(?:%s)[ \t]*\r?$" % _KINDS, re.MULTILINE)
_NUMBER = rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_STRANGE = re.compile(
    rb"(?<!\S)(?!(?:%s|\*|p|%s|\d*(?:C[0-3N]|G[12])|%s)(?!\S))\S+" % (_NUMBER, _KINDS, b"|".join(_SECTIONS))
)
"""What is neither a number nor a word of the format."""
_WHOLE = re.compile(rb"\*\s+[-+]\d+\s+\d+[\s\d]*\Z")
"""The last shape's end, and the one that the file is of."""


def fault(data: bytes) -> str:
    """What follows "the shape" in a sentence about the damage of a text; '' for a sound one."""
    start = data.find(b"\nLocations")
    if start < 0:
        return "has no beginning: it is damaged"
    strange = _STRANGE.search(data, start)
    if strange is not None:
        line = data.count(b"\n", 0, strange.start()) + 1
        return f"has something in line {line} that is neither a number nor a word of its format"
    sections = list(_SECTION.finditer(data, start))
    if len(sections) != len(_SECTIONS):
        return "is damaged or cut short: not all of its sections are there"
    ends = [section.start() for section in sections[1:]] + [len(data)]
    for section, end in zip(sections, ends, strict=True):
        if int(section.group(1)) > data.count(b"\n", section.start(), end):
            return f"declares more than it has: {section.group().decode().strip()}"
    if len(_SHAPE.findall(data, sections[-1].end())) != int(sections[-1].group(1)) or not _WHOLE.search(data[-4096:]):
        return "is damaged or cut short: it declares other shapes than it has"
    return ""
