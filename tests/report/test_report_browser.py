"""The page in a real browser, from disk: it opens in silence, moves, and knows what was clicked."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import numpy as np
import pytest
from PIL import Image

from yellowiron.kinematics import ClosedChain
from yellowiron.pipeline import build

pytestmark = pytest.mark.slow

BETWEEN = 2e-3
"""Metres between the solver's pose and the page's, anywhere on a body."""
MOST_BYTES = 3_000_000


@pytest.fixture(scope="module")
def machine(cad_read_once: None, kept_stages: None, example: Path, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The example, built and driven: what the page was made from."""
    return build(
        "wheel_loader", example / "wheel_loader.step", tmp_path_factory.mktemp("page") / "machine",
        sheets=[example / "specifications.pdf"], engines=("mujoco",),
    )  # fmt: skip


@pytest.fixture(scope="module")
def opened(browser: Any, machine: Any) -> Iterator[tuple[Any, list[str], list[str]]]:
    """The page, what the console complained of, and what was asked of any network."""
    page = browser.new_page(viewport={"width": 1280, "height": 900}, reduced_motion="reduce")
    page.set_default_timeout(60_000)
    errors: list[str] = []
    requests: list[str] = []
    page.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("request", lambda request: requests.append(request.url))
    page.goto((machine.folder / "report.html").as_uri())
    page.wait_for_selector("#viewer.v-ready")
    page.locator("#viewer").scroll_into_view_if_needed()
    yield page, errors, requests
    page.close()


@pytest.fixture
def page(opened: tuple[Any, list[str], list[str]]) -> Any:
    """The page with everything shown as drawn, nothing chosen."""
    page = opened[0]
    page.evaluate("yellowiron.choose(0), yellowiron.show(() => true), yellowiron.move({}), yellowiron.reset()")
    return page


def picture(page: Any) -> np.ndarray:
    """What the canvas shows, (rows, columns, 3), once it is drawn."""
    data = page.evaluate("(yellowiron.draw(1), yellowiron.canvas.toDataURL('image/png'))")
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data.partition(",")[2]))).convert("RGB")).astype(int)


def on_screen(page: Any, body: str, point: tuple[float, float, float]) -> tuple[float, float]:
    """Pixel of the browser's window at which a point of a body is seen."""
    x, y = page.evaluate(
        "([body, point]) => yellowiron.project(yellowiron.moved(yellowiron.pose[body], point))", [body, point]
    )
    box = page.locator("#viewer canvas").bounding_box()
    return box["x"] + x, box["y"] + y


def test_it_opens_from_disk_in_silence(opened: tuple[Any, list[str], list[str]], machine: Any) -> None:
    page, errors, requests = opened
    assert errors == []
    assert all(url.startswith(("file:", "data:", "blob:")) for url in requests)
    assert (machine.folder / "report.html").stat().st_size < MOST_BYTES
    seen = picture(page)
    assert len(np.unique(seen.reshape(-1, 3), axis=0)) > 1000


def test_every_actuator_moves_the_picture(page: Any, machine: Any) -> None:
    before = picture(page)
    for actuator in machine.mechanism.actuators:
        slider = page.locator(f"#v-{actuator.name}")
        assert slider.get_attribute("type") == "range"
        said = slider.get_attribute("aria-valuetext")
        slider.focus()
        page.keyboard.press("End")
        assert slider.get_attribute("aria-valuetext") != said
        after = picture(page)
        moved = np.abs(after - before).max(axis=2) > 24
        # Wheels look much the same wherever they turn.
        assert moved.sum() > (20 if actuator.kind == "motor" else 500), actuator.name
        before = after


def test_poses_are_the_solvers(page: Any, machine: Any) -> None:
    """Steering, boom, bucket and wheels at once: the page's interpolation against the closed chain."""
    chain = ClosedChain(machine.mechanism)
    random = np.random.default_rng(5)
    joints = {joint.name: joint for joint in machine.mechanism.joints}
    for _ in range(10):
        given = {
            name: float(random.uniform(*((-2.0, 2.0) if joints[name].lower is None else
                                         (joints[name].lower, joints[name].upper))))
            for name in chain.independent
        }  # fmt: skip
        solved = chain.pose(chain.solve(given))
        shown = page.evaluate("(given) => { yellowiron.move(given); return yellowiron.pose; }", given)
        for body in machine.mechanism.bodies:
            gap = solved[body.name] - np.array(shown[body.name]).reshape(4, 4).T
            corners = np.c_[body.hull, np.ones(len(body.hull))]
            assert np.abs(corners @ gap.T).max() < BETWEEN, body.name


