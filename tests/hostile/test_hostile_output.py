"""Whole or absent, and one sentence, on every odd place to write to."""

from __future__ import annotations

import contextlib
import os
import resource
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from kit.builds import console
from kit.planted import PACKAGE
from yellowiron.model.errors import OutputError
from yellowiron.support.files import staging
from yellowiron.support.output import output_file, output_folder

FILES = {"a.txt": "new a", "payloads/b.txt": "new b", "payloads/deep/c.txt": "new c"}
OLD = {name: text.replace("new", "old") for name, text in FILES.items() if "deep" not in name}


def write(folder: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)


def held(folder: Path) -> dict[str, str]:
    """Every file in a folder, hidden ones too."""
    return {str(f.relative_to(folder)): f.read_text() for f in sorted(folder.rglob("*")) if f.is_file()}


def elsewhere() -> Path:
    """A folder on another file system than the tests'."""
    shared = Path("/dev/shm")
    if not shared.is_dir() or shared.stat().st_dev == Path.cwd().stat().st_dev or not os.access(shared, os.W_OK):
        pytest.skip("no second file system here")
    return shared


@contextlib.contextmanager
def immutable(place: Path) -> Iterator[None]:
    """A file or folder that not even root may change."""
    if shutil.which("chattr") is None or subprocess.run(["chattr", "+i", place], capture_output=True).returncode:
        pytest.skip("files cannot be made immutable here")
    try:
        yield
    finally:
        subprocess.run(["chattr", "-i", place], check=True)


def mounted(script: str, size: str, tmp_path: Path) -> subprocess.CompletedProcess[str]:
    """A script of Python's where `disk` is a mount point of a file system in memory, as in a container."""
    disk = tmp_path / "disk"
    disk.mkdir()
    probe = subprocess.run(["unshare", "-rm", "true"], capture_output=True) if shutil.which("unshare") else None
    if probe is None or probe.returncode:
        pytest.skip("no name spaces here: unshare -rm is not permitted")
    shell = f'mount -t tmpfs -o size={size} none {disk} && exec {sys.executable} -c "$SCRIPT"'
    environment = {**os.environ, "PYTHONPATH": str(PACKAGE.parent), "DISK": str(disk), "SCRIPT": SETUP + script}
    return subprocess.run(
        ["unshare", "-rm", "sh", "-c", shell],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=300,
    )


SETUP = """
import os, sys
from pathlib import Path
disk = Path(os.environ["DISK"])
def command(*words):
    import yellowiron.cli
    sys.argv = ["yellowiron", *map(str, words)]
    try:
        yellowiron.cli.main()
    except SystemExit as end:
        return end.code
def held():
    return sorted(p.name for p in disk.iterdir())
"""


def test_another_disk_behind_a_link(tmp_path: Path) -> None:
    far = elsewhere() / f"yellowiron-{os.getpid()}"
    far.mkdir()
    try:
        write(far, OLD)
        (tmp_path / "out").symlink_to(far)
        with output_folder(tmp_path / "out") as folder:
            write(folder, FILES)
        assert held(far) == FILES and (tmp_path / "out").is_symlink()
        with output_file(tmp_path / "out" / "d.txt") as file:
            file.write_text("new d")
        assert held(far) == {**FILES, "d.txt": "new d"}
    finally:
        shutil.rmtree(far)


