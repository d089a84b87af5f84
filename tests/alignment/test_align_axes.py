"""Axes of joints from bodies that are known: with pins, without, without holes, in shells that are open, decimated."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import trimesh

from kit.machines.damages import DAMAGES, base, damaged
from kit.machines.defects import drawn, spoiled
from kit.machines.excavators import any_features
from kit.machines.synthetic import Machine
from yellowiron.alignment.axes import AxisEstimate, Frame, estimate_axes, group, hinge_proposals
from yellowiron.alignment.axes.cylinder_lines import cylinder_line, trunnion_of
from yellowiron.alignment.axes.estimate import _parallel_sections
from yellowiron.alignment.axes.outlines import fitted_circle, outline_circles
from yellowiron.alignment.axes.pivots import pivots_of, trust_in_pivots
from yellowiron.alignment.axes.unfound import axis_findings, unfound_axes
from yellowiron.alignment.axes.values import Candidate, Line, plane_of
from yellowiron.alignment.features.solids import Solid, size_of, solids_of
from yellowiron.cad.mesh import polygons
from yellowiron.cad.mesh.assembly import Occurrence, assemble, shape_of
from yellowiron.library import load_template
from yellowiron.model.alignment import PartAssignment
from yellowiron.model.assembly import Assembly, Node
from yellowiron.model.geometry import Floats, Mesh
from yellowiron.model.rows import as_drawn
from yellowiron.model.template import JointTemplate, Role, Template, choose

MACHINE = Frame(*np.eye(3))
TEMPLATES = {"loader": "wheel_loader", "excavator": "excavator"}


@cache
def template_of(kind: str, seed: int) -> Template:
    machine = drawn(kind, seed)
    if kind == "excavator":
        return choose(load_template("excavator"), any_features(seed).choices())
    twin = any(body == "boom_cylinder_barrel_l" for _, body in machine.truth.values())
    return choose(load_template("wheel_loader"), {"lift_cylinders": "twin" if twin else "single"})


def true_hinges(machine: Machine, template: Template) -> dict[str, tuple[Floats, Floats]]:
    """Hinge → a point on its pin's axis and its direction, of a machine that has its pins."""
    pins: dict[str, Solid] = {}
    for solid in solids_of(machine.assembly()):
        role, _ = machine.truth[solid.part.id]
        if solid.part.name == role and solid.line is not None:
            pins.setdefault(role, solid)
    found = {}
    for joint in template.joints:
        own = [pins[p] for p in joint.parts if p in pins and not template.role(p).rigid]
        if joint.type == "revolute" and own and own[0].line is not None:
            found[joint.name] = (own[0].line.center, own[0].line.direction)
    return found


def estimated(machine: Machine, template: Template, frame: Frame | None = MACHINE) -> dict[str, AxisEstimate]:
    solids = solids_of(machine.assembly())
    labels: dict[str, list[int]] = {}
    for solid in solids:
        body = machine.truth[solid.part.id][1]
        if body:
            labels.setdefault(body.partition("|")[0], []).append(solid.index)
    return estimate_axes(solids, labels, template, frame=frame)


def from_triangles(machine: Machine) -> Machine:
    """With the features that are found on its triangles, as of any mesh file."""
    used = {p.shape for p in machine.parts}
    shapes = {k: shape_of(s.mesh, s.name) for k, s in machine.shapes.items() if k in used}
    machine.shapes.update(shapes)
    return machine


def errors(
    found: dict[str, AxisEstimate], truth: dict[str, tuple[Floats, Floats]], template: Template, machine: Machine
) -> dict[str, tuple[float, float, float]]:
    """Joint → metres across, degrees, and how many of its own sigmas."""
    bodies = {body.partition("|")[0] for _, body in machine.truth.values()}
    result = {}
    for name, (point, way) in truth.items():
        if not set(template.bodies_of(template.joint(name))) <= bodies:
            continue
        e = found[name]
        delta = e.origin - point
        across = float(np.linalg.norm(delta - (delta @ way) * way))
        degrees = math.degrees(math.acos(min(1.0, abs(float(way @ e.direction)))))
        result[name] = (across, degrees, across / e.across)
    return result


