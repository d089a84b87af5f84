"""Damaged CAD files: every reader is given thousands of mutants of a sound file, and none may crash the program, hang,
or pass for whole.

    python benchmarks/bench_fuzz.py [--mutants 2000] [FORMAT …]

A mutant is the sound file with bytes flipped, cut off, taken out, put in twice, or numbers changed (seeded: the same
every time). Readers run in a child process as they do behind `read_cad`, but one child reads many mutants. Counted are:

- `read`: mutants that are still readable; `refused`: an error in one sentence;
- `child died`: a crash or a bomb in the child, which the guard makes an error of;
- `hung`: no answer in the limit, which the guard ends, too;
- `said`: read with fewer parts than the sound file has, and a finding says so;
- `unsaid`: with fewer parts and no finding. Only for truncated mutants is that a defect for sure (`half`): a change in
  the tree's own text may take a part out of it without a trace.
"""

from __future__ import annotations

import argparse
import importlib
import io
import json
import os
import random
import re
import resource
import selectors
import subprocess
import sys
import tempfile
import time
import zipfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests" / "cad")]
LIMIT_S = 30.0
MEMORY = 4 * 1024**3


def mutant(sound: bytes, seed: int) -> tuple[str, bytes]:
    """What was done to a file, and the file. Of archives every second mutant is packed again, its checksums right."""
    rng = random.Random(seed)
    if sound.startswith(b"PK") and seed % 2 and b".usd" not in sound[:200]:
        with zipfile.ZipFile(io.BytesIO(sound)) as archive:
            members = {name: archive.read(name) for name in archive.namelist()}
        inside = rng.choice(sorted(members))
        kind, members[inside] = mutant(members[inside], rng.randrange(2**32))
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w") as archive:
            for name, content in members.items():
                archive.writestr(name, content)
        return kind, packed.getvalue()
    data = bytearray(sound)
    kind = rng.choice(("flip", "flip", "cut", "out", "twice", "zero", "number", "number"))
    at = rng.randrange(len(data))
    size = min(len(data) - at, 1 + int(rng.expovariate(1 / 60)))
    if kind == "flip":
        for _ in range(rng.randint(1, 8)):
            data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    elif kind == "cut":
        del data[max(1, at) :]
    elif kind == "out":
        del data[at : at + size]
    elif kind == "twice":
        data[at:at] = data[at : at + size]
    elif kind == "zero":
        data[at : at + size] = bytes(size)
    else:
        places = [m.span() for m in re.finditer(rb"\d+", bytes(data))]
        for low, high in sorted(rng.sample(places, min(len(places), rng.randint(1, 3))), reverse=True):
            data[low:high] = rng.choice((b"0", b"-1", b"65536", b"4294967295", b"1e308", b"nan", b"7"))
    return kind, bytes(data)


def work(target: str, file: Path, first: int, last: int) -> None:
    """The child: reads mutants, and says a line of JSON for each."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    module, name = target.split(":")
    reader = getattr(importlib.import_module(module), name)
    sound = file.read_bytes()
    # Libraries write to the standard output, too: what is ours goes where it was, what is theirs to the errors.
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for seed in range(first, last):
        kind, data = mutant(sound, seed)
        file.write_bytes(data)
        answer: dict[str, object] = {"seed": seed, "kind": kind}
        try:
            assembly = reader(str(file))
            codes = [f.code for f in assembly.findings if f.severity in ("error", "warning")]
            answer |= {"parts": len(assembly.parts), "codes": codes}
        except MemoryError:
            answer["error"] = "MemoryError"
        except Exception as error:  # noqa: BLE001 - what the guard does
            answer["error"] = type(error).__name__
        out.write(json.dumps(answer) + "\n")
        out.flush()
    file.write_bytes(sound)


def run(target: str, file: Path, count: int) -> tuple[list[dict[str, object]], list[tuple[int, str]]]:
    """Every mutant's answer, and those that gave none: (seed, "died" or "hung")."""
    sound = file.read_bytes()
    answers: list[dict[str, object]] = []
    lost: list[tuple[int, str]] = []
    seed = 0
    while seed < count:
        file.write_bytes(sound)
        command = [sys.executable, __file__, "--work", target, str(file), str(seed), str(count)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as child:
            assert child.stdout is not None
            rest = b""
            with selectors.DefaultSelector() as streams:
                streams.register(child.stdout, selectors.EVENT_READ)
                while streams.select(LIMIT_S if answers else 3 * LIMIT_S):
                    data = os.read(child.stdout.fileno(), 65536)
                    if not data:
                        break
                    *lines, rest = (rest + data).split(b"\n")
                    answers += [json.loads(line) for line in lines]
                    seed += len(lines)
            if seed < count:
                lost.append((seed, "hung" if not _ended(child) else "died"))
                seed += 1
            child.kill()
    file.write_bytes(sound)
    return answers, lost


def _ended(child: subprocess.Popen[bytes]) -> bool:
    try:
        child.wait(1.0)
    except subprocess.TimeoutExpired:
        return False
    return True


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mutants", type=int, default=2000)
    parser.add_argument("--work", nargs=4, help=argparse.SUPPRESS)
    parser.add_argument("formats", nargs="*", metavar="FORMAT")
    options = parser.parse_args()
    if options.work:
        target, file, first, last = options.work
        work(target, Path(file), int(first), int(last))
        return
    from cad_exports import ITEMS, WRITERS

    from yellowiron.cad import read_cad
    from yellowiron.cad.read import _READERS
    from yellowiron.cad.sniff import format_of

    heads = ("format", "mutants", "read", "refused", "child died", "hung", "said", "unsaid", "half", "strays", "s")
    sys.stdout.write("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads) + "\n")
    with tempfile.TemporaryDirectory() as folder:
        truth = Path(folder, "truth.step")
        WRITERS["STEP"][1](truth, {})
        drawn = read_cad(truth)
        solids = {i.shape: drawn.shape_of(part).mesh for i, part in zip(ITEMS, drawn.parts, strict=True)}
        meshes = {key: (mesh.points, mesh.triangles) for key, mesh in solids.items()}
        for name, (file, write) in WRITERS.items():
            if options.formats and name not in options.formats:
                continue
            own = Path(folder, re.sub(r"\W", "", name))
            own.mkdir()
            path = own / file
            write(path, meshes)
            before = {p.name for p in own.iterdir()}
            start = time.perf_counter()
            answers, lost = run(_READERS[format_of(path)], path, options.mutants)
            seconds = time.perf_counter() - start
            counted = Counter("refused" if "error" in a else "read" for a in answers)
            ends = Counter(end for _, end in lost)
            fewer = [a for a in answers if "error" not in a and int(str(a["parts"])) < len(ITEMS)]
            unsaid = [a for a in fewer if not a["codes"]]
            half = [a for a in unsaid if a["kind"] == "cut"]
            strays = {p.name for p in own.iterdir()} - before
            cells = (
                name, len(answers) + len(lost), counted["read"], counted["refused"], ends["died"], ends["hung"],
                len(fewer) - len(unsaid), len(unsaid), len(half), len(strays), f"{seconds:.0f}",
            )  # fmt: skip
            sys.stdout.write("| " + " | ".join(str(c) for c in cells) + " |\n")
            sys.stdout.flush()
            for entry in (lost, half):
                if entry:
                    sys.stderr.write(f"{name}: {entry[:8]}\n")


if __name__ == "__main__":
    main()
