"""What a second opinion is asked about: of drawn machines in a poor state and without names, how much of the surface
in doubt its questions show, and whether the right body is among those offered. No model is asked.

    python benchmarks/bench_opinion.py [FIRST_SEED [COUNT]]
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests")]

from kit.machines.damages import damaged  # noqa: E402
from kit.machines.synthetic import disguise  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.rows import expand  # noqa: E402
from yellowiron.model.specification import Specifications  # noqa: E402
from yellowiron.model.template import choose  # noqa: E402
from yellowiron.opinion.asking import MOST, offered_for  # noqa: E402
from yellowiron.opinion.doubts import apart, boxes_of, doubts_of  # noqa: E402
from yellowiron.stages import find_roles  # noqa: E402

DAMAGES = ("work equipment", "half", "scale slips", "no undercarriage")
KINDS = {"loader": "wheel_loader", "excavator": "excavator"}


def main(first: int = 4, count: int = 2) -> None:
    """Prints a line a machine: things in doubt; shares of the surface in doubt, and of that part of it which is wrong,
    that are shown; questions, those with the right body among the offered, those that show several bodies."""
    print("machine | in doubt | shown | wrong, shown | questions | right one offered | several bodies")
    for seed in range(first, first + count):
        for kind, damage in ((k, d) for k in KINDS for d in DAMAGES):
            assembly, truth, _ = disguise(damaged(kind, seed, damage), seed)
            template = load_template(KINDS[kind])
            assembly, found = find_roles(assembly, template, Specifications())
            template = expand(choose(template, found.choices), found.counts)
            boxes = boxes_of(assembly)
            every = apart(doubts_of(found, template, boxes), boxes)
            asked = every[:MOST]
            area = {part.id: assembly.shape_of(part).area for part in assembly.parts}
            body = {p.part: p.body for p in found.parts}
            doubted = {part for doubt in every for part in doubt.parts}
            wrong = {part for part in doubted if body[part] != truth[part][1]}
            seen = {part for doubt in asked for part in doubt.parts}
            sums = [[sum(area[p] for p in parts) for parts in (s & seen, s)] for s in (doubted, wrong)]
            largest = [truth[max(doubt.parts, key=lambda p: area[p])][1] for doubt in asked]
            right = sum(b in offered_for(d, found, template) for b, d in zip(largest, asked, strict=True))
            mixed = sum(len({truth[part][1] for part in doubt.parts}) > 1 for doubt in asked)
            shown = " | ".join(f"{100 * part / whole:.1f} %" if whole else "–" for part, whole in sums)
            print(f"{kind} {seed}, {damage} | {len(every)} | {shown} | {len(asked)} | {right} | {mixed}", flush=True)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))
