"""A batch end to end, with real child processes: what one item does touches no other, and what is whole stays."""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from kit.builds import console
from kit.fleets import content, write_manifest
from yellowiron.fleet import batch, planned
from yellowiron.fleet.keys import Keys
from yellowiron.fleet.places import staged, store_at
from yellowiron.fleet.pool import LocalRunner
from yellowiron.fleet.values import Item
from yellowiron.model.errors import OutputError

TWO = [{"cad": "in/small.glb", "id": "one"}, {"cad": "in/other.glb", "id": "two"}]


def statuses(fleet: Any) -> dict[str, str]:
    return {row["id"]: row["status"] for row in fleet.rows}


def runs(manifest: Path, out: Path, **options: Any) -> dict[str, str]:
    return {choice.item.id: choice.why for choice in planned(manifest, out, **options)[2] if choice.run}


@pytest.mark.slow
def test_bad_items_are_told_and_touch_no_other(
    tmp_path: Path, inputs: Path, faulty_readers: None, example: Path
) -> None:
    half = inputs / "half.step"
    half.write_bytes((example / "wheel_loader.step").read_bytes()[:200_000])
    (inputs / "sheet.pdf").write_text("no sheet")
    manifest = write_manifest(tmp_path, [
        TWO[0],
        {"cad": "in/empty.step"},
        {"cad": "in/wrong.txt"},
        {"cad": "in/half.step"},
        {"cad": "in/gone.step"},
        {"cad": "in/small.glb", "id": "sheet", "specs": "in/sheet.pdf"},
        {"cad": "in/bad.crash", "id": "crash"},
        {"cad": "in/bad.hang", "id": "hang", "timeout": 6},
        {"cad": "in/bad.memory", "id": "memory", "memory": 400},
        {"cad": "in/small.glb", "id": "engine", "engines": ["no such"]},
        TWO[1],
    ], page=True)  # fmt: skip
    fleet = batch(manifest, tmp_path / "out", jobs=3)
    told = {row["id"]: (row["status"], row["message"]) for row in fleet.rows}
    assert told["one"][0] == told["two"][0] == "short"
    assert told["empty"] == ("refused", "The CAD file is empty")
    assert told["wrong"] == ("refused", "This is no CAD file that is known here")
    assert told["half"][0] == told["gone"][0] == told["sheet"][0] == told["engine"][0] == "refused"
    assert told["crash"] == ("refused", "The reader crashed (SIGSEGV)")
    assert told["hang"] == ("timeout", "The build took more than 6 s and was stopped")
    assert told["memory"] == ("memory", "The build needs more than 400 MB of memory and was stopped")
    assert fleet.code == 2
    out = tmp_path / "out"
    built = {path.parent.name for path in (out / "items").glob("*/machine")}
    assert built == {"one", "two"}
    assert (out / "items" / "one" / "picture.webp").stat().st_size > 500
    assert not (out / ".staging").exists()
    files = {path.name for path in (out / "items" / "hang").iterdir()}
    assert files == {"item.json", "seconds.json"}
    # What is refused, or beyond a limit, would come out the same again; asked for, it is tried again.
    assert runs(manifest, out, resume=True) == {}
    assert set(runs(manifest, out, only="failed")) == set(told) - {"one", "two"}


@pytest.mark.slow
def test_the_same_again_is_the_same_bytes_and_resume_builds_nothing_twice(tmp_path: Path, inputs: Path) -> None:
    manifest = write_manifest(tmp_path, [*TWO, {"cad": "in/empty.step"}])
    batch(manifest, tmp_path / "a", jobs=2)
    batch(manifest, tmp_path / "b", jobs=1)
    first = content(tmp_path / "a")
    assert first == content(tmp_path / "b")
    assert {"items/one/machine/small.usda", "items/one/item.json", "index.html", "fleet.csv"} <= first.keys()
    again = batch(manifest, tmp_path / "a", resume=True)
    assert again.outcomes == []
    assert again.code == 2
    # Another option, another file's bytes: these alone.
    changed = [{**TWO[0], "set": ["Arm Angle Up=35 deg"]}, TWO[1], {"cad": "in/empty.step"}]
    assert runs(write_manifest(tmp_path, changed), tmp_path / "a", resume=True) == {
        "one": "its inputs, options or the version have changed"
    }
    manifest = write_manifest(tmp_path, [*TWO, {"cad": "in/empty.step"}])
    (inputs / "other.glb").write_bytes((inputs / "other.glb").read_bytes() + b"\0\0\0\0")
    assert set(runs(manifest, tmp_path / "a", resume=True)) == {"two"}


