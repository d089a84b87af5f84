"""Names as evidence: part and assembly names in several languages, with typos and truncation, against role names.

Names add weight to what geometry allows; they never overrule it. What a word means is data: words of any machine in
`data/words.json`, those of a type's bodies in its template's `words.json`, and the role names themselves.
"""

from __future__ import annotations

import functools
import itertools
import json
import re
import unicodedata
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from importlib import resources

from rapidfuzz.distance import DamerauLevenshtein

from yellowiron.alignment.assignment.directions import sections_of
from yellowiron.model.assembly import Part
from yellowiron.model.specification import fold
from yellowiron.model.template import ITSELF, VAGUE, Role, Template
from yellowiron.support.caching.remembered import remembered

ABOVE = 0.55
"""What the assembly right above a part counts against the part's own name; each further one again."""
CLEAR = 0.3
"""Names that speak less of a body say nothing of it."""
EXACT = 1.5
"""What a part counts for a body if it bears the very name of one of the body's roles."""
NAMESAKE = 0.6
"""An assembly that shares this share of a part's words, or of its own, is that part's."""
SOME = 8
COMMON, IDLE = 0.3, 0.6
"""A word that more than a share of `COMMON` of at least `SOME` different names has counts less, one that more than
`IDLE` have nothing: it tells no part from another."""
FEW = 4
"""Of so many different names of assemblies, a word that more than `IDLE` have says nothing."""
VAGUE_SHARE = 0.5
"""A vague word of less than this share of a name's words says nothing: an upper holder holds anything."""
ALIKE = 0.79
"""Words less alike than this are different words, not typos."""
_SPLIT = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_SCRIPTS = re.compile(r"[\u0400-\u052f\u3040-\u30ff\u3400-\u9fff\uac00-\ud7a3]")
"""Letters of scripts whose words are looked for in a name as it is written: Cyrillic, Japanese, Chinese, Korean."""
_SPACED = re.compile(r"[\u0400-\u052f]")
"""Of these, those that have spaces: their words are looked for where words begin (машина is no шина, a tyre)."""
_SIZE = re.compile(r"(?<=\d)[A-Za-z](?=\d)")
"""A letter between digits is of a size (a tyre's 29.5R25, a bolt's M24x90), and no side."""
_ELIDED = re.compile(r"\b[dl]['\u2019](?=\w)", re.IGNORECASE)
_HIGH = re.compile(r"[\x80-\xff\u0152-\u2122]{2,}")
_COUNT = re.compile(r"[\s_#.-]*\d*$")
_LINK = re.compile(r"link[\W\d_]*$", re.IGNORECASE)
_SECTION = re.compile(r"(?<!\d)0?[1-9]$")
"""The number that sections are given, unlike those of modelling tools, which have three digits."""
_FIRST = re.compile(r"^.*?(?:[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\Z)[\W_]*", re.DOTALL)
"""A name's first word and what is before and behind it; all of a name without one."""
LINKS = 4
"""Of so many names that end in "link", and of most of a model's, it is a robot description's word for a body."""
_SIDES = {"l": "left", "r": "right"}
_OPPOSED = (("left", "right"), ("front", "rear"), ("barrel", "rod"))
_PLACES = frozenset({"left", "right", "front", "rear"})
"""They tell one body from another, and are no name of any."""
SOLIDS, NAMES = 20, 3
"""So many parts of one name are the solids of a mesh that is all of a machine; of so many different names what stands
before all is the machine's."""
_SMALL = frozenset(
    ("a", "an", "and", "d", "da", "das", "de", "del", "den", "der", "des", "die", "du", "e", "el", "et", "for", "la",
     "las", "le", "les", "los", "of", "the", "und", "y")
)  # fmt: skip
_PLAIN = frozenset(
    ("back", "base", "body", "left", "long", "main", "mesh", "node", "part", "plate", "right", "short", "side", "small",
     "solid", "under", "upper", "with")
)  # fmt: skip
"""Whole words that are no others cut short (long is no longeron)."""
_CODECS = (("latin-1", "utf-8"), ("cp1252", "utf-8"), ("latin-1", "gb18030"), ("cp1252", "gb18030"),
           ("latin-1", "shift_jis"), ("cp1252", "shift_jis"))  # fmt: skip
"""How a name was misread and what it was written in."""

Words = Mapping[str, Mapping[str, tuple[str, ...]]]


