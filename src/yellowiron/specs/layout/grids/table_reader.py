"""The statements of a table: its cells of values with the words to their left and the heads above them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from yellowiron.specs.language.numbers import read
from yellowiron.specs.language.vocabulary import CIRCUITS, tokens
from yellowiron.specs.layout.grids.slipped_units import units_in_their_rows
from yellowiron.specs.layout.grids.table_grid import Cell, TableGrid
from yellowiron.specs.layout.rows.cells import marked_by_footnote
from yellowiron.specs.layout.rows.headings import in_capitals, names_models, names_no_columns
from yellowiron.specs.layout.rows.prose import paragraphs_of, read_paragraph
from yellowiron.specs.layout.statement import (
    COUNTED,
    EXAMPLE,
    Statement,
    TextPiece,
    ascending,
    counting,
    is_key,
    is_unit,
    lists_items,
    looks_like_value,
    split_inline,
    unit_in_label,
    unit_of_heading,
    without_key,
)
from yellowiron.specs.pages.words import Page

_LONGEST_SECTION = 12
"""Words; more are no heading."""
_LONGEST_HEAD = 6
"""Words; more name no column."""


@dataclass(frozen=True)
class _Row:
    """A row that is read: its page and table, its place there, its cells, the number that its statements have, and the
    heading over it."""

    page: Page
    grid: TableGrid
    cells: Sequence[Cell]
    number: int
    section: str


def read_grid(
    page: Page, grid: TableGrid, first_row: int, section: str = "", above: Sequence[TextPiece] = ()
) -> list[Statement]:
    """The statements of a table: a value's label is the words to its left, its column the heads above; `above` are
    heads that stand over the table, outside of it. A table of pairs is two, side by side."""
    if halves := _halves(grid):
        return [s for half in halves for s in read_grid(page, half, first_row, section, above)]
    found: list[Statement] = []
    titles = _titles(grid)
    grid, slipped = units_in_their_rows(_with_names_carried(_without_keys(grid)))
    heads = _head_rows(page, grid)
    naming = frozenset(heads)
    over_rows: tuple[str, ...] = ()
    circuit: tuple[str, ...] = ()
    carried: list[Cell] = []
    titled = False
    for index in range(grid.rows):
        cells = _row_cells(grid, index)
        filled = [c for c in cells if c.lines]
        values = _values_of(filled)
        if not filled:
            continue
        found.extend(_sentences(page, filled, values, first_row + index, section))
        if not values:
            if len(filled) == 1 and len(filled[0].text.split()) > _LONGEST_SECTION:
                continue  # a sentence
            if len(filled) == 1 and _is_section(grid, filled[0]):
                title = " ".join(p.text for p in filled[0].pieces)
                spans = filled[0].columns[1] - filled[0].columns[0] == grid.columns
                titled |= spans
                section, over_rows = (title, ()) if spans or not titled else (section, (title,))
                circuit = ()
            elif len(filled) == 1 and filled[0].columns[0] == 0:
                over_rows, circuit = (filled[0].text,), ()
            elif _are_sentences(filled[1:]):
                circuit = (filled[0].text,) if {"pump", *CIRCUITS} & set(tokens(filled[0].text)) else ()
            elif not _heads_none(grid, filled, heads, below=bool(found)):
                heads.append(index)
            continue
        if len(filled) == 1 and filled[0].columns[0] == 0 and not is_unit(filled[0].text.lstrip("0123456789.,± ")):
            over_rows = (filled[0].text,)  # "4.7 m monoboom"
            continue
        if len(filled) == 1:
            cells = [*carried, *cells]  # "Travel speed | High: 4.6 km/h" over " | Low: 2.7 km/h"
        elif all(split_inline(c.text)[0] for c in values):
            carried = [c for c in filled if not any(c is v for v in values)]
        else:
            carried = []
        if not _labels(cells, values[0]):
            label = _labels(_row_cells(grid, heads[-1]), values[0]) if heads else []
            if not heads or index in naming:
                heads.extend([] if index in heads else [index])
                continue
            cells = [*label, *cells]  # "Travel speed | JS330 | JS370" over " | High: 5 km/h | …"
        over = [h for h in heads if h <= index] if index in naming else heads
        own = _read_row(_Row(page, grid, cells, first_row + index, section), values, over)
        if heads and index not in heads and not any(f.label for f in own):
            own = [replace(f, variant=(values[0].text,)) for f in own]
        own = [replace(f, context=(*circuit, *f.context, *over_rows)) for f in own]
        if index in titles:
            own = [_under_title(f, titles[index]) for f in own]
        if above and not heads:
            own = [_headed(f, above) for f in own]
        found.extend(own)
    return [replace(f, slipped=f.row - first_row in slipped) for f in found] if slipped else found


def _halves(grid: TableGrid) -> list[TableGrid]:
    """The halves of a table of pairs (a label and its value twice in a row, some in words); none of others."""
    columns = [[c for c in grid.cells if c.lines and c.columns == (at, at + 1)] for at in range(grid.columns)]
    apart = all(c.columns == (0, 4) or c.columns[1] - c.columns[0] == 1 for c in grid.cells if c.lines)
    if grid.columns != 4 or not apart:
        return []
    values = [[c for c in column if looks_like_value(c.text)] for column in columns]
    labelled = not (values[0] or values[2]) and all(len(columns[at]) >= MANY // 2 for at in (0, 2))
    valued = all(3 * len(values[at]) >= len(columns[at]) > 0 for at in (1, 3))
    rows = {c.rows for c in values[3]} & {c.rows for c in columns[1] if _is_label(c)}
    if not (labelled and valued and rows) or any(is_unit(c.text) for column in columns for c in column):
        return []
    halves = []
    for at in (0, 2):
        own = [c for c in grid.cells if c.columns == (0, 4) or at <= c.columns[0] < c.columns[1] <= at + 2]
        own = [replace(c, columns=(max(c.columns[0] - at, 0), min(c.columns[1] - at, 2))) for c in own]
        halves.append(replace(grid, cells=tuple(own), columns=2))
    return halves


def _sentences(
    page: Page, filled: Sequence[Cell], values: Sequence[Cell], row: int, section: str
) -> Iterator[Statement]:
    """The statements of running text in the cells of a row that hold no value, under the label that begins it."""
    label = filled[0].text if len(filled) > 1 and filled[0].columns[0] == 0 else section
    for cell in filled:
        if len(cell.text.split()) > _LONGEST_SECTION and not any(cell is v for v in values):
            for paragraph in paragraphs_of(cell.lines):
                yield from read_paragraph(page.number, paragraph, row, label)


def _is_section(grid: TableGrid, cell: Cell) -> bool:
    """Whether words alone in their row head the rows under them: they span the table, or begin it in capitals or, as
    no label does, in bold."""
    if cell.columns[1] - cell.columns[0] == grid.columns:
        return True
    labels = [c for c in grid.cells if c.columns[0] == 0 and c.lines and c is not cell and not _is_alone(grid, c)]
    bold = _is_bold(cell) and not any(map(_is_bold, labels))
    return cell.columns[0] == 0 and (bold or all(map(in_capitals, cell.pieces)))


def _is_alone(grid: TableGrid, cell: Cell) -> bool:
    return all(c is cell or not c.lines for row in range(*cell.rows) for c in _row_cells(grid, row))


def _are_sentences(cells: Sequence[Cell]) -> bool:
    """Whether cells say more than a column's head."""
    return bool(cells) and all(len(c.text.split()) > _LONGEST_HEAD or c.text.endswith(".") for c in cells)


