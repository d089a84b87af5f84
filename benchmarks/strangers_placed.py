"""Where the meshes of a stranger's model are, by its robot description, scene or assembly; for `strangers_build.py`.

Each function yields names, meshes and places (4 x 4, in the source's own unit and frame) as drawn: joints at 0.
"""

from __future__ import annotations

import hashlib
import re
import subprocess
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation

from yellowiron.cad import read_cad


class BuildError(Exception):
    """A file or a model is not what its label says."""


@dataclass(frozen=True)
class Snapshot:
    """A repository at a commit."""

    git: Path
    commit: str

    def show(self, path: str, commit: str = "") -> bytes:
        return self._git("show", f"{commit or self.commit}:{path}")

    def file(self, path: str, sha256: str) -> bytes:
        """A file with this hash at a path, or at that path below some folder."""
        listed = self._git("ls-tree", "-r", "-z", "--name-only", self.commit).decode().split("\0")
        for found in (p for p in listed if p == path or p.endswith(f"/{path}")):
            content = self.show(found)
            if hashlib.sha256(content).hexdigest() == sha256:
                return content
        raise BuildError(f"{path} is not in {self.git}, or is another file there")

    def _git(self, *words: str) -> bytes:
        done = subprocess.run(["git", "--git-dir", str(self.git), *words], capture_output=True, check=False)
        if done.returncode:
            raise BuildError(done.stderr.decode().strip())
        return done.stdout


@dataclass(frozen=True)
class Job:
    """A model to build: its source files in `folder`, and what it becomes."""

    name: str
    snapshot: Snapshot
    folder: Path
    files: tuple[Path, ...]
    models: Path
    blender: str | None

    @property
    def glb(self) -> Path:
        return self.models / f"{self.name}.glb"

    def file(self, name: str) -> Path:
        """The one source file of this name or suffix."""
        (found,) = (f for f in self.files if name in (f.name, f.suffix))
        return found


Placed = Iterator[tuple[str, trimesh.Trimesh, np.ndarray]]
FACES = {
    "TRI3": ((0, 1, 2),),
    "QUAD4": ((0, 1, 2), (0, 2, 3)),
    "TET4": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
}
"""The triangles of a finite element, by its corners."""


def mjcf(job: Job) -> Placed:
    """Meshes by an MJCF's body tree as drawn."""
    root = ET.parse(job.file(".xml")).getroot()
    files = {f.stem: f for f in job.files if f.suffix != ".xml"}
    turns = {Path(m.get("file", "")).stem: _numbers(m.get("refquat"), "1 0 0 0") for m in root.iter("mesh")}

    def walk(body: ET.Element, frame: np.ndarray) -> Placed:
        for name in (g.get("mesh", "") for g in body.findall("geom")):
            if name in files:
                own = Rotation.from_quat(turns[name], scalar_first=True).inv()
                yield name, _mesh(files[name]), frame @ _place(own, (0.0, 0.0, 0.0))
        for child in body.findall("body"):
            turn = Rotation.from_euler("XYZ", _numbers(child.get("euler"), "0 0 0"), degrees=True)
            yield from walk(child, frame @ _place(turn, _numbers(child.get("pos"), "0 0 0")))

    world = root.find("worldbody")
    assert world is not None
    return walk(world, np.eye(4))


