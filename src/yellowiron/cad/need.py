"""How much memory the reader of a sound CAD file may need, before it is read: so many times its bytes, by its format
(`CadFormat.memory`). Archives count unpacked, and with a file those that it names."""

from __future__ import annotations

import itertools
import os
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

from yellowiron.cad.formats import CadFormat
from yellowiron.cad.recognition import format_of
from yellowiron.model.errors import CadError
from yellowiron.support.files.inputs import MEGABYTE

_LOOKED_AT = 5000
"""Files of a folder."""
_LARGEST_TEXT = 64 * MEGABYTE
"""Bytes of a file that are looked through for the names of others."""
_PACKED = re.compile(rb"KHR_draco_mesh_compression|(?:EXT|KHR|MESHOPT)_meshopt_compression")
_PACKING = 8
"""Times that the triangles of a glTF file are smaller when they are compressed."""


def need_mb(source: Path, known: CadFormat | None) -> int:
    """Megabytes that reading a file of a known format, or a folder (None) of any, may take beside the libraries."""
    if known is not None:
        return 1 + int(_need(source, known)) // MEGABYTE
    total = 0.0
    for file in itertools.islice(_below(source), _LOOKED_AT):
        try:
            one = format_of(file)
        except (CadError, OSError):
            continue
        total += one.memory * _unpacked(file)
    return 1 + int(total) // MEGABYTE


def _need(file: Path, known: CadFormat) -> float:
    size = float(_unpacked(file))
    if known.others:
        with file.open("rb") as opened:
            text = opened.read(_LARGEST_TEXT)
        size += sum(_named(file, text, known.others))
        size *= _PACKING if _PACKED.search(text) else 1
    return known.memory * size


def _unpacked(file: Path) -> int:
    """Bytes of a file, or of all that is in an archive: `format_of` has seen that these are not too many."""
    try:
        with zipfile.ZipFile(file) as archive:
            return sum(one.file_size for one in archive.infolist())
    except (zipfile.BadZipFile, OSError, NotImplementedError, ValueError):
        return file.stat().st_size


def _named(file: Path, text: bytes, others: re.Pattern[str]) -> Iterator[int]:
    """Bytes of the files near one that its text names; a binary one may name any of them."""
    folder = file.absolute().parent
    near = itertools.chain(*(itertools.islice(_below(place), _LOOKED_AT) for place in (folder, folder.parent)))
    for one in sorted(set(near) - {file.absolute()}):
        if others.search(one.name.lower()) and (b"\0" in text[:64] or os.fsencode(one.name) in text):
            yield one.stat().st_size


def _below(folder: Path) -> Iterator[Path]:
    for place, _, names in os.walk(folder):
        for name in names:
            if (one := Path(place, name)).is_file():
                yield one
