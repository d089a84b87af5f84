"""What a file is, by its content first and its name second."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

from yellowiron.cad import proprietary
from yellowiron.cad.proprietary import Program
from yellowiron.model.errors import CadError

_BOM = b"\xef\xbb\xbf"
_HEAD = 65536

_OPEN = {
    ".glb": "GLB",
    ".gltf": "glTF",
    ".stl": "STL",
    ".obj": "OBJ",
    ".ply": "PLY",
    ".3mf": "3MF",
    ".dae": "COLLADA",
    ".fbx": "FBX",
    ".igs": "IGES",
    ".iges": "IGES",
    ".ifc": "IFC",
    ".dxf": "DXF",
    ".dwg": "DWG",
    ".fcstd": "FreeCAD",
    ".usd": "USD",
    ".usda": "USD",
    ".usdc": "USD",
    ".usdz": "USD",
    ".urdf": "URDF",
    ".mjcf": "MJCF",
    ".blend": "Blender",
    ".brep": "BREP",
    ".brp": "BREP",
}
"""Open formats by extension."""
_UNKNOWN_OLE = Program(
    "this OLE container (SolidWorks, Inventor, Revit, …)", (), "STEP (AP214 or AP242)",
    ("Open it in the program that made it", "File > Export or Save As, type STEP", "Give that file"),
)  # fmt: skip
READABLE = ("STEP", *dict.fromkeys(_OPEN.values()))
"""The formats that are read here, by the names that `format_of` gives."""
_IFC = re.compile(rb"FILE_SCHEMA\s*\(\s*\(\s*'IFC")
_ROOTS = {b"COLLADA": "COLLADA", b"robot": "URDF", b"mujoco": "MJCF"}
"""XML documents by their root."""
_ROOT = re.compile(rb"\A(?:\s|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>]*>)*<(?:\w+:)?(\w+)", re.DOTALL)

_OBJ_LINE = re.compile(rb"^[ \t]*(?:v|vn|vt|f|o|g|mtllib|usemtl)[ \t]", re.MULTILINE)
_STEP_XML = re.compile(rb"urn:oid:1\.0\.10303|<\s*(?:\w+:)?Uos\b|iso_10303_28")


def format_of(path: Path) -> str:
    """Which of the `READABLE` formats a file has; for any other `CadError` says what it is and what to do."""
    head = _head(path)
    if _is_step(head):
        return "IFC" if _IFC.search(head) else "STEP"
    if head.startswith(_BOM) and _is_step(head.removeprefix(_BOM)):
        raise CadError(
            "The STEP file starts with a byte-order mark, which STEP does not have",
            where=str(path),
            hint="Save it again as plain text or UTF-8 without a signature.",
        )
    found = recognise(head, path)
    if isinstance(found, str):
        return found
    if found is not None:
        words = f"No open reader exists for {found.name}" + (f": export to {found.target}" if found.target else "")
        raise CadError(words, where=str(path), hint=found.hint)
    if path.suffix.lower() in (".step", ".stp", ".p21"):
        raise CadError(
            "This is not a STEP file, whatever its name says: it does not start with ISO-10303-21",
            where=str(path),
            hint="Export the model as STEP AP214 or AP242.",
        )
    raise CadError(
        "This is no CAD file that is known here",
        where=str(path),
        hint="Give a STEP file (AP203, AP214 or AP242: .step, .stp); or IGES, a mesh (.glb, .stl, .obj, …), USD, URDF "
        "or MJCF: docs/cad-files.md lists them all.",
    )


def _head(path: Path) -> bytes:
    if path.is_dir():
        raise CadError("This is a folder, not a CAD file", where=str(path), hint="Name the STEP file in it.")
    try:
        with path.open("rb") as file:
            head = file.read(_HEAD)
    except FileNotFoundError as error:
        raise CadError("There is no such CAD file", where=str(path), hint="Check the path.") from error
    except OSError as error:
        raise CadError(
            f"The CAD file cannot be opened: {error.strerror}", where=str(path), hint="Check its permissions."
        ) from error
    if not head:
        raise CadError("The CAD file is empty", where=str(path), hint="Copy or export it again.")
    return head


def _is_step(head: bytes) -> bool:
    text = head.lstrip()
    while text.startswith(b"/*") and b"*/" in text:
        text = text[text.index(b"*/") + 2 :].lstrip()
    return text.startswith(b"ISO-10303-21")


def recognise(head: bytes, path: Path) -> str | Program | None:
    """The format of a file that is not STEP, or whose it is; None for one that is not known."""
    suffix = path.suffix.lower()
    found = _by_content(head, path)
    if found is not None:
        return found
    if not _is_text(head) and (program := proprietary.by_suffix(suffix)) is not None:
        return program
    return _OPEN[suffix] if suffix in _OPEN and _may_be(suffix, head) else None


def _by_content(head: bytes, path: Path) -> str | Program | None:
    program = proprietary.by_content(head, path)
    if program is not None:
        return program
    if head.startswith(proprietary.OLE):
        return proprietary.by_suffix(path.suffix.lower()) or _UNKNOWN_OLE
    if re.match(rb"AC10\d\d", head):
        return "DWG"
    if head.startswith(b"glTF"):
        return "GLB"
    if head.startswith(b"Kaydara FBX"):
        return "FBX"
    if head.startswith((b"PXR-USDC", b"#usda")):
        return "USD"
    if head.startswith(b"BLENDER"):
        return "Blender"
    if re.match(rb"ply[ \t]*\r?\n", head):
        return "PLY"
    if head.lstrip().startswith((b"DBRep_DrawableShape", b"CASCADE Topology V", b"Open CASCADE Topology V")):
        return "BREP"
    if re.match(rb"\s*; FBX \d", head):
        return "FBX"
    if head.startswith(b"AutoCAD Binary DXF") or re.match(rb"\s*(?:999\r?\n.*\r?\n)*\s*0\r?\n\s*SECTION\r?\n", head):
        return "DXF"
    if head[:2] == b"\x1f\x8b":
        return Program("a compressed file", (), "", ("unpack it (gunzip)", "give the STEP file inside"))
    if head.startswith(b"PK\x03\x04"):
        return _zip(path)
    if _STEP_XML.search(head[:4096]):
        return Program("STEP-XML", (), "STEP Part 21 (.step)", ("choose AP242 without XML", "give that file"))
    root = _ROOT.match(head.removeprefix(_BOM))
    if root and root.group(1) in _ROOTS:
        return _ROOTS[root.group(1)]
    if len(head) >= 80 and re.match(rb".{72}S {6}1[ \r\n]", head, re.DOTALL):
        return "IGES"
    return None


def _zip(path: Path) -> str | Program:
    try:
        with zipfile.ZipFile(path) as archive:
            names = [name.lower() for name in archive.namelist()]
    except (zipfile.BadZipFile, OSError, NotImplementedError, ValueError):
        return Program("a damaged zip archive", (), "", ("copy or export it again",))
    if "document.xml" in names:
        return "FreeCAD"
    if any(name.endswith(".model") for name in names):
        return "3MF"
    if any(name.endswith((".usda", ".usdc", ".usd")) for name in names):
        return "USD"
    for mark, program in (("swxmlcontents", "SolidWorks"), ("fusionasset", "Fusion"), (".3drep", "CATIA")):
        if any(mark in name for name in names):
            return proprietary.PROGRAMS[program]
    by_name = proprietary.by_suffix(path.suffix.lower())
    return by_name or Program("a zip archive", (), "", ("unpack it", "give the CAD file inside"))


def _is_text(head: bytes) -> bool:
    return b"\x00" not in head[:4096]


def _may_be(suffix: str, head: bytes) -> bool:
    """False where an extension is a lie, as far as a few bytes can tell."""
    if suffix == ".stl":
        return head.lstrip().startswith(b"solid") or (len(head) >= 84 and not _is_text(head))
    if suffix == ".gltf":
        return head.lstrip(_BOM + b" \t\r\n").startswith(b"{")
    if suffix == ".obj":
        return _is_text(head) and _OBJ_LINE.search(head) is not None
    if suffix in (".ply", ".dxf", ".dae", ".ifc", ".brep"):
        return _is_text(head)
    return True
