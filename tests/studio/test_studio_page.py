"""The page in a real browser (Chromium, drawing in software): a review by keys alone, and what it looks like."""

from __future__ import annotations

import json
import math
import os
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from yellowiron.studio import Session, Setup

pytest.importorskip("starlette", reason="the extra 'studio' is not installed")
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def session(
    cad_read_once: None, kept_stages: None, example: Path, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Session]:
    out = tmp_path_factory.mktemp("studio") / "machine"
    opened = Session(Setup("wheel_loader", example / "wheel_loader.step", out))
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def page(browser: Any, session: Session) -> Iterator[tuple[Any, list[str]]]:
    """The page, and what the console complained of."""
    from yellowiron.studio.server import serve

    told: list[str] = []
    ready = threading.Event()

    def heard(address: str) -> None:
        told.append(address)
        ready.set()

    threading.Thread(target=serve, args=(session,), kwargs={"ready": heard}, daemon=True).start()
    assert ready.wait(30)
    opened = browser.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
    opened.set_default_timeout(60_000)
    errors: list[str] = []
    opened.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.goto(told[0])
    opened.locator("#queue button").first.wait_for()
    yield opened, errors
    opened.close()


def until(holds: Callable[[], bool], seconds: float = 60.0) -> None:
    """Waits; `holds` has to ask the page something, since requests that a test answers reach it only then."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_the_whole_review_by_keys_alone(page: tuple[Any, list[str]], session: Session) -> None:
    opened, errors = page
    heading = opened.locator("#card h2")

    def solved() -> None:
        until(lambda: bool(opened.evaluate("yellowiron.state.solved === yellowiron.state.said && !yellowiron.waiting")))

    # Three strokes are asked; what the cylinder's piston can travel is offered, and taken by Enter.
    assert opened.locator("#count").inner_text() == "3 questions"
    first = heading.inner_text()
    opened.keyboard.press("j")
    assert heading.inner_text() != first
    opened.keyboard.press("k")
    assert heading.inner_text() == first
    opened.keyboard.press("Enter")
    until(lambda: heading.inner_text() != first)
    solved()
    assert opened.locator("#count").inner_text() == "2 questions"
    assert session.state.specifications.number(first.removesuffix("?")) is not None

    # Back, and again.
    opened.keyboard.press("u")
    until(lambda: opened.locator("#count").inner_text() == "3 questions")
    opened.keyboard.press("Shift+U")
    solved()
    assert opened.locator("#count").inner_text() == "2 questions"

    # A part is selected from the list, taken with its assembly, and given a role that is found by its name.
    part = next(p.part for p in session.state.aligned.parts if p.role == "front_frame")
    number = opened.evaluate("path => yellowiron.numbers.get(path)", part)
    opened.evaluate("number => yellowiron.choose(number, null)", number)
    assert "Selected" in opened.locator("#card").inner_text()
    opened.keyboard.press("/")
    opened.keyboard.type("rear frame")
    opened.keyboard.press("Enter")
    until(lambda: session.settled(60).aligned.parts[0] is not None and len(session.history()[0]) == 2)
    solved()
    assert {p.part: p.role for p in session.state.aligned.parts}[part] == "rear_frame"
    opened.evaluate("number => yellowiron.choose(number, null)", number)
    opened.keyboard.press("a")
    assert "parts selected" in opened.locator("#card").inner_text()
    opened.keyboard.press("Escape")
    opened.keyboard.press("u")
    solved()
    assert {p.part: p.role for p in session.state.aligned.parts}[part] == "front_frame"
    kept = json.loads((session.setup.out / "alignment.json").read_text(encoding="utf-8"))
    assert len(kept["values"]) == 1
    assert not [e for e in kept["parts"] if e["source"] == "edited"]
    opened.keyboard.press("?")
    assert opened.locator("#keys").is_visible()
    opened.keyboard.press("Escape")
    assert not errors


def test_the_whole_machine_by_keys(page: tuple[Any, list[str]], session: Session) -> None:
    opened, errors = page

    def ahead() -> list[float]:
        until(lambda: bool(opened.evaluate("yellowiron.state.solved === yellowiron.state.said && !yellowiron.waiting")))
        return [round(float(v), 3) for v in np.asarray(session.settled(60).aligned.frame)[0, :3]]

    before = ahead()
    asked = opened.locator("#card h2").inner_text()
    opened.keyboard.press("v")
    opened.keyboard.type("other end")
    opened.keyboard.press("Enter")
    assert ahead() == [-v for v in before]
    assert "Forward is" in opened.locator("#history").text_content()
    opened.keyboard.press("u")
    assert ahead() == before
    assert opened.locator("#card h2").inner_text() == asked  # the question that was open is open
    assert not errors


def test_the_machine_moves(page: tuple[Any, list[str]], session: Session) -> None:
    opened, errors = page
    sliders = opened.evaluate("yellowiron.viewer.sliders.map((slider) => slider.name)")
    assert {"boom", "bucket"} <= set(sliders)
    # Without a sheet too, every actuator has one.
    assert {a.name for a in session.state.solved.mechanism.actuators} <= set(sliders)  # type: ignore[union-attr]
    before = opened.evaluate("yellowiron.viewer.pose.bucket")
    opened.evaluate("yellowiron.viewer.set('boom', yellowiron.viewer.sliders.find((s) => s.name === 'boom').range[1])")
    after = opened.evaluate("yellowiron.viewer.pose.bucket")
    assert abs(after[14] - before[14]) > 0.5
    assert not errors


def test_a_frame_is_a_few_calls_however_many_parts(page: tuple[Any, list[str]]) -> None:
    opened, errors = page
    calls = opened.evaluate("""() => {
      const { viewer } = yellowiron;
      const { gl } = viewer.renderer;
      let count = 0;
      for (const name of ["drawElements", "drawArrays", "drawElementsInstanced", "drawArraysInstanced"]) {
        gl[name] = (...all) => (count++, WebGL2RenderingContext.prototype[name].apply(gl, all));
      }
      const drawn = (light) => {
        viewer.light(light);
        viewer.move({});
        count = 0;
        viewer.draw(1);
        return count;
      };
      const found = [drawn(null), drawn(new Set([1])), drawn(new Set(viewer.model.parts.map((part) => part.number)))];
      ["drawElements", "drawArrays", "drawElementsInstanced", "drawArraysInstanced"].forEach((name) => delete gl[name]);
      viewer.light(null);
      return [...found, viewer.model.parts.length];
    }""")
    assert 0 < max(calls[:3]) <= 8 < calls[3]
    assert not errors


def test_a_joint_is_pointed_at(page: tuple[Any, list[str]], session: Session) -> None:
    opened, errors = page
    opened.evaluate("yellowiron.viewer.reset()")
    opened.get_by_role("tab", name="Joints").click()
    opened.locator("#joints").get_by_role("button", name="Front frame to boom", exact=True).click()
    assert "Front frame to boom" in opened.locator("#card").inner_text()
    assert opened.locator(".v-axis line").count() == 1
    opened.evaluate("yellowiron.viewer.reset()")
    # A pixel at which something round of the machine is seen, and what is round there.
    found = opened.evaluate("""async () => {
      const { viewer } = yellowiron;
      for (let y = 150; y < 800; y += 12) for (let x = 60; x < 640; x += 12) {
        const hit = viewer.surfaceAt(x, y);
        if (!hit) continue;
        const answer = await fetch("axis", { method: "POST", body: JSON.stringify({ picks: [hit] }),
          headers: { "X-Yellowiron-Token": new URLSearchParams(location.search).get("token") } });
        if (answer.ok) return { x, y, hit, ...(await answer.json()) };
      }
    }""")
    part = session.assembly.part(found["part"])
    features = session.assembly.shape_of(part).cylinders
    offsets = [np.array(found["point"]) - np.array(f.point) for f in features]
    away = [
        np.linalg.norm(o - (o @ f.direction) * np.array(f.direction)) for o, f in zip(offsets, features, strict=True)
    ]
    assert min(away) < 1e-6
    spot = np.array(found["hit"]["point"]) - np.array(found["point"])
    off = np.linalg.norm(spot - (spot @ found["direction"]) * np.array(found["direction"]))
    assert min(abs(off - f.radius) for f in features) < 0.12 * off + 2e-3

    errors.clear()  # of places that are not round

    opened.keyboard.press("p")
    box = opened.locator("canvas").bounding_box()
    opened.mouse.click(box["x"] + found["x"], box["y"] + found["y"])
    opened.locator(".v-meant line").wait_for()
    assert found["words"] in opened.locator("#card").inner_text()
    opened.keyboard.press("Enter")
    until(lambda: "Given by a person" in opened.locator("#card").inner_text())
    until(lambda: "front_frame2boom_joint" in session.settled(60.0).aligned.by_hand)
    opened.keyboard.press("u")
    until(lambda: session.settled(60.0).aligned.joints == {})
    opened.evaluate("yellowiron.viewer.move({})")
    # Its upper stop is where it is now: where the machine starts, or, where that is beyond a stop, at the stop.
    name = "front_frame2boom_joint"
    began = math.degrees(session.state.solved.started.get(name, 0.0))  # type: ignore[union-attr]
    opened.keyboard.press("]")
    until(lambda: name in session.settled(60.0).aligned.joints)
    assert session.state.aligned.joints[name]["Limit"][1] == pytest.approx(began, abs=0.5)  # type: ignore[index]
    opened.keyboard.press("u")
    until(lambda: session.settled(60.0).aligned.joints == {})
    opened.keyboard.press("Escape")
    opened.get_by_role("tab", name="Move").click()
    assert not errors


def test_parts_by_body_and_as_the_cad_model_has_them(page: tuple[Any, list[str]], session: Session) -> None:
    opened, errors = page
    opened.get_by_role("tab", name="Parts").click()
    heads = opened.locator(".v-list > details > summary")
    assert heads.count() > 10
    opened.get_by_role("button", name="CAD tree").click()
    roots = {part.split("/")[0] for part in session.parts}
    assert heads.count() == len(roots)
    heads.first.click()
    inside = opened.locator(".v-list > details > details > summary")
    inside.first.wait_for()
    assert inside.count() == len({part.split("/")[1] for part in session.parts if part.count("/") > 1})
    opened.get_by_role("button", name="CAD tree").click()
    opened.get_by_role("tab", name="Move").click()
    assert not errors


def test_parts_nobody_asks_about_are_found_by_keys(page: tuple[Any, list[str]]) -> None:
    opened, errors = page
    parts = opened.evaluate("yellowiron.viewer.model.parts.filter(p => !p.hidden).map(p => [p.number, p.path])")
    path_of = dict(parts)
    paths = list(path_of.values())

    def selected() -> list[str]:
        return [path_of[n] for n in opened.evaluate("[...yellowiron.selection]")]

    opened.keyboard.press("Escape")
    opened.keyboard.press("s")
    opened.keyboard.type(paths[5].split("/")[-1])
    opened.keyboard.press("Enter")
    assert selected() == [paths[5]]
    opened.keyboard.press("n")
    assert selected() == [paths[6]]
    opened.keyboard.press("Shift+N")
    opened.keyboard.press("Shift+N")
    assert selected() == [paths[4]]
    # One more beside it.
    opened.keyboard.press("s")
    opened.keyboard.type(paths[9])
    opened.keyboard.press("Alt+Enter")
    assert selected() == [paths[4], paths[9]]
    # What is listed for an assembly is all that is in it.
    assembly = paths[5].split("/")[0]
    opened.keyboard.press("s")
    opened.keyboard.type(f"{assembly}/")
    opened.keyboard.press("Shift+Enter")
    assert selected() == [p for p in paths if f"{assembly}/".lower() in p.lower()]
    assert len(selected()) > 1
    opened.keyboard.press("s")
    opened.keyboard.type("no such part")
    assert "No part or joint of that name" in opened.locator("#found").inner_text()
    opened.keyboard.press("Escape")
    opened.keyboard.press("Escape")
    assert selected() == []
    assert errors == []


def test_the_other_keys_do_what_they_say(page: tuple[Any, list[str]], session: Session) -> None:
    """M, I, F, X, a number, B: with a part selected, and with a value asked."""
    opened, errors = page

    def solved() -> None:
        until(lambda: bool(opened.evaluate("yellowiron.state.solved === yellowiron.state.said && !yellowiron.waiting")))

    hidden = "yellowiron.viewer.model.parts.filter(p => p.hidden).length"
    part = next(p.part for p in session.settled(60).aligned.parts if p.role == "bucket")
    opened.keyboard.press("Escape")
    # The question that is asked, and the row that Enter takes, are seen.
    assert opened.locator("#queue [aria-current=true]").count() == 1
    opened.keyboard.press("s")
    opened.keyboard.type(part)
    assert opened.locator("#found [aria-selected=true]").inner_text() == part
    opened.keyboard.press("Enter")
    opened.keyboard.press("m")
    assert opened.evaluate("yellowiron.mirror")
    assert opened.locator("button[aria-pressed=true]", has_text="other side").count() == 1
    opened.keyboard.press("m")
    assert not opened.evaluate("yellowiron.mirror")
    before = opened.evaluate(hidden)
    opened.keyboard.press("i")
    assert opened.evaluate(hidden) == opened.evaluate("yellowiron.viewer.model.parts.length") - 1
    opened.keyboard.press("i")
    assert opened.evaluate(hidden) == before
    opened.evaluate("yellowiron.viewer.reset()")
    far = opened.evaluate("JSON.stringify(yellowiron.viewer.camera)")
    opened.keyboard.press("f")
    until(lambda: opened.evaluate("JSON.stringify(yellowiron.viewer.camera)") != far)
    opened.keyboard.press("x")
    solved()
    assert {p.part: p.role for p in session.settled(60).aligned.parts}[part] is None
    opened.keyboard.press("u")
    solved()
    assert {p.part: p.role for p in session.settled(60).aligned.parts}[part] == "bucket"
    name = opened.locator("#card h2").inner_text().removesuffix("?")
    assert session.state.specifications.number(name) is None
    opened.keyboard.press("1")
    solved()
    assert session.settled(60).specifications.number(name) is not None
    opened.keyboard.press("u")
    solved()
    begun: list[str] = []

    def answer(route: Any) -> None:
        begun.append(route.request.url)
        route.fulfill(json=opened_state)

    opened_state = opened.evaluate("yellowiron.state")
    opened.route("**/build", answer)
    opened.keyboard.press("b")
    until(lambda: opened.locator("#building").is_visible() and bool(begun))
    until(lambda: not opened.evaluate("yellowiron.waiting"))
    opened.unroute("**/build")
    opened.keyboard.press("Escape")
    assert errors == []


def test_what_is_being_written_stays(page: tuple[Any, list[str]]) -> None:
    """A state that comes while a person writes a value does not take the field away."""
    opened, errors = page
    opened.keyboard.press("Escape")
    field = opened.locator("#card input")
    field.fill("73")
    opened.evaluate("yellowiron.load()")
    opened.evaluate("yellowiron.show()")
    opened.keyboard.type("5 mm")
    assert field.input_value() == "735 mm"
    opened.keyboard.press("Escape")
    opened.evaluate("yellowiron.show()")
    assert field.input_value() == ""
    assert errors == []


def test_a_build_that_begins_late_takes_no_key(page: tuple[Any, list[str]]) -> None:
    """B is answered at once, however long the server takes, and what is written meanwhile keeps the focus."""
    opened, errors = page
    state = opened.evaluate("yellowiron.state")
    held: list[Any] = []
    opened.route("**/build", lambda route: held.append(route))
    opened.keyboard.press("Escape")
    opened.keyboard.press("b")
    assert opened.locator("#building").is_visible()
    assert "then it builds" in opened.locator("#building").inner_text()
    opened.keyboard.press("Escape")
    field = opened.locator("#card input")
    field.fill("73")
    until(lambda: opened.evaluate("yellowiron.waiting") == 1 and bool(held))
    held[0].fulfill(json=state)
    until(lambda: not opened.evaluate("yellowiron.waiting"))
    opened.keyboard.type("5 mm")
    assert field.input_value() == "735 mm"
    assert not opened.locator("#building").is_visible()
    opened.keyboard.press("Escape")
    opened.unroute("**/build")
    assert errors == []


def test_what_is_written_and_not_sent_is_kept(page: tuple[Any, list[str]]) -> None:
    """Without the focus too, on the way to other questions and back, and where the server refuses it."""
    opened, errors = page
    opened.keyboard.press("Escape")
    heading = opened.locator("#card h2").inner_text()
    field = opened.locator("#card input")
    field.fill("735")
    opened.locator("canvas").focus()
    opened.evaluate("yellowiron.load()")
    opened.evaluate("yellowiron.show()")
    assert field.input_value() == "735"
    opened.keyboard.press("j")
    assert opened.locator("#card h2").inner_text() != heading
    opened.keyboard.press("k")
    assert field.input_value() == "735"
    opened.route("**/do", lambda route: route.fulfill(status=400, json={"message": "Not so."}))
    field.press("Enter")
    until(lambda: "Not so." in opened.locator("#told").inner_text())
    until(lambda: not opened.evaluate("yellowiron.waiting"))
    opened.unroute("**/do")
    while opened.locator("#card h2").inner_text() != heading:
        opened.keyboard.press("j")
    assert field.input_value() == "735"
    field.focus()
    opened.keyboard.press("Escape")
    assert field.input_value() == ""
    errors.clear()  # of the answer that was refused


def test_letters_are_no_keys_while_patterns_are_looked_for(page: tuple[Any, list[str]]) -> None:
    """E opens at once: what is typed before the server knows of patterns is a search, and Enter waits for it."""
    opened, errors = page
    held: list[Any] = []
    opened.keyboard.press("Escape")
    path = opened.evaluate("yellowiron.viewer.model.parts.find(p => p.path.includes('/HOOD ASSY/')).path")
    opened.evaluate("path => yellowiron.choose(yellowiron.numbers.get(path), null)", path)
    free = threading.Event()
    opened.route("**/patterns", lambda route: route.continue_() if free.is_set() else held.append(route))
    opened.keyboard.press("e")
    assert opened.locator("#finder").is_visible()
    opened.keyboard.type("hood")
    assert not opened.locator("#building").is_visible()
    opened.keyboard.press("Enter")
    assert opened.locator("#finder").is_visible()
    until(lambda: opened.locator("#finder").is_visible() and bool(held))
    free.set()
    for one in held:
        one.continue_()
    until(lambda: not opened.locator("#finder").is_visible())
    opened.unroute("**/patterns")
    assert "All that is named" in opened.locator("#card").inner_text()
    opened.keyboard.press("Escape")
    assert errors == []


def test_joints_are_chosen_by_keys(page: tuple[Any, list[str]], session: Session) -> None:
    """By name, and by a mark in the picture that has the focus: its Enter is no answer to what is asked."""
    opened, errors = page
    joint = opened.evaluate("yellowiron.state.joints[3]")
    said = session.said
    opened.keyboard.press("Escape")
    opened.keyboard.press("s")
    opened.keyboard.type(joint["title"])
    opened.keyboard.press("Enter")
    assert opened.evaluate("yellowiron.picked") == joint["name"]
    assert opened.locator("#card h2").inner_text() == joint["title"]
    opened.keyboard.press("Escape")
    assert opened.evaluate("yellowiron.picked") is None
    opened.evaluate("(yellowiron.viewer.showJoints = true, yellowiron.viewer.draw(1))")
    mark = opened.locator(f"g.v-joint[aria-label*=' {joint['name']} ']")
    mark.focus()
    opened.keyboard.press("Enter")
    assert opened.evaluate("yellowiron.picked") == joint["name"]
    opened.evaluate("(yellowiron.viewer.showJoints = false, yellowiron.viewer.draw(1))")
    opened.keyboard.press("Escape")
    assert session.said == said
    assert errors == []


def test_an_assembly_is_one_decision_by_keys(page: tuple[Any, list[str]], session: Session) -> None:
    """A part found, its assembly taken in, all that is named so given one role: told, in the history, undone."""
    opened, errors = page

    def solved() -> None:
        until(lambda: bool(opened.evaluate("yellowiron.state.solved === yellowiron.state.said && !yellowiron.waiting")))

    def closed() -> None:
        until(lambda: not opened.locator("#finder").is_visible())

    part = next(p for p in session.parts if "/HOOD ASSY/" in p)
    inside = [p for p in session.parts if "/HOOD ASSY/" in p]
    before = {p.part: p.role for p in session.settled(60).aligned.parts}
    opened.keyboard.press("Escape")
    opened.keyboard.press("s")
    opened.keyboard.insert_text(part)
    opened.keyboard.press("Enter")
    opened.keyboard.press("x")
    solved()
    opened.keyboard.press("s")
    opened.keyboard.insert_text(part)
    opened.keyboard.press("Enter")
    opened.keyboard.press("a")
    opened.keyboard.press("e")
    opened.locator("#finder").wait_for()
    assert opened.locator("#found [aria-selected=true]").inner_text() == f"HOOD ASSY/* · {len(inside)} parts"
    opened.keyboard.press("Enter")
    closed()
    assert f"All that is named HOOD ASSY/* · {len(inside)} parts" in opened.locator("#card").inner_text()
    opened.keyboard.press("/")
    opened.keyboard.insert_text("front frame")
    opened.keyboard.press("Enter")
    solved()
    assert {p.part: p.role for p in session.settled(60).aligned.parts if p.part in inside} == dict.fromkeys(
        inside, "front_frame"
    )
    assert "goes before what was said of single parts earlier" in opened.locator("#told").inner_text()
    opened.get_by_role("tab", name="History").click()
    assert "All that is named HOOD ASSY/* → front frame" in opened.locator("#history").inner_text()
    assert "goes before what was said" in opened.locator("#history").inner_text()
    opened.get_by_role("tab", name="Move").click()
    opened.keyboard.press("u")
    opened.keyboard.press("u")
    solved()
    assert {p.part: p.role for p in session.settled(60).aligned.parts} == before

    # One that is written: its parts are selected, and the same role is a yes; it is found again, and taken back.
    opened.keyboard.press("Escape")
    opened.keyboard.press("e")
    opened.locator("#finder").wait_for()
    opened.keyboard.insert_text("no such assembly/*")
    until(lambda: "No part and no assembly" in opened.locator("#found").inner_text())
    opened.locator("#find").fill("*rear axle assy")
    opened.keyboard.press("Enter")
    closed()
    chosen = opened.evaluate("[...yellowiron.selection].map(n => yellowiron.viewer.model.parts[n - 1].path)")
    assert chosen == [p for p in session.parts if "/REAR AXLE ASSY/" in p]
    opened.keyboard.press("x")
    solved()
    assert [(r.pattern, r.role) for r in session.settled(60).aligned.rules] == [("*rear axle assy", None)]
    opened.keyboard.press("e")
    opened.locator("#finder").wait_for()
    assert "no part of the machine" in opened.locator("#found [aria-selected=true]").inner_text()
    opened.keyboard.press("Enter")
    closed()
    opened.get_by_role("button", name="Take back").click()
    solved()
    assert session.settled(60).aligned.rules == ()
    assert {p.part: p.role for p in session.settled(60).aligned.parts} == before
    assert errors == []


def test_an_axis_by_keys_alone(page: tuple[Any, list[str]], session: Session) -> None:
    """S finds the joint, P points, arrow keys go through what is round there, Enter takes it."""
    opened, errors = page
    name = "front_frame2boom_joint"
    opened.keyboard.press("Escape")
    opened.keyboard.press("s")
    opened.keyboard.insert_text("front frame to boom")
    opened.keyboard.press("Enter")
    assert opened.evaluate("yellowiron.picked") == name
    camera = opened.evaluate("JSON.stringify(yellowiron.viewer.camera)")
    opened.locator("canvas").focus()
    opened.keyboard.press("p")
    opened.keyboard.press("ArrowRight")
    opened.locator(".v-meant line").wait_for()
    first = opened.evaluate("yellowiron.aim.found")
    assert "(1 of " in opened.locator("#card").inner_text()
    opened.keyboard.press("ArrowRight")
    until(lambda: "(2 of " in opened.locator("#card").inner_text())
    second = opened.evaluate("yellowiron.aim.found")
    assert second["entry"] != first["entry"] and second["words"] in opened.locator("#card").inner_text()
    opened.keyboard.press("ArrowUp")
    opened.keyboard.press("ArrowUp")
    until(lambda: opened.evaluate("yellowiron.aim.at") > 1)  # once around
    assert opened.evaluate("JSON.stringify(yellowiron.viewer.camera)") == camera  # the picture did not turn
    opened.keyboard.press("ArrowDown")
    opened.keyboard.press("ArrowDown")
    until(lambda: "(2 of " in opened.locator("#card").inner_text())
    opened.keyboard.press("Enter")
    until(lambda: name in session.settled(60.0).aligned.by_hand)
    given = session.state.aligned.joints[name]
    assert {key: given[key] for key in ("anchor", "axis")} == second["entry"]
    opened.keyboard.press("u")
    until(lambda: session.settled(60.0).aligned.joints == {})
    opened.keyboard.press("Escape")
    # Without a joint that is pointed at, the keys turn the picture.
    opened.locator("canvas").focus()
    opened.keyboard.press("ArrowRight")
    assert opened.evaluate("JSON.stringify(yellowiron.viewer.camera)") != camera
    assert errors == []


@pytest.mark.parametrize(("width", "height"), [(1400, 900), (900, 800), (420, 800)])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_runs_out_of_the_page(page: tuple[Any, list[str]], width: int, height: int, scheme: str) -> None:
    opened, _ = page
    opened.emulate_media(color_scheme=scheme)
    opened.set_viewport_size({"width": width, "height": height})
    opened.wait_for_timeout(300)
    wide = opened.evaluate("document.documentElement.scrollWidth")
    assert wide <= width
    if width >= 900:
        assert opened.evaluate("document.documentElement.scrollHeight") <= height
    folder = os.environ.get("YELLOWIRON_SHOTS")
    if folder:
        opened.screenshot(path=str(Path(folder) / f"studio_{width}_{scheme}.png"))
