"""Every case of the table is one sentence, where and a hint; nothing is written, and nothing takes long."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from hostile_cases import CASES, Case

from kit.builds import console


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=[f"{c.group}: {c.name}" for c in CASES])
def test_it_is_one_sentence(case: Case, small: Path, tmp_path: Path) -> None:
    case.make(tmp_path)
    before = sorted([*tmp_path.rglob("*"), *small.rglob("*")])
    begin = time.monotonic()
    outcome = console(*case.words(tmp_path, small), cwd=tmp_path)
    assert time.monotonic() - begin < 20.0
    assert outcome.returncode == 2, outcome.stdout + outcome.stderr
    assert outcome.stdout == ""
    kinds = [line.partition(": ")[0] for line in outcome.stderr.splitlines()[-3:]]
    assert kinds == ["error", "where", "hint"], outcome.stderr
    assert case.word in outcome.stderr
    assert sorted([*tmp_path.rglob("*"), *small.rglob("*")]) == before
