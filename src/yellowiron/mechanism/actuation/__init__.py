"""What moves the joints, how far and how hard: `Placement` × `JointFrame`s × `Specifications` → `FittedCylinder`s,
`Drive` by joint name, `Actuator`s.

`cylinder_geometry` (what the CAD shows of a cylinder), `cylinders` (sizes, stroke, closed length, forces and limits,
each with its source), `drives` (drives of slides, motors and stated joints; the actuators), `direct_drives` (hinges
whose cylinder is not drawn).
"""
