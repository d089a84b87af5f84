"""A console that is closed, full, or knows few letters costs no traceback."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from kit.builds import console
from kit.planted import PACKAGE

LIST, SHOW, ERROR = "templates list", "templates show skid_steer", "templates show ünbekannt"
ASCII = "PYTHONUTF8=0 PYTHONCOERCECLOCALE=0 LC_ALL=C"
FULL = ">/dev/full"


def told(words: str, *, before: str = "", after: str = "") -> subprocess.CompletedProcess[str]:
    """What a command says in a shell."""
    program = f"{before} {sys.executable} -m yellowiron {words} {after}"
    environment = {**os.environ, "PYTHONPATH": str(PACKAGE.parent)}
    done = subprocess.run(
        ["bash", "-c", program], env=environment, capture_output=True, encoding="utf-8", errors="replace", timeout=60
    )
    assert "Traceback" not in done.stderr and "Exception" not in done.stderr, done.stderr
    return done


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "before", "after", "code", "said"),
    [
        (LIST, "", ">&-", 0, ""),
        (f"{LIST} --json", "", ">&-", 2, "cannot be printed: it is closed"),
        (LIST, "", FULL, 2, "cannot be printed: No space left on device"),
        (f"{LIST} --json", "", FULL, 2, "cannot be printed: No space left on device"),
        ("--help", "", FULL, 2, "cannot be printed"),
        ("--version", "", FULL, 2, "cannot be printed"),
        (ERROR, "", ">&- 2>&-", 2, ""),
        (ERROR, "", "2>/dev/full", 2, ""),
        (ERROR, ASCII, "", 2, "There is no equipment type"),
        (SHOW, ASCII, "", 0, ""),
        (LIST, "", "<&-", 0, ""),
        (SHOW, "", "| true; exit $((PIPESTATUS[0] & ~141))", 0, ""),
    ],
)
def test_no_traceback(words: str, before: str, after: str, code: int, said: str) -> None:
    done = told(words, before=before, after=after)
    # A reader that has gone is no error: 1, or 141 as of a signal; one that is slow to go takes everything.
    assert done.returncode == code, done.stderr
    assert said in done.stderr
    if said:
        assert [line.partition(": ")[0] for line in done.stderr.splitlines()] == ["error", "where", "hint"]


def test_json_is_whole_in_any_locale(root: Path) -> None:
    plain = console(*SHOW.split(), "--json", cwd=root)
    assert json.loads(plain.stdout) == json.loads(told(f"{SHOW} --json", before=ASCII).stdout)


@pytest.mark.slow
def test_a_closed_output_is_no_other_file_s(tmp_path: Path, small: Path) -> None:
    """The number of a closed standard output would be the next file's: what a library prints would be in it."""
    for streams in (">&-", ">&- 2>&-", "<&- >&- 2>&-"):
        target = tmp_path / "a.usda"
        assert told(f"convert {small}/small.glb --out {target}", after=streams).returncode == 0
        assert target.read_text().startswith("#usda 1.0")
