"""How much memory playing takes beyond its results."""

from pathlib import Path

import pytest
from benchmark.children import run_python
from benchmark.results import significant

SECTION = 'Memory'
SCRIPT = Path(__file__).with_name('memory.py')
MIB = 2.0**20


def memory_beyond_results(what, count):
    return int(run_python(str(SCRIPT), what, str(count)))


@pytest.mark.parametrize('count', [4000, 16_000, 64_000])
def test_balls(results, count):
    size = memory_beyond_results('balls', count)
    text = f'{significant(size / MIB, 3)} MiB, {size / count:.0f} bytes a ball'
    results.note(SECTION, f'one shot, n = {count}', text, 'linear in n')


def test_shots(results):
    size = memory_beyond_results('shots', 1_000_000)
    text = f'{significant(size / MIB, 3)} MiB'
    results.note(SECTION, 'one million shots, all cores, beyond their results', text, '1 GiB')
