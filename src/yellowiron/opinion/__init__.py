"""A second opinion on parts in doubt, from a language model that the user names: it points, and decides nothing.

In: an `Alignment` with its CAD model and template, and where the model is; out: the same alignment with the model's
`Suggestion`s on its parts, and findings that tell of them (`ALN030`, `ALN031`). Roles, bodies, confidences and what is
listed for review are those that went in.

`doubts` (what is asked, the most consequential first) and `drawing` (pictures of it) ← `asking`.
"""

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.opinion.asking import second_opinion

__all__ = ["second_opinion"]

__getattr__, __dir__ = lazy_names(__name__, {"second_opinion": "asking"})
