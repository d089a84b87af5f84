"""The set "fresh7": machines of all ten types in seven layouts, after pages of European and American makers.

Dotted leaders in three columns, both systems of units; labels over values beside tables with their unit in the heading;
sentences under bars; an industrial truck's type sheet; a product page with tiles and models; a data sheet with the
drawing's marks and a column for each system; boxes with a column for each arm or bucket.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace

from kit.sheets.machines import rounded
from kit.sheets.sets.fresh7_rows import (
    FIXED,
    GREY,
    LEVEL,
    begin,
    blocks_of,
    choices,
    level_of,
    local,
    mark_of,
    note,
    ranges,
    rows_of,
    siblings,
    stepped,
    text_of,
    word,
)
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Row, Said, Worded, Wording, lines

_INK, _PALE = "#202020", "#f1f1ee"
_RED, _NAVY, _OCHRE, _GREEN = "#b0171f", "#1d2f4f", "#d99a00", "#3f6b35"
_KEYS = ("Operating Weight", "Net Power", "Bucket Capacity Heaped", "Bucket Capacity", "Maximum Digging Depth",
         "Rated Operating Capacity", "Dumping Clearance", "Blade Capacity", "Loader Lift Capacity",
         "Moldboard Length", "Overall Width")  # fmt: skip
_BY_ARM = ("arm", "forces", "working")


# ---- layouts ---------------------------------------------------------------------------------------------------------
def _picture(s: Wording, x: float, y: float, width: float, letters: list[str]) -> None:
    """A pale picture of a machine over the ground with dimension lines and their letters."""
    s.fill(x, y, width, 104, _PALE)
    s.canvas.setStrokeColorRGB(0.45, 0.45, 0.45)
    s.line(x, y + 34, x + width, weight=0.5)
    for share in (0.36, 0.58):
        s.canvas.circle(x + share * width, y + 48, 14, stroke=1, fill=0)
    s.canvas.roundRect(x + 0.32 * width, y + 58, 0.3 * width, 20, 4)
    s.canvas.rect(x + 0.42 * width, y + 78, 0.08 * width, 18)
    half = (len(letters) + 1) // 2
    for index, letter in enumerate(letters[:half]):  # lengths below the ground
        left, level = x + 8 + (width - 16) * (index % 7) / 7, y + 25 - 12 * (index // 7)
        s.line(left, level, left + width / 7 - 8, weight=0.3)
        s.fill(left + width / 14 - 9, level - 4, 10, 8, _PALE)
        s.put(left + width / 14 - 4, level - 2.3, letter, size=6.6, bold=True, align="c")
    for index, letter in enumerate(letters[half:]):  # heights beside the machine
        at = x + 10 + 14 * index if index < 11 else x + width - 10 - 14 * (index - 11)
        top = y + 52 + 9 * (index * 2 % 5)
        s.line(at, y + 34, at, y1=top, weight=0.3)
        s.put(at, top + 2, letter, size=6.6, bold=True, align="c")


def casenh(s: Wording) -> None:
    """Three columns of a folded sheet: capital headings, dotted leaders, the country's own units first."""
    begin(s)
    s.paper((612, 792))
    s.fill(0, 742, 612, 50, _INK)
    s.put(36, 758, s.machine.name, size=22, bold=True, ink="#ffffff")
    s.put(576, 760, word(s, "data").upper(), size=11, bold=True, align="r", ink=_OCHRE)
    blocks = blocks_of(s, rams="rows")
    letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    shown = next((rows for one, rows in blocks if one in ("working", "dimensions")), [])[:26]
    marks = {id(row): letter for row, letter in zip(shown, letters, strict=False)}
    _picture(s, 36, 628, 540, list(marks.values()))
    own = s.style.imperial and s.style.language == "en"
    columns = tuple((36 + 185.0 * i, 36 + 185.0 * i + 170) for i in range(3))
    flow = Flow(s, columns, 618, level_of(blocks, 618, 3, 11.5, 20), 752)
    for section, rows in blocks:
        flow.keep(48)
        x0, x1, y = flow.room(17)
        s.line(x0, y - 2, x1, weight=1.4)
        s.put(x0, y - 11.5, s.section(section).upper(), size=8, bold=True)
        for row in rows:
            said = row.said
            if own:  # metric numbers are grouped by spaces, American ones by commas
                said = replace(said, number=re.sub(r"(?<=\d),(?=\d{3})", " ", said.number))
                s.printed.update({row.name: said.number} if row.name in s.printed and " x " not in said.number else {})
            value = text_of(s, replace(row, said=said), at=not own)
            if own and said.imperial:
                value = f"{said.imperial} ({said.metric})"
            label = (f"{marks[id(row)]}. " if id(row) in marks else "") + s.joined(row.label)
            beside = s.width(value, 6.7) < 104
            texts = s.wrapped(label, 164 - (s.width(value, 6.7) if beside else 0), 6.7)
            x0, x1, y = flow.room(8.2 * (len(texts) + (not beside)) + 1.6)
            for index, text in enumerate(texts):
                s.put(x0 + (8 if index else 0), y - 7.4 - 8.2 * index, text, size=6.7)
            base = y - 7.4 - 8.2 * (len(texts) - beside)
            used = s.width(texts[-1], 6.7) + (8 if len(texts) > 1 else 0) if beside else 8
            dots = int((x1 - x0 - used - s.width(value, 6.7) - 3) / s.width(".", 6.7))
            s.put(x1 - s.width(value, 6.7) - 1.5, base, "." * max(dots, 0), size=6.7, align="r")
            s.put(x1, base, value, size=6.7, align="r")
        flow.room(6)
    note(s, 36, 540)


