"""Front frame with cab, rear frame with engine, tandems, ripper. Machine frame, millimetres.

The frames' forks and plates meet on one upright pin; the cylinders beside it bend the machine there.
"""

from __future__ import annotations

import math

from OCP.TopoDS import TopoDS_Shape

from drawing.cylinders import Cylinder
from drawing.hardware import CLEARANCE, bush, fit_pin, pin
from drawing.product import AMBER, BLACK, GLASS, GREY, STEEL, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import X, Y, Z, bored, box, cut, fuse, mirrored, plate, rod, sheet_box, shift, turn

from . import values as v
from .axle import OSCILLATION_Z, PIN_OSCILLATION, SPINDLE
from .blade import NOSE_BALL, PIN_SADDLE, stud
from .linkage import (
    AXLE_X,
    MIDDLE_X,
    NOSE,
    RADIUS,
    REAR_X,
    RIPPER_FOOT,
    RIPPER_PIVOT,
    RIPPER_RAISED,
    RIPPER_TIP,
    SADDLE,
    TANDEM_X,
    Linkage,
    rip_for,
    ripped,
    solve_bend,
)

FRONT, REAR = "front_frame", "rear_frame"
PIN_HITCH, PIN_BEND, PIN_TANDEM, PIN_RIPPER, PIN_RIP = 110.0, 50.0, 150.0, 80.0, 50.0
"""Diameters."""
BEND_Z = 1_040.0
"""Height of the articulation's cylinders."""
FORK = ((880.0, 940.0), (1_260.0, 1_320.0))
"""Heights of the rear frame's plates on the articulation's pin."""
EARS = (("LWR", BEND_Z - 72.0), ("UPR", BEND_Z + 42.0))
CASE = (560.0, 700.0)
"""The tandems' cases across."""
TAIL_X = float(ripped(rip_for(RIPPER_RAISED), RIPPER_TIP)[0])
"""The rearmost point, the ripper's tips as drawn."""
PUSH_X = v.LENGTH.value + TAIL_X
"""The foremost, the push plate's."""
RIP_Y = 260.0
BEAM = 150.0
"""Half of the main beam's width."""


def draw_front(hardware: Assembly) -> Assembly:
    """The main beam with its nose, push plate, the lugs of saddle, axle and drawbar, the articulation's half."""
    tree = Assembly("FRONT FRAME WELDMENT")
    beam = plate([(190, 950, 0), (1_750, 950, 0), (2_300, 1_560, 0), (4_200, 1_560, 0), (4_950, 1_010, 0),
                  (5_700, 1_010, 0), (5_700, 1_300, 0), (5_050, 1_300, 0), (4_400, 1_800, 0), (2_200, 1_800, 0),
                  (1_500, 1_360, 0), (190, 1_360, 0)], "xz", -BEAM, BEAM)  # fmt: skip
    tree.add(Part("MAIN BEAM", beam), FRONT)
    plate_low = box(5_700, PUSH_X, -330, 330, 640, 1_300)
    tree.add(Part("PUSH PLATE", plate_low, BLACK), FRONT)
    for name, x in (("FRT", AXLE_X + 105), ("RR", AXLE_X - 150)):
        shape = box(x, x + 45, -90, 90, OSCILLATION_Z - 70, 1_010)
        tree.add(Part(f"AXLE LUG {name}", bored(shape, X, ((x, 0, OSCILLATION_Z), PIN_OSCILLATION / 2))), FRONT)
    nx, _, nz = (float(c) for c in NOSE)
    lug = bored(box(nx + 180, nx + 240, -90, 90, nz - 90, 1_010), X, ((nx, 0, nz), 0.45 * NOSE_BALL))
    tree.add(Part("DRAWBAR LUG", lug), FRONT)
    stud(hardware, (nx, 0, nz), (-1.0, 0.0, 0.0), NOSE_BALL, 240.0, FRONT, "drawbar_ball_pin")
    sx, _, sz = (float(c) for c in SADDLE)
    for name, x in (("RR", sx - 130), ("FRT", sx + 210)):
        lug = plate([(0, sz, 90), (-BEAM, 1_800, 0), (BEAM, 1_800, 0)], "yz", x, x + 60)
        tree.add(Part(f"SADDLE LUG {name}", bored(lug, X, ((0, 0, sz), PIN_SADDLE / 2))), FRONT)
    # The articulation: two forks about the rear frame's plates, ears for the barrels.
    for name, (z0, z1) in zip(("LWR", "UPR"), FORK, strict=True):
        for part, start in (("A", z0 - 50), ("B", z1 + 10)):
            fork = plate([(0, 0, 120), (150, -200, 0), (150, 200, 0)], "xy", start, start + 40)
            tree.add(Part(f"HITCH FORK {name} {part}", bored(fork, Z, ((0, 0, 0), PIN_HITCH / 2))), FRONT)
        fit_pin(hardware, (0, 0, z0 - 50), PIN_HITCH, z1 - z0 + 100, FRONT, "articulation_pin", upright=True)
    tree.add(Part("HITCH WALL", box(150, 190, -320, 320, 800, 1_400)), FRONT)
    px, py = (float(c) for c in solve_bend().P)
    for name, start in EARS:
        ear = plate([(px, py, 50), (px - 120, BEAM, 0), (px + 90, BEAM, 0)], "xy", start, start + 30)
        add_pair(tree, f"ARTIC CYL EAR {name}", bored(ear, Z, ((px, py, 0), PIN_BEND / 2)), FRONT)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        role = f"articulation_cylinder_barrel_{letter}_pin"
        fit_pin(hardware, (px, sign * py, BEND_Z - 78), PIN_BEND, 156, FRONT, role, upright=True)
    return tree


