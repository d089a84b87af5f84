"""Parts that are written in another unit than the rest of their file: a boom in inches among parts in millimetres.

Such a part floats, or is larger than the machine, and where it is put in the file's unit again, about the file's origin
or its node's own, it is inside the machine and fits: its flat and round faces lie on its neighbours', or another part
of the machine is exactly like it. A sound part passes for one hardly ever: to come to lie in the machine ten times as
large, it must be within a tenth of the machine about the origin.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from yellowiron.alignment.assignment.unit_scale import UNITS, farther, larger
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.ground import grounds_of
from yellowiron.alignment.features.solids import Solid, solids_of
from yellowiron.alignment.tolerances import CONTACT, FACING, FAR, PARALLEL, TWIN
from yellowiron.model.alignment import DECIDED, Alignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Shape

FEWEST = 8
"""So many parts a machine has at least of which some are in another unit: of fewer, nobody knows which are."""
MOST = 0.34
"""No more than this share of the parts are in another unit."""
BEYOND = 4.0
"""What is so many times as far from the middle as all that is nearer is no part of the machine as it stands."""
SMALL = 1e-3
"""Nothing that is mended is smaller than this share of the machine's size."""
SURELY = 9.0
"""Enlarged by less than this, many a part stays inside the machine: it must fit twice."""
BY_CHANCE = 20.0
"""… and from this on it is in the wrong place whatever it touches there."""
ENOUGH = 3
"""What is enlarged until it is in the machine fits one part or two there by chance."""
GIANT = 1.5
"""What is so many times as large as all the rest together is out of scale."""
PLAIN = 12
"""Boxes are like each other by chance."""
ALIKE = 2e-3
"""Two surfaces are of one shape if they are equal within this share."""
PROUD = 0.5
"""A part may stand out from the box around all others by this share of their size."""
UNDER = 0.01
"""What would have the middle of no part this share of the machine's size under it would still be its ground."""
CLOSE = 0.01
"""Faces lie on each other within this share of a small part's size, too."""
ROUNDS = 3
"""Parts that touch only each other are mended one after the other."""
DOUBT = 0.5
_ABOUT = {False: "the file's", True: "its node's"}
LOST = "it is out of all scale, and no unit explains it"
DOUBTED = "it touches nothing of the rest, and may be in another unit than the rest"
RATIOS = tuple(sorted({float(f"{a / b:.12g}") for a, b in itertools.permutations(UNITS.values(), 2)}))
"""What a part is to be enlarged by that was written in one unit and read in another."""
_RATIOS = np.array(RATIOS)


@dataclass(frozen=True)
class OtherUnits:
    """What is taken for another unit: part id → what it was enlarged by, and in words why; `lost`: parts that no unit
    explains, though they can be no part of the machine as they stand; `doubted`: parts that touch nothing
    but each other, and would touch several in another unit."""

    mended: Mapping[str, tuple[float, str]] = field(default_factory=dict)
    lost: tuple[str, ...] = ()
    doubted: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Guess:
    """A part in another unit: enlarged by `ratio`, about its node's `own` origin or the file's."""

    ratio: float
    own: bool


def in_one_unit(assembly: Assembly) -> tuple[Assembly, OtherUnits]:
    """The model with parts that are written in another unit than the rest put in its unit, and which they are. The
    same object if there are none."""
    parts = [p for p in assembly.parts if len(assembly.shape_of(p).mesh.points)]
    if len(parts) < FEWEST or assembly.joints:
        return assembly, OtherUnits()
    boxes = _Boxes([assembly.points_of(p) for p in parts])
    guesses = {i: g for i in range(len(parts)) if (g := boxes.guesses(i, parts[i].transform[:3, 3]))}
    if not guesses and boxes.core.all():
        return assembly, OtherUnits()
    suspects = {parts[i].id for i, some in guesses.items() if any(g.ratio >= SURELY and not g.own for g in some)}
    mended: dict[str, tuple[float, str]] = {}
    drawn = assembly
    for _ in range(ROUNDS):
        rest = _Rest(assembly, [p.id for k, p in enumerate(parts) if boxes.core[k] or p.id in mended], boxes.size)
        found = {}
        now = {p.id: p for p in assembly.parts}
        for i in (i for i in guesses if parts[i].id not in mended):
            best = rest.best(now[parts[i].id], guesses[i], out=boxes.out(i), suspects=suspects)
            if best is not None:
                found[parts[i].id] = best
        if not found:
            break
        assembly = _mended(assembly, {part: guess for part, (guess, _) in found.items()})
        suspects -= found.keys()
        mended |= {part: (guess.ratio, words) for part, (guess, words) in found.items()}
    if len(mended) > MOST * len(parts):
        return drawn, OtherUnits()
    left = [(k, p.id) for k, p in enumerate(parts) if p.id not in mended]
    lost = tuple(part for k, part in left if boxes.lost(k))
    doubted = rest.doubted({part: guesses[k] for k, part in left if k in guesses})
    return assembly, OtherUnits(mended, lost, doubted)