def bell(s: Wording) -> None:
    """Four narrow columns: bold labels over their values; masses and dimensions in tables, masses' unit in the head."""
    begin(s)
    s.put(40, 792, word(s, "data"), size=19, bold=True, ink=_RED)
    s.put(555, 792, s.machine.name, size=13, bold=True, align="r")
    s.line(40, 784, 555, weight=0.6)
    blocks = blocks_of(s, rams="product")
    columns = tuple((40 + 131.5 * i, 40 + 131.5 * i + 120) for i in range(4))
    flow = Flow(s, columns, 774, level_of(blocks, 774, 4, 18, 24), 796)
    for section, rows in blocks:
        table = section in ("weights", "dimensions", "working", "service")
        units = [(row.said.unit, row.said.imperial.rpartition(" ")[2]) for row in rows]
        unit = units[0] if table and len(set(units)) == 1 and units[0][0] == "kg" and len(rows) > 1 else ("", "")
        flow.keep(54)
        x0, x1, y = flow.room(21)
        s.put(x0, y - 10, s.section(section).upper(), size=7.8, bold=True, ink=_RED)
        s.line(x0, y - 13.5, x1, weight=0.8)
        if unit[0]:
            x0, x1, y = flow.room(8)
            head = f"{unit[0]} ({unit[1].rstrip('.')})" if unit[1] else unit[0]
            s.put(x1, y - 5, head, size=6.5, bold=True, align="r")
        for row in rows:
            value = text_of(s, row)
            if unit[0]:
                value = row.said.number + (f" ({row.said.imperial.rpartition(' ')[0]})" if unit[1] else "")
            value = value.replace("lb.", "lb").replace("in.", "in")
            if table:
                texts = s.wrapped(s.joined(row.label), 116 - s.width(value, 6.5), 6.5)
                below = s.width(value, 6.5) > 76
                texts = s.wrapped(s.joined(row.label), 118, 6.5) if below else texts
                x0, x1, y = flow.room(7.9 * (len(texts) + below) + 3.4)
                for index, text in enumerate(texts):
                    s.put(x0, y - 7.2 - 7.9 * index, text, size=6.5)
                s.put(x1, y - 7.2 - 7.9 * (len(texts) if below else 0), value, size=6.5, align="r")
                s.line(x0, y - 7.9 * (len(texts) + below) - 2, x1, weight=0.2)
                continue
            texts = s.wrapped(s.joined(row.label), 112, 6.6)  # set in bold
            values = s.wrapped(value, 118, 6.6)
            x0, _, y = flow.room(8 * (len(texts) + len(values)) + 4)
            for index, text in enumerate([*texts, *values]):
                s.put(x0, y - 7.2 - 8 * index, text, size=6.6, bold=index < len(texts))
        flow.room(7)
    note(s, 40, 515)


