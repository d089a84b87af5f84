"""The code's own standards: the linter, the formatter and the type checker pass; no module outgrows a reader."""

from __future__ import annotations

import ast
import importlib
import importlib.util
import re
import statistics
import subprocess
import sys
from pathlib import Path

import pytest

MOST_MODULES = 14
"""In one package: more is no room any more."""


def run(root: Path, *command: str) -> None:
    outcome = subprocess.run([sys.executable, "-m", *command], cwd=root, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def test_ruff_finds_nothing(root: Path) -> None:
    run(root, "ruff", "check", ".")


def test_ruff_would_format_nothing(root: Path) -> None:
    run(root, "ruff", "format", "--check", ".")


@pytest.mark.slow
def test_strict_types_hold(root: Path) -> None:
    run(root, "mypy")


@pytest.mark.slow
def test_a_type_checker_sees_the_names(tmp_path: Path, root: Path) -> None:
    """With the types that a script needs, from a file outside the repository; after the test above, whose cache it
    finds."""
    script = tmp_path / "script.py"
    script.write_text(
        """
import yellowiron as yi

machine = yi.build("wheel_loader", "loader.step", "out", sheets=["sheet.pdf"])
reveal_type(machine.usd)
reveal_type(yi.align("excavator", "x.glb").alignment.missing)
reveal_type(yi.measure(machine)[0].model)
yi.build("wheel_loader")
""",
        encoding="utf-8",
    )
    command = [sys.executable, "-m", "mypy", "--config-file", str(root / "pyproject.toml"), str(script)]
    outcome = subprocess.run(command, cwd=root, capture_output=True, text=True).stdout
    assert 'Revealed type is "pathlib.Path"' in outcome, outcome
    assert "tuple[str, ...]" in outcome
    assert "float | None" in outcome
    assert "Missing positional arguments" in outcome


def test_no_module_is_over_500_lines(root: Path) -> None:
    long = {
        str(path.relative_to(root)): lines
        for path in sorted([*(root / "src").rglob("*.py"), *(root / "studio" / "src").rglob("*.ts")])
        if (lines := len(path.read_text(encoding="utf-8").splitlines())) > 500
    }
    assert not long


def test_only_the_terminal_writes_to_the_terminal(root: Path) -> None:
    """What a stage has to say is a finding; the guard's child answers its parent by its own streams."""
    source = root / "src/yellowiron"
    writes = {p.relative_to(source).as_posix() for p in source.rglob("*.py") if re.search(r"\bsys\.std", p.read_text())}
    assert writes <= {"report/terminal.py", "support/guard.py", "support/isolated.py"}


def test_imports_go_one_way(root: Path) -> None:
    """The contracts of `pyproject.toml`: layers, and no circle between the rooms of any package."""
    program = Path(sys.executable).with_name("lint-imports")
    outcome = subprocess.run([program, "--no-cache"], cwd=root, capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr


def test_rooms_are_small_and_say_what_is_in_them(root: Path) -> None:
    package = root / "src" / "yellowiron"
    modules = {p: len(p.read_text(encoding="utf-8").splitlines()) for p in sorted(package.rglob("*.py"))}
    assert statistics.median(modules.values()) <= 150
    crowded = {
        str(folder.relative_to(package)): count
        for folder in sorted({p.parent for p in modules})
        if (count := sum(p.parent == folder and p.name != "__init__.py" for p in modules)) > MOST_MODULES
    }
    assert not crowded
    silent = [
        str(p.relative_to(package))
        for p in modules
        if p.name == "__init__.py" and not (ast.get_docstring(ast.parse(p.read_text(encoding="utf-8"))) or "").strip()
    ]
    assert not silent


@pytest.mark.parametrize("folder", ["benchmarks", "docs", "examples"])
def test_scripts_import_names_that_are_there(root: Path, folder: str) -> None:
    """Scripts that no test runs: what they import of the package exists."""
    gone = []
    for script in sorted((root / folder).rglob("*.py")):
        for node in ast.walk(ast.parse(script.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "yellowiron":
                module = importlib.import_module(str(node.module))
                for name in node.names:
                    if (
                        not hasattr(module, name.name)
                        and importlib.util.find_spec(f"{node.module}.{name.name}") is None
                    ):
                        gone.append(f"{script.relative_to(root)}: {node.module}.{name.name}")
    assert not gone
