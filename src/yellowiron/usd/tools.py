"""Other machines' tools in a machine's file: what one body looks like and collides with, in a variant set of its own.

A tool is copied from the layers that its machine was written in, to where it is on this machine: its visuals, its
colliders in every detail, its hull and its sites. Nothing else of the file changes, and no body, joint or site comes
or goes, so that variants can stand side by side.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pxr import Gf, Sdf, Tf, Vt

from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Body, Site, Vector
from yellowiron.support.record import COLLIDING, DETAIL, RECORD
from yellowiron.usd.authoring.stage import (
    Types,
    create_layer,
    declare_variants,
    define,
    identifier,
    over,
    save_layer,
    set_attribute,
)
from yellowiron.usd.layers.base import write_site
from yellowiron.usd.layers.scene import ENGINE_LAYERS, PAYLOAD_FOLDER
from yellowiron.usd.planning.plan import COLLIDERS, GEOMETRY_FILE, HULL, MATERIALS, VISUALS

DRAWN = "drawn"
"""The variant with the tool that the machine was built with."""
_FOLDER = "tools"
_HINT = "Build the machine again."


@dataclass(frozen=True, eq=False)
class ToolShape:
    """A tool: `body` and its `sites` as they are on this machine (SI, machine frame), and the machine's `file` that its
    shape is copied from, moved by `shift`, metres, in the body's frame."""

    file: Path
    body: Body
    sites: tuple[Site, ...]
    shift: Vector


def tool_set(body: str) -> str:
    """The name of the variant set of a body's tools."""
    return f"Tool_{identifier(body)}"


def add_tools(machine: Path, body: Body, tools: Mapping[str, ToolShape]) -> None:
    """Writes tools of one body beside a machine's file, and a variant each into it; `drawn` is selected.

    `YellowironError` where a layer of the tool's machine is missing.
    """
    layer = _opened(machine)
    drawn = _Source(machine, body.name)
    root = drawn.root
    spec = over(layer, root)
    name = tool_set(body.name)
    declare_variants(spec, name, (DRAWN, *map(identifier, tools)))
    # The strongest set: what is not drawn in a variant of it is not there, whatever the detail.
    others = [each for each in spec.variantSetNameList.prependedItems if each != name]
    spec.variantSetNameList.prependedItems = [name, *others]
    spec.variantSelections[name] = DRAWN
    for word, tool in tools.items():
        folder = machine.parent / PAYLOAD_FOLDER / _FOLDER / identifier(word)
        _Copy(_Source(tool.file, body.name), drawn, identifier(word), tool).write(folder)
        variant = spec.variantSets[name].variants[identifier(word)].primSpec
        asset = f"./{PAYLOAD_FOLDER}/{_FOLDER}/{identifier(word)}/base.usdc"
        variant.payloadList.prependedItems = [Sdf.Payload(asset)]
        for scope, children in drawn.names().items():
            for child in children:
                path = f"{root}{{{name}={identifier(word)}}}{drawn.prim}/{scope}/{child}"
                over(layer, path).SetInfo("active", False)
    layer.Save()


def _opened(path: Path) -> Sdf.Layer:
    try:
        layer = Sdf.Layer.FindOrOpen(str(path))
    except Tf.ErrorException:
        layer = None
    if layer is None:
        raise YellowironError("A layer of the machine cannot be read", where=str(path), hint=_HINT)
    return layer


