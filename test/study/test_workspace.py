"""Memory that is used again."""

import threading

import numpy as np
import pytest

from pool_sim_ros.study.workspace import PIECE, Workspace, pieces


def test_a_name_has_the_same_memory_until_it_needs_more():
    kept = Workspace()
    first = kept.room('a', 5, (2,), np.int16)
    assert first.shape == (5, 2) and first.dtype == np.int16
    assert np.shares_memory(kept.room('a', 3, (2,), np.int16), first)
    assert not np.shares_memory(kept.room('b', 5), first)
    assert kept.room('a', 6, (2,), np.int16).shape == (6, 2)


def test_each_thread_has_its_own():
    kept, others = Workspace(), []
    mine = kept.room('a', 5)
    thread = threading.Thread(target=lambda: others.append(kept.room('a', 5)))
    thread.start()
    thread.join()
    assert not np.shares_memory(others[0], mine)


@pytest.mark.parametrize('count', [0, 1, PIECE, 3 * PIECE + 1])
def test_pieces_have_each_row_once(count):
    rows = np.arange(count)
    found = [rows[part] for part in pieces(count)]
    np.testing.assert_array_equal(np.concatenate([rows[:0], *found]), rows)
    assert all(0 < len(part) <= PIECE for part in found)
