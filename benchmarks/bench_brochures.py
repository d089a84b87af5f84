"""Extraction from makers' own PDFs, against what a person read beside them (`benchmarks/brochures/*.json`).

Run from the repository's root: `YELLOWIRON_BROCHURES=FOLDER python benchmarks/bench_brochures.py [--held] [--all]
[--faults] [--only SLUG,…] [--every N] [--as-pictures] [--shake NAME,…] [--model right|lying]`.
The PDFs are not in the repository: each truth says where its own is from, and FOLDER holds it as `SLUG.pdf`. What is
not there is skipped, by name. Without `--held` or `--all` only the open ones are read.

A reading is one `extract` of one PDF, with `--config` where the PDF has several models. Of the values that the page
prints and the type asks for: `ok` and right; for review with the right value first; for review with another; missing
(or in conflict, unreadable). *Wrong* is every `ok` that is not what is printed, also of a value that is not printed at
all. What the page itself leaves open (`one_of`: two weights beside one label) is in no share, but no other value may
be `ok`. `--config`: values of readings with a model, whose first value is of that model's column. Seconds are
processor time of reading, text recognition with it.

`--as-pictures`: each PDF with text as a scan of itself: every page a JPEG of 170 dots an inch, turned by 0.4 degrees.

`--shake NAME,…`: each PDF with text in another file of the same page (`brochures_shaken`: "small", "split" …;
`all`), a line a change: what is lost of what is `ok` as printed, what is won, what is wrong. Without text recognition.

`--model right`: the rules with a language model that points to what the person read; `settled` counts what the rules
alone had missed or for review (or in conflict) and is `ok` and right with it. `--model lying`: the same with each of
the models that say something else, and with one that says yes to whatever the rules had doubted wrongly, beside the
rules and alone; only *wrong* counts. Neither needs a network or a model.
"""

from __future__ import annotations

import argparse
import functools
import io
import json
import os
import resource
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from unittest import mock

import pypdfium2
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from brochures_shaken import SHAKES, shaken  # noqa: E402
from kit.sheets.page_models import LIARS, at_hand, truthful  # noqa: E402
from yellowiron.endpoint import ModelOptions  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.errors import SheetError  # noqa: E402
from yellowiron.model.specification import Specification, Specifications  # noqa: E402
from yellowiron.model.template import Template, Wanted  # noqa: E402
from yellowiron.specs.extraction import by_rules, from_sheets, read, with_model  # noqa: E402
from yellowiron.specs.llm import page_reader  # noqa: E402
from yellowiron.specs.llm.pointing import PageText, Place, RefusedError  # noqa: E402
from yellowiron.specs.reader import Sheet, read_sheet  # noqa: E402
from yellowiron.support.units import parse_quantity  # noqa: E402

TRUTHS = ROOT / "benchmarks" / "brochures"
SCAN_DPI, SCAN_DEG, SCAN_QUALITY = 170.0, 0.4, 75
SLACK = 2e-3
"""Relative: the horsepower and the pound have more digits than a page prints."""


@dataclass
class Tally:
    """What became of the printed values of one or more readings."""

    printed: int = 0
    ok: int = 0
    first: int = 0
    other: int = 0
    missed: int = 0
    wrong: int = 0
    configured: int = 0
    from_column: int = 0
    pages: int = 0
    seconds: float = 0.0
    left: int = 0
    settled: int = 0
    brought: int = 0
    faults: list[str] = field(default_factory=list)

    def add(self, one: Tally) -> None:
        for name in (
            "printed", "ok", "first", "other", "missed", "wrong", "configured", "from_column", "pages", "seconds",
            "left", "settled", "brought",
        ):  # fmt: skip
            setattr(self, name, getattr(self, name) + getattr(one, name))
        self.faults += one.faults

    def line(self, name: str) -> str:
        def share(count: int) -> str:
            return f"{count:4} {count / max(self.printed, 1):6.1%}"

        config = f"{self.from_column}/{self.configured}" if self.configured else "–"
        return (
            f"{name:22} {self.printed:4} ok {share(self.ok)}  review right {share(self.first)}  "
            f"review other {share(self.other)}  missed {share(self.missed)}  wrong {self.wrong}  "
            f"config {config:>8}  {self.seconds / max(self.pages, 1):.2f} s a page"
            + (
                f"  left open {self.left}: settled {self.settled}, brought for review {self.brought}"
                if self.left
                else ""
            )
        )


