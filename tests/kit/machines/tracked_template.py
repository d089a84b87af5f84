"""A small crawler's template with all that tracks need: rows, a ring, hidden wheels, and the choice among them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

SIDES = ("l", "r")


def tracked_documents() -> dict[str, Any]:
    """Documents by name: an undercarriage with two tracks, and a body that swings on it."""
    shoes = {"rigid body": "Y", "rigid_when": {"tracks": "shoes"}}
    inside: dict[str, Any] = {}
    joints: dict[str, Any] = {
        "undercarriage2upper_joint": {
            "joint_type": "Revolute", "Body": ["upper", "swing_bearing"], "Drive": ["Angular Drive"],
        },
    }  # fmt: skip
    actuators: dict[str, Any] = {"swing": {"kind": "motor", "joints": ["undercarriage2upper_joint"]}}
    for s, name in zip(SIDES, ("left", "right"), strict=True):
        row = f"track_shoe_{s}"
        inside |= {
            f"sprocket_{s}": {**shoes, "kind": "sprocket"},
            f"idler_{s}": {**shoes, "kind": "idler"},
            f"track_roller_{s}[*]": {**shoes, "kind": "roller"},
            f"carrier_roller_{s}[*]": {**shoes, "kind": "carrier"},
            f"{row}[*]": {**shoes, "kind": "shoe"},
            f"track_wheel_{s}[*]": {
                "rigid body": "Y", "when": {"tracks": "belt"}, "hidden": {"row": row, "at": [0.3, 0, -0.3]},
            },
        }  # fmt: skip
        on_ground = {"joint_type": "Revolute", "when": {"tracks": "shoes"}}
        for wheel in ("idler", "track_roller", "carrier_roller"):
            index = "[i]" if "roller" in wheel else ""
            body = [f"{wheel}_{s}{index}", "undercarriage"]
            joints[f"undercarriage2{wheel}_{s}_joint{index}"] = {**on_ground, "Body": body, "free": "Y"}
        driven = {"Body": [f"sprocket_{s}", "undercarriage"], "Drive": ["Angular Drive"]}
        joints[f"undercarriage2sprocket_{s}_joint"] = {**on_ground, **driven}
        joints[f"{row}2{row}_joint[i]"] = {**on_ground, "Body": [f"{row}[i]", f"{row}[i+1]"], "ring": "Y"}
        joints[f"undercarriage2track_wheel_{s}_joint[i]"] = {
            "joint_type": "Revolute", "Body": [f"track_wheel_{s}[i]", "undercarriage"], "Drive": ["Angular Drive"],
            "when": {"tracks": "belt"},
        }  # fmt: skip
        actuators[f"travel_{name}"] = {
            "kind": "motor",
            "joints": [f"undercarriage2sprocket_{s}_joint", f"undercarriage2track_wheel_{s}_joint[i]"],
            "specifications": {"torque": "Drawbar Pull", "speed": "Maximum Travel Speed"},
            "defaults": {"torque": "20 kN*m", "speed": "1.2 m/s"},
        }
    return {
        "hierarchy": {
            "crawler": {
                "rigid body": "N",
                "child": {
                    "undercarriage": {
                        "rigid body": "Y", "kind": "frame",
                        "child": {"swing_bearing": {"rigid body": "N", "kind": "pin"}, **inside},
                    },
                    "upper": {"rigid body": "Y", "kind": "frame"},
                },
            }
        },
        "joints": joints,
        "actuators": actuators,
        "variants": {"tracks": {"choices": ["belt", "shoes", "fixed"], "default": "belt", "decided_by": "user"}},
        "wanted": {
            "Drawbar Pull": {"dimension": "force"},
            "Maximum Travel Speed": {"dimension": "speed"},
        },
        "collision": {"*": "convexHull", "*roller*": "analytic", "idler*": "analytic"},
        "materials": {
            "*": {"name": "steel", "density": 7850, "static friction": 0.7, "dynamic friction": 0.6},
            "track_shoe_*": {"name": "shoe steel", "density": 7850, "static friction": 0.9, "dynamic friction": 0.8},
        },
    }  # fmt: skip


def write_tracked_template(folder: Path) -> Path:
    """Writes the documents into a folder, which they are then a template of."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, document in tracked_documents().items():
        (folder / f"{name}.json").write_text(json.dumps(document, indent=1), encoding="utf-8")
    return folder