@pytest.mark.slow
def test_a_child_that_is_killed_gets_another_try(tmp_path: Path, inputs: Path) -> None:
    manifest = write_manifest(tmp_path, TWO)
    runner = LocalRunner(2)
    killed: list[int] = []

    _, store, choices = planned(manifest, tmp_path / "out")
    work = [(choice.item, choice.key) for choice in choices]
    started = runner(work, store)
    from yellowiron.fleet import attending

    begin = attending.Child.start

    def start(item: Item, key: str, staging: Path) -> attending.Child:
        child = begin(item, key, staging)
        if item.id == "one" and not killed:
            killed.append(child.process.pid)
            os.kill(child.process.pid, signal.SIGKILL)
        return child

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(attending.Child, "start", start)
        outcomes = {outcome.id: outcome.status for outcome in started}
    assert killed
    assert outcomes == {"one": "short", "two": "short"}


def hears_ctrl_c() -> None:
    """Where the tests themselves run in the background, what they start does not hear Ctrl-C."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def command(manifest: Path, out: Path, *words: str) -> list[str]:
    return [sys.executable, "-m", "yellowiron", "batch", str(manifest), "--out", str(out), "-q", "-j", "2", *words]


def environment(root: Path) -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(root / "src")}


@pytest.mark.slow
def test_a_run_killed_at_any_moment_goes_on_where_it_was(tmp_path: Path, inputs: Path, root: Path) -> None:
    machines = [{"cad": "in/small.glb", "id": f"m{n}"} for n in range(4)]
    manifest = write_manifest(tmp_path, machines)
    whole = tmp_path / "whole"
    begun = time.monotonic()
    subprocess.run(command(manifest, whole), env=environment(root), check=False)
    length = time.monotonic() - begun
    chance = random.Random(3)
    for attempt in range(3):
        out = tmp_path / f"cut{attempt}"
        run = subprocess.Popen(command(manifest, out), env=environment(root))
        time.sleep(chance.uniform(0.3, 0.9) * length)
        run.send_signal(signal.SIGKILL)
        run.wait()
        there = {p.parent: p.stat().st_mtime_ns for p in (out / "items").glob("*/item.json")} if out.exists() else {}
        subprocess.run(command(manifest, out, "--resume"), env=environment(root), check=False)
        assert content(out) == content(whole)
        assert {folder: (folder / "item.json").stat().st_mtime_ns for folder in there} == there


@pytest.mark.slow
def test_ctrl_c_ends_what_is_at_work_and_leaves_what_is_whole(tmp_path: Path, inputs: Path, root: Path) -> None:
    machines = [{"cad": "in/small.glb", "id": f"m{n}"} for n in range(6)]
    manifest = write_manifest(tmp_path, machines)
    out = tmp_path / "out"
    run = subprocess.Popen(command(manifest, out, "-j", "1"), env=environment(root), preexec_fn=hears_ctrl_c)
    for _ in range(600):
        if list((out / "items").glob("*/item.json")):
            break
        time.sleep(0.1)
    run.send_signal(signal.SIGINT)
    assert run.wait(30) == 130
    done = sorted(path.name for path in (out / "items").iterdir())
    assert 1 <= len(done) < 6
    assert not (out / ".staging").exists()
    assert "not run" in (out / "index.html").read_text()
    assert sum("absent" in line for line in (out / "fleet.csv").read_text().splitlines()) == 6 - len(done)


STOPPED_AS_IT_STARTS = """
import os, signal, sys
from yellowiron.fleet import attending, planned, pool
from yellowiron.support import stopping

begin = attending.Child.start

def start(item, key, staging):
    child = begin(item, key, staging)
    print(child.process.pid, flush=True)
    os.kill(os.getpid(), signal.SIGINT)
    return child

