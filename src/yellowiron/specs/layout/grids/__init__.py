"""Drawn tables: a `Page` in, `TableGrid`s (`lattice.grids_of`) and their `Statement`s (`table_reader.read_grid`) out.

`table_grid` (the cells) ← `partly_ruled` (rules that a table lacks) ← `lattice` (finds the tables) ←
`nested_rows` (cells that hold rows of their own) and `table_reader` (all other cells).
"""
