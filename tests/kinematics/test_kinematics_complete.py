"""What follows from the loops: mobility, limits, branches, gains."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from planar_zbar import length, sketch, strokes, zbar_mechanism

from yellowiron.kinematics import ClosedChain, branch_pivots, branch_sine, complete
from yellowiron.kinematics.completion import ANGLE_MARGIN, SLIDE_MARGIN
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Cylinder, Drive, Joint, Loop, Mechanism


@pytest.fixture(scope="module")
def planar():
    z = sketch()
    return z, strokes(z)


@pytest.fixture(scope="module")
def mechanism(planar):
    return zbar_mechanism(*planar)


@pytest.fixture(scope="module")
def done(mechanism):
    return complete(mechanism)


def changed(mechanism, name, **change):
    return replace(mechanism, joints=tuple(replace(j, **change) if j.name == name else j for j in mechanism.joints))


def test_a_sound_machine_has_no_findings(done):
    assert done.findings == ()


def test_mobility(done):
    assert (done.mobility.computed, done.mobility.expected) == (8, 8)
    assert done.mobility.grubler < 8  # planar loops in space


def test_a_missing_pivot_is_a_locked_loop(mechanism):
    locked = complete(changed(mechanism, "steering_barrel_l_joint", type="fixed"))
    assert locked.mobility.computed == 7 and locked.mobility.expected == 8
    assert "KIN005" in [f.code for f in locked.findings]


def test_what_nothing_holds_is_named(mechanism):
    loose = complete(changed(mechanism, "axle_joint", free=False))
    assert loose.mobility.computed == 8 and loose.mobility.expected == 7
    (finding,) = [f for f in loose.findings if f.code == "KIN005"]
    assert "axle_joint" in finding.hint


def test_limits_are_the_planar_ranges(planar, done):
    z, ((l0, l1), (t0, t1)) = planar
    poses = [z.pose(z.lift + a, z.tilt + b) for a in np.linspace(l0, l1, 61) for b in np.linspace(t0, t1, 61)]
    want = {
        "lift_rod_l_joint": [p["lift"] - p["boom"] for p in poses],
        "tilt_barrel_joint": [-p["tilt"] for p in poses],
        "tilt_rod_joint": [p["tilt"] - p["rocker"] for p in poses],
        "rocker_link_pin": [p["rocker"] - p["link"] for p in poses],
        "bucket_pin": [p["boom"] - p["bucket"] for p in poses],
    }
    for name, angles in want.items():
        joint = done.joint(name)
        # Inside the limits everywhere, and the limits no wider than the margin, but for what the sampling misses.
        assert joint.lower < min(angles) and max(angles) < joint.upper
        assert joint.lower == pytest.approx(min(angles) - ANGLE_MARGIN, abs=math.radians(0.2))
        assert joint.upper == pytest.approx(max(angles) + ANGLE_MARGIN, abs=math.radians(0.2))
        assert "from the loop" in joint.source["limits"]
    twin = done.joint("lift_r")
    assert (twin.lower, twin.upper) == pytest.approx((l0 - SLIDE_MARGIN, l1 + SLIDE_MARGIN), abs=1e-9)


def test_given_limits_stay(mechanism, done):
    for name in ("tilt", "lift_l", "axle_joint", "front_wheel_l_joint"):
        assert (done.joint(name).lower, done.joint(name).upper) == (
            mechanism.joint(name).lower,
            mechanism.joint(name).upper,
        )
    narrow = complete(changed(mechanism, "tilt_barrel_joint", lower=-0.1, upper=0.1))
    assert narrow.joint("tilt_barrel_joint").upper == 0.1
    assert [f.code for f in narrow.findings] == ["KIN006"]


def test_without_a_stroke_nothing_is_limited(mechanism):
    found = complete(changed(mechanism, "tilt", lower=None, upper=None))
    assert [f.code for f in found.findings] == ["KIN009"] and found.findings[0].where == "tilt"
    assert found.joint("rocker_link_pin").lower is None
    assert found.joint("steering_rod_l_joint").lower is not None
    assert found.joint("tilt").drive.stiffness > 0.0


def test_completing_twice_changes_nothing(done):
    again = complete(done)
    assert again.findings == done.findings and again.mobility == done.mobility and again.loops == done.loops
    for one, two in zip(done.joints, again.joints, strict=True):
        assert (one.lower, one.upper) == (two.lower, two.upper)
        assert one.drive == two.drive


def test_a_stroke_past_the_dead_point_is_cut_short(planar, mechanism):
    z, ((l0, _), _) = planar
    longest = length(z.D, z.A) + length(z.A, z.C) - z.lift
    found = complete(changed(mechanism, "lift_l", upper=longest + 0.2))
    assert l0 < found.joint("lift_l").upper < longest
    assert "KIN001" in [f.code for f in found.findings]
    assert "dead point" in found.joint("lift_l").source["upper_reason"]
    chain = ClosedChain(found)
    chain.solve({"lift_l": found.joint("lift_l").upper})


def test_pins_out_of_parallel_are_found(mechanism):
    skew = (math.sin(0.01), math.cos(0.01), 0.0)
    for joint in ("bucket_pin", "tilt_rod_joint"):
        assert "KIN008" in [f.code for f in complete(changed(mechanism, joint, axis=skew)).findings]
    # A ball in its place does not care.
    assert complete(changed(mechanism, "bucket_pin", axis=skew, type="spherical")).findings == ()


def test_a_twin_of_another_stroke_is_found(mechanism):
    cylinders = tuple(
        replace(c, closed_length=c.closed_length + 0.05) if c.name == "lift_r" else c for c in mechanism.cylinders
    )
    found = complete(replace(mechanism, cylinders=cylinders))
    (finding,) = found.findings
    assert finding.code == "KIN004" and finding.where == "lift_r" and "50.0 mm" in finding.message


def test_branches_are_the_cylinders_triangles(mechanism, done):
    pivots = branch_pivots(mechanism)
    assert pivots["boom_pin"] == ("lift_barrel_l_joint", "lift_rod_l_joint", "boom_pin")
    assert pivots["lift_rod_r_joint"] == ("lift_barrel_r_joint", "lift_rod_r_joint", "boom_pin")
    assert pivots["articulation"] == ("steering_barrel_l_joint", "steering_rod_l_joint", "articulation")
    assert pivots["rocker_pin"] == ("tilt_barrel_joint", "tilt_rod_joint", "rocker_pin")
    assert pivots["bucket_pin"] == ("rocker_link_pin", "link_bucket_pin", "bucket_pin")
    assert all(loop.branch in (-1, 1) for loop in done.loops)


def test_branch_sines_are_the_planar_ones(planar, mechanism):
    z, _ = planar
    chain = ClosedChain(mechanism)
    state = chain.solve({"lift_l": 0.1, "tilt": -0.05, "steering_l": 0.1})
    p = z.pose(z.lift + 0.1, z.tilt - 0.05)

    def sine(far, near, closing):
        a, b = far - near, closing - near
        return (a[0] * b[1] - a[1] * b[0]) / (math.hypot(*a) * math.hypot(*b))

    pivots = branch_pivots(mechanism)
    for cut, pins in {
        "boom_pin": (z.C, p["D"], z.A),
        "rocker_pin": (z.E, p["F"], p["G"]),
        "bucket_pin": (p["H"], p["J"], p["B"]),
    }.items():
        # +Y looks away from the x-z plane's viewer: the sign turns round.
        assert branch_sine(chain, state, pivots[cut]) == pytest.approx(-sine(*pins), abs=1e-9)


def crane(angle: float) -> Mechanism:
    """One boom on one cylinder: base pivot A, barrel pivot C, rod pivot D at 1 m up the 3 m boom."""
    a, c = np.array([0.0, 0.0, 0.0]), np.array([1.0, 0.0, -0.2])
    d = np.array([math.cos(angle), 0.0, math.sin(angle)])
    u = (d - c) / np.linalg.norm(d - c)
    still = np.zeros((3, 3))

    def body(name, mass, at, inertia=still):
        return Body(name, tuple(at), mass, tuple(at), inertia, (), np.array([at]))

    boom = replace(body("boom", 1000.0, a, np.diag([10.0, 750.0, 750.0])), center_of_mass=tuple(1.5 * d))
    pitch = (0.0, 1.0, 0.0)
    drive = Drive("position", 0.0, 0.0, 1e6, 0.2)
    drawn = float(np.linalg.norm(d - c))
    lengths = (0.1, 0.06, 0.4, drawn - 0.1, drawn)
    ram = Cylinder("ram", "barrel", "rod", "ram", "barrel_pin", "rod_pin", *lengths, 2e7, 1e5, 1e5, 0.1)
    return Mechanism(
        "crane",
        "crane",
        "base",
        (body("base", 1.0, a), body("barrel", 0.0, c), body("rod", 0.0, c), boom),
        (
            Joint("barrel_pin", "revolute", "base", "barrel", tuple(c), pitch),
            Joint("ram", "prismatic", "barrel", "rod", tuple(c), tuple(u), -0.1, 0.3, drive=drive),
            Joint("rod_pin", "revolute", "rod", "boom", tuple(d), pitch),
            Joint("boom_pin", "revolute", "base", "boom", tuple(a), pitch, cut=True),
        ),
        (ram,),
        (Actuator("boom", "cylinder", (ActuatorJoint("ram"),), ("ram",)),),
        (Loop(("barrel_pin", "ram", "rod_pin", "boom_pin"), "boom_pin"),),
    )  # fmt: skip


def test_the_mass_a_cylinder_sees_is_the_booms_over_its_lever():
    mechanism = crane(0.5)
    chain = ClosedChain(mechanism)
    inertia = 750.0 + 1000.0 * 1.5**2
    c, a = np.array([1.0, -0.2]), np.zeros(2)
    for stroke in (-0.1, 0.0, 0.2):
        state = chain.solve({"ram": stroke})
        turn = chain.coordinate(state, "boom_pin")
        d = np.array([math.cos(0.5 - turn), math.sin(0.5 - turn)])
        u = (d - c) / np.linalg.norm(d - c)
        lever = abs((d - a)[0] * u[1] - (d - a)[1] * u[0])
        assert chain.effective_mass(state, "ram") == pytest.approx(inertia / lever**2, rel=1e-7)


def test_the_mass_a_cylinder_raises_is_the_slope_of_the_heights():
    mechanism = crane(0.5)
    chain = ClosedChain(mechanism)

    def moment(stroke: float) -> float:
        rotations, origins = chain.placements([chain.solve({"ram": stroke})])
        arms = {b.name: np.asarray(b.center_of_mass) - np.asarray(b.origin) for b in mechanism.bodies}
        at = {b.name: chain.body_index(b.name) for b in mechanism.bodies}
        return sum(
            b.mass * float(origins[0, at[b.name], 2] + rotations[0, at[b.name], 2] @ arms[b.name])
            for b in mechanism.bodies
        )

    for stroke in (-0.1, 0.0, 0.2):
        slope = (moment(stroke + 1e-5) - moment(stroke - 1e-5)) / 2e-5
        assert abs(slope) > 10.0
        assert chain.raised_mass(chain.solve({"ram": stroke}), "ram") == pytest.approx(slope, rel=1e-6)


def test_a_branch_near_its_dead_point_is_a_finding():
    mechanism = crane(0.5)
    longest = 1.0 + math.hypot(1.0, 0.2) - mechanism.cylinders[0].drawn_length
    near = complete(changed(mechanism, "ram", upper=longest - 1e-4))
    (finding,) = near.findings
    assert finding.code == "KIN003" and finding.where == "boom_pin"
    assert near.loops[0].branch == complete(mechanism).loops[0].branch != 0


def test_a_velocity_drive_damps_no_more_than_its_inertia_takes():
    mechanism = crane(0.5)
    free = replace(mechanism.joint("boom_pin"), free=False, lower=None, upper=None, cut=False)
    ends = tuple(b for b in mechanism.bodies if b.name in (free.body0, free.body1))

    def damped(damping: float, source: str = "", *, beside: tuple[Body, ...] = ()) -> Drive:
        turned = replace(free, drive=Drive("velocity", 0.0, damping, 1e6, 1.0, source))
        arm = replace(
            mechanism, joints=(turned,), bodies=(*ends, *beside), cylinders=(), actuators=(), loops=(),
            floating=tuple(b.name for b in beside),
        )  # fmt: skip
        found = complete(arm).joint(turned.name).drive
        assert found is not None
        inertia = ClosedChain(arm).effective_mass(ClosedChain(arm).drawn, turned.name)
        return replace(found, damping=found.damping / (inertia + found.armature))

    assert damped(1e9).damping == pytest.approx(600.0, rel=0.05)
    assert damped(1.0).damping < 1.0
    assert damped(1e9, "x; template states damping").damping > 1000.0
    # A ring of shoes runs around with what it turns, and no joint says so.
    assert damped(1e9, beside=(replace(ends[0], name="shoe"),)).damping > 1000.0


def test_velocity_drives_get_damping(mechanism, done):
    drive = done.joint("rear_wheel_l_joint").drive
    assert drive.stiffness == 0.0
    assert drive.damping == pytest.approx(drive.max_force / drive.max_velocity)
    weak = Drive("velocity", 0.0, 0.0, 0.0, 12.0)
    assert [f.code for f in complete(changed(mechanism, "rear_wheel_l_joint", drive=weak)).findings] == ["KIN007"]


def test_a_machine_without_loops_is_complete_too():
    mechanism = crane(0.5)
    free = replace(mechanism.joints[0], free=True)
    arm = replace(mechanism, joints=(free,), bodies=mechanism.bodies[:2], cylinders=(), actuators=(), loops=())
    done = complete(arm)
    assert done.mobility.computed == done.mobility.expected == done.mobility.grubler == 1
    assert done.findings == ()
