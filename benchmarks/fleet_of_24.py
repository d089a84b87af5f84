"""A fleet of 24 here and on a Ray cluster of two nodes of which one is killed half way: what differs, and what is lost.

Run with `python benchmarks/fleet_of_24.py FOLDER`, beside `../shared/data`, with Ray installed
(`pip install 'yellowiron[fleet]'`); `--no-ray` runs it here alone. Variants of both examples, real machines, four
broken inputs, one that crashes its reader, one that hangs and one that needs too much memory.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import threading
import time
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests")]

from kit.fleets import FAULTY, READERS, SETTINGS, content  # noqa: E402
from kit.packages import install_package  # noqa: E402
from kit.small import write_small  # noqa: E402
from yellowiron.fleet import RayRunner, batch  # noqa: E402
from yellowiron.fleet.values import Outcome  # noqa: E402

DATA = ROOT.parent / "shared" / "data"
HALF = 11
"""So many have ended when a node is killed."""


def manifest(folder: Path) -> Path:
    """The manifest, and the inputs that are made for it."""
    made = folder / "in"
    write_small(made)
    loader, digger = ROOT / "examples" / "wheel_loader", ROOT / "examples" / "excavator"
    (made / "empty.step").touch()
    (made / "wrong.txt").write_text("no machine")
    (made / "half.step").write_bytes((loader / "wheel_loader.step").read_bytes()[:200_000])
    (made / "sheet.pdf").write_text("no sheet")
    for suffix in FAULTY:
        (made / f"bad.{suffix}").write_text(suffix.upper())
    a_loader = {"type": "wheel_loader", "cad": str(loader / "wheel_loader.step")}
    a_digger = {"type": "excavator", "cad": str(digger / "excavator.step")}
    sheets = {"specs": str(loader / "specifications.pdf")}, {"specs": str(digger / "specifications.pdf")}
    small = {"type": "in/type", "cad": "in/small.glb", "set": SETTINGS}
    (folder / "some.yaml").write_text(
        "parameters: {mass: {vary: mass, of: '*', each: true, factor: {uniform: [0.9, 1.1]}}}"
    )
    machines: list[dict[str, Any]] = [
        {"id": "loader", **a_loader, **sheets[0], "engines": ["mujoco"]},
        {"id": "loader_bare", **a_loader},
        {"id": "loader_short_stroke", **a_loader, **sheets[0], "set": ["Lift Cylinder Stroke=750 mm"]},
        {"id": "loader_varied", **a_loader, **sheets[0], "variants": {"file": "some.yaml", "count": 4, "seed": 1}},
        {"id": "digger_shoes", **a_digger, **sheets[1], "tracks": "shoes"},
        {"id": "digger_belt", **a_digger, **sheets[1], "tracks": "belt"},
        {"id": "digger_bare", **a_digger, "tracks": "fixed"},
        *({"id": name, "type": kind, "cad": str(DATA / path)} for name, kind, path in (
            ("zx120", "excavator", "zx120/zx120.glb"), ("zx200", "excavator", "zx200/zx200.glb"),
            ("caisson", "excavator", "caisson_excavator/Excavator.fbx"),
            ("crane", "mobile_crane", "crane/crane.glb"), ("forklift", "forklift", "forklift"),
            ("mini_excavator", "excavator", "mini_excavator"),
        )),
        *({"id": f"small_{number}", **small} for number in range(4)),
        {"id": "broken_empty", "type": "wheel_loader", "cad": "in/empty.step"},
        {"id": "broken_suffix", "type": "wheel_loader", "cad": "in/wrong.txt"},
        {"id": "broken_half", "type": "wheel_loader", "cad": "in/half.step"},
        {"id": "broken_sheet", **small, "specs": "in/sheet.pdf"},
        {"id": "crash", "type": "wheel_loader", "cad": "in/bad.crash"},
        {"id": "hang", "type": "wheel_loader", "cad": "in/bad.hang", "timeout": "30 s"},
        {"id": "memory", "type": "wheel_loader", "cad": "in/bad.memory", "memory": "1 GB"},
    ]  # fmt: skip
    path = folder / "fleet.json"
    path.write_text(json.dumps({"defaults": {"timeout": "40 min"}, "machines": machines}, indent=1))
    return path


def told(outcome: Outcome, ended: int, of: int) -> None:
    print(f"{ended}/{of} {outcome.id} {outcome.status} {outcome.seconds:.0f} s {outcome.message}", flush=True)


def on_ray(fleet: Path, out: Path) -> Counter[str]:
    """The fleet on a head without cores and two nodes of one core each, one of which is killed half way."""
    import ray
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "include_dashboard": False})
    nodes = [cluster.add_node(num_cpus=1) for _ in range(2)]

    def kill() -> None:
        time.sleep(3.0)
        print("a node is killed", flush=True)
        cluster.remove_node(nodes[1], allow_graceful=False)

    def heard(outcome: Outcome, ended: int, of: int) -> None:
        told(outcome, ended, of)
        if ended == HALF:
            threading.Thread(target=kill).start()

    try:
        return Counter(row["status"] for row in batch(fleet, out, runner=RayRunner(cluster.address), told=heard).rows)
    finally:
        ray.shutdown()
        cluster.shutdown()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--no-ray", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True)
    os.environ["YELLOWIRON_FRESH"] = "1"
    site = folder / "site"
    os.environ["PYTHONPATH"] = os.pathsep.join([str(site), str(ROOT / "src"), os.environ.get("PYTHONPATH", "")])
    with pytest.MonkeyPatch.context() as patch:
        install_package(site, patch, name="faulty-readers", group="yellowiron.cad_formats", entries=FAULTY,
                        modules={"faulty_readers": READERS})  # fmt: skip
        fleet = manifest(folder)
        here = batch(fleet, folder / "here", jobs=2, told=told)
        print("here", dict(Counter(row["status"] for row in here.rows)), flush=True)
        if arguments.no_ray:
            return
        print("on Ray", dict(on_ray(fleet, folder / "there")), flush=True)
    one, other = content(folder / "here"), content(folder / "there")
    differ = sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))
    print(f"{len(one)} and {len(other)} files, {len(differ)} differ: {differ}")


if __name__ == "__main__":
    main()
