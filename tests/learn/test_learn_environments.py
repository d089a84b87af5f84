"""Gymnasium environments of the small loader: by Gymnasium's own checker, and by what the machine does."""

from __future__ import annotations

import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="needs pip install 'yellowiron[learn]'")

from gymnasium.utils.env_checker import check_env  # noqa: E402

from yellowiron.learn import DriveTo, LoadBoulder, TrenchPose, load_machine  # noqa: E402
from yellowiron.learn.tasks import cylindrical  # noqa: E402
from yellowiron.model.errors import YellowironError  # noqa: E402

TASKS = {"TrenchPose": TrenchPose, "LoadBoulder": LoadBoulder, "DriveTo": DriveTo}


def play(env: Any, action: Any, steps: int) -> tuple[np.ndarray, float, dict[str, Any]]:
    total = 0.0
    for _ in range(steps):
        seen, reward, ended, truncated, info = env.step(action)
        total += reward
        if ended or truncated:
            break
    return seen, total, info


@pytest.mark.parametrize("task", TASKS)
def test_gymnasium_s_checker_is_content(task: str, usd_file: Path) -> None:
    env = gymnasium.make(f"yellowiron.learn.tasks:yellowiron/{task}-v0", machine=usd_file)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # observations have no bounds, which it remarks on
        check_env(env.unwrapped)
    assert isinstance(env.unwrapped, TASKS[task])


@pytest.mark.parametrize("task", TASKS)
def test_one_seed_is_one_episode(task: str, usd_file: Path) -> None:
    env, seen = TASKS[task](usd_file), []
    for seed in (3, 3, 4):
        first, _ = env.reset(seed=seed)
        env.action_space.seed(seed)
        rows = [first, *(env.step(env.action_space.sample())[0] for _ in range(5))]
        seen.append(np.array(rows))
    assert np.array_equal(seen[0], seen[1])
    assert not np.array_equal(seen[0], seen[2])


def test_levers_are_those_of_the_task_and_the_oil_moves_them(usd_file: Path) -> None:
    env = TrenchPose(usd_file)
    assert [lever.name for lever in env.levers] == ["boom"]
    env.reset(seed=0)
    low = env.goal()[5]
    play(env, np.array([1.0]), 20)
    assert env.goal()[5] > low + 0.02
    # A cylinder of 0.25 m/s has not gone farther than its oil takes it.
    stroke = float(env.data.joint("slide").qpos[0])
    assert 0.05 < stroke < 20 * env.dt * 0.25


def test_strokes_are_gone_to(usd_file: Path) -> None:
    env = TrenchPose(usd_file, actions="strokes")
    for wanted in (1.0, -0.5):
        env.reset(seed=0)
        play(env, np.array([wanted]), 100)
        joint = env.machine.mechanism.joint("slide")
        assert joint.lower is not None and joint.upper is not None
        middle, half = 0.5 * (joint.lower + joint.upper), 0.5 * (joint.upper - joint.lower)
        assert float(env.data.joint("slide").qpos[0]) == pytest.approx(middle + wanted * half, abs=0.03 * half)


def test_a_pose_is_reached_by_going_up_or_down(usd_file: Path) -> None:
    env = TrenchPose(usd_file)
    for seed in range(5):
        seen, info = env.reset(seed=seed)
        for _ in range(100):
            seen, reward, _, _, info = env.step(np.clip(5.0 * env.goal()[2:3], -1.0, 1.0))
        assert info["success"] and reward > 0.9
        assert np.linalg.norm(seen[-8:-5]) < 0.15


def test_loops_stay_closed(usd_file: Path) -> None:
    env = TrenchPose(usd_file)
    env.reset(seed=1)
    rng = np.random.default_rng(0)
    for _ in range(60):
        env.step(rng.uniform(-1.0, 1.0, 1))
        mujoco.mj_forward(env.model, env.data)
        assert np.abs(env.data.efc_pos[: 3 * env.model.neq]).max() < 1e-4


def test_it_drives_to_a_point_ahead(usd_file: Path) -> None:
    env = DriveTo(usd_file)
    assert [lever.name for lever in env.levers] == ["drive"]
    env.reset(seed=0)
    env._point = np.array([6.0, 0.0])
    env._left = 6.0
    _, total, info = play(env, np.array([1.0]), 200)
    assert info["success"] and total > 10.0


