"""The buckets of the sheet's selection table: the published one, and three of our own beside it."""

from __future__ import annotations

from dataclasses import dataclass

from . import values as v


@dataclass(frozen=True, slots=True)
class Bucket:
    """One column of the bucket table; lengths mm, masses kg, capacities m3, force kN."""

    head: tuple[str, str]
    heaped: float
    struck: float
    width: float
    weight: float
    tipping_straight: float
    tipping_turned: float
    breakout: float
    clearance: float
    reach: float
    dig_depth: float
    operating_height: float
    overall_length: float
    operating_weight: float


STOCK_PILE = Bucket(
    ("Stock pile", "Bolt-on edge"),
    v.BUCKET_CAPACITY_HEAPED.value,
    v.BUCKET_CAPACITY_STRUCK.value,
    v.BUCKET_WIDTH.value,
    v.BUCKET_WEIGHT.value,
    v.TIPPING_LOAD_STRAIGHT.value,
    v.TIPPING_LOAD_FULL_TURN.value,
    v.BREAKOUT_FORCE.value,
    v.DUMP_CLEARANCE.value,
    v.DUMP_REACH.value,
    v.DIG_DEPTH.value,
    v.OPERATING_HEIGHT.value,
    v.OVERALL_LENGTH.value,
    v.OPERATING_WEIGHT.value,
)
BUCKETS = (
    STOCK_PILE,
    Bucket(("Stock pile", "Teeth"), 4.0, 3.4, 3190, 2138, 20640, 17860, 245, 2970, 1440, 90, 6090, 9320, 25450),
    Bucket(
        ("Excavating", "Teeth and segments"),
        3.8,
        3.2,
        3190,
        2270,
        20430,
        17680,
        252,
        2995,
        1415,
        105,
        5985,
        9285,
        25585,
    ),
    Bucket(
        ("Light material", "Bolt-on edge"), 5.8, 5.0, 3400, 2545, 19890, 17190, 199, 2890, 1520, 95, 6310, 9425, 25860
    ),
)
