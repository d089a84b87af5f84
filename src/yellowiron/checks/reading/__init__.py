"""A USD file → `View`: everything that the rules read, read once.

In order: `opening` (file → stage), `attributes` (values of prims, by type), `bodies` (with colliders and materials),
`joints`, `layers` (units, references, what lies outside its layer), and `stage`, which puts them together.
"""
