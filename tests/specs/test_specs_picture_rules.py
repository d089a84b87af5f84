"""Rules and edges of fills on the picture of a page."""

from __future__ import annotations

import numpy as np
import pytest

from yellowiron.specs.ocr import _joins
from yellowiron.specs.pages.picture_rules import rules_of_picture
from yellowiron.specs.pages.strokes import DrawnRule
from yellowiron.specs.recognition.mending import mended


def test_rules_and_fills_of_a_picture() -> None:
    scale = 2.0
    picture = np.full((400, 600), 250, np.uint8)
    picture[100:102, 40:440] = 30  # a rule, 200 points long
    picture[200:230, 40:440] = 225  # a light band behind a row
    picture[60:260, 300:302] = 30  # a wall
    picture[300:318, 100:112] = 0  # a letter
    rules = rules_of_picture(picture, scale)
    level = sorted({round(r.top) for r in rules if r.horizontal})
    assert level == [50, 100, 115]
    walls = [r for r in rules if not r.horizontal]
    assert {round(w.x0) for w in walls} >= {150}
    assert not [r for r in rules if r.horizontal and r.x1 - r.x0 < 40]
    wall = next(w for w in walls if round(w.x0) == 150)
    assert wall.bottom - wall.top == pytest.approx(100.0, abs=2.0)


def test_faint_bands_are_rules_and_the_tops_of_letters_none() -> None:
    picture = np.full((400, 900), 247, np.uint8)
    picture[100:140, 60:860] = 239  # a band that is hardly seen
    for x in range(80, 840, 14):
        picture[200:216, x : x + 7] = 20  # letters in a row: an edge along half of their tops
    level = [r for r in rules_of_picture(picture, 2.0) if r.horizontal]
    assert sorted({round(r.top) for r in level}) == [50, 70]
    assert all(r.x0 == pytest.approx(30.0, abs=2.0) and r.x1 == pytest.approx(430.0, abs=2.0) for r in level)


def test_a_rule_under_dirt_is_one() -> None:
    picture = np.full((400, 900), 250, np.uint8)
    picture[140:142, 60:800] = 30
    picture[138:144, 500:508] = 250  # dirt, 4 points
    level = [r for r in rules_of_picture(picture, 2.0) if r.horizontal]
    assert [(round(r.x0), round(r.top), round(r.x1)) for r in level] == [(30, 70, 400)]


def test_the_side_of_a_table_far_from_its_words_is_a_wall() -> None:
    level = [DrawnRule(60, y, 540, y) for y in (100, 127, 154)]
    assert _joins(DrawnRule(540, 100, 540, 154), level) and not _joins(DrawnRule(540, 100, 540, 140), level)


@pytest.mark.slow
def test_a_photograph_has_no_rules() -> None:
    picture = np.random.default_rng(7).integers(0, 255, (900, 1300), dtype=np.uint8)
    picture = np.repeat(np.repeat(picture[:90, :13], 10, axis=0), 100, axis=1)
    assert rules_of_picture(np.tile(picture, (30, 1))[:26000], 1.0) == []


@pytest.mark.parametrize(
    ("seen", "meant"),
    [
        (".265", "265"),
        ("kgf/cm?", "kgf/cm2"),
        ("power...", "power"),
        ("2.5", "2.5"),
        ("m?", "m²"),
        ("(/min.)", "(l/min.)"),
        ("Ipm", "lpm"),
        ("Ib", "lb"),
        ("Ibaka", "Ibaka"),
        ("—2°", "-2°"),
        ("--2°", "-2°"),
        ("16—52", "16—52"),
        ("1482”", "1482"),
        ('12"', '12"'),
        ("s/e/1", "s/e/l"),
        ("（mm)", "(mm)"),
        ("（斗杆）", "（斗杆）"),
    ],
)
def test_words_as_they_are_misread(seen: str, meant: str) -> None:
    assert mended(seen) == meant
