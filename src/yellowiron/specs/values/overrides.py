"""Values given by a person: `--set "NAME=VALUE UNIT"`; and who wins where several sources give a value."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.specification import Specification, Specifications, fold
from yellowiron.model.template import Template, Variant, Wanted
from yellowiron.specs.language.numbers import parse_one
from yellowiron.specs.values.requested import asked, hint_for, usual
from yellowiron.specs.values.tolerances import DOUBTFUL
from yellowiron.support.text import display, with_article
from yellowiron.support.units import LARGEST, SI_UNIT

_WHERE = "--set"
_SIGNED = {"angle", "count"}
"""Dimensions whose values may be zero or negative where no range is stated."""
_ROUNDING = 1e-9
"""A value may be outside its range by this share: what a change of units rounds."""


def split_settings(texts: Iterable[str], template: Template) -> tuple[tuple[str, ...], dict[str, str]]:
    """`--set` texts as (values for `parse_settings`, variant choices by the variant's own name).

    A text whose name is a variant of the template is a choice (`wheel_drive=rear`); one that starts with `--` comes
    from an option of that name (`--tracks=shoes`) and is a choice or nothing. `YellowironError` for a text without "=",
    for a choice that the variant does not have, and for an option whose variant the template does not have.
    """
    variants = {fold(v.name): v for v in template.variants}
    values: list[str] = []
    choices: dict[str, str] = {}
    for text in texts:
        name, value = _halves(text)
        variant = variants.get(fold(name))
        if variant is None and name.startswith("--"):
            words = f"Machines of the type '{template.equipment_type}' have no {name.lstrip('-')} to choose"
            raise _refused(words, "Leave the option out.", where=name)
        if variant is None:
            values.append(text)
        else:
            choices[variant.name] = _choice(variant, value)
    return tuple(values), choices


def parse_settings(texts: Iterable[str], template: Template) -> Specifications:
    """`("Lift Cylinder Stroke=764 mm", …)` as specifications in SI with source `set`.

    Names are those the template asks for, without regard to case, `_`, `-` or spaces. `YellowironError` for an unknown
    name (with the nearest ones), a value that is no number with a unit, a unit of another dimension, one outside the
    wanted entry's minimum and maximum (without them: not finite, or not positive), and a name given twice with
    different values.
    """
    known = {fold(w.name): w for w in asked(template)}
    found: dict[str, Specification] = {}
    for text in texts:
        name, value = _halves(text)
        wanted = known.get(fold(name))
        if wanted is None:
            raise _refused(f"No specification or variant is called '{name}'", _nearest(name, template, known))
        specification = _specification(wanted, value, text)
        earlier = found.get(wanted.name)
        if earlier is not None and earlier.value != specification.value:
            twice = f"'{wanted.name}' is given twice: {earlier.text} and {specification.text}"
            raise _refused(twice, "Keep one of the two.")
        found[wanted.name] = specification
    return Specifications(found)


ALL_PROVEN = "all-proven"
"""What `--accept` takes for every value to review whose layout was understood and of which the sheets say one thing."""


def accept(specifications: Specifications, names: Iterable[str], template: Template) -> Specifications:
    """The specifications with values to review settled as a person who looked at them says: those named, and with
    `ALL_PROVEN` every one that stands on a page with text, in a layout that was understood, within its range, and
    without another candidate. `YellowironError` for a name that is not to review."""
    values = dict(specifications.values)
    known = {fold(w.name): w for w in asked(template)}
    for name in names:
        if fold(name) == fold(ALL_PROVEN):
            chosen = [s.name for s in values.values() if s.status == "review" and _is_proven(s, known[fold(s.name)])]
        else:
            found = specifications.get(name)
            if found is None or found.value is None or found.status not in ("review", "ok"):
                review = ", ".join(s.name for s in values.values() if s.status == "review") or "none"
                hint = f"To review: {review}. A conflict is settled with --set or --config."
                raise _refused(f"'{name}' is no value to review", hint, where="--accept")
            chosen = [found.name]
        for one in chosen:
            if values[one].status == "review":
                reason = f"accepted by hand; {values[one].reason}"
                values[one] = replace(values[one], status="ok", source="set", confidence=1.0, reason=reason, hint="")
    return Specifications(values, specifications.findings)


def _is_proven(value: Specification, wanted: Wanted) -> bool:
    others = {c.value for c in value.candidates} - {value.value}
    inside = value.value is not None and usual(wanted, value.value)
    return value.evidence is not None and inside and not others and value.confidence >= DOUBTFUL


def merge(*weakest_first: Specifications) -> Specifications:
    """One set of specifications out of several, the later ones stronger.

    A stronger source that knows nothing of a name (`missing`, `unreadable`) leaves the weaker one's word; one that is
    in doubt (`review`, `conflict`) does not, for a weaker source settles no doubt. Findings are kept, once each.
    """
    merged: dict[str, Specification] = {}
    spelling: dict[str, str] = {}
    findings: list[Finding] = []
    for specifications in weakest_first:
        for name, specification in specifications.values.items():
            key = spelling.setdefault(fold(name), name)
            if key not in merged or _rank(specification) >= _rank(merged[key]):
                merged[key] = specification
        findings += [f for f in specifications.findings if f not in findings]
    return Specifications(merged, tuple(findings))


def _rank(specification: Specification) -> int:
    return {"missing": 0, "unreadable": 1}.get(specification.status, 2)


def _refused(message: str, hint: str, *, where: str = _WHERE) -> YellowironError:
    return YellowironError(message, where=where, hint=hint)


def _halves(text: str) -> tuple[str, str]:
    if not text.isprintable():
        raise _refused("A value by hand has a line break, or a sign that cannot be seen", "Write it on one line.")
    name, equals, value = text.partition("=")
    if not equals or not name.strip() or not value.strip():
        raise _refused(f"'{text}' is not NAME=VALUE", 'Write e.g. --set "Lift Cylinder Stroke=764 mm".')
    return name.strip(), value.strip()


def _choice(variant: Variant, value: str) -> str:
    for choice in variant.choices:
        if fold(choice) == fold(value):
            return choice
    raise _refused(f"'{value}' is no choice of {variant.name}", f"Choices: {', '.join(variant.choices)}.")


def _specification(wanted: Wanted, value: str, text: str) -> Specification:
    unit = SI_UNIT[wanted.dimension]
    if "," in value or any(c.isdecimal() and not c.isascii() for c in value):
        hint = "Write digits 0 to 9, with a point for decimals and nothing between thousands: 1234.5 mm."
        raise _refused(f"'{value}' is not a number as it is written here", hint, where=f"{_WHERE} {text}")
    quantity = parse_one(value, where=f"{_WHERE} {text}")
    if quantity.unit == "" and unit != "1":
        raise _refused(f"'{value}' has no unit, and {wanted.name} has one ({wanted.dimension})", hint_for(wanted))
    if quantity.unit != "" and quantity.si_unit != unit:
        raise _refused(f"'{value}' is not {with_article(wanted.dimension)}, as {wanted.name} is", hint_for(wanted))
    _check_range(wanted, quantity.si_value, value, text)
    return Specification(
        name=wanted.name,
        value=quantity.si_value,
        unit=unit,
        status="ok",
        source="set",
        text=value,
        confidence=1.0,
        reason=f'given with --set "{text}"',
    )


def _check_range(wanted: Wanted, value: float, text: str, setting: str) -> None:
    """`YellowironError` for a value that the wanted entry's range, or its dimension, rules out."""
    unit = SI_UNIT[wanted.dimension]
    low, high = wanted.minimum, wanted.maximum
    bound = 2.0 * math.pi if wanted.dimension == "angle" else LARGEST[wanted.dimension]
    least = low if low is not None else -bound
    most = high if high is not None else bound
    slack = _ROUNDING * max(abs(b) for b in (least, most, 0.0) if math.isfinite(b))
    positive = low is None and wanted.dimension not in _SIGNED
    if math.isfinite(value) and least - slack <= value <= most + slack and (value > 0.0 or not positive):
        return
    start = "more than 0" if positive else f"from {display(least, unit)}"
    usual = f"{start} {'and at most' if positive else 'to'} {display(most, unit)}"
    hint = f"It is {usual}; check number and unit."
    raise _refused(f"'{text}' is outside what {wanted.name} can be", hint, where=f"{_WHERE} {setting}")


def _nearest(name: str, template: Template, known: dict[str, Wanted]) -> str:
    from rapidfuzz import fuzz, process, utils

    names: Sequence[str] = [w.name for w in known.values()] + [v.name for v in template.variants]
    close = process.extract(name, names, scorer=fuzz.WRatio, processor=utils.default_process, limit=3, score_cutoff=60)
    if close:
        return f"Did you mean {', '.join(repr(match[0]) for match in close)}?"
    return f"Known names: {', '.join(names[:12])}{' …' if len(names) > 12 else ''}."
