"""Layouts held back: written before any rule was tuned on the others, and looked at only when that was done.

`HELD` was read first, then mended for; `FINAL` was read once, at the end. From then on both are tests like any other.
"""

from __future__ import annotations

from collections.abc import Sequence

from kit.sheets.machines import entries
from kit.sheets.sets.tuned import LEFT, RIGHT
from kit.sheets.typeset import SECTIONS, Row, Said, Sheet


# ---- held ----------------------------------------------------------------------------------------------------------
def blocks(s: Sheet) -> None:
    """Three narrow blocks side by side, unruled; the unit in a column of its own."""
    s.title()
    columns = (LEFT, 216.0, 396.0)
    ys = [780.0, 780.0, 780.0]
    for section in (*SECTIONS[s.machine.kind], "engine", "service"):
        rows = s.rows(section)
        if not rows:
            continue
        pieces = [(s.wrapped(r.label, 92, 6.5), r) for r in rows]
        need = 24 + sum(8 * len(lines) + 3 for lines, _ in pieces)
        column = max(range(3), key=lambda i: ys[i])
        if ys[column] - need < 40:
            s.page()
            ys = [790.0, 790.0, 790.0]
            column = 0
        x, y = columns[column], ys[column]
        s.put(x, y, s.section(section), size=9, bold=True, ink="#0a5080")
        y -= 13
        for lines, row in pieces:
            s.put(x + 98, y, row.said.unit, size=6.5)
            s.put(x + 160, y, row.said.number, size=6.5, align="r")
            for line in lines:
                s.put(x, y, line, size=6.5)
                y -= 8
            y -= 3
        ys[column] = y - 11


def transposed(s: Sheet) -> None:
    """Grids: two pairs of label and value a row, shaded every other row; cylinders as a table of measures."""
    s.title()
    y = 785.0
    xs = (LEFT, 210.0, 297.0, 471.0, RIGHT)
    for section in (*SECTIONS[s.machine.kind], "tyres"):
        if section == "cylinders":
            y = _measures(s, y - 6)
            continue
        rows = s.rows(section)
        if not rows:
            continue
        pairs = [rows[i : i + 2] for i in range(0, len(rows), 2)]
        if y < 70 + 15 * len(pairs):
            y = s.page()
        s.put(LEFT, y, s.section(section), size=10, bold=True)
        y -= 6
        top = y
        for index, pair in enumerate(pairs):
            if index % 2:
                s.fill(LEFT, y - 15, RIGHT - LEFT, 15, "#eef2f4")
            for place, row in enumerate(pair):
                s.put(xs[2 * place] + 3, y - 10.5, row.label, size=6.5)
                s.put(xs[2 * place + 2] - 3, y - 10.5, row.said.metric, size=7, align="r")
            y -= 15
            s.line(LEFT, y, RIGHT)
        s.line(LEFT, top, RIGHT)
        for x in xs:
            s.line(x, top, x, y1=y)
        y -= 20


def _measures(s: Sheet, y: float) -> float:
    parts = ("Bore", "Rod Diameter", "Stroke")
    if y < 140:
        y = s.page()
    s.put(LEFT, y, s.section("cylinders"), size=10, bold=True)
    y -= 6
    xs = (LEFT, 210.0, 326.0, 442.0, RIGHT)
    top = y
    for index, part in enumerate(parts):
        s.put((xs[index + 1] + xs[index + 2]) / 2, y - 10.5, s.part(part), size=7, bold=True, align="c")
    y -= 15
    s.line(LEFT, y, RIGHT)
    for key, words, count in s.cylinders():
        s.put(LEFT + 3, y - 10.5, f"{words} ({count})", size=7)
        for index, part in enumerate(parts):
            name = f"{key} Cylinder {part}"
            text = s.say(name).metric if name not in s.left_out else "-"
            s.put((xs[index + 1] + xs[index + 2]) / 2, y - 10.5, text, size=7, align="c")
        y -= 15
        s.line(LEFT, y, RIGHT)
    s.line(LEFT, top, RIGHT)
    for x in xs:
        s.line(x, top, x, y1=y)
    return y - 20


