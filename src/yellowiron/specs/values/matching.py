"""Claims × wanted values: which claim speaks of which wanted value, and how surely."""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, field, replace

from yellowiron.model.template import Wanted
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import (
    CIRCUITS,
    GENERAL,
    HARMLESS,
    KNOWN,
    NEUTRAL,
    OPPOSITES,
    REVERSING,
    TELLING,
    VAGUE,
    ends,
    has_cjk,
    is_one_place,
    names_a_part,
    squeezed,
    tokens,
)
from yellowiron.specs.values.claims import Claim, names_model
from yellowiron.specs.values.contention import (
    Match,
    add_twins,
    ends_told_apart,
    is_gear,
    is_possible,
    row_name,
    without_lone_gears,
    without_shared_headings,
)
from yellowiron.specs.values.requested import phrases
from yellowiron.specs.values.tolerances import LEAST

_EXTREME = {"maximum"}
"""Says of a label no more than makers mean without it; a value of which both are asked forbids it."""
_PLAIN = [{"height"}, {"length"}, {"width"}, {"depth"}]
"""What anything has: "maximum" beside it tells no more than it does alone."""
_MEASURES = {"height", "length", "width", "depth", "diameter", "weight"}
_SAYS_NOTHING = NEUTRAL | GENERAL | HARMLESS | VAGUE | TELLING
_WHOLE = {"overall"}
"""Says of a part no more than makers mean without it: the overall width of a bucket is its width."""
_RATED = {"flow", "pressure", "force", "torque"}
"""Dimensions of values that are printed for their maximum, whether the label says so or not."""
_BY_CIRCUIT = {"pressure", "flow"}
"""Dimensions of which every hydraulic circuit has its own value."""
_BORROWED = 0.1
"""The most that words cost that are borrowed from headings."""
_UNSAID = 0.2
"""What it costs that a label does not say "maximum" where the greatest value and another one are asked for."""
_TITLE = 5
"""The most words of a heading; what has more is a product's name: a title that says "with lift" names no lift."""
_OFTEN = 3
"""Languages that must agree before one word of another one counts as a slip."""
_REMARK = 0.02
"""What a word costs that is left over and says nothing else: enough to prefer a value that it does speak of."""


def match(claims: Sequence[Claim], wanted: Sequence[Wanted]) -> dict[str, list[Match]]:
    """The matches by wanted name. A claim that one wanted value explains better does not count for another."""
    found: dict[str, list[Match]] = {w.name: [] for w in wanted}
    by_dimension = {
        d: _asked(tuple(w for w in wanted if w.dimension == d)) for d in {w.dimension: None for w in wanted}
    }
    known: dict[tuple[object, ...], list[Match]] = {}  # the cells of a row say the same
    for claim in claims:
        said, dimension = _said(claim), claim.quantity.dimension
        place = claim.statement
        words = (dimension, row_name(claim), claim.head, place.column, place.context, place.section, place.running)
        if words not in known:
            every = (_match(a, claim, said) for a in by_dimension.get(dimension, ()))
            known[words] = [m for m in every if m is not None and m.score >= LEAST]
        matches = [m if m.claim is claim else replace(m, claim=claim) for m in known[words]]
        if not matches:
            continue
        if any(m.by_label for m in matches):
            matches = [m for m in matches if m.by_label]
        matches = _of_part(_of_possible(matches, said))
        best = max((m.score, _specific(m)) for m in matches)
        kept = [m for m in matches if m.score >= best[0] - 1e-9 and (m.score > 0.999 or _specific(m) >= best[1])]
        kept = _by_own_name(kept)
        for one in kept:
            # Both the angle and the greatest one are asked for: a label that does not say "maximum" is the latter only
            # where no other label does.
            unsaid = len(kept) > 1 and (_EXTREME & set(tokens(one.wanted.name))) - said.label - said.head - said.context
            found[one.wanted.name].append(replace(one, score=one.score - _UNSAID) if unsaid else one)
    add_twins(found, claims)
    without_lone_gears(found)
    return ends_told_apart({name: without_shared_headings(own) for name, own in found.items()}, wanted)


