"""Meshes that join parts of several bodies: one for every material, one for the whole machine."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from kit.machines.solids import Array
from kit.machines.synthetic import Machine
from yellowiron.model.assembly import Part
from yellowiron.model.geometry import Color, Mesh

PAINTS: dict[str, Color] = {
    "yellow paint": (0.9, 0.6, 0.05), "chrome": (0.8, 0.8, 0.8), "rubber": (0.02, 0.02, 0.02),
    "glass": (0.3, 0.5, 0.6), "dark steel": (0.1, 0.1, 0.1), "grey": (0.4, 0.4, 0.4),
}  # fmt: skip


def paint_of(machine: Machine, part: Part) -> str:
    """The paint that a part of a machine would have."""
    role, body = machine.truth[part.id]
    if part.name in ("tyre", "hose", "step"):
        return "rubber"
    if part.name == "glass":
        return "glass"
    if role.endswith("_pin") or "piston_rod" in body:
        return "chrome"
    if role.startswith(("track_", "sprocket", "idler", "carrier")) or part.name in ("axle", "tooth", "edge"):
        return "dark steel"
    return "grey" if part.name.startswith("M2") or "bolt" in part.name or part.name == "rim" else "yellow paint"


def world_mesh(machine: Machine, part: Part) -> Mesh:
    """A part's mesh at its place."""
    mesh, matrix = machine.shapes[part.shape].mesh, part.transform
    triangles = mesh.triangles if np.linalg.det(matrix[:3, :3]) > 0 else mesh.triangles[:, ::-1]
    return Mesh(np.asarray(mesh.points @ matrix[:3, :3].T + matrix[:3, 3]), triangles)


def joined(machine: Machine, groups: dict[str, list[Part]]) -> Machine:
    """The machine with one part for each group of parts, named as the group."""
    gone = {p.id for g in groups.values() for p in g}
    parts = [p for p in machine.parts if p.id not in gone]
    shapes, truth, mixed = dict(machine.shapes), dict(machine.truth), dict(machine.mixed)
    for name, group in groups.items():
        meshes = [world_mesh(machine, p) for p in group]
        starts = np.cumsum([0, *(len(m.points) for m in meshes)])
        points: Array = np.concatenate([m.points for m in meshes])
        triangles = np.concatenate([m.triangles + s for m, s in zip(meshes, starts[:-1], strict=True)])
        key = f"joined {name}"
        first = machine.shapes[group[0].shape]
        shapes[key] = replace(first, key=key, name=name, mesh=Mesh(points, triangles.astype(np.int32)))
        part_id = f"{machine.title}/{name}"
        parts.append(Part(part_id, name, (machine.title,), key, np.eye(4), PAINTS.get(name)))
        truth[part_id] = ("", "")
        mixed[part_id] = tuple((*machine.truth[p.id], len(m.triangles)) for p, m in zip(group, meshes, strict=True))
    kept = {p.id for p in parts}
    used = {p.shape for p in parts}
    return replace(
        machine, parts=parts, mixed=mixed,
        shapes={k: s for k, s in shapes.items() if k in used}, truth={i: t for i, t in truth.items() if i in kept},
    )  # fmt: skip


def by_material(machine: Machine, rng: np.random.Generator) -> Machine:
    """One mesh for every paint."""
    groups: dict[str, list[Part]] = {}
    for part in machine.parts:
        groups.setdefault(paint_of(machine, part), []).append(part)
    return joined(machine, dict(sorted(groups.items())))


def one_mesh(machine: Machine, rng: np.random.Generator) -> Machine:
    """Everything in one mesh."""
    return joined(machine, {"machine": list(machine.parts)})
