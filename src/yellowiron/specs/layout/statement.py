"""The unit of a sheet: one value cell with the words that say what it is."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from yellowiron.specs.language.numbers import Reading, read
from yellowiron.specs.language.quantities import FEET_INCHES
from yellowiron.specs.language.units import printed_unit, unit_pattern
from yellowiron.specs.layout.tolerances import LONGEST_LABEL
from yellowiron.specs.pages.strokes import Box
from yellowiron.specs.pages.words import Word

EXAMPLE = re.compile(
    r"[(\[]?\s*\b(?:example values?|beispielwerte?|valeurs? d'exemple|valor(?:es)? de ejemplo)\b\s*[)\]]?",
    re.IGNORECASE,
)
"""How a sheet marks a value as its publisher's own example."""
COUNTED = re.compile(
    r"\b(?:number|quantity|qty|no\.|nos\.|count|anzahl|stückzahl|nombre|número|cantidad|n[º°])(?!\w)|"
    r"\b(?:rollers|shoes)\b.*\b(?:each|per) (?:side|track)\b|数量|数目|个数|片数|本数|枚数|段数|节数",
    re.IGNORECASE,
)
"""Labels whose bare numbers count things, whatever unit the heading gives to the others."""
_MARK = re.compile(r"(?<=[\w)\"'°³²%])\s*[*†‡§¤◊]+$|^[*†‡§¤◊]+|(?<=[^\W\d])\d\)$|(?<=\s)\d\)$")
_FEET_HEAD = re.compile(r"\(?\s*(?:ft\.?|feet|′|')\s*[-·.,&/ ]*\s*(?:in\.?|inch(?:es)?|″|\")\s*\)?", re.IGNORECASE)


@dataclass(frozen=True)
class TextPiece:
    """Neighbouring words on one line without a wide gap: a label, a value, a head."""

    words: tuple[Word, ...]

    @functools.cached_property
    def text(self) -> str:
        """The words, a space between them."""
        return " ".join(w.text for w in self.words)

    @property
    def printed(self) -> str:
        """The words with their footnote signs, as the page prints them."""
        return " ".join(w.text + w.marks for w in self.words)

    @functools.cached_property
    def box(self) -> Box:
        """x0, top, x1, bottom."""
        return join_boxes(w.box for w in self.words)

    @property
    def x0(self) -> float:
        """Left edge."""
        return self.words[0].x0

    @functools.cached_property
    def x1(self) -> float:
        """Right edge."""
        return max(w.x1 for w in self.words)

    @functools.cached_property
    def size(self) -> float:
        """Size of its largest word."""
        return max(w.size for w in self.words)

    @functools.cached_property
    def bold(self) -> bool:
        """Whether every word is bold."""
        return all(w.bold for w in self.words)

    @property
    def marks(self) -> str:
        """Footnote signs at its words."""
        found = "".join(w.marks for w in self.words)
        match = _MARK.search(self.text)
        return found + (match.group(0).strip() if match else "")

    @functools.cached_property
    def bare(self) -> str:
        """The text without footnote signs and example marks."""
        text = EXAMPLE.sub("", self.text).strip()
        return _MARK.sub("", text).strip()


@dataclass(frozen=True)
class Statement:
    """One value cell. `label` is its row's, `context` the sub-headings above it (nearest last), `section` the heading,
    `column` the heads over it, `text` what it says; `unit` comes from its head or label, for numbers without one.

    `variant` is what names the row where heads name the properties (a bucket's capacity beside its width). `row` groups
    the cells of one row. `quote` is what the page prints, pieces that stand apart joined by " … "; `heads`
    are the lines over the column as printed, for a quote that needs them. `proven`: whether each part of the quote
    stands together in the file's own text; `running`: whether it is said in a sentence; `guessed`: whether it was read
    from the page's picture. `sheet` is the number of its sheet among those read together, from 0. `slipped`:
    whether its unit stands one row too high or too low.
    """

    page: int
    row: int
    label: str
    text: str
    box: Box
    quote: str
    context: tuple[str, ...] = ()
    section: str = ""
    column: tuple[str, ...] = ()
    unit: str = ""
    example: bool = False
    x0: float = 0.0
    heads: tuple[str, ...] = ()
    variant: tuple[str, ...] = ()
    proven: bool = True
    running: bool = False
    guessed: bool = False
    sheet: int = 0
    slipped: bool = False

    def in_points(self, unit: float) -> Statement:
        """The statement with its place in points, read in units of so many points."""
        return replace(self, box=scaled(self.box, unit), x0=unit * self.x0)