def draw_cab() -> Assembly:
    """Cab on the front frame."""
    tree, top = Assembly("CAB ASSY"), v.HEIGHT.value

    def put(name: str, shape: TopoDS_Shape, colour: Colour = BLACK) -> None:
        tree.add(Part(name, shape, colour), FRONT)

    put("CAB FLOOR", box(260, 1_700, -640, 640, 1_400, 1_440))
    put("CAB MOUNT", box(420, 1_400, -BEAM, BEAM, 1_360, 1_400), GREY)
    side = [(270.0, 1_440.0, 0.0), (1_690.0, 1_440.0, 0.0), (1_560.0, top - 90, 0.0), (300.0, top - 90, 0.0)]
    window = [(420.0, 1_700.0, 0.0), (1_540.0, 1_700.0, 0.0), (1_440.0, top - 210, 0.0), (440.0, top - 210, 0.0)]
    for name, y in (("LH", 600.0), ("RH", -640.0)):
        put(f"CAB SIDE {name}", cut(plate(side, "xz", y, y + 40), plate(window, "xz", y - 1, y + 41)))
        put(f"SIDE GLASS {name}", plate(window, "xz", y + 16, y + 24), GLASS)
    put("CAB ROOF", sheet_box(270, 1_620, -660, 660, top - 90, top, 5.0))
    put("CAB BACK", box(300, 330, -600, 600, 1_440, top - 90))
    put("SEAT BASE", sheet_box(650, 1_050, -220, 220, 1_440, 1_760, 4.0), GREY)
    put("SEAT", fuse(box(620, 1_080, -240, 240, 1_760, 1_870), box(560, 650, -240, 240, 1_760, 2_480)))
    put("CONSOLE", sheet_box(1_350, 1_560, -180, 180, 1_440, 2_100, 4.0), GREY)
    for y in (-520.0, 420.0):
        put("WORK LAMP", box(1_620, 1_680, y, y + 100, top - 80, top - 10), AMBER)
    return tree


