"""Names as evidence: part and assembly names in several languages, with typos and truncation, against role names.

Names add weight to what geometry allows; they never overrule it. What a word means is in `data/words.json`.
"""

from __future__ import annotations

import functools
import json
import re
import unicodedata
from collections.abc import Mapping
from importlib import resources

from rapidfuzz.distance import DamerauLevenshtein

from yellowiron.model.assembly import Part
from yellowiron.model.specification import fold
from yellowiron.model.template import Template

ABOVE = 0.55
"""What the assembly right above a part counts against the part's own name; each further one again."""
_SPLIT = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_CJK = re.compile(r"[぀-ヿ㐀-鿿]+")
_COUNT = re.compile(r"[\s_#.-]*\d*$")
_SIDES = {"l": "left", "r": "right"}
_OPPOSED = (("left", "right"), ("front", "rear"))


@functools.cache
def _words() -> tuple[dict[tuple[str, ...], tuple[str, ...]], dict[str, tuple[str, ...]]]:
    """(phrases of tokens, words of scripts without spaces) → concepts."""
    text = resources.files("yellowiron.align").joinpath("data/words.json").read_text(encoding="utf-8")
    phrases: dict[tuple[str, ...], tuple[str, ...]] = {}
    scripts: dict[str, tuple[str, ...]] = {}
    for entries in json.loads(text).values():
        for word, concepts in entries.items():
            if _CJK.search(word):
                scripts[word] = tuple(concepts)
            else:
                phrases.setdefault(tuple(word.split()), tuple(concepts))
    return phrases, scripts


def tokens(text: str) -> list[str]:
    """Lower-case words of a name: split at case changes, digits and punctuation, without accents; numbers dropped."""
    plain = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))
    return [t.casefold() for t in _SPLIT.findall(plain) if not t.isdigit()]


@functools.lru_cache(maxsize=8192)
def concepts(text: str) -> frozenset[str]:
    """What a name speaks of: `concepts("HYDRUALIC_CYL_LIFT_LH")` has cylinder, boom and left."""
    scripts = _words()[1]
    found: set[str] = set()
    rest = unicodedata.normalize("NFKC", text)
    for word in sorted((w for w in scripts if w in rest), key=lambda w: (-len(w), w)):
        if word in rest:
            found.update(scripts[word])
            rest = rest.replace(word, " ")
    words = tokens(rest)
    used = [False] * len(words)
    for size in (3, 2, 1):
        for start in range(len(words) - size + 1):
            if any(used[start : start + size]):
                continue
            meant = _meaning(tuple(words[start : start + size]))
            if meant is not None:
                found.update(meant)
                used[start : start + size] = [True] * size
    return frozenset(found)


@functools.lru_cache(maxsize=8192)
def _meaning(words: tuple[str, ...]) -> tuple[str, ...] | None:
    phrases = _words()[0]
    if words in phrases:
        return phrases[words]
    best: tuple[float, tuple[str, ...]] | None = None
    for phrase, meant in phrases.items():
        if len(phrase) != len(words):
            continue
        likeness = min(_alike(a, b) for a, b in zip(words, phrase, strict=True))
        if likeness > 0.79 and (best is None or likeness > best[0]):
            best = (likeness, meant)
    return best[1] if best is not None else None


def _alike(word: str, known: str) -> float:
    """1 for equal words, less for typos and for a word cut short; 0 where it could be anything."""
    if word == known:
        return 1.0
    if len(word) >= 4 and len(known) > len(word) and known.startswith(word):
        return 0.9
    if min(len(word), len(known)) < 5:
        return 0.0
    return DamerauLevenshtein.normalized_similarity(word, known)


def role_concepts(role: str) -> frozenset[str]:
    """The concepts of a role name, which is English words joined by underscores."""
    found: set[str] = set()
    for token in role.split("_"):
        if token in _SIDES:
            found.add(_SIDES[token])
        else:
            found |= concepts(token) or {token}
    return frozenset(found)


def exact_roles(template: Template) -> dict[str, str]:
    """Folded role name → role."""
    return {fold(r.name): r.name for r in template.roles}


def exact_role(part: Part, roles: Mapping[str, str]) -> str | None:
    """The role whose name the part bears, as it stands or with a running number behind."""
    name = fold(part.name)
    return roles.get(name) or roles.get(fold(_COUNT.sub("", part.name)))


def likeness(part: Part, role: frozenset[str]) -> float:
    """How well a part's name, and less so its assemblies', speak of a role: 0 (not at all, or of another) to 1."""
    weights: dict[str, float] = {}
    for depth, text in enumerate((part.name, *reversed(part.path[1:]))):
        for concept in sorted(concepts(text)):
            weights[concept] = max(weights.get(concept, 0.0), ABOVE**depth)
    if not weights:
        return 0.0
    for a, b in _OPPOSED:
        if (a in role and b in weights and a not in weights and b not in role) or (
            b in role and a in weights and b not in weights and a not in role
        ):
            return 0.0
    common = sum(w for c, w in weights.items() if c in role)
    if common == 0:
        return 0.0
    recall = common / len(role)
    precision = common / sum(weights.values())
    return 2 * recall * precision / (recall + precision)


def name_scores(parts: tuple[Part, ...], template: Template) -> list[dict[str, float]]:
    """For every part: body → how well its names speak of it (1.5 where it bears the exact name of one of its roles)."""
    roles = exact_roles(template)
    bodies = {r.name: role_concepts(r.name) for r in template.roles if r.rigid}
    scores = []
    for part in parts:
        found = {b: s for b, wanted in bodies.items() if (s := likeness(part, wanted)) > 0.3}
        role = exact_role(part, roles)
        body = template.body_of(role) if role is not None else None
        if body is not None:
            found[body] = 1.5
        scores.append(found)
    return scores
