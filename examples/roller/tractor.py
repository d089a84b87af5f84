"""Hitch, and what is behind it: the rear frame with its forks, its axle or its yoke, engine, platform and canopy.
Machine frame, millimetres.

The hitch turns on two upright pins in the rear frame's forks; the front frame's tube turns in the hitch's ring.
"""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import fit_pin
from drawing.product import BLACK, GREY, RED, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import X, Y, Z, bored, box, cut, fuse, plate, ring, rod, sheet_box, turned

from . import values as v
from .drum import BEAM, CLEARANCE, HIGH, RING, TUBE
from .layout import ROLL_Z, STEER_Z, front_x, rear_x, solve_steering

BODY = "rear_frame"
PIN_ARTICULATION, PIN_STEER = 90.0, 40.0
HITCH_PLATES = ((740.0, 800.0), (1200.0, 1260.0))
"""Heights of the hitch's lower and upper plate."""
EARS = (("LWR", STEER_Z - 60.0), ("UPR", STEER_Z + 35.0))
RAIL = (430.0, 490.0)
"""Inner and outer face of the rear frame's rails, …"""
RAIL_LOW, RAIL_HIGH = 640.0, 1340.0
"""… their lowest and their upper edge."""
WALL = -400.0
"""The face that carries the forks."""
SPINDLE = 80.0


def draw_hitch(hardware: Assembly) -> Assembly:
    """Two plates on the upright pins, a wall ahead of them with ears for the steering cylinders, the ring."""
    tree, body, wall = Assembly("HITCH ASSY"), "hitch", 330.0
    for (low, high), name in zip(HITCH_PLATES, ("HITCH PL LWR", "HITCH PL UPR"), strict=True):
        shape = plate([(0, 0, 120), (wall, -300, 0), (wall, 300, 0)], "xy", low, high)
        tree.add(Part(name, bored(shape, Z, ((0, 0, 0), PIN_ARTICULATION / 2 + CLEARANCE))), body)
    tree.add(Part("HITCH WALL", box(wall, wall + 70, -380, 380, HITCH_PLATES[0][0], HITCH_PLATES[1][1])), body)
    tree.add(Part("ROLL BEARING HOUSING", ring((wall + 70, 0, ROLL_Z), X, RING, TUBE + CLEARANCE, 260), GREY), body)
    qx, qy = solve_steering().Q
    for name, start in EARS:
        ear = plate([(qx, qy, 44), (wall, qy - 80, 0), (wall, qy + 50, 0)], "xy", start, start + 25)
        add_pair(tree, f"STRG EAR {name}", bored(ear, Z, ((qx, qy, 0), PIN_STEER / 2)), body)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        role = f"steering_piston_rod_{letter}_pin"
        fit_pin(hardware, (qx, sign * qy, STEER_Z - 70), PIN_STEER, 140, body, role, upright=True)
    return tree


def draw_rear_frame(m: v.Machine, hardware: Assembly) -> Assembly:
    """Forks, rails, ears of the steering cylinders; the rails end at a drum's frame, or go on over an axle."""
    tree = Assembly("TRACTOR FRAME")
    inside, outside = RAIL
    beam = rear_x(m) + BEAM[1]
    end = beam if m.tyre is None else rear_x(m) - 700.0
    outline = [(WALL - 40, RAIL_LOW, 0), (WALL - 40, RAIL_HIGH, 0), (end, RAIL_HIGH, 0), (end, 900, 0),
               (max(end, -900.0), 900, 0), (-780, RAIL_LOW, 0)]  # fmt: skip
    if m.tyre is None:
        outline = [(WALL - 40, RAIL_LOW, 0), (WALL - 40, RAIL_HIGH, 0), (end, RAIL_HIGH, 0), (end, RAIL_LOW, 0)]
    add_pair(tree, "RR RAIL", plate(outline, "xz", inside, outside), BODY)
    for name, low, high in (("LWR", RAIL_LOW, 860.0), ("UPR", 1140.0, RAIL_HIGH)):
        tree.add(Part(f"BULKHEAD {name}", box(WALL - 40, WALL, -560, 560, low, high)), BODY)
    for z0, z1 in HITCH_PLATES:
        for name, start in (("FORK PL LWR", z0 - 60), ("FORK PL UPR", z1 + 10)):
            fork = plate([(0, 0, 105), (WALL, 330, 0), (WALL, -330, 0)], "xy", start, start + 50)
            tree.add(Part(name, bored(fork, Z, ((0, 0, 0), PIN_ARTICULATION / 2))), BODY)
        at = (0.0, 0.0, z0 - 60)
        fit_pin(hardware, at, PIN_ARTICULATION, z1 - z0 + 120, BODY, "articulation_pin", upright=True)
    px, py = solve_steering().P
    for name, start in EARS:
        ear = plate([(px, py, 44), (px + 60, inside, 0), (px - 110, inside, 0)], "xy", start, start + 25)
        add_pair(tree, f"STRG BRKT {name}", bored(ear, Z, ((px, py, 0), PIN_STEER / 2)), BODY)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        role = f"steering_cylinder_barrel_{letter}_pin"
        fit_pin(hardware, (px, sign * py, STEER_Z - 70), PIN_STEER, 140, BODY, role, upright=True)
    return tree


