"""Robot descriptions at their zero configuration: a path to an `Assembly` with the joints that the file declares.

`urdf` reads the meshes that it names with `mesh_files`; `mjcf` is compiled by MuJoCo.
"""