def grove(s: Wording) -> None:
    """Pale bars over two columns of text: systems in running sentences, measures in lines with leaders."""
    begin(s)
    s.put(48, 790, s.machine.name.upper(), size=24, bold=True, ink=_NAVY)
    s.put(48, 774, word(s, "data"), size=10, ink=GREY)
    blocks = [(one, ranges(s, rows)) for one, rows in blocks_of(s, rams="product")]
    colon = {"zh": "：", "ja": "："}.get(s.style.language, ":")
    stop = "。" if colon == "：" else ". "
    flow = Flow(s, ((48, 288), (308, 548)), 756, level_of(blocks, 756, 2, 12, 24), 790)
    for section, rows in blocks:
        flow.keep(50)
        x0, x1, y = flow.room(19)
        s.fill(x0, y - 14, x1 - x0, 14, "#dfe4ec")
        s.fill(x0, y - 14, 14, 14, _NAVY)
        s.put(x0 + 19, y - 10.2, s.section(section), size=8.4, bold=True, ink=_NAVY)
        if section in ("engine", "hydraulics", "winch", "travel", "steering", "service", "cylinders"):
            run = "".join(f"{s.joined(row.label)}{colon} {text_of(s, row)}{stop}" for row in rows).strip()
            for text in s.wrapped(run, 238, 7.2):
                x0, _, y = flow.room(9.2)
                s.put(x0, y - 7.4, text, size=7.2)
            flow.room(7)
            continue
        for row in rows:
            value = text_of(s, row)
            label = s.joined(row.label)
            below = s.width(value, 7.2) + s.width(label, 7.2) > 228
            x0, x1, y = flow.room(19.6 if below else 10.4)
            s.put(x0, y - 7.8, label, size=7.2)
            base = y - 7.8 - (9.2 if below else 0)
            start = x0 + (8 if below else s.width(label, 7.2) + 3)
            dots = int((x1 - s.width(value, 7.2) - 3 - start) / s.width(" .", 7.2))
            s.put(x1 - s.width(value, 7.2) - 3, base, " ." * max(dots, 0), size=7.2, align="r", ink=GREY)
            s.put(x1, base, value, size=7.2, align="r")
        flow.room(7)
    note(s, 48, 500)


@dataclass(frozen=True)
class _Item:
    """A line of a type sheet: its number, sign, label, and the text of a column for a step."""

    code: str
    sign: str
    label: str
    names: tuple[str, ...]
    row: Row


def _items(s: Wording, section: str) -> list[_Item]:
    """A section of a type sheet: values that share a line where all of them are printed."""
    rows = rows_of(s, section, rams="rows")
    found, pairs = [], []
    for one in lines(s.file)["pairs"]:
        names = tuple(one.name.split(" + "))
        own = [row for row in rows if row.name in names]
        if len(own) == len(names) - names.count("*"):
            code, _, sign = one.place.split(" ", 2)
            pairs.append(_Item(code, sign, s.of(one), names, own[0]))
            rows = [row for row in rows if row not in own]
    for row in rows:
        name = "Net Power" if row.name == "Engine Power" else row.name
        code, sign = mark_of(s, "codes", name or section)
        said = row.said
        if name == "Rated Capacity":
            text = s.digits(s.machine.values[name] / 1000, 2)
            said = Said(text, "")
        elif name == "Drawbar Pull":
            said = Said(s.digits(s.machine.values[name] * 1000, 0), "")
        if said != row.said:
            s.printed[name] = said.number
        sign = sign or said.unit
        found.append(_Item(code or "9", sign, s.joined(row.label), (name,), replace(row, said=said)))
    return sorted([*found, *pairs], key=lambda one: [int(x) for x in one.code.split(".")])