def urdf(job: Job, description: str = ".urdf") -> Placed:
    """Meshes by a robot description with all joints at 0; a mesh that two links have is named by link, and last; the
    parts of a DAE file by themselves. Meshes that are not among the files (too large for the snapshot) are left out;
    the collision mesh stands for what is seen where only that is there."""
    there = {f.name for f in job.files}
    document = ET.fromstring(_expanded(job.file(description).read_text(encoding="utf-8")))
    root = max(document.iter(), key=lambda e: len(e.findall("link")))  # a macro, where one holds them all
    joints = root.findall("joint")
    frames = dict.fromkeys({j.find("parent").get("link") for j in joints}, np.eye(4))
    waiting = {j.find("child").get("link"): j for j in joints}
    while waiting:
        for link, joint in list(waiting.items()):
            parent = joint.find("parent").get("link")
            if parent not in waiting:
                frames[link] = frames[parent] @ _origin(joint.find("origin"))
                del waiting[link]
    visuals = [
        (
            link.get("name"),
            _origin(visual.find("origin")) @ np.diag([*_numbers(mesh.get("scale"), "1 1 1"), 1.0]),
            Path(mesh.get("filename")).name,
        )
        for link in root.findall("link")
        for visual in (*link.findall("visual"), *link.findall("collision"))
        for mesh in visual.findall("geometry/mesh")
        if Path(mesh.get("filename")).name in there
    ]
    visuals = [v for k, v in enumerate(visuals) if v[::2] not in [u[::2] for u in visuals[:k]]]
    uses = Counter(file for _, _, file in visuals)
    for link, origin, file in sorted(visuals, key=lambda visual: uses[visual[2]]):
        name = link if uses[file] > 1 else Path(file).stem.removesuffix("_co2")
        for piece, mesh in _pieces(job.file(file), name):
            mesh.apply_transform(frames[link] @ origin)
            yield piece, mesh, np.eye(4)


def page(job: Job) -> Placed:
    """The meshes of a web page's excavator, each where the page's hinges and offsets put it as it starts; Y up. Left
    out is what the page hides, and the track, which it lays out as it runs. Cylinders point at each other, as there."""
    read = read_cad(job.file(".glb"))
    hover = np.zeros(3)
    cabin = hover + np.array((1.6, 3.0, 0.0)) - np.array((2.5, -4.5, -0.5))
    boom = cabin + np.array((0.0, 0.5, -1.4)) - np.array((12.2, -9.15, 0.0))
    arm = boom + np.array((-16.0, 7.0, 0.0)) - np.array((0.0, 7.0, 0.0))
    bucket = arm + np.array((-0.2, -7.0, 0.0))
    head = bucket + np.array((-0.80602, -2.24358, 0.0283))
    offsets = {
        "cabin_hover": (hover, (0.0, 0.0, 0.0)),
        "cabin": (cabin, (0.0, 0.0, 0.0)),
        "arm_inferior": (boom, (0.0, 0.0, 0.0)),
        "arm_superior": (arm, (0.0, 0.0, 0.0)),
        "pa": (bucket, (0.0, 0.0, 0.0)),
        "lr_pistons": (cabin, (-3.87885, -3.47168, -1.21427)),
        "lr_pistons_h": (boom, (2.74203, 3.08933, -0.11181)),
        "tp_piston": (boom, (-1.14309, 5.9, 0.1926)),
        "tp_piston_h": (arm, (-0.82789, 11.52722, 0.01848)),
        "sup_pist": (arm, (-2.72146, 5.86068, 0.07616)),
        "sup_piston_head": (head, (0.0, 0.0, 0.0)),
        "sup_piston_head_base": (head, (0.0, 0.0, 0.0)),
        "eng_di_esq": (hover, (-9.0, -0.6, 6.9)),
        "eng_tr_dir": (hover, (9.6, -0.6, 6.9)),
        "eng_di_dir": (hover, (-9.0, -0.6, -6.9)),
        "eng_tr_esq": (hover, (9.6, -0.6, -6.9)),
    }
    places = {name: beside + np.array(by) for name, (beside, by) in offsets.items()}
    aims = {
        "lr_pistons": ("lr_pistons_h", -1.0), "lr_pistons_h": ("lr_pistons", 1.0), "tp_piston": ("tp_piston_h", -1.0),
        "tp_piston_h": ("tp_piston", 1.0), "sup_pist": ("sup_piston_head", -1.0j),
        "sup_piston_head_base": ("sup_pist", 1.0j),
    }  # fmt: skip
    for part in read.parts:
        if part.name not in places:
            continue
        turn = np.eye(3)
        if part.name in aims:
            target, own = aims[part.name]
            way = complex(*(places[target] - places[part.name])[:2]) / own
            way /= abs(way)
            turn[:2, :2] = (way.real, -way.imag), (way.imag, way.real)
        shape = read.shape_of(part).mesh
        frame = np.eye(4)
        frame[:3, :3], frame[:3, 3] = turn, places[part.name]
        yield part.name, trimesh.Trimesh(shape.points, shape.triangles, process=False), frame


def xacro(job: Job) -> Placed:
    """As `urdf`; those here have no macros."""
    return urdf(job, ".xacro")


