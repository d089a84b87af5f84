"""Draws docs/learning.svg from examples/learning/trench_pose.json, which `examples/learning/trench_pose.py` wrote.

`python docs/picture_learning.py`
"""

from __future__ import annotations

import json
from pathlib import Path

import matplotlib as mpl

mpl.use("Agg")
mpl.rcParams["svg.hashsalt"] = "learning"

import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
CURVE = ROOT / "examples" / "learning" / "trench_pose.json"


def main() -> None:
    """Two lines over the generations: metres from the goal at an episode's end, and its reward."""
    curve = json.loads(CURVE.read_text(encoding="utf-8"))["curve"]
    generations = [row["generation"] for row in curve]
    figure, left = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
    left.plot(generations, [row["apart_m"] for row in curve], color="#b8860b", label="tip from its goal, m (left)")
    left.set(xlabel="generation", ylim=(0.0, None))
    right = left.twinx()
    right.plot(generations, [row["reward"] for row in curve], color="#35607f", label="reward of an episode (right)")
    (one, said), (other, more) = left.get_legend_handles_labels(), right.get_legend_handles_labels()
    figure.legend([*one, *other], [*said, *more], loc="outside upper center", ncols=2)
    figure.savefig(ROOT / "docs" / "learning.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