def _cell(s: Wording, item: _Item, step: int) -> str:
    """What a type sheet prints for a model."""
    if len(item.names) == 1:
        name, said = item.names[0], item.row.said
        if step and name == "Rated Capacity":
            return s.digits(round(s.machine.values[name] * (1 + 0.1 * step), -2) / 1000, 2)
        if step and name == "Drawbar Pull":
            return s.digits(round(s.machine.values[name] * (1 + 0.05 * step)) * 1000, 0)
        return said.number if step == 0 else stepped(s, item.row, step)
    texts = []
    for name in item.names:
        if name == "*":
            whole = s.machine.values["Operating Weight"] * (1 + 0.08 * step)
            whole += s.machine.values["Rated Capacity"] * (1 + 0.1 * step) if " Laden" in item.names[0] else 0
            front = s.machine.values[item.names[0]] * (1 + 0.08 * step)
            texts.append(s.digits(max(round(whole - front, -1), 150), 0))
            continue
        row = Row("", s.say(name, note=False), name)
        if name in ("Fork Thickness", "Fork Width", "Fork Length"):
            step = 0  # every model has the same forks
        texts.append(stepped(s, row, step))
    return ("/" if item.code != "4.22" else " / ").join(texts)


def still(s: Wording) -> None:
    """An industrial truck's type sheet: sections along the edge, number, item, sign, a column for each model."""
    begin(s)
    steps = (-1, 0, 1) if s.style.language != "ja" else (0, 1)
    names = siblings(s, steps)
    s.config = s.machine.name
    s.put(36, 800, f"{word(s, 'data')} {names[0]} – {names[-1].split()[1]}", size=13, bold=True)
    s.put(559, 800, "VDI 2198", size=8, align="r", ink=GREY)
    edge, code, label, sign = 36.0, 56.0, 80.0, 318.0
    xs = [378 + (559 - 378) * (i + 0.5) / len(steps) for i in range(len(steps))]
    y = 786.0
    s.fill(edge, y - 16, 523, 16, _OCHRE)
    s.put(label, y - 11, word(s, "item"), size=7.5, bold=True)
    for x, name in zip(xs, names, strict=True):
        s.put(x, y - 11, name, size=7.5, bold=True, align="c")
    y -= 16
    for section in s.sections():
        items = _items(s, section)
        if not items:
            continue
        high = max(10.8 * len(items), s.width(s.section(section), 6.4, True) + 6)
        if y - high < 40:
            s.page()
            y = 800.0
        top = y
        for index, item in enumerate(items):
            if index % 2 == 0:
                s.fill(code - 4, y - 10.8, 559 - code + 4, 10.8, _PALE)
            s.put(code, y - 8, item.code if "." in item.code else "", size=6.8)
            s.put(label, y - 8, item.label, size=6.8)
            s.put(sign, y - 8, item.sign, size=6.8)
            for x, step in zip(xs, steps, strict=True):
                s.put(x, y - 8, _cell(s, item, step), size=6.8, align="c")
            y -= 10.8
        y = top - high
        s.fill(edge, y, 14, top - y, "#e6e6e6")
        s.canvas.saveState()
        s.canvas.translate(edge + 9.4, (top + y) / 2)
        s.canvas.rotate(90)
        s.put(0, 0, s.section(section), size=6.4, bold=True, align="c")
        s.canvas.restoreState()
        s.line(edge, y, 559, weight=0.6)
        for x in (code - 4, label - 4, sign - 4, *(x - (559 - 378) / len(steps) / 2 for x in xs)):
            s.line(x, y, x, y1=top, weight=0.3)
    note(s, 36, 520)


