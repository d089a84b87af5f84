"""Nothing is imported from the folder one stands in, nor from one on PYTHONPATH: planted modules never run."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from kit.planted import PACKAGE, installation, plant
from kit.small import write_small
from yellowiron.cad.formats import FORMATS
from yellowiron.simulation.registry import ENGINES
from yellowiron.support.guard import run_guarded

LIBRARIES = ("numpy", "trimesh", "OCP", "pxr", "pypdfium2", "pdfplumber", "mujoco", "fcl", "ezdxf", "assimp_py", "PIL")
COMMANDS = ("templates copy wheel_loader copy", "convert small.glb --out small.usda")
SLOW_COMMANDS = (
    "templates list", "templates show wheel_loader", "templates check wheel_loader", "frobnicate",
    "build ./type --cad small.glb --out built --set 'Arm Angle Up=40 deg' --set 'Arm Angle Down=10 deg'",
    "align ./type small.glb --out alignment.json", "templates new --from small.glb", "check built/scene.usda",
    "measure built/small.usda", "export built/small.usda --to mjcf --out mjcf", "extract wheel_loader sheet.pdf",
    *(f"simulate built/small.usda --engine {engine}" for engine in ENGINES),
)  # fmt: skip


SLOW = pytest.mark.slow


def environment(folder: Path) -> dict[str, str]:
    """One in which Python's own variables name the folder of planted modules."""
    own = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    path = os.pathsep.join((str(folder), ".", ""))
    return {**own, "PYTHONPATH": path, "PYTHONSTARTUP": str(folder / "os.py"), "PYTHONUSERBASE": str(folder)}


def spoken(command: list[str | Path], folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        list(map(str, command)), cwd=folder, env=environment(folder), capture_output=True, text=True, timeout=300
    )


def ran(marker: Path) -> str:
    return marker.read_text() if marker.exists() else ""


def test_the_trap_works(tmp_path: Path) -> None:
    """Any other program of Python's runs what is planted."""
    marker = plant(tmp_path / "downloads")
    spoken([sys.executable, "-c", "import random"], tmp_path / "downloads")
    assert ran(marker)


@pytest.mark.parametrize("editable", [pytest.param(True, id="editable"), pytest.param(False, id="wheel", marks=SLOW)])
@pytest.mark.slow
def test_no_command_runs_what_lies_about(editable: bool, tmp_path: Path) -> None:
    command = installation(tmp_path / "venv", editable=editable)
    marker = plant(write_small(tmp_path / "downloads"))
    for words in COMMANDS:
        done = spoken(["sh", "-c", f"{command} {words}"], tmp_path / "downloads")
        assert done.returncode in (0, 2) and "Traceback" not in done.stderr, done.stderr
    assert (tmp_path / "downloads" / "small.usda").is_file()
    assert ran(marker) == ""


@pytest.mark.slow
@pytest.mark.parametrize("words", SLOW_COMMANDS)
def test_no_command_runs_anything(words: str, tmp_path: Path, small_build: Path) -> None:
    command = installation(tmp_path / "venv", editable=True)
    downloads = write_small(tmp_path / "downloads")
    (downloads / "built").symlink_to(small_build) if "built/" in words and "--out built" not in words else None
    (downloads / "sheet.pdf").write_bytes(PDF)
    marker = plant(downloads)
    done = spoken(["sh", "-c", f"{command} {words}"], downloads)
    assert done.returncode in (0, 1, 2) and "Traceback" not in done.stderr, done.stderr
    assert ran(marker) == ""


def test_python_m_runs_nothing_after_python_s_own_start(tmp_path: Path) -> None:
    """What Python itself imports for `-m` it takes from the current folder first, before any line of ours."""
    own = subprocess.run(
        [sys.executable, "-c", "import runpy, sys; print(*sys.modules)"], capture_output=True, text=True, check=True
    )
    downloads = tmp_path / "downloads"
    marker = plant(downloads, spare=[name.partition(".")[0] for name in own.stdout.split()] + ["yellowiron"])
    environment = {**os.environ, "PYTHONPATH": str(PACKAGE.parent)}
    done = subprocess.run(
        [sys.executable, "-m", "yellowiron", "templates", "list"], cwd=downloads, env=environment, capture_output=True
    )
    assert done.returncode == 0 and ran(marker) == ""


@pytest.mark.slow
def test_children_import_every_reader_and_engine_from_the_installation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where this process has the folder on its own path, as a notebook has."""
    marker = plant(tmp_path / "downloads")
    monkeypatch.chdir(tmp_path / "downloads")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "downloads"))
    monkeypatch.syspath_prepend("")
    readers = {target.partition(":")[0] for one in FORMATS for target in (one.reader, one.meshes, one.needs) if target}
    names = [*sorted(readers), "yellowiron.specs.reader", "yellowiron.specs.ocr", "yellowiron.specs.evidence_images",
             "yellowiron.simulation.suite", *LIBRARIES]  # fmt: skip
    code = f"import importlib\nfor name in {names!r}:\n    importlib.import_module(name)"
    run_guarded("builtins:exec", code, where="x", timeout_s=120.0)
    assert ran(marker) == ""


def test_a_child_has_this_package_and_no_other(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plant(tmp_path / "downloads")
    monkeypatch.chdir(tmp_path / "downloads")
    code = "import sys, yellowiron; raise SystemError(f'{yellowiron.__file__} {sys.path}')"
    with pytest.raises(Exception, match="SystemError") as caught:
        run_guarded("builtins:exec", code, where="x")
    assert f"SystemError: {PACKAGE}/__init__.py" in str(caught.value)
    assert "downloads" not in str(caught.value)


def test_what_a_child_starts_is_as_safe(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    marker = plant(tmp_path / "downloads")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "downloads"))
    code = f"import subprocess; subprocess.run([{sys.executable!r}, '-c', 'import random'], check=True)"
    run_guarded("builtins:exec", code, where="x")
    assert ran(marker) == ""


PDF = (
    b"%PDF-1.4\n1 0 obj<</Type/Catalog/Pages 2 0 R>>endobj\n2 0 obj<</Type/Pages/Kids[3 0 R]/Count 1>>endobj\n"
    b"3 0 obj<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]>>endobj\ntrailer<</Root 1 0 R/Size 4>>\n%%EOF\n"
)
