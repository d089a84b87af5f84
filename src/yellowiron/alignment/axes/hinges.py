"""Where two bodies are hinged, given the hinge's direction: what is round about one line in both, with what else says
where the line is (a cylinder's own line, pivots of the scene's tree, where the two bodies come near each other)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from yellowiron.alignment.axes.bodies import Body, axis_segment
from yellowiron.alignment.axes.values import Candidate, Line, Round, plane_of
from yellowiron.model.geometry import Floats

SAME_CENTRE = 0.15
"""Round things are about one pivot if their centres are this share of the smaller radius apart: pins and bores differ
by as much in models that are drawn to be looked at."""
NEAR = 0.02
"""What is further than this share of the machine's size from where two bodies meet speaks less for their hinge."""
AROUND = 0.04
"""Nothing further than this from where two bodies meet is looked at, in machine sizes."""
END = 1.5
"""How much more the round end of a body speaks for a pivot than something round anywhere else on it."""
STOUT = 0.004
"""A pivot with at least this radius, in machine sizes, is no bolt."""
RIVAL = 0.25
"""How much less than the best must speak for another line that it is no rival: a rival at that distance is as likely as
exp(−1)."""
OFF_LINE = 0.1
"""How much what is round in both bodies speaks for a hinge off the line of the cylinder: eyes may be bent away."""
PIVOT_QUALITY = 0.7
"""How much a pivot of the scene's tree speaks for a hinge where two bodies meet: of 30 in five models 28 were it."""
AT_PIVOT = 0.006
"""What is round within this share of the machine's size of such a pivot is about it."""
LEAST_QUALITY = 0.04
"""Below this the place where the bodies meet is the better guess."""
KEPT = 4
"""Candidates that are told besides the best."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """Where two bodies come near each other: points (n, 3) of either's surface, and how near (metres)."""

    points: Floats
    gap: float

    @property
    def center(self) -> Floats:
        """The middle of their box."""
        return np.asarray(0.5 * (self.points.min(axis=0) + self.points.max(axis=0)), dtype=np.float64)

    def box(self, margin: float) -> tuple[Floats, Floats]:
        """Their box (low, high), wider by a margin on every side."""
        return self.points.min(axis=0) - margin, self.points.max(axis=0) + margin


@dataclass(frozen=True, eq=False)
class Clues:
    """What else is known of a hinge: the `line` of the hydraulic cylinder that one of its bodies is of, with where on
    it its eye should be (`eye`, a coordinate along the line) and how well that is known (`room`, metres); `pivots`
    (n, 3) of either body's scene nodes, and how much of this machine's pivots is to be believed (`trust`, 0 to 1);
    round things of other parts that may be its pin (`bars`)."""

    line: Line | None = None
    eye: float = 0.0
    room: float = 0.0
    pivots: Floats | None = None
    trust: float = 1.0
    bars: tuple[Round, ...] = ()


@dataclass(frozen=True, eq=False)
class Spot:
    """A place that a hinge may be at: `center` (2,) in the plane across the direction, with what is round about it."""

    center: Floats
    score: float
    rounds: tuple[Round, ...]
    sides: int


def meeting_of(a: Body, b: Body) -> Meeting:
    """Where two bodies come nearest to each other."""
    few, many = (a, b) if len(a.samples) <= len(b.samples) else (b, a)
    distance, index = many.nearest(few.samples)
    gap = float(distance.min())
    close = distance <= 1.5 * gap + 0.006 * a.size
    points = np.concatenate([few.samples[close], many.samples[np.unique(index[close])]])
    return Meeting(points, gap)


