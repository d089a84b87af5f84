"""The values as a language model finds them, where the user names one: `Claim`s and `Wanted` values in,
`Specification`s out (`extractor.find`), and one word with the rules (`agreement.agreed`).

`endpoint` (questions out, checked answers back) ← `prompts` ← `extractor`; `agreement` stands alone.
"""
