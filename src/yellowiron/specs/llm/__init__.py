"""A language model as a second reader of the pages, where the user names one: pages and `Wanted` values in,
`Specification`s out, in one word with the rules (`agreement.agreed`).

`pointing` (a place against its page) ← `prompts` ← `page_reader` ← `agreement`.
"""