def wacker(s: Wording) -> None:
    """A product page: tiles with key figures, striped rows below; or a column for units and one for each model."""
    begin(s)
    steps = (0,) if s.machine.kind in ("grader", "backhoe_loader") or s.dice.random() < 0.5 else (0, 1)
    names = siblings(s, steps)
    s.config = s.machine.name if len(steps) > 1 else ""
    s.put(50, 786, " / ".join(names), size=21, bold=True)
    s.put(50, 768, word(s, "data"), size=11, ink=GREY)
    blocks = blocks_of(s, rams="product" if len(steps) == 1 else "rows")
    every = {row.name: row for _, rows in blocks for row in rows}
    top = 752.0
    if len(steps) == 1:
        for index, row in enumerate([every[name] for name in _KEYS if name in every][:3]):
            x = 50 + 168.0 * index
            s.fill(x, top - 50, 160, 48, _OCHRE)
            s.put(x + 10, top - 24, row.said.metric, size=15, bold=True)
            for line, text in enumerate(s.wrapped(row.label, 144, 7)[:2]):
                s.put(x + 10, top - 36 - 8 * line, text, size=7)
        top -= 64
    flow = Flow(s, ((50, 546),), top, 44, 796)
    xs = (536.0,) if len(steps) == 1 else (420.0, 505.0)
    page = -1
    for section, rows in blocks:
        flow.keep(34 + 13 * min(len(rows), 4))
        if len(steps) > 1 and flow.place != page:
            page = flow.place
            x0, x1, y = flow.room(16)
            s.put(x0 + 4, y - 11, word(s, "item"), size=7.6, bold=True)
            s.put(345, y - 11, word(s, "unit"), size=7.6, bold=True, align="c")
            for x, name in zip(xs, names, strict=True):
                s.put(x, y - 11, name, size=7.6, bold=True, align="c")
            s.line(x0, y - 15, x1, weight=1)
        x0, x1, y = flow.room(19)
        s.put(x0 + 4, y - 13.5, s.section(section), size=9, bold=True, ink=_GREEN)
        for index, row in enumerate(rows):
            x0, x1, y = flow.room(13)
            if index % 2 == 0:
                s.fill(x0, y - 13, x1 - x0, 13, _PALE)
            s.put(x0 + 4, y - 9.4, s.joined(row.label), size=7.6)
            if len(steps) == 1:
                s.put(xs[0], y - 9.4, text_of(s, row), size=7.6, align="r")
                continue
            s.put(345, y - 9.4, row.said.unit, size=7.6, align="c")
            for x, step in zip(xs, steps, strict=True):
                s.put(x, y - 9.4, stepped(s, row, step), size=7.6, align="c")
        flow.room(6)
    note(s, 50, 496)