def _expanded(description: str) -> str:
    """A robot description with its properties, and products of numbers and pi, put in."""
    values: dict[str, str] = dict(re.findall(r'<xacro:property name="(\w+)" value="([^"]*)"', description))

    def value(found: re.Match[str]) -> str:
        if re.fullmatch(r"-?[\d.]*(pi)?( *[*/] *([\d.]+|pi))*", found[1]):
            product = 1.0
            for sign, minus, word in re.findall(r"([*/]?) *(-?)([\d.]+|pi)", found[1]):
                factor = np.pi if word == "pi" else float(word)
                product *= (-1.0 if minus else 1.0) * (1.0 / factor if sign == "/" else factor)
            return str(product)
        return values.get(found[1], found[0])

    return re.sub(r"\$\{([^}]*)\}", value, description)


def ftl(job: Job) -> Placed:
    """The surfaces of a FEDEM model's parts, each in its own coordinate system."""
    model = job.file(".fmm").read_text(encoding="latin-1")
    for part in re.findall(r"^PART\n\{(.*?)^\}", model, re.MULTILINE | re.DOTALL):
        (file,) = re.findall(r'BASE_FTL_FILE = "([^"]+)"', part)
        (rows,) = re.findall(r"^COORDINATE_SYSTEM = \n([^;]*);", part, re.MULTILINE)
        content = job.file(file).read_text(encoding="latin-1")
        nodes = {n: p.split() for n, p in re.findall(r"^NODE\{(\d+) \S+ ([^}\n]*)", content, re.MULTILINE)}
        number = {node: k for k, node in enumerate(nodes)}
        faces: list[tuple[int, ...]] = []
        for kind, words in re.findall(r"^(TRI3|QUAD4|TET4)\{\d+((?: \d+)+)", content, re.MULTILINE):
            corners = [number[word] for word in words.split()]
            faces += [tuple(corners[k] for k in face) for face in FACES[kind]]
        uses = Counter(frozenset(face) for face in faces)
        mesh = trimesh.Trimesh(
            np.array([p[:3] for p in nodes.values()], dtype=np.float64),
            [face for face in faces if uses[frozenset(face)] == 1],
            process=False,
        )
        yield Path(file).stem, mesh, np.vstack([_numbers(rows, "").reshape(3, 4), (0, 0, 0, 1)])


def templates(job: Job) -> Placed:
    """OBJ meshes by the object templates of a game engine's XML files, the first of the first file placed; Y up.

    What is attached to its parent is told in the parent's frame, else in the world's; what looks at another object has
    its Y axis turned to it, about X."""
    xml = [ET.parse(f).getroot() for f in job.files if f.suffix == ".template"]
    known = {t.find("Name").get("value"): t for root in xml for t in root.iter("SceneObjectTemplate")}
    placed: dict[str, dict[str, Any]] = {}

    def add(template: Any, parent: str) -> None:
        line = [template]
        while (inherited := line[-1].find("Inheritance")) is not None:
            line.append(known[inherited.get("value")])

        def told(path: str) -> str:
            return next((e.get("value") for t in line if (e := t.find(path)) is not None), "")

        name, location = told("ID"), "Components/LocationComponent/"
        placed[name] = {
            "file": Path(told("Components/MeshComponent/Filename")).stem,
            "at": _numbers(told(location + "Position") or None, "0 0 0"),
            "parent": parent if told(location + "AttachToParent") == "true" else "",
            "looks": told("Components/LookAtComponent/LookAt"),
            "turn": np.eye(3),
        }
        for child in (c for t in line for c in t.findall("ComponentContainers/SceneObjectTemplate")):
            add(child, name)

    def place(name: str) -> np.ndarray:
        own, frame = placed[name], np.eye(4)
        parent = place(own["parent"]) if own["parent"] else np.eye(4)
        frame[:3, :3] = own["turn"] if own["looks"] else parent[:3, :3]
        frame[:3, 3] = parent[:3, :3] @ own["at"] + parent[:3, 3]
        return frame

    add(xml[0].find("SceneObjectTemplate"), "")
    looking = [name for name, own in placed.items() if own["looks"]]
    for name in looking * 30:  # where they look depends on where others do
        y = place(placed[name]["looks"])[:3, 3] - place(name)[:3, 3]
        y /= np.linalg.norm(y)
        x = np.eye(3)[0] - y[0] * y
        x /= np.linalg.norm(x)
        placed[name]["turn"] = np.column_stack([x, y, np.cross(x, y)])
    for name, own in placed.items():
        yield name, _mesh(job.file(f"{own['file']}.obj")), place(name)


