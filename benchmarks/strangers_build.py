"""The open models and PDFs that the labels of `benchmarks/` are for, built from git snapshots of public repositories.

    python benchmarks/strangers_build.py MIRROR_DIR OUT_DIR [--only NAME,…] [--blender PYTHON]
        [--held-back]

From the repository's root, in the project's environment. MIRROR_DIR has a bare git directory
`OWNER+NAME/repo` for each repository; nothing is fetched. OUT_DIR gets `brochures/NAME.pdf` for each
`benchmarks/brochures/*.json` and `models/NAME…` for each model in `BUILDERS`, as `source` in its label says, and
for the two public ones of `../shared/data`. `--blender`: a Python that has `bpy==5.0.1`, for three of them.

Every source file must have its SHA-256 in the label. Then every model is read, and must have the label's parts, height
(`frame.height`, to 0.1 %) and joints (each within the boxes of its bodies, seen along its axis). Models that are held
back are not built unless `--held-back` is given; PDFs that are held are copied unread.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from scipy.linalg import null_space

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src"), str(ROOT / "tests"), str(ROOT / "benchmarks")]

from strangers_models import LABELS, SHARED  # noqa: E402
from strangers_placed import (  # noqa: E402
    BuildError,
    Job,
    Placed,
    Snapshot,
    ftl,
    instances,
    mjcf,
    nested,
    page,
    picked,
    pinned,
    prefab,
    qml,
    summed,
    templates,
    together,
    urdf,
    xacro,
)
from yellowiron.cad import read_cad  # noqa: E402

BROCHURES = LABELS.parent / "brochures"
PUBLIC = SHARED / "public"
Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""From Z up to the Y up of glTF."""
SAME_HEIGHT = 1e-3
BESIDE = 0.05
"""How far outside its bodies' boxes a joint may be, of the machine's height: not every pin is drawn in its body."""
OPENED = """
import sys, bpy
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
bpy.ops.export_scene.gltf(filepath=sys.argv[2], export_format="GLB", export_apply=sys.argv[3] == "full")
"""
"""In Blender: a file as it is."""
MERGED = """
import sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.fbx(filepath=sys.argv[1])
flat = bpy.data.objects["Cylinder.003"]
for gone in (*flat.children_recursive, flat):
    bpy.data.objects.remove(gone)
bpy.ops.import_scene.fbx(filepath=sys.argv[2])
bpy.ops.export_scene.gltf(filepath=sys.argv[3], export_format="GLB")
"""
"""In Blender: the first file without its flattened arm, with that of the second, which is in its place."""


def one(job: Job) -> None:
    """The file as it is, under the label's name."""
    (file,) = job.files
    shutil.copy(file, job.models / f"{job.name}{file.suffix.lower()}")


def packed(job: Job) -> None:
    """A glTF file and its buffer as one GLB; pictures are left where they are."""
    text, buffer = job.files
    document = json.loads(text.read_text(encoding="utf-8"))
    del document["buffers"][0]["uri"]
    data = buffer.read_bytes()
    words = json.dumps(document).encode()
    chunks = [(b"JSON", words + b" " * (-len(words) % 4)), (b"BIN\0", data + b"\0" * (-len(data) % 4))]
    body = b"".join(len(c).to_bytes(4, "little") + kind + c for kind, c in chunks)
    job.glb.write_bytes(b"glTF" + (2).to_bytes(4, "little") + (12 + len(body)).to_bytes(4, "little") + body)


def many(job: Job) -> None:
    """All files in one folder."""
    into = job.models / job.name
    into.mkdir(exist_ok=True)
    for file in job.files:
        shutil.copy(file, into / file.name)


def in_blender(code: str, *words: str) -> Callable[[Job], None]:
    """A file that Blender makes of the source files."""

    def build(job: Job) -> None:
        if job.blender is None:
            raise BuildError("needs --blender")
        files = [str(f) for f in job.files]
        command = [job.blender, "-c", code, *files, str(job.glb), *words]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise BuildError(done.stderr.strip() or done.stdout.strip())

    return build


def in_nodes(placed: Callable[[Job], Placed]) -> Callable[[Job], None]:
    """A GLB of meshes in their own frames, each placed by its node; Z stays up."""

    def build(job: Job) -> None:
        scene = trimesh.Scene()
        for name, mesh, place in placed(job):
            scene.add_geometry(mesh, node_name=name, geom_name=name, transform=place)
        scene.export(job.glb)

    return build


