"""The drawn dozers on track frames that rock: each turns on a stub of the pivot shaft, in front of its sprocket, which
is the main frame's; in front an equaliser bar under the belly, from whose ends shackles go up to the frames.

Lengths are in machine sizes, as in `dozers`.
"""

from __future__ import annotations

import numpy as np

from kit.machines.dozers import SIDES, Dozer
from kit.machines.solids import around, place, plate
from kit.machines.synthetic import Machine, X, Y

BAR = 0.5
"""x of the equaliser bar."""
SHAFT = -0.75
"""x of the pivot shaft."""


class RockingDozer(Dozer):
    """One machine from one generator of random numbers. Push arms stand on the track frames."""

    def link_pins(self) -> None:
        super().link_pins()
        self.frame_thick = self.t / self.s

    def bearer(self, role: str) -> str:
        name = role.rstrip("_0123456789")
        return self.carrier if name.startswith("sprocket") else f"roller_frame_{name[-1]}"

    def track_frame(self, y: float, height: float) -> None:
        e, z, half = self.e / self.s, self.axle_z / self.s, self.half / self.s
        side, letter = (1, "l") if y > 0 else (-1, "r")
        body, wall, up = f"roller_frame_{letter}", self.inside(y) / self.s, 0.5 * height / self.s
        rear = -half + (-0.1 if self.high else 0.3)
        corners = [(rear, z - up, 0), (half + 0.1, z - up, 0), (half + 0.1, z + up, 0), (rear, z + up, 0)]
        self.wall("track frame", body, wall, corners, (SHAFT, z))
        across, low, high = self.bar_end()
        end = wall - side * (0.5 * self.t / self.s - e)
        arm = self._sorted((BAR - 0.12, side * (across - 0.08), z - 0.02), (BAR + 0.12, end, z + 0.04))
        self.block("equalizer arm", body, *arm)
        for d in (1, -1):
            feet = [(side * across + f, z - 0.02 + e, 0.0) for f in (0.07, -0.07)]
            lug = [(side * across, high, self.wide), *feet]
            self.crosswise("equalizer lug", body, BAR + d * self.lug_y, self.t, lug, (side * across, high))
        link, ends = f"equalizer_link_{letter}", [(side * across, low), (side * across, high)]
        self.crosswise("equalizer link", link, BAR, self.eye_w, [(*end, self.wide) for end in ends], *ends)
        self.lengthwise_pin(f"{link}_bar_pin", "equalizer_bar", ends[0])
        self.lengthwise_pin(f"{link}_pin", body, ends[1])

    def track_beams(self, side: int) -> None:
        """The pivot shaft's stub on its bracket, and the sprocket's drive."""
        e, z, t = self.e / self.s, self.axle_z / self.s, self.t / self.s
        letter, gap = "l" if side > 0 else "r", self.gap / self.s
        wall = abs(self.inside(self.gauge / 2)) / self.s
        inner = wall - t - gap
        self.wall("pivot bracket", self.carrier, side * inner, [(SHAFT, z, 1.4 * self.wide)], (SHAFT, z))
        beam = self._sorted((SHAFT - 0.07, side * (self.hull - e), z - 0.07),
                            (SHAFT + 0.07, side * (inner - 0.5 * t + e), z + 0.07))  # fmt: skip
        self.block("pivot beam", self.carrier, *beam)
        self.level_pin(f"roller_frame_{letter}_pin", self.carrier, (SHAFT, z), side * 0.5 * (wall + inner), 1.2 * t)
        x, up = next(
            (x / self.s, self.axle_z / self.s + h / self.s) for name, x, h in self.loop()[1] if name == "sprocket"
        )
        drive = self._sorted((x - 0.12, side * (self.hull - e), up - 0.12), (x + 0.12, side * (wall - 0.04), up + 0.12))
        self.block("final drive", self.carrier, *drive)

    def draw(self) -> Machine:
        machine = super().draw()
        self.equalizer_bar()
        return machine

    def bar_end(self) -> tuple[float, float, float]:
        """y of the bar's end, its height, and that of the pin above it in a track's frame."""
        high = self.axle_z / self.s - 0.09
        return self.hull + 0.2, high - 0.15, high

    def equalizer_bar(self) -> None:
        """Two plates with blocks between them, on a pin through a lug under the belly."""
        e, body, (y, z, _) = self.e / self.s, "equalizer_bar", self.bar_end()
        holes = [(-y, z), (0.0, z), (y, z)]
        inner = self.lug_y - 0.5 * self.t / self.s + e
        for d in (1, -1):
            outline = [(*hole, self.wide) for hole in holes]
            self.crosswise("equalizer plate", body, BAR + d * self.lug_y, self.t, outline, *holes)
        for side, _ in SIDES:
            low, high = sorted((side * 0.2, side * (y - 0.2)))
            self.block("equalizer spacer", body, (BAR - inner, low, z - 0.03), (BAR + inner, high, z + 0.03))
        lug = [(0.0, z, self.wide), (0.09, 0.38 + e, 0.0), (-0.09, 0.38 + e, 0.0)]
        self.crosswise("equalizer saddle", self.carrier, BAR, self.eye_w, lug, (0.0, z))
        self.lengthwise_pin("equalizer_bar_pin", self.carrier, (0.0, z))

    # ---- pieces ----
    def crosswise(
        self,
        name: str,
        body: str,
        x: float,
        thick: float,
        circles: list[tuple[float, ...]],
        *holes: tuple[float, float],
    ) -> None:
        """An upright plate across the machine, its outline around circles (y, z, radius or 0)."""
        outline = around(*(tuple(self.s * c for c in circle) for circle in circles))
        bores = [(self.s * y, self.s * z, self.bore_r) for y, z in holes]
        shape = plate(f"{name}_{x:.3f}_{circles[0][0]:.3f}", outline, thick, bores)
        self.m.add(name, body, body, shape, place((self.s * x, 0, 0), X, Y))

    def lengthwise_pin(self, role: str, body: str, at: tuple[float, float]) -> None:
        half = self.lug_y + 0.6 * self.t / self.s
        self.pin(role, body, self.spot(BAR - half, *at), self.spot(BAR + half, *at))


def rocking_dozer(
    seed: int, blade: str | None = None, *, high: bool | None = None, ripper: str | None = None, embedded: bool = False
) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's. `blade`
    and `ripper` as for `dozer`, `""` for none."""
    drawn = np.random.default_rng([seed, 67]).random(5)
    arms = bool(drawn[1] < 0.5) if blade is None else blade == "push_arms"
    return RockingDozer(
        seed, arms=arms, dual=arms and bool(drawn[2] < 0.4), wings=arms and bool(drawn[3] < 0.5),
        high=bool(drawn[0] < 0.4) if high is None else high,
        ripper=("radial" if drawn[4] < 0.3 else "") if ripper is None else ripper, embedded=embedded,
    ).draw()  # fmt: skip