@pytest.mark.parametrize("kind", ["folder", "file"])
@pytest.mark.parametrize("to", ["nothing", "itself", "a device"])
def test_links_that_lead_nowhere(kind: str, to: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.symlink_to({"nothing": tmp_path / "gone", "itself": out, "a device": Path("/dev/null")}[to])
    with pytest.raises(OutputError) as caught, (output_folder if kind == "folder" else output_file)(out):
        raise AssertionError("the block must not run")
    assert caught.value.hint and caught.value.where == str(out)
    assert list(tmp_path.iterdir()) == [out]


def test_a_linked_folder_inside_is_refused_and_nothing_is_changed(tmp_path: Path) -> None:
    out, other = tmp_path / "out", tmp_path / "other"
    other.mkdir()
    write(out, {"a.txt": "old a"})
    (out / "payloads").symlink_to(other)
    with pytest.raises(OutputError, match="There is a link where a folder") as caught, output_folder(out) as folder:
        write(folder, FILES)
    assert caught.value.where == str(out / "payloads")
    assert held(out) == {"a.txt": "old a"} and list(other.iterdir()) == []


@pytest.mark.parametrize("kept", ["a.txt", "payloads/b.txt", "payloads"])
def test_what_may_not_be_changed_keeps_everything(kept: str, tmp_path: Path) -> None:
    out = tmp_path / "out"
    write(out, OLD)
    with immutable(out / kept):
        with pytest.raises(OutputError, match="cannot be written") as caught, output_folder(out) as folder:
            write(folder, FILES)
        assert caught.value.hint
    assert held(out) == OLD
    assert not (out / "payloads" / "deep").exists()


def test_a_parent_that_is_read_only(tmp_path: Path) -> None:
    (tmp_path / "up" / "out").mkdir(parents=True)
    with immutable(tmp_path / "up"):
        with output_folder(tmp_path / "up" / "out") as folder:
            write(folder, FILES)
        with pytest.raises(OutputError), output_folder(tmp_path / "up" / "other"):
            raise AssertionError("the block must not run")
    assert held(tmp_path / "up" / "out") == FILES


def test_parents_that_were_made_go_again(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), output_folder(tmp_path / "a" / "b" / "out"):
        raise ZeroDivisionError
    assert list(tmp_path.iterdir()) == []


def test_the_size_of_files_is_limited(tmp_path: Path, small: Path) -> None:
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    try:
        done = console("templates", "copy", "wheel_loader", tmp_path / "copy", cwd=tmp_path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert done.returncode == 2 and "larger than this process may write" in done.stderr
    assert "ulimit" in done.stderr and list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_mount_point(tmp_path: Path) -> None:
    done = mounted('sys.exit(command("templates", "copy", "wheel_loader", disk) or len(held()) < 8)', "10m", tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("size", [pytest.param("16k", marks=pytest.mark.slow), "64k"])
def test_a_full_disk(size: str, tmp_path: Path) -> None:
    done = mounted('print(command("templates", "copy", "wheel_loader", disk), held())', size, tmp_path)
    assert done.stdout == "2 []\n" and "the disk is full" in done.stderr, done.stdout + done.stderr


@pytest.mark.slow
def test_builds_on_disks(tmp_path: Path, small: Path) -> None:
    """Of a disk's own root, and of a folder in it; an earlier result stays where the new one has no room."""
    script = f"""
import subprocess, yellowiron.report
yellowiron.report.page = lambda *_, **__: "x" * 150_000
for size, inside in (("64k", "out"), ("128k", ""), ("10m", "")):
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={{size}}", "none", disk], check=True)
    out = disk / inside
    words = ["build", {str(small / "type")!r}, "--cad", {str(small / "small.glb")!r}, "--out", out,
             "--set", "Arm Angle Up=40 deg", "--set", "Arm Angle Down=10 deg"]
    out.mkdir(exist_ok=True)
    (out / "notes.txt").write_text("mine")
    print(command(*words), sorted(p.name for p in out.iterdir()))
"""
    done = mounted(script, "1m", tmp_path)
    said = [line for line in done.stdout.splitlines() if line.endswith("]")]
    assert "Traceback" not in done.stderr, done.stderr
    assert said[:2] == ["2 ['notes.txt']"] * 2 and done.stderr.count("the disk is full") == 2, done.stdout + done.stderr
    assert said[2].startswith("1 ['alignment.json'"), done.stdout + done.stderr


def killed_before(step: int, out: Path) -> bool:
    """Writes into a folder in a process that is killed before its so-manieth call of the system's that changes
    something; whether it had fewer, and came to its end."""
    child = os.fork()
    if child:
        return os.waitpid(child, 0)[1] == 0
    left = step

    def counted(real: Callable[..., object]) -> Callable[..., object]:
        def call(*words: object, **more: object) -> object:
            nonlocal left
            left -= 1
            if left < 0:
                os.kill(os.getpid(), signal.SIGKILL)
            return real(*words, **more)

        return call

    try:
        for name in ("link", "rename", "replace", "mkdir", "unlink", "rmdir"):
            setattr(os, name, counted(getattr(os, name)))
        with output_folder(out) as folder:
            write(folder, FILES)
        os._exit(0)
    finally:
        os._exit(1)


@pytest.mark.slow
def test_killed_at_every_step(tmp_path: Path) -> None:
    """Whatever call of the system's a kill comes before, the next who writes there finds the old result or the new."""
    ends, done = set(), False
    for step in range(100):
        out = tmp_path / f"out{step}"
        write(out, {**OLD, "notes.txt": "mine"})
        done = killed_before(step, out)
        staging._YOUNG, young = -1.0, staging._YOUNG
        try:
            staging.recover(out)
        finally:
            staging._YOUNG = young
        found = held(out)
        assert found.pop("notes.txt") == "mine"
        assert found in (OLD, FILES), step
        ends.add(found == FILES)
        if done:
            break
    assert done and ends == {False, True} and step > 20


def test_a_running_build_s_files_are_left_alone(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    with output_folder(out) as one:
        (one / "a.txt").write_text("one")
        with output_folder(out) as two:
            (two / "b.txt").write_text("two")
        assert (one / "a.txt").exists()
    assert held(out) == {"a.txt": "one", "b.txt": "two"}


@pytest.mark.parametrize("failing", [0, 1, 2])
def test_a_failure_while_files_are_moved_puts_all_back(
    failing: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real, seen = staging._move, list[Path]()

    def move(new: Path, place: Path) -> None:
        seen.append(place)
        if len(seen) > failing:
            raise OSError(5, "Input/output error")
        real(new, place)

    monkeypatch.setattr(staging, "_move", move)
    write(tmp_path / "out", OLD)
    with pytest.raises(OutputError, match="does not take it"), output_folder(tmp_path / "out") as folder:
        write(folder, FILES)
    assert held(tmp_path / "out") == OLD
