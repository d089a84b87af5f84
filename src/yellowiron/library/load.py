"""Templates from their folders: the library's own, a user's, or a printed joint template alone."""

from __future__ import annotations

import importlib.resources
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from yellowiron.library.parsing import details
from yellowiron.library.parsing.hierarchy import read_hierarchy, read_relations, root_of
from yellowiron.library.parsing.implied_hierarchy import infer_actuators, infer_roles
from yellowiron.library.parsing.joints import check_bodies, read_joints, resolve_parts
from yellowiron.library.parsing.json_documents import Document, near, read_document
from yellowiron.library.parsing.machine_tests import read_tests
from yellowiron.library.parsing.sensors import read_sensors
from yellowiron.library.parsing.words import read_words
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import JointTemplate, Role, Template

DOCUMENTS = (
    "hierarchy",
    "relations",
    "joints",
    "variants",
    "materials",
    "collision",
    "wanted",
    "actuators",
    "measurements",
    "tests",
    "reference",
    "sensors",
    "words",
)
"""The documents a template folder can have, each `<name>.json`; only `joints` is needed."""
_MACHINE = "machine"


def library_folder() -> Path:
    """Where the package keeps its templates."""
    return Path(str(importlib.resources.files("yellowiron.library"))) / "data"


def list_templates() -> tuple[str, ...]:
    """The equipment types of the library, sorted; those that `is_sheet_only` too."""
    kinds = ("joints.json", "wanted.json")
    return tuple(sorted(p.name for p in library_folder().iterdir() if any((p / kind).is_file() for kind in kinds)))


def is_sheet_only(equipment_type: str) -> bool:
    """Whether the library knows of a type only what to ask a sheet for: it can be extracted, not built."""
    return not (library_folder() / equipment_type / "joints.json").is_file()


def load_template(type_or_folder: str | Path, *, sheet_only: bool = False) -> Template:
    """The template of a library type, of a folder, or of one `joints.json` (the journal paper's Fig. A1 as printed).

    A bare name is a library type first; write `./name` for a folder that has a type's name. All variants are in the
    template that comes back; `model.template.choose` decides them. With `sheet_only`, a folder that has a `wanted.json`
    and no joints will do: it says what to ask a sheet for. `TemplateError` names file and key of what is wrong.
    """
    folder = find_template(type_or_folder)
    if folder.is_file():
        return _assemble({"joints": read_document(folder, "joints")}, folder)
    paths = _documents_in(folder)
    if "joints" not in paths and "wanted" in paths:
        if sheet_only:
            wanted = details.read_wanted(read_document(paths["wanted"], "wanted"), ())
            return Template(folder.resolve().name, str(folder), "", (), (), wanted=wanted)
        raise TemplateError(
            f"Of a {folder.resolve().name.replace('_', ' ')} only the sheet can be read so far: "
            "its template has no bodies and joints to build from",
            where=str(folder),
            hint="Use `yellowiron extract`, or begin a template with `yellowiron templates new --from CAD`.",
        )
    if "joints" not in paths:
        raise TemplateError(
            "The folder is no template: it has no joints.json",
            where=str(folder),
            hint="Begin with `yellowiron templates copy TYPE FOLDER`.",
        )
    return _assemble({kind: read_document(path, kind) for kind, path in paths.items()}, folder)


def find_template(type_or_folder: str | Path) -> Path:
    """The folder (or lone joint template) that a type or path stands for. `TemplateError` if there is none."""
    text = str(type_or_folder)
    path = Path(type_or_folder)
    if len(path.parts) == 1 and not text.startswith("."):
        for name in list_templates():
            if fold(name) == fold(text):
                return library_folder() / name
    if path.is_dir() or (path.is_file() and path.suffix.lower() == ".json"):
        return path
    if path.is_file():
        raise TemplateError(
            "The file is no template", where=text, hint="Give a template folder, a joints.json, or a library type."
        )
    known = list_templates()
    hint = near(text, known)
    raise TemplateError(
        f"There is no equipment type or template folder '{text}'",
        where=text,
        hint=f"{hint} The library has: {', '.join(known)}.".strip(),
    )


def _documents_in(folder: Path) -> dict[str, Path]:
    """The folder's documents by kind. A lone file that is named otherwise is its joint template."""
    files = sorted(p for p in folder.iterdir() if p.is_file() and p.suffix.lower() == ".json")
    found = {kind: path for kind in DOCUMENTS for path in files if fold(path.stem) == kind}
    if not found and len(files) == 1:
        return {"joints": files[0]}
    for path in files:
        # A misspelled document would be left out without a word.
        meant = near(path.stem, DOCUMENTS, at_least=0.85)
        if meant and fold(path.stem) not in DOCUMENTS:
            raise TemplateError(f"'{path.name}' is no document of a template", where=str(path), hint=meant)
    return found


