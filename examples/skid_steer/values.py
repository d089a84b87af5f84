"""The values the example skid steer is drawn to.

* `PUBLISHED`: printed by the maker for the Bobcat S76 (North America), as collected in the document named in `FACTS`;
  `source` is the line there. The maker prints inches and pounds; here they are millimetres and kilograms.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".

Lengths and the turning radius are with the lift arms lowered, the radius with the bucket rolled back; reach and dump
angle with the arms raised and the bucket dumped.
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

FACTS = "EXO equipment atlas, bobcat-s76-2, facts published by the manufacturer (BOBCAT-S76-2-NA-PRODUCT)"
MAKE, MODEL = "Bobcat", "S76"
INCH, POUND = 25.4, 0.45359237


def _published(name: str, inches: float, source: str) -> Value:
    return Value(name, round(inches * INCH, 4), "mm", source, f"{inches:g} in")


# ---- published --------
LENGTH = _published("Length with standard bucket", 142, "Length with standard bucket")
BARE_LENGTH = _published("Length without attachment", 114, "Length without attachment")
OVERALL_WIDTH = _published("Overall width", 72, "Width")
BUCKET_WIDTH = _published("Bucket width", 74, "Bucket width")
HEIGHT = _published("Overall height", 81.9, "Height")
HINGE_HEIGHT = _published("Height to bucket hinge pin", 128.3, "Height to bucket hinge pin")
REACH = _published("Reach at maximum height", 33.5, "Reach at maximum height")
TURNING_RADIUS = _published("Turning radius", 83.7, "Turning radius")
WHEELBASE = _published("Wheelbase", 48.3, "Wheelbase")
OPERATING_WEIGHT = Value("Operating weight", round(8014 * POUND, 1), "kg", "Operating weight", "8014 lb")
TYRE_SIZE = "12.00 x 16.5"

# ---- ours: what the sheet prints as "example value" --------
TYRE_DIAMETER = Value("Tyre diameter", 838, "mm")
GROUND_CLEARANCE = Value("Ground clearance", 210, "mm")
REAR_RADIUS = Value("Turning radius, rear", 1830, "mm")
ROLLBACK = Value("Rollback at ground", 25, "deg")
DUMP_ANGLE = Value("Dump angle at maximum lift", 40, "deg")
DIG_DEPTH = Value("Digging depth", 35, "mm")
LIFT_BORE = Value("Lift cylinder bore", 70, "mm")
LIFT_ROD = Value("Lift cylinder rod diameter", 45, "mm")
LIFT_STROKE = Value("Lift cylinder stroke", 850, "mm")
TILT_BORE = Value("Tilt cylinder bore", 70, "mm")
TILT_ROD = Value("Tilt cylinder rod diameter", 45, "mm")
TILT_STROKE = Value("Tilt cylinder stroke", 375, "mm")
PRESSURE = Value("System relief pressure", 23.8, "MPa")
FLOW = Value("Pump flow", 87, "L/min")
SPEED = Value("Maximum travel speed", 11.4, "km/h")
CAPACITY = Value("Rated operating capacity", 1300, "kg")
BUCKET_VOLUME = Value("Bucket capacity, heaped", 0.5, "m3")

# ---- ours: how things are drawn; a sheet does not print these --------
TYRE_WIDTH = Value("Tyre width", 305, "mm")
TILT_CLOSED = Value("Tilt cylinder closed length", 600, "mm")

DRAWN_ONLY: tuple[Value, ...] = (TYRE_WIDTH, TILT_CLOSED)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)
