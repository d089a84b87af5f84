"""The film: what it shows in which order, the same every time, and what it refuses."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

from yellowiron import build, film
from yellowiron.cli.application import app
from yellowiron.film import film as made
from yellowiron.model.errors import YellowironError

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def machine(
    cad_read_once: None, kept_stages: None, example: Path, no_pages: None, tmp_path_factory: pytest.TempPathFactory
) -> Any:
    return build("wheel_loader", example / "wheel_loader.step", tmp_path_factory.mktemp("film") / "machine",
                 sheets=[example / "specifications.pdf"])  # fmt: skip


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Few frames; the size stays, so that what is drawn over them has its place."""
    monkeypatch.setattr(film, "RATE", 3)


def test_what_it_shows(machine: Any, small: None, example: Path, tmp_path: Path) -> None:
    sheet = example / "specifications.pdf"
    drawn = film.machine_triangles(machine.mechanism, machine.assembly, np.asarray(machine.alignment.frame))
    frames = list(film._frames(machine, drawn, [sheet]))
    captions = [frame.caption for frame in frames]
    assert captions[0] == "383 parts of a CAD model"
    turning = sum(joint.type != "fixed" for joint in machine.mechanism.joints)
    assert f"{turning} joints on their pins" in captions
    assert any(c.startswith("Lift Cylinder Stroke: ") and "page 2 of specifications.pdf" in c for c in captions)
    worked = [c for c in captions if c.startswith(("Boom ", "Bucket ", "Steering "))]
    assert len(worked) == 3 * 3 * 2 and all("MuJoCo, " in c for c in worked)
    told = [re.search(r"(\d+) mm out.* ([\d.]+) m (high|deep), at .*° .* ([\d.]+) s$", c) for c in worked[:6]]
    strokes, heights, ways, seconds = zip(*(t.groups() for t in told if t is not None), strict=True)
    assert ways == ("high", "deep", *["high"] * 4)
    for values, most in ((strokes, 700.0), (heights, 4.0)):
        assert max(map(float, values)) - min(map(float, values)) > most
    assert len(seconds) == 6 and [float(s) for s in seconds] == sorted(float(s) for s in seconds)
    assert frames[0].shot.apart > 0.0 == frames[-1].shot.apart
    # Without a sheet nothing is read.
    assert not any("Stroke" in f.caption for f in film._frames(machine, drawn, []))

    target = made(machine, tmp_path / "film.gif", sheets=[sheet])
    with Image.open(target) as moving:
        # Frames that are as the one before are one.
        assert len(frames) - 4 <= moving.n_frames <= len(frames) and moving.size == film.SIZE
        first = np.asarray(moving.convert("RGB"), dtype=int)
        moving.seek(moving.n_frames - 1)
        last = np.asarray(moving.convert("RGB"), dtype=int)
    colored = [int((np.ptp(picture[:400], axis=2) > 60).sum()) for picture in (first, last)]
    assert colored[0] < 0.1 * colored[1]
    again = made(machine, tmp_path / "again.gif", sheets=[sheet])
    assert again.read_bytes() == target.read_bytes()


def test_where_no_engine_does_it_the_kinematics_does(
    machine: Any, small: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: object, **__: object) -> None:
        raise YellowironError("The engine is on strike", where="here")

    monkeypatch.setattr(film.simulation, "watch", refused)
    drawn = film.machine_triangles(machine.mechanism, machine.assembly, np.asarray(machine.alignment.frame))
    told: list[str] = []
    worked = [f for f in film._frames(machine, drawn, [], told.append) if f.caption.endswith("by kinematics")]
    assert any("kinematics" in words and "on strike" in words for words in told)
    heights = [float(f.caption.split(" m high")[0].split()[-1]) for f in worked
               if f.caption.startswith("Boom ") and " m high" in f.caption]  # fmt: skip
    assert len(worked) == 3 * 3 * 2 and max(heights) - min(heights) > 1.0


def test_what_it_refuses(machine: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(YellowironError, match="extensions"):
        made(machine, tmp_path / "film.avi")
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(YellowironError, match="ffmpeg"):
        made(machine, tmp_path / "film.mp4")
    assert list(tmp_path.iterdir()) == []


def test_the_command_draws_no_report(
    cad_read_once: None,
    kept_stages: None,
    example: Path,
    tmp_path: Path,
    small: None,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    folder = tmp_path / "machine"
    build("wheel_loader", example / "wheel_loader.step", folder, page=False)
    assert (folder / "report.json").is_file() and not (folder / "report.html").exists()

    def drawn(*_: object, **__: object) -> str:
        raise AssertionError("a page was drawn")

    monkeypatch.setattr("yellowiron.report.page", drawn)
    target = tmp_path / "film.gif"
    assert CliRunner().invoke(app, ["film", str(folder), "--out", str(target)]).exit_code == 0
    assert target.stat().st_size > 10_000