def joined(texts: Iterable[str]) -> str:
    """Texts one after the other: a space between them, but none between two of a script without spaces."""
    result = ""
    for text in texts:
        glued = not result or not text or (_SPACELESS.match(result[-1]) and _SPACELESS.match(text[0]))
        result += text if glued else f" {text}"
    return result


_SPACELESS = re.compile(r"[\u3000-\u30ff\u3400-\u9fff\uff00-\uff60]")


def scaled(box: Box, by: float) -> Box:
    """A box so many times as large, as far from the origin."""
    return (by * box[0], by * box[1], by * box[2], by * box[3])


def join_boxes(boxes: Iterable[Box]) -> Box:
    """The box around all."""
    every = list(boxes)
    return (min(b[0] for b in every), min(b[1] for b in every), max(b[2] for b in every), max(b[3] for b in every))


GRAVITATIONAL = re.compile(r"(?<=[^\s{｛])\s?[{｛][^{}｛｝]*[}｝]")
"""The same in gravitational units, as Japanese sheets print it behind the SI one: "kN{kgf}", "200{20,400}"."""
_AT_SPEED = re.compile(r"(\S+?)\s?[/@]\s?(?:min\s?[-⁻]\s?[1¹]|r/min|rpm|1/min|U/min|tr/min)", re.IGNORECASE)
"""A power or torque over the speed that it is given at: "kW/min-1" for "175/2,000"."""
_AT_RPM = re.compile(r"(?<=[\w)])\s*@\s*(?:\d[\d.,]*\s?)?(?:rpm|r/min|min-1|U/min|tr/min)$", re.IGNORECASE)
"""The speed at which the numbers of a column or row hold: "kW (hp) @ 2100 rpm", "kW (hp) @ rpm"."""
_UNIT_PAIR = re.compile(r"(\S*[^\s(/\[|])\s*[(/\[|]\s*([^()\[\]]+?)\s*[)\]]?")
_KEY = re.compile(
    r"[(\[]?(?:[a-zα-ωß∂]\d{0,2}(?:[/,][a-zα-ωß∂]\d{0,2})+|[α-ω]|"
    r"[A-Z]{1,2}\d{0,2}|[a-z]\d{0,2}|\d{1,2}(?:\.\d{1,2})*|[\u2460-\u24ff])[′'\"]?[)\].:]{0,2}"
)
_INDEX = re.compile(r"(?<![^\W\d_])([^\W\d_])\s(\d{1,2})(?:\s(?=/)|(?=/)|$)")


def is_key(text: str) -> bool:
    """Whether a text may be a drawing's key or an outline's number, and no word: "A", "(b)", "h1", "2.3", "④"; where
    its indices are set lower, "b 1/b 2"."""
    return _KEY.fullmatch(_INDEX.sub(r"\1\2", text)) is not None


def ascending(keys: Sequence[str]) -> bool:
    """Whether the numbers of an outline go up: "1.1", "1.2", "2.1"."""
    numbers = [[int(n) for n in re.findall(r"\d+", key)] for key in keys]
    return all(a < b for a, b in pairwise(numbers))


def counting(keys: Sequence[str], share: float = 1.0) -> bool:
    """Whether numbers go up, one by one or nearly (a `share` of the steps): they count the rows beside them."""
    steps = [int(b) - int(a) for a, b in pairwise(keys)] if all(map(str.isdecimal, keys)) else [0]
    return steps.count(1) >= share * len(steps) and all(step > 0 for step in steps)


