"""The set "fresh8": machines of all ten types on seven kinds of pages, after the habits of Asian makers.

`komatsu`: three columns with leaders, items under subheads, both systems side by side, letters of a drawing; `hitachi`:
two columns, cylinders and working ranges as tables; `toyota`: three models, equal values in one cell across them;
`hyundai`: ruled cells with groups, "mm (ft·in)" in the bar; `xcmg`: item, unit and value two up in a grid; `ritchie`:
the print of a data base's page; `beml`: key figures, sentences, and colons in a column.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from kit.sheets.machines import rounded
from kit.sheets.sets.rows import figure, phrase
from kit.sheets.typeset import _CJK, HEIGHT, WIDTH, Style
from kit.sheets.worded import Flow, Row, Said, Truth, Worded, Wording, lines

_NET = re.compile(r"(?i)\bnet|ネット|净")
_UNITS = {
    "en": {"kN·m": "kNm", "N·m": "Nm"}, "zh": {"rpm": "r/min"}, "ja": {"rpm": "min-1"},
    "de": {"L/min": "l/min", "rpm": "min-1", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "fr": {"L/min": "l/min", "rpm": "tr/min", "kN·m": "kNm", "N·m": "Nm"},
    "es": {"L/min": "l/min", "L": "l", "N·m": "Nm"},
}  # fmt: skip
_DATA = {"L/min": "l/min", "N·m": "Nm", "L": "l", "m³": "m3"}
_SECOND = {"L": (0.264172, 1, "gal"), "N·m": (0.737562, 0, "lb ft"), "kg": (2.20462, 0, "lb"),
           "kN": (224.809, 0, "lbf"), "MPa": (145.038, 0, "psi"), "kPa": (0.145038, 0, "psi"),
           "L/min": (0.264172, 1, "gal/min"), "km/h": (0.621371, 1, "mph"), "m/min": (3.28084, 0, "ft/min"),
           "mm": (0.0393701, 1, "in")}  # fmt: skip
_KGF = {"kN": (101.97, -1, "kgf"), "MPa": (10.197, 0, "kgf/cm²"), "kPa": (0.010197, 2, "kgf/cm²")}
_PS = {"de": "PS", "fr": "ch", "es": "CV", "ja": "PS", "en": "PS"}
_KEYS = ("Net Power", "Operating Weight", "Rated Payload", "Bucket Capacity Heaped", "Bucket Capacity",
         "Moldboard Length", "Body Capacity Heaped", "Blade Capacity", "Maximum Digging Depth")  # fmt: skip
_POINTS = ("Breakout Force", "Bucket Digging Force", "Maximum Travel Speed", "Drawbar Pull", "Turning Radius",
           "Maximum Digging Height", "Dumping Clearance", "Body Dump Angle", "Loader Dump Height")  # fmt: skip
_SAME = {"°", "s", "km/h", "MPa", "bar", "m/s", "min-1", "r/min", ""}
_THREE = (358.0, 427.0, 496.0, 565.0)  # the edges of three models' columns
_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


def _title(s: Wording, ink: str) -> float:
    """The model on a band, and what the page is; the note at the foot; the edge below."""
    s.fill(0, HEIGHT - 46, WIDTH, 46, ink)
    s.put(30, HEIGHT - 32, s.machine.name, size=19, bold=True, ink="#ffffff")
    s.put(WIDTH - 30, HEIGHT - 30, phrase(s, "specs"), size=12, align="r", ink="#ffffff")
    s.put(30, 20, phrase(s, "note"), size=5.6, ink="#777777")
    return float(HEIGHT) - 58


def _local(s: Wording, row: Row) -> Row:
    """A row with its units as the maker writes them, and a second unit where it prints one."""
    style, said = s.style, row.said
    units = _DATA if style.language == "en" and style.wording else _UNITS[style.language]
    plain = said.number.replace(style.group, "").replace(style.point, ".")
    value = float(plain) if re.fullmatch(r"\d+(\.\d+)?", plain) else None
    second, other = said.imperial, (0.0, 0, "")
    if style.imperial and not row.name:
        other = _SECOND.get(said.unit, other)
    elif style.language == "ja" and style.wording:
        other = _KGF.get(said.unit, other)
    if said.unit == "kW" and not style.imperial and style.language in _PS:
        other = (1.35962, 0, _PS[style.language])
    if other[2] and value is not None:
        second = f"{s.digits(round(value * other[0], other[1]), max(other[1], 0))} {other[2]}"
    second = second.replace("yd³", "yd3") if units is _DATA else second
    return replace(row, said=Said(said.number, units.get(said.unit, said.unit), second))


def _power(s: Wording, rows: list[Row]) -> list[Row]:
    """An engine's rows: a power without "net" is no net power; a gross one may stand beside it."""
    net = next((row for row in rows if row.name == "Net Power"), None)
    if net and not _NET.search(net.label):
        truth = s.truth["Engine Power"] = s.truth.pop("Net Power")
        s.printed["Engine Power"] = s.printed.pop("Net Power")
        s.allowed = {"Net Power": truth, "Gross Power": truth}
        return rows
    label = next((s.of(one) for one in lines(s.file)["gross"] if one.name == s.machine.kind), "-")
    if label == "-" or s.dice.random() > 0.6:
        return rows
    value = float(round(s.machine.values["Net Power"] * 1.05))
    gross = Row(label, s.say("Net Power", value, note=False), "Gross Power")
    s.truth["Gross Power"] = Truth(value * 1e3, value * 1e-3)
    s.printed["Gross Power"] = gross.said.number
    s.allowed.setdefault("Engine Power", s.truth["Gross Power"])
    at = rows.index(net) if net else 0
    return [*rows[:at], gross, *rows[at:]]