def test_a_click_picks_the_bucket_and_tells_about_it(page: Any, machine: Any) -> None:
    body = machine.mechanism.body("bucket")
    low, high = body.hull.min(axis=0), body.hull.max(axis=0)
    # Some pixel of its box shows it; the first on a lattice is clicked.
    x0, y0 = on_screen(page, "bucket", tuple(low))
    x1, y1 = on_screen(page, "bucket", tuple(high))
    box = page.locator("#viewer canvas").bounding_box()
    bucket = [each.name for each in machine.mechanism.bodies].index("bucket")
    picture(page)
    for share in np.linspace(0.1, 0.9, 17):
        x, y = x0 + share * (x1 - x0), y0 + share * (y1 - y0)
        found = page.evaluate(
            "([x, y]) => yellowiron.model.parts[yellowiron.pick(x, y) - 1]?.body", [x - box["x"], y - box["y"]]
        )
        if found == bucket:
            break
    else:
        pytest.fail("the bucket is nowhere to be seen")
    page.mouse.click(x, y)
    card = page.locator(".v-card")
    card.wait_for(state="visible")
    assert "bucket" in card.inner_text()
    assert "confidence" in card.inner_text()
    chosen = page.evaluate("yellowiron.model.parts[yellowiron.chosen - 1].path")
    assert chosen in {p.part for p in machine.alignment.parts if p.body == "bucket"}

    # Hidden, the pixel shows something else; the list brings it back.
    card.get_by_role("button", name="Hide", exact=True).click()
    picture(page)
    assert page.evaluate("(at) => yellowiron.pick(...at)", [x - box["x"], y - box["y"]]) != page.evaluate(
        "yellowiron.chosen"
    )


def test_parts_that_cannot_be_seen_are_found_by_name(page: Any, machine: Any) -> None:
    """The whole alignment is listed; isolating one part leaves only that."""
    page.get_by_role("tab", name="Parts").click()
    assert page.evaluate("yellowiron.model.parts.length") == sum(len(b.parts) for b in machine.mechanism.bodies)
    name = machine.mechanism.body("rocker").parts[-1].part.rsplit("/", 1)[-1]
    page.get_by_role("searchbox", name="Search parts").fill(f"rocker {name}")
    page.locator(".v-name", has_text=name).first.click()
    page.locator(".v-card").get_by_role("button", name="Isolate", exact=True).click()
    assert page.evaluate("yellowiron.model.parts.filter((part) => !part.hidden).length") == 1
    page.get_by_role("button", name="Show all").click()
    page.get_by_role("searchbox", name="Search parts").fill("")
    page.get_by_role("tab", name="Move").click()
    assert page.evaluate("yellowiron.model.parts.every((part) => !part.hidden)")


def test_links_lead_to_parts_joints_and_values(page: Any, machine: Any) -> None:
    def go(fragment: str) -> None:
        page.evaluate("fragment => { location.hash = fragment; }", fragment)
        page.wait_for_timeout(100)

    part = next(p.part for p in machine.alignment.parts if p.role == "boom")
    go(f"part={quote(part)}")
    assert page.locator(".v-card b").inner_text() == part.rsplit("/", 1)[-1]
    assert page.locator(".v-card a").get_attribute("href") == f"#part={quote(part, safe='')}"
    go("joint=front_frame2boom_joint")
    assert page.locator(".v-axis line").count() == 1
    value = next(s.name for s in machine.specifications if s.status == "ok")
    go(f"value={quote(value)}")
    assert page.locator("tr.told").first.locator("td").first.inner_text() == value
    # Lists of the page lead there by themselves; names that are nothing lead nowhere.
    assert page.locator("[data-part] a").count() == len(machine.alignment.parts)
    assert page.locator("[data-joint] a").count() > 10
    go("part=nothing")
    go("")
    page.evaluate("yellowiron.showAxes([])")


