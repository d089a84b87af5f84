from __future__ import annotations

from pathlib import Path

import pytest

from kit.packages import install_package
from yellowiron.model.errors import YellowironError
from yellowiron.support.plugins import find_plugins, installed

GROUP = "yellowiron.tests"


def test_none_where_nobody_brings_any() -> None:
    assert installed(GROUP) == []


def test_by_name_whatever_the_order_of_the_packages(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, values in (("zeta", {"c": 3, "a": 1}), ("alpha", {"b": 2})):
        install_package(
            tmp_path / name, monkeypatch, name=name, group=GROUP,
            entries={key: f"{name}_module:{key}" for key in values},
            modules={f"{name}_module": "\n".join(f"{key} = {value}" for key, value in values.items())},
        )  # fmt: skip
    assert installed(GROUP) == [("a", 1), ("b", 2), ("c", 3)]


def test_nothing_is_imported_before_it_is_loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install_package(tmp_path, monkeypatch, name="broken", group=GROUP, entries={"it": "not_there:it"})
    assert list(find_plugins(GROUP)) == ["it"]


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("raise RuntimeError('no\\nlicence')", "RuntimeError: no licence"),
        ("import not_there_at_all", "No module named 'not_there_at_all'"),
        ("other = 1", "has no attribute 'it'"),
        ("it = 1", "is no str but an int"),
    ],
)
def test_what_is_broken_is_one_sentence(
    source: str, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install_package(
        tmp_path, monkeypatch, name="broken", group=GROUP, entries={"it": "broken_one:it"},
        modules={"broken_one": source},
    )  # fmt: skip
    with pytest.raises(YellowironError, match="The plugin 'it'") as error:
        installed(GROUP, kind=str)
    assert words in error.value.message and "\n" not in error.value.message
    assert error.value.where == f"broken ({GROUP}: it = broken_one:it)"


def test_an_own_name_is_not_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install_package(tmp_path, monkeypatch, name="thief", group=GROUP, entries={"own": "thief:own"})
    with pytest.raises(YellowironError, match="brings 'own', a name that yellowiron has itself"):
        find_plugins(GROUP, builtin=("own",))


def test_two_of_one_name_are_one_too_many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("first", "second"):
        install_package(tmp_path / name, monkeypatch, name=name, group=GROUP, entries={"it": f"{name}:it"})
    with pytest.raises(YellowironError, match="Two packages bring 'it'") as error:
        find_plugins(GROUP)
    assert "first (" in error.value.where and "second (" in error.value.where
