"""The report: `report.json`, `report.html`, the tables of the command line and their pictures."""

from yellowiron.report.console import (
    alignment_table,
    build_summary,
    finding_table,
    lint_table,
    measurement_table,
    proposal_table,
    simulation_table,
    specification_table,
)
from yellowiron.report.document import (
    alignment_entry,
    fell_short,
    missing_limits,
    report_document,
    specification_entry,
    within_tolerance,
    write_document,
)
from yellowiron.report.html.page import page

__all__ = [
    "alignment_entry",
    "alignment_table",
    "build_summary",
    "fell_short",
    "finding_table",
    "lint_table",
    "measurement_table",
    "missing_limits",
    "page",
    "proposal_table",
    "report_document",
    "simulation_table",
    "specification_entry",
    "specification_table",
    "within_tolerance",
    "write_document",
]
