"""Which formats a machine is written in: ours, and those that other installed packages bring.

Another package names an `Exporter` of its own in its `pyproject.toml`:

    [project.entry-points."yellowiron.exporters"]
    joints = "its_package:EXPORTER"
"""

from __future__ import annotations

import contextlib
import importlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism
from yellowiron.support.plugins import find_plugins, in_a_sentence
from yellowiron.support.record import DETAILS

if TYPE_CHECKING:
    from yellowiron.exporters.geometry import Geometry

GROUP = "yellowiron.exporters"
"""Entry points of this group are `Exporter`s of other packages."""


@dataclass(frozen=True)
class Exporter:
    """A format that there is. `title`: what it writes, as a person calls it. `function`: "module:function", which takes
    the mechanism, the machine's USD file and a folder, writes into the folder and returns the path of the machine's
    file there. `scene`: the file beside it that has the machine on the ground, "" where there is none. `unsaid`:
    "module:function", which takes the mechanism and returns sentences: what the format cannot say of it. One that is
    `detailed` takes in place of the file a `Geometry` that was read of it in the detail asked for."""

    title: str
    function: str
    scene: str = ""
    unsaid: str = ""
    detailed: bool = False


EXPORTERS: Mapping[str, Exporter] = MappingProxyType(
    {
        "mjcf": Exporter("MJCF", "yellowiron.exporters.mjcf.document:export_mjcf", scene="scene.xml", detailed=True),
        "mjcf-tendons": Exporter(
            "MJCF, its cylinders and ropes as tendons",
            "yellowiron.exporters.mjcf.document:export_tendons",
            scene="scene.xml",
            unsaid="yellowiron.exporters.mjcf.document:tendons_unsaid",
            detailed=True,
        ),
        "urdf": Exporter(
            "URDF for ROS 2",
            "yellowiron.exporters.ros.urdf:export_urdf",
            unsaid="yellowiron.exporters.ros.urdf:urdf_unsaid",
            detailed=True,
        ),
        "sdf": Exporter(
            "SDFormat for Gazebo",
            "yellowiron.exporters.sdf.gazebo:export_sdf",
            unsaid="yellowiron.exporters.sdf.gazebo:sdf_unsaid",
            detailed=True,
        ),
        "drake": Exporter(
            "SDFormat for Drake",
            "yellowiron.exporters.sdf.drake:export_drake",
            unsaid="yellowiron.exporters.sdf.drake:drake_unsaid",
            detailed=True,
        ),
        "isaaclab": Exporter(
            "a configuration for Isaac Lab",
            "yellowiron.exporters.isaaclab:export_isaaclab",
            unsaid="yellowiron.exporters.isaaclab:isaaclab_unsaid",
        ),
    }
)


def exporter_names() -> tuple[str, ...]:
    """The formats there are: those of `EXPORTERS`, then other packages', by name. None is imported."""
    return (*EXPORTERS, *find_plugins(GROUP, builtin=EXPORTERS))


def find_exporter(name: str) -> Exporter:
    """The exporter of that name; `YellowironError` where there is none, or where it is another package's and cannot be
    loaded."""
    plugins = find_plugins(GROUP, builtin=EXPORTERS)
    if name in plugins:
        return plugins[name].load(Exporter)
    if name not in EXPORTERS:
        hint = f"This version writes {', '.join(exporter_names())}."
        raise YellowironError(f"There is no export to '{name}'", where="--to", hint=hint)
    return EXPORTERS[name]


def export(mechanism: Mechanism, usd_file: str | Path, folder: Path, *, to: str, detail: str = DETAILS[0]) -> Path:
    """Writes a machine into a folder in the format `to`; the path of the machine's file there. `mechanism` is what the
    machine file `usd_file` says, which also has the geometry, in that `detail`. Errors as in `find_exporter` and those
    of the exporter; whatever another package's throws is a `YellowironError`."""
    found = find_exporter(to)
    if detail != DETAILS[0] and not found.detailed:
        hint = "Leave --detail out; a file that refers to the machine's selects its variant 'Detail'."
        raise YellowironError(f"The export to '{to}' has one detail", where="--detail", hint=hint)
    given = _geometry(usd_file, detail) if found.detailed else usd_file
    theirs = to not in EXPORTERS
    with in_a_sentence(f"The exporter '{to}' failed", found.function) if theirs else contextlib.nullcontext():
        return Path(_function(found.function)(mechanism, given, folder))


def _geometry(usd_file: str | Path, detail: str) -> Geometry:
    from yellowiron.exporters.geometry import read_geometry

    return read_geometry(usd_file, detail=detail)


def unsaid(mechanism: Mechanism, *, to: str) -> tuple[str, ...]:
    """What the format `to` cannot say of a machine, or says in another way, one sentence each; none where its exporter
    tells nothing. Errors as in `export`."""
    found = find_exporter(to)
    if not found.unsaid:
        return ()
    theirs = to not in EXPORTERS
    with in_a_sentence(f"The exporter '{to}' failed", found.unsaid) if theirs else contextlib.nullcontext():
        return tuple(map(str, _function(found.unsaid)(mechanism)))


def _function(address: str) -> Callable[..., Any]:
    module, _, name = address.partition(":")
    function: Callable[..., Any] = getattr(importlib.import_module(module), name)
    return function
