"""How much of a thing a CAD file may say that it has: a few lines that hold each other are billions of parts."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeVar

from yellowiron.model.errors import CadError

_Thing = TypeVar("_Thing")
OCCURRENCES = 200_000
"""Parts, and assemblies of them; machines have some thousand."""
CORNERS = 100_000
"""Of one polygon."""
_HINT = "Export the machine alone, and less of it; or the file is one that is made to fill the memory."


def limited(found: Iterable[_Thing], path: str) -> Iterator[_Thing]:
    """What is found in a file, one by one; `CadError` after more than so many occurrences."""
    for count, one in enumerate(found, start=1):
        require_occurrences(count, path)
        yield one


def require_occurrences(count: int, path: str) -> None:
    """`CadError` for more occurrences than any machine has."""
    if count > OCCURRENCES:
        raise CadError(f"The file places more than {OCCURRENCES} parts", where=path, hint=_HINT)


def require_polygon(corners: int, path: str) -> None:
    """`CadError` for a polygon with more corners than any has."""
    if corners > CORNERS:
        raise CadError(f"A polygon of the file has more than {CORNERS} corners", where=path, hint=_HINT)
