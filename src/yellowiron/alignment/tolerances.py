"""What several modules of the alignment hold for parallel, upright, round, near or stout enough, each with its reason.

A cosine says how far two unit directions may be apart; a share of the machine's size is one of the diagonal of its box
(`features.solids.size_of`). What one module alone decides by is there.
"""

from __future__ import annotations

# ---- directions: cosines ----
PARALLEL = 1 - 2e-5
"""Two axes, or a face's normal and an axis, that touch each other are parallel (0.36°): exact faces are to rounding,
those found on triangles to some tenths of a degree, and a slant beyond is another joint."""
NEARLY_PARALLEL = PARALLEL**9
"""The same, three times as far apart (1.1°): a quick look that leaves pairs out before the exact one."""
PARALLEL_BY_EYE = 1 - 100 * (1 - PARALLEL)
"""… ten times as far apart (3.6°): bosses that were rounded by eye."""
FACING = 0.99995
"""Two flat faces that lie on each other face each other (0.57°): planes of triangles are less exact than axes."""
PARALLEL_WALLS = 0.9998
"""Two walls of telescopic sections, which are drawn with some play, are parallel (1.1°)."""
PARALLEL_TWINS = 0.9995
"""Things of one kind that are drawn one by one, twin cylinders or the wheels of a track, are parallel (1.8°)."""
SAME_DIRECTION = 0.999
"""Axes of one machine are meant to be parallel (2.6°): for the commonest direction, of which machines have two."""
UPRIGHT = 0.98
"""An axis is upright (11°): the upright is found from wheels or tracks alone, and all other axes lie far from it."""
ACROSS = 0.05
"""Two axes are across each other up to this cosine (87°): an eye and its hydraulic cylinder."""

# ---- round faces ----
ROUND_ARC = 2.0
"""Radians around from which a cylindrical face holds a pin or is an eye: less is a fillet or a rounded edge."""

# ---- shares of the machine's size ----
CONTACT = (4e-5, 3e-4, 1e-3)
"""Two faces touch within this share of the machine's size (0.4 mm on 10 m); the wider ones are for machines that the
first does not find whole (moved or shrunk parts)."""
FAR = 0.05
"""What is further than this from every part of the machine is no part of it: half a metre on 10 m."""
LEAST_PIVOT = 0.002
"""The radius from which a bar or a round end is a pivot of the machine (20 mm on 10 m): less is a bolt."""
LEAST_SLEWING = 0.02
"""The radius from which a round base or a ring is a slewing bearing (200 mm on 10 m): more than any pin's."""

# ---- shares of a radius ----
TWIN = 0.02
"""Two bars or bores of one part are twins if their radii (and lengths) are equal within this share."""
