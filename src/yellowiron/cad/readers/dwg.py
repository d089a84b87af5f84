"""A DWG drawing's 3D content to an `Assembly`. Runs in the guard's child process.

DWG is not an open format: a program that is on the path turns it into DXF, LibreDWG's `dwg2dxf` or ODA File Converter
(through ezdxf). What is read is what a DXF file gives: meshes, polyfaces and 3D faces. Solids in ACIS's own form cannot
be: that is said.
"""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from yellowiron.cad.formats import NoReaderError
from yellowiron.cad.readers import dxf
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError

_STEPS = (
    "1. Open the drawing in AutoCAD or BricsCAD; 2. solids: File > Export, type STEP or IGES; meshes: File > Save As, "
    "type DXF; 3. give that file. Or install LibreDWG (dwg2dxf) or ODA File Converter: meshes are then read from the "
    "DWG file itself"
)
_LIBRE = "dwg2dxf"


def require_program(path: str) -> None:
    """`NoReaderError` where nothing is here that reads DWG files."""
    if shutil.which(_LIBRE) is None and not _has_oda():
        words = "A DWG file is read through another program, and none is here"
        raise NoReaderError(words, where=path, hint=f"{_STEPS}.")


def read_dwg(path: str) -> Assembly:
    """The assembly in a DWG file, in metres. `CadError` where nothing here reads it, it is damaged, or holds no 3D
    content that is readable."""
    with _opened(path) as document:
        return dxf.assembled(document, path, "DWG")


@contextmanager
def _opened(path: str) -> Iterator[Any]:
    """The drawing, by the first reader that is here."""
    require_program(path)
    if shutil.which(_LIBRE) is not None:
        with TemporaryDirectory(prefix="yellowiron-") as folder:
            copy = Path(folder, "drawing.dxf")
            _by_libredwg(path, copy)
            yield dxf.opened(str(copy), path)[0]
        return
    from ezdxf.addons import odafc

    try:
        document = odafc.readfile(path)
    except (odafc.ODAFCError, OSError) as error:
        raise _broken(path, "ODA File Converter", error) from error
    yield document


def _has_oda() -> bool:
    from ezdxf.addons import odafc

    return bool(odafc.is_installed())


def _by_libredwg(path: str, copy: Path) -> None:
    done = subprocess.run([_LIBRE, "-y", "-o", str(copy), str(Path(path).absolute())], capture_output=True, check=False)
    # Its exit code counts warnings, too.
    if not copy.is_file() or not copy.stat().st_size:
        words = " ".join(done.stderr.decode(errors="replace").split())[:200]
        raise _broken(path, _LIBRE, words)


def _broken(path: str, reader: str, cause: object) -> CadError:
    words = " ".join(str(cause).split())[:200]
    return CadError(f"The DWG file cannot be read ({reader}): {words}", where=path, hint=f"{_STEPS}.")
