"""Meshes with what their materials say: one colour and finish for all, or one for every triangle."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.geometry import Color, Finish, Floats, Mesh

GREY: Color = (0.5, 0.5, 0.5)
"""Triangles without a colour beside others that have one."""


@dataclass(frozen=True)
class Look:
    """What a material says: colour (linear RGB; a texture's mean) and finish, where it says any."""

    color: Color | None = None
    finish: Finish | None = None


@dataclass(frozen=True, eq=False)
class Dressed:
    """A mesh with its one colour (None where triangles have their own, or none is stated) and its finishes."""

    mesh: Mesh
    color: Color | None = None
    finishes: tuple[Finish, ...] = ()


def dress(
    mesh: Mesh,
    looks: Sequence[Look],
    rows: NDArray[np.int64] | None = None,
    *,
    uvs: Floats | None = None,
    paint: Floats | None = None,
) -> Dressed:
    """A bare mesh with looks: `rows` (m,) the number of each triangle's look (all have the first one without it; a
    number that is none of theirs is no look), `uvs` (m, 3, 2) as in `Mesh`, `paint` (m, 3) colours that multiply."""
    count = len(mesh.triangles)
    numbers = np.zeros(count, dtype=np.int64) if rows is None else np.asarray(rows, dtype=np.int64)
    every = [*looks, Look()]
    numbers = np.where((numbers >= 0) & (numbers < len(looks)), numbers, len(looks))
    used = [int(n) for n in np.unique(numbers)]
    if uvs is None or not np.isfinite(uvs).all():
        uvs, every = None, [_without_texture(look) for look in every]
    colors = {n: every[n].color for n in used}
    finishes = {n: every[n].finish or Finish() for n in used}
    one = next(iter(colors.values())) if len(set(colors.values())) == 1 else None
    painted: Floats | None = None
    if paint is not None or len(set(colors.values())) > 1:
        palette = np.array([look.color or (GREY if paint is None else (1.0, 1.0, 1.0)) for look in every])
        painted = palette[numbers] if paint is None else np.clip(palette[numbers] * paint, 0.0, 1.0)
        if len(np.unique(np.round(painted, 6), axis=0)) == 1:
            r, g, b = (float(v) for v in painted[0])
            one, painted = (r, g, b), None
    kinds = list(dict.fromkeys(finishes.values()))
    kept = () if kinds in ([], [Finish()]) else tuple(kinds)
    several = None
    if len(kept) > 1:
        index = np.zeros(len(every), dtype=np.int32)
        for n in used:
            index[n] = kinds.index(finishes[n])
        several = index[numbers]
    textured = any(finish.texture is not None for finish in kept)
    dressed = replace(mesh, triangle_colors=painted, uvs=uvs if textured else None, triangle_finishes=several)
    return Dressed(dressed, None if painted is not None else one, kept)


def repainted(mesh: Mesh) -> Dressed:
    """A mesh whose triangles have colours, with one colour where they all have the same."""
    if mesh.triangle_colors is None:
        return Dressed(mesh)
    return dress(replace(mesh, triangle_colors=None), [], paint=mesh.triangle_colors)


def _without_texture(look: Look) -> Look:
    if look.finish is None or look.finish.texture is None:
        return look
    bare = replace(look.finish, texture=None)
    return Look(look.color, None if bare == Finish() else bare)


def joined(pieces: Sequence[tuple[Mesh, Look, Floats | None, Floats | None]]) -> Dressed:
    """Several meshes as one: each bare, with its look, texture coordinates and paint (as in `dress`)."""
    starts = np.cumsum([0, *(len(mesh.points) for mesh, *_ in pieces)])
    mesh = Mesh(
        np.concatenate([m.points for m, *_ in pieces]),
        np.concatenate([m.triangles + start for (m, *_), start in zip(pieces, starts, strict=False)]).astype(np.int32),
    )
    counts = [len(m.triangles) for m, *_ in pieces]
    rows = np.repeat(np.arange(len(pieces)), counts)
    uvs = paint = None
    if any(uv is not None for *_, uv, _ in pieces):
        uvs = np.concatenate(
            [np.zeros((n, 3, 2)) if u is None else u for n, (*_, u, _) in zip(counts, pieces, strict=True)]
        )
    if any(p is not None for *_, p in pieces):
        paint = np.concatenate([np.ones((n, 3)) if p is None else p for n, (*_, p) in zip(counts, pieces, strict=True)])
    looks = [look if uv is not None else _without_texture(look) for _, look, uv, _ in pieces]
    return dress(mesh, looks, rows, uvs=uvs, paint=paint)
