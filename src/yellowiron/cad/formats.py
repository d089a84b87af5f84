"""The registry of CAD formats: one entry a format, `CadFormat`.

A new format is one entry and the module that reads it. The entry stands in `FORMATS`, or comes from another installed
package by an entry point of the group `yellowiron.cad_formats` that names a `CadFormat`. What a file is,
`yellowiron.cad.recognition` decides; the formats of this package come first, so that what it reads is read the same
whatever else is installed.
"""

from __future__ import annotations

import functools
import re
import sys
from dataclasses import dataclass

from yellowiron.model.errors import CadError, YellowironError
from yellowiron.model.finding import Finding
from yellowiron.support.plugins import all_plugins

GROUP = "yellowiron.cad_formats"
"""The entry points that name the formats of other packages."""
_FUNCTION = re.compile(r"[\w.]+:\w+")
_SUFFIX = re.compile(r"\.[a-z0-9_]+")


class NoReaderError(CadError):
    """A CAD file that is whole as far as is known, and that nothing here can read: its hint says how to export."""


@dataclass(frozen=True)
class CadFormat:
    """A format: how its files are recognised, and what reads them. `ValueError` for an entry that cannot work.

    Functions are named "module:function", and imported when they are called: readers load large libraries.
    """

    name: str
    """As messages and `Assembly.format` have it."""
    suffixes: tuple[str, ...]
    """Of its files, in small letters, each with its dot."""
    reader: str
    """`(path: str) -> Assembly` in metres, or a `CadError`. It runs in a child process."""
    content: re.Pattern[bytes] | None = None
    """Matches the beginning of a file (its first 64 kB) that has the format, whatever the file's name."""
    member: re.Pattern[str] | None = None
    """Is found in the name, in small letters, of a file in a zip archive that has the format."""
    plausible: re.Pattern[bytes] | None = None
    """Matches the beginning of every file whose suffix is to be believed; without it any is."""
    meshes: str = ""
    """`(file: Path, findings: list[Finding]) -> list[tuple[str, Dressed]]`, where the format has no unit of length: the
    names and meshes in a file, in its own numbers, for a folder whose files are to share one guessed unit."""
    needs: str = ""
    """`(path: str) -> None`: raises `NoReaderError` where a program that the reader needs is not here."""
    memory: int = 200
    """Times its bytes, unpacked, that its reader may take beside 1 GB: half as much again as sound models took
    (docs/security.md)."""
    others: re.Pattern[str] | None = None
    """Is found in the name, in small letters, of a file that one of the format may refer to, and whose triangles are
    then read with it."""
    beside: re.Pattern[str] | None = None
    """Is found in the name, in small letters, of a file in the folder of one of the format that may be read with it:
    geometry, materials, pictures. None: a file is all that there is."""
    anywhere: bool = False
    """Whether its files may refer to others that are not in their folder."""
    diagnosis: str = ""
    """`(data: bytes) -> str`: what is wrong with a file at which the reader crashed or hung; "" if it cannot tell. It
    runs in this process."""

    def __post_init__(self) -> None:
        if not self.name:
            raise ValueError("a format needs a name")
        for target in (self.reader, *filter(None, (self.meshes, self.needs, self.diagnosis))):
            if not _FUNCTION.fullmatch(target):
                raise ValueError(f"'{target}' is not of the form module:function")
        for suffix in self.suffixes:
            if not _SUFFIX.fullmatch(suffix):
                raise ValueError(f"the suffix '{suffix}' is not a dot and small letters")
        if not self.suffixes and self.content is None and self.member is None:
            raise ValueError("nothing says how its files are recognised")


_TEXT = rb"\A(?=[^\0]{4096}|[^\0]*\Z)"
"""No zero byte in the first 4096."""
_PLAIN = re.compile(_TEXT)
_NEVER = re.compile(rb"(?!)")
# A comment ends where it first can: the group gives nothing back.
_PART21 = rb"\A\s*(?>/(?=\*).*?\*/\s*)*ISO-10303-21"
_ROOT = rb"\A(?:\xef\xbb\xbf)?(?:\s|<\?.*?\?>|<!--.*?-->|<!DOCTYPE[^>]*>)*<(?:\w+:)?%s(?!\w)"
"""An XML document by its root."""


def _starts(pattern: bytes) -> re.Pattern[bytes]:
    return re.compile(pattern, re.DOTALL)


_MESH_FILES, _BUFFERS, _LAYERS = (
    re.compile(pattern) for pattern in (r"\.(?:stl|obj|dae|glb|gltf|bin)\Z", r"\.bin\Z", r"\.usd[acz]?\Z")
)
_BESIDE = re.compile(r"\.(?:bin|mtl|png|jpe?g|webp|tga|bmp|gif|tiff?|dds|ktx2?)\Z")
_MESHES, _EXACT = "yellowiron.cad.readers.meshes", "yellowiron.cad.readers.exact"
_ROBOTS = "yellowiron.cad.readers.robots"

