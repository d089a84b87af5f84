"""What the sheets of the set "fresh9" print: rows in each country's units, gross power, other columns."""

from __future__ import annotations

import re
from dataclasses import replace

from kit.sheets.machines import BY_VARIANT, rounded
from kit.sheets.typeset import _CJK
from kit.sheets.worded import Row, Said, Truth, Wording, lines

_HORSES = {"de": "PS", "fr": "ch", "es": "CV", "ja": "PS", "zh": "PS", "en": "hp"}
_UNITS = {
    "de": {"L/min": "l/min", "rpm": "min-1", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "fr": {"L/min": "l/min", "rpm": "tr/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "es": {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "en": {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "zh": {"rpm": "r/min"}, "ja": {"rpm": "min-1"},
}  # fmt: skip
_AMERICAN = {"gal/min": "gpm", "lbf·ft": "lb-ft", "in": "in."}
_SECOND = {"L": (0.264172, 1, "gal"), "N·m": (0.737562, 0, "lb-ft"), "kg": (2.20462, 0, "lb"),
           "bar": (14.5038, 0, "psi"), "kPa": (0.145038, 0, "psi"), "MPa": (145.038, 0, "psi"),
           "L/min": (0.264172, 1, "gpm"), "km/h": (0.621371, 1, "mph"), "mm": (0.0393701, 2, "in."),
           "m/min": (3.28084, 0, "ft/min")}  # fmt: skip
_AT = {"en": "@ {} rpm", "de": "bei {} min-1", "fr": "à {} tr/min", "es": "a {} rpm", "ja": "/ {} min-1",
       "zh": "/ {} r/min"}  # fmt: skip
_KGF = {"kN": (101.97, -1, "kgf"), "MPa": (10.197, 0, "kgf/cm²"), "kPa": (0.010197, 2, "kgf/cm²")}
_SIZED = {"mm", "m", "kg", "t", "kW", "kN", "m³"}
_FIXED = {"Load Center", "Hoist Rope Diameter", "Fork Length", "Grouser Height"}
GREY = "#6a6a6a"


def word(s: Wording, key: str) -> str:
    """A text of this set that is no label; "" where this language has none."""
    text = next(s.of(one) for one in lines(s.file)["texts"] if one.name == key)
    return "" if text == "-" else text


def begin(s: Wording) -> None:
    """Leaves out what this language's, or this maker's, pages do not print."""
    own = (one for one in lines(s.file)[s.machine.kind] if not one.name.startswith("@"))
    s.left_out = s.left_out | {one.name for one in own if s.of(one) == "-"}


def local(s: Wording, said: Said, name: str) -> Said:
    """A value with its units as the country writes them, and a second unit where its pages print one."""
    style, number = s.style, said.number
    if said.unit == "V" and not number.isdigit():  # a stage of emissions
        return Said("Tier 4 Final" if style.imperial else "国四" if style.language == "zh" else said.metric, "")
    units = {} if style.imperial else _UNITS[style.language]
    value, _, unit = said.imperial.rpartition(" ")
    second = f"{value} {_AMERICAN.get(unit, unit)}" if value and " ft " not in said.imperial else said.imperial
    plain = number.replace(style.group, "").replace(style.point, ".") if re.fullmatch(r"[\d.,\s]+", number) else ""
    if said.unit == "kW" and plain and not style.imperial:
        factor = 1.34102 if style.language == "en" else 1.35962
        second = f"{s.digits(float(plain) * factor, 0)} {_HORSES[style.language]}"
    elif style.language == "ja" and plain and name and said.unit in _KGF:
        factor, decimals, unit = _KGF[said.unit]
        second = f"{s.digits(round(float(plain) * factor, decimals), max(decimals, 0))} {unit}"
    elif not name and style.imperial and plain and said.unit in _SECOND:
        factor, decimals, unit = _SECOND[said.unit]
        if said.unit == "L" and float(plain) < 12 and not float(plain).is_integer():  # an engine's displacement
            factor, decimals, unit = 61.0237, 0, "in³"
        second = f"{s.digits(float(plain) * factor, decimals)} {unit}"
    return Said(number, units.get(said.unit, said.unit), second)


def rows_of(s: Wording, section: str, *, rams: str = "rows", skip: frozenset[str] = frozenset()) -> list[Row]:
    """The rows of a section as the country writes them, with what is derived from wanted values among them."""
    kind = s.machine.kind
    rows = [row for row in s.rows(section, cylinders=rams, skip=skip) if row.label != "-"]
    if section == "drive" and not s.prints("Maximum Travel Speed"):  # else the highest gear said would be the top speed
        rows = [row for row in rows if row.name or row.said.unit != "km/h"]
    if section != "cylinders":  # in the order of the words; a gear's speed before the top speed
        order = [
            s.of(one) for part in (kind, "distractors") for one in lines(s.file)[part] if s.style.language in one.words
        ]
        rows.sort(key=lambda row: (section == "drive" and bool(row.name), order.index(row.label)))
    for one in lines(s.file)["derived"]:
        of, base, factor = one.place.split(", ")
        if one.name != section or of != kind or not s.prints(base) or s.of(one) == "-":
            continue
        value = rounded(kind, base, s.machine.values[base] * float(factor))
        s.note_level_cut(s.of(one), value / 1e3)
        after = next((i + 1 for i, row in enumerate(rows) if row.name == base), len(rows))
        rows.insert(after, Row(s.of(one), s.say(base, value, note=False), f"*{one.place}"))
    if section == "engine":
        rows = _engine(s, rows)
    return [replace(row, said=local(s, row.said, row.name)) for row in rows]


def _engine(s: Wording, rows: list[Row]) -> list[Row]:
    """An engine's rows: its gross power beside or instead of the net one; plain power where neither is said."""
    if s.machine.kind in ("forklift", "mobile_crane"):
        if "Net Power" in s.truth:
            power = s.truth["Engine Power"] = s.truth.pop("Net Power")
            s.printed["Engine Power"] = s.printed.pop("Net Power")
            s.allowed.pop("Engine Power", None)
            s.allowed |= {"Net Power": power, "Gross Power": power}  # of which kind it is, a standard may say
        return [replace(row, name="Engine Power") if row.name == "Net Power" else row for row in rows]
    net = s.prints("Net Power")
    if (net and s.dice.random() < 0.6) or s.style.wording == 2:
        return rows
    value = float(round(s.machine.values["Net Power"] * 1.06 + 1))
    said = s.say("Net Power", value, note=False)
    s.truth["Gross Power"], s.printed["Gross Power"] = Truth(value * 1e3, value * 1e-3), said.number
    if not net:
        s.allowed["Engine Power"] = s.truth["Gross Power"]
    return [Row(word(s, "gross"), said, "Gross Power"), *rows]


def places(s: Wording) -> list[str]:
    """The sections, each once."""
    return list(dict.fromkeys(s.sections()))


def blocks_of(s: Wording, *, rams: str = "rows", skip: frozenset[str] = frozenset()) -> list[tuple[str, list[Row]]]:
    """The sections that have rows."""
    found = [(one, rows_of(s, one, rams=rams, skip=skip)) for one in places(s)]
    return [(one, rows) for one, rows in found if rows]


def text_of(s: Wording, row: Row, *, at: bool = False) -> str:
    """A value with its second unit in brackets; power at its speed."""
    text = row.said.both
    if at and row.said.unit == "kW" and row.name:
        text += f" {_AT[s.style.language].format(s.digits(2000, 0))}"
    return text


def columns(s: Wording) -> tuple[list[str], int]:
    """The heads of two columns and the place of the machine's own: arms, buckets, or models; notes which is asked."""
    own = s.dice.randrange(2)
    if s.machine.kind == "excavator":
        long = s.machine.values["Arm Length"] / 1000
        lengths = (long - 0.4, long) if own else (long, long + 0.4)
        heads = [word(s, "arm").format(f"{s.digits(x, 2)} m") for x in lengths]
    elif s.machine.kind == "wheel_loader":
        heads = word(s, "buckets").split(" / ")
    else:
        stem, number = s.machine.name.split()
        heads = [f"{stem} {int(number) + 20 * (i - own)}" for i in range(2)]
    s.config = heads[own]
    return heads, own


def other(s: Wording, row: Row, own: int) -> Said | None:
    """What a row says in the column that is not the machine's; None where both columns share it."""
    kind, name, factor = s.machine.kind, row.name, 1.0
    if name.startswith("*"):
        _, name, part = name.split(", ")
        factor = float(part)
    if name == "Gross Power" and kind not in BY_VARIANT:
        return local(s, s.say("Net Power", round(s.truth[name].value / 1e3 * (1.08 - 0.16 * own)), note=False), name)
    if name not in s.machine.values or " Cylinder " in name:
        return None
    value = s.machine.values[name]
    if kind == "excavator" and name == "Arm Length":
        value += 400 * (1 - 2 * own)
    elif kind in BY_VARIANT and name in BY_VARIANT[kind]:
        value = rounded(kind, name, value * (1 + 0.05 * (1 - 2 * own)))
    elif kind not in BY_VARIANT and name not in _FIXED and s.say(name, note=False).unit in _SIZED:
        value = rounded(kind, name, value * (1 + 0.08 * (1 - 2 * own)))
    if value == s.machine.values[name]:
        return None
    return local(s, s.say(name, rounded(kind, name, value * factor), note=False), name)


def foreign(s: Wording, row: Row) -> str:
    """The imperial text alone where there is one; the truth is then as coarse as that print."""
    text = row.said.imperial
    if not text:
        return row.said.metric
    if row.name in s.truth:
        truth = s.truth[row.name]
        digits = re.match(r"[\d,]+(?:\.(\d+))?", text)
        assert digits
        last = 0.5 * 10.0 ** -len(digits[1] or "")
        step = 0.0127 if "'" in text else last / float(digits[0].replace(",", "")) * truth.value
        s.truth[row.name] = Truth(truth.value, 1.02 * step + 1e-4 * truth.value)
        s.printed[row.name] = re.split(r" (?=[a-z])", text)[0]
        if row.name == "Net Power":
            s.allowed["Engine Power"] = s.truth[row.name]
    return text


def level_of(blocks: list[tuple[str, list[Row]]], top: float, count: int, row: float, head: float) -> float:
    """The lower edge at which the columns of a page are about equally full, were each row so high."""
    high = sum(head + row * len(rows) for _, rows in blocks)
    return max(46.0, top - 1.02 * high / count - 3 * row)


def foot(s: Wording, x: float, width: float, y: float = 26, size: float = 5.6) -> None:
    """The small print at the foot."""
    for index, text in enumerate(s.wrapped(word(s, "note"), width, size)):
        s.put(x, y - 6.6 * index, text, size=size, ink=GREY)


def upright(s: Wording, text: str, x: float, top: float, bottom: float) -> None:
    """A text in a cell 18 wide: characters one below the other (CJK), or turned to read upwards; small if short."""
    middle, high = (top + bottom) / 2, top - bottom - 2
    if s.style.language in _CJK:
        size, wide = (6.6, 1) if 7.6 * len(text) <= high else (5.2, 2 if len(text) < 5 else 3)
        pieces = [text[i : i + wide] for i in range(0, len(text), wide)]
        y = middle + len(pieces) * (size + 0.8) / 2 - size
        for index, piece in enumerate(pieces):
            s.put(x, y - (size + 0.8) * index, piece, size=size, align="c")
        return
    size = next((z for z in (6.6, 6.0, 5.4, 4.8) if s.width(text, z, True) <= high), 4.8)
    if s.width(text, size, True) > high:
        s.put(x, middle - 1.6, text if s.width(text, size, True) < 19 else f"{text[:4]}.", size=4.8, align="c")
        return
    s.canvas.saveState()
    s.canvas.translate(x + size * 0.35, middle)
    s.canvas.rotate(90)
    s.put(0, 0, text, size=size, bold=True, align="c")
    s.canvas.restoreState()
