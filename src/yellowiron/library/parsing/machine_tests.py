"""`tests.json`: the payload, and what the machine is put to in an engine."""

from __future__ import annotations

from collections.abc import Mapping

from yellowiron.library.notation.quantities import quantity, yes
from yellowiron.library.notation.validated_json import Document
from yellowiron.library.parsing.measurements import in_si
from yellowiron.library.parsing.variants import choices_of
from yellowiron.model.errors import TemplateError
from yellowiron.model.machine_tests import MachineTest, PayloadTemplate, RatedLoad
from yellowiron.model.specification import fold

_NEEDED: Mapping[str, tuple[str, ...]] = {
    "tipping": ("site",),
    "force": ("site", "actuator"),
    "time": ("actuator",),
    "lift": ("actuator",),
}
"""Kind → the keys that a test of it cannot do without."""


def read_tests(document: Document) -> tuple[PayloadTemplate | None, tuple[MachineTest, ...]]:
    """The payload and the tests of a `tests.json`; texts with a unit become SI numbers. `TemplateError` for a test that
    lacks what its kind needs, and for a name that is there twice."""
    entry = document.data.get("payload")
    payload = None
    if entry is not None:
        rated = (
            RatedLoad(r["specification"], float(r["factor"]), r.get("source", ""), r.get("at", ""))
            for r in entry.get("rated", ())
        )
        site, *others = [entry["site"]] if isinstance(entry["site"], str) else entry["site"]
        payload = PayloadTemplate(site, tuple(rated), tuple(others))
    tests: list[MachineTest] = []
    for i, entry in enumerate(document.data.get("tests", ())):
        place = document.at("tests", i)
        for key in _NEEDED[entry["kind"]]:
            if key not in entry:
                raise TemplateError(
                    f"A test of kind '{entry['kind']}' needs '{key}'",
                    where=place,
                    hint="docs/template-format.md says what.",
                )
        if any(fold(entry["name"]) == fold(test.name) for test in tests):
            raise TemplateError(f"There are two tests '{entry['name']}'", where=place, hint="Give one another name.")
        given = {k: entry[k] for k in ("site", "direction", "actuator", "to", "flow", "base") if k in entry}
        tests.append(
            MachineTest(
                name=entry["name"],
                kind=entry["kind"],
                specification=entry.get("specification", entry["name"]),
                steps=tuple(in_si(step, place) for step in entry.get("steps", ())),
                offset=quantity(entry.get("offset", 0.0), "length", where=place),
                payload=float(entry.get("payload", 0.0)),
                expected=yes(entry.get("expected", True)),
                unweighted=not yes(entry.get("weights", True)),
                best=tuple(entry.get("best", ())),
                inputs=tuple(entry.get("inputs", ())),
                definition=entry.get("definition", ""),
                when=choices_of(entry, "when"),
                **given,
            )
        )
    return payload, tuple(tests)
