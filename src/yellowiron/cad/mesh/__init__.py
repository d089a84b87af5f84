"""Triangles: meshes at their places to an `Assembly`, metres.

In the order in which they build on each other: `components` (what hangs together), `measures` (area, volume, inertia,
content key), `shells` (which triangles bound one solid, which way is out), `copies` (meshes that are others at another
place), `features` (cylinders and planes that fit), `assembly` (placed meshes to an `Assembly`), which readers end with,
and `split` (an `Assembly` to one with a part for every solid). `polygons` makes triangles of polygons, boxes and balls.
"""
