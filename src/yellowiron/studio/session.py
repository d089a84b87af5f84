"""The state of a studio: decisions, the machine that they make, and what is left to ask."""

from __future__ import annotations

import functools
import re
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from yellowiron import library, memory, report, specs
from yellowiron.alignment import as_said, decide, fits, read_alignment, write_alignment
from yellowiron.inputs import checked_inputs
from yellowiron.model.alignment import Alignment, Decisions, GivenValue, PartDecision
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose
from yellowiron.solved import Solved
from yellowiron.stages import roles_of, solve
from yellowiron.studio.journal import FILE, Journal
from yellowiron.studio.operations import SIGNED, Operation, from_entry
from yellowiron.studio.said import Said, said_after, said_in_file
from yellowiron.studio.setup import Setup
from yellowiron.studio.twins import twins_of
from yellowiron.support.caching.content import content_of
from yellowiron.support.guard import run_guarded
from yellowiron.support.output import output_file, output_folder

_CONTRADICTIONS = ("ALN026", "ALN027", "ALN028")
_IDLE = 2.0
"""Seconds without a word after which all variants are tried again."""

Measured = tuple[tuple[Measurement, ...], Mapping[str, Mapping[str, Floats]]]
"""What `kinematics.measure_and_pose` finds."""


@dataclass(frozen=True, eq=False)
class State:
    """What the decisions so far come to. `version` counts states, `said` the decisions that it knows of; `aligned` is
    the alignment as it is kept, of `aligned_model`, before the sheet moves an axis or the machine is started; `solved`
    is None where no mechanism can be made of it, and `failed` says why; `document` is the report's, of `facts`, and
    `poses` are those that measurements take (`kinematics.key_poses`); they are empty without a mechanism, and lack what
    is measured until `measured`, which may take seconds: the machine is shown before. `remarks`: what was said and
    contradicts what was said earlier, or what was found."""

    version: int
    said: int
    template: Template
    assembly: Assembly
    alignment: Alignment
    specifications: Specifications
    aligned: Alignment
    aligned_model: Assembly
    solved: Solved | None = None
    failed: str = ""
    document: Mapping[str, Any] = field(default_factory=dict)
    poses: Mapping[str, Mapping[str, Floats]] = field(default_factory=dict)
    facts: report.BuildFacts | None = None
    measured: bool = True
    remarks: tuple[str, ...] = ()

    def with_measured(self, measured: Measured) -> State:
        """The state with what was measured of its mechanism."""
        if self.facts is None:
            return self
        facts = replace(self.facts, measurements=measured[0])
        document = report.report_document(facts)
        return replace(self, document=document, poses=measured[1], facts=facts, measured=True)


