"""What a proposal says in words, `proposal.md`: bodies, joints, and what to look at."""

from __future__ import annotations

import re

from yellowiron.library.proposal.draft import Draft

_SHOWN = 5
"""Parts of a body that its row in the table names; a longer list stands below, whole."""


def described(draft: Draft, name: str) -> str:
    """The draft as Markdown; `name` is the equipment type's."""
    machine = draft.machine
    lines = [
        f"# {name}: proposed from a CAD model",
        "",
        "## Bodies",
        "",
        "| role | kind | parts | why | name |",
        "|---|---|---|---|---|",
    ]
    for k, body in enumerate(machine.bodies):
        parts = "<br>".join(_cell(p) for p in body.parts[:_SHOWN])
        if len(body.parts) > _SHOWN:
            parts += f"<br>and {len(body.parts) - _SHOWN} more, listed under [Parts](#parts)"
        lines.append(
            f"| `{draft.names[k]}` | {body.kind} | {parts} | {_cell(body.reason)} | {_cell(draft.reasons[k])} |"
        )
    lines += ["", "## Joints", "", "| joint | type | found by | point (CAD, m) | direction |", "|---|---|---|---|---|"]
    for k, joint in enumerate(machine.joints):
        place = [", ".join(f"{v + 0.0:.4f}" for v in vector) for vector in (joint.point, joint.direction)]
        place = ["", ""] if joint.type == "fixed" else place
        lines.append(f"| `{draft.joint_names[k]}` | {joint.type} | {_cell(joint.reason)} | {place[0]} | {place[1]} |")
    if machine.findings:
        lines += ["", "## To look at", ""]
        lines += [f"- {f.code} ({_cell(f.where)}): {f.message} {f.hint}" for f in machine.findings]
    long = [k for k, body in enumerate(machine.bodies) if len(body.parts) > _SHOWN]
    lines += ["", "## Parts"] if long else []
    for k in long:
        lines += ["", f"### `{draft.names[k]}`", "", *(f"- {_cell(p)}" for p in machine.bodies[k].parts)]
    return "\n".join(lines) + "\n"


def _cell(text: str) -> str:
    return re.sub(r"([|`<])", r"\\\1", text)
