# `make help` lists the targets. Everything goes into .venv: nothing else on the machine is changed.

PYTHON ?= python3
VENV ?= .venv
EXTRAS = jazzy,report,web,record,fit,gym,plot,frames,study,docs,test
PY = $(VENV)/bin/python

# The versions that CI has tested, for every Python: without them, next year's newest could break
# today's tree. CONSTRAINTS= takes the newest; `make lock` writes the files anew.
CONSTRAINTS ?= constraints
LOCKED = $(if $(CONSTRAINTS),$(CONSTRAINTS)/$(1).txt)
# pip heeds a file that the environment names where it builds too; newer pips, by the second name.
INSTALL = PIP_CONSTRAINT=$(LOCKED) PIP_BUILD_CONSTRAINT=$(LOCKED) $(2) -m pip install --quiet \
	--disable-pip-version-check

# A sourced ROS installation must not mix with the wheels in the environment.
unexport AMENT_PREFIX_PATH LD_LIBRARY_PATH PYTHONHOME PYTHONPATH RMW_IMPLEMENTATION
unexport _ROS_WHEELS_BOOTSTRAP_COMPLETE
# Without bytecode each of the hundreds of processes that the tests start compiles the package anew.
unexport PYTHONDONTWRITEBYTECODE

VERSION := $(shell $(PYTHON) -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null)
CREATED = $(VENV)/.created-$(VERSION)
INSTALLED = $(VENV)/.installed
BENCH_INSTALLED = $(VENV)/.installed-bench
BENCH_VENV = .venv-bench
POOLTOOL_VERSION = 0.6.0
POOLTOOL = $(BENCH_VENV)/.installed-$(POOLTOOL_VERSION)
OLDEST_VENV = .venv-oldest
OLDEST = $(OLDEST_VENV)/.installed
LOCK_VENV = .venv-lock
LOCK = $(LOCK_VENV)/bin/uv pip compile --quiet --upgrade --no-header --no-annotate --python-version 3.10
# Prints what tests run on.
define VERSIONS
	@$(1) --version
	@$(1) -m pip --disable-pip-version-check list --format=freeze | tr '\n' ' ' | fold -s -w 110
	@echo
endef
# Test modules run side by side, each in one process, as test/conftest.py orders them; 0: all in this one.
JOBS ?= 2
# What `make cover` adds. It takes about 15 % more processor time, so `make test` goes without.
COVER =
OLDEST_PYTHON ?= $(firstword $(wildcard $(or $(PYENV_ROOT),$(HOME)/.pyenv)/versions/3.10*/bin/python) \
	$(shell python3.10 -c 'print("python3.10")' 2>/dev/null))
OLDEST_TESTS = pytest hypothesis mpmath
OLDEST_MODULES = bad_input bad_input_spin failed_shots imports integrators jit kernel_files log \
	plain_python progress shot_inputs shots shots_events shots_layouts table_file trajectory \
	trajectory_file trajectory_paths validation
