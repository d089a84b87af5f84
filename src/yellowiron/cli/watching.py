"""Builds again when an input changes: files are looked at twice a second."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

_LOOK_S, _STILL_S = 0.5, 0.4
"""Between two looks; a file that is being written is waited for."""

Stamps = Mapping[Path, tuple[int, int]]


def stamps(files: Iterable[Path]) -> dict[Path, tuple[int, int]]:
    """When each file was changed last (nanoseconds since 1970) and its size, those in a folder too; a file that is not
    there has none."""
    found = {}
    for file in files:
        for one in sorted(file.rglob("*")) if file.is_dir() else [file]:
            try:
                there = one.stat()
            except OSError:
                continue
            found[one] = (there.st_mtime_ns, there.st_size)
    return found


def wait_for_change(files: Sequence[Path], before: Stamps) -> list[Path]:
    """The files that are new, gone or changed, as soon as some are and have been left alone for a moment."""
    while True:
        now = stamps(files)
        if now != before:
            time.sleep(_STILL_S)
            if stamps(files) == now:
                return sorted({path for path, _ in {*now.items()} ^ {*before.items()}})
        time.sleep(_LOOK_S)
