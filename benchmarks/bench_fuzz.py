"""Damaged CAD files: every reader is given thousands of mutants of a sound file, and none may crash the program, hang,
or pass for whole.

    python benchmarks/bench_fuzz.py [--mutants 2000] [--notes FOLDER] [FORMAT …]

A mutant is the sound file with bytes flipped, cut off, taken out, put in twice, or numbers changed (seeded: the same
every time). Readers run in a child process as they do behind `read_cad`, but one child reads many mutants, and the next
is forked from a process that has their libraries loaded. Counted are:

- `read`: mutants that are still readable; `refused`: an error in one sentence;
- `crashed`: in the child, of which the guard makes an error;
- `ended`: what came to no end, by the reader's own limit of processor time (`guard.must_end`), which is an error, too;
- `hung`: no answer after the benchmark's limit of processor time; in the product the guard's limit ends them, late;
- `said`: read with fewer parts than the sound file has, and a finding says so;
- `fewer`: with fewer parts, as the mutant itself declares fewer (`fuzz_declared` counts them without a reader);
- `silent`: with fewer parts, and neither a finding nor the file says so; `half` of them cut short;
- `main`: what would have ended the program itself: looking at the file before it is read, or at what is left after;
- `strays`: files left anywhere but where the mutant was; `MB`: the most memory a child held; `slowest`: one mutant, s.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib
import io
import json
import os
import pickle
import random
import re
import resource
import selectors
import signal
import subprocess
import sys
import tempfile
import time
import zipfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests")]
LIMIT_S, WALL_S = 60.0, 600.0
"""Seconds of the processor, and on the clock, for one mutant."""
MEMORY = 4 * 1024**3
TELLING = frozenset({"CAD001", "CAD003", "CAD006", "CAD008"})
"""Findings that say that something is missing."""
ALONE = ("Blender",)
"""Formats whose library keeps something of a file that it has read: a child for every mutant."""
EPOCH = b"\x00\x00\x21\x00"
"""1980-01-01, as archives write it."""


def settled(data: bytes) -> bytes:
    """A file without the time when it was written: of the same length."""
    if data.startswith(b"PK"):
        for mark, at in ((b"PK\x03\x04", 10), (b"PK\x01\x02", 12)):
            data = re.sub(re.escape(mark) + b"(.{%d}).{4}" % (at - 4), mark + rb"\g<1>" + EPOCH, data, flags=re.DOTALL)
        return data
    data = re.sub(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d", b"2000-01-01T00:00:00", data)
    return re.sub(rb"15H\d{8}\.\d{6}", b"15H20000101.000000", data)


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
                archive.writestr(zipfile.ZipInfo(name), content)
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
    from yellowiron.cad.recognition import format_of
    from yellowiron.model.errors import YellowironError

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    module, name = target.split(":")
    reader = getattr(importlib.import_module(module), name)
    sound = file.read_bytes()
    # Libraries write to the standard output, too: what is ours goes where it was, what is theirs nowhere.
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for seed in range(first, last):
        kind, data = mutant(sound, seed)
        file.write_bytes(data)
        start = time.perf_counter()
        answer: dict[str, object] = {"seed": seed, "kind": kind}
        try:
            format_of(file)
        except YellowironError:
            pass
        except Exception as error:  # noqa: BLE001 - what would end the program
            answer["main"] = f"{type(error).__name__}: {error}"
        try:
            assembly = reader(str(file))
            pickle.dumps(assembly)
            codes = [f.code for f in assembly.findings if f.severity in ("error", "warning")]
            answer |= {"parts": len(assembly.parts), "codes": codes}
        except MemoryError:
            answer["error"] = "MemoryError"
        except Exception as error:  # noqa: BLE001 - what the guard does
            answer["error"] = f"{type(error).__name__}: {error}"[:200]
        answer["s"] = round(time.perf_counter() - start, 3)
        out.write(json.dumps(answer) + "\n")
        out.flush()
    file.write_bytes(sound)


def nursery(target: str, file: Path) -> None:
    """Loads what the reader loads, then for every two numbers on the standard input a child that reads the mutants from
    the first one to before the second."""
    learned, told = os.pipe()
    if (child := os.fork()) == 0:
        module, name = target.split(":")
        os.dup2(2, 1)
        getattr(importlib.import_module(module), name)(str(file))
        os.write(told, "\n".join(sys.modules).encode())
        os._exit(0)
    os.close(told)
    with os.fdopen(learned) as lines:
        modules = lines.read().split("\n")
    os.waitpid(child, 0)
    saved = os.dup(1)
    os.dup2(2, 1)
    for name in modules:
        # Some modules are there only as part of another.
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    os.dup2(saved, 1)
    for line in sys.stdin:
        if (child := os.fork()) == 0:
            os.write(1, json.dumps({"child": os.getpid()}).encode() + b"\n")
            work(target, file, *map(int, line.split()))
            os._exit(0)
        _, status, usage = os.wait4(child, 0)
        killed = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
        end = {"ended": child, "kb": usage.ru_maxrss, "signal": killed}
        os.write(1, b"\n" + json.dumps(end).encode() + b"\n")


def run(
    target: str, file: Path, count: int, *, alone: bool
) -> tuple[list[dict[str, Any]], list[tuple[int, str]], float]:
    """Every mutant's answer, those that gave none: (seed, how it ended), and the most memory, MB."""
    sound = file.read_bytes()
    answers: list[dict[str, Any]] = []
    lost: list[tuple[int, str]] = []
    peak = 0.0
    command = [sys.executable, __file__, "--work", target, str(file)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, cwd=file.parent) as source:
        assert source.stdin is not None and source.stdout is not None
        lines = _lines(source.stdout.fileno())
        seed = 0
        while seed < count:
            file.write_bytes(sound)
            last = seed + 1 if alone else count
            source.stdin.write(f"{seed} {last}\n".encode())
            source.stdin.flush()
            child, end = next(int(line["child"]) for line in lines if line is not None), "crashed"
            since, clock = 0.0, time.monotonic()
            for line in lines:
                if line is None:
                    if _spent(child) - since > LIMIT_S or time.monotonic() - clock > WALL_S:
                        end = "hung"
                        os.kill(child, signal.SIGKILL)
                elif "ended" in line:
                    peak = max(peak, line["kb"] / 1024.0)
                    end = "ended" if line["signal"] == signal.SIGXCPU else end
                    break
                else:
                    answers.append(line)
                    seed += 1
                    since, clock = _spent(child), time.monotonic()
            if seed < last:
                lost.append((seed, end))
                seed += 1
        source.stdin.close()
    file.write_bytes(sound)
    return answers, lost, peak


