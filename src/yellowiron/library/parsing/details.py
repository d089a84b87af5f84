"""The documents beside hierarchy and joints: variants, materials, collision, wanted values, actuators, measurements."""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

from yellowiron.library.parsing.hierarchy import choices_of, yes
from yellowiron.library.parsing.json_documents import Document, near
from yellowiron.library.parsing.quantities import in_unit, quantity
from yellowiron.model.errors import TemplateError
from yellowiron.model.geometry import Color, linear
from yellowiron.model.specification import fold
from yellowiron.model.template import (
    ActuatorTemplate,
    Choices,
    CylinderTemplate,
    JointTemplate,
    Material,
    MeasurementTemplate,
    Role,
    SiteTemplate,
    Variant,
    Wanted,
)

EVERYTHING = "*"
QUANTITY_DIMENSION: Mapping[str, str] = {
    "bore": "length",
    "rod_diameter": "length",
    "stroke": "length",
    "closed_length": "length",
    "pressure": "pressure",
    "flow": "flow",
    "extend_time": "time",
    "retract_time": "time",
    "speed": "speed",
    "torque": "torque",
}
"""What an actuator can need → its dimension. A motor's speed is the tyre's or track's at the ground, or its own: then
it is of dimension angular_speed."""

_MATERIAL_UNITS: Mapping[str, str] = {"density": "kg/m^3", "elasticity": "Pa"}
"""What a material states in units, and the SI ones."""

T = TypeVar("T")


def read_variants(document: Document) -> tuple[Variant, ...]:
    """The choices of a `variants.json`; the default must be one of them."""
    variants = []
    for name, entry in document.data.items():
        if entry["default"] not in entry["choices"]:
            raise TemplateError(
                f"'{entry['default']}' is no choice of variant '{name}'",
                where=document.at(name, "default"),
                hint=f"Its choices: {', '.join(entry['choices'])}.",
            )
        variants.append(
            Variant(name, tuple(entry["choices"]), entry["default"], decided_by=entry.get("decided_by", "user"))
        )
    return tuple(variants)


def check_choices(when: Choices, variants: Iterable[Variant], where: str) -> None:
    """`TemplateError` for a `when` that names a variant or a choice that is not declared."""
    known = {v.name: v.choices for v in variants}
    for name, choices in when.items():
        if name not in known:
            raise TemplateError(
                f"There is no variant '{name}'", where=where, hint=near(name, known) or "Declare it in variants.json."
            )
        for choice in choices:
            if choice not in known[name]:
                raise TemplateError(
                    f"'{choice}' is no choice of variant '{name}'",
                    where=where,
                    hint=f"Its choices: {', '.join(known[name])}.",
                )


def read_material(document: Document, key: str, entry: Mapping[str, Any]) -> Material:
    """One entry of JSON-1. `TemplateError` for a texture that is not there, frictions in the wrong order, and a density
    or elasticity that is none."""
    static, dynamic = entry.get("static friction"), entry.get("dynamic friction")
    if static is not None and dynamic is not None and dynamic > static:
        raise TemplateError(
            f"The dynamic friction of '{key}' is above its static friction", where=document.at(key, "dynamic friction")
        )
    texture = entry.get("texture")
    if texture is not None and not (document.path.parent / texture).is_file():
        raise TemplateError(
            f"The texture '{texture}' is not there",
            where=document.at(key, "texture"),
            hint="Its path is relative to this document.",
        )
    numbers = {k: float(entry[k]) for k in ("restitution", "roughness", "metalness") if k in entry}
    for k, unit in _MATERIAL_UNITS.items():
        if k in entry:
            numbers[k] = in_unit(entry[k], unit, where=document.at(key, k))
    return Material(
        name=entry.get("name", key),
        density=numbers.get("density"),
        elasticity=numbers.get("elasticity"),
        static_friction=None if static is None else float(static),
        dynamic_friction=None if dynamic is None else float(dynamic),
        restitution=numbers.get("restitution"),
        color=_color(entry.get("color")),
        texture=texture,
        roughness=numbers.get("roughness"),
        metalness=numbers.get("metalness"),
        friction_combine=entry.get("friction combine"),
    )


