"""What the sheets of the set "fresh7" print: rows with the country's units, second units, gross power, other models."""

from __future__ import annotations

import re
from dataclasses import replace

from kit.sheets.machines import rounded
from kit.sheets.worded import Row, Said, Truth, Wording, lines

LEVEL = "Maximum Digging Depth 2.44 m Level Bottom"
_HORSES = {"de": (1.35962, "PS"), "fr": (1.35962, "ch"), "es": (1.35962, "CV"), "ja": (1.35962, "PS"),
           "zh": (1.34102, "hp"), "en": (1.34102, "hp")}  # fmt: skip
_UNITS = {
    "de": {"L/min": "l/min", "rpm": "U/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "fr": {"L/min": "l/min", "rpm": "tr/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "es": {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "en": {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "zh": {}, "ja": {"rpm": "min-1"},
}  # fmt: skip
_AMERICAN = {"gal/min": "gpm", "lbf·ft": "lb-ft", "in": "in.", "lb": "lb."}
_SECOND = {"L": (0.264172, 1, "gal"), "N·m": (0.737562, 0, "lb-ft"), "kg": (2.20462, 0, "lb"),
           "m²": (10.7639, 1, "ft²"), "bar": (14.5038, 0, "psi"), "kPa": (0.145038, 0, "psi"),
           "MPa": (145.038, 0, "psi"), "L/min": (0.264172, 1, "gpm"), "km/h": (0.621371, 1, "mph"),
           "mm": (0.0393701, 2, "in"), "m/min": (3.28084, 0, "ft/min")}  # fmt: skip
FIXED = {"Boom Length", "Bucket Digging Force", "Load Center", "Bucket Weight", "Maximum Digging Height"}
_SIZED = {"mm", "m", "kg", "t", "kW", "kN", "m³", "L/min"}
GREY = "#6d6e71"


def word(s: Wording, key: str) -> str:
    """A text of this set that is no label."""
    return next(s.of(one) for one in lines(s.file)["texts"] if one.name == key)


def mark_of(s: Wording, part: str, name: str) -> tuple[str, str]:
    """The number and the sign by which a part of the words knows a value."""
    found = (one for one in lines(s.file)[part] if one.name == name.partition(" + ")[0])
    return next(((one.place, next(iter(one.words.values()))[0]) for one in found), ("", ""))


def begin(s: Wording) -> None:
    """Leaves out what this language's pages do not print."""
    own = (one for one in lines(s.file)[s.machine.kind] if not one.name.startswith("@"))
    s.left_out = s.left_out | {one.name for one in own if s.of(one) == "-"}


def local(s: Wording, said: Said, name: str) -> Said:
    """A value with its units as the country writes them, and a second unit where its pages print one."""
    style, language = s.style, s.style.language
    units = {} if style.imperial and language == "en" and style.pressure != "bar" else _UNITS[language]
    number = said.number
    if said.unit == "t":
        number = re.sub(r"[.,]?0+$", "", number) if style.point in number else number
    value, _, unit = said.imperial.rpartition(" ")
    second = f"{value} {_AMERICAN.get(unit, unit)}" if value else said.imperial
    plain = number.replace(style.group, "").replace(style.point, ".") if re.fullmatch(r"[\d.,\s]+", number) else ""
    if said.unit == "kW" and plain and not style.imperial:
        factor, unit = _HORSES[language]
        second = f"{s.digits(float(plain) * factor, 0)} {unit}"
    elif not name and style.imperial and plain and said.unit in _SECOND:
        factor, decimals, unit = _SECOND[said.unit]
        if said.unit == "L" and float(plain) < 10:  # an engine's displacement
            factor, decimals, unit = 61.0237, 0, "in³"
        second = f"{s.digits(float(plain) * factor, decimals)} {unit}"
    if name in s.printed:
        s.printed[name] = number
    return Said(number, units.get(said.unit, said.unit), second)


def rows_of(s: Wording, section: str, *, rams: str = "rows") -> list[Row]:
    """The rows of a section as the country writes them, with what is derived from wanted values among them."""
    kind = s.machine.kind
    rows = s.rows(section, cylinders=rams)
    for one in lines(s.file)["derived"]:
        of, base, factor = one.place.split(", ")
        if one.name != section or of != kind or not s.prints(base) or s.of(one) == "-":
            continue
        value = rounded(kind, base, s.machine.values[base] * float(factor))
        name = "*"
        if re.search(r"2[.,]44|8 ft", s.of(one)):
            name = LEVEL
            s.truth[LEVEL] = Truth(value / 1e3, value * 1e-9)
            s.allowed["Level Bottom Length"] = Truth(2.44, 0.006)
        said = s.say(base, value, note=False)
        if name == LEVEL:
            s.printed[LEVEL] = said.number
        rows.insert(s.dice.randrange(len(rows) + 1), Row(s.of(one), said, name))
    if section == "engine":
        rows = _engine(s, rows)
    return [replace(row, said=local(s, row.said, row.name)) for row in rows]


def _engine(s: Wording, rows: list[Row]) -> list[Row]:
    """An engine's rows: its gross power beside or instead of the net one; plain power where neither is said."""
    kind = s.machine.kind
    if kind in ("forklift", "mobile_crane"):
        if "Net Power" in s.truth:
            s.truth["Engine Power"], s.printed["Engine Power"] = s.truth.pop("Net Power"), s.printed.pop("Net Power")
            s.allowed.pop("Engine Power", None)
            if kind == "forklift":  # ISO 1585 is the net power
                s.allowed["Net Power"] = s.truth["Engine Power"]
        return [replace(row, name="Engine Power") if row.name == "Net Power" else row for row in rows]
    net = s.prints("Net Power")
    if net and s.dice.random() < 0.5:
        return rows
    power = float(round(s.machine.values["Net Power"] * 1.05 + 1))
    said = s.say("Net Power", power, note=False)
    s.truth["Gross Power"], s.printed["Gross Power"] = Truth(power * 1e3, power * 1e-3), said.number
    if not net:
        s.allowed["Engine Power"] = s.truth["Gross Power"]
    return [Row(word(s, "gross"), said, "Gross Power"), *rows]


def text_of(s: Wording, row: Row, *, at: bool = True) -> str:
    """A value with its second unit in brackets; power at its speed."""
    text = row.said.both
    if at and row.said.unit == "kW" and row.name:
        text += f" {word(s, 'at').format(s.digits(2100, 0))}"
    return text


def stepped(s: Wording, row: Row, step: int) -> str:
    """The number of a row for a machine that is so many sizes larger."""
    if not step or row.name not in s.machine.values or row.name in FIXED or " Cylinder " in row.name:
        return row.said.number
    said = s.say(row.name, note=False)
    if said.unit not in _SIZED:
        return row.said.number
    value = rounded(s.machine.kind, row.name, s.machine.values[row.name] * (1 + 0.08 * step))
    return local(s, s.say(row.name, value, note=False), "").number


def siblings(s: Wording, steps: tuple[int, ...]) -> list[str]:
    """The names of the models of a table."""
    stem, number = s.machine.name.split()
    return [f"{stem} {int(number) + 20 * step}" for step in steps]


def blocks_of(s: Wording, **options: str) -> list[tuple[str, list[Row]]]:
    """The sections that have rows."""
    found = [(one, rows_of(s, one, **options)) for one in s.sections()]
    return [(one, rows) for one, rows in found if rows]


def note(s: Wording, x: float, width: float, y: float = 24) -> None:
    """The small print at the foot."""
    for index, text in enumerate(s.wrapped(word(s, "note"), width, 5.4)):
        s.put(x, y - 6.4 * index, text, size=5.4, ink=GREY)


def level_of(blocks: list[tuple[str, list[Row]]], top: float, columns: int, row: float, head: float) -> float:
    """The lower edge at which the columns of a page are about equally full, were each row so high."""
    high = sum(head + row * len(rows) for _, rows in blocks)
    return max(46.0, top - 1.02 * high / columns - 3 * row)


def ranges(s: Wording, rows: list[Row]) -> list[Row]:
    """A crane's rows with the boom's two lengths, and the capacity and its radius, in one."""
    for first, second, key in (
        ("Boom Length Retracted", "Boom Length Extended", "range"),
        ("Maximum Lifting Capacity", "Radius at Maximum Capacity", "rated"),
    ):
        own = {row.name: row for row in rows}
        if first in own and second in own:
            a, b = own[first].said, own[second].said
            rows = [row for row in rows if row.name != second]
            if key == "range":
                row = Row(word(s, key), Said(f"{a.metric} – {b.metric}", "", f"{a.imperial} – {b.imperial}"), first)
                row = row if a.imperial else replace(row, said=replace(row.said, imperial=""))
            else:
                row = Row(own[first].label, Said(word(s, key).format(a.both, b.both), ""), first)
            rows[[one.name for one in rows].index(first)] = row
    return rows


def choices(s: Wording) -> tuple[list[str], int]:
    """The heads of the columns of an excavator's arms or a loader's buckets, and the place of the machine's own."""
    own = s.dice.randrange(2)
    if s.machine.kind == "excavator":
        long = s.machine.values["Arm Length"] / 1000
        lengths = [long - 0.5, long] if own else [long, long + 0.45]
        heads = [word(s, "arm").format(s.digits(x, 3)) for x in lengths]
    else:
        heads = word(s, "buckets").split(" / ")
    return heads, own
