"""How near is the same: the tolerances that several modules of the mechanism share. What only one of them asks stands
with it."""

import math

PARALLEL = math.radians(0.5)
"""Axes and planes within this were drawn to be parallel: ten times what fitted axes are out by; beyond it a loop is
taken to be spatial."""
SAME_ANGLE = math.radians(0.3)
"""Two features may be on one axis if their directions differ by less than this …"""
SAME_OFFSET = 5e-4
"""… and the middle of one is nearer to the other's axis than this, metres."""