def hinge_candidates(
    a: Body, b: Body, direction: Floats, clues: Clues | None = None, *, lean: float = 0.0
) -> list[Candidate]:
    """Lines along a unit direction that two bodies may be hinged about, the best first; there is always one. `lean` is
    the uncertainty of the direction, radians."""
    clues = clues or Clues()
    plane = plane_of(direction)
    meeting = meeting_of(a, b)
    guess = _guess(a, b, direction, plane, meeting, clues, lean)
    spots = _spots(a, b, direction, plane, meeting, clues, guess)
    found = [
        _candidate(spot, spots, direction, plane, meeting, clues, guess, lean, a.size) for spot in spots[: KEPT + 1]
    ]
    if not found or found[0].quality < LEAST_QUALITY:
        return [guess, *found[:KEPT]]
    return found


def _spots(
    a: Body, b: Body, direction: Floats, plane: Floats, meeting: Meeting, clues: Clues, guess: Candidate
) -> list[Spot]:
    """Every place about which something is round, the best first, one for each place."""
    box = meeting.box(AROUND * a.size)
    rounds = [(side, r) for side, body in enumerate((a, b)) for r in body.rounds(direction, box=box)]
    rounds += [(2, r) for r in clues.bars]
    at_pivots = [p for p in _pivot_spots(a, b, plane, meeting, clues) if p.score > guess.quality]
    if not rounds:
        return at_pivots
    center = np.array([plane @ r.face.center for _, r in rounds])
    along = np.array([float(r.face.center @ direction) for _, r in rounds])
    half = np.array([r.face.half for _, r in rounds])
    radius = np.array([r.face.radius for _, r in rounds])
    spread = np.array([r.spread for _, r in rounds])
    side = np.array([s for s, _ in rounds])
    stout = np.clip(radius / (STOUT * a.size), 0.3, 1.0)
    quality = np.array([r.quality for _, r in rounds]) * stout
    ends = np.array([axis_segment(r.face, 0.5 * r.face.radius) for _, r in rounds])
    bodies = (a, b, None)
    quality *= np.array([_is_end(bodies[s], center[k], r, direction, plane) for k, (s, r) in enumerate(rounds)])
    # How far each is from where the bodies meet.
    away = _nearest(meeting.points, ends)
    quality *= np.exp(-np.maximum(0.0, away - 1.5 * radius) / (NEAR * a.size))
    keep = quality > 0.02
    if not keep.any():
        return at_pivots
    rows = np.flatnonzero(keep)
    rounds = [rounds[k] for k in rows]
    center, along, half, radius = center[rows], along[rows], half[rows], radius[rows]
    spread, side, quality, ends = spread[rows], side[rows], quality[rows], ends[rows]
    apart = np.linalg.norm(center[:, None] - center[None], axis=2)
    least = np.minimum(radius[:, None], radius[None])
    slack = np.maximum(SAME_CENTRE * least, 2.0 * np.hypot(spread[:, None], spread[None]))
    slack = np.minimum(slack, 0.6 * least)
    gap = np.abs(along[:, None] - along[None]) - half[:, None] - half[None]
    together = np.exp(-0.5 * (apart / slack) ** 2) * np.exp(-np.maximum(gap, 0.0) / (4.0 * least))
    # What each of the bodies, and a pin of neither, has about each centre.
    # A bar of either is its pin less surely than one of neither: it may as well be a stay.
    pin = np.where(side == 2, 1.0, np.array([0.4 * (r.what == "pin") for _, r in rounds]))
    support = [
        _both_ends(together * quality[None] * share, along, radius) for share in (side == 0, side == 1, pin)
    ]  # fmt: skip
    drawn = (np.minimum(support[0], support[1]) > 0.4) * OFF_LINE
    # Around a bore or a pin is a lug, and so is inside of an outline; a full round may be either.
    wide = np.array([r.face.inner or r.face.full for _, r in rounds])
    narrow = np.array([not r.face.inner for _, r in rounds])
    span = np.stack([along - half - 2.0 * radius, along + half + 2.0 * radius], axis=1)
    for s, body in enumerate((a, b)):
        lacking = np.flatnonzero(support[s] < 0.4 * support[1 - s])
        rings = ((1.4 * radius, wide), (0.6 * radius, narrow))
        cover = np.max(
            [
                body.covered(center[lacking], ring[lacking], span[lacking], direction, plane) * of[lacking]
                for ring, of in rings
            ],
            axis=0,
        )
        own = 0.5 * cover * np.maximum(support[1 - s], 0.6 * support[2])[lacking]
        support[s][lacking] = np.maximum(support[s][lacking], own)
    score = 0.5 * (support[0] + support[1]) + 0.25 * support[2]
    score *= np.maximum(_on_line(center, direction, plane, clues, a.size), drawn)
    away = np.linalg.norm(center - plane @ guess.origin, axis=1)
    score *= 0.5 + 0.5 * np.exp(-0.5 * (away / (2.0 * guess.across)) ** 2)
    score += PIVOT_QUALITY * clues.trust * _at_pivots(center, plane, clues, a.size)
    order = np.lexsort((np.arange(len(score)), -np.round(score, 9)))
    spots: list[Spot] = []
    for k in order:
        if any(np.linalg.norm(spot.center - center[k]) < max(slack[k, k], 0.3 * radius[k]) for spot in spots):
            continue
        members = np.flatnonzero((together[k] > 0.2) & (apart[k] <= slack[k]))
        sides = len({int(side[m]) for m in members} - {2})
        middle = _fused(center[members], spread[members])[0]
        spots.append(Spot(middle, float(score[k]), tuple(rounds[m][1] for m in members), sides))
    # What is round at a pivot is more exact than it.
    spots += [p for p in at_pivots if all(np.linalg.norm(p.center - s.center) > 0.5 * AT_PIVOT * a.size for s in spots)]
    return sorted(spots, key=lambda spot: -round(spot.score, 9))


