"""The page's joints: marks on the picture and rows of the table, a counted row of equal joints as one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from yellowiron.model.template import Follows
from yellowiron.report.html.marks import Mark
from yellowiron.report.rows import in_rows
from yellowiron.report.words import counted, shown


def joint_rows(document: Mapping[str, Any]) -> list[dict[str, Any]]:
    """One entry a joint, or a row of joints, numbered from 1 as the marks are."""
    joints = document["joints"]
    levers = {j["joint"]: a["name"] for a in document["actuators"] for j in a["joints"]}
    groups = in_rows([joint["name"] for joint in joints])
    return [
        _row(number, name, [joints[place] for place in places], levers)
        for number, (name, places) in enumerate(groups.items(), start=1)
    ]


def joint_marks(rows: Sequence[Mapping[str, Any]]) -> list[Mark]:
    """A mark for each entry; hollow where it is cut."""
    return [
        Mark(
            str(row["number"]),
            f"{row['number']} {row['name']} ({row['type']}{', cut' if row['cut'] else ''})",
            np.array(row["anchors"], dtype=np.float64),
            "hollow" if row["cut"] else "",
        )
        for row in rows
    ]


def _row(number: int, name: str, joints: Sequence[Mapping[str, Any]], levers: Mapping[str, str]) -> dict[str, Any]:
    first = joints[0]
    many = len(joints) > 1
    drive = first["drive"]
    force_unit = "N" if first["type"] == "prismatic" else "N*m"
    spans = list(dict.fromkeys(_span(joint) for joint in joints))
    between = f"{first['body0']} → {first['body1']}"
    return {
        "number": number,
        "name": f"{name}_1 … _{len(joints)}" if many else name,
        "type": first["type"],
        "between": f"{counted(len(joints), 'joint')}: {between} and on" if many else between,
        "cut": first["cut"],
        "free": first["free"] and not many,
        "anchors": [joint["anchor"] for joint in joints],
        "range": spans[0] if len(spans) == 1 else "each its own",
        "drive": _drive(drive, force_unit) if drive else _led(joints),
        "source": joint_evidence(first["source"], levers),
        "lever": levers.get(first["name"], name),
        "values": _limiting(first["source"]),
    }


def _limiting(source: Mapping[str, Any]) -> list[str]:
    """The sheet's values that limit a joint, without their signs."""
    named = [str(source.get(f"{end}_specification") or "").lstrip("-− ") for end in ("lower", "upper")]
    return [name for name in dict.fromkeys(named) if name]


def _drive(drive: Mapping[str, Any], unit: str) -> str:
    """`position, 1110 kN out, 710 kN in`: a cylinder pushes and pulls with forces of its own."""
    out, back = drive["max_force"], drive.get("reverse_force")
    if back is None or back == out:
        return f"{drive['kind']}, {shown(out, unit, digits=4)}"
    return f"{drive['kind']}, {shown(out, unit, digits=4)} out, {shown(back, unit, digits=4)} in"


def _led(joints: Sequence[Mapping[str, Any]]) -> str:
    """What joints follow, or the springs on them, in the place of a drive."""
    said = [Follows(**joint["follows"]).words if "follows" in joint else _sprung(joint) for joint in joints]
    return said[0] if len(set(said)) == 1 else "each its own"


def _sprung(joint: Mapping[str, Any]) -> str:
    """A joint's spring, where it has one, and whether it holds the machine as drawn."""
    if "spring" not in joint:
        return ""
    slides = joint["type"] == "prismatic"
    stiffness, unit = joint["spring"]["stiffness"], "m" if slides else "rad"
    rest = "as drawn" if joint["spring"]["as_drawn"] else f"rests at {shown(joint['spring']['rest'], unit)}"
    return f"spring, {stiffness / 1e3:.4g} {'kN/m' if slides else 'kN·m/rad'}, {rest}"


def _span(joint: Mapping[str, Any]) -> str:
    unit = "m" if joint["type"] == "prismatic" else "rad"
    lower, upper = joint["lower"], joint["upper"]
    if joint["type"] == "fixed":
        return "–"
    if lower is None and upper is None:
        return "unlimited"
    return f"{shown(lower, unit)} … {shown(upper, unit)}"


def joint_evidence(source: Mapping[str, Any], levers: Mapping[str, str]) -> str:
    """The evidence of a joint as sentences: where its axis, its cut and its limits come from."""
    words = []
    if source.get("method"):
        # The tree path says where a part is filed; its own name is enough to know it by.
        names = dict.fromkeys(str(part).rsplit("/", 1)[-1].partition("#")[0] for part in source.get("parts", ()))
        words.append(f"{source['method']}: {_listed(list(names))}" if names else str(source["method"]))
    if "residual_mm" in source:
        words.append(f"residual {source['residual_mm']:.4f} mm, {source.get('residual_deg', 0.0):.4f}°")
    for end in ("lower", "upper"):
        if source.get(f"{end}_quote"):
            words.append(f"{end} limit from page {source[f'{end}_page']} “{source[f'{end}_quote']}”")
        elif source.get(f"{end}_specification"):
            words.append(f"{end} limit {source[f'{end}_specification']} from {source.get(f'{end}_source', 'nowhere')}")
    words += [f"{key}: {source[key]}" for key in ("cut", "limits") if source.get(key)]
    text = "; ".join(words).replace("1 cylinder(s)", "1 cylinder").replace("cylinder(s)", "cylinders")
    for joint, lever in levers.items():
        text = text.replace(joint, lever)
    return text


def _listed(names: Sequence[str], *, most: int = 4) -> str:
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")
