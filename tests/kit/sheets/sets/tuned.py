"""Layouts that the rules may be tuned on."""

from __future__ import annotations

from kit.sheets.typeset import HEIGHT, SECTIONS, Row, Sheet

LEFT, RIGHT = 36.0, 559.0


def ruled(s: Sheet) -> None:
    """Horizontal rules; label, metric, imperial; letter keys that begin anew in each table."""
    s.title()
    y = 780.0
    for section in ("engine", *SECTIONS[s.machine.kind], "service"):
        rows = s.rows(section)
        if not rows:
            continue
        if y < 80 + 13 * min(len(rows), 20):
            y = s.page()
        s.put(LEFT, y, s.section(section), size=11, bold=True)
        s.line(LEFT, y - 4, RIGHT, weight=1.4)
        y -= 17
        for index, row in enumerate(rows):
            keyed = section in ("dimensions", "working")
            s.put(LEFT, y, (f"{chr(65 + index)}  " if keyed else "") + row.label)
            s.put(430, y, row.said.metric, align="r")
            s.put(RIGHT, y, row.said.imperial, align="r")
            s.line(LEFT, y - 3.5, RIGHT)
            y -= 13
        y -= 10


def leaders(s: Sheet) -> None:
    """Two columns of dotted rows under grey bars; cylinders as products."""
    s.title()
    columns = ((LEFT, 290.0), (306.0, RIGHT))
    y, column = 780.0, 0
    for section in ("engine", *SECTIONS[s.machine.kind], "service", "other"):
        rows = s.rows(section, cylinders="product")
        if not rows:
            continue
        if y < 60 + 12 * len(rows):
            column += 1
            if column % 2 == 0:
                s.page()
            y = 780.0
        x0, x1 = columns[column % 2]
        s.fill(x0, y - 4, x1 - x0, 13, "#d0d0d0")
        s.put(x0 + 3, y, s.section(section), bold=True)
        y -= 15
        for row in rows:
            y = _dotted(s, x0, x1, y, row)
        y -= 8


def _dotted(s: Sheet, x0: float, x1: float, y: float, row: Row) -> float:
    size = 7.0
    lines = s.wrapped(row.label, x1 - x0 - s.width(row.said.both, size) - 14, size)
    for line in lines[:-1]:
        s.put(x0, y, line, size=size)
        y -= 8.5
    start = x0 + s.put(x0, y, lines[-1], size=size) + 2
    end = x1 - s.put(x1, y, row.said.both, size=size, align="r") - 2
    s.put(end, y, "." * max(int((end - start) / s.width(".", size)), 0), size=size, align="r")
    return y - 11


def lattice(s: Sheet) -> None:
    """A full grid: group (spanning its rows), item, unit, value."""
    s.title()
    y = 785.0
    xs = (LEFT, 150.0, 400.0, 450.0, RIGHT)
    for section in (*SECTIONS[s.machine.kind], "engine", "other"):
        if section == "cylinders":
            groups = [(w, [Row(s.part(n.partition(" Cylinder ")[2]), s.say(n), n) for n in s.measures(k)])
                      for k, w, _ in s.cylinders()]  # fmt: skip
        else:
            groups = [(s.section(section), s.rows(section))]
        for group, rows in groups:
            if not rows:
                continue
            if y < 50 + 14 * len(rows):
                y = s.page()
            top = y
            for row in rows:
                y -= 14
                for index, cell in enumerate((row.label, row.said.unit, row.said.number)):
                    s.put(xs[index + 1] + 3, y + 4, cell, size=7.5)
                s.line(xs[1], y, RIGHT)
            lines = s.wrapped(group, 108, 7.5)
            for index, line in enumerate(lines):
                s.put(xs[0] + 3, (top + y) / 2 - 3 + 9 * (len(lines) - 1 - 2 * index) / 2, line, size=7.5)
            s.line(LEFT, y, RIGHT)
            s.line(LEFT, top, RIGHT)
            for x in xs:
                s.line(x, top, x, y1=y)


def wrapped(s: Sheet) -> None:
    """No rules: labels over two lines with the value beside the last, or centred between metric and imperial."""
    s.title()
    y = 776.0
    for number, section in enumerate((*SECTIONS[s.machine.kind], "tyres")):
        rows = s.rows(section)
        if not rows:
            continue
        if y < 90 + 22 * len(rows):
            y = s.page()
        s.put(LEFT, y, s.section(section).upper(), size=10, bold=True)
        y -= 18
        for row in rows:
            if number % 2 and row.said.imperial:
                s.put(260, y, row.said.metric)
                s.put(LEFT, y - 5, row.label)
                s.put(260, y - 10, row.said.imperial)
                y -= 24
                continue
            lines = s.wrapped(row.label, 110)
            for line in lines:
                s.put(LEFT, y, line)
                y -= 9.5
            s.put(200, y + 9.5, row.said.metric)
            s.put(300, y + 9.5, row.said.imperial)
            y -= 4
        y -= 10


