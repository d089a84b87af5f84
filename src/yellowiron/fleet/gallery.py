"""`index.html`: a gallery of a fleet's machines, and `seconds.js` beside it, what differs from run to run.

The page has all that it needs; pictures and reports are the items' own, found beside it and loaded as they come into
view, so that ten thousand machines stay usable.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Sequence
from importlib import resources
from typing import Any

from yellowiron.fleet.attending import ITEMS
from yellowiron.fleet.child import MACHINE, PICTURE
from yellowiron.fleet.results import Row
from yellowiron.fleet.values import BUILT

PAGE, TIMES = "index.html", "seconds.js"
_SHOWN = (
    "id", "type", "status", "machine", "verdict", "open", "message", "worst_error_percent", "worst_error_deg",
    "errors", "warnings", "mass_kg", "variants",
)  # fmt: skip


def page(title: str, rows: Sequence[Row], paged: Collection[str]) -> bytes:
    """The page: it says nothing that differs from run to run. `paged`: the ids of items that have a report."""
    entries = []
    for row in rows:
        entry = {name: row[name] for name in _SHOWN if row[name] not in (None, "", 0)}
        if row["status"] in BUILT:
            entry["built"] = True
        if row["status"] in BUILT and row["id"] in paged:
            entry["report"] = f"{ITEMS}/{row['id']}/{MACHINE}/report.html"
            entry["picture"] = f"{ITEMS}/{row['id']}/{PICTURE}"
        entries.append(entry)
    folder = resources.files("yellowiron.fleet") / "data"
    source = (folder / "index.html").read_text(encoding="utf-8")
    style = (resources.files("yellowiron.report") / "data" / "page.css").read_text(encoding="utf-8")
    colours = style[: style.index("* {")]
    made = source.replace("/*colours*/", colours).replace("<!--title-->", _text(title))
    return made.replace("/*entries*/", _script(entries)).encode("utf-8", errors="replace")


def times(rows: Sequence[Row]) -> bytes:
    """Seconds of each item, by its place on the page."""
    return f"const SECONDS = {_script([row['seconds'] for row in rows])};\n".encode()


def _script(value: Any) -> str:
    """A value inside of a script, whatever letters it has."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _text(words: str) -> str:
    return words.replace("&", "&amp;").replace("<", "&lt;")
