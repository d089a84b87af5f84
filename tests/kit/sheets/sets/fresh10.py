"""The set "fresh10": machines of all ten types on seven kinds of pages that a user might bring along today.

`fargo`: a flyer of small machines, a drawing over two columns, letters in brackets before the items; `ulm`: headings in
the margin beside label and value; `weblist`: a maker's web page as a browser prints it; `shadyside`: a pictogram, a
heading, and bullets with colons; `liuzhou`: two ruled columns with bars, both systems parted by a stroke; `hino`: two
or three models in columns, groups in cells; `turin`: the unit in brackets after the label, dotted leaders, a number.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from kit.sheets.sets.rows import blocks_of, colon, figure, foot, lower_edge, phrase, stepped, value_of, write
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Worded, Wording

_INK, _GREY = "#1f2226", "#6b6f74"
_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"


# ---- layouts ---------------------------------------------------------------------------------------------------------
def fargo(s: Wording) -> None:
    """A drawing with letters; below it two columns of ruled tables, the drawing's letters in brackets."""
    s.fill(0, 790, 596, 52, "#d9531e")
    s.put(40, 806, s.machine.name, size=24, bold=True, ink="#ffffff")
    s.put(555, 808, phrase(s, "title"), size=11, align="r", ink="#ffffff")
    foot(s)
    blocks = blocks_of(s, rams="product" if s.style.wording else "rows")
    drawn = ("working", "dimensions")
    count = sum(len(rows) for one, rows in blocks if one in drawn)
    letters = [_LETTERS[i % 26] + ("" if i < 26 else str(i // 26)) for i in range(count)]
    figure(s, 60, 578, 470, 200, letters[:20])
    blocks.sort(key=lambda block: block[0] not in drawn)
    marks = iter(letters)
    flow = Flow(s, ((40, 288), (307, 555)), 566, lower_edge(blocks, 566, 2, 13, 27), 796)
    for section, rows in blocks:
        flow.keep(30 + 12 * min(len(rows), 4))
        x0, x1, y = flow.room(19)
        s.put(x0, y - 12, s.section(section).upper(), size=9, bold=True, ink="#d9531e")
        s.line(x0, y - 16, x1, weight=1.4)
        for row in rows:
            label = f"({next(marks)}) {s.joined(row.label)}" if section in drawn else s.joined(row.label)
            value = value_of(s, row)
            texts = s.wrapped(label, x1 - x0 - s.width(value, 7.4) - 10, 7.4)
            x0, x1, y = flow.room(9 * len(texts) + 3.4)
            write(s, x0, y - 8.6, texts, 7.4, 9)
            s.put(x1, y - 8.6, value, size=7.4, align="r")
            s.line(x0, flow.y, x1, weight=0.25)
        flow.room(8)


def ulm(s: Wording) -> None:
    """A sober data sheet: headings stand in the margin, labels and values in two columns beside them."""
    s.put(40, 800, s.machine.name, size=22, bold=True)
    s.put(40, 784, phrase(s, "title"), size=9, ink=_GREY)
    foot(s)
    flow = Flow(s, ((40, 555),), 770, 46, 800)
    for section, rows in blocks_of(s, rams="product"):
        flow.keep(14 + 12 * min(len(rows), 6))
        x0, x1, y = flow.room(6)
        s.line(x0, y - 2, x1, weight=0.7)
        for index, row in enumerate(rows):
            texts = s.wrapped(s.joined(row.label), 238, 8.2)
            x0, x1, y = flow.room(10 * len(texts) + 2.4)
            if index == 0:
                write(s, x0, y - 9.4, s.wrapped(s.section(section), 100, 9), 9, 11, bold=True)
            write(s, x0 + 116, y - 9.4, texts, 8.2, 10)
            s.put(x0 + 366, y - 9.4, value_of(s, row, "{} / {}"), size=8.2)
        flow.room(5 if len(rows) > 1 else 14)


def weblist(s: Wording) -> None:
    """A product page as a browser prints it: address and date about the page, a list under each heading."""

    def furniture() -> None:
        s.put(24, 822, "11/4/26, 9:12 AM", size=7, ink="#000000")
        s.put(298, 822, f"{s.machine.name} | {phrase(s, 'title').title()}", size=7, align="c", ink="#000000")
        s.put(24, 18, f"https://www.example.com/en/products/{s.machine.name.lower().replace(' ', '-')}/specs", size=7)

    furniture()
    s.put(50, 776, s.machine.name, size=26, bold=True)
    for index, text in enumerate(("OVERVIEW", "SPECS", "EQUIPMENT", "GALLERY", "OFFERS")):
        s.put(50 + 84 * index, 752, text, size=8, bold=index == 1, ink=_INK if index == 1 else _GREY)
    s.line(134, 747, 170, weight=2)
    flow = Flow(s, ((50, 545),), 736, 40, 800)
    place, stripe = 0, 0
    for section, rows in blocks_of(s, rams="rows"):
        flow.keep(58)
        x0, x1, y = flow.room(27)
        if flow.place != place:
            place = flow.place
            furniture()
        s.put(x0, y - 19, s.section(section), size=12, bold=True)
        s.put(x1 - 4, y - 19, "–", size=12, bold=True, align="r", ink=_GREY)
        s.line(x0, y - 24.5, x1, weight=0.6)
        for row in rows:
            x0, x1, y = flow.room(16.5)
            if flow.place != place:
                place = flow.place
                furniture()
            stripe += 1
            if stripe % 2:
                s.fill(x0, y - 16.5, x1 - x0, 16.5, "#f2f2f2")
            s.put(x0 + 6, y - 11.4, s.joined(row.label), size=8.4)
            s.put(x0 + 300, y - 11.4, value_of(s, row), size=8.4, bold=True)
        flow.room(8)


def shadyside(s: Wording) -> None:
    """A product guide: by each heading a pictogram's square, below it bullets "item: value" in two columns."""
    s.fill(40, 776, 515, 40, "#8a1020")
    s.put(50, 789, s.machine.name, size=20, bold=True, ink="#ffffff")
    s.put(546, 791, phrase(s, "title"), size=10, align="r", ink="#ffffff")
    foot(s)
    blocks = blocks_of(s, pairs=True, rams="product")
    flow = Flow(s, ((40, 288), (307, 555)), 764, lower_edge(blocks, 764, 2, 13.6, 32), 800)
    for section, rows in blocks:
        flow.keep(44)
        x0, x1, y = flow.room(24)
        s.fill(x0, y - 20, 18, 18, "#c9ccd0")
        s.canvas.setLineWidth(1)
        s.canvas.circle(x0 + 9, y - 11, 5)
        s.put(x0 + 25, y - 14, s.section(section), size=10, bold=True, ink="#8a1020")
        for row in rows:
            texts = s.wrapped(f"{s.joined(row.label)}{colon(s)} {value_of(s, row)}", x1 - x0 - 36, 8)
            x0, x1, y = flow.room(10 * len(texts) + 2)
            s.put(x0 + 25, y - 9, "•", size=8)
            write(s, x0 + 34, y - 9, texts, 8, 10)
        flow.room(6)


def liuzhou(s: Wording) -> None:
    """Bars over ruled rows in two columns; where both systems are printed a stroke parts them."""
    s.put(40, 800, s.machine.name, size=20, bold=True, ink="#c40d1e")
    s.put(40 + s.width(s.machine.name, 20, True) + 12, 800, phrase(s, "title"), size=11, ink=_GREY)
    s.line(40, 790, 555, weight=2)
    foot(s)
    blocks = blocks_of(s, rams="product" if s.style.language != "zh" else "rows")
    flow = Flow(s, ((40, 291), (304, 555)), 780, lower_edge(blocks, 780, 2, 14, 26), 800)
    for section, rows in blocks:
        flow.keep(20 + 14 * min(len(rows), 5))
        x0, x1, y = flow.room(16)
        s.fill(x0, y - 15, x1 - x0, 15, "#c40d1e")
        s.put(x0 + 5, y - 10.8, s.section(section), size=8.6, bold=True, ink="#ffffff")
        for row in rows:
            value = value_of(s, row, "{} / {}")
            texts = s.wrapped(s.joined(row.label), x1 - x0 - s.width(value, 7.4) - 16, 7.4)
            x0, x1, y = flow.room(9 * len(texts) + 4.4)
            write(s, x0 + 5, y - 9.2, texts, 7.4, 9)
            s.put(x1 - 5, y - 4.7 - 4.5 * len(texts), value, size=7.4, align="r")
            s.line(x0, flow.y, x1, weight=0.3)
        flow.room(7)


def hino(s: Wording) -> None:
    """A ruled table of two or three models, with a column of units; the items of a group share its cell."""
    steps = (0, 1) if s.machine.kind in ("excavator", "dozer") else (-1, 0, 1)
    names = [f"{s.machine.name[:-3]}{int(s.machine.name[-3:]) + 15 * step}" for step in steps]
    s.config = s.machine.name
    s.put(40, 800, " / ".join(names), size=15, bold=True)
    s.put(555, 800, phrase(s, "title"), size=10, align="r", ink=_GREY)
    foot(s)
    flow = Flow(s, ((40, 555),), 790, 46, 800)
    item, unit, first = 156.0, 310.0, 352.0
    wide = (555 - first) / len(steps)
    heads = phrase(s, "heads").split(" / ")
    place = -1

    def head() -> None:
        x0, x1, y = flow.room(17)
        s.fill(x0, y - 17, x1 - x0, 17, "#dfe6ee")
        s.put(x0 + 4, y - 11.6, heads[0], size=8, bold=True)
        s.put((unit + first) / 2, y - 11.6, heads[1], size=8, bold=True, align="c")
        for index, name in enumerate(names):
            s.put(first + wide * (index + 0.5), y - 11.6, name, size=8, bold=True, align="c")
        s.line(x0, y, x1, weight=0.8)
        s.line(x0, y - 17, x1, weight=0.5)

    for section, rows in blocks_of(s, pairs=True):
        group = ""
        for row in [None, *rows]:
            high = 13.4 if row else 14.0
            flow.keep(high + 30)
            if flow.place != place:
                place, group = flow.place, ""
                head()
            x0, x1, y = flow.room(high)
            if row is None:
                s.fill(x0, y - high, x1 - x0, high, "#f1f3f5")
                s.put(x0 + 4, y - 9.8, s.section(section), size=8, bold=True)
                s.line(x0, y - high, x1)
                continue
            name, mark, part = row.label.partition(" > ")
            if mark:
                if name != group:
                    s.line(x0, y, item)
                    s.put(x0 + 4, y - 9.4, name, size=7.4)
                s.put(item + 4, y - 9.4, part, size=7.4)
                s.line(item, y, item, y1=y - high, weight=0.3)
                s.line(item, y - high, x1, weight=0.3)
            else:
                s.line(x0, y, item, weight=0.3)
                s.put(x0 + 4, y - 9.4, name, size=7.4)
                s.line(x0, y - high, x1, weight=0.3)
            group = name if mark else ""
            for x in (unit, first, *(first + wide * (i + 1) for i in range(len(steps) - 1))):
                s.line(x, y, x, y1=y - high, weight=0.3)
            s.put((unit + first) / 2, y - 9.4, row.said.unit, size=7.4, align="c")
            for index, step in enumerate(steps):
                s.put(first + wide * (index + 0.5), y - 9.4, stepped(s, row, step), size=7.4, align="c")


def turin(s: Wording) -> None:
    """Two columns: the unit in brackets after the label, dots, and the number at the right edge."""
    s.put(40, 796, s.machine.name, size=24, bold=True, ink="#0b3d91")
    s.fill(40, 772, 515, 16, "#f7c600")
    s.put(46, 776.5, phrase(s, "title"), size=9, bold=True)
    foot(s)
    blocks = blocks_of(s, rams="product")
    flow = Flow(s, ((40, 288), (307, 555)), 762, lower_edge(blocks, 762, 2, 13, 27), 800)
    for section, rows in blocks:
        flow.keep(22 + 12 * min(len(rows), 3))
        x0, x1, y = flow.room(19)
        s.put(x0, y - 12, s.section(section).upper(), size=9, bold=True, ink="#0b3d91")
        for row in rows:
            said = row.said
            unit, value = said.unit, said.number
            if said.imperial:  # power in both units
                number, _, second = said.imperial.rpartition(" ")
                unit, value = f"{unit}/{second}", f"{value}/{number}"
            label = s.joined(row.label) + (f" ({unit})" if unit else "")
            texts = s.wrapped(label, x1 - x0 - s.width(value, 7.6, True) - 14, 7.6)
            x0, x1, y = flow.room(9.2 * len(texts) + 2.6)
            write(s, x0, y - 9, texts, 7.6, 9.2)
            base = y - 9 - 9.2 * (len(texts) - 1)
            s.put(x1, base, value, size=7.6, bold=True, align="r")
            left, right = x0 + s.width(texts[-1], 7.6) + 2, x1 - s.width(value, 7.6, True) - 2
            dots = int((right - left) / s.width(".", 7.6))
            s.put(right, base, "." * dots, size=7.6, align="r")
        flow.room(7)


_LA = Style("es", 0, group=".", point=",", pressure="bar")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, imperial=True, pressure="kPa", feet="{}' {}\""),
    "en_us2": Style("en", 0, imperial=True, pressure="bar", feet="{} ft {} in"),
    "en_eu": Style("en", 1, pressure="bar"),
    "en_ap": Style("en", 1, imperial=True, feet="{}'{}\""),
    "de": Style("de", 0, group=".", point=",", pressure="bar"),
    "de_m": Style("de", 0, group=".", point=",", pressure="bar", metres=True),
    "fr": Style("fr", 0, group=" ", point=",", pressure="bar"),
    "es": _LA,
    "es_m": replace(_LA, metres=True),
    "zh": Style("zh", 0, group=""),
    "ja": Style("ja", 0),
}
FRESH10 = Worded(
    "fresh10",
    "NB",
    {f.__name__: f for f in (fargo, ulm, weblist, shadyside, liuzhou, hino, turin)},
    STYLES,
    {
        "wheel_loader": "liuzhou:en_ap turin:es ulm:de weblist:en_us liuzhou:zh turin:fr fargo:en_eu",
        "excavator": "liuzhou:en_ap turin:es hino:ja fargo:en_eu ulm:de_m weblist:en_us2 turin:fr hino:en_eu "
        "liuzhou:zh fargo:ja",
        "articulated_dump_truck": "weblist:en_us ulm:de turin:fr shadyside:en_ap",
        "rigid_dump_truck": "liuzhou:en_ap weblist:en_us2 liuzhou:zh",
        "dozer": "weblist:en_us2 liuzhou:en_ap turin:es hino:ja",
        "grader": "weblist:en_us turin:es_m liuzhou:zh liuzhou:en_ap",
        "backhoe_loader": "fargo:en_us2 turin:es turin:fr weblist:en_eu",
        "forklift": "hino:ja hino:en_eu hino:zh ulm:de fargo:en_us weblist:en_eu",
        "mobile_crane": "shadyside:en_us2 shadyside:en_eu shadyside:de_m liuzhou:zh liuzhou:en_ap",
        "skid_steer": "fargo:en_us fargo:fr fargo:de weblist:en_eu",
    },
)