def reviewed(found: Alignment, assembly: Assembly, units: OtherUnits) -> Alignment:
    """The alignment with what was mended, or is lost, told and listed for review. `assembly` is the model as it was
    solved: a part may have come apart, and its pieces bear its id."""
    whole = dict.fromkeys(units.doubted, DOUBTED) | dict.fromkeys(units.lost, LOST)
    whole |= {part: words for part, (_, words) in units.mended.items()}
    if not whole:
        return found
    of = {p.id: part for p in assembly.parts for part in whole if p.id == part or p.id.startswith(f"{part}/")}
    labels = tuple(
        replace(p, confidence=min(p.confidence, DOUBT), reason=f"{p.reason}; but {whole[of[p.part]]}")
        if p.part in of and p.source not in DECIDED
        else p
        for p in found.parts
    )
    listed = [p.part for p in labels if p.part in of and p.source not in DECIDED]
    where, findings = found.equipment_type, list(found.findings)
    hint = "Look whether they are as they should be, and export all parts in one unit."
    for words in sorted({words for _, words in units.mended.values()}):
        some = sorted(part for part, (_, w) in units.mended.items() if w == words)
        text = f"{len(some)} parts are in another unit than the rest, {words}: {', '.join(some[:5])}"
        findings.append(Finding("ALN033", "warning", where, text + (", …" if len(some) > 5 else ""), hint))
    told = (
        (units.lost, "are out of all scale, and no unit explains it"),
        (units.doubted, "touch nothing of the rest, and may be in another unit"),
    )
    for ids, words in told:
        text = f"{len(ids)} parts {words}: {', '.join(ids[:5])}" + (", …" if len(ids) > 5 else "")
        findings += [Finding("ALN033", "warning", where, text, hint)] if ids else []
    return replace(
        found, parts=labels, findings=tuple(findings), to_review=tuple(dict.fromkeys((*found.to_review, *listed)))
    )