def by_role(document: Document, entries: Mapping[str, T], roles: tuple[Role, ...]) -> dict[str, T]:
    """Entries whose keys are role names, patterns (`*_pin`) or `*`, as one entry a role in the hierarchy's order, and
    `*` itself. An exact name wins over a pattern, a later pattern over an earlier one. `TemplateError` for a key that
    fits no role."""
    exact: dict[str, T] = {}
    for key, entry in entries.items():
        fits = [r.name for r in roles if fold(r.name) == fold(key) or (EVERYTHING in key and matches(r.name, key))]
        if not fits and key != EVERYTHING:
            raise TemplateError(
                f"'{key}' is no role of the template",
                where=document.at(key),
                hint=near(key, (r.name for r in roles)) or "hierarchy.json has the roles.",
            )
        if EVERYTHING not in key:
            exact[fits[0]] = entry
    found: dict[str, T] = {}
    for role in roles:
        matching = [e for k, e in entries.items() if k != EVERYTHING and EVERYTHING in k and matches(role.name, k)]
        if role.name in exact:
            found[role.name] = exact[role.name]
        elif matching:
            found[role.name] = matching[-1]
        elif EVERYTHING in entries:
            found[role.name] = entries[EVERYTHING]
    if EVERYTHING in entries:
        found[EVERYTHING] = entries[EVERYTHING]
    return found


def read_wanted(document: Document, roles: tuple[Role, ...]) -> tuple[Wanted, ...]:
    """The values of a `wanted.json`; plausible bounds in SI."""
    bodies = {fold(r.name): r.name for r in roles if r.rigid}
    wanted = []
    for name, entry in document.data.items():
        dimension = entry["dimension"]
        bounds = [
            quantity(entry[key], dimension, where=document.at(name, key)) if key in entry else None
            for key in ("minimum", "maximum")
        ]
        if bounds[0] is not None and bounds[1] is not None and bounds[0] >= bounds[1]:
            raise TemplateError(f"The minimum of '{name}' is not below its maximum", where=document.at(name, "minimum"))
        mass_of = entry.get("mass_of")
        if mass_of not in (None, EVERYTHING):
            if fold(mass_of) not in bodies:
                raise TemplateError(
                    f"'{mass_of}' is no body of the template",
                    where=document.at(name, "mass_of"),
                    hint=near(mass_of, bodies.values()),
                )
            mass_of = bodies[fold(mass_of)]
        wanted.append(
            Wanted(
                name=" ".join(name.split()),
                dimension=dimension,
                synonyms={lang: tuple(words) for lang, words in entry.get("synonyms", {}).items()},
                concepts=tuple(entry.get("concepts", ())),
                forbidden=tuple(entry.get("forbidden", ())),
                sections=tuple(entry.get("sections", ())),
                use=entry.get("use", ""),
                where=entry.get("where", ""),
                mass_of=mass_of,
                length_of=entry.get("length_of"),
                in_label_of=_other(entry.get("in_label_of"), document, name),
                minimum=bounds[0],
                maximum=bounds[1],
            )
        )
    return tuple(wanted)


def _other(wanted: str | None, document: Document, name: str) -> str | None:
    """Another value of the same document, as it is spelled there."""
    if wanted is None:
        return None
    names = {fold(each): " ".join(each.split()) for each in document.data}
    if fold(wanted) not in names:
        place = document.at(name, "in_label_of")
        raise TemplateError(f"'{wanted}' is no wanted value", where=place, hint=near(wanted, names.values()))
    return names[fold(wanted)]


def read_actuators(document: Document, joints: tuple[JointTemplate, ...]) -> tuple[ActuatorTemplate, ...]:
    """The actuators of an `actuators.json`; defaults in SI. `TemplateError` for a joint that is not there."""
    names = {fold(j.name): j for j in joints}

    def joint(name: str, *keys: object) -> JointTemplate:
        if fold(name) not in names:
            raise TemplateError(
                f"There is no joint '{name}'",
                where=document.at(*keys),
                hint=near(name, (j.name for j in joints)) or "Add it to joints.json.",
            )
        return names[fold(name)]

    actuators = []
    for name, entry in document.data.items():
        cylinders = []
        for i, cylinder in enumerate(entry.get("cylinders", ())):
            keys = (name, "cylinders", i)
            slide = joint(cylinder["slide"], *keys, "slide")
            if slide.type != "prismatic":
                raise TemplateError(
                    f"The slide '{slide.name}' of actuator '{name}' is not prismatic", where=document.at(*keys, "slide")
                )
            cylinders.append(
                CylinderTemplate(
                    slide.name,
                    joint(cylinder["barrel_joint"], *keys, "barrel_joint").name,
                    joint(cylinder["rod_joint"], *keys, "rod_joint").name,
                    sign=cylinder.get("sign", 1),
                    passive=yes(cylinder.get("passive")),
                    when=choices_of(cylinder, "when"),
                )
            )
        motors = tuple(joint(j, name, "joints", i).name for i, j in enumerate(entry.get("joints", ())))
        needed, other = ("cylinders", motors) if entry["kind"] == "cylinder" else ("joints", cylinders)
        if other or not (cylinders or motors):
            raise TemplateError(
                f"Actuator '{name}' is a {entry['kind']} and needs '{needed}', and nothing else that moves",
                where=document.at(name),
            )
        actuators.append(
            ActuatorTemplate(
                name=name,
                kind=entry["kind"],
                cylinders=tuple(cylinders),
                joints=motors,
                specifications=dict(entry.get("specifications", {})),
                defaults={
                    key: _default(key, value, document.at(name, "defaults", key))
                    for key, value in entry.get("defaults", {}).items()
                },
                source=entry.get("source", ""),
            )
        )
    return tuple(actuators)


