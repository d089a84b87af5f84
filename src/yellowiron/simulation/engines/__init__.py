"""The engines: each module has `load(setup: Setup) -> Engine`, and imports its engine's own packages.

`coordinates` (joint coordinates from body poses) and `world` (the machine's USD in a world of its own) serve those that
read USD, `newton` and `physx`; `mujoco` reads our MJCF.
"""
