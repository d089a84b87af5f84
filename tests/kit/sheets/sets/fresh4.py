"""The set "fresh4": other machines of all ten types on pages as makers lay theirs out, each in a maker's own words."""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby

from kit.sheets.typeset import _CJK, Style, Truth
from kit.sheets.worded import Flow, Row, Said, Worded, Wording, lines

_INK, _BAR, _PALE, _SUN = "#23272b", "#1f3a5f", "#eceff1", "#e0b000"
_NOTES = {
    "en": "Specifications are subject to change without notice. Illustrations may include optional equipment.",
    "de": "Änderungen vorbehalten. Abbildungen können Sonderausrüstungen enthalten.",
    "fr": "Sous réserve de modifications sans préavis. Les illustrations peuvent montrer des options.",
    "es": "Datos sujetos a cambios sin previo aviso. Las ilustraciones pueden incluir equipo opcional.",
    "zh": "产品规格如有变更，恕不另行通知。图中可能包含选装件。",
    "ja": "仕様は予告なく変更することがあります。写真はオプションを含む場合があります。",
}
_WITH = {
    "en": "Weight with full tank, coolant, lubricants and 75 kg operator.",
    "de": "Gewicht mit vollem Tank, Kühlmittel, Schmierstoffen und Fahrer (75 kg).",
    "fr": "Poids avec pleins et opérateur de 75 kg.",
    "es": "Peso con depósito lleno, lubricantes y operador de 75 kg.",
    "zh": "质量含燃油、冷却液、润滑油及75 kg驾驶员。",
    "ja": "質量は燃料満タン、オペレータ75 kgを含みます。",
}
_UNITS = {
    "de": {"L/min": "l/min", "rpm": "min-1", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
    "fr": {"L/min": "l/min", "rpm": "tr/min", "L": "l"},
    "es": {"rpm": "rpm", "L/min": "l/min", "L": "l"},
    "zh": {"rpm": "r/min"},
    "ja": {"rpm": "min-1"},
    "en": {"L/min": "l/min", "L": "l", "kN·m": "kNm", "N·m": "Nm"},
}
_AMERICAN = {"lbf·ft": "lbf-ft"}
_SPANISH = {"in": "pulg", "psi": "lb/pulg²", "gal/min": "gal/min", "lbf·ft": "lb-pie", "ft/min": "pies/min",
            "ft": "pies", "in³": "pulg³"}  # fmt: skip
_MORE = {"L": (0.264172, 1, "gal"), "N·m": (0.737562, 0, "lbf·ft"), "m": (3.28084, 0, "ft")}
_SAID_IN = {"en": "Unit", "de": "Einheit", "fr": "Unité", "es": "Unidad", "zh": "单位", "ja": "単位"}
_ITEM = {"en": "Description", "de": "Bezeichnung", "fr": "Désignation", "es": "Descripción", "zh": "项目", "ja": "項目"}
_VALUE = {"en": "Value", "de": "Wert", "fr": "Valeur", "es": "Valor", "zh": "参数", "ja": "仕様値"}
_RAMS = {
    "en": "Number of cylinders – bore × stroke × rod diameter",
    "de": "Anzahl – Bohrung × Hub × Kolbenstange",
    "fr": "Nombre – alésage × course × diamètre de tige",
    "es": "Cantidad – diámetro × carrera × vástago",
    "zh": "数量 – 缸径×行程×杆径",
    "ja": "本数－内径×行程×ロッド径",
}
_LETTERED = ("working", "dimensions")
_AT_LEAST = {"Breakout Force", "Rimpull", "Drawbar Pull", "Bucket Digging Force", "Arm Digging Force"}


# ---- rows --------------------------------------------------------------------------------------------------------
def _said(s: Wording, said: Said, *, extra: bool = False) -> Said:
    """A value with its units as the country writes them; `extra`: a distractor, whose imperial text is made here."""
    style = s.style
    if extra and style.imperial and said.unit:
        value = float(said.number.replace(style.group, "").replace(style.point, "."))
        factor, decimals, name = _MORE.get(said.unit, (0.0, 0, ""))
        if said.unit == "L" and value < 10:  # what an engine displaces
            factor, decimals, name = 61.0237, 0, "in³"
        text = f"{s.digits(value * factor, decimals)} {name}" if name else s._imperial(said.unit, value)
        said = replace(said, imperial=text)
    metric = {} if style.language == "en" and style.wording == 0 else _UNITS[style.language]
    number, _, unit = said.imperial.rpartition(" ")
    unit = (_SPANISH if style.language == "es" else _AMERICAN).get(unit, unit)
    return Said(said.number, metric.get(said.unit, said.unit), f"{number} {unit}".strip())


def _rows(s: Wording, section: str) -> list[Row]:
    """The rows of a section in the order of the words, distractors last; groups stay together."""
    labels = [s.of(one) for part in (s.machine.kind, "distractors") for one in lines(s.file)[part]]
    found = s.rows(section)
    if section != "cylinders":
        found.sort(key=lambda row: labels.index(row.label))
    return [Row(row.label, _said(s, row.said, extra=not row.name), row.name) for row in found]


def _grouped(rows: list[Row]) -> list[tuple[str, Row | None, bool]]:
    """Label, row and whether it stands under a group: a group's own line has no row."""
    found: list[tuple[str, Row | None, bool]] = []
    for group, some in groupby(rows, lambda row: row.label.partition(" > ")[0]):
        own = list(some)
        if len(own) > 1 and " > " in own[0].label:
            found.append((group, None, False))
            found += [(row.label.partition(" > ")[2], row, True) for row in own]
        else:
            found += [("", row, False) for row in own]
    return found


def _full(s: Wording, label: str, row: Row | None) -> str:
    """The label to print: the group's item, or group and item in one."""
    return label or (s.joined(row.label) if row else "")


def _lettered(s: Wording, section: str) -> dict[str, str]:
    """The drawing's letters of a section's wanted rows, by name."""
    own = [one.name for one in lines(s.file)[s.machine.kind] if one.place == section and s.prints(one.name)]
    return {name: chr(65 + i) for i, name in enumerate(own[:26])}


# ---- pages -------------------------------------------------------------------------------------------------------
def _foot(s: Wording) -> None:
    """Notes at the foot of the page."""
    s.put(36, 26, s.one_of(_WITH), size=5.5, ink="#666666")
    s.put(36, 18, s.one_of(_NOTES), size=5.5, ink="#666666")


def _head(s: Wording, color: str) -> float:
    """The model's name over a bar; the edge below it."""
    s.put(36, 800, s.machine.name, size=20, bold=True, ink=_INK)
    s.fill(36, 788, 523, 5, color)
    _foot(s)
    return 776.0


def _outline(s: Wording, x: float, y: float, width: float, letters: list[str]) -> None:
    """A machine from the side, 92 high, with its dimensions' letters in rings; `y` is the upper edge."""
    base = y - 78
    s.canvas.setLineWidth(0.4)
    for wheel in (0.3, 0.62):
        s.canvas.circle(x + wheel * width, base + 13, 13, stroke=1, fill=0)
    s.canvas.rect(x + 0.24 * width, base + 16, 0.46 * width, 16, stroke=1, fill=0)
    s.canvas.rect(x + 0.42 * width, base + 32, 0.13 * width, 24, stroke=1, fill=0)
    s.line(x + 0.3 * width, base + 30, x + 0.14 * width, y1=base + 10, weight=1.2)
    s.line(x + 0.08 * width, base, x + 0.92 * width, weight=0.6)
    half = (len(letters) + 1) // 2
    for i, letter in enumerate(letters[:half]):
        s.ring(x + (0.06 + 0.88 * (i + 0.5) / half) * width, base - 9, letter, size=6)
    for i, letter in enumerate(letters[half:]):
        s.ring(x + (0.06 + 0.88 * (i + 0.5) / half) * width, y - 10, letter, size=6)


# ---- layouts -----------------------------------------------------------------------------------------------------
def cat(s: Wording) -> None:
    """Small tables in two columns, headings over a thick rule; metric and imperial in columns of their own."""
    flow = Flow(s, ((36, 290), (305, 559)), _head(s, _SUN), 42, 806)
    for section in s.sections():
        rows = _rows(s, section)
        if not rows:
            continue
        flow.keep(min(26 + 13 * len(rows), 600))
        x0, x1, y = flow.room(20)
        s.put(x0, y - 11, s.section(section), size=10, bold=True)
        s.line(x0, y - 15, x1, weight=1.4)
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 124 if s.style.imperial else 178, 7)
            x0, x1, y = flow.room(8.6 * len(texts) + 4)
            for i, text in enumerate(texts):
                s.put(x0, y - 8 - 8.6 * i, text, size=7)
            s.put(x0 + (130 if s.style.imperial else 186), y - 8, row.said.metric, size=7)
            s.put(x0 + 195, y - 8, row.said.imperial, size=7)
            s.line(x0, y - 8.6 * len(texts) - 3, x1, weight=0.2)
        flow.room(9)


