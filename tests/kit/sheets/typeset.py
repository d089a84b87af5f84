"""What the generated sheets are typeset with: words in six languages, numbers in their formats, both unit systems.

Layouts draw through a `Sheet`, which notes every wanted value that it prints: the sheet's truth. Points, origin at the
page's bottom left, y up.
"""

from __future__ import annotations

import random
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from reportlab.lib.colors import HexColor
from reportlab.lib.pagesizes import A4
from reportlab.pdfbase import pdfmetrics
from reportlab.pdfbase.cidfonts import UnicodeCIDFont
from reportlab.pdfgen.canvas import Canvas

from kit.sheets.machines import Entry, Machine, entries, unit_of

WIDTH, HEIGHT = A4
_CJK = {"zh": "STSong-Light", "ja": "HeiseiKakuGo-W5"}
_RUNS = re.compile(r"[\u2190-\uffff]+|[^\u2190-\uffff]+")
SECTIONS = {
    "wheel_loader": ("weights", "bucket", "dimensions", "hydraulics", "cylinders", "cycle", "steering", "travel"),
    "excavator": ("weights", "bucket", "arm", "forces", "working", "dimensions", "undercarriage", "hydraulics",
                  "cylinders", "swing", "travel"),
}  # fmt: skip
_SI = {"mm": 1e-3, "m": 1.0, "kg": 1.0, "t": 1e3, "deg": 0.017453292519943295, "MPa": 1e6, "bar": 1e5, "kPa": 1e3,
       "L/min": 1e-3 / 60, "m3": 1.0, "kN": 1e3, "kNm": 1e3, "km/h": 1 / 3.6, "s": 1.0, "rpm": 0.10471975511965977,
       "kW": 1e3, "L": 1e-3, "m/s": 1.0, "m/min": 1 / 60,
       "-": 1.0}  # fmt: skip
_SHOWN = {"deg": "°", "kNm": "kN·m", "m3": "m³", "-": ""}


@dataclass(frozen=True)
class Style:
    """How a sheet writes. `wording` chooses among the labels; `metres`: long lengths in m; `imperial`: also printed;
    `group`, `point`: thousands and decimals; `feet`: how feet and inches are put."""

    language: str = "en"
    wording: int = 0
    metres: bool = False
    imperial: bool = False
    group: str = ","
    point: str = "."
    pressure: str = "MPa"
    tonnes: bool = False
    feet: str = "{}'{}\""


@dataclass(frozen=True)
class Said:
    """A value as printed: number and unit apart, and the imperial text ("" for none)."""

    number: str
    unit: str
    imperial: str = ""

    @property
    def metric(self) -> str:
        """Number and unit."""
        return self.number + ("" if self.unit == "°" else " " if self.unit else "") + self.unit

    @property
    def both(self) -> str:
        """The imperial text in brackets behind the metric one."""
        return f"{self.metric} ({self.imperial})" if self.imperial else self.metric


@dataclass(frozen=True)
class Row:
    """A line of a section: its label and what is said; `name` "" for a distractor, whose text is `said.number`."""

    label: str
    said: Said
    name: str = ""


@dataclass(frozen=True)
class Truth:
    """A printed value in SI; `slack` is what its print leaves open."""

    value: float
    slack: float


