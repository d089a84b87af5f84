"""The set "fresh2": other machines of all ten types, eight other layouts, other wordings; as unseen as "fresh"."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from itertools import pairwise

from reportlab.lib.pagesizes import A4, landscape

from kit.sheets.machines import rounded
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Row, Worded, Wording, parted

_GREEN, _YELLOW, _PALE = "#2f5d3a", "#f2b705", "#efefef"
_NOTE = {
    "en": "Materials and specifications are subject to change without notice. Photos may show optional equipment.",
    "de": "Änderungen vorbehalten. Abbildungen können Sonderausrüstung zeigen.",
    "fr": "Sous réserve de modifications. Les photos peuvent montrer des équipements en option.",
    "es": "Sujeto a cambios sin previo aviso. Las fotos pueden mostrar equipos opcionales.",
    "zh": "规格如有变更，恕不另行通知。",
    "ja": "仕様は予告なく変更することがあります。",
}
_KINDS = {
    "wheel_loader": ("bucket", {
        "en": ("4-in-1", "Sand and gravel", "Side dump"), "de": ("Klappschaufel", "Kiesschaufel", "Seitenkipper"),
        "fr": ("Godet 4-en-1", "Godet sable", "Déversement latéral"),
        "es": ("4 en 1", "Arena y grava", "Descarga lateral"), "zh": ("四合一斗", "砂石斗", "侧卸斗"),
        "ja": ("4in1バケット", "砂利用バケット", "サイドダンプ")}),
    "excavator": ("bucket", {
        "en": ("Heavy duty", "Ditching", "Trenching"), "de": ("Schwerlast", "Grabenräumer", "Schmal"),
        "fr": ("Renforcé", "Curage", "Tranchée"), "es": ("Reforzado", "Limpieza", "Zanjeo"),
        "zh": ("加强斗", "清沟斗", "窄斗"), "ja": ("強化型", "法面用", "溝掘用")}),
    "dozer": ("blade", {"en": ("Semi-U", "Straight", "Angle"), "de": ("Semi-U", "Gerade", "Schwenk")}),
    "forklift": ("mast", {"en": ("Two-stage", "Two-stage full free", "Three-stage"),
                          "zh": ("两级标准", "两级全自由", "三级全自由")}),
}  # fmt: skip
_TYPE = {"en": "Type", "de": "Typ", "fr": "Type", "es": "Tipo", "zh": "型式", "ja": "型式"}


def _title(s: Wording) -> float:
    """A band with the model's name, a note at the foot; the edge below the band."""
    width, height = s.size
    s.fill(0, height - 46, width, 46, _YELLOW)
    s.put(width - 36, height - 30, s.machine.name, size=20, bold=True, align="r")
    s.put(36, 22, s.one_of(_NOTE), size=5.5, ink="#666666")
    return height - 62


def _box(s: Wording, x0: float, x1: float, top: float, bottom: float) -> None:
    s.canvas.setLineWidth(0.4)
    s.canvas.rect(x0, bottom, x1 - x0, top - bottom, stroke=1, fill=0)


def _cell(s: Wording, x0: float, top: float, texts: list[str], size: float = 7, bold: bool = False) -> None:
    for index, text in enumerate(texts):
        s.put(x0 + 3, top - (size + 2) * (index + 1) + 1, text, size=size, bold=bold)


