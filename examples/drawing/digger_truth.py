"""What the truth about a digger says of its planar linkage: its joints, where its bodies go, its forces."""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np
from OCP.gp import gp_Trsf

from .digger import Linkage, Pose
from .hardware import placed
from .planar import Point, direction, rot, vec
from .truth import Joints, Triple


def moves(k: Linkage, start: Pose, end: Pose, sides: Collection[str] = ("",)) -> dict[str, gp_Trsf]:
    """Where each moving body goes from one pose to another, machine frame; `sides`: what the names of the boom
    cylinders' halves end in."""

    def frames(p: Pose) -> dict[str, gp_Trsf]:
        def at(pin: Point, angle: float) -> gp_Trsf:
            return placed((pin[0], 0.0, pin[1]), angle)

        lift, crowd, curl = direction(p.D - k.C), direction(p.P - p.M), direction(p.H - p.E)
        out = {
            "boom": at(k.A, p.boom_angle),
            "arm": at(p.B, p.arm_angle),
            "bucket": at(p.K, p.bucket_angle),
            "tipping_link": at(p.G, direction(p.H - p.G)),
            "bucket_link": at(p.H, direction(p.J - p.H)),
            "arm_cylinder_barrel": at(p.M, crowd),
            "arm_piston_rod": at(p.P, crowd),
            "bucket_cylinder_barrel": at(p.E, curl),
            "bucket_piston_rod": at(p.H, curl),
        }
        for side in sides:
            out[f"boom_cylinder_barrel{side}"] = at(k.C, lift)
            out[f"boom_piston_rod{side}"] = at(p.D, lift)
        return out

    before, after = frames(start), frames(end)
    return {body: after[body].Multiplied(before[body].Inverted()) for body in before}


def dig(found: Joints, k: Linkage, pose: Pose, base: str, apart: float) -> None:
    """The joints of a digger on its `base`, with boom cylinders at `apart` from the middle."""

    def at(p: Point, y: float = 0.0) -> Triple:
        return float(p[0]), y, float(p[1])

    def pivot(a: str, b: str, p: Point) -> None:
        found.pivot(a, b, at(p))

    pivot(base, "boom", k.A)
    for side, y in (("_l", apart), ("_r", -apart)):
        found.cylinder("boom", side, (base, "boom"), at(k.C, y), at(pose.D, y), (0.0, 1.0, 0.0))
    pivot("boom", "arm", pose.B)
    found.cylinder("arm", "", ("boom", "arm"), at(pose.M), at(pose.P), (0.0, 1.0, 0.0))
    pivot("arm", "bucket", pose.K)
    pivot("arm", "bucket_cylinder_barrel", pose.E)
    along = pose.H - pose.E
    found.slide("bucket_cylinder_barrel", "bucket_piston_rod", at(pose.E), at(along))
    pivot("arm", "tipping_link", pose.G)
    pivot("bucket_piston_rod", "tipping_link", pose.H)
    pivot("bucket_piston_rod", "bucket_link", pose.H)
    pivot("bucket_link", "bucket", pose.J)


def _curl(k: Linkage) -> tuple[float, float]:
    """The length of the bucket cylinder at which it turns the bucket the least, and radians a millimetre there."""
    low, high = k.strokes.bucket
    lengths = np.arange(low + 0.5, high - 0.5, 1.0)
    turns = [(k.four_bar(c - 0.5)[0] - k.four_bar(c + 0.5)[0]) % (2 * math.pi) for c in map(float, lengths)]
    return float(lengths[int(np.argmin(turns))]), min(turns)


def _push(pressure: float, bore: float) -> float:
    return pressure * math.pi / 4 * bore**2 / 1000.0


def bucket_force(k: Linkage, pressure: float, bore: float) -> float:
    """Largest force at the tooth points from the bucket cylinder alone at a pressure (MPa), kN: by virtual work, over
    the stroke (ISO 6015 without its limits of stability)."""
    return _push(pressure, bore) / (_curl(k)[1] * k.tip)


def arm_force(k: Linkage, pressure: float, bore: float) -> float:
    """Largest force at the tooth points from the arm cylinder alone at a pressure (MPa), kN; the bucket curled to where
    its own force is largest."""
    best = k.four_bar(_curl(k)[0])[0]
    radius = float(np.hypot(*(vec(k.arm, 0.0) + rot(best, vec(k.tip, 0.0)))))
    return _push(pressure, bore) * float(np.hypot(*k.P)) / radius