def turned(placed: Callable[[Job], Placed]) -> Callable[[Job], None]:
    """A GLB of meshes in one frame, turned to Y up."""

    def build(job: Job) -> None:
        scene = trimesh.Scene()
        for name, mesh, place in placed(job):
            mesh.apply_transform(place)
            mesh.apply_transform(Y_UP)
            scene.add_geometry(mesh, node_name=name, geom_name=name)
        scene.export(job.glb)

    return build


LOADER = (
    "Body.001", "Front_Forks", "Plane.001", "Front_Forks_Supporter",
    "Wheel_Left_Back", "Wheel_Left_Front", "Wheel_Right_Back", "Wheel_Right_Front",
)  # fmt: skip
"""The objects of `gaia_wheel_loader` in a file of seven machines …"""
DIGGER = (
    "Body.003", "Main_Forks", "Secondary Forks", "Secondary_Supporter", "Plane.003", "Main_Supporter", "Wheel",
    "Inside_Wheels", "Cylinder.019", "Cube.008", "Cylinder.018", "Wheel_Supporter",
)  # fmt: skip
ROLLER = ("Body.004", "Front_Supporter", "Front_Wheel", "Wheel_Left_Back.001", "Wheel_Right_Back.001")
TRUCK = (
    "Dumping_Container", "Side_Mudguard", "Wheel_First_Right_Back", "Wheel_Second_Right_Back", "Wheel_Right_Front.001",
    "Wheel_Front_Left", "WHeel_Second_Left_Back", "Wheel_First_Left_Back", "Body.002",
)  # fmt: skip
"""… and those of three others."""
SHOVEL = (
    "SM_Veh_Loader_01", *(f"SM_Veh_Loader_01_{k}" for k in (
        "Joystick", "Wheel_rl", "Wheel_fl", "Wheel_fr", "Wheel_rr", "Arm", "Bucket", "SteeringW", "Glass",
    )),
)  # fmt: skip
"""Of a file with several tools in one place, those with one tool …"""
TRACKED = ("Track_r", "Track_Wheel_rr", "Track_Wheel_fr", "Track_Wheel_fl", "Track_Wheel_rl", "Track_l")
CABBED = ("Top", "Arm_01", "Arm_02", "Joystick_01", "Joystick_02", "Lever_01", "Lever_02")
LARGE = tuple(f"SM_Veh_Excavator_01{k}" for k in ("", *(f"_{k}" for k in (*TRACKED, *CABBED, "Bucket_01", "Glass"))))
SMALL = tuple(f"SM_Veh_Excavator_02{k}" for k in ("", *(f"_{k}" for k in (*TRACKED, *CABBED, "Bucket_02"))))
"""… and of two others."""
BUILDERS: dict[str, Callable[[Job], None]] = {
    "aaronlachlan_forklift": one,
    "abayir_roller": one,
    "aik_forklift": one,
    "andreneder_dump_truck": one,
    "auwo_excavator": turned(urdf),
    "brecep_forklift": one,
    "brookxx_excavator": turned(urdf),
    "cat_390f_excavator": in_nodes(qml),
    "clem_excavator": one,
    "crumbly_forklift": one,
    "d37pxi_dozer": turned(urdf),
    "dale8nson_excavator": one,
    "dexzt_forklift": one,
    "dozzer197_excavator": turned(xacro),
    "dubinbin_mini_excavator": turned(urdf),
    "dubinbin_page_excavator": in_nodes(page),
    "erdogankir_excavator": turned(urdf),
    "fattahhanafi_excavator": turned(xacro),
    "fedem_wheel_loader": turned(ftl),
    "gaia_dump_truck": in_nodes(picked(*TRUCK)),
    "gaia_excavator": in_nodes(picked(*DIGGER)),
    "gaia_roller": in_nodes(picked(*ROLLER)),
    "gaia_wheel_loader": in_nodes(picked(*LOADER)),
    "greetingbear_work_equipment": one,
    "haibingwang_simple_excavator": packed,
    "hemanth_dozer": one,
    "hemanth_excavator": in_nodes(picked(*LARGE)),
    "hemanth_mini_excavator": in_nodes(picked(*SMALL)),
    "hemanth_mobile_crane": one,
    "hemanth_roller": one,
    "hemanth_skid_steer": one,
    "hemanth_telehandler": one,
    "hemanth_wheel_loader": in_nodes(picked(*SHOVEL)),
    "hiepnm_excavator": one,
    "icmantis_excavator": in_nodes(prefab),
    "ix35e_excavator": turned(summed),
    "jamesthreadgold_excavator": one,
    "johnweez_komatsu": one,
    "johnweez_v2_simple": one,
    "jommsy_mini_excavator": turned(mjcf),
    "karel_forklift": one,
    "kcl_dump_truck": one,
    "kcl_wheel_loader": one,
    "kennyvilella_dozer": in_nodes(mjcf),
    "kennyvilella_excavator": in_nodes(mjcf),
    "kgoroshnikov_forklift": one,
    "kimsonun_dump_truck": one,
    "l580_wheel_loader": turned(xacro),
    "leadcoder_excavator": in_nodes(templates),
    "lemula_excavator": turned(urdf),
    "mckibbenc_forklift": one,
    "mini_excavator": many,
    "mrizalr_telehandler": one,
    "nattthan_dozer": one,
    "natutech_excavator": in_blender(MERGED),
    "newton_excavator": turned(urdf),
    "niklaslidz_wheel_loader": turned(urdf),
    "notsofr0sty_dump_truck": one,
    "ocs_dump_truck": one,
    "octoman_excavator": one,
    "octoman_forklift": one,
    "okkwok_by_material": one,
    "omersaskan_forklift": one,
    "packet39_mobile_crane": in_nodes(together),
    "persimenreed_excavator": one,
    "priyansh_forklift": one,
    "pudong_excavator": turned(urdf),
    "rosatus_mini_excavator": in_nodes(pinned),
    "saguanamu_backhoe_loader": in_nodes(nested),
    "sarisman_excavator": one,
    "segrom_forklift": one,
    "shebbyy_excavator": one,
    "simcity_excavator": one,
    "simcity_forklift": one,
    "simplerig_telehandler": one,
    "simscape_backhoe_arm": in_nodes(instances),
    "simscape_excavator": many,
    "simscape_wheel_loader": many,
    "slamjam_forklift": one,
    "slamjam_skid_steer": one,
    "solergo_mini_excavator": turned(xacro),
    "tobias_work_equipment": one,
    "trailer_wheel_loader": one,
    "utvandraren_forklift": one,
    "valkoja_low_poly_full": in_blender(OPENED, "full"),
    "valkoja_low_poly_half": in_blender(OPENED, "half"),
    "vishalmohanexd_forklift": one,
    "wajueji_excavator": one,
    "wreckingball_crane": one,
    "zszach23_forklift": one,
}


