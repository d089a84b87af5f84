"""Running text → statements: "The wheelbase is 3450 mm." says of a property what a row of a table says."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.units import printed_unit
from yellowiron.specs.language.vocabulary import has_cjk
from yellowiron.specs.layout.rows.lines import TextLine
from yellowiron.specs.layout.statement import EXAMPLE, Statement, join_boxes, split_inline
from yellowiron.specs.pages.words import Word

_END = re.compile(r"[.;!?](?=\s|$)|[。；！？]")
_ABBREVIATION = re.compile(
    r"(?:^|[\s(])(?:max|min|approx|ca|env|aprox|máx|mín|no|nr|n|incl|excl|resp|bzw|vs|std|opt|fig|e\.g|i\.e|z\.b|"
    r"cu|sq|gal|in|ft|lb|lbs|yd|\d{1,2}|(?:[a-z]\.)+[a-z])$",
    re.IGNORECASE,
)
"""What a full stop belongs to without ending a sentence; a unit with one ends it only before a capital."""
_PITCH = 1.9
"""Lines of a paragraph follow each other within this many type sizes."""
_FULL = 0.72
"""Of a paragraph's width: shorter lines end it."""
_NUMBER = re.compile(r"[<>≤≥~±]?\d+(?:[.,\s]\d+)*")
_WORD = re.compile(r"[^\W\d_]{3,}")
_NEXT_IN_LIST = re.compile(r"[^\W\d][)\]]?\s*[,，]\s*$|\d[)\]]\s*,\s*$")
_NAMED_BEHIND = re.compile(r"\s*[^\W\d_]{3,}")
_BROKEN_WORD = re.compile(r"[^\W\d_][-–\u2010]$")
_FEWEST_ROWS = 4
"""Lines that make a list."""
_LONGEST = 16
"""Words before a value; more are about something else."""
_CIRCUMSTANCE = re.compile(
    r"^\W*(?:\d+[.)]\s*)?(?:for|if|when|while|unless|during|für|wenn|bei|pour|si|lorsque|para|cuando)\b|"
    r"(?:\b(?:between|than|below|above|exceed\w*|over|under|unter|über|als|zwischen|entre|plus de|más de|menos de)|"
    r"[<>≤≥])\W*$|时[，,]",
    re.IGNORECASE,
)
"""Words that make what follows a circumstance of the sentence, and no value of its own."""


def paragraphs_of(lines: Sequence[TextLine]) -> list[tuple[TextLine, ...]]:
    """Running text: pieces set flush left or centred under each other, each the last of its line and, from the second
    on, alone on it, with the ends of two sentences (or of one inside the text), or a line's end between a number and
    its unit."""
    groups: list[list[TextLine]] = []
    for line in lines:
        last = groups[-1][-1] if groups else None
        if last is not None and len(line.pieces) == 1 and _follows(last, line):
            groups[-1].append(line)
        else:
            groups.append([TextLine(line.pieces[-1:])])
    return [tuple(g) for g in groups if _is_running(g)]


def _follows(last: TextLine, line: TextLine) -> bool:
    a, b = last.pieces[0], line.pieces[0]
    size = max(a.size, b.size)
    return (
        abs(a.size - b.size) < 0.1 * size
        and min(abs(a.x0 - b.x0), abs(a.x0 + a.x1 - b.x0 - b.x1) / 2) < size  # flush left, or centred
        and 0 < line.bottom - last.bottom < _PITCH * size
        and a.bold == b.bold
        and last.x1 - last.x0 > _FULL * (line.x1 - line.x0)
    )


def _is_list(lines: Sequence[TextLine]) -> bool:
    """Whether most lines are each a name and its value: "Overall width 2.54 m", and under it the next."""
    texts = [line.pieces[0].bare for line in lines]
    rows = sum(text[:1].isupper() and bool(split_inline(text)[0]) for text in texts)
    return rows >= _FEWEST_ROWS and 2 * rows >= len(lines)


def _is_running(lines: Sequence[TextLine]) -> bool:
    if _is_list(lines):
        return False
    if any(_breaks_a_quantity(above, below) for above, below in pairwise(lines)):
        return True
    text, _ = _text_of(lines)
    number = re.search(r"\d", text)
    ends = _ends(text)
    inside = [e for e in ends if number and number.start() < e < len(text.rstrip())]
    if inside or len(lines) == 1 or not ends:
        return bool(inside)
    goes_on = all(line.pieces[0].words[0].text[0].islower() for line in lines[1:])  # "38 – 115 ft", "full power boom."
    return len(text) > 60 or (goes_on and ends[-1] == len(text.rstrip()))


def _breaks_a_quantity(above: TextLine, below: TextLine) -> bool:
    """Whether a line ends with a number behind words, and the next begins with its unit: "Engine Power: 563", "kW"."""
    *before, number = above.pieces[0].words
    unit = printed_unit(below.pieces[0].words[0].text)
    return (
        bool(_NUMBER.fullmatch(number.text))
        and unit is not None
        and any(_WORD.search(w.text) for w in before)
        and len(below.pieces[0].words) > 1
    )


