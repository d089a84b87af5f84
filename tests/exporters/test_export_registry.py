"""Formats: ours, those that other packages bring, and those that nobody does."""

from __future__ import annotations

from pathlib import Path

import pytest

from kit.packages import install_package
from yellowiron.exporters import EXPORTERS, export, exporter_names, find_exporter
from yellowiron.exporters.registry import GROUP
from yellowiron.model.errors import YellowironError
from yellowiron.usd import read_mechanism

SOURCE = Path(__file__).parents[1] / "data" / "plugins" / "joint_table.py"
BROKEN = """
from yellowiron.exporters.registry import Exporter
EXPORTER = Exporter("nothing", "broken_exporter:write")
def write(mechanism, usd_file, folder):
    {deed}
"""


@pytest.fixture
def joint_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install_package(
        tmp_path / "site", monkeypatch, name="joint-table", group=GROUP,
        entries={"joints": "joint_table:EXPORTER"}, modules={"joint_table": SOURCE.read_text()},
    )  # fmt: skip


def test_ours_is_what_export_mjcf_writes(usd_file: Path, mjcf_file: Path, tmp_path: Path) -> None:
    written = export(read_mechanism(usd_file), usd_file, tmp_path, to="mjcf")
    assert written.parent == tmp_path and written.read_bytes() == mjcf_file.read_bytes()
    assert (tmp_path / find_exporter("mjcf").scene).is_file()


def test_another_package_writes_its_own(joint_table: None, usd_file: Path, tmp_path: Path) -> None:
    mechanism = read_mechanism(usd_file)
    lines = export(mechanism, usd_file, tmp_path, to="joints").read_text().splitlines()
    assert lines[0] == "joint,type,lower,upper"
    assert [line.split(",")[0] for line in lines[1:]] == [joint.name for joint in mechanism.joints]


def test_a_format_that_nobody_writes_is_said_with_those_there_are(joint_table: None) -> None:
    assert exporter_names() == (*EXPORTERS, "joints")
    words = r"no export to 'step' \(where: --to\) Hint: This version writes mjcf, mjcf-tendons, u"
    with pytest.raises(YellowironError, match=words):
        find_exporter("step")


@pytest.mark.parametrize(
    ("deed", "words"), [("return 1 / 0", "ZeroDivisionError: division by zero"), ("return None", "TypeError")]
)
def test_what_is_broken_is_one_sentence(
    deed: str, words: str, usd_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install_package(
        tmp_path, monkeypatch, name="broken", group=GROUP, entries={"broken": "broken_exporter:EXPORTER"},
        modules={"broken_exporter": BROKEN.format(deed=deed)},
    )  # fmt: skip
    with pytest.raises(YellowironError, match="The exporter 'broken' failed") as error:
        export(read_mechanism(usd_file), usd_file, tmp_path, to="broken")
    assert words in error.value.message


def test_none_takes_the_place_of_ours(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install_package(tmp_path, monkeypatch, name="thief", group=GROUP, entries={"mjcf": "thief:EXPORTER"})
    with pytest.raises(YellowironError, match="brings 'mjcf', a name that yellowiron has itself"):
        find_exporter("mjcf")