def _spent(process: int) -> float:
    """Seconds of the processor that a process has used; 0 for one that is gone."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _lines(stream: int) -> Iterator[Any]:
    """The JSON of every whole line; None for every while without one."""
    rest = b""
    with selectors.DefaultSelector() as streams:
        streams.register(stream, selectors.EVENT_READ)
        while True:
            if not streams.select(5.0):
                yield None
                continue
            data = os.read(stream, 65536)
            if not data:
                return
            *whole, rest = (rest + data).split(b"\n")
            for line in filter(None, whole):
                # A child that dies may leave half a line.
                with contextlib.suppress(json.JSONDecodeError):
                    yield json.loads(line)


def writers() -> dict[str, tuple[str, Any]]:
    """Format → the file's name and what writes it: the tests' small machine, and the other forms that formats have."""
    from fuzz_forms import FORMS
    from kit.cadfiles import blend as cad_blend
    from kit.cadfiles.exports import WRITERS

    found: dict[str, tuple[str, Any]] = {**WRITERS, **FORMS}
    if cad_blend.is_here():
        found["Blender"] = ("machine.blend", cad_blend.blend)
    return found


def report(name: str, path: Path, own: Path, options: argparse.Namespace) -> list[str]:
    """The table's cells for a format, whose sound file is at `path`, all that it may write being in `own`."""
    import fuzz_declared
    from kit.cadfiles.exports import ITEMS
    from yellowiron.cad import read_cad
    from yellowiron.cad.readers.exact import part21
    from yellowiron.cad.recognition import format_of

    whole = read_cad(path)
    assert len(whole.parts) == len(ITEMS) and not TELLING & {f.code for f in whole.findings}
    known = format_of(path)
    kind, sound, before = known.name, path.read_bytes(), set(own.rglob("*"))
    start = time.perf_counter()
    answers, lost, peak = run(known.reader, path, options.mutants, alone=kind in ALONE)
    seconds = time.perf_counter() - start
    # After a crash the program itself looks at the text.
    if kind == "STEP":
        for seed, _ in lost:
            part21.diagnose(mutant(sound, seed)[1])
    counted = Counter("refused" if "error" in a else "read" for a in answers)
    ends = Counter(end for _, end in lost)
    fewer = [a for a in answers if "error" not in a and a["parts"] < len(ITEMS)]
    unsaid = [a for a in fewer if not TELLING & set(a["codes"])]
    silent = [a for a in unsaid if fuzz_declared.count(kind, mutant(sound, a["seed"])[1]) != a["parts"]]
    half = [a for a in unsaid if a["kind"] == "cut"]
    main = [a for a in answers if "main" in a]
    # A child that was ended cannot tidy up its folder for temporary files; the guard's parent does.
    strays = [p for p in set(own.rglob("*")) - before if own / "spare" not in p.parents]
    if options.notes:
        options.notes.mkdir(parents=True, exist_ok=True)
        notes = [*answers, *({"seed": seed, "lost": end} for seed, end in lost)]
        text = "".join(json.dumps(note) + "\n" for note in notes)
        (options.notes / f"{own.name}.jsonl").write_text(text, encoding="utf-8")
        (options.notes / f"{own.name}{path.suffix}").write_bytes(sound)
    for entry in (lost, silent, half, main, strays):
        if entry:
            sys.stderr.write(f"{name}: {entry[:8]}\n")
    numbers = (
        len(answers) + len(lost), counted["read"], counted["refused"], ends["crashed"], ends["ended"], ends["hung"],
        len(fewer) - len(unsaid), len(unsaid) - len(silent), len(silent), len(half), len(main), len(strays),
    )  # fmt: skip
    slowest = max((a["s"] for a in answers), default=0.0)
    return [name, *map(str, numbers), f"{peak:.0f}", f"{slowest:.1f}", f"{seconds:.0f}"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--mutants", type=int, default=2000)
    parser.add_argument("--notes", type=Path, help="a folder for what came of every mutant and the sound file")
    parser.add_argument("--work", nargs=2, help=argparse.SUPPRESS)
    parser.add_argument("formats", nargs="*", metavar="FORMAT", help="in this order; all without")
    options = parser.parse_args()
    if options.work:
        target, file = options.work
        nursery(target, Path(file))
        return
    if os.environ.get("PYTHONHASHSEED") != "0":
        # Some libraries write their sets as they come.
        os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, "PYTHONHASHSEED": "0"})
    from kit.cadfiles.exports import ITEMS, WRITERS
    from yellowiron.cad import read_cad

    heads = ("format", "mutants", "read", "refused", "crashed", "ended", "hung", "said", "fewer", "silent", "half")
    heads += ("main", "strays", "MB", "slowest", "s")
    sys.stdout.write("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads) + "\n")
    with tempfile.TemporaryDirectory() as folder:
        truth = Path(folder, "truth.step")
        WRITERS["STEP"][1](truth, {})
        drawn = read_cad(truth)
        solids = {i.shape: drawn.shape_of(part).mesh for i, part in zip(ITEMS, drawn.parts, strict=True)}
        meshes = {key: (mesh.points, mesh.triangles) for key, mesh in solids.items()}
        known = writers()
        for name in options.formats or known:
            file, write = known[name]
            # Deep down, and with the folder for temporary files inside: what a file makes its reader write is seen.
            own = Path(folder, re.sub(r"\W", "", name))
            path, spare = own / "a" / "b" / "c" / file, own / "spare"
            path.parent.mkdir(parents=True)
            spare.mkdir()
            os.environ["TMPDIR"] = str(spare)
            write(path, meshes)
            path.write_bytes(settled(path.read_bytes()))
            sys.stdout.write("| " + " | ".join(report(name, path, own, options)) + " |\n")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
