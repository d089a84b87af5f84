"""Small machines to build, each in a second or two; readers that crash, hang and take all memory, as a package."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from kit.packages import install_package
from kit.small import write_small

READERS = """
import os, re, signal, time
from yellowiron.cad.formats import CadFormat

CRASH = CadFormat("crash", (".crash",), "faulty_readers:crash", content=re.compile(rb"CRASH"))
HANG = CadFormat("hang", (".hang",), "faulty_readers:hang", content=re.compile(rb"HANG"))
MEMORY = CadFormat("memory", (".memory",), "faulty_readers:memory", content=re.compile(rb"MEMORY"))

def crash(path):
    os.kill(os.getpid(), signal.SIGSEGV)

def hang(path):
    while True:
        time.sleep(1)

def memory(path):
    held = []
    while True:
        held.append(bytearray(os.urandom(1 << 20)) * 16)
        time.sleep(0.002)
"""


@pytest.fixture
def inputs(tmp_path: Path) -> Path:
    """A folder with two small machines and their type, an empty file, one that is no CAD, and half a STEP file."""
    folder = tmp_path / "in"
    write_small(folder)
    shutil.copy(folder / "small.glb", folder / "other.glb")
    (folder / "empty.step").touch()
    (folder / "wrong.txt").write_text("no machine")
    return folder


@pytest.fixture
def faulty_readers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, inputs: Path) -> None:
    """Formats of another package whose readers crash, hang and take all memory; a file of each."""
    entries = {name.lower(): f"faulty_readers:{name}" for name in ("CRASH", "HANG", "MEMORY")}
    install_package(
        tmp_path / "site", monkeypatch, name="faulty-readers", group="yellowiron.cad_formats", entries=entries,
        modules={"faulty_readers": READERS},
    )  # fmt: skip
    for name in ("CRASH", "HANG", "MEMORY"):
        (inputs / f"bad.{name.lower()}").write_text(name)
