"""The values the example wheel loader is drawn to.

Two kinds, never mixed:

* `PUBLISHED`: printed by the maker for the Komatsu WA475-10 (standard boom, 4.2 m3 stock-pile bucket,
  26.5R25). `source` is the name of the fact in the maker's specification (brochure AESS942-0225) as collected
  by the EXO equipment atlas.
* `EXAMPLE`: ours. Plausible for the class, chosen for this example, not the maker's; a sheet prints them as
  "example value".

Lengths are millimetres, angles degrees, masses kilograms, pressures MPa, flows L/min, times seconds, speeds
km/h, volumes m3. Bucket angles are those of the cutting-edge plane: 0 = level, positive = rolled back, so a
45 degree dump is -45. The cutting edge is the line of the tooth points, which lies in the plane of the
floor's underside.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

BROCHURE = "KOM-WA47510-AESS942-0225"
"""Document the published values are cited from."""


def _published(name: str, value: float, unit: str, location: str) -> Value:
    return Value(name, value, unit, name, location)


# ---- published --------
LIFT_BORE = _published("Lift cylinder bore", 150, "mm", "p18")
LIFT_STROKE = _published("Lift cylinder stroke", 764, "mm", "p18")
LIFT_COUNT = _published("Lift cylinder count", 2, "count", "p18")
TILT_BORE = _published("Bucket cylinder bore", 180, "mm", "p18")
TILT_STROKE = _published("Bucket cylinder stroke", 540, "mm", "p18")
TILT_COUNT = _published("Bucket cylinder count", 1, "count", "p18")
STEER_BORE = _published("Steering cylinder bore", 95, "mm", "p18")
STEER_STROKE = _published("Steering cylinder stroke", 441, "mm", "p18")
STEER_COUNT = _published("Steering cylinder count", 2, "count", "p18")
STEER_ANGLE_NOMINAL = _published("Steering angle each direction", 35, "deg", "p18")
STEER_ANGLE = _published("Steering angle max end stop", 40, "deg", "p18")
OSCILLATION_TOTAL = _published("Rear axle total oscillation", 26, "deg", "p18")
WHEELBASE = _published("Wheelbase", 3450, "mm", "p19 A")
HINGE_HEIGHT_MAX = _published("Hinge pin height, max. height", 4370, "mm", "p19 B")
HINGE_HEIGHT_CARRY = _published("Hinge pin height, carry", 580, "mm", "p19 C")
GROUND_CLEARANCE = _published("Ground clearance", 520, "mm", "p19 D")
HITCH_HEIGHT = _published("Hitch height", 1200, "mm", "p19 E")
STACK_HEIGHT = _published("Height top of stack", 3450, "mm", "p19 F")
CAB_HEIGHT = _published("Height ROPS cab", 3500, "mm", "p19 G")
DUMP_CLEARANCE = _published("Dumping clearance, 45 deg", 3075, "mm", "p19 H")
DUMP_REACH = _published("Reach, 45 deg", 1350, "mm", "p19 I")
OPERATING_HEIGHT = _published("Operating height fully raised", 6090, "mm", "p19 L")
OVERALL_LENGTH = _published("Overall length (bucket on ground)", 9185, "mm", "p19 M")
BUCKET_WIDTH = _published("Bucket width", 3170, "mm", "p19")
WIDTH_OVER_TYRES = _published("Width over tires", 3060, "mm", "p19")
BUCKET_CAPACITY_HEAPED = _published("Bucket capacity heaped", 4.2, "m3", "p19")
BUCKET_CAPACITY_STRUCK = _published("Bucket capacity struck", 3.6, "m3", "p19")
BUCKET_WEIGHT = _published("Bucket weight", 2196, "kg", "p19")
OPERATING_WEIGHT = _published("Operating weight", 25510, "kg", "p19")
TIPPING_LOAD_STRAIGHT = _published("Static tipping load straight", 20540, "kg", "p19")
TIPPING_LOAD_FULL_TURN = _published("Static tipping load full turn 40 deg", 17770, "kg", "p19")

# ---- ours: what the sheet prints as "example value" --------
RACK_BACK_GROUND = Value("Rack-back angle at ground", 40.0, "deg")
"""Lift cylinders where the level bucket's edge rests on the ground, bucket cylinder fully extended."""
RACK_BACK_MAX = Value("Rack-back angle at maximum lift", 50.0, "deg")
DUMP_ANGLE_MAX = Value("Dump angle at maximum lift", 48.0, "deg")
"""Bucket cylinder fully retracted, lift cylinders fully extended; the bucket then stands at -48 degrees."""
APPROACH_ANGLE_CARRY = Value("Approach angle in carry position", 15.0, "deg")
DIG_DEPTH = Value("Digging depth, bucket level", 95.0, "mm")
"""Lift cylinders fully retracted, bucket level: how far the edge lies below ground."""
LIFT_ROD = Value("Lift cylinder rod diameter", 90.0, "mm")
TILT_ROD = Value("Bucket cylinder rod diameter", 105.0, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 55.0, "mm")
WORK_PRESSURE = Value("Work equipment relief pressure", 31.4, "MPa")
STEER_PRESSURE = Value("Steering relief pressure", 24.5, "MPa")
WORK_PUMP_FLOW = Value("Work equipment pump flow", 325.0, "L/min")
STEER_PUMP_FLOW = Value("Steering pump flow", 180.0, "L/min")
TIME_RAISE = Value("Hydraulic cycle time, raise", 5.8, "s")
TIME_DUMP = Value("Hydraulic cycle time, dump", 1.7, "s")
TIME_LOWER = Value("Hydraulic cycle time, lower", 3.6, "s")
BREAKOUT_FORCE = Value("Breakout force", 234.0, "kN")
"""Upward, 100 mm behind the edge of the level bucket on the ground, bucket cylinder at relief pressure (ISO 14397-2),
weights left out: what the drawn linkage gives."""
TURNING_RADIUS = Value("Minimum turning radius, centre of outside tyre", 5930.0, "mm")
"""At the end stop of the steering: what wheelbase and tread give, articulated in the middle."""
TRAVEL_SPEED_MAX = Value("Maximum travel speed", 38.0, "km/h")
TYRE_DIAMETER = Value("Tyre outside diameter", 1750.0, "mm")
TYRE_WIDTH = Value("Tyre section width", 675.0, "mm")
TREAD = Value("Tread (track width)", 2385.0, "mm")
"""Wheel centre to wheel centre; with the tyre width it gives the published width over tyres."""
REAR_OVERHANG = Value("Rear axle centre to rear of counterweight", 2500.0, "mm")

# ---- ours: how the cylinders are drawn; a sheet does not print these --------
LIFT_CLOSED = Value("Lift cylinder closed length", 1240.0, "mm")
TILT_CLOSED = Value("Bucket cylinder closed length", 1130.0, "mm")
STEER_CLOSED = Value("Steering cylinder closed length", 745.0, "mm")

TYRE_SIZE = "26.5R25"
MAKE, MODEL = "Komatsu", "WA475-10"

DRAWN_ONLY: tuple[Value, ...] = (LIFT_CLOSED, TILT_CLOSED, STEER_CLOSED)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