def together(job: Job) -> Placed:
    """Meshes that lie in one frame already."""
    for file in job.files:
        yield file.stem, _mesh(file), np.eye(4)


def pinned(job: Job) -> Placed:
    """A mini excavator's files, whose own description has another machine's lengths, put together on the pins that they
    draw, each pin in a bore as wide; boom raised by 30 degrees, arm 30 off upright; Z up."""
    raised, hanging = (Rotation.from_euler("y", -degrees, degrees=True) for degrees in (30.0, 60.0))
    at = {"base": _place(Rotation.identity(), (0.0, 0.0, 0.0))}
    at["upper-structure"] = at["base"] @ _place(Rotation.identity(), (0.0, 0.0, 0.6045))
    at["boom"] = at["upper-structure"] @ _place(raised, (0.933, -0.1342, 0.322))
    at["arm"] = at["boom"] @ _place(raised.inv() * hanging, (2.5868, 0.0, -0.6255))
    at["bucket"] = at["arm"] @ _place(Rotation.identity(), (-1.363, 0.0, -0.1539))
    for file in job.files:
        read = read_cad(file)
        for part in read.parts:
            mesh = trimesh.Trimesh(read.points_of(part), read.shape_of(part).mesh.triangles, process=False)
            yield file.stem if len(read.parts) == 1 else f"{file.stem}_{part.name}", mesh, at[file.stem]


def picked(*names: str) -> Callable[[Job], Placed]:
    """The parts of these names of a file with several machines, as it is read."""

    def some(job: Job) -> Placed:
        assembly = read_cad(job.files[0])
        for part in assembly.parts:
            if part.name in names:
                faces = assembly.shape_of(part).mesh.triangles
                yield part.name, trimesh.Trimesh(assembly.points_of(part), faces, process=False), np.eye(4)

    return some


def prefab(job: Job) -> Placed:
    """OBJ meshes that a Unity prefab has instances of, each moved as it says; Y up. Unity mirrors X as it reads."""
    text = job.file(".prefab").read_text(encoding="utf-8")
    blocks = re.findall(r"^--- !u!(\d+) &(-?\d+)[^\n]*\n(.*?)(?=^--- |\Z)", text, re.MULTILINE | re.DOTALL)
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    above: dict[str, str] = {}
    local: dict[str, np.ndarray] = {}

    for kind, own, block in blocks:
        father = re.search(r"m_Father: \{fileID: (-?\d+)", block)
        if kind == "4" and father is not None:
            rows = re.findall(r"(m_Local\w+): \{([^}]*)\}", block)
            pairs = [(row, *pair.split(":")) for row, words in rows for pair in words.split(",")]
            local[own] = _moved({f"{row}.{key.strip()}": float(value) for row, key, value in pairs})
            above[own] = father[1]
    for kind, _, block in blocks:
        if kind != "1001":
            continue
        (source,) = re.findall(r"m_SourcePrefab: \{fileID: \d+, guid: (\w+)", block)
        files = [f for f in job.files if f.suffix == ".meta" and f"guid: {source}" in f.read_text(encoding="utf-8")]
        if not files:
            continue
        changes = re.findall(r"propertyPath: (m_Local(?:Pos|Rot|Sca)\S+)\s+value: (\S+)", block)
        frame, (at,) = (
            _moved({k: float(v) for k, v in changes}),
            re.findall(r"m_TransformParent: \{fileID: (-?\d+)", block),
        )
        while at in local:
            frame, at = local[at] @ frame, above[at]
        yield files[0].name.split(".")[0], _mesh(files[0].with_suffix("")), mirror @ frame @ mirror