class _Boxes:
    """The boxes of parts, by number: which could be in another unit, by where they are."""

    def __init__(self, points: Sequence[Floats]) -> None:
        self.low = np.array([p.min(axis=0) for p in points])
        self.high = np.array([p.max(axis=0) for p in points])
        self._diagonals = np.linalg.norm(self.high - self.low, axis=1)
        self.core = _core(self.low, self.high)
        self._grounds = {k: _lying(points[k]) for k in grounds_of(points)}
        self._lowest = np.sort(self.low[self.core], axis=0)[:2]
        self._highest = np.sort(self.high[self.core], axis=0)[-2:]
        self.size = _diagonal(self.low[self.core], self.high[self.core])
        self._out: dict[int, bool] = {}

    def guesses(self, i: int, origin: Floats) -> list[_Guess]:
        """In which units a part would be inside the machine; `origin` (3,) is its node's."""
        slack = PROUD * self.size
        low, high = self._without(i)
        low, high = low - slack, high + slack
        diagonal = float(np.linalg.norm(self.high[i] - self.low[i]))
        found = []
        large = _RATIOS * diagonal > SMALL * self.size
        for own in (False, True) if origin.any() else (False,):
            about = origin if own else np.zeros(3)
            within = (about + _RATIOS[:, None] * (self.low[i] - about) >= low).all(axis=1)
            within &= (about + _RATIOS[:, None] * (self.high[i] - about) <= high).all(axis=1)
            ratios = [RATIOS[k] for k in np.flatnonzero(within & large).tolist()]
            found += [_Guess(r, own) for r in ratios if self._amid(i, about, r) and (r > 1.0 or self.out(i))]
        return sorted(found, key=lambda guess: (guess.ratio, guess.own))

    def _amid(self, i: int, about: Floats, ratio: float) -> bool:
        """Whether what lies under the machine would be in it, enlarged so about a point."""
        if i not in self._grounds:
            return True
        middle, normal = self._grounds[i]
        centres = 0.5 * (self.low[self.core] + self.high[self.core]) - (about + ratio * (middle - about))
        return bool(min((centres @ normal).max(), -(centres @ normal).min()) > UNDER * self.size)

    def out(self, i: int) -> bool:
        """True for what can be no part of the machine as it stands: as large as all the rest, or far from it."""
        if i not in self._out:
            self._out[i] = self._is_out(i)
        return self._out[i]

    def _is_out(self, i: int) -> bool:
        if self._giant(i) or not self.core[i]:
            return True
        apart = np.maximum(0.0, np.maximum(self.low - self.high[i], self.low[i] - self.high))
        beside = self.core & (np.einsum("ij,ij->i", apart, apart) <= (FAR * self.size) ** 2)
        beside[i] = False
        return not beside.any()

    def lost(self, i: int) -> bool:
        """True for what no machine's part can be, and no ground."""
        return i not in self._grounds and self._giant(i)

    def _giant(self, i: int) -> bool:
        low, high = self._without(i)
        return bool(np.linalg.norm(self.high[i] - self.low[i]) > GIANT * np.linalg.norm(high - low))

    def _without(self, i: int) -> tuple[Floats, Floats]:
        """(3,) corners of the box around the machine without a part."""
        low = np.where(self._lowest[0] < self.low[i], self._lowest[0], self._lowest[1 if self.core[i] else 0])
        high = np.where(self._highest[1] > self.high[i], self._highest[1], self._highest[0 if self.core[i] else 1])
        return low, high


def _lying(points: Floats) -> tuple[Floats, Floats]:
    """(3,) the middle of points, (n, 3), and the direction in which they are thinnest."""
    middle = points.mean(axis=0)
    return middle, np.linalg.eigh((points - middle).T @ (points - middle))[1][:, 0]


def _diagonal(low: Floats, high: Floats) -> float:
    return float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))


def _core(low: Floats, high: Floats) -> NDArray[np.bool_]:
    """(n,) the parts without those that are out of all scale."""
    middle = np.median(0.5 * (low + high), axis=0)
    far = np.linalg.norm(np.maximum(np.abs(low - middle), np.abs(high - middle)), axis=1)
    order = np.argsort(far, kind="stable")
    core = np.ones(len(far), dtype=bool)
    for k in range(int(np.ceil((1.0 - MOST) * len(far))), len(far)):
        if far[order[k]] > BEYOND * far[order[k - 1]]:
            core[order[k:]] = False
            break
    return core


