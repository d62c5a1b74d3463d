"""Collects what the benchmarks measure and, at the end, prints and writes the table."""

from pathlib import Path

import pytest
from benchmark.ask_pooltool import Pooltool
from benchmark.cores import cores
from benchmark.results import Results, around_marks, write_between_marks

PROJECT = Path(__file__).resolve().parents[2]
RESULTS = pytest.StashKey[Results]()


def pytest_addoption(parser):
    group = parser.getgroup('figures')
    group.addoption('--figures', type=Path, help='write the table between the marks in this file')
    group.addoption(
        '--pooltool',
        type=Path,
        default=PROJECT / '.venv-bench' / 'bin' / 'python',
        help='Python of an environment with pooltool (default: .venv-bench/bin/python)',
    )


def pytest_configure(config):
    config.stash[RESULTS] = Results()
    file = config.getoption('--figures')
    if file is not None:
        try:
            around_marks(file)
        except (OSError, ValueError) as error:
            raise pytest.UsageError(f'--figures: {error}') from None


def pytest_terminal_summary(terminalreporter, exitstatus, config):
    results, file = config.stash[RESULTS], config.getoption('--figures')
    if not results.rows:
        return
    terminalreporter.write_line(results.markdown())
    if file is None:
        return
    left_out = any(terminalreporter.stats.get(kind) for kind in ('skipped', 'deselected'))
    if exitstatus or left_out:
        terminalreporter.write_line(f'{file} is left as it was: not everything was measured.')
        return
    write_between_marks(file, results.markdown())


@pytest.fixture(scope='session')
def results(pytestconfig):
    """The figures of this run."""
    return pytestconfig.stash[RESULTS]


@pytest.fixture(scope='session')
def pooltool(pytestconfig, tmp_path_factory, results):
    """What plays shots with pooltool."""
    python = pytestconfig.getoption('--pooltool')
    if not python.exists():
        pytest.skip(f'no pooltool: {python} does not exist; `make bench` creates it')
    pooltool = Pooltool(python, home=tmp_path_factory.mktemp('home'))
    results.versions.update(pooltool.versions())
    return pooltool


@pytest.fixture
def time_rounds(benchmark):
    """Run a function some times and return the seconds of each, after one to warm up."""

    def measure(function, rounds):
        if benchmark.disabled:
            pytest.skip('pytest-benchmark is disabled')
        benchmark.pedantic(function, rounds=rounds, warmup_rounds=1)
        return list(benchmark.stats.stats.data)

    return measure


@pytest.fixture
def one_core():
    """Keep this process, and those it starts, on one core."""
    with cores(1):
        yield
