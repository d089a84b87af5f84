"""Pictures of what is asked: the parts are lit and framed where they are, and the bytes are the same every time."""

from __future__ import annotations

import io
from dataclasses import replace

import numpy as np
import pytest
from doubted_machine import Doubted
from PIL import Image

from yellowiron.model.assembly import Part
from yellowiron.model.geometry import Mesh
from yellowiron.opinion.drawing import ALONE, WHOLE, Stage, box_of, pictures_of, stage_of


@pytest.fixture(scope="module")
def stage(doubted: Doubted) -> Stage:
    return stage_of(doubted.assembly, doubted.alignment.frame)


def of(doubted: Doubted, body: str) -> tuple[str, ...]:
    return tuple(sorted(part for part, true in doubted.truth.items() if true == body))


def red(png: bytes) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    """Where a picture is plainly redder than it is blue, the frame with it."""
    pixels = np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), dtype=np.int16)
    return np.asarray(pixels[..., 0] - pixels[..., 2] > 60)


def test_the_parts_are_lit_in_their_frame_and_nothing_else(doubted: Doubted, stage: Stage) -> None:
    whole, alone = pictures_of(stage, of(doubted, "bucket"))
    there = red(whole)
    assert (there.shape, red(alone).shape) == (WHOLE[::-1], ALONE[::-1])
    rows, columns = np.flatnonzero(there.any(axis=1)), np.flatnonzero(there.any(axis=0))
    # The frame is the outermost red there is, whole on all four sides.
    frame = there[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    assert frame[0].all() and frame[-1].all() and frame[:, 0].all() and frame[:, -1].all()
    assert frame[4:-4, 4:-4].sum() > 1000
    assert 0.02 < frame.size / there.size < 0.3
    assert red(alone).mean() > 0.15


def test_other_parts_are_another_picture_and_the_same_the_same_bytes(doubted: Doubted, stage: Stage) -> None:
    arm = pictures_of(stage, of(doubted, "arm"))
    assert arm == pictures_of(stage_of(doubted.assembly, doubted.alignment.frame), of(doubted, "arm"))
    boom = pictures_of(stage, of(doubted, "boom"))
    assert arm[0] != boom[0] and arm[1] != boom[1]


def test_parts_alone_stand_on_the_ground(doubted: Doubted, stage: Stage) -> None:
    """Where nothing is under them but air, it is as blue as the sky."""
    assert box_of(stage, of(doubted, "bucket"))[0, 2] > 3.0
    pixels = np.asarray(Image.open(io.BytesIO(pictures_of(stage, of(doubted, "bucket"))[1])), dtype=np.int16)
    assert (pixels[-20:, :, 0] > pixels[-20:, :, 2]).mean() > 0.5


def test_boxes_are_in_the_machine_frame(doubted: Doubted, stage: Stage) -> None:
    parts = of(doubted, "boom")
    points = np.concatenate([doubted.assembly.points_of(doubted.assembly.part(part)) for part in parts])
    placed = points @ doubted.alignment.frame[:3, :3].T + doubted.alignment.frame[:3, 3]
    assert box_of(stage, parts) == pytest.approx(np.array([placed.min(axis=0), placed.max(axis=0)]), abs=1e-3)


def test_a_speck_can_be_drawn(doubted: Doubted) -> None:
    mesh = Mesh(np.zeros((3, 3)), np.array([[0, 1, 2]], dtype=np.int32))
    speck = replace(next(iter(doubted.assembly.shapes.values())), mesh=mesh)
    assembly = replace(
        doubted.assembly,
        parts=(*doubted.assembly.parts, Part("speck", "speck", (), "speck", np.eye(4))),
        shapes={**doubted.assembly.shapes, "speck": speck},
    )
    whole, alone = pictures_of(stage_of(assembly, doubted.alignment.frame), ("speck",))
    assert red(whole).any() and len(alone) > 500
