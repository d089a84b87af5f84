"""Words of labels, brought to one spelling so that phrases can be compared. The words themselves: `data/words.json`."""

from __future__ import annotations

import functools
import json
import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping
from importlib import resources
from typing import Any


def data(name: str) -> Mapping[str, Any]:
    """A file of words that come with the package."""
    text = resources.files("yellowiron.specs").joinpath(f"data/{name}.json").read_text(encoding="utf-8")
    return dict(json.loads(text))


def _words(lines: Iterable[str]) -> frozenset[str]:
    return frozenset(word for line in lines for word in line.split())


_DATA = data("words")
_STOP = _words(_DATA["stop"])
"""Words that say nothing of which property is meant."""
_ALIAS = {word: meant for meant, spellings in _DATA["alias"].items() for word in spellings.split()}
NEUTRAL = _words(_DATA["neutral"])
"""Words that do not make a label mean something else."""
REVERSING = _words(_DATA["reversing"])
"""Words that make a label mean something else than the words around them."""
HARMLESS = _words(_DATA["harmless"])
"""Places, parts and remarks that a maker may add to a label without meaning another property."""
GENERAL = _words(_DATA["general"])
"""Words of headings under which anything may stand."""
_ENDS = _words(_DATA["ends"])
"""What makers measure distances from and to."""
VAGUE = _words(_DATA["vague"])
"""Words that name a property only under a heading of its part."""
TELLING = _words(_DATA["telling"])
"""Conditions and other bodies: beside the words of a property they may make it another one."""
MODELS = _words(_DATA["models"])
"""Words for a machine's model."""
CIRCUITS = _words(_DATA["circuits"])
"""Words for a circuit of its own: its pressure and flow are no other's."""
_PAIRS = tuple(pair.split("/") for pair in _DATA["opposites"])
OPPOSITES = {
    word: frozenset(b if word == a else a for a, b in _PAIRS if word in (a, b)) for pair in _PAIRS for word in pair
}
"""Words that contradict each other."""

_CJK = re.compile(r"[\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af]")
_TOKEN = re.compile(
    r"[\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af々]+|[^\W_\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af々]+(?:[.,]\d+)?|(?<=\s)[–—](?=\s)"
)
_NET_BY = re.compile(
    r"\b(?:ISO\s*(?:9249|1585)|SAE\s*J\s?1349|(?:EEC|EWG|CEE)?\s*80/1269(?:/(?:EEC|EWG|CEE))?)\b", re.IGNORECASE
)
_GROSS_BY = re.compile(r"\bSAE\s*J\s?1995\b", re.IGNORECASE)
"""Standards by which an engine's net power is measured, and its gross one."""
_PER_MINUTE = re.compile(r"\bmin\s?[-⁻]\s?[1¹](?!\d)")
_WITHOUT = re.compile(r"\b[wW]/[oO]\b\.?")
_LINKS = ("", "s", "n", "en", "es", "e", "er")
"""What German puts between the parts of a compound."""
_INFLECTED = re.compile(r"(?:e[snmr]?|a|o|n)$")
_LEAST_STEM = 4
_LEAST_COMPOUND = 6


@functools.lru_cache(maxsize=16384)
def _fold(word: str) -> str:
    """A word without case and accents, in one spelling; plurals as singulars, whatever means most or least alike."""
    plain = word.casefold()
    if not plain.isascii():
        plain = "".join(c for c in unicodedata.normalize("NFKD", plain) if not unicodedata.combining(c))
    if plain in _ALIAS:
        return _ALIAS[plain]
    if plain in _STOP:
        return plain
    if plain.startswith("maxim"):
        return "maximum"
    if plain.startswith("minim"):
        return "minimum"
    if len(plain) > 3 and plain.endswith("s") and not plain.endswith(("ss", "us", "is")):
        plain = plain[:-1]
    return _ALIAS.get(plain, plain)


def _key(spelling: str) -> tuple[str, ...]:
    return tuple(f for w in _TOKEN.findall(spelling) if (f := _fold(w)))