def _rams(s: Wording, form: str) -> list[Row]:
    """Cylinders with number, bore and stroke on one line where both are printed; else a row for each measure."""
    found = []
    for one in lines(s.file)[s.machine.kind]:
        key, words = one.name[1:], s.of(one)
        names = [n for n in (f"{key} Cylinder {part}" for part in ("Bore", "Stroke", "Rod Diameter")) if s.prints(n)]
        if one.name.startswith("@") and [n[-4:] for n in names[:2]] == ["Bore", "roke"]:
            a, b = s.say(names[0]), s.say(names[1])
            second = f"{a.imperial} × {b.imperial}" if s.style.imperial else ""
            text = form.format(one.place, a.number, b.number)
            found.append(Row(f"{phrase(s, 'rams')} > {words}", Said(text, "mm", second), "*"))
            names = names[2:]
        for name in names if one.name.startswith("@") else []:
            found.append(Row(f"{words} > {s.part(name.partition(' Cylinder ')[2])}", s.say(name), name))
    return sorted(found, key=lambda row: row.name != "*")


def _blocks(s: Wording, form: str = "") -> list[tuple[str, list[Row]]]:
    """The sections that have rows; `form`: of cylinders on one line. What the words do not have is left out."""
    unsaid = {one.name for one in lines(s.file)[s.machine.kind] if not one.name.startswith("@") and s.of(one) == "-"}
    s.left_out = frozenset(s.left_out | unsaid)
    found = []
    for section in s.sections():
        rows = _rams(s, form) if form and section == "cylinders" else s.rows(section)
        for one in lines(s.file)["derived"]:
            kind, base, factor = one.place.split(", ")
            if (one.name, kind) == (section, s.machine.kind):
                value = rounded(kind, base, s.machine.values[base] * float(factor))
                rows.append(Row(s.of(one), s.say(base, value, note=False), "*"))
        rows = [_local(s, row) for row in (_power(s, rows) if section == "engine" else rows)]
        found += [(section, rows)] if rows else []
    return found


def _groups(rows: list[Row]) -> list[tuple[str, list[Row]]]:
    """Rows by their group ("" for none), labels without it."""
    found: dict[str, tuple[str, list[Row]]] = {}
    for row in rows:
        group, mark, item = row.label.partition(" > ")
        found.setdefault(group, (group if mark else "", []))[1].append(replace(row, label=item or group))
    return list(found.values())


def _text(s: Wording, row: Row, form: str = "{} ({})", *, at: bool = False) -> str:
    """A value with both its units; a power at its speed, if asked."""
    said, form = row.said, "{} {{{}}}" if s.style.language == "ja" else form
    text = form.format(said.metric, said.imperial) if said.imperial else said.metric
    return phrase(s, "at").format(text, s.digits(2000, 0)) if at and said.unit == "kW" else text


