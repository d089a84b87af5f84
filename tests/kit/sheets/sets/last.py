"""Layouts of the last set: written after the held ones were mended for and before the final ones were looked at."""

from __future__ import annotations

from kit.sheets.sets.tuned import LEFT, RIGHT
from kit.sheets.typeset import SECTIONS, Row, Said, Sheet


def pairs(s: Sheet) -> None:
    """Two labels with their values on one line under one heading, unruled; the unit glued to the number."""
    s.title()
    y = 780.0
    for section in ("engine", *SECTIONS[s.machine.kind]):
        rows = s.rows(section)
        if not rows:
            continue
        lines = [rows[i : i + 2] for i in range(0, len(rows), 2)]
        if y < 70 + 13 * len(lines):
            y = s.page()
        s.fill(LEFT, y - 4, RIGHT - LEFT, 14, "#20506a")
        s.put(LEFT + 4, y, s.section(section), bold=True, ink="#ffffff")
        y -= 17
        for line in lines:
            for place, row in enumerate(line):
                x = LEFT + 268 * place
                s.put(x, y, row.label, size=7)
                s.put(x + 250, y, row.said.number + row.said.unit, size=7, align="r")
            y -= 13
        y -= 8


def letters(s: Sheet) -> None:
    """Grids with a drawing's letter, the label, and columns headed by the unit: the section's most frequent one."""
    s.title()
    y = 785.0
    xs = (LEFT, 60.0, 340.0, 450.0, RIGHT)
    for section in (*SECTIONS[s.machine.kind], "tyres"):
        by_unit: dict[str, list[Row]] = {}
        for row in s.rows(section):
            by_unit.setdefault(row.said.unit, []).append(row)
        for unit, rows in by_unit.items():
            if y < 70 + 14 * len(rows):
                y = s.page()
            s.put(LEFT, y, s.section(section), size=9, bold=True)
            y -= 5
            top = y
            s.fill(LEFT, y - 14, RIGHT - LEFT, 14, "#dddddd")
            s.put((xs[2] + xs[3]) / 2, y - 10, unit, size=7.5, bold=True, align="c")
            y -= 14
            s.line(LEFT, y, RIGHT)
            for index, row in enumerate(rows):
                s.put((xs[0] + xs[1]) / 2, y - 10, chr(65 + index), size=7.5, align="c")
                s.put(xs[1] + 3, y - 10, row.label, size=7.5)
                s.put((xs[2] + xs[3]) / 2, y - 10, row.said.number, size=7.5, align="c")
                s.put((xs[3] + xs[4]) / 2, y - 10, row.said.imperial, size=7.5, align="c")
                y -= 14
                s.line(LEFT, y, RIGHT)
            s.line(LEFT, top, RIGHT)
            for x in xs:
                s.line(x, top, x, y1=y)
            y -= 18


def noted(s: Sheet) -> None:
    """Ruled rows with bold values, raised footnote numbers and circumstances; small notes under each table."""
    s.title()
    y = 780.0
    for section in (*SECTIONS[s.machine.kind], "service", "other"):
        rows = s.rows(section, cylinders="product")
        if not rows:
            continue
        if y < 90 + 15 * len(rows):
            y = s.page()
        s.put(LEFT, y, s.section(section).upper(), size=9.5, bold=True)
        s.line(LEFT, y - 4, RIGHT, weight=1)
        y -= 16
        for index, row in enumerate(rows):
            label = row.label + (" (26.5R25)" if index == 1 and s.machine.kind == "wheel_loader" else "")
            width = s.put(LEFT, y, label)
            if index % 3 == 0:
                s.put(LEFT + width, y + 3, "1)", size=4.5)
            s.put(RIGHT, y, row.said.both, bold=True, align="r")
            s.line(LEFT, y - 4, RIGHT, weight=0.2)
            y -= 14
        s.put(LEFT, y + 1, "1) ISO 6015, ISO 7131, SAE J732", size=5.5)
        y -= 18


def listed(s: Sheet) -> None:
    """Each section one run-on list: label and value, commas or semicolons between; cylinders: count, bore, stroke."""
    s.title()
    y = 775.0
    for section in (*SECTIONS[s.machine.kind], "engine"):
        rows = s.rows(section, cylinders="none")
        texts = [f"{r.label} {r.said.both}" for r in rows]
        if section == "cylinders":
            for key, words, _ in s.cylinders():
                parts = [f"{s.part(n.partition(' Cylinder ')[2])} {s.say(n).metric}" for n in s.measures(key)]
                if parts:
                    texts.append(f"{words}: {', '.join(parts)}")
        if not texts:
            continue
        lines = s.wrapped("; ".join(texts) + ".", RIGHT - LEFT - 120, 8)
        if y < 60 + 11 * len(lines):
            y = s.page()
        s.put(LEFT, y, s.section(section), bold=True)
        for line in lines:
            s.put(LEFT + 120, y, line)
            y -= 11
        y -= 9


def indented(s: Sheet) -> None:
    """Sub-headings with indented items under dotted leaders, two columns; cylinders by measure: under "stroke" each."""
    s.title()
    columns = ((LEFT, 285.0), (310.0, RIGHT))
    y, column = 780.0, 0
    for section in SECTIONS[s.machine.kind]:
        groups: list[tuple[str, list[Row]]] = [("", s.rows(section, cylinders="none"))]
        if section == "cylinders":
            for part in ("Bore", "Stroke"):
                own = [
                    Row(words, s.say(f"{key} Cylinder {part}"), part)
                    for key, words, _ in s.cylinders()
                    if f"{key} Cylinder {part}" not in s.left_out
                ]
                groups.append((s.part(part)[0].upper() + s.part(part)[1:], own))
        rows = [r for _, own in groups for r in own]
        if not rows:
            continue
        if y < 70 + 13 * (len(rows) + len(groups)):
            column, y = column + 1, 780.0
            if column % 2 == 0:
                s.page()
        x0, x1 = columns[column % 2]
        s.put(x0, y, s.section(section), size=11, bold=True)
        y -= 16
        for title, own in groups:
            if title and own:
                s.put(x0, y, title, bold=True)
                y -= 12
            for row in own:
                start = x0 + 12 + s.put(x0 + 12, y, row.label, size=7) + 2
                value = row.said if not row.name or row.said.unit != "mm" else Said(row.said.number, "mm")
                end = x1 - s.put(x1, y, value.metric, size=7, align="r") - 2
                s.put(end, y, "." * max(int((end - start) / s.width(".", 7)), 0), size=7, align="r")
                y -= 12
        y -= 8


LAST = {f.__name__: f for f in (pairs, letters, noted, listed, indented)}
