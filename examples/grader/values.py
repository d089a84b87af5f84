"""The values the example grader is drawn to.

* `PUBLISHED`: printed by the maker for the Cat 140, in its specifications AEXQ4628-01 (North America); `location` is
  the page.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

Lengths are millimetres, angles degrees, masses kilograms, pressures MPa.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

BROCHURE = "Cat 140 specifications AEXQ4628-01"
MAKE, MODEL = "Cat", "140"


def _published(name: str, value: float, unit: str, page: str) -> Value:
    return Value(name, value, unit, BROCHURE, page)


# ---- published --------
OPERATING_WEIGHT = _published("Operating weight, typically equipped", 19_027, "kg", "p4")
BLADE_LENGTH = _published("Moldboard width", 3_658, "mm", "p4")
BLADE_HEIGHT = _published("Moldboard height", 556, "mm", "p4")
BLADE_THICK = _published("Moldboard thickness", 22, "mm", "p4")
BLADE_RADIUS = _published("Moldboard arc radius", 413, "mm", "p4")
THROAT = _published("Throat clearance", 119, "mm", "p4")
CIRCLE_TURN = _published("Circle rotation", 360, "deg", "p4")
STEERING = _published("Steering range, left/right", 50, "deg", "p3")
ARTICULATION = _published("Articulation, left/right", 20, "deg", "p3")
LEAN = _published("Wheel lean, left/right", 18, "deg", "p3")
OSCILLATION = _published("Front axle total oscillation", 32, "deg", "p3")
HEIGHT = _published("Height to top of cab", 3_454, "mm", "p7")
AXLE_HEIGHT = _published("Front axle center height", 612, "mm", "p7")
CYLINDERS_HEIGHT = _published("Height to top of cylinders", 3_044, "mm", "p7")
TANDEM = _published("Tandem axle spacing", 1_498, "mm", "p7")
WHEELBASE = _published("Front axle to mid tandem", 6_136, "mm", "p7")
FRONT_TO_HITCH = _published("Front axle to articulation hitch", 5_292, "mm", "p7")
REAR_TO_HITCH = _published("Rear axle to articulation hitch", 844, "mm", "p7")
TREAD = _published("Rear tire centerline width", 2_087, "mm", "p7")
WIDTH = _published("Outside rear tires width", 2_532, "mm", "p7")
LENGTH = _published("Overall length, push plate to ripper", 10_297, "mm", "p7")
GROUND_CLEARANCE = _published("Ground clearance at rear axle", 333, "mm", "p7")
RIPPING_DEPTH = _published("Ripping depth", 424, "mm", "p5")

# ---- ours: what the sheet prints as "example value" --------
BLADE_LIFT = Value("Blade lift above ground", 480, "mm")
DEPTH_OF_CUT = Value("Depth of cut", 700, "mm")
SHIFT_LEFT = Value("Blade side shift, left", 510, "mm")
SHIFT_RIGHT = Value("Blade side shift, right", 660, "mm")
SHOULDER = Value("Shoulder reach", 1_551, "mm")
BANK_CUT = Value("Bank cut angle", 87.4, "deg")
TIP_FORWARD = Value("Blade tip angle, forward", 40, "deg")
TIP_BACK = Value("Blade tip angle, backward", 5, "deg")
CIRCLE_DIAMETER = Value("Circle diameter", 1_530, "mm")
TURNING = Value("Turning radius, outside front tires", 7_420, "mm")
RIPPER_LIFT = Value("Ripper lift height", 380, "mm")
PRESSURE = Value("Implement relief pressure", 24.5, "MPa")
FLOW = Value("Implement pump flow", 210, "L/min")
TOP_SPEED = Value("Maximum travel speed", 46.6, "km/h")
LIFT_BORE = Value("Blade lift cylinder bore", 100, "mm")
LIFT_ROD = Value("Blade lift cylinder rod diameter", 60, "mm")
LIFT_STROKE = Value("Blade lift cylinder stroke", 1_080, "mm")
CENTRE_BORE = Value("Center shift cylinder bore", 95, "mm")
CENTRE_ROD = Value("Center shift cylinder rod diameter", 55, "mm")
CENTRE_STROKE = Value("Center shift cylinder stroke", 560, "mm")
TIP_BORE = Value("Blade tip cylinder bore", 80, "mm")
TIP_ROD = Value("Blade tip cylinder rod diameter", 45, "mm")
TIP_STROKE = Value("Blade tip cylinder stroke", 190, "mm")
SIDE_BORE = Value("Side shift cylinder bore", 65, "mm")
SIDE_ROD = Value("Side shift cylinder rod diameter", 40, "mm")
SIDE_STROKE = Value("Side shift cylinder stroke", 1_170, "mm")
STEER_BORE = Value("Steering cylinder bore", 60, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 36, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 330, "mm")
LEAN_BORE = Value("Wheel lean cylinder bore", 75, "mm")
LEAN_ROD = Value("Wheel lean cylinder rod diameter", 40, "mm")
LEAN_STROKE = Value("Wheel lean cylinder stroke", 155, "mm")
BEND_BORE = Value("Articulation cylinder bore", 85, "mm")
BEND_ROD = Value("Articulation cylinder rod diameter", 50, "mm")
BEND_STROKE = Value("Articulation cylinder stroke", 320, "mm")
RIPPER_BORE = Value("Ripper lift cylinder bore", 90, "mm")
RIPPER_ROD = Value("Ripper lift cylinder rod diameter", 50, "mm")
RIPPER_STROKE = Value("Ripper lift cylinder stroke", 230, "mm")

# ---- ours: how things are drawn; a sheet does not print these --------
BEND_CLOSED = Value("Articulation cylinder closed length", 950, "mm")

TYRE_SIZE = "14.0R24"
DRAWN_ONLY: tuple[Value, ...] = (BEND_CLOSED,)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
