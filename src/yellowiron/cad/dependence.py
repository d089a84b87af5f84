"""Which files say what is read from a CAD file, told without reading it: for what is kept of it between runs."""

from __future__ import annotations

import os
from pathlib import Path

from yellowiron.cad.formats import FORMATS
from yellowiron.cad.recognition import format_of
from yellowiron.support.files.inputs import MEGABYTE

_MOST, _MOST_MB = 1000, 1024
"""Files beside a model, and megabytes of them, that are looked through for a change; all files that are looked at."""
_LOOKED_AT = 20_000


def files_of(source: Path) -> tuple[Path, ...] | None:
    """The CAD file and those in its folder and below that its format could have it refer to. None where that cannot be
    told: for a folder of files, for a format that may refer to files anywhere or that another package reads, and where
    there are too many."""
    known = None if source.is_dir() else format_of(source)
    if known is None or known.anywhere or known not in FORMATS:
        return None
    files, looked_at, size = [source], 0, 0
    if known.beside is None:
        return tuple(files)
    for place, folders, names in os.walk(source.absolute().parent):
        folders.sort()
        looked_at += len(names)
        for name in sorted(names):
            file = Path(place, name)
            if known.beside.search(name.lower()) and file.is_file():
                files.append(file)
                size += file.stat().st_size
        if looked_at > _LOOKED_AT or len(files) > _MOST or size > _MOST_MB * MEGABYTE:
            return None
    return tuple(files)
