"""The values the example articulated dump truck is drawn to.

* `PUBLISHED`: printed by the maker for the Cat 740 GC, or by its dealer where `source` says so.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

Lengths and heights are unladen, straight ahead, with the body lowered unless they say otherwise.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

FACTS = "Caterpillar, 740 GC technical specifications (manualmachine.com/cat/740gc/17904591-specifications)"
DEALER = "cashmanequipment.com/compare, 740 GC bare chassis, standard wheel base"
MAKE, MODEL = "Caterpillar", "740 GC"
INCH = 25.4

# ---- published --------
GROSS_POWER = Value("Gross power, SAE J1995", 337, "kW", FACTS, "engine")
NET_POWER = Value("Net power, SAE J1349", 327, "kW", FACTS, "engine")
PAYLOAD = Value("Rated payload", 36_300, "kg", FACTS, "weights")
HEAPED = Value("Body capacity, heaped 2:1", 22.7, "m3", FACTS, "body capacities")
STRUCK = Value("Body capacity, struck", 17, "m3", FACTS, "body capacities")
TOP_SPEED = Value("Top speed, forward 9", 57.5, "km/h", FACTS, "transmission")
REVERSE_SPEED = Value("Top speed, reverse 2", 15.7, "km/h", FACTS, "transmission")
WHEELBASE = Value("Wheelbase, front axle to bogie", round(162.4 * INCH, 2), "mm", DEALER, "162.4 in")

# ---- ours: what the sheet prints as "example value" --------
EMPTY_WEIGHT = Value("Empty weight", 33_500, "kg")
LENGTH = Value("Overall length", 10_000, "mm")
OVERALL_WIDTH = Value("Overall width, over tires", 3_420, "mm")
HEIGHT = Value("Overall height", 3_740, "mm")
RAISED_HEIGHT = Value("Height, body raised", 6_450, "mm")
LOADING_HEIGHT = Value("Loading height", 3_150, "mm")
DUMP_CLEARANCE = Value("Dump clearance", 800, "mm")
BODY_WIDTH = Value("Body width, outside", 3_200, "mm")
BOGIE_SPACING = Value("Bogie axle spacing", 1_940, "mm")
FRONT_TREAD = Value("Front tread", 2_680, "mm")
REAR_TREAD = Value("Rear tread", 2_680, "mm")
FRONT_OVERHANG = Value("Front overhang", 3_100, "mm")
GROUND_CLEARANCE = Value("Ground clearance", 605, "mm")
TYRE_DIAMETER = Value("Tire diameter", 1_860, "mm")
TURNING_RADIUS = Value("Turning radius, outside tires", 7_130, "mm")
ARTICULATION = Value("Articulation angle", 45, "deg")
APPROACH_ANGLE = Value("Approach angle", 20, "deg")
DUMP_ANGLE = Value("Body dump angle", 70, "deg")
RAISE_TIME = Value("Body raise time", 11.9, "s")
LOWER_TIME = Value("Body lower time", 7.6, "s")
HOIST_BORE = Value("Hoist cylinder bore", 200, "mm")
HOIST_ROD = Value("Hoist cylinder rod diameter", 120, "mm")
HOIST_STROKE = Value("Hoist cylinder stroke", 1_470, "mm")
STEER_BORE = Value("Steering cylinder bore", 130, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 75, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 550, "mm")
PRESSURE = Value("Body hoist relief pressure", 20.0, "MPa")
FLOW = Value("Hoist pump flow", 465, "L/min")

# ---- ours: how things are drawn; a sheet does not print these --------
TYRE_WIDTH = Value("Tire width", 740, "mm")
HOIST_CLOSED = Value("Hoist cylinder closed length", 2_125, "mm")
STEER_CLOSED = Value("Steering cylinder closed length", 912, "mm")

TYRE_SIZE = "29.5R25"
DRAWN_ONLY: tuple[Value, ...] = (TYRE_WIDTH, HOIST_CLOSED, STEER_CLOSED)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
