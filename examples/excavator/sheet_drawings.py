"""The sheet's drawings: a schematic side view of the machine as transported and at work, with letter keys."""

from __future__ import annotations

import math
from collections.abc import Sequence

from reportlab.lib.colors import HexColor, white
from reportlab.pdfgen.canvas import Canvas

from drawing.sheet_print import BOLD, INK, LINE, MIST, TEAL, say

from . import values as v

PAINT = HexColor("#d8b45a")
Point = tuple[float, float]


class View:
    """A side view: millimetres of the machine (swing axis at 0, ground at 0) to points of the page."""

    def __init__(self, c: Canvas, x: float, ground: float, scale: float) -> None:
        self.c, self.x, self.ground, self.scale = c, x, ground, scale

    def at(self, p: Point) -> Point:
        """Where a point of the machine is on the page."""
        return self.x + p[0] * self.scale, self.ground + p[1] * self.scale

    def shape(self, points: Sequence[Point], fill: HexColor = PAINT) -> None:
        """A filled outline."""
        path = self.c.beginPath()
        path.moveTo(*self.at(points[0]))
        for point in points[1:]:
            path.lineTo(*self.at(point))
        path.close()
        self.c.setStrokeColor(INK)
        self.c.setLineWidth(0.6)
        self.c.setFillColor(fill)
        self.c.drawPath(path, stroke=1, fill=1)

    def machine(self) -> None:
        """Tracks, upperstructure, cab."""
        half, on_ground = v.TRACK_LENGTH.value / 2, v.TRACK_ON_GROUND.value / 2
        high = v.TRACK_HEIGHT.value
        self.shape(((-on_ground, 0), (on_ground, 0), (half, high / 2), (on_ground, high), (-on_ground, high),
                    (-half, high / 2)), HexColor("#4a5054"))  # fmt: skip
        rear, clear = -v.TAIL_RADIUS.value, v.COUNTERWEIGHT_CLEARANCE.value
        self.shape(((rear + 60, clear), (rear, 1700), (rear + 120, 2250), (-600, 2300), (-600, clear)))
        self.shape(((-600, clear), (-600, 2250), (300, 2250), (900, clear)))
        top = v.CAB_HEIGHT.value
        self.shape(
            ((150, clear + 60), (150, top - 80), (300, top), (1450, top), (1650, 1900), (1500, clear + 60)), MIST
        )

    def equipment(self, pins: Sequence[Point], tip: Point) -> None:
        """Boom, arm and bucket along their pins: foot, arm pin, bucket pin."""
        foot, knee, pin = pins
        middle = ((foot[0] + knee[0]) / 2, (foot[1] + knee[1]) / 2)
        out = _square(foot, knee, 520)
        bend = (middle[0] + out[0], middle[1] + out[1])
        self.shape(_limb(foot, bend, 260))
        self.shape(_limb(bend, knee, 230))
        self.shape(_limb(knee, pin, 190))
        side = _square(pin, tip, 500)
        self.shape((pin, (pin[0] + side[0], pin[1] + side[1]), ((pin[0] + tip[0]) / 2 + side[0] * 1.2,
                   (pin[1] + tip[1]) / 2 + side[1] * 1.2), tip), HexColor("#7a8085"))  # fmt: skip

    def upright(self, x: float, low: float, high: float, key: str) -> None:
        """A vertical dimension with its letter."""
        self._span((x, low), (x, high), key)

    def level(self, z: float, left: float, right: float, key: str) -> None:
        """A horizontal dimension with its letter."""
        self._span((left, z), (right, z), key)

    def _span(self, a: Point, b: Point, key: str) -> None:
        (xa, ya), (xb, yb) = self.at(a), self.at(b)
        self.c.setStrokeColor(TEAL)
        self.c.setLineWidth(0.5)
        self.c.line(xa, ya, xb, yb)
        nx, ny = (0.0, 3.0) if ya == yb else (3.0, 0.0)
        for x, y in ((xa, ya), (xb, yb)):
            self.c.line(x - nx, y - ny, x + nx, y + ny)
        x, y = (xa + xb) / 2, (ya + yb) / 2
        self.c.setFillColor(white)
        self.c.circle(x, y, 5.2, stroke=0, fill=1)
        say(self.c, x, y - 2.6, key, size=7.5, font=BOLD, ink=TEAL, align="c")


