"""A package as another project would install it: modules and entry points in a folder on the import path."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

import pytest


def install_package(
    folder: Path,
    patch: pytest.MonkeyPatch,
    *,
    name: str,
    group: str,
    entries: Mapping[str, str],
    modules: Mapping[str, str] | None = None,
) -> None:
    """Puts a package with `entries` (name → module:object) of a group and its `modules` (name → source) in a folder,
    for as long as `patch` lasts."""
    info = folder / f"{name.replace('-', '_')}-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: 1.0\n")
    lines = [f"[{group}]", *(f"{key} = {value}" for key, value in entries.items())]
    (info / "entry_points.txt").write_text("\n".join(lines) + "\n")
    for module, source in (modules or {}).items():
        (folder / f"{module}.py").write_text(source)
        patch.delitem(sys.modules, module, raising=False)
    patch.syspath_prepend(str(folder))
