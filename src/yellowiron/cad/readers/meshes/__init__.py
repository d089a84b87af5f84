"""Formats of triangles: a path to an `Assembly`.

`stl`, `ply` and `obj` state no unit, and give their meshes alone, too (`meshes_of`); `gltf` (looks: `gltf_materials`),
`threemf`, `assimp` (COLLADA and FBX, by the library of that name) and `blend` (by Blender) have units and a tree. All
give placed meshes with looks to `yellowiron.cad.mesh.assembly`.
"""
