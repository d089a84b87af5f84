"""What the text of a STEP file (ISO 10303-21) says without a CAD kernel: end, names, declared occurrences."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator
from dataclasses import dataclass

_STRING = rb"(?:'(?:[^']|'')*'|\$)"
_COMMA = rb"\s*,\s*"
_OWN_ID = re.compile(rb"#(\d+)\s*=\s*$")
_ONE_STRING = re.compile(rb"\s*\(\s*(" + _STRING + rb")")
_TWO_STRINGS = re.compile(_ONE_STRING.pattern + _COMMA + rb"(" + _STRING + rb")")
_SHAPED = re.compile(_TWO_STRINGS.pattern + _COMMA + rb"#(\d+)")
_USE = re.compile(_TWO_STRINGS.pattern + _COMMA + _STRING + _COMMA + rb"#(\d+)" + _COMMA + rb"#(\d+)")
_SOLIDS = (b"MANIFOLD_SOLID_BREP", b"BREP_WITH_VOIDS", b"FACETED_BREP")
_SHELLS = (b"CLOSED_SHELL", b"OPEN_SHELL", b"SHELL_BASED_SURFACE_MODEL")
_DEEPEST = 200


@dataclass(frozen=True)
class Part21:
    """Facts of a STEP file's text.

    `names` are the raw bytes of every product, instance and solid name; `occurrences` the number of leaf products
    that the assembly structure declares, expanded from the roots (None if it is cyclic); `documents` the raw names
    of the files it refers to; `complete` whether its sections are closed and its end is marked; `named` whether any
    solid or shell has a name of its own.
    """

    names: tuple[bytes, ...]
    occurrences: int | None
    documents: tuple[bytes, ...]
    complete: bool
    named: bool


def scan(data: bytes) -> Part21:
    """The facts of a STEP file from its bytes."""
    names = [name for _, match in _entities(data, b"PRODUCT", _TWO_STRINGS) for name in match.groups()]
    solids = [match.group(1) for kind in _SOLIDS for _, match in _entities(data, kind, _ONE_STRING)]
    shells = [match.group(1) for kind in _SHELLS for _, match in _entities(data, kind, _ONE_STRING)]
    names += solids
    uses: list[tuple[int, int]] = []
    occurrences: set[int] = set()
    for number, match in _entities(data, b"NEXT_ASSEMBLY_USAGE_OCCURRENCE", _USE):
        names.append(match.group(2))
        occurrences.add(number)
        uses.append((int(match.group(3)), int(match.group(4))))
    shaped = [int(match.group(3)) for _, match in _entities(data, b"PRODUCT_DEFINITION_SHAPE", _SHAPED)]
    return Part21(
        names=tuple(name.strip(b"'") for name in names),
        occurrences=_expand(shaped, uses, occurrences),
        documents=tuple(match.group(1).strip(b"'") for _, match in _entities(data, b"DOCUMENT_FILE", _ONE_STRING)),
        complete=data.rfind(b"END-ISO-10303-21") > data.rfind(b"ENDSEC") > data.rfind(b"DATA;"),
        named=any(len(name.strip(b"'$")) > 0 for name in (*solids, *shells)),
    )


def _entities(data: bytes, keyword: bytes, arguments: re.Pattern[bytes]) -> Iterator[tuple[int, re.Match[bytes]]]:
    """Every instance of an entity: its number, and the match of its arguments. A byte search beats a big pattern."""
    at = data.find(keyword)
    while at >= 0:
        end = at + len(keyword)
        own, match = _OWN_ID.search(data, max(0, at - 40), at), arguments.match(data, end)
        if own and match:
            yield int(own.group(1)), match
        at = data.find(keyword, end)


def _expand(shaped: list[int], uses: list[tuple[int, int]], occurrences: set[int]) -> int | None:
    """Leaf occurrences below the product definitions that nothing uses; one alone counts if it has a shape."""
    children: dict[int, list[int]] = {}
    used: set[int] = set()
    for parent, child in uses:
        children.setdefault(parent, []).append(child)
        used.add(child)

    @functools.cache
    def leaves(definition: int, depth: int = 0) -> int:
        if depth > _DEEPEST:
            raise RecursionError
        below = children.get(definition)
        return 1 if below is None else sum(leaves(child, depth + 1) for child in below)

    # An occurrence has a shape of its own too, which says where it is.
    roots = [d for d in dict.fromkeys([*shaped, *children]) if d not in used and d not in occurrences]
    try:
        return sum(leaves(root) for root in roots) if roots else None
    except RecursionError:
        return None


_REFERENCE = re.compile(rb"#(\d+)(?=\s*[,)])")
_ENTITY = re.compile(rb"(?:^|;|\*/)\s*#(\d+)\s*=")
_NO_NUMBER = re.compile(rb"[(,]\s*[-+]?(?:nan|inf|1\.#)", re.IGNORECASE)
_HUGE = re.compile(rb"[(,]\s*(-?\d+\.\d*E\+?(?:[1-9]\d|\d{3,}))\s*[,)]", re.IGNORECASE)


def diagnose(data: bytes) -> str:
    """What is wrong with a STEP file that broke its reader, as one sentence; empty if nothing is seen. Slow."""
    defined = [int(match.group(1)) for match in _ENTITY.finditer(data)]
    known = set(defined)
    lost = sorted({int(match.group(1)) for match in _REFERENCE.finditer(data)} - known)
    if lost:
        return f"The STEP file is damaged: it refers to {len(lost)} entities that it does not have, such as #{lost[0]}"
    if len(known) < len(defined):
        return f"The STEP file is damaged: {len(defined) - len(known)} of its entity numbers are there twice"
    if _NO_NUMBER.search(data):
        return "The STEP file is damaged: it has coordinates that are not numbers"
    huge = _HUGE.search(data)
    if huge:
        return f"The STEP file is damaged: it has a coordinate of {huge.group(1).decode()}"
    return ""
