"""`check` on URDF, SDFormat and MJCF: what a file says of links and joints is read where its format puts it."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from yellowiron.checks import check
from yellowiron.checks.exchange.opening import read_exchange
from yellowiron.model.errors import YellowironError

INERTIAL = '<inertial><mass value="100"/><inertia ixx="3" iyy="4" izz="5" ixy="0" ixz="0" iyz="0"/></inertial>'


def urdf(joints: str, links: str = "") -> str:
    names = ("frame", "boom", "arm")
    return f'<robot name="a">{"".join(f"""<link name="{n}">{INERTIAL}</link>""" for n in names)}{links}{joints}</robot>'


def pivot(name: str, parent: str, child: str, more: str = "", *, kind: str = "revolute", xyz: str = "1 0 0") -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="0 0 1.5707963267948966"/><axis xyz="1 0 0"/>{more}</joint>'
    )


LIMIT = '<limit lower="-0.5" upper="1" effort="1000" velocity="1"/>'
TWO = pivot("lift", "frame", "boom", LIMIT) + pivot("reach", "boom", "arm", LIMIT)


def written(tmp_path: Path, text: str, name: str = "a.urdf") -> Path:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


def codes(path: Path) -> list[str]:
    return [f.code for f in check(path)]


def test_a_chain_is_placed_and_turned_as_its_origins_say(tmp_path: Path) -> None:
    view, _ = read_exchange(written(tmp_path, urdf(TWO)))
    lift, reach = view.joints
    # A quarter turn about z each: the second origin lies along the first's y, and x has become −x.
    assert lift.axis == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)
    assert reach.sides[0].position == pytest.approx([1.0, 1.0, 0.0]) and reach.axis == pytest.approx([-1.0, 0.0, 0.0])
    assert (lift.lower, lift.upper) == (-0.5, 1.0) and view.bodies["arm"].mass == 100.0
    assert codes(written(tmp_path, urdf(TWO))) == []


def test_frames_are_no_bodies_and_a_root_without_mass_is_none(tmp_path: Path) -> None:
    links = '<link name="base_link"/><link name="camera"/>'
    mounts = pivot("root", "base_link", "frame", kind="fixed") + pivot("mount", "arm", "camera", kind="fixed")
    view, _ = read_exchange(written(tmp_path, urdf(TWO + mounts, links)))
    assert set(view.bodies) == {"frame", "boom", "arm"}
    assert {j.name for j in view.joints} == {"lift", "reach"}


def test_three_pivots_in_a_point_are_a_ball(tmp_path: Path) -> None:
    between = (
        '<inertial><mass value="0.001"/><inertia ixx="1e-6" iyy="1e-6" izz="1e-6" ixy="0" ixz="0" iyz="0"/></inertial>'
    )
    links = f'<link name="one">{between}</link><link name="two">{between}</link>'
    turned = '<origin xyz="0 0 0" rpy="0 0 0"/>'
    ball = pivot("eye_pitch", "frame", "one", kind="continuous") + "".join(
        f'<joint name="eye_{n}" type="continuous"><parent link="{p}"/><child link="{c}"/>{turned}'
        f'<axis xyz="{a}"/></joint>'
        for n, p, c, a in (("roll", "one", "two", "0 1 0"), ("yaw", "two", "boom", "0 0 1"))
    )
    view, _ = read_exchange(written(tmp_path, urdf(ball + pivot("reach", "boom", "arm", LIMIT), links)))
    assert [(j.name, j.type, j.bodies) for j in view.joints] == [
        ("eye", "spherical", ("frame", "boom")), ("reach", "revolute", ("boom", "arm"))
    ]  # fmt: skip
    assert "one" not in view.bodies


@pytest.mark.parametrize(
    ("more", "code"),
    [
        ('<limit lower="1" upper="-0.5" effort="1" velocity="1"/>', "CHK060"),
        ('<limit lower="0" upper="0" effort="1" velocity="1"/>', "CHK061"),
        (f'{LIMIT}<mimic joint="gone"/>', "CHK097"),
    ],
)
def test_what_is_wrong_with_a_joint_is_told(more: str, code: str, tmp_path: Path) -> None:
    assert code in codes(
        written(tmp_path, urdf(pivot("lift", "frame", "boom", more) + pivot("reach", "boom", "arm", LIMIT)))
    )


def test_what_is_wrong_with_a_mass_is_told(tmp_path: Path) -> None:
    sound = urdf(TWO)
    assert "CHK035" in codes(written(tmp_path, sound.replace('izz="5"', 'izz="9"')))
    assert "CHK030" in codes(written(tmp_path, sound.replace('value="100"', 'value="-1"', 1)))
    assert "CHK031" in codes(written(tmp_path, sound.replace(INERTIAL, "", 2)))


def test_a_table_of_cuts_beside_the_file_closes_its_loops(tmp_path: Path) -> None:
    file = written(tmp_path, urdf(TWO))
    cut = {"name": "pin", "type": "revolute", "parent": "frame", "child": "arm", "axis": [0, 1, 0],
           "in_parent": [0, 2, 0], "in_child": [0, 0, 0]}  # fmt: skip
    (tmp_path / "joints.json").write_text(json.dumps({"cuts": [cut]}), encoding="utf-8")
    pin = read_exchange(file)[0].joints[-1]
    assert pin.cut and pin.bodies == ("frame", "arm")
    # The arm stands on (1, 1, 0): the pin's ends are a metre and more apart.
    assert np.linalg.norm(pin.sides[1].position - pin.sides[0].position) == pytest.approx(math.sqrt(2.0))
    assert "CHK050" in codes(file)
    (tmp_path / "joints.json").write_text(json.dumps({"cuts": [cut | {"child": "gone"}]}), encoding="utf-8")
    with pytest.raises(YellowironError, match="table of loops"):
        check(file)


SDF_LINK = "<inertial><mass>100</mass><inertia><ixx>3</ixx><iyy>4</iyy><izz>5</izz></inertia></inertial>"
SDF = f"""<sdf version="1.11"><model name="a">
  <frame name="stand"><pose degrees="true">0 0 1 0 0 90</pose></frame>
  <link name="frame"><pose relative_to="stand"/>{SDF_LINK}</link>
  <link name="boom"><pose relative_to="lift"/>{SDF_LINK}</link>
  <link name="rod"><pose relative_to="frame">3 0 0 0 0 0</pose>{SDF_LINK}</link>
  <joint name="lift" type="revolute"><pose relative_to="frame">2 0 0 0 0 0</pose><parent>frame</parent>
    <child>boom</child><axis><xyz expressed_in="__model__">0 0 1</xyz>
    <limit><lower>-1</lower><upper>1</upper></limit></axis></joint>
  <joint name="out" type="prismatic"><parent>frame</parent><child>rod</child>
    <axis><xyz>1 0 0</xyz><limit><lower>-1e16</lower><upper>1e16</upper></limit></axis></joint>
  <joint name="eye" type="ball"><parent>rod</parent><child>boom</child></joint>
