"""What a review in the studio costs a person: real models with labels, answered by one who knows the truth.

    python benchmarks/bench_studio.py [--models DIR:…] [--only NAME,…] [--names with,without] [--most N]
                                      [--undo N --seed S] | --parts N,… [--example NAME] [--page]

The one who answers takes the first question that is about parts. Where all of them are right he says yes; where all are
wrong in the same way, the body that they are of; else he picks out those that are wrong, body by body, which costs a
click a part and one for the body, and says yes to the rest. Four seconds a decision or click. What is printed: how much
of the surface was right before and after, parts that were wrong before, questions that were asked, decisions and
clicks, the minutes that they take, and the median of the seconds from a decision to the machine that follows from it.
Values are not asked. With `--undo`, every part but N random ones was decided as the truth has it before; the review is
of what the program makes of those. The alternative is what the same person would do without the page: one entry of
alignment.json for every wrong part, found by its name, a full run after each ten.

With `--parts` no model is reviewed: the example loader (or another `--example`), grown by bolts to so many parts, takes
nine decisions, and what is printed is how long each took to its machine, in seconds solving and packing: the least and
the median. With `--page` too, it is how the page draws in headless Chromium: triangles; draw calls of a frame as the
machine stands, and with a part lit and all moved; the page's own work for a frame, without what a graphics card does,
and to find what is clicked, which waits for a frame (milliseconds, medians of 50). Chromium draws in software there, so
that the time of its frames says nothing of a graphics card.
"""

from __future__ import annotations

import argparse
import os
import queue
import random
import shutil
import statistics
import sys
import tempfile
import threading
import time
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests"), str(ROOT / "benchmarks")]

import strangers_models as strangers  # noqa: E402
from bench_scale import resize  # noqa: E402
from kit.scoring import score, true_bodies  # noqa: E402
from yellowiron.opinion.doubts import boxes_of  # noqa: E402
from yellowiron.studio import Session, Setup  # noqa: E402
from yellowiron.studio.questions import Question, questions  # noqa: E402
from yellowiron.studio.scene import Scene  # noqa: E402

SECONDS = 4.0
EXAMPLES = ROOT / "examples"


class Person:
    """Who answers: counts decisions and clicks, and how long each waits for its machine."""

    def __init__(self, session: Session, truth: dict[str, tuple[str, ...]]) -> None:
        self.session, self.truth = session, truth
        self.asked = self.decisions = self.clicks = 0
        self.waited: list[float] = []

    def answer(self, question: Question) -> None:
        """One question about parts."""
        self.asked += 1
        bodies = {p.part: p.body or "-" for p in self.session.state.aligned.parts}
        wrong = {p: self.truth[p][0] for p in question.parts if self.truth.get(p) and bodies[p] not in self.truth[p]}
        right = [p for p in question.parts if p not in wrong]
        whole = not right and len(set(wrong.values())) == 1
        for body, count in sorted(Counter(wrong.values()).items()):
            parts = [p for p, b in wrong.items() if b == body]
            self.clicks += 0 if whole else count
            self.say("role", dict.fromkeys(parts, None if body == "-" else body))
        if right:
            roles = {p.part: p.role for p in self.session.state.aligned.parts}
            self.say("confirm", {p: roles[p] for p in right})

    def say(self, kind: str, parts: dict[str, str | None]) -> None:
        """One decision."""
        self.decisions += 1
        start = time.perf_counter()
        self.session.do(self.session.read({"kind": kind, "parts": parts}))
        self.session.settled(300.0)
        self.waited.append(time.perf_counter() - start)


def review(model: strangers.Model, names: str, most: int, undo: int, seed: int) -> str:
    """One model's row."""
    scene = strangers.scene_of(model, names=names)
    with tempfile.TemporaryDirectory() as folder:
        if model.cad is None:
            return f"{model.name:26s} not on this machine"
        session = Session(Setup(scene.type, model.cad, Path(folder) / "out"), assembly=scene.assembly)
        try:
            return _row(model, names, most, scene, session, undo, seed)
        finally:
            session.close()


def _row(model, names, most, scene, session, undo, seed) -> str:  # type: ignore[no-untyped-def]
    template = session.template
    first = session.settled(300.0).aligned

    def right() -> float:
        found = score(session.assembly, session.state.aligned, None, scene.truth, (), scene.height, template)
        return 100.0 * found.right / found.area

    truth = true_bodies(session.assembly, first, scene.truth, template)
    if undo:
        undone = set(random.Random(seed).sample(sorted(truth), min(undo, len(truth))))
        known = {p: b[0] for p, b in truth.items() if b and p not in undone}
        session.do(session.read({"kind": "role", "parts": {p: None if b == "-" else b for p, b in known.items()}}))
        first = session.settled(300.0).aligned
    wrong = sum(bool(truth.get(p.part)) and (p.body or "-") not in truth[p.part] for p in first.parts)
    before = right()
    person = Person(session, truth)
    boxes = boxes_of(session.assembly)
    while person.asked < most:
        open_ones = [q for q in questions(session.state, boxes) if q.kind == "parts"]
        if not open_ones:
            break
        person.answer(open_ones[0])
    minutes = SECONDS * (person.decisions + person.clicks) / 60.0
    waited = statistics.median(person.waited) if person.waited else 0.0
    return (
        f"{model.name:26s} {names:8s} {before:6.1f} {right():6.1f} {wrong:6d} {person.asked:6d} "
        f"{person.decisions:6d} {person.clicks:6d} {minutes:8.1f} {waited:8.2f}"
    )


