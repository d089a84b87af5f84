"""Words that a recognition program runs together or misses a letter of, by the words that sheets are known to have."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from yellowiron.specs.language.vocabulary import SPELLINGS, folded, tokens
from yellowiron.specs.pages.words import Word

_LEAST_RUN = 8
"""Letters of a word that may be several."""
_LEAST_PART = 4
"""Letters of one of them at least, so that no word is cut into fillers."""
_LEAST_END = 3
"""Letters of the first and the last of more than two."""
_LEAST_MENDED = 6
"""Letters of a word that is brought to a known one: shorter ones are a letter away from too many."""
_SEAMS = re.compile(
    r"(?<=[a-z]{2})(?=[A-Z][a-z]{2})|(?<=[A-Za-z]{3}[.:])(?=[A-Za-z]{3})|(?<=[A-Za-z]{3})(?=\([A-Za-z])|(?<=\))(?=\()"
)
"""Where a capital follows small letters, a word a full stop, a bracket a word or a bracket."""
_ALIKE = ("il1tj", "ceo0", "uvy", "mn", "hbk", "5s", "8b", "gq", "fr")
"""Characters that are taken for each other."""


def spelled(words: Sequence[Word]) -> list[Word]:
    """The words, those that are none but would be with a letter more, less or like theirs as the known one, if there is
    but one; those that are several known ones run together cut into them."""
    return [_mended(part) for word in words for part in _cut(word)]


def _cut(word: Word) -> Iterator[Word]:
    ends = [0, *(m.start() for m in _SEAMS.finditer(word.text)), len(word.text)]
    for start, end in pairwise(ends):
        run = re.fullmatch(r"(\W*)([^\W\d_]+)(\W*)", word.text[start:end])
        parts = _parts(run.group(2)) if run and not _known(run.group(2)) else ()
        cuts = [start, *(start + run.end(1) + n for n in parts), end] if run else [start, end]
        for a, b in pairwise(cuts):
            step = (word.x1 - word.x0) / len(word.text)
            yield replace(word, text=word.text[a:b], x0=word.x0 + a * step, x1=word.x0 + b * step)


def _known(word: str) -> bool:
    own = folded(word)
    return own in SPELLINGS or tokens(word) != (own,)


@functools.lru_cache(maxsize=4096)
def _parts(run: str) -> tuple[int, ...]:
    """Where a run of letters is to be cut into the fewest known words; () if it is not made of such."""
    if len(run) < _LEAST_RUN:
        return ()
    best: list[tuple[int, ...] | None] = [(), *[None] * len(run)]
    for end in range(2, len(run) + 1):
        ways = [
            (*way, end)
            for start in range(max(0, end - 16), end - 1)
            if (way := best[start]) is not None and folded(run[start:end]) in SPELLINGS
        ]
        best[end] = min(ways, key=len, default=None)
    found = best[-1] or ()
    lengths = [b - a for a, b in pairwise((0, *found))]
    # of more than two none ends in a filler: "Achslasten" in no "en", "serviceable" in no "ab le"
    words = bool(lengths) and max(lengths) >= _LEAST_PART
    words = words and (len(lengths) == 2 or min(lengths[0], lengths[-1]) >= _LEAST_END)
    return found[:-1] if words else ()


def _mended(word: Word) -> Word:
    run = re.fullmatch(r"(\W*)([^\W\d_]+)(\W*)", word.text)
    if run is None or len(run.group(2)) < _LEAST_MENDED - 1 or _known(run.group(2)):
        return word
    near = _near(folded(run.group(2)))
    return replace(word, text=run.group(1) + near + run.group(3)) if near else word


@functools.lru_cache(maxsize=4096)
def _near(word: str) -> str:
    """The one known word that differs by a letter left out, doubled or taken for one like it; "" if none or several."""
    found = {known for known in _BY_LENGTH.get(len(word) + 1, ()) if _without_one(known, word)}
    if len(word) >= _LEAST_MENDED:
        found |= {known for known in _BY_LENGTH.get(len(word) - 1, ()) if _without_one(word, known)}
        found |= {known for known in _BY_LENGTH.get(len(word), ()) if _like(word, known)}
    return found.pop() if len(found) == 1 else ""


def _without_one(longer: str, shorter: str) -> bool:
    at = next((i for i, (a, b) in enumerate(zip(longer, shorter, strict=False)) if a != b), len(shorter))
    return longer[at + 1 :] == shorter[at:]


def _like(word: str, known: str) -> bool:
    off = [(a, b) for a, b in zip(word, known, strict=True) if a != b]
    return len(off) == 1 and any(off[0][0] in group and off[0][1] in group for group in _ALIKE)


_BY_LENGTH: dict[int, list[str]] = {}
for _word in sorted(SPELLINGS):
    if len(_word) >= _LEAST_MENDED:
        _BY_LENGTH.setdefault(len(_word), []).append(_word)