def komatsu(s: Wording) -> None:
    """Boxed headings, dotted leaders; cylinders as count – bore × stroke × rod; a lettered drawing over its table."""
    flow = Flow(s, ((36, 290), (305, 559)), _head(s, _BAR), 42, 806)
    for section in s.sections():
        rows = _products(s) if section == "cylinders" else _rows(s, section)
        if not rows:
            continue
        letters = _lettered(s, section) if section in _LETTERED else {}
        flow.keep(min((118 if letters else 32) + 12.5 * (len(rows) + 2), 600))
        x0, x1, y = flow.room(18)
        s.fill(x0, y - 14, x1 - x0, 14, _BAR)
        s.put(x0 + 5, y - 10.5, s.section(section).upper(), size=8.5, bold=True, ink="#ffffff")
        if letters:
            x0, x1, y = flow.room(96)
            _outline(s, x0, y, x1 - x0, list(letters.values()))
        if section == "cylinders" and any("×" in row.said.number for row in rows):
            x0, _, y = flow.room(11)
            s.put(x0, y - 8, s.one_of(_RAMS) + (":" if s.style.language not in _CJK else ""), size=7)
        for label, row, inner in _grouped(rows):
            flow.keep(48 if row is None else 12)  # a group and its items stay together
            value = row.said.metric + (f"  {row.said.imperial}" if row.said.imperial else "") if row else ""
            indent = 22.0 if letters else 9.0 if inner or (row and "×" in row.said.number) else 0.0
            room = (x1 - x0) - indent - s.width(value, 7) - 14
            texts = s.wrapped(_full(s, label, row), room, 7)
            x0, x1, y = flow.room(9 * len(texts) + 2.5)
            for i, text in enumerate(texts):
                s.put(x0 + indent, y - 8 - 9 * i, text, size=7)
            if row is None:
                continue
            base = y - 8 - 9 * (len(texts) - 1)
            if letters.get(row.name):
                s.put(x0 + 6, y - 8, letters[row.name], size=7, bold=True)
            s.put(x1, base, value, size=7, align="r")
            start = x0 + indent + s.width(texts[-1], 7) + 3
            dots = int((x1 - s.width(value, 7) - 3 - start) / s.width(".", 7))
            s.put(x1 - s.width(value, 7) - 3, base, "." * max(dots, 0), size=7, align="r")
        flow.room(8)


