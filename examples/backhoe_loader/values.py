"""The values the example backhoe loader is drawn to.

* `PUBLISHED`: printed for the JCB 3CX with an extending dipper, which is drawn out for its working ranges; `location`
  is where.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

The maker's machine has a backhoe that shifts sideways and stands on upright legs; this one turns about a fixed pivot in
the middle, stands on hinged legs, and its loader bucket has a Z-bar. So its backhoe folds less tightly: the maker's
lengths and heights of travel are not its own. The maker prints forces in kgf; here they are kN.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

FACTS = (
    "JCB 3CX 2007, features and technical specifications (bhw.123linux.com), and JCB 3CX dimensions (synergyrentals.ae)"
)
MAKE, MODEL = "JCB", "3CX"
GRAVITY = 9.80665


def _published(name: str, value: float, unit: str, source: str, where: str = "dimensions") -> Value:
    return Value(name, value, unit, source, where)


# ---- published --------
WHEELBASE = _published("Wheelbase", 2_170, "mm", "Axle centreline distance")
SLEW_TO_AXLE = _published("Slew centre to rear axle centre", 1_360, "mm", "Slew centre to rear axle centre")
FEET_CLEARANCE = _published("Stabiliser feet clearance", 370, "mm", "Stabiliser feet clearance")
KINGPOST_CLEARANCE = _published("Kingpost clearance", 520, "mm", "Kingpost clearance")
CAB_HEIGHT = _published("Cab roof height", 3_030, "mm", "Cab roof height")
FRAME_WIDTH = _published("Rear frame width", 2_350, "mm", "Rear frame width")
SHOVEL_WIDTH = _published("Loader bucket width", 2_350, "mm", "Shovel width")
DIG_DEPTH = _published("Maximum digging depth", 5_460, "mm", "SAE dig depth", "2007")
GROUND_REACH = _published("Reach at ground level", 6_520, "mm", "Reach @ ground level", "2007")
LOADING_HEIGHT = _published("Loading height", 4_720, "mm", "Loading height", "2007")
DUMP_HEIGHT = _published("Loader dump height", 2_740, "mm", "Loader dump height", "2007")
BUCKET_FORCE = _published("Bucket breakout", round(5_700 * GRAVITY / 1000, 1), "kN", "Bucket breakout", "2007")
DIPPER_FORCE = _published("Dipper breakout", round(3_010 * GRAVITY / 1000, 1), "kN", "Dipper breakout", "2007")
LOADER_FORCE = _published("Loader breakout", round(6_010 * GRAVITY / 1000, 1), "kN", "Loader breakout", "2007")
POWER = _published("Engine power", 61.6, "kW", "Engine power at 2200 rpm", "2007")
FLOW = _published("Pump flow", 124, "L/min", "Pump flow", "2007")
PRESSURE = _published("Relief pressure", 22.7, "MPa", "Relief pressure, 227 bar", "2007")
SPEED = _published("Maximum speed", 36.1, "km/h", "Max speed", "2007")
WEIGHT = _published("Operating weight", 8_070, "kg", "Operating weight", "2007")

# ---- ours: what the sheet prints as "example value" --------
HINGE_HEIGHT = Value("Loader hinge pin height", 3_500, "mm")
DUMP_REACH = Value("Loader dump reach", 600, "mm")
DUMP_ANGLE = Value("Loader dump angle", 46, "deg")
ROLLBACK = Value("Loader rollback angle", 40, "deg")
LOADER_DEPTH = Value("Loader digging depth", 50, "mm")
SWING_ARC = Value("Backhoe swing arc", 150, "deg")
SPREAD = Value("Stabiliser spread", 2_700, "mm")
GROUND_CLEARANCE = Value("Ground clearance", 385, "mm")
TYRE_DIAMETER = Value("Rear tyre diameter", 1_430, "mm")
STEER_ANGLE = Value("Steering angle", 42, "deg")
LOADER_VOLUME = Value("Loader bucket capacity", 1.0, "m3")
HOE_VOLUME = Value("Backhoe bucket capacity", 0.2, "m3")
LIFT_BORE = Value("Loader lift cylinder bore", 90, "mm")
LIFT_ROD = Value("Loader lift cylinder rod diameter", 50, "mm")
LIFT_STROKE = Value("Loader lift cylinder stroke", 790, "mm")
TILT_BORE = Value("Loader bucket cylinder bore", 82, "mm")
TILT_ROD = Value("Loader bucket cylinder rod diameter", 50, "mm")
TILT_STROKE = Value("Loader bucket cylinder stroke", 560, "mm")
BOOM_BORE = Value("Boom cylinder bore", 120, "mm")
BOOM_ROD = Value("Boom cylinder rod diameter", 65, "mm")
BOOM_STROKE = Value("Boom cylinder stroke", 650, "mm")
DIPPER_BORE = Value("Dipper cylinder bore", 100, "mm")
DIPPER_ROD = Value("Dipper cylinder rod diameter", 60, "mm")
DIPPER_STROKE = Value("Dipper cylinder stroke", 740, "mm")
BUCKET_BORE = Value("Backhoe bucket cylinder bore", 98, "mm")
BUCKET_ROD = Value("Backhoe bucket cylinder rod diameter", 56, "mm")
BUCKET_STROKE = Value("Backhoe bucket cylinder stroke", 545, "mm")
EXTENSION_BORE = Value("Extension cylinder bore", 63, "mm")
EXTENSION_ROD = Value("Extension cylinder rod diameter", 36, "mm")
EXTENSION_STROKE = Value("Extension cylinder stroke", 1_150, "mm")
SWING_BORE = Value("Swing cylinder bore", 85, "mm")
SWING_ROD = Value("Swing cylinder rod diameter", 50, "mm")
SWING_STROKE = Value("Swing cylinder stroke", 340, "mm")
STABILISER_BORE = Value("Stabiliser cylinder bore", 80, "mm")
STABILISER_ROD = Value("Stabiliser cylinder rod diameter", 45, "mm")
STABILISER_STROKE = Value("Stabiliser cylinder stroke", 345, "mm")
STEER_BORE = Value("Steering cylinder bore", 70, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 40, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 210, "mm")

# ---- ours: how things are drawn; a sheet does not print these --------
FRONT_TYRE = Value("Front tyre diameter", 940, "mm")
FRONT_TYRE_WIDTH = Value("Front tyre width", 310, "mm")
REAR_TYRE_WIDTH = Value("Rear tyre width", 430, "mm")
FRONT_TREAD = Value("Front tread", 1_750, "mm")
REAR_TREAD = Value("Rear tread", 1_810, "mm")
BOOM_LENGTH = Value("Boom length", 2_750, "mm")
DIPPER_LENGTH = Value("Dipper length, drawn in", 2_100, "mm")
LIFT_CLOSED = Value("Loader lift cylinder closed length", 1_040, "mm")
TILT_CLOSED = Value("Loader bucket cylinder closed length", 900, "mm")
BOOM_CLOSED = Value("Boom cylinder closed length", 930, "mm")
DIPPER_CLOSED = Value("Dipper cylinder closed length", 1_120, "mm")
BUCKET_CLOSED = Value("Backhoe bucket cylinder closed length", 860, "mm")
EXTENSION_CLOSED = Value("Extension cylinder closed length", 1_380, "mm")

DRAWN_ONLY: tuple[Value, ...] = (
    FRONT_TYRE, FRONT_TYRE_WIDTH, REAR_TYRE_WIDTH, FRONT_TREAD, REAR_TREAD, BOOM_LENGTH, DIPPER_LENGTH, LIFT_CLOSED,
    TILT_CLOSED, BOOM_CLOSED, DIPPER_CLOSED, BUCKET_CLOSED, EXTENSION_CLOSED,
)  # fmt: skip
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
