"""Opens a file of another program's: which format it is, by its name and its first element."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

from yellowiron.checks.exchange.mjcf import compiled, read_mjcf
from yellowiron.checks.exchange.sdf import read_sdf
from yellowiron.checks.exchange.stability import step_findings
from yellowiron.checks.exchange.urdf import read_urdf
from yellowiron.checks.view import View
from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding

SUFFIXES = (".urdf", ".sdf", ".xml", ".mjcf")


def is_exchange(path: Path) -> bool:
    """Whether a file is URDF, SDFormat or MJCF by its name."""
    return path.suffix.lower() in SUFFIXES


def read_exchange(path: Path) -> tuple[View, tuple[Finding, ...]]:
    """The links and joints of a URDF, SDFormat or MJCF file, and what is to be said of its drives at its own time step
    where it has one. `YellowironError` where there is no such file, it is none of these, or what it says cannot be."""
    if not path.is_file():
        words = "This is a folder, not a file" if path.is_dir() else "There is no such file"
        raise YellowironError(words, where=str(path), hint="Give a URDF, SDFormat or MJCF file.")
    try:
        top = ET.parse(path).getroot()
    except (ET.ParseError, UnicodeError, ValueError) as error:
        raise YellowironError(
            f"The file is no XML: {error}", where=str(path), hint="It is damaged; write it again."
        ) from error
    if top.tag == "robot":
        return read_urdf(path, top), ()
    if top.tag == "sdf":
        return read_sdf(path, top), ()
    if top.tag == "mujoco":
        model = compiled(path)
        return read_mjcf(path, model), tuple(step_findings(model, path.name))
    raise YellowironError(
        f"The file's first element is '{top.tag}'", where=str(path), hint="URDF has robot, SDFormat sdf, MJCF mujoco."
    )