def height_of(machine: Machine) -> float:
    assembly = machine.assembly()
    return float(np.ptp(np.concatenate([assembly.points_of(p) for p in assembly.parts])[:, 2]))


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
@pytest.mark.parametrize("defect", ["sound", "no pins", "visual"])
def test_hinges_are_where_the_pins_are(kind: str, defect: str) -> None:
    template = template_of(kind, 0)
    machine = spoiled(kind, 0, defect)
    off = errors(estimated(machine, template), true_hinges(drawn(kind, 0), template), template, machine)
    assert len(off) >= 13
    assert all(across < 1e-3 and degrees < 0.2 and sigmas < 1.0 for across, degrees, sigmas in off.values()), off


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["loader", "excavator"])
@pytest.mark.parametrize("damage", ["decimated 30", "opened", "loose pins", "8-gon", "scale slips", "double-sided"])
def test_damaged_meshes_keep_their_hinges(kind: str, damage: str) -> None:
    if damage.startswith("decimated"):
        pytest.importorskip("fast_simplification")
    template = template_of(kind, 4)
    machine = from_triangles(damaged(kind, 4, damage))
    truth = true_hinges(base(kind, 4, damage), template)
    off = errors(estimated(machine, template), truth, template, machine)
    right = [across < 0.01 * height_of(machine) and degrees < 2.0 for across, degrees, _ in off.values()]
    assert damage in DAMAGES and len(right) >= 12
    assert np.mean(right) >= 0.97, off
    assert np.mean([sigmas < 2.0 for *_, sigmas in off.values()]) >= 0.9, off


def test_the_machines_directions_are_found_where_nobody_says_them() -> None:
    template = template_of("loader", 1)
    machine = spoiled("loader", 1, "no pins")
    off = errors(estimated(machine, template, None), true_hinges(drawn("loader", 1), template), template, machine)
    assert all(across < 1e-3 and degrees < 0.2 for across, degrees, _ in off.values()), off


def two_bodies() -> Template:
    roles = tuple(Role(n, None, rigid=True, kind="arm") for n in ("lower", "upper"))
    return Template("thing", "", "lower", roles, (JointTemplate("hinge", "revolute", ("lower", "upper")),))


def solids_from(*placed: tuple[Mesh, tuple[float, float, float]]) -> tuple[Solid, ...]:
    found = []
    for number, (mesh, at) in enumerate(placed):
        matrix = np.eye(4)
        matrix[:3, 3] = at
        found.append(Occurrence(f"part {number}", (), mesh, matrix))
    return solids_of(assemble(found, name="thing", format="test", unit=1.0, path=""))


def boxes() -> tuple[tuple[Solid, ...], dict[str, list[int]]]:
    """Two bars that overlap by 0.2 m at x = 1, side by side, nothing round in them."""
    solids = solids_from(
        (polygons.box((1.2, 0.1, 0.2)), (0.5, 0.0, 0.0)), (polygons.box((1.3, 0.1, 0.18)), (1.55, 0.1, 0.0))
    )
    left = [s.index for s in solids if s.center[0] < 1.0]
    return solids, {"lower": left, "upper": [s.index for s in solids if s.index not in left]}


def test_without_evidence_a_guess_says_how_rough_it_is() -> None:
    solids, labels = boxes()
    found = estimate_axes(solids, labels, two_bodies(), frame=Frame(left=np.array([0.0, 1.0, 0.0])))["hinge"]
    off = np.hypot(found.origin[0] - 1.0, found.origin[2])
    assert off < 2 * found.across
    assert found.across > 0.03
    assert abs(found.direction[1]) > 0.999