def _by_own_name(matches: list[Match]) -> list[Match]:
    """The matches without those of values that are called by the same words as another's own name: what is labelled
    "fork length" is no length over forks."""

    def telling(phrase: str) -> frozenset[str]:
        return frozenset(tokens(phrase)) - HARMLESS - NEUTRAL

    own = [telling(m.phrase) == telling(m.wanted.name) for m in matches]
    names = {telling(m.phrase) for m, is_own in zip(matches, own, strict=True) if is_own}
    return [m for m, is_own in zip(matches, own, strict=True) if is_own or telling(m.phrase) not in names]


def _of_part(matches: Sequence[Match]) -> list[Match]:
    """The matches without those of the machine where a sub-heading makes their words a part's: "Blade | Height"."""
    named = [(m, frozenset(tokens(m.phrase))) for m in matches]
    parts = [frozenset(tokens(c)) for m in matches[:1] for c in m.claim.statement.context if names_a_part(c)]
    return [
        m
        for m, words in named
        if words == frozenset(tokens(m.wanted.name))  # a "Shoe width" under "Undercarriage" is no undercarriage's
        or not any(words < other and other - words in parts for _, other in named)
    ]


def _of_possible(matches: Sequence[Match], said: _Said) -> list[Match]:
    """The matches of values that can be so much; where one that cannot says more of the label, its further words there
    are left over: the boom's length is no machine's, though it be too short for the boom."""
    possible = [m for m in matches if is_possible(m)]
    impossible = [m for m in matches if not is_possible(m)]
    if not possible or not impossible:
        return list(matches)
    closest = max(impossible, key=_specific)
    if _specific(closest) <= max(map(_specific, possible)):
        return possible
    words = set(tokens(closest.phrase)) & (said.label | said.head | said.context)
    return [replace(m, rest=m.rest or tuple(sorted(words - set(tokens(m.phrase))))) for m in possible]


def _specific(found: Match) -> int:
    return len(tokens(found.phrase))


@dataclass(frozen=True)
class _Asked:
    """A wanted value's words, cut once: its phrases, all their words, its name's; headings that support it, phrases
    that forbid it. `others`: by word, the values of its dimension that have it, each with the words of its phrase."""

    wanted: Wanted
    phrases: tuple[tuple[str, frozenset[str]], ...]
    words: frozenset[str]
    name: frozenset[str]
    sections: tuple[frozenset[str], ...]
    forbidden: tuple[tuple[str, frozenset[str]], ...]
    others: Mapping[str, Sequence[tuple[_Asked, frozenset[str]]]] = field(default_factory=dict)


@dataclass(frozen=True)
class _Said:
    """A claim's words, cut once. `naming` are the heads that name properties and not configurations, `standard` the
    label's words for the standard equipment, with which any value holds."""

    label: frozenset[str]
    head: frozenset[str]
    contexts: tuple[frozenset[str], ...]
    section: frozenset[str]
    naming: tuple[frozenset[str], ...]
    text: str
    ends: tuple[frozenset[str], ...]
    standard: frozenset[str]

    @property
    def context(self) -> frozenset[str]:
        """The words of all sub-headings."""
        return frozenset[str]().union(*self.contexts)


@functools.lru_cache(maxsize=256)
def _asked(wanted: tuple[Wanted, ...]) -> tuple[_Asked, ...]:
    """Values of one dimension, each knowing the words of all."""
    alone = [_alone(one) for one in wanted]
    others: dict[str, list[tuple[_Asked, frozenset[str]]]] = {}
    for one in alone:
        for _, words in one.phrases:
            for word in words:
                others.setdefault(word, []).append((one, words))
    return tuple(replace(one, others=others) for one in alone)


