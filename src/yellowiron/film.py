"""A film of a few seconds: a CAD model's parts come together as bodies, joints light up on their pins, a value goes
from the sheet to its cylinder, and the machine works in an engine.

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

from yellowiron import kinematics, simulation, specs
from yellowiron.model.errors import MechanismError, OutputError, YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Cylinder, Mechanism, Site
from yellowiron.model.specification import Specification, fold
from yellowiron.report.html.drawing import MOST
from yellowiron.report.html.pictures import Camera, DrawnTriangles, look_at, machine_triangles, outline, posed, render
from yellowiron.report.html.simulation import engine_name
from yellowiron.report.words import signed, titled
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
_STROKES = 3
"""Actuators that are shown at work: those that move the most."""
_ENGINE = "mujoco"


@dataclass(frozen=True, eq=False)
class Shot:
    """What a frame shows: parts `apart` (0: in place), grey or, at `mix` 1, in their bodies' colours, bodies in `poses`
    (4, 4 displacements), from a camera."""

    camera: Camera
    apart: float = 0.0
    mix: float = 1.0
    poses: Mapping[str, Floats] | None = None


@dataclass(frozen=True, eq=False)
class Moment:
    """The machine at work: bodies in `poses` (4, 4 displacements), the share (0 … 1) of its stroke at which its
    actuator is, and how many seconds of an engine's time it has worked for, None where the kinematics moved it."""

    actuator: str
    poses: Mapping[str, Floats]
    share: float
    seconds: float | None = None


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
        frames = list(_frames(machine, drawn, sheets, progress))
        progress("Drawing the film")
        pictures = _drawn(drawn, drawn.by_body(machine.mechanism), [frame.shot for frame in frames])
        progress("Writing the film")
        _write(temporary, [_finished(one, picture) for one, picture in zip(frames, pictures, strict=True)])
    return out


def _frames(
    machine: Machine,
    drawn: DrawnTriangles,
    sheets: Sequence[Path],
    progress: Callable[[str], None] = lambda words: None,
) -> Iterator[Frame]:
    mechanism, assembly = machine.mechanism, machine.assembly
    site, work = _shown(mechanism, _work(machine, progress))
    points = np.concatenate([outline(mechanism), *(outline(mechanism, moment.poses) for moment in work[::4])])
    still = look_at(points, azimuth=-0.9, elevation=0.24, width=SIZE[0], height=SIZE[1] - _BAND)
    still = replace(still, height=SIZE[1])
    drawn_there = Shot(still)
    for k in range(count := round(_COMING * RATE)):
        share = _eased(k / (count - 1))
        yield Frame(Shot(still, _APART * (1.0 - share), share), f"{len(assembly.parts)} parts of a CAD model")
    anchors = np.array([j.anchor for j in mechanism.joints if j.type != "fixed"], dtype=np.float64)
    spots = still.project(anchors[np.argsort(anchors[:, 0])]) if len(anchors) else np.zeros((0, 2))
    for k in range(count := round(_LIGHTING * RATE)):
        lit = spots[: math.ceil(len(spots) * (k + 1) / count)]
        yield Frame(drawn_there, f"{len(lit)} joints on their pins", _spots(lit))
    yield from _read(machine, drawn_there, sheets)
    for moment in work:
        yield Frame(Shot(still, poses=moment.poses), _measured(mechanism, site, moment))


def _height(site: Site, poses: Mapping[str, Floats]) -> float:
    """Metres above the ground."""
    return float((poses[site.body] @ (*site.position, 1.0))[2])


def _measured(mechanism: Mechanism, site: Site | None, moment: Moment) -> str:
    """What is told of a moment: stroke, height, tilt, and whose work it is."""
    actuator = next(a for a in mechanism.actuators if a.name == moment.actuator)
    slide = mechanism.joint(actuator.joints[0].joint)
    words = [titled(moment.actuator)]
    if slide.type == "prismatic" and slide.lower is not None and slide.upper is not None:
        words.append(f"{1e3 * moment.share * (slide.upper - slide.lower):.0f} mm out")
    if site is not None:
        height = _height(site, moment.poses)
        words.append(f"{titled(site.name)} {abs(height):.2f} m {'high' if height >= 0.0 else 'deep'}")
        if site.name in {m.quantity.get("site") for m in mechanism.measurements if m.quantity.get("kind") == "angle"}:
            x, y, z = moment.poses[site.body][:3, :3] @ site.x_axis
            along = math.copysign(math.hypot(x, y), x)
            words[-1] += f", at {signed(math.degrees(math.atan2(z, along)), 0, '°')}"
    words.append("by kinematics" if moment.seconds is None else f"{engine_name(_ENGINE)}, {moment.seconds:.1f} s")
    return "     ".join(words)


