"""The user's own documents (`--data`): the conference paper's JSON-1 to JSON-4, a filled joint template, or sensors.

A document is known by its content. Its names are roles or CAD part names, in which `*` stands for any text; case, `_`,
`-` and spaces do not count; relations also take a part's id, where several parts have one name.

Findings: DOC001, a name matches nothing; DOC002, a joint names a part whose body is not known; DOC003, a document says
nothing; DOC004, what a relation leads from is no body.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.library.notation.role_keys import EVERYTHING, matches
from yellowiron.library.notation.validated_json import Document, check_document, near, read_json, template_schema, where
from yellowiron.library.parsing.axes import read_axis
from yellowiron.library.parsing.joints import check_bodies, read_joint, resolve_leaders
from yellowiron.library.parsing.materials import read_material
from yellowiron.library.parsing.sensors import read_sensor
from yellowiron.library.parsing.variants import check_choices
from yellowiron.model.alignment import DECIDED, Alignment, PartAssignment, Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import TemplateError
from yellowiron.model.finding import Finding
from yellowiron.model.rows import split_index
from yellowiron.model.sensor import SensorTemplate
from yellowiron.model.specification import fold
from yellowiron.model.template import JointTemplate, Material, Template

_KINDS = (
    "materials (density, color …), collision (texts), relations (lists), joints (joint_type, Body …) or sensors "
    "(type, mount …)"
)

_NEW_BODY = (
    "A new body goes, as a rigid body, into hierarchy.json of a template of your own (`yellowiron templates copy`), "
    "its joint into joints.json; the CAD model must show the pin or the bores it turns on."
)
_ENTRIES = (("materials", "material"), ("joint_overrides", "joint"), ("sensors", "sensor"))
"""Documents of objects, and their schema's word for one."""
_ESTIMATED = ("ALN016",)
"""Findings on axes that were guessed."""
_AFTER = {"joint_overrides": 1, "sensors": 2}
"""Relations are read before joints, which name what follows, and joints before the sensors on them."""


@dataclass(frozen=True)
class Follower:
    """A CAD part that a relations document moves with a body: the role it plays is `role` (the body's own, or the pin's
    whose name it has)."""

    part: str
    role: str
    body: str
    source: str


@dataclass(frozen=True)
class Documents:
    """What the user's documents say. `materials` and `collision` by role or CAD part name as spelled in the template or
    the CAD model (or `*`); `relations` body → followers (CAD part names or roles); `joints` by name, merged with the
    template's; `folders` those of the documents, in which textures are looked for; `sensors` by name,
    merged likewise; `axes`, joint → a point (metres) and a unit vector, CAD frame, of those that say where they are."""

    materials: Mapping[str, Material] = field(default_factory=dict)
    collision: Mapping[str, str] = field(default_factory=dict)
    relations: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    joints: Mapping[str, JointTemplate] = field(default_factory=dict)
    followers: tuple[Follower, ...] = ()
    folders: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()
    sensors: Mapping[str, SensorTemplate] = field(default_factory=dict)
    axes: Mapping[str, tuple[Vector, Vector]] = field(default_factory=dict)


def load_documents(
    paths: Sequence[str | Path],
    template: Template,
    assembly: Assembly | None = None,
    *,
    joints: tuple[Path, Mapping[str, object]] | None = None,
) -> Documents:
    """The documents of `--data`, later ones winning, and last the `joints` of an alignment file. Without an assembly
    only roles can be named.

    `TemplateError` for a file that is none of the documents, or that fails its schema.
    """
    reader = _Reader(template, assembly)
    documents = []
    for path, kind, document in _checked(paths, joints):
        if document is None:
            reader.find("DOC003", path, (), "The document says nothing.", "Remove it, or fill it.")
        else:
            documents.append((kind, document))
    for kind, document in sorted(documents, key=lambda d: _AFTER.get(d[0], 0)):
        reader.read(kind, document)
    return Documents(
        materials=reader.materials,
        collision=reader.collision,
        relations={leader: tuple(names) for leader, names in reader.relations.items()},
        joints=reader.led(),
        followers=tuple(reader.followers.values()),
        folders=tuple(dict.fromkeys(str(Path(p).parent) for p in paths)),
        findings=tuple(dict.fromkeys(reader.findings)),
        sensors=reader.sensors,
        axes=reader.axes,
    )


