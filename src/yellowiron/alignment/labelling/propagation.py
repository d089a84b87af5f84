"""From bodies to every part: pins to their roles, then hardware, then whatever is left, nearest evidence first."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.assignment.names import exact_role, exact_roles
from yellowiron.alignment.features.contacts import Fit
from yellowiron.alignment.labelling.place import DOUBTFUL, Place, pin_role
from yellowiron.alignment.labelling.review import STURDY, has_tyre, next_bodies, solids_without_a_body
from yellowiron.alignment.labelling.suspects import Vacancies
from yellowiron.alignment.structure.observation import Observation
from yellowiron.alignment.tolerances import FAR
from yellowiron.model.geometry import Floats

SURE_LEAD = 60.0
"""What the judge finds this much better than anything else has a strength of 0.63, nearly twice this one half more."""
NEIGHBOURHOOD = 0.04
"""How far, in machine sizes, a floating part looks for a neighbour."""
CLOSE = 0.01
"""How far, in machine sizes, a floating part may be from its neighbour without a person's look …"""
LARGE = 0.05
"""… and how much of the surface it may have: more may be a body of its own."""
ALOOF = 0.4
"""How much less than with others a floating part goes with a hydraulic cylinder or a wheel."""
TORN = 0.5
"""What touches another body by more than this share of what it touches its own is for a person to look at."""
SUNK = 10.0
"""How much more what a part is wholly inside of counts than what it only touches."""
NAMED = 0.9
"""Confidence of a role whose very name the part bears, where geometry does not speak against it."""


