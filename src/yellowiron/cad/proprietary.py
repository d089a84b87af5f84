"""Formats without an open reader, most of them a program's own: what they are recognised by, and the export that is
read, step by step."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Program:
    """Whose format it is: its files' extensions, the format to export to, and the steps to it."""

    name: str
    suffixes: tuple[str, ...]
    target: str
    steps: tuple[str, ...]

    @property
    def hint(self) -> str:
        """The steps as one numbered sentence."""
        return "; ".join(f"{number}. {step}" for number, step in enumerate(self.steps, start=1)) + "."


_STEP = "STEP (AP214 or AP242)"
PROGRAMS = {
    program.name: program
    for program in (
        Program("SolidWorks", (".sldprt", ".sldasm", ".easm", ".eprt"), _STEP, (
            "Open the top assembly in SolidWorks", "File > Save As, type STEP AP214 (*.step)",
            "Options: solid/surface geometry, export appearances", "Save, and give that file")),
        Program("CATIA", (".catpart", ".catproduct", ".cgr", ".3dxml"), _STEP, (
            "Open the product (.CATProduct) in design mode", "Tools > Options > General > Compatibility > STEP: AP214",
            "File > Save As, type stp", "Give that file")),
        Program("Inventor", (".ipt", ".iam"), _STEP, (
            "Open the top assembly (.iam) in Inventor", "File > Export > CAD Format, type STEP (*.stp)",
            "Options: application protocol 214 or 242", "Save, and give that file")),
        Program("Creo", (), _STEP, (
            "Open the top assembly (.asm) in Creo", "File > Save As > Save a Copy, type STEP (*.stp)",
            "In the dialog: solids, structure of one file", "OK, and give that file")),
        Program("NX", (), _STEP, (
            "Open the top part in NX", "File > Export > STEP (214 or 242)",
            "Data to export: solids, the whole assembly, in one file", "OK, and give that file")),
        Program("NX or Creo", (".prt",), _STEP, (
            "Open the top assembly in the program", "NX: File > Export > STEP; Creo: Save As > Save a Copy, STEP",
            "Choose solids, in one file", "Give that file")),
        Program("Solid Edge", (".par", ".psm", ".asm"), _STEP, (
            "Open the top assembly in Solid Edge", "File > Save As, type STEP (*.stp)",
            "Options: AP214, solids", "Save, and give that file")),
        Program("Fusion", (".f3d", ".f3z"), _STEP, (
            "Open the design in Fusion", "File > Export, type STEP (*.step)", "Export, and give that file")),
        Program("JT", (".jt",), _STEP, (
            "Open it in the program that wrote it (NX, Creo, CATIA, …) or another that imports JT",
            "Export from there as STEP", "Give that file")),
        Program("Parasolid", (".x_t", ".x_b", ".xmt_txt", ".xmt_bin"), _STEP, (
            "Open it in a program that imports Parasolid (SolidWorks, NX, Solid Edge, Onshape, …)",
            "Export from there as STEP", "Give that file")),
        Program("ACIS", (".sat", ".sab", ".smt"), _STEP, (
            "Open it in a program that imports SAT (Inventor, Fusion, Rhino, …)", "Export from there as STEP",
            "Give that file")),
        Program("DGN (MicroStation)", (".dgn",), _STEP, (
            "Open the 3D model in MicroStation", "File > Export > STEP AP203/AP214",
            "Export the solids, and give that file")),
        Program("Rhino", (".3dm",), _STEP, (
            "Open it in Rhino", "File > Save As, type STEP (*.stp)", "Scheme: AP214AutomotiveDesign",
            "Save, and give that file")),
        Program("Revit", (".rvt", ".rfa"), "IFC or FBX", (
            "Open the default 3D view in Revit, with the machine alone in it", "File > Export > IFC (IFC4), or FBX",
            'Give that file; IFC needs pip install "yellowiron[ifc]"')),
        Program("SketchUp", (".skp",), "GLB or COLLADA", (
            "Open it in SketchUp", "File > Export > 3D Model, type glTF binary (.glb) or COLLADA (.dae)",
            "Options: keep the component hierarchies", "Export, and give that file")),
        Program("3ds Max", (".max",), "FBX", (
            "Open it in 3ds Max", "File > Export > Export, type FBX", "Give that file")),
        Program("Maya", (".mb", ".ma"), "FBX", (
            "Open it in Maya", "File > Export All, type FBX export", "Give that file")),
        Program("Cinema 4D", (".c4d",), "GLB or FBX", (
            "Open it in Cinema 4D", "File > Export > glTF or FBX", "Give that file")),
    )
}  # fmt: skip

