"""Machines for generated sheets, drawn in plausible proportions.

A machine is a value for every name of `words/words.txt`, in the unit printed there (lengths mm, masses kg, angles deg,
pressures MPa, flows L/min, volumes m3, forces kN, torques kNm, speeds km/h, times s). They scale from one machine of
the type, rounded from published values, with the operating weight, with noise.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

WORDS = Path(__file__).resolve().parent / "words"
LANGUAGES = ("en", "de", "fr", "es", "zh", "ja")
Words = Mapping[str, tuple[str, ...]]


@dataclass(frozen=True)
class Entry:
    """A line of the word list: its first three fields and the wordings by language."""

    name: str
    second: str
    third: str
    words: Words


@cache
def entries(section: str) -> tuple[Entry, ...]:
    """The lines of a part of the word list."""
    found, here = [], ""
    for line in (WORDS / "words.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            here = line.strip("[]")
        elif here == section and line.strip() and not line.startswith("#"):
            name, second, third, *words = (part.strip() for part in line.split("|"))
            by_language = {
                language: tuple(w.strip() for w in text.split(";"))
                for language, text in zip(LANGUAGES, words, strict=True)
            }
            found.append(Entry(name, second, third, by_language))
    return tuple(found)


@dataclass(frozen=True)
class Variant:
    """A configuration: the words of its column by language, and the values that differ."""

    heads: Mapping[str, str]
    values: Mapping[str, float]


@dataclass(frozen=True)
class Machine:
    """`values` by name; `variants` are the configurations, of which the first has the machine's own values."""

    name: str
    kind: str
    values: Mapping[str, float]
    variants: tuple[Variant, ...] = ()


# One machine of each type, rounded, and the power of its size with which a value grows
_LOADER = {
    "Operating Weight": (25510, 3), "Static Tipping Load Straight": (20540, 3),
    "Static Tipping Load Full Turn": (17770, 3), "Breakout Force": (212, 2.6), "Bucket Capacity Heaped": (4.2, 3),
    "Bucket Capacity Struck": (3.6, 3), "Bucket Width": (3170, 1), "Bucket Weight": (2196, 3),
    "Dumping Clearance": (3075, 0.8), "Dumping Reach": (1350, 0.8), "Digging Depth": (115, 0.5),
    "Overall Length": (9185, 1), "Overall Height": (3500, 0.5), "Overall Operating Height": (6090, 0.9),
    "Overall Width": (3060, 1), "Wheelbase": (3450, 1), "Tread": (2300, 1),
    "Hinge Pin Height at Maximum Lift": (4370, 0.9), "Hinge Pin Height at Carry": (580, 0.9),
    "Ground Clearance": (520, 0.7), "Hitch Height": (1200, 0.8), "Height to Top of Stack": (3420, 0.7),
    "Rear Overhang": (2280, 1), "Rack Back at Ground": (43, 0), "Rack Back at Carry": (49, 0),
    "Dump Angle at Maximum Lift": (50, 0), "Turning Radius": (6630, 0.8), "Maximum Steering Angle": (38, 0),
    "Rear Axle Oscillation": (26, 0), "Steering Relief Pressure": (20.6, 0), "Main Relief Pressure": (31.4, 0),
    "Main Pump Flow": (303, 1.8), "Raise Time": (5.9, 0.4), "Dump Time": (1.8, 0.4), "Lower Time": (3.3, 0.4),
    "Maximum Travel Speed": (38.6, 0), "Lift Cylinder Bore": (150, 1), "Lift Cylinder Stroke": (764, 1),
    "Lift Cylinder Rod Diameter": (95, 1), "Tilt Cylinder Bore": (180, 1), "Tilt Cylinder Stroke": (540, 1),
    "Tilt Cylinder Rod Diameter": (100, 1), "Steering Cylinder Bore": (95, 1), "Steering Cylinder Stroke": (441, 1),
    "Steering Cylinder Rod Diameter": (55, 1),
}  # fmt: skip
_EXCAVATOR = {
    "Operating Weight": (23313, 3), "Counterweight": (4370, 3), "Bucket Capacity": (1.05, 3), "Bucket Width": (1114, 1),
    "Bucket Digging Force": (149, 2.4), "Arm Digging Force": (108, 2.4), "Boom Length": (5700, 1),
    "Arm Length": (2925, 1), "Maximum Digging Depth": (6620, 1), "Maximum Vertical Wall Digging Depth": (5980, 1),
    "Maximum Digging Height": (9970, 1), "Maximum Dumping Height": (7110, 1), "Maximum Reach": (9875, 1),
    "Maximum Reach at Ground Line": (9700, 1), "Minimum Swing Radius": (3040, 1), "Overall Length": (9705, 1),
    "Overall Width": (3080, 0.8), "Overall Height": (3190, 0.8), "Cab Height": (3045, 0.4),
    "Upperstructure Width": (2710, 0.9), "Tail Swing Radius": (2940, 0.9), "Counterweight Clearance": (1085, 0.8),
    "Ground Clearance": (440, 0.9), "Track Length": (4450, 1), "Track Length on Ground": (3655, 1),
    "Track Gauge": (2380, 0.8), "Shoe Width": (700, 0.4), "Track Shoes Each Side": (49, 0),
    "Track Rollers Each Side": (9, 0), "Main Relief Pressure": (37.3, 0), "Main Pump Flow": (475, 2),
    "Swing Speed": (12.4, -0.6), "Swing Torque": (69.0, 3.2), "Maximum Travel Speed": (5.5, -0.3),
    "Travel Speed Low": (3.0, -0.3), "Drawbar Pull": (202, 2.6), "Boom Cylinder Bore": (130, 1),
    "Boom Cylinder Stroke": (1334, 1), "Boom Cylinder Rod Diameter": (90, 1), "Arm Cylinder Bore": (135, 1),
    "Arm Cylinder Stroke": (1490, 1), "Arm Cylinder Rod Diameter": (95, 1), "Bucket Cylinder Bore": (115, 1),
    "Bucket Cylinder Stroke": (1105, 1), "Bucket Cylinder Rod Diameter": (80, 1),
}  # fmt: skip
_BASES = {"wheel_loader": _LOADER, "excavator": _EXCAVATOR}