def _pivot_spots(a: Body, b: Body, plane: Floats, meeting: Meeting, clues: Clues) -> list[Spot]:
    """The pivots of the scene's tree that both bodies reach, those near to where they meet first."""
    if clues.pivots is None or not len(clues.pivots):
        return []
    flat = clues.pivots @ plane.T
    beyond = np.max([np.asarray(cKDTree(body.samples @ plane.T).query(flat)[0]) for body in (a, b)], axis=0)
    away = cKDTree(meeting.points @ plane.T).query(flat)[0]
    score = PIVOT_QUALITY * clues.trust * np.exp(-((beyond / (0.5 * NEAR * a.size)) ** 2))
    score *= 0.5 + 0.5 * np.exp(-((away / (2.0 * NEAR * a.size)) ** 2))
    order = np.argsort(-np.round(score, 9), kind="stable")
    return [Spot(flat[k], float(score[k]), (), 0) for k in order if score[k] > LEAST_QUALITY]


def _both_ends(support: Floats, along: Floats, radius: Floats) -> Floats:
    """(n,) the support (n, m) of the best for each place; more where another, apart along the axis, says the same (the
    two cheeks of a fork)."""
    best = np.argmax(support, axis=1)
    first = support[np.arange(len(support)), best]
    apart = np.abs(along[None] - along[best][:, None]) > 1.0 * radius[best][:, None]
    second = np.where(apart, support, 0.0).max(axis=1)
    return np.asarray(first + 0.5 * second * (1.0 - np.minimum(first, 1.0)), dtype=np.float64)


def _is_end(body: Body | None, center: Floats, r: Round, direction: Floats, plane: Floats) -> float:
    """More than 1 for the round end of a body: its outline goes no further there."""
    if body is None or r.face.inner or r.face.full:
        return 1.0
    ways, reach = body.outline(direction, plane)
    beyond = reach - ways @ center
    return END if (beyond < 1.15 * r.face.radius).mean() > 0.12 else 1.0


def _nearest(points: Floats, ends: Floats) -> Floats:
    """(n,) the distance of axis segments (n, 5, 3) from points (m, 3)."""
    return np.asarray(np.min(cKDTree(points).query(ends)[0], axis=1), dtype=np.float64)