def _heads_none(grid: TableGrid, filled: Sequence[Cell], heads: Sequence[int], *, below: bool) -> bool:
    """Whether a row of words, a label first, says nothing of its columns: as `names_no_columns`; or it is in the only
    column of values and no model, or set like the rows of values, under some of them (`below`), and rows that stand
    out (`heads`) head the table; or it says the same of all columns that rows above name."""
    named = [[c for c in _row_cells(grid, head) if c.lines] for head in heads]
    apart = any(all(map(_is_bold, row)) or names_models(row[0].text) for row in named if row)
    first = min((c.columns[0] for c in grid.cells if looks_like_value(c.text)), default=1)
    labels, cells = [c.text for c in filled if c.columns[0] < first], [c.text for c in filled if c.columns[0] >= first]
    last = filled[-1].columns
    spanning = bool(heads) and len(cells) == 1 and last[0] <= first < last[1] - 1 and last[1] == grid.columns
    single = first == grid.columns - 1 and not names_models(" ".join(labels))
    plain = (single or (below and apart)) and not all(map(_is_bold, filled))
    none = plain or spanning or names_no_columns([" ".join(labels), *cells])
    same = bool(heads) and len(set(cells)) == 1 < len(cells)  # also where the labels are on the page before
    return (bool(labels) or same) and none and not any(map(is_unit, cells))


