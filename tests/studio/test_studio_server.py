"""The studio's address: for this computer and whoever has the token; two pages at once, and messages of all kinds."""

from __future__ import annotations

import json
import shutil
import threading
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from kit.builds import without_pages
from yellowiron.model.specification import Evidence, Specification, Specifications
from yellowiron.report.html.viewer import NOT_BUNDLED
from yellowiron.studio import Session, Setup

starlette = pytest.importorskip("starlette.testclient", reason="the extra 'studio' is not installed")
pytestmark = pytest.mark.slow
TOKEN, PORT = "a-token-of-this-test", 8123
HOST = f"127.0.0.1:{PORT}"


@pytest.fixture(scope="module")
def session(cad_read_once: None, example: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Session]:
    out = tmp_path_factory.mktemp("studio") / "machine"
    opened = Session(
        Setup("wheel_loader", example / "wheel_loader.step", out, sheets=(example / "specifications.pdf",))
    )
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def client(session: Session) -> Iterator[Any]:
    from yellowiron.studio.server import application

    studio = application(session, token=TOKEN, port=PORT)
    with starlette.TestClient(studio, base_url=f"http://{HOST}", headers={"X-Yellowiron-Token": TOKEN}) as opened:
        yield opened


PATHS = ["/", "/shapes", "/machine", "/state", "/sheet/1", "/events"]


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize(
    "headers",
    [
        {"X-Yellowiron-Token": ""}, {"X-Yellowiron-Token": TOKEN[:-1]},
        {"X-Yellowiron-Token": TOKEN + "é".encode().hex()},
        {"Host": "evil.example"}, {"Host": f"localhost.evil.example:{PORT}"}, {"Host": "127.0.0.1:1"},
        {"Origin": "http://evil.example"}, {"Origin": "null"}, {"Origin": f"https://{HOST}.evil.example"},
    ],
)  # fmt: skip
def test_strangers_get_nothing(client: Any, path: str, headers: dict[str, str]) -> None:
    answer = client.get(path, headers=headers)
    assert answer.status_code == 403
    assert len(answer.text) < 100


@pytest.mark.parametrize("path", ["/do", "/undo", "/redo", "/build", "/axis", "/rounds", "/patterns"])
def test_strangers_decide_nothing(client: Any, session: Session, path: str) -> None:
    before = session.said
    assert client.post(path, headers={"Origin": "http://evil.example"}, content=b"{}").status_code == 403
    assert client.post(path, headers={"X-Yellowiron-Token": "x"}, content=b"{}").status_code == 403
    assert client.get(path).status_code == 405
    assert session.said == before


@pytest.mark.parametrize(
    "path", ["/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/sheet/../../etc/passwd", "/sheet/..%2f1",
             "/data/studio.bundle.js",
             "/sheet/-1", "/sheet/99999", "/sheet/1e3", "//etc/passwd", "/state/../../x"],
)  # fmt: skip
def test_no_other_file_is_readable(client: Any, path: str) -> None:
    assert client.get(path).status_code == 404


def test_the_page_asks_for_nothing_else(client: Any) -> None:
    answer = client.get("/")
    policy = answer.headers["content-security-policy"]
    assert "default-src 'none'" in policy and "frame-ancestors 'none'" in policy
    nonce = policy.split("'nonce-")[1].split("'")[0]
    assert f'nonce="{nonce}"' in answer.text
    assert client.get("/").headers["content-security-policy"] != policy
    assert "src=" not in answer.text.split("<script")[0] and "{script}" not in answer.text
    assert answer.headers["cache-control"] == "no-store"


@pytest.mark.parametrize(
    "content", [b"", b"{", b"[]", b"null", b'"text"', b"\xff\xfe", b"[" * 100_000,
                b'{"kind": "role", "parts": {"x": "y"}}',
                b'{"kind": "role", "parts": {"x": {"y": 1}}}', b'{"kind": ["role"]}',
                b'{"kind": "role", "mirror": 1, "parts": 3}',
                b'{"kind": "rule", "name": "", "text": "boom"}', b'{"kind": "rule", "name": "*", "text": "x"}',
                b'{"kind": "rule", "name": ["*"], "text": "boom"}',
                b'{"kind": "rule", "name": "a\\nb", "text": "boom"}',
                b'{"kind": "joint", "name": "boom", "entry": 3}', b'{"kind": "joint", "name": "", "entry": {}}',
                b'{"kind": "joint", "name": "boom", "entry": {"axis": [1e999, 0, 0], "anchor": [0, 0, 0]}}',
                b'{"kind": "joint", "name": "boom", "entry": {"Body": ["boom", "nothing"]}}'],
)  # fmt: skip
def test_malformed_messages_change_nothing(client: Any, session: Session, content: bytes) -> None:
    before = session.history()
    answer = client.post("/do", content=content)
    assert answer.status_code == 400
    assert "\n" not in answer.json()["message"]
    assert session.history() == before


def test_large_messages_are_refused(client: Any, session: Session) -> None:
    before = session.history()
    assert client.post("/do", content=b"x" * (100 * 1024 * 1024)).status_code == 413
    assert client.post("/do", content=(b"x" * 65536 for _ in range(100))).status_code == 413
    assert client.post("/do", headers={"Content-Length": "-1"}, content=b"{}").status_code in (400, 413)
    assert session.history() == before


