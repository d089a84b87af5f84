"""How anything is written: `pxr` layers, prims and attributes, and what the model's values look like in them.

`stage` (layers, prims, attributes, schemas), `rotation` (quaternions of frames), `merge_points` (meshes' coincident
points), `materials` (looks, textures, physical materials), `metadata` (a mechanism as `customData`, and back). None of
them knows a plan; only `materials` builds on another, `stage`.
"""
