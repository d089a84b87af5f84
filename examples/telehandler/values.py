"""The values the example telehandlers are drawn to.

* `PUBLISHED`: printed for the JCB 530-70; `location` is where. Its boom has two sections; its turning radius is that
  of its front wheels, steered alone.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

A second machine with a boom of three sections, stabilisers and a levelled frame is no maker's: what its linkage gives
is printed as "example value".
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

FACTS = "JCB 530-70 data sheet, a brochure of two pages"
MAKE, MODEL = "JCB", "530-70"


def _published(name: str, value: float, unit: str, source: str, where: str = "page 1") -> Value:
    return Value(name, value, unit, source, where)


# ---- published --------
WEIGHT = _published("Operating weight", 7_260, "kg", "Weight")
CAPACITY = _published("Rated capacity", 3_000, "kg", "Lift capacity maximum")
HEIGHT_CAPACITY = _published("Capacity at full height", 2_500, "kg", "Lift capacity to full height")
REACH_CAPACITY = _published("Capacity at full reach", 1_250, "kg", "Lift capacity at full reach")
LIFT_HEIGHT = _published("Maximum lift height", 7_000, "mm", "Lift height")
HEIGHT_REACH = _published("Reach at maximum height", 1_000, "mm", "Reach at maximum lift height")
FORWARD_REACH = _published("Maximum forward reach", 3_670, "mm", "Maximum forward reach")
BOOM_ANGLE = _published("Maximum boom angle", 60, "deg", "Boom angle")
OVERALL_HEIGHT = _published("Overall height", 2_670, "mm", "Overall height")
OVERALL_WIDTH = _published("Overall width", 2_320, "mm", "Overall width over tyres")
WHEELBASE = _published("Wheelbase", 2_490, "mm", "Wheelbase")
FORK_FACE = _published("Length to fork face", 4_660, "mm", "Overall length to front of carriage")
GROUND_CLEARANCE = _published("Ground clearance", 400, "mm", "Ground clearance")
TURNING_RADIUS = _published("Turning radius", 4_850, "mm", "Turning radius over tyres")
POWER = _published("Gross power", 56, "kW", "Gross power", "page 2")
SPEED = _published("Maximum travel speed", 30, "km/h", "Travel speed", "page 2")
STEER_ANGLE = _published("Steering angle", 48, "deg", "Steering angle", "page 2")
FLOW = _published("Main pump flow", 100, "L/min", "Pump flow", "page 2")
PRESSURE = _published("Main relief pressure", 24.5, "MPa", "System pressure, 245 bar", "page 2")
LIFT_TIME = _published("Boom lift time", 9.0, "s", "Boom raise", "page 2")
LOWER_TIME = _published("Boom lower time", 6.21, "s", "Boom lower", "page 2")
EXTEND_TIME = _published("Boom extend time", 5.54, "s", "Boom extend", "page 2")
RETRACT_TIME = _published("Boom retract time", 5.84, "s", "Boom retract", "page 2")

# ---- ours: what the sheet prints as "example value" --------
LOW_ANGLE = Value("Minimum boom angle", -13, "deg")
ROTATION = Value("Carriage rotation", 120, "deg")
FORK_LENGTH = Value("Fork length", 1_070, "mm")
TYRE_DIAMETER = Value("Tyre diameter", 1_160, "mm")
LIFT_BORE = Value("Lift cylinder bore", 125, "mm")
LIFT_ROD = Value("Lift cylinder rod diameter", 70, "mm")
LIFT_STROKE = Value("Lift cylinder stroke", 1_222, "mm")
TELESCOPE_BORE = Value("Telescoping cylinder bore", 70, "mm")
TELESCOPE_ROD = Value("Telescoping cylinder rod diameter", 45, "mm")
TELESCOPE_STROKE = Value("Telescoping cylinder stroke", 2_400, "mm")
TILT_BORE = Value("Tilt cylinder bore", 110, "mm")
TILT_ROD = Value("Tilt cylinder rod diameter", 60, "mm")
TILT_STROKE = Value("Tilt cylinder stroke", 380, "mm")
COMPENSATION_BORE = Value("Compensation cylinder bore", 70, "mm")
COMPENSATION_ROD = Value("Compensation cylinder rod diameter", 40, "mm")
COMPENSATION_STROKE = Value("Compensation cylinder stroke", 360, "mm")
STEER_BORE = Value("Steering cylinder bore", 70, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 40, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 220, "mm")

# ---- ours, of the machine with three sections alone --------
LEVELLING = Value("Frame levelling angle", 8, "deg")
LEVEL_BORE = Value("Levelling cylinder bore", 80, "mm")
LEVEL_ROD = Value("Levelling cylinder rod diameter", 45, "mm")
LEVEL_STROKE = Value("Levelling cylinder stroke", 133.8, "mm")
SPREAD = Value("Stabiliser spread", 2_700, "mm")
STABILISER_BORE = Value("Stabiliser cylinder bore", 80, "mm")
STABILISER_ROD = Value("Stabiliser cylinder rod diameter", 45, "mm")
STABILISER_STROKE = Value("Stabiliser cylinder stroke", 345, "mm")

# ---- ours: how things are drawn; a sheet does not print these --------
TYRE_WIDTH = Value("Tyre width", 400, "mm")
LIFT_CLOSED = Value("Lift cylinder closed length", 1_530, "mm")
TELESCOPE_CLOSED = Value("Telescoping cylinder closed length", 2_720, "mm")
TILT_CLOSED = Value("Tilt cylinder closed length", 660, "mm")
DRAWN_ONLY: tuple[Value, ...] = (
    TYRE_WIDTH, LIFT_CLOSED, TELESCOPE_CLOSED, TILT_CLOSED,)  # fmt: skip
_THREE = (LEVELLING, LEVEL_STROKE, LEVEL_BORE, LEVEL_ROD, SPREAD, STABILISER_BORE, STABILISER_ROD, STABILISER_STROKE)
PUBLISHED, EXAMPLE = sorted_values(globals(), (*DRAWN_ONLY, *_THREE))