def _products(s: Wording) -> list[Row]:
    """The cylinders: those with bore, stroke and rod as one product, else a row for each measure."""
    rest, found = _rows(s, "cylinders"), []
    for one in lines(s.file)[s.machine.kind]:
        if not one.name.startswith("@"):
            continue
        names = [f"{one.name[1:]} Cylinder {part}" for part in ("Bore", "Stroke", "Rod Diameter")]
        own = sorted((row for row in rest if row.name in names), key=lambda row: names.index(row.name))
        if len(own) == 3:
            text = " × ".join(row.said.metric for row in own)
            found.append(Row(s.of(one), Said(f"{one.place} – {text}", ""), names[0]))
        else:
            found += own
    return sorted(found, key=lambda row: "×" not in row.said.number)


def volvo(s: Wording) -> None:
    """Tables over the whole width: item, unit, and a column for each of two models; groups over their items."""
    place = s.dice.randrange(2)
    letters, _, digits = s.machine.name.rpartition(" ")
    names = [s.machine.name if i == place else f"{letters} {int(digits) + 20 * (i - place)}" for i in range(2)]
    s.config = s.machine.name
    top = _head(s, "#5b6770")
    flow = Flow(s, ((36, 559),), top, 42, 806)
    for section in s.sections():
        rows = _rows(s, section)
        if not rows:
            continue
        flow.keep(min(34 + 13 * (len(rows) + 2), 600))
        page = -1
        for label, row, inner in [("", None, False), *_grouped(rows)]:
            if flow.y - (48 if row is None else 12) < flow.bottom or flow.place != page:
                flow.keep(84)
                page = flow.place
                *_, y = flow.room(32)
                s.put(36, y - 12, s.section(section), size=11, bold=True, ink=_INK)
                s.fill(36, y - 30, 523, 13, "#d5dade")
                s.put(40, y - 26.5, s.one_of(_ITEM), size=7.2, bold=True)
                s.put(322, y - 26.5, s.one_of(_SAID_IN), size=7.2, bold=True)
                for x, name in zip((430, 515), names, strict=True):
                    s.put(x, y - 26.5, name, size=7.2, bold=True, align="c")
            if not label and row is None:
                continue
            *_, y = flow.room(12)
            s.put(50 if inner else 40, y - 8.5, _full(s, label, row), size=7.2, bold=row is None)
            s.line(36, y - 12, 559, weight=0.2)
            if row is None:
                continue
            s.put(322, y - 8.5, row.said.unit, size=7.2)
            for i, x in enumerate((430, 515)):
                s.put(x, y - 8.5, _other(s, row, i - place), size=7.2, align="c")
        flow.room(10)


