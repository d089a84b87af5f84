"""What speaks for two pieces being one body, or turning on each other: contacts, shared axes, assemblies, twins."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from yellowiron.alignment.assignment.directions import ALIKE, NOT_ACROSS
from yellowiron.alignment.assignment.names import own_words, unnamed
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.stance import Stance
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.alignment.structure.observation import Observation

REACH = 0.004
"""Pieces this near, in machine sizes, are neighbours (4 cm on 10 m)."""
FEW = 0.15
"""A name of more than this share of the pieces says nothing of which belong together."""
ASIDE = 0.02
"""Twins are this near to each other's mirror image, in machine sizes."""
AHEAD, OUT = 0.25, 0.02
"""What is this far ahead of the middle of a machine's stand, or behind it, in its sizes, and more of its surface than
this share, has a middle of its own …"""
APART = (0.01, 0.12)
"""… if it is so far from the machine's, in its sizes: farther to one side is another machine."""
BESIDE = 2.0
"""What is of one half of a hydraulic cylinder is off the line of its longest bar by no more than so many of its widths
(ports, pipes along it, clamps), and no farther beyond its ends than this share of its length."""
ENOUGH = 8.0
"""Of what is only called alike, or lies in one assembly, so many others say as much as any more would."""
MOST = 0.6
"""A cluster of more than this share of the machine's surface says nothing of what belongs together."""
SMALL = 0.34
"""An assembly of more than this share of the pieces says nothing …"""
ALL_OVER = 0.9
"""… nor one that reaches over this share of the machine's length, width and height: it is no body."""


@dataclass(frozen=True)
class Bond:
    """Pieces `a` < `b`: `same`, what speaks for their being one body; `beside`, whether they are neighbours; `hinge`,
    whether an exact axis runs through both, and, of linkages that work a tool, one that lies across the machine
    (`level`), of frames on each other, one that does not (`turned`); `slide`, whether they are seen to be barrel and
    rod.

    `branch`: 1 where `b` is the child of `a` in the scene's tree, -1 where it is the parent; `alike`: whether they are
    one shape, mirrored: of one body, or of twins; `paired`: whether they are bars of one shape left and right of the
    machine's middle, or of that of what reaches out of it: no halves of two cylinders, unless these are twins.

    `same` has `beside` (1: neighbours), `flat` (how much of the smaller one lies flat on the other, 0 to 1), `sunk`
    (the share of one inside of the other), `welded` (one cluster of what the contacts alone found), `kin` (one assembly
    that is a small part of the machine), `branch` and `stem` (one name but for its number); these two count less in
    large groups."""

    a: int
    b: int
    same: Mapping[str, float]
    beside: bool
    hinge: bool
    slide: bool
    branch: int = 0
    alike: bool = False
    level: bool = False
    turned: bool = False
    paired: bool = False


def bonds_of(observation: Observation, pieces: Sequence[Piece], structure: Structure, stance: Stance) -> list[Bond]:
    """The bonds of all pairs of pieces that are neighbours, kin, or on one axis. `structure`: the clusters that the
    contacts alone gave; `stance`: how the machine stands."""
    piece_of = {i: k for k, p in enumerate(pieces) for i in p.members}
    flat: dict[tuple[int, int], float] = {}
    for f in observation.flats:
        if f.a in piece_of and f.b in piece_of and piece_of[f.a] != piece_of[f.b]:
            key = _pair(piece_of[f.a], piece_of[f.b])
            flat[key] = flat.get(key, 0.0) + f.area
    hinged = _hinged(observation, piece_of, stance)
    slides = _slides(pieces)
    kin = _kin(observation, pieces)
    gaps = _gaps(observation, pieces)
    welded = _welded(observation, structure)
    stems = _stems(observation, pieces)
    twins, paired = _mirrored(pieces, stance), _paired(pieces, stance)
    pairs = [(piece_of[i], piece_of[j]) for i, j in observation.branches if i in piece_of and j in piece_of]
    tree = {_pair(child, parent): 1 if child > parent else -1 for child, parent in pairs if child != parent}
    found = []
    for a, b in sorted({*flat, *hinged, *slides, *kin, *stems, *twins, *paired, *gaps, *tree}):
        same = {"branch": float((a, b) in tree)}
        same |= {"kin": kin.get((a, b), 0.0), "stem": stems.get((a, b), 0.0)}
        if (a, b) in gaps:
            least = min(pieces[a].area, pieces[b].area)
            i, j = min(pieces[a].members), min(pieces[b].members)
            single = len(pieces[a].members) == len(pieces[b].members) == 1
            sunk = gaps[a, b] == 0.0 and single
            same |= {
                "beside": 1.0,
                "flat": float(np.sqrt(min(1.0, 6.0 * flat.get((a, b), 0.0) / max(least, 1e-12)))),
                "welded": float(i in welded and welded[i] == welded.get(j)),
                "sunk": max(observation.touch.sunk(i, j), observation.touch.sunk(j, i)) if sunk else 0.0,
            }
        same = {key: value for key, value in same.items() if value}
        across = hinged.get((a, b), ())
        found.append(
            Bond(
                a, b, same, (a, b) in gaps, (a, b) in hinged, (a, b) in slides, tree.get((a, b), 0), (a, b) in twins,
                level=any(cosine > ALIKE for cosine in across), turned=any(cosine < NOT_ACROSS for cosine in across),
                paired=(a, b) in paired,
            )
        )  # fmt: skip
    return found


