"""The values the example crane is drawn to.

* `PUBLISHED`: printed for the Tadano GR-250N, a rough-terrain crane; `location` is where. Its turning radius is that of
  its front wheels, steered alone; its boom has four sections, which one cylinder and ropes draw out together.
* `EXAMPLE`: ours, plausible for the class; a sheet prints them as "example value".
* `CHART`: the maker's total rated loads on outriggers drawn out, in tonnes by radius in metres, of those boom lengths
  at those radii where the loads are bounded by the crane's stability (the loads below the bold lines).
"""

from __future__ import annotations

from drawing.values import Value, sorted_values

FACTS = "Tadano GR-250N specification sheet GR-250N-2-00102, JA-01"
MAKE, MODEL = "Tadano", "GR-250N"


def _published(name: str, value: float, unit: str, source: str, where: str = "page 2") -> Value:
    return Value(name, value, unit, source, where)


# ---- published --------
CAPACITY = _published("Maximum lifting capacity", 25_000, "kg", "Crane capacity, 9.35 m boom")
CAPACITY_RADIUS = _published("Radius at maximum capacity", 3_500, "mm", "Crane capacity, 25,000 kg x 3.5 m")
BOOM_IN = _published("Boom length retracted", 9_350, "mm", "Boom length, 9.35 m to 30.5 m")
BOOM_OUT = _published("Boom length extended", 30_500, "mm", "Boom length, 9.35 m to 30.5 m")
SECTIONS = _published("Number of boom sections", 4, "", "4-section box structure synchronously telescoping boom")
BOOM_HIGH = _published("Maximum boom angle", 84, "deg", "Boom elevation angle, 0 to 84 degrees")
BOOM_LOW = _published("Minimum boom angle", 0, "deg", "Boom elevation angle, 0 to 84 degrees")
RADIUS_OUT = _published("Maximum working radius", 27_900, "mm", "Max. working radius, boom")
LIFT_HEIGHT = _published("Maximum lifting height", 31_300, "mm", "Max. lifting height, boom")
LUFFING_TIME = _published("Boom luffing time", 45, "s", "Boom elevation speed")
TELESCOPE_TIME = _published("Boom telescoping time", 80, "s", "Boom extension speed")
LINE_SPEED = _published("Line speed", 120, "m/min", "Main winch single line winding speed")
LINE_PULL = _published("Line pull", 35.3, "kN", "The load per line should not exceed 3.6 t", "page 11")
FALLS = _published("Part lines", 8, "", "Number of part lines, 9.35 m boom", "page 11")
ROPE = _published("Hoist rope diameter", 16, "mm", "Wire rope, main winch")
SLEWING = _published("Slewing speed", 2.6, "rpm", "Swing speed")
SPREAD = _published("Outrigger spread", 6_500, "mm", "Fully extended width")
LENGTH = _published("Overall length", 11_410, "mm", "Overall length", "page 3")
WIDTH = _published("Overall width", 2_620, "mm", "Overall width", "page 3")
HEIGHT = _published("Overall height", 3_470, "mm", "Overall height", "page 3")
WHEELBASE = _published("Wheelbase", 3_880, "mm", "Wheel base", "page 3")
WEIGHT = _published("Operating weight", 25_595, "kg", "Gross vehicle weight", "page 3")
SPEED = _published("Maximum travel speed", 49, "km/h", "Max. traveling speed", "page 3")
TURNING = _published("Turning radius", 8_500, "mm", "Min. turning radius, 2-wheel steering", "page 3")
POWER = _published("Engine power", 200, "kW", "Max. output", "page 3")

# ---- ours: what the sheet prints as "example value" --------
TAIL = Value("Tail swing radius", 3_050, "mm")
BASE = Value("Outrigger spread longitudinal", 6_605, "mm")
CLEARANCE = Value("Ground clearance", 400, "mm")
TYRE = Value("Tyre diameter", 1_366, "mm")
PRESSURE = Value("Main relief pressure", 25, "MPa")
FLOW = Value("Main pump flow", 153.6, "L/min")
LUFFING_STROKE = Value("Luffing cylinder stroke", 1_630, "mm")
LUFFING_BORE = Value("Luffing cylinder bore", 300, "mm")
LUFFING_ROD = Value("Luffing cylinder rod diameter", 200, "mm")
TELESCOPE_STROKE = Value("Telescoping cylinder stroke", 7_050, "mm")
TELESCOPE_BORE = Value("Telescoping cylinder bore", 140, "mm")
TELESCOPE_ROD = Value("Telescoping cylinder rod diameter", 90, "mm")
BEAM_STROKE = Value("Outrigger beam cylinder stroke", 2_100, "mm")
BEAM_BORE = Value("Outrigger beam cylinder bore", 63, "mm")
BEAM_ROD = Value("Outrigger beam cylinder rod diameter", 45, "mm")
JACK_STROKE = Value("Outrigger jack cylinder stroke", 500, "mm")
JACK_BORE = Value("Outrigger jack cylinder bore", 120, "mm")
JACK_ROD = Value("Outrigger jack cylinder rod diameter", 90, "mm")
STEER_STROKE = Value("Steering cylinder stroke", 250, "mm")
STEER_BORE = Value("Steering cylinder bore", 100, "mm")
STEER_ROD = Value("Steering cylinder rod diameter", 38, "mm")

# ---- ours: how things are drawn; a sheet does not print these --------
TYRE_WIDTH = Value("Tyre width", 385, "mm")
TREAD = Value("Tread", 2_170, "mm")
LUFFING_CLOSED = Value("Luffing cylinder closed length", 2_560, "mm")
TELESCOPE_CLOSED = Value("Telescoping cylinder closed length", 7_620, "mm")
DRAWN_ONLY: tuple[Value, ...] = (TYRE_WIDTH, TREAD, LUFFING_CLOSED, TELESCOPE_CLOSED)
PUBLISHED, EXAMPLE = sorted_values(globals(), DRAWN_ONLY)

# ---- the load chart --------
STABILITY = 1.27
"""What a load that is bounded by stability may be times over before the crane tips: Japan's construction code for
mobile cranes, from memory."""
CHART: dict[float, dict[float, float]] = {
    16.4: {9.0: 9.2, 11.0: 6.3, 13.5: 4.25},
    23.45: {10.0: 7.6, 12.0: 5.5, 14.0: 4.15, 18.0: 2.5, 20.5: 1.9},
    30.5: {14.0: 4.25, 16.0: 3.4, 20.0: 2.15, 24.0: 1.35, 27.9: 0.9},
}
RATED: dict[float, dict[float, float]] = {9.35: {3.5: 25.0}, 16.4: {6.5: 15.0}, 30.5: {8.0: 8.0}}
"""Bounded by its strength: what it is to lift, as "crane capacity" is printed."""
