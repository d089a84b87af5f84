"""MJCF → `View`, as MuJoCo compiles it: what a file includes, and its defaults, are in it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.checks.exchange.parts import JointRead, LinkRead, view_of
from yellowiron.checks.view import View
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats

Led = tuple[str, float, float]
"""The joint that leads another, and by what ratio and offset."""


def compiled(path: Path) -> Any:
    """The `MjModel` of a file. `YellowironError` where MuJoCo does not take it."""
    import mujoco

    try:
        return mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        words = " ".join(str(error).split())[:200]
        raise YellowironError(
            f"MuJoCo does not take the file: {words}", where=str(path), hint="Correct the file, or write it again."
        ) from error


def read_mjcf(path: Path, model: Any) -> View:
    """The bodies and joints of a file that was `compiled`."""
    import mujoco

    data: Any = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    names = [model.body(i).name or f"body {i}" for i in range(model.nbody)]
    names[0] = ""
    links = [_link(model, data, i, names[i]) for i in range(1, model.nbody)]
    tendons = list(_tendons(model, data, names))
    moved, leaders, pulled = _moved(model), _leaders(model), _between(model, [ends for _, ends in tendons])
    tree = [j for i in range(1, model.nbody) for j in _joints(model, data, i, names, moved=moved, leaders=leaders)]
    tree = [replace(joint, pulled=joint.name in pulled) for joint in tree]
    return view_of(path.name, links, [*tree, *_equalities(model, data, names), *(read for read, _ in tendons)])


def _link(model: Any, data: Any, index: int, name: str) -> LinkRead:
    pose = _pose(data, index)
    mass = float(model.body_mass[index])
    if mass <= 0.0 and not model.body_jntnum[index]:
        return LinkRead(name, pose)
    turn = np.asarray(data.ximat[index], dtype=np.float64).reshape(3, 3)
    inertia = turn @ np.diag(model.body_inertia[index]) @ turn.T
    return LinkRead(name, pose, mass, np.array(data.xipos[index]), inertia)


def _pose(data: Any, index: int) -> Floats:
    made = np.eye(4)
    made[:3, :3] = np.asarray(data.xmat[index]).reshape(3, 3)
    made[:3, 3] = data.xpos[index]
    return made


_KINDS = ("free", "spherical", "prismatic", "revolute")
"""By MuJoCo's numbers of joint types."""


def _joints(
    model: Any, data: Any, index: int, names: list[str], *, moved: Collection[int], leaders: Mapping[int, Led]
) -> list[JointRead]:
    """What holds a body on its parent: one joint, none (welded, but on the world standing still), or several as one
    that leaves more free."""
    parent, child = names[int(model.body_parentid[index])], names[index]
    first, count = int(model.body_jntadr[index]), int(model.body_jntnum[index])
    own = range(first, first + count)
    kinds = [_KINDS[int(model.jnt_type[j])] for j in own]
    if kinds == ["free"]:
        return []
    at = np.array(data.xpos[index])
    if not kinds:
        return [JointRead(f"{child} on {parent or 'the world'}", "fixed", parent, child, (at, at), np.eye(3)[0])]
    if len(kinds) > 1:
        whole = "spherical" if kinds == ["revolute"] * 3 else "free"
        anchor = np.array(data.xanchor[first])
        return [JointRead(f"joints of {child}", whole, parent, child, (anchor, anchor), np.eye(3)[0], moved=True)]
    anchor = np.array(data.xanchor[first])
    limited = bool(model.jnt_limited[first]) and kinds[0] in ("revolute", "prismatic")
    low, high = (float(v) for v in model.jnt_range[first]) if limited else (None, None)
    name = model.joint(first).name or f"joint {first}"
    leader, ratio, offset = leaders.get(first, (None, 1.0, 0.0))
    return [
        JointRead(
            name, kinds[0], parent, child, (anchor, anchor), np.array(data.xaxis[first]), low, high,
            moved=first in moved or bool(model.jnt_stiffness[first]), leader=leader, ratio=ratio, offset=offset,
        )
    ]  # fmt: skip


def _moved(model: Any) -> set[int]:
    """Joints that an actuator moves, directly or by a fixed tendon, or that friction holds."""
    import mujoco

    found = set()
    for index in range(model.nu):
        target = int(model.actuator_trnid[index][0])
        kind = int(model.actuator_trntype[index])
        if kind in (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT):
            found.add(target)
        elif kind == mujoco.mjtTrn.mjTRN_TENDON:
            start, count = int(model.tendon_adr[target]), int(model.tendon_num[target])
            rows = range(start, start + count)
            found.update(int(model.wrap_objid[i]) for i in rows if model.wrap_type[i] == mujoco.mjtWrap.mjWRAP_JOINT)
    for joint in range(model.njnt):
        if model.dof_frictionloss[int(model.jnt_dofadr[joint])] > 0.0:
            found.add(joint)
    return found


