"""Manifests: what they make of what a person writes, and what they say of what nobody can mean."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from yellowiron.fleet import read_manifest, schema
from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.manifest import KEYS, shard_of
from yellowiron.fleet.values import Item

ENTRY = {"cad": "a.step", "type": "wheel_loader"}


def manifest(folder: Path, document: Any, name: str = "fleet.json") -> Path:
    path = folder / name
    path.write_text(document if isinstance(document, str) else json.dumps(document))
    return path


def items(folder: Path, *machines: dict[str, Any], **defaults: Any) -> tuple[Item, ...]:
    return read_manifest(manifest(folder, {"defaults": defaults, "machines": machines})).items


def test_defaults_are_of_all_that_say_nothing_else(tmp_path: Path) -> None:
    one, two = items(
        tmp_path, ENTRY, {**ENTRY, "id": "other", "timeout": "2 h", "set": ["A=1 m"]}, timeout="90 s", memory="6 GB"
    )
    assert (one.id, one.timeout_s, one.memory_mb, one.set) == ("a", 90.0, 6000, ())
    assert (two.timeout_s, two.set) == (7200.0, ("A=1 m",))
    assert one.cad == str(tmp_path / "a.step")


def test_a_pattern_is_a_machine_a_file_in_the_order_of_names(tmp_path: Path) -> None:
    for name in ("b 2.glb", "a.glb", "c.step"):
        (tmp_path / name).touch()
    found = items(tmp_path, {"cad": "*.glb", "type": "excavator", "specs": "sheets/{stem}.pdf"})
    assert [item.id for item in found] == ["a", "b_2"]
    assert found[1].specs == (str(tmp_path / "sheets" / "b 2.pdf"),)


def test_all_forms_say_the_same(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    yaml = """
machines:
  - {id: one, cad: a.step, type: wheel_loader, set: [A=1 m, B=2 m], timeout: 5 min, mirror: true}
"""
    toml = """
[[machines]]
id = "one"
cad = "a.step"
type = "wheel_loader"
set = ["A=1 m", "B=2 m"]
timeout = "5 min"
mirror = true
"""
    rows = "id,cad,type,set,timeout,mirror,memory\none,a.step,wheel_loader,A=1 m; B=2 m,5 min,true,\n"
    entry = {"id": "one", **ENTRY, "set": ["A=1 m", "B=2 m"], "timeout": 300, "mirror": True}
    forms = {"a.toml": toml, "a.csv": rows, "a.json": json.dumps({"machines": [entry]})}
    try:
        import yaml as _  # type: ignore[import-untyped,unused-ignore]  # noqa: F401
    except ImportError:
        pass
    else:
        forms["a.yaml"] = yaml
    made = [read_manifest(manifest(tmp_path, text, name)).items for name, text in forms.items()]
    plain = [[(i.id, i.cad, i.type, i.set, i.timeout_s, i.mirror) for i in one] for one in made]
    assert all(one == plain[0] for one in plain)
    assert plain[0] == [("one", str(tmp_path / "a.step"), "wheel_loader", ("A=1 m", "B=2 m"), 300.0, True)]


@pytest.mark.parametrize(
    ("document", "said", "place"),
    [
        ({"machines": [{"cad": "a.step"}]}, "'type' is missing", "machines[1]"),
        ({"machines": [{"type": "excavator"}]}, "'cad' is missing", "machines[1]"),
        ({"machines": [{**ENTRY, "spec": "a.pdf"}]}, "'spec' is not a key here", "machines[1]"),
        ({"machines": [{**ENTRY, "timeout": "soon"}]}, "'soon' does not fit here", "machines[1].timeout"),
        ({"machines": [{**ENTRY, "memory": True}]}, "True does not fit here", "machines[1].memory"),
        ({"machines": [{**ENTRY, "tracks": "rubber"}]}, "'rubber' does not fit here", "machines[1].tracks"),
        ({"machines": [ENTRY, ENTRY]}, "The id 'a' is given twice", "machines[2]"),
        ({"machines": [{**ENTRY, "id": "a"}, {**ENTRY, "id": "A"}]}, "The id 'A' is given twice", "machines[2]"),
        ({"machines": [{**ENTRY, "id": "../x"}]}, "cannot name a folder", "machines[1].id"),
        ({"machines": [{**ENTRY, "cad": "no/*.step"}]}, "No file fits the pattern", "machines[1].cad"),
        ({"machines": [{**ENTRY, "variants": {"file": "v.yaml"}}]}, "'count' is missing", "machines[1].variants"),
        ({"defaults": {"id": "x"}, "machines": []}, "'id' is not a key here", "defaults"),
        ([], "The manifest has no machines", "fleet.json"),
        ("{", "The manifest is not JSON", "fleet.json"),
    ],
)
def test_what_nobody_can_mean_is_told_with_its_place(tmp_path: Path, document: Any, said: str, place: str) -> None:
    with pytest.raises(UnusableError) as error:
        read_manifest(manifest(tmp_path, document))
    assert said in error.value.message
    assert place in error.value.where
    assert error.value.hint


def test_a_near_word_is_proposed(tmp_path: Path) -> None:
    with pytest.raises(UnusableError) as error:
        items(tmp_path, {**ENTRY, "spec": "a.pdf"})
    assert "specs" in error.value.hint


def test_two_files_of_one_entry_need_ids_of_their_own(tmp_path: Path) -> None:
    for folder in ("x", "y"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "a.glb").touch()
    with pytest.raises(UnusableError, match=r"twice|same id"):
        items(tmp_path, {"cad": "*/a.glb", "type": "excavator"})
    found = items(tmp_path, {"cad": "*/a.glb", "type": "excavator", "id": "{parent}_{stem}"})
    assert [item.id for item in found] == ["x_a", "y_a"]


def test_a_template_folder_is_found_beside_the_manifest(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "excavator").mkdir()  # a build's folder, say: the library's type is meant
    one, two = items(tmp_path, {"cad": "a.glb", "type": "mine"}, {"cad": "b.glb", "type": "excavator"})
    assert (one.type, two.type) == (str(tmp_path / "mine"), "excavator")


def test_shares_are_all_of_a_plan_and_none_twice(tmp_path: Path) -> None:
    plan = read_manifest(manifest(tmp_path, {"machines": [{**ENTRY, "id": f"m{n}"} for n in range(11)]}))
    shares = [shard_of(plan, f"{n}/4").items for n in (1, 2, 3, 4)]
    assert sorted(item.id for share in shares for item in share) == sorted(item.id for item in plan.items)
    for word in ("0/4", "5/4", "1", "1/0", "a/b"):
        with pytest.raises(UnusableError, match="is no share"):
            shard_of(plan, word)


def test_the_schema_knows_the_same_keys_and_takes_what_is_taken() -> None:
    known = schema("manifest")
    jsonschema.Draft202012Validator.check_schema(known)
    entry = known["properties"]["machines"]["items"]["properties"]
    assert set(entry) == set(KEYS)
    more = {"timeout": "20 min", "memory": "6 GB", "set": "A=1 m", "variants": {"file": "v", "count": 2}}
    jsonschema.validate({"machines": [{**ENTRY, **more}]}, known)
    for bad in ({**ENTRY, "timeout": "soon"}, {**ENTRY, "spec": "x"}, {"type": "excavator"}):
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate({"machines": [bad]}, known)
