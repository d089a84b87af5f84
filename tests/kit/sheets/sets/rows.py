"""What several sets draw their rows with: units as a country writes them, values in both systems, rows that go with
wanted ones, models beside each other, and the figure of a machine with its letters."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from kit.sheets.machines import rounded
from kit.sheets.worded import Row, Said, Truth, Wording, lines

_METRIC_POWER = {"de": "PS", "fr": "ch", "es": "CV"}
_UNITS = {
    "de": {"L/min": "l/min", "rpm": "min-1", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "fr": {"L/min": "l/min", "rpm": "tr/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "es": {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "zh": {"rpm": "r/min"},
    "ja": {"rpm": "min-1", "L/min": "L/min"},
}
_EUROPEAN = {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm", "rpm": "rpm"}
_AMERICAN = {"gal/min": "gpm", "lbf·ft": "lb-ft", "yd³": "yd3", "ft/min": "fpm"}
_ASIDE = {"L": (0.264172, 1, "gal"), "N·m": (0.737562, 0, "lb-ft"), "km/h": (0.621371, 1, "mph"),
          "kg": (2.20462, 0, "lb"), "MPa": (145.038, 0, "psi"), "bar": (14.5038, 0, "psi"),
          "kPa": (0.145038, 0, "psi")}  # fmt: skip
"""What a value that is not asked for is in the other system: factor, decimals, unit."""
_GROWS = {"mm", "m", "kg", "t", "kW", "kN", "m³", "L/min", "l/min"}
_FIXED = ("Load Center", "Radius at Maximum Capacity")


def phrase(s: Wording, key: str) -> str:
    """A text of this set that is no label."""
    return next(s.of(one) for one in lines(s.file)["texts"] if one.name == key)


def _local(s: Wording, row: Row) -> Row:
    """A row with its units as the country writes them, and a second unit where it prints one."""
    style, said = s.style, row.said
    units = _UNITS.get(style.language, {} if style.imperial else _EUROPEAN)
    number, _, unit = said.imperial.rpartition(" ")
    second = f"{number} {_AMERICAN.get(unit, unit)}".strip()
    plain = said.number.replace(style.group, "").replace(style.point, ".")
    if style.imperial and not second and not row.name and said.unit in _ASIDE and re.fullmatch(r"[\d.]+", plain):
        factor, decimals, unit = _ASIDE[said.unit]
        second = f"{s.digits(float(plain) * factor, decimals)} {unit}"
    elif said.unit == "kW" and style.language in _METRIC_POWER:
        second = f"{s.digits(float(plain) * 1.35962, 0)} {_METRIC_POWER[style.language]}"
    return replace(row, said=Said(said.number, units.get(said.unit, said.unit), second))


def _derived(s: Wording, section: str) -> list[Row]:
    """Values that go with wanted ones and are not asked for."""
    found = []
    for one in lines(s.file)["derived"]:
        kind, base, factor = one.place.split(", ")
        if one.name == section and kind == s.machine.kind and s.prints(base):
            value = rounded(kind, base, s.machine.values[base] * float(factor))
            found.append(Row(s.of(one), s.say(base, value, note=False), f"*{base}"))
            s.note_level_cut(found[-1].label, value / 1e3)
    return found


def _rows(s: Wording, section: str, *, pairs: bool = False, rams: str = "rows") -> list[Row]:
    """The rows of a section; an engine's begin with its model and gross power. `pairs`: two values in one cell."""
    rows = s.rows(section, cylinders=rams)
    for row in _derived(s, section):
        group = row.label.partition(" > ")[0]
        same = [i for i, one in enumerate(rows) if one.label.partition(" > ")[0] == group]
        rows.insert(same[-1] + 1 if same and " > " in row.label else s.dice.randrange(len(rows) + 1), row)
    if section == "engine":
        power = float(round(s.machine.values["Net Power"] * 1.05))
        if s.machine.kind != "forklift" and s.dice.random() < 0.6:
            s.allowed |= dict.fromkeys(("Engine Power", "Gross Power"), Truth(power * 1e3, power * 1e-3))
            rows.insert(0, Row(phrase(s, "gross"), s.say("Net Power", power, note=False), "*Net Power"))
        rows.insert(0, Row(phrase(s, "maker"), Said(s.dice.choice(("QSB6.7", "D6E-T4F", "6HK1", "TCD 6.1 L6")), "")))
    rows = [_local(s, row) for row in rows]
    for one in lines(s.file)["pairs"] if pairs else ():
        names = one.name.split(" + ")
        own = sorted((row for row in rows if row.name in names), key=lambda row: names.index(row.name))
        if len(own) == 2 and one.place == s.machine.kind:
            rows[rows.index(own[0])] = Row(s.of(one), _both(s, own), one.name)
            rows.remove(own[1])
    return rows