class Session:
    """A machine under a person's hands. Every method may be called from any thread. A decision is on the disk when its
    method returns; what comes of it, `state` and `alignment.json`, follows, for several decisions at once where they
    come quickly. The variants that were found are kept while a person decides, which spares trying all others; when
    nothing was said for a moment they are tried again."""

    def __init__(
        self,
        setup: Setup,
        *,
        by: str = "",
        assembly: Assembly | None = None,
        progress: Callable[[str], None] = lambda words: None,
    ) -> None:
        """Reads the CAD model (or takes it as it was read, `assembly`) and the sheets, and takes up what was decided
        before. `by` signs what is decided. `YellowironError` for what a build would not take either."""
        self.setup = setup
        self.by = by
        self._heard = threading.Condition(threading.RLock())
        self._version = self._said = 0
        self._closed = False
        self._fixed: Mapping[str, str] = {}
        self._whole: Mapping[str, GivenValue] = {}
        # What is tried out while a pattern is written is not kept for ever.
        self._fitting = functools.lru_cache(maxsize=64)(
            lambda pattern: tuple(part.id for part in filter(fits(pattern), self.assembly.parts))
        )
        self._known: tuple[Mechanism, bytes, Measured] | None = None
        self._file = setup.out / "alignment.json"
        earlier = self._file if self._file.exists() else None
        inputs = checked_inputs(
            setup.equipment_type, setup.cad, setup.out, sheets=setup.sheets, alignment_file=earlier,
            documents=setup.documents, settings=setup.settings,
        )  # fmt: skip
        self._given, self._choices = inputs.given, inputs.choices
        progress("Reading the CAD model")
        read = memory.read_model(setup.cad, mirror=setup.mirror) if assembly is None else assembly
        self._bare = inputs.template
        self._read = read
        # What the alignment file says of joints is the first of what is said here.
        self._data = library.load_documents(setup.documents, inputs.template, read)
        self._template = library.apply_sensors(library.apply_joints(inputs.template, self._data), self._data)
        progress("Reading the specification sheets")
        self._sheet = memory.read_sheets(
            self._template, setup.sheets, config=setup.config, extractor="rules", model=None, progress=progress
        )
        progress("Finding the part that plays each role")
        self.assembly, _ = memory.find_roles(
            read, self._template, specs.merge(self._sheet, self._given),
            earlier=earlier, data=self._data, choices=self._choices,
        )  # fmt: skip
        self.parts = {part.id: number for number, part in enumerate(self.assembly.parts)}
        self._edits = (
            read_alignment(earlier, self.assembly, self._template)
            if earlier is not None
            else Alignment(self._template.equipment_type, np.eye(4), ())
        )
        with output_folder(setup.out):
            pass
        self._journal = Journal(setup.out / FILE, self.read)
        if not self._continues():
            self._journal.begin(said_in_file(self._edits).snapshot())
        self._show(self._solved({}))
        for work in (self._work, self._measure):
            threading.Thread(target=work, daemon=True).start()

    @property
    def template(self) -> Template:
        """The equipment type's template, with all of its variants."""
        return self._template

    # ---- what a person says ----
    def read(self, entry: object) -> Operation:
        """An operation of this machine's parts and roles."""
        return from_entry(entry, self.parts, self._template)

    def do(self, operation: Operation) -> int:
        """Makes a decision; how many there are now. `YellowironError` for one that cannot be, which then was not
        made."""
        signed = replace(operation, signature=replace(operation.signature, by=operation.signature.by or self.by))
        if signed.kind == "value" and signed.text:
            specs.parse_settings([f"{signed.name}={signed.text}"], self._template)
        if signed.kind == "joint" and signed.entry:
            self._documents({signed.name: signed.entry})
        with self._heard:
            self._journal.do(signed)
            return self._changed()

    def undo(self) -> int:
        """Takes the last decision back, if there is one."""
        with self._heard:
            return self._changed() if self._journal.undo() else self._said

    def redo(self) -> int:
        """Makes the decision that was taken back last again, if there is one."""
        with self._heard:
            return self._changed() if self._journal.redo() else self._said

    @property
    def said(self) -> int:
        """How many times something was decided, or taken back."""
        return self._said

    def settled(self, timeout: float | None = None) -> State:
        """The state that knows all that was said, when it is there, or after `timeout` seconds the last one."""
        with self._heard:
            self._heard.wait_for(lambda: self.state.said == self._said, timeout)
            return self.state

    def measured(self, timeout: float | None = None) -> State:
        """`settled`, when it is measured too."""
        with self._heard:
            self._heard.wait_for(lambda: self.state.said == self._said and self.state.measured, timeout)
            return self.state

    def close(self) -> None:
        """Ends the work in the background."""
        with self._heard:
            self._closed = True
            self._heard.notify_all()

    def fitting(self, pattern: str) -> tuple[str, ...]:
        """The parts that fit a pattern (`alignment.fits`), in the CAD model's order."""
        return self._fitting(pattern)

    def mirrored(self, entry: Mapping[str, Any]) -> Mapping[str, Any]:
        """An operation as the page sends it, where it says `mirror` with the same said of the parts' twins on the
        machine's other side: roles that end in `_l` and `_r` change places."""
        said = entry.get("parts")
        if not entry.get("mirror") or not isinstance(said, Mapping):
            return entry
        twins = twins_of(self.assembly, self.state.aligned.frame)
        known = {twins[part]: role for part, role in said.items() if part in twins and twins[part] not in said}
        swapped = {part: _other_side(role, self._template) for part, role in known.items()}
        return {**entry, "parts": {**said, **swapped}}

    def keep(self) -> None:
        """Writes the decisions where a build takes them from."""
        self._write(self.settled())

    def history(self) -> tuple[list[Operation], int]:
        """All operations, and how many of them hold."""
        with self._heard:
            return list(self._journal.operations), self._journal.cursor

    # ---- what comes of it ----
    def _write(self, state: State) -> None:
        with self._heard, output_file(self._file) as temporary:
            write_alignment(state.aligned, self.assembly, temporary)

    def _changed(self) -> int:
        self._said += 1
        self._heard.notify_all()
        return self._said

    def _work(self) -> None:
        """Solves what was said, as long as the session is open."""
        free = True
        while True:
            with self._heard:
                news = self._heard.wait_for(
                    lambda: self._closed or self.state.said != self._said, None if free else _IDLE
                )
                if self._closed:
                    return
            free = not news
            state = self._state(self._fixed if news else {})
            with self._heard:
                known = (state.said, state.aligned.parts) == (self.state.said, self.state.aligned.parts)
                if known or state.said != self._said:
                    continue
                self._show(state)
            # Not what is settled: more may have been said, which is for the next round.
            self._write(state)

    def _state(self, fixed: Mapping[str, str]) -> State:
        """What was said, solved; where that fails as nobody foresaw, the machine stays as it was, and it is said."""
        said = self._said
        try:
            return self._solved(fixed)
        except Exception as error:  # noqa: BLE001 - one state that cannot be made must not end the studio
            failed = f"The machine of these decisions cannot be made ({type(error).__name__}: {error})"
            return replace(self.state, said=said, failed=failed)

    def _show(self, state: State) -> None:
        """Makes a state the one that is seen. It is numbered here and not where its making began: of two that are made
        at once, the later seen has the higher number."""
        with self._heard:
            self._version += 1
            self.state = replace(state, version=self._version)
            self._heard.notify_all()

    def _measure(self) -> None:
        """Measures the machine of the last state, as long as the session is open."""
        while True:
            with self._heard:
                self._heard.wait_for(lambda: self._closed or not self.state.measured)
                if self._closed:
                    return
                state = self.state
            assert state.solved is not None
            try:
                found = measured_of(state.solved.mechanism)
                done = state.with_measured(found)
                mechanism = state.solved.mechanism
                known: tuple[Mechanism, bytes, Measured] | None = (mechanism, content_of(mechanism), found)
            except Exception as error:  # noqa: BLE001 - as of a state
                failed = f"This machine cannot be measured ({type(error).__name__}: {error})"
                done, known = replace(state, failed=failed, measured=True), self._known
            with self._heard:
                self._known = known
                if self.state is state:
                    self._show(done)

    def _solved(self, fixed: Mapping[str, str]) -> State:
        """What the decisions come to, the variants in `fixed` as they were but for those that a person's role needs."""
        with self._heard:
            said = self._said
            kept = self._after(self._journal.in_force)
        data, template = self._documents(kept.joints)
        played = choose(template, {**fixed, **self._choices}) if fixed else template
        roles = {*(d.role for d in kept.parts.values()), *(rule.role for rule in kept.rules)}
        if any(role is not None and not played.knows(role) for role in roles):
            fixed = {}
        # What is said of the whole machine may make another variant the best.
        if {n: v.text for n, v in kept.machine.items()} != {n: v.text for n, v in self._whole.items()}:
            fixed = {}
        choices = {**fixed, **self._choices}
        forgotten = {p: PartDecision(None, "solved") for p in said_in_file(self._edits).parts if p not in kept.parts}
        edits = decide(self._edits, Decisions(parts={**forgotten, **kept.parts}), self.assembly, template)
        edits = replace(
            edits or self._edits, values=kept.values, joints=kept.joints, rules=kept.rules, machine=kept.machine
        )
        by_hand = specs.parse_settings([f"{n}={v.text}" for n, v in kept.values.items()], template)
        specifications = specs.merge(self._sheet, by_hand, self._given)
        alignment = roles_of(self.assembly, template, specifications, edits=edits, data=data, choices=choices)
        asked = {p.part: p.suggestion for p in self._edits.parts if p.suggestion is not None}
        alignment = alignment.suggested({part: asked[part] for part in alignment.to_review if part in asked})
        if fixed:
            # They were not tried again.
            as_good = self.state.aligned.open_choices
            alignment = replace(alignment, open_choices={v: c for v, c in as_good.items() if v not in kept.machine})
        self._fixed, self._whole = dict(alignment.choices), kept.machine
        chosen = as_said(template, alignment, {**alignment.choices, **choices})
        told = (*kept.remarks, *(self._shortly(f.message) for f in alignment.findings if f.code in _CONTRADICTIONS))
        bare = State(
            0, said, chosen, self.assembly, alignment, specifications, alignment, self.assembly, remarks=told
        )  # fmt: skip
        try:
            solved = solve(template, self.assembly, alignment, specifications, data, choices)
        except MechanismError as error:
            return replace(bare, failed=str(error))
        facts = report.BuildFacts(
            solved.mechanism, solved.template, solved.alignment, solved.specifications,
            findings=(*self.assembly.findings, *data.findings), declared=solved.compared,
        )  # fmt: skip
        state = replace(
            bare, template=solved.template, assembly=solved.assembly, alignment=solved.alignment,
            specifications=solved.specifications, solved=solved, document=report.report_document(facts), facts=facts,
            measured=False,
        )  # fmt: skip
        # Most decisions say that something is right, and leave the machine as it is.
        known = self._known
        same = known is not None and (_are_one(known[0], solved.mechanism) or known[1] == content_of(solved.mechanism))
        return state.with_measured(known[2]) if known is not None and same else state

    def _shortly(self, message: str) -> str:
        """A message with the names of parts in the place of their whole paths."""
        return re.sub(
            r"(?<!\w)'([^']+)'", lambda m: f"'{m[1].rsplit('/', 1)[-1]}'" if m[1] in self.parts else m[0], message
        )

    def _documents(self, joints: Mapping[str, Mapping[str, object]]) -> tuple[library.Documents, Template]:
        """The user's documents and what is said of joints here, with the template that they make. `YellowironError` for
        what cannot be said of a joint."""
        bare = {name: {k: v for k, v in entry.items() if k not in SIGNED} for name, entry in joints.items()}
        if not bare:
            return self._data, self._template
        data = library.load_documents(self.setup.documents, self._bare, self._read, joints=(self._file, bare))
        return data, library.apply_sensors(library.apply_joints(self._bare, data), data)

    def _continues(self) -> bool:
        """Whether the decisions in alignment.json are those that the journal led to, or, in a file that is older than
        the journal, ever did: a killed program may not have come to write the last there. Else a person has changed
        the file."""
        base = self._journal.base
        if base is None:
            return False
        now = said_in_file(self._edits).snapshot()
        behind = not self._file.exists() or self._file.stat().st_mtime_ns < self._journal.written_ns
        known = self._journal.passed if behind else [self._journal.in_force]
        return any(self._after(operations).snapshot() == now for operations in known)

    def _after(self, operations: list[Operation]) -> Said:
        """What holds after these operations. A journal's base that is older than patterns on the page has those of the
        file."""
        base = {"rules": said_in_file(self._edits).snapshot()["rules"], **(self._journal.base or {})}
        return said_after(base, operations, self.fitting)


def measured_of(mechanism: Mechanism) -> Measured:
    """`memory.measure` in a process of its own, so that what is decided meanwhile does not wait for it."""
    found: Measured = run_guarded("yellowiron.memory:measure", mechanism, where=mechanism.name)
    return found


def _are_one(one: Mechanism, other: Mechanism) -> bool:
    """Whether two mechanisms are of the very same things; what was found of them does not count."""
    return all(getattr(one, f.name) is getattr(other, f.name) for f in fields(one) if f.name != "findings")


def _other_side(role: object, template: Template) -> object:
    """The role on the machine's other side; the role itself where there is none."""
    if not isinstance(role, str) or role[-2:] not in ("_l", "_r"):
        return role
    other = role[:-1] + {"l": "r", "r": "l"}[role[-1]]
    return other if template.knows(other) else role
