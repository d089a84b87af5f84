"""Surfaces fitted to triangles: a `Mesh` to cylinders, planes and knuckles (`facets.find`), metres, in its frame.

In the order in which they build on each other: `tolerances`, `soup` (which triangle is beside which), `roundness` (the
cylinder through points), `strips` (guesses at cylinders), `ovals` (what is round and no cylinder), and `facets`, which
judges what was found.
"""
