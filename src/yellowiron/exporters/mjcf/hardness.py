"""How hard MJCF's constraints are that hold a machine together."""

from __future__ import annotations

SOLREF = (0.002, 1.0)
"""Time constant (s) and damping ratio: twice a step of 1 ms, the stiffest that stays stable."""
SOLIMP = (0.9999, 0.9999, 0.001, 0.5, 2.0)
"""As in the USD. With 0.999 first, pins of a loaded wheel loader err ten times as much (0.022 against 0.002 mm)."""
