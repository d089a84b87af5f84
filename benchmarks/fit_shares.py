"""What share of the weight the bodies of a type usually have: `shares.json` of its template, from built machines.

    python benchmarks/fit_shares.py MACHINE.usda …

From the repository's root. Both sides of a body together; hidden wheels and the members of rows are of the body they
hang on. Of several machines of a type the means, each body's of those that have it.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src")]

from yellowiron.library import load_template  # noqa: E402
from yellowiron.model.mechanism import Mechanism  # noqa: E402
from yellowiron.model.template import without_side  # noqa: E402
from yellowiron.usd import read_mechanism  # noqa: E402


def measured(mechanism: Mechanism) -> dict[str, float]:
    """Body, without its side → percent of the machine's mass."""
    template = load_template(mechanism.equipment_type)
    rigid = {role.name for role in template.roles if role.rigid and not role.many and not role.hidden}
    whole = sum(body.mass for body in mechanism.bodies)
    shares: dict[str, float] = {}
    for body in mechanism.bodies:
        name = body.name
        if name not in rigid:
            row = template.role(template.row_of(name) or template.root)
            name = template.body_of(row.parent) if row.parent is not None else None
            name = name or template.root
        shares[without_side(name)] = shares.get(without_side(name), 0.0) + 100.0 * body.mass / whole
    return shares


def main() -> None:
    found: dict[str, list[dict[str, float]]] = {}
    for file in sys.argv[1:]:
        mechanism = read_mechanism(file)
        found.setdefault(mechanism.equipment_type, []).append(measured(mechanism))
    for kind, machines in found.items():
        names = dict.fromkeys(name for machine in machines for name in machine)
        means = {n: [m[n] for m in machines if n in m] for n in names}
        table = {n: float(f"{sum(own) / len(own):.2g}") for n, own in means.items()}
        path = ROOT / "src/yellowiron/library/data" / kind / "shares.json"
        lines = ",\n".join(f'  "{name}": {json.dumps(share)}' for name, share in table.items())
        path.write_text("{\n" + lines + "\n}\n", encoding="utf-8")
        sys.stdout.write(f"{kind}: {sum(table.values()):.1f} % of {len(machines)} machine(s)\n")


if __name__ == "__main__":
    main()