def _bottom(blocks: list[tuple[str, list[Row]]], top: float, columns: int, row: float, head: float) -> float:
    """The lower edge at which columns of one page are about equally full."""
    return max(36.0, top - sum(head + row * len(rows) for _, rows in blocks) / columns - 2.5 * row)


def _set(s: Wording, x: float, y: float, texts: list[str], size: float) -> None:
    """Lines of a text from the first one's baseline."""
    for index, text in enumerate(texts):
        s.put(x, y - index * (size + 1.6), text, size=size)


def _box(s: Wording, x: float, y: float, width: float, height: float, text: str, size: float, ink: str) -> None:
    """A tinted cell (its lower left corner) with a text in the middle of its height."""
    s.fill(x, y, width, height, ink)
    texts = s.wrapped(text, width - 8, size)
    _set(s, x + 4, y + height / 2 - 0.35 * size + (size + 1.6) * (len(texts) - 1) / 2, texts, size)


def _leader(s: Wording, flow: Flow, label: str, value: str, size: float, indent: float = 0, mark: str = "") -> None:
    """A label in lines, and dots to its value on the last; with a `mark` before it a rule below, and no dots."""
    x0, x1 = flow.columns[0]
    texts = s.wrapped(label, x1 - x0 - indent - s.width(value, size) - 8, size)
    high = (size + 1.6) * len(texts) + 1.8
    x0, x1, y = flow.room(high)
    base, left = y - high + 2.6, x0 + indent + s.width(texts[-1], size) + 1.5
    _set(s, x0 + indent, y - size - 0.8, texts, size)
    s.put(x1, base, value, size=size, align="r")
    s.put(x0, y - size - 0.8, mark, size=size, bold=True)
    dots = int((x1 - s.width(value, size) - 1.5 - left) / s.width(".", size))
    s.put(x1 - s.width(value, size) - 1.5, base, "." * dots if dots > 1 and not mark else "", size=size, align="r")
    if mark:
        s.line(x0, y - high + 0.4, x1, weight=0.2)


def komatsu(s: Wording) -> None:
    """Three columns: section in capitals over a rule, leaders, items indented under subheads; then lettered tables."""
    top, size = _title(s, "#140a9a"), 7.0
    blocks = _blocks(s, "{}–{} mm × {}")
    flow = Flow(s, ((30, 199), (213, 382), (396, 565)), top, _bottom(blocks, top, 3, 13, 26), 810)
    lettered = [block for block in blocks if block[0] in ("working", "dimensions")]
    letters: list[str] = []
    for section, rows in [*(block for block in blocks if block not in lettered), *lettered]:
        flow.keep(46)
        x0, x1, y = flow.room(18)
        s.put(x0, y - 11, s.section(section).upper(), size=9, bold=True, ink="#140a9a")
        s.line(x0, y - 14, x1, weight=1)
        if (section, rows) in lettered:
            for row in rows:
                letters.append(_LETTERS[len(letters)])
                _leader(s, flow, s.joined(row.label), _text(s, row, "{}  {}"), size, 12, letters[-1])
        for group, own in _groups(rows) if (section, rows) not in lettered else []:
            if group:
                flow.keep(24)
                x0, x1, y = flow.room(10)
                s.put(x0, y - 7.8, group + ("：" if s.style.language in _CJK else ":"), size=size)
            for row in own:
                _leader(s, flow, row.label, _text(s, row, "{}  {}"), size, 7 if group else 0)
        flow.room(7)
    if flow.place < 3 and flow.bottom > 240:
        figure(s, 60, 44, 470, min(flow.bottom - 60, 240), letters)


def hitachi(s: Wording) -> None:
    """Two columns with leaders, cylinders in a table; under a drawing the lettered lengths, ranges for three arms."""
    top, ink = _title(s, "#3a3a3a"), "#d9480f"
    blocks = _blocks(s)
    lettered = [block for block in blocks if block[0] in ("working", "dimensions")]
    plain = [block for block in blocks if block not in lettered]
    flow = Flow(s, ((30, 290), (305, 565)), top, _bottom(plain, top, 2, 12.2, 26), 810)
    for section, rows in plain:
        flow.keep(60)
        x0, x1, y = flow.room(18)
        s.put(x0, y - 11, s.section(section).upper(), size=9, bold=True, ink=ink)
        s.line(x0, y - 14, x1, weight=0.8)
        if section == "cylinders":
            _matrix(s, flow, rows)
        for row in rows if section != "cylinders" else []:
            _leader(s, flow, s.joined(row.label), _text(s, row, at=True), 7.4)
        flow.room(8)
    y = flow.bottom - 8 if flow.place < 2 else 0.0
    for section, rows in lettered:
        y = y if y - 222 - 13 * len(rows) > 36 else s.page()
        y = _ranged(s, section, rows, y) - 26


