"""The set "fresh9": machines of all ten types on seven kinds of pages that are met with most often today.

`peoria`: two columns of item, metric and US value, numbers of a drawing, bullets; `eskilstuna`: three narrow columns,
a sentence and a table of item, unit and value; `biberach`: label, rule and value, a lettered table of dimensions;
`moline`: one table, two arms, buckets or models beside each other, shared values in the middle; `sakai`: two ruled
tables with sections set upright; `moosburg`: the type sheet of an industrial truck; `depot`: a rental firm's page.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

from kit.sheets.machines import rounded
from kit.sheets.sets.fresh9_rows import (
    GREY,
    begin,
    blocks_of,
    columns,
    foot,
    foreign,
    level_of,
    local,
    other,
    places,
    rows_of,
    text_of,
    upright,
    word,
)
from kit.sheets.sets.rows import figure, write
from kit.sheets.typeset import HEIGHT, WIDTH, Style
from kit.sheets.worded import Flow, Row, Worded, Wording, lines

_LETTER = (612.0, 792.0)
_LETTERS = "ABCDEFGHJKLMNOPQRSTUVWXYZ"
_DRAWN = ("dimensions", "working", "backhoe")
_CARDS = ("Rated Operating Capacity", "Bucket Capacity", "Bucket Capacity Heaped", "Maximum Digging Depth",
          "Dumping Clearance", "Overall Width", "Moldboard Length", "Backhoe Loading Height", "Loader Lift Capacity",
          "Maximum Travel Speed")  # fmt: skip
_NOT_RENTED = {"cylinders", "cycle", "axles"}
_GROUPS = {"1": "mark", "2": "weights", "3": "tyres", "4": "dimensions", "5": "performance", "7": "engine",
           "10": "hydraulics"}  # fmt: skip


# ---- pages -----------------------------------------------------------------------------------------------------------
def peoria(s: Wording) -> None:
    """Letter paper: two columns of item, metric and US value over hairlines; numbers of a drawing; bullets."""
    s.paper(_LETTER)
    begin(s)
    s.fill(36, 738, 26, 26, "#ffcd11")
    s.put(70, 745, s.machine.name, size=20, bold=True)
    s.put(576, 745, word(s, "title"), size=12, align="r", ink=GREY)
    foot(s, 36, 540)
    blocks = blocks_of(s)
    number, numbers = 0, {}
    for section, rows in blocks:
        for row in rows:
            if section in _DRAWN and row.said.unit in ("mm", "m"):
                number += 1
                numbers[id(row)] = str(number)
    figure(s, 60, 560, 480, 165, list(numbers.values())[:14])
    flow = Flow(s, ((36, 298), (314, 576)), 548, 48, 752)
    for section, rows in blocks:
        bullet = word(s, f"bullet_{section}") if section in ("engine", "weights") else ""
        about = "Net Power" if section == "engine" else "Operating Weight"
        bullet = bullet if s.prints(about) and s.machine.kind != "forklift" else ""
        flow.keep(22 + 13 * min(len(rows), 4))
        x0, x1, y = flow.room(18)
        s.put(x0, y - 11, s.section(section), size=9.6, bold=True)
        s.line(x0, y - 15, x1, weight=1.1)
        for row in rows:
            mark = numbers.get(id(row), "")
            left = 14.0 if mark else 0.0
            texts = s.wrapped(s.joined(row.label), 138 - left, 7.2)
            x0, x1, y = flow.room(8.6 * len(texts) + 4.2)
            s.put(x0, y - 8.8, mark, size=7.2, bold=True)
            write(s, x0 + left, y - 8.8, texts, 7.2, 8.6)
            s.put(x0 + 203, y - 8.8, row.said.metric, size=7.2, align="r")
            s.put(x1, y - 8.8, row.said.imperial, size=7.2, align="r")
            s.line(x0, y - 8.6 * len(texts) - 3.6, x1, weight=0.25)
        if bullet:
            texts = s.wrapped(bullet, 250, 6.2)
            x0, _, y = flow.room(7.4 * len(texts) + 4)
            s.put(x0, y - 8, "•", size=6.2)
            write(s, x0 + 7, y - 8, texts, 6.2, 7.4)
        flow.room(9)


def eskilstuna(s: Wording) -> None:
    """Three narrow columns: a heading, a sentence, then item, unit and value between hairlines; items under a group."""
    begin(s)
    s.put(40, HEIGHT - 50, word(s, "title"), size=20, ink="#1f3b5c")
    s.put(WIDTH - 40, HEIGHT - 50, s.machine.name, size=12, bold=True, align="r", ink="#1f3b5c")
    foot(s, 40, 515)
    blocks = blocks_of(s)
    xs = ((40, 202), (216, 378), (392, 554))
    flow = Flow(s, xs, HEIGHT - 76, level_of(blocks, HEIGHT - 76, 3, 12.4, 42), HEIGHT - 50)
    for section, rows in blocks:
        intro = word(s, f"intro_{section}") if section in ("engine", "drive", "hydraulics") else ""
        flow.keep(34 + 12 * min(len(rows), 4))
        x0, x1, y = flow.room(15)
        s.put(x0, y - 11, s.section(section), size=8.6, bold=True, ink="#1f5f99")
        if intro:
            texts = s.wrapped(intro, 160, 6.2)
            x0, x1, y = flow.room(7.4 * len(texts) + 4)
            write(s, x0, y - 7, texts, 6.2, 7.4)
        s.line(x0, flow.y, x1, weight=0.8)
        before = ""
        for row in rows:
            group, mark, item = row.label.partition(" > ")
            if mark and (flow.keep(34 if group != before else 20) or group != before):
                x0, x1, y = flow.room(11.2)
                s.put(x0, y - 8, group, size=6.5, bold=True)
            before = group if mark else ""
            unit, value = row.said.unit, row.said.number
            if row.said.imperial and unit == "kW":
                second, _, name = row.said.imperial.rpartition(" ")
                unit, value = f"kW ({name})", f"{value} ({second})"
            indent = 7.0 if mark else 0.0
            texts = s.wrapped(item if mark else row.label, 98 - indent, 6.5)
            x0, x1, y = flow.room(7.8 * len(texts) + 3.6)
            write(s, x0 + indent, y - 8, texts, 6.5, 7.8)
            low = y - 8 - 7.8 * (len(texts) - 1)
            wide = not unit and s.width(value, 6.5) > 30
            s.put(x0 + 102, low, unit, size=6.5)
            s.put(x1, low, value, size=6.5, align="r", bold=not wide)
            s.line(x0, low - 3.2, x1, weight=0.25)
        flow.room(9)


def biberach(s: Wording) -> None:
    """Two columns of label, a rule of underscores, and value; a lettered table under a drawing on a page of its own."""
    begin(s)
    s.put(40, HEIGHT - 46, word(s, "title"), size=16, bold=True)
    s.put(WIDTH - 40, HEIGHT - 46, s.machine.name, size=16, align="r")
    s.line(40, HEIGHT - 54, WIDTH - 40, weight=2.2)
    foot(s, 40, 515)
    blocks = blocks_of(s)
    own = [(one, rows) for one, rows in blocks if one not in _DRAWN]
    flow = Flow(s, ((40, 290), (305, 555)), HEIGHT - 66, level_of(own, HEIGHT - 66, 2, 13, 28), HEIGHT - 44)
    for section, rows in own:
        flow.keep(20 + 12 * min(len(rows), 5))
        x0, x1, y = flow.room(21)
        s.fill(x0, y - 14, 9, 9, "#ffc000")
        s.put(x0 + 14, y - 13, s.section(section), size=10, bold=True)
        s.line(x0, y - 17, x1, weight=0.5)
        for row in rows:
            value = text_of(s, row, at=True)
            texts = s.wrapped(s.joined(row.label), 128, 7.4)
            values = s.wrapped(value, 108, 7.4)
            x0, x1, y = flow.room(9 * max(len(texts), len(values)) + 2.4)
            write(s, x0, y - 8.4, texts, 7.4, 9)
            end = x0 + s.width(texts[-1], 7.4) + 1
            base = y - 8.4 - 9 * (len(texts) - 1)
            dashes = int((x0 + 139 - end) / s.width("_", 7.4))
            s.put(end, base, "_" * dashes if dashes > 1 else "", size=7.4, ink="#8a8a8a")
            write(s, x0 + 141, base if len(values) == 1 else y - 8.4, values, 7.4, 9)
        flow.room(10)
    shown = [(one, rows) for one, rows in blocks if one in _DRAWN]
    if not shown:
        return
    y = flow.bottom - 16
    if flow.place > 1 or y - 190 - sum(26 + 12 * len(rows) for _, rows in shown) < 40:
        s.page()
        y = HEIGHT - 44
    letters = iter(_LETTERS + "abcdefghijkmnopqrstuvwxyz")
    marks = {id(row): next(letters) for _, rows in shown for row in rows if row.said.unit in ("mm", "m")}
    figure(s, 70, y - 170, 450, 165, list(marks.values())[:14])
    y -= 186
    for section, rows in shown:
        s.put(40, y - 10, s.section(section), size=10, bold=True)
        s.line(40, y - 14, 555, weight=1)
        y -= 15
        for index, row in enumerate(rows):
            if index % 2:
                s.fill(40, y - 11.6, 515, 11.6, "#eeeeee")
            s.put(44, y - 8.6, marks.get(id(row), ""), size=7.4, bold=True)
            s.put(62, y - 8.6, s.joined(row.label), size=7.4)
            s.put(430, y - 8.6, row.said.unit, size=7.4)
            s.put(551, y - 8.6, row.said.number, size=7.4, align="r")
            y -= 11.6
        y -= 10


def moline(s: Wording) -> None:
    """One wide table: item, then two arms, buckets or models, both systems in a cell; shared values between them."""
    s.paper(_LETTER)
    begin(s)
    s.fill(0, 752, 612, 40, "#2b2b2b")
    s.put(36, 765, f"{s.machine.name}  {word(s, 'title')}", size=15, bold=True, ink="#ffffff")
    foot(s, 36, 540)
    heads, own = columns(s)
    flow = Flow(s, ((36, 576),), 742, 46, 752)
    first, second = 318.0, 450.0
    for section, rows in blocks_of(s):
        said = [(row, other(s, row, own)) for row in rows]
        split = any(one for _, one in said)
        flow.keep(30 + 12 * min(len(rows), 5))
        x0, x1, y = flow.room(15)
        s.fill(x0, y - 14, x1 - x0, 14, "#d9e3cf")
        s.put(x0 + 4, y - 10, s.section(section), size=8.8, bold=True)
        if split:
            for x, head in zip((first, second), heads, strict=True):
                s.put(x, y - 10, head, size=7.6, bold=True)
        for row, beside in said:
            texts = s.wrapped(s.joined(row.label), 270, 7.6)
            values = s.wrapped(text_of(s, row, at=True), 126 if beside else 252, 7.6)
            x0, x1, y = flow.room(9.2 * max(len(texts), len(values)) + 3.4)
            write(s, x0 + 4, y - 9, texts, 7.6, 9.2)
            if beside:
                cells = [values, s.wrapped(text_of(s, replace(row, said=beside), at=True), 126, 7.6)]
                for x, cell in zip((first, second), cells if own == 0 else cells[::-1], strict=True):
                    write(s, x, y - 9, cell, 7.6, 9.2)
            elif split:
                s.put((first + x1) / 2, y - 9, " ".join(values), size=7.6, align="c")
            else:
                write(s, first, y - 9, values, 7.6, 9.2)
            s.line(x0, flow.y + 0.4, x1, weight=0.3)
        flow.room(7)


def sakai(s: Wording) -> None:
    """Two ruled tables beside each other: the section set upright, item, unit, value; items beside their group."""
    begin(s)
    s.fill(0, HEIGHT - 44, WIDTH, 44, "#004a8f")
    s.put(30, HEIGHT - 30, s.machine.name, size=18, bold=True, ink="#ffffff")
    s.put(WIDTH - 30, HEIGHT - 29, word(s, "title"), size=13, align="r", ink="#ffffff")
    foot(s, 30, 530)
    blocks = blocks_of(s)
    edges = ((30, 292), (303, 565))
    flow = Flow(s, edges, HEIGHT - 58, level_of(blocks, HEIGHT - 58, 2, 13.4, 4), HEIGHT - 40)
    s.canvas.setStrokeColorRGB(0.45, 0.45, 0.45)
    for section, rows in blocks:
        flow.keep(13.4 * min(len(rows), 4) + 1)
        start, before = flow.y, ""
        parts = [row.label.partition(" > ") for row in rows]
        items = [s.wrapped(part[2] or part[0], 52 if part[1] else 116, 6.8) for part in parts]
        for index, row in enumerate(rows):
            (group, mark, _), texts = parts[index], items[index]
            x0, x1, y = flow.room(8.4 * len(texts) + 5)
            if y > start or index == 0:
                start, before = y, ""
            joined = mark and group == before
            before = group if mark else ""
            s.line(x0 + (78 if joined else 18), y, x1, weight=0.3)
            if mark:
                s.line(x0 + 78, y, x0 + 78, y1=flow.y, weight=0.3)
            if mark and not joined:
                s.put(x0 + 21, y - 9, group, size=6.8 if s.width(group, 6.8) < 56 else 5.5)
            write(s, x0 + (81 if mark else 21), y - 9, texts, 6.8, 8.4)
            unit, value = row.said.unit, row.said.number
            if row.said.unit == "kW" and row.name:
                unit, value = "kW/min-1", f"{value}/{s.digits(2000, 0)}"
                unit = unit if s.style.language == "ja" else "kW/rpm"
            elif row.said.imperial:
                number, _, second = row.said.imperial.rpartition(" ")
                unit, value = f"{unit}{{{second}}}", f"{value} {{{number}}}"
            middle = (y + flow.y) / 2 - 2.4
            s.put(x0 + 162, middle, unit, size=6.4, align="c")
            s.put((x0 + 188 + x1) / 2, middle, value, size=6.8, align="c")
            if row is rows[-1] or flow.y - 8.4 * len(items[index + 1]) - 5 < flow.bottom:
                _frame(s, (x0, x0 + 18, x0 + 139, x0 + 186, x1), start, flow.y)
                upright(s, s.section(section), x0 + 9, start, flow.y)


def _frame(s: Wording, xs: tuple[float, ...], top: float, bottom: float) -> None:
    """The upright rules of a piece of a table, and its edges."""
    for x in xs:
        s.line(x, top, x, y1=bottom, weight=0.3)
    for y in (top, bottom):
        s.line(xs[0], y, xs[-1], weight=0.6)


def moosburg(s: Wording) -> None:
    """The type sheet of an industrial truck: number, item, symbol and unit, two models; groups set upright."""
    begin(s)
    pairs = [one for one in lines(s.file)["pairs"] if s.style.language in one.words]
    left = {one.name for one in lines(s.file)[s.machine.kind] if s.of(one) == "-"}
    for one in pairs:  # of the names of a pair all are printed, or none
        if not set(one.name.split(" + ")) - {"*"} <= set(s.left_out) | left:
            s.left_out -= set(one.name.split(" + "))
    s.put(40, HEIGHT - 46, f"{word(s, 'title')}  {s.machine.name}", size=15, bold=True)
    s.put(WIDTH - 40, HEIGHT - 46, "VDI 2198", size=8, align="r", ink=GREY)
    foot(s, 40, 515)
    stem, number = s.machine.name.split()
    own = s.dice.randrange(2)
    heads = [f"{stem} {int(number) + 15 * (i - own)}" for i in range(2)]
    s.config = s.machine.name
    rows = {row.name: row for section in places(s) for row in rows_of(s, section, rams="none") if row.name}
    rows = {("Net Power" if name == "Engine Power" else name): row for name, row in rows.items()}
    table: list[tuple[str, str, str, str, list[str]]] = []
    codes = [("1.2", "", word(s, "model"), "", heads)]
    for one in lines(s.file)["codes"]:
        row = rows.get(one.name)
        pair = next((p for p in pairs if one.name in p.name.split(" + ")), None)
        if row is None or (pair and pair.name.split(" + ")[0] != one.name):
            continue
        names = pair.name.split(" + ") if pair else [one.name]
        cells = [_cell(s, rows, names, pair.place if pair else "", i - own) for i in range(2)]
        label = s.of(pair) if pair else s.joined(row.label)
        sign = next(iter(one.words.values()))[0]
        codes.append((one.place, sign, label, row.said.unit, cells))
    table = sorted(codes, key=lambda code: [int(x) for x in code[0].split(".")])
    y, start, before = HEIGHT - 62.0, HEIGHT - 62.0, "1"
    for index, (code, sign, label, unit, cells) in enumerate(table):
        group = code.partition(".")[0]
        if group != before:
            upright(s, s.section(_GROUPS[before]), 50, start, y)
            s.line(40, y, 555, weight=1)
            start, before = y, group
        s.put(64, y - 10, code, size=7.4)
        s.put(92, y - 10, label, size=7.4)
        s.put(330, y - 10, sign, size=7.4)
        s.put(364, y - 10, f"({unit})" if unit else "", size=7.4)
        for x, cell in zip((437, 513), cells, strict=True):
            s.put(x, y - 10, cell, size=7.4, bold=index == 0, align="c")
        y -= 14.4
        s.line(60, y, 555, weight=0.25)
    upright(s, s.section(_GROUPS[before]), 50, start, y)
    for x in (40, 60, 88, 326, 360, 400, 475, 555):
        s.line(x, HEIGHT - 62, x, y1=y, weight=0.25)
    s.line(40, HEIGHT - 62, 555, weight=1)
    s.line(40, y, 555, weight=1)


def _cell(s: Wording, rows: Mapping[str, Row], names: list[str], mark: str, step: int) -> str:
    """A cell of the type sheet for this truck, or one a size larger or smaller; "*": the rear axle's load."""
    texts, values = [], s.machine.values
    for name in names:
        if name == "*":
            load = values["Operating Weight"] - values[names[0]]
            load += values["Rated Capacity"] if " Laden" in names[0] else 0
            texts.append(s.digits(max(round(load * (1 + 0.1 * step), -1), 100), 0))
            continue
        said = rows[name].said
        if step and said.unit in ("mm", "kg", "kN", "kW") and name != "Load Center" and "Tilt" not in name:
            value = rounded(s.machine.kind, name, values[name] * (1 + 0.1 * step))
            said = local(s, s.say(name, value, note=False), name)
        texts.append(said.number)
    return f" {mark} ".join(texts)


