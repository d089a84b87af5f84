"""An MJCF file to an `Assembly`, at its zero configuration. Runs in the guard's child process.

MuJoCo compiles it. What is drawn becomes parts, every body an assembly in the tree; what only collides stands in where
nothing is drawn. The joints are kept as the file declares them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.cad.mesh import assembly, polygons
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name
from yellowiron.cad.readers.declared import declared_joint
from yellowiron.model.assembly import Assembly, DeclaredJoint
from yellowiron.model.errors import CadError
from yellowiron.model.geometry import Mesh
from yellowiron.support.vectors import triple

_DAMAGED = "Check the file with MuJoCo's own viewer."
_HIDDEN_GROUPS = 3
"""Geoms of this group and above are not drawn by MuJoCo's viewers unless asked for: colliders, by custom."""


def read_mjcf(path: str) -> Assembly:
    """The assembly in an MJCF file, in metres, at the zero configuration, as MuJoCo compiles it. `CadError` with
    MuJoCo's word if it does not."""
    import mujoco

    # Else a warning is written to a file in the working folder; what it is about is found here or refused.
    mujoco.set_mju_user_warning(lambda message: None)
    try:
        spec = _spec(path)
        # Nothing may be left out or made one because it does not collide or move.
        spec.compiler.discardvisual = False
        spec.compiler.fusestatic = False
        model = spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        words = " ".join(str(error).split())[:200]
        raise CadError(f"MuJoCo cannot read the MJCF file: {words}", where=path, hint=_DAMAGED) from error
    data = mujoco.MjData(model)
    data.qpos[:] = model.qpos0
    mujoco.mj_kinematics(model, data)
    geoms = range(model.ngeom)
    drawn = {int(model.geom_bodyid[g]) for g in geoms if model.geom_group[g] < _HIDDEN_GROUPS}
    meshes: dict[tuple[Any, ...], Mesh] = {}
    occurrences = []
    declared = 0
    for g in geoms:
        body = int(model.geom_bodyid[g])
        kind = mujoco.mjtGeom(int(model.geom_type[g]))
        hidden = model.geom_group[g] >= _HIDDEN_GROUPS and body in drawn
        if hidden or kind in (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD):
            continue
        declared += 1
        size = tuple(float(v) for v in model.geom_size[g])
        index = int(model.geom_dataid[g]) if kind == mujoco.mjtGeom.mjGEOM_MESH else -1
        key = (kind, size) if index < 0 else (kind, index)
        if key not in meshes:
            meshes[key] = _geom(model, kind, index, size)
        place = np.eye(4)
        place[:3, :3] = data.geom_xmat[g].reshape(3, 3)
        place[:3, 3] = data.geom_xpos[g]
        chain = _bodies(model, body)
        name = model.geom(g).name or (model.mesh(index).name if index >= 0 else "") or (*chain, "geom")[-1]
        material = int(model.geom_matid[g])
        rgba = model.mat_rgba[material] if material >= 0 else model.geom_rgba[g]
        occurrences.append(Occurrence(decode_name(name, "utf-8"), chain, meshes[key], place, triple(rgba[:3])))
    read = assembly.assemble(
        occurrences, name=spec.modelname or Path(path).stem, format="MJCF", unit=1.0, path=path, declared=declared
    )
    return replace(read, joints=tuple(_mjcf_joints(model, data)))


def _geom(model: Any, kind: Any, index: int, size: tuple[float, ...]) -> Mesh:
    """A geom's triangles in its own frame."""
    import mujoco

    types = mujoco.mjtGeom
    if kind == types.mjGEOM_MESH:
        first, count = int(model.mesh_vertadr[index]), int(model.mesh_vertnum[index])
        start, faces = int(model.mesh_faceadr[index]), int(model.mesh_facenum[index])
        points = np.asarray(model.mesh_vert[first : first + count], dtype=np.float64)
        return Mesh(points, np.array(model.mesh_face[start : start + faces], dtype=np.int32))
    if kind == types.mjGEOM_BOX:
        return polygons.box([2.0 * v for v in size])
    if kind in (types.mjGEOM_CYLINDER, types.mjGEOM_CAPSULE):
        make = polygons.cylinder if kind == types.mjGEOM_CYLINDER else polygons.capsule
        return make(size[0], 2.0 * size[1])
    ball = polygons.ball(1.0)
    radii = np.array(size) if kind == types.mjGEOM_ELLIPSOID else np.full(3, size[0])
    return Mesh(ball.points * radii, ball.triangles)


def _spec(path: str) -> Any:
    """The file's model. MuJoCo opens files by their suffix, and knows .xml alone."""
    import mujoco

    if path.lower().endswith(".xml"):
        return mujoco.MjSpec.from_file(path)
    spec = mujoco.MjSpec.from_string(Path(path).read_text(encoding="utf-8"))
    spec.modelfiledir = str(Path(path).absolute().parent)
    return spec


def _bodies(model: Any, body: int) -> tuple[str, ...]:
    """The names of a body and those above it, outermost first."""
    names: list[str] = []
    while body > 0:
        names.append(_called(model, body))
        body = int(model.body_parentid[body])
    return tuple(reversed(names))


def _mjcf_joints(model: Any, data: Any) -> Iterator[DeclaredJoint]:
    """Joints, the welds of bodies without one, and what closes loops: points that two bodies have in common."""
    kinds = ("free", "spherical", "prismatic", "revolute")
    for body in range(1, model.nbody):
        if not model.body_jntnum[body]:
            ends = _called(model, int(model.body_parentid[body])), _called(model, body)
            yield declared_joint(f"{ends[1]} weld", "fixed", ends, data.xpos[body], (0.0, 0.0, 0.0))
    for j in range(model.njnt):
        body = int(model.jnt_bodyid[j])
        ends = _called(model, int(model.body_parentid[body])), _called(model, body)
        limited = bool(model.jnt_limited[j])
        lower, upper = (float(v) if limited else None for v in model.jnt_range[j])
        name, kind = model.joint(j).name or f"joint {j}", kinds[int(model.jnt_type[j])]
        yield declared_joint(name, kind, ends, data.xanchor[j], data.xaxis[j], (lower, upper))
    yield from _closures(model, data)


def _closures(model: Any, data: Any) -> Iterator[DeclaredJoint]:
    import mujoco

    held = {mujoco.mjtEq.mjEQ_CONNECT: "spherical", mujoco.mjtEq.mjEQ_WELD: "fixed"}
    for e in range(model.neq):
        kind = held.get(mujoco.mjtEq(int(model.eq_type[e])))
        if kind is None or not model.eq_active0[e]:
            continue
        one, other = int(model.eq_obj1id[e]), int(model.eq_obj2id[e])
        if int(model.eq_objtype[e]) == mujoco.mjtObj.mjOBJ_SITE:
            anchor = data.site_xpos[one]
            one, other = int(model.site_bodyid[one]), int(model.site_bodyid[other])
        else:
            # A connect's point is in the first body's frame, a weld's in the second's.
            body = one if kind == "spherical" else other
            anchor = data.xpos[body] + data.xmat[body].reshape(3, 3) @ model.eq_data[e, :3]
        ends = _called(model, one), _called(model, other)
        yield declared_joint(model.equality(e).name or f"loop {e}", kind, ends, anchor, (0.0, 0.0, 0.0))


def _called(model: Any, body: int) -> str:
    """A body's name; the world's is empty."""
    return (decode_name(model.body(body).name, "utf-8") or f"body {body}") if body else ""