def slide_of(template: Template, moved: str, wide: float) -> AxisEstimate:
    """The slide of a flat bar, 1.2 m long, before a chassis."""
    solids = solids_from(
        (polygons.box((2.0, 1.0, 1.5)), (0.0, 0.0, 0.8)), (polygons.box((1.2, wide, 0.1)), (1.65, 0.0, 0.1))
    )
    ahead = [s.index for s in solids if s.center[0] > 1.0]
    labels = {"chassis": [s.index for s in solids if s.index not in ahead], moved: ahead}
    frame = Frame(np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    found = estimate_axes(solids, labels, template, frame=frame)
    (slide,) = (e for name, e in found.items() if template.joint(name).type == "prismatic")
    return slide


@pytest.mark.parametrize("wide", [0.8, 0.1])
def test_what_slides_on_a_mast_that_is_not_drawn_goes_up(wide: float) -> None:
    """Forks lie along the machine: their length is not the way that they are lifted."""
    forklift = as_drawn(choose(load_template("forklift"), {"mast": "single"}), {"chassis", "carriage"})
    found = slide_of(forklift, "carriage", wide)
    assert np.abs(found.direction) == pytest.approx((0.0, 0.0, 1.0), abs=1e-3)
    assert (found.how == "how its machine stands") == (wide > 0.5)


def test_a_narrow_section_of_a_boom_that_is_not_drawn_slides_along_its_length() -> None:
    telehandler = as_drawn(choose(load_template("telehandler"), {"sections": "two"}), {"chassis", "inner_boom"})
    found = slide_of(telehandler, "inner_boom", 0.1)
    assert np.abs(found.direction) == pytest.approx((1.0, 0.0, 0.0), abs=1e-3)


def test_a_pivot_of_the_scene_tree_is_taken_where_the_bodies_meet() -> None:
    solids, labels = boxes()
    pivots = {"hinge": np.array([[0.98, 0.0, 0.01], [2.2, 0.0, 0.0]])}
    left = Frame(left=np.array([0.0, 1.0, 0.0]))
    found = estimate_axes(solids, labels, two_bodies(), frame=left, pivots=pivots)["hinge"]
    assert np.allclose(found.origin[[0, 2]], [0.98, 0.01], atol=1e-9)
    assert "pivot" in found.how


def scene_tree(*, origin: tuple[float, float, float], middle: bool = False) -> tuple[Assembly, dict[str, str]]:
    """Two bars under a group, the upper one under a node of its own with that origin, or in the middle of its mesh."""
    nodes = [Node("machine", None, np.eye(4)), *(Node(n, 0, np.eye(4)) for n in ("lower", "upper"))]
    at = np.eye(4)
    at[:3, 3] = (1.55, 0.1, 0.0) if middle else origin
    nodes[2] = replace(nodes[2], transform=at)
    placed = (((1.2, 0.1, 0.2), (0.5, 0.0, 0.0)), ((1.3, 0.1, 0.18), (1.55, 0.1, 0.0)))
    items = []
    for (extent, center), node in zip(placed, nodes[1:], strict=True):
        matrix = np.eye(4)
        matrix[:3, 3] = center
        items.append(Occurrence(node.name, ("machine",), polygons.box(extent), matrix))
    assembly = assemble(items, name="thing", format="test", unit=1.0, path="")
    parts = tuple(replace(p, node=1 + k) for k, p in enumerate(assembly.parts))
    return replace(assembly, parts=parts, nodes=tuple(nodes)), {p.id: p.name for p in parts}


def test_nodes_that_carry_one_body_and_not_the_other_are_pivots() -> None:
    assembly, body_of = scene_tree(origin=(0.98, 0.0, 0.01))
    assert np.allclose(pivots_of(assembly, body_of, two_bodies())["hinge"], [[0.98, 0.0, 0.01]], atol=1e-3)
    # The scene's own origin, and the middle of a mesh, are where a program puts them.
    assert pivots_of(*scene_tree(origin=(0.0, 0.0, 0.0)), two_bodies()) == {}
    assert pivots_of(*scene_tree(origin=(0.0, 0.0, 0.0), middle=True), two_bodies()) == {}
    assert pivots_of(replace(assembly, nodes=(), parts=tuple(replace(p, node=None) for p in assembly.parts)),
                     body_of, two_bodies()) == {}  # fmt: skip


def test_bones_that_carry_nothing_are_pivots_of_every_hinge() -> None:
    """A skinned mesh hangs under no bone of its armature."""
    assembly, body_of = scene_tree(origin=(0.0, 0.0, 0.0))
    head = np.eye(4)
    head[:3, 3] = (0.97, 0.0, 0.02)
    bones = (Node("bone", 0, head, bone=True), Node("other", 0, head @ head))
    found = pivots_of(replace(assembly, nodes=(*assembly.nodes, *bones)), body_of, two_bodies())
    assert np.allclose(found["hinge"], [[0.97, 0.0, 0.02]], atol=1e-3)


def test_a_pivot_far_from_where_the_bodies_meet_is_not_believed() -> None:
    solids, labels = boxes()
    left = Frame(left=np.array([0.0, 1.0, 0.0]))
    found = estimate_axes(solids, labels, two_bodies(), frame=left, pivots={"hinge": np.array([[1.9, 0.0, 0.0]])})
    assert "pivot" not in found["hinge"].how
    assert abs(found["hinge"].origin[0] - 1.0) < 0.1


def test_pivots_are_believed_as_far_as_they_are_on_the_hinges_that_are_drawn() -> None:
    def hinge(x: float, quality: float = 0.8) -> list[Candidate]:
        return [Candidate(np.array([x, 0.0, 0.0]), np.array([0.0, 1.0, 0.0]), 0.001, 0.01, quality, "a pin")]

    drawn = {str(k): hinge(float(k)) for k in range(6)} | {"unclear": hinge(9.0, 0.2)}
    on_them = {name: c[0].origin[None] + [0.0, 0.5, 0.01] for name, c in drawn.items()}
    beside = {name: c[0].origin[None] + [0.3, 0.0, 0.0] for name, c in drawn.items()}
    usual = trust_in_pivots({}, on_them, 5.0)
    assert trust_in_pivots(drawn, on_them, 5.0) > usual > 0.9
    assert trust_in_pivots(drawn, beside, 5.0) < 0.15
    assert trust_in_pivots({"unclear": drawn["unclear"]}, beside, 5.0) == usual


@pytest.mark.parametrize(("quality", "gives_way"), [(0.4, True), (0.2, False)])
def test_what_was_found_otherwise_gives_way_to_an_estimate_that_is_more_than_a_guess(
    quality: float, gives_way: bool
) -> None:
    way = np.array([0.0, 1.0, 0.0])
    found = AxisEstimate("hinge", np.zeros(3), way, 0.001, 0.01, "round part of both bodies", (), quality)
    assert found.beats((0.5, 0.0, 0.0), tuple(way)) == gives_way
    # Another line that it could be is left.
    wide = replace(found, across=0.2)
    assert not wide.beats((0.5, 0.0, 0.0), tuple(way))


def test_an_arm_without_cylinders_turns_about_parallel_axes() -> None:
    """No chain is closed, but the template's would be."""
    template = template_of("excavator", 2)
    machine = spoiled("excavator", 2, "no pins")
    machine.parts = [p for p in machine.parts if "cylinder" not in machine.truth[p.id][1]
                     and "piston_rod" not in machine.truth[p.id][1]]  # fmt: skip
    found = estimated(machine, template, None)
    truth = true_hinges(drawn("excavator", 2), template)
    for name in ("upperstructure2boom_joint", "boom2arm_joint", "arm2bucket_joint"):
        if name in found:
            assert abs(float(found[name].direction @ truth[name][1])) > math.cos(math.radians(0.5)), name


@pytest.mark.slow
def test_what_is_left_out_says_nothing_and_nothing_raises() -> None:
    template = two_bodies()
    solids, labels = boxes()
    assert estimate_axes((), {}, template) == {}
    assert estimate_axes(solids, {"lower": labels["lower"]}, template) == {}
    rng = np.random.default_rng(5)
    for _ in range(20):
        meshes = []
        for _ in range(4):
            points = rng.normal(size=(int(rng.integers(3, 12)), 3)) * rng.choice([1e-3, 1.0, 30.0])
            points[:, rng.integers(3)] *= rng.choice([0.0, 1.0])
            meshes.append((Mesh(points, rng.integers(0, len(points), (5, 3)).astype(np.int32)), (0.0, 0.0, 0.0)))
        try:
            odd = solids_from(*meshes)
        except Exception:  # noqa: BLE001  nothing of it can be a part: a reader's business
            continue
        half = {"lower": [s.index for s in odd[::2]], "upper": [s.index for s in odd[1::2]]}
        for e in estimate_axes(odd, half, template).values():
            assert np.isfinite([*e.origin, *e.direction, e.across, e.angle]).all()
            assert e.across > 0


def test_only_joints_that_were_not_found_are_told() -> None:
    solids, labels = boxes()
    parts = [PartAssignment(solids[i].part.id, b, b, 1.0, "") for b, rows in labels.items() for i in rows]
    template, size = two_bodies(), size_of(solids)
    assert unfound_axes(solids, parts, template, found={"hinge"}, size=size) == {}
    found = unfound_axes(solids, parts, template, found=(), size=size)
    (finding,) = axis_findings(found, size)
    assert (finding.code, finding.where, finding.severity) == ("ALN016", "hinge", "warning")
    assert f"{1e3 * found['hinge'].across:.0f} mm" in finding.message


@pytest.mark.parametrize("defect", ["sound", "no pins"])
def test_proposals_before_there_are_labels(defect: str) -> None:
    template = template_of("excavator", 1)
    machine = spoiled("excavator", 1, defect)
    solids = solids_of(machine.assembly())
    size = size_of(solids)
    bodies: dict[str, list[int]] = {}
    for s in solids:
        bodies.setdefault(machine.truth[s.part.id][1], []).append(s.index)
    groups = {body: group(solids, rows, size) for body, rows in bodies.items() if body}
    for name, (point, way) in true_hinges(drawn("excavator", 1), template).items():
        a, b = (str(body) for body in template.bodies_of(template.joint(name)))
        best = hinge_proposals(groups[a], groups[b])[0]
        delta = best.origin - point
        assert np.linalg.norm(delta - (delta @ way) * way) < 1e-3, name
        assert best.quality > 0.4
    assert hinge_proposals(groups["bucket"], groups["undercarriage"]) == []


def test_circles_in_an_outline_of_few_sides() -> None:
    turn = np.arange(8) * math.pi / 4
    ring = np.stack([0.3 + 0.05 * np.cos(turn), 0.1 + 0.05 * np.sin(turn)], axis=1)
    points = np.concatenate([np.c_[ring, np.zeros(8)], np.c_[ring, np.full(8, 0.2)]])
    k = np.arange(8)
    n = (k + 1) % 8
    walls = np.concatenate([np.c_[k, n, n + 8], np.c_[k, n + 8, k + 8]]).astype(np.int32)
    up = np.array([0.0, 0.0, 1.0])
    plane = plane_of(up)
    for triangles, inner in ((walls, False), (walls[:, ::-1], True)):
        (circle,) = outline_circles(points, triangles, up, plane, least=0.01, most=0.2)
        assert np.allclose(circle.center @ plane, [0.3, 0.1, 0.0], atol=1e-9)
        assert circle.radius == pytest.approx(0.05)
        assert (circle.low, circle.high, circle.inner) == (0.0, 0.2, inner)
        assert circle.arc == pytest.approx(2 * math.pi)


def test_a_circle_through_points() -> None:
    center, radius = fitted_circle(np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]) + 5.0)
    assert np.allclose(center, 5.0) and radius == pytest.approx(1.0)
    assert fitted_circle(np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]))[1] == math.inf


