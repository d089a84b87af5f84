"""Output that is whole or absent: written inside the folder it goes to, or beside it, then renamed into its place."""

from __future__ import annotations

import contextlib
import errno
import os
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from yellowiron.model.errors import OutputError, YellowironError
from yellowiron.support import limits, stopping
from yellowiron.support.files import staging
from yellowiron.support.text import with_article

_HINT = "Name a folder that you may write to."
_ROOM = "Make room there, or name a folder on another disk."
_SAID = {
    errno.ENOSPC: ("the disk is full", _ROOM),
    errno.EDQUOT: ("your share of the disk is used up", _ROOM),
    errno.EFBIG: ("a file would be larger than this process may write", "Raise the limit (ulimit -f)."),
    errno.EROFS: ("the disk is read-only", _HINT),
    errno.EEXIST: ("a file is in the way", "Name another folder."),
    errno.ENOTDIR: ("a file is in the way", "Name another folder."),
    errno.EIO: ("the disk does not take it", "Name a folder on another disk."),
}
_PROBE = 1024 * 1024
"""Bytes: where so much more can be written, the disk was not full."""


@contextmanager
def output_folder(target: Path) -> Iterator[Path]:
    """A temporary folder whose content replaces `target`'s entries of the same names when the block ends well.

    Other files that a user keeps in `target` stay. If the block raises, `target` is as it was, or not there. A folder
    that is there may be a mount point or a link to another disk. `OutputError` where `target` is a file, a link that
    leads nowhere, or cannot be written, and where the disk does not take what is written.
    """
    place = _folder(target)
    there = place.is_dir()
    with _staging(place if there else place.parent, target) as holder:
        yield holder / "new"
        with _moved(target):
            if there:
                _refuse_clashes(holder / "new", place)
                staging.install(holder, place)
            else:
                (holder / "new").rename(place)


def check_folder(target: Path) -> None:
    """`OutputError` where `output_folder` could not begin; nothing is left behind."""
    place = _folder(target)
    with _staging(place if place.is_dir() else place.parent, target):
        pass


@contextmanager
def output_file(target: Path, *, suffixes: Collection[str] = ()) -> Iterator[Path]:
    """A temporary path of the same name, renamed to `target` when the block ends well, with whatever else is written
    beside it. `OutputError` as above, and for another suffix than one of `suffixes`."""
    if suffixes and target.suffix.lower() not in suffixes:
        hint = f"Use {', '.join(suffixes)}."
        raise OutputError(
            f"'{target.suffix}' is not among the file extensions written here", where=str(target), hint=hint
        )
    place = _real(target)
    if place.is_dir():
        raise OutputError("The output file is a folder", where=str(target), hint="Name a file.")
    if place.exists() and not place.is_file():
        raise OutputError("The output file is a device or a pipe", where=str(target), hint="Name a file.")
    with _staging(place.parent, target) as holder:
        yield holder / "new" / place.name
        with _moved(target):
            _refuse_clashes(holder / "new", place.parent)
            staging.install(holder, place.parent)


def keep_apart(target: Path, inputs: Iterable[Path]) -> None:
    """`OutputError` where an output folder is the one that an input file lies in, or lies inside an input folder:
    a machine's files would be mixed into the user's."""
    place = _real(target)
    for file in inputs:
        given = file.resolve()
        among = place == given.parent if not given.is_dir() else place.is_relative_to(given)
        if among:
            raise OutputError(
                f"The output folder is the one that {file.name or given.name} lies in",
                where=str(target),
                hint=f"Name a folder of its own, {place / 'out'} for one: files would be mixed into yours.",
            )


def _folder(target: Path) -> Path:
    """The path behind all links of a folder that is there, or may be made."""
    place = _real(target)
    if place.exists() and not place.is_dir():
        raise OutputError("The output folder is a file", where=str(target), hint=_HINT)
    if place.is_dir() and not os.access(place, os.W_OK | os.X_OK):
        raise OutputError("The output folder cannot be written", where=str(target), hint=_HINT)
    return place


def _real(target: Path) -> Path:
    """The path behind all links. `OutputError` where a link leads nowhere or to itself."""
    try:
        place = target.resolve()
        if target.is_symlink() and not place.exists():
            raise FileNotFoundError
    except (OSError, RuntimeError) as error:
        raise OutputError(
            "The output is a link that leads nowhere", where=str(target), hint="Remove the link, or name another place."
        ) from error
    return place


@contextmanager
def _staging(base: Path, target: Path) -> Iterator[Path]:
    """A staging folder in `base`, which is made; gone again, as all that was made, if the block raises. `OutputError`
    for what cannot be written: on a disk that is full a library may say something else, or nothing of use."""
    missing = [one for one in (base, *base.parents) if not one.exists()]
    with stopping.shielded(), contextlib.ExitStack() as stack:
        stack.callback(_remove, missing)
        try:
            base.mkdir(parents=True, exist_ok=True)
            holder = stack.enter_context(staging.staging_folder(base))
        except OSError as error:
            raise _said(error, target) from error
        try:
            with stopping.exposed():
                yield holder
        except Exception as error:
            cause = _cause(error, holder)
            if cause is None:
                raise
            raise _said(cause, target) from error


@contextmanager
def _moved(target: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise _said(error, target) from error


def _remove(folders: Iterable[Path]) -> None:
    """Removes those of some folders, the innermost first, that are empty."""
    for folder in folders:
        with contextlib.suppress(OSError):
            folder.rmdir()


def _cause(error: Exception, holder: Path) -> OSError | None:
    """What kept a file from being written, where that is why something failed."""
    if isinstance(error, OSError):
        ours = str(holder.parent) in f"{error.filename} {error.filename2}"
        return error if ours or error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG) else None
    if isinstance(error, YellowironError) and str(holder) not in error.where:
        return None
    largest = limits.largest_file()
    if any(file.is_file() and file.stat().st_size >= largest for file in (holder / "new").rglob("*")):
        return OSError(errno.EFBIG, os.strerror(errno.EFBIG))
    try:
        (holder / "probe").write_bytes(bytes(_PROBE))
    except OSError as full:
        return full
    return None


def _said(error: OSError, target: Path) -> OutputError:
    reason, hint = _SAID.get(error.errno or 0, (error.strerror or str(error), _HINT))
    return OutputError(f"The output cannot be written: {reason}", where=str(target), hint=hint)


def _refuse_clashes(temporary: Path, target: Path) -> None:
    """`OutputError` before anything is moved, where a file would have to take a folder's place or the reverse, or a
    folder that of a link."""
    for entry in sorted(temporary.rglob("*")):
        place = target / entry.relative_to(temporary)
        if entry.is_dir() and place.is_symlink():
            there, wanted = "link", "folder"
        elif place.exists() and entry.is_dir() != place.is_dir():
            there, wanted = ("folder", "file") if place.is_dir() else ("file", "folder")
        else:
            continue
        raise OutputError(
            f"There is {with_article(there)} where {with_article(wanted)} has to be written",
            where=str(place),
            hint="Move it away, or name another output folder.",
        )
