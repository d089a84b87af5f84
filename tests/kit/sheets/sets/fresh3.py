"""The set "fresh3": other machines of all ten types, seven other layouts, other wordings, units as each country has."""

from __future__ import annotations

import re
from dataclasses import replace

from reportlab.lib.pagesizes import A4, landscape

from kit.sheets.machines import rounded
from kit.sheets.typeset import Style
from kit.sheets.worded import Flow, Row, Said, Worded, Wording, lines

_INK, _RED, _MIST = "#1b2a41", "#9c1c1c", "#eef1f5"
_NOTE = {
    "en": "¹ With standard equipment, full tank and 75 kg operator.  ² Varies by 25 – 60 mm with tires or shoes.",
    "de": "¹ Mit Standardausrüstung, vollem Tank, 75 kg Fahrer.  ² Je nach Reifen oder Bodenplatten ± 25 bis 60 mm.",
    "fr": "¹ Avec équipement standard, plein fait et opérateur de 75 kg.  ² Écart de 25 à 60 mm selon la monte.",
    "es": "¹ Con equipo estándar, depósito lleno y operador de 75 kg.  ² Varía de 25 a 60 mm según la configuración.",
    "zh": "¹ 标准配置，燃油加满，含75 kg驾驶员。 ² 因配置不同可能相差25 – 60 mm",
    "ja": "¹ 標準仕様、燃料満タン、オペレータ75 kgを含む。 ² 装着品により25 – 60 mm変わります。",
}  # fmt: skip
_TEXT = {
    "engine": {
        "en": "Six-cylinder, four-stroke turbocharged diesel meeting Stage V.",
        "de": "Sechszylinder-Viertakt-Dieselmotor mit Turbolader, Stufe V.",
        "fr": "Diesel à six cylindres et quatre temps, suralimenté, Stage V.",
        "es": "Motor diésel de seis cilindros y cuatro tiempos, turboalimentado.",
        "zh": "直列六缸四冲程涡轮增压柴油机。", "ja": "水冷4サイクル直列6気筒ターボ付ディーゼルエンジン。"},
    "hydraulics": {
        "en": "Closed-center load-sensing system with variable displacement pumps.",
        "de": "Load-Sensing-System mit Verstellpumpen.",
        "fr": "Circuit à détection de charge, pompes à débit variable.",
        "es": "Sistema sensible a la carga con bombas de caudal variable.",
        "zh": "负荷传感变量液压系统。", "ja": "可変容量ポンプによる負荷感応システム。"},
}  # fmt: skip
_UNITS = {
    "de": {"L/min": "l/min", "rpm": "1/min", "L": "l", "kN·m": "kNm"},
    "fr": {"L/min": "l/min", "rpm": "tr/min", "L": "l"},
    "es": {"L/min": "l/min"},
    "zh": {"rpm": "r/min"},
    "ja": {"rpm": "min-1"},
}
_BRITISH = {"L/min": "l/min", "L": "litres", "kN·m": "kNm", "N·m": "Nm"}
_AMERICAN = {"gal/min": "gpm", "lbf·ft": "lb-ft", "yd³": "cu yd"}
_ABOUT = {"en": "approx. ", "de": "ca. ", "fr": "env. ", "es": "aprox. ", "zh": "约\u3000", "ja": "約\u3000"}
_ABOUTS = {"Operating Weight", "Empty Weight", "Shipping Weight", "Chassis Weight", "Counterweight Weight"}
_BOTH_WAYS = {"Maximum Steering Angle", "Articulation Angle"}
_AT_MOST = {"Raise Time", "Lower Time", "Total Cycle Time", "Maximum Travel Speed", "Turning Radius", "Body Raise Time"}
_AT_LEAST = {"Breakout Force", "Rimpull", "Drawbar Pull"}
_MARKS = {"Operating Weight": "¹", "Ground Clearance": "²", "Empty Weight": "¹", "Overall Width": "²"}
_SIZES = ("Overall Length", "Overall Width", "Overall Height")
_BY_SIZES = {"articulated_dump_truck", "rigid_dump_truck", "grader", "mobile_crane"}
"""Types whose three overall sizes leave no doubt: no wider bucket, no higher handrail."""
_LWH = {
    "en": "Overall dimensions (L × W × H)",
    "de": "Gesamtmaße (Länge × Breite × Höhe)",
    "es": "Dimensiones totales (largo × ancho × alto)",
    "zh": "外形尺寸（长度×宽度×高度）",
    "ja": "全長×全幅×全高",
}
_TRIPLE = {"en": "bore × rod × stroke", "de": "Kolben × Stange × Hub", "fr": "alésage × tige × course",
           "es": "diámetro × vástago × carrera", "zh": "缸径×杆径×行程", "ja": "内径×ロッド径×ストローク"}  # fmt: skip
