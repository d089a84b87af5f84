"""Which values a template asks a sheet for, where they lie, and what a person is told of them."""

from __future__ import annotations

import functools
import itertools

from yellowiron.model.specification import Specifications, fold
from yellowiron.model.template import JointTemplate, Template, Wanted
from yellowiron.specs.language.vocabulary import data

_ANGULAR = {"revolute", "spherical"}


def asked(template: Template) -> tuple[Wanted, ...]:
    """The template's wanted values, then every joint limit that names a specification without a wanted entry.

    Such a limit is asked for by its own words; its dimension follows from the joint's type. A name that stands in
    several limits is asked for once.
    """
    found = {fold(w.name): w for w in template.wanted}
    for joint in template.joints:
        for limit in (joint.lower, joint.upper):
            name = limit_name(limit)
            if name and fold(name) not in found:
                found[fold(name)] = _from_limit(name, joint)
    return tuple(found.values())


def limit_name(limit: float | str | None) -> str:
    """The specification that a joint limit names, without its sign; "" for a number or no limit."""
    if not isinstance(limit, str):
        return ""
    name = limit.strip().lstrip("-−").strip()
    return name if any(c.isalpha() for c in name) and not name[0].isdigit() else ""


def _from_limit(name: str, joint: JointTemplate) -> Wanted:
    dimension = "angle" if joint.type in _ANGULAR else "length"
    return Wanted(name=name, dimension=dimension, use=f"limit of {joint.name}")


def hint_for(wanted: Wanted) -> str:
    """What a missing value is, where makers print it and how to give it."""
    say = _explained(wanted)
    return f"{wanted.name} ({say['what']}). Look in {say['where']}; give it with --set {say['set']}."


def check_hint(name: str) -> str:
    """What to do with a value that is to be reviewed."""
    return f'Check it on the page; settle it with --set "{name}=VALUE UNIT".'


def usual(wanted: Wanted, value: float) -> bool:
    """Whether a value, in SI, lies where the wanted one can lie."""
    low = wanted.minimum if wanted.minimum is not None else float("-inf")
    high = wanted.maximum if wanted.maximum is not None else float("inf")
    return low <= value <= high


def missing_values(template: Template, specifications: Specifications) -> tuple[dict[str, str], ...]:
    """What a person can still give: of every value that no sheet says or that cannot be read, its `name`, `what` it
    is, `where` makers usually print it, and what to `set` (`"Axle Height=VALUE mm"`, with its quotes)."""
    open_ = {s.name for s in specifications if s.status in ("missing", "unreadable")}
    return tuple({"name": w.name, **_explained(w)} for w in asked(template) if w.name in open_)


def _explained(wanted: Wanted) -> dict[str, str]:
    kind = wanted.dimension.replace("_", " ")
    example, where = _HINTS.get(wanted.dimension, ("VALUE", "the specification tables"))
    return {
        "what": f"{kind}; {wanted.use.rstrip('.')}" if wanted.use else kind,
        "where": wanted.where.rstrip(".") or where,
        "set": f'"{wanted.name}={example}"',
    }


_HINTS = data("hints")
"""By dimension how a value is written, and where makers print it."""


@functools.lru_cache(maxsize=1024)
def _phrases(name: str, synonyms: tuple[tuple[str, ...], ...], concepts: tuple[str, ...]) -> tuple[str, ...]:
    spelled = [p for concept in concepts for p in spelled_out(concept)]
    return tuple(dict.fromkeys([name, *(s for group in synonyms for s in group), *spelled]))


def spelled_out(concept: str) -> list[str]:
    """The phrases of a concept: ("lift/boom cylinder bore") → ["lift cylinder bore", "boom cylinder bore"]; `_` joins
    the words of an alternative."""
    choices = [part.split("/") for part in concept.split()]
    return [" ".join(chosen).replace("_", " ") for chosen in itertools.product(*choices)]


def phrases(wanted: Wanted) -> tuple[str, ...]:
    """A wanted value's name, its synonyms in every language and its concepts."""
    return _phrases(wanted.name, tuple(tuple(group) for group in wanted.synonyms.values()), wanted.concepts)