def _values_of(filled: Sequence[Cell]) -> list[Cell]:
    """A row's cells of values; all of them where each has a label inside."""
    values = [c for c in filled if looks_like_value(c.text) or (len(c.lines) == 1 and lists_items(c.text))]
    if not values and all(split_inline(c.text)[0] for c in filled):
        return list(filled)
    if not values and len(filled) > 1 and all(len(split_inline(c.text)[0].split()) in (1, 2) for c in filled[1:]):
        return list(filled[1:])
    return values


def _under_title(statement: Statement, title: str) -> Statement:
    label = statement.label.removeprefix(title).strip(" :")
    return replace(statement, label=label, context=(*statement.context, title))


def columns_of(grid: TableGrid) -> list[tuple[float, float]]:
    """Left and right edges of the columns that hold values."""
    found = {c.columns: c.box for c in grid.cells if c.columns[1] - c.columns[0] == 1 and looks_like_value(c.text)}
    return sorted((box[0], box[2]) for box in found.values())


def _headed(statement: Statement, above: Sequence[TextPiece]) -> Statement:
    """The statement with the heads over its cell; a cell under all of them has none of its own."""
    own = [p for p in above if statement.box[0] <= (p.x0 + p.x1) / 2 <= statement.box[2]]
    if len(own) == len(above) > 1:
        return statement
    unit = next((u for p in own if (u := is_unit(p.bare) or unit_in_label(p.bare)[1])), "")
    column = [p for p in own if not is_unit(p.bare)]
    return replace(
        statement,
        column=tuple(unit_in_label(p.bare)[0] for p in column),
        heads=tuple(p.text for p in column),
        unit=statement.unit or unit,
    )


def _without_keys(grid: TableGrid) -> TableGrid:
    """The grid with the columns of a drawing's keys emptied: letters, symbols or outline numbers, no two alike, beside
    a column of words. Among many some letters have two ("Wa"), some stand in two rows, or beside no words."""
    keys: set[Cell] = set()
    for column in range(grid.columns - 1):
        cells = [c for c in grid.cells if c.columns == (column, column + 1) and c.lines]
        own = [c for c in cells if is_key(c.text)]
        texts = [c.text for c in own]
        numbers = any(t[0].isdigit() for t in texts)
        if not numbers and len(own) >= MANY:
            own = [c for c in cells if c in own or _SYMBOL.fullmatch(c.text.replace(" ", ""))]
        twice = len(texts) - len(set(texts))
        few = len(own) // MANY
        if len(own) < 3 or len(own) < len(cells) - 1 or twice > few or all(map(is_unit, texts)):
            continue
        counted = len(own) >= MANY and counting(texts, 0.9)
        placed = counted or all(_begins(grid, c) for c in own)
        alone = counted and column == 0 and texts[0] == "1" and len(own) >= 10  # labels: on the page before
        bare = 0 if alone else sum(not _worded(grid, c, counted=counted) for c in own)
        if numbers and not (placed and ascending(list(dict.fromkeys(texts))) and bare <= few):
            continue
        keys.update(c for c in own if not _LISTED.fullmatch(c.text))  # "s/e/l" says what its three values are
    numbers_of = {c.rows: c.text for c in keys if c.text[0].isdigit()}
    again = [c for c in grid.cells if c not in keys and c.text and numbers_of.get(c.rows) == c.text]
    for columns, count in Counter(c.columns for c in again).items():  # "1.9 | Wheelbase | 2800 | 1.9"
        keys.update(c for c in again if c.columns == columns and count >= MANY)
    return grid.emptied(keys) if keys else grid


def _begins(grid: TableGrid, key: Cell) -> bool:
    """Whether no words stand left of a cell in its row."""
    left = [grid.at(key.rows[0], column) for column in range(key.columns[0])]
    return not any(c is not None and c.lines and c.rows == key.rows for c in left)


