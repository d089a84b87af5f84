"""The package: cheap to import, complete in what it names, every finding documented."""

from __future__ import annotations

import re
import subprocess
import sys

import pytest

from yellowiron import kinematics


def test_importing_it_loads_no_engine(root):
    code = "import sys, yellowiron.kinematics; print('mujoco' in sys.modules or 'scipy' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env={"PYTHONPATH": str(root / "src")}
    )
    assert done.stdout.strip() == "False"


def test_every_name_is_there():
    for name in kinematics.__all__:
        assert callable(getattr(kinematics, name))
    with pytest.raises(AttributeError, match="no attribute 'flux'"):
        kinematics.flux  # noqa: B018


def test_every_finding_is_documented(root):
    folder = root / "src" / "yellowiron" / "kinematics"
    used = {
        code for path in sorted(folder.rglob("*.py")) for code in re.findall(r'"(KIN\d+)"', path.read_text("utf-8"))
    }
    assert used and all(f"\n{code}  " in str(kinematics.__doc__) for code in used)