def _both(s: Wording, own: Sequence[Row]) -> Said:
    """Two values in a cell, the unit once behind them."""
    mark = " – " if own[0].said.unit in ("m", "mm") else "/"
    seconds = [row.said.imperial for row in own]
    return Said(mark.join(row.said.number for row in own), own[0].said.unit, mark.join(seconds) if all(seconds) else "")


def blocks_of(s: Wording, *, pairs: bool = False, rams: str = "rows") -> list[tuple[str, list[Row]]]:
    """The sections that have rows."""
    found = [(one, _rows(s, one, pairs=pairs, rams=rams)) for one in s.sections()]
    return [(one, rows) for one, rows in found if rows]


def value_of(s: Wording, row: Row, form: str = "{} ({})") -> str:
    """A value with both its units; American sheets put theirs first."""
    said = row.said
    if not said.imperial:
        return said.metric
    own = s.style.imperial and s.style.wording == 0 and s.style.language == "en"
    return form.format(*((said.imperial, said.metric) if own else (said.metric, said.imperial)))


def colon(s: Wording) -> str:
    """A colon as the country sets it."""
    return {"fr": "\u00a0:", "zh": "：", "ja": "："}.get(s.style.language, ":")


def lower_edge(blocks: Sequence[tuple[str, list[Row]]], top: float, columns: int, row: float, head: float) -> float:
    """The lower edge at which a page's columns are about equally full."""
    high = sum(head + row * len(rows) for _, rows in blocks)
    return max(46.0, top - 1.04 * high / columns - 2 * row)


def write(
    s: Wording, x: float, y: float, texts: Sequence[str], size: float, step: float, *, bold: bool = False
) -> None:
    """Lines of text below each other."""
    for index, text in enumerate(texts):
        s.put(x, y - step * index, text, size=size, bold=bold)


def foot(s: Wording) -> None:
    """The maker's reservation."""
    s.put(40, 26, phrase(s, "note"), size=5.6, ink="#6b6f74")


def stepped(s: Wording, row: Row, step: int) -> str:
    """A cell's number for a model that is so many steps larger."""
    names = row.name.split(" + ")
    if len(names) == 2:
        return row.said.number
    name = row.name.removeprefix("*")
    grows = row.said.unit in _GROWS and " Cylinder " not in name and name not in _FIXED
    if not step or not grows or name not in s.machine.values:
        return row.said.number
    if row.name.startswith("*"):
        value = float(row.said.number.replace(s.style.group or " ", "").replace(s.style.point, "."))
        return s.digits(round(value * (1 + 0.06 * step)), 0)
    return s.say(name, rounded(s.machine.kind, name, s.machine.values[name] * (1 + 0.06 * step)), note=False).number


def figure(s: Wording, x: float, y: float, width: float, height: float, letters: list[str]) -> None:
    """A machine from its side, with dimension lines and their letters: lengths below it, heights beside it."""
    c, ground, long = s.canvas, y + 58, 0.5 * width
    c.setLineWidth(0.8)
    c.setStrokeColorRGB(0.25, 0.25, 0.25)
    s.line(x, ground, x + width, weight=0.6)
    if s.machine.kind in ("excavator", "dozer"):
        c.roundRect(x + 0.2 * long, ground, 0.55 * long, 30, 14)
        for i in range(5):
            c.circle(x + 0.27 * long + i * 0.1 * long, ground + 9, 5)
    else:
        for share in (0.28, 0.72):
            c.circle(x + share * long, ground + 20, 20)
            c.circle(x + share * long, ground + 20, 9)
    c.rect(x + 0.16 * long, ground + 34, 0.66 * long, 26)
    c.rect(x + 0.4 * long, ground + 60, 0.22 * long, 32)
    if s.machine.kind not in ("dozer", "grader"):
        s.line(x + 0.66 * long, ground + 58, x + 0.86 * long, y1=ground + height - 74, weight=3)
        s.line(x + 0.86 * long, ground + height - 74, x + 1.02 * long, y1=ground + 30, weight=2)
    half = (len(letters) + 1) // 2
    for i, letter in enumerate(letters[:half]):
        left, level = x + width * (i % 4) / 4 + 4, ground - 13 - 13 * (i // 4)
        right = left + width / 4 - 8
        s.line(left, level, right, weight=0.3)
        for end in (left, right):
            s.line(end, level - 3, end, y1=level + 3, weight=0.3)
        s.fill((left + right) / 2 - 8, level - 4, 16, 8, "#ffffff")
        s.put((left + right) / 2, level - 2.5, letter, size=7.5, bold=True, align="c")
    for i, letter in enumerate(letters[half:]):
        at, top = x + width - 8 - 16.5 * i, ground + (height - 70) * (0.35 + 0.13 * (i * 3 % 5))
        s.line(at, ground, at, y1=top, weight=0.3)
        s.line(at - 3, top, at + 3, weight=0.3)
        s.put(at, top + 3, letter, size=7.5, bold=True, align="c")
