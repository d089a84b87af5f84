"""What the tests and the benchmarks make their inputs with; imported as `kit` (`tests` is on the path).

`kit.sheets`: specification sheets whose every value is known. `kit.machines`: machines of solids with their truths, and
the small machine that every engine runs. `kit.cadfiles`: the writers of the CAD files that the readers are given.
`kit.templates`: the library's templates, loaded once. What only one folder of tests uses stays in that folder.
"""
