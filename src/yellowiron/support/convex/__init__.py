"""Convex meshes: `pieces` (what a hollow part is cut into), `solids` (solids by their planes, and fewer of them)."""
