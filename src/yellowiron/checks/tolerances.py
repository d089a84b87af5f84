"""Tolerances that several rules share, each with its reason."""

from __future__ import annotations

FRAMES_APART = 1e-4
"""Metres, at points farther than 10 m from the origin in proportion: a joint's frames this near are at one place
(SimReady's DJ.003)."""
CLOSED = 2e-4
"""Singular values of loop closure below this close nothing: axes that differ by some hundredths of a degree still count
as parallel."""
DEPENDENT = 1e-3
"""Singular values of drives' shares in the motions below this: the drives depend on each other."""
STILL = 1e-6
"""A joint whose share in every motion is below this cannot move."""