def depot(s: Wording) -> None:
    """A rental firm's page: a picture, cards of key figures, a sentence, a striped table; only US units in the US."""
    american = s.style.imperial
    s.paper(_LETTER if american else (WIDTH, HEIGHT))
    begin(s)
    width, height = s.size
    ink = "#0b7a3b" if american else "#c4161c"
    s.fill(0, height - 52, width, 52, ink)
    s.put(36, height - 33, word(s, "rent"), size=15, bold=True, ink="#ffffff")
    s.put(width - 36, height - 33, s.machine.name, size=15, bold=True, align="r", ink="#ffffff")
    say: Callable[[Row], str] = (lambda row: foreign(s, row)) if american else (lambda row: text_of(s, row))
    skipped = frozenset(n for n in s.machine.values if " Cylinder " in n)
    blocks = [(one, rows_of(s, one, rams="none", skip=skipped)) for one in places(s) if one not in _NOT_RENTED]
    every = {row.name: row for _, rows in blocks for row in rows}
    s.fill(36, height - 216, 230, 150, "#dcdcdc")
    s.put(151, height - 145, s.machine.name, size=9, align="c", ink="#999999")
    cards = [name for name in _CARDS if name in every][:4]
    for index, name in enumerate(cards):
        wide = (width - 322) / 2
        x, y = 280 + (wide + 6) * (index % 2), height - 66 - 46 * (index // 2)
        s.fill(x, y - 40, wide, 40, "#f1f1f1")
        s.put(x + 8, y - 18, say(every[name]), size=12, bold=True, ink=ink)
        texts = s.wrapped(every[name].label, wide - 12, 6.4)[:2]
        write(s, x + 8, y - (31 if len(texts) == 1 else 28), texts, 6.4, 7.4)
    prose = word(s, "prose")
    if prose and "Net Power" in every and "Operating Weight" in every:
        texts = [say(every[name]) for name in ("Operating Weight", "Net Power")]
        text = prose.format(s.machine.name, *texts)
        write(s, 280, height - 172, s.wrapped(text, width - 316, 8), 8, 11)
    s.put(36, height - 236, word(s, "title") if not american else "Specifications", size=12, bold=True, ink=ink)
    top, stripe = height - 244, 0
    kept = [(one, [row for row in rows if row.name not in cards]) for one, rows in blocks]
    middle = width / 2
    flow = Flow(s, ((36, middle - 8), (middle + 8, width - 36)), top, level_of(kept, top, 2, 13.4, 22), height - 40)
    for section, rows in kept:
        if not rows:
            continue
        flow.keep(44)
        x0, x1, y = flow.room(16)
        s.put(x0 + 4, y - 12, s.section(section), size=8.6, bold=True)
        for row in rows:
            value = say(row)
            texts = s.wrapped(s.joined(row.label), x1 - x0 - s.width(value, 7.6, True) - 16, 7.6)
            x0, x1, y = flow.room(9.2 * len(texts) + 4)
            stripe += 1
            if stripe % 2:
                s.fill(x0, flow.y, x1 - x0, y - flow.y, "#eef3ee" if american else "#f4eeee")
            write(s, x0 + 4, y - 9, texts, 7.6, 9.2)
            s.put(x1 - 4, y - 9, value, size=7.6, bold=True, align="r")
        flow.room(4)
    s.put(36, 34, word(s, "call"), size=7.6, bold=True, ink=ink)
    foot(s, 36, width - 72, 22)


_DE = Style("de", 0, group=".", point=",", pressure="bar")
_FR = Style("fr", 0, group="\u00a0", point=",")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, imperial=True, pressure="kPa", feet="{}'{}\""),
    "en_us2": Style("en", 0, imperial=True, feet="{} ft {} in"),
    "en_eu": Style("en", 1, group=" "),
    "en_gb": Style("en", 1, pressure="bar"),
    "en_rent": Style("en", 2, imperial=True, feet="{}' {}\""),
    "de": _DE,
    "de_m": replace(_DE, metres=True, group=" "),
    "fr": _FR,
    "fr_bar": replace(_FR, pressure="bar", group=" "),
    "es": Style("es", 0, group=".", point=",", pressure="bar", metres=True),
    "es_la": Style("es", 0, imperial=True, group=" ", pressure="kPa", feet="{}' {}\""),
    "ja": Style("ja", 0),
    "zh": Style("zh", 0, group=""),
}
FRESH9 = Worded(
    "fresh9",
    "DQ",
    {f.__name__: f for f in (peoria, eskilstuna, biberach, moline, sakai, moosburg, depot)},
    STYLES,
    {
        "wheel_loader": "peoria:en_us eskilstuna:en_eu moline:en_us2 biberach:de eskilstuna:fr biberach:fr_bar "
        "depot:en_rent sakai:zh sakai:ja peoria:es_la",
        "excavator": "peoria:en_us eskilstuna:en_eu moline:en_us2 biberach:de biberach:en_gb eskilstuna:fr depot:es "
        "peoria:es_la sakai:ja sakai:zh",
        "articulated_dump_truck": "eskilstuna:en_eu peoria:en_us biberach:de_m eskilstuna:fr",
        "rigid_dump_truck": "peoria:en_us moline:en_us2 sakai:zh peoria:es_la",
        "dozer": "peoria:en_us moline:en_us2 biberach:de sakai:ja sakai:zh",
        "grader": "moline:en_us2 peoria:es_la depot:en_rent eskilstuna:fr",
        "backhoe_loader": "eskilstuna:en_eu depot:en_rent depot:fr_bar moline:es_la",
        "forklift": "moosburg:en_gb moosburg:de moosburg:fr moosburg:ja moosburg:zh peoria:en_us",
        "mobile_crane": "moline:en_us2 biberach:de_m sakai:ja biberach:en_gb sakai:zh",
        "skid_steer": "peoria:en_us eskilstuna:en_eu moline:en_us2 depot:de_m depot:es",
    },
)
