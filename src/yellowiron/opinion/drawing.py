"""Pictures of parts in doubt: the whole machine with the parts lit, and the parts alone. The same bytes every time."""

from __future__ import annotations

import io
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.report.html.pictures import DrawnTriangles, look_at, part_triangles, render

WHOLE, ALONE = (768, 512), (512, 512)
"""Pixels; what models see without scaling it down."""
_PALE, _LIT = (np.array(c, dtype=np.float32) for c in ((0.42, 0.42, 0.42), (0.85, 0.10, 0.02)))
"""Linear RGB of what is not asked about, and of what is."""
_FRAME = (215, 30, 10)
_MARGIN = 6
"""Pixels between the parts and the frame around them."""
_LEAST = 1e-3
"""Metres: nothing is drawn as if it were smaller."""


@dataclass(frozen=True, eq=False)
class Stage:
    """A CAD model set up to be drawn: `frame` (4, 4) takes it to the machine frame; `numbers`: part → its number among
    the drawn."""

    assembly: Assembly
    frame: Floats
    drawn: DrawnTriangles
    numbers: Mapping[str, int]


def stage_of(assembly: Assembly, frame: Floats) -> Stage:
    """The stage of a CAD model; `frame` (4, 4): CAD → machine, metres."""
    drawn = part_triangles({"": assembly.parts}, assembly, frame)
    return Stage(assembly, frame, drawn, {part.id: number for number, part in enumerate(assembly.parts)})


def box_of(stage: Stage, parts: Sequence[str]) -> Floats:
    """The (2, 3) box of some parts in the machine frame, metres; a point has a small one."""
    drawn = stage.drawn
    points = drawn.points[drawn.triangles[_lit(stage, parts)].reshape(-1)].astype(np.float64)
    return np.array([points.min(axis=0) - 0.5 * _LEAST, points.max(axis=0) + 0.5 * _LEAST])


def pictures_of(stage: Stage, parts: Sequence[str]) -> tuple[bytes, bytes]:
    """PNG files: the whole machine, pale, with some parts lit in red and framed, seen from their side of it; and the
    parts alone, seen from there, set on the ground."""
    own, whole = box_of(stage, parts), np.asarray(stage.drawn.box, dtype=np.float64)
    side = own.mean(axis=0) - whole.mean(axis=0)
    azimuth = math.atan2(1.0 if side[1] > 0.0 else -1.0, 0.6 if side[0] >= 0.0 else -0.6)
    colors = np.where(_lit(stage, parts)[:, None], _LIT, _PALE)
    camera = look_at(_corners(whole), azimuth=azimuth, width=WHOLE[0], height=WHOLE[1])
    image = render(stage.drawn, camera, colors=colors)
    seen = camera.project(_corners(own))
    left, top = (float(v) - _MARGIN for v in seen.min(axis=0))
    right, bottom = (float(v) + _MARGIN for v in seen.max(axis=0))
    ImageDraw.Draw(image).rectangle((left, top, right, bottom), outline=_FRAME, width=2)

    down = np.eye(4)
    down[2, 3] = -own[0, 2]
    by_id = {part.id: part for part in stage.assembly.parts}
    alone = part_triangles({"": [by_id[part] for part in parts]}, stage.assembly, down @ stage.frame)
    closer = look_at(_corners(own + down[:3, 3]), azimuth=azimuth, width=ALONE[0], height=ALONE[1])
    lit = np.broadcast_to(_LIT, alone.colors.shape)
    return _png(image), _png(render(alone, closer, colors=lit))


def _lit(stage: Stage, parts: Sequence[str]) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which triangles (m,) are those of some parts."""
    return np.asarray(np.isin(stage.drawn.parts, [stage.numbers[part] for part in parts]))


def _corners(box: Floats) -> Floats:
    return np.array(list(itertools.product(*box.T)))


def _png(image: Image.Image) -> bytes:
    buffer = io.BytesIO()
    image.save(buffer, "PNG")
    return buffer.getvalue()
