"""What an example's script leaves behind: the STEP file, the truth about it, the sheet."""

from __future__ import annotations

import json
import logging
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .product import Assembly, write_step
from .truth import CadFrame


def write_example(
    folder: Path,
    name: str,
    root: Assembly,
    frame: CadFrame,
    document: dict[str, Any],
    sheet: Callable[[Path], None] | None = None,
) -> None:
    """Writes `<name>.step` in that frame, `truth.json` and, where there is one, `specifications.pdf` into `folder`."""
    write_step(root, folder / f"{name}.step", cad=frame.to_cad())
    (folder / "truth.json").write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    if sheet is not None:
        sheet(folder / "specifications.pdf")
    logging.getLogger(__name__).info("%d parts", len(document["parts"]))


def run(main: Callable[[Path], None], script: str) -> None:
    """Runs a script's `main` in the folder that the command line names, else in the script's own."""
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(script).parent)
