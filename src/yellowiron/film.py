"""A film of a few seconds: a CAD model's parts come together as bodies, joints light up on their pins, a value goes
from the sheet to its cylinder, and the machine works.

Every frame is drawn as the report's pictures are, so the same machine gives the same bytes (of a WebP or GIF; what
encodes MP4 is the user's own program).
"""

from __future__ import annotations

import itertools
import math
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from yellowiron import kinematics, specs
from yellowiron.model.errors import MechanismError, OutputError, YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Cylinder, Mechanism, Site
from yellowiron.model.specification import Specification, fold
from yellowiron.report.html.pictures import Camera, DrawnTriangles, look_at, machine_triangles, outline, posed, render
from yellowiron.report.words import titled
from yellowiron.support.guard import run_guarded
from yellowiron.support.output import output_file

if TYPE_CHECKING:
    from PIL.Image import Image

    from yellowiron.pipeline import Machine

SUFFIXES = (".webp", ".gif", ".mp4")
RATE = 12
"""Frames a second."""
SIZE = (800, 450)
"""Pixels."""
_BAND = 36
"""Rows of pixels of the caption, at the bottom."""
_PIECE = (330, 190)
"""Pixels of the piece of a sheet that is shown."""
_COMING, _LIGHTING, _READING, _STEP = 1.6, 1.4, 1.6, 1.4
"""Seconds in which parts come together, joints light up, a value goes to its cylinder; of one actuator's stroke."""
_APART = 0.5
"""How far apart the parts begin, as a share of their distance from the middle."""
_GREY = np.array([0.42, 0.43, 0.45], dtype=np.float32)
_INK, _IRON, _PAPER = (29, 29, 27), (224, 160, 0), (250, 249, 245)
_MOST = 4
"""Processes."""


@dataclass(frozen=True, eq=False)
class Shot:
    """What a frame shows: parts `apart` (0: in place), grey or, at `mix` 1, in their bodies' colours, bodies in `poses`
    (4, 4 displacements), from a camera."""

    camera: Camera
    apart: float = 0.0
    mix: float = 1.0
    poses: dict[str, Floats] | None = None


@dataclass(frozen=True, eq=False)
class Frame:
    """A shot, what is written under it, and what is drawn over it."""

    shot: Shot
    caption: str = ""
    over: Callable[[Any, Image], None] | None = None


def film(
    machine: Machine, out: Path, *, sheets: Sequence[Path] = (), progress: Callable[[str], None] = lambda words: None
) -> Path:
    """Writes the film of a machine that was built: `out` ends in .webp, .gif or, where the program ffmpeg is installed,
    .mp4. `YellowironError` for another suffix, and for a machine without a part."""
    with output_file(out, suffixes=SUFFIXES) as temporary:
        if out.suffix.lower() == ".mp4" and shutil.which("ffmpeg") is None:
            raise YellowironError(
                "MP4 needs the program ffmpeg", where=str(out), hint="Install it, or name a .webp or .gif file."
            )
        frame = np.asarray(machine.alignment.frame, dtype=np.float64)
        drawn = machine_triangles(machine.mechanism, machine.assembly, frame)
        if not len(drawn.triangles):
            raise YellowironError("The machine has nothing to show", where=str(out), hint="Look at its report.")
        progress("Moving the machine")
        frames = list(_frames(machine, drawn, sheets))
        progress("Drawing the film")
        pictures = _drawn(drawn, drawn.by_body(machine.mechanism), [frame.shot for frame in frames])
        progress("Writing the film")
        _write(temporary, [_finished(one, picture) for one, picture in zip(frames, pictures, strict=True)])
    return out


def _frames(machine: Machine, drawn: DrawnTriangles, sheets: Sequence[Path]) -> Iterator[Frame]:
    mechanism, assembly = machine.mechanism, machine.assembly
    site, work = _shown(mechanism, list(_work(mechanism)))
    points = np.concatenate([outline(mechanism), *(outline(mechanism, poses) for _, poses in work[::4])])
    still = look_at(points, azimuth=-0.9, elevation=0.24, width=SIZE[0], height=SIZE[1] - _BAND)
    still = replace(still, height=SIZE[1])
    for k in range(count := round(_COMING * RATE)):
        share = _eased(k / (count - 1))
        yield Frame(Shot(still, _APART * (1.0 - share), share), f"{len(assembly.parts)} parts of a CAD model")
    anchors = np.array([j.anchor for j in mechanism.joints if j.type != "fixed"], dtype=np.float64)
    spots = still.project(anchors[np.argsort(anchors[:, 0])]) if len(anchors) else np.zeros((0, 2))
    for k in range(count := round(_LIGHTING * RATE)):
        lit = spots[: math.ceil(len(spots) * (k + 1) / count)]
        yield Frame(Shot(still), f"{len(lit)} joints on their pins", _spots(lit))
    yield from _read(machine, still, sheets)
    for name, poses in work:
        caption = titled(name)
        if site is not None:
            caption += f"     {titled(site.name)} {_height(site, poses):.2f} m high"
        yield Frame(Shot(still, poses=poses), caption)