_UNKNOWN_OLE = Program(
    "this OLE container (SolidWorks, Inventor, Revit, …)", (), _STEP,
    ("Open it in the program that made it", "File > Export or Save As, type STEP", "Give that file"),
)  # fmt: skip
_STARTS: tuple[tuple[bytes, str], ...] = (
    (b"V5_CFV2", "CATIA"),
    (b"**ABCDEFGHIJKLMNOPQRSTUVWXYZ", "Parasolid"),
    (b"PS\x00\x00", "Parasolid"),
    (b"#UGC:2", "Creo"),
    (b"ACIS BinaryFile", "ACIS"),
    (b"ASM BinaryFile", "ACIS"),
    (b"\xff\xfe\xff\x0eS\x00k\x00e\x00t\x00c\x00h\x00U\x00p", "SketchUp"),
    (b"3D Geometry File Format", "Rhino"),
    (b"\x08\x09\xfe\x02", "DGN (MicroStation)"),
    (b"\xc8\x09\xfe\x02", "DGN (MicroStation)"),
    (b"//Maya ASCII", "Maya"),
    (b"QC4DC4D6", "Cinema 4D"),
)
_PATTERNS: tuple[tuple[re.Pattern[bytes], str], ...] = (
    (re.compile(rb"Version \d+\.\d+ +JT"), "JT"),
    (re.compile(rb"FOR[48].{4,12}MAYA", re.DOTALL), "Maya"),
    (re.compile(rb"\d{2,5} -?\d+ \d+ \d+ *\r?\n\d+ [^\n]{0,200}(?:ACIS|ASM) "), "ACIS"),
)
_STREAMS: tuple[tuple[str, str], ...] = (
    ("BasicFileInfo", "Revit"), ("RevitPreview", "Revit"),
    ("SwDoc", "SolidWorks"), ("swXmlContents", "SolidWorks"), ("SldAsm", "SolidWorks"), ("SolidWorks", "SolidWorks"),
    ("UFRxDoc", "Inventor"), ("RSeStorage", "Inventor"), ("RSeDb", "Inventor"), ("Inventor", "Inventor"),
    ("Dgn~", "DGN (MicroStation)"), ("UG_PART", "NX"),
    ("JSite", "Solid Edge"), ("PARASOLID", "Solid Edge"), ("JDocument", "Solid Edge"),
    ("ClassDirectory", "3ds Max"), ("VideoPostQueue", "3ds Max"),
)  # fmt: skip
"""Beginnings of the names of streams in OLE containers."""
_MEMBERS: tuple[tuple[str, str], ...] = (
    ("swxmlcontents", "SolidWorks"),
    ("fusionasset", "Fusion"),
    (".3drep", "CATIA"),
)
"""What stands in the names, in small letters, of files in zip archives."""
_STEP_XML = re.compile(rb"urn:oid:1\.0\.10303|<\s*(?:\w+:)?Uos\b|iso_10303_28")
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
ZIP = b"PK\x03\x04"
_GZIP = b"\x1f\x8b"
_MOST_SECTORS = 64
_END = 0xFFFFFFF0


def by_content(head: bytes, path: Path, members: Sequence[str] | None) -> Program | None:
    """The program whose format a file's first bytes tell, or the names of what is in it: streams, or the `members` of a
    zip archive (in small letters; None: a damaged one)."""
    for magic, name in _STARTS:
        if head.startswith(magic):
            return PROGRAMS[name]
    for pattern, name in _PATTERNS:
        if pattern.match(head):
            return PROGRAMS[name]
    if head.startswith(OLE):
        return _in_ole(head, path)
    if head.startswith(_GZIP):
        return Program("a compressed file", (), "", ("unpack it (gunzip)", "give the STEP file inside"))
    if head.startswith(ZIP):
        return _in_zip(path, members)
    if _STEP_XML.search(head[:4096]):
        return Program("STEP-XML", (), "STEP Part 21 (.step)", ("choose AP242 without XML", "give that file"))
    return None


def _in_ole(head: bytes, path: Path) -> Program:
    streams = list(_streams(head, path))
    for start, name in _STREAMS:
        wide, plain = start.encode("utf-16-le"), start.encode()
        if any(stream.startswith(start) for stream in streams) or wide in head or plain in head:
            return PROGRAMS[name]
    return by_suffix(path.suffix.lower()) or _UNKNOWN_OLE


def _in_zip(path: Path, members: Sequence[str] | None) -> Program:
    if members is None:
        return Program("a damaged zip archive", (), "", ("copy or export it again",))
    for mark, name in _MEMBERS:
        if any(mark in member for member in members):
            return PROGRAMS[name]
    by_name = by_suffix(path.suffix.lower())
    return by_name or Program("a zip archive", (), "", ("unpack it", "give the CAD file inside"))


def by_suffix(suffix: str) -> Program | None:
    """The program that an extension belongs to."""
    return next((program for program in PROGRAMS.values() if suffix in program.suffixes), None)


def _streams(head: bytes, path: Path) -> Iterator[str]:
    """Names of the streams of an OLE container (MS-CFB: header, allocation table, directory of 128-byte entries)."""
    if len(head) < 512:
        return
    shift = struct.unpack_from("<H", head, 30)[0]
    if shift not in (9, 12):
        return
    size = 1 << shift
    tables = struct.unpack_from("<109I", head, 76)
    sector = struct.unpack_from("<I", head, 48)[0]
    with path.open("rb") as file:

        def read(number: int) -> bytes:
            file.seek((number + 1) * size)
            return file.read(size)

        for _ in range(_MOST_SECTORS):
            if sector >= _END:
                return
            data = read(sector)
            for at in range(0, len(data) - 127, 128):
                length = struct.unpack_from("<H", data, at + 64)[0]
                yield data[at : at + max(0, min(length, 64) - 2)].decode("utf-16-le", errors="replace").lstrip("\x05")
            table, entry = divmod(sector, size // 4)
            if table >= len(tables) or tables[table] >= _END:
                return
            chain = read(tables[table])
            sector = struct.unpack_from("<I", chain, 4 * entry)[0] if len(chain) >= 4 * entry + 4 else _END
