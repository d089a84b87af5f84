"""The roles of a track's parts, and of what stands on a track.

The wheel with teeth is the sprocket, the one at the other end the idler; rollers lie on the ground's side, carrier
rollers on the other. Of a loop that runs to a point above it the wheel up there is the sprocket, and the rear one, an
idler as well, the last of the rollers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.solids import Solid, solids_of
from yellowiron.alignment.features.tracks import Track, tracks_of
from yellowiron.alignment.labelling.confidence import REVIEW
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.rows import member, split_index
from yellowiron.model.template import Role, Template
from yellowiron.support.caching.remembered import remembered

PLAIN = 0.02
"""The rims of two wheels differ if one reaches this share of its radius further out than the other's."""
SURE = 0.95
"""Confidence of a part of a track."""
ON = 0.5
"""What stands on a track is smaller than this share of its largest part."""
KINDS = ("shoe", "sprocket", "idler", "roller", "carrier")
"""Kinds of roles of a track's parts."""


@remembered
def without_tracks(template: Template) -> Template:
    """The template without the parts of tracks, which are found by themselves, and without hidden bodies."""
    gone = {r.name for r in template.roles if r.many or r.kind in KINDS}
    return replace(
        template,
        roles=tuple(r for r in template.roles if r.name not in gone),
        joints=tuple(j for j in template.joints if not gone & {split_index(p)[0] for p in j.parts}),
    )


def track_places(
    tracks: Sequence[Track], ids: Mapping[int, str], frame: Floats, template: Template
) -> dict[str, Place]:
    """Part id → place, for all parts of tracks. `ids`: solid → part id; `frame` (4, 4): CAD → machine; `template` has
    its variants decided."""
    places: dict[str, Place] = {}
    level = [float(frame[1, :3] @ t.center + frame[1, 3]) for t in tracks]
    for track, y in zip(tracks, level, strict=True):
        left = y > 0 if len(tracks) == 1 else y > np.mean(level)
        rows = {r.kind: r for r in template.roles if r.kind in KINDS and (_side(r) in ("", "l" if left else "r"))}
        for kind, words, groups in _parts(track, frame, high=track.above is not None and "roller" in rows):
            role = rows.get(kind)
            if role is None:
                continue
            for number, group in enumerate(groups, 1):
                name = member(role.name, number) if role.many else role.name
                body = template.body_of(role.name if not role.rigid else name)
                if body is not None:
                    said = f"{words} of {len(groups)}" if role.many else words
                    places |= {ids[i]: Place(name, body, SURE, said, how="track") for i in group}
    return places


def no_surer_than_frames(
    on_track: Mapping[str, Place], found: Mapping[str, Place], solids: Sequence[Solid], root: str
) -> dict[str, Place]:
    """The places of tracks' parts, those doubtful that go with another body than the `root` of whose own parts, as
    `found`, less than half of the surface is sure: what is surely a track may be on another body than that."""
    sure: dict[str, float] = {}
    for solid in solids:
        place = found.get(solid.part.id)
        if place is not None and place.body is not None and solid.part.id not in on_track:
            sign = 1.0 if place.confidence >= REVIEW else -1.0
            sure[place.body] = sure.get(place.body, 0.0) + sign * solid.surface
    words = "; but what carries it is in doubt itself"
    return {
        part: replace(place, confidence=DOUBTFUL, reason=place.reason + words)
        if place.body not in (root, None) and sure.get(str(place.body), 0.0) < 0.0
        else place
        for part, place in on_track.items()
    }


@dataclass(frozen=True, eq=False)
class _Surroundings:
    """What is around the parts that may stand on a track: the places of all parts so far by id (`found`), solid → place
    of what is `on` a track, and the `others`: solids that are placed for better reasons than touch."""

    solids: Sequence[Solid]
    touch: Touch
    found: Mapping[str, Place]
    on: dict[int, Place]
    others: frozenset[int]


def on_tracks(
    found: Mapping[str, Place], placed: Mapping[str, Place], solids: Sequence[Solid], touch: Touch
) -> dict[str, Place]:
    """Part id → place, for parts that stand on a track: whose place in `found` (or none) rests on no more than what
    they touch or are near to, and which touch a part of a track in `placed` and are as deep in it."""
    where = {s.part.id: s.index for s in solids}
    waiting = _loosely_placed(found, {where[part] for part in placed}, solids)
    others = frozenset(where[part] for part in found if where[part] not in waiting)
    around = _Surroundings(solids, touch, found, {where[part]: place for part, place in placed.items()}, others)
    result: dict[str, Place] = {}
    while True:
        grown = {i: place for i in waiting if (place := _standing(i, around)) is not None}
        if not grown:
            return result
        around.on.update((i, place) for i, place in grown.items() if place.confidence >= SURE)
        result |= {solids[i].part.id: place for i, place in grown.items()}
        waiting = [i for i in waiting if i not in grown]