def _height(site: Site, poses: Mapping[str, Floats]) -> float:
    """Metres above the ground."""
    return float((poses[site.body] @ (*site.position, 1.0))[2])


def _shown(mechanism: Mechanism, work: list[tuple[str, dict[str, Floats]]]) -> tuple[Site | None, list[Any]]:
    """The site that goes up and down most, and the work with what moves it most first."""
    if not work or not mechanism.sites:
        return None, work

    def travel(site: Site, name: str = "") -> float:
        return float(np.ptp([_height(site, poses) for actuator, poses in work if name in ("", actuator)]))

    best = max(mechanism.sites, key=travel)
    order = sorted(dict.fromkeys(name for name, _ in work), key=lambda name: -travel(best, name))
    return best, [step for name in order for step in work if step[0] == name]


def _work(mechanism: Mechanism) -> Iterator[tuple[str, dict[str, Floats]]]:
    """The machine working: each cylinder actuator in turn to one end of its stroke, to the other, and back."""
    chain = kinematics.ClosedChain(mechanism)
    state = chain.drawn
    for actuator in mechanism.actuators:
        joint = mechanism.joint(actuator.joints[0].joint)
        if actuator.kind != "cylinder" or joint.lower is None or joint.upper is None:
            continue
        span = joint.upper - joint.lower
        stops = [0.0, joint.upper - 0.05 * span, joint.lower + 0.05 * span, 0.0]
        steps = max(2, round(_STEP * RATE / 3))
        for begin, end in itertools.pairwise(stops):
            for k in range(1, steps + 1):
                target = begin + (end - begin) * _eased(k / steps)
                try:
                    state, _ = chain.reach({joint.name: target}, start=state)
                except MechanismError:
                    continue
                yield actuator.name, chain.pose(state)


def _read(machine: Machine, camera: Camera, sheets: Sequence[Path]) -> Iterator[Frame]:
    """A value's way from its box on the sheet to the cylinder that it is of."""
    known = _from_sheet(machine)
    if known is None or not sheets:
        return
    cylinder, value = known
    evidence = value.evidence
    assert evidence is not None and evidence.box is not None
    with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
        from PIL import Image

        drawn = specs.draw_evidence(list(sheets), machine.specifications, Path(folder))
        stem = Path(evidence.file).stem
        found = next((f for f in drawn if f.name == f"{stem}-page-{evidence.page}.png"), None)
        if found is None:
            return
        page = Image.open(found).convert("RGB")
    x0, top, x1, bottom = (specs.PICTURE_SCALE * v for v in evidence.box)
    x0, x1 = x0 + specs.PICTURE_MARGIN, x1 + specs.PICTURE_MARGIN
    # A piece of the page around the value, large enough to be read.
    width, height = _PIECE
    left = int(np.clip((x0 + x1) / 2 - width / 2, 0, max(page.width - width, 0)))
    above = int(np.clip((top + bottom) / 2 - height / 2, 0, max(page.height - height, 0)))
    piece = page.crop((left, above, left + width, above + height))
    place = (SIZE[0] - width - 16, 16)
    start = (place[0] + (x0 + x1) / 2 - left, place[1] + bottom - above)
    pins = [machine.mechanism.joint(name).anchor for name in cylinder.pins or (cylinder.slide,)]
    end = camera.project(np.array(pins, dtype=np.float64)).mean(axis=0)
    for k in range(count := round(_READING * RATE)):
        caption = f"{value.name}: {value.text}     page {evidence.page} of {evidence.file}"
        yield Frame(Shot(camera), caption, _line(piece, place, start, end, _eased(min(1.0, 2.0 * k / count))))


def _from_sheet(machine: Machine) -> tuple[Cylinder, Specification] | None:
    """A cylinder, the longest one first, and a value of it that was read on a sheet."""
    by_slide = {entry.joint: a for a in machine.mechanism.actuators for entry in a.joints}
    for cylinder in sorted(machine.mechanism.cylinders, key=lambda c: -c.drawn_length):
        actuator = by_slide.get(cylinder.slide)
        source = cylinder.sources.get("stroke", "") if actuator is not None else ""
        for value in machine.specifications:
            evidence = value.evidence
            if value.status == "ok" and evidence is not None and evidence.box and fold(value.name) in fold(source):
                return cylinder, value
    return None


