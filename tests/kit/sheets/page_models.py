"""Language models that are played: they get a page as `specs.llm.prompts` shows it and answer in its shape.

`truthful` knows what a person read on the page; the others (`LIARS`) know that too, and say something else: other
numbers of the page under the right label, words that stand elsewhere, cells and numbers that there are not, other
columns and rows, what the page prints of another wanted value, and the label that comes nearest to the name with a
value that is not the name's.
"""

from __future__ import annotations

import functools
import json
import os
import random
import re
import zlib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any
from unittest import mock

from openai.types.chat import ChatCompletion

from yellowiron.endpoint import Endpoint
from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import tokens
from yellowiron.specs.layout.statement import is_unit, unit_in_label
from yellowiron.specs.values.claims import BARE_UNITS
from yellowiron.support.units import SI_UNIT, parse_quantity

Truths = Mapping[str, str]
"""Wanted name → the value as printed, with its unit ("4.6 m")."""
Entry = dict[str, Any]
Model = Callable[["Question"], list[Entry]]
_COUNTS = {
    word: number for number, word in enumerate(["two", "three", "four", "five", "six", "seven", "eight"], start=2)
}
_UNITS = {**BARE_UNITS, "angle": ("°",), "time": ("s",), "count": ("",), "angular_speed": ("rpm",)}


@dataclass(frozen=True)
class Shown:
    """A cell as the question shows it."""

    number: int
    line: int
    y: float
    x0: float
    x1: float
    text: str

    @functools.cached_property
    def is_text(self) -> bool:
        words = re.sub(r"^\W*\d[\d.,]*(?:st|nd|rd|th)?\s+(?=[^\W\d_]{4})", "", self.text)  # "3.0 Forward", "4th gear"
        return not re.match(r"[^\w]*\d", words) and bool(re.search(r"[^\W\d_]{3,}", words))


@dataclass(frozen=True)
class Asked:
    """A wanted value as the question describes it."""

    name: str
    dimension: str
    words: frozenset[str]


@dataclass(frozen=True, eq=False)
class Question:
    """A question: the page's number and cells, what is wanted, which machine is meant, and the request's text."""

    page: int
    cells: tuple[Shown, ...]
    wanted: tuple[Asked, ...]
    config: str
    text: str

    def left_of(self, cell: Shown) -> Shown | None:
        row = [
            c
            for c in self.cells
            if abs(c.y - cell.y) < 8 and c.x1 <= cell.x0 + 1 and c.is_text and not re.search(r"\d\s?m?m\b", c.text)
        ]
        return max(row, key=lambda c: (c.x1, -abs(c.y - cell.y))) if row else None

    def row_before(self, cell: Shown) -> list[Shown]:
        """All words to the left of a cell on its row."""
        return [c for c in self.cells if abs(c.y - cell.y) < 8 and c.x1 <= cell.x0 + 1 and c.is_text]

    def above(self, cell: Shown, most: float = 1e9) -> list[Shown]:
        found = [c for c in self.cells if 2 < cell.y - c.y < most and c.x0 < cell.x1 and cell.x0 < c.x1]
        return sorted(found, key=lambda c: -c.y)


@functools.lru_cache(maxsize=1024)
def question_of(text: str) -> Question:
    """A question out of the words that are sent."""
    sheet = text[text.index("<sheet>") + 7 : text.index("</sheet>")].strip()
    rest = text[text.index("</sheet>") :]
    wanted = [
        Asked(m[1], m[2], frozenset(tokens(f"{m[1]} {m[3]}")))
        for m in re.finditer(r"^- (.*?) \((\w+)(?:;[^;)]*)?(?:; also called ([^)]*))?", rest, re.MULTILINE)
    ]
    meant = re.search(r"The machine meant is: (.*)\. Take", rest)
    page = re.match(r"page (\d+)", sheet)
    assert page is not None
    return Question(int(page[1]), _cells_of(sheet), tuple(wanted), meant[1] if meant else "", text)


class _Cells(tuple["Shown", ...]):
    """A page's cells, the same only as themselves: what is kept of a page is kept by them."""

    __hash__ = object.__hash__

    def __eq__(self, other: object) -> bool:
        return self is other


@functools.lru_cache(maxsize=1024)
def _cells_of(sheet: str) -> _Cells:
    cells = []
    for number, line in enumerate(sheet.splitlines()):
        if head := re.match(r"y=(-?\d+): ", line):
            for m in re.finditer(r"\[(\d+) x=(-?\d+)-(-?\d+)\] (.*?)(?= \| \[\d+ x=|$)", line):
                cells.append(Shown(int(m[1]), number, float(head[1]), float(m[2]), float(m[3]), m[4]))
    return _Cells(cells)