def _worded(grid: TableGrid, key: Cell, *, counted: bool) -> bool:
    """Whether what stands next right of a number is a label; where the numbers count the rows, it may stand left."""
    cells = [c for c in _row_cells(grid, key.rows[0]) if c.lines]
    at = cells.index(key)
    return any(map(_is_label, [*cells[at + 1 : at + 2], *(cells[at - 1 : at] if counted else [])]))


def _is_label(cell: Cell) -> bool:
    return bool(cell.lines) and not (is_unit(cell.text) or looks_like_value(cell.text))


def _with_names_carried(grid: TableGrid) -> TableGrid:
    """The table with the cells of a name over rows that leave it out, and say only what they say of it ("Forks |
    Width" over " | Length"), as if they spanned those rows: where no cell of the column is drawn over several."""
    cells = {(c.rows[0], c.columns[0]): c for c in grid.cells}
    for column in range(grid.columns - 2):
        words = [c.text for (_, at), c in cells.items() if at in (column, column + 1)]
        drawn = any(c.rows[1] - c.rows[0] > 1 for (_, at), c in cells.items() if at == column)
        if drawn or any(looks_like_value(text) or is_unit(text) for text in words):
            continue
        name: Cell | None = None
        for row in range(grid.rows):
            own, beside = cells.get((row, column)), cells.get((row, column + 1))
            single = own is not None and own.columns[1] == column + 1
            if own is None or not single or beside is None or not _is_label(beside):
                name = None
            elif own.lines:
                name = own
            elif name is not None and any(looks_like_value(c.text) for c in _row_cells(grid, row)):
                name = replace(name, rows=(name.rows[0], own.rows[1]), box=(*name.box[:3], own.box[3]))
                cells[name.rows[0], column] = name
                del cells[row, column]
    return replace(grid, cells=tuple(cells.values()))


def _titles(grid: TableGrid) -> dict[int, str]:
    """Row → the line that ends in a colon over the label of the first row beside one drawing's key, which holds for all
    of that key's rows: "1 | Machine height: / top of cab", "  | with boom installed"."""
    found: dict[int, str] = {}
    for key in grid.cells:
        if key.rows[1] - key.rows[0] < 2 or not _is_key(key.text):
            continue
        label = grid.at(key.rows[0], key.columns[1])
        first = " ".join(p.bare for p in label.lines[0].pieces) if label is not None and len(label.lines) > 1 else ""
        if first.endswith(":"):
            found.update(dict.fromkeys(range(*key.rows), first.rstrip(" :")))
    return found


def _head_rows(page: Page, grid: TableGrid) -> list[int]:
    """The first rows of numbers that name the columns ("2925 mm arm"): models by their label, or set in bold or shaded,
    which not all that follows is, or spread over columns that part below."""
    found: list[int] = []
    for row in range(grid.rows - 1):
        filled = [c for c in _row_cells(grid, row) if c.lines]
        values = [c for c in filled if looks_like_value(c.text)]
        if not values or (len(filled) == 1 and filled[0].columns[0] == 0):
            if found:
                break
            continue  # a title, or what heads columns by words
        if names_models(filled[0].text) and len(values) == len(filled) - 1 and len({c.text for c in values}) > 1:
            found.append(row)
            continue
        below = [c for c in grid.cells if c.rows[0] > row and looks_like_value(c.text)]
        wide = all(c.columns[1] - c.columns[0] > 1 and _parts(grid, row, c) for c in values)
        if wide and len(values) == 1 and _labels(filled, values[0]) and values[0].columns[1] == grid.columns:
            break  # one value for all columns
        # A row with its unit gives values for groups of columns.
        wide = wide and not any(is_unit(c.text) for c in filled)
        bold = all(_is_bold(c) for c in filled) and not all(_is_bold(c) for c in below)
        shaded = all(_is_shaded(page, c) for c in filled) and not any(_is_shaded(page, c) for c in below)
        if not below or not (wide or bold or shaded):
            break
        found.append(row)
    return found


