"""The set "fresh13": data sheets of dealers, rental firms and makers, machines of all ten types on six kinds of pages.

`dealer`: a letterhead, a photograph, and two striped columns of label, colon and value; `leaders`: one column, dotted
leaders, the items of a group indented below its name; `lettered`: a drawing beside the table of its letters, other
sections as plain lists below; `range_card`: two or three models as columns on a landscape page, the unit after a comma;
`systems`: one table with a metric and a US column, heads in each section; `sidebar`: key figures in a coloured column,
tables beside them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from kit.sheets.sets.rows import blocks_of, colon, figure, foot, lower_edge, phrase, stepped, value_of, write
from kit.sheets.typeset import HEIGHT, WIDTH, Style
from kit.sheets.worded import Flow, Row, Worded, Wording

_GREY = "#6b6f74"
_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
_KEYS = ("Net Power", "Operating Weight", "Rated Payload", "Rated Capacity", "Maximum Lifting Capacity",
         "Bucket Capacity Heaped", "Bucket Capacity", "Maximum Digging Depth", "Lift Height", "Blade Capacity",
         "Moldboard Length", "Boom Length Extended", "Body Capacity Heaped", "Rated Operating Capacity")  # fmt: skip


# ---- layouts ---------------------------------------------------------------------------------------------------------
def dealer(s: Wording) -> None:
    """A dealer's letterhead and a photograph; two columns of striped rows, values at a tab stop after the colon."""
    s.put(40, 812, "NORDHAVEN MACHINERY", size=13, bold=True, ink="#004b87")
    s.put(40, 800, phrase(s, "firm"), size=7, ink=_GREY)
    s.put(555, 812, "Harbour Road 12", size=7, align="r", ink=_GREY)
    s.put(555, 802, "www.example.com", size=7, align="r", ink=_GREY)
    s.line(40, 793, 555, weight=1.2)
    s.put(40, 764, s.machine.name, size=20, bold=True)
    s.put(40, 748, phrase(s, "title"), size=10, ink=_GREY)
    s.fill(385, 690, 170, 94, "#d4d9dd")
    foot(s)
    blocks = blocks_of(s)
    flow = Flow(s, ((40, 291), (304, 555)), 680, lower_edge(blocks, 680, 2, 14, 26), 806)
    for section, rows in blocks:
        flow.keep(50)
        x0, x1, y = flow.room(18)
        s.put(x0 + 3, y - 12, s.section(section), size=9.4, bold=True, ink="#004b87")
        s.line(x0, y - 17, x1, weight=0.8)
        for index, row in enumerate(rows):
            values = s.wrapped(value_of(s, row), 100, 7.4)
            texts = s.wrapped(s.joined(row.label) + colon(s), 140, 7.4)
            high = 9 * max(len(texts), len(values)) + 4
            x0, x1, y = flow.room(high)
            if index % 2 == 0:
                s.fill(x0, y - high, x1 - x0, high, "#eaf0f5")
            write(s, x0 + 3, y - 9.2, texts, 7.4, 9)
            write(s, x0 + 150, y - 9.2, values, 7.4, 9, bold=True)
        flow.room(7)


def leaders(s: Wording) -> None:
    """A maker's plain data sheet: one column with dotted leaders, groups' items indented below their names."""
    s.put(WIDTH / 2, 800, s.machine.name, size=20, bold=True, align="c")
    s.put(WIDTH / 2, 784, phrase(s, "title"), size=10, align="c", ink=_GREY)
    foot(s)
    flow = Flow(s, ((90, 505),), 768, 44, 800)
    for section, rows in blocks_of(s, rams="product" if s.style.language != "ja" else "rows"):
        flow.keep(58)
        x0, x1, y = flow.room(20)
        s.put(x0, y - 14, s.section(section).upper(), size=9, bold=True)
        group = ""
        for row in rows:
            name, mark, item = row.label.partition(" > ")
            if mark and name != group:
                flow.keep(27)
                x0, x1, y = flow.room(12.6)
                s.put(x0, y - 9.4, name, size=8.4)
            group = name if mark else ""
            x0, x1, y = flow.room(12.6)
            left, label = (x0 + 14, item) if mark else (x0, row.label)
            value = value_of(s, row)
            end = left + s.put(left, y - 9.4, label, size=8.4) + 3
            begin = x1 - s.put(x1, y - 9.4, value, size=8.4, align="r") - 3
            s.put(begin, y - 9.4, "." * int((begin - end) / s.width(".", 8.4)), size=8.4, align="r")
        flow.room(5)


def _list(s: Wording, flow: Flow, section: str, rows: list[Row]) -> None:
    """A section as plain lines, values at the right edge."""
    flow.keep(44)
    x0, x1, y = flow.room(17)
    s.put(x0, y - 12, s.section(section), size=9, bold=True, ink="#2e6b34")
    for row in rows:
        value = value_of(s, row)
        texts = s.wrapped(s.joined(row.label), x1 - x0 - s.width(value, 7.4) - 10, 7.4)
        x0, x1, y = flow.room(9 * len(texts) + 2.6)
        write(s, x0, y - 8.6, texts, 7.4, 9)
        s.put(x1, y - 8.6, value, size=7.4, align="r")
    flow.room(6)


