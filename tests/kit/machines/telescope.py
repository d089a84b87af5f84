"""A small crane with a telescopic boom of three box sections, a lift cylinder and a turntable, with known joints."""

from __future__ import annotations

import numpy as np
import trimesh

from kit.machines.solids import _shape, around, box, place, plate, tube
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import PlaneFeature, Shape

ACROSS = (0.0, 1.0, 0.0)
BOOM_PIN, BARREL_PIN, ROD_PIN = (0.0, 0.0, 2.0), (0.3, 0.0, 1.2), (1.5, 0.0, 1.75)
SECTIONS = ((4.0, 0.50, 0.40), (3.8, 0.42, 0.32), (3.6, 0.34, 0.24))
"""Length, height and width of the boom's boxes, metres, with walls of 20 mm: 20 mm between them."""


def rectangular_tube(name: str, length: float, height: float, width: float, wall: float) -> Shape:
    """A box open at both ends, along x from 0."""
    points = []
    for x in (0.0, length):
        for w, h in ((width, height), (width - 2 * wall, height - 2 * wall)):
            points += [(x, s * w / 2, t * h / 2) for s, t in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    faces, planes = [], []
    for k in range(4):
        j = (k + 1) % 4
        faces += [(k, 8 + k, 8 + j), (k, 8 + j, j), (4 + k, 4 + j, 12 + j), (4 + k, 12 + j, 12 + k)]
        faces += [(k, j, 4 + j), (k, 4 + j, 4 + k), (8 + k, 12 + j, 8 + j), (8 + k, 12 + k, 12 + j)]
    mesh = trimesh.Trimesh(np.array(points), np.array(faces), process=False)
    mesh.fix_normals()
    for normal, half in (((0.0, 1.0, 0.0), width / 2), ((0.0, 0.0, 1.0), height / 2)):
        for sign in (1.0, -1.0):
            out = tuple(sign * v for v in normal)
            inward = tuple(-v for v in out)
            planes.append(PlaneFeature(tuple(half * v for v in out), out, length * 2 * half))
            planes.append(PlaneFeature(tuple((half - wall) * v for v in out), inward, length * 2 * (half - wall)))
    return _shape(name, mesh, [], planes)


def crane(extension: float = 1.0) -> tuple[Assembly, dict[str, str]]:
    """The assembly, and part id → body. Sections are out by `extension` metres each."""
    shapes: dict[str, Shape] = {}
    parts: list[Part] = []
    truth: dict[str, str] = {}

    def add(body: str, name: str, shape: Shape, matrix: np.ndarray) -> None:
        shapes.setdefault(shape.key, shape)
        parts.append(Part(f"CRANE/{name}", name, ("CRANE",), shape.key, matrix))
        truth[f"CRANE/{name}"] = body

    def pin(name: str, body: str, at: tuple[float, ...], radius: float, length: float) -> None:
        start = np.array(at) - 0.5 * length * np.array(ACROSS)
        add(body, name, tube(name, radius, 0.0, length), place(start, ACROSS))

    add("chassis", "CHASSIS", box("chassis", 3.0, 2.0, 0.5), place((0, 0, 0.25), (0, 0, 1), (1, 0, 0)))
    add("chassis", "RING OUTER", tube("ring_outer", 0.6, 0.5, 0.1), place((0, 0, 0.5), (0, 0, 1)))
    add("tower", "RING INNER", tube("ring_inner", 0.5, 0.4, 0.1), place((0, 0, 0.52), (0, 0, 1)))
    add("tower", "DECK", box("deck", 1.4, 1.0, 0.1), place((0, 0, 0.67), (0, 0, 1), (1, 0, 0)))
    cheek = around((-0.2, 0.72, 0), (0.5, 0.72, 0), (0.3, 1.2, 0.12), (0.0, 2.0, 0.15))
    for side, y in (("L", 0.25), ("R", -0.25)):
        holes = [(0.0, 2.0, 0.06), (0.3, 1.2, 0.05)]
        add("tower", f"CHEEK {side}", plate("cheek", cheek, 0.06, holes), place((0, y, 0), (0, -1, 0), (1, 0, 0)))
    height = BOOM_PIN[2] + 0.3
    for k, (length, tall, wide) in enumerate(SECTIONS):
        start = (-0.1 + extension * k, 0.0, height)
        add(
            f"section_{k}",
            f"SECTION {k}",
            rectangular_tube(f"section_{k}", length, tall, wide, 0.02),
            place(start, (0, 0, 1), (1, 0, 0)),
        )
    lug = around((-0.15, -0.25, 0), (0.15, -0.25, 0), (0.0, -0.3, 0.12))
    foot = plate("foot", lug, 0.3, [(0.0, -0.3, 0.06)])
    add("section_0", "FOOT", foot, place((0.0, 0.0, height), (0, -1, 0), (1, 0, 0)))
    lug = around((-0.15, 0.3, 0), (0.15, 0.3, 0), (0.0, 0.0, 0.1))
    for side, y in (("L", 0.12), ("R", -0.12)):
        eye = plate("rod_lug", lug, 0.04, [(0.0, 0.0, 0.05)])
        add("section_0", f"ROD LUG {side}", eye, place((ROD_PIN[0], y, ROD_PIN[2]), (0, -1, 0), (1, 0, 0)))
    pin("BOOM PIN", "tower", BOOM_PIN, 0.06, 0.56)
    pin("BARREL PIN", "tower", BARREL_PIN, 0.05, 0.56)
    pin("ROD PIN", "section_0", ROD_PIN, 0.05, 0.28)
    along = np.subtract(ROD_PIN, BARREL_PIN)
    reach = float(np.linalg.norm(along))
    along = along / reach
    eye = around((0.0, 0.0, 0.1))
    for body, at in (("barrel", BARREL_PIN), ("rod", ROD_PIN)):
        wide = 0.4 if body == "barrel" else 0.18
        add(body, f"{body} EYE".upper(), plate(f"{body}_eye", eye, wide, [(0, 0, 0.05)]), place(at, (0, -1, 0), along))
    base = np.array(BARREL_PIN) + 0.09 * along
    add("barrel", "BARREL TUBE", tube("barrel", 0.09, 0.07, 0.75), place(base, along))
    add("barrel", "BARREL CAP", tube("cap", 0.09, 0.0, 0.04), place(base - 0.04 * along, along))
    rod = np.array(ROD_PIN) - 0.09 * along
    add("rod", "ROD BAR", tube("rod", 0.04, 0.0, 0.75), place(rod - 0.75 * along, along))
    return Assembly("crane", "synthetic", 1.0, tuple(parts), shapes), truth