@functools.lru_cache(maxsize=65536)
def is_unit(text: str) -> str:
    """The unit that a text is and nothing else ("mm", "(kg)", "ft in"); "" if it is not one.

    Two of them, one for the number in brackets, are "m|ft-in" for "m (ft-in)".
    """
    bare = _AT_RPM.sub("", GRAVITATIONAL.sub("", text).strip() or text.strip())
    power = _AT_SPEED.fullmatch(bare)
    if power and (first := printed_unit(power.group(1))) and first.dimension in ("power", "torque"):
        return f"{power.group(1)}|rpm"
    pair = _UNIT_PAIR.fullmatch(bare)
    if pair and (first := printed_unit(pair.group(1))) and (second := is_unit(pair.group(2))) and "|" not in second:
        other = printed_unit("in" if second == FEET_INCHES else second)
        other_name = other is not None and other.name != first.name  # "m (ft-in)", "kW (PS)"
        if other and first.dimension == other.dimension and other_name:
            return f"{pair.group(1)}|{second}"
    if _FEET_HEAD.fullmatch(bare):
        return FEET_INCHES
    bare = bare.strip("()[]{}: （）［］【】：")
    spelled = re.fullmatch(unit_pattern(), bare) or (len(bare) > 3 and bare.isalpha())  # "Seconds", "Bars"
    return bare if spelled and printed_unit(bare) else ""


def unit_in_label(text: str, *, bare: bool = False) -> tuple[str, str]:
    """A label without the unit at its end, and that unit: "Boom length (m)" → ("Boom length", "m"). `bare`: the value
    has no unit of its own, so that a unit of one letter is no key of a drawing ("Longueur de flèche m")."""
    pair = re.search(r"^(.*?[\w)°.])[\s,]+(\S+\s*[(/\[]\s*[^()\[\]]+[)\]])$", text)
    if pair and "|" in (unit := is_unit(pair.group(2))):
        return pair.group(1), unit
    nested = re.fullmatch(r"(.*\([^()]+)\(([^()]+)\)\)", text)  # "Dimensions (LxWxH(mm))"
    if nested and (unit := is_unit(nested.group(2))):
        return f"{nested.group(1)})", unit
    for pattern in _UNIT_AT_END:
        match = pattern.search(text)
        if match and (unit := is_unit(match.group(2))) and unit.rstrip(".") != "min":  # the least, not minutes
            plain = pattern is _UNIT_AT_END[-1]
            if not plain or unit in _ENDS_LABELS or (bare and unit in _ENDS_LABELS_OF_BARE):
                return match.group(1), unit
    return text, ""


_UNIT_AT_END = (
    re.compile(r"^(.*?)\s*[(\[（［【]\s*([^()\[\]（）［］【】]+?)\s*[)\]）］】]\s*:?$"),
    re.compile(r"^(.*?)\s*[（【]\s*([^()\[\]（）［］【】]+?)$"),  # PDFium overlooks a bracket alone in a font it lacks
    re.compile(r"^(.*?)\s*,\s*([^,]+?)\s*:?$"),
    re.compile(r"^(.*[^\W\d](?:.*[^\d\s])?)\s+(\S+)$"),  # behind a number it is that one's unit
)
_ENDS_LABELS = frozenset(["mm", "cm", "kg", "kPa", "MPa", "kN", "l/min", "L/min", "m³", "m3", "km/h"])
"""Units that no key of a drawing looks like."""
_ENDS_LABELS_OF_BARE = frozenset(
    "m t s sec l ° kW PS CV hp bar psi kNm Nm kN·m N·m in lb lbf mph rpm r/min 1/min min-1 min⁻¹ U/min tr/min".split()  # noqa: SIM905
)


_HEADED_BY_UNIT = re.compile(
    r"^(.*?)[\s:：,–-]*(?:\b(?:in|en|unit|units|einheit|unité|unidad)\b|单位|単位)\s*[:：]?\s*(\S+(?:\s*[(（][^()（）]+[)）])?)$",
    re.IGNORECASE,
)


def unit_of_heading(text: str) -> tuple[str, str]:
    """A heading without the unit that holds for the bare numbers under it, and that unit: "Dimensions (mm)"."""
    match = _HEADED_BY_UNIT.search(text)
    if match and (unit := is_unit(match.group(2))):
        return match.group(1), unit
    return unit_in_label(text)