def _lexicon() -> tuple[dict[tuple[str, ...], tuple[str, ...]], dict[tuple[str, ...], tuple[str, ...]]]:
    """Expressions → the English words they stand for: those that hang on a filler ("over tires", "à vide"), and the
    others, without theirs."""
    hanging: dict[tuple[str, ...], tuple[str, ...]] = {}
    others: dict[tuple[str, ...], tuple[str, ...]] = {}
    for language in ("romance", "german", "english"):
        for meant, spellings in _LEXICON[language].items():
            words = tuple(_fold(w) for w in meant.split())
            for spelling in spellings.split(" | "):
                whole = _key(spelling)
                bare = tuple(w for w in whole if w not in _STOP)
                opens = language == "english" and whole[0] in _STOP  # "aux double acting": no filler in English
                if len(bare) < len(whole) and (len(bare) < 2 or opens):
                    hanging[whole] = words
                elif bare:
                    others[bare] = words
    return hanging, others


_LEXICON = data("lexicon")
_HANGING, _EXPRESSIONS = _lexicon()
KNOWN = frozenset(word for table in (_HANGING, _EXPRESSIONS) for meant in table.values() for word in meant) | _words(
    _DATA["cjk"]
)
"""English words that the words of other languages are brought to."""
_LONGEST = max(len(key) for key in (*_HANGING, *_EXPRESSIONS))
_STEMS = {
    stem: meant
    for key, meant in _EXPRESSIONS.items()
    if len(key) == 1 and len(stem := _INFLECTED.sub("", key[0])) >= _LEAST_STEM
}
_PARTS = {
    key[0]: tuple(_fold(w) for w in meant.split())
    for meant, spellings in _LEXICON["german"].items()
    for spelling in spellings.split(" | ")
    if len(key := _key(spelling)) == 1
} | {"reifen": ("tire",)}
"""German words that compounds are made of."""
_FIRST = _PARTS | {_fold(w): (meant,) for meant, words in _LEXICON["german first"].items() for w in words.split()}
"""The same, before the last part: the Hub of a Hubzylinder lifts, the Zylinderhub is a stroke."""
_HEADS = tuple(_LEXICON["german heads"].split())


def _english(words: list[str]) -> list[str]:
    """Latin words in order as English ones: known expressions, the longest first; inflected forms; compounds."""
    folded = [f for w in words if (f := _fold(w))]
    found: list[str] = []
    waiting: list[str] = []

    def settle() -> None:
        for known, piece in _cut([w for w in waiting if w not in _STOP], _EXPRESSIONS):
            found.extend(piece if known else _one(piece[0]))
        waiting.clear()

    for known, piece in _cut(folded, _HANGING):
        if known:
            settle()
            found.extend(piece)
        else:
            waiting.extend(piece)
    settle()
    return found


def _cut(words: list[str], table: Mapping[tuple[str, ...], tuple[str, ...]]) -> Iterator[tuple[bool, tuple[str, ...]]]:
    """Words in order, the expressions of a table replaced: whether it was one, and what it stands for."""
    at = 0
    while at < len(words):
        for length in range(min(_LONGEST + 1, len(words) - at), 0, -1):
            piece = tuple(words[at : at + length])
            meant = table.get(piece) or (_around(piece, table) if length > 2 else None)
            if meant is not None:
                yield True, meant
                at += length
                break
        else:
            yield False, (words[at],)
            at += 1


_EXTREMES = {"maximum", "minimum"}


def _around(words: tuple[str, ...], table: Mapping[tuple[str, ...], tuple[str, ...]]) -> tuple[str, ...] | None:
    """What an expression with "maximum" or "minimum" inside it stands for: "hauteur maximale de chargement"."""
    inside = tuple(w for w in words[1:-1] if w in _EXTREMES)
    meant = table.get(tuple(w for w in words if w not in _EXTREMES)) if inside else None
    return (*meant, *inside) if meant and not {words[0], words[-1]} & _EXTREMES else None


@functools.lru_cache(maxsize=8192)
def _one(word: str) -> tuple[str, ...]:
    """What a single word that is no expression stands for; itself where nothing is known of it."""
    if not word.isalpha():
        return (word,)
    for spelled in (word, word.replace("ae", "a").replace("oe", "o").replace("ue", "u")):
        if (key := (spelled,)) in _EXPRESSIONS:
            return _EXPRESSIONS[key]
        if (meant := _STEMS.get(_INFLECTED.sub("", spelled))) is not None:
            return meant
        if len(spelled) >= _LEAST_COMPOUND and (parts := _compound(spelled)):
            return parts
    for head in _HEADS:
        if word.endswith(head) and len(word) > len(head) + 2:
            return (word[: -len(head)], *_PARTS.get(head, (head,)))
    return (word,)


