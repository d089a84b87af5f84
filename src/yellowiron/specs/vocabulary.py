"""Words of labels, brought to one spelling so that phrases can be compared. The words themselves: `data/words.json`."""

from __future__ import annotations

import functools
import json
import re
import unicodedata
from collections.abc import Iterable, Mapping
from importlib import resources
from typing import Any


def _data() -> Mapping[str, Any]:
    text = resources.files("yellowiron.specs").joinpath("data/words.json").read_text(encoding="utf-8")
    return dict(json.loads(text))


def _words(lines: Iterable[str]) -> frozenset[str]:
    return frozenset(word for line in lines for word in line.split())


_DATA = _data()
_STOP = _words(_DATA["stop"])
"""Words that say nothing of which property is meant."""
_ALIAS = {word: meant for meant, spellings in _DATA["alias"].items() for word in spellings.split()}
NEUTRAL = _words(_DATA["neutral"])
"""Words that do not make a label mean something else."""
REVERSING = _words(_DATA["reversing"])
"""Words that make a label mean something else than the words around them."""
CIRCUITS = _words(_DATA["circuits"])
"""Words for a circuit of its own: its pressure and flow are no other's."""
_PAIRS = tuple(pair.split("/") for pair in _DATA["opposites"])
OPPOSITES = {
    word: frozenset(b if word == a else a for a, b in _PAIRS if word in (a, b)) for pair in _PAIRS for word in pair
}
"""Words that contradict each other."""

_CJK = re.compile(r"[\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af]")
_TOKEN = re.compile(
    r"[\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af々]+|[^\W_\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af々]+(?:[.,]\d+)?|±"
)
_TERMS = {term: tuple(meant.split()) for meant, terms in _DATA["cjk"].items() for term in terms.split()}
_TERM = re.compile("|".join(sorted((re.escape(t) for t in _TERMS), key=len, reverse=True)))
"""Terms of scripts without spaces, the longest first, each with the English words it stands for."""


@functools.lru_cache(maxsize=8192)
def tokens(text: str) -> tuple[str, ...]:
    """The words of a text in order: no case, accents, plural or filler; numbers kept, units' signs not. Chinese and
    Japanese text is cut into known terms, which become English words; what is between them stays as it is."""
    found: list[str] = []
    if _CJK.search(text):
        text = unicodedata.normalize("NFKC", text)
    for word in _TOKEN.findall(text.replace("°", " ").replace("º", " ")):
        if _CJK.match(word):
            found.extend(_terms(word))
        elif token := _token(word):
            found.append(token)
    return tuple(found)


def _terms(text: str) -> list[str]:
    found: list[str] = []
    end = 0
    for match in [*_TERM.finditer(text), None]:
        between = text[end : match.start() if match else len(text)]
        if between and between not in _PARTICLES:
            found.append(between)
        if match:
            found.extend(_TERMS[match.group(0)])
            end = match.end()
    return found


_PARTICLES = {
    "の",
    "时",
    "時",
    "的",
    "至",
    "から",
    "まで",
    "ー",
    "と",
    "及",
    "和",
    "处",
    "为",
    "は",
    "です",
    "が",
    "を",
}


def _token(word: str) -> str:
    plain = "".join(c for c in unicodedata.normalize("NFKD", word.casefold()) if not unicodedata.combining(c))
    if plain in _ALIAS:
        return _ALIAS[plain]
    if plain in _STOP:
        return ""
    if plain.startswith("maxim"):
        return "maximum"
    if plain.startswith("minim"):
        return "minimum"
    if len(plain) > 3 and plain.endswith("s") and not plain.endswith(("ss", "us", "is")):
        plain = plain[:-1]
    return _ALIAS.get(plain, plain)


def has_cjk(text: str) -> bool:
    """Whether a text is written without spaces between words (Chinese, Japanese, Korean)."""
    return _CJK.search(text) is not None


@functools.lru_cache(maxsize=4096)
def squeezed(text: str) -> str:
    """A text without case, spaces and punctuation: for scripts without spaces."""
    return "".join(c for c in unicodedata.normalize("NFKC", text).casefold() if c.isalnum())
