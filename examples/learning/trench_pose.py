"""Learns to bring a bucket to poses in a trench: the cross-entropy method over a small policy, with numpy alone.

    python examples/learning/trench_pose.py out/excavator/excavator.usda [--generations 30] [--out curve.json]

A policy is one matrix from what an observation says of the goal (what is left, and where the tool is) to the levers.
Each generation draws 24 policies, plays each on the same 6 goals, and goes on from the 6 best. The same seed gives the
same curve. It takes some minutes on one core.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path

import numpy as np

from yellowiron.learn import TrenchPose

POLICIES, ELITE, GOALS, TRIED = 24, 6, 6, 20
TOLD = 8
"""Numbers at an observation's end that say the goal."""
SPREAD, LEAST = 1.0, 0.05
"""The first spread of a policy's numbers, and the least."""


def play(env: TrenchPose, policy: np.ndarray, seed: int) -> tuple[float, float, bool]:
    """The sum of rewards of an episode, how far from the goal it ends (m), and whether it was there at its end."""
    seen, info = env.reset(seed=seed)
    total, done = 0.0, False
    while not done:
        seen, reward, ended, truncated, info = env.step(np.tanh(policy @ np.append(seen[-TOLD:], 1.0)))
        total, done = total + reward, ended or truncated
    return total, float(np.linalg.norm(seen[-TOLD:][:3])), info["success"]


def main() -> None:
    """Learns, and prints a line a generation."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machine", type=Path)
    parser.add_argument("--generations", type=int, default=30)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path)
    given = parser.parse_args()
    env = TrenchPose(given.machine, timestep=0.004)
    rng = np.random.default_rng(given.seed)
    shape = (len(env.levers), TOLD + 1)
    mean, spread = np.zeros(shape), np.full(shape, SPREAD)
    curve, begun, steps = [], time.perf_counter(), 0
    for generation in range(given.generations):
        drawn = mean + spread * rng.standard_normal((POLICIES, *shape))
        goals = [1000 * generation + number for number in range(GOALS)]
        scores = np.array([np.mean([play(env, policy, goal)[0] for goal in goals]) for policy in drawn])
        best = drawn[np.argsort(-scores)[:ELITE]]
        mean, spread = best.mean(axis=0), np.maximum(best.std(axis=0), LEAST)
        # Goals that no policy was chosen by.
        tried = [play(env, mean, 10**6 + number) for number in range(TRIED)]
        reward, apart, done = (float(np.mean(column)) for column in zip(*tried, strict=True))
        steps += (POLICIES * GOALS + TRIED) * round(env.seconds / env.dt)
        seconds = time.perf_counter() - begun
        curve.append({"generation": generation + 1, "reward": reward, "apart_m": apart, "there": done})
        print(f"{generation + 1:3d}  {seconds:5.0f} s  reward {reward:8.1f}  ends {apart:.2f} m off, {done:.0%} there")
        if given.out:
            told = {"machine": given.machine.stem, "seed": given.seed, "curve": curve, "policy": mean.tolist()}
            given.out.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    print(f"{steps / (time.perf_counter() - begun):.0f} steps/s")


if __name__ == "__main__":
    main()