def check_documents(paths: Sequence[str | Path]) -> None:
    """What `load_documents` says against documents before any name in them is looked up: `TemplateError`."""
    list(_checked(paths, None))


def _checked(
    paths: Sequence[str | Path], joints: tuple[Path, Mapping[str, object]] | None
) -> Iterator[tuple[Path, str, Document | None]]:
    """Every document as its schema has it, with its path and kind; None where it is empty."""
    contents = [(path, read_json(path)) for path in map(Path, paths)]
    contents += [(joints[0], dict(joints[1]))] if joints is not None and joints[1] else []
    for path, content in contents:
        kind = kind_of(content, path)
        yield path, kind or "", None if kind is None else check_document(path, content, kind)


def kind_of(content: Any, path: Path) -> str | None:
    """Which of the documents a content is (the name of its schema), None where it is empty. `TemplateError` for
    anything else."""
    values = list(content.values()) if isinstance(content, dict) else None
    if values is not None and not values:
        return None
    if values is not None:
        if all(isinstance(v, str) for v in values):
            return "collision"
        if all(isinstance(v, list) for v in values):
            return "relations"
        if all(isinstance(v, dict) for v in values):
            keys = {fold(k) for v in values for k in v}
            known = {
                kind: keys & {fold(k) for k in template_schema(kind)["$defs"][entry]["properties"]}
                for kind, entry in _ENTRIES
            }
            best = max(known, key=lambda kind: len(known[kind]))
            if known[best]:
                return best
    raise TemplateError("The document is none that --data knows", where=str(path), hint=f"It takes {_KINDS}.")


def apply_joints(template: Template, documents: Documents) -> Template:
    """The template with the documents' joints: theirs replace those of the same name, new ones come after."""
    joints = [documents.joints.get(j.name, j) for j in template.joints]
    known = {j.name for j in template.joints}
    joints += [j for name, j in documents.joints.items() if name not in known]
    return replace(template, joints=tuple(joints))


def apply_sensors(template: Template, documents: Documents) -> Template:
    """The template with the documents' sensors: theirs replace those of the same name, new ones come after."""
    sensors = [documents.sensors.get(s.name, s) for s in template.sensors]
    known = {s.name for s in template.sensors}
    sensors += [s for name, s in documents.sensors.items() if name not in known]
    return replace(template, sensors=tuple(sensors))


def with_relations(edits: Alignment | None, documents: Documents) -> Alignment | None:
    """A person's alignment edits together with what relations documents say of CAD parts; the edits win."""
    if not documents.followers:
        return edits
    edits = edits or Alignment(equipment_type="", frame=np.eye(4), parts=())
    settled = {a.part for a in edits.parts if a.source in DECIDED - {"data", "rule"}}
    said = {
        f.part: PartAssignment(f.part, f.role, f.body, 1.0, f.source, source="data")
        for f in documents.followers
        if f.part not in settled
    }
    return replace(edits, parts=(*(a for a in edits.parts if a.part not in said), *said.values()))


def with_axes(alignment: Alignment, documents: Documents) -> Alignment:
    """The alignment with the axes that documents give: they are not estimated any more, nor moved to suit the sheet."""
    given = documents.axes
    if not given:
        return alignment
    return replace(
        alignment,
        axes={**alignment.axes, **given},
        across={joint: by for joint, by in alignment.across.items() if joint not in given},
        findings=tuple(f for f in alignment.findings if f.code not in _ESTIMATED or f.where not in given),
        by_hand=alignment.by_hand | given.keys(),
    )