def matrix(s: Sheet) -> None:
    """Configurations as columns under a spanned head; what holds for all stands in the middle column. Footnotes."""
    s.title()
    variants = s.machine.variants
    stops = (330.0, 440.0, 550.0)
    y = 776.0
    varied = frozenset(variants[0].values)
    heads = [v.heads[s.style.language] for v in variants]
    chosen = next((i for i, h in enumerate(heads) if h == s.config), None)
    for section in SECTIONS[s.machine.kind]:
        rows = s.rows(section, skip=varied)
        mine = [e for e in _entries(s) if e.second == section and e.name in varied and e.name not in s.left_out]
        if not rows and not mine:
            continue
        if y < 120 + 13 * (len(rows) + len(mine)):
            y = s.page()
        s.put(LEFT, y, s.section(section), size=11, bold=True)
        y -= 15
        if mine:
            for head, stop in zip(heads, stops, strict=True):
                s.put(stop, y, head, size=7.5, bold=True, align="r")
            s.line(LEFT, y - 4, RIGHT, weight=1)
            y -= 14
        for entry in mine:
            s.put(LEFT, y, s.word(entry) + (" *" if len(mine) > 3 and entry is mine[1] else ""))
            for index, (variant, stop) in enumerate(zip(variants, stops, strict=True)):
                said = s.say(entry.name, variant.values[entry.name], note=index == chosen)
                s.put(stop, y, said.metric, align="r")
            if chosen is None:
                s.unsettled.add(entry.name)
            s.line(LEFT, y - 3.5, RIGHT)
            y -= 13
        for row in rows:
            s.put(LEFT, y, row.label)
            s.put(stops[1], y, row.said.metric, align="r")
            s.line(LEFT, y - 3.5, RIGHT)
            y -= 13
        y -= 12
    s.put(LEFT, 40, "* " + s.section("other"), size=6)


def _entries(s: Sheet) -> list:  # type: ignore[type-arg]
    from kit.sheets.machines import entries

    return list(entries(s.machine.kind))


_SAYS = {
    "en": "The {label} is {value}.", "de": "{label}: {value}.", "fr": "{label} : {value}.", "es": "{label}: {value}.",
    "zh": "{label}为{value}。", "ja": "{label}は{value}です。",
}  # fmt: skip


def prose(s: Sheet) -> None:
    """Running sentences in paragraphs."""
    s.title()
    y = 770.0
    for section in (*SECTIONS[s.machine.kind], "engine"):
        rows = [r for r in s.rows(section) if r.name or section != "tyres"]
        if not rows:
            continue
        said = [_SAYS[s.style.language].format(label=_lower(r.label), value=r.said.both) for r in rows]
        gap = "" if s.style.language in ("zh", "ja") else " "
        lines = s.wrapped(gap.join(t[0].upper() + t[1:] for t in said), RIGHT - LEFT, 8.5)
        if y < 70 + 12 * len(lines):
            y = s.page()
        s.put(LEFT, y, s.section(section), size=11, bold=True)
        y -= 15
        for line in lines:
            s.put(LEFT, y, line, size=8.5)
            y -= 12
        y -= 10


def _lower(label: str) -> str:
    return label[0].lower() + label[1:] if label[1:2].islower() else label


def cards(s: Sheet) -> None:
    """Big numbers over their names, then rows whose metric and imperial cells are glued."""
    s.title()
    first = [Row(s.word(e), s.say(e.name), e.name) for e in _entries(s) if e.name not in s.left_out][:3]
    for index, row in enumerate(first):
        x = LEFT + 176 * index
        s.fill(x, HEIGHT - 120, 166, 50, "#eeeeee")
        s.put(x + 10, HEIGHT - 96, row.said.metric, size=16, bold=True)
        s.put(x + 10, HEIGHT - 113, row.label, size=7)
    y = HEIGHT - 150
    for section in (*SECTIONS[s.machine.kind], "service"):
        rows = [r for r in s.rows(section) if r.name not in {f.name for f in first}]
        if not rows:
            continue
        if y < 60 + 13 * len(rows):
            y = s.page()
        s.fill(LEFT, y - 4, RIGHT - LEFT, 14, "#404040")
        s.put(LEFT + 4, y, s.section(section), bold=True, ink="#ffffff")
        y -= 16
        for row in rows:
            s.put(LEFT, y, row.label)
            s.put(330, y, row.said.metric + row.said.imperial)
            y -= 12
        y -= 8


TUNED = {f.__name__: f for f in (ruled, leaders, lattice, wrapped, matrix, prose, cards)}
