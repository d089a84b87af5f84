"""Studio: a person settles what the program doubts, on a local page, and sees the machine move while doing it.

In: what a build takes (`Setup`). Out: decisions in the output folder's `alignment.json`, which `build` takes from
there, and `studio.jsonl`, the history of them.

`setup` (what the studio works on), `operations` (what a person can decide), `journal` (kept the moment it is said),
`said` (what holds of it), `session` (decisions → machine), `questions` (what is asked, the most consequential first),
`patterns` (what a selection may mean), `axes` and `joints` (where joints are, and may be), `scene` (what the page
draws), `building` (the whole machine, as the command line writes it), `server` (the page's address: this computer's
only, with a token; it needs the extra `studio`). The page is in `data`.
"""

from yellowiron.studio.session import Session
from yellowiron.studio.setup import Setup, read_setup

__all__ = ["Session", "Setup", "read_setup"]