def _other(s: Wording, row: Row, steps: int) -> str:
    """The number of this model (`steps` 0) or of the other, which is some per cent larger or smaller."""
    value = s.machine.values.get(row.name, 0.0)
    if not steps or value < 1.5 or value % 1:
        return row.said.number
    step = 5 if value > 400 else 1
    other = step * round(value * (1 + 0.07 * steps) / step) if value > 60 else round(value) + steps
    return s.say(row.name, float(other), note=False).number


def liebherr(s: Wording) -> None:
    """Two columns; a square before each heading; label, a drawn-out underline, the value at a fixed place."""
    flow = Flow(s, ((36, 290), (305, 559)), _head(s, "#f5c400"), 42, 806)
    for section in s.sections():
        rows = _rows(s, section)
        if not rows:
            continue
        flow.keep(min(22 + 12.5 * (len(rows) + 1), 600))
        x0, _, y = flow.room(20)
        s.fill(x0, y - 12, 9, 9, "#f5c400")
        s.put(x0 + 14, y - 11, s.section(section), size=9.5, bold=True)
        for label, row, inner in _grouped(rows):
            flow.keep(48 if row is None else 12)
            indent = 7.0 if inner else 0.0
            texts = s.wrapped(_full(s, label, row), 150 - indent, 7)
            x0, _, y = flow.room(8.8 * len(texts) + 2.7)
            for i, text in enumerate(texts):
                s.put(x0 + indent, y - 8 - 8.8 * i, text, size=7, bold=row is None)
            if row is None:
                continue
            base = y - 8 - 8.8 * (len(texts) - 1)
            room = 160 - indent - s.width(texts[-1], 7) - 3
            s.put(x0 + 160, base, "_" * int(room / s.width("_", 7)), size=7, align="r", ink="#999999")
            value = row.said.metric + (f" / {row.said.imperial}" if row.said.imperial else "")
            s.put(x0 + 164, base, value, size=7)
        flow.room(8)