def _on_line(center: Floats, direction: Floats, plane: Floats, clues: Clues, size: float) -> Floats:
    """(n,) in (0, 1]: whether places (n, 2) are on the cylinder's line, near its end."""
    line = clues.line
    if line is None:
        return np.ones(len(center))
    way = plane @ line.direction
    length = float(np.linalg.norm(way))
    if length < 0.5:
        return np.ones(len(center))
    way = way / length
    delta = center - plane @ line.origin
    off = np.abs(delta @ np.array([-way[1], way[0]]))
    reach = np.abs(delta @ way)
    spread = np.hypot(np.hypot(line.across, 0.3 * line.width) + 0.001 * size, line.angle * reach)
    place = (delta @ way) / length
    # Off the line is wrong; off the end happens: an eye that is not drawn, a trunnion.
    lengthwise = 1.0 / (1.0 + ((place - clues.eye) / (2.0 * max(clues.room, 0.7 * line.width))) ** 2)
    return (0.1 + 0.9 * np.exp(-0.5 * (off / spread) ** 2)) * (0.15 + 0.85 * lengthwise)


def _at_pivots(center: Floats, plane: Floats, clues: Clues, size: float) -> Floats:
    """(n,) in [0, 1]: whether a pivot of the scene's tree is at places (n, 2)."""
    if clues.pivots is None or not len(clues.pivots):
        return np.zeros(len(center))
    flat = clues.pivots @ plane.T
    apart = np.linalg.norm(center[:, None] - flat[None], axis=2).min(axis=1)
    return np.asarray(np.exp(-0.5 * (apart / (0.5 * AT_PIVOT * size)) ** 2), dtype=np.float64)


def _fused(center: Floats, spread: Floats) -> tuple[Floats, float]:
    """The mean of centres (n, 2) by inverse variance, and its one-sigma: wider where they do not agree (R. T. Birge,
    Phys. Rev. 40, 1932)."""
    weight = 1.0 / spread**2
    middle = weight @ center / weight.sum()
    own = 1.0 / math.sqrt(float(weight.sum()))
    if len(center) < 2:
        return np.asarray(middle, dtype=np.float64), own
    chi = float((weight * ((center - middle) ** 2).sum(axis=1)).sum()) / (2 * (len(center) - 1))
    return np.asarray(middle, dtype=np.float64), own * math.sqrt(max(1.0, chi))


def _candidate(
    spot: Spot, spots: Sequence[Spot], direction: Floats, plane: Floats, meeting: Meeting, clues: Clues,
    guess: Candidate, lean: float, size: float,
) -> Candidate:  # fmt: skip
    if spot.rounds:
        center = np.array([plane @ r.face.center for r in spot.rounds])
        middle, across = _fused(center, np.array([r.spread for r in spot.rounds]))
        across = max(1.5 * across, 1e-4 * size) if spot.sides == 2 else max(2.5 * across, 3e-4 * size)
    else:
        middle, across = spot.center, 0.3 * AT_PIVOT * size
    rivals = [other for other in spots if other is not spot]
    for other in rivals:
        likely = math.exp(min(0.0, (other.score - spot.score) / (RIVAL * max(spot.score, 1e-9))))
        apart = float(np.linalg.norm(other.center - middle))
        if spot.sides < 2 and apart < max((r.face.radius for r in other.rounds), default=0.0):
            # The other body's own, but not in line with it: which of them is drawn out of place is not told.
            likely = 1.0
        if likely > 0.1:
            across = math.hypot(across, 0.5 * likely * apart)
    # Where little speaks for it, so it may be where the bodies meet.
    likely = math.exp(min(0.0, (guess.quality - spot.score) / (RIVAL * max(spot.score, 1e-9))))
    across = math.hypot(across, 0.5 * likely * float(np.linalg.norm(plane @ guess.origin - middle)))
    what = sorted({r.what for r in spot.rounds})
    bodies = {0: "a pin", 1: "one body", 2: "both bodies"}[spot.sides]
    how = f"{' and '.join(what)} of {bodies}" if what else "a pivot of the scene's tree where the two bodies meet"
    if what and clues.pivots is not None and _at_pivots(middle[None], plane, clues, size)[0] > 0.5:
        how += " at a pivot of the scene's tree"
    height = float(meeting.center @ direction)
    return Candidate(middle @ plane + height * direction, direction, across, lean, min(1.0, spot.score), how)


