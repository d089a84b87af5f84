"""What a person says of a machine as a whole: which way it faces, which variant it is, and what is not drawn of it.

By name: `forward` and `up`, a direction in the CAD file's frame (`-x`, `z`, `0.7 0.7 0`); a variant of the template,
its choice; a role, a pattern of roles (`*_pin`), or several with commas, the word `absent`.
"""

from __future__ import annotations

import fnmatch
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.alignment.facing import Facing
from yellowiron.alignment.files.explanation import near
from yellowiron.model.alignment import UNSIGNED, GivenValue, Signature, Vector
from yellowiron.model.errors import AlignmentError
from yellowiron.model.specification import fold
from yellowiron.model.template import Template, Variant

ABSENT = "absent"
WAYS = ("forward", "up")
_WHERE = "--machine"


@dataclass(frozen=True)
class Whole:
    """What is said, as the alignment takes it: variants' `choices`, roles that are `absent` (each under its name or
    pattern), and the `facing`."""

    choices: Mapping[str, str]
    absent: Mapping[str, str]
    facing: Facing


def whole(said: Mapping[str, GivenValue], template: Template) -> Whole:
    """What is said of a machine by `name` → text. `AlignmentError` for a name or a text that means nothing."""
    choices: dict[str, str] = {}
    absent: dict[str, str] = {}
    ways: dict[str, Vector] = {}
    for name, value in said.items():
        variant = variant_named(name, template)
        if name in WAYS:
            ways[name] = _direction(name, value.text)
        elif variant is not None:
            choices[variant.name] = _choice(variant, value.text)
        elif fold(value.text) == fold(ABSENT):
            absent |= dict.fromkeys(_roles(name, template), name)
        else:
            raise AlignmentError(
                f"'{name}={value.text}' says nothing of a machine", where=_WHERE,
                hint="Write forward=-x, up=z, a variant with its choice, or a role with =absent, as in '*_pin=absent'.",
            )  # fmt: skip
    return Whole(choices, absent, Facing(ways.get("forward"), ways.get("up")))


def parse_machine(texts: Sequence[str], template: Template, signature: Signature = UNSIGNED) -> dict[str, GivenValue]:
    """Texts such as `forward=-x`, `lift_cylinders=twin` and `*_pin=absent`, by name. `AlignmentError` for others."""
    found = {}
    for text in texts:
        name, mark, value = (piece.strip() for piece in text.partition("="))
        if not mark or not name or not value:
            raise AlignmentError(
                f"'{text}' is no name with what is said of it", where=_WHERE,
                hint="Write forward=-x, a variant with its choice, or a role with =absent; --forget takes it back.",
            )  # fmt: skip
        variant = variant_named(name, template)
        found[variant.name if variant is not None else name] = GivenValue(value, signature)
    whole(found, template)
    return found


def variant_named(name: str, template: Template) -> Variant | None:
    """The template's variant of that name, however it is spelt."""
    return next((v for v in template.variants if fold(v.name) == fold(name)), None)


def _direction(name: str, text: str) -> Vector:
    plain = text.strip().lower().lstrip("+")
    axes = {f"{sign}{axis}": k for k, axis in enumerate("xyz") for sign in ("", "-")}
    if plain in axes:
        x, y, z = np.eye(3)[axes[plain]] * (-1.0 if plain.startswith("-") else 1.0)
        return (x, y, z)
    try:
        numbers = np.array([float(word) for word in plain.replace(",", " ").split()])
    except ValueError:
        numbers = np.zeros(0)
    length = float(np.linalg.norm(numbers)) if len(numbers) == 3 else 0.0
    if not np.isfinite(length) or length < 1e-9:
        raise AlignmentError(
            f"'{text}' is no direction", where=f"{_WHERE} {name}",
            hint="Write an axis of the CAD file, such as x or -z, or three numbers.",
        )  # fmt: skip
    x, y, z = (float(v) for v in numbers / length)
    return (x, y, z)


def _choice(variant: Variant, text: str) -> str:
    found = next((choice for choice in variant.choices if fold(choice) == fold(text)), None)
    if found is None:
        raise AlignmentError(
            f"'{text}' is no choice of {variant.name}", where=_WHERE, hint=f"Choices: {', '.join(variant.choices)}."
        )
    return found


def _roles(pattern: str, template: Template) -> list[str]:
    names = [role.name for role in template.roles if role.kind != "group" and not role.many]
    listed = [one.strip() for one in pattern.split(",")]
    found = {name: None for one in listed for name in fnmatch.filter(names, one)}
    if not all(fnmatch.filter(names, one) for one in listed):
        raise AlignmentError(
            f"'{pattern}' is no role of the template {template.equipment_type}, and no variant", where=_WHERE,
            hint=near(pattern, set(names)) or "`yellowiron templates show TYPE` lists the roles and variants.",
        )  # fmt: skip
    return list(found)