def _loosely_placed(found: Mapping[str, Place], rows: set[int], solids: Sequence[Solid]) -> list[int]:
    """The solids outside the tracks' `rows` that touch or nearness alone placed, or nothing, and that are small enough
    to stand on a track."""
    waiting = [
        s.index
        for s in solids
        if s.index not in rows and (s.part.id not in found or found[s.part.id].how in ("touch", "near"))
    ]
    return [i for i in waiting if solids[i].size < ON * max((solids[j].size for j in rows), default=0.0)]


def _standing(i: int, around: _Surroundings) -> Place | None:
    """The place of a solid that touches something on a track; None for one that does not."""
    solids, touch = around.solids, around.touch
    near = [j for j in touch.reaching(solids[i].low, solids[i].high) if j != i and touch.touching(i, j)]
    tracks = [j for j in near if j in around.on]
    if not tracks:
        return None
    best = max(tracks, key=lambda j: (round(touch.sunk(i, j), 3), -j))
    rival = max((touch.sunk(i, j) for j in near if j in around.others), default=-1.0)
    own, body, words = around.found.get(solids[i].part.id), around.on[best].body, f"stands on {around.on[best].role}"
    sure = around.on[best].confidence
    if own is not None and own.body == body:
        return replace(own, confidence=max(own.confidence, sure), reason=words)
    if own is not None and rival > touch.sunk(i, best):
        return replace(own, confidence=DOUBTFUL, reason=f"{own.reason}; but it {words}", runner_up=body)
    return Place(body, body, sure if rival < 0.0 else DOUBTFUL, words, how="touch")


def _side(role: Role) -> str:
    ends = role.name.rpartition("_")[2]
    return role.side or (ends if ends in ("l", "r") else "")


def _parts(track: Track, frame: Floats, *, high: bool) -> list[tuple[str, str, list[tuple[int, ...]]]]:
    """(kind, words, solids of each) of a track's parts in order: wheels front to rear, shoes around the loop, forward
    on the ground, the first being the first ahead of the track's middle. `high`: its sprocket is on top."""
    centers = track.centers @ frame[:3, :3].T + frame[:3, 3]
    middle = 0.5 * (centers.min(axis=0) + centers.max(axis=0))
    order = list(range(len(centers)))
    low = [k for k in order if centers[k, 2] < middle[2]]
    forward = sum(float(centers[(k + 1) % len(order)][0] - centers[k][0]) for k in low)
    if forward < 0:
        order.reverse()
    first = min((k for k in low if centers[k, 0] >= middle[0]), key=lambda k: float(centers[k, 0]), default=order[0])
    at = order.index(first)
    shoes = [track.shoes[k] for k in (*order[at:], *order[:at])]
    placed = sorted(((frame[:3, :3] @ w.center + frame[:3, 3], w) for w in track.wheels), key=lambda p: -float(p[0][0]))
    found = [("shoe", "one of a closed row", shoes)]
    if high and len(placed) >= 3:
        top = max(placed, key=lambda each: float(each[0][2]))
        (_, front), *inner = (each for each in placed if each is not top)
        found += [
            ("sprocket", "the wheel on top of the track", [top[1].members]),
            ("idler", "the front wheel of the track", [front.members]),
            ("roller", "one on the lower run, front to rear,", [w.members for p, w in inner if p[2] < middle[2]]),
            ("carrier", "one under the upper run, front to rear,", [w.members for p, w in inner if p[2] >= middle[2]]),
        ]
    elif len(placed) >= 2:
        (_, front), *inner, (_, rear) = placed
        sprocket, idler = (front, rear) if front.rim < rear.rim - PLAIN else (rear, front)
        teeth = "the toothed wheel" if abs(front.rim - rear.rim) > PLAIN else "the rear wheel"
        found += [
            ("sprocket", f"{teeth} at an end of the track", [sprocket.members]),
            ("idler", "the other wheel at an end of the track", [idler.members]),
            ("roller", "one on the lower run, front to rear,", [w.members for p, w in inner if p[2] < middle[2]]),
            ("carrier", "one under the upper run, front to rear,", [w.members for p, w in inner if p[2] >= middle[2]]),
        ]
    return found


def upright(tracks: list[Track]) -> Floats | None:
    """The direction across the tracks and their length."""
    return np.asarray(np.cross(tracks[0].axis, tracks[0].along), dtype=np.float64) if tracks else None


def tracks_in(assembly: Assembly, template: Template) -> tuple[dict[int, str], list[Track]]:
    """The parts of tracks, solid → id, and the tracks, where the template has any."""
    return _tracks(assembly) if any(r.kind == "shoe" for r in template.roles) else ({}, [])


@remembered
def _tracks(assembly: Assembly) -> tuple[dict[int, str], list[Track]]:
    solids = solids_of(assembly)
    tracks = tracks_of(solids)
    inside = {i for t in tracks for group in (*t.shoes, *(w.members for w in t.wheels)) for i in group}
    return {i: solids[i].part.id for i in sorted(inside)}, tracks
