"""What geometry shows of single parts and pairs of them, before any role.

In: an `Assembly`. Out: `Solid` for each part; `Fit`, `SharedAxis` and `Flat` for what touches; `DrawnCylinder`, `Nest`,
`Wheel` and `Track` for what is told by its shape; part ids for what stands apart.

In this order: `solids` (parts in the CAD frame), `distance` (how near meshes are, asked when needed), `contacts`;
`cylinders` and `undrilled_cylinders`; `undrilled` and `pinless_pivots` (pivots that are not drawn as pins in bores);
`telescopes`, `wheels`; `track_wheels` and `tracks`. `separate_parts` and `ground` need the assembly alone.
"""
