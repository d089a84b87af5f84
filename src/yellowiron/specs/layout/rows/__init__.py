"""Rows without a drawn table: words in; text lines, columns of text and, by `read_block`, `Statement`s out.

`lines` (words → lines → columns of text) ← `headings`, `legends` (a drawing's keys), `prose` (running text), `cells`
(the values of one row, and their statements) ← `row_bands` (which lines are a row) ← `reader_state` (what rows say
about those below) ← `word_rows`, `value_rows` ← `row_reader`.
"""
