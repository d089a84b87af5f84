"""The set "fresh6": machines of all ten types on eight kinds of pages, in words of its own.

After the habits of makers: `deere` full-width lines under black bars; `kubota` a table with merged section cells, a
unit column and two models; `tadano` section names at the left, what belongs together on one line; `hyster` an
industrial truck's type sheet with rotated section names, "symbol (unit)" and two models; `yanmar` lettered tables two
up under a drawing; `sany` a striped table two up with the unit in brackets behind the label; `develon` two columns
with a sentence under each heading; `jcb` a unit column for both systems, "mm (ft-in)".
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from itertools import groupby

from kit.sheets.machines import Machine, rounded
from kit.sheets.sets.fresh4 import _SYMBOLS, _grouped, _other, _outline, _rear, _said
from kit.sheets.sets.fresh6_texts import MODEL, NOTE, OPERATOR, PROSE, SAID_IN, TITLE
from kit.sheets.typeset import _CJK, Style, Truth
from kit.sheets.worded import Flow, Row, Said, Worded, Wording, lines

_LEVEL = "Maximum Digging Depth 2.44 m Level Bottom"

_LETTERED = ("working", "dimensions")


# ---- rows --------------------------------------------------------------------------------------------------------
def _sized(s: Wording, section: str, row: Row) -> Row:
    """A distractor that goes with the machine's size has its number from what it stands beside."""
    values = s.machine.values
    name, factor = {
        ("forces", "kN"): ("Bucket Digging Force", 1.09),
        ("steering", "mm"): ("Turning Radius", 1.06),
        ("weights", "kg"): ("Empty Weight", 0.5),
        ("hydraulics", "L/min"): (
            "Main Pump Flow",
            {"skid_steer": 1.5, "excavator": 0.04, "wheel_loader": 0.15}.get(s.machine.kind, 1.0),
        ),
    }.get((section, row.said.unit), ("", 1.0))
    if not row.name and section in ("engine", "service"):
        return _powered(s, section, row)
    if row.name or name not in values:
        return row
    value = rounded(s.machine.kind, name, values[name] * factor)
    return Row(row.label, Said(s.digits(value, 0), row.said.unit))


def _powered(s: Wording, section: str, row: Row) -> Row:
    """What an engine is like, and what its tanks hold, by its power."""
    values = s.machine.values
    power = values.get("Net Power") or values["Engine Power"]
    litres = max(1.5, 0.038 * power)
    count = 3 if litres < 2 else 4 if litres < 5 else 6 if litres < 18 else 12
    stroke = 1.16 * (litres * 1e6 / count / 0.7854 / 1.16) ** (1 / 3)
    said = row.said
    if section == "service":
        return Row(row.label, Said(s.digits(max(4, round(float(said.number) * power / 150)), 0), said.unit))
    if said.unit == "L":
        return Row(row.label, Said(s.digits(litres, 1), said.unit))
    if said.unit == "N·m":
        return Row(row.label, Said(s.digits(round(5.6 * power), 0), said.unit))
    if said.unit == "mm":
        return Row(row.label, Said(s.digits(round(stroke / (1.16 if said.number == "107" else 1)), 0), said.unit))
    return Row(row.label, Said(str(count), "")) if said.number == "6" else row


def _rows(s: Wording, section: str) -> list[Row]:
    """The rows of a section in the words' order; the units as the country writes them."""
    labels = [s.of(one) for part in (s.machine.kind, "distractors") for one in lines(s.file)[part]]
    found = s.rows(section)
    if section != "cylinders":
        found.sort(key=lambda row: labels.index(row.label))
        order = list(dict.fromkeys(row.label.partition(" > ")[0] for row in found))
        found.sort(key=lambda row: order.index(row.label.partition(" > ")[0]))
    if any(row.name == _LEVEL for row in found):
        s.allowed["Level Bottom Length"] = Truth(2.44, 0.006)
    done = []
    for row in found:
        row = _sized(s, section, row)
        said = row.said
        if s.style.metres and not row.name and said.unit == "mm" and len(re.sub(r"\D", "", said.number)) > 3:
            value = float(re.sub(r"\D", "", said.number)) / 1000
            said = Said(s.digits(value, 2), "m")
            imperial = s._imperial("m", value)
            done.append(Row(row.label, replace(_said(s, said), imperial=imperial), row.name))
            continue
        done.append(Row(row.label, _said(s, said, extra=not row.name), row.name))
    return done


