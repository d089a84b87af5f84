"""The values the example mini excavator is drawn to.

* `PUBLISHED`: printed by the maker for the JCB 8008 CTS micro excavator (880 mm dipper, tracks retracted) in the
  brochure named in `BROCHURE`; `source` is the line there.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

Units and working ranges are as in the excavator's `values`. Boom swing: degrees either side of straight ahead. Blade:
its lowest point above and below the ground. The maker's machine runs on rubber tracks; this one on steel shoes as wide
and as long.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

BROCHURE = "JCB 8008/8010 CTS micro excavators, brochure, pages 5 and 6"
MAKE, MODEL = "JCB", "8008 CTS"


def _published(name: str, value: float, unit: str, source: str, page: str) -> Value:
    return Value(name, value, unit, source, page)


# ---- published --------
ARM_LENGTH = _published("Arm length", 880, "mm", "Dipper", "p6")
OPERATING_WEIGHT = _published("Operating weight", 950, "kg", "Operating weight", "p5")
CANOPY_HEIGHT = _published("Overall height, top of canopy", 2310, "mm", "A Overall height (trans pos)", "p5")
KINGPOST_CLEARANCE = _published("Kingpost clearance", 356, "mm", "C Kingpost clearance", "p5")
TRACK_ON_GROUND = _published("Track length on ground", 865, "mm", "D Sprocket idler centres", "p5")
TRACK_LENGTH = _published("Track length", 1165, "mm", "E Undercarriage length", "p5")
TAIL_RADIUS = _published("Tail swing radius", 800, "mm", "F Tailswing", "p5")
BLADE_HEIGHT = _published("Blade height", 200, "mm", "G Dozer height", "p5")
BLADE_WIDTH = _published("Blade width", 700, "mm", "H Dozer width (retracted)", "p5")
UPPER_WIDTH = _published("Width of upper structure", 695, "mm", "I Superstructure width", "p5")
OVERALL_WIDTH = _published("Overall width", 700, "mm", "J Width over tracks (retracted)", "p5")
TRAVEL_SPEED = _published("Maximum travel speed", 1.8, "km/h", "Travel speed", "p5")
DRAWBAR_PULL = _published("Maximum drawbar pull", 7.75, "kN", "Drawbar pull", "p5")
SWING_SPEED = _published("Swing speed", 7, "rpm", "Slew speed", "p5")
GROSS_POWER = _published("Gross power", 9.0, "kW", "Gross power", "p5")
TRACK_ROLLERS = _published("Track rollers, each side", 2, "count", "No of bottom rollers", "p5")
SHOE_WIDTH = _published("Shoe width", 180, "mm", "Track width", "p5")
GROUND_CLEARANCE = _published("Ground clearance (minimum)", 130, "mm", "F Ground clearance", "p5")
PUMP_FLOW = _published("Main pump maximum flow", 22.4, "L/min", "Nominal output 11.2 x 2", "p5")
MAIN_PRESSURE = _published("Main relief pressure", 17.0, "MPa", "Excavator/track main relief, 170 bar", "p5")
SWING_PRESSURE = _published("Relief pressure, swing", 9.0, "MPa", "Slew main relief, 90 bar", "p5")
SWING_RIGHT = _published("Boom swing right", 70, "deg", "K Boom swing right", "p6")
SWING_LEFT = _published("Boom swing left", 70, "deg", "L Boom swing left", "p6")
DIGGING_HEIGHT = _published("Max digging height", 2840, "mm", "M Max dig height", "p6")
DUMPING_HEIGHT = _published("Max dumping height", 1980, "mm", "N Max dump height", "p6")
WALL_DEPTH = _published("Max vertical wall digging depth", 1480, "mm", "O Max vertical dig depth", "p6")
DIGGING_DEPTH = _published("Max digging depth", 1690, "mm", "P Max dig depth-dozer up", "p6")
GROUND_REACH = _published("Max reach at ground", 3110, "mm", "Q Max ground level reach", "p6")
BLADE_LIFT = _published("Blade lift above ground", 200, "mm", "R Dozer cut above ground", "p6")
BLADE_DIG = _published("Blade depth below ground", 110, "mm", "S Dozer cut below ground", "p6")
SWING_RADIUS_MIN = _published("Min swing radius", 1240, "mm", "T Min. slew radius", "p6")
BUCKET_WIDTH = _published("Bucket width", 300, "mm", "300mm bucket (operating weight)", "p5")

# ---- ours: what the sheet prints as "example value" --------
BOOM_LENGTH = Value("Boom length", 1450, "mm")
BUCKET_CAPACITY = Value("Bucket capacity", 0.022, "m3")
BUCKET_WEIGHT = Value("Bucket weight", 22, "kg")
TRACK_GAUGE = Value("Track gauge", 520, "mm")
BOOM_BORE = Value("Boom cylinder bore", 55, "mm")
BOOM_ROD = Value("Boom cylinder rod diameter", 30, "mm")
BOOM_STROKE = Value("Boom cylinder stroke", 420, "mm")
ARM_BORE = Value("Arm cylinder bore", 50, "mm")
ARM_ROD = Value("Arm cylinder rod diameter", 28, "mm")
ARM_STROKE = Value("Arm cylinder stroke", 400, "mm")
BUCKET_BORE = Value("Bucket cylinder bore", 45, "mm")
BUCKET_ROD = Value("Bucket cylinder rod diameter", 25, "mm")
BUCKET_STROKE = Value("Bucket cylinder stroke", 330, "mm")
SWING_BORE = Value("Boom swing cylinder bore", 40, "mm")
SWING_ROD = Value("Boom swing cylinder rod diameter", 22, "mm")
SWING_STROKE = Value("Boom swing cylinder stroke", 225, "mm")
BLADE_BORE = Value("Blade cylinder bore", 50, "mm")
BLADE_ROD = Value("Blade cylinder rod diameter", 25, "mm")
BLADE_STROKE = Value("Blade cylinder stroke", 70, "mm")
SWING_TORQUE = Value("Swing torque", 1.1, "kNm")
SHOES = Value("Track shoes, each side", 28, "count")

# ---- ours: how things are drawn; a sheet does not print these --------
BOOM_CLOSED = Value("Boom cylinder closed length", 620, "mm")
ARM_CLOSED = Value("Arm cylinder closed length", 600, "mm")
BUCKET_CLOSED = Value("Bucket cylinder closed length", 510, "mm")

DRAWN_ONLY: tuple[Value, ...] = (BOOM_CLOSED, ARM_CLOSED, BUCKET_CLOSED)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
