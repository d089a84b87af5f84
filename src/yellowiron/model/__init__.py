"""The vocabulary: frozen dataclasses that every stage takes and gives. Metres, kilograms, seconds, radians.

What is said: `errors`, `finding`. What is known beforehand: `sensor`, `machine_tests`, `template`, `rows` (its counted
rows made concrete). What comes in: `specification` (a sheet's values), `geometry` and `assembly` (a CAD model), `found`
(what geometry alone finds in one). What is made of them: `alignment`, `mechanism`, `record` (its key in a file). What
it does: `poses`, `sweep`. How values are written and read: `text`, `units`.
"""