@dataclass(frozen=True)
class Pair:
    """A number of a cell and a label that may be its own, with the share of the name's words that it says."""

    cell: Shown
    number: str
    value: float
    label: Shown
    share: float


def pairs(question: Question, asked: Asked) -> list[Pair]:
    """The numbers of a dimension on the page, each with the words before, beside, above and below it."""
    return list(_shared(question.cells, asked))


@functools.lru_cache(maxsize=16384)
def _shared(cells: tuple[Shown, ...], asked: Asked) -> tuple[Pair, ...]:
    return tuple(
        Pair(p.cell, p.number, p.value, p.label, len(asked.words & words) / max(len(words), 1))
        for p, words in _pairs(cells, asked.dimension)
    )


@functools.lru_cache(maxsize=1024)
def _labelled(cells: tuple[Shown, ...]) -> tuple[tuple[Shown, tuple[Shown, ...]], ...]:
    """The cells, those with a number each with the words before, beside, above and below it."""
    page = Question(0, cells, (), "", "")
    found: list[tuple[Shown, tuple[Shown, ...]]] = []
    for cell in cells:
        labels: list[Shown] = []
        if any(c.isdigit() for c in cell.text):
            above = page.above(cell, 90)
            near = [c for c in above if cell.y - c.y < 25][:1]
            labels = [c for c in (page.left_of(cell), *near) if c is not None and c.is_text]
            labels += [c for c in page.row_before(cell) if c not in labels]
            labels += [c for c in above if c.is_text and c not in labels][:1]
            labels += [c for c in cells if 2 < c.y - cell.y < 20 and c.x0 < cell.x1 and cell.x0 < c.x1 and c.is_text]
        found.append((cell, tuple(c for c in labels if not is_unit(c.text))))
    return tuple(found)


@functools.lru_cache(maxsize=4096)
def _pairs(cells: tuple[Shown, ...], dimension: str) -> tuple[tuple[Pair, frozenset[str]], ...]:
    found: dict[tuple[int, str, float, int], tuple[Pair, frozenset[str]]] = {}
    for cell, labels in _labelled(cells):
        if dimension == "count" and (word := re.search(rf"\b({'|'.join(_COUNTS)})\b", cell.text, re.IGNORECASE)):
            pair = Pair(cell, word[0], float(_COUNTS[word[0].lower()]), cell, 0.0)
            found[cell.number, word[0], pair.value, cell.number] = pair, frozenset(tokens(cell.text))
        if not any(c.isdigit() for c in cell.text):
            continue
        for unit in _UNITS.get(dimension, ("",)):
            for reading in read(cell.text, unit=unit):
                for quantity in (*reading.numbers, *reading.partner):
                    number = re.search(r"\d[\d.,\s]*\d|\d", quantity.text)
                    if quantity.dimension != dimension or number is None:
                        continue
                    ends = [q.end for r in read(cell.text) for q in (*r.numbers, *r.partner) if q.end <= quantity.start]
                    before = cell.text[max(ends, default=0) : quantity.start].strip(" :/,;.")
                    for label in [*([cell] if re.search(r"[^\W\d_]{3,}", before) else []), *labels]:
                        words = frozenset(tokens(before if label is cell else label.text))
                        for value in {quantity.si_value, quantity.si_value * (reading.count or 1)}:
                            key = (cell.number, number[0].strip(), value, label.number)
                            pair = Pair(cell, number[0].strip(), value, label, 0.0)
                            found.setdefault(key, (pair, words))
    return tuple(found.values())


def _between(question: Question, pair: Pair) -> list[Shown]:
    """The words that go on with a label on its row, before the number: "Turning radius | minimum outside | mm"."""
    row = sorted((c for c in question.cells if c.line == pair.cell.line), key=lambda c: c.x0)
    if pair.label is pair.cell or pair.label not in row:
        return []
    words = row[row.index(pair.label) + 1 : row.index(pair.cell)]
    return [c for c in words if c.is_text and not is_unit(c.text)]