attending.Child.start = start
stopping.listen()
_, store, choices = planned(sys.argv[1], sys.argv[2])
list(pool.LocalRunner(1)([(choice.item, choice.key) for choice in choices], store))
"""


@pytest.mark.slow
def test_ctrl_c_as_a_child_starts_ends_that_child_too(tmp_path: Path, inputs: Path, root: Path) -> None:
    manifest = write_manifest(tmp_path, TWO)
    call = [sys.executable, "-c", STOPPED_AS_IT_STARTS, str(manifest), str(tmp_path / "out")]
    run = subprocess.run(
        call, env=environment(root), preexec_fn=hears_ctrl_c, capture_output=True, text=True, timeout=60, check=False
    )
    assert run.returncode == 130, run.stderr
    with pytest.raises(ProcessLookupError):
        os.kill(int(run.stdout), 0)
    assert not (tmp_path / "out" / ".staging").exists()


@pytest.mark.slow
def test_a_place_that_takes_nothing_is_told_of_its_item_alone(tmp_path: Path, inputs: Path) -> None:
    manifest = write_manifest(tmp_path, TWO)
    from yellowiron.fleet import places

    install = places._Local.install

    def full(store: Any, folder: Path, name: str) -> None:
        if name.endswith("one"):
            raise OutputError("The output cannot be written: the disk is full", where=name, hint="Make room there.")
        install(store, folder, name)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(places._Local, "install", full)
        fleet = batch(manifest, tmp_path / "out", jobs=2)
    assert statuses(fleet) == {"one": "disk", "two": "short"}
    assert fleet.code == 2
    assert set(runs(manifest, tmp_path / "out", resume=True)) == {"one"}


@pytest.mark.slow
def test_the_command_line(tmp_path: Path, inputs: Path) -> None:
    manifest = write_manifest(tmp_path, [*TWO, {"cad": "in/empty.step"}])
    dry = console("batch", manifest, "--out", "out", "--dry-run", cwd=tmp_path)
    assert dry.returncode == 0, dry.stderr
    assert "3 of 3 would be run" in dry.stdout
    first = console("batch", manifest, "--out", "out", "--shard", "1/2", cwd=tmp_path)
    assert first.returncode == 2
    lines = first.stderr.strip().splitlines()
    assert len(lines) == 2
    assert any("one" in line and "not ready" in line for line in lines)
    assert any("refused: The CAD file is empty" in line for line in lines)
    second = console("batch", manifest, "--out", "out", "--resume", "--json", cwd=tmp_path)
    assert second.returncode == 2
    document = json.loads(second.stdout)
    assert document["counts"] == {"refused": 1, "short": 2}
    assert document["run"] == 1


def test_a_manifest_that_cannot_be_used_leaves_nothing(tmp_path: Path) -> None:
    (tmp_path / "fleet.json").write_text('{"machines": [{"cad": "a.step"}]}')
    done = console("batch", "fleet.json", "--out", "out", cwd=tmp_path)
    assert done.returncode == 2
    assert "'type' is missing" in done.stderr
    assert "machines[1]" in done.stderr
    assert not (tmp_path / "out").exists()
    lost = console("batch", "fleet.json", "--out", "out", "--address", "x:1", cwd=tmp_path)
    assert "--engine ray" in lost.stderr


def test_a_key_is_of_bytes_and_options_and_not_of_places_in_the_manifest(tmp_path: Path) -> None:
    cad = tmp_path / "a.step"
    cad.write_text("ISO-10303-21;")
    plain = Item("a", "wheel_loader", str(cad))
    key = Keys().of(plain)
    assert key == Keys().of(Item("b", "wheel_loader", str(cad), where="elsewhere", timeout_s=1.0, memory_mb=1))
    assert key != Keys().of(Item("a", "wheel_loader", str(cad), mirror=True))
    cad.write_text("ISO-10303-21; ")
    assert key != Keys().of(plain)
    cad.unlink()
    assert key != Keys().of(plain)


def test_a_store_is_whole_or_absent(tmp_path: Path) -> None:
    store = store_at(tmp_path / "out")
    for text in ("first", "second"):
        made = store.staging() / staged("a") / "new"
        made.mkdir(parents=True)
        (made / "item.json").write_text(text)
        (made / text).touch()
        store.install(made, "items/a")
        store.clear(["a"])
    assert sorted(path.name for path in (tmp_path / "out" / "items" / "a").iterdir()) == ["item.json", "second"]
    assert store.read("items/a/item.json") == b"second"
    assert store.read("items/b/item.json") is None
    (tmp_path / "file").touch()
    with pytest.raises(OutputError):
        store_at(tmp_path / "file")


def test_what_a_batch_needs_is_not_loaded_before(root: Path) -> None:
    modules = "('ray', 'pyarrow', 'fsspec', 'yaml')"
    code = f"import yellowiron.cli, yellowiron.fleet, sys; print([m for m in {modules} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment(root))
    assert done.stdout.strip() == "[]", done.stderr


@pytest.mark.slow
def test_a_manifest_asks_for_engines_and_variants(tmp_path: Path, inputs: Path) -> None:
    said = {"parameters": {"mass": {"vary": "mass", "each": True, "factor": {"uniform": [0.9, 1.1]}}}}
    (inputs / "variants.json").write_text(json.dumps(said))
    asked = {"engines": ["mujoco"], "variants": {"file": "in/variants.json", "count": 3, "seed": 5}}
    other = {**TWO[1], "variants": {"file": "in/no.json", "count": 1}}
    manifest = write_manifest(tmp_path, [{**TWO[0], **asked}, other])
    fleet = batch(manifest, tmp_path / "out", jobs=2)
    rows = {row["id"]: row for row in fleet.rows}
    assert rows["one"]["status"] == "short"
    assert rows["one"]["engines"] == ["mujoco"]
    assert rows["one"]["variants"] == 3
    folder = tmp_path / "out" / "items" / "one" / "variants"
    assert len(list((folder / "variants").glob("*.usdc"))) == 3
    assert (folder / "base" / "small.usda").is_file()
    assert (rows["two"]["status"], rows["two"]["message"][:27]) == ("refused", "The file of variants cannot")
    assert not (tmp_path / "out" / "items" / "two" / "machine").exists()
