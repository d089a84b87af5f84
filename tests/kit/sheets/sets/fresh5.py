"""The set "fresh5": other machines of all ten types in seven layouts, each after a kind of page that makers print.

A lettered table under a drawing; blocks with their unit in the heading; a numbered list with symbols and units, two
values in a cell; a column for each system; a label over its value; a one-page sheet with key figures; a box in prose.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from kit.sheets.machines import rounded
from kit.sheets.sets.rows import colon, figure, phrase
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Row, Said, Truth, Worded, Wording, lines

_INK, _BLUE, _SAND, _ASH = "#23272e", "#14507a", "#f3efe4", "#ededed"
_POWER = {"de": (1.35962, "PS"), "fr": (1.35962, "ch"), "es": (1.35962, "CV")}
_UNITS = {
    "de": {"L/min": "l/min", "rpm": "U/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "fr": {"L/min": "l/min", "rpm": "tr/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "es": {"L/min": "l/min", "L": "l", "N·m": "Nm"},
    "zh": {"rpm": "r/min"}, "ja": {"rpm": "min-1"},
}  # fmt: skip
_BRITISH = {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"}
_AMERICAN = {"gal/min": "gpm", "lbf·ft": "lb-ft", "yd³": "cu yd"}
_OTHERS = {"L": (0.264172, 1, "gal"), "N·m": (0.737562, 0, "lb-ft"), "kg": (2.20462, 0, "lb"),
           "m²": (10.7639, 1, "ft²"), "MPa": (145.038, 0, "psi"), "bar": (14.5038, 0, "psi"),
           "kPa": (0.145038, 0, "psi"), "L/min": (0.264172, 1, "gpm"), "km/h": (0.621371, 1, "mph"),
           "m/min": (3.28084, 0, "ft/min")}  # fmt: skip
_GRAVE = {"kN": (101.97, -1, "kgf"), "MPa": (10.197, 0, "kgf/cm²"), "kPa": (0.010197, 2, "kgf/cm²"),
          "kW": (1.35962, 0, "PS")}  # fmt: skip
_KEYS = ("Operating Weight", "Rated Payload", "Net Power", "Rated Capacity", "Maximum Lifting Capacity",
         "Rated Operating Capacity", "Bucket Capacity", "Bucket Capacity Heaped", "Lift Height", "Boom Length Extended",
         "Maximum Digging Depth", "Body Capacity Heaped", "Overall Width")  # fmt: skip
_LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
_SCALED = {"Rated Capacity": ("t", 1e-3), "Drawbar Pull": ("N", 1e3)}  # of industrial trucks
_SIZED = {"mm", "m", "kg", "t", "kW", "kN", "m³"}


# ---- what is printed -------------------------------------------------------------------------------------------------


def _start(s: Wording, *, whole: bool = False) -> float:
    """The model's name, a note at the foot; the edge below. `whole`: of the names of a pair all or none are printed."""
    kind, language = s.machine.kind, s.style.language
    unsaid = {one.name for one in lines(s.file)[kind] if not one.name.startswith("@") and "-" in one.words[language]}
    left = set(s.left_out) | unsaid
    for names, _, _ in _pairs(s) if whole else []:
        if not set(names) - {"*"} <= left:
            left -= set(names)
    s.left_out = frozenset(left)
    width, height = s.size
    s.put(40, height - 48, s.machine.name, size=20, bold=True, ink=_BLUE)
    s.put(width - 40, height - 48, phrase(s, "data"), size=11, align="r", ink="#666666")
    s.line(40, height - 56, width - 40, weight=1.2)
    s.put(40, 22, phrase(s, "note"), size=5.8, ink="#666666")
    return height - 68


def _pairs(s: Wording) -> list[tuple[list[str], str, str]]:
    """What stands in one cell on a sheet of this type: names, label and what parts the numbers."""
    found = []
    for one in lines(s.file)["pairs"]:
        kind, _, mark = one.place.split()
        if kind == s.machine.kind and s.style.language in one.words:
            found.append((one.name.split(" + "), s.of(one), f" {mark} "))
    return found


