"""Real models with labels, as `Scene`s: the models are not here, only what is true of them.

A label file (`benchmarks/strangers/*.json`, `*.truth.json` of `../shared/data`) names a model's parts by id and says
which body each moves with, and where the joints are; see `rules` in each. The CAD is looked for in the folders that
`models` names: a file, or a folder, called as the label file is (with its files in `source/`).
"""

from __future__ import annotations

import itertools
import json
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from kit.scene import Scene, Surface, TrueJoint, centres_of
from yellowiron.cad import read_cad
from yellowiron.cad.mesh import measures
from yellowiron.cad.mesh.shells import components
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Mesh
from yellowiron.model.template import Template

ROOT = Path(__file__).resolve().parent.parent
LABELS = ROOT / "benchmarks" / "strangers"
SHARED = ROOT.parent / "shared" / "data"
NO_CAD = (".json", ".md", ".txt", ".py", ".pkl", ".png", ".jpg")
"""Suffixes of what lies beside a model."""
SAME_BOX = 0.02
"""Two boxes are of one shell if they differ by no more of their size."""
LINKS = {
    "zx120": {
        "link1": "undercarriage", "link2": "upperstructure", "link3": "boom", "link4": "arm", "link5": "bucket",
        "link6": "boom_cylinder_barrel", "link7": "boom_piston_rod", "link8": "arm_cylinder_barrel",
        "link9": "arm_piston_rod", "link10": "bucket_cylinder_barrel", "link11": "bucket_piston_rod",
        "link12": "tipping_link", "link13": "bucket_link",
    },
    "zx200": {
        "track_link": "undercarriage", "body_link": "upperstructure", "boom_link": "boom", "arm_link": "arm",
        "bucket_link": "bucket",
    },
}  # fmt: skip
"""Of labels that are robot descriptions: which role each link is."""
BODIES = {"upper_structure": "upperstructure"}
"""Bodies that labels call otherwise than the template."""
ALONG_TRACKS = ("track_", "sprocket", "idler", "carrier_roller")
"""How bodies are called whose joints are not scored: what runs along a track."""


_SIDE = re.compile(r"_[lr]$")


@dataclass(frozen=True)
class Model:
    """A label file, and where its CAD is (None: not on this machine)."""

    name: str
    labels: Mapping[str, Any]
    cad: Path | None

    @property
    def held_back(self) -> bool:
        """Whether nobody may look at it before the end."""
        return bool(self.labels.get("held_back", False))


def models(folders: Sequence[Path], labels: Path = LABELS) -> list[Model]:
    """All labelled models that have the roles of a library type, the CAD of each where it is found."""
    found = []
    for file in (*sorted(labels.glob("*.json")), *sorted(SHARED.glob("**/*.truth.json"))):
        name = file.name.removesuffix(".json").removesuffix(".truth")
        document = json.loads(file.read_text(encoding="utf-8"))
        if isinstance(document["parts"], list) and name not in LINKS:
            continue
        if isinstance(document["parts"], dict) and not all(isinstance(v, dict) for v in document["parts"].values()):
            continue
        beside = [p for p in sorted(file.parent.glob(f"{name}.*")) if p.suffix not in NO_CAD]
        if document.get("template", "excavator") is None:
            continue
        found.append(Model(name, document, beside[0] if beside else _cad(name, folders)))
    return found


def _cad(name: str, folders: Sequence[Path]) -> Path | None:
    """A model's file, built or fetched; else its folder, or the one file in it."""
    for folder in folders:
        there = sorted(folder.rglob(f"{name}*")) if folder.is_dir() else []
        files = [p for p in there if p.is_file() and p.stem == name and p.suffix not in NO_CAD]
        if files:
            return files[0]
        for found in (p for p in there if p.is_dir() and p.name == name):
            source = found / "source" if (found / "source").is_dir() else found
            files = sorted(p for p in source.rglob("*") if p.is_file() and p.suffix not in NO_CAD)
            if files:
                return files[0] if len(files) == 1 else source
    return None