def manitou(s: Wording) -> None:
    """A data sheet in two columns: item, the drawing's mark, a column for each system of units; forces in daN."""
    begin(s)
    s.fill(40, 786, 515, 26, _RED)
    s.put(48, 794, s.machine.name, size=15, bold=True, ink="#ffffff")
    s.put(547, 795, word(s, "data"), size=9, align="r", ink="#ffffff")
    blocks = blocks_of(s, rams="rows")
    heads = word(s, "systems").split(" / ")
    both = s.style.imperial
    columns = ((40.0, 555.0),) if both else ((40.0, 291.0), (304.0, 555.0))
    flow = Flow(s, columns, 776, 44 if both else level_of(blocks, 776, 2, 12, 20), 800)
    for section, rows in blocks:
        flow.keep(44)
        x0, x1, y = flow.room(16)
        s.put(x0 + 3, y - 11, s.section(section), size=8.2, bold=True, ink=_RED)
        if both:
            s.put(x1 - 120, y - 11, heads[0], size=7.2, bold=True, align="r")
            s.put(x1 - 4, y - 11, heads[1], size=7.2, bold=True, align="r")
        s.line(x0, y - 14.5, x1, weight=0.9)
        for row in rows:
            said = row.said
            if said.unit == "kN" and not both and row.name:
                plain = float(said.number.replace(s.style.group, "").replace(s.style.point, "."))
                said = Said(s.digits(plain * 100, 0), "daN")
                s.printed[row.name] = said.number
            value = said.metric if both else text_of(s, replace(row, said=said))
            texts = s.wrapped(s.joined(row.label), 250 if both else 205 - s.width(value, 7), 7)
            x0, x1, y = flow.room(8.4 * len(texts) + 3)
            for index, text in enumerate(texts):
                s.put(x0 + 3, y - 8 - 8.4 * index, text, size=7)
            mark = mark_of(s, "marks", row.name)[1]
            s.put(x0 + 300 if both else x1 - s.width(value, 7) - 22, y - 8, mark, size=7, ink=GREY)
            s.put(x1 - (120 if both else 4), y - 8, value, size=7, align="r")
            if both:
                s.put(x1 - 4, y - 8, said.imperial.replace("lb.", "lb").replace("in.", "in"), size=7, align="r")
            s.line(x0, y - 8.4 * len(texts) - 3, x1, weight=0.25)
        flow.room(6)
    note(s, 40, 515)


def hidromek(s: Wording) -> None:
    """Boxed tables in two columns under dark heads; a column for each arm or bucket where values depend on it."""
    begin(s)
    s.put(40, 796, s.machine.name, size=18, bold=True)
    s.put(555, 798, word(s, "data").upper(), size=9, align="r", ink=GREY)
    split = {"excavator": _BY_ARM, "wheel_loader": ("bucket",)}.get(s.machine.kind, ())
    heads, own = choices(s) if split else ([], 0)
    s.config = heads[own] if split else ""
    blocks = blocks_of(s, rams="product")
    flow = Flow(s, ((40, 292), (303, 555)), 780, level_of(blocks, 780, 2, 14, 30), 796)
    for section, rows in blocks:
        columns = heads if section in split else []
        flow.keep(60 if not columns else 40 + 14 * len(rows))
        x0, x1, y = flow.room(15)
        s.fill(x0, y - 15, x1 - x0, 15, "#4a4f57")
        s.put(x0 + 5, y - 10.6, s.section(section).upper(), size=7.8, bold=True, ink="#ffffff")
        width = 62.0
        if columns:
            texts = [s.wrapped(head, width - 6, 6.6) for head in columns]
            high = 8.0 * max(len(one) for one in texts) + 5
            x0, x1, y = flow.room(high)
            s.fill(x0, y - high, x1 - x0, high, "#e3e5e8")
            for place, own_texts in enumerate(texts):
                for index, text in enumerate(own_texts):
                    s.put(x1 - width * (1.5 - place), y - 8.6 - 8 * index, text, size=6.6, align="c")
        for row in rows:
            values = [text_of(s, row)]
            if columns:
                mine = row.said.metric
                values = [mine, mine]
                step = -1 if own else 1
                if row.name == "Arm Length":
                    arm = s.machine.values[row.name] + (-500 if own else 450)
                    values[1 - own] = local(s, s.say(row.name, arm, note=False), "").metric
                elif row.name == LEVEL:
                    depth = s.machine.values["Maximum Digging Depth"] * (0.89 if own else 1.05)
                    depth = rounded(s.machine.kind, "Maximum Digging Depth", depth)
                    values[1 - own] = local(s, s.say("Maximum Digging Depth", depth, note=False), "").metric
                elif row.name in s.machine.values and row.name not in FIXED:
                    values[1 - own] = replace(row.said, number=stepped(s, row, step)).metric
            taken = width * 2 if columns else s.width(values[0], 7) + 8
            texts_ = s.wrapped(s.joined(row.label), x1 - x0 - taken - 10, 7)
            x0, x1, y = flow.room(8.6 * len(texts_) + 4.6)
            for index, text in enumerate(texts_):
                s.put(x0 + 5, y - 9.2 - 8.6 * index, text, size=7)
            middle = y - 4.9 - 4.3 * len(texts_)
            if columns and values[0] == values[1]:
                s.put(x1 - width, middle, values[0], size=7, align="c")
            elif columns:
                for place, value in enumerate(values):
                    s.put(x1 - width * (1.5 - place), middle, value, size=7, align="c")
            else:
                s.put(x1 - 5, middle, values[0], size=7, align="r")
            bottom = y - 8.6 * len(texts_) - 4.6
            s.line(x0, bottom, x1, weight=0.3)
            for x in (x0, x1, *((x1 - 2 * width,) if columns else ())):
                s.line(x, bottom, x, y1=y, weight=0.3)
        flow.room(9)
    note(s, 40, 515)


