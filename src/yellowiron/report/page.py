"""`report.html`: one self-contained page that opens from disk with no network."""

from __future__ import annotations

import base64
import math
from collections.abc import Mapping, Sequence
from html import escape
from importlib import resources
from typing import Any

import numpy as np
from PIL import Image

from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.poses import PoseTables
from yellowiron.model.text import display
from yellowiron.report.document import fell_short, within_tolerance
from yellowiron.report.pictures import Camera, encode, look_at, machine_soup, render
from yellowiron.report.viewer import viewer

Poses = Mapping[str, Mapping[str, Floats]]
"""Caption → body → (4, 4) displacement from the drawn pose, machine frame."""


def page(
    document: Mapping[str, Any],
    mechanism: Mechanism,
    assembly: Assembly,
    alignment: Alignment,
    *,
    poses: Poses | None = None,
    tables: PoseTables | None = None,
) -> str:
    """The page as text; with `tables` it has a 3D view to move the machine in. Deterministic: no time, no path of this
    machine."""
    import jinja2

    environment = jinja2.Environment(autoescape=True, trim_blocks=True, undefined=jinja2.StrictUndefined)
    source = resources.files("yellowiron.report").joinpath("data", "page.html.j2").read_text(encoding="utf-8")
    frame = np.asarray(alignment.frame, dtype=np.float64)
    soup = machine_soup(mechanism, assembly, frame)
    bodies = machine_soup(mechanism, assembly, frame, by_body=True)
    corners = soup.corners.reshape(-1, 3)
    side = look_at(corners, azimuth=-math.pi / 2 + 0.12, elevation=0.18, width=1120, height=600)
    strip = []
    for caption, displacement in (poses or {}).items():
        posed = machine_soup(mechanism, assembly, frame, poses=displacement)
        camera = look_at(posed.corners.reshape(-1, 3), azimuth=-1.1, elevation=0.2, width=480, height=360)
        strip.append((caption, _data_uri(render(posed, camera))))
    pictures = {
        "machine": _data_uri(render(soup, look_at(corners, azimuth=-0.75, elevation=0.3, width=1120, height=600))),
        "poses": strip,
    }
    return environment.from_string(source).render(
        d=document,
        reasons=fell_short(document),
        figures=_figures(document),
        pictures=pictures,
        viewer=viewer(mechanism, assembly, alignment, tables, poses=poses) if tables is not None else None,
        joint_svg=_joint_svg(document["joints"], side, _data_uri(render(bodies, side))),
        measurements=[_measurement(m) for m in document["measurements"]],
        joints=[_joint(j, _levers(document)) for j in document["joints"]],
        cylinders=[_cylinder(c) for c in document["cylinders"]],
        specifications=[_specification(s) for s in document["specifications"]],
        bodies=_bodies(document, alignment),
    )


def _figures(document: Mapping[str, Any]) -> list[tuple[str, str]]:
    counts, mobility, alignment = document["counts"], document["mobility"], document["alignment"]
    mass = sum(b["mass"] for b in document["bodies"])
    figures = [
        (f"{alignment['assigned']} / {alignment['parts']}", "parts with a body"),
        (str(len(alignment["to_review"])), "to review"),
        (str(counts["bodies"]), "bodies"),
        (f"{counts['revolute']} + {counts['prismatic']}", "revolute + prismatic joints"),
        (f"{counts['linear_drives']} + {counts['angular_drives']}", "linear + angular drives"),
        (str(counts["loops"]), "closed loops"),
        (f"{mass / 1000:.2f} t", "mass"),
    ]
    if mobility:
        figures.append((f"{mobility['computed']} / {mobility['expected']}", "mobility, computed / expected"))
    checked = [within_tolerance(Measurement(**m)) for m in document["measurements"] if m["role"] == "checked"]
    held = [h for h in checked if h is not None]
    figures.append((f"{sum(held)} / {len(held)}", "published values met"))
    return figures


def _measurement(entry: Mapping[str, Any]) -> dict[str, Any]:
    held = within_tolerance(Measurement(**entry))
    error = ""
    if entry["spec"] is not None and entry["model"] is not None:
        gap = entry["model"] - entry["spec"]
        error = f"{math.degrees(gap):+.3f} °" if entry["unit"] == "rad" else f"{entry['error_percent']:+.3f} %"
    return {
        **entry,
        "spec_text": display(entry["spec"], entry["unit"]),
        "model_text": display(entry["model"], entry["unit"], digits=6),
        "error_text": error,
        "mark": {True: "ok", False: "error", None: "info"}[held],
    }


def _levers(document: Mapping[str, Any]) -> dict[str, str]:
    """Joint → the actuator that moves it, by which people know it."""
    return {j["joint"]: a["name"] for a in document["actuators"] for j in a["joints"]}


def _joint(entry: Mapping[str, Any], levers: Mapping[str, str]) -> dict[str, Any]:
    unit = "m" if entry["type"] == "prismatic" else "rad"
    lower, upper = entry["lower"], entry["upper"]
    span = "free" if lower is None and upper is None else f"{display(lower, unit)} … {display(upper, unit)}"
    drive = entry["drive"]
    force_unit = "N" if entry["type"] == "prismatic" else "N*m"
    return {
        **entry,
        "range": "–" if entry["type"] == "fixed" else span,
        "drive_text": f"{drive['kind']}, {display(drive['max_force'], force_unit, digits=4)}" if drive else "",
        "source_text": _joint_source(entry["source"], levers),
    }