def _kept(s: Wording) -> list[tuple[str, list[Row]]]:
    """The sections that have rows."""
    return [(one, rows) for one in s.sections() if (rows := _rows(s, one))]


def _lettered(s: Wording, rows: list[Row]) -> dict[str, str]:
    return {row.name: chr(65 + i) for i, row in enumerate([r for r in rows if r.name][:26])}


def _models(s: Wording) -> tuple[list[str], int]:
    """The names of two models, of which one is this; the sheet's configuration is set."""
    place = s.dice.randrange(2)
    letters, _, digits = s.machine.name.rpartition(" ")
    s.config = s.machine.name
    return [s.machine.name if i == place else f"{letters} {int(digits) + 15 * (i - place)}" for i in range(2)], place


def _joined(s: Wording, row: Row) -> str:
    return s.joined(row.label)


# ---- pages -------------------------------------------------------------------------------------------------------
def _foot(s: Wording) -> None:
    s.put(36, 27, "* " + s.one_of(OPERATOR), size=5.8, ink="#555555")
    s.put(36, 19, s.one_of(NOTE), size=5.8, ink="#555555")


def deere(s: Wording) -> None:
    """Lines over the whole width under black bars with the model at the right; groups over indented items."""
    s.put(36, 800, s.machine.name, size=22, bold=True, ink="#1c6b2a")
    s.put(559, 800, s.one_of(TITLE).upper(), size=10, bold=True, align="r", ink="#555555")
    _foot(s)
    flow = Flow(s, ((36, 559),), 786, 42, 806)
    for section, rows in _kept(s):
        flow.keep(min(22 + 12 * (len(rows) + 1), 400))
        *_, y = flow.room(18)
        s.fill(36, y - 15, 523, 14, "#202020")
        s.put(41, y - 11.2, s.section(section), size=8.5, bold=True, ink="#ffffff")
        s.put(300, y - 11.2, s.machine.name, size=8.5, bold=True, ink="#ffffff")
        for label, row, inner in _grouped(rows):
            flow.keep(40 if row is None else 12)
            *_, y = flow.room(12)
            s.put(53 if inner else 41, y - 8.5, label or (_joined(s, row) if row else ""), size=7.5)
            if row is not None:
                mark = "*" if row.name == "Operating Weight" else ""
                s.put(300, y - 8.5, row.said.both + mark, size=7.5)
            s.line(36, y - 11.6, 559, weight=0.2)
        flow.room(7)


def kubota(s: Wording) -> None:
    """A ruled table: the section as a cell over its rows, item, unit and two models; rows of a group in a cell too."""
    names, place = _models(s)
    s.put(36, 804, s.one_of(TITLE), size=15, bold=True, ink="#e0592a")
    _foot(s)
    xs = (36.0, 112.0, 345.0, 395.0, 477.0, 559.0)
    flow = Flow(s, ((36, 559),), 792, 42, 806)
    page = -1

    def head() -> None:
        *_, y = flow.room(16)
        s.fill(36, y - 16, 523, 16, "#f6d9cc")
        s.put(40, y - 11, s.one_of(MODEL), size=7.5, bold=True)
        s.put(370, y - 11, s.one_of(SAID_IN), size=7, bold=True, align="c")
        for x, name in zip((436, 518), names, strict=True):
            s.put(x, y - 11, name, size=7.5, bold=True, align="c")
        s.line(36, y, 559)

    for section, rows in _kept(s):
        if flow.keep(min(12.5 * len(rows) + 2, 600)) or page < 0:
            head()
        page = flow.place
        top = flow.y
        groups = [list(some) for _, some in groupby(rows, lambda r: r.label.partition(" > ")[0])]
        for own in groups:
            group, mark, _ = own[0].label.partition(" > ")
            start = flow.y
            for row in own:
                *_, y = flow.room(12.5)
                low = y - 12.5
                if mark and len(own) > 1:
                    s.put(232, y - 9, row.label.partition(" > ")[2], size=7)
                else:
                    s.put(116, y - 9, _joined(s, row), size=7)
                s.put(370, y - 9, row.said.unit or "–", size=7, align="c")
                for i, x in enumerate((436, 518)):
                    s.put(x, y - 9, _beside(s, row, i - place), size=7, align="c")
                s.line(228 if mark and len(own) > 1 else 112, low, 559, weight=0.3)
            if mark and len(own) > 1:
                s.put(116, (start + flow.y) / 2 - 2.5, group, size=7)
                s.line(228, start, 228, y1=flow.y, weight=0.3)
                s.line(112, flow.y, 559, weight=0.3)
        low = flow.y
        texts = s.wrapped(s.section(section), 64, 6.6)
        for i, text in enumerate(texts):
            s.put(40, (top + low) / 2 - 2.5 + 4.2 * (len(texts) - 1) - 8.4 * i, text, size=6.6, bold=True)
        for x in xs:
            s.line(x, top + (16 if top > 770 else 0), x, y1=low, weight=0.3)
        s.line(36, top, 559)
        s.line(36, low, 559)


