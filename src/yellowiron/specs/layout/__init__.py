"""Which words say what a value is: a `Page` in, `Statement`s out (`router.statements_of`), one for each cell that holds
a value; and, by another way, `Near` values with the words next to them (`nearest.nearest_of`).

`tolerances` ← `statement` (pieces of text, their kinds, the statement) ← `rows` (pages read by gaps and overlap) ←
`grids` (drawn tables, whose cells may hold rows) ← `router`; `nearest` uses `rows` alone.
"""
