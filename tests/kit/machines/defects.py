"""What goes wrong between a machine and its CAD file: one defect at a time, on the synthetic machines.

Each defect takes a machine as drawn and a generator of random numbers and gives back another machine with its truth.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from kit.machines import solids as align_solids
from kit.machines.articulated_trucks import articulated_truck
from kit.machines.backhoes import backhoe
from kit.machines.cranes import crane
from kit.machines.crawler import merged
from kit.machines.crawler_cranes import crawler_crane
from kit.machines.dozers import dozer
from kit.machines.excavators import Features, excavator
from kit.machines.graders import grader
from kit.machines.lift_trucks import lift_truck
from kit.machines.parallel_loaders import parallel_loader
from kit.machines.rigid_trucks import rigid_truck
from kit.machines.rocking_dozers import rocking_dozer
from kit.machines.rollers import roller
from kit.machines.skid_steers import skid_steer
from kit.machines.solids import Array, bolt, place
from kit.machines.synthetic import Machine, loader
from kit.machines.telehandlers import telehandler
from kit.machines.wheeled_excavators import wheeled_excavator
from kit.machines.yoke_rollers import yoke_roller
from yellowiron.cad.mesh.assembly import shape_of
from yellowiron.model.assembly import Part
from yellowiron.model.geometry import Mesh, Shape

Defect = Callable[[Machine, np.random.Generator], Machine]


def drawn(kind: str, seed: int, *, segments: int = 32, hollow: bool = True) -> Machine:
    """The machine of a kind and seed, everything about it from the seed; round things of `segments` corners, and
    without holes unless `hollow`."""
    rng = np.random.default_rng([seed, 23])
    embedded, stop, hoses = bool(rng.random() < 0.5), bool(rng.random() < 0.15), int(rng.choice([0, 0, 4, 8]))
    links = int(rng.choice([1, 1, 2]))
    kept = align_solids.SEGMENTS, align_solids.HOLLOW
    align_solids.SEGMENTS, align_solids.HOLLOW = segments, hollow
    try:
        if kind == "loader":
            return loader(seed, embedded=embedded, stop=stop, hoses=hoses, links=links)
        if kind == "parallel_loader":
            return parallel_loader(seed, embedded=embedded, hoses=hoses)
        if kind == "skid_steer":
            return skid_steer(seed, embedded=embedded)
        if kind == "articulated_truck":
            return articulated_truck(seed, embedded=embedded)
        if kind == "rigid_truck":
            return rigid_truck(seed, embedded=embedded)
        if kind == "roller":
            return roller(seed, embedded=embedded)
        if kind == "yoke_roller":
            return yoke_roller(seed, embedded=embedded)
        if kind == "grader":
            return grader(seed, embedded=embedded)
        if kind == "dozer":
            return dozer(seed, embedded=embedded)
        if kind == "rocking_dozer":
            return rocking_dozer(seed, embedded=embedded)
        if kind == "crane":
            return crane(seed, embedded=embedded)
        if kind == "crawler_crane":
            return crawler_crane(seed, embedded=embedded)
        if kind == "telehandler":
            return telehandler(seed, embedded=embedded)
        if kind == "wheeled_excavator":
            return wheeled_excavator(seed, embedded=embedded)
        if kind == "backhoe":
            return backhoe(seed, embedded=embedded)
        if kind == "forklift":
            return lift_truck(seed, embedded=embedded)
        if kind == "mini":
            swinging = Features("single", swing=True, blade=seed % 3, tipping=("plates", "welded")[seed % 2])
            return excavator(seed, swinging, embedded=embedded)
        return excavator(seed, embedded=embedded)
    finally:
        align_solids.SEGMENTS, align_solids.HOLLOW = kept


def _with(machine: Machine, parts: list[Part]) -> Machine:
    kept = {p.id for p in parts}
    return replace(machine, parts=parts, truth={i: t for i, t in machine.truth.items() if i in kept})


def is_pin(machine: Machine, part: Part) -> bool:
    return machine.truth[part.id][0].endswith("_pin") and part.name == machine.truth[part.id][0]


def sound(machine: Machine, rng: np.random.Generator) -> Machine:
    return machine


def no_pins(machine: Machine, rng: np.random.Generator) -> Machine:
    return _with(machine, [p for p in machine.parts if not is_pin(machine, p)])


def half_pins(machine: Machine, rng: np.random.Generator) -> Machine:
    return _with(machine, [p for p in machine.parts if not is_pin(machine, p) or rng.random() < 0.5])


def jitter(machine: Machine, rng: np.random.Generator) -> Machine:
    """Every part 1 mm to anywhere."""
    parts = []
    for part in machine.parts:
        matrix = part.transform.copy()
        way = rng.normal(size=3)
        matrix[:3, 3] += 1e-3 * way / np.linalg.norm(way)
        parts.append(replace(part, transform=matrix))
    return _with(machine, parts)


def shrink(machine: Machine, rng: np.random.Generator) -> Machine:
    """Every part 0.3 % smaller about the middle of its box."""
    parts = []
    for part in machine.parts:
        points = machine.shapes[part.shape].mesh.points
        middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        smaller = np.eye(4)
        smaller[:3, :3] *= 0.997
        smaller[:3, 3] = 0.003 * middle
        parts.append(replace(part, transform=part.transform @ smaller))
    return _with(machine, parts)


def merged_bodies(machine: Machine, rng: np.random.Generator) -> Machine:
    """Half of the bodies drawn as one solid each, pins and tracks apart."""
    groups: dict[str, list[Part]] = {}
    for part in machine.parts:
        role, body = machine.truth[part.id]
        if body and role in (body, "cutting_edge") and part.name != "axle":
            groups.setdefault(body, []).append(part)
    chosen = {b: g for b, g in sorted(groups.items()) if len(g) > 1 and rng.random() < 0.5}
    return _merged(machine, chosen)


def _merged(machine: Machine, groups: dict[str, list[Part]]) -> Machine:
    gone = {p.id for g in groups.values() for p in g}
    result = replace(
        _with(machine, [p for p in machine.parts if p.id not in gone]), shapes=dict(machine.shapes), pose=np.eye(4)
    )
    for body, parts in groups.items():
        shape = merged(f"merged_{body}", *((machine.shapes[p.shape], p.transform) for p in parts))
        result.add(body, body, body, shape, np.eye(4))
    return result


def missing_cylinder(machine: Machine, rng: np.random.Generator) -> Machine:
    """One hydraulic cylinder without any of its parts, twins both."""
    rods = sorted({b.removesuffix("_l").removesuffix("_r") for _, b in machine.truth.values() if "piston_rod" in b})
    rod = str(rng.choice(rods))
    barrel = rod.replace("piston_rod", "cylinder_barrel")
    gone = {f"{b}{side}" for b in (rod, barrel) for side in ("", "_l", "_r")}
    return _with(machine, [p for p in machine.parts if is_pin(machine, p) or machine.truth[p.id][1] not in gone])


def crowded(machine: Machine, count: int) -> Machine:
    """The machine with as many parts: bolts are added that stand anywhere on its faces, apart from each other."""
    rng = np.random.default_rng([count, 37])
    result = replace(
        machine, parts=list(machine.parts), shapes=dict(machine.shapes), truth=dict(machine.truth), pose=np.eye(4)
    )
    bolts = [bolt(f"crowd{k}", r, 4 * r) for k, r in enumerate((0.008, 0.01, 0.012))]
    hosts = [p for p in machine.parts if machine.truth[p.id][1] and machine.shapes[p.shape].area > 0.3]
    faces = [(h, h.transform[:3, :3] @ c + h.transform[:3, 3:]) for h in hosts for c in _corners(machine, h)]
    areas = np.array([np.linalg.norm(np.cross(c[:, 1] - c[:, 0], c[:, 2] - c[:, 0])) for _, c in faces])
    spots = np.zeros((0, 3))
    while len(result.parts) < count:
        host, corners = faces[int(rng.choice(len(faces), p=areas / areas.sum()))]
        spot = corners @ rng.dirichlet((1.0, 1.0, 1.0))
        if len(spots) and np.linalg.norm(spots - spot, axis=1).min() < 0.04:
            continue
        spots = np.vstack([spots, spot])
        body = machine.truth[host.id][1]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        result.add("bolt", body, body, bolts[int(rng.integers(3))], place(spot, normal))
    return result


def _corners(machine: Machine, part: Part) -> Array:
    """(m, 3, 3) the corners of a part's triangles in its own frame, one a column."""
    mesh = machine.shapes[part.shape].mesh
    return np.asarray(mesh.points[mesh.triangles].transpose(0, 2, 1))


