"""A rule: one function over a `View`, with a stable code."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from yellowiron.checks.view import View
from yellowiron.model.finding import Finding, Severity

Remarks = Iterator[tuple[str, str]]
"""What a rule finds: where (a prim path or a file) and a sentence that says what is there."""


@dataclass(frozen=True)
class Rule:
    """`meaning` says what the code stands for and `hint` what to do; `find` yields what it finds in a stage."""

    code: str
    severity: Severity
    meaning: str
    hint: str
    find: Callable[[View], Remarks]

    def __call__(self, view: View) -> Iterator[Finding]:
        """The rule's findings in a stage, in the stage's order."""
        for where, message in self.find(view):
            yield Finding(code=self.code, severity=self.severity, where=where, message=message, hint=self.hint)


def rule(code: str, severity: Severity, hint: str) -> Callable[[Callable[[View], Remarks]], Rule]:
    """Makes a rule of a function; the function's docstring says what the code means."""

    def make(find: Callable[[View], Remarks]) -> Rule:
        return Rule(code, severity, (find.__doc__ or "").strip(), hint, find)

    return make