def snapshot_of(mirror: Path, repository: str, commit: str) -> Snapshot:
    git = mirror / repository.replace("/", "+") / "repo"
    return Snapshot(git / ".git" if (git / ".git").is_dir() else git, commit)


def build_model(name: str, mirror: Path, models: Path, blender: str | None) -> dict[str, Any]:
    """Builds a model of `benchmarks/strangers`; its label."""
    label: dict[str, Any] = json.loads((LABELS / f"{name}.json").read_text(encoding="utf-8"))
    source = label["source"]
    snapshot = snapshot_of(mirror, source["repository"], source["commit"])
    with tempfile.TemporaryDirectory() as temporary:
        folder, files = Path(temporary), []
        for path, sha256 in source["files"].items():
            if sha256 is None:  # absent from the snapshot
                continue
            file = folder / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(snapshot.file(path, sha256))
            files.append(file)
        BUILDERS[name](Job(name, snapshot, folder, tuple(files), models, blender))
    return label


def held_back() -> set[str]:
    """The models that nobody may look at yet."""
    files = {f.stem: f.read_text(encoding="utf-8") for f in LABELS.glob("*.json")}
    return {name for name, text in files.items() if json.loads(text).get("held_back")}


def build_apdecky(name: str, mirror: Path, models: Path, _: str | None) -> dict[str, Any]:
    """By the script that is beside the label."""
    label: dict[str, Any] = json.loads((PUBLIC / f"{name}.truth.json").read_text(encoding="utf-8"))
    git = snapshot_of(mirror, label["source"]["repository"], "").git
    out = models / f"{name}.glb"
    subprocess.run(
        [sys.executable, str(PUBLIC / "build_apdecky.py"), str(git), str(out)], capture_output=True, check=True
    )
    if hashlib.sha256(out.read_bytes()).hexdigest() != label["source"]["glb_sha256"]:
        raise BuildError("is built otherwise than the label's")
    return label


