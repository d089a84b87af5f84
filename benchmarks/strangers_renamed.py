"""Names as other programs would have written them: half of them lost, or spelt and ordered in another way, never other
words. For `strangers_shaken.py`."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from kit.scene import Scene
from yellowiron.model.assembly import Assembly

UPPER, LOWER = "[A-ZÀ-Þ]", r"[^\W\d_A-ZÀ-Þ]"
WORDS = re.compile(rf"{UPPER}{{2,}}(?!{LOWER})|{UPPER}?{LOWER}+|{UPPER}|\d+")
SHORT = {"cylinder": "cyl", "left": "l", "right": "r"}
CUT = 12
SIDES = {"left": "right", "right": "left", "l": "r", "r": "l"}

Rename = Callable[[str], str]


def half_named(scene: Scene) -> Scene:
    """A half of its names, by lot, such as a program gives."""
    rng = np.random.default_rng(5)

    def of(name: str) -> str:
        number = int(rng.integers(1000))
        given = f"Object_{number}" if number % 2 else f"Mesh.{number:03d}"
        return given if rng.random() < 0.5 else name

    return renamed(scene, of)


def otherwise_named(scene: Scene) -> Scene:
    """Each name in another spelling: `BoomCylinder_L` is `boom cylinder left.001`, `node_12_boom-cyl-l_mesh0`,
    `l cylinder boom`, `BoomCylinder`."""
    rng = np.random.default_rng(5)
    return renamed(scene, lambda name: _spelt(name, int(rng.integers(4)), int(rng.integers(100))))


def other_sides(scene: Scene) -> Scene:
    """Names with left for right and right for left."""
    return renamed(scene, _other_side)


def renamed(scene: Scene, of: Rename) -> Scene:
    """A scene whose parts, assemblies and nodes are called otherwise, each place in the tree once."""
    told: dict[tuple[str, ...], str] = {}
    places: dict[tuple[str, ...], int] = {}
    parts = []
    for part in scene.assembly.parts:
        path = []
        for depth in range(1, len(part.path) + 1):
            above = part.path[:depth]
            if above not in told:
                told[above] = of(above[-1])
            path.append(told[above])
        name = of(part.name)
        key = (*path, name)
        places[key] = places.get(key, 0) + 1
        number = f"#{places[key]}" if places[key] > 1 else ""
        parts.append(replace(part, id="/".join(key) + number, name=name, path=tuple(path)))
    ids = {old.id: new.id for old, new in zip(scene.assembly.parts, parts, strict=True)}
    assembly: Assembly = replace(scene.assembly, parts=tuple(parts), joints=())
    truth = replace(scene.truth, whole={ids[i]: labels for i, labels in scene.truth.whole.items() if i in ids})
    return replace(scene, assembly=assembly, truth=truth)


def _spelt(name: str, how: int, number: int) -> str:
    """A name in one of four spellings; one without a word as it is."""
    words = [word.lower() for word in WORDS.findall(name)]
    if not any(not word.isdigit() for word in words):
        return name
    if how == 0:
        long = {short: whole for whole, short in SHORT.items() if len(short) == 1}
        return " ".join(long.get(word, word) for word in words) + f".{number:03d}"
    if how == 1:
        return f"node_{number}_{'-'.join(SHORT.get(word, word) for word in words)}_mesh0"
    if how == 2:
        return " ".join(reversed(words))
    return "".join(word.capitalize() for word in words)[:CUT]


def _other_side(name: str) -> str:
    def swapped(found: re.Match[str]) -> str:
        word = found.group(0)
        other = SIDES.get(word.lower(), word)
        return other.upper() if word.isupper() else other.capitalize() if word.istitle() else other

    return WORDS.sub(swapped, name)