def _parts(grid: TableGrid, row: int, cell: Cell) -> bool:
    """Whether values stand side by side below a cell."""
    return any(
        len({c for k in range(*cell.columns) if (c := grid.at(below, k)) is not None and c.lines}) > 1
        for below in range(row + 1, grid.rows)
    )


def _is_bold(cell: Cell) -> bool:
    return all(p.bold for p in cell.pieces if not EXAMPLE.fullmatch(p.text.strip()))


def _is_shaded(page: Page, cell: Cell) -> bool:
    x, y = (cell.box[0] + cell.box[2]) / 2, (cell.box[1] + cell.box[3]) / 2
    return any(b[0] <= x <= b[2] and b[1] <= y <= b[3] for b in page.bars)


def _row_cells(grid: TableGrid, row: int) -> list[Cell]:
    cells = (grid.at(row, column) for column in range(grid.columns))
    return list(dict.fromkeys(c for c in cells if c is not None))


def _labels(cells: Sequence[Cell], value: Cell) -> list[Cell]:
    return [c for c in cells if c.lines and c.columns[1] <= value.columns[0] and not looks_like_value(c.text)]


def _read_row(row: _Row, values: Sequence[Cell], heads: Sequence[int]) -> list[Statement]:
    """The statements of a row's values under the rows of heads over them."""
    labels: list[Cell] = []
    seen = -1
    found = []
    for value in values:
        fresh = [
            c for c in row.cells if c.lines and not looks_like_value(c.text) and seen < c.columns[0] < value.columns[0]
        ]
        words = [c for c in fresh if not is_unit(c.text) and not _is_key(c.text) and any(t.isalnum() for t in c.text)]
        if words:
            labels = words
        after = labels[-1].columns[0] if labels else -1
        units = [is_unit(c.text) for c in _units_for(value, values, fresh, row.cells) if c.columns[0] > after]
        seen = value.columns[0]
        over = _heads_over(row.grid, heads, value, labels)
        found.append(_statement(row, value, labels, over, units[0] if units else ""))
    return found


def _heads_over(grid: TableGrid, heads: Sequence[int], value: Cell, labels: Sequence[Cell]) -> list[Cell]:
    """The heads of a value's column; a value across several columns has those that stand over all of them."""
    over: list[Cell] = []
    for row in heads:
        if row > value.rows[0]:
            continue
        above = [grid.at(row, column) for column in range(*value.columns)]
        cell = above[0]
        if any(c is not cell for c in above):
            beyond = [c for c in _row_cells(grid, row) if c.lines and c.columns[0] >= value.columns[1]]
            before = [c for c in _row_cells(grid, row) if c.lines and c.columns[1] <= value.columns[0]]
            named = [c for c in before if not any(c is one for one in labels) and c.columns[0] > _last(labels)]
            if beyond or named:  # one value for some of the columns: it has all of their heads
                over.extend(c for c in dict.fromkeys(above) if c is not None and c.lines)
            continue
        if cell is not None and cell.lines and not any(cell is c for c in (*over, *labels)):
            over.append(cell)
    return over


def _units_for(value: Cell, values: Sequence[Cell], before: Sequence[Cell], cells: Sequence[Cell]) -> list[Cell]:
    """The unit cells that may hold for a value: those before it (after the last value), else any of the row; where each
    value has one after it, that; of two before pairs of values each its own ("lb | kg | 4,000 | 1,815")."""
    units = [c for c in cells if c.lines and is_unit(c.text)]
    if len(units) == 2 and units[1].columns[0] < values[0].columns[0] and _are_pairs(values, units):
        return [units[next(i for i, v in enumerate(values) if v is value) % 2]]
    ends = [*(v.columns[0] for v in values), cells[-1].columns[1] if cells else 0]
    after = [[u for u in units if a < u.columns[0] < b] for a, b in pairwise(ends)]
    if len(values) > 1 and after[0] and sum(bool(u) for u in after) > 1:
        return next(u for v, u in zip(values, after, strict=True) if v is value)
    return [c for c in before if is_unit(c.text)] + units


def _are_pairs(values: Sequence[Cell], units: Sequence[Cell]) -> bool:
    """Whether each two values are about the same in two units; so is what makers round for each system (24 in for 500
    mm)."""
    said = [read(v.text, unit=is_unit(units[i % 2].text)) for i, v in enumerate(values)]
    if len(said) % 2 or not all(said):
        return False
    first = [readings[0].numbers[0] for readings in said]
    pairs = zip(first[::2], first[1::2], strict=True)
    return all(a.dimension == b.dimension and 0.75 * b.si_value < a.si_value < b.si_value / 0.75 for a, b in pairs)


