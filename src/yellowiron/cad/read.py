"""`read_cad`: any CAD file to an `Assembly`, by what it holds and not by what it is called.

The reader of third parties runs in a child process (`yellowiron.support.guard`).

Findings:

| code   | severity | says                                                                                       |
|--------|----------|--------------------------------------------------------------------------------------------|
| CAD001 | warning  | fewer occurrences were read than the file declares, or damage that may have cost some      |
| CAD002 | info     | products without usable geometry                                                           |
| CAD003 | error    | a body left out: not finite, too large, or broken                                          |
| CAD004 | warning  | a model too small or too large to be a machine                                             |
| CAD005 | info     | sheets: not closed, so without a volume                                                    |
| CAD006 | warning  | faces that could not be meshed                                                             |
| CAD007 | warning  | a solid whose exact volume is not usable; its mesh's was taken                             |
| CAD008 | error    | files that the file refers to are missing                                                  |
| CAD009 | warning, info | the unit of length is unknown; units are mixed                                        |
| CAD010 | info     | names are not in a standard encoding, and which was taken                                  |
| CAD011 | info     | a body of triangles without surfaces: its measures are theirs, its cylinders are fitted    |
| CAD012 | info     | textures that could not be kept                                                            |
| CAD013 | info     | meshes of several solids, or of twins, were taken apart (`cad.mesh.split`)                 |
| CAD014 | warning  | a format of another installed package that cannot be used                                  |
"""

from __future__ import annotations

from pathlib import Path
from pkgutil import resolve_name

from yellowiron.cad.need import need_mb
from yellowiron.cad.recognition import format_of
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.support.guard import run_guarded

_BESIDE_MB = 896
"""Memory that a reader may take beside what its file needs: with what it may take between two looks, 1 GB."""
_FOLDER = "yellowiron.cad.readers.folder:read_folder"


def check_file(path: str | Path) -> None:
    """What can be said against a CAD file without reading it: `CadError` as of `read_cad` for one that is missing,
    empty, or of no or of an unreadable CAD format."""
    if not Path(path).is_dir():
        format_of(Path(path))


def read_cad(path: str | Path, *, timeout_s: float = 600.0, memory_mb: int = 8192) -> Assembly:
    """The assembly in a CAD file, or in all those of a folder, in metres, in the file's own frame.

    Which formats are read is `formats.FORMATS` and what other packages add to it; cylinders and planes of triangles are
    fitted to them. The reader may take `timeout_s` seconds, `memory_mb` MB of address space, and 1 GB of memory beside
    what a file of its format and size needs (`yellowiron.cad.need`). `CadError` for a file that is missing, empty,
    damaged, of no or of an unreadable CAD format, or without a part in it.
    """
    source = Path(path)
    known = None if source.is_dir() else format_of(source)
    try:
        assembly: Assembly = run_guarded(
            _FOLDER if known is None else known.reader,
            str(source),
            where=str(source),
            error=CadError,
            timeout_s=timeout_s,
            memory_mb=memory_mb,
            resident_mb=min(memory_mb, _BESIDE_MB + need_mb(source, known)),
        )
    except CadError as error:
        # What the reader says itself is better than a guess; a crash or hang says nothing.
        diagnosis = known.diagnosis if known is not None and error.message.startswith("The reader") else ""
        cause = resolve_name(diagnosis)(source.read_bytes()) if diagnosis else ""
        if not cause:
            raise
        symptom = error.message[0].lower() + error.message[1:]
        raise CadError(f"{cause} ({symptom})", where=error.where, hint=error.hint) from error
    return assembly
