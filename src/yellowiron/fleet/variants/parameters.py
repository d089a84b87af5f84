"""What varies: a file of parameters (YAML, TOML, JSON) → `Parameter`s, each with what it is of and how it is spread."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from yellowiron.fleet.documents import Key, UnusableError, checked, read_document
from yellowiron.support.units import SI_UNIT, parse_quantity

Mode = Literal["factor", "offset", "value"]
Target = Literal["bodies", "materials", "actuators", "cylinders", "pins", "joints", "wheels", "sensors", "machine"]
MODES: tuple[Mode, ...] = ("factor", "offset", "value")


@dataclass(frozen=True)
class Quantity:
    """Something of a machine that can vary: what it is of, its dimension (`support.units`, "" for a plain number), the
    ways in which it may be said, and further keys that it needs."""

    target: Target
    dimension: str
    modes: tuple[Mode, ...]
    needs: tuple[str, ...] = ()


DIRECTION = "pin_play_direction"
"""Drawn with each pin's play: where in its bore the pin rests. No file says it."""

QUANTITIES: Mapping[str, Quantity] = MappingProxyType(
    {
        "mass": Quantity("bodies", "mass", ("factor", "offset", "value")),
        "center_of_mass": Quantity("bodies", "length", ("offset",), ("axis",)),
        "friction": Quantity("materials", "", ("factor", "value")),
        "stiffness": Quantity("actuators", "", ("factor",)),
        "damping": Quantity("actuators", "", ("factor",)),
        "pressure": Quantity("actuators", "pressure", ("factor",)),
        "flow": Quantity("actuators", "", ("factor",)),
        "bore": Quantity("cylinders", "length", ("factor", "offset")),
        "rod_diameter": Quantity("cylinders", "length", ("factor", "offset")),
        "stroke": Quantity("cylinders", "length", ("factor", "offset")),
        "closed_length": Quantity("cylinders", "length", ("offset",)),
        "pin_play": Quantity("pins", "length", ("value",)),
        DIRECTION: Quantity("pins", "angle", ("value",)),
        "pin": Quantity("joints", "length", ("offset",), ("axis",)),
        "length": Quantity("bodies", "length", ("factor", "offset"), ("from", "to")),
        "payload": Quantity("machine", "mass", ("value",)),
        "tyre_radius": Quantity("wheels", "length", ("factor", "offset")),
        "sensor_position": Quantity("sensors", "length", ("offset",), ("axis",)),
        "sensor_angle": Quantity("sensors", "angle", ("offset",), ("axis",)),
        "sensor_noise": Quantity("sensors", "", ("factor", "value")),
        "tool": Quantity("bodies", "", ("value",), ("tools",)),
    }
)
"""What `vary` says → what that is."""

_KEYS: Mapping[str, Key] = {
    "vary": Key("text", tuple(name for name in QUANTITIES if name != DIRECTION)),
    "of": Key("texts"),
    "each": Key("flag"),
    "axis": Key("text", ("x", "y", "z")),
    "from": Key("text"),
    "to": Key("text"),
    "tools": Key("table"),
    "factor": Key("any"),
    "offset": Key("any"),
    "value": Key("any"),
}
_SPREADS = ("uniform", "normal", "loguniform", "choice")
_SPREAD: Mapping[str, Key] = {**{name: Key("any") for name in _SPREADS}, "within": Key("any")}
_TOOL: Mapping[str, Key] = {
    "mass": Key("any"), "center_of_mass": Key("any"), "inertia": Key("any"), "machine": Key("text")
}  # fmt: skip


@dataclass(frozen=True)
class Spread:
    """How values are spread. `uniform` and `loguniform` between `numbers[0]` and `[1]`; `normal` about `numbers[0]`
    with the standard deviation `[1]`, between `low` and `high`; one of `numbers`, or of `words`, of a `choice`."""

    kind: Literal["uniform", "normal", "loguniform", "choice"]
    numbers: tuple[float, ...] = ()
    low: float = -math.inf
    high: float = math.inf
    words: tuple[str, ...] = ()


@dataclass(frozen=True)
class Parameter:
    """Something that varies, SI. `of` are patterns of names (`*` and `?`); `each`: every one that fits has a value of
    its own, else all have the same. `axis` is 0, 1 or 2 of the machine's frame; `ends` are the joints at both ends of a
    link, of which the second moves; `tools` what a tool may be, by its name."""

    name: str
    vary: str
    of: tuple[str, ...]
    each: bool
    mode: Mode
    spread: Spread
    axis: int = 0
    ends: tuple[str, str] = ("", "")
    tools: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    where: str = ""

    @property
    def quantity(self) -> Quantity:
        """What it is of."""
        return QUANTITIES[self.vary]