@functools.lru_cache(maxsize=8192)
def _compound(word: str) -> tuple[str, ...]:
    """A German compound's parts in English; () if it is not made of known words."""
    for end in range(len(word) - 2, 2, -1):
        first = _FIRST.get(word[:end])
        if first is None:
            continue
        for link in _LINKS:
            rest = word[end + len(link) :]
            if not word[end:].startswith(link) or len(rest) < 3:
                continue
            last = _PARTS.get(rest) or _compound(rest)
            if last:
                return (*first, *last)
    return ()


@functools.lru_cache(maxsize=8192)
def tokens(text: str) -> tuple[str, ...]:
    """The words of a text in order, in English as far as they are known, without case, accents, plural or filler;
    numbers kept, units' signs not. Chinese and Japanese text is cut into known terms; what is between them stays as it
    is."""
    found: list[str] = []
    latin: list[str] = []
    if _CJK.search(text):
        text = unicodedata.normalize("NFKC", text)
    text = _WITHOUT.sub("without ", text).replace("±", " each side ")
    text = _PER_MINUTE.sub(" rpm ", _GROSS_BY.sub(" gross ", _NET_BY.sub(" net ", text)))
    for word in _TOKEN.findall(text.replace("°", " ").replace("º", " ")):
        if word not in "–—" and not _CJK.match(word):
            latin.append(word)
            continue
        found.extend(_english(latin))
        latin.clear()
        found.extend(_terms(word) if word not in "–—" else ())  # no "control pump" in "Hydraulic Controls – Pump"
    found.extend(_english(latin))
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


_TO = re.compile(
    r"\s(?:to|bis(?: zu[rm]?)?|à|au|jusqu'(?:à|au)|al?|hasta)\s(?:l[ae]s?\s|l')?|至|到|から|～|〜", re.IGNORECASE
)


@functools.lru_cache(maxsize=8192)
def ends(text: str) -> tuple[frozenset[str], frozenset[str]] | None:
    """What a distance goes from and to: "rear axle to edge of counterweight" → ({"axle"}, {"edge", "counterweight"});
    None for a label that says no two such things."""
    parts = _TO.split(text)
    if len(parts) != 2:
        return None
    first, second = (frozenset(tokens(part)) & _ENDS for part in parts)
    return (first, second) if first and second else None


def is_one_place(words: frozenset[str]) -> bool:
    """Whether words name a single place of a machine and none of its properties: "rear axle"."""
    return words <= _PLACES and len(words & _ENDS) == 1 and not {"front", "rear"} <= words


_PLACES = _ENDS | frozenset(["front", "rear", "left", "right", "center", "centerline"])
_TERMS = {term: tuple(_english(meant.split())) for meant, terms in _DATA["cjk"].items() for term in terms.split()}
_TERM = re.compile("|".join(sorted((re.escape(t) for t in _TERMS), key=len, reverse=True)))
"""Terms of scripts without spaces, the longest first, each with the English words it stands for."""
_PARTICLES = frozenset(_DATA["particles"].split())


def has_cjk(text: str) -> bool:
    """Whether a text is written without spaces between words (Chinese, Japanese, Korean)."""
    return _CJK.search(text) is not None


@functools.lru_cache(maxsize=4096)
def squeezed(text: str) -> str:
    """A text without case, spaces and punctuation: for scripts without spaces."""
    return "".join(c for c in unicodedata.normalize("NFKC", text).casefold() if c.isalnum())


def _spellings() -> frozenset[str]:
    """Every Latin word of the two files, folded."""
    lexicon = [line for part in _LEXICON.values() if isinstance(part, dict) for pair in part.items() for line in pair]
    lists = [line for part in _DATA.values() if isinstance(part, list) for line in part]
    text = " ".join([*lexicon, *lists, *_DATA["cjk"], *(line for pair in _DATA["alias"].items() for line in pair)])
    return frozenset(_fold(word) for word in re.findall(r"[a-z]{2,}", text))


SPELLINGS = _spellings()
"""Words that are known in whatever language, folded as `folded` does."""
folded = _fold


def names_a_part(text: str) -> bool:
    """Whether words name a part of a machine, and no property of one: "Blade"."""
    words = frozenset(tokens(text))
    return bool(words) and words <= KNOWN - NEUTRAL - GENERAL - VAGUE - HARMLESS - _PROPERTIES


_PROPERTIES = _words(
    ["load point lift reach gear length width height depth weight mass capacity", "speed force pressure power radius"]
)
"""Words that head a chart or a list of properties, and no part."""
