"""`report.html`: one self-contained page that opens from disk with no network."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from typing import Any

import numpy as np

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.poses import PoseTables
from yellowiron.model.specification import SheetPage
from yellowiron.report.document import within_tolerance
from yellowiron.report.html.drawing import Picture, draw
from yellowiron.report.html.joints import joint_marks, joint_rows
from yellowiron.report.html.marks import overlay
from yellowiron.report.html.pictures import Camera, look_at, machine_triangles, outline
from yellowiron.report.html.sensors import sensor_marks, sensor_rows, view_svg, views
from yellowiron.report.html.sheets import pieces, sheet_pages
from yellowiron.report.html.simulation import engine_name, in_a_sentence, simulation_tables
from yellowiron.report.html.sweeps import Sweeps, sweep_entries, sweep_pictures
from yellowiron.report.html.viewer import NOT_BUNDLED, script, viewer
from yellowiron.report.open_points import causes, named, tally
from yellowiron.report.rows import in_rows
from yellowiron.report.words import breakable, counted, sentence, shown, signed

Poses = Mapping[str, Mapping[str, Floats]]
"""Caption → body → (4, 4) displacement from the drawn pose, machine frame."""
SIZE = (1120, 600)
"""Pixels of a picture of the whole machine."""
REASONS = 8
"""What is left to a person that stands open; the rest unfolds."""


def page(
    document: Mapping[str, Any],
    mechanism: Mechanism,
    assembly: Assembly,
    alignment: Alignment,
    *,
    poses: Poses | None = None,
    tables: Callable[[], PoseTables] | None = None,
    sweeps: Sweeps | None = None,
    sheets: Callable[[], Sequence[SheetPage]] = tuple,
) -> str:
    """The page as text; with `tables`, asked while pictures are drawn, it has a 3D view to move the machine in, with
    `sweeps` what engines did with it, with `sheets`, asked last, the pages of which values were read. Deterministic:
    no time, no path of this machine."""
    import jinja2

    environment = jinja2.Environment(autoescape=True, trim_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters |= {
        "sentence": sentence,
        "breakable": breakable,
        "counted": counted,
        "engine_name": engine_name,
        "named": named,
    }
    folder = resources.files("yellowiron.report").joinpath("data")
    source, style = (folder.joinpath(name).read_text(encoding="utf-8") for name in ("page.html.j2", "page.css"))
    frame = np.asarray(alignment.frame, dtype=np.float64)
    drawn = machine_triangles(mechanism, assembly, frame)
    reasons = causes(document)
    joints = joint_rows(document)
    seen = _cameras(document, mechanism)
    bundled = script("yellowiron.report", "viewer") != ""
    made: dict[str, Any] = {}

    def meanwhile() -> None:
        made["template"] = environment.from_string(source)
        made["viewer"] = viewer(mechanism, assembly, alignment, tables(), poses=poses) if tables and bundled else None

    pictures = draw(drawn, {
        "machine": Picture(seen.machine),
        "joints": Picture(seen.joints, colors=drawn.by_body(mechanism)),
        **({"sensors": Picture(seen.sensors)} if document["sensors"] else {}),
        **{f"pose {caption}": _pose(mechanism, moved) for caption, moved in (poses or {}).items()},
        **sweep_pictures(sweeps or {}, mechanism),
    }, meanwhile=meanwhile)  # fmt: skip
    seen_pages = sheets()
    found = [s for s in document["specifications"] if s["status"] != "missing"]
    values = [_specification(s, joints, pieces(seen_pages, s)) for s in found]
    rows = {s["name"]: f"value-{n}" for n, s in enumerate(found, start=1)}
    text: str = made["template"].render(
        d=document,
        style=style,
        reasons=reasons[:REASONS],
        more_reasons=reasons[REASONS:],
        tally=tally(document),
        ready=_ready(document),
        driven=in_a_sentence(document["simulation"]),
        figures=_figures(document),
        machine=pictures["machine"],
        poses=[(caption, pictures[f"pose {caption}"]) for caption in (poses or {})],
        viewer=made["viewer"],
        unbundled=NOT_BUNDLED if tables and not bundled else "",
        measurements=[_measurement(m) for m in document["measurements"]],
        simulation=simulation_tables(document["simulation"]),
        sweeps=sweep_entries(sweeps or {}, document, pictures),
        sensors=sensor_rows(document),
        sensor_svg=_sensor_svg(document, mechanism, seen.sensors, pictures["sensors"]) if document["sensors"] else "",
        joints=[{**j, "values": [(v, rows[v]) for v in j["values"] if v in rows]} for j in joints],
        joint_svg=overlay(seen.joints, pictures["joints"], joint_marks(joints), alt="Joints on the machine"),
        cylinders=[_cylinder(c) for c in document["cylinders"]],
        specifications=values,
        sheets=sheet_pages(seen_pages, values),
        not_given=[s for s in document["specifications"] if s["status"] == "missing"],
        bodies=_bodies(document, alignment),
    )
    return text


@dataclass(frozen=True, eq=False)
class _Cameras:
    machine: Camera
    joints: Camera
    sensors: Camera


def _cameras(document: Mapping[str, Any], mechanism: Mechanism) -> _Cameras:
    """Where a page's pictures of the whole machine are taken from."""
    corners = outline(mechanism)
    width, height = SIZE
    looked_at = np.concatenate([corners, *(points for _, points in _views(document, mechanism))])
    return _Cameras(
        look_at(corners, azimuth=-0.75, elevation=0.3, width=width, height=height),
        look_at(corners, azimuth=-math.pi / 2 + 0.12, elevation=0.18, width=width, height=height),
        look_at(looked_at, azimuth=-0.95, elevation=0.42, width=width, height=height),
    )