@dataclass
class Propagation:
    """The state of the spreading: what each solid was found to be so far (`places`), the solids that no body is left
    for (`loose`), and those that stand `apart`, with the metres to the rest.

    `scores`: what the names say of each solid; `up`: the upright, CAD frame; `rivals`: cluster → the body it could as
    well be; `suspects`, `doubts`: body, and solid → why it is doubtful; `never`: solid → a body that it is not of."""

    observation: Observation
    answer: Answer
    scores: list[dict[str, float]]
    up: Floats
    rivals: Mapping[int, str | None] = field(default_factory=dict)
    suspects: Mapping[str, str] = field(default_factory=dict)
    never: Mapping[int, str] = field(default_factory=dict)
    doubts: Mapping[int, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.solids, self.touch = self.observation.solids, self.observation.touch
        self.structure, self.solution = self.answer.structure, self.answer.solution
        self.template = self.answer.template
        self.places: dict[int, Place] = {}
        self.loose = solids_without_a_body(self.solids, self.structure, self.solution)
        self.apart: dict[int, float] = {}
        self.vacancies = Vacancies(self.solids, self.answer)
        self.cluster_of = {b: c for c, b in self.solution.body_of.items()}
        self.assemblies: dict[tuple[str, ...], list[int]] = {}
        for solid in self.solids:
            self.assemblies.setdefault(solid.part.path, []).append(solid.index)

    def run(self) -> dict[int, Place]:
        """Every solid's place; solids that nothing speaks for are absent, and those far from all others (`apart`)."""
        self._bodies()
        self._torn()
        self._pins()
        self._hosted()
        self._by_contact()
        self._on_pins()
        self._by_contact()
        self._by_touch()
        self._by_exact_name()
        self._nearest()
        self._specific()
        for i, place in self.places.items():
            others = max((v for b, v in self.scores[i].items() if b != place.body), default=0.0)
            self.places[i] = replace(place, said=self.scores[i].get(place.body, 0.0) - others)
        return self.places

    # ---- the solved bodies ----
    def _bodies(self) -> None:
        if self.answer.judged is not None:
            for i, what in sorted(self.answer.judged.items()):
                sure = 0.98 * (1.0 - math.exp(-max(what.lead, 0.0) / SURE_LEAD))
                sure = sure if what.grounded else min(sure, DOUBTFUL)
                self.places[i] = Place(what.body, what.body, sure, what.words, what.second, how="judged")
            self.places |= self.vacancies.root()
            return
        second = next_bodies(self.structure, self.template, self.solution)
        for c, body in sorted(self.solution.body_of.items()):
            joints = [j for j in self.template.joints if body in self.template.bodies_of(j)]
            other, lead = second[c]
            solved = [j.name for j in joints if j.name in self.solution.hinge_of or j.name in self.solution.slide_of]
            share = len(solved) / len(joints) if joints else 0.0
            confidence = 0.4 + 0.58 * share if solved else 0.35
            words = f"{len(solved)} of {len(joints)} joints of {body} are found on its cluster"
            words += f": {', '.join(solved)}" if solved else ""
            if not self.solution.proven:
                confidence, words = min(confidence, 0.7), words + " (the search was cut short)"
            doubt = self.rivals.get(c) if c in self.rivals else None
            if c in self.rivals:
                confidence, words = min(confidence, 0.45), f"{words}; but it could as well be {doubt or 'none'}"
            if body in self.suspects:
                confidence, words = min(confidence, 0.45), f"{words}; but {self.suspects[body]}"
            for i in self.structure.clusters[c].members:
                rival = self._named_other(i, body)
                drop = 0.1 if rival else 0.0
                why = f"{words}; but {self.doubts[i]}" if i in self.doubts else words
                sure = min(confidence - drop, DOUBTFUL if i in self.doubts else 1.0)
                self.places[i] = Place(body, body, sure, why, doubt or rival or other, lead=lead)

    def _torn(self) -> None:
        """Parts that hold to two bodies about as firmly: the one chosen is a guess."""
        ties: dict[int, dict[str, float]] = {}
        for flat in self.observation.flats:
            for i, j in ((flat.a, flat.b), (flat.b, flat.a)):
                if i in self.places and j in self.places:
                    body = self.places[j].body
                    mine = ties.setdefault(i, {})
                    mine[body] = mine.get(body, 0.0) + flat.area
        for a, b, strength in self.structure.refused:
            i, j = sorted((a, b), key=lambda k: self.solids[k].volume)
            if i not in self.places or j not in self.places or self.places[i].body == self.places[j].body:
                continue
            place, other = self.places[i], self.places[j].body
            if strength > 0.5 * ties.get(i, {}).get(place.body, 0.0):
                words = f"{place.reason}; but it holds to {other} about as firmly"
                self.places[i] = replace(place, confidence=min(place.confidence, 0.45), reason=words, runner_up=other)

    def _named_other(self, i: int, body: str) -> str | None:
        """The body that the part's name speaks for, if it clearly speaks for another."""
        scores = self.scores[i]
        if not scores:
            return None
        best = max(sorted(scores), key=lambda b: scores[b])
        return best if best != body and scores[best] > scores.get(body, 0.0) + 0.4 else None

    # ---- pins ----
    def _pins(self) -> None:
        for joint in self.template.joints:
            hinge = self.solution.hinge_of.get(joint.name)
            role = pin_role(joint, self.template)
            if hinge is None or role is None:
                continue
            body = self.template.body_of(role) or role
            a, b = self.template.bodies_of(joint)
            self._race(self.structure.hinges[hinge].axis, role, body)
            for pin in self.structure.hinges[hinge].pins:
                if pin in self.places:
                    continue
                fits = self.structure.hosts[pin]
                gap = max(f.gap for f in fits)
                radius = max(f.shaft.radius for f in fits)
                sides = " on both sides" if self._both_sides(fits) else ""
                words = f"pin Ø{2e3 * radius:.4g} through bores of {a} and {b}{sides}"
                words += f", coaxial within {1e3 * gap:.2g} mm"
                share = min(self._sure(a), self._sure(b))
                self.places[pin] = Place(role, body, min(0.99, share + 0.01), words, how="pin")

    def _both_sides(self, fits: tuple[Fit, ...]) -> bool:
        """True if a body has bores on both sides of another's, along a pin."""
        along = fits[0].shaft.direction
        at: dict[str, list[float]] = {}
        for fit in fits:
            if fit.outer in self.places:
                at.setdefault(self.places[fit.outer].body, []).append(float(fit.bore.center @ along))
        pairs = [(x, y) for a, x in at.items() for b, y in at.items() if a != b]
        return any(min(x) < min(y) and max(y) < max(x) for x, y in pairs)

    def _race(self, axis: int, role: str, body: str) -> None:
        """Of a slewing bearing the race of the body that carries it is the joint's pin; where the race is drawn in one
        with other things, that part is no pin."""
        for i in self.structure.races.get(axis, ()):
            place = self.places.get(i)
            if place is not None and place.body == body and self.solids[i].axis is not None:
                self.places[i] = replace(place, role=role, reason=f"{place.reason}; a race of the bearing it turns in")

    def _sure(self, body: str | None) -> float:
        members = self.structure.clusters[self.cluster_of[body]].members if body in self.cluster_of else ()
        return max((self.places[i].confidence for i in members), default=0.5)

    def _hosted(self) -> None:
        """Bolts and shafts go with what they sit in."""
        for pin, fits in self.structure.hosts.items():
            if pin in self.places:
                continue
            votes: dict[str, float] = {}
            sure = 1.0
            for fit in fits:
                place = self.places.get(fit.outer)
                if place is not None:
                    votes[place.body] = votes.get(place.body, 0.0) + fit.overlap
                    sure = min(sure, place.confidence)
            if votes:
                self._vote(pin, votes, sure * 0.98, "sits in bores of {body}", "bores")
                self._unplayed(pin, set(votes))

    def _unplayed(self, pin: int, hosts: set[str]) -> None:
        """A pin as stout as the machine's, in a body that has a pin's role of its own left, may be that pin."""
        least = STURDY * min(
            (self.structure.axes[self.structure.hinges[h].axis].radius for h in self.solution.hinge_of.values()),
            default=0.0,
        )
        radius = max(f.shaft.radius for f in self.structure.hosts[pin])
        for joint in self.template.joints:
            role = pin_role(joint, self.template)
            if role is None or joint.name in self.solution.hinge_of or radius < least:
                continue
            if hosts & set(self.template.bodies_of(joint)):
                place = self.places[pin]
                words = f"{place.reason}; but it may be {role}, whose joint is not found"
                self.places[pin] = replace(
                    place, confidence=min(place.confidence, DOUBTFUL), reason=words, runner_up=role
                )
                return

    # ---- contact ----
    def _vote(self, i: int, votes: dict[str, float], best: float, words: str, how: str) -> None:
        ranked = sorted(votes, key=lambda b: (-round(votes[b], 9), b))
        total = sum(votes.values()) or 1.0
        share = votes[ranked[0]] / total
        second = ranked[1] if len(ranked) > 1 else None
        confidence = best * (0.55 + 0.45 * share if second else 1.0)
        if how == "touch" and second is not None and votes[second] > TORN * votes[ranked[0]]:
            confidence = min(confidence, DOUBTFUL)
        self._give(i, Place(ranked[0], ranked[0], confidence, words.format(body=ranked[0]), second, how=how))

    def _give(self, i: int, place: Place) -> None:
        """What could move on its own, or be a body that is missing, goes with a neighbour for want of a better place,
        for a person to look at."""
        if (other := self.vacancies.beside(place.body, i)) is not None:
            words = f"{place.reason}; but it may be {other}, which is not found"
            place = replace(place, confidence=min(place.confidence, DOUBTFUL), reason=words, runner_up=other)
        if i in self.loose:
            words = f"{place.reason}; but it could move on its own, and no body of the template is left for it"
            place = replace(place, confidence=min(place.confidence, DOUBTFUL), reason=words)
        self.places[i] = place

    def _groups(self) -> list[list[int]]:
        """Clusters and loose fasteners that are not placed yet."""
        loose = [sorted(c.members) for c in self.structure.clusters if not any(i in self.places for i in c.members)]
        inside = {i for c in self.structure.clusters for i in c.members}
        loose += [[s.index] for s in self.solids if s.index not in inside and s.index not in self.places]
        return sorted(loose)

    def _by_contact(self) -> None:
        """Flat contact with placed parts, spreading outward in rounds."""
        across: dict[int, list[tuple[int, float]]] = {}
        for flat in self.observation.flats:
            across.setdefault(flat.a, []).append((flat.b, flat.area))
            across.setdefault(flat.b, []).append((flat.a, flat.area))
        self._rounds(lambda i: self._akin(i, across.get(i, [])), 0.97, "lies flat against {body}", "flat")

    def _by_touch(self) -> None:
        """Meshes that touch or cut each other, parts counted, those that a part is sunk in for more."""
        beside: dict[int, list[int]] = {}
        for a, b in self.observation.near:
            beside.setdefault(a, []).append(b)
            beside.setdefault(b, []).append(a)

        def neighbours(i: int) -> list[tuple[int, float]]:
            found = [j for j in beside.get(i, []) if j in self.places and j not in self.structure.slight]
            found = [j for j in found if self.touch.touching(i, j)]
            found = [j for j, _ in self._akin(i, [(j, 1.0) for j in found])] or found
            if len({self.places[j].body for j in found}) < 2:
                return [(j, 1.0) for j in found]
            # Between bodies it counts how deep a part is in each.
            return [(j, 1.0 + SUNK * self.touch.sunk(i, j)) for j in found]

        self._rounds(neighbours, 0.92, "touches {body}", "touch")

    def _rounds(self, neighbours: Callable[[int], list[tuple[int, float]]], best: float, words: str, how: str) -> None:
        while True:
            found: list[tuple[list[int], dict[str, float], float]] = []
            for group in self._groups():
                votes: dict[str, float] = {}
                sure = 1.0
                for i in group:
                    for other, weight in neighbours(i):
                        place = self.places.get(other)
                        if place is None or (place.role != place.body and self._is_pin(other)):
                            continue
                        if any(self.never.get(member) == place.body for member in group):
                            continue
                        votes[place.body] = votes.get(place.body, 0.0) + weight
                        sure = min(sure, place.confidence)
                if votes:
                    found.append((group, self._with_names(group, votes), sure))
            if not found:
                return
            for group, votes, sure in found:
                for i in group:
                    self._vote(i, votes, best * sure, words, how)

    def _is_pin(self, i: int) -> bool:
        return i in self.structure.hosts

    def _with_names(self, group: list[int], votes: dict[str, float]) -> dict[str, float]:
        """Names and product structure tip the scales among bodies that geometry offers."""
        if len(votes) < 2:
            return votes
        total = sum(votes.values())
        scores = {b: sum(self.scores[i].get(b, 0.0) for i in group) / len(group) for b in votes}
        kin = self._kin(group[0])
        return {b: v + total * (0.8 * scores[b] + 0.5 * kin.get(b, 0.0)) for b, v in votes.items()}

    def _kin(self, i: int) -> dict[str, float]:
        """Share of each body among placed parts of the same assembly, where that assembly is mostly one body."""
        path = self.solids[i].part.path
        if len(path) < 2:
            return {}
        counts: dict[str, int] = {}
        for j in self.assemblies[path]:
            if j in self.places:
                counts[self.places[j].body] = counts.get(self.places[j].body, 0) + 1
        total = sum(counts.values())
        return {b: n / total for b, n in counts.items() if n > 0.6 * total} if total >= 3 else {}

    def _akin(self, i: int, neighbours: list[tuple[int, float]]) -> list[tuple[int, float]]:
        """Of a part's neighbours those of bodies that its assembly has parts of. Where contacts did not find the
        machine, lying against another assembly's part says less than that; who has no assembly is anybody's."""
        path = self.solids[i].part.path
        if self.answer.judged is None or len(path) < 2 or len(neighbours) == 0:
            return neighbours
        own = {self.places[j].body for j in self.assemblies[path] if j in self.places and j != i}
        alike = [(j, weight) for j, weight in neighbours if j in self.places and self.places[j].body in own]
        return alike if own else neighbours

    def _on_pins(self) -> None:
        """Rings, washers and keepers that only touch a pin go with the body that carries it."""
        around: dict[int, list[tuple[int, float]]] = {}
        for pin, fits in self.structure.hosts.items():
            for fit in fits:
                around.setdefault(fit.outer, []).append((pin, fit.overlap))
        for flat in self.observation.flats:
            for i, pin in ((flat.a, flat.b), (flat.b, flat.a)):
                if self._is_pin(pin):
                    around.setdefault(i, []).append((pin, flat.width))
        for group in self._groups():
            votes: dict[str, float] = {}
            sure = 1.0
            for i in group:
                for pin, weight in around.get(i, []):
                    place = self.places.get(pin)
                    if place is not None:
                        votes[place.body] = votes.get(place.body, 0.0) + weight
                        sure = min(sure, place.confidence)
            if votes:
                for i in group:
                    self._vote(i, votes, 0.9 * sure, "sits on a pin of {body}", "ring")

    def _by_exact_name(self) -> None:
        """Parts that bear a role's very name, where geometry found nothing of that body."""
        roles = exact_roles(self.template)
        for group in self._groups():
            for i in group:
                role = self._bears(i, roles)
                body = self.template.body_of(role) if role is not None else None
                if role is not None and body is not None and body not in self.cluster_of:
                    words = f"bears the name of the role {role}"
                    self.places[i] = Place(role, body, NAMED, words, by_name=True, how="name")

    def _nearest(self) -> None:
        """What floats goes with what is nearest, and with its assembly; what is far from everything is left out."""
        grown = bool(self.places)
        while grown:
            known = len(self.places)
            # Hoses run anywhere: what floats beside one need not be of the same body.
            placed, some = sorted(self.places), sorted(set(self.places) - self.structure.slight)
            self.apart = {}
            for group in self._groups():
                if not self._float(group, some):
                    self._float(group, placed)  # anything near says that it is no second machine
            grown = bool(self.apart) and len(self.places) > known

    def _float(self, group: list[int], placed: list[int]) -> bool:
        """Gives solids the place of the nearest of those `placed`; False where these are far."""
        if not placed:
            return False
        self.apart = {i: metres for i, metres in self.apart.items() if i not in group}
        low = np.array([self.solids[j].low for j in placed])
        high = np.array([self.solids[j].high for j in placed])
        size = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
        reach = NEIGHBOURHOOD * size
        far: dict[str, float] = {}
        sure: dict[str, float] = {}
        for i in group:
            s = self.solids[i]
            gap = np.linalg.norm(np.maximum(0, np.maximum(low - s.high, s.low - high)), axis=1)
            limit = max(reach, float(gap.min()) * 1.2)
            for k in np.flatnonzero(gap <= limit):
                j = placed[int(k)]
                body = self.places[j].body
                if gap[k] < far.get(body, np.inf):
                    metres = self.touch.distance(min(i, j), max(i, j))
                    if metres < far.get(body, np.inf):
                        far[body], sure[body] = metres, self.places[j].confidence
        if not far:
            return True
        if min(far.values()) > FAR * size:
            self.apart.update(dict.fromkeys(group, min(far.values())))
            return False
        # What cannot be of a body is near the machine all the same.
        never = {self.never.get(i) for i in group}
        far = {body: metres for body, metres in far.items() if body not in never}
        if min(far.values(), default=np.inf) > FAR * size:
            return True
        kin = self._kin(group[0])
        weight = {b: 1.0 / (d + 0.02 * reach) * (1 + 3 * kin.get(b, 0.0)) for b, d in far.items()}
        # What goes with a hydraulic cylinder or a wheel touches it.
        weight = {b: w * (ALOOF if self._turned(b) else 1.0) for b, w in weight.items()}
        names = {b: max(self.scores[i].get(b, 0.0) for i in group) for b in weight}
        weight = {b: w * (1 + 3 * names[b]) for b, w in weight.items()}
        ranked = sorted(weight, key=lambda b: (-round(weight[b], 9), b))
        rival = weight[ranked[1]] / weight[ranked[0]] if len(ranked) > 1 else 0.0
        # What floats is no surer than what it floats beside.
        confidence = min(0.45 + 0.45 * (1 - rival), sure[ranked[0]])
        surface = sum(self.solids[i].surface for i in group)
        large = surface > LARGE * sum(s.surface for s in self.solids)
        if large or (far[ranked[0]] > CLOSE * size and not self._borne(group, ranked[0])):
            confidence = min(confidence, DOUBTFUL)
        words = f"floats; {ranked[0]} is nearest, {1e3 * far[ranked[0]]:.3g} mm away"
        for i in group:
            second = ranked[1] if len(ranked) > 1 else None
            self._give(i, Place(ranked[0], ranked[0], confidence, words, second, how="near"))
        return True

    def _borne(self, group: list[int], body: str) -> bool:
        """Whether something long and thin of that body, which alone would not say where a part belongs, touches it."""
        thin = [j for j in self.structure.slight if j in self.places and self.places[j].body == body]
        return any(self.touch.touching(i, j) for i in group for j in thin)

    def _turned(self, body: str) -> bool:
        cluster = self.cluster_of.get(body)
        return cluster is not None and self.structure.clusters[cluster].kind != ""

    def _bears(self, i: int, roles: Mapping[str, str]) -> str | None:
        """The role whose very name a part bears, where the machine's names are to be believed."""
        role = exact_role(self.solids[i].part, roles)
        body = self.template.body_of(role) if role is not None else None
        return role if body is not None and self.scores[i].get(body, 0.0) > 1.0 else None

    # ---- the most specific role ----
    def _specific(self) -> None:
        """Tyres, edges, and exact names of roles that move with the body found."""
        roles, wheels = exact_roles(self.template), self.observation.wheels
        for i, place in sorted(self.places.items()):
            named = self._bears(i, roles)
            if place.role != place.body:
                continue  # a pin, by the bores it runs through
            if named is not None and self.template.body_of(named) == place.body:
                words = f"{place.reason}; bears the role's name"
                # A name settles between bodies, not whether the part is a pin besides, nor where all that was weighed
                # with it speaks as much for another body.
                torn = place.runner_up is not None and self.template.body_of(place.runner_up) == place.body
                judged = (self.answer.judged or {}).get(i)
                torn = torn or (judged is not None and not judged.grounded)
                sure = place.confidence if torn else max(place.confidence, NAMED)
                decided = place.confidence < sure
                self.places[i] = replace(place, role=named, confidence=sure, reason=words, by_name=decided)
        for role in self.template.roles:
            body = self.template.body_of(role.name)
            if role.rigid or body is None or any(p.role == role.name for p in self.places.values()):
                continue
            if role.kind == "tyre" and body in self.cluster_of:
                cluster = self.structure.clusters[self.cluster_of[body]]
                if cluster.kind == "wheel" and has_tyre(wheels[cluster.number], self.solids):
                    tyre = wheels[cluster.number].tyre
                    words = "the outermost ring of the wheel"
                    self.places[tyre] = replace(self.places[tyre], role=role.name, reason=words)
            elif role.kind == "edge" and (edge := self._edge(body)) is not None:
                words = f"the lowest part of {body} far from its hinge, over most of its width"
                self.places[edge] = replace(self.places[edge], role=role.name, reason=words)

    def _edge(self, body: str) -> int | None:
        """The lowest of the parts that span most of a body's width along its hinge and lie far out from it."""
        axes = [
            self.structure.axes[self.structure.hinges[self.solution.hinge_of[j.name]].axis]
            for j in self.template.joints
            if body in self.template.bodies_of(j) and j.name in self.solution.hinge_of
        ]
        members = [i for i, p in sorted(self.places.items()) if p.body == body and p.role == body]
        if not axes or not members:
            return None
        axis = axes[-1]
        spans = {i: self.solids[i].span(axis.origin, axis.direction) for i in members}
        width = max(b for _, b in spans.values()) - min(a for a, _ in spans.values())
        wide = [i for i in members if spans[i][1] - spans[i][0] > 0.75 * width]

        middle = {i: 0.5 * (self.solids[i].low + self.solids[i].high) for i in wide}
        far = max((axis.off(middle[i]) for i in wide), default=0.0)
        out = [i for i in wide if axis.off(middle[i]) > 0.7 * far]
        return min(out, key=lambda i: (round(float(middle[i] @ self.up), 6), i)) if len(wide) > 1 else None