def _text_of(lines: Sequence[TextLine]) -> tuple[str, list[tuple[int, int, Word]]]:
    """The text of a paragraph, and where each of its words stands in it."""
    text = ""
    places: list[tuple[int, int, Word]] = []
    for line in lines:
        for index, word in enumerate(line.pieces[0].words):
            begins_line = index == 0
            glued = not text or (
                begins_line and (has_cjk(text[-1]) or text[-1] in "。；，、）" or has_cjk(word.text[0]))
            )
            if begins_line and _BROKEN_WORD.search(text) and word.text[0].islower():
                text, glued = text[:-1], True
            text += "" if glued else " "
            places.append((len(text), len(text) + len(word.text), word))
            text += word.text
    return text, places


def _ends(text: str) -> list[int]:
    found = []
    for match in _END.finditer(text):
        if match.group(0) == "." and _ABBREVIATION.search(text[max(0, match.start() - 8) : match.start()]):
            following = text[match.end() :].lstrip()[:1]
            measured = re.search(r"\d\s*(?:\w\.)*\w+$", text[: match.start()])  # "1.7 r.p.m."
            if not (measured and (following.isupper() or not following)):
                continue
        found.append(match.end())
    return found


def read_paragraph(page: int, lines: Sequence[TextLine], first_row: int, section: str) -> Iterator[Statement]:
    """The statements of a paragraph: for each quantity of a sentence the words before it, back to the one before."""
    text, places = _text_of(lines)
    firsts = {id(line.pieces[0].words[0]) for line in lines[1:]}
    items = [at for at, _, word in places if id(word) in firsts and word.text[0].isupper()]
    start = 0
    for end in [*_ends(text), len(text)]:
        sentence = text[start:end]
        offset, start = start, end
        edge = before = 0
        owner = ""
        for reading in read(sentence):
            quantities = (*reading.numbers, *reading.partner)
            begin, stop = min(q.start for q in quantities), max(q.end for q in quantities)
            if _NEXT_IN_LIST.search(sentence[:begin]) and _NAMED_BEHIND.match(sentence[stop:]):
                edge = stop  # "Vinyl seat, 800 mm dipper, boom offset": what it is stands behind it
                continue
            label = _label(sentence[edge:begin])
            if not label and quantities[0].dimension != "angle":  # "Dump height at 45°: 2.9 m"
                label = _label(sentence[before:begin])
            elif edge == 0 and (
                listed := re.match(r"^(.*?)[:：]\s*(.+)$", label)
            ):  # "Arm cylinder: bore 9, stroke 20 mm"
                owner, label = listed.group(1), f"{listed.group(1)} {listed.group(2)}"
            elif owner and label and re.match(r"[\s)]*[,，、]", sentence[edge:begin]):
                label = f"{owner} {label}"
            opens = not label and not edge and bool(section)  # under a heading, its name may stand behind a value
            own = min((at for at in items if at > offset + stop), default=end) - offset  # a list's next item
            label = label or (_behind(sentence[stop:own]) if opens else "")
            if label and (said := re.match(r"[\s)]*\(([^()\d]+)\)", sentence[stop:])):  # "298 kW (gross)"
                label = f"{label} {said.group(1)}"
            if label and (of := re.match(r"\s+of\s+(?=[^\W\d])", sentence[stop:])):  # "8.9 m of dig depth"
                label = f"{label} {_behind(sentence[stop + of.end() : own])}"
            told = bool(label) or (opens and not offset)
            if (
                told
                and (not reading.condition or quantities[0].dimension == "angular_speed")  # "smooth swing at 2 rpm"
                and not _CIRCUMSTANCE.search(sentence[:begin])
                and len(label.split()) <= _LONGEST
            ):
                boxes = [w.box for a, b, w in places if a < offset + stop and b > offset + begin]
                yield Statement(
                    page=page,
                    row=first_row,
                    label=label,
                    text=EXAMPLE.sub("", sentence[begin:stop]).strip() + ")" * _opened(sentence[begin:stop]),
                    box=join_boxes(boxes),
                    quote=sentence.strip(),
                    section=section,
                    example=bool(EXAMPLE.search(sentence)),
                    x0=boxes[0][0],
                    running=True,
                )
                before, edge = edge, stop
            elif reading.condition and sentence[stop : stop + 1] == " ":  # "for 360° continuous swing", not "at 45°,"
                before, edge = edge, stop
            first_row += 1


def _behind(text: str) -> str:
    """The words right behind a quantity, up to the end of the thought: "four section, full power boom"."""
    return re.split(
        r"[\d;.(]|,(?=.*\d)|\s(?:with|and|for|on|in|at|of|consisting|mit|und|für|avec|et|pour|con|y|para)\b", text
    )[0].strip(" )")


def _opened(text: str) -> int:
    return max(0, text.count("(") - text.count(")"))


_LINK = re.compile(
    r"^[\s,;:)\]–-]*(?:(?:and|or|with|a|an|the|und|oder|mit|et|avec|y|con|e)\s+)*|"
    r"[\s:=(–-]*(?:\s(?:is|are|of|up to|about|equals?|beträgt|ist|sind|von|bis zu|est de|est|sont|de|es de|es|son|"
    r"hasta|atteint|alcanza|reaches|measures|at)|为|是|は|が|：)?[\s:=(]*$",
    re.IGNORECASE,
)


def _label(text: str) -> str:
    """The words before a quantity without what links them to it."""
    return _LINK.sub("", _LINK.sub("", text.strip())).strip(" ,;:")
