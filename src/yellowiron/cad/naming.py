"""Names out of CAD files: which encoding they are in, which say something, and ids that are unique."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence

from yellowiron.model.finding import Finding

_GENERIC = re.compile(
    r"(?:=>.*|\d+|nauo\s*\d*|(?:solid|compound|compsolid|shell|part|body|component|product|shape|assembly|assy|default|"
    r"none|unnamed|unknown|noname|no name|open cascade step translator.*)[\s_.:#-]*\d*(?:[.:_-]\d+)*)",
    re.IGNORECASE,
)

_HAN_COMMON = {"gb18030": (0xB0, 0xD7), "big5": (0xA4, 0xC6), "cp932": (0x88, 0x97)}
"""Lead bytes of each encoding's everyday characters (level 1 hanzi and kanji)."""

_ISOLATED = re.compile(rb"(?<![\x80-\xff])[\x80-\xff](?![\x80-\xff])")


def sniff_encoding(names: Sequence[bytes]) -> str:
    """The Python codec that the names of one file are written in.

    ISO 10303-21 allows ASCII only, with escapes that every reader knows; CAD systems write their computer's own
    encoding all the same. ASCII and UTF-8 come out as 'utf-8'; otherwise the candidate whose decoded text is made of
    its script's everyday characters wins: GB 18030, Shift-JIS (CP932), EUC-JP, Big5, Korean (CP949) or Western
    (CP1252).
    """
    high = [name for name in names if any(byte > 0x7F for byte in name)]
    if not high or all(_decodes(name, "utf-8") for name in high):
        return "utf-8"
    scores: dict[str, float] = {
        codec: sum(_plausibility(name, codec) for name in high) for codec in (*_HAN_COMMON, "cp1252")
    }
    best = max(scores, key=lambda codec: scores[codec])
    return _sibling_of_gb(high) if best == "gb18030" else best


def decode_text(data: bytes, names: Sequence[bytes]) -> tuple[str, str]:
    """A text file, and the codec that the names in it are written in."""
    try:
        return data.decode("utf-8-sig"), "utf-8"
    except UnicodeDecodeError:
        encoding = sniff_encoding(names)
    return data.decode(encoding, errors="replace"), encoding


def encoding_remarks(encoding: str, path: str) -> list[Finding]:
    """What to say of names in another encoding than the standard's (CAD010)."""
    if encoding == "utf-8":
        return []
    return [Finding("CAD010", "info", path, f"Names are not in a standard encoding; they were read as {encoding}")]


def _sibling_of_gb(names: Sequence[bytes]) -> str:
    """'gb18030', or the encoding with the same byte ranges that the names are really in.

    Korean syllables and Japanese kana have rows of their own there; Chinese text has characters beyond the first and
    hardly ever one of the second.
    """
    chinese = [character for name in names for character in name.decode("gb18030", "replace")]
    if sum(map(_is_kana, chinese)) * 4 >= sum(character > "\x7f" for character in chinese):
        return "euc_jp"
    korean = {character for name in names for character in name.decode("cp949", "replace") if character > "\x7f"}
    if len(korean) >= 8 and all("\uac00" <= character <= "\ud7a3" for character in korean):
        return "cp949"
    return "gb18030"


def _decodes(name: bytes, codec: str) -> bool:
    try:
        name.decode(codec)
    except UnicodeDecodeError:
        return False
    return True


def _plausibility(name: bytes, codec: str) -> float:
    """How well a name reads in an encoding: the sum over its characters, divided by its bytes above ASCII."""
    high_bytes = sum(byte > 0x7F for byte in name)
    if not _decodes(name, codec):
        # A stray byte among many names must not overthrow the rest; Western text always decodes, nearly.
        return -1.0
    if codec == "cp1252":
        return len(_ISOLATED.findall(name)) / high_bytes * 1.5 - 0.5
    score = 0.0
    for character in name.decode(codec):
        raw = character.encode(codec)
        if raw[0] <= 0x7F:
            continue
        first, last = _HAN_COMMON[codec]
        if codec == "cp932" and len(raw) == 1:
            score += 0.45  # half-width katakana; GB text read as Shift-JIS is full of them, two for each character
        elif len(raw) == 2 and (first <= raw[0] <= last or _is_kana(character)):
            # An ASCII second byte is legal in all but GB 2312, and in Western text read as one of them.
            score += 2.0 if raw[1] > 0x7F else 1.4
        else:
            score += 0.6 if raw[-1] > 0x7F else -0.5
    return score / high_bytes


def _is_kana(character: str) -> bool:
    return 0x3041 <= ord(character) <= 0x30FE


def decode_name(text: str, encoding: str) -> str:
    """A name as read byte for byte (one character a byte) in its real encoding; cleaned of control characters."""
    if encoding != "utf-8" and all(ord(character) < 0x100 for character in text):
        text = text.encode("latin-1").decode(encoding, errors="replace")
    text = "".join(" " if unicodedata.category(character) == "Cc" else character for character in text)
    return unicodedata.normalize("NFC", " ".join(text.split()))


def is_generic(name: str) -> bool:
    """True for a name that a program gave (`Solid17`, `NAUO3`, `12`, `=>[0:1:1:2]`, nothing), not a person."""
    return not name or _GENERIC.fullmatch(name) is not None


def occurrence_name(instance: str, product: str) -> str:
    """What to call an occurrence: the product's name, or the instance's where only that one says something new.

    Most programs derive the instance name (`BOLT-3`, `BOLT:1`); some let a person write one (`LIFT CYLINDER LH`).
    """
    if is_generic(instance):
        return product
    if is_generic(product):
        return instance
    one, other = _letters(instance), _letters(product)
    return product if one.startswith(other) or other.startswith(one) else instance


def _letters(name: str) -> str:
    return "".join(character for character in name.casefold() if character.isalnum())


def unique_ids(paths: Iterable[tuple[str, ...]]) -> list[str]:
    """One id a path: its names joined by '/', repeated ones numbered '#2', '#3' in order."""
    ids: list[str] = []
    taken: set[str] = set()
    count: dict[str, int] = {}
    for path in paths:
        plain = "/".join(path)
        number = count.get(plain, 0) + 1
        candidate = plain if number == 1 else f"{plain}#{number}"
        while candidate in taken:
            number += 1
            candidate = f"{plain}#{number}"
        count[plain] = number
        taken.add(candidate)
        ids.append(candidate)
    return ids


def listed(names: Sequence[str], most: int = 5) -> str:
    """The first few names, and how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more
