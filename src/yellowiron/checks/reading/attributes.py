"""Attributes by what they should hold: a value of another type counts as not written (OpenUSD's validators say so)."""

from __future__ import annotations

from pxr import Gf, Usd

_VECTORS = (Gf.Vec3f, Gf.Vec3d, Gf.Vec3h)
_QUATERNIONS = (Gf.Quatf, Gf.Quatd, Gf.Quath)


def _authored(prim: Usd.Prim, name: str) -> object:
    attribute = prim.GetAttribute(name)
    return attribute.Get() if attribute and attribute.HasAuthoredValue() else None


def number(prim: Usd.Prim, name: str) -> float | None:
    """An authored number, or None."""
    value = _authored(prim, name)
    return float(value) if isinstance(value, int | float) else None


def vector(prim: Usd.Prim, name: str) -> Gf.Vec3d | None:
    """An authored vector, or None."""
    value = _authored(prim, name)
    return Gf.Vec3d(value) if isinstance(value, _VECTORS) else None


def quaternion(prim: Usd.Prim, name: str) -> Gf.Quatd | None:
    """An authored quaternion, or None."""
    value = _authored(prim, name)
    return Gf.Quatd(value) if isinstance(value, _QUATERNIONS) else None


def axis_token(prim: Usd.Prim, name: str, default: str) -> str:
    """X, Y or Z, authored or else the default."""
    value = _authored(prim, name)
    return value if isinstance(value, str) and value in ("X", "Y", "Z") else default


def token(prim: Usd.Prim, name: str) -> str:
    """An authored token, or ""."""
    value = _authored(prim, name)
    return value if isinstance(value, str) else ""
