"""The cab: a sheet shell with windows, panes in them, roof, seat and levers. Machine frame, millimetres."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.product import BLACK, GLASS, GREY, YELLOW, Assembly, Colour, Part
from drawing.solids import X, Z, box, cut, fuse, plate, rod, sheet_box, shift

from . import values as v
from .undercarriage import inset
from .upper import BODY, DECK, HALF

LEFT, RIGHT = HALF - 12, 458.0
WALL = 14.0
ROOF = v.CAB_HEIGHT.value - 45.0
FLOOR = DECK + 12
SIDE = [(-330.0, FLOOR, 0.0), (1330.0, FLOOR, 0.0), (1470.0, 1560.0, 0.0), (1440.0, 2180.0, 0.0)]
SIDE += [(1130.0, ROOF, 0.0), (-330.0, ROOF, 0.0)]
"""Side view."""
DOOR = [(520.0, 1330.0, 0.0), (1270.0, 1330.0, 0.0), (1390.0, 1590.0, 0.0), (1365.0, 2170.0, 0.0)]
DOOR += [(1090.0, ROOF - 70, 0.0), (520.0, ROOF - 70, 0.0)]
REAR = [(-250.0, 1950.0, 0.0), (430.0, 1950.0, 0.0), (430.0, ROOF - 70, 0.0), (-250.0, ROOF - 70, 0.0)]
ACROSS = (RIGHT + 60, LEFT - 60)
"""Windscreens and rear window from side to side."""
SCREENS = (("UPPER", 2230.0, ROOF - 60), ("MIDDLE", 1600.0, 2180.0), ("LOWER", 1270.0, 1540.0))
"""Windscreens, from and to a height."""


def draw_cab() -> Assembly:
    """Everything on the left deck before the hood's locker."""
    tree = Assembly("CAB ASSY")

    def put(name: str, shape: TopoDS_Shape, colour: Colour = BLACK) -> None:
        tree.add(Part(name, shape, colour), BODY)

    openings = [box(-400, -250, *ACROSS, 2050, ROOF - 80), box(150, 850, RIGHT + 130, LEFT - 130, ROOF - 60, ROOF + 10)]
    openings += [box(1150, 1700, *ACROSS, z0, z1) for _, z0, z1 in SCREENS]
    for corners in (DOOR, REAR):
        openings += [plate(corners, "xz", y - 20, y + 20) for y in (LEFT, RIGHT)]
    room = plate(inset(SIDE, WALL), "xz", RIGHT + WALL, LEFT - WALL)
    put("CAB FRAME", cut(plate(SIDE, "xz", RIGHT, LEFT), room, *openings), YELLOW)
    for name, y in (("LH", LEFT - 12), ("RH", RIGHT + 6)):
        for kind, corners in (("DOOR GLASS", DOOR), ("SIDE GLASS", REAR)):
            put(f"{kind} {name}", plate(corners, "xz", y, y + 6), GLASS)
    pane = cut(plate(inset(SIDE, 5.0), "xz", *ACROSS), plate(inset(SIDE, 11.0), "xz", ACROSS[0] - 1, ACROSS[1] + 1))
    for name, z0, z1 in SCREENS:
        away = (box(-1000, 1150, 0, 2000, 0, 4000), box(0, 3000, 0, 2000, 0, z0), box(0, 3000, 0, 2000, z1, 4000))
        put(f"WINDSCREEN {name}", cut(pane, *away), GLASS)
    put("REAR GLASS", box(-325, -319, *ACROSS, 2050, ROOF - 80), GLASS)
    side = [(-350.0, ROOF, 0.0), (1160.0, ROOF, 0.0), (1120.0, ROOF + 45, 0.0), (-320.0, ROOF + 45, 0.0)]
    roof = plate(side, "xz", RIGHT - 12, LEFT + 8)
    put("CAB ROOF", cut(roof, box(-310, 1100, RIGHT + 4, LEFT - 4, ROOF - 1, ROOF + 36)), GREY)
    put("CAB BASE", sheet_box(-330, 1330, RIGHT + 10, LEFT - 10, DECK, FLOOR, 3.0))
    _inside(tree)
    put("DOOR LATCH", box(545, 640, LEFT - 4, LEFT + 8, 1250, 1290))
    put("MIRROR", fuse(rod((1380, LEFT - 14, 2120), X, 10, 190), box(1550, 1580, LEFT - 130, LEFT, 2000, 2270)))
    lamp = Part("CAB WORK LAMP", box(1152, 1210, -60, 60, ROOF - 35, ROOF + 30), GREY)
    for y in (RIGHT + 130, LEFT - 130):
        tree.add(lamp, BODY, at=shift(0, y, 0))
    return tree


def _inside(tree: Assembly) -> None:
    middle, low = 0.5 * (RIGHT + LEFT), FLOOR + WALL

    def put(name: str, shape: TopoDS_Shape, colour: Colour = BLACK) -> None:
        tree.add(Part(name, shape, colour), BODY)

    cushion = plate([(90, 1640, 0), (620, 1640, 0), (600, 1730, 40), (140, 1720, 40)], "xz", middle - 240, middle + 240)
    rest = plate([(40, 1690, 0), (170, 1690, 0), (60, 2330, 40), (0, 2330, 40)], "xz", middle - 230, middle + 230)
    foam = [box(150, 580, middle - 225, middle + 225, 1652, 1735), box(10, 100, middle - 215, middle + 215, 1760, 2330)]
    put("OPERATOR SEAT", cut(fuse(cushion, rest), *foam))
    put("SEAT PEDESTAL", sheet_box(180, 540, middle - 150, middle + 150, low, 1640, 6.0), GREY)
    for name, y in (("LH", middle + 290), ("RH", middle - 370)):
        put(f"CONSOLE {name}", sheet_box(150, 640, y, y + 80, low, 1880, 5.0), GREY)
        put(f"CONTROL LEVER {name}", fuse(rod((590, y + 40, 1870), Z, 14, 210), rod((590, y + 40, 2060), Z, 28, 90)))
    for y in (middle - 90, middle + 60):
        put("TRAVEL LEVER", fuse(box(1080, 1240, y, y + 40, low, low + 36), rod((1120, y + 20, low + 10), Z, 12, 420)))
    post = box(1200, 1230, RIGHT + WALL, RIGHT + WALL + 20, low, 1860)
    put("MONITOR", fuse(post, box(1200, 1230, RIGHT + WALL, RIGHT + 210, 1700, 1860)))
