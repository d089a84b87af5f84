"""Where inputs and results are: a folder here, or anywhere that fsspec reaches (`s3://…`).

A `Store` keeps results so that each is whole or absent. A folder of this machine is renamed into its place; elsewhere,
where nothing can be renamed, a folder is whole once its `MARK`, written last, is there.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Protocol

from yellowiron.model.errors import OutputError, YellowironError
from yellowiron.support.files.inputs import MEGABYTE, read_input

MARK = "item.json"
"""The file of a result's folder that is there once the folder is whole."""
_HINT = "pip install 'yellowiron[fleet]', which brings fsspec and s3fs."

__all__ = ["MARK", "MEGABYTE", "Store", "fetched", "is_remote", "joined", "read_address", "store_at"]


def is_remote(address: str) -> bool:
    """Whether an address is of another place than this machine's folders."""
    return "://" in address


def joined(base: str, name: str) -> str:
    """An address that a document in the folder `base` names: as it is where it is whole, else below `base`."""
    if is_remote(name) or (is_remote(base) and name.startswith("/")):
        return name
    if is_remote(base):
        return f"{base.rstrip('/')}/{name}"
    return os.path.normpath(os.path.join(base, os.path.expanduser(name)))  # noqa: PTH111, PTH118 - texts of a manifest


def read_address(address: str, *, what: str, most: int) -> bytes:
    """The bytes of a file, here or elsewhere; `YellowironError` where it cannot be read, or has more than `most`."""
    if not is_remote(address):
        return read_input(Path(address), what=what, most=most)
    with _said(address, what):
        system, path = _system(address)
        if system.size(path) > most:
            raise YellowironError(f"{what} is larger than is read", where=address, hint="Is it the right file?")
        content: bytes = system.cat_file(path)
    return content


def fetched(address: str, folder: Path) -> Path:
    """A file of elsewhere as one in a folder here, of the same name; a folder with all that is in it."""
    with _said(address, "The input"):
        system, path = _system(address)
        target = folder / path.rstrip("/").rpartition("/")[2]
        folder.mkdir(parents=True, exist_ok=True)
        if not system.exists(path):
            raise YellowironError("The input cannot be read: there is no such file", where=address, hint="Check it.")
        system.get(path, str(target), recursive=bool(system.isdir(path)))
    return target


def staged(name: str) -> str:
    """What an item's folder is called in `staging` while this process makes it."""
    return f"{name}.{os.getpid()}"


def _at_work(process: str) -> bool:
    """Whether a process, by its number, is another one that still runs."""
    return process != str(os.getpid()) and process.isdecimal() and Path("/proc", process).exists()


class Store(Protocol):
    """A folder of results, by names with slashes below it."""

    address: str

    def read(self, name: str) -> bytes | None:
        """A file's content, None where there is none."""

    def read_all(self, names: Iterable[str]) -> dict[str, bytes]:
        """The content of those of some files that are there."""

    def write(self, name: str, content: bytes) -> None:
        """Writes a file, whole or not at all. `OutputError` where it cannot."""

    def install(self, folder: Path, name: str) -> None:
        """Puts a folder of this machine, with its `MARK`, into its place, whole; what was there goes. `OutputError`."""

    def staging(self) -> Path:
        """A folder of this machine in which results are made."""

    def clear(self, names: Iterable[str]) -> None:
        """Takes away what runs that are over have left: what was `staged` of those names, and half-written files."""


def store_at(address: str | Path) -> Store:
    """The store in a folder, or at an address that fsspec reaches. `OutputError` where it cannot be written."""
    return _Remote(str(address)) if is_remote(str(address)) else _Local(Path(address))


