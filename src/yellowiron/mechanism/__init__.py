"""Assembly × Template × Alignment × Specifications → Mechanism.

`build_mechanism` gives a `Mechanism` in SI units and the machine frame, without what follows from its loops: gains,
pivot limits, mobility and branches are the kinematics'. In order: `tolerances`, `values` (of specifications, with their
evidence), `declared` (joints that the CAD file declares; compared with those found once these are there), `placement`
(the aligned CAD in the machine frame), `bodies` (what moves together and its mass), `joints` (where they are; tree,
loops and cuts), `actuation` (cylinders and drives), `sites`, `sensors`; `build` puts them in order.

A joint's `source` says `template` (its entry), `method`, `parts` (the CAD parts behind its axis), `residual_deg` and
`residual_mm` (how far these are out of line), `planarity_deg` (how far its axis was turned to be parallel to its
loop's), `cut` (why it was), and of a limit `lower_…`, `upper_…`: `specification`, `source`, `page`, `quote`, or
`missing`.

Findings:

======  ========================================================================================================
MEC001  a joint names no part of the template, or does not join two different bodies; it is left out
MEC002  a body that a joint needs has no part in the CAD model; the joint is left out
MEC003  a joint's axis is a guess: its parts have no cylinder that fits
MEC004  the features of one axis are out of line
MEC005  nothing says where a joint is; it is left out
MEC006  more than one axis fits a joint
MEC007  a part is aligned to a body that the template does not have; it is left out
MEC008  a part has no surface; it is left out
MEC009  a joint's axis is that of a round face of one body only: no pin and no common bore is drawn
MEC010  parallel axes of one loop differ by more than drawing accuracy; they were made parallel
MEC011  a body has no joint that leads to it; it was welded to its ancestor
MEC012  a loop has no pin that could be cut
MEC013  an actuator has no cylinder in the CAD model; its hinge is driven directly
MEC014  no rod in its bore shows the axis of a slide: it is along the line that both its bodies are on
MEC015  no part is the root body; another body stands in for it
MEC016  nothing that is drawn shows a joint's axis: it is where the CAD file declares it
MEC017  an axle, a frame or a slideway is not drawn; the body that would carry it stands in for it
MEC018  a cylinder's linkage does not work as it was found, or does not reach; it stands, its hinge is driven directly
MEC019  nothing moves or holds a body on its pivot or slide; it stands as drawn
MEC020  a bore or rod diameter differs between sheet and CAD
MEC021  the piston's travel in CAD is not the stroke
MEC022  a cylinder's closed length is not known; mid-stroke was assumed, or closed of one without pins
MEC023  a cylinder's stroke is not on the sheet
MEC024  the drawn pose is outside a slide's limits
MEC025  the template's default stands for a value that no sheet gives
MEC026  an actuator has no cylinder or motor left
MEC027  nothing gives a value that a cylinder or motor needs; it has no force limit
MEC028  a twin is driven in the place of the cylinder it follows, which was not found
MEC029  a barrel is drawn without its bore, which was taken from its outer diameter or its thickness
MEC030  a part's material has no density; steel's was taken
MEC031  an open or empty solid: its mass is that of a thin shell
MEC032  masses were scaled to published weights (a warning where the factor is not plausible)
MEC033  published component weights leave nothing of the operating weight
MEC034  a body has no volume and no area; it weighs 1 kg
MEC035  no weight is published, and by volume and density it would weigh far from what is usual, which was assumed
MEC036  the template's default would drive a machine of this weight far too hard, or too weakly; it was put right
MEC037  nothing leads a joint that follows another: its leader was not found, or one of the two is cut
MEC038  knuckles of steered wheels are not drawn: the wheels are steered about upright axes through their middles
MEC039  bodies were held to the usual shares of the weight, which geometry cannot say
MEC040  a site's place was not found
MEC041  no plane meets the edge of an edge site; its x axis points from the hinge to the edge
MEC042  a body's centre of mass was placed by what the front axle carries: by the sheet (info), or as is usual (warning)
MEC043  what the front axle carries cannot be met with a centre of mass inside the body
MEC050  a limit names a specification that is not known; the joint is not limited there
MEC070  hidden wheels stand for a row of which no part is there; they are left out
MEC071  hidden wheels would weigh more than the body that carries the track; it keeps its mass besides
MEC072  tracks and frame are drawn in one: the track is what stands on the ground on its side
MEC073  what holds a ball is not all drawn: it turns only as what is drawn moves it
MEC080  how many of the joints that the file declares agree with those found, and how well
MEC081  a joint that the file declares differs from the one found, or none was found between its bodies
MEC082  joints that the file declares and that cannot be compared: a body of theirs draws nothing
MEC083  values that no sheet gives were taken from the limits of joints that the file declares
======  ========================================================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.mechanism.build import build_mechanism
    from yellowiron.mechanism.declared import ComparedJoint, compare_declared, declared_findings, declared_values
    from yellowiron.mechanism.values import at_known_places

__all__ = [
    "ComparedJoint",
    "at_known_places",
    "build_mechanism",
    "compare_declared",
    "declared_findings",
    "declared_values",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "ComparedJoint": "declared",
        "at_known_places": "values",
        "build_mechanism": "build",
        "compare_declared": "declared",
        "declared_findings": "declared",
        "declared_values": "declared",
    },
)
