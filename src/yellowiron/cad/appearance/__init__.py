"""Colours, finishes and textures: what a material says to what a `Mesh` has of it.

`textures` finds pictures beside a model and bounds them; `looks` gives meshes one look, or one a triangle.
"""
