"""The values the example forklift is drawn to.

Two kinds, never mixed:

* published: printed of the Mitsubishi FD70N (7 t, pneumatic tyres). `source` says where: its workshop manual, part 3,
  hydraulic system, page 11-1 (scribd.com/document/723649080), or a review with the maker's figures
  (tradeplantequipment.com.au/reviews/1412).
* ours: plausible for the class, chosen for this example; the sheet prints them as "example value".

Lengths are millimetres, angles degrees, masses kilograms, pressures MPa, flows L/min, speeds m/s and km/h, forces kN.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

MANUAL = "FD70N workshop manual, part 3, page 11-1"
REVIEW = "tradeplantequipment.com.au, review 1412"


# ---- published --------
LIFT_BORE = Value("Lift cylinder bore", 80, "mm", MANUAL)
LIFT_STROKE = Value("Lift cylinder stroke", 1500, "mm", MANUAL)
"""That of the simplex mast with which the forks rise 3000 mm, as the same line of the manual has it."""
LIFT_HEIGHT = Value("Lift", 3000, "mm", MANUAL)
TILT_BORE = Value("Tilt cylinder bore", 90, "mm", MANUAL)
TILT_STROKE = Value("Tilt cylinder stroke", 229, "mm", MANUAL)
MAIN_PRESSURE = Value("Main relief pressure", 19.1, "MPa", MANUAL)
MAIN_FLOW = Value("Control flow rate", 160, "L/min", MANUAL)
RATED_CAPACITY = Value("Rated capacity", 7000, "kg", REVIEW)
SERVICE_WEIGHT = Value("Service weight", 9500, "kg", REVIEW)
LENGTH_TO_FORK = Value("Length to face of forks", 3592, "mm", REVIEW)
GUARD_HEIGHT = Value("Height of overhead guard", 2610, "mm", REVIEW)

# ---- ours: what the sheet prints as "example value" --------
LIFT_ROD = Value("Lift cylinder rod diameter", 60, "mm")
TILT_ROD = Value("Tilt cylinder rod diameter", 50, "mm")
STEER_BORE = Value("Steering cylinder bore", 80, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 50, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 220, "mm")
TILT_FORWARD = Value("Tilt of mast, forward", 6, "deg")
TILT_BACKWARD = Value("Tilt of mast, backward", 12, "deg")
LOWERED_HEIGHT = Value("Height of mast, lowered", 2470, "mm")
EXTENDED_HEIGHT = Value("Height of mast, extended", 4220, "mm")
LOAD_CENTER = Value("Load centre distance", 600, "mm")
LOAD_DISTANCE = Value("Load distance", 600, "mm")
WHEELBASE = Value("Wheelbase", 2300, "mm")
FRONT_TREAD = Value("Tread, front", 1600, "mm")
REAR_TREAD = Value("Tread, rear", 1740, "mm")
OVERALL_LENGTH = Value("Overall length", 4812, "mm")
OVERALL_WIDTH = Value("Overall width", 1974, "mm")
FORK_LENGTH = Value("Fork length", 1220, "mm")
FORK_WIDTH = Value("Fork width", 150, "mm")
FORK_THICKNESS = Value("Fork thickness", 65, "mm")
CARRIAGE_WIDTH = Value("Fork carriage width", 1700, "mm")
MAST_CLEARANCE = Value("Ground clearance below mast", 120, "mm")
TYRE_DIAMETER = Value("Tyre outside diameter", 838, "mm")
TYRE_WIDTH = Value("Tyre section width", 234, "mm")
TRAVEL_SPEED = Value("Travel speed without load", 26, "km/h")
LIFT_SPEED = Value("Lift speed without load", 0.53, "m/s")
"""Twice the flow over the rams' areas."""
DRAWBAR_PULL = Value("Drawbar pull with load", 52, "kN")

# ---- ours: the other masts of the same drawing, for tests --------
FREE_BORE = Value("Free lift cylinder bore", 140, "mm", MANUAL)
FREE_STROKE = Value("Free lift cylinder stroke", 730, "mm", MANUAL)
SECOND_STROKE = Value("Second lift cylinder stroke", 1270, "mm", MANUAL)
"""Of the triplex mast that lifts 4 m, by the same page: twice the sum of both."""
FREE_ROD = Value("Free lift cylinder rod diameter", 90, "mm")

TYRE_SIZE = "8.25-15-12PR"
MAKE, MODEL = "Mitsubishi", "FD70N"
OTHER_MASTS = (FREE_BORE, FREE_STROKE, SECOND_STROKE, FREE_ROD)
PUBLISHED, EXAMPLE = sorted_values(globals(), OTHER_MASTS)