def test_a_boulder_lies_on_the_ground_and_is_carried_in_the_hollow_tool(usd_file: Path) -> None:
    env = LoadBoulder(usd_file)
    env.reset(seed=0)
    place = env.data.body("boulder").xpos.copy()
    assert place[2] == pytest.approx(env.machine.boulder, abs=0.01)
    assert env.model.body_mass[env.model.body("boulder").id] > 10.0
    still = np.zeros(len(env.levers))
    _, before, info = play(env, still, 5)
    assert not info["success"] and before < 0.0
    env.data.joint("boulder").qpos[:3] = env.data.site("load").xpos
    env.data.joint("boulder").qvel[:] = 0.0
    up = np.array([float(lever.name == "boom") for lever in env.levers])
    play(env, still, 10)
    lying = float(env.data.body("boulder").xpos[2])
    _, total, info = play(env, up, 40)
    assert info["success"] and total > before
    assert env.data.body("boulder").xpos[2] > lying + 0.05
    assert np.linalg.norm(env.goal()[:3]) < 3.0 * env.machine.boulder


def test_observations_end_with_the_goal_and_have_every_sensor(usd_file: Path) -> None:
    env = TrenchPose(usd_file)
    seen, _ = env.reset(seed=0)
    assert len(seen) == env.senses.size + 1 + 8
    assert np.allclose(seen[-8:], env.goal(), atol=1e-6)
    assert set(env.senses.places) == {env.model.sensor(n).name for n in range(env.model.nsensor)}


def test_many_at_once(usd_file: Path) -> None:
    many = gymnasium.make_vec(
        "yellowiron.learn.tasks:yellowiron/TrenchPose-v0", num_envs=3, vectorization_mode="sync", machine=str(usd_file)
    )
    seen, _ = many.reset(seed=1)
    assert seen.shape[0] == 3 and not np.array_equal(seen[0], seen[1])
    seen, reward, *_ = many.step(np.ones((3, 1), np.float32))
    assert reward.shape == (3,) and np.isfinite(seen).all()
    many.close()


@pytest.mark.slow
def test_many_at_once_in_processes(usd_file: Path) -> None:
    many = gymnasium.make_vec(
        "yellowiron.learn.tasks:yellowiron/DriveTo-v0", num_envs=2, vectorization_mode="async", machine=str(usd_file)
    )
    seen, _ = many.reset(seed=1)
    seen, _, *_ = many.step(np.ones((2, 1), np.float32))
    assert np.isfinite(seen).all()
    many.close()


def test_the_model_is_made_once(usd_file: Path) -> None:
    assert load_machine(usd_file, base="fixed") is load_machine(str(usd_file), base="fixed")
    assert TrenchPose(usd_file).model is TrenchPose(usd_file).model


def test_what_is_wrong_is_one_sentence(usd_file: Path, tmp_path: Path) -> None:
    with pytest.raises(YellowironError, match="no lever 'arm'"):
        TrenchPose(usd_file, levers=["arm"])
    with pytest.raises(YellowironError):
        TrenchPose(tmp_path / "absent.usda")


def test_a_place_in_cylinder_coordinates() -> None:
    turned = cylindrical(np.array([0.0, 2.0, -1.0]), np.array([0.0, 0.0, 1.0]))
    assert turned == pytest.approx([2.0, np.pi / 2, -1.0, np.pi / 2])


def test_without_gymnasium_a_sentence_says_what_to_install() -> None:
    script = (
        "import sys; sys.modules['gymnasium'] = None\n"
        "import yellowiron, yellowiron.learn\n"
        "from yellowiron.model.errors import YellowironError\n"
        "try:\n    yellowiron.learn.TrenchPose\n"
        "except YellowironError as error:\n    print(error.hint)\n"
    )
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert ran.stdout.strip() == "pip install 'yellowiron[learn]'"


@pytest.mark.slow
def test_a_loader_can_take_up_the_boulder(built_loader: Any) -> None:
    """The edge low under it, then curled and raised while the machine drives on."""
    env = LoadBoulder(built_loader.folder / "wheel_loader.usda")
    names = [lever.name for lever in env.levers]

    def act(**told: float) -> np.ndarray:
        return np.array([float(told.get(name, 0.0)) for name in names])

    for seed in range(2):
        env.reset(seed=seed)
        met, curled, info = False, False, {"success": False}
        for _ in range(300):
            height = float(env.data.site(env.machine.tip.name).xpos[2])
            floor = env.data.body(env.machine.tip.body).xmat.reshape(3, 3)[:, 0]
            pitch = float(np.degrees(np.arctan2(floor[2], floor[0])))
            met = met or env.goal()[0] < 0.92
            curled = curled or pitch > 35.0
            if curled:
                action = act(boom=1.0, bucket=0.2)
            elif met:
                action = act(drive=0.5, bucket=1.0, boom=0.3)
            else:
                low = abs(height - 0.06) < 0.03
                action = act(drive=0.25 * low, boom=4.0 * (0.06 - height), bucket=0.05 * (-8.0 - pitch))
            _, _, _, _, info = env.step(action)
        assert info["success"], seed
        assert env.data.body("boulder").xpos[2] > 3.0
