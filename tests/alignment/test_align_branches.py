"""The scene's tree as evidence: what moves with a node, and what with the next one above it."""

from __future__ import annotations

import numpy as np

from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.structure.branches import branches_of
from yellowiron.model.assembly import Assembly, Node, Part
from yellowiron.model.geometry import Mesh, Shape

CUBE = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 5, 7], [1, 7, 3]], dtype=np.int32)  # fmt: skip


def _assembly(nodes: list[tuple[str, int | None]], parts: dict[str, tuple[int | None, float]]) -> Assembly:
    """Cubes: name → (node, size)."""
    shapes = {}
    made = []
    for k, (name, (node, size)) in enumerate(parts.items()):
        shapes[name] = Shape(
            name, name, Mesh(CUBE * size, FACES), size**3, 6 * size**2, np.full(3, 0.5 * size), np.eye(3)
        )
        place = np.eye(4)
        place[0, 3] = 3.0 * k
        made.append(Part(name, name, (), name, place, node=node))
    return Assembly("m", "gltf", 1.0, tuple(made), shapes, nodes=tuple(Node(n, p, np.eye(4)) for n, p in nodes))


def _named(assembly: Assembly) -> set[tuple[str, str]]:
    solids = solids_of(assembly)
    return {(solids[a].part.id, solids[b].part.id) for a, b in branches_of(assembly, solids)}


def test_meshes_under_meshes_and_under_empty_pivots() -> None:
    nodes: list[tuple[str, int | None]] = [("Bottom", None), ("Base", 0), ("Joint1", 1), ("Arm", 2), ("Joint2", 2)]
    nodes += [("Stick", 4), ("Track", 0)]
    parts = {"bottom": (0, 2.0), "base": (1, 2.0), "arm": (3, 1.0), "stick": (5, 1.0), "track": (6, 3.0)}
    found = _named(_assembly(nodes, parts))
    assert found == {("base", "bottom"), ("arm", "base"), ("stick", "arm")}


def test_the_largest_part_stands_for_a_group() -> None:
    nodes: list[tuple[str, int | None]] = [("Upper", None), ("a", 0), ("b", 0), ("Boom", 0), ("c", 3), ("d", 3)]
    parts = {"hood": (1, 1.0), "frame": (2, 2.0), "boom": (4, 2.0), "pin": (5, 0.5)}
    assert _named(_assembly(nodes, parts)) == {("boom", "frame")}


def test_a_flat_tree_says_nothing() -> None:
    nodes: list[tuple[str, int | None]] = [("root", None), ("a", 0), ("b", 0)]
    assert _named(_assembly(nodes, {"one": (1, 1.0), "two": (2, 1.0)})) == set()
    assert _named(_assembly([], {"one": (None, 1.0)})) == set()