def _joint_source(source: Mapping[str, Any], levers: Mapping[str, str]) -> str:
    """The evidence of a joint as sentences: where its axis, its cut and its limits come from."""
    words = []
    if source.get("method"):
        # The tree path says where a part is filed; its own name is enough to know it by.
        names = dict.fromkeys(str(part).rsplit("/", 1)[-1].partition("#")[0] for part in source.get("parts", ()))
        words.append(f"{source['method']}: {_listed(list(names))}" if names else str(source["method"]))
    if "residual_mm" in source:
        words.append(f"residual {source['residual_mm']:.4f} mm, {source.get('residual_deg', 0.0):.4f}°")
    for end in ("lower", "upper"):
        if source.get(f"{end}_quote"):
            words.append(f"{end} limit from page {source[f'{end}_page']} “{source[f'{end}_quote']}”")
        elif source.get(f"{end}_specification"):
            words.append(f"{end} limit {source[f'{end}_specification']} from {source.get(f'{end}_source', 'nowhere')}")
    words += [f"{key}: {source[key]}" for key in ("cut", "limits") if source.get(key)]
    text = "; ".join(words)
    for joint, lever in levers.items():
        text = text.replace(joint, lever)
    return text


def _listed(names: Sequence[str], *, most: int = 4) -> str:
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def _cylinder(entry: Mapping[str, Any]) -> dict[str, Any]:
    lengths = [display(entry[key], "m") for key in ("bore", "rod_diameter", "stroke", "closed_length", "extension")]
    forces = [display(entry[key], "N", digits=4) for key in ("push_force", "pull_force")]
    return {
        **entry,
        "cells": [*lengths, *forces, f"{entry['speed']:.3g} m/s"],
        "sources_text": "; ".join(f"{key.replace('_', ' ')}: {value}" for key, value in entry["sources"].items()),
    }


def _specification(entry: Mapping[str, Any]) -> dict[str, Any]:
    candidates = entry["candidates"] if entry["status"] in ("conflict", "review") else []
    return {
        **entry,
        "value_text": display(entry["value"], entry["unit"]),
        "candidates_text": [
            f"{display(c['value'], c['unit'])} {c['configuration']} (page {c['page']}: “{c['quote']}”)"
            for c in candidates
        ],
    }


def _bodies(document: Mapping[str, Any], alignment: Alignment) -> list[dict[str, Any]]:
    review = set(alignment.to_review)
    masses = {b["name"]: b["mass"] for b in document["bodies"]}
    names = [b["name"] for b in document["bodies"]]
    rows = []
    for name in (*names, None):
        parts = [a for a in alignment.parts if a.body == name or (name is None and a.body not in masses)]
        if parts or name is not None:
            rows.append(
                {
                    "name": name or "left out of the machine",
                    "parts": parts,
                    "mass_text": display(masses.get(name or ""), "kg", digits=4),
                    "doubtful": sum(a.part in review for a in parts),
                }
            )
    return rows


def _joint_svg(joints: Sequence[Mapping[str, Any]], camera: Camera, picture: str) -> Any:
    from markupsafe import Markup

    marks = []
    if joints:
        pixels = _spread(camera.project(np.array([j["anchor"] for j in joints], dtype=np.float64)))
        anchors = camera.project(np.array([j["anchor"] for j in joints], dtype=np.float64))
        for number, (joint, (x, y), (ax, ay)) in enumerate(zip(joints, pixels, anchors, strict=True), start=1):
            title = escape(f"{number} {joint['name']} ({joint['type']}{', cut' if joint['cut'] else ''})")
            fill, ink = ("#ffffff", "#1d1d1b") if joint["cut"] else ("#1d1d1b", "#ffffff")
            marks.append(
                f"<g><title>{title}</title>"
                f'<line x1="{ax:.1f}" y1="{ay:.1f}" x2="{x:.1f}" y2="{y:.1f}" stroke="#1d1d1b"/>'
                f'<circle cx="{ax:.1f}" cy="{ay:.1f}" r="3" fill="#1d1d1b"/>'
                f'<circle cx="{x:.1f}" cy="{y:.1f}" r="10" fill="{fill}" stroke="#1d1d1b" stroke-width="1.5"/>'
                f'<text x="{x:.1f}" y="{y + 4:.1f}" text-anchor="middle" fill="{ink}">{number}</text></g>'
            )
    return Markup(
        f'<svg viewBox="0 0 {camera.width} {camera.height}" role="img" aria-label="Joints on the machine">'
        f'<image href="{picture}" width="{camera.width}" height="{camera.height}"/>{"".join(marks)}</svg>'
    )


def _spread(pixels: Floats, *, gap: float = 23.0, rounds: int = 200) -> Floats:
    """Labels pushed apart until none overlaps another: twins and left/right pairs project onto the same pixel."""
    # A tiny spiral separates exact coincidences in a fixed order.
    turn = np.arange(len(pixels)) * 2.4
    spots = pixels + np.stack([np.cos(turn), np.sin(turn)], axis=1)
    for _ in range(rounds):
        offset = spots[:, None, :] - spots[None, :, :]
        distance = np.linalg.norm(offset, axis=2) + np.eye(len(spots)) * 1e9
        push = np.clip(gap - distance, 0.0, None) / 2
        if not push.any():
            break
        spots = spots + np.einsum("ij,ijk->ik", push, offset / distance[..., None]) * 0.6
    return np.asarray(spots, dtype=np.float64)


def _data_uri(image: Image.Image) -> str:
    return "data:image/webp;base64," + base64.b64encode(encode(image)).decode("ascii")
