# `make help` lists the targets. Everything goes into .venv: nothing else on the machine is changed.

PYTHON ?= python3
VENV ?= .venv
EXTRAS = jazzy,report,web,test
PY = $(VENV)/bin/python

# A sourced ROS installation must not mix with the wheels in the environment.
unexport AMENT_PREFIX_PATH LD_LIBRARY_PATH PYTHONHOME PYTHONPATH RMW_IMPLEMENTATION
unexport _ROS_WHEELS_BOOTSTRAP_COMPLETE

VERSION := $(shell $(PYTHON) -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null)
CREATED = $(VENV)/.created-$(VERSION)
INSTALLED = $(VENV)/.installed
BENCH_INSTALLED = $(VENV)/.installed-bench
BENCH_VENV = .venv-bench
POOLTOOL = $(BENCH_VENV)/.installed
SETUP_FILES = setup.py setup.cfg pyproject.toml package.xml pool_sim_ros/__init__.py \
	$(wildcard config/* launch/* resource/*)

.PHONY: help demo test bench clean setup

help:
	@echo 'make demo    play the report'\''s four shots on a simulated table and compare with its log'
	@echo 'make test    run the linter and the whole test suite'
	@echo 'make bench   run the benchmarks'
	@echo 'make setup   only create $(VENV) and install everything there'
	@echo 'make clean   remove $(VENV), caches and build folders'
	@echo 'The first run downloads about 140 MB. PYTHON=python3.12 chooses the interpreter (3.10 or newer).'

demo: $(INSTALLED)
	@$(PY) -m pool_sim_ros.demo

# numba's cache does not notice an edit in a module that a kernel imports.
test: $(INSTALLED)
	find pool_sim_ros test -name '*.nb[ic]' -delete
	$(PY) -m ruff check .
	$(PY) -m pytest

bench: $(BENCH_INSTALLED) $(POOLTOOL)
	find pool_sim_ros test -name '*.nb[ic]' -delete
	$(PY) -m pytest test/benchmark --figures docs/benchmarks.md --pooltool $(BENCH_VENV)/bin/python

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

# pooltool, which the benchmarks are compared with, in an environment of its own. One of its
# requirements is a nightly build of a renderer; it is installed without, and plays just as well.
$(POOLTOOL): test/benchmark/pooltool-requirements.txt test/benchmark/pooltool-itself.txt
	@echo 'Installing pooltool into $(BENCH_VENV).'
	@$(PYTHON) -m venv --clear $(BENCH_VENV)
	@echo '*' > $(BENCH_VENV)/.gitignore
	@$(BENCH_VENV)/bin/python -m pip install --quiet --disable-pip-version-check \
		-r test/benchmark/pooltool-requirements.txt
	@$(BENCH_VENV)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps \
		-r test/benchmark/pooltool-itself.txt
	@touch $@

$(CREATED):
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>/dev/null || { \
		echo 'pool_sim_ros needs Python 3.10 or newer; $(PYTHON) $(if $(VERSION),is $(VERSION),cannot be run).' \
			'Name another one, as in: make PYTHON=python3.12' >&2; exit 1; }
	@$(PYTHON) -m venv --clear $(VENV)
	@touch $@
