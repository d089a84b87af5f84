"""How far a body's geometry reaches along a line."""

from __future__ import annotations

import numpy as np
from pxr import Usd, UsdGeom, UsdPhysics

from yellowiron.checks.reading.bodies import Poses
from yellowiron.model.geometry import Floats


def span(body: Usd.Prim, axis: Floats, poses: Poses) -> tuple[float, float] | None:
    """The least and greatest place (metres, from the world's origin) of a body's geometry along a unit vector (3,), in
    the drawn pose: corners of meshes, of other shapes those of their boxes. None for a body without geometry."""
    reach = [
        part
        for prim in Usd.PrimRange(body, Usd.TraverseInstanceProxies())
        if prim.IsA(UsdGeom.Gprim) and len(points := _points(prim)) and _own(prim, body)
        for part in [points @ _turned(prim, axis, poses) + _moved(prim, axis, poses)]
    ]
    if not reach:
        return None
    low, high = min(float(r.min()) for r in reach), max(float(r.max()) for r in reach)
    return (low, high) if np.isfinite([low, high]).all() else None


def _own(prim: Usd.Prim, body: Usd.Prim) -> bool:
    """Whether a shape belongs to the body and not to one nested in it."""
    while prim != body:
        if prim.HasAPI(UsdPhysics.RigidBodyAPI):
            return False
        prim = prim.GetParent()
    return True


def _points(prim: Usd.Prim) -> Floats:
    """(n, 3) in the prim's own frame."""
    points = prim.GetAttribute("points").Get() if prim.IsA(UsdGeom.PointBased) else prim.GetAttribute("extent").Get()
    try:
        corners = np.asarray(points if points is not None else [], dtype=np.float64).reshape(-1, 3)
    except (TypeError, ValueError):  # a value of a wrong type: CHK004, or OpenUSD's validators
        return np.zeros((0, 3))
    if prim.IsA(UsdGeom.PointBased) or len(corners) != 2:
        return corners
    return np.array([(x, y, z) for x in corners[:, 0] for y in corners[:, 1] for z in corners[:, 2]])


def _turned(prim: Usd.Prim, axis: Floats, poses: Poses) -> Floats:
    return np.asarray(np.array(poses.matrix(prim), dtype=np.float64)[:3, :3] @ axis * poses.meters, dtype=np.float64)


def _moved(prim: Usd.Prim, axis: Floats, poses: Poses) -> float:
    return float(np.array(poses.matrix(prim).ExtractTranslation()) @ axis * poses.meters)