def nested(job: Job) -> Placed:
    """FBX files of one mesh each that a Unity prefab has instances of, one below another; Y up. The files' unit is a
    metre there; a mesh is turned as its own node is not, since the instance's turn replaces the node's."""
    text = job.file(".prefab").read_text(encoding="utf-8")
    blocks = re.findall(r"^--- !u!(\d+) &(-?\d+)( stripped)?\n(.*?)(?=^--- |\Z)", text, re.MULTILINE | re.DOTALL)
    meta = [(f.read_text(encoding="utf-8"), f.with_suffix("")) for f in job.files if f.suffix == ".meta"]
    files = {re.findall(r"guid: (\w+)", told)[0]: file for told, file in meta}
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    upright = np.array([[100.0, 0, 0], [0, 0, -100.0], [0, 100.0, 0]])
    above: dict[str, str] = {}
    local: dict[str, np.ndarray] = {}
    meshes: dict[str, tuple[Path, str]] = {}
    for kind, own, stripped, block in blocks:
        if kind == "4" and stripped:
            (above[own],), local[own] = re.findall(r"m_PrefabInstance: \{fileID: (-?\d+)", block), np.eye(4)
        elif kind == "4":
            rows = re.findall(r"(m_Local\w+): \{([^}]*)\}", block)
            pairs = [(row, *pair.split(":")) for row, words in rows for pair in words.split(",")]
            local[own] = _moved({f"{row}.{key.strip()}": float(value) for row, key, value in pairs})
            (above[own],) = re.findall(r"m_Father: \{fileID: (-?\d+)", block)
        elif kind == "1001":
            changes = re.findall(r"propertyPath: (m_Local(?:Pos|Rot|Sca)\S+)\s+value: (\S+)", block)
            local[own] = _moved({key: float(value) for key, value in changes})
            (above[own],) = re.findall(r"m_TransformParent: \{fileID: (-?\d+)", block)
            (source,) = re.findall(r"m_SourcePrefab: \{fileID: \d+, guid: (\w+)", block)
            names = re.findall(r"propertyPath: m_Name\s+value: (.+)", block)
            meshes[own] = files[source], (names[0].strip() if names else files[source].stem)
    taken: Counter[str] = Counter()
    for own, (file, name) in meshes.items():
        frame, at = local[own], above[own]
        while at in local:
            frame, at = local[at] @ frame, above[at]
        taken[name] += 1
        read = read_cad(file)
        (part,) = read.parts
        mesh = trimesh.Trimesh(read.points_of(part) @ upright.T, read.shape_of(part).mesh.triangles, process=False)
        yield name if taken[name] == 1 else f"{name}_{taken[name]}", mesh, mirror @ frame @ mirror


def summed(job: Job) -> Placed:
    """Meshes by the joints' origins in a Python file that later commits no longer have."""
    code = job.snapshot.show("src/exca_dance/rendering/urdf_kin.py", "58dd8e6^").decode()
    origins = {"base_link": np.zeros(3)}
    joint = r'URDFJoint\(\s*"\w+",\s*"(\w+)",\s*"(\w+)",\s*"\w+",\s*\(([^)]*)\)'
    for parent, child, origin in re.findall(joint, code):
        origins[child] = origins[parent] + _numbers(origin.replace(",", " "), "")
    links = dict(re.findall(r'"(\w+)": "(\w+_link)"', code))
    for file in sorted(job.files):
        yield file.stem, _mesh(file), _place(Rotation.identity(), origins[links[file.stem]])


def instances(job: Job) -> Placed:
    """STEP files by the instances of a Simscape Multibody assembly."""
    for instance in ET.parse(job.file(".xml")).getroot().iterfind(".//{*}Instance"):
        name = instance.get("name", "").removesuffix(" <1>")
        turn, shift = (_numbers(instance.findtext(f"{{*}}Transform/{{*}}{w}"), "") for w in ("Rotation", "Translation"))
        assembly = read_cad(job.file(f"{name}.step"))
        meshes = [
            trimesh.Trimesh(assembly.points_of(p), assembly.shape_of(p).mesh.triangles, process=False)
            for p in assembly.parts
        ]
        place = np.eye(4)
        place[:3, :3], place[:3, 3] = turn.reshape(3, 3), shift
        yield name, trimesh.util.concatenate(meshes), place