@functools.lru_cache(maxsize=4096)
def _alone(wanted: Wanted) -> _Asked:
    said = tuple((p, words) for p, words in _with_words(phrases(wanted)) if words)
    if wanted.dimension == "length":
        said = tuple((p, words) for p, words in said if not is_one_place(words))
    return _Asked(
        wanted=wanted,
        phrases=said,
        words=frozenset[str]().union(*(words for _, words in said)),
        name=frozenset(tokens(wanted.name)),
        sections=tuple(words for _, words in _with_words(tuple(wanted.sections)) if words),
        forbidden=_with_words(tuple(wanted.forbidden)),
    )


@functools.lru_cache(maxsize=4096)
def _with_words(texts: tuple[str, ...]) -> tuple[tuple[str, frozenset[str]], ...]:
    return tuple((text, frozenset(tokens(text))) for text in texts)


def _said(claim: Claim) -> _Said:
    statement = claim.statement
    said = _cut(claim.words, claim.head, statement.column, statement.context, statement.section)
    return _geared(said, row_name(claim)) if claim.quantity.dimension == "speed" else said


def _geared(said: _Said, words: str) -> _Said:
    """What a row says that is called by its gear alone ("R", "R2"), in a list of speeds or gears: that it is the travel
    speed of a gear, or one in reverse."""
    above = said.label | said.head | said.context | said.section
    if not is_gear(words) or not _GEARED & above or ("forward" in above and not {"gear", "travel"} & said.label):
        return said
    reverse = {"reverse"} if any(re.fullmatch(r"r\d?|reverse", t) for t in said.label) else set()
    return replace(said, label=frozenset({"travel", "speed", "gear", *reverse}))


_GEARED = {"gear", "shift", "speed", "transmission"}
"""What heads rows that are called by their gears."""


@functools.lru_cache(maxsize=4096)
def _cut(words: str, head: str, column: tuple[str, ...], context: tuple[str, ...], section: str) -> _Said:
    heads = [h for h in column if not _names_configuration(h)]
    context = tuple(_ASIDE.sub(" ", c) for c in context)
    label = words
    if context and names_model(words):  # "Shipping weight", and under it a row for each model
        label = ""
    elif context and _LEADS.search(context[-1]) and not tokens(words):  # in several languages over its value
        label, context = " ".join(context), ()
    if context and tokens(whole := f"{context[-1]} {label}") != tokens(context[-1]) + tokens(label):
        label, context = whole, context[:-1]  # an expression goes on from the line above: "rod" over "diameter"
    return _Said(
        label=frozenset(tokens(label)),
        head=frozenset(tokens(head)),
        contexts=tuple(frozenset(tokens(c)) for c in context),
        section=frozenset(tokens(section)),
        naming=tuple(frozenset(tokens(h)) for h in heads),
        text=" ".join([words, *heads]).casefold(),
        ends=ends(label) or (),
        standard=frozenset(t for tail in _STANDARD.findall(label) for t in tokens(tail)),
    )


_ASIDE = re.compile(r"\((?:without|w/o|ohne|sans|sin|senza|sem)\b[^()]*\)", re.IGNORECASE)
"""What a heading lacks, its rows do not: "Base machine (without front linkage) | Counterweight"."""
_LEADS = re.compile(r"[:：]\s*$")
_STANDARD = re.compile(r"\b(?:with|mit|avec|con)\s+(?:\w+ )?(?:std\b|standard|basic|est[aá]ndar|serien)[^,;:/]*$", re.I)


def match_one(wanted: Wanted, claim: Claim, among: Sequence[Wanted] = ()) -> Match | None:
    """How well a claim speaks of a wanted value, `among` others; None where it cannot: dimension, forbidden words,
    words that are missing."""
    if claim.quantity.dimension != wanted.dimension:
        return None
    asked_for = _asked((wanted, *(w for w in among if w is not wanted and w.dimension == wanted.dimension)))
    return _match(asked_for[0], claim, _said(claim))


