"""The search for the labelling that the judge scores highest.

The score is a Markov random field with counted joints: exact solvers take minutes for it where nothing is whole, so it
is annealed (Geman & Geman 1984), piece by piece from its full conditional distribution and, now and then, by moves that
single pieces could not make one after the other: two bodies change places, or a piece and its mirror image become one
body, or its left and right twins. Several chains are annealed at once, which costs little more than one, and the best
one is taken: one alone often ends beside it. The random numbers are fixed: the same labelling every time.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from yellowiron.alignment.fusion.judge import KINDS, Field, Ints, score_of, scores_of
from yellowiron.model.geometry import Floats

HOT, COLD = 40.0, 2.0
"""Temperatures, in the score's units, that annealing begins and ends with."""
SWEEPS = 80
PATIENCE = 25
"""After so many sweeps that found nothing better it is cooled at once: of 173 annealings one ended beside its best."""
LAST = 6
"""So many sweeps without temperature end it."""
MOVES = 12
"""So many times two bodies change places, and two mirror images are tried as another body, after every sweep; of a few
pieces, half as many times as there are pieces."""
AT_ONCE = 6
"""So many of either kind are tried from the same labels."""
CHAINS = 12
WARM, WARM_UP = 14, 16.0
"""So many sweeps, from this temperature, tell how good a variant is beside another, from whose labels they begin."""
SEED = 1
SAME, JOINED, ALIKE, UNPAIRED, FARTHER, NEAR, EXACT = range(7)
"""What a piece's bonds count: as in `Field.weights`, for its body being the farther one, nearly held, and exactly held
as the first of `KINDS` (the others follow)."""


