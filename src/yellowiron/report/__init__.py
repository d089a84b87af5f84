"""The report: what a build's stages gave (`BuildFacts`) → `report.json`, `report.html` and the command line's tables.

In the order in which they build on each other: `words` and `rows` (how values, names and counted rows are worded),
`document` (the report as one document; what fell short), `open_points` (that again, one line a
cause), `comparison` (two builds), `console` (tables for a terminal), `html` (the page).
"""

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.report.comparison import Difference, differences
    from yellowiron.report.console import (
        alignment_table,
        build_summary,
        difference_table,
        finding_table,
        lint_table,
        measurement_table,
        proposal_table,
        rate_table,
        simulation_table,
        specification_table,
    )
    from yellowiron.report.document import (
        BuildFacts,
        alignment_entry,
        fell_short,
        missing_limits,
        report_document,
        specification_entry,
        within_tolerance,
        write_document,
    )
    from yellowiron.report.html.page import page
    from yellowiron.report.open_points import Cause, causes, tally

__all__ = [
    "BuildFacts",
    "Cause",
    "Difference",
    "alignment_entry",
    "alignment_table",
    "build_summary",
    "causes",
    "difference_table",
    "differences",
    "fell_short",
    "finding_table",
    "lint_table",
    "measurement_table",
    "missing_limits",
    "page",
    "proposal_table",
    "rate_table",
    "report_document",
    "simulation_table",
    "specification_entry",
    "specification_table",
    "tally",
    "within_tolerance",
    "write_document",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "BuildFacts": "document",
        "Cause": "open_points",
        "Difference": "comparison",
        "alignment_entry": "document",
        "alignment_table": "console",
        "build_summary": "console",
        "causes": "open_points",
        "difference_table": "console",
        "differences": "comparison",
        "fell_short": "document",
        "finding_table": "console",
        "lint_table": "console",
        "measurement_table": "console",
        "missing_limits": "document",
        "page": "html.page",
        "proposal_table": "console",
        "rate_table": "console",
        "report_document": "document",
        "simulation_table": "console",
        "specification_entry": "document",
        "specification_table": "console",
        "tally": "open_points",
        "within_tolerance": "document",
        "write_document": "document",
    },
)
