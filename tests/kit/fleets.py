"""Manifests of small machines, and what a fleet's folder holds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

SETTINGS = ["Arm Angle Up=40 deg", "Arm Angle Down=20 deg"]

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
"""Readers that crash, hang and take all memory: a module, `faulty_readers`, of another package."""
FAULTY = {name.lower(): f"faulty_readers:{name}" for name in ("CRASH", "HANG", "MEMORY")}
"""Its entry points among CAD formats: a file's suffix, and its content in small letters, → reader."""


def write_manifest(folder: Path, machines: list[dict[str, Any]], **defaults: Any) -> Path:
    """A manifest of small machines, as JSON."""
    usual = {"type": "in/type", "set": SETTINGS, "page": False, "timeout": "120 s", **defaults}
    path = folder / "fleet.json"
    path.write_text(json.dumps({"defaults": usual, "machines": machines}))
    return path


def content(folder: Path) -> dict[str, bytes]:
    """Every file below a folder but those that tell times; the table without its last two columns."""
    found = {}
    for file in sorted(folder.rglob("*")):
        name = file.relative_to(folder).as_posix()
        if not file.is_file() or file.name in ("timings.json", "seconds.json", "seconds.js", "fleet.parquet"):
            continue
        found[name] = file.read_bytes()
        if file.name == "fleet.csv":
            found[name] = b"\n".join(line.rsplit(b",", 2)[0] for line in found[name].splitlines())
    return found
