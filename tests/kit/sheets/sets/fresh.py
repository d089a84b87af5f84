"""The set "fresh": machines of all ten types, eight layouts as brochures have them, wordings of its own.

Written in ignorance of the rules and of the templates' words, when the four older sets had been mended for.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby

from reportlab.lib.pagesizes import A4, landscape

from kit.sheets.machines import rounded
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Row, Said, Worded, Wording, parted

_DARK, _BLUE, _GREY = "#262626", "#1f4e79", "#e9e9e9"
_SUBTITLE = {"en": "Technical specifications", "de": "Technische Daten", "fr": "Fiche technique",
             "es": "Ficha técnica", "zh": "技术规格", "ja": "主要諸元"}  # fmt: skip
_STANDARD = {"en": ("Standard", "Optional"), "de": ("Serie", "Option"), "fr": ("Standard", "Option"),
             "es": ("Estándar", "Opcional"), "zh": ("标配", "选配"), "ja": ("標準", "オプション")}  # fmt: skip
_HEADS = {"en": "Item", "de": "Bezeichnung", "fr": "Désignation", "es": "Concepto", "zh": "项目", "ja": "項目"}
_UNIT = {"en": "Unit", "de": "Einheit", "fr": "Unité", "es": "Unidad", "zh": "单位", "ja": "単位"}


def _title(s: Wording) -> None:
    s.put(36, s.size[1] - 40, s.machine.name, size=17, bold=True)
    s.put(36, s.size[1] - 52, s.one_of(_SUBTITLE), size=8, ink="#666666")


def brochure(s: Wording) -> None:
    """Landscape, three columns of small type under coloured bars; leader dots to values at the right."""
    s.paper(landscape(A4))
    _title(s)
    flow = Flow(s, ((36, 278), (298, 540), (560, 802)), 525, 60, 555)
    for section in s.sections():
        rows = s.rows(section, cylinders="product")
        if not rows:
            continue
        flow.keep(16 + 11 * min(len(rows), 12))
        x0, x1, y = flow.room(16)
        s.fill(x0, y - 11, x1 - x0, 11, _BLUE)
        s.put(x0 + 3, y - 8.5, s.section(section), size=7.5, bold=True, ink="#ffffff")
        for row in rows:
            width = s.width(row.said.both, 6.5)
            texts = s.wrapped(s.joined(row.label), x1 - x0 - width - 14, 6.5)
            x0, x1, y = flow.room(8.5 * len(texts) + 2.5)
            for text in texts:
                y -= 8.5
                start = x0 + s.put(x0, y + 2, text, size=6.5) + 2
            s.put(x1, y + 2, row.said.both, size=6.5, align="r")
            dots = int((x1 - width - 2 - start) / s.width(".", 6.5))
            s.put(x1 - width - 2, y + 2, "." * max(dots, 0), size=6.5, align="r", ink="#888888")
        flow.room(7)


def between(s: Wording) -> None:
    """Two columns; the units of both systems stand between label and value: "mm (in)", "2 850 (112.2)"."""
    _title(s)
    flow = Flow(s, ((36, 290), (306, 560)), 775, 45, 800)
    for section in s.sections():
        rows = s.rows(section)
        if not rows:
            continue
        flow.keep(20 + 12 * min(len(rows), 10))
        x0, x1, y = flow.room(18)
        s.put(x0, y - 10, s.section(section), size=10, bold=True, ink=_BLUE)
        s.line(x0, y - 14, x1, weight=1)
        for row in rows:
            number, unit = parted(row.said.imperial) if row.said.imperial else ("", "")
            value = f"{row.said.number} ({number})" if number else row.said.number
            texts = s.wrapped(s.joined(row.label), 128, 7)
            x0, x1, y = flow.room(9 * len(texts) + 3)
            for index, text in enumerate(texts):
                s.put(x0, y - 8 - 9 * index, text, size=7)
            last = y - 8 - 9 * (len(texts) - 1)
            s.put(x0 + 134, last, f"{row.said.unit} ({unit})" if unit else row.said.unit, size=7, ink="#555555")
            s.put(x1, last, value, size=7, align="r")
            s.line(x0, last - 3, x1, weight=0.2)
        flow.room(10)


def nested(s: Wording) -> None:
    """A full grid whose groups are cells over their rows: "relief pressure" left of "travel" and "swing"."""
    _title(s)
    both = s.style.imperial
    xs = (36.0, 190.0, 330.0, 400.0, 480.0, 560.0) if both else (36.0, 210.0, 390.0, 460.0, 560.0)
    flow = Flow(s, ((36, 560),), 778, 45, 800)
    for section in s.sections():
        rows = s.rows(section)
        if not rows:
            continue
        flow.keep(34 + 15 * min(len(rows), 12))
        *_, y = flow.room(15)
        s.fill(36, y - 15, 524, 15, "#d5dde5")
        s.put(298, y - 11, s.section(section), size=8.5, bold=True, align="c")
        _frame(s, xs[:1] + xs[-1:], y, y - 15)
        for group, own in groupby(rows, lambda r: r.label.partition(" > ")[0]):
            _nest(s, flow, xs, group, list(own))
        flow.room(9)


def _nest(s: Wording, flow: Flow, xs: tuple[float, ...], group: str, own: list[Row]) -> None:
    """A group's rows, or one that has no group, whose label spans both columns."""
    labels = [s.wrapped(row.label.partition(" > ")[2], xs[2] - xs[1] - 6, 7.5) for row in own]
    alone = labels == [[""]]
    heads = s.wrapped(group, (xs[2] if alone else xs[1]) - xs[0] - 6, 7.5)
    heights = [max(10.0 * len(texts) + 4, (10.0 * len(heads) + 4) / len(own)) for texts in labels]
    *_, top = flow.room(sum(heights))
    for index, text in enumerate(heads):
        s.put(xs[0] + 3, top - sum(heights) / 2 + 5 * len(heads) - 7.5 - 10 * index, text, size=7.5)
    y = top
    for row, texts, height in zip(own, labels, heights, strict=True):
        for index, text in enumerate(texts):
            s.put(xs[1] + 3, y - height / 2 + 5 * len(texts) - 7.5 - 10 * index, text, size=7.5)
        for x0, x1, text in zip(xs[2:], xs[3:], (row.said.unit, row.said.number, row.said.imperial), strict=False):
            s.put((x0 + x1) / 2, y - height / 2 - 2.5, text, size=7.5, align="c")
        _frame(s, xs[2:] if alone else xs[1:], y, y - height)
        y -= height
    _frame(s, (xs[0], xs[2] if alone else xs[1]), top, y)


