"""What is costly to compute and follows from its inputs alone, kept on disk between runs, by content.

`$YELLOWIRON_CACHE` names the folder, or is `off`; else it is `$XDG_CACHE_HOME/yellowiron`, else `~/.cache/yellowiron`.
It may be deleted at any time, and holds 2 GB at most: what was not used for longest goes. A hit gives the same as a
miss; an entry that cannot be read is made anew, and a folder that cannot be written is done without. So is one that is
another user's, or that others may write to: what it holds is values, read as a guarded child's answers are, of which
nothing is run, but a machine's shapes are not to be a stranger's.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import stat
import sys
import tempfile
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeVar

from yellowiron.support.caching.content import content_of, remember_content, wholes
from yellowiron.support.files import answers

VARIABLE = "YELLOWIRON_CACHE"
FRESH = "YELLOWIRON_FRESH"
"""Set: stages (`kept`) are made anew, and not kept."""
OFF = ("off", "0", "none")
_DIGEST = hashlib.sha256().digest_size
_SUFFIX = ".kept"
_MOST = 2 * 1024**3
"""Bytes of all that is kept."""
_LARGEST = _MOST // 4
"""Bytes of an entry."""
_CHUNK = 1024 * 1024

Answer = TypeVar("Answer")


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


def remember(kind: str, key: str, make: Callable[[], Answer]) -> Answer:
    """The answer of `make`, from the cache where it has one. `key` must stand for everything that it depends on, in
    letters and digits (a digest); `kind` is the folder that entries of one sort lie in. An answer is plain data, arrays
    of numbers, paths and frozen dataclasses of ours."""
    return _remember_each(kind, {"": key}, lambda names: {"": make()})[""]


def kept(kind: str, make: Callable[[], Answer], *given: object, files: Iterable[Path] = ()) -> Answer:
    """The answer of `make`, from the cache where it was made before by this very program, of the same values (`given`)
    and files of the same paths and contents."""
    if not stages_are_kept():
        return make()
    digest = hashlib.sha256(content_of([_program(), *given]))
    for file in files:
        digest.update(f"{file}\0".encode("utf-8", "surrogateescape") + _of_file(file))

    def make_with_contents() -> tuple[Answer, list[bytes]]:
        answer = make()
        return answer, [content_of(whole) for whole in wholes(answer)]

    answer, contents = remember(kind, digest.hexdigest(), make_with_contents)
    # The next stage asks for them.
    for whole, content in zip(wholes(answer), contents, strict=True):
        remember_content(whole, content)
    return answer


def kept_each(
    kind: str, make: Callable[[list[str]], Mapping[str, Answer]], given: Mapping[str, object]
) -> dict[str, Answer]:
    """`kept`, of several answers by name, each of what is `given` for it: `make` is asked for those that are not there
    together."""
    if not stages_are_kept():
        return dict(make(list(given)))
    keys = {name: content_of([_program(), each]).hex() for name, each in given.items()}
    return _remember_each(kind, keys, make)


def stages_are_kept() -> bool:
    """Whether `kept` keeps anything."""
    return not os.environ.get(FRESH) and cache_folder() is not None


def _remember_each(
    kind: str, keys: Mapping[str, str], make: Callable[[list[str]], Mapping[str, Answer]]
) -> dict[str, Answer]:
    folder = cache_folder()
    if folder is None:
        return dict(make(list(keys)))
    places = {name: folder / kind / f"{key}{_SUFFIX}" for name, key in keys.items()}
    found: dict[str, list[Answer]] = {name: _read(place) for name, place in places.items()}
    missing = [name for name, answer in found.items() if not answer]
    if missing:
        made = make(missing)
        for name in missing:
            found[name] = [made[name]]
            _write(places[name], answers.dumps(found[name]))
        _make_room(folder)
    return {name: answer[0] for name, answer in found.items()}


def _of_file(file: Path) -> bytes:
    digest = hashlib.sha256()
    with file.open("rb") as opened:
        while chunk := opened.read(_CHUNK):
            digest.update(chunk)
    return digest.digest()


@functools.cache
def _program() -> str:
    """Stands for all that makes an answer: this package's files, what is installed beside it, Python."""
    digest = hashlib.sha256(sys.version.encode())
    home = Path(__file__).parents[2]
    for file in sorted(home.rglob("*")):
        if file.is_file() and file.suffix != ".pyc":
            digest.update(f"{file.relative_to(home)}\0".encode() + _of_file(file))
    for place in sys.path:
        with contextlib.suppress(OSError):
            digest.update("\n".join(sorted(p.name for p in Path(place or ".").glob("*.dist-info"))).encode())
    return digest.hexdigest()


def _read(path: Path) -> list[Answer]:
    """Nothing where there is no whole entry: its last bytes are the digest of the others."""
    try:
        if not (_is_ours(path.parent) and _is_ours(path)):
            return []
        data = path.read_bytes()
        if hashlib.sha256(memoryview(data)[:-_DIGEST]).digest() != data[-_DIGEST:]:
            return []
    except OSError:
        return []
    with contextlib.suppress(OSError):  # what may only be read is as good
        os.utime(path)
    try:
        found = answers.loads(data)
    except Exception:  # noqa: BLE001 - whole, and no entry of ours: it may break on anything
        return []
    return found if isinstance(found, list) and len(found) == 1 else []


def _write(path: Path, data: bytes) -> None:
    """Beside its place, then renamed into it: nobody reads half an entry. What would fill the cache is not kept."""
    if len(data) > _LARGEST:
        return
    with contextlib.suppress(OSError):
        path.parent.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        path.parent.mkdir(exist_ok=True, mode=0o700)
        handle, name = tempfile.mkstemp(prefix=".new-", dir=path.parent)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
                file.write(hashlib.sha256(data).digest())
            Path(name).replace(path)
        except OSError:
            Path(name).unlink()
            raise


def _make_room(folder: Path) -> None:
    """Removes what was not used for longest, where more is kept than may be."""
    with contextlib.suppress(OSError):
        there = [(file.stat(), file) for file in folder.glob(f"*/*{_SUFFIX}")]
        total = sum(found.st_size for found, _ in there)
        for found, file in sorted(there, key=lambda one: one[0].st_mtime):
            if total <= _MOST:
                return
            file.unlink(missing_ok=True)
            total -= found.st_size