def qml(job: Job) -> Placed:
    """Meshes of Qt Quick 3D by the nodes of a QML file, all of its own angles at 0; those absent are left out."""
    meshes = {f.name: f for f in job.files if f.suffix == ".mesh"}
    stack: list[dict[str, Any]] = [{"place": np.eye(4)}]
    for line in (words.strip() for words in job.file(".qml").read_text(encoding="utf-8").splitlines()):
        key, _, value = line.partition(": ")
        if line.endswith("{"):
            stack.append({"model": line == "Model {"})
        elif line == "}":
            stack.pop()
        elif key in ("position", "rotation", "scale") and "Qt." in value:
            stack[-1][key] = [float(v.split(" ")[0]) for v in value.partition("(")[2].rstrip(")").split(", ")]
        elif key in ("objectName", "source"):
            stack[-1][key] = value.strip('"')
        if (
            line.endswith("{")
            or "place" in stack[-1]
            or not ({"source", "position", "rotation", "scale"} & stack[-1].keys())
        ):
            continue
        turn = Rotation.from_quat(stack[-1].get("rotation", (1.0, 0.0, 0.0, 0.0)), scalar_first=True)
        stack[-1]["own"] = _place(turn, stack[-1].get("position", (0.0, 0.0, 0.0))) @ np.diag(
            [*stack[-1].get("scale", (1.0, 1.0, 1.0)), 1.0]
        )
        file = Path(stack[-1].get("source", "")).name
        if key == "source" and stack[-1]["model"] and file in meshes:
            place = np.eye(4)
            for frame in stack:
                place = place @ frame.get("own", np.eye(4))
            yield stack[-1]["objectName"], _qt_mesh(meshes[file]), place


def _qt_mesh(file: Path) -> trimesh.Trimesh:
    """Positions and triangles of a Qt Quick 3D mesh (version 7; the names of its vertex entries end the header)."""
    content = file.read_bytes()
    count, stride, _, size = np.frombuffer(content, "<u4", 4, 16)
    at = 0x44 + 16 * int(count) + 4
    for _ in range(count):
        at += 8 + int(np.frombuffer(content, "<u4", 1, at)[0]) // 4 * 4
    points = np.frombuffer(content, "<f4", size // 4, at).reshape(-1, stride // 4)[:, :3]
    width = {3: "<u2", 5: "<u4"}[int(np.frombuffer(content, "<u4", 1, 32)[0])]
    indices = np.frombuffer(
        content, width, int(np.frombuffer(content, "<u4", 1, 40)[0]) // int(width[2]), at + size + 4 - size % 4
    )
    return trimesh.Trimesh(points.astype(np.float64), indices.reshape(-1, 3), process=False)


def _numbers(text: str | None, default: str) -> np.ndarray:
    return np.array([float(v) for v in (text or default).split()])


def _place(turn: Rotation, shift: Sequence[float] | np.ndarray) -> np.ndarray:
    place = np.eye(4)
    place[:3, :3] = turn.as_matrix()
    place[:3, 3] = shift
    return place


def _moved(told: dict[str, float]) -> np.ndarray:
    """A Unity transform, from what a prefab tells of it."""
    turn = Rotation.from_quat([told.get(f"m_LocalRotation.{k}", float(k == "w")) for k in "xyzw"])
    moved = _place(turn, [told.get(f"m_LocalPosition.{k}", 0.0) for k in "xyz"])
    return moved @ np.diag([*(told.get(f"m_LocalScale.{k}", 1.0) for k in "xyz"), 1.0])


def _origin(element: ET.Element | None) -> np.ndarray:
    if element is None:
        return np.eye(4)
    turn = Rotation.from_euler("xyz", _numbers(element.get("rpy"), "0 0 0"))
    return _place(turn, _numbers(element.get("xyz"), "0 0 0"))


def _pieces(file: Path, name: str) -> Iterator[tuple[str, trimesh.Trimesh]]:
    if file.suffix.lower() != ".dae":
        yield name, _mesh(file)
        return
    assembly = read_cad(file)
    for part in assembly.parts:
        points, triangles = assembly.points_of(part), assembly.shape_of(part).mesh.triangles
        yield part.name, trimesh.Trimesh(points, triangles, process=False)


def _mesh(file: Path) -> trimesh.Trimesh:
    mesh = trimesh.load(file, process=False, force="mesh")
    return trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
