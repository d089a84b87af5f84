"""What every example's truth says in the same way: points and axes in its CAD frame, values beside what they became."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt, gp_Trsf

from .cylinders import Cylinder
from .product import Assembly, occurrences
from .values import Value

Triple = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class CadFrame:
    """The frame that a drawing office has drawn a machine in: its `origin` (millimetres), and its `x` and `z` axes, all
    in the machine's frame (x forward, y left, z up)."""

    origin: Triple
    x: Triple
    z: Triple

    @property
    def rotation(self) -> NDArray[np.float64]:
        """(3, 3) from the CAD frame to the machine's."""
        return np.array([self.x, np.cross(self.z, self.x), self.z], dtype=np.float64).T + 0.0

    def to_cad(self) -> gp_Trsf:
        """Machine frame to CAD frame, millimetres."""
        t = gp_Trsf()
        t.SetTransformation(gp_Ax3(), gp_Ax3(gp_Pnt(*self.origin), gp_Dir(*self.z), gp_Dir(*self.x)))
        return t

    def matrix(self) -> list[list[float]]:
        """4x4, CAD metres to machine metres."""
        m = np.eye(4)
        m[:3, :3] = self.rotation
        m[:3, 3] = np.array(self.origin) / 1000.0
        return [[float(c) + 0.0 for c in row] for row in m]

    def point(self, p: Triple) -> list[float]:
        """A point of the machine's frame, millimetres, in the CAD frame, metres."""
        return [round(float(c), 9) + 0.0 for c in self.rotation.T @ (np.array(p, dtype=float) - self.origin) / 1000.0]

    def axis(self, a: Triple) -> list[float]:
        """A direction of the machine's frame as a unit vector of the CAD frame."""
        n = np.array(a, dtype=float)
        return [round(float(c), 9) + 0.0 for c in self.rotation.T @ (n / np.linalg.norm(n))]


Y: Triple = (0.0, 1.0, 0.0)


@dataclass(slots=True)
class Joints:
    """The joints of a machine by name, as a truth has them. Points and axes are given in the machine's frame
    (millimetres); pitch axes point to the left, upright ones up, slides outwards."""

    frame: CadFrame
    found: dict[str, dict[str, Any]] = field(default_factory=dict)

    def pivot(self, a: str, b: str, at: Triple, axis: Triple = Y, name: str = "") -> None:
        """`b` turns on `a`."""
        self._add("revolute", a, b, at, axis, name)

    def cylinder(self, name: str, side: str, ends: tuple[str, str], start: Triple, end: Triple, axis: Triple) -> None:
        """A cylinder with its two pivots along `axis`: the barrel's on the first of `ends`, the rod's on the second."""
        barrel, piston = f"{name}_cylinder_barrel{side}", f"{name}_piston_rod{side}"
        self.pivot(ends[0], barrel, start, axis)
        self.pivot(ends[1], piston, end, axis)
        along = np.array(end) - np.array(start)
        self._add("prismatic", barrel, piston, start, (float(along[0]), float(along[1]), float(along[2])))

    def ball(self, a: str, b: str, at: Triple) -> None:
        """`b` is on `a` by a ball."""
        self._add("spherical", a, b, at, (0.0, 0.0, 1.0))

    def ball_cylinder(self, name: str, side: str, ends: tuple[str, str], start: Triple, end: Triple) -> None:
        """A cylinder between two balls."""
        barrel, piston = f"{name}_cylinder_barrel{side}", f"{name}_piston_rod{side}"
        self.ball(ends[0], barrel, start)
        self.ball(ends[1], piston, end)
        along = np.array(end) - np.array(start)
        self._add("prismatic", barrel, piston, start, (float(along[0]), float(along[1]), float(along[2])))

    def slide(self, a: str, b: str, at: Triple, axis: Triple) -> None:
        """`b` slides on `a`, outwards along the axis."""
        self._add("prismatic", a, b, at, axis)

    def _add(self, kind: str, a: str, b: str, at: Triple, axis: Triple, name: str = "") -> None:
        entry = {"type": kind, "body0": a, "body1": b, "anchor": self.frame.point(at), "axis": self.frame.axis(axis)}
        self.found[name or f"{a}2{b}_joint"] = entry


def twin_slides(cylinders: Mapping[str, Cylinder]) -> dict[str, dict[str, float]]:
    """What the truth says of the slides of cylinders that are there on the left and on the right, by joint."""
    return {
        f"{name}_cylinder_barrel_{letter}2{name}_piston_rod_{letter}_joint": cylinder.slide()
        for name, cylinder in cylinders.items()
        for letter in "lr"
    }


def document(
    frame: CadFrame,
    root: Assembly,
    joints: Mapping[str, Any],
    cylinders: Mapping[str, Any],
    values: Mapping[str, Any],
    **more: Any,
) -> dict[str, Any]:
    """The document written as `truth.json`."""
    return {
        "about": "CAD frame, metres. A part's key is its product names from the root joined by '/', in tree "
        "order; the second of two equal keys ends in '#2', the third in '#3'.",
        "frame": frame.matrix(),
        **more,
        "joints": joints,
        "parts": {leaf.path: {"body": leaf.body, "role": leaf.role} for leaf in occurrences(root)},
        "cylinders": cylinders,
        "values": values,
    }


def value_rows(
    values: Iterable[Value], linkage: Mapping[str, float], drawn: Mapping[str, float]
) -> dict[str, dict[str, Any]]:
    """By name: what a value is to be, and what linkage and drawn shapes make of it, as far as they show it."""
    return {
        value.name: {
            "target": value.value,
            "unit": value.unit,
            "published": value.published,
            **({"linkage": round(linkage[value.name], 5)} if value.name in linkage else {}),
            **({"drawn": round(drawn[value.name], 3)} if value.name in drawn else {}),
        }
        for value in values
        if value.name in linkage or value.name in drawn
    }
