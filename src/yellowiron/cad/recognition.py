"""What a file is, by its content first and its name second."""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from yellowiron.cad import formats, proprietary
from yellowiron.cad.formats import CadFormat, NoReaderError
from yellowiron.model.errors import CadError
from yellowiron.support.files.inputs import MEGABYTE, require_file

_BOM = b"\xef\xbb\xbf"
_HEAD = 65536
_LARGEST = 4096 * MEGABYTE
"""Bytes of a CAD file."""
_UNPACKED, _LARGEST_DIRECTORY = 2048 * MEGABYTE, 64 * MEGABYTE
"""Bytes of all that is in an archive, unpacked, and of its table of contents."""
_DENSEST = 50
"""Times its size that a large archive may unpack to; numbers as text come to 5 to 15."""
_UNPACK = "Split the model, if this is one; else the file is made to fill your disk."
_STEP = next(known for known in formats.FORMATS if known.name == "STEP")


@dataclass(frozen=True)
class _File:
    """What of a file tells its format: its beginning, its suffix in small letters, and the names in small letters of
    what is in it (None unless it is a zip archive that is whole)."""

    path: Path
    head: bytes
    suffix: str
    members: tuple[str, ...] | None


def format_of(path: Path) -> CadFormat:
    """The format that a file has, of those that are read here; `NoReaderError` for one that is known and not read,
    `CadError` for any other: both say what to do.

    The formats of other packages are asked last: what is read without them is read the same with them.
    """
    file = _opened(path)
    if _is(_STEP, file.head.removeprefix(_BOM)) and not _is(_STEP, file.head):
        raise CadError(
            "The STEP file starts with a byte-order mark, which STEP does not have",
            where=str(path),
            hint="Save it again as plain text or UTF-8 without a signature.",
        )
    found = _by_content(formats.FORMATS, file)
    program = None if found else proprietary.by_content(file.head, path, file.members)
    found = found or (None if program else _by_suffix(formats.FORMATS, file))
    if found is not None:
        return found
    others, broken = formats.others()
    found = _by_content(others, file) or _by_suffix(others, file)
    if found is not None:
        return found
    if program is None and b"\x00" in file.head[:4096]:
        program = proprietary.by_suffix(file.suffix)
    besides = "".join(f". {finding.message}" for finding in broken)
    if program is not None:
        words = f"No open reader exists for {program.name}" + (
            f": export to {program.target}" if program.target else ""
        )
        raise NoReaderError(f"{words}{besides}", where=str(path), hint=program.hint)
    if file.suffix in _STEP.suffixes:
        raise CadError(
            "This is not a STEP file, whatever its name says: it does not start with ISO-10303-21",
            where=str(path),
            hint="Export the model as STEP AP214 or AP242.",
        )
    raise CadError(
        f"This is no CAD file that is known here{besides}",
        where=str(path),
        hint="Give a STEP file (AP203, AP214 or AP242: .step, .stp); or IGES, a mesh (.glb, .stl, .obj, …), USD, URDF "
        "or MJCF: docs/cad-files.md lists them all.",
    )


def _opened(path: Path) -> _File:
    """`CadError` for a file that is not there, cannot be opened, or is empty."""
    if path.is_dir():
        raise CadError("This is a folder, not a CAD file", where=str(path), hint="Name the STEP file in it.")
    try:
        if not path.exists():
            raise CadError("There is no such CAD file", where=str(path), hint="Check the path.")
        require_file(path, what="The CAD file", most=_LARGEST, error=CadError)
        with path.open("rb") as file:
            head = file.read(_HEAD)
    except OSError as error:
        raise CadError(
            f"The CAD file cannot be opened: {error.strerror}", where=str(path), hint="Check its permissions."
        ) from error
    if not head:
        raise CadError("The CAD file is empty", where=str(path), hint="Copy or export it again.")
    return _File(path, head, path.suffix.lower(), _members(path) if head.startswith(proprietary.ZIP) else None)


def _members(path: Path) -> tuple[str, ...] | None:
    """The names in an archive, None where it is not whole. `CadError` where it is made to fill memory or disk."""
    try:
        if _directory(path) > _LARGEST_DIRECTORY:
            raise CadError("The archive holds too many files to be a CAD model", where=str(path), hint=_UNPACK)
        with zipfile.ZipFile(path) as archive:
            unpacked = sum(one.file_size for one in archive.infolist())
            most = min(_UNPACKED, max(_UNPACKED // 8, _DENSEST * path.stat().st_size))
            if unpacked > most:
                words = f"The archive unpacks to {unpacked / MEGABYTE:.0f} MB, more than {most / MEGABYTE:.0f} MB"
                raise CadError(words, where=str(path), hint=_UNPACK)
            return tuple(name.lower() for name in archive.namelist())
    except (zipfile.BadZipFile, OSError, NotImplementedError, ValueError):
        return None


def _directory(path: Path) -> int:
    """Bytes of a zip archive's table of contents, as its end says: PKWARE's APPNOTE, 4.3.16."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 65558))
        end = file.read()
    at = end.rfind(b"PK\5\6")
    return int.from_bytes(end[at + 12 : at + 16], "little") if at >= 0 else 0


def _is(known: CadFormat, head: bytes) -> bool:
    return known.content is not None and known.content.match(head) is not None


def _by_content(known: Sequence[CadFormat], file: _File) -> CadFormat | None:
    for one in known:
        if _is(one, file.head) or (one.member is not None and any(map(one.member.search, file.members or ()))):
            return one
    return None


def _by_suffix(known: Sequence[CadFormat], file: _File) -> CadFormat | None:
    """The format whose suffix a file has, unless that is a lie as far as its beginning can tell."""
    for one in known:
        if file.suffix in one.suffixes and (one.plausible is None or one.plausible.match(file.head)):
            return one
    return None
