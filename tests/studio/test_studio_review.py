"""A whole review of a real machine in the browser, by one who knows it: the ZX120, 20 of its decisions undone."""

from __future__ import annotations

import json
import random
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import strangers_models as strangers
from kit.scoring import true_bodies
from yellowiron.studio import Session, Setup

pytest.importorskip("starlette", reason="the extra 'studio' is not installed")
pytestmark = pytest.mark.slow

SECONDS, MOST = 4.0, 120.0
"""Of a decision or click; of the whole review."""
UNDONE = 20


@pytest.fixture(params=["with", "without"])
def review(
    request: pytest.FixtureRequest, shared_data: Path, tmp_path: Path
) -> Iterator[tuple[Session, dict[str, tuple[str, ...]], dict[str, str]]]:
    """A session of the machine, with names or without; part → bodies that it may be of; what was decided before."""
    model = next(m for m in strangers.models([shared_data]) if m.name == "zx120")
    scene = strangers.scene_of(model, names=request.param)
    assert model.cad is not None
    session = Session(Setup(scene.type, model.cad, tmp_path / "out"), assembly=scene.assembly)
    truth = true_bodies(session.assembly, session.settled(300).aligned, scene.truth, session.template)
    undone = random.Random(1).sample(sorted(truth), UNDONE)
    known = {p: bodies[0] for p, bodies in truth.items() if bodies and p not in undone}
    session.do(session.read({"kind": "role", "parts": {p: None if b == "-" else b for p, b in known.items()}}))
    session.settled(300)
    yield session, truth, known
    session.close()


def test_the_zx120_is_reviewed_in_two_minutes(
    browser: Any, review: tuple[Session, dict[str, tuple[str, ...]], dict[str, str]]
) -> None:
    from yellowiron.studio.server import serve

    session, truth, known = review
    told: list[str] = []
    ready = threading.Event()
    threading.Thread(
        target=serve, args=(session,), kwargs={"ready": lambda a: (told.append(a), ready.set())}, daemon=True
    ).start()
    assert ready.wait(30)
    page = browser.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    page.set_default_timeout(60_000)
    page.goto(told[0])
    page.locator("#queue button").first.wait_for()

    def solved() -> None:
        end = time.monotonic() + 180
        while not page.evaluate("yellowiron.state.solved === yellowiron.state.said && !yellowiron.waiting"):
            assert time.monotonic() < end
            time.sleep(0.05)

    def wrong() -> list[str]:
        bodies = {p.part: p.body or "-" for p in session.settled(180).aligned.parts}
        return [p for p, body in sorted(bodies.items()) if truth.get(p) and body not in truth[p]]

    actions = 0
    passed: set[str] = set()
    while (question := page.evaluate("yellowiron.question ?? null")) is not None:
        if question["key"] in passed:
            break
        # Yes to what is right and to a value that is offered; on to the next where there is nothing to say.
        right = question["kind"] == "parts" and not set(question["parts"]) & set(wrong())
        if right or (question["kind"] in ("value", "joint") and question["candidates"]):
            page.keyboard.press("Enter")
        else:
            passed.add(question["key"])
            page.keyboard.press("j")
        actions += 1
        page.wait_for_timeout(100)
        solved()
    # What is still wrong is found by its name, and its role by the role's.
    for part in wrong():
        page.keyboard.press("s")
        page.keyboard.type(part)
        page.keyboard.press("Enter")
        assert page.evaluate("[...yellowiron.selection].map(n => yellowiron.viewer.model.parts[n - 1].path)") == [part]
        page.keyboard.press("/")
        page.keyboard.type(truth[part][0].replace("_", " "))
        page.keyboard.press("Enter")
        actions += 2
        page.wait_for_timeout(100)
        solved()
    page.close()
    assert wrong() == []
    assert actions * SECONDS <= MOST, actions
    session.keep()
    kept = {e["part"]: e for e in json.loads((session.setup.out / "alignment.json").read_text())["parts"]}
    assert all(kept[part]["source"] in ("edited", "confirmed") for part in known)
    assert {p: kept[p]["body"] or "-" for p in known} == known