def _assemble(documents: Mapping[str, Document], folder: Path) -> Template:
    """All documents as one template, every name resolved."""
    joints = read_joints(documents["joints"])
    alone = "hierarchy" not in documents and "relations" not in documents
    if alone:
        roles, joints, root = infer_roles(joints, documents["joints"])
    else:
        roles, root = _roles(documents, joints)
    variants = details.read_variants(documents["variants"]) if "variants" in documents else ()
    joints = _resolved(documents["joints"], joints, roles)

    template = Template(
        equipment_type=_equipment_type(roles, folder),
        folder=str(folder.parent if folder.is_file() else folder),
        root=root,
        roles=roles,
        joints=joints,
        variants=variants,
    )
    for joint in joints:
        check_bodies(joint, template.bodies_of(joint), documents["joints"].at(joint.name, "Body"))
    template = replace(template, **_further(documents, template))
    if not template.actuators:
        template = replace(template, actuators=infer_actuators(template))
    if "sensors" in documents:
        template = replace(template, sensors=read_sensors(documents["sensors"], template))
    _check_variants(template, documents)
    return template


def _roles(documents: Mapping[str, Document], joints: tuple[JointTemplate, ...]) -> tuple[tuple[Role, ...], str]:
    if "hierarchy" in documents:
        document = documents["hierarchy"]
        roles = read_hierarchy(document)
    else:
        document = documents["relations"]
        roles = read_relations(document, joints)
    root = root_of(roles)
    if root is None:
        raise TemplateError(
            "The hierarchy has no body", where=str(document.path), hint='Mark the bodies "rigid body": "Y".'
        )
    _check_rows(roles, document)
    return roles, root


def _check_rows(roles: tuple[Role, ...], document: Document) -> None:
    """What moves with a row's part is a row itself; a hidden row stands for one that is there."""
    rows = {r.name for r in roles if r.many}
    for role in roles:
        if role.parent in rows and not role.many:
            raise TemplateError(
                f"'{role.name}' moves with the row '{role.parent}' and is no row",
                where=document.at(role.name),
                hint=f"Write {role.name}[*]: one for each part of the row.",
            )
        if role.hidden and role.hidden["row"] not in rows:
            raise TemplateError(
                f"'{role.name}' stands for '{role.hidden['row']}', which is no row",
                where=document.at(role.name, "hidden", "row"),
                hint=near(role.hidden["row"], rows) or "Name a row, without [*].",
            )


def _resolved(
    document: Document, joints: tuple[JointTemplate, ...], roles: tuple[Role, ...]
) -> tuple[JointTemplate, ...]:
    by_name = {fold(r.name): r for r in roles}
    return tuple(resolve_parts(j, by_name, document.at(j.name, "Body")) for j in joints)


def _further(documents: Mapping[str, Document], template: Template) -> dict[str, Any]:
    """What the documents beside hierarchy, joints and variants say."""
    found: dict[str, Any] = {}
    if "materials" in documents:
        document = documents["materials"]
        entries = {key: details.read_material(document, key, entry) for key, entry in document.data.items()}
        found["materials"] = details.by_role(document, entries, template.roles)
    if "collision" in documents:
        document = documents["collision"]
        found["collision"] = details.by_role(document, document.data, template.roles)
    if "wanted" in documents:
        found["wanted"] = details.read_wanted(documents["wanted"], template.roles)
    if "actuators" in documents:
        found["actuators"] = details.read_actuators(documents["actuators"], template.joints)
    if "measurements" in documents:
        sites, measurements = details.read_measurements(documents["measurements"], template.roles, template.joints)
        found.update(sites=sites, measurements=measurements)
    if "tests" in documents:
        found["payload"], found["tests"] = read_tests(documents["tests"])
    if "words" in documents:
        found["words"] = read_words(documents["words"], template.roles)
    if "reference" in documents:
        found["reference"] = documents["reference"].data
    return found


def _check_variants(template: Template, documents: Mapping[str, Document]) -> None:
    """Every `when` names a declared variant and choice."""
    for role in template.roles:
        for key, choices in (("when", role.when), ("rigid_when", role.rigid_when)):
            if choices:
                details.check_choices(choices, template.variants, documents["hierarchy"].at(role.name, key))
    for joint in template.joints:
        place = documents["joints"].at(joint.name)
        details.check_choices({**joint.when}, template.variants, f"{place}.when")
        details.check_choices({**joint.drive_when}, template.variants, f"{place}.drive_when")
    for actuator in template.actuators:
        for cylinder in actuator.cylinders:
            if cylinder.when:
                place = documents["actuators"].at(actuator.name, "cylinders", "when")
                details.check_choices(cylinder.when, template.variants, place)
    for sensor in template.sensors:
        if sensor.when:
            place = documents["sensors"].at(sensor.name, "when")
            details.check_choices(sensor.when, template.variants, place)


def _equipment_type(roles: tuple[Role, ...], folder: Path) -> str:
    """The name of the group above everything, else the folder's or file's own name."""
    tops = [r for r in roles if r.parent is None]
    if len(tops) == 1 and not tops[0].rigid:
        return tops[0].name
    return folder.resolve().stem or _MACHINE