def turned(mesh: trimesh.Trimesh) -> Mesh:
    return Mesh(np.asarray(mesh.vertices), np.asarray(mesh.faces, dtype=np.int32))


def test_a_ring_about_a_barrel_is_its_trunnion() -> None:
    """Of the carrier, a yoke or a whole ring, or of the barrel itself; at the barrel's ends a ring is an eye's boss, or
    the rod's gland."""
    barrel, rod = (turned(trimesh.creation.cylinder(r, height=2.0, sections=24)) for r in (0.1, 0.05))
    ring = trimesh.creation.annulus(0.11, 0.18, 0.2, sections=24)
    yoke = ring.submesh([np.flatnonzero(ring.triangles_center[:, 0] < 0.05)], append=True)
    plate = turned(trimesh.creation.box((0.2, 0.02, 0.2)))
    for mesh, own, at, found in (
        (ring, False, 0.3, True), (yoke, False, 0.3, True), (ring, True, -0.2, True), (yoke, True, -0.2, False),
        (ring, False, 0.9, False), (ring, True, -0.9, False),
    ):  # fmt: skip
        halves = ((barrel, (0.0, 0.0, 0.0)), (rod, (0.0, 0.0, 1.2)))
        solids = solids_from(*halves, (turned(mesh), (0.0, 0.0, at)), (plate, (0.3, 0.0, at)))
        size = size_of(solids)
        tube, bar = (group(solids, rows, size) for rows in ([0, 2] if own else [0], [1]))
        carrier = group(solids, [3] if own else [2, 3], size)
        line = cylinder_line(tube, bar)
        assert line is not None
        place = trunnion_of(line, tube, carrier)
        assert (place is not None) is found
        if place is not None:
            center = line.origin + place[0] * line.direction
            assert center == pytest.approx((0.0, 0.0, at), abs=0.01)
            assert place[1] == pytest.approx(0.1, abs=0.01)


