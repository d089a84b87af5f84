"""The mast: nested channel sections, lift rams, carriage with forks. Machine frame, upright, millimetres: x = 0 at the
front axle, z = 0 on the ground.

Sections are counted from the innermost. Each channel opens inwards and stands `GAP` inside the next; the carriage's
brackets run in the innermost. A mast of one stage is a single section, of two (`simplex`, `duplex`) and three
(`triplex`) stages as many.
"""

from __future__ import annotations

from dataclasses import dataclass

from drawing.cylinders import Ram, draw_ram
from drawing.hardware import CLEARANCE, fit_pin
from drawing.product import BLACK, GREY, STEEL, Assembly, Part, Use
from drawing.solids import X, Y, bored, box, cut, mirrored, plate, ring, shift

from . import values as v

MID = 330.0
"""x of the middle of the channels."""
GAP, WEB = 8.0, 16.0
PIVOT = (200.0, 330.0)
"""x and z of the mast's pivot, under the front axle."""
PIN_MAST, PIN_TILT = 60.0, 45.0
BOTTOM, TOP, STEP = 130.0, 2400.0, 70.0
"""The outermost section's channels reach from 10 mm under `BOTTOM` to `TOP`, each one inside it `STEP` higher."""
RAM = (160.0, 300.0, 170.0)
"""Where the left lift ram's foot stands."""
FREE_RAM = (360.0, 0.0, 320.0)
TILT_BACK = 70.0
"""How far the tilt cylinder's pin is behind the outer channel."""
STAGES = {"simplex": 2, "duplex": 2, "triplex": 3}
FACE = v.LOAD_DISTANCE.value
"""x of the forks' faces."""


@dataclass(frozen=True)
class Mast:
    """A kind of mast and how far its rams are out in the file: `lift` of those at the sides, `free` of the middle
    one."""

    kind: str = "simplex"
    lift: float = 300.0
    free: float = 0.0

    @property
    def stages(self) -> int:
        """How many sections."""
        return STAGES[self.kind]

    @property
    def has_free_lift(self) -> bool:
        """Whether a ram in the middle lifts the carriage first."""
        return self.kind != "simplex"

    @property
    def stroke(self) -> float:
        """Of the rams at the sides."""
        return (v.SECOND_STROKE if self.kind == "triplex" else v.LIFT_STROKE).value

    def rise(self, section: int) -> float:
        """How far a section is above where it is lowered; -1 is the carriage."""
        moved = [0.0] * self.stages
        for k in range(self.stages - 2, -1, -1):
            moved[k] = moved[k + 1] + self.lift
        if section >= 0:
            return moved[section]
        return moved[0] + (2.0 * self.free if self.has_free_lift else self.lift)

    def body(self, section: int) -> str:
        """Name of a section's body."""
        if section == self.stages - 1:
            return "outer_mast"
        return "inner_mast" if section == 0 else "middle_mast"


def half_depth(section: int) -> float:
    """Half of a channel's depth, along x."""
    return 52.0 + (WEB + GAP) * section


def outside(section: int) -> float:
    """y of a channel's web, outside."""
    return 416.0 + (WEB + GAP) * section


def _pair(tree: Assembly, name: str, shape: object, body: str, colour: tuple[float, float, float] = GREY) -> None:
    tree.add(Part(f"{name} LH", shape, colour), body)
    tree.add(Part(f"{name} RH", mirrored(shape), colour), body)


