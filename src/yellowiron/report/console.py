"""The tables the command line prints."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.mechanism import Measurement
from yellowiron.report.comparison import Difference
from yellowiron.report.document import within_tolerance
from yellowiron.report.open_points import causes, tally
from yellowiron.report.words import counted, shown
from yellowiron.support.text import display

_STATUS = {"ok": "green", "review": "yellow", "conflict": "red", "missing": "dim", "unreadable": "red"}
_SEVERITY = {"error": "red", "warning": "yellow", "info": "dim"}


def difference_table(differences: Sequence[Difference]) -> RenderableType:
    """What differs between two builds, or that nothing does."""
    if not differences:
        return Text("The builds are the same.", "bold green")
    table = _table("What", "Name", "Before", "After", right=())
    table.columns[0].no_wrap = True
    for one in differences:
        table.add_row(one.kind, one.name, Text(one.before or "–", "dim"), one.after or "–")
    counts = Counter(one.kind for one in differences)
    words = ", ".join(f"{counted(number, kind)}" for kind, number in counts.items())
    return Group(table, "", Text(f"{words} differ.", "bold"))


def specification_table(
    entries: Sequence[Mapping[str, Any]],
    *,
    missing: Sequence[Mapping[str, str]] = (),
    findings: Sequence[Mapping[str, Any]] = (),
) -> RenderableType:
    """What the sheets say: name, value, status, page and quote, with the reason under what a person has to look at;
    what is `missing` (`specs.missing_values`), and how to give it; the `findings` of the reading; how many of each."""
    told = {one["name"] for one in missing}
    files = {entry["file"] for entry in entries if entry["file"]}
    table = _table("Specification", "Value", "Status", "Page", "Quote", right=("Value",))
    for column in table.columns[:4]:
        column.no_wrap = True
    table.columns[0].overflow = "fold"
    table.columns[0].no_wrap = False
    for entry in entries:
        if entry["name"] in told:
            continue
        # An ellipsis in cells of the terminal: a Chinese character takes two of them.
        note = Text(_quote(entry), overflow="ellipsis", no_wrap=True, style="dim")
        page = "" if entry["page"] is None else str(entry["page"])
        table.add_row(
            entry["name"],
            shown(entry["value"], entry["unit"]),
            Text(entry["status"], style=_STATUS[entry["status"]]),
            f"{entry['file']} {page}" if len(files) > 1 and page else page,
            note,
        )
    blocks: list[RenderableType] = [table] if table.row_count else []
    blocks += [t for t in (_to_look_at(entries, told), _still_missing(missing)) if t is not None]
    if findings:
        blocks += ["", finding_table(findings)]
    counts = Counter(entry["status"] for entry in entries)
    summary = ", ".join(f"{counts[status]} {status}" for status in _STATUS if counts[status])
    return Group(*blocks, "", Text(f"{len(entries)} values asked for: {summary}.", "bold"))


def _quote(entry: Mapping[str, Any]) -> str:
    if not entry["quote"]:
        return str(entry["reason"])
    return f"“{entry['quote']}”" + ("  (example value)" if entry["example"] else "")


def _to_look_at(entries: Sequence[Mapping[str, Any]], told: set[str]) -> RenderableType | None:
    """Why a person has to look at some values, and the candidates of a conflict."""
    table = _table("", "", right=())
    table.show_header = False
    for entry in entries:
        if entry["status"] not in ("review", "conflict") or entry["name"] in told:
            continue
        words = Text(entry["reason"], "dim")
        for candidate in entry["candidates"] if entry["status"] == "conflict" else ():
            value, place = shown(candidate["value"], candidate["unit"]), f"page {candidate['page']}"
            words.append(f"\n{value}  {place}  {candidate['configuration']}".rstrip())
        table.add_row(Text(entry["name"], _STATUS[entry["status"]]), words)
    return Group("", Text("To look at", "bold"), table) if table.row_count else None


def _still_missing(missing: Sequence[Mapping[str, str]]) -> RenderableType | None:
    """What no sheet says: two lines each. A type that cannot be built takes no value by hand."""
    given = ", and how to give it" if any(one["set"] for one in missing) else ""
    table = _table("Not on the sheet", f"Where makers print it{given}", right=())
    table.columns[0].max_width = 40
    for one in missing:
        name = Text.assemble(one["name"], "\n", (f"  {one['what']}", "dim"))
        by_hand = ("\n", (f"--set {one['set']}", "cyan")) if one["set"] else ()
        table.add_row(name, Text.assemble(one["where"], *by_hand))
    return Group("", table) if missing else None


def measurement_table(entries: Sequence[Mapping[str, Any]]) -> Table:
    """Measurements: what the sheet says, what the model gives."""
    table = _table("Measurement", "Sheet", "Model", "Error", "", right=("Sheet", "Model", "Error"))
    for entry in entries:
        held = within_tolerance(Measurement(**entry))
        mark = {True: Text("✓", "green"), False: Text("✗", "red"), None: Text("")}[held]
        if entry["role"] != "checked" and held is not None:
            mark = mark + Text(f" {entry['role']} value", "dim")
        if entry["reason"]:
            mark = Text(entry["reason"], "dim")
        table.add_row(
            entry["name"],
            display(entry["spec"], entry["unit"]),
            display(entry["model"], entry["unit"], digits=6),
            _error(entry),
            mark,
        )
    return table


def finding_table(entries: Iterable[Mapping[str, Any]]) -> Table:
    """Findings: code, where, what, and what to do."""
    table = _table("Code", "Where", "Finding", right=())
    for entry in entries:
        text = Text(entry["message"], style=_SEVERITY[entry["severity"]])
        if entry["hint"]:
            text.append(f" {entry['hint']}", style="dim")
        table.add_row(entry["code"], entry["where"], text)
    return table


def alignment_table(alignment: Alignment) -> RenderableType:
    """Bodies with their parts counted; then what to review, the most doubtful first, and why; the roles that no part
    plays; the findings that say more."""
    table = _table("Body", "Parts", "Confidence", "Pins", right=("Parts", "Confidence"))
    for body in dict.fromkeys(a.body for a in alignment.parts):
        parts = [a for a in alignment.parts if a.body == body]
        roles = dict.fromkeys(a.role for a in parts if a.role not in (None, body))
        lowest = min(a.confidence for a in parts)
        table.add_row(body or "–", str(len(parts)), f"≥ {lowest:.2f}", ", ".join(str(r) for r in roles))
    unplayed, told = set(alignment.missing), set(alignment.missing) | set(alignment.to_review)
    blocks: list[RenderableType] = [table]
    doubtful = [item for item in alignment.to_review if item not in unplayed]
    if doubtful:
        blocks += ["", Text("To review", "bold yellow"), _review_table(alignment, doubtful)]
    if alignment.missing:
        blocks += ["", Text("No part plays", "bold yellow"), Text(", ".join(alignment.missing))]
    findings = [asdict(f) for f in alignment.findings if f.severity != "info" and f.where not in told]
    if findings:
        blocks += ["", finding_table(findings)]
    return Group(*blocks)


def _review_table(alignment: Alignment, doubtful: Sequence[str]) -> Table:
    """Parts and roles that a person should look at: a role stands with the reason of its least certain part."""
    table = _table("Part or role", "As", "Or", "Confidence", "Why", right=("Confidence",))
    least: dict[str, PartAssignment] = {}
    for one in sorted(alignment.parts, key=lambda a: -a.confidence):
        least |= {item: one for item in (one.part, one.role, one.body) if item}
    for item in sorted(doubtful, key=lambda item: (least[item].confidence if item in least else 0.0, item)):
        worst = least.get(item)
        if worst is None:
            table.add_row(item, "", "", "", "")
        else:
            role = (worst.role or worst.body or "–") if item == worst.part else ""
            table.add_row(item, role, worst.runner_up or "", f"{worst.confidence:.2f}", Text(worst.why, "dim"))
    return table


def simulation_table(document: Mapping[str, Any]) -> RenderableType:
    """What a machine did in an engine: strokes, driving and tests, as far as they ran, and what fell short."""
    blocks: list[RenderableType] = []
    if "actuators" in document:
        blocks += [*_strokes(document), ""]
    if "driving" in document:
        blocks += [Text("Driving", "bold"), _driving_table(document), ""]
    if "tests" in document:
        blocks += [Text("Tests", "bold"), _test_table(document["tests"]), ""]
    if document["findings"]:
        blocks += [finding_table(document["findings"]), ""]
    return Group(*blocks[:-1])


def rate_table(document: Mapping[str, Any]) -> RenderableType:
    """How far a machine's pins come apart at several rates, with what a build writes and with an engine's defaults."""
    load = f", payload {document['payload_kg']:g} kg" if document["payload_kg"] else ""
    numbers = ("Hz", "Pins apart, mm", "Pins off, mm", "Steps/s")
    table = _table("Settings", *numbers, "Worst", right=numbers)
    for row in document["rates"]:
        shown = [_millimetres(row[key]) for key in ("loop_gap_mm", "pin_error_mm")]
        speed = "" if row["steps_per_second"] is None else str(row["steps_per_second"])
        worst = row["reason"] or row["pin_error_at"]
        table.add_row(_SETTINGS[row["settings"]], f"{row['hz']:g}", *shown, speed, worst)
    return Group(Text(f"{document['engine']}{load}", "bold"), "", table)


_SETTINGS = {"file": "the build's", "engine": "the engine's own"}


def _millimetres(value: float | None) -> str:
    return "" if value is None else f"{value:.3g}"


def _strokes(document: Mapping[str, Any]) -> list[RenderableType]:
    """How far the machine strayed from the kinematics, and what each actuator did."""
    head = Text.assemble(
        (f"{document['engine']} {document['version']}", "bold"),
        f"  {document['base']} base, {document['dt_s']:g} s steps, payload {document['payload_kg']:g} kg, "
        f"{document['steps_per_second']} steps/s",
    )
    worst = Text(
        f"pins within {document['pin_error_mm']:.3f} mm, bodies within {document['angle_error_deg']:.4f}°, "
        f"branches {'kept' if document['branches_kept'] else 'flipped'}"
    )
    table = _table("Actuator", "Moved, 2–98 %", "Of", "Final error", right=("Moved, 2–98 %", "Of", "Final error"))
    names = [entry["actuator"] for entry in document["actuators"]]
    for entry in document["actuators"]:
        moved = entry["reached_high"] - entry["reached_low"]
        table.add_row(
            f"{entry['actuator']}, {entry['joint']}" if names.count(entry["actuator"]) > 1 else entry["actuator"],
            display(moved, entry["unit"]) if entry["stroke"] else "",
            display(entry["stroke"], entry["unit"]) if entry["stroke"] else f"{entry['speed']:.3g} rad/s",
            f"{entry['final_error_percent']:.2f} %",
        )
    return [head, worst, "", table]


_DRIVING = (
    ("Forward", "forward_m", "distance_m", "m", 3),
    ("Back", "backward_m", "distance_m", "m", 3),
    ("Turning radius at full lock", "turning_radius_m", "geometry_radius_m", "m", 3),
    ("Way crabwise", "crab_deg", "crab_geometry_deg", "°", 1),
    ("Turn on the spot", "spin_deg", "spin_geometry_deg", "°", 1),
    ("Swing", "swing_deg", "swing_geometry_deg", "°", 1),
    ("Axle on the block", "axle_angle_deg", "axle_geometry_deg", "°", 2),
)
"""Row, keys of the figure and of what it should be, unit, digits after the point."""


def _driving_table(document: Mapping[str, Any]) -> RenderableType:
    driving = document["driving"]
    if driving is None:
        return Text(document["driving_reason"], "dim")
    table = _table("Figure", "Engine", "Geometry", "Error", right=("Engine", "Geometry", "Error"))
    for name, key, of, unit, digits in _DRIVING:
        value, wanted = driving[key], driving[of]
        if value is not None and wanted:
            shown = (f"{number:.{digits}f} {unit}" for number in (value, wanted))
            table.add_row(name, *shown, f"{100.0 * (value / wanted - 1.0):+.2f} %")
    if driving["highest_wheel_mm"] is not None:
        table.add_row("Highest wheel over its ground", f"{driving['highest_wheel_mm']:.1f} mm", "", "")
    return table


def _test_table(entries: Iterable[Mapping[str, Any]]) -> Table:
    """Tests: what the sheet says, what the engine and statics give."""
    table = _table("Test", "Sheet", "Engine", "Statics", "Error", "", right=("Sheet", "Engine", "Statics", "Error"))
    for entry in entries:
        mark = {True: Text("✓", "green"), False: Text("✗", "red"), None: Text("")}[entry["passed"]]
        if entry["role"] != "checked":
            mark = mark + Text(f" {entry['role']} value", "dim")
        unpublished = [i["name"] for i in entry["inputs"] if not i["published"]]
        notes = [
            entry["reason"],
            f"rig: {entry['rig']}",
            f"not published: {', '.join(unpublished)}" if unpublished else "",
        ]
        mark = mark + Text(f" {'; '.join(note for note in notes if note)}", "dim")
        unit = entry["unit"]
        shown = (
            "" if value is None else f"{100.0 * value:.0f} %" if unit == "1" else display(value, unit, digits=4)
            for value in (entry["spec"], entry["engine_value"], entry["statics_value"])
        )
        error = "" if entry["error_percent"] is None else f"{entry['error_percent']:+.1f} %"
        table.add_row(entry["name"], *shown, error, mark)
    return table


def lint_table(document: Mapping[str, Any]) -> RenderableType:
    """A template's counts, its mobility in every combination of choices, and what the lint found."""
    counts = ", ".join(f"{number} {name.replace('_', ' ')}" for name, number in document["counts"].items() if number)
    blocks: list[RenderableType] = [Text(counts)]
    for entry in document["mobility"]:
        choice = ", ".join(f"{name}={value}" for name, value in entry["choices"].items())
        held = entry["computed"] == entry["expected"]
        line = f"mobility {entry['computed']}, expected {entry['expected']}" + (f"  ({choice})" if choice else "")
        blocks.append(Text(line, "green" if held else "red"))
    blocks += ["", finding_table(document["findings"]) if document["findings"] else Text("Sound.", "bold green")]
    return Group(*blocks)


