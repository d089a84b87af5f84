"""An exporter as another package brings it: the joints as a table."""

from __future__ import annotations

import csv
from pathlib import Path

from yellowiron.exporters.registry import Exporter
from yellowiron.model.mechanism import Mechanism

EXPORTER = Exporter("a table of joints", "joint_table:write")


def write(mechanism: Mechanism, usd_file: str | Path, folder: Path) -> Path:
    path = folder / f"{mechanism.name}.csv"
    with path.open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["joint", "type", "lower", "upper"])
        rows.writerows([joint.name, joint.type, joint.lower, joint.upper] for joint in mechanism.joints)
    return path
