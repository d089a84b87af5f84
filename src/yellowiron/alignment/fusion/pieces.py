"""Pieces: what is labelled as one. A piece is a solid, or solids that are certainly one: the halves of a hydraulic
cylinder, a wheel, a ring in its bore."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.fusion.stance import surface_points
from yellowiron.alignment.structure.observation import Observation
from yellowiron.model.geometry import Floats

MOST = 90
"""So many pieces are labelled by the score, the largest and the named first; the rest follows by contact."""
BAR = 16.0
"""A long bar counts as so much larger: of a hydraulic cylinder, what is seen of the rod is small."""
SLENDER = 2.5
"""A bar is this many times longer than wide."""
SAMPLES = 40
"""Points that a piece's surface is looked at by."""
ROUND = 1.45
"""The sides of a round thing's cross section differ by less than this factor: a barrel with its ports and clamps."""


LARGE, LONG = 0.004, 0.05
"""From these shares of the machine's surface, of a bar's length in its size, a piece can be what a body mainly is."""


@dataclass(frozen=True, eq=False)
class Piece:
    """Solids that are certainly one body. `kind`: `barrel`, `rod`, `wheel` where its shape told so, else ""; `number`
    of that cylinder or wheel; `area` m²; box `low`, `high`; `spread` (3,) its extents along its principal `axes` (rows,
    the longest first), metres; `samples` (n, 3) points all over its surface; `flat`: how much farther its surface is
    from its line to one side than to the other, root mean square."""

    members: frozenset[int]
    kind: str
    number: int
    area: float
    low: Floats
    high: Floats
    center: Floats
    spread: Floats
    axes: Floats
    samples: Floats
    flat: float = np.inf

    @property
    def slender(self) -> bool:
        """True for a bar: much longer than wide, and about as thick as wide, if not everywhere (an eye at its end)."""
        long, wide, thick = self.spread
        return bool(long > SLENDER * wide and min(wide / max(thick, 1e-9), self.flat) < ROUND)

    @property
    def is_bar(self) -> bool:
        """True for a bar, and for what was seen to be half of a hydraulic cylinder."""
        return self.kind in ("barrel", "rod") or self.slender

    @property
    def size(self) -> float:
        """Diagonal of its box, metres."""
        return float(np.linalg.norm(self.high - self.low))


def pieces_of(observation: Observation, named: frozenset[int]) -> tuple[Piece, ...]:
    """The machine's pieces, largest first, `MOST` at most; the solids of `named` before others of their size, and long
    bars, which may be rods."""
    solids = observation.solids
    owner: dict[int, tuple[str, int]] = {}
    for k, cylinder in enumerate(observation.cylinders):
        if not (cylinder.apart or cylinder.fixed):
            owner |= dict.fromkeys(cylinder.barrel, ("barrel", k)) | dict.fromkeys(cylinder.rod, ("rod", k))
    for k, wheel in enumerate(observation.wheels):
        owner |= dict.fromkeys(wheel.members, ("drum" if wheel.drum else "wheel", k))
    groups: dict[tuple[str, int], list[int]] = {}
    for solid in solids:
        groups.setdefault(owner.get(solid.index, ("", solid.index)), []).append(solid.index)
    pieces = [_piece(solids, members, *label) for label, members in sorted(groups.items())]

    def weight(piece: Piece) -> float:
        bar = BAR if piece.slender and piece.spread[0] > LONG * observation.size else 1.0
        return piece.area * bar * (4.0 if piece.members & named or piece.kind else 1.0)

    return tuple(sorted(pieces, key=lambda p: (-round(weight(p), 9), min(p.members)))[:MOST])


def _piece(solids: tuple[Solid, ...], members: list[int], kind: str, number: int) -> Piece:
    own = [solids[i] for i in members]
    low, high = np.min([s.low for s in own], axis=0), np.max([s.high for s in own], axis=0)
    points = np.concatenate([s.points for s in own])
    center = 0.5 * (low + high)
    axes, flat = _principal(own)
    along = points @ axes.T
    spread = np.ptp(along, axis=0)
    order = np.argsort(-spread, kind="stable")
    center = axes.T @ (0.5 * (along.min(axis=0) + along.max(axis=0)))
    return Piece(
        frozenset(members), kind, number if kind else -1, sum(s.surface for s in own), low, high,
        np.asarray(center), spread[order], axes[order], surface_points(own, SAMPLES), flat,
    )  # fmt: skip


def _principal(own: list[Solid]) -> tuple[Floats, float]:
    """(3, 3) principal axes of the surfaces, as rows: triangles count by their area, however fine; and the ratio of the
    two lesser root mean squares about them."""
    corners = np.concatenate([s.points[s.shape.mesh.triangles] for s in own])
    double = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    if not double.sum() > 0:
        return np.eye(3), np.inf
    centres = corners.mean(axis=1)
    delta = centres - double @ centres / double.sum()
    corner = corners - (double @ centres / double.sum())
    moments = np.einsum("i,ij,ik->jk", double, delta, delta) * 9 + np.einsum("i,inj,ink->jk", double, corner, corner)
    values, vectors = np.linalg.eigh(moments)
    flat = float(np.sqrt(max(values[1], 0.0) / max(values[0], 1e-300)))
    return np.asarray(vectors.T[::-1], dtype=np.float64), flat


def largeness(pieces: Sequence[Piece]) -> Floats:
    """(pieces,) the root of what each piece's surface is of the largest one's, 0 to 1."""
    areas = np.array([p.area for p in pieces], dtype=np.float64)
    return np.asarray(np.sqrt(areas / max(float(areas.max(initial=0.0)), 1e-300)))


def leading(pieces: tuple[Piece, ...], size: float, said: Mapping[int, str]) -> list[int]:
    """The pieces that can be what a body mainly is; the others only go with it. `said`: piece → the body that its names
    speak of; of one that no large piece is named for, small ones are all there is."""
    total = sum(p.area for p in pieces)
    found = [
        k for k, p in enumerate(pieces)
        if p.kind or p.area > LARGE * total or (p.slender and p.spread[0] > LONG * size)
    ]  # fmt: skip
    named = {said[k] for k in found if k in said}
    return sorted({*found, *(k for k, body in said.items() if body not in named)})