def build_tele_dig(name: str, mirror: Path, models: Path, _: str | None) -> dict[str, Any]:
    """The file that the label's `source` names in words."""
    label: dict[str, Any] = json.loads((PUBLIC / f"{name}.truth.json").read_text(encoding="utf-8"))
    repository, commit, path = re.search(r"(\S+/\S+) @ (\w+), (\S+)", label["source"]).groups()  # type: ignore[union-attr]
    (models / f"{name}.glb").write_bytes(snapshot_of(mirror, repository, commit).show(path))
    return label


def checked(name: str, models: Path, label: dict[str, Any]) -> str:
    """What the reader finds, or `BuildError` if it is not what the label says."""
    (cad,) = (p for p in models.iterdir() if name in (p.name, p.stem))
    assembly = read_cad(cad)
    points = {p.id if p.id in label["parts"] else p.name: assembly.points_of(p) for p in assembly.parts}
    if points.keys() != label["parts"].keys():
        unlike = sorted(points.keys() ^ label["parts"].keys())
        raise BuildError(f"parts differ from the label's: {', '.join(unlike)}")
    frame = label.get("frame", {})
    up = np.array(frame.get("up", (0.0, 1.0, 0.0)))
    height = float(np.ptp(np.concatenate(list(points.values())) @ up))
    if abs(height - frame.get("height", height)) > SAME_HEIGHT * height:
        raise BuildError(f"is {height:.4f} high, by its label {frame['height']:.4f}")
    boxes: dict[str, list[np.ndarray]] = {}
    for part, entry in label["parts"].items():
        bodies = {entry["body"], *entry.get("alternatives", ()), *(f["body"] for f in entry.get("fused", ()))}
        for member in {_member(b) for b in bodies - {None}}:
            boxes.setdefault(member, []).append(points[part])
    joints = label["joints"] if isinstance(label["joints"], dict) else {j["name"]: j for j in label["joints"]}
    beside = [
        f"{joint} by {far:.3f}"
        for joint, row in joints.items()
        for end in ("parent", "child")
        if (far := _outside(row, boxes.get(_member(row[end]), []))) > BESIDE * height
    ]
    if beside:
        raise BuildError(f"joints outside their bodies: {', '.join(beside)}")
    return f"{len(points)} parts, {height:.4f} high, {len(joints)} joints in their bodies' boxes"


def _member(body: str) -> str:
    """A body, of either side and of any place in its row."""
    return re.sub(r"(_[lr])?(\[.*\])?$", "", body)


def _outside(joint: dict[str, Any], bodies: Sequence[np.ndarray]) -> float:
    """How far a joint's axis passes from a body's box, both seen along it."""
    if not bodies:
        return 0.0
    across = null_space(np.array([joint["axis"]], dtype=np.float64))
    points, anchor = np.concatenate(bodies) @ across, np.array(joint["anchor"]) @ across
    return float(np.linalg.norm(np.maximum(0.0, np.maximum(points.min(axis=0) - anchor, anchor - points.max(axis=0)))))


def _say(words: str) -> None:
    sys.stdout.write(f"{words}\n")
    sys.stdout.flush()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mirror", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--only", default="", help="names of models or brochures")
    parser.add_argument("--blender", help="a Python that has bpy 5.0.1")
    parser.add_argument("--held-back", action="store_true")
    given = parser.parse_args()
    only = set(filter(None, given.only.split(",")))
    pdfs, models = given.out / "brochures", given.out / "models"
    for folder in (pdfs, models):
        folder.mkdir(parents=True, exist_ok=True)
    faults = 0
    for file in sorted(BROCHURES.glob("*.json")):
        if not only or file.stem in only:
            source = json.loads(file.read_text(encoding="utf-8"))["source"]
            pdf = snapshot_of(given.mirror, source["repository"], source["commit"]).show(source["path"])
            if source.get("sha256") not in (None, hashlib.sha256(pdf).hexdigest()):
                faults += 1
                _say(f"{file.stem}: FAULT is another PDF than the label's")
            (pdfs / f"{file.stem}.pdf").write_bytes(pdf)
    build = {n: build_model for n in BUILDERS if given.held_back or n not in held_back()}
    build |= {"apdecky_excavator_47": build_apdecky, "tele_dig_267": build_tele_dig}
    for name in sorted(n for n in build if not only or n in only):
        try:
            label = build[name](name, given.mirror, models, given.blender)
            _say(f"{name}: {checked(name, models, label)}")
        except BuildError as error:
            faults += 1
            _say(f"{name}: FAULT {error}")
    return int(faults > 0)


if __name__ == "__main__":
    sys.exit(main())
