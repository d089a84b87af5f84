"""The loops solved: `Mechanism` → `ClosedChain`, which takes coordinates and gives a `State`.

`floating` (rings of track shoes left out), `multibody` (mechanism → MuJoCo model), `independence` (which coordinates
are given, which follow), `chain` (solving, and reading a state), `branches` (by which triangle of pivots a flip of a
loop is known) and `pose_grid` (a lattice of states over the strokes) on top of it.
"""