def first(value: Specification) -> float | None:
    """The value that a person is shown first."""
    return value.value if value.value is not None or not value.candidates else value.candidates[0].value


def near(printed: str, value: float | None) -> bool:
    """Whether it is what the page prints, in either system of measurement ("10.9 m / 36 ft")."""
    expected = _expected(printed)
    return value is not None and any(abs(value - one) <= SLACK * abs(one) + 1e-9 for one in expected)


@functools.cache
def _expected(printed: str) -> tuple[float, ...]:
    return tuple(parse_quantity(one, where=printed)[0] for one in printed.split(" / "))


def judge(where: str, truth: dict[str, dict[str, object]], found: Specifications, config: str) -> Tally:
    tally = Tally()
    for name, value in found.values.items():
        known = truth.get(name)
        seen = f"“{value.evidence.quote}”" if value.evidence else ""
        said = f"{where} {name}: {value.status} {first(value)} {seen} {value.reason}"
        if known is None or "one_of" in known:
            allowed = [] if known is None else list(map(str, known["one_of"]))  # type: ignore[call-overload]
            if value.status == "ok" and not any(near(one, value.value) for one in allowed):
                tally.wrong += 1
                tally.faults.append(f"WRONG {said}")
            continue
        tally.printed += 1
        right = near(str(known["value"]), first(value))
        if config:
            tally.configured += first(value) is not None
            tally.from_column += right
        if value.status == "ok":
            tally.ok += right
            tally.wrong += not right
        elif value.status == "review":
            tally.first += right
            tally.other += not right
        else:
            tally.missed += 1
        if value.status != "ok" or not right:
            mark = "WRONG" if value.status == "ok" else "right, " + value.status if right else value.status.upper()
            others = "".join(f" [{c.value} {c.configuration} {c.reason}]" for c in value.candidates[:4])
            tally.faults.append(f"{mark}; printed {known['value']}; {said}{others}")
    return tally


@contextmanager
def answers_kept() -> Iterator[None]:
    """What the gates say of an entry is asked once for all models that give it, on one reading."""
    gate, place = page_reader.checked, page_reader.place_of
    told: dict[tuple[object, ...], page_reader.Pointed | RefusedError] = {}
    placed: dict[tuple[object, ...], Place | RefusedError] = {}

    def entry(said: Mapping[str, object], text: PageText) -> tuple[object, ...]:
        return (id(text), *(str(said[key]) for key in sorted(said) if key != "name"))

    def kept(known: dict[Any, Any], key: tuple[object, ...], make: Callable[[], Any]) -> Any:
        if key not in known:
            try:
                known[key] = make()
            except RefusedError as why:
                known[key] = why
        if isinstance(known[key], RefusedError):
            raise known[key]
        return known[key]

    def checked(one: Wanted | None, said: Mapping[str, object], text: PageText, *others: Any) -> Any:
        key = (one.name if one else "", *entry(said, text))
        return kept(told, key, lambda: gate(one, said, text, *others))

    def place_of(said: Mapping[str, object], text: PageText, row: int) -> Any:
        return kept(placed, entry(said, text), lambda: place(said, text, row))

    with mock.patch.object(page_reader, "checked", checked), mock.patch.object(page_reader, "place_of", place_of):
        yield


