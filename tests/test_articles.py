"""No sentence of the program says "a articulated" or "an bucket"."""

from __future__ import annotations

import ast
import contextlib
import re
from pathlib import Path

import pytest

from yellowiron.cli import main
from yellowiron.library import list_templates, load_template
from yellowiron.model.alignment import UNSIGNED
from yellowiron.specs.values.requested import asked, hint_for
from yellowiron.studio.operations import Operation, words
from yellowiron.support.text import with_article

_OPEN = re.compile(r"(^|[\s('\"])[Aa]n? $")
"""A literal that ends with an article: what is filled in behind it may want the other one."""
_WRONG = re.compile(
    r"\b(?:[Aa] (?!uni|us[ae]|eu|one\b|[A-Z]\b|[A-Z]{2,}|[aeiou]\b)[aeiouAEIOU]\w+"
    r"|[Aa]n (?!hour|hon|X|[A-Z]{2,}|[A-Z]\b)[^aeiouAEIOU\W\d]\w+)"
)


@pytest.fixture(scope="module")
def nodes(root: Path) -> list[tuple[Path, ast.AST]]:
    """All that the sources say, with its file."""
    files = sorted((root / "src").rglob("*.py"))
    return [(file, node) for file in files for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))]


def test_the_article_of_a_word() -> None:
    said = ("articulated dump truck", "excavator", "wheel loader", "angle", "unit", "8 mm pin", "hour", "imu", "one")
    assert [with_article(w).split()[0] for w in said] == ["an", "an", "a", "an", "a", "an", "an", "an", "a"]


def test_what_is_told_to_be_wrong() -> None:
    wrong = ("Of a articulated truck", "an bucket", "A excavator stands")
    right = ("an articulated truck", "a unit", "an STL file", "a one-sided part", "an hour", "a wheel", "data a is")
    assert all(map(_WRONG.search, wrong)) and not any(map(_WRONG.search, right[:-1]))


@pytest.mark.slow
def test_an_article_before_what_is_filled_in_is_chosen_by_it(root: Path, nodes: list[tuple[Path, ast.AST]]) -> None:
    """Literals with an article at their end, before a value: `with_article` gives both. A number is written out."""
    bare = []
    for file, node in nodes:
        if not isinstance(node, ast.JoinedStr):
            continue
        for text, filled in zip(node.values, node.values[1:], strict=False):
            if (
                isinstance(text, ast.Constant)
                and _OPEN.search(str(text.value))
                and isinstance(filled, ast.FormattedValue)
            ):
                bare.append(f"{file.name}:{node.lineno}: {ast.unparse(filled)}")
    for pattern in ("*.js", "*.j2"):
        for file in sorted((root / "src").rglob(pattern)):
            bare += [f"{file.name}: {m}" for m in re.findall(r"\b[Aa]n? (?:\$\{|\{\{).{20}", file.read_text("utf-8"))]
    assert bare == []


def test_the_program_itself_says_none(nodes: list[tuple[Path, ast.AST]]) -> None:
    """Texts in the sources, docstrings too: they are the help."""
    found = []
    for file, node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            found += [f"{file.name}:{node.lineno}: {m.group(0)}" for m in _WRONG.finditer(node.value)]
    assert found == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", list_templates())
def test_of_every_type(
    kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is shown of it, copied, asked for, checked and refused."""
    cad = tmp_path / "machine.step"
    cad.write_text("ISO-10303-21;\n")
    for arguments in (
        ["templates", "show", kind], ["templates", "check", kind], ["templates", "copy", kind, str(tmp_path / "own")],
        ["build", kind, "--cad", str(tmp_path / "none.step"), "--out", str(tmp_path / "out")],
        ["build", kind, "--cad", str(cad), "--out", str(tmp_path / "out"), "--set", "boom=1 m"],
        ["build", kind, "--cad", str(cad), "--out", str(tmp_path / "out"), "--set", "Operating Weight=1 m"],
    ):  # fmt: skip
        monkeypatch.setattr("sys.argv", ["yellowiron", *arguments])
        with contextlib.suppress(SystemExit):
            main()
    told = capsys.readouterr()
    template = load_template(kind, sheet_only=True)
    hints = [hint_for(wanted) for wanted in asked(template)]
    said = [words(Operation("role", parts={"part": role.name}, signature=UNSIGNED)) for role in template.roles]
    files = [file.read_text(encoding="utf-8") for file in (tmp_path / "own").iterdir() if file.suffix == ".md"]
    text = "\n".join((told.out, told.err, *hints, *said, *files))
    assert len(text) > 2000
    assert [m.group(0) for m in _WRONG.finditer(re.sub(r"\s+", " ", text))] == []
