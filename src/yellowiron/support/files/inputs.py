"""Input files as far as anybody can know them before they are read: that they are files, and not without end."""

from __future__ import annotations

import stat
from pathlib import Path

from yellowiron.model.errors import YellowironError

MEGABYTE = 1024 * 1024


def require_file(path: Path, *, what: str, most: int, error: type[YellowironError] = YellowironError) -> int:
    """Bytes in a regular file. `error` where there is none, where it is a folder, a pipe or a device, which may have
    no end, or has more than `most` bytes; `what` begins the message ("The alignment")."""
    try:
        found = path.stat()
    except OSError as missing:
        # A name that is too long, or a link to itself, is not there either.
        raise error(
            f"{what} cannot be read: {missing.strerror or missing}", where=str(path), hint="Check the path."
        ) from missing
    except ValueError as odd:  # a zero byte
        raise error(f"{what} cannot be read: {odd}", where=repr(str(path)), hint="Check the path.") from odd
    if not stat.S_ISREG(found.st_mode):
        kind = "a folder" if stat.S_ISDIR(found.st_mode) else "a pipe or a device"
        raise error(f"{what} is {kind}, not a file", where=str(path), hint="Name a file on a disk.")
    if found.st_size > most:
        raise error(
            f"{what} has {found.st_size / MEGABYTE:.0f} MB, more than the {most / MEGABYTE:.0f} MB that are read",
            where=str(path),
            hint="Is it the right file?",
        )
    return found.st_size


def read_input(path: Path, *, what: str, most: int, error: type[YellowironError] = YellowironError) -> bytes:
    """What is in a file, as `require_file` wants it; never more than `most` bytes, whatever the file becomes."""
    require_file(path, what=what, most=most, error=error)
    try:
        with path.open("rb") as file:
            return file.read(most)
    except OSError as unread:
        raise error(
            f"{what} cannot be read: {unread.strerror or unread}", where=str(path), hint="Check its permissions."
        ) from unread