def _pose(mechanism: Mechanism, moved: Mapping[str, Floats]) -> Picture:
    return Picture(look_at(outline(mechanism, moved), azimuth=-1.1, elevation=0.2, width=480, height=360), moved)


def _views(document: Mapping[str, Any], mechanism: Mechanism) -> list[tuple[str, Floats]]:
    """What the sensors see, as outlines."""
    corners = outline(mechanism)
    size = float(np.linalg.norm(np.ptp(corners, axis=0))) if len(corners) else 1.0
    return views(document["sensors"], size)


def _sensor_svg(document: Mapping[str, Any], mechanism: Mechanism, camera: Camera, picture: str) -> Any:
    under = view_svg(_views(document, mechanism), camera)
    return overlay(camera, picture, sensor_marks(document), alt="Sensors on the machine", under=under)


def _ready(document: Mapping[str, Any]) -> str:
    """What there is to say of a machine that leaves nothing to do."""
    parts = document["alignment"]
    left = parts["parts"] - parts["assigned"]
    words = ["every part has its body" if not left else f"every role has its part ({counted(left, 'part')} left out)"]
    words.append("every joint its pin")
    if _held(document):
        words.append("every published value that can be measured holds")
    return ", ".join(words[:-1]) + " and " + words[-1]


def _held(document: Mapping[str, Any]) -> list[bool]:
    """Of every published value that could be measured, whether it holds."""
    checked = [within_tolerance(Measurement(**m)) for m in document["measurements"] if m["role"] == "checked"]
    return [held for held in checked if held is not None]