def tadano(s: Wording) -> None:
    """The section's name at the left, label and value at its right; a group's items on one line."""
    s.put(36, 800, s.machine.name, size=18, bold=True, ink="#003a70")
    s.line(36, 792, 559, weight=1.5)
    _foot(s)
    flow = Flow(s, ((36, 559),), 784, 42, 806)
    for section, rows in _kept(s):
        groups = [list(some) for _, some in groupby(rows, lambda r: r.label.partition(" > ")[0])]
        flow.keep(min(12 * len(groups) + 10, 500))
        first = True
        for own in groups:
            group, mark, _ = own[0].label.partition(" > ")
            *_, y = flow.room(12)
            if first:
                for i, text in enumerate(s.wrapped(s.section(section), 118, 8)[:2]):
                    s.put(36, y - 8.5 - 9.5 * i, text, size=8, bold=True, ink="#003a70")
                first = False
            texts = [row.said.both for row in own]
            if mark:
                texts = [f"{row.label.partition(' > ')[2]} {text}" for row, text in zip(own, texts, strict=True)]
            s.put(165, y - 8.5, group, size=7.5)
            s.put(345, y - 8.5, (" ／ " if s.style.language in _CJK else " / ").join(texts), size=7.5)
        *_, y = flow.room(8)
        s.line(36, y - 3, 559, weight=0.3)


_SAME = ("Load Center", "Fork ", "Mast Tilt", "Boom Sections", "Carrier Rollers", "Track Rollers")


def _beside(s: Wording, row: Row, steps: int) -> str:
    """The number of this model, or of the one beside it, which has forks and the like in common."""
    return row.said.number if row.name.startswith(_SAME) else _other(s, row, steps)


_REARS = {"en": "rear", "de": "hinten", "fr": "arrière"}


