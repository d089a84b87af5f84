"""The template library: templates from JSON, their lint, the user's own documents, and what is shown of them."""

from yellowiron.library.copying import copy_template
from yellowiron.library.filled import filled_joints
from yellowiron.library.linting.lint import LintReport, lint
from yellowiron.library.load import load_template
from yellowiron.library.notation.validated_json import template_schema
from yellowiron.library.proposal.likeness import Likeness, likeness
from yellowiron.library.proposal.propose import propose
from yellowiron.library.show import tree
from yellowiron.library.type_folders import is_sheet_only, list_templates
from yellowiron.library.user_documents import Documents, apply_joints, apply_sensors, load_documents, with_relations

__all__ = [
    "Documents",
    "Likeness",
    "LintReport",
    "apply_joints",
    "apply_sensors",
    "copy_template",
    "filled_joints",
    "is_sheet_only",
    "likeness",
    "lint",
    "list_templates",
    "load_documents",
    "load_template",
    "propose",
    "template_schema",
    "tree",
    "with_relations",
]
