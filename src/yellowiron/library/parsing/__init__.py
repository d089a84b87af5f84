"""The documents of a template, one a module: in a `Document`, out the values of `model.template` that it stands for.

`variants` and `words` come first, then `hierarchy` (roles) and `joints`, or `implied_hierarchy` for joints alone; what
names roles and joints after them: `materials`, `wanted`, `actuators`, `measurements`, `machine_tests`, `sensors`.
`load` puts the whole together, `user_documents` reads some of the same for `--data`.
"""
