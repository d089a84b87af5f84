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
LAST = 6
"""So many sweeps without temperature end it."""
MOVES = 12
"""So many times two bodies change places, and two mirror images are tried as another body, after every sweep; of a few
pieces, half as many times as there are pieces."""
CHAINS = 12
WARM, WARM_UP = 14, 16.0
"""So many sweeps, from this temperature, tell how good a variant is beside another, from whose labels they begin."""
SEED = 1
SAME, JOINED, ALIKE, UNPAIRED, FARTHER, NEAR, EXACT = range(7)
"""What a piece's bonds count: as in `Field.weights`, for its body being the farther one, nearly held, and exactly held
as the first of `KINDS` (the others follow)."""


class Annealing:
    """The state of `n` chains: their labels (n, pieces), and how often each joint is held (n, joints + 1: the last is
    none) and each body played (n, labels). Its arrays are as the inner loop reads them: this is where recognition
    spends its time."""

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
        self._same = np.ones(count)
        self._same[-1] = 0.0
        self._joined = (field.joint < field.joints).astype(np.float64)
        self._twins = field.twins.astype(np.float64)
        self._unpaired = field.unpaired.astype(np.float64)
        self._astray = frozenset(np.flatnonzero(field.astray.any(axis=1)).tolist())
        # Of two labels there is one joint at most: its ends, and which labels it is at.
        first, second = np.nonzero(np.triu(field.joint < field.joints))
        ends = np.zeros((field.joints, 2), dtype=np.int64)
        ends[field.joint[first, second]] = np.column_stack([first, second])
        own, other = ends.T.ravel(), ends[:, ::-1].T.ravel()
        self._gains = np.eye(count)[own]
        # Where, in what is around a piece, stands what holds each joint: its one end here, or the other.
        there = self._rows[:, None] * count + other
        self._nearly = NEAR * chains * count + there
        self._exactly = (EXACT + np.tile(field.kind[:-1], 2)) * chains * count + there
        self._exact_at = (EXACT + field.kind[field.joint]) * chains * count + np.arange(count)
        # Where a chain's own counts begin, of joints and of labels.
        self._joints_at = self._rows[:, None] * (field.joints + 1)
        self._labels_at = self._rows[:, None] * count
        self.take(labels)

    def take(self, labels: Ints) -> None:
        """Goes on from these labels."""
        field, (pieces, count) = self.field, self.field.unary.shape
        self.labels = labels.copy()
        self._is = np.zeros((pieces, len(labels), count))
        self._is[np.arange(pieces), self._rows[:, None], labels] = 1.0
        held = field.joint[labels[:, field.ends[:, 0]], labels[:, field.ends[:, 1]]]
        exact = field.exact[np.arange(held.shape[1]), field.kind[held]]
        self.near = self._counted(held, np.broadcast_to(field.near, held.shape), field.joints + 1)
        self.exact = self._counted(held, exact, field.joints + 1)
        self.played = self._is.sum(axis=0)

    def _counted(self, numbers: Ints, weights: np.ndarray[Any, np.dtype[Any]], count: int) -> Floats:
        """(n, count) the sum of `weights` (n, m) by the `numbers` (n, m) they have, row by row."""
        rows = len(self._rows)
        flat = (numbers + count * self._rows[:, None]).ravel()
        return np.bincount(flat, weights=weights.ravel(), minlength=rows * count).reshape(rows, count).astype(float)

    def _around(self, p: int) -> Floats:
        """(what is counted, n, labels) what the bonds of a piece count, by the label of what they lead to."""
        others = self._is[self._others[p]]
        found = self._columns[p] @ others.reshape(len(others), self.played.size)
        return np.asarray(found.reshape(EXACT + len(KINDS), *self.played.shape))

    def _add(self, p: int, around: Floats, sign: int) -> None:
        """Counts a piece, with its labels, or (-1) no longer."""
        labels = self.labels[:, p]
        # A joint stands once in a row; the number for none may stand there often, and nothing reads its count.
        at = self.field.joint.take(labels, axis=0)
        at += self._joints_at
        of_kind = self._exact_at.take(labels, axis=0)
        of_kind += self._labels_at
        count = np.add if sign > 0 else np.subtract
        near, exact = self.near.reshape(-1), self.exact.reshape(-1)
        near[at] = count(near.take(at), around[NEAR])
        exact[at] = count(exact.take(at), around.reshape(-1).take(of_kind))
        self.played[self._rows, labels] += sign

    def conditional(self, p: int) -> Floats:
        """(n, labels) what each label of piece p would score, all others as they are, up to a constant. The counts are
        left without the piece; `put` adds it again."""
        field = self.field
        around = self._around(p)
        self._add(p, around, -1)
        self._is[p, self._rows, self.labels[:, p]] = 0.0
        scores = field.unary[p] + field.played * (self.played == 0)
        if p in self._astray:
            scores += field.halves * (field.astray[p] @ self._is.reshape(len(self._is), -1)).reshape(scores.shape)
        scores += around[SAME] * self._same
        scores += around[JOINED] @ self._joined + around[ALIKE] @ self._twins
        scores += around[UNPAIRED] @ self._unpaired + around[FARTHER] @ field.farther
        # What holding each joint would add: nothing where one holds it.
        near = field.held[0] * (self.near[:, :-1] <= 0)
        exact = field.held[1] * (self.exact[:, :-1] <= 0)
        flat = around.reshape(-1)
        gain, more = flat.take(self._nearly), flat.take(self._exactly)
        for held, open_joints in ((gain, near), (more, exact)):
            np.minimum(held, 1.0, out=held)
            ends = held.reshape(len(held), 2, field.joints)  # each joint from its one end, then from its other
            ends *= open_joints[:, None]
        gain += more
        scores += gain @ self._gains
        self._last = around
        return np.asarray(scores)

    def put(self, p: int, labels: Ints) -> None:
        """Gives piece p its labels (n,), after `conditional`."""
        self.labels[:, p] = labels
        self._is[p, self._rows, labels] = 1.0
        self._add(p, self._last, 1)

    def sweep(self, temperature: float, rng: np.random.Generator) -> None:
        """Every piece once, in a random order; without temperature: to its best label."""
        for p in rng.permutation(self.labels.shape[1]).tolist():
            scores = self.conditional(p)
            if temperature > 0:
                scores = scores + temperature * rng.gumbel(size=scores.shape)
            self.put(p, np.argmax(scores, axis=1))

    def move(self, temperature: float, rng: np.random.Generator) -> Floats:
        """Tries two bodies in each other's place, and two mirror images as another body, several times (Metropolis).
        Returns what the labels score (n,)."""
        labels, scores = self.labels, scores_of(self.field, self.labels)
        for _ in range(min(MOVES, max(2, labels.shape[1] // 2))):
            for other in (self._swapped(labels, rng), self._mirrored(labels, rng)):
                changed = scores if other is labels else scores_of(self.field, other)
                gain = changed - scores
                with np.errstate(divide="ignore"):
                    chance = np.log(rng.random(len(gain))) * temperature
                taken = (gain > 0) | (gain > chance)
                labels = np.where(taken[:, None], other, labels)
                scores = np.where(taken, changed, scores)
        self.take(labels)
        return np.asarray(scores)

    def _swapped(self, labels: Ints, rng: np.random.Generator) -> Ints:
        """The labels with the body of one piece in another one's place, and the other in its."""
        rows, none = np.arange(len(labels)), len(self.field.bodies)
        one = labels[rows, rng.integers(labels.shape[1], size=len(labels))][:, None]
        two = rng.integers(none, size=len(labels))[:, None]
        two = np.where(one == none, none, two)
        return np.where(labels == one, two, np.where(labels == two, one, labels))

    def _mirrored(self, labels: Ints, rng: np.random.Generator) -> Ints:
        """The labels with a piece and its mirror image as another body, or as its twins."""
        pairs = self.field.mirrored
        if not len(pairs):
            return labels
        rows = np.arange(len(labels))
        pair = pairs[rng.integers(len(pairs), size=len(labels))]
        one = rng.integers(len(self.field.bodies) + 1, size=len(labels))
        other = labels.copy()
        other[rows, pair[:, 0]] = one
        other[rows, pair[:, 1]] = self.field.twin[one]
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
    for temperature in [*np.geomspace(hot, COLD, sweeps), *[0.0] * LAST]:
        state.sweep(float(temperature), rng)
        reached = state.move(float(temperature), rng) if sweeps else scores_of(field, state.labels)
        if reached.max() > score:
            best, score = state.labels[int(np.argmax(reached))].copy(), float(reached.max())
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