def scene_of(model: Model, *, names: str) -> Scene:
    """A model as `yellowiron align` reads it, its names as they are (`with`) or taken away (`without`), and its truth.
    `ValueError` if it is not on this machine."""
    if model.cad is None:
        raise ValueError(f"{model.name} is not on this machine")
    assembly = read_cad(model.cad)
    template = load_template(model.labels.get("template", "excavator"))
    entries = list(_entries(model, assembly, template))
    truth = _surface(assembly, entries)
    joints = tuple(_joints(model, template))
    height = float(np.ptp(truth.points @ upright_of(model, joints)))
    if names == "without":
        renamed = nameless(assembly)
        ids = {old.id: new.id for old, new in zip(assembly.parts, renamed.parts, strict=True)}
        truth = replace(truth, whole={ids[i]: n for i, n in truth.whole.items()})
        assembly = renamed
    return Scene(assembly, truth, joints, height, template.equipment_type)


def upright_of(model: Model, joints: Sequence[TrueJoint]) -> np.ndarray:
    """The direction upwards: the label's, else that of the joint on which the upperstructure turns, else Z."""
    frame = model.labels.get("frame")
    if isinstance(frame, dict):
        return np.array(frame["up"], dtype=np.float64)
    swing = [j for j in joints if set(j.bodies) == {"undercarriage", "upperstructure"}]
    return np.array(swing[0].axis if swing else (0.0, 0.0, 1.0))


def nameless(assembly: Assembly) -> Assembly:
    """The assembly without the names of its parts and of its tree, whose shape is kept."""
    count = itertools.count(1)
    nodes: dict[tuple[str, ...], str] = {}
    parts = []
    for number, part in enumerate(assembly.parts):
        for depth in range(1, len(part.path) + 1):
            nodes.setdefault(part.path[:depth], f"Node_{next(count):03d}")
        path = tuple(nodes[part.path[:depth]] for depth in range(1, len(part.path) + 1))
        name = f"Object_{number:03d}"
        parts.append(replace(part, id="/".join((*path, name)), name=name, path=path))
    return replace(assembly, parts=tuple(parts))


@dataclass(frozen=True)
class _Entry:
    """The label of one part: `bodies`, the best first; none: nobody knows."""

    part: Part
    role: str
    bodies: tuple[str, ...]
    tied: str | None
    fused: tuple[Mapping[str, Any], ...]


def _entries(model: Model, assembly: Assembly, template: Template) -> Iterator[_Entry]:
    known = model.labels["parts"]
    if isinstance(known, list):
        links = LINKS[model.name]
        known = {e["node"]: {"role": links.get(e["link"], ""), "body": links.get(e["link"], "")} for e in known}
    of_name: dict[str, list[str]] = {}
    for key in known:
        of_name.setdefault(key.rpartition("/")[2], []).append(key)
    merged = _merged(known)
    for part in assembly.parts:
        keys = [part.id] if part.id in known else of_name.get(part.name, [])
        if len(keys) != 1:
            yield _Entry(part, "", (), None, ())
            continue
        label = known[keys[0]]
        body = label["body"]
        bodies = ("-" if body is None else body, *label.get("alternatives", ()))
        bodies = () if label.get("flexible") or (not body and body is not None) else bodies
        expanded = tuple(
            dict.fromkeys(b for name in bodies for b in (*_bodies(name, template), *_as_one(name, merged)))
        )
        yield _Entry(part, label.get("role", ""), expanded, label.get("with"), tuple(label.get("fused", ())))


def _merged(parts: Mapping[str, Mapping[str, Any]]) -> frozenset[str]:
    """Bodies without their side, of which left and right are shells of one mesh: as drawn, they are one."""
    return frozenset(
        _SIDE.sub("", entry["body"])
        for entry in parts.values()
        for shell in entry.get("fused", ())
        if entry["body"]
        and entry["body"] != shell["body"]
        and _SIDE.sub("", entry["body"]) == _SIDE.sub("", shell["body"])
    )


def _as_one(name: str | None, merged: Collection[str]) -> tuple[str, ...]:
    plain = _SIDE.sub("", name or "")
    return (plain,) if plain in merged else ()


def _bodies(name: str | None, template: Template) -> tuple[str, ...]:
    """What the template calls a label's body: without the number in a row; a twin that it has but once by both."""
    if name is None:
        return ("-",)
    name = _unnumbered(name)
    known = {r.name for r in template.roles}
    plain = re.sub(r"_[lr]$", "", name)
    return (plain, name) if name not in known and plain in known else (name,)


