"""How exactly linkages close and conditions are met: each an order or more below the next, so that what a step leaves
is never taken for what the next one looks for. Metres; of a pivot's coordinate radians."""

CLOSED = 1e-12
"""Largest gap left in a loop's independent closure equations, for machines up to 10 m; it grows beyond. A double holds
no more."""
REACHED = 1e-9
"""How exactly the conditions of a `solve` step are met."""
MET = 1e-6
"""How exactly a subject of an extreme is met: its search ends there."""
PINS_APART = 1e-4
"""Gap at a loop's pins, half a metre along the axis included, that pins of a sound drawing do not leave."""
RANK = 1e-3
"""Relative size below which a closure equation counts as dependent on the others."""
