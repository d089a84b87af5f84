"""All pictures of a page: drawn side by side in processes of their own where that is worth their start."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.report.html.pictures import Camera, DrawnTriangles, Singles, data_uri, posed, render
from yellowiron.support.caching.content import content_of
from yellowiron.support.caching.disk import kept_each
from yellowiron.support.guard import run_guarded

_MOST = 4
"""Processes."""
_WORTH = 400_000
"""Rays: what is drawn while a process starts, and while this one does what is to be done meanwhile."""
_BUILDING = 3.0
"""Rays as costly as one triangle in its place for rays: a machine in another pose is built anew."""


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
    """The pictures of some triangles by name, each as a data URI. The same, however many processes draw them, and
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
    costs = {name: _cost(drawn, picture) for name, picture in pictures.items()}
    count = max(1, min(os.cpu_count() or 1, _MOST, len(pictures), int(sum(costs.values()) / _WORTH)))
    shares: list[dict[str, Picture]] = [{} for _ in range(count)]
    loads = [float(_WORTH)] * count
    for name in sorted(pictures, key=lambda name: -costs[name]):
        place = loads.index(min(loads))
        shares[place][name] = pictures[name]
        loads[place] += costs[name]
    with ThreadPoolExecutor(count) as pool:
        others = [pool.submit(_elsewhere, drawn, share) for share in shares[1:] if share]
        meanwhile()
        done = draw_here(drawn, shares[0])
        for other in others:
            done |= other.result()
    return done


def draw_here(drawn: DrawnTriangles, pictures: Mapping[str, Picture]) -> dict[str, str]:
    """The pictures, one after the other."""
    return {
        name: data_uri(
            render(posed(drawn, one.poses) if one.poses is not None else drawn, one.camera, colors=one.colors)
        )
        for name, one in pictures.items()
    }


def _elsewhere(drawn: DrawnTriangles, pictures: Mapping[str, Picture]) -> dict[str, str]:
    bare = replace(drawn)  # without what was computed of it
    try:
        done: dict[str, str] = run_guarded(f"{__name__}:draw_here", bare, pictures, where="report.html")
    except YellowironError:
        # A machine on which no process can be started has time.
        return draw_here(drawn, pictures)
    return done


def _cost(drawn: DrawnTriangles, picture: Picture) -> float:
    """Rays, and what is as costly."""
    rays = float(picture.camera.width * picture.camera.height)
    return rays if picture.poses is None else rays + _BUILDING * len(drawn.triangles)