def judged_with_model(
    kind: str, template: Template, sheet: Sheet, truth: dict[str, dict[str, object]], config: str, where: str
) -> Tally:
    """A reading with a played model: with the right one beside the rules what became of what they left open; with the
    lying ones nothing but what is wrong. What does not depend on a model's words is made once for all of them."""
    known = {name: str(one["value"]).split(" / ")[0] for name, one in truth.items() if "value" in one}
    pages = {name: int(str(one["page"])) for name, one in truth.items()}
    options = ModelOptions("played", "http://localhost", most_calls=10**6, most_s=1e9)
    ruled = by_rules(template, [sheet], config=config)
    alone = ruled.specifications()
    if kind == "right":
        with at_hand(truthful(known, pages)):
            found = with_model(ruled, "both", options)
        tally = judge(where, truth, found, config)
        for name, printed in known.items():
            before, after = alone.values.get(name), found.values.get(name)
            if before is None or after is None or (before.status == "ok" and near(printed, before.value)):
                continue
            tally.left += 1
            right = near(printed, first(after))
            tally.settled += after.status == "ok" and right
            tally.brought += after.status == "review" and right and not near(printed, first(before))
        return tally
    tally = judge(where, truth, alone, config)
    slips = {
        one.name: f"{value!r} {one.unit}"
        for one in alone
        if one.status != "ok"
        and (value := first(one)) is not None
        and not near(str(truth.get(one.name, {}).get("value", "0 m")), value)
    }
    seen = {one.name: one.evidence.page for one in alone if one.evidence is not None}
    lies = {**LIARS, "yes to the rules": lambda _: truthful(slips, seen)}
    with answers_kept():
        for name, liar in lies.items():
            for extractor in ("llm", "both"):
                with at_hand(liar(known)):
                    found = with_model(ruled, extractor, options)
                lied = judge(f"{where} [{name}, {extractor}]", truth, found, config)
                tally.wrong += lied.wrong
                tally.faults += [fault for fault in lied.faults if fault.startswith("WRONG")]
    return tally


def scanned(pdf: Path, folder: Path) -> Path:
    """The PDF as pictures without text: a little askew, as JPEG."""
    document = pypdfium2.PdfDocument(pdf)
    scans = []
    for page in document:
        drawn = page.render(scale=SCAN_DPI / 72).to_pil().convert("RGB")
        stream = io.BytesIO()
        drawn.rotate(SCAN_DEG, Image.Resampling.BICUBIC, fillcolor="white").save(stream, "JPEG", quality=SCAN_QUALITY)
        scans.append(Image.open(stream))
    document.close()
    made = folder / pdf.name
    scans[0].save(made, "PDF", resolution=SCAN_DPI, save_all=True, append_images=scans[1:])
    return made


Read = dict[tuple[str, str, str], tuple[bool, bool]]
"""By file, model and value: whether it is `ok` and right, and whether it is `ok` and wrong."""


def read_shaken(how: str, truths: Mapping[Path, dict[str, Any]], scratch: Path) -> tuple[Tally, Read]:
    """The readings of PDFs after one of the `SHAKES`."""
    load = functools.cache(functools.partial(load_template, sheet_only=True))
    total, found = Tally(), Read()
    for pdf, truth in truths.items():
        before = _seconds()
        with shaken(pdf, how, scratch) as path:
            sheet = read_sheet(path)
        total.pages += sheet.pages
        for reading in truth["readings"]:
            config = reading["config"] or ""
            values = from_sheets(load(truth["type"]), [sheet], config=config)
            total.add(judge(f"{how}: {pdf.stem} {config}".strip(), reading["values"], values, config))
            for name, value in values.values.items():
                known = reading["values"].get(name, {})
                allowed = [str(known["value"])] if "value" in known else list(map(str, known.get("one_of", ())))
                right = any(near(one, value.value) for one in allowed)
                ok = value.status == "ok"
                found[pdf.stem, config, name] = ("value" in known and ok and right, ok and not right)
        total.seconds += _seconds() - before
    return total, found