def hyster(s: Wording) -> None:
    """A type sheet: rotated section names, numbers, "symbol (unit)" and two models; "a / b" for what goes together."""
    names, place = _models(s)
    s.put(60, 806, s.machine.name.split()[0], size=18, bold=True)
    _foot(s)
    xs = (50.0, 72.0, 98.0, 330.0, 385.0, 465.0, 545.0)
    y = 790.0
    s.fill(50, y - 15, 495, 15, "#ffcb05")
    s.put(102, y - 10.5, s.one_of(MODEL), size=7.5, bold=True)
    for x, name in zip((425, 505), names, strict=True):
        s.put(x, y - 10.5, name, size=7.5, bold=True, align="c")
    y -= 15
    for number, (section, rows) in enumerate(_kept(s), 1):
        top = y
        groups = groupby(rows, lambda r: r.label.partition(" > ")[0])
        for index, (_, some) in enumerate(groups, 1):
            own = list(some)
            group, mark, _ = own[0].label.partition(" > ")
            label = group
            if mark:
                items = [row.label.partition(" > ")[2] for row in own]
                text = " / ".join(items)
                label = f"{group}, {text if s.style.language == 'de' else text.lower()}"
            cells = [" / ".join(_beside(s, row, i - place) for row in own) for i in range(2)]
            if own[0].name.startswith("Axle Load"):
                label += f" / {s.one_of(_REARS)}"
                rear = _rear(s, own[0].name)
                cells = [
                    f"{cell} / {rear if i == place else _near(s, rear, i - place)}" for i, cell in enumerate(cells)
                ]
            symbols = [_SYMBOLS.get(row.name, "").split("/")[0] for row in own]
            symbol = symbols[0]
            if own[0].name.startswith("Mast Tilt"):
                symbol = " / ".join({"F": "α", "B": "β"}[row.name[10]] for row in own)
            if len(own) == 3:
                symbol = "s / e / l"
            unit = own[0].said.unit
            s.put(85, y - 8.6, f"{number}.{index}", size=6.8, align="c")
            s.put(102, y - 8.6, label, size=6.8)
            s.put(357.5, y - 8.6, f"{symbol} ({unit})".strip() if unit else symbol, size=6.8, align="c")
            for x, cell in zip((425, 505), cells, strict=True):
                s.put(x, y - 8.6, cell, size=6.8, align="c")
            y -= 12
            s.line(72, y, 545, weight=0.3)
        s.fill(50, y, 22, top - y, "#e8e8e8")
        s.canvas.saveState()
        s.canvas.translate(63.5, (top + y) / 2)
        s.canvas.rotate(90)
        size = min(6.8, 6.8 * (top - y - 4) / s.width(s.section(section), 6.8, True))
        if size >= 4:  # else the cell is left empty
            s.put(0, 0, s.section(section), size=size, bold=True, align="c")
        s.canvas.restoreState()
        for x in xs:
            s.line(x, top, x, y1=y, weight=0.3)
        for edge in (top, y):
            s.line(50, edge, 545, weight=0.8)


def _near(s: Wording, text: str, steps: int) -> str:
    value = float(re.sub(r"[^\d]", "", text))
    return s.digits(10 * round(value * (1 + 0.07 * steps) / 10), 0)


def yanmar(s: Wording) -> None:
    """Lettered tables two up under a drawing; the rest in two columns, a rule under each line, values at the right."""
    s.put(36, 804, s.machine.name, size=16, bold=True, ink="#c8102e")
    _foot(s)
    sections = _kept(s)
    y = 792.0
    for section, rows in sections:
        if section not in _LETTERED:
            continue
        letters = _lettered(s, rows)
        s.put(36, y - 10, s.section(section).upper(), size=9.5, bold=True, ink="#c8102e")
        y -= 16
        _outline(s, 150, y, 300, list(letters.values()))
        y -= 104
        half = (len(rows) + 1) // 2
        for i, row in enumerate(rows):
            x0 = 36.0 if i < half else 300.0
            low = y - 13 * (i % half + 1)
            value = row.said.both
            texts = s.wrapped(_joined(s, row), 236 - s.width(value, 6.8) - 6, 6.8)
            s.put(x0 + 8, low + 4, letters.get(row.name, ""), size=7, bold=True, align="c")
            for k, text in enumerate(texts):
                s.put(
                    x0 + 20, low + (4 if len(texts) == 1 else 7.2 - 6.4 * k), text, size=6.8 if len(texts) == 1 else 6
                )
            s.put(x0 + 256, low + 4, value, size=6.8, align="r")
            s.canvas.setLineWidth(0.3)
            s.canvas.rect(x0, low, 259, 13, stroke=1, fill=0)
            s.line(x0 + 16, low, x0 + 16, y1=low + 13, weight=0.3)
        y -= 13 * half + 10
    flow = Flow(s, ((36, 288), (307, 559)), y, 42, 806)
    for section, rows in sections:
        if section in _LETTERED:
            continue
        flow.keep(min(22 + 12 * (len(rows) + 1), 500))
        x0, x1, y = flow.room(17)
        s.put(x0, y - 11, s.section(section), size=9, bold=True, ink="#c8102e")
        s.line(x0, y - 14.5, x1, weight=1)
        for label, row, inner in _grouped(rows):
            flow.keep(40 if row is None else 12)
            value = row.said.both if row else ""
            room = x1 - x0 - s.width(value, 7) - 14 - 8 * inner
            texts = s.wrapped(label or (_joined(s, row) if row else ""), room, 7)
            x0, x1, y = flow.room(8.6 * len(texts) + 3.4)
            for i, text in enumerate(texts):
                s.put(x0 + 8 * inner, y - 8.5 - 8.6 * i, text, size=7)
            s.put(x1, y - 8.5, value, size=7, align="r")
            s.line(x0, y - 8.6 * len(texts) - 3, x1, weight=0.2)
        flow.room(8)