def stacked(s: Sheet) -> None:
    """Imperial in brackets under metric, the label centred beside the two; cylinders as sub-headings with items."""
    s.title()
    y = 780.0
    for section in ("engine", *SECTIONS[s.machine.kind]):
        rows = s.rows(section, cylinders="none")
        if not rows and section != "cylinders":
            continue
        if y < 110 + 22 * len(rows):
            y = s.page()
        s.put(LEFT, y, s.section(section), size=12, bold=True, ink="#804000")
        y -= 18
        if section == "cylinders":
            for key, words, count in s.cylinders():
                s.put(LEFT, y, words, bold=True)
                y -= 11
                s.put(LEFT + 12, y, s.part("Count"))
                s.put(240, y, str(count))
                y -= 11
                for name in s.measures(key):
                    s.put(LEFT + 12, y, s.part(name.partition(" Cylinder ")[2]))
                    s.put(240, y, s.say(name).metric)
                    y -= 11
                y -= 3
        for row in rows:
            if row.said.imperial:
                s.put(240, y, row.said.metric)
                s.put(LEFT, y - 5, row.label)
                s.put(240, y - 9.5, f"({row.said.imperial})")
                y -= 23
            else:
                s.put(LEFT, y, row.label)
                s.put(240, y, row.said.metric)
                y -= 13
        y -= 8


def legend(s: Sheet) -> None:
    """A drawing's legend: letters, labels and bare numbers; the unit stands in the heading."""
    s.title()
    y = 780.0
    for section in SECTIONS[s.machine.kind]:
        by_unit: dict[str, list[Row]] = {}
        for row in s.rows(section):
            by_unit.setdefault(row.said.unit, []).append(row)
        for unit, rows in by_unit.items():
            bare = unit in ("mm", "m", "kg", "°", "t") and len(rows) > 1
            if y < 70 + 12 * len(rows):
                y = s.page()
            s.put(LEFT, y, s.section(section) + (f" ({unit})" if bare else ""), size=11, bold=True)
            s.line(LEFT, y - 4, 330, weight=0.8)
            y -= 16
            for index, row in enumerate(rows):
                s.put(LEFT, y, chr(65 + index), bold=True)
                s.put(LEFT + 18, y, row.label)
                s.put(330, y, row.said.number if bare else row.said.metric, align="r")
                y -= 12
            y -= 10


def models(s: Sheet) -> None:
    """A grid with other machines of the family as columns; the model is chosen, or nothing is settled."""
    s.title()
    names = [s.machine.name.upper() + suffix for suffix in ("", "-L", "-XL")]
    chosen = names.index(s.config) if s.config in names else None
    xs = (LEFT, 250.0, 300.0, 386.0, 472.0, RIGHT)
    y = 780.0
    for section in SECTIONS[s.machine.kind]:
        wanted = [e for e in entries(s.machine.kind) if e.second == section and e.name not in s.left_out]
        listed = [(s.word(e), e.name) for e in wanted]
        if section == "cylinders":
            listed = [(f"{words} {s.part(n.partition(' Cylinder ')[2])}", n)
                      for key, words, _ in s.cylinders() for n in s.measures(key)]  # fmt: skip
        others = s.distractors(section)
        if not listed:
            continue
        if y < 80 + 14 * (len(listed) + len(others)):
            y = s.page()
        top = y
        s.fill(LEFT, y - 14, RIGHT - LEFT, 14, "#d8d8d8")
        s.put(LEFT + 3, y - 10, s.section(section), size=7.5, bold=True)
        for index, name in enumerate(names):
            s.put((xs[index + 2] + xs[index + 3]) / 2, y - 10, name, size=7.5, bold=True, align="c")
        y -= 14
        s.line(LEFT, y, RIGHT)
        for label, name in listed:
            s.put(LEFT + 3, y - 10, label, size=7)
            own = s.machine.values[name]
            for index, factor in enumerate((1.0, 1.07, 1.16)):
                value = own if index == 0 else _whole(own * factor, own)
                said = s.say(name, value, note=index == chosen)
                s.put((xs[index + 2] + xs[index + 3]) / 2, y - 10, said.number, size=7, align="c")
            s.put(xs[1] + 3, y - 10, said.unit, size=7)
            if chosen is None:
                s.unsettled.add(name)
            y -= 14
            s.line(LEFT, y, RIGHT)
        for row in others:
            s.put(LEFT + 3, y - 10, row.label, size=7)
            s.put((xs[2] + RIGHT) / 2, y - 10, row.said.number, size=7, align="c")
            y -= 14
            s.line(LEFT, y, RIGHT)
        s.line(LEFT, top, RIGHT)
        for x in xs if not others else (xs[0], xs[1], xs[2], xs[5]):
            s.line(x, top, x, y1=y)
        if others:
            for x in xs[3:5]:
                s.line(x, top, x, y1=y + 14 * len(others))
        y -= 14


