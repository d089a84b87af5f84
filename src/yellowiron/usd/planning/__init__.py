"""What is written and where, decided once: `Mechanism` × `Assembly` → `Plan`.

`collision` (a collision token → what each engine calls it), `primitives` (the analytic shape that a mesh nearly is),
`lathe_colliders` (turned parts as stacks of discs), `pin_links` (links at the ends of cut pins), `plan` (names, paths
and transforms of every prim), `overlap` (bodies whose colliders overlap, on a plan).
"""
