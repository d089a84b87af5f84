"""What loads and still would not make a machine: in a `Template`, out a `LintReport` of findings and mobilities.

`lint` asks, for every set of choices, in this order: `entries` (with `named_values`) for what no choice changes,
`choices` for what a choice leaves without what it needs, `mobility` for the freedom of what is left, and `movement` for
what to say of it.
"""
