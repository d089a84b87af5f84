"""A `LinkTable` → SDFormat: `model` (what both readers take alike), `gazebo` (loops as joints, controllers) and `drake`
(loops as constraints)."""
