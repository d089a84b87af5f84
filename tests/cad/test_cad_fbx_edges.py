"""FBX files with loose edges and points, polygons of two corners and one, which the library refuses as a whole."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kit.cadfiles import fbx as cad_fbx
from kit.machines.solids import box
from yellowiron.cad import read_cad
from yellowiron.cad.mesh import measures
from yellowiron.cad.readers.meshes.fbx_mended import without_edges

BOX = box("block", 2.0, 1.0, 0.5).mesh
LOOSE = {"behind": (0, -6), "before": (0, -6), "a point": (-4,), "several": (3, -4, -1, 2, -5)}


def _written(path: Path, loose: tuple[int, ...], *, before: bool, binary: bool) -> bytes:
    shape = cad_fbx.geometry(1000, BOX.points, BOX.triangles)
    (corners,) = (r for r in shape.below if r.name == "PolygonVertexIndex")
    more, drawn = np.array(loose, dtype=np.int32), corners.properties[0]
    corners.properties = [np.concatenate([more, drawn] if before else [drawn, more])]
    cad_fbx.write(path, [shape, cad_fbx.model(10, "frame", np.eye(4), mesh=True)], [(10, 0), (1000, 10)], binary=binary)
    return path.read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("binary", [True, False])
@pytest.mark.parametrize("kind", LOOSE)
def test_loose_edges_are_passed_over(kind: str, binary: bool, tmp_path: Path) -> None:
    path = tmp_path / "digger.fbx"
    _written(path, LOOSE[kind], before=kind == "before", binary=binary)
    assembly = read_cad(path)
    (part,) = assembly.parts
    mesh = assembly.shape_of(part).mesh
    assert len(mesh.triangles) == len(BOX.triangles)
    assert measures.volume_properties(mesh)[0] == pytest.approx(1e-6 * measures.volume_properties(BOX)[0], rel=1e-6)


@pytest.mark.parametrize("binary", [True, False])
def test_a_mesh_of_edges_alone_leaves_the_others(binary: bool, tmp_path: Path) -> None:
    path = tmp_path / "digger.fbx"
    shapes = [cad_fbx.geometry(n, BOX.points, BOX.triangles) for n in (1000, 1001)]
    (corners,) = (r for r in shapes[0].below if r.name == "PolygonVertexIndex")
    corners.properties = [np.array([0, -6], dtype=np.int32)]
    models = [cad_fbx.model(10 + n, name, np.eye(4), mesh=True) for n, name in enumerate(("edge", "frame"))]
    links = [(10, 0), (11, 0), (1000, 10), (1001, 11)]
    cad_fbx.write(path, [*shapes, *models], links, binary=binary)
    assert [part.name for part in read_cad(path).parts] == ["frame"]


@pytest.mark.parametrize("binary", [True, False])
def test_files_without_them_stay_as_they_are(binary: bool, tmp_path: Path) -> None:
    data = _written(tmp_path / "digger.fbx", (), before=False, binary=binary)
    assert without_edges(data) == data
    cut = data[: len(data) // 2]
    assert without_edges(cut) == cut
