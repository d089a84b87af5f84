"""Tools that a variant may have instead of the drawn one: another built machine's, or a mass that is said."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.places import joined
from yellowiron.fleet.variants.parameters import Parameter
from yellowiron.model.mechanism import Body, Mechanism, Site, Vector
from yellowiron.support.units import parse_quantity
from yellowiron.support.vectors import triple

_APART = 2e-3
"""Metres: pins of a tool that are farther from the drawn one's are of another linkage."""


@dataclass(frozen=True, eq=False)
class Tool:
    """A tool where the drawn one is: `body` with its mass, centre and inertia, and of another machine's its parts, hull
    and `sites`, which is moved by `shift`, metres, in the body's frame. `file`: that machine's; None: the shape stays
    the drawn one."""

    body: Body
    sites: tuple[Site, ...] = ()
    file: Path | None = None
    shift: Vector = (0.0, 0.0, 0.0)


Tools = Mapping[str, Mapping[str, Tool]]
"""Body → tool → what it is."""


def read_tools(parameters: Sequence[Parameter], mechanism: Mechanism, file: Path) -> Tools:
    """The tools that parameters name. `UnusableError` for one that does not fit the machine."""
    tools: dict[str, dict[str, Tool]] = {}
    for parameter in parameters:
        if parameter.vary != "tool":
            continue
        fitting = [b for b in mechanism.bodies if any(fnmatchcase(b.name, pattern) for pattern in parameter.of)]
        if len(fitting) != 1:
            raise UnusableError("A tool is of one body", where=f"{parameter.where}.of", hint="of: bucket")
        if fitting[0].name in tools:
            raise UnusableError(
                f"'{fitting[0].name}' has its tools already", where=parameter.where, hint="Name them in one place."
            )
        own = tools.setdefault(fitting[0].name, {})
        for name, said in parameter.tools.items():
            where = f"{parameter.where}.tools.{name}"
            if "machine" in said:
                place = Path(joined(str(file.resolve().parent), said["machine"]))
                own[name] = _of_machine(place, fitting[0], mechanism, where)
            else:
                own[name] = Tool(_of_numbers(said, fitting[0], where))
    return tools


def _of_machine(file: Path, drawn: Body, mechanism: Mechanism, where: str) -> Tool:
    """The same body of another machine, moved to where the drawn one is: by its pins, which must be the same."""
    from yellowiron.usd import read_mechanism

    other = read_mechanism(file)
    try:
        tool = other.body(drawn.name)
        mine = {j.name: np.asarray(j.anchor) for j in mechanism.joints if drawn.name in (j.body0, j.body1)}
        theirs = {name: np.asarray(other.joint(name).anchor) for name in mine}
    except KeyError as error:
        raise UnusableError("The tool's machine has other bodies or joints", where=where, hint=str(error)) from error
    moves = np.array([mine[name] - theirs[name] for name in mine])
    move = moves.mean(axis=0) if len(moves) else np.asarray(drawn.origin) - np.asarray(tool.origin)
    if len(moves) and float(np.abs(moves - move).max()) > _APART:
        raise UnusableError(
            f"The tool's pins are elsewhere, by {1e3 * float(np.abs(moves - move).max()):.0f} mm", where=where,
            hint="A tool fits where its pins are those of the drawn one.",
        )  # fmt: skip
    known = {site.name for site in mechanism.sites if site.body == drawn.name}
    body = replace(
        drawn, mass=tool.mass, center_of_mass=triple(np.asarray(tool.center_of_mass) + move), inertia=tool.inertia,
        parts=tool.parts, hull=tool.hull + move if len(tool.hull) else tool.hull,
    )  # fmt: skip
    sites = tuple(
        replace(site, position=triple(np.asarray(site.position) + move))
        for site in other.sites
        if site.body == drawn.name and site.name in known
    )
    return Tool(body, sites, file, triple(np.asarray(tool.origin) + move - np.asarray(drawn.origin)))


def _of_numbers(said: Mapping[str, Any], drawn: Body, where: str) -> Body:
    """A tool by its mass, and where they are said, its centre from the drawn one's (m) and its inertia about it."""
    if "mass" not in said:
        raise UnusableError("'mass' is missing", where=where, hint="mass: 1850 kg, or machine: …/wheel_loader.usda")
    mass, unit = parse_quantity(str(said["mass"]), where=where)
    if unit not in ("", "kg") or mass <= 0.0:
        raise UnusableError(f"'{said['mass']}' is no mass", where=where, hint="mass: 1850 kg")
    try:
        offset = np.asarray(said.get("center_of_mass", (0.0, 0.0, 0.0)), dtype=np.float64).reshape(3)
        moments = np.asarray(said.get("inertia", ()), dtype=np.float64)
        inertia = np.diag(moments.reshape(3)) if moments.size else drawn.inertia * (mass / drawn.mass)
    except (TypeError, ValueError) as error:
        raise UnusableError("There should be three numbers", where=where, hint="inertia: [900, 700, 1100]") from error
    return replace(drawn, mass=mass, center_of_mass=triple(np.asarray(drawn.center_of_mass) + offset), inertia=inertia)