def _signed(joint: JointTemplate, known: JointTemplate | None, document: str) -> JointTemplate:
    """The joint with the document's name at what it says otherwise than the joint known before."""
    said = {
        "joint": known is None or (joint.type, joint.parts) != (known.type, known.parts),
        "limit": (joint.lower, joint.upper) != ((known.lower, known.upper) if known else (None, None)),
    }
    return replace(joint, documents={**joint.documents, **{key: document for key, new in said.items() if new}})


class _Reader:
    """What the documents say so far, and what the names in them can mean."""

    def __init__(self, template: Template, assembly: Assembly | None) -> None:
        self.template = template
        self.roles = {fold(r.name): r.name for r in template.roles}
        self.parts: dict[str, list[tuple[str, str]]] = {}
        for part in assembly.parts if assembly is not None else ():
            self.parts.setdefault(fold(part.name), []).append((part.name, part.id))
        self.materials: dict[str, Material] = {}
        self.collision: dict[str, str] = {}
        self.relations: dict[str, list[str]] = {}
        self.joints: dict[str, JointTemplate] = {}
        self.sensors: dict[str, SensorTemplate] = {}
        self.said: dict[str, Document] = {}
        self.axes: dict[str, tuple[Vector, Vector]] = {}
        self.followers: dict[str, Follower] = {}
        self.findings: list[Finding] = []

    def find(self, code: str, document: Path, keys: Sequence[object], message: str, hint: str) -> None:
        # The file's name without its folder: reports are the same wherever a build runs.
        self.findings.append(Finding(code, "warning", where(Path(document.name), keys), message, hint))

    def read(self, kind: str, document: Document) -> None:
        if kind == "materials":
            for key, entry in document.data.items():
                # What a person states of a part's look replaces what the CAD file shows.
                material = replace(read_material(document, key, entry), repaint=True)
                self.materials.update(dict.fromkeys(self.names(key, document), material))
        elif kind == "collision":
            for key, token in document.data.items():
                self.collision.update(dict.fromkeys(self.names(key, document), token))
        elif kind == "relations":
            self.read_relations(document)
        elif kind == "joint_overrides":
            for name, entry in document.data.items():
                self.read_joint(document, name, entry)
        else:
            self.read_sensors(document)

    def names(self, key: str, document: Document) -> list[str]:
        """The role and CAD part names that a key stands for."""
        if key == EVERYTHING:
            return [EVERYTHING]
        if EVERYTHING in key:
            spelled = [*self.roles.values(), *(found[0][0] for found in self.parts.values())]
            names = [name for name in spelled if matches(name, key)]
        else:
            names = [self.roles[fold(key)]] if fold(key) in self.roles else []
            names += [name for name, _ in self.parts.get(fold(key), ())[:1]]
        if not names:
            message = f"'{key}' is neither a role nor a part of the CAD model."
            self.find("DOC001", document.path, (key,), message, self.near(key))
        return list(dict.fromkeys(names))

    def near(self, name: str) -> str:
        return near(name, [*self.roles.values(), *(found[0][0] for found in self.parts.values())])

    # ---- relations --------------------------------------------------------------------------------------------------
    def read_relations(self, document: Document) -> None:
        """Leaders are bodies, or followers of bodies that lead others."""
        waiting: dict[str, list[str]] = {leader: list(names) for leader, names in document.data.items()}
        while waiting:
            ready = [leader for leader in waiting if self.leader(leader) is not None]
            for leader in ready or list(waiting):
                body = self.leader(leader)
                names = waiting.pop(leader)
                if body is None:
                    message = (
                        f"'{leader}' leads others and is no body of the template, to which a document can add none: "
                        "what follows it stays where the alignment puts it."
                    )
                    hint = f"{near(leader, self.roles.values())} {_NEW_BODY}".strip()
                    self.find("DOC004", document.path, (leader,), message, hint)
                else:
                    for index, name in enumerate(names):
                        self.follow(name, body, document.path, (leader, index))

    def leader(self, name: str) -> str | None:
        """The body that a leader's name stands for."""
        if fold(name) in self.roles:
            return self.template.body_of(self.roles[fold(name)])
        return next((self.followers[i].body for _, i in self.parts.get(fold(name), ()) if i in self.followers), None)

    def follow(self, name: str, body: str, document: Path, keys: tuple[str, int]) -> None:
        """Moves what a follower's name stands for with a body: CAD parts by name, pattern or id; else a role."""
        role = self.roles.get(fold(name))
        stays = role if role is not None and self.template.body_of(role) == body else None
        parts = self.placed(name)
        if not parts and stays is None:
            self.find("DOC001", document, keys, f"'{name}' is no part of the CAD model.", self.near(name))
            return
        names = [part for part, _ in parts] or [stays or body]
        self.relations[body] = list(dict.fromkeys([*self.relations.get(body, ()), *names]))
        source = f"{document.name}: follows '{keys[0]}'"
        for _, part in parts:
            self.followers[part] = Follower(part, stays or body, body, source)

    def placed(self, name: str) -> list[tuple[str, str]]:
        """(name, id) of the CAD parts that a name, a pattern or an id stands for."""
        if EVERYTHING in name:
            return [part for found in self.parts.values() for part in found if matches(part[0], name)]
        return self.parts.get(fold(name)) or [
            part for found in self.parts.values() for part in found if fold(part[1]) == fold(name)
        ]

    # ---- sensors ---------------------------------------------------------------------------------------------------
    def read_sensors(self, document: Document) -> None:
        base = {fold(s.name): s for s in (*self.template.sensors, *self.sensors.values())}
        joints = {j.name: j for j in (*self.template.joints, *self.joints.values())}
        template = replace(self.template, joints=tuple(joints.values()))
        for name, entry in document.data.items():
            sensor = read_sensor(document, name, entry, template, base.get(fold(name)))
            check_choices(sensor.when, template.variants, document.at(name, "when"))
            self.sensors[sensor.name] = sensor

    # ---- joints -----------------------------------------------------------------------------------------------------
    def read_joint(self, document: Document, name: str, entry: Mapping[str, Any]) -> None:
        base = {fold(j.name): j for j in self.template.joints} | {fold(n): j for n, j in self.joints.items()}
        known = base.get(fold(name))
        joint = read_joint(document, known.name if known else name, entry, known)
        if "Body" in entry:
            parts = [self.role_of(part) for part in joint.parts]
            for part, role in zip(joint.parts, parts, strict=True):
                if role is None:
                    message = f"Which body '{part}' moves with is not known; the joint is left out."
                    close = "" if fold(part) in self.parts else self.near(part)
                    hint = f"{close or 'Say it in a relations document, under a body of the template.'} {_NEW_BODY}"
                    self.find("DOC002", document.path, (name, "Body"), message, hint)
            if parts[0] is None or parts[1] is None:
                return
            joint = replace(joint, parts=(parts[0], parts[1]))
            check_bodies(joint, self.template.bodies_of(joint), document.at(name, "Body"))
        axis = read_axis(document, name, entry, joint.type)
        if axis is not None:
            self.axes[joint.name] = axis
        joint = _signed(joint, known, document.path.name)
        self.said[joint.name] = document
        said = {"axis": document.path.name} if axis is not None else {}
        self.joints[joint.name] = replace(joint, documents={**joint.documents, **said})

    def led(self) -> dict[str, JointTemplate]:
        """The documents' joints, the leaders of those that follow looked up among all joints."""
        every = {j.name: j for j in self.template.joints} | self.joints
        unknown = Document(Path("joints.json"), {})
        found = resolve_leaders(
            tuple(every.values()), lambda name, *keys: self.said.get(str(name), unknown).at(name, *keys)
        )
        return {j.name: j for j in found if j.name in self.joints}

    def role_of(self, part: str) -> str | None:
        """The role that a joint's part stands for: its own name, or the body it follows."""
        name, index = split_index(part)
        if fold(name) in self.roles:
            return f"{self.roles[fold(name)]}[{index}]" if index else self.roles[fold(name)]
        return next((self.followers[i].role for _, i in self.parts.get(fold(name), ()) if i in self.followers), None)
