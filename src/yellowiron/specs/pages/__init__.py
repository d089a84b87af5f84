"""A page of a PDF as what is drawn on it: `read_page` takes a pypdfium2 page and gives a `Page` of words, rules and
filled bars. Points, origin at the page's top left, y down. What belongs together is not decided here.

`strokes` (rules and bars) ← `words` (characters joined to words; the page); `fills` gives the edges of filled cells as
rules, for the tables of `layout`.
"""
