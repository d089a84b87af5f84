"""The mechanism measured: `Mechanism` with its measurements and specifications → `Measurement`s and, where closed
lengths are unknown, the `Mechanism` calibrated on them.

`sheet` (what the sheet says of a value), `quantities` (what can be measured on a pose), `extremes` (where over the
strokes a quantity is greatest or least), `bench` (actuators moved as a measurement's steps say), `measurement` (all
measurements, beside the sheet), `calibration` (unknown closed lengths from published ranges).
"""