def sany(s: Wording) -> None:
    """A striped table two up: the unit in brackets behind each label, the bare number beside it."""
    s.fill(0, 790, 595, 36, "#b5121b")
    s.put(36, 802, f"{s.machine.name}  {s.one_of(TITLE)}", size=14, bold=True, ink="#ffffff")
    _foot(s)
    cjk = s.style.language in _CJK
    flow = Flow(s, ((36, 559),), 780, 42, 806)
    for section, rows in _kept(s):
        flow.keep(min(20 + 14 * ((len(rows) + 1) // 2), 500))
        *_, y = flow.room(17)
        s.put(36, y - 12, s.section(section), size=9.5, bold=True, ink="#b5121b")
        s.line(36, y - 16, 559, weight=1)
        for i in range(0, len(rows), 2):
            *_, y = flow.room(14)
            if i % 4 == 0:
                s.fill(36, y - 14, 523, 14, "#f0f0f0")
            for row, x in zip(rows[i : i + 2], (36, 300), strict=False):
                unit = row.said.unit
                tail = "" if not unit else f"（{unit}）" if cjk else f" ({unit})"
                s.put(x + 5, y - 9.8, _joined(s, row) + tail, size=7.2)
                s.put(x + 250, y - 9.8, row.said.number, size=7.2, align="r")
        flow.room(6)


def develon(s: Wording) -> None:
    """Two columns; a heading in colour, a sentence under some, then label and value, dotted rules between lines."""
    s.put(36, 800, s.one_of(TITLE).upper(), size=17, bold=True, ink="#ff5a00")
    s.put(559, 800, s.machine.name, size=13, bold=True, align="r")
    _foot(s)
    flow = Flow(s, ((36, 288), (307, 559)), 782, 42, 806)
    for section, rows in _kept(s):
        prose = s.wrapped(s.one_of(PROSE[section]), 250, 7) if section in PROSE else []
        flow.keep(min(28 + 9 * len(prose) + 12.5 * (len(rows) + 1), 500))
        x0, x1, y = flow.room(17)
        s.put(x0, y - 12, "| " + s.section(section), size=10, bold=True, ink="#ff5a00")
        for text in prose:
            x0, x1, y = flow.room(9)
            s.put(x0, y - 7.5, text, size=7, ink="#444444")
        for label, row, inner in _grouped(rows):
            flow.keep(40 if row is None else 12)
            texts = s.wrapped(label or (_joined(s, row) if row else ""), 158 - 8 * inner, 7)
            x0, x1, y = flow.room(8.6 * len(texts) + 4)
            for i, text in enumerate(texts):
                s.put(x0 + 8 * inner, y - 8.5 - 8.6 * i, text, size=7)
            if row is not None:
                s.put(x0 + 166, y - 8.5, row.said.both, size=7)
            s.canvas.setDash(1, 1.5)
            s.line(x0, y - 8.6 * len(texts) - 3.6, x1, weight=0.3)
            s.canvas.setDash()
        flow.room(8)


_IMPERIAL = re.compile(r"([\d.,\- ]*\d|\d+' ?\d+\") ?(.*)")


def jcb(s: Wording) -> None:
    """Tables with a unit column for both systems, "mm (ft-in)", and the model's name over the values; letters first."""
    s.fill(36, 796, 523, 22, "#ffb500")
    s.put(42, 802, f"{s.one_of(TITLE).upper()}  |  {s.machine.name}", size=13, bold=True)
    _foot(s)
    flow = Flow(s, ((80, 515),), 788, 42, 806)
    for section, rows in _kept(s):
        letters = _lettered(s, rows) if section in ("loader", "hoe", *_LETTERED) else {}
        flow.keep(min(40 + 13 * len(rows), 500))
        x0, x1, y = flow.room(18)
        s.put(x0, y - 12, s.section(section).upper(), size=9.5, bold=True)
        x0, x1, y = flow.room(13)
        s.fill(x0, y - 13, x1 - x0, 13, "#3a3a3a")
        s.put(x0 + 4, y - 9, s.one_of(MODEL), size=7.2, bold=True, ink="#ffffff")
        s.put(x0 + 330, y - 9, s.machine.name, size=7.2, bold=True, ink="#ffffff")
        for row in rows:
            x0, x1, y = flow.room(13)
            found = _IMPERIAL.fullmatch(row.said.imperial)
            number, unit = (found[1], found[2] or "ft-in") if found else ("", "")
            s.put(x0 + 9, y - 9, letters.get(row.name, ""), size=7.2, bold=True, align="c")
            s.put(x0 + (20 if letters else 4), y - 9, _joined(s, row), size=7.2)
            s.put(x0 + 240, y - 9, f"{row.said.unit} ({unit})" if number else row.said.unit, size=7.2)
            s.put(x0 + 330, y - 9, f"{row.said.number} ({number})" if number else row.said.number, size=7.2)
            s.line(x0, y - 12.8, x1, weight=0.3)
        flow.room(9)


# ---- set ---------------------------------------------------------------------------------------------------------
@dataclass(frozen=True)
class More(Worded):
    """A set whose machines have a gross power, or one of which nothing is said, and the depth of a level bottom."""

    def cases(self) -> list[tuple[str, str, str, Machine]]:
        """As `Worded.cases`."""
        found = []
        for kind, layout, style, machine in super().cases():
            values = dict(machine.values)
            power = values["Net Power"]
            if kind in ("forklift", "mobile_crane"):
                values["Engine Power"] = values.pop("Net Power")
            else:
                values["Gross Power"] = float(round(1.04 * power + 1))
            if kind == "excavator":
                depth = values["Maximum Digging Depth"]
                values[_LEVEL] = rounded(kind, "Maximum Digging Depth", depth - 195)
            found.append((kind, layout, style, replace(machine, values=values)))
        return found


_DE = Style("de", 0, group=".", point=",", pressure="bar")
_FR = Style("fr", 0, group="\u00a0", point=",", pressure="bar")
STYLES = {
    "en_us": Style("en", 0, metres=True, imperial=True, pressure="kPa", feet="{} ft. {} in."),
    "en_int": Style("en", 1),
    "en_eu": Style("en", 1, group=" ", pressure="bar"),
    "en_jcb": Style("en", 1, metres=True, imperial=True, group="", pressure="bar", feet="{}-{}"),
    "en_t": Style("en", 1, metres=True, pressure="bar", tonnes=True),
    "de": _DE,
    "de_t": replace(_DE, metres=True, tonnes=True),
    "fr": _FR,
    "fr_mpa": replace(_FR, pressure="MPa"),
    "es_us": Style("es", 0, imperial=True, pressure="kPa", feet="{}' {}\""),
    "es": Style("es", 0, group=".", point=",", pressure="bar"),
    "zh": Style("zh", 0, group=""),
    "zh_m": Style("zh", 0, metres=True, group=""),
    "ja": Style("ja", 0),
    "ja_m": Style("ja", 0, metres=True),
}
FRESH6 = More(
    "fresh6",
    "V",
    {f.__name__: f for f in (deere, kubota, tadano, hyster, yanmar, sany, develon, jcb)},
    STYLES,
    {
        "wheel_loader": "deere:en_us develon:en_int jcb:en_jcb develon:de tadano:fr_mpa deere:es_us sany:zh yanmar:ja "
        "kubota:fr kubota:zh",
        "excavator": "deere:en_us develon:en_eu yanmar:en_int kubota:de yanmar:fr develon:es sany:zh tadano:ja "
        "develon:ja_m kubota:en_int",
        "articulated_dump_truck": "develon:en_eu deere:fr yanmar:ja",
        "rigid_dump_truck": "deere:en_us develon:es tadano:ja",
        "dozer": "deere:en_us develon:de kubota:es sany:zh_m",
        "grader": "deere:en_us tadano:fr sany:zh",
        "backhoe_loader": "deere:en_us jcb:en_jcb develon:de deere:es_us",
        "forklift": "hyster:en_int hyster:de hyster:fr kubota:ja",
        "mobile_crane": "tadano:en_us tadano:de_t develon:en_t sany:zh_m",
        "skid_steer": "jcb:en_jcb develon:de kubota:fr yanmar:ja",
    },
)
