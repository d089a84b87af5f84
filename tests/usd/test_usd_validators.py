"""OpenUSD's validators and omniverse-asset-validator find no error, save the waivers of docs/validators.md."""

from __future__ import annotations

import logging
import shutil
from pathlib import Path

import pytest
from pxr import Usd

from yellowiron.usd import write_assembly

FILES = ("test_machine.usda", "scene.usda", "converted.usda", "converted.usdc")


@pytest.fixture(scope="module")
def folder(written: Path, machine, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The machine with its assembly converted, both ways, beside it. The engines' schemas are registered first."""
    pytest.importorskip("physx_usd_schemas")
    pytest.importorskip("newton_usd_schemas")
    folder = tmp_path_factory.mktemp("validated") / "out"
    shutil.copytree(written, folder)
    for name in FILES[2:]:
        write_assembly(machine.assembly, folder / name)
    return folder


@pytest.fixture(scope="module")
def waivers(root: Path) -> set[tuple[str, str, str]]:
    """(validator, rule, file) of every row of the table in docs/validators.md."""
    found = set()
    for line in (root / "docs" / "validators.md").read_text(encoding="utf-8").splitlines():
        cells = [c.strip() for c in line.strip("|").split("|")]
        if len(cells) == 4 and cells[0] in ("openusd", "omniverse"):
            assert len(cells[3]) > 20, f"a waiver needs its reason: {line}"
            found.add((cells[0], cells[1], cells[2]))
    return found


def openusd_errors(path: Path) -> list[tuple[str, str]]:
    from pxr import UsdValidation

    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    stage = Usd.Stage.Open(str(path))
    stage.SetEditTarget(stage.GetSessionLayer())
    sets = stage.GetDefaultPrim().GetVariantSets()
    choices = [{}]
    for name in sets.GetNames():
        choices = [{**c, name: v} for c in choices for v in sets.GetVariantSet(name).GetVariantNames()]
    found = []
    for choice in choices:
        for name, value in choice.items():
            sets.GetVariantSet(name).SetVariantSelection(value)
        for error in context.Validate(stage):
            if error.GetType() == UsdValidation.ValidationErrorType.Error:
                found.append((error.GetValidator().GetMetadata().name, error.GetErrorAsString()))
    return found


def omniverse_errors(path: Path, *, variants: bool = True) -> list[tuple[str, str]]:
    validator = pytest.importorskip("omni.asset_validator")
    logging.getLogger("omni").setLevel(logging.ERROR)
    issues = validator.ValidationEngine(variants=variants).validate(str(path)).issues()
    severe = (validator.IssueSeverity.ERROR, validator.IssueSeverity.FAILURE)
    return [(i.rule.__name__, f"{i.message} {i.at}") for i in issues if i.severity in severe]


def quick_omniverse_errors(path: Path) -> list[tuple[str, str]]:
    """All combinations of variants where the file has variant sets of its own, else the file as it opens."""
    return omniverse_errors(path, variants=path.name == "test_machine.usda")


CHECKS = {"openusd": openusd_errors, "omniverse": quick_omniverse_errors}


EACH = [
    # All combinations of the machine's variants take half a minute.
    pytest.param(v, f, marks=pytest.mark.slow if (v, f) == ("omniverse", "test_machine.usda") else ())
    for v in CHECKS
    for f in FILES
]


@pytest.mark.parametrize(("validator", "file"), EACH)
def test_no_error(folder: Path, waivers: set[tuple[str, str, str]], validator: str, file: str) -> None:
    errors = CHECKS[validator](folder / file)
    assert not [e for e in errors if (validator, e[0], file) not in waivers]
    needed = {(validator, rule, file) for rule, _ in errors}
    unneeded = {w for w in waivers if w[0] == validator and w[2] == file} - needed
    assert not unneeded


def test_the_validators_do_run(folder: Path, tmp_path: Path) -> None:
    """A joint to a prim that is not there is found by both."""
    shutil.copytree(folder, tmp_path / "bad")
    path = tmp_path / "bad" / "payloads" / "physics.usda"
    text = path.read_text(encoding="utf-8").replace("body1 = </test_machine/arm>", "body1 = </test_machine/leg>")
    path.write_text(text, encoding="utf-8")
    for check in CHECKS.values():
        assert check(tmp_path / "bad" / "scene.usda")