def entry(question: Question, asked: Asked, pair: Pair, **other: Any) -> Entry:
    """What a model says that points to a pair."""
    row = sorted((c for c in question.cells if c.line == pair.cell.line), key=lambda c: c.x0)
    at = row.index(pair.cell)
    beside = [c for c in row[max(0, at - 1) : at + 2] if is_unit(c.text)]
    if not beside and at + 1 == len(row) and pair.cell.text.endswith(pair.number):
        following = [c for c in question.cells if c.line == pair.cell.line + 1][:1]
        beside = [c for c in following if is_unit(c.text.split()[0])]
    headed = [c for c in question.above(pair.cell) if is_unit(c.text) or unit_in_label(c.text)[1]][:1]
    bare = not re.search(r"\d\s*[^\W\d]|[°\"']", pair.cell.text)
    said = {
        "name": asked.name, "value_cell": pair.cell.number, "value": pair.number,
        "label_cells": [pair.label.number, *(c.number for c in _between(question, pair))],
        "unit_cell": beside[0].number if beside else 0, "column_cell": headed[0].number if headed and bare else 0,
        "footnote_cell": 0, "words": " ".join(re.findall(r"[^\W\d_]{2,}", pair.label.text)[-3:]),
    }  # fmt: skip
    if pair.label is pair.cell:
        before = pair.cell.text[: pair.cell.text.index(pair.number)]
        behind = pair.cell.text[pair.cell.text.index(pair.number) :]
        named = re.findall(r"[^\W\d_]{3,}", before)[-2:] or re.findall(r"[^\W\d_]{3,}", behind)[1:2]
        said["words"] = " ".join(
            re.findall(r"[^\W\d_]{2,}", before)[-2:] if pair.number.casefold() not in _COUNTS else named
        )
    return {**said, **other}


@functools.lru_cache(maxsize=4096)
def _quantity(printed: str) -> tuple[float, str]:
    return parse_quantity(printed, where=printed)


def _is(printed: str, value: float) -> bool:
    return _alike(_quantity(printed)[0], value)


def _alike(expected: float, value: float) -> bool:
    return abs(value - expected) <= 2e-3 * abs(expected) + 1e-9


def _is_in_other_unit(printed: str, pair: Pair) -> bool:
    """Whether a number is the printed one but for thousands, whatever unit its page gives it."""
    said, number = re.match(r"[\d.]+", printed), pair.number.replace(",", "").replace(" ", "")
    if said is None or not re.fullmatch(r"\d+(?:\.\d+)?", number):
        return False
    return any(_alike(float(said[0]) * times, float(number)) for times in (1.0, 1e3, 1e-3))


_PLACES = 3
"""Places at most that a truthful model names for a value, the likeliest first."""


def _configured(question: Question, pair: Pair) -> bool:
    return bool(question.config) and any(c.text == question.config for c in question.above(pair.cell))


def truthful(truths: Truths, pages: Mapping[str, int] | None = None) -> Model:
    """Says where the page prints what a person read there, beside which words, and nothing else; `pages`: on which
    page it was."""

    def answer(question: Question) -> list[Entry]:
        found = []
        for asked in question.wanted:
            if asked.name not in truths or (pages and pages.get(asked.name, question.page) != question.page):
                continue
            every = pairs(question, asked)
            right = [p for p in every if _is(truths[asked.name], p.value)]
            # A unit printed for another ("530 m/s" of a lift speed in mm/s): the number is read all the same.
            if not any(p.share for p in right):  # what has as many digits by chance is named by nothing
                right = [p for p in every if p.share and _is_in_other_unit(truths[asked.name], p)] or right
            right.sort(key=lambda p: (_configured(question, p), p.share), reverse=True)
            found += [entry(question, asked, p) for p in right[:1] + [p for p in right[1:_PLACES] if p.share]]
        return found

    return answer


def _dice(question: Question, asked: Asked) -> random.Random:
    return random.Random(zlib.crc32(f"{question.page} {asked.name} {len(question.cells)}".encode()))


def _lying(lie: Callable[[Question, Asked, list[Pair], Truths], Entry | None]) -> Callable[[Truths], Model]:
    def model(truths: Truths) -> Model:
        def answer(question: Question) -> list[Entry]:
            said = (lie(question, asked, pairs(question, asked), truths) for asked in question.wanted)
            return [one for one in said if one is not None]

        return answer

    return model


def _false(asked: Asked, found: list[Pair], truths: Truths) -> list[Pair]:
    return [p for p in found if asked.name not in truths or not _is(truths[asked.name], p.value)]


def _other_number(question: Question, asked: Asked, found: list[Pair], truths: Truths) -> Entry | None:
    """The best label, and a number from elsewhere."""
    wrong = _false(asked, found, truths)
    if not wrong:
        return None
    label = max(found, key=lambda p: p.share).label
    other = _dice(question, asked).choice(wrong)
    said = entry(question, asked, other)
    words = " ".join(re.findall(r"[^\W\d_]{2,}", label.text)[-3:])
    return {**said, "label_cells": [label.number], "words": words}


def _borrowed(question: Question, asked: Asked, found: list[Pair], truths: Truths) -> Entry | None:
    """A number with its own label, and the name's words, wherever they stand."""
    wrong = _false(asked, found, truths)
    if not wrong:
        return None
    there = [c for c in question.cells if asked.words & set(tokens(c.text))]
    words = there[0].text if there else asked.name
    return entry(question, asked, _dice(question, asked).choice(wrong), words=words)