def machines(kind: str, count: int = 20) -> list[Machine]:
    """So many machines of a type, drawn from its base in sizes of their own."""
    return [_drawn(kind, f"Y{137 + 37 * number}", number + 1) for number in range(count)]


def _drawn(kind: str, name: str, seed: int) -> Machine:
    dice = random.Random(f"{kind} {seed}")
    base = _BASES[kind]
    size = dice.uniform(0.35, 2.2) ** (1 / 3)
    values = {}
    for key, (value, power) in base.items():
        spread = 0.07 if power else 0.09
        values[key] = rounded(kind, key, value * size**power * dice.uniform(1 - spread, 1 + spread))
    values = _consistent(kind, values)
    return Machine(name, kind, values, _variants(kind, values, dice))


def _consistent(kind: str, values: dict[str, float]) -> dict[str, float]:
    """What must be larger than another is."""
    order = {
        "wheel_loader": [("Static Tipping Load Full Turn", "Static Tipping Load Straight"),
                         ("Bucket Capacity Struck", "Bucket Capacity Heaped"), ("Overall Width", "Bucket Width")],
        "excavator": [("Maximum Reach at Ground Line", "Maximum Reach"), ("Track Length on Ground", "Track Length"),
                      ("Maximum Vertical Wall Digging Depth", "Maximum Digging Depth"),
                      ("Upperstructure Width", "Overall Width"), ("Cab Height", "Overall Height")],
    }[kind]  # fmt: skip
    for small, large in order:
        if values[small] > 0.985 * values[large]:
            values[small] = rounded(kind, small, 0.96 * values[large])
    return values


def unit_of(kind: str, name: str) -> str:
    """The metric unit in which a name's values are kept."""
    for entry in entries(kind):
        if entry.name == name:
            return entry.third
    other = (
        "kW" if name in ("Gross Power", "Engine Power") else "mm"
    )  # which only some sheets print beside the net power
    return next((one.unit for one in kept(kind) if one.name == name), other)


