"""What else stands in a stranger's scene, and what hangs on a machine in the place of its bucket."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from kit.machines.solids import Array, around, box, lathe, place, plate, tube
from kit.machines.synthetic import Machine, X, Y, Z
from yellowiron.model.geometry import Mesh, Shape

EXTRA = "-"
"""The body of what is no part of the machine."""


def copied(machine: Machine) -> Machine:
    """A machine to which parts can be added."""
    return replace(
        machine, parts=list(machine.parts), shapes=dict(machine.shapes), truth=dict(machine.truth), pose=np.eye(4)
    )


def bounds(machine: Machine) -> Array:
    """(2, 3) the machine's box, in its own frame."""
    assembly = machine.assembly()
    points = [assembly.points_of(p) for p in machine.parts]
    return np.array([np.min([p.min(axis=0) for p in points], axis=0), np.max([p.max(axis=0) for p in points], axis=0)])


def ground_plate(machine: Machine, rng: np.random.Generator) -> Machine:
    """It stands on a drawn floor."""
    low, high = bounds(machine)
    size, middle = high - low, 0.5 * (low + high)
    thick = 0.02 * float(size[0])
    floor = box("ground", 2.5 * float(size[0]), 4.0 * float(size[1]), thick)
    result = copied(machine)
    result.add("Ground", EXTRA, EXTRA, floor, place((middle[0], middle[1], low[2] - thick / 2), Z, X))
    return result


def extras(machine: Machine, rng: np.random.Generator, other: Machine) -> Machine:
    """A trailer behind it, a driver in the cab, a smaller machine (`other`) beside it."""
    result = copied(machine)
    low, high = bounds(machine)
    _trailer(result, np.array([low[0] - 1.0, 0.5 * (low[1] + high[1]), low[2]]), float(high[1] - low[1]))
    _driver(result)
    factor = 0.5
    small = bounds(other) * factor
    shift = np.array([0.5 * (low[0] + high[0]), high[1] + 0.8 - small[0, 1], low[2] - small[0, 2]])
    for part in other.parts:
        shape = other.shapes[part.shape]
        mesh = Mesh(shape.mesh.points * factor, shape.mesh.triangles)
        matrix = part.transform.copy()
        matrix[:3, 3] = factor * matrix[:3, 3] + shift
        key = f"small {part.shape}"
        if key not in result.shapes:
            result.shapes[key] = replace(shape, key=key, mesh=mesh)
        result.add(part.name, EXTRA, EXTRA, result.shapes[key], matrix)
    return result


def _trailer(machine: Machine, hitch: Array, width: float) -> None:
    length, wheel = 1.8 * width, 0.16 * width
    bed = box("trailer bed", length, width, 0.08 * width)
    bar = box("drawbar", 0.5 * width, 0.06 * width, 0.06 * width)
    tyre = lathe("trailer tyre", [(0.4 * wheel, -0.3 * wheel), (wheel, -0.3 * wheel), (wheel, 0.3 * wheel),
                                  (0.4 * wheel, 0.3 * wheel)])  # fmt: skip
    z = 2.2 * wheel
    middle = hitch[0] - 0.5 * width - length / 2

    def add(name: str, shape: Shape, matrix: Array) -> None:
        machine.add(name, EXTRA, EXTRA, shape, matrix)

    add("Trailer bed", bed, place((middle, hitch[1], hitch[2] + z), Z, X))
    add("Trailer drawbar", bar, place((hitch[0] - 0.25 * width, hitch[1], hitch[2] + z), Z, X))
    for x in (-0.2, 0.2):
        for side in (1, -1):
            at = (middle + x * length, hitch[1] + side * 0.35 * width, hitch[2] + wheel)
            add("Trailer wheel", tyre, place(at, side * Y))


def _driver(machine: Machine) -> None:
    """A figure in the cab: right where it moves with it, and where it is left out."""
    (cab,) = (p for p in machine.parts if p.name == "cab")
    body = f"{EXTRA}|{machine.truth[cab.id][1]}"
    points = machine.shapes[cab.shape].mesh.points @ cab.transform[:3, :3].T + cab.transform[:3, 3]
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    h = 0.45 * float(np.ptp(points[:, 2]))
    for name, shape, up in (
        ("Driver torso", box("torso", 0.3 * h, 0.5 * h, 0.7 * h), 0.0),
        ("Driver head", lathe("head", [(0.0, -0.15 * h), (0.12 * h, -0.1 * h), (0.12 * h, 0.1 * h), (0.0, 0.15 * h)]),
         0.55 * h),
        ("Driver legs", box("legs", 0.6 * h, 0.4 * h, 0.2 * h), -0.45 * h),
    ):  # fmt: skip
        machine.add(name, EXTRA, body, shape, place(middle + up * Z, Z, X))


OF_BUCKET = ("floor", "bottom", "wall", "side", "edge", "tooth")
"""Parts of a bucket that no other attachment has."""


def attachment(machine: Machine, rng: np.random.Generator) -> Machine:
    """A hammer or a grapple where an excavator has its bucket, forks where a loader has it, on the bucket's own back
    and ears."""
    result = copied(machine)
    mine = [p for p in machine.parts if machine.truth[p.id][1] == "bucket"]
    (back,) = (p for p in mine if p.name == "back")
    gone = {p.id for p in mine if p.name in OF_BUCKET}
    result.parts = [p for p in result.parts if p.id not in gone]
    result.truth = {i: t for i, t in result.truth.items() if i not in gone}
    low, high = machine.shapes[back.shape].mesh.points.min(axis=0), machine.shapes[back.shape].mesh.points.max(axis=0)
    front, tall, wide = float(high[0]), float(high[2] - low[2]), float(high[1] - low[1])

    def put(name: str, shape: Shape, matrix: Array) -> None:
        result.add(name, "bucket", "bucket", shape, back.transform @ matrix)

    if machine.title == "LOADER":
        for side in (1, -1):
            y = side * 0.25 * wide
            put("fork shank", box("shank", 0.05 * tall, 0.12 * tall, tall), place((front + 0.025 * tall, y, 0), Z, X))
            tine = box("tine", 1.1 * tall, 0.12 * tall, 0.05 * tall)
            put("fork tine", tine, place((front + 0.6 * tall, y, low[2] + 0.025 * tall), Z, X))
    elif rng.random() < 0.5:
        put("hammer housing", box("housing", tall, 0.35 * tall, 0.35 * tall), place((front + tall / 2, 0, 0), Z, X))
        chisel = lathe("chisel", [(0, 0), (0.06 * tall, 0), (0.06 * tall, 0.6 * tall), (0, 0.75 * tall)])
        put("chisel", chisel, place((front + tall, 0, 0), X))
    else:
        put("rotator", tube("rotator", 0.18 * tall, 0.0, 0.25 * tall), place((front, 0, 0), X))
        head = front + 0.25 * tall
        put("grapple head", box("head", 0.2 * tall, 0.6 * tall, 0.6 * tall), place((head + 0.1 * tall, 0, 0), Z, X))
        claw = around((0, 0, 0.06 * tall), (0.35 * tall, 0.2 * tall, 0.05 * tall), (0.7 * tall, 0.1 * tall, 0.0))
        for k in range(4):
            turn = np.pi / 2 * k
            out = np.array([0.0, np.cos(turn), np.sin(turn)])
            at = np.array([head + 0.2 * tall, 0.0, 0.0]) + 0.15 * tall * out
            put("claw", plate("claw", claw, 0.06 * tall), place(at, np.cross(X, out), X))
    return result
