"""A damaged machine as a stranger's file gives it: read like one, under names or none, with its truth by place.

scene = scene("excavator", 3, "by material", names="with")
scene.assembly                 # an Assembly, as a reader of triangles returns it
scene.truth                    # Surface: where which body's surface is
scene.joints                   # the axes of what is drawn
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from kit.machines.damages import EXTRA, base, damaged
from kit.machines.drawers import DRAWERS
from kit.machines.excavators import any_features
from kit.machines.mixed import world_mesh
from kit.machines.solids import Array
from kit.machines.spoken_names import named
from kit.machines.synthetic import Machine
from yellowiron.alignment.assignment.search import variants_of
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Mesh
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose

TEMPLATES = {"loader": "wheel_loader", "excavator": "excavator", **{kind: of for kind, (_, of) in DRAWERS.items()}}
ROWS = ("track_shoe", "track_roller", "carrier_roller", "sprocket", "idler")


@dataclass(frozen=True, eq=False)
class Surface:
    """Where which body's surface is: (n, 3) centres of triangles in the CAD frame, (n,) areas, (n,) numbers of
    `labels`: (role, body), body '' where nobody knows, `EXTRA` where it is no part of the machine, `a|b` where both
    are right."""

    points: Array
    areas: Array
    label: np.ndarray[tuple[int], np.dtype[np.int64]]
    labels: tuple[tuple[str, str], ...]
    whole: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    """Part id → the label of all of it, if it is not taken apart; then those of its shells that are of others."""
    ties: Mapping[int, int] = field(default_factory=dict)
    """Label → that one whose body it must share."""


@dataclass(frozen=True)
class TrueJoint:
    """A joint that is drawn: its bodies, a point and unit axis in the CAD frame. `others`: bodies that each end may
    also be; `tolerance` (the frame's unit) and `degrees`, where its label says some."""

    name: str
    type: str
    bodies: tuple[str, str]
    point: tuple[float, float, float]
    axis: tuple[float, float, float]
    others: tuple[tuple[str, ...], tuple[str, ...]] = ((), ())
    tolerance: float | None = None
    degrees: float = 0.0


@dataclass(frozen=True, eq=False)
class Scene:
    """A model, what is true of it, and the height of the machine in the CAD frame's unit."""

    assembly: Assembly
    truth: Surface
    joints: tuple[TrueJoint, ...]
    height: float
    type: str


def scene(kind: str, seed: int, damage: str, *, names: str = "without", turn: str = "upright") -> Scene:
    """A machine of a kind and seed with a damage, shuffled. `names`: `with` (English) or `without`; `turn`: `upright`
    (Y or Z up, along an axis) or `any`."""
    sound = base(kind, seed, damage)
    machine = damaged(kind, seed, damage)
    world = placed(seed, turn)
    matrix = world @ np.linalg.inv(machine.frame)
    scale = float(np.cbrt(abs(np.linalg.det(np.linalg.inv(machine.frame)[:3, :3]))))
    assembly, truth = read(machine, seed, world, named_parts(machine, kind, seed) if names == "with" else None)
    there = {body for role, body in truth.labels if not role.endswith("_pin")}
    joints = tuple(j for j in true_joints(sound, kind, seed, matrix) if set(j.bodies) <= there)
    ups = [(sound.assembly().points_of(p)[:, 2]) for p in sound.parts]
    height = scale * float(max(u.max() for u in ups) - min(u.min() for u in ups))
    return Scene(assembly, truth, joints, height, TEMPLATES[kind])


def placed(seed: int, turn: str) -> Array:
    """(4, 4) the file's frame in which a machine (X forward, Z up) stands."""
    rng = np.random.default_rng([seed, 67])
    world = np.eye(4)
    if turn == "any":
        q, r = np.linalg.qr(rng.normal(size=(3, 3)))
        q = q * np.sign(np.diag(r))
        q[:, 0] *= np.sign(np.linalg.det(q))
        world[:3, :3] = q
        return world
    c, n = ((1, 0), (0, 1), (-1, 0), (0, -1))[int(rng.integers(4))]
    world[:2, :2] = [[c, -n], [n, c]]
    if rng.random() < 0.5:
        world[:3, :3] = np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]]) @ world[:3, :3]
    return world


def named_parts(machine: Machine, kind: str, seed: int) -> list[str]:
    """What an English office calls the parts; joined meshes and what is no machine keep the names they have."""
    spoken = named(machine.assembly(), machine.truth, "en", seed, kind=kind)
    own = [p.id in machine.mixed or machine.truth[p.id][1].startswith(EXTRA) for p in machine.parts]
    return [p.name if o else n.name for p, n, o in zip(machine.parts, spoken.parts, own, strict=True)]