def _frame(s: Wording, xs: tuple[float, ...], top: float, bottom: float) -> None:
    """Rules about the cells of a row."""
    s.line(xs[0], top, xs[-1])
    s.line(xs[0], bottom, xs[-1])
    for x in xs:
        s.line(x, top, x, y1=bottom)


def vdi(s: Wording) -> None:
    """A numbered sheet, as of lift trucks: sections' names turned; number, item, symbol, unit, value."""
    _title(s)
    xs = (36.0, 56.0, 84.0, 330.0, 365.0, 425.0, 560.0)
    flow = Flow(s, ((36, 560),), 778, 45, 800)
    used: dict[str, int] = {}
    number = 0
    for section in s.sections():
        rows = s.rows(section)
        heading = s.wrapped(s.section(section), s.width(s.section(section), 6, True) * 0.62, 6)
        number += bool(rows)
        done = 0
        while rows:
            high = max(12.0, (max(s.width(text, 6, True) for text in heading) + 6) / len(rows))
            if flow.y - high * min(len(rows), 9) < flow.bottom:
                flow.keep(400)
            fits = max(int((flow.y - flow.bottom) / high), 1)
            part, rows = rows[:fits], rows[fits:]
            *_, top = flow.room(high * len(part))
            for index, row in enumerate(part):
                y = top - high * index
                symbol = ""
                if row.said.unit in ("mm", "m") and row.name:
                    letter = s.dice.choice("bhlsrm")
                    used[letter] = used.get(letter, 0) + 1
                    symbol = f"{letter}{used[letter]}"
                text = s.joined(row.label)
                size = 7.5 if s.width(text, 7.5) < xs[3] - xs[2] - 6 else 6
                s.put(xs[1] + 3, y - 9, f"{number}.{done + index + 1}", size=6.5)
                s.put(xs[2] + 3, y - 9, text, size=size)
                s.put((xs[3] + xs[4]) / 2, y - 9, symbol, size=7, align="c")
                s.put((xs[4] + xs[5]) / 2, y - 9, row.said.unit, size=7, align="c")
                s.put((xs[5] + xs[6]) / 2, y - 9, row.said.number, size=7.5, align="c")
                _frame(s, xs[1:], y, y - high)
            done += len(part)
            bottom = top - high * len(part)
            _frame(s, xs[:2], top, bottom)
            s.canvas.saveState()
            s.canvas.translate(51.5 - 3.5 * len(heading), (top + bottom) / 2)
            s.canvas.rotate(90)
            for index, text in enumerate(heading):
                s.put(0, -7 * index, text, size=6, bold=True, align="c")
            s.canvas.restoreState()