def _local(s: Wording, said: Said, name: str = "") -> Said:
    """A value with its units as the country writes them, and a second unit where it prints one."""
    style, language = s.style, s.style.language
    units = _UNITS.get(language, _BRITISH if language == "en" and not style.imperial else {})
    number, _, unit = said.imperial.rpartition(" ")
    second = f"{number} {_AMERICAN.get(unit, unit)}".strip()
    value = said.number.replace(style.group, "").replace(style.point, ".") if name else ""
    if not name and style.imperial and said.unit and re.fullmatch(r"[\d.,\s]+", said.number):
        number = float(said.number.replace(style.group, "").replace(style.point, "."))
        factor, decimals, unit = _OTHERS.get(said.unit, (0.0, 0, ""))
        second = f"{s.digits(number * factor, decimals)} {unit}" if unit and (unit != "gal" or number > 10) else ""
    if name and language == "ja" and style.wording and said.unit in _GRAVE:
        factor, decimals, unit = _GRAVE[said.unit]
        second = f"{s.digits(round(float(value) * factor, decimals), max(decimals, 0))} {unit}"
    elif name and said.unit == "kW" and language in _POWER and not style.imperial:
        second = f"{s.digits(float(value) * _POWER[language][0], 0)} {_POWER[language][1]}"
    return Said(said.number, units.get(said.unit, said.unit), second)


def _rows(s: Wording, section: str, *, pairs: bool = False, rams: str = "rows") -> list[Row]:
    """The rows of a section as the country writes them. `rams`: a row for each measure, `product`, or `triple`."""
    rows = _triples(s) if section == "cylinders" and rams == "triple" else s.rows(section, cylinders=rams)
    for one in lines(s.file)["derived"]:
        kind, base, factor = one.place.split(", ")
        if one.name == section and kind == s.machine.kind and s.prints(base) and s.of(one) != "-":
            value = rounded(kind, base, s.machine.values[base] * float(factor))
            rows.insert(s.dice.randrange(len(rows) + 1), Row(s.of(one), s.say(base, value, note=False), "*"))
            s.note_level_cut(s.of(one), value / 1e3)
    if section == "engine" and not s.prints("Net Power") and s.machine.kind != "forklift":
        power = float(round(s.machine.values["Net Power"] * 1.04))
        s.allowed |= dict.fromkeys(("Engine Power", "Gross Power"), Truth(power * 1e3, power * 1e-3))
        rows.insert(0, Row(phrase(s, "gross"), s.say("Net Power", power, note=False), "*"))
    rows = [replace(row, said=_local(s, row.said, row.name)) for row in rows]
    for names, label, mark in _pairs(s) if pairs else []:
        own = [row for row in rows if row.name in names]
        if len(own) != len(names) - names.count("*"):
            continue
        numbers = mark.join(_rear(s, names[0], 0) if name == "*" else _number(s, name, 0) for name in names)
        rows[rows.index(own[0])] = Row(label, Said(numbers, own[0].said.unit), " + ".join(names))
        rows = [row for row in rows if row not in own]
    return rows


def _number(s: Wording, name: str, step: int, factor: float = 1.0) -> str:
    """A wanted value's number for this model, or for one that is so many steps larger; `factor`: in another unit."""
    said, value = s.say(name, note=False), s.machine.values[name]
    if step and said.unit in _SIZED and name != "Load Center":
        value = rounded(s.machine.kind, name, value * (1 + 0.07 * step))
        said = s.say(name, value, note=False)
    return said.number if factor == 1 else s.digits(value * factor, 2 if factor < 1 else 0)


def _rear(s: Wording, front: str, step: int) -> str:
    """The rear axle's load that belongs to a front axle's."""
    values = s.machine.values
    rear = values["Operating Weight"] - values[front] + (values["Rated Capacity"] if " Laden" in front else 0)
    return s.digits(max(round(rear * (1 + 0.07 * step), -1), 100), 0)


def _triples(s: Wording) -> list[Row]:
    """Cylinders by bore, rod and stroke on one line where all three are printed, else a row for each measure."""
    found, rest = [], s.rows("cylinders")
    for one in lines(s.file)[s.machine.kind]:
        names = [f"{one.name[1:]} Cylinder {part}" for part in ("Bore", "Rod Diameter", "Stroke")]
        own = sorted((row for row in rest if row.name in names), key=lambda row: names.index(row.name))
        if one.name.startswith("@") and len(own) == 3:
            text = " × ".join(row.said.number for row in own)
            found.append(Row(f"{s.of(one)} ({one.place}), {phrase(s, 'triple')}", Said(text, "mm"), names[0]))
        elif one.name.startswith("@"):
            found += own
    return found