class _Local:
    def __init__(self, folder: Path) -> None:
        self.folder = folder.resolve()
        self.address = str(self.folder)
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            if not os.access(self.folder, os.W_OK | os.X_OK):
                raise PermissionError(13, "it may not be written to")
        except OSError as error:
            raise self._unwritten(error) from error

    def _unwritten(self, error: OSError) -> OutputError:
        said = error.strerror or str(error)
        return OutputError(f"The output cannot be written: {said}", where=self.address, hint="Name another folder.")

    def read(self, name: str) -> bytes | None:
        try:
            with open(f"{self.address}/{name}", "rb", buffering=0) as file:  # noqa: PTH123 - thousands are looked for
                return file.read()
        except OSError:
            return None

    def read_all(self, names: Iterable[str]) -> dict[str, bytes]:
        return {name: content for name in names if (content := self.read(name)) is not None}

    def write(self, name: str, content: bytes) -> None:
        place = self.folder / name
        part = place.with_name(f".{place.name}.{os.getpid()}.part")
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            part.write_bytes(content)
            part.replace(place)
        except OSError as error:
            part.unlink(missing_ok=True)
            raise self._unwritten(error) from error

    def install(self, folder: Path, name: str) -> None:
        place = self.folder / name
        old = folder.with_name(f"{folder.name}.old")
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.rmtree(old, ignore_errors=True)
            if place.exists():
                # Between these two a kill leaves it absent, never half.
                place.rename(old)
            folder.rename(place)
            shutil.rmtree(old, ignore_errors=True)
        except OSError as error:
            raise self._unwritten(error) from error

    def staging(self) -> Path:
        return self.folder / ".staging"

    def clear(self, names: Iterable[str]) -> None:
        known = set(names)
        for left in self.staging().glob("*"):
            name, _, writer = left.name.rpartition(".")
            if name in known and not _at_work(writer):
                shutil.rmtree(left, ignore_errors=True)
        with contextlib.suppress(OSError):
            self.staging().rmdir()
        for part in self.folder.glob(".*.part"):
            if not _at_work(part.name.split(".")[-2]):
                part.unlink(missing_ok=True)


class _Remote:
    def __init__(self, address: str) -> None:
        self.address = address.rstrip("/")
        with _said(self.address, "The output", kind=OutputError):
            self._files, self._root = _system(self.address)
        self._staging = Path(tempfile.mkdtemp(prefix="yellowiron-fleet-"))

    def read(self, name: str) -> bytes | None:
        return self.read_all([name]).get(name)

    def read_all(self, names: Iterable[str]) -> dict[str, bytes]:
        paths = {f"{self._root}/{name}": name for name in names}
        if not paths:
            return {}
        self._files.invalidate_cache()
        found = self._files.cat(list(paths), on_error="omit")
        return {paths[_key(path, paths)]: content for path, content in found.items()}

    def write(self, name: str, content: bytes) -> None:
        with _said(f"{self.address}/{name}", "The output", kind=OutputError):
            self._files.makedirs(f"{self._root}/{name}".rpartition("/")[0], exist_ok=True)
            self._files.pipe_file(f"{self._root}/{name}", content)

    def install(self, folder: Path, name: str) -> None:
        place = f"{self._root}/{name}"
        with _said(f"{self.address}/{name}", "The output", kind=OutputError):
            self._files.invalidate_cache()
            if self._files.exists(f"{place}/{MARK}"):
                self._files.rm(f"{place}/{MARK}")
            if self._files.exists(place):
                self._files.rm(place, recursive=True)
            files = sorted(file for file in folder.rglob("*") if file.is_file())
            for file in sorted(files, key=lambda f: (f.name == MARK and f.parent == folder, str(f))):
                below = f"{place}/{file.relative_to(folder).as_posix()}"
                self._files.makedirs(below.rpartition("/")[0], exist_ok=True)
                self._files.put_file(str(file), below)
        shutil.rmtree(folder, ignore_errors=True)

    def staging(self) -> Path:
        return self._staging

    def clear(self, names: Iterable[str]) -> None:
        del names  # what is made here is in a folder of this run's own


def _key(path: str, known: Iterable[str]) -> str:
    """A path as it was asked for: some file systems answer with more or fewer slashes before it."""
    return next(each for each in known if each.strip("/") == path.strip("/"))


def _system(address: str) -> tuple[Any, str]:
    """The file system of an address, and the path there."""
    import fsspec

    system, path = fsspec.core.url_to_fs(address)
    return system, str(path)


@contextlib.contextmanager
def _said(address: str, what: str, kind: type[YellowironError] = YellowironError) -> Any:
    """Whatever fsspec and what is behind it throw becomes one sentence."""
    try:
        yield
    except YellowironError:
        raise
    except ImportError as error:
        raise kind(f"{what} is at an address, and fsspec is not installed for it", where=address, hint=_HINT) from error
    except Exception as error:
        said = " ".join(f"{type(error).__name__}: {error}".split())[:300]
        raise kind(
            f"{what} cannot be reached: {said}", where=address, hint="Check the address and the keys."
        ) from error