_MODEL = {"en": "Model", "de": "Modell", "fr": "Modèle", "es": "Modelo", "zh": "型号", "ja": "機種"}


def _title(s: Wording) -> float:
    """The model's name between rules, notes at the foot; the edge below the rules."""
    width, height = s.size
    s.line(36, height - 24, width - 36, weight=2)
    s.put(36, height - 44, s.machine.name, size=18, bold=True, ink=_INK)
    s.line(36, height - 52, width - 36, weight=0.5)
    s.put(36, 20, s.one_of(_NOTE), size=5.5, ink="#555555")
    return height - 62


def _local(s: Wording, said: Said) -> Said:
    """A value with its units as the country writes them."""
    style = s.style
    units = _UNITS.get(style.language, _BRITISH if style.language == "en" and style.wording else {})
    number, _, unit = said.imperial.rpartition(" ")
    return Said(said.number, units.get(said.unit, said.unit), f"{number} {_AMERICAN.get(unit, unit)}".strip())


def _cut(imperial: str) -> tuple[str, str]:
    """An imperial text as number and unit; feet and inches have their marks in the number, or are told as "ft-in"."""
    found = re.fullmatch(r"(\S+) ([a-z].*)", imperial)
    if found and " ft " not in imperial:
        return found[1], found[2]
    return imperial, "ft-in" if "-" in imperial else ""


def _dressed(s: Wording, name: str, number: str) -> str:
    """A number with "approx.", ±, ≤ or a tolerance, where such stand.

    A sign is set with a wide space: PDFium overlooks a text of one letter in a font that it does not have.
    """
    language = s.style.language
    if name in _ABOUTS:
        return _ABOUT[language] + number
    if name in _BOTH_WAYS:
        return "±" + number
    if language == "zh" and name in _AT_MOST:
        return "≤\u3000" + number
    if language == "zh" and name in _AT_LEAST:
        return "≥\u3000" + number
    if language == "zh" and name in ("Dumping Clearance", "Dumping Reach") and not s.style.metres:
        return number + "±50"
    return number


def _rows(s: Wording, section: str, *, forms: bool = False, sizes: bool = False, marks: bool = False) -> list[Row]:
    """The rows of a section, dressed. `forms`: cylinders as count – bore × rod × stroke; `sizes`: L × W × H as one."""
    found = []
    skip: frozenset[str] = frozenset()
    if sizes and section == "dimensions" and s.machine.kind in _BY_SIZES and all(s.prints(name) for name in _SIZES):
        skip = frozenset(_SIZES)
        parts = [s.say(name) for name in _SIZES]
        if len({said.unit for said in parts}) == 1:
            found.append(Row(_LWH[s.style.language], Said(" × ".join(said.number for said in parts), parts[0].unit),
                             _SIZES[0]))  # fmt: skip
        else:
            skip = frozenset()
    rows = _triples(s) if forms and section == "cylinders" else s.rows(section, skip=skip)
    for row in rows:
        said = _local(s, row.said)
        label = row.label + _MARKS.get(row.name, "") if marks and " > " not in row.label else row.label
        found.append(Row(label, replace(said, number=_dressed(s, row.name, said.number)), row.name))
    return found


def _triples(s: Wording) -> list[Row]:
    """Cylinders by bore, rod and stroke on one line where all three are printed, else a row for each measure."""
    found = []
    rest = s.rows("cylinders")
    for one in lines(s.file)[s.machine.kind]:
        names = [f"{one.name[1:]} Cylinder {part}" for part in ("Bore", "Rod Diameter", "Stroke")]
        if not one.name.startswith("@"):
            continue
        own = [row for row in rest if row.name in names]
        if len(own) == 3:
            text = " × ".join(row.said.number for row in sorted(own, key=lambda row: names.index(row.name)))
            label = f"{s.of(one)} – {s.one_of(_TRIPLE)}"
            found.append(Row(label, Said(f"{one.place} – {text}", "mm"), names[0]))
        else:
            found += own
    return found


def _both(said: Said, form: str) -> str:
    """A value in both systems, in a form as "{} / {}"."""
    return form.format(said.metric, said.imperial) if said.imperial else said.metric