def _matrix(s: Wording, flow: Flow, rows: list[Row]) -> None:
    """The cylinders: quantity, bore, rod diameter and stroke in columns; a dash for what is not said."""
    parts = ("Bore", "Rod Diameter", "Stroke")
    heads = ["", phrase(s, "quantity"), *(s.part(part) for part in parts)]
    said = {row.name: row.said.metric for row in rows}
    table = [heads]
    for one in lines(s.file)[s.machine.kind]:
        names = [f"{one.name[1:]} Cylinder {part}" for part in parts]
        if one.name.startswith("@") and set(names) & set(said):
            table.append([s.of(one), one.place, *(said.get(name, "–") for name in names)])
    for index, cells in enumerate(table):
        x0, x1, y = flow.room(12.4)
        s.put(x0, y - 8.8, cells[0], size=7.4)
        for column, cell in enumerate(cells[1:]):
            s.put(x0 + 116 + 41 * column, y - 8.8, cell, size=7.2 if index else 6.2, align="c")
        s.line(x0, y - 12, x1, weight=0.2 if index else 0.6)


def _ranged(s: Wording, section: str, rows: list[Row], top: float) -> float:
    """The drawing of a section, and its letters with their lengths; the edge below."""
    heads, long, kind = [""], s.machine.values.get("Arm Length", 0.0) / 1000, s.machine.kind
    if section == "working":
        heads = [phrase(s, "arm").format(s.digits(x, 2)) for x in (long - 0.5, long, long + 0.6)]
        s.config = heads[1]
        near = s.truth if "Arm Length" in s.truth else s.allowed
        near["Arm Length"] = Truth(long, 0.006)
    lengths = [row for row in rows if row.said.unit in ("mm", "m")]
    marks = [*_LETTERS[: len(lengths)], *[""] * len(rows)]
    s.put(30, top - 8, s.section(section).upper(), size=11, bold=True, ink="#d9480f")
    figure(s, 60, top - 200, 470, 186, marks[: len(lengths)])
    unit = max(("mm", "m"), key=[row.said.unit for row in rows].count)
    s.put(565, top - 206, phrase(s, "unit").format(unit), size=6.6, align="r")
    xs = [559 - 92 * (len(heads) - 1 - i) for i in range(len(heads))]
    y = top - 210
    if len(heads) > 1:
        s.fill(30, y - 13, 535, 13, "#e4e4e4")
        for x, head in zip(xs, heads, strict=True):
            s.put(x, y - 9.4, head, size=7, bold=True, align="r")
        y -= 13
    for mark, row in zip(marks, [*lengths, *(row for row in rows if row not in lengths)], strict=False):
        s.put(36, y - 9, mark, size=7.4, bold=True)
        s.put(56, y - 9, s.joined(row.label), size=7.4)
        for x, factor in zip(xs, (0.952, 1.0, 1.061) if len(heads) > 1 else (1.0,), strict=True):
            shown = row
            if factor != 1:
                value = rounded(kind, row.name, s.machine.values[row.name] * factor)
                shown = replace(row, said=s.say(row.name, value, note=False))
            text = shown.said.number if shown.said.unit == unit else _text(s, shown)
            s.put(x, y - 9, text, size=7.4, align="r")
        s.line(30, y - 13, 565, weight=0.25)
        y -= 13
    return y


