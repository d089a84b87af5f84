"""The forklift example drawn with any of its masts, once a run."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

from kit.builds import MadeOnce
from kit.machines.nameless import write_nameless

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
SHEET = EXAMPLES / "forklift" / "specifications.pdf"
MASTS = {"simplex": (0.3, 0.0), "duplex": (0.25, 0.2), "triplex": (0.2, 0.15)}
"""Kinds of masts, and how far the rams at the sides and in the middle are drawn out, metres."""


def drawn(kind: str, made_once: MadeOnce) -> Path:
    """A folder with the example's files, drawn with that mast, and in `nameless` the file without names."""

    def fill(folder: Path) -> None:
        folder.mkdir()
        lift, free = (1000.0 * out for out in MASTS[kind])
        words = (
            "import sys; from pathlib import Path; from forklift.draw import main; from forklift.mast import Mast; "
            f"main(Path(sys.argv[1]), Mast('{kind}', {lift}, {free}))"
        )
        subprocess.run([sys.executable, "-c", words, str(folder)], cwd=EXAMPLES, check=True)
        (folder / "nameless").mkdir()
        write_nameless(folder / "forklift.step", folder / "nameless" / "forklift.step")

    return made_once(f"forklift_{kind}", fill)


def truth_of(folder: Path) -> dict[str, Any]:
    """The truth about what is drawn in a folder."""
    document: dict[str, Any] = json.loads((folder / "truth.json").read_text(encoding="utf-8"))
    return document
