"""A STEP file to an `Assembly`: every solid of every occurrence. Runs in the guard's child process."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from yellowiron.cad.bounds import require_occurrences
from yellowiron.cad.brep import products
from yellowiron.cad.brep.products import Piece
from yellowiron.cad.brep.xcaf import Leaf, open_step
from yellowiron.cad.naming import encoding_remarks, listed, sniff_encoding
from yellowiron.cad.readers.exact import part21
from yellowiron.cad.readers.exact.patience import file_must_end
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding

UNITS = {
    "millimetre": 1e-3,
    "millimeter": 1e-3,
    "mm": 1e-3,
    "metre": 1.0,
    "meter": 1.0,
    "m": 1.0,
    "centimetre": 1e-2,
    "centimeter": 1e-2,
    "decimetre": 1e-1,
    "kilometre": 1e3,
    "micrometre": 1e-6,
    "inch": 0.0254,
    "inches": 0.0254,
    "in": 0.0254,
    "foot": 0.3048,
    "feet": 0.3048,
    "ft": 0.3048,
    "mil": 2.54e-5,
    "mile": 1609.344,
}
"""Unit names of STEP files, lower case, to metres."""


def read_step(path: str) -> Assembly:
    """The assembly in a STEP file. `CadError` if there is nothing in it that is a part."""
    # On some damage Open CASCADE goes on for ever.
    with file_must_end(Path(path).stat().st_size):
        return _read(path)


def _read(path: str) -> Assembly:
    data = Path(path).read_bytes()
    facts = part21.scan(data)
    at = data.find(b"\0")
    blank = at if at >= 0 and data[at:].strip(b"\0\x1a\r\n ") else -1
    del data
    if not facts.complete:
        raise CadError(
            "The STEP file is truncated: ENDSEC and END-ISO-10303-21 are missing at its end",
            where=path,
            hint="Copy or export it again; the end of the file is missing.",
        )
    if facts.occurrences is not None:
        require_occurrences(facts.occurrences, path)
    encoding = sniff_encoding(facts.names)
    findings = encoding_remarks(encoding, path)
    if blank >= 0:
        words = f"Byte {blank + 1} of the file is no text: parts may be missing or incomplete"
        findings.append(Finding("CAD001", "warning", path, words, "Copy or export it again; the file is damaged."))
    # Names inside of products are slow to look for; those of other files were not seen.
    tree, unit_names = open_step(path, encoding, inner_names=facts.named or bool(facts.documents))
    unit, unit_findings = _unit(unit_names, path)
    findings += unit_findings
    return products.assemble(
        tree,
        path=path,
        format="STEP",
        unit=unit,
        findings=findings,
        declared=facts.occurrences,
        missing=lambda leaves, pieces: _missing(path, facts, encoding, leaves, pieces),
    )


def _unit(names: Sequence[str], path: str) -> tuple[float, list[Finding]]:
    known = [UNITS[name.lower()] for name in names if name.lower() in UNITS]
    unit = known[0] if known else 1e-3
    if not known:
        said = f"'{names[0]}'" if names else "none"
        return unit, [
            Finding("CAD009", "warning", path, f"The file's unit of length is not known ({said}); millimetres assumed")
        ]
    if len(set(known)) > 1:
        units = ", ".join(dict.fromkeys(names))
        return unit, [Finding("CAD009", "info", path, f"The file mixes units ({units}); every part was converted")]
    return unit, []


def _missing(
    path: str, facts: part21.Part21, encoding: str, leaves: Sequence[Leaf], pieces: Sequence[Sequence[Piece]]
) -> list[Finding]:
    empty = ["/".join((*leaf.path, leaf.name)) for leaf, found in zip(leaves, pieces, strict=True) if not found]
    findings = []
    read = len(leaves) - len(empty)
    if facts.occurrences is not None and read < facts.occurrences:
        findings.append(
            Finding(
                "CAD001",
                "warning",
                path,
                f"The file declares {facts.occurrences} occurrences of parts and {read} were read",
                "Open the file in its own program: the others may be empty, or stand in files that are not here.",
            )
        )
    if empty:
        findings.append(Finding("CAD002", "info", path, f"Without usable geometry: {listed(empty)}"))
    documents = [name.decode(encoding, errors="replace") for name in dict.fromkeys(facts.documents)]
    folder = Path(path).absolute().parent
    gone = [name for name in documents if not (folder / name.replace("\\", "/")).exists()]
    if gone and empty:
        names = listed(gone)
        findings.append(
            Finding("CAD008", "error", path, f"Referenced files are missing: {names}", "Put them beside the STEP file.")
        )
    return findings