def draw_axle(m: v.Machine) -> Assembly:
    """The axle under the rails, with its spindles; none where a drum is in its place."""
    tree = Assembly("RR AXLE ASSY")
    if m.tyre is None:
        return tree
    x, z, low = rear_x(m), m.tyre[0].value / 2, m.ground.value
    half, tube = m.tyre[2].value / 2 + 60, 110.0
    left = [(half, 0.0), (half, SPINDLE), (half - 290, SPINDLE), (half - 290, tube), (230.0, tube), (170.0, z - low)]
    right = [(-s, q) for s, q in reversed(left)]
    case = turned([*left, *right], (x, 0, z), Y)
    pads = [box(x - 130, x + 130, y, y + RAIL[1] - RAIL[0], z + 60, 900) for y in (RAIL[0], -RAIL[1])]
    tree.add(Part("AXLE HOUSING", fuse(case, *pads), GREY), BODY)
    return tree


def draw_superstructure(m: v.Machine) -> Assembly:
    """Engine under its hood, tanks, platform with seat and console, canopy."""
    tree, x, top = Assembly("SUPERSTRUCTURE"), rear_x(m), m.height.value

    def put(name: str, shape: TopoDS_Shape, colour: Colour = GREY) -> None:
        tree.add(Part(name, shape, colour), BODY)

    if m.tyre is None:
        rear = x - BEAM[1]
        for name, start in (("FRT", x + BEAM[0]), ("RR", rear)):
            add_pair(tree, f"BED POST {name}", box(start, start + BEAM[1] - BEAM[0], 500, 600, HIGH, 1440), BODY, GREY)
        put("ENGINE BED", box(rear, x + BEAM[1] - 100, -620, 620, 1440, 1460))
        bed = 1460.0
    else:
        rear = tail(m)
        put("ENGINE BED", box(rear, x + 450, -RAIL[1], RAIL[1], RAIL_HIGH, RAIL_HIGH + 20))
        put("TAIL WEIGHT", box(rear, x - 700, -RAIL[1], RAIL[1], 820, RAIL_HIGH), YELLOW)
        bed = RAIL_HIGH + 20.0
    put("ENGINE", sheet_box(rear + 250, rear + 1150, -330, 330, bed, bed + 480, 40.0))
    half = 600.0 if m.tyre is None else RAIL[1] - 20
    inside = box(rear + 6, rear + 1344, 6 - half, half - 6, bed - 1, bed + 614)
    hood = cut(box(rear, rear + 1350, -half, half, bed, bed + 620), inside)
    put("HOOD", cut(hood, box(rear - 10, rear + 20, -400, 400, bed + 100, bed + 500)), YELLOW)
    put("GRILLE", box(rear, rear + 6, -400, 400, bed + 100, bed + 500), BLACK)
    put("EXHAUST STACK", rod((rear + 1000, 400, bed + 620), Z, 45, 500), BLACK)
    deck = RAIL_HIGH + 20
    put("PLATFORM", box(-900, -120, -700, 700, RAIL_HIGH, deck))
    seat = fuse(box(-800, -420, -230, 230, deck, deck + 420), box(-850, -800, -230, 230, deck, deck + 900))
    put("SEAT", seat, BLACK)
    put("CONSOLE", box(-260, -180, -350, 350, deck, deck + 850), BLACK)
    for name, at in (("FRT", -200.0), ("RR", -890.0)):
        add_pair(tree, f"ROPS POST {name}", box(at, at + 60, 620, 690, deck, top - 60), BODY, BLACK)
    put("CANOPY ROOF", box(-980, -60, -780, 780, top - 60, top), YELLOW)
    for name, y in (("LH", 470.0), ("RH", -550.0)):
        put(f"TAIL LAMP {name}", box(rear, rear + 30, y, y + 80, bed + 640, bed + 700), RED)
        put(f"STEP {name}", box(-760, -520, y * 1.05, y * 1.05 + 60, 1100, 1120), GREY)
    return tree


def tail(m: v.Machine) -> float:
    """The rearmost point: what the overall length takes from the front frame's foremost one."""
    return front_x(m) + BEAM[1] - m.length.value
