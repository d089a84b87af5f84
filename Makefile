# make demo: sets everything up and builds the example machine into out/.  make test: sets up and passes the tests.
PYTHON ?= python3
VENV := .venv
STAMP := $(VENV)/.installed
ENGINES := $(VENV)/.engines
EXAMPLE := examples/wheel_loader
PIP := $(VENV)/bin/python -m pip install --quiet --disable-pip-version-check
# The pages' scripts (the last of them): installing makes them, and so does whatever needs them after a change.
PAGES := src/yellowiron/studio/data/studio.bundle.js
SOURCES := $(shell find studio/src -name '*.ts') $(wildcard studio/*.json studio/*.ts)

.PHONY: demo test test-fast lint bench clean
.DELETE_ON_ERROR:

demo: $(STAMP) $(PAGES)
	$(VENV)/bin/yellowiron build wheel_loader \
	  --cad $(EXAMPLE)/wheel_loader.step --specs $(EXAMPLE)/specifications.pdf --out out/wheel_loader --simulate

# Fast tests first: a mistake shows before the slow ones start. A file's tests share their fixtures: one worker each.
# The slow ones are begun in the order of tests/conftest.py. Hundreds of processes import the sources: they are compiled
# once, even where the environment asks Python to keep nothing.
PYTEST := PYTHONDONTWRITEBYTECODE= $(VENV)/bin/python -m pytest -n 2 --dist loadfile

test: $(ENGINES) $(PAGES)
	$(PYTEST) -m "not slow"
	$(PYTEST) -m slow --no-loadscope-reorder

test-fast: $(STAMP) $(PAGES)
	$(PYTEST) -m "not slow"

lint: $(STAMP)
	$(VENV)/bin/ruff check . && $(VENV)/bin/ruff format --check . && $(VENV)/bin/mypy
	$(VENV)/bin/python studio/bundle.py check

bench: $(ENGINES) $(PAGES)
	for script in benchmarks/bench_*.py; do $(VENV)/bin/python $$script || exit 1; done

$(VENV)/bin/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "yellowiron needs Python 3.11 or newer; name one with: make PYTHON=python3.12 $(MAKECMDGOALS)"; exit 1; }
	@$(PYTHON) -m venv $(VENV) || { echo "On Debian: apt-get install python3-venv"; exit 1; }

$(STAMP): pyproject.toml | $(VENV)/bin/python
	$(PIP) --editable '.[dev]'
	touch $(STAMP)

# The other engines are extras: where a machine has no wheels for them, their tests say that they were skipped.
$(ENGINES): pyproject.toml | $(VENV)/bin/python
	$(PIP) --editable '.[dev,physx,newton]' || { $(PIP) --editable '.[dev]' && \
	  echo "PhysX and Newton could not be installed: their tests will be skipped"; }
	touch $(STAMP) $(ENGINES)

# Where it cannot be, it says why, and the rest goes on without.
$(PAGES): $(SOURCES) | $(VENV)/bin/python
	$(VENV)/bin/python studio/bundle.py --or-say

clean:
	rm -rf $(VENV) out studio/node_modules studio/dist src/yellowiron/*/data/*.bundle.js