class _Source:
    """One body in the layers of a machine's file: `prim` is its name there."""

    def __init__(self, file: Path, body: str) -> None:
        folder = file.parent / PAYLOAD_FOLDER
        self.base = _opened(folder / "base.usda")
        self.geometry = _opened(folder / GEOMETRY_FILE)
        self.engines = {name: _opened(folder / name) for name in ENGINE_LAYERS}
        self.root = f"/{self.base.defaultPrim}"
        bodies = self.base.GetPrimAtPath(self.root).nameChildren
        found = [spec.name for spec in bodies if _record(spec) == ("body", body)]
        if not found:
            raise YellowironError(f"The machine's file has no body '{body}'", where=str(file), hint=_HINT)
        self.prim = found[0]
        self.sites: dict[str, str] = {}
        for spec in self.base.GetPrimAtPath(f"{self.root}/{self.prim}").nameChildren:
            kind, name = _record(spec)
            if kind == "site":
                self.sites[name] = spec.name

    def names(self) -> dict[str, list[str]]:
        """What is seen and collides, in whichever detail, by scope."""
        scopes: dict[str, list[str]] = {VISUALS: [], COLLIDERS: []}
        for scope, _, spec in self.shapes(self.base):
            if spec.name not in scopes[scope]:
                scopes[scope].append(spec.name)
        return scopes

    def shapes(self, layer: Sdf.Layer) -> Iterator[tuple[str, str, Sdf.PrimSpec]]:
        """What a layer says of them: scope, detail ("": in all) and prim."""
        for scope in (VISUALS, COLLIDERS):
            for detail in ("", *COLLIDING):
                at = layer.GetPrimAtPath(_placed(self.root, detail, f"{self.prim}/{scope}"))
                for spec in at.nameChildren if at else ():
                    yield scope, detail, spec


def _record(spec: Sdf.PrimSpec) -> tuple[str, str]:
    record = spec.customData.get(RECORD) or {}
    return str(record.get("kind", "")), str(record.get("name", ""))


def _placed(root: str, detail: str, path: str) -> str:
    return f"{root}{{{DETAIL}={detail}}}{path}" if detail else f"{root}/{path}"


