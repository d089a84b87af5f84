"""Two builds of a machine beside each other: what differs, one line each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from yellowiron.report.words import shown

SAME = 1e-6
"""Numbers that differ by a smaller share are the same."""
MOVED = 1e-5
"""Metres, or of a unit vector, by which a joint's axis has moved when it is said."""
_LIMITS = {"revolute": "rad", "prismatic": "m"}
_CYLINDER = {"bore": "m", "rod_diameter": "m", "stroke": "m", "closed_length": "m", "push_force": "N", "speed": "m/s"}


@dataclass(frozen=True)
class Difference:
    """One thing that is not the same in two builds: its kind, its name, and what each says ('': it is not there)."""

    kind: str
    name: str
    before: str
    after: str


def differences(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[Difference]:
    """What differs between two documents of `report.json`: verdict, variants, values, measurements, cylinders, joints,
    masses, parts' bodies, findings, in this order."""
    return [
        *_texts("verdict", {"": before["verdict"]}, {"": after["verdict"]}),
        *_texts("variant", before["alignment"]["choices"], after["alignment"]["choices"]),
        *_texts("value", *(_values(d) for d in (before, after))),
        *_texts("measurement", *(_measured(d) for d in (before, after))),
        *_texts("cylinder", *(_cylinders(d) for d in (before, after))),
        *_joints(_named(before["joints"]), _named(after["joints"])),
        *_masses(_named(before["bodies"]), _named(after["bodies"])),
        *_texts("part", *(_parts(d) for d in (before, after))),
        *_texts("finding", *(_findings(d) for d in (before, after))),
    ]


def _texts(kind: str, before: Mapping[str, str], after: Mapping[str, str]) -> Iterator[Difference]:
    for name in (*before, *(n for n in after if n not in before)):
        if before.get(name, "") != after.get(name, ""):
            yield Difference(kind, name, before.get(name, ""), after.get(name, ""))


def _named(entries: Sequence[Mapping[str, Any]]) -> dict[str, Mapping[str, Any]]:
    return {entry["name"]: entry for entry in entries}


def _values(document: Mapping[str, Any]) -> dict[str, str]:
    return {
        s["name"]: f"{shown(s['value'], s['unit'])} ({'given' if s['source'] == 'set' else s['status']})"
        for s in document["specifications"]
        if s["value"] is not None
    }


def _measured(document: Mapping[str, Any]) -> dict[str, str]:
    return {m["name"]: shown(m["model"], m["unit"]) for m in document["measurements"] if m["model"] is not None}


def _cylinders(document: Mapping[str, Any]) -> dict[str, str]:
    return {
        # Nobody reads a rod's speed in km/h.
        f"{cylinder['name']} {key.replace('_', ' ')}": (
            f"{cylinder[key]:.4g} m/s" if unit == "m/s" else shown(cylinder[key], unit)
        )
        for cylinder in document["cylinders"]
        for key, unit in _CYLINDER.items()
        if cylinder[key] is not None
    }


def _joints(before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[Difference]:
    for name in (*before, *(n for n in after if n not in before)):
        one, other = before.get(name), after.get(name)
        if one is None or other is None:
            yield Difference("joint", name, one["type"] if one else "", other["type"] if other else "")
            continue
        ends = [f"{e['type']} {e['body0']} to {e['body1']}" for e in (one, other)]
        if ends[0] != ends[1]:
            yield Difference("joint", name, *ends)
        elif _off(one, other) > MOVED or _turn(one, other) > MOVED:
            words = f"moved {1e3 * _off(one, other):.3g} mm, turned {math.degrees(_turn(one, other)):.3g}°"
            yield Difference("joint", name, "", words)
        limits = [f"{shown(e['lower'], u)} to {shown(e['upper'], u)}" if e["lower"] is not None else "free"
                  for e in (one, other) for u in [_LIMITS.get(e["type"], "")]]  # fmt: skip
        if limits[0] != limits[1]:
            yield Difference("joint", f"{name} limits", *limits)


def _off(one: Mapping[str, Any], other: Mapping[str, Any]) -> float:
    """Metres from one joint's axis to the other's anchor, across the axis; along it a hinge is the same."""
    gap = [b - a for a, b in zip(one["anchor"], other["anchor"], strict=True)]
    along = sum(g * x for g, x in zip(gap, one["axis"], strict=True))
    return math.dist(gap, [along * x for x in one["axis"]])


def _turn(one: Mapping[str, Any], other: Mapping[str, Any]) -> float:
    """Radians between two axes."""
    return math.acos(min(abs(sum(a * b for a, b in zip(one["axis"], other["axis"], strict=True))), 1.0))


def _masses(before: Mapping[str, Any], after: Mapping[str, Any]) -> Iterator[Difference]:
    for name in (*before, *(n for n in after if n not in before)):
        one, other = (entry[name]["mass"] if name in entry else math.nan for entry in (before, after))
        if not math.isclose(one, other, rel_tol=SAME):
            yield Difference("mass", name, *("" if math.isnan(m) else shown(m, "kg") for m in (one, other)))


def _parts(document: Mapping[str, Any]) -> dict[str, str]:
    return {part: body["name"] for body in document["bodies"] for part in body["parts"]}


def _findings(document: Mapping[str, Any]) -> dict[str, str]:
    return {f"{f['code']} {f['where']}": f["message"] for f in document["findings"]}