def _default(key: str, value: float | str, where: str) -> float:
    """An actuator's default in SI; a speed may be a turning one ("11 rpm")."""
    dimension = QUANTITY_DIMENSION[key]
    if dimension == "speed" and isinstance(value, str) and value.strip().endswith(("rpm", "rad/s", "deg/s")):
        dimension = "angular_speed"
    return quantity(value, dimension, where=where)


def read_measurements(
    document: Document, roles: tuple[Role, ...], joints: tuple[JointTemplate, ...]
) -> tuple[tuple[SiteTemplate, ...], tuple[MeasurementTemplate, ...]]:
    """The sites and measurements of a `measurements.json`; texts with a unit become SI numbers."""
    bodies = {fold(r.name): r.name for r in roles if r.rigid}
    parts = {fold(r.name): r.name for r in roles}
    names = {fold(j.name): j.name for j in joints}

    def known(name: str, where: str, kinds: Mapping[str, str], word: str) -> str:
        if fold(name) not in kinds:
            raise TemplateError(f"There is no {word} '{name}'", where=where, hint=near(name, kinds.values()))
        return kinds[fold(name)]

    sites = []
    for name, entry in document.data.get("sites", {}).items():
        rule = {k: v for k, v in entry.items() if k != "body"}
        for key in ("joint", "edge_from", "inside_from"):
            if key in rule:
                place, given = document.at("sites", name, key), rule[key]
                several = isinstance(given, list)
                found = tuple(known(joint, place, names, "joint") for joint in (given if several else [given]))
                rule[key] = found if several else found[0]
        if "middle_of" in rule:
            rule["middle_of"] = known(rule["middle_of"], document.at("sites", name, "middle_of"), parts, "role")
        sites.append(SiteTemplate(name, known(entry["body"], document.at("sites", name, "body"), bodies, "body"), rule))
    measurements = []
    for i, entry in enumerate(document.data.get("measurements", ())):
        place = document.at("measurements", i)
        measurements.append(
            MeasurementTemplate(
                name=entry["name"],
                specification=entry.get("specification", entry["name"]),
                quantity=in_si(entry["quantity"], place),
                steps=tuple(in_si(step, place) for step in entry.get("steps", ())),
                unit=entry.get("unit", "m"),
                definition=entry.get("definition", ""),
            )
        )
    return tuple(sites), tuple(measurements)


def matches(name: str, pattern: str) -> bool:
    """Whether a role fits a pattern in which `*` stands for any text; case does not count, and `_`, `-` and a space
    are the same."""
    return fnmatch.fnmatchcase(*(re.sub(r"[\s_-]+", "_", text.strip().casefold()) for text in (name, pattern)))


def _color(value: str | list[float] | None) -> Color | None:
    """Linear RGB of `#RRGGBB` (sRGB: IEC 61966-2-1) or of three linear numbers."""
    if value is None:
        return None
    if isinstance(value, str):
        coded = [int(value[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
        value = list(linear(coded))
    return (float(value[0]), float(value[1]), float(value[2]))


def in_si(value: Any, where: str) -> Any:
    """A measurement's quantity or step with every `value` that is a text with a unit as a number in SI."""
    if isinstance(value, Mapping):
        return {
            k: _measure(v, where) if k == "value" and isinstance(v, str) else in_si(v, where) for k, v in value.items()
        }
    if isinstance(value, list):
        return tuple(in_si(v, where) for v in value)
    return value


def _measure(text: str, where: str) -> float:
    dimension = "angle" if text.strip().endswith(("deg", "°", "rad")) else "length"
    return quantity(text, dimension, where=where)