class _Copy:
    """A tool's layers, made from those of its machine, to lie over those of the machine that it is put to."""

    def __init__(self, source: _Source, drawn: _Source, word: str, tool: ToolShape) -> None:
        self.source, self.word, self.tool = source, word, tool
        self.root, self.prim, self.sites = drawn.root, drawn.prim, drawn.sites

    def write(self, folder: Path) -> None:
        """Writes them."""
        base = self._layer()
        spec = define(base, self.root, "Xform")
        self._copy(self.source.base, base)
        scope = base.GetPrimAtPath(f"{self.root}/{self.prim}/{COLLIDERS}")
        if scope is not None:
            define(base, str(scope.path), "Scope")
            set_attribute(scope, "purpose", Types.Token, "guide", uniform=True)
        hull = self.source.base.GetPrimAtPath(f"{self.source.root}/{self.source.prim}/{HULL}")
        if hull is not None:
            self._put(self.source.base, hull, base, f"{self.root}/{self.prim}/{HULL}")
        for site in self.tool.sites:
            path = f"{self.root}/{self.prim}/{self.sites[site.name]}"
            write_site(base, path, site, self.tool.body)
            if "xformOpOrder" not in base.GetPrimAtPath(path).attributes:
                _set_order(base.GetPrimAtPath(path), [])
        engines = dict(self._engines())
        if engines:
            declare_variants(spec, "Physics", ("on", "off"))
            variant = spec.variantSets["Physics"].variants["on"].primSpec
            variant.payloadList.prependedItems = [Sdf.Payload(f"./{name}") for name in engines]
        for name, layer in {"base.usdc": base, GEOMETRY_FILE: self._geometry(base), **engines}.items():
            save_layer(layer, folder / name)

    def _layer(self) -> Sdf.Layer:
        return create_layer(self.root[1:], binary=True)

    def _engines(self) -> Iterator[tuple[str, Sdf.Layer]]:
        """What engines are told of the colliders; materials that colliders are of with them."""
        for name, source in self.source.engines.items():
            layer = self._layer()
            define(layer, self.root)
            over(layer, self.root).specifier = Sdf.SpecifierOver
            if self._copy(source, layer):
                for material in sorted(self._bound(layer)):
                    spec = source.GetPrimAtPath(f"{self.source.root}/{MATERIALS}/{material}")
                    if spec is not None:
                        self._put(source, spec, layer, f"{self.root}/{MATERIALS}/{material}")
                yield name.replace(".usda", ".usdc"), layer

    def _copy(self, source: Sdf.Layer, into: Sdf.Layer) -> int:
        """Copies what a layer says of the shapes: of how many."""
        found = list(self.source.shapes(source))
        if any(detail for _, detail, _ in found):
            declare_variants(over(into, self.root), DETAIL, COLLIDING)
        for scope, detail, spec in found:
            path = _placed(self.root, detail, f"{self.prim}/{scope}/{self.word}_{spec.name}")
            copied = self._put(source, spec, into, path)
            if copied.specifier == Sdf.SpecifierDef:
                self._shift(copied)
        if any(scope == VISUALS for scope, _, _ in found):
            define(into, f"{self.root}/{self.prim}/{VISUALS}", "Scope")
        return len(found)

    def _put(self, source: Sdf.Layer, spec: Sdf.PrimSpec, into: Sdf.Layer, path: str) -> Sdf.PrimSpec:
        over(into, str(Sdf.Path(path).GetParentPath()))
        Sdf.CopySpec(source, spec.path, into, path)
        copied = into.GetPrimAtPath(path)
        waiting = [copied]
        while waiting:
            each = waiting.pop()
            waiting += each.nameChildren
            for relation in each.relationships:
                targets = relation.targetPathList
                targets.explicitItems = [self._there(target) for target in targets.explicitItems]
        return copied

    def _there(self, target: Sdf.Path) -> Sdf.Path:
        """A path under the tool's machine as it is under this one."""
        return target.ReplacePrefix(self.source.root, self.root)

    def _shift(self, spec: Sdf.PrimSpec) -> None:
        by = Gf.Vec3d(*self.tool.shift)
        if by == Gf.Vec3d(0.0):
            return
        whole, place = (spec.attributes.get(f"xformOp:{name}") for name in ("transform", "translate"))
        if whole is not None:
            matrix = Gf.Matrix4d(whole.default)
            whole.default = matrix.SetTranslateOnly(matrix.ExtractTranslation() + by)
        elif place is not None:
            place.default = Gf.Vec3d(place.default) + by
        else:
            order = spec.attributes.get("xformOpOrder")
            before = list(order.default) if order is not None else []
            set_attribute(spec, "xformOp:translate", Types.Double3, by)
            _set_order(spec, ["xformOp:translate", *before])

    def _bound(self, layer: Sdf.Layer) -> set[str]:
        """The materials that a layer's shapes are bound to."""
        found: set[str] = set()
        scope = f"{self.root}/{MATERIALS}/"

        def look(path: Sdf.Path) -> None:
            if path.IsTargetPath() and str(path.targetPath).startswith(scope):
                found.add(path.targetPath.name)

        layer.Traverse("/", look)
        return found

    def _geometry(self, base: Sdf.Layer) -> Sdf.Layer:
        """The meshes that the tool's prims refer to, and those that these do."""
        layer = Sdf.Layer.CreateAnonymous(".usdc")
        source = self.source.geometry
        waiting = [reference.primPath for reference in _references(base) if reference.assetPath]
        while waiting:
            path = waiting.pop()
            if layer.GetPrimAtPath(path):
                continue
            over(layer, str(path.GetParentPath()))
            Sdf.CopySpec(source, path, layer, path)
            waiting += [each.primPath for each in _references(layer) if not each.assetPath]
            waiting = [each for each in dict.fromkeys(waiting) if layer.GetPrimAtPath(each) is None]
        return layer


def _set_order(spec: Sdf.PrimSpec, names: Sequence[str]) -> None:
    set_attribute(spec, "xformOpOrder", Types.TokenArray, Vt.TokenArray(names), uniform=True)


def _references(layer: Sdf.Layer) -> Sequence[Sdf.Reference]:
    found: list[Sdf.Reference] = []

    def look(path: Sdf.Path) -> None:
        if path.IsPrimPath() or path.IsPrimVariantSelectionPath():
            spec = layer.GetPrimAtPath(path)
            if spec is not None:
                found.extend(spec.referenceList.prependedItems)

    layer.Traverse("/", look)
    return found
