"""A mast of three stages, lifted by a drive on its middle section: chains lift the inner one and the carriage, each as
far as the section that carries it. Boxes in a GLB file, a template folder, and where the slides are."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import trimesh

LIFT = 1.5
"""Metres that the middle section rises, and each of the others in the one that carries it."""
BOXES: dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]] = {
    "CHASSIS": ((2.6, 1.1, 0.5), (-1.5, 0.0, 0.3)),
    "OUTER": ((0.16, 0.9, 2.0), (0.0, 0.0, 1.05)),
    "MIDDLE": ((0.12, 0.7, 1.9), (0.0, 0.0, 1.06)),
    "INNER": ((0.08, 0.5, 1.9), (0.0, 0.0, 1.07)),
    "CARRIAGE": ((0.2, 0.8, 0.5), (0.2, 0.0, 0.35)),
}
"""Size and middle, metres. The carriage's middle is below that of the section that carries it."""
SLIDES = ("middle_joint", "inner_joint", "carriage_joint")
FOLLOWS = {"inner_joint": "middle_joint", "carriage_joint": "inner_joint"}


def documents() -> dict[str, dict[str, Any]]:
    """The template: hierarchy, joints, materials and the actuator."""
    bodies: dict[str, Any] = {n.lower(): {"rigid body": "Y", "child": {}} for n in BOXES if n != "CHASSIS"}
    bodies["outer"] = {"rigid body": "Y", "kind": "frame", "child": {"chassis": {"rigid body": "N", "child": {}}}}
    slide = {"joint_type": "Prismatic", "Limit": [0.0, LIFT]}
    joints: dict[str, Any] = {
        "middle_joint": {**slide, "Body": ["outer", "middle"], "Drive": ["Linear Drive"],
                         "max_force": 60e3, "max_velocity": 0.5},
        "inner_joint": {"joint_type": "Prismatic", "Body": ["middle", "inner"], "follows": {"joint": "middle_joint"}},
        "carriage_joint": {"joint_type": "Prismatic", "Body": ["carriage", "inner"],
                           "follows": {"joint": "inner_joint", "ratio": 1.0, "kind": "chain"}},
    }  # fmt: skip
    return {
        "hierarchy": {"mast": {"rigid body": "N", "child": bodies}},
        "joints": joints,
        "materials": {"*": {"name": "frame", "density": 800.0}},
    }


def _up(place: tuple[float, float, float]) -> list[float]:
    """A place as GLB has it: y is up."""
    return [place[0], place[2], -place[1]]


def axes(**changes: Any) -> dict[str, Any]:
    """A joints document that says where the slides are: upright, in the middle of the mast."""
    places = {name: {"anchor": [0.0, 1.0, 0.0], "axis": [0.0, 1.0, 0.0]} for name in SLIDES}
    return {name: {**entry, **changes.get(name, {})} for name, entry in places.items()}


def write(folder: Path, joints: dict[str, Any] | None = None) -> tuple[Path, Path, Path]:
    """The template's folder, the CAD file and the document of the axes, in a folder."""
    scene = trimesh.Scene()
    for name, (size, middle) in BOXES.items():
        box = trimesh.creation.box([size[k] for k in (0, 2, 1)])
        box.apply_translation(_up(middle))
        scene.add_geometry(box, node_name=name, geom_name=name)
    (folder / "mast").mkdir(parents=True)
    scene.export(folder / "mast.glb")
    for name, content in documents().items():
        (folder / "mast" / f"{name}.json").write_text(json.dumps(content), encoding="utf-8")
    (folder / "axes.json").write_text(json.dumps(axes() if joints is None else joints), encoding="utf-8")
    return folder / "mast", folder / "mast.glb", folder / "axes.json"
