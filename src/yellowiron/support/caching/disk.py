"""What is costly to compute and follows from its inputs alone, kept on disk between runs: arrays, by content.

`$YELLOWIRON_CACHE` names the folder, or is `off`; else it is `$XDG_CACHE_HOME/yellowiron`, else `~/.cache/yellowiron`.
It may be deleted at any time. A hit gives the same arrays as a miss; an entry that cannot be read is made anew, and a
folder that cannot be written is done without. So is one that is another user's, or that others may write to: what it
holds is numbers and texts, nothing that is run or unpickled, but a machine's shapes are not to be a stranger's.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import stat
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

VARIABLE = "YELLOWIRON_CACHE"
OFF = ("off", "0", "none")
_DIGEST = hashlib.sha256().digest_size

Arrays = tuple[NDArray[Any], ...]


def cache_folder() -> Path | None:
    """Where things are kept; None: nowhere. The folder need not exist; others may not write to it."""
    folder = _named()
    return folder if folder is None or _is_ours(folder) else None


def _named() -> Path | None:
    chosen = os.environ.get(VARIABLE, "").strip()
    if chosen.lower() in OFF:
        return None
    if chosen:
        return Path(chosen)
    base = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if base.is_absolute():  # the specification of XDG has others ignored
        return base / "yellowiron"
    try:
        return Path.home() / ".cache" / "yellowiron"
    except RuntimeError:
        return None


def _is_ours(path: Path) -> bool:
    """Whether only this user, and root, can have put there what is at a path, or nothing is there yet."""
    try:
        there = path.stat()
    except FileNotFoundError:
        return True
    except OSError:
        return False
    return there.st_uid in (os.geteuid(), 0) and not there.st_mode & stat.S_IWOTH


def remember(kind: str, key: str, make: Callable[[], Arrays]) -> Arrays:
    """The arrays of `make`, from the cache where it has them. `key` must stand for everything they depend on, in
    letters and digits (a digest); `kind` is the folder that entries of one sort lie in."""
    folder = cache_folder()
    if folder is None:
        return make()
    path = folder / kind / f"{key}.npz"
    found = _read(path)
    if found is None:
        found = make()
        _write(path, found)
    return found


def _read(path: Path) -> Arrays | None:
    """None where there is no whole entry: its last bytes are the digest of the others."""
    try:
        if not (_is_ours(path.parent) and _is_ours(path)):
            return None
        data = path.read_bytes()
    except OSError:
        return None
    if hashlib.sha256(data[:-_DIGEST]).digest() != data[-_DIGEST:]:
        return None
    try:
        with np.load(io.BytesIO(data[:-_DIGEST]), allow_pickle=False) as entry:
            return tuple(entry[f"arr_{number}"] for number in range(len(entry.files)))
    except (ValueError, TypeError, KeyError, EOFError, zipfile.BadZipFile):  # whole, and no entry of ours
        return None


def _write(path: Path, arrays: Arrays) -> None:
    """Beside its place, then renamed into it: nobody reads half an entry."""
    entry = io.BytesIO()
    np.savez(entry, *arrays)
    data = entry.getvalue()
    with contextlib.suppress(OSError):
        path.parent.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        path.parent.mkdir(exist_ok=True, mode=0o700)
        handle, name = tempfile.mkstemp(prefix=".new-", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data + hashlib.sha256(data).digest())
            Path(name).replace(path)
        except OSError:
            Path(name).unlink()
            raise
