"""Sheets in a set's own wordings, for machines of all ten types: what "fresh" to "fresh5" are drawn with.

A set has a file of words (its head says how it is written), layouts, ways of writing, and a plan. " > " in a label
parts a group from its item: a layout may draw the group as a cell over its rows, or print the two one after the other.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache

from kit.sheets.machines import WORDS, Machine, typed
from kit.sheets.typeset import _CJK, HEIGHT, WIDTH, Row, Said, Sheet, Style, Truth

_PARTS = ("Bore", "Rod Diameter", "Stroke")
_ALSO = {
    "Net Power": ("Engine Power",),
    "Engine Power": ("Net Power", "Gross Power"),
    "Maximum Steering Angle": ("Steering Angle",),
}
"""Names that a printed one may answer, too: neither right nor wrong."""
_LAST = ("service", "tyres", "cab")
_IMPERIAL = re.compile(r"(.*\d['\"]?) ?([a-z/·³]+)?")


@dataclass(frozen=True)
class Line:
    """A line of a set's words; `place` is its section, a cylinder's number, or the types and value of a distractor."""

    name: str
    place: str
    words: Mapping[str, tuple[str, ...]]


@cache
def lines(file: str) -> Mapping[str, tuple[Line, ...]]:
    """The parts of a set's words: a type's, `parts`, `sections` and `distractors`."""
    found: dict[str, list[Line]] = {}
    here, languages = "", [""]
    for text in (WORDS / f"{file}.txt").read_text(encoding="utf-8").splitlines():
        if text.startswith("["):
            here, *languages = text.replace("[", "").replace("]", "").split()
        elif text and not text.startswith("#"):
            name, place, *words = (part.strip() for part in text.split("|"))
            by = {k: tuple(w.strip() for w in v.split(";")) for k, v in zip(languages, words, strict=True)}
            found.setdefault(here, []).append(Line(name, place, by))
    return {part: tuple(own) for part, own in found.items()}


@dataclass(frozen=True)
class Worded:
    """A set: its words, the letters of its models, its layouts and ways of writing; `plan`: type → "layout:style …"."""

    file: str
    letters: str
    layouts: Mapping[str, Callable[[Wording], None]]
    styles: Mapping[str, Style]
    plan: Mapping[str, str]

    def cases(self) -> list[tuple[str, str, str, Machine]]:
        """Type, layout, style and machine of each sheet; no machine twice."""
        found = []
        for kind, text in self.plan.items():
            for index, pair in enumerate(text.split()):
                layout, style = pair.split(":")
                name = f"{self.letters}{kind[0].upper()} {135 + 35 * index}"
                found.append((kind, layout, style, typed(kind, name, name)))
        return found


@dataclass
class Wording(Sheet):
    """A sheet in the words of a set's `file`."""

    file: str = ""
    printed: dict[str, str] = field(default_factory=dict)
    """The number of each wanted name as it stands on the sheet."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.size = (WIDTH, HEIGHT)

    # ---- words ---------------------------------------------------------------------------------------------------
    def of(self, line: Line) -> str:
        """The wording of a line in this sheet's language."""
        words = line.words[self.style.language]
        return words[min(self.style.wording, len(words) - 1)]

    def section(self, key: str) -> str:
        """A section's heading."""
        return next(self.of(one) for one in lines(self.file)["sections"] if one.name == key)

    def part(self, key: str) -> str:
        """A cylinder's measure."""
        return next(self.of(one) for one in lines(self.file)["parts"] if one.name == key)

    def sections(self) -> list[str]:
        """The sections of this type of machine in the order in which its words come."""
        kind = lines(self.file)[self.machine.kind]
        found = list(dict.fromkeys(one.place for one in kind if not one.name.startswith("@")))
        place = found.index("hydraulics") + 1
        return [*found[:place], "cylinders", *found[place:], *_LAST]

    def joined(self, label: str) -> str:
        """A label with group and item one after the other."""
        group, mark, item = label.partition(" > ")
        if not mark:
            return label
        return f"{group}（{item}）" if self.style.language in _CJK else f"{group}, {item}"

    def one_of(self, choices: Mapping[str, str]) -> str:
        """The text of a mapping by language."""
        return choices[self.style.language]

    # ---- rows ----------------------------------------------------------------------------------------------------
    def say(self, name: str, value: float | None = None, *, note: bool = True) -> Said:
        """As `Sheet.say`; what else it answers is noted, too."""
        said = super().say(name, value, note=note)
        if note:
            self.printed[name] = said.number
            self.allowed.update(dict.fromkeys(_ALSO.get(name, ()), self.truth[name]))
        return said

    def rows(self, section: str, *, cylinders: str = "rows", skip: frozenset[str] = frozenset()) -> list[Row]:
        """The rows of a section, groups together, distractors among them. Labels as in the file: see `joined`."""
        if section == "cylinders":
            return self._rams(cylinders)
        found = [
            Row(self.of(one), self.say(one.name), one.name)
            for one in lines(self.file)[self.machine.kind]
            if one.place == section and one.name not in self.left_out and one.name not in skip
        ]
        found += self.distractors(section)
        groups: dict[str, list[Row]] = {}
        for row in found:
            groups.setdefault(row.label.partition(" > ")[0], []).append(row)
        order = list(groups)
        self.dice.shuffle(order)
        return [row for key in order for row in groups[key]]

    def distractors(self, section: str) -> list[Row]:
        """What stands in a section and is not asked for."""
        found = []
        for one in lines(self.file)["distractors"]:
            kinds, _, value = one.place.partition(", ")
            if one.name == section and (kinds == "all" or self.machine.kind in kinds.split()):
                number, _, unit = value.rpartition(" ")
                if unit == "MPa" and self.style.pressure != unit:
                    factor, unit = {"bar": 10, "kPa": 1000}[self.style.pressure], self.style.pressure
                    number = f"{float(number) * factor:g}"
                said = Said(self.spelled(number), unit) if unit[:1].isalpha() or unit == "°" else Said(value, "")
                found.append(Row(self.of(one), said))
                if unit == "mm" and number.isdigit():
                    self.note_level_cut(found[-1].label, float(number) / 1e3)
        return found

    def note_level_cut(self, label: str, depth: float) -> None:
        """A depth over 2.44 m of level bottom is no "maximum digging depth", but asked for by its own name."""
        if re.search(r"(?<!\d)(?:2[.,]44|2440|8 ft)", label):
            self.allowed["Maximum Digging Depth 2.44 m Level Bottom"] = Truth(depth, 0.006)
            self.allowed["Level Bottom Length"] = Truth(2.44, 0.006)

    def spelled(self, text: str) -> str:
        """A distractor's number in the sheet's format."""
        if re.fullmatch(r"\d+", text) and int(text) >= 1000:
            return self.digits(float(text), 0)
        return super().spelled(text)

    def _rams(self, form: str) -> list[Row]:
        """The cylinders' rows: `rows`, `product` (count – bore x stroke) where both are printed, or `none`."""
        found = []
        for one in lines(self.file)[self.machine.kind]:
            if not one.name.startswith("@") or form == "none":
                continue
            key, words = one.name[1:], self.of(one)
            names = [n for n in (f"{key} Cylinder {part}" for part in _PARTS) if self.prints(n)]
            pair = [f"{key} Cylinder Bore", f"{key} Cylinder Stroke"]
            if form == "product" and set(pair) <= set(names):
                a, b = (self.say(name) for name in pair)
                label = f"{words}, {self.part('Bore')} x {self.part('Stroke')}"
                found.append(Row(label, Said(f"{one.place} – {a.number} x {b.number}", "mm"), pair[0]))
                names = [n for n in names if n not in pair]
            found += [Row(f"{words} > {self.part(n.partition(' Cylinder ')[2])}", self.say(n), n) for n in names]
        return found

    def prints(self, name: str) -> bool:
        """Whether the machine has a value and this sheet prints it."""
        return name in self.machine.values and name not in self.left_out

    # ---- drawing -------------------------------------------------------------------------------------------------
    def paper(self, size: tuple[float, float]) -> None:
        """The size of the pages, set before anything is drawn."""
        self.size = size
        self.canvas.setPageSize(size)

    def ring(self, x: float, y: float, text: str, size: float = 7) -> None:
        """A drawing's letter in a ring about a point."""
        self.canvas.setLineWidth(0.4)
        self.canvas.circle(x, y, size * 0.72, stroke=1, fill=0)
        self.put(x, y - size * 0.35, text, size=size, align="c")


