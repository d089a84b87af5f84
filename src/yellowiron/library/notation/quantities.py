"""Numbers and flags of a template: bare numbers are metres, degrees; texts may have a unit or name a specification."""

from __future__ import annotations

import math
import re

from yellowiron.model.errors import TemplateError, YellowironError
from yellowiron.support.units import LARGEST, SI_UNIT, parse_quantity, registry

_STARTS_A_NUMBER = re.compile(r"^[-+−]?\s*\.?\d")
_NUMBER_AND_UNIT = re.compile(r"^\s*([-+−]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*(.*?)\s*$")
_LARGEST = 1e15
_NO_NAMES = ("nan", "inf", "infinity")
_POWER = re.compile(r"([A-Za-z])([23])\b")
_NAME = re.compile(r"^([-−]?)\s*([^\W\d_].*)$", re.DOTALL)


def quantity(value: float | str, dimension: str, *, where: str) -> float:
    """A number, or a text such as '25 MPa', in SI. A bare number is SI already, save an angle: degrees.

    `TemplateError` for a text that is no number with a unit of that dimension, and for a number that is not finite.
    """
    if isinstance(value, str):
        try:
            number, unit = parse_quantity(value, where=where)
        except YellowironError as error:
            raise TemplateError(error.message, where=where, hint=error.hint) from error
        if unit and unit != SI_UNIT[dimension]:
            raise TemplateError(
                f"'{value}' is not a quantity of dimension {dimension}", where=where, hint=_example(dimension)
            )
    else:
        number, unit = float(value), ""
    if dimension == "angle" and not unit:
        number = math.radians(number)
    if not abs(number) <= LARGEST[dimension]:
        raise TemplateError(
            f"'{value}' is no {dimension} that a machine can have", where=where, hint="Check number and unit."
        )
    return number


def limit(value: float | str | None, dimension: str, *, where: str) -> float | str | None:
    """One end of a `Limit`: a number in SI, the name of a specification (with a leading '-' if it is negative), or None
    (an empty text or null: no limit)."""
    if value is None or (isinstance(value, str) and not value.strip()):
        return None
    if isinstance(value, str) and not _STARTS_A_NUMBER.match(value.strip()):
        match = _NAME.match(value.strip())
        if match is None or match.group(2).split()[0].casefold() in _NO_NAMES:
            raise TemplateError(
                f"'{value}' is neither a number nor the name of a specification",
                where=where,
                hint='Write e.g. 0, "0.764 m", "-13 deg" or "Lift Cylinder Stroke".',
            )
        return ("-" if match.group(1) else "") + " ".join(match.group(2).split())
    return quantity(value, dimension, where=where)


def in_unit(value: float | str, unit: str, *, where: str) -> float:
    """A material's number in an SI unit ("kg/m^3", "Pa"): a number or text without a unit is in it already, a text may
    carry another of its kind ("7.85 g/cm3", "210 GPa").

    `TemplateError` for a text that is no such quantity, and for a number that is not positive and finite.
    """
    if isinstance(value, str):
        match = _NUMBER_AND_UNIT.match(value)
        if match is None:
            raise TemplateError(
                f"'{value}' is not a number with a unit",
                where=where,
                hint=f"Write a number in {unit}, or a text with a unit of its kind.",
            )
        number = float(match.group(1).replace("−", "-"))
        if spelled := _POWER.sub(r"\1^\2", match.group(2)):
            try:
                number = float(registry().Quantity(number, spelled).to(unit).magnitude)
            except Exception as error:  # pint raises half a dozen unrelated classes for bad text
                message = f"'{match.group(2)}' is no unit that can be {unit}"
                raise TemplateError(
                    message, where=where, hint=f"Write a number in {unit}, or a text with a unit of its kind."
                ) from error
    else:
        number = float(value)
    if not 0.0 < number <= _LARGEST:
        raise TemplateError(
            f"'{value}' should be more than 0 and finite", where=where, hint=f"Write a number in {unit}."
        )
    return number


def yes(value: object) -> bool:
    """`"Y"` or true."""
    return value is True or value == "Y"


def number_text(value: float, unit: str) -> str:
    """A number for a file: '0.764 m', degrees for radians; read back by `quantity` to 12 significant digits."""
    if unit == "rad":
        value, unit = math.degrees(value), "deg"
    return f"{float(f'{value:.12g}'):.12g} {unit}".strip()


def _example(dimension: str) -> str:
    examples = {"length": "0.8 m", "angle": "13 deg", "pressure": "25 MPa", "flow": "300 L/min", "mass": "2200 kg"}
    return f"Write e.g. {examples.get(dimension, '1 ' + SI_UNIT[dimension])}."
