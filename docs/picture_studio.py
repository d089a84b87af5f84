"""Draws docs/studio.webp: the studio on the example loader without its sheet, a stroke asked, its cylinder lit.

Needs the extra `studio`, playwright and Chromium: `python docs/picture_studio.py`.
"""

from __future__ import annotations

import io
import queue
import shutil
import sys
import tempfile
import threading
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from conftest import BROWSER_FLAGS  # noqa: E402
from yellowiron.studio import Session, Setup  # noqa: E402
from yellowiron.studio.server import serve  # noqa: E402

SIZE = {"width": 1400, "height": 900}


def picture(session: Session) -> bytes:
    """The page as PNG, its picture as fine as a graphics card draws it."""
    told: queue.Queue[str] = queue.Queue()
    threading.Thread(target=serve, args=(session,), kwargs={"ready": told.put}, daemon=True).start()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"), args=list(BROWSER_FLAGS))
        page = browser.new_page(viewport=SIZE, reduced_motion="reduce", color_scheme="light")
        page.goto(told.get(timeout=60.0))
        page.locator("#queue button").first.wait_for()
        page.keyboard.press("f")
        page.wait_for_timeout(2000)
        page.evaluate("yellowiron.viewer.request = () => {}")  # no coarser frame comes after it
        page.evaluate("yellowiron.viewer.draw(2)")
        taken = page.screenshot()
        browser.close()
    return taken


def main() -> None:
    """Writes the picture."""
    with tempfile.TemporaryDirectory() as folder:
        loader = ROOT / "examples" / "wheel_loader" / "wheel_loader.step"
        session = Session(Setup("wheel_loader", loader, Path(folder, "loader")))
        session.measured(120.0)
        taken = picture(session)
        session.close()
    Image.open(io.BytesIO(taken)).convert("RGB").save(ROOT / "docs" / "studio.webp", quality=82, method=6)


if __name__ == "__main__":
    main()
