"""What strangers' machines have suffered: the damages that converters, artists, games and haste do to a machine.

`DAMAGES` names them. `damaged(kind, seed, damage)` gives the machine with its truth; a part of several bodies has its
truth in `Machine.mixed`, what is no part of the machine has the body `EXTRA`, and of `a|b` either body is right.
Features of shapes are not kept up: `kit.scene.scene` reads the meshes as they come out of a file.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import trimesh

from kit.machines import solids
from kit.machines import surfaces as s
from kit.machines.defects import drawn
from kit.machines.drawers import DRAWERS
from kit.machines.mixed import by_material, one_mesh, world_mesh
from kit.machines.solids import lathe
from kit.machines.surroundings import EXTRA, attachment, copied, extras, ground_plate
from kit.machines.synthetic import Machine, loader
from yellowiron.model.assembly import Part
from yellowiron.model.geometry import Mesh

__all__ = ["ALL", "DAMAGES", "EXTRA", "KINDS", "Damage", "base", "damaged"]

KINDS = ("loader", "excavator")
ALL = (*KINDS, *DRAWERS)
Change = Callable[[Machine, np.random.Generator], Machine]


@dataclass(frozen=True)
class Damage:
    """What happens to a machine, to which kinds, and how it is drawn before."""

    change: Change
    kinds: tuple[str, ...] = KINDS
    segments: int = 32
    straight: bool = False
    """Drawn without its steering turned."""


def unharmed(machine: Machine, rng: np.random.Generator) -> Machine:
    return machine


def kept(machine: Machine, keep: Callable[[Part], bool]) -> Machine:
    """The machine with some of its parts."""
    parts = [p for p in machine.parts if keep(p)]
    ids, used = {p.id for p in parts}, {p.shape for p in parts}
    return replace(
        machine, parts=parts, truth={i: t for i, t in machine.truth.items() if i in ids},
        shapes={k: v for k, v in machine.shapes.items() if k in used},
    )  # fmt: skip


def is_ram(body: str) -> bool:
    """Whether a body is half of a hydraulic cylinder."""
    return "piston_rod" in body or "cylinder_barrel" in body


def no_cylinders(machine: Machine, rng: np.random.Generator) -> Machine:
    """Rigged to be turned at its hinges: no hydraulic cylinder, nor its pins."""
    return kept(machine, lambda p: not is_ram(machine.truth[p.id][1]) and not is_ram(machine.truth[p.id][0]))


def no_undercarriage(machine: Machine, rng: np.random.Generator) -> Machine:
    """Nothing below the slewing bearing; of a loader, neither wheels nor the rear axle."""

    def keep(part: Part) -> bool:
        body = machine.truth[part.id][1]
        return body not in ("undercarriage", "rear_axle") and "wheel" not in body and "blade" not in body

    return kept(machine, keep)


WORK = ("boom", "adjust_boom", "arm", "tipping_link", "bucket_link", "bucket", "rocker")


def work_equipment(machine: Machine, rng: np.random.Generator) -> Machine:
    """Boom, arm and bucket with their cylinders, and nothing that they hang on but its pins."""

    def keep(part: Part) -> bool:
        role, body = machine.truth[part.id]
        ram = is_ram(body) and not body.startswith(("steering", "blade"))
        return body in WORK or ram or role in ("boom_pin", "quick_coupler")

    return kept(machine, keep)


def half(machine: Machine, rng: np.random.Generator) -> Machine:
    """Only what is left of the middle plane is drawn; what crosses it is cut, and open there."""
    shapes, parts = dict(machine.shapes), []
    for part in machine.parts:
        mesh = world_mesh(machine, part)
        if mesh.points[:, 1].min() > -1e-6:
            parts.append(part)
            continue
        if mesh.points[:, 1].max() < 1e-6:
            continue
        solid = trimesh.Trimesh(mesh.points, mesh.triangles, process=False)
        cut = trimesh.intersections.slice_mesh_plane(solid, (0.0, 1.0, 0.0), (0.0, 0.0, 0.0))
        cut.update_faces(cut.area_faces > 1e-10)
        cut.remove_unreferenced_vertices()
        if not len(cut.faces):
            continue
        key = f"half {part.id}"
        mesh = Mesh(np.asarray(cut.vertices, dtype=np.float64), np.asarray(cut.faces, dtype=np.int32))
        shapes[key] = replace(machine.shapes[part.shape], key=key, mesh=mesh)
        parts.append(replace(part, shape=key, transform=np.eye(4)))
    return kept(replace(machine, shapes=shapes, parts=parts), lambda part: True)


def with_extras(machine: Machine, rng: np.random.Generator) -> Machine:
    """A trailer, a driver, a second machine half as large."""
    kind = machine.title.casefold()
    return extras(machine, rng, drawn(kind, int(rng.integers(1000))))


def belts(machine: Machine, rng: np.random.Generator) -> Machine:
    """One closed belt a side instead of the shoes."""
    is_shoe = {p.id: machine.truth[p.id][0].startswith("track_shoe") for p in machine.parts}
    result = copied(kept(machine, lambda p: not is_shoe[p.id]))
    for side in ("l", "r"):
        row = [p for p in machine.parts if is_shoe[p.id] and machine.truth[p.id][0].startswith(f"track_shoe_{side}_")]
        row = [p for p in row if p.name == "shoe"]
        mesh = _belt(machine, row)
        key = f"belt_{side}"
        shape = replace(machine.shapes[row[0].shape], key=key, name="belt", mesh=mesh)
        result.add(f"belt_{side}", "undercarriage", "undercarriage", shape, np.eye(4))
    return result


def _belt(machine: Machine, shoes: list[Part]) -> Mesh:
    """A closed band through the rows of a track's shoes, as wide and thick as they are."""
    points = machine.shapes[shoes[0].shape].mesh.points
    half_width, low, high = np.abs(points[:, 1]).max(), points[:, 2].min(), points[:, 2].max()
    rings = []
    for part in shoes:
        corners = np.array([[0, -half_width, low], [0, half_width, low], [0, half_width, high], [0, -half_width, high]])
        rings.append(corners @ part.transform[:3, :3].T + part.transform[:3, 3])
    n = len(rings)
    triangles = []
    for k in range(n):
        a, b = 4 * k, 4 * ((k + 1) % n)
        for i in range(4):
            j = (i + 1) % 4
            triangles += [[a + i, b + i, b + j], [a + i, b + j, a + j]]
    mesh = Mesh(np.concatenate(rings), np.array(triangles, dtype=np.int32))
    if trimesh.Trimesh(mesh.points, mesh.triangles, process=False).volume < 0:
        mesh = Mesh(mesh.points, mesh.triangles[:, ::-1].copy())
    return mesh


