"""A `LinkTable` → ROS 2: `urdf` (the description package), `joint_states` (a script beside it, which stands alone)."""