def _invented(question: Question, asked: Asked, found: list[Pair], truths: Truths) -> Entry | None:
    """Cells and numbers that there are not."""
    dice = _dice(question, asked)
    at = found[0].cell.number if found and dice.random() < 0.5 else len(question.cells) + 7
    said = {"name": asked.name, "value_cell": at, "value": str(dice.randrange(100, 9999)), "label_cells": [at]}
    return {**said, "unit_cell": 0, "column_cell": 0, "footnote_cell": 0, "words": asked.name}


def _wrong_column(question: Question, asked: Asked, found: list[Pair], truths: Truths) -> Entry | None:
    """The right row, another cell of it; the head of the asked model over it, if there is one."""
    right = [p for p in found if asked.name in truths and _is(truths[asked.name], p.value)]
    best = max(right or found, key=lambda p: p.share, default=None)
    row = [p for p in _false(asked, found, truths) if best and abs(p.cell.y - best.cell.y) < 3]
    if best is None or not row:
        return None
    heads = [c.number for c in question.cells if question.config and c.text == question.config]
    other = _dice(question, asked).choice(row)
    return entry(question, asked, other, label_cells=[best.label.number], column_cell=heads[0] if heads else 0)


def _other_row(question: Question, asked: Asked, found: list[Pair], truths: Truths) -> Entry | None:
    """The right label, and the number right over or under its own."""
    right = [p for p in found if asked.name in truths and _is(truths[asked.name], p.value)]
    best = max(right, key=lambda p: p.share, default=None)
    near = [
        p
        for p in _false(asked, found, truths)
        if best and p.cell.x0 < best.cell.x1 and best.cell.x0 < p.cell.x1 and 0 < abs(p.cell.y - best.cell.y) < 40
    ]
    if best is None or not near:
        return None
    words = " ".join(re.findall(r"[^\W\d_]{2,}", best.label.text)[-3:])
    other = min(near, key=lambda p: abs(p.cell.y - best.cell.y))
    return entry(question, asked, other, label_cells=[best.label.number], words=words)


def _others_value(question: Question, asked: Asked, found: list[Pair], truths: Truths) -> Entry | None:
    """What the page prints of another wanted value, with that one's label, under the name asked for."""
    told = (_quantity(text) for name, text in truths.items() if name != asked.name)
    others = sorted({value for value, unit in told if unit == SI_UNIT.get(asked.dimension)})
    wrong = [p for p in found if any(_alike(value, p.value) for value in others)]
    wrong = _false(asked, wrong, truths)
    return entry(question, asked, max(wrong, key=lambda p: p.share)) if wrong else None


def _near_miss(question: Question, asked: Asked, found: list[Pair], truths: Truths) -> Entry | None:
    """The label that says most of the name, of those whose value is not the name's."""
    wrong = _false(asked, found, truths)
    return entry(question, asked, max(wrong, key=lambda p: p.share)) if wrong else None


LIARS: Mapping[str, Callable[[Truths], Model]] = {
    "other numbers": _lying(_other_number),
    "borrowed words": _lying(_borrowed),
    "invented": _lying(_invented),
    "wrong columns": _lying(_wrong_column),
    "wrong rows": _lying(_other_row),
    "another's value": _lying(_others_value),
    "near misses": _lying(_near_miss),
}


def completion(text: str) -> dict[str, Any]:
    """An endpoint's answer that says a text."""
    return {
        "id": "1", "object": "chat.completion", "created": 0, "model": "m",
        "choices": [{"index": 0, "finish_reason": "stop", "message": {"role": "assistant", "content": text}}],
        "usage": {"prompt_tokens": 100, "completion_tokens": 10, "total_tokens": 110},
    }  # fmt: skip


@contextmanager
def at_hand(model: Model) -> Iterator[list[Question]]:
    """The model answers in this process, without a server; what was asked. Nothing is kept on disk: the next model
    would be given this one's answers."""
    asked: list[Question] = []

    def answered(self: Endpoint, messages: Any, schema: Any, rung: str) -> ChatCompletion:
        text = next(m["content"] for m in messages if m["role"] == "user")
        asked.append(question_of(text))
        return ChatCompletion.model_validate(completion(json.dumps({"values": model(asked[-1])})))

    with mock.patch.object(Endpoint, "_completion", answered), mock.patch.dict(os.environ, YELLOWIRON_CACHE="off"):
        yield asked


__all__ = ["LIARS", "Model", "Question", "at_hand", "completion", "question_of", "truthful"]