def toyota(s: Wording) -> None:
    """A table of three models: group, item, unit, values; what all have alike stands once across their columns."""
    top = _title(s, "#a5121f")
    names = [f"{s.machine.name[:-3]}{int(s.machine.name[-3:]) + 15 * i}" for i in (-1, 0, 1)]
    s.config = s.machine.name
    flow, page = Flow(s, ((30, 565),), top, 36, 806), -1
    for section, rows in _blocks(s):
        flow.keep(40)
        for group, own in [("", []), *_groups(rows)]:
            flow.keep(13.6 * max(len(own), 1))
            begun = flow.y
            for row in (*own,) or (None,):
                x0, x1, y = flow.room(13.6)
                if flow.place != page:
                    page, begun = flow.place, y - 14
                    s.fill(x0, y - 14, x1 - x0, 14, "#4a4a4a")
                    s.put(36, y - 10, phrase(s, "model"), size=7.4, bold=True, ink="#ffffff")
                    for left, name in zip(_THREE, names, strict=False):
                        s.put(left + 34.5, y - 10, name, size=7.4, bold=True, align="c", ink="#ffffff")
                    y = flow.room(14)[2] - 0.4
                if row is None:
                    s.fill(x0, y - 13.6, x1 - x0, 13.6, "#e9d9da")
                    s.put(36, y - 9.8, s.section(section), size=7.6, bold=True)
                else:
                    _spanned(s, row, y, bool(group))
                    s.line(150 if group and row is not own[-1] else x0, y - 13.6, x1, weight=0.25)
            if group:
                _box(s, 32, flow.y + 0.5, 117, begun - flow.y - 1, group, 7, "#ffffff")
                s.line(150, begun, 150, y1=flow.y, weight=0.25)


def _spanned(s: Wording, row: Row, y: float, nested: bool) -> None:
    """An item's cells for each model, or one across all."""
    said = row.said
    both = said.imperial != "" and said.unit == "mm"
    unit = f"mm ({'in' if said.imperial.endswith('in') else 'ft-in'})" if both else said.unit
    s.put(156 if nested else 36, y - 9.8, row.label, size=7)
    s.put(304, y - 9.8, unit, size=6.8)
    alike = row.name not in s.machine.values or said.unit in _SAME or (said.unit == "mm" and s.dice.random() < 0.2)
    for index, step in enumerate((0,) if alike else (-1, 0, 1)):
        value = rounded(s.machine.kind, row.name, s.machine.values[row.name] * (1 + 0.08 * step)) if step else 0.0
        one = _local(s, replace(row, said=s.say(row.name, value, note=False))).said if step else said
        second = one.imperial.removesuffix(" in") if both else one.imperial
        x = (_THREE[0] + _THREE[3]) / 2 if alike else _THREE[index] + 34.5
        s.put(x, y - 9.8, f"{one.number} ({second})" if second else one.number, size=7, align="c")
        s.line(_THREE[index], y, _THREE[index], y1=y - 13.6, weight=0.25)


