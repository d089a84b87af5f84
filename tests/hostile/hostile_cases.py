"""The table of hostile and odd inputs: a line each. `{here}` is an empty folder of the case's own, `{small}` that of
the smallest machine (`small.glb`, `type`); neither may have anything new in it afterwards."""

from __future__ import annotations

import json
import os
import shlex
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from kit.small import HIERARCHY, JOINTS, write_type

Make = Callable[[Path], object]


@dataclass(frozen=True)
class Case:
    """What is typed, what lies there, and a word that the answer has. Exit code 2 and one sentence, where and hint."""

    group: str
    name: str
    command: str
    word: str
    make: Make = lambda here: None

    def words(self, here: Path, small: Path) -> list[str]:
        """The command line's words."""
        return [word.replace("{here}", str(here)).replace("{small}", str(small)) for word in shlex.split(self.command)]


BUILD = "build {small}/type --cad {small}/small.glb --out {here}/out"
OWN = "templates check {here}/type"


def text(name: str, content: str) -> Make:
    return lambda here: (here / name).write_text(content, encoding="utf-8")


def large(name: str, size: int, head: bytes = b"") -> Make:
    """A file of some size that takes no room on the disk."""

    def make(here: Path) -> None:
        (here / name).write_bytes(head)
        os.truncate(here / name, size)

    return make


def pipe(name: str) -> Make:
    return lambda here: os.mkfifo(here / name)


def joint(**entries: object) -> Make:
    """The small machine's template with other words for its joint."""
    return lambda here: write_type(here / "type", joints={"hinge": {**JOINTS["hinge"], **entries}})


def joints(content: object) -> Make:
    return lambda here: write_type(here / "type", joints=content)


def roles(content: object) -> Make:
    return lambda here: write_type(here / "type", hierarchy=content)


def frame(matrix: object) -> Make:
    return text("a.json", json.dumps({"parts": [], "frame": np.asarray(matrix).tolist()}))


def scaled(*factors: float) -> Make:
    return frame(np.diag((*factors, 1.0)))


def archive(name: str, claimed: int, members: int = 1) -> Make:
    """A zip archive whose table says that a member unpacks to so many bytes; what it has is a line."""

    def make(here: Path) -> None:
        with zipfile.ZipFile(here / name, "w") as file:
            for number in range(members):
                file.writestr(f"{number or ''}Document.xml", "<Document/>")
            for entry in file.infolist():
                entry.file_size = claimed

    return make


def crowded(here: Path) -> None:
    """A zip archive whose end says that its table of contents has 3 GB."""
    archive("a.3mf", 10)(here)
    data = bytearray((here / "a.3mf").read_bytes())
    at = data.rfind(b"PK\5\6")
    data[at + 12 : at + 16] = (3 * 1024**3).to_bytes(4, "little")
    (here / "a.3mf").write_bytes(data)


DEEP = "[" * 200_000
LONG = "b" * 10_000
NUMBER = "is no number that can be used"
NOT_WRITTEN = "is not a number as it is written here"
RIGID = "does more than turn and move"
USED = {"joint_type": "Revolute", "Body": ["frame", "pin"]}

