"""The plan: what every prim of a machine is called and where it stands, decided once for all layers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats, Mesh, Shape
from yellowiron.model.mechanism import Body, BodyPart, Mechanism
from yellowiron.support.convex.pieces import convex_pieces
from yellowiron.support.record import COLLIDING
from yellowiron.usd.authoring.materials import Look, look_of
from yellowiron.usd.authoring.merge_points import weld
from yellowiron.usd.authoring.stage import Names
from yellowiron.usd.planning.collision import APPROXIMATIONS, Approximation, approximation
from yellowiron.usd.planning.lathe_colliders import turned_pieces
from yellowiron.usd.planning.pin_links import PinLink, plan_pin_links
from yellowiron.usd.planning.primitives import Primitive
from yellowiron.usd.planning.touching import POOLED, Pool, Touching, as_drawn, fine_and_light, solids_of, told_alone

GEOMETRY_FILE = "geometry.usdc"
PROTOTYPES, HULLS, SOLIDS = "/Prototypes", "/Hulls", "/Colliders"
VISUALS, COLLIDERS, HULL = "visuals", "colliders", "hull"
HULL_SCALE = "yellowiron:scale"
"""Of a body's hull, in a variant: factors along the machine's axes that its points are taken times."""
MESH, PIECE = "mesh", "piece_"
"""Under a collider of several pieces: the part's own mesh, which does not collide, and the pieces, numbered from 1."""
JOINTS, MATERIALS, ACTUATORS, BASE_JOINT = "joints", "materials", "actuators", "base_joint"


@dataclass(frozen=True, eq=False)
class Prototype:
    """A shape with its look. `path` in the geometry layer; `mesh` the path of the mesh that holds its points (another
    prototype's where two looks share a shape)."""

    path: str
    mesh: str
    shape: Shape
    look: Look


@dataclass(frozen=True, eq=False)
class PlacedPart:
    """A part in its body: `name` of its prims under `visuals` and `colliders`; `matrix` (4, 4) takes the shape's frame
    to the body's, metres, column vectors. `pieces`: what it collides as where that is several convex meshes, in the
    shape's frame."""

    name: str
    part: Part
    data: BodyPart
    prototype: Prototype
    matrix: Floats
    approximation: Approximation
    pieces: tuple[Mesh, ...] = ()
    pooled: bool = False

    @property
    def collides(self) -> bool:
        """Whether it has a collider of its own."""
        return bool(self.approximation.usd) and not self.pooled


@dataclass(frozen=True, eq=False)
class Solid:
    """A collider that stands for parts: `name` of its prim, `path` of its mesh in the geometry layer, body frame."""

    name: str
    path: str
    data: Touching


@dataclass(frozen=True, eq=False)
class Plan:
    """Paths by name. `root` is the machine's prim; `body_paths`, `joint_paths`, `site_paths`, `sensor_paths` (of
    sensors on bodies) and `material_paths` are
    absolute in the composed machine; `hull_paths` are in the geometry layer. `parts` holds each body's parts in the
    mechanism's order, `solids` by detail and body what stands for the pooled ones, `pin_links` those of slewed cut
    pins."""

    mechanism: Mechanism
    root: str
    body_paths: Mapping[str, str]
    joint_paths: Mapping[str, str]
    site_paths: Mapping[str, str]
    sensor_paths: Mapping[str, str]
    material_paths: Mapping[str, str]
    hull_paths: Mapping[str, str]
    parts: Mapping[str, tuple[PlacedPart, ...]]
    prototypes: tuple[Prototype, ...]
    solids: Mapping[str, Mapping[str, tuple[Solid, ...]]]
    pin_links: tuple[PinLink, ...] = ()

    @property
    def root_name(self) -> str:
        """The name of the machine's prim."""
        return self.root[1:]


def make_plan(mechanism: Mechanism, assembly: Assembly, frame: Floats, name: str) -> Plan:
    """Names and transforms of a machine. `frame` (4, 4) takes the assembly's frame to the machine's, metres.

    `MechanismError` where a body names a part that the assembly has not, a material or an approximation unknown.
    """
    root = "/" + Names().give(name)
    inner = Names(JOINTS, MATERIALS, ACTUATORS)
    body_paths = {body.name: f"{root}/{inner.give(body.name)}" for body in mechanism.bodies}
    joint_names, material_names, home_names = Names(BASE_JOINT), Names(), Names()
    homes = {body.name: home_names.give(body.name) for body in mechanism.bodies}
    joint_paths = {j.name: f"{root}/{JOINTS}/{joint_names.give(j.name)}" for j in mechanism.joints}
    placer = _Placer(mechanism, assembly, frame)
    parts = {body.name: placer.place(body) for body in mechanism.bodies}
    inside = {body: Names(VISUALS, COLLIDERS, HULL) for body in body_paths}
    return Plan(
        mechanism=mechanism,
        root=root,
        body_paths=body_paths,
        joint_paths=joint_paths,
        site_paths={s.name: f"{body_paths[s.body]}/{inside[s.body].give(s.name)}" for s in mechanism.sites},
        sensor_paths={
            s.name: f"{body_paths[s.body]}/{inside[s.body].give(s.name)}" for s in mechanism.sensors if s.body
        },
        material_paths={m: f"{root}/{MATERIALS}/{material_names.give(m)}" for m in mechanism.materials},
        hull_paths={name: f"{HULLS}/{home}" for name, home in homes.items()},
        parts=parts,
        prototypes=tuple(placer.prototypes.prototypes),
        solids=_solids(mechanism, placer.pool, parts, homes),
        pin_links=tuple(plan_pin_links(mechanism, root, inner, f"{root}/{JOINTS}", joint_names)),
    )