_NOTE_OF_UNIT = re.compile(
    r"(?:\b(?:all|dimensions|measurements|figures|maße|cotes|medidas)\b[^.;]*?\b(?:are\b[^.;]*?)?\b(?:in|en)\b|"
    r"\bunits?\s*[:：])\s*(mm|cm|millimet(?:er|re)s?)\b",
    re.IGNORECASE,
)


def unit_noted(text: str) -> str:
    """The unit of length that a note gives to the bare numbers about it: "All dimensions are in mm"; "" otherwise."""
    match = _NOTE_OF_UNIT.search(text)
    return match.group(1) if match else ""


def unit_said(text: str) -> str:
    """The unit that words give to all the numbers under them, and nothing else: "Unit: mm" → "mm"; "" otherwise."""
    match = _HEADED_BY_UNIT.search(text.strip("()[]（）【】 "))
    return is_unit(match.group(2)) if match and not match.group(1) else ""


def kind_of(piece: TextPiece) -> str:
    """`value`, `unit`, `mark` (an example mark, or a dash or "N/A" for none, alone) or `text`."""
    bare = piece.bare
    if not bare:
        return "mark"
    if is_unit(bare):
        return "unit"
    if not bare.strip("-–—−/. ") or bare.casefold() in ("n/a", "n.a."):
        return "mark"
    return "value" if looks_like_value(bare) or lists_items(bare) else "text"


_VALUE_START = re.compile(
    r"^(?:(?:appr(?:ox)?\.?|approximately|about|abt\.?|circa|ca?\.|ca|etwa|env(?:iron)?\.?|aprox(?:imadamente)?\.?|"
    r"max(?:imum|imal)?\.?|min(?:imum|imal)?\.?|up to|bis(?: zu)?|jusqu'à|hasta|[约約]|およそ|大约|最大|最小|最高)\s*)*"
    r"[(\[]?\s*(?:\+/[-–−]|[<>≤≥~≈±Øø⌀●+\-–−])*\s*(?:[\d½¼¾⅛⅜⅝⅞]|[.,]\d)",
    re.IGNORECASE,
)
_NOT_A_VALUE = re.compile(
    r"^\d+(?:st|nd|rd|th)\b|^\d+[A-Za-z]{2,}\d|^\d+(?:[.,/x]\d+)*\s?R\s?\d|^\d+[-/]?[A-Z]{2,}\b|^\d+-(?!\d)[A-Za-z]"
)


_IN_CAPITALS = re.compile(r"^\d[\d.,]*\s?(?:KG|MM|KW|HP|PS|BAR|RPM|MPA|KN)$")
"""A value whose unit is set in capitals, and no designation: "6900KG"."""
_DESIGNED = re.compile(r"^(?=[^Øø⌀φΦ]*\d)[^a-zØø⌀φΦぁ-ヺ㐀-鿿]*[Øø⌀φΦ]\s?\d")
"""A diameter behind a designation: "IWRC 6×WS(26) φ10mm×129m"."""


@functools.lru_cache(maxsize=65536)
def looks_like_value(text: str) -> bool:
    """Whether a piece of text is a value rather than a label: it begins with a number and is mostly numbers."""
    if _DESIGNED.match(text):
        return True
    if not _VALUE_START.match(text) or (_NOT_A_VALUE.match(text) and not _IN_CAPITALS.match(text)):
        return False
    readings = read(text)
    if not readings:
        return False
    first = readings[0].numbers[0]
    if not first.unit and re.match(
        r"[.):]?\s+(?!(?:to|bis|up|each|per|pro|par|por)\b)(?:[^\W\d_]-)?[^\W\d_]{2,}", text[first.end :]
    ):
        return False  # "10 Wheelbase", "4.2 No. of shoes": a drawing's key or an outline's number, and a label
    if re.match(r"[\u3040-\u30ff\u3400-\u9fff]{4}", text[first.end :]):
        return False  # "45°卸料时斗刃高度": a label that begins with its circumstance
    return len(words_beside_numbers(text, readings)) <= 8


