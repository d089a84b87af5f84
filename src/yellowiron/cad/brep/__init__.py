"""Exact surfaces: an XCAF document of Open CASCADE to an `Assembly`. Millimetres in, metres out.

In the order in which they build on each other: `tessellate` (shapes to meshes), `features` (faces to cylinders and
planes), `to_shape` (a solid to a `Shape`), `xcaf` (documents: product trees, names, colours, places), and `products`
(a document to an `Assembly`), which readers end with. Triangles within a document are measured by
`yellowiron.cad.mesh`.
"""