def _match(asked_for: _Asked, claim: Claim, said: _Said) -> Match | None:
    wanted = asked_for.wanted
    label, head, context, section = said.label, said.head, said.context, said.section
    if not (label | head | context | section) & asked_for.words:
        return None
    if not claim.statement.label and not claim.statement.running and read(wanted.name):
        return None  # "2240 mm Level Bottom" is the label of another value
    supported = _supports(asked_for, section)
    headings = [*said.contexts, *([] if section <= GENERAL or len(section) > _TITLE else [section])]
    above = [words for words in headings if not _supports(asked_for, words)]
    times = _times_said(asked_for, claim)
    own = label - said.standard
    if times >= _OFTEN:  # what one of several languages says alone is its translator's word
        own = frozenset(t for t in own if tokens(claim.words).count(t) > 1)
    if _forbidden(asked_for, claim, said.text, [own, *said.naming, *above]):
        return None
    circuits = label.union(*said.naming) | context | section
    if wanted.dimension in _BY_CIRCUIT and (circuits & CIRCUITS) - asked_for.words:
        return None
    found = _explanation(asked_for, said, supported=supported)
    if found is None:
        return None
    explained, from_head, borrowed, best = found.words, found.from_head, found.borrowed, found.phrase
    primary = (label if explained & label else set()) | (head if from_head else set()) or context | section
    if primary <= _EXTREME:  # "Total retardation power", and beside it "721 kW Maximum": what it is the most of counts
        primary = primary | (said.contexts[-1] if said.contexts else section)
    # A word of the value's own name makes the label mean nothing else.
    left = {t for t in primary - explained - _EXTREME - asked_for.name if not _is_number(t)}
    left = {t for t in left if t not in NEUTRAL or _is_telling(t, asked_for, explained | left, claim, said, KNOWN)}
    left -= said.standard | (frozenset() if from_head else _WHOLE)
    left -= {"speed"} if wanted.dimension == "time" else set()  # "Boom extension speed: 21 m/80 s"
    if times > 1:  # what nothing is known of are the words of further languages
        left &= (KNOWN | TELLING) & (own | TELLING)
    known = frozenset() if borrowed else KNOWN  # a heading that must help names other properties too
    rest = {t for t in left if _is_telling(t, asked_for, explained | left, claim, said, known)}
    lent = explained - label - head
    headed = bool(from_head) and not explained & label
    for words in (label, *said.contexts, section) if headed else said.contexts:
        if headed or words & lent:  # it may name another one's part: "lift arm cylinder", "Total weight" of "Buckets"
            named = words - explained - (frozenset() if headed else asked_for.words)
            rest |= {t for t in named if _is_others(t, asked_for, explained | words, claim, said)}
    bare = {t for t in label if len(t) > 1}
    if bare <= _MEASURES:  # the width of an "Upper protection screen" is no structure's
        for words in (*said.contexts, section):
            rest |= {t for t in words - explained - _SAYS_NOTHING if words & lent and t.isalpha() and t not in KNOWN}
    if _WHOLE & asked_for.name:  # a "Boom"'s own "Height" is not the machine's over its boom
        parts = (lent if bare and bare <= _MEASURES else set()) | (label if headed else set())
        rest |= {t for t in parts - asked_for.name if names_a_part(t)}
    worded = frozenset[str]().union(*(words for words in said.naming if not any(map(_is_number, words))))
    if ((label | context | section | worded) - explained) & REVERSING:  # the head "VS 135" is a model
        return None
    if not (label | head) & _MEASURES and _leads_elsewhere(asked_for, claim, said):
        return None
    asked = {t for p in (wanted.name, best) for t in tokens(p)}
    if any(_contradicts(group - explained, asked - group) for group in (label, head, context, section)):
        return None
    lost = len(rest) / max(len(primary - NEUTRAL - _WHOLE), 1) + _REMARK * len(left - rest)
    score = 1.0 - lost - borrowed
    return Match(
        wanted, claim, max(score, 0.0), best, tuple(sorted(rest)), lost, bool(explained & label), bool(from_head)
    )