def hyundai(s: Wording) -> None:
    """Two columns of ruled cells, groups in a cell over their rows; lengths' units in the bar; words on the engine."""
    top, size, ink = _title(s, "#002c5f"), 7.3, "#002c5f"
    blocks = _blocks(s, "{}-ø{} X {}")
    flow = Flow(s, ((30, 291), (304, 565)), top, _bottom(blocks, top, 2, 14.6, 28), 810)
    for section, rows in blocks:
        lengths = [row.said.unit for row in rows]
        unit = max(("mm", "m"), key=lengths.count)
        unit = unit if lengths.count(unit) > max(3, len(rows) // 2) and section in ("working", "dimensions") else ""
        flow.keep(64)
        x0, x1, y = flow.room(15)
        s.fill(x0, y - 14, x1 - x0, 14, ink)
        s.put(x0 + 5, y - 10, s.section(section).upper(), size=8, bold=True, ink="#ffffff")
        shown = phrase(s, "unit").format(f"{unit} (ft·in)" if s.style.imperial else unit) if unit else ""
        s.put(x1 - 5, y - 10, shown, size=6.8, align="r", ink="#ffffff")
        texts = s.wrapped(phrase(s, "drive"), x1 - x0 - 4, 6.8) if section == "engine" else []
        y = flow.room(8.6 * len(texts))[2]
        _set(s, x0 + 2, y - 7, texts, 6.8)
        for group, own in _groups(rows):
            flow.keep(18 * len(own))
            x0, x1, begun = flow.room(0)
            for row in own:
                left, value = x0 + (76 if group else 0), _text(s, row, at=True)
                value = value.replace(f" {unit}", "", 1) if unit and row.said.unit == unit else value
                split = x1 - max(100.0, s.width(value, size) + 8)
                high = 8.9 * len(s.wrapped(row.label, split - left - 8, size)) + 5
                high = max(high, (8.9 * len(s.wrapped(group, 67, size)) + 5) / len(own))
                x0, x1, y = flow.room(high)
                _box(s, left, y - high, split - left, high, row.label, size, "#e8edf3")
                s.put((split + x1) / 2, y - high / 2 - 2.4, value, size=size, align="c")
                s.line(left, y - high, x1, weight=0.3)
            if group:
                _box(s, x0, flow.y, 75, begun - flow.y, group, size, "#d5dde8")
            s.line(x0, flow.y, x1, weight=0.3)
        flow.room(8)


def xcmg(s: Wording) -> None:
    """A grid two up: item, unit, value, the sections in rows of their own; each value on its line."""
    top, size = _title(s, "#0b5fa5"), 7.2
    blocks = _blocks(s)
    flow, page = Flow(s, ((30, 294), (301, 565)), top - 14, _bottom(blocks, top - 14, 2, 16, 16), 796), -1
    for section, rows in blocks:
        flow.keep(30)
        for row in [None, *rows]:
            texts = s.wrapped(s.joined(row.label), 134, size) if row else [""]
            high = 8.8 * len(texts) + 6.6
            x0, x1, y = flow.room(high)
            if flow.place != page:
                page = flow.place
                s.fill(x0, y, x1 - x0, 13, "#0b5fa5")
                for x, head in zip((x0 + 70, x0 + 162, x0 + 223), ("item", "units", "value"), strict=True):
                    s.put(x, y + 3.6, phrase(s, head), size=7.2, bold=True, align="c", ink="#ffffff")
            if row is None:
                s.fill(x0, y - high, x1 - x0, high, "#dce9f5")
                s.put((x0 + x1) / 2, y - 10.6, s.section(section), size=7.6, bold=True, align="c")
            else:
                _set(s, x0 + 4, y - 10, texts, size)
                said, middle = row.said, y - high / 2 - 2.4
                s.put(x0 + 162, middle, said.unit or "—", size=size, align="c")
                shown = f"{said.number} ({said.imperial})" if said.imperial else said.number
                s.put(x0 + 223, middle, shown, size=size, align="c")
                s.line(x0 + 142, y, x0 + 142, y1=y - high, weight=0.3)
                s.line(x0 + 182, y, x0 + 182, y1=y - high, weight=0.3)
            s.canvas.setLineWidth(0.3)
            s.canvas.rect(x0, y - high, x1 - x0, high)


def ritchie(s: Wording) -> None:
    """A data base's page as a browser prints it: heads and foots of the print, a line a value, a column a system."""
    blocks = sorted(_blocks(s), key=lambda block: block[0] not in ("working", "dimensions"))
    flow, page = Flow(s, ((48, 547),), 766, 46, 800), -1
    name = f"{s.machine.name} {phrase(s, 'specs')}"
    s.put(48, 780, name, size=15)
    for section, rows in blocks:
        flow.keep(48)
        x0, x1, y = flow.room(22)
        s.put(x0, y - 15, s.section(section), size=10.5, bold=True, ink="#333333")
        s.line(x0, y - 19, x1, weight=0.5)
        marks = iter(_LETTERS if section in ("working", "dimensions") else "")
        for row in rows:
            x0, x1, y = flow.room(13.5)
            if flow.place != page:
                page = flow.place
                s.put(48, 822, "11/4/26, 9:41 AM", size=6.6, ink="#555555")
                s.put(300, 822, name, size=6.6, align="c", ink="#555555")
                s.put(48, 24, "https://www.example.org/model/specs?print=1", size=6.6, ink="#555555")
                s.put(547, 24, f"{page + 1}/2", size=6.6, align="r", ink="#555555")
                s.put(48, 36, phrase(s, "note"), size=5.8, ink="#777777")
            mark = next(marks, "") if row.said.unit in ("mm", "m") else ""
            s.put(x0 + 6, y - 9.6, f"{mark}. {s.joined(row.label)}" if mark else s.joined(row.label), size=8)
            s.put(344, y - 9.6, row.said.imperial or row.said.metric, size=8)
            s.put(446, y - 9.6, row.said.metric if row.said.imperial else "", size=8)
            s.line(x0, y - 13.2, x1, weight=0.15)


def beml(s: Wording) -> None:
    """Key figures on a band, bullets, then framed sections in two columns with the colons in a column."""
    top, size = _title(s, "#f2b200"), 7.6
    blocks = _blocks(s, "{} – {} × {}")
    every = {row.name: row for _, rows in blocks for row in rows}
    for index, row in enumerate([every[name] for name in _KEYS if name in every][:3]):
        x = 30 + 181 * index
        s.fill(x, top - 40, 173, 38, "#fff3cf")
        s.put(x + 86, top - 15, s.joined(row.label), size=6.6, align="c")
        s.put(x + 86, top - 32, row.said.metric, size=13, bold=True, align="c")
    y = top - 54
    for row in [every[name] for name in _POINTS if name in every][:3]:
        s.put(34, y, "•  " + phrase(s, "point").format(s.joined(row.label), row.said.metric), size=8.4)
        y -= 12.6
    flow = Flow(s, ((30, 292), (303, 565)), y, _bottom(blocks, y, 2, 13.4, 30), 806)
    for section, rows in blocks:
        flow.keep(52)
        x0, x1, y = flow.room(18)
        s.fill(x0, y - 13, 120, 13, "#f2b200")
        s.put(x0 + 6, y - 9.6, s.section(section), size=8.4, bold=True)
        s.line(x0, y - 13.4, x1, weight=0.8)
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 132, size)
            values = s.wrapped(_text(s, row, at=True), x1 - x0 - 150, size)
            x0, x1, y = flow.room((size + 1.6) * max(len(texts), len(values)) + 3)
            _set(s, x0 + 4, y - 9, texts, size)
            s.put(x0 + 140, y - 9, ":", size=size)
            _set(s, x0 + 148, y - 9, values, size)
        flow.room(9)


