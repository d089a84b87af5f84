"""The set "fresh11": machines of all ten types on seven kinds of pages of makers all over the world.

`racine`: three columns of items with dotted leaders, values broken where they do not fit; `rocester`: full-width tables
with the drawing's letters and "mm (ft-in)" in their heads; `incheon`: two striped columns of item, unit and value;
`changsha`: key figures on top, then two tables of item and value side by side; `linz`: two or three models in columns,
the unit behind each number; `osaka`: a ruled table, the section's name in a cell at the left of its rows; `richards`:
four columns of labels in bold type over their values.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from kit.sheets.sets.rows import blocks_of, foot, lower_edge, phrase, stepped, value_of, write
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Row, Worded, Wording

_GREY = "#6b6f74"
_LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
_KEYS = ("Operating Weight", "Rated Payload", "Rated Capacity", "Maximum Lifting Capacity", "Net Power",
         "Bucket Capacity Heaped", "Bucket Capacity", "Lift Height", "Boom Length Extended", "Blade Capacity",
         "Rated Operating Capacity", "Body Capacity Heaped", "Maximum Digging Depth", "Moldboard Length")  # fmt: skip
_DRAWN = ("dimensions", "loading", "working")


def _unit(row: Row) -> str:
    """A row's unit in a column of its own; with both systems, both."""
    second = row.said.imperial.rpartition(" ")[2] if row.said.imperial else ""
    if second and not second[0].isalpha():
        second = "ft-in"
    return f"{row.said.unit} ({second})" if second else row.said.unit


def _number(row: Row) -> str:
    """A row's number without its unit; with both systems, both; feet and inches with a dash."""
    second = row.said.imperial
    if not second:
        return row.said.number
    number, _, unit = second.rpartition(" ")
    if unit[0].isalpha():
        return f"{row.said.number} ({number})"
    feet = re.fullmatch(r"(\d+)' ?(\d+)\"", second)
    return f"{row.said.number} ({f'{feet[1]}-{feet[2]}' if feet else second})"


# ---- layouts ---------------------------------------------------------------------------------------------------------
def racine(s: Wording) -> None:
    """Three narrow columns: items with dotted leaders up to the value, which goes below where it does not fit."""
    s.fill(0, 796, 596, 46, "#c8102e")
    s.put(36, 811, s.machine.name, size=20, bold=True, ink="#ffffff")
    s.put(560, 813, phrase(s, "title"), size=10, align="r", ink="#ffffff")
    foot(s)
    blocks = blocks_of(s, rams="product" if s.style.imperial else "rows")
    columns = ((36, 203), (214, 381), (392, 559))
    flow = Flow(s, columns, 782, lower_edge(blocks, 782, 3, 12.4, 27), 800)
    for section, rows in blocks:
        flow.keep(48)
        x0, x1, y = flow.room(17)
        s.put(x0, y - 11, s.section(section).upper(), size=8.4, bold=True, ink="#c8102e")
        s.line(x0, y - 13.6, x1, weight=0.8)
        for row in rows:
            value = value_of(s, row)
            wide = s.width(value, 6.8)
            texts = s.wrapped(s.joined(row.label), x1 - x0 - 4, 6.8)
            below = s.width(texts[-1], 6.8) + wide + 10 > x1 - x0
            x0, x1, y = flow.room(8.2 * (len(texts) + below) + 2)
            write(s, x0, y - 8, texts, 6.8, 8.2)
            base = y - 8 - 8.2 * (len(texts) - 1 + below)
            s.put(x1, base, value, size=6.8, align="r")
            left = x0 + (8 if below else s.width(texts[-1], 6.8) + 2)
            dots = int((x1 - wide - 2 - left) / s.width(".", 6.8))
            s.put(x1 - wide - 2, base, "." * dots, size=6.8, align="r")
        if section == "weights":
            texts = s.wrapped(phrase(s, "with"), x1 - x0, 6)
            x0, x1, y = flow.room(7 * len(texts) + 3)
            write(s, x0, y - 7, texts, 6, 7)
        flow.room(7)


