"""The audit of a machine's own physics as one table: three engines, the file as it is, every figure beside its bar.

    python benchmarks/bench_audit.py [FILE.usda …] [--data FOLDER] [--engines physx newton mujoco] [--rows step force …]

Default: both examples, built into a temporary folder; with `--data` the ZX120 that it holds, without a sheet, too.
Nothing of `yellowiron.simulation` is used: `plain.py` calls each engine by its own documentation, drives are told
targets, colliders are the file's. PhysX at 120 Hz; Newton at 240 Hz, and for levers (Euler's integrator) and margin at
1 kHz, the rate that its scene has where nobody tells it; MuJoCo at 1 kHz.

step      greatest speed after steps of a target from end to end, by flow over area, the base fixed
force     what a cylinder pulls and pushes with, by area times pressure, farthest off, as the file says it; …
told      … and told each way (`yellowiron.each_way`; MJCF says both itself)
levers    greatest speed with levers pushed whole through the oil (`Actuation` = `hydraulic`), and …
power     … the most power of all cylinders at once, by the engine's: in a step, and over 50 ms
rocking   both again with the machine free on the ground, brakes set
free      greatest speed after bare steps there: the machine jumps, and as it lands its weight opens a relief valve
lag       ms behind a target that moves at a quarter of the slower rated speed, from mid-stroke; least and most
margin    poses (as drawn, both ends, ten by chance) where drives that are kicked come to rest at three times the step
pins      the widest gap of a pin over slow strokes; PhysX at 60 Hz with 4 position iterations, the others as above
slope     mm/s down 20 degrees, brakes set
sinking   mm that a cylinder gives in a minute under the rated load, on the ground; without one, 7 % of the mass
tipping   the load at which the machine tips in the pose of its template's first such test, its cylinders locked, by
          the sheet's
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from bench_defaults import Worst, targets
from bench_slope import TOLD, downhill
from bench_steps import FINE, steps_in
from plain import GRAVITY, HZ, Engine, Newton, PhysX, World, built, of_a_process, started, turned
from yellowiron.each_way import EachWay
from yellowiron.hydraulics import engine_power
from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.kinematics.strength import rated_load
from yellowiron.model.mechanism import Mechanism, Site
from yellowiron.usd import read_mechanism

WALL = 1e9
"""kg: an armature that hardly anything moves."""
STALLED = 0.2
"""Seconds that a force has on it."""
SETTLED = 6.0
"""Seconds to a pose and to rest in it."""
KICK = 0.005
"""Metres by which all targets are moved."""
STILL = 0.001
"""m/s: at rest."""
QUIET = 4.0
"""Seconds to come to rest on the ground, and to a pose."""
PRESSING = (0.1, 0.005)
"""By so much a second a load grows, by the published one's size: up to 0.8 of it, and then."""
USUAL_LOAD = 0.07
"""A bucketful by the machine's mass, where no sheet says one: the example excavator's."""
TIPPED = math.radians(2.0)
"""Lean since the load began: less than that tyres and tracks give."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("--data", type=Path, help="a folder with zx120/zx120.glb")
    parser.add_argument("--engines", nargs="*", choices=HZ, default=list(HZ))
    parser.add_argument("--rows", nargs="*", choices=ROWS, default=list(ROWS))
    parser.add_argument("--one", nargs=2, metavar=("ROW", "ENGINE"), help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.one:
        row, engine = given.one
        print(json.dumps(ROWS[row](engine, given.files[0])))
        return
    with tempfile.TemporaryDirectory() as folder:
        for file in given.files or built(Path(folder), given.data):
            print(f"\n{file.parent.name}\n\n| | {' | '.join(given.engines)} | bar |")
            print(f"|---|{'---|' * (len(given.engines) + 1)}", flush=True)
            for row in given.rows:
                cells = [_cell(file, row, engine) for engine in given.engines]
                print(f"| {row} | {' | '.join(cells)} | {BARS[row]} |", flush=True)


def _cell(file: Path, row: str, engine: str) -> str:
    try:
        return str(of_a_process(__file__, file, "--one", row, engine))
    except RuntimeError as why:
        return str(why)


# ---- speeds and forces -----------------------------------------------------------------------------------------------
def step(engine: str, file: Path) -> str:
    seen = steps_in(engine, file)["speeds"].values()
    return f"{max(max(each) for each in seen) - 1.0:+.1%}"


def levers(engine: str, file: Path) -> str:
    return _by_levers(engine, file, "--levers")


def rocking(engine: str, file: Path) -> str:
    return _by_levers(engine, file, "--levers", "--free")


def _by_levers(engine: str, file: Path, *options: str) -> str:
    found = steps_in(engine, file, options)
    rated = engine_power(read_mechanism(file))
    kilowatts = [
        f"{1e-3 * found[kind]:.0f}" + (f" ({found[kind] / rated - 1.0:+.0%})" if math.isfinite(rated) else "")
        for kind in ("power", "taken")
    ]
    fastest = max(max(each) for each in found["speeds"].values()) - 1.0
    return f"{fastest:+.1%}, {kilowatts[0]} kW, over 50 ms {kilowatts[1]}"


def force(engine: str, file: Path) -> str:
    return _stalled(engine, file, told=False)


def told(engine: str, file: Path) -> str:
    return _stalled(engine, file, told=True)


def _stalled(engine: str, file: Path, *, told: bool) -> str:
    """The force that is farthest off its rated one: by the speed that it gives a slide as heavy as a wall."""
    mechanism = read_mechanism(file)
    at = started(engine, file, World(HZ[engine], down=(0.0, 0.0, 0.0)))
    limits = None
    if told and isinstance(at, PhysX):
        limits = EachWay.of(mechanism, at.dofs)
    elif told and isinstance(at, Newton):
        model = at.solver.mj_model
        model.jnt_actfrcrange[:] = EachWay.of(mechanism, [model.joint(n).name for n in range(model.njnt)]).ranges
    for number in range(len(at.slides)):
        at.burden(number, WALL)
    worst = 0.0
    for way, end in ((0, "lower"), (1, "upper")):
        wanted = np.array([getattr(slide, end) for slide in at.slides])
        at.tell(wanted)
        if limits is not None:
            assert isinstance(at, PhysX)
            at.limit(limits)
        before, steps = at.speeds(), round(STALLED * at.hz)
        for _ in range(steps):
            at.step()
        forces = np.abs(at.speeds() - before) * WALL * at.hz / steps
        own = [mechanism.joint(slide.name).drive for slide in at.slides]
        off = [float(f) / d.forces[way] - 1.0 for f, d in zip(forces, own, strict=True) if d is not None]
        worst = max([worst, *off], key=abs)
    return f"{worst:+.1%}"


def free(engine: str, file: Path) -> str:
    return f"{max(max(each) for each in steps_in(engine, file, ['--free'])['speeds'].values()) - 1.0:+.1%}"


# ---- gains -----------------------------------------------------------------------------------------------------------
def lag(engine: str, file: Path) -> str:
    mechanism, at = read_mechanism(file), started(engine, file, World(HZ[engine]))
    found = []
    for number, slide in enumerate(at.slides):
        own = mechanism.joint(slide.name).drive
        assert own is not None
        wanted, speed = np.zeros(len(at.slides)), 0.25 * min(own.speeds)
        wanted[number] = 0.5 * (slide.lower + slide.upper)
        go(at, wanted, SETTLED)
        behind = []
        for _ in range(round(at.hz)):
            wanted[number] += speed / at.hz
            at.tell(wanted)
            at.step()
            behind.append(wanted[number] - float(at.strokes()[number]))
        found.append(1e3 * float(np.mean(behind[len(behind) // 2 :])) / speed)
    return f"{min(found):.0f}–{max(found):.0f} ms"


def margin(engine: str, file: Path) -> str:
    at = started(engine, file, World(FINE if engine == "newton" else HZ[engine]))
    low, high = (np.array([getattr(slide, end) for slide in at.slides]) for end in ("lower", "upper"))
    chosen, own = np.random.default_rng(21), at.hz
    shares = [-low / (high - low), np.zeros(len(low)), np.ones(len(low)), *chosen.random((10, len(low)))]
    stable = 0
    for share in shares:
        wanted = low + (high - low) * np.clip(share, 0.02, 0.98)
        at.pace(own)
        go(at, wanted, SETTLED)
        at.pace(own / 3.0)
        at.tell(wanted + KICK * np.where(share > 0.5, -1.0, 1.0))
        for _ in range(round(SETTLED * at.hz)):
            at.step()
        seen = []
        for _ in range(round(0.5 * at.hz)):
            at.step()
            seen.append(np.abs(at.speeds()).max())
        if not np.isfinite(seen).all():
            return f"bursts after {stable} of {len(shares)}"
        stable += max(seen) < STILL
    return f"{stable} of {len(shares)}"


def go(at: Engine, wanted: np.ndarray, seconds: float) -> None:
    """To targets in half of that time, evenly, and then rests."""
    start, steps = at.strokes(), round(seconds * at.hz)
    for number in range(steps):
        at.tell(start + (wanted - start) * min(1.0, 2.0 * number / steps))
        at.step()


# ---- loops -----------------------------------------------------------------------------------------------------------
def pins(engine: str, file: Path) -> str:
    hz = 60.0 if engine == "physx" else HZ[engine]
    at = started(engine, file, World(hz, iterations=4))
    worst = Worst(at.pins, at.bodies)
    for wanted in targets(at.slides, hz):
        at.tell(wanted)
        at.step()
        poses = at.poses()
        if not worst.see(poses[:, :3], poses[:, 3:]):
            return "bursts"
    return f"{1e3 * worst.gap:.3g} mm"


# ---- on the ground ---------------------------------------------------------------------------------------------------
def slope(engine: str, file: Path) -> str:
    return f"{1e3 * downhill(file, f'{engine}, told' if engine == 'newton' else engine, 'set'):.3g} mm/s"


def on_ground(engine: str, file: Path) -> Engine:
    more = TOLD if engine == "newton" else {}
    world = World(HZ[engine], base="floating", ground=True, variants={"Brakes": "set"}, told=more)
    return started(engine, file, world)


def pressed(at: Engine, site: Site, mechanism: Mechanism, mass: float) -> None:
    """A step with so many kg more on a site."""
    path = next(path for path in at.bodies if path.rpartition("/")[2] == site.body)
    pose = at.poses()[at.bodies[path]]
    place = np.array(site.position) - np.array(mechanism.body(site.body).origin)
    at.push(path, np.array([0.0, 0.0, -GRAVITY * mass]), pose[:3] + turned(pose[None, 3:], place[None])[0])
    at.step()


def load_on(mechanism: Mechanism) -> tuple[Site, float]:
    """The rated load and its place; where nothing says one, the usual share of the machine's mass in its tool."""
    known = rated_load(mechanism)
    if known is not None:
        return known
    place = mechanism.payload.site if mechanism.payload is not None else ""
    site = next(site for site in mechanism.sites if site.name == place)
    return site, USUAL_LOAD * sum(body.mass for body in mechanism.bodies)


