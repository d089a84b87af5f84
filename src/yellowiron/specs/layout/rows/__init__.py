"""Rows without a drawn table: words in; text lines, columns of text and, by `read_block`, `Statement`s out.

`lines` (words → lines → columns of text) ← `headings`, `legends` (a drawing's keys), `key_columns` (keys beside
the rows), `prose` (running text), `two_line_rows`, `cells` (the values of one row, and their statements) ← `row_bands`
(what stands between two rules) ← `reader_state` (what rows say about those below) ← `word_rows`, `value_rows` ←
`row_reader`.
"""
