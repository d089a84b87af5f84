"""The template library: templates from JSON, their lint, the user's own documents, and what is shown of them."""

from yellowiron.library.load import list_templates, load_template
from yellowiron.library.reading import template_schema

__all__ = ["list_templates", "load_template", "template_schema"]