def speed(parts: int, example: str) -> str:
    """One size's row."""
    with tempfile.TemporaryDirectory() as folder:
        source, sheet = EXAMPLES / example / f"{example}.step", EXAMPLES / example / "specifications.pdf"
        grown = resize(source, Path(folder, "grown.step"), parts) if parts else source
        session = Session(Setup(example, grown, Path(folder, "out"), sheets=(sheet,)))
        try:
            scene = Scene(session.assembly)
            played = [p for p in session.settled(300.0).aligned.parts if p.role]
            solving, packing = [], []
            for number in range(9):
                one = played[37 * number % len(played)]
                start = time.perf_counter()
                session.do(session.read({"kind": "confirm", "parts": {one.part: one.role}}))
                state = session.settled(300.0)
                solved = time.perf_counter()
                scene.machine(state)
                solving.append(solved - start)
                packing.append(time.perf_counter() - solved)
        finally:
            session.close()
    each = "  ".join(f"{min(s):8.2f} {statistics.median(s):8.2f}" for s in (solving, packing))
    return f"{len(session.assembly.parts):6d} parts  {each}"


COUNTED = """
window.calls = 0;
for (const name of ["drawElements", "drawArrays", "drawElementsInstanced", "drawArraysInstanced"]) {
  const drawn = WebGL2RenderingContext.prototype[name];
  WebGL2RenderingContext.prototype[name] = function (...all) { window.calls++; return drawn.apply(this, all); };
}
"""
MEASURED = """() => {
  const { viewer } = yellowiron;
  const calls = () => { window.calls = 0; viewer.draw(1); return window.calls; };
  const median = (act, times) => {
    const took = [];
    for (let k = 0; k < times; k++) { const from = performance.now(); act(); took.push(performance.now() - from); }
    return took.sort((a, b) => a - b)[times >> 1];
  };
  viewer.light(null);
  calls();
  const stands = calls();
  viewer.light(new Set([1]));
  viewer.move({});
  const moves = calls();
  viewer.light(null);
  calls();
  viewer.renderer.partAt(9, 9);
  const work = median(() => viewer.draw(0.05), 50);
  viewer.renderer.partAt(9, 9);
  const parts = viewer.model.parts.length;
  const triangles = viewer.renderer.mesh.count / 3;
  return { triangles, stands, moves, work, pick: median(() => viewer.renderer.partAt(99, 99), 50), parts };
}"""


def page(parts: int, example: str) -> str:
    """One size's row: how the page draws it."""
    from playwright.sync_api import sync_playwright

    from conftest import BROWSER_FLAGS
    from yellowiron.studio.server import serve

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        source = EXAMPLES / example / f"{example}.step"
        grown = resize(source, Path(folder, "grown.step"), parts) if parts else source
        session = Session(Setup(example, grown, Path(folder, "out")))
        told: queue.Queue[str] = queue.Queue()
        threading.Thread(target=serve, args=(session,), kwargs={"ready": told.put}, daemon=True).start()
        chromium = next(p for name in ("chromium", "chromium-browser", "google-chrome") if (p := shutil.which(name)))
        browser = playwright.chromium.launch(executable_path=chromium, args=list(BROWSER_FLAGS))
        opened = browser.new_page(viewport={"width": 1400, "height": 900}, reduced_motion="reduce")
        opened.add_init_script(COUNTED)
        opened.goto(told.get(timeout=60.0))
        opened.locator("#queue button").first.wait_for(timeout=120_000)
        found = opened.evaluate(MEASURED)
        browser.close()
        session.close()
    return (
        f"{found['parts']:6d} parts {found['triangles']:9d} triangles  {found['stands']:6d} {found['moves']:6d}"
        f"  {found['work']:10.2f} {found['pick']:10.2f}"
    )


def main() -> None:
    """Prints a row a model and naming."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--models", default=os.environ.get("YELLOWIRON_STRANGERS", ""))
    parser.add_argument("--only", default="")
    parser.add_argument("--names", default="with,without")
    parser.add_argument("--most", type=int, default=80, help="questions")
    parser.add_argument("--undo", type=int, default=0, help="parts whose decision is undone")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--parts", default="", help="sizes, 0: the example as it is")
    parser.add_argument("--example", default="wheel_loader", help="of which the sizes are")
    parser.add_argument("--page", action="store_true", help="with --parts: how the page draws them")
    given = parser.parse_args()
    if given.parts and given.page:
        print(f"{'':36s}draw calls: still, moved   work ms    pick ms")
        for parts in given.parts.split(","):
            print(page(int(parts), given.example), flush=True)
        return
    if given.parts:
        print(f"{'':14s} {'solving s: least, median':>17s}  {'packing s: least, median':>17s}")
        for parts in given.parts.split(","):
            print(speed(int(parts), given.example), flush=True)
        return
    folders = [Path(p) for p in given.models.split(":") if p]
    only = {n for n in given.only.split(",") if n}
    print(f"{'':35s} before  after  wrong  asked  decis clicks  minutes  s/decis")
    for model in strangers.models(folders):
        if model.held_back or (only and model.name not in only):
            continue
        if model.cad is None:
            print(f"{model.name:26s} not on this machine")
            continue
        for names in given.names.split(","):
            print(review(model, names, given.most, given.undo, given.seed), flush=True)


if __name__ == "__main__":
    main()
