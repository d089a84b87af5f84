"""What words and numbers on a sheet mean, wherever they stand: text in, and out come `tokens` (words in English, of
five languages and more) and `Reading`s (numbers with units, in SI on request).

`units` (how sheets print units), `decimal_style` ← `quantities` (single numbers) ← `numbers` (products, ranges, pairs
of both systems of measurement); `vocabulary` stands alone, its words in `data/words.json` and `data/lexicon.json`.
"""