@dataclass(frozen=True)
class Kept:
    """A value of a type's machine of `words/types.txt`; `power` None: of every size the same."""

    name: str
    unit: str
    value: float
    power: float | None


@cache
def kept(kind: str) -> tuple[Kept, ...]:
    """The values of a type in `words/types.txt`."""
    found, here = [], ""
    for line in (WORDS / "types.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            here = line.strip("[]")
        elif here == kind and line and not line.startswith("#"):
            name, unit, value, power = (part.strip() for part in line.split("|"))
            found.append(Kept(name, unit, float(value), None if power == "=" else float(power)))
    return tuple(found)


# What is the sum of others, and what is smaller than another
_SUMS = {
    "wheel_loader": {"Total Cycle Time": ("Raise Time", "Dump Time", "Lower Time")},
    "excavator": {"Overall Width": ("Track Gauge", "Shoe Width")},
    "articulated_dump_truck": {"Gross Weight": ("Empty Weight", "Rated Payload")},
    "rigid_dump_truck": {"Empty Weight": ("Body Weight", "Chassis Weight"),
                         "Gross Weight": ("Empty Weight", "Rated Payload")},
    "dozer": {"Width over Tracks": ("Track Gauge", "Shoe Width")},
    "grader": {"Wheelbase": ("Front Axle to Articulation", "Rear Axle to Articulation")},
    "forklift": {"Overall Length": ("Length to Fork Face", "Fork Length")},
    "roller": {"Operating Weight": ("Weight at Drum", "Weight at Wheels")},
    "mini_excavator": {"Overall Width": ("Track Gauge", "Shoe Width")},
    "skid_steer": {"Tipping Load": ("Rated Operating Capacity", "Rated Operating Capacity")},
}  # fmt: skip
_SMALLER = {
    "articulated_dump_truck": [("Body Capacity Struck with Tailgate", "Body Capacity Heaped"),
                               ("Body Capacity Struck", "Body Capacity Struck with Tailgate"),
                               ("Body Capacity Heaped", "Body Capacity Heaped with Tailgate"),
                               ("Body Width Inside", "Body Width Outside")],
    "rigid_dump_truck": [("Body Capacity Struck", "Body Capacity Heaped"), ("Body Width Inside", "Body Width Outside"),
                         ("Operating Width", "Overall Width"), ("Canopy Width", "Overall Width"),
                         ("Front Canopy Height", "Overall Height")],
    "dozer": [("Width over Tracks", "Width over Trunnions"), ("Shipping Weight", "Operating Weight")],
    "grader": [("Tire Centerline Width", "Overall Width"), ("Height to Top of Cylinders", "Overall Height")],
    "backhoe_loader": [("Overall Width", "Loader Bucket Width"), ("Loader Dump Height", "Loader Hinge Pin Height")],
    "telehandler": [("Capacity at Maximum Height", "Maximum Lift Capacity"), ("Fork Length", "Wheelbase")],
    "roller": [("Drum Width", "Overall Width"), ("Nominal Amplitude Low", "Nominal Amplitude High")],
    "wheeled_excavator": [("Maximum Reach at Ground Line", "Maximum Reach"), ("Cab Height", "Overall Height")],
    "mini_excavator": [("Maximum Vertical Wall Digging Depth", "Maximum Digging Depth"),
                       ("Maximum Reach at Ground Line", "Maximum Reach"), ("Track Length on Ground", "Track Length")],
    "forklift": [("Ground Clearance Below Mast", "Ground Clearance")],
    "skid_steer": [("Overall Width", "Bucket Width"), ("Dumping Clearance", "Hinge Pin Height at Maximum Lift")],
}  # fmt: skip


def typed(kind: str, name: str, seed: str) -> Machine:
    """A machine of any type, drawn about the one of `words/types.txt`."""
    dice = random.Random(f"{kind} {seed}")
    size = dice.uniform(0.45, 1.9) ** (1 / 3)
    base: dict[str, tuple[float, float | None]] = {one.name: (one.value, one.power) for one in kept(kind)}
    values = {}
    for key, (value, power) in {**_BASES.get(kind, {}), **base}.items():
        grown = value if power is None else value * size**power * dice.uniform(0.955, 1.045)
        fine = grown < 100 and unit_of(kind, key) == "mm" and " Cylinder " not in key
        values[key] = float(round(grown, 0 if grown >= 5 else 2)) if fine else rounded(kind, key, grown)
    if kind in _BASES:
        values = _consistent(kind, values)
    for whole, parts in _SUMS.get(kind, {}).items():
        values[whole] = rounded(kind, whole, sum(values[part] for part in parts))
    for small, large in _SMALLER.get(kind, []):
        if values[small] > 0.985 * values[large]:
            values[small] = rounded(kind, small, 0.96 * values[large])
    return Machine(name, kind, values)


_STEPS = {"mm": 5.0, "kg": 10.0, "m3": 0.05, "kN": 1.0, "deg": 1.0, "MPa": 0.1, "L/min": 1.0, "s": 0.1, "km/h": 0.1,
          "rpm": 0.1, "kNm": 0.1, "-": 1.0, "kW": 1.0, "kPa": 1.0, "L": 10.0, "m/s": 0.01, "m/min": 1.0}  # fmt: skip


def rounded(kind: str, name: str, value: float) -> float:
    """A value as a maker would round it."""
    step = _STEPS[unit_of(kind, name)]
    if " Cylinder " in name and "Stroke" in name:
        step = 1.0
    return round(round(value / step) * step, 6)


_BUCKETS = {
    "en": ("General purpose", "Rock", "Light material"),
    "de": ("Erdschaufel", "Felsschaufel", "Leichtgutschaufel"),
    "fr": ("Godet normal", "Godet à roches", "Godet matériaux légers"),
    "es": ("Uso general", "Roca", "Material ligero"),
    "zh": ("标准铲斗", "岩石铲斗", "轻料铲斗"),
    "ja": ("標準バケット", "ロックバケット", "軽作業バケット"),
}
_ARMS = {"en": "{} m arm", "de": "Stiel {} m", "fr": "Balancier {} m", "es": "Brazo {} m", "zh": "斗杆 {} m",
         "ja": "アーム {} m"}  # fmt: skip
BY_VARIANT = {
    "wheel_loader": ("Bucket Capacity Heaped", "Bucket Capacity Struck", "Bucket Width", "Bucket Weight",
                     "Dumping Clearance", "Dumping Reach", "Overall Length", "Overall Operating Height",
                     "Static Tipping Load Straight", "Static Tipping Load Full Turn", "Breakout Force",
                     "Operating Weight"),
    "excavator": ("Maximum Digging Depth", "Maximum Vertical Wall Digging Depth", "Maximum Digging Height",
                  "Maximum Dumping Height", "Maximum Reach", "Maximum Reach at Ground Line", "Minimum Swing Radius",
                  "Arm Digging Force", "Overall Length", "Overall Height"),
}  # fmt: skip


def _variants(kind: str, values: Mapping[str, float], dice: random.Random) -> tuple[Variant, ...]:
    """Three configurations; in each the values that depend on it differ by a few per cent."""
    found = []
    arm = values.get("Arm Length", 0.0) / 1000
    for index in range(3):
        shift = (0.0, -0.06, 0.08)[index]
        other = {
            name: values[name]
            if index == 0
            else rounded(kind, name, values[name] * (1 + shift + dice.uniform(-0.012, 0.012)))
            for name in BY_VARIANT[kind]
        }
        if kind == "wheel_loader":
            heads = {language: names[index] for language, names in _BUCKETS.items()}
        else:
            length = arm + (0.0, -0.5, 0.7)[index]
            other["Arm Length"] = round(1000 * round(length, 2)) if index else values["Arm Length"]
            text = f"{length:.2f}"
            heads = {
                language: form.format(text.replace(".", ",") if language in ("de", "fr", "es") else text)
                for language, form in _ARMS.items()
            }
        found.append(Variant(heads, other))
    return tuple(found)