def _text(s: Wording, row: Row, *, first: bool = False) -> str:
    """A value with both its units, in braces in Japan; `first`: the imperial one first. Power at its speed."""
    said = row.said
    text = said.metric
    if said.imperial:
        text = f"{said.imperial} ({text})" if first else f"{text} ({said.imperial})"
        if s.style.language == "ja":
            text = f"{said.metric} {{{said.imperial}}}"
    if said.unit == "kW" and row.name and not first:
        at = phrase(s, "at").format(s.digits(2000, 0))
        text += at if at[0] == "/" else f" {at}"
    return text


def _blocks(s: Wording, **options: bool | str) -> list[tuple[str, list[Row]]]:
    """The sections that have rows."""
    found = [(one, _rows(s, one, **options)) for one in s.sections()]  # type: ignore[arg-type]
    return [(one, rows) for one, rows in found if rows]


def _bottom(blocks: list[tuple[str, list[Row]]], top: float, columns: int, row: float, head: float) -> float:
    """The lower edge at which columns of one page are about equally full, were each piece so high."""
    high = sum(head + row * len(rows) for _, rows in blocks)
    return max(44.0, top - 0.98 * high / columns - 2 * row)


# ---- layouts ---------------------------------------------------------------------------------------------------------


def drawn(s: Wording) -> None:
    """A drawing with letters and their table; the other sections in columns with dotted leaders."""
    top = _start(s)
    blocks = _blocks(s, rams="triple" if s.style.imperial else "product")
    first = s.style.imperial and s.style.language == "en"
    lettered = [(one, rows) for one, rows in blocks if one in ("working", "dimensions")]
    letters = [_LETTERS[i % 24] + "1" * (i // 24) for i in range(sum(len(rows) for _, rows in lettered))]
    figure(s, 44, top - 200, 507, 200, letters)
    flow = Flow(s, ((40, 290), (305, 555)), top - 212, 44, 800)
    marks = iter(letters)
    for section, rows in [*lettered, *(block for block in blocks if block not in lettered)]:
        shown = (section, rows) in lettered
        flow.keep(18 + 12 * min(len(rows), 5))
        x0, x1, y = flow.room(17)
        s.put(x0, y - 11, s.section(section).upper(), size=9, bold=True, ink=_BLUE)
        s.line(x0, y - 14, x1, weight=0.8)
        for row in rows:
            value, mark = _text(s, row, first=first), next(marks) if shown else ""
            texts = s.wrapped(s.joined(row.label), 240 - s.width(value, 7.2) - (18 if mark else 2), 7.2)
            x0, x1, y = flow.room(9 * len(texts) + 2.6)
            left, base = x0 + (16 if mark else 0), y - 9 * len(texts)
            s.put(x0, y - 9, mark, size=7.2, bold=True)
            s.put(x1, base, value, size=7.2, align="r")
            for index, text in enumerate(texts):
                s.put(left, y - 9 - 9 * index, text, size=7.2)
            left += s.width(texts[-1], 7.2) + 2
            dots = 0 if mark else int((x1 - s.width(value, 7.2) - 2 - left) / s.width(".", 7.2))
            s.put(x1 - s.width(value, 7.2) - 2, base, "." * dots if dots > 2 else "", size=7.2, align="r")
            if mark:
                s.line(x0, base - 2.4, x1, weight=0.2)
        flow.room(7)


def unitary(s: Wording) -> None:
    """Two columns of ruled blocks; where a block has one unit its bar says it. An excavator's ranges for two arms."""
    top = _start(s)
    arms: list[str] = []
    if s.machine.kind == "excavator":
        long = s.machine.values["Arm Length"] / 1000
        arms = [phrase(s, "arm").format(f"{x:.2f}") for x in (round(long - 0.5, 1), long)]
        s.config = arms[1]
    blocks = _blocks(s, pairs=True, rams="product")
    flow = Flow(s, ((40, 291), (304, 555)), top, _bottom(blocks, top, 2, 14, 34), 800)
    for section, rows in blocks:
        shown = [row.said.unit for row in rows]
        unit = max(("mm", "m"), key=shown.count)
        unit = unit if shown.count(unit) >= max(3, len(rows) // 2) and section != "cylinders" else ""
        columns = arms if section == "working" else []
        flow.keep(28 + 13 * min(len(rows), 7 if not columns else len(rows)))
        x0, x1, y = flow.room(15)
        s.fill(x0, y - 13.5, x1 - x0, 13.5, _BLUE)
        s.put(x0 + 4, y - 9.8, s.section(section), size=8.2, bold=True, ink="#ffffff")
        if unit:
            s.put(x1 - 4, y - 9.8, phrase(s, "unit").format(unit), size=7, align="r", ink="#ffffff")
        xs = (x1 - 84, x1 - 4) if columns else (x1 - 4,)
        if columns:
            x0, x1, y = flow.room(12)
            for x, head in zip(xs, columns, strict=True):
                s.put(x, y - 8.5, head, size=7, bold=True, align="r")
        for row in rows:
            values = [row.said.number if unit and row.said.unit == unit else _text(s, row)]
            if columns:
                less = rounded(s.machine.kind, row.name, s.machine.values[row.name] * 0.945) if row.name != "*" else 0
                other = s.say(row.name, less, note=False).metric if less else "–"
                values.insert(0, other.replace(f" {unit}", "") if unit else other)
            texts = s.wrapped(s.joined(row.label), xs[0] - x0 - s.width(values[0], 7.2) - 12, 7.2)
            x0, x1, y = flow.room(9 * len(texts) + 4)
            xs = (x1 - 84, x1 - 4) if columns else (x1 - 4,)
            for index, text in enumerate(texts):
                s.put(x0 + 4, y - 9.2 - 9 * index, text, size=7.2)
            for x, shown_value in zip(xs, values, strict=True):
                s.put(x, y - 4.7 - 4.5 * len(texts), shown_value, size=7.2, align="r")
            s.line(x0, y - 9 * len(texts) - 4, x1, weight=0.3)
        flow.room(8)


def coded(s: Wording) -> None:
    """A numbered list: number, item, unit, a column for each model; an industrial truck's with its symbols."""
    truck = s.machine.kind == "forklift"
    top = _start(s, whole=truck)
    steps = (-1, 0, 1) if truck and s.style.language != "en" else (0,)
    names = [f"{s.machine.name[:-3]}{int(s.machine.name[-3:]) + 15 * i}" for i in steps]
    s.config = s.machine.name if len(steps) > 1 else ""
    flow = Flow(s, ((40, 555),), top, 44, 796)
    symbol, unit, last = (262.0, 304.0, 338.0) if len(steps) > 1 else (290.0, 330.0, 392.0)
    xs = [last + (555 - last) * (i + 0.5) / len(steps) for i in range(len(steps))]
    page = -1
    for number, (section, rows) in enumerate(_blocks(s, pairs=truck, rams="rows" if truck else "triple"), 1):
        if truck:
            rows = sorted(rows, key=lambda row: [int(x) for x in _code(s, row)[0].split(".")])
        flow.keep(14 + 13 * min(len(rows), 4))
        for index, row in enumerate([None, *rows]):
            texts = s.wrapped(s.joined(row.label), (symbol if truck else unit) - 88, 7.4) if row else []
            x0, x1, y = flow.room(9 * len(texts) + 4 if row else 14)
            if flow.place != page:
                page = flow.place
                s.fill(x0, y - 15, x1 - x0, 15, _INK)
                for x, head in zip((44.0, 78.0, symbol, unit), phrase(s, "heads").split(" / "), strict=True):
                    s.put(x, y - 10.5, "" if x == symbol and not truck else head, size=7.5, bold=True, ink="#ffffff")
                for x, name in zip(xs, names, strict=True):
                    s.put(x, y - 10.5, name, size=7.5, bold=True, align="c", ink="#ffffff")
                flow.room(15)
                y -= 15
            if row is None:
                s.fill(x0, y - 14, x1 - x0, 14, _ASH)
                s.put(44, y - 10, f"{number}" if not truck else "", size=8, bold=True)
                s.put(78, y - 10, s.section(section), size=8, bold=True)
                continue
            code, sign = _code(s, row) if truck else (f"{number}.{index}", "")
            s.put(44, y - 9.4, code.replace("99", ""), size=7.2)
            for line, text in enumerate(texts):
                s.put(78, y - 9.4 - 9 * line, text, size=7.4)
            s.put(symbol, y - 9.4, sign, size=7.2)
            shown, factor = _SCALED.get(row.name if truck else "", (row.said.unit, 1.0))
            s.put(unit, y - 9.4, shown, size=7.2)
            if factor != 1:
                s.printed[row.name] = _number(s, row.name, 0, factor)
            for x, step in zip(xs, steps, strict=True):
                s.put(x, y - 9.4, _stepped(s, row, step, factor), size=7.4, align="c")
            s.line(x0, y - 9 * len(texts) - 4, x1, weight=0.25)


def _code(s: Wording, row: Row) -> tuple[str, str]:
    """The number and the symbol of an industrial truck's item."""
    name = row.name.partition(" + ")[0]
    return next(((one.place, one.words["sign"][0]) for one in lines(s.file)["codes"] if one.name == name), ("99", ""))


def _stepped(s: Wording, row: Row, step: int, factor: float) -> str:
    """A cell of the list for a model so many steps larger."""
    names = row.name.split(" + ")
    if len(names) > 1:
        mark = " × " if "×" in row.said.number else " / "
        return mark.join(_rear(s, names[0], step) if name == "*" else _number(s, name, step) for name in names)
    if row.name in s.machine.values and " Cylinder " not in row.name:
        return _number(s, row.name, step, factor)
    return row.said.number


def systems(s: Wording) -> None:
    """One striped table: item, then a column for each system of units, the country's own first; or one of values."""
    top = _start(s)
    flow = Flow(s, ((40, 555),), top, 44, 796)
    both = s.style.imperial
    own = both and s.style.language == "en"
    heads = phrase(s, "systems").split(" / ")
    stripe = 0
    for section, rows in _blocks(s, rams="triple" if both else "product"):
        flow.keep(16 + 12 * min(len(rows), 5))
        x0, x1, y = flow.room(16)
        s.put(x0 + 4, y - 11, s.section(section), size=9, bold=True, ink=_BLUE)
        for x, head in zip((340, 455), heads, strict=True):
            s.put(x, y - 11, head if both else "", size=8, bold=True, ink=_BLUE)
        s.line(x0, y - 15, x1, weight=0.8)
        for row in rows:
            x0, x1, y = flow.room(12)
            stripe += 1
            if stripe % 2:
                s.fill(x0, y - 12, x1 - x0, 12, _SAND)
            s.put(x0 + 4, y - 8.8, s.joined(row.label), size=7.6)
            cells = [row.said.metric, row.said.imperial]
            if own and (row.said.imperial or row.said.unit == "mm"):
                cells.reverse()
            for x, cell in zip((340, 455), cells if both else [_text(s, row), ""], strict=True):
                s.put(x, y - 8.8, cell, size=7.6)
        flow.room(8)


def stacked(s: Wording) -> None:
    """Four narrow columns, each label in bold with its value on the line below it."""
    top = _start(s)
    edges = tuple((40 + 131.0 * i, 40 + 131.0 * i + 120) for i in range(4))
    blocks = _blocks(s, rams="triple")
    flow = Flow(s, edges, top, _bottom(blocks, top, 4, 25, 24), 796)
    for section, rows in blocks:
        flow.keep(66)
        x0, x1, y = flow.room(18)
        s.fill(x0, y - 13, x1 - x0, 13, _BLUE)
        s.put(x0 + 4, y - 9.6, s.section(section).upper(), size=7.6, bold=True, ink="#ffffff")
        for row in rows:
            texts = s.wrapped(s.joined(row.label), x1 - x0 - 14, 6.8)  # set in bold
            values = s.wrapped(_text(s, row), x1 - x0 - 2, 7.2)
            x0, x1, y = flow.room(8.6 * (len(texts) + len(values)) + 5)
            for index, text in enumerate(texts):
                s.put(x0, y - 8 - 8.6 * index, text, size=6.8, bold=True)
            for index, text in enumerate(values):
                s.put(x0, y - 8.4 - 8.6 * (len(texts) + index), text, size=7.2)
        flow.room(6)


def onepage(s: Wording) -> None:
    """One page: four key figures in tiles, then two striped columns with a colon after each label."""
    top = _start(s)
    blocks = _blocks(s, rams="product")
    every = {row.name: row for _, rows in blocks for row in rows}
    for index, row in enumerate([every[name] for name in _KEYS if name in every][:4]):
        x = 40 + 131 * index
        s.fill(x, top - 48, 122, 46, _SAND)
        s.put(x + 61, top - 22, replace(row.said, imperial="").metric, size=13, bold=True, align="c", ink=_BLUE)
        for line, text in enumerate(s.wrapped(row.label, 114, 6.8)[:2]):
            s.put(x + 61, top - 34 - 8 * line, text, size=6.8, align="c")
    flow = Flow(s, ((40, 291), (304, 555)), top - 60, _bottom(blocks, top - 60, 2, 10.8, 14), 796)
    stripe = 0
    for section, rows in blocks:
        flow.keep(24)
        x0, x1, y = flow.room(14)
        s.put(x0 + 2, y - 10.5, s.section(section), size=8.4, bold=True, ink=_INK)
        for row in rows:
            value = _text(s, row)
            texts = s.wrapped(s.joined(row.label) + colon(s), x1 - x0 - s.width(value, 7) - 10, 7)
            x0, x1, y = flow.room(8.4 * len(texts) + 2.2)
            stripe += 1
            if stripe % 2:
                s.fill(x0, y - 8.4 * len(texts) - 2.2, x1 - x0, 8.4 * len(texts) + 2.2, _ASH)
            for index, text in enumerate(texts):
                s.put(x0 + 2, y - 7.8 - 8.4 * index, text, size=7)
            s.put(x1 - 2, y - 7.8, value, size=7, bold=True, align="r")


def press(s: Wording) -> None:
    """A trade paper's page: two columns of prose beside a picture, and the data run in, "label: value", in a box."""
    top = _start(s)
    s.fill(380, top - 128, 175, 122, "#d9d9d9")
    y = top - 12
    for text in s.wrapped(phrase(s, "prose"), 325, 9):
        s.put(40, y, text, size=9)
        y -= 12.5
    blocks = _blocks(s, rams="product")
    flow = Flow(s, ((48, 288), (308, 547)), top - 150, _bottom(blocks, top - 150, 2, 11.4, 18), 790)
    page = -1
    for section, rows in blocks:
        flow.keep(40)
        for row in [None, *rows]:
            texts = s.wrapped(f"{s.joined(row.label)}{colon(s)} {_text(s, row)}", 238, 7.6) if row else []
            x0, _, y = flow.room(9.6 * len(texts) + 1.5 if row else 15)
            if flow.place // 2 != page:
                page = flow.place // 2
                s.fill(40, flow.bottom - 8, 515, flow.top - flow.bottom + 16, _SAND)
            if row is None:
                s.put(x0, y - 11, s.section(section), size=8.6, bold=True, ink="#8c2f1b")
            for index, text in enumerate(texts):
                s.put(x0, y - 8.6 - 9.6 * index, text, size=7.6)
        flow.room(3)


_DE = Style("de", 0, group=".", point=",", pressure="bar")
_FR = Style("fr", 0, group="\u00a0", point=",", pressure="bar")
_ES = Style("es", 0, group=".", point=",", pressure="bar")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, imperial=True, pressure="bar", feet="{}' {}\""),
    "en_usf": Style("en", 0, imperial=True, pressure="kPa", feet="{} ft {} in"),
    "en_us2": Style("en", 1, metres=True, imperial=True, pressure="MPa", feet="{}'{}\""),
    "en_za": Style("en", 0, imperial=True, group=" ", point=",", feet="{} ft {} in"),
    "en_gb": Style("en", 1, pressure="bar"),
    "en_uk": Style("en", 1, metres=True, pressure="bar"),
    "de": _DE,
    "de_2": replace(_DE, wording=1, group=" ", metres=True, tonnes=True),
    "fr": _FR,
    "fr_2": replace(_FR, wording=1, metres=True),
    "es": _ES,
    "es_mx": Style("es", 0, imperial=True, group=",", point=".", pressure="kPa", feet="{}' {}\""),
    "zh": Style("zh", 0, group=""),
    "zh_2": Style("zh", 1, group=","),
    "ja": Style("ja", 0),
    "ja_2": Style("ja", 1),
}
FRESH5 = Worded(
    "fresh5",
    "VR",
    {f.__name__: f for f in (drawn, unitary, coded, systems, stacked, onepage, press)},
    STYLES,
    {
        "wheel_loader": "drawn:en_us systems:en_gb stacked:de onepage:de_2 drawn:fr press:es coded:zh unitary:zh_2 "
        "unitary:ja unitary:en_uk onepage:fr_2 stacked:en_za",
        "excavator": "systems:en_us unitary:en_uk press:de onepage:fr press:fr_2 drawn:es coded:zh unitary:ja "
        "drawn:ja_2 stacked:de_2 unitary:zh_2 onepage:en_gb",
        "articulated_dump_truck": "stacked:en_za systems:en_us2 press:de onepage:fr",
        "rigid_dump_truck": "systems:en_usf stacked:es coded:zh",
        "dozer": "drawn:en_us stacked:de coded:zh unitary:ja",
        "grader": "drawn:en_usf press:fr systems:es_mx coded:zh",
        "backhoe_loader": "drawn:en_us press:en_gb stacked:fr onepage:es",
        "forklift": "coded:en_gb coded:de coded:ja onepage:zh",
        "mobile_crane": "systems:en_usf onepage:de coded:zh unitary:ja",
        "skid_steer": "systems:en_us press:de systems:fr onepage:es_mx",
    },
)
