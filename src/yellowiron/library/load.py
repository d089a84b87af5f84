"""Templates from their folders: the library's own, a user's, or a printed joint template alone."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from yellowiron.library.composing.documents import files_behind, template_documents
from yellowiron.library.notation.role_keys import by_role
from yellowiron.library.notation.validated_json import Document, near, read_document
from yellowiron.library.parsing.actuators import read_actuators
from yellowiron.library.parsing.hierarchy import read_hierarchy, read_relations, root_of
from yellowiron.library.parsing.implied_hierarchy import infer_actuators, infer_roles
from yellowiron.library.parsing.joints import (
    check_bodies,
    positions_chosen,
    read_joints,
    resolve_leaders,
    resolve_parts,
)
from yellowiron.library.parsing.machine_tests import read_tests
from yellowiron.library.parsing.materials import read_material
from yellowiron.library.parsing.measurements import read_measurements
from yellowiron.library.parsing.sensors import read_sensors
from yellowiron.library.parsing.usual import read_balance, read_hinges, read_shares, read_usual
from yellowiron.library.parsing.variants import check_choices, read_variants
from yellowiron.library.parsing.wanted import read_wanted
from yellowiron.library.parsing.words import read_words
from yellowiron.library.type_folders import BUILDS, documents_in, find_template
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.model.template import JointTemplate, Role, Template
from yellowiron.support.caching.disk import kept

_MACHINE = "machine"


def load_template(type_or_folder: str | Path, *, sheet_only: bool = False) -> Template:
    """The template of a library type, of a folder, or of one `joints.json` (the journal paper's Fig. A1 as printed).

    A bare name is a library type first; write `./name` for a folder that has a type's name. All variants are in the
    template that comes back; `model.template.choose` decides them. With `sheet_only`, a folder that has a `wanted.json`
    and no joints will do: it says what to ask a sheet for. `TemplateError` names file and key of what is wrong.
    """
    folder = find_template(type_or_folder)
    if folder.is_file():
        return _assemble({"joints": read_document(folder, "joints")}, folder)
    paths = documents_in(folder)
    builds = any(kind in paths for kind in BUILDS)
    if not builds and "wanted" in paths:
        if sheet_only:
            wanted = read_wanted(template_documents(folder)["wanted"], ())
            return Template(folder.resolve().name, str(folder), "", (), (), wanted=wanted)
        raise TemplateError(
            f"The type {folder.resolve().name} is sheet-only so far: its template says what to ask a sheet for and has "
            "no bodies and joints to build from",
            where=str(folder),
            hint="Use `yellowiron extract`, or begin a template with `yellowiron templates new --from CAD --out DIR`.",
        )
    if not builds:
        raise TemplateError(
            "The folder is no template: it has no joints.json",
            where=str(folder),
            hint="Begin with `yellowiron templates copy TYPE FOLDER`.",
        )
    seen = ((path, path.stat()) for path in files_behind(folder))
    return _read(folder, tuple((path, there.st_mtime_ns, there.st_size) for path, there in seen))


@functools.lru_cache(maxsize=16)
def _read(folder: Path, seen: tuple[tuple[Path, int, int], ...]) -> Template:
    """The template of a folder, once while all files behind it are as they were `seen`: when changed last, how
    large."""
    documents = template_documents(folder)
    if "joints" not in documents:
        raise TemplateError(
            "The template has no joints",
            where=str(folder / "modules.json"),
            hint="Use a module that brings some, or write a joints.json.",
        )
    return kept("templates", lambda: _assemble(documents, folder), documents, folder)


def _assemble(documents: Mapping[str, Document], folder: Path) -> Template:
    """All documents as one template, every name resolved."""
    joints = read_joints(documents["joints"])
    alone = "hierarchy" not in documents and "relations" not in documents
    if alone:
        roles, joints, root = infer_roles(joints, documents["joints"])
    else:
        roles, root = _roles(documents, joints)
    variants = read_variants(documents["variants"]) if "variants" in documents else ()
    joints = _resolved(documents["joints"], joints, roles)
    positions = positions_chosen(joints)
    if twice := {v.name for v in variants} & {v.name for v in positions}:
        raise TemplateError(
            f"A variant and a joint's positions are both called '{min(twice)}'",
            where=documents["joints"].at(f"{min(twice)}_joint", "positions"),
            hint="Give one of them another name.",
        )
    variants += positions

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
    joints = tuple(resolve_parts(j, by_name, document.at(j.name, "Body")) for j in joints)
    return resolve_leaders(joints, document.at)


def _further(documents: Mapping[str, Document], template: Template) -> dict[str, Any]:
    """What the documents beside hierarchy, joints and variants say."""
    found: dict[str, Any] = {}
    if "materials" in documents:
        document = documents["materials"]
        entries = {key: read_material(document, key, entry) for key, entry in document.data.items()}
        found["materials"] = by_role(document, entries, template.roles)
    if "collision" in documents:
        document = documents["collision"]
        found["collision"] = by_role(document, document.data, template.roles)
    if "wanted" in documents:
        found["wanted"] = read_wanted(documents["wanted"], template.roles)
    if "actuators" in documents:
        found["actuators"] = read_actuators(documents["actuators"], template.joints, template.roles)
    if "measurements" in documents:
        sites, measurements = read_measurements(documents["measurements"], template.roles, template.joints)
        found.update(sites=sites, measurements=measurements)
    if "tests" in documents:
        found["payload"], found["tests"] = read_tests(documents["tests"])
    if "words" in documents:
        found["words"] = read_words(documents["words"], template.roles)
    if "usual" in documents:
        found["usual"] = read_usual(documents["usual"], template.roles)
    if "hinges" in documents:
        found["hinges"] = read_hinges(documents["hinges"], found.get("actuators", template.actuators))
    if "shares" in documents:
        found["shares"] = read_shares(documents["shares"], template.roles)
    if "balance" in documents:
        found["balance"] = read_balance(documents["balance"], template.roles, found.get("wanted", template.wanted))
    return found


def _check_variants(template: Template, documents: Mapping[str, Document]) -> None:
    """Every `when` names a declared variant and choice."""
    for role in template.roles:
        for key, choices in (("when", role.when), ("rigid_when", role.rigid_when)):
            if choices:
                check_choices(choices, template.variants, documents["hierarchy"].at(role.name, key))
    for joint in template.joints:
        place = documents["joints"].at(joint.name)
        check_choices({**joint.when}, template.variants, f"{place}.when")
        check_choices({**joint.drive_when}, template.variants, f"{place}.drive_when")
        check_choices({**joint.rest_when}, template.variants, f"{place}.rest_when")
    for actuator in template.actuators:
        for cylinder in actuator.cylinders:
            if cylinder.when:
                place = documents["actuators"].at(actuator.name, "cylinders", "when")
                check_choices(cylinder.when, template.variants, place)
    for sensor in template.sensors:
        if sensor.when:
            place = documents["sensors"].at(sensor.name, "when")
            check_choices(sensor.when, template.variants, place)
    for site in template.sites:
        if site.when:
            check_choices(site.when, template.variants, documents["measurements"].at("sites", site.name, "when"))
    for number, measurement in enumerate(template.measurements):
        if measurement.when:
            place = documents["measurements"].at("measurements", number, "when")
            check_choices(measurement.when, template.variants, place)
    for wanted in template.wanted:
        if wanted.when:
            check_choices(wanted.when, template.variants, documents["wanted"].at(wanted.name, "when"))


def _equipment_type(roles: tuple[Role, ...], folder: Path) -> str:
    """The name of the group above everything, else the folder's or file's own name."""
    tops = [r for r in roles if r.parent is None]
    if len(tops) == 1 and not tops[0].rigid:
        return tops[0].name
    return folder.resolve().stem or _MACHINE
