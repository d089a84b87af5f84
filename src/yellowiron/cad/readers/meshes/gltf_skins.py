"""Skinned meshes of a glTF document: where their bones hold them, and a mesh for every bone.

A skinned mesh stands where its bones put it and not where its node is (glTF 2.0, 3.7.3.3): point x at
the sum of w · B · I · x over its bones, B the bone's transform and I its inverse bind matrix. On a machine a bone is a
body: nothing bends. So each triangle goes to the bone that has most of it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.cad.appearance.looks import Dressed, joined
from yellowiron.cad.readers.meshes.gltf_accessors import accessor
from yellowiron.cad.readers.meshes.gltf_meshes import Piece
from yellowiron.model.assembly import Node
from yellowiron.model.geometry import Floats, Mesh


@dataclass(frozen=True, eq=False)
class Bones:
    """The bones of a skin: (k,) their numbers in the tree, and (k, 4, 4) what takes a point of the mesh to the file's
    frame."""

    numbers: NDArray[np.int64]
    matrices: Floats


def bones_of(
    document: Mapping[str, Any], buffers: Sequence[bytes], places: Mapping[int, int], tree: Sequence[Node]
) -> dict[int | None, Bones]:
    """The skins by index, `places` the document's nodes in the tree; those that are broken are absent."""
    skins = document.get("skins")
    found: dict[int | None, Bones] = {}
    for index, skin in enumerate(skins if isinstance(skins, list) else []):
        joints = skin.get("joints") if isinstance(skin, dict) else None
        if not isinstance(joints, list) or not joints or any(places.get(j) is None for j in joints):
            continue
        numbers = np.array([places[j] for j in joints], dtype=np.int64)
        inverse = np.broadcast_to(np.eye(4), (len(joints), 4, 4))
        if "inverseBindMatrices" in skin:
            values = accessor(document, buffers, skin["inverseBindMatrices"])
            if values is None or values.shape[1] != 16 or len(values) < len(joints):
                continue
            inverse = values[: len(joints)].reshape(-1, 4, 4).transpose(0, 2, 1)
        placed = np.array([tree[n].transform for n in numbers])
        if np.isfinite(placed).all() and np.isfinite(inverse).all():
            found[index] = Bones(numbers, placed @ inverse)
    return found


def bind(pieces: Sequence[Piece], bones: Bones | None) -> dict[int, Dressed]:
    """The skinned mesh in the file's frame, a mesh for each bone that has triangles, by its number in the tree; nothing
    where the skin is broken or does not fit the mesh."""
    if bones is None or not pieces or any(not _fits(piece, bones) for piece in pieces):
        return {}
    shares: dict[int, list[Any]] = {}
    for piece in pieces:
        mesh, look, uvs, paint = piece.drawn
        assert piece.bones is not None and piece.weights is not None
        numbers = piece.bones.astype(np.int64)
        total = piece.weights.sum(axis=1, keepdims=True)
        first = np.eye(numbers.shape[1])[0]
        weights = np.where(total > 0.0, piece.weights / np.where(total > 0.0, total, 1.0), first)
        held = np.zeros((len(weights), 4, 4))
        share = np.zeros((len(weights), len(bones.numbers)))
        for bone, weight in zip(numbers.T, weights.T, strict=True):
            held += weight[:, None, None] * bones.matrices[bone]
            share[np.arange(len(share)), bone] += weight
        points = np.einsum("nij,nj->ni", held[:, :3, :3], mesh.points) + held[:, :3, 3]
        owner = share[mesh.triangles].sum(axis=1).argmax(axis=1)
        for bone in np.unique(owner).tolist():
            mine = owner == bone
            used, corners = np.unique(mesh.triangles[mine], return_inverse=True)
            own = Mesh(points[used], corners.reshape(-1, 3).astype(np.int32))
            drawn = (own, look, None if uvs is None else uvs[mine], None if paint is None else paint[mine])
            shares.setdefault(int(bones.numbers[bone]), []).append(drawn)
    return {number: joined(drawn) for number, drawn in sorted(shares.items())}


def _fits(piece: Piece, bones: Bones) -> bool:
    if piece.bones is None or piece.weights is None or not np.isfinite(piece.weights).all():
        return False
    return bool(((piece.bones >= 0) & (piece.bones < len(bones.numbers))).all() and (piece.weights >= 0.0).all())
