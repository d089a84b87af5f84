"""What every reader of CAD agrees on: what may be part of a machine, and when two axes are one."""

from __future__ import annotations

LARGEST = 1e3
"""Metres. Nothing in a machine is larger: a wrong unit, or a coordinate that is damaged."""
FINEST = 1e-3
"""Metres: the smallest unit that models are drawn in."""
SMALLEST = 1e-3
"""Metres: a whole model that is smaller was exported in a wrong unit."""
PARALLEL = 0.999
"""Cosine between the axes of two patches of one cylinder, at least (2.6°): a short patch has no surer direction, and
whether the axes coincide is asked by their distance."""