@dataclass(frozen=True, eq=False)
class Vocabulary:
    """What words mean: `phrases` of tokens, and words of `scripts` without spaces, to concepts (words of role names).
    `vague` ones speak only where nothing else in a name does: a bottom may be an undercarriage, or the end of a rod.
    `known` remembers what was asked before."""

    phrases: dict[tuple[str, ...], frozenset[str]]
    scripts: dict[str, frozenset[str]]
    vague: dict[tuple[str, ...], frozenset[str]] = field(default_factory=dict)
    known: dict[object, frozenset[str]] = field(default_factory=dict)


@functools.cache
def _common() -> Words:
    text = resources.files("yellowiron.alignment").joinpath("data/words.json").read_text(encoding="utf-8")
    return {key: {lang: tuple(words) for lang, words in entry.items()} for key, entry in json.loads(text).items()}


@remembered
def vocabulary(template: Template) -> Vocabulary:
    """The words of a template: its own first, then those in its role names, then those of any machine."""
    phrases: dict[tuple[str, ...], frozenset[str]] = {}
    scripts: dict[str, frozenset[str]] = {}
    vague: dict[tuple[str, ...], frozenset[str]] = {}
    unsure = {w for key, entry in template.words.items() if key.startswith(VAGUE) for ws in entry.values() for w in ws}
    parts = {t for r in template.roles for t in r.name.split("_")} - {*_SIDES, "piston"} - unsure
    own = {t: {"en": (t,)} for t in sorted(parts)}
    for table in (template.words, own, _common()):
        for key, entry in table.items():
            plain = key.removeprefix(VAGUE).removeprefix(ITSELF)
            for word in (w for words in entry.values() for w in words):
                if _SCRIPTS.search(word):
                    meaning = key.removeprefix(ITSELF).split()
                    scripts.setdefault(unicodedata.normalize("NFKC", word).casefold(), frozenset(meaning))
                    continue
                for spelled in (word, _spelled_out(word)):
                    meant = vague if key.startswith(VAGUE) else phrases
                    meant.setdefault(tuple(tokens(spelled)), frozenset(plain.split()))
    return Vocabulary(phrases, scripts, {words: said for words, said in vague.items() if words not in phrases})


def _spelled_out(word: str) -> str:
    """German without its umlauts: `Löffel` is also written `Loeffel`."""
    letters: dict[str, str | int | None] = {"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue", "ß": "ss"}
    return word.translate(str.maketrans(letters))


def tokens(text: str) -> list[str]:
    """Lower-case words of a name: split at case changes, digits and punctuation, without accents; numbers and small
    words (de, la, of) dropped."""
    return list(_tokens(text))


@functools.lru_cache(maxsize=65536)
def _tokens(text: str) -> tuple[str, ...]:
    text = _ELIDED.sub("", text.replace("ß", "ss"))
    plain = "".join(c for c in unicodedata.normalize("NFKD", text) if not unicodedata.combining(c))
    plain = _SIZE.sub(" ", plain)
    return tuple(t for t in (t.casefold() for t in _SPLIT.findall(plain)) if not t.isdigit() and t not in _SMALL)


def concepts(text: str, words: Vocabulary) -> frozenset[str]:
    """What a name speaks of: "HYDRUALIC_CYL_LIFT_LH" has cylinder, boom and left."""
    if text not in words.known:
        words.known[text] = _concepts(unicodedata.normalize("NFKC", mended(text, words)), words)
    return words.known[text]


def _concepts(text: str, words: Vocabulary) -> frozenset[str]:
    found: set[str] = set()
    written = text.casefold() if _SCRIPTS.search(text) else ""
    for word in sorted((w for w in words.scripts if w in written), key=lambda w: (-len(w), w)):
        begin = r"(?<![^\W\d_])" if _SPACED.match(word) else ""
        written, times = re.subn(begin + re.escape(word), " ", written)
        found |= words.scripts[word] if times else frozenset()
    said = tokens(text)
    used = [False] * len(said)
    for size in (4, 3, 2, 1):
        for start in range(len(said) - size + 1):
            if any(used[start : start + size]):
                continue
            run = tuple(said[start : start + size])
            meant = _meaning(run, words)
            # What the machine itself is called means nothing of a part, but is taken: no fork is lifted in a forklift.
            if meant or run in words.phrases:
                found |= meant
                used[start : start + size] = [True] * size
    if found - _PLACES:
        return frozenset(found)
    least = VAGUE_SHARE * len(said)
    runs = (tuple(said[a:b]) for a in range(len(said)) for b in range(len(said), a, -1) if b - a >= least)
    return frozenset(found).union(next((words.vague[run] for run in runs if run in words.vague), ()))


