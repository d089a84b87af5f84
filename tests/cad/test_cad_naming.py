"""Names: encodings sniffed from bytes, generated names told from written ones, unique ids."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from kit.cadfiles.step import Node, Use, box, write_step
from yellowiron.cad.naming import decode_name, is_generic, occurrence_name, sniff_encoding, unique_ids
from yellowiron.cad.readers.exact.step import read_step

NAMES = {
    "gb18030": ["动臂油缸", "轮式装载机", "铲斗", "前车架总成", "螺栓M24", "转向油缸(左)", "销轴", "摇臂"],
    "cp932": ["アーム", "ブーム", "バケット", "表示ソ能", "ﾊﾞｹｯﾄ", "油圧シリンダ", "前フレーム組立", "ボルトM24"],
    "big5": ["動臂油缸", "鏟斗", "前車架", "螺栓M24", "轉向油缸(左)", "搖臂", "輪胎"],
    "cp949": ["버킷", "붐 실린더", "앞 프레임", "볼트 M24", "타이어", "조향 실린더"],
    "euc_jp": ["アーム", "ブーム", "バケット", "油圧シリンダ", "前フレーム組立"],
    "cp1252": [
        "Hydraulikzylinder groß",
        "Schaufelträger",
        "Vérin de levage",
        "Châssis",
        "Größe",
        "Ø24 Pin",
        "45° elbow",
    ],
}


@pytest.mark.parametrize("encoding", NAMES)
def test_encoding_of_a_file(encoding: str) -> None:
    assert sniff_encoding([b"FRAME", *(name.encode(encoding) for name in NAMES[encoding])]) == encoding


@pytest.mark.parametrize("encoding", ["gb18030", "cp932", "cp1252"])
def test_encoding_of_few_names(encoding: str) -> None:
    for name in NAMES[encoding][:4]:
        assert sniff_encoding([name.encode(encoding)]) == encoding


def test_ascii_and_utf8_are_utf8() -> None:
    assert sniff_encoding([]) == sniff_encoding([b"BOOM"]) == "utf-8"
    assert sniff_encoding(["Träger".encode(), "动臂".encode()]) == "utf-8"


@given(st.lists(st.binary(max_size=40), max_size=8))
def test_any_bytes_have_an_encoding(names: list[bytes]) -> None:
    encoding = sniff_encoding(names)
    for name in names:
        decode_name(name.decode("latin-1"), encoding)


@pytest.mark.parametrize("encoding", ["gb18030", "cp932", "cp1252", "cp949"])
def test_names_read_from_a_file(encoding: str, tmp_path: Path) -> None:
    # Programs write their computer's encoding into a file that should be ASCII.
    names = NAMES[encoding][:6]
    leaf = Node("NAME0", box(1, 2, 3))
    root = Node("ROOT", children=[Use(leaf), *(Use(Node(f"NAME{i}", box(1, 2, 3 + i))) for i in range(1, len(names)))])
    path = write_step(tmp_path / "names.step", root)
    data = path.read_bytes()
    for index, name in enumerate(names):
        data = data.replace(f"NAME{index}".encode(), name.encode(encoding))
    path.write_bytes(data)
    assembly = read_step(str(path))
    assert [part.name for part in assembly.parts] == [decode_name(name, "utf-8") for name in names]
    assert any(finding.code == "CAD010" and encoding in finding.message for finding in assembly.findings)


def test_escaped_names(tmp_path: Path) -> None:
    path = write_step(tmp_path / "names.step", Node("ESCAPED", box(1, 2, 3)))
    path.write_bytes(path.read_bytes().replace(b"ESCAPED", rb"\X2\52A881C2\X0\ \X\E4 it''s\ ".strip()))
    assert read_step(str(path)).parts[0].name == "动臂 ä it's\\"


@pytest.mark.parametrize("name", ["", "12", "Solid17", "NAUO3", "=>[0:1:1:2]", "COMPOUND", "Part_001", "Body.2"])
def test_generic_names(name: str) -> None:
    assert is_generic(name)


@pytest.mark.parametrize("name", ["BOLT M24", "Solid axle", "Part carrier", "PIN 40", "动臂", "BODY PLATE LH"])
def test_telling_names(name: str) -> None:
    assert not is_generic(name)


@pytest.mark.parametrize(
    ("instance", "product", "name"),
    [
        ("BOLT-3", "BOLT", "BOLT"),
        ("Bolt:1", "BOLT", "BOLT"),
        ("NAUO7", "BOLT", "BOLT"),
        ("7", "BOLT", "BOLT"),
        ("", "BOLT", "BOLT"),
        ("LIFT CYL LH", "HC-150-90", "LIFT CYL LH"),
        ("BOOM", "Solid17", "BOOM"),
        ("3", "Solid17", "Solid17"),
        ("", "", ""),
    ],
)
def test_occurrence_names(instance: str, product: str, name: str) -> None:
    assert occurrence_name(instance, product) == name


@given(st.lists(st.lists(st.sampled_from(["A", "B", "A#2", "B#2", ""]), max_size=3).map(tuple), max_size=20))
def test_ids_are_unique(paths: list[tuple[str, ...]]) -> None:
    ids = unique_ids(paths)
    assert len(set(ids)) == len(paths)
    assert ids == unique_ids(paths)


def test_ids_are_numbered_in_order() -> None:
    assert unique_ids([("A", "B"), ("A", "B"), ("A",), ("A", "B")]) == ["A/B", "A/B#2", "A", "A/B#3"]
