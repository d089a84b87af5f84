"""Fusion: several readings of a machine, one judge.

In: an `Observation`, what the names say of each solid, and the best answer that the contacts alone gave. Out: a
`Reading`: solid → body, with how much better that is than the next best.

What is exact on a machine drawn by an engineer (pins in bores, closed solids) is approximate or absent on an artist's.
Here nothing is exact: pieces of the machine (`pieces`) are labelled with bodies so that one score is the greatest, to
which every reading adds what it knows: names and shapes speak for a piece's body (`votes`), contacts, assemblies and
shared axes for pairs of pieces that are one body or turn on each other (`bonds`). `trust` says what names are worth,
`judge` what a labelling scores, `annealing` finds the best one, `reading` gives it back as an answer that the rest of
the alignment goes on with.
"""
