"""Machines for tests: assemblies of exact solids with the truth of each part, and mechanisms written as USD.

In order: `solids` (shapes with exact features), `synthetic` (a loader drawn by rules, disguises), `crawler`,
`excavators`, `telescope` (cranes), `defects` and `spoken_names` (what goes wrong with a drawn machine, and what makers
call its parts); `small_machine` and `simple_machines` (mechanisms for engines), `tracked_template`, `nameless`.
"""
