"""The sentence in which a sheet says which configuration its figures are for."""

from __future__ import annotations

import re
from dataclasses import dataclass

_SENTENCE_END = re.compile(r"(?<=[.!?])\s+(?=(?:\d{1,2}[.)]?\s)?[^\W\d_a-z])")
_STATES = re.compile(
    r"\b(?:figures|values|data|dimensions|specifications|ratings)\b[^.]{0,60}?\b(?:are|is|apply|refer|shown|given|based)\b"
    r"[^.]{0,30}?\b(?:for|on|with|to)\b"
    r"|\b(?:angaben|werte|daten|ma(?:ß|ss)e|abmessungen)\b[^.]{0,60}?\b(?:gelten|beziehen|mit|für)\b"
    r"|\b(?:valeurs|données|dimensions|caractéristiques|chiffres)\b[^.]{0,60}?\b(?:pour|avec|correspondent)\b"
    r"|\b(?:valores|datos|dimensiones|cifras|especificaciones)\b[^.]{0,60}?\b(?:para|con|corresponden|refieren)\b",
    re.IGNORECASE,
)
_LONGEST = 400


@dataclass(frozen=True)
class Stated:
    """A sentence about the figures of a sheet, and its page (1 = first)."""

    sentence: str
    page: int


def stated_in(text: str, page: int) -> tuple[Stated, ...]:
    """The sentences of a page's running text that may say which configuration is meant. Whether one does is told by the
    column heads it names in full: a sentence that names none decides nothing."""
    found = []
    for sentence in _SENTENCE_END.split(text):
        *_, begin = (None, *(m.start() for m in _STATES.finditer(sentence)))
        if begin is not None:
            # What stands before on the page (a title, a card) ends in no full stop and belongs to another thought.
            found.append(Stated(sentence[begin : begin + _LONGEST].strip(), page))
    return tuple(found)