def shake(names: Sequence[str], truths: Mapping[Path, dict[str, Any]], scratch: Path) -> list[str]:
    """Prints a line for each change of the file; the faults of all of them."""
    printed, before = read_shaken("printed", truths, scratch)
    print(printed.line("printed"), flush=True)
    faults = []
    for how in names:
        tally, after = read_shaken(how, truths, scratch)
        lost = sum(ok and not after[key][0] for key, (ok, _) in before.items())
        won = sum(ok and not before[key][0] for key, (ok, _) in after.items())
        wrong = sum(one and not before[key][1] for key, (_, one) in after.items())
        print(f"{tally.line(how)}  lost {lost}, won {won}, newly wrong {wrong}", flush=True)
        faults += tally.faults
    return faults


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--held", action="store_true", help="the held-back ones instead of the open ones")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--faults", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--every", type=int, default=1, help="each so manieth file only")
    parser.add_argument("--as-pictures", action="store_true")
    parser.add_argument("--shake", default="", help="changes of the file, or all")
    parser.add_argument("--model", choices=["right", "lying"])
    arguments = parser.parse_args()
    folder = Path(os.environ.get("YELLOWIRON_BROCHURES", ""))
    if not os.environ.get("YELLOWIRON_BROCHURES") or not folder.is_dir():
        print("skipped: YELLOWIRON_BROCHURES names no folder of PDFs")
        return
    load = functools.cache(functools.partial(load_template, sheet_only=True))
    scans = tempfile.TemporaryDirectory()
    totals = {False: Tally(), True: Tally()}
    shaken_ones: dict[Path, dict[str, Any]] = {}
    for path in sorted(TRUTHS.glob("*.json"))[:: arguments.every]:
        truth = json.loads(path.read_text(encoding="utf-8"))
        if (arguments.only and path.stem not in arguments.only.split(",")) or not (
            arguments.all or arguments.only or truth["held"] == arguments.held
        ):
            continue
        pdf = folder / f"{path.stem}.pdf"
        if not pdf.is_file():
            print(f"{path.stem:22} skipped: {pdf.name} is not there")
            continue
        if arguments.shake:
            shaken_ones |= {} if truth["picture"] else {pdf: truth}
            continue
        if arguments.as_pictures:
            if truth["picture"]:
                continue
            pdf, truth["picture"] = scanned(pdf, Path(scans.name)), True
        before = _seconds()
        try:
            sheet = read(pdf)
        except SheetError as error:
            lost = sum("value" in known for reading in truth["readings"] for known in reading["values"].values())
            tally = Tally(printed=lost, missed=lost, faults=[f"UNREAD {path.stem}: {error}"])
            print(tally.line(path.stem))
            totals[truth["picture"]].add(tally)
            continue
        tally = Tally(pages=sheet.pages, seconds=_seconds() - before)
        for reading in truth["readings"]:
            config = reading["config"] or ""
            before = _seconds()
            where = f"{path.stem} {config}".strip()
            template = load(truth["type"])
            if arguments.model:
                tally.add(judged_with_model(arguments.model, template, sheet, reading["values"], config, where))
                continue
            found = from_sheets(template, [sheet], config=config)
            tally.seconds += (_seconds() - before) / len(truth["readings"])
            tally.add(judge(where, reading["values"], found, config))
        print(tally.line(path.stem + (" (picture)" if truth["picture"] else "")))
        totals[truth["picture"]].add(tally)
    if arguments.shake:
        names = SHAKES[1:] if arguments.shake == "all" else arguments.shake.split(",")
        totals[False].faults += shake(names, shaken_ones, Path(scans.name))
    for picture, tally in totals.items():
        if tally.pages:
            print(tally.line("PICTURES" if picture else "TEXT"))
    if arguments.faults:
        print("\n".join(f for tally in totals.values() for f in tally.faults))


def _seconds() -> float:
    return sum(
        usage.ru_utime + usage.ru_stime
        for usage in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )


if __name__ == "__main__":
    main()
