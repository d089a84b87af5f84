"""One machine in every format: the same parts at the same places, and the table in the docs of what else is kept."""

from __future__ import annotations

import os
import re
from pathlib import Path

import numpy as np
import pytest
from cad_validators import errors_of
from test_cad_looks import TEXTURED

from kit.cadfiles.exports import ITEMS, WRITERS, Meshes
from yellowiron.cad import read_cad
from yellowiron.cad.readers.usd.stage import read_usd
from yellowiron.model.assembly import Assembly, Part
from yellowiron.usd import write_assembly

pytestmark = pytest.mark.slow
SURFACES = ("STEP", "IGES", "BREP", "FreeCAD")
"""Formats with exact surfaces: volumes are those of the solids, not of their meshes."""


@pytest.fixture(scope="module")
def truth(tmp_path_factory: pytest.TempPathFactory) -> Assembly:
    path = tmp_path_factory.mktemp("truth") / "machine.step"
    WRITERS["STEP"][1](path, {})
    return read_cad(path)


@pytest.fixture(scope="module")
def meshes(truth: Assembly) -> Meshes:
    found = {}
    for item, part in zip(ITEMS, truth.parts, strict=True):
        mesh = truth.shape_of(part).mesh
        # What other programs write is welded.
        points, corner = np.unique(np.round(mesh.points, 9), axis=0, return_inverse=True)
        triangles = corner.reshape(-1)[mesh.triangles]
        keep = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
        found[item.shape] = (points, triangles[keep])
    return found


@pytest.fixture(scope="module")
def read(meshes: Meshes, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Assembly]:
    assemblies = {}
    for name, (file, write) in WRITERS.items():
        if name == "IFC":
            pytest.importorskip("ifcopenshell")
        folder = tmp_path_factory.mktemp("loader") / "loader"
        folder.mkdir()
        write(folder / file, meshes)
        assemblies[name] = read_cad(folder / file)
    return assemblies


def _centres(assembly: Assembly) -> np.ndarray:
    """(n, 3) centres of the parts' boxes, sorted."""
    centres = np.array([np.mean([p.min(0), p.max(0)], axis=0) for p in map(assembly.points_of, assembly.parts)])
    return centres[np.lexsort(np.round(centres, 4).T)]


def _volume(assembly: Assembly, part: Part) -> float:
    return assembly.shape_of(part).volume * abs(float(np.linalg.det(part.transform[:3, :3])))


@pytest.mark.parametrize("name", WRITERS)
def test_same_parts_at_the_same_places(name: str, read: dict[str, Assembly], truth: Assembly) -> None:
    assembly = read[name]
    assert len(assembly.parts) == len(ITEMS)
    size = 3.0  # metres; what a millionth is of
    # Boxes of surfaces are those of their meshes, which differ where faces are cut up otherwise.
    slack = 1e-3 if name == "IGES" else 1e-6 * size
    np.testing.assert_allclose(_centres(assembly), _centres(truth), atol=slack)
    volumes = sorted(_volume(assembly, p) for p in assembly.parts)
    expected = sorted(_volume(truth, p) for p in truth.parts)
    np.testing.assert_allclose(volumes, expected, rtol=1e-5 if name in SURFACES else 2e-2)
    assert all(assembly.shape_of(p).closed for p in assembly.parts)
    assert not [f for f in assembly.findings if f.severity == "error"]


@pytest.mark.parametrize("name", WRITERS)
def test_the_bore_and_the_pin_are_found(name: str, read: dict[str, Assembly]) -> None:
    found = [(round(c.radius * 1000), c.inner) for s in read[name].shapes.values() for c in s.cylinders]
    assert (50, True) in found and (49, False) in found


@pytest.fixture(scope="module")
def textured(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Assembly]:
    """Where the format has textures and what stands beside them, a box that has them."""
    return {name: read_cad(write(tmp_path_factory.mktemp("textured"))) for name, write in TEXTURED.items()}