def double(s: Wording) -> None:
    """A full grid of item, unit, value twice over; a section's name is a cell over the whole width."""
    flow = Flow(s, ((36, 560),), _title(s), 40, 800)
    xs = (36.0, 176.0, 216.0, 298.0, 438.0, 478.0, 560.0)
    for section in s.sections():
        rows = s.rows(section)
        if not rows:
            continue
        flow.keep(14 + 20 * min((len(rows) + 1) // 2, 8))
        *_, y = flow.room(14)
        s.fill(36, y - 14, 524, 14, _PALE)
        s.put(298, y - 10, s.section(section), size=8, bold=True, align="c")
        _box(s, 36, 560, y, y - 14)
        for index in range(0, len(rows), 2):
            pair = rows[index : index + 2]
            labels = [s.wrapped(s.joined(row.label), 134, 7) for row in pair]
            height = 9.0 * max(len(texts) for texts in labels) + 4
            *_, y = flow.room(height)
            for row, texts, x in zip(pair, labels, xs[::3], strict=False):
                _cell(s, x, y - 1, texts)
                s.put(x + 160, y - height / 2 - 2.5, row.said.unit, size=7, align="c")
                s.put(x + 221, y - height / 2 - 2.5, row.said.number, size=7, align="c")
            for x0, x1 in pairwise(xs):
                _box(s, x0, x1, y, y - height)


def keyed(s: Wording) -> None:
    """A drawing's letters are told beside it, and their lengths stand in a table headed by the letters alone."""
    y = _title(s)
    skip: set[str] = set()
    for section in [key for key in ("working", "dimensions") if key in s.sections()]:
        rows = [row for row in s.rows(section) if row.said.unit == "mm"]
        skip |= {row.name for row in rows}
        lines = (len(rows) + 1) // 2
        needed = 60 + 11 * lines + 46 * ((len(rows) + 9) // 10)
        if y < 50 + needed:
            s.page()
            y = 800.0
        s.put(36, y - 10, s.section(section), size=11, bold=True, ink=_GREEN)
        y -= 18
        s.canvas.setLineWidth(0.7)
        s.canvas.rect(48, y - 40, 84, 22, stroke=1, fill=0)
        s.canvas.rect(90, y - 18, 26, 16, stroke=1, fill=0)
        s.line(40, y - 44, 146)
        for index, row in enumerate(rows):
            x, top = (160.0 if index < lines else 362.0), y - 11 * (index % lines)
            s.put(x, top - 8, chr(65 + index), size=7, bold=True)
            s.put(x + 14, top - 8, s.joined(row.label), size=7)
        y -= max(11 * lines, 50) + 8
        for start in range(0, len(rows), 10):
            part = rows[start : start + 10]
            high = 28 if any(row.said.imperial for row in part) else 15
            s.fill(36, y - 13, 52 * len(part), 13, _PALE)
            for index, row in enumerate(part):
                x = 62 + 52 * index
                s.put(x, y - 10, chr(65 + start + index), size=7.5, bold=True, align="c")
                s.put(x, y - 24, row.said.metric, size=7, align="c")
                s.put(x, y - 37, row.said.imperial, size=7, align="c")
                _box(s, x - 26, x + 26, y, y - 13)
                _box(s, x - 26, x + 26, y - 13, y - 13 - high)
            y -= 20 + high
        y -= 6
    flow = Flow(s, ((36, 290), (306, 560)), y, 40, 800)
    _colons(s, flow, frozenset(skip))


def _colons(s: Wording, flow: Flow, skip: frozenset[str]) -> None:
    """The other sections: label, colon, and the value at a stop, without rules."""
    for section in s.sections():
        rows = s.rows(section, cylinders="product", skip=skip)
        if not rows:
            continue
        flow.keep(18 + 10.5 * min(len(rows), 9))
        x0, _, y = flow.room(16)
        s.put(x0, y - 10, s.section(section), size=9, bold=True, ink=_GREEN)
        for row in rows:
            texts = s.wrapped(s.joined(row.label) + ":", 138, 7)
            x0, _, y = flow.room(8.5 * len(texts) + 2)
            _cell(s, x0 - 3, y, texts)
            s.put(x0 + 146, y - 8 - 9 * (len(texts) - 1), row.said.both, size=7)
        flow.room(7)


def chosen(s: Wording) -> None:
    """A table whose rows are buckets, blades or masts: one is asked for. The rest: grey cells, white cells."""
    top = _title(s)
    key, kinds = _KINDS[s.machine.kind]
    names = s.one_of(kinds)  # type: ignore[arg-type]
    place = s.dice.randrange(3)
    s.config = names[place]
    rows = [row for row in s.rows(key) if row.name]
    s.put(36, top - 10, s.section(key), size=11, bold=True, ink=_GREEN)
    wide = min(440 / len(rows), 110)
    xs = [120 + wide * index for index in range(len(rows) + 1)]
    heads = [[*s.wrapped(s.joined(row.label), wide - 6, 7), f"({row.said.unit})"] for row in rows]
    y, height = top - 18, 9.0 * max(map(len, heads)) + 4
    s.fill(36, y - height, xs[-1] - 36, height, _PALE)
    s.put(39, y - 9, s.one_of(_TYPE), size=7, bold=True)
    _box(s, 36, 120, y, y - height)
    for x, texts in zip(xs, heads, strict=False):
        _cell(s, x, y, texts)
        _box(s, x, x + wide, y, y - height)
    y -= height
    for index, name in enumerate(names):
        s.put(39, y - 10, name, size=7)
        _box(s, 36, 120, y, y - 14)
        for x, row in zip(xs, rows, strict=False):
            value = rounded(s.machine.kind, row.name, s.machine.values[row.name] * (1 + 0.08 * (index - place)))
            said = row.said if index == place else s.say(row.name, value, note=False)
            s.put(x + wide / 2, y - 10, said.number, size=7, align="c")
            _box(s, x, x + wide, y, y - 14)
        y -= 14
    flow = Flow(s, ((36, 290), (306, 560)), y - 16, 40, 800)
    for section in [one for one in s.sections() if one != key]:
        rows = s.rows(section)
        if not rows:
            continue
        flow.keep(18 + 13 * min(len(rows), 9))
        x0, x1, y = flow.room(16)
        s.put(x0, y - 11, s.section(section), size=9, bold=True, ink=_GREEN)
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 148, 7)
            height = 9.0 * len(texts) + 4
            x0, x1, y = flow.room(height)
            s.fill(x0, y - height, 156, height, _PALE)
            _cell(s, x0, y - 1, texts)
            s.put(x0 + 162, y - height / 2 - 2.5, row.said.both, size=7)
            _box(s, x0, x0 + 156, y, y - height)
            _box(s, x0 + 156, x1, y, y - height)
        flow.room(8)


def split(s: Wording) -> None:
    """Landscape, two blocks of shaded rows; number and unit in columns of their own, metric and imperial."""
    s.paper(landscape(A4))
    flow = Flow(s, ((36, 410), (430, 804)), _title(s), 40, 560)
    for section in s.sections():
        rows = s.rows(section)
        if not rows:
            continue
        flow.keep(18 + 12 * min(len(rows), 9))
        x0, x1, y = flow.room(17)
        s.put(x0, y - 11, s.section(section).upper(), size=8.5, bold=True, ink=_GREEN)
        s.line(x0, y - 15, x1, weight=1.2)
        for index, row in enumerate(rows):
            x0, x1, y = flow.room(12)
            if index % 2 == 0:
                s.fill(x0, y - 12, x1 - x0, 12, _PALE)
            text = s.joined(row.label)
            s.put(x0 + 3, y - 8.5, text, size=7 if s.width(text, 7) < 178 else 6)
            number, unit = parted(row.said.imperial) if row.said.imperial else ("", "")
            for x, cell, align in ((234, row.said.number, "r"), (238, row.said.unit, "l"), (322, number, "r"),
                                   (326, unit, "l")):  # fmt: skip
                s.put(x0 + x, y - 8.5, cell, size=7, align=align)
        flow.room(8)


def headed(s: Wording) -> None:
    """Three narrow columns; a heading ends in the unit of most figures below it: "Sizes   mm (ft-in)"."""
    flow = Flow(s, ((36, 200), (216, 380), (396, 560)), _title(s), 40, 800)

    def units(row: Row) -> str:
        imperial = parted(row.said.imperial)[1].replace("ft in", "ft-in") if row.said.imperial else ""
        return f"{row.said.unit} ({imperial})" if imperial else row.said.unit

    for section in s.sections():
        rows = s.rows(section)
        if not rows:
            continue
        unit, count = Counter(units(row) for row in rows).most_common(1)[0]
        if count < 2 or any(row.name and not row.said.unit for row in rows):
            unit = ""
        flow.keep(18 + 11 * min(len(rows), 10))
        x0, x1, y = flow.room(16)
        s.put(x0, y - 10, s.section(section), size=7.5, bold=True)
        s.put(x1, y - 10, unit, size=7, align="r", ink=_GREEN)
        s.line(x0, y - 13, x1, weight=0.8)
        for row in rows:
            value = row.said.both
            if unit and units(row) == unit:
                value = row.said.number + (f" ({parted(row.said.imperial)[0]})" if row.said.imperial else "")
            texts = s.wrapped(s.joined(row.label), x1 - x0 - s.width(value, 6.8) - 10, 6.8)
            x0, x1, y = flow.room(8.6 * len(texts) + 2)
            for index, text in enumerate(texts):
                s.put(x0, y - 7.5 - 8.6 * index, text, size=6.8)
            s.put(x1, y - 7.5 - 8.6 * (len(texts) - 1), value, size=6.8, align="r")
        flow.room(7)


def boxed(s: Wording) -> None:
    """Two ruled columns: a section's name at the left, and at the right its lines of text, "label: value"."""
    flow = Flow(s, ((36, 560),), _title(s), 40, 800)
    for section in s.sections():
        rows = s.rows(section, cylinders="product")
        if not rows:
            continue
        half = (len(rows) + 1) // 2
        blocks = [[f"{s.joined(r.label)}: {r.said.both.replace(' ', '_')}" for r in part]
                  for part in (rows[:half], rows[half:])]  # fmt: skip
        cells = [[line.replace("_", " ") for text in block for line in s.wrapped(text, 204, 7)] for block in blocks]
        head = s.wrapped(s.section(section), 84, 8)
        height = max(10.0 * max(map(len, cells)) + 8, 10.0 * len(head) + 8)
        *_, y = flow.room(height)
        s.fill(36, y - height, 94, height, _PALE)
        _cell(s, 37, y - 3, head, 8, bold=True)
        for cell, x in zip(cells, (136.0, 350.0), strict=True):
            for index, text in enumerate(cell):
                s.put(x, y - 11 - 10 * index, text, size=7)
        _box(s, 36, 130, y, y - height)
        _box(s, 130, 560, y, y - height)


def fold(s: Wording) -> None:
    """A folded sheet: landscape, four narrow columns; a label, and below it leader dots to the value at the right."""
    s.paper(landscape(A4))
    flow = Flow(s, tuple((36 + 196 * i, 212 + 196 * i) for i in range(4)), _title(s), 40, 560)
    for section in s.sections():
        rows = s.rows(section)
        if not rows:
            continue
        flow.keep(22 + 19 * min(len(rows), 6))
        x0, x1, y = flow.room(17)
        s.put(x0, y - 11, s.section(section).upper(), size=8, bold=True)
        s.line(x0, y - 14, x1, weight=1)
        for row in rows:
            x0, x1, y = flow.room(19)
            s.put(x0, y - 7, s.joined(row.label), size=6.8)
            width = s.put(x1, y - 15.5, row.said.both, size=6.8, align="r")
            s.put(x1 - width - 2, y - 15.5, "." * int((x1 - x0 - width - 2) / s.width(".", 6.8)), size=6.8, align="r")
        flow.room(8)


def duo(s: Wording) -> None:
    """Two models side by side, each metric and US under a two-storeyed head; else one column each, the unit last."""
    top = _title(s)
    both = s.style.imperial
    place = s.dice.randrange(2)
    letters, _, digits = s.machine.name.rpartition(" ")
    names = [s.machine.name if i == place else f"{letters} {int(digits) + 15 * (i - place)} XL" for i in range(2)]
    s.config = s.machine.name
    stops = ((330.0, 390.0), (460.0, 520.0)) if both else ((360.0, 360.0), (450.0, 450.0))

    def head(y: float) -> None:
        s.fill(36, y - (26 if both else 15), 524, 26 if both else 15, _GREEN)
        for name, (a, b) in zip(names, stops, strict=True):
            s.put((a + b) / 2, y - 10, name, size=8.5, bold=True, align="c", ink="#ffffff")
            if both:
                s.put(a, y - 21, "Metric", size=7, align="c", ink="#ffffff")
                s.put(b, y - 21, "US", size=7, align="c", ink="#ffffff")

    head(top)
    flow = Flow(s, ((36, 560),), top - 30, 40, 770)
    page = 0
    for section in s.sections():
        rows = [row for row in s.rows(section) if section != "tyres"]
        for index, row in enumerate(rows):
            if index == 0:
                flow.keep(18 + 12.5 * min(len(rows), 8))
            *_, y = flow.room(12.5 + (16 if index == 0 else 0))
            if flow.place != page:
                page = flow.place
                head(800)
            if index == 0:
                s.put(36, y - 11, s.section(section), size=9, bold=True, ink=_GREEN)
                y -= 16
            s.put(36, y - 9, s.joined(row.label), size=7.3)
            for i, (a, b) in enumerate(stops):
                value = s.machine.values.get(row.name, 0.0) * (1 + 0.11 * (i - place))
                same = i == place or not row.name or row.said.unit in ("°", "bar", "MPa", "kPa", "")
                said = row.said if same else s.say(row.name, rounded(s.machine.kind, row.name, value), note=False)
                s.put(a, y - 9, said.metric if both else said.number, size=7.3, align="c")
                s.put(b, y - 9, said.imperial if both else "", size=7.3, align="c")
            s.put(556, y - 9, "" if both else row.said.unit, size=7.3, align="r")
            s.line(36, y - 12.5, 560, weight=0.2)
        flow.room(6 if rows else 0)


_DE = Style("de", 0, group=" ", point=",", pressure="bar")
STYLES = {
    "en_us": Style("en", 0, imperial=True, feet="{} ft {} in"),
    "en_usb": Style("en", 0, imperial=True, pressure="kPa", feet="{} ft {} in"),
    "en_usm": Style("en", 0, metres=True, imperial=True, pressure="bar"),
    "en_uk": Style("en", 1, imperial=True, pressure="bar", feet="{}-{}"),
    "en_gb": Style("en", 1, group="", pressure="bar"),
    "en_gbm": Style("en", 1, metres=True, pressure="bar", tonnes=True),
    "de": _DE,
    "de_m": replace(_DE, group=".", metres=True),
    "fr": Style("fr", 0, group=" ", point=",", metres=True, pressure="bar"),
    "fr_mm": Style("fr", 0, group=" ", point=",", pressure="bar", tonnes=True),
    "es": Style("es", 0, pressure="kPa"),
    "zh": Style("zh", 0),
    "zh_m": Style("zh", 0, group="", metres=True, tonnes=True),
    "ja": Style("ja", 0),
    "ja_m": Style("ja", 0, metres=True),
}
FRESH2 = Worded(
    "fresh2",
    "R",
    {f.__name__: f for f in (double, keyed, chosen, split, headed, boxed, fold, duo)},
    STYLES,
    {
        "wheel_loader": "split:en_us headed:en_uk fold:en_usb duo:en_usm boxed:en_gbm keyed:en_us chosen:en_gb "
        "double:zh keyed:de fold:ja headed:fr boxed:es chosen:de_m duo:zh_m",
        "excavator": "fold:en_us chosen:en_usb keyed:en_gb split:en_usm headed:en_uk duo:en_gbm boxed:en_us "
        "double:ja headed:de chosen:es boxed:fr keyed:zh fold:de_m duo:ja_m",
        "articulated_dump_truck": "split:en_us fold:en_gb duo:fr_mm",
        "rigid_dump_truck": "boxed:en_usb keyed:en_gb headed:de",
        "dozer": "chosen:en_us headed:en_uk fold:de",
        "grader": "split:en_usb duo:en_gb double:ja",
        "backhoe_loader": "headed:en_uk boxed:en_us fold:es",
        "forklift": "chosen:en_gb split:en_us double:zh",
        "mobile_crane": "boxed:en_usm duo:en_gb double:zh_m",
        "skid_steer": "fold:en_us keyed:en_gb headed:ja",
    },
)
