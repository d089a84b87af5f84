"""The layers of a machine, one concept a module: `Plan` → opinions in an `Sdf.Layer`.

`geometry` (prototypes), `base` (bodies, visuals, colliders, sites), `drives` and `joints`, `articulation` (its root),
`physics` (UsdPhysics), then what one engine calls its own: `physx`, `mujoco` (and Newton); `sensors`; `scene` (the
machine file with its variants, and a scene around it).
"""