def _last(labels: Sequence[Cell]) -> int:
    """The last column of a row's labels."""
    return max((c.columns[1] - 1 for c in labels), default=-1)


def _statement(row: _Row, value: Cell, labels: Sequence[Cell], over: Sequence[Cell], unit: str) -> Statement:
    groups, label, own_unit = _label_and_groups(row.grid, value, labels)
    text = value.text
    if not label:
        inline = split_inline(text)
        label, text = inline if inline[0] else (label, text)
    column = [c for c in over if not is_unit(c.text)]
    head_unit = next((u for c in reversed(over) if (u := is_unit(c.text) or unit_in_label(c.text)[1])), "")
    printed = [line.text for c in column for line in c.lines]
    quote = [line.text for c in [*labels, value] for line in c.lines]
    said = "" if COUNTED.search(label) else unit_of_heading(row.section)[1]
    return Statement(
        page=row.page.number,
        row=row.number,
        label=label,
        text=text,
        box=value.box,
        quote=" … ".join(quote if labels else printed + quote),
        context=tuple(c.text for c in groups),
        section=unit_of_heading(EXAMPLE.sub("", row.section).strip())[0],
        column=tuple(unit_in_label(c.text)[0] for c in column if c.text),
        unit=unit or own_unit or head_unit or said,
        example=_is_example(row, [*labels, *over, value]),
        x0=value.box[0],
        heads=tuple(printed) if labels else (),
    )


def _label_and_groups(grid: TableGrid, value: Cell, labels: Sequence[Cell]) -> tuple[list[Cell], str, str]:
    """The cells that are a value's sub-headings, its label, and the unit in that."""
    names = [c for c in labels if not _is_key(c.text)]
    # cells that span more rows than the value are the sub-headings of theirs
    groups = [c for c in names[:-1] if c.rows[1] - c.rows[0] > value.rows[1] - value.rows[0]]
    label, own_unit = _label_of([c for c in names if not any(c is g for g in groups)])
    label, label_unit = unit_in_label(without_key(label))
    return groups, label, own_unit or label_unit


def _is_example(row: _Row, cells: Sequence[Cell]) -> bool:
    """Whether the cells of a value, their heading or a footnote say that it is the publisher's own example."""
    marked = any(EXAMPLE.search(" ".join(p.text for p in c.pieces)) for c in cells)
    pieces = [p for c in cells for p in c.pieces]
    return marked or bool(EXAMPLE.search(row.section)) or marked_by_footnote(row.page, pieces)


def _label_of(cells: Sequence[Cell]) -> tuple[str, str]:
    """The words of label cells, and the unit that stands apart at the end of the last one, alone or behind the symbol
    of a type sheet: "h1 (mm)", "Ast (mm)"; the symbol is no word, but where it lists a product's factors."""
    texts = [c.text for c in cells]
    last = cells[-1] if cells else None
    if last is None or len(last.lines) != 1:
        return " ".join(texts), ""
    if len(last.pieces) > 1 and (unit := is_unit(last.pieces[-1].bare)):
        return " ".join([*texts[:-1], *(p.bare for p in last.pieces[:-1])]), unit
    symbol, unit = unit_in_label(last.text)
    lists = symbol == "s/e/l" and not _LISTED.search(" ".join(texts[:-1]))
    if len(cells) > 1 and unit and not lists and (is_key(symbol) or _SYMBOL.fullmatch(symbol)):
        return " ".join(texts[:-1]), unit
    return " ".join(texts), ""


MANY = 6
"""So many letters in a column make it one of symbols."""
_SYMBOL = re.compile(r"[A-Z][a-z]{1,2}\d?")
_LISTED = re.compile(r"[^\W\d]\s?[/／×x]\s?[^\W\d]+\s?[/／×x]\s?[^\W\d]")


def _is_key(text: str) -> bool:
    """A drawing's letter: "A", "B'", "12"."""
    return len(text) <= 2 and (text[:1].isupper() or text.isdigit())
