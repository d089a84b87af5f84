"""`variants.json`, and the `when` of entries that only some choices have."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from yellowiron.library.notation.validated_json import Document, near
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import Choices, Variant


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
            Variant(
                name,
                tuple(entry["choices"]),
                entry["default"],
                decided_by=entry.get("decided_by", "user"),
                needs={choice: choices_of(entry["needs"], choice) for choice in entry.get("needs", {})},
            )
        )
    for variant in variants:
        where = document.at(variant.name, "needs")
        check_choices({variant.name: tuple(variant.needs)}, variants, where)
        for needed in variant.needs.values():
            check_choices(needed, variants, where)
    return tuple(variants)


def choices_of(entry: Mapping[str, Any], key: str) -> Choices:
    """`{"lift_cylinders": "twin"}` as variant → tuple of choices."""
    return {k: (v,) if isinstance(v, str) else tuple(v) for k, v in entry.get(key, {}).items()}


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