def draw_section(mast: Mast, section: int) -> Assembly:
    """Two channels and what ties them."""
    body, up = mast.body(section), mast.rise(section)
    outer = section == mast.stages - 1
    h, y = half_depth(section), outside(section)
    low = BOTTOM - 10.0 if outer else BOTTOM + up
    high = TOP + STEP * (mast.stages - 1 - section) + up
    tree = Assembly({"outer_mast": "MAST OUTER", "middle_mast": "MAST MIDDLE", "inner_mast": "MAST INNER"}[body])
    channel = box(MID - h, MID + h, y - 80, y, low, high)
    channel = cut(channel, box(MID - h + WEB, MID + h - WEB, y - 81, y - WEB, low - 1, high + 1))
    _pair(tree, f"{tree.name} CHANNEL", channel, body)
    tree.add(Part(f"{tree.name} TIE TOP", box(RAM[0] - 50, MID - h, -y, y, high - 60, high), GREY), body)
    if outer:
        tree.add(Part("MAST FOOT BEAM", box(RAM[0] - 50, MID - h, -y, y, low, RAM[2]), GREY), body)
    else:
        tie = box(MID - h, MID - h + WEB, -y + 80, y - 80, low + 70, low + 190)
        tree.add(Part(f"{tree.name} TIE LOWER", tie, GREY), body)
    return tree


def draw_pivots(mast: Mast, tilt: tuple[float, float], hardware: Assembly) -> Assembly:
    """Lugs on the outer channels: of the mast's pivot, and of the tilt cylinders at `tilt`."""
    tree = Assembly("MAST BRACKETS")
    section = mast.stages - 1
    y, back = outside(section), MID - half_depth(section)
    (px, pz), (qx, qz) = PIVOT, tilt
    lug = plate([(px, pz, 58), (MID, 240, 0), (MID, 470, 0)], "xz", y, y + 40)
    _pair(tree, "MAST PIVOT LUG", bored(lug, Y, ((px, 0, pz), PIN_MAST / 2 + CLEARANCE)), "outer_mast")
    _pair(tree, "TILT LUG BASE", box(back, back + 50, y, y + 130, qz - 60, qz + 60), "outer_mast")
    for name, low in (("IN", y + 20), ("OUT", y + 95)):
        ear = plate([(qx, qz, 42), (back, qz - 55, 0), (back, qz + 55, 0)], "xz", low, low + 25)
        _pair(tree, f"TILT LUG {name}", bored(ear, Y, ((qx, 0, qz), PIN_TILT / 2)), "outer_mast")
    for sign, letter in ((1.0, "l"), (-1.0, "r")):
        start = (y + 20) if sign > 0 else -(y + 120)
        role = f"tilt_piston_rod_{letter}_pin"
        fit_pin(hardware, (qx, start, qz), PIN_TILT, 100, "outer_mast", role, keep=(sign,), turned=-90)
    return tree


def tilt_pin_y(mast: Mast) -> float:
    """Lateral place of the tilt cylinders."""
    return outside(mast.stages - 1) + 70.0


def lift_ram(mast: Mast) -> Ram:
    """Sizes of a lift ram at the side: its rod's end bears under the top tie of the section that it lifts."""
    long = TOP + STEP - 60.0 - RAM[2]
    bore, shaft = v.LIFT_BORE.value, v.LIFT_ROD.value
    return Ram("LIFT CYL", bore, shaft, mast.stroke, mast.lift, bore + 20, long)


def free_ram(mast: Mast) -> Ram:
    """Sizes of the free lift ram in the middle of the inner section."""
    bore, shaft, stroke = v.FREE_BORE.value, v.FREE_ROD.value, v.FREE_STROKE.value
    return Ram("FREE LIFT CYL", bore, shaft, stroke, mast.free, bore + 24, 1040.0)


