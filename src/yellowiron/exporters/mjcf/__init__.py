"""MJCF, MuJoCo's format: a `Mechanism` and its `Geometry` → the machine's document, its scene and its mesh files.

In order: `values` (numbers and frames as MJCF writes them), `sensors` (their sites and their section), `document` (the
rest, and the files).
"""
