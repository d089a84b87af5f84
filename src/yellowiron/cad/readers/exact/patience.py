"""How long Open CASCADE may work on a file: on some damage it goes on for ever."""

from __future__ import annotations

from contextlib import AbstractContextManager

from yellowiron.support.limits import must_end

SECONDS, BYTES_A_SECOND = 20.0, 2e4
"""Of the processor, for a whole file: far less than is usual."""
TEXT_SECONDS, TEXT_BYTES_A_SECOND = 2.0, 1e6
"""The same for reading the text of a shape, before anything is made of it: a fiftieth of what is usual."""


def file_must_end(size: int) -> AbstractContextManager[None]:
    """Ends the process where what is inside takes too long for a file of so many bytes."""
    return must_end(SECONDS + size / BYTES_A_SECOND)


def text_must_end(size: int) -> AbstractContextManager[None]:
    """As `file_must_end`, for the text of a shape."""
    return must_end(TEXT_SECONDS + size / TEXT_BYTES_A_SECOND)