def test_a_picture_is_saved(page: Any) -> None:
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Save picture").click()
    with Image.open(waiting.value.path()) as saved:
        assert saved.format == "PNG" and saved.width > 600
        assert len(set(saved.convert("RGB").resize((40, 30)).getdata())) > 20


def test_joints_are_drawn_where_they_are(page: Any, machine: Any) -> None:
    page.get_by_role("button", name="Joints").click()
    assert page.locator(".v-joint").count() == len(machine.mechanism.joints)
    page.get_by_role("button", name="Joints").click()
    assert page.locator(".v-joint").count() == 0


def test_marks_of_joints_take_the_focus(page: Any, machine: Any) -> None:
    """By Tab alone: each is told, and keeps the focus while the machine moves under it."""
    page.get_by_role("button", name="Joints").click()
    first = page.locator(".v-joint").first
    first.focus()
    joint = machine.mechanism.joints[0]
    assert joint.name in first.get_attribute("aria-label")
    assert page.locator(".v-tip").inner_text().startswith(f"1 {joint.name}")
    page.evaluate("(yellowiron.set(yellowiron.sliders[0].name, 0.05), yellowiron.draw(1))")
    assert page.evaluate("document.activeElement === document.querySelector('.v-joint')")
    page.keyboard.press("Tab")
    assert machine.mechanism.joints[1].name in page.locator(".v-tip").inner_text()
    page.get_by_role("button", name="Joints").click()


def test_a_finger_scrolls_past_the_view(browser: Any, machine: Any) -> None:
    """Upwards the finger moves the page; sideways it turns the machine."""
    context = browser.new_context(viewport={"width": 390, "height": 700}, has_touch=True, is_mobile=True)
    page = context.new_page()
    page.set_default_timeout(60_000)
    page.goto((machine.folder / "report.html").as_uri())
    page.wait_for_selector("#viewer.v-ready")
    page.evaluate("document.querySelector('#viewer').scrollIntoView({block: 'start'})")
    session = context.new_cdp_session(page)

    def swipe(dx: int, dy: int) -> tuple[float, float]:
        before = page.evaluate("[scrollY, yellowiron.camera.azimuth]")
        at = [200, 300]
        session.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": at[0], "y": at[1]}]})
        for k in range(1, 11):
            point = {"x": at[0] + dx * k / 10, "y": at[1] + dy * k / 10}
            session.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [point]})
        session.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        page.wait_for_timeout(500)
        after = page.evaluate("[scrollY, yellowiron.camera.azimuth]")
        return after[0] - before[0], after[1] - before[1]

    scrolled, turned = swipe(100, 0)
    assert scrolled == 0 and abs(turned) > 0.1
    scrolled, turned = swipe(0, -200)
    assert scrolled > 100 and abs(turned) < 0.05
    context.close()


def test_the_camera_answers_mouse_and_keys(page: Any) -> None:
    before = page.evaluate("({...yellowiron.camera})")
    box = page.locator("#viewer canvas").bounding_box()
    page.mouse.move(box["x"] + 300, box["y"] + 300)
    page.mouse.down()
    page.mouse.move(box["x"] + 380, box["y"] + 320, steps=3)
    page.mouse.up()
    turned = page.evaluate("({...yellowiron.camera})")
    assert turned["azimuth"] != before["azimuth"] and turned["elevation"] != before["elevation"]
    page.mouse.wheel(0, -300)
    page.wait_for_function("(far) => yellowiron.camera.distance < far", arg=turned["distance"])
    page.keyboard.press("0")
    assert page.evaluate("yellowiron.camera.azimuth") == before["azimuth"]


def test_sensors_show_what_they_see(page: Any, machine: Any) -> None:
    page.get_by_role("button", name="Sensors").click()
    sensors = machine.mechanism.sensors
    assert page.locator(".v-sensor").count() == len(sensors)
    looking = sum(sensor.type in ("camera", "lidar") for sensor in sensors)
    assert page.locator(".v-sensor.v-looks").count() == looking > 0
    page.get_by_role("button", name="Sensors").click()
    assert page.locator(".v-sensor").count() == 0
    # Every one has its row, and its number on the picture.
    assert page.locator("#sensors ~ .scroll").first.locator("tr:has(td)").count() == len(sensors)
    assert page.locator("#sensors ~ figure").first.locator(".mark").count() == len(sensors)


