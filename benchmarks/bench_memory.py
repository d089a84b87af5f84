"""How much memory the guarded reader of a CAD file takes at most, beside what its libraries take when they are loaded,
against what its format is allowed (`CadFormat.memory`).

    python benchmarks/bench_memory.py [FILE …]

Without files, the example machines. `took` and `allowed` are times the file's bytes, unpacked and with those that it
names; every reader gets 1 GB besides. Linux.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from pkgutil import resolve_name

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src")]

SMALL = 120.0
"""Megabytes of scipy and others, which readers load on the way."""


def peak_mb() -> float:
    """The most memory that this process has had in use."""
    lines = Path("/proc/self/status").read_text().splitlines()
    return next(int(line.split()[1]) / 1024.0 for line in lines if line.startswith("VmHWM:"))


def measure(file: Path) -> dict[str, object]:
    """A file's figures, taken in this process, which has read nothing before."""
    from yellowiron.cad.need import need_mb
    from yellowiron.cad.recognition import format_of

    known = format_of(file)
    read = resolve_name(known.reader)
    before = max(peak_mb(), SMALL)
    parts = len(read(str(file)).parts)
    megabytes = need_mb(file, known) / known.memory
    return {"format": known.name, "allowed": known.memory, "parts": parts, "MB": megabytes, "peak": peak_mb(),
            "took": max(0.0, peak_mb() - before) / megabytes}  # fmt: skip


def main() -> None:
    """Prints a line a file; each is read in a process of its own."""
    if sys.argv[1:2] == ["--one"]:
        print(json.dumps(measure(Path(sys.argv[2]))))
        return
    files = [Path(name) for name in sys.argv[1:]] or sorted(ROOT.glob("examples/*/*.step"))
    print(f"{'file':40} {'format':8} {'parts':>6} {'MB':>8} {'peak MB':>8} {'took':>6} {'allowed':>8}")
    for file in files:
        done = subprocess.run([sys.executable, __file__, "--one", str(file)], capture_output=True, text=True)
        if done.returncode:
            print(f"{file.name[-40:]:40} {done.stderr.strip().splitlines()[-1][:100]}")
            continue
        one = json.loads(done.stdout.splitlines()[-1])
        print(f"{file.name[-40:]:40} {one['format']:8} {one['parts']:6} {one['MB']:8.2f} {one['peak']:8.0f} "
              f"{one['took']:6.0f} {one['allowed']:8}")  # fmt: skip


if __name__ == "__main__":
    main()
