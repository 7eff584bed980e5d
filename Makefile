# Everything runs in an environment of its own; nothing but Python 3.11+ and make is needed.
PYTHON ?= python3
VENV ?= .venv
WORKERS ?= 2
BIN := $(VENV)/bin

.PHONY: demo test lint types check docs lock clean

demo: $(VENV)/.installed
	$(BIN)/fiveroute plan instances/paper/scenario-01.json

test: $(VENV)/.developing
	$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal

lint: $(VENV)/.developing
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/.developing
	$(BIN)/mypy

check: lint types test

docs: $(VENV)/.developing
	$(BIN)/python -m sphinx --quiet --fail-on-warning --keep-going docs docs/_build/html

$(VENV)/.installed: pyproject.toml requirements.lock
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --disable-pip-version-check --constraint requirements.lock --editable .
	touch $@

$(VENV)/.developing: pyproject.toml requirements.lock
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --disable-pip-version-check --constraint requirements.lock --editable ".[dev]"
	touch $@ $(VENV)/.installed

lock:
	uv pip compile --universal --quiet --no-header --extra dev pyproject.toml --output-file requirements.lock

clean:
	rm -rf $(VENV) build dist docs/_api docs/_build *.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
