"""What a studio works on: what a build takes, and the folder that it writes to."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from yellowiron.model.errors import YellowironError
from yellowiron.support.files.inputs import MEGABYTE, read_input

FILE = "inputs.json"
"""What a build writes beside its machine: from what it was built."""


@dataclass(frozen=True)
class Setup:
    """A build's inputs, as `pipeline.build` takes them."""

    equipment_type: str
    cad: Path
    out: Path
    sheets: tuple[Path, ...] = ()
    documents: tuple[Path, ...] = ()
    settings: tuple[str, ...] = ()
    config: str = ""
    mirror: bool = False

    def command(self) -> list[str]:
        """The arguments of `yellowiron` that build it."""
        listed = [("--specs", str(s)) for s in self.sheets] + [("--data", str(d)) for d in self.documents]
        listed += [("--set", setting) for setting in self.settings]
        listed += [("--config", self.config)] if self.config else []
        given = [word for pair in listed for word in pair]
        given += ["--mirror"] if self.mirror else []
        return ["build", self.equipment_type, "--cad", str(self.cad), *given, "--out", str(self.out)]


def read_setup(folder: Path) -> Setup:
    """The inputs of the machine that was built into a folder. `YellowironError` where there is none, or its CAD model
    is no longer where it was."""
    hint = "Build a machine into that folder first, or name TYPE, --cad and --out."
    file = folder / FILE
    if not file.is_file():
        raise YellowironError(
            "No machine was built into this folder" if folder.is_dir() else "There is no such folder",
            where=str(folder), hint=hint,
        )  # fmt: skip
    try:
        entry = json.loads(read_input(file, what="The record of a build", most=MEGABYTE, error=YellowironError))
        setup = _setup(entry, folder)
    except (ValueError, KeyError, TypeError) as error:
        raise YellowironError("The record of the build is broken", where=str(file), hint=hint) from error
    for path in (setup.cad, *setup.sheets, *setup.documents):
        if not path.exists():
            raise YellowironError(
                f"{path.name}, from which this machine was built, is not there any more", where=str(path), hint=hint
            )
    return setup


def _setup(entry: Mapping[str, Any], folder: Path) -> Setup:
    texts = {key: [str(one) for one in entry[key]] for key in ("specs", "data", "set")}
    return Setup(
        str(entry["equipment_type"]), Path(str(entry["cad"])), folder,
        sheets=tuple(map(Path, texts["specs"])), documents=tuple(map(Path, texts["data"])),
        settings=tuple(texts["set"]), config=str(entry["config"]), mirror=entry.get("mirror") is True,
    )  # fmt: skip
