"""STL and OBJ: what becomes a part, the unit that is guessed, and files that are broken."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from yellowiron.cad import read_cad
from yellowiron.model.errors import CadError

pytestmark = pytest.mark.usefixtures("read_here")

CORNERS = np.array([[x, y, z] for x in (0.0, 4.0) for y in (0.0, 3.0) for z in (0.0, 2.0)])
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
     [1, 5, 7], [1, 7, 3]]
)  # fmt: skip
TWO = np.concatenate([CORNERS[FACES], CORNERS[FACES] + (9.0, 0.0, 0.0)])


def binary(triangles: np.ndarray, count: int | None = None) -> bytes:
    records = np.zeros(len(triangles), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    records["v"] = triangles
    return bytes(80) + struct.pack("<I", len(triangles) if count is None else count) + records.tobytes()


def text(triangles: np.ndarray, name: str) -> str:
    lines = [f"solid {name}"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", " outer loop"]
        lines += [f"  vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in triangle]
        lines += [" endloop", "endfacet"]
    return "\n".join([*lines, f"endsolid {name}\n"])


def obj(*bodies: tuple[str, np.ndarray], head: str = "") -> str:
    lines, start = [head], 1
    for name, points in bodies:
        lines.append(name)
        lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in points]
        lines += ["f " + " ".join(f"{start + i}//" for i in face) for face in FACES]
        start += len(points)
    return "\n".join(lines) + "\n"


def fail(path: Path) -> CadError:
    with pytest.raises(CadError) as caught:
        read_cad(path, timeout_s=60, memory_mb=3000)
    assert caught.value.where
    assert caught.value.hint
    assert "\n" not in caught.value.message
    return caught.value


def test_stl_is_split_into_its_pieces(tmp_path: Path) -> None:
    path = tmp_path / "loader.stl"
    path.write_bytes(binary(TWO))
    assembly = read_cad(path)
    assert [p.id for p in assembly.parts] == ["loader", "loader#2"]
    assert assembly.unit == 1.0
    assert [assembly.shape_of(p).volume for p in assembly.parts] == pytest.approx([24.0, 24.0], rel=1e-6)
    assert all(assembly.shape_of(p).closed for p in assembly.parts)
    assert [f.code for f in assembly.findings] == ["CAD009"]


def test_stl_in_millimetres(tmp_path: Path) -> None:
    path = tmp_path / "loader.stl"
    path.write_bytes(binary(TWO * 1000.0))
    assembly = read_cad(path)
    assert assembly.unit == 1e-3
    assert assembly.shape_of(assembly.parts[0]).volume == pytest.approx(24.0, rel=1e-6)
    assert "millimetres assumed" in assembly.findings[0].message


def test_text_stl_with_names(tmp_path: Path) -> None:
    path = tmp_path / "loader.stl"
    path.write_text(text(TWO[:12], "BOOM") + text(TWO[12:], "BUCKET"))
    assert [p.name for p in read_cad(path).parts] == ["BOOM", "BUCKET"]


@pytest.mark.parametrize("count", [3, 23, 25, 4_000_000_000])
def test_stl_whose_count_lies(count: int, tmp_path: Path) -> None:
    path = tmp_path / "loader.stl"
    path.write_bytes(binary(TWO, count))
    assert f"declares {count} triangles and has room for 24" in fail(path).message


@pytest.mark.parametrize("keep", [0.2, 0.99])
def test_stl_cut_short(keep: float, tmp_path: Path) -> None:
    path = tmp_path / "loader.stl"
    for whole in (binary(TWO), text(TWO, "LOADER").encode()):
        path.write_bytes(whole[: int(len(whole) * keep) - 12])
        assert "truncated" in fail(path).message


def test_stl_without_triangles(tmp_path: Path) -> None:
    path = tmp_path / "loader.stl"
    for content in (binary(TWO[:0]), b"solid nothing\nendsolid nothing\n"):
        path.write_bytes(content)
        assert "no triangles" in fail(path).message


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e20])
def test_stl_with_absurd_numbers(value: float, tmp_path: Path) -> None:
    triangles = TWO.copy()
    triangles[3, 1, 2] = value
    path = tmp_path / "loader.stl"
    path.write_bytes(binary(triangles))
    try:
        assembly = read_cad(path)
    except CadError as error:
        assert "not finite" in error.message or "large" in error.message
    else:
        assert "CAD003" in {f.code for f in assembly.findings}


def test_obj_objects_groups_colours(tmp_path: Path) -> None:
    (tmp_path / "paint.mtl").write_text("newmtl yellow\nKd 1 0.6 0\nnewmtl black\nKd 0.1 0.1 0.1\n")
    path = tmp_path / "loader.obj"
    path.write_text(
        obj(("o BOOM\nusemtl yellow", CORNERS), ("o TYRE\nusemtl black", CORNERS + 9.0), head="mtllib paint.mtl")
    )
    assembly = read_cad(path)
    assert [(p.name, p.color) for p in assembly.parts] == [("BOOM", (1.0, 0.6, 0.0)), ("TYRE", (0.1, 0.1, 0.1))]
    assert assembly.shape_of(assembly.parts[1]).volume == pytest.approx(24.0)
    # polygons are cut into triangles, and corners may be counted from behind
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng PLATE\nf -4 -3 -2 -1\n")
    part = read_cad(path).parts[0]
    assert part.name == "PLATE"


@pytest.mark.parametrize("library", ["../paint.mtl", "/etc/passwd", "gone.mtl"])
def test_obj_opens_no_other_file(library: str, tmp_path: Path) -> None:
    (tmp_path / "paint.mtl").write_text("newmtl yellow\nKd 1 0.6 0\n")
    folder = tmp_path / "inner"
    folder.mkdir()
    path = folder / "loader.obj"
    path.write_text(obj(("o BOOM\nusemtl yellow", CORNERS), head=f"mtllib {library}"))
    assembly = read_cad(path)
    assert assembly.parts[0].color is None
    assert [f.code for f in assembly.findings] == ["CAD008", "CAD009"]


@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("v 0 0 0\nv 1 0 0\nf 1 2 3\n", "line 3"),
        ("v 0 0 0\nv 1 0\n", "line 2"),
        ("v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3"),
        ("v 0 0 0\nv 1 0 zero\n", "line 2"),
        ("v 0 0 0\nf 0 0 0\n", "line 2"),
        ("v 0 0 0\no NOTHING\n", "no face"),
        ("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "not finite"),
        ("v 0 0 0\nv 1e12 0 0\nv 0 1 0\nf 1 2 3\n", "large"),
        ("v 0 0 0\nf 1 1 1\n", "no triangles"),
    ],
)
def test_broken_obj(content: str, says: str, tmp_path: Path) -> None:
    path = tmp_path / "loader.obj"
    path.write_text(content)
    assert says in fail(path).message
