"""Names in FBX files that are no UTF-8, as exporters of other languages write them: the library reads no such file."""

from __future__ import annotations

import re
import string

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