def _whole(value: float, like: float) -> float:
    return (
        float(round(value))
        if like % 1 == 0 and like > 20
        else round(value, 1)
        if like % 0.1 < 1e-9
        else round(value, 2)
    )


# ---- final ---------------------------------------------------------------------------------------------------------
def bullets(s: Sheet) -> None:
    """Bulleted lines of label, colon and value, in two columns of text, sometimes two to a line."""
    s.title()
    columns = (LEFT, 306.0)
    y, column = 780.0, 0
    for section in (*SECTIONS[s.machine.kind], "engine", "other"):
        rows = s.rows(section)
        if not rows:
            continue
        texts = [f"• {r.label}: {r.said.both}" for r in rows]
        lines = [line for text in texts for line in s.wrapped(text, 246, 7.5)]
        if y < 60 + 11 * len(lines):
            column, y = column + 1, 780.0
            if column % 2 == 0:
                s.page()
        x = columns[column % 2]
        s.put(x, y, s.section(section), size=10, bold=True)
        y -= 14
        for line in lines:
            s.put(x, y, line, size=7.5)
            y -= 11
        y -= 8


def imperial_first(s: Sheet) -> None:
    """Label over its value, the imperial one first and the metric in brackets, three to a row between rules."""
    s.title()
    y = 780.0
    for section in SECTIONS[s.machine.kind]:
        rows = s.rows(section)
        if not rows:
            continue
        lines = [rows[i : i + 3] for i in range(0, len(rows), 3)]
        if y < 70 + 28 * len(lines):
            y = s.page()
        s.put(LEFT, y, s.section(section), size=11, bold=True)
        y -= 12
        for line in lines:
            s.line(LEFT, y + 2, RIGHT)
            for index, row in enumerate(line):
                x = LEFT + 176 * index
                s.put(x, y - 8, row.label, size=6.5)
                both = f"{row.said.imperial} ({row.said.metric})" if row.said.imperial else row.said.metric
                s.put(x, y - 18, both, size=8, bold=True)
            y -= 26
        y -= 16


def zebra(s: Sheet) -> None:
    """Shaded rows without rules; columns headed by the systems of measurement, the units in brackets in the label."""
    s.title()
    y = 780.0
    heads = {"en": ("Metric", "US"), "de": ("Metrisch", ""), "fr": ("Métrique", ""), "es": ("Métrico", ""),
             "zh": ("公制", ""), "ja": ("メートル法", "")}[s.style.language]  # fmt: skip
    for section in (*SECTIONS[s.machine.kind], "service", "tyres"):
        rows = s.rows(section)
        if not rows:
            continue
        if y < 80 + 13 * len(rows):
            y = s.page()
        s.put(LEFT, y, s.section(section), size=10, bold=True)
        s.put(400, y, heads[0], bold=True, align="r")
        if s.style.imperial:
            s.put(520, y, heads[1], bold=True, align="r")
        y -= 14
        for index, row in enumerate(rows):
            if index % 2 == 0:
                s.fill(LEFT, y - 3.5, RIGHT - LEFT, 12.5, "#e8eef0")
            label = f"{row.label} ({row.said.unit})" if row.said.unit else row.label
            s.put(LEFT + 3, y, label)
            s.put(400, y, row.said.number, align="r")
            s.put(520, y, row.said.imperial, align="r")
            y -= 12.5
        y -= 12