def options(s: Wording) -> None:
    """Columns for what is standard and what may be ordered; the standard machine is asked for."""
    _title(s)
    standard, option = s.one_of(_STANDARD)  # type: ignore[misc]
    s.config = standard
    flow = Flow(s, ((36, 560),), 775, 45, 800)
    for section in s.sections():
        rows = [] if section == "tyres" else s.rows(section)
        if not rows:
            continue
        flow.keep(32 + 13 * min(len(rows), 12))
        *_, y = flow.room(16)
        s.fill(36, y - 14, 524, 14, _DARK)
        for x, text, align in ((40, s.section(section), "l"), (350, s.one_of(_UNIT), "c"), (440, standard, "r")):
            s.put(x, y - 10, text, size=8, bold=True, align=align, ink="#ffffff")
        s.put(552, y - 10, option, size=8, bold=True, align="r", ink="#ffffff")
        for index, row in enumerate(rows):
            *_, y = flow.room(13)
            if index % 2:
                s.fill(36, y - 13, 524, 13, "#f1f1f1")
            s.put(40, y - 9, s.joined(row.label), size=7.5)
            s.put(350, y - 9, row.said.unit, size=7.5, align="c")
            s.put(440, y - 9, row.said.number, size=7.5, align="r")
            other = "–"
            sized = row.name and row.said.unit in ("mm", "m", "kg", "t", "m³") and section != "cylinders"
            if sized and s.dice.random() < 0.3:
                value = rounded(s.machine.kind, row.name, s.machine.values[row.name] * s.dice.choice((0.94, 1.07)))
                other = s.say(row.name, value, note=False).number
            s.put(552, y - 9, other, size=7.5, align="r")
        s.line(36, flow.y, 560, weight=0.6)
        flow.room(8)


def family(s: Wording) -> None:
    """Three models of a family as columns under one dark head, hairlines; what holds for all is said once, over all."""
    _title(s)
    place = s.dice.randrange(3)
    letters, _, digits = s.machine.name.rpartition(" ")
    names = [f"{letters} {int(digits) + 11 * (i - place)}" for i in range(3)]
    s.config = s.machine.name
    step = {i: 1 + 0.09 * (i - place) for i in range(3)}
    xs = (330.0, 420.0, 510.0)

    def head(y: float) -> None:
        s.fill(36, y - 16, 524, 16, _DARK)
        s.put(40, y - 11, s.one_of(_HEADS), size=8, ink="#ffffff")
        for x, name in zip(xs, names, strict=True):
            s.put(x, y - 11, name, size=8.5, bold=True, align="c", ink="#ffffff")

    head(775)
    flow = Flow(s, ((36, 560),), 755, 45, 780)
    for section in s.sections():
        rows = [] if section in ("tyres", "cab") else s.rows(section)
        if not rows:
            continue
        if flow.keep(20 + 13 * min(len(rows), 8)):
            head(800)
        *_, y = flow.room(17)
        s.put(36, y - 12, s.section(section), size=9, bold=True)
        s.line(36, y - 16, 560, weight=0.8)
        for row in rows:
            before = flow.place
            *_, y = flow.room(13)
            if flow.place != before:
                head(800)
            unit = f" ({row.said.unit})" if row.said.unit else ""
            s.put(36, y - 9.5, s.joined(row.label) + unit, size=7.5)
            common = not row.name or row.said.unit in ("°", "bar", "MPa", "kPa", "")
            for x in (285.0, 560.0) if common else (285.0, 375.0, 465.0, 560.0):
                s.line(x, y, x, y1=y - 13, weight=0.2)
            if common:
                s.put(xs[1], y - 9.5, row.said.number, size=7.5, align="c")
            else:
                for i, x in enumerate(xs):
                    value = rounded(s.machine.kind, row.name, s.machine.values[row.name] * step[i])
                    said = row.said if i == place else s.say(row.name, value, note=False)
                    s.put(x, y - 9.5, said.number, size=7.5, align="c")
            s.line(36, y - 13, 560, weight=0.2)
        flow.room(6)