def test_every_sweep_is_shown(page: Any, machine: Any) -> None:
    """A strip for what can be seen to move, lines for all; each picture of a strip differs from the one before."""
    names = page.locator("h3.sweep").all_inner_texts()
    assert len(names) == len(machine.mechanism.actuators) + 1
    assert page.locator(".plots svg.plot").count() == 2 * len(names)
    cylinders = [a for a in machine.mechanism.actuators if a.kind == "cylinder"]
    strips = page.locator(".strip:not(.poses)")
    assert strips.count() == len(cylinders) + 1
    for strip in strips.all():
        pictures = strip.locator("img").evaluate_all("all => all.map((image) => image.src)")
        assert len(set(pictures)) == len(pictures) == 5
        assert strip.locator("img").evaluate_all("all => all.every((image) => image.naturalWidth > 0)")


@pytest.mark.parametrize("width", [360, 800, 1280])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_nothing_runs_out_of_the_page(browser: Any, machine: Any, width: int, scheme: str) -> None:
    page = browser.new_page(viewport={"width": width, "height": 800}, color_scheme=scheme)
    page.goto((machine.folder / "report.html").as_uri())
    page.wait_for_selector("#viewer.v-ready")
    page.evaluate("document.querySelectorAll('main details').forEach((each) => (each.open = true))")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    wide = page.evaluate(
        """(width) => [...document.querySelectorAll("main *, header *")]
          .filter((each) => !each.closest(".scroll, .strip, svg, figure.wide, .run"))
          .filter((each) => each.getBoundingClientRect().right > width + 1).map((each) => each.outerHTML)""",
        width,
    )
    assert wide == []
    if width == 1280:
        # On a desk no table hides a column.
        hides = page.locator("main .scroll").evaluate_all(
            "all => all.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.textContent.slice(0, 60))"
        )
        assert hides == []
    paper, ink = page.evaluate("['backgroundColor', 'color'].map((key) => getComputedStyle(document.body)[key])")
    light = [sum(int(n) for n in colour[4:-1].split(",")) for colour in (paper, ink)]
    assert (light[0] > light[1]) is (scheme == "light")
    page.close()


def test_without_webgl_the_picture_stays(browser: Any, machine: Any) -> None:
    page = browser.new_page()
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.goto((machine.folder / "report.html").as_uri())
    page.wait_for_function("document.getElementById('viewer-caption').textContent.includes('WebGL2')")
    assert page.locator("#viewer img").is_visible()
    page.close()


def test_graphics_that_were_taken_away_come_back(page: Any) -> None:
    before = picture(page)
    page.evaluate("(window.graphics = yellowiron.renderer.gl.getExtension('WEBGL_lose_context')).loseContext()")
    hint = page.locator(".v-hint")
    page.wait_for_function("document.querySelector('.v-hint').textContent.includes('taken the graphics away')")
    page.evaluate("graphics.restoreContext()")
    page.wait_for_function("!document.querySelector('.v-hint').textContent.includes('taken')")
    assert "to turn" in hint.inner_text()
    assert (np.abs(picture(page) - before).max(axis=2) > 8).mean() < 1e-3


def test_from_a_value_to_its_box_on_the_page_and_back(page: Any) -> None:
    row = page.locator("tr[data-value='Lift Cylinder Stroke']")
    row.locator("a.piece").click()
    box = page.locator("details.sheet[open] a:target")
    assert "Lift Cylinder Stroke" in box.get_attribute("aria-label") and box.is_visible()
    box.click()
    assert page.evaluate("document.querySelector('tr:target').dataset.value") == "Lift Cylinder Stroke"
    # The piece shows the page: print on paper, within its box's colour.
    shown = np.asarray(Image.open(io.BytesIO(row.locator("a.piece").screenshot())).convert("L"), dtype=int)
    assert (shown < 120).sum() > 50 and (shown > 230).mean() > 0.4
    # What the value limits: a joint, which is shown.
    row.locator("small a").first.click()
    assert page.url.rpartition("#")[2].startswith("joint=")
    page.evaluate("location.hash = ''")
