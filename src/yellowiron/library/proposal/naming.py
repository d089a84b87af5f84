"""Names for bodies that no template knows: from what their parts are called, where that means something."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence

from yellowiron.model.found import FoundMachine

_WORD = re.compile(r"[A-Z]+(?![a-z])\d*|[A-Z]?[a-z]+\d*|[^\W\d_a-zA-Z]+\d*|(?<!\d)\d{1,2}(?![\d.x])")
_ENDING = re.compile(
    r"\.(stl|obj|stp|step|igs|iges|ipt|iam|prt|asm|sldprt|sldasm|catpart|glb|gltf|dae|fbx|x_t)\b", re.I
)
_NOISE_WORDS = """object obj part mesh solid body component comp shape node group grp item default import imported step
stl product unnamed untitled instance geometry geom assy assembly asm ga weldment copy of the and with new model root
no name none null id nauo open cascade translator unknown compound shell surface face polygon primitive"""
_NOISE = frozenset(_NOISE_WORDS.split())
_LEAST = 3
"""A Latin word of fewer letters means nothing by itself."""
_MOST = 40
"""Letters of a name."""


def proposed_names(machine: FoundMachine) -> tuple[list[str], list[str]]:
    """(names, reasons) of all bodies: from the first of a body's labels that means something and is its own (or its
    twins'), else by kind and number."""
    common = _common(machine)
    words = [[_name(label, common) for label in body.labels] for body in machine.bodies]
    names, reasons = [], []
    for k, body in enumerate(machine.bodies):
        if given := snake_case(body.name):
            names.append(given)
            reasons.append(f"the file calls it '{body.name}'")
            continue
        chosen = next((i for i, name in enumerate(words[k]) if name and _own(name, i, k, machine, words)), None)
        if chosen is None:
            names.append("")
            reasons.append("no name of its parts says what it is")
        else:
            names.append(words[k][chosen])
            reasons.append(f"named after '{body.labels[chosen]}'")
    return _distinct(_filled(names, machine)), reasons


def snake_case(name: str) -> str:
    """A name as a template has it: `Boom Link.001` → `boom_link_001`."""
    return re.sub(r"\W+", "_", name).strip("_").casefold()


def title(name: str) -> str:
    """A role's name as words of a sheet: `lift_cylinder` → `Lift Cylinder`."""
    return " ".join(word.capitalize() for word in name.split("_"))


def _own(name: str, place: int, k: int, machine: FoundMachine, words: Sequence[Sequence[str]]) -> bool:
    """Whether a name tells a body from those of other kinds: it is the first of its labels and of none of theirs, or
    they have it nowhere."""
    kind = machine.bodies[k].kind
    others = [(machine.bodies[j].kind, w) for j, w in enumerate(words) if j != k]
    if place == 0:
        return all(other == kind or not w or w[0] != name for other, w in others)
    return all((other == kind and kind in ("barrel", "rod", "wheel")) or name not in w for other, w in others)


def _words(label: str) -> list[str]:
    plain = "".join(base if (base := unicodedata.normalize("NFKD", c)[0]).isascii() else c for c in label)
    return [w.casefold() for w in _WORD.findall(_ENDING.sub(" ", plain))]


def _common(machine: FoundMachine) -> frozenset[str]:
    """Words that every part's name has: the machine's, not a body's."""
    sets = [frozenset(_words(body.labels[-1])) for body in machine.bodies if body.labels]
    return frozenset.intersection(*sets) if len(sets) > 2 else frozenset()


def _name(label: str, common: frozenset[str]) -> str:
    kept: list[str] = []
    before = ""
    for word in _words(label):
        if word.isdigit():
            # A number counts what stands before it: section 2, not mesh 2.
            if kept and before == kept[-1]:
                kept.append(word)
            before = word
            continue
        before = word
        letters = re.sub(r"\d", "", word)
        short = letters.isascii() and len(letters) < (_LEAST if not kept else 2)
        if letters in _NOISE or re.fullmatch(r"link\d+", word) or word in common or short or word in kept:
            continue
        kept.append(word)
    while kept and len("_".join(kept)) > _MOST:
        kept.pop()
    return "_".join(kept)


def _filled(names: list[str], machine: FoundMachine) -> list[str]:
    """Names for those that have none: a hydraulic cylinder's halves after what the rod moves, others by number."""
    filled = list(names)
    for k, body in enumerate(machine.bodies):
        if not filled[k] and body.kind not in ("barrel", "rod"):
            filled[k] = "base" if k == machine.root else "wheel" if body.kind == "wheel" else f"body_{k}"
    for slide in (j for j in machine.joints if j.type == "prismatic"):
        ends = {slide.a, slide.b}
        rod = next((k for k in ends if machine.bodies[k].kind == "rod"), slide.b)
        moved = _beyond(machine, rod, ends)
        barrel = next(iter(ends - {rod}))
        stem = filled[moved] if moved is not None and filled[moved] else f"cylinder_{barrel}"
        filled[barrel] = filled[barrel] or f"{stem}_cylinder_barrel"
        filled[rod] = filled[rod] or f"{stem}_piston_rod"
    return [name or f"body_{k}" for k, name in enumerate(filled)]


def _beyond(machine: FoundMachine, end: int, slide: set[int]) -> int | None:
    """The body that one end of a cylinder hangs on."""
    for joint in machine.joints:
        if joint.type == "revolute" and end in (joint.a, joint.b):
            other = joint.b if joint.a == end else joint.a
            if other not in slide and machine.bodies[other].kind not in ("barrel", "rod"):
                return other
    return None


def _distinct(names: list[str]) -> list[str]:
    """Names with a number behind those that several have."""
    taken = set(names)
    result = []
    for name in names:
        unique = name
        if names.count(name) > 1:
            unique = next(n for k in range(1, len(names) + 2) if (n := f"{name}_{k}") not in taken)
        taken.add(unique)
        result.append(unique)
    return result