def read_parameters(file: str | Path) -> tuple[Parameter, ...]:
    """The parameters of a file, in its order. `UnusableError` for what it does not know, with the place."""
    address = str(file)
    document = read_document(address, what="The file of variants")
    whole = checked(document, {"parameters": Key("table")}, where=address, needed=["parameters"])
    found = tuple(_parameter(str(name), entry, f"{address}: {name}") for name, entry in whole["parameters"].items())
    if not found:
        raise UnusableError("Nothing varies", where=address, hint="parameters: {mass: {vary: mass, factor: …}}")
    return found


def _parameter(name: str, entry: Any, where: str) -> Parameter:
    said = checked(entry, _KEYS, where=where, needed=["vary"])
    quantity = QUANTITIES[said["vary"]]
    for key in quantity.needs:
        if key not in said:
            raise UnusableError(f"'{key}' is missing", where=where, hint=f"{said['vary']} needs it.")
    modes = [mode for mode in MODES if mode in said]
    if len(modes) != 1 or modes[0] not in quantity.modes:
        raise UnusableError(
            f"{said['vary']} is said by one of: {', '.join(quantity.modes)}", where=where,
            hint=f"{quantity.modes[0]}: {{uniform: [low, high]}}",
        )  # fmt: skip
    mode = modes[0]
    tools = {
        str(tool): checked(each, _TOOL, where=f"{where}.tools.{tool}") for tool, each in said.get("tools", {}).items()
    }
    spread = _spread(said[mode], "" if mode == "factor" else quantity.dimension, f"{where}.{mode}")
    if (said["vary"] == "tool") != bool(spread.words) or not set(spread.words) <= {*tools, "drawn"}:
        raise UnusableError(
            "A tool is chosen by name, and nothing else is", where=f"{where}.{mode}",
            hint=f"value: {{choice: [drawn, {', '.join(tools) or '…'}]}}",
        )  # fmt: skip
    # Every pin rests on a side of its own.
    each = said.get("each", said["vary"] == "pin_play")
    return Parameter(
        name, said["vary"], said.get("of", ("*",)), each, mode, spread,
        axis="xyz".index(said.get("axis", "x")), ends=(said.get("from", ""), said.get("to", "")), tools=tools,
        where=where,
    )  # fmt: skip


def _spread(given: Any, dimension: str, where: str) -> Spread:
    if not isinstance(given, Mapping):
        return Spread("choice", (_number(given, dimension, where),))
    said = checked(given, _SPREAD, where=where)
    kinds = [kind for kind in _SPREADS if kind in said]
    if len(kinds) != 1:
        raise UnusableError("It is not said how it is spread", where=where, hint=f"By one of: {', '.join(_SPREADS)}.")
    kind = kinds[0]
    values = said[kind]
    if not isinstance(values, list) or not values or (kind != "choice" and len(values) != 2):
        hint = f"{kind}: [{'mean, standard deviation' if kind == 'normal' else 'low, high'}]"
        raise UnusableError("There should be a list of two numbers", where=f"{where}.{kind}", hint=hint)
    if kind == "choice" and all(isinstance(each, str) and not each[:1].isdigit() for each in values):
        return Spread("choice", words=tuple(values))
    numbers = tuple(_number(each, dimension, f"{where}.{kind}") for each in values)
    bounds = said.get("within", [-math.inf, math.inf])
    if not isinstance(bounds, list) or len(bounds) != 2 or ("within" in said and kind != "normal"):
        raise UnusableError("'within' is of a normal spread: two numbers", where=where, hint="within: [low, high]")
    low, high = (each if each in (-math.inf, math.inf) else _number(each, dimension, where) for each in bounds)
    ordered = numbers[0] <= numbers[1] if kind in ("uniform", "loguniform") else True
    fits = (
        ordered and low < high and (kind != "loguniform" or numbers[0] > 0.0) and (kind != "normal" or numbers[1] > 0.0)
    )
    if not fits:
        raise UnusableError(
            "These numbers spread nothing", where=f"{where}.{kind}", hint="The smaller one stands first."
        )
    return Spread(kind, numbers, low, high)  # type: ignore[arg-type]


def _number(value: Any, dimension: str, where: str) -> float:
    """A number in SI; a text has a unit of the dimension."""
    if isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value):
        return float(value)
    if isinstance(value, str):
        number, unit = parse_quantity(value, where=where)
        wanted = SI_UNIT.get(dimension, "")
        if unit in ("", wanted) or (unit == "1" and not wanted):
            return number
        raise UnusableError(f"'{value}' is of another kind", where=where, hint=f"It is in {wanted or 'no unit'}.")
    raise UnusableError(f"'{value}' is no number", where=where, hint="Write 0.02, or 20 mm.")
