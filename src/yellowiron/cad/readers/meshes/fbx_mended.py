"""What the library refuses a whole FBX file for: names that are no UTF-8, as exporters of other languages write them,
and polygons of two corners or one, the loose edges and points of a modelling tool."""

from __future__ import annotations

import re
import string
import struct
import zlib

import numpy as np

from yellowiron.cad.naming import decode_name, decode_text, sniff_encoding

_TEXT = re.compile(rb"([Ff]ile[Nn]ame|XRefUrlS\0\0\0\0)?S(?=(.{4}))", re.DOTALL)
"""Where a text may begin in a binary file, after what says that it is a picture's name; then its length."""
_NAME = re.compile(rb"([^\0]+)\0\x01\w+")
"""The name of an object, and its class."""
_LONGEST = 1000
_SAID = re.compile(rb'"([^"\n]*)"')
_BINARY = b"Kaydara FBX Binary"
_LETTERS = (string.ascii_letters + string.digits).encode()
_STANDS_FOR = bytes(b if b < 0x80 else _LETTERS[b % len(_LETTERS)] for b in range(256))
"""Of names in a binary file no byte may be lost: each that is no ASCII becomes a letter."""


def legible(data: bytes) -> tuple[bytes, dict[str, str], str]:
    """The file with every name legible as UTF-8, what the names in it stand for where they had to be spelled otherwise,
    and the encoding that they were written in. The same bytes where all is well."""
    if not data.startswith(_BINARY):
        text, encoding = decode_text(data, _SAID.findall(data))
        return (data if encoding == "utf-8" else text.encode("utf-8")), {}, encoding
    names = _names(data)
    encoding = sniff_encoding(list(names.values()))
    if encoding == "utf-8":
        return data, {}, encoding
    spelled, titles = bytearray(data), {}
    for begin, name in names.items():
        if not name.isascii():
            stand_in = name.translate(_STANDS_FOR)
            spelled[begin : begin + len(name)] = stand_in
            titles[stand_in.decode("ascii")] = decode_name(name.decode(encoding, "replace"), "utf-8")
    return bytes(spelled), titles, encoding


def _names(data: bytes) -> dict[int, bytes]:
    """Where names of objects and pictures begin in a binary file, and what they are."""
    found = {}
    for match in _TEXT.finditer(data):
        begin, length = match.end() + 4, int.from_bytes(match.group(2), "little")
        text = data[begin : begin + length] if length <= _LONGEST else b""
        name = _NAME.fullmatch(text)
        if name is not None:
            found[begin] = name.group(1)
        elif match.group(1) and text:
            found[begin] = text
    return found


_INDICES = b"PolygonVertexIndex"
_NUMBERS = re.compile(rb"(PolygonVertexIndex:\s*\*\d+\s*\{\s*a:)([-\d,\s]+)\}")
_FIRST = 27
"""Where the records of a binary file begin."""
_WIDE = 7500
"""From this version on lengths in it have eight bytes."""


def without_edges(data: bytes) -> bytes:
    """The file without polygons of fewer than three corners: their corners become further ones of the polygon before
    them, on one of its own, so that what is told corner by corner stays in its place. The same bytes where there are
    none; what is no whole FBX file stays for the library to refuse."""
    if _INDICES not in data:
        return data
    if not data.startswith(_BINARY):
        return _NUMBERS.sub(_rewritten, data)
    try:
        wide = int.from_bytes(data[23:_FIRST], "little") >= _WIDE
        return data[:_FIRST] + _records(data, _FIRST, _FIRST, "<QQQB" if wide else "<IIIB", len(data))
    except (struct.error, zlib.error, ValueError, IndexError, RecursionError):
        return data


def _rewritten(match: re.Match[bytes]) -> bytes:
    numbers = np.array([int(word) for word in match.group(2).split(b",") if word.strip()], dtype=np.int64)
    mended = _mended(numbers)
    if mended is numbers:
        return match.group(0)
    head = re.sub(rb"\*\d+", b"*%d" % len(mended), match.group(1))
    return head + b" " + b",".join(b"%d" % n for n in mended.tolist()) + b"}"


def _mended(corners: np.ndarray) -> np.ndarray:
    """Corners of polygons, the last of each negative, without short polygons; empty if all are short."""
    ends = np.flatnonzero(corners < 0)
    sizes = np.diff(ends, prepend=-1)
    if not len(ends) or sizes.min() > 2:
        return corners
    whole = np.flatnonzero(sizes > 2)
    if not len(whole):
        return corners[:0]
    found = np.where(corners < 0, -corners - 1, corners)
    first = ends - sizes + 1
    # What is short goes to the last polygon before it that is not; at the beginning, to the first one.
    owner = whole[np.maximum(np.searchsorted(whole, np.arange(len(ends)), side="right") - 1, 0)]
    short = np.repeat(sizes <= 2, sizes)
    at = np.repeat(np.where(first > first[owner], ends[owner], first[owner]), sizes)
    found[short] = found[at[short]]
    last = np.flatnonzero(np.diff(owner, append=-1))
    found[ends[last]] = -found[ends[last]] - 1
    return found.astype(corners.dtype)


def _records(data: bytes, at: int, place: int, form: str, end: int) -> bytes:
    """What is between `at` and `end` in a binary file, its records as they are written from `place` on; what is behind
    the last one, which is empty, stays."""
    head = struct.calcsize(form)
    out = bytearray()
    while at + head <= end:
        stop, count, size, letters = struct.unpack_from(form, data, at)
        if not stop:
            break
        if not at < stop <= end:
            raise ValueError
        name = data[at + head : at + head + letters]
        begin = at + head + letters
        told, below = data[begin : begin + size], data[begin + size : stop]
        if name == _INDICES:
            told = _array(told)
        elif below:
            below = _records(data, begin + size, place + len(out) + head + letters + size, form, stop)
        length = head + letters + len(told) + len(below)
        out += struct.pack(form, place + len(out) + length, count, len(told), letters) + name + told + below
        at = stop
    return bytes(out) + data[at:end]


def _array(told: bytes) -> bytes:
    """A property that is an array of whole numbers, without short polygons."""
    count, packed, size = struct.unpack_from("<III", told, 1)
    raw = told[13 : 13 + size]
    numbers = np.frombuffer(zlib.decompress(raw) if packed else raw, dtype="<i4" if told[:1] == b"i" else "<i8")
    if len(numbers) != count:
        raise ValueError
    mended = _mended(numbers)
    if mended is numbers:
        return told
    raw = zlib.compress(mended.tobytes()) if packed else mended.tobytes()
    return told[:1] + struct.pack("<III", len(mended), packed, len(raw)) + raw