def draw_rear(hardware: Assembly) -> Assembly:
    """Rails with the articulation's half, the axle's housing, engine, hood, tanks, counterweight and ripper lugs."""
    tree = Assembly("REAR FRAME WELDMENT")

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, shape, colour), REAR)

    for name, (z0, z1) in zip(("LWR", "UPR"), FORK, strict=True):
        tongue = plate([(0, 0, 130), (-260, 260, 0), (-260, -260, 0)], "xy", z0, z1)
        put(f"HITCH TONGUE {name}", bored(tongue, Z, ((0, 0, 0), 75.0)))
        tree.add(bush(150, PIN_HITCH, z1 - z0), REAR, at=shift(0, 0, z0).Multiplied(turn(X, 90.0)))
    put("HITCH HEAD", box(-320, -260, -420, 420, 860, 1_340))
    add_pair(tree, "RR RAIL", box(-3_060, -320, 340, 420, 900, 1_150), REAR)
    for x in (-1_500.0, -2_600.0):
        put("X-MEMBER", box(x - 40, x, -340, 340, 930, 1_110))
    qx, qy = (float(c) for c in solve_bend().Q)
    for name, start in EARS:
        ear = plate([(qx, qy, 50), (qx - 120, 420, 0), (qx + 10, 420, 0)], "xy", start, start + 30)
        add_pair(tree, f"ARTIC ROD EAR {name}", bored(ear, Z, ((qx, qy, 0), PIN_BEND / 2)), REAR)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        role = f"articulation_piston_rod_{letter}_pin"
        fit_pin(hardware, (qx, sign * qy, BEND_Z - 78), PIN_BEND, 156, REAR, role, upright=True)
    ball_radius = RADIUS - v.GROUND_CLEARANCE.value
    case = fuse(rod((TANDEM_X, -CASE[0] + 20, RADIUS), Y, 150, 2 * CASE[0] - 40),
                rod((TANDEM_X, -180, RADIUS), Y, ball_radius, 360))  # fmt: skip
    pads = [box(TANDEM_X - 140, TANDEM_X + 140, y, y + 80, RADIUS, 900) for y in (340.0, -420.0)]
    put("AXLE HOUSING", bored(fuse(case, *pads), Y, ((TANDEM_X, 0, RADIUS), PIN_TANDEM / 2)), GREY)
    put("ENGINE", sheet_box(-2_500, -1_100, -370, 370, 1_150, 1_900, 30.0), GREY)
    hood = cut(box(-2_880, -900, -480, 480, 1_150, 2_250), box(-2_872, -908, -472, 472, 1_140, 2_242))
    put("ENGINE HOOD", hood)
    put("RADIATOR", box(-2_840, -2_720, -440, 440, 1_150, 2_150), BLACK)
    put("FUEL TANK", sheet_box(-880, -420, -460, 460, 1_350, 1_950, 5.0))
    add_pair(tree, "TANK FOOT", box(-860, -440, 350, 410, 1_150, 1_350), REAR, GREY)
    put("EXHAUST STACK", rod((-1_400, 200, 2_250), Z, 60, 700), BLACK)
    put("REAR WALL", box(-2_920, -2_880, -430, 430, 1_150, 1_560))
    rx, rz = (float(c) for c in RIPPER_PIVOT)
    fx, fz = (float(c) for c in RIPPER_FOOT)
    for name, y in (("IN", RIP_Y - 54), ("OUT", RIP_Y + 32)):
        ear = plate([(rx, rz, 70), (rx + 90, 900, 0), (rx - 90, 900, 0)], "xz", y, y + 22)
        add_pair(tree, f"RIPPER EAR {name}", bored(ear, Y, ((rx, 0, rz), PIN_RIPPER / 2)), REAR)
        lug = plate([(fx, fz, 45), (-2_920, fz - 80, 0), (-2_920, fz + 80, 0)], "xz", y, y + 22)
        add_pair(tree, f"RIPPER CYL LUG {name}", bored(lug, Y, ((fx, 0, fz), PIN_RIP / 2)), REAR)
    add_pair(tree, "RIPPER EAR FOOT", box(rx - 90, rx + 90, 190, 340, 900, 930), REAR)
    return tree


def draw_tandems(hardware: Assembly) -> Assembly:
    """A case on either side, with the spindles of its two wheels."""
    tree, half = Assembly("TANDEMS"), v.TANDEM.value / 2
    out = v.TREAD.value / 2 + 60
    outline = [(TANDEM_X - half, RADIUS, 165.0), (TANDEM_X + half, RADIUS, 165.0), (TANDEM_X, RADIUS + 20, 230.0)]
    case = plate(outline, "xz", *CASE)
    for x in (MIDDLE_X, REAR_X):
        case = fuse(case, rod((x, CASE[1], RADIUS), Y, 110, 60), rod((x, CASE[1], RADIUS), Y, SPINDLE, out - CASE[1]))
    case = bored(case, Y, ((TANDEM_X, 0, RADIUS), PIN_TANDEM / 2 + CLEARANCE))
    for letter, shape, sign in (("l", case, 1.0), ("r", mirrored(case), -1.0)):
        tree.add(Part(f"TANDEM CASE {letter.upper()}H", shape), f"bogie_beam_{letter}")
        start = CASE[0] - 120 if sign > 0 else -CASE[1] - 12
        fit_pin(
            hardware, (TANDEM_X, start, RADIUS), PIN_TANDEM, CASE[1] - CASE[0] + 132, REAR, f"bogie_beam_{letter}_pin"
        )
    return tree


