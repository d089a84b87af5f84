"""The template library: what is known of an equipment type before any CAD model is seen.

In: the name of a type, or a folder of JSON documents; out: a `Template` (`load_template`), which every stage asks.
Besides: modules (`modules`), of which types are put together, and templates of a few lines (`compose_template`); its
lint (`LintReport`), what the user's own documents change in it (`Documents`), a template proposed for a
machine that has none (`propose`), a copy to edit, its joints with numbers filled in, and the tree that people see.

`notation` is how documents are written, `type_folders` where they are, `composing` what they come to with the modules
and types that they name, `parsing` what each says; `load` makes of them a template. On these stand `user_documents`
(`--data`), `linting`, `proposal`, `copying`, `filled` and `show`, none of which knows another. `data` has a folder for
each type, `modules`, and `common.json`, what types ask a sheet for alike; `schema` the JSON Schema of every document. A
type is a folder: none is named in code.
"""

from yellowiron.library.composing.documents import uses_of
from yellowiron.library.composing.modules import modules
from yellowiron.library.composing.new import compose_template
from yellowiron.library.copying import copy_template
from yellowiron.library.filled import filled_joints
from yellowiron.library.linting.lint import LintReport, lint
from yellowiron.library.load import load_template
from yellowiron.library.notation.validated_json import template_schema
from yellowiron.library.proposal.likeness import Likeness, likeness
from yellowiron.library.proposal.propose import propose
from yellowiron.library.show import tree
from yellowiron.library.type_folders import is_sheet_only, list_templates, own_template
from yellowiron.library.user_documents import (
    Documents,
    apply_joints,
    apply_sensors,
    check_documents,
    load_documents,
    with_axes,
    with_relations,
)

__all__ = [
    "Documents",
    "Likeness",
    "LintReport",
    "apply_joints",
    "apply_sensors",
    "check_documents",
    "compose_template",
    "copy_template",
    "filled_joints",
    "is_sheet_only",
    "likeness",
    "lint",
    "list_templates",
    "load_documents",
    "load_template",
    "modules",
    "own_template",
    "propose",
    "template_schema",
    "tree",
    "uses_of",
    "with_axes",
    "with_relations",
]
