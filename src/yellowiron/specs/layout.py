"""The router: which part of a page is a drawn table, which a column of rows, and their statements in reading order."""

from __future__ import annotations

from dataclasses import replace

from yellowiron.specs.lattice import grids_of, read_grid
from yellowiron.specs.lines import blocks_of, lines_of
from yellowiron.specs.rows import legend_of, read_block
from yellowiron.specs.statement import Statement
from yellowiron.specs.words import Page


def statements_of(page: Page) -> list[Statement]:
    """Every value that a page prints, with the words that say what it is.

    Vertical rules: the cells of the drawn grid. Horizontal rules only: what stands between two of them is a row. No
    rules: rows by gaps and overlap.
    """
    lines = lines_of(page.words)
    page = replace(page, legend=legend_of(lines))
    grids = grids_of(page)
    outside = [
        w
        for w in page.words
        if not any(
            g.box[0] - 1 <= (w.x0 + w.x1) / 2 <= g.box[2] + 1 and g.box[1] - 1 <= (w.top + w.bottom) / 2 <= g.box[3] + 1
            for g in grids
        )
    ]
    found: list[Statement] = []
    row = 1000 * page.number
    walls = [r for r in page.rules if not r.horizontal]
    headings: list[tuple[float, float, float, str]] = []
    for block in blocks_of(lines_of(outside, walls), page.bars):
        above = [h for h in headings if h[0] <= block.lines[0].top + 2 and h[1] < block.x1 and block.x0 < h[2]]
        statements, section = read_block(page, block, row, max(above)[3] if above else "")
        headings.append((block.lines[-1].bottom, block.x0, block.x1, section))
        row += len(statements) + len(block.lines) + 1
        found.extend(statements)
    for grid in grids:
        above = [h for h in headings if h[0] <= grid.box[1] + 2 and h[1] < grid.box[2] and grid.box[0] < h[2]]
        title = max(above)[3] if above else ""
        found.extend(read_grid(page, grid, row, title))
        row += grid.rows + 1
    return found