def _figures(document: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Ten figures that say what was built."""
    counts, mobility, alignment = document["counts"], document["mobility"], document["alignment"]
    held = _held(document)
    pivots = counts["revolute"] + counts["spherical"]
    mass = sum(b["mass"] for b in document["bodies"])
    runs = document["simulation"].values()
    worst = max((run["pin_error_mm"] for run in runs), default=None)
    return [
        (f"{alignment['assigned']} / {alignment['parts']}", "parts have a body"),
        (str(len(alignment["to_review"])), "to review"),
        (f"{sum(held)} / {len(held)}" if held else "–", "published values met"),
        (f"{mobility['computed']} / {mobility['expected']}" if mobility else "–", "mobility, found / expected"),
        ("not run" if worst is None else f"{worst:.3f} mm", "worst pin when driven"),
        (str(counts["bodies"]), "bodies"),
        (f"{pivots} + {counts['prismatic']}", "pivots + slides"),
        (f"{counts['linear_drives']} + {counts['angular_drives']}", "linear + angular drives"),
        (str(counts["loops"]), "closed loops"),
        (f"{mass / 1000:.2f} t", "mass"),
    ]


def _measurement(entry: Mapping[str, Any]) -> dict[str, Any]:
    held = within_tolerance(Measurement(**entry))
    error = ""
    if entry["spec"] is not None and entry["model"] is not None:
        gap = entry["model"] - entry["spec"]
        error = signed(math.degrees(gap), 3, "°") if entry["unit"] == "rad" else signed(entry["error_percent"], 3, " %")
    return {
        **entry,
        "spec_text": shown(entry["spec"], entry["unit"]),
        "model_text": shown(entry["model"], entry["unit"], digits=6),
        "error_text": error,
        "mark": {True: "ok", False: "error", None: "info"}[held],
    }


def _cylinder(entry: Mapping[str, Any]) -> dict[str, Any]:
    lengths = [("bore", "bore"), ("rod", "rod_diameter"), ("stroke", "stroke"), ("closed", "closed_length"),
               ("drawn out", "extension")]  # fmt: skip
    cells = [(label, shown(entry[key], "m")) for label, key in lengths]
    cells += [(label, shown(entry[f"{label}_force"], "N", digits=4)) for label in ("push", "pull")]
    return {
        **entry,
        "cells": [*cells, ("speed", f"{entry['speed']:.3g} m/s")],
        "sources_text": "; ".join(f"{key.replace('_', ' ')}: {value}" for key, value in entry["sources"].items()),
    }


def _specification(
    entry: Mapping[str, Any], joints: Sequence[Mapping[str, Any]], shown_pieces: Sequence[Mapping[str, Any]]
) -> dict[str, Any]:
    candidates = entry["candidates"] if entry["status"] in ("conflict", "review") else []
    return {
        **entry,
        "value_text": shown(entry["value"], entry["unit"]),
        "pieces": shown_pieces,
        "limits": list({j["lever"]: j["name"] for j in joints if entry["name"] in j["values"]}.items()),
        "candidates_text": [
            f"{shown(c['value'], c['unit'])} {c['configuration']} (page {c['page']}: “{c['quote']}”)"
            for c in candidates
        ],
    }


def _bodies(document: Mapping[str, Any], alignment: Alignment) -> list[dict[str, Any]]:
    """One entry a body or counted row of bodies, and one for what is left out."""
    review = set(alignment.to_review)
    masses = {b["name"]: b["mass"] for b in document["bodies"]}
    touch = {b["name"]: b["colliders"].get("full", 0) for b in document["bodies"]}
    names = list(masses)
    parts: dict[str | None, list[PartAssignment]] = {}
    for each in alignment.parts:
        parts.setdefault(each.body if each.body in masses else None, []).append(each)
    rows = []
    for row, places in in_rows(names).items():
        members = [names[place] for place in places]
        figures = [shown(sum(masses[m] for m in members), "kg", digits=4)]
        figures.append(counted(sum(touch[m] for m in members), "collider"))
        mine = [p for m in members for p in parts.get(m, ())]
        rows.append(_body(row, mine, review, figures=figures, count=len(members)))
    if None in parts:
        rows.append(_body("left out of the machine", parts[None], review))
    return rows


def _body(
    name: str, parts: Sequence[PartAssignment], review: set[str], *, figures: Sequence[str] = (), count: int = 1
) -> dict[str, Any]:
    words = [counted(count, "body", "bodies")] if count > 1 else []
    words += [counted(len(parts), "part"), *figures]
    doubtful = [part for part in parts if part.part in review]
    sure = [part for part in parts if part.part not in review]
    return {"name": name, "doubtful": doubtful, "sure": sure, "words": ", ".join(words)}
