"""What is written for other programs, read as the rules read a stage: URDF, SDFormat (Gazebo's, Drake's), MJCF.

Links and joints alone, at all joints' zero: shapes, materials and an engine's settings are not read.
"""