</model></sdf>"""


def test_an_sdf_model_is_placed_by_its_frames(tmp_path: Path) -> None:
    view, _ = read_exchange(written(tmp_path, SDF, "a.sdf"))
    lift, out, eye = view.joints
    assert lift.sides[0].position == pytest.approx([0.0, 2.0, 1.0]) and lift.axis == pytest.approx([0.0, 0.0, 1.0])
    assert out.sides[0].position == pytest.approx([0.0, 3.0, 1.0]) and out.axis == pytest.approx([0.0, 1.0, 0.0])
    assert out.lower is None and eye.cut and not lift.cut
    assert view.bodies["boom"].center_of_mass == pytest.approx([0.0, 2.0, 1.0])
    assert "CHK064" in codes(tmp_path / "a.sdf")


PIN = '<connect name="pin" body1="rod" body2="boom" anchor="0.2 0 0"/>'
MJCF = f"""<mujoco model="a"><compiler angle="radian" autolimits="true"/><default><geom mass="50"/></default><worldbody>
  <body name="frame" pos="0 0 1"><freejoint/><geom type="box" size="1 0.5 0.2"/>
    <body name="boom" pos="1 0 0"><joint name="lift" axis="0 1 0" range="-1 1"/>
      <geom type="capsule" fromto="0 0 0 2 0 0" size="0.1"/></body>
    <body name="barrel" pos="0 0 0.2"><joint name="eye" axis="0 1 0"/><geom type="box" size="0.2 0.1 0.1"/>
      <body name="rod" pos="0.5 0 0"><joint name="out" type="slide" axis="1 0 0" range="-0.2 0.2"/>
        <geom type="box" size="0.2 0.05 0.05"/></body></body>
  </body></worldbody>
  <equality>{PIN}</equality>
  <actuator><position joint="out" kp="1e5"/></actuator></mujoco>"""


def test_an_mjcf_model_is_read_as_mujoco_has_it(tmp_path: Path) -> None:
    view, _ = read_exchange(written(tmp_path, MJCF, "a.xml"))
    joints = {j.name: j for j in view.joints}
    assert set(joints) == {"lift", "eye", "out", "pin"} and view.bodies["boom"].mass == pytest.approx(50.0)
    assert joints["lift"].sides[0].position == pytest.approx([1.0, 0.0, 1.0])
    assert joints["pin"].cut and joints["pin"].sides[0].position == pytest.approx([0.7, 0.0, 1.2])
    assert joints["pin"].sides[1].position == pytest.approx([0.7, 0.0, 1.2]) and joints["out"].driven
    assert codes(tmp_path / "a.xml") == []
    open_loop = MJCF.replace(PIN, "").replace('<position joint="out" kp="1e5"/>', '<motor joint="lift"/>')
    assert "CHK093" in codes(written(tmp_path, open_loop, "b.xml"))


def test_drives_that_are_unstable_at_the_files_step_are_told(tmp_path: Path) -> None:
    # A slide of 50 kg on a barrel of 50: its spring k is stable to steps of less than 2·√(m/k), 45 ms.
    spring = MJCF.replace(PIN, "").replace('kp="1e5"', 'kp="1e5" kv="1000"')
    for step, told in ((0.001, set()), (0.02, {"MJC002"}), (0.2, {"MJC001"})):
        text = spring.replace("<default>", f'<option timestep="{step}"/><default>')
        path = written(tmp_path, text, f"{step}.xml")
        assert {code for code in codes(path) if code.startswith("MJC")} == told, step
    (found,) = [f for f in check(tmp_path / "0.02.xml") if f.code == "MJC002"]
    assert "times its own" in found.message


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.urdf", "<robot", "no XML"),
        ("a.urdf", "<html/>", "'html'"),
        ("a.urdf", urdf(pivot("lift", "frame", "gone")), "'gone'"),
        ("a.urdf", urdf(TWO + pivot("back", "arm", "frame", LIMIT)), "no tree"),
        ("a.urdf", urdf(pivot("lift", "frame", "boom", kind="screw")), "'screw'"),
        ("a.urdf", urdf(TWO.replace('xyz="1 0 0"', 'xyz="1 0"')), "3 numbers"),
        ("a.sdf", SDF.replace('relative_to="stand"', 'relative_to="gone"'), "'gone'"),
        ("a.sdf", SDF.replace('<frame name="stand">', '<model name="b"/><frame name="stand">'), "not one model"),
        ("a.xml", MJCF.replace('type="box"', 'type="egg"'), "MuJoCo does not take"),
    ],
)
def test_what_cannot_be_read_is_one_sentence(name: str, text: str, words: str, tmp_path: Path) -> None:
    path = written(tmp_path, text, name)
    with pytest.raises(YellowironError, match=words) as caught:
        check(path)
    assert str(path) in caught.value.where and caught.value.hint


def test_no_file_and_a_folder_are_said(tmp_path: Path) -> None:
    (tmp_path / "a.urdf").mkdir()
    for name in ("a.urdf", "none.sdf"):
        with pytest.raises(YellowironError):
            check(tmp_path / name)