def kept(name: str, assembly: Assembly, textured: Assembly | None) -> dict[str, str]:
    """What of the machine, and of a textured box, arrived."""
    shapes = () if textured is None else textured.shapes.values()
    finishes = [finish for shape in shapes for finish in shape.finishes]
    parts = assembly.parts
    names = {re.sub(r"[ #]+\d+$", "", p.name) for p in parts}
    tree = sum(p.path[-1:] == ("FRONT",) for p in parts) == 3
    above = any(p.path for p in parts)
    colors = {p.color for p in parts if p.color is not None}
    right = [c for c in colors if any(np.allclose(c, i.color, atol=5e-3) for i in ITEMS)]
    faces = any(s.mesh.triangle_colors is not None for s in assembly.shapes.values())
    guessed = any(f.code == "CAD009" for f in assembly.findings)
    return {
        "parts": str(len(parts)),
        "names": "yes" if names == {"BOOM", "PIN", "铲斗"} else "no",
        "tree": "yes" if tree else "bodies" if above else "no",
        "unit": "guessed" if guessed else f"{assembly.unit:g} m",
        "colours": "yes" if len(right) == 3 else "of points" if faces else "no",
        "metalness, roughness": "yes" if any(f.metallic is not None for f in finishes) else "",
        "textures": "yes" if any(f.texture is not None for f in finishes) else "",
        "instances": "yes" if len(assembly.shapes) == 3 else "no",
        "surfaces": "exact" if all(s.exact for s in assembly.shapes.values()) else "fitted",
        "joints": "yes" if any(j.type == "revolute" for j in assembly.joints) else "",
    }


def test_the_table_in_the_docs_is_what_was_read(
    read: dict[str, Assembly], textured: dict[str, Assembly], root: Path
) -> None:
    """`YELLOWIRON_WRITE_DOCS=1` writes it anew."""
    rows = {name: kept(name, assembly, textured.get(name)) for name, assembly in read.items()}
    heads = ["format", *next(iter(rows.values()))]
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    lines += ["| " + " | ".join([name, *row.values()]) + " |" for name, row in rows.items()]
    table = "\n".join(lines)
    page = root / "docs" / "cad-files.md"
    text = page.read_text(encoding="utf-8")
    if os.environ.get("YELLOWIRON_WRITE_DOCS"):
        text = re.sub(r"\| format \| parts \| names .*?\n\n", lambda _: table + "\n\n", text, flags=re.DOTALL)
        page.write_text(text, encoding="utf-8")
    assert table in text


@pytest.mark.parametrize("name", WRITERS)
def test_converted_it_passes_the_validators_from_any_folder(
    name: str, read: dict[str, Assembly], tmp_path: Path
) -> None:
    pytest.importorskip("physx_usd_schemas")
    pytest.importorskip("newton_usd_schemas")
    write_assembly(read[name], tmp_path / "out" / "machine.usdc")
    (tmp_path / "out").rename(tmp_path / "elsewhere")
    path = tmp_path / "elsewhere" / "machine.usdc"
    assert errors_of(path) == []
    again = read_usd(str(path))
    np.testing.assert_allclose(_centres(again), _centres(read[name]), atol=3e-6)
    assert len(again.shapes) == len(read[name].shapes)
    assert [p.name for p in again.parts] == [p.name for p in read[name].parts]


@pytest.mark.parametrize("name", TEXTURED)
def test_textures_pass_the_validators_from_any_folder(name: str, textured: dict[str, Assembly], tmp_path: Path) -> None:
    write_assembly(textured[name], tmp_path / "out" / "machine.usdc")
    (tmp_path / "out").rename(tmp_path / "elsewhere")
    path = tmp_path / "elsewhere" / "machine.usdc"
    assert errors_of(path) == []
    found = read_usd(str(path))
    assert any(f.texture is not None for s in found.shapes.values() for f in s.finishes)


@pytest.mark.parametrize("name", ["URDF", "MJCF"])
def test_declared_joints(name: str, read: dict[str, Assembly]) -> None:
    joint = next(j for j in read[name].joints if j.type == "revolute")
    item = ITEMS[3]
    assert joint.anchor == pytest.approx(item.matrix[:3, 3], abs=1e-9)
    assert joint.axis == pytest.approx(item.matrix[:3, 1], abs=1e-9)
    assert joint.lower == pytest.approx({"URDF": -0.5, "MJCF": -np.pi / 6}[name])
    assert joint.upper == pytest.approx({"URDF": 0.8, "MJCF": np.pi / 4}[name])
