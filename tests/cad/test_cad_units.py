"""A model whose file has no unit, drawn in inches, all the way: the sheet's overall length says so, and the machine
comes out in metres, with its material and its texture."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdShade
from test_cad_looks import picture

from yellowiron.cad import read_cad
from yellowiron.pipeline import build

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("no_pages")]
INCH = 0.0254


@pytest.fixture(scope="module")
def folder(example: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The example as an OBJ file in inches, an object a part, its largest parts textured; built with its sheet."""
    folder = tmp_path_factory.mktemp("inches")
    assembly = read_cad(example / "wheel_loader.step")
    lines, start = ["mtllib loader.mtl"], 1
    for part in assembly.parts:
        mesh = assembly.shape_of(part).mesh
        points, own = np.unique(np.round(assembly.points_of(part) / INCH, 6), axis=0, return_inverse=True)
        corners = own.reshape(-1)[mesh.triangles]
        corners = corners[:, ::-1] if np.linalg.det(part.transform[:3, :3]) < 0.0 else corners
        corners = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)] + start
        lines += [f"o {part.name}", "usemtl paint", *(f"v {x:.7g} {y:.7g} {z:.7g}" for x, y, z in points)]
        lines += [f"vt {u:.4g} {v:.4g}" for u, v in points[:, :2] / 100.0]
        lines += [f"f {a}/{a} {b}/{b} {c}/{c}" for a, b, c in corners]
        start += len(points)
    (folder / "loader.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
    (folder / "loader.mtl").write_text("newmtl paint\nKd 1 1 1\nPm 0.25\nPr 0.75\nmap_Kd paint.png\n")
    (folder / "paint.png").write_bytes(picture())
    build("wheel_loader", folder / "loader.obj", folder / "out", sheets=[example / "specifications.pdf"])
    return folder


def test_inches_are_caught_by_the_sheet(folder: Path) -> None:
    report = json.loads((folder / "out" / "report.json").read_text(encoding="utf-8"))
    words = {f["code"]: f["message"] for f in report["findings"]}
    assert "millimetres assumed" in words["CAD009"]
    assert "its numbers are inches" in words["ALN014"]
    measured = {m["name"]: m for m in report["measurements"] if m["spec"]}
    assert len(measured) >= 5
    assert all(abs(m["error_percent"]) < 2.0 for m in measured.values() if m["error_percent"] is not None)


def test_the_texture_is_in_the_machine(folder: Path) -> None:
    moved = (folder / "out").rename(folder / "elsewhere")
    (file,) = (moved / "payloads" / "textures").iterdir()
    assert file.read_bytes() == picture()
    stage = Usd.Stage.Open(str(moved / "wheel_loader.usda"))
    shaders = [UsdShade.Shader(p) for p in stage.Traverse(Usd.TraverseInstanceProxies()) if p.IsA(UsdShade.Shader)]
    textures = [s for s in shaders if s.GetShaderId() == "UsdUVTexture"]
    assert textures and all(Path(s.GetInput("file").Get().resolvedPath) == file for s in textures)
    surfaces = [s for s in shaders if s.GetShaderId() == "UsdPreviewSurface"]
    assert {(round(s.GetInput("metallic").Get(), 3), round(s.GetInput("roughness").Get(), 3)) for s in surfaces} == {
        (0.25, 0.75)
    }
