"""Unusable input: one sentence, where, a hint, exit code 2, no traceback, nothing written."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from kit.builds import console

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("no_pages", "cad_read_once")]

STEP_HEAD = "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nENDSEC;\nDATA;\n"
OLE = bytes.fromhex("D0CF11E0A1B11AE1") + b"\0" * 4096


def encrypted_pdf(path: Path) -> None:
    from reportlab.lib import pdfencrypt
    from reportlab.pdfgen import canvas

    page = canvas.Canvas(str(path), encrypt=pdfencrypt.StandardEncryption("secret", canPrint=0))
    page.drawString(100, 700, "Lift cylinder stroke 764 mm")
    page.save()


def template(path: Path, document: str, joints: object) -> None:
    path.mkdir()
    (path / "hierarchy.json").write_text(document, encoding="utf-8")
    (path / "joints.json").write_text(json.dumps(joints), encoding="utf-8")


HIERARCHY = json.dumps(
    {"machine": {"rigid body": "N", "child": {"frame": {"rigid body": "Y", "child": {}},
                                              "arm": {"rigid body": "Y", "child": {}}}}}
)  # fmt: skip
CYCLE = json.dumps({"frame": ["arm"], "arm": ["frame"]})
Prepare = Callable[[Path, Path], list[str | Path]]


def no_such_type(folder: Path, example: Path) -> list[str | Path]:
    return ["wheel_laoder", "--cad", example / "wheel_loader.step"]


def cad(name: str, content: bytes) -> Prepare:
    def prepare(folder: Path, example: Path) -> list[str | Path]:
        (folder / name).write_bytes(content)
        return ["wheel_loader", "--cad", folder / name]

    return prepare


def truncated(folder: Path, example: Path) -> list[str | Path]:
    content = (example / "wheel_loader.step").read_bytes()
    return cad("truncated.step", content[: len(content) // 3])(folder, example)


def absent(folder: Path, example: Path) -> list[str | Path]:
    return ["wheel_loader", "--cad", folder / "absent.step"]


def sheet(name: str, write: Callable[[Path], object]) -> Prepare:
    def prepare(folder: Path, example: Path) -> list[str | Path]:
        write(folder / name)
        return ["wheel_loader", "--cad", example / "wheel_loader.step", "--specs", folder / name]

    return prepare


def joint_to_nowhere(folder: Path, example: Path) -> list[str | Path]:
    template(folder / "type", HIERARCHY, {"j": {"joint_type": "Revolute", "Body": ["frame", "boom"]}})
    return [folder / "type", "--cad", example / "wheel_loader.step"]


def cycle(folder: Path, example: Path) -> list[str | Path]:
    (folder / "type").mkdir()
    (folder / "type" / "relations.json").write_text(CYCLE, encoding="utf-8")
    joints = {"j": {"joint_type": "Revolute", "Body": ["frame", "arm"]}}
    (folder / "type" / "joints.json").write_text(json.dumps(joints), encoding="utf-8")
    return [folder / "type", "--cad", example / "wheel_loader.step"]


def alignment_names_a_part_that_is_gone(folder: Path, example: Path) -> list[str | Path]:
    document = {"parts": [{"part": "GONE/Solid99", "role": "boom", "source": "edited"}]}
    (folder / "alignment.json").write_text(json.dumps(document), encoding="utf-8")
    return ["wheel_loader", "--cad", example / "wheel_loader.step", "--alignment", folder / "alignment.json"]


CASES: dict[str, tuple[Prepare, str]] = {
    "no such type": (no_such_type, "wheel_loader"),
    "no such CAD file": (absent, "absent.step"),
    "empty CAD": (cad("empty.step", b""), "empty.step"),
    "truncated CAD": (truncated, "truncated.step"),
    "not CAD": (cad("notes.step", b"Dear colleague, please find attached nothing."), "notes.step"),
    "STEP without a solid": (cad("hollow.step", (STEP_HEAD + "ENDSEC;\nEND-ISO-10303-21;\n").encode()), "hollow.step"),
    "SolidWorks": (cad("loader.sldasm", OLE), "STEP"),
    "Revit": (cad("loader.rvt", OLE), "IFC"),
    "encrypted PDF": (sheet("secret.pdf", encrypted_pdf), "secret.pdf"),
    "no PDF": (sheet("sheet.pdf", lambda p: p.write_text("stroke 764 mm")), "sheet.pdf"),
    "empty PDF": (sheet("empty.pdf", lambda p: p.write_bytes(b"")), "empty.pdf"),
    "joint to nowhere": (joint_to_nowhere, "boom"),
    "cycle in the hierarchy": (cycle, "frame"),
    "alignment names a part that is gone": (alignment_names_a_part_that_is_gone, "GONE/Solid99"),
}


def run(arguments: list[str | Path], out: Path) -> subprocess.CompletedProcess[str]:
    return console("build", *arguments, "--out", out, cwd=out.parent)


def assert_one_sentence(outcome: subprocess.CompletedProcess[str], word: str) -> None:
    assert outcome.returncode == 2, outcome.stdout + outcome.stderr
    assert "Traceback" not in outcome.stderr
    assert outcome.stdout == ""
    lines = outcome.stderr.strip().splitlines()[-3:]  # behind the steps that were done
    assert lines[0].startswith("error: ")
    assert any(line.startswith("where: ") for line in lines)
    assert any(line.startswith("hint:  ") for line in lines)
    assert word in outcome.stderr


@pytest.mark.parametrize("case", CASES)
def test_bad_input_is_one_clear_sentence(case: str, example: Path, tmp_path: Path) -> None:
    prepare, word = CASES[case]
    arguments = prepare(tmp_path, example)
    before = sorted(tmp_path.rglob("*"))
    assert_one_sentence(run(arguments, tmp_path / "out"), word)
    assert sorted(tmp_path.rglob("*")) == before, "nothing is written, not even half"


def test_an_output_folder_that_is_a_file_is_refused(example: Path, tmp_path: Path) -> None:
    (tmp_path / "out").write_text("mine", encoding="utf-8")
    assert_one_sentence(run(["wheel_loader", "--cad", example / "wheel_loader.step"], tmp_path / "out"), "out")
    assert (tmp_path / "out").read_text(encoding="utf-8") == "mine"


def test_an_output_folder_that_cannot_be_made_is_refused(example: Path) -> None:
    # /proc takes no new folder from anybody, root included.
    arguments = ["build", "wheel_loader", "--cad", str(example / "wheel_loader.step"), "--out", "/proc/yellowiron/out"]
    outcome = subprocess.run(
        [sys.executable, "-m", "yellowiron", *arguments], capture_output=True, text=True, timeout=300
    )
    assert_one_sentence(outcome, "/proc/yellowiron/out")


def test_a_pdf_without_text_leaves_the_machine_built(example: Path, tmp_path: Path) -> None:
    from PIL import Image

    Image.new("RGB", (600, 800), "white").save(tmp_path / "scan.pdf")
    outcome = run(
        ["wheel_loader", "--cad", example / "wheel_loader.step", "--specs", tmp_path / "scan.pdf"], tmp_path / "out"
    )
    assert outcome.returncode == 1, outcome.stderr
    report = json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    statuses = {s["name"]: s["status"] for s in report["specifications"]}
    assert statuses["Lift Cylinder Stroke"] == "unreadable"
    assert "Lift Cylinder Stroke" in report["missing"]
    assert (tmp_path / "out" / "wheel_loader.usda").exists()


@pytest.mark.parametrize(
    ("option", "value", "word"),
    [
        ("--specs", "nope.pdf", "nope.pdf cannot be read"),
        ("--specs", "no.txt", "is not a PDF"),
        ("--data", "nope.json", "cannot be read"),
        ("--data", "no.txt", "not JSON"),
        ("--alignment", "nope.json", "The alignment cannot be read"),
        ("--cad", "nope.step", "no such CAD file"),
        ("--out", "no.txt", "is a file"),
        ("--set", "X=3", "called 'X'"),
        ("TYPE", "no_type", "no equipment type"),
    ],
)
def test_inputs_are_looked_at_before_anything_is_loaded(
    option: str, value: str, word: str, example: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every one of them, before the pipeline's libraries are imported: that alone takes more than a second."""
    (tmp_path / "no.txt").write_text("nothing", encoding="utf-8")
    monkeypatch.setitem(sys.modules, "yellowiron.pipeline", None)
    given = {"TYPE": "wheel_loader", "--cad": str(example / "wheel_loader.step"), "--out": "out", option: value}
    kind = given.pop("TYPE")
    outcome = console("build", kind, *[w for pair in given.items() for w in pair], cwd=tmp_path)
    assert outcome.returncode == 2 and word in outcome.stderr, outcome.stderr
    assert sorted(p.name for p in tmp_path.iterdir()) == ["no.txt"]
