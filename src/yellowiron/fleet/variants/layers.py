"""Variants as USD layers over one base."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.fleet.variants.changes import Changed
from yellowiron.fleet.variants.sampling import Draw
from yellowiron.fleet.variants.tools import Tools
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism

SUFFIX = ".usdc"
"""Binary: a third of the text."""


class Layers:
    """Writes a machine's variants as layers."""

    def __init__(self, mechanism: Mechanism, file: Path, draws: Sequence[Draw], tools: Tools) -> None:
        from yellowiron.usd.variant import machine_prims

        self._base, self._file, self._tools = mechanism, file, tools
        self._prims = machine_prims(file, wheels_of(mechanism, draws))

    def write_base(self, folder: Path) -> None:
        """The machine as it is, and beside it the tools that it may have."""
        from yellowiron.usd.tools import ToolShape, add_tools

        file = copy_machine(self._file, folder)
        for body, tools in self._tools.items():
            shapes = {
                word: ToolShape(tool.file, tool.body, tool.sites, tool.shift)
                for word, tool in tools.items()
                if tool.file is not None
            }
            if shapes:
                add_tools(file, self._base.body(body), shapes)

    def write(self, work: Changed, variant: Mechanism, record: Mapping[str, Any], stem: Path) -> None:
        """Writes a variant's layer to `stem` with its suffix."""
        from yellowiron.usd.authoring.stage import save_layer
        from yellowiron.usd.variant import variant_layer

        shaped = {body: word for body, word in work.tools.items() if self._tools[body][word].file is not None}
        layer = variant_layer(
            self._base, variant, self._prims, sublayer=f"../base/{self._file.name}", record=record, radii=work.radii,
            tools=shaped,
        )  # fmt: skip
        save_layer(layer, stem.with_suffix(SUFFIX))


def copy_machine(file: Path, folder: Path) -> Path:
    """A machine's file and its payloads, copied."""
    folder.mkdir(parents=True)
    try:
        shutil.copyfile(file, folder / file.name)
        shutil.copytree(file.parent / "payloads", folder / "payloads")
    except OSError as error:
        raise YellowironError(
            f"The machine cannot be copied: {error.strerror}", where=str(file), hint="Build it again."
        ) from error
    return folder / file.name


def wheels_of(mechanism: Mechanism, draws: Sequence[Draw]) -> dict[str, tuple[Floats, float]]:
    """The wheels whose radius varies: axis (3,) and radius, metres."""
    found = {}
    for draw in draws:
        for name in draw.names if draw.parameter.vary == "tyre_radius" else ():
            joint = next(j for j in mechanism.joints if j.body1 == name and not j.cut)
            axis = np.asarray(joint.axis)
            out = mechanism.body(name).hull - np.asarray(joint.anchor)
            found[name] = (axis, float(np.linalg.norm(out - np.outer(out @ axis, axis), axis=1).max(initial=0.0)))
    return found
