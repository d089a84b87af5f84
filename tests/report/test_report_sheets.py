"""What `extract` prints: to be read in a terminal of 100 columns, in any script."""

from __future__ import annotations

from typing import Any

import pytest
from rich.cells import cell_len
from rich.console import Console

from yellowiron.model.specification import Candidate, Evidence, Specification, Specifications
from yellowiron.model.template import JointTemplate, Template, Wanted
from yellowiron.report import specification_entry, specification_table
from yellowiron.specs import missing_values


def value(name: str, quote: str, status: Any = "ok", **more: Any) -> Specification:
    evidence = Evidence("sheet.pdf", 3, quote, (1.0, 2.0, 3.0, 4.0))
    return Specification(name, 4.37, "m", status, evidence=evidence, **more)


ASKED = (
    Wanted("Hinge Pin Height at Maximum Lift", "length"),
    Wanted("Dumping Clearance", "length"),
    Wanted("Operating Weight", "mass"),
    Wanted("Axle Height", "length", where="the dimensions", use="check of the wheel radius"),
    Wanted("Swing Speed", "angular_speed"),
)
CHINESE = "最大举升高度时铲斗铰销高度（标准动臂，标准铲斗，轮胎23.5R25，不含铲齿）4370 mm 三项和时间 10.2 s"
OTHER = Evidence("sheet.pdf", 4, "Dump clearance 2980 mm")
FOUND = Specifications(
    {
        s.name: s
        for s in (
            value("Hinge Pin Height at Maximum Lift", CHINESE, example=True),
            value(
                "Dumping Clearance",
                "ダンピングクリアランス（45度前傾、ボルトオンカッティングエッジ付）3075 mm",
                "conflict",
                reason="the columns of the sheet differ",
                candidates=(
                    Candidate(3.075, "m", OTHER, "標準ブーム"),
                    Candidate(2.98, "m", OTHER, "ハイリフトブーム"),
                ),
            ),
            value("Operating Weight", "Einsatzgewicht ca. 25 t", "review", reason="the sheet prints a range"),
            Specification("Axle Height", None, "m", "missing"),
            Specification("Swing Speed", None, "rad/s", "unreadable"),
        )
    }
)
TEMPLATE = Template("machine", "", "", (), (JointTemplate("hinge", "revolute", ("frame", "arm")),), wanted=ASKED)


@pytest.fixture(scope="module", params=[80, 100])
def printed(request: pytest.FixtureRequest) -> tuple[int, list[str]]:
    console = Console(width=request.param, file=None, record=True, legacy_windows=False, force_terminal=False)
    with console.capture() as capture:
        console.print(
            specification_table(
                [specification_entry(s) for s in FOUND],
                missing=missing_values(TEMPLATE, FOUND),
                findings=[
                    {
                        "code": "SPC001",
                        "severity": "info",
                        "where": "sheet.pdf, page 1",
                        "message": "no text",
                        "hint": "",
                    }
                ],
            )
        )
    return request.param, capture.get().splitlines()


def test_no_line_is_wider_than_the_terminal(printed: tuple[int, list[str]]) -> None:
    width, lines = printed
    assert max(map(cell_len, lines)) <= width


def test_a_value_is_one_line_with_its_quote_cut_at_the_edge(printed: tuple[int, list[str]]) -> None:
    width, lines = printed
    if width < 100:  # names take two lines there
        return
    (line,) = [line for line in lines if line.startswith("Hinge Pin Height at Maximum Lift")]
    assert "4370 mm" in line and " ok " in line and " 3 " in line and "“最大举升高度" in line
    assert line.rstrip().endswith("…") and width - 2 <= cell_len(line.rstrip()) <= width


def test_what_to_look_at_says_why(printed: tuple[int, list[str]]) -> None:
    text = "\n".join(printed[1])
    assert "the columns of the sheet differ" in text and "the sheet prints a range" in text
    assert "3075 mm  page 4  標準ブーム" in text and "2980 mm  page 4  ハイリフトブーム" in text


def test_what_is_missing_says_what_it_is_where_it_stands_and_how_to_give_it(printed: tuple[int, list[str]]) -> None:
    text = "\n".join(printed[1])
    assert "length; check of the wheel radius" in text and "the dimensions" in text
    assert '--set "Axle Height=VALUE mm"' in text and '--set "Swing Speed=VALUE rpm"' in text
    assert "5 values asked for: 1 ok, 1 review, 1 conflict, 1 missing, 1 unreadable." in text
    assert "SPC001" in text