def ledger(s: Wording) -> None:
    """Two columns; label, unit, value, each system on a line of its own, the second without a label. Sentences."""
    flow = Flow(s, ((36, 288), (308, 560)), _title(s), 40, 800)
    for section in s.sections():
        rows = _rows(s, section, marks=True)
        if not rows:
            continue
        flow.keep(30 + 11 * min(len(rows), 10))
        x0, x1, y = flow.room(15)
        s.put(x0, y - 10, s.section(section), size=9.5, bold=True, ink=_RED)
        for text in s.wrapped(s.one_of(_TEXT[section]), x1 - x0, 6.8) if section in _TEXT else []:
            x0, x1, y = flow.room(10)
            s.put(x0, y - 6.5, text, size=6.8, ink="#444444")
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 138, 7)
            values = [(row.said.unit, row.said.number)]
            if row.said.imperial:
                number, unit = _cut(row.said.imperial)
                values.append((unit, number))
            x0, x1, y = flow.room(9.0 * max(len(texts), len(values)) + 3)
            s.line(x0, y, x1, weight=0.25)
            for index, text in enumerate(texts):
                s.put(x0, y - 8 - 9 * index, text, size=7)
            for index, (unit, number) in enumerate(values):
                s.put(x0 + 148, y - 8 - 9 * index, unit, size=7)
                s.put(x1, y - 8 - 9 * index, number, size=7, align="r")
        flow.room(9)


def strips(s: Wording) -> None:
    """Tables laid on their sides: columns headed by label and unit in brackets, a row for each of two models."""
    top = _title(s)
    letters, _, digits = s.machine.name.rpartition(" ")
    place = s.dice.randrange(2)
    names = [s.machine.name if i == place else f"{letters} {int(digits) + 18 * (i - place)}" for i in range(2)]
    s.config = s.machine.name
    flow = Flow(s, ((36, 560),), top, 40, 800)
    for section in [one for one in s.sections() if one not in ("tyres", "cab")]:
        rows = _rows(s, section)
        for start in range(0, len(rows), 6):
            part = rows[start : start + 6]
            heads = []
            for row in part:
                unit = [f"[{row.said.unit}]"] if row.said.unit else []
                heads.append([*s.wrapped(s.joined(row.label), 70, 6.5), *unit])
            height = 8.5 * max(map(len, heads)) + 5
            first = 15 if start == 0 else 0
            *_, y = flow.room(first + height + 28 + 7)
            if first:
                s.put(36, y - 11, s.section(section), size=9, bold=True, ink=_INK)
            y -= first
            edge = 110.0 + 75 * len(part)
            s.fill(36, y - height, edge - 36, height, _MIST)
            s.put(39, y - 9, s.one_of(_MODEL), size=6.5, bold=True)
            for index, texts in enumerate(heads):
                for number, text in enumerate(texts):
                    s.put(147.5 + 75 * index, y - 8.5 - 8.5 * number, text, size=6.5, align="c")
            for line, name in enumerate(names):
                base = y - height - 10 - 14 * line
                s.put(39, base, name, size=7, bold=True)
                for index, row in enumerate(part):
                    s.put(147.5 + 75 * index, base, _other(s, row, line - place, 0.07).number, size=7, align="c")
            for x in (36.0, *(110.0 + 75 * i for i in range(len(part) + 1))):
                s.line(x, y, x, y1=y - height - 28)
            for rule in (y, y - height, y - height - 14, y - height - 28):
                s.line(36, rule, edge)


def _other(s: Wording, row: Row, steps: int, share: float) -> Said:
    """What stands for another model, so many steps away: a value that grows with the size differs."""
    if steps == 0 or row.name not in s.machine.values or row.said.unit in ("°", "bar", "MPa", "kPa", ""):
        return row.said
    value = rounded(s.machine.kind, row.name, s.machine.values[row.name] * (1 + share * steps))
    said = _local(s, s.say(row.name, value, note=False))
    return replace(said, number=_dressed(s, row.name, said.number))