def mended(text: str, words: Vocabulary) -> str:
    """A name whose bytes were read in the wrong code (`¶¯±Û` is 动臂), where that gives words that are known."""
    if not _HIGH.search(text):
        return text
    for misread, written in _CODECS:
        try:
            other = text.encode(misread).decode(written)
        except UnicodeError:
            continue
        if any(w in other for w in words.scripts) or (written == "utf-8" and other != text):
            return other
    return text


def _meaning(said: tuple[str, ...], words: Vocabulary) -> frozenset[str]:
    """What a word, or some in a row, mean: as they stand, as a plural, joined (`Löffelstiel`), or with typos."""
    if said in words.known:
        return words.known[said]
    found = words.phrases.get(said, words.phrases.get((*said[:-1], said[-1].removesuffix("s"))))
    if found is None and len(said) == 1:
        found = _joined(said[0], words)
    if found is None:
        best = ALIKE
        for phrase, meant in words.phrases.items():
            if len(phrase) == len(said):
                likeness = min(_alike(a, b) for a, b in zip(said, phrase, strict=True))
                if likeness > best:
                    best, found = likeness, meant
    words.known[said] = found or frozenset()
    return words.known[said]


def _joined(word: str, words: Vocabulary) -> frozenset[str] | None:
    """The meaning of a compound of known words, longest first; None if it is none."""
    for cut in range(len(word) - 3, 2, -1):
        head = words.phrases.get((word[:cut],))
        if not head or cut < 3:
            continue
        for rest in (word[cut:], word[cut:].removeprefix("s")):
            tail = words.phrases.get((rest,)) or (_joined(rest, words) if len(rest) > 6 else None)
            if tail and len(rest) > 2:
                return head | tail
    return None


def _alike(word: str, known: str) -> float:
    """1 for equal words, less for typos and for a word cut short; 0 where it could be anything."""
    if word == known:
        return 1.0
    if word not in _PLAIN and 4 <= len(word) < len(known) <= 2 * len(word) and known.startswith(word):
        return 0.9
    if len(word) == len(known) == 4:  # two letters in each other's place
        return 0.8 if DamerauLevenshtein.distance(word, known) == 1 and sorted(word) == sorted(known) else 0.0
    if min(len(word), len(known)) < 5 or word[0] != known[0]:  # light is no right
        return 0.0
    return DamerauLevenshtein.normalized_similarity(word, known)


def role_concepts(role: Role) -> frozenset[str]:
    """What a name of the role would speak of: the words of its own name; a barrel or rod is of a cylinder."""
    found = {_SIDES.get(t, t) for t in role.name.split("_") if t != "piston"}
    return frozenset(found | ({"cylinder", role.kind} if role.kind in ("barrel", "rod") else set()))


def exact_roles(template: Template) -> dict[str, str]:
    """Folded role name → role."""
    return {fold(r.name): r.name for r in template.roles}


def exact_role(part: Part, roles: Mapping[str, str]) -> str | None:
    """The role whose name the part bears, as it stands or with a running number behind."""
    name = fold(part.name)
    return roles.get(name) or roles.get(fold(_COUNT.sub("", part.name)))


def likeness(said: Mapping[str, float], role: frozenset[str]) -> float:
    """How well names speak of a role: 0 (not at all, or of another) to 1. `said`: concept → weight (`spoken`)."""
    for a, b in _OPPOSED:
        if (a in role and b in said and a not in said and b not in role) or (
            b in role and a in said and b not in said and a not in role
        ):
            return 0.0
    shared = [c for c in said if c in role]
    # A place is no name, but a part that is called so and no more is what the machine has there: the front of a loader.
    whole = len(said) == 1 and role == said.keys() | {"frame"} and set(said.values()) == {1.0}
    if not set(shared) - _PLACES and not whole:
        return 0.0
    common = sum(said[c] for c in shared)
    recall = common / len(role)
    precision = common / sum(said.values())
    return 2 * recall * precision / (recall + precision)


def spoken(names: Iterable[str], words: Vocabulary) -> dict[str, float]:
    """What names speak of, the part's own first, then its assemblies' from the inside out: concept → weight."""
    weights: dict[str, float] = {}
    for depth, text in enumerate(names):
        for concept in sorted(concepts(text, words)):
            weights[concept] = max(weights.get(concept, 0.0), ABOVE**depth)
    return weights


def _wanted(template: Template, whole: Template) -> Iterator[tuple[str, frozenset[str]]]:
    """Body of the template → what names of it speak of, one for each of its roles and of those of `whole` below it."""
    known = {r.name: r for r in template.roles}
    for role in whole.roles:
        above: str | None = role.name
        while above is not None and above not in known:
            above = whole.role(above).parent
        body = template.body_of(above) if above is not None else None
        if body is not None and role.kind != "pin":
            yield body, role_concepts(role)


