"""What is installed along with this package, by its metadata alone: no network. `tests/data/advisories.json` has the
published weaknesses that concern what reads files here, by package: advisory → affected versions."""

from __future__ import annotations

import ast
import importlib.util
import json
import sys
import tomllib
from importlib.metadata import Distribution, PackageNotFoundError, distribution, packages_distributions
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name

UNBOUNDED = ("omniverse-asset-validator", "scipy-stubs", "types-jsonschema")
"""Of the developers' tools."""
COPYLEFT = ("GPL-", "GNU General Public", "AGPL", "GNU Affero")
LESSER = ("LGPL", "Lesser", "exception", "Exception")


@pytest.fixture(scope="module")
def project(root: Path) -> dict[str, Any]:
    content: dict[str, Any] = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return content


@pytest.fixture(scope="module")
def installed(project: dict[str, Any]) -> dict[str, Distribution]:
    """Every package that a plain installation brings, by name, with what each asks for satisfied."""
    found: dict[str, Distribution] = {}
    waiting = [(line, "yellowiron") for line in project["dependencies"]]
    while waiting:
        line, asking = waiting.pop()
        wanted = Requirement(line)
        if wanted.marker is not None and not wanted.marker.evaluate({"extra": ""}):
            continue
        name = canonicalize_name(wanted.name)
        try:
            package = distribution(wanted.name)
        except PackageNotFoundError:
            pytest.fail(f"{asking} needs {line}, which is not installed")
        assert wanted.specifier.contains(package.version, prereleases=True), f"{asking} needs {line}"
        if name not in found:
            found[name] = package
            waiting += [(more, name) for more in package.requires or ()]
    return found


def test_every_dependency_has_bounds_and_comes_from_an_index(project: dict[str, Any]) -> None:
    lines = [*project["dependencies"], *(line for more in project["optional-dependencies"].values() for line in more)]
    for line in map(Requirement, lines):
        assert line.url is None, line
        signs = {one.operator for one in line.specifier}
        assert {">=", "<"} <= signs or line.name in UNBOUNDED, line


def test_nothing_was_installed_from_elsewhere(installed: dict[str, Distribution]) -> None:
    assert [name for name, package in installed.items() if package.read_text("direct_url.json")] == []


def test_no_installed_version_has_a_known_weakness(root: Path, installed: dict[str, Distribution]) -> None:
    known = json.loads((root / "tests" / "data" / "advisories.json").read_text(encoding="utf-8"))
    weak = [
        f"{name} {package.version}: {advisory}"
        for name, package in installed.items()
        for advisory, versions in known.get(name, {}).items()
        if SpecifierSet(versions).contains(package.version, prereleases=True)
    ]
    assert weak == []


def test_every_license_is_stated_and_lets_programs_be_anybody_s(installed: dict[str, Distribution]) -> None:
    for name, package in installed.items():
        told = package.metadata
        words = [told.get("License-Expression") or "", (told.get("License") or "").splitlines()[0:1], *(
            told.get_all("Classifier") or ()
        ), *(told.get_all("License-File") or ())]  # fmt: skip
        stated = " ".join(str(w) for w in words if "icens" in str(w).casefold() or w in words[:2])
        assert stated.strip("[] '"), name
        assert not any(w in stated for w in COPYLEFT) or any(w in stated for w in LESSER), (name, stated)


@pytest.mark.slow
def test_what_is_imported_is_declared(root: Path, project: dict[str, Any]) -> None:
    declared = {canonicalize_name(Requirement(line).name) for line in project["dependencies"]}
    for extra in sorted(project["optional-dependencies"].keys() - {"dev"}):
        declared |= {canonicalize_name(Requirement(line).name) for line in project["optional-dependencies"][extra]}
    # What comes with a declared one is its own choice, and bounded by it: pdfminer by pdfplumber, warp by newton.
    declared |= {
        canonicalize_name(Requirement(line).name)
        for name in declared
        if _is_installed(name)
        for line in distribution(name).requires or ()
    }
    owners = packages_distributions()
    missing: dict[str, str] = {}
    for file in (root / "src").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            names = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            names += [node.module or ""] if isinstance(node, ast.ImportFrom) and not node.level else []
            for top in {name.partition(".")[0] for name in names}:
                ours = top in sys.stdlib_module_names or top == "yellowiron"
                absent = importlib.util.find_spec(top) is None if top else True
                if not ours and not absent and not declared & {canonicalize_name(o) for o in owners.get(top, ())}:
                    missing[top] = str(file)
    assert missing == {}


def _is_installed(name: str) -> bool:
    try:
        distribution(name)
    except PackageNotFoundError:
        return False
    return True