def read(machine: Machine, seed: int, world: Array, names: list[str] | None) -> tuple[Assembly, Surface]:
    """The machine as it comes out of a file of triangles in single precision that has no unit but metres; an assembly
    without parts where all of it is refused."""
    items, truth = occurrences(machine, seed, world, names)
    try:
        return assemble(items, name="machine", format="synthetic", unit=1.0, path="machine.glb"), truth
    except CadError as error:
        refused = Finding("CAD003", "error", error.where, error.message, error.hint)
        return Assembly("machine", "synthetic", 1.0, (), {}, (refused,)), truth


def occurrences(machine: Machine, seed: int, world: Array, names: list[str] | None) -> tuple[list[Occurrence], Surface]:
    """What a reader finds in the file, shuffled, and what is true of it."""
    order = np.random.default_rng([seed, 71]).permutation(len(machine.parts)).tolist()
    meshes = {key: _single(shape.mesh) for key, shape in machine.shapes.items()}
    single = replace(
        machine,
        shapes={k: replace(s, mesh=meshes[k]) for k, s in machine.shapes.items()},
        parts=[replace(p, transform=world @ p.transform) for p in machine.parts],
    )
    items, points, areas, label = [], [], [], []
    labels: dict[tuple[str, str], int] = {}
    for position, index in enumerate(order):
        part = single.parts[index]
        name = names[index] if names is not None else f"Part_{position:03d}"
        items.append(Occurrence(name, ("Assembly",), meshes[part.shape], part.transform, part.color))
        centres, sizes = centres_of(world_mesh(single, part))
        points.append(centres)
        areas.append(sizes)
        for role, body, count in machine.mixed.get(part.id, ((*machine.truth[part.id], len(sizes)),)):
            label.append(np.full(count, labels.setdefault((role, body), len(labels))))
    return items, Surface(np.concatenate(points), np.concatenate(areas), np.concatenate(label), tuple(labels))


def centres_of(mesh: Mesh) -> tuple[Array, Array]:
    """(m, 3) centres and (m,) areas of a mesh's triangles."""
    a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
    return np.asarray((a + b + c) / 3.0), np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2.0)


def _single(mesh: Mesh) -> Mesh:
    return Mesh(mesh.points.astype(np.float32).astype(np.float64), mesh.triangles)


def true_choices(machine: Machine, kind: str, seed: int) -> dict[str, str]:
    """The template's variants that a drawn machine is."""
    if kind == "excavator":
        return any_features(seed).choices()
    if kind in DRAWERS:
        return _fitting(load_template(TEMPLATES[kind]), {body for _, body in machine.truth.values()})
    return {"lift_cylinders": "twin" if machine.twin else "single"}


def _fitting(template: Template, drawn: Collection[str]) -> dict[str, str]:
    """The variant that has most of the bodies that are drawn, and fewest others."""

    def fits(chosen: dict[str, str]) -> int:
        bodies = {r.name for r in choose(template, chosen).roles if r.rigid and not r.optional and not r.many}
        return len(bodies ^ {b for b in drawn if template.knows(b)})

    return min(variants_of(template, {}), key=fits)


def true_alignment(machine: Machine, kind: str, seed: int) -> tuple[Template, Alignment]:
    """The concrete template of a machine as drawn, and the alignment that is true of it."""
    choices = true_choices(machine, kind, seed)
    whole = choose(load_template(TEMPLATES[kind]), choices)
    rows = {r.name for r in whole.roles if r.many}
    parts, counts = [], dict[str, int]()
    for part in machine.parts:
        role, body = machine.truth[part.id]
        row, _, number = role.rpartition("_")
        if row in rows and number.isdigit():
            counts[row] = max(counts.get(row, 0), int(number))
        parts.append(PartAssignment(part.id, role or None, body or None, 1.0, "drawn"))
    alignment = Alignment(
        TEMPLATES[kind], np.eye(4), tuple(parts), choices={**choices}, counts=counts
    )  # fmt: skip
    return expand(whole, counts), alignment


def true_joints(machine: Machine, kind: str, seed: int, world: Array) -> list[TrueJoint]:
    """The joints of a machine as drawn, from its true roles and the exact features of its surfaces, those within a
    track's row apart; `world` takes the machine's frame to the CAD file's."""
    template, alignment = true_alignment(machine, kind, seed)
    mechanism = build_mechanism(machine.assembly(), template, alignment, Specifications(), name="truth")
    found = []
    for joint in mechanism.joints:
        if any(body.startswith(ROWS[:3]) for body in (joint.body0, joint.body1)) or joint.type == "fixed":
            continue
        axis = world[:3, :3] @ np.array(joint.axis)
        axis /= np.linalg.norm(axis)
        point = world[:3, :3] @ np.array(joint.anchor) + world[:3, 3]
        bodies = (joint.body0, joint.body1)
        found.append(TrueJoint(joint.name, joint.type, bodies, tuple(point.tolist()), tuple(axis.tolist())))
    return found