@dataclass
class Sheet:
    """A sheet being drawn. `left_out` names are not printed; `truth` fills as values are said."""

    path: Path
    machine: Machine
    style: Style
    seed: int = 0
    config: str = ""
    truth: dict[str, Truth] = field(default_factory=dict)
    allowed: dict[str, Truth] = field(default_factory=dict)
    unsettled: set[str] = field(default_factory=set)
    left_out: frozenset[str] = frozenset()

    def __post_init__(self) -> None:
        self.canvas = Canvas(str(self.path), pagesize=A4, invariant=1)
        self.dice = random.Random(f"{self.seed} {self.machine.name}")
        if self.style.language in _CJK:
            pdfmetrics.registerFont(UnicodeCIDFont(_CJK[self.style.language]))
        names = [n for n in self.machine.values if n != "Operating Weight"]
        self.left_out = self.left_out or frozenset(self.dice.sample(names, len(names) // 5))

    # ---- words ---------------------------------------------------------------------------------------------------
    def word(self, entry: Entry) -> str:
        """The wording of an entry that this sheet uses."""
        words = entry.words[self.style.language]
        if self.style.wording == 3:
            words = next((e.words[self.style.language] for e in entries("later") if e.name == entry.name), words)
        return words[min(self.style.wording, len(words) - 1)]

    def section(self, key: str) -> str:
        """A section's heading."""
        return next(self.word(e) for e in entries("sections") if e.name == key)

    def part(self, key: str) -> str:
        """A cylinder's measure: bore, stroke."""
        return next(self.word(e) for e in entries("parts") if e.name == key)

    def cylinders(self) -> list[tuple[str, str, int]]:
        """Each cylinder's key, words and number."""
        return [(e.name, self.word(e), int(e.third)) for e in entries("cylinders") if e.second == self.machine.kind]

    # ---- numbers -------------------------------------------------------------------------------------------------
    def digits(self, value: float, decimals: int) -> str:
        """A number in the sheet's format."""
        text = f"{value:,.{decimals}f}"
        return text.replace(",", "\0").replace(".", self.style.point).replace("\0", self.style.group)

    def say(self, name: str, value: float | None = None, *, note: bool = True) -> Said:
        """A wanted value as printed, and the truth noted; `value` where it is not the machine's own."""
        usual = self.machine.values[name]  # all of a row's columns are in the unit of this one
        value = usual if value is None else value
        unit = unit_of(self.machine.kind, name)
        decimals = {"mm": 0, "kg": 0, "deg": 0, "L/min": 0, "kN": 0, "-": 0, "m3": 2, "kW": 0, "kPa": 0, "m/s": 2,
                    "m/min": 0, "L": 0}.get(unit, 1)  # fmt: skip
        decimals = max(decimals, 1 if unit in ("mm", "deg", "L/min", "kN") and value % 1 else 0)
        decimals = 2 if unit == "mm" and usual < 5 else decimals
        if unit == "mm" and self.style.metres and usual >= 1000 and " Cylinder " not in name:
            unit, value, decimals = "m", value / 1000, 2 if value % 10 == 0 else 3
        elif unit == "kg" and self.style.tonnes and usual >= 10000:
            unit, value, decimals = "t", value / 1000, 2
        elif unit == "MPa" and self.style.pressure != "MPa":
            factor = {"bar": 10, "kPa": 1000}[self.style.pressure]
            unit, value, decimals = self.style.pressure, value * factor, 0
        value = round(value, decimals)
        si = _SI[unit] * value
        if note:
            self.truth[name] = Truth(si, 1e-6 * abs(si))
        return Said(self.digits(value, decimals), _SHOWN.get(unit, unit), self._imperial(unit, value))

    def _imperial(self, unit: str, value: float) -> str:
        if not self.style.imperial:
            return ""
        if unit in ("mm", "m"):
            inches = value * _SI[unit] / 0.0254
            if inches < 60:
                return f"{self.digits(inches, 1)} in"
            whole = round(inches)
            return self.style.feet.format(whole // 12, whole % 12)
        factor, decimals, name = {
            "kg": (2.20462262, 0, "lb"), "t": (2204.62262, 0, "lb"), "MPa": (145.0377, 0, "psi"),
            "bar": (14.50377, 0, "psi"), "kPa": (0.1450377, 0, "psi"), "L/min": (0.264172, 1, "gal/min"),
            "m3": (1.30795, 2, "yd³"), "kN": (224.809, 0, "lbf"), "kNm": (737.562, 0, "lbf·ft"),
            "km/h": (0.621371, 1, "mph"), "kW": (1.341022, 0, "hp"), "m/s": (196.8504, 0, "ft/min"),
            "m/min": (3.28084, 0, "ft/min"),
        }.get(unit, (0.0, 0, ""))  # fmt: skip
        decimals += unit == "kPa" and value < 200
        return f"{self.digits(value * factor, decimals)} {name}" if name else ""

    def only_imperial(self, name: str) -> None:
        """Notes that a value is printed without its metric number: its truth is as coarse as the print."""
        self.truth[name] = replace(self.truth[name], slack=0.006 * abs(self.truth[name].value))

    # ---- rows ----------------------------------------------------------------------------------------------------
    def rows(self, section: str, *, cylinders: str = "rows", skip: frozenset[str] = frozenset()) -> list[Row]:
        """The rows of a section in random order with its distractors; `skip` names are printed elsewhere.

        `cylinders`: `rows` (a row for each measure), `product` (bore x stroke), or `none`.
        """
        found = [
            Row(self.word(e), self.say(e.name), e.name)
            for e in entries(self.machine.kind)
            if e.second == section and e.name not in self.left_out and e.name not in skip
        ]
        found += self.distractors(section)
        self.dice.shuffle(found)
        if section == "cylinders" and cylinders != "none":
            found += list(self._cylinder_rows(cylinders))
        return found

    def distractors(self, section: str) -> list[Row]:
        """What stands in a section and is not asked for."""
        return [
            Row(self.word(e), Said(self.spelled(e.second), ""))
            for e in entries("distractors")
            if e.name == section and e.third.partition(":")[0] in ("both", self.machine.kind) and self._may_be_asked(e)
        ]

    def _may_be_asked(self, entry: Entry) -> bool:
        """Notes a distractor that some template asks for: it may be found, and then rightly, but does not count."""
        names = entry.third.partition(":")[2]
        if names:
            number, unit = entry.second.split()
            value = _SI[unit] * float(number)
            self.allowed.update(dict.fromkeys(names.split(","), Truth(value, 1e-6 * value)))
        return True

    def spelled(self, text: str) -> str:
        """A distractor's text with the sheet's decimal sign."""
        return re.sub(r"(?<=\d)\.(?=\d)", self.style.point, text) if "R25" not in text else text

    def measures(self, key: str) -> list[str]:
        """The wanted names of a cylinder that this sheet prints."""
        names = [f"{key} Cylinder {part}" for part in ("Bore", "Rod Diameter", "Stroke")]
        return [n for n in names if n not in self.left_out]

    def _cylinder_rows(self, form: str) -> Iterator[Row]:
        for key, words, count in self.cylinders():
            names = self.measures(key)
            if form == "product":
                bore, stroke = f"{key} Cylinder Bore", f"{key} Cylinder Stroke"
                if not {bore, stroke} <= set(names):
                    continue
                a, b = self.say(bore), self.say(stroke)
                label = f"{words} – {self.part('Bore')} x {self.part('Stroke')}"
                yield Row(label, Said(f"{count} – {a.number} x {b.number}", "mm"), bore)
                continue
            for name in names:
                part = name.partition(" Cylinder ")[2]
                yield Row(f"{words} – {self.part(part)}", self.say(name), name)

    # ---- drawing -------------------------------------------------------------------------------------------------
    def runs(self, text: str, bold: bool = False) -> list[tuple[str, str]]:
        """A text as pieces with their fonts."""
        latin = "Helvetica-Bold" if bold else "Helvetica"
        cjk = _CJK.get(self.style.language, latin)
        return [(part, cjk if part[0] > "\u2190" else latin) for part in _RUNS.findall(text)]

    def width(self, text: str, size: float = 8, bold: bool = False) -> float:
        """How wide a text is set."""
        return float(sum(pdfmetrics.stringWidth(part, font, size) for part, font in self.runs(text, bold)))

    def put(
        self,
        x: float,
        y: float,
        text: str,
        *,
        size: float = 8,
        bold: bool = False,
        align: str = "l",
        ink: str = "#202020",
    ) -> float:
        """Sets a text at a baseline; its width. `align`: l, c or r of `x`."""
        width = self.width(text, size, bold)
        x -= {"l": 0.0, "c": width / 2, "r": width}[align]
        self.canvas.setFillColor(HexColor(ink))
        for part, font in self.runs(text, bold):
            self.canvas.setFont(font, size)
            self.canvas.drawString(x, y, part)
            x += pdfmetrics.stringWidth(part, font, size)
        return width

    def wrapped(self, text: str, width: float, size: float = 8) -> list[str]:
        """A text broken into lines: at spaces, or between CJK characters."""
        cjk = self.style.language in _CJK
        parts = re.findall(r"[\u2190-\uffff]|[^\s\u2190-\uffff]+\s*|\s+", text) if cjk else re.findall(r"\S+\s*", text)
        lines = [""]
        for part in parts:
            if lines[-1] and self.width((lines[-1] + part).rstrip(), size) > width:
                lines.append("")
            lines[-1] += part
        return [line.strip() for line in lines]

    def line(self, x0: float, y: float, x1: float, *, y1: float | None = None, weight: float = 0.4) -> None:
        """A rule."""
        self.canvas.setLineWidth(weight)
        self.canvas.line(x0, y, x1, y if y1 is None else y1)

    def fill(self, x: float, y: float, width: float, height: float, color: str) -> None:
        """A filled bar."""
        self.canvas.setFillColor(HexColor(color))
        self.canvas.rect(x, y, width, height, stroke=0, fill=1)

    def title(self) -> None:
        """The page's title."""
        self.put(36, 806, self.machine.name.upper(), size=17, bold=True)

    def page(self) -> float:
        """A new page; the first baseline."""
        self.canvas.showPage()
        return 800.0

    def finish(self) -> None:
        """Writes the file."""
        self.canvas.save()


def styles(wording: int) -> Mapping[str, Style]:
    """Ways of writing, by name; `wording` chooses the labels."""
    de = Style("de", wording, group=".", point=",", pressure="bar")
    return {
        "en": Style("en", wording, imperial=True),
        "en_m": Style("en", wording, metres=True, imperial=True, pressure="kPa"),
        "en_plain": Style("en", wording, group=""),
        "en_space": Style("en", wording, group=" ", pressure="bar", tonnes=True),
        "de": de,
        "de_m": replace(de, metres=True, tonnes=True),
        "fr": Style("fr", wording, group=" ", point=",", pressure="bar"),
        "es": Style("es", wording, group=".", point=",", imperial=False, metres=True),
        "zh": Style("zh", wording, group=""),
        "ja": Style("ja", wording, group=","),
    }
