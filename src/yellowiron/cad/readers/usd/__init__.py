"""USD files of any origin: a path to an `Assembly`, with the joints that it declares, if any.

`stage` walks the meshes that are drawn; `looks` has their materials, `joints` those of USD physics.
"""
