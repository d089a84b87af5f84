"""The registry of formats, and a format that another installed package brings."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest

from kit.packages import install_package
from yellowiron.cad import formats, read_cad
from yellowiron.cad.formats import CadFormat
from yellowiron.cad.recognition import format_of
from yellowiron.model.errors import CadError

READER = """
from pathlib import Path

import numpy as np

from yellowiron.cad.mesh.assembly import Occurrence, assemble, guessed_unit
from yellowiron.cad.mesh.polygons import fans
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Mesh


def read_off(path: str) -> Assembly:
    '''The assembly in an ASCII OFF file: "OFF", the counts of points, faces and edges, then a line for each.'''
    try:
        words = Path(path).read_text("ascii").split()
        points, faces = int(words[1]), int(words[2])
        corners = np.array(words[4 : 4 + 3 * points], dtype=np.float64).reshape(points, 3)
        rest, counts, around = [int(word) for word in words[4 + 3 * points :]], [], []
        for _ in range(faces):
            counts.append(rest[0])
            around += rest[1 : 1 + rest[0]]
            rest = rest[1 + rest[0] :]
        triangles, _ = fans(counts, around)
    except (ValueError, IndexError) as error:
        raise CadError(f"The OFF file is broken: {error}", where=path, hint="Export it again.") from error
    unit, findings = guessed_unit([corners], path)
    name, mesh = Path(path).stem, Mesh(corners * unit, triangles.astype(np.int32))
    placed = [Occurrence(name, (), mesh, np.eye(4))]
    return assemble(placed, name=name, format="OFF", unit=unit, path=path, findings=findings)
"""
FORMAT = """
import re

from yellowiron.cad.formats import CadFormat

OFF = CadFormat("OFF", (".off",), "off_reader:read_off", content=re.compile(rb"OFF\\s"))
"""
BOX = """OFF
8 6 12
0 0 0
2 0 0
2 1 0
0 1 0
0 0 3
2 0 3
2 1 3
0 1 3
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
"""
"""2 m x 1 m x 3 m, its faces outwards."""
OFF = {"off": "off_format:OFF"}


def install(folder: Path, patch: pytest.MonkeyPatch, entries: Mapping[str, str] = OFF, **modules: str) -> None:
    """Installs a distribution `yellowiron-off` with formats and its modules."""
    install_package(
        folder, patch, name="yellowiron-off", group="yellowiron.cad_formats", entries=entries, modules=modules
    )


def test_a_format_of_another_package_is_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "box").write_text(BOX)
    with pytest.raises(CadError, match="no CAD file that is known"):
        read_cad(tmp_path / "box")
    install(tmp_path / "site", monkeypatch, off_format=FORMAT, off_reader=READER)
    assembly = read_cad(tmp_path / "box")
    assert (assembly.format, [part.name for part in assembly.parts]) == ("OFF", ["box"])
    shape = assembly.shape_of(assembly.parts[0])
    assert shape.closed and shape.volume == pytest.approx(6.0)


def test_what_its_reader_says_is_the_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(tmp_path / "site", monkeypatch, off_format=FORMAT, off_reader=READER)
    (tmp_path / "box.off").write_text(BOX[:60])
    with pytest.raises(CadError, match="The OFF file is broken"):
        read_cad(tmp_path / "box.off")


def test_it_is_read_in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(tmp_path / "site", monkeypatch, off_format=FORMAT, off_reader=READER)
    (tmp_path / "loader").mkdir()
    for name in ("BOOM", "FRAME"):
        (tmp_path / "loader" / f"{name}.off").write_text(BOX)
    assert [part.name for part in read_cad(tmp_path / "loader").parts] == ["BOOM", "FRAME"]


@pytest.mark.parametrize(
    ("entry", "module", "says"),
    [
        ("no_such_module:OFF", "", "No module named 'no_such_module'"),
        ("off_format:OFF", "1 / 0", "ZeroDivisionError"),
        ("off_format:OFF", "OFF = lambda: 'OFF'", "is no CadFormat but a function"),
        (
            "off_format:OFF",
            FORMAT.replace("off_reader:read_off", "off_reader"),
            "not of the form module:function",
        ),
        ("off_format:OFF", FORMAT.replace('"OFF"', '"stl"'), "yellowiron has a format of the name stl"),
    ],
)
def test_a_broken_package_is_one_sentence(
    entry: str, module: str, says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install(tmp_path / "site", monkeypatch, {"off": entry}, off_format=module)
    (tmp_path / "box.off").write_text(BOX)
    with pytest.raises(CadError, match=r"known here\. The CAD format of yellowiron-off") as caught:
        format_of(tmp_path / "box.off")
    assert "yellowiron-off" in caught.value.message and says in caught.value.message
    from_folder = formats.others()[1]
    assert [finding.code for finding in from_folder] == ["CAD014"] and from_folder[0].hint


def test_what_this_package_reads_nothing_else_does(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    greedy = FORMAT.replace('".off",', '".off", ".obj", ".stl"').replace(r'rb"OFF\s"', 'rb""')
    install(tmp_path / "site", monkeypatch, off_format=greedy)
    (tmp_path / "a.obj").write_text("v 0 0 0\n")
    assert format_of(tmp_path / "a.obj").name == "OBJ"
    (tmp_path / "a.txt").write_text("anything")
    assert format_of(tmp_path / "a.txt").name == "OFF"


def test_the_first_of_two_packages_has_a_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install(tmp_path / "site", monkeypatch, dict.fromkeys("ba", "off_format:OFF"), off_format=FORMAT)
    known, findings = formats.others()
    assert [one.name for one in known] == ["OFF"]
    assert (
        len(findings) == 1 and " b = " in findings[0].message and "has a format of the name OFF" in findings[0].message
    )


def test_an_entry_that_cannot_work_is_refused() -> None:
    for entry in (
        {"name": "", "suffixes": (".x",), "reader": "a:b"},
        {"name": "X", "suffixes": (".x",), "reader": "a.b"},
        {"name": "X", "suffixes": ("x",), "reader": "a:b"},
        {"name": "X", "suffixes": (".X",), "reader": "a:b"},
        {"name": "X", "suffixes": (), "reader": "a:b"},
    ):
        with pytest.raises(ValueError):
            CadFormat(**entry)


def test_every_format_is_there_once_and_in_the_docs(root: Path) -> None:
    page = (root / "docs" / "cad-files.md").read_text(encoding="utf-8")
    names = [known.name for known in formats.FORMATS]
    suffixes = [suffix for known in formats.FORMATS for suffix in known.suffixes]
    assert len(set(names)) == len(names) and len(set(suffixes)) == len(suffixes)
    for name in names:
        assert re.search(rf"\b{name}\b", page), name