def rocester(s: Wording) -> None:
    """Tables over the whole width: the drawing's letter, the item, the unit, and the value in the model's column."""
    s.fill(36, 786, 523, 34, "#fcb026")
    s.put(46, 797, f"{phrase(s, 'title')}  |  {s.machine.name}", size=15, bold=True, ink="#000000")
    foot(s)
    flow = Flow(s, ((36, 559),), 776, 44, 806)
    letter = 0
    for section, rows in blocks_of(s, rams="rows"):
        flow.keep(16 + 12.6 * min(len(rows), 4))
        x0, x1, y = flow.room(15)
        s.fill(x0, y - 14, x1 - x0, 14, "#3b3b3b")
        s.put(x0 + 6, y - 10, s.section(section).upper(), size=7.8, bold=True, ink="#ffffff")
        s.put(x1 - 70, y - 10, s.machine.name, size=7.8, bold=True, align="c", ink="#ffffff")
        for row in rows:
            x0, x1, y = flow.room(12.6)
            left = x0 + 6
            if section in _DRAWN:
                s.put(x0 + 6, y - 9, _LETTERS[letter % 24], size=7.6, bold=True)
                letter += 1
                left = x0 + 24
            s.put(left, y - 9, s.joined(row.label), size=7.6)
            s.put(x1 - 210, y - 9, _unit(row), size=7.6)
            s.put(x1 - 70, y - 9, _number(row), size=7.6, align="c")
            s.line(x0, y - 12.6, x1, weight=0.25)
        flow.room(8)


def incheon(s: Wording) -> None:
    """Two columns of striped rows: item, unit and value, headings in colour."""
    s.put(36, 802, s.machine.name, size=22, bold=True, ink="#e8590c")
    s.put(559, 804, phrase(s, "title"), size=10, align="r", ink=_GREY)
    s.line(36, 792, 559, weight=1.6)
    foot(s)
    blocks = blocks_of(s, rams="product" if s.style.language == "en" else "rows")
    flow = Flow(s, ((36, 291), (304, 559)), 784, lower_edge(blocks, 784, 2, 13.5, 26), 800)
    for section, rows in blocks:
        flow.keep(20 + 13 * min(len(rows), 4))
        x0, x1, y = flow.room(17)
        s.put(x0, y - 12, s.section(section), size=9.6, bold=True, ink="#e8590c")
        s.line(x0, y - 16, x1, weight=0.9)
        for index, row in enumerate(rows):
            texts = s.wrapped(s.joined(row.label), 118, 7.2)
            high = 8.6 * len(texts) + 4
            x0, x1, y = flow.room(high)
            if index % 2:
                s.fill(x0, y - high, x1 - x0, high, "#eeeeee")
            write(s, x0 + 3, y - 8.8, texts, 7.2, 8.6)
            middle = y - high / 2 - 2.5
            s.put(x0 + 148, middle, _unit(row), size=7.2, align="c")
            s.put(x1 - 4, middle, _number(row), size=7.2, align="r")
        flow.room(7)


def changsha(s: Wording) -> None:
    """Key figures in boxes, below them two ruled tables of item and value side by side."""
    s.put(40, 796, s.machine.name, size=24, bold=True, ink="#b11116")
    s.put(40, 780, phrase(s, "title"), size=10, ink=_GREY)
    foot(s)
    blocks = blocks_of(s, rams="rows")
    own = {row.name: row for _, rows in blocks for row in rows}
    keys = [own[name] for name in _KEYS if name in own][:3]
    for index, row in enumerate(keys):
        x = 40 + 175 * index
        s.fill(x, 722, 165, 46, "#f4f4f4")
        s.put(x + 10, 745, value_of(s, row), size=13, bold=True, ink="#b11116")
        s.put(x + 10, 730, s.joined(row.label), size=7.4)
    flow = Flow(s, ((40, 292), (303, 555)), 708, lower_edge(blocks, 708, 2, 14.8, 24), 800)
    for section, rows in blocks:
        flow.keep(18 + 15 * min(len(rows), 4))
        x0, x1, y = flow.room(16)
        s.fill(x0, y - 16, x1 - x0, 16, "#b11116")
        s.put((x0 + x1) / 2, y - 11.4, s.section(section), size=8.6, bold=True, align="c", ink="#ffffff")
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 138, 7.4)
            high = 9 * len(texts) + 5
            x0, x1, y = flow.room(high)
            write(s, x0 + 5, y - 9.8, texts, 7.4, 9)
            s.put(x0 + 199, y - high / 2 - 2.6, value_of(s, row), size=7.4, align="c")
            s.line(x0, y - high, x1, weight=0.3)
            for edge in (x0, x0 + 146, x1):
                s.line(edge, y, edge, y1=y - high, weight=0.3)
        flow.room(8)


