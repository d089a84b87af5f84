"""Writes a machine: every layer authored in memory, then exported. The same inputs give the same bytes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from pxr import Sdf

from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import OutputError
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd.authoring.materials import copy_textures, write_pictures
from yellowiron.usd.authoring.stage import create_layer, define, save_layer
from yellowiron.usd.layers.base import is_mirrored, write_bodies
from yellowiron.usd.layers.brakes import write_brakes, write_pads
from yellowiron.usd.layers.geometry import write_hulls, write_mirrored, write_pieces, write_prototypes, write_solids
from yellowiron.usd.layers.mujoco import write_mujoco
from yellowiron.usd.layers.physics import write_physics
from yellowiron.usd.layers.physx import write_physx
from yellowiron.usd.layers.scene import PAYLOAD_FOLDER, write_machine_layer, write_scene_layer
from yellowiron.usd.layers.sensors import FILE as SENSOR_FILE
from yellowiron.usd.layers.sensors import write_contact_reports, write_sensors
from yellowiron.usd.layers.servos import write_servos
from yellowiron.usd.planning.plan import GEOMETRY_FILE, HULLS, PROTOTYPES, Plan, make_plan

SCENE_FILE = "scene.usda"
TEXTURE_FOLDER = "textures"


def write_machine(
    mechanism: Mechanism,
    assembly: Assembly,
    folder: str | Path,
    *,
    name: str,
    frame: ArrayLike | None = None,
    texture_folders: Sequence[str | Path] = (),
) -> tuple[Path, ...]:
    """Writes `<name>.usda`, `scene.usda` and `payloads/` into `folder`, and returns the files, machine first.

    `frame` (4, 4) takes the assembly's frame to the mechanism's, metres (`Alignment.frame`; None: they are the same).
    `texture_folders` are searched for the texture files that materials name. The folder is made if it is absent; the
    caller that wants all or nothing gives a temporary one and renames it. `MechanismError` where mechanism and assembly
    do not fit, `OutputError` where a file cannot be written or a texture is not found.
    """
    _check_name(name)
    mechanism = _welded(mechanism)
    folder = Path(folder)
    payloads = folder / PAYLOAD_FOLDER
    plan = make_plan(mechanism, assembly, np.eye(4) if frame is None else np.asarray(frame, dtype=np.float64), name)
    named = [p.look.texture for p in plan.prototypes if p.look.texture is not None]
    textures, texture_files = copy_textures(
        named, payloads / TEXTURE_FOLDER, search=[Path(f) for f in texture_folders], relative=f"./{TEXTURE_FOLDER}"
    )
    texture_files += write_pictures((p.look for p in plan.prototypes), payloads)
    machine_file = f"{name}.usda"
    machine, scene = create_layer(plan.root_name), create_layer("World")
    geometry = create_layer(PROTOTYPES[1:], binary=True)
    base, physics, physx, mujoco, sensors = (create_layer(plan.root_name) for _ in range(5))
    with Sdf.ChangeBlock():
        _write_geometry(geometry, plan, textures)
        write_bodies(base, plan)
        write_physics(physics, base, plan)
        write_pads(physics, plan)
        write_physx(physx, base, plan)
        write_brakes(physx, plan, "physx")
        write_contact_reports(physx, plan)
        write_mujoco(mujoco, base, plan)
        write_servos(mujoco, plan)
        write_brakes(mujoco, plan, "newton")
        if mechanism.sensors:
            write_sensors(sensors, plan)
        write_machine_layer(machine, plan)
        write_scene_layer(scene, plan, machine_file)
    layers = {
        folder / machine_file: machine,
        folder / SCENE_FILE: scene,
        payloads / GEOMETRY_FILE: geometry,
        payloads / "base.usda": base,
        payloads / "physics.usda": physics,
        payloads / "physx.usda": physx,
        payloads / "mujoco.usda": mujoco,
    }
    if mechanism.sensors:
        layers[payloads / SENSOR_FILE] = sensors
    return (*(save_layer(layer, path) for path, layer in layers.items()), *texture_files)


def _welded(mechanism: Mechanism) -> Mechanism:
    """The mechanism with welds for joints that are held as drawn: an engine's limits give way."""
    held = {j.name for j in mechanism.joints if j.held}
    joints = (replace(j, type="fixed", lower=None, upper=None) if j.name in held else j for j in mechanism.joints)
    return replace(mechanism, joints=tuple(joints)) if held else mechanism


def _check_name(name: str) -> None:
    """A machine's name is also its file's."""
    if not name or Path(name).name != name or f"{name}.usda" == SCENE_FILE:
        raise OutputError(
            f"'{name}' cannot be the machine's name", where=name, hint="Give a file name; 'scene' is the scene's own."
        )


def _write_geometry(layer: Sdf.Layer, plan: Plan, textures: dict[str, str]) -> None:
    for scope in (PROTOTYPES, HULLS):
        define(layer, scope, "Scope")
    write_prototypes(layer, plan.prototypes, textures)
    placed = [p for body in plan.mechanism.bodies for p in plan.parts[body.name]]
    write_mirrored(layer, (p for p in placed if p.collides and is_mirrored(p.matrix)))
    write_pieces(layer, ((p, is_mirrored(p.matrix)) for p in placed if p.pieces))
    write_solids(layer, plan)
    write_hulls(layer, plan)
