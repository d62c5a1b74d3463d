# `make help` lists the targets. Everything goes into .venv: nothing else on the machine is changed.

PYTHON ?= python3
VENV ?= .venv
EXTRAS = jazzy,report,web,record,test
PY = $(VENV)/bin/python

# A sourced ROS installation must not mix with the wheels in the environment.
unexport AMENT_PREFIX_PATH LD_LIBRARY_PATH PYTHONHOME PYTHONPATH RMW_IMPLEMENTATION
unexport _ROS_WHEELS_BOOTSTRAP_COMPLETE

VERSION := $(shell $(PYTHON) -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null)
CREATED = $(VENV)/.created-$(VERSION)
INSTALLED = $(VENV)/.installed
BENCH_INSTALLED = $(VENV)/.installed-bench
BENCH_VENV = .venv-bench
POOLTOOL_VERSION = 0.6.0
POOLTOOL = $(BENCH_VENV)/.installed-$(POOLTOOL_VERSION)
SETUP_FILES = setup.py setup.cfg pyproject.toml package.xml pool_sim_ros/__init__.py \
	$(wildcard config/* launch/* resource/*)

.PHONY: help demo play test bench clean setup

help:
	@echo 'make demo    play the report'\''s four shots on a simulated table and compare with its log'
	@echo 'make play    start the node and a page in the browser to play on it; Ctrl-C ends both'
	@echo 'make test    run the linter and the whole test suite'
	@echo 'make bench   run the benchmarks'
	@echo 'make setup   only create $(VENV) and install everything there'
	@echo 'make clean   remove $(VENV), caches and build folders'
	@echo 'The first run downloads some hundred MB. PYTHON=python3.12 chooses the interpreter (3.10 or newer).'

demo: $(INSTALLED)
	@$(PY) -m pool_sim_ros.cli.demo
	@echo 'Now play on it yourself, with the mouse: make play'

play: $(INSTALLED)
	@$(PY) -m pool_sim_ros.cli.play

# numba's cache does not notice an edit in a module that a kernel imports.
test: $(INSTALLED)
	find pool_sim_ros test -name '*.nb[ic]' -delete
	$(PY) -m ruff check .
	$(PY) -m pytest

bench: $(BENCH_INSTALLED) $(POOLTOOL)
	find pool_sim_ros test -name '*.nb[ic]' -delete
	$(PY) test/benchmark/pooltool_limits.py --pooltool $(BENCH_VENV)/bin/python --write docs/pooltool.md
	$(PY) -m pytest test/benchmark --pooltool $(BENCH_VENV)/bin/python \
		--benchmark-columns=median,iqr,rounds --figures docs/benchmarks.md

clean:
	rm -rf $(VENV) $(BENCH_VENV) build install log dist *.egg-info .pytest_cache .ruff_cache .hypothesis .benchmarks
	find pool_sim_ros test -name __pycache__ -prune -exec rm -rf {} +

setup: $(INSTALLED)

# Editable, so that an edit counts at once; test/test_packaging.py tests what a plain install leaves.
$(INSTALLED): $(CREATED) $(SETUP_FILES)
	@echo 'Installing pool_sim_ros and what it needs into $(VENV); the first time takes a minute or two.'
	@$(PY) -m pip install --quiet --disable-pip-version-check --editable '.[$(EXTRAS)]'
	@touch $@

$(BENCH_INSTALLED): $(INSTALLED)
	@$(PY) -m pip install --quiet --disable-pip-version-check --editable '.[bench]'
	@touch $@

# pooltool, which the benchmarks compare with, in an environment of its own; --no-deps because it
# asks for a build of its renderer that PyPI does not have.
$(POOLTOOL): test/benchmark/pooltool-requirements.txt
	@echo 'Installing pooltool $(POOLTOOL_VERSION) into $(BENCH_VENV).'
	@$(PYTHON) -m venv --clear $(BENCH_VENV)
	@echo '*' > $(BENCH_VENV)/.gitignore
	@$(BENCH_VENV)/bin/python -m pip install --quiet --disable-pip-version-check \
		-r test/benchmark/pooltool-requirements.txt
	@$(BENCH_VENV)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps \
		pooltool-billiards==$(POOLTOOL_VERSION)
	@touch $@

$(CREATED):
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>/dev/null || { \
		echo 'pool_sim_ros needs Python 3.10 or newer; $(PYTHON) $(if $(VERSION),is $(VERSION),cannot be run).' \
			'Name another one, as in: make PYTHON=python3.12' >&2; exit 1; }
	@$(PYTHON) -m venv --clear $(VENV)
	@touch $@