def merged(s: Wording) -> None:
    """A grid: the section a cell left of its rows, item with its unit in brackets, value; L × W × H as one item."""
    flow = Flow(s, ((36, 560),), _title(s), 40, 800)
    xs = (36.0, 128.0, 400.0, 560.0)
    for section in s.sections():
        rows = _rows(s, section, forms=True, sizes=True)
        head = s.wrapped(s.section(section), xs[1] - xs[0] - 8, 8)
        while rows:
            high = max(13.0, (10.0 * len(head) + 6) / len(rows))
            if flow.y - high * min(len(rows), 6) < flow.bottom:
                flow.keep(700)
            fits = max(int((flow.y - flow.bottom) / high), 1)
            part, rows = rows[:fits], rows[fits:]
            *_, top = flow.room(high * len(part))
            bottom = top - high * len(part)
            s.fill(xs[0], bottom, xs[1] - xs[0], top - bottom, _MIST)
            for index, text in enumerate(head):
                s.put((xs[0] + xs[1]) / 2, (top + bottom) / 2 + 5 * len(head) - 8 - 10 * index, text, size=8,
                      bold=True, align="c")  # fmt: skip
            for index, row in enumerate(part):
                y = top - high * index
                base = y - high / 2 - 2.5
                unit = f" ({row.said.unit})" if row.said.unit else ""
                s.put(xs[1] + 4, base, s.joined(row.label) + unit, size=7.3)
                value = row.said.number + (f" ({row.said.imperial})" if row.said.imperial else "")
                s.put((xs[2] + xs[3]) / 2, base, value, size=7.3, align="c")
                s.line(xs[1], y, xs[3])
            s.line(xs[0], top, xs[3])
            s.line(xs[0], bottom, xs[3])
            for x in xs:
                s.line(x, top, x, y1=bottom)


def trio(s: Wording) -> None:
    """Landscape; each section's bar names three models, each cell holds both systems."""
    s.paper(landscape(A4))
    top = _title(s)
    place = s.dice.randrange(3)
    letters, _, digits = s.machine.name.rpartition(" ")
    names = [s.machine.name if i == place else f"{letters} {int(digits) + 13 * (i - place)}" for i in range(3)]
    s.config = s.machine.name
    flow = Flow(s, ((36, 806),), top, 40, 560)
    xs = (330.0, 490.0, 650.0)
    for section in [one for one in s.sections() if one not in ("tyres", "cab")]:
        rows = _rows(s, section, marks=True)
        page = -1
        if rows:
            flow.keep(16 + 12 * min(len(rows), 8))
        for row in rows:
            *_, y = flow.room(12)
            if flow.place != page:  # the bar, and again where a section goes on overleaf
                page = flow.place
                s.fill(36, y - 13, 770, 13, _INK)
                s.put(40, y - 9.5, s.section(section), size=8, bold=True, ink="#ffffff")
                for x, name in zip(xs, names, strict=True):
                    s.put(x, y - 9.5, name, size=8, bold=True, ink="#ffffff")
                *_, y = flow.room(13)
                y -= 1
            s.put(40, y - 8.5, s.joined(row.label), size=7)
            for i, x in enumerate(xs):
                s.put(x, y - 8.5, _both(_other(s, row, i - place, 0.08), "{} ({})"), size=7)
            s.line(36, y - 12, 806, weight=0.2)
        flow.room(7 if rows else 0)


def slash(s: Wording) -> None:
    """Two columns, shaded headings; metric / imperial; a label that is too long goes on under its first line."""
    flow = Flow(s, ((36, 290), (306, 560)), _title(s), 40, 800)
    for section in s.sections():
        rows = _rows(s, section, forms=True, sizes=True, marks=True)
        if not rows:
            continue
        flow.keep(18 + 11 * min(len(rows), 10))
        x0, x1, y = flow.room(17)
        s.fill(x0, y - 13, x1 - x0, 13, _MIST)
        s.put(x0 + 3, y - 9.5, s.section(section).upper(), size=8, bold=True, ink=_INK)
        for row in rows:
            value = _both(row.said, "{} / {}")
            texts = s.wrapped(s.joined(row.label), min(x1 - x0 - s.width(value, 7) - 12, 150), 7)
            x0, x1, y = flow.room(8.5 * len(texts) + 4)
            for index, text in enumerate(texts):
                s.put(x0 + 3 + 6 * (index > 0), y - 8 - 8.5 * index, text, size=7)
            s.put(x1 - 3, y - 8, value, size=7, align="r")
            s.line(x0, y - 8.5 * len(texts) - 3, x1, weight=0.2)
        flow.room(8)


def gutter(s: Wording) -> None:
    """Landscape, two blocks: labels at the right against the values, which begin at a middle line; no rules."""
    s.paper(landscape(A4))
    flow = Flow(s, ((36, 410), (430, 806)), _title(s), 40, 560)
    for section in s.sections():
        rows = _rows(s, section, forms=True, sizes=True)
        if not rows:
            continue
        flow.keep(20 + 11.5 * min(len(rows), 8))
        x0, _, y = flow.room(18)
        s.put(x0 + 205, y - 11, s.section(section), size=9, bold=True, align="c", ink=_RED)
        for row in rows:
            texts = s.wrapped(s.joined(row.label), 192, 7.2)
            x0, _, y = flow.room(9.0 * len(texts) + 2.5)
            for index, text in enumerate(texts):
                s.put(x0 + 200, y - 8 - 9 * index, text, size=7.2, align="r", ink="#555555")
            s.put(x0 + 210, y - 8 - 4.5 * (len(texts) - 1), _both(row.said, "{}   {}"), size=7.2, bold=True)
        flow.room(6)