def _tendons(model: Any, data: Any, names: list[str]) -> Iterator[tuple[JointRead, tuple[int, int]]]:
    """Straight tendons that an actuator pulls, as distances between two points with limits from the drawn length, and
    the bodies' numbers."""
    import mujoco

    kinds = model.actuator_trntype[: model.nu]
    pulled = {int(model.actuator_trnid[i][0]) for i in range(model.nu) if kinds[i] == mujoco.mjtTrn.mjTRN_TENDON}
    for index in sorted(pulled):
        start, count = int(model.tendon_adr[index]), int(model.tendon_num[index])
        if count != 2 or any(model.wrap_type[start : start + 2] != mujoco.mjtWrap.mjWRAP_SITE):
            continue
        sites = [int(model.wrap_objid[start + i]) for i in (0, 1)]
        points = [np.array(data.site_xpos[site]) for site in sites]
        ends = int(model.site_bodyid[sites[0]]), int(model.site_bodyid[sites[1]])
        drawn = float(np.linalg.norm(points[1] - points[0]))
        if drawn == 0.0:
            continue
        name = model.tendon(index).name or f"tendon {index}"
        along = (points[1] - points[0]) / drawn
        low, high = (float(v) - drawn for v in model.tendon_range[index])
        limits = (low, high) if model.tendon_limited[index] else (None, None)
        one, other = (names[end] for end in ends)
        yield JointRead(name, "distance", one, other, (points[0], points[1]), along, *limits), ends


def _between(model: Any, pairs: Iterable[tuple[int, int]]) -> set[str]:
    """The joints of the tree on the way from one body to another, of all pairs: what pulls these two holds them."""

    def up(body: int) -> list[int]:
        return [body, *up(int(model.body_parentid[body]))] if body else [0]

    ways = [set(up(one)) ^ set(up(other)) for one, other in pairs]
    bodies = {body for way in ways for body in way}
    return {model.joint(joint).name for joint in range(model.njnt) if int(model.jnt_bodyid[joint]) in bodies}


def _leaders(model: Any) -> dict[int, Led]:
    """Joint → what leads it by a straight line, with ratio and offset."""
    import mujoco

    found = {}
    for index in range(model.neq):
        if int(model.eq_type[index]) == mujoco.mjtEq.mjEQ_JOINT and int(model.eq_obj2id[index]) >= 0:
            offset, ratio = (float(v) for v in model.eq_data[index][:2])
            leader = model.joint(int(model.eq_obj2id[index])).name
            found[int(model.eq_obj1id[index])] = (leader, ratio, offset)
    return found


def _equalities(model: Any, data: Any, names: list[str]) -> list[JointRead]:
    """The constraints that close loops, each a cut: `connect` a ball, `weld` a fixed one."""
    import mujoco

    found = []
    kinds = {int(mujoco.mjtEq.mjEQ_CONNECT): "spherical", int(mujoco.mjtEq.mjEQ_WELD): "fixed"}
    for index in range(model.neq):
        kind = kinds.get(int(model.eq_type[index]))
        if kind is None or not model.eq_active0[index]:
            continue
        ends = [int(model.eq_obj1id[index]), int(model.eq_obj2id[index])]
        values = np.asarray(model.eq_data[index], dtype=np.float64)
        if int(model.eq_objtype[index]) == mujoco.mjtObj.mjOBJ_SITE:
            points = [np.array(data.site_xpos[site]) for site in ends]
            ends = [int(model.site_bodyid[site]) for site in ends]
        elif kind == "spherical":
            points = [_at(data, body, values[3 * i : 3 * i + 3]) for i, body in enumerate(ends)]
        else:
            points = [_at(data, ends[0], values[3:6]), _at(data, ends[1], values[:3])]  # the second body's comes first
        name = model.equality(index).name or f"equality {index}"
        found.append(
            JointRead(name, kind, names[ends[0]], names[ends[1]], (points[0], points[1]), np.eye(3)[0], cut=True)
        )
    return found


def _at(data: Any, body: int, point: Floats) -> Floats:
    return np.asarray((_pose(data, body) @ np.append(point, 1.0))[:3], dtype=np.float64)