def boxed(
    template: Template, blocks: dict[str, tuple[tuple[float, ...], tuple[float, ...]]]
) -> dict[str, AxisEstimate]:
    """The axes of a machine of blocks, body → size and middle (metres), in a frame that is known."""
    items = [
        Occurrence(name, (), _block(size), trimesh.transformations.translation_matrix(at))
        for name, (size, at) in blocks.items()
    ]
    model = assemble(items, name="blocks", format="synthetic", unit=1.0, path="blocks.glb")
    solids = solids_of(model)
    return estimate_axes(solids, {s.part.name: [s.index] for s in solids}, template, frame=MACHINE)


def _block(size: tuple[float, ...]) -> Mesh:
    whole = trimesh.creation.box(size)
    return Mesh(np.asarray(whole.vertices), np.asarray(whole.faces, dtype=np.int32))


def test_a_carriage_that_is_wider_than_high_slides_as_its_mast_does() -> None:
    """Two public forklifts' slid 24° and 79° beside upright, along their own length."""
    template = choose(load_template("forklift"), {"mast": "simplex"})
    found = boxed(
        template,
        {
            "chassis": ((2.0, 1.0, 1.0), (0.0, 0.0, 0.8)),
            "outer_mast": ((0.15, 0.8, 2.0), (1.2, 0.0, 1.2)),
            "inner_mast": ((0.12, 0.6, 2.0), (1.2, 0.0, 1.2)),
            "carriage": ((1.2, 0.9, 0.5), (1.8, 0.0, 0.4)),
        },
    )
    for slide in ("outer_mast2inner_mast_joint", "inner_mast2carriage_joint"):
        assert abs(found[slide].direction @ MACHINE.up) > math.cos(math.radians(1.0)), slide


