"""The values the example excavator is drawn to.

Two kinds, never mixed:

* `PUBLISHED`: printed by the maker for the Komatsu PC210LC-11 (5700 mm boom, 2925 mm arm, 0.85 m3 bucket, 700 mm
  shoes). `source` is the name of the fact in the maker's specification (brochure BR02-0225-V2) as collected by the
  EXO equipment atlas.
* `EXAMPLE`: ours. Plausible for the class, chosen for this example, not the maker's; a sheet prints them as
  "example value".

Lengths are millimetres, angles degrees, masses kilograms, pressures MPa, flows L/min, speeds km/h or rpm, forces kN,
volumes m3.

Working ranges are those of the tooth points and of the outermost poses the cylinders allow, the machine standing
level on its grousers:

* digging depth: the lowest tooth point;
* reach: the farthest tooth point from the swing axis, at any height and at the ground line;
* digging height: the highest tooth point;
* dumping height, maximum and minimum: boom cylinders open, arm cylinder closed (maximum) or open (minimum), the
  tooth points straight below the bucket pin;
* vertical wall depth: the lowest tooth point while the underside of the bucket floor stands upright;
* level bottom: the deepest level along which the tooth points can be drawn for the length in the name.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

BROCHURE = "KOMATSU-PC210LC11-BR02-0225-V2"
"""Document the published values are cited from."""


def _published(name: str, value: float, unit: str, location: str, high: float | None = None) -> Value:
    return Value(name, value, unit, name, location, high)


# ---- published --------
BOOM_LENGTH = _published("Boom length", 5700, "mm", "p20")
ARM_LENGTH = _published("Arm length", 2925, "mm", "p21")
BOOM_STROKE = _published("Boom cylinder stroke (x2)", 1334, "mm", "p20")
ARM_STROKE = _published("Arm cylinder stroke", 1490, "mm", "p20")
BUCKET_STROKE = _published("Bucket cylinder stroke", 1105, "mm", "p20")
NET_POWER = _published("Net power", 122.8, "kW", "p20")
OPERATING_WEIGHT_RANGE = _published("Operating weight", 23313, "kg", "p1", 24440)
"""Lightest and heaviest configuration."""
BUCKET_CAPACITY = _published("Bucket capacity", 0.85, "m3", "p21")
BUCKET_WIDTH = _published("Bucket width", 914, "mm", "p21")
OVERALL_LENGTH = _published("Overall length A", 9705, "mm", "p21")
"""Transport pose: arm and bucket cylinder open, the boom lowered until the bucket linkage rests on the ground."""
OVERALL_WIDTH = _published("Overall width D", 3080, "mm", "p21")
HANDRAIL_HEIGHT = _published("Height to handrail F", 3135, "mm", "p21")
CAB_HEIGHT = _published("Cab height E", 3045, "mm", "p21")
SHOE_WIDTH = _published("Shoe width O", 700, "mm", "p21")
TRACK_LENGTH = _published("Track length L", 4450, "mm", "p21")
TRACK_GAUGE = _published("Track gauge M", 2380, "mm", "p21")
DIGGING_HEIGHT = _published("Max digging height A", 9970, "mm", "p22")
DUMPING_HEIGHT = _published("Max dumping height B", 7110, "mm", "p22")
DIGGING_DEPTH = _published("Max digging depth C", 6620, "mm", "p22")
GROUND_REACH = _published("Max reach at ground G", 9700, "mm", "p22")
COUNTERWEIGHT = _published("Counterweight", 4370, "kg", "p20")

# ---- ours: what the sheet prints as "example value" --------
OPERATING_WEIGHT = Value("Operating weight, this configuration", 23650.0, "kg")
"""5700 mm boom, 2925 mm arm, 0.85 m3 bucket, 700 mm shoes; within the published range."""
BUCKET_WEIGHT = Value("Bucket weight", 680.0, "kg")
BOOM_COUNT = Value("Boom cylinder count", 2, "count")
ARM_COUNT = Value("Arm cylinder count", 1, "count")
BUCKET_COUNT = Value("Bucket cylinder count", 1, "count")
BOOM_BORE = Value("Boom cylinder bore", 130.0, "mm")
BOOM_ROD = Value("Boom cylinder rod diameter", 90.0, "mm")
ARM_BORE = Value("Arm cylinder bore", 140.0, "mm")
ARM_ROD = Value("Arm cylinder rod diameter", 100.0, "mm")
BUCKET_BORE = Value("Bucket cylinder bore", 120.0, "mm")
BUCKET_ROD = Value("Bucket cylinder rod diameter", 85.0, "mm")
MAIN_PRESSURE = Value("Main relief pressure, implement", 36.0, "MPa")
TRAVEL_PRESSURE = Value("Relief pressure, travel", 36.0, "MPa")
SWING_PRESSURE = Value("Relief pressure, swing", 29.0, "MPa")
PUMP_FLOW = Value("Main pump maximum flow", 460.0, "L/min")
SWING_SPEED = Value("Swing speed", 12.0, "rpm")
SWING_TORQUE = Value("Swing torque", 68.0, "kNm")
TRAVEL_SPEED_HIGH = Value("Maximum travel speed, high", 5.4, "km/h")
TRAVEL_SPEED_MID = Value("Maximum travel speed, mid", 4.0, "km/h")
TRAVEL_SPEED_LOW = Value("Maximum travel speed, low", 3.0, "km/h")
DRAWBAR_PULL = Value("Maximum drawbar pull", 200.0, "kN")
MAX_REACH = Value("Max digging reach", 9880.0, "mm")
WALL_DEPTH = Value("Max vertical wall digging depth", 6080.0, "mm")
LEVEL_DEPTH = Value("Max digging depth, 2440 mm level bottom", 6447.0, "mm")
LEVEL_LENGTH = 2440.0
"""Length of the level bottom in `LEVEL_DEPTH`, millimetres."""
DUMPING_HEIGHT_MIN = Value("Min dumping height", 2560.0, "mm")
SWING_RADIUS_MIN = Value("Min swing radius", 3270.0, "mm")
"""Boom, arm and bucket cylinders open: distance of the work equipment's foremost point from the swing axis."""
TAIL_RADIUS = Value("Tail swing radius", 2981.0, "mm")
BOOM_HEIGHT = Value("Overall height, top of boom", 2799.0, "mm")
"""In the transport pose."""
TRACK_ON_GROUND = Value("Track length on ground", 3650.0, "mm")
"""Sprocket axis to idler axis, as makers measure it."""
TRACK_HEIGHT = Value("Track height", 887.0, "mm")
GROUND_CLEARANCE = Value("Ground clearance (minimum)", 440.0, "mm")
COUNTERWEIGHT_CLEARANCE = Value("Counterweight clearance", 1090.0, "mm")
UPPER_WIDTH = Value("Width of upper structure", 2720.0, "mm")
TRACK_ROLLERS = Value("Track rollers, each side", 9, "count")
CARRIER_ROLLERS = Value("Carrier rollers, each side", 2, "count")
SHOES = Value("Track shoes, each side", 49, "count")
GRADEABILITY = Value("Gradeability", 35.0, "deg")
BUCKET_FORCE = Value("Bucket digging force (ISO 6015)", 140.6, "kN")
ARM_FORCE = Value("Arm digging force (ISO 6015)", 113.3, "kN")

# ---- ours: how things are drawn; a sheet does not print these --------
BOOM_CLOSED = Value("Boom cylinder closed length", 1930.0, "mm")
ARM_CLOSED = Value("Arm cylinder closed length", 2180.0, "mm")
BUCKET_CLOSED = Value("Bucket cylinder closed length", 1690.0, "mm")
LINK_PITCH = Value("Track link pitch", 190.0, "mm")

MAKE, MODEL = "Komatsu", "PC210LC-11"

DRAWN_ONLY: tuple[Value, ...] = (BOOM_CLOSED, ARM_CLOSED, BUCKET_CLOSED, LINK_PITCH)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
