"""The sheet's drawings: a schematic side view with its letter keys."""

from __future__ import annotations

import math
from collections.abc import Sequence

from reportlab.lib.colors import Color, white
from reportlab.pdfgen.canvas import Canvas

from . import values as v
from .sheet_parts import AMBER, BOLD, GREY, INK, PALE, SLATE, rule, text


def machine(c: Canvas, x0: float, ground: float, scale: float, *, raised: bool) -> None:
    """A schematic side view: x0 is the articulation axis, millimetres times `scale` are points."""

    def at(x: float, z: float) -> tuple[float, float]:
        return x0 + x * scale, ground + z * scale

    def shape(points: Sequence[tuple[float, float]], fill: Color, *, dashed: bool = False) -> None:
        path = c.beginPath()
        path.moveTo(*at(*points[0]))
        for point in points[1:]:
            path.lineTo(*at(*point))
        path.close()
        c.saveState()
        c.setStrokeColor(GREY if dashed else INK)
        c.setLineWidth(0.7)
        if dashed:
            c.setDash(3, 2)
        c.setFillColor(fill)
        c.drawPath(path, stroke=1, fill=0 if dashed else 1)
        c.restoreState()

    rule(c, *at(-4500, 0), at(5100, 0)[0], weight=0.8, ink=INK)
    axle, radius = v.WHEELBASE.value / 2, v.TYRE_DIAMETER.value / 2
    rear = -axle - v.REAR_OVERHANG.value
    tip = v.OVERALL_LENGTH.value + rear
    shape(((rear, 700), (rear, 2150), (-3900, 2500), (-1250, 2600), (-1250, 1000), (-900, 700)), AMBER)
    shape(((-1250, 1150), (-1250, 2600), (-1100, 3450), (350, 3500), (420, 1750), (250, 1150)), PALE)
    shape(((-3100, 2500), (-3100, 3450), (-2960, 3450), (-2960, 2500)), SLATE)
    shape(((150, 700), (150, 1250), (900, 2350), (1150, 2300), (1600, 1000), (1500, 700)), SLATE)
    boom = (850.0, 2150.0)
    carry = (3330.0, 290.0)
    shape(_arm(boom, carry, 190), AMBER)
    shape(_bucket(carry, 0.0, tip - carry[0]), SLATE)
    if raised:
        high = (2680.0, v.HINGE_HEIGHT_MAX.value)
        shape(_arm(boom, high, 190), AMBER, dashed=True)
        shape(_bucket(high, -math.pi / 4, tip - carry[0]), SLATE, dashed=True)
    for x in (-axle, axle):
        for r, fill in ((radius, INK), (radius * 0.55, AMBER), (radius * 0.2, SLATE)):
            c.setFillColor(fill)
            c.circle(*at(x, radius), r * scale, stroke=0, fill=1)


def _arm(a: tuple[float, float], b: tuple[float, float], half: float) -> list[tuple[float, float]]:
    dx, dz = b[0] - a[0], b[1] - a[1]
    length = math.hypot(dx, dz)
    nx, nz = -dz / length * half, dx / length * half
    return [
        (a[0] + nx, a[1] + nz),
        (b[0] + nx / 2, b[1] + nz / 2),
        (b[0] - nx / 2, b[1] - nz / 2),
        (a[0] - nx, a[1] - nz),
    ]


def _bucket(pin: tuple[float, float], angle: float, reach: float) -> list[tuple[float, float]]:
    outline = (
        (reach, -290.0),
        (250.0, -290.0),
        (-200.0, -60.0),
        (-260.0, 500.0),
        (120.0, 1010.0),
        (360.0, 1060.0),
        (520, 430),
    )
    s, k = math.sin(angle), math.cos(angle)
    return [(pin[0] + k * x - s * z, pin[1] + s * x + k * z) for x, z in outline]


def keys(c: Canvas, x0: float, ground: float, scale: float) -> None:
    """The letter keys with their dimension lines."""
    c.setStrokeColor(INK)

    def span(x: float, low: float, high: float, key: str) -> None:
        px, pl, ph = x0 + x * scale, ground + low * scale, ground + high * scale
        rule(c, px - 3, pl, px + 3)
        rule(c, px - 3, ph, px + 3)
        c.line(px, pl, px, ph)
        _key(c, px, (pl + ph) / 2, key)

    def across(z: float, left: float, right: float, key: str) -> None:
        pz, pl, pr = ground + z * scale, x0 + left * scale, x0 + right * scale
        c.setLineWidth(0.4)
        c.line(pl, pz, pr, pz)
        c.line(pl, pz - 3, pl, pz + 3)
        c.line(pr, pz - 3, pr, pz + 3)
        _key(c, (pl + pr) / 2, pz, key)

    axle = v.WHEELBASE.value / 2
    rear = -axle - v.REAR_OVERHANG.value
    span(5150, 0, v.OPERATING_HEIGHT.value, "L")
    span(4700, 0, v.DUMP_CLEARANCE.value, "H")
    span(2300, 0, v.HINGE_HEIGHT_MAX.value, "B")
    span(3000, 0, v.HINGE_HEIGHT_CARRY.value, "C")
    span(-250, 0, v.GROUND_CLEARANCE.value, "D")
    span(rear - 150, 0, v.HITCH_HEIGHT.value, "E")
    span(-3500, 0, v.STACK_HEIGHT.value, "F")
    span(500, 0, v.CAB_HEIGHT.value, "G")
    across(-350, -axle, axle, "A")
    across(-350, rear, -axle, "J")
    across(-750, rear, v.OVERALL_LENGTH.value + rear, "M")


def _key(c: Canvas, x: float, y: float, key: str) -> None:
    """A letter on a white disc in the middle of its dimension line."""
    c.setFillColor(white)
    c.circle(x, y, 5, stroke=0, fill=1)
    text(c, x, y - 2.5, key, size=7, font=BOLD, align="c")