def hitachi(s: Wording) -> None:
    """Lengths in lettered tables under "Unit: mm", the bare number in each cell; the rest as label and value."""
    top = _head(s, "#e4572e")
    flow = Flow(s, ((36, 290), (305, 559)), top, 42, 806)
    for section in s.sections():
        rows = _rows(s, section)
        if not rows:
            continue
        table = section in _LETTERED and sum(row.said.unit == "mm" for row in rows) > 3
        letters = _lettered(s, section) if table else {}
        flow.keep(min((130 if table else 20) + 13 * len(rows), 600))
        x0, x1, y = flow.room(17)
        s.put(x0, y - 11, s.section(section).upper(), size=9, bold=True, ink="#c33b16")
        if table:
            x0, x1, y = flow.room(96)
            _outline(s, x0, y, x1 - x0, list(letters.values()))
            x0, x1, y = flow.room(12)
            colon = "：" if s.style.language in _CJK else ": "
            s.put(x1, y - 9, f"{s.one_of(_SAID_IN)}{colon}mm", size=6.5, align="r")
            s.line(x0, y - 12, x1)
        for row in rows:
            plain = table and row.said.unit == "mm"
            value = row.said.number if plain else row.said.metric
            value += f" ({row.said.imperial})" if row.said.imperial else ""
            left = 18 if table else 0
            texts = s.wrapped(s.joined(row.label), 170 - left, 7)
            x0, x1, y = flow.room(8.8 * len(texts) + 3.2)
            for i, text in enumerate(texts):
                s.put(x0 + left, y - 8.5 - 8.8 * i, text, size=7)
            if table:
                s.put(x0 + 7, y - 8.5, letters.get(row.name, ""), size=7, align="c")
            s.put(x1 - 3 if table else x0 + 178, y - 8.5, value, size=7, align="r" if table else "l")
            if table:
                low = y - 8.8 * len(texts) - 3.2
                s.line(x0, low, x1, weight=0.3)
                for x in (x0, x0 + 14, x0 + 190, x1):
                    s.line(x, y, x, y1=low, weight=0.3)
        flow.room(9)


def bobcat(s: Wording) -> None:
    """One column of zebra rows, imperial first where both are printed; the drawing's letter in brackets first."""
    flow = Flow(s, ((90, 505),), _head(s, "#d9480f"), 42, 806)
    for section in s.sections():
        rows = _rows(s, section)
        if not rows:
            continue
        letters = _lettered(s, section) if section in _LETTERED else {}
        flow.keep(min((118 if letters else 22) + 13 * len(rows), 600))
        x0, x1, y = flow.room(19)
        s.put(x0, y - 12, s.section(section), size=11, bold=True, ink="#d9480f")
        if letters:
            x0, x1, y = flow.room(98)
            _outline(s, x0 + 70, y, 270, list(letters.values()))
        for number, row in enumerate(rows):
            x0, x1, y = flow.room(13)
            if number % 2 == 0:
                s.fill(x0, y - 13, x1 - x0, 13, _PALE)
            mark = f"({letters[row.name]}) " if row.name in letters else ""
            value = f"{row.said.imperial} ({row.said.metric})" if row.said.imperial else row.said.metric
            s.put(x0 + 4, y - 9.2, mark + s.joined(row.label), size=7.5)
            s.put(x0 + 285, y - 9.2, value, size=7.5)
        flow.room(9)


