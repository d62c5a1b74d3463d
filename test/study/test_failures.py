"""Why a sweep cannot go on, in words."""

import errno
import types

import pytest

from pool_sim_ros.study.failures import failure


class KilledWorker(Exception):  # noqa: N818, Dask's name
    """As Dask raises it."""


@pytest.mark.parametrize(
    ('error', 'said'),
    [
        (OSError(errno.ENOSPC, 'No space left'), 'out: the disk of map.zarr is full'),
        (OSError(errno.EACCES, 'Permission denied'), 'out: map.zarr cannot be written: Permission'),
        (KilledWorker(), 'workers: several died'),
        (ModuleNotFoundError('x', name='zarr'), 'workers: one of them lacks zarr'),
        (ValueError('velocities:\n too fast'), 'ValueError: velocities: too fast'),
    ],
)
def test_each_in_one_line(error, said):
    line = failure(error, types.SimpleNamespace(path='map.zarr'))
    assert line.startswith(said) and '\n' not in line