FORMATS: tuple[CadFormat, ...] = (
    CadFormat(
        "IFC", (".ifc",), "yellowiron.cad.readers.ifc:read_ifc", plausible=_PLAIN,
        content=_starts(rb"(?=%s).*?FILE_SCHEMA\s*\(\s*\(\s*'IFC" % _PART21),
    ),
    CadFormat(
        "STEP", (".step", ".stp", ".p21"), f"{_EXACT}.step:read_step", content=_starts(_PART21), plausible=_NEVER,
        diagnosis=f"{_EXACT}.part21:diagnose",
        memory=40,
    ),
    CadFormat(
        "DWG", (".dwg",), "yellowiron.cad.readers.dwg:read_dwg", content=_starts(rb"AC10\d\d"),
        needs="yellowiron.cad.readers.dwg:require_program",
    ),
    CadFormat(
        "FreeCAD", (".fcstd",), f"{_EXACT}.freecad:read_freecad", member=re.compile(r"\Adocument\.xml\Z"), memory=60,
    ),
    CadFormat("3MF", (".3mf",), f"{_MESHES}.threemf:read_3mf", member=re.compile(r"\.model\Z"), memory=60),
    CadFormat(
        "GLB", (".glb",), f"{_MESHES}.gltf:read_gltf", content=_starts(rb"glTF"),
        memory=150, others=_BUFFERS, beside=_BESIDE,
    ),
    CadFormat(
        "FBX", (".fbx",), f"{_MESHES}.assimp:read_fbx", content=_starts(rb"Kaydara FBX|\s*; FBX \d"),
        memory=200, beside=_BESIDE,
    ),
    CadFormat(
        "USD", (".usd", ".usda", ".usdc", ".usdz"), "yellowiron.cad.readers.usd.stage:read_usd",
        content=_starts(rb"PXR-USDC|#usda"), member=re.compile(r"\.usd[ac]?\Z"),
        memory=300, others=_LAYERS, anywhere=True,
    ),
    CadFormat("Blender", (".blend",), f"{_MESHES}.blend:read_blend", content=_starts(rb"BLENDER"), anywhere=True),
    CadFormat(
        "PLY", (".ply",), f"{_MESHES}.ply:read_ply", content=_starts(rb"ply[ \t]*\r?\n"), plausible=_PLAIN,
        meshes=f"{_MESHES}.ply:meshes_of",
        memory=150,
    ),
    CadFormat(
        "BREP", (".brep", ".brp"), f"{_EXACT}.brep_file:read_brep", plausible=_PLAIN,
        content=_starts(rb"\s*(?:DBRep_DrawableShape|(?:Open )?CASCADE Topology V)"),
        memory=60,
    ),
    CadFormat(
        "DXF", (".dxf",), "yellowiron.cad.readers.dxf:read_dxf", plausible=_PLAIN,
        content=re.compile(rb"AutoCAD Binary DXF|\s*(?:999\r?\n.*\r?\n)*\s*0\r?\n\s*SECTION\r?\n"),
        memory=60,
    ),
    CadFormat(
        "COLLADA", (".dae",), f"{_MESHES}.assimp:read_collada", content=_starts(_ROOT % b"COLLADA"), plausible=_PLAIN,
        memory=100, beside=_BESIDE,
    ),
    CadFormat(
        "URDF", (".urdf",), f"{_ROBOTS}.urdf:read_urdf", content=_starts(_ROOT % b"robot"),
        memory=150, others=_MESH_FILES, anywhere=True,
    ),
    CadFormat(
        "MJCF", (".mjcf",), f"{_ROBOTS}.mjcf:read_mjcf", content=_starts(_ROOT % b"mujoco"),
        memory=150, others=_MESH_FILES, anywhere=True,
    ),
    CadFormat(
        "IGES", (".igs", ".iges"), f"{_EXACT}.iges:read_iges", content=_starts(rb".{72}S {6}1[ \r\n]"), memory=60,
    ),
    CadFormat(
        "glTF", (".gltf",), f"{_MESHES}.gltf:read_gltf", plausible=_starts(rb"[\xef\xbb\xbf \t\r\n]*\{"),
        memory=150, others=_BUFFERS, beside=_BESIDE,
    ),
    CadFormat(
        "STL", (".stl",), f"{_MESHES}.stl:read_stl", meshes=f"{_MESHES}.stl:meshes_of",
        plausible=_starts(rb"\s*solid|(?=.{84})[^\0]{0,4095}\0"),
        memory=60,
    ),
    CadFormat(
        "OBJ", (".obj",), f"{_MESHES}.obj:read_obj", meshes=f"{_MESHES}.obj:meshes_of",
        plausible=re.compile(_TEXT + rb"(?s:.*?)^[ \t]*(?:v|vn|vt|f|o|g|mtllib|usemtl)[ \t]", re.MULTILINE),
        memory=80, beside=_BESIDE,
    ),
)  # fmt: skip
"""The formats of this package, in the order in which a file is tried for them."""


def others() -> tuple[tuple[CadFormat, ...], tuple[Finding, ...]]:
    """The formats of other installed packages, in the order of their entry points' names; and a finding (CAD014) for
    each that cannot be used: it does not load, or its name is another's."""
    return _others(tuple(sys.path))


@functools.cache
def _others(path: tuple[str, ...]) -> tuple[tuple[CadFormat, ...], tuple[Finding, ...]]:
    """As above, once for every import path."""
    taken = {known.name.casefold(): "yellowiron" for known in FORMATS}
    formats, findings = [], []
    for plugin in all_plugins(GROUP):
        try:
            found, reason = plugin.load(CadFormat), ""
            if owner := taken.get(found.name.casefold()):
                reason = f"{owner} has a format of the name {found.name}"
        except YellowironError as error:
            reason = error.message
        if reason:
            words = f"The CAD format of {plugin.package} cannot be used: {reason}"
            findings.append(
                Finding("CAD014", "warning", plugin.entry.value, words, "Update the package, or remove it.")
            )
        else:
            taken[found.name.casefold()] = plugin.package
            formats.append(found)
    return tuple(formats), tuple(findings)
