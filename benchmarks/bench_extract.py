"""Extraction from generated sheets whose every value is known (`tests/kit/sheets`). Bars: docs/extraction.md.

Run from the repository's root: `python benchmarks/bench_extract.py [--by] [--faults F] [--manual PAGES]
[--sets tuned,held,final,last,fresh,fresh2,fresh3,fresh4,fresh5,fresh6,fresh7,fresh8,fresh9,fresh10,fresh11,
fresh12,fresh13,fresh14,fresh15,fresh16]`.
`--by` adds a line for each layout and language (and type, in the sets of all types), `--faults` writes each value that
did not come back right, `--manual` reads a manual of so many pages in the guarded child and prints its time and peak
memory (default: no manual). Seconds are processor time.
"""

from __future__ import annotations

import argparse
import functools
import resource
import statistics
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests")]

from reportlab.pdfgen.canvas import Canvas  # noqa: E402

from kit.sheets import SETS, WORDED, Score, cases, make, page_texts, score  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.specs.extraction import from_sheets, read  # noqa: E402
from yellowiron.specs.reader import read_sheet  # noqa: E402


def dense(path: Path) -> None:
    """A page ruled into 8 columns of 70 rows."""
    canvas = Canvas(str(path))
    for row in range(70):
        for column in range(8):
            canvas.setFont("Helvetica", 6)
            canvas.drawString(
                32 + 66 * column, 808 - 11 * row, f"Item {row}" if column % 2 == 0 else f"{row}{column} mm"
            )
    for row in range(71):
        canvas.line(30, 816 - 11 * row, 558, 816 - 11 * row)
    for column in range(9):
        canvas.line(30 + 66 * column, 816, 30 + 66 * column, 46)
    canvas.save()


def manual(path: Path, pages: int) -> None:
    """A manual: pages of running text and tables, of which one holds specifications."""
    canvas = Canvas(str(path))
    for page in range(pages):
        canvas.setFont("Helvetica", 9)
        for row in range(55):
            text = f"{page}.{row} Check the oil level every {row + 10} hours, and the bolts with {40 + row} N·m."
            canvas.drawString(40, 800 - 13.5 * row, "Wheelbase  3450 mm" if (page, row) == (pages // 2, 30) else text)
        canvas.showPage()
    canvas.save()


def line(name: str, one: Score) -> str:
    on, off = max(one.on, 1), max(one.off, 1)
    return (
        f"{name:22} printed {one.on:5}: ok {one.ok / on:6.1%}, ok or first to review {one.first / on:6.1%}, "
        f"wrong {one.wrong}; not printed {one.off:5}: missing {one.missing / off:6.1%}; ok without proof {one.unproven}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sets", default=",".join(SETS))
    parser.add_argument("--by", action="store_true")
    parser.add_argument("--faults", type=Path)
    parser.add_argument("--manual", type=int, default=0)
    arguments = parser.parse_args()
    load = functools.cache(functools.partial(load_template, sheet_only=True))
    faults: list[str] = []
    seconds: list[float] = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for split in filter(None, arguments.sets.split(",")):
            total, parts, count = Score(), {}, 0
            for case in cases(split):
                sheet = make(case, folder)
                start = time.process_time()
                one = read_sheet(sheet.path)
                found = from_sheets(load(case.equipment_type), [one], config=sheet.config)
                seconds += [(time.process_time() - start) / one.pages] * one.pages
                scored = score(sheet, found, page_texts(sheet.path))
                total, count = total + scored, count + 1
                kind = (case.kind,) if split in WORDED else ()
                for part in (case.layout, case.style[:2], *kind):
                    parts[part] = parts.get(part, Score()) + scored
            print(line(f"{split} ({count} sheets)", total))
            if arguments.by:
                for part in sorted(parts):
                    print(line(f"  {part}", parts[part]))
            faults += total.faults
        if seconds:
            print(
                f"a page: median {statistics.median(seconds):.3f} s, longest {max(seconds):.3f} s, {len(seconds)} pages"
            )
        dense(folder / "dense.pdf")
        start = time.process_time()
        one = read_sheet(folder / "dense.pdf")
        from_sheets(load("excavator"), [one])
        print(f"a densely ruled page: {time.process_time() - start:.3f} s, {len(one.statements)} statements")
        if arguments.manual:
            manual(folder / "manual.pdf", arguments.manual)
            before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
            one = read(folder / "manual.pdf")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            print(
                f"a manual of {one.pages} pages: {time.perf_counter() - start:.1f} s ("
                f"{after.ru_utime - before.ru_utime:.1f} s of processor), at most {after.ru_maxrss / 1024:.0f} MB"
            )
    if arguments.faults:
        arguments.faults.write_text("\n".join(faults) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
