"""A lift table on a cart: twin rams, both their halves fixed, push the table up on one slide; a double-rod ram shifts
what lies on it; a jack goes down. Whole cylinders with their pistons in a GLB file, and a template folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from yellowiron.model.geometry import Floats

BORE, ROD, STROKE, OUT = 0.08, 0.05, 0.6, 0.1
"""Of the lift rams: metres; they are drawn `OUT` out."""
SHIFT_STROKE, JACK_STROKE = 0.3, 0.4
PISTON, WALL, GLAND = 0.05, 0.01, 0.04
UP, DOWN, LEFT = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)

BOXES: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = {
    "CART": ((2.0, 1.4, 0.2), (0.0, 0.0, 0.1)),
    "CART MAST": ((0.2, 0.2, 0.89), (0.6, 0.0, 0.645)),
    "TABLE": ((1.8, 1.2, 0.1), (0.0, 0.0, 1.15)),
    "TOP": ((1.0, 0.5, 0.1), (0.0, 0.0, 1.5)),
    "FOOT": ((0.3, 0.3, 0.04), (-1.2, 0.0, 0.0)),
}


def documents() -> dict[str, dict[str, Any]]:
    """The template: hierarchy, joints, materials and actuators."""
    half = {"rigid body": "N"}
    lifts = {f"lift_cylinder_barrel_{s}": {**half, "kind": "barrel", "side": s} for s in "lr"}
    rods = {f"lift_piston_rod_{s}": {**half, "kind": "rod", "side": s} for s in "lr"}
    top = {"shift_piston_rod": {**half, "kind": "rod"}}
    table = {**rods, "shift_cylinder_barrel": {**half, "kind": "barrel"}, "top": {"rigid body": "Y", "child": top}}
    jack = {"jack_cylinder_barrel": {**half, "kind": "barrel"}}
    foot = {"foot": {"rigid body": "Y", "child": {"jack_piston_rod": {**half, "kind": "rod"}}}}
    cart = {**lifts, **jack, **foot, "table": {"rigid body": "Y", "child": table}}
    drive = {"joint_type": "Prismatic", "Drive": ["Linear Drive"]}
    return {
        "hierarchy": {"lift_table": {"rigid body": "N", "child": {"cart": {"rigid body": "Y", "child": cart}}}},
        "joints": {
            "lift_joint": {**drive, "Body": ["cart", "table"], "Limit": ["0", "Lift Cylinder Stroke"]},
            "shift_joint": {**drive, "Body": ["table", "top"]},
            "jack_joint": {**drive, "Body": ["foot", "cart"]},
        },
        "actuators": {
            "lift": {
                "kind": "cylinder",
                "cylinders": [
                    {
                        "slide": "lift_joint",
                        "rams": [[f"lift_cylinder_barrel_{s}", f"lift_piston_rod_{s}"] for s in "lr"],
                    }
                ],
                "specifications": {"stroke": "Lift Cylinder Stroke"},
                "defaults": {"pressure": "10 MPa", "flow": "30 L/min"},
            },
            "shift": {
                "kind": "cylinder",
                "cylinders": [
                    {
                        "slide": "shift_joint",
                        "rams": [["shift_cylinder_barrel", "shift_piston_rod"]],
                        "rod_through": "Y",
                    }
                ],
                "defaults": {"pressure": "10 MPa", "flow": "30 L/min"},
            },
            "jack": {
                "kind": "cylinder",
                "cylinders": [{"slide": "jack_joint", "rams": [["jack_cylinder_barrel", "jack_piston_rod"]]}],
                "defaults": {"pressure": "10 MPa", "flow": "30 L/min"},
            },
        },
        "materials": {"*": {"name": "frame", "density": 800.0}},
    }


def _along(mesh: trimesh.Trimesh, way: tuple[float, float, float], foot: tuple[float, float, float]) -> trimesh.Trimesh:
    """A mesh drawn along +z from the origin, along `way` from `foot`; y is up, as GLB has it."""
    turn = trimesh.geometry.align_vectors([0, 0, 1], way)
    turn[:3, 3] = foot
    mesh.apply_transform(turn)
    return mesh.apply_transform(np.array([[1.0, 0, 0, 0], [0, 0, 1.0, 0], [0, -1.0, 0, 0], [0, 0, 0, 1.0]]))


def _turned(profile: list[tuple[float, float]]) -> trimesh.Trimesh:
    """A solid of revolution about z through (radius, height) corners, closed on itself."""
    return trimesh.creation.revolve(np.array([*profile, profile[0]]), sections=48)


def _barrel(bore: float, rod: float, stroke: float, *, through: bool = False) -> trimesh.Trimesh:
    """From its foot at 0: a base (or a second gland), the bore, the gland."""
    r, outer, inside = bore / 2, bore / 2 + WALL, stroke + PISTON
    gap = rod / 2
    base = [(gap, GLAND), (gap, 0.0), (outer, 0.0)] if through else [(0.0, GLAND), (0.0, 0.0), (outer, 0.0)]
    top = GLAND + inside
    return _turned([*base, (outer, top + GLAND), (gap, top + GLAND), (gap, top), (r, top), (r, GLAND)])


def _rod(bore: float, rod: float, length: float, piston: float = 0.0) -> trimesh.Trimesh:
    """From 0: its piston (`piston` up it) on a shaft of that length."""
    r, q = bore / 2, rod / 2
    shaft = [(q, piston + PISTON), (q, length), (0.0, length), (0.0, 0.0)]
    return _turned([*shaft, *([(q, 0.0), (q, piston), (r, piston)] if piston else [(r, 0.0)]), (r, piston + PISTON)])


def write(folder: Path) -> tuple[Path, Path]:
    """The template's folder and the CAD file, in a folder."""
    scene = trimesh.Scene()
    flip: Floats = np.array([[1.0, 0, 0, 0], [0, 0, 1.0, 0], [0, -1.0, 0, 0], [0, 0, 0, 1.0]])
    for name, (size, middle) in BOXES.items():
        box = trimesh.creation.box(size)
        box.apply_translation(middle)
        scene.add_geometry(box.apply_transform(flip), node_name=name, geom_name=name)
    inside = STROKE + PISTON

    def add(name: str, mesh: trimesh.Trimesh) -> None:
        scene.add_geometry(mesh, node_name=name, geom_name=name)

    for side, y in (("L", 0.5), ("R", -0.5)):
        add(f"LIFT CYLINDER BARREL {side}", _along(_barrel(BORE, ROD, STROKE), UP, (0.0, y, 0.2)))
        rod = _rod(BORE, ROD, inside + GLAND + 0.12)
        add(f"LIFT PISTON ROD {side}", _along(rod, UP, (0.0, y, 0.2 + GLAND + OUT)))
    through = _barrel(0.06, 0.03, SHIFT_STROKE, through=True)
    long = SHIFT_STROKE + PISTON + 2 * GLAND
    add("SHIFT CYLINDER BARREL", _along(through, LEFT, (0.0, -long / 2, 1.3)))
    shaft = long + 2 * SHIFT_STROKE
    add("SHIFT PISTON ROD", _along(_rod(0.06, 0.03, shaft, (shaft - PISTON) / 2), LEFT, (0.0, -shaft / 2, 1.3)))
    add("JACK CYLINDER BARREL", _along(_barrel(0.1, 0.06, JACK_STROKE), DOWN, (-1.2, 0.0, 0.7)))
    add("JACK PISTON ROD", _along(_rod(0.1, 0.06, JACK_STROKE + PISTON + GLAND + 0.05), DOWN, (-1.2, 0.0, 0.66)))
    (folder / "lift_table").mkdir(parents=True)
    scene.export(folder / "lift_table.glb")
    for name, content in documents().items():
        (folder / "lift_table" / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")
    return folder / "lift_table", folder / "lift_table.glb"