ROUND = ("sprocket", "idler", "track_roller", "carrier_roller")


def low_poly_wheels(machine: Machine, rng: np.random.Generator) -> Machine:
    """Wheels are prisms of twelve sides, without rim, hub or bolts; sprockets have no teeth."""

    def is_wheel(part: Part) -> bool:
        return part.name == "tyre" or part.name.startswith(ROUND)

    def is_detail(part: Part) -> bool:
        return "wheel" in machine.truth[part.id][1] and part.name != "tyre"

    result = kept(machine, lambda p: not is_detail(p))
    kept_segments, solids.SEGMENTS = solids.SEGMENTS, 12
    try:
        return s.with_meshes(result, _prism, of=is_wheel)
    finally:
        solids.SEGMENTS = kept_segments


def _prism(mesh: Mesh) -> Mesh:
    radius = float(np.hypot(mesh.points[:, 0], mesh.points[:, 1]).max())
    low, high = float(mesh.points[:, 2].min()), float(mesh.points[:, 2].max())
    return lathe("prism", [(0.0, low), (radius, low), (radius, high), (0.0, high)]).mesh


DAMAGES: dict[str, Damage] = {
    "sound": Damage(unharmed, kinds=ALL),
    "decimated 70": Damage(s.decimated(0.7), kinds=ALL),
    "decimated 30": Damage(s.decimated(0.3), kinds=ALL),
    "opened": Damage(s.opened, kinds=ALL),
    "open pins": Damage(s.open_pins, kinds=ALL),
    "loose pins": Damage(s.loose_pins, kinds=ALL),
    "duplicate faces": Damage(s.duplicate_faces, kinds=ALL),
    "inverted": Damage(s.inverted_faces, kinds=ALL),
    "double-sided": Damage(s.double_sided, kinds=ALL),
    "z-fighting": Damage(s.z_fighting, kinds=ALL),
    "8-gon": Damage(unharmed, kinds=ALL, segments=8),
    "scale slips": Damage(s.scale_slips, kinds=ALL),
    "mirrored": Damage(s.mirrored, kinds=ALL),
    "node scale": Damage(s.node_scale, kinds=ALL),
    "by material": Damage(by_material, kinds=ALL),
    "one mesh": Damage(one_mesh, kinds=ALL),
    "half": Damage(half, straight=True),
    "no cylinders": Damage(no_cylinders),
    "no undercarriage": Damage(no_undercarriage),
    "work equipment": Damage(work_equipment),
    "ground": Damage(ground_plate, kinds=ALL),
    "extras": Damage(with_extras),
    "attachment": Damage(attachment),
    "millimetres": Damage(s.in_unit(1000.0), kinds=ALL),
    "centimetres": Damage(s.in_unit(100.0), kinds=ALL),
    "inches": Damage(s.in_unit(1 / 0.0254), kinds=ALL),
    "belts": Damage(belts, kinds=("excavator",)),
    "low-poly wheels": Damage(low_poly_wheels),
}


def base(kind: str, seed: int, damage: str) -> Machine:
    """The machine before its damage, with the features of its surfaces."""
    how = DAMAGES[damage]
    corners, solids.CORNERS = solids.CORNERS, 8 if how.segments == 8 else solids.CORNERS
    try:
        if how.straight and kind == "loader":
            rng = np.random.default_rng([seed, 23])
            return loader(seed, embedded=bool(rng.random() < 0.5), steered=False)
        return DRAWERS[kind][0](seed) if kind in DRAWERS else drawn(kind, seed, segments=how.segments)
    finally:
        solids.CORNERS = corners


def damaged(kind: str, seed: int, damage: str) -> Machine:
    """The machine of a kind and seed with a damage."""
    return DAMAGES[damage].change(base(kind, seed, damage), np.random.default_rng([seed, 61]))