def _welded(observation: Observation, structure: Structure) -> dict[int, int]:
    """Solid → its cluster of what the contacts alone found, without clusters of most of the machine (`MOST`): of bodies
    that slide on each other, and of pins that are not drawn, contacts make one."""
    surface = [sum(observation.solids[i].surface for i in sorted(c.members)) for c in structure.clusters]
    total = sum(s.surface for s in observation.solids)
    return {i: c for c, cluster in enumerate(structure.clusters) if surface[c] <= MOST * total for i in cluster.members}


def _stems(observation: Observation, pieces: Sequence[Piece]) -> dict[tuple[int, int], float]:
    """Pairs of pieces whose names differ in their numbers alone, where few pieces have that name (`_together`); those
    that a modelling tool gave say nothing."""
    groups: dict[str, set[int]] = {}
    silent = unnamed(s.part.name for s in observation.solids)
    for k, piece in enumerate(pieces):
        own = {observation.solids[i].part.name for i in piece.members} - silent
        names = {stem_of(name) for name in own}
        for name in names - {""}:
            groups.setdefault(name, set()).add(k)
    return _together(groups.values(), max(2, FEW * len(pieces)))


def stem_of(name: str) -> str:
    """A name by its words, whatever their order and spelling, without its numbers and what a modelling tool adds; one
    that has nothing else as it is."""
    return " ".join(own_words(name)) or re.sub(r"[\W\d_]+", "", name.casefold())


def _together(groups: Iterable[set[int]], most: float) -> dict[tuple[int, int], float]:
    """Pairs of pieces of one group of no more than so many → how much of a bond that is, 0 to 1: a piece of a large
    group is bound to all of it by no more than `ENOUGH` bonds."""
    found: dict[tuple[int, int], float] = {}
    for group in groups:
        if 1 < len(group) <= most:
            share = min(1.0, ENOUGH / (len(group) - 1))
            for pair in itertools.combinations(sorted(group), 2):
                found[pair] = max(found.get(pair, 0.0), share)
    return found


def _mirrored(pieces: Sequence[Piece], stance: Stance, middle: float = 0.0) -> set[tuple[int, int]]:
    """Pairs of pieces of one shape on the two sides of what is so far to the left of the machine's middle, in machine
    sizes."""
    found = set()
    places = np.array([stance.place(p.center) for p in pieces]).reshape(-1, 3) - np.array([0.0, middle, 0.0])
    for a, one in enumerate(pieces):
        mirrored = places[a] * np.array([1.0, -1.0, 1.0])
        near = np.linalg.norm(places - mirrored, axis=1) < ASIDE
        for b in np.flatnonzero(near).tolist():
            other = pieces[b]
            equal = abs(one.area - other.area) < 0.03 * one.area
            if a < b and equal and np.allclose(one.spread, other.spread, rtol=0.03, atol=0.002 * stance.size):
                found.add((a, b))
    return found


def _paired(pieces: Sequence[Piece], stance: Stance) -> set[tuple[int, int]]:
    """Pairs of bars of one shape on the two sides of the machine, or of what reaches out of it."""
    middles = (0.0, *_middles_of_what_reaches_out(pieces, stance))
    pairs = {pair for middle in middles for pair in _mirrored(pieces, stance, middle)}
    return {(a, b) for a, b in pairs if pieces[a].is_bar and pieces[b].is_bar}


def _middles_of_what_reaches_out(pieces: Sequence[Piece], stance: Stance) -> list[float]:
    """How far to the left of the machine's middle that of what is in front of its stand is, and that of what is behind,
    in machine sizes: booms stand beside the cab, and what hangs on them is in pairs left and right of their middle.
    None of what is in the middle, or too far from it (`APART`)."""
    places = np.array([stance.place(p.samples) for p in pieces]).reshape(-1, 3)
    weights = np.repeat([p.area / len(p.samples) for p in pieces], [len(p.samples) for p in pieces])
    found = []
    for out in (places[:, 0] > AHEAD, places[:, 0] < -AHEAD):
        if weights[out].sum() > OUT * weights.sum():
            found.append(float(weights[out] @ places[out, 1] / weights[out].sum()))
    return [middle for middle in found if APART[0] <= abs(middle) <= APART[1]]