def _surface(assembly: Assembly, entries: Sequence[_Entry]) -> Surface:
    """Where which body's surface is; shells of a mesh that are of other bodies by themselves."""
    points, areas, label = [], [], []
    labels: list[tuple[str, str]] = []
    whole: dict[str, tuple[int, ...]] = {}
    numbers: dict[str, int] = {}
    for entry in entries:
        mesh = Mesh(assembly.points_of(entry.part), assembly.shape_of(entry.part).mesh.triangles)
        centres, sizes = centres_of(mesh)
        points.append(centres)
        areas.append(sizes)
        number = len(labels)
        numbers[entry.part.name] = numbers[entry.part.id] = number
        labels.append((entry.role, "|".join(entry.bodies)))
        own = np.full(len(sizes), number)
        if entry.fused:
            first = len(labels)
            for shell, rows in enumerate(_shells(mesh)):
                bodies = _fused(entry, mesh, assembly.shape_of(entry.part).mesh, rows)
                if bodies and bodies != entry.bodies[:1]:
                    own[rows] = len(labels)
                    labels.append((f"{entry.role} shell {shell}", "|".join(bodies)))
            whole[entry.part.id] = (number, *range(first, len(labels)))
        label.append(own)
    ties = {numbers[e.part.id]: numbers[e.tied] for e in entries if e.tied in numbers}
    return Surface(np.concatenate(points), np.concatenate(areas), np.concatenate(label), tuple(labels), whole, ties)


def _shells(mesh: Mesh) -> list[np.ndarray]:
    label = components(mesh, measures.welded(mesh))
    return [np.flatnonzero(label == k) for k in np.unique(label)]


def _fused(entry: _Entry, mesh: Mesh, own: Mesh, rows: np.ndarray) -> tuple[str, ...]:
    """The bodies of a shell, the best first, by its box in the file's frame or in the mesh's own, or by the side it is
    on; none: not told."""
    for told in entry.fused:
        if "half_space" in told:
            place = told["half_space"]
            middle = mesh.points[mesh.triangles[rows]].mean(axis=(0, 1))
            if (middle - np.array(place["point"])) @ np.array(place["normal"]) > 0.0:
                return _told(told)
            continue
        for points in (mesh.points[mesh.triangles[rows]], own.points[own.triangles[rows]]):
            low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
            box = np.array([told["centre"], told["extent"]])
            size = max(float(np.linalg.norm(box[1])), 1e-9)
            if np.abs(np.array([0.5 * (low + high), high - low]) - box).max() < SAME_BOX * size:
                return _told(told)
    return ()


def _told(shell: Mapping[str, Any]) -> tuple[str, ...]:
    return tuple(_unnumbered(body) for body in (shell["body"], *shell.get("alternatives", ())))


def _unnumbered(body: str) -> str:
    """A body as the template calls it, without its number in a row."""
    plain = re.sub(r"\[.*\]$", "", body)
    return BODIES.get(plain, plain)


def _joints(model: Model, template: Template) -> Iterator[TrueJoint]:
    """The joints that the labels locate, those along tracks and of wheels under them apart."""
    known = model.labels["joints"]
    rows = [{"name": n, **j} for n, j in known.items()] if isinstance(known, dict) else known
    links = LINKS.get(model.name)
    merged = _merged(model.labels["parts"]) if isinstance(model.labels["parts"], dict) else frozenset()
    for joint in rows:
        parent, child = joint["parent"], joint["child"]
        if links is not None:
            if parent not in links or child not in links:
                continue
            parent, child = links[parent], links[child]
        bodies = [_bodies(b, template) for b in (parent, child)]
        if any(b[0].startswith(ALONG_TRACKS) for b in bodies):
            continue
        if joint["type"] == "fixed" and links is None:
            continue
        more = [
            (*(b for n in joint.get(f"alternatives_{end}", ()) for b in _bodies(n, template)), *_as_one(body, merged))
            for end, body in (("parent", parent), ("child", child))
        ]
        axis = np.array(joint["axis"], dtype=np.float64)
        axis /= np.linalg.norm(axis)
        yield TrueJoint(
            joint["name"],
            "prismatic" if joint["type"] == "prismatic" else "revolute",
            (bodies[0][0], bodies[1][0]),
            tuple(float(v) for v in joint.get("anchor", joint.get("xyz"))),
            tuple(axis.tolist()),
            others=((*bodies[0][1:], *more[0]), (*bodies[1][1:], *more[1])),
            tolerance=joint.get("tolerance"),
            degrees=float(joint.get("tolerance_deg", 0.0)),
        )