def tagged(s: Wording) -> None:
    """Three ruled blocks; the units follow the label, "Dump height mm (ft-in)", and the value has none."""
    flow = Flow(s, ((36, 204), (214, 382), (392, 560)), _title(s), 40, 800)
    for section in s.sections():
        rows = _rows(s, section)
        if not rows:
            continue
        flow.keep(18 + 18 * min(len(rows), 7))
        x0, x1, y = flow.room(15)
        s.fill(x0, y - 13, x1 - x0, 13, _RED)
        s.put((x0 + x1) / 2, y - 9.5, s.section(section), size=7.5, bold=True, align="c", ink="#ffffff")
        for row in rows:
            number, unit = _cut(row.said.imperial)
            units = f"{row.said.unit} ({unit})" if unit else row.said.unit
            value = row.said.number + (f" ({number})" if number else "")
            label = s.joined(row.label) + (f" {units}" if units else "")
            texts = s.wrapped(label, x1 - x0 - s.width(value, 6.8) - 12, 6.8)
            x0, x1, y = flow.room(8.6 * len(texts) + 3)
            for index, text in enumerate(texts):
                s.put(x0 + 2, y - 8 - 8.6 * index, text, size=6.8)
            s.put(x1 - 2, y - 8 - 8.6 * (len(texts) - 1) / 2, value, size=6.8, align="r")
            s.line(x0, y - 8.6 * len(texts) - 3, x1, weight=0.3)
        flow.room(8)


_DE = Style("de", 0, group=".", point=",", pressure="bar")
_FR = Style("fr", 0, group="\u00a0", point=",", pressure="bar")
_ES = Style("es", 0, group=".", point=",", pressure="bar")
STYLES = {
    "en_us": Style("en", 0, imperial=True, pressure="kPa"),
    "en_usf": Style("en", 0, imperial=True, feet="{} ft {} in"),
    "en_usm": Style("en", 0, metres=True, imperial=True, pressure="bar"),
    "en_uk": Style("en", 1, imperial=True, pressure="bar", feet="{}-{}"),
    "en_gb": Style("en", 1, group=" ", pressure="bar"),
    "en_gbm": Style("en", 1, metres=True, pressure="bar", tonnes=True),
    "de": _DE,
    "de_2": replace(_DE, wording=1, group=" ", metres=True, tonnes=True),
    "fr": _FR,
    "fr_2": replace(_FR, wording=1, metres=True),
    "es": _ES,
    "es_2": replace(_ES, wording=1, group=" ", pressure="MPa"),
    "zh": Style("zh", 0, group=""),
    "zh_2": Style("zh", 1),
    "ja": Style("ja", 0),
    "ja_2": Style("ja", 1, metres=True),
}
FRESH3 = Worded(
    "fresh3",
    "K",
    {f.__name__: f for f in (ledger, strips, merged, trio, slash, gutter, tagged)},
    STYLES,
    {
        "wheel_loader": "ledger:en_us trio:en_usf slash:en_usm tagged:en_uk gutter:en_gb strips:en_gbm tagged:de "
        "ledger:de_2 slash:fr gutter:fr_2 merged:es trio:es_2 merged:zh strips:zh_2 merged:ja ledger:ja_2",
        "excavator": "slash:en_us tagged:en_usf trio:en_usm ledger:en_uk merged:en_gb gutter:en_gbm strips:de "
        "slash:de_2 ledger:fr tagged:fr_2 gutter:es merged:es_2 trio:zh merged:zh_2 slash:ja strips:ja_2",
        "articulated_dump_truck": "gutter:en_us ledger:en_uk merged:zh",
        "rigid_dump_truck": "tagged:en_us slash:en_gb ledger:es",
        "dozer": "slash:en_usf strips:en_gb gutter:ja tagged:fr",
        "grader": "ledger:en_usm gutter:en_uk slash:de",
        "backhoe_loader": "trio:en_us tagged:en_uk slash:zh_2",
        "forklift": "strips:en_us merged:en_gb ledger:de gutter:fr",
        "mobile_crane": "merged:en_usf slash:en_gbm ledger:ja",
        "skid_steer": "ledger:en_us gutter:en_gb tagged:es",
    },
)
