"""`read_cad`: any CAD file to an `Assembly`, by what it holds and not by what it is called.

The reader of third parties runs in a child process (`yellowiron.guard`).

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

from yellowiron.cad import part21, sniff
from yellowiron.guard import run_guarded
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import CadError

_READERS = {
    "STEP": "yellowiron.cad.step:read_step",
    "IGES": "yellowiron.cad.iges:read_iges",
    "BREP": "yellowiron.cad.occt:read_brep",
    "FreeCAD": "yellowiron.cad.occt:read_freecad",
    "GLB": "yellowiron.cad.gltf:read_gltf",
    "glTF": "yellowiron.cad.gltf:read_gltf",
    "STL": "yellowiron.cad.stl:read_stl",
    "OBJ": "yellowiron.cad.obj:read_obj",
    "PLY": "yellowiron.cad.ply:read_ply",
    "3MF": "yellowiron.cad.threemf:read_3mf",
    "COLLADA": "yellowiron.cad.assimp:read_collada",
    "FBX": "yellowiron.cad.assimp:read_fbx",
    "USD": "yellowiron.cad.usd:read_usd",
    "URDF": "yellowiron.cad.urdf:read_urdf",
    "MJCF": "yellowiron.cad.mjcf:read_mjcf",
    "IFC": "yellowiron.cad.ifc:read_ifc",
    "DXF": "yellowiron.cad.dxf:read_dxf",
    "DWG": "yellowiron.cad.dwg:read_dwg",
    "Blender": "yellowiron.cad.blend:read_blend",
}
"""Format → the function that reads it, in the child process."""
_FOLDER = "yellowiron.cad.folder:read_folder"


def read_cad(path: str | Path, *, timeout_s: float = 600.0, memory_mb: int = 8192) -> Assembly:
    """The assembly in a CAD file, or in all those of a folder, in metres, in the file's own frame.

    Which formats are read is `sniff.READABLE`; cylinders and planes of triangles are fitted to them.
    The reader may take `timeout_s` seconds and `memory_mb` MB. `CadError` for a file that is missing, empty, damaged,
    of no or of an unreadable CAD format, or without a part in it.
    """
    source = Path(path)
    kind = "folder" if source.is_dir() else sniff.format_of(source)
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
