"""Output that is whole or absent: written beside its place, then renamed into it."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

from yellowiron.model.errors import OutputError

_HINT = "Name a folder that you may write to."


@contextmanager
def output_folder(target: Path) -> Iterator[Path]:
    """A temporary folder whose content replaces `target`'s entries of the same names when the block ends well.

    Other files that a user keeps in `target` stay. If the block raises, `target` is as it was. `OutputError` where
    `target` is a file or cannot be written.
    """
    if target.exists() and not target.is_dir():
        raise OutputError("The output folder is a file", where=str(target), hint=_HINT)
    try:
        parent = target.absolute().parent
        parent.mkdir(parents=True, exist_ok=True)
        if target.exists() and not os.access(target, os.W_OK | os.X_OK):
            raise OutputError("The output folder cannot be written", where=str(target), hint=_HINT)
        temporary = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=parent))
    except OSError as error:
        raise OutputError(
            f"The output folder cannot be made: {error.strerror}", where=str(target), hint=_HINT
        ) from error
    try:
        temporary.chmod(0o755)
        yield temporary
        _refuse_clashes(temporary, target)
        _install(temporary, target)
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


@contextmanager
def output_file(target: Path, *, suffixes: Collection[str] = ()) -> Iterator[Path]:
    """A temporary path of the same name, renamed to `target` when the block ends well. `OutputError` as above, and for
    another suffix than one of `suffixes`."""
    if suffixes and target.suffix.lower() not in suffixes:
        hint = f"Use {', '.join(suffixes)}."
        raise OutputError(
            f"'{target.suffix}' is not among the file extensions written here", where=str(target), hint=hint
        )
    if target.is_dir():
        raise OutputError("The output file is a folder", where=str(target), hint="Name a file.")
    try:
        target.absolute().parent.mkdir(parents=True, exist_ok=True)
        folder = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.absolute().parent))
    except OSError as error:
        raise OutputError(f"The file cannot be written: {error.strerror}", where=str(target), hint=_HINT) from error
    try:
        yield folder / target.name
        (folder / target.name).replace(target)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _refuse_clashes(temporary: Path, target: Path) -> None:
    """`OutputError` before anything is moved, where a file would have to take a folder's place or the reverse."""
    for entry in sorted(temporary.rglob("*")):
        place = target / entry.relative_to(temporary)
        if place.exists() and entry.is_dir() != place.is_dir():
            there, wanted = ("folder", "file") if place.is_dir() else ("file", "folder")
            raise OutputError(
                f"There is a {there} where a {wanted} has to be written",
                where=str(place),
                hint="Move it away, or name another output folder.",
            )


def _install(temporary: Path, target: Path) -> None:
    """Moves a folder's content into its place, file by file where a folder is there already."""
    if not target.exists():
        temporary.rename(target)
        return
    for entry in sorted(temporary.iterdir()):
        place = target / entry.name
        if entry.is_dir() and place.is_dir() and not place.is_symlink():
            _install(entry, place)
        else:
            entry.replace(place)