_ITEM = re.compile(r"(?:^|[\s|,;/)])[^\W\d](?:[^\d:|;]*|\w*)[:：]\s*[<>≤≥~±Øø⌀φ]*\s*\d")


def lists_items(text: str) -> bool:
    """Whether a text lists several values, each behind its own name: "Retracted: 2.3 m Extended: 5.1 m"."""
    return len(_ITEM.findall(text)) > 1 and _ITEM.match(text) is not None


def words_beside_numbers(text: str, readings: Sequence[Reading]) -> list[str]:
    """The words of a text that belong to no quantity."""
    rest = text
    for quantity in sorted(
        (q for r in readings for q in (*r.numbers, *r.partner)), key=lambda q: q.start, reverse=True
    ):
        rest = rest[: quantity.start] + " " + rest[quantity.end :]
    return re.findall(r"[^\W\d_]{2,}", rest)


@functools.lru_cache(maxsize=65536)
def split_inline(text: str) -> tuple[str, str]:
    """A piece that holds a label and its value: ("Wheelbase", "3,450 mm"); ("", "") if it does not.

    The value is what follows a colon, or the quantities with units at the end.
    """
    if lists_items(text):
        return "", ""
    colon = re.match(r"^(.*?[^\W\d].*?)\s*[:=]\s+(.+)$", text)
    if colon and " = " not in colon.group(2) and looks_like_value(colon.group(2)):
        return colon.group(1), colon.group(2)
    readings = [r for r in read(text) if not r.condition and all(q.unit for q in r.numbers)]
    for reading in readings:
        start = min(q.start for q in reading.numbers)
        label, value = text[:start].rstrip(" (:-–"), text[start:]
        if re.search(r"[^\W\d_]{2,}", label) and looks_like_value(value) and len(label.split()) <= LONGEST_LABEL:
            tail = words_beside_numbers(value, read(value))
            if len(tail) <= 4:
                return label, value
    return "", ""


_LAST_KEY = re.compile(r"^(.*[^\W\d_]{3,}.*?)\s([A-Z])[′'’\"]?$")


def without_last_keys(statements: Sequence[Statement]) -> list[Statement]:
    """The statements of a page without the keys of its drawings behind their labels ("Tail swing radius F"), where
    three or more labels end in letters that differ."""
    ends = {s.label: m for s in statements if (m := _LAST_KEY.match(s.label))}
    if len({m.group(2) for m in ends.values()}) < _FEWEST_KEYS:
        return list(statements)
    return [replace(s, label=ends[s.label].group(1)) if s.label in ends else s for s in statements]


_FEWEST_KEYS = 3


def without_key(label: str) -> str:
    """A label without its drawing's letter key: "B Hinge pin height", "f. Hinge pin height", "F hinge pin height",
    "F – Hinge pin height" → "Hinge pin height"."""
    match = re.match(
        r"^\(?(?:[A-Z]{1,2}[′'\"]?|[a-zα-ω](?=\d?[.):]*\s+[A-ZÀ-Ý])\d?|\d{1,2}(?:\.\d{1,2})*)"
        r"[.):]*\s+(?:[-–—]\s+)?"
        r"(?=[A-ZÀ-Ý(](?:-[^\W\d_])?[^\W\d_]+|(?<=[B-HJ-NP-Z] )[a-z]{4}|[\u3040-\u30ff\u3400-\u9fff])(.+)$",
        label,
    )
    return match.group(1) if match else label


def without_value_of_label(statement: Statement) -> tuple[str, str]:
    """A statement's label and text; the quantity that a narrow gap left at the label's end stands before the value that
    says it again in the other system: "Bucket Cylinder – Stroke 1156 mm | 46 in"."""
    own, beside = read(statement.label), read(statement.text)
    if not own or not beside or own[-1].condition:
        return statement.label, statement.text
    first, second = own[-1].numbers[0], beside[0].numbers[0]
    ends = not statement.label[first.end :].strip() and second.start == 0 and first.dimension == second.dimension
    if not ends or {q.printed.system for q in (first, second) if q.printed} != {"metric", "imperial"}:
        return statement.label, statement.text
    return statement.label[: first.start].strip(), f"{statement.label[first.start :]} ({statement.text})"
