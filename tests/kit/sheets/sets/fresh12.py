"""The set "fresh12": machines of all ten types on six kinds of pages that a user might drop in today.

`annecy`: two striped columns, values begin at one edge; `ankara`: two columns with colons below each other; `lugo`: two
columns under headings with a tick, grey labels over dotted rules, bold values; `lexington`: two columns with leaders,
the US value before the metric one; `straubing`: two or three models as columns, the unit in square brackets behind the
item; `jining`: one ruled table of item, unit and value under shaded rows.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from kit.sheets.sets.rows import blocks_of, colon, foot, lower_edge, phrase, stepped, value_of, write
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Worded, Wording

_GREY = "#6b6f74"
_TWO = ((38, 288), (308, 558))


# ---- layouts ---------------------------------------------------------------------------------------------------------
def annecy(s: Wording) -> None:
    """Two columns: capitals over a rule, striped rows, all values of a column begin at one edge."""
    s.put(38, 798, s.machine.name, size=26, bold=True, ink="#e2001a")
    s.put(558, 800, phrase(s, "title"), size=10, align="r", ink=_GREY)
    foot(s)
    blocks = blocks_of(s, rams="product")
    flow = Flow(s, _TWO, 782, lower_edge(blocks, 782, 2, 14.4, 28), 804)
    stripe = 0
    for section, rows in blocks:
        flow.keep(20 + 15 * min(len(rows), 3))
        x0, x1, y = flow.room(19)
        s.put(x0, y - 12, s.section(section).upper(), size=9.4, bold=True, ink="#e2001a")
        s.line(x0, y - 17, x1, weight=0.9)
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 140, 7.4)
            values = s.wrapped(value_of(s, row), 98, 7.4)
            high = 9 * max(len(texts), len(values)) + 3.6
            x0, x1, y = flow.room(high)
            stripe += 1
            if stripe % 2:
                s.fill(x0, y - high, x1 - x0, high, "#eeeeee")
            write(s, x0 + 3, y - 8.8, texts, 7.4, 9)
            write(s, x0 + 150, y - 8.8, values, 7.4, 9)
        flow.room(8)


def ankara(s: Wording) -> None:
    """Two columns under dark bars: labels, colons below each other, values."""
    s.fill(0, 800, 596, 42, "#f39200")
    s.put(38, 813, f"{s.machine.name}  {phrase(s, 'title')}", size=16, bold=True)
    foot(s)
    blocks = blocks_of(s, rams="rows")
    flow = Flow(s, _TWO, 788, lower_edge(blocks, 788, 2, 13.4, 27), 804)
    for section, rows in blocks:
        flow.keep(20 + 14 * min(len(rows), 3))
        x0, x1, y = flow.room(18)
        s.fill(x0, y - 15, x1 - x0, 14, "#3c3c3b")
        s.put(x0 + 6, y - 11, s.section(section).upper(), size=8.2, bold=True, ink="#ffffff")
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 134, 7.5)
            x0, x1, y = flow.room(9 * len(texts) + 3.2)
            write(s, x0 + 6, y - 9, texts, 7.5, 9)
            s.put(x0 + 145, y - 9, colon(s).strip(), size=7.5)
            s.put(x0 + 154, y - 9, value_of(s, row), size=7.5)
        flow.room(7)


def lugo(s: Wording) -> None:
    """Two columns: a tick before each heading, grey labels at the left, bold values at the right, dotted rules."""
    s.put(38, 800, phrase(s, "title"), size=11, ink=_GREY)
    s.put(558, 796, s.machine.name, size=22, bold=True, align="r", ink="#004f9f")
    foot(s)
    blocks = blocks_of(s, rams="product" if s.style.imperial else "rows")
    flow = Flow(s, _TWO, 780, lower_edge(blocks, 780, 2, 14, 28), 804)
    for section, rows in blocks:
        flow.keep(20 + 15 * min(len(rows), 3))
        x0, x1, y = flow.room(20)
        s.fill(x0, y - 16, 4, 13, "#004f9f")
        s.put(x0 + 9, y - 13, s.section(section), size=10, bold=True, ink="#004f9f")
        for row in rows:
            value = value_of(s, row)
            texts = s.wrapped(s.joined(row.label), x1 - x0 - s.width(value, 7.6, True) - 12, 7.6)
            x0, x1, y = flow.room(9 * len(texts) + 4.4)
            for index, text in enumerate(texts):
                s.put(x0, y - 9.2 - 9 * index, text, size=7.6, ink=_GREY)
            s.put(x1, y - 9.2 - 9 * (len(texts) - 1), value, size=7.6, bold=True, align="r")
            s.canvas.setDash(0.6, 1.6)
            s.line(x0, flow.y, x1, weight=0.5)
            s.canvas.setDash()
        flow.room(7)


def lexington(s: Wording) -> None:
    """Two columns: a heading in bold type, items indented, leaders, the value where there is room for it."""
    s.fill(38, 794, 520, 26, "#1d1d1b")
    s.put(46, 802, s.machine.name, size=15, bold=True, ink="#ffffff")
    s.put(550, 803, phrase(s, "title"), size=10, align="r", ink="#ffffff")
    foot(s)
    blocks = blocks_of(s, rams="rows")
    flow = Flow(s, _TWO, 786, lower_edge(blocks, 786, 2, 12.4, 24), 804)
    for section, rows in blocks:
        flow.keep(18 + 12 * min(len(rows), 3))
        x0, x1, y = flow.room(16)
        s.put(x0, y - 11.4, s.section(section), size=9.2, bold=True)
        for row in rows:
            value = value_of(s, row)
            texts = s.wrapped(s.joined(row.label), x1 - x0 - s.width(value, 7.6) - 26, 7.6)
            x0, x1, y = flow.room(9 * len(texts) + 2.4)
            write(s, x0 + 8, y - 8.8, texts, 7.6, 9)
            base = y - 8.8 - 9 * (len(texts) - 1)
            s.put(x1, base, value, size=7.6, align="r")
            room = x1 - s.width(value, 7.6) - x0 - 12 - s.width(texts[-1], 7.6)
            dots = int(room / s.width(".", 7.6))
            s.put(x1 - s.width(value, 7.6) - 2, base, "." * dots, size=7.6, align="r", ink=_GREY)
        flow.room(8)


def straubing(s: Wording) -> None:
    """Two or three models as columns of a striped table, the unit in square brackets behind the item."""
    steps = (0, 1) if s.machine.kind == "excavator" else (-1, 0, 1)
    names = [f"{s.machine.name[:-3]}{int(s.machine.name[-3:]) + 15 * step}" for step in steps]
    s.config = s.machine.name
    s.put(38, 800, phrase(s, "title"), size=15, bold=True, ink="#00703c")
    foot(s)
    flow = Flow(s, ((38, 558),), 788, 44, 806)
    first = 318.0
    wide = (558 - first) / len(steps)
    place = -1
    for section, rows in blocks_of(s, rams="rows"):
        for index, row in enumerate([None, *rows]):
            flow.keep(44 if row is None else 14)
            if flow.place != place:
                place = flow.place
                x0, x1, y = flow.room(18)
                s.fill(x0, y - 18, x1 - x0, 18, "#00703c")
                for number, name in enumerate(names):
                    s.put(first + wide * (number + 0.5), y - 12, name, size=9, bold=True, align="c", ink="#ffffff")
            x0, x1, y = flow.room(17 if row is None else 13)
            if row is None:
                s.put(x0 + 4, y - 12.4, s.section(section), size=8.8, bold=True, ink="#00703c")
                continue
            if index % 2:
                s.fill(x0, y - 13, x1 - x0, 13, "#e8f1ec")
            unit = f" [{row.said.unit}]" if row.said.unit else ""
            s.put(x0 + 4, y - 9.2, s.joined(row.label) + unit, size=7.6)
            for number, step in enumerate(steps):
                s.put(first + wide * (number + 0.5), y - 9.2, stepped(s, row, step), size=7.6, align="c")


def jining(s: Wording) -> None:
    """One ruled table of item, unit and value; a shaded row over each section's rows."""
    s.put(298, 802, f"{s.machine.name} {phrase(s, 'title')}", size=14, bold=True, align="c")
    foot(s)
    flow = Flow(s, ((62, 534),), 790, 44, 806)
    unit, value = 332.0, 400.0
    heads = phrase(s, "heads").split(" / ")
    place = -1
    for section, rows in blocks_of(s, rams="rows"):
        for row in [None, *rows]:
            flow.keep(44 if row is None else 15)
            if flow.place != place:
                place = flow.place
                x0, x1, y = flow.room(16)
                s.fill(x0, y - 16, x1 - x0, 16, "#c9d8ea")
                s.put((x0 + unit) / 2, y - 11, heads[0], size=8.2, bold=True, align="c")
                s.put((unit + value) / 2, y - 11, heads[1], size=8.2, bold=True, align="c")
                s.put((value + x1) / 2, y - 11, s.machine.name, size=8.2, bold=True, align="c")
                for x in (x0, unit, value, x1):
                    s.line(x, y, x, y1=y - 16)
                s.line(x0, y, x1)
                s.line(x0, y - 16, x1)
            x0, x1, y = flow.room(13.6)
            if row is None:
                s.fill(x0, y - 13.6, x1 - x0, 13.6, "#eef2f6")
                s.put(x0 + 5, y - 9.8, s.section(section), size=8, bold=True)
            else:
                s.put(x0 + 5, y - 9.8, s.joined(row.label), size=7.8)
                s.put((unit + value) / 2, y - 9.8, row.said.unit, size=7.8, align="c")
                s.put((value + x1) / 2, y - 9.8, row.said.number, size=7.8, align="c")
            for x in (x0, unit, value, x1) if row else (x0, x1):
                s.line(x, y, x, y1=y - 13.6)
            s.line(x0, y - 13.6, x1)