CASES = (
    # -- endless or greedy input
    Case("input", "an alignment of 100 MB", BUILD + " --alignment {here}/a.json", "100 MB", large("a.json", 100 << 20)),
    Case("input", "a deep alignment", BUILD + " --alignment {here}/a.json", "too deep", text("a.json", DEEP)),
    Case("input", "a pipe for an alignment", BUILD + " --alignment {here}/a.json", "a pipe", pipe("a.json")),
    Case("input", "a device for an alignment", BUILD + " --alignment /dev/zero", "a device"),
    Case("input", "a pipe for CAD", "convert {here}/a.step --out {here}/a.usd", "a pipe", pipe("a.step")),
    Case("input", "a device for CAD", "convert /dev/zero --out {here}/a.usd", "a device"),
    Case("input", "a pipe for a sheet", "extract wheel_loader {here}/a.pdf", "a pipe", pipe("a.pdf")),
    Case("input", "a device for a sheet", "extract wheel_loader /dev/zero", "a device"),
    Case("input", "a sheet of 2 GB", "extract wheel_loader {here}/a.pdf", "512 MB",
         large("a.pdf", 2 << 30, b"%PDF-1.7")),
    Case("input", "CAD of 20 GB", "convert {here}/a.step --out {here}/a.usd", "4096 MB",
         large("a.step", 20 << 30, b"ISO-10303-21;")),
    Case("input", "a pipe for a document", BUILD + " --data {here}/a.json", "a pipe", pipe("a.json")),
    Case("input", "a document of 100 MB", BUILD + " --data {here}/a.json", "100 MB", large("a.json", 100 << 20)),
    Case("input", "a deep document", BUILD + " --data {here}/a.json", "too deep", text("a.json", DEEP)),
    Case("input", "a deep template", OWN, "too deep", joints(DEEP)),
    Case("input", "a deep hierarchy", OWN, "too deep", roles('{"a":{"child":' * 5000 + "{}" + "}}" * 5000)),
    Case("input", "a pipe for a template", "templates check {here}/a.json", "no equipment type", pipe("a.json")),
    Case("input", "a device for USD", "check /dev/zero", "no such file"),
    Case("input", "a pipe for USD", "check {here}/a.usda", "no such file", pipe("a.usda")),
    Case("input", "an archive of 6.5 GB", "convert {here}/a.fcstd --out {here}/a.usd", "unpacks to 6500 MB",
         archive("a.fcstd", 6500 << 20)),
    Case("input", "an archive of 100 times 65 MB", "convert {here}/a.3mf --out {here}/a.usd", "unpacks to 6500 MB",
         archive("a.3mf", 65 << 20, 100)),
    Case("input", "an archive of a million files", "convert {here}/a.3mf --out {here}/a.usd", "too many files",
         crowded),
    Case("input", "a limit of 1e308", OWN, NUMBER, joint(Limit=[0, 1e308])),
    Case("input", "a limit of 1e308 m", OWN, "that a machine can have", joint(Limit=["0 rad", "1e308 rad"])),
    # -- numbers that are none
    Case("numbers", "1e60", BUILD + ' --set "Arm Angle Up=1e60"', "has no unit"),
    Case("numbers", "1e60 deg", BUILD + ' --set "Arm Angle Up=1e60 deg"', "outside"),
    Case("numbers", "nan deg", BUILD + ' --set "Arm Angle Up=nan deg"', "not a number"),
    Case("numbers", "inf deg", BUILD + ' --set "Arm Angle Up=inf deg"', "not a number"),
    Case("numbers", "-400 deg", BUILD + ' --set "Arm Angle Up=-400 deg"', "from -360 ° to 360 °"),
    Case("numbers", "1,5 deg", BUILD + ' --set "Arm Angle Up=1,5 deg"', NOT_WRITTEN),
    Case("numbers", "Arabic digits", BUILD + ' --set "Arm Angle Up=٤٥ deg"', NOT_WRITTEN),
    Case("numbers", "a line break", BUILD + ' --set "Arm Angle Up=4\n5 deg"', "line break"),
    Case("numbers", "a zero byte's picture", BUILD + ' --set "Arm Angle Up=45\x1b[2J deg"', "cannot be seen"),
    Case("numbers", "NaN in a template", OWN, NUMBER, joints('{"h": {"joint_type": "Fixed", "Limit": [NaN, 1]}}')),
    Case("numbers", "infinity in a template", OWN, NUMBER, joints('{"h": {"Limit": [-Infinity, 1]}}')),
    Case("numbers", "1e999 in a template", OWN, NUMBER, joints('{"h": {"Limit": [0, 1e999]}}')),
    Case("numbers", "a number of 5000 digits", OWN, "", joints('{"h": {"Limit": [0, %s]}}' % ("9" * 5000))),
    Case("numbers", "nan as text in a template", OWN, "", joint(Limit=["nan deg", "10 deg"])),
    Case("numbers", "Arabic digits in a template", OWN, "not a number", joint(Limit=["0 deg", "٤٥ deg"])),
    Case("numbers", "NaN in a document", BUILD + " --data {here}/a.json", NUMBER,
         text("a.json", '{"frame": {"density": NaN}}')),
    Case("numbers", "a density of 1e300", BUILD + " --data {here}/a.json", "finite",
         text("a.json", '{"frame": {"density": "1e300 kg/m^3"}}')),
    Case("numbers", "a payload of nan", "simulate {small}/none.usda --engine mujoco --payload nan", "mass"),
    Case("numbers", "a time step of nan", "simulate {small}/none.usda --engine mujoco --dt nan", "time step"),
    Case("numbers", "a time step of infinity", "simulate {small}/none.usda --engine mujoco --dt inf", "time step"),
    Case("numbers", "a singular frame", BUILD + " --alignment {here}/a.json", RIGID, scaled(0.0, 0.0, 0.0)),
    Case("numbers", "a flat frame", BUILD + " --alignment {here}/a.json", RIGID, scaled(1.0, 1.0, 0.0)),
    Case("numbers", "a mirrored frame", BUILD + " --alignment {here}/a.json", RIGID, scaled(1.0, -1.0, 1.0)),
    Case("numbers", "a huge frame", BUILD + " --alignment {here}/a.json", RIGID, scaled(1e200, 1e200, 1e200)),
    Case("numbers", "a sheared frame", BUILD + " --alignment {here}/a.json", RIGID, frame(np.triu(np.ones((4, 4))))),
    Case("numbers", "a frame that is far away", BUILD + " --alignment {here}/a.json", "moves by more",
         frame([[1, 0, 0, 1e12], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])),
    Case("numbers", "a frame of NaN", BUILD + " --alignment {here}/a.json", "4 by 4", frame(np.full((4, 4), np.nan))),
    Case("numbers", "a joint without a name", OWN, "empty", joints({"": USED})),
    Case("numbers", "a joint named by blanks", OWN, "empty", joints({"  ": USED})),
    Case("numbers", "a joint of 10 000 letters", OWN, "10000 letters", joints({LONG: USED})),
    Case("numbers", "a body of 10 000 letters", OWN, "10000 letters", roles({LONG: {"rigid body": "Y"}})),
    Case("numbers", "a joint's name with a line break", OWN, "no name", joints({"a\nb": USED})),
    Case("numbers", "joints that differ in case", OWN, "there twice", joints({"hinge": USED, "HINGE": USED})),
    Case("numbers", "bodies that differ in case", OWN, "there twice", roles({**HIERARCHY, "ARM": {"rigid body": "Y"}})),
    Case("numbers", "a document's joint without a name", BUILD + " --data {here}/a.json", "empty",
         text("a.json", json.dumps({"": USED}))),
    # -- the console
    Case("console", "no such command", "frobnicate", "frobnicate"),
    Case("console", "no such option", "templates list --frob", "--frob"),
    Case("console", "a missing argument", "build", "TYPE"),
    Case("console", "a missing option", "build wheel_loader --cad x.step", "--out"),
    Case("console", "a choice that is none", "simulate a.usda --engine mujoco --base flying", "flying"),
    Case("console", "a number that is none", "simulate a.usda --engine mujoco --dt soon", "--dt"),
    Case("console", "an engine that is none", "simulate {small}/none.usda --engine bullet", "bullet"),
    Case("console", "a name with a line break", "convert '{here}/a\nb.step' --out {here}/a.usd", "no such CAD file"),
    Case("console", "a name of 5000 letters", f"convert {{here}}/{'a' * 5000}.step --out {{here}}/a.usd", ""),
    # -- places
    Case("places", "out where the CAD lies", "build {small}/type --cad {small}/small.glb --out {small}", "lies in"),
    Case("places", "out in the folder that is the CAD", "build {small}/type --cad {here} --out {here}/out", "lies in"),
    Case("places", "out where the sheet lies", BUILD.replace("{here}/out", "{here}") + " --specs {here}/a.pdf",
         "lies in", text("a.pdf", "%PDF-")),
    Case("places", "an export beside the machine", "export {here}/a.usda --to mjcf --out {here}", "lies in",
         text("a.usda", "#usda 1.0")),
    Case("places", "pictures beside the sheet", "extract wheel_loader {here}/a.pdf --show {here}", "lies in",
         text("a.pdf", "%PDF-")),
    Case("places", "a new template beside the CAD", "templates new --from {small}/small.glb --out {small}", "lies in"),
)  # fmt: skip