_DE = Style("de", 0, group=" ", point=",", pressure="bar")
_FR = Style("fr", 0, group="\u00a0", point=",", pressure="bar")
_ES = Style("es", 0, group=".", point=",", pressure="bar")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, imperial=True, feet="{}'{}\""),
    "en_kr": Style("en", 0, imperial=True, feet="{}' {}\""),
    "en_in": Style("en", 0, pressure="bar"),
    "en_eu": Style("en", 0, group=" "),
    "en_m": Style("en", 0, metres=True),
    "en_cn": Style("en", 0, group=""),
    "en_db": Style("en", 1, imperial=True, group="", pressure="kPa", feet="{}.{} ft in"),
    "de": _DE,
    "de_m": replace(_DE, metres=True, group=".", tonnes=True),
    "fr": _FR,
    "es": _ES,
    "es_la": Style("es", 0, imperial=True, feet="{}'{}\""),
    "zh": Style("zh", 0, group=""),
    "ja": Style("ja", 0),
    "ja_k": Style("ja", 1),
    "ja_m": Style("ja", 0, metres=True),
}
FRESH8 = Worded(
    "fresh8",
    "VK",
    {f.__name__: f for f in (komatsu, hitachi, toyota, hyundai, xcmg, ritchie, beml)},
    STYLES,
    {
        "wheel_loader": "komatsu:en_us hyundai:en_kr hitachi:de ritchie:en_db hitachi:fr beml:es xcmg:zh komatsu:ja_k "
        "xcmg:en_cn hyundai:de_m hyundai:es_la komatsu:fr",
        "excavator": "hitachi:en_eu ritchie:en_db komatsu:de hyundai:fr hyundai:es_la komatsu:es xcmg:zh hitachi:ja "
        "hyundai:ja_k beml:en_in xcmg:en_cn komatsu:fr",
        "articulated_dump_truck": "komatsu:en_us ritchie:en_db hitachi:de komatsu:de_m",
        "rigid_dump_truck": "beml:en_in ritchie:en_db xcmg:zh hyundai:zh",
        "dozer": "beml:en_in komatsu:en_us komatsu:ja_k hitachi:ja",
        "grader": "komatsu:en_us ritchie:en_db beml:es xcmg:es_la",
        "backhoe_loader": "beml:en_in hyundai:en_kr hitachi:fr beml:fr",
        "forklift": "toyota:en_us toyota:en_eu toyota:zh xcmg:zh",
        "mobile_crane": "hyundai:en_m toyota:ja xcmg:en_cn komatsu:ja_m",
        "skid_steer": "ritchie:en_db toyota:en_us toyota:de hyundai:de_m",
    },
)
