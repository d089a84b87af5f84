"""What a build writes on the prims of a machine's file beside what USD has words for, by `usd.authoring.metadata`."""

RECORD = "yellowiron"
"""The key of that record in a prim's `customData`."""

ENDLESS = 1e9
"""Degrees: a pivot's limit that is none. PhysX couples pivots only where both have finite ones, and takes these: wheels
on one chain followed each other over many turns."""

DETAIL, DETAILS = "Detail", ("full", "light", "visual")
"""The variant set of a machine's colliders, in its file and in what is exported of it: all of them, which is selected,
few and simple ones, or none."""
COLLIDING = DETAILS[:2]
"""Those that have colliders."""