class _Rest:
    """The machine that a part in another unit is to fit."""

    def __init__(self, assembly: Assembly, parts: Sequence[str], size: float) -> None:
        kept = set(parts)
        self._assembly = assembly
        self._solids = solids_of(replace(assembly, parts=tuple(p for p in assembly.parts if p.id in kept)))
        self._tolerance, self._exact = CONTACT[1] * size, CONTACT[0] * size
        self._ids = np.array([s.part.id for s in self._solids])
        self._low = np.array([s.low for s in self._solids]).reshape(-1, 3)
        self._high = np.array([s.high for s in self._solids]).reshape(-1, 3)
        self._triangles = np.array([len(s.shape.mesh.triangles) for s in self._solids])
        self._surfaces = np.array([s.surface for s in self._solids])
        self._volumes = np.array([s.volume for s in self._solids])
        self._of_count: dict[int, tuple[NDArray[np.intp], Floats]] = {}
        self._planes = np.array([k for k, s in enumerate(self._solids) for _ in s.plane_points], dtype=np.intp)
        self._points = np.concatenate([np.zeros((0, 3)), *(s.plane_points for s in self._solids)])
        self._normals = np.concatenate([np.zeros((0, 3)), *(s.plane_normals for s in self._solids)])
        turned = [(k, c) for k, s in enumerate(self._solids) for c in s.cylinders]
        self._turned = np.array([k for k, _ in turned], dtype=np.intp)
        self._centres = np.array([c.center for _, c in turned]).reshape(-1, 3)
        self._directions = np.array([c.direction for _, c in turned]).reshape(-1, 3)
        self._radii = np.array([c.radius for _, c in turned])

    def best(
        self, part: Part, guesses: Sequence[_Guess], *, out: bool, suspects: Collection[str]
    ) -> tuple[_Guess, str] | None:
        """The unit that a part is in, and in words why; None if it is sound, or nothing tells. `suspects`: ids of parts
        that may be in another unit themselves."""
        now = self._solid(part, self._assembly.shapes)
        twins = {guess: self._twin(now, guess.ratio) for guess in guesses}
        # About its own origin, or enlarged a little, a part stays in the machine: only what it is like tells.
        guesses = [g for g in guesses if twins[g] or out or (g.ratio >= SURELY and not g.own)]
        if not guesses or (not out and any(str(self._ids[k]) not in suspects for k in self._fitting(now))):
            return None
        floats = out or all(str(self._ids[k]) in suspects for k in self._touched(now))
        if not floats:
            guesses = [g for g in guesses if g.ratio >= BY_CHANCE and not g.own]
        ranked: list[tuple[int, int, _Guess, str]] = []
        for guess in guesses:
            solid, twin = self._solid(*_enlarged(part, self._assembly, guess)), twins[guess]
            times = max(guess.ratio, 1.0 / guess.ratio) if out or not guess.own else 1.0
            needed = ENOUGH if guess.ratio > 1.0 else 1 + (times < BY_CHANCE) + (times < SURELY)
            fitting = len(self._fitting(solid))
            fits = fitting + 2 * bool(twin) >= needed
            if not fits and not (out and guess.ratio < 1.0 / BY_CHANCE):
                continue  # what is enlarged inside the machine touches the more the larger it is
            touched = sum(1 for _ in self._touched(solid))
            words = f"{guess.ratio:.6g} times as large about {_ABOUT[guess.own]} origin it "
            if fits and (touched or (twin and times >= SURELY)):
                words += f"is like {twin} and fits {fitting} parts" if twin else f"fits {fitting} parts"
                ranked.append((1, touched + fitting + 2 * bool(twin), guess, words))
            elif touched > 1 and not fits:
                ranked.append((0, touched, guess, f"{words}touches {touched} parts"))
        ranked.sort(key=lambda item: (-item[0], -item[1]))
        if not ranked or (len(ranked) > 1 and ranked[1][:2] == ranked[0][:2]):
            return None
        return ranked[0][2], ranked[0][3]

    def doubted(self, guesses: Mapping[str, Sequence[_Guess]]) -> tuple[str, ...]:
        """Of parts that could be in another unit those that touch nothing but each other, and several parts if they are
        much enlarged."""
        part_of, shapes = self._assembly.part, self._assembly.shapes
        large = {p: [g for g in some if g.ratio >= BY_CHANCE and not g.own] for p, some in guesses.items()}
        large = {p: some for p, some in large.items() if some}
        beside = {p: {str(self._ids[k]) for k in self._touched(self._solid(part_of(p), shapes))} for p in large}
        alone = set(large)
        while held := {p for p in alone if beside[p] - alone}:
            alone -= held
        found = []
        for part in (p for p in large if p in alone):
            enlarged = (_enlarged(part_of(part), self._assembly, g) for g in large[part])
            if any(len(list(itertools.islice(self._touched(self._solid(*one)), 2))) > 1 for one in enlarged):
                found.append(part)
        return tuple(found)

    def _solid(self, part: Part, shapes: Mapping[str, Shape]) -> Solid:
        return solids_of(replace(self._assembly, parts=(part,), shapes=shapes))[0]

    def _near(self, solid: Solid) -> NDArray[np.bool_]:
        """(n,) of the machine's parts those whose boxes reach a part's, itself not."""
        low, high = solid.low - self._tolerance, solid.high + self._tolerance
        return np.asarray(
            (self._low <= high).all(axis=1) & (self._high >= low).all(axis=1) & (self._ids != solid.part.id)
        )

    def _touched(self, solid: Solid) -> Iterator[int]:
        """The parts of the machine that a part touches."""
        touch = Touch((*self._solids, replace(solid, index=len(self._solids))), self._tolerance)
        return (k for k in np.flatnonzero(self._near(solid)).tolist() if touch.touching(k, len(self._solids)))

    def _fitting(self, solid: Solid) -> set[int]:
        """The parts of the machine on whose flat or round faces a part's lie."""
        near, found = self._near(solid), set[int]()
        tolerance = min(self._exact, CLOSE * solid.size)
        rows = np.flatnonzero(near[self._planes])
        planes, points, normals = self._planes[rows], self._points[rows], self._normals[rows]
        # One face's middle is before the other part, at least.
        within = ((points >= solid.low - tolerance) & (points <= solid.high + tolerance)).all(axis=1)
        low, high = self._low[planes] - tolerance, self._high[planes] + tolerance
        for point, normal in zip(solid.plane_points, solid.plane_normals, strict=True) if len(rows) else ():
            facing = (normals @ normal < -FACING) & (np.abs((points - point) @ normal) <= tolerance)
            beside = within | ((point >= low) & (point <= high)).all(axis=1)
            found |= set(planes[facing & beside].tolist())
        some = np.flatnonzero(near[self._turned])
        for c in solid.cylinders if len(some) else ():
            delta = self._centres[some] - c.center
            along = np.abs(self._directions[some] @ c.direction) >= PARALLEL
            off = np.linalg.norm(delta - (delta @ c.direction)[:, None] * c.direction, axis=1)
            equal = np.abs(self._radii[some] - c.radius) <= np.maximum(tolerance, TWIN * c.radius)
            found |= set(self._turned[some[along & (off <= tolerance) & equal]].tolist())
        return found

    def _twin(self, solid: Solid, ratio: float) -> str | None:
        """A part of the machine that is exactly like a part so many times as large, or its mirror image."""
        count, surface, volume = len(solid.shape.mesh.triangles), ratio**2 * solid.surface, ratio**3 * solid.volume
        if count <= PLAIN:
            return None
        some = self._with_surface(count, (1.0 - 2.0 * ALIKE) * surface, (1.0 + 2.0 * ALIKE) * surface)
        alike = np.abs(self._surfaces[some] / surface - 1.0) <= ALIKE
        alike &= np.abs(self._volumes[some] - volume) <= 2 * ALIKE * self._volumes[some]
        alike &= self._ids[some] != solid.part.id
        return str(self._ids[some[alike].min()]) if alike.any() else None

    def _with_surface(self, count: int, least: float, most: float) -> NDArray[np.intp]:
        """The machine's parts of so many triangles whose surface is between two, m²."""
        if count not in self._of_count:
            of_count = np.flatnonzero(self._triangles == count)
            order = of_count[np.argsort(self._surfaces[of_count], kind="stable")]
            self._of_count[count] = (order, self._surfaces[order])
        order, surfaces = self._of_count[count]
        return order[slice(*np.searchsorted(surfaces, (least, most)))]


def _enlarged(part: Part, assembly: Assembly, guess: _Guess) -> tuple[Part, dict[str, Shape]]:
    """A part in the rest's unit, and its shape by its key."""
    key = f"{part.shape}x{guess.ratio:.9g}"
    transform = part.transform if guess.own else farther(part.transform, guess.ratio)
    return replace(part, shape=key, transform=transform), {key: larger(assembly.shape_of(part), guess.ratio, key)}


def _mended(assembly: Assembly, guesses: Mapping[str, _Guess]) -> Assembly:
    """The model with some parts in the rest's unit."""
    parts, shapes = [], dict(assembly.shapes)
    for part in assembly.parts:
        if part.id in guesses:
            part, own = _enlarged(part, assembly, guesses[part.id])
            shapes |= own
        parts.append(part)
    used = {p.shape for p in parts}
    return replace(assembly, parts=tuple(parts), shapes={k: s for k, s in shapes.items() if k in used})
