"""How far names are to be believed: all of a machine's, and those that a piece does not bear itself."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence

import numpy as np

from yellowiron.alignment.fusion.bonds import Bond
from yellowiron.alignment.fusion.pieces import Piece
from yellowiron.alignment.fusion.votes import clearly_named, joints_apart
from yellowiron.model.template import Template

EXPLAINED = {0: 1.0, 1: 1.0, 2: 0.5}
"""How well names explain that two pieces are neighbours, by the joints between the bodies that they name."""
BELIEVED = 0.45
"""Names that explain less than this share of what they could of who is beside whom are not believed at all."""
TRUSTED = 0.7
"""… and from this share on, wholly."""
OF_SOLID, OF_BAR = 0.5, 0.1
"""What the name of a mesh counts for one of its solids, and for a bar: in 23 models of strangers 68 % of 2980 solids
are what their mesh is called, but only 41 % of 234 bars, which may be its hydraulic cylinders."""
OF_CARRIER = 0.6
"""What the name of a part counts for what hangs on it in the tree and says nothing itself: in one animated model of 208
parts, 66 of 76 are of the part that they hang on; the others are cylinders and links that stand on it."""


def worth_of_name(piece: Piece, *, shared: bool, borne: bool) -> float:
    """What a piece's name counts, 0 to 1: `shared` with other solids of its mesh, or only that of a part which it hangs
    on (`borne`)."""
    worth = 1.0 if not shared else OF_BAR if piece.slender else OF_SOLID
    return worth * (OF_CARRIER if borne else 1.0)


def trust_in_names(
    pieces: Sequence[Piece],
    bonds: Sequence[Bond],
    scores: Sequence[Mapping[str, float]],
    template: Template,
    called: Sequence[frozenset[tuple[tuple[str, ...], str]]],
) -> float:
    """How far a machine's names are to be believed, 0 to 1: neighbours should be one body, or two that a joint joins,
    much more often than any two pieces are (the chance taken off, as in Cohen's kappa); two joints count half.
    `template` has its variants open: a blade, or a second boom, is as true a name as any. Pieces that are `called` the
    same in one place (solids of one mesh) agree whatever the name is worth."""
    apart = joints_apart(template)
    said = clearly_named(pieces, scores)

    def explained(a: int, b: int) -> float:
        return EXPLAINED.get(apart.get((said[a], said[b]), 99), 0.0)

    near = [
        explained(b.a, b.b) for b in bonds if b.beside and b.a in said and b.b in said and not called[b.a] & called[b.b]
    ]
    every = [explained(a, b) for a, b in itertools.combinations(sorted(said), 2) if not called[a] & called[b]]
    if not near or min(every) == 1.0:
        return 1.0
    chance = float(np.mean(every))
    kappa = (float(np.mean(near)) - chance) / (1.0 - chance)
    kappa = (len(near) * kappa + 4.0) / (len(near) + 4.0)  # names are mostly right: so many more agreed before
    return float(np.clip((kappa - BELIEVED) / (TRUSTED - BELIEVED), 0.0, 1.0))