def _solids(
    mechanism: Mechanism, pool: Pool, parts: Mapping[str, tuple[PlacedPart, ...]], homes: Mapping[str, str]
) -> dict[str, dict[str, tuple[Solid, ...]]]:
    """The colliders of the pooled parts, full and light, in their bodies' frames."""
    found: dict[str, dict[str, tuple[Solid, ...]]] = {}
    for detail, made in zip(COLLIDING, fine_and_light(mechanism, pool), strict=True):
        found[detail] = {}
        for body in mechanism.bodies:
            names = Names(*(p.name for p in parts[body.name] if p.collides), *(s.name for s in body.shapes))
            solids = []
            for one in made.get(body.name, ()):
                name = names.give(one.label)
                path = f"{SOLIDS}/{homes[body.name]}/{detail}_{name}"
                solids.append(Solid(name, path, one.shifted(-np.asarray(body.origin))))
            found[detail][body.name] = tuple(solids)
    return found


class Prototypes:
    """One prototype for each pair of shape and look, in the order they are asked for."""

    def __init__(self, root: str = PROTOTYPES) -> None:
        self.root = root
        self.prototypes: list[Prototype] = []
        self._by_key: dict[tuple[str, Look], Prototype] = {}
        self._mesh_by_shape: dict[str, str] = {}
        self._names = Names()

    def give(self, shape: Shape, look: Look) -> Prototype:
        """The prototype of a shape with a look."""
        found = self._by_key.get((shape.key, look))
        if found is None:
            path = f"{self.root}/{self._names.give(shape.name or 'shape')}"
            # What is bound to some triangles, or mapped otherwise, is a mesh of its own.
            kind = f"{shape.key} {path}" if look.faces else f"{shape.key} {look.texture is not None}"
            mesh = self._mesh_by_shape.setdefault(kind if shape.finishes else shape.key, f"{path}/mesh")
            found = Prototype(path, mesh, shape, look)
            self._by_key[shape.key, look] = found
            self.prototypes.append(found)
        return found


class _Placer:
    """Turns a body's part names into placed parts."""

    def __init__(self, mechanism: Mechanism, assembly: Assembly, frame: Floats) -> None:
        self._mechanism = mechanism
        self._assembly = assembly
        self._frame = frame
        self._parts = {part.id: part for part in assembly.parts}
        self._pieces: dict[str, tuple[Mesh, ...]] = {}
        self._solids: dict[tuple[str, str], tuple[Mesh | Primitive, ...]] = {}
        self._alone = told_alone(mechanism)
        self.prototypes = Prototypes()
        self.pool: Pool = {}
        """What the pooled parts would collide as by themselves, machine frame."""

    def place(self, body: Body) -> tuple[PlacedPart, ...]:
        names = Names()
        to_body = np.eye(4)
        to_body[:3, 3] = -np.asarray(body.origin)
        to_body = to_body @ self._frame
        placed = []
        for data in body.parts:
            part = self._parts.get(data.part)
            if part is None:
                raise MechanismError(
                    f"Body '{body.name}' has a part that the CAD model has not",
                    where=data.part,
                    hint="Write the mechanism with the assembly it was built from.",
                )
            material = self._mechanism.materials.get(data.material)
            if material is None and data.material:
                raise MechanismError(
                    f"The material '{data.material}' is not defined",
                    where=data.part,
                    hint=f"Known: {', '.join(self._mechanism.materials) or 'none'}.",
                )
            shape = self._assembly.shape_of(part)
            name = names.give(part.name or shape.name or "part")
            asked = approximation(data.collision, where=data.part)
            pooled = data.pooled and asked.token in POOLED and body.name not in self._alone
            if pooled:
                self._fill_pool(body.name, name, data, part, shape, asked.token)
            chosen, pieces = (asked, ()) if pooled else self._collision(asked, shape)
            placed.append(
                PlacedPart(
                    name=name,
                    part=part,
                    data=data,
                    prototype=self.prototypes.give(shape, look_of(part.color, shape, material)),
                    matrix=to_body @ part.transform,
                    approximation=chosen,
                    pieces=pieces,
                    pooled=pooled,
                )
            )
        return tuple(placed)

    def _fill_pool(self, body: str, name: str, data: BodyPart, part: Part, shape: Shape, token: str) -> None:
        if not len(shape.mesh.points):
            return
        key = (shape.key, token)
        if key not in self._solids:
            self._solids[key] = solids_of(shape, token)
        matrix = self._frame @ part.transform
        material = self._mechanism.materials.get(data.material)
        drawn = as_drawn(self._solids[key], matrix, label=name, material=material, key=data.material, part=part.id)
        self.pool.setdefault(body, []).extend(drawn)

    def _collision(self, asked: Approximation, shape: Shape) -> tuple[Approximation, tuple[Mesh, ...]]:
        """The approximation asked for, and its pieces; where one piece stands for a part, it is its hull."""
        if asked.token not in ("convexDecomposition", "turned"):
            return asked, ()
        key = f"{asked.token} {shape.key}"
        if key not in self._pieces:
            self._pieces[key] = turned_pieces(shape) if asked.token == "turned" else self._decomposed(shape)
        pieces = self._pieces[key]
        return (asked, pieces) if len(pieces) > 1 else (APPROXIMATIONS["convexHull"], ())

    def _decomposed(self, shape: Shape) -> tuple[Mesh, ...]:
        points, triangles, _ = weld(shape.mesh)
        return convex_pieces(Mesh(points.astype(np.float64), triangles)) if len(triangles) else ()