def lettered(s: Wording) -> None:
    """A drawing with letters, the table of its letters at its right; the other sections in two plain columns."""
    s.put(40, 800, s.machine.name, size=22, bold=True, ink="#2e6b34")
    s.put(555, 802, phrase(s, "title"), size=10, align="r", ink=_GREY)
    s.line(40, 790, 555, weight=2)
    foot(s)
    blocks = blocks_of(s, rams="product")
    drawn = [row for one, rows in blocks if one in ("working", "dimensions") for row in rows]
    letters = [_LETTERS[i % 26] + ("" if i < 26 else str(i // 26)) for i in range(len(drawn))]
    figure(s, 44, 560, 215, 200, letters[:16])
    y = 782.0
    s.put(275, y - 10, s.section("dimensions"), size=9, bold=True, ink="#2e6b34")
    y -= 15
    for letter, row in zip(letters, drawn, strict=True):
        value = value_of(s, row)
        texts = s.wrapped(s.joined(row.label), 260 - s.width(value, 7.4), 7.4)
        high = 9 * len(texts) + 3.4
        s.line(275, y, 555, weight=0.3)
        s.put(281, y - 9, letter, size=7.4, bold=True, align="c")
        write(s, 292, y - 9, texts, 7.4, 9)
        s.put(555, y - 9, value, size=7.4, align="r")
        y -= high
    s.line(275, y, 555, weight=0.3)
    top = min(y, 556.0) - 12
    others = [block for block in blocks if block[0] not in ("working", "dimensions")]
    flow = Flow(s, ((40, 288), (307, 555)), top, lower_edge(others, top, 2, 12, 24), 800)
    for section, rows in others:
        _list(s, flow, section, rows)


def range_card(s: Wording) -> None:
    """A landscape table with two or three models as columns; the unit after a comma behind the label."""
    s.paper((HEIGHT, WIDTH))
    steps = (0, 1) if s.machine.kind in ("wheel_loader", "forklift") else (-1, 0, 1)
    names = [f"{s.machine.name[:-3]}{int(s.machine.name[-3:]) + 10 * step}" for step in steps]
    s.config = s.machine.name
    s.put(40, 560, phrase(s, "title"), size=16, bold=True)
    s.put(800, 562, "  |  ".join(names), size=11, align="r", ink=_GREY)
    foot(s)
    flow = Flow(s, ((40, 800),), 550, 44, 560)
    wide = 420 / len(steps)
    place = -1
    for section, rows in blocks_of(s):
        for index, row in enumerate([None, *rows]):
            flow.keep(32 if row is None else 16)
            if flow.place != place:
                place = flow.place
                x0, x1, y = flow.room(18)
                s.fill(x0, y - 18, x1 - x0, 18, "#333c45")
                s.put(x0 + 6, y - 12.4, phrase(s, "item"), size=9, bold=True, ink="#ffffff")
                for i, name in enumerate(names):
                    x = x1 - wide * (len(names) - i - 0.5)
                    s.put(x, y - 12.4, name, size=9, bold=True, align="c", ink="#ffffff")
            x0, x1, y = flow.room(15)
            if row is None:
                s.put(x0 + 6, y - 11, s.section(section).upper(), size=8.2, bold=True, ink="#b8500f")
                s.line(x0, y - 15, x1, weight=0.8)
                continue
            if index % 2 == 0:
                s.fill(x0, y - 15, x1 - x0, 15, "#f3f1ec")
            unit = f", {row.said.unit}" if row.said.unit not in ("", "R25") else ""
            s.put(x0 + 6, y - 10.6, s.joined(row.label) + unit, size=8.2)
            for i, step in enumerate(steps):
                x = x1 - wide * (len(names) - i - 0.5)
                text = row.said.metric if row.said.unit == "R25" else stepped(s, row, step)
                if step and row.name.startswith("*") and row.said.unit == "m³":  # a neighbour's, as fine as its own
                    own = float(row.said.number.replace(s.style.point, "."))
                    text = s.digits(own * (1 + 0.06 * step), 2)
                s.put(x, y - 10.6, text, size=8.2, align="c")


def systems(s: Wording) -> None:
    """One table the width of the page: item, metric value, US value; a black head with the columns' names each time."""
    s.fill(40, 778, 7, 40, "#ffb300")
    s.put(54, 800, s.machine.name, size=19, bold=True)
    s.put(54, 784, phrase(s, "title"), size=10, ink=_GREY)
    foot(s)
    flow = Flow(s, ((40, 555),), 768, 44, 806)
    for section, rows in blocks_of(s):
        flow.keep(50)
        x0, x1, y = flow.room(16)
        s.fill(x0, y - 16, x1 - x0, 16, "#1a1a1a")
        s.put(x0 + 6, y - 11.4, s.section(section), size=8.6, bold=True, ink="#ffffff")
        s.put(395, y - 11.4, phrase(s, "metric"), size=8, align="c", ink="#ffffff")
        s.put(500, y - 11.4, phrase(s, "us"), size=8, align="c", ink="#ffffff")
        for row in rows:
            x0, x1, y = flow.room(13.6)
            s.put(x0 + 6, y - 9.8, s.joined(row.label), size=8)
            s.put(395, y - 9.8, row.said.metric, size=8, align="c")
            second = row.said.imperial or ("–" if row.said.unit else "")
            if row.said.unit == "kW":  # never in metric horsepower in this column
                second = f"{s.digits(float(row.said.number) * 1.341022, 0)} hp"
            s.put(500, y - 9.8, second, size=8, align="c")
            s.line(x0, y - 13.6, x1, weight=0.25)
        flow.room(6)


def sidebar(s: Wording) -> None:
    """A rental firm's sheet: a coloured column with key figures as cards, ruled tables at its right."""
    s.fill(0, 0, 168, HEIGHT, "#12324a")
    s.put(24, 796, s.machine.name, size=17, bold=True, ink="#ffffff")
    s.put(24, 780, phrase(s, "title"), size=9, ink="#c8d6e0")
    s.put(24, 746, phrase(s, "key"), size=9, bold=True, ink="#ffd24a")
    blocks = blocks_of(s, rams="product" if s.style.wording else "rows")
    keys = sorted((row for _, rows in blocks for row in rows if row.name in _KEYS), key=lambda r: _KEYS.index(r.name))
    y = 732.0
    for key in keys[:4]:
        s.fill(18, y - 58, 132, 56, "#1d4763")
        s.put(26, y - 24, key.said.metric, size=15, bold=True, ink="#ffffff")
        for index, text in enumerate(s.wrapped(s.joined(key.label), 118, 7)):
            s.put(26, y - 38 - 8.4 * index, text, size=7, ink="#dfe9f0")
        y -= 66
    s.put(186, 26, phrase(s, "note"), size=5.6, ink=_GREY)
    flow = Flow(s, ((186, 560),), 812, 44, 812)
    place = 0
    for section, rows in blocks:
        flow.keep(46)
        for row in [None, *rows]:
            x0, x1, y = flow.room(17 if row is None else 12.8)
            if flow.place != place:
                place = flow.place
                s.fill(0, 0, 168, HEIGHT, "#12324a")
            if row is None:
                s.put(x0, y - 12, s.section(section), size=9.4, bold=True, ink="#12324a")
                s.line(x0, y - 16, x1, weight=1)
                continue
            s.put(x0 + 2, y - 9.4, s.joined(row.label), size=7.8)
            s.put(412, y - 9.4, value_of(s, row), size=7.8)
            s.line(x0, y - 12.8, x1, weight=0.2)
        flow.room(6)


_ES = Style("es", 0, group=".", point=",", pressure="bar")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, imperial=True, feet="{}' {}\""),
    "en_us2": Style("en", 0, imperial=True, pressure="kPa", feet="{} ft {} in"),
    "en_eu": Style("en", 1, pressure="bar"),
    "en_ap": Style("en", 1, imperial=True, feet="{}'{}\""),
    "de": Style("de", 0, group=".", point=",", pressure="bar"),
    "fr": Style("fr", 0, group=" ", point=",", pressure="bar"),
    "es": _ES,
    "es_mx": replace(_ES, imperial=True),
    "zh": Style("zh", 0, group=""),
    "ja": Style("ja", 0),
}
FRESH13 = Worded(
    "fresh13",
    "QH",
    {f.__name__: f for f in (dealer, leaders, lettered, range_card, systems, sidebar)},
    STYLES,
    {
        "wheel_loader": "dealer:en_eu leaders:de systems:en_us lettered:fr sidebar:es dealer:zh range_card:ja "
        "lettered:en_us2",
        "excavator": "dealer:de leaders:en_eu lettered:en_us systems:en_ap range_card:zh sidebar:fr dealer:es "
        "lettered:ja range_card:en_eu",
        "articulated_dump_truck": "dealer:fr leaders:en_us systems:en_ap leaders:de",
        "rigid_dump_truck": "leaders:en_us2 dealer:es range_card:zh",
        "dozer": "lettered:en_us dealer:ja systems:es_mx",
        "grader": "dealer:en_eu leaders:fr range_card:zh systems:en_us",
        "backhoe_loader": "sidebar:en_us leaders:es lettered:fr dealer:en_eu",
        "forklift": "range_card:en_eu dealer:de lettered:ja",
        "mobile_crane": "sidebar:en_eu leaders:de dealer:zh",
        "skid_steer": "systems:en_us2 dealer:de sidebar:fr leaders:en_us",
    },
)
