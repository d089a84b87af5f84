"""The way of a STEP file through `read_cad`: tree, names, placements, colours, units, sharing."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest

from kit.cadfiles.step import (
    Node,
    Use,
    box,
    compound,
    cylinder,
    faces_of,
    moved,
    pin_bracket,
    rotation,
    to_nurbs,
    translation,
    write_step,
)
from yellowiron.cad import read_cad
from yellowiron.cad.readers.exact.step import read_step
from yellowiron.model.assembly import Assembly

pytestmark = pytest.mark.usefixtures("read_here")

MIRROR = np.diag([1.0, -1.0, 1.0, 1.0])
DOUBLE = np.diag([2.0, 2.0, 2.0, 1.0])
ORANGE, RED, BLUE, GREY = (1.0, 0.5, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.2, 0.2, 0.2)


def read_in(path: Path) -> Assembly:
    """Read in this process: the guard is for files that are not our own."""
    return read_step(str(path))


def machine() -> Node:
    bolt = Node("BOLT M24", cylinder(12, 80), color=GREY)
    bracket = Node("ブラケット", pin_bracket(), color=ORANGE, face_colors={0: RED})
    arm = Node(
        "ARM ASSY", children=[Use(bolt, translation(0, 0, 5), "BOLT M24-1"), Use(bolt, color=BLUE), Use(bracket)]
    )
    several = Node("PLATES", compound(box(10, 10, 10), box(10, 10, 10, (50, 0, 0)), cylinder(5, 5, (100, 0, 0))))
    sheet = Node("COVER", faces_of(box(100, 100, 100))[0])
    return Node(
        "WHEEL LOADER",
        children=[
            Use(arm, name="ARM LEFT"),
            Use(arm, translation(0, 1000, 0) @ MIRROR),
            Use(Node("支架", to_nurbs(cylinder(30, 100))), translation(0, 0, 500) @ DOUBLE),
            Use(several),
            Use(sheet),
            Use(bolt, translation(3, 0, 0) @ rotation((0, 0, 1), 0.3), name="12"),
        ],
    )


@pytest.fixture(scope="module")
def millimetres(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_step(tmp_path_factory.mktemp("cad") / "machine.step", machine())


@pytest.fixture(scope="module")
def assembly(millimetres: Path) -> Assembly:
    return read_cad(millimetres)


@pytest.mark.slow
def test_ids_follow_the_tree(assembly: Assembly) -> None:
    # An instance's own name counts where it says something that the product's does not.
    assert [part.id for part in assembly.parts] == [
        "WHEEL LOADER/ARM LEFT/BOLT M24",
        "WHEEL LOADER/ARM LEFT/BOLT M24#2",
        "WHEEL LOADER/ARM LEFT/ブラケット",
        "WHEEL LOADER/ARM ASSY/BOLT M24",
        "WHEEL LOADER/ARM ASSY/BOLT M24#2",
        "WHEEL LOADER/ARM ASSY/ブラケット",
        "WHEEL LOADER/支架",
        "WHEEL LOADER/PLATES#1",
        "WHEEL LOADER/PLATES#2",
        "WHEEL LOADER/PLATES#3",
        "WHEEL LOADER/COVER",
        "WHEEL LOADER/BOLT M24",
    ]
    assert assembly.parts[2].path == ("WHEEL LOADER", "ARM LEFT")


def test_header(assembly: Assembly) -> None:
    assert (assembly.name, assembly.format, assembly.unit) == ("WHEEL LOADER", "STEP", 0.001)
    assert assembly.declared_occurrences == 10
    assert [finding.code for finding in assembly.findings] == ["CAD005"]


def test_instances_share_their_shape(assembly: Assembly) -> None:
    bolts = [part for part in assembly.parts if part.name == "BOLT M24"]
    assert len(bolts) == 5
    assert len({part.shape for part in bolts}) == 1
    assert len(assembly.shapes) == 7


def test_placements(assembly: Assembly) -> None:
    left, right = (part for part in assembly.parts if part.name == "ブラケット")
    assert np.allclose(left.transform, np.eye(4))
    assert np.linalg.det(right.transform[:3, :3]) == pytest.approx(-1.0)
    points, mirrored = assembly.points_of(left), assembly.points_of(right)
    assert np.allclose(mirrored, points * (1, -1, 1) + (0, 1, 0))
    scaled = next(part for part in assembly.parts if part.name == "支架")
    assert np.ptp(assembly.points_of(scaled), axis=0) == pytest.approx([0.12, 0.12, 0.2], abs=2e-3)
    last = assembly.parts[-1]
    assert np.allclose(last.transform[:3, 3], (0.003, 0, 0))
    assert np.allclose(last.transform[:2, 0], (np.cos(0.3), np.sin(0.3)))


def test_colours(assembly: Assembly) -> None:
    first, second, bracket = assembly.parts[:3]
    assert first.color == pytest.approx(GREY)
    assert second.color == pytest.approx(BLUE)
    assert bracket.color == pytest.approx(ORANGE)
    colors = assembly.shape_of(bracket).mesh.triangle_colors
    assert colors is not None
    assert {tuple(color.round(3)) for color in colors} == {ORANGE, RED}
    assert assembly.shape_of(first).mesh.triangle_colors is None


def test_sheet_survives(assembly: Assembly) -> None:
    cover = assembly.shape_of(next(part for part in assembly.parts if part.name == "COVER"))
    assert (cover.closed, cover.volume) == (False, 0.0)
    assert cover.area == pytest.approx(0.01)


def test_inches_give_the_same_shapes(assembly: Assembly, tmp_path: Path) -> None:
    inches = read_in(write_step(tmp_path / "inches.step", machine(), unit="INCH"))
    assert inches.unit == 0.0254
    assert list(inches.shapes) == list(assembly.shapes)
    for one, other in zip(assembly.parts, inches.parts, strict=True):
        assert np.allclose(one.transform, other.transform, atol=1e-9)
        assert np.allclose(assembly.points_of(one), inches.points_of(other), atol=1e-9)


def test_same_file_same_assembly(assembly: Assembly, millimetres: Path) -> None:
    again = read_in(millimetres)
    assert pickle.dumps(again) == pickle.dumps(assembly)


def test_names_are_no_content(tmp_path: Path) -> None:
    one = read_in(write_step(tmp_path / "a.step", Node("PIN 40", cylinder(20, 100))))
    other = read_in(write_step(tmp_path / "b.step", Node("Part_001", cylinder(20, 100))))
    longer = read_in(write_step(tmp_path / "c.step", Node("PIN 40", cylinder(20, 100.01))))
    larger = read_in(write_step(tmp_path / "d.step", Node("PIN 40", cylinder(40, 200))))
    assert list(one.shapes) == list(other.shapes)
    assert len({*one.shapes, *longer.shapes, *larger.shapes}) == 3


def test_colour_is_content_after_the_geometry(tmp_path: Path) -> None:
    plain = read_in(write_step(tmp_path / "a.step", Node("PIN", cylinder(20, 100))))
    red = read_in(write_step(tmp_path / "b.step", Node("PIN", cylinder(20, 100), color=RED)))
    assert list(plain.shapes) != list(red.shapes)
    assert next(iter(plain.shapes))[:32] == next(iter(red.shapes))[:32]


def test_single_part_file(tmp_path: Path) -> None:
    assembly = read_in(write_step(tmp_path / "pin.step", Node("PIN", cylinder(20, 100))))
    (part,) = assembly.parts
    assert (part.id, part.path, assembly.name) == ("PIN", (), "PIN")
    assert assembly.declared_occurrences == 1


def test_several_roots(tmp_path: Path) -> None:
    nodes = [Node("A", box(1, 2, 3)), Node("B", children=[Use(Node("C", box(3, 2, 2)))])]
    assembly = read_in(write_step(tmp_path / "roots.step", *nodes))
    assert sorted(part.id for part in assembly.parts) == ["A", "B/C"]
    assert assembly.name == "roots"
    assert assembly.declared_occurrences == 2


def test_solid_inside_out_and_closed_shell(tmp_path: Path) -> None:
    shell = box(10, 20, 30)
    inside_out = read_in(write_step(tmp_path / "a.step", Node("A", moved(shell, MIRROR).Reversed())))
    (shape,) = inside_out.shapes.values()
    assert shape.volume == pytest.approx(6e-6)
    assert all(np.dot(plane.normal, np.array(plane.point) - shape.centroid) > 0 for plane in shape.planes)
    from OCP.TopAbs import TopAbs_SHELL
    from OCP.TopExp import TopExp_Explorer

    only_shell = TopExp_Explorer(shell, TopAbs_SHELL).Current()
    (shape,) = read_in(write_step(tmp_path / "b.step", Node("B", only_shell))).shapes.values()
    assert shape.closed
    assert shape.volume == pytest.approx(6e-6)


def test_missing_references_are_named(tmp_path: Path) -> None:
    from yellowiron.model.errors import CadError

    nodes = Node("TOP", children=[Use(Node("ARM", box(10, 20, 30))), Use(Node("PIN", cylinder(5, 50)))])
    path = write_step(tmp_path / "top.step", nodes, external="part_")
    assert [part.id for part in read_in(path).parts] == ["TOP/ARM", "TOP/PIN"]
    (tmp_path / "part_PIN.stp").unlink()
    assembly = read_in(path)
    assert [part.id for part in assembly.parts] == ["TOP/ARM"]
    codes = {finding.code: finding.message for finding in assembly.findings}
    assert "2 occurrences of parts and 1 were read" in codes["CAD001"]
    assert "part_PIN.stp" in codes["CAD008"]
    (tmp_path / "part_ARM.stp").unlink()
    with pytest.raises(CadError, match=r"part_ARM\.stp"):
        read_in(path)


def test_solids_of_one_product_keep_their_names(tmp_path: Path) -> None:
    solids = compound(box(10, 10, 10), box(20, 10, 10, (50, 0, 0)), box(30, 10, 10, (100, 0, 0)))
    path = write_step(tmp_path / "machine.step", Node("MACHINE", solids))
    for name in (b"BOOM", b"Solid2", b"BUCKET"):
        path.write_bytes(
            path.read_bytes().replace(b"MANIFOLD_SOLID_BREP('',", b"MANIFOLD_SOLID_BREP('" + name + b"',", 1)
        )
    assembly = read_in(path)
    assert [part.id for part in assembly.parts] == ["MACHINE/BOOM", "MACHINE#2", "MACHINE/BUCKET"]
    assert assembly.parts[0].path == ("MACHINE",)
    assert assembly.declared_occurrences == 1
    assert not assembly.findings


def test_an_assemblys_colour_is_for_parts_without_one(tmp_path: Path) -> None:
    arm = Node("ARM", children=[Use(Node("A", box(1, 2, 3))), Use(Node("B", box(1, 2, 4), color=RED))])
    root = Node("ROOT", children=[Use(arm, color=BLUE), Use(arm)])
    assembly = read_in(write_step(tmp_path / "colours.step", root))
    assert [part.color for part in assembly.parts] == [BLUE, RED, None, RED]


def test_any_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "станок 動臂"
    folder.mkdir()
    write_step(folder / "arm ä.STP", Node("TOP", children=[Use(Node("ARM", box(10, 20, 30)))]), external="x_")
    monkeypatch.chdir(folder)
    # A relative path: external references are found beside the file all the same.
    assert [part.id for part in read_cad("arm ä.STP").parts] == ["TOP/ARM"]


def test_sheets_of_one_product_are_one_part(tmp_path: Path) -> None:
    faces = faces_of(box(100, 200, 300))
    product = Node("COVER", compound(box(10, 10, 10, (500, 0, 0)), faces[0], faces[3]))
    assembly = read_in(write_step(tmp_path / "cover.step", product))
    solid, sheets = (assembly.shape_of(part) for part in assembly.parts)
    assert (solid.closed, sheets.closed) == (True, False)
    assert len(sheets.planes) == 2
