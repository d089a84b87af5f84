"""The values the example crane is drawn to.

* `PUBLISHED`: printed for the Hitachi Sumitomo SCX500, a crawler crane with a lattice boom, here with its basic boom;
  `location` is where.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value". The track's length on the ground is
  what the published weight and ground pressure give with shoes of 760 mm.
* `RATED`: loads in kilograms by radius in metres: the first is the maker's, the others are ours.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

FACTS = "Hitachi Sumitomo SCX500 crawler crane specification, text stored at scribd.com/document/445818662"
MAKE, MODEL = "Hitachi Sumitomo", "SCX500"


def _published(name: str, value: float, unit: str, source: str, where: str = "page 3") -> Value:
    return Value(name, value, unit, source, where)


# ---- published --------
CAPACITY = _published("Maximum lifting capacity", 50_000, "kg", "Maximum rated load x working radius, 50 x 3.8")
CAPACITY_RADIUS = _published("Radius at maximum capacity", 3_800, "mm", "Maximum rated load x working radius, 50 x 3.8")
BOOM = _published("Boom length", 10_000, "mm", "Basic boom length")
BOOM_LONGEST = _published("Maximum boom length", 52_000, "mm", "Maximum boom length")
LINE_SPEED = _published("Line speed", 110, "m/min", "Line speeds, main hoist drum, 110/74/37")
LINE_PULL = _published("Line pull", 63.7, "kN", "Maximum rated line pull, 6.5 t")
BOOM_SPEED = _published("Boom hoist line speed", 60, "m/min", "Line speeds, boom hoist drum")
SLEWING = _published("Slewing speed", 3.7, "rpm", "Swing speed")
SPEED = _published("Travel speed", 2.0, "km/h", "Travel speed, 2.0/1.5")
POWER = _published("Engine power", 147, "kW", "Rated horsepower")
PRESSURE = _published("Ground pressure", 68.6, "kPa", "Ground pressure")
WEIGHT = _published("Operating weight", 50_100, "kg", "Operating weight, 10 m boom and 50 t hook included")
COUNTERWEIGHT = _published("Counterweight", 16_900, "kg", "Counterweight, total weight", "page 4")

# ---- ours: what the sheet prints as "example value" --------
HIGH = Value("Maximum boom angle", 80, "deg")
LOW = Value("Minimum boom angle", 20, "deg")
FALLS = Value("Part lines", 8, "")
BOOM_PULL = Value("Boom hoist line pull", 60, "kN")
BOOM_FALLS = Value("Boom hoist part lines", 10, "")
FOOT = Value("Boom foot height", 1_750, "mm")
LIFT_HEIGHT = Value("Maximum lifting height", 9_300, "mm")
TAIL = Value("Tail swing radius", 3_900, "mm")
GANTRY = Value("Gantry height", 4_750, "mm")
WIDTH = Value("Overall width", 4_300, "mm")
GAUGE = Value("Track gauge", 3_540, "mm")
SHOE = Value("Shoe width", 760, "mm")
TRACK = Value("Track length", 5_650, "mm")
ON_GROUND = Value("Track length on ground", 4_713, "mm")
CLEARANCE = Value("Ground clearance", 380, "mm")

# ---- ours: how things are drawn; a sheet does not print these --------
FOOT_AHEAD = Value("Boom foot before the slewing axis", 1_000, "mm")
DRAWN_ONLY: tuple[Value, ...] = (FOOT_AHEAD,)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)

RATED: dict[float, float] = {3.8: 50_000.0, 6.0: 20_000.0, 9.0: 10_000.0}