def draw_ripper(k: Linkage, up: float, hardware: Assembly) -> Assembly:
    """The ripper turned up so far from where its tips are on the ground: two arms, a beam, three shanks."""
    tree, body = Assembly("RIPPER ASSY"), "ripper_beam"
    px, pz = (float(c) for c in RIPPER_PIVOT)
    at = turn(Y, math.degrees(up), (px, 0, pz))
    (ex, ez), (tx, tz), low = (float(c) for c in k.ripper_eye), (float(c) for c in RIPPER_TIP), 560.0
    back = tx - 80.0
    outline = [(px, pz, 62), (ex, ez, 48), (back + 200, 700, 0), (back + 200, low, 0)]
    arm = plate(outline, "xz", RIP_Y - 22, RIP_Y + 22)
    arm = bored(arm, Y, ((px, 0, pz), PIN_RIPPER / 2 + CLEARANCE))
    eye = cut(arm, box(ex - 90, ex + 90, RIP_Y - 30, RIP_Y + 30, ez - 55, ez + 90))
    for y in (RIP_Y - 54, RIP_Y + 32):
        lug = plate([(ex, ez, 48), (ex - 110, ez - 130, 0), (ex + 130, ez - 130, 0)], "xz", y, y + 22)
        eye = fuse(eye, bored(lug, Y, ((ex, 0, ez), PIN_RIP / 2)))
    eye = fuse(eye, box(ex - 110, ex + 130, RIP_Y - 54, RIP_Y + 54, ez - 130, ez - 100))
    for name, shape in (("LH", eye), ("RH", mirrored(eye))):
        tree.add(Part(f"RIPPER ARM {name}", shape), body, at=at)
    tree.add(Part("RIPPER BEAM", box(back, back + 200, -900, 900, low, 700)), body, at=at)
    shank = [(tx, tz, 0), (tx + 60, 300, 0), (back + 180, low, 0), (back + 50, low, 0), (tx - 50, 300, 0)]
    for number, y in enumerate((-750.0, -25.0, 700.0), 1):
        tree.add(Part("RIPPER SHANK", plate(shank, "xz", y, y + 50), STEEL), body, f"ripper_shank_{number}", at)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        fit_pin(hardware, (px, sign * RIP_Y - 62, pz), PIN_RIPPER, 124, REAR, "ripper_beam_pin")
        middle = at.Multiplied(shift(ex, sign * RIP_Y - 60, ez))
        hardware.add(pin(PIN_RIP, 120), body, f"ripper_lift_piston_rod_{letter}_pin", middle)
        fx, fz = (float(c) for c in RIPPER_FOOT)
        role = f"ripper_lift_cylinder_barrel_{letter}_pin"
        fit_pin(hardware, (fx, sign * RIP_Y - 60, fz), PIN_RIP, 120, REAR, role)
    return tree


def sizes(k: Linkage, ripper: float) -> dict[str, Cylinder]:
    """Of an articulation and a ripper cylinder, at drawn lengths."""
    return {
        "bend": Cylinder(
            "ARTIC CYL", v.BEND_BORE.value, v.BEND_ROD.value, v.BEND_STROKE.value, v.BEND_CLOSED.value,
            solve_bend().length(0.0), outside=105, pin=PIN_BEND, eye=46, eye_width=76, base=95, cap=28, piston=50,
            gland=60, port=11.0,
        ),
        "ripper": Cylinder(
            "RIPPER CYL", v.RIPPER_BORE.value, v.RIPPER_ROD.value, v.RIPPER_STROKE.value, k.ripper_closed, ripper,
            outside=108, pin=PIN_RIP, eye=42, eye_width=56, base=100, cap=22, piston=42, gland=46, port=10.0,
        ),
    }  # fmt: skip
