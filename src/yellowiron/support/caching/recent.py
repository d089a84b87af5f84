"""What follows from a value's content alone: made once for each of the last few values that were asked about."""

from __future__ import annotations

import functools
import threading
from collections import OrderedDict
from collections.abc import Callable
from typing import TypeVar

from yellowiron.support.caching.content import content_of

Given = TypeVar("Given")
Answer = TypeVar("Answer")


def recent(function: Callable[[Given], Answer], most: int = 4) -> Callable[[Given], Answer]:
    """A pure function that answers at once what it was asked lately: about the last `most` values, which are the same
    where their content is (`content_of`), whatever they are made of. An answer must never change."""
    known: OrderedDict[bytes, Answer] = OrderedDict()
    alone = threading.Lock()

    @functools.wraps(function)
    def ask(given: Given) -> Answer:
        key = content_of(given)
        with alone:
            if key in known:
                known.move_to_end(key)
                return known[key]
        answer = function(given)
        with alone:
            known[key] = answer
            while len(known) > most:
                known.popitem(last=False)
        return answer

    return ask
