"""`isaaclab_cfg.py`: the layers of variants for Isaac Lab's spawner of many assets."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from yellowiron.exporters import export
from yellowiron.model.mechanism import Mechanism

FILE = "isaaclab_cfg.py"
_TEXT = '''"""Variants of {machine} in Isaac Lab: one layer an environment, in turn.

    from isaaclab_cfg import articulation
    robot = articulation()

Give the scene `replicate_physics=False`: variants differ. Names, bodies, joints and their order are the same in all.
"""

from pathlib import Path

import isaaclab.sim as sim_utils
from {module} import *  # noqa: F403 - its tables hold for every variant but LIMITS and RATED, which are the base's
from {module} import PRIM_PATH
from {module} import articulation as one

FOLDER = Path(__file__).resolve().parent
LAYERS = [
{layers}
]
"""Variants, in the order of variants.csv."""


def articulation(prim_path: str = PRIM_PATH, base: str = "floating", random_choice: bool = False):
    """The machine in its variants, as an ArticulationCfg. `random_choice`: drawn for each environment, else in turn."""
    made = one("", prim_path, base)
    made.spawn = sim_utils.MultiUsdFileCfg(
        usd_path=[str(FOLDER / layer) for layer in LAYERS],
        random_choice=random_choice,
        variants={{"Base": base, "Physics": "on"}},
        activate_contact_sensors=True,
    )
    return made
'''


def write_isaaclab(mechanism: Mechanism, file: Path, layers: Sequence[str], folder: Path) -> None:
    """Writes the base's configuration, and beside it the list of layers."""
    module = export(mechanism, file, folder, to="isaaclab").stem
    listed = "\n".join(f'    "{layer}",' for layer in layers)
    text = _TEXT.format(machine=mechanism.name, module=module, layers=listed)
    (folder / FILE).write_text(text, encoding="utf-8")
