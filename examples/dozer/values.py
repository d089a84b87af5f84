"""The values the example dozer is drawn to.

* `PUBLISHED`: printed for the Cat D6 with 610 mm shoes on 42-section tracks, in the maker's specalog AEXQ3981-20C;
  `location` is the page. They are those of the machine on push arms; its six-way blade has a sheet of its own.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value". So is all of the blade.

Lengths are millimetres, angles degrees, masses kilograms, pressures MPa.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

BROCHURE = "Cat D6 specalog AEXQ3981-20C"
MAKE, MODEL = "Cat", "D6"


def _published(name: str, value: float, unit: str, source: str, page: str) -> Value:
    return Value(name, value, unit, source, page)


# ---- published --------
NET_POWER = _published("Net power", 161, "kW", "Net power ISO 9249/SAE J1349", "p3")
OPERATING_WEIGHT = _published("Operating weight", 22_130, "kg", "Operating weight", "p6")
SHOES = _published("Sections per side", 42, "count", "Sections per side", "p6")
TRACK_ROLLERS = _published("Bottom rollers per side", 8, "count", "Bottom rollers per side", "p6")
TRACK_GAUGE = _published("Track gauge", 1_930, "mm", "Track gauge d1", "p6")
SHOE_WIDTH = _published("Shoe width", 610, "mm", "Max shoe width d2", "p6")
WIDTH = _published("Width over tracks", 2_540, "mm", "Width over tracks d3", "p6")
TRACK_ON_GROUND = _published("Track length on ground", 2_964, "mm", "Track on ground length d4", "p6")
GROUND_CLEARANCE = _published("Ground clearance", 361, "mm", "Ground clearance", "p6")
HEIGHT = _published("Machine height", 3_188, "mm", "Machine height d5", "p6")

# ---- ours: what the sheet prints as "example value" --------
BARE_LENGTH = Value("Length without blade", 4_300, "mm")
BLADE_WIDTH = Value("Blade width", 3_280, "mm")
LIFT_HEIGHT = Value("Blade lift height", 1_100, "mm")
DIG_DEPTH = Value("Digging depth", 480, "mm")
MAX_TILT = Value("Maximum blade tilt", 450, "mm")
"""How much higher one corner is than the other."""
BLADE_ANGLE = Value("Blade angle", 24, "deg")
PRESSURE = Value("Main relief pressure", 21.5, "MPa")
FLOW = Value("Main pump flow", 170, "L/min")
TRAVEL_SPEED = Value("Maximum travel speed", 11.0, "km/h")
DRAWBAR_PULL = Value("Maximum drawbar pull", 320, "kN")
LIFT_BORE = Value("Blade lift cylinder bore", 95, "mm")
LIFT_ROD = Value("Blade lift cylinder rod diameter", 50, "mm")
LIFT_STROKE = Value("Blade lift cylinder stroke", 520, "mm")
TILT_BORE = Value("Blade tilt cylinder bore", 115, "mm")
TILT_ROD = Value("Blade tilt cylinder rod diameter", 65, "mm")
TILT_STROKE = Value("Blade tilt cylinder stroke", 120, "mm")
ANGLE_BORE = Value("Blade angle cylinder bore", 80, "mm")
ANGLE_ROD = Value("Blade angle cylinder rod diameter", 50, "mm")
ANGLE_STROKE = Value("Blade angle cylinder stroke", 500, "mm")

# ---- ours: how things are drawn; a sheet does not print these --------
TRACK_LENGTH = Value("Length over the tracks", 3_970, "mm")
BLADE_HEIGHT = Value("Blade height", 1_220, "mm")

DRAWN_ONLY: tuple[Value, ...] = (TRACK_LENGTH, BLADE_HEIGHT)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
