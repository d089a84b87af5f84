"""A folder of CAD files to one `Assembly`, every file where its own coordinates put it. Runs in the guard's child
process.

Files that another file of the folder names (an assembly's parts, a robot's meshes) are read with that one. Formats
without a unit get one for all of them, guessed from the whole: a single bolt would be taken for metres.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from pkgutil import resolve_name

import numpy as np

from yellowiron.cad.appearance.looks import Dressed
from yellowiron.cad.formats import CadFormat, NoReaderError, others
from yellowiron.cad.mesh.assembly import Occurrence, assemble, guessed_unit
from yellowiron.cad.naming import decode_name, is_generic, unique_ids
from yellowiron.cad.recognition import format_of
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding

_MOST = 5000
"""Files of a folder."""
_LARGEST_TEXT = 64 * 1024**2
"""Bytes of a file that is looked through for the names of others."""


def read_folder(path: str) -> Assembly:
    """The assembly in all CAD files of a folder and those below. `CadError` if it holds none that is readable, or one
    of them is damaged."""
    folder = Path(path)
    known, findings = _known(folder)
    named = _referred(list(known))
    files = {file: one for file, one in known.items() if file not in named}
    loose = {file: one for file, one in files.items() if one.meshes}
    read = [_loose(loose, folder)] if loose else []
    for file, one in files.items():
        if not one.meshes:
            assembly: Assembly = resolve_name(one.reader)(str(file))
            read.append(_below(assembly, _names(file, folder)))
    if not read:
        words = "The folder holds no CAD file that is readable"
        raise CadError(words, where=path, hint="Name the file itself; docs/cad-files.md lists the formats.")
    return _joined(read, folder, findings)


def _known(folder: Path) -> tuple[dict[Path, CadFormat], list[Finding]]:
    """The folder's readable CAD files with their formats, and remarks about those that are not."""
    known: dict[Path, CadFormat] = {}
    findings = []
    found = sorted(f for f in folder.rglob("*") if f.is_file() and f.resolve().is_relative_to(folder.resolve()))
    if len(found) > _MOST:
        words = f"The folder holds {len(found)} files, more than {_MOST}"
        raise CadError(words, where=str(folder), hint="Name the folder with the machine's own files.")
    for file in found:
        try:
            one = format_of(file)
            if one.needs:
                resolve_name(one.needs)(str(file))
            known[file] = one
        except NoReaderError as error:
            findings.append(Finding("CAD008", "warning", str(file), error.message, error.hint))
        except CadError:
            continue
    # A broken package matters where a file may be of its format.
    return known, [*findings, *(others()[1] if len(known) < len(found) else ())]


def _referred(files: Sequence[Path]) -> set[Path]:
    """The files whose names stand in another one."""
    named = set()
    texts = {f: f.read_bytes() for f in files if f.stat().st_size <= _LARGEST_TEXT}
    for file in files:
        name = file.name.encode()
        if any(name in text for other, text in texts.items() if other != file and other.suffix.lower() != ".obj"):
            named.add(file)
    # Two files that name each other are not both left out.
    return named if len(named) < len(files) else set()


def _names(file: Path, folder: Path) -> tuple[str, ...]:
    parts = file.relative_to(folder).with_suffix("").parts
    return tuple(decode_name(p, "utf-8") for p in parts)


def _loose(files: Mapping[Path, CadFormat], folder: Path) -> Assembly:
    """Files of triangles without a unit, each piece a part."""
    raw: list[tuple[tuple[str, ...], str, Dressed]] = []
    findings: list[Finding] = []
    for file, known in files.items():
        names = _names(file, folder)
        raw += [(names, name, dressed) for name, dressed in resolve_name(known.meshes)(file, findings)]
    unit, remarks = guessed_unit([one.mesh.points for _, _, one in raw], str(folder))
    findings += remarks
    occurrences = []
    for names, name, one in raw:
        scaled = replace(one.mesh, points=one.mesh.points * unit)
        above, title = (names, name) if name and not is_generic(name) else (names[:-1], names[-1])
        occurrences.append(Occurrence(title, above, scaled, np.eye(4), one.color, one.finishes))
    return assemble(
        occurrences, name=folder.name, format="folder", unit=unit, path=str(folder), findings=findings,
        declared=len(occurrences),
    )  # fmt: skip


def _below(assembly: Assembly, names: tuple[str, ...]) -> Assembly:
    """An assembly whose parts hang below its file's name; a single part is called by it if nothing else."""
    if len(assembly.parts) == 1:
        part = assembly.parts[0]
        title = names[-1] if is_generic(part.name) else part.name
        return replace(assembly, parts=(replace(part, name=title, path=(*names[:-1], *part.path)),))
    return replace(assembly, parts=tuple(replace(p, path=(*names, *p.path)) for p in assembly.parts))


def _joined(read: Sequence[Assembly], folder: Path, findings: Sequence[Finding]) -> Assembly:
    starts = [sum(len(other.nodes) for other in read[:k]) for k in range(len(read))]
    parts = [
        part if part.node is None else replace(part, node=part.node + start)
        for assembly, start in zip(read, starts, strict=True)
        for part in assembly.parts
    ]
    nodes = (
        node if node.parent is None else replace(node, parent=node.parent + start)
        for assembly, start in zip(read, starts, strict=True)
        for node in assembly.nodes
    )
    ids = unique_ids((*part.path, part.name) for part in parts)
    declared = [a.declared_occurrences for a in read]
    return Assembly(
        name=folder.resolve().name,
        format=read[0].format if len({a.format for a in read}) == 1 else "folder",
        unit=read[0].unit,
        parts=tuple(replace(part, id=id) for id, part in zip(ids, parts, strict=True)),
        shapes={key: shape for assembly in read for key, shape in assembly.shapes.items()},
        findings=tuple(dict.fromkeys([*findings, *(f for a in read for f in a.findings)])),
        declared_occurrences=sum(d for d in declared if d is not None) if None not in declared else None,
        joints=tuple(joint for assembly in read for joint in assembly.joints),
        nodes=tuple(nodes),
    )