def draw_rams(mast: Mast) -> Assembly:
    """The lift rams at the sides, and the one of the free lift with its cross head."""
    tree = Assembly("LIFT CYLINDERS")
    lifted = mast.body(mast.stages - 2)
    side = draw_ram(lift_ram(mast))
    which = "second_" if mast.kind == "triplex" else ""
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        names = {
            "barrel": "outer_mast",
            "rod": lifted,
            "barrel_role": f"{which}lift_cylinder_barrel_{letter}",
            "rod_role": f"{which}lift_piston_rod_{letter}",
        }
        tree.uses.append(Use(side, shift(RAM[0], sign * RAM[1], RAM[2]), names=names))
    if mast.has_free_lift:
        up = mast.rise(0)
        x, _, z = FREE_RAM
        seat = box(MID - half_depth(0) + WEB, x + 90, -100, 100, z - 30 + up, z + up)
        tree.add(Part("FREE LIFT SEAT", seat, GREY), "inner_mast")
        names = {
            "barrel": "inner_mast",
            "rod": "free_lift_crosshead",
            "barrel_role": "free_lift_cylinder_barrel",
            "rod_role": "free_lift_piston_rod",
        }
        ram = free_ram(mast)
        tree.uses.append(Use(draw_ram(ram), shift(x, 0, z + up), names=names))
        head = z + up + ram.long + mast.free
        tree.add(Part("CROSS HEAD", box(x - 30, x + 30, -190, 190, head, head + 60), GREY), "free_lift_crosshead")
        for y in (-190.0, 160.0):
            sheave = ring((x + 30, y + 15, head + 30), X, 70, 25, 30)
            tree.add(Part("CHAIN SHEAVE", sheave, STEEL), "free_lift_crosshead")
    return tree


def draw_carriage(mast: Mast) -> Assembly:
    """Brackets in the innermost channels, fork bars, backrest, forks."""
    up = mast.rise(-1)
    body = "carriage"
    tree = Assembly("CARRIAGE ASSY")
    inside = half_depth(0) - WEB - GAP
    web = outside(0) - WEB - GAP
    bracket = box(MID - inside, MID + inside, web - 70, web, BOTTOM + 20 + up, BOTTOM + 640 + up)
    _pair(tree, "CARRIAGE BRACKET", bracket, body)
    side = box(MID - inside, 470, web - 98, web - 70, BOTTOM + 20 + up, BOTTOM + 640 + up)
    _pair(tree, "CARRIAGE SIDE PL", side, body)
    half = v.CARRIAGE_WIDTH.value / 2
    for name, z in (("FORK BAR UPPER", 630.0), ("FORK BAR LOWER", 150.0)):
        tree.add(Part(name, box(470, 530, -half, half, z + up, z + 110 + up)), body)
    rest = Assembly("LOAD BACKREST")
    tree.add(rest)
    for y in (-820.0, -420.0, -20.0, 380.0, 780.0):
        rest.add(Part("BACKREST BAR", box(490, 530, y, y + 40, 740 + up, 1180 + up), BLACK), body)
    top = box(490, 530, -820, 820, 1180 + up, v.EXTENDED_HEIGHT.value - v.LIFT_HEIGHT.value + up)
    rest.add(Part("BACKREST TOP", top, BLACK), body)
    t, long = v.FORK_THICKNESS.value, v.FORK_LENGTH.value
    low = 20.0 + up
    profile = [
        (530, low, 0), (FACE + 200, low, 0), (FACE + long, low + t - 12, 0), (FACE + long, low + t, 0),
        (FACE, low + t, 0), (FACE, 770 + up, 0), (530, 770 + up, 0),
    ]  # fmt: skip
    fork = plate(profile, "xz", 425 - v.FORK_WIDTH.value / 2, 425 + v.FORK_WIDTH.value / 2)
    tree.add(Part("FORK LH", fork, BLACK), body, "forks")
    tree.add(Part("FORK RH", mirrored(fork), BLACK), body, "forks")
    return tree


def draw_mast(mast: Mast, tilt: tuple[float, float], hardware: Assembly) -> Assembly:
    """All of it."""
    tree = Assembly(f"MAST {mast.kind.upper()}")
    for section in range(mast.stages - 1, -1, -1):
        tree.add(draw_section(mast, section))
    tree.add(draw_pivots(mast, tilt, hardware))
    tree.add(draw_rams(mast))
    tree.add(draw_carriage(mast))
    return tree