def linz(s: Wording) -> None:
    """Two or three models in columns, the unit behind each number; thin rules, headings in the maker's colour."""
    steps = (0, 1) if s.machine.kind in ("excavator", "wheel_loader") else (-1, 0, 1)
    names = [f"{s.machine.name[:-3]}{int(s.machine.name[-3:]) + 15 * step}" for step in steps]
    s.config = s.machine.name
    s.put(40, 798, phrase(s, "title"), size=17, bold=True, ink="#00695c")
    foot(s)
    flow = Flow(s, ((40, 555),), 786, 44, 806)
    first = 285.0
    wide = (555 - first) / len(steps)
    place = -1
    for section, rows in blocks_of(s):
        for row in [None, *rows]:
            flow.keep(42 if row is None else 14)
            if flow.place != place:
                place = flow.place
                x0, x1, y = flow.room(17)
                for index, name in enumerate(names):
                    s.put(first + wide * index, y - 11, name, size=9, bold=True)
                s.line(x0, y - 16, x1, weight=1.2)
            x0, x1, y = flow.room(18 if row is None else 12.8)
            if row is None:
                s.put(x0, y - 14, s.section(section), size=8.6, bold=True, ink="#00695c")
                s.line(x0, y - 18, x1, weight=0.6)
                continue
            s.put(x0, y - 9, s.joined(row.label), size=7.5)
            for index, step in enumerate(steps):
                said = replace(row.said, number=stepped(s, row, step), imperial="")
                s.put(first + wide * index, y - 9, said.metric, size=7.5)
            s.line(x0, y - 12.8, x1, weight=0.2)


def osaka(s: Wording) -> None:
    """A ruled table: the section in a cell at the left of its rows, then item, unit and value."""
    s.put(40, 802, phrase(s, "title"), size=13, bold=True)
    foot(s)
    flow = Flow(s, ((40, 555),), 790, 44, 806)
    item, unit, value = 132.0, 372.0, 430.0
    heads = phrase(s, "heads").split(" / ")
    place = -1
    for section, rows in blocks_of(s, rams="rows"):
        rest = list(rows)
        while rest:
            flow.keep(13.2 * min(len(rest), 2) + (14 if flow.place == place else 0))
            if flow.place != place:
                place = flow.place
                x0, x1, y = flow.room(15)
                s.fill(x0, y - 15, x1 - x0, 15, "#dce8ee")
                s.put((x0 + unit) / 2, y - 10.4, heads[0], size=8, bold=True, align="c")
                s.put((unit + value) / 2, y - 10.4, heads[1], size=8, bold=True, align="c")
                s.put((value + x1) / 2, y - 10.4, s.machine.name, size=8, bold=True, align="c")
                s.line(x0, y, x1, weight=0.8)
                s.line(x0, y - 15, x1, weight=0.6)
            count = max(1, min(len(rest), int((flow.y - flow.bottom) / 13.2)))
            top = flow.y
            for row in rest[:count]:
                x0, x1, y = flow.room(13.2)
                s.put(item + 5, y - 9.4, s.joined(row.label), size=7.6)
                s.put((unit + value) / 2, y - 9.4, _unit(row), size=7.6, align="c")
                s.put((value + x1) / 2, y - 9.4, _number(row), size=7.6, align="c")
                s.line(item, y - 13.2, x1, weight=0.25)
            texts = s.wrapped(s.section(section), item - 46, 7.8)
            write(s, 45, (top + flow.y) / 2 - 3 + 4.6 * (len(texts) - 1), texts, 7.8, 9.2, bold=True)
            s.line(40, flow.y, 555, weight=0.6)
            for x in (40, item, unit, value, 555):
                s.line(x, top, x, y1=flow.y, weight=0.4)
            rest = rest[count:]


