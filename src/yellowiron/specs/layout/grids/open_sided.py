"""Tables that are ruled in part: no walls at their sides, heads on a bar above them."""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.specs.layout.rows.lines import TextLine, lines_of
from yellowiron.specs.layout.statement import TextPiece, is_key, kind_of
from yellowiron.specs.pages.strokes import SNAP, Box, DrawnRule
from yellowiron.specs.pages.words import Word

_HIGHEST = 60.0
"""Points; what is higher is no row."""
_FAR = 40.0
"""Points between a row of heads and the table or the heading under it."""


def side_walls(level: Sequence[DrawnRule], walls: Sequence[DrawnRule], words: Sequence[Word]) -> list[DrawnRule]:
    """The walls that a table lacks at its left or right: between two rules that end level with each other and that
    walls in between join, with words but no value left of the first wall, or with words right of the last one."""
    found: list[DrawnRule] = []
    rules, walls = merged(level), joined(walls)
    for edge in ("x0", "x1"):
        for above in rules:
            x = getattr(above, edge)
            below = next((r for r in rules if r.top > above.top + SNAP and abs(getattr(r, edge) - x) <= SNAP), None)
            if below is not None and _lacks_wall(above, below, x, walls, words):
                found.append(DrawnRule(x, above.top, x, below.top))
    return found


def _lacks_wall(
    above: DrawnRule, below: DrawnRule, x: float, walls: Sequence[DrawnRule], words: Sequence[Word]
) -> bool:
    """Whether a table's row between two rules, or several that no rule parts, has words beside its walls, at `x`."""
    x0, x1 = max(above.x0, below.x0), min(above.x1, below.x1)
    joining = [
        w.x0
        for w in walls
        if w.top <= above.top + SNAP and w.bottom >= below.top - SNAP and x0 - SNAP <= w.x0 <= x1 + SNAP
    ]
    inner = [wall for wall in joining if x0 + 10 < wall < x1 - 10]
    if not inner or any(abs(x - wall) <= SNAP for wall in joining):
        return False
    high = below.top - above.top >= _HIGHEST
    row = [w for w in words if above.top < (w.top + w.bottom) / 2 < below.top and x0 - 4 <= w.x0 <= x1]
    before = [p for line in lines_of([w for w in row if w.x1 <= min(inner) + 1]) for p in line.pieces]
    left = {kind_of(p) for p in before if p is not before[0] or not is_key(p.bare)}
    right = {kind_of(p) for line in lines_of([w for w in row if w.x0 >= max(inner) - 1]) for p in line.pieces}
    if high:
        return len(inner) > 1 and "value" in right if x > max(inner) else len(inner) > 1 and "text" in left
    return bool(right) if x > max(inner) else "text" in left and "value" not in left


def merged(level: Sequence[DrawnRule]) -> list[DrawnRule]:
    """Rules at one height that touch are one; from top to bottom."""
    found: list[DrawnRule] = []
    for rule in sorted(level, key=lambda r: (round(r.top), r.x0)):
        last = found[-1] if found else None
        touch = last is not None and last.x0 - SNAP <= rule.x1 and rule.x0 <= last.x1 + SNAP
        if last is not None and touch and abs(last.top - rule.top) <= 1:
            found[-1] = DrawnRule(min(last.x0, rule.x0), last.top, max(last.x1, rule.x1), last.top)
        else:
            found.append(rule)
    return sorted(found, key=lambda r: (r.top, r.x0))


def joined(walls: Sequence[DrawnRule]) -> list[DrawnRule]:
    """Walls at one place that touch are one, though drawn row by row."""
    found: list[DrawnRule] = []
    for wall in sorted(walls, key=lambda w: (round(w.x0), w.top)):
        last = found[-1] if found else None
        touch = last is not None and last.top - 1 <= wall.top <= last.bottom + 1
        if last is not None and touch and abs(last.x0 - wall.x0) <= 1:
            found[-1] = DrawnRule(last.x0, last.top, last.x0, max(last.bottom, wall.bottom))
        else:
            found.append(wall)
    return found


def heads_above(
    lines: Sequence[TextLine], box: Box, columns: Sequence[tuple[float, float]], tables: Sequence[Box]
) -> tuple[TextPiece, ...]:
    """The heads that stand over a table's columns (left and right edges, without the labels') outside of it: the
    nearest line above with words over two or more of them. Only headings, tables of the same width and their heads may
    stand between."""
    top = box[1]
    same = [t for t in tables if abs(t[0] - box[0]) < 2 * SNAP and abs(t[2] - box[2]) < 2 * SNAP]
    for line in sorted(lines, key=lambda one: -one.bottom):
        if line.bottom > box[1] + 2 or line.x1 < box[0] or line.x0 > box[2]:
            continue
        nearest = max((t[3] for t in same if t[3] <= top + 2), default=float("-inf"))
        while nearest > line.bottom and top - nearest <= _FAR + 20:
            top = min(t[1] for t in same if t[3] == nearest)
            nearest = max((t[3] for t in same if t[3] <= top + 2), default=float("-inf"))
        if top - line.bottom > _FAR:
            return ()
        over = [p for p in line.pieces if _column_of(p, columns) is not None]
        if len(over) >= 2 and len({_column_of(p, columns) for p in over}) == len(over):
            return tuple(over)
        if len(line.pieces) > 1 or kind_of(line.pieces[0]) != "text":
            return ()
        top = line.top
    return ()


def _column_of(piece: TextPiece, columns: Sequence[tuple[float, float]]) -> int | None:
    """The column that a head stands over."""
    middle = (piece.x0 + piece.x1) / 2
    return next((i for i, (x0, x1) in enumerate(columns) if x0 <= middle <= x1 and x0 - 6 <= piece.x0), None)
