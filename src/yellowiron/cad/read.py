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
| CAD013 | info     | meshes that hold several solids were taken apart (`taken_apart`)                           |
"""

from __future__ import annotations

from pathlib import Path

from yellowiron.cad import formats
from yellowiron.cad.readers.exact import part21
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError
from yellowiron.support.guard import run_guarded

_READERS = {
    "STEP": "yellowiron.cad.readers.exact.step:read_step",
    "IGES": "yellowiron.cad.readers.exact.iges:read_iges",
    "BREP": "yellowiron.cad.readers.exact.occt:read_brep",
    "FreeCAD": "yellowiron.cad.readers.exact.occt:read_freecad",
    "GLB": "yellowiron.cad.readers.meshes.gltf:read_gltf",
    "glTF": "yellowiron.cad.readers.meshes.gltf:read_gltf",
    "STL": "yellowiron.cad.readers.meshes.stl:read_stl",
    "OBJ": "yellowiron.cad.readers.meshes.obj:read_obj",
    "PLY": "yellowiron.cad.readers.meshes.ply:read_ply",
    "3MF": "yellowiron.cad.readers.meshes.threemf:read_3mf",
    "COLLADA": "yellowiron.cad.readers.meshes.assimp:read_collada",
    "FBX": "yellowiron.cad.readers.meshes.assimp:read_fbx",
    "USD": "yellowiron.cad.readers.usd.stage:read_usd",
    "URDF": "yellowiron.cad.readers.robots.urdf:read_urdf",
    "MJCF": "yellowiron.cad.readers.robots.mjcf:read_mjcf",
    "IFC": "yellowiron.cad.readers.ifc:read_ifc",
    "DXF": "yellowiron.cad.readers.dxf:read_dxf",
    "DWG": "yellowiron.cad.readers.dwg:read_dwg",
    "Blender": "yellowiron.cad.readers.meshes.blend:read_blend",
}
"""Format → the function that reads it, in the child process."""
_FOLDER = "yellowiron.cad.readers.folder:read_folder"


def read_cad(path: str | Path, *, timeout_s: float = 600.0, memory_mb: int = 8192) -> Assembly:
    """The assembly in a CAD file, or in all those of a folder, in metres, in the file's own frame.

    Which formats are read is `sniff.READABLE`; cylinders and planes of triangles are fitted to them.
    The reader may take `timeout_s` seconds and `memory_mb` MB. `CadError` for a file that is missing, empty, damaged,
    of no or of an unreadable CAD format, or without a part in it.
    """
    source = Path(path)
    kind = "folder" if source.is_dir() else formats.format_of(source)
    target, arguments = (_FOLDER, (_READERS,)) if source.is_dir() else (_READERS[kind], ())
    try:
        assembly: Assembly = run_guarded(
            target,
            str(source),
            *arguments,
            where=str(source),
            error=CadError,
            timeout_s=timeout_s,
            memory_mb=memory_mb,
        )
    except CadError as error:
        # What the reader says itself is better than a guess; a crash or hang says nothing.
        silent = kind == "STEP" and error.message.startswith("The reader")
        cause = part21.diagnose(source.read_bytes()) if silent else ""
        if not cause:
            raise
        symptom = error.message[0].lower() + error.message[1:]
        raise CadError(f"{cause} ({symptom})", where=error.where, hint=error.hint) from error
    return assembly
