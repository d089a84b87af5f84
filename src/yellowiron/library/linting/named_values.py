"""Names that limits, actuators, measurements and tests refer to: values of a sheet, sites, joints, bodies and so on."""

from __future__ import annotations

import fnmatch
from collections.abc import Iterator, Mapping

from yellowiron.library.notation.role_keys import EVERYTHING
from yellowiron.library.notation.validated_json import near
from yellowiron.library.parsing.joints import DIMENSION
from yellowiron.model.finding import Finding
from yellowiron.model.specification import fold, share_of
from yellowiron.model.template import Template
from yellowiron.support.text import with_article

_NAMING = {
    "actuator": "actuator",
    "actuators": "actuator",
    "set": "actuator",
    "site": "site",
    "sites": "site",
    "joint": "joint",
    "joints": "joint",
    "from": "joint",
    "along": "joint",
    "bodies": "body",
}


def specifications(template: Template) -> Iterator[Finding]:
    """Names of specifications, in limits and actuators."""
    known = {fold(w.name): w for w in template.wanted}
    said: set[str] = set()
    for joint in template.joints:
        unlimited = joint.lower is None and joint.upper is None and joint.follows is None and not joint.positions
        if joint.type == "prismatic" and unlimited:
            yield Finding("TPL010", "warning", joint.name, "The slide has no limits.", 'Give Limit ["0", "… Stroke"].')
        shares = (share[1] for place in joint.positions.values() if (share := share_of(place)) is not None)
        for value in (joint.lower, joint.upper, *shares):
            if not isinstance(value, str):
                continue
            name = value.lstrip("-").strip()
            wanted = known.get(fold(name))
            if wanted is None and fold(name) not in said:
                said.add(fold(name))
                yield Finding(
                    "TPL004",
                    "info",
                    joint.name,
                    f"The limit '{name}' is not in wanted.json; it is looked for by its words.",
                    near(name, (w.name for w in template.wanted)),
                )
            elif wanted is not None and wanted.dimension != DIMENSION[joint.type]:
                yield Finding(
                    "TPL005",
                    "error",
                    joint.name,
                    f"Its limit '{name}' is {with_article(wanted.dimension)}; the joint is {joint.type}.",
                    f"Name {with_article(DIMENSION[joint.type])}.",
                )
    for actuator in template.actuators:
        for quantity, name in actuator.specifications.items():
            if fold(name) not in known and template.wanted:
                yield Finding(
                    "TPL004",
                    "warning",
                    actuator.name,
                    f"Its {quantity} '{name}' is not in wanted.json and not looked for.",
                    near(name, (w.name for w in template.wanted)),
                )


def measurements(template: Template) -> Iterator[Finding]:
    """Names in the measurements: specification, actuators, sites, joints, bodies."""
    known = {
        "actuator": {a.name for a in template.actuators},
        "site": {s.name for s in template.sites},
        "joint": {j.name for j in template.joints},
        "body": {f"{r.name}_1" if r.many else r.name for r in template.roles if r.rigid},
    }
    parts = [f"{r.name}_1" if r.many else r.name for r in template.roles]
    wanted = {fold(w.name) for w in template.wanted}
    for measurement in template.measurements:
        if measurement.specification and fold(measurement.specification) not in wanted:
            yield Finding(
                "TPL011",
                "warning",
                measurement.name,
                f"'{measurement.specification}' is not in wanted.json: nothing to compare with.",
                near(measurement.specification, (w.name for w in template.wanted)),
            )
        for kind, name in dict.fromkeys(_named((measurement.quantity, measurement.steps))):
            # A pattern may fit bodies that are there under other choices only: once these are made, it need not.
            pattern = kind == "body" and EVERYTHING in name
            fits = pattern and (not template.variants or fnmatch.filter(parts, name))
            if name not in known[kind] and not fits:
                yield Finding(
                    "TPL011",
                    "error",
                    measurement.name,
                    f"There is no {kind} '{name}'.",
                    near(name, sorted(known[kind])),
                )


def _named(value: object) -> Iterator[tuple[str, str]]:
    """(kind, name) of everything that a measurement's quantity and steps name."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            if key in _NAMING:
                yield from ((_NAMING[key], n) for n in ([inner] if isinstance(inner, str) else inner))
            else:
                yield from _named(inner)
    elif isinstance(value, (list, tuple)):
        for inner in value:
            yield from _named(inner)


def machine_tests(template: Template) -> Iterator[Finding]:
    """TPL019 for every name in the tests that the template does not have, TPL020 for what a sheet is not asked for."""
    sites = {site.name for site in template.sites}
    actuators = {actuator.name for actuator in template.actuators}
    wanted = {fold(w.name): w.name for w in template.wanted}

    def missing(where: str, kind: str, name: str, known: set[str]) -> Iterator[Finding]:
        if name and name not in known:
            yield Finding("TPL019", "error", where, f"There is no {kind} '{name}'.", near(name, sorted(known)))

    def unasked(where: str, name: str) -> Iterator[Finding]:
        if name and fold(name) not in wanted:
            words = f"'{name}' is not in wanted.json: no sheet gives it."
            yield Finding("TPL020", "warning", where, words, near(name, wanted.values()))

    if template.payload is not None:
        for name in (template.payload.site, *template.payload.others):
            yield from missing("payload", "site", name, sites)
        for rated in template.payload.rated:
            yield from unasked("payload", rated.specification)
    for test in template.tests:
        yield from missing(test.name, "site", test.site, sites)
        named = [test.actuator, *test.best, *(name for step in test.steps for name in step.get("set", {}))]
        named += [goal["actuator"] for step in test.steps for goal in step.get("solve", ())]
        named += [name for step in test.steps for name in step.get("extreme", {}).get("actuators", ())]
        for name in dict.fromkeys(named):
            yield from missing(test.name, "actuator", name, actuators)
        for name in dict.fromkeys((test.specification, test.flow, *test.inputs)):
            yield from unasked(test.name, name)