def _guess(
    a: Body, b: Body, direction: Floats, plane: Floats, meeting: Meeting, clues: Clues, lean: float
) -> Candidate:
    """Where the bodies come nearest to each other; of a cylinder's end on its line."""
    flat = meeting.points @ plane.T
    middle = 0.5 * (np.percentile(flat, 5, axis=0) + np.percentile(flat, 95, axis=0))
    reach = float(np.linalg.norm(np.ptp(flat, axis=0))) / 2
    across = max(0.35 * reach, 0.003 * a.size) + meeting.gap
    quality, how = 0.12, "where the two bodies come nearest to each other"
    line = clues.line
    if line is not None and np.linalg.norm(plane @ line.direction) > 0.5:
        way = plane @ line.direction
        along = float((middle - plane @ line.origin) @ way / (way @ way))
        # By inverse variance, along the line.
        trust = across**2 / (across**2 + clues.room**2)
        place = trust * clues.eye + (1 - trust) * along
        middle = plane @ line.origin + place * way
        across = math.hypot(max(1.2 * clues.room, 0.5 * abs(clues.eye - place)), line.across)
        how, quality = "where the cylinder ends at the other body", 0.15
    height = float(meeting.center @ direction)
    return Candidate(middle @ plane + height * direction, direction, across, lean, quality, how, rests_on_round=False)


def bars_between(a: Body, b: Body, others: Sequence[Body], direction: Floats) -> tuple[Round, ...]:
    """The pins and round bars of other bodies that are near both."""
    low, high = np.maximum(a.low, b.low) - 0.01 * a.size, np.minimum(a.high, b.high) + 0.01 * a.size
    found = []
    for other in others:
        for r in other.rounds(direction, box=(low, high), outlines=False):
            if not r.face.inner and r.face.full and 2 * r.face.half > r.face.radius:
                ends = axis_segment(r.face)
                if (ends.max(axis=0) < low).any() or (ends.min(axis=0) > high).any():
                    continue
                if max(float(a.distance(ends).min()), float(b.distance(ends).min())) < 1.5 * r.face.radius:
                    found.append(r)
    return tuple(found)


def eye_of(
    line: Line, outer: Body, halves: Sequence[Body], other: Body, direction: Floats, ahead: float
) -> tuple[float, float]:
    """Where along a cylinder's line the eye of its body `outer` is, and how well that is known (metres): as far within
    its tip as it is wide there; anywhere near it where no eye is drawn. `halves` are both its bodies, and
    `ahead` is 1 for the rod, −1 for the barrel."""
    points = np.concatenate([body.samples for body in halves])
    along = ahead * line.along(points)
    tip = float(along.max())
    across = np.cross(direction, line.direction)
    across = across / max(float(np.linalg.norm(across)), 1e-9)
    off = np.abs((points - line.origin) @ across)
    wide = float(np.percentile(off[along > tip - 2.0 * line.width], 90))
    wide = min(max(wide, 0.5 * line.width), 2.5 * line.width)
    own = float(np.percentile(np.abs((outer.samples - line.origin) @ across), 60))
    gap = meeting_of(outer, other).gap
    if wide < 1.3 * own and ahead > 0:
        # A bare bar's end: its eye is not drawn.
        return tip, 2.5 * own + gap
    return ahead * (tip - wide), 0.5 * wide + 0.5 * gap