_MACHINES = {"forklift", "telehandler", "grader"}
"""Machines that are no part of another one."""


@dataclass(frozen=True)
class _Explanation:
    """What a value's phrases explain of a claim: the words, those of them that only heads say, what is taken off for
    headings that had to help, and the longest phrase."""

    words: frozenset[str]
    from_head: frozenset[str]
    borrowed: float
    phrase: str


def _explanation(asked_for: _Asked, said: _Said, *, supported: bool) -> _Explanation | None:
    """The phrases of a value that a claim says in full, taken together; None where it says none. `supported`: its
    section is one under which makers print the value."""
    wanted, label, head, context, section = asked_for.wanted, said.label, said.head, said.context, said.section
    everything = label | head | context | section
    by_itself = any(words <= label for _, words in asked_for.phrases)
    optional = (_EXTREME if wanted.dimension in _RATED else set()) - everything
    # What names the model of the column, too, or the machine, is the page's title.
    title = bool((section & head) - KNOWN - NEUTRAL | section & _MACHINES)
    nearest = said.contexts[-1] if said.contexts else section  # a title over "Specifications" is the machine's
    headed = bool(wanted.sections) and not nearest <= GENERAL and not title and wanted.dimension != "time"
    vague = VAGUE if headed else frozenset[str]()
    # One word alone is little: beside it only what no other value's words have passes for a remark.
    remarks = HARMLESS - asked_for.others.keys()
    explained: frozenset[str] = frozenset()
    from_head: frozenset[str] = frozenset()
    borrowed = 1.0
    best, most = "", 0
    for phrase, words in asked_for.phrases:
        words = words - optional if optional else words
        if by_itself and words & head - label - context - section:
            continue  # the label says it without its column's head
        if not words or not words <= everything or not _anchored(words, label, head, context | section):
            continue
        if any(words & end for end in said.ends) and not all(words & end for end in said.ends):
            continue  # a distance from the same place to another one
        if (
            (len(words) == 1 or words - _EXTREME in _PLAIN)
            and not supported
            and (words <= vague or label - words - NEUTRAL - _WHOLE - remarks)
        ):
            continue
        explained |= words
        from_head |= words - label - context - section
        lent = words - label - head
        borrowed = min(borrowed, 0.5 * _BORROWED * (bool(lent) + bool(lent - context)))
        if len(words) > most:
            best, most = phrase, len(words)
    return _Explanation(explained, from_head, borrowed, best) if explained else None


def _is_telling(
    word: str, asked_for: _Asked, words: Set[str], claim: Claim, said: _Said, known: frozenset[str]
) -> bool:
    """Whether a word that is left over may make the label mean another property: a condition or another body; what
    tells this value from another one of its dimension; a word that nothing is known of."""
    if word in TELLING or (word not in asked_for.words and _is_others(word, asked_for, words, claim, said)):
        return True
    foreign = word not in KNOWN or word not in {*asked_for.words, *asked_for.others}  # no cylinder has an angle
    if word in HARMLESS or word in NEUTRAL or (foreign and _opens_sentence(word, asked_for, claim)):
        return False
    return not (word in known and word in asked_for.words)


def _is_others(word: str, asked_for: _Asked, words: Set[str], claim: Claim, said: _Said) -> bool:
    """Whether a word, with others of `words`, is another value's phrase."""
    return any(
        phrase <= words and not _forbidden(other, claim, said.text, [said.label, *said.naming, *said.contexts])
        for other, phrase in asked_for.others.get(word, ())
    )


def _times_said(asked_for: _Asked, claim: Claim) -> int:
    """How many times a label says a phrase of several words of a value: once for each language."""
    order = tokens(claim.words)
    said = [min(map(order.count, words)) for _, words in asked_for.phrases if len(words) > 1]
    return max(said, default=0)