def test_outrigger_beams_slide_across_the_machine_and_jacks_upright() -> None:
    """A public crane's slid along its boom, 53 % of its height beside where they do."""
    template = load_template("mobile_crane")
    blocks = {"carrier": ((10.0, 2.4, 0.8), (0.0, 0.0, 1.2))}
    for end, x in (("front", 2.0), ("rear", -4.0)):
        for side, y in (("l", 0.9), ("r", -0.9)):
            blocks[f"{end}_outrigger_beam_{side}"] = ((0.9, 0.6, 0.3), (x, y, 0.9))
            blocks[f"{end}_outrigger_jack_{side}"] = ((0.5, 0.5, 0.3), (x, 1.2 * y, 0.6))
    found = boxed(choose(template, {}), blocks)
    beams = [e for name, e in found.items() if name.startswith("carrier2") and "beam" in name]
    jacks = [e for name, e in found.items() if "jack" in name]
    assert len(beams) == len(jacks) == 4
    assert min(abs(float(e.direction @ MACHINE.left)) for e in beams) > 0.99
    assert min(abs(float(e.direction @ MACHINE.up)) for e in jacks) > 0.99


def test_jacks_are_upright_beside_beams_that_are_known_better() -> None:
    """Beams and jacks slide on each other as sections do, and are none."""
    crane = choose(load_template("mobile_crane"), {})
    beam, jack = "carrier2front_outrigger_beam_l_joint", "front_outrigger_beam_l2front_outrigger_jack_l_joint"
    lines = {
        beam: Line(np.zeros(3), MACHINE.left, 0.001, math.radians(0.1), 0.1, "round faces along it"),
        jack: Line(np.zeros(3), MACHINE.up, 0.05, math.radians(5.0), 0.1, "the length of its parts"),
    }
    assert _parallel_sections(lines, crane)[jack] is lines[jack]


