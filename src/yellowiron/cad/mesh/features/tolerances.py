"""What the modules of this package agree on: when triangles may be strips of a cylinder, and when they lie on one."""

from __future__ import annotations

import math

SLIGHTEST = math.radians(0.7)
"""The least fold between two strips: five hundred to a circle."""
WIDEST = math.radians(50.5)
"""The widest a flat strip may be, seen from the axis: eight to a circle, with a margin."""
ROUGH = 2e-3
"""Points are on a cylinder within this share of its radius, or …"""
LEAST = 2e-5
"""… this, metres: what meshes are off by that were noisy, or drawn by hand …"""
SMALL = 2.5e-3
"""… but by no more than this share of the radius, or of the mesh: models of models are small."""
FEWEST = 4
"""A cylinder rests on at least as many triangles: two strips of two each."""