def richards(s: Wording) -> None:
    """Four columns: a heading with a bar, labels in bold type and below each its value."""
    s.fill(0, 800, 596, 42, "#1d2b44")
    s.put(36, 813, s.machine.name, size=19, bold=True, ink="#f2b705")
    s.put(560, 815, phrase(s, "title"), size=10, align="r", ink="#ffffff")
    foot(s)
    blocks = blocks_of(s, rams="product")
    columns = tuple((36.0 + 133 * i, 36.0 + 133 * i + 124) for i in range(4))
    flow = Flow(s, columns, 788, lower_edge(blocks, 788, 4, 21, 25), 806)
    for section, rows in blocks:
        flow.keep(44)
        x0, x1, y = flow.room(19)
        s.fill(x0, y - 14, x1 - x0, 13, "#f2b705")
        s.put(x0 + 4, y - 10.4, s.section(section).upper(), size=7, bold=True)
        for row in rows:
            texts = s.wrapped(s.joined(row.label), x1 - x0 - 12, 7)
            x0, x1, y = flow.room(8.4 * len(texts) + 12)
            write(s, x0, y - 7, texts, 7, 8.4, bold=True)
            s.put(x0, y - 7 - 8.4 * len(texts), value_of(s, row), size=7)
        flow.room(6)


_DE = Style("de", 0, group=".", point=",", pressure="bar")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, imperial=True, pressure="bar", feet="{}'{}\""),
    "en_kpa": Style("en", 0, imperial=True, pressure="kPa", feet="{} ft {} in"),
    "en_gb": Style("en", 1, imperial=True, pressure="bar", group="", feet="{}'{}\""),
    "en_m": Style("en", 1, metres=True, pressure="bar"),
    "en_w": Style("en", 1, group=""),
    "de": _DE,
    "de_m": replace(_DE, metres=True, tonnes=True),
    "fr": Style("fr", 0, group=" ", point=",", pressure="bar", metres=True),
    "fr_mm": Style("fr", 0, group=" ", point=",", pressure="bar"),
    "es": Style("es", 0, group=".", point=",", pressure="bar"),
    "zh": Style("zh", 0, group=""),
    "ja": Style("ja", 0),
}
FRESH11 = Worded(
    "fresh11",
    "TV",
    {f.__name__: f for f in (racine, rocester, incheon, changsha, linz, osaka, richards)},
    STYLES,
    {
        "wheel_loader": "racine:en_us incheon:en_gb rocester:en_w linz:de racine:fr incheon:es changsha:zh osaka:ja",
        "excavator": "incheon:en_gb racine:en_us rocester:en_gb changsha:en_w linz:de_m racine:es incheon:fr_mm "
        "changsha:zh osaka:ja",
        "articulated_dump_truck": "richards:en_us richards:en_gb incheon:de racine:en_kpa",
        "rigid_dump_truck": "richards:en_us incheon:en_gb changsha:zh",
        "dozer": "racine:en_us incheon:en_w racine:es incheon:es",
        "grader": "racine:en_kpa richards:en_m changsha:zh incheon:en_gb",
        "backhoe_loader": "racine:en_us rocester:en_gb incheon:es racine:fr",
        "forklift": "osaka:ja linz:de linz:en_w osaka:en_gb incheon:en_us",
        "mobile_crane": "changsha:zh changsha:en_w richards:en_us osaka:zh",
        "skid_steer": "linz:fr_mm racine:en_us rocester:en_gb incheon:en_us",
    },
)
