"""The arrays that what comes of many shots is written to."""

import numpy as np
import pytest

from pool_sim_ros.physics.log import EVENT
from pool_sim_ros.physics.outcomes import Ends, Outcomes, ShotTooLong, new_outcomes, with_events

ARRAYS = ('finals', 'durations', 'event_counts', 'first_hit', 'failed')


def test_new_arrays():
    outcomes = new_outcomes(5, 3, None)
    assert outcomes.finals.shape == (5, 3, 2)
    assert outcomes.pocketed.shape == (5, 3) and np.all(outcomes.pocketed == -1)
    for name in ARRAYS[1:]:
        assert getattr(outcomes, name).shape == (5,)
    assert outcomes.events is outcomes.offsets is None


def test_the_arrays_of_out_are_taken():
    out = new_outcomes(5, 3, None)._replace(pocketed=np.zeros((5, 3), np.int64))
    again = new_outcomes(5, 3, out)
    for name in (*ARRAYS, 'pocketed'):
        assert np.shares_memory(getattr(again, name), getattr(out, name))
    assert np.all(out.pocketed == -1)


def test_what_out_lacks_is_made():
    durations = np.empty(5)
    out = Outcomes(*[None] * 8)._replace(durations=durations)
    outcomes = new_outcomes(5, 3, out)
    assert np.shares_memory(outcomes.durations, durations)
    assert outcomes.finals.shape == (5, 3, 2) and outcomes.pocketed.shape == (5, 3)


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


@pytest.mark.parametrize(
    'spoil',
    [
        lambda array: array[:-1],
        lambda array: array[..., np.newaxis],
        lambda array: array.astype(np.float32),
        lambda array: np.repeat(array, 2, axis=0)[::2],
        lambda array: array.tolist(),
        read_only,
    ],
    ids=['shape', 'dimension', 'type', 'strides', 'list', 'read-only'],
)
@pytest.mark.parametrize('name', ARRAYS)
def test_an_array_that_does_not_fit_is_named(name, spoil):
    out = new_outcomes(5, 3, None)
    out = out._replace(**{name: spoil(getattr(out, name))})
    with pytest.raises(ValueError, match=rf'^out\.{name}: must be a writable') as caught:
        new_outcomes(5, 3, out)
    assert '\n' not in str(caught.value)


def test_bytes_in_another_order_do_not_fit():
    out = new_outcomes(5, 3, None)._replace(durations=np.zeros(5, '>f8'))
    with pytest.raises(ValueError, match=r'out\.durations: '):
        new_outcomes(5, 3, out)


def test_pocketed_of_another_shape_is_named():
    out = new_outcomes(5, 3, None)._replace(pocketed=np.zeros((5, 4), np.int64))
    with pytest.raises(ValueError, match=r'out\.pocketed: .*\(5, 3\) int64'):
        new_outcomes(5, 3, out)


def test_events_of_shots_of_which_some_failed():
    outcomes = new_outcomes(4, 1, None)
    outcomes.event_counts[:] = 2, -1, 0, 3
    events = np.zeros(5, EVENT)
    found = with_events(outcomes, events)
    assert found.events is events
    assert found.offsets.tolist() == [0, 2, 2, 2, 5] and found.offsets.dtype == np.int64
    assert outcomes.offsets is None


def test_a_part_of_the_ends_is_the_same_memory():
    outcomes = new_outcomes(6, 2, None, pockets=True)
    ends = Ends(*(getattr(outcomes, name) for name in Ends._fields))
    part = ends.part(slice(2, 5))
    for array in part:
        array[...] = 3
    assert outcomes.durations[2:5].tolist() == [3.0] * 3
    assert np.all(outcomes.pocketed[2:5] == 3)
    assert part.finals.shape == (3, 2, 2)


def test_a_shot_too_long_is_a_bad_value():
    assert issubclass(ShotTooLong, ValueError)


def test_its_repr_is_one_short_line():
    outcomes = new_outcomes(500, 3, None)
    outcomes.failed[:] = 0
    assert repr(outcomes) == '<Outcomes 500 shots, 3 balls>'
    outcomes.failed[7:9] = 2
    outcomes.event_counts[:] = 0
    shown = repr(with_events(outcomes, np.empty(40, EVENT)))
    assert shown == '<Outcomes 500 shots, 3 balls, 40 events, 2 failed>'
    assert repr(Outcomes(*[None] * 8)) == '<Outcomes 0 shots, 0 balls>'
