"""Variants as USD layers over one base."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from yellowiron.fleet.variants.changes import Changed
from yellowiron.fleet.variants.sampling import Draw
from yellowiron.fleet.variants.tools import Tools
from yellowiron.model.mechanism import Mechanism


SUFFIX = ".usdc"
"""Binary: a third of the text."""


class Layers:
    """Writes a machine's variants as layers."""

    def __init__(self, mechanism: Mechanism, file: Path, draws: Sequence[Draw], tools: Tools) -> None:
        from yellowiron.fleet.variants.writing import wheels_of
        from yellowiron.usd.layers.variant import machine_prims

        self._base, self._file = mechanism, file
        self._prims = machine_prims(file, wheels_of(mechanism, draws))

    def write_base(self, folder: Path) -> None:
        """The machine as it is."""
        from yellowiron.fleet.variants.writing import copy_machine

        copy_machine(self._file, folder)

    def write(self, work: Changed, variant: Mechanism, record: Mapping[str, Any], stem: Path) -> None:
        """Writes a variant's layer to `stem` with its suffix."""
        from yellowiron.usd.authoring.stage import save_layer
        from yellowiron.usd.layers.variant import variant_layer

        layer = variant_layer(
            self._base, variant, self._prims, sublayer=f"../base/{self._file.name}", record=record, radii=work.radii
        )
        save_layer(layer, stem.with_suffix(SUFFIX))
