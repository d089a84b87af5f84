"""A template from a machine: CAD model → the bodies and joints that geometry finds → the documents of a template."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from yellowiron import alignment, cad, library
from yellowiron.model.errors import OutputError
from yellowiron.model.specification import Specifications
from yellowiron.model.text import to_json
from yellowiron.support.output import output_folder


def new_template(
    cad_file: Path | str,
    out: Path | str | None = None,
    *,
    like: str | Path | None = None,
    progress: Callable[[str], None] = lambda words: None,
) -> dict[str, Any]:
    """Proposes a template for the machine of a CAD model and writes it to the folder `out`, which is new or empty
    (default: named after the CAD file, here). `like` is a library type, or a template folder, whose roles, names and
    limits are taken over where bodies match.

    Returns {folder, equipment_type, bodies: [{role, kind, parts, reason}], joints: [{name, type, bodies, point, axis,
    pins, reason}], findings}: points in metres and axes in the CAD file's frame; findings of the geometry, then of the
    template's lint. Raises `YellowironError` for unusable input and where nothing turns or slides, having written
    nothing.
    """
    cad_file = Path(cad_file)
    name = re.sub(r"\W+", "_", cad_file.stem).strip("_").casefold() or "machine"
    folder = Path(out) if out is not None else Path(name)
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise OutputError(
            "The folder is there already, and nothing is overwritten",
            where=str(folder),
            hint="Name a folder that is new or empty with --out.",
        )
    progress("Reading the CAD model")
    assembly = cad.read_cad(cad_file)
    progress("Finding bodies and joints")
    machine = alignment.discover_declared(assembly) if assembly.joints else alignment.discover(assembly)
    lent = None
    if like is not None:
        progress(f"Comparing with {like}")
        lent = library.likeness(like, alignment.align(assembly, library.load_template(like), Specifications()))
    proposal = library.propose(machine, name=name, like=lent)
    with output_folder(folder) as temporary:
        for kind, document in proposal.documents.items():
            (temporary / f"{kind}.json").write_text(to_json(document), encoding="utf-8")
        (temporary / "proposal.md").write_text(proposal.words, encoding="utf-8")
        findings = library.lint(library.load_template(temporary)).findings
    return {
        "folder": str(folder),
        "equipment_type": name,
        "bodies": [
            {"role": role, "kind": body.kind, "parts": list(body.parts), "reason": body.reason}
            for role, body in zip(proposal.roles, machine.bodies, strict=True)
        ],
        "joints": [
            {
                "name": title,
                "type": joint.type,
                "bodies": [proposal.roles[joint.a], proposal.roles[joint.b]],
                "point": list(joint.point),
                "axis": list(joint.direction),
                "pins": list(joint.pins),
                "reason": joint.reason,
            }
            for title, joint in zip(proposal.joints, machine.joints, strict=True)
        ],
        "findings": [asdict(f) for f in (*machine.findings, *findings)],
    }
