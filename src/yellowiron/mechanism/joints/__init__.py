"""Where the joints are and which of them are cut: `Placement` × `Template` → `JointFrame` by joint name, and a `Tree`.

`axes` (lines fitted through cylinder features), `bearings` (the axis on which two bodies turn or slide), `frames` (a
joint with its place), `tree` (which joints make the articulation, which close its loops), `planarity` (nearly parallel
axes of a loop made exactly so), `chains` (rings of track shoes that no joint ties to the machine).
"""
