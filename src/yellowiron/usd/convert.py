"""CAD to clean USD and nothing else: the CAD file's tree, instances kept as instances, colours, metres."""

from __future__ import annotations

from pathlib import Path

from pxr import Sdf

from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import OutputError
from yellowiron.support.output import output_file
from yellowiron.usd.authoring.materials import Look, look_of, write_pictures
from yellowiron.usd.authoring.metadata import set_custom
from yellowiron.usd.authoring.stage import (
    Names,
    add_reference,
    create_layer,
    define,
    save_layer,
    set_display_name,
    set_transform,
)
from yellowiron.usd.layers.geometry import write_prototypes
from yellowiron.usd.planning.plan import Prototypes

SUFFIXES = (".usd", ".usda", ".usdc")
_SHAPES = "Shapes"


def write_assembly(assembly: Assembly, path: str | Path) -> Path:
    """Writes an assembly as one USD file, in the CAD file's own frame, and returns its path.

    The tree of the CAD file becomes Xforms; every part is an instanceable reference to its shape, which lives in the
    same file; textures are written into `textures/` beside it. The file appears whole or not at all. `OutputError` for
    another extension or an unwritable place.
    """
    target = Path(path)
    check_target(target)
    layer, looks = _author(assembly, binary=target.suffix.lower() != ".usda")
    with output_file(target) as file:
        save_layer(layer, file)
        write_pictures(looks, file.parent)
    return target


def check_target(target: Path) -> None:
    """`OutputError` where a path cannot be a USD file's."""
    if target.suffix.lower() not in SUFFIXES:
        raise OutputError(
            f"'{target.suffix}' is no USD extension", where=str(target), hint=f"Use {', '.join(SUFFIXES)}."
        )
    if target.is_dir():
        raise OutputError("The output file is a folder", where=str(target), hint="Name a file.")


def _author(assembly: Assembly, *, binary: bool) -> tuple[Sdf.Layer, list[Look]]:
    names = Names()
    root = f"/{names.give(assembly.name or 'assembly')}"
    layer = create_layer(root[1:], binary=binary)
    prototypes = Prototypes(f"/{names.give(_SHAPES)}")
    with Sdf.ChangeBlock():
        spec = define(layer, root, "Xform")
        set_display_name(spec, assembly.name)
        spec.SetInfo("kind", "component")
        tree = _Tree(layer, root, assembly.name)
        for part in assembly.parts:
            shape = assembly.shape_of(part)
            prototype = prototypes.give(shape, look_of(part.color, shape, None))
            spec = define(layer, tree.leaf(part.path, part.name or shape.name), "Xform")
            set_display_name(spec, part.name)
            set_transform(spec, part.transform)
            spec.SetInfo("instanceable", True)
            add_reference(spec, "", prototype.path)
            set_custom(spec, {"part": part.id})
        define(layer, prototypes.root, abstract=True)
        write_prototypes(layer, prototypes.prototypes, {})
    return layer, [prototype.look for prototype in prototypes.prototypes]


class _Tree:
    """Paths of the groups and leaves of the CAD tree. A top assembly that is named like the file is the root prim."""

    def __init__(self, layer: Sdf.Layer, root: str, name: str) -> None:
        self._layer = layer
        self._groups: dict[tuple[str, ...], str] = {}
        self._names: dict[str, Names] = {}
        self._root = root
        self._name = name

    def leaf(self, path: tuple[str, ...], name: str) -> str:
        """The path of a part's prim, its groups defined."""
        groups = path[1:] if path[:1] == (self._name,) else path
        parent = self._root
        for depth in range(len(groups)):
            parent = self._group(parent, groups[: depth + 1])
        return f"{parent}/{self._give(parent, name)}"

    def _group(self, parent: str, key: tuple[str, ...]) -> str:
        if key not in self._groups:
            path = f"{parent}/{self._give(parent, key[-1])}"
            set_display_name(define(self._layer, path, "Xform"), key[-1])
            self._groups[key] = path
        return self._groups[key]

    def _give(self, parent: str, name: str) -> str:
        return self._names.setdefault(parent, Names()).give(name or "part")