def _telling(names: Sequence[str], words: Vocabulary) -> dict[str, float]:
    """Concept → how well it tells parts from each other, 0 to 1, for those that not every word does: the machine's own
    name, put before every part's. Names that differ in their numbers alone are one."""
    said = {tuple(tokens(name)) or name: concepts(name, words) for name in names}
    if len(said) < SOME:
        return {}
    counts = Counter(concept for found in said.values() for concept in found)
    shares = {concept: n / len(said) for concept, n in counts.items() if n > COMMON * len(said)}
    return {concept: max(0.0, (IDLE - share) / (IDLE - COMMON)) for concept, share in shares.items()}


def _idle(assemblies: Collection[str], words: Vocabulary) -> frozenset[str]:
    """What a word says that most assemblies have in their names, all of a machine's: different words for one body are
    no such."""
    said = {frozenset(tokens(name)) for name in assemblies} - {frozenset()}
    counts = Counter(word for name in said for word in name)
    idle = sorted(word for word, n in counts.items() if len(said) >= FEW and n > IDLE * len(said))
    return frozenset(c for word in idle for c in concepts(word, words)) - _PLACES


def unnamed(names: Iterable[str]) -> frozenset[str]:
    """Those of a model's names that its modelling tool gave, which say nothing: `Cube.002`, `pCylinder12`, `Solid 3`,
    `polySurface7`, `Mesh_0_lambert1`. What could be a part of a machine as well (a cylinder, a body) is one only beside
    others that could not."""
    found: dict[bool, set[str]] = {True: set(), False: set()}
    known = _defaults()
    for name in names:
        said = [t for t in tokens(name) if len(t) > 1]
        if said and all(t in known for t in said):
            found[all(known[t] for t in said)].add(name)
    sure, doubtful = found[False], found[True]
    return frozenset(sure | doubtful) if sure else frozenset()


def own_words(text: str) -> list[str]:
    """The `tokens` of a name in the order of letters, without those that modelling tools give: `node_12_boom-l_mesh0`
    says no more than `L boom`."""
    known = _defaults()
    return sorted(t for t in tokens(text) if known.get(t, True))


@functools.cache
def _defaults() -> Mapping[str, bool]:
    """Word that modelling tools give → whether a machine may have a part of that name."""
    text = resources.files("yellowiron.alignment").joinpath("data/defaults.json").read_text(encoding="utf-8")
    document = json.loads(text)
    return dict.fromkeys(document["tools"], False) | dict.fromkeys(document["doubtful"], True)


def _owned(parts: Sequence[Part]) -> frozenset[tuple[str, ...]]:
    """The places in the tree that are one part's own: it is drawn there, or right below under the same words."""
    found = {(*p.path, p.name) for p in parts}
    for part in parts:
        said, above = set(tokens(part.name)), set(tokens(part.path[-1] if part.path else ""))
        if said and above and len(said & above) >= NAMESAKE * min(len(said), len(above)):
            found.add(part.path)
    return frozenset(found)


def _assemblies(part: Part, own: Collection[tuple[str, ...]], shared: int) -> Iterator[str]:
    """The names above a part that are its own as well, from the inside out: what is above a place that is a part's own
    carries that one and is no assembly of it, as in the bones of an animated model."""
    for depth in range(len(part.path), shared, -1):
        yield part.path[depth - 1]
        if part.path[:depth] in own:
            return


def borne_by_others(parts: tuple[Part, ...], template: Template) -> frozenset[int]:
    """The parts, by number, whose own names say nothing and which hang in the tree on another part, whose name is all
    that is said of them: what an arm carries in an animated model is the arm's, or a cylinder that stands on it."""
    parts = described(parts)
    words = vocabulary(template)
    silent = unnamed(n for p in parts for n in (p.name, *p.path))
    drawn = {(*p.path, p.name) for p in parts}
    found = set()
    for number, part in enumerate(parts):
        tree = (*part.path, part.name)
        said = [n for n, name in enumerate(tree) if name not in silent and concepts(name, words)]
        if said and said[-1] < len(part.path) and tree[: said[-1] + 1] in drawn:
            found.add(number)
    return frozenset(found)


def described(parts: tuple[Part, ...]) -> tuple[Part, ...]:
    """The parts, without the word for a body that robot descriptions put behind every name (`base_link`, `bucket_link`,
    `link4`), where most names have it: the parts' own, or those above them, where each body's meshes have names too."""
    if not any(_are_links(names) for names in ({p.name for p in parts}, {n for p in parts for n in p.path})):
        return parts
    return tuple(replace(p, name=_without_link(p.name), path=tuple(map(_without_link, p.path))) for p in parts)