DEFECTS: dict[str, Defect] = {
    "sound": sound,
    "no pins": no_pins,
    "half the pins": half_pins,
    "1 mm jitter": jitter,
    "0.3 % shrink": shrink,
    "merged": merged_bodies,
    "8 segments": sound,
    "missing cylinder": missing_cylinder,
    "visual": no_pins,
}


def spoiled(kind: str, seed: int, defect: str, *, triangles: bool = False) -> Machine:
    """A machine with one defect, its features exact or (`triangles`) found on its triangles."""
    machine = drawn(kind, seed, segments=8 if defect == "8 segments" else 32, hollow=defect != "visual")
    machine = DEFECTS[defect](machine, np.random.default_rng([seed, 31]))
    if triangles:
        used = {p.shape for p in machine.parts}
        machine = replace(machine, shapes=on_triangles({k: s for k, s in machine.shapes.items() if k in used}))
    return machine


def on_triangles(shapes: Mapping[str, Shape]) -> dict[str, Shape]:
    """The shapes as their triangles show them, in single precision."""
    return {k: replace(shape_of(_plain(s.mesh), s.name), key=k) for k, s in shapes.items()}


def _plain(mesh: Mesh) -> Mesh:
    points = np.asarray(mesh.points, dtype=np.float32).astype(np.float64)
    corners: Array = points[mesh.triangles]
    twice = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return Mesh(points, mesh.triangles[twice > 1e-14])