def _eased(share: float) -> float:
    return share * share * (3.0 - 2.0 * share)


def _spots(places: Floats) -> Callable[[Any, Image], None]:
    def over(draw: Any, picture: Image) -> None:
        for number, (x, y) in enumerate(places):
            fresh = number >= len(places) - 3
            radius = 9 if fresh else 5
            draw.ellipse((x - radius, y - radius, x + radius, y + radius), fill=_IRON, outline=(255, 255, 255), width=2)

    return over


def _line(
    piece: Image, place: tuple[int, int], start: tuple[float, float], end: Floats, share: float
) -> Callable[[Any, Image], None]:
    def over(draw: Any, picture: Image) -> None:
        picture.paste(piece, place)
        x, y = place
        draw.rectangle((x - 1, y - 1, x + piece.width, y + piece.height), outline=_INK, width=1)
        tip = tuple(np.array(start) + share * (end - np.array(start)))
        draw.line((*start, *tip), fill=_IRON, width=4)
        draw.ellipse((tip[0] - 6, tip[1] - 6, tip[0] + 6, tip[1] + 6), fill=_IRON, outline=(255, 255, 255), width=2)

    return over


def _finished(frame: Frame, picture: Floats) -> Image:
    import PIL.Image
    from PIL import ImageDraw, ImageFont

    image = PIL.Image.fromarray(np.asarray(picture, dtype=np.uint8))
    draw = ImageDraw.Draw(image, "RGBA")
    if frame.over is not None:
        frame.over(draw, image)
    width, height = SIZE
    draw.rectangle((0, height - _BAND, width, height), fill=(*_PAPER, 235))
    draw.text((16, height - 29), frame.caption, fill=_INK, font=ImageFont.load_default(size=18))
    return image


def _drawn(drawn: DrawnTriangles, colors: Any, shots: Sequence[Shot]) -> list[Any]:
    """Every shot as an array (rows, columns, 3), drawn by several processes."""
    bare = replace(drawn, colors=colors)
    count = max(1, min(os.cpu_count() or 1, _MOST))
    with ThreadPoolExecutor(count) as pool:
        shares = [list(shots[k::count]) for k in range(count)]
        asked = [pool.submit(run_guarded, f"{__name__}:draw_shots", bare, share, where="film") for share in shares]
        done = [share.result() for share in asked]
    return [done[k % count][k // count] for k in range(len(shots))]


def draw_shots(drawn: DrawnTriangles, shots: Sequence[Shot]) -> list[Any]:
    """Shots of a machine whose triangles have their bodies' colours."""
    middle = 0.5 * (drawn.box[0] + drawn.box[1])
    sums = np.zeros((int(drawn.parts.max()) + 1, 4))
    middles = drawn.points[drawn.triangles].mean(axis=1)
    np.add.at(sums, drawn.parts, np.concatenate([middles, np.ones((len(drawn.parts), 1))], axis=1))
    outwards = (sums[:, :3] / np.maximum(sums[:, 3:], 1.0) - middle).astype(np.float32)
    outwards[:, 2] = np.abs(outwards[:, 2])
    pictures = []
    for shot in shots:
        moved = posed(drawn, shot.poses or {})
        if shot.apart:
            away = outwards[moved.parts[moved.owners]]
            moved = replace(moved, points=moved.points + np.float32(shot.apart) * away)
        share = np.float32(shot.mix)
        pictures.append(np.asarray(render(moved, shot.camera, colors=(1 - share) * _GREY + share * drawn.colors)))
    return pictures


def _write(file: Path, frames: Sequence[Image]) -> None:
    if file.suffix.lower() == ".mp4":
        _encode(file, frames)
        return
    more: dict[str, Any] = {"quality": 72, "method": 4} if file.suffix.lower() == ".webp" else {"optimize": False}
    try:
        frames[0].save(file, save_all=True, append_images=frames[1:], duration=round(1000 / RATE), loop=0, **more)
    except OSError as error:
        raise OutputError("The film cannot be written", where=str(file), hint="Make room there.") from error


def _encode(file: Path, frames: Sequence[Image]) -> None:
    width, height = SIZE
    command = ["ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}",
               "-r", str(RATE), "-i", "-", "-pix_fmt", "yuv420p", "-movflags", "+faststart", str(file)]  # fmt: skip
    raw = b"".join(frame.convert("RGB").tobytes() for frame in frames)
    done = subprocess.run(command, input=raw, capture_output=True, check=False)
    if done.returncode:
        words = done.stderr.decode(errors="replace").strip()[-200:]
        raise OutputError(f"ffmpeg could not write the film: {words}", where=str(file), hint="Name a .webp file.")