def transport(c: Canvas, x: float, ground: float, scale: float) -> None:
    """The machine as transported, with the keys of the dimensions table."""
    view = View(c, x, ground, scale)
    c.setStrokeColor(LINE)
    c.line(view.at((-3400, 0))[0], ground, view.at((7400, 0))[0], ground)
    front = v.OVERALL_LENGTH.value - v.TAIL_RADIUS.value
    view.machine()
    view.equipment(((300, 1800), (front - 350, 1750), (front - 3100, 900)), (front - 3700, 250))
    view.level(-500, -v.TAIL_RADIUS.value, front, "A")
    view.upright(4200, 0, v.BOOM_HEIGHT.value, "C")
    view.upright(900, 0, v.CAB_HEIGHT.value, "E")
    view.upright(-1500, 0, v.HANDRAIL_HEIGHT.value, "F")
    view.upright(-2700, 0, v.COUNTERWEIGHT_CLEARANCE.value, "G")
    view.upright(0, 0, v.GROUND_CLEARANCE.value, "H")
    view.level(3700, -v.TAIL_RADIUS.value, 0, "I")
    view.level(-850, -v.TRACK_ON_GROUND.value / 2, v.TRACK_ON_GROUND.value / 2, "J")
    view.level(-1200, -v.TRACK_LENGTH.value / 2, v.TRACK_LENGTH.value / 2, "K")
    view.upright(2600, 0, v.TRACK_HEIGHT.value, "P")


def ranges(c: Canvas, x: float, ground: float, scale: float) -> None:
    """The machine at work, its envelope and the keys of the working ranges."""
    view = View(c, x, ground, scale)
    c.setStrokeColor(LINE)
    c.setLineWidth(0.3)
    for metre in range(-7, 11):
        c.line(*view.at((-3500, metre * 1000)), *view.at((10500, metre * 1000)))
    for metre in range(-3, 11):
        c.line(*view.at((metre * 1000, -7000)), *view.at((metre * 1000, 10500)))
    c.setStrokeColor(INK)
    c.setLineWidth(1.0)
    c.line(view.at((-3500, 0))[0], ground, view.at((10500, 0))[0], ground)
    view.machine()
    view.equipment(((300, 1800), (5350, 4300), (6100, 1450)), (5300, 300))
    envelope = [
        (3200, v.DUMPING_HEIGHT_MIN.value), (4500, 8300), (6600, v.DIGGING_HEIGHT.value), (8700, 7600),
        (v.MAX_REACH.value, 1800), (v.GROUND_REACH.value, 0), (8300, -3700), (6200, -v.WALL_DEPTH.value),
        (4300, -v.DIGGING_DEPTH.value), (2600, -5600), (1900, -2500),
    ]  # fmt: skip
    c.setStrokeColor(TEAL)
    c.setLineWidth(1.1)
    path = c.beginPath()
    path.moveTo(*view.at(envelope[0]))
    for before, here, after in zip(envelope, envelope[1:], [*envelope[2:], envelope[-1]], strict=False):
        a = (here[0] - 0.16 * (after[0] - before[0]), here[1] - 0.16 * (after[1] - before[1]))
        path.curveTo(*view.at(before), *view.at(a), *view.at(here))
    c.drawPath(path, stroke=1, fill=0)
    view.upright(7100, 0, v.DIGGING_HEIGHT.value, "A")
    view.upright(8000, 0, v.DUMPING_HEIGHT.value, "B")
    view.upright(4700, -v.DIGGING_DEPTH.value, 0, "C")
    view.upright(6400, -v.WALL_DEPTH.value, 0, "D")
    view.upright(3700, -v.LEVEL_DEPTH.value, 0, "E")
    view.level(10250, 0, v.MAX_REACH.value, "F")
    view.level(-450, 0, v.GROUND_REACH.value, "G")
    view.level(9500, 0, v.SWING_RADIUS_MIN.value, "H")
    view.upright(2900, 0, v.DUMPING_HEIGHT_MIN.value, "I")


def _square(a: Point, b: Point, by: float) -> Point:
    """The vector of length `by` to the left of a → b."""
    dx, dz = b[0] - a[0], b[1] - a[1]
    far = math.hypot(dx, dz)
    return -dz / far * by, dx / far * by


def _limb(a: Point, b: Point, half: float) -> list[Point]:
    nx, nz = _square(a, b, half)
    return [(a[0] + nx, a[1] + nz), (b[0] + nx, b[1] + nz), (b[0] - nx, b[1] - nz), (a[0] - nx, a[1] - nz)]
