"""Words of labels, brought to one spelling so that phrases can be compared."""

from __future__ import annotations

import functools
import re
import unicodedata

_STOP = frozenset(
    word
    for words in (
        "the of at to in with for on a an and or by per from as is its",
        "de du des la le les l d au aux et en a",
        "der die das des dem den bei mit und auf im am zu von",
        "el los las del y al con por",
    )
    for word in words.split()
)
"""Words that say nothing of which property is meant."""

_ALIAS = {
    "tyre": "tire",
    "tyres": "tire",
    "centre": "center",
    "centreline": "centerline",
    "dia": "diameter",
    "diam": "diameter",
    "cyl": "cylinder",
    "cyls": "cylinder",
    "deg": "",
    "degree": "",
    "degrees": "",
    "grad": "",
    "wt": "weight",
    "hyd": "hydraulic",
    "equip": "equipment",
    "approx": "",
    "approximately": "",
    "about": "",
    "ca": "",
    "nos": "number",
    "no": "number",
    "qty": "number",
    "quantity": "number",
    "vs": "versus",
    "discharge": "dump",
}
NEUTRAL = frozenset(
    word
    for words in (
        "iso sae din en jis ansi metric imperial us dimension value",
        "mm cm m in ft kg lb mpa kpa bar psi l min gal",
        "valve angle position system equipped typical typically standard nominal",
    )
    for word in words.split()
)
"""Words that do not make a label mean something else."""
REVERSING = frozenset(
    word
    for words in (
        "without less excluding except excl minus ohne sans sin",
        "optional option change difference increase decrease additional versus",
    )
    for word in words.split()
)
"""Words that make a label mean something else than the words around them."""

_PAIRS = tuple(
    pair.split("/")
    for pair in [
        "front/rear",
        "left/right",
        "inner/outer",
        "inside/outside",
        "upper/lower",
        "maximum/minimum",
        "gross/net",
        "forward/reverse",
        "loaded/empty",
        "heaped/struck",
        "straight/turn",
        "raise/lower",
        "high/low",
        "total/each",
    ]
)
OPPOSITES = {
    word: frozenset(b if word == a else a for a, b in _PAIRS if word in (a, b)) for pair in _PAIRS for word in pair
}
"""Words that contradict each other."""

_CJK = re.compile(r"[\u3040-\u30ff\u3400-\u9fff\uac00-\ud7af]")
_TOKEN = re.compile(r"[^\W_]+(?:[.,]\d+)?|±")


@functools.lru_cache(maxsize=8192)
def tokens(text: str) -> tuple[str, ...]:
    """The words of a text in order: no case, accents, plural or filler; numbers kept, units' signs not."""
    found = []
    for word in _TOKEN.findall(text.replace("°", " ").replace("º", " ")):
        token = _token(word)
        if token:
            found.append(token)
    return tuple(found)


def _token(word: str) -> str:
    plain = "".join(c for c in unicodedata.normalize("NFKD", word.casefold()) if not unicodedata.combining(c))
    if plain in _ALIAS:
        return _ALIAS[plain]
    if plain in _STOP:
        return ""
    if plain == "max" or plain.startswith("maxim"):
        return "maximum"
    if plain == "min" or plain.startswith("minim"):
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
