"""The values the example rollers are drawn to: a tandem after the Volvo DD128C, and a soil compactor of one drum.

* `PUBLISHED`: printed by the maker for the Volvo DD128C. The soil compactor has none: it is ours, of the 12 t class.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from drawing.values import Value, sorted_values

FACTS = "Volvo Construction Equipment, DD128C, VOE2210009504"
MAKE, MODEL = "Volvo", "DD128C"

# ---- published --------
DRUM_DIAMETER = Value("Drum diameter", 1_400, "mm", FACTS, "drum")
DRUM_WIDTH = Value("Drum width", 2_000, "mm", FACTS, "drum")
ARTICULATION = Value("Articulation angle", 40, "deg", FACTS, "steering")
OSCILLATION = Value("Oscillation angle", 10, "deg", FACTS, "steering")

# ---- ours: what the sheet prints as "example value" --------
OPERATING_WEIGHT = Value("Operating weight", 12_500, "kg")
GROSS_POWER = Value("Gross power", 110, "kW")
TOP_SPEED = Value("Maximum travel speed", 12, "km/h")
WHEELBASE = Value("Wheelbase", 3_400, "mm")
TURNING_RADIUS = Value("Turning radius, outside", 5_671, "mm")
INNER_RADIUS = Value("Turning radius, inside", 3_670, "mm")
LENGTH = Value("Overall length", 5_100, "mm")
OVERALL_WIDTH = Value("Overall width", 2_170, "mm")
HEIGHT = Value("Overall height", 3_020, "mm")
CURB_CLEARANCE = Value("Curb clearance", 540, "mm")
GROUND_CLEARANCE = Value("Ground clearance", 540, "mm")
STEER_BORE = Value("Steering cylinder bore", 80, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 45, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 390, "mm")
PRESSURE = Value("Steering relief pressure", 17.5, "MPa")
FLOW = Value("Steering pump flow", 40, "L/min")

# ---- ours: how things are drawn; a sheet does not print these --------
STEER_CLOSED = Value("Steering cylinder closed length", 690, "mm")
SHELL = Value("Drum shell thickness", 20, "mm")

DRAWN_ONLY: tuple[Value, ...] = (STEER_CLOSED, SHELL)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)


@dataclass(frozen=True, slots=True)
class Machine:
    """What differs between the two machines. `tyre`: diameter of the tyres, their width and tread; None where a second
    drum is in their place. `published`: whether a maker prints the machine."""

    title: str
    wheelbase: Value
    turning_radius: Value
    inner_radius: Value
    length: Value
    width: Value
    height: Value
    ground: Value
    weight: Value
    tyre: tuple[Value, Value, Value] | None = None
    published: bool = True

    def own(self, value: Value) -> Value:
        """A published value as this machine's sheet has it: ours where no maker prints it."""
        return value if self.published else replace(value, source=None, location="")

    @property
    def values(self) -> tuple[Value, ...]:
        """All that its sheet prints and its drawing shows."""
        both = (DRUM_DIAMETER, DRUM_WIDTH, ARTICULATION, OSCILLATION)
        tyre = self.tyre[:1] if self.tyre else ()
        sizes = (self.wheelbase, self.turning_radius, self.length, self.width, self.height, self.ground, CURB_CLEARANCE)
        return (*(self.own(v) for v in both), *sizes, *tyre)


TANDEM = Machine(
    f"Example tandem roller, {MODEL} class", WHEELBASE, TURNING_RADIUS, INNER_RADIUS, LENGTH, OVERALL_WIDTH,
    HEIGHT, GROUND_CLEARANCE, OPERATING_WEIGHT,
)  # fmt: skip
SINGLE = Machine(
    "Example soil compactor, single drum", replace(WHEELBASE, value=3_300),
    replace(TURNING_RADIUS, value=5_616), replace(INNER_RADIUS, value=3_493), replace(LENGTH, value=5_600),
    OVERALL_WIDTH, HEIGHT, replace(GROUND_CLEARANCE, value=500), replace(OPERATING_WEIGHT, value=11_800),
    (Value("Tire diameter", 1_520, "mm"), Value("Tire width", 570, "mm"), Value("Tread", 1_560, "mm")), False,
)  # fmt: skip
MACHINES = {"tandem": TANDEM, "single": SINGLE}
TYRE_SIZE = "23.1-26"