def _shown(mechanism: Mechanism, work: Sequence[Moment]) -> tuple[Site | None, list[Moment]]:
    """The site that goes up and down most, of those that are measured if any are, and the work of the actuators that
    move it most."""

    def travel(site: Site, name: str = "") -> float:
        return float(np.ptp([_height(site, moment.poses) for moment in work if name in ("", moment.actuator)]))

    measured = {m.quantity.get("site") for m in mechanism.measurements}
    sites = [site for site in mechanism.sites if site.name in measured] or mechanism.sites
    best = max(sites, key=travel) if work and sites else None
    names = list(dict.fromkeys(moment.actuator for moment in work))
    order = sorted(names, key=lambda name: -travel(best, name)) if best is not None else names
    return best, [moment for name in order[:_STROKES] for moment in work if moment.actuator == name]


def _work(machine: Machine, progress: Callable[[str], None]) -> list[Moment]:
    """The machine at work in an engine: each cylinder actuator in turn to both ends of its stroke, and back. Where that
    engine does not do it, by its kinematics."""
    names = [a.name for a in machine.mechanism.actuators if a.kind == "cylinder"]
    steps = max(2, round(_STEP * RATE / 3))
    shares = [_eased(k / steps) for k in range(1, steps + 1)]
    try:
        seen = simulation.watch(machine.usd, engine=_ENGINE, actuators=names, shares=shares, progress=progress)
    except YellowironError as error:
        progress(f"Moving the machine by its kinematics: {error.message}")
        return list(_moved(machine.mechanism, shares))
    return [Moment(name, at.poses, at.share or 0.0, at.time) for name, each in seen.items() for at in each]


def _moved(mechanism: Mechanism, shares: Sequence[float]) -> Iterator[Moment]:
    """The same by closed-chain kinematics."""
    chain = kinematics.ClosedChain(mechanism)
    state = chain.drawn
    for actuator in mechanism.actuators:
        joint = mechanism.joint(actuator.joints[0].joint)
        if actuator.kind != "cylinder" or joint.lower is None or joint.upper is None:
            continue
        span = joint.upper - joint.lower
        stops = [0.0, joint.lower + 0.02 * span, joint.upper - 0.02 * span, 0.0]
        for begin, end in itertools.pairwise(stops):
            for share in shares:
                target = begin + (end - begin) * share
                try:
                    state, _ = chain.reach({joint.name: target}, start=state)
                except MechanismError:
                    continue
                yield Moment(actuator.name, chain.pose(state), (target - joint.lower) / (span or 1.0))


def _read(machine: Machine, shot: Shot, sheets: Sequence[Path]) -> Iterator[Frame]:
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
    end = shot.camera.project(np.array(pins, dtype=np.float64)).mean(axis=0)
    for k in range(count := round(_READING * RATE)):
        caption = f"{value.name}: {value.text}     page {evidence.page} of {evidence.file}"
        yield Frame(shot, caption, _line(piece, place, start, end, _eased(min(1.0, 2.0 * k / count))))


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
    """Every shot as an array (rows, columns, 3), of triangles in their bodies' colours, drawn side by side."""
    middle = 0.5 * (drawn.box[0] + drawn.box[1])
    sums = np.zeros((int(drawn.parts.max()) + 1, 4))
    middles = drawn.points[drawn.triangles].mean(axis=1)
    np.add.at(sums, drawn.parts, np.concatenate([middles, np.ones((len(drawn.parts), 1))], axis=1))
    outwards = (sums[:, :3] / np.maximum(sums[:, 3:], 1.0) - middle).astype(np.float32)
    outwards[:, 2] = np.abs(outwards[:, 2])
    away = outwards[drawn.parts[drawn.owners]]

    def one(shot: Shot) -> Any:
        if shot.apart:
            shown = replace(drawn, points=drawn.points + np.float32(shot.apart) * away)
        else:
            shown = posed(drawn, shot.poses) if shot.poses else drawn
        share = np.float32(shot.mix)
        return np.asarray(render(shown, shot.camera, colors=(1 - share) * _GREY + share * colors))

    _ = drawn.pieces, drawn.bodies  # built once, before several ask for them
    with ThreadPoolExecutor(max(1, min(os.cpu_count() or 1, MOST))) as pool:
        asked = {id(shot): pool.submit(one, shot) for shot in {id(shot): shot for shot in shots}.values()}
        return [asked[id(shot)].result() for shot in shots]


def _write(file: Path, frames: Sequence[Image]) -> None:
    if file.suffix.lower() == ".mp4":
        _encode(file, frames)
        return
    more: dict[str, Any] = {"quality": 64, "method": 4} if file.suffix.lower() == ".webp" else {"optimize": False}
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