def _opens_sentence(word: str, asked_for: _Asked, claim: Claim) -> bool:
    """Whether a word of running text stands before all that name the value: "TWIN-LOCK boom of 51 m". What stands
    between a name and its number may make it another one's."""
    if not claim.statement.running:
        return False
    order = tokens(claim.words)
    first = next((i for i, t in enumerate(order) if t in asked_for.words), 0)
    return word in order[:first] and word not in order[first:]


def _anchored(words: Set[str], label: Set[str], head: Set[str], above: Set[str]) -> bool:
    """Whether the statement's own label or head holds part of a phrase: headings alone name no property, unless the
    value has no label at all."""
    if words & label:
        return True
    if words & head:
        return len(words & head) >= 1
    return not label and all(map(_is_number, head)) and words <= above  # numbers over a column are models


def _leads_elsewhere(asked_for: _Asked, claim: Claim, said: _Said) -> bool:
    """Whether a sub-heading that leads on to its rows says another measure than the value's name: under "add to basic
    tractor length:" no "Ripper (raised)" is a height."""
    asked = asked_for.name & _MEASURES
    above = zip(claim.statement.context, said.contexts, strict=False)  # the last may have gone to the label
    leading = next((words & _MEASURES for text, words in above if _LEADS.search(text)), frozenset[str]())
    return bool(asked and leading) and not leading & asked


def _contradicts(words: Set[str], asked: Set[str]) -> bool:
    """Whether one of the words is the opposite of one asked for: a front axle, where the rear one is meant."""
    return any(OPPOSITES.get(word, frozenset()) & asked for word in words)


def _is_number(token: str) -> bool:
    """Whether a word names no property: a number, a standard ("J732"), a model."""
    return any(c.isdigit() for c in token)


@functools.lru_cache(maxsize=4096)
def _names_configuration(head: str) -> bool:
    """Whether a head says which machine a column is for, and not which property: "Reach boom 5.7 m"."""
    return any(q.printed is not None for r in read(head) for q in r.numbers)


def _supports(asked_for: _Asked, heading: frozenset[str]) -> bool:
    """Whether a heading is one under which makers print the value."""
    return any(words <= heading for words in asked_for.sections) if heading else False


def _forbidden(asked_for: _Asked, claim: Claim, text: str, places: Sequence[frozenset[str]]) -> bool:
    """Whether the label, a head or a heading says a forbidden phrase; its words must stand in one of them."""
    for phrase, parts in asked_for.forbidden:
        # As it stands: in words a Chinese or Japanese phrase would forbid the labels of other languages, and one in
        # quotes those of the same words in another order ("blade length" is not the length with the blade).
        if has_cjk(phrase) or phrase.startswith('"'):
            if squeezed(phrase) in squeezed(text + claim.statement.section):
                return True
        elif (parts and any(parts <= words for words in places)) or (not parts and phrase.casefold() in text):
            return True
    return False


def weakly(wanted: Wanted, claim: Claim) -> Match | None:
    """A match too weak to stand alone, for a claim that something else points to: the same dimension, some of the
    words that make the property what it is, none that forbids or contradicts it."""
    statement = claim.statement
    words = {t for text in (claim.words, claim.head, *statement.context, statement.section) for t in tokens(text)}
    named = [set(tokens(p)) - NEUTRAL for p in phrases(wanted)]
    asked = {t for own in named for t in own}
    label = set(tokens(claim.words))
    shared = max((len(own & words) / len(own) for own in named if own), default=0.0)
    if claim.quantity.dimension != wanted.dimension or shared < 0.5 or not (label & asked):
        return None
    said = _said(claim)
    if (
        _forbidden(_alone(wanted), claim, said.text, [frozenset(words)])
        or words & REVERSING
        or _contradicts(words, asked - words)
    ):
        return None
    rest = tuple(sorted(t for t in label - asked - NEUTRAL if not _is_number(t)))
    return Match(wanted, claim, 0.5 * shared, "", rest, 1.0 - 0.5 * shared)
