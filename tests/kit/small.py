"""The smallest machine that builds: a frame, an arm and the pin between them, as a GLB file and a template folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

HIERARCHY: dict[str, Any] = {
    "small": {
        "rigid body": "N",
        "child": {
            "frame": {"rigid body": "Y", "child": {}},
            "arm": {"rigid body": "Y", "child": {"pin": {"rigid body": "N", "child": {}}}},
        },
    }
}
JOINTS: dict[str, Any] = {
    "hinge": {
        "joint_type": "Revolute",
        "Body": ["frame", "pin"],
        "Limit": ["-Arm Angle Down", "Arm Angle Up"],
        "Drive": ["Angular Drive"],
    }
}


def write_small(folder: Path) -> Path:
    """`small.glb` and the template folder `type`, in a folder that is returned."""
    frame = trimesh.creation.box((2.0, 0.6, 0.4))
    arm = trimesh.creation.box((1.5, 0.2, 0.2))
    arm.apply_translation((1.4, 0.0, 0.3))
    pin = trimesh.creation.cylinder(0.05, 0.8, sections=24)
    pin.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    pin.apply_translation((0.7, 0.0, 0.3))
    scene = trimesh.Scene()
    for name, mesh in (("FRAME", frame), ("ARM", arm), ("PIN", pin)):
        scene.add_geometry(mesh, node_name=name, geom_name=name)
    folder.mkdir(parents=True, exist_ok=True)
    scene.export(folder / "small.glb")
    write_type(folder / "type")
    return folder


def write_type(folder: Path, *, hierarchy: object = None, joints: object = None) -> Path:
    """The small machine's template, or another with its documents, as JSON or as texts."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, given, usual in (("hierarchy", hierarchy, HIERARCHY), ("joints", joints, JOINTS)):
        content = usual if given is None else given
        text = content if isinstance(content, str) else json.dumps(content)
        (folder / f"{name}.json").write_text(text, encoding="utf-8")
    return folder