def xcmg(s: Wording) -> None:
    """A ruled grid, item, unit and value twice side by side; each section's name in a bar over its rows."""
    flow = Flow(s, ((36, 559),), _head(s, "#b8860b"), 42, 806)
    xs = (36.0, 186.0, 224.0, 297.5, 447.5, 485.5, 559.0)
    heads = (s.one_of(_ITEM), s.one_of(_SAID_IN), s.one_of(_VALUE)) * 2
    for section in s.sections():
        rows = _rows(s, section)
        if not rows:
            continue
        flow.keep(min(34 + 15 * (len(rows) // 2 + 1), 600))
        *_, y = flow.room(15)
        s.fill(36, y - 15, 523, 15, "#f3e3bd")
        s.put(297.5, y - 10.5, s.section(section), size=8.5, bold=True, align="c")
        cells = [(heads, 1)] if section == s.sections()[0] else []
        texts = []
        for row in rows:
            number = row.said.number
            if s.style.language == "zh" and row.name in _AT_LEAST:
                number = "≥\u3000" + number
            texts.append((s.joined(row.label), row.said.unit or "—", number + (
                f" ({row.said.imperial})" if row.said.imperial else "")))  # fmt: skip
        pairs = [texts[i : i + 2] for i in range(0, len(texts), 2)]
        cells += [(tuple(t for one in pair for t in one), 0) for pair in pairs]
        for line, bold in cells:
            wrapped = [s.wrapped(text, xs[i + 1] - xs[i] - 7, 7) for i, text in enumerate(line)]
            tall = 8.6 * max(map(len, wrapped)) + 5
            *_, y = flow.room(tall)
            for i, own in enumerate(wrapped):
                for k, text in enumerate(own):
                    base = y - tall / 2 - 2.4 + 4.3 * (len(own) - 1) - 8.6 * k
                    x = xs[i] + 3 if i % 3 == 0 else (xs[i] + xs[i + 1]) / 2
                    s.put(x, base, text, size=7, align="l" if i % 3 == 0 else "c", bold=bool(bold))
            for x in xs:
                s.line(x, y, x, y1=y - tall)
            s.line(36, y, 559)
            s.line(36, y - tall, 559)
        flow.room(6)


_SYMBOLS = {
    "Rated Capacity": "Q", "Load Center": "c", "Load Distance": "x", "Wheelbase": "y", "Front Tread": "b10",
    "Rear Tread": "b11", "Lowered Mast Height": "h1", "Free Lift Height": "h2", "Lift Height": "h3",
    "Extended Mast Height": "h4", "Overhead Guard Height": "h6", "Seat Height": "h7", "Coupling Height": "h10",
    "Overall Length": "l1", "Length to Fork Face": "l2", "Overall Width": "b1", "Fork Carriage Width": "b3",
    "Ground Clearance Below Mast": "m1", "Ground Clearance": "m2", "Aisle Width": "Ast", "Turning Radius": "Wa",
    "Fork Thickness": "s/e/l",
}  # fmt: skip
_REAR = {"en": "rear", "de": "hinten", "fr": "arrière"}


def vdi(s: Wording) -> None:
    """A truck's sheet: numbered lines with symbol, unit and value; what belongs together is one line, "6/10"."""
    flow = Flow(s, ((60, 535),), _head(s, "#8b1a1a"), 42, 806)
    xs = (60.0, 88.0, 370.0, 405.0, 445.0, 535.0)
    for number, section in enumerate([one for one in s.sections() if _rows(s, one)], 1):
        rows = _rows(s, section)
        flow.keep(min(20 + 12.5 * len(rows), 600))
        *_, y = flow.room(14)
        s.fill(60, y - 14, 475, 14, "#e6d5d5")
        s.put(64, y - 10, s.section(section), size=8, bold=True)
        if number == 1:
            for x, text in zip((407.5 + 17.5, 490), (s.one_of(_SAID_IN), s.machine.name), strict=True):
                s.put(x, y - 10, text, size=7, bold=True, align="c")
        found = [(row.label, row, row.said.number) for row in rows]
        if section != "cylinders":
            found = []
            for group, some in groupby(rows, lambda row: row.label.partition(" > ")[0]):
                own = list(some)
                items = [row.label.partition(" > ")[2] for row in own]
                values = [row.said.number for row in own]
                if own[0].name.startswith("Axle Load"):
                    items, values = [*items, s.one_of(_REAR)], [*values, _rear(s, own[0].name)]
                text = "/".join(items).lower() if s.style.language == "en" else "/".join(items)
                label = f"{group}, {text}" if text else group
                found.append((label, own[0], " / ".join(values)))
        for index, (label, row, value) in enumerate(found, 1):
            *_, y = flow.room(12.5)
            name = "" if len(value.split("/")) not in (1, 3) else _SYMBOLS.get(row.name, "")
            symbol = name if "/" not in name or value.count("/") == 2 else ""
            s.put(74, y - 9, f"{number}.{index}", size=7, align="c")
            s.put(91, y - 9, s.joined(label), size=7)
            s.put(387.5, y - 9, symbol, size=7, align="c")
            s.put(425, y - 9, row.said.unit, size=7, align="c")
            s.put(490, y - 9, value, size=7, align="c")
            for x in xs:
                s.line(x, y, x, y1=y - 12.5, weight=0.3)
            s.line(60, y - 12.5, 535, weight=0.3)
        flow.room(4)


def _rear(s: Wording, name: str) -> str:
    """What the rear axle bears where the front one bears what `name` says; noted as another's answer."""
    values = s.machine.values
    whole = values["Operating Weight"] + ("Unladen" not in name) * values["Rated Capacity"]
    rear = whole - values[name]
    s.allowed[name.replace("Front", "Rear")] = Truth(rear, 1e-6 * rear)
    return s.digits(rear, 0)


_DE = Style("de", 0, group=".", point=",", pressure="bar")
_FR = Style("fr", 0, group="\u00a0", point=",", pressure="bar")
STYLES = {
    "en_us": Style("en", 0, imperial=True, pressure="kPa"),
    "en_usf": Style("en", 0, imperial=True, pressure="kPa", feet="{} ft {} in"),
    "en_int": Style("en", 1, group=""),
    "en_eu": Style("en", 1, group=" ", pressure="bar"),
    "en_dual": Style("en", 1, imperial=True),
    "en_m": Style("en", 1, metres=True, pressure="bar"),
    "en_t": Style("en", 1, metres=True, pressure="bar", tonnes=True),
    "de": _DE,
    "de_2": replace(_DE, wording=1),
    "de_t": replace(_DE, wording=1, metres=True, tonnes=True),
    "fr": _FR,
    "fr_2": replace(_FR, wording=1, pressure="MPa"),
    "es_us": Style("es", 0, imperial=True, group=".", point=",", pressure="kPa", feet="{}' {}\""),
    "es": Style("es", 1, group=".", point=",", pressure="bar"),
    "zh": Style("zh", 0, group=""),
    "zh_2": Style("zh", 1),
    "ja": Style("ja", 0),
    "ja_2": Style("ja", 1, group=""),
}
FRESH4 = Worded(
    "fresh4",
    "N",
    {f.__name__: f for f in (cat, komatsu, volvo, liebherr, hitachi, bobcat, xcmg, vdi)},
    STYLES,
    {
        "wheel_loader": "cat:en_us komatsu:en_dual volvo:en_int liebherr:en_m xcmg:en_eu cat:de liebherr:de_2 cat:fr "
        "volvo:fr_2 cat:es_us hitachi:es xcmg:zh volvo:zh_2 komatsu:ja hitachi:ja_2",
        "excavator": "cat:en_usf hitachi:en_eu komatsu:en_int bobcat:en_us xcmg:en_m liebherr:de volvo:de_2 "
        "liebherr:fr komatsu:fr_2 bobcat:es_us volvo:es cat:zh xcmg:zh_2 hitachi:ja komatsu:ja_2",
        "articulated_dump_truck": "volvo:en_int liebherr:de",
        "rigid_dump_truck": "cat:en_us xcmg:zh",
        "dozer": "komatsu:en_dual liebherr:de_2 xcmg:zh_2",
        "grader": "cat:en_usf komatsu:es",
        "backhoe_loader": "bobcat:en_us volvo:en_eu cat:es_us",
        "forklift": "vdi:en_int vdi:de vdi:fr",
        "mobile_crane": "liebherr:en_t liebherr:de_t hitachi:ja",
        "skid_steer": "bobcat:en_us liebherr:en_dual bobcat:fr",
    },
)
