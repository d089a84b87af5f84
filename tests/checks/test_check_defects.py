"""A tiny machine with nothing wrong, and files that each add one defect to it: its code is found, and no other."""

from __future__ import annotations

import functools
import math
from pathlib import Path

import pytest

from yellowiron.checks import check
from yellowiron.checks.rules import RULES
from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding

DATA = Path(__file__).resolve().parent.parent / "data" / "check"
DEFECTS = sorted(p.stem for p in DATA.glob("CHK*.usda"))


@functools.cache
def checked(name: str) -> tuple[Finding, ...]:
    return check(DATA / f"{name}.usda")


def ours(findings: tuple[Finding, ...]) -> set[str]:
    return {f.code for f in findings if f.code.startswith("CHK")}


def test_the_sound_machine_has_no_finding() -> None:
    assert check(DATA / "sound.usda") == ()


@pytest.mark.slow
@pytest.mark.parametrize("name", DEFECTS)
def test_one_defect_has_one_code(name: str) -> None:
    assert ours(checked(name)) == {name.split("_")[0]}


def test_every_rule_has_a_defect_file() -> None:
    assert {name.split("_")[0] for name in DEFECTS} == {rule.code for rule in RULES}


def test_codes_are_unique_and_in_order() -> None:
    codes = [rule.code for rule in RULES]
    assert codes == sorted(set(codes))


def test_findings_say_where_and_what_to_do() -> None:
    for name in DEFECTS:
        for finding in checked(name):
            assert finding.where
            assert finding.message.endswith(".") or finding.code.startswith("USD:")
            assert finding.hint
            assert str(DATA) not in finding.where + finding.message


def test_errors_come_first() -> None:
    severities = [f.severity for f in checked("CHK010")]
    assert severities == sorted(severities, key=["error", "warning", "info"].index)


def test_openusds_validators_run_beside_ours() -> None:
    assert "USD:JointInvalidPrimRel" in {f.code for f in checked("CHK041")}


def test_the_same_file_gives_the_same_findings() -> None:
    assert checked("CHK041") == check(str(DATA / "CHK041.usda"))


def test_a_file_that_changed_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "machine.usda"
    for name in ("CHK052", "CHK072"):
        text = (DATA / f"{name}.usda").read_text(encoding="utf-8")
        path.write_text(text.replace("./sound.usda", str(DATA / "sound.usda")), encoding="utf-8")
        assert ours(check(path)) == {name, "CHK012"}


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("absent.usda", None, "no such file"),
        (".", None, "is a folder"),
        ("machine.step", b"ISO-10303-21;", "not a USD file"),
        ("machine.usda", b"#usda 1.0\n(\n", "cannot be read"),
        ("machine.usdc", b"\x00\x01\x02", "cannot be read"),
    ],
)
def test_what_is_no_usd_is_one_sentence(tmp_path: Path, name: str, content: bytes | None, words: str) -> None:
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(YellowironError, match=words) as caught:
        check(tmp_path / name)
    assert caught.value.hint


@pytest.mark.slow
def test_values_of_a_wrong_type_are_findings_too(tmp_path: Path) -> None:
    """Every attribute of the sound machine, once with a value that it cannot have."""
    from pxr import Sdf, Usd

    types = Sdf.ValueTypeNames
    wrong = [(types.String, "x"), (types.Float, math.nan), (types.TokenArray, ["W"]), (types.Token, "W")]
    stage = Usd.Stage.Open(str(DATA / "sound.usda"))
    for index, attribute in enumerate(a for p in stage.TraverseAll() for a in p.GetAuthoredAttributes()):
        kind, value = wrong[index % len(wrong)]
        path = tmp_path / f"{index}.usda"
        layer = Sdf.Layer.CreateNew(str(path))
        layer.subLayerPaths.append(str(DATA / "sound.usda"))
        spec = Sdf.AttributeSpec(Sdf.CreatePrimInLayer(layer, attribute.GetPrimPath()), attribute.GetName(), kind)
        spec.default = value
        layer.Save()
        assert check(path), attribute.GetPath()