def proposal_table(document: Mapping[str, Any]) -> RenderableType:
    """What a proposed template has: its joints with what they were found by, and what to look at."""
    table = _table("joint", "type", "found by", right=())
    for joint in document["joints"]:
        table.add_row(joint["name"], joint["type"], joint["reason"])
    folder = document["folder"]
    blocks: list[RenderableType] = [table, ""]
    blocks += [finding_table(document["findings"]), ""] if document["findings"] else []
    words = f"{len(document['bodies'])} bodies"
    if folder is None:
        words += ". Nothing is written: name a folder with --out."
    else:
        words = f"{folder}: {words}; proposal.md says why. Build with it by naming the folder."
    return Group(*blocks, Text(words, "dim"))


def build_summary(document: Mapping[str, Any], reasons: Sequence[str], folder: str) -> RenderableType:
    """What a build ends with: the machine in a line, the measurements, what is left to a person, one line a
    cause."""
    counts, mobility, alignment = document["counts"], document["mobility"], document["alignment"]
    line = Text.assemble(
        (document["machine"], "bold"),
        f"  {alignment['assigned']} of {alignment['parts']} parts in {counts['bodies']} bodies, "
        f"{counts['revolute']} revolute and {counts['prismatic']} prismatic joints, {counts['loops']} loops, "
        f"mobility {mobility['computed']} of {mobility['expected']}"
        if mobility
        else "",
    )
    blocks: list[RenderableType] = [line, Text(document["verdict"]), "", measurement_table(document["measurements"])]
    if reasons:
        blocks += ["", Text(f"Built, and not ready: {tally(document)}.", "bold yellow")]
        for cause in causes(document):
            blocks.append(Text.assemble("  • ", (cause.severity, _SEVERITY[cause.severity]), f"  {cause.words}"))
            if cause.settings:
                blocks.append(Text.assemble("    paste: ", (cause.block, "cyan")))
    else:
        blocks += ["", Text("Ready: nothing left to do by hand.", "bold green")]
    blocks.append(Text(f"{folder}/scene.usda is the machine on the ground; {folder}/report.html says why.", "dim"))
    return Group(*blocks)


def _error(entry: Mapping[str, Any]) -> str:
    if entry["spec"] is None or entry["model"] is None:
        return ""
    gap = entry["model"] - entry["spec"]
    if entry["unit"] != "rad" and entry["error_percent"] is None:
        return display(gap, entry["unit"])
    value, unit = (gap * 57.29577951308232, "°") if entry["unit"] == "rad" else (entry["error_percent"], "%")
    return f"{round(value, 3) + 0.0:+.3f} {unit}"  # + 0.0: a zero has no minus


def _table(*columns: str, right: Sequence[str]) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold", show_edge=False)
    for column in columns:
        table.add_column(column, justify="right" if column in right else "left")
    return table
