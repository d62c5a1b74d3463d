from typing import NamedTuple

import numpy as np
import pytest

from pool_sim_ros.physics.event_driven.false_sharing import LINE, own_lines
from pool_sim_ros.physics.motion import DISC


class Pair(NamedTuple):
    numbers: np.ndarray
    factor: float


@pytest.mark.parametrize('shape', [(), (0,), (1,), (3, 5), (16,), (1000,)])
@pytest.mark.parametrize('dtype', [np.int32, np.float64, DISC])
def test_a_copy_is_the_same_and_can_be_written_alone(shape, dtype):
    array = np.random.default_rng(1).integers(0, 100, (*shape, np.dtype(dtype).itemsize), 'u1')
    array = array.view(dtype).reshape(shape)
    own = own_lines(array)
    assert own.dtype == array.dtype and own.shape == array.shape and own.flags.aligned
    assert own.flags.c_contiguous and own.flags.writeable
    assert own.tobytes() == array.tobytes()
    own[...] = np.zeros((), dtype)
    assert own.tobytes() == bytes(own.nbytes)


def test_tuples_keep_their_types():
    numbers = np.arange(3.0)
    copy = own_lines((Pair(numbers, 2.0), (numbers,)))
    assert isinstance(copy[0], Pair) and copy[0].factor == 2.0 and type(copy[1]) is tuple
    for part in (copy[0].numbers, copy[1][0]):
        assert part is not numbers and np.array_equal(part, numbers)


def test_no_two_share_a_line():
    lines = []
    for own in own_lines(tuple(np.zeros(1) for _ in range(200))):
        first = own.ctypes.data // LINE
        assert own.ctypes.data % LINE == 0
        assert own.base.ctypes.data <= first * LINE
        assert (first + 1) * LINE <= own.base.ctypes.data + own.base.nbytes
        lines.append(first)
    assert len(set(lines)) == len(lines)
