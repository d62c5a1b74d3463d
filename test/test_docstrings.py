"""Every public name has a docstring that says what it takes, in which shape and unit, and raises.

`docstrings` and `raised_errors`, in test/support, look; below they are shown what they must find.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from docstrings import below_constants, lacks, lacks_of_head, public_names
from numpy.typing import ArrayLike, NDArray
from raised_errors import raised

from pool_sim_ros.physics import Table, aim_at, simulate, simulate_many

PROJECT = Path(__file__).parents[1]
FOR_USERS = ('physics', 'oracle', 'study', 'me212', 'ros')
"""Rooms that the API of the site has; the others are for the package alone."""

FOR_COMMANDS = {
    *('LastingExecutor', 'Publishers', 'messages', 'check_environment', 'digests', 'init_ros'),
    *('Inbox', 'SimulatorView', 'leave_at_once', 'add_simulator', 'ros_command'),
    *('add_timeout', 'shut_down_on_signals'),
}
"""What `ros` exports for `cli` and `web_view` alone."""

GIVEN_RIGHT = {'compile_kernels', 'report_table', 'deviations', 'is_report_table'}
"""They give other functions input of their own, which is right."""


def of_callers(name, lines):
    """Leave out errors that a caller cannot cause: only `simulate_many` takes `out`."""
    last = name.rpartition('.')[2]
    if last in GIVEN_RIGHT:
        return [line for line in lines if not line.endswith('which it raises')]
    return [line for line in lines if last == 'simulate_many' or 'TypeError' not in line]


@pytest.mark.parametrize('room', FOR_USERS)
def test_a_public_name_says_what_it_takes_returns_and_raises(room):
    below, found, count = below_constants(room), [], 0
    for name, thing in public_names(room):
        count += 1
        if name.split('.')[1] not in FOR_COMMANDS:
            found += [f'{name}: {line}' for line in of_callers(name, lacks(name, thing, below))]
    assert not found, '\n'.join(found)
    assert count > 4


@pytest.mark.parametrize('room', ['simulator', 'console', 'ros'])
def test_a_name_for_the_package_alone_says_what_it_is(room):
    below, found = below_constants(room), []
    for name, thing in public_names(room):
        text = getattr(thing, '__doc__', None) if callable(thing) else below.get(name.split('.')[1])
        found += [
            f'{name}: {line}' for line in lacks_of_head(text or getattr(thing, '__doc__', ''))
        ]
    assert not found, '\n'.join(found)


@pytest.mark.parametrize('room', FOR_USERS)
def test_the_site_lists_every_public_name_once(room):
    page = (PROJECT / 'docs' / 'api' / f'{room}.rst').read_text()
    blocks = re.findall(rf'^\.\. names:: pool_sim_ros\.{room}\n\n((?:   .*\n)+)', page, re.M)
    listed = ' '.join(blocks).split()
    assert sorted(listed) == sorted({name.split('.')[1] for name, _ in public_names(room)})


def speed_of(v: ArrayLike, factor: float = 1.0) -> NDArray[np.float64]:
    """Return how fast something is.

    Parameters
    ----------
    v : array_like
        Its velocity.
    other : float
        m.
    """
    if factor < 0.0:
        raise ValueError('factor')
    return np.abs(v) * factor


def test_what_is_missing_is_found():
    assert lacks('x.speed_of', speed_of, {}) == [
        'parameter factor is not documented',
        'there is no parameter other',
        'v: no shape',
        'v: no unit',
        'what it returns: no shape',
        'what it returns: no unit',
        'nothing about ValueError, which it raises',
    ]
    assert lacks('x.LEVEL', 3, {}) == ['no docstring']
    assert lacks('x.LEVEL', 3, {'LEVEL': 'no end'}) == ['its first sentence has no end']


speed_of.__module__ = 'pool_sim_ros.nowhere'  # only functions of the package are followed


def caught() -> None:
    try:
        speed_of(1.0)
        raise KeyError
    except KeyError:
        pass


def test_errors_are_those_of_what_is_called_too():
    assert raised(caught) == {ValueError}
    assert ValueError in raised(aim_at) and ValueError in raised(Table)
    names = {error.__name__ for error in raised(simulate)}
    assert names == {'ValueError', 'ShotTooLong', 'ShotCancelled'}
    assert TypeError in raised(simulate_many)
