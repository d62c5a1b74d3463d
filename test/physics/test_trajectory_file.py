"""A trajectory goes to a file and comes back; a file that is none is refused in one line."""

import numpy as np
import pytest

from pool_sim_ros.physics import Trajectory, pool_table, report_table, simulate

SHOTS = {
    'discs': lambda: simulate(report_table(), (-4.0, 0.1)),
    'balls': lambda: simulate(pool_table('7ft'), (-6.0, 0.1), spins=(5.0, 0.0, 50.0)),
    'cut': lambda: simulate(report_table(), (-4.0, 0.1), until=0.3),
}


@pytest.mark.parametrize('name', SHOTS)
def test_a_trajectory_comes_back_bit_for_bit(name, tmp_path):
    shot = SHOTS[name]()
    shot.save(tmp_path / 'shot')
    found = Trajectory.load(tmp_path / 'shot')
    assert found.table == shot.table
    assert (found.duration, found.complete) == (shot.duration, shot.complete)
    for field in ('final_positions', 'final_velocities', 'events', 'segments', 'pocketed'):
        np.testing.assert_array_equal(getattr(found, field), getattr(shot, field))
    times = np.linspace(0.0, shot.duration, 20)
    for look_up in ('positions', 'velocities', 'spins', 'orientations'):
        np.testing.assert_array_equal(getattr(found, look_up)(times), getattr(shot, look_up)(times))


def refused(file):
    with pytest.raises(ValueError) as caught:
        Trajectory.load(file)
    message = str(caught.value)
    assert '\n' not in message and message.startswith(f'{file}: ')
    return message


@pytest.mark.parametrize('content', [b'', b'text', b'PK\x03\x04', b'\x93NUMPY\x01\x00'])
def test_a_file_that_is_no_trajectory(content, tmp_path):
    file = tmp_path / 'bad.npz'
    file.write_bytes(content)
    assert 'it is no pool_sim_ros trajectory' in refused(file)


def test_other_arrays_are_no_trajectory(tmp_path):
    np.savez(tmp_path / 'other.npz', a=np.zeros(3))
    np.save(tmp_path / 'other.npy', np.zeros(3))
    for name in ('other.npz', 'other.npy'):
        assert 'it is no pool_sim_ros trajectory' in refused(tmp_path / name)


@pytest.mark.parametrize(
    ('field', 'spoil', 'words'),
    [
        ('version', lambda value: np.array(9), 'version: 9 must be 1'),
        ('table', lambda value: np.array('{}'), 'table: it is no pool_sim_ros table'),
        ('duration', lambda value: np.array(np.nan), 'duration: nan is not finite'),
        ('duration', lambda value: np.array(-1.0), 'duration: -1.0 must be at least 0'),
        ('final_positions', lambda value: value[1:], r'final_positions: shape'),
        ('events', lambda value: np.zeros(3), 'events: it has type float64'),
        ('segments', lambda value: value[:0], 'segments: they must be of the 11 balls'),
        ('segments', lambda value: value[::-1], 'segments: their times must be'),
        ('pocketed', lambda value: value + 1, 'pocketed: 0 must be -1 or one of 0'),
        ('complete', lambda value: np.array(1), 'complete: it has type int64'),
        ('complete', None, 'complete: it is missing'),
    ],
)
def test_a_field_that_is_wrong_is_named(field, spoil, words, tmp_path):
    file = tmp_path / 'shot.npz'
    SHOTS['discs']().save(file)
    with np.load(file) as archive:
        arrays = dict(archive)
    value = arrays.pop(field)
    if spoil is not None:
        arrays[field] = spoil(value)
    np.savez(file, **arrays)
    assert words in refused(file)


def test_a_file_that_is_cut_or_not_there(tmp_path):
    file = tmp_path / 'shot.npz'
    SHOTS['discs']().save(file)
    file.write_bytes(file.read_bytes()[:-100])
    refused(file)
    with pytest.raises(OSError, match=r'none\.npz'):
        Trajectory.load(tmp_path / 'none.npz')