def parted(imperial: str) -> tuple[str, str]:
    """An imperial text as number and unit; feet and inches keep their marks, or words, in the number."""
    found = _IMPERIAL.fullmatch(imperial)
    assert found
    return (imperial, "") if " ft " in imperial else (found[1], found[2] or "ft in")


@dataclass
class Flow:
    """Columns of a page (left and right edges) filled from top to bottom, page after page."""

    sheet: Wording
    columns: Sequence[tuple[float, float]]
    top: float
    bottom: float
    again: float = 0.0
    """The top of the pages after the first; 0: as the first."""

    def __post_init__(self) -> None:
        self.place, self.y = 0, self.top

    def room(self, height: float) -> tuple[float, float, float]:
        """Left, right and the upper edge of a piece of so much height, which is taken."""
        if self.y - height < self.bottom:
            self.place += 1
            if self.place % len(self.columns) == 0:
                self.sheet.page()
                self.top = self.again or self.top
            self.y = self.top
        y, self.y = self.y, self.y - height
        return (*self.columns[self.place % len(self.columns)], y)

    def keep(self, height: float) -> bool:
        """Begins a new column unless there is so much room; whether one was begun."""
        before = self.place
        x = self.room(height)
        self.y = x[2]
        return self.place != before


__all__ = ["Flow", "Line", "Row", "Said", "Truth", "Worded", "Wording", "lines", "parted"]
