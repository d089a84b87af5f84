"""`align --model` and `build --model`: off unless asked for, refused at once where nothing is configured, and the
machine is the same to the byte whatever the model says."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from doubted_machine import Doubted
from opinion_models import agreeing, lying, playing

from kit.builds import console
from kit.endpoint import SECRET, serving
from yellowiron.report import page as report_page

TALES = {"alignment.json", "report.json", "report.html", "timings.json"}
"""Files of a build that tell what was said."""


@pytest.fixture
def cad(doubted: Doubted, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file that is read as the machine in doubt."""
    file = tmp_path / "machine.glb"
    file.write_bytes(b"glTF\x02\x00\x00\x00" + bytes(64))
    monkeypatch.setattr("yellowiron.cad.read_cad", lambda path: doubted.assembly)
    return file


def said(*words: str | Path, cwd: Path) -> tuple[int, Any]:
    done = console(*words, "--json", cwd=cwd)
    return done.returncode, json.loads(done.stdout)


@pytest.mark.slow
def test_nobody_is_asked_without_the_option(
    doubted: Doubted, cad: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with serving(playing(lying(doubted))) as server:
        monkeypatch.setenv("YELLOWIRON_LLM_URL", server.url)
        monkeypatch.setenv("YELLOWIRON_LLM_MODEL", "seer")
        code, document = said("align", "excavator", cad, cwd=tmp_path)
    assert (code, server.bodies) == (1, [])
    assert not any("suggestion" in part for part in document["parts"])


@pytest.mark.parametrize("command", [("align", "excavator"), ("build", "excavator", "--out", "machine", "--cad")])
def test_a_model_that_is_not_configured_is_said_before_anything_slow(
    command: tuple[str, ...], cad: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("yellowiron.cad.read_cad", None)
    code, document = said(*command, cad, "--model", cwd=tmp_path)
    assert code == 2 and document["error"]["message"] == "No language model is configured"
    assert "YELLOWIRON_LLM_URL" in document["error"]["hint"] and not (tmp_path / "machine").exists()
    code, document = said(*command, cad, "--model", "--llm-replay", "absent.jsonl", cwd=tmp_path)
    assert code == 2 and "cannot be opened" in document["error"]["message"]


@pytest.mark.slow
def test_align_asks_tells_and_replays(
    doubted: Doubted, cad: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("yellowiron.opinion.asking.MOST", 2)
    words = ("align", "excavator", cad, "--out", "alignment.json", "--model", "--llm-model", "seer")
    with serving(playing(lying(doubted))) as server:
        monkeypatch.setenv("YELLOWIRON_LLM_KEY", SECRET)
        code, first = said(*words, "--llm-url", server.url, "--llm-record", "said.jsonl", cwd=tmp_path)
    assert code == 1 and len(server.bodies) == 2 and server.headers[0]["Authorization"] == f"Bearer {SECRET}"
    asked = [part for part in first["parts"] if "suggestion" in part]
    assert asked and all(p["suggestion"]["model"] == "seer" != p["body"] != p["suggestion"]["body"] for p in asked)
    (told,) = (f for f in first["findings"] if f["code"] == "ALN030")
    assert "agrees on 0 and points elsewhere on 2" in told["message"]
    written = (tmp_path / "alignment.json").read_bytes()
    code, again = said(*words, "--llm-replay", "said.jsonl", cwd=tmp_path)
    assert (code, again) == (1, first) and (tmp_path / "alignment.json").read_bytes() == written


@pytest.mark.slow
def test_a_machine_is_the_same_whatever_the_model_says(
    doubted: Doubted, cad: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("yellowiron.opinion.asking.pictures_of", lambda stage, parts: (b"whole", b"alone"))
    pages: dict[str, str] = {}

    def built(name: str, *words: str) -> dict[str, bytes]:
        def drawn(*given: Any, **more: Any) -> str:
            pages[name] = report_page(*given, **more)
            return pages[name]

        monkeypatch.setattr("yellowiron.report.page", drawn)
        done = console("build", "excavator", "--cad", cad, "--out", name, *words, "--quiet", cwd=tmp_path)
        assert done.returncode == 1, done.stderr
        folder = tmp_path / name
        return {str(f.relative_to(folder)): f.read_bytes() for f in sorted(folder.rglob("*")) if f.is_file()}

    plain = built("plain")
    for played in (lying, agreeing):
        with serving(playing(played(doubted))) as server:
            model = ("--model", "--llm-url", server.url, "--llm-model", "seer")
            asked = built(played.__name__, *model)
        assert server.bodies and asked.keys() == plain.keys()
        assert {name for name in plain if asked[name] != plain[name]} == TALES
        report, other = (json.loads(files["report.json"]) for files in (plain, asked))
        told = [f for f in other.pop("findings") if f not in report["findings"]]
        assert [f["code"] for f in told] == ["ALN030"] and report.pop("findings") and other == report
        assert f"seer {'agrees' if played is agreeing else 'points to'}" in pages[played.__name__]
