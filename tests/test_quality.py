"""The code's own standards: the linter, the formatter and the type checker pass; no module outgrows a reader."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest


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


def test_no_module_is_over_500_lines(root: Path) -> None:
    long = {
        str(path.relative_to(root)): lines
        for path in sorted((root / "src").rglob("*.py"))
        if (lines := len(path.read_text(encoding="utf-8").splitlines())) > 500
    }
    assert not long


IMPORTS = ("from yellowiron.", "import yellowiron.", "from yellowiron import ")
ABOVE = {"simulation": {"kinematics", "usd", "exporters"}}
"""Layers above the stages, and the stages that each may import."""


def test_stages_know_the_model_and_never_each_other(root: Path) -> None:
    """DESIGN: only `build` and the command line know all stages; simulate stands on three of them."""
    package = root / "src" / "yellowiron"
    stages = [p.name for p in package.iterdir() if p.is_dir() and p.name not in ("model", "support", "__pycache__")]
    trespasses = [
        f"{path.relative_to(package)} imports {other}"
        for stage in stages
        for path in sorted((package / stage).rglob("*.py"))
        for other in stages
        if other != stage
        and other not in ABOVE.get(stage, set())
        and any(f"{words}{other}" in path.read_text(encoding="utf-8") for words in IMPORTS)
    ]
    assert not trespasses