_DE = Style("de", 0, group=".", point=",", pressure="bar")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, imperial=True, pressure="kPa", feet="{}' {}\""),
    "en_us2": Style("en", 0, imperial=True, pressure="bar", feet="{} ft {} in"),
    "en_eu": Style("en", 1, pressure="bar"),
    "en_tr": Style("en", 1, imperial=True, pressure="bar", feet="{}'{}\""),
    "en_w": Style("en", 1, group=""),
    "de": _DE,
    "de_m": replace(_DE, metres=True),
    "fr": Style("fr", 0, group=" ", point=",", pressure="bar"),
    "fr_m": Style("fr", 0, group=" ", point=",", pressure="bar", metres=True),
    "es": Style("es", 0, group=".", point=",", pressure="bar"),
    "zh": Style("zh", 0, group=""),
    "ja": Style("ja", 0),
}
FRESH12 = Worded(
    "fresh12",
    "QK",
    {f.__name__: f for f in (annecy, ankara, lugo, lexington, straubing, jining)},
    STYLES,
    {
        "wheel_loader": "ankara:en_tr lexington:en_us straubing:de annecy:fr lugo:es jining:zh jining:ja lugo:en_eu",
        "excavator": "lexington:en_us ankara:en_tr straubing:en_eu annecy:de_m lugo:fr_m ankara:es jining:zh jining:ja",
        "articulated_dump_truck": "annecy:en_tr lexington:en_us2 lugo:de annecy:fr",
        "rigid_dump_truck": "lugo:en_us jining:zh ankara:en_w",
        "dozer": "lexington:en_us2 annecy:es jining:zh",
        "grader": "annecy:en_us ankara:es jining:zh",
        "backhoe_loader": "ankara:en_tr lexington:en_us annecy:fr lugo:es",
        "forklift": "straubing:de straubing:en_w jining:ja",
        "mobile_crane": "straubing:de_m jining:zh lugo:en_tr",
        "skid_steer": "lugo:en_us annecy:fr jining:ja",
    },
)
