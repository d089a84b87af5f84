"""The cache: nothing in it is run, and nothing of strangers is believed."""

from __future__ import annotations

import hashlib
import os
import pickle
from pathlib import Path

import numpy as np
import pytest

from yellowiron.support.caching.disk import cache_folder, remember
from yellowiron.support.files import answers


class Trap:
    def __init__(self, marker: Path) -> None:
        self.marker = marker

    def __reduce__(self) -> tuple[object, ...]:
        return (Path.touch, (self.marker,))


def entry(folder: Path, data: bytes) -> Path:
    path = folder / "hulls" / "key.kept"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data + hashlib.sha256(data).digest())
    return path


def arrays(value: float) -> bytes:
    return answers.dumps([(np.full(3, value),)])


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("YELLOWIRON_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def made() -> float:
    return float(remember("hulls", "key", lambda: (np.zeros(3),))[0][0])


def test_what_was_made_is_found_again(cache: Path) -> None:
    assert made() == 0.0
    assert cache.stat().st_mode & 0o077 == 0
    entry(cache, arrays(7.0))
    assert made() == 7.0


@pytest.mark.parametrize("kind", ["pickled array", "pickle"])
def test_a_pickle_is_never_run(kind: str, cache: Path, tmp_path: Path) -> None:
    marker = tmp_path / "ran"
    trap = Trap(marker) if kind == "pickle" else [(np.array([Trap(marker)], dtype=object),)]
    entry(cache, pickle.dumps(trap))
    assert made() == 0.0
    assert not marker.exists()


@pytest.mark.parametrize("open_to_all", ["", "hulls", "hulls/key.kept"])
def test_what_others_may_write_is_not_believed(open_to_all: str, cache: Path) -> None:
    entry(cache, arrays(7.0))
    assert made() == 7.0
    (cache / open_to_all).chmod(0o777)
    assert made() == 0.0
    assert (cache_folder() is None) == (open_to_all == "")


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give files away")
def test_another_user_s_is_not_believed(cache: Path) -> None:
    os.chown(entry(cache, arrays(7.0)), 12345, 12345)
    assert made() == 0.0