def twin(s: Wording) -> None:
    """Two tables side by side, headed by dark bars with the systems' names; raised marks, notes at the page's foot."""
    _title(s)
    flow = Flow(s, ((36, 292), (306, 562)), 775, 62, 800)
    page = -1
    for section in s.sections():
        rows = s.rows(section)
        if not rows:
            continue
        flow.keep(24 + 11 * min(len(rows), 10))
        x0, x1, y = flow.room(16)
        if flow.place // 2 != page:
            page = flow.place // 2
            s.put(36, 48, "* ISO 6016 / ISO 14397    1) SAE J732    2) ISO 7131", size=5.5)
        s.fill(x0, y - 13, x1 - x0, 13, _DARK)
        s.put(x0 + 3, y - 9.5, s.section(section), size=7.5, bold=True, ink="#ffffff")
        if s.style.imperial:
            s.put(x1 - 66, y - 9.5, "Metric", size=6.5, align="r", ink="#ffffff")
            s.put(x1 - 3, y - 9.5, "US", size=6.5, align="r", ink="#ffffff")
        for index, row in enumerate(rows):
            texts = s.wrapped(s.joined(row.label), 118 if s.style.imperial else 185, 6.8)
            x0, x1, y = flow.room(8.5 * len(texts) + 3)
            for n, text in enumerate(texts):
                end = x0 + 2 + s.put(x0 + 2, y - 8 - 8.5 * n, text, size=6.8)
            last = y - 8 - 8.5 * (len(texts) - 1)
            if row.name and index % 4 == 1:
                s.put(end + 0.5, last + 2.6, s.dice.choice(("*", "1)", "2)")), size=4.2)
            s.put(x1 - (66 if s.style.imperial else 3), last, row.said.metric, size=6.8, align="r")
            s.put(x1 - 3, last, row.said.imperial, size=6.8, align="r")
            s.line(x0, last - 3, x1, weight=0.25)
        flow.room(9)


def drawing(s: Wording) -> None:
    """An outline with ringed letters; below it what they are. The rest: headings in the margin, rows beside them."""
    _title(s)
    drawn = {
        key: own
        for key in ("dimensions", "working")
        if (own := [r for r in s.rows(key) if r.said.unit in ("mm", "m")]) and key in s.sections()
    }
    y = s.size[1] - 70
    for key, rows in drawn.items():
        y = _outline(s, key, rows, y)
    flow = Flow(s, ((36, 560),), y - 12, 45, 800)
    skip = frozenset(row.name for rows in drawn.values() for row in rows)
    for section in s.sections():
        rows = s.rows(section, cylinders="product", skip=skip)
        if not rows:
            continue
        flow.keep(12.0 * min(len(rows), 14) + 6)
        s.line(36, flow.y, 560, weight=0.8)
        head = s.wrapped(s.section(section), 110, 8.5)
        top = flow.y
        for index, row in enumerate(rows):
            *_, y = flow.room(12)
            if y > top:
                s.line(36, y, 560, weight=0.8)
            if index == 0:
                for n, text in enumerate(head):
                    s.put(36, y - 9 - 10 * n, text, size=8.5, bold=True)
            s.put(160, y - 9, s.joined(row.label), size=7.5)
            s.put(558, y - 9, row.said.both, size=7.5, align="r")
        flow.room(max(8.0, 10.0 * len(head) - 12 * len(rows) + 4))


