"""Every command answers `--json` with one document and nothing else."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest

from kit.builds import console
from yellowiron.cli import app
from yellowiron.cli.telling import progress_shown, telling
from yellowiron.library.type_folders import library_folder
from yellowiron.model.errors import YellowironError

pytestmark = pytest.mark.usefixtures("cad_read_once")


def _asked(capsys: pytest.CaptureFixture[str], *words: str | Path) -> tuple[int, Any]:
    code = app([*map(str, words), "--json"], standalone_mode=False)
    printed = capsys.readouterr()
    assert printed.err == ""
    return code or 0, json.loads(printed.out)


def test_templates_list_and_show(capsys: pytest.CaptureFixture[str]) -> None:
    code, listed = _asked(capsys, "templates", "list")
    assert code == 0 and "wheel_loader" in listed["templates"]
    code, shown = _asked(capsys, "templates", "show", "wheel_loader")
    assert code == 0 and shown["equipment_type"] == "wheel_loader" and shown["root"] == "rear_frame"
    assert {"boom", "boom_pin"} <= {role["name"] for role in shown["roles"]}
    assert shown["modules"]["boom"] == {"module": "hinge", "on": "front_frame", "body": "boom"}
    assert "rocker" in listed["modules"]["z_bar"]


def test_a_new_template_without_a_cad_model(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    words = ("--with", "hinge:on=base,body=arm", "--with", "cylinder:name=lift,from=base,to=arm,stroke=S,actuator=lift")
    code, made = _asked(capsys, "templates", "new", "lifter", *words, "--out", tmp_path / "lifter")
    assert code == 0 and [m["computed"] for m in made["mobility"]] == [1]
    assert (tmp_path / "lifter" / "modules.json").is_file() and set(made["modules"]) == {"hinge", "cylinder"}
    with pytest.raises(YellowironError, match="proposed from a CAD model, or begun"):
        app(["templates", "new", "lifter", "--from", "a.step"], standalone_mode=False)


def test_a_copy_says_where_it_is(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    code, copied = _asked(capsys, "templates", "copy", "wheel_loader", tmp_path / "mine")
    assert code == 0 and (Path(copied["folder"]) / "joints.json").is_file()


def test_a_copy_that_has_no_joints_is_not_promised_to_build(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    bare = tmp_path / "bare"
    bare.mkdir()
    shutil.copy(library_folder() / "mobile_crane" / "wanted.json", bare)
    assert not app(["templates", "copy", str(bare), str(tmp_path / "mine")], standalone_mode=False)
    said = capsys.readouterr().out
    assert "build with it" not in said and "yellowiron extract" in said
    code, copied = _asked(capsys, "templates", "copy", bare, tmp_path / "other")
    assert code == 0 and copied["sheet_only"] is True


@pytest.mark.slow
@pytest.mark.parametrize("sent", [signal.SIGHUP, signal.SIGTERM, signal.SIGINT])
def test_a_closed_terminal_leaves_nothing_behind(example: Path, tmp_path: Path, sent: signal.Signals) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, "-m", "yellowiron", "build", "wheel_loader", "--cad", example / "wheel_loader.step"]
    # Tests that run under nohup would hand its deafness on.
    ours = subprocess.Popen([*command, "--out", tmp_path / "out" / "loader"], env=environment,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                            preexec_fn=lambda: signal.signal(sent, signal.SIG_DFL))  # fmt: skip
    try:
        end = time.monotonic() + 60.0
        while not list(tmp_path.glob("out/.*/new")):
            assert time.monotonic() < end and ours.poll() is None
            time.sleep(0.02)
        ours.send_signal(sent)
        assert ours.wait(60.0) == 128 + sent
        assert list(tmp_path.iterdir()) == []
    finally:
        ours.kill()
        ours.wait()


def _shell(*words: str, **more: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p), **more}
    return subprocess.run([sys.executable, "-m", "yellowiron", *words], env=environment, capture_output=True, text=True)


@pytest.mark.parametrize("group", [(), ("build",), ("templates",), ("templates", "new"), ("align",)])
def test_help_is_a_letter_away(group: tuple[str, ...], tmp_path: Path) -> None:
    short, long = (console(*group, option, cwd=tmp_path) for option in ("-h", "--help"))
    assert short.returncode == 0 and "Usage: yellowiron" in short.stdout
    assert short.stdout == long.stdout


def test_a_shell_completes_commands_and_types() -> None:
    for typed, found in (("yellowiron ex", {"extract", "export"}), ("yellowiron build excav", {"excavator"})):
        more = {"_YELLOWIRON_COMPLETE": "complete_bash", "COMP_WORDS": typed, "COMP_CWORD": str(typed.count(" "))}
        assert set(_shell(**more).stdout.split()) == found


@pytest.mark.parametrize(
    ("words", "where"),
    [(("templates", "show", "nope"), "nope"), (("build",), "yellowiron build"), (("measure", "no.usd"), "no.usd")],
)
def test_an_error_is_one_document_where_json_is_asked_for(words: tuple[str, ...], where: str, tmp_path: Path) -> None:
    told = console(*words, "--json", cwd=tmp_path)
    assert told.returncode == 2 and told.stderr == ""
    error = json.loads(told.stdout)["error"]
    assert set(error) == {"message", "where", "hint"} and all(error.values())
    assert error["where"] == where
    plain = console(*words, cwd=tmp_path)
    assert plain.stdout == "" and error["message"] in plain.stderr


def test_steps_are_plain_lines_in_a_pipe(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def check(file: Path, *, machine: Path | None = None) -> tuple[()]:
        return ()

    monkeypatch.setattr("yellowiron.api.check", check)
    told = console("check", "a.usd", cwd=tmp_path)
    assert re.fullmatch(r"Checking the file +\d+\.\d s\n", told.stderr)
    # What all commands take stands before the command as well as behind it.
    for words in (("check", "a.usd", "-q"), ("-q", "check", "a.usd"), ("--quiet", "check", "a.usd")):
        silent = console(*words, cwd=tmp_path)
        assert (silent.returncode, silent.stdout, silent.stderr) == (0, "", "")
    for words in (("check", "a.usd", "--json", "--verbose"), ("--json", "-v", "check", "a.usd"),
                  ("--json", "check", "a.usd", "-v")):  # fmt: skip
        both = console(*words, cwd=tmp_path)
        assert json.loads(both.stdout) == {"findings": []} and "Checking the file" in both.stderr
    assert "Checking the file" in console("check", "a.usd", cwd=tmp_path).stderr


@pytest.mark.parametrize(("verbose", "lines"), [(False, 2), (True, 4)])
def test_steps_that_differ_in_a_number_are_one(capsys: pytest.CaptureFixture[str], verbose: bool, lines: int) -> None:
    telling(as_json=False, quiet=False, verbose=verbose)
    with progress_shown() as progress:
        for page in (1, 2, 3):
            progress(f"Reading page {page} of 3 of sheet.pdf")
        progress("Writing USD")
    telling(as_json=False, quiet=False, verbose=False)
    told = capsys.readouterr()
    assert told.out == "" and len(told.err.splitlines()) == lines and "\x1b" not in told.err


@pytest.mark.slow
def test_convert_counts_what_it_wrote(capsys: pytest.CaptureFixture[str], tmp_path: Path, example: Path) -> None:
    file = tmp_path / "loader.usdc"
    code, converted = _asked(capsys, "convert", example / "wheel_loader.step", "--out", file)
    assert code == 0 and file.is_file()
    assert converted["parts"] > converted["shapes"] > 0


@pytest.mark.slow
def test_align_explains_a_role(capsys: pytest.CaptureFixture[str], example: Path) -> None:
    code, explained = _asked(capsys, "align", "wheel_loader", example / "wheel_loader.step", "--explain", "boom_pin")
    assert code == 0 and explained["explain"] == "boom_pin"
    assert "coaxial" in explained["reason"]


@pytest.mark.slow
def test_align_checks_the_scale_by_the_sheet(capsys: pytest.CaptureFixture[str], example: Path) -> None:
    """A length that no pose explains is told."""
    cad = example / "wheel_loader.step"
    _, aligned = _asked(capsys, "align", "wheel_loader", cad, "--set", "Overall Length=23 m")
    assert [f["severity"] for f in aligned["findings"] if f["code"] == "ALN014"] == ["warning"]
    assert not aligned["missing"]


@pytest.mark.slow
def test_an_assembly_is_given_a_role_confirmed_and_forgotten(
    capsys: pytest.CaptureFixture[str], example: Path, tmp_path: Path
) -> None:
    """As a script does it: the file keeps what was decided, by whom and why."""
    file = tmp_path / "alignment.json"
    asked = ("align", "wheel_loader", example / "wheel_loader.step", "--out", file, "--by", "Ann")
    _asked(capsys, *asked, "--set-role", "CAB ASSY ROPS/GLASS=none", "--why", "not ours")
    kept = json.loads(file.read_text(encoding="utf-8"))
    rule = kept["rules"][0]
    assert (rule["pattern"], rule["role"], rule["by"], rule["why"]) == ("CAB ASSY ROPS/GLASS", None, "Ann", "not ours")
    _asked(capsys, *asked, "--confirm", "ROPS FRAME")
    kept = json.loads(file.read_text(encoding="utf-8"))
    confirmed = [p for p in kept["parts"] if p["source"] == "confirmed"]
    assert confirmed and all(p["body"] == "rear_frame" and p["by"] == "Ann" for p in confirmed)
    _asked(capsys, *asked, "--forget", "ROPS FRAME", "--forget", "CAB ASSY ROPS/GLASS")
    kept = json.loads(file.read_text(encoding="utf-8"))
    assert "rules" not in kept
    assert not {p["source"] for p in kept["parts"]} & {"edited", "confirmed", "rule"}


@pytest.mark.slow
def test_a_machine_is_said_to_face_the_other_way_and_built_so(
    capsys: pytest.CaptureFixture[str], example: Path, tmp_path: Path
) -> None:
    """What `align --machine` keeps, `build` takes; and takes no longer once it is forgotten."""
    cad, file = example / "wheel_loader.step", tmp_path / "alignment.json"
    asked = ("align", "wheel_loader", cad, "--out", file, "--by", "Ann")
    said = ("--machine", "Lift Cylinders=twin", "--machine", "forward=x", "--machine", "*_pin=absent")
    _, aligned = _asked(capsys, *asked, *said)
    assert "ALN028" in {f["code"] for f in aligned["findings"]}  # the arms are on the other side
    kept = json.loads(file.read_text(encoding="utf-8"))
    assert list(kept["machine"]) == ["lift_cylinders", "forward", "*_pin"]
    assert kept["machine"]["forward"]["by"] == "Ann"
    assert kept["frame"][0][0] > 0.99
    out = tmp_path / "machine"
    _asked(capsys, "build", "wheel_loader", "--cad", cad, "--out", out, "--alignment", file)
    built = json.loads((out / "alignment.json").read_text(encoding="utf-8"))
    assert built["machine"] == kept["machine"]
    assert json.loads((out / "report.json").read_text(encoding="utf-8"))["frame"][0][0] > 0.99
    _asked(capsys, *asked, "--forget", "forward", "--forget", "lift_cylinders", "--forget", "*_pin")
    kept = json.loads(file.read_text(encoding="utf-8"))
    assert "machine" not in kept
    assert kept["frame"][0][0] < -0.99


@pytest.mark.slow
def test_watch_builds_again_when_an_input_changes(example: Path, tmp_path: Path) -> None:
    model, out = tmp_path / "loader.step", tmp_path / "out"
    model.write_bytes((example / "wheel_loader.step").read_bytes())
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, "-m", "yellowiron", "build", "wheel_loader", "--cad", model, "--out", out, "--watch"]
    said = tmp_path / "said"
    with said.open("w") as stream:
        ours = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=stream,
                                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # fmt: skip

    def wait_for(words: str, times: int) -> None:
        end = time.monotonic() + 120.0
        while said.read_text().count(words) < times:
            assert time.monotonic() < end and ours.poll() is None, said.read_text()
            time.sleep(0.1)

    try:
        wait_for("Watching", 1)
        # What it writes itself is no change; a decision is, and so is a model that is broken for a while.
        time.sleep(1.5)
        document = json.loads((out / "alignment.json").read_text())
        next(entry for entry in document["parts"] if entry["role"] == "boom")["role"] = "front_frame"
        (out / "alignment.json").write_text(json.dumps(document))
        wait_for("Watching", 2)
        assert [e["source"] for e in json.loads((out / "alignment.json").read_text())["parts"]].count("edited") == 1
        model.write_bytes(b"ISO-10303-21; nothing")
        wait_for("error:", 1)
        wait_for("Watching", 3)
        assert said.read_text().count("Changed: alignment.json") == 1
        assert said.read_text().count("Changed: loader.step") == 1
        ours.send_signal(signal.SIGINT)
        assert ours.wait(30.0) == 2
    finally:
        ours.kill()
        ours.wait()
