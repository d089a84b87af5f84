"""The one family of errors: a sentence, where it happened, and what to do."""

from __future__ import annotations


class YellowironError(Exception):
    """Unusable input. The command line prints it and exits with code 2.

    `message` is one sentence; `where` names the file, joint, part or page; `hint` says what to do.
    """

    def __init__(self, message: str, *, where: str = "", hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.where = where
        self.hint = hint

    def __reduce__(self) -> tuple[object, ...]:
        return (_rebuild, (type(self), self.message, self.where, self.hint))

    def __str__(self) -> str:
        text = self.message
        if self.where:
            text += f" (where: {self.where})"
        if self.hint:
            text += f" Hint: {self.hint}"
        return text


def _rebuild(kind: type[YellowironError], message: str, where: str, hint: str) -> YellowironError:
    """An error from its pickle: keyword-only arguments need help to cross a process boundary."""
    return kind(message, where=where, hint=hint)


class CadError(YellowironError):
    """A CAD file that cannot be read."""


class SheetError(YellowironError):
    """A specification sheet that cannot be opened."""


class TemplateError(YellowironError):
    """A template that does not load, or that fails the lint."""


class AlignmentError(YellowironError):
    """An alignment file that does not fit its CAD model or template."""


class MechanismError(YellowironError):
    """A mechanism that cannot be built from what is known."""


class OutputError(YellowironError):
    """An output folder or file that cannot be written."""