def test_a_blade_that_is_drawn_angled_slides_along_itself() -> None:
    """Its slide is lateral by the type, on a circle that turns."""
    template = choose(load_template("grader"), {})
    angled = trimesh.transformations.rotation_matrix(math.radians(35.0), (0.0, 0.0, 1.0))
    items = [
        Occurrence(
            "blade_carrier", (), _block((0.3, 0.4, 0.5)), trimesh.transformations.translation_matrix((0, 0, 0.9))
        ),
        Occurrence("moldboard", (), _block((0.2, 3.6, 0.6)), angled),
    ]
    solids = solids_of(assemble(items, name="grader", format="synthetic", unit=1.0, path="grader.glb"))
    found = estimate_axes(solids, {s.part.name: [s.index] for s in solids}, template, frame=MACHINE)
    slide = found["blade_carrier2moldboard_joint"]
    assert abs(float(slide.direction @ angled[:3, 1])) > math.cos(math.radians(3.0))


def test_stabilisers_turn_lengthwise_and_a_swing_post_upright() -> None:
    """A public backhoe loader's had the machine's left for an axis, to a degree: 30 → 41 of 58 joints."""
    template = load_template("backhoe_loader")
    blocks = {
        "chassis": ((4.0, 1.4, 0.8), (0.0, 0.0, 1.0)),
        "swing_post": ((0.4, 0.4, 0.8), (-2.2, 0.0, 1.0)),
    }
    for side, y in (("l", 1.0), ("r", -1.0)):
        blocks[f"swing_cylinder_barrel_{side}"] = ((0.6, 0.12, 0.12), (-1.6, 0.4 * y, 1.0))
        blocks[f"swing_piston_rod_{side}"] = ((0.5, 0.06, 0.06), (-2.0, 0.4 * y, 1.0))
        blocks[f"stabilizer_{side}"] = ((0.3, 0.9, 0.3), (-1.9, 1.2 * y, 0.6))
        blocks[f"stabilizer_cylinder_barrel_{side}"] = ((0.12, 0.12, 0.6), (-1.9, 0.9 * y, 1.2))
        blocks[f"stabilizer_piston_rod_{side}"] = ((0.06, 0.06, 0.5), (-1.9, 0.9 * y, 0.9))
    found = boxed(choose(template, {v.name: v.choices[0] for v in template.variants}), blocks)
    told = [j for j in template.joints if j.name in found and j.direction is not None and j.type == "revolute"]
    assert {j.direction for j in told} >= {"lengthwise", "vertical"}
    for joint in told:
        way = {"lengthwise": MACHINE.forward, "vertical": MACHINE.up, "lateral": MACHINE.left}[str(joint.direction)]
        assert abs(float(found[joint.name].direction @ way)) > 0.98, joint.name