OLDEST_CACHE = numba_asks_it_for_everything the_second_process_loads_what_the_first_compiled
OLDEST_PACKAGES = $(shell sed -n "s/^ *install_requires=\[\(.*\)\],/\1/p" setup.py | tr -d "'," | sed 's/>=/==/g')
SETUP_FILES = setup.py setup.cfg pyproject.toml package.xml pool_sim_ros/__init__.py \
	$(wildcard config/* launch/* resource/*)

.PHONY: help demo play check test cover soak oldest bench docs lock clean setup

help:
	@echo 'make demo    play the report'\''s four shots on a simulated table and compare with its log'
	@echo 'make play    start the node and a page in the browser to play on it; Ctrl-C ends both; PORT=8081 takes another port'
	@echo 'make check   format, types, lint and imports: some seconds'
	@echo 'make test    the checks and the test suite'
	@echo 'make cover   the same, with what the tests cover'
	@echo 'make soak    what takes minutes: long runs of the node, nine million shots looked at'
	@echo 'make oldest  the physics on Python 3.10 with the oldest numpy and numba, where 3.10 is there'
	@echo 'make bench   run the benchmarks'
	@echo 'make docs    the pages and the API as a site, in build/site'
	@echo 'make lock    write constraints/ anew, with the newest versions'
	@echo 'make setup   only create $(VENV) and install everything there'
	@echo 'make clean   remove the environments, caches and build folders'
	@echo 'The first run downloads some hundred MB. PYTHON=python3.12 chooses the interpreter (3.10 or newer).'

demo: $(INSTALLED)
	@$(PY) -m pool_sim_ros.cli.demo
	@echo 'Now play on it yourself, with the mouse: make play'

play: $(INSTALLED)
	@$(PY) -m pool_sim_ros.cli.play $(if $(PORT),--port '$(PORT)')

check: $(INSTALLED)
	$(PY) -m ruff format --check .
	$(PY) -m mypy
	$(PY) -m ruff check .
	$(VENV)/bin/lint-imports

# Each kind of table is compiled once, before two processes of the tests would both do it.
test: check
	$(call VERSIONS,$(PY))
	@running=; for table in 'pool_table("7ft")' 'pool_table("carom")' 'report_table()'; do \
		$(PY) -c "from pool_sim_ros.physics import *; compile_kernels($$table)" & running="$$running $$!"; \
	done; \
	for process in $$running; do wait $$process || exit; done
	$(PY) -m pytest $(COVER) -n $(JOBS) --dist loadfile --no-loadscope-reorder

cover: COVER = --cov
cover: test

soak: $(INSTALLED)
	$(call VERSIONS,$(PY))
	$(PY) -m pytest -m soak
	$(PY) test/long_run.py

# Whole shots of both motions, the report and what the pages show: they run every kernel, and all that
# asks numba for more than to compile. That a kernel equals its twin depends on no version.
oldest: $(if $(OLDEST_PYTHON),$(OLDEST))
ifeq ($(OLDEST_PYTHON),)
	@echo 'There is no Python 3.10 here, so the physics is not tested on it.'
else
	$(call VERSIONS,$(OLDEST_VENV)/bin/python)
	NUMBA_CACHE_DIR=$(OLDEST_VENV)/numba $(OLDEST_VENV)/bin/python -m pytest -q -p no:cacheprovider \
		$(addprefix test/,me212 test_examples.py $(OLDEST_MODULES:%=physics/test_%.py)) \
		$(OLDEST_CACHE:%=test/physics/test_kernel_cache.py::test_%)
endif

bench: $(BENCH_INSTALLED) $(POOLTOOL)
	$(call VERSIONS,$(PY))
	$(PY) test/benchmark/pooltool_limits.py --pooltool $(BENCH_VENV)/bin/python --write docs/pooltool.md
	$(PY) test/benchmark/pooltool_results.py --pooltool $(BENCH_VENV)/bin/python --write docs/pooltool.md
	$(PY) test/benchmark/search_results.py --write docs/oracle.md
	$(PY) -m pytest test/benchmark --pooltool $(BENCH_VENV)/bin/python \
		--benchmark-columns=median,iqr,rounds --figures docs/benchmarks.md

docs: $(INSTALLED)
	$(PY) -m sphinx --quiet --fail-on-warning --keep-going -d build/doctrees docs build/site
	@echo 'Open build/site/index.html.'

clean:
	rm -rf $(VENV) $(BENCH_VENV) $(OLDEST_VENV) $(LOCK_VENV) build install log dist *.egg-info .pytest_cache \
		.ruff_cache .mypy_cache .import_linter_cache .hypothesis .benchmarks .coverage .coverage.*
	find pool_sim_ros test -name __pycache__ -prune -exec rm -rf {} +

setup: $(INSTALLED)

lock:
	@$(PYTHON) -m venv --clear $(LOCK_VENV)
	@echo '*' > $(LOCK_VENV)/.gitignore
	@$(LOCK_VENV)/bin/python -m pip install --quiet --disable-pip-version-check uv
	$(LOCK) --universal --all-extras --output-file constraints/all.txt setup.py
	$(LOCK) --universal --output-file constraints/pooltool.txt test/benchmark/pooltool-requirements.txt
	echo $(OLDEST_PACKAGES) $(OLDEST_TESTS) | tr ' ' '\n' | $(LOCK) --output-file constraints/oldest.txt -

# Editable, so that an edit counts at once; test/test_packaging.py tests what a plain install leaves.
$(INSTALLED): $(CREATED) $(SETUP_FILES) $(call LOCKED,all)
	@echo 'Installing pool_sim_ros and what it needs into $(VENV); the first time takes a minute or two.'
	@$(call INSTALL,all,$(PY)) --editable '.[$(EXTRAS)]'
	@touch $@

$(BENCH_INSTALLED): $(INSTALLED)
	@$(call INSTALL,all,$(PY)) --editable '.[bench]'
	@touch $@

# pooltool, which the benchmarks compare with, in an environment of its own; --no-deps because it
# asks for a build of its renderer that PyPI does not have.
$(POOLTOOL): test/benchmark/pooltool-requirements.txt $(call LOCKED,pooltool)
	@echo 'Installing pooltool $(POOLTOOL_VERSION) into $(BENCH_VENV).'
	@$(PYTHON) -m venv --clear $(BENCH_VENV)
	@echo '*' > $(BENCH_VENV)/.gitignore
	@$(call INSTALL,pooltool,$(BENCH_VENV)/bin/python) -r test/benchmark/pooltool-requirements.txt
	@$(call INSTALL,pooltool,$(BENCH_VENV)/bin/python) --no-deps pooltool-billiards==$(POOLTOOL_VERSION)
	@touch $@

$(OLDEST): setup.py $(call LOCKED,oldest)
	@echo 'Installing $(OLDEST_PACKAGES) into $(OLDEST_VENV).'
	@$(OLDEST_PYTHON) -m venv --clear $(OLDEST_VENV)
	@echo '*' > $(OLDEST_VENV)/.gitignore
	@$(call INSTALL,oldest,$(OLDEST_VENV)/bin/python) $(OLDEST_PACKAGES) $(OLDEST_TESTS)
	@touch $@

$(CREATED):
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' 2>/dev/null || { \
		echo 'pool_sim_ros needs Python 3.10 or newer; $(PYTHON) $(if $(VERSION),is $(VERSION),cannot be run).' \
			'Name another one, as in: make PYTHON=python3.12' >&2; exit 1; }
	@$(PYTHON) -m venv --clear $(VENV)
	@touch $@
