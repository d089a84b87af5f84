"""The cab: a hollow shell with windows, panes in them, roof, seat and levers. Machine frame, millimetres."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.product import AMBER, BLACK, GLASS, GREY, YELLOW, Assembly, Colour, Part
from drawing.solids import X, Z, box, cut, fuse, pipe, plate, rod

from . import values as v
from .undercarriage import inset
from .upper import BODY, DECK, HALF

LEFT, RIGHT = HALF - 12, 446.0
WALL = 42.0
ROOF = v.CAB_HEIGHT.value - 45.0
SIDE = [(-330.0, DECK + 12, 0.0), (1330.0, DECK + 12, 0.0), (1470.0, 1560.0, 0.0), (1440.0, 2180.0, 0.0)]
SIDE += [(1130.0, ROOF, 0.0), (-330.0, ROOF, 0.0)]
"""Side view."""
DOOR = [(520.0, 1330.0, 0.0), (1270.0, 1330.0, 0.0), (1390.0, 1590.0, 0.0), (1365.0, 2170.0, 0.0)]
DOOR += [(1090.0, ROOF - 70, 0.0), (520.0, ROOF - 70, 0.0)]
REAR = [(-250.0, 1950.0, 0.0), (430.0, 1950.0, 0.0), (430.0, ROOF - 70, 0.0), (-250.0, ROOF - 70, 0.0)]


def draw_cab() -> Assembly:
    """Everything on the left deck before the hood."""
    tree = Assembly("CAB ASSY")

    def put(name: str, shape: TopoDS_Shape, colour: Colour) -> None:
        tree.add(Part(name, shape, colour), BODY)

    outer = plate(SIDE, "xz", RIGHT, LEFT)
    room = plate(inset(SIDE, WALL), "xz", RIGHT + WALL, LEFT - WALL)
    windows: list[TopoDS_Shape] = []
    for corners in (DOOR, REAR):
        windows.append(plate(corners, "xz", LEFT - WALL - 1, LEFT + 1))
        windows.append(plate(corners, "xz", RIGHT - 1, RIGHT + WALL + 1))
    across = (RIGHT + 60, LEFT - 60)
    upper = [(1250.0, 2230.0, 0.0), (1600.0, 2230.0, 0.0), (1500.0, ROOF - 60, 0.0), (1000.0, ROOF - 60, 0.0)]
    front = plate([(1250, 1600, 0), (1600, 1600, 0), (1600, 2200, 0), (1250, 2200, 0)], "xz", *across)
    low = plate([(1150, 1270, 0), (1600, 1270, 0), (1600, 1560, 0), (1250, 1560, 0)], "xz", *across)
    back = box(-400, -250, *across, 2050, ROOF - 80)
    hatch = box(150, 850, RIGHT + 130, LEFT - 130, ROOF - 60, ROOF + 10)
    shell = cut(outer, room, *windows, plate(upper, "xz", *across), front, low, back, hatch)
    put("CAB FRAME", shell, YELLOW)
    for name, y in (("LH", LEFT - 12), ("RH", RIGHT + 6)):
        for kind, corners in (("DOOR GLASS", DOOR), ("SIDE GLASS", REAR)):
            put(f"{kind} {name}", plate(corners, "xz", y, y + 6), GLASS)
    skin = inset(SIDE, 6.0)
    sheet = cut(plate(skin, "xz", *across), plate(inset(SIDE, 12.0), "xz", across[0] - 1, across[1] + 1))
    tops = box(-1000, 900, 0, 2000, 0, 4000)
    for name, z0, z1 in (
        ("WINDSCREEN UPPER", 2202.0, ROOF - 60),
        ("WINDSCREEN", 1600.0, 2200.0),
        ("WINDSCREEN LOWER", 1270.0, 1560.0),
    ):
        keep = cut(sheet, tops, box(-1000, 3000, 0, 2000, 0, z0), box(-1000, 3000, 0, 2000, z1, 4000))
        put(name, keep, GLASS)
    put("REAR GLASS", box(-324, -318, *across, 2050, ROOF - 80), GLASS)
    roof = plate(
        [(-350, ROOF, 0), (1160, ROOF, 0), (1120, ROOF + 45, 0), (-320, ROOF + 45, 0)], "xz", RIGHT - 12, LEFT + 8
    )
    put("CAB ROOF", cut(roof, box(-300, 1080, RIGHT + 20, LEFT - 20, ROOF - 1, ROOF + 25)), GREY)
    put("CAB BASE", box(-330, 1330, RIGHT + 10, LEFT - 10, DECK, DECK + 12), BLACK)
    middle = 0.5 * (RIGHT + LEFT)
    seat = fuse(
        box(100, 620, middle - 240, middle + 240, 1640, 1760),
        plate([(40, 1700, 0), (180, 1700, 0), (60, 2330, 40), (0, 2330, 40)], "xz", middle - 230, middle + 230),
    )
    put("OPERATOR SEAT", seat, BLACK)
    put("SEAT PEDESTAL", box(180, 540, middle - 150, middle + 150, DECK + 54, 1640), GREY)
    for name, y in (("LH", middle + 290), ("RH", middle - 370)):
        put(f"CONSOLE {name}", box(150, 640, y, y + 80, DECK + 54, 1880), GREY)
        lever = fuse(rod((590, y + 40, 1870), Z, 14, 210), rod((590, y + 40, 2060), Z, 28, 90))
        put(f"CONTROL LEVER {name}", lever, BLACK)
    for y in (middle - 90, middle + 60):
        pedal = fuse(box(1080, 1240, y, y + 40, DECK + 53, DECK + 90), rod((1120, y + 20, DECK + 60), Z, 12, 420))
        put("TRAVEL LEVER", pedal, BLACK)
    put("MONITOR", box(1200, 1230, RIGHT + 60, RIGHT + 240, 1950, 2110), BLACK)
    rail = [(1335.0, LEFT - 5, 1560.0), (1400.0, LEFT + 0.0, 1560.0)]
    del rail
    grab = pipe([(440, LEFT - 4, 1420), (440, LEFT + 8, 1420), (440, LEFT + 8, 2050), (440, LEFT - 4, 2050)], 7, 6)
    del grab
    put("DOOR HANDLE", box(545, 640, LEFT - 4, LEFT + 10, 1250, 1290), BLACK)
    mirror = fuse(rod((1380, LEFT - 20, 2330), X, 10, 200), box(1540, 1570, LEFT - 120, LEFT + 10, 2150, 2420))
    put("MIRROR", mirror, BLACK)
    for y in (RIGHT + 90, LEFT - 200):
        put(
            "CAB WORK LAMP",
            fuse(box(1040, 1100, y, y + 110, ROOF + 30, ROOF + 44), box(1050, 1090, y, y + 110, ROOF - 0, ROOF + 44)),
            GREY,
        )
    wiper = fuse(rod((1446, middle - 60, 1700), Z, 8, 420), box(1440, 1456, middle - 68, middle - 52, 1690, 1720))
    put("WIPER", wiper, BLACK)
    put(
        "BEACON",
        fuse(rod((-230, LEFT - 150, ROOF + 40), Z, 10, 3), rod((-230, LEFT - 150, ROOF + 35), Z, 40, 8)),
        AMBER,
    )
    return tree
