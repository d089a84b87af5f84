"""A folder's files replaced all or none: written into a folder inside it, listed, then renamed into their places.

Inside a folder `.yellowiron-…` of the folder that is written to, and so on its file system: `new` holds what is to
come, `old` what it replaces, `files` names both, and `state` says how far it is. A failure puts back what was there;
what a kill between two renames leaves is finished by whoever writes to the folder next (`recover`).
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from yellowiron.support import limits, stopping

_PREFIX = ".yellowiron-"
_COMMIT, _UNDO = "commit", "undo"
_YOUNG, _OLD = 60.0, 86400.0
"""Seconds after which a staging folder without a lock is nobody's; and on a file system without locks."""


@contextmanager
def staging_folder(base: Path) -> Iterator[Path]:
    """A staging folder in `base`, with an empty folder `new` in it; gone when the block ends. `OSError`."""
    recover(base)
    with stopping.shielded():
        holder = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=base))
        try:
            with (holder / "lock").open("w") as lock:
                # Where there are no locks, its age has to do.
                with contextlib.suppress(OSError):
                    limits.lock(lock)
                (holder / "new").mkdir()
                with stopping.exposed():
                    yield holder
        finally:
            shutil.rmtree(holder, ignore_errors=True)


def install(holder: Path, base: Path) -> None:
    """Moves what is in a staging folder's `new` to its place in `base`. `OSError`, after which all is as it was."""
    new = holder / "new"
    entries = sorted(new.rglob("*"))
    files = [str(entry.relative_to(new)) for entry in entries if not entry.is_dir()]
    folders = [name for e in entries if e.is_dir() and not (base / (name := str(e.relative_to(new)))).exists()]
    (holder / "files").write_text(json.dumps([files, folders]), encoding="utf-8")
    try:
        _set_state(holder, _COMMIT)
        for name in files:
            _keep(base / name, holder / "old" / name)
            _move(new / name, base / name)
        for name in folders:
            (base / name).mkdir(exist_ok=True)
    except BaseException:
        undo(holder, base)
        raise


def undo(holder: Path, base: Path) -> None:
    """Puts back what a staging folder's files have replaced, and takes away the others. `OSError`."""
    _set_state(holder, _UNDO)
    files, folders = json.loads((holder / "files").read_text(encoding="utf-8"))
    for name in files:
        old = holder / "old" / name
        if os.path.lexists(old):
            old.replace(base / name)
        elif not os.path.lexists(holder / "new" / name):
            (base / name).unlink(missing_ok=True)
    for name in reversed(folders):
        with contextlib.suppress(OSError):
            (base / name).rmdir()


def recover(base: Path) -> None:
    """Finishes what runs that were killed have begun in a folder, or takes away what they left. What cannot be
    finished stays."""
    for holder in base.glob(f"{_PREFIX}*"):
        with contextlib.suppress(OSError, ValueError), _abandoned(holder) as abandoned:
            if not abandoned:
                continue
            if (holder / _UNDO).exists():
                undo(holder, base)
            elif (holder / _COMMIT).exists():
                files, folders = json.loads((holder / "files").read_text(encoding="utf-8"))
                for name in files:
                    if os.path.lexists(holder / "new" / name):
                        _move(holder / "new" / name, base / name)
                for name in folders:
                    (base / name).mkdir(exist_ok=True)
            shutil.rmtree(holder, ignore_errors=True)


@contextmanager
def _abandoned(holder: Path) -> Iterator[bool]:
    """Whether a staging folder is our user's and no running process's; locked inside."""
    there = holder.lstat()
    if holder.is_symlink() or there.st_uid != os.geteuid():
        yield False
        return
    try:
        lock = (holder / "lock").open("r+")
    except FileNotFoundError:
        yield time.time() - there.st_mtime > _YOUNG
        return
    with lock:
        try:
            free = limits.lock(lock)
        except OSError:
            free = time.time() - there.st_mtime > _OLD
        yield free


def _set_state(holder: Path, state: str) -> None:
    before = holder / _COMMIT
    before.rename(holder / state) if before.exists() else (holder / state).touch()


def _keep(place: Path, old: Path) -> None:
    """A second name for what is at a place, or, where the file system has no such thing, its only one."""
    if not os.path.lexists(place):
        return
    old.parent.mkdir(parents=True, exist_ok=True)
    try:
        os.link(place, old, follow_symlinks=False)
    except OSError:
        place.rename(old)


def _move(new: Path, place: Path) -> None:
    place.parent.mkdir(parents=True, exist_ok=True)
    new.replace(place)
