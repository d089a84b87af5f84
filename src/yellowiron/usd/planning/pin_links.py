"""Pin links: links of their own at both ends of a cut pin, on machines that a motor slews.

Within a step PhysX (its TGS solver) carries a link's centre of mass straight on, so that the common turn of a cut's two
links seems to pull the cut apart by (speed x step)² / 2 times the distance of their centres of mass. Of that it closes
2/√iterations at the step's end, an eighth with the 255 there are: 0.03 mm at the foot of an excavator's boom that slews
at 12 rpm and 120 Hz, which its linkage shows ten times larger at the bucket. A link that is welded to its body, has
next to no mass and its centre on the pin sees nothing of it: cut between two of those, the bucket's pin errs by 0.09
instead of 0.43 mm. Other engines lose nothing by them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from pxr import Gf, Sdf

from yellowiron.model.mechanism import Joint, Mechanism, hanging
from yellowiron.usd.authoring.metadata import set_custom
from yellowiron.usd.authoring.stage import (
    Names,
    Types,
    apply_schemas,
    define,
    over,
    set_attribute,
    set_display_name,
    set_placement,
    set_targets,
)

KIND = "end"
"""What the record on such a link says it is; its name there is that of the body it is welded to."""
SHARE = 1e-5
"""Of the machine's mass, in each: enough for single precision, and lost in what a machine weighs."""
SLEWED = math.radians(100.0)
"""What cylinders turn by more is slewed: a backhoe by 150° to 180°, the front frame of a loader by 70° to 90°."""
RADIUS = 0.1
"""Metres: gyration of one about any axis."""


@dataclass(frozen=True)
class PinLink:
    """One end of a cut pin: `side` (0 or 1) of the `joint`, welded to `body`; paths of the link and of its weld."""

    joint: Joint
    side: int
    body: str
    path: str
    weld: str


def slewed_cuts(mechanism: Mechanism) -> tuple[Joint, ...]:
    """The cut joints on bodies that a motor turns, as an excavator's swing does its boom's, or cylinders about an axis
    across theirs and as far as a motor would, as a backhoe's."""
    tree = [joint for joint in mechanism.joints if not joint.cut]
    turned = {joint.body1 for joint in tree if joint.drive is not None and joint.drive.kind == "velocity"}
    turned |= {joint.body1 for joint in mechanism.joints if _slews(joint, mechanism)}
    carried = hanging(mechanism, turned)
    return tuple(joint for joint in mechanism.joints if joint.cut and joint.body0 in carried)


def _slews(joint: Joint, mechanism: Mechanism) -> bool:
    """Whether a pivot turns the foot of a linkage by more than `SLEWED`, about an axis across the linkage's."""
    if joint.type != "revolute" or joint.lower is None or joint.upper is None:
        return False
    if not SLEWED < joint.upper - joint.lower < math.inf:
        return False
    carried = (cut.axis for cut in mechanism.joints if cut.cut and cut.body0 == joint.body1)
    return any(abs(float(np.dot(joint.axis, axis))) < 0.5 for axis in carried)


def plan_pin_links(mechanism: Mechanism, root: str, links: Names, joint_scope: str, joints: Names) -> Iterator[PinLink]:
    """Both ends of every slewed cut pivot, named apart from all other links and joints."""
    for joint in slewed_cuts(mechanism):
        if joint.type in ("revolute", "spherical"):
            for side, body in enumerate((joint.body0, joint.body1)):
                name = f"{joint.name}_end{side}"
                yield PinLink(joint, side, body, f"{root}/{links.give(name)}", f"{joint_scope}/{joints.give(name)}")


def write_pin_frames(layer: Sdf.Layer, pin_links: tuple[PinLink, ...]) -> None:
    """In the base layer: an Xform on the pin, axes parallel to the machine's."""
    for link in pin_links:
        spec = define(layer, link.path, "Xform")
        set_display_name(spec, f"{link.joint.name}, end on {link.body}")
        set_placement(spec, link.joint.anchor)
        set_custom(spec, {"kind": KIND, "name": link.body})


def write_pin_links(
    layer: Sdf.Layer, pin_links: tuple[PinLink, ...], mechanism: Mechanism, body_paths: Mapping[str, str]
) -> None:
    """In the physics layer: the links, and the welds to their bodies."""
    mass = SHARE * sum(body.mass for body in mechanism.bodies)
    for link in pin_links:
        spec = over(layer, link.path)
        apply_schemas(spec, "PhysicsRigidBodyAPI", "PhysicsMassAPI")
        set_attribute(spec, "physics:mass", Types.Float, mass)
        set_attribute(spec, "physics:centerOfMass", Types.Point3f, Gf.Vec3f(0.0))
        set_attribute(spec, "physics:diagonalInertia", Types.Float3, Gf.Vec3f(mass * RADIUS**2))
        set_attribute(spec, "physics:principalAxes", Types.Quatf, Gf.Quatf(1.0))
        weld = define(layer, link.weld, "PhysicsFixedJoint")
        set_display_name(weld, f"{link.joint.name}, end on {link.body}")
        set_targets(weld, "physics:body0", body_paths[link.body])
        set_targets(weld, "physics:body1", link.path)
        offset = np.asarray(link.joint.anchor) - np.asarray(mechanism.body(link.body).origin)
        if offset.any():
            set_attribute(weld, "physics:localPos0", Types.Point3f, Gf.Vec3f(*offset.tolist()))