_DE = Style("de", 0, group=".", point=",", pressure="bar")
_FR = Style("fr", 0, group="\u202f", point=",", pressure="bar")
STYLES: Mapping[str, Style] = {
    "en_us": Style("en", 0, metres=True, imperial=True, pressure="MPa", feet="{} ft. {} in."),
    "en_usm": Style("en", 0, imperial=True, pressure="kPa", feet="{} ft. {} in."),
    "en_za": Style("en", 1, imperial=True, group=" ", pressure="bar", feet="{} ft. {} in."),
    "en_eu": Style("en", 1, pressure="bar"),
    "en_t": Style("en", 1, metres=True, tonnes=True, pressure="bar"),
    "de": _DE,
    "de_t": replace(_DE, metres=True, tonnes=True),
    "fr": replace(_FR, group=" "),
    "fr_m": replace(_FR, group=" ", metres=True),
    "es": Style("es", 0, group=".", point=",", pressure="bar"),
    "es_us": Style("es", 0, imperial=True, pressure="kPa", feet="{} pies {} pulg."),
    "zh": Style("zh", 0, group=","),
    "zh_n": Style("zh", 0, group=""),
    "ja": Style("ja", 0),
    "ja_m": Style("ja", 0, metres=True),
}
FRESH7 = Worded(
    "fresh7",
    "HK",
    {f.__name__: f for f in (casenh, bell, grove, still, wacker, manitou, hidromek)},
    STYLES,
    {
        "wheel_loader": "casenh:en_us hidromek:en_eu wacker:de wacker:en_eu hidromek:fr casenh:es_us hidromek:de "
        "casenh:zh hidromek:ja casenh:en_usm",
        "excavator": "casenh:en_us hidromek:en_eu wacker:fr wacker:en_eu hidromek:de hidromek:es casenh:zh_n "
        "wacker:ja hidromek:zh casenh:en_usm hidromek:fr_m",
        "articulated_dump_truck": "bell:en_za bell:de bell:fr bell:ja bell:en_za",
        "rigid_dump_truck": "grove:en_us bell:en_za bell:es grove:zh",
        "dozer": "casenh:en_us casenh:es_us hidromek:de casenh:zh wacker:en_eu",
        "grader": "casenh:en_us hidromek:en_eu hidromek:fr wacker:zh",
        "backhoe_loader": "casenh:en_us hidromek:en_eu hidromek:es manitou:fr",
        "forklift": "still:en_eu still:de still:ja still:zh_n",
        "mobile_crane": "grove:en_us grove:de_t grove:ja_m grove:en_t",
        "skid_steer": "manitou:en_us manitou:fr wacker:de manitou:es",
    },
)
