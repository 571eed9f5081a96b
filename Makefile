# Every target makes what it needs on a machine that has only Python 3.11 or newer.
# Another interpreter: make test PYTHON=python3.12 (after `make clean`).

PYTHON ?= python3
JOBS ?= 2
VENV := .venv
BIN := $(VENV)/$(if $(filter Windows_NT,$(OS)),Scripts,bin)
INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check
PINNED := $(INSTALL) --require-hashes --only-binary=:all:

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo live coverage test test-slow check format docs pages bench wheel requirements clean

help: ## Show this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-13s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: $(VENV)/package.stamp ## Measure once, then robots in the browser; IMAGE=photo.jpg: your picture
	@$(BIN)/tagmetry demo $(if $(IMAGE),--image "$(IMAGE)",--live $(if $(HEADLESS),--headless))

live: $(VENV)/package.stamp ## Open the live page: twelve simulated robots in a browser; end it with Ctrl-C
	@$(BIN)/tagmetry live

test: $(VENV)/dev.stamp ## Run the tests; TESTS=tests/pose for a part of them
	$(BIN)/python -m pytest -n $(JOBS) $(TESTS)

coverage: $(VENV)/dev.stamp ## Run the tests and say which lines they reach; tracing takes its time
	$(BIN)/python -m pytest -n $(JOBS) --cov --cov-report=term $(TESTS)

test-slow: $(VENV)/dev.stamp ## Run the long tests as well
	$(BIN)/python -m pytest -n $(JOBS) -m "slow or not slow" $(TESTS)

check: $(VENV)/dev.stamp ## Lint, formatting and types
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

format: $(VENV)/dev.stamp ## Format the code and mend what lint can mend
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

docs: $(VENV)/dev.stamp ## Build the documentation into site/
	$(BIN)/mkdocs build --strict --quiet

pages: $(VENV)/dev.stamp ## Make the pictures and the command reference of the docs anew
	$(BIN)/python docs/make_pictures.py
	$(BIN)/python docs/make_effects.py
	$(BIN)/python docs/make_calibration_pictures.py
	$(BIN)/python docs/make_stage_pictures.py
	$(BIN)/python docs/make_pages.py

bench: $(VENV)/dev.stamp ## Time detection and pose against the peers
	@$(BIN)/tagmetry bench

wheel: $(VENV)/dev.stamp ## Build the wheel into dist/
	rm -rf dist
	$(BIN)/python -m build --wheel --no-isolation --outdir dist

COMPILE = $(BIN)/uv pip compile --quiet --upgrade --universal --python-version 3.11 \
	--generate-hashes --no-emit-index-url --no-header --no-annotate
GROUPS := --group test --group check --group docs --group build --group lock
HEADER := \# Pinned by `make requirements`. Change pyproject.toml, not this file.

requirements: $(VENV)/dev.stamp ## Pin the newest versions that pyproject.toml allows
	$(COMPILE) pyproject.toml --all-extras $(GROUPS) --output-file $(VENV)/dev.txt
	$(COMPILE) pyproject.toml --extra all -c $(VENV)/dev.txt --output-file $(VENV)/run.txt
	$(COMPILE) --group build -c $(VENV)/dev.txt --output-file $(VENV)/build.txt
	for name in dev run build; do \
		{ echo '$(HEADER)'; cat $(VENV)/$$name.txt; } > requirements/$$name.txt; done

clean: ## Remove what was made
	rm -rf $(VENV) build dist site demo-out .cache .coverage .coverage.* .hypothesis \
		.mypy_cache .pytest_cache .ruff_cache
	find src tests docs -name __pycache__ -type d -prune -exec rm -rf {} +

# The environment: emptied and filled anew when the pinned requirements change.
$(VENV)/run.stamp: requirements/run.txt requirements/build.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
		echo "tagmetry needs Python 3.11 or newer, $(PYTHON) is not: make PYTHON=python3.12 …" >&2; \
		exit 2; }
	$(PYTHON) -m venv --clear $(VENV)
	$(PINNED) -r requirements/run.txt -r requirements/build.txt
	@touch $@

$(VENV)/package.stamp: pyproject.toml $(VENV)/run.stamp
	$(INSTALL) --no-deps --no-build-isolation --no-index --editable .
	@touch $@

$(VENV)/dev.stamp: requirements/dev.txt $(VENV)/package.stamp
	$(PINNED) -r requirements/dev.txt
	@touch $@
