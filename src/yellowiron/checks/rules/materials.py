"""Physics materials: friction and restitution that nature has."""

from __future__ import annotations

from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.view import View


@rule(
    "CHK110",
    "error",
    "Friction is 0 or more, restitution 0 to 1.",
)
def impossible(view: View) -> Remarks:
    """A friction or restitution is impossible."""
    for material in view.materials:
        for name, value in (("static", material.static_friction), ("dynamic", material.dynamic_friction)):
            if value is not None and value < 0.0:
                yield material.path, f"Its {name} friction is {value:g}."
        if material.restitution is not None and not 0.0 <= material.restitution <= 1.0:
            yield material.path, f"Its restitution is {material.restitution:g}."


@rule(
    "CHK111",
    "warning",
    "Static friction is at least the dynamic one.",
)
def inverted(view: View) -> Remarks:
    """Sliding friction exceeds static friction."""
    for material in view.materials:
        static, dynamic = material.static_friction, material.dynamic_friction
        if static is not None and dynamic is not None and dynamic > static * (1.0 + 1e-6):
            yield material.path, f"Dynamic {dynamic:g}, static {static:g}."


@rule(
    "CHK112",
    "warning",
    "Correct material:binding:physics, or leave it out.",
)
def missing(view: View) -> Remarks:
    """A collider's physics material is missing."""
    for collider in view.colliders:
        if collider.material_missing:
            yield collider.path, "material:binding:physics leads nowhere."
