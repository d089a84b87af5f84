"""Shared fixtures: where the repository, its examples and the optional real inputs are."""

from __future__ import annotations

import fcntl
import importlib.util
import os
import pickle
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from hypothesis import settings

from kit.builds import MadeOnce, read_once, reading_once, script, stages_kept, without_pages
from yellowiron.model.assembly import Assembly
from yellowiron.model.mechanism import Mechanism
from yellowiron.report.html.viewer import NOT_BUNDLED

ROOT = Path(__file__).resolve().parent.parent
LONGEST = (
    "test_simulate_excavator", "test_studio_review", "test_build", "test_real_machines", "test_grader_example",
    "test_align_merged", "test_studio_session", "test_simulate_spatial", "test_simulate_backhoe_loader",
    "test_simulate_articulated_dump_truck", "test_simulate_telehandler", "test_simulate_wheeled_excavator",
    "test_simulate_steering_modes",
    "test_simulate_dozer", "test_report_browser", "test_studio_server", "test_mini_excavator_example",
    "test_studio_page", "test_simulate_hydraulics", "test_simulate_newton", "test_check_mutations",
    "test_forklift_example", "test_simulate_skid_steer", "test_simulate_roller", "test_align_degrade_build",
    "test_align_axes", "test_align_fusion", "test_backhoe_loader_example", "test_align_backhoes",
    "test_skid_steer_example", "test_simulate_rigid_dump_truck", "test_align_excavators", "test_simulate_grader",
    "test_simulate_simple", "test_film", "test_simulate_loader", "test_dozer_example", "test_align_machines",
    "test_align_degrade", "test_simulate_follows", "test_telehandler_example", "test_align_decisions", "test_quality",
    "test_fleet_batch", "test_fleet_variants", "test_hostile_imports",
)  # fmt: skip
"""Files of half a minute and more, by what they were measured to take: begun first, so that workers which take a file
at a time end together. An example's two files stand apart: one waits while the other draws."""

BROWSER_FLAGS = (
    "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
)  # fmt: skip


# A busy machine is slow now and then: no test fails by time.
settings.register_profile("timeless", deadline=None)
settings.load_profile("timeless")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """The longest files first, each file's tests as they were."""
    rank = {name: place for place, name in enumerate(LONGEST)}
    items.sort(key=lambda item: rank.get(item.path.stem, len(LONGEST)))


@pytest.fixture(scope="session", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Tests leave the user's cache alone; a run's workers share one. Stages are made anew: a test that changes one, or
    builds twice, means it."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("YELLOWIRON_FRESH", "1")
        patch.setenv("YELLOWIRON_CACHE", str(_of_the_run(tmp_path_factory) / "cache"))
        yield


def _of_the_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The temporary folder of this run, that of all its workers."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if os.environ.get("PYTEST_XDIST_WORKER") else base


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository's root."""
    return ROOT


@pytest.fixture(scope="session")
def example() -> Path:
    """The wheel loader example's folder."""
    return ROOT / "examples" / "wheel_loader"


@pytest.fixture(scope="module")
def no_pages() -> Iterator[None]:
    """Builds of a module draw no report page."""
    with without_pages():
        yield


@pytest.fixture(scope="module")
def kept_stages() -> Iterator[None]:
    """Builds and sessions of a module take from the run's cache what others like it made of the same inputs."""
    with stages_kept():
        yield


@pytest.fixture(scope="session")
def made_once(tmp_path_factory: pytest.TempPathFactory) -> MadeOnce:
    """A folder by its name, filled by the first of this run's workers that asks for it; not to be written to."""
    shared = _of_the_run(tmp_path_factory)

    def made(name: str, fill: Callable[[Path], None]) -> Path:
        folder, done = shared / name, shared / f"{name}.done"
        with (shared / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not done.exists():
                shutil.rmtree(folder, ignore_errors=True)
                fill(folder)
                done.touch()
        return folder

    return made


@pytest.fixture(scope="module")
def cad_read_once(made_once: MadeOnce) -> Iterator[None]:
    """Builds of a module share what the examples' CAD files, and the real ones beside the checkout, hold."""
    with reading_once(made_once, ROOT / "examples", ROOT.parent / "shared" / "data"):
        yield


@pytest.fixture(scope="session")
def loader_assembly(example: Path, made_once: MadeOnce) -> Assembly:
    """The wheel loader example's CAD model, read once a run."""
    if not (example / "wheel_loader.step").is_file():
        pytest.skip("the wheel loader example is not drawn: run its draw.py")
    assembly: Assembly = read_once(example / "wheel_loader.step", made_once)
    return assembly


@pytest.fixture(scope="session")
def five_lines(root: Path, example: Path, made_once: MadeOnce) -> Path:
    """The wheel loader example as the documentation's first script builds it, page and all, in `out`; what the script
    said in `said.txt`."""
    if not (example / "wheel_loader.step").is_file():
        pytest.skip("the wheel loader example is not drawn: run its draw.py")

    def fill(folder: Path) -> None:
        folder.mkdir()
        with stages_kept():
            (folder / "said.txt").write_text(script(root, "five_lines.py", folder / "out"), encoding="utf-8")

    return made_once("five_lines", fill)


@dataclass(frozen=True)
class Built:
    """The wheel loader example as the pipeline builds it with its sheet: `folder` is not to be written to."""

    folder: Path
    mechanism: Mechanism


@pytest.fixture(scope="session")
def built_loader(example: Path, made_once: MadeOnce) -> Built:
    """The wheel loader example, built once a run; its `report.html` is empty."""
    cad, sheet = example / "wheel_loader.step", example / "specifications.pdf"
    if not cad.is_file() or not sheet.is_file():
        pytest.skip("the wheel loader example is not drawn: run its draw.py")

    def fill(folder: Path) -> None:
        from yellowiron.pipeline import build

        with without_pages(), reading_once(made_once, example), stages_kept():
            machine = build("wheel_loader", cad, folder / "out", sheets=[sheet])
        (folder / "mechanism.pickle").write_bytes(pickle.dumps(machine.mechanism))

    folder = made_once("wheel_loader", fill)
    return Built(folder / "out", pickle.loads((folder / "mechanism.pickle").read_bytes()))


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Real inputs beside the checkout; tests that need them skip where the folder is absent."""
    folder = ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("real inputs (shared/data) are not here")
    return folder


@pytest.fixture(scope="session")
def bundle() -> ModuleType:
    """`studio/bundle.py`, which makes the pages' scripts."""
    spec = importlib.util.spec_from_file_location("bundle", ROOT / "studio" / "bundle.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def bundled(bundle: ModuleType) -> None:
    """The pages' scripts are there, and of the sources as they are."""
    state = bundle.state()
    if state == "absent":
        pytest.skip(NOT_BUNDLED)
    if state == "stale":
        pytest.fail(f"The pages' scripts are not of the sources as they are; make them: {bundle.COMMAND}")


@pytest.fixture(scope="module")
def browser(bundled: None) -> Iterator[Any]:
    """Debian's Chromium, drawing in software: no display and no graphics card are needed."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("no Chromium on this machine")
    with sync_api.sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=chromium, args=list(BROWSER_FLAGS))
        yield started
        started.close()
