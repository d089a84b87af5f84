"""Unseen dozers without names: every part in its body, on a C-frame and on push arms; what a high sprocket's track says
of the ground; cylinders on balls that no pin shows."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from kit.machines.defects import drawn
from kit.machines.dozers import dozer
from kit.machines.synthetic import disguise
from kit.machines.unseen import found_whole
from yellowiron import library
from yellowiron.alignment.assignment.search import machine_of, variants_of
from yellowiron.alignment.assignment.weights import between_twins, told_by_length
from yellowiron.alignment.axes.estimate import estimate_axes
from yellowiron.alignment.axes.values import Frame
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.features.tracks import tracks_of
from yellowiron.alignment.fusion.votes import _anywhere
from yellowiron.alignment.labelling.confidence import REVIEW
from yellowiron.alignment.labelling.place import Place
from yellowiron.alignment.labelling.track_places import no_surer_than_frames
from yellowiron.alignment.readings import align
from yellowiron.model.specification import Specifications


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "blade", "dual", "high", "ripper"),
    [
        (601, "pat", False, False, False),
        (602, "push_arms", False, False, False),
        pytest.param(603, "push_arms", True, True, True, marks=pytest.mark.slow),
        pytest.param(604, "pat", False, True, True, marks=pytest.mark.slow),
    ],
)
def test_every_part_is_in_its_body(seed: int, blade: str, dual: bool, high: bool, ripper: bool) -> None:
    machine = dozer(seed, blade, dual=dual, high=high, ripper=ripper)
    found = found_whole(machine, "dozer", seed, triangles=False)
    assert found.choices == {
        "blade": blade, "tilt": "dual" if dual else "single", "ripper": "radial" if ripper else "none",
        "track_frames": "fixed",
    }  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(605, 611))
def test_every_part_is_in_its_body_from_triangles(seed: int) -> None:
    found_whole(drawn("dozer", seed), "dozer", seed, triangles=True)


@pytest.mark.slow
def test_a_dozer_of_which_a_cylinder_is_missing_is_not_whole() -> None:
    """Most of its joints are balls: they count, or a machine of another variant with half of them would do."""
    machine = dozer(602, "push_arms", dual=False, high=False, ripper=True)
    lost = {part: body for part, (_, body) in machine.truth.items() if body.startswith("ripper_lift")}
    machine.parts = [p for p in machine.parts if p.id not in lost]
    assembly, truth, _ = disguise(machine, 602)
    found = align(assembly, library.load_template("dozer"), Specifications())
    assert found.choices["blade"] == "push_arms"
    review = set(found.to_review)
    wrong = [p.part for p in found.parts if p.body != truth[p.part][1]]
    assert set(wrong) <= review


def test_the_ground_of_a_pointed_track_is_its_longest_side() -> None:
    for high in (True, False):
        assembly, _, back = disguise(dozer(601, "pat", high=high, ripper=False), 601)
        tracks = tracks_of(solids_of(assembly))
        assert len(tracks) == 2
        for track in tracks:
            assert (track.above is not None) == high
            if track.above is not None:
                assert float(back[2, :3] @ track.above) > 0.999


def test_a_tilt_cylinder_is_told_from_those_that_angle_and_a_brace_from_a_yoke() -> None:
    template = library.load_template("dozer")
    machines = [machine_of(template, chosen) for chosen in variants_of(template, {})]
    trios = {trio for machine in machines for trio in between_twins(machine)}
    assert ("angle_piston_rod_l", "tilt_piston_rod", "angle_piston_rod_r") in trios
    assert {pair for machine in machines for pair in told_by_length(machine)} == {("tilt_brace", "push_arm_yoke_r")}


def test_the_end_of_a_cylinder_on_a_ball_is_estimated_without_its_pin() -> None:
    """Within a hundredth of the machine's height of where the pin is that is taken away."""
    machine = dozer(601, "pat", high=False, ripper=False)
    assembly = machine.assembly()
    solids = solids_of(assembly)
    pins = {role: p.id for p in machine.parts if (role := machine.truth[p.id][0]).endswith("_pin")}
    ends = {
        "c_frame2lift_piston_rod_l_joint": "lift_piston_rod_l_c_frame_pin",
        "main_frame2lift_cylinder_barrel_r_joint": "lift_cylinder_barrel_r_pin",
        "blade2angle_piston_rod_r_joint": "angle_piston_rod_r_pin",
        "blade2tilt_piston_rod_joint": "tilt_piston_rod_pin",
    }
    gone = {pins[role] for role in ends.values()}
    labels: dict[str, list[int]] = {}
    for solid in solids:
        if solid.part.id not in gone:
            labels.setdefault(machine.truth[solid.part.id][1], []).append(solid.index)
    template = machine_of(library.load_template("dozer"), {"blade": "pat", "tilt": "single", "ripper": "none"})
    left, forward, up = np.eye(3)[[1, 0, 2]]
    found = estimate_axes(solids, labels, template, frame=Frame(forward=forward, left=left, up=up))
    points = np.concatenate([assembly.points_of(p) for p in assembly.parts])
    high = float(np.ptp(points[:, 2]))
    for joint, role in ends.items():
        (part,) = (p for p in assembly.parts if p.id == pins[role])
        corners = assembly.points_of(part)
        middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
        assert np.linalg.norm(found[joint].origin - middle) < 0.01 * high, joint


def test_a_body_that_nobody_measured_fits_no_better_than_one_in_its_place() -> None:
    """A parallelogram ripper's link has no usual place: with none to pay for it drew in whatever was drawn."""
    template = library.load_template("dozer")
    assert "ripper_link" not in template.usual
    known = tuple(template.usual.values())
    broad = _anywhere(known)
    assert all((np.array(broad.low) <= u.low).all() and (np.array(broad.high) >= u.high).all() for u in known)
    assert min(broad.length / max(u.length for u in known), broad.area / max(u.area for u in known)) >= 1.0
    assert {"roller_frame_l", "roller_frame_r", "equalizer_bar"} <= set(template.usual)


@pytest.mark.parametrize(("strength", "body", "sure"), [(0.4, "roller_frame_l", False), (0.8, "roller_frame_l", True),
                                                        (0.4, "main_frame", True)])  # fmt: skip
def test_a_track_goes_with_a_frame_no_surer_than_that_is_found(strength: float, body: str, sure: bool) -> None:
    """26 % of a dozer without pins was silently of frames that rock, which were for review themselves."""
    solids = [SimpleNamespace(part=SimpleNamespace(id=name), surface=1.0) for name in ("frame", "shoe")]
    found = {"frame": Place(body, body, strength, "by its place")}
    shoe = {"shoe": Place("track_shoe_l_1", body, 0.95, "one of a closed row of 34", how="track")}
    place = no_surer_than_frames(shoe, found, solids, "main_frame")["shoe"]  # type: ignore[arg-type]
    assert (place.confidence >= REVIEW) == sure
    assert place.body == body
