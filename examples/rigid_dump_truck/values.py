"""The values the example rigid dump truck is drawn to.

* `PUBLISHED`: printed by the maker for the Cat 773F with the dual slope body.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

Lengths and heights are unladen, straight ahead, with the body lowered unless they say otherwise.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

FACTS = "Caterpillar, 773F brochure (123docz.net/document/3441674)"
MAKE, MODEL = "Caterpillar", "773F"


def _published(name: str, value: float, line: str) -> Value:
    return Value(name, value, "mm", FACTS, line)


# ---- published --------
LENGTH = _published("Overall length", 10_249, "Overall length (dual)")
BODY_LENGTH = _published("Overall body length", 9_211, "Overall body length (dual)")
WHEELBASE = _published("Wheelbase", 4_215, "Wheelbase")
REAR_OVERHANG = _published("Rear axle to tail", 2_749, "Rear axle to tail")
HEIGHT = _published("Height to top of ROPS", 4_116, "Height to Top of ROPS (dual slope)")
CANOPY_HEIGHT = _published("Front canopy height", 4_460, "Front canopy height")
RAISED_HEIGHT = _published("Overall height, body raised", 9_261, "Overall height body raised")
LOADING_HEIGHT = _published("Loading height, empty", 3_773, "Loading height empty")
DUMP_CLEARANCE = _published("Dump clearance", 616, "Dump clearance")
TYRES_WIDTH = _published("Overall tire width", 4_406, "Overall tire width")
CANOPY_WIDTH = _published("Overall canopy width", 4_735, "Overall canopy width")
BODY_WIDTH = _published("Outside body width", 3_919, "Outside body width")
FRONT_TREAD = _published("Centerline front tire width", 3_205, "Centerline front tire width")
REAR_TREAD = _published("Centerline rear dual tire width", 2_929, "Centerline rear dual tire width")
AXLE_CLEARANCE = _published("Rear axle clearance", 675, "Rear axle clearance")

# ---- ours: what the sheet prints as "example value" --------
TYRE_DIAMETER = Value("Tire diameter", 2_160, "mm")
STEER_ANGLE = Value("Steering angle", 39, "deg")
DUMP_ANGLE = Value("Body dump angle", 52, "deg")
PAYLOAD = Value("Rated payload", 54_000, "kg")
EMPTY_WEIGHT = Value("Empty weight", 45_000, "kg")
STRUCK = Value("Body capacity, struck", 26.6, "m3")
HEAPED = Value("Body capacity, heaped 2:1", 35.2, "m3")
RAISE_TIME = Value("Body raise time", 10.1, "s")
LOWER_TIME = Value("Body lower time", 7.3, "s")
HOIST_BORE = Value("Hoist cylinder bore", 285, "mm")
HOIST_ROD = Value("Hoist cylinder rod diameter", 150, "mm")
HOIST_STROKE = Value("Hoist cylinder stroke", 1_300, "mm")
STEER_BORE = Value("Steering cylinder bore", 150, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 70, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 260, "mm")
PRESSURE = Value("Body hoist relief pressure", 22.0, "MPa")
FLOW = Value("Hoist pump flow", 985, "L/min")
TOP_SPEED = Value("Top speed", 67.5, "km/h")

# ---- ours: how things are drawn; a sheet does not print these --------
TYRE_WIDTH = Value("Tire width", 655, "mm")
HOIST_CLOSED = Value("Hoist cylinder closed length", 1_900, "mm")
STEER_CLOSED = Value("Steering cylinder closed length", 725, "mm")

TYRE_SIZE = "24.00R35"
DRAWN_ONLY: tuple[Value, ...] = (TYRE_WIDTH, HOIST_CLOSED, STEER_CLOSED)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