class Annealing:
    """The state of `n` chains: their labels (n, pieces), and how often each joint is held, nearly and exactly (2, n,
    joints + 1: the last is none), and each body played (n, labels). Its arrays are as the inner loop reads them: this
    is where recognition spends its time."""

    def __init__(self, field: Field, labels: Ints) -> None:
        self.field = field
        chains, (pieces, count) = len(labels), field.unary.shape
        at = [np.flatnonzero((field.ends == p).any(axis=1)) for p in range(pieces)]
        self._others = [
            np.where(field.ends[bonds, 0] == p, field.ends[bonds, 1], field.ends[bonds, 0])
            for p, bonds in enumerate(at)
        ]
        self._columns = [
            np.vstack(
                [
                    field.weights[bonds].T,
                    np.where(field.ends[bonds, 1] == p, 1.0, -1.0) * field.order[bonds],
                    field.near[bonds],
                    field.exact[bonds].T,
                ]
            )
            for p, bonds in enumerate(at)
        ]
        self._rows = np.arange(chains)
        self._row_at = self._rows * count
        self._places = np.tile(np.arange(count), chains)
        self._same = np.ones(count)
        self._same[-1] = 0.0
        self._joined = (field.joint < field.joints).astype(np.float64)
        self._twins = field.twins.astype(np.float64)
        self._unpaired = field.unpaired.astype(np.float64)
        self._astray = [np.flatnonzero(row) for row in field.astray]
        # Of two labels there is one joint at most: its ends, and which labels it is at.
        first, second = np.nonzero(np.triu(field.joint < field.joints))
        ends = np.zeros((field.joints, 2), dtype=np.int64)
        ends[field.joint[first, second]] = np.column_stack([first, second])
        own, other = ends.T.ravel(), ends[:, ::-1].T.ravel()
        self._gains = np.eye(count)[own]
        # Where, in what is around a piece, stands what holds each joint, nearly and exactly: its one end here, then its
        # other.
        kinds = np.stack([np.full(2 * field.joints, NEAR), EXACT + np.tile(field.kind[:-1], 2)])
        self._holds = (kinds[:, None] * chains + self._rows[:, None]) * count + other
        self._from, self._to = self._at_joints()
        self._each = np.array(field.held)[:, None, None]
        # What a piece has no bonds for counts nothing.
        self._alike, self._paired, self._ordered = (
            frozenset(p for p, columns in enumerate(self._columns) if columns[what].any())
            for what in (ALIKE, UNPAIRED, FARTHER)
        )
        self._settled: Ints | None = None
        self.take(labels)

    def _at_joints(self) -> tuple[Ints, Ints]:
        """(n * labels, 2, m) by chain and label: where, in what is around a piece, stands what holds the label's `m`
        joints nearly and exactly, and where that is counted; of labels with fewer joints, the others are none."""
        field, chains, count = self.field, len(self._rows), len(self.field.joint)
        joined = field.joint < field.joints
        other = np.argsort(~joined, axis=1, kind="stable")[:, : int(joined.sum(axis=1).max())]
        joint = np.take_along_axis(field.joint, other, axis=1)
        kinds = np.stack([np.full_like(joint, NEAR), EXACT + field.kind[joint]], axis=1)
        what = kinds * chains * count + other[:, None]
        to = np.stack([joint, joint + chains * (field.joints + 1)], axis=1)
        each = self._rows[:, None, None, None]
        shape = (chains * count, 2, other.shape[1])
        return (each * count + what).reshape(shape), (each * (field.joints + 1) + to).reshape(shape)

    def take(self, labels: Ints) -> None:
        """Goes on from these labels."""
        field, (pieces, count) = self.field, self.field.unary.shape
        self.labels = labels.copy()
        self._is = np.zeros((pieces, len(labels) * count))
        self._is[np.arange(pieces), self._row_at[:, None] + labels] = 1.0
        held = field.joint[labels[:, field.ends[:, 0]], labels[:, field.ends[:, 1]]]
        exact = field.exact[np.arange(held.shape[1]), field.kind[held]]
        counted = [np.broadcast_to(field.near, held.shape), exact]
        self.held = np.stack([self._counted(held, weights, field.joints + 1) for weights in counted])
        self.played = self._is.sum(axis=0).reshape(len(labels), count)

    def _counted(self, numbers: Ints, weights: np.ndarray[Any, np.dtype[Any]], count: int) -> Floats:
        """(n, count) the sum of `weights` (n, m) by the `numbers` (n, m) they have, row by row."""
        rows = len(self._rows)
        flat = (numbers + count * self._rows[:, None]).ravel()
        return np.bincount(flat, weights=weights.ravel(), minlength=rows * count).reshape(rows, count).astype(float)

    def _around(self, p: int) -> Floats:
        """(what is counted, n, labels) what the bonds of a piece count, by the label of what they lead to."""
        found = self._columns[p] @ self._is.take(self._others[p], axis=0)
        return np.asarray(found.reshape(EXACT + len(KINDS), *self.played.shape))

    def _add(self, p: int, around: Floats, sign: int) -> None:
        """Counts a piece, with its labels, or (-1) no longer."""
        at = self._row_at + self.labels[:, p]
        # A joint stands once in a row; none may stand there often, and nothing reads its count.
        to, held = self._to.take(at, axis=0), self.held.reshape(-1)
        what = around.take(self._from.take(at, axis=0))
        held[to] = held.take(to) + what if sign > 0 else held.take(to) - what
        self.played.reshape(-1)[at] += sign
        self._is[p][at] = 1.0 if sign > 0 else 0.0

    def conditional(self, p: int) -> Floats:
        """(n, labels) what each label of piece p would score, all others as they are, up to a constant. The counts are
        left without the piece; `put` adds it again."""
        field = self.field
        around = self._around(p)
        self._add(p, around, -1)
        scores = field.unary[p] + field.played * (self.played == 0)
        if len(off := self._astray[p]):
            scores += field.halves * (field.astray[p].take(off) @ self._is.take(off, axis=0)).reshape(scores.shape)
        scores += around[SAME] * self._same
        beside = around[JOINED] @ self._joined
        if p in self._alike:
            beside += around[ALIKE] @ self._twins
        if p in self._paired:
            beside += around[UNPAIRED] @ self._unpaired
        if p in self._ordered:
            beside += around[FARTHER] @ field.farther
        scores += beside
        # What holding each joint would add: nothing where one holds it.
        gain = around.take(self._holds)
        np.minimum(gain, 1.0, out=gain)
        ends = gain.reshape(2, len(scores), 2, field.joints)  # each joint from its one end, then from its other
        ends *= (self._each * (self.held <= 0))[:, :, None, :-1]
        scores += (gain[0] + gain[1]) @ self._gains
        self._last = around
        return np.asarray(scores)

    def put(self, p: int, labels: Ints) -> None:
        """Gives piece p its labels (n,), after `conditional`."""
        self.labels[:, p] = labels
        self._add(p, self._last, 1)

    def sweep(self, temperature: float, rng: np.random.Generator) -> None:
        """Every piece once, in a random order; without temperature: to its best label."""
        order = rng.permutation(self.labels.shape[1]).tolist()
        if temperature > 0:
            noise = temperature * rng.gumbel(size=(len(order), *self.played.shape))
            for p, more in zip(order, noise, strict=True):
                self.put(p, np.argmax(self.conditional(p) + more, axis=1))
        elif self._settled is None or not np.array_equal(self._settled, self.labels):
            before = self.labels.copy()
            for p in order:
                self.put(p, np.argmax(self.conditional(p), axis=1))
            # Where nothing changed, nothing will in any order.
            self._settled = self.labels.copy() if np.array_equal(before, self.labels) else None

    @np.errstate(divide="ignore", invalid="ignore")
    def move(self, temperature: float, rng: np.random.Generator) -> Floats:
        """Tries two bodies in each other's place, and two mirror images as another body, several times (Metropolis): so
        many `AT_ONCE` from where a chain stands, of which it goes the first that it may. Returns what the labels score
        (n,)."""
        labels, scores, rows = self.labels, scores_of(self.field, self.labels), self._rows
        tries = min(MOVES, max(2, labels.shape[1] // 2))
        for start in range(0, tries, AT_ONCE):
            count = min(AT_ONCE, tries - start)
            others = self._swapped(labels, rng, count)
            if len(self.field.mirrored):
                others = np.concatenate([others, self._mirrored(labels, rng, count)])
            changed = scores_of(self.field, others.reshape(-1, labels.shape[1])).reshape(len(others), -1)
            gain = changed - scores
            taken = np.asarray((gain > 0) | (gain > np.log(rng.random(gain.shape)) * temperature))
            first = np.argmax(taken, axis=0)
            goes = taken[first, rows]
            labels = np.where(goes[:, None], others[first, rows], labels)
            scores = np.where(goes, changed[first, rows], scores)
        self.take(labels)
        return np.asarray(scores)

    def _swapped(self, labels: Ints, rng: np.random.Generator, count: int) -> Ints:
        """(count, n, pieces) the labels with the body of one piece in another one's place, and the other in its."""
        rows, none, shape = self._rows, len(self.field.bodies), (count, len(labels))
        one = labels[rows, rng.integers(labels.shape[1], size=shape)]
        two = np.where(one == none, none, rng.integers(none, size=shape))
        places = np.tile(self._places, (count, 1))
        at = np.arange(count)[:, None]
        places[at, self._row_at + one], places[at, self._row_at + two] = two, one
        return places.take(self._row_at[:, None] + labels, axis=1)

    def _mirrored(self, labels: Ints, rng: np.random.Generator, count: int) -> Ints:
        """(count, n, pieces) the labels with a piece and its mirror image as another body, or as its twins."""
        shape, at = (count, len(labels)), np.arange(count)[:, None]
        pair = self.field.mirrored[rng.integers(len(self.field.mirrored), size=shape)]
        one = rng.integers(len(self.field.bodies) + 1, size=shape)
        other = np.tile(labels, (count, 1, 1))
        other[at, self._rows, pair[..., 0]] = one
        other[at, self._rows, pair[..., 1]] = self.field.twin[one]
        return other


def labelled(
    field: Field, start: Ints | None = None, *, hot: float = HOT, sweeps: int = SWEEPS, chains: int = CHAINS
) -> tuple[Ints, float]:
    """The best labelling found (pieces,) by so many chains, and its score. From a `start`, it is only warmed to `hot`
    first, in so many `sweeps`; without any, it is mended piece by piece."""
    rng = np.random.default_rng(SEED)
    first = np.argmax(field.unary, axis=1) if start is None else start
    state = Annealing(field, np.tile(first, (chains, 1)))
    best, score = first, score_of(field, first)
    waited = 0
    for temperature in [*np.geomspace(hot, COLD, sweeps), *[0.0] * LAST]:
        if temperature > 0.0 and waited >= PATIENCE:
            continue
        state.sweep(float(temperature), rng)
        reached = state.move(float(temperature), rng) if sweeps else scores_of(field, state.labels)
        waited += 1
        if reached.max() > score:
            best, score, waited = state.labels[int(np.argmax(reached))].copy(), float(reached.max()), 0
    for order in field.sides:
        if (other := score_of(field, order[best])) > score:
            best, score = order[best], other
    return best, score


def leads(field: Field, labels: Ints) -> tuple[Floats, Ints]:
    """(pieces,) by how much each label is better than the piece's next best, all others as they are; and that one."""
    state = Annealing(field, labels[None])
    lead, second = np.zeros(len(labels)), np.zeros(len(labels), dtype=np.int64)
    for p in range(len(labels)):
        scores = state.conditional(p)[0]
        own = scores[labels[p]]
        scores[labels[p]] = -np.inf
        second[p] = int(np.argmax(scores))
        lead[p] = own - scores[second[p]]
        state.put(p, labels[p : p + 1])
    return lead, second


def against(field: Field, labels: Ints, told: Floats) -> Floats:
    """(pieces,) by how much another label would be better than a piece's own, all others as they are, if what it was
    `told` (pieces, labels) did not count; below 0, everything else agrees."""
    state = Annealing(field, labels[None])
    found = np.zeros(len(labels))
    for p in range(len(labels)):
        scores = state.conditional(p)[0]
        scores[:-1] -= told[p]
        own = scores[labels[p]]
        scores[labels[p]] = -np.inf
        found[p] = scores.max() - own
        state.put(p, labels[p : p + 1])
    return found