def _without_machine(parts: tuple[Part, ...]) -> tuple[Part, ...]:
    """The parts, without what is put before every one's own name, as `Dumper_` before `Dumper_Body` and
    `Dumper_Wheel1`, and without the name of all of them where they are the solids of one mesh: it is the machine's."""
    said = [tokens(p.name) for p in parts]
    if len(parts) >= SOLIDS and len({(*p.path, p.name) for p in parts}) == 1:
        return tuple(replace(p, name="") for p in parts)
    if len({tuple(own) for own in said}) < NAMES:
        return parts
    before = list(itertools.takewhile(lambda words: len(set(words)) == 1, zip(*said, strict=False)))
    shared = [words[0] for words in before]
    if not shared or set(shared) & _PLACES or any(len(own) == len(shared) for own in said):
        return parts
    return tuple(replace(p, name=_without_first(p.name, len(shared))) for p in parts)


def _without_first(name: str, count: int) -> str:
    """A name without its first words, as `tokens` counts them; the name itself where they are not plain to see."""
    left = name
    while len(tokens(left)) > len(tokens(name)) - count:
        left = _FIRST.sub("", left)
    return left if tokens(left) == tokens(name)[count:] else name


def _are_links(names: Collection[str]) -> bool:
    links = sum(_is_link(name) for name in names)
    return links >= LINKS and 2 * links > len(names)


def _is_link(name: str) -> bool:
    return tokens(name)[-1:] == ["link"]


def _without_link(name: str) -> str:
    return _LINK.sub("", name).rstrip(" _-.") if _is_link(name) else name


def name_scores(parts: tuple[Part, ...], template: Template, whole: Template | None = None) -> list[dict[str, float]]:
    """For every part: body → how well its names speak of it (`EXACT` where it bears the exact name of one of its
    roles). Names of assemblies that hold all parts say nothing, nor does a word that most parts' own names have, or
    most assemblies'; one that many parts have says less.
    `whole`: a template with further bodies, of which the template's nearest above is meant."""
    parts = _without_machine(described(parts))
    words = vocabulary(whole or template)
    roles = exact_roles(template)
    shared = 0
    while len({p.path[: shared + 1] for p in parts}) == 1 and all(len(p.path) > shared for p in parts):
        shared += 1
    silent = unnamed(n for p in parts for n in (p.name, *p.path))
    telling = _telling([p.name for p in parts], words)
    own = _owned(parts)
    idle = _idle({n for p in parts for n in p.path[shared:]} - silent, words)
    bodies: dict[str, list[frozenset[str]]] = {}
    for wanted_body, wanted in _wanted(template, whole or template):
        bodies.setdefault(wanted_body, []).append(wanted)
    scores = []
    for part in parts:
        above = _assemblies(part, own, shared)
        names = ("" if name in silent else name for name in (part.name, *above))
        said = spoken(names, words)
        # What an assembly is called counts as it stands: all that is in it may well be most of the machine.
        said = {c: w * telling.get(c, 1.0) if w == 1.0 else w for c, w in said.items() if w == 1.0 or c not in idle}
        said = {c: w for c, w in said.items() if w > 0.0}
        found = {b: s for b, wanted in bodies.items() if (s := max(likeness(said, w) for w in wanted)) > CLEAR}
        named = exact_role(part, roles)
        body = template.body_of(named) if named is not None else None
        if body is not None:
            found[body] = EXACT
        scores.append(found)
    return _any_section(scores, parts, whole or template)


def _any_section(scores: list[dict[str, float]], parts: Sequence[Part], template: Template) -> list[dict[str, float]]:
    """The scores, those of what is numbered as the sections of a boom or a mast are (`BoomSection1` … `BoomSection4`)
    alike for every section that its name speaks of: which it is, its name does not tell."""
    numbered: dict[str, set[str]] = {}
    for part in parts:
        if (end := _SECTION.search(part.name)) is not None:
            numbered.setdefault(part.name[: end.start()], set()).add(end[0])
    several = {stem + n for stem, numbers in numbered.items() if len(numbers) > 1 for n in numbers}
    groups = sections_of(template) if several else ()
    found = []
    for part, said in zip(parts, scores, strict=True):
        best = max(said, key=lambda b: said[b], default="") if part.name in several else ""
        alike = next((group & said.keys() for group in groups if best in group), set[str]())
        found.append(said | dict.fromkeys(sorted(alike), said.get(best, 0.0)))
    return found
