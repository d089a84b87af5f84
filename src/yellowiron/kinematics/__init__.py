"""Closed-chain kinematics: the loops solved, limits and gains that follow from them, and the machine measured.

`Mechanism` in; out come the mechanism completed (`complete`), calibrated (`calibrate`) or in a legal start pose
(`started`), `Measurement`s, `PoseTables` and lever tables. MuJoCo is imported with the first function that is asked
for. In order: `tolerances`, `solver` (the loops solved), `completion` (mobility, limits, branch signs, gains),
`workable` (cylinders whose linkage does not work), `start`, `clearance` (bodies that meet), `measuring` (measurements
and calibration), `poses` and `levers` (tables for those who have no solver).

Findings:

======  ========================================================================================================
KIN001  a linkage locks before its cylinder's stroke ends; the slide's limit was drawn in
KIN002  some combinations of strokes lie past a dead point
KIN003  a loop comes near its dead point, or changes its branch, within the strokes
KIN004  a passive twin cylinder would have to leave its own stroke
KIN005  the degrees of freedom are not those of the drives and free joints
KIN006  a stated limit of a pivot is narrower than what the strokes make of it
KIN007  a velocity drive has no force or no speed, so it gets no damping
KIN008  the pins of a loop are not parallel: it does not close exactly
KIN009  a driven slide has no ends of stroke, so what follows from it has no limits
KIN010  a cylinder's closed length was calibrated: on what, and how well (a warning where it fits badly)
KIN011  a closed length is unknown, and no measured specification depends on it
KIN012  a driven joint is drawn outside its limits, or a follower off its place; the start is the nearest legal pose
KIN013  an axis that nothing drawn shows was placed by published dimensions: by which, and how well
KIN014  a published dimension cannot be met wherever the axes that nothing drawn shows may be
KIN015  with the template's pressure a cylinder could not hold the machine's own weight; its force was raised
KIN016  the stroke of a driven cylinder ends early, where its twin on the other side is at the end of its own
KIN017  the drives of a linkage with balls do not determine it in the drawn pose
KIN018  bodies go through each other over the strokes (a warning where a stroke is no sheet's)
KIN019  springs are to hold the machine as drawn, and no forces on the ground do
======  ========================================================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.kinematics.clearance import Meeting, Outline, clearance_findings, meetings
    from yellowiron.kinematics.completion import complete
    from yellowiron.kinematics.levers import lever_table
    from yellowiron.kinematics.measuring.axis_placement import OpenAxis, PlacedAxes, place_axes
    from yellowiron.kinematics.measuring.calibration import calibrate
    from yellowiron.kinematics.measuring.measurement import (
        key_poses,
        measure,
        measure_and_pose,
        still_sizes,
    )
    from yellowiron.kinematics.poses import pose_tables, stroke_poses
    from yellowiron.kinematics.solver.branches import branch_pivots, branch_sine
    from yellowiron.kinematics.solver.chain import ClosedChain, KinematicsError, State
    from yellowiron.kinematics.solver.floating import attached
    from yellowiron.kinematics.start import legal_start, started
    from yellowiron.kinematics.strength import beside, weight
    from yellowiron.kinematics.workable import unworkable

__all__ = [
    "ClosedChain",
    "KinematicsError",
    "Meeting",
    "OpenAxis",
    "Outline",
    "PlacedAxes",
    "State",
    "attached",
    "beside",
    "branch_pivots",
    "branch_sine",
    "calibrate",
    "clearance_findings",
    "complete",
    "key_poses",
    "legal_start",
    "lever_table",
    "measure",
    "measure_and_pose",
    "meetings",
    "place_axes",
    "pose_tables",
    "started",
    "still_sizes",
    "stroke_poses",
    "unworkable",
    "weight",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "ClosedChain": "solver.chain",
        "KinematicsError": "solver.chain",
        "Meeting": "clearance",
        "OpenAxis": "measuring.axis_placement",
        "Outline": "clearance",
        "PlacedAxes": "measuring.axis_placement",
        "State": "solver.chain",
        "attached": "solver.floating",
        "beside": "strength",
        "branch_pivots": "solver.branches",
        "branch_sine": "solver.branches",
        "calibrate": "measuring.calibration",
        "clearance_findings": "clearance",
        "complete": "completion",
        "key_poses": "measuring.measurement",
        "legal_start": "start",
        "lever_table": "levers",
        "measure": "measuring.measurement",
        "measure_and_pose": "measuring.measurement",
        "meetings": "clearance",
        "place_axes": "measuring.axis_placement",
        "pose_tables": "poses",
        "started": "start",
        "still_sizes": "measuring.measurement",
        "stroke_poses": "poses",
        "unworkable": "workable",
        "weight": "strength",
    },
)
