"""Layers of a stage: their units, what they refer to, and whether physics stays where it belongs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import PurePosixPath, PureWindowsPath

from pxr import Sdf, Usd, UsdGeom, UsdPhysics

from yellowiron.checks.reading.bodies import record_of
from yellowiron.checks.values import Units

VARIANTS = "Physics"
_OFF = "off"
PROVIDED = (".mdl",)
"""Kinds of assets that applications bring along: not missing where they are not beside the file."""
_STRAY = ("physics:", "drive:", "limit:", "physxJoint", "physxArticulation", "newton:", "mjc:")


def read_units(stage: Usd.Stage) -> Units:
    """The stage's units; UsdGeom's and UsdPhysics' defaults (centimetres, kilograms) apply where none are authored,
    and 1 where they are no positive number."""
    meters = stage.GetMetadata("metersPerUnit") if stage.HasAuthoredMetadata("metersPerUnit") else None
    kilograms = stage.GetMetadata("kilogramsPerUnit") if stage.HasAuthoredMetadata("kilogramsPerUnit") else None
    up = str(stage.GetMetadata("upAxis")) if stage.HasAuthoredMetadata("upAxis") else None
    return Units(
        meters=meters,
        kilograms=kilograms,
        up_axis=up,
        meters_per_unit=_usable(UsdGeom.GetStageMetersPerUnit(stage)),
        kilograms_per_unit=_usable(UsdPhysics.GetStageKilogramsPerUnit(stage)),
    )


def _usable(value: float) -> float:
    return float(value) if math.isfinite(value) and value > 0.0 else 1.0


def name_of(layer: Sdf.Layer) -> str:
    """A layer's file name: findings do not depend on the folder."""
    return PurePosixPath(layer.identifier.replace("\\", "/")).name


def used_layers(stage: Usd.Stage) -> list[Sdf.Layer]:
    """The layers of files, the root layer first, then by name."""
    layers = [layer for layer in stage.GetUsedLayers() if not layer.anonymous and layer != stage.GetRootLayer()]
    return [stage.GetRootLayer(), *sorted(layers, key=lambda layer: layer.identifier)]


def layer_units(stage: Usd.Stage) -> Iterator[tuple[str, float | None, str | None]]:
    """File name, metres per unit and up axis of every layer besides the root layer, as authored."""
    for layer in used_layers(stage)[1:]:
        info = layer.pseudoRoot
        yield (
            name_of(layer),
            info.GetInfo("metersPerUnit") if info.HasInfo("metersPerUnit") else None,
            str(info.GetInfo("upAxis")) if info.HasInfo("upAxis") else None,
        )


def broken_references(stage: Usd.Stage) -> Iterator[tuple[str, str]]:
    """(prim, what USD says) of every composition error."""
    for error in stage.GetCompositionErrors():
        where = getattr(error, "rootSite", None)
        path = str(where.path) if where else name_of(stage.GetRootLayer())
        yield path, " ".join(_without_folders(str(error), stage).split())


def _without_folders(text: str, stage: Usd.Stage) -> str:
    folder = str(PurePosixPath(stage.GetRootLayer().realPath.replace("\\", "/")).parent)
    return text.replace(f"{folder}/", "")


def missing_assets(stage: Usd.Stage) -> Iterator[str]:
    """Textures and other files that do not resolve; layers that do not are composition errors."""
    seen = set()
    for prim in stage.TraverseAll():
        for attribute in prim.GetAuthoredAttributes():
            if attribute.GetTypeName() != Sdf.ValueTypeNames.Asset:
                continue
            asset = attribute.Get()
            path = asset.path if asset else ""
            if path and not asset.resolvedPath and not path.lower().endswith(PROVIDED) and path not in seen:
                if "://" not in path and "<UDIM>" not in path:
                    yield f"{attribute.GetPath()}: {path}"
                seen.add(path)


def absolute_paths(stage: Usd.Stage) -> Iterator[tuple[str, str]]:
    """(file, path) of every reference that only this computer can follow."""
    assets = _asset_paths(stage)
    for layer in used_layers(stage):
        for path in sorted({*layer.GetCompositionAssetDependencies(), *assets.get(layer.identifier, ())}):
            if PurePosixPath(path).is_absolute() or PureWindowsPath(path).is_absolute() or path.startswith("file:"):
                yield name_of(layer), path


def _asset_paths(stage: Usd.Stage) -> dict[str, list[str]]:
    """Layer → the paths that its asset attributes hold."""
    found: dict[str, list[str]] = {}
    for prim in stage.TraverseAll():
        for attribute in prim.GetAuthoredAttributes():
            if attribute.GetTypeName() == Sdf.ValueTypeNames.Asset:
                for spec in attribute.GetPropertyStack():
                    if spec.default:
                        found.setdefault(spec.layer.identifier, []).append(spec.default.path)
    return found


def find_machine(stage: Usd.Stage) -> Usd.Prim | None:
    """The prim of a machine that yellowiron built, or None."""
    for prim in stage.Traverse():
        if "equipmentType" in record_of(prim):
            return prim
    return None


def stray_physics(stage: Usd.Stage, machine: Usd.Prim | None) -> Iterator[str]:
    """Prims of a built machine that still have physics with its physics switched off: opinions outside the layers
    that the variant brings."""
    if machine is None or _OFF not in machine.GetVariantSet(VARIANTS).GetVariantNames():
        return
    session = Sdf.Layer.CreateAnonymous()
    off = Usd.Stage.Open(stage.GetRootLayer(), session)
    with Usd.EditContext(off, session):
        off.GetPrimAtPath(machine.GetPath()).GetVariantSet(VARIANTS).SetVariantSelection(_OFF)
    prim = off.GetPrimAtPath(machine.GetPath())
    for found in Usd.PrimRange(prim, Usd.PrimAllPrimsPredicate):
        schemas = any(s.startswith("Physics") for s in found.GetAppliedSchemas())
        if schemas or any(p.GetName().startswith(_STRAY) for p in found.GetAuthoredProperties()):
            yield str(found.GetPath())
