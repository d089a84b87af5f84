"""The values the example wheeled excavator is drawn to.

* `PUBLISHED`: printed for the JCB JS160W with its 5.15 m mono boom and 3.05 m dipper; `location` is the page.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

Lengths are millimetres, angles degrees, masses kilograms, pressures MPa, forces kN. The maker prints forces in kgf and
weights of machines on dual wheels with chassis that it shows as pictures; this one stands on single tyres, and its
weight is ours. Its stabilisers' legs are longer than the maker's, who prints how wide they are when raised.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

BROCHURE = "JCB JS145W/JS160W wheeled excavators, brochure, pages 14 to 19"
MAKE, MODEL = "JCB", "JS160W"
GRAVITY = 9.80665


def _published(name: str, value: float, unit: str, source: str, page: str) -> Value:
    return Value(name, value, unit, source, page)


# ---- published --------
GROUND_CLEARANCE = _published("Ground clearance", 350, "mm", "C Ground clearance", "p14")
UPPER_WIDTH = _published("Width of upper structure", 2_480, "mm", "E Overall width (handrail removed)", "p14")
CAB_HEIGHT = _published("Height over cab", 3_195, "mm", "F Height over cab", "p14")
TAIL_RADIUS = _published("Tail swing radius", 2_330, "mm", "G Tail length", "p14")
COUNTERWEIGHT_CLEARANCE = _published("Counterweight clearance", 1_270, "mm", "H Clearance under counterweight", "p14")
SLEW_TO_FRONT = _published("Slew centre to front axle", 1_500, "mm", "A Slew ring to front axle", "p15")
WHEELBASE = _published("Wheelbase", 2_500, "mm", "C Wheelbase", "p15")
SPREAD = _published("Stabiliser spread", 3_550, "mm", "S Width over stabilizers (lowered)", "p15")
STABILISER_LIFT = _published("Stabiliser lift height", 130, "mm", "T Stabilizer lift height", "p15")
GROSS_POWER = _published("Gross power", 93, "kW", "Rated power (ISO 14396)", "p16")
SWING_SPEED = _published("Swing speed", 8.9, "rpm", "Swing speed", "p16")
TRAVEL_SPEED = _published("Maximum travel speed", 28.4, "km/h", "High ratio", "p16")
LOW_SPEED = _published("Travel speed, low", 7.0, "km/h", "Low ratio", "p16")
DRAWBAR_PULL = _published("Maximum drawbar pull", 99.7, "kN", "Drawbar pull", "p16")
TURNING_RADIUS = _published("Turning radius outside tyres", 5_450, "mm", "To outside of tyres", "p16")
PUMP_FLOW = _published("Main pump flow", 260, "L/min", "Maximum flow, 2 x 130 l/min", "p17")
MAIN_PRESSURE = _published("Main relief pressure", 31.4, "MPa", "Main circuit pressure, 314 bar", "p17")
BUCKET_CAPACITY = _published("Bucket capacity", 0.59, "m3", "GP bucket 914mm", "p17")
BUCKET_WIDTH = _published("Bucket width", 914, "mm", "GP bucket 914mm", "p17")
BUCKET_WEIGHT = _published("Bucket weight", 511, "kg", "GP bucket 914mm", "p17")
BOOM_LENGTH = _published("Boom length", 5_150, "mm", "5.15m Monoboom", "p19")
ARM_LENGTH = _published("Arm length", 3_050, "mm", "Dipper length", "p19")
MAX_REACH = _published("Maximum digging reach", 9_352, "mm", "A Max digging reach", "p19")
GROUND_REACH = _published("Maximum reach at ground level", 9_163, "mm", "B Max digging reach (on ground)", "p19")
DIGGING_DEPTH = _published("Maximum digging depth", 6_451, "mm", "C Max digging depth", "p19")
DIGGING_HEIGHT = _published("Maximum digging height", 9_688, "mm", "D Max digging height", "p19")
DUMPING_HEIGHT = _published("Maximum dumping height", 7_174, "mm", "E Max loadover height", "p19")
WALL_DEPTH = _published("Maximum vertical wall digging depth", 4_839, "mm", "F Max vertical wall cut depth", "p19")
SWING_RADIUS_MIN = _published("Minimum swing radius", 2_971, "mm", "G Min swing radius", "p19")
BUCKET_ROTATION = _published("Bucket rotation", 183, "deg", "Bucket rotation", "p19")
ARM_FORCE = _published("Arm digging force", round(7_470 * GRAVITY / 1000, 1), "kN", "Dipper tearout", "p19")
BUCKET_FORCE = _published("Bucket digging force", round(10_400 * GRAVITY / 1000, 1), "kN", "Bucket tearout", "p19")

# ---- ours: what the sheet prints as "example value" --------
OPERATING_WEIGHT = Value("Operating weight", 15_600, "kg")
OVERALL_WIDTH = Value("Overall width over tyres", 2_480, "mm")
TYRE_DIAMETER = Value("Tyre diameter", 1_038, "mm")
"""Twice the height that the maker prints for the axles on single wheels."""
STEER_ANGLE = Value("Steering angle", 41.5, "deg")
SWING_TORQUE = Value("Swing torque", 42, "kNm")
SWING_PRESSURE = Value("Swing relief pressure", 28.0, "MPa")
BOOM_BORE = Value("Boom cylinder bore", 115, "mm")
BOOM_ROD = Value("Boom cylinder rod diameter", 80, "mm")
BOOM_STROKE = Value("Boom cylinder stroke", 1_055, "mm")
ARM_BORE = Value("Arm cylinder bore", 125, "mm")
ARM_ROD = Value("Arm cylinder rod diameter", 85, "mm")
ARM_STROKE = Value("Arm cylinder stroke", 1_310, "mm")
BUCKET_BORE = Value("Bucket cylinder bore", 105, "mm")
BUCKET_ROD = Value("Bucket cylinder rod diameter", 75, "mm")
BUCKET_STROKE = Value("Bucket cylinder stroke", 1_130, "mm")
STABILISER_BORE = Value("Stabiliser cylinder bore", 80, "mm")
STABILISER_ROD = Value("Stabiliser cylinder rod diameter", 45, "mm")
STABILISER_STROKE = Value("Stabiliser cylinder stroke", 270, "mm")
STEER_BORE = Value("Steering cylinder bore", 100, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 45, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 220, "mm")

# ---- ours: how things are drawn; a sheet does not print these --------
TYRE_WIDTH = Value("Tyre width", 440, "mm")
BOOM_CLOSED = Value("Boom cylinder closed length", 1_725, "mm")
ARM_CLOSED = Value("Arm cylinder closed length", 1_930, "mm")
BUCKET_CLOSED = Value("Bucket cylinder closed length", 1_640, "mm")

DRAWN_ONLY: tuple[Value, ...] = (TYRE_WIDTH, BOOM_CLOSED, ARM_CLOSED, BUCKET_CLOSED)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