def choices(s: Sheet) -> None:
    """A grid of configurations under two levels of heads; units in a column; values for all span the columns."""
    s.title()
    variants = s.machine.variants
    heads = [v.heads[s.style.language] for v in variants]
    chosen = heads.index(s.config) if s.config in heads else None
    xs = (LEFT, 240.0, 290.0, 380.0, 470.0, RIGHT)
    y = 780.0
    for section in SECTIONS[s.machine.kind]:
        rows = s.rows(section, skip=frozenset(variants[0].values))
        mine = [e for e in entries(s.machine.kind) if e.second == section and e.name in variants[0].values
                and e.name not in s.left_out]  # fmt: skip
        if not rows and not mine:
            continue
        if y < 90 + 14 * (len(rows) + len(mine)):
            y = s.page()
        top = y
        s.put(LEFT + 3, y - 17, s.section(section), size=8, bold=True)
        s.put((xs[2] + RIGHT) / 2, y - 10, s.machine.name.upper(), size=7.5, bold=True, align="c")
        s.line(xs[2], y - 14, RIGHT)
        for index, head in enumerate(heads):
            s.put((xs[index + 2] + xs[index + 3]) / 2, y - 24, head, size=6.5, bold=True, align="c")
        y -= 28
        s.line(LEFT, y, RIGHT)
        below = y
        for entry in mine:
            s.put(LEFT + 3, y - 10, s.word(entry), size=7)
            for index, variant in enumerate(variants):
                said = s.say(entry.name, variant.values[entry.name], note=index == chosen)
                s.put((xs[index + 2] + xs[index + 3]) / 2, y - 10, said.number, size=7, align="c")
            s.put(xs[1] + 3, y - 10, said.unit, size=7)
            if chosen is None:
                s.unsettled.add(entry.name)
            y -= 14
            s.line(LEFT, y, RIGHT)
        parted = y
        for row in rows:
            _spanning(s, row, xs, y)
            y -= 14
            s.line(LEFT, y, RIGHT)
        s.line(LEFT, top, RIGHT)
        for x in (xs[0], xs[1], xs[2], xs[5]):
            s.line(x, top if x != xs[1] else below, x, y1=y)
        for x in xs[3:5]:
            s.line(x, top - 14, x, y1=parted)
        y -= 14


def _spanning(s: Sheet, row: Row, xs: Sequence[float], y: float) -> None:
    s.put(LEFT + 3, y - 10, row.label, size=7)
    s.put(xs[1] + 3, y - 10, row.said.unit, size=7)
    s.put((xs[2] + xs[5]) / 2, y - 10, row.said.number, size=7, align="c")


def manual(s: Sheet) -> None:
    """A service manual: numbered rows with dots, an unruled table of measures for the cylinders, wide margins."""
    s.title()
    y = 770.0
    for number, section in enumerate(("engine", *SECTIONS[s.machine.kind]), start=1):
        rows = s.rows(section, cylinders="none")
        if not rows and section != "cylinders":
            continue
        if y < 130 + 14 * len(rows):
            y = s.page()
        s.put(72, y, f"{number}. {s.section(section)}", size=12, bold=True)
        y -= 20
        if section == "cylinders":
            stops = (330.0, 420.0, 510.0)
            for part, stop in zip(("Bore", "Rod Diameter", "Stroke"), stops, strict=True):
                s.put(stop, y, f"{s.part(part)} (mm)", bold=True, align="r")
            y -= 14
            for key, words, _ in s.cylinders():
                s.put(72, y, words)
                for part, stop in zip(("Bore", "Rod Diameter", "Stroke"), stops, strict=True):
                    name = f"{key} Cylinder {part}"
                    said = s.say(name) if name not in s.left_out else Said("–", "")
                    s.put(stop, y, said.number, align="r")
                y -= 14
            y -= 8
        for index, row in enumerate(rows, start=1):
            start = 72 + s.put(72, y, f"{number}.{index}  {row.label}") + 4
            s.put(470, y, row.said.number, align="r")
            s.put(476, y, row.said.unit)
            end = 466 - s.width(row.said.number)
            s.put(end, y, "." * max(int((end - start) / s.width(".")), 0), align="r")
            y -= 14
        y -= 10


HELD = {f.__name__: f for f in (blocks, transposed, stacked, legend, models)}
FINAL = {f.__name__: f for f in (bullets, imperial_first, zebra, choices, manual)}