def test_two_pages_at_once_lose_no_decision(client: Any, session: Session) -> None:
    parts = list(session.parts)[:12]
    answers: list[int] = []

    def decide(some: list[str]) -> None:
        for part in some:
            entry = {"kind": "role", "parts": {part: "front_frame"}}
            answers.append(client.post("/do", content=json.dumps(entry)).status_code)

    pages = [threading.Thread(target=decide, args=(parts[k::2],)) for k in range(2)]
    for page in pages:
        page.start()
    for page in pages:
        page.join()
    assert answers == [200] * 12
    state = session.settled(60.0)
    assert {p.part: p.role for p in state.aligned.parts if p.part in parts} == dict.fromkeys(parts, "front_frame")
    lines = (session.setup.out / "studio.jsonl").read_text(encoding="utf-8").split("\n")
    assert sum('"do"' in line for line in lines) == 12
    for _ in parts:
        client.post("/undo", content=b"{}")
    assert not any(p.source == "edited" for p in session.settled(60.0).aligned.parts)


def test_pages_of_the_sheet(client: Any) -> None:
    state = client.get("/state").json()
    page = next(v["page"] for v in state["values"] if v["page"] is not None)
    answer = client.get(f"/sheet/{page}")
    assert answer.status_code == 200
    assert answer.content.startswith(b"\x89PNG")


def test_each_of_two_sheets_shows_its_own_page(session: Session, example: Path, tmp_path: Path) -> None:
    """Also where both say something on a page of the same number."""
    from yellowiron.studio.server import application

    sheets = (example / "specifications.pdf", tmp_path / "options.pdf")
    shutil.copy(*sheets)
    values = {
        sheet.name: Specification(
            sheet.stem, 1.0, "m", "ok", evidence=Evidence(sheet.name, 2, "", (x, 90.0, 300.0, 99.0))
        )
        for sheet, x in zip(sheets, (100.0, 250.0), strict=True)
    }
    two = SimpleNamespace(
        assembly=session.assembly, setup=replace(session.setup, sheets=sheets),
        state=replace(session.state, specifications=Specifications(values)), close=lambda: None,
    )  # fmt: skip
    studio = application(two, token=TOKEN, port=PORT)  # type: ignore[arg-type]
    with starlette.TestClient(studio, base_url=f"http://{HOST}", headers={"X-Yellowiron-Token": TOKEN}) as client:
        pages = [client.get("/sheet/2", params={"file": sheet.name}) for sheet in sheets]
        assert [page.status_code for page in pages] == [200, 200]
        assert pages[0].content != pages[1].content
        assert client.get("/sheet/2").content == pages[0].content
        for name in ("../options.pdf", str(sheets[1]), "other.pdf"):
            assert client.get("/sheet/2", params={"file": name}).status_code == 404


def test_a_build_writes_what_the_command_line_writes(
    client: Any, session: Session, example: Path, tmp_path: Path
) -> None:
    """The decisions of the page, built from it, and built by hand from a copy of its alignment.json."""
    part = next(p.part for p in session.state.aligned.parts if p.role == "boom")
    client.post("/do", content=json.dumps({"kind": "confirm", "parts": {part: "boom"}}))
    session.keep()
    copy = tmp_path / "alignment.json"
    copy.write_bytes((session.setup.out / "alignment.json").read_bytes())
    assert client.post("/build", content=b"{}").status_code == 200
    end = time.monotonic() + 120.0
    while (built := client.get("/state").json()["build"])["state"] == "running":
        assert time.monotonic() < end
        time.sleep(0.2)
    assert built["state"] == "ready", built
    from yellowiron import build

    with without_pages():
        machine = build(
            "wheel_loader", example / "wheel_loader.step", tmp_path / "machine",
            sheets=[example / "specifications.pdf"], alignment_file=copy,
        )  # fmt: skip
    for name in ("wheel_loader.usda", "scene.usda", "alignment.json", "specifications.json"):
        assert (session.setup.out / name).read_bytes() == (machine.folder / name).read_bytes(), name


def test_the_server_says_where_it_is_and_ends(example: Path, tmp_path: Path) -> None:
    import signal
    import subprocess
    import sys
    import urllib.request

    cad, out = str(example / "wheel_loader.step"), str(tmp_path / "machine")
    command = [sys.executable, "-m", "yellowiron", "studio", "wheel_loader", "--cad", cad, "--out", out, "--no-open"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[-1]
        assert address.startswith("http://127.0.0.1:")
        with urllib.request.urlopen(address, timeout=20) as answer:
            assert "<title>yellowiron studio</title>" in answer.read().decode()
        process.send_signal(signal.SIGTERM)
        assert process.wait(20) in (0, 143, -signal.SIGTERM)
    finally:
        process.kill()
        process.communicate()


def test_without_its_script_the_page_says_so(client: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("yellowiron.studio.server.script", lambda package, name: "")
    text = client.get("/").text
    assert NOT_BUNDLED in text and "{waiting}" not in text and "Loading" not in text