def _outline(s: Wording, section: str, rows: list[Row], y: float) -> float:
    """A drawing with its letters and the table of them; the edge below."""
    if y < 190 + 12 * len(rows):
        s.page()
        y = s.size[1] - 40
    s.put(36, y - 10, s.section(section), size=10, bold=True)
    y -= 18
    s.canvas.setLineWidth(0.8)
    s.canvas.rect(150, y - 95, 260, 45, stroke=1, fill=0)
    s.canvas.rect(270, y - 50, 70, 36, stroke=1, fill=0)
    s.canvas.circle(200, y - 100, 22, stroke=1, fill=0)
    s.canvas.circle(360, y - 100, 22, stroke=1, fill=0)
    s.line(100, y - 122, 460, weight=0.5)
    keys = [chr(65 + i) if i < 26 else f"A{chr(39 + i)}" for i in range(len(rows))]
    for index, key in enumerate(keys):
        s.ring(70 + 455 * ((index * 7) % len(keys)) / len(keys), y - 12 - 100 * ((index * 5) % 7) / 6, key, 6)
    y -= 132
    plain = all(r.said.unit == "mm" for r in rows)
    if plain:
        s.put(470, y - 6, "mm", size=7.5, bold=True, align="r")
        y -= 9
    for key, row in zip(keys, rows, strict=True):
        said = Said(row.said.number, "", row.said.imperial) if plain else row.said
        s.ring(44, y - 7, key, 6)
        s.put(60, y - 9, s.joined(row.label), size=7.5)
        s.put(470, y - 9, said.metric, size=7.5, align="r")
        s.put(558, y - 9, said.imperial, size=7.5, align="r")
        s.line(36, y - 12, 560, weight=0.2)
        y -= 12
    return y - 10


_DE = Style("de", 0, group=".", point=",", pressure="bar")
STYLES = {
    "en_us": Style("en", 0, imperial=True, pressure="kPa"),
    "en_usm": Style("en", 0, metres=True, imperial=True),
    "en_uk": Style("en", 1, pressure="bar"),
    "en_ukm": Style("en", 1, metres=True, group=" ", pressure="bar", tonnes=True),
    "en_gb": Style("en", 1, imperial=True, pressure="bar"),
    "de": _DE,
    "de_t": replace(_DE, group=" ", tonnes=True),
    "fr": Style("fr", 0, group=" ", point=",", pressure="bar"),
    "es": Style("es", 0, group=".", point=",", metres=True),
    "zh": Style("zh", 0, group=""),
    "ja": Style("ja", 0),
}
FRESH = Worded(
    "fresh",
    "T",
    {f.__name__: f for f in (brochure, between, nested, vdi, options, family, twin, drawing)},
    STYLES,
    {
        "wheel_loader": "brochure:en_us between:en_gb nested:ja family:en_uk twin:en_usm drawing:de options:en_ukm "
        "brochure:fr between:es nested:zh twin:de_t family:fr drawing:en_us options:ja vdi:zh",
        "excavator": "brochure:en_usm between:en_us nested:en_uk family:de twin:en_us drawing:en_ukm options:en_gb "
        "brochure:ja between:de_t nested:fr twin:es family:zh drawing:ja options:fr vdi:es",
        "articulated_dump_truck": "twin:en_us drawing:en_uk brochure:de",
        "rigid_dump_truck": "between:en_us family:en_ukm nested:zh",
        "dozer": "options:en_usm brochure:en_gb twin:zh",
        "grader": "drawing:en_us nested:en_uk between:es",
        "backhoe_loader": "twin:en_usm brochure:en_uk nested:fr",
        "forklift": "between:en_us vdi:en_uk vdi:ja",
        "mobile_crane": "nested:en_us drawing:en_uk between:de",
        "skid_steer": "brochure:en_us family:en_gb twin:fr",
    },
)
