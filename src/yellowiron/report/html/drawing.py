"""All pictures of a page, drawn side by side."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from yellowiron.model.geometry import Floats
from yellowiron.report.html.pictures import Camera, DrawnTriangles, data_uri, posed, render
from yellowiron.report.html.rays import Singles
from yellowiron.support.caching.content import content_of
from yellowiron.support.caching.disk import kept_each

MOST = 4
"""Threads that draw: Embree and numpy let each other go on."""


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture to draw: through a camera, of the machine as it is or in a pose (body → (4, 4) displacement), in its
    own colours or in others (m, 3)."""

    camera: Camera
    poses: Mapping[str, Floats] | None = None
    colors: Singles | None = None


def draw(
    drawn: DrawnTriangles, pictures: Mapping[str, Picture], *, meanwhile: Callable[[], None] = lambda: None
) -> dict[str, str]:
    """The pictures of some triangles by name, each as a data URI. The same, however many threads draw them, and
    whether they were drawn before. `meanwhile` is done once, while others draw."""
    machine = content_of([drawn.points, drawn.triangles, drawn.normals, drawn.colors, drawn.parts])
    given = {name: [machine, drawn.spans if one.poses else None, one] for name, one in pictures.items()}
    waiting = [meanwhile]

    def make(names: Sequence[str]) -> dict[str, str]:
        return _draw(drawn, {name: pictures[name] for name in names}, waiting.pop())

    found = kept_each("pictures", make, given)
    for other in waiting:
        other()
    return found


def _draw(drawn: DrawnTriangles, pictures: Mapping[str, Picture], meanwhile: Callable[[], None]) -> dict[str, str]:
    moved = any(one.poses is not None for one in pictures.values())
    with ThreadPoolExecutor(max(1, min(os.cpu_count() or 1, MOST))) as pool:
        # Built once; pictures, which are asked for later, wait for it.
        whole, bodies = pool.submit(lambda: drawn.pieces), pool.submit(lambda: drawn.bodies if moved else None)

        def picture(one: Picture) -> str:
            (whole if one.poses is None else bodies).result()
            shown = drawn if one.poses is None else posed(drawn, one.poses)
            return data_uri(render(shown, one.camera, colors=one.colors))

        # Those that only need what is built first.
        order = sorted(pictures, key=lambda name: pictures[name].poses is not None)
        asked = {name: pool.submit(picture, pictures[name]) for name in order}
        meanwhile()
        return {name: asked[name].result() for name in pictures}
