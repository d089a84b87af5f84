"""The skid steer example drawn with either lift path, once a run."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from kit.builds import MadeOnce
from kit.machines.nameless import write_nameless

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def drawn(path: str, made_once: MadeOnce) -> Path:
    """A folder with the example's files, drawn with that lift path, and in `nameless` the file without names."""

    def fill(folder: Path) -> None:
        folder.mkdir()
        words = "import sys; from pathlib import Path; from skid_steer.draw import main; "
        words += "main(Path(sys.argv[1]), sys.argv[2])"
        subprocess.run([sys.executable, "-c", words, str(folder), path], cwd=EXAMPLES, check=True)
        (folder / "nameless").mkdir()
        write_nameless(folder / "skid_steer.step", folder / "nameless" / "skid_steer.step")

    return made_once(f"skid_steer_{path}", fill)
