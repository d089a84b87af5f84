"""What an item's result depends on, as one digest: the bytes of its inputs, its options, the program's version."""

from __future__ import annotations

import hashlib
import json
import os
import stat
from dataclasses import astuple, fields
from pathlib import Path

import yellowiron
from yellowiron.fleet.places import is_remote
from yellowiron.fleet.values import Item
from yellowiron.model.errors import YellowironError

_APART = ("id", "where", "timeout_s", "memory_mb")
"""Fields of an item that its result does not depend on."""
_OPTIONS = tuple(field.name for field in fields(Item) if field.name not in _APART)
_CHUNK = 1 << 20


class Keys:
    """Gives items their keys; of each file it reads the bytes once."""

    def __init__(self) -> None:
        self._known: dict[str, str] = {}
        self._beside: dict[tuple[str, str], str] = {}

    def of(self, item: Item) -> str:
        """The key of an item: hexadecimal digits. A file that is not there counts as that."""
        options = {name: getattr(item, name) for name in _OPTIONS}
        options["variants"] = astuple(item.variants) if item.variants else None
        inputs = {place: self._digest(place) for place in item.inputs}
        own = self._digest(item.type) if "/" in item.type else ""
        inputs[item.cad] += self._linked(item.cad)
        told = json.dumps([yellowiron.__version__, options, inputs, own], sort_keys=True)
        return hashlib.sha256(told.encode(errors="surrogateescape")).hexdigest()

    def _digest(self, place: str) -> str:
        if place not in self._known:
            self._known[place] = _remote(place) if is_remote(place) else _local(place)
        return self._known[place]

    def _linked(self, cad: str) -> str:
        """Of the files beside a model that its format may have it refer to: once for all models of a folder."""
        if is_remote(cad):
            return ""
        folder, _, name = cad.rpartition("/")
        place = (folder, name.rpartition(".")[2].lower())
        if place not in self._beside:
            from yellowiron.cad import files_of

            try:
                files = files_of(Path(cad)) or ()
            except (OSError, YellowironError):  # told when the item runs
                files = ()
            self._beside[place] = "".join(self._digest(str(file)) for file in files[1:])
        return self._beside[place]


def _local(path: str) -> str:
    """Of a file's bytes, or of all files' in a folder with their names; `absent` where there is neither."""
    digest = hashlib.sha256()
    try:
        if stat.S_ISDIR(os.stat(path).st_mode):  # noqa: PTH116 - ten thousand of these are looked at
            for place, folders, names in os.walk(path):
                folders.sort()
                for name in sorted(names):
                    file = Path(place, name)
                    digest.update(str(file.relative_to(path)).encode(errors="surrogateescape") + b"\0")
                    _feed(digest, str(file))
        else:
            _feed(digest, path)
    except (OSError, ValueError):
        return "absent"
    return digest.hexdigest()


def _feed(digest: hashlib._Hash, file: str) -> None:
    if not stat.S_ISREG(os.stat(file).st_mode):  # noqa: PTH116 - a pipe would be waited for
        raise OSError
    with open(file, "rb", buffering=0) as stream:  # noqa: PTH123
        while chunk := stream.read(_CHUNK):
            digest.update(chunk)


def _remote(address: str) -> str:
    """Of what a store says of a file: its own digest or version where it has one, else size and time."""
    import fsspec

    try:
        system, path = fsspec.core.url_to_fs(address)
        told = system.info(path)
    except Exception:  # noqa: BLE001 - it is told when the item runs
        return "absent"
    known = [str(told[name]) for name in ("ETag", "etag", "md5Hash", "VersionId") if told.get(name)]
    return "|".join(known) or f"{told.get('size')} {told.get('mtime') or told.get('LastModified') or ''}"
