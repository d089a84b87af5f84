"""The gallery in a browser: what a person filters, sorts and opens, with as many machines as a fleet may have."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from yellowiron.fleet.figures import FIGURES
from yellowiron.fleet.places import store_at
from yellowiron.fleet.values import Item, Plan
from yellowiron.fleet.whole import collected

MANY = 3000


@pytest.fixture(scope="module")
def page(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The page of three thousand machines: every third ready, short or refused, each with an error of its own."""
    out = tmp_path_factory.mktemp("fleet")
    store = store_at(out)
    items = tuple(Item(f"m{n:04d}", "excavator" if n % 2 else "wheel_loader", "/a.step") for n in range(MANY))
    for n, item in enumerate(items):
        status = ("ready", "short", "refused")[n % 3]
        figures = {**dict.fromkeys(FIGURES), "verdict": "Moves: boom.", "worst_error_percent": n / 100, "findings": []}
        mark = {"id": item.id, "key": "k", "status": status, "figures": figures if status != "refused" else {}}
        place = out / "items" / item.id
        place.mkdir(parents=True)
        (place / "item.json").write_text(
            json.dumps({**mark, "message": "" if n % 3 < 2 else "<b>The file is empty</b>"})
        )
        (place / "seconds.json").write_text(json.dumps({"seconds": float(MANY - n), "peak_mb": 1.0}))
    collected(Plan("/night.yaml", items), store)
    opened = browser.new_page(viewport={"width": 1300, "height": 900})
    errors: list[str] = []
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.goto((Path(out) / "index.html").as_uri())
    opened.wait_for_selector("li")
    yield opened
    assert errors == []
    opened.close()


def ids(page: Any) -> list[str]:
    found: list[str] = page.eval_on_selector_all(
        "li h2", "all => all.slice(0, 3).map(each => each.firstChild.textContent)"
    )
    return found


@pytest.mark.slow
def test_a_person_finds_a_machine(page: Any) -> None:
    assert page.text_content("#tally") == f"{MANY} machines · 1000 ready · 1000 not ready · 1000 failed"
    assert ids(page) == ["m0000", "m0001", "m0002"]
    assert page.get_attribute("li a.view", "href") == "items/m0000/machine/report.html"
    assert page.eval_on_selector_all("li", "all => all.length") < 600  # no more than is looked at
    page.fill("#words", "m01 excavator")
    page.wait_for_function(f"() => document.getElementById('count').textContent === '50 of {MANY}'")
    assert ids(page) == ["m0101", "m0103", "m0105"]
    page.fill("#words", "")
    page.select_option("#order", "time")
    page.wait_for_function(f"() => document.getElementById('count').textContent === '{MANY} of {MANY}'")
    assert ids(page) == ["m0000", "m0001", "m0002"]
    page.select_option("#order", "error")
    assert ids(page) == ["m2998", "m2997", "m2995"]
    page.click("button[data-kind=failed]")
    page.select_option("#order", "plan")
    assert ids(page) == ["m0002", "m0005", "m0008"]
    assert "<b>The file is empty</b>" in page.text_content("li")
    page.select_option("#type", "excavator")
    assert ids(page) == ["m0005", "m0011", "m0017"]


@pytest.mark.slow
def test_more_come_as_they_are_scrolled_to(page: Any) -> None:
    page.reload()
    page.wait_for_selector("li")
    before = page.eval_on_selector_all("li", "all => all.length")
    page.evaluate("() => window.scrollTo(0, document.body.scrollHeight)")
    page.wait_for_function(f"() => document.querySelectorAll('li').length > {before}")
