"""Simulation in real engines: every actuator driven, and every body's pose held against the closed-chain kinematics.

A layer above the stages, like `build`: it may import `model`, `kinematics`, `usd` and `exporters`, and no stage imports
it. In go a machine file and an engine's name, out come results as values and as JSON documents. Engines are imported
only where they are used.

In the order in which they build on each other: `ground` (what a machine stands on), `engine` (what an engine is given
and must do), `registry` (which there are); `commands` (what the levers do), `loads` (what their drives must bear),
`payload`; `engines` (one module an engine); `driving`, `strokes` and `machine_tests` (what a machine is put to);
`suite` (all of it).

Findings:

======  ========================================================================================================
SIM001  the simulation broke down: a pose is not finite, or the linkage left every pose that its strokes allow
SIM002  a pin stood farther from its place than the engine's bar
SIM003  a body was turned farther from its pose than the engine's bar
SIM004  a loop flipped to its other branch
SIM005  a cylinder or motor ended away from its target
SIM006  a test's figure is farther from the published one than its bar
SIM007  the rated payload was not lifted, or a load was that should not be
SIM008  engine and statics differ by more than 5 %
SIM009  driving: a distance, turning radius, spin, swing or way crabwise is off by its bar, or a wheel left the ground
SIM010  an engine failed, or took no step for minutes: a build goes on without it (told by `build`)
SIM011  on the ground actuators are not driven together where the machine falls over with what it carries
======  ========================================================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.simulation.driving.result import DrivingResult, driving_document
    from yellowiron.simulation.driving.wheeled import drive
    from yellowiron.simulation.engine import Engine, Setup
    from yellowiron.simulation.machine_tests.figures import Figure, figures_document
    from yellowiron.simulation.machine_tests.hydraulics import run_tests
    from yellowiron.simulation.machine_tests.load_chart import (
        ChartFigure,
        ChartLoad,
        chart_stability,
        chart_tests,
        chart_tipping,
        read_load_chart,
    )
    from yellowiron.simulation.payload import parse_payload, payload_over_strokes, rated_payload
    from yellowiron.simulation.registry import ENGINES, installed_engines
    from yellowiron.simulation.strokes.result import SimulationResult, simulation_document
    from yellowiron.simulation.strokes.run import simulate
    from yellowiron.simulation.suite import at_rates, examine, watch

__all__ = [
    "ENGINES",
    "ChartFigure",
    "ChartLoad",
    "DrivingResult",
    "Engine",
    "Figure",
    "Setup",
    "SimulationResult",
    "at_rates",
    "chart_stability",
    "chart_tests",
    "chart_tipping",
    "drive",
    "driving_document",
    "examine",
    "figures_document",
    "installed_engines",
    "parse_payload",
    "payload_over_strokes",
    "rated_payload",
    "read_load_chart",
    "run_tests",
    "simulate",
    "simulation_document",
    "watch",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "ChartFigure": "machine_tests.load_chart",
        "ChartLoad": "machine_tests.load_chart",
        "DrivingResult": "driving.result",
        "ENGINES": "registry",
        "Engine": "engine",
        "Figure": "machine_tests.figures",
        "Setup": "engine",
        "SimulationResult": "strokes.result",
        "at_rates": "suite",
        "chart_stability": "machine_tests.load_chart",
        "chart_tests": "machine_tests.load_chart",
        "chart_tipping": "machine_tests.load_chart",
        "drive": "driving.wheeled",
        "driving_document": "driving.result",
        "examine": "suite",
        "figures_document": "machine_tests.figures",
        "installed_engines": "registry",
        "parse_payload": "payload",
        "payload_over_strokes": "payload",
        "rated_payload": "payload",
        "read_load_chart": "machine_tests.load_chart",
        "run_tests": "machine_tests.hydraulics",
        "simulate": "strokes.run",
        "simulation_document": "strokes.result",
        "watch": "suite",
    },
)
