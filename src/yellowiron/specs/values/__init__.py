"""Which statement gives which value: `Statement`s and the template's `Wanted` values in, `Specification`s out, each
with its evidence and status.

`tolerances`, `requested` (what is asked for), `stated_configuration`, `enumerations` ← `claims` (one property, one
quantity) ← `matching` (claims × wanted values) ← `decision` (one value with a status) ← `values_in_labels`,
`cross_check` (the second reading, by nearness). `overrides`: values that a person gives, and who wins.
"""