def sinking(engine: str, file: Path) -> str:
    mechanism = read_mechanism(file)
    site, mass = load_on(mechanism)
    at, seen = on_ground(engine, file), []
    for seconds in (10.0, 60.0):
        for _ in range(round(seconds * at.hz)):
            pressed(at, site, mechanism, mass)
        seen.append(at.strokes())
    gave = f"{1e3 * float(np.abs(seen[1] - seen[0]).max()):.3g} mm"
    return gave if rated_load(mechanism) is not None else f"{gave} ({mass:.0f} kg, none known)"


def tipping(engine: str, file: Path) -> str:
    """By the first test of the template that tips it, else as drawn: slowly into its pose, then a load that grows."""
    mechanism = read_mechanism(file)
    at = on_ground(engine, file)
    start = wanted = at.strokes()
    test = next((test for test in mechanism.tests if test.kind == "tipping"), None)
    if test is not None:
        bench = Bench(mechanism)
        state = bench.pose(test.steps)
        wanted = np.array([bench.chain.coordinate(state, slide.name) for slide in at.slides])
        site = next(site for site in mechanism.sites if site.name == test.site)
        published = specified(mechanism, test.specification or test.name)[0]
    else:
        site, published = load_on(mechanism)[0], None
    steps = round(2.0 * QUIET * at.hz)
    for number in range(steps + round(QUIET * at.hz)):
        share = min(1.0, number / steps)
        at.tell(start + (wanted - start) * (0.5 - 0.5 * math.cos(math.pi * share)))
        at.step()
    at.hold()  # the standards' tests have their cylinders locked
    scale = published or 0.2 * sum(body.mass for body in mechanism.bodies)
    first, mass = upright(at), 0.0
    while mass < 3.0 * scale:
        mass += PRESSING[mass > 0.8 * scale] * scale / at.hz
        pressed(at, site, mechanism, mass)
        lean = math.acos(min(1.0, float(first @ upright(at))))
        if not math.isfinite(lean):
            return "breaks down"
        if lean > TIPPED:
            return f"{mass:.0f} kg" + (f" ({mass / published - 1.0:+.1%})" if published else ", none published")
    return "does not tip"


def upright(at: Engine) -> np.ndarray:
    return turned(at.poses()[at.bodies[at.root]][None, 3:], np.array([[0.0, 0.0, 1.0]]))[0]


ROWS: dict[str, Callable[[str, Path], Any]] = {
    "step": step, "force": force, "told": told, "levers": levers, "rocking": rocking,
    "free": free, "lag": lag, "margin": margin, "pins": pins, "slope": slope,
    "sinking": sinking, "tipping": tipping,
}  # fmt: skip
BARS = {
    "step": "+10 %", "force": "", "told": "± 2 %", "levers": "+10 %, power +20 %",
    "rocking": "+10 %, power +20 %", "free": "", "lag": "20 ms", "margin": "13 of 13", "pins": "20 mm",
    "slope": "holds", "sinking": "1 mm", "tipping": "± 10 %",
}  # fmt: skip


if __name__ == "__main__":
    main()
