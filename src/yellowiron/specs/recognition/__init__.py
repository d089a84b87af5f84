"""Programs that recognise the words on the picture of a page, each with one function `words_on`, and what they need of
the picture."""

from __future__ import annotations

__all__: list[str] = []