def out_of_line(pieces: Sequence[Piece]) -> NDArray[np.bool_]:
    """(pieces, pieces) whether two cannot be of one half of a hydraulic cylinder: one is a bar, the longer of the two,
    and the other off its line."""
    found = np.zeros((len(pieces), len(pieces)), dtype=np.bool_)
    centers = np.array([p.center for p in pieces]).reshape(-1, 3)
    lengths = np.array([p.spread[0] for p in pieces])
    widths = np.array([p.spread[1] for p in pieces])
    for a, bar in enumerate(pieces):
        if not bar.slender:
            continue
        delta = centers - bar.center
        along = delta @ bar.axes[0]
        off = np.linalg.norm(delta - np.outer(along, bar.axes[0]), axis=1)
        away = (off > BESIDE * bar.spread[1] + 0.5 * np.minimum(widths, bar.spread[1])) | (
            np.abs(along) > 0.5 * lengths + (0.5 + 0.25 * BESIDE) * bar.spread[0]
        )
        found[a] |= away & (lengths <= bar.spread[0])
    return found | found.T


def _pair(a: int, b: int) -> tuple[int, int]:
    return (a, b) if a < b else (b, a)


def _hinged(
    observation: Observation, piece_of: dict[int, int], stance: Stance
) -> dict[tuple[int, int], tuple[float, ...]]:
    """Pairs of pieces that exact axes of the contacts run through → how far each lies across the machine (cosine)."""
    on: dict[int, set[int]] = {}
    if not observation.evidence:
        return {}
    evidence = observation.evidence[-1]
    for i, axes in sorted(evidence.pinned.items()):
        for k in axes:
            if i in piece_of:
                on.setdefault(k, set()).add(piece_of[i])
    found: dict[tuple[int, int], tuple[float, ...]] = {}
    for k, group in sorted(on.items()):
        cosine = abs(float(np.asarray(evidence.axes[k].direction) @ stance.left))
        for pair in itertools.combinations(sorted(group), 2):
            found[pair] = (*found.get(pair, ()), cosine)
    return found


def _slides(pieces: Sequence[Piece]) -> set[tuple[int, int]]:
    """Pairs seen to be a barrel and its rod; and slender pieces in line that reach into each other."""
    found: set[tuple[int, int]] = set()
    for a, one in enumerate(pieces):
        for b, other in enumerate(pieces[a + 1 :], a + 1):
            halves = {one.kind, other.kind} == {"barrel", "rod"} and one.number == other.number
            bars = not one.kind and not other.kind and one.slender and other.slender
            if halves or (bars and _in_line(one, other)):
                found.add((a, b))
    return found


def _in_line(one: Piece, other: Piece) -> bool:
    """True for two bars on one line that overlap along it, neither inside of the other's whole length."""
    if abs(float(one.axes[0] @ other.axes[0])) < 0.99:
        return False
    delta = other.center - one.center
    along = float(delta @ one.axes[0])
    off = float(np.linalg.norm(delta - along * one.axes[0]))
    reach = 0.5 * (one.spread[0] + other.spread[0])
    return off < 0.5 * max(one.spread[1], other.spread[1]) and abs(along) < reach * 1.1


def _kin(observation: Observation, pieces: Sequence[Piece]) -> dict[tuple[int, int], float]:
    """Pairs of pieces of the same innermost assembly that is a small part of the machine (`_together`)."""
    groups: dict[tuple[str, ...], set[int]] = {}
    for k, piece in enumerate(pieces):
        for i in piece.members:
            path = observation.solids[i].part.path
            if path:
                groups.setdefault(path, set()).add(k)
    low, high = np.array([p.low for p in pieces]), np.array([p.high for p in pieces])
    whole = np.ptp([*low, *high], axis=0)

    def all_over(group: set[int]) -> bool:
        chosen = sorted(group)
        return bool((high[chosen].max(axis=0) - low[chosen].min(axis=0) > ALL_OVER * whole).all())

    small = [group for group in groups.values() if not all_over(group)]
    return _together(small, max(2, SMALL * len(pieces)))


def _gaps(observation: Observation, pieces: Sequence[Piece]) -> dict[tuple[int, int], float]:
    """Pairs of neighbours → the metres between them."""
    reach = REACH * observation.size
    low = np.array([p.low for p in pieces]).reshape(-1, 3)
    high = np.array([p.high for p in pieces]).reshape(-1, 3)
    found: dict[tuple[int, int], float] = {}
    solids = observation.solids
    for a in range(len(pieces)):
        close = (low[a + 1 :] - reach <= high[a]).all(axis=1) & (high[a + 1 :] + reach >= low[a]).all(axis=1)
        for b in (np.flatnonzero(close) + a + 1).tolist():
            least = np.inf
            for i in sorted(pieces[a].members):
                for j in sorted(pieces[b].members):
                    apart = np.maximum(solids[i].low - solids[j].high, solids[j].low - solids[i].high).max()
                    if apart <= reach and least > 0.0:
                        least = min(least, observation.touch.distance(min(i, j), max(i, j)))
            if least <= reach:
                found[a, b] = float(least)
    return found
