"""Formats without an open reader: known by what is in them, and the way out step by step."""

from __future__ import annotations

import os
import struct
import sys
from pathlib import Path

import pytest

from yellowiron.cad import read_cad
from yellowiron.cad.proprietary import PROGRAMS
from yellowiron.cad.recognition import format_of
from yellowiron.model.errors import CadError

STEP = "STEP (AP214 or AP242)"


def container(*streams: str, at: int = 1) -> bytes:
    """An OLE container with streams of these names and nothing in them; its directory starts in sector `at`."""
    header = bytearray(512)
    header[:8] = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
    struct.pack_into("<HHHHH", header, 24, 0x3E, 3, 0xFFFE, 9, 6)
    struct.pack_into("<I", header, 44, 1)
    struct.pack_into("<I", header, 48, at)
    struct.pack_into("<109I", header, 76, 0, *[0xFFFFFFFF] * 108)
    names = ["Root Entry", *streams]
    sectors = [names[i : i + 4] for i in range(0, len(names), 4)]
    table = [0xFFFFFFFF] * 128
    table[0] = 0xFFFFFFFD
    for number in range(len(sectors)):
        table[at + number] = at + number + 1 if number + 1 < len(sectors) else 0xFFFFFFFE
    data = bytes(header) + struct.pack("<128I", *table) + bytes(512 * (at - 1))
    for group in sectors:
        for name in group:
            text = name.encode("utf-16-le") + b"\0\0"
            entry = bytearray(128)
            entry[: len(text)] = text
            struct.pack_into("<H", entry, 64, len(text))
            data += bytes(entry)
        data += bytes(128 * (4 - len(group)))
    return data


def fail(path: Path) -> CadError:
    with pytest.raises(CadError) as caught:
        read_cad(path)
    return caught.value


@pytest.mark.parametrize(
    ("content", "program"),
    [
        (container("Contents", "SwDocContentMgr"), "SolidWorks"),
        (container("A", "B", "C", "D", "E", "RSeStorage", "UFRxDoc"), "Inventor"),
        (container("BasicFileInfo", "Formats"), "Revit"),
        (container("JSitesList", "PARASOLID"), "Solid Edge"),
        (container("UG_PART"), "NX"),
        (container("Dgn~H", "Dgn~S", at=127), "DGN (MicroStation)"),
        (container("ClassDirectory3", "Config"), "3ds Max"),
        (b"V5_CFV2\x00\x00", "CATIA"),
        (b"Version 9.5 JT  DM 6.4" + bytes(60), "JT"),
        (b"\x08\x09\xfe\x02" + bytes(50), "DGN (MicroStation)"),
        (b"**ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz*****", "Parasolid"),
        (b"PS\x00\x00\x00\x33: TRANSMIT FILE", "Parasolid"),
        (b"#UGC:2 ASSEMBLY 1487 620 1 1 15 2500 2005200", "Creo"),
        (b"400 0 1 0 \n16 SolidWorks 2007 11 ACIS 4.0 NT 24 Tue\n1 9.9e-7 1e-10\n", "ACIS"),
        (b"3D Geometry File Format        8", "Rhino"),
        (b"\xff\xfe\xff\x0eS\x00k\x00e\x00t\x00c\x00h\x00U\x00p\x00", "SketchUp"),
        (b"//Maya ASCII 2022 scene\n", "Maya"),
    ],
)
@pytest.mark.parametrize("name", ["file", "machine.step"])
def test_known_by_content(content: bytes, program: str, name: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    error = fail(path)
    assert error.message == f"No open reader exists for {program}: export to {PROGRAMS[program].target}"
    assert error.hint == PROGRAMS[program].hint
    assert error.hint.startswith("1. ") and " 2. " in error.hint and len(error.hint) < 300


def test_a_container_that_is_broken_is_no_crash(tmp_path: Path) -> None:
    path = tmp_path / "file"
    whole = container("A", "B", "C", "D", "E", "SwDoc")
    for cut in range(8, len(whole), 97):
        path.write_bytes(whole[:cut])
        assert "OLE container" in fail(path).message or "SolidWorks" in fail(path).message
    endless = bytearray(container("A", "B", "C", "D", "E"))
    struct.pack_into("<I", endless, 512 + 4, 1)
    path.write_bytes(bytes(endless))
    assert "OLE container" in fail(path).message


@pytest.mark.slow
def test_dwg_goes_through_what_is_on_the_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "machine.dwg"
    path.write_bytes(b"AC1032\x00\x00\x00")
    assert format_of(path).name == "DWG"
    monkeypatch.setenv("PATH", str(tmp_path))
    error = fail(path)
    assert "another program" in error.message and "type STEP or IGES" in error.hint and "dwg2dxf" in error.hint
    drawing = tmp_path / "drawing.dxf"
    corners = "".join(
        f"{10 + i}\n{x}\n{20 + i}\n{y}\n{30 + i}\n0\n" for i, (x, y) in enumerate([(0, 0), (4, 0), (4, 3), (0, 3)])
    )
    drawing.write_text(
        f"0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\nBOOM\n62\n1\n"
        f"{corners}0\nENDSEC\n0\nEOF\n"
    )
    tool = tmp_path / "dwg2dxf"
    tool.write_text(
        f"#!{sys.executable}\nimport shutil, sys\nshutil.copy({str(drawing)!r}, sys.argv[sys.argv.index('-o') + 1])\n"
    )
    tool.chmod(0o755)
    assembly = read_cad(path)
    assert (assembly.format, assembly.unit, [p.name for p in assembly.parts]) == ("DWG", 1.0, ["BOOM"])
    tool.write_text("#!/bin/sh\necho 'bad header' >&2\nexit 1\n")
    error = fail(path)
    assert "dwg2dxf" in error.message and "bad header" in error.message


def test_every_program_is_in_the_docs(root: Path) -> None:
    """`YELLOWIRON_WRITE_DOCS=1` writes the list anew."""
    lines = [f"- {p.name} ({', '.join(p.suffixes)}) → {p.target}: {p.hint}" for p in PROGRAMS.values() if p.suffixes]
    text = (page := root / "docs" / "cad-files.md").read_text(encoding="utf-8")
    if os.environ.get("YELLOWIRON_WRITE_DOCS"):
        head, _, rest = text.partition("<!-- exports -->\n")
        text = f"{head}<!-- exports -->\n" + "\n".join(lines) + "\n<!-- end -->" + rest.partition("<!-- end -->")[2]
        page.write_text(text, encoding="utf-8")
    assert "\n".join(lines) in text
